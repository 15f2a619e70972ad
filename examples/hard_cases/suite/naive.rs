//! What one would type first: correct formulas, and no thought of rounding. Every case has one of these beside it.

use gauss_runtime::prelude::*;

use super::scenes::State;
use super::truth::MassData;

/// The classical method of order 4 on plain numbers.
pub fn runge_kutta<const N: usize>(
    f: impl Fn(&SVector<f64, N>) -> SVector<f64, N>,
    mut y: SVector<f64, N>,
    h: f64,
    steps: u64,
    mut see: impl FnMut(&SVector<f64, N>),
) -> SVector<f64, N> {
    for _ in 0..steps {
        let a = f(&y);
        let b = f(&(y + a * (0.5 * h)));
        let c = f(&(y + b * (0.5 * h)));
        let d = f(&(y + c * h));
        y += (a + (b + c) * 2.0 + d) * (h / 6.0);
        see(&y);
    }
    y
}

/// The matrix of a quaternion x, y, z, w, which is a rotation only when its norm is 1.
pub fn matrix([x, y, z, w]: [f64; 4]) -> Matrix3<f64> {
    Matrix3::new(
        w * w + x * x - y * y - z * z,
        2.0 * (x * y - w * z),
        2.0 * (x * z + w * y),
        2.0 * (x * y + w * z),
        w * w - x * x + y * y - z * z,
        2.0 * (y * z - w * x),
        2.0 * (x * z - w * y),
        2.0 * (y * z + w * x),
        w * w - x * x - y * y + z * z,
    )
}

/// q̇ = ½ q ω.
fn quaternion_rate([x, y, z, w]: [f64; 4], o: &Vector3<f64>) -> [f64; 4] {
    [
        0.5 * (w * o.x + y * o.z - z * o.y),
        0.5 * (w * o.y + z * o.x - x * o.z),
        0.5 * (w * o.z + x * o.y - y * o.x),
        -0.5 * (x * o.x + y * o.y + z * o.z),
    ]
}

/// Euler's equations about a fixed point, (quaternion, ω), weight included: the quaternion is never normalised.
pub fn top(data: &MassData) -> impl Fn(&SVector<f64, 7>) -> SVector<f64, 7> {
    let MassData { mass, center, inertia, gravity, .. } = *data;
    let inverse = inertia.try_inverse().unwrap_or_else(Matrix3::zeros);
    move |y| {
        let (q, omega) = ([y[0], y[1], y[2], y[3]], Vector3::new(y[4], y[5], y[6]));
        let down = matrix(q).row(2).transpose() * -(mass * gravity);
        let rate = inverse * ((inertia * omega).cross(&omega) + center.cross(&down));
        let [a, b, c, d] = quaternion_rate(q, &omega);
        SVector::from([a, b, c, d, rate.x, rate.y, rate.z])
    }
}

/// (quaternion, ω) of a state.
pub fn top_state(state: &State) -> SVector<f64, 7> {
    let q = state.pose().rotation.coords;
    SVector::from([q[0], q[1], q[2], q[3], state.omega.x, state.omega.y, state.omega.z])
}

/// The state of a top.
pub fn state_of_top(y: &SVector<f64, 7>) -> State {
    let zero = Vector3::zeros();
    State { rotation: matrix([y[0], y[1], y[2], y[3]]), b: zero, u: zero, omega: Vector3::new(y[4], y[5], y[6]) }
}

/// A top after a time by [`top`], in steps of about `h`.
pub fn run_top(data: &MassData, from: &State, duration: f64, h: f64) -> State {
    let steps = (duration / h).round();
    state_of_top(&runge_kutta(top(data), top_state(from), duration / steps, steps as u64, |_| ()))
}

/// Euler's implicit method, by fixed-point iteration, on a top; the quaternion is normalised. It damps whatever
/// oscillates.
pub fn run_top_implicitly(data: &MassData, from: &State, duration: f64, h: f64, mut see: impl FnMut(&SVector<f64, 7>)) {
    let (f, mut y) = (top(data), top_state(from));
    for _ in 0..(duration / h).round() as u64 {
        let mut next = y + f(&y) * h;
        for _ in 0..20 {
            next = y + f(&next) * h;
        }
        let norm = (0..4).map(|i| next[i] * next[i]).sum::<f64>().sqrt();
        y = SVector::from_fn(|i, _| if i < 4 { next[i] / norm } else { next[i] });
        see(&y);
    }
}

