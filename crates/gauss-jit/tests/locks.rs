//! Locked joints of robots and coordinates of scenes, read at run time, beside the whole models: mass matrices are
//! submatrices, forces of inverse dynamics the same rows, and accelerations what a constraint of the rate leaves.

mod common;

use common::{Random, names, robot};
use gauss_jit::{Kernel, Model, Notation};

/// Joints or coordinates with their values.
type Locks = &'static [(&'static str, f64)];

fn of_file(name: &str, clauses: &[&str]) -> Model {
    let model = match name.ends_with("xml") {
        true => Model::from_mjcf(robot(name), clauses),
        false => Model::from_urdf(robot(name), clauses),
    };
    model.unwrap_or_else(|mistakes| panic!("{name}: {mistakes}"))
}

/// Names of the numbers of a configuration: those of groups first.
fn configuration(model: &Model) -> Vec<String> {
    let scalar = |quantity: &&gauss_jit::Quantity| quantity.numbers.len() == 1;
    let all = &model.description().coordinates;
    let ordered = all.iter().filter(|quantity| !scalar(quantity)).chain(all.iter().filter(scalar));
    ordered.flat_map(|quantity| &quantity.numbers).cloned().collect()
}

/// The numbers of a longer list of names: those of a shorter one, and what locks say of the others.
fn whole(long: &[String], short: &[String], values: &[f64], locks: &[(&str, f64)]) -> Vec<f64> {
    let of = |name: &String| {
        let place = short.iter().position(|own| own == name);
        let lock = locks.iter().find(|(lock, _)| lock == name);
        place.map(|place| values[place]).or(lock.map(|(_, value)| *value)).unwrap_or(0.0)
    };
    long.iter().map(of).collect()
}

fn largest(numbers: &[f64]) -> f64 {
    numbers.iter().fold(0.0, |most, x| most.max(x.abs()))
}

/// Both kernels at random states. Each adds some hundred products for every entry of A and of the forces; both are
/// within so many roundings of their largest terms.
fn compare(what: &str, full: (&Model, &Kernel), held: (&Model, &Kernel), locks: &[(&str, f64)]) {
    let mut random = Random(7);
    let [all, own] = [full.0, held.0].map(configuration);
    let [rates, left] = [full.0, held.0].map(|model| names(&model.description().speeds));
    let [inputs, kept] = [full.0, held.0].map(|model| names(&model.description().inputs));
    assert_eq!((own.len() + locks.len(), left.len() + locks.len()), (all.len(), rates.len()), "{what}: {own:?}");
    let places: Vec<usize> = left.iter().map(|name| rates.iter().position(|own| own == name).expect(name)).collect();
    let rounding = 500.0 * f64::EPSILON;
    for _ in 0..4 {
        let q = place(held.0, &mut random);
        let [z, a, u] = [left.len(), left.len(), kept.len()].map(|count| random.list(count));
        let q_all = whole(&all, &own, &q, locks);
        let [z_all, a_all] = [&z, &a].map(|short| whole(&rates, &left, short, &[]));
        let u_all = whole(&inputs, &kept, &u, &[]);
        let [matrix, inner] = [(full.1, &q_all), (held.1, &q)].map(|(kernel, q)| kernel.mass_matrix(0.0, q).unwrap());
        for (i, &row) in places.iter().enumerate() {
            for (j, &column) in places.iter().enumerate() {
                let (found, expected) = (inner[i * left.len() + j], matrix[row * rates.len() + column]);
                assert!((found - expected).abs() <= rounding * largest(&matrix), "{what}: {found} {expected}");
            }
        }
        let forces = full.1.inverse_dynamics(0.0, &q_all, &z_all, &a_all, &u_all).unwrap();
        let found = held.1.inverse_dynamics(0.0, &q, &z, &a, &u).unwrap();
        let size = largest(&forces) + largest(&matrix) * largest(&a);
        for (found, &row) in found.iter().zip(&places) {
            assert!((found - forces[row]).abs() <= rounding * size, "{what}: {found} for {}", forces[row]);
        }
        // The rows of the whole that are free have no force left.
        let rate = held.1.acceleration(0.0, &q, &z, &u).unwrap();
        let rate = whole(&rates, &left, &rate, &[]);
        let rest = full.1.inverse_dynamics(0.0, &q_all, &z_all, &rate, &u_all).unwrap();
        let size = size + largest(&matrix) * largest(&rate) * rates.len() as f64;
        assert!(places.iter().all(|&row| rest[row].abs() <= rounding * size), "{what}: {rest:?} of {size}");
        let energies = [full.1.kinetic_energy(0.0, &q_all, &z_all), held.1.kinetic_energy(0.0, &q, &z)];
        let [expected, found] = energies.map(Result::unwrap);
        assert!((found - expected).abs() <= rounding * largest(&matrix) * z.len() as f64, "{what}: {found} {expected}");
    }
}

