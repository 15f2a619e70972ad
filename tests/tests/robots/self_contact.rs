//! Links of robots' files that touch each other: which of them, by what friction, and runs of them.

use gauss_contact::{ContactSteps, Mode};
use gauss_runtime::prelude::*;

const EPSILON: f64 = f64::EPSILON;

/// Shapes as the file lets them touch.
#[derive(GaussDynamics)]
#[gauss(mjcf = "robots/arms.xml", inputs = none, self_contact(along = [0, 0, 1]), ground, ignore(pair))]
struct Arms;

/// The same without the file's friction, of some links.
#[derive(GaussDynamics)]
#[gauss(
    mjcf = "robots/arms.xml",
    inputs = none,
    gravity = 0,
    self_contact(links = [ball, left, left_hand], friction = 0, restitution = e),
    ignore(pair),
)]
struct Toss {
    e: f64,
}

#[test]
fn a_file_says_which_links_touch() {
    let names: Vec<(&str, [Option<&str>; 2])> = ArmsKernel::CONTACTS.iter().map(|own| (own.name, own.bodies)).collect();
    let between = |name, first, second| (name, [Some(first), Some(second)]);
    let expected = [
        // The floor meets the fist of its pair, and no other shape.
        ("right_fist", [Some("right_hand"), None]),
        // A pair of a shape that touches nothing else.
        between("mark_ball", "right_hand", "ball"),
        // The world, which is no parent: its post meets fists, trunk and arms but not itself.
        between("post_chest", "world", "trunk"),
        between("post_left_upper", "world", "left"),
        between("post_left_fist", "world", "left_hand"),
        between("post_right_upper", "world", "right"),
        between("post_right_fist", "world", "right_hand"),
        between("post_ball", "world", "ball"),
        // Chest and arms are parent and child, though two joints are between those of the left; the left hand is
        // excluded. Capsules do not touch one another.
        between("right_fist_chest", "right_hand", "trunk"),
        between("ball_chest", "ball", "trunk"),
        between("right_fist_left_upper", "right_hand", "left"),
        between("ball_left_upper", "ball", "left"),
        between("left_fist_right_upper", "left_hand", "right"),
        between("left_fist_right_fist", "left_hand", "right_hand"),
        between("left_fist_ball", "left_hand", "ball"),
        between("ball_right_upper", "ball", "right"),
        between("right_fist_ball", "right_hand", "ball"),
    ];
    assert_eq!(names, expected);
    let kernel = Arms.kernel().unwrap();
    let start = ArmsState::default();
    let friction = kernel.friction(0.0, &start.q(), &start.z(), &());
    let of = |name: &str| {
        let contact = ArmsKernel::CONTACTS.iter().find(|own| own.name == name).unwrap();
        contact.friction_rows().map(|row| friction[row]).fold(0.0, f64::max)
    };
    assert_eq!(["right_fist", "mark_ball", "post_chest", "left_fist_ball"].map(of), [0.9, 0.2, 0.4, 0.4]);
    // Places of the file at the start: the fists 0.4 apart, the left one 0.05 above the ball's height.
    let gaps = kernel.gaps(0.0, &start.q());
    let gap = |name: &str| gaps[ArmsKernel::CONTACTS.iter().position(|own| own.name == name).unwrap()];
    assert!((gap("left_fist_right_fist") - (0.4 - 0.1)).abs() < 8.0 * EPSILON);
    assert!((gap("post_chest") - (0.25 - 0.05 - 0.12)).abs() < 8.0 * EPSILON);
    // Beside the middle of the other arm, at the height of its end.
    assert!((gap("left_fist_right_upper") - (0.2_f64.hypot(0.4) - 0.09)).abs() < 8.0 * EPSILON);
    assert!((gap("right_fist") - (1.0 - 0.05)).abs() < 8.0 * EPSILON);
}

/// A ball flies against the upper arm, the only thing in its way.
#[test]
fn a_ball_hits_an_arm() {
    let names: Vec<&str> = TossKernel::CONTACTS.iter().map(|own| own.name).collect();
    assert_eq!(names, ["ball_left_upper", "left_fist_ball"]);
    for e in [0.0, 0.5] {
        let kernel = Toss { e }.kernel().unwrap();
        let start = TossState {
            flight: Isometry3::translation(0.5, 0.2, 1.15),
            flight_u: Vector3::new(-1.0, 0.0, 0.0),
            ..TossState::default()
        };
        // Of the axis of the arm it is 0.14 away when they touch, after 0.36 s; the middle of a step is a ms off.
        let run = ContactSteps::new(&kernel, 1e-3).run(start.q(), start.z(), 0.0..0.5).unwrap();
        let hits = run.iter().find(|step| step.modes[0] != Mode::Open).unwrap();
        assert!((hits.state.t - 0.36).abs() < 2e-3, "{}", hits.state.t);
        // Newton's law: the relative speed along x after it is e times that before; the gap never is below zero.
        // Rates after an impact are those at the end of the step, while directions turn by v h over 0.14 m.
        let (before, tolerance) = (1.0, if e == 0.0 { 1e-12 } else { 1e-3 / 0.14 });
        let rates = kernel.contact_rates(hits.state.t, &hits.state.q, &hits.state.z);
        assert!((rates[0] - e * before).abs() < tolerance, "{e}: {rates}");
        assert!(run.iter().all(|step| kernel.gaps(step.state.t, &step.state.q).min() > -1e-14));
        // The impulse on the ball is what the arm got.
        let forces = hits.forces(&kernel);
        let pole = Vector3::zeros();
        let [ball, arm] = ["ball", "left"].map(|body| forces.wrench_on(body, &pole).unwrap());
        assert!((ball.force + arm.force).amax() <= 0.0 && ball.force.x > 0.0);
    }
}
