//! Gaps without friction: impacts, bounces that pile up, leaving, redundant contacts.

use crate::common::{Layout, Scene, V};
use gauss_contact::{ContactRun, EventKind, Impact, Mode};
use gauss_runtime::contact::Contact;
use gauss_runtime::integrate::{Adaptive, DormandPrince5, RungeKutta};
use gauss_runtime::nalgebra::SMatrix;
use gauss_runtime::system::GaussSystem;

const G: f64 = 9.81;

struct Floor;
impl Layout for Floor {
    const CONTACTS: &'static [Contact] = &[Contact::new("floor", 0, 0)];
}

fn ball(e: f64) -> Scene<Floor, 1, 1, 1> {
    Scene::linear(V::from([2.0]), V::from([-2.0 * G]), V::zeros(), SMatrix::identity()).restitution([e])
}

#[test]
fn a_ball_bounces_to_rest_at_the_time_of_the_geometric_series() {
    let kernel = ball(0.9);
    let run = ContactRun::new(&kernel).adaptive(1e-10, 1e-10).run([1.0].into(), [0.0].into(), 0.0..10.0).expect("runs");
    let rest = run.events().last().expect("rests");
    let EventKind::Rests { speed, remaining, .. } = rest.kind else { panic!("{rest:?}") };
    let impacts = run.events().iter().filter(|event| matches!(event.kind, EventKind::Impact(_))).count();
    // The last one has a speed of at most the tolerance, 1e-10 (1 + 4.43).
    let wanted = ((5.43e-10_f64 / (2.0 * G).sqrt()).ln() / 0.9_f64.ln()).ceil();
    assert_eq!(impacts as f64, wanted);
    assert!(speed <= 5.43e-10);
    // √(2h/g)(1 + e)/(1 − e). Each of 220 flights is found to 4 roundings of a time of 8.6, and its speed, that of the
    // impact, is off by g times that; what it shifts the later ones by falls with 1/(1 − e).
    let end = 8.578_949_178_728_9;
    assert!(
        (rest.time + remaining - end).abs() < 220.0 * 20.0 * 4.0 * f64::EPSILON * 8.6,
        "{}",
        rest.time + remaining - end
    );
    assert!(rest.time <= end && end - rest.time <= 1.01 * remaining);
    // Then it rests: to the last bit, since the gap is the coordinate.
    let last = run.last().expect("a sample");
    assert_eq!((last.t, last.q[0], last.z[0]), (10.0, 0.0, 0.0));
    assert_eq!(run.modes(9.0).expect("inside"), [Mode::Closed]);
    assert!((run.forces(9.0).expect("inside")[0] - 2.0 * G).abs() < 8.0 * f64::EPSILON * 2.0 * G);
    assert_eq!(run.forces(1.0).expect("inside")[0], 0.0);
    assert!(run.iter().all(|state| state.q[0] > -1e-13));
    assert!(run.solves().iter().flat_map(|solve| &solve.residuals).all(|(_, r)| r.signorini <= r.rounding));
}

#[test]
fn without_loss_a_ball_bounces_as_high_as_ever() {
    let kernel = ball(1.0);
    let run = ContactRun::new(&kernel).adaptive(1e-10, 1e-10).run([5.0].into(), [0.0].into(), 0.0..20.0).expect("runs");
    let fall = (10.0 / G).sqrt();
    let impacts: Vec<f64> = run.events().iter().map(|event| event.time).collect();
    assert_eq!(impacts.len(), ((20.0 / fall + 1.0) / 2.0) as usize);
    let last = run.last().expect("a sample");
    let (start, end) = (kernel.energy(0.0, &[5.0].into(), &[0.0].into()), kernel.energy(20.0, &last.q, &last.z));
    // Steps of a parabola are exact to some roundings; there are no more than 30 between two impacts.
    let bound = f64::EPSILON * 30.0 * impacts.len() as f64;
    assert!((end / start - 1.0).abs() < bound, "{:e}", end / start - 1.0);
}

struct Line;
impl Layout for Line {
    const CONTACTS: &'static [Contact] = &[Contact::new("first", 0, 0), Contact::new("second", 1, 0)];
}

#[test]
fn newtons_cradle_has_the_answer_of_its_law() {
    let rows = SMatrix::<f64, 2, 3>::from_row_slice(&[-1.0, 1.0, 0.0, 0.0, -1.0, 1.0]);
    let kernel: Scene<Line, 3, 2, 2> =
        Scene::linear(V::repeat(1.0), V::zeros(), V::zeros(), rows).restitution([1.0; 2]);
    let third = 1.0 / 3.0;
    for (law, wanted) in [
        (Impact::Newton, [-third, 2.0 * third, 2.0 * third]),
        (Impact::Moreau, [-third, 2.0 * third, 2.0 * third]),
        (Impact::Poisson, [-third, 2.0 * third, 2.0 * third]),
        (Impact::Sequential, [0.0, 0.0, 1.0]),
    ] {
        let run = ContactRun::new(&kernel).adaptive(1e-10, 1e-10).law(law);
        let run = run.run([-1.0, 0.0, 0.0].into(), [1.0, 0.0, 0.0].into(), 0.0..2.0).expect("runs");
        let end = run.last().expect("a sample");
        // Some roundings each of a step to the impact, of the impact and of a step from it.
        assert!((end.z - V::<3>::from(wanted)).amax() < 32.0 * f64::EPSILON, "{law:?} {}", end.z);
        let lost: f64 = run
            .events()
            .iter()
            .map(|event| if let EventKind::Impact(hit) = event.kind { hit.energy_lost } else { 0.0 })
            .sum();
        assert!(lost.abs() < 32.0 * f64::EPSILON, "{lost:e}");
        assert_eq!(run.events()[0].name, "first");
    }
}

