//! Sources of systems of every size, as the derive reads them: a struct and its attribute.

// Each program needs some of them.
#![allow(dead_code)]

/// One body in principal axes at its centre of mass; with further clauses, each after a comma.
pub fn free_body(clauses: &str) -> String {
    format!(
        "#[gauss(chart = left_invariant{clauses})] struct FreeBody {{ #[gauss(mass)] mass: f64, \
         #[gauss(inertia)] inertia: Vector3<f64> }}"
    )
}

/// A vehicle in water: added mass, weight and buoyancy at different points, linear drag, a fin whose lift goes with the
/// square of the speed.
pub fn torpedo(clauses: &str) -> String {
    format!(
        "#[gauss(chart = left_invariant, define(v = body.relative_velocity), drag(linear = drag), \
         force(fin, at = tail, value = [0, lift * v.x * v.y, lift * v.x * v.z]){clauses})] \
         struct Torpedo {{ #[gauss(mass)] mass: f64, #[gauss(center_of_mass)] center: Vector3<f64>, \
         #[gauss(inertia)] inertia: Vector3<f64>, #[gauss(added_mass)] added: Matrix6<f64>, \
         #[gauss(gravity)] gravity: Vector3<f64>, #[gauss(displaced_mass)] displaced: f64, drag: Matrix6<f64>, \
         tail: Vector3<f64>, lift: f64 }}"
    )
}

/// A heavy top in Euler angles.
pub fn top(clauses: &str) -> String {
    format!(
        "#[gauss(chart = jet(euler_zxz), motion = fixed_point{clauses})] struct Top {{ #[gauss(mass)] mass: f64, \
         #[gauss(center_of_mass)] center: Vector3<f64>, #[gauss(inertia)] inertia: Vector3<f64>, \
         #[gauss(gravity)] g: f64 }}"
    )
}

fn fields(n: usize) -> String {
    let bodies: String = (0..n).map(|k| format!("#[gauss(body)] b{k}: RigidBody<f64>, l{k}: f64, ")).collect();
    format!("struct Chain {{ {bodies} #[gauss(gravity)] g: f64 }}")
}

fn names(prefix: &str, n: usize) -> String {
    (0..n).map(|k| format!("{prefix}{k}")).collect::<Vec<_>>().join(", ")
}

/// Bars one on the other, turning about the second axis.
pub fn planar(n: usize, relative: bool) -> String {
    let mut clauses = format!("coordinates({}), body(b0, rotation = rotation_y(q0))", names("q", n));
    for k in 1..n {
        let before = k - 1;
        let angle = if relative { format!("q{k}") } else { format!("q{k} - q{before}") };
        clauses +=
            &format!(", body(b{k}, parent = b{before}, position = [0, 0, l{before}], rotation = rotation_y({angle}))");
    }
    format!("#[gauss({clauses}, limit = 1000000)] {}", fields(n))
}

/// Particles on rods, every position as a sum from Ω.
pub fn particles(n: usize) -> String {
    let sum = |k: usize, f: &str| (0..=k).map(|j| format!("l{j} * {f}(q{j})")).collect::<Vec<_>>().join(" + ");
    let clauses: String = (0..n)
        .map(|k| format!(", particle(mass = m{k}, position = [{}, 0, -({})])", sum(k, "sin"), sum(k, "cos")))
        .collect();
    let fields: String = (0..n).map(|k| format!("m{k}: f64, l{k}: f64, ")).collect();
    format!(
        "#[gauss(coordinates({}){clauses}, limit = 1000000)] struct Chain {{ {fields} #[gauss(gravity)] g: f64 }}",
        names("q", n)
    )
}

/// Bars one on the other in universal joints.
pub fn spatial(n: usize) -> String {
    let angles = (0..n).map(|k| format!("x{k}, y{k}")).collect::<Vec<_>>().join(", ");
    let mut clauses = format!("coordinates({angles}), body(b0, rotation = rotation_x(x0) * rotation_y(y0))");
    for k in 1..n {
        let before = k - 1;
        clauses += &format!(
            ", body(b{k}, parent = b{before}, position = [0, 0, l{before}], rotation = rotation_x(x{k}) * rotation_y(y{k}))"
        );
    }
    format!("#[gauss({clauses}, limit = 1000000)] {}", fields(n))
}

