//! Slots: contacts whose points and planes come at run time, beside those of clauses and beside their definition.

use gauss_contact::{
    ContactErrorKind, ContactRun, ContactStepper, ContactSteps, Mode, Slot, SlotField, SlotRule, Slots, StepReport,
};
use gauss_runtime::contact::ContactSystem;
use gauss_runtime::operational::Factor;
use gauss_runtime::prelude::*;

/// A crate on its eight corners, by its clause.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(pose: Pose),
    body(hull, position = pose.position, rotation = pose.rotation, mass = 2, inertia = [0.06, 0.05, 0.04]),
    contact(floor, point = hull.position, edges = [0.4, 0.3, 0.2], friction = 0.5, restitution = 0.2),
    frames(hull),
)]
struct Clause {
    #[gauss(gravity)]
    g: f64,
}

/// The same without contacts.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(pose: Pose),
    body(hull, position = pose.position, rotation = pose.rotation, mass = 2, inertia = [0.06, 0.05, 0.04]),
    frames(hull),
)]
struct Bare {
    #[gauss(gravity)]
    g: f64,
}

/// The hull as a ball, by its clause.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(pose: Pose),
    body(hull, position = pose.position, rotation = pose.rotation, mass = 2, inertia = [0.06, 0.05, 0.04]),
    contact(floor, point = hull.position, radius = 0.2, friction = 0.5, restitution = 0.2),
)]
struct Ball {
    #[gauss(gravity)]
    g: f64,
}

/// An arm that a motor lifts, beside a body that floats, on a base that rocks as a function of time.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(pose: Pose, shoulder, elbow),
    frame(base, position = [0.1 * sin(2 * t), 0, 0], rotation = rotation_y(0.2 * sin(3 * t))),
    body(upper, parent = base, rotation = rotation_y(shoulder), mass = 2, center_of_mass = [0, 0, -0.2],
         inertia = [0.1, 0.1, 0.01]),
    body(lower, parent = upper, position = [0, 0, -0.4], rotation = rotation_x(elbow), mass = 1,
         center_of_mass = [0, 0, -0.2], inertia = [0.06, 0.06, 0.01]),
    body(cargo, position = pose.position, rotation = pose.rotation, mass = 3, center_of_mass = [0.02, 0, 0.01],
         inertia = [0.2, 0.3, 0.25]),
    frames(base, lower, cargo),
)]
struct Pair {
    #[gauss(gravity)]
    g: f64,
}

const G: f64 = 9.81;

type Corners<'k> = Slots<'k, BareKernel, 8, 24, 6>;

fn corner(i: usize) -> Slot<BareFrame> {
    let side = |k: usize, edge: f64| if i >> k & 1 == 0 { -0.5 * edge } else { 0.5 * edge };
    Slot {
        radius: 0.0,
        first: Some(BareFrame::hull),
        point: Vector3::new(side(0, 0.4), side(1, 0.3), side(2, 0.2)),
        second: None,
        origin: Vector3::new(3.0, -1.0, 0.0),
        normal: Vector3::new(0.0, 0.0, 2.0),
        friction: 0.5,
        restitution: 0.2,
    }
}

fn corners(kernel: &BareKernel) -> Corners<'_> {
    let mut slots = Slots::new(kernel);
    slots.fill((0..8).map(corner)).unwrap();
    slots
}

fn start() -> (Isometry3<f64>, SVector<f64, 6>) {
    let pose = Isometry3::new(Vector3::new(0.1, -0.2, 0.6), Vector3::new(0.4, -0.7, 0.3));
    (pose, SVector::from([0.7, -0.2, 0.3, 1.0, -2.0, 0.5]))
}

