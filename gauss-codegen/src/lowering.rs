//! From formulas to programs, with what only the programs show to be a mistake.

use std::fmt::Display;

use crate::accuracy::{Deciding, Names, States, Trial};
use crate::algebra::{Expr, Graph, Rational};
use crate::formulation::Formulation;
use crate::kernel::{Aim, Candidates, Derivatives, Kernel, Literals};
use crate::mechanics::{Formula, Method};
use crate::mistakes::{failed, refuse_regressor, refuse_series, refuse_too_much, refuse_unknown_derivatives};
use crate::model::{Model, Scalar};
use crate::translate::Translator;

/// The programs of all formulas and of the derivatives that are wanted.
///
/// # Errors
/// More code than is wanted, masses that are something else besides, motions without a power series; mistakes of this crate.
pub fn lower<'g>(
    graph: &'g Graph,
    model: &Model,
    translator: &Translator<'_, 'g>,
    formulation: &Formulation<'g>,
) -> syn::Result<Kernel<'g>> {
    let failed = |what: &dyn Display| failed(model, translator, &formulation.system, &what);
    let undefined = || failed(&"the equations divide by zero");
    if graph.is_undefined() {
        return Err(undefined());
    }
    let Formulation { formulas, linearization, regressor, .. } = formulation;
    let functions: Vec<_> = formulas.iter().map(candidates).collect();
    let parameters: Vec<Expr<'g>> = formulation.parameters.iter().map(|parameter| parameter.symbol).collect();
    let by_parameters = linearization.as_ref().filter(|_| model.wanted.by_parameters);
    let by_parameters = by_parameters
        .map(|linearization| linearization.by_parameters(formulas, &parameters, &formulation.derived_by_parameters));
    let wanted = Derivatives {
        by_state: linearization.as_ref().map(|l| &l.differentiated),
        inverse: formulation.inverse.as_ref().map(|inverse| &inverse.differentiated),
        units: if linearization.is_some() { &formulation.units } else { &[] },
        by_parameters,
        hessian: formulation.hessian.as_ref().map(|hessian| &hessian.curved),
        regressor: regressor.as_ref().map(|r| &r.differentiated),
    };
    let literals = translator.literals();
    let known = foldable(&model.scalar, &literals);
    let states = states(&literals, formulation);
    let samples = states.samples();
    let joined = joined(formulas);
    let lowered = |deciding: &[Deciding]| {
        let mut trial = Trial::new(samples.points()).with(deciding);
        let definitions = &formulation.definitions;
        let kernel = Kernel::lower(graph, &functions, &joined, definitions, &wanted, known, &mut trial)
            .map_err(|error| failed(&error))?;
        if graph.is_undefined() {
            return Err(undefined());
        }
        refuse_unknown_derivatives(model, &kernel)?;
        refuse_too_much(model, &kernel)?;
        translator.refuse_lost(&kernel)?;
        refuse_regressor(model.wanted.regressor.as_ref(), regressor.as_ref(), &kernel)?;
        refuse_series(model.wanted.taylor.as_ref(), !model.inputs.is_empty(), formulas, &kernel)?;
        Ok(kernel)
    };
    let mut kernel = lowered(&[])?;
    let momentum = formulas.iter().position(|formula| formula.method == Method::Momentum);
    let deciding = kernel.seek_losses(&samples, momentum, &functions);
    if !deciding.is_empty() {
        kernel = lowered(&deciding)?;
        kernel.seek_losses(&samples, momentum, &[]);
    }
    Ok(kernel)
}

/// What states are made from at which the programs are tried.
pub fn states<'a, 'g>(literals: &[(Rational, Expr<'g>)], formulation: &'a Formulation<'g>) -> States<'a, 'g> {
    let Formulation { system, formulas, definitions, units, .. } = formulation;
    let momentum = formulas.iter().find(|formula| formula.method == Method::Momentum);
    let parameters = formulation.parameters.iter();
    States {
        system,
        momentum: momentum.map_or(&[], |formula| &formula.arrangements[0]),
        parameters: parameters.map(|parameter| (parameter.symbol, parameter.name.contains('['))).collect(),
        literals: literals.to_vec(),
        units,
        weights: formulation.hessian.as_ref().map_or(&[], |hessian| &hessian.weights),
        definitions,
        names: Names::default(),
    }
}

/// Literals that are numbers when the code is generated: of a generic scalar it is not known how it rounds them.
fn foldable<'a, 'g>(scalar: &Scalar, literals: &'a [(Rational, Expr<'g>)]) -> Literals<'a, 'g> {
    (!matches!(scalar, Scalar::Parameter(_))).then_some(literals)
}

/// What `evaluate` computes together.
fn joined(formulas: &[Formula<'_>]) -> Vec<usize> {
    let of = |method: &Method| formulas.iter().position(|formula| formula.method == *method);
    Method::EVALUATED.iter().filter_map(of).collect()
}

/// What a formula is lowered from.
fn candidates<'g>(formula: &Formula<'g>) -> Candidates<'g> {
    let aim = if formula.method == Method::ComponentRates { Aim::Series } else { Aim::Values };
    Candidates { arrangements: formula.arrangements.clone(), aim }
}
