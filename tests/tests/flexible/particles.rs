//! A body of four particles that move by two modes, by integrals and one by one: displacements are linear in η, so that
//! no term of the energy is beyond the second order and both are the same system.

use gauss_runtime::prelude::*;

use super::common::Bounded;
use super::common::kernels::same;

macro_rules! pair {
    ($test:ident: $modal:ident $beside:ident, $origin:expr, [$($scene:tt)+] [$($modes:tt)+] [$($particles:tt)+]) => {
        #[derive(GaussDynamics)]
        #[gauss($($scene)+, $($modes)+)]
        struct $modal<T> {
            k: T,
            #[gauss(gravity)]
            g: Vector3<T>,
        }

        #[derive(GaussDynamics)]
        #[gauss($($scene)+, $($particles)+)]
        struct $beside<T> {
            k: T,
            #[gauss(gravity)]
            g: Vector3<T>,
        }

        #[test]
        fn $test() {
            let [k, a, b, c] = [6.0, 1.5, -2.0, -9.81].map(Bounded::from_f64);
            let g = Vector3::new(a, b, c);
            same(&$origin, &$modal { k, g }.kernel().unwrap(), &$beside { k, g }.kernel().unwrap());
        }
    };
}

// A panel on a hinge of a free craft.
pair!(on_a_free_craft: Modal Particles, (Isometry3::<f64>::identity(), SVector::from([0.4, 0.2, -0.3])), [
    coordinates(base: Pose, theta, a, b),
    body(hull, pose = base, mass = 20, center_of_mass = [0.1, 0, 0.2], inertia = [5, 6, 7])
] [
    body(panel, parent = hull, position = [0.5, 0.1, 0], rotation = rotation_z(theta),
        mass = 8, center_of_mass = [1.125, -0.125, 1.125], inertia = [24, 0, -8, 30, 7, 20]),
    modes(panel, coordinates = [a, b],
        translation = [[2, 4, 4], [4, 2, 2]],
        rotation = [[-9, -6, 2], [-1, 2, 3]],
        mass = [[10.5, 3], [3, 7.5]],
        stiffness = [[4, 1], [1, k]],
        damping = [[0.2, 0.1], [0.1, 0.3]],
        inertia = [[-2, 10, -4, -6, -8, -7], [-4, 14, 6, -3, -6, -5]],
        gyroscopic = [[[0, 0, 0], [3, -1.5, 3]], [[-3, 1.5, -3], [0, 0, 0]]],
        second_inertia = [[[18, 13, 11, 0, 0, -4], [4, 2, 6, -1, -4.5, -3]],
                          [[4, 2, 6, -1, -4.5, -3], [9, 9, 12, -2, -2, 2]]])
] [
    frame(panel, parent = hull, position = [0.5, 0.1, 0], rotation = rotation_z(theta)),
    particle(parent = panel, mass = 1, position = [1, b, a]),
    particle(parent = panel, mass = 2, position = [2 + 0.5 * a + b, 1, a + 0.5 * b]),
    particle(parent = panel, mass = 1, position = [a, 1 - b, 1 - a + b]),
    particle(parent = panel, mass = 4, position = [1 + 0.5 * b, -1 + a + 0.5 * b, 2 + 0.5 * a]),
    potential = 2 * a * a + a * b + 0.5 * k * b * b,
    drive(a = -0.2 * rate(a) - 0.1 * rate(b), b = -0.1 * rate(a) - 0.3 * rate(b))
]);

// The rates of modes and joints are mixed in the speeds, and the hinge is moved in time.
pair!(by_quasi_velocities: ModalMixed ParticlesMixed, SVector::from([0.4, 0.2, -0.3]), [
    coordinates(theta, a, b),
    speeds(v, p, r),
    kinematics(theta = v + a * p, a = p * cos(theta) - 2 * r, b = r + 0.3 * v)
] [
    body(panel, position = [0.3 * t, 0.1, t * t], rotation = rotation_y(theta),
        mass = 8, center_of_mass = [1.125, -0.125, 1.125], inertia = [24, 0, -8, 30, 7, 20]),
    modes(panel, coordinates = [a, b],
        translation = [[2, 4, 4], [4, 2, 2]],
        rotation = [[-9, -6, 2], [-1, 2, 3]],
        mass = [[10.5, 3], [3, 7.5]],
        stiffness = [4, k],
        inertia = [[-2, 10, -4, -6, -8, -7], [-4, 14, 6, -3, -6, -5]],
        gyroscopic = [[[0, 0, 0], [3, -1.5, 3]], [[-3, 1.5, -3], [0, 0, 0]]],
        second_inertia = [[[18, 13, 11, 0, 0, -4], [4, 2, 6, -1, -4.5, -3]],
                          [[4, 2, 6, -1, -4.5, -3], [9, 9, 12, -2, -2, 2]]])
] [
    frame(panel, position = [0.3 * t, 0.1, t * t], rotation = rotation_y(theta)),
    particle(parent = panel, mass = 1, position = [1, b, a]),
    particle(parent = panel, mass = 2, position = [2 + 0.5 * a + b, 1, a + 0.5 * b]),
    particle(parent = panel, mass = 1, position = [a, 1 - b, 1 - a + b]),
    particle(parent = panel, mass = 4, position = [1 + 0.5 * b, -1 + a + 0.5 * b, 2 + 0.5 * a]),
    potential = 2 * a * a + 0.5 * k * b * b
]);

// In the plane components are taken in the axes of the observer.
pair!(in_the_plane: ModalPlane ParticlesPlane, SVector::from([0.3, -0.4, 0.2]), [
    coordinates(x, turn, a),
    body(cart, position = [x, 0, 0], mass = 2, inertia = [0, 0, 0])
] [
    body(boom, parent = cart, position = [0, 0, 0.5], rotation = rotation_y(turn),
        mass = 8, center_of_mass = [1.125, 0, 1.375], inertia = [19, 0, -12, 32, 0, 13]),
    modes(boom, coordinates = [a], translation = [[2, 0, 4]], rotation = [[0, -5, 0]], mass = [6.5], stiffness = [k],
        inertia = [[10, 14, 4, 0, -9, 0]], second_inertia = [[[10, 13, 3, 0, 0, 0]]])
] [
    frame(boom, parent = cart, position = [0, 0, 0.5], rotation = rotation_y(turn)),
    particle(parent = boom, mass = 1, position = [1, 0, a]),
    particle(parent = boom, mass = 2, position = [2 + 0.5 * a, 0, 1 + a]),
    particle(parent = boom, mass = 1, position = [a, 0, 1 - a]),
    particle(parent = boom, mass = 4, position = [1, 0, 2 + 0.5 * a]),
    potential = 0.5 * k * a * a
]);
