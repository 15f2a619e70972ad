//! A heavy top.

use gauss_playback::Shape;
use gauss_runtime::prelude::*;

use crate::scene::{Backdrop, Body, Scene, Show, Slider, Start, Trace, View};

/// A top on a fixed tip.
#[derive(GaussDynamics)]
#[gauss(chart = left_invariant, motion = fixed_point)]
pub struct Top {
    #[gauss(mass)]
    mass: f64,
    /// From the tip.
    #[gauss(center_of_mass)]
    center: Vector3<f64>,
    /// About the tip.
    #[gauss(inertia)]
    inertia: Vector3<f64>,
    #[gauss(gravity)]
    g: f64,
}

/// m: the disc of the top.
const RADIUS: f64 = 0.04;
const MASS: f64 = 0.1;

/// Sliders: spin, lean, height of the disc, gravity.
pub struct Scenery;

impl Scene for Scenery {
    type Kernel = TopKernel;

    const SLIDERS: &'static [Slider] = &[
        Slider::start("spin", "rad/s", [0.0, 300.0], 120.0),
        Slider::start("lean", "°", [1.0, 90.0], 35.0),
        Slider::parameter("height of the disc", "m", [0.015, 0.08], 0.045),
        Slider::parameter("gravity", "m/s²", [0.0, 20.0], 9.81),
    ];
    const SOURCE: &'static str = include_str!("top.rs");

    fn show() -> Show {
        let disc = vec![Shape::cylinder(RADIUS, 0.008)];
        let rod = vec![Shape::rod([0.0; 3], [0.0, 0.0, 0.1], 0.0025)];
        Show {
            title: "Heavy top",
            words: "Let go leaning, it falls until its spin carries it along: it nods while it goes round. Take spin \
                    away, and it falls over the tip and swings below.",
            view: View {
                up: [0.0, 0.0, 1.0],
                target: [0.0, 0.0, 0.01],
                radius: 0.125,
                backdrop: Backdrop::Floor(-0.1),
                angles: [0.6, 0.35],
                follow: None,
            },
            bodies: vec![Body { name: "disc", shapes: disc }, Body { name: "rod", shapes: rod }],
            traces: vec![Trace { body: 1, point: [0.0, 0.0, 0.1] }],
            arrows: vec!["angular momentum"],
            curves: ("angle from the vertical / °", vec!["lean"]),
        }
    }

    fn kernel(values: &[f64]) -> Result<TopKernel, ParameterError> {
        let (h, g) = (values[2], values[3]);
        let across = MASS * (0.25 * RADIUS * RADIUS + h * h);
        let inertia = Vector3::new(across, across, 0.5 * MASS * RADIUS * RADIUS);
        Top { mass: MASS, center: Vector3::new(0.0, 0.0, h), inertia, g }.kernel()
    }

    fn start(values: &[f64]) -> Start<TopKernel> {
        let lean = values[1].to_radians();
        (UnitQuaternion::from_axis_angle(&Vector3::x_axis(), lean), Vector3::new(0.0, 0.0, values[0]))
    }

    fn poses(values: &[f64], _: &TopKernel, s: &Sample<TopKernel>) -> Vec<Isometry3<f64>> {
        let rod = Isometry3::from_parts(Translation3::identity(), s.q);
        vec![rod * Translation3::new(0.0, 0.0, values[2]), rod]
    }

    fn arrows(_: &TopKernel, s: &Sample<TopKernel>) -> Vec<[Vector3<f64>; 2]> {
        // Momenta of this chart are in body axes.
        vec![[Vector3::zeros(), s.q * s.p * 8.0]]
    }

    fn curves(_: &TopKernel, s: &Sample<TopKernel>) -> Vec<f64> {
        vec![(s.q * Vector3::z()).angle(&Vector3::z()).to_degrees()]
    }
}
