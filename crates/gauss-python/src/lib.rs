//! Packages of Python from structs of Gauss.
//!
//! A struct gets the clause `#[gauss(python)]`, and [`module!`] makes a module of such structs:
//!
//! ```
//! use gauss_runtime::prelude::*;
//!
//! /// A pendulum.
//! #[derive(GaussDynamics)]
//! #[gauss(
//!     python,
//!     coordinates(angle),
//!     particle(mass = mass, position = [length * sin(angle), 0, -length * cos(angle)]),
//! )]
//! struct Pendulum<T> {
//!     mass: T,
//!     length: T,
//!     #[gauss(gravity)]
//!     g: T,
//! }
//!
//! gauss_python::module!(swings: Pendulum<f64>);
//! ```
//!
//! ```python
//! import numpy, swings
//! pendulum = swings.Pendulum(mass=0.3, length=0.5, g=9.81)
//! accelerations = pendulum.acceleration(numpy.zeros((1000, 1)), numpy.ones((1000, 1)))
//! ```
//!
//! `cargo gauss create --python NAME` writes such a package, which `pip install .` builds. The guide, "From Python",
//! has what classes offer.
//!
//! Rooms, each knows those before it: `description`, `parameter` (what is known of a struct, its fields), `threads`,
//! `memory` (the only access to arrays by address), `methods` (methods of a kernel over rows), `steps` (one run:
//! numbers in, columns out), `scene` (a struct as Python sees it), `runs` (many), `kernels` (its kernels, their types
//! forgotten), and what Python sees: `errors`, `arrays`, `tuples`, `columns`, `own`, `call`, `parameters`, `class` with
//! `of_kernels`, `states`, `stepping` (a run step by step) and `simulation`, which knows `calls` (functions of Python
//! in a run) and `given` (what a run is given), `run`, `page` (a run in a browser), `ends`, `stubs`, `jax` (the door
//! to XLA), `make`. With the feature `loaded` models that come at run time are such scenes as well.

#![deny(missing_docs, unsafe_code)]

// `memory` (the only access by address), `methods` (`words`: the list; `table`: each as a loop over rows), `steps` (one
// run, of `contacts` too), `scene` (a struct), `runs` (many), `kernels` (in one lane and in eight); what Python sees:
// `arrays`, `own` (parameters of rows), `call`, `parameters`, `class`, `states` (structured arrays), `calls` and
// `given` (functions of Python, what a run is given), `simulation`, `stepping`, `run` with `plot.py` and `page`,
// `ends`, `columns`, `tuples`, `threads`, `errors`, `stubs`, `jax` (`abi`: the calls of XLA; `door.py`: functions of
// JAX), `make`.
// `loaded`: a model at run time behind the same two traits, `AnyScene` and `AnyKernel`: `scene`, `rows` (methods),
// `runs` (in the smallest room that it fits into). `examples/python`: a package, its tests and a notebook.
mod arrays;
mod call;
mod calls;
mod class;
mod columns;
mod description;
mod documentation;
mod ends;
mod errors;
mod given;
mod jax;
mod kernels;
mod lanes;
#[cfg(feature = "loaded")]
pub mod loaded;
mod make;
mod memory;
mod methods;
mod of_kernels;
mod own;
mod page;
mod parameter;
mod parameters;
mod run;
mod runs;
mod scene;
mod simulation;
mod states;
mod stepping;
mod steps;
mod stubs;
mod threads;
mod tuples;

pub use description::{Description, Field, Part, Remark, Shape};
pub use gauss_runtime::error::{ParameterError, ParameterWarnings};
pub use gauss_runtime::real::Real;
#[doc(hidden)]
pub use lanes::Pack;
pub use make::{add, begin, finish};
#[doc(hidden)]
pub use methods::Table;
pub use parameter::{FromNumbers, Numbers, Parameter};
#[doc(hidden)]
pub use pyo3;
pub use scene::{ConfigurationOf, ScalarOf, Scene, SpeedsOf};
#[doc(hidden)]
pub use steps::Methods;
/// Methods that need a clause, and what is in their place without it.
#[doc(hidden)]
pub mod places {
    pub use gauss_runtime::integrate::{Absent, JacobianMethod, NoTaylor, Taylor};
}

/// A module of Python with a class for each struct; its name is that of the library in `Cargo.toml`. Structs that are
/// generic in their scalar are written with `f64`: their batches are computed in lanes all the same.
///
/// `gauss_python::module!(robots: Arm<f64>, Leg<f64>);`
#[macro_export]
macro_rules! module {
    ($name:ident: $($scene:ty),+ $(,)?) => {
        /// Rigid-body dynamics, generated.
        #[$crate::pyo3::pymodule]
        #[pyo3(crate = "::gauss_python::pyo3")]
        fn $name(
            module: &$crate::pyo3::Bound<'_, $crate::pyo3::types::PyModule>,
        ) -> $crate::pyo3::PyResult<()> {
            $crate::begin(module)?;
            $crate::finish(module, ::std::vec![$($crate::add::<$scene>(module)?),+])
        }
    };
}
