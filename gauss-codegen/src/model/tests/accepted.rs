//! Structs that the language accepts, and the model that comes out.

use super::{body, model, with};
use crate::terms::{BodyChart, Chart, Motion, Role, RotationChart, Scalar, Shape};
use quote::ToTokens;

fn in_chart(attributes: &str) -> BodyChart {
    model(&body(attributes)).in_chart.expect("one body is in a chart")
}

#[test]
fn defaults() {
    let model = model(&body(""));
    assert_eq!(model.in_chart, Some(BodyChart { chart: Chart::LeftInvariant, motion: Motion::Free }));
    assert_eq!(model.item.scalar, Scalar::F64);
    assert_eq!(model.item.runtime.to_token_stream().to_string(), ":: gauss_runtime");
    assert_eq!(
        [Role::Mass, Role::Inertia].map(|role| model.item.field(role).map(|field| field.shape)),
        [Some(Shape::Scalar), Some(Shape::Vector3)]
    );
    let optional = [Role::CenterOfMass, Role::AddedMass, Role::Gravity, Role::DisplacedMass, Role::CenterOfBuoyancy];
    assert_eq!(optional.map(|role| model.item.field(role).map(|field| field.shape)), [None; 5]);
}

#[test]
fn every_chart() {
    let chart = |value: &str| in_chart(&format!("#[gauss(chart = {value})]")).chart;
    assert_eq!(chart("left_invariant"), Chart::LeftInvariant);
    assert_eq!(chart("right_invariant"), Chart::RightInvariant);
    assert_eq!(chart("hybrid"), Chart::Hybrid);
    assert_eq!(chart("jet(rodrigues)"), Chart::Jet(RotationChart::Rodrigues));
    assert_eq!(chart("jet(modified_rodrigues)"), Chart::Jet(RotationChart::ModifiedRodrigues));
    let mut sequences = 0;
    for axes in 0..27_u8 {
        let axes = [axes / 9, axes / 3 % 3, axes % 3];
        if axes[0] == axes[1] || axes[1] == axes[2] {
            continue;
        }
        let letters: String = axes.iter().map(|axis| ['x', 'y', 'z'][usize::from(*axis)]).collect();
        assert_eq!(chart(&format!("jet(euler_{letters})")), Chart::Jet(RotationChart::Euler(axes)), "{letters}");
        sequences += 1;
    }
    assert_eq!(sequences, 12);
    assert_eq!(chart("jet, motion = planar"), Chart::Jet(RotationChart::Angle));
    assert_eq!(chart("hybrid, motion = planar"), Chart::Hybrid);
}

#[test]
fn clauses_merge() {
    let merged = model(&body("#[gauss(motion = fixed_point,)] #[gauss(chart = hybrid, crate = ::a::b)]"));
    assert_eq!(merged.in_chart, Some(BodyChart { chart: Chart::Hybrid, motion: Motion::FixedPoint }));
    assert_eq!(merged.item.runtime.to_token_stream().to_string(), ":: a :: b");
    // `jet` may come before the motion that it needs.
    assert_eq!(in_chart("#[gauss(chart = jet)] #[gauss(motion = planar)]").motion, Motion::Planar);
    assert_eq!(model(&body("#[gauss(crate = crate)]")).item.runtime.to_token_stream().to_string(), "crate");
}

#[test]
fn derivatives_only_where_they_are_asked_for() {
    assert!(model(&body("#[gauss(chart = hybrid)]")).item.wanted.linearize.is_none());
    let state = model(&body("#[gauss(chart = hybrid, linearize)]")).item.wanted;
    assert!(state.linearize.is_some() && !state.by_parameters && state.regressor.is_none());
    let all = model(&body("#[gauss(linearize(parameters), regressor)]")).item.wanted;
    assert!(all.linearize.is_some() && all.by_parameters && !all.inverse && all.regressor.is_some());
    let both = model(&body("#[gauss(linearize(inverse, parameters, hessian))]")).item.wanted;
    assert!(both.linearize.is_some() && both.by_parameters && both.inverse && both.hessian);
    assert!(model(&body("#[gauss(linearize, drag(linear = [1, 1, 1, 1, 1, 1]))]")).item.wanted.linearize.is_some());
}