/// The quaternion of a free top whose angular momentum in space is known, and its ω: nothing is normalised.
pub fn top_from_space(
    inertia: &Vector3<f64>,
    q: &SVector<f64, 4>,
    momentum: &Vector3<f64>,
) -> (SVector<f64, 4>, Vector3<f64>) {
    let q = [q[0], q[1], q[2], q[3]];
    let omega = (matrix(q).transpose() * momentum).component_div(inertia);
    (quaternion_rate(q, &omega).into(), omega)
}

/// Energy of a free top.
pub fn energy(inertia: &Matrix3<f64>, y: &SVector<f64, 7>) -> f64 {
    let omega = Vector3::new(y[4], y[5], y[6]);
    0.5 * omega.dot(&(inertia * omega))
}

/// A heavy symmetric top in (φ, θ, ψ, ω), R = R_z(φ) R_x(θ) R_z(ψ): sin θ in a denominator.
pub fn top_by_angles(data: &MassData) -> impl Fn(&SVector<f64, 6>) -> SVector<f64, 6> {
    let MassData { mass, center, inertia, gravity, .. } = *data;
    let (i, couple) = (inertia.diagonal(), mass * gravity * center.z);
    move |y| {
        let ((s, c), (st, ct)) = (y[2].sin_cos(), y[1].sin_cos());
        let (p, q, r) = (y[3], y[4], y[5]);
        let precession = (p * s + q * c) / st;
        SVector::from([
            precession,
            p * c - q * s,
            r - precession * ct,
            ((i.y - i.z) * q * r + couple * st * c) / i.x,
            ((i.z - i.x) * r * p - couple * st * s) / i.y,
            (i.x - i.y) * p * q / i.z,
        ])
    }
}

/// R_z(φ) R_x(θ) R_z(ψ).
pub fn matrix_of_angles(phi: f64, theta: f64, psi: f64) -> Matrix3<f64> {
    let turn = |axis, angle| UnitQuaternion::from_axis_angle(&axis, angle);
    let q = turn(Vector3::z_axis(), phi) * turn(Vector3::x_axis(), theta) * turn(Vector3::z_axis(), psi);
    q.to_rotation_matrix().into_inner()
}

fn skew(v: &Vector3<f64>) -> Matrix3<f64> {
    Matrix3::new(0.0, -v.z, v.y, v.z, 0.0, -v.x, -v.y, v.x, 0.0)
}

/// [[m, −m[c]×], [m[c]×, I]] and what the fluid adds.
fn kinetic(mass: f64, center: &Vector3<f64>, inertia: &Matrix3<f64>, added: &Matrix6<f64>) -> Matrix6<f64> {
    let lever = skew(center) * mass;
    let rigid = Matrix6::from_fn(|i, j| match (i < 3, j < 3) {
        (true, true) => f64::from(u8::from(i == j)) * mass,
        (true, false) => -lever[(i, j - 3)],
        (false, true) => lever[(i - 3, j)],
        (false, false) => inertia[(i - 3, j - 3)],
    });
    rigid + added
}

fn parts(v: &Vector6<f64>) -> (Vector3<f64>, Vector3<f64>) {
    (Vector3::new(v[0], v[1], v[2]), Vector3::new(v[3], v[4], v[5]))
}

fn six(a: &Vector3<f64>, b: &Vector3<f64>) -> Vector6<f64> {
    Vector6::new(a.x, a.y, a.z, b.x, b.y, b.z)
}

