//! Lanes of processors whose vectors code of this crate does not know: none.

use cranelift_jit::JITModule;
use gauss_codegen::program::Program;

use super::backend::CompiledLanes;
use crate::tables::Tables;

/// None.
pub fn compiled(
    _program: &Program,
    _tables: &Tables,
    _width: usize,
    _module: impl FnOnce() -> Option<JITModule>,
) -> Option<Box<dyn CompiledLanes>> {
    None
}
