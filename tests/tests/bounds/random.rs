//! One body: thousands of random scenes, from everyday sizes to sizes spread over many decades, far from Ω and fast.

use gauss_runtime::prelude::*;
use gauss_tests::double_double::DoubleDouble;
use proptest::strategy::{Strategy, ValueTree};
use proptest::test_runner::TestRunner;

use crate::common::Bounded;
use crate::common::body::{Parts, Scene, list};
use crate::common::parameters::{Parameters, parameters};
use crate::common::states::{Motion, State, state};
use crate::compare::{self, Excess, Random};

/// The same body in units of its own: masses times `mass`, lengths times `length`, the fluid denser by `fluid`.
fn in_units(p: &Parameters, mass: f64, length: f64, fluid: f64) -> Parameters {
    let inertia = mass * length * length;
    let unit = |i: usize| if i < 3 { 1.0 } else { length };
    Parameters {
        m: mass * p.m,
        c: p.c.map(|x| length * x),
        principal: p.principal.map(|x| inertia * x),
        full: p.full.map(|row| row.map(|x| inertia * x)),
        diagonal_fluid: std::array::from_fn(|i| mass * fluid * (unit(i) * unit(i)) * p.diagonal_fluid[i]),
        fluid: std::array::from_fn(|i| std::array::from_fn(|j| mass * fluid * (unit(i) * unit(j)) * p.fluid[i][j])),
        displaced: mass * fluid * p.displaced,
        buoyancy: p.buoyancy.map(|x| length * x),
        ..*p
    }
}

fn spread(random: &mut Random, parameters: &Parameters, state: &State) -> (Parameters, State) {
    let parameters =
        in_units(parameters, random.decades(-4.0, 4.0), random.decades(-3.0, 3.0), random.decades(-3.0, 4.0));
    let (far, fast, spin) = (random.decades(-2.0, 6.0), random.decades(-2.0, 3.0), random.decades(-2.0, 3.0));
    let mut state = state.clone();
    state.position = state.position.map(|x| far * x);
    for i in 0..3 {
        state.twist[i] *= fast;
        state.twist[i + 3] *= spin;
    }
    (parameters, state)
}

/// A scene at a state, in the variables of its chart; none where its coordinates are singular.
pub fn holds<S: Scene>(what: &str, parameters: &Parameters, state: &State, step: Option<f64>, excess: &mut Excess) {
    let kernel = S::kernel::<f64>(parameters);
    let parts = state.pose().parts().iter().map(|x| x.value).collect::<Vec<_>>();
    let Ok(q) = kernel.configuration(&Isometry3::assemble(&parts)) else { return };
    let z = list(&kernel.speeds(0.0, &q, &SVector::from(state.twist)));
    let kernels = (&kernel, &S::kernel::<Bounded>(parameters), &S::kernel::<DoubleDouble>(parameters));
    compare::holds(what, kernels, (&list(&q.components()), &z), step, excess);
}

/// Random bodies and states, `count` of everyday sizes and `count` that are spread.
fn explore(count: usize, motion: Motion, mut check: impl FnMut(&Parameters, &State, &mut Excess), what: &str) {
    let mut runner = TestRunner::deterministic();
    let mut random = Random(7);
    let drawn = (parameters(), state(motion));
    let (mut everyday, mut far) = (Excess::default(), Excess::default());
    for _ in 0..count {
        let (parameters, state) = drawn.new_tree(&mut runner).expect("a scene").current();
        check(&parameters, &state, &mut everyday);
        let (parameters, state) = spread(&mut random, &parameters, &state);
        check(&parameters, &state, &mut far);
    }
    // Bounds are worst cases of some hundred roundings, of which errors are the sum with random signs: √n short of it,
    // about.
    assert!(everyday.report(&format!("{what}, everyday")) < 200.0);
    far.report(&format!("{what}, spread"));
}

macro_rules! charts {
    ($motion:ident, $count:literal: $($chart:ident)+) => {
        #[test]
        fn bounds_hold() {
            super::explore(
                $count,
                super::Motion::$motion,
                |parameters, state, excess| {
                    $(super::holds::<$chart<()>>(stringify!($chart), parameters, state, None, excess);)+
                },
                module_path!(),
            );
        }
    };
}

mod everything_free {
    usual_charts!(everything, free);
    charts!(Free, 200: Left Right Hybrid Zyx Zxz Modified);
}

mod heavy_free {
    usual_charts!(heavy, free);
    charts!(Free, 200: Left Right Hybrid Zyx Zxz Modified);
}

mod torpedo_free {
    usual_charts!(torpedo, free);
    charts!(Free, 200: Left Right Hybrid Zyx Zxz Modified);
}

mod heavy_fixed_point {
    usual_charts!(heavy, fixed_point);
    charts!(FixedPoint, 200: Left Right Hybrid Zyx Zxz Modified);
}

mod afloat_planar {
    planar_charts!(afloat);
    charts!(Planar, 200: Left Right Hybrid Jet);
}
