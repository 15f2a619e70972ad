//! Sums in another order: (a b + c d) + e is (a b + e) + c d, so that no product is left that is not fused.
//!
//! A sum whose terms are all products begins with one that is not fused with an addition. What is added to it anyhow is
//! put in that place, if nothing else reads the sum, and if no chain becomes longer than the longest of the program.
//! Partial sums change by what is added, so that each is the sum of three of those that there were: the sum itself,
//! what it was added to, and the one in its place. Their roundings are of the same size therefore.

use super::code::Code;
use super::instruction::{Instruction, Operand};

/// Partial sums that are looked through for a product that begins them.
const LEVELS: usize = 64;

impl<S: Copy> Code<S> {
    /// The same with sums begun by what is added to them, one instruction less for each where products are fused;
    /// nothing where there is no such sum.
    pub(crate) fn sums_begun(&self) -> Option<Self> {
        let uses = self.uses();
        if !self.adds_to_products(&uses) {
            return None;
        }
        let latest = self.latest();
        let mut sums =
            RewrittenSums { instructions: Vec::with_capacity(uses.len()), ready: Vec::new(), read_once: Vec::new() };
        let mut place: Vec<usize> = Vec::with_capacity(uses.len());
        for (k, instruction) in self.instructions.iter().enumerate() {
            let instruction = instruction.map(|operand| operand.moved(|k| place[k]));
            sums.write(instruction, latest[k]);
            let last = sums.instructions.len() - 1;
            sums.read_once[last] = uses[k] == 1;
            place.push(last);
        }
        let outputs = self.outputs.iter().map(|output| output.moved(|k| place[k])).collect();
        Some(Self { instructions: sums.instructions, outputs }.without_idle().verified())
    }

    /// Whether something is added to a sum that begins with a product and that nothing else reads.
    fn adds_to_products(&self, uses: &[usize]) -> bool {
        let mut begins = vec![false; uses.len()];
        for (k, instruction) in self.instructions.iter().enumerate() {
            let of = |operand: Operand<S>| matches!(operand, Operand::Value(k) if begins[k]);
            let own = match *instruction {
                Instruction::Multiply(..) => true,
                Instruction::Add(a, b) | Instruction::Subtract(a, b) if of(a) || of(b) => return true,
                Instruction::MultiplyAdd(.., c) | Instruction::MultiplySubtract(.., c) | Instruction::Negate(c) => {
                    of(c)
                }
                _ => false,
            };
            begins[k] = own && uses[k] == 1;
        }
        false
    }

    /// The cycle by which each result must be there, so that no chain is longer than the longest.
    fn latest(&self) -> Vec<u32> {
        let mut ready: Vec<u32> = Vec::with_capacity(self.instructions.len());
        for instruction in &self.instructions {
            ready.push(instruction.ready(&ready));
        }
        let end = ready.iter().copied().max().unwrap_or(0);
        let mut latest = vec![end; ready.len()];
        for (k, instruction) in self.instructions.iter().enumerate().rev() {
            let start = latest[k].saturating_sub(instruction.cycles());
            for operand in instruction.operands().filter_map(Operand::instruction) {
                latest[operand] = latest[operand].min(start);
            }
        }
        latest
    }
}

/// Instructions that are written anew.
struct RewrittenSums<S> {
    instructions: Vec<Instruction<S>>,
    ready: Vec<u32>,
    /// Whether one instruction or output alone reads each.
    read_once: Vec<bool>,
}

impl<S: Copy> RewrittenSums<S> {
    fn push(&mut self, instruction: Instruction<S>) -> Operand<S> {
        self.ready.push(instruction.ready(&self.ready));
        self.instructions.push(instruction);
        self.read_once.push(true);
        Operand::Value(self.instructions.len() - 1)
    }

    fn write(&mut self, instruction: Instruction<S>, latest: u32) {
        // A sum with its sign, and what is added to it with its own.
        let ways = match instruction {
            Instruction::Add(a, b) => [(a, false, b, false), (b, false, a, false)],
            Instruction::Subtract(a, b) => [(a, false, b, true), (b, true, a, false)],
            other => {
                self.push(other);
                return;
            }
        };
        // Of both ways that after which it is there first.
        let mut best: Option<(u32, Beginning<S>)> = None;
        for (sum, negative, added, subtracted) in ways {
            let mut path = Vec::new();
            if !self.beginning(sum, LEVELS, &mut path) {
                continue;
            }
            let ready = self.begun(&path, added.ready(&self.ready) + u32::from(subtracted));
            if ready <= best.as_ref().map_or(latest, |(ready, _)| ready.saturating_sub(1)) {
                best = Some((ready, Beginning { path, negative, added, subtracted }));
            }
        }
        match best {
            Some((_, beginning)) => self.begin(&beginning.path, beginning.negative, &beginning),
            None => self.push(instruction),
        };
    }

    /// The partial sums from the last to the product that begins them, if there is one.
    fn beginning(&self, sum: Operand<S>, levels: usize, path: &mut Vec<usize>) -> bool {
        let Operand::Value(k) = sum else { return false };
        if !self.read_once[k] || levels == 0 {
            return false;
        }
        path.push(k);
        let found = match self.instructions[k] {
            Instruction::Multiply(..) => true,
            Instruction::MultiplyAdd(.., c) | Instruction::MultiplySubtract(.., c) | Instruction::Negate(c) => {
                self.beginning(c, levels - 1, path)
            }
            Instruction::Add(a, b) | Instruction::Subtract(a, b) => {
                self.beginning(a, levels - 1, path) || self.beginning(b, levels - 1, path)
            }
            _ => false,
        };
        if !found {
            path.pop();
        }
        found
    }

