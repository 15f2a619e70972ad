//! One body with coordinates and speeds of its own: the way back from poses and twists.

use nalgebra::{Isometry3, SVector};

use crate::chart::{ChartError, MotionRule};
use crate::configuration::{Configuration, VectorSpace};
use crate::real::Real;
use crate::system::RigidBodySystem;

use super::poses::pose_from_quaternion;

type Twist<T> = [T; 6];
type Tangent<S> = <<S as crate::system::GaussSystem>::Configuration as Configuration>::Tangent;

/// Columns that are shorter than this many roundings, once those before are taken out, are combinations of them.
const DEPENDENT: f64 = 64.0;
/// Roundings that a pose may be off.
const OFF: f64 = 64.0;
/// Steps from one start, and starts.
const STEPS: usize = 60;
const STARTS: usize = 24;

/// The pose with R, row by row, and b. The largest component of the quaternion is found first, so that none is the root
/// of a difference (Shepperd, J. Guidance and Control 1, 1978).
pub fn pose_from_rows<T: Real>([a, b, c]: [[T; 3]; 3], position: [T; 3]) -> Isometry3<T> {
    let one = T::one();
    // Each is 4 q_i q, by the component q_i.
    let candidates = [
        [one + a[0] - b[1] - c[2], a[1] + b[0], a[2] + c[0], c[1] - b[2]],
        [a[1] + b[0], one - a[0] + b[1] - c[2], b[2] + c[1], a[2] - c[0]],
        [a[2] + c[0], b[2] + c[1], one - a[0] - b[1] + c[2], b[0] - a[1]],
        [c[1] - b[2], a[2] - c[0], b[0] - a[1], one + a[0] + b[1] + c[2]],
    ];
    let (mut best, mut size) = (candidates[3], candidates[3][3]);
    for (i, candidate) in candidates.iter().enumerate().take(3) {
        for (component, &other) in best.iter_mut().zip(candidate) {
            *component = T::select_lt(size, candidate[i], other, *component);
        }
        size = T::select_lt(size, candidate[i], candidate[i], size);
    }
    let square = best.iter().fold(T::zero(), |sum, &x| x.fma(x, sum));
    let over = square.sqrt().recip();
    pose_from_quaternion(best.map(|x| x * over), position)
}

/// The speeds whose twist is nearest to the given one; 0 for a speed whose twist those before it can make.
pub fn speeds_of_twist<S: RigidBodySystem, const N: usize>(
    system: &S,
    t: S::Scalar,
    q: &S::Configuration,
    twist: &SVector<S::Scalar, 6>,
) -> S::Speeds {
    let (rest, columns) = twists_of_speeds::<S, N>(system, t, q);
    let found = LeastSquares::new(columns).refined(difference(twist.data.0[0], rest));
    let mut speeds = S::Speeds::zero();
    found.into_iter().enumerate().for_each(|(k, z)| speeds.set_component(k, z));
    speeds
}

/// Least part of a twist that is left once those of the other speeds are taken out of it.
pub fn determinacy_of_speeds<S: RigidBodySystem, const N: usize>(
    system: &S,
    t: S::Scalar,
    q: &S::Configuration,
) -> S::Scalar {
    LeastSquares::new(twists_of_speeds::<S, N>(system, t, q).1).least
}

/// The twist at rest, and what each speed adds to it.
fn twists_of_speeds<S: RigidBodySystem, const N: usize>(
    system: &S,
    t: S::Scalar,
    q: &S::Configuration,
) -> (Twist<S::Scalar>, [Twist<S::Scalar>; N]) {
    let twist = |z: &S::Speeds| system.body_twist(t, q, z).data.0[0];
    let rest = twist(&S::Speeds::zero());
    let columns = core::array::from_fn(|k| {
        let mut unit = S::Speeds::zero();
        unit.set_component(k, S::Scalar::one());
        difference(twist(&unit), rest)
    });
    (rest, columns)
}

fn difference<T: Real>(a: Twist<T>, b: Twist<T>) -> Twist<T> {
    core::array::from_fn(|i| a[i] - b[i])
}

/// The configuration with this pose, by Newton's method with steps that are shortened until the pose comes nearer.
///
/// `start` has groups at the identity and scalars zero; `twists` are those that components of an increment make.
///
/// # Errors
/// [`ChartError::Inexpressible`] where none is found; [`ChartError::NonFinite`].
pub fn configuration_of_pose<S: RigidBodySystem, const N: usize>(
    system: &S,
    t: S::Scalar,
    pose: &Isometry3<S::Scalar>,
    start: S::Configuration,
    twists: impl Fn(&S::Configuration) -> [Twist<S::Scalar>; N],
) -> Result<S::Configuration, ChartError> {
    if !Configuration::is_finite(pose) {
        return Err(ChartError::NonFinite);
    }
    let search = PoseSearch { system, t, pose, twists };
    let mut best = NearestConfiguration {
        q: start,
        off: S::Scalar::from_f64(f64::INFINITY),
        far: S::Scalar::from_f64(f64::INFINITY),
    };
    for attempt in 0..STARTS {
        let mut scattered = Tangent::<S>::zero();
        (0..N).for_each(|k| scattered.set_component(k, S::Scalar::from_f64(scatter(attempt, k))));
        best = best.or(search.descended(start.retract(&scattered)));
        if within(best.off, OFF) {
            return Ok(best.q.renormalise());
        }
    }
    let lane = (0..S::Scalar::LANES).find(|&lane| !matches!(best.off.lane(lane), off if off <= OFF)).unwrap_or(0);
    Err(ChartError::Inexpressible { rule: MotionRule::Pose, value: best.far.lane(lane) })
}

