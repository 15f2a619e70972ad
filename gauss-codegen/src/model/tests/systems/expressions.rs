//! Forms outside the language, and kinds that do not fit.

use super::super::check;
use super::{check_potential, particle, system};
use crate::model::language::arithmetic::ALLOWED;

#[test]
fn forms() {
    let outside = |form: &str| format!("{form} is outside the language of expressions; {ALLOWED}");
    check_potential("if x { 1 } else { 2 }", &[("if", &outside("`if`"))]);
    check_potential("x == y", &[("==", &outside("`==`"))]);
    check_potential("x % y", &[("%", &outside("`%`"))]);
    check_potential("x..y", &[("..", &outside("a range"))]);
    check_potential("x as f64", &[("as", &outside("`as`"))]);
    check_potential("(|z| z)(x)", &[("(", &outside("a call of anything but a function"))]);
    check_potential("k * |z| z", &[("|", &outside("a closure"))]);
    check_potential("f64::consts::TAU", &[("f64", &outside("a path"))]);
    check_potential("f64::consts::PI * x", &[("f64::consts::PI", "π is `pi` in expressions; write `pi`")]);
    check_potential("m!(x)", &[("m", &outside("a macro"))]);
    check_potential("(x, y)", &[("(", &outside("a tuple"))]);
    check_potential("!x", &[("!", &outside("`!`"))]);
    check_potential("&x", &[("&", &outside("a reference"))]);
    check_potential("x ^ 2", &[("^", "`^` is no power; write `powi(a, 2)`")]);
    check_potential(
        "x ** 2",
        &[("*", "nothing stands before this `*`; a product is written `a * b`, a power `powi(a, 2)`")],
    );
    check_potential("self.k * x", &[("self", "expressions name fields without `self`; write `k`")]);
    check_potential("\"x\"", &[("\"x\"", &format!("`\"x\"` is no number; {ALLOWED}"))]);
    check_potential("x +", &[("+", "the expression of `potential` breaks off here; write its other part")]);
    check_potential("1 x", &[("x", &format!("`potential` is no expression: unexpected token; {ALLOWED}"))]);
    let half = "a number begins with a digit; write `0.5` in place of `.5`";
    for number in [".5", "x + .5", "-.5 * x", "x * sin(.5)", "cross([.5, 0, 0], x)"] {
        check_potential(number, &[(".", half)]);
    }
    check_potential("x + .5e-3", &[(".", "a number begins with a digit; write `0.5e-3` in place of `.5e-3`")]);
    // All of them, not only the first.
    check_potential("x == if y { 1 } else { 2 }", &[("==", &outside("`==`")), ("if", &outside("`if`"))]);
}

#[test]
fn numbers() {
    let beyond =
        |number: &str| format!("`{number}` is beyond the range of double precision, which is from 1e-308 to 1e308");
    check_potential("1e309 * x", &[("1e309", &beyond("1e309"))]);
    check_potential("1e-330", &[("1e-330", &beyond("1e-330"))]);
    check_potential("2u8", &[("2u8", "`2u8` counts in `u8`, but expressions are real numbers; write `2`")]);
    check_potential("x / 0", &[("0", "division by zero")]);
    check_potential("x / 0.0 + 0.powi(-1)", &[("0.0", "division by zero"), ("0", "division by zero")]);
}

#[test]
fn functions() {
    const FUNCTIONS: &str = "`sin`, `cos`, `tan`, `asin`, `acos`, `atan`, `tanh`, `exp`, `ln`, `sqrt`, `powi`, `powf`, \
        `atan2`, `dot`, `cross`, `rotation_x`, `rotation_y`, `rotation_z`, `inverse`, `twist`, `rate`, `abs`, `min`, `max`, `hypot`, \
        `signum`, `clamp` or `smooth_step`; a function of your own is declared by `function(erf, derivative = …)`";
    check_potential("sine(x)", &[("sine", "unknown function `sine`; did you mean `sin`?")]);
    check_potential(
        "powf(x, y)",
        &[("y", "`y` varies, and the exponent of `powf` is made of numbers and fields; write `exp` and `ln`")],
    );
    check_potential("erf(x)", &[("erf", &format!("unknown function `erf`; expected {FUNCTIONS}"))]);
    check_potential("sin(x, y)", &[("sin", "`sin` takes one argument, found 2; write `sin(x)`")]);
    check_potential("a.dot()", &[("dot", "`dot` takes two arguments, found 1; write `dot(a, b)`")]);
    check_potential("clamp(x, y)", &[("clamp", "`clamp` takes three arguments, found 2; write `clamp(x, low, high)`")]);
    check_potential(
        "smooth_step(x)",
        &[("smooth_step", "`smooth_step` takes three arguments, found 1; write `smooth_step(x, from, to)`")],
    );
    let exponent = "the exponent of `powi` is an integer literal, such as 2 or -1; \
        for other powers write `powf`";
    check_potential("powi(x, 0.5)", &[("0.5", exponent)]);
    check_potential("x.powi(y)", &[("y", exponent)]);
    check_potential("sin * x", &[("sin", "`sin` is a function; write `sin(x)`")]);
    check_potential("x.sin", &[("sin", "the function `sin` needs brackets; write `.sin()`")]);
    check_potential("f64::sin(x)", &[("f64::sin", "functions are called by their own names; write `sin(…)`")]);
    check_potential(
        "Vector3::new(x, y, 0).x",
        &[("Vector3::new", "vectors are written in square brackets; write `[x , y , 0]`")],
    );
}

