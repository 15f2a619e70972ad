//! Mistakes in a system that only the derivation sees, each at the token that is wrong, with the remedy.

use std::fmt::Display;

use proc_macro2::{Ident, Span};

use crate::algebra::{Graph, Notation, Number, decimal};
use crate::error::{Error, Mistakes, Result};
use crate::kernel::Kernel;
use crate::mechanics::{
    Coordinate, Elimination, InertialParameter, Method, Obstacle, System, SystemFault, SystemScene, has_values,
};
use crate::methods::DerivativeKind;
use crate::program::{Instruction, Operand};
use crate::terms::{FunctionKind, Interpolation, Item, Scalar, Table, UserFunction};
use crate::translate::{ConstraintPlace, IndependentSpeeds, Provenance, SpannedName};

/// Operations up to which code is generated unless the user says otherwise: some seconds of the compiler's time.
const LIMIT: usize = 50_000;

/// Rates that are not affine in the speeds.
pub fn refuse_curved_kinematics(provenance: &Provenance<'_>, scene: &SystemScene<'_>) -> Result<()> {
    let mut mistakes = Mistakes::default();
    let mut curved: Vec<usize> =
        scene.rates_not_affine().into_iter().map(|k| Coordinate::of_component(&scene.coordinates, k)).collect();
    curved.dedup();
    for k in curved {
        // ψ of a chart is affine; the declared coordinates come after its own.
        let before = scene.coordinates.len() - provenance.rates.len();
        let SpannedName { text: coordinate, span } = &provenance.rates[k - before];
        mistakes.push(
            *span,
            format!(
                "the rate of `{coordinate}` is not affine in the speeds, so velocities would not be linear in them; \
                 choose speeds in which every rate is a sum of terms with one speed each"
            ),
        );
    }
    mistakes.finish()
}

/// Motions without a power series in time that can be written beforehand.
pub fn refuse_series(taylor: Option<&Ident>, has_inputs: bool, kernel: &Kernel<'_>) -> Result<()> {
    let Some(taylor) = taylor else { return Ok(()) };
    let mut mistakes = Mistakes::default();
    if has_inputs {
        mistakes.push(
            taylor.span(),
            "inputs arrive at run time, so the motion has no power series that is known beforehand; \
             write them as functions of `t` and of fields, or remove `taylor`"
                .into(),
        );
    }
    let rates = kernel.functions.get(Method::ComponentRates);
    if let Some(function) = rates.and_then(|rates| rates.program.function_without_series()) {
        mistakes.push(
            taylor.span(),
            format!(
                "`{function}`, or an element made of it, has no power series where it is not smooth; \
                 write a smooth law in its place, or remove `taylor`"
            ),
        );
    }
    mistakes.finish()
}

/// Speeds that nothing with mass moves with.
pub fn refuse_idle_speeds(provenance: &Provenance<'_>, system: &System<'_>) -> Result<()> {
    let mut mistakes = Mistakes::default();
    for k in system.idle_speeds() {
        let SpannedName { text: name, span } = &provenance.speeds[k];
        mistakes.push(
            *span,
            format!("no velocity depends on `{name}`: its row of the mass matrix is zero; give a mass to the bodies that it moves, or leave it out"),
        );
    }
    mistakes.finish()
}

/// Derivatives of functions of the user's own that no clause says.
pub fn refuse_unknown_derivatives(functions: &[UserFunction], kernel: &Kernel<'_>) -> Result<()> {
    let mut mistakes = Mistakes::default();
    for (index, clause) in functions.iter().enumerate() {
        let orders =
            kernel.written().flat_map(|program| &program.instructions).filter_map(|instruction| match instruction {
                Instruction::Own(own, _) if usize::from(own.index) == index => Some(own.order()),
                _ => None,
            });
        let (needed, known) = (orders.max().unwrap_or(0), clause.kind.derivatives());
        if needed <= known {
            continue;
        }
        let name = &clause.name;
        let word = ["derivative", "second", "third"].get(usize::from(known)).copied();
        let ordinal = ["value", "first", "second", "third"].get(usize::from(needed)).unwrap_or(&"fourth");
        let remedy = match (&clause.kind, word) {
            (FunctionKind::Rust(_), Some(word)) => format!("add `{word} = …` to `function({name}, …)`"),
            (FunctionKind::Table(Table { joined: Interpolation::Linear, .. }), _) => "write `kind = cubic`".to_owned(),
            _ => "write a force in the place of a potential, or a law that is differentiated less often".to_owned(),
        };
        mistakes.push(name.span(), format!("the equations need the {ordinal} derivative of `{name}`; {remedy}"));
    }
    mistakes.finish()
}

