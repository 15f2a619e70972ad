//! Two rods.

use gauss_playback::Shape;
use gauss_runtime::prelude::*;

use crate::scene::{Backdrop, Body, Scene, Show, Slider, Start, Trace, View};

/// Two rods in a plane; the lower one hangs from the end of the upper one.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(a, b),
    body(
        upper, rotation = rotation_y(a), mass = m1, center_of_mass = [0, 0, -l1 / 2],
        inertia_about_center_of_mass = [m1 * l1 * l1 / 12, m1 * l1 * l1 / 12, 0],
    ),
    body(
        lower, parent = upper, position = [0, 0, -l1], rotation = rotation_y(b), mass = m2,
        center_of_mass = [0, 0, -l2 / 2], inertia_about_center_of_mass = [m2 * l2 * l2 / 12, m2 * l2 * l2 / 12, 0],
    ),
    gravity = g,
    frames(upper, lower),
)]
pub struct Pendulum {
    m1: f64,
    m2: f64,
    l1: f64,
    l2: f64,
    g: f64,
}

/// m: the rods.
const LENGTHS: [f64; 2] = [0.5, 0.4];

/// Sliders: both angles, the masses' ratio, gravity.
pub struct Scenery;

impl Scene for Scenery {
    type Kernel = PendulumKernel;

    const SLIDERS: &'static [Slider] = &[
        Slider::start("angle of the upper rod", "°", [-180.0, 180.0], 130.0),
        Slider::start("angle between the rods", "°", [-180.0, 180.0], 30.0),
        Slider::parameter("mass of the lower rod", "kg", [0.05, 5.0], 0.8),
        Slider::parameter("gravity", "m/s²", [0.0, 20.0], 9.81),
    ];
    const SOURCE: &'static str = include_str!("pendulum.rs");

    fn show() -> Show {
        let rod = |length: f64| vec![Shape::rod([0.0; 3], [0.0, 0.0, -length], 0.018)];
        Show {
            title: "Two rods",
            words: "Two rods swing chaotically. The error of the energy says how far to believe what you see: loosen the \
                    tolerance of the steps and watch it grow.",
            view: View {
                up: [0.0, 0.0, 1.0],
                target: [0.0; 3],
                radius: 0.95,
                backdrop: Backdrop::Floor(-0.95),
                angles: [-1.2, 0.15],
                follow: None,
            },
            bodies: vec![
                Body { name: "upper", shapes: rod(LENGTHS[0]) },
                Body { name: "lower", shapes: rod(LENGTHS[1]) },
            ],
            traces: vec![Trace { body: 1, point: [0.0, 0.0, -LENGTHS[1]] }],
            arrows: Vec::new(),
            curves: ("rates / (rad/s)", vec!["ȧ", "ḃ"]),
        }
    }

    fn kernel(values: &[f64]) -> Result<PendulumKernel, ParameterError> {
        Pendulum { m1: 1.0, m2: values[2], l1: LENGTHS[0], l2: LENGTHS[1], g: values[3] }.kernel()
    }

    fn start(values: &[f64]) -> Start<PendulumKernel> {
        (SVector::from([values[0].to_radians(), values[1].to_radians()]), SVector::zeros())
    }

    fn poses(_: &[f64], kernel: &PendulumKernel, s: &Sample<PendulumKernel>) -> Vec<Isometry3<f64>> {
        let pose = |frame| gauss_runtime::nalgebra::convert(kernel.pose_of(frame, s.t, &s.q));
        vec![pose(PendulumFrame::upper), pose(PendulumFrame::lower)]
    }

    fn curves(_: &PendulumKernel, s: &Sample<PendulumKernel>) -> Vec<f64> {
        s.z.iter().copied().collect()
    }
}
