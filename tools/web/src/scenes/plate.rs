//! A plate that falls: the scene of the example `falling_plate`, with its published forces.

use gauss_playback::Shape;
use gauss_runtime::prelude::*;

use crate::scene::{Backdrop, Body, Scene, Show, Slider, Start, Trace, View};
use example::{Plate, PlateKernel, THICKNESS, released};

#[path = "../../../../examples/falling_plate/scene.rs"]
pub mod example;

/// Sliders: its angle at first, its weight, what resists its turning.
pub struct Scenery;

impl Scene for Scenery {
    type Kernel = PlateKernel;

    const SLIDERS: &'static [Slider] = &[
        Slider::start("angle from level", "°", [1.0, 85.0], 17.0),
        Slider::parameter("I*, mass by that of the fluid", "", [0.5, 2.5], 1.4),
        Slider::parameter("lift by rotation, C_R", "", [0.0, 4.0], std::f64::consts::PI),
        Slider::parameter("resistance to turning, μ", "", [0.05, 0.6], 0.2),
    ];
    const SOURCE: &'static str = include_str!("../../../../examples/falling_plate/scene.rs");

    fn show() -> Show {
        Show {
            title: "Falling plate",
            words: "A card in air, by Andersen, Pesavento and Wang (2005): a light one flutters from side to side, a \
                    heavy one tumbles away. Let I* go through 1.25.",
            view: View {
                up: [0.0, 1.0, 0.0],
                target: [0.0; 3],
                radius: 5.0,
                backdrop: Backdrop::Wall(-1.0),
                angles: [std::f64::consts::FRAC_PI_2, 0.0],
                follow: Some(0),
            },
            bodies: vec![Body { name: "plate", shapes: vec![Shape::elliptic_cylinder([1.0, THICKNESS], 2.0)] }],
            traces: vec![Trace { body: 0, point: [0.0; 3] }],
            arrows: Vec::new(),
            curves: ("power / (ρ a U³)", vec!["lift", "drag", "braking"]),
        }
    }

    fn kernel(values: &[f64]) -> Result<PlateKernel, ParameterError> {
        let plate = Plate::new(values[1]);
        Plate { c_r: values[2], damping: std::f64::consts::PI * values[3], ..plate }.kernel()
    }

    fn start(values: &[f64]) -> Start<PlateKernel> {
        let (_, twist) = released();
        (Isometry2::rotation(values[0].to_radians()), twist)
    }

    fn poses(_: &[f64], kernel: &PlateKernel, s: &Sample<PlateKernel>) -> Vec<Isometry3<f64>> {
        vec![kernel.pose(s.t, &s.q)]
    }

    fn curves(kernel: &PlateKernel, s: &Sample<PlateKernel>) -> Vec<f64> {
        ["lift", "drag", "braking"].map(|name| kernel.power(name, s.t, &s.q, &s.z, &()).unwrap_or(0.0)).to_vec()
    }

    fn supplied(kernel: &PlateKernel, s: &Sample<PlateKernel>) -> Option<f64> {
        Some(kernel.supplied_power(s.t, &s.q, &s.z, &()))
    }
}
