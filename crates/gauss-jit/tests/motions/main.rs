//! Coordinates that are driven, `motion(x = f(t))`, read at run time: beside known equations, beside the same motion
//! under a constraint with its multiplier, and beside inverse dynamics of the whole.

#[path = "../common/mod.rs"]
mod common;
mod mistakes;

use common::{Random, names, robot};
use gauss_jit::{Kernel, Model};

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
        "friction(rail, along = x, viscous = 0.3, dry = 2, width = 0.1), input(u), \
         torque(body = bob, value = [0, u, 0])",
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

/// A driven joint of a robot: its torque is the row of inverse dynamics of the whole at the same q, q̇, q̈, with no
/// input there, and rows that are free have no force left.
#[test]
fn driven_joints_of_robots() {
    let arm: &[&str] = &["gravity = 9.81"];
    let legs: &[&str] = &["gravity = 9.81", "base = floating", "limits = none", "saturation = none"];
    let hand: &[&str] = &["gravity = 9.81", "joint_friction = smooth(0.01)", "limits = none", "saturation = none"];
    let servos: &[&str] = &["gravity = 9.81", "inputs = none", "limits = none"];
    let linkage: &[&str] = &["inputs = none", "limits = none"];
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

/// An arm of two links on a slide, with more `clauses`.
fn leg(coordinates: &str, clauses: &str) -> String {
    format!(
        "#[gauss(coordinates({coordinates}), gravity = 9.81, {clauses},
           body(thigh, position = [slide, 0, 0.1 * slide], rotation = rotation_y(hip), mass = m, inertia = [3, 4, 5],
                center_of_mass = [0.1, 0, -l]),
           body(shank, parent = thigh, position = [0, 0.1, -l], rotation = rotation_y(knee) * rotation_x(0.2 * knee),
                mass = 2, center_of_mass = [0, 0.1, -0.2], inertia = [1, 2, 2.5]))]
         struct Leg {{ m: f64, l: f64 }}"
    )
}

const OF_LEG: [(&str, &[f64]); 2] = [("m", &[3.0]), ("l", &[0.4])];

/// Compares a method of two models at the same states, argument by argument at random.
fn same(what: &str, [a, b]: [&Kernel; 2], method: &str, terms: f64) {
    let [own, other] = [a, b].map(|kernel| kernel.method(method).unwrap_or_else(|error| panic!("{what}: {error}")));
    assert_eq!(own.outputs(), other.outputs(), "{what} {method}");
    let mut random = Random(23);
    for _ in 0..4 {
        let lists: Vec<Vec<f64>> = own.arguments().iter().map(|own| random.list(own.components.len())).collect();
        let lists: Vec<&[f64]> = lists.iter().map(Vec::as_slice).collect();
        let [found, expected] = [&own, &other].map(|method| {
            let mut results = vec![0.0; method.outputs()];
            method.call(&lists, &mut results).unwrap();
            results
        });
        let size = terms * f64::EPSILON * (1.0 + largest(&expected));
        let well = found.iter().zip(&expected).all(|(found, expected)| (found - expected).abs() <= size);
        assert!(well, "{what} {method}: {found:?} {expected:?}");
    }
}

/// Two at once, in the order of the clauses, one of which names the other: the scene with the functions in their
/// places, in all methods and derivatives.
#[test]
fn a_motion_is_the_function_in_its_place() {
    let wanted = "linearize(parameters, inverse, hessian), taylor, frames(shank), methods(gravity_torques)";
    let driven = leg(
        "slide, hip, knee",
        &format!("{wanted}, define(u = 0.3 * t), motion(hip = sin(u) + slide, slide = m * t * t)"),
    );
    let by_hand = leg("knee", &format!("{wanted}, define(slide = m * t * t, hip = sin(0.3 * t) + slide)"));
    let [driven, by_hand] = [driven, by_hand].map(|source| model(&source));
    let kernels = [&driven, &by_hand].map(|model| kernel(model, &OF_LEG));
    assert_eq!(driven.description().motions, ["hip", "slide"]);
    let methods: Vec<&str> = driven.methods().filter(|method| *method != "driving_forces_at").collect();
    assert_eq!(methods, by_hand.methods().collect::<Vec<_>>());
    // Of second derivatives there are some thousand products.
    methods.iter().for_each(|method| same("two", [&kernels[0], &kernels[1]], method, 2e4));
    // Which products are fused is as it falls.
    let operations = |model: &Model| -> Vec<(String, [u32; 3])> {
        let of = |(name, count): (&str, gauss_codegen::program::Counts)| {
            (name.to_owned(), [count.additions + count.multiplications, count.divisions, count.transcendentals])
        };
        model.operations().map(of).collect()
    };
    let mut own = operations(&driven);
    own.retain(|(name, _)| name != "driving_forces_at");
    assert_eq!(own, operations(&by_hand), "a scene pays for the forces alone");
}

