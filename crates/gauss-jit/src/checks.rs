//! The checks of parameters by `kernel()` at run time: the same rules by the same functions of the runtime.

use gauss_codegen::parameters::{Check, Given, Parameters, Rule, Warning, WarningRule};
use gauss_runtime::__private_0_1_0::{DragKind, ParameterCheck, WarningCheck};
use gauss_runtime::error::{ParameterError, ParameterWarnings};

use crate::error::KernelError;
use crate::names::kept;

/// The most rows of a matrix that is checked.
pub const MOST_ROWS: usize = 32;

/// Rows of a square matrix of N rows.
fn rows<const N: usize>(values: &[f64]) -> [[f64; N]; N] {
    std::array::from_fn(|i| std::array::from_fn(|j| values[N * i + j]))
}

/// Calls a function with a matrix whose size is known at run time.
macro_rules! square {
    ($values:expr, |$matrix:ident| $call:expr, [$($n:literal)+]) => {
        match $values.len().isqrt() {
            0 => {}
            $($n => { let $matrix = &rows::<$n>($values); $call; })+
            rows => return Err(KernelError::TooLarge { rows, most: MOST_ROWS }),
        }
    };
    ($values:expr, |$matrix:ident| $call:expr) => {
        square!($values, |$matrix| $call, [1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20 21 22 23 24 25 26 27 28 29
            30 31 32])
    };
}

/// The number that a rule is about.
fn value(given: &Given, numbers: &[f64], computed: &[f64]) -> f64 {
    match *given {
        Given::Number(k) => numbers[k],
        Given::Computed(k) => computed[k],
        Given::Zero => 0.0,
    }
}

/// Findings about numbers that are likely not meant.
///
/// # Errors
/// A matrix with too many rows.
pub fn warnings(parameters: &Parameters, numbers: &[f64], computed: &[f64]) -> Result<ParameterWarnings, KernelError> {
    let mut check = WarningCheck::<f64>::new();
    for Warning { label, rule, values, .. } in &parameters.warnings {
        let values: Vec<f64> = values.iter().map(|given| value(given, numbers, computed)).collect();
        let (label, values) = (kept(label), &values[..]);
        match rule {
            WarningRule::Drag { quadratic: true } => check.drag(label, DragKind::Quadratic, &rows(values)),
            WarningRule::Drag { quadratic: false } => check.drag(label, DragKind::Linear, &rows(values)),
            WarningRule::Damping => check.damping(label, values[0]),
            WarningRule::DampingMatrix => square!(values, |matrix| check.damping_matrix(label, matrix)),
            WarningRule::Dissipation => check.dissipation(label, values),
            WarningRule::Gravity => check.gravity(label, values[0]),
            WarningRule::Center => check.center(label, values[0]),
            WarningRule::AddedMass => check.added_mass(label, &std::array::from_fn(|i| values[i])),
        }
    }
    Ok(check.finish())
}

/// The state of the checks of one set of numbers.
pub struct Checks<'a> {
    parameters: &'a Parameters,
    check: ParameterCheck<f64>,
}

impl<'a> Checks<'a> {
    /// Every rule about the numbers of the parameters and what is `computed` from them.
    ///
    /// # Errors
    /// All rules that are broken.
    pub fn of(parameters: &'a Parameters, numbers: &[f64], computed: &[f64]) -> Result<Self, KernelError> {
        let mut checks = Self { parameters, check: ParameterCheck::new() };
        for law in &parameters.checks {
            let values: Vec<f64> = law.values.iter().map(|given| value(given, numbers, computed)).collect();
            checks.law(law, &values)?;
        }
        checks.check.finish()?;
        Ok(checks)
    }

