//! A chart combines with whatever systems have, and fluid with every body: the same scene with the coordinates, speeds
//! and kinematics of the chart written out gives the same numbers in every method, up to bounds on the rounding of
//! both.

use crate::common::Bounded;
use crate::common::agreement::{equal, explore, largest};
use crate::common::body::{Parts, list, speeds};
use crate::common::parameters::Parameters;
use crate::common::states::{Motion, State};
use gauss_runtime::constraint::ConstrainedSystem;
use gauss_runtime::prelude::*;
use proptest::test_runner::TestCaseError;

/// The body of a chart, and the same as a field; what hangs on it is said in `clauses`.
macro_rules! scenes {
    ($module:ident, chart [$($chart:tt)+], own [$($own:tt)+], [$($clauses:tt)*]) => {
        mod $module {
            use super::*;

            /// The body without a name, in a chart.
            #[derive(GaussDynamics)]
            #[gauss($($chart)+, $($clauses)*)]
            pub struct InChart<T> {
                #[gauss(mass)]
                mass: T,
                #[gauss(center_of_mass)]
                center: Vector3<T>,
                #[gauss(inertia)]
                inertia: Matrix3<T>,
                #[gauss(gravity)]
                g: T,
                l: T,
                a: Vector3<T>,
            }

            /// The body without a name, in coordinates that are written out.
            #[derive(GaussDynamics)]
            #[gauss($($own)+, $($clauses)*)]
            pub struct Own<T> {
                #[gauss(mass)]
                mass: T,
                #[gauss(center_of_mass)]
                center: Vector3<T>,
                #[gauss(inertia)]
                inertia: Matrix3<T>,
                #[gauss(gravity)]
                g: T,
                l: T,
                a: Vector3<T>,
            }

            pub fn kernels(p: &Parameters) -> (InChartKernel<Bounded>, OwnKernel<Bounded>) {
                let [mass, g, l] = [p.mass(), p.g(), p.displaced()];
                let (center, inertia, a) = (p.center(), p.inertia(), p.buoyancy());
                let chart = InChart { mass, center, inertia, g, l, a }.kernel();
                let own = Own { mass, center, inertia, g, l, a }.kernel();
                (chart.expect("random bodies are physical"), own.expect("random bodies are physical"))
            }
        }
    };
}

