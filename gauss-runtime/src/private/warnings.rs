//! Warnings about parameters that are likely not meant, although a kernel can be made of them.

use core::marker::PhantomData;

use super::check::{ParameterCheck, in_lane};
use super::eigenvalues::negative_eigenvalue;
use crate::error::{BoundedList, DragKind, Finding, ParameterWarning, ParameterWarnings};
use crate::real::Real;

/// Collects findings about parameters. For packs of numbers every lane is looked at; the first lane with a finding
/// speaks for the others.
pub struct WarningCheck<T> {
    warnings: BoundedList<ParameterWarning>,
    scalar: PhantomData<T>,
}

impl<T: Real> Default for WarningCheck<T> {
    fn default() -> Self {
        Self::new()
    }
}

impl<T: Real> WarningCheck<T> {
    /// No finding so far.
    #[inline(always)]
    #[must_use]
    pub fn new() -> Self {
        Self { warnings: BoundedList::<ParameterWarning>::new(), scalar: PhantomData }
    }

    /// A matrix of drag in the order (u, ω), written as `field`: its symmetric part must not have a negative
    /// eigenvalue.
    ///
    /// Silent where an entry is not finite: the kernel is refused then.
    pub fn drag(&mut self, field: &'static str, kind: DragKind, matrix: &[[T; 6]; 6]) {
        self.eigenvalue(field, matrix, Finding::DragFeedsEnergy { kind });
    }

    /// The damping coefficient of a spring or a stop.
    pub fn damping(&mut self, field: &'static str, coefficient: T) {
        self.negative(field, &[coefficient], Finding::DampingFeedsEnergy);
    }

    /// The damping matrix of a bushing or of modes, symmetric: no eigenvalue is negative.
    pub fn damping_matrix<const N: usize>(&mut self, field: &'static str, matrix: &[[T; N]; N]) {
        self.eigenvalue(field, matrix, Finding::BushingFeedsEnergy);
    }

    /// A dissipation function in a few states of general position: in one of them it is not negative.
    pub fn dissipation(&mut self, field: &'static str, values: &[T]) {
        let negative = |value: &T| (0..T::LANES).all(|lane| value.lane(lane) < 0.0);
        if values.iter().all(negative) {
            self.negative(field, values, Finding::DampingFeedsEnergy);
        }
    }

    /// A gravity of one number.
    pub fn gravity(&mut self, field: &'static str, value: T) {
        self.negative(field, &[value], Finding::GravityUpward);
    }

    /// The gravitational parameter of a centre.
    pub fn center(&mut self, field: &'static str, mu: T) {
        self.negative(field, &[mu], Finding::CenterRepels);
    }

    /// The diagonal of an added mass.
    pub fn added_mass(&mut self, field: &'static str, diagonal: &[T; 6]) {
        self.negative(field, diagonal, Finding::AddedMassOfDerivatives);
    }

    /// The first value that is negative. What is not a number is refused elsewhere.
    fn negative(&mut self, field: &'static str, values: &[T], finding: Finding) {
        let lanes = values.iter().flat_map(|value| (0..T::LANES).map(|lane| value.lane(lane)));
        if let Some(value) = lanes.into_iter().find(|value| *value < 0.0) {
            self.warnings.push(ParameterWarning { field, value, finding });
        }
    }

    /// The smallest eigenvalue of the symmetric part, in the first lane where it is negative.
    fn eigenvalue<const N: usize>(&mut self, field: &'static str, matrix: &[[T; N]; N], finding: Finding) {
        let found =
            (0..T::LANES).find_map(|lane| negative_eigenvalue(&in_lane(matrix, lane), ParameterCheck::<T>::UNIT));
        if let Some(value) = found {
            self.warnings.push(ParameterWarning { field, value, finding });
        }
    }

