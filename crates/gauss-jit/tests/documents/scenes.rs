//! Scenes that have a counterpart in MJCF, and their motions in the rates of its joints.

use std::sync::OnceLock;

use gauss_codegen::Bodies;
use gauss_jit::{DocumentError, Kernel, Mjcf, Model, QuantityKind, Urdf};
use gauss_runtime::nalgebra::{Quaternion, UnitQuaternion, Vector3};

use crate::common::{Random, robot};

/// Configuration and speeds of a scene with loops.
type ClosedState = fn(&mut Random) -> [Vec<f64>; 2];

/// A scene with its parameters.
#[derive(Clone)]
pub struct Example {
    pub name: &'static str,
    pub source: String,
    pub parameters: Vec<(&'static str, Vec<f64>)>,
    /// The linear speeds of a pose are rates of its position, not seen from the body.
    pub hybrid: bool,
    /// A state in which loops are closed, in place of any one.
    pub closed: Option<ClosedState>,
    /// Inputs are 0.
    pub idle: bool,
    pub kernel: OnceLock<Kernel>,
    pub mjcf: OnceLock<Mjcf>,
    pub urdf: OnceLock<Option<Urdf>>,
}

/// The state of one joint, as MuJoCo has it: `qpos`, `qvel`, `qacc`.
pub struct JointState {
    pub name: String,
    pub place: Vec<f64>,
    pub rates: Vec<f64>,
    pub accelerations: Vec<f64>,
}

/// The motion of a scene in one state.
pub struct Motion {
    pub inputs: Vec<f64>,
    pub energy: f64,
    /// Generalised forces of all loads but weight, of the speeds of the scene.
    pub forces: Vec<f64>,
    /// Gaps of contacts by their names.
    pub gaps: Vec<(String, f64)>,
    pub joints: Vec<JointState>,
}

/// The scene, the numbers of its parameters.
fn scene(name: &'static str, clauses: &str, fields: &str, parameters: &[(&'static str, &[f64])]) -> Example {
    let parameters = parameters.iter().map(|(name, own)| (*name, own.to_vec())).collect();
    let source = format!("#[gauss({clauses})] struct Scene {{ {fields} }}");
    let (kernel, mjcf, urdf) = Default::default();
    Example { name, source, parameters, hybrid: false, closed: None, idle: false, kernel, mjcf, urdf }
}

/// A robot's file without what is soft in MuJoCo.
fn file(name: &'static str, format: &str, clauses: &str) -> Example {
    let path = robot(name);
    let clauses = format!("{format} = {:?}, {clauses}", path.to_string_lossy());
    scene(name, &clauses, "", &[])
}

/// A body's mass, centre of mass and inertia about O.
const BODY: [&[f64]; 3] = [&[1.3], &[0.02, -0.03, -0.25], &[0.21, 0.01, 0.02, 0.01, 0.23, -0.015, 0.02, -0.015, 0.06]];

/// All scenes. Each is derived once for all tests.
pub fn examples() -> &'static [Example] {
    static ALL: OnceLock<Vec<Example>> = OnceLock::new();
    ALL.get_or_init(all)
}

fn all() -> Vec<Example> {
    let mut list = written();
    list.extend([
        file("panda.urdf", "urdf", "gravity = 9.81, limits = none, saturation = none, waive(triangle_inequality)"),
        file("quadruped.urdf", "urdf", "base = floating, gravity = 9.81, limits = none, saturation = none"),
        file("robotiq_2f_85.urdf", "urdf", "gravity = 9.81, limits = none, saturation = none"),
        file("quadrotor.xml", "mjcf", "inputs = actuators"),
        file("arms.xml", "mjcf", "gravity = 9.81"),
        file("limited.xml", "mjcf", "inputs = actuators, saturation = none"),
        file("footed.xml", "mjcf", "inputs = actuators, saturation = none"),
    ]);
    list
}