#[test]
fn locked_joints_of_robots() {
    let arm: &[&str] = &["gravity = 9.81"];
    let legs: &[&str] = &["gravity = 9.81", "base = floating", "limits = none", "saturation = none"];
    let hand: &[&str] = &["gravity = 9.81", "joint_friction = smooth(0.01)", "limits = none", "saturation = none"];
    let servos: &[&str] = &["gravity = 9.81", "inputs = actuators", "saturation = clamp", "limits = none"];
    let linkage: &[&str] = &["inputs = actuators", "saturation = none", "limits = none"];
    let robots: [(&str, &[&str], Locks); 9] = [
        ("panda.urdf", arm, &[("panda_finger_joint1", 0.03), ("panda_joint6", 1.2)]),
        ("panda.urdf", arm, &[("panda_joint1", -0.7)]),
        ("anymal.urdf", legs, &[("LF_KFE", -1.1), ("RH_HAA", 0.2)]),
        // A joint that another follows, and one about an axis of no frame.
        ("gripper.urdf", hand, &[("left", 0.02)]),
        ("gripper.urdf", hand, &[("elbow", 0.4)]),
        ("servos.xml", servos, &[("elbow", 0.35)]),
        ("servos.xml", servos, &[("shoulder", -0.9), ("wrist", 0.5)]),
        // With a reference and a spring, beside a ball; with what follows it, which is a slide.
        ("linkage.xml", linkage, &[("pitch", 0.4)]),
        ("linkage.xml", linkage, &[("yaw", -0.3)]),
    ];
    for (name, clauses, locks) in robots {
        let full = of_file(name, clauses);
        let written: Vec<String> = locks.iter().map(|(joint, value)| format!("lock({joint} = {value})")).collect();
        let with: Vec<&str> = clauses.iter().copied().chain(written.iter().map(String::as_str)).collect();
        let held = of_file(name, &with);
        let [all, own] = [&full, &held].map(|model| model.kernel(&[]).expect("a kernel"));
        compare(&format!("{name} {locks:?}"), (&full, &all), (&held, &own), locks);
        // What the number says, a field says as well, with the links as bodies of their own.
        let path = robot(name).to_string_lossy().into_owned();
        let format = if name.ends_with("xml") { "mjcf" } else { "urdf" };
        let parameters: Vec<String> = (0..locks.len()).map(|k| format!("at{k}")).collect();
        let locked = locks.iter().zip(&parameters).map(|((joint, _), at)| format!("lock({joint} = {at})"));
        let clauses = clauses.iter().map(|own| (*own).to_owned()).chain(locked).collect::<Vec<_>>().join(", ");
        let fields = parameters.iter().map(|at| format!("{at}: f64")).collect::<Vec<_>>().join(", ");
        let source = format!("#[gauss({format} = {path:?}, {clauses})] struct Robot {{ {fields} }}");
        let by_fields = Model::from_source(&source).unwrap_or_else(|mistakes| panic!("{name}: {mistakes}"));
        let values: Vec<(&str, [f64; 1])> =
            parameters.iter().zip(locks).map(|(at, (_, value))| (at.as_str(), [*value])).collect();
        let values: Vec<(&str, &[f64])> = values.iter().map(|(at, value)| (*at, &value[..])).collect();
        let kernel = by_fields.kernel(&values).expect("a kernel");
        compare(&format!("{name} {locks:?} by fields"), (&full, &all), (&by_fields, &kernel), locks);
        let broken: Vec<(&str, &[f64])> = values.iter().map(|(at, _)| (*at, &[f64::NAN][..])).collect();
        assert!(by_fields.kernel(&broken).is_err(), "{name}");
    }
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

/// The points that two links have in common are still those of the file, and the motion is that of the whole under a
/// constraint of the rate.
#[test]
fn a_loop_with_a_locked_hinge() {
    let locks = &[("left_hinge", 0.3)];
    let held = of_file("loop.xml", &["lock(left_hinge = 0.3)"]);
    let full = of_file("loop.xml", &["constraint(velocity = rate(left_hinge))"]);
    let [own, all] = [&held, &full].map(|model| model.kernel(&[]).expect("a kernel"));
    let [rates, left] = [&full, &held].map(|model| names(&model.description().speeds));
    let mut random = Random(5);
    for _ in 0..4 {
        let (q, z) = (place(&held, &mut random), random.list(left.len()));
        let found = own.acceleration(0.0, &q, &z, &[]).unwrap();
        let found = whole(&rates, &left, &found, &[]);
        let q = whole(&configuration(&full), &configuration(&held), &q, locks);
        let expected = all.acceleration(0.0, &q, &whole(&rates, &left, &z, &[]), &[]).unwrap();
        // Masses of 0.2 to 1 and inertias of 1e-3 are solved for eighteen rates under nine conditions: a condition of a
        // thousand, and some hundred roundings.
        let bound = 1e3 * 500.0 * f64::EPSILON * largest(&expected);
        let error = found.iter().zip(&expected).fold(0.0_f64, |most, (a, b)| most.max((a - b).abs()));
        assert!(error <= bound, "{error:e} of {}", largest(&expected));
    }
}

/// A text with one part exchanged for another.
fn edited(text: &str, old: &str, new: &str) -> String {
    assert_eq!(text.matches(old).count(), 1, "{old}");
    text.replace(old, new)
}

/// The equations are those of a file whose joints were made fixed by hand.
#[test]
fn a_lock_is_a_file_with_fixed_joints() {
    let panda = std::fs::read_to_string(robot("panda.urdf")).expect("a file");
    let wrist = "<joint name=\"panda_joint6\" type=\"";
    let finger = "<joint name=\"panda_finger_joint1\" type=\"prismatic\">\n    <parent link=\"panda_joint7_link\"/>\n    \
                  <child link=\"panda_finger_joint1_link\"/>\n    <origin xyz=\"0.0 0.0 0.1654\" rpy=\"0.0 0.0 ";
    let fixed = edited(&panda, &format!("{wrist}continuous"), &format!("{wrist}fixed"));
    let fixed = edited(&fixed, finger, &finger.replace("prismatic", "fixed"));
    let path = std::env::temp_dir().join(format!("gauss-lock-{}.urdf", std::process::id()));
    std::fs::write(&path, fixed).expect("a folder for files that do not stay");
    let by_hand = Model::from_urdf(&path, &["gravity = 9.81"]);
    // What is left behind in the folder for it harms nobody.
    let _ = std::fs::remove_file(&path);
    let by_hand = by_hand.unwrap_or_else(|mistakes| panic!("{mistakes}"));
    let locked = of_file("panda.urdf", &["gravity = 9.81", "lock(panda_joint6 = 0, panda_finger_joint1 = 0)"]);
    let equations = |model: &Model| model.equations(Notation::Text).to_owned();
    assert_eq!(equations(&locked), equations(&by_hand));
    let operations =
        |model: &Model| model.operations().map(|(name, count)| format!("{name}: {count:?}")).collect::<Vec<_>>();
    assert_eq!(operations(&locked), operations(&by_hand));
}

/// A leg on a slide, with what acts between its coordinates.
fn leg(clauses: &str, fields: &str) -> String {
    format!(
        "#[gauss(coordinates(slide, hip, knee), gravity = 9.81, input(push, bend),
           body(thigh, position = [slide, 0, 0.1 * slide], rotation = rotation_y(hip), mass = m, center_of_mass = [0.1, 0, -l],
                inertia = [3, 4, 5]),
           body(shank, parent = thigh, position = [0, 0.1, -l], rotation = rotation_y(knee) * rotation_x(0.2 * knee),
                mass = 2, center_of_mass = [0, 0.1, -0.2], inertia = [1, 2, 2.5]),
           spring(tendon, along = knee - hip, stiffness = 30, damping = 2), potential = 4 * hip * hip * slide,
           damping = rate(hip) * rate(hip), drive(hip = push - bend * knee), {clauses})]
         struct Leg {{ m: f64, l: f64, {fields} }}"
    )
}

