//! Programs: straight lines of instructions with everything that is needed to run them, print them, or write them in
//! some language.
//!
//! # What a program is
//! A [`Program`] stands alone: it refers to no scene and no expression. It has
//! - [`arguments`](Program::arguments), each a list of numbers with names: time, the components of the configuration,
//!   speeds, momenta, inputs, and the constants of a kernel, which a program of its own computes from the parameters;
//! - [`code`](Program::code): [`Instruction`]s in the order in which they are carried out, each of which is assigned
//!   once. What it works on is an [`Operand`]: an input, an exact fraction, or the result of an earlier instruction, by
//!   its index. There are no loops, branches or memory. Sine and cosine of one angle are one instruction with two
//!   results;
//! - [`results`](Program::results): what the outputs of the code are together, numbers, vectors or matrices by rows.
//!
//! ```
//! let top = "#[gauss(motion = fixed_point)] struct Top { #[gauss(mass)] m: f64, #[gauss(inertia)] i: Vector3<f64> }";
//! let derivation = gauss_codegen::Derivation::of_source(top, "Top")?;
//! let acceleration = derivation.program("acceleration").expect("every kernel has it");
//! println!("{acceleration}");
//! let constants = derivation.constants().run::<f64>(&[&[1.0, 0.5, 0.4, 0.3]])?;
//! let (t, q, z) = ([0.0], [0.0, 0.0, 0.0, 1.0], [1.0, 2.0, 3.0]);
//! let rate = acceleration.run(&[&constants, &t, &q, &z, &[]])?;
//! assert!((rate[0] - (0.4 - 0.3) / 0.5 * 2.0 * 3.0).abs() < 1e-15);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # How to write a pass
//! A pass is a function from [`Code`] to `Code`: it maps instructions with [`Instruction::map`], renumbers what it
//! moved with [`Operand::moved`], and leaves what became idle to [`Code::without_idle`]. Code is generic over what its
//! inputs are called, so that one pass serves while symbols are still symbols and afterwards;
//! `Code::with_signs_led_back` is one of 60 lines. [`Program::with_code`] verifies the shape of the code that a pass
//! made; run both programs ([`Program::run`]) to see whether they compute the same. Inside this crate every pass ends
//! in `Code::verified`, which checks the shape in debug builds, and every kernel is compared with its expressions where
//! it is made.
//!
//! # How to write a target
//! A target is a function from [`Functions`] to text. It declares arguments, writes each of the eleven instructions and
//! five operands, and hands results back; [`targets::c`](crate::targets::c) is the shortest example.

mod angles;
mod beginnings;
mod code;
mod cost;
pub(crate) mod derivatives;
mod function;
mod functions;
mod fused;
mod input;
mod instruction;
mod interpret;
mod order;
pub(crate) mod packs;
mod print;
mod series;
mod signs;
mod verify;

pub use crate::algebra::{BinaryFunction, Function, MOST_VARIABLES, OwnFunction, Rational, Scalar};
pub use code::Code;
pub use cost::{Cost, Counts, Smoothness};
pub use derivatives::SparseJacobian;
pub use function::{Program, WrongArguments};
pub use functions::{Functions, UnknownMethods};
pub use input::{Argument, ArgumentKind, Input, Results};
pub use instruction::{Instruction, Operand};
pub(crate) use packs::{InputPlace, LANES, Leaf, Operation, Pack, PackedCode, PackedStep, in_place};
pub use verify::Malformed;
