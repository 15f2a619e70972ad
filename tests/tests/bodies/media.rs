//! Bodies in a uniform stream: what Galilei's principle and the principle of equivalence say of them, up to bounds on
//! rounding, and closed forms.

use crate::common::Bounded;
use crate::common::agreement::{equal, explore, largest};
use crate::common::body::list;
use crate::common::parameters::Parameters;
use crate::common::states::{Motion, State};
use gauss_runtime::prelude::*;
use gauss_tests::nonholonomic::precise;
use proptest::test_runner::TestCaseError;

/// A body with all that a fluid does to it, in the given chart and stream.
macro_rules! body {
    ($name:ident [$($clauses:tt)+]) => {
        #[derive(GaussDynamics)]
        #[gauss($($clauses)+, drag(linear = linear, quadratic = quadratic))]
        struct $name<T> {
            #[gauss(mass)]
            mass: T,
            #[gauss(center_of_mass)]
            center: Vector3<T>,
            #[gauss(inertia)]
            inertia: Matrix3<T>,
            #[gauss(added_mass)]
            fluid: Matrix6<T>,
            #[gauss(gravity)]
            field: Vector3<T>,
            #[gauss(displaced_mass)]
            displaced: T,
            #[gauss(center_of_buoyancy)]
            buoyancy: Vector3<T>,
            linear: Matrix6<T>,
            quadratic: Vector6<T>,
            stream: Vector3<T>,
            surge: Vector3<T>,
        }

        impl<T: Real> $name<T> {
            fn of(p: &Parameters, field: Vector3<T>) -> Self {
                let Stream { start, surge } = Stream::of(p);
                Self {
                    mass: p.mass(), center: p.center(), inertia: p.inertia(), fluid: p.fluid(), field,
                    displaced: p.displaced(), buoyancy: p.buoyancy(),
                    linear: p.fluid(), quadratic: p.diagonal_fluid(), stream: start, surge,
                }
            }
        }
    };
}

/// c = `start` + t `surge`, observer's axes.
struct Stream<T> {
    start: Vector3<T>,
    surge: Vector3<T>,
}

impl<T: Real> Stream<T> {
    /// Numbers of the random body under other names, in the plane k₁k₂.
    fn of(p: &Parameters) -> Self {
        let triple = |[x, y, _]: [f64; 3], scale: f64| {
            Vector3::from([T::from_f64(scale * x), T::from_f64(scale * y), T::zero()])
        };
        Self { start: triple(p.c, 4.0), surge: triple(p.buoyancy, 3.0) }
    }
}

body!(Still[chart = hybrid]);
body!(Carried [chart = hybrid, medium(velocity = stream)]);
body!(Swept [chart = hybrid, medium(velocity = stream + t * surge)]);
body!(StillBoat [chart = hybrid, motion = planar]);
body!(SweptBoat [chart = hybrid, motion = planar, medium(velocity = stream + t * surge)]);

/// In the variables of the hybrid chart, where z begins with ḃ: the motion in a stream is that in a still fluid seen
/// from a frame that goes with it. There gravity is g − dc/dt, and ḃ is ḃ − c.
fn equivalent<S, C>(
    (swept, still): (&S, &C),
    stream: (&[Bounded], &[Bounded]),
    state: &State,
    tally: &crate::common::agreement::Tally,
) -> Result<(), TestCaseError>
where
    S: RigidBodySystem<Scalar = Bounded, Input = ()>,
    C: RigidBodySystem<Scalar = Bounded, Input = (), Configuration = S::Configuration, Speeds = S::Speeds>,
{
    let t = TIME;
    let q = swept.configuration(&state.pose()).expect("regular everywhere");
    let z = swept.speeds(t, &q, &state.twist());
    let (mut relative, mut expected) = (z, S::Speeds::zero());
    for (i, (&start, &surge)) in stream.0.iter().zip(stream.1).enumerate() {
        relative.set_component(i, z.component(i) - start - t * surge);
        expected.set_component(i, surge);
    }
    let found = swept.acceleration(t, &q, &z, &());
    let seen = still.acceleration(t, &q, &relative, &());
    equal("ż", &list(&found), &list(&expected.add_scaled(Bounded::one(), &seen)))?;
    tally.count(&list(&found), largest(&list(&found)).max(largest(&list(&z)).powi(2)));
    Ok(())
}

const TIME: Bounded = Bounded { value: 0.75, bound: 0.0 };

fn difference(a: Vector3<Bounded>, b: Vector3<Bounded>) -> Vector3<Bounded> {
    Vector3::from(std::array::from_fn(|i| a[i] - b[i]))
}

#[test]
fn a_steady_stream_carries_the_motion_along() {
    explore(Motion::Free, 0.7, |p, state, tally| {
        let carried = Carried::of(p, p.field()).kernel().expect("a body");
        let still = Still::of(p, p.field()).kernel().expect("a body");
        let start = Stream::of(p).start;
        equivalent((&carried, &still), (start.as_slice(), &[Bounded::zero(); 3]), state, tally)
    });
}

