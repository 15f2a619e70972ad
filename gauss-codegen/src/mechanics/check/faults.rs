//! Every system against the definition, before code is written: C of (3.1) must be stationary at a pseudo-random state;
//! no speed and no constraint may depend on others.

use crate::algebra::{Evaluation, Expr, Map, Number, Precise};

use crate::mechanics::formula::{Formulas, Method};
use crate::mechanics::system::System;

use super::agreement::{Comparison, Disagreement, SizedSum, agree, is_in_range};
use super::contact_forces::ContactDefinition;
use super::dependent::{Dependency, dependencies};
use super::witness::{Witness, largest, sample_state};

/// A fault that is found in a system at a pseudo-random state.
#[derive(Debug)]
pub enum SystemFault {
    /// An error of this crate.
    Disagreement(Disagreement),
    /// A is singular: this speed moves nothing that the earlier ones do not move.
    DependentSpeed(usize),
    /// The constraint, by its index, follows from the earlier ones.
    DependentConstraint(usize),
    /// No velocity satisfies the constraint together with the earlier ones.
    InconsistentConstraint(usize),
}

impl SystemFault {
    fn of(found: Dependency) -> Self {
        match found.contradicts {
            true => Self::InconsistentConstraint(found.number),
            false => Self::DependentConstraint(found.number),
        }
    }
}

/// Formulas that are compared with the definition, in all their arrangements.
#[derive(Default)]
pub struct Claims<'a, 'g> {
    /// ∂C/∂ż − Jᵀλ at any ż, with the multipliers of the motion.
    pub residuals: &'a [Vec<Expr<'g>>],
    pub accelerations: &'a [Vec<Expr<'g>>],
    /// λ, where there are constraints.
    pub multipliers: Option<&'a [Expr<'g>]>,
    /// The motion without contact forces and what they do, where there are contacts.
    pub contacts: &'a [Vec<Expr<'g>>],
}

impl<'a, 'g> Claims<'a, 'g> {
    pub fn of(formulas: &'a Formulas<'g>) -> Self {
        Self {
            residuals: &formulas.gauss_residual,
            accelerations: &formulas.acceleration,
            multipliers: formulas.get(Method::Multipliers).and_then(|all| all.first()).map(Vec::as_slice),
            contacts: formulas.get(Method::ImpulseDynamics).map_or(&[], Vec::as_slice),
        }
    }
}

/// Evaluates the condition at one state, with the residual at any ż and with every arrangement's acceleration.
///
/// Where large terms cancel, right formulas disagree by the roundings of these, and a pivot that is small beside what
/// it was formed of looks like zero. Such a finding of double precision counts only if numbers of many digits confirm
/// it: roundings are smaller there by sixty decimal places, a wrong term and a dependent row are what they were.
pub fn check_system_against_definition<'g>(
    system: &System<'g>,
    claims: &Claims<'_, 'g>,
) -> Result<(), Vec<SystemFault>> {
    // What is made once there is too much of everything means nothing.
    let exhausted = || system.scene.graph.is_exhausted();
    match check_in::<f64>(system, claims, |_| true) {
        Err(_) if !exhausted() => check_in::<Precise>(system, claims, |state| is_stable(system, state, claims)),
        result => result,
    }
}

/// Whether the mass matrix has a value at any of the states that are tried. Where it has none, as beyond the domains of
/// roots and arcs, nothing is known of its pivots: one may be zero.
pub fn has_values(system: &System<'_>) -> bool {
    states::<Precise>(system).any(|witness| is_regular(&witness))
}

fn states<'a, 'g, N: Number>(system: &'a System<'g>) -> impl Iterator<Item = Witness<'a, 'g, N>> + use<'a, 'g, N> {
    (0..16).map(move |shift| Witness::new(system, sample_state(system, shift)))
}

fn is_regular<N: Number>(witness: &Witness<'_, '_, N>) -> bool {
    witness.values(witness.system.matrix.iter().flatten()).iter().all(is_in_range)
}

