//! C99 with the interface of CasADi's `external`: the functions of a struct, their first derivatives as sparse
//! matrices, and what Hessians are made of.
//!
//! Every method `f` becomes four functions, which CasADi finds by their names: `f`, `jac_f` (∂f/∂x), `adj1_f` (∂f/∂xᵀ
//! w) and `fwd1_adj1_f`, the change of the last along a direction. Arguments and results have the names, and but for
//! matrices the shapes, of the method; matrices stand by columns, as CasADi has them. In place of the constants of a
//! kernel the parameters are an argument, so that derivatives by parameters are there too. Nothing is kept between
//! calls, which may come from several threads.
//!
//! ```
//! let top = "#[gauss(motion = fixed_point)] struct Top { #[gauss(mass)] m: f64, #[gauss(inertia)] i: Vector3<f64> }";
//! let derivation = gauss_codegen::Derivation::of_source(top, "Top")?;
//! let code = gauss_codegen::targets::casadi::source(derivation.functions())?;
//! assert!(code.contains("int jac_top_acceleration("));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! Source of the interface: J. Andersson et al., *CasADi: a software framework for nonlinear optimization and optimal
//! control*, Mathematical Programming Computation 11 (2019) 1–36; the user guide of CasADi, section "Using external
//! functions".

use std::collections::BTreeMap;
use std::fmt::Write;

use crate::program::{ArgumentKind, Functions, Malformed, Program, Results};

use super::{c, is_handed_over, only_scalar, snake};

/// Beginning of the names of functions that no other file sees.
const INNER: &str = "compute";

/// A source file of all methods that give numbers ([`Functions::only`] leaves methods out).
///
/// # Errors
/// A mistake of this crate.
pub fn source(functions: &Functions) -> Result<String, Malformed> {
    let prefix = snake(&functions.name);
    let mut externals = Vec::new();
    for program in functions.methods.iter().filter(|program| !program.code.outputs.is_empty()) {
        let function = External::of(&program.of_parameters(&functions.constants)?, &prefix)?;
        let adjoint = function.adjoint()?;
        externals.extend([function.jacobian()?, adjoint.tangent()?, function, adjoint]);
    }
    Ok(file(functions, &externals))
}

/// An argument or result as CasADi sees it.
#[derive(Clone)]
struct Port {
    name: String,
    rows: usize,
    columns: usize,
    /// Places of what is stored, by columns, where not all is.
    places: Option<Vec<(usize, usize)>>,
}

impl Port {
    fn vector(name: String, rows: usize) -> Self {
        Self { name, rows, columns: 1, places: None }
    }

    /// A place for the results of the function that is differentiated, which no derivative reads.
    fn idle(&self) -> Self {
        Self { name: format!("out_{}", self.name), places: Some(Vec::new()), ..self.clone() }
    }

    fn entries(&self) -> usize {
        self.places.as_ref().map_or(self.rows * self.columns, Vec::len)
    }

    /// Rows and columns; then 1, or where the columns begin and the row of each entry.
    fn sparsity(&self) -> String {
        let Some(places) = &self.places else { return format!("{}, {}, 1", self.rows, self.columns) };
        let begins = (0..=self.columns).map(|column| places.iter().filter(|place| place.1 < column).count());
        let numbers = [self.rows, self.columns].into_iter().chain(begins).chain(places.iter().map(|place| place.0));
        numbers.map(|number| number.to_string()).collect::<Vec<_>>().join(", ")
    }
}

/// One function that CasADi calls. The arguments of its program are the inputs that have entries.
struct External {
    name: String,
    inputs: Vec<Port>,
    outputs: Vec<Port>,
    program: Program,
}