/// Joint origins and fixed turns of the Franka Emika Panda (public URDF description, example-robot-data 6.0); with
/// further clauses, each after a comma.
pub fn arm(clauses: &str) -> String {
    const JOINTS: [([&str; 3], &str); 7] = [
        (["0", "0", "0.333"], ""),
        (["0", "0", "0"], "rotation_x(-1.5707963267948966) * "),
        (["0", "-0.316", "0"], "rotation_x(1.5707963267948966) * "),
        (["0.0825", "0", "0"], "rotation_x(1.5707963267948966) * "),
        (["-0.0825", "0.384", "0"], "rotation_x(-1.5707963267948966) * "),
        (["0", "0", "0"], "rotation_x(1.5707963267948966) * "),
        (["0.088", "0", "0"], "rotation_x(1.5707963267948966) * "),
    ];
    let mut links = format!("coordinates({})", names("q", 7));
    for (k, ([x, y, z], turn)) in JOINTS.iter().enumerate() {
        let parent = if k > 0 { format!("parent = b{}, ", k - 1) } else { String::new() };
        links += &format!(", body(b{k}, {parent}position = [{x}, {y}, {z}], rotation = {turn}rotation_z(q{k}))");
    }
    let bodies: String = (0..7).map(|k| format!("#[gauss(body)] b{k}: RigidBody<f64>, ")).collect();
    format!("#[gauss({links}{clauses})] struct Arm {{ {bodies} #[gauss(gravity)] g: f64 }}")
}

/// A walker on four legs of three joints each, which may be driven at every joint; joint origins are those of ANYmal B
/// (ANYbotics, public description, BSD 3-clause). With further clauses, each after a comma.
pub fn quadruped(driven: bool, clauses: &str) -> String {
    let (mut names, mut bodies, mut actions) = (Vec::new(), String::new(), String::new());
    for (leg, [x, y]) in [[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]].into_iter().enumerate() {
        let origins = [[0.277 * x, 0.116 * y, 0.0], [0.0635 * x, 0.041 * y, 0.0], [0.0, 0.109 * y, -0.25]];
        for (joint, [a, b, c]) in origins.into_iter().enumerate() {
            let (k, axis) = (3 * leg + joint, if joint == 0 { "x" } else { "y" });
            let parent = if joint == 0 { "base".to_owned() } else { format!("b{}", k - 1) };
            names.push(k);
            bodies += &format!(
                ", body(b{k}, parent = {parent}, position = [{a}, {b}, {c}], rotation = rotation_{axis}(q{k}))"
            );
            if driven {
                actions += &format!(", drive(q{k} = u{k})");
            }
        }
    }
    let list = |f: &dyn Fn(&usize) -> String| names.iter().map(f).collect::<Vec<_>>().join(", ");
    let (angles, torques) = (list(&|k| format!("q{k}")), list(&|k| format!("u{k}")));
    let input = if driven { format!("input({torques}), ") } else { String::new() };
    let fields = list(&|k| format!("#[gauss(body)] b{k}: RigidBody<f64>"));
    format!(
        "#[gauss(coordinates(pose: Pose, {angles}), {input}body(base, position = pose.position, \
         rotation = pose.rotation){bodies}{actions}{clauses})] struct Quadruped {{ #[gauss(body)] base: RigidBody<f64>, \
         {fields}, #[gauss(gravity)] g: f64 }}"
    )
}

/// Bodies that hang on a trunk that is free in space, one on the other in each limb, by hinges; with further clauses,
/// each after a comma. A limb is the limb at whose end it begins, if any, and the axes of its hinges.
fn limbs(name: &str, limbs: &[(Option<usize>, &str)], clauses: &str) -> String {
    let mut links = String::from("body(trunk, pose = base)");
    let (mut count, mut ends) = (0_u32, Vec::<String>::new());
    for (at, axes) in limbs {
        let mut parent = at.map_or_else(|| "trunk".to_owned(), |limb| ends[limb].clone());
        for axis in axes.chars() {
            let place = [0, 3, 6].map(|k| 0.05 + 0.01 * f64::from((7 * count + k) % 11));
            links += &format!(
                ", body(b{count}, parent = {parent}, position = {place:.2?}, rotation = rotation_{axis}(q{count}))"
            );
            parent = format!("b{count}");
            count += 1;
        }
        ends.push(parent);
    }
    let bodies: String = (0..count).map(|k| format!("#[gauss(body)] b{k}: RigidBody<f64>, ")).collect();
    format!(
        "#[gauss(coordinates(base: Pose, {}), {links}{clauses}, limit = 1000000)] struct {name} {{ \
         #[gauss(body)] trunk: RigidBody<f64>, {bodies} #[gauss(gravity)] g: f64 }}",
        names("q", count as usize)
    )
}

/// A trunk with four legs of three hinges that nothing drives: 18 speeds.
pub fn walker(clauses: &str) -> String {
    limbs("Walker", &[(None, "xyy"); 4], clauses)
}

/// A trunk with legs of six hinges, a waist of three, and at its end two arms of seven and a neck: 36 speeds.
pub fn humanoid(clauses: &str) -> String {
    let (leg, arm) = ((None, "zxyyyx"), (Some(2), "yxzyzyx"));
    limbs("Humanoid", &[leg, leg, (None, "zxy"), arm, arm, (Some(2), "z")], clauses)
}
