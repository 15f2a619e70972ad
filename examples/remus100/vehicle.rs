//! The vehicle: what it is and what acts on it, once for each of two charts.
//!
//! Body axes: e₁ forward, e₂ starboard, e₃ down, O at the centre of buoyancy. Observer: k₁ north, k₂ east, k₃ down. SI
//! units.

use std::error::Error;

use gauss_runtime::prelude::*;
use serde_json::Value;

/// The published table, `examples/data/remus100.json`.
pub struct Table(Value);

impl Table {
    /// The table that comes with the program; its source is named in it.
    ///
    /// # Errors
    /// When the file is no JSON.
    pub fn published() -> Result<Self, Box<dyn Error>> {
        Ok(Self(serde_json::from_str(include_str!("../data/remus100.json"))?))
    }

    /// The number with a path like `drag/Xuu`, SI units.
    ///
    /// # Errors
    /// When there is none.
    pub fn number(&self, path: &str) -> Result<f64, Box<dyn Error>> {
        let value = self.0.pointer(&format!("/{path}")).and_then(Value::as_f64);
        value.ok_or_else(|| format!("the table of the vehicle has no number {path}").into())
    }

    /// The three numbers with such a path.
    ///
    /// # Errors
    /// When one is missing.
    pub fn triple(&self, path: &str) -> Result<Vector3<f64>, Box<dyn Error>> {
        let component = |n: usize| self.number(&format!("{path}/{n}"));
        Ok(Vector3::new(component(0)?, component(1)?, component(2)?))
    }

    /// The numbers of a group with their names; none when there is no such group.
    pub fn group(&self, name: &str) -> impl Iterator<Item = (&str, f64)> {
        let entries = self.0.get(name).and_then(Value::as_object).into_iter().flatten();
        entries.filter_map(|(name, value)| Some((name.as_str(), value.as_f64()?)))
    }

    /// M_A in the order (u, ω), pole O: the table has the derivatives of the force by the acceleration, which is −M_A.
    ///
    /// # Errors
    /// When a derivative is missing.
    pub fn added_mass(&self) -> Result<Matrix6<f64>, Box<dyn Error>> {
        let derivative = |name: &str| self.number(&format!("added_mass_derivatives/{name}"));
        let mut sum = Matrix6::zeros();
        let places =
            [("Xudot", 0, 0), ("Yvdot", 1, 1), ("Zwdot", 2, 2), ("Kpdot", 3, 3), ("Mqdot", 4, 4), ("Nrdot", 5, 5)];
        let couplings = [("Yrdot", 1, 5), ("Nvdot", 5, 1), ("Zqdot", 2, 4), ("Mwdot", 4, 2)];
        for (name, row, column) in places.into_iter().chain(couplings) {
            sum[(row, column)] = -derivative(name)?;
        }
        Ok(sum)
    }
}

