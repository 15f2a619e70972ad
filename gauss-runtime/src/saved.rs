//! States and runs as data, for the crate `serde` (feature `serde`).
//!
//! | type | is written as |
//! |---|---|
//! | the struct of parameters | by `#[derive(Serialize, Deserialize)]`, which the user adds to `GaussDynamics` |
//! | [`Coordinates`], [`Speeds`] | numbers by the [names](DescribedSystem::COORDINATE_NAMES) of the scene, `{"turn_i": 0.1, …}`; a list where it has none |
//! | [`Sample`] | `t`, `q`, `z`, `p` |
//! | [`Trajectory`], [`Record`] | `samples`, `events`, `stopped_by` |
//!
//! A trajectory borrows the kernel that made it, so what is read is a [`Record`]. Formats without names, as most binary
//! ones, keep the order alone. All numbers come back with the same bits, if the format keeps them.
//!
//! What is read is checked: names that are unknown, missing or there twice, infinities, NaN, and rotations that are
//! none (see
//! [`check`]) are errors of the format with the reason in words. Parameters are checked by `kernel()`, as ever.
//!
#![cfg_attr(
    feature = "derive",
    doc = r##"
```
use gauss_runtime::prelude::*;
use gauss_runtime::saved::{Coordinates, Record, Speeds};
use serde::{Deserialize, Serialize};

#[derive(GaussDynamics, Serialize, Deserialize)]
#[gauss(chart = left_invariant, motion = fixed_point)]
struct Top {
    #[gauss(mass)] mass: f64,
    #[gauss(center_of_mass)] center: Vector3<f64>,
    #[gauss(inertia)] inertia: Vector3<f64>,
    #[gauss(gravity)] gravity: f64,
}

/// All that an experiment needs.
#[derive(Serialize, Deserialize)]
struct Experiment {
    top: Top,
    q: Coordinates<TopKernel>,
    z: Speeds<TopKernel>,
}

let text = r#"{
    "top": {"mass": 1.0, "center": [0.0, 0.0, 0.1], "inertia": [0.2, 0.2, 0.1], "gravity": 9.81},
    "q": {"rotation_i": 0.6, "rotation_j": 0.0, "rotation_k": 0.0, "rotation_w": 0.8},
    "z": {"omega_x": 0.0, "omega_y": 0.0, "omega_z": 30.0}
}"#;
let Experiment { top, q, z } = serde_json::from_str(text)?;
let kernel = top.kernel()?;
let path = Simulation::new(&kernel).fixed_step(0.01).run(q.0, z.0, 0.0..0.1)?;
let read: Record<TopKernel> = serde_json::from_str(&serde_json::to_string(&path)?)?;
assert_eq!(read.samples.len(), path.len());
assert_eq!(read.samples[7].q, path.samples()[7].q);
# Ok::<(), Box<dyn std::error::Error>>(())
```
"##
)]

mod numbers;

use serde::de::{Deserialize, Deserializer, Error};
use serde::ser::{Serialize, Serializer};

#[cfg(feature = "alloc")]
use alloc::vec::Vec;
use core::fmt;

use crate::configuration::{Configuration, StateError, VectorSpace, all_finite, check};
use crate::description::DescribedSystem;
use crate::integrate::Sample;
#[cfg(feature = "alloc")]
use crate::integrate::{EventSample, Trajectory};
use crate::real::Real;
use crate::system::GaussSystem;
use numbers::{Names, Numbers};

/// The configuration of a system, written by the names of its coordinates.
pub struct Coordinates<S: GaussSystem>(pub S::Configuration);

/// Quasi-velocities, or momenta, written by the names of the speeds.
pub struct Speeds<S: GaussSystem>(pub S::Speeds);

macro_rules! copy_and_debug {
    ($($name:ident),*) => {$(
        impl<S: GaussSystem> Copy for $name<S> {}

        impl<S: GaussSystem> Clone for $name<S> {
            fn clone(&self) -> Self {
                *self
            }
        }

        impl<S: GaussSystem> fmt::Debug for $name<S> {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.debug_tuple(stringify!($name)).field(&self.0).finish()
            }
        }
    )*};
}
copy_and_debug!(Coordinates, Speeds);

type ComponentsOf<S> = <<S as GaussSystem>::Configuration as Configuration>::Components;

impl<S: GaussSystem<Scalar: Serialize> + DescribedSystem> Serialize for Coordinates<S> {
    fn serialize<W: Serializer>(&self, serializer: W) -> Result<W::Ok, W::Error> {
        Numbers::new(self.0.components()).serialize(coordinate_names::<S>(), serializer)
    }
}

impl<'de, S: GaussSystem<Scalar: Deserialize<'de>> + DescribedSystem> Deserialize<'de> for Coordinates<S> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let names = coordinate_names::<S>();
        let q = S::Configuration::from_components(&Numbers::read(names, deserializer)?);
        check(&q).map_err(|error| refused(names, error))?;
        Ok(Self(q))
    }
}

impl<S: GaussSystem<Scalar: Serialize> + DescribedSystem> Serialize for Speeds<S> {
    fn serialize<W: Serializer>(&self, serializer: W) -> Result<W::Ok, W::Error> {
        Numbers::new(self.0).serialize(speed_names::<S>(), serializer)
    }
}

