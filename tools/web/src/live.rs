//! A motion that goes on while it is looked at.

use gauss_runtime::prelude::*;

use crate::scene::{Scene, Slider};

/// A motion, whatever its scene: what the browser asks for.
pub trait Motion {
    /// Begins anew.
    ///
    /// # Errors
    /// Parameters that no body has.
    fn restart(&mut self) -> Result<(), String>;

    /// Moves a slider. A parameter changes the kernel and leaves the state; otherwise the motion begins anew.
    ///
    /// # Errors
    /// Parameters that no body has: the kernel stays what it was.
    fn set(&mut self, slider: usize, value: f64) -> Result<(), String>;

    /// Goes on for so many seconds, with this relative and absolute tolerance of each step.
    ///
    /// # Errors
    /// Why the motion cannot go on; the state is the last one that was reached.
    fn advance(&mut self, seconds: f64, tolerance: f64) -> Result<(), String>;

    /// Time, kinetic and potential energy, error of the energy relative to the largest kinetic energy so far, steps
    /// so far; then seven numbers of each pose, position and quaternion i, j, k, w; six of each arrow; one of each
    /// curve.
    fn numbers(&self) -> Vec<f64>;
}

/// A scene that runs.
pub struct Live<S: Scene> {
    values: Vec<f64>,
    kernel: S::Kernel,
    state: Sample<S::Kernel>,
    /// What energy less work should be, and the work since then.
    energy: f64,
    work: f64,
    largest: f64,
    steps: u64,
}

impl<S: Scene> Live<S> {
    /// With all sliders where they are at first.
    ///
    /// # Errors
    /// Parameters that no body has.
    pub fn new() -> Result<Self, String> {
        let values: Vec<f64> = S::SLIDERS.iter().map(|Slider { value, .. }| *value).collect();
        let kernel = S::kernel(&values).map_err(|error| error.to_string())?;
        let state = beginning::<S>(&values, &kernel);
        let mut live = Self { values, kernel, state, energy: 0.0, work: 0.0, largest: 0.0, steps: 0 };
        live.weigh();
        Ok(live)
    }

    /// Takes the energy that there is now as the one that should stay.
    fn weigh(&mut self) {
        let Sample { t, q, z, .. } = &self.state;
        self.energy = self.kernel.energy(*t, q, z);
        self.largest = self.kernel.kinetic_energy(*t, q, z);
        self.work = 0.0;
    }
}

fn beginning<S: Scene>(values: &[f64], kernel: &S::Kernel) -> Sample<S::Kernel> {
    let (q, z) = S::start(values);
    Sample { t: 0.0, q, z, p: kernel.momentum(0.0, &q, &z) }
}

impl<S: Scene> Motion for Live<S> {
    fn restart(&mut self) -> Result<(), String> {
        self.state = beginning::<S>(&self.values, &self.kernel);
        self.steps = 0;
        self.weigh();
        Ok(())
    }

    fn set(&mut self, slider: usize, value: f64) -> Result<(), String> {
        let Some(place) = self.values.get_mut(slider) else { return Err(format!("there is no slider {slider}")) };
        let before = std::mem::replace(place, value);
        if !S::SLIDERS[slider].parameter {
            return self.restart();
        }
        match S::kernel(&self.values) {
            Ok(kernel) => self.kernel = kernel,
            Err(error) => {
                self.values[slider] = before;
                return Err(error.to_string());
            }
        }
        let Sample { t, q, z, .. } = self.state;
        self.state.p = self.kernel.momentum(t, &q, &z);
        self.weigh();
        Ok(())
    }

    fn advance(&mut self, seconds: f64, tolerance: f64) -> Result<(), String> {
        let Sample { t, q, z, .. } = self.state;
        let simulation = Simulation::new(&self.kernel).adaptive(tolerance, tolerance).max_steps(MOST_STEPS);
        let (path, error) = simulation.attempt(q, z, t..t + seconds);
        let supplied = |s: &Sample<S::Kernel>| S::supplied(&self.kernel, s);
        if supplied(&self.state).is_some() {
            for step in path.samples().windows(2) {
                let (from, length) = (step[0].t, step[1].t - step[0].t);
                for (at, weight) in quadrature() {
                    let sample = path.at(from + at * length).map_err(|error| error.to_string())?;
                    self.work += length * weight * supplied(&sample).unwrap_or(0.0);
                }
            }
        }
        self.steps += path.len() as u64 - 1;
        let last = *path.last();
        drop(path);
        self.state = last;
        self.largest = self.largest.max(self.kernel.kinetic_energy(last.t, &last.q, &last.z));
        error.map_or(Ok(()), |error| Err(error.to_string()))
    }

    fn numbers(&self) -> Vec<f64> {
        let (kernel, s) = (&self.kernel, &self.state);
        let (kinetic, potential) = (kernel.kinetic_energy(s.t, &s.q, &s.z), kernel.potential_energy(s.t, &s.q));
        let largest = if self.largest > 0.0 { self.largest } else { 1.0 };
        let error = (kernel.energy(s.t, &s.q, &s.z) - self.work - self.energy) / largest;
        let mut numbers = vec![s.t, kinetic, potential, error, self.steps as f64];
        for pose in S::poses(&self.values, kernel, s) {
            numbers.extend(pose.translation.vector.iter().chain(pose.rotation.coords.iter()));
        }
        for [at, vector] in S::arrows(kernel, s) {
            numbers.extend(at.iter().chain(vector.iter()));
        }
        numbers.extend(S::curves(kernel, s));
        numbers
    }
}

/// Of one call: a picture must not take for ever, whatever the sliders say.
const MOST_STEPS: u64 = 20_000;

/// Abscissae and weights on (0, 1) by Gauss, exact up to the fifth power.
fn quadrature() -> [(f64, f64); 3] {
    let far = 0.5 * 0.6_f64.sqrt();
    [(0.5 - far, 5.0 / 18.0), (0.5, 8.0 / 18.0), (0.5 + far, 5.0 / 18.0)]
}