#[test]
fn slots_are_what_the_clause_of_a_box_is() {
    let (clause, bare) = (Clause { g: G }.kernel().unwrap(), Bare { g: G }.kernel().unwrap());
    let (slots, (q, z)) = (corners(&bare), start());
    // Some tens of roundings of numbers up to 10, D of up to 50.
    let near = |a: f64, b: f64| (a - b).abs() <= 64.0 * f64::EPSILON * 50.0;
    assert!(clause.gaps(0.0, &q).iter().zip(&slots.gaps(0.0, &q)).all(|(a, b)| near(*a, *b)));
    let (a, b) = (clause.contact_rates(0.0, &q, &z), slots.contact_rates(0.0, &q, &z));
    assert!((0..24).all(|row| near(a[row], b[row])), "{a} {b}");
    let (a, b) = (clause.contact_jacobian(0.0, &q), slots.contact_jacobian(0.0, &q));
    assert!(a.iter().zip(&b).all(|(a, b)| near(*a, *b)));
    let (a, b) = (clause.contact_dynamics(0.0, &q, &z, &()), slots.contact_dynamics(0.0, &q, &z, &()));
    assert!(a.bias.iter().zip(&b.bias).all(|(a, b)| near(*a, *b)), "{} {}", a.bias, b.bias);
    let (a, b) = (a.response, b.response);
    assert!(a.columns.iter().zip(&b.columns).all(|(a, b)| near(*a, *b)));
    assert!(a.delassus.iter().zip(&b.delassus).all(|(a, b)| near(*a, *b)));
    for i in 0..8 {
        let (a, b) = (clause.contact_frame(i, 0.0, &q).unwrap(), slots.contact_frame(i, 0.0, &q).unwrap());
        assert!((a.point - b.point).amax() < 1e-15 && a.normal == b.normal && a.tangents() == b.tangents());
    }
}

#[test]
fn a_sphere_is_what_its_clause_is() {
    let (clause, bare) = (Ball { g: G }.kernel().unwrap(), Bare { g: G }.kernel().unwrap());
    let mut slots = Slots::<_, 1, 3, _>::new(&bare);
    slots.set(0, Slot { point: Vector3::zeros(), radius: 0.2, ..corner(0) }).unwrap();
    let (q, z) = start();
    let near = |a: f64, b: f64| (a - b).abs() <= 64.0 * f64::EPSILON * 50.0;
    assert!(near(clause.gaps(0.0, &q)[0], slots.gaps(0.0, &q)[0]));
    assert!((clause.contact_rates(0.0, &q, &z) - slots.contact_rates(0.0, &q, &z)).amax() < 1e-13);
    let (a, b) = (clause.contact_dynamics(0.0, &q, &z, &()), slots.contact_dynamics(0.0, &q, &z, &()));
    assert!(a.bias.iter().zip(&b.bias).all(|(a, b)| near(*a, *b)), "{} {}", a.bias, b.bias);
    assert!(a.response.delassus.iter().zip(&b.response.delassus).all(|(a, b)| near(*a, *b)));
    let (a, b) = (clause.contact_frame(0, 0.0, &q).unwrap(), slots.contact_frame(0, 0.0, &q).unwrap());
    assert!((a.point - b.point).amax() < 1e-15);
    // It lands, slides and rolls.
    let a = ContactSteps::new(&clause, 1e-3).run(q, z, 0.0..1.0).unwrap();
    let b = ContactSteps::new(&slots, 1e-3).run(q, z, 0.0..1.0).unwrap();
    let apart = a.iter().zip(&b).map(|(a, b)| (a.state.q.translation.vector - b.state.q.translation.vector).amax());
    // Some ten roundings of places of order 1 for each step; that in which it comes to stick is made again, until
    // speeds of order 1 agree to 1e-9.
    assert!(apart.fold(0.0, f64::max) < 1e-9);
    assert_eq!(b.last().unwrap().report.closed, 1);
}

