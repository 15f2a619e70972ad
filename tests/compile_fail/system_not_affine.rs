use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y),
    speeds(v, w),
    kinematics(x = v * w, y = sqrt(1 + w * w)),
    particle(mass = m, position = [x, y, 0]),
)]
struct NotAffine {
    m: f64,
}

fn main() {}
