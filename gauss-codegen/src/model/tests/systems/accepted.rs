//! Systems that are accepted, and the model that comes out.

use super::{potential, show, system};
use crate::terms::{Role, Scalar, Shape};

fn words<'a>(idents: impl IntoIterator<Item = &'a syn::Ident>) -> Vec<String> {
    idents.into_iter().map(ToString::to_string).collect()
}

#[test]
fn chaplygin_sleigh() {
    let model = system(
        "#[gauss(coordinates(x, y, theta), speeds(v, omega), \
         kinematics(theta = omega, y = v * sin(theta), x = v * cos(theta)), \
         body(position = [x, y, 0], rotation = rotation_z(theta)))] \
         pub struct ChaplyginSleigh { #[gauss(mass)] m: f64, #[gauss(center_of_mass)] a: Vector3<f64>, \
         #[gauss(inertia)] j: Vector3<f64> }",
    );
    assert_eq!(model.item.ident, "ChaplyginSleigh");
    assert_eq!(words(model.coordinates.iter().map(|q| &q.ident)), ["x", "y", "theta"]);
    assert_eq!(words(model.speeds.iter().flatten().map(|z| &z.ident)), ["v", "omega"]);
    // In the order of the coordinates, whatever the order in which they are written.
    let kinematics: Vec<String> =
        model.kinematics.iter().map(|(name, rate)| format!("{name} = {}", show(rate))).collect();
    assert_eq!(kinematics, ["x = (Multiply v (cos theta))", "y = (Multiply v (sin theta))", "theta = omega"]);
    let [body] = model.bodies.as_slice() else { panic!("one body") };
    assert!(body.name.is_none() && body.parent.is_none());
    assert_eq!(body.position.as_ref().map(show).as_deref(), Some("[x y 0]"));
    assert_eq!(body.rotation.as_ref().map(show).as_deref(), Some("(rotation_z theta)"));
    let roles: Vec<_> = model.item.fields.iter().map(|field| (field.role, field.shape)).collect();
    assert_eq!(
        roles,
        [
            (Some(Role::Mass), Shape::Scalar),
            (Some(Role::CenterOfMass), Shape::Vector3),
            (Some(Role::Inertia), Shape::Vector3)
        ]
    );
    assert!(model.particles.is_empty() && model.potential.is_none());
}

#[test]
fn named_bodies_with_parents() {
    let model = system(
        "#[gauss(crate = my::runtime)] #[gauss(coordinates(a, b), \
         body(lower, parent = upper, position = [0, 0, -l], rotation = rotation_x(b)), \
         body(upper, rotation = rotation_z(t) * rotation_x(a)))] \
         struct Pendulum<T> { l: T, #[gauss(gravity)] g: T, \
         /// The first.\n #[gauss(body)] upper: RigidBody<T>, #[gauss(body)] lower: Link }",
    );
    assert_eq!(model.item.scalar.to_string(), "T");
    assert!(matches!(model.item.scalar, Scalar::Parameter(_)));
    assert_eq!(model.item.runtime.to_string(), "my :: runtime");
    assert!(model.speeds.is_none() && model.kinematics.is_empty());
    let [lower, upper] = model.bodies.as_slice() else { panic!("two bodies") };
    assert_eq!(lower.name.as_ref().map(ToString::to_string).as_deref(), Some("lower"));
    assert_eq!(lower.parent.as_ref().map(ToString::to_string).as_deref(), Some("upper"));
    assert_eq!(lower.position.as_ref().map(show).as_deref(), Some("[0 0 (-l)]"));
    assert!(upper.parent.is_none() && upper.position.is_none());
    assert_eq!(upper.rotation.as_ref().map(show).as_deref(), Some("(Multiply (rotation_z t) (rotation_x a))"));
    assert_eq!(model.item.fields[2].documentation, "The first.");
    assert_eq!((model.item.fields[2].role, model.item.fields[2].shape), (Some(Role::Body), Shape::RigidBody));
    // Behind an alias the role says what it is.
    assert_eq!(model.item.fields[3].shape, Shape::RigidBody);
}

#[test]
fn expressions() {
    let read = |value: &str| show(&system(&potential(value)).potential.expect("there is a potential"));
    assert_eq!(read("1.5e-1 * x"), "(Multiply 3/20 x)");
    assert_eq!(read("1_000f64"), "1000");
    assert_eq!(read("-x.powi(2)"), "(-(powi x 2))");
    assert_eq!(read("powi(x, -2) + x.sin()"), "(Add (powi x -2) (sin x))");
    assert_eq!(read("x - y - k"), "(Subtract (Subtract x y) k)");
    assert_eq!(read("x / (y * k)"), "(Divide x (Multiply y k))");
    assert_eq!(read("a.x + a[2]"), "(Add a[0] a[2])");
    assert_eq!(read("dot(a, cross(b, [x, y, t]))"), "(dot a (cross b [x y t]))");
    assert_eq!(read("a.dot(&b) * 2"), "(Multiply (dot a b) 2)");
    assert_eq!(
        read("(rotation_z(x) * (a / 2 + 3 * b)).z"),
        "(Multiply (rotation_z x) (Add (Divide a 2) (Multiply 3 b)))[2]"
    );
    assert_eq!(read("exp(ln(sqrt(tan(cos(x)))))"), "(exp (ln (sqrt (tan (cos x)))))");
}

#[test]
fn scalars() {
    let scalar = |source: &str| system(source).item.scalar;
    // Fields that nothing names do not count.
    assert_eq!(
        scalar(
            "#[gauss(coordinates(x), particle(mass = m, position = [x, 0, 0]))] \
             struct Scene { m: f32, other: f64, another: f64 }"
        ),
        Scalar::F32
    );
    assert_eq!(
        scalar("#[gauss(coordinates(x), particle(mass = 1, position = [x, 0, 0]))] struct Scene {}"),
        Scalar::F64
    );
}

/// Brackets that macros put around their fragments are invisible and bind all the same.
#[test]
fn fragments_stay_operands() {
    use proc_macro2::{Delimiter, Group, TokenStream, TokenTree};
    let sum: TokenStream = "x + y".parse().expect("tokens");
    let sum = TokenTree::Group(Group::new(Delimiter::None, sum));
    let input: syn::DeriveInput = syn::parse_quote! {
        #[gauss(coordinates(x, y), particle(mass = m, position = [x, y, 0]), potential = 2 * #sum)]
        struct Scene { m: f64 }
    };
    let model = crate::model::parse(&input).expect("a system");
    assert_eq!(model.potential.as_ref().map(show).as_deref(), Some("(Multiply 2 (Add x y))"));
}
