//! The claims of the example `hop_mpc`: derivatives of steps are those of differences, in flight and on the ground;
//! plans keep the leg hopping after a blow, the thrusts of the model alone do not.

use crate::model::{HALF, Model, by_plans, run, thrusts, wanted};
use crate::plan::{Plant, State};

#[test]
fn derivatives_of_steps_are_those_of_differences() {
    let model = Model::new(4.0).unwrap();
    // In the air, and on the ground, where the foot stays.
    for (t, thrust, stands) in [(0.4 * HALF, 3.0, false), (1.5 * HALF, 80.0, true)] {
        let x = wanted(t);
        let (by_state, by_input) = model.linear(&x, thrust).unwrap();
        let apart = |dx: State, du: f64| {
            let [there, back] = [1.0, -1.0].map(|way| model.step(&(x + dx * way), thrust + du * way).unwrap());
            there - back
        };
        // Equations are linear within a mode: central differences are rounded, some ε over 2 h.
        let h = 1e-3;
        let near = |found: State, slope: State| (found / (2.0 * h) - slope).amax() < 1e-12;
        assert!(near(apart(State::zeros(), h), by_input), "{t}");
        for k in 0..4 {
            let aside = State::from_fn(|i, _| match (stands, k) {
                // On the ground height and length change together: a gap that opens is another mode.
                (true, 0 | 2) if i == k || i == k + 1 => h,
                (false, _) if i == k => h,
                _ => 0.0,
            });
            assert!(near(apart(aside, 0.0), by_state * aside / h), "{t} {k}");
        }
        assert_eq!(by_input[0] != by_input[1], !stands);
    }
}

#[test]
fn plans_hop_on_after_a_blow_and_thrusts_alone_do_not() {
    let model = Model::new(4.0).unwrap();
    let thrusts = thrusts(&model, 320).unwrap();
    let planned = by_plans(&model, 320, &thrusts, |_| {}).unwrap();
    let apex = wanted(0.5 * HALF)[0];
    // The plant is a tenth heavier than the model, so that hops are lower than wanted, before the blow and after it
    // alike.
    assert!(planned.off < 0.05 && planned.apexes.len() >= 5, "{} {:?}", planned.off, planned.apexes);
    let (first, last) = (planned.apexes[0], planned.apexes[planned.apexes.len() - 1]);
    assert!((last - apex).abs() < 0.05 && (last - first).abs() < 1e-3, "{:?} {apex}", planned.apexes);
    // A thrust that is made for a lighter body.
    let replayed = run(320, |n, _| thrusts.get(n).copied());
    assert!(replayed.map_or(true, |run| run.off > 5.0 * planned.off));
}