fn check_in<'g, N: Number>(
    system: &System<'g>,
    claims: &Claims<'_, 'g>,
    is_decided: impl Fn(&Map<u32, N>) -> bool,
) -> Result<(), Vec<SystemFault>> {
    let n = system.scene.speeds.len();
    let matrix: Vec<Expr<'g>> = system.matrix.iter().flatten().copied().collect();
    let arbitrary = arbitrary(n);
    // Roots and logarithms have domains: the first of a few states where everything has a value. Where there is none,
    // the programs are still checked against their expressions.
    let inside = |witness: &Witness<'_, 'g, N>| {
        let values = witness.values(matrix.iter().chain(claims.accelerations.iter().flatten()));
        values.iter().chain(&witness.stationarity(&arbitrary)).all(is_in_range)
    };
    let states = || states::<N>(system);
    // A singular A, or dependent constraints, have no finite accelerations, so they are looked for first.
    let singular = states().find(is_regular).map(|witness| vanishing_pivots(witness.values(&matrix), n));
    let mut faults: Vec<SystemFault> =
        singular.unwrap_or_default().into_iter().map(SystemFault::DependentSpeed).collect();
    let mut dependent = dependencies(system, states(), 100.0 * N::NEGLIGIBLE);
    dependent.retain(|found| found.contradicts || !system.scene.redundant);
    faults.extend(dependent.into_iter().map(SystemFault::of));
    if !faults.is_empty() {
        return Err(faults);
    }
    // A wrong term is wrong nearly everywhere, roundings grow large near singular states alone: only what disagrees at
    // three states is refused.
    let mut found = Vec::new();
    for witness in states().filter(inside) {
        let state = witness.state.clone();
        match compare(witness, claims, &arbitrary) {
            Ok(Comparison::Agrees) => return Ok(()),
            Ok(Comparison::WithoutValue) => {}
            Err(_) if !is_decided(&state) => {}
            Err(error) => found.push(error),
        }
        if found.len() == 3 {
            break;
        }
    }
    found.pop().map_or(Ok(()), |error| Err(vec![SystemFault::Disagreement(error)]))
}

/// The ż at which formulas are compared.
fn arbitrary<N: Number>(n: usize) -> Vec<N> {
    (0..n).map(|k| N::number(0.7 - 0.3 * (k % 4) as f64)).collect()
}

/// Whether formulas and definition hardly change where every symbol does in its last digits but some. Where as many
/// digits cancel as there are, as with levers of 1e43 about which nothing turns, what is left of them tells nothing.
fn is_stable<'g, N: Number>(system: &System<'g>, state: &Map<u32, N>, claims: &Claims<'_, 'g>) -> bool {
    let arbitrary = arbitrary(system.scene.speeds.len());
    let values = |state: Map<u32, N>| {
        let mut witness = Witness::new(system, state);
        let definition = witness.stationarity(&arbitrary);
        witness.state.extend(system.scene.speed_rates.iter().zip(&arbitrary).map(|(s, x)| (s.key(), *x)));
        let formulas = claims.residuals.iter().chain(claims.accelerations);
        let formulas: Vec<Vec<N>> = formulas.map(|formula| witness.values(formula)).collect();
        [vec![definition], formulas].concat()
    };
    let changed = state.iter().map(|(&key, &x)| (key, x + x * N::number(N::NEGLIGIBLE * f64::from(1 + key % 3))));
    let same = |(a, b): (&Vec<N>, &Vec<N>)| {
        let scale = largest(a.iter().copied()).max(1.0);
        a.iter().zip(b).all(|(a, b)| (*a - *b).to_f64().abs() <= 1e-9 * scale)
    };
    values(state.clone()).iter().zip(&values(changed.collect())).all(same)
}

