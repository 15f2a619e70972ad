//! Contacts of models that come at run time beside those of compiled kernels of the same structs: every method of
//! `ContactSystem`, runs from event to event, runs in steps; with room for what there is, and for more.

use gauss_contact::{ContactError, ContactRun, ContactSteps};
use gauss_jit::{Inputs, Kernel, Model, NoSystem, SystemWithContacts};
use gauss_runtime::contact::ContactSystem;
use gauss_runtime::forces::Columns;
use gauss_runtime::prelude::*;

/// A struct with its kernel, and the text of it.
macro_rules! scene {
    ($name:ident, { $($tokens:tt)* }) => {
        mod $name {
            use gauss_runtime::prelude::*;

            #[derive(Clone, Copy, GaussDynamics)]
            $($tokens)*

            pub const SOURCE: &str = stringify!($($tokens)*);
        }
    };
}

// Four corners, of which all rows are there.
scene!(crate_, {
    #[gauss(
        coordinates(pose: Pose),
        body(case, pose = pose, mass = 2, inertia = [0.03, 0.04, 0.05]),
        gravity = 9.81,
        contact(a, point = case.position + case.rotation * [0.1, 0.15, -0.05], friction = 0.4, restitution = 0.3),
        contact(b, point = case.position + case.rotation * [-0.1, 0.15, -0.05], friction = 0.4, restitution = 0.3),
        contact(c, point = case.position + case.rotation * [0.1, -0.15, -0.05], friction = 0.4, restitution = 0.3),
        contact(d, point = case.position + case.rotation * [-0.1, -0.15, -0.05], friction = 0.4, restitution = 0.3),
    )]
    pub struct Crate {}
});

// Drilling, rolling resistance, a range and dry friction in one scene, with an input.
scene!(ball, {
    #[gauss(
        coordinates(pose: Pose, lift),
        body(marble, pose = pose, mass = 0.5, inertia = 0.002),
        particle(mass = 0.3, position = [1, 0, lift]),
        input(pull), drive(lift = pull),
        gravity = 9.81,
        contact(table, point = marble.position, radius = 0.1, friction = 0.3, drilling = 0.02, rolling = 0.003),
        range(lift, from = -0.2, to = 0.4, restitution = 0.2),
        dry_friction(rail, slip = rate(lift), bound = 0.5),
    )]
    pub struct Ball {}
});

// A coordinate that a constraint drives, in the plane.
scene!(pushed, {
    #[gauss(
        coordinates(x, z, drive),
        particle(mass = 1, position = [x, 0, z]), particle(mass = 0.2, position = [drive, 0, 0.5]),
        constraint(position = drive - 0.2 * sin(3 * t)),
        spring(from = [x, 0, z], to = [drive, 0, 0.5], length = 0.3, stiffness = 40, damping = 0.4),
        gravity = 9.81,
        contact(floor, gap = z, slip = rate(x), friction = 0.5, restitution = 0.4),
    )]
    pub struct Pushed {}
});

// A long tree, whose A⁻¹Wᵀ comes in halves.
scene!(quadruped, {
    #[gauss(
        urdf = "../../tests/robots/anymal.urdf", base = floating, gravity = 9.81,
        point(lf, body = LF_KFE_link, at = [0.033, 0.01305, -0.33797]),
        point(lh, body = LH_KFE_link, at = [-0.033, 0.01305, -0.33797]),
        point(rf, body = RF_KFE_link, at = [0.033, -0.01305, -0.33797]),
        point(rh, body = RH_KFE_link, at = [-0.033, -0.01305, -0.33797]),
        contact(lf_foot, point = lf, radius = 0.031, friction = 0.8),
        contact(lh_foot, point = lh, radius = 0.031, friction = 0.8),
        contact(rf_foot, point = rf, radius = 0.031, friction = 0.8),
        contact(rh_foot, point = rh, radius = 0.031, friction = 0.8),
    )]
    pub struct Quadruped {}
});

fn kernel(source: &str) -> Kernel {
    let model = Model::from_source(source).unwrap_or_else(|mistakes| panic!("{mistakes}\n{source}"));
    model.kernel(&[]).unwrap_or_else(|error| panic!("{error}"))
}

fn numbers<V: VectorSpace<f64>>(vector: &V) -> Vec<f64> {
    (0..V::DIM).map(|i| vector.component(i)).collect()
}

