//! Programs and what they read as one list of steps, with a first-order analysis of its rounding in one pass: macros
//! run unoptimised, where a step of [`Code::evaluate_with`] takes hundreds of instructions of the machine.

use crate::algebra::{
    BinaryFunction, Doubled, Dual, Expr, Function, Map, NodeView, Number, OwnFunction, Rational, Scalar,
};
use crate::program::{Code, Instruction, Operand};

use super::random::Random;

/// Place where a number is kept.
pub type Slot = u32;

#[derive(Clone, Copy)]
enum Opcode {
    Add,
    Subtract,
    Multiply,
    MultiplyAdd,
    MultiplySubtract,
    Divide,
    Negate,
    /// The cosine is kept beside the sine.
    SineCosine,
    Call(Function),
    Binary(BinaryFunction),
    Own(OwnFunction),
}

#[derive(Clone, Copy)]
struct FlatInstruction {
    kind: Opcode,
    from: [Slot; 3],
    to: Slot,
}

/// Steps, made from programs and expressions.
#[derive(Default)]
pub struct Flat {
    steps: Vec<FlatInstruction>,
    slots: usize,
    /// Slots of the symbols and expressions, by their keys.
    known: Map<u32, Slot>,
    inputs: Vec<(u32, Slot)>,
    numbers: Vec<(Rational, Slot)>,
    places: Map<Rational, Slot>,
}

impl Flat {
    fn slot(&mut self) -> Slot {
        self.slots += 1;
        (self.slots - 1) as Slot
    }

    fn step(&mut self, kind: Opcode, from: [Slot; 3]) -> Slot {
        let to = self.slot();
        if matches!(kind, Opcode::SineCosine) {
            self.slot();
        }
        self.steps.push(FlatInstruction { kind, from, to });
        to
    }

    fn number(&mut self, value: Rational) -> Slot {
        if let Some(&slot) = self.places.get(&value) {
            return slot;
        }
        let slot = self.slot();
        self.places.insert(value, slot);
        self.numbers.push((value, slot));
        slot
    }

    /// Slot of a symbol: an input, unless it was [defined](Self::define).
    fn symbol(&mut self, key: u32) -> Slot {
        if let Some(&slot) = self.known.get(&key) {
            return slot;
        }
        let slot = self.slot();
        self.known.insert(key, slot);
        self.inputs.push((key, slot));
        slot
    }

    /// From here on a symbol stands for what is kept there.
    pub fn define(&mut self, symbol: u32, slot: Slot) {
        self.known.insert(symbol, slot);
    }

    /// Slot of an input, if that symbol is one.
    pub fn input(&self, symbol: Expr<'_>) -> Option<Slot> {
        self.inputs.iter().find(|(key, _)| *key == symbol.key()).map(|(_, slot)| *slot)
    }

    /// Number of the steps.
    pub fn len(&self) -> usize {
        self.steps.len()
    }

    /// Number of the numbers that are kept.
    pub fn slots(&self) -> usize {
        self.slots
    }

    /// Keys of the symbols that values are wanted of, with their slots.
    pub fn inputs(&self) -> &[(u32, Slot)] {
        &self.inputs
    }

