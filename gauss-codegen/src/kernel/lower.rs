//! The functions of a kernel, lowered together: shared constants, of each the arrangement that is taken.

use crate::accuracy::{Deciding, Found, Loss, Samples, Sought, Trial};
use crate::algebra::{Expr, Graph, Map, Rational};

use super::check::{Checked, Miscompiled, Sample};
use super::choice::{Candidates, Taken};
use super::columns::LoweredColumns;
use super::constants::{Constants, Hoisted, Source};
use super::derivatives::{Differentiated, Expected, Kept};
use super::hessian::Curved;
use super::hoist::Hoister;
use super::parametric::ByParameters;
use super::write::Program;

/// Programs of a set of functions that share their constants.
pub struct Kernel<'g> {
    /// Computes the constants from the parameters; its outputs are the constants in order.
    pub constants: Program<'g>,
    /// One program a function, in the order given; the symbols of constants among their inputs are listed below.
    pub functions: Vec<Program<'g>>,
    /// What each of them loses at sample states.
    pub losses: Vec<Loss>,
    /// The outputs of several functions, one after the other, what they have in common computed once.
    pub joined: Program<'g>,
    /// The outputs of what is differentiated, then all their derivatives along the first direction, and so on.
    pub tangents: Option<Program<'g>>,
    /// The same where the columns of derivatives are the solutions of one linear system: what is written then.
    pub columns: Option<LoweredColumns<'g>>,
    /// The derivatives of the same outputs by the first parameter, and so on.
    pub by_parameters: Option<Program<'g>>,
    /// The outputs of inverse dynamics, then all their derivatives along the first direction, and so on.
    pub inverse: Option<Program<'g>>,
    /// The coefficients of the first parameter in outputs that are affine in them, and so on.
    pub regressor: Option<Program<'g>>,
    /// The second derivatives of one number, along i and j up to i.
    pub hessian: Option<Program<'g>>,
    /// The constants as symbols, in the order of the outputs of `constants`.
    pub constant_symbols: Vec<Expr<'g>>,
    /// Constants that literal numbers alone determine, with their values.
    pub known_constants: Vec<(Expr<'g>, f64)>,
    /// What is said of the losses of functions, of `joined` and of the derivatives that are there.
    pub found: Found,
    /// The definitions of known constants.
    pub folded: Vec<(Expr<'g>, Expr<'g>)>,
}

/// What is differentiated beside the functions of a kernel.
#[derive(Default)]
pub struct Derivatives<'a, 'g> {
    /// Outputs that are wanted together with their derivatives.
    pub by_state: Option<&'a Differentiated<'g>>,
    /// Symbols that are the components of one unit vector or quaternion, and so on: equations are solved for the
    /// accelerations with the help of that, so points at which derivatives are checked must have it, too.
    pub units: &'a [Vec<Expr<'g>>],
    /// Velocities and accelerations by the parameters.
    pub by_parameters: Option<ByParameters<'a, 'g>>,
    /// Inverse dynamics together with its derivatives.
    pub inverse: Option<&'a Differentiated<'g>>,
    /// Outputs that are affine in the symbols of their directions: their coefficients.
    pub regressor: Option<&'a Differentiated<'g>>,
    /// A number whose second derivatives are wanted.
    pub hessian: Option<&'a Curved<'g>>,
}

/// Symbols that stand for literal numbers. Where the scalar is not known before run time, there is no value to fold.
pub type Literals<'a, 'g> = Option<&'a [(Rational, Expr<'g>)]>;

