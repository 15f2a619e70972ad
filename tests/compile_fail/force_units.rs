//! Units of inputs that do not match what they are used for.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
#[gauss(
    chart = hybrid,
    input(thrust = "N", rudder = "rad", swell: Vector3 = "m/s", gust: Wrench),
    define(speed = body.relative_velocity.x),
    force(at = [l, 0, 0], value = [thrust + rudder, rudder, lift * speed * speed * rudder]),
    force(body = body, value = -2 * swell),
    torque(value = [0, l * thrust, sin(l)]),
    wrench(force = gust.torque, torque = gust.torque),
    drag(linear = [lift, 0, 0, 0, 0, 0]),
    potential = lift * l,
)]
struct Vehicle {
    #[gauss(mass, unit = "kg")]
    m: f64,
    #[gauss(inertia)]
    j: Vector3<f64>,
    #[gauss(unit = "m")]
    l: f64,
    #[gauss(unit = "N s^2/m^2")]
    lift: f64,
}

fn main() {}
