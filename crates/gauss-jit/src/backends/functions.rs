//! The functions that programs call, of the runtime: machine code and the interpreter call the same ones.

use gauss_codegen::program::{BinaryFunction, Function};
use gauss_runtime::prelude::Real;

/// Whether a·b + c is rounded once: where the processor has an instruction for it.
pub fn is_fused() -> bool {
    #[cfg(target_arch = "x86_64")]
    return std::arch::is_x86_feature_detected!("fma");
    #[cfg(not(target_arch = "x86_64"))]
    return cfg!(target_arch = "aarch64");
}

/// Functions of one argument that code calls, by their numbers.
#[cfg(feature = "cranelift")]
pub const UNARY: [Function; 6] =
    [Function::Sin, Function::Cos, Function::Exp, Function::Ln, Function::Signum, Function::Tanh];
/// The same of two.
#[cfg(feature = "cranelift")]
pub const BINARY: [BinaryFunction; 4] =
    [BinaryFunction::Atan2, BinaryFunction::Min, BinaryFunction::Max, BinaryFunction::Powf];

/// Functions of one argument.
pub fn unary(function: Function) -> extern "C" fn(f64) -> f64 {
    extern "C" fn sin(x: f64) -> f64 {
        Real::sin(x)
    }
    extern "C" fn cos(x: f64) -> f64 {
        Real::cos(x)
    }
    extern "C" fn exp(x: f64) -> f64 {
        Real::exp(x)
    }
    extern "C" fn ln(x: f64) -> f64 {
        Real::ln(x)
    }
    extern "C" fn sqrt(x: f64) -> f64 {
        Real::sqrt(x)
    }
    extern "C" fn abs(x: f64) -> f64 {
        Real::abs(x)
    }
    extern "C" fn signum(x: f64) -> f64 {
        Real::signum(x)
    }
    extern "C" fn tanh(x: f64) -> f64 {
        Real::tanh(x)
    }
    match function {
        Function::Sin => sin,
        Function::Cos => cos,
        Function::Exp => exp,
        Function::Ln => ln,
        Function::Sqrt => sqrt,
        Function::Abs => abs,
        Function::Signum => signum,
        Function::Tanh => tanh,
    }
}

/// Functions of two arguments.
pub fn binary(function: BinaryFunction) -> extern "C" fn(f64, f64) -> f64 {
    extern "C" fn atan2(x: f64, y: f64) -> f64 {
        Real::atan2(x, y)
    }
    extern "C" fn min(x: f64, y: f64) -> f64 {
        Real::min(x, y)
    }
    extern "C" fn max(x: f64, y: f64) -> f64 {
        Real::max(x, y)
    }
    extern "C" fn powf(x: f64, y: f64) -> f64 {
        Real::powf(x, y)
    }
    match function {
        BinaryFunction::Atan2 => atan2,
        BinaryFunction::Min => min,
        BinaryFunction::Max => max,
        BinaryFunction::Powf => powf,
    }
}

/// Sines and cosines of several angles, which the runtime computes together: the same bits as alone.
#[cfg(feature = "cranelift")]
pub fn sines_and_cosines(angles: &[f64], results: &mut [[f64; 2]]) {
    let (together, rest) = angles.as_chunks::<4>();
    for (angles, results) in together.iter().zip(results.chunks_mut(4)) {
        let (sines, cosines) = Real::sines_and_cosines(*angles);
        results
            .iter_mut()
            .zip(sines.into_iter().zip(cosines))
            .for_each(|(pair, (sine, cosine))| *pair = [sine, cosine]);
    }
    for (angle, pair) in rest.iter().zip(&mut results[4 * together.len()..]) {
        *pair = Real::sin_cos(*angle).into();
    }
}
