//! Inputs of runs in lanes, with what controllers hold in each lane.

use core::cell::Cell;

use gauss_runtime::configuration::VectorSpace;
use gauss_runtime::integrate::InputSource;
use gauss_runtime::integrate::problem::sampled::Rest;
use gauss_runtime::simd::Packed;

use crate::lanes::BatchSystem;

/// The input of runs with controllers that sample: what they hold, and what a function of time and state adds.
#[derive(Clone, Copy, Debug)]
pub struct SampledInput<R>(pub(crate) R);

/// Kind of inputs that are functions of time and state.
#[derive(Debug)]
pub enum FunctionInput {}

/// Kind of inputs of which controllers hold a part.
#[derive(Debug)]
pub enum HoldInput {}

/// An input of runs in lanes, of a kind that is found by itself.
pub trait LaneInput<S: BatchSystem, Kind> {
    /// Room for what controllers hold in each lane.
    #[doc(hidden)]
    type Room;

    /// Room in which nothing is held.
    #[doc(hidden)]
    fn room() -> Self::Room;

    /// The input at a time in a state.
    #[doc(hidden)]
    fn input(&self, held: &Self::Room, t: S::Scalar, q: &S::Configuration, z: &S::Speeds) -> S::Input;

    /// The inputs that are held, where there are controllers.
    #[doc(hidden)]
    fn held(room: &Self::Room) -> Option<&Cell<S::Input>>;

    /// Holds an input in a lane.
    #[doc(hidden)]
    fn hold(room: &Self::Room, lane: usize, input: &S::Input);
}

#[diagnostic::do_not_recommend]
impl<S: BatchSystem, I: InputSource<S>> LaneInput<S, FunctionInput> for I {
    type Room = ();

    fn room() {}

    #[inline(always)]
    fn input(&self, (): &(), t: S::Scalar, q: &S::Configuration, z: &S::Speeds) -> S::Input {
        InputSource::input(self, t, q, z)
    }

    fn held((): &()) -> Option<&Cell<S::Input>> {
        None
    }

    fn hold((): &(), _: usize, _: &S::Input) {}
}

impl<S: BatchSystem<Input: VectorSpace<S::Scalar>>, R: Rest<S>> LaneInput<S, HoldInput> for SampledInput<R> {
    type Room = Cell<S::Input>;

    fn room() -> Cell<S::Input> {
        Cell::new(S::Input::zero())
    }

    #[inline(always)]
    fn input(&self, held: &Cell<S::Input>, t: S::Scalar, q: &S::Configuration, z: &S::Speeds) -> S::Input {
        self.0.with(held.get(), t, q, z)
    }

    fn held(room: &Cell<S::Input>) -> Option<&Cell<S::Input>> {
        Some(room)
    }

    fn hold(room: &Cell<S::Input>, lane: usize, input: &S::Input) {
        let mut all = room.get();
        for i in 0..S::Input::DIM {
            let mut component = all.component(i);
            component.replace(lane, &input.component(i).extract(lane));
            all.set_component(i, component);
        }
        room.set(all);
    }
}

/// The input of some lanes, with what controllers hold in them.
pub(crate) struct LaneSource<'a, S: BatchSystem, I: LaneInput<S, Kind>, Kind> {
    pub(crate) input: &'a I,
    pub(crate) room: I::Room,
}

impl<S: BatchSystem, I: LaneInput<S, Kind>, Kind> InputSource<S> for LaneSource<'_, S, I, Kind> {
    #[inline(always)]
    fn input(&self, t: S::Scalar, q: &S::Configuration, z: &S::Speeds) -> S::Input {
        self.input.input(&self.room, t, q, z)
    }

    #[inline(always)]
    fn held(&self) -> Option<&Cell<S::Input>> {
        I::held(&self.room)
    }
}
