//! Expressions that have no value, whatever the state and the parameters are: mistakes of the user, each at its token
//! and all at once, and never called a bug.

/// A mistake: the text pointed at and the message.
type Mistake<'a> = (&'a str, &'a str);

#[track_caller]
fn check(source: &str, expected: &[Mistake<'_>]) {
    let input: syn::DeriveInput = syn::parse_str(source).expect("the source is a struct");
    let Err(error) = gauss_codegen::expand(&input) else { panic!("accepted: {source}") };
    let found: Vec<(String, String)> =
        error.into_iter().map(|error| (error.span().source_text().unwrap_or_default(), error.to_string())).collect();
    let found: Vec<Mistake<'_>> = found.iter().map(|(token, message)| (token.as_str(), message.as_str())).collect();
    assert_eq!(found, expected, "\nin {source}");
}

/// A particle in the plane with more clauses.
fn scene(clauses: &str) -> String {
    format!(
        "#[gauss(coordinates(x, y), particle(mass = m, position = [x, y, 0]), {clauses})] \
         struct Scene {{ m: f64, h: f64, k: f64 }}"
    )
}

const ZERO: &str = "division by zero: this is always zero";
const RANGE: &str = "this number is beyond the range of double precision";

#[test]
fn divisors_that_vanish() {
    check(&scene("potential = h / (x - x)"), &[("-", ZERO)]);
    check(&scene("potential = h / ((x + 1) * (x - 1) - x * x + 1)"), &[("+", ZERO)]);
    check(&scene("potential = h / (sin(x).powi(2) + cos(x).powi(2) - 1)"), &[("-", ZERO)]);
    check(&scene("potential = (x * 0).powi(-2) * h"), &[("*", ZERO)]);
    check(&scene("force(push, at = [x, y, 0], value = [h / (1.5 - 3 / 2), 0, 0])"), &[("-", ZERO)]);
    check(&scene("force(push, at = [x, y, 0], value = [h / (12345.5 - 24691 / 2), 0, 0])"), &[("-", ZERO)]);
    check(&scene("force(push, at = [x, y, 0], value = [h / sin(0), 0, 0])"), &[("sin", ZERO)]);
    check(&scene("drive(x = 1 / (t - t))"), &[("-", ZERO)]);
}

#[test]
fn roots_and_logarithms() {
    let positive = |found: &str| format!("the argument of `ln` must be positive, found {found}");
    let root = |found: &str| format!("the argument of `sqrt` must be zero or more, found {found}");
    check(&scene("potential = x * ln(0)"), &[("0", &positive("0"))]);
    check(&scene("potential = x * ln(-h + h)"), &[("+", &positive("0"))]);
    check(&scene("potential = x * ln(2 - 12345)"), &[("-", &positive("-12343"))]);
    check(&scene("potential = x * sqrt(-1)"), &[("-", &root("-1"))]);
    check(&scene("potential = x * sqrt(cos(3) - 0.5)"), &[("-", &root("-1.4899924966004454"))]);
    check(&scene("drive(x = ln(0))"), &[("0", &positive("0"))]);
    check(
        &scene("potential = x * atan2(x - x, 0)"),
        &[("atan2", "both arguments of `atan2` are always zero, and that point has no angle")],
    );
}

#[test]
fn steps_without_width() {
    let ends = "a smooth step has two ends, and these are the same; write different numbers";
    check(&scene("force(push, at = [x, y, 0], value = [smooth_step(x, h, h), 0, 0])"), &[("h", ends)]);
    check(&scene("force(push, at = [x, y, 0], value = [smooth_step(x, h + k, k + h), 0, 0])"), &[("+", ends)]);
}

#[test]
fn beyond_double_precision() {
    check(&scene("potential = x * powi(10, 99).powi(99)"), &[("powi", RANGE)]);
    check(&scene("potential = x * 1e200.powi(-2).powi(-1)"), &[("powi", RANGE)]);
    check(&scene("potential = x * exp(1000)"), &[("exp", RANGE)]);
    check(&scene("potential = x * (1e200 * 1e200)"), &[("*", RANGE)]);
}

/// Numbers that nothing is left of are as far out of range as those that are too large.
#[test]
fn widths_that_vanish() {
    check(&scene("stop(along = x, least = 0, stiffness = k, width = 1e-200 * 1e-200)"), &[("*", RANGE)]);
    check(&scene("drive(x = smooth_step(x, 0, powi(1e-200, 2)))"), &[("powi", RANGE)]);
}

/// The chart says where the body is, not the symbols in which loads on it are derived.
#[test]
fn charts_that_stay_where_something_is_infinite() {
    let body = |clauses: &str| {
        format!("#[gauss(motion = fixed_point, mass = 1, inertia = [1, 2, 2.5], {clauses})] struct Top {{ k: f64 }}")
    };
    check(
        &body("central_gravity(mu = k)"),
        &[(
            "k",
            "something with mass stays at the center, where the attraction is infinite; say where the center is: \
             `center = […]`",
        )],
    );
    check(
        &body("force(at = [1, 0, 0], value = [k / body.position.x, 0, 0])"),
        &[("force", "`force` divides by zero wherever the system is: a distance or a number in it is always zero")],
    );
    check(
        &body("torque(value = [k / dot(body.velocity, body.velocity), 0, 0])"),
        &[("torque", "`torque` divides by zero wherever the system is: a distance or a number in it is always zero")],
    );
}

#[test]
fn parameters_that_kinematics_divide_by() {
    let message = |mass: &str| {
        format!(
            "the forces of inertia are not linear in `{mass}`, because more than the mass of something depends on it; \
             give a field of its own to each, or remove `regressor`"
        )
    };
    let scene = |rate: &str| {
        format!(
            "#[gauss(coordinates(x), speeds(v), kinematics(x = {rate}), particle(mass = m, position = [x, 0, 0]), \
               particle(mass = n, position = [0, x, 0]), regressor)] struct Scene {{ m: f64, n: f64 }}"
        )
    };
    check(&scene("v / m"), &[("regressor", &message("m"))]);
    check(&scene("v / n"), &[("regressor", &message("n"))]);
    check(&scene("v / (m + n)"), &[("regressor", &message("m"))]);
    check(&scene("m * v"), &[("regressor", &message("m"))]);
}

/// Of such numbers the sums of squares have no real roots, and eliminations no pivots.
#[test]
fn inertias_that_no_body_has() {
    let about_o = "no body has this `inertia`: about its centre of mass a moment of inertia is negative; `inertia` is about \
                   O, m (|c|² 1 − c cᵀ) more; an inertia about the centre of mass is written \
                   `inertia_about_center_of_mass`";
    let own = |inertia: &str| format!("mass = 1, center_of_mass = [1, 0, 0], inertia = {inertia}");
    for inertia in ["[1, 1, 0.5]", "0"] {
        let source = format!(
            "#[gauss(coordinates(p: Pose, x), body(hull, position = p.position, rotation = p.rotation, {0}),
                 body(wheel, parent = hull, rotation = rotation_z(x), {0}))] struct Scene {{}}",
            own(inertia)
        );
        check(&source, &[("inertia", about_o)]);
    }
    let source = format!(
        "#[gauss(coordinates(x, y), body(arm, rotation = rotation_z(x), mass = 1, inertia = 3), \
           body(hand, parent = arm, position = [1, 0, 0], rotation = rotation_z(y), {}))] struct Scene {{}}",
        own("0")
    );
    check(&source, &[("inertia", about_o)]);
}