#[test]
fn exact_runs_and_steps_move_as_with_the_clause() {
    let (clause, bare) = (Clause { g: G }.kernel().unwrap(), Bare { g: G }.kernel().unwrap());
    let (slots, (q, z)) = (corners(&bare), start());
    // An impact at some 4 m/s turns differences of rounding into ones some hundred times as large; four of them.
    let exact = |run: gauss_contact::ContactTrajectory<_>| run.last().unwrap();
    let a = exact(ContactRun::new(&clause).adaptive(1e-11, 1e-11).run(q, z, 0.0..0.5).unwrap());
    let run = ContactRun::new(&slots).adaptive(1e-11, 1e-11).run(q, z, 0.0..0.5).unwrap();
    let b = run.last().unwrap();
    assert!(run.events().len() > 3);
    assert!((a.q.translation.vector - b.q.translation.vector).amax() < 1e-8, "{} {}", a.q, b.q);
    // Steps until it lies: bounces are the same ones, and it comes to rest at the same place to the last digits.
    let a = ContactSteps::new(&clause, 1e-3).run(q, z, 0.0..2.0).unwrap();
    let b = ContactSteps::new(&slots, 1e-3).run(q, z, 0.0..2.0).unwrap();
    let first: f64 = a
        .iter()
        .zip(&b)
        .take(300)
        .map(|(a, b)| (a.state.q.translation.vector - b.state.q.translation.vector).amax())
        .fold(0.0, f64::max);
    assert!(first < 1e-12, "{first:e}");
    let end = b.last().unwrap();
    assert_eq!((end.report.closed, end.state.z), (4, SVector::<f64, 6>::zeros()));
}

/// A point of the arm above a plane of the cargo, one of the cargo above a plane of the arm, and one above what rests.
fn three(kernel: &PairKernel) -> Slots<'_, PairKernel, 4, 12, 8> {
    let slot = |first, second| Slot {
        first,
        point: Vector3::new(0.3, -0.2, 0.1),
        radius: 0.0,
        second,
        origin: Vector3::new(-0.1, 0.4, 0.2),
        normal: Vector3::new(0.6, -0.3, 0.5),
        friction: 0.4,
        restitution: 0.0,
    };
    let mut slots = Slots::new(kernel);
    slots.set(0, slot(Some(PairFrame::lower), Some(PairFrame::cargo))).unwrap();
    slots.set(1, Slot { radius: 0.15, ..slot(Some(PairFrame::cargo), Some(PairFrame::base)) }).unwrap();
    slots.set(3, Slot { radius: 0.25, ..slot(None, Some(PairFrame::cargo)) }).unwrap();
    slots
}

#[test]
fn planes_that_move_have_the_rates_of_their_gaps() {
    let kernel = Pair { g: G }.kernel().unwrap();
    let slots = three(&kernel);
    let q = (start().0, SVector::from([0.3, -0.8]));
    let z = SVector::from([0.5, -1.0, 0.3, 0.8, -0.4, 1.2, 0.9, -1.1]);
    let t = 0.7;
    // Central differences along the motion: errors of h² times third derivatives below 100, and ε/h.
    let h = 1e-5;
    let dynamics = slots.contact_dynamics(t, &q, &z, &());
    let at = |h: f64| {
        let z = z + dynamics.acceleration * h;
        (t + h, q.retract(&kernel.kinematics(t, &q, &(z - dynamics.acceleration * (0.5 * h))).scale(h)), z)
    };
    let ((t1, q1, z1), (t0, q0, z0)) = (at(h), at(-h));
    let rates = slots.contact_rates(t, &q, &z);
    let (a, b) = (slots.gaps(t1, &q1), slots.gaps(t0, &q0));
    for i in [0, 1, 3] {
        let difference = (a[i] - b[i]) / (2.0 * h);
        assert!((difference - rates[3 * i]).abs() < 1e-7, "{i} {difference} {}", rates[3 * i]);
    }
    let difference = (slots.contact_rates(t1, &q1, &z1) - slots.contact_rates(t0, &q0, &z0)) / (2.0 * h);
    assert!((difference - dynamics.bias).amax() < 1e-7, "{difference} {}", dynamics.bias);
    // An unused slot has no rows.
    assert!((6..9).all(|row| rates[row] == 0.0 && dynamics.bias[row] == 0.0));
    // W is ∂(ġ, s)/∂z, and D = W A⁻¹ Wᵀ by another factor of A.
    let w = slots.contact_jacobian(t, &q);
    for k in 0..8 {
        let mut other = z;
        other[k] += 1.0;
        let change = slots.contact_rates(t, &q, &other) - rates;
        assert!((0..12).all(|row| (change[row] - w[(k, row)]).abs() < 64.0 * f64::EPSILON), "{k}");
    }
    let columns = Factor::of(&kernel.mass_matrix(t, &q)).unwrap().solve(&w);
    assert!((columns - dynamics.response.columns).amax() < 1e-12);
    assert!((w.transpose() * columns - dynamics.response.delassus).amax() < 1e-12);
}

