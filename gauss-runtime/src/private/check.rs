//! Checks of the parameters of a body, all of them before the first report.

use core::marker::PhantomData;

use super::eigenvalues::{eigenvalues, negative_eigenvalue};
use crate::error::{BoundedList, ParameterError, Rule, Violation};
use crate::real::Real;

/// Collects every rule that the parameters break, one for each field: what follows from a first violation is not
/// reported again.
///
/// For packs of numbers every lane is checked; the first lane that breaks a rule speaks for the others.
pub struct ParameterCheck<T> {
    violations: BoundedList<Violation>,
    /// The first field with a mass, a principal moment or an armature of zero: others must make up for it.
    massless: Option<&'static str>,
    /// Principal moments need not satisfy the triangle inequality.
    formal: bool,
    scalar: PhantomData<T>,
}

impl<T: Real> Default for ParameterCheck<T> {
    fn default() -> Self {
        Self::new()
    }
}

impl<T: Real> ParameterCheck<T> {
    /// The unit of rounding of these checks: they look at lanes in double precision, also where the scalar is wider.
    pub(super) const UNIT: f64 = if T::EPSILON > f64::EPSILON { T::EPSILON } else { f64::EPSILON };

    /// No violation so far.
    #[inline(always)]
    #[must_use]
    pub fn new() -> Self {
        Self { violations: BoundedList::<Violation>::new(), massless: None, formal: false, scalar: PhantomData }
    }

    /// From here on principal moments need not obey the triangle inequality, or do again.
    pub fn waive_triangle_inequality(&mut self, waived: bool) {
        self.formal = waived;
    }

    /// Every value is finite.
    pub fn finite(&mut self, field: &'static str, values: &[T]) {
        self.finite_so_far(field, values);
    }

    /// A mass: finite and greater than zero.
    pub fn mass(&mut self, field: &'static str, mass: T) {
        if self.finite_so_far(field, &[mass]) {
            self.each_lane(field, |lane| {
                let value = mass.lane(lane);
                let positive = value > 0.0;
                (!positive).then_some((value, Rule::PositiveMass))
            });
        }
    }

    /// A mass in a sum: zero where other bodies make up for it, which [`regular`](Self::regular) finds out.
    pub fn mass_in_sum(&mut self, field: &'static str, mass: T) {
        if self.finite_so_far(field, &[mass]) {
            self.each_lane(field, |lane| {
                let value = mass.lane(lane);
                (value < 0.0).then_some((value, Rule::PositiveMass))
            });
            if (0..T::LANES).any(|lane| mass.lane(lane) == 0.0) {
                self.massless.get_or_insert(field);
            }
        }
    }

    /// The stiffness of a spring or a stop: finite and zero or greater.
    pub fn stiffness(&mut self, field: &'static str, stiffness: T) {
        if self.finite_so_far(field, &[stiffness]) {
            self.each_lane(field, |lane| {
                let value = stiffness.lane(lane);
                (value < 0.0).then_some((value, Rule::NonNegativeStiffness))
            });
        }
    }

    /// The distance over which a stop sets in: finite and greater than zero.
    pub fn width(&mut self, field: &'static str, width: T) {
        if self.finite_so_far(field, &[width]) {
            self.each_lane(field, |lane| {
                let value = width.lane(lane);
                (value <= 0.0).then_some((value, Rule::PositiveWidth))
            });
        }
    }

    /// The limits of a stop, the lower one first. `field` is the one that gives the lower limit.
    pub fn limits(&mut self, field: &'static str, [least, most]: [T; 2]) {
        if self.finite_so_far(field, &[least, most]) {
            self.each_lane(field, |lane| {
                let (value, most) = (least.lane(lane), most.lane(lane));
                (value >= most).then_some((value, Rule::LimitsInOrder { most }))
            });
        }
    }

    /// A value that is finite and zero or greater.
    pub fn non_negative(&mut self, field: &'static str, value: T) {
        if self.finite_so_far(field, &[value]) {
            self.each_lane(field, |lane| {
                let value = value.lane(lane);
                (value < 0.0).then_some((value, Rule::NonNegative))
            });
        }
    }

