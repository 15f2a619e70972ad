//! Coulomb's dry friction of joints, exactly: while a joint slides, a force of fixed size against its rate; while it
//! sticks, the force that keeps it at rest, as long as that is not too large.
//!
//! **Which of the two** is Gauss's principle once more: of all ż those of the motion make `C(ż) + Σ f |ż_k|` least, the
//! sum over the joints at rest. That function is convex and has one minimum; there each of these joints either stays at
//! rest under a force of at most f, or begins to slide against a force of f.
//!
//! **How it is run.** Between events no joint changes between sliding and sticking, and forces are smooth functions of
//! the state: an input. A run ends where a rate vanishes or a force becomes too large; there it is decided anew, and
//! the run goes on.

use gauss_runtime::prelude::*;

/// A system of N coordinates of which every one has an input that is its generalised force.
pub trait Jointed<const N: usize>:
    GaussSystem<
        Scalar = f64,
        Configuration = SVector<f64, N>,
        Speeds = SVector<f64, N>,
        MassMatrix = SMatrix<f64, N, N>,
        Input = SVector<f64, N>,
    >
{
}

impl<const N: usize, K> Jointed<N> for K where
    K: GaussSystem<
            Scalar = f64,
            Configuration = SVector<f64, N>,
            Speeds = SVector<f64, N>,
            MassMatrix = SMatrix<f64, N, N>,
            Input = SVector<f64, N>,
        >
{
}

/// What a joint does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Mode {
    Sticks,
    /// By the sign of its rate.
    Slides(f64),
}

/// A state with what each joint does from there on.
#[derive(Clone, Copy, Debug)]
pub struct Moment<const N: usize> {
    pub t: f64,
    pub q: SVector<f64, N>,
    pub z: SVector<f64, N>,
    pub modes: [Mode; N],
}

/// A system with dry friction in its joints.
pub struct Dry<'k, K, const N: usize> {
    pub kernel: &'k K,
    /// The friction f of each joint, N or N m.
    pub limits: [f64; N],
}

/// So many events in a run are more than any here has.
const MOST: usize = 10_000;

