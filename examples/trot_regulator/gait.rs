//! A gait that is recorded, the regulator along it, and runs that are pushed.

use gauss_contact::{ContactError, ContactErrorKind, Mode};
use gauss_runtime::nalgebra::SMatrix;
use gauss_runtime::prelude::*;

use crate::robot::{Deviation, Place, Robot, STEP, Slopes, Speeds, Torques, springs};

type Square = SMatrix<f64, 36, 36>;
type Gain = SMatrix<f64, 12, 36>;

/// What feet did in a step, and their impulses.
pub type Feet = (Vec<Mode>, SVector<f64, 12>);

/// A run by springs at the joints: states before each step and at the end, and torques.
pub struct Gait {
    pub states: Vec<(Place, Speeds)>,
    pub torques: Vec<Torques>,
    pub feet: Vec<Feet>,
    /// How often a foot landed, and the worst residual of the laws, m/s.
    pub landings: usize,
    pub residual: f64,
}

/// Derivatives of the steps along a gait.
pub struct Linear {
    pub steps: Vec<Slopes>,
    /// Steps at a change of a mode, where derivatives are one-sided, and steps that have none.
    pub at_change: usize,
    pub none: usize,
}

impl Gait {
    /// So many steps.
    ///
    /// # Errors
    /// Where a step is none.
    pub fn record(robot: &Robot, steps: usize) -> Result<Self, ContactError> {
        let start = robot.start();
        let mut stepper = robot.stepper(0.0, start)?;
        let mut gait = Self { states: vec![start], torques: Vec::new(), feet: Vec::new(), landings: 0, residual: 0.0 };
        for n in 0..steps {
            let (q, z) = gait.states[n];
            let torques = springs(n as f64 * STEP, &q, &z);
            let closed: Vec<bool> = stepper.modes().iter().map(Mode::is_closed).collect();
            let laws = stepper.step(STEP, &torques)?.residual;
            gait.residual = gait.residual.max(laws.signorini).max(laws.coulomb).max(laws.dissipation);
            gait.landings += stepper.modes().iter().zip(closed).filter(|(mode, was)| mode.is_closed() && !was).count();
            gait.feet.push((stepper.modes().to_vec(), *stepper.impulses()));
            gait.torques.push(torques);
            gait.states.push((*stepper.configuration(), *stepper.speeds()));
        }
        Ok(gait)
    }

    /// When it ends, s.
    #[must_use]
    pub fn end(&self) -> f64 {
        self.torques.len() as f64 * STEP
    }

    // ANCHOR: linear
    /// The derivatives of each of its steps.
    ///
    /// # Errors
    /// Where a step is none.
    pub fn linearized(&self, robot: &Robot) -> Result<Linear, ContactError> {
        let mut linear = Linear { steps: Vec::new(), at_change: 0, none: 0 };
        for (n, torques) in self.torques.iter().enumerate() {
            let mut stepper = robot.stepper(n as f64 * STEP, self.states[n])?;
            match robot.linear(&mut stepper, torques) {
                Ok((slopes, at_change)) => {
                    linear.at_change += usize::from(at_change);
                    linear.steps.push(slopes);
                }
                // As if nothing could be done for so long.
                Err(ContactError { kind: ContactErrorKind::NoDerivative, .. }) => {
                    linear.none += 1;
                    linear.steps.push((Square::identity(), SMatrix::zeros()));
                }
                Err(error) => return Err(error),
            }
        }
        Ok(linear)
    }
    // ANCHOR_END: linear

    /// How far a state is from that of the gait before step number n: the increment seen from there, and speeds.
    #[must_use]
    pub fn off(&self, n: usize, (q, z): &(Place, Speeds)) -> Deviation {
        let (place, speeds) = &self.states[n];
        let (along, faster) = (place.difference(q), z - speeds);
        Deviation::from_fn(|i, _| if i < 18 { along.component(i) } else { faster[i - 18] })
    }
}

/// Gains of a regulator for each step: torques = those of the gait − gain · deviation.
pub struct Gains(pub Vec<Gain>);

