//! Steps → machine code: registers are assigned in one pass. A register that is wanted is taken from the vector that is
//! read latest; code without branches says when that is.

use super::assembler::{Assembler, Base, Location, Opcode, Order, Source, Width};
use super::steps::{Callee, LaneOperand, Operation, Step, Steps};

/// Vectors at the beginning of the room: arguments of functions, the first of which the result replaces, and the
/// exceptions.
const RESERVED: usize = 4;
/// The vector of the exceptions.
pub const EXCEPTIONS: usize = 3;

/// Machine code with the vectors that it stores in between.
#[derive(Debug)]
pub struct LaneCode {
    pub bytes: Vec<u8>,
    pub room: usize,
}

/// The function, and the numbers, by which a function is called lane by lane.
pub type Address = (u64, [u64; 2]);

/// Machine code of steps; `callee` has the addresses of functions. None where it would be larger than addresses are.
pub fn assembled(steps: &Steps, width: Width, callee: impl Fn(Callee) -> Option<Address>) -> Option<LaneCode> {
    let mut writer = Allocator::new(steps, width);
    for (k, step) in steps.steps.iter().enumerate() {
        match step.operation {
            Operation::Call(function) => writer.call(k, step, callee(function)?)?,
            Operation::MultiplyAdd | Operation::MultiplySubtract => writer.fused(k, step)?,
            Operation::ShiftLeft(_) | Operation::ShiftRight(_) => writer.shift(k, step)?,
            Operation::Root => writer.root(k, step)?,
            _ => writer.two(k, step)?,
        }
    }
    for (k, output) in steps.outputs.iter().enumerate() {
        writer.output(*output, Base::Outputs, k)?;
    }
    if let Some(exceptions) = steps.exceptions {
        writer.output(exceptions, Base::Room, EXCEPTIONS)?;
    }
    Some(LaneCode { bytes: writer.assembler.finish(), room: writer.room })
}

struct Allocator {
    assembler: Assembler,
    /// Counts of steps, inputs and constants, by which vectors have numbers.
    counts: [usize; 3],
    /// Steps that read each vector, the next one last.
    uses: Vec<Vec<usize>>,
    /// The register that a vector is in.
    register: Vec<Option<u8>>,
    /// The place in the room where a result was stored.
    stored: Vec<Option<usize>>,
    /// The vector that is in a register.
    holders: Vec<Option<usize>>,
    /// Places in the room that are free, and those that are once the instruction of this step has read them.
    free: Vec<usize>,
    released: Vec<usize>,
    room: usize,
}

impl Allocator {
    fn new(steps: &Steps, width: Width) -> Self {
        let read = steps.steps.iter().flat_map(Step::places).chain(&steps.outputs).chain(&steps.exceptions);
        let mut counts = [steps.steps.len(), 0, 0];
        for place in read {
            match *place {
                LaneOperand::Input(k) => counts[1] = counts[1].max(k + 1),
                LaneOperand::Constant(k) => counts[2] = counts[2].max(k + 1),
                LaneOperand::Value(_) | LaneOperand::Number(_) => {}
            }
        }
        let all = counts.iter().sum::<usize>() + steps.numbers.len();
        let mut writer = Self {
            assembler: Assembler::new(width),
            counts,
            uses: vec![Vec::new(); all],
            register: vec![None; all],
            stored: vec![None; steps.steps.len()],
            holders: vec![None; usize::from(width.registers())],
            free: Vec::new(),
            released: Vec::new(),
            room: RESERVED,
        };
        let last = steps.outputs.iter().chain(&steps.exceptions).rev().map(|place| (steps.steps.len(), *place));
        let of_steps = steps.steps.iter().enumerate().rev();
        let of_steps = of_steps.flat_map(|(k, step)| step.places().iter().map(move |place| (k, *place)));
        for (reader, place) in last.chain(of_steps) {
            let vector = writer.vector(place);
            writer.uses[vector].push(reader);
        }
        writer
    }

    /// The number of a vector.
    fn vector(&self, place: LaneOperand) -> usize {
        let [steps, inputs, constants] = self.counts;
        match place {
            LaneOperand::Value(k) => k,
            LaneOperand::Input(k) => steps + k,
            LaneOperand::Constant(k) => steps + inputs + k,
            LaneOperand::Number(k) => steps + inputs + constants + k,
        }
    }

    fn memory(&self, base: Base, place: usize) -> Option<Location> {
        let is_single = matches!(base, Base::Constants | Base::Numbers);
        let size = if is_single { 8 } else { 8 * self.assembler.width.count() };
        Some(Location { base, offset: i32::try_from(place.checked_mul(size)?).ok()?, is_single })
    }

