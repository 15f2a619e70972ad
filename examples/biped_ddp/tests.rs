//! The claims of the example `biped_ddp`: the gradient of the cost is that of differences, the cost falls from
//! iteration to iteration, the biped steps onto its goal by the laws of contact, and the picture is drawn.

use crate::model::Walker;
use crate::plan::{Looked, along, falls, guess, off, task};
use crate::{page, picture};

#[test]
fn a_plan_through_contacts_steps_onto_its_goal() {
    let (walker, task) = (Walker::new().unwrap(), task());
    let first = guess(&walker, &task).unwrap();
    for seed in 0..2 {
        let [exact, difference] = along(&walker, &task, &first, seed);
        // Differences of fourth order at h = 1e-5 N m. A cost of 30 is rounded to 30 · 180 ε = 1e-12 by its steps and
        // to some hundred times that by what steps amplify: 1e-10 over h of slopes above a thousand is 1e-8.
        assert!((exact / difference - 1.0).abs() < 1e-7, "{exact} {difference}");
    }
    let plan = task.solve(&walker, &first).unwrap();
    assert!(falls(&plan.costs), "{:?}", plan.costs);
    let [place, speed] = off(&plan.states[task.steps]);
    let [guessed, _] = off(task.way(&walker, &first).last().unwrap());
    assert!(place < 0.01 && speed < 0.05 && guessed > 5.0 * place, "{place} {speed} {guessed}");

    let looked = Looked::at(&walker, &plan.states, &plan.inputs).unwrap();
    // The laws are solved within 1e-12 of the largest rate, some m/s; feet are rounded at the size of a leg.
    assert!(looked.residual < 1e-11, "{}", looked.residual);
    assert!(looked.toes.iter().flatten().all(|[_, z]| *z > -1e-14));
    // The right foot leaves the ground and lands a stride ahead.
    let right = looked.changes(1);
    assert!(!right[0].1 && right[1].1, "{right:?}");
    let moved = looked.toes[task.steps - 1][1][0] - looked.toes[0][1][0];
    assert!((moved - 0.48).abs() < 0.02, "{moved}");
    assert!(picture::draw(&task, (&plan.states, &plan), &looked).unwrap().contains("The plan"));
    assert!(page::page(&walker, &plan, &looked).html().unwrap().starts_with("<!DOCTYPE html>"));
}
