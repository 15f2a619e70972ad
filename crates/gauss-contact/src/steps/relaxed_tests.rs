//! The relaxed law against a convex solver that knows neither D nor impulses.

use alloc::vec;
use alloc::vec::Vec;

use clarabel::algebra::CscMatrix;
use clarabel::solver::{DefaultSettingsBuilder, DefaultSolver, IPSolver, SolverStatus, SupportedConeT};

use super::super::impulses::tests::{Random, numbers};
use super::super::impulses::{Found, memory};
use super::super::unknowns::UnknownsIn;
use super::*;
use crate::dense::{dot, size};

/// Impulses and rates by the relaxed law, with how far they are from Coulomb's.
fn solve(random: &Random) -> (Found, Vec<f64>, Vec<f64>, f64) {
    let n = random.b.len();
    let mut memory = vec![0.0; memory(n)];
    let (mut rows, mut order, mut extents) = (vec![0; n], vec![0; n], vec![[0; 2]; n]);
    let mut states = vec![State::Leaves; random.cones.len()];
    let unknowns = UnknownsIn { rows: &mut rows, order: &mut order, extents: &mut extents, states: &mut states };
    let mut problem = Impulses::new(&mut memory, unknowns);
    problem.relaxed = true;
    let matrix = random.matrix();
    problem.set_up(&vec![1.0; n], |i, j| matrix.at(i, j), |row| [random.b[row], 0.0]);
    let found = problem.solve(&random.cones, 1e-12);
    let from_coulomb = problem.residual_of_coulomb(&random.cones).signorini;
    (found, problem.impulses.to_vec(), problem.rates.to_vec(), from_coulomb)
}

/// `½|x − x₀|²` is least where `N x ≥ Σ μ |T x|` of each gap, with rows at length 1; each |T x| is a variable. With how
/// far that energy is from the least one at most.
fn witness(random: &Random) -> (Vec<f64>, f64) {
    let (n, slips) = (random.free.len(), random.cones.len());
    let unit = |row: usize| 1.0 / size(&random.rows[row]);
    let of_slip = |cone: &Cone| cone.tangents().map(unit).fold(f64::INFINITY, f64::min);
    let (mut rows, mut cones) = (Vec::<Vec<f64>>::new(), Vec::new());
    for cone in random.cones.iter().filter(|cone| cone.normal.is_some()) {
        let normal = cone.normal.unwrap();
        let part = unit(normal);
        let mut row: Vec<f64> = random.rows[normal].iter().map(|w| -part * w).chain(vec![0.0; slips]).collect();
        for (i, other) in random.cones.iter().enumerate().filter(|(_, other)| other.pressed == Some(normal)) {
            row[n + i] = part * other.friction / of_slip(other);
        }
        rows.push(row);
        cones.push(SupportedConeT::NonnegativeConeT(1));
    }
    for (i, cone) in random.cones.iter().enumerate() {
        let mut length = vec![0.0; n + slips];
        length[n + i] = -1.0;
        rows.push(length);
        let part = if cone.count > 0 { of_slip(cone) } else { 1.0 };
        let of_row = |row: usize| random.rows[row].iter().map(|w| -part * w).chain(vec![0.0; slips]).collect();
        rows.extend(cone.tangents().map(of_row));
        cones.push(SupportedConeT::SecondOrderConeT(1 + cone.count));
    }
    let costs: Vec<f64> = random.free.iter().map(|x| -x).chain(vec![0.0; slips]).collect();
    let cost = CscMatrix::new(
        n + slips,
        n + slips,
        (0..=n + slips).map(|k| k.min(n)).collect(),
        (0..n).collect(),
        vec![1.0; n],
    );
    let (m, mut starts, mut places, mut entries) = (rows.len(), vec![0], Vec::new(), Vec::new());
    for j in 0..n + slips {
        for (i, row) in rows.iter().enumerate().filter(|(_, row)| row[j] != 0.0) {
            places.push(i);
            entries.push(row[j]);
        }
        starts.push(places.len());
    }
    let matrix = CscMatrix::new(m, n + slips, starts, places, entries);
    let mut settings = DefaultSettingsBuilder::default();
    settings.verbose(false).tol_gap_abs(1e-14).tol_gap_rel(1e-14).tol_feas(1e-14);
    let settings = settings.build().expect("are settings");
    let mut solver = DefaultSolver::new(&cost, &costs, &matrix, &vec![0.0; m], &cones, settings).expect("sizes agree");
    solver.solve();
    use SolverStatus::{AlmostSolved, InsufficientProgress, Solved};
    let status = solver.solution.status;
    assert!(matches!(status, Solved | AlmostSolved | InsufficientProgress), "{status:?}");
    let gap = (solver.solution.obj_val - solver.solution.obj_val_dual).abs();
    // Energies of the size of ½|x₀|² have rounding.
    let gap = gap + 1e-14 * dot(&random.free, &random.free);
    (solver.solution.x[..n].to_vec(), gap)
}