    /// When the sum is there if it is begun by what is there at a start.
    fn begun(&self, path: &[usize], start: u32) -> u32 {
        let mut last = start;
        let mut before = usize::MAX;
        for &k in path.iter().rev() {
            let instruction = &self.instructions[k];
            let others = instruction.operands().filter(|operand| operand.instruction() != Some(before));
            let others = others.map(|operand| operand.ready(&self.ready)).max().unwrap_or(0);
            last = last.max(others) + instruction.cycles();
            before = k;
        }
        last
    }

    /// Writes partial sums anew, with the sign that the last is to have.
    fn begin(&mut self, path: &[usize], negative: bool, beginning: &Beginning<S>) -> Operand<S> {
        let (k, rest) = (path[0], &path[1..]);
        let old = self.instructions[k];
        let within = |operand: Operand<S>| rest.first().is_some_and(|&next| operand.is_result_of(next));
        // What is left of it has the other sign where it is subtracted or negated.
        let turned = matches!(old, Instruction::Negate(_)) || matches!(old, Instruction::Subtract(a, _) if !within(a));
        let sum = match rest {
            [] if beginning.subtracted => self.push(Instruction::Negate(beginning.added)),
            [] => beginning.added,
            rest => self.begin(rest, negative != turned, beginning),
        };
        let instruction = match old {
            Instruction::Multiply(a, b) | Instruction::MultiplyAdd(a, b, _) if negative => {
                Instruction::MultiplySubtract(a, b, sum)
            }
            Instruction::MultiplySubtract(a, b, _) if !negative => Instruction::MultiplySubtract(a, b, sum),
            Instruction::Multiply(a, b)
            | Instruction::MultiplyAdd(a, b, _)
            | Instruction::MultiplySubtract(a, b, _) => Instruction::MultiplyAdd(a, b, sum),
            Instruction::Add(a, b) | Instruction::Subtract(a, b) => {
                let other = if within(a) { b } else { a };
                let subtracts = matches!(old, Instruction::Subtract(..)) && !turned;
                if subtracts != negative { Instruction::Subtract(sum, other) } else { Instruction::Add(sum, other) }
            }
            _ => return sum,
        };
        self.push(instruction)
    }
}

/// Path from the last sum to the product that it begins with, and the operand that is added.
struct Beginning<S> {
    /// Its partial sums from the last to the product that it begins with, and its sign.
    path: Vec<usize>,
    negative: bool,
    /// Operand that is added to it, and whether it is subtracted.
    added: Operand<S>,
    subtracted: bool,
}

#[cfg(test)]
mod tests {
    use super::super::input::Input;
    use super::*;

    fn input(component: usize) -> Operand {
        Operand::Input(Input::Component { argument: 0, component })
    }

    fn value(k: usize) -> Operand {
        Operand::Value(k)
    }

    /// Numbers whose products and sums are exact.
    fn results(code: &Code) -> Vec<f64> {
        code.evaluate(|input| match input {
            Input::Component { component, .. } => [3.0, -5.0, 7.0, 11.0, -13.0, 17.0, 19.0][component],
            Input::Number(_) => f64::NAN,
        })
    }

    fn begun(instructions: Vec<Instruction>) -> Code {
        let code = Code { outputs: vec![value(instructions.len() - 1)], instructions };
        let begun = code.sums_begun().unwrap_or_else(|| code.clone());
        assert_eq!(results(&begun), results(&code));
        begun
    }

    fn products(code: &Code) -> usize {
        code.instructions.iter().filter(|i| matches!(i, Instruction::Multiply(..))).count()
    }

    /// Every way in which a sum of two products and a number can be joined, with all signs.
    #[test]
    fn no_sum_begins_with_a_product() {
        let seconds = [Instruction::MultiplyAdd, Instruction::MultiplySubtract];
        let lasts = [
            Instruction::Add(value(1), input(4)),
            Instruction::Add(input(4), value(1)),
            Instruction::Subtract(value(1), input(4)),
            Instruction::Subtract(input(4), value(1)),
        ];
        for second in seconds {
            for last in lasts {
                let product = Instruction::Multiply(input(0), input(1));
                let code = begun(vec![product, second(input(2), input(3), value(0)), last]);
                assert_eq!(products(&code), 0, "{code:?}");
            }
        }
    }

    /// Through sums, differences and negations on the way to the product.
    #[test]
    fn the_product_is_found_behind_other_terms() {
        for between in [
            Instruction::Add(input(5), value(0)),
            Instruction::Subtract(input(5), value(0)),
            Instruction::Subtract(value(0), input(5)),
            Instruction::Negate(value(0)),
        ] {
            for last in [Instruction::Add(value(1), input(6)), Instruction::Subtract(input(6), value(1))] {
                let code = begun(vec![Instruction::Multiply(input(0), input(1)), between, last]);
                assert_eq!(products(&code), 0, "{code:?}");
            }
        }
    }

    #[test]
    fn what_is_read_twice_stays() {
        let product = Instruction::Multiply(input(0), input(1));
        let sum = Instruction::MultiplyAdd(input(2), input(3), value(0));
        let twice = Instruction::Multiply(value(1), value(2));
        assert_eq!(products(&begun(vec![product, sum, Instruction::Add(value(1), input(4)), twice])), 2);
    }

    /// An operand that is there last is added last.
    #[test]
    fn no_chain_becomes_longer() {
        let mut instructions = vec![
            Instruction::Multiply(input(0), input(1)),
            Instruction::MultiplyAdd(input(2), input(3), value(0)),
            Instruction::Call(crate::algebra::Function::Sqrt, input(0)),
        ];
        instructions.push(Instruction::Add(value(1), value(2)));
        assert_eq!(products(&begun(instructions)), 1);
    }
}
