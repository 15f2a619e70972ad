//! Events of the user's own in runs with contacts, the most steps, derivatives of the times of events, and the modes at
//! a state.

use gauss_contact::{ContactErrorKind, ContactRun, InMode, Mode};
use gauss_runtime::dual::Dual;
use gauss_runtime::prelude::*;
use gauss_runtime::real::Real;

/// A ball above the ground.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, z),
    particle(mass = 1, position = [x, 0, z]),
    contact(ground, gap = z, slip = rate(x), friction = mu, restitution = e),
)]
struct Ball {
    mu: f64,
    e: f64,
    #[gauss(gravity)]
    g: f64,
}

/// A ball above a slope, whose gap is a sum.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, z),
    particle(mass = 1, position = [x, 0, z]),
    frame(ball, position = [x, 0, z]),
    contact(slope, point = ball.position, plane = [3, 0, 4], restitution = e),
)]
struct Slope<T> {
    e: T,
    #[gauss(gravity)]
    g: T,
}

type D = Dual<1>;

fn number(x: f64) -> D {
    D::from_f64(x)
}

const G: f64 = 9.81;

#[test]
fn derivatives_go_through_bounces_on_a_slope() {
    for (z, speed) in [(0.5, 4.0), (1.3, -2.0), (0.2, 0.0), (3.0, 1.0)] {
        for tolerance in [1e-5, 1e-6, 1e-8, 1e-9, 1e-10, 1e-12] {
            let run = |e: f64| {
                let kernel = Slope { e, g: G }.kernel().expect("a scene");
                let run = ContactRun::new(&kernel).adaptive(tolerance, tolerance);
                let run = run.run([0.0, z].into(), [speed, 0.0].into(), 0.0..8.0).expect("runs");
                let hits: Vec<f64> = run.events().iter().map(|event| event.time).collect();
                (hits, run.last().expect("a sample").q)
            };
            let kernel = Slope { e: Dual::<1>::variable(0.6, 0), g: number(G) }.kernel().expect("a scene");
            let made = ContactRun::new(&kernel).adaptive(tolerance, tolerance);
            let (q, z0) = ([number(0.0), number(z)].into(), [number(speed), number(0.0)].into());
            let name = format!("{z} {speed} {tolerance}");
            let made = made.run(q, z0, number(0.0)..number(8.0)).unwrap_or_else(|error| panic!("{name}: {error}"));
            let (below, above) = (run(0.6 - 1e-6), run(0.6 + 1e-6));
            // The times of the first bounces: along the normal a ball falls with 0.8 g from 0.8 z + ….
            for (n, event) in made.events().iter().take(4).enumerate() {
                let slope = (above.0[n] - below.0[n]) / 2e-6;
                let time = made.time_of(event);
                assert_eq!(time.value, event.time);
                assert!((time.slopes[0] - slope).abs() < 1e-4 * (1.0 + slope.abs()), "{name}: {time:?} {slope}");
            }
            let end = made.last().expect("a sample").q;
            assert!(end[0].is_finite() && end[1].is_finite());
        }
    }
}

#[test]
fn functions_of_the_user_are_found_between_impacts_and_at_them() {
    let kernel = Ball { mu: 0.0, e: 0.8, g: G }.kernel().expect("a scene");
    let run = ContactRun::new(&kernel)
        .event(Crossing::Falling, |_, _, z| z[1]) // the top of each flight
        .event(Crossing::Rising, |_, _, z| z[1]) // each impact turns the speed
        .event(Crossing::Any, |_, q, _| q[0] - 1.0)
        .adaptive(1e-10, 1e-10);
    let run = run.run([0.0, 1.0].into(), [0.9, 0.0].into(), 0.0..2.0).expect("runs");
    let fall = (2.0 / G).sqrt();
    let hits = [fall, fall * 2.6, fall * 3.88];
    let tops = [fall * 1.8, fall * (2.6 + 0.64), fall * (3.88 + 0.512)];
    let of = |number: usize| -> Vec<f64> {
        run.passages().iter().filter(|event| event.number == number).map(|event| event.sample.t).collect()
    };
    assert!(of(0).iter().zip(tops).all(|(a, b)| (a - b).abs() < 1e-9) && of(0).len() == 3, "{:?}", of(0));
    assert!(of(1).iter().zip(hits).all(|(a, b)| (a - b).abs() < 1e-9) && of(1).len() == 3, "{:?}", of(1));
    assert!(of(2).len() == 1 && (of(2)[0] - 1.0 / 0.9).abs() < 1e-12, "{:?}", of(2));
    assert_eq!(run.stopped_by(), None);
    let times: Vec<f64> = run.passages().iter().map(|event| event.sample.t).collect();
    assert!(times.is_sorted());

    // The gap itself, as a function of the user: once at each impact, not again as it is left.
    let run = ContactRun::new(&kernel).event(Crossing::Any, |_, q, _| q[1]).adaptive(1e-10, 1e-10);
    let run = run.run([0.0, 1.0].into(), [0.9, 0.0].into(), 0.0..2.0).expect("runs");
    assert_eq!(run.passages().len(), 3, "{:?}", run.passages());
}

