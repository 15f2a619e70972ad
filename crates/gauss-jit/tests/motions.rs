//! Coordinates that are driven, `motion(x = f(t))`, read at run time: beside known equations, beside the same motion
//! under a constraint with its multiplier, and beside inverse dynamics of the whole.

use std::path::PathBuf;

use gauss_jit::{Kernel, Model};

/// A pseudo-random number between −1 and 1.
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64 * 2.0 - 1.0
    }

    fn list(&mut self, count: usize) -> Vec<f64> {
        (0..count).map(|_| self.next()).collect()
    }
}

fn model(source: &str) -> Model {
    Model::from_source(source).unwrap_or_else(|mistakes| panic!("{source}: {mistakes}"))
}

fn kernel(model: &Model, values: &[(&str, &[f64])]) -> Kernel {
    model.kernel(values).expect("a kernel")
}

fn largest(numbers: &[f64]) -> f64 {
    numbers.iter().fold(0.0, |most, x| most.max(x.abs()))
}

/// Force and power of each motion, in the motion at a state.
fn driving_forces(kernel: &Kernel, t: f64, [q, z, u]: [&[f64]; 3]) -> Vec<f64> {
    let rates = kernel.acceleration(t, q, z, u).unwrap();
    driving_forces_at(kernel, t, [q, z, &rates, u])
}

fn driving_forces_at(kernel: &Kernel, t: f64, [q, z, a, u]: [&[f64]; 4]) -> Vec<f64> {
    let method = kernel.method("driving_forces_at").unwrap();
    let mut results = vec![0.0; method.outputs()];
    let arguments: [&[f64]; 5] = [&[t], q, z, a, u];
    let count = method.arguments().len();
    method.call(&arguments[..count], &mut results).unwrap();
    results
}

/// A bob on a trolley, with what acts on the trolley.
fn crane(clauses: &str) -> String {
    format!(
        "#[gauss(coordinates(x, angle), gravity = 9.81, {clauses},
           body(trolley, position = [x, 0, 0], mass = big, inertia = 1),
           body(bob, parent = trolley, rotation = rotation_y(angle), mass = m, center_of_mass = [0, 0, -l],
                inertia_about_center_of_mass = 0))]
         struct Crane {{ big: f64, m: f64, l: f64, a: f64, w: f64 }}"
    )
}

const NUMBERS: [(&str, &[f64]); 5] = [("big", &[2.0]), ("m", &[0.7]), ("l", &[0.4]), ("a", &[0.3]), ("w", &[2.5])];

/// Equations by hand: l φ̈ = ẍ cos φ − g sin φ, as rotation_y(φ) takes the bob to x − l sin φ; the force is the rate of
/// the momentum of both.
#[test]
fn a_pendulum_on_a_trolley() {
    let driven = model(&crane("motion(x = a * sin(w * t))"));
    let kernel = kernel(&driven, &NUMBERS);
    let [big, m, l, a, w] = [2.0, 0.7, 0.4, 0.3, 2.5];
    let mut random = Random(3);
    for _ in 0..6 {
        let [t, phi, rate] = [3.0 * random.next(), 2.0 * random.next(), 4.0 * random.next()];
        let ([sine, cosine], acceleration) = ([phi.sin(), phi.cos()], -a * w * w * (w * t).sin());
        let expected = (acceleration * cosine - 9.81 * sine) / l;
        let found = kernel.acceleration(t, &[phi], &[rate], &[]).unwrap()[0];
        // A few products of numbers up to 30.
        let rounding = 100.0 * f64::EPSILON;
        assert!((found - expected).abs() <= rounding * 30.0, "{found} {expected}");
        let [force, power] = driving_forces(&kernel, t, [&[phi], &[rate], &[]])[..] else { panic!("a force") };
        let bob = acceleration - l * (expected * cosine - rate * rate * sine);
        let by_hand = big * acceleration + m * bob;
        assert!((force - by_hand).abs() <= rounding * 30.0, "{force} {by_hand}");
        assert!((power - by_hand * a * w * (w * t).cos()).abs() <= rounding * 30.0, "{power}");
    }
}

