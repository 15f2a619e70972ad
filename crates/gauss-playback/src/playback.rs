//! A motion to be shown, gathered call by call.

use std::path::Path;

use gauss_runtime::integrate::RunRecord;
use gauss_runtime::prelude::{FrameName, FramedSystem, GaussSystem, Isometry3, Sample, Vector3};

use crate::error::PlaybackError;
use crate::page::{self, Arrow};
use crate::recording::Recording;
use crate::shape::Shape;

/// Pictures of a run: at 60 a second it takes ten seconds to play.
const PICTURES: u32 = 600;

/// A motion to be shown. What is added to it is computed at once, for all times; mistakes are gathered and told by
/// [`html`](Self::html) and [`write`](Self::write).
pub struct Playback<S: GaussSystem<Scalar = f64>> {
    pub(crate) samples: Vec<Sample<S>>,
    pub(crate) shown: Recording,
}

impl<S: GaussSystem<Scalar = f64>> Playback<S> {
    /// The playback of the record of a run: of a [`Trajectory`](gauss_runtime::integrate::Trajectory), or of a run with
    /// contacts, from event to event or in steps. There are pictures at 600 times equally far apart, and one before and
    /// one after each jump of the state or of a contact's force, so that a jump is none that takes a time.
    ///
    /// # Errors
    /// The error of [`RunRecord::state_at`].
    pub fn new<R: RunRecord<S> + ?Sized>(title: &str, run: &R) -> Result<Self, R::Error> {
        Self::with_pictures(title, run, PICTURES)
    }

    /// The same with another number of pictures, at least two: more for long runs with fast turns, fewer for small
    /// files.
    ///
    /// # Errors
    /// The error of [`RunRecord::state_at`].
    pub fn with_pictures<R: RunRecord<S> + ?Sized>(title: &str, run: &R, pictures: u32) -> Result<Self, R::Error> {
        Ok(Self::of_samples(title, run.sampled(pictures as usize)?))
    }

    /// The playback of samples in the order of time. The page plays evenly in time, whatever the distances of samples.
    #[must_use]
    pub fn of_samples(title: &str, samples: Vec<Sample<S>>) -> Self {
        let times = samples.iter().map(|sample| sample.t).collect();
        Self { samples, shown: Recording::new(title, times) }
    }

    fn with(self, change: impl FnOnce(Recording) -> Recording) -> Self {
        Self { samples: self.samples, shown: change(self.shown) }
    }

    /// A body: its pose, by the observer, and its shapes.
    #[must_use]
    pub fn body(
        mut self,
        name: &str,
        pose: impl Fn(&Sample<S>) -> Isometry3<f64>,
        shapes: impl IntoIterator<Item = Shape>,
    ) -> Self {
        let poses: Vec<[f64; 7]> = self.samples.iter().map(|sample| page::pose(&pose(sample))).collect();
        self.shown.add_body(name, poses);
        shapes.into_iter().fold(self, |playback, shape| playback.shape(name, shape))
    }

    /// All frames that the kernel has methods for, `frames(…)`, as bodies without a shape: [`shape`](Self::shape) and
    /// [`rod`](Self::rod) give them one.
    #[must_use]
    pub fn frames(mut self, kernel: &S) -> Self
    where
        S: FramedSystem,
    {
        for &frame in S::Frame::ALL {
            // R of a matrix as the nearest quaternion.
            let pose = |sample: &Sample<S>| {
                page::pose(&gauss_runtime::nalgebra::convert(kernel.pose_of(frame, sample.t, &sample.q)))
            };
            let poses = self.samples.iter().map(pose).collect();
            self.shown.add_body(frame.name(), poses);
        }
        self
    }

    /// A vector at a point, both by the observer: a force, a momentum. `scale` is its length on the screen per unit, in
    /// the units of length of the scene.
    #[must_use]
    pub fn arrow(
        mut self,
        name: &str,
        scale: f64,
        vector: impl Fn(&Sample<S>) -> (Vector3<f64>, Vector3<f64>),
    ) -> Self {
        let both: Vec<[f64; 6]> = self
            .samples
            .iter()
            .map(|sample| {
                let (at, vector) = vector(sample);
                [at.x, at.y, at.z, vector.x * scale, vector.y * scale, vector.z * scale]
            })
            .collect();
        self.shown.look_at(&format!("arrow `{name}`"), &both);
        self.shown.page.arrows.push(Arrow { name: name.to_owned(), values: both });
        self
    }

