//! The same vehicle by hand: Newton's and Euler's laws for each body and its water in the body's own axes, paired with
//! velocities that the joints leave free. Accelerations enter linearly, so nine evaluations give the equations that are
//! solved.

use gauss_runtime::prelude::*;

use crate::vehicle::{Place, Speeds, Vehicle};

/// A motion of the hull and the joints that comes with the accelerations `rates`.
struct Link {
    rotation: Matrix3<f64>,
    /// Velocity of O and ω, body axes, and acceleration of O and ω̇ seen by the observer, body axes.
    velocity: Vector3<f64>,
    spin: Vector3<f64>,
    acceleration: Vector3<f64>,
    spin_rate: Vector3<f64>,
}

impl Link {
    /// A body whose axes are turned about `axis` by `angle` against its parent's, O at `offset` from the parent's O in
    /// the parent's axes and at `arm` from there in its own.
    fn child(
        &self,
        offset: Vector3<f64>,
        axis: Vector3<f64>,
        [angle, rate, rate_rate]: [f64; 3],
        arm: Vector3<f64>,
    ) -> Self {
        let turn = UnitQuaternion::from_scaled_axis(axis * angle).to_rotation_matrix().into_inner();
        let back = turn.transpose();
        let at_joint = self.velocity + self.spin.cross(&offset);
        let joint_acceleration =
            self.acceleration + self.spin_rate.cross(&offset) + self.spin.cross(&self.spin.cross(&offset));
        let carried = back * self.spin;
        let spin = carried + axis * rate;
        let spin_rate = back * self.spin_rate + axis * rate_rate + carried.cross(&(axis * rate));
        Self {
            rotation: self.rotation * turn,
            velocity: back * at_joint + spin.cross(&arm),
            spin,
            acceleration: back * joint_acceleration + spin_rate.cross(&arm) + spin.cross(&spin.cross(&arm)),
            spin_rate,
        }
    }
}

/// Mass, moments, fluid and drag of one body whose O is its centre of mass.
struct Matter {
    mass: f64,
    inertia: Vector3<f64>,
    added: Vector6<f64>,
    displaced: f64,
    buoyancy: Vector3<f64>,
    linear: Vector6<f64>,
    quadratic: Vector6<f64>,
}

/// What inertia and water ask for beyond what weight, buoyancy and drag give: force and torque about O, body axes.
fn missing(link: &Link, matter: &Matter, current: &Vector3<f64>, gravity: &Vector3<f64>) -> [Vector3<f64>; 2] {
    let (a, w, dw) = (link.acceleration, link.spin, link.spin_rate);
    let body = [matter.mass * a, matter.inertia.component_mul(&dw) + w.cross(&matter.inertia.component_mul(&w))];
    // The impulse of the water is that of the motion relative to the current: d/dt u = a − ω × u, d/dt Rᵀc = −ω × Rᵀc.
    let through = link.velocity - link.rotation.transpose() * current;
    let through_rate = a - w.cross(&through);
    let part = |m: usize| Vector3::new(matter.added[m], matter.added[m + 1], matter.added[m + 2]);
    let (q, gamma) = (part(0).component_mul(&through), part(3).component_mul(&w));
    let water = [
        part(0).component_mul(&through_rate) + w.cross(&q),
        part(3).component_mul(&dw) + w.cross(&gamma) + through.cross(&q),
    ];
    let down = link.rotation.transpose() * gravity;
    let drag = |m: usize, v: &Vector3<f64>| {
        Vector3::from_fn(|i, _| -(matter.linear[m + i] + matter.quadratic[m + i] * v[i].abs()) * v[i])
    };
    let loads = [
        (matter.mass - matter.displaced) * down + drag(0, &through),
        matter.buoyancy.cross(&(-matter.displaced * down)) + drag(3, &w),
    ];
    [body[0] + water[0] - loads[0], body[1] + water[1] - loads[1]]
}

/// The generalised forces that a motion needs beyond what acts on it: along the twist of the hull and the rates of the
/// joints.
fn residual(vehicle: &Vehicle, q: &Place, z: &Speeds, rates: &Speeds) -> Speeds {
    let triple = |v: &Speeds, k: usize| Vector3::new(v[k], v[k + 1], v[k + 2]);
    let chain = |z: &Speeds, rates: &Speeds| -> [Link; 3] {
        let (u, w) = (triple(z, 0), triple(z, 3));
        let hull = Link {
            rotation: q.0.rotation.to_rotation_matrix().into_inner(),
            velocity: u,
            spin: w,
            acceleration: triple(rates, 0) + w.cross(&u),
            spin_rate: triple(rates, 3),
        };
        let (half, z_axis, y_axis) = (Vector3::new(0.5 * vehicle.length, 0.0, 0.0), Vector3::z(), Vector3::y());
        let upper = hull.child(vehicle.mount, z_axis, [q.1[0], z[6], rates[6]], half);
        let fore = upper.child(half, y_axis, [q.1[1], z[7], rates[7]], half);
        [hull, upper, fore]
    };
    let links = chain(z, rates);
    let link_matter = || Matter {
        mass: vehicle.link_mass,
        inertia: Vector3::new(vehicle.along, vehicle.across, vehicle.across),
        added: {
            let (a, j) = (vehicle.link_added, vehicle.link_turning);
            Vector6::new(0.0, a, a, 0.0, j, j)
        },
        displaced: vehicle.link_displaced,
        buoyancy: Vector3::zeros(),
        linear: Vector6::zeros(),
        quadratic: {
            let (d, s) = (vehicle.link_drag, vehicle.link_swirl);
            Vector6::new(0.0, d, d, 0.0, s, s)
        },
    };
    let hull = Matter {
        mass: vehicle.mass,
        inertia: vehicle.inertia,
        added: vehicle.added,
        displaced: vehicle.displaced,
        buoyancy: vehicle.buoyancy,
        linear: vehicle.linear,
        quadratic: vehicle.quadratic,
    };
    let needed: Vec<[Vector3<f64>; 2]> = links
        .iter()
        .zip([hull, link_matter(), link_matter()])
        .map(|(link, matter)| missing(link, &matter, &vehicle.current, &vehicle.gravity))
        .collect();
    // Partial velocities: the velocities of a motion with one speed 1 and the others 0, which are linear in the speeds.
    Speeds::from_fn(|k, _| {
        let unit = Speeds::from_fn(|i, _| f64::from(u8::from(i == k)));
        let moved = chain(&unit, &Speeds::zeros());
        moved.iter().zip(&needed).map(|(m, [force, torque])| m.velocity.dot(force) + m.spin.dot(torque)).sum()
    })
}