impl<K: Jointed<N>, const N: usize> Dry<'_, K, N> {
    /// Friction of all joints: of those that slide by their sign, of those that stick what keeps ż there zero.
    pub fn forces(
        &self,
        modes: &[Mode; N],
        t: f64,
        q: &SVector<f64, N>,
        z: &SVector<f64, N>,
    ) -> Option<SVector<f64, N>> {
        let mut forces = SVector::from(std::array::from_fn(|k| match modes[k] {
            Mode::Sticks => 0.0,
            Mode::Slides(sign) => -self.limits[k] * sign,
        }));
        let free = self.kernel.acceleration(t, q, z, &forces);
        // (A⁻¹)_kl u_l = −ż_k for k and l that stick; of the others the equation u = 0.
        let response = self.kernel.mass_matrix(t, q).try_inverse()?;
        let sticks = |k: usize| modes[k] == Mode::Sticks;
        let matrix = SMatrix::<f64, N, N>::from_fn(|k, l| match (sticks(k), sticks(l)) {
            (true, true) => response[(k, l)],
            _ => f64::from(k == l),
        });
        let right = SVector::<f64, N>::from_fn(|k, _| if sticks(k) { -free[k] } else { 0.0 });
        forces += matrix.try_inverse()? * right;
        Some(forces)
    }

    /// What joints at rest do next, others as they are: the ways are tried one after the other, those that stick first;
    /// one of them is the minimum.
    pub fn decide(&self, t: f64, q: &SVector<f64, N>, z: &SVector<f64, N>) -> Option<[Mode; N]> {
        let moving: [Option<Mode>; N] = std::array::from_fn(|k| (z[k] != 0.0).then(|| Mode::Slides(z[k].signum())));
        let ways = [Mode::Sticks, Mode::Slides(1.0), Mode::Slides(-1.0)];
        (0..3_usize.pow(N as u32)).find_map(|number| {
            let modes: [Mode; N] = std::array::from_fn(|k| ways[number / 3_usize.pow(k as u32) % 3]);
            let as_they_are = (0..N).all(|k| moving[k].is_none_or(|mode| modes[k] == mode));
            let forces = as_they_are.then(|| self.forces(&modes, t, q, z)).flatten()?;
            let rates = self.kernel.acceleration(t, q, z, &forces);
            let holds = |k: usize| match modes[k] {
                Mode::Sticks => forces[k].abs() <= self.limits[k],
                Mode::Slides(sign) => moving[k].is_some() || sign * rates[k] > 0.0,
            };
            (0..N).all(holds).then_some(modes)
        })
    }

    /// How far each joint is from doing something else: the size of its rate, or what its friction could hold besides.
    fn margins(&self, modes: &[Mode; N], t: f64, q: &SVector<f64, N>, z: &SVector<f64, N>) -> [f64; N] {
        let forces = self.forces(modes, t, q, z).unwrap_or_else(|| SVector::from([f64::NAN; N]));
        std::array::from_fn(|k| match modes[k] {
            Mode::Sticks => self.limits[k] - forces[k].abs(),
            Mode::Slides(sign) => sign * z[k],
        })
    }

    /// From a state to the time `end`: where the joints changed between sliding and sticking, and the state at the end.
    ///
    /// # Errors
    /// When the kernel has no value on the way, or there is no end of events.
    pub fn run(
        &self,
        q: SVector<f64, N>,
        z: SVector<f64, N>,
        end: f64,
        tolerance: f64,
    ) -> Result<Vec<Moment<N>>, Box<dyn std::error::Error>> {
        let undecided = "the mass matrix is singular";
        let mut at = Moment { t: 0.0, q, z, modes: self.decide(0.0, &q, &z).ok_or(undecided)? };
        let mut all = vec![at];
        while at.t < end {
            let modes = at.modes;
            let least = |t: f64, q: &SVector<f64, N>, z: &SVector<f64, N>| {
                self.margins(&modes, t, q, z).into_iter().fold(f64::INFINITY, f64::min)
            };
            let friction = |t: f64, q: &SVector<f64, N>, z: &SVector<f64, N>| {
                self.forces(&modes, t, q, z).unwrap_or_else(|| SVector::from([f64::NAN; N]))
            };
            let run = Simulation::new(self.kernel)
                .input(friction)
                .until(Crossing::Falling, least)
                .adaptive(tolerance, tolerance)
                .run_to_end(at.q, at.z, at.t..end)?;
            let stopped = run.stopped_by.is_some();
            let sample = run.sample;
            at = Moment { t: sample.t, q: sample.q, z: sample.z, modes };
            if stopped {
                at = self.after(at).ok_or(undecided)?;
            }
            all.push(at);
            if all.len() > MOST {
                return Err(format!("{MOST} events until {} s", at.t).into());
            }
        }
        Ok(all)
    }

    /// The states of a run that had these moments, at most `apart` seconds from one another.
    ///
    /// # Errors
    /// As [`run`](Self::run).
    pub fn path(&self, moments: &[Moment<N>], apart: f64) -> Result<Vec<Sample<K>>, IntegrationError> {
        let mut path = Vec::new();
        for pair in moments.windows(2) {
            let friction = |t: f64, q: &SVector<f64, N>, z: &SVector<f64, N>| {
                self.forces(&pair[0].modes, t, q, z).unwrap_or_else(|| SVector::from([f64::NAN; N]))
            };
            let run = Simulation::new(self.kernel).input(friction).adaptive(1e-9, 1e-9).largest_step(apart);
            let part = run.run(pair[0].q, pair[0].z, pair[0].t..pair[1].t)?;
            // The last state of a part is the first one of the next.
            path.extend(part.iter().skip(usize::from(!path.is_empty())).copied());
        }
        Ok(path)
    }

    /// The joint that made the event rests exactly, or gives way.
    fn after(&self, Moment { t, q, mut z, mut modes }: Moment<N>) -> Option<Moment<N>> {
        let margins = self.margins(&modes, t, &q, &z);
        let (joint, _) = margins.into_iter().enumerate().min_by(|a, b| a.1.total_cmp(&b.1))?;
        for k in 0..N {
            // What sticks has at most the rounding of a step.
            if modes[k] == Mode::Sticks {
                z[k] = 0.0;
            }
        }
        match modes[joint] {
            // Its force is at the limit, where sticking and sliding are the same.
            Mode::Sticks => modes[joint] = Mode::Slides(-self.forces(&modes, t, &q, &z)?[joint].signum()),
            Mode::Slides(_) => {
                z[joint] = 0.0;
                modes = self.decide(t, &q, &z)?;
            }
        }
        Some(Moment { t, q, z, modes })
    }
}
