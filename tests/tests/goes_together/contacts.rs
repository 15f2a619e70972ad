//! What scenes hold beside contacts: from event to event and in steps, against the motion without contacts up to the
//! first impact, the law of impact there, and one another.

use gauss_contact::{ContactRun, ContactSteps, EventKind};
use gauss_runtime::configuration::Configuration;
use gauss_runtime::contact::ContactSystem;
use gauss_runtime::prelude::*;

use crate::scenes::{DRAG, PULL, V, X, recorded};

/// The restitution of all contacts.
const E: f64 = 0.5;

/// A bob on two rods at the same place, over a floor.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y), particle(mass = 2, position = [x, 0, y]),
    constraint(position = x * x + y * y - l * l), constraint(position = 3 * (x * x + y * y - l * l)), redundant,
    contact(floor, gap = y + 0.6, restitution = 0.5),
)]
struct OverAFloor {
    l: f64,
    #[gauss(gravity)]
    g: f64,
}

/// A beam on a hinge that turns to a stop.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(angle, s),
    body(beam, rotation = rotation_z(angle), mass = 2, center_of_mass = [0.5, 0, 0], inertia = [0, 2 / 3, 2 / 3]),
    modes(beam, coordinates = [s], translation = [[1.25, 0, 0]], mass = [34 / 35], stiffness = [300],
        inertia = [[0, 1.6, 1.6, 0, 0, 0]]),
    contact(stop, gap = 1 - angle, restitution = 0.5),
)]
struct ToAStop {}

/// A mass on a spring by a table of one number, before a wall.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x), particle(mass = 1.5, position = [x, 0, 0]),
    table(pull, points = PULL, kind = cubic), drive(x = -3 * pull(x)), contact(wall, gap = x + 0.2, restitution = 0.5),
)]
struct ByPointsToAWall {}

/// By a table of two numbers.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x), particle(mass = 1.5, position = [x, 0, 0]),
    table(drag, axes = [X, V], values = DRAG, kind = hermite), drive(x = drag(x, rate(x))),
    contact(wall, gap = x + 0.2, restitution = 0.5),
)]
struct ByCornersToAWall {}

/// On a spring, pushed by a recording.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x), input(push), particle(mass = 1.5, position = [x, 0, 0]), spring(along = x, stiffness = 20),
    drive(x = push), contact(wall, gap = x + 0.2, restitution = 0.5),
)]
struct PushedToAWall {}

/// A hull whose fuel leaves by a nozzle, before a wall.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, angle),
    body(hull, position = [x, 0, 0], rotation = rotation_z(angle), mass = 2 - 0.5 * t, inertia = [1, 1, 1 - 0.3 * t]),
    mass_flow(jet, body = hull, at = [-0.4, 0.1, 0], velocity = [-1, 0, 0]), spring(along = x, stiffness = 4),
    contact(wall, gap = x + 0.2, restitution = 0.5),
)]
struct BurningToAWall {}

type Start<K> = (<K as GaussSystem>::Configuration, <K as GaussSystem>::Speeds);

fn apart<K: GaussSystem<Scalar = f64>>(a: &Start<K>, b: &Start<K>) -> f64 {
    let (moved, faster) = (a.0.difference(&b.0), b.1.add_scaled(-1.0, &a.1));
    let of_q = (0..<<K::Configuration as Configuration>::Tangent as VectorSpace<f64>>::DIM).map(|i| moved.component(i));
    of_q.chain((0..K::Speeds::DIM).map(|i| faster.component(i))).fold(0.0, |most: f64, x| most.max(x.abs()))
}

fn check<K: ContactSystem<Scalar = f64>>(
    kernel: &K,
    (q, z): Start<K>,
    input: impl Fn(f64, &K::Configuration, &K::Speeds) -> K::Input + Copy,
) {
    let run = ContactRun::new(kernel).input(input).adaptive(1e-10, 1e-11).run(q, z, 0.0..1.0).unwrap();
    let time = run.events().iter().find(|event| matches!(event.kind, EventKind::Impact(_))).expect("an impact").time;
    let free = Simulation::new(kernel).without_contacts().input(input).adaptive(1e-12, 1e-13);
    let before = free.run_to_end(q, z, 0.0..time).unwrap();
    let after = run.at(time).unwrap();
    let places = apart::<K>(&(before.q, after.z), &(after.q, after.z));
    assert!(places < 1e-8, "places at the impact: {places:e}");
    let [came, went] =
        [(&before.q, &before.z), (&after.q, &after.z)].map(|(q, z)| kernel.contact_rates(time, q, z).component(0));
    assert!(came < -0.1 && (went + E * came).abs() < 1e-7, "from {came} to {went}");
    for sample in run.iter() {
        assert!(kernel.gaps(sample.t, &sample.q).component(0) > -1e-9, "{}", sample.t);
    }
    let last = run.last().unwrap();
    let off = |h: f64| {
        let steps = ContactSteps::new(kernel, h).input(input).run(q, z, 0.0..1.0).unwrap();
        let end = &steps.last().expect("a step").state;
        apart::<K>(&(end.q, end.z), &(last.q, last.z))
    };
    // An impact is off by a part of a step, in which accelerations of some ten act.
    for h in [1e-3, 1e-4] {
        assert!(off(h) < 30.0 * h, "{h}: {:e}", off(h));
    }
}

#[test]
fn redundant() {
    let (sine, cosine) = std::f64::consts::FRAC_PI_4.sin_cos();
    let kernel = OverAFloor { l: 0.7, g: 9.81 }.kernel().unwrap();
    check(&kernel, (SVector::from([0.7 * sine, -0.7 * cosine]), SVector::zeros()), |_, _, _| ());
}

#[test]
fn modes() {
    check(&ToAStop {}.kernel().unwrap(), (SVector::from([0.0, 0.02]), SVector::from([2.0, 0.0])), |_, _, _| ());
}

#[test]
fn table_of_one() {
    check(&ByPointsToAWall {}.kernel().unwrap(), (SVector::from([0.8]), SVector::from([-1.0])), |_, _, _| ());
}

#[test]
fn table_of_two() {
    check(&ByCornersToAWall {}.kernel().unwrap(), (SVector::from([0.8]), SVector::from([-1.0])), |_, _, _| ());
}

#[test]
fn recorded_push() {
    let start = (SVector::from([0.3]), SVector::from([0.0]));
    check(&PushedToAWall {}.kernel().unwrap(), start, |t, _, _| SVector::from([recorded(t)]));
}

#[test]
fn mass() {
    let start = (SVector::from([0.3, 0.1]), SVector::from([-1.0, 0.5]));
    check(&BurningToAWall {}.kernel().unwrap(), start, |_, _, _| ());
}
