//! The methods of Gauss: the table of the runtime, and one line for each that is not in it. What no forces act on has
//! more of them in `free_motion`.

use gauss_exact::BodyConfiguration;
use gauss_exact::{Scheme, Splitting, SplittingError};
use gauss_exact::{TopError, TopFlow};
use gauss_runtime::integrate::{
    Absent, Composed, Composition, EstimatingStep, Fixed, Form, JacobianMethod, Method, MethodControl, MethodPlace,
    StepSetting, Variational,
};
use gauss_runtime::prelude::*;

use super::counted::Counted;
use super::entry::{Entry, Kernel, Setting, Setup};

/// The methods of the table that are run on every chart; all others are for the chart that suits the scene best.
const EVERYWHERE: [Method; 5] =
    [Method::Classical4, Method::DormandPrince8, Method::Adams10, Method::Adams12, Method::Verner9];

/// These methods in both forms: for every chart.
pub fn explicit<S: Kernel>(entries: &mut Vec<Entry>, setup: &Setup<S>) {
    by_name(entries, setup, |method| EVERYWHERE.contains(&method));
}

/// All other methods of the table, those in the algebra, and a composition: for the chart that suits the scene best.
pub fn further<S: Kernel>(entries: &mut Vec<Entry>, setup: &Setup<S>) {
    by_name(entries, setup, |method| !EVERYWHERE.contains(&method));
    further_in(entries, setup, ("velocity", VelocityForm));
    further_in(entries, setup, ("momentum", MomentumForm));
}

fn by_name<S: Kernel>(entries: &mut Vec<Entry>, setup: &Setup<S>, wanted: impl Fn(Method) -> bool) {
    for &method in Method::ALL.iter().filter(|&&method| method.clause().is_none() && wanted(method)) {
        by_name_in::<S, _, Absent>(entries, setup, method, ("velocity", VelocityForm));
        by_name_in::<S, _, Absent>(entries, setup, method, ("momentum", MomentumForm));
    }
}

/// The methods of the table that need derivatives, for kernels with the clause `linearize`.
pub fn jacobians<S: Kernel + LinearizedSystem>(entries: &mut Vec<Entry>, setup: &Setup<S>) {
    for &method in Method::ALL.iter().filter(|method| method.clause() == Some("linearize")) {
        by_name_in::<S, _, JacobianMethod>(entries, setup, method, ("velocity", VelocityForm));
    }
}

fn by_name_in<S, F, R>(entries: &mut Vec<Entry>, s: &Setup<S>, method: Method, form: (&'static str, F))
where
    S: Kernel,
    F: Form<Counted<S>> + 'static,
    R: MethodPlace<JacobianMethod> + EstimatingStep<Counted<S>> + 'static,
{
    let of_length = move |h| MethodControl::<f64, R>::new(method, StepSetting::Equal(h)).expect("steps of one length");
    let tolerant = move |tolerance| {
        MethodControl::<f64, R>::new(method, StepSetting::tolerant(tolerance, tolerance))
            .expect("an estimate of errors")
    };
    if method.takes_length() {
        let setting = Setting::Step(method.order().expect("an order of steps of one length"));
        entries.push(s.entry((label(method, true), setting), form, of_length));
    }
    if method.keeps_tolerances() {
        entries.push(s.entry((label(method, false), Setting::Tolerance), form, tolerant));
    }
}

/// Short names for plots, with steps of one length or not.
fn label(method: Method, fixed: bool) -> &'static str {
    match (method, fixed) {
        (Method::Classical4, _) => "RK 4",
        (Method::CommutatorFree4, _) => "CF 4",
        (Method::DormandPrince5, true) => "DP 5, fixed",
        (Method::DormandPrince5, false) => "DP 5(4)",
        (Method::DormandPrince8, true) => "DP 8, fixed",
        (Method::DormandPrince8, false) => "DP 8",
        (Method::Verner9, true) => "Verner 9, fixed",
        (Method::Verner9, false) => "Verner 9(8)",
        (Method::Collocation2, _) => "Gauss 2",
        (Method::Collocation4, _) => "Gauss 4",
        (Method::Collocation6, _) => "Gauss 6",
        (Method::Adams10, _) => "Adams 10",
        (Method::Adams12, _) => "Adams 12",
        (other, _) => other.name(),
    }
}

fn further_in<S: Kernel, F: Form<Counted<S>> + 'static>(
    entries: &mut Vec<Entry>,
    s: &Setup<S>,
    form: (&'static str, F),
) {
    use Setting::{Step, Tolerance};
    entries.extend([
        s.entry(("RKMK 4", Step(4)), form, |h| Fixed::with(&Tableau::RK4, h)),
        s.entry(("RKMK 8", Tolerance), form, |tolerance| {
            Adaptive::with(&Tableau::DORMAND_PRINCE_8, tolerance, tolerance)
        }),
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
