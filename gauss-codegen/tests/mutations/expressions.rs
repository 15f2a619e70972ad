//! Scenes of expressions that are well formed and as unlikely as can be: functions of functions, numbers of all sizes,
//! bodies that are none, definitions of themselves.

use super::random::Random;

const NUMBERS: &str = "0 1 2 0.5 0.1 3 7 100 1000 pi 1.5707963267948966 1e19 1e-19 1e30 3.4e38 1e-38 1e100 1e155 1e-155 1e200 \
    1e-200 1e300 1e-300 1e308 1e-307";

const SMOOTH: &str = "sin cos tan exp ln sqrt asin acos atan tanh -";

/// What only values of forces can contain.
const KINKS: [&str; 5] = ["abs", "signum", "min", "max", "hypot"];

const WISHES: [&str; 8] =
    ["", "", "linearize", "linearize(parameters)", "linearize(hessian)", "linearize(inverse)", "taylor", "regressor"];

/// What may stand in a place.
#[derive(Clone, Copy, PartialEq)]
enum Place {
    /// Numbers and fields.
    Constant,
    /// And t and q.
    Definition,
    /// And definitions.
    Position,
    /// And velocities.
    Velocity,
    /// And functions whose derivatives jump.
    Force,
}

/// A struct with its attribute.
pub fn scene(random: &mut Random) -> String {
    let mut clauses: Vec<String> = (0..1 + random.below(3)).map(|_| clause(random)).collect();
    clauses.extend([matter(random), "drive(y = u - h)".to_owned()]);
    let wish = WISHES[random.below(WISHES.len())];
    clauses.extend((!wish.is_empty()).then(|| wish.to_owned()));
    let speeds = match random.below(4) {
        0 => {
            let [a, b, c] = [0; 3].map(|_| position(random));
            format!("speeds(v, w), kinematics(x = v * {a} + {b}, y = w / {c}), ")
        }
        _ => String::new(),
    };
    let circular = if random.below(9) == 0 { Place::Position } else { Place::Definition };
    let (number, gravity) = (["f64", "f64", "f32"][random.below(3)], random.below(2) == 0);
    let gravity = if gravity { "#[gauss(gravity)] g: " } else { "g: " };
    format!(
        "#[gauss(coordinates(x, y), {speeds}define(u = {}, h = {}), {})] struct Scene {{ m: {number}, k: {number}, {gravity}{number} }}",
        scalar(random, Place::Definition, 4),
        scalar(random, circular, 4),
        clauses.join(", ")
    )
}

fn constant(random: &mut Random) -> String {
    scalar(random, Place::Constant, 2)
}

fn position(random: &mut Random) -> String {
    scalar(random, Place::Position, 4)
}

fn velocity(random: &mut Random) -> String {
    scalar(random, Place::Velocity, 4)
}

/// What has mass.
fn matter(random: &mut Random) -> String {
    let one = ["m", "1", "k", "2.5"][random.below(4)];
    let rotation = |random: &mut Random| format!("rotation_{}({})", ["x", "y", "z"][random.below(3)], position(random));
    let own = |random: &mut Random| {
        let [a, b, c, d] = [0; 4].map(|_| constant(random));
        format!("mass = {one}, center_of_mass = [{a}, 0, {b}], inertia = [{c}, {d}, 1]")
    };
    match random.below(5) {
        0 => format!("particle(mass = {one}, position = [x, y, {}])", position(random)),
        1 => format!("particle(mass = {one}, position = {})", vector(random, Place::Position, 3)),
        2 => format!("body(arm, position = [x, y, 0], rotation = {}, {})", rotation(random), own(random)),
        3 => format!(
            "body(arm, rotation = {}, {}), body(hand, parent = arm, position = {}, rotation = {}, {})",
            rotation(random),
            own(random),
            vector(random, Place::Constant, 1),
            rotation(random),
            own(random)
        ),
        _ => format!(
            "particle(mass = {one}, position = [x, 0, 0]), body(arm, rotation = rotation_z(y), {})",
            own(random)
        ),
    }
}

