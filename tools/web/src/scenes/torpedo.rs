//! A torpedo in a perfect fluid.

use gauss_playback::Shape;
use gauss_runtime::prelude::*;

use crate::scene::{Backdrop, Body, Scene, Show, Slider, Start, Trace, View};

/// A hull in water at rest, body axes: e₁ forward, O in the centre of buoyancy. Kirchhoff's equations.
#[derive(GaussDynamics)]
#[gauss(chart = left_invariant, motion = free)]
pub struct Torpedo {
    #[gauss(mass)]
    mass: f64,
    #[gauss(center_of_mass)]
    center: Vector3<f64>,
    /// About O.
    #[gauss(inertia)]
    inertia: Vector3<f64>,
    #[gauss(added_mass)]
    added: Vector6<f64>,
    #[gauss(displaced_mass)]
    displaced: f64,
    #[gauss(gravity)]
    g: f64,
}

/// Sliders: speed, push, added mass, how low G is.
pub struct Scenery;

impl Scene for Scenery {
    type Kernel = TorpedoKernel;

    const SLIDERS: &'static [Slider] = &[
        Slider::start("speed ahead", "m/s", [0.0, 3.0], 1.5),
        Slider::start("speed sideways", "m/s", [0.0, 0.5], 0.03),
        Slider::parameter("added mass, of the true one", "", [0.0, 1.5], 1.0),
        Slider::parameter("G below O", "m", [0.0, 0.05], 0.02),
    ];
    const SOURCE: &'static str = include_str!("torpedo.rs");

    fn show() -> Show {
        let fin = |place: [f64; 3], edges: [f64; 3]| {
            Shape::cuboid(edges).at(&Isometry3::translation(place[0], place[1], place[2])).colour("#444444")
        };
        let hull = vec![
            Shape::ellipsoid([0.67, 0.095, 0.095]),
            fin([-0.55, 0.0, 0.0], [0.12, 0.32, 0.01]),
            fin([-0.55, 0.0, 0.0], [0.12, 0.01, 0.32]),
        ];
        Show {
            title: "Torpedo",
            words: "A slender hull gets through water more easily ahead than sideways, and that turns it broadside: \
                    the moment of Munk. Without added mass it goes straight on.",
            view: View {
                up: [0.0, 0.0, 1.0],
                target: [0.0; 3],
                radius: 1.4,
                backdrop: Backdrop::Floor(-1.0),
                angles: [-1.0, 0.5],
                follow: Some(0),
            },
            bodies: vec![Body { name: "hull", shapes: hull }],
            traces: vec![Trace { body: 0, point: [0.0; 3] }],
            arrows: vec!["impulse"],
            curves: ("velocity of O in the hull's axes / (m/s)", vec!["ahead", "to port", "upwards"]),
        }
    }

    fn kernel(values: &[f64]) -> Result<TorpedoKernel, ParameterError> {
        let mass = 30.0;
        Torpedo {
            mass,
            center: Vector3::new(0.0, 0.0, -values[3]),
            inertia: Vector3::new(0.2, 3.5, 3.5),
            added: Vector6::new(0.9, 35.0, 35.0, 0.07, 4.9, 4.9) * values[2],
            displaced: mass,
            g: 9.81,
        }
        .kernel()
    }

    fn start(values: &[f64]) -> Start<TorpedoKernel> {
        (Isometry3::identity(), Vector6::new(values[0], values[1], 0.0, 0.0, 0.0, 0.0))
    }

    fn poses(_: &[f64], _: &TorpedoKernel, s: &Sample<TorpedoKernel>) -> Vec<Isometry3<f64>> {
        vec![s.q]
    }

    fn arrows(_: &TorpedoKernel, s: &Sample<TorpedoKernel>) -> Vec<[Vector3<f64>; 2]> {
        vec![[s.q.translation.vector, s.q.rotation * s.p.fixed_rows::<3>(0) * 0.015]]
    }

    fn curves(_: &TorpedoKernel, s: &Sample<TorpedoKernel>) -> Vec<f64> {
        vec![s.z[0], s.z[1], s.z[2]]
    }
}