/// The force along one of two is that with the other where it is, as inverse dynamics of the whole has it.
#[test]
fn two_motions_of_which_one_names_the_other() {
    let driven = model(&leg("slide, hip, knee", "motion(slide = 0.4 * t * t, hip = 0.3 * sin(t) + slide)"));
    let full = model(&leg("slide, hip, knee", "limit = 50000"));
    let (own, all) = (kernel(&driven, &OF_LEG), kernel(&full, &OF_LEG));
    let mut random = Random(9);
    for _ in 0..4 {
        let [t, q, z] = [0, 1, 2].map(|_| random.next());
        let a = own.acceleration(t, &[q], &[z], &[]).unwrap()[0];
        let slide = [0.4 * t * t, 0.8 * t, 0.8];
        let hip = [0.3 * t.sin() + slide[0], 0.3 * t.cos() + slide[1], -0.3 * t.sin() + slide[2]];
        let rest = all
            .inverse_dynamics(t, &[slide[0], hip[0], q], &[slide[1], hip[1], z], &[slide[2], hip[2], a], &[])
            .unwrap();
        let found = driving_forces(&own, t, [&[q], &[z], &[]]);
        // Some two hundred products of numbers up to fifty.
        let size = 200.0 * f64::EPSILON * 50.0 * (1.0 + a.abs());
        assert!((found[0] - rest[0]).abs() <= size && (found[2] - rest[1]).abs() <= size, "{found:?} {rest:?}");
        assert!(rest[2].abs() <= size, "{rest:?}");
        let powers = [found[1] - found[0] * slide[1], found[3] - found[2] * hip[1]];
        assert!(largest(&powers) <= size, "{found:?}");
    }
}

/// The energy gains what the drives give, with the power of all else that is no potential.
#[test]
fn energy_comes_from_the_drives() {
    let clauses = "motion(slide = 0.4 * sin(2 * t), hip = t * t), input(push, bend), drive(slide = push, knee = bend), \
                   spring(tendon, along = knee - hip + slide, stiffness = 30, damping = 2), armature(hip = 0.3), \
                   friction(rail, along = slide, viscous = 0.2), potential = 4 * hip * hip * slide";
    let model = model(&leg("slide, hip, knee", clauses));
    let own = kernel(&model, &OF_LEG);
    let mut random = Random(17);
    for _ in 0..6 {
        let [t, q, z] = [0, 1, 2].map(|_| random.next());
        let u = random.list(2);
        let found = driving_forces(&own, t, [&[q], &[z], &u]);
        let supplied = own.call("supplied_power", &[&[t], &[q], &[z], &u]).unwrap()[0];
        let [slide, hip] = [0.8 * (2.0 * t).cos(), 2.0 * t];
        let stretch = z - hip + slide;
        let others = [u[0] * slide + u[1] * z, -2.0 * stretch * stretch, -0.2 * slide * slide];
        let powers = [found[1], found[3]].into_iter().chain(others);
        // Some three hundred products of powers and of what they are made of.
        let size = 300.0 * f64::EPSILON * powers.clone().fold(100.0, |sum, power| sum + power.abs());
        assert!((supplied - powers.sum::<f64>()).abs() <= size, "{found:?} {others:?} {supplied}");
        // The rate of the energy itself, by differences of a step of 1e-5: their error is its square, times third
        // derivatives of some hundred, and roundings of the energy over the step.
        let a = own.acceleration(t, &[q], &[z], &u).unwrap()[0];
        let step = 1e-5;
        let energy = |h: f64| {
            let (t, q, z) = (t + h, q + h * z + 0.5 * h * h * a, z + h * a);
            own.kinetic_energy(t, &[q], &[z]).unwrap() + own.potential_energy(t, &[q]).unwrap()
        };
        let rate = (energy(step) - energy(-step)) / (2.0 * step);
        let bound = 1e3 * step * step + 100.0 * f64::EPSILON * energy(0.0).abs().max(1.0) / step;
        assert!((rate - supplied).abs() <= bound, "{rate} {supplied} {bound:e}");
    }
}

