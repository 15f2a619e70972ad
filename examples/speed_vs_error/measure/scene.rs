//! The data of scenes: parameters, initial and final states from `data/speed_vs_error.json`, and the error against
//! the end.

use std::error::Error;

use gauss_runtime::prelude::*;
use serde_json::Value;

use super::about::About;

/// A scene.
#[derive(Clone)]
pub struct Scene {
    /// Its entry in the catalogue.
    pub about: &'static About,
    /// What the data say about it.
    pub description: String,
    /// The motion goes from 0 to here, s.
    pub duration: f64,
    /// The relative change of the end when the start is off by a relative one, to first order; where it is known.
    pub sensitivity: Option<f64>,
    /// Errors below this are errors of the reference, which is given to as many digits.
    pub resolution: f64,
    /// What other systems reach on it, where that is published.
    pub published: Option<Published>,
    data: Value,
}

/// Figures that others reached on the same motion, taken on another machine: to be read beside ours, not against them.
#[derive(Clone, Debug)]
pub struct Published {
    /// What was measured, and on what.
    pub about: String,
    /// An error of 1e-11 is to be reached in less than this, µs per simulated second, on a machine like that.
    pub goal: f64,
    /// The figures.
    pub figures: Vec<Figure>,
}

/// A published figure.
#[derive(Clone, Debug)]
pub struct Figure {
    /// The program.
    pub system: String,
    /// Its step or tolerance.
    pub setting: String,
    /// µs per simulated second.
    pub time: f64,
    /// In the final attitude, rad.
    pub error: f64,
}

/// The data of scenes.
///
/// # Errors
/// When the data are not what they should be.
pub fn read(all: impl Iterator<Item = &'static About>) -> Result<Vec<Scene>, Box<dyn Error>> {
    let file: Value = serde_json::from_str(include_str!("../../data/speed_vs_error.json"))?;
    let list = file["scenes"].as_array().ok_or("the data have no scenes")?;
    let find = |about: &'static About| {
        let data = list.iter().find(|data| data["name"] == about.name);
        let data = data.ok_or_else(|| format!("the data have no scene {}", about.name))?.clone();
        Ok(Scene {
            about,
            description: data["description"].as_str().unwrap_or_default().to_owned(),
            duration: number(&data["T"])?,
            sensitivity: number(&data["change_per_rounding"]).ok().map(|change| change / (0.5 * f64::EPSILON)),
            resolution: if data["digits"] == 36 { f64::EPSILON } else { 1e-13 },
            published: match &data["published"] {
                Value::Null => None,
                figures => Some(published(&file["published"], figures)?),
            },
            data,
        })
    };
    all.map(find).collect()
}

fn published(about: &Value, data: &Value) -> Result<Published, Box<dyn Error>> {
    let text = |value: &Value| value.as_str().map(str::to_owned).ok_or("a published figure lacks a word");
    let figure = |figure: &Value| {
        Ok(Figure {
            system: text(&figure["system"])?,
            setting: text(&figure["setting"])?,
            time: number(&figure["us_per_s"])?,
            error: number(&figure["error"])?,
        })
    };
    let figures = data["figures"].as_array().ok_or("there are no published figures")?;
    Ok(Published {
        about: text(about)?,
        goal: number(&data["goal_us_per_s"])?,
        figures: figures.iter().map(figure).collect::<Result<_, Box<dyn Error>>>()?,
    })
}

impl Scene {
    /// One number at a path like `parameters/mass`.
    ///
    /// # Errors
    /// When there is none.
    pub fn number(&self, path: &str) -> Result<f64, Box<dyn Error>> {
        number(self.at(path)?)
    }

    /// All numbers at a path, matrices row by row.
    ///
    /// # Errors
    /// When something else is there.
    pub fn numbers(&self, path: &str) -> Result<Vec<f64>, Box<dyn Error>> {
        numbers(self.at(path)?)
    }

    /// Three numbers.
    ///
    /// # Errors
    /// When there are not three.
    pub fn vector(&self, path: &str) -> Result<Vector3<f64>, Box<dyn Error>> {
        let three: [f64; 3] = self.numbers(path)?.try_into().map_err(|_| format!("{path} is no vector"))?;
        Ok(three.into())
    }

