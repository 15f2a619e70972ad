//! Programs of directional derivatives: forward differentiation, instruction by instruction.
//!
//! A program of f(x) becomes one of ∂f/∂x·dx, in exact arithmetic of the same operations. Where a function has a kink
//! (`abs`, `min`, `max`) it is the mean of the derivatives on both sides.

use gauss_codegen::program::{
    Argument, ArgumentKind, BinaryFunction, Code, Function, Input, Instruction, Malformed, Operand, Program, Rational,
    Results,
};

/// The program of the derivative along changes of the arguments of these kinds, which follow the arguments under their
/// names with a `d` in front.
///
/// # Errors
/// A mistake of this crate.
pub fn tangent(program: &Program, name: &str, kinds: &[ArgumentKind]) -> Result<Program, Malformed> {
    let mut arguments = program.arguments.clone();
    let mut seeds = vec![None; arguments.len()];
    for (place, argument) in program.arguments.iter().enumerate().filter(|(_, own)| kinds.contains(&own.kind)) {
        seeds[place] = Some(arguments.len());
        let components = argument.components.iter().map(|component| format!("d{component}")).collect();
        arguments.push(Argument::new(argument.kind, format!("d{}", argument.name), components));
    }
    let mut made = Tangents { seeds, instructions: Vec::new(), places: Vec::new(), of: Vec::new() };
    program.code.instructions.iter().for_each(|instruction| made.follow(instruction));
    let outputs = program.code.outputs.iter();
    let outputs = outputs.map(|output| made.change(*output).unwrap_or(ZERO)).collect();
    let code = Code { instructions: made.instructions, outputs }.without_idle();
    let count = code.outputs.len();
    Program::new(name, arguments, program.numbers.clone(), code, vec![Results::new("change", count, 1)])
}

const ZERO: Operand = Operand::Number(Rational::zero());
const ONE: Operand = Operand::Number(Rational::one());

struct Tangents {
    /// The argument of the changes of each argument, if there is one.
    seeds: Vec<Option<usize>>,
    instructions: Vec<Instruction>,
    /// The place of each instruction of the program among the new ones.
    places: Vec<usize>,
    /// The change of its result; of a pair that of the sine, then that of the cosine.
    of: Vec<[Option<Operand>; 2]>,
}

impl Tangents {
    fn push(&mut self, instruction: Instruction) -> Operand {
        self.instructions.push(instruction);
        Operand::Value(self.instructions.len() - 1)
    }

    /// The same operand among the new instructions.
    fn moved(&self, operand: Operand) -> Operand {
        operand.moved(|k| self.places[k])
    }

    /// The change of an operand of the program; `None` is zero.
    fn change(&self, operand: Operand) -> Option<Operand> {
        match operand {
            Operand::Input(Input::Component { argument, component }) => {
                self.seeds[argument].map(|argument| Operand::Input(Input::Component { argument, component }))
            }
            Operand::Input(Input::Number(_)) | Operand::Number(_) => None,
            Operand::Value(k) | Operand::Sine(k) => self.of[k][0],
            Operand::Cosine(k) => self.of[k][1],
        }
    }

    fn sum(&mut self, a: Option<Operand>, b: Option<Operand>) -> Option<Operand> {
        match (a, b) {
            (Some(a), Some(b)) => Some(self.push(Instruction::Add(a, b))),
            (a, b) => a.or(b),
        }
    }

    fn negative(&mut self, a: Option<Operand>) -> Option<Operand> {
        a.map(|a| self.push(Instruction::Negate(a)))
    }

    fn times(&mut self, a: Option<Operand>, b: Operand) -> Option<Operand> {
        a.map(|a| self.push(Instruction::Multiply(a, b)))
    }

    fn over(&mut self, a: Option<Operand>, b: Operand) -> Option<Operand> {
        a.map(|a| self.push(Instruction::Divide(a, b)))
    }

    /// The change of a product.
    fn product(&mut self, a: Operand, b: Operand) -> Option<Operand> {
        let (da, db) = (self.change(a), self.change(b));
        let (left, right) = (self.times(da, self.moved(b)), self.times(db, self.moved(a)));
        self.sum(left, right)
    }

