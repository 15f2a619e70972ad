//! Random problems against enumeration and against the laws themselves, checked anew.

use gauss_runtime::contact::Contact;

use super::*;
use crate::friction::Bounds;

/// Numbers in (0, 1): a linear congruence with the constants of Knuth's MMIX.
pub(super) struct Numbers(pub(super) u64);

impl Numbers {
    pub(super) fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((self.0 >> 11) as f64 + 0.5) / 9_007_199_254_740_992.0
    }

    pub(super) fn signed(&mut self) -> f64 {
        2.0 * self.next() - 1.0
    }
}

/// Law of a contact with isotropic friction.
fn law(tangents: usize, friction: f64, slip: Option<[f64; 3]>) -> Law {
    Law::new(&Contact::new("", 0, tangents), Bounds { largest: friction, weights: [1.0; 3] }, slip)
}

/// Rows of contacts in a space of some dimensions, and Delassus' matrix of them with unit masses.
fn random(numbers: &mut Numbers, tangents: usize, count: usize, dimensions: usize) -> (Matrix, Vec<f64>) {
    let rows = count * (1 + tangents);
    // Units of contacts differ by up to 10³ either way.
    let units: Vec<f64> = (0..count).map(|_| 10.0_f64.powf(3.0 * numbers.signed())).collect();
    let unit = |row: usize| units[row / (1 + tangents)];
    let w: Vec<Vec<f64>> =
        (0..rows).map(|row| (0..dimensions).map(|_| unit(row) * numbers.signed()).collect()).collect();
    // b in the range of W, as those of mechanisms.
    let free: Vec<f64> = (0..dimensions).map(|_| numbers.signed()).collect();
    let b = w.iter().map(|row| crate::dense::dot(row, &free)).collect();
    (Matrix::from_fn(rows, |i, j| crate::dense::dot(&w[i], &w[j])), b)
}

/// The laws of one contact, as they are written: by how much they fail, over the size of their terms.
fn violation(contacts: &Contacts, found: &Solution, i: usize) -> f64 {
    let normal = contacts.first[i];
    let size = |row: usize| {
        let terms = contacts.matrix.row(row).iter().zip(&found.forces).map(|(d, f)| (d * f).abs());
        terms.fold(contacts.b[row].abs(), |sum, term| sum + term)
    };
    let (force, rate) = (found.forces[normal], found.rates[normal]);
    let (of_rate, of_force) = (size(normal), size(normal) / contacts.matrix.at(normal, normal));
    let pulls = (-force / of_force).max(0.0);
    let closes = (-rate / of_rate).max(0.0);
    let both = (force / of_force).min(rate / of_rate).max(0.0);
    let mut worst = pulls.max(closes).max(both);
    let tangents = contacts.tangents(i);
    if !tangents.is_empty() {
        let friction: Vec<f64> = tangents.clone().map(|row| found.forces[row]).collect();
        let slip: Vec<f64> = tangents.clone().map(|row| found.rates[row]).collect();
        let scale = contacts.tangent_scale(i);
        let of_slip = tangents.map(size).fold(0.0, f64::max).max(of_rate);
        let largest = contacts.laws[i].friction * force;
        worst = worst.max(scale * (norm(&friction) - largest) / of_slip);
        // Friction does as much negative work as it may.
        if norm(&slip) > 1e-9 * of_slip {
            for (f, s) in friction.iter().zip(&slip) {
                worst = worst.max(scale * (f + largest * s / norm(&slip)).abs() / of_slip * norm(&slip) / of_slip);
            }
        }
    }
    worst
}

