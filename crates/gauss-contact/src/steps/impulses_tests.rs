//! Random problems against the solver of exact runs, which finds states by other ways.

use alloc::vec;
use alloc::vec::Vec;

use gauss_runtime::contact::Contact;
use gauss_runtime::nalgebra::{Quaternion, UnitQuaternion, Vector3};

use super::*;
use crate::dense::{Matrix, dot};
use crate::friction::Bounds;
use crate::law::Law;
use crate::solution::Failure;
use crate::solver::Contacts;

/// Numbers in (−1, 1): a linear congruence with the constants of Knuth's MMIX.
pub(in crate::steps) fn numbers(mut seed: u64) -> impl FnMut() -> f64 {
    move || {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (seed >> 11) as f64 / 4_503_599_627_370_496.0 - 1.0
    }
}

pub(in crate::steps) struct Random {
    pub(in crate::steps) rows: Vec<Vec<f64>>,
    /// Speeds without impulses.
    pub(in crate::steps) free: Vec<f64>,
    pub(in crate::steps) b: Vec<f64>,
    pub(in crate::steps) cones: Vec<Cone>,
}

impl Random {
    /// Contacts with so many tangents in a space of some dimensions, with unit masses. Friction is below Painlevé's
    /// paradox: normals are longer than what tangents have along them.
    pub(in crate::steps) fn new(
        number: &mut dyn FnMut() -> f64,
        (count, tangents, dimensions): (usize, usize, usize),
        mu: f64,
    ) -> Self {
        let mut rows: Vec<Vec<f64>> = Vec::new();
        let mut cones = Vec::new();
        for _ in 0..count {
            let unit = 10.0_f64.powf(2.0 * number());
            let first = rows.len();
            let mut frame: Vec<Vec<f64>> =
                (0..=tangents).map(|_| (0..dimensions).map(|_| unit * number()).collect()).collect();
            for k in 1..=tangents {
                let along = dot(&frame[0].clone(), &frame[k]) / dot(&frame[0], &frame[0]);
                let part = 0.5 / mu.max(0.5);
                let normal = frame[0].clone();
                // What is along the normal is made smaller, not zero: friction presses and lifts.
                frame[k].iter_mut().zip(&normal).for_each(|(t, n)| *t -= (1.0 - part) * along * n);
            }
            rows.append(&mut frame);
            cones.push(Cone {
                normal: Some(first),
                pressed: Some(first),
                first: first + 1,
                count: tangents,
                friction: mu,
                acts: true,
            });
        }
        let free: Vec<f64> = (0..dimensions).map(|_| number()).collect();
        let b = rows.iter().map(|row| dot(row, &free)).collect();
        Self { rows, free, b, cones }
    }

    pub(in crate::steps) fn matrix(&self) -> Matrix {
        Matrix::from_fn(self.b.len(), |i, j| dot(&self.rows[i], &self.rows[j]))
    }

    /// Impulses and rates, found from given ones.
    fn solve(&self, start: &[f64]) -> (Found, Vec<f64>, Vec<f64>) {
        let n = self.b.len();
        let mut memory = vec![0.0; memory(n)];
        let (mut rows, mut order, mut extents) = (vec![0; n], vec![0; n], vec![[0; 2]; n]);
        let mut states = vec![State::Leaves; self.cones.len()];
        let unknowns = UnknownsIn { rows: &mut rows, order: &mut order, extents: &mut extents, states: &mut states };
        let mut problem = Impulses::new(&mut memory, unknowns);
        let matrix = self.matrix();
        problem.set_up(&vec![1.0; n], |i, j| matrix.at(i, j), |row| [self.b[row], start[row]]);
        let found = problem.solve(&self.cones, 1e-12);
        (found, problem.impulses.to_vec(), problem.rates.to_vec())
    }

