//! Orders, a pilot who follows them, and flights of any kernel of the vehicle.

use std::error::Error;

use gauss_runtime::monitor::power_balance;
use gauss_runtime::prelude::*;

use crate::vehicle::Table;

/// Distance in time of the moments that are kept, s.
pub const EVERY: f64 = 0.25;

/// Where the pilot steers.
#[derive(Clone, Copy, Debug)]
pub enum Steering {
    /// Keep this yaw angle, rad.
    Heading(f64),
    /// Hold the rudder at this angle, rad.
    Rudder(f64),
}

/// A part of a manoeuvre: the orders change only between legs, so that every leg is smooth.
#[derive(Clone, Copy, Debug)]
pub struct Leg {
    /// Its length, s: a whole number of [`EVERY`].
    pub seconds: f64,
    pub steering: Steering,
    /// m.
    pub depth: f64,
}

/// What the pilot looks at.
#[derive(Clone, Copy, Debug)]
pub struct Seen {
    /// Depth of O, m.
    pub depth: f64,
    /// Roll, pitch, yaw, rad.
    pub angles: [f64; 3],
    /// (u, ω), body axes, pole O.
    pub twist: Vector6<f64>,
}

impl Seen {
    pub fn of(pose: &Isometry3<f64>, twist: &Vector6<f64>) -> Self {
        let (roll, pitch, yaw) = pose.rotation.euler_angles();
        Self { depth: pose.translation.z, angles: [roll, pitch, yaw], twist: *twist }
    }
}

/// Heading and depth by proportional and derivative control about level flight. Angles are limited smoothly.
#[derive(Clone, Copy, Debug)]
pub struct Pilot {
    /// Pitch (rad) and elevator (rad) of level flight.
    pub level: [f64; 2],
    /// N, always the same.
    pub thrust: f64,
}

/// Largest angle of a fin, and of pitch in a depth change; rad.
const FIN_LIMIT: f64 = 0.35;
const PITCH_LIMIT: f64 = 0.3;

/// Nearly the value while it is small, ±limit in the end.
fn limited(value: f64, limit: f64) -> f64 {
    limit * (value / limit).tanh()
}

impl Pilot {
    /// For the vehicle of the table with so much more weight than buoyancy (N).
    ///
    /// # Errors
    /// When a number is missing.
    pub fn new(table: &Table, surplus: f64) -> Result<Self, Box<dyn Error>> {
        let n = |path: &str| table.number(path);
        let (thrust, xuu) = (n("propeller/Xprop")?, n("drag/Xuu")?);
        let (zuw, zww, zuuds) = (n("lift/Zuw")?, n("drag/Zww")?, n("fins/Zuuds")?);
        let (muw, mww, muuds) = (n("combined/Muw")?, n("drag/Mww")?, n("fins/Muuds")?);
        let righting = table.triple("center_of_mass_m")?.z * n("weight_N")?;
        let u = (thrust / -xuu).sqrt();
        // Level flight, heave and pitch in balance: the elevator from the one, the pitch from the other.
        let elevator = |pitch: f64| {
            let w = u * pitch.tan();
            (surplus * pitch.cos() + zuw * u * w + zww * w * w.abs()) / (-zuuds * u * u)
        };
        let moment = |pitch: f64| {
            let w = u * pitch.tan();
            muw * u * w + mww * w * w.abs() + muuds * u * u * elevator(pitch) - righting * pitch.sin()
        };
        let (mut low, mut high) = (-PITCH_LIMIT, PITCH_LIMIT);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            *(if moment(middle) * moment(high) > 0.0 { &mut high } else { &mut low }) = middle;
        }
        Ok(Self { level: [low, elevator(low)], thrust })
    }

    /// Rudder, elevator (rad) and thrust (N).
    pub fn steer(&self, leg: &Leg, seen: &Seen) -> [f64; 3] {
        let [_, pitch, yaw] = seen.angles;
        let rudder = match leg.steering {
            Steering::Heading(wanted) => limited(2.0 * (yaw - wanted) + 2.0 * seen.twist[5], FIN_LIMIT),
            Steering::Rudder(angle) => angle,
        };
        let wanted = self.level[0] + limited(0.15 * (seen.depth - leg.depth), PITCH_LIMIT);
        let correction = 2.0 * (pitch - wanted) + 2.0 * seen.twist[4];
        [rudder, self.level[1] + limited(correction, FIN_LIMIT), self.thrust]
    }
}

/// A manoeuvre of a vehicle.
#[derive(Clone, Debug)]
pub struct Manoeuvre {
    pub name: &'static str,
    pub start: (Isometry3<f64>, Vector6<f64>),
    pub legs: Vec<Leg>,
    pub pilot: Pilot,
}

impl Manoeuvre {
    /// From rest, the vehicle ballasted until it weighs nothing: nothing disturbs the straight line.
    ///
    /// # Errors
    /// When the table lacks a number.
    pub fn straight(table: &Table) -> Result<Self, Box<dyn Error>> {
        let start = (standing(table, 0.0)?, Vector6::zeros());
        let legs = vec![Leg { seconds: 60.0, steering: Steering::Heading(0.0), depth: 2.0 }];
        Ok(Self { name: "straight run", start, legs, pilot: Pilot::new(table, 0.0)? })
    }

    /// 10 s straight on, then the rudder at 10° to starboard.
    ///
    /// # Errors
    /// When the table lacks a number.
    pub fn turn(table: &Table) -> Result<Self, Box<dyn Error>> {
        let leg = |seconds: f64, steering| Leg { seconds, steering, depth: 2.0 };
        let legs = vec![leg(10.0, Steering::Heading(0.0)), leg(40.0, Steering::Rudder(-10.0_f64.to_radians()))];
        Self::cruising("turning circle", table, legs)
    }

