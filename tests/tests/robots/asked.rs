//! What is asked of robots, of one from a file with mimics, fixed links and turned frames, beside sums over the links
//! as the numbers of the file say.

use gauss_runtime::frames::in_observers_axes;
use gauss_runtime::operational::{Factor, OperationalSpace};
use gauss_runtime::prelude::*;

use super::{EPSILON, Gripper, GripperFrame, GripperKernel, Moved, STATES, hand, summed};

type Jacobian = SMatrix<f64, 6, 2>;

fn kernel() -> GripperKernel {
    Gripper { width: 0.01 }.kernel().unwrap()
}

/// Rows u and ω, observer's axes, pole at the origin of the link.
fn jacobian(link: &Moved) -> Jacobian {
    let b = link.pose.translation.vector;
    let columns = link.rates.map(|[linear, angular]| {
        let u = linear + angular.cross(&b);
        SVector::<f64, 6>::from_iterator(u.iter().chain(angular.iter()).copied())
    });
    SMatrix::from_columns(&columns)
}

/// d/dt along z by differences in five points: h⁴ f⁽⁵⁾/30 is below 1e-14 here, rounding ε/h.
fn rate<const R: usize, const C: usize>(
    f: impl Fn([f64; 2]) -> SMatrix<f64, R, C>,
    q: [f64; 2],
    z: [f64; 2],
) -> SMatrix<f64, R, C> {
    const H: f64 = 1e-3;
    let at = |k: f64| f([q[0] + k * H * z[0], q[1] + k * H * z[1]]);
    ((at(1.0) - at(-1.0)) * 8.0 - (at(2.0) - at(-2.0))) / (12.0 * H)
}

const SPEEDS: [f64; 2] = [0.7, -0.3];

#[test]
fn frames_and_their_jacobians() {
    let kernel = kernel();
    for q in STATES {
        for (frame, link) in [(GripperFrame::upper_arm, 0), (GripperFrame::left_finger, 2)] {
            let (at, z) = (SVector::from(q), SVector::from(SPEEDS));
            let pose = kernel.pose_of(frame, 0.0, &at);
            let expected = jacobian(&hand(q)[link].0);
            let found = in_observers_axes(&pose, &kernel.jacobian_of(frame, 0.0, &at));
            // Lengths below a metre, some thirty products.
            assert!((found - expected).amax() <= 60.0 * EPSILON, "{found} {expected}");
            let twist = in_observers_axes(&pose, &kernel.twist_of(frame, 0.0, &at, &z));
            assert!((twist - expected * z).amax() <= 60.0 * EPSILON, "{twist}");
            let change = rate(|q| jacobian(&hand(q)[link].0), q, SPEEDS);
            let found = in_observers_axes(&pose, &kernel.jacobian_rate_of(frame, 0.0, &at, &z));
            assert!((found - change).amax() <= 1e-12, "{found} {change}");
            let bias = in_observers_axes(&pose, &kernel.bias_of(frame, 0.0, &at, &z));
            assert!((bias - change * z).amax() <= 1e-12, "{bias}");
        }
    }
}

/// Mass, G, and rows Q̂ and Γ̂ about G for each speed.
fn whole(q: [f64; 2]) -> (f64, Vector3<f64>, Jacobian) {
    let links = hand(q);
    let center = |(link, _, center, _): &(Moved, f64, Vector3<f64>, Matrix3<f64>)| {
        link.pose.rotation * center + link.pose.translation.vector
    };
    let mass: f64 = links.iter().map(|(_, mass, ..)| mass).sum();
    let g = links.iter().map(|link| center(link) * link.1).sum::<Vector3<f64>>() / mass;
    let mut matrix = Jacobian::zeros();
    for link in &links {
        let (moved, mass, _, inertia) = link;
        let at = center(link);
        let r = *moved.pose.rotation.to_rotation_matrix().matrix();
        for (k, [linear, angular]) in moved.rates.iter().enumerate() {
            let momentum = (linear + angular.cross(&at)) * *mass;
            let spin = r * inertia * r.transpose() * angular + (at - g).cross(&momentum);
            for i in 0..3 {
                matrix[(i, k)] += momentum[i];
                matrix[(i + 3, k)] += spin[i];
            }
        }
    }
    (mass, g, matrix)
}