fn vector<V: VectorSpace<f64>>(numbers: &[f64]) -> V {
    let mut vector = V::zero();
    numbers.iter().take(V::DIM).enumerate().for_each(|(i, x)| vector.set_component(i, *x));
    vector
}

/// The first of them agree, to the rounding of programs whose sums are in another order, and the others are zero.
#[track_caller]
fn agree(own: &[f64], found: &[f64], near: f64) {
    let size = own.iter().fold(1.0_f64, |size, x| size.max(x.abs()));
    for (k, found) in found.iter().enumerate() {
        let expected = own.get(k).copied().unwrap_or(0.0);
        assert!((found - expected).abs() <= near * size, "number {k}: {found} for {expected}");
    }
}

/// Both are the same function, of some 1e4 operations at most, whose sums may be in another order.
const ROUNDING: f64 = 1e-11;

/// Compares every method at a state.
fn methods<S, I, const Q: usize, const Z: usize, const R: usize, const CONSTRAINED: bool>(
    compiled: &S,
    system: &SystemWithContacts<'_, Q, Z, I, R, CONSTRAINED>,
    (q, z): (&S::Configuration, &S::Speeds),
    input: (&S::Input, &I),
) where
    S: ContactSystem<Scalar = f64>,
    I: Inputs,
{
    let t = 0.3;
    let (own_q, own_z) = (system.system().configuration(&numbers(&q.components())), vector(&numbers(z)));
    assert_eq!(compiled.contacts(), system.contacts());
    let (count, rows, speeds) = (S::Gaps::DIM, S::ContactRows::DIM, S::Speeds::DIM);
    let gaps = numbers(&system.gaps(t, &own_q));
    agree(&numbers(&compiled.gaps(t, q)), &gaps[..count], ROUNDING);
    assert!(gaps[count..].iter().all(|gap| *gap > 0.0));
    let rates = system.contact_rates(t, &own_q, &own_z);
    agree(&numbers(&compiled.contact_rates(t, q, z)), &numbers(&rates), ROUNDING);
    let friction = system.friction(t, &own_q, &own_z, input.1);
    agree(&numbers(&compiled.friction(t, q, z, input.0)), &numbers(&friction), ROUNDING);
    agree(&numbers(&compiled.restitution()), &numbers(&system.restitution()), 0.0);
    let columns = (compiled.contact_jacobian(t, q), system.contact_jacobian(t, &own_q));
    let response = (compiled.contact_response(t, q), system.contact_response(t, &own_q));
    let dynamics = (compiled.contact_dynamics(t, q, z, input.0), system.contact_dynamics(t, &own_q, &own_z, input.1));
    agree(&numbers(&dynamics.0.acceleration), &numbers(&dynamics.1.acceleration), ROUNDING);
    agree(&numbers(&dynamics.0.bias), &numbers(&dynamics.1.bias), ROUNDING);
    for row in 0..rows {
        for (own, found) in [
            (columns.0.nth(row), columns.1.nth(row)),
            (response.0.columns.nth(row), response.1.columns.nth(row)),
            (dynamics.0.response.columns.nth(row), dynamics.1.response.columns.nth(row)),
        ] {
            agree(&numbers(&own.expect("a row")), &numbers(&found.expect("a row")), ROUNDING);
        }
        for other in 0..rows {
            let [own, found] = [response.0.delassus[(row, other)], response.1.delassus[(row, other)]];
            let again = dynamics.1.response.delassus[(row, other)];
            let size = 1.0 + response.0.delassus[(row, row)];
            assert!((own - found).abs() <= ROUNDING * size && (own - again).abs() <= ROUNDING * size, "{own} {found}");
        }
    }
    for row in rows..R {
        assert_eq!(columns.1.nth(row).map(|column| numbers(&column)), Some(vec![0.0; Z]));
        assert!(
            (0..R).all(|other| response.1.delassus[(row, other)] == 0.0 && response.1.delassus[(other, row)] == 0.0)
        );
    }
    let impulses: Vec<f64> = (0..rows).map(|row| 0.4 - 0.3 * (row % 4) as f64).collect();
    let factors = (compiled.impulse_response(t, q).factors, system.impulse_response(t, &own_q).factors);
    let pushed = (
        compiled.impulse_velocities(&factors.0, &vector(&impulses)),
        system.impulse_velocities(&factors.1, &vector(&impulses)),
    );
    agree(&numbers(&pushed.0), &numbers(&pushed.1), ROUNDING);
    assert!(numbers(&pushed.1)[speeds..].iter().all(|x| *x == 0.0));
    // Sizes of the terms of which velocities are sums.
    let terms = numbers(&system.impulse_terms(&factors.1, &vector(&impulses)));
    assert!(numbers(&pushed.1).iter().zip(&terms).all(|(sum, size)| sum.abs() <= (1.0 + ROUNDING) * size));
    for contact in 0..=count {
        let (own, found) = (compiled.contact_frame(contact, t, q), system.contact_frame(contact, t, &own_q));
        assert_eq!(own.is_some(), found.is_some(), "{contact}");
        if let (Some(own), Some(found)) = (own, found) {
            agree(own.point.as_slice(), found.point.as_slice(), ROUNDING);
            agree(own.normal.as_slice(), found.normal.as_slice(), ROUNDING);
            assert_eq!(own.tangents().len(), found.tangents().len());
            for (own, found) in own.tangents().iter().zip(found.tangents()) {
                agree(own.as_slice(), found.as_slice(), ROUNDING);
            }
        }
    }
}