/// Residuals at the given ż and accelerations, against the definition.
fn compare<'g, N: Number>(
    mut witness: Witness<'_, 'g, N>,
    claims: &Claims<'_, 'g>,
    arbitrary: &[N],
) -> Result<Comparison, Disagreement> {
    let system = witness.system;
    let unconstrained = witness.stationarity(arbitrary);
    let jacobian = witness.partials(&system.constraints.on_velocities);
    // λ of the motion.
    let multipliers = claims.multipliers.map_or_else(Vec::new, |all| witness.values(all));
    // Jᵀλ is taken from rows.
    let with_forces = |rows: Vec<N>| -> Vec<SizedSum<N>> {
        let force = |row: &[N]| row.iter().zip(&multipliers).map(|(j, l)| -(*j * *l)).collect::<Vec<N>>();
        rows.into_iter().zip(&jacobian).map(|(r, j)| SizedSum::of(r, force(j))).collect()
    };
    witness.state.extend(system.scene.speed_rates.iter().zip(arbitrary).map(|(s, x)| (s.key(), *x)));
    let expected = with_forces(unconstrained);
    if !expected.iter().all(SizedSum::is_in_range) {
        return Ok(Comparison::WithoutValue);
    }
    let mut evaluation = Evaluation::new(&witness.state);
    let mut values = |outputs: &[Expr<'g>]| -> Vec<N> { outputs.iter().map(|e| evaluation.value(*e)).collect() };
    for arrangement in claims.residuals {
        agree(Method::GaussResidual, &values(arrangement), &expected)?;
    }
    let scale = largest(expected.iter().map(|row| row.value)).max(1.0);
    let still = witness.flow(&vec![N::number(0.0); arbitrary.len()]);
    let bias = witness.along(&still, &system.constraints.on_velocities);
    // Of what depends on others, and holds with them alone, nothing is known at states that violate constraints.
    let kept = system.constraints.kept(&system.matrix).map(|kept| witness.values(&kept));
    let is_kept = |k: &usize| kept.as_ref().is_none_or(|kept| kept[*k].to_f64() != 0.0);
    for arrangement in claims.accelerations {
        let rates = values(arrangement);
        let found =
            with_forces(witness.stationarity(&rates)).into_iter().map(|row| row.over(scale)).collect::<Vec<_>>();
        // J ż = γ: what the constraints say of velocities goes on to hold. A small ż is what is left of large ones.
        let most = largest(rates.iter().copied());
        let drift: Vec<_> = (0..bias.len())
            .filter(is_kept)
            .map(|k| {
                let sum =
                    SizedSum::of(bias[k], rates.iter().zip(&jacobian).map(|(rate, row)| *rate * row[k]).collect());
                let sizes: f64 = jacobian.iter().map(|row| row[k].to_f64().abs()).sum();
                SizedSum { terms: sum.terms + most * sizes, ..sum }
            })
            .collect();
        if !found.iter().chain(&drift).all(SizedSum::is_in_range) {
            return Ok(Comparison::WithoutValue);
        }
        for sums in [found, drift] {
            agree(Method::Acceleration, &vec![N::number(0.0); sums.len()], &sums)?;
        }
    }
    let pushed = ContactDefinition { witness: &witness, jacobian: &jacobian, multipliers: &multipliers };
    pushed.compare(claims.contacts)
}

/// The unknowns whose pivots vanish while A is eliminated, beside what they were.
fn vanishing_pivots<N: Number>(mut a: Vec<N>, n: usize) -> Vec<usize> {
    let diagonal: Vec<f64> = (0..n).map(|k| a[k * n + k].to_f64().abs()).collect();
    let mut vanishing = Vec::new();
    for k in 0..n {
        let pivot = a[k * n + k];
        // Cancellation leaves roundings of the diagonal; a regular A of numbers of order one stays far above.
        if pivot.to_f64().abs() <= N::NEGLIGIBLE * diagonal[k] {
            vanishing.push(k);
            continue;
        }
        for i in k + 1..n {
            let factor = a[i * n + k] / pivot;
            for j in k..n {
                a[i * n + j] = a[i * n + j] - factor * a[k * n + j];
            }
        }
    }
    vanishing
}