#[test]
fn the_whole() {
    let kernel = kernel();
    for q in STATES {
        let (at, z) = (SVector::from(q), SVector::from(SPEEDS));
        let (mass, g, matrix) = whole(q);
        assert!((kernel.total_mass() - mass).abs() <= 4.0 * EPSILON * mass);
        assert!((kernel.center_of_mass(0.0, &at) - g).amax() <= 60.0 * EPSILON);
        // Two kilograms, below a metre.
        assert!((kernel.centroidal_matrix(0.0, &at) - matrix).amax() <= 200.0 * EPSILON, "{matrix}");
        assert!((kernel.centroidal_momentum(0.0, &at, &z) - matrix * z).amax() <= 200.0 * EPSILON);
        let to_center = matrix.fixed_rows::<3>(0) / mass;
        assert!((kernel.center_jacobian(0.0, &at) - to_center).amax() <= 200.0 * EPSILON);
        assert!((kernel.center_velocity(0.0, &at, &z) - to_center * z).amax() <= 200.0 * EPSILON);
        let bias = rate(|q| whole(q).2, q, SPEEDS) * z;
        assert!((kernel.centroidal_bias(0.0, &at, &z) - bias).amax() <= 1e-12, "{bias}");
        // The power of the weight is that of a force at G.
        let weight = to_center.row(2).transpose() * (mass * 9.81);
        assert!((kernel.gravity_torques(0.0, &at) - weight).amax() <= 4e3 * EPSILON, "{weight}");
    }
}

/// C z + g with Christoffel's symbols of the mass matrix, less what joints do: stops, dampers and dry friction, which
/// are elements with names.
#[test]
fn nonlinear_effects_and_forces_at_a_frame() {
    let kernel = kernel();
    for q in STATES {
        let (at, z) = (SVector::from(q), SVector::from(SPEEDS));
        let none = SVector::zeros();
        let direction = |k: usize| if k == 0 { [1.0, 0.0] } else { [0.0, 1.0] };
        let by: [SMatrix<f64, 2, 2>; 2] = [0, 1].map(|k| rate(|q| summed(q).0, q, direction(k)));
        let along = by[0] * z[0] + by[1] * z[1];
        let halves = SVector::from([0, 1].map(|k| 0.5 * z.dot(&(by[k] * z))));
        let acting: SVector<f64, 2> = ["joint_damping", "joint_friction", "elbow_limits", "left_limits"]
            .iter()
            .filter_map(|name| kernel.generalised_force(name, 0.0, &at, &z, &none))
            .sum();
        let expected = along * z - halves + kernel.gravity_torques(0.0, &at) - acting;
        let found = kernel.nonlinear_effects(0.0, &at, &z, &none);
        assert!((found - expected).amax() <= 1e-11 * (1.0 + expected.amax()), "{found} {expected}");
        // A = L Lᵀ; Λ of two directions of the finger's origin: Λ⁻¹ = J A⁻¹ Jᵀ.
        let matrix = summed(q).0;
        let factor = Factor::of(&kernel.mass_matrix(0.0, &at)).unwrap();
        let size = matrix.amax();
        assert!((factor.lower() * factor.lower().transpose() - matrix).amax() <= 300.0 * EPSILON * size);
        let pose = kernel.pose_of(GripperFrame::left_finger, 0.0, &at);
        let all = in_observers_axes(&pose, &kernel.jacobian_of(GripperFrame::left_finger, 0.0, &at));
        let task: SMatrix<f64, 2, 2> = all.fixed_rows::<2>(0).into_owned();
        let space = OperationalSpace::new(&kernel.mass_matrix(0.0, &at), &task).unwrap();
        let shown = task * matrix.try_inverse().unwrap() * task.transpose();
        let condition =
            matrix.norm() * matrix.try_inverse().unwrap().norm() * task.norm() * task.try_inverse().unwrap().norm();
        let identity = space.inertia * shown;
        assert!((identity - SMatrix::identity()).amax() <= 1e3 * EPSILON * condition, "{identity} at {condition:e}");
    }
}