impl External {
    /// A method, with its matrices by columns.
    fn of(program: &Program, prefix: &str) -> Result<Self, Malformed> {
        let name = format!("{prefix}_{}", program.name);
        let outputs = program.results.iter().filter(|result| result.len() > 0).map(|result| {
            let name = c::result_name(program, result);
            Port { name, rows: result.rows, columns: result.columns, places: None }
        });
        let mut first = 0;
        let mut places = Vec::new();
        for Results { rows, columns, .. } in &program.results {
            places.extend((0..*columns).flat_map(|column| (0..*rows).map(move |row| first + row * columns + column)));
            first += rows * columns;
        }
        let by_columns = program.clone().with_code(|mut code| {
            code.outputs = places.iter().map(|&place| code.outputs[place]).collect();
            code
        })?;
        Ok(Self { inputs: ports(program), outputs: outputs.collect(), program: by_columns, name })
    }

    /// Its inputs and those of its results, which derivatives have too.
    fn inputs_of_derivatives(&self) -> Vec<Port> {
        self.inputs.iter().cloned().chain(self.outputs.iter().map(Port::idle)).collect()
    }

    fn adjoint(&self) -> Result<Self, Malformed> {
        let program = self.program.adjoint(&format!("{}_adjoint", self.program.name))?;
        let weights = self.outputs.iter().map(|port| Port { name: format!("adj_{}", port.name), ..port.clone() });
        let outputs =
            ports(&self.program).into_iter().map(|port| Port::vector(format!("adj_{}", port.name), port.rows));
        Ok(Self {
            name: format!("adj1_{}", self.name),
            inputs: self.inputs_of_derivatives().into_iter().chain(weights).collect(),
            outputs: outputs.collect(),
            program,
        })
    }

    fn tangent(&self) -> Result<Self, Malformed> {
        let own = &self.program;
        let kinds: Vec<ArgumentKind> = own.arguments.iter().map(|argument| argument.kind).collect();
        let Program { name, arguments, numbers, code, functions, .. } =
            own.tangent(&format!("{}_tangent", own.name), &kinds)?;
        let results = own.results.iter().map(|result| Results::new(format!("fwd_{}", result.name), result.len(), 1));
        let program = Program::new(name, arguments, numbers, code, results.collect())?.with_functions(functions);
        let along = |port: &Port| Port { name: format!("fwd_{}", port.name), ..port.clone() };
        Ok(Self {
            name: format!("fwd1_{}", self.name),
            inputs: self.inputs_of_derivatives().into_iter().chain(self.inputs.iter().map(along)).collect(),
            outputs: self.outputs.iter().map(along).collect(),
            program,
        })
    }

    fn jacobian(&self) -> Result<Self, Malformed> {
        let jacobian = self.program.jacobian(&format!("{}_jacobian", self.program.name))?;
        // Of arguments and results without numbers there are no ports.
        let filled = self.program.results.iter().flat_map(|result| {
            self.program.arguments.iter().map(|argument| result.len() > 0 && is_handed_over(argument))
        });
        let blocks = filled.zip(jacobian.places).filter(|(filled, _)| *filled);
        let mut blocks = blocks.map(|(_, places)| places);
        let mut outputs = Vec::new();
        for output in &self.outputs {
            for input in &self.inputs {
                let places = if input.entries() == 0 { Some(Vec::new()) } else { blocks.next() };
                let (rows, columns) = (output.rows * output.columns, input.rows * input.columns);
                outputs.push(Port { name: format!("jac_{}_{}", output.name, input.name), rows, columns, places });
            }
        }
        let inputs = self.inputs_of_derivatives();
        Ok(Self { name: format!("jac_{}", self.name), inputs, outputs, program: jacobian.program })
    }