    /// The inertia of a rate: finite and zero or greater; zero where bodies make up for it, which
    /// [`regular`](Self::regular) finds out.
    pub fn armature(&mut self, field: &'static str, inertia: T) {
        self.non_negative(field, inertia);
        if (0..T::LANES).any(|lane| inertia.lane(lane) == 0.0) {
            self.massless.get_or_insert(field);
        }
    }

    /// A length that is greater than zero, also the square of its quarter, which rounding makes zero; both are finite.
    pub fn positive_length(&mut self, field: &'static str, value: T) {
        let quarter = value * T::from_f64(0.25);
        if self.finite_so_far(field, &[value, quarter * quarter]) {
            self.each_lane(field, |lane| {
                let positive = value.lane(lane) > 0.0 && (quarter * quarter).lane(lane) > 0.0;
                (!positive).then_some((value.lane(lane), Rule::PositiveLength))
            });
        }
    }

    /// The square of the length of a direction: finite and greater than zero.
    pub fn direction(&mut self, field: &'static str, square: T) {
        if self.finite_so_far(field, &[square]) {
            self.each_lane(field, |lane| {
                let value = square.lane(lane);
                (value <= 0.0).then_some((value, Rule::Direction))
            });
        }
    }

    /// A coefficient of restitution: from 0 to 1.
    pub fn restitution(&mut self, field: &'static str, value: T) {
        if self.finite_so_far(field, &[value]) {
            self.each_lane(field, |lane| {
                let value = value.lane(lane);
                (!(0.0..=1.0).contains(&value)).then_some((value, Rule::Restitution))
            });
        }
    }

    /// An inertia tensor about the centre of mass, or one of which nothing else is known: symmetric up to rounding,
    /// positive definite, and its principal moments obey the triangle inequality up to a few ulp of the trace.
    pub fn inertia(&mut self, field: &'static str, inertia: &[[T; 3]; 3]) {
        if self.symmetric_so_far(field, inertia, |row, col| Rule::SymmetricInertia { row, col }) {
            let formal = self.formal;
            self.each_lane(field, |lane| {
                let tensor = in_lane(inertia, lane);
                let slack = 8.0 * Self::UNIT * trace(&tensor);
                Moments { rounding: 0.0, slack, about_center_of_mass: false, formal }.broken_rule(&tensor)
            });
        }
    }

    /// The inertia tensor about O of a body in a sum, with its mass and its centre of mass: as
    /// [`inertia`](Self::inertia) and [`central_inertia`](Self::central_inertia), but a smallest moment of zero, as of
    /// rods, plates and particles, is one of a body: whether others make up for it is found by
    /// [`regular`](Self::regular).
    pub fn inertia_in_sum(&mut self, field: &'static str, mass: T, center: [T; 3], inertia: &[[T; 3]; 3]) {
        if !self.symmetric_so_far(field, inertia, |row, col| Rule::SymmetricInertia { row, col }) {
            return;
        }
        let formal = self.formal;
        let mut least = f64::INFINITY;
        for lane in 0..T::LANES {
            let about_o = in_lane(inertia, lane);
            let slack = 8.0 * Self::UNIT * trace(&about_o).abs();
            let moments = Moments { rounding: slack.next_up(), slack, about_center_of_mass: false, formal };
            if let Some((value, rule)) = moments.broken_rule(&about_o) {
                self.violations.push(Violation { field, value, rule });
                return;
            }
            let (m, c) = (mass.lane(lane), center.map(|c| c.lane(lane)));
            if !(m >= 0.0 && m.is_finite() && c.iter().all(|c| c.is_finite())) {
                continue;
            }
            let (central, square) = about_center_of_mass(&about_o, m, c);
            let slack = slack + 8.0 * Self::UNIT * m * square;
            let moments = Moments { rounding: slack.next_up(), slack, about_center_of_mass: true, formal };
            if let Some((value, rule)) = out_of_range(&central).or_else(|| moments.broken_rule(&central)) {
                self.violations.push(Violation { field, value, rule });
                return;
            }
            least = least.min(extremes(&eigenvalues(&central)).0 - slack);
        }
        if least <= 0.0 {
            self.massless.get_or_insert(field);
        }
    }

