//! The files in C that hold one scene: sizes in `model.h`, functions and tables in `model.c`.

use std::fmt::Write;

use gauss_codegen::Derivation;
use gauss_codegen::description::QuantityKind;
use gauss_codegen::parameters::{Check, Given, Rule};
use gauss_codegen::program::{ArgumentKind, Malformed, Program};
use gauss_codegen::targets::c;

use crate::variables::{Role, Variable, count, ordered, outputs};

/// Arguments that change along a direction of states, inputs and time: accelerations too, of which outputs are made.
const MOVING: [ArgumentKind; 5] = [
    ArgumentKind::Time,
    ArgumentKind::Configuration,
    ArgumentKind::Speeds,
    ArgumentKind::Accelerations,
    ArgumentKind::Inputs,
];

/// Arguments that change with parameters.
const BY_CONSTANTS: [ArgumentKind; 2] = [ArgumentKind::Constants, ArgumentKind::Accelerations];

/// Beginning of the names of functions of programs, which no other file sees.
const PREFIX: &str = "scene";

/// ż, an argument of outputs.
const ACCELERATION: &str = "const double *acceleration";

/// A scene that is written as C.
pub struct Scene<'a> {
    pub derivation: &'a Derivation,
    pub variables: &'a [Variable],
    /// Mark of this scene with its start values.
    pub token: &'a str,
    /// 2 or 3.
    pub version: u8,
}