    /// The function, and what CasADi asks of it. `patterns` are those of the file.
    fn write(&self, out: &mut String, patterns: &mut BTreeMap<String, usize>) {
        write!(out, "\n{}", c::static_function(&self.program, INNER)).ok();
        let name = &self.name;
        let mut body = String::new();
        let mut handed = Vec::new();
        let mut arguments = self.program.arguments.iter().filter(|argument| is_handed_over(argument));
        for (k, _) in self.inputs.iter().enumerate().filter(|(_, port)| port.entries() > 0) {
            writeln!(body, "    const double *a{k} = arg[{k}] ? arg[{k}] : nothing;").ok();
            let time = arguments.next().is_some_and(|argument| argument.kind == ArgumentKind::Time);
            handed.push(format!("{}a{k}", if time { "*" } else { "" }));
        }
        let mut work = 0;
        let mut results = Vec::new();
        for (k, port) in self.outputs.iter().enumerate().filter(|(_, port)| port.entries() > 0) {
            writeln!(body, "    double *r{k} = res[{k}] ? res[{k}] : w + {work};").ok();
            work += port.entries();
            results.push(format!("r{k}"));
        }
        let call = format!("{INNER}_{}", self.program.name);
        match (only_scalar(&self.program), results.first()) {
            (true, Some(result)) => writeln!(body, "    *{result} = {call}({});", handed.join(", ")).ok(),
            _ => {
                handed.extend(results);
                writeln!(body, "    {call}({});", handed.join(", ")).ok()
            }
        };
        write!(
            out,
            "\nint {name}(const double **arg, double **res, casadi_int *iw, double *w, int mem)\n{{\n    (void)arg, \
             (void)res, (void)iw, (void)w, (void)mem;\n{body}    return 0;\n}}\n"
        )
        .ok();
        self.write_shapes(out, patterns, work);
    }

    fn write_shapes(&self, out: &mut String, patterns: &mut BTreeMap<String, usize>, work: usize) {
        let name = &self.name;
        for (way, ports) in [("in", &self.inputs), ("out", &self.outputs)] {
            let names: String = ports.iter().map(|port| format!("    \"{}\",\n", port.name)).collect();
            let known = ports.iter().map(|port| {
                let next = patterns.len();
                *patterns.entry(port.sparsity()).or_insert(next)
            });
            let known: String = known.map(|place| format!("    pattern_{place},\n")).collect();
            write!(
                out,
                "\ncasadi_int {name}_n_{way}(void)\n{{\n    return {count};\n}}\n\n\
                 const char *{name}_name_{way}(casadi_int i)\n{{\n    static const char *const names[] = {{\n{names}    0\n    \
                 }};\n    return i < 0 || i >= {count} ? 0 : names[i];\n}}\n\n\
                 const casadi_int *{name}_sparsity_{way}(casadi_int i)\n{{\n    static const casadi_int *const all[] = \
                 {{\n{known}    0\n    }};\n    return i < 0 || i >= {count} ? 0 : all[i];\n}}\n",
                count = ports.len()
            )
            .ok();
        }
        let (inputs, outputs) = (self.inputs.len(), self.outputs.len());
        write!(
            out,
            "\nint {name}_work(casadi_int *sz_arg, casadi_int *sz_res, casadi_int *sz_iw, casadi_int *sz_w)\n{{\n    \
             if (sz_arg) *sz_arg = {inputs};\n    if (sz_res) *sz_res = {outputs};\n    if (sz_iw) *sz_iw = 0;\n    \
             if (sz_w) *sz_w = {work};\n    return 0;\n}}\n"
        )
        .ok();
    }
}

/// The arguments of a program that have numbers.
fn ports(program: &Program) -> Vec<Port> {
    let handed = program.arguments.iter().filter(|argument| is_handed_over(argument));
    handed.map(|argument| Port::vector(argument.name.clone(), argument.components.len())).collect()
}

fn file(functions: &Functions, externals: &[External]) -> String {
    let mut patterns = BTreeMap::new();
    let mut bodies = String::new();
    externals.iter().for_each(|external| external.write(&mut bodies, &mut patterns));
    let mut out = c::beginning(&functions.equations, externals.iter().map(|external| &external.program));
    let longest = externals.iter().flat_map(|external| &external.inputs).map(Port::entries).max().unwrap_or(0).max(1);
    write!(
        out,
        "\n#ifndef casadi_int\n#define casadi_int long long int\n#endif\n\n\
         /* Arguments that are not given are zero. */\nstatic const double nothing[{longest}] = {{0.0}};\n\n"
    )
    .ok();
    for (pattern, place) in &patterns {
        writeln!(out, "static const casadi_int pattern_{place}[] = {{{pattern}}};").ok();
    }
    out + &bodies
}
