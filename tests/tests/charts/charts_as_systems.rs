//! The charts of one body written in the language of systems: every method gives the same numbers as the kernel of the
//! chart, up to bounds on the rounding of both.

use crate::common::Bounded;
use crate::common::agreement::{equal, explore, largest};
use crate::common::body::{Body, Scene, list, speeds};
use crate::common::parameters::Parameters;
use crate::common::states::Motion;
use gauss_runtime::prelude::*;
use proptest::test_runner::TestCaseError;

mod charts {
    heavy!(Left LeftKernel, free, [left_invariant]);
    heavy!(Right RightKernel, free, [right_invariant]);
    heavy!(Hybrid HybridKernel, free, [hybrid]);
    heavy!(Zyx ZyxKernel, free, [jet(euler_zyx)]);
    heavy!(Zxz ZxzKernel, free, [jet(euler_zxz)]);
}

macro_rules! system {
    ($name:ident [$($clause:tt)+]) => {
        #[derive(GaussDynamics)]
        #[gauss($($clause)+)]
        struct $name<T> {
            #[gauss(mass)]
            mass: T,
            #[gauss(center_of_mass)]
            center: Vector3<T>,
            #[gauss(inertia)]
            inertia: Matrix3<T>,
            #[gauss(gravity)]
            g: T,
        }

        impl From<&Parameters> for $name<Bounded> {
            fn from(p: &Parameters) -> Self {
                Self { mass: p.mass(), center: p.center(), inertia: p.inertia(), g: p.g() }
            }
        }
    };
}

// Without speeds the rates of a pose are (u, ω) in body axes.
system!(Left [
    coordinates(pose: Pose),
    body(position = pose.position, rotation = pose.rotation)
]);
system!(LeftBySpeeds [
    coordinates(pose: Pose),
    speeds(u: Vector3, w: Vector3),
    kinematics(pose = twist(u, w)),
    body(position = pose.position, rotation = pose.rotation)
]);
system!(Hybrid [
    coordinates(pose: Pose),
    speeds(v: Vector3, w: Vector3),
    kinematics(pose = twist(inverse(pose.rotation) * v, w)),
    body(position = pose.position, rotation = pose.rotation)
]);
system!(Right [
    coordinates(pose: Pose),
    speeds(xi: Vector3, w: Vector3),
    kinematics(
        pose = twist(inverse(pose.rotation) * (xi + cross(w, pose.position)), inverse(pose.rotation) * w)
    ),
    body(position = pose.position, rotation = pose.rotation)
]);
system!(Zyx [
    coordinates(x, y, z, psi, theta, phi),
    body(position = [x, y, z], rotation = rotation_z(psi) * rotation_y(theta) * rotation_x(phi))
]);
system!(Zxz [
    coordinates(x, y, z, phi, theta, psi),
    body(position = [x, y, z], rotation = rotation_z(phi) * rotation_x(theta) * rotation_z(psi))
]);

/// Everything that a kernel says at a state, each with its name.
fn everything<K>(
    kernel: &K,
    q: &K::Configuration,
    z: &K::Speeds,
    other: &K::Speeds,
) -> Vec<(&'static str, Vec<Bounded>)>
where
    K: GaussSystem<Scalar = Bounded, Input = ()>,
{
    let t = Bounded::zero();
    let p = kernel.momentum(t, q, z);
    let matrix = kernel.mass_matrix(t, q);
    let c = |a: &K::Speeds| kernel.constraint_function(t, q, z, a, &());
    vec![
        ("q̇", list(&kernel.kinematics(t, q, z))),
        ("ż", list(&kernel.acceleration(t, q, z, &()))),
        ("p", list(&p)),
        ("z of p", list(&kernel.velocity(t, q, &p))),
        ("ṗ", list(&kernel.momentum_rate(t, q, &p, &()))),
        ("A", (0..36).map(|k| matrix[(k / 6, k % 6)]).collect()),
        ("T", vec![kernel.kinetic_energy(t, q, z)]),
        ("V", vec![kernel.potential_energy(t, q)]),
        ("residual", list(&kernel.gauss_residual(t, q, z, other, &()))),
        // C is given up to what does not depend on ż.
        ("C", vec![c(other) - c(&K::Speeds::zero())]),
    ]
}

fn same<A: Body<Bounded>, B>(
    chart: &A,
    system: &B,
    (q, z): (&A::Configuration, &A::Speeds),
    direction: &[f64; 6],
) -> Result<Vec<Bounded>, TestCaseError>
where
    B: GaussSystem<Scalar = Bounded, Configuration = A::Configuration, Speeds = A::Speeds, Input = ()>,
{
    let other: A::Speeds = speeds(&direction.map(Bounded::from_f64));
    let expected = everything(chart, q, z, &other);
    let found = everything(system, q, z, &other);
    for ((name, one), (_, two)) in expected.iter().zip(&found) {
        equal(name, one, two)?;
    }
    Ok(found[1].1.clone())
}

/// A chart and systems that are that chart.
macro_rules! same_kernels {
    ($($test:ident: $chart:ident, $($system:ident)+;)+) => {$(
        #[test]
        fn $test() {
            // Most states, far enough from singular points and with masses of one order, are sharp to 1e-12.
            explore(Motion::Free, 0.7, |parameters, state, tally| {
                let chart = charts::$chart::<()>::kernel::<Bounded>(parameters);
                let Ok((q, z)) = state.of(&chart) else { return Ok(()) };
                $(
                    let system = $system::from(parameters).kernel().expect("random bodies are physical");
                    let rate = same(&chart, &system, (&q, &z), &state.direction)?;
                    tally.count(&rate, largest(&rate).max(largest(&list(&z)).powi(2)));
                )+
                Ok(())
            });
        }
    )+};
}

same_kernels! {
    left_invariant_is_a_system: Left, Left LeftBySpeeds;
    hybrid_is_a_system: Hybrid, Hybrid;
    right_invariant_is_a_system: Right, Right;
    euler_zyx_is_a_system: Zyx, Zyx;
    euler_zxz_is_a_system: Zxz, Zxz;
}