struct Legs;
impl Layout for Legs {
    const CONTACTS: &'static [Contact] =
        &[Contact::new("a", 0, 0), Contact::new("b", 1, 0), Contact::new("c", 2, 0), Contact::new("d", 3, 0)];
}

#[test]
fn a_table_on_four_legs_stands_also_if_one_is_short() {
    let rows = SMatrix::<f64, 4, 3>::from_row_slice(&[1., 1., 1., 1., 1., -1., 1., -1., 1., 1., -1., -1.]);
    for short in [0.0, 1e-9] {
        let offset = V::from([0.0, 0.0, 0.0, short]);
        let kernel: Scene<Legs, 3, 4, 4> = Scene::linear(V::repeat(1.0), V::from([-G, 0.0, 0.0]), offset, rows);
        let run =
            ContactRun::new(&kernel).adaptive(1e-10, 1e-10).run(V::zeros(), V::zeros(), 0.0..1.0).expect("stands");
        let end = run.last().expect("a sample");
        assert!(end.q.amax() <= short && end.z.amax() == 0.0, "{} {}", end.q, end.z);
        let forces = *run.forces(0.5).expect("inside");
        // On all legs alike; with a short one on the two of the diagonal, on which the weight is.
        let wanted = if short == 0.0 { [0.25 * G; 4] } else { [0.0, 0.5 * G, 0.5 * G, 0.0] };
        assert!((forces - V::<4>::from(wanted)).amax() < 64.0 * f64::EPSILON * G, "{forces}");
    }
}

#[test]
fn a_ball_is_thrown_off_where_its_force_vanishes() {
    // Weight that turns with time: −cos t presses until π/2, then lifts.
    let kernel = ball(0.5).force(|t, _, _| V::from([-2.0 * t.cos()]));
    let run = ContactRun::new(&kernel).adaptive(1e-12, 1e-12).run([0.0].into(), [0.0].into(), 0.0..3.0).expect("runs");
    let [leaves] = run.events() else { panic!("{:?}", run.events()) };
    assert_eq!(leaves.kind, EventKind::Leaves);
    let quarter = std::f64::consts::FRAC_PI_2;
    // The force has a level of some hundred roundings, at a slope of 1.
    assert!((leaves.time - quarter).abs() < 1e-12);
    let end = run.last().expect("a sample");
    // z = −sin t + 1, q = cos t + t − π/2 from there on.
    assert!((end.z[0] - (1.0 - 3.0_f64.sin())).abs() < 1e-10);
    assert!((end.q[0] - (3.0_f64.cos() + 3.0 - quarter)).abs() < 1e-10);
}

struct Balls;
impl Layout for Balls {
    const CONTACTS: &'static [Contact] = &{
        const NAMES: [&str; 49] = {
            let mut names = ["ball"; 49];
            // Names differ in their length alone: their places tell them apart here.
            names[0] = "first ball";
            names
        };
        let mut all = [Contact::new("", 0, 0); 49];
        let mut n = 0;
        while n < 49 {
            all[n] = Contact::new(NAMES[n], n, 0);
            n += 1;
        }
        all
    };
}

#[test]
fn forty_nine_balls_keep_their_energy() {
    // 10 kg from 5 m and somewhat more, each by itself; the first ten at one height strike at once.
    let rows = SMatrix::<f64, 49, 49>::identity();
    let mass = V::<49>::repeat(10.0);
    let kernel: Scene<Balls, 49, 49, 49> = Scene::linear(mass, mass * -G, V::zeros(), rows).restitution([1.0; 49]);
    let kernel = Scene { gaps: Box::new(|q| *q), ..kernel };
    let start = V::<49>::from_fn(|i, _| 5.0 + 0.01 * (i as f64 - 9.0).max(0.0));
    let run = ContactRun::new(&kernel).adaptive(1e-6, 1e-6).run(start, V::zeros(), 0.0..20.0).expect("runs");
    let last = run.last().expect("a sample");
    let (first, end) = (kernel.energy(0.0, &start, &V::zeros()), kernel.energy(20.0, &last.q, &last.z));
    let bounces = |height: f64| ((20.0 / (2.0 * height / G).sqrt() + 1.0) / 2.0).floor();
    let impacts = run.events().len();
    assert_eq!(impacts as f64, start.iter().map(|height| bounces(*height)).sum::<f64>());
    // Every segment has a few steps of a parabola, exact to some roundings of each term.
    assert!((end / first - 1.0).abs() < 4.0 * f64::EPSILON * run.iter().count() as f64, "{:e}", end / first - 1.0);
}

#[test]
fn other_methods_drive_the_same_run() {
    let kernel = ball(0.5);
    let fall = (2.0 / G).sqrt();
    let run = ContactRun::new(&kernel).control(Adaptive::by(RungeKutta(DormandPrince5), 1e-10, 1e-10));
    let run = run.tolerance(1e-6, 1e-6).run([1.0].into(), [0.0].into(), 0.0..2.0).expect("runs");
    let rest = run.events().last().expect("rests");
    let EventKind::Rests { remaining, speed, .. } = rest.kind else { panic!("{rest:?}") };
    assert!(speed <= 5.5e-6 && speed > 2.7e-6 && run.events().len() < 24);
    assert!((rest.time + remaining - 3.0 * fall).abs() < 1e-12);
}
