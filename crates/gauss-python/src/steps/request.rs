//! Requests for runs.

use std::sync::atomic::AtomicBool;

use gauss_contact::{Impact, StepLaw, StepScheme};
use gauss_runtime::integrate::{Adaptive, Method, StepSetting};
use gauss_runtime::prelude::{Crossing, Real, VectorSpace};

/// The method and its choice of steps. Three numbers are the relative and the absolute tolerance, and the longest step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Control {
    /// A method by name, without contacts.
    Smooth(Method, StepSetting<f64>),
    /// Contacts from event to event, by the first method between them and this law of impacts.
    ContactEvents(f64, f64, f64, Impact),
    /// Contacts in steps of one length, or at most as long with a relative and an absolute tolerance.
    ContactSteps(f64, Option<(f64, f64)>, StepScheme, StepLaw),
}

/// Points of the input over time, straight between them and constant beyond.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    /// Times, each larger than the one before.
    pub times: Vec<f64>,
    /// A row for each time.
    pub values: Vec<f64>,
}

impl Table {
    /// The same with zeros behind the numbers of each row, of `size`, up to `room`.
    #[cfg(feature = "loaded")]
    pub fn widened(&self, size: usize, room: usize) -> Self {
        let rows = self.values.chunks(size.max(1));
        let values = rows.flat_map(|row| row.iter().copied().chain(std::iter::repeat_n(0.0, room - size)));
        Self { times: self.times.clone(), values: values.collect() }
    }

    /// A time within which the input changes: half of the shortest span of three knots, but no less than a millionth of
    /// all. What a table does in less is a step for it.
    pub fn changes_within(&self) -> f64 {
        let (Some(first), Some(last)) = (self.times.first(), self.times.last()) else { return f64::INFINITY };
        let spans = self.times.windows(3).map(|knots| 0.5 * (knots[2] - knots[0]));
        spans.fold(f64::INFINITY, f64::min).max(1e-6 * (last - first))
    }

    /// Number `i` of the input, of rows of `size`.
    fn number(&self, t: f64, i: usize, size: usize) -> f64 {
        let value = |row: usize| self.values[row * size + i];
        let after = self.times.partition_point(|&time| time <= t);
        match after {
            0 => value(0),
            _ if after == self.times.len() => value(after - 1),
            _ => {
                let (from, to) = (self.times[after - 1], self.times[after]);
                let part = (t - from) / (to - from);
                value(after - 1) + part * (value(after) - value(after - 1))
            }
        }
    }
}

/// A function of time and the numbers of q and z.
pub type Function<'a, R> = &'a (dyn Fn(f64, &[f64], &[f64]) -> R + Sync);

/// Source of the input.
pub enum Input<'a> {
    /// The same at all times; no number where a scene has no input.
    Constant(Vec<f64>),
    /// Over time.
    Table(Table),
    /// A function of time and state.
    Function(Function<'a, Vec<f64>>),
}

impl Input<'_> {
    /// A time within which it changes, where that is known.
    pub fn changes_within(&self) -> f64 {
        if let Self::Table(table) = self { table.changes_within() } else { f64::INFINITY }
    }

    /// The input at a time, in any number of lanes; a function has no value here.
    pub fn at<T: Real, U: VectorSpace<T>>(&self, t: T, in_lanes: impl Fn(&dyn Fn(usize) -> f64) -> T) -> U {
        let mut input = U::zero();
        for i in 0..U::DIM {
            let number = match self {
                Self::Constant(numbers) => T::from_f64(numbers[i]),
                Self::Table(table) => in_lanes(&|lane| table.number(t.lane(lane), i, U::DIM)),
                Self::Function(_) => T::from_f64(f64::NAN),
            };
            input.set_component(i, number);
        }
        input
    }
}

/// The control that looks at inputs as often as these are known to change.
pub fn looking<M>(control: Adaptive<M>, input: &Input<'_>) -> Adaptive<M> {
    let within = input.changes_within();
    if within.is_finite() { control.input_changes_within(within) } else { control }
}

/// Value that passes through zero at an event.
pub enum Watched<'a> {
    /// A number of q, or behind these of z, less a value.
    Number(usize, f64),
    /// A function.
    Function(Function<'a, f64>),
}

/// The configuration and the speeds after a jump; none where the state stays as it is.
pub type Jumped = Option<(Vec<f64>, Vec<f64>)>;

/// Effect of an event on a run.
#[derive(Clone, Copy)]
pub enum Effect<'a> {
    /// It goes on.
    None,
    /// The state jumps; whether the function may go on through zero after that.
    Jumps(Function<'a, Jumped>, bool),
    /// It ends.
    Ends,
}

/// An event of a run.
pub struct Until<'a> {
    /// Value that passes through zero.
    pub watched: Watched<'a>,
    /// In which direction.
    pub crossing: Crossing,
    /// Effect on the run.
    pub effect: Effect<'a>,
}

impl Until<'_> {
    /// Whether the run ends there.
    pub fn ends(&self) -> bool {
        matches!(self.effect, Effect::Ends)
    }
}

/// A controller that samples: its input is held from one instant to the next.
pub struct Held<'a> {
    /// From one instant to the next.
    pub period: f64,
    /// From an instant until the input acts.
    pub delay: f64,
    /// The input from the state at an instant.
    pub law: Function<'a, Vec<f64>>,
}

/// One run.
pub struct Request<'a> {
    /// The numbers of the first q.
    pub q: &'a [f64],
    /// The numbers of the first z.
    pub z: &'a [f64],
    /// From when to when.
    pub interval: (f64, f64),
    /// The steps.
    pub control: Control,
    /// The input.
    pub input: &'a Input<'a>,
    /// Controller, whose input is added to it.
    pub controller: Option<Held<'a>>,
    /// Events of the run; those that end it are behind all others.
    pub until: &'a [Until<'a>],
    /// The times at which states are wanted; those of the steps where there are none.
    pub times: Option<&'a [f64]>,
    /// The most steps.
    pub limit: Option<u64>,
    /// Set from outside, or by a function that failed, the run ends with what there is.
    pub stop: &'a AtomicBool,
    /// Called with the time after every step.
    pub look: &'a (dyn Fn(f64) + Sync),
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tables_are_straight_between_points_and_constant_beyond() {
        let table = Table { times: vec![1.0, 2.0, 4.0], values: vec![10.0, 0.0, 20.0, 1.0, 40.0, 2.0] };
        let at = |t| [table.number(t, 0, 2), table.number(t, 1, 2)];
        assert_eq!(at(0.0), [10.0, 0.0]);
        assert_eq!(at(1.5), [15.0, 0.5]);
        assert_eq!(at(3.0), [30.0, 1.5]);
        assert_eq!(at(9.0), [40.0, 2.0]);
    }
}
