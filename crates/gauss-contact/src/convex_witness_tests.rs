//! A convex solver (`clarabel`), and its answer taken on to a hundred digits.
//!
//! In axes in which A = 1 the scene is: `½|x − x₀|² + Σ f |T x + c|` is least where `N x + c ≥ 0`. The convex solver
//! has x to some digits and tells which gaps stay closed and which slips are zero. With these as equations the minimum
//! is smooth; Newton's method with residuals in long numbers has it to as many digits as are wanted. Neither knows D.

use alloc::vec;
use alloc::vec::Vec;

use clarabel::algebra::CscMatrix;
use clarabel::solver::{DefaultSettingsBuilder, DefaultSolver, IPSolver, SolverStatus, SupportedConeT};
use num_bigint::BigInt;
use num_rational::BigRational;

use gauss_runtime::contact::Contact;

use crate::dense::{dot, norm, size};

/// A number with 400 bits behind the point.
#[derive(Clone, Debug, PartialEq, PartialOrd)]
pub(super) struct Long(BigInt);

const BITS: usize = 400;

impl Long {
    pub(super) fn new(x: f64) -> Self {
        let exact = BigRational::from_float(x).expect("is finite");
        Self((exact.numer() << BITS) / exact.denom())
    }

    pub(super) fn value(&self) -> f64 {
        let shift = self.0.bits().saturating_sub(64);
        let leading = (self.0.magnitude() >> shift).iter_u64_digits().next().unwrap_or(0) as f64;
        let size = leading * 2.0_f64.powi(shift as i32 - BITS as i32);
        if self.0 < BigInt::ZERO { -size } else { size }
    }

    pub(super) fn plus(&self, other: &Self) -> Self {
        Self(&self.0 + &other.0)
    }

    pub(super) fn minus(&self, other: &Self) -> Self {
        Self(&self.0 - &other.0)
    }

    pub(super) fn times(&self, other: &Self) -> Self {
        Self((&self.0 * &other.0) >> BITS)
    }

    fn over(&self, other: &Self) -> Self {
        Self((&self.0 << BITS) / &other.0)
    }

    fn root(&self) -> Self {
        Self((&self.0 << BITS).sqrt())
    }

    /// `c + w x`.
    pub(super) fn row(w: &[f64], x: &[Self], c: f64) -> Self {
        w.iter().zip(x).fold(Self::new(c), |sum, (w, x)| sum.plus(&Self::new(*w).times(x)))
    }
}

/// A convex problem. Of each contact with a gap the first row is N, the others are T; of dry friction all are.
pub(super) struct Convex {
    pub(super) contacts: Vec<Contact>,
    /// f of each contact.
    pub(super) bounds: Vec<f64>,
    pub(super) w: Vec<Vec<f64>>,
    pub(super) start: Vec<f64>,
    pub(super) c: Vec<f64>,
}

/// Answer of the convex solver.
pub(super) struct Rough {
    pub(super) x: Vec<f64>,
    /// Whether the gap of a contact stays closed, and whether it sticks.
    pub(super) closed: Vec<bool>,
    pub(super) sticks: Vec<bool>,
}

/// The minimum, in many digits.
pub(super) struct Minimum {
    pub(super) x: Vec<Long>,
    /// Rows that are zero and do not depend on one another, with their forces.
    pub(super) forces: Vec<(usize, f64)>,
}

impl Convex {
    fn normal(&self, i: usize) -> Option<usize> {
        self.contacts[i].has_gap().then_some(self.contacts[i].normal)
    }

    /// Whether a contact has friction: one that is not pressed has none.
    fn rubs(&self, i: usize) -> bool {
        self.contacts[i].tangents > 0 && self.bounds[i] > 0.0
    }

    /// The contacts with friction.
    fn rubbing(&self) -> Vec<usize> {
        (0..self.contacts.len()).filter(|&i| self.rubs(i)).collect()
    }

    /// The reciprocal size of a row, or of those of a slip, as a power of two.
    fn unit(&self, rows: impl IntoIterator<Item = usize>) -> f64 {
        let largest = rows.into_iter().map(|row| size(&self.w[row])).fold(0.0, f64::max);
        2.0_f64.powi(-largest.log2().round() as i32)
    }