fn written() -> Vec<Example> {
    let body = |name: &'static str| {
        let parts = ["mass", "center_of_mass", "inertia"].into_iter().zip(BODY);
        parts.map(move |(part, own)| (&*format!("{name}.{part}").leak(), own))
    };
    let bodies = |names: &[&'static str], more: &[(&'static str, &'static [f64])]| {
        names.iter().flat_map(|name| body(name)).chain(more.iter().copied()).collect::<Vec<_>>()
    };
    let arms = bodies(&["upper", "lower"], &[("k", &[5.0]), ("l", &[0.5])]);
    let ball = bodies(&["arm", "bob"], &[("l", &[0.4])]);
    vec![
        scene(
            "pendulum",
            "coordinates(angle), particle(mass = m, position = [l * sin(angle), 0, -l * cos(angle)]), gravity = 9.81,
             friction(along = angle, viscous = 0.3), input(torque), drive(angle = torque)",
            "m: f64, l: f64",
            &[("m", &[1.5]), ("l", &[0.7])],
        ),
        scene(
            "spherical pendulum",
            "coordinates(a, b), particle(mass = m, position = [l * sin(a) * cos(b), l * sin(a) * sin(b), -l * cos(a)]),
             gravity = 9.81",
            "m: f64, l: f64",
            &[("m", &[1.5]), ("l", &[0.7])],
        ),
        scene(
            "double pendulum",
            "coordinates(a, b), input(motor), gravity = 9.81,
             body(upper, rotation = rotation_y(a)),
             body(lower, parent = upper, position = [0, 0.1, -l], rotation = rotation_x(0.4) * rotation_y(b)),
             spring(along = a - b, stiffness = k, length = -0.1, damping = 0.4),
             spring(along = a, stiffness = 3, length = 0.3), drive(a = motor, b = -2 * motor)",
            "#[gauss(body)] upper: RigidBody<f64>, #[gauss(body)] lower: RigidBody<f64>, k: f64, l: f64",
            &arms,
        ),
        scene(
            "cart and pole",
            "coordinates(x, angle), input(push), drive(x = push), gravity = 9.81, armature(x = 0.2, angle = 0.01),
             particle(mass = 1.2, position = [x, 0, 0]),
             body(bob, position = [x - l * sin(angle), 0, -l * cos(angle)], rotation = rotation_y(angle), mass = 0.2,
                  inertia = 1e-4)",
            "l: f64",
            &[("l", &[0.5])],
        ),
        scene(
            "gantry",
            "coordinates(x, y, angle), gravity = 9.81, particle(mass = 2, position = [x, 0, 0]),
             particle(mass = 1, position = [x, y, 0]),
             body(load, position = [x, y, -0.1], rotation = rotation_x(angle), mass = 0.4,
                  center_of_mass = [0, 0, -0.3], inertia = [0.05, 0.05, 0.001]),
             damping = 0.1 * powi(rate(x - y), 2) + 0.05 * powi(rate(angle), 2)",
            "",
            &[],
        ),
        scene(
            "free body",
            "coordinates(craft: Pose), body(hull, pose = craft), gravity = 9.81, input(thrust, roll),
             wrench(body = hull, at = [0.1, 0.2, 0], force = [0, 0, thrust], torque = [roll, 0, -0.02 * thrust])",
            "#[gauss(body)] hull: RigidBody<f64>",
            &bodies(&["hull"], &[]),
        ),
        scene(
            "ball on an arm",
            "coordinates(turn: Rotation, angle), gravity = [1, -2, -9], input(u, v),
             body(arm, position = [0, 0, 1], rotation = rotation_x(0.3) * rotation_y(angle)),
             body(bob, parent = arm, position = [l, 0, 0], rotation = rotation_z(0.5) * turn * rotation_x(0.2)),
             torque(body = bob, value = [u, 0, 0.5 * u], reaction = arm), torque(body = arm, value = [0, v, 0])",
            "#[gauss(body)] arm: RigidBody<f64>, #[gauss(body)] bob: RigidBody<f64>, l: f64",
            &ball,
        ),
        scene(
            "top",
            "chart = jet(euler_zyx), motion = fixed_point, mass = m, inertia = [0.2, 0.2, 0.1],
             center_of_mass = [0, 0, 0.4], gravity = 9.81",
            "m: f64",
            &[("m", &[0.9])],
        ),
        scene(
            "plate in the plane",
            "chart = jet, motion = planar, mass = 2, inertia = 0.3, center_of_mass = [0.1, 0.2, 0], gravity = 9.81",
            "",
            &[],
        ),
        Example {
            hybrid: true,
            ..scene(
                "body in its hybrid chart",
                "chart = hybrid, mass = 2, inertia = [0.3, 0.2, 0.4], center_of_mass = [0.1, 0.2, 0], gravity = 9.81",
                "",
                &[],
            )
        },
        scene(
            "hopper",
            "coordinates(x, z, a, b), gravity = 9.81,
             body(hull, position = [x, 0, z], rotation = rotation_y(a), mass = 2, inertia = 0.1),
             body(leg, parent = hull, position = [0.1, 0, -0.3], rotation = rotation_y(b), mass = 0.4, inertia = 0.02),
             point(toe, body = leg, at = [0.05, 0, -0.4]),
             contact(heel, point = leg.position, radius = 0.07, plane = [0.6, 0, 0.8], height = 0.05, friction = 0.6,
                     rolling = 0.01),
             contact(tip, point = toe, friction = 0.3, restitution = 0.2),
             contact(trunk, point = hull.position, edges = [0.4, 0, 0.2]),
             range(knee, along = b, from = -0.5, to = 1), range(lift, along = z, to = 2),
             dry_friction(brake, slip = rate(b), bound = 0.3)",
            "",
            &[],
        ),
        scene(
            "gears",
            "coordinates(a, b, y), gravity = 9.81, input(torque), drive(a = torque), armature(a = 0.1),
             friction(along = b, viscous = 0.2),
             body(wheel, rotation = rotation_x(a), mass = 1, inertia = 0.1),
             body(pinion, position = [0, 0.4, 0], rotation = rotation_x(0.4 - 3 * a), mass = 0.3, inertia = 0.01),
             body(arm, parent = wheel, position = [0, 0, 0.5], rotation = rotation_y(b), mass = 0.4,
                  center_of_mass = [0.1, 0, 0.2], inertia = [0.05, 0.06, 0.03]),
             body(hand, parent = arm, position = [0, 0, 0.4], rotation = rotation_z(0.5 * a), mass = 0.2,
                  center_of_mass = [0, 0.1, 0], inertia = [0.01, 0.01, 0.01]),
             particle(mass = 0.3, position = [0, y, 1]), particle(mass = 0.1, position = [0, 0, 2 * y])",
            "",
            &[],
        ),
        scene(
            "two balls",
            "coordinates(a: Pose, b: Pose), gravity = 9.81, frame(post, position = [0.2, 0.3, -2]),
             body(one, pose = a, mass = 1, inertia = 0.1), body(two, pose = b, mass = 2, inertia = 0.3),
             point(knob, body = two, at = [0, 0.1, 0.2]), point(top, body = post, at = [0, 0, 0.1]),
             contact(balls, point = one.position, radius = 0.1, other = knob, other_radius = 0.2, along = [0, 0, 1],
                     friction = 0.4),
             contact(stop, point = one.position, radius = 0.1, other = top, other_radius = 0.3)",
            "",
            &[],
        ),
        Example {
            closed: Some(parallelogram),
            ..scene(
                "parallelogram",
                "coordinates(a, b, c), gravity = 9.81, spring(along = a, stiffness = 3),
                 body(crank, rotation = rotation_y(a), mass = 1, inertia = 0.1),
                 body(coupler, parent = crank, position = [0.3, 0, 0], rotation = rotation_y(b), mass = 2, inertia = 0.2),
                 body(rocker, position = [0.5, 0, 0], rotation = rotation_y(c), mass = 0.7, inertia = 0.1),
                 point(end, body = coupler, at = [0.5, 0, 0]), point(pin, body = rocker, at = [0.3, 0, 0]),
                 constraint(position = end - pin)",
                "",
                &[],
            )
        },
        Example {
            closed: Some(tethered),
            ..scene(
                "tethered body",
                "coordinates(craft: Pose), body(hull, pose = craft, mass = 2, center_of_mass = [0, 0, -0.1], inertia = 0.3),
                 gravity = 9.81, point(hook, body = hull, at = [0.1, 0.2, 0.3]), constraint(position = hook - [0, 0, 1])",
                "",
                &[],
            )
        },
        scene(
            "branches",
            "coordinates(x, a, b), gravity = 9.81, frame(turned, rotation = rotation_z(a)),
             body(arm, parent = turned, position = [0, 0.1, 0], rotation = rotation_y(b), mass = 1,
                  inertia = [0.1, 0.2, 0.3]),
             body(slider, parent = turned, position = [0.2, x, 0], mass = 2, inertia = [0.1, 0.1, 0.1])",
            "",
            &[],
        ),
    ]
}