/// A spring to its own place has no direction when the joint that holds it is let go, and does nothing before.
#[test]
fn elements_between_one_place() {
    let message = |name: &str| {
        format!(
            "`{name}` has no direction at the joint that `reactions` asks about: a distance in it is zero wherever the \
             system is; remove it, since it does nothing there, or fasten its ends in different places"
        )
    };
    let arm = |clauses: &str| {
        format!(
            "#[gauss(coordinates(s), body(arm, position = [1, 2, 0], rotation = rotation_z(s), mass = m, inertia = j), \
               {clauses})] struct Arm {{ m: f64, j: f64, k: f64, l: f64 }}"
        )
    };
    for clause in [
        "spring(from = arm.position, to = [1, 2, 0], stiffness = k, length = l)",
        "spring(hook, from = arm.position, to = [1, 2, 0], stiffness = k, length = l, damping = m)",
        "potential = k * sqrt(dot(arm.position - [1, 2, 0], arm.position - [1, 2, 0]))",
    ] {
        let input: syn::DeriveInput = syn::parse_str(&arm(&format!("{clause}, reactions(arm)"))).expect("a struct");
        let found = gauss_codegen::expand(&input).expect_err(clause).into_iter().map(|error| error.to_string());
        let name = ["potential", "hook", "spring"].into_iter().find(|name| clause.contains(name)).unwrap_or("");
        assert_eq!(found.collect::<Vec<_>>(), [message(name)], "{clause}");
    }
    // Without a length the force is k d, which has a value everywhere.
    let whole = "spring(from = arm.position, to = [1, 2, 0], stiffness = k), reactions(arm)";
    let input: syn::DeriveInput = syn::parse_str(&arm(whole)).expect("a struct");
    gauss_codegen::expand(&input).unwrap_or_else(|error| panic!("{error}"));
}