/// A start, the end of a run, the inputs of both, and how near ends are.
struct Motion<S: GaussSystem, I> {
    start: (S::Configuration, S::Speeds),
    end: f64,
    input: (S::Input, I),
}

/// Compares runs from event to event, and in steps of a millisecond.
fn runs<S, I, const Q: usize, const Z: usize, const R: usize, const CONSTRAINED: bool>(
    compiled: &S,
    system: &SystemWithContacts<'_, Q, Z, I, R, CONSTRAINED>,
    Motion { start: (q, z), end, input }: &Motion<S, I>,
    events: bool,
) where
    S: ContactSystem<Scalar = f64>,
    I: Inputs + VectorSpace<f64>,
{
    let (own, wide) = *input;
    let start = system.system().configuration(&numbers(&q.components()));
    let speeds: SVector<f64, Z> = vector(&numbers(z));
    if events {
        let expected = ContactRun::new(compiled).adaptive(1e-10, 1e-10).input(move |_: f64, _: &_, _: &_| own);
        let expected = expected.run(*q, *z, 0.0..*end).expect("a compiled run");
        let tolerance = 1e-10 * system.system().share();
        let found = ContactRun::new(system).adaptive(tolerance, tolerance).input(move |_: f64, _: &_, _: &_| wide);
        let found = found.run(start, speeds, 0.0..*end).expect("a run");
        let told = |name: &'static str, kind: &gauss_contact::EventKind| (name, core::mem::discriminant(kind));
        let both = expected.events().iter().zip(found.events());
        assert!(!expected.events().is_empty() && expected.events().len() == found.events().len());
        for (own, other) in both {
            assert_eq!(told(own.name, &own.kind), told(other.name, &other.kind), "{own:?} {other:?}");
            assert!((own.time - other.time).abs() < 1e-7, "{own:?} {other:?}");
        }
        let (own, found) = (expected.last().expect("an end"), found.last().expect("an end"));
        agree(&numbers(&own.q.components()), found.q.as_slice(), 1e-6);
        agree(&numbers(&own.z), found.z.as_slice(), 1e-5);
    }
    let expected = ContactSteps::new(compiled, 1e-3).input(move |_: f64, _: &_, _: &_| own);
    let expected = expected.run(*q, *z, 0.0..*end).expect("compiled steps");
    let found = ContactSteps::new(system, 1e-3).input(move |_: f64, _: &_, _: &_| wide);
    let found = found.run(start, speeds, 0.0..*end).expect("steps");
    assert_eq!(expected.samples.len(), found.samples.len());
    let mut touched = false;
    for (own, other) in expected.samples.iter().zip(&found.samples) {
        let closed = |modes: &[gauss_contact::Mode]| modes.iter().map(|mode| mode.is_closed()).collect::<Vec<_>>();
        let (own_modes, other_modes) = (closed(&own.modes), closed(&other.modes));
        touched |= own_modes.contains(&true);
        assert_eq!(own_modes[..], other_modes[..own_modes.len()], "t = {}", own.state.t);
        assert!(!other_modes[own_modes.len()..].contains(&true));
        // Steps forget no rounding: what touches multiplies it.
        agree(&numbers(&own.state.q.components()), other.state.q.as_slice(), 1e-6);
        agree(&numbers(&own.state.z), other.state.z.as_slice(), 1e-5);
    }
    assert!(touched);
    let of = |last: Option<&gauss_contact::StepSample<S>>| last.map(|last| last.report.impacts);
    let of_found = found.samples.last().map(|last| last.report.impacts);
    assert_eq!(of(expected.samples.last()), of_found);
}