#[test]
fn locked_coordinates_of_scenes() {
    let kernel = |source: &str, values: &[(&str, &[f64])]| {
        let model = Model::from_source(source).unwrap_or_else(|mistakes| panic!("{source}: {mistakes}"));
        let kernel = model.kernel(values).expect("a kernel");
        (model, kernel)
    };
    let given: [(&str, &[f64]); 2] = [("m", &[3.0]), ("l", &[0.4])];
    let (full, whole) = kernel(&leg("", ""), &given);
    for locks in [&[("knee", 0.8)][..], &[("slide", -0.3)], &[("slide", 0.2), ("knee", -1.0)]] {
        let written = locks.iter().map(|(q, value)| format!("{q} = {value}")).collect::<Vec<_>>().join(", ");
        let (held, own) = kernel(&leg(&format!("lock({written})"), ""), &given);
        compare(&written, (&full, &whole), (&held, &own), locks);
    }
    let more: [(&str, &[f64]); 3] = [given[0], given[1], ("bent", &[0.8])];
    let (held, own) = kernel(&leg("lock(knee = bent)", "bent: f64"), &more);
    compare("bent", (&full, &whole), (&held, &own), &[("knee", 0.8)]);
    // As with the name defined where it was a coordinate, to the last word.
    let (by_hand, _) = kernel(&leg("define(knee = bent)", "bent: f64").replace("hip, knee)", "hip)"), &more);
    assert_eq!(held.equations(Notation::Text), by_hand.equations(Notation::Text));
    // And as under a constraint of its rate, whose multiplier holds it.
    let (_, constrained) = kernel(&leg("constraint(velocity = rate(knee))", ""), &given);
    let mut random = Random(3);
    for _ in 0..4 {
        let ([q, z], u) = ([0, 1].map(|_| random.list(2)), random.list(2));
        let found = own.acceleration(0.0, &q, &z, &u).unwrap();
        let (q, z) = ([q[0], q[1], 0.8], [z[0], z[1], 0.0]);
        let expected = constrained.acceleration(0.0, &q, &z, &u).unwrap();
        // A 3 × 3 matrix of condition below a hundred, of entries that are sums of some thirty products.
        let size = 100.0 * 30.0 * f64::EPSILON * (1.0 + largest(&expected));
        assert!((0..2).all(|k| (found[k] - expected[k]).abs() <= size), "{found:?} {expected:?}");
        assert!(expected[2].abs() <= size, "{expected:?}");
    }
}
