//! The order of the instructions of long programs: what most waits for comes first, as long as there is room for
//! results.
//!
//! Compilers keep about the order that they are given where blocks are long, and processors look ahead some hundred
//! instructions: the order decides how many chains overlap, and how many results wait at once. List scheduling with one
//! instruction a cycle, after Goodman & Hsu, Code scheduling and register allocation in large basic blocks (1988). What
//! is computed stays the same to the last bit.

use std::cmp::Reverse;
use std::collections::BinaryHeap;
use std::ops::RangeInclusive;

use super::code::Code;
use super::instruction::Instruction;

/// Results that wait at once, above which what frees others comes first: between the registers that processors have,
/// sixteen and thirty-two.
const ROOM: usize = 24;

/// Lengths of programs that are ordered. Processors see a shorter one nearly whole, and none was found to gain; a
/// longer one is not one function (`targets::rust`).
const LENGTHS: RangeInclusive<usize> = 256..=65_536;

impl<S: Copy> Code<S> {
    /// The same instructions in an order in which chains overlap and results are short-lived.
    pub(crate) fn ordered(self) -> Self {
        if !LENGTHS.contains(&self.instructions.len()) {
            return self;
        }
        let order = Scheduler::of(&self).order();
        self.in_order(&order).verified()
    }
}

/// An order of steps, of which it is known what each reads, each once, all of them before it, and how many cycles each
/// takes.
pub(super) fn order_of(reads: Vec<Vec<usize>>, cycles: Vec<u32>) -> Vec<usize> {
    Scheduler::new(reads, cycles).order()
}

/// A program that is ordered, instruction by instruction.
struct Scheduler {
    /// Instructions that each one reads, and those that read it, each once.
    reads: Vec<Vec<usize>>,
    readers: Vec<Vec<usize>>,
    /// Cycles to its result, and from its start to the end of the program.
    cycles: Vec<u32>,
    height: Vec<u32>,
    /// Number of those that it reads that are not written, and of its readers that are not.
    open: Vec<usize>,
    unread: Vec<usize>,
    /// Number of results that nobody needs after it.
    frees: Vec<usize>,
    /// The first cycle in which its operands are there.
    start: Vec<u32>,
    /// Place at which it is written.
    place: Vec<Option<usize>>,
    /// Instructions that wait for nothing but their cycle: by that, by height once they can start, and by what they
    /// free. What is written, or has come to free more, is passed over.
    later: BinaryHeap<Reverse<(u32, usize)>>,
    now: BinaryHeap<(u32, Reverse<usize>)>,
    freeing: BinaryHeap<(usize, usize, Reverse<usize>)>,
    clock: u32,
}

impl Scheduler {
    fn of<S: Copy>(code: &Code<S>) -> Self {
        let read = |instruction: &Instruction<S>| {
            let mut read: Vec<usize> = instruction.operands().filter_map(|operand| operand.instruction()).collect();
            read.sort_unstable();
            read.dedup();
            read
        };
        let cycles = code.instructions.iter().map(|instruction| instruction.cycles());
        Self::new(code.instructions.iter().map(read).collect(), cycles.collect())
    }

    fn new(reads: Vec<Vec<usize>>, cycles: Vec<u32>) -> Self {
        let count = reads.len();
        let mut readers = vec![Vec::new(); count];
        for (k, read) in reads.iter().enumerate() {
            read.iter().for_each(|&operand| readers[operand].push(k));
        }
        let mut height = cycles.clone();
        for k in (0..count).rev() {
            height[k] += readers[k].iter().map(|&reader: &usize| height[reader]).max().unwrap_or(0);
        }
        let unread: Vec<usize> = readers.iter().map(Vec::len).collect();
        let frees = reads.iter().map(|read| read.iter().filter(|&&operand| unread[operand] == 1).count()).collect();
        let open: Vec<usize> = reads.iter().map(Vec::len).collect();
        let mut scheduler = Self {
            reads,
            readers,
            cycles,
            height,
            open,
            unread,
            frees,
            start: vec![0; count],
            place: vec![None; count],
            later: BinaryHeap::new(),
            now: BinaryHeap::new(),
            freeing: BinaryHeap::new(),
            clock: 0,
        };
        for k in 0..count {
            if scheduler.open[k] == 0 {
                scheduler.is_ready(k);
            }
        }
        scheduler
    }

    /// The instructions in the order in which they are to be written.
    fn order(mut self) -> Vec<usize> {
        let mut waiting = 0;
        let mut order = Vec::with_capacity(self.reads.len());
        while let Some(k) = self.next(waiting) {
            // Outputs are handed over, and wait for nobody.
            waiting = (waiting + usize::from(!self.readers[k].is_empty())).saturating_sub(self.frees[k]);
            self.write(k, order.len());
            order.push(k);
        }
        order
    }