    /// The components of a vector divided by its norm: what its symbols stand for from here on.
    pub fn scale(&mut self, unit: &[Expr<'_>]) {
        let raw: Vec<Slot> = unit.iter().map(|symbol| self.symbol(symbol.key())).collect();
        let squares: Vec<Slot> = raw.iter().map(|&x| self.step(Opcode::Multiply, [x, x, x])).collect();
        let sum = squares.into_iter().reduce(|a, b| self.step(Opcode::Add, [a, b, b]));
        let Some(sum) = sum else { return };
        let norm = self.step(Opcode::Call(Function::Sqrt), [sum; 3]);
        for (symbol, x) in unit.iter().zip(raw) {
            let scaled = self.step(Opcode::Divide, [x, norm, norm]);
            self.define(symbol.key(), scaled);
        }
    }

    /// Its outputs.
    pub fn program(&mut self, code: &Code<Expr<'_>>) -> Vec<Slot> {
        let mut results: Vec<Slot> = Vec::with_capacity(code.instructions.len());
        for instruction in &code.instructions {
            let mut at = |operand: Operand<Expr<'_>>| self.operand(operand, &results);
            let (kind, from) = match *instruction {
                Instruction::Add(a, b) => (Opcode::Add, [at(a), at(b), 0]),
                Instruction::Subtract(a, b) => (Opcode::Subtract, [at(a), at(b), 0]),
                Instruction::Multiply(a, b) => (Opcode::Multiply, [at(a), at(b), 0]),
                Instruction::MultiplyAdd(a, b, c) => (Opcode::MultiplyAdd, [at(a), at(b), at(c)]),
                Instruction::MultiplySubtract(a, b, c) => (Opcode::MultiplySubtract, [at(a), at(b), at(c)]),
                Instruction::Divide(a, b) => (Opcode::Divide, [at(a), at(b), 0]),
                Instruction::Negate(a) => (Opcode::Negate, [at(a), 0, 0]),
                Instruction::SineCosine(a) => (Opcode::SineCosine, [at(a), 0, 0]),
                Instruction::Call(function, a) => (Opcode::Call(function), [at(a), 0, 0]),
                Instruction::Binary(function, a, b) => (Opcode::Binary(function), [at(a), at(b), 0]),
                Instruction::Own(function, arguments) => (Opcode::Own(function), arguments.map(at)),
            };
            let slot = self.step(kind, from);
            results.push(slot);
        }
        code.outputs.iter().map(|&output| self.operand(output, &results)).collect()
    }

    fn operand(&mut self, operand: Operand<Expr<'_>>, results: &[Slot]) -> Slot {
        match operand {
            Operand::Input(symbol) => self.symbol(symbol.key()),
            Operand::Number(value) => self.number(value),
            Operand::Value(k) | Operand::Sine(k) => results[k],
            Operand::Cosine(k) => results[k] + 1,
        }
    }

    /// The value of an expression, each part of it once.
    pub fn expression(&mut self, e: Expr<'_>) -> Slot {
        for part in e.stages(|key| self.known.contains_key(&key)) {
            self.visit(part);
        }
        self.visit(e)
    }

    fn visit(&mut self, e: Expr<'_>) -> Slot {
        if let Some(&slot) = self.known.get(&e.key()) {
            return slot;
        }
        let slot = match e.view() {
            NodeView::Symbol(_) => return self.symbol(e.key()),
            NodeView::Number(value) => self.number(value),
            NodeView::Sum(terms) => {
                let terms: Vec<Slot> = terms.into_iter().map(|(c, term)| self.term(c, term)).collect();
                self.joined(Opcode::Add, terms)
            }
            NodeView::Product(factors) => {
                let powers: Vec<Slot> = factors.into_iter().map(|(factor, n)| self.power(factor, n)).collect();
                self.joined(Opcode::Multiply, powers)
            }
            NodeView::Call(Function::Sin, inner) => self.sine_cosine(inner),
            NodeView::Call(Function::Cos, inner) => self.sine_cosine(inner) + 1,
            NodeView::Call(function, inner) => {
                let inner = self.visit(inner);
                self.step(Opcode::Call(function), [inner, 0, 0])
            }
            NodeView::Binary(function, a, b) => {
                let [a, b] = [a, b].map(|e| self.visit(e));
                self.step(Opcode::Binary(function), [a, b, 0])
            }
            NodeView::Own(function, arguments) => {
                let arguments: Vec<Slot> = arguments.into_iter().map(|e| self.visit(e)).collect();
                self.step(Opcode::Own(function), OwnFunction::filled(&arguments))
            }
            NodeView::Group(inner) | NodeView::Opaque(inner) => self.visit(inner),
        };
        self.known.insert(e.key(), slot);
        slot
    }

    fn sine_cosine(&mut self, angle: Expr<'_>) -> Slot {
        let angle = self.visit(angle);
        self.step(Opcode::SineCosine, [angle, 0, 0])
    }

    fn term(&mut self, coefficient: Rational, term: Expr<'_>) -> Slot {
        let term = self.visit(term);
        if coefficient.is_one() {
            return term;
        }
        let coefficient = self.number(coefficient);
        self.step(Opcode::Multiply, [coefficient, term, 0])
    }

    fn joined(&mut self, kind: Opcode, slots: Vec<Slot>) -> Slot {
        let joined = slots.into_iter().reduce(|a, b| self.step(kind, [a, b, 0]));
        joined.unwrap_or_else(|| self.number(Rational::zero()))
    }

    fn power(&mut self, base: Expr<'_>, exponent: i32) -> Slot {
        let base = self.visit(base);
        let factors = vec![base; exponent.unsigned_abs() as usize];
        let power = self.joined(Opcode::Multiply, factors);
        if exponent > 0 {
            return power;
        }
        let one = self.number(Rational::one());
        self.step(Opcode::Divide, [one, power, 0])
    }
}

/// A number with its error and with what two changes of all inputs at once do to it, both to first order.
#[derive(Clone, Copy, Default)]
pub struct TracedNumber {
    pub value: f64,
    pub error: f64,
    first: f64,
    second: f64,
}

impl TracedNumber {
    /// An input of that name.
    fn given(value: f64, name: u64) -> Self {
        // Of the mean square one: changes of one size would leave out what two of them cancel in.
        let mut random = Random::new(name);
        let size = value * 3.0_f64.sqrt();
        let [first, second] = [2.0 * random.fraction() - 1.0, 2.0 * random.fraction() - 1.0];
        Self { value, error: 0.0, first: size * first, second: size * second }
    }

