//! The scenes.

use gauss_runtime::prelude::DescribedSystem;

use crate::live::{Live, Motion};
use crate::scene::{Scene, Show, Slider};

pub mod five_bar;
pub mod pendulum;
pub mod plate;
pub mod racket;
pub mod rattleback;
pub mod top;
pub mod torpedo;

/// A scene among all, whatever its kernel.
pub struct Entry {
    /// The motion with all sliders where they are at first.
    pub open: fn() -> Result<Box<dyn Motion>, String>,
    /// What may be changed.
    pub sliders: &'static [Slider],
    /// What is written and drawn.
    pub show: fn() -> Show,
    /// The file that it is written in.
    pub source: &'static str,
    /// The equations that were derived.
    pub equations: &'static str,
    /// Operations of one evaluation of ż.
    pub operations: u32,
}

const fn entry<S: Scene>() -> Entry {
    Entry {
        open: || Live::<S>::new().map(|live| Box::new(live) as Box<dyn Motion>),
        sliders: S::SLIDERS,
        show: S::show,
        source: S::SOURCE,
        equations: S::Kernel::EQUATIONS.text,
        operations: S::Kernel::OPERATIONS.acceleration.total(),
    }
}

/// All scenes, in the order of their buttons.
pub const ALL: [Entry; 7] = [
    entry::<top::Scenery>(),
    entry::<racket::Scenery>(),
    entry::<torpedo::Scenery>(),
    entry::<plate::Scenery>(),
    entry::<rattleback::Scenery>(),
    entry::<pendulum::Scenery>(),
    entry::<five_bar::Scenery>(),
];