/// ż: the residual is affine in the accelerations.
///
/// # Panics
/// When the matrix is singular, which it is not for bodies with mass.
pub fn acceleration(vehicle: &Vehicle, q: &Place, z: &Speeds, torques: &SVector<f64, 2>) -> Speeds {
    let still = residual(vehicle, q, z, &Speeds::zeros());
    let columns: [Speeds; 8] =
        std::array::from_fn(|k| residual(vehicle, q, z, &Speeds::from_fn(|i, _| f64::from(u8::from(i == k)))) - still);
    let matrix = SMatrix::<f64, 8, 8>::from_columns(&columns);
    let given = Speeds::from_fn(|k, _| if k < 6 { 0.0 } else { torques[k - 6] });
    matrix.lu().solve(&(given - still)).expect("bodies have mass")
}

/// The motion by the classical Runge–Kutta method on (R as a quaternion, b, angles, z), at every whole tenth of a
/// second.
pub fn run(
    vehicle: &Vehicle,
    start: (Place, Speeds),
    tenths: u32,
    steps: u32,
    torques: impl Fn(f64, &Place, &Speeds) -> SVector<f64, 2>,
) -> Vec<(Place, Speeds)> {
    type State = (UnitQuaternion<f64>, Vector3<f64>, SVector<f64, 2>, Speeds);
    // Rotations by increments in the body's axes: q exp(φ), φ̇ = dexp⁻¹ ω to the order of the method.
    let rates = |t: f64, base: &State, phi: &Vector3<f64>, rest: &(Vector3<f64>, SVector<f64, 2>, Speeds)| {
        let rotation = base.0 * UnitQuaternion::from_scaled_axis(*phi);
        let place = (Isometry3::from_parts(rest.0.into(), rotation), rest.1);
        let z = rest.2;
        let (u, w) = (Vector3::new(z[0], z[1], z[2]), Vector3::new(z[3], z[4], z[5]));
        let turning = w + phi.cross(&w) * 0.5 + phi.cross(&phi.cross(&w)) / 12.0;
        (turning, rotation * u, SVector::from([z[6], z[7]]), acceleration(vehicle, &place, &z, &torques(t, &place, &z)))
    };
    let ((pose, angles), z) = start;
    let mut state: State = (pose.rotation, pose.translation.vector, angles, z);
    let place = |s: &State| ((Isometry3::from_parts(s.1.into(), s.0), s.2), s.3);
    let mut states = vec![place(&state)];
    let h = 0.1 / f64::from(steps);
    for n in 0..tenths * steps {
        let t = h * f64::from(n);
        let at = |k: &(Vector3<f64>, Vector3<f64>, SVector<f64, 2>, Speeds), h: f64| {
            (k.0 * h, (state.1 + k.1 * h, state.2 + k.2 * h, state.3 + k.3 * h))
        };
        let k1 = rates(t, &state, &Vector3::zeros(), &(state.1, state.2, state.3));
        let (phi, rest) = at(&k1, 0.5 * h);
        let k2 = rates(t + 0.5 * h, &state, &phi, &rest);
        let (phi, rest) = at(&k2, 0.5 * h);
        let k3 = rates(t + 0.5 * h, &state, &phi, &rest);
        let (phi, rest) = at(&k3, h);
        let k4 = rates(t + h, &state, &phi, &rest);
        let w = h / 6.0;
        let phi = (k1.0 + (k2.0 + k3.0) * 2.0 + k4.0) * w;
        state = (
            state.0 * UnitQuaternion::from_scaled_axis(phi),
            state.1 + (k1.1 + (k2.1 + k3.1) * 2.0 + k4.1) * w,
            state.2 + (k1.2 + (k2.2 + k3.2) * 2.0 + k4.2) * w,
            state.3 + (k1.3 + (k2.3 + k3.3) * 2.0 + k4.3) * w,
        );
        if (n + 1) % steps == 0 {
            states.push(place(&state));
        }
    }
    states
}
