//! Generated kernels run on any `Real`: packs give each lane's own bits, single precision agrees with double,
//! and dual numbers give exact derivatives with respect to parameters and states.

use crate::common::Bounded;
use crate::common::agreement::{equal, explore, largest};
use crate::common::body::{Body, Parts, Scene, duals, flow, list, rates, speeds};
use crate::common::dual::Dual;
use crate::common::parameters::{Parameters, parameters};
use crate::common::states::{Motion, State, state};
use gauss_runtime::chart::ChartError;
use gauss_runtime::prelude::*;
use proptest::prelude::*;
use proptest::test_runner::TestCaseError;

mod free {
    usual_charts!(everything, free);
}

mod planar {
    planar_charts!(everything);
}

/// The state of a motion in any scalar.
fn at<T: Real, K: Body<T>>(
    kernel: &K,
    make: impl Fn(usize, usize) -> T,
) -> Result<(K::Configuration, K::Speeds), ChartError> {
    let pose = Isometry3::assemble(&(0..7).map(|i| make(0, i)).collect::<Vec<_>>());
    let q = kernel.configuration(&pose)?;
    let twist = SVector::from(std::array::from_fn(|i| make(1, i)));
    let z = kernel.speeds(T::zero(), &q, &twist);
    Ok((q, z))
}

/// Pose parts and twist of a state by kind and index.
fn pick(state: &State, kind: usize, i: usize) -> f64 {
    match kind {
        0 if i < 4 => state.rotation[i],
        0 => state.position[i - 4],
        _ => state.twist[i],
    }
}

/// Every method's results, one after another.
fn everything_of<T: Real, K: Body<T>>(kernel: &K, q: &K::Configuration, z: &K::Speeds) -> Vec<T> {
    let t = T::zero();
    let acceleration = kernel.acceleration(t, q, z, &());
    let momentum = kernel.momentum(t, q, z);
    let matrix = kernel.mass_matrix(t, q);
    let mut all = q.parts();
    all.extend(list(z));
    all.extend(list(&acceleration));
    all.extend(list(&momentum));
    all.extend(list(&kernel.velocity(t, q, &momentum)));
    all.extend(list(&kernel.momentum_rate(t, q, &momentum, &())));
    all.extend((0..K::DOF).flat_map(|i| (0..K::DOF).map(move |j| (i, j))).map(|entry| matrix[entry]));
    all.extend([kernel.kinetic_energy(t, q, z), kernel.potential_energy(t, q)]);
    all.extend(list(&kernel.gauss_residual(t, q, z, z, &())));
    all.push(kernel.constraint_function(t, q, z, z, &()));
    all.extend(list(&kernel.kinematics(t, q, z)));
    all.extend(kernel.pose(t, q).parts());
    all.extend(list(&kernel.body_twist(t, q, z)));
    all.extend(list(&kernel.space_momentum(t, q, z)));
    all
}

/// Each lane of a pack gets the bits that it would get alone.
fn lanes_are_independent<S: Scene>(p: &Parameters, states: &[State; 2]) -> Result<(), TestCaseError> {
    let kernel = S::kernel::<f64>(p);
    let mut alone = Vec::new();
    for state in states {
        let Ok((q, z)) = at(&kernel, |kind, i| pick(state, kind, i)) else { return Ok(()) };
        alone.push(everything_of(&kernel, &q, &z));
    }
    let packed = S::kernel::<Lanes<f64, 2>>(p);
    let (q, z) = at(&packed, |kind, i| Lanes([pick(&states[0], kind, i), pick(&states[1], kind, i)]))
        .map_err(|error| TestCaseError::fail(error.to_string()))?;
    for (i, both) in everything_of(&packed, &q, &z).into_iter().enumerate() {
        for (lane, (packed, alone)) in both.0.iter().zip(&alone).enumerate() {
            prop_assert_eq!(packed.to_bits(), alone[i].to_bits(), "result {}, lane {}", i, lane);
        }
    }
    Ok(())
}