/// What every kernel says at a state, each with its name.
fn everything<K>(
    kernel: &K,
    q: &K::Configuration,
    z: &K::Speeds,
    other: &K::Speeds,
) -> Vec<(&'static str, Vec<Bounded>)>
where
    K: GaussSystem<Scalar = Bounded, Input = ()>,
{
    let t = Bounded::from_f64(0.3);
    let p = kernel.momentum(t, q, z);
    let matrix = kernel.mass_matrix(t, q);
    let c = |a: &K::Speeds| kernel.constraint_function(t, q, z, a, &());
    let n = K::DOF;
    vec![
        ("q̇", list(&kernel.kinematics(t, q, z))),
        ("ż", list(&kernel.acceleration(t, q, z, &()))),
        ("p", list(&p)),
        ("z of p", list(&kernel.velocity(t, q, &p))),
        ("ṗ", list(&kernel.momentum_rate(t, q, &p, &()))),
        ("A", (0..n * n).map(|k| matrix[(k / n, k % n)]).collect()),
        ("T", vec![kernel.kinetic_energy(t, q, z)]),
        ("V", vec![kernel.potential_energy(t, q)]),
        ("residual", list(&kernel.gauss_residual(t, q, z, other, &()))),
        // C is given up to what does not depend on ż.
        ("C", vec![c(other) - c(&K::Speeds::zero())]),
    ]
}

/// What constraints add to it.
fn constraints<K>(kernel: &K, q: &K::Configuration, z: &K::Speeds) -> Vec<(&'static str, Vec<Bounded>)>
where
    K: ConstrainedSystem<Scalar = Bounded, Input = ()>,
{
    let t = Bounded::from_f64(0.3);
    let residual = kernel.velocity_residual(t, q, z);
    vec![
        ("multipliers", list(&kernel.multipliers(t, q, z, &()))),
        ("φ", list(&kernel.position_residual(t, q))),
        ("φ̇", list(&residual)),
        ("δq", list(&kernel.position_correction(t, q, &residual))),
        ("δz", list(&kernel.velocity_correction(t, q, z, &residual))),
    ]
}

fn same(left: &[(&'static str, Vec<Bounded>)], right: &[(&'static str, Vec<Bounded>)]) -> Result<(), TestCaseError> {
    left.iter().zip(right).try_for_each(|((name, one), (_, two))| equal(name, one, two))
}

/// Speeds of a kernel: the numbers that are given, in order.
fn any_speeds<V: VectorSpace<Bounded>>(numbers: impl IntoIterator<Item = f64>) -> V {
    let numbers: Vec<Bounded> = numbers.into_iter().take(V::DIM).map(Bounded::from_f64).collect();
    speeds(&numbers)
}

/// A random state: the pose, all speeds and as many accelerations.
fn state_of<K: GaussSystem<Scalar = Bounded>>(state: &State) -> (K::Speeds, K::Speeds) {
    let z = state.twist.into_iter().chain(state.direction);
    let other = state.direction.into_iter().chain(state.twist);
    (any_speeds(z), any_speeds(other))
}

/// Both kernels of a module at random states, on configurations that `$q` makes of them.
macro_rules! same_kernels {
    ($($test:ident: $module:ident, $motion:ident, $share:literal, $q:expr $(, $constrained:ident)?;)+) => {$(
        #[test]
        fn $test() {
            explore(Motion::$motion, $share, |parameters, state, tally| {
                let (chart, own) = $module::kernels(parameters);
                let (q, same_q) = $q(state);
                let (z, other) = state_of::<$module::InChartKernel<Bounded>>(state);
                let left = everything(&chart, &q, &z, &other);
                let right = everything(&own, &same_q, &z, &other);
                same(&left, &right)?;
                $(
                    let _ = stringify!($constrained);
                    same(&constraints(&chart, &q, &z), &constraints(&own, &same_q, &z))?;
                )?
                let rate = &left[1].1;
                tally.count(rate, largest(rate).max(largest(&list(&z)).powi(2)));
                Ok(())
            });
        }
    )+};
}

/// A pose.
fn pose(state: &State) -> (Isometry3<Bounded>, Isometry3<Bounded>) {
    (state.pose(), state.pose())
}

/// A pose and the angle of a hinge.
fn pose_and_angle(state: &State) -> (PoseAndAngle, PoseAndAngle) {
    let q = || (state.pose(), SVector::from([Bounded::from_f64(state.direction[2])]));
    (q(), q())
}

type PoseAndAngle = (Isometry3<Bounded>, SVector<Bounded, 1>);

/// Position, three angles, and the angle of a hinge.
fn coordinates(state: &State) -> (SVector<Bounded, 7>, SVector<Bounded, 7>) {
    let [x, y, z] = state.position;
    let [a, b, c, d, ..] = state.direction;
    let q = || SVector::from([x, y, z, a, b, c, d].map(Bounded::from_f64));
    (q(), q())
}

// What hangs on the body, whatever its coordinates are. The names of the clauses are those of both scenes.
scenes!(left_and_load,
    chart [chart = left_invariant],
    own [coordinates(pose: Pose), body(position = pose.position, rotation = pose.rotation)],
    [
        particle(mass = mass / 2, position = a, parent = body),
        point(tip, body = body, at = [l, 0, l / 2]),
        spring(from = [0, 0, 1], to = tip, stiffness = g, length = 0.1),
        force(body = body, value = [0, g * sin(t), 0], axes = observer)
    ]
);
scenes!(left_and_constraint,
    chart [chart = left_invariant],
    own [coordinates(pose: Pose), body(position = pose.position, rotation = pose.rotation)],
    [
        point(tip, body = body, at = [0.5, 0.2, 1]),
        constraint(position = dot(tip, tip) - 4),
        constraint(velocity = dot([1, 2, 0.5], body.body_velocity) - 0.1 * t)
    ]
);
scenes!(right_and_constraint,
    chart [chart = right_invariant],
    own [
        coordinates(pose: Pose),
        speeds(xi: Vector3, w: Vector3),
        kinematics(
            pose = twist(inverse(pose.rotation) * (xi + cross(w, pose.position)), inverse(pose.rotation) * w)
        ),
        body(position = pose.position, rotation = pose.rotation)
    ],
    [frame(mast, parent = body, position = [0.5, 0.2, 1]), constraint(position = dot(mast.position, mast.position) - 4)]
);
scenes!(hybrid_and_frame,
    chart [chart = hybrid],
    own [
        coordinates(pose: Pose),
        speeds(v: Vector3, w: Vector3),
        kinematics(pose = twist(inverse(pose.rotation) * v, w)),
        body(position = pose.position, rotation = pose.rotation)
    ],
    [
        frame(mast, parent = body, position = [0, 0, l], rotation = rotation_y(0.3)),
        particle(mass = mass, position = [0.1, sin(t), 0], parent = mast),
        drag(body = mast, linear = [1, 2, 3, 0.1, 0.2, 0.3])
    ]
);
// A ball that rolls: the speeds that stay are those of its rotation.
scenes!(left_and_rolling,
    chart [chart = left_invariant, independent(omega)],
    own [
        coordinates(pose: Pose),
        speeds(u: Vector3, w: Vector3),
        kinematics(pose = twist(u, w)),
        body(position = pose.position, rotation = pose.rotation),
        independent(w)
    ],
    [constraint(velocity = body.velocity + cross(body.angular_velocity, [0, 0, -0.5]))]
);

/// A chart whose body carries an arm on a hinge; in coordinates of its own each of the two bodies has a name.
macro_rules! hinged {
    ($module:ident, chart [$($chart:tt)+], own [$($own:tt)+], hull [$($hull:tt)+], speed [$($speed:tt)*]) => {
        mod $module {
            use super::*;

            #[derive(GaussDynamics)]
            #[gauss(
                $($chart)+,
                coordinates(bend), $($speed)*
                body(
                    arm, parent = body, position = [l, 0, 0.1], rotation = rotation_z(bend),
                    mass = mass / 2, center_of_mass = [0, l, 0], inertia = j
                ),
                force(body = arm, at = [0.2, 0, 0], value = [0, 0, g]),
                drive(bend = -g * bend)
            )]
            pub struct InChart<T> {
                #[gauss(mass)]
                mass: T,
                #[gauss(center_of_mass)]
                center: Vector3<T>,
                #[gauss(inertia)]
                inertia: Matrix3<T>,
                #[gauss(gravity)]
                g: T,
                l: T,
                j: Vector3<T>,
            }

            #[derive(GaussDynamics)]
            #[gauss(
                $($own)+,
                body(hull, $($hull)+),
                body(
                    arm, parent = hull, position = [l, 0, 0.1], rotation = rotation_z(bend),
                    mass = mass / 2, center_of_mass = [0, l, 0], inertia = j
                ),
                force(body = arm, at = [0.2, 0, 0], value = [0, 0, g]),
                drive(bend = -g * bend)
            )]
            pub struct Own<T> {
                #[gauss(body)]
                hull: RigidBody<T>,
                mass: T,
                #[gauss(gravity)]
                g: T,
                l: T,
                j: Vector3<T>,
            }

            pub fn kernels(p: &Parameters) -> (InChartKernel<Bounded>, OwnKernel<Bounded>) {
                let [mass, g] = [p.mass(), p.g()];
                let l = Bounded::from_f64(0.3);
                let (center, inertia) = (p.center(), p.inertia());
                // About O of the arm, whose centre of mass is at a distance l.
                let j = Vector3::from([1.0, 0.9, 1.1].map(|x| Bounded::from_f64(x + p.m)));
                let hull = RigidBody { mass, center_of_mass: center, inertia };
                let chart = InChart { mass, center, inertia, g, l, j }.kernel();
                let own = Own { hull, mass, g, l, j }.kernel();
                (chart.expect("random bodies are physical"), own.expect("random bodies are physical"))
            }
        }
    };
}