impl Gains {
    // ANCHOR: riccati
    /// By the equation of Riccati in discrete time, from the end to the start.
    #[must_use]
    pub fn of(steps: &[Slopes]) -> Self {
        // Places and attitude of the trunk, joints; their rates.
        let weight = |i: usize| match i {
            0..3 => 100.0,
            3..6 => 200.0,
            6..18 => 5.0,
            18..21 => 10.0,
            21..24 => 5.0,
            _ => 0.05,
        };
        let weights = Square::from_diagonal(&SVector::from_fn(|i, _| STEP * weight(i)));
        let effort = SMatrix::<f64, 12, 12>::identity() * (STEP * 2e-3);
        let mut value = weights * 100.0;
        let mut gains = Vec::new();
        for (a, b) in steps.iter().rev() {
            let (va, vb) = (value * a, value * b);
            let bowl = effort + b.tr_mul(&vb);
            let gain: Gain = bowl.cholesky().map_or(Gain::zeros(), |bowl| bowl.solve(&b.tr_mul(&va)));
            value = weights + a.tr_mul(&(va - vb * gain));
            value = (value + value.transpose()) * 0.5;
            gains.push(gain);
        }
        gains.reverse();
        Self(gains)
    }
    // ANCHOR_END: riccati
}

/// By what torques the robot goes.
#[derive(Clone, Copy)]
pub enum Ways<'a> {
    /// Those of the gait.
    Replayed,
    /// Those of its springs, wherever it is.
    Springs,
    /// Those of the gait, corrected by gains.
    Regulated(&'a Gains),
}

/// A run that was pushed.
pub struct Pushed {
    /// Before each step that was made, and at the end.
    pub states: Vec<(Place, Speeds)>,
    pub feet: Vec<Feet>,
    /// When it fell, s: the trunk lower than 0.3 m, leaning by more than 37°, or a step without a solution.
    pub fell: Option<f64>,
    /// How far the trunk was from the gait at the end, m; infinite after a fall.
    pub off: f64,
}

/// When the robot is pushed, s.
pub const PUSHED: f64 = 0.3;

/// The robot, whose trunk is made faster by this, m/s by the observer, on the way.
#[must_use]
pub fn pushed(robot: &Robot, gait: &Gait, push: &Vector3<f64>, way: Ways<'_>) -> Pushed {
    let mut run = Pushed { states: Vec::new(), feet: Vec::new(), fell: Some(0.0), off: f64::INFINITY };
    let Ok(mut stepper) = robot.stepper(0.0, gait.states[0]) else { return run };
    for n in 0..gait.torques.len() {
        let (q, mut z) = (*stepper.configuration(), *stepper.speeds());
        run.fell = Some(n as f64 * STEP);
        if n == (PUSHED / STEP).round() as usize {
            let along = q.0.rotation.inverse() * push;
            (0..3).for_each(|k| z[k] += along[k]);
            let Ok(other) = robot.stepper(stepper.time(), (q, z)) else { return run };
            stepper = other;
        }
        run.states.push((q, z));
        let torques = match way {
            Ways::Replayed => gait.torques[n],
            Ways::Springs => springs(n as f64 * STEP, &q, &z),
            Ways::Regulated(gains) => gait.torques[n] - gains.0[n] * gait.off(n, &(q, z)),
        };
        let upright = (q.0.rotation * Vector3::z()).z;
        if q.0.translation.z < 0.3 || upright < 0.8 || stepper.step(STEP, &torques).is_err() {
            return run;
        }
        run.feet.push((stepper.modes().to_vec(), *stepper.impulses()));
    }
    let end = (*stepper.configuration(), *stepper.speeds());
    let there = gait.states[gait.torques.len()].0.0.translation.vector;
    run.states.push(end);
    (run.fell, run.off) = (None, (end.0.0.translation.vector - there).norm());
    run
}

/// How near the gait the trunk is where a push was survived, m, and pushes of which size are told apart, m/s.
pub const BACK: f64 = 0.05;
pub const LEAST: f64 = 0.05;

/// The largest push in a direction that is survived, m/s: all smaller ones are too.
#[must_use]
pub fn largest(robot: &Robot, gait: &Gait, direction: &Vector3<f64>, way: Ways<'_>) -> f64 {
    let survives = |k: &u32| pushed(robot, gait, &(direction * (LEAST * f64::from(*k))), way).off < BACK;
    LEAST * f64::from((1..=24).take_while(survives).last().unwrap_or(0))
}