/// Every other state is at rest.
fn rate(random: &mut Random) -> f64 {
    let rate = random.list(1)[0];
    if random.list(1)[0] > 0.0 { 0.0 } else { rate }
}

/// The coupler stays level, far from where all bars are on one line.
fn parallelogram(random: &mut Random) -> [Vec<f64>; 2] {
    let (a, rate) = (1.3 + 0.5 * random.list(1)[0], rate(random));
    [vec![a, -a, a], vec![rate, -rate, rate]]
}

/// The hook is at (0, 0, 1).
fn tethered(random: &mut Random) -> [Vec<f64>; 2] {
    let hook = Vector3::new(0.1, 0.2, 0.3);
    let turn = UnitQuaternion::from_scaled_axis(Vector3::from_column_slice(&random.list(3)));
    let omega = Vector3::from_column_slice(&random.list(3)) * rate(random);
    let place = Vector3::z() - turn * hook;
    [[turn.coords.as_slice(), place.as_slice()].concat(), [(-omega.cross(&hook)).as_slice(), omega.as_slice()].concat()]
}

impl Example {
    pub fn numbers(&self) -> Vec<(&str, &[f64])> {
        self.parameters.iter().map(|(name, own)| (*name, &own[..])).collect()
    }

    pub fn mjcf(&self) -> &Mjcf {
        let made = || Mjcf::new(&self.source, &self.numbers());
        self.mjcf.get_or_init(|| made().unwrap_or_else(|error| panic!("{}: {error}", self.name)))
    }