    /// The value of a function of two numbers, with its own error and its slopes.
    fn of(value: f64, error: f64, (da, a): (f64, Self), (db, b): (f64, Self)) -> Self {
        Self {
            value,
            error: da * a.error + db * b.error + error,
            first: da * a.first + db * b.first,
            second: da * a.second + db * b.second,
        }
    }

    /// a + s b.
    fn sum(a: Self, b: Self, s: f64) -> Self {
        // What the sum leaves out (Knuth).
        let other = s * b.value;
        let value = a.value + other;
        let part = value - a.value;
        let left = (a.value - (value - part)) + (other - part);
        Self {
            value,
            error: a.error + s * b.error - left,
            first: a.first + s * b.first,
            second: a.second + s * b.second,
        }
    }

    fn product(a: Self, b: Self) -> Self {
        let value = a.value * b.value;
        Self {
            value,
            error: b.value * a.error + a.value * b.error - a.value.mul_add(b.value, -value),
            first: b.value * a.first + a.value * b.first,
            second: b.value * a.second + a.value * b.second,
        }
    }

    fn quotient(a: Self, b: Self) -> Self {
        let value = a.value / b.value;
        let left = (-value).mul_add(b.value, a.value);
        Self::of(value, -left / b.value, (1.0 / b.value, a), (-value / b.value, b))
    }
}

/// Effect of a change of every input in its last place on a number, which several traces may have changed.
pub fn unit(traced: &[TracedNumber]) -> f64 {
    let mut squares = 0.0;
    for TracedNumber { first, second, .. } in traced {
        squares += first * first + second * second;
    }
    f64::EPSILON * (traced[0].value.abs() + (squares / (2 * traced.len()) as f64).sqrt())
}

/// The numbers in the slots, with what else the changes of inputs depend on.
pub struct Trace {
    slots: Vec<TracedNumber>,
    changes: u64,
}

impl Flat {
    /// Room for the numbers, with those that are in the code; changes differ from one number of them to the next.
    pub fn room(&self, changes: u64) -> Trace {
        let mut slots = vec![TracedNumber::default(); self.slots];
        for &(value, slot) in &self.numbers {
            let nearest = value.to_f64();
            // Its own rounding is an error like any other: what it is computed from may be exact in the scene.
            let error = (Doubled::number(nearest) - Doubled::fraction(value)).to_f64();
            slots[slot as usize] = TracedNumber { value: nearest, error, ..TracedNumber::default() };
        }
        Trace { slots, changes }
    }
}

impl Trace {
    pub fn slots(&self) -> &[TracedNumber] {
        &self.slots
    }

    pub fn give(&mut self, slot: Slot, value: f64) {
        self.slots[slot as usize] = TracedNumber::given(value, name(slot, self.changes));
    }

