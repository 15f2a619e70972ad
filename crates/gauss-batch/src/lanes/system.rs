//! Requirements of a system of which there are many states.

use gauss_runtime::real::Real;
use gauss_runtime::simd::Packed;
use gauss_runtime::system::GaussSystem;

/// A system whose states can be kept in blocks: every one whose scalar is a float, a pack of them or a dual number.
pub trait BatchSystem: GaussSystem<Scalar: Packed<Single: Real>, Configuration: Packed, Speeds: Packed> {}

impl<S> BatchSystem for S where S: GaussSystem<Scalar: Packed<Single: Real>, Configuration: Packed, Speeds: Packed> {}

/// The configuration of one state of a batch.
pub type SingleConfiguration<S> = <<S as GaussSystem>::Configuration as Packed>::Single;

/// The quasi-velocities of one state of a batch.
pub type SingleSpeeds<S> = <<S as GaussSystem>::Speeds as Packed>::Single;
