//! A rattleback: the scene of the example of that name.

use gauss_playback::Shape;
use gauss_runtime::prelude::*;

use crate::scene::{Backdrop, Body, Scene, Show, Slider, Start, Trace, View};
use example::{AXES, Rattleback, RattlebackKernel, pose, stone};

#[path = "../../../../examples/rattleback/stone.rs"]
pub mod example;

/// Sliders: its spin, how it is set down, its skewness, its weight.
pub struct Scenery;

impl Scene for Scenery {
    type Kernel = RattlebackKernel;

    const SLIDERS: &'static [Slider] = &[
        Slider::start("spin", "rad/s", [-8.0, 8.0], 5.0),
        Slider::start("tilt", "°", [0.0, 5.0], 0.5),
        Slider::parameter("product of inertia", "kg cm²", [-1.0, 1.0], 0.2),
        Slider::parameter("gravity", "m/s²", [1.0, 20.0], 9.81),
    ];
    const SOURCE: &'static str = include_str!("../../../../examples/rattleback/stone.rs");

    fn show() -> Show {
        Show {
            title: "Rattleback",
            words: "A stone that rolls without slipping. Spun one way it goes on; spun the other way it rattles, stops, \
                    and turns back, since its mass is skew to its shape.",
            view: View {
                up: [0.0, 0.0, 1.0],
                target: [0.0; 3],
                radius: 0.22,
                backdrop: Backdrop::Floor(0.0),
                angles: [0.6, 0.5],
                follow: None,
            },
            bodies: vec![Body { name: "stone", shapes: vec![Shape::ellipsoid(AXES)] }],
            traces: vec![Trace { body: 0, point: [AXES[0], 0.0, 0.0] }],
            arrows: Vec::new(),
            curves: ("spin about the vertical / (rad/s)", vec!["ω̂₃"]),
        }
    }

    fn kernel(values: &[f64]) -> Result<RattlebackKernel, ParameterError> {
        Rattleback { stone: stone(values[2] * 1e-4), a: AXES.into(), g: values[3] }.kernel()
    }

    fn start(values: &[f64]) -> Start<RattlebackKernel> {
        let tilt = values[1].to_radians();
        let set_down = UnitQuaternion::from_euler_angles(tilt, tilt, 0.0);
        ((set_down, SVector::zeros()), Vector3::new(0.0, 0.0, values[0]))
    }

    fn poses(_: &[f64], _: &RattlebackKernel, s: &Sample<RattlebackKernel>) -> Vec<Isometry3<f64>> {
        vec![pose(&s.q)]
    }

    fn curves(_: &RattlebackKernel, s: &Sample<RattlebackKernel>) -> Vec<f64> {
        vec![(s.q.0 * s.z).z]
    }
}