    fn follow(&mut self, instruction: &Instruction) {
        let own = self.push(instruction.map(|operand| self.moved(operand)));
        self.places.push(self.instructions.len() - 1);
        let change = match *instruction {
            Instruction::Add(a, b) => self.sum(self.change(a), self.change(b)),
            Instruction::Subtract(a, b) => {
                let minus = self.negative(self.change(b));
                self.sum(self.change(a), minus)
            }
            Instruction::Multiply(a, b) => self.product(a, b),
            Instruction::MultiplyAdd(a, b, c) => {
                let product = self.product(a, b);
                self.sum(product, self.change(c))
            }
            Instruction::MultiplySubtract(a, b, c) => {
                let product = self.product(a, b);
                let minus = self.negative(product);
                self.sum(minus, self.change(c))
            }
            Instruction::Divide(a, b) => {
                let by_divisor = self.times(self.change(b), own);
                let minus = self.negative(by_divisor);
                let numerator = self.sum(self.change(a), minus);
                self.over(numerator, self.moved(b))
            }
            Instruction::Negate(a) => self.negative(self.change(a)),
            Instruction::SineCosine(a) => return self.follow_pair(a),
            Instruction::Call(function, a) => self.called(function, a, own),
            Instruction::Binary(function, a, b) => self.binary(function, [a, b], own),
            // Scenes with functions of Rust are refused before.
            Instruction::Own(..) => None,
        };
        self.of.push([change, None]);
    }

    fn follow_pair(&mut self, a: Operand) {
        let (place, change) = (self.instructions.len() - 1, self.change(a));
        let of_sine = self.times(change, Operand::Cosine(place));
        let of_cosine = self.times(change, Operand::Sine(place));
        let of_cosine = self.negative(of_cosine);
        self.of.push([of_sine, of_cosine]);
    }

    fn called(&mut self, function: Function, a: Operand, own: Operand) -> Option<Operand> {
        let change = self.change(a)?;
        let argument = self.moved(a);
        let slope = match function {
            Function::Exp => own,
            Function::Ln => return self.over(Some(change), argument),
            Function::Sqrt => {
                let half = self.push(Instruction::Multiply(change, Operand::Number(Rational::new(1, 2))));
                return self.over(Some(half), own);
            }
            Function::Abs => self.push(Instruction::Call(Function::Signum, argument)),
            Function::Signum => return None,
            Function::Tanh => self.push(Instruction::MultiplySubtract(own, own, ONE)),
            Function::Sin | Function::Cos => {
                let Operand::Value(place) = self.push(Instruction::SineCosine(argument)) else { return None };
                match function {
                    Function::Sin => Operand::Cosine(place),
                    _ => self.push(Instruction::Negate(Operand::Sine(place))),
                }
            }
        };
        self.times(Some(change), slope)
    }

    fn binary(&mut self, function: BinaryFunction, [a, b]: [Operand; 2], own: Operand) -> Option<Operand> {
        let (da, db) = (self.change(a), self.change(b));
        if da.is_none() && db.is_none() {
            return None;
        }
        let (a, b) = (self.moved(a), self.moved(b));
        match function {
            BinaryFunction::Atan2 => {
                let (left, right) = (self.times(da, b), self.times(db, a));
                let minus = self.negative(right);
                let numerator = self.sum(left, minus);
                let square = self.push(Instruction::Multiply(a, a));
                let square = self.push(Instruction::MultiplyAdd(b, b, square));
                self.over(numerator, square)
            }
            // Half of (da + db) ± sign(a − b) (da − db).
            BinaryFunction::Max | BinaryFunction::Min => {
                let difference = self.push(Instruction::Subtract(a, b));
                let sign = self.push(Instruction::Call(Function::Signum, difference));
                let sign = if function == BinaryFunction::Min { self.push(Instruction::Negate(sign)) } else { sign };
                let minus = self.negative(db);
                let (sum, apart) = (self.sum(da, db), self.sum(da, minus));
                let apart = self.times(apart, sign);
                let both = self.sum(sum, apart);
                self.times(both, Operand::Number(Rational::new(1, 2)))
            }
            BinaryFunction::Powf => {
                let less = self.push(Instruction::Subtract(b, ONE));
                let power = self.push(Instruction::Binary(BinaryFunction::Powf, a, less));
                let slope = self.push(Instruction::Multiply(b, power));
                let by_base = self.times(da, slope);
                let by_exponent = db.map(|db| {
                    let logarithm = self.push(Instruction::Call(Function::Ln, a));
                    let slope = self.push(Instruction::Multiply(own, logarithm));
                    self.push(Instruction::Multiply(db, slope))
                });
                self.sum(by_base, by_exponent)
            }
        }
    }
}