type None = SVector<f64, 0>;

#[test]
fn a_box_on_four_corners() {
    let (compiled, loaded) = (crate_::Crate {}.kernel().expect("a kernel"), kernel(crate_::SOURCE));
    let pose = Isometry3::new(Vector3::new(0.0, 0.0, 0.4), Vector3::new(0.3, -0.2, 0.5));
    let z = SVector::from([0.4, -0.3, 0.2, 1.0, -2.0, 0.5]);
    let motion = || Motion { start: (pose, z), end: 0.6, input: ((), None::zeros()) };
    let exact = loaded.contact_system::<7, 6, None, 12>().expect("room");
    methods(&compiled, &exact, (&pose, &z), (&(), &None::zeros()));
    runs(&compiled, &exact, &motion(), true);
    let wide = loaded.contact_system::<16, 16, None, 24>().expect("room");
    methods(&compiled, &wide, (&pose, &z), (&(), &None::zeros()));
    runs(&compiled, &wide, &motion(), true);
}

#[test]
fn drilling_rolling_ranges_and_dry_friction() {
    let (compiled, loaded) = (ball::Ball {}.kernel().expect("a kernel"), kernel(ball::SOURCE));
    let pose = Isometry3::new(Vector3::new(0.0, 0.0, 0.102), Vector3::new(0.3, -0.2, 0.5));
    let state = ball::BallState { pose, lift: 0.1, ..Default::default() };
    let z = SVector::from([0.4, -0.3, 0.0, 1.0, -2.0, 5.0, -0.7]);
    let loads = (SVector::from([2.0]), SVector::from([2.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]));
    let motion = || Motion { start: (state.q(), z), end: 0.5, input: loads };
    let wide = loaded.contact_system::<12, 12, SVector<f64, 12>, 16>().expect("room");
    methods(&compiled, &wide, (&state.q(), &z), (&loads.0, &loads.1));
    runs(&compiled, &wide, &motion(), true);
}

#[test]
fn constraints_that_drive() {
    let (compiled, loaded) = (pushed::Pushed {}.kernel().expect("a kernel"), kernel(pushed::SOURCE));
    let start = (SVector::from([0.1, 0.3, 0.0]), SVector::from([0.2, 0.0, 0.6]));
    let motion = || Motion { start, end: 1.0, input: ((), None::zeros()) };
    let wide = loaded.constrained_contact_system::<4, 4, None, 4>().expect("room");
    runs(&compiled, &wide, &motion(), true);
    let told = loaded.contact_system::<4, 4, None, 4>().expect_err("constraints");
    assert_eq!(told, NoSystem::Has("constraints: `constrained_system` has them"));
}

#[test]
fn a_robot_on_its_feet() {
    let (compiled, loaded) = (quadruped::Quadruped {}.kernel().expect("a kernel"), kernel(quadruped::SOURCE));
    // Legs are left in front, left behind, then the right ones; it falls for two millimetres.
    let angles = SVector::from([0.0, 0.4, -0.8, 0.0, -0.4, 0.8, 0.0, 0.4, -0.8, 0.0, -0.4, 0.8]);
    let at = |height: f64| (Isometry3::translation(0.0, 0.0, height), angles);
    let q = at(1.002 - compiled.gaps(0.0, &at(1.0)).min());
    let z = SVector::from_fn(|i, _| 0.2 - 0.05 * (i % 7) as f64);
    let loads =
        (SVector::from_fn(|i, _| i as f64 - 6.0), SVector::from_fn(|i, _| if i < 12 { i as f64 - 6.0 } else { 0.0 }));
    let motion = || Motion { start: (q, SVector::zeros()), end: 0.15, input: loads };
    let wide = loaded.contact_system::<32, 32, SVector<f64, 16>, 24>().expect("room");
    methods(&compiled, &wide, (&q, &z), (&loads.0, &loads.1));
    runs(&compiled, &wide, &motion(), false);
    let (own_q, impulses) = (wide.system().configuration(&numbers(&q.components())), [0.3, -0.1, 0.2]);
    let terms = (
        compiled.impulse_terms(&compiled.impulse_response(0.3, &q).factors, &vector(&impulses)),
        wide.impulse_terms(&wide.impulse_response(0.3, &own_q).factors, &vector(&impulses)),
    );
    agree(&numbers(&terms.0), &numbers(&terms.1), ROUNDING);
    // The room of its own columns is too small for its halves.
    let narrow = loaded.contact_system::<19, 18, SVector<f64, 12>, 12>().expect("room");
    methods(&compiled, &narrow, (&q, &z), (&loads.0, &loads.0));
}