#[test]
fn gaps_without_friction_agree_with_enumeration() {
    let mut numbers = Numbers(1);
    for n in 0..400 {
        let count = 1 + n % 6;
        // More contacts than dimensions as well: then forces are not unique, rates are.
        let (matrix, b) = random(&mut numbers, 0, count, 1 + n % 4);
        let laws = vec![law(0, 0.0, None); count];
        let contacts = Contacts::new(laws, matrix, b);
        let found = contacts.solve().expect("is convex");
        for i in 0..count {
            assert!(violation(&contacts, &found, i) < 1e-11, "{n} {i} {found:?}");
        }
        // C = ½ λᵀDλ + bᵀλ is least: no other choice of closed contacts that admits non-negative forces is lower.
        let cost = |forces: &[f64]| -> f64 {
            (0..count).map(|i| forces[i] * 0.5 * (contacts.rate(i, forces) + contacts.b[i])).sum()
        };
        for subset in 0..1_usize << count {
            let of = |i| if subset >> i & 1 == 1 { State::Closed } else { State::Leaves };
            let forces = contacts.forces_in(&(0..count).map(of).collect::<Vec<_>>());
            if forces.iter().all(|force| *force >= 0.0) {
                let least = cost(&found.forces);
                assert!(cost(&forces) >= least - 1e-11 * least.abs(), "{n} {subset}");
            }
        }
    }
}

#[test]
fn coulombs_law_holds_along_one_tangent_and_two() {
    let mut numbers = Numbers(7);
    let (mut sticks, mut slides) = (0, 0);
    for n in 0..400 {
        let (tangents, count) = (1 + n % 2, 1 + n % 5);
        let (matrix, b) = random(&mut numbers, tangents, count, 3 * count + 1);
        let laws = (0..count).map(|_| law(tangents, 0.3 * numbers.next(), None)).collect();
        let contacts = Contacts::new(laws, matrix, b);
        let found = contacts.solve().unwrap_or_else(|failure| panic!("{n} {failure:?}"));
        for i in 0..count {
            assert!(violation(&contacts, &found, i) < 1e-11, "{n} {i} {found:?}");
        }
        sticks += found.states.iter().filter(|state| **state == State::Sticks).count();
        slides += found.states.iter().filter(|state| matches!(state, State::Slides(_))).count();
    }
    assert!(sticks > 20 && slides > 100, "{sticks} {slides}");
}

#[test]
fn one_contact_has_the_forces_of_its_closed_form() {
    let solve = |b: [f64; 2], friction: f64| {
        let matrix = Matrix::from_fn(2, |i, j| if i == j { 2.0 } else { 0.0 });
        let found = Contacts::new(vec![law(1, friction, None)], matrix, b.to_vec()).solve().expect("is regular");
        (found.forces, found.states[0])
    };
    assert_eq!(solve([-4.0, 1.0], 0.5), (vec![2.0, -0.5], State::Sticks));
    assert_eq!(solve([-4.0, 3.0], 0.5), (vec![2.0, -1.0], State::Slides([1.0, 0.0, 0.0])));
    assert_eq!(solve([-4.0, -3.0], 0.5), (vec![2.0, 1.0], State::Slides([-1.0, 0.0, 0.0])));
    assert_eq!(solve([4.0, 1.0], 0.5), (vec![0.0, 0.0], State::Leaves));
}

#[test]
fn painleves_states_are_told_apart() {
    // p = 1 − 2 · 0.8 < 0.
    let solve = |b: f64| {
        let matrix = Matrix::from_fn(2, |i, j| if i == j { 1.0 } else { 0.8 });
        Contacts::new(vec![law(1, 2.0, Some([1.0, 0.0, 0.0]))], matrix, vec![b, 0.0]).solve()
    };
    assert!(matches!(solve(-1.0), Err(Failure::Inconsistent(0))));
    assert!(matches!(solve(1.0), Err(Failure::Indeterminate(0))));
    assert!(matches!(solve(f64::NAN), Err(Failure::NonFinite)));
}

