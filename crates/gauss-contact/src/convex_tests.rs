//! Laws that are a minimum, against a convex solver that does not know D, in many digits.
//!
//! Entries of W have four bits, units of rows and roots of masses are powers of two, so that D and b are exact as
//! `f64`: the solver and the witness have the same problem.

use gauss_runtime::contact::Contact;

use super::*;
use crate::dense::{dot, size};
use crate::friction::Bounds;
use crate::solver::tests::Numbers;

#[path = "convex_witness_tests.rs"]
pub(super) mod witness;

use witness::{Convex, Long, Minimum, eliminated, independent};

impl Numbers {
    fn below(&mut self, n: usize) -> usize {
        (self.next() * n as f64) as usize
    }

    /// Sixteenths.
    fn short(&mut self) -> f64 {
        (15.0 * self.signed()).round() / 16.0
    }

    /// A power of two, up to this one either way.
    fn power(&mut self, most: f64) -> f64 {
        2.0_f64.powi((most * self.signed()).round() as i32)
    }
}

/// Contacts in a space of some dimensions: units from 2⁻²⁰ to 2²⁰, masses as well where they are spread. Half of the
/// entries are zero, as those of contacts between a few of many bodies. b is in the range of W, as of any mechanism.
fn drawn(numbers: &mut Numbers, contacts: Vec<Contact>, dimensions: usize, spread: bool) -> Convex {
    let roots: Vec<f64> = (0..dimensions).map(|_| if spread { numbers.power(10.0) } else { 1.0 }).collect();
    let mut w: Vec<Vec<f64>> = Vec::new();
    for contact in &contacts {
        let unit = numbers.power(20.0);
        for _ in contact.rows() {
            let mut row = vec![0.0; dimensions];
            while row.iter().all(|w| *w == 0.0) {
                let entry = |root: &f64| if numbers.next() < 0.5 { 0.0 } else { unit * root * numbers.short() };
                row = roots.iter().map(entry).collect();
            }
            w.push(row);
        }
    }
    let start: Vec<f64> = (0..dimensions).map(|_| numbers.short()).collect();
    // Bounds are some part of what would stop a slip, from 2⁻²⁰ to 2²⁰ of it, half of them of its order.
    let bound = |contact: &Contact| {
        let row = contact.tangent_rows().next()?;
        let most = if numbers.next() < 0.5 { 3.0 } else { 20.0 };
        Some(numbers.power(most) * (0.5 + dot(&w[row], &start).abs() / size(&w[row])) / size(&w[row]))
    };
    let bounds = contacts.iter().map(bound).map(Option::unwrap_or_default).collect();
    let c = vec![0.0; w.len()];
    Convex { contacts, bounds, w, start, c }
}

fn numbered(kinds: impl Iterator<Item = (bool, usize)>) -> Vec<Contact> {
    let mut first = 0;
    let contact = |(gap, tangents): (bool, usize)| {
        let contact = if gap { Contact::new("", first, tangents) } else { Contact::dry_friction("", first, tangents) };
        first += contact.rows().len();
        contact
    };
    kinds.map(contact).collect()
}

/// The same problem for the solver. `frictions`: μ of contacts, f of dry friction.
fn posed(convex: &Convex, frictions: &[f64]) -> Contacts {
    let law = |(contact, friction): (&Contact, &f64)| {
        Law::new(contact, Bounds { largest: *friction, weights: [1.0; 3] }, None)
    };
    let w = &convex.w;
    let matrix = Matrix::from_fn(w.len(), |i, j| dot(&w[i], &w[j]));
    let b = w.iter().zip(&convex.c).map(|(w, c)| dot(w, &convex.start) + c).collect();
    Contacts::new(convex.contacts.iter().zip(frictions).map(law).collect(), matrix, b)
}