    /// 10 s at 2 m, then down to 6 m.
    ///
    /// # Errors
    /// When the table lacks a number.
    pub fn dive(table: &Table) -> Result<Self, Box<dyn Error>> {
        let leg = |seconds: f64, depth: f64| Leg { seconds, steering: Steering::Heading(0.0), depth };
        Self::cruising("depth change", table, vec![leg(10.0, 2.0), leg(50.0, 6.0)])
    }

    /// With the published weight and buoyancy, from about level flight at 2 m.
    fn cruising(name: &'static str, table: &Table, legs: Vec<Leg>) -> Result<Self, Box<dyn Error>> {
        let pilot = Pilot::new(table, table.number("weight_N")? - table.number("buoyancy_N")?)?;
        let speed = (pilot.thrust / -table.number("drag/Xuu")?).sqrt();
        let [pitch, _] = pilot.level;
        let twist = Vector6::new(speed * pitch.cos(), 0.0, speed * pitch.sin(), 0.0, 0.0, 0.0);
        Ok(Self { name, start: (standing(table, pitch)?, twist), legs, pilot })
    }
}

/// At 2 m, rolled until the weight balances the torque of the propeller.
fn standing(table: &Table, pitch: f64) -> Result<Isometry3<f64>, Box<dyn Error>> {
    let righting = table.triple("center_of_mass_m")?.z * table.number("weight_N")? * pitch.cos();
    let roll = (table.number("propeller/Kprop")? / righting).asin();
    let rotation = UnitQuaternion::from_euler_angles(roll, pitch, 0.0);
    Ok(Isometry3::from_parts(Translation3::new(0.0, 0.0, 2.0), rotation))
}

/// A state on the way.
#[derive(Clone, Debug)]
pub struct Moment {
    /// s.
    pub t: f64,
    pub pose: Isometry3<f64>,
    /// (u, ω), body axes, pole O.
    pub twist: Vector6<f64>,
    /// Rudder, elevator (rad), thrust (N).
    pub inputs: [f64; 3],
    /// The power of every element, W.
    pub powers: Vec<f64>,
}

/// A manoeuvre that was flown.
#[derive(Clone, Debug)]
pub struct Flight {
    pub moments: Vec<Moment>,
    /// Energy gained and work supplied, J.
    pub balance: [f64; 2],
}

/// Flies a manoeuvre with a kernel of the vehicle, in whatever chart.
///
/// # Errors
/// When the start is singular in the chart, or the integration stops.
pub fn fly<K>(kernel: &K, manoeuvre: &Manoeuvre) -> Result<Flight, Box<dyn Error>>
where
    K: RigidBodySystem<Scalar = f64, Speeds = Vector6<f64>, Input = SVector<f64, 3>> + ForcedSystem,
{
    let pilot = manoeuvre.pilot;
    let mut q = kernel.configuration(&manoeuvre.start.0)?;
    let mut z = kernel.speeds(0.0, &q, &manoeuvre.start.1);
    let mut flight = Flight { moments: Vec::new(), balance: [0.0; 2] };
    let mut start = 0.0;
    for leg in &manoeuvre.legs {
        let input = |t: f64, q: &K::Configuration, z: &Vector6<f64>| {
            let seen = Seen::of(&kernel.pose(t, q), &kernel.body_twist(t, q, z));
            SVector::from(pilot.steer(leg, &seen))
        };
        if flight.moments.is_empty() {
            flight.moments.push(moment(kernel, 0.0, &q, &z, &input(0.0, &q, &z)));
        }
        for n in 0..(leg.seconds / EVERY).round() as u32 {
            // Every moment ends a step: nothing is interpolated.
            let (from, to) = (start + EVERY * f64::from(n), start + EVERY * f64::from(n + 1));
            let way = Simulation::new(kernel).input(input).adaptive(1e-12, 1e-13).run(q, z, from..to)?;
            let balance = power_balance(kernel, &way, input);
            flight.balance[0] += balance.last().energy;
            flight.balance[1] += balance.last().work;
            (q, z) = (way.last().q, way.last().z);
            flight.moments.push(moment(kernel, to, &q, &z, &input(to, &q, &z)));
        }
        start += leg.seconds;
    }
    Ok(flight)
}

fn moment<K>(kernel: &K, t: f64, q: &K::Configuration, z: &Vector6<f64>, input: &SVector<f64, 3>) -> Moment
where
    K: RigidBodySystem<Scalar = f64, Speeds = Vector6<f64>, Input = SVector<f64, 3>> + ForcedSystem,
{
    let powers = kernel.powers(t, q, z, input);
    Moment {
        t,
        pose: kernel.pose(t, q),
        twist: kernel.body_twist(t, q, z),
        inputs: (*input).into(),
        powers: (0..K::ELEMENTS.len()).map(|element| powers.component(element)).collect(),
    }
}

/// The largest distance between two flights, m.
pub fn distance<'a>(
    first: impl IntoIterator<Item = &'a Isometry3<f64>>,
    second: impl IntoIterator<Item = &'a Isometry3<f64>>,
) -> f64 {
    let apart = |(a, b): (&Isometry3<f64>, &Isometry3<f64>)| (a.translation.vector - b.translation.vector).norm();
    first.into_iter().zip(second).map(apart).fold(0.0, f64::max)
}
