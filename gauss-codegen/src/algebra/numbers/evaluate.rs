//! Numerical values of expressions, for checking one form of a result against another.

use std::ops::{Add, Div, Mul, Neg, Sub};

use crate::algebra::expressions::function::{BinaryFunction, Function, MOST_VARIABLES, OwnFunction};
use crate::algebra::expressions::graph::{Expr, NodeView};
use crate::algebra::expressions::node::{Id, Node};
use crate::algebra::map::Map;
use crate::algebra::rational::Rational;

/// Numbers that expressions are evaluated in, and a program can be run on: `f64`, `f32`, and with a few lines dual
/// numbers, intervals or numbers of more digits.
pub trait Scalar:
    Clone + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self> + Neg<Output = Self>
{
    /// A number that no fraction of integers is, as literals of a scene determine it in double precision.
    fn number(value: f64) -> Self;

    /// A fraction, exactly where the type can hold it.
    fn fraction(value: Rational) -> Self;

    /// Sine and cosine of an angle in radians.
    fn sine_cosine(self) -> (Self, Self);

    /// A function of one argument; NaN, or what stands for it, outside its domain.
    fn call(self, function: Function) -> Self;

    /// A function of two arguments, of which this is the first.
    fn call_with(self, function: BinaryFunction, other: Self) -> Self;
}

macro_rules! primitive {
    ($scalar:ident) => {
        impl Scalar for $scalar {
            fn number(value: f64) -> Self {
                value as $scalar
            }

            fn fraction(value: Rational) -> Self {
                value.to_f64() as $scalar
            }

            fn sine_cosine(self) -> (Self, Self) {
                self.sin_cos()
            }

            fn call(self, function: Function) -> Self {
                match function {
                    Function::Sin => self.sin(),
                    Function::Cos => self.cos(),
                    Function::Exp => self.exp(),
                    Function::Ln => self.ln(),
                    Function::Sqrt => self.sqrt(),
                    Function::Abs => self.abs(),
                    // Unlike that of the primitive type, zero at zero.
                    Function::Signum if self == 0.0 => 0.0,
                    Function::Signum => self.signum(),
                    Function::Tanh => self.tanh(),
                }
            }

            fn call_with(self, function: BinaryFunction, other: Self) -> Self {
                match function {
                    BinaryFunction::Atan2 => self.atan2(other),
                    BinaryFunction::Min => self.min(other),
                    BinaryFunction::Max => self.max(other),
                    BinaryFunction::Powf => self.powf(other),
                }
            }
        }
    };
}

primitive!(f64);
primitive!(f32);

/// Numbers that checks are made in.
pub trait Number: Scalar + Copy + PartialOrd {
    /// Bound of the rest of an unknown when numbers of order one are eliminated from it, which should be zero: some
    /// thousand roundings.
    const NEGLIGIBLE: f64;

    /// The nearest one.
    fn to_f64(self) -> f64;

    /// Whether it is a number.
    fn is_finite(self) -> bool;

    /// An integer power.
    fn powi(self, exponent: i32) -> Self {
        let one = Self::number(1.0);
        let (mut power, mut square, mut remaining) = (one, self, exponent.unsigned_abs());
        while remaining > 0 {
            if remaining & 1 == 1 {
                power = power * square;
            }
            square = square * square;
            remaining >>= 1;
        }
        if exponent < 0 { one / power } else { power }
    }

    /// A function of the user's own, of which nothing is known: a sine of its arguments, shifted and of other
    /// frequencies for each, stands in for it. What holds of any function holds of these.
    fn stand_in(function: OwnFunction, arguments: &[Self]) -> Self {
        let mut angle = Self::number(0.3 + 0.7 * f64::from(function.index));
        let (mut order, mut factor) = (0, 1.0);
        for ((&x, frequency), &times) in arguments.iter().zip(FREQUENCIES).zip(&function.orders) {
            angle = if frequency == 1.0 { x + angle } else { angle + Self::number(frequency) * x };
            order += times;
            factor *= f64::powi(frequency, times.into());
        }
        let (sine, cosine) = angle.sine_cosine();
        let value = match order % 4 {
            0 => sine,
            1 => cosine,
            2 => -sine,
            _ => -cosine,
        };
        if factor == 1.0 { value } else { Self::number(factor) * value }
    }
}

