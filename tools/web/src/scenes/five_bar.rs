//! A robot from its file: the leg of `tests/robots/five_bar.urdf`. The file names its source.

use gauss_playback::Shape;
use gauss_runtime::prelude::*;

use crate::scene::{Backdrop, Body, Scene, Show, Slider, Start, Trace, View};

/// A robot's leg, pointing up, with a load: the file has a tree, and two constraints join its tips.
#[derive(GaussDynamics)]
#[gauss(
    urdf = "../../tests/robots/five_bar.urdf",
    inputs = none,
    gravity = 9.81,
    constraint(position = dot(left_tip.position - right_tip.position, [1, 0, 0])),
    constraint(position = dot(left_tip.position - right_tip.position, [0, 0, 1])),
    particle(mass = load, position = [0, 0, 0], parent = left_tip),
    spring(left, along = left_motor, stiffness = stiffness, length = 0.8),
    spring(right, along = right_motor, stiffness = stiffness, length = -0.8),
    frames(left_housing, left_rod, right_housing, right_rod, left_tip),
)]
pub struct FiveBar {
    load: f64,
    stiffness: f64,
}

/// m, of the file: the cranks, the rods.
const CRANK: f64 = 0.115;
const ROD: f64 = 0.2;

/// Sliders: the cranks, a push from the side, load and springs.
pub struct Scenery;

impl Scene for Scenery {
    type Kernel = FiveBarKernel;

    const SLIDERS: &'static [Slider] = &[
        Slider::start("cranks apart", "°", [30.0, 65.0], 40.0),
        Slider::start("push to the side", "rad/s", [-3.0, 3.0], 1.5),
        Slider::parameter("load", "kg", [0.05, 1.0], 0.4),
        Slider::parameter("springs in the motors", "N m/rad", [3.0, 20.0], 4.0),
    ];
    const SOURCE: &'static str = include_str!("five_bar.rs");

    fn show() -> Show {
        let link = |length: f64| vec![Shape::rod([0.0; 3], [0.0, 0.0, length], 0.008)];
        Show {
            title: "A robot",
            words: "A leg of the robot Minitaur from its file, turned upwards, its tips joined by constraints; springs \
                    in the motors hold the load up. The arrow is the force of the constraint on the left tip.",
            view: View {
                up: [0.0, 0.0, 1.0],
                target: [0.0, 0.0, 0.14],
                radius: 0.19,
                backdrop: Backdrop::Floor(-0.05),
                angles: [-1.3, 0.15],
                follow: None,
            },
            bodies: vec![
                Body { name: "left crank", shapes: link(CRANK) },
                Body { name: "left rod", shapes: link(ROD) },
                Body { name: "right crank", shapes: link(CRANK) },
                Body { name: "right rod", shapes: link(ROD) },
                Body { name: "load", shapes: vec![Shape::ball(0.02)] },
            ],
            traces: vec![Trace { body: 4, point: [0.0; 3] }],
            arrows: vec!["force of the constraint"],
            curves: ("angle / °", vec!["left motor", "right motor"]),
        }
    }

    fn kernel(values: &[f64]) -> Result<FiveBarKernel, ParameterError> {
        FiveBar { load: values[2], stiffness: values[3] }.kernel()
    }

    fn start(values: &[f64]) -> Start<FiveBarKernel> {
        // One side is the other one's mirror image, so that the tips meet in the middle; both motors are on one
        // axis, about which all of it turns at first.
        let (crank, push) = (values[0].to_radians(), values[1]);
        let knee = -(CRANK * crank.sin() / ROD).asin() - crank;
        (SVector::from([crank, knee, -crank, -knee]), SVector::from([push, 0.0, push, 0.0]))
    }

    fn poses(_: &[f64], kernel: &FiveBarKernel, s: &Sample<FiveBarKernel>) -> Vec<Isometry3<f64>> {
        use FiveBarFrame::{left_housing, left_rod, left_tip, right_housing, right_rod};
        let pose = |frame| gauss_runtime::nalgebra::convert(kernel.pose_of(frame, s.t, &s.q));
        [left_housing, left_rod, right_housing, right_rod, left_tip].map(pose).to_vec()
    }

    fn arrows(kernel: &FiveBarKernel, s: &Sample<FiveBarKernel>) -> Vec<[Vector3<f64>; 2]> {
        let force = kernel.multipliers(s.t, &s.q, &s.z, &());
        let tip = kernel.pose_of(FiveBarFrame::left_tip, s.t, &s.q).translation.vector;
        vec![[tip, Vector3::new(force[0], 0.0, force[1]) * 0.01]]
    }

    fn curves(_: &FiveBarKernel, s: &Sample<FiveBarKernel>) -> Vec<f64> {
        vec![s.q[0].to_degrees(), s.q[2].to_degrees()]
    }
}
