//! The same vehicle written out by hand, as in textbooks, with an integrator of its own: nothing here is generated.
//!
//! `M ν̇ + C(ν) ν = τ` with ν = (u v w p q r): T. I. Fossen, *Handbook of Marine Craft Hydrodynamics and Motion
//! Control*, 2011, chapters 2 (Euler angles), 3 (rigid body), 4 (weight and buoyancy) and 6 (added mass).

use std::error::Error;

use gauss_runtime::prelude::*;

use crate::manoeuvres::{EVERY, Leg, Manoeuvre, Pilot, Seen};
use crate::vehicle::Table;

/// η = (x y z φ θ ψ), then ν.
type State = SVector<f64, 12>;

/// The cross product with a vector as a matrix.
fn skew(a: Vector3<f64>) -> Matrix3<f64> {
    Matrix3::new(0.0, -a.z, a.y, a.z, 0.0, -a.x, -a.y, a.x, 0.0)
}

fn blocks(parts: [Matrix3<f64>; 4]) -> Matrix6<f64> {
    Matrix6::from_fn(|row, column| parts[2 * (row / 3) + column / 3][(row % 3, column % 3)])
}

/// What a coefficient is multiplied with; velocities by their place in ν.
#[derive(Clone, Copy)]
enum Factors {
    Square(usize),
    Product(usize, usize),
    Rudder,
    Elevator,
}

/// Reads a coefficient's place and factors off its name: `Yrr` is Y by r |r|, `Muwb` M by u w, `Nuudr` N by u² and the
/// rudder.
fn term(name: &str) -> Option<(usize, Factors)> {
    let letters: Vec<char> = name.chars().collect();
    let row = "XYZKMN".find(*letters.first()?)?;
    let velocity = |n: usize| letters.get(n).and_then(|&letter| "uvwpqr".find(letter));
    let factors = match (velocity(1)?, velocity(2)?, name.get(3..)?) {
        (0, 0, "dr") => Factors::Rudder,
        (0, 0, "ds") => Factors::Elevator,
        (i, j, "") if i == j => Factors::Square(i),
        (i, j, _) => Factors::Product(i, j),
    };
    Some((row, factors))
}

/// The vehicle in six degrees of freedom.
pub struct Fossen {
    /// Row, coefficient, factors.
    terms: Vec<(usize, f64, Factors)>,
    /// Torque of the propeller for its thrust, m.
    shaft: f64,
    mass: f64,
    center: Vector3<f64>,
    inertia: Matrix3<f64>,
    added: Matrix6<f64>,
    inverse: Matrix6<f64>,
    weight: f64,
    buoyancy: f64,
}

impl Fossen {
    /// The vehicle of the table with another buoyancy, N.
    ///
    /// # Errors
    /// When a number is missing, or the mass matrix is singular.
    pub fn new(table: &Table, buoyancy: f64) -> Result<Self, Box<dyn Error>> {
        let weight = table.number("weight_N")?;
        let (mass, center) = (weight / table.number("g")?, table.triple("center_of_mass_m")?);
        let inertia = Matrix3::from_diagonal(&table.triple("inertia_about_O_kg_m2")?);
        let added = table.added_mass()?;
        let s = skew(center) * mass;
        let rigid = blocks([Matrix3::identity() * mass, -s, s, inertia]);
        let inverse = (rigid + added).try_inverse().ok_or("the mass matrix is singular")?;
        let mut terms = Vec::new();
        for (name, coefficient) in ["drag", "lift", "fins"].into_iter().flat_map(|group| table.group(group)) {
            let (row, factors) = term(name).ok_or_else(|| format!("{name} names no coefficient"))?;
            terms.push((row, coefficient, factors));
        }
        let shaft = table.number("propeller/Kprop")? / table.number("propeller/Xprop")?;
        Ok(Self { terms, shaft, mass, center, inertia, added, inverse, weight, buoyancy })
    }

    /// C(ν) ν.
    fn coriolis(&self, nu: &Vector6<f64>) -> Vector6<f64> {
        let w = nu.fixed_rows::<3>(3).into_owned();
        let (m, s) = (self.mass, skew(self.center));
        let rigid = blocks([skew(w) * m, -skew(w) * s * m, s * skew(w) * m, -skew(self.inertia * w)]);
        let momentum = self.added * nu;
        let (q, l) = (skew(momentum.fixed_rows::<3>(0).into()), skew(momentum.fixed_rows::<3>(3).into()));
        let fluid = blocks([Matrix3::zeros(), -q, -q, -l]);
        (rigid + fluid) * nu
    }