    /// The place in memory that a vector can be read from: a result is there if it was stored.
    fn home(&self, place: LaneOperand) -> Option<Location> {
        match place {
            LaneOperand::Value(k) => self.memory(Base::Room, self.stored[k]?),
            LaneOperand::Input(k) => self.memory(Base::Inputs, k),
            LaneOperand::Constant(k) => self.memory(Base::Constants, k),
            LaneOperand::Number(k) => self.memory(Base::Numbers, k),
        }
    }

    fn held(&self, place: LaneOperand) -> Option<u8> {
        self.register[self.vector(place)]
    }

    /// A register with nothing in it, none of those that are kept.
    fn take(&mut self, kept: &[u8]) -> Option<u8> {
        let candidates = (0..self.assembler.width.registers()).filter(|register| !kept.contains(register));
        let next = |register: &u8| match self.holders[usize::from(*register)] {
            None => usize::MAX,
            Some(vector) => self.uses[vector].last().copied().unwrap_or(usize::MAX - 1),
        };
        let register = candidates.max_by_key(next)?;
        self.clear(register)?;
        Some(register)
    }

    /// Empties a register; a result that is still read is stored.
    fn clear(&mut self, register: u8) -> Option<()> {
        let Some(vector) = self.holders[usize::from(register)].take() else { return Some(()) };
        self.register[vector] = None;
        if vector < self.counts[0] && self.stored[vector].is_none() && !self.uses[vector].is_empty() {
            let place = self.free.pop().unwrap_or_else(|| {
                self.room += 1;
                self.room - 1
            });
            self.stored[vector] = Some(place);
            let memory = self.memory(Base::Room, place)?;
            self.assembler.store(register, memory);
        }
        Some(())
    }

    fn hold(&mut self, register: u8, vector: usize) {
        self.holders[usize::from(register)] = Some(vector);
        self.register[vector] = Some(register);
    }

    /// The register of a vector, which is loaded where it is in none.
    fn loaded(&mut self, place: LaneOperand, kept: &[u8]) -> Option<u8> {
        if let Some(register) = self.held(place) {
            return Some(register);
        }
        let register = self.take(kept)?;
        let home = self.home(place)?;
        self.assembler.load(register, home);
        let vector = self.vector(place);
        self.hold(register, vector);
        Some(register)
    }

    /// A vector as an instruction reads it last: AVX2 repeats no number while it computes.
    fn source(&mut self, place: LaneOperand, kept: &[u8]) -> Option<Source> {
        if let Some(register) = self.held(place) {
            return Some(Source::Register(register));
        }
        let home = self.home(place)?;
        if home.is_single && self.assembler.width == Width::Four {
            return self.loaded(place, kept).map(Source::Register);
        }
        Some(Source::Memory(home))
    }

    /// Notes that a step has read its vectors: what is read no more leaves its register and its place.
    fn read(&mut self, places: &[LaneOperand]) {
        self.free.append(&mut self.released);
        for place in places {
            let vector = self.vector(*place);
            self.uses[vector].pop();
            if self.uses[vector].is_empty() {
                if let Some(register) = self.register[vector].take() {
                    self.holders[usize::from(register)] = None;
                }
                if let LaneOperand::Value(k) = *place {
                    self.released.extend(self.stored[k].take());
                }
            }
        }
    }

    /// The register for a result whose operands were read, beside those that are still in use.
    fn target(&mut self, k: usize, kept: &[u8]) -> Option<u8> {
        let kept: Vec<u8> =
            kept.iter().copied().filter(|register| self.holders[usize::from(*register)].is_some()).collect();
        let register = self.take(&kept)?;
        self.give(register, k);
        Some(register)
    }

    /// Gives a register to a result, if anything reads it.
    fn give(&mut self, register: u8, k: usize) {
        if !self.uses[k].is_empty() {
            self.hold(register, k);
        }
    }

    fn two(&mut self, k: usize, step: &Step) -> Option<()> {
        let (opcode, commutes) = match step.operation {
            Operation::Add => (Opcode::ADD, true),
            Operation::Subtract => (Opcode::SUBTRACT, false),
            Operation::Multiply => (Opcode::MULTIPLY, true),
            Operation::Divide => (Opcode::DIVIDE, false),
            Operation::And => (Opcode::AND, true),
            Operation::Or => (Opcode::OR, true),
            Operation::Xor => (Opcode::XOR, true),
            Operation::SubtractBits => (Opcode::SUBTRACT_BITS, false),
            _ => return None,
        };
        let &[mut a, mut b] = step.places() else { return None };
        if commutes && self.held(a).is_none() && self.held(b).is_some() {
            (a, b) = (b, a);
        }
        let kept: Vec<u8> = self.held(b).into_iter().collect();
        let first = self.loaded(a, &kept)?;
        let source = self.source(b, &[first])?;
        self.read(step.places());
        let target = self.target(k, &registers(&[first], source))?;
        self.assembler.vector(opcode, target, first, source);
        Some(())
    }

