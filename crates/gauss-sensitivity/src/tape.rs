//! A scalar that writes down what is done with it, so that derivatives are found backward.
//!
//! Each operation on a [`Taped`] number adds a node to the tape of the thread: the numbers it was made of, and its
//! derivatives by them. A sweep from the last node to the first one then gives the derivatives of one number by all
//! others, at a cost that does not depend on how many these are (A. Griewank & A. Walther, *Evaluating Derivatives*,
//! SIAM 2008, chapter 3).

use std::cell::RefCell;
use std::marker::PhantomData;
use std::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Range, Sub, SubAssign};
use std::sync::atomic::{AtomicU32, Ordering};

use gauss_runtime::__crates_0_1_0::packs_of_one;
use gauss_runtime::real::Real;

/// The node of a number that depends on nothing.
const NONE: u32 = u32::MAX;

/// A number on the tape of its thread, or a constant.
///
/// Comparisons are those of values; kinks are as those of [`Dual`](gauss_runtime::dual::Dual): where two numbers are
/// equal, `min`, `max` and `abs` have the mean of the derivatives on both sides. What does not change a result to
/// first order adds nothing to a derivative, also where another factor is infinite.
///
/// It belongs to one recording of one thread. In another one what is made of it is not a number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Taped {
    value: f64,
    node: u32,
    tape: u32,
}

/// One operation: the nodes of its arguments, and its derivatives by them.
#[derive(Clone, Copy)]
struct Node {
    arguments: [u32; 2],
    derivatives: [f64; 2],
}

struct Tape {
    /// 0 where nothing is recorded.
    number: u32,
    nodes: Vec<Node>,
    most: usize,
}

thread_local! {
    static TAPE: RefCell<Tape> = const { RefCell::new(Tape { number: 0, nodes: Vec::new(), most: 0 }) };
}

/// The number of the next recording, over all threads.
static NEXT: AtomicU32 = AtomicU32::new(1);

/// One more node on the tape of this thread; `NONE` where the tape is full, or is that of another recording.
// A call whose numbers come in registers: a node that is handed on as a whole is written and read again at once, which
// takes longer than all else.
#[inline(never)]
fn record(tape: u32, a: u32, b: u32, by_a: f64, by_b: f64) -> u32 {
    TAPE.with_borrow_mut(|found| {
        let index = found.nodes.len();
        if found.number != tape || index >= NONE as usize {
            return NONE;
        }
        found.nodes.push(Node { arguments: [a, b], derivatives: [by_a, by_b] });
        index as u32
    })
}

impl Taped {
    /// A number that does not change.
    #[must_use]
    pub const fn constant(value: f64) -> Self {
        Self { value, node: NONE, tape: 0 }
    }

    /// The number without its derivatives.
    #[must_use]
    pub const fn value(self) -> f64 {
        self.value
    }

    /// A function of this number by its value and derivative.
    #[inline]
    fn chain(self, value: f64, derivative: f64) -> Self {
        if self.node == NONE || derivative == 0.0 {
            return Self::constant(value);
        }
        self.recorded(value, [self.node, NONE], [derivative, 0.0])
    }

    /// A function of two numbers by its value and derivatives.
    #[inline]
    fn chain_of_two(self, other: Self, value: f64, [a, b]: [f64; 2]) -> Self {
        match (self.node, other.node) {
            (_, NONE) => self.chain(value, a),
            (NONE, _) => other.chain(value, b),
            _ if self.tape != other.tape => Self::constant(f64::NAN),
            arguments => self.recorded(value, arguments.into(), [a, b]),
        }
    }

    /// NaN where the number is of another recording, or the tape is full.
    #[inline]
    fn recorded(self, value: f64, [a, b]: [u32; 2], [by_a, by_b]: [f64; 2]) -> Self {
        let node = record(self.tape, a, b, by_a, by_b);
        if node == NONE { Self::constant(f64::NAN) } else { Self { value, node, tape: self.tape } }
    }
}

