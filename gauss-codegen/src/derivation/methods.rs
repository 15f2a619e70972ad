//! The programs of a kernel, method by method: arguments, code, what the outputs are.

use crate::emit::{Derived, OF_EQUATIONS, OF_HESSIAN, OF_REGRESSOR, OF_RESIDUAL, arguments_of, blocks};
use crate::kernel::{self, Derivative};
use crate::methods::{DerivativeKind, FrameQuantity, Method};
use crate::program::{ArgumentKind, Function, Instruction, Operand, Program, Results};

use super::signature::{Signature, SignatureError};

/// Every method, then what is computed together, and the derivatives.
pub fn programs<'g>(derived: &Derived<'_, 'g>, signature: &Signature<'g>) -> Result<Vec<Program>, SignatureError> {
    let functions = derived.kernel.functions.iter();
    let methods = functions.map(|(method, function)| of_method(derived, signature, method, &function.program));
    let mut programs = methods.collect::<Result<Vec<_>, _>>()?;
    programs.push(evaluate(derived, signature)?);
    for derivative in &derived.kernel.derivatives {
        programs.push(of_derivative(derived, signature, derivative)?);
    }
    Ok(programs)
}

/// Arguments of every method.
const ALWAYS: [ArgumentKind; 3] = [ArgumentKind::Constants, ArgumentKind::Time, ArgumentKind::Configuration];

fn with(further: &[ArgumentKind]) -> Vec<ArgumentKind> {
    [ALWAYS.as_slice(), further].concat()
}

fn of_method<'g>(
    derived: &Derived<'_, 'g>,
    signature: &Signature<'g>,
    method: Method,
    code: &kernel::Program<'g>,
) -> Result<Program, SignatureError> {
    // `expand` makes the series, this the rates that they are made from.
    let name = if method == Method::ComponentRates { "component_rates" } else { &derived.name_of(method) };
    let (rows, arguments) = (derived.degrees_of_freedom(), with(arguments_of(method)));
    let results = |rows: usize, columns: usize| vec![Results::new(name, rows, columns)];
    let count = code.outputs.len();
    match method {
        Method::MassMatrix | Method::ElementForces | Method::ContactJacobian => {
            signature.program(name, &arguments, code, results(rows, count / rows))
        }
        Method::OfFrame(FrameQuantity::Jacobian | FrameQuantity::JacobianRate, _) | Method::CentroidalMatrix => {
            signature.program(name, &arguments, code, results(6, rows))
        }
        Method::ImpulseResponse | Method::ImpulseDynamics => {
            let lines = derived.subject.system.contacts.rates.len();
            let effect = match derived.formal().factors.len() {
                0 => Results::new("columns", rows, lines),
                count => Results::new("factors", count, 1),
            };
            let mut results = vec![effect, Results::new("delassus", lines, lines)];
            if method == Method::ImpulseDynamics {
                results.splice(0..0, [Results::new("acceleration", rows, 1), Results::new("bias", lines, 1)]);
            }
            signature.program(name, &arguments, code, results)
        }
        Method::ContactReactions => {
            let lines = derived.subject.system.contacts.rates.len();
            signature.program(name, &arguments, code, results(count / lines, lines))
        }
        Method::DrivingForces => signature.program(name, &arguments, code, results(count / 2, 2)),
        Method::Kinematics | Method::ConfigurationRates | Method::PositionCorrection => {
            signature.program(name, &arguments, &with_increment_first(derived, code), results(count, 1))
        }
        Method::Regularity => signature.program(name, &arguments, &regularity(code), results(1, 1)),
        _ => signature.program(name, &arguments, code, results(count, 1)),
    }
}

/// The numerator over the root of the square.
fn regularity<'g>(code: &kernel::Program<'g>) -> kernel::Program<'g> {
    let mut code = code.clone();
    let (volume, squares) = (code.outputs[0], code.outputs[1]);
    let root = Operand::Value(code.instructions.len());
    code.instructions.push(Instruction::Call(Function::Sqrt, squares));
    code.instructions.push(Instruction::Divide(volume, root));
    code.outputs = vec![Operand::Value(code.instructions.len() - 1)];
    code
}