/// Zero first, then points of a cube, spread evenly.
fn scatter(attempt: usize, component: usize) -> f64 {
    let (attempt, irrational) = (attempt as f64, [0.618_034, 0.414_214, 0.732_051, 0.236_068, 0.645_751, 0.316_625]);
    let place = (attempt * (irrational[component % 6] + (component / 6) as f64 * 0.123_457)) % 1.0;
    if attempt == 0.0 { 0.0 } else { 6.0 * place - 3.0 }
}

/// A configuration, what its pose is off in roundings, and as an angle or a length.
struct NearestConfiguration<S: RigidBodySystem> {
    q: S::Configuration,
    off: S::Scalar,
    far: S::Scalar,
}

impl<S: RigidBodySystem> NearestConfiguration<S> {
    /// The nearer one, lane by lane.
    fn or(self, other: Self) -> Self {
        let pick = |new, old| S::Scalar::select_lt(other.off, self.off, new, old);
        Self { q: chosen::<S>(&other.q, &self.q, pick), off: pick(other.off, self.off), far: pick(other.far, self.far) }
    }
}

/// Components of one or the other.
fn chosen<S: RigidBodySystem>(
    new: &S::Configuration,
    old: &S::Configuration,
    pick: impl Fn(S::Scalar, S::Scalar) -> S::Scalar,
) -> S::Configuration {
    let (new, mut components) = (new.components(), old.components());
    for i in 0..<S::Configuration as Configuration>::Components::DIM {
        components.set_component(i, pick(new.component(i), components.component(i)));
    }
    S::Configuration::from_components(&components)
}

struct PoseSearch<'a, S: RigidBodySystem, F> {
    system: &'a S,
    t: S::Scalar,
    pose: &'a Isometry3<S::Scalar>,
    twists: F,
}

impl<S: RigidBodySystem, F, const N: usize> PoseSearch<'_, S, F>
where
    F: Fn(&S::Configuration) -> [Twist<S::Scalar>; N],
{
    /// The twist that would bring the pose there in unit time.
    fn missing(&self, q: &S::Configuration) -> Twist<S::Scalar> {
        Configuration::difference(&self.system.pose(self.t, q), self.pose).data.0[0]
    }

    fn descended(&self, mut q: S::Configuration) -> NearestConfiguration<S> {
        let (zero, one) = (S::Scalar::zero(), S::Scalar::one());
        let (mut missing, mut part) = (self.missing(&q), one);
        let mut polished = 0;
        for _ in 0..STEPS {
            let squares = LeastSquares::new((self.twists)(&q));
            let step = squares.solved(missing);
            let mut increment = Tangent::<S>::zero();
            step.into_iter().enumerate().for_each(|(k, x)| increment.set_component(k, part * x));
            let next = q.retract(&increment).renormalise();
            let left = self.missing(&next);
            let (before, after) = (squares.square(missing), squares.square(left));
            let pick = |new, old| S::Scalar::select_lt(after, before, new, old);
            q = chosen::<S>(&next, &q, pick);
            missing = core::array::from_fn(|i| pick(left[i], missing[i]));
            let (longer, shorter) = (part + part, part * S::Scalar::ratio(1, 4));
            part = pick(S::Scalar::select_lt(longer, one, longer, one), shorter);
            // Once more, to the last digits.
            polished += usize::from(within(self.off(&q, missing), OFF));
            if polished > 1 || within(part, f64::EPSILON) {
                break;
            }
        }
        let norm = |a: &[S::Scalar]| a.iter().fold(zero, |sum, &x| x.fma(x, sum)).sqrt();
        let (u, omega) = (norm(&missing[..3]), norm(&missing[3..]));
        NearestConfiguration { off: self.off(&q, missing), q, far: S::Scalar::select_lt(u, omega, omega, u) }
    }

    /// The difference from the pose in units of rounding of its terms: b, and the contribution of each coordinate.
    fn off(&self, q: &S::Configuration, missing: Twist<S::Scalar>) -> S::Scalar {
        let norm = |a: &[S::Scalar]| a.iter().fold(S::Scalar::zero(), |sum, &x| x.fma(x, sum)).sqrt();
        let mut scales = [norm(&self.pose.translation.vector.data.0[0]), S::Scalar::one()];
        for (k, twist) in (self.twists)(q).iter().enumerate() {
            let magnitude = S::Scalar::from_f64(q.magnitude(k));
            scales[0] += magnitude * norm(&twist[..3]);
            scales[1] += magnitude * norm(&twist[3..]);
        }
        let epsilon = S::Scalar::from_f64(S::Scalar::EPSILON);
        let (u, omega) = (norm(&missing[..3]), norm(&missing[3..]));
        // Nothing is off where nothing is missing, whatever its scale.
        let linear = S::Scalar::select_lt(S::Scalar::zero(), u, u / (epsilon * scales[0]), u);
        let angular = omega / (epsilon * scales[1]);
        S::Scalar::select_lt(linear, angular, angular, linear)
    }
}

