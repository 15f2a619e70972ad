//! Scenes and their kernels with their types forgotten.

use std::ops::Range;
use std::sync::Arc;
use std::time::Duration;

use gauss_runtime::contact::Contact;
use gauss_runtime::description::Equations;
use gauss_runtime::error::ParameterError;
use gauss_runtime::prelude::{DescribedSystem, GaussSystem};
use gauss_runtime::simd::Packed;

use crate::description::Description;
use crate::lanes::{self, Lanes};
use crate::memory::Source;
use crate::methods::{Id, SPECS, Sizes, Slot, Table, Work};
use crate::runs::{self, Many, ManyEnds};
use crate::scene::{ScalarOf, Scene};
use crate::steps::{self, AnyStepper, Control, InContact, Methods, Outcome, Request};

/// A scene, its type forgotten.
pub trait AnyScene: Send + Sync {
    /// The struct in words.
    fn description(&self) -> &Description;
    /// The equations as text and in LaTeX.
    fn equations(&self) -> [&str; 2];
    /// Operations that methods cost, as text.
    fn operations(&self) -> String;
    /// Losses of methods to rounding, as text.
    fn accuracy(&self) -> String;
    /// Names of the numbers of q and of z.
    fn names(&self) -> [&[&'static str]; 2];
    /// Sizes of vectors.
    fn sizes(&self) -> Sizes;
    /// Frames.
    fn frames(&self) -> &[&'static str];
    /// Joints whose reactions are methods.
    fn joints(&self) -> &[&'static str];
    /// Driven coordinates.
    fn motions(&self) -> &[&'static str];
    /// Names of the numbers of parameters that there are derivatives by; none without the clause for them.
    fn parameters(&self) -> &[&'static str];
    /// Contacts, ranges and dry joints, of which runs have the forces.
    fn contacts(&self) -> &[Contact];
    /// Whether kernels have the method.
    fn has(&self, id: Id) -> bool;
    /// The numbers of q and z at rest in the origin.
    fn at_rest(&self) -> [Vec<f64>; 2];
    /// A kernel.
    ///
    /// # Errors
    /// Parameters that no body can have.
    fn kernel(self: Arc<Self>, numbers: Vec<f64>) -> Result<Box<dyn AnyKernel>, Vec<Violation>>;
}

/// A number that breaks a rule of parameters.
#[derive(Clone, Debug)]
pub struct Violation {
    /// The field.
    pub field: String,
    /// The number.
    pub value: f64,
    /// The rule by its name.
    pub rule: String,
    /// All of it in words.
    pub message: String,
}

impl Violation {
    /// All of an error.
    pub fn all(error: &ParameterError) -> Vec<Self> {
        let one = |violation: &gauss_runtime::error::Violation| {
            let rule = format!("{:?}", violation.rule);
            Self {
                field: violation.field.to_owned(),
                value: violation.value,
                rule: rule.split([' ', '{', '(']).next().unwrap_or_default().to_owned(),
                message: violation.to_string(),
            }
        };
        error.violations().iter().map(one).collect()
    }
}

/// A kernel, its type forgotten.
pub trait AnyKernel: Send + Sync {
    /// Its scene.
    fn scene(&self) -> &dyn AnyScene;
    /// Its parameters.
    fn numbers(&self) -> &[f64];
    /// The kernel of the same scene with other parameters.
    ///
    /// # Errors
    /// Parameters that no body can have.
    fn with(&self, numbers: Vec<f64>) -> Result<Box<dyn AnyKernel>, Vec<Violation>>;
    /// Remarks on what of the scene's file does not act, and on what is likely not meant.
    fn warnings(&self) -> Vec<String>;
    /// Computes rows; the first row whose rotation is none, with how far the squares of its numbers are from 1.
    ///
    /// # Safety
    /// All arrays that the method names have these rows, each of the sizes of the scene.
    #[allow(unsafe_code)]
    unsafe fn run(&self, id: Id, work: &Work, rows: Range<usize>) -> Result<(), OffGroup>;
    /// Whether these numbers are a state.
    ///
    /// # Errors
    /// All that is wrong with them.
    fn check(&self, q: &[f64], z: &[f64]) -> Result<(), String>;
    /// The nearest state on the constraints.
    ///
    /// # Errors
    /// A state that is none, one from which no such state is found.
    fn project(&self, t: f64, q: &[f64], z: &[f64]) -> Result<[Vec<f64>; 2], String>;
    /// Acceleration at a state, with modes and forces of the contacts.
    ///
    /// # Errors
    /// A state that is none or at which velocities jump; no contacts.
    fn in_contact(&self, t: f64, state: (&[f64], &[f64]), input: &[f64]) -> Result<InContact, String>;
    /// A run.
    fn simulate(&self, request: &Request<'_>) -> Result<Outcome, String>;
    /// A run step by step, without contacts.
    fn stepper(&self, request: &Request<'_>) -> Result<Box<dyn AnyStepper>, String>;
    /// Many runs.
    fn ensemble(&self, many: &Many<'_>) -> Result<ManyEnds, String>;
    /// The time of the same batch in Rust.
    fn batch_time(&self, many: &Many<'_>) -> Result<Duration, String>;
}

/// A rotation that is none.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OffGroup {
    /// The row.
    pub row: usize,
    /// The argument that it is in.
    pub slot: Slot,
    /// The first of its numbers.
    pub place: usize,
    /// Count of its numbers.
    pub count: usize,
    /// The sum of their squares.
    pub squares: f64,
}

/// A scene with the tables of its methods.
pub struct Registered<S: Scene> {
    single: Table<S::Single>,
    packed: Table<S::Packed>,
    steps: Methods<S::Single>,
    description: Description,
    sizes: Sizes,
    blocks: Vec<(usize, usize)>,
}

impl<S: Scene> Registered<S> {
    /// The scene with all methods that the struct asked for.
    #[must_use]
    pub fn new() -> Self {
        let (mut single, mut packed) = (Table::new(), Table::new());
        let steps = S::offer(&mut single, &mut packed);
        let sizes = Sizes::of::<S::Single>([single.multipliers, single.motions.len()], single.parameters.len());
        let description = S::description();
        let blocks = description.unit_blocks().collect();
        Self { single, packed, steps, description, sizes, blocks }
    }
}

impl<S: Scene> Default for Registered<S> {
    fn default() -> Self {
        Self::new()
    }
}

impl<S: Scene> AnyScene for Registered<S> {
    fn description(&self) -> &Description {
        &self.description
    }

    fn equations(&self) -> [&str; 2] {
        let Equations { text, latex, .. } = <S::Single as DescribedSystem>::EQUATIONS;
        [text, latex]
    }

    fn operations(&self) -> String {
        <S::Single as DescribedSystem>::OPERATIONS.to_string()
    }

    fn accuracy(&self) -> String {
        <S::Single as DescribedSystem>::ACCURACY.to_string()
    }

    fn names(&self) -> [&[&'static str]; 2] {
        [<S::Single as DescribedSystem>::COORDINATE_NAMES, <S::Single as DescribedSystem>::SPEED_NAMES]
    }

    fn sizes(&self) -> Sizes {
        self.sizes
    }

    fn frames(&self) -> &[&'static str] {
        &self.single.frames
    }

    fn joints(&self) -> &[&'static str] {
        &self.single.joints
    }

    fn motions(&self) -> &[&'static str] {
        &self.single.motions
    }

    fn parameters(&self) -> &[&'static str] {
        self.single.parameters
    }

    fn contacts(&self) -> &[Contact] {
        self.steps.touching()
    }

    fn has(&self, id: Id) -> bool {
        self.single.has(id)
    }

    fn at_rest(&self) -> [Vec<f64>; 2] {
        let (q, z) = S::at_rest();
        [steps::numbers_of(&q), steps::components(&z)]
    }

    fn kernel(self: Arc<Self>, numbers: Vec<f64>) -> Result<Box<dyn AnyKernel>, Vec<Violation>> {
        let single = S::single(&numbers).map_err(|error| Violation::all(&error))?;
        let repeated: Vec<_> = numbers.iter().map(ScalarOf::<S::Packed>::repeat).collect();
        let packed = S::packed(&repeated).map_err(|error| Violation::all(&error))?;
        Ok(Box::new(Instance { scene: self, single, packed, numbers }))
    }
}

/// Kernels of one set of parameters.
struct Instance<S: Scene> {
    scene: Arc<Registered<S>>,
    single: S::Single,
    packed: S::Packed,
    numbers: Vec<f64>,
}

impl<S: Scene> Instance<S> {
    /// The configuration of a state.
    fn state(&self, q: &[f64], z: &[f64]) -> Result<<S::Single as GaussSystem>::Configuration, String> {
        steps::state(&self.scene.description, self.scene.names(), q, z).map_err(|mistakes| mistakes.join("; "))
    }
}

/// The first rotation in these rows that is none, as what is not a number is; `blocks`: where rotations are.
///
/// # Safety
/// The array has these rows, each with all blocks.
#[allow(unsafe_code)]
pub unsafe fn off_group(
    blocks: &[(usize, usize)],
    slot: Slot,
    source: &Source,
    rows: Range<usize>,
) -> Result<(), OffGroup> {
    for &(place, count) in blocks {
        for row in rows.clone() {
            // SAFETY: of this function.
            let squares: f64 = (place..place + count).map(|i| unsafe { source.get(row, i) }.powi(2)).sum();
            if steps::off_group(squares) {
                return Err(OffGroup { row, slot, place, count, squares });
            }
        }
    }
    Ok(())
}

/// So many numbers in lanes stay in the nearest cache, with what a kernel needs besides.
const NEAR: usize = 2048;
/// The most packs of lanes, or rows, that are gathered at a time.
const MOST_PACKS: usize = 16;
const MOST_ROWS: usize = 128;

#[allow(unsafe_code)]
impl<S: Scene> Instance<S> {
    /// Computes rows: as many as fill lanes, where the struct has them, then what is left one by one.
    ///
    /// # Safety
    /// As of `AnyKernel::run`.
    unsafe fn compute(&self, id: Id, work: &Work, rows: Range<usize>) {
        let mut next = rows.start;
        // SAFETY: of this function.
        unsafe {
            if <ScalarOf<S::Packed> as Packed>::WIDTH == lanes::WIDTH && rows.len() >= lanes::WIDTH {
                let packs = rows.len() / lanes::WIDTH;
                self.in_lanes(id, &work.beginning(next), packs);
                next += packs * lanes::WIDTH;
            }
            if next < rows.end {
                self.one_by_one(id, work, next..rows.end);
            }
        }
    }

    /// Computes the first rows in lanes, as many as fill these packs.
    ///
    /// # Safety
    /// As of `AnyKernel::run`.
    unsafe fn in_lanes(&self, id: Id, work: &Work, packs: usize) {
        let arguments = SPECS[id as usize].arguments.iter();
        let arguments = arguments.map(|argument| (argument.slot as usize, self.scene.sizes.get(argument.size)));
        let apart = |&(slot, size): &(usize, usize)| size > 0 && !Lanes::are(work.arguments[slot], size);
        let apart: Vec<_> = arguments.filter(apart).collect();
        let numbers = apart.iter().map(|(_, size)| size).sum::<usize>() * lanes::WIDTH;
        // Where all is read as it is there is one block.
        let block = NEAR.checked_div(numbers).map_or(packs, |block| block.clamp(1, MOST_PACKS).min(packs));
        let mut taken: Vec<_> = apart.iter().map(|&(slot, size)| (slot, Lanes::new(block, size))).collect();
        for start in (0..packs).step_by(block) {
            let count = block.min(packs - start);
            // SAFETY: of this function. What is one for all is there after the first block, which is the longest.
            unsafe {
                let part = work.beginning(start * lanes::WIDTH);
                let mut vectors = part;
                for (slot, lanes) in &mut taken {
                    let source = part.arguments[*slot];
                    if start == 0 || source.stride() > 0 {
                        lanes.take(count, source);
                    }
                    vectors.arguments[*slot] = lanes.source();
                }
                self.scene.packed.run(&self.packed, id, &vectors, 0..count);
            }
        }
    }

    /// Computes rows by the kernel of one state; rows that do not follow each other in memory, or are one for all, are
    /// gathered before.
    ///
    /// # Safety
    /// As of `AnyKernel::run`.
    unsafe fn one_by_one(&self, id: Id, work: &Work, rows: Range<usize>) {
        let arguments = SPECS[id as usize].arguments.iter();
        let sizes = arguments.map(|argument| (argument.slot as usize, self.scene.sizes.get(argument.size)));
        let apart = sizes.filter(|&(slot, size)| size > 0 && work.arguments[slot].stride() != size);
        let single = |work: &Work, rows| unsafe { self.scene.single.run(&self.single, id, work, rows) };
        if rows.len() == 1 {
            // SAFETY: of this function; a row alone has none behind it.
            unsafe {
                let mut one = work.beginning(rows.start);
                apart.for_each(|(slot, size)| one.arguments[slot] = one.arguments[slot].at_distance(size));
                return single(&one, 0..1);
            }
        }
        let length = rows.len().min(MOST_ROWS);
        let mut gathered: Vec<_> = apart.map(|(slot, size)| (slot, size, vec![0.0; length * size])).collect();
        if gathered.is_empty() {
            return single(work, rows);
        }
        for start in rows.clone().step_by(MOST_ROWS) {
            let end = rows.end.min(start + MOST_ROWS);
            // SAFETY: of this function; the numbers outlive the call that reads them.
            unsafe {
                let mut part = work.beginning(start);
                for (slot, size, numbers) in &mut gathered {
                    let source = &mut part.arguments[*slot];
                    // One row for all is there already.
                    if source.stride() > 0 || start == rows.start {
                        source.copy(0..end - start, *size, numbers);
                    }
                    *source = Source::new(numbers.as_ptr(), *size);
                }
                single(&part, 0..end - start);
            }
        }
    }
}

impl<S: Scene> AnyKernel for Instance<S> {
    fn scene(&self) -> &dyn AnyScene {
        &*self.scene
    }

    fn numbers(&self) -> &[f64] {
        &self.numbers
    }

    fn with(&self, numbers: Vec<f64>) -> Result<Box<dyn AnyKernel>, Vec<Violation>> {
        Arc::clone(&self.scene).kernel(numbers)
    }

    fn warnings(&self) -> Vec<String> {
        let of_file =
            self.scene.description.remarks.iter().filter(|remark| remark.ignored).map(|remark| remark.text.to_owned());
        of_file.chain(S::warnings(&self.numbers).iter().map(ToString::to_string)).collect()
    }

    #[allow(unsafe_code)]
    unsafe fn run(&self, id: Id, work: &Work, rows: Range<usize>) -> Result<(), OffGroup> {
        let spec = &SPECS[id as usize];
        for argument in spec.arguments {
            if argument.slot == Slot::Q || argument.name == "other" {
                let source = &work.arguments[argument.slot as usize];
                // SAFETY: of this function.
                unsafe { off_group(&self.scene.blocks, argument.slot, source, rows.clone()) }?;
            }
        }
        // SAFETY: of this function.
        unsafe { self.compute(id, work, rows) };
        Ok(())
    }

    fn check(&self, q: &[f64], z: &[f64]) -> Result<(), String> {
        self.state(q, z).map(drop)
    }

    fn project(&self, t: f64, q: &[f64], z: &[f64]) -> Result<[Vec<f64>; 2], String> {
        let start = self.state(q, z)?;
        let found = self.single.project(t, &start, &steps::vector(z)).map_err(|error| error.to_string())?;
        Ok([steps::numbers_of(&found.0), steps::components(&found.1)])
    }

    fn in_contact(&self, t: f64, (q, z): (&[f64], &[f64]), input: &[f64]) -> Result<InContact, String> {
        self.check(q, z)?;
        self.scene.steps.in_contact(&self.single, t, (q, z), input)
    }

    fn simulate(&self, request: &Request<'_>) -> Result<Outcome, String> {
        self.check(request.q, request.z)?;
        self.scene.steps.simulate(&self.single, request)
    }

    fn stepper(&self, request: &Request<'_>) -> Result<Box<dyn AnyStepper>, String> {
        self.check(request.q, request.z)?;
        let own = S::single(&self.numbers).map_err(|error| error.to_string())?;
        self.scene.steps.stepper(own, request)
    }

    fn ensemble(&self, many: &Many<'_>) -> Result<ManyEnds, String> {
        match many.control {
            Control::ContactEvents(..) | Control::ContactSteps(..) => {
                runs::touching::<S>((&self.scene.description, &self.scene.steps), &self.single, &self.numbers, many)
            }
            _ => runs::ensemble::<S>(&self.scene.description, &self.packed, &self.numbers, many),
        }
    }

    fn batch_time(&self, many: &Many<'_>) -> Result<Duration, String> {
        runs::batch_time::<S>(&self.packed, many)
    }
}
