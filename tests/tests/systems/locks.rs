//! Locked coordinates against scenes in which the value stands in their place.

use crate::common::Bounded;
use crate::common::kernels::same;
use gauss_runtime::prelude::*;

macro_rules! pair {
    ($test:ident: $locked:ident $by_hand:ident, $origin:expr, [$($scene:tt)+] [$($clauses:tt)+]) => {
        pair!(@ $locked [$($scene)+]);
        pair!(@ $by_hand [$($clauses)+]);

        #[test]
        fn $test() {
            let [a, g] = [Bounded::from_f64(0.3), Bounded::from_f64(9.81)];
            same(&$origin, &$locked { a, g }.kernel().unwrap(), &$by_hand { a, g }.kernel().unwrap());
        }
    };
    (@ $name:ident [$($scene:tt)+]) => {
        #[derive(GaussDynamics)]
        #[gauss($($scene)+)]
        struct $name<T> {
            a: T,
            #[gauss(gravity)]
            g: T,
        }
    };
}

// A link in the middle of a chain, with a spring and a damper that reach over it.
pair!(in_a_chain: Stiff ByHand, SVector::from([0.3, 0.2]), [
    coordinates(x, y, z),
    body(b0, rotation = rotation_z(x), mass = 2, center_of_mass = [0.1, 0, 0.2], inertia = [1, 1, 0.5]),
    body(b1, parent = b0, position = [0.3, y * y, 0], rotation = rotation_y(y), mass = 1, center_of_mass = [0, 0.1, 0.3],
         inertia = [0.5, 0.5, 0.2]),
    body(b2, parent = b1, position = [0, 0, 0.5], rotation = rotation_x(z + y), mass = 0.5,
         center_of_mass = [0, 0.1, 0.3], inertia = [0.2, 0.3, 0.2]),
    armature(z = 0.1), spring(along = z - 2 * y, stiffness = 5, damping = 0.2), lock(y = a)
] [
    coordinates(x, z),
    body(b0, rotation = rotation_z(x), mass = 2, center_of_mass = [0.1, 0, 0.2], inertia = [1, 1, 0.5]),
    body(b1, parent = b0, position = [0.3, a * a, 0], rotation = rotation_y(a), mass = 1, center_of_mass = [0, 0.1, 0.3],
         inertia = [0.5, 0.5, 0.2]),
    body(b2, parent = b1, position = [0, 0, 0.5], rotation = rotation_x(z + a), mass = 0.5,
         center_of_mass = [0, 0.1, 0.3], inertia = [0.2, 0.3, 0.2]),
    armature(z = 0.1), spring(along = z - 2 * a, stiffness = 5, damping = 0.2)
]);

// Speeds of one's own: that of the locked coordinate is zero wherever it stands.
pair!(with_speeds: StiffCraft CraftByHand, (Isometry3::<f64>::identity(), SVector::from([0.2])), [
    coordinates(base: Pose, s, turn),
    speeds(u: Vector3, w: Vector3, v, bend),
    kinematics(base = twist(u, w), s = bend, turn = v + s * bend),
    body(hull, pose = base, mass = 2, center_of_mass = [0.1, 0, 0.2], inertia = [1, 1, 0.5]),
    body(arm, parent = hull, position = [s, 0, 0], rotation = rotation_y(turn), mass = 1, center_of_mass = [0, 0.1, 0.3],
         inertia = [0.5, 0.5, 0.2]),
    lock(s = 2 * a)
] [
    coordinates(base: Pose, turn),
    speeds(u: Vector3, w: Vector3, v),
    kinematics(base = twist(u, w), turn = v),
    body(hull, pose = base, mass = 2, center_of_mass = [0.1, 0, 0.2], inertia = [1, 1, 0.5]),
    body(arm, parent = hull, position = [2 * a, 0, 0], rotation = rotation_y(turn), mass = 1,
         center_of_mass = [0, 0.1, 0.3], inertia = [0.5, 0.5, 0.2])
]);

// Beside a body in a chart.
pair!(beside_a_chart: StiffWheel WheelByHand, Isometry3::<f64>::identity(), [
    motion = free, chart = left_invariant, mass = 2, inertia = [1, 2, 2.5], coordinates(turn),
    body(wheel, parent = body, position = [0, 0, 0.3], rotation = rotation_x(turn), mass = 1, inertia = [0.2, 0.1, 0.2]),
    lock(turn = a)
] [
    motion = free, chart = left_invariant, mass = 2, inertia = [1, 2, 2.5],
    body(wheel, parent = body, position = [0, 0, 0.3], rotation = rotation_x(a), mass = 1, inertia = [0.2, 0.1, 0.2])
]);
