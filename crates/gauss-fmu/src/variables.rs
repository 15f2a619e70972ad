//! The variables of an FMU: names, units, and what they are.

use std::collections::HashSet;

use gauss_codegen::Derivation;
use gauss_codegen::description::{ContactDescription, Quantity, QuantityKind};
use gauss_codegen::program::{ArgumentKind, Program};

/// A variable, whose value reference is its place among all.
#[derive(Clone, Debug)]
pub struct Variable {
    pub name: String,
    pub role: Role,
    pub unit: Option<String>,
    pub description: String,
    /// Value at the start, where one is given.
    pub start: Option<f64>,
}

/// The role of a variable.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    Time,
    Parameter,
    Input,
    State,
    /// The rate of a state, by its place among the states.
    Rate(usize),
    Output,
}

impl Role {
    fn word(self) -> &'static str {
        match self {
            Role::Time => "independent",
            Role::Parameter => "parameter",
            Role::Input => "input",
            Role::State => "state",
            Role::Rate(_) => "rate",
            Role::Output => "output",
        }
    }
}

/// Numbers that one method gives.
pub struct OutputGroup<'a> {
    pub program: &'a Program,
    /// Name, unit and description of each.
    pub numbers: Vec<(String, &'static str, String)>,
}

/// The names of the components of an argument of `acceleration`.
pub fn count(derivation: &Derivation, kind: ArgumentKind) -> usize {
    let program = derivation.program("acceleration");
    let argument = program.and_then(|program| program.arguments.iter().find(|own| own.kind == kind));
    argument.map_or(0, |argument| argument.components.len())
}

/// Coordinates in the order of a configuration: all scalars stand behind all others.
pub fn ordered(derivation: &Derivation) -> impl Iterator<Item = &Quantity> {
    let of = move |is_plain: bool| {
        let all = derivation.description().coordinates.iter();
        all.filter(move |part| matches!(part.kind, QuantityKind::Scalar | QuantityKind::Vector(_)) == is_plain)
    };
    of(false).chain(of(true))
}

/// Methods whose results are outputs, in their order.
pub fn outputs(derivation: &Derivation) -> Vec<OutputGroup<'_>> {
    let mut groups = Vec::new();
    let mut add = |method: &str, numbers: Vec<(String, &'static str, String)>| {
        if let Some(program) = derivation.program(method).filter(|own| own.code.outputs.len() == numbers.len()) {
            groups.push(OutputGroup { program, numbers });
        }
    };
    let energy = |name: &str, of: &str| vec![(name.to_owned(), "J", of.to_owned())];
    add("kinetic_energy", energy("kinetic_energy", "Kinetic energy, that of the fluid included"));
    add("potential_energy", energy("potential_energy", "Potential energy"));
    for frame in &derivation.description().frames {
        let matrix = (1..=3).flat_map(|i| (1..=3).map(move |j| format!("{i},{j}")));
        let rotation = matrix.map(|place| {
            (format!("{frame}.rotation[{place}]"), "1", format!("Axes of `{frame}` in those of the observer"))
        });
        let position = format!("Origin of `{frame}` in the observer's axes");
        add(&format!("pose_of_{frame}"), triple(frame, "position", "m", &position).chain(rotation).collect());
        let [velocity, turning] =
            ["Velocity of the origin", "Angular velocity"].map(|of| format!("{of} of `{frame}`, in its axes"));
        let twist = triple(frame, "velocity", "m/s", &velocity);
        add(&format!("twist_of_{frame}"), twist.chain(triple(frame, "angular_velocity", "rad/s", &turning)).collect());
    }
    let reactions = derivation.description().joints.iter().flat_map(|joint| {
        let [force, torque] = ["Force", "Torque"].map(|of| format!("{of} of the joint of `{joint}`"));
        let own = triple(joint, "force", "N", &force);
        own.chain(triple(joint, "torque", "N m", &torque)).collect::<Vec<_>>()
    });
    add("reactions_at", reactions.collect());
    let driving = derivation.description().motions.iter().flat_map(|motion| {
        let force = (format!("{motion}.driving_force"), "1", format!("Force that drives `{motion}`"));
        [force, (format!("{motion}.driving_power"), "W", format!("Power that drives `{motion}`"))]
    });
    add("driving_forces_at", driving.collect());
    let gaps = derivation.description().contacts.iter();
    let gap = |name: &str| (format!("{name}.gap"), "1", format!("Gap of `{name}`"));
    add("gaps", gaps.map(|contact| gap(&contact.name)).collect());
    groups
}

fn triple(
    owner: &str,
    name: &str,
    unit: &'static str,
    of: &str,
) -> impl Iterator<Item = (String, &'static str, String)> + use<> {
    let (name, of) = (format!("{owner}.{name}"), of.to_owned());
    (1..=3).map(move |k| (format!("{name}[{k}]"), unit, of.clone()))
}