/// Operations that the code of a struct may have.
pub fn most_operations(item: &Item) -> usize {
    item.limit.unwrap_or(LIMIT)
}

/// Equations of more expressions than memory and patience are enough for.
pub fn refuse_exhausted(item: &Item, graph: &Graph) -> Result<()> {
    if !graph.is_exhausted() {
        return Ok(());
    }
    Err(Error::new(
        item.ident.span(),
        format!(
            "the equations are made of more expressions than {} operations can come of; model less: fewer bodies, shorter \
             expressions, coordinates relative to a parent; or write a larger `limit`",
            most_operations(item)
        ),
    ))
}

/// More code than the compiler should be given without being asked.
pub fn refuse_too_much(item: &Item, kernel: &Kernel<'_>) -> Result<()> {
    let operations = kernel.written().map(|program| program.instructions.len()).sum::<usize>();
    let limit = most_operations(item);
    if operations <= limit {
        return Ok(());
    }
    let rounded = operations.div_ceil(1000) * 1000;
    Err(Error::new(
        item.ident.span(),
        format!(
            "the generated code has {operations} operations, more than {limit}; write `limit = {rounded}` to have it all \
             the same, or model less: fewer bodies, or coordinates relative to a parent"
        ),
    ))
}

/// Masses in which the forces of inertia are not linear, because something else depends on them.
pub fn refuse_regressor(
    clause: Option<&Ident>,
    parameters: &[InertialParameter<'_>],
    kernel: &Kernel<'_>,
) -> Result<()> {
    let (Some(clause), Some(regressor)) = (clause, kernel.derivative(DerivativeKind::Regressor)) else {
        return Ok(());
    };
    let read = regressor.program.symbols();
    match parameters.iter().find(|parameter| read.contains(&parameter.symbol)) {
        Some(first) => Err(not_linear(clause, &first.name)),
        None => Ok(()),
    }
}

/// A mass that is something else besides.
pub fn not_linear(clause: &Ident, mass: &str) -> Error {
    Error::new(
        clause.span(),
        format!(
            "the forces of inertia are not linear in `{mass}`, because more than the mass of something depends on it; \
             give a field of its own to each, or remove `regressor`"
        ),
    )
}

/// Gaps that no motion changes; slips that are not affine in the speeds, or that no motion changes.
pub fn refuse_contacts(provenance: &Provenance<'_>, system: &System<'_>) -> Result<()> {
    let mut mistakes = Mistakes::default();
    let mut rows = system.contacts.jacobian.iter();
    for contact in &system.scene.contacts {
        let place = &provenance.contacts[contact.clause];
        let slips = if contact.rolls_on.is_some() { &place.rolls } else { &place.slips };
        let gap = place.gap.filter(|_| contact.gap.is_some());
        let spans = gap.into_iter().map(|gap| (gap, true)).chain(slips.iter().map(|slip| (*slip, false)));
        let count = usize::from(contact.gap.is_some()) + contact.slips.len();
        for ((span, of_gap), row) in spans.zip(rows.by_ref().take(count)) {
            let message = match (system.contacts.is_still(row), system.contacts.is_affine(row, &system.scene.speeds)) {
                (true, _) if of_gap => {
                    format!("no speed changes the gap of `{}`, so no force closes or opens it", contact.name)
                }
                (true, _) => format!("no speed changes this slip of `{}`; leave it out", contact.name),
                (_, false) => format!(
                    "this slip of `{}` is not affine in the speeds; write the component of a velocity along a tangent",
                    contact.name
                ),
                _ => continue,
            };
            mistakes.push(span, message);
        }
    }
    mistakes.finish()
}

/// Solves the constraints for the speeds that are not named.
pub fn eliminate<'g>(
    places: &[ConstraintPlace],
    whole: System<'g>,
    IndependentSpeeds { kept, span: named }: &IndependentSpeeds,
) -> Result<Elimination<'g>> {
    let clauses: Vec<Span> = whole.scene.constraints.iter().map(|c| places[c.clause].expression).collect();
    let (total, count, named) = (whole.scene.speeds.len(), clauses.len(), *named);
    Elimination::new(whole, kept).map_err(|obstacle| match obstacle {
        Obstacle::NotAffine(k) => Error::new(
            clauses[k],
            "this constraint is not affine in the speeds, so it cannot be solved for some of them when the code is written; \
             remove `independent` to have it kept with a multiplier",
        ),
        Obstacle::Count(wanted) => Error::new(
            named,
            format!(
                "{total} speeds and {count} scalar constraint{} leave {wanted} independent; `independent` names {}",
                if count == 1 { "" } else { "s" },
                kept.len()
            ),
        ),
        Obstacle::Undetermined => Error::new(
            named,
            "the constraints do not determine the other speeds: their matrix of partial derivatives is singular; name \
             other speeds, or remove a constraint that follows from the rest",
        ),
    })
}