#[test]
fn kinds() {
    check_potential("x + a", &[("+", "`+` joins two scalars or two vectors, found a scalar and a vector")]);
    check_potential("a * b", &[("*", "two vectors have two products; write `dot(a, b)` or `cross(a, b)`")]);
    check_potential("x / a", &[("/", "`/` divides a scalar or a vector by a scalar, found a scalar and a vector")]);
    check_potential(
        "(a * rotation_x(y)).x",
        &[("*", "a rotation stands before the vector that it turns; write `rotation * vector`")],
    );
    check_potential(
        "(2 * rotation_x(y) * a).x",
        &[("*", "`*` turns a vector or another rotation, found a scalar and a rotation")],
    );
    check_potential(
        "(-rotation_x(y) * a).x",
        &[("-", "a rotation has no negative; the inverse of `r` is `inverse(r)`")],
    );
    check_potential("sin(a)", &[("a", "`sin` takes a scalar, found a vector")]);
    check_potential("dot(a, x)", &[("x", "`dot` takes a vector, found a scalar")]);
    check_potential("a.powi(2)", &[("a", "`powi` takes a scalar, found a vector")]);
    check_potential("x.y", &[("y", "components are those of a vector, found a scalar")]);
    check_potential(
        "a.w",
        &[(
            "w",
            "there is no `.w`; the components of a vector are `.x`, `.y` and `.z`, bodies have `.position`, `.rotation`, \
             `.velocity`, `.angular_velocity`, `.body_velocity`, `.body_angular_velocity` and `.relative_velocity`, and \
             inputs that are wrenches have `.force` and `.torque`",
        )],
    );
    check_potential("a[3]", &[("3", "a vector has the components 0, 1 and 2; write `[0]`, `[1]` or `[2]`")]);
    check_potential("[x, a, 0].x", &[("a", "each component of a vector is a scalar, found a vector")]);
    check_potential("[x, y].x", &[("[", "a vector has three components, found 2; in a plane write `[x, y, 0]`")]);
    check_potential(
        "[x, y, x, y].x",
        &[(
            "[",
            "a vector has three components, found 4; a rotation by a quaternion is one coordinate, \
             `coordinates(turn: Rotation)` with `rotation = turn`",
        )],
    );
    check_potential(
        "a",
        &[("a", "a potential is a scalar, found a vector; write one number, such as `k * x * x / 2`")],
    );
    check(
        "#[gauss(coordinates(x), speeds(v), kinematics(x = [v, v, v]), \
         particle(mass = a, position = x), body(rotation = x))] \
         struct Scene { a: Vector3<f64>, #[gauss(mass)] m: f64, #[gauss(inertia)] j: f64 }",
        &[
            ("[", "the rate of a coordinate is a scalar, found a vector; write one number, such as `v * cos(theta)`"),
            ("x", "expected a rotation, found a scalar; write `rotation_z(theta)`, or a product of such turns"),
            ("a", "the mass of a particle is a scalar, found a vector; write one number or the name of a field"),
            ("x", "a position is a vector, found a scalar; write `[x, y, z]`"),
        ],
    );
}

#[test]
fn names() {
    check_potential("k * yy", &[("yy", "unknown name `yy`; did you mean the coordinate `y`?")]);
    check_potential("K * x", &[("K", "unknown name `K`; did you mean the field `k`?")]);
    // Of single letters none is nearer than another.
    check_potential(
        "k * q",
        &[("q", "unknown name `q`; expected a coordinate (`x` or `y`), a field (`m`, `k`, `a` or `b`) or `t`")],
    );
    check_potential(
        "n * x",
        &[(
            "n",
            "the type of the field `n` is `usize`, and expressions name scalars and vectors only: \
             `f64` or `Vector3<f64>`",
        )],
    );
    check_potential(
        "j * x",
        &[(
            "j",
            "the type of the field `j` is `Matrix3`, and expressions name scalars and vectors only: \
             `f64` or `Vector3<f64>`",
        )],
    );
    check_potential(
        "s * x",
        &[(
            "s",
            "the kind of the field `s` cannot be read from `Stiffness`; write `f64` or `Vector3<f64>` for its type",
        )],
    );
    check(
        &particle("potential = k * x", "k: f32"),
        &[(
            "f32",
            "the scalar of `k` is `f32`, but that of `m` is `f64`; one scalar serves the whole system: write `f64`",
        )],
    );
}

