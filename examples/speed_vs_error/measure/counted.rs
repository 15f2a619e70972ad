//! A kernel that counts how often its equations are evaluated, whatever a method does with them.
//!
//! A method that asks a trait of its own of a kernel needs that trait passed on here.

use std::cell::Cell;

use gauss_runtime::prelude::*;

/// A kernel and a count of its accelerations, rates of momentum, linearisations and series. Runs that are timed count
/// too, as those of the baselines do: it is one addition an evaluation.
#[derive(Clone)]
pub struct Counted<S> {
    kernel: S,
    count: Cell<u64>,
}

impl<S> Counted<S> {
    /// Nothing evaluated yet.
    pub fn new(kernel: S) -> Self {
        Self { kernel, count: Cell::new(0) }
    }

    /// So many accelerations and rates of momentum were asked for.
    pub fn evaluations(&self) -> u64 {
        self.count.get()
    }

    #[inline(always)]
    fn counting(&self) -> &S {
        self.count.set(self.count.get() + 1);
        &self.kernel
    }
}

impl<S: GaussSystem> GaussSystem for Counted<S> {
    gauss_runtime::forward_system! {
        #[inline(always)] S => kernel: types constants motion momenta energies condition constraints
    }

    #[inline(always)]
    fn acceleration(&self, t: S::Scalar, q: &S::Configuration, z: &S::Speeds, input: &S::Input) -> S::Speeds {
        self.counting().acceleration(t, q, z, input)
    }

    #[inline(always)]
    fn momentum_rate(&self, t: S::Scalar, q: &S::Configuration, p: &S::Speeds, input: &S::Input) -> S::Speeds {
        self.counting().momentum_rate(t, q, p, input)
    }
}

impl<S: LinearizedSystem> LinearizedSystem for Counted<S> {
    type Linearization = S::Linearization;

    const STATE_PATTERN: &'static [&'static [bool]] = S::STATE_PATTERN;
    const INPUT_PATTERN: &'static [&'static [bool]] = S::INPUT_PATTERN;

    #[inline(always)]
    fn linearize(&self, t: S::Scalar, q: &S::Configuration, z: &S::Speeds, input: &S::Input) -> S::Linearization {
        self.counting().linearize(t, q, z, input)
    }
}

impl<S: TaylorSystem> TaylorSystem for Counted<S> {
    type Series = S::Series;

    const GROUPS: &'static [usize] = S::GROUPS;

    #[inline(always)]
    fn expand(&self, t: S::Scalar, q: &S::Configuration, z: &S::Speeds, order: usize, series: &mut S::Series) {
        self.counting().expand(t, q, z, order, series);
    }
}
