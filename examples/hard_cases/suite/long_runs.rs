//! What many steps do to what should not change.

use std::error::Error;

use gauss_runtime::integrate::{Control, Fixed, Form};
use gauss_runtime::prelude::*;
use gauss_tests::double_double::DoubleDouble;

use super::measure::worse;
use super::methods::{carrying_8, gauss_6, order_8, splitting};
use super::scenes::{FreeTop, FreeTopFromSpace, FreeTopFromSpaceKernel, FreeTopKernel, RollingDisk};
use super::truth::MassData;
use super::{Effort, Measure, naive};

type Measures = Result<Vec<Measure>, Box<dyn Error>>;

/// The free body of Hairer, Lubich and Wanner, figure VII.5.3.
const INERTIA: [f64; 3] = [0.5, 0.85, 1.0];
const OMEGA: [f64; 3] = [0.4, 1.0 / 0.85, 0.4];

/// Steps of 0.01: the truncation error of order 8 is below rounding.
const STEP: f64 = 0.01;

fn start() -> (UnitQuaternion<f64>, Vector3<f64>) {
    (UnitQuaternion::new_normalize(Quaternion::new(0.4, 0.2, 0.4, 0.8)), OMEGA.into())
}

fn steps(effort: Effort) -> u64 {
    match effort {
        Effort::Quick => 20_000,
        Effort::Usual => 1_000_000,
        Effort::Full => 100_000_000,
    }
}

/// ‖q‖ − 1, of components taken as they are.
fn excess(q: [f64; 4]) -> f64 {
    let square = q.into_iter().map(DoubleDouble::from).fold(DoubleDouble::ZERO, |sum, c| sum + c * c);
    0.5 * (square - DoubleDouble::ONE).high
}

/// Quaternion and ω, as [`naive::top`] has them.
fn typed_start() -> SVector<f64, 7> {
    let (q, z) = start();
    SVector::from_fn(|i, _| if i < 4 { q.coords[i] } else { z[i - 4] })
}

fn data() -> MassData {
    let inertia = Matrix3::from_diagonal(&INERTIA.into());
    MassData { mass: 1.0, center: Vector3::zeros(), inertia, added: Matrix6::zeros(), gravity: 0.0 }
}

pub fn unit_quaternion(effort: Effort) -> Measures {
    let count = steps(effort);
    let kernel = FreeTop { mass: 1.0, inertia: INERTIA.into() }.kernel()?;
    let (q, z) = start();
    let mut largest = 0.0;
    let see = |s: &Sample<FreeTopKernel>| {
        let q = s.q.coords;
        largest = worse(largest, excess([q[0], q[1], q[2], q[3]]).abs());
    };
    // One more than a multiple of anything: the norm is seen at all phases of the motion.
    let every = (count / 10_000).max(1) | 1;
    let run = Simulation::new(&kernel).control(Fixed::with(&Tableau::RK4, STEP)).every(every).observe(see);
    run.run_to_end(q, z, 0.0..STEP * count as f64)?;

    let typed_count = count.min(1_000_000);
    let y = naive::runge_kutta(naive::top(&data()), typed_start(), STEP, typed_count, |_| ());
    let drift = excess([y[0], y[1], y[2], y[3]]).abs();
    Ok(vec![
        Measure::new(
            format!("|‖q‖ − 1| in {:.0e} steps", count as f64),
            "RKMK 4, h = 0.01",
            largest,
            4.0 * f64::EPSILON,
        )
        .naive(format!("RK4, never normalised, {:.0e} steps", typed_count as f64), drift),
    ])
}

/// How the largest change of a quantity grows with the number of steps: the exponent, from a thousand steps on.
struct Growth {
    first: Option<f64>,
    count: u64,
    largest: f64,
    points: Vec<(f64, f64)>,
}

impl Growth {
    fn new() -> Self {
        Self { first: None, count: 0, largest: 0.0, points: Vec::new() }
    }

    /// A value; changes count relative to the first one.
    fn see(&mut self, value: f64) {
        let first = *self.first.get_or_insert(value);
        self.largest = worse(self.largest, ((value - first) / first).abs());
        // Four points a decade.
        if self.count >= 1000 && self.count as f64 >= self.points.last().map_or(0.0, |p| p.0.exp() * 1.75) {
            self.points.push(((self.count as f64).ln(), self.largest.max(f64::MIN_POSITIVE).ln()));
        }
        self.count += 1;
    }

    /// Of the least-squares line through the logarithms.
    fn exponent(&self) -> f64 {
        let n = self.points.len() as f64;
        let (x, y) = self.points.iter().fold((0.0, 0.0), |sum, p| (sum.0 + p.0 / n, sum.1 + p.1 / n));
        let square: f64 = self.points.iter().map(|p| (p.0 - x).powi(2)).sum();
        self.points.iter().map(|p| (p.0 - x) * (p.1 - y)).sum::<f64>() / square
    }
}

/// The energy of the free body over a run.
fn growth<F, C>(kernel: &FreeTopKernel, form: F, control: C, count: u64, step: f64) -> Result<Growth, IntegrationError>
where
    F: Form<FreeTopKernel>,
    C: Control<FreeTopKernel>,
{
    let (q, z) = start();
    let mut growth = Growth::new();
    let see = |s: &Sample<FreeTopKernel>| growth.see(kernel.energy(s.t, &s.q, &s.z));
    let run = Simulation::new(kernel).form(form).control(control).observe(see);
    run.run_to_end(q, z, 0.0..step * count as f64)?;
    Ok(growth)
}