/// Bound on the distance of the solver's x from the minimum, in the norm of energy.
///
/// The solver promises rates to `256 (1 + R) ε` of their terms; ρ is the norm of these over the sizes of the rows. The
/// minimum is strongly convex: what is wrong with forces by ρ moves x by no more than that. What is wrong with rates of
/// rows that are zero moves x by `|D̂⁻¹|^½` times it, D̂ of these rows at length 1; its trace is no less. They are
/// those of the solver and those of the minimum.
fn bound(convex: &Convex, contacts: &Contacts, found: &Solution, minimum: &Minimum) -> f64 {
    let rounding = |row: usize| contacts.rounding(row, &found.forces) / size(&convex.w[row]);
    let rho = (0..contacts.b.len()).map(|row| rounding(row).powi(2)).sum::<f64>().sqrt();
    let closed = |row: &usize| found.rates[*row].abs() <= contacts.rounding(*row, &found.forces);
    let zero = minimum.forces.iter().map(|(row, _)| *row).chain((0..contacts.b.len()).filter(closed));
    let zero = independent(&convex.w, &zero.collect::<Vec<_>>());
    let unit: Vec<Vec<f64>> =
        zero.iter().map(|&row| convex.w[row].iter().map(|w| w / size(&convex.w[row])).collect()).collect();
    let matrix: Vec<Vec<f64>> = unit.iter().map(|a| unit.iter().map(|b| dot(a, b)).collect()).collect();
    let diagonal = |k: usize| {
        let axis = (0..zero.len()).map(|i| if i == k { 1.0 } else { 0.0 }).collect();
        eliminated(matrix.clone(), axis).map_or(f64::INFINITY, |(column, _)| column[k])
    };
    rho * (1.0 + (0..zero.len()).map(diagonal).sum::<f64>()).sqrt()
}

/// Tally of the draws.
#[derive(Debug, Default)]
struct Seen {
    /// Distances of x from the minimum, over the largest x.
    off: Vec<f64>,
    /// Number of draws in which the witness has no more than the answer of the convex solver.
    rough: usize,
    /// Numbers of draws in which the solver found nothing, which is an error with a type: of bodies of one mass, and of
    /// masses that differ.
    refused: [usize; 2],
}

impl Seen {
    /// Holds rates of the solver to those of the witness. Where forces are the only ones, rates determine them.
    fn hold(&mut self, n: usize, convex: &Convex, contacts: &Contacts, found: &Solution) {
        let largest = size(&convex.start);
        let rough = convex.solve();
        let Some(minimum) = convex.refined(&rough) else {
            // Its gap is below 10⁻¹³ of the energies, or nearly: half of the digits of x.
            for row in 0..contacts.b.len() {
                let off = (found.rates[row] - dot(&convex.w[row], &rough.x) - convex.c[row]).abs();
                assert!(off <= 1e-6 * largest * size(&convex.w[row]), "{n} {row} {off:e} {found:?}");
            }
            self.rough += 1;
            return;
        };
        let bound = bound(convex, contacts, found, &minimum);
        let mut worst = 0.0_f64;
        for row in 0..contacts.b.len() {
            let wanted = Long::row(&convex.w[row], &minimum.x, convex.c[row]);
            let off = Long::new(found.rates[row]).minus(&wanted).value().abs() / size(&convex.w[row]);
            assert!(off <= bound, "{n} {row} {off:e} {bound:e} {found:?}");
            worst = worst.max(off / largest);
        }
        self.off.push(worst);
    }

    /// The median of the distances: half of the draws are off by no more.
    fn half(&mut self) -> f64 {
        self.off.sort_by(f64::total_cmp);
        self.off[self.off.len() / 2]
    }
}

