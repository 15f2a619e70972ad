//! Contacts, ranges with dry friction, and slots: runs by events and in steps as tables, plots, pages, studies, states
//! between samples, on threads, balances of energy, derivatives by a parameter.

use gauss_contact::{ContactEnsemble, ContactRecord, ContactRun, ContactStepper, Slot, Slots, WithContacts};
use gauss_playback::{Playback, Shape};
use gauss_runtime::contact::ContactSystem;
use gauss_runtime::description::DescribedSystem;
use gauss_runtime::dual::Dual;
use gauss_runtime::prelude::*;
use gauss_sensitivity::{At, Cost, Derivatives, Run, SensitivityError};
use gauss_study::{Declaration, uniform};
use gauss_tables::Tabulate;

const END: f64 = 1.0;
/// The step of runs in steps.
const H: f64 = 1e-3;

/// A rod that swings between two stops and rubs in its hinge.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(angle),
    body(rod, rotation = rotation_y(angle), mass = 2, center_of_mass = [0, 0, -0.5], inertia = [0.6, 0.6, 0.01]),
    range(angle, from = -0.4, to = 0.9, restitution = 0.5), dry_friction(hinge, slip = rate(angle), bound = f),
    gravity = 9.81,
)]
struct Rod<T> {
    f: T,
}

/// A block that is thrown onto a floor, and slides.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, z), particle(mass = 2, position = [x, 0, z]),
    contact(floor, point = [x, 0, z], friction = mu, restitution = 0.5), gravity = 9.81,
)]
struct Block {
    mu: f64,
}

/// A ball in space, whose contacts are slots.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(pose: Pose),
    body(ball, position = pose.position, rotation = pose.rotation, mass = 2, inertia = 0.03),
    frames(ball), gravity = 9.81,
)]
struct Ball {}

type Start<K> = (<K as GaussSystem>::Configuration, <K as GaussSystem>::Speeds);

fn rod<T: Real>(f: T) -> (RodKernel<T>, Start<RodKernel<T>>) {
    let number = T::from_f64;
    let kernel = Rod { f }.kernel().unwrap();
    (kernel, (SVector::from([number(-0.35)]), SVector::from([number(4.0)])))
}

fn block(mu: f64) -> (BlockKernel, Start<BlockKernel>) {
    (Block { mu }.kernel().unwrap(), (SVector::from([0.0, 0.5]), SVector::from([2.0, 0.0])))
}

type OneSlot<'k> = Slots<'k, BallKernel, 1, 3, 6>;

/// A slot for a sphere of 0.2 over a floor.
fn ball(kernel: &BallKernel, restitution: f64) -> (OneSlot<'_>, Start<BallKernel>) {
    let mut slots = Slots::new(kernel);
    let floor = Slot {
        first: Some(BallFrame::ball),
        point: Vector3::zeros(),
        radius: 0.2,
        second: None,
        origin: Vector3::zeros(),
        normal: Vector3::z(),
        friction: 0.4,
        restitution,
    };
    slots.set(0, floor).unwrap();
    (slots, (Isometry3::translation(0.0, 0.0, 0.7), SVector::from([2.0, 0.0, 0.0, 0.0, 0.0, 0.0])))
}

/// Both records of a scene without inputs.
macro_rules! records {
    ($kernel:expr, $start:expr => $events:ident, $steps:ident) => {
        let (q, z) = $start;
        let $events = Simulation::new($kernel).adaptive(1e-10, 1e-10).contact_events().run(q, z, 0.0..END).unwrap();
        let $steps = Simulation::new($kernel).contact_steps(H).run(q, z, 0.0..END).unwrap();
    };
}

/// A row for each time with the numbers of the state and the contacts, and a picture with a line for each.
fn table_and_plot<'k, K>(kernel: &K, run: &impl ContactRecord<'k, K>)
where
    K: ContactSystem<Scalar = f64> + DescribedSystem + 'k,
{
    let table = run.table_at((0..=20).map(|n| 0.05 * f64::from(n)));
    let table = table.unwrap_or_else(|_| panic!("states")).state().energies(kernel);
    let table = table.contacts(kernel, |s| Some(*run.forces(s.t).ok()?));
    assert_eq!(table.len(), 21);
    let last = run.state_at(END).unwrap_or_else(|_| panic!("a state"));
    let speed = table.get(K::SPEED_NAMES[0]).expect("a speed");
    assert_eq!(speed.last(), Some(&last.z.component(0)));
    let contact = kernel.contacts()[0];
    let gap = table.get(&format!("{} gap", contact.name)).expect("a gap");
    assert_eq!(gap.last(), Some(&kernel.gaps(END, &last.q).component(0)));
    // Forces of before the first step are not known to a run in steps.
    let force = table.get(&format!("{} force", contact.name)).expect("a force");
    assert!(force[1..].iter().all(|force| *force >= -1e-9), "{force:?}");
    let picture = table.svg().unwrap();
    assert!(picture.contains("<svg") && !picture.contains("NaN"));
    for name in K::COORDINATE_NAMES.iter().chain(K::SPEED_NAMES) {
        assert!(picture.contains(name), "{name}");
    }
    assert!(picture.contains(contact.name));
}

