//! Structs as classes of Python: what the notebook and the tests use.

use gauss_runtime::prelude::*;

/// A pendulum with a motor in its hinge: a point on a rod.
#[derive(GaussDynamics)]
#[gauss(
    python,
    linearize(hessian, inverse, parameters),
    coordinates(angle),
    particle(mass = mass, position = [length * sin(angle), 0, -length * cos(angle)]),
    input(motor = "N m"),
    drive(angle = motor),
)]
pub struct Pendulum<T> {
    /// Of the point.
    #[gauss(unit = "kg")]
    mass: T,
    /// From the hinge to the point.
    #[gauss(unit = "m")]
    length: T,
    /// Acceleration of free fall.
    #[gauss(gravity)]
    g: T,
}

/// A torpedo as heavy as the water that it displaces; fins 0.8 m behind O hold its nose forward.
#[derive(GaussDynamics)]
#[gauss(
    python,
    taylor,
    linearize(parameters),
    chart = left_invariant,
    define(v = body.relative_velocity, w = body.body_angular_velocity),
    force(fins, at = [-0.8, 0, 0], value = [0, -lift * v.x * (v.y - 0.8 * w.z), -lift * v.x * (v.z + 0.8 * w.y)]),
)]
pub struct Torpedo<T> {
    /// Of the hull.
    #[gauss(mass)]
    mass: T,
    /// Centre of mass, from O.
    #[gauss(center_of_mass)]
    center: Vector3<T>,
    /// About O, principal moments.
    #[gauss(inertia)]
    inertia: Vector3<T>,
    /// Of the water, about O.
    #[gauss(added_mass)]
    added: Vector6<T>,
    /// Of the fins, in kg/m.
    lift: T,
}

/// An arm of two joints, read from its file.
#[derive(GaussDynamics)]
#[gauss(
    python,
    urdf = "arm.urdf",
    frames(tool),
    reactions(shoulder, elbow),
    methods(centroidal, gravity_torques, jacobian_rates)
)]
pub struct Arm<T> {
    /// Acceleration of free fall.
    #[gauss(gravity, unit = "m/s^2")]
    g: T,
}

/// A block that turns and slides on a wire around a circle: batches of a struct in `f64` go row by row.
#[derive(GaussDynamics)]
#[gauss(
    python,
    coordinates(x, y, turn: Rotation),
    body(block, position = [x, y, 0], rotation = turn),
    constraint(position = x * x + y * y - radius * radius),
)]
pub struct Wire {
    /// The block.
    #[gauss(body)]
    block: RigidBody<f64>,
    /// Of the circle.
    #[gauss(unit = "m")]
    radius: f64,
    /// Acceleration of free fall, in the observer's axes.
    #[gauss(gravity)]
    g: Vector3<f64>,
}

/// A capsule that comes down on its parachute, through a wind that freshens with height.
///
/// The canopy hangs at a fixed place above the capsule. Its drag grows with the square of its velocity against the air,
/// along that velocity; the air that it carries along is a point there, which weighs nothing. The wind grows with the
/// height h as h/√(h² + `layer`²): it is smooth at the ground, too, below which a step may try before it is cut at the
/// touchdown. Not modelled: the weight of the canopy, its lift, slack lines, gusts, the drag of the capsule.
#[derive(GaussDynamics)]
#[gauss(
    python,
    chart = hybrid,
    point(canopy, body = body, at = [0, 0, riser]),
    particle(mass = air, position = [0, 0, riser], parent = body),
    define(
        share = canopy.z / sqrt(canopy.z * canopy.z + layer * layer),
        v = canopy.velocity - share * [wind_x, wind_y, 0],
    ),
    force(parachute, at = canopy, value = -0.5 * density * drag_area * sqrt(dot(v, v)) * v, axes = observer),
    force(weight, at = [0, 0, 0], value = [0, 0, -mass * g], axes = observer),
)]
pub struct Lander<T> {
    /// Of the capsule.
    #[gauss(mass, unit = "kg")]
    mass: T,
    /// About its centre of mass, principal moments.
    #[gauss(inertia)]
    inertia: Vector3<T>,
    /// Of the canopy: coefficient of drag times area.
    #[gauss(unit = "m^2")]
    drag_area: T,
    /// Mass of what it carries along.
    #[gauss(unit = "kg")]
    air: T,
    /// From the centre of mass of the capsule up to the canopy.
    #[gauss(unit = "m")]
    riser: T,
    /// Of the air.
    #[gauss(unit = "kg/m^3")]
    density: T,
    /// High above the ground.
    #[gauss(unit = "m/s")]
    wind_x: T,
    /// High above the ground.
    #[gauss(unit = "m/s")]
    wind_y: T,
    /// Height in which the wind freshens.
    #[gauss(unit = "m")]
    layer: T,
    /// Acceleration of free fall.
    #[gauss(unit = "m/s^2")]
    g: T,
}

