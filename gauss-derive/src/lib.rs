//! `#[derive(GaussDynamics)]`: equations of motion of a rigid body derived at compile time, as flat Rust kernels.
//!
//! Depend on `gauss-runtime`, which re-exports the macro; the attribute language is documented there.

mod algebra;
mod emit;
mod expand;
mod kernel;
mod mechanics;
mod model;
mod translate;

/// Derives the equations of motion of a rigid body from the Gauss condition, in the chart that `#[gauss(chart = …)]`
/// names, and generates `Name::kernel()` and the `NameKernel` that implements `GaussSystem` and `RigidBodySystem`.
#[proc_macro_derive(GaussDynamics, attributes(gauss))]
pub fn derive_gauss_dynamics(input: proc_macro::TokenStream) -> proc_macro::TokenStream {
    let input = syn::parse_macro_input!(input as syn::DeriveInput);
    expand::expand(&input).unwrap_or_else(|error| error.into_compile_error()).into()
}
