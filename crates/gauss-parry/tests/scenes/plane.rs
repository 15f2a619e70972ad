//! A box on a plane: its corners by a clause, and by the library.

use gauss_contact::{ContactSteps, Mode};
use gauss_parry::parry3d_f64::math::Vector;
use gauss_parry::parry3d_f64::shape::SharedShape;
use gauss_parry::{ParrySteps, Shapes, Surface};
use gauss_runtime::prelude::*;

/// A crate on its eight corners, by its clause.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(pose: Pose),
    body(hull, position = pose.position, rotation = pose.rotation, mass = 2, inertia = [0.06, 0.05, 0.04]),
    contact(floor, point = hull.position, edges = [0.4, 0.3, 0.2], friction = mu, restitution = e),
)]
struct Clause {
    mu: f64,
    e: f64,
    #[gauss(gravity)]
    g: f64,
}

/// The same without contacts.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(pose: Pose),
    body(hull, position = pose.position, rotation = pose.rotation, mass = 2, inertia = [0.06, 0.05, 0.04]),
    frames(hull),
)]
struct Bare {
    #[gauss(gravity)]
    g: f64,
}

/// A ball.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(pose: Pose),
    body(hull, position = pose.position, rotation = pose.rotation, mass = 2, inertia = 0.8 * r * r),
    frames(hull),
)]
struct Sphere {
    r: f64,
    #[gauss(gravity)]
    g: f64,
}

/// The same by its clause.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(pose: Pose),
    body(hull, position = pose.position, rotation = pose.rotation, mass = 2, inertia = 0.8 * r * r),
    contact(floor, point = hull.position, radius = r, friction = mu),
)]
struct Ball {
    r: f64,
    mu: f64,
    #[gauss(gravity)]
    g: f64,
}

pub fn surface(friction: f64, restitution: f64) -> Surface {
    Surface { friction, restitution }
}

fn shapes(mu: f64, e: f64) -> Shapes<BareFrame> {
    let mut shapes = Shapes::new();
    let up = SharedShape::halfspace(Vector::Z);
    shapes.add(None, up, Isometry3::identity(), surface(mu, e));
    shapes.add(Some(BareFrame::hull), SharedShape::cuboid(0.2, 0.15, 0.1), Isometry3::identity(), surface(mu, e));
    // So far that all corners of the lower face are seen, whatever the box does in the air.
    shapes.reach(0.6)
}

#[test]
fn a_box_moves_as_with_the_clause() {
    let g = 9.81;
    let pose = Isometry3::new(Vector3::new(0.1, -0.2, 0.35), Vector3::new(0.4, -0.7, 0.3));
    let z = SVector::from([0.7, -0.2, 0.3, 1.0, -2.0, 0.5]);
    for (mu, e) in [(0.5, 0.0), (0.2, 0.3), (0.0, 0.0)] {
        let (clause, bare) = (Clause { mu, e, g }.kernel().unwrap(), Bare { g }.kernel().unwrap());
        let expected = ContactSteps::new(&clause, 1e-3).run(pose, z, 0.0..1.0).unwrap();
        let mut steps = ParrySteps::<_, 8, 24, _>::new(&bare, shapes(mu, e), (0.0, pose, z)).unwrap();
        let mut apart = Vec::new();
        for expected in &expected {
            steps.step(1e-3, &()).unwrap();
            let (a, b) = (steps.configuration(), &expected.state.q);
            let turned = (a.rotation.coords - b.rotation.coords).amax();
            apart.push((a.translation.vector - b.translation.vector).amax().max(turned));
        }
        let worst = |steps: &[f64]| steps.iter().copied().fold(0.0, f64::max);
        // Rounding of places and turns of order 1: some ten for each of 400 steps, in which corners meet the floor one
        // after the other.
        let early = worst(&apart[..400]);
        assert!(early < 4000.0 * f64::EPSILON, "{mu} {e} {early:e}");
        let late = worst(&apart);
        let gaps = expected.last().unwrap().report.closed;
        let mut allowed = 1000.0 * 10.0 * f64::EPSILON;
        if e > 0.0 {
            // An edge lands at last. Rounding decides which of its corners is first, and so how fast the box slides
            // from there: what differs is a part of the way that is left to it, less than a tenth of a millimetre.
            let landed = expected.iter().position(|step| step.report.closed == gaps).unwrap();
            let [a, b] = [landed - 1, apart.len() - 1].map(|i| expected[i].state.q.translation.vector);
            allowed = (a - b).amax();
            assert!(allowed < 1e-4, "{mu} {e} {allowed:e}");
        }
        assert!(late < allowed, "{mu} {e} {late:e}");
        // In the end it lies on the same face.
        assert_eq!(steps.modes().iter().filter(|mode| mode.is_closed()).count(), gaps);
    }
}

#[test]
fn a_ball_rolls_as_with_its_clause() {
    let (g, r, mu) = (9.81, 0.1, 0.3);
    let (clause, kernel) = (Ball { g, r, mu }.kernel().unwrap(), Sphere { g, r }.kernel().unwrap());
    let z = SVector::from([2.0, 0.0, 0.0, 0.0, 1.0, 3.0]);
    let pose = Isometry3::translation(0.0, 0.0, r);
    for h in [1e-2, 1e-3] {
        let mut shapes = Shapes::new();
        shapes.add(Some(SphereFrame::hull), SharedShape::ball(r), Isometry3::identity(), surface(mu, 0.0));
        shapes.add(None, SharedShape::halfspace(Vector::Z), Isometry3::identity(), surface(mu, 0.0));
        let mut steps = ParrySteps::<_, 1, 3, _>::new(&kernel, shapes, (0.0, pose, z)).unwrap();
        for expected in ContactSteps::new(&clause, h).run(pose, z, 0.0..1.0).unwrap() {
            steps.step(h, &()).unwrap();
            let (a, b) = (steps.configuration(), &expected.state.q);
            // Some ten roundings of places up to 2 for each of a thousand steps.
            assert!((a.translation.vector - b.translation.vector).amax() < 1e4 * 2.0 * f64::EPSILON, "{h} {a} {b}");
            // What the projection of such places leaves: two roundings of them.
            assert!((a.translation.z - r).abs() <= 2.0 * 2.0 * f64::EPSILON, "{h} {a}");
        }
        assert!(matches!(steps.modes(), [Mode::Sticks]), "{h}");
    }
}
