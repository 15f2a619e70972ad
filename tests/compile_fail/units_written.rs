//! Units that are not coherent, not known, not written as units, or not those of a role.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
#[gauss(
    input(rudder = "deg", thrust = N, torque: "N m", gust: Wrench = "N"),
    force(body = body, value = [rudder, thrust, torque] + gust.force + [a, b, c] + [d, e, f]),
)]
struct Vehicle {
    #[gauss(mass, unit = "N")]
    m: f64,
    #[gauss(inertia, unit = "kg m^2")]
    j: Vector3<f64>,
    #[gauss(added_mass, unit = "kg")]
    added: Matrix6<f64>,
    #[gauss(unit = "km/h")]
    a: f64,
    #[gauss(unit = "Nm")]
    b: f64,
    #[gauss(unit = "kg/m s")]
    c: f64,
    #[gauss(unit)]
    d: f64,
    #[gauss(units = "m")]
    e: f64,
    #[gauss(unit = "V")]
    f: f64,
}

fn main() {}
