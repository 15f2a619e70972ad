//! Orders of every tableau on groups, the norm of quaternions, agreement with methods in the algebra, refusals, and a
//! configuration of one's own.

use nalgebra::{Isometry2, Isometry3, SMatrix, SVector, UnitQuaternion};

use super::*;
use crate::configuration::Product;
use crate::integrate::SystemProblem;
use crate::integrate::{
    Classical4, DormandPrince5, DormandPrince8, Fixed, MomentumForm, NoInput, Rkmk, Simulation, Tableau, VelocityForm,
    Verner9,
};
use crate::lie::{se2, se3, so3};
use crate::simd::Lanes;
use crate::testing::FreeTop;
use crate::testing::coasting::{Coasting, increment};
use crate::testing::dual::{TestDual, dual};
use crate::testing::order::{NONE, TOP, TORQUE, distance, march, measured_order, start_by_momentum, start_by_velocity};

/// Numbers of steps whose errors are above rounding, for a span of 4.
const FEW: [u32; 4] = [8, 11, 16, 22];
const MANY: [u32; 4] = [40, 80, 160, 320];

fn order_on_rotations<C: Coefficients<S>, const S: usize>(method: RungeKutta<C, S>, counts: &[u32]) {
    let velocities = SystemProblem { system: &TOP, form: VelocityForm, input: TORQUE };
    let momenta = SystemProblem { system: &TOP, form: MomentumForm, input: TORQUE };
    let stated = f64::from(C::TABLEAU.order);
    assert_eq!(OneStep::<FreeTop<f64>>::properties(&method), Properties::of_order(C::TABLEAU.order));
    for (form, found) in [
        ("velocities", measured_order(&method, &velocities, &start_by_velocity(), 4.0, counts)),
        ("momenta", measured_order(&method, &momenta, &start_by_momentum(), 4.0, counts)),
    ] {
        // Verner's errors of order 9 are so small that those of order 10 count beside them wherever they are above
        // rounding.
        let most = if stated == 9.0 { 1.0 } else { 0.4 };
        assert!(found > stated - 0.3 && found < stated + most, "{form}: {found} instead of {stated}");
    }
}

#[test]
fn orders_on_rotations_in_both_forms() {
    order_on_rotations(RungeKutta(Classical4), &MANY);
    order_on_rotations(RungeKutta(DormandPrince5), &MANY);
    order_on_rotations(RungeKutta(DormandPrince8), &[16, 22, 30, 40]);
    order_on_rotations(RungeKutta(Verner9), &[16, 22, 28, 36, 44]);
}

/// Velocities that push and drag change, so that they do not commute with themselves at another time.
fn order_on<Q: Configuration<Scalar = f64>>(group: &str, q: Q) {
    let system: Coasting<Q> = Coasting { push: increment(3.0), drag: 0.3 };
    let problem = SystemProblem { system: &system, form: VelocityForm, input: NoInput };
    let start = State { t: 0.0, q, y: increment(2.0) };
    for (stated, found) in [
        (4.0, measured_order(&RungeKutta(Classical4), &problem, &start, 4.0, &MANY)),
        (8.0, measured_order(&RungeKutta(DormandPrince8), &problem, &start, 4.0, &FEW)),
    ] {
        assert!((found - stated).abs() < 0.4, "{group}: {found} instead of {stated}");
    }
}

#[test]
fn orders_on_poses_in_space_and_in_the_plane_and_on_products() {
    let pose: Isometry3<f64> = se3::exp(&increment(1.0));
    let plane: Isometry2<f64> = se2::exp(&increment(4.0));
    order_on("SE(3)", pose);
    order_on("SE(2)", plane);
    order_on("a product", (plane, (so3::exp(&increment(5.0)), pose)));
}