    /// The same by the solver of exact runs.
    fn rates(&self) -> Result<Vec<f64>, Failure> {
        let law = |cone: &Cone| {
            let bounds = Bounds { largest: cone.friction, ..Bounds::of(&Contact::new("", 0, 0), &nalgebra_zero()) };
            Law::new(&Contact::new("", 0, cone.count), bounds, None)
        };
        let laws = self.cones.iter().map(law).collect();
        Contacts::new(laws, self.matrix(), self.b.clone()).solve().map(|found| found.rates)
    }
}

/// No friction.
fn nalgebra_zero() -> gauss_runtime::nalgebra::SVector<f64, 1> {
    gauss_runtime::nalgebra::SVector::from([0.0])
}

#[test]
fn impulses_are_those_of_exact_runs() {
    let mut number = numbers(3);
    let (mut others, mut sweeps, mut corrections, mut solved) = (0, 0, 0, 0);
    for n in 0..600 {
        let (count, tangents) = (1 + n % 6, n % 3);
        // More rows than dimensions as well.
        let dimensions = 3 + n % 7;
        let random = Random::new(&mut number, (count, tangents, dimensions), [0.2, 0.7, 1.2][n / 3 % 3]);
        let (found, impulses, rates) = random.solve(&vec![0.0; random.b.len()]);
        assert!(impulses.iter().all(|x| x.is_finite()));
        if !found.holds {
            continue;
        }
        solved += 1;
        sweeps += found.sweeps;
        corrections += found.corrections;
        let Ok(exact) = random.rates() else { continue };
        let size = |row: usize| dot(&random.rows[row], &random.rows[row]).sqrt();
        let apart = (0..rates.len()).map(|row| (rates[row] - exact[row]).abs() / size(row)).fold(0.0, f64::max);
        // Rates of gaps without friction are unique; Coulomb's law may have several solutions for several contacts.
        assert!(apart < 1e-9 || tangents > 0, "{n} {apart:e}");
        others += usize::from(apart >= 1e-9);
    }
    assert!(solved == 600 && others <= 15, "{solved} {others}");
    assert!(corrections < 6 * 600, "{corrections} {sweeps}");
}

#[test]
fn a_warm_start_takes_one_correction_or_two() {
    let mut number = numbers(8);
    for n in 0..200 {
        let mut random = Random::new(&mut number, (4, 2, 18), 0.7);
        let (found, impulses, _) = random.solve(&[0.0; 12]);
        assert!(found.holds, "{n}");
        random.b.iter_mut().for_each(|b| *b *= 1.0 + 1e-6);
        let (found, ..) = random.solve(&impulses);
        assert!(found.holds && found.sweeps == 0 && found.corrections <= 4, "{n} {found:?}");
    }
}

#[test]
fn sixty_four_contacts_on_a_plate_carry_it() {
    // Many more than a plate needs: impulses are not unique, its rates are.
    let n = 64;
    let mut number = numbers(21);
    let places: Vec<[f64; 2]> = (0..n).map(|_| [number(), number()]).collect();
    let mut rows = Vec::new();
    let mut cones = Vec::new();
    for [x, y] in &places {
        let first = rows.len();
        // Velocity and spin of the plate, masses of 1: z + y a − x b, x − y c, y + x c.
        rows.push(vec![0.0, 0.0, 1.0, *y, -*x, 0.0]);
        rows.push(vec![1.0, 0.0, 0.0, 0.0, 0.0, -*y]);
        rows.push(vec![0.0, 1.0, 0.0, 0.0, 0.0, *x]);
        cones.push(Cone {
            normal: Some(first),
            pressed: Some(first),
            first: first + 1,
            count: 2,
            friction: 0.5,
            acts: true,
        });
    }
    let b = |free: [f64; 6], rows: &[Vec<f64>]| rows.iter().map(|row| dot(row, &free)).collect::<Vec<_>>();
    // Pressed, and pushed along by less and by more than friction holds.
    for push in [0.2, 2.0] {
        let free = [push, 0.0, -1.0, 0.05, -0.02, 0.0];
        let random = Random { b: b(free, &rows), free: free.to_vec(), rows: rows.clone(), cones: cones.clone() };
        let (found, impulses, rates) = random.solve(&vec![0.0; 3 * n]);
        assert!(found.holds, "{push} {found:?}");
        let carried: f64 = impulses.iter().step_by(3).sum();
        assert!((carried - 1.0).abs() < 1e-9, "{push} {carried}");
        let slip = rates.iter().skip(1).step_by(3).fold(0.0_f64, |most, s| most.max(s.abs()));
        if push < 0.5 {
            assert!(slip < 1e-9, "{slip}");
        } else {
            assert!(slip > 1.0, "{slip}");
        }
    }
}

