//! Scenes of the page: their sliders, camera and motion.

use gauss_playback::Shape;
use gauss_runtime::prelude::*;
use serde::Serialize;

/// A number that whoever looks at the page may change.
#[derive(Clone, Debug, Serialize)]
pub struct Slider {
    /// What it is called.
    pub name: &'static str,
    /// Its unit; empty: a pure number.
    pub unit: &'static str,
    /// Its ends.
    pub range: [f64; 2],
    /// Where it is at first.
    pub value: f64,
    /// Whether it is a parameter, which may change while the scene runs; otherwise it is part of the initial state.
    pub parameter: bool,
}

impl Slider {
    /// A physical parameter.
    #[must_use]
    pub const fn parameter(name: &'static str, unit: &'static str, range: [f64; 2], value: f64) -> Self {
        Self { name, unit, range, value, parameter: true }
    }

    /// What the motion starts with.
    #[must_use]
    pub const fn start(name: &'static str, unit: &'static str, range: [f64; 2], value: f64) -> Self {
        Self { name, unit, range, value, parameter: false }
    }
}

/// A body as it is drawn.
#[derive(Clone, Debug, Serialize)]
pub struct Body {
    /// What the legend calls it.
    pub name: &'static str,
    /// Its solids, in its axes.
    pub shapes: Vec<Shape>,
}

/// The path of a point that moves with a body.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Trace {
    /// Which body.
    pub body: usize,
    /// In its axes.
    pub point: [f64; 3],
}

/// Squares that show what moves and what rests.
#[derive(Clone, Copy, Debug, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Backdrop {
    /// A floor at this height along what is up.
    Floor(f64),
    /// A wall, for motion in a plane: so far in front of Ω, to the reader.
    Wall(f64),
}

/// Where the eye is at first.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct View {
    /// What is up on the screen, observer's axes.
    pub up: [f64; 3],
    /// What the eye looks at, observer's axes; a scene whose camera goes with a body: from its origin.
    pub target: [f64; 3],
    /// The radius of the visible region.
    pub radius: f64,
    /// The squares behind the motion.
    pub backdrop: Backdrop,
    /// About what is up, from k₁, and above the floor, rad.
    pub angles: [f64; 2],
    /// The body that the camera goes with.
    pub follow: Option<usize>,
}

/// All that is written and drawn of a scene.
#[derive(Clone, Debug, Serialize)]
pub struct Show {
    /// A few words: the button of the scene.
    pub title: &'static str,
    /// What there is to see, in a sentence or two.
    pub words: &'static str,
    /// Where the eye is.
    pub view: View,
    /// In the order of [`Scene::poses`].
    pub bodies: Vec<Body>,
    /// Paths of points.
    pub traces: Vec<Trace>,
    /// Names of [`Scene::arrows`].
    pub arrows: Vec<&'static str>,
    /// Title of the panel of curves, with the unit, and the names of [`Scene::curves`].
    pub curves: (&'static str, Vec<&'static str>),
}

/// Where a motion starts: q and z.
pub type Start<K> = (<K as GaussSystem>::Configuration, <K as GaussSystem>::Speeds);

/// A kernel with sliders for its parameters and its start, and what is seen of it. Values of sliders have the order of
/// [`SLIDERS`](Self::SLIDERS).
pub trait Scene: 'static {
    /// What moves.
    type Kernel: GaussSystem<Scalar = f64, Input = ()> + DescribedSystem;

    /// What may be changed.
    const SLIDERS: &'static [Slider];

    /// The file that the scene is written in.
    const SOURCE: &'static str;

    /// What is written and drawn.
    fn show() -> Show;

    /// The kernel with these parameters.
    ///
    /// # Errors
    /// Parameters that no body has.
    fn kernel(values: &[f64]) -> Result<Self::Kernel, ParameterError>;

    /// Where the motion starts.
    fn start(values: &[f64]) -> Start<Self::Kernel>;

    /// Where the bodies are, by the observer.
    fn poses(values: &[f64], kernel: &Self::Kernel, s: &Sample<Self::Kernel>) -> Vec<Isometry3<f64>>;

    /// Vectors at points, by the observer, both in units of length on the screen.
    fn arrows(_kernel: &Self::Kernel, _s: &Sample<Self::Kernel>) -> Vec<[Vector3<f64>; 2]> {
        Vec::new()
    }

    /// What is drawn over time.
    fn curves(_kernel: &Self::Kernel, _s: &Sample<Self::Kernel>) -> Vec<f64> {
        Vec::new()
    }

    /// What is done on the scene by elements that have no potential, in watts; nothing where all have one.
    fn supplied(_kernel: &Self::Kernel, _s: &Sample<Self::Kernel>) -> Option<f64> {
        None
    }
}