/// The same motion by a multiplier: ∂φ/∂x = 1, so that λ is the force, whichever else acts on the coordinate.
#[test]
fn driving_forces_are_multipliers() {
    let loads = [
        "",
        "spring(hold, along = x - angle, stiffness = 3, damping = 0.4), armature(x = 0.7)",
        "input(push), drive(x = push * cos(angle)), damping = 0.3 * rate(x) * rate(x) + rate(x) * rate(angle) * 0.1",
        "spring(post, along = x, stiffness = 8, damping = 2), potential = x * angle * 0.4",
        "friction(rail, along = x, viscous = 0.3, dry = 2, width = 0.1), input(u), torque(body = bob, value = [0, u, 0])",
        "force(body = trolley, value = [1.5 * angle, 0.3, 0])",
    ];
    let motions = ["a * sin(w * t)", "w", "a * exp(-w * t) + t * t", "tanh(t) * w"];
    for load in loads {
        for motion in motions {
            let comma = if load.is_empty() { "" } else { ", " };
            let driven = model(&crane(&format!("motion(x = {motion}){comma}{load}")));
            let whole = model(&crane(&format!("constraint(position = x - ({motion})){comma}{load}")));
            beside_multiplier(&format!("{motion} {load}"), (&driven, motion), &whole);
        }
    }
}

/// The function, its rate and second rate by hand.
fn by_hand(motion: &str, t: f64) -> [f64; 2] {
    let (a, w): (f64, f64) = (0.3, 2.5);
    match motion {
        "w" => [w, 0.0],
        "a * sin(w * t)" => [a * (w * t).sin(), a * w * (w * t).cos()],
        "tanh(t) * w" => [t.tanh() * w, w * (1.0 - t.tanh().powi(2))],
        _ => [a * (-w * t).exp() + t * t, -a * w * (-w * t).exp() + 2.0 * t],
    }
}

fn beside_multiplier(what: &str, (driven, motion): (&Model, &str), whole: &Model) {
    let (own, constrained) = (kernel(driven, &NUMBERS), kernel(whole, &NUMBERS));
    let mut random = Random(11);
    for _ in 0..4 {
        let t = random.next();
        let (q, z) = (random.list(1), random.list(1));
        let u = random.list(driven.description().inputs.len());
        let [x, rate] = by_hand(motion, t);
        let all = ([x, q[0]], [rate, z[0]]);
        let expected = constrained.acceleration(t, &all.0, &all.1, &u).unwrap();
        let found = own.acceleration(t, &q, &z, &u).unwrap()[0];
        let method = constrained.method("multipliers").unwrap();
        let mut multiplier = [0.0];
        let arguments: [&[f64]; 4] = [&[t], &all.0, &all.1, &u];
        method.call(&arguments[..method.arguments().len()], &mut multiplier).unwrap();
        let [force, power] = driving_forces(&own, t, [&q, &z, &u])[..] else { panic!("a force") };
        // Some fifty products; the multiplier is solved for with a matrix of condition below thirty.
        let rounding = 1500.0 * f64::EPSILON;
        let size = 1.0 + largest(&expected) + multiplier[0].abs();
        assert!((found - expected[1]).abs() <= rounding * size, "{what}: {found} {expected:?}");
        assert!((force - multiplier[0]).abs() <= rounding * size, "{what}: {force} {multiplier:?}");
        assert!((power - force * rate).abs() <= rounding * size * rate.abs(), "{what}: {power}");
    }
}

fn robot(name: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../tests/robots").join(name)
}

fn names(list: &[gauss_jit::Quantity]) -> Vec<String> {
    list.iter().flat_map(|quantity| &quantity.numbers).cloned().collect()
}

/// Names of the numbers of a configuration: those of groups first.
fn configuration(model: &Model) -> Vec<String> {
    let scalar = |quantity: &&gauss_jit::Quantity| quantity.numbers.len() == 1;
    let all = &model.description().coordinates;
    let ordered = all.iter().filter(|quantity| !scalar(quantity)).chain(all.iter().filter(scalar));
    ordered.flat_map(|quantity| &quantity.numbers).cloned().collect()
}

/// A configuration at random, with rotations of length one.
fn place(model: &Model, random: &mut Random) -> Vec<f64> {
    let mut q = random.list(configuration(model).len());
    for unit in model.unit_components() {
        let length = q[unit.clone()].iter().map(|x| x * x).sum::<f64>().sqrt();
        q[unit.clone()].iter_mut().for_each(|x| *x /= length);
    }
    q
}

/// The numbers of a longer list of names: those of a shorter one, and one value of another.
fn whole(long: &[String], short: &[String], values: &[f64], driven: (&str, f64)) -> Vec<f64> {
    let of = |name: &String| short.iter().position(|own| own == name).map(|place| values[place]);
    long.iter().map(|name| of(name).unwrap_or(if name == driven.0 { driven.1 } else { 0.0 })).collect()
}