    /// Solves the problem by the convex solver. The size of each slip is a variable of its own, behind x.
    pub(super) fn solve(&self) -> Rough {
        let (n, slips) = (self.start.len(), self.rubbing().len());
        let wide = |row: usize, unit: f64| self.w[row].iter().map(move |w| -unit * w).chain(vec![0.0; slips]).collect();
        let (mut rows, mut b, mut cones) = (Vec::<Vec<f64>>::new(), Vec::new(), Vec::new());
        let mut costs: Vec<f64> = self.start.iter().map(|x| -x).collect();
        for normal in (0..self.contacts.len()).filter_map(|i| self.normal(i)) {
            let unit = self.unit([normal]);
            rows.push(wide(normal, unit));
            b.push(unit * self.c[normal]);
            cones.push(SupportedConeT::NonnegativeConeT(1));
        }
        for i in self.rubbing() {
            let (tangents, unit) = (self.contacts[i].tangent_rows(), self.unit(self.contacts[i].tangent_rows()));
            let mut of_size = vec![0.0; n + slips];
            of_size[costs.len()] = -1.0;
            costs.push(self.bounds[i] / unit);
            cones.push(SupportedConeT::SecondOrderConeT(1 + tangents.len()));
            rows.extend(core::iter::once(of_size).chain(tangents.clone().map(|row| wide(row, unit))));
            b.extend(core::iter::once(0.0).chain(tangents.map(|row| unit * self.c[row])));
        }
        let identity = |i: usize, j: usize| if i == j && i < n { 1.0 } else { 0.0 };
        let cost: Vec<Vec<f64>> = (0..n + slips).map(|i| (0..n + slips).map(|j| identity(i, j)).collect()).collect();
        // More than it has: it ends where it goes no further.
        let mut settings = DefaultSettingsBuilder::default();
        settings.verbose(false).tol_gap_abs(1e-14).tol_gap_rel(1e-14).tol_feas(1e-14);
        let settings = settings.build().expect("are settings");
        let solver = DefaultSolver::new(&sparse(&cost), &costs, &sparse(&rows), &b, &cones, settings);
        let mut solver = solver.expect("sizes agree");
        solver.solve();
        let answer = &solver.solution;
        use SolverStatus::{AlmostSolved, InsufficientProgress, Solved};
        assert!(matches!(answer.status, Solved | AlmostSolved | InsufficientProgress), "{:?}", answer.status);
        self.judged(answer.x[..n].to_vec(), &answer.s, &answer.z)
    }

    /// Judges what contacts do by the larger of rate and force in units in which rows have length 1.
    fn judged(&self, x: Vec<f64>, rates: &[f64], forces: &[f64]) -> Rough {
        let (mut closed, mut sticks) = (vec![true; self.contacts.len()], vec![true; self.contacts.len()]);
        let mut at = 0;
        for i in (0..self.contacts.len()).filter(|&i| self.contacts[i].has_gap()) {
            closed[i] = forces[at] > rates[at];
            at += 1;
        }
        for i in self.rubbing() {
            let contact = self.contacts[i];
            let rows = at + 1..at + 1 + contact.tangents;
            sticks[i] = forces[at] - norm(&forces[rows.clone()]) > norm(&rates[rows.clone()]);
            at = rows.end;
        }
        Rough { x, closed, sticks }
    }

    /// The minimum, from what the convex solver has: where equations leave a gap negative, a force that pulls or
    /// friction beyond its bound, they are changed there. Nothing where that does not end.
    pub(super) fn refined(&self, rough: &Rough) -> Option<Minimum> {
        let mut x: Vec<Long> = rough.x.iter().map(|x| Long::new(*x)).collect();
        let rows = |i: usize| {
            let normal = self.normal(i).filter(|_| rough.closed[i]);
            normal.into_iter().chain(self.contacts[i].tangent_rows().filter(move |_| rough.sticks[i] && self.rubs(i)))
        };
        let mut zero: Vec<usize> = (0..self.contacts.len()).flat_map(rows).collect();
        for round in 0..200 {
            let rows = independent(&self.w, &zero);
            match self.stationary(&mut x, &rows, &zero) {
                Ok(forces) => {
                    if self.corrected(&mut zero, &mut x, &rows, &forces, round > 10) {
                        let forces = rows.iter().copied().zip(forces.iter().map(Long::value)).collect();
                        return Some(Minimum { x, forces });
                    }
                }
                Err(ends) => zero.extend(self.contacts[ends].tangent_rows()),
            }
        }
        None
    }