/// Numbers that are beyond double precision once they are squared are a mistake of units, and no bug.
#[test]
fn bodies_beyond_everything() {
    for (far, mu) in [("1e43", "1"), ("1e43", "k"), ("1e200", "k"), ("1e-60", "k"), ("1e43", "1e80")] {
        for what in [
            "particle(mass = m, position = [x, FAR, 0])",
            "body(b, position = [x, FAR, 0], mass = m, inertia = k)",
            "body(b, position = [FAR, 0, 0], rotation = rotation_z(x), mass = m, inertia = [k, m, m])",
            "body(b, position = [FAR, x, 0], rotation = rotation_z(x), mass = m, center_of_mass = [k, 0, k], inertia = k)",
        ] {
            let what = what.replace("FAR", far);
            let source =
                format!("#[gauss(coordinates(x), {what}, central_gravity(mu = {mu}))] struct Far {{ m: f64, k: f64 }}");
            let input: syn::DeriveInput = syn::parse_str(&source).expect("a struct");
            let Err(error) = gauss_codegen::expand(&input) else { continue };
            for error in error {
                let message = error.to_string();
                assert!(!message.contains("bug"), "{source}: {message}");
            }
        }
    }
}

/// At rest this constraint has no value, elsewhere it has.
#[test]
fn constraints_on_ratios_of_speeds() {
    let source = scene("constraint(velocity = rate(x) / rate(y) - k)");
    let input: syn::DeriveInput = syn::parse_str(&source).expect("the source is a struct");
    assert!(gauss_codegen::expand(&input).is_ok(), "{source}");
}

/// Terms that no number has, and terms of 1e120 that cancel: neither decides whether the equations are right.
#[test]
fn constraints_on_huge_numbers() {
    let exp = |x: &str| (0..12).fold(x.to_owned(), |inner, _| format!("exp({inner})"));
    for velocity in [
        format!("rate(x) * m + {}", exp("rate(x)")),
        "rate(x) * (h - powf(k, 1e3) + x) + sqrt(powf(rate(y) - y, 1.5) * (h + y / 100))".to_owned(),
        "rate(x) * powf(k, 1e3) * (y + h) + rate(y) * powf(k, 1e3) - sin(x * y)".to_owned(),
    ] {
        let source = scene(&format!("constraint(velocity = {velocity})"));
        let input: syn::DeriveInput = syn::parse_str(&source).expect("the source is a struct");
        gauss_codegen::expand(&input).unwrap_or_else(|error| panic!("{velocity}: {error}"));
    }
}