hinged!(left_and_arm,
    chart [chart = left_invariant],
    own [coordinates(pose: Pose, bend)],
    hull [position = pose.position, rotation = pose.rotation],
    speed []
);
hinged!(hybrid_and_arm,
    chart [chart = hybrid],
    own [
        coordinates(pose: Pose, bend),
        speeds(v: Vector3, w: Vector3, r),
        kinematics(pose = twist(inverse(pose.rotation) * v, w), bend = 2 * r)
    ],
    hull [position = pose.position, rotation = pose.rotation],
    speed [speeds(r), kinematics(bend = 2 * r),]
);
hinged!(zyx_and_arm,
    chart [chart = jet(euler_zyx)],
    own [coordinates(x, y, z, psi, theta, phi, bend)],
    hull [position = [x, y, z], rotation = rotation_z(psi) * rotation_y(theta) * rotation_x(phi)],
    speed []
);
hinged!(pivot_and_arm,
    chart [chart = hybrid, motion = fixed_point],
    own [coordinates(attitude: Rotation, bend)],
    hull [rotation = attitude],
    speed []
);

/// An attitude and the angle of a hinge.
fn attitude_and_angle(state: &State) -> (AttitudeAndAngle, AttitudeAndAngle) {
    let q = || (state.pose().rotation, SVector::from([Bounded::from_f64(state.direction[2])]));
    (q(), q())
}

