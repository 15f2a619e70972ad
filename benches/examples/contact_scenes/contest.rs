//! A scene in steps: what a step costs, and what steps do to the laws.

use std::error::Error;
use std::time::Instant;

use gauss_contact::{ContactStepper, StepReport};
use gauss_runtime::prelude::*;
use serde_json::{Value, json};

/// s: the length of a step; and for how many of them a target is held.
pub const STEP: f64 = 1e-3;
pub const HELD: usize = 10;
/// Targets of a batch, whose time is taken as a whole.
pub const BATCH: usize = 20;

pub type Outcome<T> = Result<T, Box<dyn Error>>;

/// What of a scene should stick.
#[derive(Clone, Copy)]
pub enum Sticks {
    /// Feet that bear a load: half of their slips are slower than the creep, m/s.
    Feet,
    /// The free body over the last second: the way that it goes then is the creep, m/s.
    FreeBody,
}

/// What steps do to the laws.
pub struct Quality {
    /// m: the lowest gap after a step.
    pub lowest: f64,
    /// m/s: what [`Sticks`] says.
    pub creep: f64,
    /// What the energy changes by beyond the work of motors and contacts, over all work that they do either way.
    pub unaccounted: Option<f64>,
    /// m: from the start of the free body to its end.
    pub way: f64,
    /// Of ours.
    pub solves: Option<Solves>,
}

/// What the solver of ours had to do.
#[derive(Clone, Copy, Default)]
pub struct Solves {
    pub steps: usize,
    /// m/s: the worst of the laws.
    pub residual: f64,
    /// Systems of equations, sweeps, and steps with an impact.
    pub corrections: u32,
    pub sweeps: u32,
    pub impacts: usize,
}

impl Solves {
    fn add(&mut self, report: &StepReport) {
        let residual = report.residual;
        let worst = residual.signorini.max(residual.coulomb).max(residual.dissipation);
        self.residual = self.residual.max(worst);
        self.steps += 1;
        self.corrections += report.corrections;
        self.sweeps += report.sweeps;
        self.impacts += usize::from(report.impacts > 0);
    }
}

/// One program's way through a scene, a batch of steps after the other.
pub trait Contest {
    /// What it is called.
    fn name(&self) -> String;
    /// Begins anew.
    fn restart(&mut self) -> Outcome<()>;
    /// Microseconds a step of the next batch.
    fn batch(&mut self, number: usize) -> Outcome<f64>;
    /// The same steps once more, with a look at each.
    fn quality(&mut self) -> Outcome<Quality>;
}

/// A free body, and joints that are led by `stiffness (target − angle) − damping rate`, taken at the start of a step.
pub struct Scene<K, const U: usize> {
    pub name: &'static str,
    pub kernel: K,
    pub start: (Isometry3<f64>, SVector<f64, U>),
    pub gains: [SVector<f64, U>; 2],
    pub targets: Vec<SVector<f64, U>>,
    /// Targets whose steps are timed, from the first: as long as all programs do the same.
    pub timed: usize,
    /// The place of the rates of the joints among the speeds.
    pub rates: usize,
    pub friction: f64,
    pub sticks: Sticks,
    /// What else the description for other programs has.
    pub parameters: Value,
}

