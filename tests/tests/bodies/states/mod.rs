//! Coordinates and speeds by name: every kind of both, in every chart, to and from configurations and speeds.

mod saved;

use gauss_runtime::integrate::Crossing;
use gauss_runtime::prelude::*;
use gauss_tables::{RunTable, Table, Tabulate};

/// Scalars before, between and after elements of groups, which come first in the configuration.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(before, craft: Pose, between, attitude: Rotation, after),
    speeds(first, u: Vector3, w: Vector3, second, omega: Vector3, third),
    kinematics(before = first, craft = twist(u, w), between = second, attitude = omega, after = third),
    body(hull, pose = craft, mass = m, inertia = [1, 2, 2.5]),
    body(top, rotation = attitude, mass = m, inertia = [1, 2, 2.5]),
    particle(mass = m, position = [before, between, after]),
)]
struct Mixed<T> {
    m: T,
}

fn pose() -> Isometry3<f64> {
    Isometry3::new(Vector3::new(1.0, 2.0, 3.0), Vector3::new(0.1, 0.2, 0.3))
}

#[test]
fn every_kind_to_and_from() {
    let attitude = UnitQuaternion::from_euler_angles(0.3, 0.2, 0.1);
    let (u, w, omega) = (Vector3::new(1.0, 2.0, 3.0), Vector3::new(4.0, 5.0, 6.0), Vector3::new(7.0, 8.0, 9.0));
    let state = MixedState {
        before: 0.1,
        between: 0.2,
        after: 0.3,
        craft: pose(),
        attitude,
        first: -1.0,
        second: -2.0,
        third: -3.0,
        u,
        w,
        omega,
    };
    let (q, z) = (state.q(), state.z());
    assert_eq!(q.0.translation, pose().translation);
    assert_eq!((q.1.0, q.1.1), (attitude, SVector::from([0.1, 0.2, 0.3])));
    assert_eq!(z, SVector::from([-1.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, -2.0, 7.0, 8.0, 9.0, -3.0]));
    let MixedState { before, craft, attitude: turned, third, w: same, .. } = MixedState::of(&q, &z);
    assert_eq!((before, turned, third, same), (0.1, attitude, -3.0, w));
    assert_eq!(craft.rotation, pose().rotation);
    let rest = MixedState::<f64>::default();
    assert_eq!((rest.craft, rest.between, rest.omega), (Isometry3::identity(), 0.0, Vector3::zeros()));
    assert!(format!("{rest:?}").starts_with("MixedState { before: 0.0, craft: "), "{rest:?}");
    // As the kernel reads them.
    let kernel = Mixed { m: 2.0 }.kernel().expect("bodies");
    let rates = kernel.kinematics(0.0, &q, &z);
    assert_eq!(rates.first, SVector::from([1.0, 2.0, 3.0, 4.0, 5.0, 6.0]));
    assert_eq!((rates.second.first, rates.second.second), (omega, SVector::from([-1.0, -2.0, -3.0])));
}

/// Without `speeds` the rates have names of their own; in closures of inputs and events states are read by name.
#[derive(GaussDynamics)]
#[gauss(coordinates(cart, angle), input(push), drive(cart = push),
    particle(mass = 1, position = [cart, 0, 0]), particle(mass = 1, position = [cart + sin(angle), 0, -cos(angle)]))]
struct CartPole {
    #[gauss(gravity)]
    g: f64,
}

#[test]
fn in_closures() {
    let kernel = CartPole { g: 9.81 }.kernel().expect("particles");
    let start = CartPoleState { angle: 0.5, ..CartPoleState::default() };
    let held = |_t: f64, q: &_, z: &_| {
        let CartPoleState { cart, cart_dot, .. } = CartPoleState::of(q, z);
        SVector::from([-4.0 * cart - 2.0 * cart_dot])
    };
    let run = Simulation::new(&kernel)
        .input(held)
        .until(Crossing::Falling, |_t, q, z| CartPoleState::of(q, z).angle)
        .adaptive(1e-9, 1e-9)
        .run(start.q(), start.z(), 0.0..10.0)
        .expect("a run");
    let end = CartPoleState::of(&run.last().q, &run.last().z);
    assert!(end.angle.abs() < 1e-9 && end.angle_dot < 0.0, "{end:?}");
}