/// `components` along `exp(t v)` by dual numbers, against the rates that are written down; and back.
fn rates_are_derivatives<Q, D>(q: Q, lift: impl Fn(&Q) -> D)
where
    Q: Configuration<Scalar = f64>,
    D: Configuration<Scalar = TestDual>,
{
    let velocity: Q::Tangent = increment(6.0);
    let mut along = D::Tangent::zero();
    for i in 0..Q::Tangent::DIM {
        along.set_component(i, dual(0.0, velocity.component(i)));
    }
    let (moved, rates) = (lift(&q).retract(&along).components(), q.component_rates(&velocity));
    assert_eq!(Q::Components::DIM, D::Components::DIM);
    // Sums of up to ten products of numbers up to 2.
    let bound = 10.0 * 2.0 * f64::EPSILON;
    for i in 0..Q::Components::DIM {
        assert!((moved.component(i).rate - rates.component(i)).abs() < bound, "component {i}");
        assert_eq!(Q::from_components(&q.components()).components().component(i), q.components().component(i));
    }
    let back = q.tangent(&rates);
    assert!(back.add_scaled(-1.0, &velocity).max_norm() < bound, "{back:?}");
}

#[test]
fn rates_of_components_are_their_derivatives_and_tangents_undo_them() {
    let lifted = |x: f64| dual(x, 0.0);
    let rotation: UnitQuaternion<f64> = so3::exp(&increment(5.0));
    let pose: Isometry3<f64> = se3::exp(&increment(1.0));
    let plane: Isometry2<f64> = se2::exp(&increment(4.0));
    let point: SVector<f64, 2> = increment(7.0);
    let of_plane =
        |q: &Isometry2<f64>| Isometry2::from_components(&SVector::from(q.components().data.0[0].map(lifted)));
    let of_pose = |q: &Isometry3<f64>| Isometry3::from_components(&SVector::from(q.components().data.0[0].map(lifted)));
    rates_are_derivatives(rotation, |q| {
        UnitQuaternion::from_components(&SVector::from(q.components().data.0[0].map(lifted)))
    });
    rates_are_derivatives(pose, of_pose);
    rates_are_derivatives(plane, of_plane);
    rates_are_derivatives(point, |q| SVector::from(q.data.0[0].map(lifted)));
    rates_are_derivatives((plane, pose), |q| (of_plane(&q.0), of_pose(&q.1)));
}

/// Also where a step leaves the group by far.
#[test]
fn quaternions_stay_of_norm_1_to_rounding() {
    let problem = SystemProblem { system: &TOP, form: VelocityForm, input: NONE };
    for h in [0.05, 0.5, 1.5] {
        let mut state: State<FreeTop<f64>> = start_by_velocity();
        for _ in 0..300 {
            state = march(&RungeKutta(Classical4), &problem, &state, h, 1);
            // Of the four components by half a unit each, of the factor, and of the sum.
            let defect = state.q.coords.norm_squared() - 1.0;
            assert!(defect.abs() < 8.0 * f64::EPSILON, "h = {h}: {defect:e}");
        }
    }
}

#[test]
fn it_agrees_with_methods_in_the_algebra() {
    let start = start_by_velocity();
    let problem = SystemProblem { system: &TOP, form: VelocityForm, input: TORQUE };
    let found = march(&RungeKutta(DormandPrince8), &problem, &start, 10.0, 500);
    let other = march(&Rkmk::new(&Tableau::VERNER_9), &problem, &start, 10.0, 400);
    // A walk of some ten roundings a step, carried on hardly larger.
    assert!(distance(&found, &other) < 10.0 * f64::EPSILON * 500_f64.sqrt(), "{:e}", distance(&found, &other));
}

#[test]
fn what_does_not_change_stays_to_the_last_bit() {
    let system: Coasting<Isometry3<f64>> = Coasting { push: VectorSpace::<f64>::zero(), drag: 0.0 };
    let (q, z): (Isometry3<f64>, _) = (se3::exp(&increment(1.0)), increment(2.0));
    let end = Simulation::new(&system).momentum_form().adaptive(1e-9, 1e-9).run_to_end(q, z, 0.0..30.0).expect("runs");
    assert_eq!(end.p, z);
}

#[test]
fn the_last_stage_is_the_first_of_the_next_step() {
    let problem = SystemProblem { system: &TOP, form: VelocityForm, input: TORQUE };
    let start = start_by_velocity();
    let step = RungeKutta(DormandPrince5).step(&problem, &start, &problem.rates(&start), 0.3).expect("steps");
    let (given, computed) = (step.rates.expect("comes with the step"), problem.rates(&step.state));
    assert!(given.configuration == computed.configuration && step.error.configuration.amax() > 0.0);
    // The time of the stage is rounded by itself.
    assert!((given.variables - computed.variables).amax() < 4.0 * f64::EPSILON);
}

