//! What holds for every system at every state, and for two descriptions of one system.
//!
//! Derivatives along the flow are central differences of order 8 on the curve `t + s, q ∘ exp(s q̇), z + s ż`, which
//! touches the true motion: nothing but the kernel is needed for them, and no second scalar.
//!
//! What is allowed is rounding, 8√N units in the last place for methods of N operations, each of which rounds once and
//! in either direction, of terms as large as [`Sizes`] says; and in differences, which divide it by the step, a
//! truncation of 1e-12.

use gauss_runtime::constraint::project;
use gauss_runtime::description::OperationCount;
use gauss_runtime::forces::Columns;
use gauss_runtime::prelude::*;

/// A kernel, whatever its inputs.
pub trait Driven: GaussSystem<Scalar = f64, Speeds: PartialEq> + DescribedSystem {}

impl<S> Driven for S where S: GaussSystem<Scalar = f64, Speeds: PartialEq> + DescribedSystem {}

/// A kernel that runs by itself.
pub trait System: Driven + GaussSystem<Input = ()> {}

impl<S> System for S where S: Driven + GaussSystem<Input = ()> {}

type Tangent<S> = <<S as GaussSystem>::Configuration as Configuration>::Tangent;

/// How time enters a system.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Time {
    /// Not at all: T is a quadratic form of z and T + V is constant.
    Absent,
    /// In the positions, but not in T and V: p·z − T + V is constant (Jacobi's integral).
    Hidden,
    /// In T or V: nothing of the kind is constant.
    Explicit,
}

/// Components as numbers.
pub fn list<V: VectorSpace<f64>>(v: &V) -> Vec<f64> {
    (0..V::DIM).map(|i| v.component(i)).collect()
}

/// A vector from its components.
pub fn vector<V: VectorSpace<f64>>(components: &[f64]) -> V {
    assert_eq!(components.len(), V::DIM);
    let mut v = V::zero();
    components.iter().enumerate().for_each(|(i, &c)| v.set_component(i, c));
    v
}

fn dot<V: VectorSpace<f64>>(a: &V, b: &V) -> f64 {
    (0..V::DIM).map(|i| a.component(i) * b.component(i)).sum()
}

/// A NaN counts as the largest.
fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |m: f64, x| if x.abs() > m || x.is_nan() { x.abs() } else { m })
}

/// The state of a system, and where it goes: `t, q, z` with q̇ and ż.
pub struct Flow<S: GaussSystem> {
    t: f64,
    q: S::Configuration,
    z: S::Speeds,
    velocity: Tangent<S>,
    /// ż.
    pub acceleration: S::Speeds,
    /// The step of differences: small against the time in which anything turns by a radian.
    step: f64,
}

impl<S: System> Flow<S> {
    /// At a state.
    pub fn new(system: &S, t: f64, q: &S::Configuration, z: &S::Speeds) -> Self {
        Self::driven(system, t, (q, z), &())
    }
}

impl<S: Driven> Flow<S> {
    /// At a state with values of inputs.
    pub fn driven(system: &S, t: f64, (q, z): (&S::Configuration, &S::Speeds), input: &S::Input) -> Self {
        let velocity = system.configuration_rates(t, q, z, input);
        let acceleration = system.acceleration(t, q, z, input);
        // Even functions of eight times the fastest angle have a truncation of (8/200)⁸/630 ≈ 1e-14.
        let step = 1.0 / (200.0 * velocity.max_norm().max(1.0));
        Self { t, q: *q, z: *z, velocity, acceleration, step }
    }

    /// The state after `s`, correct to the first order.
    pub fn at(&self, s: f64) -> (f64, S::Configuration, S::Speeds) {
        (self.t + s, self.q.retract(&self.velocity.scale(s)), self.z.add_scaled(s, &self.acceleration))
    }

    /// The derivative of a function of the state along the flow.
    pub fn rate(&self, f: impl Fn(f64, &S::Configuration, &S::Speeds) -> Vec<f64>) -> Vec<f64> {
        self.differences(|s| {
            let (t, q, z) = self.at(s);
            f(t, &q, &z)
        })
    }