#[test]
fn an_accelerating_stream_is_a_still_fluid_with_other_gravity() {
    explore(Motion::Free, 0.7, |p, state, tally| {
        let Stream { start, surge } = Stream::of(p);
        let swept = Swept::of(p, p.field()).kernel().expect("a body");
        let still = Still::of(p, difference(p.field(), surge)).kernel().expect("a body");
        equivalent((&swept, &still), (start.as_slice(), surge.as_slice()), state, tally)
    });
}

#[test]
fn so_it_is_in_the_plane() {
    explore(Motion::Planar, 0.7, |p, state, tally| {
        let Stream { start, surge } = Stream::of(p);
        let swept = SweptBoat::of(p, p.field()).kernel().expect("a body");
        let still = StillBoat::of(p, difference(p.field(), surge)).kernel().expect("a body");
        equivalent((&swept, &still), (&start.as_slice()[..2], &surge.as_slice()[..2]), state, tally)
    });
}

/// What is as heavy as the water that it displaces, and as its parts, goes with the water wherever that goes.
#[test]
fn a_neutral_body_stays_with_the_water() {
    explore(Motion::Free, 0.7, |p, state, tally| {
        let mut body = Swept::<Bounded>::of(p, p.field());
        (body.displaced, body.buoyancy) = (body.mass, body.center);
        let surge = body.surge;
        let kernel = body.kernel().expect("a body");
        let q = kernel.configuration(&state.pose()).expect("regular everywhere");
        let Stream { start, .. } = Stream::<Bounded>::of(p);
        let mut z = SVector::from([Bounded::zero(); 6]);
        for i in 0..3 {
            z[i] = start[i] + TIME * surge[i];
        }
        let found = list(&kernel.acceleration(TIME, &q, &z, &()));
        let expected: Vec<Bounded> = (0..6).map(|i| if i < 3 { surge[i] } else { Bounded::zero() }).collect();
        equal("ż", &found, &expected)?;
        // Forces of the size of weight and buoyancy cancel.
        tally.count(&found, largest(&list(&p.field::<Bounded>())).max(1.0));
        Ok(())
    });
}

/// Three weights on a frame that floats, from which a body with added mass hangs by a joint.
macro_rules! hanging {
    ($name:ident [$($clauses:tt)*]) => {
        #[derive(GaussDynamics)]
        #[gauss(
            coordinates(x, y, z, psi, theta, phi),
            frame(buoy, position = [x, y, z], rotation = rotation_z(psi)),
            particle(mass = weight, parent = buoy, position = center),
            particle(mass = 2 * weight, parent = buoy, position = buoyancy),
            body(parent = buoy, position = eye, rotation = rotation_y(theta) * rotation_x(phi)),
            drag(body = body, linear = linear),
            force(wind, body = buoy, at = center, value = -d * hypot(buoy.relative_velocity.x, d) * buoy.relative_velocity),
            spring(along = theta, stiffness = d, damping = d),
            $($clauses)*
        )]
        struct $name<T> {
            weight: T,
            #[gauss(mass)]
            mass: T,
            #[gauss(center_of_mass)]
            center: Vector3<T>,
            #[gauss(inertia)]
            inertia: Matrix3<T>,
            #[gauss(added_mass)]
            fluid: Matrix6<T>,
            #[gauss(gravity)]
            field: Vector3<T>,
            #[gauss(displaced_mass)]
            displaced: T,
            #[gauss(center_of_buoyancy)]
            buoyancy: Vector3<T>,
            eye: Vector3<T>,
            linear: Matrix6<T>,
            d: T,
            stream: Vector3<T>,
            surge: Vector3<T>,
        }

        impl<T: Real> $name<T> {
            fn of(p: &Parameters, field: Vector3<T>) -> Self {
                let Stream { start, surge } = Stream::of(p);
                Self {
                    weight: p.displaced::<T>() + T::one(),
                    mass: p.mass(), center: p.center(), inertia: p.inertia(), fluid: p.fluid(), field,
                    displaced: p.displaced(), buoyancy: p.buoyancy(), eye: p.buoyancy(),
                    linear: p.fluid(), d: p.g(), stream: start, surge,
                }
            }
        }
    };
}

hanging!(StillBuoy []);
hanging!(SweptBuoy[medium(velocity = stream + t * surge)]);

#[test]
fn so_it_is_for_what_hangs_on_another_body() {
    // Rotations about three axes one after another are ill-conditioned where two of them meet.
    explore(Motion::Free, 0.5, |p, state, tally| {
        let Stream { start, surge } = Stream::<Bounded>::of(p);
        let swept = SweptBuoy::of(p, p.field()).kernel().expect("bodies");
        let still = StillBuoy::of(p, difference(p.field(), surge)).kernel().expect("bodies");
        let exact = |v: [f64; 6]| SVector::<Bounded, 6>::from(v.map(Bounded::from_f64));
        let ([x, y, z], [psi, theta, phi, ..]) = (state.position, state.direction);
        let q = exact([x, y, z, 3.0 * psi, theta, 3.0 * phi]);
        let rates = exact(state.twist);
        let mut relative = rates;
        for i in 0..3 {
            relative[i] = rates[i] - start[i] - TIME * surge[i];
        }
        let found = list(&swept.acceleration(TIME, &q, &rates, &()));
        let mut expected = still.acceleration(TIME, &q, &relative, &());
        for i in 0..3 {
            expected[i] += surge[i];
        }
        equal("ż", &found, &list(&expected))?;
        tally.count(&found, largest(&found).max(largest(&list(&rates)).powi(2)));
        Ok(())
    });
}

