//! Everything on, in single precision: the double-precision result, up to the bounds on rounding of the same program,
//! scaled.

use gauss_runtime::prelude::*;
use proptest::prelude::*;
use proptest::test_runner::{Config, TestCaseError, TestRunner};

use super::observed::{TIME, inputs};
use super::scenes::{Body, Loads, Scene, free, planar};
use crate::common::Bounded;
use crate::common::agreement::largest;
use crate::common::body::{Parts, list};
use crate::common::parameters::{Parameters, parameters};
use crate::common::states::{Motion, State, state};

/// The nearest multiple of 1/1024: then parameters, and what is made of them for what acts, are exact in single
/// precision.
fn coarse(x: f64) -> f64 {
    (x * 1024.0).round() / 1024.0
}

fn coarse_parameters(p: &Parameters) -> Parameters {
    Parameters {
        m: coarse(p.m),
        c: p.c.map(coarse),
        principal: p.principal.map(coarse),
        full: p.full.map(|row| row.map(coarse)),
        diagonal_fluid: p.diagonal_fluid.map(coarse),
        fluid: p.fluid.map(|row| row.map(coarse)),
        g: coarse(p.g),
        field: p.field.map(coarse),
        displaced: coarse(p.displaced),
        buoyancy: p.buoyancy.map(coarse),
    }
}

/// Accelerations and powers at a pose and speeds that are exact in single precision. The quaternion is of norm 1 up to
/// single precision, which is another configuration for the formulas, but the same one for both.
fn results<T: Real, K: Body<T> + ForcedSystem>(kernel: &K, state: &State) -> Option<Vec<T>> {
    let exact = |x: &f64| T::from_f64(f64::from(*x as f32));
    let parts: Vec<T> =
        state.rotation.iter().map(exact).chain(state.position.iter().map(|x| T::from_f64(coarse(*x)))).collect();
    let q = kernel.configuration(&Isometry3::assemble(&parts)).ok()?;
    let mut z = K::Speeds::zero();
    (0..K::DOF).for_each(|i| z.set_component(i, T::from_f64(coarse(state.twist[5 - i]))));
    let (t, input) =
        (T::from_f64(TIME), inputs::<T, K::Input>(&State { direction: state.direction.map(coarse), ..state.clone() }));
    let accelerations = list(&kernel.acceleration(t, &q, &z, &input));
    Some([accelerations, list(&kernel.powers(t, &q, &z, &input))].concat())
}

fn agrees<S: Scene>(p: &Parameters, state: &State) -> Result<u32, TestCaseError> {
    let p = coarse_parameters(p);
    let wide = results(&S::kernel::<Bounded>(&p, &Loads::of(&p)), state).expect("regular everywhere");
    let narrow = results(&S::kernel::<f32>(&p, &Loads::of(&p)), state).expect("regular everywhere");
    let (scale, ratio) = (largest(&wide).max(1.0), f64::from(f32::EPSILON) / f64::EPSILON);
    let mut judged = 0;
    for (a, b) in wide.iter().zip(narrow) {
        let bound = ratio * a.bound;
        // Beyond a thousandth of the scale a bound that is linear in ε means nothing. Products of inputs are rounded
        // once more.
        if bound < 1e-3 * scale {
            judged += 1;
            let allowed = 1.01 * bound + 16.0 * f64::from(f32::EPSILON) * scale;
            prop_assert!((a.value - f64::from(b)).abs() <= allowed, "{} {b}: {allowed:e}", a.value);
        }
    }
    Ok(judged)
}

#[test]
fn single_precision_is_double_precision_rounded() {
    let mut runner = TestRunner::new(Config { failure_persistence: None, ..Config::with_cases(128) });
    let judged = std::cell::Cell::new(0);
    let outcome =
        runner.run(&(parameters(), state(Motion::Free), state(Motion::Planar)), |(p, free_state, planar_state)| {
            let count = agrees::<free::Left<()>>(&p, &free_state)?
                + agrees::<free::Right<()>>(&p, &free_state)?
                + agrees::<free::Hybrid<()>>(&p, &free_state)?
                + agrees::<planar::Left<()>>(&p, &planar_state)?;
            judged.set(judged.get() + count);
            Ok(())
        });
    outcome.unwrap_or_else(|failure| panic!("{failure}"));
    // Of six accelerations and twenty powers in each chart most must be judged.
    assert!(judged.get() > 128 * 4 * 15, "{}", judged.get());
}