/// No coordinate changes what is under it, and it has a value nowhere.
#[test]
fn constraints_that_nothing_moves() {
    let follows = "this constraint follows from the coordinates, the speeds and the constraints before it, so its \
                   multiplier is undetermined; remove it, or add `redundant` for multipliers of least norm";
    check(&scene("constraint(position = acos(y + m + 3 - y))"), &[("constraint", follows)]);
}

#[test]
fn fields_of_one_name() {
    check(
        "#[gauss(coordinates(x), particle(mass = m, position = [x, 0, 0]), drive(x = k))]
         struct Scene { m: f64, k: f64, k: f64 }",
        &[("k", "the field `k` is declared twice; remove one of the two")],
    );
}

#[test]
fn powers_of_many_factors() {
    let factors = "powers become products, of 100 factors at most; write `powf`";
    check(&scene("potential = h * powi(x, 2147483647)"), &[("2147483647", factors)]);
}

/// In charts, in mass data, in constraints, where a name is used twice, and all of them together.
#[test]
fn everywhere_and_all_at_once() {
    check("#[gauss(mass = 1, inertia = [k, k, 1 / (2 - 2)])] struct Body { k: f64 }", &[("-", ZERO)]);
    check(
        "#[gauss(mass = 1, inertia = k, force(push, at = [0, 0, 0], value = [ln(0), k / (k - k), 0]))] \
           struct Body { k: f64 }",
        &[("0", "the argument of `ln` must be positive, found 0"), ("-", ZERO)],
    );
    check(
        &scene(
            "define(r = h / (k - k)), potential = r * x, constraint(position = x - 1 / (y - y)), \
                force(push, at = [x, r, 0], value = [h, 0, 0])",
        ),
        &[("-", ZERO), ("-", ZERO)],
    );
}

/// Where no state gives the mass matrix a value, nothing tells that it is singular until something divides by it.
#[test]
fn masses_beyond_the_domain_of_a_root() {
    let source = "#[gauss(coordinates(x, y), particle(mass = m, position = [sqrt(-1 - x.powi(2) - y.powi(2)), 0, 0]))] \
                  struct Scene { m: f64 }";
    let message = "the mass matrix has a value at none of the states that were tried, so its pivots are not known to \
                   differ from zero (the equations divide by zero); see whether roots, logarithms and arcs in positions \
                   and kinematics are inside their domains, and whether every speed moves something";
    check(source, &[("Scene", message)]);
}

/// Moments of inertia that no body has at any state that is tried: what cannot be measured is still derived.
#[test]
fn bodies_that_no_sample_can_have() {
    let source = "#[gauss(linearize, regressor, coordinates(a), \
        body(arm, rotation = rotation_y(a), mass = m, center_of_mass = [0, 0, -c], inertia = [m * c, k / 1000, 1000 * k]))] \
        struct Scene { m: f64, c: f64, k: f64 }";
    let input: syn::DeriveInput = syn::parse_str(source).expect("the source is a struct");
    assert!(gauss_codegen::expand(&input).is_ok());
}

/// Levers so long that all digits of the check cancel: it decides nothing, and right equations are not called a bug.
#[test]
fn levers_beyond_all_digits() {
    let source = "#[gauss(coordinates(x, y), central_gravity(mu = 1.5, center = [k, 0, 1000]), \
        particle(mass = 2.5, position = [x, 0, 0]), body(arm, rotation = rotation_z(y), mass = 2.5, \
        center_of_mass = [m - exp(100), 0, m], inertia = [k, 100, 1]))] struct Scene { m: f64, k: f64 }";
    let input: syn::DeriveInput = syn::parse_str(source).expect("the source is a struct");
    assert!(gauss_codegen::expand(&input).is_ok());
}