/// A driven joint of a robot: its torque is the row of inverse dynamics of the whole at the same q, q̇, q̈, with no input
/// there, and rows that are free have no force left.
#[test]
fn driven_joints_of_robots() {
    let arm: &[&str] = &["gravity = 9.81"];
    let legs: &[&str] = &["gravity = 9.81", "base = floating", "limits = none", "saturation = none"];
    let hand: &[&str] = &["gravity = 9.81", "joint_friction = smooth(0.01)", "limits = none", "saturation = none"];
    let servos: &[&str] = &["gravity = 9.81", "inputs = actuators", "saturation = clamp", "limits = none"];
    let linkage: &[&str] = &["inputs = actuators", "saturation = none", "limits = none"];
    let robots: [(&str, &[&str], &str); 7] = [
        ("panda.urdf", arm, "panda_joint2"),
        ("panda.urdf", arm, "panda_finger_joint1"),
        ("anymal.urdf", legs, "LF_KFE"),
        // A joint that another follows, and one about an axis of no frame.
        ("gripper.urdf", hand, "left"),
        ("gripper.urdf", hand, "elbow"),
        ("servos.xml", servos, "elbow"),
        ("linkage.xml", linkage, "pitch"),
    ];
    for (name, clauses, joint) in robots {
        let of_file = |clauses: &[&str]| match name.ends_with("xml") {
            true => Model::from_mjcf(robot(name), clauses),
            false => Model::from_urdf(robot(name), clauses),
        };
        let full = of_file(clauses).unwrap_or_else(|mistakes| panic!("{name}: {mistakes}"));
        let motion = format!("motion({joint} = 0.3 + 0.4 * sin(1.7 * t))");
        let with: Vec<&str> = clauses.iter().copied().chain([motion.as_str()]).collect();
        let driven = of_file(&with).unwrap_or_else(|mistakes| panic!("{name}: {mistakes}"));
        assert_eq!(driven.description().motions, [joint], "{name}");
        beside_inverse_dynamics(&format!("{name} {joint}"), (&full, &driven), joint);
    }
}

fn beside_inverse_dynamics(what: &str, (full, driven): (&Model, &Model), joint: &str) {
    let (all, own) = (kernel(full, &[]), kernel(driven, &[]));
    let [rates, left] = [full, driven].map(|model| names(&model.description().speeds));
    let [inputs, kept] = [full, driven].map(|model| names(&model.description().inputs));
    let [long, short] = [full, driven].map(configuration);
    let rate_name = rates.iter().find(|name| !left.contains(name)).expect("one less").clone();
    let row = rates.iter().position(|name| *name == rate_name).unwrap();
    assert_eq!((left.len() + 1, short.len() + 1), (rates.len(), long.len()), "{what}");
    let mut random = Random(5);
    for _ in 0..4 {
        let t = random.next();
        let (q, z, u) = (place(driven, &mut random), random.list(left.len()), random.list(kept.len()));
        let (sine, cosine) = (1.7 * t).sin_cos();
        let [x, v, a] = [0.3 + 0.4 * sine, 0.4 * 1.7 * cosine, -0.4 * 1.7 * 1.7 * sine];
        let rate = own.acceleration(t, &q, &z, &u).unwrap();
        let q_all = whole(&long, &short, &q, (joint, x));
        let z_all = whole(&rates, &left, &z, (&rate_name, v));
        let a_all = whole(&rates, &left, &rate, (&rate_name, a));
        let u_all = whole(&inputs, &kept, &u, ("", 0.0));
        let rest = all.inverse_dynamics(t, &q_all, &z_all, &a_all, &u_all).unwrap();
        let matrix = all.mass_matrix(t, &q_all).unwrap();
        // Some hundred products for every entry of A and of the forces.
        let size = 500.0 * f64::EPSILON * (largest(&matrix) * (1.0 + largest(&a_all)) * rates.len() as f64 + 100.0);
        let [force, power] = driving_forces(&own, t, [&q, &z, &u])[..] else { panic!("a force") };
        assert!((force - rest[row]).abs() <= size, "{what}: {force} {rest:?}");
        assert!((power - force * v).abs() <= size, "{what}: {power}");
        assert!((0..rates.len()).all(|k| k == row || rest[k].abs() <= size), "{what}: {rest:?} of {size}");
        // At any other accelerations as well.
        let other = random.list(left.len());
        let a_all = whole(&rates, &left, &other, (&rate_name, a));
        let rest = all.inverse_dynamics(t, &q_all, &z_all, &a_all, &u_all).unwrap();
        let [force, _] = driving_forces_at(&own, t, [&q, &z, &other, &u])[..] else { panic!("a force") };
        assert!((force - rest[row]).abs() <= size, "{what}: {force} {rest:?}");
    }
}