/// Errors of the faults that the check of a system finds, each at the token that is wrong.
pub fn system_faults<'g>(provenance: &Provenance<'g>, system: &System<'g>, faults: &[SystemFault]) -> Error {
    let clause = |k: usize, text: &str| {
        let place = &provenance.constraints[system.scene.constraints[k].clause];
        (place.word, format!("{}{text}", place.in_file.as_deref().unwrap_or_default()))
    };
    let mut mistakes = Mistakes::default();
    for fault in faults {
        match fault {
            SystemFault::Disagreement(error) => return failed(provenance, system, error),
            SystemFault::DependentSpeed(k) => {
                let SpannedName { text: name, span } = &provenance.speeds[*k];
                let message = format!(
                    "`{name}` moves nothing that the speeds before it do not move: the mass matrix is singular; \
                     leave one of them out, or give what it moves a mass"
                );
                mistakes.push(*span, message);
            }
            SystemFault::DependentConstraint(k) => {
                let (span, message) = clause(
                    *k,
                    "this constraint follows from the coordinates, the speeds and the constraints before it, so its \
                     multiplier is undetermined; remove it, or add `redundant` for multipliers of least norm",
                );
                mistakes.push(span, message);
            }
            SystemFault::InconsistentConstraint(k) => {
                let (span, message) = clause(
                    *k,
                    "no motion satisfies this constraint together with the coordinates, the speeds and the constraints \
                     before it; correct it or remove it",
                );
                mistakes.push(span, message);
            }
        }
    }
    mistakes.finish().err().unwrap_or_else(|| bug(&provenance.item.ident, &"a fault without a name"))
}

/// A check that failed: what in the scene is the cause, or a mistake of this crate.
pub fn failed<'g>(provenance: &Provenance<'g>, system: &System<'g>, what: &impl Display) -> Error {
    provenance.cause_of_failure(&system.scene.tree).unwrap_or_else(|| match has_values(system) {
        true => bug(&provenance.item.ident, what),
        false => Error::new(
            provenance.item.ident.span(),
            format!(
                "the mass matrix has a value at none of the states that were tried, so its pivots are not known to \
                 differ from zero ({what}); see whether roots, logarithms and arcs in positions and kinematics are \
                 inside their domains, and whether every speed moves something"
            ),
        ),
    })
}

/// A mistake of this crate, said as such at the name of the struct.
pub fn bug(ident: &Ident, what: &impl Display) -> Error {
    Error::new(ident.span(), format!("bug in gauss-derive: {what}; please report it together with this struct"))
}

/// Constants of the equations that are beyond the range of the scalar although the numbers that they are made of are
/// not: nothing, or infinity, would stand in their place.
///
/// # Errors
/// The first of the extreme numbers, or the name of the struct where there are none.
pub fn refuse_lost<'g>(provenance: &Provenance<'g>, kernel: &Kernel<'g>) -> Result<()> {
    let single = matches!(provenance.item.scalar, Scalar::F32);
    let [least, most] = match single {
        true => [f32::MIN_POSITIVE, f32::MAX].map(f64::from),
        false => [f64::MIN_POSITIVE, f64::MAX],
    };
    let is_lost = |value: f64| !(least..=most).contains(&value.abs());
    let has_extreme = !provenance.extreme.is_empty();
    // Zero, too small or too large.
    let suspicious = kernel.known_constants.iter().zip(&kernel.folded).filter(|((_, found), _)| is_lost(*found));
    // Among usual numbers a zero is what rounding left of a difference; among extreme ones a product may be lost.
    let of_literals = suspicious
        .filter_map(|(_, (_, definition))| provenance.rounded(*definition))
        .any(|exact| !exact.may_be_zero() && (is_lost(exact.value.to_f64()) || has_extreme));
    let programs = kernel.written();
    let in_programs = || {
        let mut operands = programs.flat_map(|program| &program.instructions).flat_map(Instruction::operands);
        operands.any(|operand| matches!(operand, Operand::Number(n) if !n.is_zero() && is_lost(n.to_f64())))
    };
    if !of_literals && !in_programs() {
        return Ok(());
    }
    let span = provenance.extreme.first().map_or(provenance.item.ident.span(), |(span, _)| *span);
    let of = provenance.extreme.first().map(|(_, value)| format!(" with `{}`", decimal(*value, Notation::Text)));
    let (of, precision) = (of.unwrap_or_default(), if single { "single" } else { "double" });
    let message = format!(
        "a constant of the equations{of} is beyond the range of {precision} precision; choose units in which the numbers \
         are nearer to 1"
    );
    Err(Error::new(span, message))
}
