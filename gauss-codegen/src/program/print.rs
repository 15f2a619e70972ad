//! Programs as text, one instruction a line.

use std::fmt;

use super::function::Program;
use super::input::{Argument, Input};
use super::instruction::{Instruction, Operand};

/// ```text
/// acceleration(k: constants, z: speeds)
///   k = (k0, k1, k2)
///   z = (ω1, ω2, ω3)
///   %0 = ω2 * ω3
///   %1 = k0 * %0
///   acceleration = (%1, …)
///   3 add, 6 mul; cost 9, chain 8
/// ```
///
/// Results are `%k` with `k` the index of the instruction, `sin %k` and `cos %k` the parts of a pair. An input is
/// written by its name where only one has that name, else as a component of its argument.
impl fmt::Display for Program {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let arguments = self.arguments.iter().map(|argument| format!("{}: {}", argument.name, argument.kind));
        writeln!(f, "{}({})", self.name, arguments.collect::<Vec<_>>().join(", "))?;
        for argument in self.arguments.iter().filter(|argument| argument.components != [argument.name.clone()]) {
            writeln!(f, "  {} = ({})", argument.name, argument.components.join(", "))?;
        }
        for (k, instruction) in self.code.instructions.iter().enumerate() {
            writeln!(f, "  %{k} = {}", self.written(instruction))?;
        }
        let mut outputs = self.code.outputs.iter().map(|&output| self.operand(output));
        for result in &self.results {
            let values: Vec<String> = outputs.by_ref().take(result.len()).collect();
            let rows: Vec<String> = values.chunks(result.columns.max(1)).map(|row| row.join(", ")).collect();
            writeln!(f, "  {} = ({})", result.name, rows.join("; "))?;
        }
        let cost = self.code.cost();
        writeln!(f, "  {}; cost {}, chain {}", self.code.counts(), cost.total(), cost.chain)
    }
}

impl Program {
    fn written(&self, instruction: &Instruction) -> String {
        let of = |operand: &Operand| self.operand(*operand);
        match instruction {
            Instruction::Add(a, b) => format!("{} + {}", of(a), of(b)),
            Instruction::Subtract(a, b) => format!("{} - {}", of(a), of(b)),
            Instruction::Multiply(a, b) => format!("{} * {}", of(a), of(b)),
            Instruction::MultiplyAdd(a, b, c) => format!("{} * {} + {}", of(a), of(b), of(c)),
            Instruction::MultiplySubtract(a, b, c) => format!("{} - {} * {}", of(c), of(a), of(b)),
            Instruction::Divide(a, b) => format!("{} / {}", of(a), of(b)),
            Instruction::Negate(a) => format!("-{}", of(a)),
            Instruction::SineCosine(a) => format!("sin_cos({})", of(a)),
            Instruction::Call(function, a) => format!("{}({})", function.name(), of(a)),
            Instruction::Binary(function, a, b) => format!("{}({}, {})", function.name(), of(a), of(b)),
            Instruction::Own(own, arguments) => {
                let name = self.functions.get(usize::from(own.index)).map_or("own", String::as_str);
                let arguments: Vec<String> = own.of(arguments).iter().map(of).collect();
                let derivative = if own.variables == 1 { "'".repeat(own.order().into()) } else { own.suffix() };
                format!("{name}{derivative}({})", arguments.join(", "))
            }
        }
    }

    fn operand(&self, operand: Operand) -> String {
        match operand {
            Operand::Input(Input::Number(number)) => format!("{:?}", self.numbers[number]),
            Operand::Input(Input::Component { argument, component }) => self.name_of(argument, component),
            Operand::Number(n) => match n.parts() {
                Some((numerator @ 0.., 1)) => numerator.to_string(),
                _ => format!("({n:?})"),
            },
            Operand::Value(k) => format!("%{k}"),
            Operand::Sine(k) => format!("sin %{k}"),
            Operand::Cosine(k) => format!("cos %{k}"),
        }
    }

    fn name_of(&self, argument: usize, component: usize) -> String {
        let Argument { name, components, .. } = &self.arguments[argument];
        let own = &components[component];
        let same = self.arguments.iter().flat_map(|argument| &argument.components).filter(|other| *other == own);
        if same.count() == 1 { own.clone() } else { format!("{name}[{component}]") }
    }
}
