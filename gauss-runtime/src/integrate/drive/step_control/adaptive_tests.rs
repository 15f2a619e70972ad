//! Estimates and tolerances of adaptive steps.

use super::*;
use crate::integrate::{DormandPrince5, Simulation, SystemProblem, VelocityForm, Verner9};
use crate::testing::FreeTop;
use crate::testing::order::{TOP, TORQUE, distance, fitted_order, march, start_by_velocity};

/// Over some states of a motion together, because where a leading term vanishes the slope says nothing.
#[test]
fn estimates_go_with_the_power_that_the_control_takes() {
    fn measured(method: impl EstimatingStep<FreeTop<f64>>) -> (f64, f64) {
        let control = Adaptive::by(method, 0.0, 1.0);
        let problem = SystemProblem { system: &TOP, form: VelocityForm, input: TORQUE };
        let points = [0.05, 0.065, 0.08, 0.1].map(|h| {
            let mut start: State<FreeTop<f64>> = start_by_velocity();
            let mut sum = 0.0;
            for _ in 0..20 {
                start = march(&control.method, &problem, &start, 0.5, 5);
                let rates = problem.rates(&start);
                let (step, coarse) = control.method.step_and_estimates(&problem, &start, &rates, h).expect("steps");
                sum += control.tolerance.error(
                    &Trial { from: &start, to: &step.state, length: h, floor: None },
                    &step.error,
                    coarse.as_ref(),
                );
            }
            (h, sum)
        });
        // The sum of twenty estimates, each of steps a tenth long and less.
        (control.method.estimate_order(), fitted_order(&points, f64::EPSILON))
    }
    for (stated, found) in [
        measured(Rkmk::new(&Tableau::DORMAND_PRINCE_5)),
        measured(Rkmk::new(&Tableau::DORMAND_PRINCE_8)),
        measured(Rkmk::new(&Tableau::VERNER_9)),
        measured(RungeKutta(DormandPrince5)),
        measured(RungeKutta(DormandPrince8)),
        measured(RungeKutta(Verner9)),
    ] {
        assert!((found - stated).abs() < 0.5, "{found} instead of {stated}");
    }
}

/// Down to rounding, the pairs of orders 8 and 9 stay within a few tolerances and take fewer evaluations than order 5,
/// the more so the smaller the tolerance.
#[test]
fn high_orders_keep_the_tolerance_for_less() {
    fn run(method: impl EstimatingStep<FreeTop<f64>>, stages: usize, tolerance: f64) -> (f64, usize, usize) {
        let start = start_by_velocity();
        let control = Adaptive::by(method, tolerance, tolerance);
        let run = Simulation::new(&TOP).input_from(TORQUE).control(control).run(start.q, start.y, 0.0..10.0);
        let run = run.expect("runs");
        let end = run.last();
        let problem = SystemProblem { system: &TOP, form: VelocityForm, input: TORQUE };
        let exact = march(&Rkmk::new(&Tableau::VERNER_9), &problem, &start, 10.0, 1000);
        let steps = run.len() - 1;
        (distance(&State { t: end.t, q: end.q, y: end.z }, &exact), steps, steps * stages)
    }
    for tolerance in [1e-6, 1e-8, 1e-10, 1e-12] {
        for [five, eight, nine] in [
            [
                run(Rkmk::new(&Tableau::DORMAND_PRINCE_5), 6, tolerance),
                run(Rkmk::new(&Tableau::DORMAND_PRINCE_8), 12, tolerance),
                run(Rkmk::new(&Tableau::VERNER_9), 16, tolerance),
            ],
            [
                run(RungeKutta(DormandPrince5), 6, tolerance),
                run(RungeKutta(DormandPrince8), 12, tolerance),
                run(RungeKutta(Verner9), 16, tolerance),
            ],
        ] {
            // Errors of steps add up, and are carried on about as large; sizes are up to 2.
            for (error, steps, _) in [five, eight, nine] {
                assert!(error < 3.0 * steps as f64 * tolerance, "{tolerance:e}: {error:e} in {steps} steps");
            }
            assert!(eight.2 < five.2 && nine.2 < five.2, "{tolerance:e}: {} {} {}", five.2, eight.2, nine.2);
            if tolerance == 1e-12 {
                assert!(3 * eight.2 < five.2 && nine.2 < eight.2, "{} {} {}", five.2, eight.2, nine.2);
            }
        }
    }
}