#[test]
fn directions_in_which_nothing_moves_take_no_impulse() {
    // The shoulder alone turns in its plane, so that across it nothing slips.
    let kernel = Pair { g: G }.kernel().unwrap();
    let mut slots = Slots::<_, 1, 3, _>::new(&kernel);
    let slot = Slot {
        first: Some(PairFrame::base),
        point: Vector3::zeros(),
        radius: 0.0,
        second: None,
        origin: Vector3::zeros(),
        normal: Vector3::z(),
        friction: 1.0,
        restitution: 0.0,
    };
    slots.set(0, slot).unwrap();
    let response = slots.contact_response(0.0, &(start().0, SVector::zeros()));
    // The base moves as a function of time alone: no impulse moves anything.
    assert!(response.columns.iter().chain(&response.delassus).all(|x| *x == 0.0));
    slots.set(0, Slot { first: Some(PairFrame::lower), point: Vector3::new(0.0, 0.0, -0.2), ..slot }).unwrap();
    let response = slots.contact_response(0.0, &(start().0, SVector::from([0.5, 0.0])));
    let diagonal = [0, 1, 2].map(|row| response.delassus[(row, row)]);
    // Tangents are along x and y: the elbow moves along y, the shoulder along x and z.
    assert!(diagonal.iter().all(|x| *x > 0.0) && response.delassus[(0, 2)].abs() < 1e-15, "{diagonal:?}");
}

#[test]
fn steps_that_are_held_go_on_with_their_impulses() {
    let bare = Bare { g: G }.kernel().unwrap();
    let slots = corners(&bare);
    let q = Isometry3::translation(0.0, 0.0, 0.1);
    let mut whole = ContactStepper::new(&slots, 0.0, q, SVector::zeros()).unwrap();
    let mut parts = ContactStepper::new(&slots, 0.0, q, SVector::zeros()).unwrap().hold();
    for _ in 0..50 {
        let report = whole.step(1e-3, &()).unwrap();
        // Same bits.
        assert_eq!(parts.step(&slots, Some, (1e-3, &())).unwrap(), report);
        assert_eq!((parts.configuration(), parts.speeds()), (whole.configuration(), whole.speeds()));
        assert_eq!((parts.impulses(), parts.modes()), (whole.impulses(), whole.modes()));
    }
    // It rests: what moves is rounding of the edges.
    let moved = |q: &Isometry3<f64>| q.translation.vector - Vector3::new(0.0, 0.0, 0.1);
    assert!(moved(whole.configuration()).amax() <= 0.2 * f64::EPSILON, "{}", whole.configuration());

    // The same corners in other slots, each with what it had: the same contacts are closed, at once.
    let order = [3, 7, 1, 0, 6, 2, 5, 4];
    let mut other = Corners::new(&bare);
    other.fill(order.map(corner)).unwrap();
    let mut anew = ContactStepper::new(&slots, 0.0, *whole.configuration(), *whole.speeds()).unwrap().hold();
    let lost: StepReport = anew.step(&other, |_| None, (1e-3, &())).unwrap();
    let had: Vec<Mode> = order.iter().map(|&i| parts.modes()[i]).collect();
    let impulses = SVector::<f64, 24>::from_fn(|row, _| parts.impulses()[3 * order[row / 3] + row % 3]);
    let kept = parts.step(&other, |i| Some(order[i]), (1e-3, &())).unwrap();
    assert_eq!(parts.modes(), had);
    // Impulses of contacts that depend on one another are near those of the step before: here the same to rounding of
    // all that bears it, 2 kg for a millisecond, times what depends may be pulled by, 1e5.
    assert!((parts.impulses() - impulses).amax() <= 1e5 * 0.02 * f64::EPSILON, "{}", parts.impulses() - impulses);
    assert!(kept.corrections <= lost.corrections && kept.closed == 4 && lost.closed == 4, "{kept:?} {lost:?}");
    assert!(moved(parts.configuration()).amax() <= 0.2 * f64::EPSILON);
}