/// A ball in a tide, without drag: (m + m′/2) dv/dt = 3/2 m′ dc/dt with the displaced mass m′, half of which is the
/// added mass of a ball (Auton, Hunt & Prud'homme 1988).
#[derive(GaussDynamics)]
#[gauss(chart = left_invariant, medium(velocity = [speed * cos(pulse * t), 0, 0]))]
struct Ball {
    #[gauss(mass)]
    mass: f64,
    #[gauss(inertia)]
    inertia: f64,
    #[gauss(added_mass)]
    added: Vector6<f64>,
    #[gauss(gravity)]
    g: f64,
    #[gauss(displaced_mass)]
    displaced: f64,
    speed: f64,
    pulse: f64,
}

#[test]
fn a_ball_in_a_tide_has_its_closed_form() {
    let (mass, displaced, speed, pulse) = (2.5, 1.0, 0.8, 1.5);
    let half = displaced / 2.0;
    let added = Vector6::new(half, half, half, 0.0, 0.0, 0.0);
    let kernel = Ball { mass, inertia: 0.4, added, g: 0.0, displaced, speed, pulse }.kernel().expect("a ball");
    // It turns, which changes nothing for a ball.
    let rotation = UnitQuaternion::from_scaled_axis(Vector3::new(0.3, -0.8, 0.5));
    let start = Isometry3::from_parts(Translation3::identity(), rotation);
    let z = SVector::from([0.0, 0.0, 0.0, 0.4, -0.2, 0.7]);
    let time = 4.0;
    let share = 1.5 * displaced / (mass + half);
    // Released at rest: v = share (c(t) − c(0)).
    let expected = share * speed * ((pulse * time).sin() / pulse - time);
    for momentum in [false, true] {
        let run = Simulation::new(&kernel).control(precise());
        let end = match momentum {
            true => run.momentum_form().run_to_end(start, z, 0.0..time),
            false => run.run_to_end(start, z, 0.0..time),
        };
        let found = end.expect("regular").q.translation.vector;
        // Steps are accepted with errors of 1e-12 and there are some dozens of them.
        assert!((found - Vector3::x() * expected).amax() < 1e-10, "{found} {expected}");
    }
}

/// The whole motion, in both forms: in a steady stream that in still water, carried along.
#[test]
fn trajectories_are_carried_along() {
    let p = Parameters {
        m: 2.0,
        c: [0.1, -0.15, 0.05],
        principal: [0.9, 1.1, 1.3],
        full: [[0.9, 0.05, 0.02], [0.05, 1.1, -0.03], [0.02, -0.03, 1.3]],
        diagonal_fluid: [0.3, 0.5, 0.7, 0.1, 0.2, 0.05],
        fluid: std::array::from_fn(|i| {
            std::array::from_fn(|j| if i == j { 1.0 + 0.25 * i as f64 } else { 0.0625 * (i + j) as f64 / 4.0 })
        }),
        g: 9.81,
        field: [0.0, 0.0, -1.0],
        displaced: 1.9,
        buoyancy: [0.0, 0.05, 0.2],
    };
    let still = Still::<f64>::of(&p, p.field()).kernel().expect("a body");
    let carried = Carried::<f64>::of(&p, p.field()).kernel().expect("a body");
    let stream = Stream::<f64>::of(&p).start;
    let start = Isometry3::from_parts(Translation3::identity(), UnitQuaternion::from_scaled_axis(Vector3::x()));
    let z = SVector::from([0.5, 0.2, -0.1, 0.6, -0.4, 0.8]);
    let mut faster = z;
    (0..3).for_each(|i| faster[i] += stream[i]);
    let time = 3.0;
    let expected = Simulation::new(&still).control(precise()).run_to_end(start, z, 0.0..time).expect("regular");
    for momentum in [false, true] {
        let run = Simulation::new(&carried).control(precise());
        let end = match momentum {
            true => run.momentum_form().run_to_end(start, faster, 0.0..time),
            false => run.run_to_end(start, faster, 0.0..time),
        };
        let end = end.expect("regular");
        // Two runs with steps accepted at 1e-12, some dozens each, of a damped motion.
        let carried_back = end.q.translation.vector - stream * time;
        assert!((carried_back - expected.q.translation.vector).amax() < 1e-10, "{carried_back}");
        assert!(end.q.rotation.angle_to(&expected.q.rotation) < 1e-10);
        let mut speeds = end.z - expected.z;
        (0..3).for_each(|i| speeds[i] -= stream[i]);
        assert!(speeds.amax() < 1e-10, "{speeds}");
    }
}
