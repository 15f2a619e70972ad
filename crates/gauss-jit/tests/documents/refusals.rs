//! What has no counterpart in MJCF is an error that names it, all of it at once.

use gauss_jit::{DocumentError, Mjcf};

/// A cart, with its clause of coordinates.
const CART: &str = "coordinates(x), body(cart, position = [x, 0, 0], mass = 1, inertia = 1)";

fn refused(clauses: &str) -> Vec<String> {
    let source = format!("#[gauss({clauses})] struct Scene {{}}");
    match Mjcf::new(&source, &[]) {
        Err(DocumentError::NoCounterpart { list, .. }) => list,
        Err(error) => panic!("{clauses}: {error}"),
        Ok(made) => panic!("{clauses}: {}", made.xml()),
    }
}

/// Each mistake of a scene, in its order, has its words.
fn check(clauses: &str, expected: &[&str]) {
    let found = refused(clauses);
    assert_eq!(found.len(), expected.len(), "{clauses}: {found:#?}");
    found.iter().zip(expected).for_each(|(line, words)| assert!(line.contains(words), "{clauses}: {line}"));
}

#[test]
fn loads_without_a_counterpart_are_named() {
    let cart = |more: &str| format!("{CART}, {more}");
    check(&cart("drag(air, body = cart, quadratic = [1, 0, 0, 0, 0, 0])"), &["`air`: no sum of springs"]);
    check(&cart("central_gravity(pull, mu = 1, center = [0, 0, 5])"), &["`pull`: no sum"]);
    // Springs along a rope, and a potential, beside a spring that has a counterpart.
    let more =
        "spring(rope, from = [0, 0, 1], to = cart.position, stiffness = 2, length = 1), potential = x * x * x * x,
                spring(buffer, along = x, stiffness = 3)";
    check(&cart(more), &["`potential`, `rope`: no sum"]);
    check(
        &cart("input(u), drive(push, x = u * u), drive(pull, x = 1)"),
        &["`pull`: a constant force", "`push`: no sum"],
    );
    // A spring that pushes away, a damper that feeds, a law of time.
    check(&cart("spring(away, along = x, stiffness = 1), potential = -x * x"), &["`potential`: a constant force"]);
    check(&cart("drive(feed, x = rate(x))"), &["`feed`: a constant force, a law that gives energy"]);
    // A pose has one damping for all of its six rates.
    let free = "coordinates(craft: Pose), body(hull, pose = craft, mass = 1, inertia = 1),
                drag(air, body = hull, linear = [2, 2, 2, 1, 1, 1])";
    check(free, &["`air`: a constant force, a law that gives energy, or one that differs among the axes"]);
    check(&cart("drive(shake, x = sin(t))"), &["`shake`: no sum"]);
    // Laws that are linear where numbers are of the size 1, and forces of a time that nobody looks at.
    check(&cart("input(u), drive(limited, x = clamp(u, -500, 500))"), &["`limited`: no sum"]);
    check(&cart("drive(late, x = smooth_step(t, 1000, 1001))"), &["the time `t`"]);
    check(&cart("drive(stopped, x = -clamp(x, -400, 400))"), &["`stopped`: no sum"]);
    check(&cart("input(u), states(f = u - f), drive(x = f)"), &["`states`"]);
    check(&cart("table(push, points = PUSH), drive(x = push(x))"), &["tables (PUSH)"]);
    // Turned by x, the force is along none of the joints and in no axes of the body.
    let turning =
        "coordinates(x, a), body(cart, position = [x, 0, 0], rotation = rotation_y(a), mass = 1, inertia = 1),
                   input(u), drive(x = u * cos(2 * a))";
    check(turning, &["the input `u`"]);
}