/// The program whose first outputs are an increment of the configuration, which lowering has in the order of the
/// coordinates, and configurations have groups first.
fn with_increment_first<'g>(derived: &Derived<'_, 'g>, code: &kernel::Program<'g>) -> kernel::Program<'g> {
    let places = derived.subject.increment_places();
    let (first, rest) = (places.iter().map(|&k| code.outputs[k]), code.outputs.iter().skip(places.len()).copied());
    kernel::Program { instructions: code.instructions.clone(), outputs: first.chain(rest).collect() }
}

fn evaluate<'g>(derived: &Derived<'_, 'g>, signature: &Signature<'g>) -> Result<Program, SignatureError> {
    let (increments, speeds) = (derived.increments(), derived.degrees_of_freedom());
    let results = vec![
        Results::new("velocity", increments, 1),
        Results::new("acceleration", speeds, 1),
        Results::new("kinetic_energy", 1, 1),
        Results::new("potential_energy", 1, 1),
    ];
    let arguments = with(OF_EQUATIONS);
    signature.program("evaluate", &arguments, &with_increment_first(derived, &derived.kernel.joined), results)
}

fn of_derivative<'g>(
    derived: &Derived<'_, 'g>,
    signature: &Signature<'g>,
    Derivative { kind, program, .. }: &Derivative<'g>,
) -> Result<Program, SignatureError> {
    let (increments, speeds) = (derived.increments(), derived.degrees_of_freedom());
    let (states, inputs) = (increments + speeds, derived.formal().inputs.len());
    let (arguments, results) = match kind {
        DerivativeKind::ByState => {
            let by_state = Results::new("by_state", states, states);
            let (by_time, by_input) = (Results::new("by_time", states, 1), Results::new("by_input", states, inputs));
            (OF_EQUATIONS, vec![Results::new("rate", states, 1), by_state, by_time, by_input])
        }
        DerivativeKind::ByParameters => {
            (OF_EQUATIONS, vec![Results::new("by_parameters", states, derived.subject.provenance.parameters.len())])
        }
        DerivativeKind::OfInverse => (
            OF_RESIDUAL,
            vec![
                Results::new("force", speeds, 1),
                Results::new("by_configuration", speeds, increments),
                Results::new("by_speeds", speeds, speeds),
                Results::new("by_acceleration", speeds, speeds),
                Results::new("by_time", speeds, 1),
                Results::new("by_input", speeds, inputs),
            ],
        ),
        DerivativeKind::Regressor => {
            (OF_REGRESSOR, vec![Results::new("regressor", speeds, derived.inertial_parameters.len())])
        }
        DerivativeKind::Hessian => {
            let by_state = Results::new("by_state", states, states);
            let by_input_and_state = Results::new("by_input_and_state", inputs, states);
            (OF_HESSIAN, vec![by_state, by_input_and_state, Results::new("by_input", inputs, inputs)])
        }
    };
    let code = match kind {
        DerivativeKind::Hessian => {
            let outputs = blocks(states, inputs).iter().flatten().flatten().map(|&k| program.outputs[k]).collect();
            kernel::Program { instructions: program.instructions.clone(), outputs }
        }
        _ => by_rows(program, &results),
    };
    signature.program(kind.name(), &with(arguments), &code, results)
}

/// Derivatives are computed column by column; results are written row by row.
fn by_rows<'g>(code: &kernel::Program<'g>, results: &[Results]) -> kernel::Program<'g> {
    let mut outputs = Vec::with_capacity(code.outputs.len());
    let mut start = 0;
    for result in results {
        let entries = (0..result.rows).flat_map(|i| (0..result.columns).map(move |j| result.rows * j + i));
        outputs.extend(entries.map(|k| code.outputs[start + k]));
        start += result.len();
    }
    kernel::Program { instructions: code.instructions.clone(), outputs }
}