impl Scene<'_> {
    /// `model.h`: the sizes.
    pub fn header(&self) -> String {
        let own = self.derivation;
        let parameters = own.parameters();
        let kinematics = self.rates()[0];
        let numbers = |program: &Program| program.code.outputs.len();
        let sizes = [
            ("FMI", usize::from(self.version)),
            ("PARAMETERS", parameters.list.iter().map(|parameter| parameter.count).sum()),
            ("READ", parameters.read.len()),
            ("CONSTANTS", numbers(own.constants())),
            ("COMPUTED", numbers(&parameters.computed)),
            ("CHECKS", parameters.checks.len()),
            ("IN_SUM", usize::from(parameters.in_sum)),
            ("GROUPS", self.groups().len()),
            ("Q", count(own, ArgumentKind::Configuration)),
            ("V", kinematics.map_or(0, numbers)),
            ("Z", count(own, ArgumentKind::Speeds)),
            ("U", count(own, ArgumentKind::Inputs)),
            ("OUTPUTS", outputs(own).iter().map(|group| group.numbers.len()).sum()),
            ("HAS_REGULARITY", usize::from(own.program("regularity").is_some())),
            ("CONTACTS", own.description().contacts.len()),
        ];
        let most = parameters.checks.iter().map(|check| check.values.len()).max().unwrap_or(0).max(1);
        let gaps = outputs(own).into_iter().take_while(|group| group.program.name != "gaps");
        let first_gap: usize = gaps.map(|group| group.numbers.len()).sum();
        let mut out = String::from("/* Sizes and marks of one scene. */\n");
        for (name, size) in sizes {
            writeln!(out, "#define MODEL_{name} {size}").ok();
        }
        writeln!(out, "#define MOST_GIVEN {most}").ok();
        writeln!(out, "#define FIRST_GAP {first_gap}").ok();
        writeln!(out, "#define MODEL_INDICATORS MODEL_CONTACTS").ok();
        writeln!(out, "#define MODEL_NAME {}", quoted(own.name())).ok();
        writeln!(out, "#define MODEL_TOKEN {}", quoted(self.token)).ok();
        writeln!(out, "#define MODEL_LABEL {}", quoted(&parameters.label)).ok();
        writeln!(out, "#define MODEL_TOLERANCE {:?}", crate::TOLERANCE).ok();
        out
    }

    /// `model.c`: functions of the scene, and tables.
    ///
    /// # Errors
    /// A mistake of this crate.
    pub fn source(&self) -> Result<String, Malformed> {
        let own = self.derivation;
        let mut out = equations(own.functions().equations.as_str());
        out.push_str(
            "/* The sign, which C lacks. */\nstatic inline double gauss_signum(double x)\n{\n    \
             return x > 0.0 ? 1.0 : x < 0.0 ? -1.0 : x;\n}\n",
        );
        self.tables(&mut out);
        self.functions(&mut out)?;
        Ok(out)
    }

    /// The programs of q̇ and ż.
    fn rates(&self) -> [Option<&Program>; 2] {
        let program = |name| self.derivation.program(name);
        [program("configuration_rates").or_else(|| program("kinematics")), program("acceleration")]
    }

    /// Kind and first component and increment of each rotation and pose.
    fn groups(&self) -> Vec<(&'static str, usize, usize)> {
        let (mut component, mut increment, mut all) = (0, 0, Vec::new());
        for part in ordered(self.derivation) {
            let (kind, components, increments) = match part.kind {
                QuantityKind::Rotation => ("ROTATION", 4, 3),
                QuantityKind::Pose => ("POSE", 7, 6),
                QuantityKind::Plane => ("PLANE", 4, 3),
                QuantityKind::Scalar | QuantityKind::Vector(_) => continue,
            };
            all.push((kind, component, increment));
            (component, increment) = (component + components, increment + increments);
        }
        all
    }

    fn tables(&self, out: &mut String) {
        let parameters = self.derivation.parameters();
        let names = self.variables.iter().map(|variable| quoted(&variable.name));
        table(out, "const char *const names", names);
        for (name, role) in [("start_parameters", Role::Parameter), ("start_states", Role::State)] {
            let own = self.variables.iter().filter(|variable| variable.role == role);
            table(out, &format!("const double {name}"), own.map(|own| format!("{:?}", own.start.unwrap_or(0.0))));
        }
        let contacts = self.derivation.description().contacts.iter().map(|contact| quoted(&contact.name));
        table(out, "const char *const contact_names", contacts.chain(std::iter::once(quoted("?"))));
        let groups = self
            .groups()
            .into_iter()
            .map(|(kind, component, increment)| format!("{{{kind}, {component}, {increment}}}"));
        table(out, "const group groups", groups.chain(std::iter::once("{0, 0, 0}".to_owned())));
        table(out, "const int read_parameters", parameters.read.iter().map(usize::to_string));
        let given = parameters.checks.iter().flat_map(|check| &check.values).map(|given| match given {
            Given::Number(k) => k.to_string(),
            Given::Zero => "-1".to_owned(),
            // A matrix of numbers of the scene is computed as well.
            Given::Computed(k) => format!("-{}", k + 2),
        });
        table(out, "const int given", given);
        let mut first = 0;
        let checks = parameters.checks.iter().map(|Check { label, rule, values, is_formal, .. }| {
            let (name, axis) = rule_name(*rule);
            let (formal, count, own) = (u8::from(*is_formal), values.len(), first);
            first += count;
            format!("{{{}, {name}, {axis}, {formal}, {count}, {own}}}", quoted(label))
        });
        let checks: Vec<String> = checks.collect();
        table(
            out,
            "const check checks",
            checks.into_iter().chain(std::iter::once("{\"\", FINITE, 0, 0, 0, 0}".to_owned())),
        );
    }

    fn functions(&self, out: &mut String) -> Result<(), Malformed> {
        let own = self.derivation;
        let (constants, computed) = (own.constants(), &own.parameters().computed);
        let state = "const double *k, double t, const double *q";
        self.group(out, "model_constants", "const double *parameters, double *out", [Some((constants, "out"))]);
        self.group(out, "model_checks", "const double *parameters, double *out", [Some((computed, "out"))]);
        let matrix = own.program("mass_matrix").map(|program| (program, "out"));
        self.group(out, "model_mass_matrix", &format!("{state}, double *out"), [matrix]);
        let [kinematics, acceleration] = self.rates();
        let moving = format!("{state}, const double *z, const double *input");
        let rates = [kinematics.map(|own| (own, "v")), acceleration.map(|own| (own, "zdot"))];
        self.group(out, "model_rates", &format!("{moving}, double *v, double *zdot"), rates);
        let places = self.output_places();
        let groups = outputs(own);
        let list: Vec<_> =
            groups.iter().map(|group| group.program).zip(&places).map(|(own, to)| Some((own, &to[..]))).collect();
        self.group(out, "model_outputs", &format!("{moving}, {ACCELERATION}, double *out"), list);
        let regularity = own.program("regularity");
        self.regularity(out, regularity, state);
        let constants = constants.tangent("kernel_tangent", &[ArgumentKind::Parameters])?;
        let arguments = "const double *parameters, const double *dparameters, double *out";
        self.group(out, "model_constants_tangent", arguments, [Some((&constants, "out"))]);
        let along = "double dt, const double *dq, const double *dz, const double *dinput";
        let moving = format!("{moving}, {ACCELERATION}");
        let results = "double *v, double *dacceleration, double *out";
        self.tangents(out, "tangent", &MOVING, &format!("{moving}, {along}, {results}"))?;
        let arguments = format!("{moving}, const double *dk, {results}");
        self.tangents(out, "tangent_by_constants", &BY_CONSTANTS, &arguments)?;
        self.contacts(out, state);
        Ok(())
    }

    /// Functions of contacts, where there are some; `model_gaps` calls the function that outputs have called before.
    fn contacts(&self, out: &mut String, state: &str) {
        let own = self.derivation;
        if own.description().contacts.is_empty() {
            return;
        }
        let moving = format!("{state}, const double *z");
        let response = "double *acceleration, double *bias, double *columns, double *delassus";
        let methods = [
            ("gaps", format!("{state}, double *out"), "out"),
            ("contact_rates", format!("{moving}, double *out"), "out"),
            ("restitution", format!("{state}, double *out"), "out"),
            ("kinematics", format!("{moving}, double *out"), "out"),
            (
                "impulse_dynamics",
                format!("{moving}, const double *input, {response}"),
                &response.replace("double *", ""),
            ),
        ];
        for (method, arguments, to) in methods {
            let Some(program) = own.program(method) else { continue };
            // Outputs and rates have called these before.
            let is_there = method == "gaps" || method == "kinematics" && own.program("configuration_rates").is_none();
            if !is_there {
                out.push_str(&self.function(program));
            }
            self.calling(out, &format!("model_{method}"), &arguments, &[(program, to)]);
        }
    }

    /// Places of the outputs of each method.
    fn output_places(&self) -> Vec<String> {
        let mut next = 0;
        let place = |count: usize| {
            let own = format!("out + {next}");
            next += count;
            own
        };
        outputs(self.derivation).iter().map(|group| group.numbers.len()).map(place).collect()
    }

    /// Derivatives of q̇, ż and all outputs.
    fn tangents(&self, out: &mut String, name: &str, kinds: &[ArgumentKind], arguments: &str) -> Result<(), Malformed> {
        let groups = outputs(self.derivation);
        let [kinematics, acceleration] = self.rates();
        let rates = [(kinematics, "v"), (acceleration, "dacceleration")];
        let rates = rates.into_iter().filter_map(|(program, to)| Some((program?, to.to_owned())));
        let all = rates.chain(groups.iter().map(|group| group.program).zip(self.output_places()));
        let made = all.map(|(program, to)| Ok((program.tangent(&format!("{}_{name}", program.name), kinds)?, to)));
        let made = made.collect::<Result<Vec<_>, _>>()?;
        let list: Vec<_> = made.iter().map(|(program, to)| Some((program, &to[..]))).collect();
        self.group(out, &format!("model_{name}"), arguments, list);
        Ok(())
    }

    fn regularity(&self, out: &mut String, program: Option<&Program>, state: &str) {
        if let Some(program) = program {
            out.push_str(&self.function(program));
        }
        let value = program.map_or_else(|| "1.0".to_owned(), |program| self.call(program, ""));
        write!(out, "\nstatic double model_regularity({state})\n{{\n{}    return {value};\n}}\n", unused(state)).ok();
    }

    /// Functions of programs, and one that calls all of them; each writes its results where it is said.
    fn group<'p>(
        &self,
        out: &mut String,
        name: &str,
        arguments: &str,
        programs: impl IntoIterator<Item = Option<(&'p Program, &'p str)>>,
    ) {
        let of_all = programs.into_iter().flatten().filter(|(program, _)| !program.code.outputs.is_empty());
        let all: Vec<_> = of_all.collect();
        all.iter().for_each(|(program, _)| out.push_str(&self.function(program)));
        self.calling(out, name, arguments, &all);
    }

    /// A function that calls those of programs.
    fn calling(&self, out: &mut String, name: &str, arguments: &str, programs: &[(&Program, &str)]) {
        let mut body = unused(arguments);
        for (program, to) in programs {
            if is_number(program) {
                let target = if to.contains('+') { format!("*({to})") } else { format!("*{to}") };
                writeln!(body, "    {target} = {};", self.call(program, "")).ok();
            } else {
                writeln!(body, "    {};", self.call(program, to)).ok();
            }
        }
        write!(out, "\nstatic void {name}({arguments})\n{{\n{body}}}\n").ok();
    }

    /// A function that no other file sees.
    fn function(&self, program: &Program) -> String {
        format!("\n{}", c::static_function(program, PREFIX))
    }

    fn call(&self, program: &Program, to: &str) -> String {
        let handed = program.arguments.iter().filter(|own| !own.components.is_empty()).map(|own| own.name.clone());
        let results = Some(to.to_owned()).filter(|to| !to.is_empty());
        let all: Vec<String> = handed.chain(results).collect();
        format!("{}_{}({})", PREFIX, program.name, all.join(", "))
    }
}