#[test]
fn motions_without_a_counterpart_are_named() {
    check("coordinates(x), particle(mass = 1, position = [2 * x, 0, 0])", &["`x` is no coordinate of a joint"]);
    check("coordinates(x), particle(mass = 1, position = [x, x * x, 0])", &["`x` is no coordinate of a joint"]);
    check(
        "coordinates(x), particle(mass = 1, position = [x, sin(t), 0])",
        &["`particle_1` moves as a function of time"],
    );
    let geared = "coordinates(a), body(one, rotation = rotation_x(a), mass = 1, inertia = 1),
                  body(two, rotation = rotation_z(a * a), mass = 1, inertia = 1)";
    check(geared, &["the place of `two` is no product of joints, one for each of `a`"]);
    // A screw.
    let screw =
        "coordinates(a), body(nut, position = [0.1 * a, 0, 0], rotation = rotation_x(a), mass = 1, inertia = 1)";
    check(screw, &["`a` is no coordinate of a joint"]);
    let crossed =
        "coordinates(a, b), particle(mass = 1, position = [a, 0, 0]), particle(mass = 1, position = [a, b, 0]),
                   particle(mass = 1, position = [0, b, 0])";
    check(crossed, &["`a` and `b` move one body together and others apart"]);
    let sleigh = "coordinates(x, y, a), speeds(v, w), kinematics(x = v * cos(a), y = v * sin(a), a = w),
                  body(sleigh, position = [x, y, 0], rotation = rotation_z(a), mass = 1, inertia = 1)";
    check(sleigh, &["`constraint(velocity = …)`"]);
    let circle =
        "coordinates(x, y), particle(mass = 1, position = [x, y, 0]), constraint(position = x * x + y * y - 1)";
    check(circle, &["`constraint`"]);
    let nested = "coordinates(a, craft: Pose), body(arm, rotation = rotation_x(a), mass = 1, inertia = 1),
                  body(hull, parent = arm, pose = craft, mass = 1, inertia = 1)";
    check(nested, &["`craft` is a pose below another joint"]);
}

#[test]
fn matter_without_a_counterpart_is_named() {
    check(
        &format!("{CART}, gravity = 9.81").replace("inertia = 1", "inertia = 1, displaced_mass = 0.5"),
        &["on `cart`"],
    );
    check(&CART.replace("inertia = 1", "inertia = 2 - t"), &["the mass of `cart` varies with the time"]);
    check(&CART.replace("inertia = 1", "inertia = 1, added_mass = [1, 1, 1, 0, 0, 0]"), &["on `cart` a fluid acts"]);
    let formal = "coordinates(turn: Rotation), waive(triangle_inequality),
                  body(rotor, rotation = turn, mass = 1, inertia = [1, 1, 3])";
    check(formal, &["the inertia of `rotor` breaks the triangle inequality"]);
}

/// What is wrong with masses hides neither loads nor contacts.
#[test]
fn all_is_said_at_once() {
    let all =
        "coordinates(x, y), body(hull, position = [x, y, 0], mass = 1, inertia = 1, added_mass = [1, 1, 1, 0, 0, 0]),
               constraint(position = x - y * y), drag(air, body = hull, linear = [1, 0, 0, 0, 0, 0]),
               potential = x * x * x, contact(floor, gap = y + x * x)";
    let words = ["`constraint`", "on `hull` a fluid acts", "`potential`: no sum", "the contact `floor`"];
    check(all, &words);
}

#[test]
fn contacts_without_a_counterpart_are_named() {
    let ball = "coordinates(x, y), particle(mass = 1, position = [x, y, 0])";
    check(&format!("{ball}, contact(floor, gap = y + x * x)"), &["the contact `floor`"]);
    check(&format!("{ball}, range(rope, along = x + y, to = 1)"), &["the contact `rope_to`"]);
    check(&format!("{ball}, dry_friction(rail, slip = rate(x + y), bound = 1)"), &["the contact `rail`"]);
    check(
        &format!("{ball}, dry_friction(rail, slip = rate(x), bound = 1 + rate(x) * rate(x))"),
        &["the contact `rail`"],
    );
    let lift = "body(cart, position = [x, y, 0], mass = 1, inertia = 1), coordinates(x, y),
                contact(lift, point = cart.position, radius = 0.1, plane = [0, 1, 0], height = sin(t))";
    check(lift, &["the contact `lift`"]);
}

#[test]
fn mistakes_of_scene_and_parameters_stay_what_they_are() {
    let source = "#[gauss(coordinates(x), particle(mass = m, position = [x, 0, 0]))] struct Scene { m: f64 }";
    assert!(matches!(Mjcf::new(source, &[]), Err(DocumentError::Parameters(_))));
    assert!(matches!(Mjcf::new(source, &[("m", &[-1.0])]), Err(DocumentError::Parameters(_))));
    assert!(matches!(Mjcf::new(source, &[("m", &[f64::NAN])]), Err(DocumentError::Parameters(_))));
    assert!(matches!(Mjcf::new("#[gauss(mass = 1)] struct", &[]), Err(DocumentError::Scene(_))));
    assert!(Mjcf::new(source, &[("m", &[1.0])]).is_ok());
}
