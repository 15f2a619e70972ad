//! What is told instead of being done wrong.

use gauss_contact::ContactErrorKind;
use gauss_parry::parry3d_f64::math::Vector;
use gauss_parry::parry3d_f64::shape::SharedShape;
use gauss_parry::{ParryErrorKind, ParrySteps, Reduction, Shapes};
use gauss_runtime::contact::ContactSystem;
use gauss_runtime::prelude::*;

use crate::plane::surface;

/// Two crates.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(p: Pose, q: Pose),
    body(one, position = p.position, rotation = p.rotation, mass = 2, inertia = [0.06, 0.05, 0.04]),
    body(two, position = q.position, rotation = q.rotation, mass = 2, inertia = [0.06, 0.05, 0.04]),
    frames(one, two),
)]
struct Two {
    #[gauss(gravity)]
    g: f64,
}

fn cubes() -> Shapes<TwoFrame> {
    let mut shapes = Shapes::new();
    for frame in [TwoFrame::one, TwoFrame::two] {
        shapes.add(Some(frame), SharedShape::cuboid(0.1, 0.1, 0.1), Isometry3::identity(), surface(0.5, 0.0));
    }
    shapes
}

fn apart(way: f64) -> (f64, (Isometry3<f64>, Isometry3<f64>), SVector<f64, 12>) {
    let state = TwoState { q: Isometry3::translation(0.01, 0.02, way), ..Default::default() };
    (0.0, state.q(), state.z())
}

#[test]
fn points_are_never_dropped_unless_that_is_asked_for() {
    let kernel = Two { g: 9.81 }.kernel().unwrap();
    // Faces that have a rectangle in common: four points.
    let error = ParrySteps::<_, 3, 9, _>::new(&kernel, cubes(), apart(0.2)).unwrap_err();
    assert_eq!(error.kind, ParryErrorKind::Points { points: 4, slots: 3 });
    let error = ParrySteps::<_, 8, 24, _>::new(&kernel, cubes().most(3), apart(0.2)).unwrap_err();
    assert_eq!(error.kind, ParryErrorKind::PairPoints { points: 4, most: 3 });
    assert!(error.to_string().starts_with("shapes 0 and 1: they touch at 4 points and may at 3"), "{error}");
    // Equal cubes on one another: the library has corners of both, of which four are left if that is asked for.
    let (t, mut q, z) = apart(0.2);
    q.1.translation.vector = Vector3::new(0.0, 0.0, 0.2);
    let steps = ParrySteps::<_, 16, 48, _>::new(&kernel, cubes(), (t, q, z)).unwrap();
    assert!(steps.shapes().found().len() > 4);
    let shapes = cubes().reduce(Reduction::Quadrilateral);
    let steps = ParrySteps::<_, 4, 12, _>::new(&kernel, shapes, (t, q, z)).unwrap();
    assert_eq!(steps.shapes().found().len(), 4);
}

#[test]
fn shapes_inside_one_another_are_refused() {
    let kernel = Two { g: 9.81 }.kernel().unwrap();
    let error = ParrySteps::<_, 8, 24, _>::new(&kernel, cubes(), apart(0.15)).unwrap_err();
    assert!(matches!(error.kind, ParryErrorKind::TooDeep { gap, .. } if (gap + 0.05).abs() < 1e-12), "{error}");
    let error = ParrySteps::<_, 8, 24, _>::new(&kernel, cubes().deepest(0.1), apart(0.15)).unwrap_err();
    assert!(
        matches!(&error.kind, ParryErrorKind::Contact(error)
        if matches!(error.kind, ContactErrorKind::NegativeGap { .. })),
        "{error}"
    );
    // Faster than the reach is long they are seen too late.
    let (t, q, mut z) = apart(0.3);
    z[8] = -120.0;
    let mut steps = ParrySteps::<_, 8, 24, _>::new(&kernel, cubes(), (t, q, z)).unwrap();
    let before = *steps.configuration();
    steps.step(1e-3, &()).unwrap();
    let error = steps.step(1e-3, &()).unwrap_err();
    assert!(matches!(error.kind, ParryErrorKind::TooDeep { .. }), "{error}");
    assert!((before.1.translation.z - steps.configuration().1.translation.z - 0.12).abs() < 1e-4);
    // Seen in time they stop at one another.
    let mut steps = ParrySteps::<_, 8, 24, _>::new(&kernel, cubes().reach(0.2), (t, q, z)).unwrap();
    for _ in 0..5 {
        steps.step(1e-3, &()).unwrap();
    }
    // Off its centre, so that both turn; gaps are rounding of places up to 1.
    let gaps = steps.slots().gaps(0.0, steps.configuration());
    assert!(gaps.min() > -1e-14, "{gaps}");
}

#[test]
fn pairs_may_be_left_out_and_have_surfaces_of_their_own() {
    let kernel = Two { g: 9.81 }.kernel().unwrap();
    let mut shapes = Shapes::new();
    let mut add = |frame, restitution, friction| {
        let cube = SharedShape::cuboid(0.1, 0.1, 0.1);
        shapes.add(Some(frame), cube, Isometry3::identity(), surface(friction, restitution))
    };
    let (a, b) = (add(TwoFrame::one, 0.1, 0.9), add(TwoFrame::two, 0.3, 0.4));
    let (_, (p, q), _) = apart(0.2);
    let pose = |frame: TwoFrame| kernel.pose_of(frame, 0.0, &(p, q));
    let slots = shapes.update(pose).unwrap();
    assert!(slots.iter().all(|found| (found.slot.friction - 0.6).abs() < 1e-15 && found.slot.restitution == 0.3));
    let mut shapes = shapes.between(b, a, surface(0.2, 0.0));
    assert!(shapes.update(pose).unwrap().iter().all(|found| found.slot.friction == 0.2));
    let mut shapes = shapes.without(b, a);
    assert!(shapes.update(pose).unwrap().is_empty());
    let wrong = shapes.reach(f64::NAN).update(pose).unwrap_err();
    assert!(matches!(wrong.kind, ParryErrorKind::Number { field: "reach", .. }), "{wrong}");
}

#[test]
fn what_the_library_does_not_know_is_told() {
    let kernel = Two { g: 9.81 }.kernel().unwrap();
    let mut shapes = Shapes::new();
    for frame in [TwoFrame::one, TwoFrame::two] {
        shapes.add(Some(frame), SharedShape::halfspace(Vector::Z), Isometry3::identity(), surface(0.5, 0.0));
    }
    let error = ParrySteps::<_, 8, 24, _>::new(&kernel, shapes, apart(0.2)).unwrap_err();
    assert_eq!(error.kind, ParryErrorKind::Unsupported);
}
