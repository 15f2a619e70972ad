//! Radau IIA of order 5: an implicit method for scenes whose stiffness follows what the time moves.
//!
//! Its three stages lie on a polynomial of degree 3 that satisfies the equations at each of them. What follows a motion
//! by stiff forces, as a mass on a stiff spring of a shaken place does, is then followed to the third order of the step
//! however stiff it is. Stages of a [`Rosenbrock`](crate::integrate::Rosenbrock) method satisfy no equations, and its
//! order falls there. The price is an iteration: Newton's, with the exact Jacobian of the start for all stages.
//!
//! Coefficients, transformation and estimate: E. Hairer & G. Wanner, *Solving Ordinary Differential Equations II*,
//! IV.8, code RADAU5; a test verifies what they are to satisfy. The chart is that of `step/start.rs`.

use nalgebra::Complex;

use crate::configuration::{Configuration, VectorSpace};
use crate::integrate::drive::step_length::power;
use crate::integrate::problem::equations::Problem;
use crate::integrate::problem::error::{IntegrationErrorKind, RunPart};
use crate::integrate::problem::state::{Rates, State, TangentOf};
use crate::integrate::step::one_step::{EstimatingStep, OneStep, Properties, Step, check_contacts};
use crate::integrate::step::start::{Model, Start, Vector, positive_length};
use crate::linearize::{Factored, LinearModel, LinearizedSystem};
use crate::real::Real;

const STAGES: usize = 3;

/// Times of the stages: (4 ∓ √6)/10 and 1.
const TIMES: [f64; STAGES] = [0.155_051_025_721_682_2, 0.644_948_974_278_317_8, 1.0];

/// Eigenvalues of A⁻¹, with A the matrix of the method: a real one, and α ± iβ.
const REAL: f64 = 3.637_834_252_744_496;
const COMPLEX: [f64; 2] = [2.681_082_873_627_752, 3.050_430_199_247_410_5];

/// Stages from modes, in which A⁻¹ is diagonal but for the complex pair.
const STAGES_OF_MODES: [[f64; STAGES]; STAGES] = [
    [0.091_232_394_870_892_94, -0.141_255_295_020_954_2, -0.030_029_194_105_147_424],
    [0.241_717_932_707_107, 0.204_129_352_293_799_94, 0.382_942_112_757_261_9],
    [0.966_048_182_615_093, 1.0, 0.0],
];

/// Modes from stages.
const MODES_OF_STAGES: [[f64; STAGES]; STAGES] = [
    [4.325_579_890_063_155, 0.339_199_251_815_809_84, 0.541_770_539_935_874_9],
    [-4.178_718_591_551_905, -0.327_682_820_761_062_4, 0.476_623_554_500_550_44],
    [-0.502_872_634_945_786_9, 2.571_926_949_855_605, -0.596_039_204_828_224_9],
];

/// `(1/(γ₀h) − J) error = f₀ + Σ eᵢ Zᵢ/h`, 1/γ₀ the real eigenvalue: (−13 ∓ 7√6)/3 and −1/3.
const ESTIMATE: [f64; STAGES] = [-10.048_809_399_827_416, 1.382_142_733_160_749, -1.0 / 3.0];

/// Sweeps of Newton's iteration after which a shorter step is cheaper.
const MOST_SWEEPS: u32 = 15;

/// The iteration may leave so much of e^{3/2}, with e the estimated error relative to the state: that falls with the
/// sixth power of the step, as the error of the method does, and is far below the tolerance of an accepted step.
const SHARE: f64 = 0.01;

/// A sweep that still changes so much of the state is not near a solution.
const FAR: f64 = 0.1;

