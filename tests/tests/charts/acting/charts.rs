//! Everything acts at once: all charts say the same of it, and so does the scene written as a system.

use std::cell::Cell;

use gauss_runtime::prelude::*;

use proptest::test_runner::TestCaseError;

use super::observed::{agree, columns_add_up, inputs, observe, time, variables};
use super::scenes::{Loads, Scene, fixed_point, free, planar, system};
use crate::common::Bounded;
use crate::common::agreement::{equal, explore};
use crate::common::body::{Scene as Bare, list, speeds};
use crate::common::dual::Dual;
use crate::common::parameters::Parameters;
use crate::common::states::{Motion, State};

/// The same body when nothing acts but weight and buoyancy.
mod bare {
    pub mod free {
        usual_charts!(everything, free);
    }
    pub mod fixed_point {
        usual_charts!(everything, fixed_point);
    }
    pub mod planar {
        planar_charts!(everything);
    }
}

/// The kernels of a scene in the number types of the checks.
type Pair<S> = (<S as Scene>::Kernel<Bounded>, <S as Scene>::Kernel<Dual<Bounded>>);

/// Of one scene in one chart.
fn pair<S: Scene>(parameters: &Parameters) -> Pair<S> {
    (S::kernel(parameters, &Loads::of(parameters)), S::kernel(parameters, &Loads::of(parameters)))
}

/// A body on which nothing acts but weight and buoyancy.
fn unloaded<S: Bare>(parameters: &Parameters) -> S::Kernel<Bounded> {
    S::kernel(parameters)
}

/// The share of accelerations with bounds below 1e-12: see `agreement`.
const SHARE: f64 = 0.5;

macro_rules! same_in_all_charts {
    ($($test:ident: $motion:ident $module:ident, $jet:ident;)+) => {$(
        #[test]
        fn $test() {
            explore(Motion::$motion, SHARE, |parameters, state, tally| {
                let (left, dual) = pair::<$module::Left<()>>(parameters);
                let reference = observe(&left, &dual, state)?.expect("regular everywhere");
                tally.count(&reference.acceleration, reference.scale);
                let (right, dual) = pair::<$module::Right<()>>(parameters);
                agree("right", &reference, &observe(&right, &dual, state)?.expect("regular everywhere"))?;
                let (hybrid, dual) = pair::<$module::Hybrid<()>>(parameters);
                agree("hybrid", &reference, &observe(&hybrid, &dual, state)?.expect("regular everywhere"))?;
                let (jet, dual) = pair::<$module::Jet<()>>(parameters);
                if let Some(observed) = observe(&jet, &dual, state)? {
                    agree("jet", &reference, &observed)?;
                }
                let none = ();
                columns_add_up(&left, (&unloaded::<bare::$module::Left<()>>(parameters), &none), state)?;
                columns_add_up(&right, (&unloaded::<bare::$module::Right<()>>(parameters), &none), state)?;
                columns_add_up(&hybrid, (&unloaded::<bare::$module::Hybrid<()>>(parameters), &none), state)?;
                columns_add_up(&jet, (&unloaded::<bare::$module::$jet<()>>(parameters), &none), state)
            });
        }
    )+};
}

same_in_all_charts! {
    a_free_body: Free free, Zyx;
    a_body_with_a_fixed_point: FixedPoint fixed_point, Zyx;
    a_body_in_the_plane: Planar planar, Jet;
}

/// A system in the variables of a chart says what the chart says, method by method.
fn same_numbers<S>(parameters: &Parameters, system: &S, state: &State) -> Result<(), TestCaseError>
where
    S: GaussSystem<
            Scalar = Bounded,
            Configuration = Isometry3<Bounded>,
            Speeds = SVector<Bounded, 6>,
            Input = SVector<Bounded, 10>,
        > + ForcedSystem,
{
    let chart = free::Left::of::<Bounded>(parameters, &Loads::of(parameters));
    let (q, z) = variables(&chart, state).expect("regular everywhere");
    let (t, input) = (time(), inputs(state));
    let other: SVector<Bounded, 6> = speeds(&state.direction.map(Bounded::from_f64));
    let p = chart.momentum(t, &q, &z);
    equal("q̇", &list(&chart.kinematics(t, &q, &z)), &list(&system.kinematics(t, &q, &z)))?;
    equal("ż", &list(&chart.acceleration(t, &q, &z, &input)), &list(&system.acceleration(t, &q, &z, &input)))?;
    equal("p", &list(&p), &list(&system.momentum(t, &q, &z)))?;
    equal("ṗ", &list(&chart.momentum_rate(t, &q, &p, &input)), &list(&system.momentum_rate(t, &q, &p, &input)))?;
    equal(
        "residual",
        &list(&chart.gauss_residual(t, &q, &z, &other, &input)),
        &list(&system.gauss_residual(t, &q, &z, &other, &input)),
    )?;
    equal(
        "energies",
        &[chart.kinetic_energy(t, &q, &z), chart.potential_energy(t, &q), chart.supplied_power(t, &q, &z, &input)],
        &[system.kinetic_energy(t, &q, &z), system.potential_energy(t, &q), system.supplied_power(t, &q, &z, &input)],
    )?;
    assert_eq!(<free::LeftKernel<Bounded> as ForcedSystem>::ELEMENTS, S::ELEMENTS);
    equal("powers", &list(&chart.powers(t, &q, &z, &input)), &list(&system.powers(t, &q, &z, &input)))?;
    for element in S::ELEMENTS {
        let of_chart = chart.generalised_force(element.name, t, &q, &z, &input).expect("listed");
        let of_system = system.generalised_force(element.name, t, &q, &z, &input).expect("listed");
        equal(element.name, &list(&of_chart), &list(&of_system))?;
    }
    Ok(())
}

#[test]
fn a_free_body_as_a_system() {
    explore(Motion::Free, 1.0, |parameters, state, tally| {
        same_numbers(parameters, &system::Posed::of::<Bounded>(parameters, &Loads::of(parameters)), state)?;
        tally.count(&[Bounded::zero()], 1.0);
        Ok(())
    });
}

/// The comparison is worth something: one stiffness wrong by one part in 10¹⁰ is noticed.
#[test]
fn a_wrong_parameter_is_noticed() {
    let (noticed, total) = (Cell::new(0), Cell::new(0));
    explore(Motion::Free, SHARE, |parameters, state, tally| {
        let (left, dual) = pair::<free::Left<()>>(parameters);
        let right = observe(&left, &dual, state)?.expect("regular everywhere");
        tally.count(&right.acceleration, right.scale);
        let loads = Loads::<f64>::of(parameters);
        let stiff = loads.stiff * (1.0 + 1e-10);
        let kernel = free::Left::of(parameters, &Loads { stiff: Bounded::from_f64(stiff), ..Loads::of(parameters) });
        let dual = free::Left::of(parameters, &Loads { stiff: Dual::from_f64(stiff), ..Loads::of(parameters) });
        let wrong = observe(&kernel, &dual, state)?.expect("regular everywhere");
        noticed.set(noticed.get() + u32::from(agree("left", &right, &wrong).is_err()));
        total.set(total.get() + 1);
        Ok(())
    });
    assert!(10 * noticed.get() >= 9 * total.get(), "{} of {}", noticed.get(), total.get());
}