#[test]
fn contacts_are_left_out_by_name_alone() {
    let loaded = kernel(crate_::SOURCE);
    let told = loaded.system::<7, 6, None>().expect_err("contacts");
    assert_eq!(told, NoSystem::Has("contacts: `contact_system` has them, `without_contacts()` leaves them out"));
    let told = loaded.contact_system::<7, 6, None, 11>().expect_err("too little");
    assert_eq!(told, NoSystem::Rows { expected: 12, found: 11 });
    let bare = loaded.without_contacts();
    assert!(bare.contacts().is_empty() && bare.system::<7, 6, None>().is_ok());
    let told = bare.contact_system::<7, 6, None, 12>().expect_err("none");
    assert_eq!(told, NoSystem::Has("no contacts: `system` is for it"));
    // A run that does not say so refuses what it has no forces of.
    let system = loaded.contact_system::<7, 6, (), 12>().expect("room");
    let start = system.system().configuration(&[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0]);
    let refused = Simulation::new(&system).adaptive(1e-9, 1e-9).run(start, SVector::zeros(), 0.0..0.1);
    assert_eq!(refused.expect_err("contacts").kind, IntegrationErrorKind::Contacts);
    assert!(
        Simulation::new(&system).without_contacts().adaptive(1e-9, 1e-9).run(start, SVector::zeros(), 0.0..0.1).is_ok()
    );
}

// A state that a drive reads, and one that nothing reads, beside a range that is never touched.
scene!(slider, {
    #[gauss(
        coordinates(x), particle(mass = 1.3, position = [x, 0, 0]),
        states(s = (x - s) / 0.9, w = abs(rate(x))), drive(x = -5 * s - x - 1),
        range(x, from = -9, to = 9),
    )]
    pub struct Slider {}
});

/// Elements have states in runs from event to event; steps of one length, which do not follow them, say how many.
#[test]
fn states_of_elements_beside_contacts() {
    let own = kernel(slider::SOURCE);
    let system = own.contact_system::<3, 1, (), 2>().expect("room");
    let (q, z) = (system.system().configuration(&[0.4, 0.4, 0.0]), SVector::from([0.3]));
    let told = |error: ContactError| assert!(error.to_string().contains("2 states"), "{error}");
    told(ContactSteps::new(&system, 1e-3).run(q, z, 0.0..0.1).map(drop).expect_err("steps refuse them"));
    let run = ContactRun::new(&system).adaptive(1e-10, 1e-12).run(q, z, 0.0..0.4).expect("a run");
    let smooth = own.without_contacts();
    let smooth = smooth.system::<3, 1, ()>().expect("room");
    let without = Simulation::new(&smooth).adaptive(1e-10, 1e-12).run(q, z, 0.0..0.4).expect("a run");
    let compiled = slider::Slider {}.kernel().expect("a kernel");
    let start = SVector::from([0.4, 0.4, 0.0]);
    let same = ContactRun::new(&compiled).adaptive(1e-10, 1e-12).run(start, z, 0.0..0.4).expect("a run");
    for (k, end) in same.last().expect("a state").q.iter().enumerate() {
        // Some ten steps, each with an error of 1e-10 of numbers below 1; more at the kink.
        let others = [run.last().expect("a state").q.as_slice()[k], without.last().q.as_slice()[k]];
        assert!(others.iter().all(|other| (other - end).abs() < 1e-8), "{k}: {end} and {others:?}");
    }
    // By scipy's DOP853 at 1e-13, of the four equations written out, up to the kink and from there.
    let expected = [0.31009902, 0.3951656, 0.12421191];
    let found = run.last().expect("a state").q;
    assert!(found.as_slice().iter().zip(expected).all(|(found, own)| (found - own).abs() < 1e-8), "{found:?}");
}