#[test]
fn mistakes_are_told() {
    let bare = Bare { g: G }.kernel().unwrap();
    let mut slots = corners(&bare);
    let error = slots.set(8, corner(0)).unwrap_err();
    assert_eq!((error.slot, error.field, error.rule), (8, SlotField::Number, SlotRule::Below { count: 8 }));
    let before = *slots.slots();
    let error = slots.fill([corner(0), Slot { friction: -1.0, ..corner(1) }]).unwrap_err();
    assert_eq!((error.slot, error.field, error.value), (1, SlotField::Friction, -1.0));
    assert_eq!(error.to_string(), "slot 1: `friction` is -1; it must be finite and not negative");
    assert_eq!(slots.slots(), &before);
    slots.clear(3);
    slots.clear(99);
    assert_eq!(slots.slots().iter().flatten().count(), 7);
    // Gaps that are none are refused when steps go on, with the state as it was.
    let mut held = ContactStepper::new(&slots, 0.0, start().0, SVector::zeros()).unwrap().hold();
    let mut far = Corners::new(&bare);
    far.fill([Slot { origin: Vector3::repeat(f64::MAX), normal: Vector3::repeat(1.0), ..corner(0) }]).unwrap();
    let refused = held.step(&far, Some, (1e-3, &())).unwrap_err();
    assert_eq!((refused.kind, refused.contact), (ContactErrorKind::NonFinite, Some("slot_0")));
    assert_eq!((held.time(), held.configuration()), (0.0, &start().0));
    assert!(held.step(&slots, Some, (1e-3, &())).is_ok());
}

/// A hundred points carry a plate: names go on, and forces are those of its weight.
#[test]
fn a_hundred_slots_carry_a_plate() {
    fn stand() {
        let bare = Bare { g: G }.kernel().unwrap();
        let mut slots = Slots::<_, 100, 300, 6>::new(&bare);
        let at = |i: usize| 0.04 * (i as f64 - 4.5);
        let point = |i: usize| Vector3::new(at(i % 10), at(i / 10), -0.1);
        slots.fill((0..100).map(|i| Slot { point: point(i), ..corner(0) })).unwrap();
        let names = Slots::<BareKernel, 100, 300, 6>::CONTACTS;
        assert_eq!([7, 42, 99].map(|i| names[i].name), ["slot_7", "slot_42", "slot_99"]);
        let (h, q) = (1e-3, Isometry3::translation(0.0, 0.0, 0.1));
        let mut stepper = ContactStepper::new(&slots, 0.0, q, SVector::zeros()).unwrap();
        for _ in 0..3 {
            let report = stepper.step(h, &()).unwrap();
            assert_eq!(report.closed, 100);
        }
        let carried: f64 = (0..100).map(|i| stepper.impulses()[3 * i]).sum();
        // A hundred terms, and what 297 dependent equations leave of a weight of 20 N in a millisecond.
        assert!((carried - 2.0 * G * h).abs() <= 1e3 * f64::EPSILON * 2.0 * G * h, "{carried}");
        assert!(stepper.speeds().amax() <= 1e-15, "{}", stepper.speeds());
    }
    // Matrices of 300 rows are handed on by value.
    std::thread::Builder::new().stack_size(64 << 20).spawn(stand).unwrap().join().unwrap();
}

/// A ball above planes through given points with given normals.
fn above<const N: usize>(planes: [[f64; 4]; N]) -> [Slot<BareFrame>; N] {
    planes.map(|[x, height, sine, cosine]| Slot {
        point: Vector3::zeros(),
        radius: 0.1,
        origin: Vector3::new(x, 0.0, height),
        normal: Vector3::new(sine, 0.0, cosine),
        friction: 0.0,
        restitution: 0.0,
        ..corner(0)
    })
}