/// Charts: their poses, rotations or coordinates, and their speeds.
macro_rules! chart {
    ($name:ident, $($clauses:tt)*) => {
        #[derive(GaussDynamics)]
        #[gauss($($clauses)*)]
        struct $name {
            #[gauss(mass)]
            m: f64,
            #[gauss(inertia)]
            i: f64,
        }
    };
}
chart!(Free, chart = hybrid);
chart!(Kirchhoff, chart = left_invariant);
chart!(Fixed, chart = right_invariant, motion = fixed_point);
chart!(Planar, motion = planar);
chart!(Jet, chart = jet(euler_zyx));
chart!(PlanarJet, chart = jet, motion = planar);
chart!(
    Arm,
    chart = hybrid,
    coordinates(elbow),
    body(arm, parent = body, rotation = rotation_z(elbow), mass = 1, inertia = [1, 1, 1])
);

#[test]
fn charts() {
    let (u, omega) = (Vector3::new(1.0, 2.0, 3.0), Vector3::new(4.0, 5.0, 6.0));
    assert_eq!(FreeState { pose: pose(), b_dot: u, omega }.z(), SVector::from([1.0, 2.0, 3.0, 4.0, 5.0, 6.0]));
    assert_eq!(KirchhoffState { u, ..Default::default() }.z().fixed_rows::<3>(0), u);
    assert_eq!(FixedState { omega, ..FixedState::default() }.z(), omega);
    let plane = PlanarState { u: SVector::from([1.0, 2.0]), omega: 3.0, ..PlanarState::default() };
    assert_eq!((plane.q(), plane.z()), (Isometry2::identity(), SVector::from([1.0, 2.0, 3.0])));
    let jet = JetState { b2: 0.2, psi: 0.4, theta: 0.5, phi: 0.6, b3_dot: 1.0, phi_dot: 2.0, ..JetState::default() };
    assert_eq!(jet.q(), SVector::from([0.0, 0.2, 0.0, 0.4, 0.5, 0.6]));
    assert_eq!(jet.z(), SVector::from([0.0, 0.0, 1.0, 0.0, 0.0, 2.0]));
    assert_eq!(PlanarJetState { theta: 0.5, ..PlanarJetState::default() }.q()[2], 0.5);
    let arm = ArmState { elbow: 0.3, elbow_dot: 0.7, ..ArmState::default() };
    assert_eq!((arm.q().1[0], arm.z()[6]), (0.3, 0.7));
}

/// The speeds of a body in a chart without coordinates are velocities of the body; a chart with further coordinates is
/// `Own`.
#[test]
fn units_of_charts() {
    fn units<S: GaussSystem<Scalar = f64> + DescribedSystem>(q: S::Configuration, z: S::Speeds) -> String {
        let table = RunTable::<S>::new(vec![Sample { t: 0.0, q, z, p: z }]).state().si();
        table.iter().map(|column| column.unit.unwrap_or("?")).collect::<Vec<_>>().join(" ")
    }
    let free = FreeState::default();
    assert_eq!(units::<FreeKernel>(free.q(), free.z()), "s 1 1 1 1 m m m m/s m/s m/s rad/s rad/s rad/s");
    let arm = ArmState::default();
    assert_eq!(units::<ArmKernel>(arm.q(), arm.z()), "s 1 1 1 1 m m m ? ? ? ? ? ? ? ?");
    let plane = PlanarState::default();
    assert_eq!(units::<PlanarKernel>(plane.q(), plane.z()), "s 1 1 m m m/s m/s rad/s");
    let jet = JetState::default();
    assert_eq!(units::<JetKernel>(jet.q(), jet.z()), "s ? ? ? ? ? ? ? ? ? ? ? ?");
}

