//! All charts give the same motion: a random state is written in every chart, ż is mapped to the acceleration of the
//! body twist by dual numbers (no finite differences), and what the charts say must agree up to rounding.

#[macro_use]
#[path = "../common/mod.rs"]
mod common;

mod acting;
mod charts_as_systems;
mod conversion;
mod energy;
mod evaluate;
mod forms;
mod generic_scalar;
mod one_house;
mod operations;
mod parameters;
mod specialisation;

use crate::common::Bounded;
use crate::common::agreement::{equal, explore, largest};
use crate::common::body::{Body, Parts, Scene, flow, list, rates};
use crate::common::dual::Dual;
use crate::common::parameters::Parameters;
use crate::common::states::{Motion, State};
use gauss_runtime::prelude::*;
use proptest::test_runner::TestCaseError;

/// What does not depend on the chart.
struct Observed {
    /// d/dt (u, ω).
    acceleration: Vec<Bounded>,
    twist: Vec<Bounded>,
    body_momentum: Vec<Bounded>,
    space_momentum: Vec<Bounded>,
    energies: [Bounded; 2],
    /// C at a point that is the true acceleration moved by the same body acceleration in every chart, minus its least
    /// value: ½ |δ|² in the metric of the mass.
    excess: Bounded,
    /// The size of the terms that enter the acceleration.
    scale: f64,
}

/// The motion of a state as one chart sees it; `None` at a singular point of the chart.
fn observe<S: Scene>(parameters: &Parameters, state: &State) -> Result<Option<Observed>, TestCaseError> {
    let kernel = S::kernel::<Bounded>(parameters);
    let t = Bounded::zero();
    let Ok((q, z)) = state.of(&kernel) else { return Ok(None) };
    let z_rate = kernel.acceleration(t, &q, &z, &());
    let observed = in_motion::<_, S::Kernel<Dual<Bounded>>>(&kernel, &S::kernel(parameters), state, (&q, &z, &z_rate))?;

    Ok(Some(observed))
}

fn in_motion<K: Body<Bounded>, D: Body<Dual<Bounded>>>(
    kernel: &K,
    dual: &D,
    state: &State,
    (q, z, z_rate): (&K::Configuration, &K::Speeds, &K::Speeds),
) -> Result<Observed, TestCaseError> {
    let (t, t_dual) = (Bounded::zero(), Dual::zero());
    let twist = kernel.body_twist(t, q, z);
    let (q_dual, z_dual) = flow::<_, K, D>(kernel, q, z, z_rate);

    // q̇ = ψ(q, z) moves the pose with the twist, in every chart.
    let pose = kernel.pose(t, q);
    let pose_rates = rates(&dual.pose(t_dual, &q_dual).parts());
    // A quaternion and its negative are one rotation; both are linear in the parts, so compare through the given pose.
    equal("rate of the pose", &pose_rates, &pose.rates(&twist))?;

    let acceleration = rates(&list(&dual.body_twist(t_dual, &q_dual, &z_dual)));

    // z is linear in the twist, so a body acceleration δ is the change of ż that `speeds` gives.
    let mut direction = SVector::from(state.direction.map(Bounded::from_f64));
    direction = kernel.body_twist(t, q, &kernel.speeds(t, q, &direction));
    let moved = z_rate.add_scaled(Bounded::one(), &kernel.speeds(t, q, &direction));
    let excess = kernel.constraint_function(t, q, z, &moved, &()) - kernel.constraint_function(t, q, z, z_rate, &());

    let scale = largest(&list(z_rate)).max(largest(&list(z)).powi(2)).max(largest(&acceleration));
    Ok(Observed {
        acceleration,
        twist: list(&twist),
        body_momentum: list(&kernel.body_momentum(t, q, z)),
        space_momentum: list(&kernel.space_momentum(t, q, z)),
        energies: [kernel.kinetic_energy(t, q, z), kernel.potential_energy(t, q)],
        excess,
        scale,
    })
}

fn compare(name: &str, one: &Observed, other: &Observed) -> Result<(), TestCaseError> {
    let what = |quantity: &str| format!("{name}: {quantity}");
    equal(&what("twist"), &one.twist, &other.twist)?;
    equal(&what("acceleration"), &one.acceleration, &other.acceleration)?;
    equal(&what("body momentum"), &one.body_momentum, &other.body_momentum)?;
    equal(&what("space momentum"), &one.space_momentum, &other.space_momentum)?;
    equal(&what("energies"), &one.energies, &other.energies)?;
    equal(&what("constraint function"), &[one.excess], &[other.excess])
}

