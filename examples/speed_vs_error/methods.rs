//! The methods of Gauss, one line each.

use gauss_runtime::integrate::body::BodyConfiguration;
use gauss_runtime::integrate::{
    Collocation, CommutatorFree4, Composed, Composition, Form, Scheme, Splitting, SplittingError, Variational,
};
use gauss_runtime::prelude::*;

use crate::entry::{Entry, Kernel, Setting, Setup};

/// The explicit methods, in both forms: for every chart.
pub fn explicit<S: Kernel>(entries: &mut Vec<Entry>, setup: &Setup<S>) {
    explicit_in(entries, setup, ("velocity", VelocityForm));
    explicit_in(entries, setup, ("momentum", MomentumForm));
}

fn explicit_in<S: Kernel, F: Form<S> + 'static>(entries: &mut Vec<Entry>, setup: &Setup<S>, form: (&'static str, F)) {
    use Setting::{Step, Tolerance};
    let s = setup;
    entries.extend([
        s.entry(("RKMK 4", Step(4)), form, Fixed::new),
        s.entry(("DP 5, fixed", Step(5)), form, |h| Fixed::with(&Tableau::DORMAND_PRINCE_5, h)),
        s.entry(("DP 5(4)", Tolerance), form, |tolerance| Adaptive::new(tolerance, tolerance)),
        s.entry(("DP 8, fixed", Step(8)), form, |h| Fixed::with(&Tableau::DORMAND_PRINCE_8, h)),
        s.entry(("DP 8", Tolerance), form, |tolerance| {
            Adaptive::with(&Tableau::DORMAND_PRINCE_8, tolerance, tolerance)
        }),
    ]);
}

/// The methods that keep something, and the commutator-free one: for the chart that suits the scene best.
pub fn further<S: Kernel>(entries: &mut Vec<Entry>, setup: &Setup<S>) {
    further_in(entries, setup, ("velocity", VelocityForm));
    further_in(entries, setup, ("momentum", MomentumForm));
}

fn further_in<S: Kernel, F: Form<S> + 'static>(entries: &mut Vec<Entry>, setup: &Setup<S>, form: (&'static str, F)) {
    use Setting::{Step, Tolerance};
    let s = setup;
    entries.extend([
        s.entry(("Verner 9(8)", Tolerance), form, |tolerance| Adaptive::with(&Tableau::VERNER_9, tolerance, tolerance)),
        s.entry(("CF 4", Step(4)), form, |h| Fixed::by(CommutatorFree4, h)),
        s.entry(("Gauss 2", Step(2)), form, |h| Fixed::by(Collocation::midpoint(), h)),
        s.entry(("Gauss 4", Step(4)), form, |h| Fixed::by(Collocation::order_4(), h)),
        s.entry(("Gauss 6", Step(6)), form, |h| Fixed::by(Collocation::order_6(), h)),
        s.entry(("Kahan–Li 8 of Gauss 2", Step(8)), form, |h| {
            Fixed::by(Composed::new(&Composition::KAHAN_LI_8, Collocation::midpoint()), h)
        }),
    ]);
}

/// Variational methods, which are for bodies in the left-invariant chart.
pub fn left_invariant<S: Kernel>(entries: &mut Vec<Entry>, setup: &Setup<S>)
where
    S::Configuration: Configuration<Tangent = S::Speeds>,
{
    let form = ("momentum", MomentumForm);
    entries.extend([
        setup.entry(("variational", Setting::Step(2)), form, |h| Fixed::by(Variational, h)),
        setup.entry(("Kahan–Li 6 of variational", Setting::Step(6)), form, |h| {
            Fixed::by(Composed::new(&Composition::KAHAN_LI_6, Variational), h)
        }),
    ]);
}

/// Methods for bodies that turn about O: free motion between kicks, exact or by discrete Moser–Veselov steps of order 10. Without
/// forces one step of the exact motion goes to the end.
///
/// # Errors
/// When the kernel is not such a body.
pub fn splitting<S: Kernel>(entries: &mut Vec<Entry>, setup: &Setup<S>, free: bool) -> Result<(), SplittingError>
where
    S::Configuration: BodyConfiguration<Tangent = S::Speeds, MassMatrix = S::MassMatrix>,
{
    use Setting::{Once, Step};
    let form = ("momentum", MomentumForm);
    let mut add = |name, setting, scheme: Scheme, exact: bool| {
        // Forces are looked at within a step, and once more by what makes the steps.
        let forces = scheme.kicks().len() as u64 + 1;
        let entry = if exact {
            let method = Splitting::exact(&setup.kernel, scheme)?;
            setup.entry((name, setting), form, move |h| Fixed::by(method, h))
        } else {
            let method = Splitting::discrete(&setup.kernel, scheme)?;
            setup.entry((name, setting), form, move |h| Fixed::by(method, h))
        };
        entries.push(entry.with_evaluations(forces));
        Ok(())
    };
    if free {
        add("exact motion", Once, Scheme::STRANG, true)?;
        return add("Moser–Veselov 10", Step(10), Scheme::STRANG, false);
    }
    add("RKN 4 of exact motion", Step(4), Scheme::BLANES_MOAN_4, true)?;
    add("RKN 4 of Moser–Veselov", Step(4), Scheme::BLANES_MOAN_4, false)?;
    add("Kahan–Li 6 of Moser–Veselov", Step(6), Scheme::KAHAN_LI_6, false)?;
    add("Kahan–Li 8 of Moser–Veselov", Step(8), Scheme::KAHAN_LI_8, false)
}