    /// A matrix of N rows.
    ///
    /// # Errors
    /// When it has another size.
    pub fn matrix<const N: usize>(&self, path: &str) -> Result<SMatrix<f64, N, N>, Box<dyn Error>> {
        let rows = self.numbers(path)?;
        if rows.len() == N * N { Ok(SMatrix::from_fn(|i, j| rows[N * i + j])) } else { Err(path.into()) }
    }

    /// The initial pose (R, b).
    ///
    /// # Errors
    /// When there is none.
    pub fn pose(&self) -> Result<Isometry3<f64>, Box<dyn Error>> {
        let matrix = self.matrix::<3>("initial/R")?;
        let columns = [0, 1, 2].map(|n| Vector3::from(matrix.column(n)));
        // The entries are good to rounding, and so is the quaternion, made of the largest of its components.
        let rotation = UnitQuaternion::new_normalize(UnitQuaternion::from_basis_unchecked(&columns).into_inner());
        Ok(Isometry3::from_parts(Translation3::from(self.vector("initial/b")?), rotation))
    }

    /// The initial twist (u, ω), body axes, pole O.
    ///
    /// # Errors
    /// When there is none.
    pub fn twist(&self) -> Result<Vector6<f64>, Box<dyn Error>> {
        let (u, omega) = (self.vector("initial/body_u")?, self.vector("initial/body_omega")?);
        Ok(Vector6::new(u.x, u.y, u.z, omega.x, omega.y, omega.z))
    }

    fn at(&self, path: &str) -> Result<&Value, Box<dyn Error>> {
        self.data.pointer(&format!("/{path}")).ok_or_else(|| format!("{} has no {path}", self.about.name).into())
    }
}

/// How far off a final state is: what is seen of it, in groups that have one size each, against the reference.
///
/// The error is the largest of the groups': of an attitude the angle between the two, rad; of a position its largest
/// component, relative to the largest of the reference where that is above 1.
#[derive(Clone, Debug)]
pub struct Target {
    groups: Vec<Vec<f64>>,
}

impl Target {
    /// What the final state of the scene has under these keys; a key that is missing is passed over.
    pub fn of(scene: &Scene, keys: &[&str]) -> Self {
        Self { groups: keys.iter().filter_map(|key| scene.numbers(&format!("final/{key}")).ok()).collect() }
    }

    /// How many groups there are.
    pub fn groups(&self) -> usize {
        self.groups.len()
    }

    /// The error of groups that were found; infinite where one is missing or not a number.
    #[must_use]
    pub fn error(&self, found: &[Vec<f64>]) -> f64 {
        if found.len() != self.groups.len() {
            return f64::INFINITY;
        }
        found.iter().zip(&self.groups).fold(0.0_f64, |worst, (found, expected)| {
            let differences = found.iter().zip(expected).map(|(found, expected)| (found - expected).abs());
            let error = if expected.len() == 9 {
                // The Frobenius norm of the difference of two rotation matrices is √8 sin of half the angle between
                // them.
                let squares: f64 = differences.map(|difference| difference * difference).sum();
                // `min` would drop a NaN.
                2.0 * (squares / 8.0).sqrt().clamp(0.0, 1.0).asin()
            } else {
                let size = expected.iter().fold(1.0_f64, |size, x| size.max(x.abs()));
                // `max` would drop a NaN.
                differences.fold(0.0, |worst: f64, x| if x > worst || x.is_nan() { x } else { worst }) / size
            };
            if error.is_nan() { f64::INFINITY } else { worst.max(error) }
        })
    }
}

/// The entries of R row by row.
pub fn rows(rotation: &UnitQuaternion<f64>) -> Vec<f64> {
    rotation.to_rotation_matrix().into_inner().transpose().iter().copied().collect()
}

/// An exact decimal or a fraction p/q.
fn number(value: &Value) -> Result<f64, Box<dyn Error>> {
    let text = value.as_str().ok_or_else(|| format!("{value} is no number"))?;
    match text.split_once('/') {
        Some((p, q)) => Ok(p.parse::<f64>()? / q.parse::<f64>()?),
        None => Ok(text.parse()?),
    }
}

fn numbers(value: &Value) -> Result<Vec<f64>, Box<dyn Error>> {
    match value {
        Value::Array(items) => {
            let parts: Vec<Vec<f64>> = items.iter().map(numbers).collect::<Result<_, _>>()?;
            Ok(parts.concat())
        }
        _ => Ok(vec![number(value)?]),
    }
}