    /// The derivative at 0 of what changes as fast as the state.
    fn differences(&self, at: impl Fn(f64) -> Vec<f64>) -> Vec<f64> {
        const WEIGHTS: [f64; 4] = [4.0 / 5.0, -1.0 / 5.0, 4.0 / 105.0, -1.0 / 280.0];
        let mut sum = vec![0.0; at(0.0).len()];
        for (weight, k) in WEIGHTS.into_iter().zip(1..) {
            let s = self.step * f64::from(k);
            for ((sum, after), before) in sum.iter_mut().zip(at(s)).zip(at(-s)) {
                *sum += weight * (after - before) / self.step;
            }
        }
        sum
    }

    /// What rounding and truncation leave of a difference, in parts of what it is a difference of: the weights add up
    /// to 2.1.
    fn slack(&self, rounding: f64) -> f64 {
        2.1 * rounding / self.step + 1e-12
    }
}

/// How large the terms are that the results at a state are sums of; what cancels among them is not seen in the results.
/// All are sums of magnitudes, the largest over the components.
#[derive(Clone, Copy, Debug)]
pub struct Sizes {
    /// The rows of A.
    pub mass: f64,
    /// |q̇|, at least 1.
    pub velocity: f64,
    /// Momenta, |A||z|.
    pub momentum: f64,
    /// Generalised forces, |A|(|ż| + |q̇||z|) and the slopes of the potential.
    pub force: f64,
    /// ż, as far as A lets errors of forces through: |A⁻¹| by the forces.
    pub acceleration: f64,
    /// ṗ when z comes from p: |A||A⁻¹| by the forces.
    pub returned: f64,
    /// Kinetic and potential energy.
    pub energy: f64,
    /// What N operations of the dearest method do to a result, in parts of such a term: 8√N roundings.
    pub rounding: f64,
}

impl Sizes {
    /// At a state.
    pub fn of<S: System>(system: &S, t: f64, q: &S::Configuration, z: &S::Speeds) -> Self {
        Self::driven(system, t, (q, z), &())
    }

    /// At a state with values of inputs.
    pub fn driven<S: Driven>(system: &S, t: f64, (q, z): (&S::Configuration, &S::Speeds), input: &S::Input) -> Self {
        let at_rest = S::Speeds::zero();
        let units: Vec<S::Speeds> = (0..S::DOF)
            .map(|i| {
                let mut e = at_rest;
                e.set_component(i, 1.0);
                e
            })
            .collect();
        let potential = system.potential_energy(t, q);
        let slopes: Vec<f64> = (0..Tangent::<S>::DIM)
            .map(|i| {
                let mut e = Tangent::<S>::zero();
                e.set_component(i, 1e-3);
                (system.potential_energy(t, &q.retract(&e)) - potential) / 1e-3
            })
            .collect();
        // Rows of |A|, of |A⁻¹| (which is symmetric), and of ∂q̇/∂z by the slopes.
        let matrix = system.mass_matrix(t, q);
        let rows: Vec<Vec<f64>> = (0..S::DOF).map(|i| (0..S::DOF).map(|j| matrix[(i, j)].abs()).collect()).collect();
        let (still, drift) = (system.velocity(t, q, &at_rest), system.kinematics(t, q, &at_rest));
        let inverse: Vec<Vec<f64>> =
            units.iter().map(|e| list(&system.velocity(t, q, e).add_scaled(-1.0, &still))).collect();
        let weight = units.iter().map(|e| {
            let along = list(&system.kinematics(t, q, e).add_scaled(-1.0, &drift));
            along.iter().zip(&slopes).map(|(a, b)| (a * b).abs()).sum::<f64>()
        });
        let by = |rows: &[Vec<f64>], v: &[f64]| -> Vec<f64> {
            rows.iter().map(|row| row.iter().zip(v).map(|(a, b)| (a * b).abs()).sum()).collect()
        };

        let velocity = system.kinematics(t, q, z).max_norm().max(1.0);
        let speed = z.max_norm().max(1.0);
        let acceleration: Vec<f64> =
            list(&system.acceleration(t, q, z, input)).iter().map(|a| a.abs() + speed * velocity).collect();
        let forces: Vec<f64> = by(&rows, &acceleration).iter().zip(weight).map(|(a, b)| a + b).collect();
        let momenta = by(&rows, &vec![speed; S::DOF]);
        let accelerations = by(&inverse, &forces);
        let o = S::OPERATIONS;
        let methods = [
            o.acceleration,
            o.momentum,
            o.velocity,
            o.momentum_rate,
            o.gauss_residual,
            o.constraint_function,
            o.powers,
        ];
        let operations = methods.iter().map(OperationCount::total).max().map_or(0.0, f64::from).max(16.0);
        Self {
            mass: largest(&by(&rows, &vec![1.0; S::DOF])),
            velocity,
            momentum: largest(&momenta),
            force: largest(&forces),
            returned: largest(&by(&rows, &accelerations)),
            acceleration: largest(&accelerations),
            energy: largest(&momenta) * speed + potential.abs() + largest(&slopes),
            rounding: 8.0 * operations.sqrt() * f64::EPSILON,
        }
    }
}