/// Whether this is so in every lane.
fn within<T: Real>(value: T, bound: f64) -> bool {
    (0..T::LANES).all(|lane| value.lane(lane) <= bound)
}

/// `Σ x_k a_k = right` as nearly as can be, by orthogonalising the columns (modified Gram–Schmidt, each twice).
///
/// Velocities are divided by the longest lever among the columns, so that the result does not depend on the unit of
/// length.
struct LeastSquares<T, const N: usize> {
    columns: [Twist<T>; N],
    orthogonal: [Twist<T>; N],
    /// Inverses of the squares of the orthogonal columns; 0 for a column that those before it can make.
    inverses: [T; N],
    /// Shares of the orthogonal columns before it in column k.
    shares: [[T; N]; N],
    over_lever: T,
    /// The least part of a column that those before it cannot make.
    least: T,
}

impl<T: Real, const N: usize> LeastSquares<T, N> {
    fn new(columns: [Twist<T>; N]) -> Self {
        let (zero, one) = (T::zero(), T::one());
        let over_lever = over_lever(&columns);
        let columns = columns.map(|column| weighted(over_lever, column));
        let mut new =
            Self { columns, orthogonal: columns, inverses: [zero; N], shares: [[zero; N]; N], over_lever, least: one };
        for k in 0..N {
            let mut column = columns[k];
            for j in (0..k).chain(0..k) {
                let share = dot(&new.orthogonal[j], &column) * new.inverses[j];
                column = reduced(column, share, &new.orthogonal[j]);
                new.shares[k][j] += share;
            }
            let (square, whole) = (dot(&column, &column), dot(&columns[k], &columns[k]));
            let rounding = DEPENDENT * T::EPSILON;
            let nothing = T::from_f64(rounding * rounding) * whole;
            new.inverses[k] = T::select_lt(nothing, square, square.recip(), zero);
            let part = T::select_lt(nothing, square, (square / whole).sqrt(), zero);
            new.least = T::select_lt(part, new.least, part, new.least);
            new.orthogonal[k] = column;
        }
        new
    }

    /// The square of a twist, with velocities over the lever.
    fn square(&self, twist: Twist<T>) -> T {
        let twist = weighted(self.over_lever, twist);
        dot(&twist, &twist)
    }

    fn solved(&self, right: Twist<T>) -> [T; N] {
        self.solved_weighted(weighted(self.over_lever, right))
    }

    /// Once more from what is left.
    fn refined(&self, right: Twist<T>) -> [T; N] {
        let right = weighted(self.over_lever, right);
        let first = self.solved_weighted(right);
        let left = self.columns.iter().zip(first).fold(right, |left, (column, x)| reduced(left, x, column));
        let second = self.solved_weighted(left);
        core::array::from_fn(|k| first[k] + second[k])
    }

    fn solved_weighted(&self, mut right: Twist<T>) -> [T; N] {
        let mut x = [T::zero(); N];
        for k in 0..N {
            x[k] = dot(&self.orthogonal[k], &right) * self.inverses[k];
            right = reduced(right, x[k], &self.orthogonal[k]);
        }
        for k in (0..N).rev() {
            x[k] = (k + 1..N).fold(x[k], |sum, j| sum - self.shares[j][k] * x[j]);
        }
        x
    }
}

/// One over the longest of |u|/|ω| among the columns; 1 where nothing turns, or nothing moves.
fn over_lever<T: Real, const N: usize>(columns: &[Twist<T>; N]) -> T {
    let square = |a: &[T]| a.iter().fold(T::zero(), |sum, &x| x.fma(x, sum));
    let mut longest = T::zero();
    for column in columns {
        let (u, omega) = (square(&column[..3]), square(&column[3..]));
        let lever = T::select_lt(T::zero(), omega, u / omega, T::zero());
        longest = T::select_lt(longest, lever, lever, longest);
    }
    T::select_lt(T::zero(), longest, longest.sqrt().recip(), T::one())
}

fn weighted<T: Real>(over_lever: T, [a, b, c, d, e, f]: Twist<T>) -> Twist<T> {
    [over_lever * a, over_lever * b, over_lever * c, d, e, f]
}

fn dot<T: Real>(a: &Twist<T>, b: &Twist<T>) -> T {
    a.iter().zip(b).fold(T::zero(), |sum, (&x, &y)| x.fma(y, sum))
}

/// `a − x·b`.
fn reduced<T: Real>(a: Twist<T>, x: T, b: &Twist<T>) -> Twist<T> {
    core::array::from_fn(|i| a[i] - x * b[i])
}
