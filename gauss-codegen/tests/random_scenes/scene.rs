//! Random scenes as users write them: a struct and its attribute. All are valid: whatever moves has mass, and functions
//! are defined everywhere.

use crate::random::Random;

/// The source of a scene.
pub fn source(seed: u64) -> String {
    let mut random = Random(seed);
    let mut scene = Scene::default();
    match random.below(5) {
        0 => scene.one_body(&mut random),
        1 => scene.curve(&mut random),
        _ => scene.tree(&mut random),
    }
    scene.written(&mut random)
}

#[derive(Default)]
struct Scene {
    clauses: Vec<String>,
    coordinates: Vec<String>,
    /// Those that are scalars.
    scalars: Vec<String>,
    bodies: usize,
    fields: Vec<&'static str>,
}

impl Scene {
    fn written(mut self, random: &mut Random) -> String {
        if !self.coordinates.is_empty() {
            self.clauses.insert(0, format!("coordinates({})", self.coordinates.join(", ")));
        }
        if random.once_in(12) {
            self.clauses.push("linearize".into());
        }
        self.fields.extend(["k: f64", "l: f64"]);
        format!("#[gauss({})] struct Scene {{ {} }}", self.clauses.join(", "), self.fields.join(", "))
    }

    fn scalar(&mut self) -> String {
        let name = format!("q{}", self.coordinates.len());
        self.coordinates.push(name.clone());
        self.scalars.push(name.clone());
        name
    }

    fn group(&mut self, kind: &str) -> String {
        let name = format!("q{}", self.coordinates.len());
        self.coordinates.push(format!("{name}: {kind}"));
        name
    }

    /// One body in a chart.
    fn one_body(&mut self, random: &mut Random) {
        let motion = *random.of(&["free", "free", "fixed_point", "planar"]);
        let mut charts = vec!["left_invariant", "right_invariant", "hybrid"];
        charts.push(if motion == "planar" { "jet" } else { *random.of(&["jet(euler_zyx)", "jet(euler_zxz)"]) });
        let chart = *random.of(&charts);
        self.clauses.push(format!("chart = {chart}, motion = {motion}, {}", mass_data(random, motion == "planar")));
        if random.once_in(2) {
            self.clauses.push(format!("gravity = {}", random.positive()));
        }
        if random.once_in(3) && motion == "free" {
            self.clauses.push(format!("central_gravity(mu = {})", random.positive()));
        }
        if random.once_in(3) && motion != "planar" {
            let (at, value) = (random.vector(Random::number), random.vector(Random::positive));
            self.clauses.push(format!("force(push, at = {at}, value = {value})"));
        }
        if random.once_in(3) && motion == "free" {
            let value = random.coefficient();
            self.clauses.push(format!("potential = {value} * body.position.x"));
        }
    }

    /// A particle on a curve or a surface, near an offset and far from it.
    fn curve(&mut self, random: &mut Random) {
        let [x, y] = [self.scalar(), self.scalar()];
        let (c, d, power) = (random.positive(), random.positive(), 2 + random.below(4));
        let height = match random.below(4) {
            0 => format!("({x} - {c}).powi({power})"),
            1 => format!("{d} * (({x} - {c}).powi(2) + {y} * {y}).powi(2)"),
            2 => format!("sqrt(({x} - {c}).powi(2) + {y} * {y} + {d})"),
            _ => format!("{d} * sin({x} - {c}) + {y} / {c}"),
        };
        let (mass, gravity) = (random.positive(), random.positive());
        self.clauses.push(format!("particle(mass = {mass}, position = [{x}, {y}, {height}]), gravity = {gravity}"));
        self.loads(random);
    }

    /// Bodies, each hung on one before it or on nothing, and particles on them.
    fn tree(&mut self, random: &mut Random) {
        let count = 1 + random.below(3);
        for k in 0..count {
            let parent = if k > 0 && !random.once_in(4) { Some(random.below(k)) } else { None };
            self.link(random, k, parent);
        }
        self.bodies = count;
        if random.once_in(2) {
            self.particle(random);
        }
        if random.once_in(2) {
            self.clauses.push(match random.below(2) {
                0 => format!("gravity = {}", random.positive()),
                _ => format!("gravity = {}", random.vector(Random::number)),
            });
        }
        self.loads(random);
    }