/// The same vehicle in another chart is another word in one attribute.
///
/// Drag, lift and fins are the table, term by term. Its cross terms X_wq, Y_wp, M_uwa, … are not entered: they follow
/// from the added mass, and would count twice.
macro_rules! vehicle {
    ($(#[$doc:meta])* $name:ident, $($chart:tt)*) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, GaussDynamics)]
        #[gauss(
            chart = $($chart)*,
            input(rudder, elevator, thrust),
            define(v = body.relative_velocity, w = body.body_angular_velocity),
            wrench(
                drag,
                force = [
                    xuu * v.x * abs(v.x),
                    yvv * v.y * abs(v.y) + yrr * w.z * abs(w.z),
                    zww * v.z * abs(v.z) + zqq * w.y * abs(w.y),
                ],
                torque = [
                    kpp * w.x * abs(w.x),
                    mww * v.z * abs(v.z) + mqq * w.y * abs(w.y),
                    nvv * v.y * abs(v.y) + nrr * w.z * abs(w.z),
                ],
            ),
            wrench(
                lift,
                force = [0, yuv * v.x * v.y, zuw * v.x * v.z],
                torque = [0, muwb * v.x * v.z, nuvb * v.x * v.y],
            ),
            wrench(
                fins,
                force = [
                    0,
                    yuudr * v.x * v.x * rudder + yurf * v.x * w.z,
                    zuuds * v.x * v.x * elevator + zuqf * v.x * w.y,
                ],
                torque = [
                    0,
                    muuds * v.x * v.x * elevator + muwf * v.x * v.z + muqf * v.x * w.y,
                    nuudr * v.x * v.x * rudder + nuvf * v.x * v.y + nurf * v.x * w.z,
                ],
            ),
            wrench(propeller, force = [thrust, 0, 0], torque = [lever * thrust, 0, 0]),
        )]
        pub struct $name {
            #[gauss(mass)]
            pub mass: f64,
            #[gauss(center_of_mass)]
            pub center: Vector3<f64>,
            #[gauss(inertia)]
            pub inertia: Vector3<f64>,
            #[gauss(added_mass)]
            pub added: Matrix6<f64>,
            /// Mass of the displaced water; buoyancy acts at O.
            #[gauss(displaced_mass)]
            pub displaced: f64,
            #[gauss(gravity)]
            pub gravity: Vector3<f64>,
            pub xuu: f64, pub yvv: f64, pub yrr: f64, pub zww: f64, pub zqq: f64,
            pub kpp: f64, pub mww: f64, pub mqq: f64, pub nvv: f64, pub nrr: f64,
            pub yuv: f64, pub zuw: f64, pub muwb: f64, pub nuvb: f64,
            pub yuudr: f64, pub zuuds: f64, pub muuds: f64, pub nuudr: f64,
            pub yurf: f64, pub zuqf: f64, pub muwf: f64, pub nuvf: f64, pub muqf: f64, pub nurf: f64,
            /// Torque of the propeller about its shaft for its thrust.
            pub lever: f64,
        }

        impl $name {
            /// The vehicle of the table.
            ///
            /// # Errors
            /// When a number is missing.
            pub fn from_table(table: &Table) -> Result<Self, Box<dyn Error>> {
                let n = |path: &str| table.number(path);
                let g = n("g")?;
                Ok(Self {
                    mass: n("weight_N")? / g,
                    center: table.triple("center_of_mass_m")?,
                    inertia: table.triple("inertia_about_O_kg_m2")?,
                    added: table.added_mass()?,
                    displaced: n("buoyancy_N")? / g,
                    gravity: Vector3::new(0.0, 0.0, g),
                    xuu: n("drag/Xuu")?, yvv: n("drag/Yvv")?, yrr: n("drag/Yrr")?,
                    zww: n("drag/Zww")?, zqq: n("drag/Zqq")?,
                    kpp: n("drag/Kpp")?, mww: n("drag/Mww")?, mqq: n("drag/Mqq")?,
                    nvv: n("drag/Nvv")?, nrr: n("drag/Nrr")?,
                    yuv: n("lift/Yuv")?, zuw: n("lift/Zuw")?, muwb: n("lift/Muwb")?, nuvb: n("lift/Nuvb")?,
                    yuudr: n("fins/Yuudr")?, zuuds: n("fins/Zuuds")?, muuds: n("fins/Muuds")?, nuudr: n("fins/Nuudr")?,
                    yurf: n("fins/Yurf")?, zuqf: n("fins/Zuqf")?, muwf: n("fins/Muwf")?, nuvf: n("fins/Nuvf")?,
                    muqf: n("fins/Muqf")?, nurf: n("fins/Nurf")?,
                    lever: n("propeller/Kprop")? / n("propeller/Xprop")?,
                })
            }
        }
    };
}

vehicle!(
    /// In body velocities: Kirchhoff's equations.
    Remus, left_invariant
);
vehicle!(
    /// In yaw, pitch and roll: Lagrange's equations.
    RemusByAngles, jet(euler_zyx)
);