/// A page with a body that moves, the energy, and what contacts do.
fn page<'k, K: ContactSystem<Scalar = f64> + 'k>(kernel: &K, run: &impl ContactRecord<'k, K>) {
    let pose = |sample: &Sample<K>| Isometry3::translation(sample.q.components().component(0), 0.0, 0.0);
    let playback = Playback::new("A scene", run).unwrap().body("mass", pose, [Shape::ball(0.1)]).energy(kernel);
    let html = playback.contacts(kernel, 0.1, run).html().unwrap();
    for part in ["mass", "energy"] {
        assert!(html.contains(part), "{part}");
    }
}

/// Between samples states go on from those beside them, to what speeds can have moved them.
fn between<'k, K: ContactSystem<Scalar = f64> + 'k>(run: &impl ContactRecord<'k, K>) {
    let moved = |a: &Sample<K>, b: &Sample<K>| {
        let by = a.q.difference(&b.q);
        (0..<<K::Configuration as Configuration>::Tangent as VectorSpace<f64>>::DIM)
            .map(|i| by.component(i).abs())
            .fold(0.0, f64::max)
    };
    let states = run.states();
    for pair in states.windows(2).filter(|pair| pair[1].t > pair[0].t) {
        let t = 0.5 * (pair[0].t + pair[1].t);
        let at = run.state_at(t).unwrap_or_else(|_| panic!("a state"));
        // Less than 10 m/s or rad/s.
        assert!(at.t == t && moved(&pair[0], &at) <= 10.0 * (t - pair[0].t) + 1e-9, "{t}");
    }
}

/// Rows of a study are those of runs that are made alone.
fn study(of: impl Fn(f64) -> f64 + Sync) {
    let mut declaration = Declaration::new("numbers", 7, 4);
    let drawn = declaration.parameter("number", "", uniform(0.2, 0.6));
    let place = declaration.number("place", "");
    let study = declaration.study(|sample, row| {
        row.set(place, of(sample[drawn]));
        Ok::<(), IntegrationError>(())
    });
    let study = study.unwrap();
    let mut places = Vec::new();
    for run in 0..4 {
        let (draw, row) = study.one(run);
        let expected = of(draw.values()[0]);
        assert_eq!((row.cause(), row.get(place)), (None, Some(&gauss_study::Value::Number(expected))));
        places.push(expected);
    }
    assert!(places.windows(2).all(|pair| pair[0] != pair[1]), "{places:?}");
}

fn end_of_rod<T: Real>(f: T) -> T {
    let (kernel, (q, z)) = rod(f);
    let run = ContactRun::new(&kernel).adaptive(1e-11, 1e-11).run(q, z, T::zero()..T::from_f64(END)).unwrap();
    run.last().expect("an end").q[0]
}

fn end_of_block(mu: f64) -> f64 {
    let (kernel, (q, z)) = block(mu);
    ContactRun::new(&kernel).adaptive(1e-10, 1e-10).run(q, z, 0.0..END).unwrap().last().expect("an end").q[0]
}

fn end_of_ball(restitution: f64) -> f64 {
    let kernel = Ball {}.kernel().unwrap();
    let (slots, (q, z)) = ball(&kernel, restitution);
    let run = ContactRun::new(&slots).adaptive(1e-10, 1e-10).run(q, z, 0.0..END).unwrap();
    run.last().expect("an end").q.translation.vector.x
}

#[test]
fn ranges_in_tables_and_plots() {
    let (kernel, start) = rod(0.3);
    records!(&kernel, start => events, steps);
    table_and_plot(&kernel, &events);
    table_and_plot(&kernel, &steps);
}

#[test]
fn ranges_in_pages() {
    let (kernel, start) = rod(0.3);
    records!(&kernel, start => events, steps);
    page(&kernel, &events);
    page(&kernel, &steps);
}

#[test]
fn ranges_in_rows_of_studies() {
    study(end_of_rod);
}

/// Stops and the hinge take what is lost.
#[test]
fn energy_between_stops_is_accounted_for() {
    let (kernel, (q, z)) = rod(0.3);
    let run = ContactRun::new(&kernel).adaptive(1e-11, 1e-11).run(q, z, 0.0..END).unwrap();
    let balance = run.energy_balance().unwrap();
    assert!(balance.impacts > 1.0 && balance.contacts < -0.1 && balance.supplied == 0.0, "{balance}");
    // Each step is off by 1e-11 of its speeds, and so twice that of the energy, some 15 J.
    assert!(balance.residual().abs() < 2e-11 * 15.0 * run.iter().count() as f64, "{balance}");
}