/// Tables on grids: what they are given by, and how many numbers they take.
#[test]
fn tables_on_grids() {
    let with = |clauses: &str, potential: &str| particle(&format!("{clauses}, potential = {potential}"), "");
    system(&with(
        "table(one, axes = [aero::X], values = V, kind = hermite), table(two, axes = [X, Y], values = W, kind = cubic), \
         table(three, axes = [X, Y, Z], values = a::U, kind = hermite)",
        "one(x) + two(x, y) + y.two(x) + three(x, y, x * y)",
    ));
    check(
        &with("table(drag, axes = [aero::ALPHA, MACH], values = DRAG, kind = cubic)", "drag(x) + drag(x, y, x) + drag"),
        &[
            ("drag", "`drag` takes two arguments, found 1; write `drag(alpha, mach)`"),
            ("drag", "`drag` takes two arguments, found 3; write `drag(alpha, mach)`"),
            ("drag", "`drag` is a function; write `drag(alpha, mach)`"),
        ],
    );
    check(
        &with("table(flat, axes = [X, Y], values = V)", "flat(x, y)"),
        &[(
            "flat",
            "the derivative of the table `flat` jumps, and a potential is differentiated; write `kind = cubic`",
        )],
    );
    let axes =
        "`axes` are constant arrays of numbers that increase; write `axes = [X, Y]` and `const X: [f64; N] = …;`";
    check(
        &particle(
            "table(a, points = P, axes = [X]), table(b, axes = [X, Y]), table(c, values = V), \
             table(d, axes = X, values = V), table(e, axes = [X, 2], values = V), table(f, axes = [], values = V), \
             table(g, axes = [X, Y, Z, W], values = V), table(h, axes = (X, Y), values = V), \
             table(i, axes = [X], values = |x| x)",
            "",
        ),
        &[
            (
                "points",
                "a table is given by `points = …`, or by `axes = […]` and `values = …` on their grid; remove one of them",
            ),
            ("axes", "a table with axes needs its values; add `values = VALUES`"),
            ("values", "values of a table need the axes of their grid; add `axes = [X, Y]`"),
            ("X", axes),
            ("2", axes),
            ("[", "a table has one, two or three axes, found 0"),
            ("W", "a table has one, two or three axes, found 4"),
            ("(", axes),
            (
                "|",
                "`values` is the path of a constant array of values on the grid, found `|`; closures have no name: write \
                 a `fn`",
            ),
        ],
    );
}

/// Functions of the user's own, tables, and their places.
#[test]
fn own_functions() {
    let with = |clauses: &str, potential: &str| particle(&format!("{clauses}, potential = {potential}"), "");
    system(&with(
        "function(lift, derivative = slope), table(spline, points = a::POINTS, kind = cubic)",
        "lift(x) + y.spline() + pi",
    ));
    system(&with("function(lift = aero::lift, derivative = aero::slope, second = aero::second)", "lift(x)"));
    check(
        &with("table(line, points = POINTS)", "line(x)"),
        &[(
            "line",
            "the derivative of the table `line` jumps, and a potential is differentiated; write `kind = cubic`",
        )],
    );
    check(
        &with("function(lift, derivative = slope)", "lifd(x) + lift"),
        &[("lifd", "unknown function `lifd`; did you mean `lift`?"), ("lift", "`lift` is a function; write `lift(x)`")],
    );
    check(
        &particle(
            "function(derivative = slope), function(lift, second = bend), table(line), table(line, points = |x| x), \
             table(spline, points = P, kind = round), function(sin, derivative = cos)",
            "",
        ),
        &[
            ("function", "a function needs a name to be called by; write `function(name, derivative = …)`"),
            ("second", "derivatives are given in order; add `derivative = …`"),
            (
                "table",
                "a table needs its points; add `points = POINTS` and `const POINTS: [[f64; 2]; 2] = [[x, y], …];`, or \
                 `axes = [X, Y]` and `values = VALUES`",
            ),
            (
                "|",
                "`points` is the path of a constant array of points `[[x, y], …]`, found `|`; closures have no name: write \
                 a `fn`",
            ),
            ("round", "unknown kind of table `round`; expected `linear`, `hermite` or `cubic`"),
            ("sin", "`sin` is a function of expressions and cannot name a function; rename it"),
        ],
    );
}