/// Rates of the stand-in of a function of the user's own by each of its arguments.
const FREQUENCIES: [f64; MOST_VARIABLES] = [1.0, 0.6, 1.7];

impl Number for f64 {
    const NEGLIGIBLE: f64 = 1e-12;

    fn to_f64(self) -> f64 {
        self
    }

    fn is_finite(self) -> bool {
        f64::is_finite(self)
    }

    fn powi(self, exponent: i32) -> Self {
        f64::powi(self, exponent)
    }
}

impl Function {
    /// Its derivative.
    pub(super) fn slope<N: Number>(self, x: N) -> N {
        let one = N::number(1.0);
        match self {
            Function::Sin => x.call(Function::Cos),
            Function::Cos => -x.call(Function::Sin),
            Function::Exp => x.call(Function::Exp),
            Function::Ln => one / x,
            Function::Sqrt => N::number(0.5) / x.call(Function::Sqrt),
            Function::Abs => x.call(Function::Signum),
            Function::Signum => N::number(0.0),
            Function::Tanh => {
                let value = x.call(Function::Tanh);
                one - value * value
            }
        }
    }
}

/// Evaluates expressions at a point, each node once.
pub struct Evaluation<'a, N = f64> {
    symbols: &'a Map<u32, N>,
    values: Map<u32, N>,
    /// Functions of the user's own have the values of their stand-ins.
    stand_ins: bool,
}

impl<'a, N: Number> Evaluation<'a, N> {
    /// `symbols` gives the value of every symbol, by key.
    pub fn new(symbols: &'a Map<u32, N>) -> Self {
        Self { symbols, values: Map::default(), stand_ins: true }
    }

    /// The same for what is to be the value indeed: functions of the user's own have none.
    pub fn of_known(symbols: &'a Map<u32, N>) -> Self {
        Self { stand_ins: false, ..Self::new(symbols) }
    }

    /// The values of symbols, by key.
    pub fn symbols(&self) -> &'a Map<u32, N> {
        self.symbols
    }

    /// The value of an expression; NaN where a symbol has none.
    pub fn value(&mut self, e: Expr<'_>) -> N {
        if let Some(&known) = self.values.get(&e.key()) {
            return known;
        }
        for part in e.stages(|key| self.values.contains_key(&key)) {
            self.visit(&e.graph().nodes(), part.key());
        }
        self.visit(&e.graph().nodes(), e.key())
    }

    fn visit(&mut self, nodes: &[Node], id: Id) -> N {
        if let Some(&known) = self.values.get(&id) {
            return known;
        }
        let value = match &nodes[id as usize] {
            Node::Number(value) => N::fraction(*value),
            Node::Symbol(_) => self.symbols.get(&id).copied().unwrap_or(N::number(f64::NAN)),
            Node::Sum(terms) => {
                let mut sum = N::number(0.0);
                for &(c, id) in terms.iter() {
                    sum = sum + N::fraction(c) * self.visit(nodes, id);
                }
                sum
            }
            Node::Product(factors) => {
                let mut product = N::number(1.0);
                for &(id, n) in factors.iter() {
                    product = product * self.visit(nodes, id).powi(n);
                }
                product
            }
            Node::Call(function, id) => self.visit(nodes, *id).call(*function),
            Node::Binary(function, a, b) => self.visit(nodes, *a).call_with(*function, self.visit(nodes, *b)),
            Node::Own(_, ids) if !self.stand_ins => {
                ids.iter().for_each(|id| _ = self.visit(nodes, *id));
                N::number(f64::NAN)
            }
            Node::Own(function, ids) => {
                let arguments = ids.map(|id| self.visit(nodes, id));
                N::stand_in(*function, function.of(&arguments))
            }
            Node::Group(id) | Node::Opaque(id) => self.visit(nodes, *id),
        };
        self.values.insert(id, value);
        value
    }
}

