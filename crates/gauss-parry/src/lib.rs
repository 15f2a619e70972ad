//! Shapes of [`parry3d_f64`] as contacts of scenes of Gauss: convex hulls, meshes, height fields, boxes, anything that
//! it knows.
//!
//! Bodies have shapes ([`Shapes`]); before each step the library says where these touch or nearly do, each point of its
//! manifolds becomes a [`Slot`](gauss_contact::Slot), and the step is made as always: the laws hold at its end, gaps
//! are projected to zero, and impulses of the step before go to the same features ([`ParrySteps`]).
//!
//! A slot is a point of one body, or a ball, over a plane of the other. On faces of polyhedra that is exact. Of other
//! curved surfaces, and of edges that cross, it is the tangent plane where they were at the start of the step: a gap is
//! then off by the square of what the point moves along it in a step, times the curvature, and the next step takes that
//! back.
//!
//! Triangles of a mesh know their neighbours: a flat mesh is a plane.
//!
//! Which points a pair has is the library's answer. None is dropped unless [`Shapes::reduce`] asks for it; more of them
//! than there are slots is an error.

#![forbid(unsafe_code)]
#![deny(missing_docs)]

mod convert;
mod error;
mod facets;
mod id;
mod reduce;
mod shapes;
mod steps;

pub use error::{ParryError, ParryErrorKind};
pub use id::ShapeId;
pub use parry3d_f64;
pub use reduce::Reduction;
pub use shapes::{Feature, Found, Shapes, Surface};
pub use steps::ParrySteps;

/// The page of the crate, whose program is a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
pub struct Readme;