#[test]
fn too_long_steps_and_broken_inputs_are_refused() {
    let fast = State { y: SVector::from([0.0, 0.0, 40.0]), ..start_by_velocity() };
    let problem = SystemProblem { system: &TOP, form: VelocityForm, input: NONE };
    let error = RungeKutta(DormandPrince8).step(&problem, &fast, &problem.rates(&fast), 0.1).err();
    assert!(matches!(error, Some(IntegrationErrorKind::IncrementTooLarge { angle }) if (angle - 4.0).abs() < 1e-12));
    let later = |t: f64, _: &UnitQuaternion<f64>, _: &SVector<f64, 3>| [if t > 0.09 { f64::NAN } else { 0.0 }; 3];
    let problem = SystemProblem { system: &TOP, form: VelocityForm, input: crate::integrate::Feedback(later) };
    let start = start_by_velocity();
    for kind in [
        RungeKutta(DormandPrince8).step(&problem, &start, &problem.rates(&start), 0.1).map(|step| step.state.t),
        RungeKutta(Verner9)
            .step_and_estimates(&problem, &start, &problem.rates(&start), 0.1)
            .map(|(step, _)| step.state.t),
    ] {
        assert_eq!(kind, Err(IntegrationErrorKind::NonFinite { part: RunPart::Step }));
    }
}

/// In single precision, and lane by lane as each lane by itself.
#[test]
fn other_scalars_run_too() {
    let start = start_by_velocity();
    let exact = Simulation::new(&TOP).input_from(NONE).fixed_step(0.05).run_to_end(start.q, start.y, 0.0..3.0);
    let exact = exact.expect("runs");
    let single = FreeTop { inertia: [0.5_f32, 0.85, 1.0] };
    let end = Simulation::new(&single)
        .input(|_, _: &UnitQuaternion<f32>, _: &SVector<f32, 3>| [0.0; 3])
        .control(Fixed::by(RungeKutta(Verner9), 0.05))
        .run_to_end(start.q.cast(), start.y.cast(), 0.0..3.0)
        .expect("runs");
    // Sixty steps of roundings of numbers up to 2, through sixteen stages with weights up to 30.
    assert!((end.z.cast::<f64>() - exact.z).amax() < 60.0 * 2.0 * f64::from(f32::EPSILON));

    let both = |x: f64| Lanes([x, x]);
    let pack = FreeTop { inertia: [Lanes([0.5, 0.6]), both(0.85), both(1.0)] };
    let attitude = UnitQuaternion::from_components(&SVector::from(start.q.components().data.0[0].map(both)));
    let end = Simulation::new(&pack)
        .input(|_, _: &_, _: &_| [both(0.0); 3])
        .fixed_step(both(0.05))
        .run_to_end(attitude, SVector::from(start.y.data.0[0].map(both)), both(0.0)..both(3.0))
        .expect("runs");
    assert_eq!(end.z.data.0[0].map(|x| x.0[0]), exact.z.data.0[0]);
}

/// A configuration of one's own: a rotation as its matrix R, body to observer.
#[derive(Clone, Copy, Debug)]
struct Rotation(SMatrix<f64, 3, 3>);

/// `ω̂`, the matrix of ω×.
fn hat(omega: &SVector<f64, 3>) -> SMatrix<f64, 3, 3> {
    omega.cross_matrix()
}

impl Configuration for Rotation {
    type Scalar = f64;
    type Tangent = SVector<f64, 3>;
    type Components = SVector<f64, 9>;

