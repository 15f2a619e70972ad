//! Boxes on boxes.

use std::thread;

use gauss_parry::parry3d_f64::math::Vector;
use gauss_parry::parry3d_f64::shape::SharedShape;
use gauss_parry::{ParrySteps, Reduction, Shapes, Surface};
use gauss_runtime::frames::FrameName;
use gauss_runtime::prelude::*;

macro_rules! boxes {
    ($($name:ident $pose:ident)*) => {
        /// Cubes, each free.
        #[derive(GaussDynamics)]
        #[gauss(
            coordinates($($pose: Pose),*),
            $(body($name, position = $pose.position, rotation = $pose.rotation, mass = m, inertia = m * a * a / 6),)*
            frames($($name),*),
        )]
        struct Boxes {
            m: f64,
            a: f64,
            #[gauss(gravity)]
            g: f64,
        }

        fn state(place: impl Fn(usize) -> Isometry3<f64>) -> BoxesState {
            let mut places = (0..).map(place);
            BoxesState { $($pose: places.next().unwrap(),)* ..Default::default() }
        }

        fn places(state: &BoxesState) -> Vec<Isometry3<f64>> {
            vec![$(state.$pose),*]
        }
    };
}

boxes! { b0 p0 b1 p1 b2 p2 b3 p3 b4 p4 b5 p5 b6 p6 b7 p7 b8 p8 b9 p9 b10 p10 b11 p11 b12 p12 b13 p13 b14 p14 b15 p15 }

const COUNT: usize = 16;
const EDGE: f64 = 0.2;

fn surface(friction: f64, restitution: f64) -> Surface {
    Surface { friction, restitution }
}

fn shapes(mu: f64) -> Shapes<BoxesFrame> {
    let mut shapes = Shapes::new();
    shapes.add(None, SharedShape::halfspace(Vector::Z), Isometry3::identity(), surface(mu, 0.0));
    for frame in BoxesFrame::ALL {
        let cube = SharedShape::cuboid(0.5 * EDGE, 0.5 * EDGE, 0.5 * EDGE);
        shapes.add(Some(*frame), cube, Isometry3::identity(), surface(mu, 0.0));
    }
    // Corners of equal cubes lie on one another, so that the library has each of them twice.
    shapes.reduce(Reduction::Quadrilateral).most(4)
}

/// Matrices of 192 rows on the stack.
fn with_stack(act: impl FnOnce() + Send + 'static) {
    thread::Builder::new().stack_size(64 << 20).spawn(act).unwrap().join().unwrap();
}

#[test]
fn sixteen_boxes_stand_without_creep() {
    with_stack(|| {
        let kernel = Boxes { m: 1.0, a: EDGE, g: 9.81 }.kernel().unwrap();
        let start = state(|i| Isometry3::translation(0.0, 0.0, (i as f64 + 0.5) * EDGE));
        let begin = (0.0, start.q(), start.z());
        let mut steps = ParrySteps::<_, 64, 192, _>::new(&kernel, shapes(0.5), begin).unwrap();
        assert_eq!(steps.shapes().found().len(), 4 * COUNT);
        let energy = kernel.energy(0.0, &start.q(), &start.z());
        for n in 0..200 {
            let report = steps.step(2e-3, &()).unwrap();
            assert!(report.residual.worst() <= 1e-8, "{n} {report:?}");
            // Rounding of heights up to 3.2, of sixteen boxes on one another: where corners share their load anew, all
            // of them move by as much.
            assert!(report.penetration <= 16.0 * 32.0 * f64::EPSILON * 3.2, "{n} {report:?}");
        }
        let end = BoxesState::of(steps.configuration(), steps.speeds());
        // A rounding of 3.2 for each step and box would be 3e-12.
        let (begun, ended) = (places(&start), places(&end));
        let moved = ended
            .iter()
            .zip(&begun)
            .map(|(a, b)| (a.translation.vector - b.translation.vector).amax().max(a.rotation.angle_to(&b.rotation)));
        let moved = moved.fold(0.0, f64::max);
        assert!(moved <= 200.0 * 16.0 * 3.2 * f64::EPSILON, "{moved:e}");
        // The lowest box bears all, its four corners a quarter of it or whatever sums to it.
        let normals: f64 = (0..4).map(|i| steps.impulses()[3 * i]).sum();
        assert!((normals / 2e-3 - 16.0 * 9.81).abs() < 1e-6, "{normals}");
        let after = kernel.energy(0.0, steps.configuration(), steps.speeds());
        assert!(after <= energy + 64.0 * f64::EPSILON * energy, "{after} {energy}");
    });
}

#[test]
fn boxes_that_fall_on_one_another_lose_energy() {
    with_stack(|| {
        let kernel = Boxes { m: 1.0, a: EDGE, g: 9.81 }.kernel().unwrap();
        // A little turned and apart.
        let start = state(|i| {
            let turn = Vector3::new(0.0, 0.0, 0.02 * (i % 3) as f64);
            Isometry3::new(
                Vector3::new(0.004 * (i % 5) as f64, 0.003 * (i % 4) as f64, (i as f64 + 0.5) * 1.02 * EDGE),
                turn,
            )
        });
        let begin = (0.0, start.q(), start.z());
        let mut steps = ParrySteps::<_, 64, 192, _>::new(&kernel, shapes(0.5), begin).unwrap();
        let mut energy = kernel.energy(0.0, &start.q(), &start.z());
        for n in 0..250 {
            let report = steps.step(2e-3, &()).unwrap();
            let now = kernel.energy(0.0, steps.configuration(), steps.speeds());
            // Rounding of an energy of 250 J, and the way of a step of second order while nothing touches.
            assert!(now <= energy + 1e-9, "{n} {now} {energy} {report:?}");
            energy = now;
        }
        assert!(steps.speeds().amax() < 1e-6, "{}", steps.speeds().amax());
    });
}