/// Whether the C function of a program returns its only result.
fn is_number(program: &Program) -> bool {
    matches!(program.results.as_slice(), [result] if result.is_scalar())
}

/// Statements that use every argument.
fn unused(arguments: &str) -> String {
    let name = |argument: &str| argument.rsplit([' ', '*']).next().unwrap_or_default().to_owned();
    arguments.split(", ").map(|argument| format!("    (void){};\n", name(argument))).collect()
}

/// A constant array, or one entry that is zero where there are none.
fn table(out: &mut String, declared: &str, entries: impl Iterator<Item = String>) {
    let mut list: Vec<String> = entries.collect();
    if list.is_empty() {
        list.push("0".to_owned());
    }
    let lines: String = list.iter().map(|entry| format!("    {entry},\n")).collect();
    write!(out, "\nstatic {declared}[] = {{\n{lines}}};\n").ok();
}

/// A literal of C, in which no trigraph is.
pub fn quoted(text: &str) -> String {
    let mut out = String::from("\"");
    for c in text.chars() {
        match c {
            '"' | '\\' | '?' => out.extend(['\\', c]),
            '\n' => out.push_str("\\n"),
            c if c.is_control() => out.push(' '),
            c => out.push(c),
        }
    }
    out.push('"');
    out
}

fn equations(text: &str) -> String {
    let text = text.replace("*/", "* /").replace("/*", "/ *").replace('\\', "/");
    let lines: String = text.lines().map(|line| format!(" * {line}").trim_end().to_owned() + "\n").collect();
    format!("/*\n{lines} */\n\n")
}