    fn link(&mut self, random: &mut Random, k: usize, parent: Option<usize>) {
        let mut place = parent.map_or(String::new(), |parent| format!(", parent = b{parent}"));
        let axis = ["x", "y", "z"];
        let turn = |random: &mut Random, angle: String| format!("rotation_{}({angle})", random.of(&axis));
        match random.below(6) {
            0 if parent.is_none() => {
                let pose = self.group("Pose");
                place += &format!(", position = {pose}.position, rotation = {pose}.rotation");
            }
            1 => {
                let rotation = self.group("Rotation");
                place += &format!(", position = {}, rotation = {rotation}", random.vector(Random::number));
            }
            2 => {
                let slide = self.scalar();
                let position = format!("[{slide} + {}, {}, {}]", random.number(), random.number(), random.number());
                let fixed = random.number();
                place += &format!(", position = {position}, rotation = {}", turn(random, fixed));
            }
            3 => {
                let [a, b] = [self.scalar(), self.scalar()];
                let position = random.vector(Random::number);
                place += &format!(", position = {position}, rotation = rotation_z({a}) * rotation_x({b})");
            }
            _ => {
                let angle = self.scalar();
                let position = random.vector(|random| match random.below(3) {
                    0 => random.coefficient(),
                    _ => random.number(),
                });
                place += &format!(", position = {position}, rotation = {}", turn(random, angle));
            }
        }
        self.clauses.push(format!("body(b{k}{place}, {})", mass_data(random, false)));
    }

    fn particle(&mut self, random: &mut Random) {
        let angle = self.scalar();
        let (arm, mass) = (random.coefficient(), random.positive());
        let position = match random.below(3) {
            0 => format!("[{arm} * sin({angle}), {}, -{arm} * cos({angle})]", random.number()),
            1 => format!("[{angle} - {}, {}, {}]", random.positive(), random.number(), random.number()),
            _ => format!("[l * sin({angle}), {}, -l * cos({angle})]", random.number()),
        };
        let parent = random.below(self.bodies);
        self.clauses.push(format!("particle(mass = {mass}, parent = b{parent}, position = {position})"));
    }

    fn loads(&mut self, random: &mut Random) {
        let Some(q) = self.scalars.last().cloned() else { return };
        if random.once_in(3) {
            let (c, d, k) = (random.positive(), random.positive(), random.coefficient());
            let function = match random.below(6) {
                0 => format!("({q} - {c}).powi(2)"),
                1 => format!("sqrt({q} * {q} + {c})"),
                2 => format!("ln({q} * {q} + {c})"),
                3 => format!("hypot({q} - {d}, {c})"),
                4 => format!("exp(-({q} / {c}).powi(2))"),
                _ => format!("1 / ({q} * {q} + {c} * {d})"),
            };
            self.clauses.push(format!("potential = {k} * {function}"));
        }
        if self.bodies > 0 && random.once_in(3) {
            let body = random.below(self.bodies);
            let (from, at) = (random.vector(Random::number), random.vector(Random::positive));
            let (stiffness, length) = (random.coefficient(), random.positive());
            self.clauses.push(format!(
                "point(hook, body = b{body}, at = {at}), \
                 spring(from = {from}, to = hook, stiffness = {stiffness}, length = {length})"
            ));
        }
        if self.bodies > 0 && random.once_in(5) {
            let body = random.below(self.bodies);
            let value = random.vector(Random::number);
            self.clauses.push(format!("torque(motor, body = b{body}, value = {value})"));
        }
    }
}

/// Mass, inertia and centre of mass of a body, about which nothing is said that no body has.
fn mass_data(random: &mut Random, plane: bool) -> String {
    let mut data = format!("mass = {}", random.positive());
    data += &match random.below(3) {
        _ if plane => format!(", inertia = {}", random.positive()),
        0 => format!(", inertia = {}", random.positive()),
        1 => format!(", inertia = k * {}", random.vector(Random::ordinary)),
        _ => format!(", inertia = {}", random.vector(Random::positive)),
    };
    if random.once_in(2) {
        let z = |random: &mut Random| if plane { "0".into() } else { random.number() };
        let (x, y) = (random.number(), random.number());
        data += &format!(", center_of_mass = [{x}, {y}, {}]", z(random));
    }
    data
}