/// Radau IIA of Hairer and Wanner on the group: three implicit stages, order 5 with an estimate of order 3, of stage
/// order 3, L-stable, stiffly accurate.
///
/// For kernels with `#[gauss(linearize)]`, and stiff scenes of any kind: stiff springs and dampers between bodies,
/// mechanisms on stiff bushings, places that are moved in time. A step costs a linearisation, a real and a complex
/// factorisation of the size of the state (twice the degrees of freedom), and three evaluations for each of two to
/// seven sweeps of Newton's iteration. It keeps no integral, and damps motions faster than the step: not for
/// conservative scenes. Where forces jump, as dry friction without a smooth law does, the iteration does not converge;
/// where the direction of a stiff force turns, as that of a rod that is a spring, it does in steps in which that turns
/// little: rods are better rigid, with angles as coordinates.
///
/// Both forms of the equations are integrated in z: the derivatives are those of ż. Inputs are taken at the times and
/// states of the stages; their derivatives by the state are differences, which cost sweeps alone.
///
#[cfg_attr(
    feature = "derive",
    doc = r##"
```
use gauss_runtime::integrate::Radau;
use gauss_runtime::prelude::*;

/// A mass on a stiff spring and damper, the other end of which is shaken.
#[derive(GaussDynamics)]
#[gauss(
    linearize,
    coordinates(x),
    particle(mass = m, position = [x, 0, 0]),
    spring(along = x - sin(t), stiffness = k, damping = c),
)]
struct Shaken {
    m: f64,
    k: f64,
    c: f64,
}

# fn main() -> Result<(), Box<dyn std::error::Error>> {
let kernel = Shaken { m: 1.0, k: 1e8, c: 1e5 }.kernel()?;
let (x, v) = (SVector::from([0.0]), SVector::from([1.0]));
let run = Simulation::new(&kernel).control(Adaptive::by(Radau, 1e-8, 1e-8)).run(x, v, 0.0..10.0)?;
// The mass follows the place: ẍ = −sin t lengthens the spring by no more than m/k.
assert!((run.last().q[0] - 10_f64.sin()).abs() < 2e-8);
assert!(run.summary().steps < 1500);
# Ok(())
# }
```
"##
)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Radau;

impl<S: LinearizedSystem> OneStep<S> for Radau {
    fn properties(&self) -> Properties {
        Properties { stiff: true, ..Properties::of_order(5) }
    }

    /// Refuses steps whose iteration does not converge ([`IntegrationErrorKind::NotConverged`]), stages that turn by
    /// more than π ([`IntegrationErrorKind::IncrementTooLarge`]), singularities of the coordinates
    /// ([`IntegrationErrorKind::SingularChart`]), and overflowing or undefined results, as with a singular matrix
    /// ([`IntegrationErrorKind::NonFinite`]).
    fn step<P: Problem<System = S>>(
        &self,
        problem: &P,
        state: &State<S>,
        rates: &Rates<S>,
        h: S::Scalar,
    ) -> Result<Step<S>, IntegrationErrorKind> {
        check_contacts(problem)?;
        let start = Start::of(problem, state);
        let systems = Systems::of(start.linearize(problem, rates).0, positive_length(h));
        let (last, error) = iterate(problem, &start, &systems, h)?;
        start.step(problem, state, h, (&last, &error))
    }
}

/// The estimate is the difference to a solution of order 3, damped where motions are faster than the step.
impl<S: LinearizedSystem> EstimatingStep<S> for Radau {
    fn estimate_order(&self) -> f64 {
        4.0
    }
}

/// Increments of the three stages, or of the three modes.
type Triple<S> = [Vector<S>; STAGES];

fn combined<S: LinearizedSystem>(matrix: &[[f64; STAGES]; STAGES], of: &Triple<S>) -> Triple<S> {
    matrix.map(|row| {
        let mut sum = Vector::<S>::zero();
        for (factor, part) in row.into_iter().zip(of) {
            sum = sum.add_scaled(S::Scalar::from_f64(factor), part);
        }
        sum
    })
}

/// The linear systems of a step, one of the real mode and one of the complex pair.
struct Systems<S: LinearizedSystem> {
    rate: Vector<S>,
    real: <Model<S> as LinearModel<S::Scalar>>::Factors,
    complex: <Model<S> as LinearModel<S::Scalar>>::ComplexFactors,
    /// 1/h.
    reciprocal: S::Scalar,
}

