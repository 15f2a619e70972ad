//! What the test `mutations` of the library has, too.

#[path = "../../gauss-codegen/tests/mutations/fault.rs"]
pub mod fault;
#[path = "../../gauss-codegen/tests/mutations/mutate.rs"]
pub mod mutate;
#[path = "../../gauss-codegen/src/accuracy/random.rs"]
pub mod random;