impl<'de, S: GaussSystem<Scalar: Deserialize<'de>> + DescribedSystem> Deserialize<'de> for Speeds<S> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let names = speed_names::<S>();
        let z: S::Speeds = Numbers::read(names, deserializer)?;
        all_finite::<S::Scalar, _>(&z).map_err(|error| refused(names, error))?;
        Ok(Self(z))
    }
}

fn coordinate_names<S: GaussSystem + DescribedSystem>() -> Names {
    Names::of(S::COORDINATE_NAMES, <ComponentsOf<S> as VectorSpace<S::Scalar>>::DIM)
}

fn speed_names<S: GaussSystem + DescribedSystem>() -> Names {
    Names::of(S::SPEED_NAMES, S::Speeds::DIM)
}

/// The error of a format.
fn refused<E: Error>(names: Names, error: StateError) -> E {
    match error {
        StateError::NotFinite { component } => {
            E::custom(format_args!("`{}` is infinite or undefined", names.name(component)))
        }
        error => E::custom(error),
    }
}

/// A sample as it is written.
#[derive(serde::Serialize, serde::Deserialize)]
#[serde(
    rename = "Sample",
    deny_unknown_fields,
    bound(
        serialize = "S: GaussSystem<Scalar: Serialize> + DescribedSystem",
        deserialize = "S: GaussSystem<Scalar: Deserialize<'de>> + DescribedSystem"
    )
)]
struct SavedSample<S: GaussSystem> {
    t: S::Scalar,
    q: Coordinates<S>,
    z: Speeds<S>,
    p: Speeds<S>,
}

impl<S: GaussSystem<Scalar: Serialize> + DescribedSystem> Serialize for Sample<S> {
    fn serialize<W: Serializer>(&self, serializer: W) -> Result<W::Ok, W::Error> {
        let Self { t, q, z, p } = *self;
        SavedSample::<S> { t, q: Coordinates(q), z: Speeds(z), p: Speeds(p) }.serialize(serializer)
    }
}

impl<'de, S: GaussSystem<Scalar: Deserialize<'de>> + DescribedSystem> Deserialize<'de> for Sample<S> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let SavedSample { t, q, z, p } = SavedSample::<S>::deserialize(deserializer)?;
        if !Real::is_finite(t) {
            return Err(D::Error::custom("`t` is infinite or undefined"));
        }
        Ok(Self { t, q: q.0, z: z.0, p: p.0 })
    }
}

/// Record of a run as data: its samples, at which times nothing else is known, and its events. What takes samples, as
/// `Table::new` of the crate `gauss-tables` does, goes on from there.
#[cfg(feature = "alloc")]
#[derive(serde::Serialize, serde::Deserialize)]
#[serde(
    deny_unknown_fields,
    bound(
        serialize = "S: GaussSystem<Scalar: Serialize> + DescribedSystem",
        deserialize = "S: GaussSystem<Scalar: Deserialize<'de>> + DescribedSystem"
    )
)]
#[non_exhaustive]
pub struct Record<S: GaussSystem> {
    /// In the order of integration.
    pub samples: Vec<Sample<S>>,
    /// In the order in which they happened.
    pub events: Vec<EventSample<S>>,
    /// The event that ended the run.
    pub stopped_by: Option<usize>,
}

#[cfg(feature = "alloc")]
impl<S: GaussSystem> Clone for Record<S> {
    fn clone(&self) -> Self {
        Self { samples: self.samples.clone(), events: self.events.clone(), stopped_by: self.stopped_by }
    }
}

#[cfg(feature = "alloc")]
impl<S: GaussSystem> fmt::Debug for Record<S> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { samples, events, stopped_by } = self;
        let mut fields = f.debug_struct("Record");
        fields.field("samples", samples).field("events", events).field("stopped_by", stopped_by).finish()
    }
}

#[cfg(feature = "alloc")]
impl<S: GaussSystem> From<&Trajectory<'_, S>> for Record<S> {
    fn from(path: &Trajectory<'_, S>) -> Self {
        Self { samples: path.samples().to_vec(), events: path.events().to_vec(), stopped_by: path.stopped_by() }
    }
}

#[cfg(feature = "alloc")]
impl<S: GaussSystem<Scalar: Serialize> + DescribedSystem> Serialize for Trajectory<'_, S> {
    fn serialize<W: Serializer>(&self, serializer: W) -> Result<W::Ok, W::Error> {
        Record::from(self).serialize(serializer)
    }
}

/// Serialisation of fields of your own structs, `#[serde(with = "gauss_runtime::saved::checked")] pose:
/// Isometry3<f64>`: written as `nalgebra` writes it, and [checked](check) when it is read, which `nalgebra` does not.
pub mod checked {
    use super::{Configuration, Deserialize, Deserializer, Error, Serialize, Serializer, check};

    /// As it is.
    ///
    /// # Errors
    /// The error of the format.
    pub fn serialize<Q: Serialize, W: Serializer>(q: &Q, serializer: W) -> Result<W::Ok, W::Error> {
        q.serialize(serializer)
    }

    /// As it is, and checked.
    ///
    /// # Errors
    /// The error of the format, and that of [`check`].
    pub fn deserialize<'de, Q: Configuration + Deserialize<'de>, D: Deserializer<'de>>(
        deserializer: D,
    ) -> Result<Q, D::Error> {
        let q = Q::deserialize(deserializer)?;
        check(&q).map_err(D::Error::custom)?;
        Ok(q)
    }
}
