//! Numbers in which expressions are evaluated: doubles, dual numbers, 106 and 256 binary digits, also with errors.

pub mod doubled;
pub mod dual;
pub mod elementary;
pub mod evaluate;
pub mod limbs;
pub mod precise;
pub mod rounded;