    /// Carries out steps.
    pub fn run(&mut self, flat: &Flat, from: usize, to: usize) {
        let slots: &mut [TracedNumber] = &mut self.slots;
        for step in &flat.steps[from..to] {
            let [a, b] = [slots[step.from[0] as usize], slots[step.from[1] as usize]];
            let result = match step.kind {
                Opcode::Add => TracedNumber::sum(a, b, 1.0),
                Opcode::Subtract => TracedNumber::sum(a, b, -1.0),
                Opcode::Multiply => TracedNumber::product(a, b),
                Opcode::MultiplyAdd => {
                    TracedNumber::sum(slots[step.from[2] as usize], TracedNumber::product(a, b), 1.0)
                }
                Opcode::MultiplySubtract => {
                    TracedNumber::sum(slots[step.from[2] as usize], TracedNumber::product(a, b), -1.0)
                }
                Opcode::Divide => TracedNumber::quotient(a, b),
                Opcode::Negate => TracedNumber { value: -a.value, error: -a.error, first: -a.first, second: -a.second },
                Opcode::SineCosine => {
                    let (sine, cosine) = a.value.sin_cos();
                    slots[step.to as usize + 1] =
                        TracedNumber::of(cosine, rounded(cosine, step.to + 1), (-sine, a), (0.0, a));
                    TracedNumber::of(sine, rounded(sine, step.to), (cosine, a), (0.0, a))
                }
                Opcode::Call(function) => {
                    let Dual { value, rate } = Dual { value: a.value, rate: 1.0 }.call(function);
                    let error = match function {
                        Function::Abs | Function::Signum => 0.0,
                        // Of x² it is the number that was squared.
                        Function::Sqrt if value > 0.0 => value.mul_add(value, -a.value) / (2.0 * value),
                        _ => rounded(value, step.to),
                    };
                    TracedNumber::of(value, error, (rate, a), (0.0, a))
                }
                Opcode::Binary(function) => {
                    let of = |da, db| {
                        Dual { value: a.value, rate: da }.call_with(function, Dual { value: b.value, rate: db })
                    };
                    let (Dual { value, rate: da }, Dual { rate: db, .. }) = (of(1.0, 0.0), of(0.0, 1.0));
                    let exact = matches!(function, BinaryFunction::Min | BinaryFunction::Max);
                    TracedNumber::of(value, if exact { 0.0 } else { rounded(value, step.to) }, (da, a), (db, b))
                }
                Opcode::Own(function) => {
                    let arguments = step.from.map(|slot| slots[slot as usize]);
                    let arguments = function.of(&arguments);
                    let at: Vec<f64> = arguments.iter().map(|a| a.value).collect();
                    let value = f64::stand_in(function, &at);
                    let mut result = TracedNumber { value, error: rounded(value, step.to), ..TracedNumber::default() };
                    for (k, &argument) in arguments.iter().enumerate() {
                        let slope = f64::stand_in(function.derivative(k), &at);
                        result = TracedNumber::of(value, 0.0, (1.0, result), (slope, argument));
                    }
                    result
                }
            };
            slots[step.to as usize] = result;
        }
    }
}

impl Flat {
    /// The numbers in the slots in arithmetic of another kind, up to a step, from values of the inputs.
    pub fn run<N: Number>(&self, inputs: impl Fn(u32, Slot) -> N, to: usize) -> Vec<N> {
        let mut slots = vec![N::number(0.0); self.slots];
        self.numbers.iter().for_each(|&(value, slot)| slots[slot as usize] = N::fraction(value));
        self.inputs.iter().for_each(|&(key, slot)| slots[slot as usize] = inputs(key, slot));
        for step in &self.steps[..to] {
            let [a, b, c] = step.from.map(|slot| slots[slot as usize]);
            slots[step.to as usize] = match step.kind {
                Opcode::Add => a + b,
                Opcode::Subtract => a - b,
                Opcode::Multiply => a * b,
                Opcode::MultiplyAdd => c + a * b,
                Opcode::MultiplySubtract => c - a * b,
                Opcode::Divide => a / b,
                Opcode::Negate => -a,
                Opcode::SineCosine => {
                    let (sine, cosine) = a.sine_cosine();
                    slots[step.to as usize + 1] = cosine;
                    sine
                }
                Opcode::Call(function) => a.call(function),
                Opcode::Binary(function) => a.call_with(function, b),
                Opcode::Own(function) => N::stand_in(function, function.of(&[a, b, c])),
            };
        }
        slots
    }
}

/// Seed of the change of the number in a slot.
fn name(slot: Slot, changes: u64) -> u64 {
    changes << 32 | u64::from(slot)
}

/// A rounding of a function whose exact value is not at hand: a quarter of a unit in the last place, of either sign.
fn rounded(value: f64, place: Slot) -> f64 {
    0.25 * f64::EPSILON * value * if place.count_ones().is_multiple_of(2) { 1.0 } else { -1.0 }
}
