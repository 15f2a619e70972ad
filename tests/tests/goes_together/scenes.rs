//! Scenes of two numbers, one for each thing that a scene may hold.

use std::f64::consts::FRAC_PI_4;

use gauss_runtime::prelude::*;
use gauss_sensitivity::{At, Cost, InputOf, Run, Start};

/// A run of one second by two numbers: a parameter, and a size of the start. Its cost is the first speed at the end.
pub trait Scene: Cost<2> + Copy + Sync {
    const NUMBERS: [f64; 2];
}

/// Implements the traits of a scene: its numbers, kernel, start and, where it has one, input.
macro_rules! scene {
    (
        $(#[$doc:meta])* $name:ident of $kernel:ident, $numbers:expr,
        |$number:ident, $of_start:ident| $system:expr, $start:expr $(, |$at:ident| $input:expr)?
    ) => {
        $(#[$doc])*
        #[derive(Clone, Copy)]
        pub struct $name;

        impl Scene for $name {
            const NUMBERS: [f64; 2] = $numbers;
        }

        impl Run<2> for $name {
            type System<T: Real> = $kernel<T>;

            fn instants(&self) -> &[f64] {
                &[0.0, 1.0]
            }

            fn system<T: Real>(&self, &[$number, _]: &[T; 2]) -> Result<$kernel<T>, ParameterError> {
                $system.kernel()
            }

            fn start<T: Real>(&self, &[$number, $of_start]: &[T; 2], _: &$kernel<T>) -> Start<$kernel<T>> {
                let _ = $number;
                $start
            }

            $(fn input<T: Real>(&self, _: &[T; 2], $at: &At<'_, $kernel<T>>) -> InputOf<$kernel<T>> {
                $input
            })?
        }

        impl Cost<2> for $name {
            fn cost<T: Real>(&self, _: &[T; 2], at: &At<'_, $kernel<T>>) -> T {
                if at.number == 1 { at.z[0] } else { T::zero() }
            }
        }
    };
}

fn vector<T: Real, const N: usize>(numbers: [T; N]) -> SVector<T, N> {
    SVector::from(numbers)
}

/// A bob on a rod, by its place.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y), linearize,
    particle(mass = 2, position = [x, 0, y]), constraint(position = x * x + y * y - l * l),
)]
pub struct Bob<T> {
    l: T,
    #[gauss(gravity)]
    g: T,
}

scene! {
    /// Constraints with multipliers.
    Constrained of BobKernel, [0.7, FRAC_PI_4],
    |l, angle| Bob { l, g: Real::from_f64(9.81) },
    (vector([l * angle.sin(), -l * angle.cos()]), vector([T::zero(); 2]))
}

/// The same on two rods at the same place.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y), linearize,
    particle(mass = 2, position = [x, 0, y]),
    constraint(position = x * x + y * y - l * l), constraint(position = 3 * (x * x + y * y - l * l)), redundant,
)]
pub struct TwoRods<T> {
    l: T,
    #[gauss(gravity)]
    g: T,
}

scene! {
    /// Constraints that depend on one another.
    Redundant of TwoRodsKernel, [0.7, FRAC_PI_4],
    |l, angle| TwoRods { l, g: Real::from_f64(9.81) },
    (vector([l * angle.sin(), -l * angle.cos()]), vector([T::zero(); 2]))
}

/// A mass on a spring, whose motor follows it late.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x), linearize,
    particle(mass = 1.5, position = [x, 0, 0]), spring(along = x, stiffness = 40, damping = 0.3),
    states(force = (-5 * x - force) / lag), drive(motor, x = force),
)]
pub struct Late<T> {
    lag: T,
}

scene! {
    /// States of elements.
    Stateful of LateKernel, [0.05, 0.3],
    |lag, x| Late { lag },
    (vector([x, T::zero()]), vector([T::zero()]))
}

/// A beam on a hinge, which stretches as it turns.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(angle, s), linearize, taylor,
    body(beam, rotation = rotation_z(angle), mass = 2, center_of_mass = [0.5, 0, 0], inertia = [0, 2 / 3, 2 / 3]),
    modes(beam, coordinates = [s], translation = [[1.25, 0, 0]], mass = [34 / 35], stiffness = [k],
        inertia = [[0, 1.6, 1.6, 0, 0, 0]]),
)]
pub struct Beam<T> {
    k: T,
}