fn hold(n: usize, random: &Random) -> (Found, f64, f64) {
    let (found, impulses, rates, from_coulomb) = solve(random);
    assert!(found.holds, "{n} {found:?}");
    assert!(impulses.iter().all(|x| x.is_finite()));
    let ((x, gap), largest) = (witness(random), size(&random.free));
    for (row, w) in random.rows.iter().enumerate() {
        // The minimum is strongly convex: ½|x − x*|² is no more than what the energy is off by. Constraints hold to as
        // much.
        let off = (rates[row] - dot(w, &x)).abs();
        assert!(off <= 2.0 * (2.0 * gap).sqrt() * size(w), "{n} {row} {off:e} {gap:e} {found:?}");
    }
    // P·u = 0 by cones, which with both in their cones is the minimum; products of rounding and of what is looked for.
    let power = dot(&impulses, &rates).abs();
    let sizes: f64 = impulses.iter().zip(&random.rows).map(|(p, w)| p.abs() * size(w) * largest).sum();
    assert!(power <= 1e-9 * sizes, "{n} {power:e} {sizes:e}");
    (found, from_coulomb, gap)
}

#[test]
fn rates_are_those_of_a_convex_solver() {
    let mut number = numbers(5);
    let (mut corrections, mut sweeps, mut apart, mut rough) = (0, 0, 0, 0);
    for n in 0..600 {
        let (count, tangents, dimensions) = (1 + n % 6, n % 3, 3 + n % 7);
        let random = Random::new(&mut number, (count, tangents, dimensions), [0.2, 0.7, 1.2][n / 3 % 3]);
        let (found, from_coulomb, gap) = hold(n, &random);
        rough += usize::from(gap > 1e-12);
        corrections += found.corrections;
        sweeps += found.sweeps;
        // Without friction the laws are one.
        assert!(tangents > 0 || from_coulomb <= found.residual.rounding.max(found.residual.signorini), "{n}");
        apart += usize::from(from_coulomb > 1e-6 * size(&random.free));
    }
    // Where the convex solver goes no further it says less.
    assert!(apart > 100 && rough < 60, "{apart} {rough}");
    assert!(corrections < 12 * 600, "{corrections} {sweeps}");
}

#[test]
fn rolling_resistance_and_dry_friction_are_parts_of_the_same_minimum() {
    let mut number = numbers(11);
    for n in 0..200 {
        let mut random = Random::new(&mut number, (1 + n % 4, 2, 9), 0.6);
        // Resistance at the last gap.
        let first = random.rows.len();
        random.rows.extend((0..2).map(|_| (0..9).map(|_| number()).collect::<Vec<f64>>()));
        let pressed = random.cones.last().and_then(|cone| cone.normal);
        let rolls = Cone { normal: None, pressed, first, count: 2, friction: 0.3, acts: true };
        random.cones.push(rolls);
        random.b = random.rows.iter().map(|row| dot(row, &random.free)).collect();
        hold(n, &random);
    }
}

#[test]
fn the_nearest_point_of_cones_is_the_best_of_many() {
    let mut number = numbers(2);
    for n in 0..300 {
        let x = 2.0 * number();
        let each: Vec<[f64; 3]> = (0..1 + n % 3).map(|_| [1.0 + number(), number().abs(), number().abs()]).collect();
        let off = |normal: f64| {
            let beyond = |[weight, mu, size]: &[f64; 3]| weight * (size - mu * normal).max(0.0).powi(2);
            1.3 * (normal - x).powi(2) + each.iter().map(beyond).sum::<f64>()
        };
        let found = nearest((1.3, x), &each);
        let least = (0..4000).map(|k| off(1e-3 * f64::from(k))).fold(f64::INFINITY, f64::min);
        // Rounding of numbers of about 10.
        assert!(found >= 0.0 && off(found) <= least + 1e-14, "{n} {found}");
    }
}
