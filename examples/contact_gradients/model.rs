//! A cube on a table, and where it comes to rest: by numbers that are known, and by their derivatives.

use gauss_runtime::dual::Dual;
use gauss_runtime::prelude::*;

/// A cube that moves in a plane; the plane cuts it into a square with four corners.
#[derive(Clone, Copy, GaussDynamics)]
#[gauss(
    coordinates(x, height, tilt),
    body(cube, position = [x, 0, height], rotation = rotation_y(tilt), mass = m, inertia = m * a * a / 6),
    contact(table, point = cube.position, edges = [a, 0, a], friction = mu),
    input(push),
    drive(x = push),
)]
pub struct Cube<T> {
    #[gauss(unit = "kg")]
    pub m: T,
    /// An edge.
    #[gauss(unit = "m")]
    pub a: T,
    pub mu: T,
    #[gauss(gravity, unit = "m/s^2")]
    pub g: T,
}

pub const MASS: f64 = 1.0;
pub const EDGE: f64 = 0.2;
pub const G: f64 = 9.81;
/// How long it is watched, s: until it rests.
pub const WATCHED: f64 = 1.0;

/// Numbers with derivatives by speed, height, friction and push, in this order.
pub type Number = Dual<4>;
pub type Numbers = [Number; 4];

/// A cube that is thrown flat along a table from a height of its lower face, and pushed.
#[derive(Clone, Copy)]
pub struct Throw {
    pub name: &'static str,
    /// Speed, height, friction, push.
    pub numbers: [f64; 4],
    /// By which of them derivatives are looked at.
    pub by: &'static [usize],
}

pub const THROWS: [Throw; 4] = [
    Throw { name: "slides, stops", numbers: [1.5, 0.0, 0.3, 0.0], by: &[0, 2] },
    Throw { name: "slides, pushed", numbers: [1.0, 0.0, 0.4, 1.0], by: &[0, 2, 3] },
    Throw { name: "held by friction", numbers: [0.0, 0.0, 0.4, 2.0], by: &[0, 3] },
    Throw { name: "falls, slides", numbers: [1.5, 0.1, 0.3, 0.0], by: &[0, 1, 2] },
];

impl Throw {
    /// Its numbers with their derivatives.
    pub fn varied(&self) -> Numbers {
        core::array::from_fn(|k| Number::variable(self.numbers[k], k))
    }

    /// Where it comes to rest, in closed form: it falls for t = √(2h/g), the impact takes μ√(2gh) of its speed, and
    /// friction the rest.
    pub fn exact(&self) -> Number {
        let [speed, height, mu, push] = self.varied();
        let number = Number::constant;
        let g = number(G);
        if self.numbers[0] == 0.0 {
            return number(0.0);
        }
        let (fall, impact) = match self.numbers[1] {
            0.0 => (number(0.0), number(0.0)),
            _ => ((number(2.0) * height / g).sqrt(), (number(2.0) * height * g).sqrt()),
        };
        let after = speed - mu * impact;
        speed * fall + after * after / (number(2.0) * (mu * g - push / number(MASS)))
    }

    /// Configuration and speeds at the start.
    pub fn start(numbers: &Numbers) -> (SVector<Number, 3>, SVector<Number, 3>) {
        let [speed, height, ..] = *numbers;
        let zero = Number::constant(0.0);
        ([zero, height + Number::constant(0.5 * EDGE), zero].into(), [speed, zero, zero].into())
    }

    pub fn cube(numbers: &Numbers) -> Cube<Number> {
        Cube { m: Number::constant(MASS), a: Number::constant(EDGE), mu: numbers[2], g: Number::constant(G) }
    }
}