#[test]
fn every_role_and_shape() {
    let shape = |role: &str, ty: &str| {
        let source = match role.split(' ').next() {
            Some("mass") => {
                format!("struct Body {{ #[gauss({role})] x: {ty}, #[gauss(inertia)] j: f64 }}")
            }
            Some("inertia") => {
                format!("struct Body {{ #[gauss({role})] x: {ty}, #[gauss(mass)] m: f64 }}")
            }
            _ => format!(
                "struct Body {{ #[gauss({role})] x: {ty}, #[gauss(mass)] m: f64, #[gauss(inertia)] j: f64, \
                 {} {} }}",
                if role.starts_with("gravity") { "" } else { "#[gauss(gravity)] g: f64," },
                if role.starts_with("displaced") { "" } else { "#[gauss(displaced_mass)] d: f64," },
            ),
        };
        model(&source).item.fields[0].shape
    };
    assert_eq!(shape("mass", "f64"), Shape::Scalar);
    assert_eq!(shape("mass", "::core::primitive::f64"), Shape::Scalar);
    assert_eq!(shape("mass", "Kilogram"), Shape::Scalar);
    assert_eq!(shape("center_of_mass", "Vector3<f64>"), Shape::Vector3);
    assert_eq!(shape("center_of_mass", "Point"), Shape::Vector3);
    assert_eq!(shape("inertia", "f64"), Shape::Scalar);
    assert_eq!(shape("inertia", "nalgebra::Vector3<f64>"), Shape::Vector3);
    assert_eq!(shape("inertia", "(Matrix3<f64>)"), Shape::Matrix3);
    assert_eq!(shape("inertia", "SMatrix<f64, 3, 3>"), Shape::Matrix3);
    assert_eq!(shape("inertia = principal", "Moments"), Shape::Vector3);
    assert_eq!(shape("inertia = spherical", "Moments"), Shape::Scalar);
    assert_eq!(shape("inertia = full", "Matrix3<f64>"), Shape::Matrix3);
    assert_eq!(shape("added_mass", "Vector6<f64>"), Shape::Vector6);
    assert_eq!(shape("added_mass", "SVector<f64, { 6 }>"), Shape::Vector6);
    assert_eq!(shape("added_mass", "SMatrix<f64, 6, 6>"), Shape::Matrix6);
    assert_eq!(shape("added_mass = diagonal", "SVector<f64, SIX>"), Shape::Vector6);
    assert_eq!(shape("gravity", "f64"), Shape::Scalar);
    assert_eq!(shape("gravity", "Vector3<f64>"), Shape::Vector3);
    assert_eq!(shape("gravity = vector", "Field"), Shape::Vector3);
    assert_eq!(shape("displaced_mass", "f64"), Shape::Scalar);
    assert_eq!(shape("center_of_buoyancy", "Vector3<f64>"), Shape::Vector3);
}

#[test]
fn scalars() {
    let scalar = |source: &str| model(source).item.scalar.to_string();
    assert_eq!(scalar("struct Body { #[gauss(mass)] m: f32, #[gauss(inertia)] j: Vector3<f32> }"), "f32");
    assert_eq!(scalar("struct Body<T> { #[gauss(mass)] m: T, #[gauss(inertia)] j: Matrix3<T> }"), "T");
    assert_eq!(scalar("struct Body<T> { #[gauss(mass)] m: Kg, #[gauss(inertia = full)] j: Tensor<T> }"), "T");
    assert_eq!(scalar("struct Body<T, L> { #[gauss(mass)] m: T, #[gauss(inertia)] j: T, label: L }"), "T");
    assert_eq!(scalar("struct Body<L> { #[gauss(mass)] m: f64, #[gauss(inertia)] j: f64, label: L }"), "f64");
}

#[test]
fn a_hidden_dimension_still_shows_the_scalar() {
    let source = "struct Body { #[gauss(mass)] m: Kg, #[gauss(inertia = principal)] j: SVector<f32, N> }";
    let model = model(source);
    assert_eq!((model.item.scalar, model.item.fields[1].shape), (Scalar::F32, Shape::Vector3));
}

#[test]
fn plain_parameters() {
    let source = with("k: f64, v: Vector3<f64>, single: f32, name: String, r: &'static str, n: usize");
    let shapes: Vec<Shape> = model(&source).item.fields.iter().skip(2).map(|parameter| parameter.shape).collect();
    let expected = [Shape::Scalar, Shape::Vector3, Shape::Other, Shape::Other, Shape::Other, Shape::Other];
    assert_eq!(shapes, expected);
    assert!(model(&source).item.fields.iter().skip(2).all(|parameter| parameter.role.is_none()));
}

#[test]
fn documentation_and_order() {
    let model = model(
        "pub struct Body { plain: u8, \
         #[doc = \" Mass in kg,\"] #[doc = \"   dry. \"] #[doc(hidden)] #[gauss(mass)] m: f64, #[gauss(inertia)] j: f64 }",
    );
    let name = |role: Role| model.item.field(role).map(|field| field.ident.to_string());
    assert_eq!([Role::Mass, Role::Inertia].map(name), [Some("m".into()), Some("j".into())]);
    assert_eq!(model.item.ident, "Body");
    assert_eq!(model.item.fields[1].documentation, "Mass in kg,\ndry.");
    assert_eq!(model.item.fields[0].documentation, "");
    assert_eq!(model.item.fields[1].role, Some(Role::Mass));
}
