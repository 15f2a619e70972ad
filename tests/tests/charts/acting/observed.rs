//! What acts, as a chart sees it, in terms that do not depend on the chart; and what must hold within one chart.

use gauss_runtime::forces::Element;
use gauss_runtime::prelude::*;
use proptest::test_runner::TestCaseError;

use super::scenes::{Body, Inputs};
use crate::common::Bounded;
use crate::common::agreement::{equal, largest, zero};
use crate::common::body::{Parts, duals, list, rates, speeds};
use crate::common::dual::Dual;
use crate::common::states::State;

/// The time of all checks: not zero, inside of the smooth steps in time.
pub const TIME: f64 = 0.75;

/// [`TIME`], exact.
pub fn time() -> Bounded {
    Bounded::from_f64(TIME)
}

/// Values of inputs: random numbers of the state, exact.
pub fn inputs<T: Real, I: Inputs<T>>(state: &State) -> I {
    let [a, b, c, d, e, f] = state.direction;
    I::read(&[a, b, c, d, e, f, a * b, c - d, e * f, b + f])
}

/// The state in the variables of a kernel; `None` at a singular point of its coordinates.
pub fn variables<K: Body<Bounded>>(kernel: &K, state: &State) -> Option<(K::Configuration, K::Speeds)> {
    let q = kernel.configuration(&state.pose()).ok()?;
    let z = kernel.speeds(time(), &q, &state.twist());
    Some((q, z))
}

/// One element of what acts.
pub struct Account {
    pub element: Element,
    pub power: Bounded,
    /// `∫ ∂v_P/∂z · dF`.
    pub force: Vec<Bounded>,
    /// (F, M_O) in body axes, as far as the motion feels it.
    pub wrench: Vec<Bounded>,
}

/// What does not depend on the chart.
pub struct Observed {
    /// d/dt (u, ω).
    pub acceleration: Vec<Bounded>,
    pub accounts: Vec<Account>,
    /// T, U and dE/dt by what acts.
    pub energies: [Bounded; 3],
    /// How large the terms are that enter the acceleration.
    pub scale: f64,
}

/// The accounts of a state.
pub fn accounts<K>(kernel: &K, (q, z): (&K::Configuration, &K::Speeds), input: &K::Input) -> Vec<Account>
where
    K: Body<Bounded> + ForcedSystem,
{
    let powers = kernel.powers(time(), q, z, input);
    let account = |(n, element): (usize, &Element)| {
        let force = kernel.generalised_force(element.name, time(), q, z, input).expect("a column for each element");
        // Generalised forces are paired with speeds: those of the six unit twists give the wrench.
        let wrench = (0..6).map(|i| {
            let twist = SVector::from(std::array::from_fn(|j| Bounded::from_f64(f64::from(i == j))));
            dot(&list(&force), &list(&kernel.speeds(time(), q, &twist)))
        });
        Account { element: *element, power: powers.component(n), force: list(&force), wrench: wrench.collect() }
    };
    K::ELEMENTS.iter().enumerate().map(account).collect()
}

/// Σ a_i b_i.
pub fn dot(a: &[Bounded], b: &[Bounded]) -> Bounded {
    a.iter().zip(b).fold(Bounded::zero(), |sum, (&a, &b)| sum + a * b)
}

/// The motion of a state as one chart sees it, after what must hold there by itself:
///
/// - ż makes the Gauss residual zero;
/// - the power of each element is its generalised force by z;
/// - ṗ is the rate of p along the motion, and what is supplied is the rate of T + U.
pub fn observe<K, D>(kernel: &K, dual: &D, state: &State) -> Result<Option<Observed>, TestCaseError>
where
    K: Body<Bounded> + ForcedSystem,
    D: Body<Dual<Bounded>>,
{
    let Some((q, z)) = variables(kernel, state) else { return Ok(None) };
    let (t, input) = (time(), inputs::<_, K::Input>(state));
    let z_rate = kernel.acceleration(t, &q, &z, &input);
    zero("residual", &list(&kernel.gauss_residual(t, &q, &z, &z_rate, &input)))?;

    let accounts = accounts(kernel, (&q, &z), &input);
    for account in &accounts {
        equal(account.element.name, &[account.power], &[dot(&account.force, &list(&z))])?;
    }

    let t_dual = Dual::new(t, Bounded::one());
    let q_dual = D::Configuration::assemble(&duals(&q.parts(), &q.rates(&kernel.kinematics(t, &q, &z))));
    let z_dual: D::Speeds = speeds(&duals(&list(&z), &list(&z_rate)));
    let p = kernel.momentum(t, &q, &z);
    let p_rate = rates(&list(&dual.momentum(t_dual, &q_dual, &z_dual)));
    equal("ṗ", &list(&kernel.momentum_rate(t, &q, &p, &input)), &p_rate)?;
    let supplied = kernel.supplied_power(t, &q, &z, &input);
    equal("dE/dt", &[supplied], &[dual.energy(t_dual, &q_dual, &z_dual).rate])?;

    let acceleration = rates(&list(&dual.body_twist(t_dual, &q_dual, &z_dual)));
    let scale = largest(&list(&z_rate)).max(largest(&list(&z)).powi(2)).max(largest(&acceleration));
    let energies = [kernel.kinetic_energy(t, &q, &z), kernel.potential_energy(t, &q), supplied];
    Ok(Some(Observed { acceleration, accounts, energies, scale }))
}

/// Two descriptions of one motion agree.
pub fn agree(what: &str, one: &Observed, other: &Observed) -> Result<(), TestCaseError> {
    equal(&format!("{what}: acceleration"), &one.acceleration, &other.acceleration)?;
    equal(&format!("{what}: energies"), &one.energies, &other.energies)?;
    assert_eq!(one.accounts.len(), other.accounts.len(), "{what}");
    for (a, b) in one.accounts.iter().zip(&other.accounts) {
        assert_eq!(a.element, b.element, "{what}");
        equal(&format!("{what}: power of {}", a.element), &[a.power], &[b.power])?;
        equal(&format!("{what}: wrench of {}", a.element), &a.wrench, &b.wrench)?;
    }
    Ok(())
}

/// The right-hand side is the sum of the columns: what the elements change in the residual, at any ż. `bare` is the
/// same body without them, with the inputs that it has, and weight and buoyancy on it as well.
pub fn columns_add_up<K, B>(kernel: &K, (bare, none): (&B, &B::Input), state: &State) -> Result<(), TestCaseError>
where
    K: Body<Bounded> + ForcedSystem,
    B: Body<Bounded, Configuration = K::Configuration, Speeds = K::Speeds>,
{
    let Some((q, z)) = variables(kernel, state) else { return Ok(()) };
    let (t, input) = (time(), inputs::<_, K::Input>(state));
    let other: K::Speeds = speeds(&state.direction.map(Bounded::from_f64)[..K::DOF]);
    let with = kernel.gauss_residual(t, &q, &z, &other, &input);
    let without = bare.gauss_residual(t, &q, &z, &other, none);
    let elements = accounts(kernel, (&q, &z), &input).into_iter().filter(|account| account.element.name != "gravity");
    let mut sum = list(&with.add_scaled(-Bounded::one(), &without));
    for account in elements {
        sum.iter_mut().zip(account.force).for_each(|(sum, force)| *sum += force);
    }
    zero("residual of the elements, and the elements", &sum)
}
