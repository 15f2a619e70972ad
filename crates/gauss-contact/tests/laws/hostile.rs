//! What cannot be run ends with a reason.

use gauss_contact::{ContactErrorKind, ContactRun, EventKind};
use gauss_runtime::contact::Contact;
use gauss_runtime::nalgebra::SMatrix;

use crate::common::{Layout, Scene, V};

struct Ground;
impl Layout for Ground {
    const CONTACTS: &'static [Contact] = &[Contact::new("ground", 0, 1)];
}

fn block() -> Scene<Ground, 2, 1, 2> {
    let rows = SMatrix::<f64, 2, 2>::new(0.0, 1.0, 1.0, 0.0);
    Scene::linear(V::repeat(1.0), V::from([0.0, -10.0]), V::zeros(), rows)
}

fn refused(kernel: &Scene<Ground, 2, 1, 2>, q: [f64; 2], z: [f64; 2]) -> (Option<&'static str>, ContactErrorKind) {
    let run = ContactRun::new(kernel).adaptive(1e-9, 1e-9).run(q.into(), z.into(), 0.0..1.0);
    let error = run.err().expect("refused");
    assert!(!error.to_string().is_empty());
    (error.contact, error.kind)
}

#[test]
fn impossible_contacts_are_refused_by_name() {
    let (q, z) = ([0.0, 1.0], [0.0, 0.0]);
    let name = Some("ground");
    let kind = refused(&block(), [0.0, -1e-3], z);
    assert_eq!(kind, (name, ContactErrorKind::NegativeGap { gap: -1e-3 }));
    let kind = refused(&block().restitution([1.5]), q, z);
    assert_eq!(kind, (name, ContactErrorKind::InvalidRestitution { restitution: 1.5 }));
    assert!(matches!(refused(&block().restitution([f64::NAN]), q, z).1, ContactErrorKind::InvalidRestitution { .. }));
    let kind = refused(&block().friction([-0.1]), q, z);
    assert_eq!(kind, (name, ContactErrorKind::InvalidFriction { friction: -0.1 }));
    assert!(matches!(refused(&block().friction([f64::NAN]), q, z).1, ContactErrorKind::InvalidFriction { .. }));
    assert_eq!(refused(&block(), [f64::NAN, 1.0], z).1, ContactErrorKind::NonFinite);
    let nan = block().force(|_, _, _| V::repeat(f64::NAN));
    assert_eq!(refused(&nan, [0.0, 0.0], z).1, ContactErrorKind::NonFinite);
    assert!(matches!(refused(&nan, q, z).1, ContactErrorKind::Integration(_)));
    let run = ContactRun::new(&block()).adaptive(1e-9, 1e-9).run(q.into(), z.into(), 1.0..0.0).err();
    assert_eq!(run.expect("refused").kind, ContactErrorKind::InvalidInterval);
}

#[test]
fn a_start_on_the_gap_that_closes_is_an_impact_at_once() {
    let run = |e: f64| {
        let kernel = block().restitution([e]);
        let run = ContactRun::new(&kernel).adaptive(1e-9, 1e-9);
        let run = run.run([0.0, 0.0].into(), [0.0, -3.0].into(), 0.0..0.1).expect("runs");
        let first = run.events()[0];
        assert!(first.time == 0.0 && matches!(first.kind, EventKind::Impact(hit) if hit.impulse[0] == 3.0 * (1.0 + e)));
        run.last().expect("a sample").z[1]
    };
    assert_eq!(run(0.0), 0.0);
    // 1.5 up, less 10 · 0.1.
    assert!((run(0.5) - 0.5).abs() < 1e-14);
}

#[test]
fn a_gap_that_is_beyond_zero_by_rounding_is_zero() {
    let kernel = block();
    let run = ContactRun::new(&kernel).adaptive(1e-9, 1e-9);
    let run = run.run([0.0, -1e-15].into(), [0.0, 0.0].into(), 0.0..1.0).expect("rests");
    assert_eq!(run.last().expect("a sample").q[1], 0.0);
}

#[test]
fn a_part_that_was_made_is_kept_and_times_outside_are_refused() {
    let kernel = block().restitution([0.9]);
    let run = ContactRun::new(&kernel).adaptive(1e-9, 1e-9).max_events(3);
    let (made, error) = run.attempt([0.0, 1.0].into(), [0.0, 0.0].into(), 0.0..20.0);
    assert_eq!(error.expect("ends").kind, ContactErrorKind::TooManyEvents { limit: 3 });
    assert_eq!(made.segments().len(), 3);
    assert!(made.at(0.1).is_ok());
    assert_eq!(made.at(19.0).err().map(|error| error.kind), Some(ContactErrorKind::OutsideRun));
}

struct Walls;
impl Layout for Walls {
    const CONTACTS: &'static [Contact] = &[Contact::new("left", 0, 0), Contact::new("right", 1, 0)];
}

#[test]
fn bounces_between_walls_that_close_turn_the_wall_or_end_with_a_reason() {
    // A ball of mass 1 at x between a wall at 0 and one at w, which comes at speed 1.
    let rows = SMatrix::<f64, 2, 2>::new(1.0, 0.0, -1.0, 1.0);
    let run = |wall: f64| {
        let mass = V::from([1.0, wall]);
        let kernel: Scene<Walls, 2, 2, 2> = Scene::linear(mass, V::zeros(), V::zeros(), rows).restitution([1.0; 2]);
        let run = ContactRun::new(&kernel).adaptive(1e-9, 1e-9).max_events(500);
        let (made, error) = run.attempt([0.5, 1.0].into(), [0.0, -1.0].into(), 0.0..2.0);
        let last = made.last().expect("a sample");
        let energy = 0.5 * last.z.component_mul(&last.z).dot(&mass);
        // Each impact has some roundings.
        let bound = 8.0 * f64::EPSILON * (1 + made.events().len()) as f64 * 0.5 * wall;
        assert!((energy - 0.5 * wall).abs() < bound, "{energy}");
        assert!(made.iter().all(|s| s.q[0] > -1e-12 && s.q[1] - s.q[0] > -1e-12));
        (last, error.map(|error| error.kind))
    };
    let (last, error) = run(100.0);
    assert!(error.is_none() && last.t == 2.0 && last.z[1] > 0.9, "{error:?}");
    // A wall that nothing turns back: the ball is faster by 2 each time, without end.
    let (last, error) = run(1e12);
    assert_eq!(error, Some(ContactErrorKind::TooManyEvents { limit: 500 }));
    assert!(last.t < 1.0 && last.z[0].abs() > 400.0);
}