macro_rules! arithmetic {
    ($($operator:ident $function:ident $assign:ident $in_place:ident: |$a:ident, $b:ident| $value:expr, $slopes:expr;)+) => {$(
        impl $operator for Taped {
            type Output = Self;

            #[inline]
            fn $function(self, other: Self) -> Self {
                let ($a, $b) = (self.value, other.value);
                self.chain_of_two(other, $value, $slopes)
            }
        }

        impl $assign for Taped {
            #[inline]
            fn $in_place(&mut self, other: Self) {
                *self = $operator::$function(*self, other);
            }
        }
    )+};
}

arithmetic! {
    Add add AddAssign add_assign: |a, b| a + b, [1.0, 1.0];
    Sub sub SubAssign sub_assign: |a, b| a - b, [1.0, -1.0];
    Mul mul MulAssign mul_assign: |a, b| a * b, [b, a];
    Div div DivAssign div_assign: |a, b| a / b, [1.0 / b, -(a / b) / b];
}

impl Neg for Taped {
    type Output = Self;

    #[inline]
    fn neg(self) -> Self {
        self.chain(-self.value, -1.0)
    }
}

macro_rules! functions {
    ($($name:ident: |$x:ident, $y:ident| $derivative:expr;)+) => {$(
        #[inline]
        fn $name(self) -> Self {
            let $x = self.value;
            let $y = Real::$name($x);
            self.chain($y, $derivative)
        }
    )+};
}

impl Real for Taped {
    const LANES: usize = 1;

    #[inline(always)]
    fn lane(self, _: usize) -> f64 {
        self.value
    }

    #[inline(always)]
    fn from_f64(value: f64) -> Self {
        Self::constant(value)
    }

    #[inline(always)]
    fn ratio(p: i64, q: i64) -> Self {
        Self::constant(f64::ratio(p, q))
    }

    functions! {
        sqrt: |_x, y| 0.5 / y;
        asin: |_x, y| 1.0 / Real::cos(y);
        acos: |_x, y| -1.0 / Real::sin(y);
        atan: |x, _y| 1.0 / (1.0 + x * x);
        sinh: |x, _y| Real::cosh(x);
        cosh: |x, _y| Real::sinh(x);
        tanh: |_x, y| 1.0 - y * y;
        exp: |_x, y| y;
        ln: |x, _y| 1.0 / x;
        recip: |_x, y| -y * y;
    }

    #[inline]
    fn sin_cos(self) -> (Self, Self) {
        let (sine, cosine) = Real::sin_cos(self.value);
        (self.chain(sine, cosine), self.chain(cosine, -sine))
    }

    #[inline]
    fn atan2(self, x: Self) -> Self {
        let square = self.value * self.value + x.value * x.value;
        self.chain_of_two(x, Real::atan2(self.value, x.value), [x.value / square, -self.value / square])
    }

    #[inline]
    fn is_finite(self) -> bool {
        self.value.is_finite()
    }

    #[inline(always)]
    fn select_lt(a: Self, b: Self, x: Self, y: Self) -> Self {
        if a.value < b.value { x } else { y }
    }
}

packs_of_one! {
    [] Taped;
}

/// The tape of this thread while something is recorded on it.
pub(crate) struct Recording {
    number: u32,
    /// It stays on its thread.
    thread: PhantomData<*const ()>,
}

impl Recording {
    /// An empty tape; `None` where this thread records already.
    pub(crate) fn start() -> Option<Self> {
        TAPE.with_borrow_mut(|tape| {
            if tape.number != 0 {
                return None;
            }
            // 0 once in 2³² recordings: the one after it.
            let number =
                [(); 2].into_iter().map(|()| NEXT.fetch_add(1, Ordering::Relaxed)).find(|&number| number != 0)?;
            (tape.number, tape.most) = (number, 0);
            tape.nodes.clear();
            Some(Self { number, thread: PhantomData })
        })
    }

    /// A number by which derivatives are sought; NaN where the tape is full.
    pub(crate) fn variable(&self, value: f64) -> Taped {
        let leaf = Taped { value, node: NONE, tape: self.number };
        leaf.recorded(value, [NONE; 2], [0.0; 2])
    }