/// The share of accelerations that must be proved equal to 1e-12 relative to the terms that enter; the others, near
/// singular points of their charts or for ill-conditioned bodies, are equal up to their bounds.
const SHARE: f64 = 0.7;

/// The reference chart against others, on random bodies and states.
macro_rules! same_motion {
    ($motion:ident: $reference:ident; $($chart:ident)+) => {
        #[test]
        fn is_the_same() {
            use super::*;
            explore(Motion::$motion, SHARE, |parameters, state, tally| {
                let reference = observe::<$reference<()>>(parameters, state)?.expect("regular everywhere");
                tally.count(&reference.acceleration, reference.scale);
                $(
                    if let Some(observed) = observe::<$chart<()>>(parameters, state)? {
                        compare(stringify!($chart), &reference, &observed)?;
                        tally.count(&observed.acceleration, observed.scale);
                    }
                )+
                Ok(())
            });
        }
    };
}

mod everything_free {
    usual_charts!(everything, free);
    other_charts!(everything, free);
    same_motion!(Free: Left; Right Hybrid Zyx Zxz Modified Xyz Xzy Yxz Yzx Zxy Zyz Xyx Xzx Yxy Yzy Rodrigues);
}

mod everything_fixed_point {
    usual_charts!(everything, fixed_point);
    other_charts!(everything, fixed_point);
    same_motion!(FixedPoint: Left; Right Hybrid Zyx Zxz Modified Xyz Xzy Yxz Yzx Zxy Zyz Xyx Xzx Yxy Yzy Rodrigues);
}

mod everything_planar {
    planar_charts!(everything);
    same_motion!(Planar: Left; Right Hybrid Jet);
}

mod principal_free {
    usual_charts!(principal, free);
    same_motion!(Free: Left; Right Hybrid Zyx Zxz Modified);
}

mod principal_fixed_point {
    usual_charts!(principal, fixed_point);
    same_motion!(FixedPoint: Left; Right Hybrid Zyx Zxz Modified);
}

mod principal_planar {
    planar_charts!(principal);
    same_motion!(Planar: Left; Right Hybrid Jet);
}

mod heavy_free {
    usual_charts!(heavy, free);
    same_motion!(Free: Left; Right Hybrid Zyx Zxz Modified);
}

mod heavy_fixed_point {
    usual_charts!(heavy, fixed_point);
    same_motion!(FixedPoint: Left; Right Hybrid Zyx Zxz Modified);
}

mod heavy_planar {
    planar_charts!(heavy);
    same_motion!(Planar: Left; Right Hybrid Jet);
}

mod torpedo_free {
    usual_charts!(torpedo, free);
    same_motion!(Free: Left; Right Hybrid Zyx Zxz Modified);
}

mod afloat_free {
    usual_charts!(afloat, free);
    same_motion!(Free: Left; Right Hybrid Zyx Zxz Modified);
}

mod afloat_planar {
    planar_charts!(afloat);
    same_motion!(Planar: Left; Right Hybrid Jet);
}

mod spherical_free {
    usual_charts!(spherical, free);
    same_motion!(Free: Left; Right Hybrid Zyx Zxz Modified);
}

/// The comparison is worth something: gravity wrong by one part in 10¹⁰ is noticed.
#[test]
fn a_wrong_parameter_is_noticed() {
    let (noticed, total) = (std::cell::Cell::new(0), std::cell::Cell::new(0));
    explore(Motion::Free, SHARE, |parameters, state, tally| {
        let one = observe::<heavy_free::Left<()>>(parameters, state)?.expect("regular everywhere");
        let wrong = Parameters { g: parameters.g * (1.0 + 1e-10), ..parameters.clone() };
        let other = observe::<heavy_free::Hybrid<()>>(&wrong, state)?.expect("regular everywhere");
        tally.count(&other.acceleration, other.scale);
        let difference = equal("acceleration", &one.acceleration, &other.acceleration);
        noticed.set(noticed.get() + u32::from(difference.is_err()));
        total.set(total.get() + 1);
        Ok(())
    });
    assert!(10 * noticed.get() >= 9 * total.get(), "{} of {}", noticed.get(), total.get());
}