/// Every component is within `allowed` of what is expected; a NaN is not.
#[track_caller]
fn near(what: &str, found: &[f64], expected: &[f64], allowed: f64) {
    assert_eq!(found.len(), expected.len(), "{what}");
    let error = largest(&found.iter().zip(expected).map(|(a, b)| a - b).collect::<Vec<_>>());
    assert!(error <= allowed, "{what}: off by {error:e}, allowed {allowed:e}: {found:?} against {expected:?}");
}

/// A direction in the space of speeds that no symmetry prefers.
fn direction<S: Driven>() -> S::Speeds {
    vector(&(0..S::DOF).map(|i| if i % 2 == 0 { 1.0 } else { -0.7 } + 0.1 * i as f64).collect::<Vec<_>>())
}

/// What holds at every state of every system, with constraints or without; with constraints the state must be on them.
///
/// - The Gauss residual is zero at ż and grows as A away from it.
/// - A belongs to T and to p, is symmetric and positive, and `velocity` undoes `momentum`.
/// - ṗ is the rate of p along the flow.
/// - Energy, or what takes its place, is constant along the flow.
///
/// # Panics
/// When one of them does not hold.
#[track_caller]
pub fn laws<S: System>(system: &S, t: f64, q: &S::Configuration, z: &S::Speeds, time: Time) {
    let sizes = Sizes::of(system, t, q, z);
    let rounding = sizes.rounding;
    let flow = Flow::new(system, t, q, z);
    let acceleration = flow.acceleration;
    let d = direction::<S>();
    let matrix = system.mass_matrix(t, q);
    let times = |v: &S::Speeds| -> Vec<f64> {
        (0..S::DOF).map(|i| (0..S::DOF).map(|j| matrix[(i, j)] * v.component(j)).sum()).collect()
    };
    let forward = acceleration.add_scaled(1.0, &d);

    let residual = system.gauss_residual(t, q, z, &acceleration, &());
    near("residual", &list(&residual), &vec![0.0; S::DOF], rounding * sizes.force);
    let moved = system.gauss_residual(t, q, z, &forward, &());
    near("residual away from ż", &list(&moved), &times(&d), 2.0 * rounding * (sizes.force + 3.0 * sizes.mass));

    let p = system.momentum(t, q, z);
    let faster = system.momentum(t, q, &z.add_scaled(1.0, &d)).add_scaled(-1.0, &p);
    near("∂p/∂z", &list(&faster), &times(&d), 4.0 * rounding * sizes.momentum);
    let kinetic = |s: f64| system.kinetic_energy(t, q, &z.add_scaled(s, &d));
    let square: f64 = times(&d).iter().zip(list(&d)).map(|(a, b)| a * b).sum();
    assert!(square > 0.0, "A is not positive: {square}");
    near("∂²T/∂z²", &[kinetic(1.0) + kinetic(-1.0) - 2.0 * kinetic(0.0)], &[square], 16.0 * rounding * sizes.energy);
    let symmetric = (0..S::DOF).all(|i| (0..i).all(|j| matrix[(i, j)] == matrix[(j, i)]));
    assert!(symmetric, "A is not symmetric");
    let again = system.momentum(t, q, &system.velocity(t, q, &p));
    near("momentum of the velocity", &list(&again), &list(&p), 2.0 * rounding * sizes.momentum);

    let rate = flow.rate(|t, q, z| list(&system.momentum(t, q, z)));
    let allowed = flow.slack(rounding) * sizes.momentum + rounding * sizes.returned;
    near("ṗ along the flow", &list(&system.momentum_rate(t, q, &p, &())), &rate, allowed);

    let energy = |t: f64, q: &S::Configuration, z: &S::Speeds| {
        let (kinetic, potential) = (system.kinetic_energy(t, q, z), system.potential_energy(t, q));
        let sum = system.energy(t, q, z);
        near("energy", &[sum], &[kinetic + potential], 2.0 * f64::EPSILON * (kinetic + potential.abs()));
        vec![if time == Time::Absent { sum } else { dot(&system.momentum(t, q, z), z) - kinetic + potential }]
    };
    let power = flow.rate(energy);
    let allowed = flow.slack(rounding) * sizes.energy + rounding * sizes.returned * z.max_norm();
    if time == Time::Absent {
        let twice = [2.0 * system.kinetic_energy(t, q, z)];
        near("2T", &twice, &[dot(&p, z)], 4.0 * rounding * sizes.energy);
    }
    if time != Time::Explicit {
        near("power", &power, &[0.0], allowed);
    }
}

