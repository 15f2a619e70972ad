use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
#[gauss(
    coordinates(shoulder),
    body(arm, rotation = rotation_y(shoulder), mass = 1, center_of_mass = [0, 0, 1], inertia = [1, 1, 1]),
    frame(tool, parent = arm, position = [0, 0, 1]),
    point(tip, body = arm, at = [0, 0, 1]),
    frames(tool, harm, tip, 7, arm: Pose, tool, ground),
    methods(centroid, gravity_torques, gravity_torques),
)]
struct Arm {
    #[gauss(gravity)]
    g: f64,
}

#[derive(GaussDynamics)]
#[gauss(frames = tool)]
struct Body {
    #[gauss(mass)]
    m: f64,
    #[gauss(inertia)]
    i: f64,
}

#[derive(GaussDynamics)]
#[gauss(methods(jacobian_rates))]
struct Alone {
    #[gauss(mass)]
    m: f64,
    #[gauss(inertia)]
    i: f64,
}

fn main() {
    let kernel = Arm { g: 9.81 }.kernel().unwrap();
    let _ = kernel.pose_of(ArmFrame::tool, 0.0, &SVector::from([0.0]));
}