impl<S: LinearizedSystem> Systems<S> {
    fn of(linear: Model<S>, h: S::Scalar) -> Self {
        let reciprocal = h.recip();
        let [shift, re, im] = [REAL, COMPLEX[0], COMPLEX[1]].map(|x| reciprocal * S::Scalar::from_f64(x));
        let zero = S::Scalar::zero();
        let entry = |shift: S::Scalar, row: usize, column: usize| {
            let slope = linear.by_state(row, column);
            if row == column { shift - slope } else { -slope }
        };
        let complex = |row, column| Complex { re: entry(re, row, column), im: if row == column { im } else { zero } };
        Self {
            rate: *linear.rate(),
            real: Model::<S>::factor(|row, column| entry(shift, row, column)),
            complex: Model::<S>::factor_complex(complex),
            reciprocal,
        }
    }

    /// The change of the modes by a sweep that finds these rates at the stages.
    fn change(&self, rates: &Triple<S>, modes: &Triple<S>) -> Triple<S> {
        let [real, re, im] = combined::<S>(&MODES_OF_STAGES, rates);
        let [shift, alpha, beta] = [REAL, COMPLEX[0], COMPLEX[1]].map(|x| self.reciprocal * S::Scalar::from_f64(x));
        let real = self.real.solve(&real.add_scaled(-shift, &modes[0]));
        let [re, im] = self.complex.solve(&[
            re.add_scaled(-alpha, &modes[1]).add_scaled(beta, &modes[2]),
            im.add_scaled(-alpha, &modes[2]).add_scaled(-beta, &modes[1]),
        ]);
        [real, re, im]
    }

    /// The estimated error of a step with these stages.
    fn error(&self, stages: &Triple<S>) -> Vector<S> {
        let mut right = self.rate;
        for (factor, stage) in ESTIMATE.into_iter().zip(stages) {
            right = right.add_scaled(self.reciprocal * S::Scalar::from_f64(factor), stage);
        }
        self.real.solve(&right).scale(-S::Scalar::one())
    }
}

/// The last stage, and the estimated error. A lane that is done is left as it is while others go on, so that it has
/// the bits that it has alone.
fn iterate<S: LinearizedSystem, P: Problem<System = S>>(
    problem: &P,
    start: &Start<S>,
    systems: &Systems<S>,
    h: S::Scalar,
) -> Result<(Vector<S>, Vector<S>), IntegrationErrorKind> {
    // The solution of linear equations that the time does not change costs no evaluation.
    let mut modes = systems.change(&[systems.rate; STAGES], &[Vector::<S>::zero(); STAGES]);
    let mut stages = combined::<S>(&STAGES_OF_MODES, &modes);
    let mut sizes = Sizes::of(start, &stages, h);
    let mut progress = NewtonProgress::<S::Scalar>::of(sizes.largest(&stages).0);
    loop {
        let mut rates = stages;
        for i in 0..STAGES {
            let t = S::Scalar::from_f64(TIMES[i]).fma(h, start.t);
            rates[i] = start.rates(problem, &stages[i], &start.moved(&stages[i])?, t);
        }
        let change = systems.change(&rates, &modes);
        for i in 0..STAGES {
            modes[i] = progress.kept::<S>(&modes[i].add_scaled(S::Scalar::one(), &change[i]), &modes[i]);
        }
        stages = combined::<S>(&STAGES_OF_MODES, &modes);
        let error = systems.error(&stages);
        sizes = Sizes::of(start, &stages, h);
        let changed = sizes.largest(&combined::<S>(&STAGES_OF_MODES, &change));
        if progress.finished(changed, sizes.of_vector(&error).0)? {
            return Ok((stages[STAGES - 1], error));
        }
    }
}

/// Sizes that changes of a step are measured against, lane by lane.
struct Sizes<'a, S: LinearizedSystem> {
    start: &'a Start<S>,
    /// Distance that the configuration moves, the largest of its numbers, and the largest speed.
    moved: S::Scalar,
    configuration: S::Scalar,
    speeds: S::Scalar,
    length: S::Scalar,
}