/// What holds of what acts, with constraints or without; with constraints the state must be on them.
///
/// - The power of each element is its generalised force by z, unless something is moved as a function of time.
/// - The energy T + U changes at the rate that is supplied: by the elements that are not in it, whatever moves what is
///   moved among them, by dampers of those that are, and by ∂U/∂t. What all elements deliver changes T, and the rest U.
///
/// # Panics
/// When one of them does not hold.
#[track_caller]
pub fn balance<S>(system: &S, t: f64, (q, z): (&S::Configuration, &S::Speeds), input: &S::Input)
where
    S: Driven + ForcedSystem,
{
    let sizes = Sizes::driven(system, t, (q, z), input);
    let rounding = sizes.rounding;
    let flow = Flow::driven(system, t, (q, z), input);
    assert_eq!(S::Powers::DIM, S::ELEMENTS.len());
    let own = columns(system, t, (q, z), input);
    let powered = acting(&own, &sizes) * list(z).iter().map(|z| z.abs()).sum::<f64>().max(1.0);

    let powers = list(&system.powers(t, q, z, input));
    let speeds = list(z);
    let moved = S::ELEMENTS.iter().any(|element| element.name == "guides");
    for ((element, power), column) in S::ELEMENTS.iter().zip(&powers).zip(&own) {
        let found: f64 = column.iter().zip(&speeds).map(|(a, b)| a * b).sum();
        // Matter that comes or goes has energy and exerts no force of its own.
        if !moved && element.name != "mass" {
            near(element.name, &[found], &[*power], rounding * powered);
        }
        assert_eq!(system.power(element.name, t, q, z, input), Some(*power));
    }

    let supplied = system.supplied_power(t, q, z, input);
    let energy = flow.rate(|t, q, z| vec![system.energy(t, q, z)]);
    let allowed = flow.slack(rounding) * sizes.energy + rounding * (sizes.returned * z.max_norm() + powered);
    near("dE/dt", &energy, &[supplied], allowed);
    let potential = flow.rate(|t, q, _| vec![system.potential_energy(t, q)]);
    near("dU/dt", &[supplied - powers.iter().sum::<f64>()], &potential, allowed);
    // The power of a spring with a damper is in part that of the damper.
    if S::ELEMENTS.iter().all(|element| !element.damped) {
        let outside = S::ELEMENTS.iter().zip(&powers).filter(|(element, _)| !element.conservative);
        let explicit = flow.differences(|s| vec![system.potential_energy(t + s, q)])[0];
        near("∂U/∂t", &[supplied - outside.map(|(_, power)| power).sum::<f64>()], &[explicit], allowed);
    }
}

/// The generalised force of each element.
fn columns<S>(system: &S, t: f64, (q, z): (&S::Configuration, &S::Speeds), input: &S::Input) -> Vec<Vec<f64>>
where
    S: Driven + ForcedSystem,
{
    let forces = system.element_forces(t, q, z, input);
    (0..S::ELEMENTS.len()).map(|n| list(&forces.nth(n).expect("a column for each element"))).collect()
}

