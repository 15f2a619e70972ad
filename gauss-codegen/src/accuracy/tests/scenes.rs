//! Random scenes with numbers that people meet and that make digits cancel, and a state for each.

use crate::accuracy::random::Random;

/// A scene as its author writes it, and one state of it.
#[derive(Default)]
pub struct Scene {
    pub kind: &'static str,
    clauses: Vec<String>,
    coordinates: Vec<String>,
    /// Values of the coordinates: of scalars one number, of poses a quaternion (to be scaled) and a position.
    pub values: Vec<Vec<f64>>,
    /// Speeds are of this size.
    pub speed: f64,
}

pub fn scene(seed: u64) -> Scene {
    let mut random = Random::new(seed);
    let r = &mut random;
    let mut scene = Scene { speed: 10.0_f64.powf(2.0 * r.fraction() - 1.0), ..Scene::default() };
    match seed % 8 {
        0 => scene.tree(r, "offsets", 5.0, 0.0, false),
        1 => scene.tree(r, "far base", 1.0, 0.0, true),
        2 => scene.tree(r, "mass ratios", 1.0, 3.0, false),
        3 => scene.tree(r, "free mass ratios", 1.0, 3.0, true),
        4 => scene.orbit(r),
        5 => scene.curve(r),
        6 => scene.pole(r),
        _ => scene.tether(r),
    }
    scene
}

/// A number with more digits than those that stay exact.
fn number(value: f64) -> String {
    format!("{value:.12e}")
}

fn vector(numbers: [f64; 3]) -> String {
    format!("[{}, {}, {}]", number(numbers[0]), number(numbers[1]), number(numbers[2]))
}

impl Scene {
    /// A scene with coordinates and clauses as they are written.
    pub fn written(coordinates: &[&str], clauses: &str, values: &[&[f64]], speed: f64) -> Self {
        Self {
            kind: "written",
            clauses: vec![clauses.to_owned()],
            coordinates: coordinates.iter().map(|name| (*name).to_owned()).collect(),
            values: values.iter().map(|value| value.to_vec()).collect(),
            speed,
        }
    }

    pub fn source(&self) -> String {
        format!("#[gauss(coordinates({}), {})] struct Scene {{}}", self.coordinates.join(", "), self.clauses.join(", "))
    }

    fn scalar(&mut self, value: f64) -> String {
        let name = format!("q{}", self.coordinates.len());
        self.coordinates.push(name.clone());
        self.values.push(vec![value]);
        name
    }

    fn pose(&mut self, r: &mut Random, far: f64) -> String {
        let name = format!("q{}", self.coordinates.len());
        self.coordinates.push(format!("{name}: Pose"));
        let mut value: Vec<f64> = (0..4).map(|_| r.signed(0.0) * (0.1 + r.fraction())).collect();
        value.extend((0..3).map(|_| far * r.signed(0.3)));
        self.values.push(value);
        name
    }

    /// Mass, mass centre and inertia of a body of the size 1 whose mass is spread over so many decades.
    fn mass(&self, r: &mut Random, decades: f64) -> String {
        let mass = r.size(decades);
        let arms: [f64; 3] = std::array::from_fn(|_| 0.2 + r.fraction());
        let c: [f64; 3] = std::array::from_fn(|_| 0.3 * r.signed(0.3));
        let square: f64 = c.iter().map(|c| c * c).sum();
        let inertia = std::array::from_fn(|i| mass * (arms[(i + 1) % 3] + arms[(i + 2) % 3] + 2.0 * square));
        match r.below(3) {
            0 => format!("mass = {}, inertia = {}", number(mass), vector(inertia)),
            _ => format!("mass = {}, inertia = {}, center_of_mass = {}", number(mass), vector(inertia), vector(c)),
        }
    }

    fn tree(&mut self, r: &mut Random, kind: &'static str, offsets: f64, masses: f64, floating: bool) {
        self.kind = kind;
        let count = 1 + r.below(3);
        for k in 0..count {
            let mut place = String::new();
            if k == 0 && floating {
                let far = 10.0_f64.powf(4.0 + 2.0 * r.fraction());
                let pose = self.pose(r, far);
                place = format!("position = {pose}.position, rotation = {pose}.rotation");
            } else {
                let angle = 3.0 * r.signed(1.0);
                let q = self.scalar(angle);
                if k > 0 {
                    place += &format!("parent = b{}, ", r.below(k));
                }
                let offset = 10.0_f64.powf(offsets * r.fraction());
                let at: [f64; 3] = std::array::from_fn(|_| offset * r.signed(0.5));
                let axis = ["x", "y", "z"][r.below(3)];
                place += &match r.below(4) {
                    0 => {
                        let slide = self.scalar(offset * r.signed(0.5));
                        format!(
                            "position = [{slide} - {}, {}, {}], rotation = rotation_{axis}({q})",
                            number(offset),
                            number(at[1]),
                            number(at[2])
                        )
                    }
                    _ => format!("position = {}, rotation = rotation_{axis}({q})", vector(at)),
                };
            }
            let mass = self.mass(r, masses);
            self.clauses.push(format!("body(b{k}, {place}, {mass})"));
        }
        if r.below(2) == 0 {
            self.clauses.push("gravity = 9.80665".into());
        }
    }

