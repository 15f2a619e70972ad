//! Pairs of configurations, nested: a run of a product is the runs of its factors, to the last bit.

use nalgebra::{Isometry3, Quaternion, SVector, UnitQuaternion};

use super::*;
use crate::configuration::{Configuration, Product, VectorSpace};
use crate::lie::{se3, so3};
use crate::monitor::monitor;
use crate::private::product;
use crate::real::Real;
use crate::simd::Lanes;
use crate::testing::coasting::{Coasting, increment};

/// Configuration of systems with coordinates `pose: Pose, attitude: Rotation, x, y`.
type Mixed<T> = (Isometry3<T>, (UnitQuaternion<T>, SVector<T, 2>));

fn start<T: Real>() -> Mixed<T> {
    let rotation = so3::exp(&increment(5.0));
    (se3::exp(&increment(1.0)), (rotation, increment(7.0)))
}

fn parts<T: Real>(z: &<Mixed<T> as Configuration>::Tangent) -> (SVector<T, 6>, SVector<T, 3>, SVector<T, 2>) {
    (z.first, z.second.first, z.second.second)
}

/// The end of a run of one factor.
fn run<C: Configuration>(q: C, z: C::Tangent, push: C::Tangent, on_components: bool) -> Sample<Coasting<C>> {
    let number = C::Scalar::from_f64;
    let system = Coasting { push, drag: number(0.3) };
    let (run, step, span) = (Simulation::new(&system), number(0.1), number(0.0)..number(2.0));
    if on_components {
        run.control(Fixed::by(RungeKutta(DormandPrince8), step)).run_to_end(q, z, span)
    } else {
        run.control(Fixed::with(&Tableau::RK4, step)).run_to_end(q, z, span)
    }
    .expect("runs")
    .sample
}

fn factors_run_by_themselves<T: Real>() {
    let (q, z, push) = (start::<T>(), increment(2.0), increment(3.0));
    let ((z1, z2, z3), (f1, f2, f3)) = (parts(&z), parts(&push));
    for on_components in [false, true] {
        let whole = run(q, z, push, on_components);
        let pose = run(q.0, z1, f1, on_components);
        let (attitude, point) = (run(q.1.0, z2, f2, on_components), run(q.1.1, z3, f3, on_components));
        assert_eq!(crate::private::isometry3(&whole.q.0), crate::private::isometry3(&pose.q));
        assert_eq!(crate::private::quaternion(&whole.q.1.0), crate::private::quaternion(&attitude.q));
        assert_eq!(crate::private::components(&whole.q.1.1), crate::private::components(&point.q));
        assert_eq!(whole.z, product(pose.z, product(attitude.z, point.z)));
    }
}

#[test]
fn a_product_runs_as_its_factors_do_in_every_scalar() {
    factors_run_by_themselves::<f64>();
    factors_run_by_themselves::<f32>();
    factors_run_by_themselves::<Lanes<f64, 2>>();
}

#[test]
fn trajectories_and_monitors_of_products() {
    // Constant speeds: q₀ ∘ exp(t z) at any time, and no change of energy.
    let (q, z) = (start::<f64>(), increment::<<Mixed<f64> as Configuration>::Tangent, f64>(2.0));
    let system: Coasting<Mixed<f64>> = Coasting { push: VectorSpace::<f64>::zero(), drag: 0.0 };
    // For methods in the algebra that is no approximation.
    let (steps, pair) = (Fixed::with(&Tableau::RK4, 0.25), Adaptive::with(&Tableau::DORMAND_PRINCE_5, 1e-8, 1e-8));
    for (form, run) in [
        ("fixed", Simulation::new(&system).control(steps).run(q, z, 0.0..2.0)),
        ("adaptive", Simulation::new(&system).control(pair).run(q, z, 0.0..2.0)),
        ("momenta", Simulation::new(&system).momentum_form().control(pair).run(q, z, 0.0..2.0)),
    ] {
        let trajectory = run.expect("runs");
        assert_eq!(monitor(&system, &trajectory).energy.largest(), 0.0, "{form}");
        for t in [0.0, 0.3, 1.234, 2.0] {
            let found = trajectory.at(t).expect("inside");
            // Eight steps, each with the rounding of an exponential and a product of numbers of order 1.
            let error = found.q.difference(&q.retract(&z.scale(t))).max_norm();
            assert!(error < 8.0 * 4.0 * f64::EPSILON, "{form}, {t}: {error:e}");
        }
    }
}

#[test]
fn what_is_asked_of_a_configuration_reaches_every_factor() {
    let q = start::<f64>();
    assert!(Configuration::is_finite(&q));
    type Tangent = Product<SVector<f64, 6>, Product<SVector<f64, 3>, SVector<f64, 2>>>;
    assert_eq!(<Tangent as VectorSpace<f64>>::DIM, 11);
    for i in 0..11 {
        let mut bad: Tangent = VectorSpace::<f64>::zero();
        VectorSpace::<f64>::set_component(&mut bad, i, f64::NAN);
        assert!(!VectorSpace::<f64>::is_finite(&bad));
        assert!(!Configuration::is_finite(&q.retract(&bad)), "component {i}");
    }

    let stretched = |q: &UnitQuaternion<f64>| UnitQuaternion::new_unchecked(Quaternion::from(q.coords * 1.001));
    let off: Mixed<f64> =
        (Isometry3 { rotation: stretched(&q.0.rotation), translation: q.0.translation }, (stretched(&q.1.0), q.1.1));
    let back = (0..4).fold(off, |q, _| q.renormalise());
    assert!((back.0.rotation.coords - q.0.rotation.coords).amax() < 2.0 * f64::EPSILON);
    assert!((back.1.0.coords - q.1.0.coords).amax() < 2.0 * f64::EPSILON);
    assert_eq!((back.0.translation, back.1.1), (q.0.translation, q.1.1));

    let distance = q.0.translation.vector.norm();
    for (i, expected) in [distance, distance, distance, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, q.1.1[0].abs(), q.1.1[1].abs()]
        .into_iter()
        .enumerate()
    {
        assert!((q.magnitude(i) - expected).abs() <= f64::EPSILON * expected, "component {i}");
    }
    // The largest angle over the factors: components 3..6 and 6..9.
    let mut turn: Tangent = VectorSpace::<f64>::zero();
    for (i, angle) in [(0, 9.0), (4, 0.5), (7, 0.75), (9, 8.0)] {
        VectorSpace::<f64>::set_component(&mut turn, i, angle);
    }
    assert_eq!(Mixed::<f64>::increment_angle(&turn), 0.75);
}
