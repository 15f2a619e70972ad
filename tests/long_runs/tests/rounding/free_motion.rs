//! Free bodies over up to 10⁶ steps of the exact motion and of the discrete one.

use gauss_exact::FreeMotion;
use gauss_exact::{FreeFlow, MoserVeselov};
use gauss_long_runs::steps;
use gauss_runtime::lie::so3;
use gauss_runtime::prelude::*;

use crate::testing::order::{TOP, start_by_momentum};

type State = (UnitQuaternion<f64>, Vector3<f64>);

const EPSILON: f64 = f64::EPSILON;

fn advance(motion: &impl FreeMotion<f64>, (q, y): State, h: f64) -> State {
    let turn = motion.turn(&y, h).expect("a regular step");
    (so3::renormalise(&(q * turn.rotation)), y + turn.change)
}

fn energy(i: [f64; 3], y: Vector3<f64>) -> f64 {
    0.5 * (0..3).map(|k| y[k] * y[k] / i[k]).sum::<f64>()
}

/// Rounding is of random sign: after n steps energy and momentum are off by some √n roundings, not n. Five times √n is
/// what one in a million walks exceeds; a step of the discrete method commits up to two roundings. The exact motion
/// rounds each component of y once a step, by ε/2 at most: energy by ε, with a deviation of ε/√3, of which four are
/// allowed.
#[test]
fn long_runs_do_not_drift() {
    let i = TOP.inertia;
    let first = start_by_momentum();
    let (first, y) = ((first.q, first.y), first.y);
    let check = |motion: &dyn Fn(State) -> State, steps: u32, roundings: f64| {
        let mut state = first;
        for _ in 0..steps {
            state = motion(state);
        }
        let bound = 10.0 * EPSILON * f64::from(steps).sqrt();
        let walk = roundings * EPSILON * f64::from(steps).sqrt();
        assert!((energy(i, state.1) / energy(i, y) - 1.0).abs() <= walk);
        assert!((state.1.norm() / y.norm() - 1.0).abs() <= walk);
        let space = |(q, y): State| q * y;
        assert!((space(state) - space(first)).amax() <= bound);
        assert!((state.0.coords.norm_squared() - 1.0).abs() <= 4.0 * EPSILON);
    };
    let discrete = MoserVeselov::new(i);
    check(&|state| advance(&discrete, state, 0.1), steps(1_000_000), 10.0);
    let exact = FreeFlow::new(i);
    check(&|state| advance(&exact, state, 0.1), steps(1_000_000), 4.0 / 3.0_f64.sqrt());
}
