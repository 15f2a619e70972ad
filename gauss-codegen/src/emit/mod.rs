//! Programs as Rust, equations as documentation.
//!
//! | room, file | what it holds |
//! |---|---|
//! | `dialect` | the dialect of Rust that kernels are written in; `arguments`: the arguments of every function of a kernel, where the symbols of a program come from: parts of `q`, `z`, `p`, the fields of the kernel; `packs`: vectors |
//! | `subject`, `chart` | what is derived: its configuration, its constraints; charts by name |
//! | `derived` | everything known about one derive, and what the implementations are made with |
//! | `records` | states and inputs by name |
//! | `equations` | `GaussSystem`, constraints, contacts, power series |
//! | `derivatives` | a file for each kind of derivative; `columns`: solved together |
//! | `quantities` | powers and forces, frames, reactions of joints, driving forces, the pose of a body, sums over the system |
//! | `text` | equations and costs as text, LaTeX and rustdoc; the file that a robot was read from, and warnings of what in it has no effect |
//! | `constructor` | the kernel struct and `kernel()`: parameters read, checked, and turned into constants; `warnings()`; numbers of a robot's file |
//! | `python` | what another language is to know of the struct: the call of one macro |
//! | `fallback` | where there are mistakes |
//!
//! Rooms know those above them. One file for each item that is generated, a function from [`Derived`] to tokens.

use proc_macro2::TokenStream;
use quote::quote;

mod chart;
mod constructor;
mod derivatives;
mod derived;
mod dialect;
mod equations;
mod fallback;
mod python;
mod quantities;
mod records;
#[cfg(test)]
mod specialisation_tests;
mod subject;
#[cfg(test)]
mod system_tests;
#[cfg(test)]
mod tests;
mod text;

pub use constructor::laws::in_states;
pub use derivatives::hessian::blocks;
pub use derived::Derived;
pub use dialect::arguments::{OF_EQUATIONS, OF_HESSIAN, OF_REGRESSOR, OF_RESIDUAL, arguments_of};
pub use fallback::fallback;
pub use python::{numbers, parts, without_rust};
pub use text::documentation::{Equations, figures};
pub use text::file::file;

use constructor::{file_values, kernel};
use derivatives::{hessian, inverse, linearized, parametric, regressor};
use equations::{constrained, contact, gauss_system, taylor};
use quantities::{driven, forced, framed, reactions, rigid_body, whole};
use records::{index, input, state};
use text::description;

/// The whole output of the derive.
pub fn emit(derived: &Derived<'_, '_>, equations: &Equations) -> TokenStream {
    let kernel = kernel::kernel_struct(derived, equations);
    let constructor = kernel::constructor(derived);
    let tables = kernel::tables(derived);
    let gauss_system = gauss_system::gauss_system(derived);
    let described = description::described(derived, equations);
    let rigid_body = rigid_body::rigid_body_system(derived);
    let constrained = constrained::constrained_system(derived);
    let contacts = contact::contact_system(derived);
    let forced = forced::forced_system(derived);
    let taylor = taylor::taylor_system(derived);
    let linearized = linearized::linearized_system(derived);
    let hessian = hessian::hessian_system(derived);
    let inverse = inverse::inverse_linearized_system(derived);
    let parametric = parametric::parametric_system(derived);
    let regressor = regressor::inertial_regressor(derived);
    let whole = whole::of_the_whole(derived);
    let [frames, framed] = framed::framed_system(derived);
    let [joints, reactions] = reactions::reactions(derived);
    let [motions, driven] = driven::driven_system(derived);
    let [state, conversions] = state::state(derived);
    let index = index::index(derived);
    let [input, inputs] = input::input(derived);
    let of_file = file_values::of_file(derived);
    let python = python::scene(derived);
    quote! {
        #kernel
        #state
        #index
        #input
        #frames
        #joints
        #motions

        const _: () = {
            #tables
            #constructor
            #conversions
            #inputs
            #of_file
            #gauss_system
            #described
            #rigid_body
            #constrained
            #contacts
            #forced
            #taylor
            #linearized
            #hessian
            #inverse
            #parametric
            #regressor
            #framed
            #reactions
            #driven
            #whole
        };
        #python
    }
}
