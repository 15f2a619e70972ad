//! Programs as Rust, equations as documentation.
//!
//! | file | what it holds |
//! |---|---|
//! | `program` | the dialect of Rust that kernels are written in |
//! | `arguments` | the arguments of every function of a kernel; where the symbols of a program come from: parts of `q`, `z`, `p`, the fields of the kernel |
//! | `parameters`, `locals`, `assigned`, `inertia`, `laws` | the parameters read, checked, and turned into constants; `warnings()` |
//! | `subject`, `chart`, `pose` | what is derived: its configuration, its constraints; charts by name; configurations as poses |
//! | `documentation` | equations and costs as text, LaTeX and rustdoc |
//! | `file` | the file that a robot was read from, and warnings of what it says in vain |
//! | `derived` | everything known about one derive, and what the implementations are made with |
//!
//! One file for each item that is generated, a function from [`Derived`] to tokens: `kernel` (the struct and
//! `kernel()`), `state` and `input` (by name, both `record`s), `of_file` (numbers of a robot's file), `gauss_system`,
//! `description`, `rigid_body`, `constrained`, `contact`, `forced`, `framed`, `whole`, `taylor`, `linearized`,
//! `hessian`, `inverse`, `parametric`, `regressor`; `fallback` where there are mistakes.

use proc_macro2::TokenStream;
use quote::quote;

mod arguments;
mod chart;
mod columns;
mod constrained;
mod contact;
mod derived;
mod description;
mod documentation;
mod fallback;
mod file;
mod forced;
mod framed;
mod gauss_system;
mod hessian;
mod input;
mod inverse;
mod kernel;
mod laws;
mod linearized;
mod locals;
mod mass_laws;
mod of_file;
mod packs;
mod parameters;
mod parametric;
mod pose;
mod program;
mod record;
mod regressor;
mod rigid_body;
#[cfg(test)]
mod specialisation_tests;
mod state;
mod subject;
#[cfg(test)]
mod system_tests;
mod taylor;
#[cfg(test)]
mod tests;
mod whole;

pub use arguments::{OF_EQUATIONS, OF_HESSIAN, OF_REGRESSOR, OF_RESIDUAL, arguments_of};
pub use derived::Derived;
pub use documentation::{Equations, figures};
pub use fallback::fallback;
pub use file::file;
pub use hessian::blocks;

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
    let [state, conversions] = state::state(derived);
    let [input, inputs] = input::input(derived);
    let of_file = of_file::of_file(derived);
    quote! {
        #kernel
        #state
        #input
        #frames

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
            #whole
        };
    }
}