    /// The inertia tensor about O of a body that turns about one of its axes alone: no other moment enters. It is
    /// symmetric, and the moment about the axis is that of a body.
    pub fn inertia_about_axis(
        &mut self,
        field: &'static str,
        axis: usize,
        (mass, center): (T, [T; 3]),
        inertia: &[[T; 3]; 3],
    ) {
        if !self.symmetric_so_far(field, inertia, |row, col| Rule::SymmetricInertia { row, col }) {
            return;
        }
        // A disk across the axis has the same moment, and its centre of mass where it matters.
        let moment = inertia[axis][axis];
        let across = core::array::from_fn(|i| if i == axis { T::zero() } else { center[i] });
        let disk = core::array::from_fn(|i| core::array::from_fn(|j| if i == j { moment } else { T::zero() }));
        let formal = core::mem::replace(&mut self.formal, true);
        self.inertia_in_sum(field, mass, across, &disk);
        self.formal = formal;
    }

    /// An inertia tensor about O together with mass m and centre of mass c (from O, body axes): what is left about the
    /// centre of mass, `I_O − m(|c|² 1 − c cᵀ)`, must be the inertia of a body.
    ///
    /// Silent when mass or centre break rules of their own, which their fields report.
    pub fn central_inertia(&mut self, field: &'static str, mass: T, center: [T; 3], inertia: &[[T; 3]; 3]) {
        if !self.symmetric_so_far(field, inertia, |row, col| Rule::SymmetricInertia { row, col }) {
            return;
        }
        let formal = self.formal;
        self.each_lane(field, |lane| {
            let (m, c) = (mass.lane(lane), center.map(|c| c.lane(lane)));
            if !(m > 0.0 && m.is_finite() && c.iter().all(|c| c.is_finite())) {
                return None;
            }
            let about_o = in_lane(inertia, lane);
            let (central, square) = about_center_of_mass(&about_o, m, c);
            // The subtraction leaves rounding of the size of what was subtracted.
            let rounding = 8.0 * Self::UNIT * m * square;
            let slack = rounding + 8.0 * Self::UNIT * trace(&about_o);
            let moments = Moments { rounding, slack, about_center_of_mass: true, formal };
            out_of_range(&central).or_else(|| moments.broken_rule(&central))
        });
    }

    /// A matrix of added mass, in the order (u, ω): finite and symmetric up to rounding.
    pub fn symmetric(&mut self, field: &'static str, matrix: &[[T; 6]; 6]) {
        self.symmetric_so_far(field, matrix, |row, col| Rule::SymmetricAddedMass { row, col });
    }

    /// The stiffness matrix of a bushing or of modes: finite, symmetric, and without a negative eigenvalue, up to
    /// rounding.
    pub fn stiffness_matrix<const N: usize>(&mut self, field: &'static str, matrix: &[[T; N]; N]) {
        self.damping_matrix(field, matrix);
        if !self.has_violation(field) {
            self.each_lane(field, |lane| {
                let negative = negative_eigenvalue(&in_lane(matrix, lane), Self::UNIT);
                negative.map(|value| (value, Rule::SemidefiniteStiffness))
            });
        }
    }

    /// The damping matrix of a bushing or of modes: finite and symmetric up to rounding.
    pub fn damping_matrix<const N: usize>(&mut self, field: &'static str, matrix: &[[T; N]; N]) {
        self.symmetric_so_far(field, matrix, |row, col| Rule::SymmetricCoefficients { row, col });
    }

    /// The kinetic energy of a body that deforms, in the order (u, ω, η̇): finite, with positive modal masses, and
    /// without a negative eigenvalue, up to rounding.
    pub fn modes<const N: usize>(&mut self, field: &'static str, matrix: &[[T; N]; N]) {
        for row in matrix {
            if !self.finite_so_far(field, row) {
                return;
            }
        }
        self.each_lane(field, |lane| {
            let matrix = in_lane(matrix, lane);
            let massless = (6..N).map(|k| matrix[k][k]).find(|mass| *mass <= 0.0);
            let massless = massless.map(|mass| (mass, Rule::PositiveModalMass));
            let negative = || negative_eigenvalue(&matrix, Self::UNIT).map(|value| (value, Rule::SemidefiniteModes));
            massless.or_else(negative)
        });
    }

