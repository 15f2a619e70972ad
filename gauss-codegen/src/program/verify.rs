//! The shape of programs, checked after every pass in debug builds.

use crate::algebra::Function;

use super::{Code, Input, Instruction, Malformed, Operand, Program};

impl<S: Copy> Code<S> {
    /// Checks its shape: everything is computed before it is read, sines and cosines come in pairs, nothing is idle.
    ///
    /// # Errors
    /// The first thing that is wrong.
    pub fn verify(&self) -> Result<(), Malformed> {
        for (k, instruction) in self.instructions.iter().enumerate() {
            if let Instruction::Call(Function::Sin | Function::Cos, _) = instruction {
                return Err(Malformed::LoneSine(k));
            }
            instruction.operands().try_for_each(|operand| self.verify_operand(operand, Some(k)))?;
        }
        self.outputs.iter().try_for_each(|&operand| self.verify_operand(operand, None))?;
        self.needed().iter().position(|needed| !needed).map_or(Ok(()), |k| Err(Malformed::Idle(k)))
    }

    fn verify_operand(&self, operand: Operand<S>, reader: Option<usize>) -> Result<(), Malformed> {
        let read = match operand {
            Operand::Number(n) if n.is_overflow() => return Err(Malformed::NotANumber),
            Operand::Input(_) | Operand::Number(_) => return Ok(()),
            Operand::Value(k) | Operand::Sine(k) | Operand::Cosine(k) => k,
        };
        if read >= reader.unwrap_or(self.instructions.len()) {
            return Err(Malformed::NotComputed { reader, read });
        }
        let pair = matches!(self.instructions[read], Instruction::SineCosine(_));
        if pair == matches!(operand, Operand::Value(_)) { Err(Malformed::NoPair(read)) } else { Ok(()) }
    }

    /// The same code, after its shape is checked in debug builds: what every pass hands on.
    pub(crate) fn verified(self) -> Self {
        if cfg!(debug_assertions)
            && let Err(malformed) = self.verify()
        {
            unreachable!("a pass made a program of wrong shape: {malformed}");
        }
        self
    }
}

impl Program {
    /// Checks its shape: that of its code, and that its inputs and results are there.
    ///
    /// # Errors
    /// The first thing that is wrong.
    pub fn verify(&self) -> Result<(), Malformed> {
        self.code.verify()?;
        for operand in self.code.operands() {
            if let Operand::Input(input) = operand {
                let exists = match input {
                    Input::Component { argument, component } => {
                        self.arguments.get(argument).is_some_and(|argument| component < argument.components.len())
                    }
                    Input::Number(number) => number < self.numbers.len(),
                };
                if !exists {
                    return Err(Malformed::NoSuchInput(input));
                }
            }
        }
        let (expected, found) = (self.results.iter().map(|r| r.len()).sum(), self.code.outputs.len());
        if expected != found {
            return Err(Malformed::Outputs { expected, found });
        }
        let names = || self.arguments.iter().map(|a| &a.name).chain(self.results.iter().map(|r| &r.name));
        match names().enumerate().find(|(k, name)| names().skip(k + 1).any(|other| other == *name)) {
            Some((_, name)) => Err(Malformed::Named(name.clone())),
            None => Ok(()),
        }
    }
}