    /// Drag, lift, fins and propeller: X, Y, Z, K, M, N.
    fn loads(&self, nu: &Vector6<f64>, [rudder, elevator, thrust]: [f64; 3]) -> Vector6<f64> {
        let mut loads = Vector6::new(thrust, 0.0, 0.0, self.shaft * thrust, 0.0, 0.0);
        for &(row, coefficient, factors) in &self.terms {
            loads[row] += coefficient
                * match factors {
                    Factors::Square(i) => nu[i] * nu[i].abs(),
                    Factors::Product(i, j) => nu[i] * nu[j],
                    Factors::Rudder => nu[0] * nu[0] * rudder,
                    Factors::Elevator => nu[0] * nu[0] * elevator,
                };
        }
        loads
    }

    /// Weight and buoyancy, O at the centre of buoyancy.
    fn restoring(&self, phi: f64, theta: f64) -> Vector6<f64> {
        let (w, excess) = (self.weight, self.weight - self.buoyancy);
        let [x, y, z]: [f64; 3] = self.center.into();
        let ((sf, cf), (st, ct)) = (phi.sin_cos(), theta.sin_cos());
        Vector6::new(
            -excess * st,
            excess * ct * sf,
            excess * ct * cf,
            w * (y * ct * cf - z * ct * sf),
            w * (-z * st - x * ct * cf),
            w * (x * ct * sf + y * st),
        )
    }

    /// ν̇ = M⁻¹ (τ − C(ν) ν) with roll φ, pitch θ, and rudder, elevator (rad), thrust (N).
    pub fn acceleration(&self, nu: &Vector6<f64>, [phi, theta]: [f64; 2], inputs: [f64; 3]) -> Vector6<f64> {
        self.inverse * (self.loads(nu, inputs) + self.restoring(phi, theta) - self.coriolis(nu))
    }

    /// η̇ and ν̇.
    fn rate(&self, state: &State, pilot: &Pilot, leg: &Leg) -> State {
        let nu: Vector6<f64> = state.fixed_rows::<6>(6).into();
        let [phi, theta, psi] = [state[3], state[4], state[5]];
        let inputs = pilot.steer(leg, &Seen { depth: state[2], angles: [phi, theta, psi], twist: nu });
        let ((sf, cf), (st, ct), (sp, cp)) = (phi.sin_cos(), theta.sin_cos(), psi.sin_cos());
        let rotation = Matrix3::new(
            cp * ct,
            cp * st * sf - sp * cf,
            cp * st * cf + sp * sf,
            sp * ct,
            sp * st * sf + cp * cf,
            sp * st * cf - cp * sf,
            -st,
            ct * sf,
            ct * cf,
        );
        let tangent = st / ct;
        let angles = Matrix3::new(1.0, sf * tangent, cf * tangent, 0.0, cf, -sf, 0.0, sf / ct, cf / ct);
        let mut rate = State::zeros();
        rate.fixed_rows_mut::<3>(0).copy_from(&(rotation * nu.fixed_rows::<3>(0)));
        rate.fixed_rows_mut::<3>(3).copy_from(&(angles * nu.fixed_rows::<3>(3)));
        rate.fixed_rows_mut::<6>(6).copy_from(&self.acceleration(&nu, [phi, theta], inputs));
        rate
    }

    /// Flies a manoeuvre by the classical Runge–Kutta method with so many steps between two moments; poses at the
    /// moments.
    pub fn fly(&self, manoeuvre: &Manoeuvre, steps: u32) -> Vec<Isometry3<f64>> {
        let (pose, twist) = manoeuvre.start;
        let (b, (phi, theta, psi)) = (pose.translation.vector, pose.rotation.euler_angles());
        let mut state = State::from([b.x, b.y, b.z, phi, theta, psi, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
        state.fixed_rows_mut::<6>(6).copy_from(&twist);
        let mut poses = vec![pose];
        let h = EVERY / f64::from(steps);
        for leg in &manoeuvre.legs {
            let rate = |state: &State| self.rate(state, &manoeuvre.pilot, leg);
            for _ in 0..(leg.seconds / EVERY).round() as u32 {
                for _ in 0..steps {
                    let k1 = rate(&state);
                    let k2 = rate(&(state + k1 * (0.5 * h)));
                    let k3 = rate(&(state + k2 * (0.5 * h)));
                    let k4 = rate(&(state + k3 * h));
                    state += (k1 + (k2 + k3) * 2.0 + k4) * (h / 6.0);
                }
                let rotation = UnitQuaternion::from_euler_angles(state[3], state[4], state[5]);
                poses.push(Isometry3::from_parts(Translation3::new(state[0], state[1], state[2]), rotation));
            }
        }
        poses
    }
}