/// Constraints that are solved leave single components of a vector of speeds.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(pose: Pose), speeds(u: Vector3, w: Vector3), kinematics(pose = twist(u, w)),
    body(pose = pose), constraint(velocity = u), constraint(velocity = w.z - 2 * w.x), independent(w.x, w.y),
)]
struct Solved {
    #[gauss(mass)]
    m: f64,
    #[gauss(inertia)]
    i: Vector3<f64>,
}

#[test]
fn components_stay_independent() {
    let state = SolvedState { pose: pose(), w_x: 0.3, w_y: 0.5 };
    let kernel = Solved { m: 1.0, i: Vector3::new(1.0, 1.5, 2.0) }.kernel().expect("a body");
    let twist = kernel.kinematics(0.0, &state.q(), &state.z());
    assert_eq!(twist, SVector::from([0.0, 0.0, 0.0, 0.3, 0.5, 0.6]));
}

/// Tables call every number by name, in the order in which configurations have them.
#[test]
fn columns_of_tables_have_names() {
    assert_eq!(
        MixedKernel::<f64>::COORDINATE_NAMES.join(" "),
        "craft_i craft_j craft_k craft_w craft_x craft_y craft_z attitude_i attitude_j attitude_k attitude_w before between after"
    );
    assert_eq!(
        MixedKernel::<f64>::SPEED_NAMES.join(" "),
        "first u_x u_y u_z w_x w_y w_z second omega_x omega_y omega_z third"
    );
    assert_eq!(SolvedKernel::SPEED_NAMES, ["w_x", "w_y"]);
    let kernel = Mixed { m: 1.0 }.kernel().expect("two bodies and a particle");
    let state = MixedState { before: 0.1, after: 0.3, craft: pose(), third: -3.0, ..MixedState::default() };
    let run = Simulation::new(&kernel).fixed_step(0.125).run(state.q(), state.z(), 0.0..0.125).expect("one step");
    let table = run.table().state();
    assert_eq!(
        table.names().len(),
        1 + MixedKernel::<f64>::COORDINATE_NAMES.len() + MixedKernel::<f64>::SPEED_NAMES.len()
    );
    let first = |name: &str| table.get(name).map(|column| column[0]);
    let turn = state.craft.rotation;
    // Units of groups are known, those of coordinates and speeds of one's own are not.
    let units = |table: &Table<_>| table.iter().map(|column| column.unit.unwrap_or("?")).collect::<Vec<_>>().join(" ");
    assert_eq!(units(&table.clone().si()), "s 1 1 1 1 m m m 1 1 1 1 ? ? ? ? ? ? ? ? ? ? ? ? ? ? ?");
    for (name, value) in
        [("before", 0.1), ("after", 0.3), ("craft_z", 3.0), ("craft_i", turn.i), ("craft_w", turn.w), ("third", -3.0)]
    {
        assert_eq!(first(name), Some(value), "{name}");
    }
}

/// Velocities of points, poses and rotations, and of what is placed by a pose, are the same numbers.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(craft: Pose), body(hull, pose = craft, mass = 1, inertia = [1, 2, 2.5]), point(tip, body = hull, at = [1, 2, 3]),
    force(of_body, body = hull, value = c * hull.velocity + hull.angular_velocity + hull.body_velocity + hull.body_angular_velocity,
        axes = observer),
    force(of_pose, body = hull,
        value = craft.velocity + craft.angular_velocity + craft.body_velocity + craft.body_angular_velocity, axes = observer),
    force(of_point, at = tip, value = tip.velocity), force(of_rate, at = tip, value = rate(tip)),
)]
struct Velocities {
    c: f64,
}

#[test]
fn what_moves_has_velocities() {
    let kernel = Velocities { c: 1.0 }.kernel().expect("a body");
    let craft_u = Vector3::new(0.3, -0.2, 0.5);
    let state = VelocitiesState { craft: pose(), craft_u, craft_omega: Vector3::new(-0.4, 0.7, 0.1) };
    let force = |name: &str| kernel.generalised_force(name, 0.0, &state.q(), &state.z(), &()).expect("an element");
    assert!((force("of_body") - force("of_pose")).norm() < 1e-15);
    assert!((force("of_point") - force("of_rate")).norm() < 1e-15 && force("of_point").norm() > 0.1);
}