/// The drive overcomes the bound of dry friction along a motion, and at rest it is told without it; a scene whose only
/// dry friction it was has no contacts left.
#[test]
fn dry_friction_along_a_motion() {
    let with = |clauses: &str| model(&crane(&format!("motion(x = a * sin(w * t)){clauses}")));
    let [smooth, dry] = ["", ", dry_friction(x, bound = 1.5 * m)"].map(with);
    assert!(dry.contacts().is_empty());
    let [smooth, dry] = [&smooth, &dry].map(|model| kernel(model, &NUMBERS));
    for (t, sign) in [(0.1, 1.0), (-1.1, -1.0), (1.2, -1.0), (0.0, 1.0)] {
        let [free, rubbed] = [&smooth, &dry].map(|kernel| driving_forces(kernel, t, [&[0.3], &[1.2], &[]])[0]);
        assert!((rubbed - free - sign * 1.5 * 0.7).abs() <= 1e-13, "{rubbed} {free}");
    }
    let held = |clauses: &str| kernel(&model(&crane(&format!("motion(x = a){clauses}"))), &NUMBERS);
    let [free, rubbed] = ["", ", dry_friction(x, bound = m)"]
        .map(|clauses| driving_forces(&held(clauses), 0.3, [&[0.3], &[1.2], &[]])[0]);
    assert_eq!(free, rubbed);
}

/// Held at a field it is a lock, with the force that holds.
#[test]
fn a_motion_that_rests_is_a_lock() {
    let [motion, lock] = ["motion(knee = l)", "lock(knee = l)"].map(|clause| model(&leg("slide, hip, knee", clause)));
    let kernels = [&motion, &lock].map(|model| kernel(model, &OF_LEG));
    for method in ["acceleration", "mass_matrix", "kinetic_energy", "potential_energy", "gauss_residual"] {
        same("rest", [&kernels[0], &kernels[1]], method, 500.0);
    }
    assert!(!lock.methods().any(|name| name == "driving_forces_at"));
    let found = driving_forces(&kernels[0], 0.0, [&[0.1, 0.2], &[0.3, 0.4], &[]]);
    assert!(found[0].abs() > 0.1 && found[1] == 0.0, "{found:?}");
}

/// Speeds of one's own: that of a driven coordinate is the rate of its motion, wherever it stands.
#[test]
fn speeds_of_ones_own() {
    let clauses = "speeds(v, w, u), kinematics(slide = v, hip = w, knee = u), drive(knee = -2 * v * w)";
    let driven = model(&leg("slide, hip, knee", &format!("{clauses}, motion(slide = sin(3 * t))")));
    let by_hand =
        "speeds(w, u), kinematics(hip = w, knee = u), drive(knee = -6 * cos(3 * t) * w), define(slide = sin(3 * t))";
    let by_hand = model(&leg("hip, knee", by_hand));
    let kernels = [&driven, &by_hand].map(|model| kernel(model, &OF_LEG));
    for method in ["acceleration", "gauss_residual", "kinetic_energy", "momentum_rate"] {
        same("speeds", [&kernels[0], &kernels[1]], method, 1000.0);
    }
}

/// Under constraints that are left: a crank turns a slider-crank, whose torque is that of the power balance.
#[test]
fn a_crank_of_a_slider() {
    let slider = "#[gauss(coordinates(crank, rod, x), motion(crank = w * t),
        body(wheel, rotation = rotation_z(crank), mass = 1, inertia = [1, 1, 1]),
        body(bar, parent = wheel, position = [r, 0, 0], rotation = rotation_z(rod), mass = 0, inertia = 0),
        body(piston, position = [x, 0, 0], mass = m, inertia = 1),
        point(pin, body = bar, at = [l, 0, 0]),
        constraint(position = pin.y), constraint(position = pin.x - x))]
        struct Slider { r: f64, l: f64, m: f64, w: f64 }";
    let (r, l, m, w) = (0.2, 0.5, 3.0, 4.0);
    let values: [(&str, &[f64]); 4] = [("r", &[r]), ("l", &[l]), ("m", &[m]), ("w", &[w])];
    let slider = slider.replace("mass = 0, inertia = 0", "mass = 0.001, inertia = 0.0001");
    let own = kernel(&model(&slider), &values);
    for t in [0.1, 0.35, 0.9, 1.3] {
        let (sine, cosine) = f64::sin_cos(w * t);
        // l sin(crank + rod) = −r sin(crank).
        let lean = (-r * sine / l).asin();
        let lean_rate = -r * w * cosine / (l * lean.cos());
        let lean_force = (r * w * w * sine + l * lean_rate * lean_rate * lean.sin()) / (l * lean.cos());
        let x = r * cosine + l * lean.cos();
        let v = -r * w * sine - l * lean_rate * lean.sin();
        let a = -r * w * w * cosine - l * lean_force * lean.sin() - l * lean_rate * lean_rate * lean.cos();
        let found = driving_forces(&own, t, [&[lean - w * t, x], &[lean_rate - w, v], &[]]);
        let by_power = m * a * v / w;
        // A bar of a thousandth of the mass takes some thousandths of the torque.
        assert!((found[0] - by_power).abs() <= 1e-2 * m * r * r * w * w, "{found:?} {by_power}");
    }
}