    /// All findings, in the order of the checks.
    #[must_use]
    pub fn finish(self) -> ParameterWarnings {
        ParameterWarnings { list: self.warnings }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simd::Lanes;
    use std::string::ToString;

    fn diagonal(entries: [f64; 6]) -> [[f64; 6]; 6] {
        core::array::from_fn(|i| core::array::from_fn(|j| if i == j { entries[i] } else { 0.0 }))
    }

    fn found(matrix: &[[f64; 6]; 6]) -> Option<f64> {
        let mut check = WarningCheck::<f64>::new();
        check.drag("d", DragKind::Linear, matrix);
        check.finish().as_slice().first().map(|warning| warning.value)
    }

    #[test]
    fn drag_that_takes_energy_passes() {
        assert_eq!(found(&diagonal([1.0, 2.0, 0.0, 1e-12, 0.0, 1e9])), None);
        assert_eq!(found(&[[0.0; 6]; 6]), None);
        // The skew part does no work, however large it is.
        let mut skew = diagonal([1.0; 6]);
        (skew[0][4], skew[4][0]) = (1e3, -1e3);
        assert_eq!(found(&skew), None);
        // Singular: drag on two directions only, with entries that are not binary fractions.
        let (a, b) = ([0.1, 0.7, -0.3, 1.1, 0.0, 0.2], [-0.9, 0.3, 0.1, 0.0, 0.6, 1.3]);
        let singular = core::array::from_fn(|i| core::array::from_fn(|j| a[i] * a[j] + b[i] * b[j]));
        assert_eq!(found(&singular), None);
        // What is not finite is refused by the kernel.
        assert_eq!(found(&diagonal([f64::NAN, -1.0, 0.0, 0.0, 0.0, 0.0])), None);
    }

    #[test]
    fn drag_that_feeds_energy_is_found_in_any_units() {
        assert_eq!(found(&diagonal([1.0, 1.0, 1.0, 1.0, 1.0, -0.3])), Some(-0.3));
        // Tiny beside the others: no rounding explains it.
        assert_eq!(found(&diagonal([1e9, 1.0, 1.0, 1.0, -1e-12, 1.0])), Some(-1e-12));
        // Sway and yaw: the eigenvalues of [[1, 2], [2, 1]] are −1 and 3.
        let mut coupled = diagonal([1.0; 6]);
        (coupled[1][5], coupled[5][1]) = (3.0, 1.0);
        let value = found(&coupled).expect("found");
        assert!((value + 1.0).abs() < 1e-15, "{value}");
        // The same in other units of length, of mass and of time.
        for length in [1e-9, 1e-3, 1e6] {
            let unit = |i: usize| if i < 3 { 1.0 } else { length };
            let scaled = core::array::from_fn(|i| core::array::from_fn(|j| 1e-7 * coupled[i][j] * unit(i) * unit(j)));
            assert!(found(&scaled).is_some_and(|value| value < 0.0), "{length}");
        }
        // Drag on yaw that comes from sway alone, and however little.
        let mut lone = diagonal([1.0, 1.0, 1.0, 0.0, 0.0, 0.0]);
        lone[5][1] = 1e-9;
        assert!(found(&lone).is_some_and(|value| value < 0.0));
    }

    #[test]
    fn an_eigenvalue_just_below_zero_is_told_from_rounding() {
        // [[1, c], [c, 1]] has 1 − c.
        let with = |c: f64| {
            let mut matrix = diagonal([1.0; 6]);
            (matrix[0][1], matrix[1][0]) = (c, c);
            matrix
        };
        assert_eq!(found(&with(1.0 + 4.0 * f64::EPSILON)), None);
        let value = found(&with(1.0 + 1e-12)).expect("found");
        assert!((value + 1e-12).abs() < 1e-15, "{value}");
    }

    #[test]
    fn findings_are_listed_and_say_what_to_do() {
        let mut check = WarningCheck::<f64>::new();
        assert!(check.warnings.as_slice().is_empty());
        check.drag("d", DragKind::Linear, &diagonal([1.0, 1.0, 1.0, 1.0, 1.0, -0.3]));
        check.drag("fine", DragKind::Linear, &diagonal([1.0; 6]));
        check.drag("e", DragKind::Quadratic, &diagonal([-2.0, 1.0, 1.0, 1.0, 1.0, 1.0]));
        let warnings = check.finish();
        assert!(!warnings.is_empty());
        assert_eq!(
            warnings.to_string(),
            "`linear` drag feeds energy: the symmetric part of `d` has the eigenvalue -0.3, and drag is −`d`·(u, ω); check its \
             signs\n\
             `quadratic` drag feeds energy: velocities with components V_j of equal size meet it as linear drag, and the \
             symmetric part of `e` has the eigenvalue -2; drag is −Σ_j `e`_ij |V_j| V_j; check its signs"
        );
        assert_eq!(warnings.iter().count(), 2);
        let none = WarningCheck::<f64>::new().finish();
        assert!(none.is_empty() && none.to_string().is_empty());
    }

    #[test]
    fn damping_of_a_bushing_that_feeds_energy_is_found() {
        // A negative coefficient, and a coupling larger than both coefficients: [[1, 2], [2, 1]] has −1 and 3.
        let mut coupled = diagonal([1.0; 6]);
        (coupled[0][1], coupled[1][0]) = (2.0, 2.0);
        for matrix in [diagonal([1.0, 1.0, -1.0, 1.0, 1.0, 1.0]), coupled] {
            let mut check = WarningCheck::<f64>::new();
            check.damping_matrix("c", &matrix);
            check.damping_matrix("fine", &diagonal([0.0, 1.0, 2.0, 0.0, 1.0, 1e9]));
            let warnings = check.finish();
            assert_eq!(warnings.as_slice().len(), 1);
            let ParameterWarning { field, value, finding } = warnings.as_slice()[0];
            assert_eq!((field, finding), ("c", Finding::BushingFeedsEnergy));
            // Some roundings of eigenvalues up to 3.
            assert!((value + 1.0).abs() < 16.0 * f64::EPSILON, "{value}");
        }
    }

    #[test]
    fn every_lane_counts() {
        let mut check = WarningCheck::new();
        let matrix = diagonal([1.0; 6]).map(|row| row.map(|entry| Lanes([entry, -entry])));
        check.drag("d", DragKind::Linear, &matrix);
        assert_eq!(check.finish().as_slice()[0].value, -1.0);
    }
}