/// A puck on a floor: it bounces, slides and stays where it is.
#[derive(GaussDynamics)]
#[gauss(
    python,
    linearize(without_contacts),
    coordinates(x, z),
    particle(mass = mass, position = [x, 0, z]),
    frame(puck, position = [x, 0, z]),
    contact(floor, point = puck.position, friction = friction, restitution = restitution),
    input(push = "N"),
    drive(x = push),
)]
pub struct Puck<T> {
    /// Of the puck.
    #[gauss(unit = "kg")]
    mass: T,
    /// Between puck and floor.
    friction: T,
    /// Of an impact on the floor.
    restitution: T,
    /// Acceleration of free fall.
    #[gauss(gravity)]
    g: T,
}

/// A gate between two stops, whose hinge rubs.
#[derive(GaussDynamics)]
#[gauss(
    python,
    coordinates(angle),
    particle(mass = mass, position = [width * cos(angle), width * sin(angle), 0]),
    input(motor = "N m"),
    drive(angle = motor),
    range(angle, from = -most, to = most, restitution = restitution),
    dry_friction(hinge, slip = rate(angle), bound = rub),
)]
pub struct Gate {
    /// In the middle of the gate.
    #[gauss(unit = "kg")]
    mass: f64,
    /// From the hinge to that.
    #[gauss(unit = "m")]
    width: f64,
    /// To both sides.
    #[gauss(unit = "rad")]
    most: f64,
    /// At the stops.
    restitution: f64,
    /// The torque of the hinge at most.
    #[gauss(unit = "N m")]
    rub: f64,
}

/// What a motor gives at a speed, in m/s and N.
const POWER: [[f64; 2]; 3] = [[-10.0, 4.0], [0.0, 2.0], [10.0, 0.0]];

/// A cart whose motor comes to its thrust with a lag, and gives less the faster it goes.
#[derive(GaussDynamics)]
#[gauss(
    python,
    linearize,
    coordinates(x),
    particle(mass = mass, position = [x, 0, 0]),
    input(throttle),
    table(power, points = POWER),
    states(thrust = (throttle - thrust) / lag),
    drive(x = thrust * power(rate(x))),
)]
pub struct Cart<T> {
    /// Of the cart.
    #[gauss(unit = "kg")]
    mass: T,
    /// Until the motor follows.
    #[gauss(unit = "s")]
    lag: T,
}

/// A bead on a ring that two laws hold, of which one would do.
#[derive(GaussDynamics)]
#[gauss(
    python,
    redundant,
    coordinates(x, z),
    particle(mass = mass, position = [x, 0, z]),
    constraint(position = x * x + z * z - radius * radius),
    constraint(position = 3 * x * x + 3 * z * z - 3 * radius * radius),
)]
pub struct Bead {
    /// Of the bead.
    #[gauss(unit = "kg")]
    mass: f64,
    /// Of the ring.
    #[gauss(unit = "m")]
    radius: f64,
    /// Acceleration of free fall.
    #[gauss(gravity)]
    g: f64,
}

gauss_python::module!(
    scenes: Pendulum<f64>, Torpedo<f64>, Arm<f64>, Wire, Lander<f64>, Puck<f64>, Gate, Cart<f64>, Bead
);