/// A free body: quaternion, b, then (u, ω) about O, with the 6×6 matrix factored at every stage.
pub fn run_body(data: &MassData, from: &State, duration: f64, h: f64) -> State {
    let MassData { mass, center, inertia, added, gravity } = *data;
    let m = kinetic(mass, &center, &inertia, &added);
    let rate = |y: &SVector<f64, 13>| {
        let (q, v) = ([y[0], y[1], y[2], y[3]], Vector6::from_fn(|i, _| y[7 + i]));
        let (u, omega) = parts(&v);
        let (linear, angular) = parts(&(m * v));
        let r = matrix(q);
        let weight = r.row(2).transpose() * -(mass * gravity);
        let force = linear.cross(&omega) + weight;
        let torque = angular.cross(&omega) + linear.cross(&u) + center.cross(&weight);
        let acceleration = m.lu().solve(&six(&force, &torque)).unwrap_or_else(Vector6::zeros);
        let (turn, velocity) = (quaternion_rate(q, &omega), r * u);
        SVector::from_fn(|i, _| match i {
            0..4 => turn[i],
            4..7 => velocity[i - 4],
            _ => acceleration[i - 7],
        })
    };
    let (q, twist) = (from.pose().rotation.coords, from.twist());
    let start = SVector::from_fn(|i, _| match i {
        0..4 => q[i],
        4..7 => from.b[i - 4],
        _ => twist[i - 7],
    });
    let steps = (duration / h).round();
    let y: SVector<f64, 13> = runge_kutta(rate, start, duration / steps, steps as u64, |_| ());
    let (u, omega) = parts(&Vector6::from_fn(|i, _| y[7 + i]));
    State { rotation: matrix([y[0], y[1], y[2], y[3]]), b: Vector3::new(y[4], y[5], y[6]), u, omega }
}

/// A free body by its constant momentum about Ω: (ξ̂, ω̂) from the 6×6 matrix about Ω, factored at every stage.
pub fn run_about_origin(data: &MassData, from: &State, duration: f64, h: f64) -> State {
    let MassData { mass, center, inertia, .. } = *data;
    let square = |c: &Vector3<f64>| Matrix3::identity() * c.norm_squared() - c * c.transpose();
    let central = inertia - square(&center) * mass;
    let about_origin = |r: &Matrix3<f64>, b: &Vector3<f64>| {
        let g = b + r * center;
        kinetic(mass, &g, &(r * central * r.transpose() + square(&g) * mass), &Matrix6::zeros())
    };
    let start_omega = from.rotation * from.omega;
    let velocity = from.rotation * from.u - start_omega.cross(&from.b);
    let momentum = about_origin(&from.rotation, &from.b) * six(&velocity, &start_omega);
    let twist = |y: &SVector<f64, 7>| {
        let (r, b) = (matrix([y[0], y[1], y[2], y[3]]), Vector3::new(y[4], y[5], y[6]));
        let solved = about_origin(&r, &b).lu().solve(&momentum).unwrap_or_else(Vector6::zeros);
        let (xi, omega) = parts(&solved);
        (r.transpose() * (xi + omega.cross(&b)), r.transpose() * omega, xi + omega.cross(&b))
    };
    let rate = |y: &SVector<f64, 7>| {
        let (_, omega, velocity) = twist(y);
        let [a, b, c, d] = quaternion_rate([y[0], y[1], y[2], y[3]], &omega);
        SVector::from([a, b, c, d, velocity.x, velocity.y, velocity.z])
    };
    let q = from.pose().rotation.coords;
    let start = SVector::from([q[0], q[1], q[2], q[3], from.b.x, from.b.y, from.b.z]);
    let steps = (duration / h).round();
    let y = runge_kutta(rate, start, duration / steps, steps as u64, |_| ());
    let (u, omega, _) = twist(&y);
    State { rotation: matrix([y[0], y[1], y[2], y[3]]), b: Vector3::new(y[4], y[5], y[6]), u, omega }
}

/// (1 − cos θ)/θ².
pub fn versine(theta: f64) -> f64 {
    (1.0 - theta.cos()) / (theta * theta)
}

/// (θ − sin θ)/θ³.
pub fn cubic(theta: f64) -> f64 {
    (theta - theta.sin()) / (theta * theta * theta)
}

/// (1 − (θ/2) cot(θ/2))/θ².
pub fn dexp_inv(theta: f64) -> f64 {
    (1.0 - 0.5 * theta * (0.5 * theta).cos() / (0.5 * theta).sin()) / (theta * theta)
}

/// The exponential by sine and cosine over θ.
pub fn exp(sigma: &Vector3<f64>) -> [f64; 4] {
    let theta = sigma.norm();
    let axis = sigma / theta * (0.5 * theta).sin();
    [axis.x, axis.y, axis.z, (0.5 * theta).cos()]
}

/// The angle of a rotation matrix by its trace.
pub fn angle(matrix: &Matrix3<f64>) -> f64 {
    (0.5 * (matrix.trace() - 1.0)).clamp(-1.0, 1.0).acos()
}
