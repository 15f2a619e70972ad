//! Derivatives of runs of Radau's method in dual numbers, beside those of an explicit method with a small tolerance.

use gauss_runtime::dual::Dual;
use gauss_runtime::integrate::Radau;
use gauss_runtime::prelude::*;

use super::scenes::Penalty;

#[test]
fn derivatives_are_as_exact_as_the_numbers_that_carry_them() {
    let number = Dual::<1>::from_f64;
    let kernel = Penalty { k: number(1e4), c: number(20.0), g: Dual::variable(9.81, 0) }.kernel().expect("a pendulum");
    let (q, z) = (SVector::from([1.0, 0.0].map(number)), SVector::from([0.3, 0.0].map(number)));
    let run = || Simulation::new(&kernel);
    let interval = || number(0.0)..number(2.0);
    let exact = run().adaptive(1e-12, 1e-13).run_to_end(q, z, interval()).expect("runs").q;
    for tolerance in [1e-4, 1e-6, 1e-8] {
        let end = run().control(Adaptive::by(Radau, tolerance, tolerance)).run_to_end(q, z, interval()).expect("runs");
        let off = |of: fn(&Dual<1>) -> f64| (0..2).map(|i| (of(&end.q[i]) - of(&exact[i])).abs()).fold(0.0, f64::max);
        let [value, slope] = [off(|x| x.value), off(|x| x.slopes[0])];
        println!("{tolerance:e}: {} steps, off by {value:e}, derivatives by {slope:e}", end.summary.steps);
        // Newton's iteration ends by the numbers, whose derivatives come a sweep behind. They are of the size of these.
        assert!(slope < 10.0 * value, "{tolerance:e}: {slope:e} {value:e}");
    }
}