/// How large generalised forces are: what cancels among the elements is not seen in accelerations.
fn acting(columns: &[Vec<f64>], sizes: &Sizes) -> f64 {
    columns.iter().map(|column| largest(column)).sum::<f64>() + sizes.force
}

/// [`balance`], and where there are no constraints and nothing is moved as a function of time: the generalised forces
/// of all elements are the right-hand side of (3.4). What is left of the residual is inertia, A ż and a quadratic form
/// of z.
///
/// # Panics
/// When one of them does not hold.
#[track_caller]
pub fn forced_laws<S>(system: &S, t: f64, (q, z): (&S::Configuration, &S::Speeds), input: &S::Input)
where
    S: Driven + ForcedSystem,
{
    balance(system, t, (q, z), input);
    let sizes = Sizes::driven(system, t, (q, z), input);
    let inertia = |z: &S::Speeds, acceleration: &S::Speeds| -> Vec<f64> {
        let residual = list(&system.gauss_residual(t, q, z, acceleration, input));
        let columns = columns(system, t, (q, z), input);
        (0..S::DOF).map(|i| columns.iter().fold(residual[i], |sum, column| sum + column[i])).collect()
    };
    let (none, d) = (S::Speeds::zero(), direction::<S>());
    let accelerated: Vec<f64> = inertia(z, &d).iter().zip(inertia(z, &none)).map(|(a, b)| a - b).collect();
    // What acts at twice the velocity is four times as large at most; accelerations d are below two.
    let acting = acting(&columns(system, t, (q, z), input), &sizes);
    let allowed = 16.0 * sizes.rounding * (acting + 4.0 * sizes.mass);
    near("A ż", &accelerated, &inertia(&none, &d), allowed);
    let quadratic = inertia(z, &none);
    near("inertia at −z", &inertia(&z.scale(-1.0), &none), &quadratic, allowed);
    let fourfold: Vec<f64> = quadratic.iter().map(|x| 4.0 * x).collect();
    near("inertia at 2z", &inertia(&z.scale(2.0), &none), &fourfold, allowed);
}

/// What holds without constraints only: C(ż + d) − C(ż) = ½ d·A d for every d.
///
/// # Panics
/// When it does not.
#[track_caller]
pub fn least<S: System>(system: &S, t: f64, q: &S::Configuration, z: &S::Speeds) {
    gain(system, t, q, z, |_| 0.0);
}

/// C(ż + d) − C(ż) = ½ d·A d + what the forces of constraints add.
#[track_caller]
fn gain<S: System>(system: &S, t: f64, q: &S::Configuration, z: &S::Speeds, constraints: impl Fn(&S::Speeds) -> f64) {
    let sizes = Sizes::of(system, t, q, z);
    let acceleration = system.acceleration(t, q, z, &());
    let c = |a: &S::Speeds| system.constraint_function(t, q, z, a, &());
    for k in 0..S::DOF {
        // Directions that span the space, as large as ż, so that nothing is lost in the difference.
        let mut d = direction::<S>();
        d.set_component(k, -2.0);
        let d = d.scale(acceleration.max_norm().max(1.0));
        let found = c(&acceleration.add_scaled(1.0, &d)) - c(&acceleration);
        let rest = system.momentum(t, q, &S::Speeds::zero());
        let square = dot(&d, &system.momentum(t, q, &d).add_scaled(-1.0, &rest));
        let size = (sizes.force + sizes.mass * d.max_norm()) * d.max_norm() * S::DOF as f64;
        let allowed = 4.0 * sizes.rounding * size;
        near("C(ż + d) − C(ż)", &[found], &[square / 2.0 + constraints(&d)], allowed);
    }
}

