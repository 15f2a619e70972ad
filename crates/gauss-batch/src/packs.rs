//! Values of many states, in blocks of lanes.

use alloc::vec::Vec;
use core::fmt;

use gauss_runtime::simd::Packed;
use gauss_runtime::system::GaussSystem;

use crate::lanes::{BatchSystem, SingleConfiguration, SingleSpeeds};

/// Values of many states: blocks of as many as there are lanes, each block in structure-of-arrays layout, one after
/// another.
///
/// So what is worked on together lies together: a block is read as whole vectors, from a few neighbouring lines of
/// memory, whatever the number of states. Where the number is no multiple of the lanes, the rest of the last block
/// repeats the last state.
#[derive(Clone, Debug, PartialEq)]
pub struct Packs<V> {
    pub(crate) blocks: Vec<V>,
    count: usize,
}

impl<V: Packed> Packs<V> {
    /// The values of a function of the number of the state, 0 to `count − 1`.
    #[must_use]
    pub fn from_fn(count: usize, mut value: impl FnMut(usize) -> V::Single) -> Self {
        let blocks = (0..count)
            .step_by(V::WIDTH)
            .map(|first| {
                let mut single = value(first);
                let mut block = V::repeat(&single);
                for lane in 1..V::WIDTH {
                    if first + lane < count {
                        single = value(first + lane);
                    }
                    block.replace(lane, &single);
                }
                block
            })
            .collect();
        Self { blocks, count }
    }

    /// Number of the states.
    #[must_use]
    pub fn len(&self) -> usize {
        self.count
    }

    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.count == 0
    }

    /// The value of one state.
    ///
    /// # Panics
    /// When there is no such state.
    #[must_use]
    pub fn get(&self, state: usize) -> V::Single {
        assert!(state < self.count, "there are {} states, and none of number {state}", self.count);
        self.blocks[state / V::WIDTH].extract(state % V::WIDTH)
    }

    /// Replaces the value of one state.
    ///
    /// # Panics
    /// When there is no such state.
    pub fn set(&mut self, state: usize, value: &V::Single) {
        assert!(state < self.count, "there are {} states, and none of number {state}", self.count);
        let block = &mut self.blocks[state / V::WIDTH];
        // The rest of the last block repeats the last state.
        let last = if state + 1 == self.count { V::WIDTH } else { state % V::WIDTH + 1 };
        (state % V::WIDTH..last).for_each(|lane| block.replace(lane, value));
    }

    /// The values of all states, in their order.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = V::Single> + '_ {
        (0..self.count).map(|state| self.get(state))
    }

    /// The blocks: `len()` over the number of lanes, rounded up.
    #[must_use]
    pub fn blocks(&self) -> &[V] {
        &self.blocks
    }

    /// Other values, in the same memory where there is enough of it.
    pub(crate) fn refill(&mut self, count: usize, blocks: impl Iterator<Item = V>) {
        self.blocks.clear();
        self.blocks.extend(blocks);
        self.count = count;
    }

    /// As many blocks of other values, from those of `self`.
    pub(crate) fn with_blocks<W>(&self, blocks: Vec<W>) -> Packs<W> {
        Packs { blocks, count: self.count }
    }
}

/// The states of a batch: configurations and quasi-velocities.
pub struct States<S: GaussSystem> {
    pub(crate) configurations: Packs<S::Configuration>,
    pub(crate) speeds: Packs<S::Speeds>,
}

// Written by hand: deriving would ask the same of the system S, which is only named here.
impl<S: GaussSystem> Clone for States<S> {
    fn clone(&self) -> Self {
        Self { configurations: self.configurations.clone(), speeds: self.speeds.clone() }
    }
}

impl<S: GaussSystem> fmt::Debug for States<S> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("States").field("configurations", &self.configurations).field("speeds", &self.speeds).finish()
    }
}

impl<S: BatchSystem> States<S> {
    /// The states (q, z) that a function gives of their numbers, 0 to `count − 1`.
    #[must_use]
    pub fn from_fn(count: usize, state: impl FnMut(usize) -> (SingleConfiguration<S>, SingleSpeeds<S>)) -> Self {
        let (configurations, speeds): (Vec<_>, Vec<_>) = (0..count).map(state).unzip();
        Self {
            configurations: Packs::from_fn(count, |i| configurations[i]),
            speeds: Packs::from_fn(count, |i| speeds[i]),
        }
    }

    /// Number of the states.
    #[must_use]
    pub fn len(&self) -> usize {
        self.configurations.len()
    }

    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.configurations.is_empty()
    }

    /// One state (q, z).
    ///
    /// # Panics
    /// When there is no such state.
    #[must_use]
    pub fn get(&self, state: usize) -> (SingleConfiguration<S>, SingleSpeeds<S>) {
        (self.configurations.get(state), self.speeds.get(state))
    }

    /// Replaces one state by (q, z).
    ///
    /// # Panics
    /// When there is no such state.
    pub fn set(&mut self, state: usize, (q, z): &(SingleConfiguration<S>, SingleSpeeds<S>)) {
        self.configurations.set(state, q);
        self.speeds.set(state, z);
    }

    /// All configurations q.
    #[must_use]
    pub fn configurations(&self) -> &Packs<S::Configuration> {
        &self.configurations
    }

    /// All quasi-velocities z.
    #[must_use]
    pub fn speeds(&self) -> &Packs<S::Speeds> {
        &self.speeds
    }

    /// All states (q, z), in their order.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = (SingleConfiguration<S>, SingleSpeeds<S>)> + '_ {
        (0..self.len()).map(|state| self.get(state))
    }
}