/// The place at the end has the derivative by the friction of differences, through stops.
#[test]
fn places_between_stops_have_derivatives() {
    let found = end_of_rod(Dual::<1>::variable(0.3, 0));
    let step = 1e-4;
    let differences = (end_of_rod(0.3 + step) - end_of_rod(0.3 - step)) / (2.0 * step);
    assert!((found.value - end_of_rod(0.3)).abs() < 1e-9);
    // Of h² and a third derivative of some tens, and errors of runs over the step.
    assert!((found.slopes[0] - differences).abs() < 1e-6 && differences.abs() > 1e-3, "{found:?} {differences}");
}

#[test]
fn ranges_on_threads_have_the_bits_of_one() {
    let kernel = rod(0.3).0;
    let wide = Rod { f: wide::f64x4::from_f64(0.3) }.kernel().unwrap();
    let starts = |n: usize| (SVector::from([-0.35 + 0.1 * n as f64]), SVector::from([3.0 - 0.7 * n as f64]));
    let steppers = || (0..9).map(|n| ContactStepper::new(&kernel, 0.0, starts(n).0, starts(n).1).unwrap());
    let mut singles: Vec<_> = steppers().collect();
    for single in &mut singles {
        (0..600).for_each(|_| assert!(single.step(H, &()).is_ok()));
    }
    let mut ensemble = ContactEnsemble::new(&wide, steppers().collect()).unwrap();
    ensemble.advance_on_all_threads(H, 600, |_, _| ());
    assert_eq!(ensemble.failures().count(), 0);
    for (single, own) in singles.iter().zip(ensemble.steppers()) {
        assert_eq!((single.configuration(), single.speeds()), (own.configuration(), own.speeds()));
    }
}

#[test]
fn contacts_in_tables_and_plots() {
    let (kernel, start) = block(0.3);
    records!(&kernel, start => events, steps);
    table_and_plot(&kernel, &events);
    table_and_plot(&kernel, &steps);
}

#[test]
fn contacts_in_rows_of_studies() {
    study(end_of_block);
}

#[test]
fn slots_in_tables_and_plots() {
    let kernel = Ball {}.kernel().unwrap();
    let (slots, start) = ball(&kernel, 0.5);
    records!(&slots, start => events, steps);
    table_and_plot(&slots, &events);
    table_and_plot(&slots, &steps);
}

#[test]
fn slots_in_pages() {
    let kernel = Ball {}.kernel().unwrap();
    let (slots, start) = ball(&kernel, 0.5);
    records!(&slots, start => events, steps);
    page(&slots, &events);
    page(&slots, &steps);
}

#[test]
fn states_of_slots_between_samples() {
    let kernel = Ball {}.kernel().unwrap();
    let (slots, start) = ball(&kernel, 0.5);
    records!(&slots, start => events, steps);
    between(&events);
    between(&steps);
}

#[test]
fn slots_in_rows_of_studies() {
    study(end_of_ball);
}

/// A ball in any scalar.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(pose: Pose),
    body(ball, position = pose.position, rotation = pose.rotation, mass = m, inertia = 0.03),
    frames(ball), gravity = 9.81,
)]
struct AnyBall<T> {
    m: T,
}

/// A run over a floor that is a slot, differentiated by a mass; kernels live on, since slots refer to them.
struct OverSlots;

impl Run<1> for OverSlots {
    type System<T: Real> = Slots<'static, AnyBallKernel<T>, 1, 3, 6>;

    fn instants(&self) -> &[f64] {
        &[0.0, 1.0]
    }

    fn system<T: Real>(&self, &[m]: &[T; 1]) -> Result<Self::System<T>, ParameterError> {
        let mut slots = Slots::new(&*Box::leak(Box::new(AnyBall { m }.kernel()?)));
        let [zero, one] = [T::zero(), T::one()];
        let (origin, normal) = ([zero; 3].into(), [zero, zero, one].into());
        let (first, radius) = (Some(AnyBallFrame::ball), T::from_f64(0.2));
        let floor =
            Slot { first, point: origin, radius, second: None, origin, normal, friction: one, restitution: zero };
        slots.set(0, floor).expect("a floor");
        Ok(slots)
    }

    fn start<T: Real>(&self, _: &[T; 1], _: &Self::System<T>) -> gauss_sensitivity::Start<Self::System<T>> {
        let [zero, one] = [T::zero(), T::one()];
        (Isometry3::from_components(&SVector::from([zero, zero, zero, one, zero, zero, one])), SVector::zero())
    }
}

impl Cost<1> for OverSlots {
    fn cost<T: Real>(&self, _: &[T; 1], at: &At<'_, Self::System<T>>) -> T {
        at.q.translation.vector[2]
    }
}

/// Forward and backward: a run without their forces would go through the floor.
#[test]
fn whole_runs_of_slots_are_not_differentiated_without_their_forces() {
    let derivatives = Derivatives::adaptive(1e-9, 1e-9);
    let found = [derivatives.run(&OverSlots, &[2.0]).err(), derivatives.gradient(&OverSlots, &[2.0]).err()];
    for error in found {
        assert!(matches!(&error, Some(SensitivityError::Run(error)) if error.kind == IntegrationErrorKind::Contacts));
    }
}