/// Holds the laws of a contact, of resistance to rolling on one, or of dry friction with friction of several axes, as
/// they are written; whether it slides.
#[track_caller]
fn hold(
    contact: &Contact,
    bounds: Bounds,
    (first, on): (usize, usize),
    (matrix, b): (&Matrix, &[f64]),
    forces: &[f64],
) -> bool {
    let tangents = first + usize::from(contact.has_gap())..first + contact.rows().len();
    let size = |row: usize| {
        let terms = matrix.row(row).iter().zip(forces).map(|(d, f)| (d * f).abs());
        terms.fold(b[row].abs(), |sum, term| sum + term)
    };
    let rate = |row: usize| matrix.row(row).iter().zip(forces).fold(b[row], |sum, (d, f)| sum + d * f);
    let mut largest = bounds.largest;
    if contact.has_gap() {
        let (force, rate) = (forces[first], rate(first));
        let of_force = size(first) / matrix.at(first, first);
        assert!(force >= -1e-11 * of_force && rate >= -1e-11 * size(first));
        assert!((force / of_force).min(rate / size(first)) <= 1e-11);
        largest *= force.max(0.0);
    } else if contact.rolls_on().is_some() {
        largest *= forces[on].max(0.0);
    }
    // Σ (λ_k/κ_k)² ≤ bound², and where it slides λ is −bound (κ₁² s₁, κ₂² s₂, …)/|(κ₁ s₁, κ₂ s₂, …)|.
    let weights = bounds.weights;
    let on: Vec<f64> = tangents.clone().zip(weights).map(|(row, w)| forces[row] / w).collect();
    let off: Vec<f64> = tangents.clone().zip(weights).map(|(row, w)| rate(row) * w).collect();
    let sizes: Vec<f64> = tangents.clone().zip(weights).map(|(row, w)| size(row) * w).collect();
    let push = tangents.zip(weights).map(|(row, w)| size(row) / (matrix.at(row, row) * w)).fold(0.0, f64::max);
    assert!(norm(&on) - largest <= 1e-10 * push, "{on:?} {largest}");
    let slides = norm(&off) > 1e-8 * norm(&sizes);
    for (f, s) in on.iter().zip(&off).filter(|_| slides) {
        assert!((f + largest * s / norm(&off)).abs() <= 1e-8 * push, "{on:?} {off:?} {largest}");
    }
    slides
}

/// Some contacts with up to three rows of friction, some with resistance to rolling, and dry friction.
fn several(numbers: &mut Numbers, count: usize) -> Vec<Contact> {
    let mut contacts = Vec::new();
    for _ in 0..count {
        let tangents = 1 + usize::from(numbers.next() > 0.5);
        if numbers.next() > 0.6 {
            contacts.push(Contact::dry_friction("", 0, tangents));
            continue;
        }
        let on = contacts.len();
        let contact = Contact::new("", 0, tangents);
        contacts.push(if numbers.next() > 0.5 { contact.with_drilling() } else { contact });
        if numbers.next() > 0.5 {
            contacts.push(Contact::rolling("", 0, 1 + usize::from(numbers.next() > 0.5), on));
        }
    }
    contacts
}

