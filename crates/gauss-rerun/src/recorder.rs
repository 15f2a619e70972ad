//! Entities of a recording, call by call.

use gauss_runtime::nalgebra::{Point3, convert};
use gauss_runtime::prelude::{FrameName, FramedSystem, GaussSystem, Isometry3, SVector, Sample, Trajectory, Vector3};
use rerun::{Arrows3D, AsComponents, LineStrips3D, Quaternion, RecordingStream, Scalars, Transform3D, ViewCoordinates};

use crate::error::RecordError;

/// Pictures of a run, as of a playback: ten seconds at 60 a second.
const PICTURES: u32 = 600;

/// A run that is written to a stream. What a call adds is sent at once.
///
/// Bodies are entities `world/NAME`, traces `world/traces/NAME`, arrows `world/arrows/NAME`, scalars
/// `scalars/PANEL/NAME`.
pub struct Recorder<'r, S: GaussSystem<Scalar = f64>> {
    stream: &'r RecordingStream,
    samples: Vec<Sample<S>>,
    bodies: Vec<(String, Vec<Isometry3<f64>>)>,
}

impl<'r, S: GaussSystem<Scalar = f64>> Recorder<'r, S> {
    /// The recorder of a run, at 600 times equally far apart; states between its samples are those of
    /// [`Trajectory::at`].
    ///
    /// # Errors
    /// The error of [`Trajectory::at`], or that of the SDK.
    pub fn new(stream: &'r RecordingStream, path: &Trajectory<'_, S>) -> Result<Self, RecordError> {
        let (first, last, gaps) = (path.first().t, path.last().t, PICTURES - 1);
        // The last time is that of the last sample itself: rounding must not leave the run.
        let time = |n: u32| if n == gaps { last } else { first + (last - first) * f64::from(n) / f64::from(gaps) };
        Self::of_samples(stream, path.at_times((0..=gaps).map(time))?)
    }

    /// The recorder of given samples.
    ///
    /// # Errors
    /// The error of the SDK.
    pub fn of_samples(stream: &'r RecordingStream, samples: Vec<Sample<S>>) -> Result<Self, RecordError> {
        stream.log_static("world", &ViewCoordinates::RIGHT_HAND_Z_UP())?;
        Ok(Self { stream, samples, bodies: Vec::new() })
    }

    /// A body: its pose, by the observer.
    ///
    /// # Errors
    /// The error of the SDK.
    pub fn body(mut self, name: &str, pose: impl Fn(&Sample<S>) -> Isometry3<f64>) -> Result<Self, RecordError> {
        let poses: Vec<Isometry3<f64>> = self.samples.iter().map(pose).collect();
        for (sample, pose) in self.samples.iter().zip(&poses) {
            self.at(sample);
            let pose = pose.cast::<f32>();
            let orientation = Quaternion::from_xyzw(pose.rotation.coords.into());
            let position: [f32; 3] = pose.translation.vector.into();
            self.stream.log(entity(name), &Transform3D::from_translation_rotation(position, orientation))?;
        }
        self.bodies.push((name.to_owned(), poses));
        Ok(self)
    }

    /// All frames that the kernel has methods for, `frames(…)`, by their names.
    ///
    /// # Errors
    /// The error of the SDK.
    pub fn frames(mut self, kernel: &S) -> Result<Self, RecordError>
    where
        S: FramedSystem,
    {
        for &frame in S::Frame::ALL {
            self = self.body(frame.name(), |s| convert(kernel.pose_of(frame, s.t, &s.q)))?;
        }
        Ok(self)
    }

    /// Adds a shape to a body, in body axes about O: any of Rerun's shapes, such as `Boxes3D`, `Ellipsoids3D`,
    /// `Cylinders3D`, `Asset3D` of a mesh.
    ///
    /// # Errors
    /// [`RecordError::UnknownBody`], or the error of the SDK.
    pub fn shape(self, body: &str, shape: &impl AsComponents) -> Result<Self, RecordError> {
        self.poses(body)?;
        self.stream.log_static(entity(body), shape)?;
        Ok(self)
    }

    /// The path of a point of a body, body axes from O.
    ///
    /// # Errors
    /// [`RecordError::UnknownBody`], or the error of the SDK.
    pub fn trace(self, body: &str, name: &str, point: [f64; 3]) -> Result<Self, RecordError> {
        let poses = self.poses(body)?;
        let places: Vec<[f32; 3]> =
            poses.iter().map(|pose| (pose * Point3::from(point)).coords.cast::<f32>().into()).collect();
        self.stream.reset_time();
        self.stream.log_static(format!("world/traces/{name}"), &LineStrips3D::new([places]))?;
        Ok(self)
    }

    /// A vector at a point, both by the observer: a force, a momentum. `scale` is its length in the scene per unit.
    ///
    /// # Errors
    /// The error of the SDK.
    pub fn arrow(
        self,
        name: &str,
        scale: f64,
        vector: impl Fn(&Sample<S>) -> (Vector3<f64>, Vector3<f64>),
    ) -> Result<Self, RecordError> {
        for sample in &self.samples {
            self.at(sample);
            let [at, vector] = <[SVector<f64, 3>; 2]>::from(vector(sample)).map(|v| <[f32; 3]>::from(v.cast::<f32>()));
            let arrow = Arrows3D::from_vectors([vector.map(|part| part * scale as f32)]).with_origins([at]);
            self.stream.log(format!("world/arrows/{name}"), &arrow)?;
        }
        Ok(self)
    }

    /// A number over time; those of one `panel` stand together.
    ///
    /// # Errors
    /// The error of the SDK.
    pub fn scalar(self, panel: &str, name: &str, value: impl Fn(&Sample<S>) -> f64) -> Result<Self, RecordError> {
        for sample in &self.samples {
            self.at(sample);
            self.stream.log(format!("scalars/{panel}/{name}"), &Scalars::single(value(sample)))?;
        }
        Ok(self)
    }

    /// Kinetic energy, potential energy and their sum.
    ///
    /// # Errors
    /// The error of the SDK.
    pub fn energy(self, kernel: &S) -> Result<Self, RecordError> {
        self.scalar("energy", "kinetic", |s| kernel.kinetic_energy(s.t, &s.q, &s.z))?
            .scalar("energy", "potential", |s| kernel.potential_energy(s.t, &s.q))?
            .scalar("energy", "sum", |s| kernel.energy(s.t, &s.q, &s.z))
    }

    fn at(&self, sample: &Sample<S>) {
        self.stream.set_duration_secs("t", sample.t);
    }

    fn poses(&self, body: &str) -> Result<&[Isometry3<f64>], RecordError> {
        let found = self.bodies.iter().find(|(name, _)| name == body);
        found.map(|(_, poses)| &poses[..]).ok_or_else(|| RecordError::UnknownBody(body.to_owned()))
    }
}

fn entity(body: &str) -> String {
    format!("world/{body}")
}