    /// A curve over time below the motion; curves of one `panel`, such as `"energy / J"`, share their axis.
    #[must_use]
    pub fn curve(self, panel: &str, name: &str, value: impl Fn(&Sample<S>) -> f64) -> Self {
        self.curve_in((panel, ""), name, value)
    }

    fn curve_in(mut self, (panel, unit): (&str, &'static str), name: &str, value: impl Fn(&Sample<S>) -> f64) -> Self {
        let values: Vec<f64> = self.samples.iter().map(value).collect();
        self.shown.add_curve((panel, unit), name, values);
        self
    }

    /// Kinetic energy, potential energy and their sum, in the unit of energy of the scene: J after [`si`](Self::si).
    #[must_use]
    pub fn energy(self, kernel: &S) -> Self {
        let panel = ("energy", "J");
        self.curve_in(panel, "kinetic", |s| kernel.kinetic_energy(s.t, &s.q, &s.z))
            .curve_in(panel, "potential", |s| kernel.potential_energy(s.t, &s.q))
            .curve_in(panel, "sum", |s| kernel.energy(s.t, &s.q, &s.z))
    }

    /// A shape more of a body.
    #[must_use]
    pub fn shape(self, body: &str, shape: Shape) -> Self {
        self.with(|shown| shown.shape(body, shape))
    }

    /// Gives the bodies that are there, such as those of [`frames`](Self::frames), the boxes, cylinders and balls that
    /// the links of their names have in a URDF file: those that are shown, and where these are meshes those that touch.
    #[cfg(feature = "urdf")]
    #[must_use]
    pub fn shapes_of_urdf(self, file: impl AsRef<Path>) -> Self {
        self.with(|shown| shown.shapes_of_urdf(file))
    }

    /// A rod from the origin of one body to that of another, as a skeleton has them.
    #[must_use]
    pub fn rod(self, from: &str, to: &str, radius: f64) -> Self {
        self.with(|shown| shown.rod(from, to, radius))
    }

    /// The path of a point of a body, body axes from O.
    #[must_use]
    pub fn trace(self, body: &str, point: [f64; 3]) -> Self {
        self.with(|shown| shown.trace(body, point))
    }

    /// The direction that is up on the screen, observer's axes; without this k₃. In a scene whose k₃ points down, as
    /// those of ships do, `[0.0, 0.0, -1.0]`; for motion in the plane of k₁ and k₂ with weight along −k₂,
    /// `[0.0, 1.0, 0.0]`.
    #[must_use]
    pub fn up(self, direction: [f64; 3]) -> Self {
        self.with(|shown| shown.up(direction))
    }

    /// Looks at the motion from above at first.
    #[must_use]
    pub fn from_above(self) -> Self {
        self.with(|shown| shown.from_above())
    }

    /// Looks at the motion from the side at first, along k₂ where k₃ is up: for motion in the plane of k₁ and k₃.
    #[must_use]
    pub fn from_the_side(self) -> Self {
        self.with(|shown| shown.from_the_side())
    }

    /// Lets the camera go with a body, and come near it; without this it sees everything from where it is.
    #[must_use]
    pub fn follow(self, body: &str) -> Self {
        self.with(|shown| shown.follow(body))
    }

    /// Says that the scene is in units of the SI: the page then shows those of time, length and energy.
    #[must_use]
    pub fn si(self) -> Self {
        self.with(|shown| shown.si())
    }

    /// The page.
    ///
    /// # Errors
    /// [`PlaybackError::Mistakes`]: names that no body has or two have, numbers that are not finite.
    pub fn html(&self) -> Result<String, PlaybackError> {
        self.shown.html()
    }

    /// Writes the page to a file, and the folders above it where they are missing. A file that is there stays as it is
    /// until the new one is whole.
    ///
    /// # Errors
    /// As [`html`](Self::html), and [`PlaybackError::Io`].
    pub fn write(&self, file: impl AsRef<Path>) -> Result<(), PlaybackError> {
        self.shown.write(file)
    }
}