fn clause(random: &mut Random) -> String {
    let k = |random: &mut Random| constant(random);
    match random.below(10) {
        0 => format!("potential = {}", position(random)),
        1 => format!("constraint(position = {})", position(random)),
        2 => format!("constraint(velocity = rate(x) * {} + {})", position(random), velocity(random)),
        3 => format!("drive(x = {})", scalar(random, Place::Force, 4)),
        4 => format!("force(at = {}, value = {})", vector(random, Place::Position, 2), vector(random, Place::Force, 3)),
        5 => format!(
            "spring(from = {}, to = {}, stiffness = {}, length = {})",
            vector(random, Place::Position, 2),
            vector(random, Place::Position, 2),
            k(random),
            k(random)
        ),
        6 => format!("spring(along = {}, stiffness = {}, damping = {})", position(random), k(random), k(random)),
        7 => format!(
            "stop(along = {}, least = {}, stiffness = {}, width = {})",
            position(random),
            k(random),
            k(random),
            k(random)
        ),
        8 => format!("central_gravity(mu = {}, center = {})", k(random), vector(random, Place::Constant, 1)),
        _ => format!("drive(y = smooth_step({}, {}, {}))", position(random), k(random), k(random)),
    }
}

fn vector(random: &mut Random, place: Place, depth: usize) -> String {
    let [x, y, z] = [0; 3].map(|_| scalar(random, place, depth));
    format!("[{x}, {y}, {z}]")
}

fn scalar(random: &mut Random, place: Place, depth: usize) -> String {
    if depth == 0 || random.below(4) == 0 {
        return leaf(random, place);
    }
    let smooth: Vec<&str> = SMOOTH.split(' ').collect();
    let [a, b] = [0; 2].map(|_| scalar(random, place, depth - 1));
    match random.below(16) {
        0..=3 => format!("({a} {} {b})", ["+", "-", "*", "/"][random.below(4)]),
        4 | 5 => format!("({a} * {b})"),
        6..=8 => format!("{}({a})", random.of(&smooth)),
        9 => format!("powi({a}, {})", random.of(&[-2, -1, 0, 2, 3, 9])),
        10 => format!("powf({a}, {})", random.of(&["0.5", "1.5", "-0.5", "k", "1e3"])),
        11 if place == Place::Force => match *random.of(&KINKS) {
            function @ ("abs" | "signum") => format!("{function}({a})"),
            function => format!("{function}({a}, {b})"),
        },
        11 => format!("atan2({a}, {b})"),
        12 => format!("dot([{a}, {b}, 1], [{b}, 2, {a}])"),
        13 if matches!(place, Place::Velocity | Place::Force) => {
            format!("rate({})", scalar(random, Place::Position, depth - 1))
        }
        14 => {
            let (function, times) = (*random.of(&smooth), *random.of(&[2, 5, 24, 60]));
            format!("{}{a}{}", format!("{function}(").repeat(times), ")".repeat(times))
        }
        _ => format!("({a} - {b})"),
    }
}

fn leaf(random: &mut Random, place: Place) -> String {
    let numbers: Vec<&str> = NUMBERS.split(' ').filter(|number| !number.is_empty()).collect();
    let names: &[&str] = match place {
        Place::Constant => &["m", "k"],
        Place::Definition => &["x", "y", "t", "x", "y", "m", "k"],
        Place::Position => &["x", "y", "t", "x", "y", "m", "k", "u", "h"],
        Place::Velocity | Place::Force => &["x", "y", "t", "rate(x)", "rate(y)", "rate(x)", "rate(y)", "k", "u"],
    };
    let name = random.below(if place == Place::Constant { 2 } else { 3 }) > 0;
    (*random.of(if name { names } else { &numbers })).to_owned()
}