scene! {
    /// Bodies that bend.
    Bending of BeamKernel, [300.0, 2.0],
    |k, rate| Beam { k },
    (vector([T::zero(), T::from_f64(0.02)]), vector([rate, T::zero()]))
}

/// A hull on a spring whose fuel leaves by a nozzle beside its axis.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, angle), linearize, taylor,
    body(hull, position = [x, 0, 0], rotation = rotation_z(angle), mass = 2 - 0.5 * t, center_of_mass = [0.1 * t, 0, 0],
        inertia = [1, 1, 1 - 0.3 * t]),
    mass_flow(jet, body = hull, at = [-0.4, 0.1, 0], velocity = [-c, 0, 0]), spring(along = x, stiffness = 4),
)]
pub struct Hull<T> {
    c: T,
}

scene! {
    /// Mass that varies.
    Burning of HullKernel, [3.0, 0.8],
    |c, rate| Hull { c },
    (vector([T::from_f64(0.2), T::zero()]), vector([T::zero(), rate]))
}

/// A line through places unevenly far apart.
pub const PULL: [[f64; 2]; 5] = [[-2.0, -3.0], [-0.5, -0.75], [0.0, 0.0], [0.75, 1.125], [2.0, 3.0]];

/// A mass on a spring by a table.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x), linearize, particle(mass = 1.5, position = [x, 0, 0]),
    table(pull, points = PULL, kind = cubic), drive(x = -c * pull(x)),
)]
pub struct ByPoints<T> {
    c: T,
}

scene! {
    /// A table of one number.
    TableOfOne of ByPointsKernel, [3.0, 0.8],
    |c, x| ByPoints { c },
    (vector([x]), vector([T::zero()]))
}

pub const X: [f64; 4] = [-2.0, -0.2, 0.5, 2.0];
pub const V: [f64; 3] = [-3.0, 0.4, 4.0];
/// −4 x − 0.5 v, which interpolation between corners gives to rounding.
pub const DRAG: [[f64; 3]; 4] = {
    let mut values = [[0.0; 3]; 4];
    let mut i = 0;
    while i < 12 {
        values[i / 3][i % 3] = -4.0 * X[i / 3] - 0.5 * V[i % 3];
        i += 1;
    }
    values
};

/// A mass on a spring with a damper, both by one table.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x), linearize, particle(mass = 1.5, position = [x, 0, 0]),
    table(drag, axes = [X, V], values = DRAG, kind = hermite), drive(x = c * drag(x, rate(x))),
)]
pub struct ByCorners<T> {
    c: T,
}

scene! {
    /// A table of two numbers.
    TableOfTwo of ByCornersKernel, [1.2, 0.8],
    |c, x| ByCorners { c },
    (vector([x]), vector([T::zero()]))
}

/// A mass on a spring that is pushed.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x), input(push), linearize, particle(mass = 1.5, position = [x, 0, 0]),
    spring(along = x, stiffness = k), drive(x = push),
)]
pub struct Pushed<T> {
    pub k: T,
}

scene! {
    /// An input by a function of time and state.
    Input of PushedKernel, [20.0, 0.3],
    |k, x| Pushed { k },
    (vector([x]), vector([T::zero()])),
    |at| vector([(at.t + at.t).sin() - at.z[0] * T::from_f64(0.1)])
}

/// A recording: the push every quarter of a second, straight in between.
const RECORD: [f64; 5] = [0.0, 2.0, -1.0, 0.5, 1.5];

/// The push of a recording at a time, in each lane by its own interval.
pub fn recorded<T: Real>(t: T) -> T {
    let line = |from: usize| {
        let part = t * T::from_f64(4.0) - T::from_f64(from as f64);
        T::from_f64(RECORD[from]) + part * T::from_f64(RECORD[from + 1] - RECORD[from])
    };
    (0..3).rev().fold(line(3), |later, from| T::select_lt(t, T::from_f64(0.25 * (from + 1) as f64), line(from), later))
}

scene! {
    /// An input by a table of samples.
    Recorded of PushedKernel, [20.0, 0.3],
    |k, x| Pushed { k },
    (vector([x]), vector([T::zero()])),
    |at| vector([recorded(at.t)])
}