/// Contacts, resistance to rolling and dry friction in one system, with friction of up to three axes.
#[test]
fn ellipsoids_and_bounds_hold_their_laws_together() {
    let mut numbers = Numbers(23);
    // Of each kind: dry friction, one or two rows, drilling, rolling.
    let (mut sticks, mut slides) = ([0; 4], [0; 4]);
    for n in 0..600 {
        let contacts = several(&mut numbers, 1 + n % 4);
        let first = |i: usize| contacts[..i].iter().map(|contact| contact.rows().len()).sum::<usize>();
        let rows = first(contacts.len());
        // In so many dimensions rows are near to normal to one another: much sticks, where slips are slow.
        let (matrix, mut b) = random(&mut numbers, 0, rows, 6 * rows);
        for i in (0..contacts.len()).filter(|i| (n + i) % 2 == 0) {
            let slips = first(i) + usize::from(contacts[i].has_gap())..first(i + 1);
            slips.for_each(|row| b[row] *= 0.01);
        }
        // Units of forces are as the rows': bounds are some part of what would stop all of it.
        let scale = |row: usize| b[row].abs() / matrix.at(row, row);
        let among: Vec<usize> = (0..contacts.len()).collect();
        let mut laws = Vec::new();
        for (i, contact) in contacts.iter().enumerate() {
            let normal = first(contact.rolls_on().unwrap_or(i));
            let tangents = first(i) + usize::from(contact.has_gap())..first(i + 1);
            let mut bounds = tangents.map(|row| match contact.has_gap() || contact.rolls_on().is_some() {
                true => 0.6 * numbers.next() * (matrix.at(normal, normal) / matrix.at(row, row)).sqrt(),
                false => 10.0_f64.powf(2.0 * numbers.signed()) * scale(row),
            });
            let one = bounds.next().unwrap_or(0.0);
            let each = [one, bounds.next().unwrap_or(one), bounds.next().unwrap_or(one)];
            let largest = each.into_iter().fold(0.0, f64::max);
            let bounds = Bounds { largest, weights: each.map(|bound| bound / largest) };
            laws.push(Law::new(contact, bounds, None).among(contact, &among));
        }
        let solver = Contacts::new(laws.clone(), matrix.clone(), b.clone());
        let found = solver.solve().unwrap_or_else(|failure| panic!("{n} {failure:?}"));
        for (i, (contact, law)) in contacts.iter().zip(&laws).enumerate() {
            let rows = (first(i), first(contact.rolls_on().unwrap_or(i)));
            let slid = hold(contact, law.bounds, rows, (&matrix, &b), &found.forces);
            let kind = match (contact.rolls_on(), contact.drills) {
                (Some(_), _) => 3,
                (None, true) => 2,
                (None, false) => usize::from(contact.has_gap()),
            };
            if slid { slides[kind] += 1 } else { sticks[kind] += 1 }
        }
    }
    assert!(sticks.iter().all(|n| *n > 30) && slides.iter().all(|n| *n > 100), "{sticks:?} {slides:?}");
}

/// One contact with a spin and with resistance to rolling against the friction that does the most negative work.
#[test]
fn friction_of_drilling_takes_the_most_of_the_power() {
    let mut numbers = Numbers(3);
    let contacts = [Contact::new("", 0, 2).with_drilling(), Contact::rolling("", 4, 2, 0)];
    for n in 0..100 {
        let (matrix, b) = random(&mut numbers, 0, 6, 7);
        let bound = |row: usize| (matrix.at(0, 0) / matrix.at(row, row)).sqrt();
        let each = [1, 2, 3].map(|row| 0.2 * bound(row));
        let largest = each.into_iter().fold(0.0, f64::max);
        let law = |k: usize, bounds| Law::new(&contacts[k], bounds, None).among(&contacts[k], &[0, 1]);
        let rolling = 0.1 * bound(4).min(bound(5));
        let laws = vec![
            law(0, Bounds { largest, weights: each.map(|bound| bound / largest) }),
            law(1, Bounds { largest: rolling, weights: [1.0; 3] }),
        ];
        let found = Contacts::new(laws, matrix.clone(), b.clone()).solve().unwrap();
        let forces = &found.forces;
        let rate = |row: usize| matrix.row(row).iter().zip(forces).fold(b[row], |sum, (d, f)| sum + d * f);
        let power: f64 = (1..4).map(|row| forces[row] * rate(row)).sum();
        let of_rolling: f64 = (4..6).map(|row| forces[row] * rate(row)).sum();
        let size: f64 = (1..6).map(|row| (forces[row] * rate(row)).abs()).sum();
        for _ in 0..200 {
            let x = [numbers.signed(), numbers.signed(), numbers.signed()];
            let outside = norm(&x).max(1.0);
            let inside = x.map(|x| x / outside * forces[0]);
            let other: f64 = (0..3).map(|k| each[k] * inside[k] * rate(1 + k)).sum();
            assert!(other >= power - 1e-11 * size, "{n}");
            let other: f64 = (0..2).map(|k| rolling * inside[k] * rate(4 + k)).sum();
            assert!(other >= of_rolling - 1e-11 * size, "{n}");
        }
    }
}