impl<'a, S: LinearizedSystem> Sizes<'a, S> {
    fn of(start: &'a Start<S>, stages: &Triple<S>, h: S::Scalar) -> Self {
        // In the origin at rest nothing has a size.
        let least = S::Scalar::from_f64(1e-30);
        let (mut moved, mut speeds, places) = (least, least, TangentOf::<S>::DIM);
        let (start_speeds, last) = (&start.z, &stages[STAGES - 1]);
        for i in 0..places {
            moved = moved.max(last.component(i).abs());
        }
        for i in 0..S::Speeds::DIM {
            let speed = start_speeds.component(i);
            speeds = speeds.max(speed.abs()).max((speed + last.component(places + i)).abs());
        }
        let configuration = (0..places).fold(moved, |size, i| size.max(start.q.magnitudes(i)));
        Self { start, moved, configuration, speeds, length: h.abs() }
    }

    /// The largest component of an increment, relative to what it is added to; and relative to what rounding leaves of
    /// the configuration, and of speeds as its change in the step.
    fn of_vector(&self, increment: &Vector<S>) -> (S::Scalar, S::Scalar) {
        let (mut relative, mut rounding) = (S::Scalar::zero(), S::Scalar::zero());
        let places = TangentOf::<S>::DIM;
        for i in 0..Vector::<S>::DIM {
            let size = increment.component(i).abs();
            if i < places {
                relative = relative.max(size / self.start.q.magnitudes(i).max(self.moved));
                rounding = rounding.max(size / self.configuration);
            } else {
                relative = relative.max(size / self.speeds);
                rounding = rounding.max(size * self.length / self.configuration);
            }
        }
        (relative, rounding)
    }

    fn largest(&self, of: &Triple<S>) -> (S::Scalar, S::Scalar) {
        let [a, b, c] = [0, 1, 2].map(|i| self.of_vector(&of[i]));
        (a.0.max(b.0).max(c.0), a.1.max(b.1).max(c.1))
    }
}

/// Follows Newton's iteration, lane by lane.
struct NewtonProgress<T> {
    sweeps: u32,
    /// 1 in lanes that are on their way, 0 in those that are done.
    active: T,
    /// The change by the sweep before.
    last: T,
}

impl<T: Real> NewtonProgress<T> {
    /// Begins at stages of this size.
    fn of(size: T) -> Self {
        Self { sweeps: 0, active: T::one(), last: size }
    }

    /// The new vector in lanes that are on their way, the old one elsewhere.
    fn kept<S: LinearizedSystem<Scalar = T>>(&self, new: &Vector<S>, old: &Vector<S>) -> Vector<S> {
        let mut kept = *new;
        for i in 0..Vector::<S>::DIM {
            kept.set_component(i, T::select_lt(T::zero(), self.active, new.component(i), old.component(i)));
        }
        kept
    }