    /// A document of URDF, of all scenes without ball joints.
    pub fn urdf(&self) -> Option<&Urdf> {
        let made = || match Urdf::new(&self.source, &self.numbers()) {
            Ok(made) => Some(made),
            Err(DocumentError::NoCounterpart { list, .. })
                if list.iter().all(|line| line.contains("no ball joints") || line.contains("loops (`constraint`)")) =>
            {
                None
            }
            Err(error) => panic!("{}: {error}", self.name),
        };
        self.urdf.get_or_init(made).as_ref()
    }

    pub fn kernel(&self) -> &Kernel {
        self.kernel.get_or_init(|| {
            let model = Model::from_source(&self.source).unwrap_or_else(|error| panic!("{}: {error}", self.name));
            model.kernel(&self.numbers()).unwrap_or_else(|error| panic!("{}: {error}", self.name))
        })
    }

    /// A state of general position with its accelerations.
    pub fn motion(&self, kernel: &Kernel, random: &mut Random) -> Motion {
        let model = kernel.model();
        let mut q = random.list(model.arguments("mass_matrix").expect("a method")[1].components.len());
        for unit in model.unit_components() {
            let length = q[unit.clone()].iter().map(|x| x * x).sum::<f64>().sqrt();
            q[unit.clone()].iter_mut().for_each(|x| *x /= length);
        }
        let count = model.description().speeds.iter().map(|own| own.numbers.len()).sum();
        let mut z = random.list(count);
        if let Some(closed) = self.closed {
            [q, z] = closed(random);
        }
        let mut u = random.list(model.description().inputs.iter().map(|own| own.numbers.len()).sum());
        if self.idle {
            u.fill(0.0);
        }
        let z_dot = kernel.acceleration(0.0, &q, &z, &u).expect("accelerations");
        let joints = self.joints(kernel, &q, &z, &z_dot);
        let energy = kernel.kinetic_energy(0.0, &q, &z).expect("an energy");
        let contacts = model.description().contacts.iter().map(|own| own.name.clone());
        let gaps = kernel.call("gaps", &[&[0.0], &q]).unwrap_or_default();
        let forces = self.forces(kernel, [&q, &z, &u]);
        Motion { inputs: u, energy, forces, gaps: contacts.zip(gaps).collect(), joints }
    }