pub fn energy(effort: Effort) -> Measures {
    let count = steps(effort);
    let kernel = FreeTop { mass: 1.0, inertia: INERTIA.into() }.kernel()?;
    let (q, z) = start();

    let mut typed = Growth::new();
    let inertia = Matrix3::from_diagonal(&INERTIA.into());
    let (typed_count, typed_step) = (count.min(1_000_000), 0.1);
    naive::runge_kutta(naive::top(&data()), typed_start(), typed_step, typed_count, |y| {
        typed.see(naive::energy(&inertia, y));
    });
    let words = format!("RK4 on a quaternion, {:.0e} steps of 0.1", typed_count as f64);

    let mut measures = Vec::new();
    let mut add = |method: &str, count: u64, growth: &Growth| {
        let what = format!("energy, {:.0e} steps: largest change", count as f64);
        // Each step commits a few roundings of random sign to the energy.
        let target = (4.0 * f64::EPSILON * (count as f64).sqrt()).min(1e-12);
        measures.push(
            Measure::new(what, method, growth.largest, target)
                .because("4 ε √n, at most 1e-12")
                .naive(&*words, typed.largest)
                .note(format!("it grows like n^{:.2}; naive: n^{:.2}", growth.exponent(), typed.exponent())),
        );
    };
    // The longest runs are those of methods that are meant for them.
    let some = count.min(10_000_000);
    add("order 8, h = 0.01", some, &growth(&kernel, VelocityForm, order_8(STEP), some, STEP)?);
    add("order 8, h = 0.01, momenta", some, &growth(&kernel, MomentumForm, order_8(STEP), some, STEP)?);
    add("Gauss 6, h = 0.05, momenta", some, &growth(&kernel, MomentumForm, gauss_6(0.05), some, 0.05)?);
    add("exact free flow, h = 0.5", some, &growth(&kernel, MomentumForm, splitting!(&kernel, 0.5), some, 0.5)?);
    add("order 8, h = 0.01, carrying", count, &growth(&kernel, VelocityForm, carrying_8(STEP), count, STEP)?);

    // In the observer's axes the momenta of a free body have no rate.
    let from_space = FreeTopFromSpace { mass: 1.0, inertia: INERTIA.into() }.kernel()?;
    let z = q * z;
    let (mut first, mut other) = (None, 0.0_f64);
    let see = |s: &Sample<FreeTopFromSpaceKernel>| other = worse(other, (s.p - *first.get_or_insert(s.p)).amax());
    let run = Simulation::new(&from_space).momentum_form().fixed_step(STEP).observe(see);
    run.run_to_end(q, z, 0.0..STEP * count.min(1_000_000) as f64)?;
    let l = |y: &SVector<f64, 7>| naive::matrix([y[0], y[1], y[2], y[3]]) * (inertia * Vector3::new(y[4], y[5], y[6]));
    let begin = typed_start();
    let y = naive::runge_kutta(naive::top(&data()), begin, STEP, typed_count, |_| ());
    measures.push(
        Measure::new("angular momentum in space: change", "observer's axes, momenta", other, 0.0)
            .because("ṗ = 0: bit by bit")
            .naive("RK4 on a quaternion, h = 0.01", (l(&y) - l(&begin)).amax()),
    );
    Ok(measures)
}

pub fn rolling(effort: Effort) -> Measures {
    let count: u32 = match effort {
        Effort::Quick => 1_000,
        Effort::Usual | Effort::Full => 100_000,
    };
    let (mass, r) = (1.5, 0.3);
    let inertia = Matrix3::from_diagonal(&Vector3::new(0.5, 0.5, 1.0)) * (0.9 * mass * r * r);
    let hoop = RigidBody { mass, center_of_mass: Vector3::zeros(), inertia };
    let kernel = RollingDisk { hoop, r, g: 9.81 }.kernel()?;
    let typed = (SVector::from([0.0, 0.0, 0.28, 0.0, 1.2, 0.0]), SVector::from([1.2, 0.0, 0.0, -0.8, 0.0, -3.7]));
    let (q, z) = kernel.project(0.0, &typed.0, &typed.1)?;
    let h = 0.002;
    let residual = |t: f64, q: &SVector<f64, 6>, z: &SVector<f64, 6>| {
        worse(kernel.position_residual(t, q).amax(), kernel.velocity_residual(t, q, z).amax())
    };
    let mut largest = 0.0;
    let see = |s: &Sample<_>| largest = worse(largest, residual(s.t, &s.q, &s.z));
    let end = h * f64::from(count);
    Simulation::new(&kernel).fixed_step(h).observe(see).run_to_end(q, z, 0.0..end)?;

    let start = SVector::<f64, 12>::from_fn(|i, _| if i < 6 { q[i] } else { z[i - 6] });
    let split = |y: &SVector<f64, 12>| (SVector::from_fn(|i, _| y[i]), SVector::from_fn(|i, _| y[i + 6]));
    let rate = |y: &SVector<f64, 12>| {
        let (q, z) = split(y);
        let (velocity, acceleration) = (kernel.kinematics(0.0, &q, &z), kernel.acceleration(0.0, &q, &z, &()));
        SVector::from_fn(|i, _| if i < 6 { velocity[i] } else { acceleration[i - 6] })
    };
    let mut drift = 0.0;
    naive::runge_kutta(rate, start, h, count.into(), |y| {
        let (q, z) = split(y);
        drift = worse(drift, residual(0.0, &q, &z));
    });
    Ok(vec![
        Measure::new(
            format!("slip, height after {:.0e} steps, m/s, m", f64::from(count)),
            "RKMK 4, projected",
            largest,
            1e-13,
        )
        .naive("the same accelerations, RK4, not projected", drift),
    ])
}
