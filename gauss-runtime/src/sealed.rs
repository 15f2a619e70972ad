//! Traits that this crate alone implements, so that functions can be added to them.

/// The bound that makes a trait one of these: its path is private.
///
/// ```compile_fail,E0277
/// use gauss_runtime::integrate::problem::input::EmptyInput;
///
/// struct Mine;
///
/// impl EmptyInput for Mine {
///     const NONE: Self = Self;
/// }
/// ```
pub trait Sealed {}