    fn forces(&self, kernel: &Kernel, [q, z, u]: [&[f64]; 3]) -> Vec<f64> {
        let elements = Bodies::of_text(&self.source).expect("bodies").elements;
        let count = kernel.model().arguments("element_forces").map_or(0, |list| list.len());
        let all = kernel.call("element_forces", &[&[0.0], q, z, u][..count]).unwrap_or_default();
        let row = |k: usize| {
            let own = all.iter().skip(k * elements.len()).zip(&elements);
            own.filter(|(_, name)| *name != "gravity").map(|(force, _)| force).sum()
        };
        (0..z.len()).map(row).collect()
    }

    /// Joints in the order of the coordinates, whose speeds stand in the same order.
    pub fn joints(&self, kernel: &Kernel, q: &[f64], z: &[f64], z_dot: &[f64]) -> Vec<JointState> {
        let coordinates = &kernel.model().description().coordinates;
        let groups: usize = coordinates.iter().map(|own| components(own.kind)).sum();
        let (mut group, mut scalar, mut first) = (0, groups, 0);
        let mut list = Vec::new();
        for own in coordinates {
            let (name, rates) = (own.name.clone(), rates(own.kind));
            let (v, a) = (&z[first..first + rates], &z_dot[first..first + rates]);
            first += rates;
            let place = if components(own.kind) == 0 {
                scalar += 1;
                q[scalar - 1..scalar].to_vec()
            } else {
                group += components(own.kind);
                q[group - components(own.kind)..group].to_vec()
            };
            list.push(self.joint(name, own.kind, place, [v, a]));
        }
        list
    }

    fn joint(&self, name: String, kind: QuantityKind, q: Vec<f64>, [v, a]: [&[f64]; 2]) -> JointState {
        let (mut place, mut rates, mut accelerations) = (q.clone(), v.to_vec(), a.to_vec());
        if matches!(kind, QuantityKind::Rotation | QuantityKind::Pose) {
            place = [&q[4..], &q[3..4], &q[..3]].concat();
        }
        if kind == QuantityKind::Pose && !self.hybrid {
            let turn = UnitQuaternion::from_quaternion(Quaternion::new(q[3], q[0], q[1], q[2]));
            let [u, omega, u_dot] = [&v[..3], &v[3..], &a[..3]].map(Vector3::from_column_slice);
            rates[..3].copy_from_slice((turn * u).as_slice());
            accelerations[..3].copy_from_slice((turn * (u_dot + omega.cross(&u))).as_slice());
        }
        JointState { name, place, rates, accelerations }
    }
}

impl JointState {
    /// Derivatives of the rates that are seen from the body.
    pub fn body_accelerations(&self) -> Vec<f64> {
        let (mut accelerations, rates) = (self.accelerations.clone(), self.body_rates());
        if let [.., w, x, y, z] = self.place[..]
            && rates.len() == 6
        {
            let turn = UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z));
            let [u, omega, a] = [&rates[..3], &rates[3..], &accelerations[..3]].map(Vector3::from_column_slice);
            accelerations[..3].copy_from_slice((turn.inverse() * a - omega.cross(&u)).as_slice());
        }
        accelerations
    }

    /// Rates that are seen from the body.
    pub fn body_rates(&self) -> Vec<f64> {
        let mut rates = self.rates.clone();
        if let [.., w, x, y, z] = self.place[..]
            && rates.len() == 6
        {
            let turn = UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z));
            let seen = turn.inverse() * Vector3::from_column_slice(&rates[..3]);
            rates[..3].copy_from_slice(seen.as_slice());
        }
        rates
    }
}

fn components(kind: QuantityKind) -> usize {
    match kind {
        QuantityKind::Pose => 7,
        QuantityKind::Rotation | QuantityKind::Plane => 4,
        QuantityKind::Scalar | QuantityKind::Vector(_) => 0,
    }
}

fn rates(kind: QuantityKind) -> usize {
    match kind {
        QuantityKind::Pose => 6,
        QuantityKind::Rotation | QuantityKind::Plane => 3,
        QuantityKind::Scalar | QuantityKind::Vector(_) => 1,
    }
}