    /// The mass matrix A of body and fluid: positive definite, and invertible in the precision of the scalar.
    ///
    /// Its rows carry different units, so it is scaled to a unit diagonal first; then eigenvalues mean something.
    /// Silent when any parameter is wrong already, because A is made of all of them.
    pub fn kinetic_matrix<const N: usize>(&mut self, field: &'static str, matrix: &[[T; N]; N]) {
        if !self.violations.as_slice().is_empty() {
            return;
        }
        for row in matrix {
            if !self.finite_so_far(field, row) {
                return;
            }
        }
        self.each_lane(field, |lane| {
            let (smallest, largest) = match of_unit_diagonal(&in_lane(matrix, lane)) {
                Ok(found) => found,
                Err(entry) => return Some((entry, Rule::PositiveDefiniteKineticMatrix)),
            };
            let limit = 1.0 / Self::UNIT;
            // An entry is rounded to ε, and so is a vanishing eigenvalue: below, its sign says nothing.
            if smallest <= -(N as f64) * Self::UNIT {
                Some((smallest, Rule::PositiveDefiniteKineticMatrix))
            } else if smallest * limit < largest {
                let condition = if smallest > 0.0 { largest / smallest } else { f64::INFINITY };
                Some((condition, Rule::ConditionedKineticMatrix { limit }))
            } else {
                None
            }
        });
    }

    /// The field with a mass or a moment of zero for which others must make up, if there is one, and all is well
    /// otherwise.
    #[must_use]
    pub fn massless(&self) -> Option<&'static str> {
        self.massless.filter(|_| self.violations.as_slice().is_empty())
    }

    /// The mass matrix A of bodies some of which have no mass of their own, at a few configurations, of general
    /// position: it is regular at one of them, and then nearly everywhere, since its determinant is an analytic
    /// function.
    ///
    /// A matrix that is singular whatever q is has an eigenvalue of rounding: some ε for each of the terms that its
    /// entries are sums of. Silent where nothing is [massless](Self::massless).
    pub fn regular<const N: usize>(&mut self, samples: &[[[T; N]; N]]) {
        let Some(field) = self.massless() else { return };
        let negligible = 256.0 * N as f64 * Self::UNIT;
        self.each_lane(field, |lane| {
            let smallest = samples.iter().map(|matrix| match of_unit_diagonal(&in_lane(matrix, lane)) {
                Ok((smallest, _)) if smallest > negligible => smallest,
                _ => 0.0,
            });
            let best = smallest.fold(0.0, f64::max);
            (best == 0.0).then_some((best, Rule::RegularSum))
        });
    }

    /// The constants of a kernel: parameters that are fine one by one can overflow together, or underflow to a divisor
    /// of zero. Silent when any parameter is wrong already.
    pub fn constants(&mut self, field: &'static str, constants: &[T]) {
        if self.violations.as_slice().is_empty() {
            self.each_lane(field, |lane| {
                let values = constants.iter().map(|c| c.lane(lane));
                values.into_iter().find(|value| !value.is_finite()).map(|value| (value, Rule::OutOfRange))
            });
        }
    }

    /// The outcome.
    ///
    /// # Errors
    /// All violations at once, in the order of the checks.
    pub fn finish(&self) -> Result<(), ParameterError> {
        self.violations.into_result()
    }

    /// Whether the field has broken no rule yet and `values` are finite; reports the first that is not.
    fn finite_so_far(&mut self, field: &'static str, values: &[T]) -> bool {
        if self.has_violation(field) {
            return false;
        }
        for value in values {
            for lane in 0..T::LANES {
                if !value.lane(lane).is_finite() {
                    self.violations.push(Violation { field, value: value.lane(lane), rule: Rule::Finite });
                    return false;
                }
            }
        }
        true
    }

    /// As [`finite_so_far`](Self::finite_so_far), and symmetric up to rounding of the largest entry.
    fn symmetric_so_far<const N: usize>(
        &mut self,
        field: &'static str,
        matrix: &[[T; N]; N],
        rule: impl Fn(usize, usize) -> Rule,
    ) -> bool {
        for row in matrix {
            if !self.finite_so_far(field, row) {
                return false;
            }
        }
        self.each_lane(field, |lane| {
            let a = in_lane(matrix, lane);
            let largest = a.iter().flatten().fold(0.0_f64, |m, &e| m.max(e.abs()));
            for row in 0..N {
                for col in row + 1..N {
                    let difference = a[row][col] - a[col][row];
                    if difference.abs() > 8.0 * Self::UNIT * largest {
                        return Some((difference, rule(row, col)));
                    }
                }
            }
            None
        });
        !self.has_violation(field)
    }

    /// Reports the first lane for which `check` finds a value that breaks a rule.
    fn each_lane(&mut self, field: &'static str, check: impl Fn(usize) -> Option<(f64, Rule)>) {
        if let Some((value, rule)) = (0..T::LANES).find_map(check) {
            self.violations.push(Violation { field, value, rule });
        }
    }

    fn has_violation(&self, field: &str) -> bool {
        self.violations.as_slice().iter().any(|violation| violation.field == field)
    }
}