    /// Forces with which the smooth minimum under these rows is reached; else the contact whose slip ends before.
    fn stationary(&self, x: &mut [Long], rows: &[usize], zero: &[usize]) -> Result<Vec<Long>, usize> {
        let slides =
            |i: &usize| self.contacts[*i].tangents > 0 && !zero.contains(&self.contacts[*i].tangent_rows().start);
        let sliding: Vec<usize> = self.rubbing().into_iter().filter(slides).collect();
        let mut forces = vec![Long::new(0.0); rows.len()];
        let slip = |i: usize, x: &[Long]| -> Vec<f64> {
            let unit = self.unit(self.contacts[i].tangent_rows());
            self.contacts[i].tangent_rows().map(|row| unit * Long::row(&self.w[row], x, self.c[row]).value()).collect()
        };
        for _ in 0..400 {
            let slips: Vec<Vec<f64>> = sliding.iter().map(|&i| slip(i, x)).collect();
            let least = slips.iter().map(|s| size(s)).enumerate().min_by(|a, b| a.1.total_cmp(&b.1));
            if let Some((k, _)) = least.filter(|(_, least)| *least <= 1e-12 * size(&self.start)) {
                return Err(sliding[k]);
            }
            let (rest, matrix) = self.newton(x, &forces, rows, &sliding);
            let (step, _) = eliminated(matrix, rest).expect("rows are independent");
            let (by, further) = step.split_at(x.len());
            // No slip turns back, but each may end.
            let mut part = 1.0;
            let near = loop {
                let near: Vec<Long> = x.iter().zip(by).map(|(x, by)| x.minus(&Long::new(part * by))).collect();
                let turns =
                    |(&i, before): (&usize, &Vec<f64>)| dot(&slip(i, &near), before) < 0.01 * dot(before, before);
                if !sliding.iter().zip(&slips).any(turns) {
                    break near;
                }
                part *= 0.5;
            };
            x.clone_from_slice(&near);
            let units = rows.iter().map(|&row| self.unit([row]));
            let add = |((force, by), unit): ((&mut Long, &f64), f64)| *force = force.plus(&Long::new(part * by * unit));
            forces.iter_mut().zip(further).zip(units).for_each(add);
            if part == 1.0 && size(by) <= 1e-40 * size(&self.start) {
                return Ok(forces);
            }
        }
        Err(sliding.first().copied().expect("is linear where nothing slides"))
    }

    /// Changes which rows are zero where the laws do not hold; whether all do.
    fn corrected(&self, zero: &mut Vec<usize>, x: &mut [Long], rows: &[usize], forces: &[Long], one: bool) -> bool {
        let force = |row: usize| rows.iter().position(|r| *r == row).map_or(0.0, |k| forces[k].value());
        let mut holds = true;
        for (i, contact) in self.contacts.iter().enumerate() {
            if one && !holds {
                break;
            }
            let rate = |row: usize| self.unit([row]) * Long::row(&self.w[row], x, self.c[row]).value();
            let little = 1e-30 * size(&self.start);
            if let Some(normal) = self.normal(i) {
                let closes = rate(normal) < -little;
                let pulls = force(normal) < 0.0;
                if closes || pulls {
                    zero.retain(|row| *row != normal);
                    holds = false;
                }
                if closes {
                    zero.insert(0, normal);
                }
            }
            let tangents = contact.tangent_rows();
            if !self.rubs(i) || !zero.contains(&tangents.start) {
                continue;
            }
            let friction: Vec<f64> = tangents.clone().map(force).collect();
            let slips = tangents.clone().any(|row| rate(row).abs() > little);
            let breaks = norm(&friction) > self.bounds[i] * (1.0 + 1e-14);
            if slips || breaks {
                zero.retain(|row| !tangents.contains(row));
                holds = false;
            }
            if slips {
                zero.splice(0..0, tangents).for_each(drop);
            } else if breaks {
                // To where it goes with the largest friction, while other forces stay.
                let less = self.bounds[i] / norm(&friction) - 1.0;
                for (row, force) in tangents.zip(&friction) {
                    let by = less * force;
                    x.iter_mut().zip(&self.w[row]).for_each(|(x, w)| *x = x.plus(&Long::new(by * w)));
                }
            }
        }
        holds
    }