impl<K, const U: usize, const Z: usize> Scene<K, U>
where
    K: ContactSystem<
            Scalar = f64,
            Configuration = (Isometry3<f64>, SVector<f64, U>),
            Speeds = SVector<f64, Z>,
            Input = SVector<f64, U>,
        >,
{
    /// For other programs: units of the SI, the quaternion with its scalar first.
    pub fn description(&self) -> Value {
        let (at, turn) = (self.start.0.translation.vector, self.start.0.rotation.coords);
        let sticks = match self.sticks {
            Sticks::Feet => "feet",
            Sticks::FreeBody => "free body",
        };
        json!({
            "name": self.name, "step": STEP, "held": HELD, "batch": BATCH, "friction": self.friction, "sticks": sticks,
            "pose": [at.x, at.y, at.z, turn.w, turn.x, turn.y, turn.z], "joints": self.start.1.as_slice(),
            "stiffness": self.gains[0].as_slice(), "damping": self.gains[1].as_slice(),
            "targets": self.targets.iter().map(SVector::as_slice).collect::<Vec<_>>(), "parameters": self.parameters,
        })
    }

    /// Ours, at the start.
    ///
    /// # Errors
    /// Where the start is one.
    pub fn ours(&self) -> Outcome<Ours<'_, K, U>> {
        Ok(Ours { scene: self, stepper: self.stepper()? })
    }

    fn stepper(&self) -> Outcome<ContactStepper<'_, K>> {
        Ok(ContactStepper::new(&self.kernel, 0.0, self.start, SVector::zeros())?)
    }

    fn efforts(&self, target: &SVector<f64, U>, stepper: &ContactStepper<'_, K>) -> SVector<f64, U> {
        let rates = stepper.speeds().fixed_rows::<U>(self.rates);
        self.gains[0].component_mul(&(target - stepper.configuration().1)) - self.gains[1].component_mul(&rates)
    }

    fn rates(&self, stepper: &ContactStepper<'_, K>) -> K::ContactRows {
        self.kernel.contact_rates(stepper.time(), stepper.configuration(), stepper.speeds())
    }

    fn measured(&self) -> Outcome<Quality> {
        let mut stepper = self.stepper()?;
        let energy = |s: &ContactStepper<'_, K>| self.kernel.energy(s.time(), s.configuration(), s.speeds());
        let (before, mut slips) = (energy(&stepper), Vec::new());
        let (mut lowest, mut solves, mut work, mut done) = (0.0_f64, Solves::default(), 0.0, 0.0);
        let mut rested = self.start.0;
        for (n, target) in self.targets.iter().enumerate() {
            if n + (1.0 / (HELD as f64 * STEP)).round() as usize == self.targets.len() {
                rested = stepper.configuration().0;
            }
            for _ in 0..HELD {
                let (efforts, joints) = (self.efforts(target, &stepper), stepper.configuration().1);
                let before = self.rates(&stepper);
                let report = stepper.step(STEP, &efforts)?;
                let (after, impulses) = (self.rates(&stepper), stepper.impulses());
                solves.add(&report);
                let gaps = self.kernel.gaps(stepper.time(), stepper.configuration());
                lowest = (0..self.kernel.contacts().len()).map(|i| gaps.component(i)).fold(lowest, f64::min);
                let by_motors = efforts.component_mul(&(stepper.configuration().1 - joints));
                // Of the impulses by the mean of the rates before and after them.
                let of_row =
                    |row: usize| 0.5 * impulses.component(row) * (before.component(row) + after.component(row));
                let by_contacts: f64 = (0..K::ContactRows::DIM).map(of_row).sum();
                work += by_motors.sum() + by_contacts;
                done += by_motors.abs().sum() + by_contacts.abs();
                slips.extend(
                    self.kernel.contacts().iter().filter(|contact| impulses.component(contact.normal) > 0.0).map(
                        |contact| contact.tangent_rows().map(|row| after.component(row).powi(2)).sum::<f64>().sqrt(),
                    ),
                );
            }
        }
        let since =
            |place: &Isometry3<f64>| (stepper.configuration().0.translation.vector - place.translation.vector).norm();
        let creep = match self.sticks {
            Sticks::Feet => median(slips),
            Sticks::FreeBody => since(&rested),
        };
        let unaccounted = (energy(&stepper) - before - work).abs() / done;
        let (unaccounted, way) = (Some(unaccounted), since(&self.start.0));
        Ok(Quality { lowest, creep, unaccounted, way, solves: Some(solves) })
    }
}

/// Half are below; 0 of none.
pub fn median(mut figures: Vec<f64>) -> f64 {
    figures.sort_by(f64::total_cmp);
    figures.get(figures.len() / 2).copied().unwrap_or(0.0)
}

/// Ours.
pub struct Ours<'s, K, const U: usize>
where
    K: ContactSystem<Scalar = f64>,
{
    scene: &'s Scene<K, U>,
    stepper: ContactStepper<'s, K>,
}

impl<K, const U: usize, const Z: usize> Contest for Ours<'_, K, U>
where
    K: ContactSystem<
            Scalar = f64,
            Configuration = (Isometry3<f64>, SVector<f64, U>),
            Speeds = SVector<f64, Z>,
            Input = SVector<f64, U>,
        >,
{
    fn name(&self) -> String {
        "ours".into()
    }

    fn restart(&mut self) -> Outcome<()> {
        self.stepper = self.scene.stepper()?;
        Ok(())
    }

    fn batch(&mut self, number: usize) -> Outcome<f64> {
        let targets = &self.scene.targets[number * BATCH..(number + 1) * BATCH];
        let clock = Instant::now();
        for target in targets {
            for _ in 0..HELD {
                self.stepper.step(STEP, &self.scene.efforts(target, &self.stepper))?;
            }
        }
        Ok(1e6 * clock.elapsed().as_secs_f64() / (BATCH * HELD) as f64)
    }

    fn quality(&mut self) -> Outcome<Quality> {
        self.scene.measured()
    }
}