    /// Number of the nodes.
    pub(crate) fn len(&self) -> usize {
        TAPE.with_borrow(|tape| tape.nodes.len())
    }

    /// Forgets all nodes after the first `len`.
    pub(crate) fn truncate(&self, len: usize) {
        TAPE.with_borrow_mut(|tape| {
            tape.most = tape.most.max(tape.nodes.len());
            tape.nodes.truncate(len);
        });
    }

    /// The bytes of a tape with its adjoints when it was longest.
    pub(crate) fn most_bytes(&self) -> usize {
        let nodes = TAPE.with_borrow(|tape| tape.most.max(tape.nodes.len()));
        nodes * (size_of::<Node>() + size_of::<f64>())
    }
}

impl Drop for Recording {
    fn drop(&mut self) {
        TAPE.with_borrow_mut(|tape| {
            tape.number = 0;
            tape.nodes = Vec::new();
        });
    }
}

/// The derivatives of what is sought by each node, as far as the sweep has come.
#[derive(Clone, Default)]
pub(crate) struct Adjoints(Vec<f64>);

impl Adjoints {
    /// Adds to the derivative by a number; nothing of a constant.
    pub(crate) fn add(&mut self, number: Taped, derivative: f64) {
        if number.node != NONE {
            let index = number.node as usize;
            if self.0.len() <= index {
                self.0.resize(index + 1, 0.0);
            }
            self.0[index] += derivative;
        }
    }

    /// The derivative by a number; 0 of a constant.
    pub(crate) fn of(&self, number: Taped) -> f64 {
        self.0.get(number.node as usize).copied().unwrap_or(0.0)
    }

    /// Hands the derivatives of some nodes, from the last one down, to what these were made of.
    pub(crate) fn sweep(&mut self, recording: &Recording, which: Range<usize>) {
        TAPE.with_borrow(|tape| {
            debug_assert_eq!(tape.number, recording.number);
            self.0.resize(tape.nodes.len(), 0.0);
            for i in which.rev() {
                let (node, adjoint) = (tape.nodes[i], self.0[i]);
                if adjoint == 0.0 {
                    continue;
                }
                for (argument, derivative) in node.arguments.into_iter().zip(node.derivatives) {
                    // What has no part in it gets nothing of an infinite slope either.
                    if argument != NONE && derivative != 0.0 {
                        self.0[argument as usize] += derivative * adjoint;
                    }
                }
            }
        });
    }

    /// Forgets those of all nodes after the first `len`.
    pub(crate) fn truncate(&mut self, len: usize) {
        self.0.truncate(len);
    }
}

/// A function of many numbers with its derivatives by all of them, from one evaluation and one sweep back.
///
/// `None` where it, or a derivative, is not finite, and within another recording of this thread.
///
/// ```
/// use gauss_runtime::real::Real;
/// use gauss_sensitivity::tape::{Taped, gradient};
///
/// let product = |x: &[Taped; 3]| x[0] * x[1].sin() * x[2];
/// let (value, slopes) = gradient(&[2.0, 0.0, 5.0], product).expect("finite");
/// assert_eq!((value, slopes), (0.0, [0.0, 10.0, 0.0]));
/// ```
pub fn gradient<const P: usize>(
    numbers: &[f64; P],
    function: impl FnOnce(&[Taped; P]) -> Taped,
) -> Option<(f64, [f64; P])> {
    let recording = Recording::start()?;
    let variables = numbers.map(|number| recording.variable(number));
    let value = function(&variables);
    let mut adjoints = Adjoints::default();
    adjoints.add(value, 1.0);
    adjoints.sweep(&recording, 0..recording.len());
    let slopes = variables.map(|variable| adjoints.of(variable));
    let finite = value.value.is_finite() && slopes.iter().all(|slope| slope.is_finite());
    finite.then_some((value.value, slopes))
}

#[cfg(test)]
#[path = "tape_tests.rs"]
mod tests;