/// The value parts of one lane.
pub(super) fn in_lane<T: Real, const N: usize>(matrix: &[[T; N]; N], lane: usize) -> [[f64; N]; N] {
    matrix.map(|row| row.map(|entry| entry.lane(lane)))
}

fn trace(tensor: &[[f64; 3]; 3]) -> f64 {
    tensor[0][0] + tensor[1][1] + tensor[2][2]
}

/// The smallest, the largest, and where the largest is.
fn extremes<const N: usize>(values: &[f64; N]) -> (f64, f64, usize) {
    let mut found = (f64::INFINITY, f64::NEG_INFINITY, 0);
    for (i, &value) in values.iter().enumerate() {
        found.0 = found.0.min(value);
        if value > found.1 {
            (found.1, found.2) = (value, i);
        }
    }
    found
}

/// The smallest and the largest eigenvalue of a matrix whose rows have different units, scaled to a unit diagonal; or
/// the entry on its diagonal that is not positive.
fn of_unit_diagonal<const N: usize>(a: &[[f64; N]; N]) -> Result<(f64, f64), f64> {
    let positive = |value: f64| value > 0.0;
    if let Some(i) = (0..N).find(|&i| !positive(a[i][i])) {
        return Err(a[i][i]);
    }
    let scale: [f64; N] = core::array::from_fn(|i| 1.0 / Real::sqrt(a[i][i]));
    let unit =
        core::array::from_fn(|i| core::array::from_fn(|j| if i == j { 1.0 } else { (a[i][j] * scale[i]) * scale[j] }));
    let (smallest, largest, _) = extremes(&eigenvalues::<N>(&unit));
    Ok((smallest, largest))
}

/// `I_O − m(|c|² 1 − c cᵀ)`, and |c|².
fn about_center_of_mass(about_o: &[[f64; 3]; 3], mass: f64, c: [f64; 3]) -> ([[f64; 3]; 3], f64) {
    let square: f64 = c.iter().map(|c| c * c).sum();
    let central = core::array::from_fn(|i| {
        core::array::from_fn(|j| {
            let steiner = if i == j { square - c[i] * c[i] } else { -(c[i] * c[j]) };
            about_o[i][j] - mass * steiner
        })
    });
    (central, square)
}

/// Squares of finite numbers can overflow.
fn out_of_range(tensor: &[[f64; 3]; 3]) -> Option<(f64, Rule)> {
    let value = tensor.iter().flatten().find(|entry| !f64::is_finite(**entry));
    value.map(|&value| (value, Rule::OutOfRange))
}

/// Thresholds by which principal moments are judged.
struct Moments {
    /// Bound of the smallest moment below zero, exclusively.
    rounding: f64,
    /// Bound of the excess of the largest over the sum of the others.
    slack: f64,
    about_center_of_mass: bool,
    /// The triangle inequality is waived.
    formal: bool,
}

impl Moments {
    fn broken_rule(&self, tensor: &[[f64; 3]; 3]) -> Option<(f64, Rule)> {
        let Self { rounding, slack, about_center_of_mass, formal } = *self;
        let moments = eigenvalues(tensor);
        let (smallest, largest, axis) = extremes(&moments);
        if smallest <= -rounding {
            let rule =
                if about_center_of_mass { Rule::InertiaAboutCenterOfMass } else { Rule::PositiveDefiniteInertia };
            return Some((smallest, rule));
        }
        let sum = moments.iter().sum::<f64>() - largest;
        let excess = largest - sum;
        let broken = !formal && excess > slack;
        broken.then_some((largest, Rule::TriangleInequality { axis, sum, excess, about_center_of_mass }))
    }
}

#[cfg(test)]
#[path = "check_tests.rs"]
mod tests;