    fn next(&mut self, waiting: usize) -> Option<usize> {
        if waiting < ROOM { self.longest() } else { self.most_freeing() }
    }

    /// Takes, of the instructions that can start, the one after which most cycles are left.
    fn longest(&mut self) -> Option<usize> {
        loop {
            while let Some(&Reverse((start, k))) = self.later.peek()
                && (start <= self.clock || self.place[k].is_some())
            {
                self.later.pop();
                self.now.push((self.height[k], Reverse(k)));
            }
            while let Some((_, Reverse(k))) = self.now.pop() {
                if self.place[k].is_none() {
                    return Some(k);
                }
            }
            self.clock = self.later.peek()?.0.0;
        }
    }

    /// Takes the instruction that lets most results go; of several, the one that reads the latest.
    fn most_freeing(&mut self) -> Option<usize> {
        while let Some((frees, _, Reverse(k))) = self.freeing.pop() {
            if self.place[k].is_none() && frees == self.frees[k] {
                return Some(k);
            }
        }
        None
    }

    fn is_ready(&mut self, k: usize) {
        self.later.push(Reverse((self.start[k], k)));
        self.may_free(k);
    }

    fn may_free(&mut self, k: usize) {
        let latest = self.reads[k].iter().filter_map(|&operand| self.place[operand]).max();
        self.freeing.push((self.frees[k], latest.map_or(0, |place| place + 1), Reverse(k)));
    }

    fn write(&mut self, k: usize, place: usize) {
        self.place[k] = Some(place);
        let done = self.clock.max(self.start[k]) + self.cycles[k];
        self.clock += 1;
        for operand in std::mem::take(&mut self.reads[k]) {
            self.unread[operand] -= 1;
            if self.unread[operand] == 1 {
                self.reads_last(operand);
            }
        }
        for i in 0..self.readers[k].len() {
            let reader = self.readers[k][i];
            self.start[reader] = self.start[reader].max(done);
            self.open[reader] -= 1;
            if self.open[reader] == 0 {
                self.is_ready(reader);
            }
        }
    }

    /// One reader of a result is left, which lets it go.
    fn reads_last(&mut self, operand: usize) {
        let left = self.readers[operand].iter().copied().find(|&reader| self.place[reader].is_none());
        if let Some(reader) = left {
            self.frees[reader] += 1;
            if self.open[reader] == 0 {
                self.may_free(reader);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::input::Input;
    use super::super::instruction::Operand;
    use super::*;

    /// Sums of products: chains one after the other, each of which waits for itself alone.
    fn chains(count: usize, length: usize) -> Code {
        let input = |component| Operand::Input(Input::Component { argument: 0, component });
        let mut code = Code::nothing();
        for chain in 0..count {
            code.instructions.push(Instruction::Multiply(input(chain), input(chain + 1)));
            for _ in 1..length {
                let last = Operand::Value(code.instructions.len() - 1);
                code.instructions.push(Instruction::MultiplyAdd(last, input(chain), last));
            }
            code.outputs.push(Operand::Value(code.instructions.len() - 1));
        }
        code
    }

    #[test]
    fn chains_overlap_as_long_as_there_is_room() {
        let (code, value) = (chains(8, 64), |input| match input {
            Input::Component { component, .. } => 0.1 * component as f64,
            Input::Number(_) => f64::NAN,
        });
        let ordered = code.clone().ordered();
        assert_eq!(ordered.evaluate(value), code.evaluate(value));
        // All eight begin before one of them goes on: four cycles are more than one chain fills.
        let begun = |instruction: &Instruction| matches!(instruction, Instruction::Multiply(..));
        let last = ordered.instructions.iter().rposition(begun).expect("products");
        assert!(last < 8 * 4, "the last chain begins at {last}");
    }

    #[test]
    fn no_more_results_wait_than_there_is_room_for() {
        // Each of a hundred chains could begin at once.
        let ordered = chains(100, 20).ordered();
        let uses = ordered.instructions.iter().enumerate().flat_map(|(k, i)| i.operands().map(move |o| (k, o)));
        let mut last: Vec<usize> = (0..ordered.instructions.len()).collect();
        uses.filter_map(|(k, o)| Some((k, o.instruction()?))).for_each(|(k, read)| last[read] = k);
        let waiting = |k: usize| (0..k).filter(|&earlier| last[earlier] > k).count();
        let most = (0..last.len()).map(waiting).max().expect("instructions");
        assert!(most <= ROOM, "{most} results wait");
    }
}
