//! Boxed simulations do what those do that they were made of, run after run.

use core::cell::Cell;

use nalgebra::SVector;

use super::*;
use crate::integrate::{Crossing, Sample, Simulation};
use crate::testing::coasting::Coasting;

type Pair = SVector<f64, 2>;
type Particle = Coasting<Pair>;

/// A field, whose type is written.
struct Model<'k> {
    simulation: BoxedSimulation<'k, Particle>,
}

/// Under weight.
const PARTICLE: Particle = Coasting { push: Pair::new(0.0, -9.81), drag: 0.1 };

const START: (Pair, Pair) = (Pair::new(0.0, 1.0), Pair::new(0.5, 0.0));

fn numbers(samples: &[Sample<Particle>]) -> alloc::vec::Vec<[f64; 7]> {
    samples.iter().map(|s| [s.t, s.q[0], s.q[1], s.z[0], s.z[1], s.p[0], s.p[1]]).collect()
}

#[test]
fn a_field_runs_like_the_simulation_it_was_made_of() {
    let (seen, jumps) = (Cell::new(0), Cell::new(0));
    let simulation = || {
        Simulation::new(&PARTICLE)
            .observe(|_| seen.set(seen.get() + 1))
            .event(Crossing::Falling, |_, q: &Pair, _| q[1])
            .then(|state| {
                jumps.set(jumps.get() + 1);
                state.z[1] *= -0.8;
            })
            .until(Crossing::Rising, |_, q: &Pair, _| q[0] - 0.5)
            .every(2)
            .adaptive(1e-9, 1e-9)
    };
    let (q0, z0) = START;
    let direct = simulation().run(q0, z0, 0.0..3.0).expect("runs");
    assert_eq!((direct.stopped_by(), direct.events().len()), (Some(1), jumps.get() + 1));
    let counts = (seen.take(), jumps.take());
    assert!(counts.0 > 3 && counts.1 > 0, "{counts:?}");

    let mut model = Model { simulation: simulation().boxed() };
    // The second run begins anew: nothing is left of the events of the first.
    for _ in 0..2 {
        let run = model.simulation.run(q0, z0, 0.0..3.0).expect("runs");
        assert_eq!(numbers(run.samples()), numbers(direct.samples()));
        assert_eq!((run.stopped_by(), run.summary()), (direct.stopped_by(), direct.summary()));
        assert_eq!((seen.take(), jumps.take()), counts);
        let between = |run: &Trajectory<'_, Particle>| run.at(0.123).map(|sample| numbers(&[sample]));
        assert_eq!(between(&run), between(&direct));
        let end = model.simulation.run_to_end(q0, z0, 0.0..3.0).expect("runs");
        assert_eq!(numbers(&[end.sample]), numbers(&[*direct.last()]));
        assert_eq!((end.stopped_by, end.summary), (direct.stopped_by(), *direct.summary()));
        assert_eq!((seen.take(), jumps.take()), counts);
    }
}

#[test]
fn limits_and_errors_are_those_of_the_simulation() {
    let (q0, z0) = START;
    let simulation = || Simulation::new(&PARTICLE).max_steps(7).fixed_step(0.125);
    let (path, error) = simulation().boxed().attempt(q0, z0, 0.0..1.0);
    let (expected, reason) = simulation().attempt(q0, z0, 0.0..1.0);
    assert_eq!(numbers(path.samples()), numbers(expected.samples()));
    let (error, reason) = (error.expect("eight steps"), reason.expect("eight steps"));
    assert_eq!((error.time, error.kind), (reason.time, reason.kind));
    assert!(simulation().boxed().run(q0, z0, 0.0..1.0).is_err());
    let end = simulation().boxed().run_to_end(q0, z0, 0.0..0.875).expect("seven steps");
    assert_eq!(numbers(&[end.sample]), numbers(&[*simulation().run(q0, z0, 0.0..0.875).expect("seven").last()]));
}