/// Draws by the hundred, every other one with masses from 2⁻²⁰ to 2²⁰. With these friction along two tangents may
/// be refused: where slips in one direction are a million times easier than across, directions are not found.
fn run(
    seed: u64,
    kinds: impl Fn(&mut Numbers, usize) -> Vec<Contact>,
    change: impl Fn(&mut Numbers, &mut Convex),
) -> Seen {
    let (mut numbers, mut seen) = (Numbers(seed), Seen::default());
    for n in 0..120 {
        let dimensions = 2 + numbers.below(9);
        let contacts = kinds(&mut numbers, n);
        let mut convex = drawn(&mut numbers, contacts, dimensions, n % 2 == 1);
        change(&mut numbers, &mut convex);
        let contacts = posed(&convex, &convex.bounds);
        match contacts.solve() {
            Ok(found) => seen.hold(n, &convex, &contacts, &found),
            Err(Failure::NotFound(_)) => seen.refused[n % 2] += 1,
            Err(other) => panic!("{n} {other:?}"),
        }
    }
    seen
}

fn gaps(_: &mut Numbers, n: usize) -> Vec<Contact> {
    numbered((0..1 + n % 12).map(|_| (true, 0)))
}

#[test]
fn gaps_without_friction_have_the_motion_of_a_convex_solver() {
    // Up to twelve, so that more of them than dimensions are zero; then forces are not unique.
    let mut seen = run(31, gaps, |_, _| ());
    assert!(seen.half() < 1e-15 && seen.rough == 0 && seen.refused == [0, 0], "{seen:?}");
}

#[test]
fn impacts_have_the_velocities_of_a_convex_solver() {
    // Moreau: ½|z⁺ − z⁻|² is least where ġ⁺ ≥ −e ġ⁻, each gap with an e of its own. All of them close.
    let mut seen = run(41, gaps, |numbers, convex| {
        for (row, c) in convex.w.iter_mut().zip(&mut convex.c) {
            if dot(row, &convex.start) > 0.0 {
                row.iter_mut().for_each(|w| *w = -*w);
            }
            *c = numbers.short().abs() * dot(row, &convex.start);
        }
    });
    assert!(seen.half() < 1e-15 && seen.rough < 6 && seen.refused == [0, 0], "{seen:?}");
}

#[test]
fn dry_friction_has_the_motion_of_a_convex_solver() {
    // Along one slip and two, and gaps among them.
    let kinds = |numbers: &mut Numbers, n: usize| {
        numbered((0..1 + n % 6).map(|_| numbers.below(3)).map(|kind| (kind == 0, kind)))
    };
    let mut seen = run(37, kinds, |_, _| ());
    assert!(seen.half() < 1e-15 && seen.rough < 6 && seen.refused[0] == 0 && seen.refused[1] < 4, "{seen:?}");
}

/// Coulomb's law is no minimum, but with the normal forces that it has it is one: dry friction of bounds μ λ_N.
#[test]
fn coulombs_law_has_the_motion_of_a_convex_solver_with_its_normal_forces() {
    let (mut numbers, mut seen) = (Numbers(43), Seen::default());
    for n in 0..120 {
        let contacts = numbered((0..1 + n % 6).map(|_| (true, 1 + numbers.below(2))));
        let dimensions = 3 + numbers.below(13);
        let mut convex = drawn(&mut numbers, contacts, dimensions, n % 2 == 1);
        let frictions: Vec<f64> = convex.contacts.iter().map(|_| numbers.short().abs()).collect();
        let contacts = posed(&convex, &frictions);
        match contacts.solve() {
            Ok(found) => {
                let forces = convex.contacts.iter().map(|contact| found.forces[contact.normal]);
                convex.bounds = frictions.iter().zip(forces).map(|(friction, force)| friction * force).collect();
                seen.hold(n, &convex, &contacts, &found);
            }
            Err(Failure::NonFinite) => panic!("{n}"),
            Err(_) => seen.refused[n % 2] += 1,
        }
    }
    assert!(seen.half() < 1e-15 && seen.rough < 6 && seen.refused[0] == 0 && seen.refused[1] < 15, "{seen:?}");
}
