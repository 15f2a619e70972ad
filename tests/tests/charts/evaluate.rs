//! `evaluate`: what the methods give one by one, for less.

use gauss_runtime::description::Operations;
use gauss_runtime::prelude::*;
use proptest::prelude::*;

/// A heavy body with full data, whatever the chart.
macro_rules! bodies {
    ($($name:ident: $chart:meta)+) => {$(
        #[derive(GaussDynamics)]
        #[gauss($chart)]
        struct $name {
            #[gauss(mass)]
            mass: f64,
            #[gauss(center_of_mass)]
            center: Vector3<f64>,
            #[gauss(inertia)]
            inertia: Matrix3<f64>,
            #[gauss(gravity)]
            g: f64,
        }

        impl $name {
            fn new() -> Self {
                let inertia = Matrix3::new(2.0, 0.1, -0.2, 0.1, 2.2, 0.05, -0.2, 0.05, 1.9);
                Self { mass: 1.5, center: Vector3::new(0.1, -0.2, 0.15), inertia, g: 9.81 }
            }
        }
    )+};
}

bodies! {
    Left: chart = left_invariant
    Hybrid: chart = hybrid
    Angles: chart = jet(euler_zyx)
}

/// A disk that rolls: multipliers, a rotation among the coordinates, a torque as input.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y, z, attitude: Rotation),
    mass = m, inertia = [j, j, 2 * j], gravity = 9.81,
    body(position = [x, y, z], rotation = attitude),
    input(torque: Vector3),
    torque(body = body, value = torque),
    constraint(velocity = dot([0, 0, 1], body.velocity + cross(body.angular_velocity, [0, 0, -r]))),
    constraint(velocity = dot([1, 0, 0], body.velocity + cross(body.angular_velocity, [0, 0, -r]))),
)]
struct Rolling {
    m: f64,
    j: f64,
    r: f64,
}

/// Everything agrees up to the rounding of some hundred operations on numbers of order hundred, and costs less than its
/// parts.
fn check<K: GaussSystem<Scalar = f64> + DescribedSystem>(
    kernel: &K,
    q: &K::Configuration,
    z: &K::Speeds,
    input: &K::Input,
) {
    let all = kernel.evaluate(0.3, q, z, input);
    let parts = [
        (list(&all.velocity), list(&kernel.kinematics(0.3, q, z))),
        (list(&all.acceleration), list(&kernel.acceleration(0.3, q, z, input))),
        (vec![all.kinetic_energy], vec![kernel.kinetic_energy(0.3, q, z)]),
        (vec![all.potential_energy], vec![kernel.potential_energy(0.3, q)]),
        (vec![all.energy()], vec![kernel.energy(0.3, q, z)]),
    ];
    for (together, alone) in parts {
        assert!(together.iter().zip(&alone).all(|(a, b)| (a - b).abs() <= 1e-11), "{together:?} and {alone:?}");
    }
    let Operations { kinematics, acceleration, kinetic_energy, potential_energy, evaluate, .. } = K::OPERATIONS;
    let apart: u32 =
        [kinematics, acceleration, kinetic_energy, potential_energy].iter().map(|count| count.total()).sum();
    assert!(evaluate.total() < apart, "{} together, {apart} apart", evaluate.total());
}

fn list<V: VectorSpace<f64>>(vector: &V) -> Vec<f64> {
    (0..V::DIM).map(|i| vector.component(i)).collect()
}

proptest! {
    #[test]
    fn everything_at_once(
        angles in prop::array::uniform3(-1.2..1.2),
        place in prop::array::uniform3(-1.0..1.0),
        z in prop::array::uniform6(-2.0..2.0),
        torque in prop::array::uniform3(-1.0..1.0),
    ) {
        let attitude = UnitQuaternion::from_scaled_axis(Vector3::from(angles));
        let pose = Isometry3::from_parts(Vector3::from(place).into(), attitude);
        let z = SVector::from(z);
        check(&Left::new().kernel().expect("a body"), &pose, &z, &());
        check(&Hybrid::new().kernel().expect("a body"), &pose, &z, &());
        let [[a, b, c], [x, y, h]] = [angles, place];
        check(&Angles::new().kernel().expect("a body"), &SVector::from([x, y, h, a, b, c]), &z, &());
        let rolling = Rolling { m: 1.5, j: 0.2, r: 0.4 }.kernel().expect("a disk");
        let configuration = (attitude, SVector::from(place));
        check(&rolling, &configuration, &z, &SVector::from(torque));
    }
}
