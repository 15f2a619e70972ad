//! Many runs in steps: lanes times threads.

use alloc::vec::Vec;

use gauss_runtime::contact::ContactSystem;
use gauss_runtime::simd::Packed;

use crate::error::{ContactError, ContactErrorKind};

use super::lane::LanesOf;
use super::lanes::ContactLanes;
use super::stepper::ContactStepper;

/// Many systems on their way in steps, in blocks of as many as a pack has lanes.
///
/// Each has the bits of a stepper of its own, whatever the number of lanes and threads. One whose step is an error
/// stays where it was; the others go on.
#[derive(Debug)]
pub struct ContactEnsemble<'k, W: LanesOf<K>, K: ContactSystem<Scalar = f64>> {
    blocks: Vec<ContactLanes<'k, W, K>>,
    failures: Vec<Vec<(usize, ContactError)>>,
}

impl<'k, W: LanesOf<K>, K: ContactSystem<Scalar = f64>> ContactEnsemble<'k, W, K> {
    /// One kernel for all runs, which have the same parameters.
    ///
    /// # Errors
    /// `Lanes` where there are no runs.
    pub fn new(wide: &'k W, steppers: Vec<ContactStepper<'k, K>>) -> Result<Self, ContactError> {
        Self::of(|_| Some(wide), steppers)
    }

    /// A kernel for each block: a lane has the parameters of its run.
    ///
    /// # Errors
    /// `Lanes` where there are no runs, or more than lanes.
    pub fn each(wide: &'k [W], steppers: Vec<ContactStepper<'k, K>>) -> Result<Self, ContactError> {
        Self::of(|block| wide.get(block), steppers)
    }

    fn of(wide: impl Fn(usize) -> Option<&'k W>, steppers: Vec<ContactStepper<'k, K>>) -> Result<Self, ContactError> {
        let (given, lanes) = (steppers.len(), W::Scalar::WIDTH);
        let mut runs = steppers.into_iter();
        let mut blocks = Vec::with_capacity(given.div_ceil(lanes));
        for block in 0..given.div_ceil(lanes).max(1) {
            let kind = ContactErrorKind::Lanes { lanes: block * lanes, given };
            let wide = wide(block).ok_or(ContactError { contact: None, time: 0.0, kind })?;
            blocks.push(ContactLanes::of(wide, runs.by_ref().take(lanes).collect())?);
        }
        let failures = blocks.iter().map(|_| Vec::new()).collect();
        Ok(Self { blocks, failures })
    }

    /// The steppers of all runs, in their order.
    pub fn steppers(&self) -> impl Iterator<Item = &ContactStepper<'k, K>> {
        self.blocks.iter().flat_map(|block| block.steppers())
    }

    /// Runs that do not go on, with the reason.
    pub fn failures(&self) -> impl Iterator<Item = &(usize, ContactError)> {
        self.failures.iter().flatten()
    }

    /// So many steps of length `h` of every run, on this thread; the input of a run by its number and state is taken at
    /// the start of each step and held.
    pub fn advance(&mut self, h: f64, steps: u64, input: impl Fn(usize, &ContactStepper<'k, K>) -> K::Input) {
        for (block, (lanes, failures)) in self.blocks.iter_mut().zip(&mut self.failures).enumerate() {
            advance((lanes, failures), block * W::Scalar::WIDTH, (h, steps), &input);
        }
    }

    /// Like [`advance`](Self::advance), on all threads, with the same bits.
    #[cfg(feature = "rayon")]
    pub fn advance_on_all_threads(
        &mut self,
        h: f64,
        steps: u64,
        input: impl Fn(usize, &ContactStepper<'k, K>) -> K::Input + Sync,
    ) where
        ContactLanes<'k, W, K>: Send,
    {
        use rayon::prelude::*;

        let blocks = self.blocks.par_iter_mut().zip(&mut self.failures).enumerate();
        blocks.for_each(|(block, of)| advance(of, block * W::Scalar::WIDTH, (h, steps), &input));
    }
}

/// Steps of a block, whose first run has this number.
fn advance<'k, W: LanesOf<K>, K: ContactSystem<Scalar = f64>>(
    (lanes, failures): (&mut ContactLanes<'k, W, K>, &mut Vec<(usize, ContactError)>),
    first: usize,
    (h, steps): (f64, u64),
    input: &impl Fn(usize, &ContactStepper<'k, K>) -> K::Input,
) {
    let count = lanes.steppers().len();
    for _ in 0..steps {
        if failures.len() == count {
            return;
        }
        let mut inputs = W::Input::repeat(&input(first, &lanes.steppers()[0]));
        for (lane, stepper) in lanes.steppers().iter().enumerate().skip(1) {
            inputs.replace(lane, &input(first + lane, stepper));
        }
        lanes.step(h, &inputs);
        for lane in 0..count {
            if let Some(error) = lanes.fails(lane) {
                failures.push((first + lane, error));
                lanes.halt(lane);
            }
        }
    }
}