const DIE: (f64, f64) = (16e-3, 4.5e-3);
const PRESSED: f64 = 9.81 * 5e-4;

/// A die on its way to a face in a step of 0.5 ms, all but at rest: two of its corners are to keep a part of their
/// rates, the others none. By how much these rates contradict one another comes with it.
fn die_on_a_face() -> (Random, f64) {
    let ((a, m), e) = (DIE, 0.4);
    let turn = [-0.6928509533972876, -0.6928397817233589, -0.1413259949904657, -0.14127121567379836];
    let turn = Quaternion::new(turn[0], turn[1], turn[2], turn[3]);
    let turn = UnitQuaternion::from_quaternion(turn).to_rotation_matrix();
    let v = Vector3::new(3.1728786825290975e-5, 3.173009949904333e-5, 2.7350723270404276e-10);
    let omega = Vector3::new(4.7409264464973974e-8, 6.590896667116319e-7, -0.003965999673104495);
    let unit = [m, m * a * a / 6.0].map(|inertia| 1.0 / inertia.sqrt());
    let (mut rows, mut before, mut b) = (Vec::new(), Vec::new(), Vec::new());
    for corner in [[-1.0, -1.0, -1.0], [1.0, -1.0, -1.0], [-1.0, -1.0, 1.0], [1.0, -1.0, 1.0]] {
        let corner = Vector3::from(corner) * (0.5 * a);
        for (k, pressed) in [(2, PRESSED), (0, 0.0), (1, 0.0)] {
            let along = turn.matrix().row(k).transpose();
            let about = corner.cross(&along);
            let rate = along.dot(&v) + about.dot(&omega);
            before.push(rate);
            b.push(rate - pressed);
            rows.push([along * unit[0], about * unit[1]].iter().flatten().copied().collect());
        }
    }
    [0, 6].into_iter().for_each(|row| b[row] += e * before[row]);
    let friction = |i| Cone { normal: Some(i), pressed: Some(i), first: i + 1, count: 2, friction: 0.3, acts: true };
    let cones = [0, 3, 6, 9].map(friction).to_vec();
    (Random { rows, free: Vec::new(), b, cones }, e * (before[0] - before[6]))
}

#[test]
fn corners_whose_rates_contradict_one_another_by_little_are_left() {
    let (die, parted) = die_on_a_face();
    let mut start = [0.0; 12];
    let cold = start;
    start[..3].copy_from_slice(&[8.235414321941483e-6, -1.169897169946507e-6, 2.1760801976523423e-6]);
    start[6..9].copy_from_slice(&[2.0944530691796654e-6, -6.279243475414516e-7, 2.273858118468784e-8]);
    start[9..].copy_from_slice(&[1.2242329314634517e-5, -2.65601898257325e-6, 2.536588180711825e-6]);
    for start in [start, cold] {
        let (found, impulses, rates) = die.solve(&start);
        assert!(found.holds, "{found:?}");
        let normals = |of: &[f64]| [0, 3, 6, 9].map(|row| of[row]);
        // Four corners in a plane: three stay, and the fourth leaves by what their rates are apart, 3e-10 m/s.
        let open = normals(&rates).into_iter().fold(0.0, f64::max);
        assert!((open - parted).abs() < 4.0 * found.residual.rounding, "{open:e} {parted:e} {found:?}");
        // They carry the weight, but for the rates that it had, 1.3 % of those that it gains.
        let carried: f64 = normals(&impulses).into_iter().sum();
        assert!((carried / (DIE.1 * PRESSED) - 1.0).abs() < 0.013, "{carried:e}");
    }
}
