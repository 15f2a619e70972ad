//! Random problems against enumeration and against the laws themselves, checked anew.

use super::*;

/// Numbers in (0, 1): a linear congruence with the constants of Knuth's MMIX.
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((self.0 >> 11) as f64 + 0.5) / 9_007_199_254_740_992.0
    }

    fn signed(&mut self) -> f64 {
        2.0 * self.next() - 1.0
    }
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
    let normal = contacts.normals[i];
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
        let laws = vec![Law { tangents: 0, friction: 0.0, slip: None }; count];
        let contacts = Contacts::new(laws, matrix, b);
        let found = contacts.solve(vec![0.0; count]).expect("is convex");
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
        let laws = (0..count).map(|_| Law { tangents, friction: 0.3 * numbers.next(), slip: None }).collect();
        let contacts = Contacts::new(laws, matrix, b);
        let found = contacts.solve(vec![0.0; contacts.b.len()]).unwrap_or_else(|failure| panic!("{n} {failure:?}"));
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
        let law = Law { tangents: 1, friction, slip: None };
        let found = Contacts::new(vec![law], matrix, b.to_vec()).solve(vec![0.0; 2]).expect("is regular");
        (found.forces, found.states[0])
    };
    assert_eq!(solve([-4.0, 1.0], 0.5), (vec![2.0, -0.5], State::Sticks));
    assert_eq!(solve([-4.0, 3.0], 0.5), (vec![2.0, -1.0], State::Slides([1.0, 0.0])));
    assert_eq!(solve([-4.0, -3.0], 0.5), (vec![2.0, 1.0], State::Slides([-1.0, 0.0])));
    assert_eq!(solve([4.0, 1.0], 0.5), (vec![0.0, 0.0], State::Leaves));
}

#[test]
fn painleves_states_are_told_apart() {
    // p = 1 − 2 · 0.8 < 0.
    let solve = |b: f64| {
        let matrix = Matrix::from_fn(2, |i, j| if i == j { 1.0 } else { 0.8 });
        let law = Law { tangents: 1, friction: 2.0, slip: Some([1.0, 0.0]) };
        Contacts::new(vec![law], matrix, vec![b, 0.0]).solve(vec![0.0; 2])
    };
    assert!(matches!(solve(-1.0), Err(Failure::Inconsistent(0))));
    assert!(matches!(solve(1.0), Err(Failure::Indeterminate(0))));
    assert!(matches!(solve(f64::NAN), Err(Failure::NonFinite)));
}