#[test]
fn a_ball_is_not_drawn_to_a_plane_beside_it() {
    let kernel = Bare { g: G }.kernel().unwrap();
    for (scale, h) in [(1.0, 1e-2), (1.0, 1e-3), (1e-3, 1e-2), (1e3, 1e-2)] {
        // The floor, and planes through points of it 2 to 6 cm from where the ball comes down, normal to the lines to
        // its centre: it lands on the floor alone.
        let lean = |x: f64| [-x, 0.0, x / x.hypot(0.12), 0.12 / x.hypot(0.12)];
        let planes = above([[0.0, 0.0, 0.0, 1.0], lean(0.02), lean(0.04), lean(-0.06)]);
        let mut slots = Slots::<_, 4, 12, _>::new(&kernel);
        slots
            .fill(planes.map(|slot| Slot { origin: slot.origin * scale, radius: slot.radius * scale, ..slot }))
            .unwrap();
        let q = Isometry3::translation(0.0, 0.0, 0.12 * scale);
        let z = SVector::from([0.0, 0.0, -2.5 * scale, 0.0, 0.0, 0.0]);
        for sample in ContactSteps::new(&slots, h).run(q, z, 0.0..0.1).unwrap() {
            let place = sample.state.q.translation.vector / scale;
            // Half of the digits of the size of the configuration, whose turns are of order 1.
            let near = 1.5e-8 * (1.0 + 1.0 / scale);
            assert!(place.x.abs() <= near && place.z >= 0.1 - 1e-12, "{scale} {h} {place}");
        }
    }
}

#[test]
fn points_that_contradict_one_another_are_pushed_no_farther_than_they_are_deep() {
    let kernel = Bare { g: G }.kernel().unwrap();
    // Seven points of the lower face; planes of those within are off those at the corners.
    for (off, e) in [(1e-3, 0.0), (-1e-3, 0.0), (1e-6, 0.0), (-1e-9, 0.0), (1e-6, 0.5)] {
        let points = [[-0.2, -0.15], [0.2, -0.15], [0.2, 0.15], [-0.2, 0.15], [0.0, 0.0], [0.0, 0.15], [0.0, -0.15]];
        let slot = |(i, [x, y]): (usize, [f64; 2])| Slot {
            point: Vector3::new(x, y, -0.1),
            origin: Vector3::new(0.0, 0.0, if i < 4 { 0.0 } else { off * (i as f64 - 3.0) }),
            restitution: e,
            ..corner(0)
        };
        let mut slots = Slots::<_, 8, 24, _>::new(&kernel);
        slots.fill(points.into_iter().enumerate().map(slot)).unwrap();
        let q = Isometry3::new(Vector3::new(0.0, 0.0, 0.16), Vector3::new(0.03, 0.02, 0.0));
        for sample in ContactSteps::new(&slots, 5e-3).run(q, SVector::zeros(), 0.0..0.6).unwrap() {
            let gaps = slots.gaps(0.0, &sample.state.q);
            // Rounding of places up to 1.
            assert!(gaps.min() >= -1e-14, "{off} {e} {gaps}");
        }
    }
}

#[test]
fn planes_that_leave_no_place_are_told_with_the_contact() {
    let kernel = Bare { g: G }.kernel().unwrap();
    let q = Isometry3::translation(0.0, 0.0, 1.0);
    // A wedge of 4°: to open it by a millimetre on both sides the ball would rise by three centimetres.
    for (angle, is_far) in [(2.0_f64, true), (60.0, false)] {
        let (sin, cos) = angle.to_radians().sin_cos();
        let wall = |side: f64| {
            let normal = Vector3::new(-side * cos, 0.0, sin);
            let [slot] = above([[0.0; 4]]);
            Slot { origin: q.translation.vector - normal * (0.1 - 1e-3), normal, ..slot }
        };
        let mut slots = Slots::<_, 2, 6, _>::new(&kernel);
        let mut held = ContactStepper::new(&slots, 0.0, q, SVector::zeros()).unwrap().hold();
        slots.fill([wall(1.0), wall(-1.0)]).unwrap();
        match held.step(&slots, |_| None, (1e-3, &())) {
            Err(error) => {
                assert!(is_far && error.contact.is_some(), "{error}");
                let is_told = |gap: f64, moved: f64| gap < 2e-3 && moved > 0.02;
                let told = matches!(error.kind, ContactErrorKind::Displacement { gap, moved } if is_told(gap, moved));
                assert!(told, "{error}");
            }
            Ok(report) => assert!(!is_far && (report.penetration - 1e-3).abs() < 1e-4, "{angle} {report:?}"),
        }
    }
}
