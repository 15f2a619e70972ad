//! The methods of Gauss, one line each. What no forces act on has more of them in `free_motion`.

use gauss_exact::BodyConfiguration;
use gauss_exact::{Scheme, Splitting, SplittingError};
use gauss_exact::{TopError, TopFlow};
use gauss_runtime::integrate::{Adams, Composed, Composition, Fixed, Form, Variational};
use gauss_runtime::prelude::*;

use super::counted::Counted;
use super::entry::{Entry, Kernel, Setting, Setup};

/// The explicit methods, in both forms: for every chart.
pub fn explicit<S: Kernel>(entries: &mut Vec<Entry>, setup: &Setup<S>) {
    explicit_in(entries, setup, ("velocity", VelocityForm));
    explicit_in(entries, setup, ("momentum", MomentumForm));
}

fn explicit_in<S: Kernel, F: Form<Counted<S>> + 'static>(
    entries: &mut Vec<Entry>,
    s: &Setup<S>,
    form: (&'static str, F),
) {
    use Setting::{Step, Tolerance};
    entries.extend([
        s.entry(("RK 4", Step(4)), form, |h| Fixed::by(RungeKutta(Classical4), h)),
        s.entry(("DP 8, fixed", Step(8)), form, |h| Fixed::by(RungeKutta(DormandPrince8), h)),
        s.entry(("Adams 10", Step(9)), form, Adams::<_, 10>::new),
        s.entry(("Adams 12", Step(9)), form, Adams::<_, 12>::new),
        s.entry(("DP 8", Tolerance), form, |tolerance| Adaptive::by(RungeKutta(DormandPrince8), tolerance, tolerance)),
        s.entry(("Verner 9(8)", Tolerance), form, |tolerance| Adaptive::by(RungeKutta(Verner9), tolerance, tolerance)),
    ]);
}

/// Order 5, the methods in the algebra, and those that keep something: for the chart that suits the scene best.
pub fn further<S: Kernel>(entries: &mut Vec<Entry>, setup: &Setup<S>) {
    further_in(entries, setup, ("velocity", VelocityForm));
    further_in(entries, setup, ("momentum", MomentumForm));
}

fn further_in<S: Kernel, F: Form<Counted<S>> + 'static>(
    entries: &mut Vec<Entry>,
    s: &Setup<S>,
    form: (&'static str, F),
) {
    use Setting::{Step, Tolerance};
    entries.extend([
        s.entry(("DP 5, fixed", Step(5)), form, |h| Fixed::by(RungeKutta(DormandPrince5), h)),
        s.entry(("DP 5(4)", Tolerance), form, |tolerance| {
            Adaptive::by(RungeKutta(DormandPrince5), tolerance, tolerance)
        }),
        s.entry(("RKMK 4", Step(4)), form, |h| Fixed::with(&Tableau::RK4, h)),
        s.entry(("RKMK 8", Tolerance), form, |tolerance| {
            Adaptive::with(&Tableau::DORMAND_PRINCE_8, tolerance, tolerance)
        }),
        s.entry(("CF 4", Step(4)), form, |h| Fixed::by(CommutatorFree4, h)),
        s.entry(("Gauss 2", Step(2)), form, |h| Fixed::by(Collocation::midpoint(), h)),
        s.entry(("Gauss 4", Step(4)), form, |h| Fixed::by(Collocation::order_4(), h)),
        s.entry(("Gauss 6", Step(6)), form, |h| Fixed::by(Collocation::order_6(), h)),
        s.entry(("Kahan–Li 8 of Gauss 2", Step(8)), form, |h| {
            Fixed::by(Composed::new(&Composition::KAHAN_LI_8, Collocation::midpoint()), h)
        }),
    ]);
}

/// Power series in time, for kernels with the clause `taylor`.
pub fn series<S: Kernel + TaylorSystem>(entries: &mut Vec<Entry>, s: &Setup<S>) {
    let form = ("velocity", VelocityForm);
    entries.push(s.entry(("Taylor", Setting::Tolerance), form, |tolerance| Taylor::new(tolerance, tolerance)));
}

/// Variational methods, which are for bodies in the left-invariant chart.
pub fn left_invariant<S: Kernel>(entries: &mut Vec<Entry>, s: &Setup<S>)
where
    S::Configuration: Configuration<Tangent = S::Speeds>,
{
    use Setting::Step;
    let form = ("momentum", MomentumForm);
    entries.extend([
        s.entry(("variational", Step(2)), form, |h| Fixed::by(Variational, h)),
        s.entry(("Kahan–Li 6 of variational", Step(6)), form, |h| {
            Fixed::by(Composed::new(&Composition::KAHAN_LI_6, Variational), h)
        }),
    ]);
}

/// Kicks of force between free motions: for bodies that turn about O, left-invariant chart.
///
/// # Errors
/// When the kernel is not such a body.
pub fn splitting<S: Kernel>(entries: &mut Vec<Entry>, s: &Setup<S>) -> Result<(), SplittingError>
where
    S::Configuration: BodyConfiguration<Tangent = S::Speeds, MassMatrix = S::MassMatrix>,
{
    use Setting::{LongStep, Step};
    let form = ("momentum", MomentumForm);
    let exact = |name, order, scheme| {
        let method = Splitting::exact(&s.kernel, scheme)?;
        Ok(s.entry((name, LongStep(order)), form, move |h| Fixed::by(method, h)))
    };
    let discrete = |name, order, scheme| {
        let method = Splitting::discrete(&s.kernel, scheme)?;
        Ok(s.entry((name, Step(order)), form, move |h| Fixed::by(method, h)))
    };
    entries.extend([
        exact("splitting 2, exact flow", 2, Scheme::STRANG)?,
        exact("splitting 4, exact flow", 4, Scheme::BLANES_MOAN_4)?,
        exact("splitting 6, exact flow", 6, Scheme::KAHAN_LI_6)?,
        exact("splitting 6 of Blanes and Moan, exact flow", 6, Scheme::BLANES_MOAN_6)?,
        exact("splitting 8, exact flow", 8, Scheme::KAHAN_LI_8)?,
        discrete("splitting 2, Moser–Veselov", 2, Scheme::STRANG)?,
        discrete("splitting 4, Moser–Veselov", 4, Scheme::BLANES_MOAN_4)?,
        discrete("splitting 6, Moser–Veselov", 6, Scheme::KAHAN_LI_6)?,
        discrete("splitting 8, Moser–Veselov", 8, Scheme::KAHAN_LI_8)?,
    ]);
    Ok(())
}

/// The exact motion of a heavy body of revolution about a point of its axis, left-invariant chart.
///
/// # Errors
/// When the kernel is not such a body.
pub fn exact_top<S>(entries: &mut Vec<Entry>, s: &Setup<S>) -> Result<(), TopError>
where
    S: Kernel + GaussSystem<Configuration = UnitQuaternion<f64>>,
    S: GaussSystem<Speeds = Vector3<f64>, MassMatrix = Matrix3<f64>>,
{
    let flow = TopFlow::new(&s.kernel)?;
    entries.push(s.entry(("exact flow", Setting::Once), ("velocity", VelocityForm), move |h| Fixed::by(flow, h)));
    Ok(())
}