/// Beside a body in a chart, whose `motion = …` is another clause: the function in its place, and the multiplier.
#[test]
fn beside_a_chart() {
    for chart in ["left_invariant", "hybrid", "jet(euler_zyx)"] {
        let scene = |coordinates: &str, clauses: &str| {
            let source = format!(
                "#[gauss(motion = free, chart = {chart}, mass = 2, inertia = [1, 2, 2.5], gravity = [0, 0.3, -9.81],
                   {coordinates}body(wheel, parent = body, position = [0, 0.1, 0.3], rotation = rotation_x(turn),
                   mass = m, center_of_mass = [0, l, 0], inertia_about_center_of_mass = [0.2, 0.1, 0.2]), {clauses})]
                 struct Wheel {{ m: f64, l: f64 }}"
            );
            kernel(&model(&source), &OF_LEG)
        };
        let driven = scene("coordinates(turn), ", "motion(turn = sin(2 * t))");
        let by_hand = scene("", "define(turn = sin(2 * t))");
        let whole = scene("coordinates(turn), ", "constraint(position = turn - sin(2 * t))");
        for method in ["acceleration", "gauss_residual", "momentum", "kinetic_energy", "supplied_power"] {
            same(chart, [&driven, &by_hand], method, 5000.0);
        }
        let mut random = Random(31);
        for _ in 0..3 {
            let t = random.next();
            let q = place(driven.model(), &mut random);
            let z = random.list(6);
            let [q_all, z_all] = [(&q, (2.0 * t).sin()), (&z, 2.0 * (2.0 * t).cos())]
                .map(|(list, value)| list.iter().copied().chain([value]).collect::<Vec<_>>());
            let multiplier = whole.call("multipliers", &[&[t], &q_all, &z_all, &[]]).unwrap()[0];
            let found = driving_forces(&driven, t, [&q, &z, &[]])[0];
            // A 7 × 7 matrix of condition below some hundreds, and Euler angles away from their singular place.
            assert!((found - multiplier).abs() <= 1e5 * f64::EPSILON * (1.0 + found.abs()), "{found} {multiplier}");
        }
    }
}

/// Beside constraints that are solved for speeds, and beside reactions: along the way of a trolley its rail bears
/// nothing but the drive.
#[test]
fn beside_constraints_and_reactions() {
    let speeds =
        "speeds(v, w, u), kinematics(slide = v, hip = w, knee = u), constraint(velocity = u - 0.5 * w - 0.2 * t)";
    let with = |clauses: &str| {
        kernel(&model(&leg("slide, hip, knee", &format!("{speeds}, motion(slide = sin(t)){clauses}"))), &OF_LEG)
    };
    let [multipliers, solved] = ["", ", independent(w)"].map(with);
    for t in [-0.4, 0.3, 0.8] {
        let (q, w) = ([0.4, -0.7], 1.3);
        let all = driving_forces(&multipliers, t, [&q, &[w, 0.5 * w + 0.2 * t], &[]]);
        let own = driving_forces(&solved, t, [&q, &[w], &[]]);
        // Some hundred products of forces up to fifty, the multiplier of a matrix of condition below thirty.
        let size = 3000.0 * f64::EPSILON * 50.0;
        assert!(own.iter().zip(&all).all(|(own, all)| (own - all).abs() <= size), "{own:?} {all:?}");
    }
    let crane = kernel(&model(&crane("motion(x = a * sin(w * t)), reactions(trolley)")), &NUMBERS);
    let (t, q, z) = (0.3, [0.8], [-1.2]);
    let a = crane.acceleration(t, &q, &z, &[]).unwrap();
    let reaction = crane.call("reactions_at", &[&[t], &q, &z, &a, &[]]).unwrap();
    let force = driving_forces(&crane, t, [&q, &z, &[]])[0];
    assert_eq!(reaction.len(), 6);
    assert!((reaction[0] - force).abs() <= 1e-13 && force.abs() > 0.1, "{reaction:?} {force}");
}