/// Directional derivatives of expressions at a point by dual numbers, each node once: differentiation that owes nothing
/// to the symbolic one.
pub struct Tangents<'a, 'b, N = f64> {
    values: &'a mut Evaluation<'b, N>,
    /// Rate of every symbol that moves.
    direction: &'a Map<u32, N>,
    known: Map<u32, N>,
}

impl<'a, 'b, N: Number> Tangents<'a, 'b, N> {
    /// `direction` gives the rates of symbols, by key; all others stand still.
    pub fn new(values: &'a mut Evaluation<'b, N>, direction: &'a Map<u32, N>) -> Self {
        Self { values, direction, known: Map::default() }
    }

    /// The derivative of an expression along the direction.
    pub fn along(&mut self, e: Expr<'_>) -> N {
        for part in e.stages(|key| self.known.contains_key(&key)) {
            self.visit(part);
        }
        self.visit(e)
    }

    fn visit(&mut self, e: Expr<'_>) -> N {
        if let Some(&known) = self.known.get(&e.key()) {
            return known;
        }
        let zero = N::number(0.0);
        let rate = match e.view() {
            NodeView::Number(_) => zero,
            NodeView::Symbol(_) => self.direction.get(&e.key()).copied().unwrap_or(zero),
            NodeView::Sum(terms) => {
                let mut sum = zero;
                for (c, e) in terms {
                    sum = sum + N::fraction(c) * self.visit(e);
                }
                sum
            }
            NodeView::Product(factors) => {
                // (Π fᵢ^nᵢ)˙ by the product rule on (value, rate) pairs.
                let (mut value, mut rate) = (N::number(1.0), zero);
                for (e, n) in factors {
                    let (x, slope) = (self.values.value(e), self.visit(e));
                    if n == 1 {
                        (value, rate) = (value * x, rate * x + value * slope);
                        continue;
                    }
                    let power = x.powi(n);
                    rate = rate * power + value * N::number(n.into()) * x.powi(n - 1) * slope;
                    value = value * power;
                }
                rate
            }
            NodeView::Call(function, e) => match self.visit(e) {
                still if still == zero => zero,
                rate => function.slope(self.values.value(e)) * rate,
            },
            NodeView::Binary(BinaryFunction::Atan2, y, x) => {
                let (b, a) = (self.values.value(y), self.values.value(x));
                (a * self.visit(y) - b * self.visit(x)) / (a * a + b * b)
            }
            NodeView::Binary(BinaryFunction::Powf, base, exponent) => {
                let (x, p) = (self.values.value(base), self.values.value(exponent));
                let less = x.call_with(BinaryFunction::Powf, p - N::number(1.0));
                let of = |rate: N, slope: &dyn Fn() -> N| if rate == zero { zero } else { slope() * rate };
                let by_base = of(self.along(base), &|| p * less);
                by_base + of(self.along(exponent), &|| x * less * x.call(Function::Ln))
            }
            NodeView::Binary(function, a, b) => {
                let first = self.values.value(a).call_with(function, self.values.value(b)) == self.values.value(a);
                if first { self.visit(a) } else { self.visit(b) }
            }
            NodeView::Own(function, arguments) => {
                let at: Vec<N> = arguments.iter().map(|e| self.values.value(*e)).collect();
                let rates = arguments.into_iter().map(|e| self.visit(e)).enumerate().filter(|(_, rate)| *rate != zero);
                let terms = rates.map(|(k, rate)| N::stand_in(function.derivative(k), &at) * rate);
                terms.reduce(|sum, term| sum + term).unwrap_or(zero)
            }
            NodeView::Group(e) | NodeView::Opaque(e) => self.visit(e),
        };
        self.known.insert(e.key(), rate);
        rate
    }
}
