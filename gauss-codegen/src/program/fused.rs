//! Products within the sums that read them: a product that is only added is part of each addition.

use super::code::Code;
use super::instruction::{Instruction, Operand};

impl<S: Copy> Code<S> {
    /// The same with products that nothing but additions and subtractions read formed in these: one instruction less
    /// for each where products are fused, and the same where they are not, since compilers form what is the same once.
    pub(crate) fn with_products_in_sums(self) -> Self {
        let readers = self.readers();
        // What an addition takes in.
        let mut taken: Vec<Option<usize>> = vec![None; self.instructions.len()];
        for (k, instruction) in self.instructions.iter().enumerate() {
            let Instruction::Multiply(..) = instruction else { continue };
            let Some(readers) = &readers[k] else { continue };
            if readers.iter().all(|&sum| taken[sum].is_none() && self.takes(sum, k)) {
                readers.iter().for_each(|&sum| taken[sum] = Some(k));
            }
        }
        let fused = self.instructions.iter().zip(&taken).map(|(instruction, product)| {
            let Some(product) = *product else { return *instruction };
            let Instruction::Multiply(a, b) = self.instructions[product] else { return *instruction };
            match *instruction {
                Instruction::Add(x, y) if y.is_result_of(product) => Instruction::MultiplyAdd(a, b, x),
                Instruction::Add(_, y) => Instruction::MultiplyAdd(a, b, y),
                Instruction::Subtract(x, _) => Instruction::MultiplySubtract(a, b, x),
                other => other,
            }
        });
        Self { instructions: fused.collect(), outputs: self.outputs }.without_idle().verified()
    }

    /// Which instructions read the result of each; nothing where it is an output.
    fn readers(&self) -> Vec<Option<Vec<usize>>> {
        let mut readers = vec![Some(Vec::new()); self.instructions.len()];
        for (reader, instruction) in self.instructions.iter().enumerate() {
            for k in instruction.operands().filter_map(Operand::instruction) {
                readers[k].iter_mut().for_each(|readers| readers.push(reader));
            }
        }
        self.outputs.iter().filter_map(|output| output.instruction()).for_each(|k| readers[k] = None);
        readers
    }

    /// Whether that sum can have the product as its product.
    fn takes(&self, sum: usize, product: usize) -> bool {
        match self.instructions[sum] {
            Instruction::Add(a, b) => a.is_result_of(product) != b.is_result_of(product),
            Instruction::Subtract(a, b) => !a.is_result_of(product) && b.is_result_of(product),
            _ => false,
        }
    }
}