/// What holds at every state on the constraints of a system beside [`laws`].
///
/// - The state that is on the constraints stays where it is when projected, and moves along them.
/// - C(ż + d) − C(ż) = ½ d·A d + λ·J d for every d: ż makes C least among what the constraints admit, and λ belongs to
///   it.
///
/// # Panics
/// When one of them does not hold.
#[track_caller]
pub fn constrained_laws<S: System + ConstrainedSystem>(system: &S, t: f64, q: &S::Configuration, z: &S::Speeds) {
    let sizes = Sizes::of(system, t, q, z);
    let rounding = sizes.rounding;
    let flow = Flow::new(system, t, q, z);
    let count = S::Multipliers::DIM;
    let zero = vec![0.0; count];

    // Numbers of constraints are lengths and direction cosines, and what they are sums of is at most ten.
    near("φ", &list(&system.position_residual(t, q)), &zero, 10.0 * rounding);
    near("φ̇", &list(&system.velocity_residual(t, q, z)), &zero, 10.0 * rounding * sizes.velocity);
    let (projected, speeds) = project(system, t, q, z).expect("the state is on the constraints");
    assert!(q.difference(&projected).max_norm() <= 100.0 * rounding, "projecting moves the configuration");
    let change = speeds.add_scaled(-1.0, z).max_norm();
    assert!(change <= 100.0 * rounding * sizes.velocity * z.max_norm().max(1.0), "projecting moves the speeds");

    let rate = flow.rate(|t, q, z| list(&system.velocity_residual(t, q, z)));
    let allowed = 10.0 * flow.slack(rounding) * sizes.velocity + 10.0 * rounding * sizes.acceleration;
    near("φ̈", &rate, &zero, allowed);

    let multipliers = system.multipliers(t, q, z, &());
    gain(system, t, q, z, |d| {
        // φ̇ is affine in z here: its difference is J d, and rounding is that of numbers as large as d.
        let (after, before) =
            (system.velocity_residual(t, q, &z.add_scaled(1.0, d)), system.velocity_residual(t, q, z));
        dot(&multipliers, &after.add_scaled(-1.0, &before))
    });
}

/// Constraints of positions: φ̇ is the rate of φ, also off the constraints.
///
/// # Panics
/// When it is not.
#[track_caller]
pub fn position_rates<S: System + ConstrainedSystem>(system: &S, t: f64, q: &S::Configuration, z: &S::Speeds) {
    let sizes = Sizes::of(system, t, q, z);
    let flow = Flow::new(system, t, q, z);
    let rate = flow.rate(|t, q, _| list(&system.position_residual(t, q)));
    // Numbers up to ten and their rates, as in `constrained_laws`.
    let allowed = 10.0 * flow.slack(sizes.rounding) * sizes.velocity;
    near("φ̇", &list(&system.velocity_residual(t, q, z)), &rate, allowed);
}

/// One motion in two descriptions: states of `from` are taken to states of `to` by `map`, and then energies are the
/// same, and the flow of one is taken to the flow of the other.
///
/// # Panics
/// When it is not.
#[track_caller]
pub fn corresponds<A: System, B: System>(
    from: &A,
    to: &B,
    t: f64,
    (q, z): (&A::Configuration, &A::Speeds),
    map: impl Fn(f64, &A::Configuration, &A::Speeds) -> (B::Configuration, B::Speeds),
) {
    let flow = Flow::new(from, t, q, z);
    let (there, speeds) = map(t, q, z);
    let (a, b) = (Sizes::of(from, t, q, z), Sizes::of(to, t, &there, &speeds));
    let rounding = a.rounding + b.rounding;
    let kinetic = (from.kinetic_energy(t, q, z), to.kinetic_energy(t, &there, &speeds));
    near("kinetic energy", &[kinetic.1], &[kinetic.0], rounding * (a.energy + b.energy));
    let potential = (from.potential_energy(t, q), to.potential_energy(t, &there));
    near("potential energy", &[potential.1], &[potential.0], rounding * (a.energy + b.energy));

    let slack = flow.slack(rounding);
    let velocity = flow.rate(|t, q, z| list(&there.difference(&map(t, q, z).0)));
    near("velocity", &list(&to.kinematics(t, &there, &speeds)), &velocity, slack * b.velocity);
    let acceleration = flow.rate(|t, q, z| list(&map(t, q, z).1));
    let size = speeds.max_norm().max(1.0);
    let stretch = size / z.max_norm().max(1.0);
    let allowed = slack * size * b.velocity + rounding * (b.acceleration + a.acceleration * stretch.max(1.0));
    near("acceleration", &list(&to.acceleration(t, &there, &speeds, &())), &acceleration, allowed);
}
