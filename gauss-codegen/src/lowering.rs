//! From formulas to programs, with what only the programs show to be a mistake.

use std::fmt::Display;

use crate::accuracy::{DecidingState, States, SymbolNumbers, Trial};
use crate::algebra::{Expr, Rational};
use crate::error::Result;
use crate::formulation::Formulation;
use crate::kernel::{Aim, Candidates, Derivatives, Kernel, Literals, Passes};
use crate::mass_laws::MassLaws;
use crate::mechanics::{Arrangements, Method};
use crate::methods::DerivativeKind;
use crate::mistakes::{
    failed, refuse_lost, refuse_regressor, refuse_series, refuse_too_much, refuse_unknown_derivatives,
};
use crate::terms::Scalar;
use crate::translate::Provenance;

/// A system with its programs.
pub struct Lowered<'g> {
    pub formulation: Formulation<'g>,
    pub kernel: Kernel<'g>,
    pub mass_laws: MassLaws<'g>,
}

/// The programs of all formulas and of the derivatives that are wanted; where the accelerations lose much, from forms
/// with squares as well.
///
/// # Errors
/// More code than is wanted, masses that are something else besides, motions without a power series; mistakes of this
/// crate.
pub fn lower<'g>(mut formulation: Formulation<'g>, passes: Passes) -> Result<Lowered<'g>> {
    let mut kernel = programs(&formulation, passes)?;
    if !kernel.functions.acceleration.loss.is_tolerable() && formulation.with_squares()? {
        kernel = programs(&formulation, passes)?;
    }
    let mass_laws = MassLaws::new(&formulation.provenance, &formulation.system);
    Ok(Lowered { formulation, kernel, mass_laws })
}

/// The programs of all formulas and of the derivatives that are wanted.
///
/// # Errors
/// More code than is wanted, masses that are something else besides, motions without a power series; mistakes of this
/// crate.
fn programs<'g>(formulation: &Formulation<'g>, passes: Passes) -> Result<Kernel<'g>> {
    let Provenance { item, literals, .. } = &formulation.provenance;
    let graph = formulation.system.scene.graph;
    let failed = |what: &dyn Display| failed(&formulation.provenance, &formulation.system, &what);
    let undefined = || failed(&"the equations divide by zero");
    if graph.is_undefined() {
        return Err(undefined());
    }
    let Formulation { formulas, .. } = formulation;
    let functions = formulas.each_ref().map(candidates);
    let by_state = formulation.derivatives.iter().any(|derivative| derivative.kind == DerivativeKind::ByState);
    let units: &[Vec<Expr<'g>>] = if by_state { &formulation.units } else { &[] };
    let wanted = Derivatives { list: &formulation.derivatives, units };
    let known = foldable(&item.scalar, literals);
    let states = states(formulation);
    let samples = states.samples();
    let lowered = |deciding: &[DecidingState]| {
        let mut trial = Trial::new(samples.points()).with(deciding);
        let kernel = Kernel::lower(graph, &functions, &formulation.definitions, &wanted, known, &mut trial, passes)
            .map_err(|error| failed(&error))?;
        if graph.is_undefined() {
            return Err(undefined());
        }
        refuse_unknown_derivatives(&item.functions, &kernel)?;
        refuse_too_much(item, &kernel)?;
        refuse_lost(&formulation.provenance, &kernel)?;
        refuse_regressor(item.wanted.regressor.as_ref(), &formulation.inertial_parameters, &kernel)?;
        refuse_series(item.wanted.taylor.as_ref(), !item.inputs.is_empty(), &kernel)?;
        Ok(kernel)
    };
    let mut kernel = lowered(&[])?;
    let deciding = kernel.seek_losses(&samples, Some((&functions, &wanted)));
    if !deciding.is_empty() {
        kernel = lowered(&deciding)?;
        kernel.seek_losses(&samples, None);
    }
    Ok(kernel)
}

/// Symbols and formulas from which states are made at which the programs are tried.
pub fn states<'a, 'g>(formulation: &'a Formulation<'g>) -> States<'a, 'g> {
    let Formulation { provenance, system, formulas, definitions, units, .. } = formulation;
    let parameters = provenance.parameters.iter();
    let states = States {
        system,
        momentum: &formulas.momentum[0],
        parameters: parameters.map(|parameter| (parameter.symbol, parameter.name.contains('['))).collect(),
        literals: provenance.literals.clone(),
        units,
        weights: &formulation.weights,
        definitions,
        numbers: SymbolNumbers::default(),
    };
    states.numbered()
}

/// Literals that are numbers when the code is generated: of a generic scalar it is not known how it rounds them.
fn foldable<'a, 'g>(scalar: &Scalar, literals: &'a [(Rational, Expr<'g>)]) -> Literals<'a, 'g> {
    (!matches!(scalar, Scalar::Parameter(_))).then_some(literals)
}

/// Arrangements that a formula is lowered from, and the aim.
fn candidates<'g>(method: Method, arrangements: &Arrangements<'g>) -> Candidates<'g> {
    let aim = if method == Method::ComponentRates { Aim::Series } else { Aim::Values };
    Candidates { arrangements: arrangements.clone(), aim }
}
