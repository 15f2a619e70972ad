#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]
#![deny(missing_docs)]

mod command;
mod declaration;
mod distribution;
mod draw;
mod error;
mod files;
mod normal;
mod panics;
mod plan;
mod row;
pub mod sensitivity;
mod streams;
mod study;

pub use command::{main, main_from};
pub use declaration::{Declaration, Sampler};
pub use distribution::{Distribution, fixed, grid, list, log_normal, normal, triangular, truncated_normal, uniform};
pub use draw::{Draw, Parameter};
pub use error::{DeclarationError, StudyError};
pub use files::Results;
pub use plan::Plan;
pub use row::{Column, ColumnType, Kind, Row, Value};
pub use streams::Stream;
pub use study::{Progress, Shard, Study};
