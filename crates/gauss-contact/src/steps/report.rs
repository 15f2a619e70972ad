//! Schemes of steps, and the report of one.

use gauss_runtime::configuration::VectorSpace;

use crate::residual::Residual;

/// Scheme by which a step takes the motion between impacts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum StepScheme {
    /// Moreau and Jean's, θ = ½: accelerations at half of the step, with the mean of the speeds before it and after it,
    /// from attempts with foreseen ones. A step is a function of its start alone, and is made three times; it is smooth
    /// in its start but where it is made again, as of a body that turns by more than a tenth of a radian. Springs are
    /// followed up to ωh = 1, with ω of what swings on them, where the energy of what swings undamped goes to and fro
    /// by a third; stiffer ones are refused as [`StiffSprings`](crate::ContactErrorKind::StiffSprings).
    MoreauJean,
    /// Accelerations at half of the step, with the speeds there that the acceleration of the step before foresees, for
    /// a third of the work: only the first step and those after impacts are made twice. A step whose mean speeds turn
    /// out to be other ones, as of a body that spins fast, is made until forces are those at the mean speeds; where
    /// springs are stiff, at the mean place as well.
    #[default]
    Midpoint,
}

/// Report of a step.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct StepReport {
    /// The worst residuals of all contacts, in the units of rates.
    pub residual: Residual,
    /// Distance of the step from Coulomb's law. Under [`StepLaw::Coulomb`](super::StepLaw::Coulomb) that is `residual`;
    /// under the relaxed law `signorini` of it is the largest rate at which what slides separates.
    pub from_coulomb: Residual,
    /// The largest gap below zero before the projection, as a positive number.
    pub penetration: f64,
    /// Largest distance from zero of gaps that stay closed, before the projection, above it too: the way on which a
    /// contact closes within the step.
    pub closure: f64,
    /// Contacts with an impulse.
    pub closed: usize,
    /// Corrections of the solver: systems of linear equations that were solved.
    pub corrections: u32,
    /// Sweeps of the solver, where corrections alone came to no end.
    pub sweeps: u32,
    /// The work of contact impulses on the speeds that the step would end with without them, of friction too: negative
    /// where they take energy away. What holds a weight therefore takes the energy that it would gain in the step:
    /// balances of energy are formed from rates before and after the step. Newton's law with friction can give energy
    /// at an impact (T. R. Kane 1984); then it is positive.
    pub work: f64,
    /// The energy that a step with an impact, or one whose forces do not settle, gained for no reason: beyond what
    /// impulses take and what all other forces and surfaces that move do; negative where it lost some. It is the error
    /// of a step in which speeds jump, of first order in its length, and what Newton's law gives with friction.
    pub unexplained: f64,
    /// In how many parts the step was made, where no impulses were found for all of it, gaps did not close at its end,
    /// it was too long for its forces, or an impact gained energy; else 0.
    pub parts: u32,
    /// The length of the step.
    pub length: f64,
    /// Gaps that have closed, or from which an impact passed something on.
    pub impacts: usize,
    /// Largest error of the step, over the tolerance, where a run has one ([`AdaptiveContactSteps`]); else 0.
    ///
    /// [`AdaptiveContactSteps`]: super::AdaptiveContactSteps
    pub estimate: f64,
}

impl StepReport {
    /// The mean forces of impulses over the step.
    pub(crate) fn mean<R: VectorSpace<f64>>(&self, impulses: &R) -> R {
        if self.length > 0.0 { impulses.scale(1.0 / self.length) } else { R::zero() }
    }

    /// Report of two parts of a step as one.
    pub(super) fn and(self, later: Self) -> Self {
        Self {
            residual: self.residual.worse(later.residual),
            from_coulomb: self.from_coulomb.worse(later.from_coulomb),
            penetration: self.penetration.max(later.penetration),
            closure: self.closure.max(later.closure),
            closed: later.closed,
            corrections: self.corrections + later.corrections,
            sweeps: self.sweeps + later.sweeps,
            work: self.work + later.work,
            unexplained: self.unexplained + later.unexplained,
            parts: self.parts.max(1) + later.parts.max(1),
            length: self.length + later.length,
            impacts: self.impacts + later.impacts,
            estimate: self.estimate.max(later.estimate),
        }
    }
}
