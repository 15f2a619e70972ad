//! Jumps: the effect of an event on the state, and whether the state has changed.

use core::ops::Range;

use crate::configuration::VectorSpace;
use crate::integrate::problem::state::Sample;
use crate::real::Real;
use crate::sealed::Sealed;
use crate::system::GaussSystem;

/// The effect of an event on the state.
pub trait Jump<S: GaussSystem>: Sealed {
    /// Changes it; whether it does.
    fn jump(&mut self, state: &mut Sample<S>) -> bool;
}

/// No jump: the state stays as it is.
#[derive(Clone, Copy, Debug, Default)]
pub struct NoJump;

impl Sealed for NoJump {}

impl<S: GaussSystem> Jump<S> for NoJump {
    fn jump(&mut self, _: &mut Sample<S>) -> bool {
        false
    }
}

/// A jump by a function that changes the state.
#[derive(Clone, Copy, Debug)]
pub struct JumpFunction<J>(pub(in crate::integrate) J);

impl<J> Sealed for JumpFunction<J> {}

impl<S: GaussSystem, J: FnMut(&mut Sample<S>)> Jump<S> for JumpFunction<J> {
    fn jump(&mut self, state: &mut Sample<S>) -> bool {
        (self.0)(state);
        true
    }
}

/// Whether vectors differ in some lanes by more than a part of their size.
pub(in crate::integrate) fn differs<T: Real, V: VectorSpace<T>>(a: &V, b: &V, lanes: &Range<usize>, part: f64) -> bool {
    lanes.clone().any(|lane| {
        let size = (0..V::DIM).map(|i| a.component(i).lane(lane).abs()).fold(0.0, f64::max);
        (0..V::DIM).any(|i| {
            let off = (a.component(i).lane(lane) - b.component(i).lane(lane)).abs();
            off > part * size || off.is_nan()
        })
    })
}