#[test]
fn a_run_ends_where_the_user_says() {
    let kernel = Ball { mu: 0.3, e: 0.8, g: G }.kernel().expect("a scene");
    let start = || ([0.0, 1.0].into(), [0.9, 0.0].into(), 0.0..2.0);
    let run = ContactRun::new(&kernel).event(Crossing::Rising, |_, _, z| z[1]).adaptive(1e-10, 1e-10);
    // Between impacts.
    let higher = run.until(Crossing::Rising, |_, q, _| q[1] - 0.5);
    let (q, z, span) = start();
    let ended = higher.run(q, z, span).expect("runs");
    let last = ended.last().expect("a sample");
    assert_eq!(ended.stopped_by(), Some(1));
    let fall = (2.0 / G).sqrt();
    let up = 0.8 * (2.0 * G).sqrt();
    let wanted = fall + (up - (up * up - G).sqrt()) / G;
    assert!((last.t - wanted).abs() < 1e-9 && (last.q[1] - 0.5).abs() < 1e-12, "{last:?}");
    // At an impact: with the state after it.
    let turned = run.until(Crossing::Rising, |_, _, z| z[1] - 1.0);
    let (q, z, span) = start();
    let ended = turned.run(q, z, span).expect("runs");
    let last = ended.last().expect("a sample");
    assert!(ended.stopped_by() == Some(1) && (last.t - fall).abs() < 1e-12 && (last.z[1] - up).abs() < 1e-12);
    assert_eq!(ended.passages().len(), 2);
    // While it slides: after the bounces are over.
    let kernel = Ball { mu: 0.1, e: 0.0, g: G }.kernel().expect("a scene");
    let run = ContactRun::new(&kernel).until(Crossing::Falling, |_, _, z: &SVector<f64, 2>| z[0] - 0.4);
    let run = run.adaptive(1e-10, 1e-10).run([0.0, 0.0].into(), [0.9, 0.0].into(), 0.0..9.0).expect("slides");
    assert!((run.last().expect("a sample").t - 0.5 / (0.1 * G)).abs() < 1e-9 && run.stopped_by() == Some(0));
}

#[test]
fn no_more_steps_are_made_than_the_run_may() {
    let kernel = Ball { mu: 0.0, e: 0.9, g: G }.kernel().expect("a scene");
    let run = ContactRun::new(&kernel).adaptive(1e-10, 1e-10);
    let (made, error) = run.max_steps(40).attempt([0.0, 1.0].into(), [0.9, 0.0].into(), 0.0..8.0);
    let error = error.expect("gives up");
    assert_eq!(error.kind, ContactErrorKind::TooManySteps { limit: 40 });
    assert!(error.to_string().contains("max_steps"), "{error}");
    let steps = |made: &gauss_contact::ContactTrajectory<'_, BallKernel>| -> u64 {
        made.segments().iter().map(|segment| segment.trajectory().summary()).map(|s| s.steps + s.rejected).sum()
    };
    assert!(made.segments().len() > 2 && steps(&made) <= 40);
    let whole = run.run([0.0, 1.0].into(), [0.9, 0.0].into(), 0.0..8.0).expect("runs");
    let count = steps(&whole);
    assert!(run.max_steps(count).run([0.0, 1.0].into(), [0.9, 0.0].into(), 0.0..8.0).is_ok());
}

#[test]
fn accelerations_in_the_modes_at_a_state_have_contact_forces() {
    let kernel = Ball { mu: 0.4, e: 0.5, g: G }.kernel().expect("a scene");
    let (rest, along) = (SVector::from([0.0, 0.0]), SVector::from([1.5, 0.0]));
    assert_eq!(kernel.acceleration(0.0, &rest, &rest, &())[1], -G);
    let at = |q: &_, z: &_| InMode::at(&kernel, 0.0, q, z, &());
    let stands = at(&rest, &rest).expect("rests");
    assert_eq!(stands.modes(), [Mode::Sticks]);
    assert_eq!(stands.acceleration(0.0, &rest, &rest, &()).amax(), 0.0);
    let slides = at(&rest, &along).expect("slides").acceleration(0.0, &rest, &along, &());
    assert!((slides[0] + 0.4 * G).abs() < 1e-14 && slides[1].abs() < 1e-14);
    let above = SVector::from([0.0, 0.1]);
    assert_eq!(at(&above, &rest).expect("falls").modes(), [Mode::Open]);
    let Err(error) = at(&rest, &SVector::from([0.0, -2.0])) else { panic!("it strikes") };
    assert_eq!((error.contact, error.kind), (Some("ground"), ContactErrorKind::Strikes { rate: -2.0 }));
}