    fn retract(&self, tangent: &SVector<f64, 3>) -> Self {
        Self(self.0 * so3::exp(tangent).to_rotation_matrix().into_inner())
    }
    fn difference(&self, other: &Self) -> SVector<f64, 3> {
        let between = nalgebra::Rotation3::from_matrix_unchecked(self.0.transpose() * other.0);
        so3::log(&UnitQuaternion::from_rotation_matrix(&between))
    }
    fn dexp_inv(v: &SVector<f64, 3>, w: &SVector<f64, 3>) -> SVector<f64, 3> {
        so3::dexp_inv(v, w)
    }
    fn components(&self) -> SVector<f64, 9> {
        SVector::from_column_slice(self.0.as_slice())
    }
    fn from_components(components: &SVector<f64, 9>) -> Self {
        Self(SMatrix::from_column_slice(components.as_slice()))
    }
    fn component_rates(&self, velocity: &SVector<f64, 3>) -> SVector<f64, 9> {
        Self(self.0 * hat(velocity)).components()
    }
    fn tangent(&self, change: &SVector<f64, 9>) -> SVector<f64, 3> {
        let turned = self.0.transpose() * Self::from_components(change).0;
        let skew = (turned - turned.transpose()) * 0.5;
        SVector::from([skew[(2, 1)], skew[(0, 2)], skew[(1, 0)]])
    }
    fn is_finite(&self) -> bool {
        self.0.iter().all(|entry| entry.is_finite())
    }
    /// Newton's iteration for the nearest rotation, R ← R (3 − RᵀR)/2: twice, because its error is squared each time.
    fn renormalise(&self) -> Self {
        let closer = |matrix: SMatrix<f64, 3, 3>| {
            matrix * (SMatrix::<f64, 3, 3>::identity() * 1.5 - matrix.transpose() * matrix * 0.5)
        };
        Self(closer(closer(self.0)))
    }
    fn magnitude(&self, _: usize) -> f64 {
        1.0
    }
}

#[test]
fn a_configuration_of_your_own_runs_by_every_explicit_method() {
    let (push, drag, z) = (increment(3.0), 0.3, increment(2.0));
    let start: UnitQuaternion<f64> = so3::exp(&increment(5.0));
    let own = Rotation(start.to_rotation_matrix().into_inner());
    let (known, system) = (Coasting { push, drag }, Coasting { push, drag });
    let exact = Simulation::new(&known).adaptive(1e-13, 1e-13).run_to_end(start, z, 0.0..5.0).expect("runs");
    let run = Simulation::new(&system);
    for end in [
        run.adaptive(1e-12, 1e-12).run_to_end(own, z, 0.0..5.0),
        run.fixed_step(0.02).run_to_end(own, z, 0.0..5.0),
        run.control(Fixed::with(&Tableau::DORMAND_PRINCE_8, 0.02)).run_to_end(own, z, 0.0..5.0),
    ] {
        let end = end.expect("runs");
        let apart = end.q.0 - exact.q.to_rotation_matrix().into_inner();
        // Some fifty steps within 1e-12 each.
        assert!(apart.amax() < 5e-11 && end.z.add_scaled(-1.0, &exact.z).max_norm() < 5e-11, "{apart}");
        assert!((end.q.0.transpose() * end.q.0 - SMatrix::<f64, 3, 3>::identity()).amax() < 4.0 * f64::EPSILON);
    }
    order_on("matrices", (own, Rotation(start.inverse().to_rotation_matrix().into_inner())));
    type Pair = Product<SVector<f64, 9>, SVector<f64, 9>>;
    assert_eq!(<Pair as VectorSpace<f64>>::DIM, 18);
}

/// The bracket and the differential that a configuration has without writing them.
#[test]
fn a_configuration_of_your_own_has_a_bracket_and_the_differential_of_exp() {
    for size in [0.0, 1e-9, 0.3, 1.0, 2.0, 3.1] {
        let (axis, w): (SVector<f64, 3>, SVector<f64, 3>) = (increment(4.0), increment(6.0));
        let v = axis.normalize() * size;
        // 30 terms, of a sum of magnitudes of up to e^π |w|.
        let allowed = 30.0 * 23.0 * f64::EPSILON * w.norm();
        assert!((Rotation::dexp(&v)(&w) - so3::dexp(&v)(&w)).amax() <= allowed, "{size}");
        // The coefficient of ad² is some size²/12 of w, and cancels.
        assert!((Rotation::bracket(&v, &w) - so3::bracket(&v, &w)).amax() <= 8.0 * f64::EPSILON * w.norm(), "{size}");
    }
}