type AttitudeAndAngle = (UnitQuaternion<Bounded>, SVector<Bounded, 1>);

same_kernels! {
    a_load_on_a_chart: left_and_load, Free, 0.5, pose;
    a_constrained_chart: left_and_constraint, Free, 0.3, pose, constrained;
    a_constrained_chart_about_the_origin: right_and_constraint, Free, 0.3, pose, constrained;
    a_mast_on_a_chart: hybrid_and_frame, Free, 0.5, pose;
    a_rolling_body: left_and_rolling, Free, 0.5, pose;
    an_arm_on_a_chart: left_and_arm, Free, 0.3, pose_and_angle;
    an_arm_on_a_hybrid_chart: hybrid_and_arm, Free, 0.3, pose_and_angle;
    an_arm_on_a_chart_of_angles: zyx_and_arm, Free, 0.1, coordinates;
    an_arm_on_a_top: pivot_and_arm, FixedPoint, 0.3, attitude_and_angle;
}

/// A body in the plane with an arm, in the given chart.
macro_rules! planar {
    ($name:ident [$($clauses:tt)+]) => {
        #[derive(GaussDynamics)]
        #[gauss($($clauses)+)]
        struct $name<T> {
            #[gauss(mass)]
            mass: T,
            #[gauss(center_of_mass)]
            center: Vector3<T>,
            #[gauss(inertia)]
            inertia: Matrix3<T>,
            #[gauss(gravity)]
            field: Vector3<T>,
            l: T,
        }

        impl From<&Parameters> for $name<Bounded> {
            fn from(p: &Parameters) -> Self {
                let [mass, l] = [p.mass(), Bounded::from_f64(0.3)];
                Self { mass, center: p.center(), inertia: p.inertia(), field: p.field(), l }
            }
        }
    };
}

