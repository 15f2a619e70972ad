//! Derivatives of a step by state, input and parameters.

use alloc::vec::Vec;

use gauss_runtime::configuration::{Configuration, VectorSpace};
use gauss_runtime::contact::ContactSystem;
use gauss_runtime::dual::Dual;
use gauss_runtime::integrate::problem::state::TangentOf;
use gauss_runtime::nalgebra::SMatrix;
use gauss_runtime::system::GaussSystem;

use crate::error::{ContactError, ContactErrorKind};

use super::edges::AtChange;
use super::followed::{Same, State, part};
use super::relaxed::StepLaw;
use super::report::StepReport;
use super::stepper::ContactStepper;
use super::stiffness::LastForces;
use super::watch::Seen;

/// A step with the derivatives of its end by its start, by the input, and by parameters.
///
/// D counts the components of (σ, δz): increments of the configuration seen from the body, `q ∘ exp(σ)`, at the start
/// from the state there and at the end from that one; then the quasi-velocities. U counts those of the input, P
/// parameters.
///
/// Derivatives are those of the modes that contacts have in the step, by the theorem on implicit functions; nothing is
/// smoothed. Where a contact is at a change of its mode they hold on one side of it alone: `at_change` names it.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct StepDerivatives<const D: usize, const U: usize, const P: usize> {
    /// ∂(σ⁺, z⁺)/∂(σ, z).
    pub by_state: SMatrix<f64, D, D>,
    /// ∂(σ⁺, z⁺)/∂input.
    pub by_input: SMatrix<f64, D, U>,
    /// ∂(σ⁺, z⁺)/∂parameters: directions 0 to P − 1 of the system in dual numbers.
    pub by_parameters: SMatrix<f64, D, P>,
    /// A contact that is at a change of its mode, within the tolerance of the laws: derivatives are one-sided.
    pub at_change: Option<AtChange>,
    /// Report of the step.
    pub report: StepReport,
    /// Number of times that the step was made in dual numbers.
    pub passes: usize,
}

/// The rounding of rates, as a part of the speeds, at which two systems cannot be told from one another.
const NO_DIGITS: f64 = 1e-7;

/// Time and state at the start of a step.
type Start<K> = (f64, <K as GaussSystem>::Configuration, <K as GaussSystem>::Speeds);

/// A matrix of derivatives by N directions of a pass, column by column.
type Slopes<const D: usize, const N: usize> = SMatrix<f64, D, N>;