/// All variables, in the order of their value references; the start values of parameters are numbers of all of them.
pub fn variables(derivation: &Derivation, parameters: &[f64]) -> Vec<Variable> {
    let new = |name: String, role: Role, unit: Option<&str>, description: &str, start: Option<f64>| {
        let description = description.split_whitespace().collect::<Vec<_>>().join(" ");
        Variable { name, role, unit: unit.map(str::to_owned), description, start }
    };
    let mut all = vec![new("time".to_owned(), Role::Time, Some("s"), "Time", None)];
    let mut numbers = parameters.iter().copied();
    for own in &derivation.parameters().list {
        for place in places(&own.axes) {
            let name = format!("{}{place}", own.name);
            all.push(new(name, Role::Parameter, own.unit.as_deref(), &own.documentation, numbers.next()));
        }
    }
    for own in &derivation.description().inputs {
        let unit = own.label.split_once(", in ").map(|(_, unit)| unit);
        for name in &own.numbers {
            all.push(new(name.clone(), Role::Input, unit, &own.label, Some(0.0)));
        }
    }
    let states: Vec<_> = ordered(derivation).chain(&derivation.description().speeds).flat_map(states_of).collect();
    for (name, unit, label, start) in &states {
        all.push(new(name.clone(), Role::State, *unit, label, Some(*start)));
    }
    for (place, (name, unit, ..)) in states.iter().enumerate() {
        let unit = unit.map(|unit| if unit.ends_with("/s") { format!("{unit}^2") } else { format!("{unit}/s") });
        all.push(new(format!("der({name})"), Role::Rate(place), unit.as_deref(), &format!("Rate of `{name}`"), None));
    }
    for (name, unit, label) in outputs(derivation).into_iter().flat_map(|group| group.numbers) {
        all.push(new(name, Role::Output, Some(unit).filter(|unit| *unit != "1"), &label, None));
    }
    let contacts = &derivation.description().contacts;
    for (end, of) in
        [("force", "Normal force"), ("indicator", "Event indicator: the gap, the force where it is closed,")]
    {
        for ContactDescription { name: contact, .. } in contacts {
            all.push(new(format!("{contact}.{end}"), Role::Output, None, &format!("{of} of `{contact}`"), None));
        }
    }
    unique(&mut all);
    all
}

/// Name, unit, meaning and rest of each number of a part.
fn states_of(part: &Quantity) -> Vec<(String, Option<&'static str>, String, f64)> {
    let unit = |k: usize| match part.kind {
        QuantityKind::Pose => (k >= 4).then_some("m"),
        QuantityKind::Plane => (k >= 2).then_some("m"),
        QuantityKind::Vector(3) if part.label.starts_with("angular velocity") => Some("rad/s"),
        QuantityKind::Vector(3) if part.label.starts_with("velocity") => Some("m/s"),
        _ => None,
    };
    // A quaternion at rest is i, j, k, w = 0, 0, 0, 1; cosine and sine are 1, 0.
    let one = match part.kind {
        QuantityKind::Rotation | QuantityKind::Pose => Some(3),
        QuantityKind::Plane => Some(0),
        QuantityKind::Scalar | QuantityKind::Vector(_) => None,
    };
    let number =
        |(k, name): (usize, &String)| (name.clone(), unit(k), part.label.clone(), f64::from(u8::from(one == Some(k))));
    part.numbers.iter().enumerate().map(number).collect()
}

/// `[1]`, `[2,3]`: places of a vector or a matrix; one empty text of a number.
fn places(axes: &[usize]) -> Vec<String> {
    match *axes {
        [rows] => (1..=rows).map(|k| format!("[{k}]")).collect(),
        [rows, columns] => (1..=rows).flat_map(|i| (1..=columns).map(move |j| format!("[{i},{j}]"))).collect(),
        _ => vec![String::new()],
    }
}

/// Names that are those of one variable each: states have theirs, and what has the name of another is called by its
/// role, as the input of a joint, `input.elbow`.
fn unique(all: &mut [Variable]) {
    let is_state = |own: &Variable| own.role == Role::State;
    let (states, others): (Vec<usize>, Vec<usize>) = (0..all.len()).partition(|k| is_state(&all[*k]));
    let mut taken = HashSet::new();
    for k in states.into_iter().chain(others) {
        let (name, word) = (all[k].name.clone(), all[k].role.word());
        let numbered = (2..).map(|n| format!("{name}_{n}"));
        let mut names = [name.clone(), format!("{word}.{name}")].into_iter().chain(numbered);
        if let Some(free) = names.find(|name| !taken.contains(name)) {
            all[k].name.clone_from(&free);
            taken.insert(free);
        }
    }
}
