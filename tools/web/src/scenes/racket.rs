//! A racket that flips.

use gauss_playback::Shape;
use gauss_runtime::prelude::*;

use crate::scene::{Backdrop, Body, Scene, Show, Slider, Start, Trace, View};

/// A free body at its centre of mass.
#[derive(GaussDynamics)]
#[gauss(chart = left_invariant, motion = free)]
pub struct Racket {
    #[gauss(mass)]
    mass: f64,
    #[gauss(inertia)]
    inertia: Vector3<f64>,
}

/// Sliders: spin, disturbance, moments along the handle and across.
pub struct Scenery;

impl Scene for Scenery {
    type Kernel = RacketKernel;

    const SLIDERS: &'static [Slider] = &[
        Slider::start("spin about e₂", "rad/s", [1.0, 20.0], 10.0),
        Slider::start("disturbance about e₁", "rad/s", [0.0, 1.0], 0.02),
        Slider::parameter("I₁, along the handle", "g m²", [0.3, 17.0], 1.2),
        Slider::parameter("I₂, across the strings", "g m²", [14.5, 17.0], 15.0),
        Slider::parameter("I₃, about the normal", "g m²", [14.5, 17.0], 16.0),
    ];
    const SOURCE: &'static str = include_str!("racket.rs");

    fn show() -> Show {
        let handle = Shape::rod([-0.34, 0.0, 0.0], [-0.02, 0.0, 0.0], 0.016).colour("#7f4f24");
        let strings = Shape::ellipsoid([0.17, 0.12, 0.012]).at(&Isometry3::translation(0.13, 0.0, 0.0));
        Show {
            title: "Flipping racket",
            words: "No force, no torque. Spin about the middle axis is unstable: it turns over and back, again and \
                    again. Make I₂ the largest, and it stays.",
            view: View {
                up: [0.0, 0.0, 1.0],
                target: [0.0; 3],
                radius: 0.4,
                backdrop: Backdrop::Floor(-0.4),
                angles: [-1.1, 0.35],
                follow: None,
            },
            bodies: vec![Body { name: "racket", shapes: vec![handle, strings] }],
            traces: vec![Trace { body: 0, point: [0.3, 0.0, 0.0] }],
            arrows: vec!["angular momentum"],
            curves: ("angular velocity in the racket's axes / (rad/s)", vec!["ω₁", "ω₂", "ω₃"]),
        }
    }

    fn kernel(values: &[f64]) -> Result<RacketKernel, ParameterError> {
        let inertia = Vector3::new(values[2], values[3], values[4]) * 1e-3;
        Racket { mass: 0.3, inertia }.kernel()
    }

    fn start(values: &[f64]) -> Start<RacketKernel> {
        (Isometry3::identity(), Vector6::new(0.0, 0.0, 0.0, values[1], values[0], 0.0))
    }

    fn poses(_: &[f64], _: &RacketKernel, s: &Sample<RacketKernel>) -> Vec<Isometry3<f64>> {
        vec![s.q]
    }

    fn arrows(_: &RacketKernel, s: &Sample<RacketKernel>) -> Vec<[Vector3<f64>; 2]> {
        vec![[s.q.translation.vector, s.q.rotation * s.p.fixed_rows::<3>(3) * 2.0]]
    }

    fn curves(_: &RacketKernel, s: &Sample<RacketKernel>) -> Vec<f64> {
        vec![s.z[3], s.z[4], s.z[5]]
    }
}