impl<K: ContactSystem<Scalar = f64>, M: AsMut<[f64]>> ContactStepper<'_, K, M> {
    /// One step of length `h`, as [`step`](Self::step), with its derivatives.
    ///
    /// `dual` is the same system in dual numbers: of a struct `Robot<T>` that with `Dual::constant` in the place of
    /// each parameter, and `Dual::variable(x, k)` in that of parameter number k by which derivatives are wanted. N
    /// directions are worked on at once, as many passes are made as are needed, and one for parameters. Eight is a good
    /// number for few bodies; of robots with a dozen joints kernels in more than two directions take minutes to compile
    /// where they are optimised. It allocates.
    ///
    /// The step is a function of time, state, input and parameters: the acceleration of the step before, which
    /// [`StepScheme::Midpoint`](super::StepScheme::Midpoint) keeps, is left out, so that the step is made twice as at a
    /// start. A restitution of 0 could only grow: derivatives by it are given as 0. Of contacts that depend on one
    /// another impulses have derivatives of least norm; those of speeds are unique.
    ///
    /// ```
    /// use gauss_contact::ContactStepper;
    /// use gauss_runtime::dual::Dual;
    /// use gauss_runtime::prelude::*;
    ///
    /// /// A sledge on the floor.
    /// #[derive(GaussDynamics)]
    /// #[gauss(
    ///     coordinates(x, height),
    ///     particle(mass = 2, position = [x, 0, height]),
    ///     contact(floor, gap = height, slip = rate(x), friction = mu),
    ///     input(push),
    ///     drive(x = push),
    /// )]
    /// struct Sledge<T> {
    ///     mu: T,
    ///     #[gauss(gravity)]
    ///     g: T,
    /// }
    ///
    /// # fn main() -> Result<(), Box<dyn std::error::Error>> {
    /// let kernel = Sledge { mu: 0.3, g: 9.81 }.kernel()?;
    /// let dual = Sledge { mu: Dual::<4>::variable(0.3, 0), g: Dual::constant(9.81) }.kernel()?;
    /// let (q, z) = (SVector::zeros(), SVector::from([1.0, 0.0]));
    /// let mut stepper = ContactStepper::new(&kernel, 0.0, q, z)?;
    /// let step = stepper.step_with_derivatives::<_, 4, 4, 1, 1>(0.01, &SVector::from([0.5]), &dual)?;
    /// // ẋ⁺ = ẋ + h push/m − h μ g.
    /// assert!((step.by_state[(2, 2)] - 1.0).abs() < 1e-14);
    /// assert!((step.by_input[(2, 0)] - 0.01 / 2.0).abs() < 1e-16);
    /// assert!((step.by_parameters[(2, 0)] + 0.01 * 9.81).abs() < 1e-15);
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// # Errors
    /// As of [`step`](Self::step); `NotCoulomb` under another law; `NoDerivative` where contacts depend on one another
    /// at the state, but not nearby, or jam; `OtherSystem` where the system in dual numbers is another one; `NonFinite`
    /// where derivatives are not finite. The state is then that before the step.
    pub fn step_with_derivatives<L, const N: usize, const D: usize, const U: usize, const P: usize>(
        &mut self,
        h: f64,
        input: &K::Input,
        dual: &L,
    ) -> Result<StepDerivatives<D, U, P>, ContactError>
    where
        L: ContactSystem<Scalar = Dual<N>>,
        K::Input: VectorSpace<f64>,
        L::Input: VectorSpace<Dual<N>>,
    {
        const {
            assert!(D == TangentOf::<K>::DIM + K::Speeds::DIM, "D counts increments and speeds");
            assert!(U == <K::Input as VectorSpace<f64>>::DIM, "U counts the components of the input");
            assert!(N > 0 && P <= N, "a dual number has as many directions as parameters, at least");
            assert!(
                D == TangentOf::<L>::DIM + L::Speeds::DIM
                    && K::Speeds::DIM == L::Speeds::DIM
                    && U == <L::Input as VectorSpace<Dual<N>>>::DIM
                    && K::Gaps::DIM == L::Gaps::DIM
                    && K::ContactRows::DIM == L::ContactRows::DIM,
                "the system in dual numbers is another one"
            );
        }
        if self.law != StepLaw::Coulomb {
            return Err(self.error(None, ContactErrorKind::NotCoulomb));
        }
        let before = self.kept();
        // Without the forces of the step before a step is a function of the state.
        self.last = LastForces::default();
        let mut seen = Seen::default();
        let made = self.watched(h, input, &mut seen).and_then(|report| {
            let made = self.differentiated(dual, &(before.t, before.q, before.z), input, &seen);
            let made = made.map_err(|kind| ContactError { contact: None, time: before.t, kind: self.of_jam(kind) })?;
            Ok(StepDerivatives { report, ..made })
        });
        if made.is_err() {
            self.restore(&before);
        }
        made
    }

    /// The derivatives of a step that was made.
    fn differentiated<L, const N: usize, const D: usize, const U: usize, const P: usize>(
        &self,
        dual: &L,
        start: &Start<K>,
        input: &K::Input,
        seen: &Seen,
    ) -> Result<StepDerivatives<D, U, P>, ContactErrorKind>
    where
        L: ContactSystem<Scalar = Dual<N>>,
        K::Input: VectorSpace<f64>,
        L::Input: VectorSpace<Dual<N>>,
    {
        let (scheme, tolerance) = (self.scheme, self.tolerance);
        let mut same = Same { scheme, tolerance, looks: true, at_change: None, solvable: Vec::new(), solved: 0 };
        // Of parameters alone: what the directions of the others have as well.
        let own = self.pass::<L, N, D>(dual, (start, input), seen, (&mut same, usize::MAX))?;
        same.looks = false;
        let (mut by_state, mut by_input) = (SMatrix::<f64, D, D>::zeros(), SMatrix::<f64, D, U>::zeros());
        let mut passes = 1;
        for first in (0..D + U).step_by(N) {
            let slopes = self.pass::<L, N, D>(dual, (start, input), seen, (&mut same, first))? - own;
            passes += 1;
            for direction in first..(first + N).min(D + U) {
                let column = slopes.column(direction - first);
                if direction < D {
                    by_state.set_column(direction, &column);
                } else {
                    by_input.set_column(direction - D, &column);
                }
            }
        }
        let by_parameters = own.fixed_columns::<P>(0).into_owned();
        let (at_change, report) = (same.at_change, StepReport::default());
        Ok(StepDerivatives { by_state, by_input, by_parameters, at_change, report, passes })
    }

    /// Why a step has no derivatives: the impulses of a jam leave no digits to tell the system in dual numbers by.
    fn of_jam(&self, kind: ContactErrorKind) -> ContactErrorKind {
        let is_jammed = self.report.residual.rounding > NO_DIGITS * (1.0 + self.z.max_norm());
        match kind {
            ContactErrorKind::OtherSystem { .. } if is_jammed => ContactErrorKind::NoDerivative,
            kind => kind,
        }
    }

    /// The step once more, with derivatives by N directions from a first one.
    fn pass<L, const N: usize, const D: usize>(
        &self,
        dual: &L,
        (start, input): (&Start<K>, &K::Input),
        seen: &Seen,
        (same, first): (&mut Same, usize),
    ) -> Result<Slopes<D, N>, ContactErrorKind>
    where
        L: ContactSystem<Scalar = Dual<N>>,
        K::Input: VectorSpace<f64>,
        L::Input: VectorSpace<Dual<N>>,
    {
        let components = TangentOf::<L>::DIM;
        let q = L::Configuration::from_components(&lifted(&start.1.components()));
        // The directions of a space whose first one has a number.
        let q = q.retract(&varied(TangentOf::<L>::zero(), 0, first));
        let z = varied(lifted(&start.2), components, first);
        let input: L::Input = varied(lifted(input), D, first);
        let mut state = State { q, z, acceleration: None };
        same.solved = 0;
        for of in &seen.parts {
            state = part(dual, &input, (of, same), &state)?;
        }
        self.check(start, &state)?;
        let (q, mut slopes) = (state.q.components(), Slopes::<D, N>::zeros());
        for k in 0..N {
            let mut change = <K::Configuration as Configuration>::Components::zero();
            (0..<K::Configuration as Configuration>::Components::DIM)
                .for_each(|i| change.set_component(i, q.component(i).slopes[k]));
            let along = self.q.tangent(&change);
            for i in 0..D {
                slopes[(i, k)] =
                    if i < components { along.component(i) } else { state.z.component(i - components).slopes[k] };
            }
        }
        if slopes.iter().all(|slope| slope.is_finite()) { Ok(slopes) } else { Err(ContactErrorKind::NonFinite) }
    }

    /// Whether a step in dual numbers ends where that in `f64` does.
    fn check<L: ContactSystem<Scalar = Dual<N>>, const N: usize>(
        &self,
        start: &Start<K>,
        end: &State<L>,
    ) -> Result<(), ContactErrorKind> {
        let (there, here) = (end.q.components(), self.q.components());
        let of_places = (0..<K::Configuration as Configuration>::Components::DIM)
            .map(|i| (there.component(i).value - here.component(i)).abs() / (1.0 + here.component(i).abs()));
        let size = 1.0 + self.z.max_norm().max(start.2.max_norm());
        let of_speeds = (0..K::Speeds::DIM).map(|i| (end.z.component(i).value - self.z.component(i)).abs() / size);
        let largest = |a: f64, b: f64| if b.is_nan() { f64::NAN } else { a.max(b) };
        let difference = of_places.chain(of_speeds).fold(0.0, largest);
        // Where contacts jam, a step is known no better than to what its laws are off by. Written so that what is not a
        // number is another system.
        let allowed = 1e-7 + 100.0 * self.tolerance + 10.0 * self.report.residual.worst();
        if difference <= allowed { Ok(()) } else { Err(ContactErrorKind::OtherSystem { difference }) }
    }
}

/// The same numbers, which do not change.
fn lifted<A: VectorSpace<f64>, B: VectorSpace<Dual<N>>, const N: usize>(from: &A) -> B {
    let mut to = B::zero();
    (0..A::DIM).for_each(|i| to.set_component(i, Dual::constant(from.component(i))));
    to
}

/// Numbers, of which the first is that of direction `offset` among all, with the directions of a pass.
fn varied<V: VectorSpace<Dual<N>>, const N: usize>(mut of: V, offset: usize, first: usize) -> V {
    for k in 0..N {
        let Some(i) = first.checked_add(k).and_then(|direction| direction.checked_sub(offset)) else { continue };
        if i < V::DIM {
            of.set_component(i, of.component(i) + Dual { value: 0.0, ..Dual::variable(0.0, k) });
        }
    }
    of
}

#[cfg(test)]
#[path = "derivatives_tests.rs"]
mod tests;