planar!(Coordinates [
    coordinates(x, y, theta, bend),
    body(position = [x, y, 0], rotation = rotation_z(theta)),
    particle(mass = mass / 3, position = [l * cos(bend), l * sin(bend), 0], parent = body)
]);
planar!(PlanarJet [
    chart = jet, motion = planar, coordinates(bend),
    particle(mass = mass / 3, position = [l * cos(bend), l * sin(bend), 0], parent = body)
]);
planar!(PlanarHybrid [
    chart = hybrid, motion = planar, coordinates(bend),
    particle(mass = mass / 3, position = [l * cos(bend), l * sin(bend), 0], parent = body)
]);

#[test]
fn a_chart_in_the_plane_carries_a_pendulum() {
    explore(Motion::Planar, 0.3, |parameters, state, tally| {
        let coordinates = Coordinates::from(parameters).kernel().expect("physical");
        let jet = PlanarJet::from(parameters).kernel().expect("physical");
        let hybrid = PlanarHybrid::from(parameters).kernel().expect("physical");
        let ([x, y, ..], [theta, bend, ..]) = (state.position, state.direction);
        let q = SVector::from([x, y, theta, bend].map(Bounded::from_f64));
        let (z, other) = state_of::<CoordinatesKernel<Bounded>>(state);
        let expected = everything(&coordinates, &q, &z, &other);
        same(&expected, &everything(&jet, &q, &z, &other))?;
        // The speeds of the hybrid chart are ẋ, ẏ and θ̇ too; its rate of the configuration is in body axes.
        let angle = Bounded::from_f64(theta);
        let parts = [angle.cos(), angle.sin(), Bounded::from_f64(x), Bounded::from_f64(y)];
        let pose = Isometry2::assemble(&parts);
        let found = everything(&hybrid, &(pose, SVector::from([Bounded::from_f64(bend)])), &z, &other);
        same(&expected[1..], &found[1..])?;
        tally.count(&found[1].1, largest(&found[1].1).max(largest(&list(&z)).powi(2)));
        Ok(())
    });
}

/// One body in a fluid that streams: in a chart, with fields or with clauses for what the fluid does; and as the body
/// of a system.
macro_rules! in_fluid {
    ($module:ident, chart [$($chart:tt)+], own [$($own:tt)+], $added:ident [$($clause:tt)+]) => {
        mod $module {
            use super::*;

            #[derive(GaussDynamics)]
            #[gauss($($chart)+, medium(velocity = stream + t * surge), drag(linear = [1, 2, 3, 0.1, 0.2, 0.3]))]
            pub struct ByRoles<T> {
                #[gauss(mass)]
                mass: T,
                #[gauss(center_of_mass)]
                center: Vector3<T>,
                #[gauss(inertia)]
                inertia: Matrix3<T>,
                #[gauss(gravity)]
                field: Vector3<T>,
                #[gauss(added_mass)]
                fluid: $added<T>,
                #[gauss(displaced_mass)]
                displaced: T,
                #[gauss(center_of_buoyancy)]
                buoyancy: Vector3<T>,
                stream: Vector3<T>,
                surge: Vector3<T>,
            }

            #[derive(GaussDynamics)]
            #[gauss(
                $($chart)+, medium(velocity = stream + t * surge), drag(linear = [1, 2, 3, 0.1, 0.2, 0.3]),
                added_mass = $($clause)+, displaced_mass = displaced, center_of_buoyancy = buoyancy
            )]
            pub struct ByClauses<T> {
                #[gauss(mass)]
                mass: T,
                #[gauss(center_of_mass)]
                center: Vector3<T>,
                #[gauss(inertia)]
                inertia: Matrix3<T>,
                #[gauss(gravity)]
                field: Vector3<T>,
                fluid: $added<T>,
                displaced: T,
                buoyancy: Vector3<T>,
                x: T,
                stream: Vector3<T>,
                surge: Vector3<T>,
            }

            #[derive(GaussDynamics)]
            #[gauss(
                $($own)+,
                body(
                    hull, position = pose.position, rotation = pose.rotation,
                    added_mass = $($clause)+, displaced_mass = displaced, center_of_buoyancy = buoyancy
                ),
                medium(velocity = stream + t * surge),
                drag(body = hull, linear = [1, 2, 3, 0.1, 0.2, 0.3])
            )]
            pub struct OfSystem<T> {
                #[gauss(body)]
                hull: RigidBody<T>,
                #[gauss(gravity)]
                field: Vector3<T>,
                fluid: $added<T>,
                displaced: T,
                buoyancy: Vector3<T>,
                x: T,
                stream: Vector3<T>,
                surge: Vector3<T>,
            }

            pub type Kernels = (ByRolesKernel<Bounded>, ByClausesKernel<Bounded>, OfSystemKernel<Bounded>);

            pub fn kernels(p: &Parameters, fluid: $added<Bounded>) -> Kernels {
                let [mass, displaced, x] = [p.mass(), p.displaced(), fluid[0]];
                let (center, inertia, field, buoyancy) = (p.center(), p.inertia(), p.field(), p.buoyancy());
                let (stream, surge) = (Vector3::from(p.c.map(Bounded::from_f64)), p.buoyancy());
                let roles = ByRoles { mass, center, inertia, field, fluid, displaced, buoyancy, stream, surge };
                let clauses = ByClauses { mass, center, inertia, field, fluid, displaced, buoyancy, x, stream, surge };
                let hull = RigidBody { mass, center_of_mass: center, inertia };
                let system = OfSystem { hull, field, fluid, displaced, buoyancy, x, stream, surge };
                (
                    roles.kernel().expect("random bodies are physical"),
                    clauses.kernel().expect("random bodies are physical"),
                    system.kernel().expect("random bodies are physical"),
                )
            }
        }
    };
}

