//! A system that has no motion any more once it is told to stop: the run then ends with the last good state. Its gaps
//! are open: who runs it has chosen that, and contacts have runs of their own.

use std::ops::Deref;
use std::sync::atomic::{AtomicBool, Ordering};

use gauss_runtime::prelude::*;

/// The system of somebody else, or one of its own.
enum Owner<'a, S> {
    Lent(&'a S),
    Own(S),
}

impl<S> Deref for Owner<'_, S> {
    type Target = S;

    fn deref(&self) -> &S {
        match self {
            Self::Lent(system) => system,
            Self::Own(system) => system,
        }
    }
}

/// The system, and whether it shall stop.
pub struct Stoppable<'a, S> {
    system: Owner<'a, S>,
    /// Nobody stops one that has none.
    stop: Option<&'a AtomicBool>,
    over: AtomicBool,
}

impl<'a, S> Stoppable<'a, S> {
    /// A system that goes on until the flag is set, which many of them may share.
    pub fn new(system: &'a S, stop: &'a AtomicBool) -> Self {
        Self { system: Owner::Lent(system), stop: Some(stop), over: AtomicBool::new(false) }
    }

    /// A system that goes on as long as it is asked to.
    pub fn own(system: S) -> Self {
        Self { system: Owner::Own(system), stop: None, over: AtomicBool::new(false) }
    }

    /// Ends the run: whether it was told to stop. States between steps are made by the system, which moves on for that.
    pub fn end(&self) -> bool {
        self.over.store(true, Ordering::Relaxed);
        self.is_told()
    }

    fn is_told(&self) -> bool {
        self.stop.is_some_and(|stop| stop.load(Ordering::Relaxed))
    }
}

impl<S> Stoppable<'_, S> {
    fn or_none<T: Real, V: VectorSpace<T>>(&self, rates: V) -> V {
        let stops = self.is_told() && !self.over.load(Ordering::Relaxed);
        if stops { rates.scale(T::from_f64(f64::NAN)) } else { rates }
    }
}

impl<S: GaussSystem> GaussSystem for Stoppable<'_, S> {
    // Methods have a dozen stages: with the kernel in each of them they would take minutes to compile.
    gauss_runtime::forward_system! {
        #[inline(never)] S => system: types motion momenta energies condition constraints
    }

    const CHART: Chart = S::CHART;
    const CONSTRAINED: bool = S::CONSTRAINED;
    const STATES: usize = S::STATES;
    const SMOOTHNESS: Smoothness = S::SMOOTHNESS;

    #[inline(never)]
    fn acceleration(&self, t: S::Scalar, q: &S::Configuration, z: &S::Speeds, input: &S::Input) -> S::Speeds {
        self.or_none(self.system.acceleration(t, q, z, input))
    }

    #[inline(never)]
    fn momentum_rate(&self, t: S::Scalar, q: &S::Configuration, p: &S::Speeds, input: &S::Input) -> S::Speeds {
        self.or_none(self.system.momentum_rate(t, q, p, input))
    }
}

impl<S: LinearizedSystem> LinearizedSystem for Stoppable<'_, S> {
    type Linearization = S::Linearization;

    const STATE_PATTERN: &'static [&'static [bool]] = S::STATE_PATTERN;
    const INPUT_PATTERN: &'static [&'static [bool]] = S::INPUT_PATTERN;

    #[inline(never)]
    fn linearize(&self, t: S::Scalar, q: &S::Configuration, z: &S::Speeds, input: &S::Input) -> S::Linearization {
        self.system.linearize(t, q, z, input)
    }
}

impl<S: TaylorSystem> TaylorSystem for Stoppable<'_, S> {
    type Series = S::Series;

    const GROUPS: &'static [usize] = S::GROUPS;

    #[inline(never)]
    fn expand(&self, t: S::Scalar, q: &S::Configuration, z: &S::Speeds, order: usize, series: &mut S::Series) {
        self.system.expand(t, q, &self.or_none(*z), order, series);
    }
}