/// The name of a rule, and its axis if it has one.
fn rule_name(rule: Rule) -> (&'static str, usize) {
    let name = match rule {
        Rule::Finite => "FINITE",
        Rule::Mass => "MASS",
        Rule::MassInSum => "MASS_IN_SUM",
        Rule::NonNegative => "NON_NEGATIVE",
        Rule::Symmetric => "SYMMETRIC",
        Rule::Inertia => "INERTIA",
        Rule::CentralInertia => "CENTRAL_INERTIA",
        Rule::InertiaAboutAxis(axis) => return ("INERTIA_ABOUT_AXIS", axis),
        Rule::InertiaInSum => "INERTIA_IN_SUM",
        Rule::KineticMatrix => "KINETIC_MATRIX",
        Rule::Stiffness => "STIFFNESS",
        Rule::Width => "WIDTH",
        Rule::Limits => "LIMITS",
        Rule::Armature => "ARMATURE",
        Rule::Length => "LENGTH",
        Rule::Restitution => "RESTITUTION",
        Rule::Direction => "DIRECTION",
        Rule::StiffnessMatrix => "STIFFNESS_MATRIX",
        Rule::DampingMatrix => "DAMPING_MATRIX",
        Rule::Modes => "MODES",
    };
    (name, 0)
}
