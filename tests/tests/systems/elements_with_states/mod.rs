//! States of elements: against closed solutions and matrix exponentials; in every way to run, to linearize and to
//! differentiate; beside constraints, contacts and charts; and what refuses them.

mod beside;
mod closed;
mod derivatives;

use gauss_runtime::prelude::*;

/// A mass on a spring with a damper: a motor that follows its command late, through a filter that reads the speed.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x),
    input(command),
    linearize(parameters, inverse, hessian),
    particle(mass = m, position = [x, 0, 0]),
    states(force = (command - force) / lag, seen = (rate(x) - seen) / tau),
    spring(along = x, stiffness = k, damping = c),
    drive(motor, x = force - gain * seen)
)]
struct Servo<T> {
    m: T,
    k: T,
    c: T,
    lag: T,
    tau: T,
    gain: T,
}

impl<T: Real> Servo<T> {
    fn ordinary() -> Self {
        let [m, k, c, lag, tau, gain] = [1.5, 40.0, 0.3, 0.05, 0.2, 0.7].map(T::from_f64);
        Self { m, k, c, lag, tau, gain }
    }
}

/// Its matrix in (x, force, seen, v), and the column of the command.
fn matrix(servo: &Servo<f64>) -> (SMatrix<f64, 4, 4>, SVector<f64, 4>) {
    let Servo { m, k, c, lag, tau, gain } = *servo;
    let rows = SMatrix::from_row_slice(
        &[
            [0.0, 0.0, 0.0, 1.0],
            [0.0, -1.0 / lag, 0.0, 0.0],
            [0.0, 0.0, -1.0 / tau, 1.0 / tau],
            [-k / m, 1.0 / m, -gain / m, -c / m],
        ]
        .concat(),
    );
    (rows, SVector::from([0.0, 1.0 / lag, 0.0, 0.0]))
}