    /// Takes the change by one more sweep, relative to the state and to what rounding does, and the estimated error of
    /// the step; whether all lanes are done.
    fn finished(&mut self, (changed, rounding): (T, T), error: T) -> Result<bool, IntegrationErrorKind> {
        self.sweeps += 1;
        let (zero, one, number) = (T::zero(), T::one(), T::from_f64);
        // Stages begin off by the square of their size, of which the first sweep takes as large a part again.
        let first = number(if self.sweeps == 1 { 8.0 } else { 1.0 });
        let rate = first * changed / self.last.max(number(1e-30));
        let left = changed * rate / (one - rate);
        let goal = (number(SHARE) * error * error.sqrt()).max(number(4.0 * T::EPSILON));
        let solved = T::select_lt(rate, one, T::select_lt(left, goal, zero, self.active), self.active);
        // What is small and gets no smaller is rounding: equations that cancel have more of it than the state.
        let noise = number(power(T::EPSILON, 2.0 / 3.0));
        let idle = T::select_lt(rate, number(0.5), solved, zero);
        self.active = T::select_lt(rounding, noise, T::select_lt(zero, solved, idle, zero), solved);
        let mut all = true;
        for lane in (0..T::LANES).filter(|&lane| self.active.lane(lane) > 0.0) {
            let [changed, rate, left, goal, last] = [changed, rate, left, goal, self.last].map(|x| x.lane(lane));
            if changed.is_nan() || changed == f64::INFINITY {
                // What the iteration itself has driven out of range is no fault of the equations: it ran away.
                return Err(if self.sweeps > 1 && last > FAR {
                    IntegrationErrorKind::NotConverged { iterations: self.sweeps, residual: last }
                } else {
                    IntegrationErrorKind::NonFinite { part: RunPart::Step }
                });
            }
            let ahead = (self.sweeps..MOST_SWEEPS).fold(left, |left, _| left * rate);
            if self.sweeps == MOST_SWEEPS || self.sweeps > 1 && (rate >= 1.0 || ahead > goal) {
                return Err(IntegrationErrorKind::NotConverged { iterations: self.sweeps, residual: changed });
            }
            all = false;
        }
        self.last = changed;
        Ok(all)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    type Matrix = [[f64; STAGES]; STAGES];

    fn product(a: &Matrix, b: &Matrix) -> Matrix {
        core::array::from_fn(|i| core::array::from_fn(|j| (0..STAGES).map(|k| a[i][k] * b[k][j]).sum()))
    }

    fn near(what: &str, a: &Matrix, b: &Matrix) {
        let off = (0..9).map(|n| (a[n / 3][n % 3] - b[n / 3][n % 3]).abs()).fold(0.0, f64::max);
        // Sums of three products of numbers up to 20.
        assert!(off < 3.0 * 20.0 * f64::EPSILON, "{what}: {off:e}");
    }

    /// A of the method, from its definition: stage i is the integral, up to its time, of the polynomial through the
    /// rates at the three times.
    fn matrix() -> Matrix {
        let lagrange = |j: usize, upto: f64| {
            let [a, b] = [(j + 1) % 3, (j + 2) % 3].map(|k| TIMES[k]);
            let antiderivative = upto * upto * upto / 3.0 - (a + b) * upto * upto / 2.0 + a * b * upto;
            antiderivative / ((TIMES[j] - a) * (TIMES[j] - b))
        };
        core::array::from_fn(|i| core::array::from_fn(|j| lagrange(j, TIMES[i])))
    }

    /// Times are the zeros of d²/dx² (x² (x − 1)³), so that the quadrature by the last row is exact up to degree 4.
    #[test]
    fn order_conditions() {
        let weights = matrix()[STAGES - 1];
        for power in 0..6 {
            let sum: f64 = weights.iter().zip(TIMES).map(|(weight, time)| weight * time.powi(power)).sum();
            let off = (sum - 1.0 / f64::from(power + 1)).abs();
            assert!(if power < 5 { off < 4.0 * f64::EPSILON } else { off > 1e-4 }, "{power}: {off:e}");
        }
    }

    /// A T Λ = T, with Λ the real mode and the pair.
    #[test]
    fn modes_are_those_of_the_method() {
        let [alpha, beta] = COMPLEX;
        let eigenvalues = [[REAL, 0.0, 0.0], [0.0, alpha, -beta], [0.0, beta, alpha]];
        let one = core::array::from_fn(|i| core::array::from_fn(|j| if i == j { 1.0 } else { 0.0 }));
        near("inverse", &product(&MODES_OF_STAGES, &STAGES_OF_MODES), &one);
        near("modes", &product(&matrix(), &product(&STAGES_OF_MODES, &eigenvalues)), &STAGES_OF_MODES);
    }

    /// The stages of rates xᵏ are c^(k+1)/(k + 1), and an estimate of order 3 sees nothing of k ≤ 2.
    #[test]
    fn the_estimate_is_of_order_3() {
        for power in 0..4_u8 {
            let last = f64::from(power + 1);
            let sum: f64 = ESTIMATE.iter().zip(TIMES).map(|(e, time)| e * time.powi(i32::from(power) + 1) / last).sum();
            let off = (sum + if power == 0 { 1.0 } else { 0.0 }).abs();
            assert!(if power < 3 { off < 16.0 * f64::EPSILON } else { off > 1e-3 }, "{power}: {off:e}");
        }
    }
}