    /// Residuals of the equations, and their matrix.
    fn newton(&self, x: &[Long], forces: &[Long], rows: &[usize], sliding: &[usize]) -> (Vec<f64>, Vec<Vec<f64>>) {
        let n = x.len();
        let mut rest: Vec<Long> = x.iter().zip(&self.start).map(|(x, start)| x.minus(&Long::new(*start))).collect();
        let mut matrix = vec![vec![0.0; n + rows.len()]; n + rows.len()];
        (0..n).for_each(|k| matrix[k][k] = 1.0);
        for &i in sliding {
            let tangents = self.contacts[i].tangent_rows();
            let slip: Vec<Long> = tangents.clone().map(|row| Long::row(&self.w[row], x, self.c[row])).collect();
            let length = slip.iter().fold(Long::new(0.0), |sum, s| sum.plus(&s.times(s))).root();
            let bound = Long::new(self.bounds[i]);
            let along: Vec<Long> = slip.iter().map(|s| s.over(&length)).collect();
            for (row, along) in tangents.clone().zip(&along) {
                let force = bound.times(along);
                rest.iter_mut().zip(&self.w[row]).for_each(|(rest, w)| *rest = rest.plus(&Long::new(*w).times(&force)));
            }
            // Along two tangents its direction turns.
            if let [along_x, along_y] = &along[..] {
                let (sine, cosine) = (along_y.value(), along_x.value());
                let [first, second] = [tangents.start, tangents.start + 1].map(|row| &self.w[row]);
                let across: Vec<f64> = first.iter().zip(second).map(|(a, b)| cosine * b - sine * a).collect();
                let part = self.bounds[i] / length.value();
                (0..n).for_each(|k| (0..n).for_each(|l| matrix[k][l] += part * across[k] * across[l]));
            }
        }
        let mut left = Vec::new();
        for (k, (&row, force)) in rows.iter().zip(forces).enumerate() {
            let unit = self.unit([row]);
            rest.iter_mut().zip(&self.w[row]).for_each(|(rest, w)| *rest = rest.minus(&Long::new(*w).times(force)));
            (0..n).for_each(|l| {
                matrix[n + k][l] = unit * self.w[row][l];
                matrix[l][n + k] = unit * self.w[row][l];
            });
            left.push(unit * Long::row(&self.w[row], x, self.c[row]).value());
        }
        (rest.iter().map(Long::value).chain(left).collect(), matrix)
    }
}

fn sparse(rows: &[Vec<f64>]) -> CscMatrix<f64> {
    let (m, n) = (rows.len(), rows[0].len());
    let (mut starts, mut places, mut entries) = (vec![0], Vec::new(), Vec::new());
    for j in 0..n {
        for (i, row) in rows.iter().enumerate().filter(|(_, row)| row[j] != 0.0) {
            places.push(i);
            entries.push(row[j]);
        }
        starts.push(places.len());
    }
    CscMatrix::new(m, n, starts, places, entries)
}

/// The first of these rows that do not depend on those before them, exactly.
pub(in crate::solver) fn independent(w: &[Vec<f64>], rows: &[usize]) -> Vec<usize> {
    let exact = |x: &f64| BigRational::from_float(*x).expect("is finite");
    let zero = BigRational::from_integer(BigInt::ZERO);
    let (mut basis, mut found) = (Vec::<(usize, Vec<BigRational>)>::new(), Vec::new());
    for &row in rows {
        let mut rest: Vec<BigRational> = w[row].iter().map(exact).collect();
        for (pivot, of) in &basis {
            let part = &rest[*pivot] / &of[*pivot];
            rest.iter_mut().zip(of).for_each(|(rest, of)| *rest = &*rest - &part * of);
        }
        if let Some(pivot) = rest.iter().position(|x| *x != zero) {
            basis.push((pivot, rest));
            found.push(row);
        }
    }
    found
}

/// Solution by elimination with pivots, with the smallest of them; nothing where one is zero.
pub(in crate::solver) fn eliminated(mut matrix: Vec<Vec<f64>>, mut right: Vec<f64>) -> Option<(Vec<f64>, f64)> {
    let (n, mut least) = (right.len(), f64::INFINITY);
    for k in 0..n {
        let pivot = (k..n).max_by(|&i, &j| matrix[i][k].abs().total_cmp(&matrix[j][k].abs()))?;
        if matrix[pivot][k] == 0.0 {
            return None;
        }
        matrix.swap(k, pivot);
        right.swap(k, pivot);
        least = least.min(matrix[k][k].abs());
        for i in k + 1..n {
            let part = matrix[i][k] / matrix[k][k];
            (k..n).for_each(|j| matrix[i][j] -= part * matrix[k][j]);
            right[i] -= part * right[k];
        }
    }
    for k in (0..n).rev() {
        right[k] = (right[k] - dot(&matrix[k][k + 1..], &right[k + 1..])) / matrix[k][k];
    }
    Some((right, least))
}
