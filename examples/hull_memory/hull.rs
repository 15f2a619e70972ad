//! The hull: what waves that it made do to it, by states; and the same forces by the convolution that they stand for.

use gauss_runtime::integrate::Trajectory;
use gauss_runtime::prelude::*;

/// A hull on calm water; k₃ points up, e₁ forward, O is in the waterline.
///
/// The waves that it radiates remember how it moved: the force in heave and the moment in pitch are
/// `−∫ K(t − s) V(s) ds` over all times s before (W. E. Cummins, *The impulse response function and ship motions*,
/// Schiffstechnik 9, 1962), V its heave and pitch rates in body axes, with `K(t) = e^(−at) cos(bt) [k₃₃ k₃₅; k₃₅ k₅₅]`.
/// Each of the two rates has a pair of states, whose first is `∫ e^(−a(t−s)) cos(b(t − s)) V(s) ds`. The propeller
/// follows its command late.
#[derive(Clone, Copy, Debug, GaussDynamics)]
#[gauss(
    chart = left_invariant,
    input(command = "N"),
    define(heave = body.body_velocity.z, pitch = body.body_angular_velocity.y),
    states(
        heaved = -a * heaved + b * heaved_late + heave,
        heaved_late = -b * heaved - a * heaved_late,
        pitched = -a * pitched + b * pitched_late + pitch,
        pitched_late = -b * pitched - a * pitched_late,
        thrust = (command - thrust) / lag,
    ),
    wrench(
        waves,
        force = [0, 0, -k33 * heaved - k35 * pitched],
        torque = [0, -k35 * heaved - k55 * pitched, 0],
    ),
    wrench(propeller, at = [-1.5, 0, -0.2], force = [thrust, 0, 0]),
    spring(waterplane, along = body.position.z, stiffness = c),
    drag(hull, linear = d),
)]
pub struct Hull {
    /// kg.
    #[gauss(mass)]
    pub mass: f64,
    /// G from O, m.
    #[gauss(center_of_mass)]
    pub center: Vector3<f64>,
    /// About O, kg m².
    #[gauss(inertia)]
    pub inertia: Vector3<f64>,
    /// At infinite frequency; kg, kg m².
    #[gauss(added_mass)]
    pub added: Vector6<f64>,
    /// The mass of the displaced water, kg, and where it would be, m.
    #[gauss(displaced_mass)]
    pub displaced: f64,
    #[gauss(center_of_buoyancy)]
    pub buoyancy: Vector3<f64>,
    #[gauss(gravity)]
    pub g: f64,
    /// How fast the memory fades and how fast it swings, 1/s.
    pub a: f64,
    pub b: f64,
    /// K at once: kg/s², kg m/s², kg m²/s².
    pub k33: f64,
    pub k35: f64,
    pub k55: f64,
    /// How late the propeller is, s.
    #[gauss(unit = "s")]
    pub lag: f64,
    /// Of the waterplane, N/m.
    pub c: f64,
    /// Friction of the water, in the order (u, ω).
    pub d: Vector6<f64>,
}

impl Hull {
    /// A boat of three metres.
    pub fn boat() -> Self {
        Self {
            mass: 300.0,
            center: Vector3::new(0.0, 0.0, -0.1),
            inertia: Vector3::new(60.0, 220.0, 240.0),
            added: Vector6::new(15.0, 120.0, 180.0, 10.0, 90.0, 60.0),
            displaced: 300.0,
            buoyancy: Vector3::new(0.0, 0.0, 0.35),
            g: 9.81,
            a: 0.9,
            b: 2.2,
            k33: 900.0,
            k35: 120.0,
            k55: 500.0,
            lag: 0.8,
            c: 9.0e3,
            d: Vector6::new(20.0, 60.0, 0.0, 15.0, 0.0, 40.0),
        }
    }

    /// K(t) by its three entries.
    fn kernel_of_memory(&self, t: f64) -> [f64; 3] {
        let fades = (-self.a * t).exp() * (self.b * t).cos();
        [self.k33, self.k35, self.k55].map(|k| k * fades)
    }

    /// What the states say of a state: the force in heave and the moment in pitch.
    pub fn by_states(&self, sample: &Sample<HullKernel>) -> [f64; 2] {
        let state = HullState::of(&sample.q, &sample.z);
        let Self { k33, k35, k55, .. } = self;
        [-k33 * state.heaved - k35 * state.pitched, -k35 * state.heaved - k55 * state.pitched]
    }

    /// The same at time `t` by the integral over the run before, which began at 0 with water at rest: by Simpson's rule
    /// over twice so many intervals.
    pub fn by_convolution(
        &self,
        run: &Trajectory<'_, HullKernel>,
        t: f64,
        intervals: u32,
    ) -> Result<[f64; 2], IntegrationError> {
        let step = t / f64::from(2 * intervals);
        let mut sum = [0.0; 2];
        for k in 0..=2 * intervals {
            let s = (step * f64::from(k)).min(t);
            let sample = run.at(s)?;
            let state = HullState::of(&sample.q, &sample.z);
            let weight = step / 3.0 * if k == 0 || k == 2 * intervals { 1.0 } else { f64::from(2 + 2 * (k % 2)) };
            let [k33, k35, k55] = self.kernel_of_memory(t - s).map(|k| weight * k);
            let (heave, pitch) = (state.u.z, state.omega.y);
            sum = [sum[0] - k33 * heave - k35 * pitch, sum[1] - k35 * heave - k55 * pitch];
        }
        Ok(sum)
    }

    /// Heave of the hull without coupling to pitch, let go at `z`, at each of so many steps: Cummins' equation as it
    /// stands, `(m + A) z̈ + c z + ∫ K(t − s) ż(s) ds = 0`, by the trapezoidal rule in time and in the integral over
    /// all steps before. No state stands for anything here. The error is of the second order in the step.
    pub fn heave_by_history(&self, z: f64, step: f64, steps: usize) -> Vec<f64> {
        let (mass, memory) = (self.mass + self.added[2], |t: f64| self.kernel_of_memory(t)[0]);
        let (mut places, mut speeds, mut force) = (vec![z], vec![0.0], -self.c * z);
        for n in 1..=steps {
            let t = |k: usize| step * (n - k) as f64;
            let before: f64 = (1..n).map(|k| memory(t(k)) * speeds[k]).sum::<f64>() + 0.5 * memory(t(0)) * speeds[0];
            let (place, speed) = (places[n - 1], speeds[n - 1]);
            // v = v₀ + h/2m (f₀ + f), f = −c (z₀ + h/2 (v₀ + v)) − h (before + ½ K(0) v).
            let half = 0.5 * step / mass;
            let known = -self.c * (place + 0.5 * step * speed) - step * before;
            let of_speed = 0.5 * step * (self.c + memory(0.0));
            let next = (speed + half * (force + known)) / (1.0 + half * of_speed);
            force = known - of_speed * next;
            places.push(place + 0.5 * step * (speed + next));
            speeds.push(next);
        }
        places
    }
}
