//! Each element by itself on a body without fluid and weight, where kernels are arranged otherwise than in a fluid: all
//! charts say the same, and the rest of the motion is that of the free body.

use gauss_runtime::prelude::*;
use proptest::test_runner::TestCaseError;

use super::observed::{Observed, agree, columns_add_up, observe};
use super::scenes::{Inputs, Loads, Scene};
use crate::common::Bounded;
use crate::common::agreement::{Tally, explore};
use crate::common::dual::Dual;
use crate::common::parameters::Parameters;
use crate::common::states::{Motion, State};

/// What one chart says of a state; `None` at a singular point of its coordinates.
fn seen<S: Scene>(parameters: &Parameters, state: &State) -> Result<Option<Observed>, TestCaseError> {
    let loads = Loads::of(parameters);
    let kernel = S::kernel::<Bounded>(parameters, &loads);
    let quiet = S::kernel::<Bounded>(parameters, &loads.without_effect());
    columns_add_up(&kernel, (&quiet, &Inputs::read(&[0.0; 10])), state)?;
    observe(&kernel, &S::kernel::<Dual<Bounded>>(parameters, &Loads::of(parameters)), state)
}

/// In the left-invariant chart as in three others. The only element, or elements, are called as given.
fn alike<L: Scene, R: Scene, H: Scene, J: Scene>(motion: Motion, names: &[&str])
where
    L::Kernel<Bounded>: ForcedSystem,
{
    let elements = <L::Kernel<Bounded> as ForcedSystem>::ELEMENTS;
    assert_eq!(elements.iter().map(|element| element.name).collect::<Vec<_>>(), names);
    explore(motion, 0.5, |parameters, state, tally: &Tally| {
        let reference = seen::<L>(parameters, state)?.expect("regular everywhere");
        tally.count(&reference.acceleration, reference.scale);
        for (chart, observed) in [
            ("right", seen::<R>(parameters, state)?),
            ("hybrid", seen::<H>(parameters, state)?),
            ("jet", seen::<J>(parameters, state)?),
        ] {
            if let Some(observed) = observed {
                agree(chart, &reference, &observed)?;
            }
        }
        Ok(())
    });
}

macro_rules! alone {
    ($($test:ident $body:ident $names:tt: $clauses:tt;)+) => {$(
        mod $test {
            the_four_charts!(free, $body, $clauses);

            #[test]
            fn in_every_chart() {
                let motion = $crate::common::states::Motion::Free;
                super::alike::<Left<()>, Right<()>, Hybrid<()>, Jet<()>>(motion, &$names);
            }
        }
    )+};
}

alone! {
    a_force dry ["push"]: [force(push, at = at, value = pull)];
    a_force_of_the_observer dry ["tug"]: [input(thrust), force(tug, at = at, value = thrust * pull, axes = observer)];
    lift dry ["force"]: [
        define(u = body.body_velocity),
        input(thrust),
        force(at = at, value = damped * [thrust, u.x * clamp(u.x, -1, 1), -u.x * u.z])
    ];
    a_torque dry ["torque"]: [torque(value = [min(damped, 1), 0, smooth_step(t, 0, 2) * damped])];
    a_torque_of_the_observer dry ["steer"]: [torque(steer, value = t * pull, axes = observer)];
    a_wrench dry ["blow"]: [input(gust: Wrench), wrench(blow, at = at, force = gust.force, torque = gust.torque)];
    a_wrench_of_the_observer dry ["blow"]: [
        input(gust: Wrench),
        wrench(blow, at = at, force = gust.force, torque = gust.torque, axes = observer)
    ];
    a_spring dry ["cord"]: [
        point(tip, body = body, at = at),
        spring(cord, from = anchor, to = tip, stiffness = stiff, length = length, damping = damped)
    ];
    a_stop dry ["stop"]: [
        point(tip, body = body, at = at),
        stop(from = tip, to = anchor, least = 12, most = length, stiffness = stiff, width = 2, damping = damped)
    ];
    drag dry ["drag"]: [drag(linear = linear, quadratic = quadratic)];
    a_stream wet ["gravity", "medium"]: [medium(velocity = stream * cos(t) + surge * t)];
    a_stream_with_drag dry ["drag"]: [medium(velocity = stream + t * surge), drag(quadratic = linear)];
    central_gravity dry ["central gravity"]: [central_gravity(mu = mu, center = anchor)];
    a_potential dry ["potential"]: [
        potential = stiff * sin(body.position.x - t) + dot(body.rotation * at, pull) * body.position.y
    ];
    dissipation dry ["damping"]: [
        damping = 0.5 * damped * dot(body.velocity, body.velocity) * (2 + sin(body.position.x))
    ];
}

macro_rules! alone_otherwise {
    ($($test:ident $motion:ident $module:ident $body:ident $names:tt: $clauses:tt;)+) => {$(
        mod $test {
            the_four_charts!($module, $body, $clauses);

            #[test]
            fn in_every_chart() {
                let motion = $crate::common::states::Motion::$motion;
                super::alike::<Left<()>, Right<()>, Hybrid<()>, Jet<()>>(motion, &$names);
            }
        }
    )+};
}

// Elements that no other one stands for, where O is held or the motion is in the plane.
alone_otherwise! {
    a_push_of_a_top FixedPoint fixed_point dry ["push"]: [force(push, at = at, value = pull, axes = observer)];
    central_gravity_of_a_top FixedPoint fixed_point dry ["central gravity"]: [
        central_gravity(mu = mu, center = anchor)
    ];
    a_top_in_a_stream FixedPoint fixed_point wet ["gravity", "medium", "drag"]: [
        medium(velocity = stream + t * surge),
        drag(linear = linear)
    ];
    a_push_in_the_plane Planar planar dry ["push"]: [force(push, at = at, value = pull, axes = observer)];
    a_spring_in_the_plane Planar planar dry ["spring"]: [
        point(tip, body = body, at = at),
        spring(from = anchor, to = tip, stiffness = stiff)
    ];
    a_boat_in_a_stream Planar planar wet ["gravity", "medium", "drag"]: [
        medium(velocity = stream + t * surge),
        drag(quadratic = linear)
    ];
}