    fn root(&mut self, k: usize, step: &Step) -> Option<()> {
        let source = self.source(step.places()[0], &[])?;
        self.read(step.places());
        let target = self.target(k, &registers(&[], source))?;
        self.assembler.vector(Opcode::ROOT, target, 0, source);
        Some(())
    }

    fn shift(&mut self, k: usize, step: &Step) -> Option<()> {
        let (is_left, count) = match step.operation {
            Operation::ShiftLeft(count) => (true, count),
            Operation::ShiftRight(count) => (false, count),
            _ => return None,
        };
        let register = self.loaded(step.places()[0], &[])?;
        self.read(step.places());
        let target = self.target(k, &[register])?;
        self.assembler.shift(is_left, count, target, register);
        Some(())
    }

    /// The result replaces one operand: one that is read no more, else a copy of one that is in memory, else of the
    /// term.
    fn fused(&mut self, k: usize, step: &Step) -> Option<()> {
        let &[a, b, c] = step.places() else { return None };
        let places = [a, b, c];
        let is_last = |writer: &Self, place: LaneOperand| {
            let uses = &writer.uses[writer.vector(place)];
            let of_step = places.iter().filter(|other| **other == place).count();
            uses.len() == of_step
        };
        let held: Vec<u8> = places.iter().filter_map(|place| self.held(*place)).collect();
        let dying = (0..3).find(|i| self.held(places[*i]).is_some() && is_last(self, places[*i]));
        let (replaced, target) = match dying {
            Some(i) => (i, self.held(places[i])?),
            None => {
                let i = (0..3).rev().find(|i| self.held(places[*i]).is_none()).unwrap_or(2);
                let target = self.take(&held)?;
                match self.held(places[i]) {
                    Some(register) => self.assembler.vector(Opcode::MOVE, target, 0, Source::Register(register)),
                    None => {
                        let home = self.home(places[i])?;
                        self.assembler.load(target, home);
                    }
                }
                (i, target)
            }
        };
        let [mut first, mut last] = match replaced {
            0 => [1, 2],
            1 => [0, 2],
            _ => [0, 1],
        };
        // The one that comes last may be in memory.
        if self.held(places[first]).is_none() && self.held(places[last]).is_some() {
            (first, last) = (last, first);
        }
        let order = match (replaced, last) {
            (2, _) => Order::Term,
            (_, 2) => Order::FactorThenTerm,
            _ => Order::FactorThenFactor,
        };
        let kept = [&held[..], &[target]].concat();
        let register = self.loaded(places[first], &kept)?;
        let source = self.source(places[last], &[&kept[..], &[register]].concat())?;
        self.read(&places);
        self.give(target, k);
        let is_negative = step.operation == Operation::MultiplySubtract;
        self.assembler.vector(Opcode::fused(is_negative, order), target, register, source);
        Some(())
    }

    /// Calls a function lane by lane: all that is read later is stored before.
    fn call(&mut self, k: usize, step: &Step, (function, [first, second]): Address) -> Option<()> {
        for (i, place) in step.places().iter().enumerate() {
            let register = self.loaded(*place, &[])?;
            let argument = self.memory(Base::Room, i)?;
            self.assembler.store(register, argument);
        }
        self.read(step.places());
        (0..self.assembler.width.registers()).try_for_each(|register| self.clear(register))?;
        self.assembler.call(function, [self.assembler.width.count() as u64, first, second]);
        let target = self.target(k, &[])?;
        let result = self.memory(Base::Room, 0)?;
        self.assembler.load(target, result);
        Some(())
    }

    fn output(&mut self, place: LaneOperand, base: Base, k: usize) -> Option<()> {
        let register = self.loaded(place, &[])?;
        let memory = self.memory(base, k)?;
        self.assembler.store(register, memory);
        self.read(&[place]);
        Some(())
    }
}

/// The registers that an instruction reads.
fn registers(first: &[u8], source: Source) -> Vec<u8> {
    let last = if let Source::Register(last) = source { Some(last) } else { None };
    first.iter().copied().chain(last).collect()
}
