//! A runner on a springy leg: two kernels that hand the state over at touchdown and lift-off; and a ball that bounces.

use gauss_runtime::prelude::*;

// ANCHOR: runner
/// In the air: a mass and its weight.
#[derive(GaussDynamics)]
#[gauss(coordinates(x, y), particle(mass = m, position = [x, 0, y]))]
pub struct Flight {
    #[gauss(unit = "kg")]
    pub m: f64,
    #[gauss(gravity, unit = "m/s^2")]
    pub g: f64,
}

/// On the ground: a leg without mass from the foot, which stands, to the hip, where the mass is.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y),
    particle(mass = m, position = [x, 0, y]),
    spring(leg, from = [foot, 0, 0], to = [x, 0, y], stiffness = k, length = l),
)]
pub struct Stance {
    #[gauss(unit = "kg")]
    pub m: f64,
    #[gauss(unit = "N/m")]
    pub k: f64,
    #[gauss(unit = "m")]
    pub l: f64,
    #[gauss(unit = "m")]
    pub foot: f64,
    #[gauss(gravity, unit = "m/s^2")]
    pub g: f64,
}
// ANCHOR_END: runner

/// A runner that puts its leg down at one angle, whatever happens.
#[derive(Clone, Copy)]
pub struct Runner {
    pub m: f64,
    pub k: f64,
    pub l: f64,
    /// From the ground to the leg at touchdown, rad.
    pub attack: f64,
    pub g: f64,
}

/// A moment of a run: time, place and velocity.
pub type Moment = (f64, [f64; 2], [f64; 2]);

/// From one apex to the next.
pub struct Step {
    pub foot: f64,
    pub apex: Moment,
    pub touchdown: Moment,
    pub liftoff: Moment,
    /// The hip every hundredth of a second.
    pub path: Vec<Moment>,
}

/// How a run ends.
pub struct Run {
    pub steps: Vec<Step>,
    /// Whether the leg gave way, or the apex was too low for it: the hip falls to the ground.
    pub stumbled: bool,
}

type Pair = SVector<f64, 2>;

/// So long a flight or a stance takes at most, s.
const LONGEST: f64 = 5.0;

fn moment<K>(s: &Sample<K>) -> Moment
where
    K: GaussSystem<Scalar = f64, Configuration = Pair, Speeds = Pair>,
{
    (s.t, s.q.into(), s.z.into())
}

/// States every hundredth of a second, and the last one.
fn shown<K>(path: &Trajectory<'_, K>) -> Result<Vec<Moment>, IntegrationError>
where
    K: GaussSystem<Scalar = f64, Configuration = Pair, Speeds = Pair>,
{
    let (from, to) = (path.first().t, path.last().t);
    let times = (0..).map(|n| from + 0.01 * f64::from(n)).take_while(|t| *t < to).chain([to]);
    Ok(path.at_times(times)?.iter().map(moment).collect())
}

impl Runner {
    /// Seyfarth, Geyer, Günther & Blickhan, *A movement criterion for running*, Journal of Biomechanics 35 (2002): a
    /// human of 80 kg, who runs stably without looking at anything.
    pub fn human() -> Self {
        Self { m: 80.0, k: 20e3, l: 1.0, attack: 68.0_f64.to_radians(), g: 9.81 }
    }

    /// Kinetic energy and potential energy of the height, J.
    pub fn energy(&self, (_, [_, y], [u, v]): Moment) -> f64 {
        self.m * (0.5 * (u * u + v * v) + self.g * y)
    }

    /// It, on a foot at this place.
    pub fn stance(&self, foot: f64) -> Stance {
        let &Self { m, k, l, g, .. } = self;
        Stance { m, k, l, foot, g }
    }

    /// Some steps from an apex of a height with a speed.
    ///
    /// # Errors
    /// When the numbers make no runner, or a flight or a stance does not reach its end.
    pub fn run(&self, height: f64, speed: f64, steps: usize) -> Result<Run, Box<dyn std::error::Error>> {
        let &Self { m, l, attack, g, .. } = self;
        let flight = Flight { m, g }.kernel()?;
        let touch = l * attack.sin();
        let fly = Simulation::new(&flight).adaptive(1e-12, 1e-12);
        let to_ground = fly.until(Crossing::Falling, move |_, q, _| q[1] - touch);
        let to_apex = fly.until(Crossing::Falling, |_, _, z| z[1]);

        let mut apex: Sample<FlightKernel> =
            fly.run_to_end(Pair::from([0.0, height]), Pair::from([speed, 0.0]), 0.0..0.0)?.sample;
        let mut run = Run { steps: Vec::new(), stumbled: false };
        for _ in 0..steps {
            let down = to_ground.run(apex.q, apex.z, apex.t..apex.t + LONGEST)?;
            let last = down.last();
            // An apex below the height of touchdown leaves no room for the leg.
            if down.stopped_by().is_none() {
                run.stumbled = true;
                return Ok(run);
            }
            // The foot stands where it touches: the same state goes on with another kernel.
            let foot = last.q[0] + l * attack.cos();
            let stance = self.stance(foot).kernel()?;
            let stand = Simulation::new(&stance)
                .until(Crossing::Rising, |_, q, _| f64::hypot(q[0] - foot, q[1]) - l)
                .until(Crossing::Falling, |_, q, _| q[1])
                .adaptive(1e-12, 1e-12)
                .run(last.q, last.z, last.t..last.t + LONGEST)?;
            let off = stand.last();
            if stand.stopped_by() != Some(0) {
                run.stumbled = true;
                return Ok(run);
            }
            let up = to_apex.run(off.q, off.z, off.t..off.t + LONGEST)?;
            let path = [shown(&down)?, shown(&stand)?, shown(&up)?].concat();
            run.steps.push(Step { foot, apex: moment(&apex), touchdown: moment(last), liftoff: moment(off), path });
            apex = *up.last();
        }
        Ok(run)
    }
}

/// A ball above a floor, at each impact with 0.7 of its speed.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(y),
    particle(mass = m, position = [0, 0, y]),
    contact(floor, gap = y, restitution = 0.7),
)]
pub struct Ball {
    #[gauss(unit = "kg")]
    pub m: f64,
    #[gauss(gravity, unit = "m/s^2")]
    pub g: f64,
}