in_fluid!(left_in_fluid, chart [chart = left_invariant], own [coordinates(pose: Pose)], Matrix6 [fluid]);
in_fluid!(hybrid_in_fluid,
    chart [chart = hybrid],
    own [
        coordinates(pose: Pose),
        speeds(v: Vector3, w: Vector3),
        kinematics(pose = twist(inverse(pose.rotation) * v, w))
    ],
    Vector6 [fluid]
);
in_fluid!(left_in_light_fluid,
    chart [chart = left_invariant],
    own [coordinates(pose: Pose)],
    Vector6 [[x, 2 * x, 0.5, x, 1, x]]
);

/// All three descriptions of a body in a fluid.
macro_rules! same_in_fluid {
    ($($test:ident: $module:ident, $fluid:expr;)+) => {$(
        #[test]
        fn $test() {
            explore(Motion::Free, 0.3, |parameters, state, tally| {
                let (roles, clauses, system) = $module::kernels(parameters, $fluid(parameters));
                let q = state.pose();
                let (z, other) = state_of::<$module::ByRolesKernel<Bounded>>(state);
                let expected = everything(&roles, &q, &z, &other);
                same(&expected, &everything(&clauses, &q, &z, &other))?;
                same(&expected, &everything(&system, &q, &z, &other))?;
                let rate = &expected[1].1;
                tally.count(rate, largest(rate).max(largest(&list(&z)).powi(2)));
                Ok(())
            });
        }
    )+};
}

/// The diagonal that the list of the third scene says.
fn light(p: &Parameters) -> Vector6<Bounded> {
    let x = p.diagonal_fluid[0];
    Vector6::from([x, 2.0 * x, 0.5, x, 1.0, x].map(Bounded::from_f64))
}

same_in_fluid! {
    added_mass_of_every_body: left_in_fluid, Parameters::fluid;
    added_mass_of_every_body_in_a_hybrid_chart: hybrid_in_fluid, Parameters::diagonal_fluid;
    added_mass_as_a_list: left_in_light_fluid, light;
}