impl<'g> Kernel<'g> {
    /// Lowers functions, each of which has an arrangement; those that are `joined` also together. `definitions` are symbols that stand
    /// for expressions of the arguments. Every program is then run at a pseudo-random point and compared with its expressions.
    pub fn lower<'a>(
        graph: &'g Graph,
        functions: &[Candidates<'g>],
        joined: &[usize],
        definitions: &Map<u32, Expr<'g>>,
        wanted: &Derivatives<'a, 'g>,
        literals: Literals<'_, 'g>,
        trial: &mut Trial,
    ) -> Result<Self, Miscompiled> {
        let mut hoister = Hoister::new(graph, definitions);
        let functions = taken_of_each(functions, &mut hoister, trial);
        let joined: Vec<&Taken<'g>> = joined.iter().map(|&k| &functions[k]).collect();
        let (joined, of_joined) = lower_together(&mut hoister, &joined);
        let (mut programs, mut carried_out, mut losses) = (Vec::new(), Vec::new(), Vec::new());
        let mut outputs = Vec::new();
        for function in functions {
            outputs.push(function.outputs);
            programs.push(function.program);
            carried_out.push(function.carried_out);
            losses.push(function.loss);
        }
        let chosen: Vec<&[Expr<'g>]> = outputs.iter().map(Vec::as_slice).collect();
        let mut differentiated = |wanted: Option<&'a Differentiated<'g>>, kept: Kept| {
            let (lowered, columns) = wanted.map(|wanted| wanted.lower(&mut hoister, kept, trial)).unzip();
            let (program, expected) = lowered.unzip();
            (program, expected, columns.flatten())
        };
        let (tangents, expected_tangents, columns) = differentiated(wanted.by_state, Kept::ValuesToo);
        let (inverse, expected_inverse, _) = differentiated(wanted.inverse, Kept::ValuesToo);
        let (regressor, expected_regressor, _) = differentiated(wanted.regressor, Kept::DerivativesAlone);
        let hessian = wanted.hessian.map(|wanted| wanted.lower(&mut hoister, trial));
        let in_columns = columns.as_ref().map(|columns| &columns.program);
        let derived = tangents.iter().chain(in_columns).chain(&inverse).chain(&regressor).chain(&hessian);
        let read: Vec<Expr<'g>> = programs.iter().chain([&joined]).chain(derived).flat_map(Program::symbols).collect();
        let numbers: Map<u32, f64> =
            literals.into_iter().flatten().map(|(value, symbol)| (symbol.key(), value.to_f64())).collect();
        let source = Source { read: &read, literals: literals.map(|_| &numbers) };
        let lowered =
            wanted.by_parameters.map(|by| by.lower(graph, (&programs, &chosen), &source, &mut hoister, trial));
        let (by_parameters, hoisted) = lowered.unzip();
        let (by_parameters, expected_by_parameters) = by_parameters.unzip();
        let hoisted = hoisted.unwrap_or_else(|| source.hoisted(&hoister, &[]));
        let Hoisted { constants: Constants { program, symbols: constant_symbols }, known: known_constants, folded } =
            hoisted;
        let kernel = Self {
            constants: program,
            functions: carried_out,
            losses,
            joined,
            tangents,
            columns,
            by_parameters,
            inverse,
            regressor,
            hessian,
            constant_symbols,
            known_constants,
            found: Found::default(),
            folded,
        };
        let outputs = chosen.into_iter().chain([of_joined.as_slice()]).map(Expected::of);
        let expected_hessian = wanted.hessian.map(Expected::of_second);
        let derived =
            [expected_tangents, expected_by_parameters, expected_inverse, expected_regressor, expected_hessian];
        let sample = Sample { definitions, units: wanted.units, literals: &numbers, folded: &kernel.folded };
        kernel.checked(outputs, derived).check(graph, &sample)?;
        Ok(kernel)
    }

    /// With what the functions, then those joined, and the derivatives should compute.
    pub(super) fn checked<'a>(
        &'a self,
        functions: impl Iterator<Item = Expected<'a, 'g>>,
        derivatives: impl IntoIterator<Item = Option<Expected<'a, 'g>>>,
    ) -> Checked<'a, 'g> {
        let derivatives = self.derivatives().zip(derivatives);
        Checked {
            constants: &self.constants,
            constant_symbols: &self.constant_symbols,
            functions: self.functions.iter().chain([&self.joined]).zip(functions).collect(),
            columns: self.columns.as_ref(),
            derivatives: derivatives.filter_map(|(program, expected)| program.zip(expected)).collect(),
        }
    }

    /// Of the derivatives what is written.
    pub fn derivatives_as_written(&self) -> impl Iterator<Item = &Program<'g>> {
        let tangents = self.columns.as_ref().map(|columns| &columns.program).or(self.tangents.as_ref());
        tangents.into_iter().chain(self.derivatives().skip(1).flatten())
    }

    /// Looks for the states where the functions lose most, and tries what is written besides there: `joined` and the
    /// derivatives. Gives those states where another form of a function, if others are given, loses much less.
    pub fn seek_losses(
        &mut self,
        samples: &Samples<'_, '_, 'g>,
        momentum: Option<usize>,
        functions: &[Candidates<'g>],
    ) -> Vec<Deciding> {
        let forms = |k: usize| {
            functions.get(k).map_or(Vec::new(), |candidates| candidates.forms(self.functions[k].instructions.len()))
        };
        let (found, deciding) = samples.seek(&self.sought(momentum), &forms);
        self.found = found;
        deciding
    }

    /// What is sought.
    pub fn sought(&self, momentum: Option<usize>) -> Sought<'_, 'g> {
        Sought {
            constants: &self.constants,
            symbols: &self.constant_symbols,
            folded: &self.folded,
            functions: &self.functions,
            measured: &self.losses,
            momentum,
            besides: std::iter::once(&self.joined).chain(self.derivatives().flatten()).collect(),
        }
    }

    /// The programs of derivatives, in the order in which their values are expected.
    pub fn derivatives(&self) -> impl Iterator<Item = Option<&Program<'g>>> {
        [&self.tangents, &self.by_parameters, &self.inverse, &self.regressor, &self.hessian]
            .into_iter()
            .map(Option::as_ref)
    }
}

/// Of each function the arrangement that is taken.
fn taken_of_each<'g>(functions: &[Candidates<'g>], hoister: &mut Hoister<'_, 'g>, trial: &mut Trial) -> Vec<Taken<'g>> {
    let taken = functions.iter().enumerate().map(|(k, candidates)| {
        trial.begin(Some(k));
        candidates.taken(hoister, trial)
    });
    let taken = taken.collect();
    trial.begin(None);
    taken
}

/// Several functions in one program, of each what was taken and what comes first where that keeps the digits. What wins alone may have less in
/// common with the rest than what comes first: it is replaced where that costs less.
fn lower_together<'g>(hoister: &mut Hoister<'_, 'g>, functions: &[&Taken<'g>]) -> (Program<'g>, Vec<Expr<'g>>) {
    let mut lower = |parts: &[&[Expr<'g>]]| {
        let outputs = parts.concat();
        (Program::lower(&hoister.hoist(&outputs)), outputs)
    };
    let mut parts: Vec<&[Expr<'g>]> = functions.iter().map(|function| function.outputs.as_slice()).collect();
    let mut best = lower(&parts);
    for (place, function) in functions.iter().enumerate() {
        let Some(first) = function.first.as_deref().filter(|first| *first != parts[place]) else { continue };
        let won = std::mem::replace(&mut parts[place], first);
        let other = lower(&parts);
        if other.0.cost().total() < best.0.cost().total() {
            best = other;
        } else {
            parts[place] = won;
        }
    }
    let fused = best.0.with_signs_led_back().with_products_in_sums();
    let keep_their_digits = functions.iter().all(|function| function.begun);
    (if keep_their_digits { fused.with_sums_begun() } else { fused }.ordered(), best.1)
}