/// Single precision is double precision up to its own rounding, which the running bounds of double scale up to.
fn single_precision_agrees<S: Scene>(p: &Parameters, state: &State) -> Result<(), TestCaseError> {
    let kernel = S::kernel::<Bounded>(p);
    let Ok((q, z)) = state.of(&kernel) else { return Ok(()) };
    let wide = list(&kernel.acceleration(Bounded::zero(), &q, &z, &()));
    let kernel = S::kernel::<f32>(p);
    let Ok((q, z)) = at(&kernel, |kind, i| pick(state, kind, i) as f32) else { return Ok(()) };
    let narrow = list(&kernel.acceleration(0.0, &q, &z, &()));
    // Near singular points the bounds are nonlinear in ε.
    let scale = largest(&wide).max(1.0);
    let ratio = f64::from(f32::EPSILON) / f64::EPSILON;
    for (a, b) in wide.iter().zip(narrow) {
        let slack = 8.0 * ratio * a.bound;
        // Parameters and states are rounded to single precision first: eight times the bound of exact ones. Beyond a
        // thousandth of the scale a linear bound means nothing.
        if slack < 1e-3 * scale {
            prop_assert!((a.value - f64::from(b)).abs() <= slack + 64.0 * f64::from(f32::EPSILON) * scale);
        }
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn packs_work_lane_by_lane(p in parameters(), one in state(Motion::Free), other in state(Motion::Free)) {
        let states = [one, other];
        lanes_are_independent::<free::Left<()>>(&p, &states)?;
        lanes_are_independent::<free::Right<()>>(&p, &states)?;
        lanes_are_independent::<free::Hybrid<()>>(&p, &states)?;
        lanes_are_independent::<free::Zyx<()>>(&p, &states)?;
        lanes_are_independent::<free::Zxz<()>>(&p, &states)?;
        lanes_are_independent::<free::Modified<()>>(&p, &states)?;
    }

    #[test]
    fn planar_packs_work_lane_by_lane(p in parameters(), one in state(Motion::Planar), other in state(Motion::Planar)) {
        let states = [one, other];
        lanes_are_independent::<planar::Left<()>>(&p, &states)?;
        lanes_are_independent::<planar::Right<()>>(&p, &states)?;
        lanes_are_independent::<planar::Hybrid<()>>(&p, &states)?;
        lanes_are_independent::<planar::Jet<()>>(&p, &states)?;
    }

    #[test]
    fn single_precision_is_double_precision_rounded(p in parameters(), state in state(Motion::Free)) {
        single_precision_agrees::<free::Left<()>>(&p, &state)?;
        single_precision_agrees::<free::Right<()>>(&p, &state)?;
        single_precision_agrees::<free::Hybrid<()>>(&p, &state)?;
    }
}

/// ∂ż/∂m by dual parameters, against the derivative of the equations: `A ∂ż/∂m = −∂(residual at fixed ż)/∂m`.
#[test]
fn parameters_may_be_dual() {
    #[derive(GaussDynamics)]
    #[gauss(chart = hybrid)]
    struct Heavy<T> {
        #[gauss(mass)]
        mass: T,
        #[gauss(center_of_mass)]
        center: Vector3<T>,
        #[gauss(inertia)]
        inertia: Matrix3<T>,
        #[gauss(added_mass)]
        fluid: Matrix6<T>,
        #[gauss(gravity)]
        g: T,
    }
    explore(Motion::Free, 0.9, |p, state, tally| {
        let plain =
            Heavy::<Bounded> { mass: p.mass(), center: p.center(), inertia: p.inertia(), fluid: p.fluid(), g: p.g() };
        let mass = Dual::new(p.mass::<Bounded>(), Bounded::one());
        let varied = Heavy { mass, center: p.center(), inertia: p.inertia(), fluid: p.fluid(), g: p.g() };
        let (plain, varied) = (plain.kernel().expect("a body"), varied.kernel().expect("a body"));
        let (q, z) = state.of(&plain).expect("regular everywhere");
        let z_rate = plain.acceleration(Bounded::zero(), &q, &z, &());
        let still = |values: Vec<Bounded>| duals(&values, &vec![Bounded::zero(); values.len()]);
        let q_dual = Isometry3::assemble(&still(q.parts()));
        let z_dual: SVector<_, 6> = speeds(&still(list(&z)));
        let sensitivity = rates(&list(&varied.acceleration(Dual::zero(), &q_dual, &z_dual, &())));
        let fixed: SVector<_, 6> = speeds(&still(list(&z_rate)));
        let slope = rates(&list(&varied.gauss_residual(Dual::zero(), &q_dual, &z_dual, &fixed, &())));
        let matrix = plain.mass_matrix(Bounded::zero(), &q);
        let balance: Vec<Bounded> =
            (0..6).map(|i| (0..6).fold(slope[i], |sum, j| sum + matrix[(i, j)] * sensitivity[j])).collect();
        crate::common::agreement::zero("A ∂ż/∂m + ∂r/∂m", &balance)?;
        tally.count(&slope, largest(&slope));
        Ok(())
    });
}

/// The runtime's own `retract` in dual numbers moves a configuration as Ṙ = R [ω]×, ḃ = R u typed by hand say.
#[test]
fn retract_may_be_dual() {
    fn check<K: Body<Bounded>, D: Body<Dual<Bounded>>>(
        kernel: &K,
        (q, z): (&K::Configuration, &K::Speeds),
    ) -> Result<(), TestCaseError> {
        let velocity = kernel.kinematics(Bounded::zero(), q, z);
        let still = D::Configuration::assemble(&duals(&q.parts(), &vec![Bounded::zero(); q.parts().len()]));
        let mut step = <D::Configuration as Configuration>::Tangent::zero();
        for (i, &rate) in list(&velocity).iter().enumerate() {
            step.set_component(i, Dual::new(Bounded::zero(), rate));
        }
        let (moving, _) = flow::<_, K, D>(kernel, q, z, z);
        let found = rates(&still.retract(&step).parts());
        equal("d/dε q.retract(ε v)", &found, &rates(&moving.parts()))
    }
    explore(Motion::Free, 1.0, |p, state, tally| {
        let kernel = free::Left::<()>::kernel::<Bounded>(p);
        let (q, z) = state.of(&kernel).expect("regular everywhere");
        check::<_, <free::Left<()> as Scene>::Kernel<Dual<Bounded>>>(&kernel, (&q, &z))?;
        tally.count(&[Bounded::zero()], 1.0);
        Ok(())
    });
    explore(Motion::Planar, 1.0, |p, state, tally| {
        let kernel = planar::Left::<()>::kernel::<Bounded>(p);
        let (q, z) = state.of(&kernel).expect("regular everywhere");
        check::<_, <planar::Left<()> as Scene>::Kernel<Dual<Bounded>>>(&kernel, (&q, &z))?;
        tally.count(&[Bounded::zero()], 1.0);
        Ok(())
    });
}