    /// A craft in orbit, with something hinged to it or without.
    fn orbit(&mut self, r: &mut Random) {
        self.kind = "orbit";
        let pose = self.pose(r, 7e6);
        let mass = self.mass(r, 1.0);
        self.clauses.push(format!("body(b0, position = {pose}.position, rotation = {pose}.rotation, {mass})"));
        if r.below(3) > 0 {
            let q = self.scalar(3.0 * r.signed(1.0));
            let mass = self.mass(r, 2.0);
            let at = std::array::from_fn(|_| r.signed(0.5));
            self.clauses
                .push(format!("body(b1, parent = b0, position = {}, rotation = rotation_z({q}), {mass})", vector(at)));
        }
        self.clauses.push("central_gravity(mu = 3.986004418e14)".into());
    }

    /// A particle on a curve or a surface that is written about a point far away.
    fn curve(&mut self, r: &mut Random) {
        self.kind = "curve";
        let c = 10.0_f64.powf(4.0 * r.fraction());
        let (near, y) = (c + 0.5 * r.signed(0.5), r.signed(0.5));
        let x = self.scalar(near);
        let at = number(c);
        let height = r.size(0.5);
        let position = match r.below(5) {
            0 => format!("[{x}, ({x} - {at}).powi({}), 0]", 3 + r.below(2)),
            1 => {
                let y = self.scalar(y);
                format!("[{x}, {y}, {} * (({x} - {at}).powi(2) + {y} * {y}).powi(2)]", number(height))
            }
            2 => {
                let y = self.scalar(y);
                format!("[{x}, {y}, ({x} - {at}) * {y} * {}]", number(height))
            }
            3 => {
                let angle = self.scalar(3.0 * r.signed(1.0));
                format!("[({x} - {at}) * cos({angle}), ({x} - {at}) * sin({angle}), 0]")
            }
            _ => format!("[{x}, {} * exp({at} - {x}), {} * sin({x} - {at})]", number(height), number(height)),
        };
        self.clauses.push(format!("particle(mass = {}, position = {position})", number(r.size(1.0))));
        if r.below(2) == 0 {
            self.clauses.push(format!("potential = {} * ({x} - {at}).powi(4)", number(r.size(1.0))));
        }
        self.clauses.push("gravity = [0.5, -9.80665, 0.25]".into());
    }

    /// A particle on a sphere or a torus in latitude, near a pole.
    fn pole(&mut self, r: &mut Random) {
        self.kind = "pole";
        let near = r.signed(0.0) * std::f64::consts::FRAC_PI_2 + 10.0_f64.powf(-7.0 * r.fraction());
        let (a, b) = (self.scalar(near), self.scalar(3.0 * r.signed(1.0)));
        let (large, small) = (number(1.0 + r.size(0.5)), number(r.size(0.5)));
        let position = match r.below(4) {
            0 => format!("[{small} * cos({a}) * cos({b}), {small} * cos({a}) * sin({b}), {small} * sin({a})]"),
            1 => format!("[{small} * sin({a}) * cos({b}), {small} * sin({a}) * sin({b}), {small} * cos({a})]"),
            2 => {
                let radius = self.scalar(r.size(1.0));
                format!("[{radius} * cos({a}) * cos({b}), {radius} * cos({a}) * sin({b}), {radius} * sin({a})]")
            }
            _ => format!(
                "[({large} + {small} * cos({a})) * cos({b}), ({large} + {small} * cos({a})) * sin({b}), {small} * sin({a})]"
            ),
        };
        self.clauses
            .push(format!("particle(mass = {}, position = {position}), gravity = 9.80665", number(r.size(1.0))));
    }

    /// A body held by a spring that is nearly at rest.
    fn tether(&mut self, r: &mut Random) {
        self.kind = "tether";
        let far = 10.0_f64.powf(3.0 * r.fraction());
        let [x, y] = [far * r.signed(0.5), far * r.signed(0.5)];
        let length = x.hypot(y) * (1.0 + r.signed(0.0) * 10.0_f64.powf(-1.0 - 5.0 * r.fraction()));
        let (mass, stiffness) = (number(r.size(1.0)), number(r.size(3.0)));
        let hook = match r.below(2) {
            0 => {
                let (x, y) = (self.scalar(x), self.scalar(y));
                self.clauses.push(format!("particle(mass = {mass}, position = [{x}, {y}, 0])"));
                format!("[{x}, {y}, 0]")
            }
            _ => {
                let (x, y, a) = (self.scalar(x), self.scalar(y), self.scalar(r.signed(1.0)));
                let body = self.mass(r, 1.0);
                self.clauses.push(format!("body(p, position = [{x}, {y}, 0], rotation = rotation_z({a}), {body})"));
                self.clauses.push("point(hook, body = p, at = [0.01, 0.02, 0])".into());
                "hook".into()
            }
        };
        self.clauses.push(format!(
            "spring(from = [0, 0, 0], to = {hook}, stiffness = {stiffness}, length = {}), gravity = 9.80665",
            number(length)
        ));
    }
}
