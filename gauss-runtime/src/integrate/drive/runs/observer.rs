//! Who sees the samples of a run.

use crate::integrate::problem::state::Sample;
use crate::system::GaussSystem;

/// Sees the samples of a run as they come.
pub trait Observer<S: GaussSystem> {
    /// One sample, in the order of integration.
    fn see(&mut self, sample: &Sample<S>);

    /// An event, by its number, before the sample that ends its step.
    fn event(&mut self, number: usize, sample: &Sample<S>) {
        let _ = (number, sample);
    }
}

impl<S: GaussSystem, O: Observer<S> + ?Sized> Observer<S> for &mut O {
    fn see(&mut self, sample: &Sample<S>) {
        (**self).see(sample);
    }

    fn event(&mut self, number: usize, sample: &Sample<S>) {
        (**self).event(number, sample);
    }
}

/// Nobody looks.
#[derive(Clone, Copy, Debug, Default)]
pub struct Unobserved;

impl<S: GaussSystem> Observer<S> for Unobserved {
    fn see(&mut self, _: &Sample<S>) {}
}

/// A function that is called with every sample.
#[derive(Clone, Copy, Debug)]
pub struct Callback<G>(pub(in crate::integrate) G);

impl<S: GaussSystem, G: FnMut(&Sample<S>)> Observer<S> for Callback<G> {
    fn see(&mut self, sample: &Sample<S>) {
        (self.0)(sample);
    }
}