    fn law(&mut self, law: &Check, values: &[f64]) -> Result<(), KernelError> {
        let (check, label) = (&mut self.check, kept(&law.label));
        let triple = |first: usize| std::array::from_fn(|i| values[first + i]);
        check.waive_triangle_inequality(law.is_formal);
        match law.rule {
            Rule::Finite => check.finite(label, values),
            Rule::Mass => check.mass(label, values[0]),
            Rule::MassInSum => check.mass_in_sum(label, values[0]),
            Rule::NonNegative => check.non_negative(label, values[0]),
            Rule::Symmetric => check.symmetric(label, &rows(values)),
            Rule::Inertia => check.inertia(label, &rows(values)),
            Rule::CentralInertia => check.central_inertia(label, values[0], triple(1), &rows(&values[4..])),
            Rule::InertiaAboutAxis(axis) => {
                check.inertia_about_axis(label, axis, (values[0], triple(1)), &rows(&values[4..]));
            }
            Rule::InertiaInSum => check.inertia_in_sum(label, values[0], triple(1), &rows(&values[4..])),
            // Of one body among several it says nothing where others make up for what it lacks.
            Rule::KineticMatrix if self.parameters.in_sum && check.massless().is_some() => {}
            Rule::KineticMatrix => square!(values, |matrix| check.kinetic_matrix(label, matrix), [1 2 3 4 5 6]),
            Rule::Stiffness => check.stiffness(label, values[0]),
            Rule::Width => check.width(label, values[0]),
            Rule::Limits => check.limits(label, [values[0], values[1]]),
            Rule::Armature => check.armature(label, values[0]),
            Rule::Length => check.positive_length(label, values[0]),
            Rule::Restitution => check.restitution(label, values[0]),
            Rule::Direction => check.direction(label, values[0]),
            Rule::StiffnessMatrix => square!(values, |matrix| check.stiffness_matrix(label, matrix)),
            Rule::DampingMatrix => square!(values, |matrix| check.damping_matrix(label, matrix)),
            Rule::Modes => square!(values, |matrix| check.modes(label, matrix)),
        }
        check.waive_triangle_inequality(false);
        Ok(())
    }

    /// Whether the mass matrix must be looked at: a body has no mass of its own.
    pub fn wants_mass_matrix(&self) -> bool {
        self.parameters.in_sum && self.check.massless().is_some()
    }

    /// Whether bodies without mass have a mass matrix all the same, at some of the configurations.
    ///
    /// # Errors
    /// [`KernelError::TooLarge`].
    pub fn mass_matrices(&mut self, matrices: &[Vec<f64>; 4]) -> Result<(), KernelError> {
        let size = matrices[0].len().isqrt();
        // A matrix with more rows that stand alone, with a diagonal of one, is regular where the first is.
        let class = [8, 16, 32, 64, 128].into_iter().find(|class| size <= *class);
        let class = class.ok_or(KernelError::TooLarge { rows: size, most: 128 })?;
        match class {
            8 => self.check.regular(&padded::<8>(matrices, size)),
            16 => self.check.regular(&padded::<16>(matrices, size)),
            32 => self.check.regular(&padded::<32>(matrices, size)),
            64 => self.check.regular(&padded::<64>(matrices, size)),
            _ => self.check.regular(&padded::<128>(matrices, size)),
        }
        Ok(())
    }

    /// Whether all constants are numbers.
    ///
    /// # Errors
    /// All rules that are broken.
    pub fn finish(mut self, constants: &[f64]) -> Result<(), ParameterError> {
        self.check.constants(kept(&self.parameters.label), constants);
        self.check.finish()
    }
}

fn padded<const N: usize>(matrices: &[Vec<f64>; 4], size: usize) -> [[[f64; N]; N]; 4] {
    let entry = |matrix: &[f64], i: usize, j: usize| match (i < size && j < size, i == j) {
        (true, _) => matrix[size * i + j],
        (false, same) => f64::from(u8::from(same)),
    };
    std::array::from_fn(|k| std::array::from_fn(|i| std::array::from_fn(|j| entry(&matrices[k], i, j))))
}