/// A ball above a table that shakes: gaps and their rates know of the motion, and the friction of the table's guide is
/// no contact.
#[test]
fn beside_contacts() {
    let scene = |coordinates: &str, clauses: &str| {
        let source = format!(
            "#[gauss(coordinates({coordinates}), gravity = 9.81,
               body(table, position = [0, 0, h], mass = 5, inertia = 1),
               body(ball, position = [x, 0, z], mass = m, inertia = 1),
               contact(hit, gap = z - h - l, slip = rate(x) - 0.1 * rate(h), friction = 0.3, restitution = 0.4),
               {clauses})]
             struct Table {{ m: f64, l: f64 }}"
        );
        kernel(&model(&source), &OF_LEG)
    };
    let driven = scene("h, x, z", "motion(h = 0.1 * sin(9 * t)), dry_friction(h, bound = 2)");
    let by_hand = scene("x, z", "define(h = 0.1 * sin(9 * t))");
    let methods: Vec<String> = by_hand.model().methods().map(str::to_owned).collect();
    assert!(methods.iter().any(|method| method == "impulse_dynamics"));
    for method in methods.iter().filter(|method| !["powers", "element_forces"].contains(&method.as_str())) {
        same("contacts", [&driven, &by_hand], method, 3000.0);
    }
    // Without contact forces: the weight and the inertia of the table, and the bound.
    let t = 0.1;
    let found = driving_forces(&driven, t, [&[0.0, 2.0], &[0.0, 0.0], &[]])[0];
    let expected = 5.0 * (9.81 - 8.1 * f64::sin(0.9)) + 2.0;
    assert!((found - expected).abs() <= 1e-13 * 50.0, "{found} {expected}");
}

/// In rows, to the bits that each state gets alone.
#[test]
fn in_lanes() {
    let own = kernel(&model(&crane("motion(x = a * sin(w * t)), spring(along = x, stiffness = 3)")), &NUMBERS);
    let method = own.method("driving_forces_at").unwrap();
    let mut random = Random(1);
    let rows = 37;
    let lists: Vec<Vec<f64>> = method.arguments().iter().map(|own| random.list(rows * own.components.len())).collect();
    let lists: Vec<&[f64]> = lists.iter().map(Vec::as_slice).collect();
    let mut together = vec![0.0; 2 * rows];
    method.call_rows(rows, &lists, &mut together).unwrap();
    for row in 0..rows {
        let counts = method.arguments().iter().map(|own| own.components.len());
        let own: Vec<&[f64]> = lists.iter().zip(counts).map(|(list, n)| &list[row * n..row * n + n]).collect();
        let mut alone = [0.0; 2];
        method.call(&own, &mut alone).unwrap();
        assert_eq!(alone, together[2 * row..2 * row + 2]);
    }
}

/// A table of time, twice smooth, is a function as any other.
#[test]
fn tables_of_time() {
    let points = [("WAY", &[4, 2][..], &[-2.0, 0.3, -0.5, 1.0, 0.7, -0.4, 2.0, 0.1][..])];
    let table = model(&crane("table(way, points = WAY, kind = cubic), motion(x = way(t))"))
        .with_tables(&points)
        .unwrap_or_else(|mistakes| panic!("{mistakes}"));
    let whole = "table(way, points = WAY, kind = cubic), constraint(position = x - way(t))";
    let whole = model(&crane(whole)).with_tables(&points).unwrap_or_else(|mistakes| panic!("{mistakes}"));
    let (own, all) = (kernel(&table, &NUMBERS), kernel(&whole, &NUMBERS));
    for t in [-1.1, 0.2, 1.3] {
        let found = driving_forces(&own, t, [&[0.4], &[0.6], &[]])[0];
        // The multiplier depends on x and its rate by nothing: the trolley has neither weight along it nor loads.
        let multiplier = all.call("multipliers", &[&[t], &[0.0, 0.4], &[0.0, 0.6], &[]]).unwrap()[0];
        assert!((found - multiplier).abs() <= 1500.0 * f64::EPSILON * (1.0 + found.abs()), "{found} {multiplier}");
    }
}
