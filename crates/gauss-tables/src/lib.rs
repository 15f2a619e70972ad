//! Tables of runs: named columns with units, as CSV, as files that other programs read, and as plots.
//!
//! ```
//! use gauss_runtime::prelude::*;
//! use gauss_tables::Tabulate;
//!
//! #[derive(GaussDynamics)]
//! #[gauss(
//!     coordinates(angle),
//!     particle(mass = 1, position = [sin(angle), 0, -cos(angle)]),
//!     friction(bearing, along = angle, viscous = 0.1),
//! )]
//! struct Pendulum {
//!     #[gauss(gravity)]
//!     g: f64,
//! }
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let kernel = Pendulum { g: 9.81 }.kernel()?;
//! let run = Simulation::new(&kernel).adaptive(1e-9, 1e-9).run(SVector::from([1.0]), SVector::from([0.0]), 0.0..10.0)?;
//! let table = run.table_at((0..=500).map(|n| 0.02 * f64::from(n)))?.state().energies(&kernel);
//! let table = table.si().units([("angle", "rad"), ("angle_dot", "rad/s")])?;
//!
//! let folder = std::env::temp_dir().join("gauss_tables");
//! table.write_csv(folder.join("pendulum.csv"))?;
//! # #[cfg(feature = "plot")]
//! table.plot(folder.join("pendulum.svg"))?;
//! # #[cfg(feature = "parquet")]
//! table.write_parquet(folder.join("pendulum.parquet"))?;
//! # std::fs::remove_dir_all(folder)?;
//! # Ok(())
//! # }
//! ```
//!
//! | method | feature | file | units |
//! |---|---|---|---|
//! | [`write_csv`](Table::write_csv) | | CSV, RFC 4180, UTF-8, all digits | in the heading, `angle / rad` |
//! | `plot`, `svg` | `plot` (default) | SVG, a panel for each unit | at the axes |
//! | `write_arrow`, `record_batch` | `arrow` | Arrow IPC, also called Feather | metadata `unit` of the field |
//! | `write_parquet` | `parquet` | Parquet, not compressed | metadata of the file, `unit:angle` |
//!
//! [`euler_angles`](Table::euler_angles) has rotations as angles, [`select`](Table::select) chooses columns,
//! [`panel`](Table::panel) which of them a plot has together, and [`points`](Table::points) which are points without
//! lines. What is no run becomes a table by [`Table::of`] or [`Table::from_columns`].
//!
//! Columns of Arrow and Parquet are 64-bit floats without nulls under the bare names; what is not finite is a NaN or an
//! infinity.

#![deny(missing_docs)]

#[cfg(feature = "arrow")]
mod columns;
mod error;
mod export;
#[cfg(feature = "parquet")]
mod parquet;
#[cfg(feature = "plot")]
mod picture;
mod run;
mod table;

/// [`Tabulate`] is for runs alone, so that functions can be added to it.
pub use error::TableError;
pub use gauss_runtime::chart::EulerSequence;
pub use run::{RunTable, Tabulate};
pub use table::{Column, ColumnError, Table};
