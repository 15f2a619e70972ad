//! The scenes: parameters, initial and final states from `data/speed_vs_error.json`, and what is said about them.

use std::error::Error;

use gauss_runtime::prelude::*;
use serde_json::Value;

/// What kind of motion it is: the targets differ.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A body that turns about a point without or with weight.
    Top,
    /// A free body in an ideal fluid, without or with weight.
    Fluid,
    /// Everything else.
    Other,
}

impl Kind {
    /// How many times as fast as the best baseline the best method is to be.
    pub fn target(self) -> f64 {
        if self == Self::Other { 3.0 } else { 5.0 }
    }
}

/// What is told of a scene beside its data.
struct About {
    name: &'static str,
    title: &'static str,
    kind: Kind,
    /// The fastest rate, rad/s: the longest step is about one radian of it.
    rate: f64,
}

const fn about(name: &'static str, title: &'static str, kind: Kind, rate: f64) -> About {
    About { name, title, kind, rate }
}

const ABOUT: [About; 20] = [
    about("hlw_free_body", "Free body", Kind::Top, 1.3),
    about("free_asym_top", "Free asymmetric top", Kind::Top, 2.0),
    about("free_near_separatrix", "Free body near its separatrix", Kind::Top, 1.0),
    about("trajectory_a", "Free body that turns over (trajectory A)", Kind::Top, 1.0),
    about("hlw_heavy_top", "Heavy asymmetric top", Kind::Top, 2.0),
    about("bruls_heavy_top", "Heavy top at 150 rad/s", Kind::Top, 150.0),
    about("simo_wong_top", "Heavy top at 50 rad/s", Kind::Top, 50.0),
    about("lagrange_top", "Lagrange's top", Kind::Top, 40.0),
    about("kovalevskaya", "Kovalevskaya's top", Kind::Top, 1.5),
    about("trajectory_b", "Heavy symmetric top (trajectory B)", Kind::Top, 15.0),
    about("kirchhoff_clebsch", "Body in fluid, Clebsch's case", Kind::Fluid, 1.5),
    about("kirchhoff_nonintegrable", "Body in fluid, not integrable", Kind::Fluid, 2.0),
    about("kirchhoff_buoyant", "Body in fluid with weight and buoyancy", Kind::Fluid, 3.0),
    about("full_added_mass", "Body in fluid, all added masses coupled", Kind::Fluid, 3.0),
    about("trajectory_c", "Vehicle in fluid (trajectory C)", Kind::Fluid, 1.5),
    about("drag_body", "Body with drag and a constant force", Kind::Other, 5.0),
    about("spherical_pendulum", "Spherical pendulum", Kind::Other, 4.0),
    about("double_pendulum", "Double pendulum", Kind::Other, 8.0),
    about("rolling_disk_falling", "Rolling disk", Kind::Other, 6.0),
    about("chaplygin_sleigh", "Chaplygin's sleigh", Kind::Other, 1.5),
];

/// A scene.
#[derive(Clone, Debug)]
pub struct Scene {
    /// Short, as on the command line.
    pub name: &'static str,
    /// For people.
    pub title: &'static str,
    /// What kind of motion.
    pub kind: Kind,
    /// The fastest rate, rad/s.
    pub rate: f64,
    /// What the data say about it.
    pub description: String,
    /// The motion goes from 0 to here, s.
    pub duration: f64,
    /// The relative change of the end when the start is off by one, where it is known.
    pub sensitivity: Option<f64>,
    /// Errors below this are errors of the reference, which is given to as many digits.
    pub resolution: f64,
    data: Value,
}

/// All scenes, in the order of the report.
///
/// # Errors
/// When the data are not what they should be.
pub fn scenes() -> Result<Vec<Scene>, Box<dyn Error>> {
    let file: Value = serde_json::from_str(include_str!("../data/speed_vs_error.json"))?;
    let list = file["scenes"].as_array().ok_or("the data have no scenes")?;
    let find = |about: &About| {
        let data = list.iter().find(|data| data["name"] == about.name);
        let data = data.ok_or_else(|| format!("the data have no scene {}", about.name))?.clone();
        Ok(Scene {
            name: about.name,
            title: about.title,
            kind: about.kind,
            rate: about.rate,
            description: data["description"].as_str().unwrap_or_default().to_owned(),
            duration: number(&data["T"])?,
            sensitivity: number(&data["change_per_rounding"]).ok().map(|change| change / (0.5 * f64::EPSILON)),
            resolution: if data["digits"] == 36 { f64::EPSILON } else { 1e-13 },
            data,
        })
    };
    ABOUT.iter().map(find).collect()
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
        self.data.pointer(&format!("/{path}")).ok_or_else(|| format!("{} has no {path}", self.name).into())
    }
}

/// How far off a final state is: what is seen of it, in groups that have one size each, against the reference.
///
/// The error is the largest difference of an entry of R (for small errors that of an angle in rad) or of a component of a
/// position, relative to the largest component where that is above 1.
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
        let mut worst = 0.0_f64;
        for (found, expected) in found.iter().zip(&self.groups) {
            let size = expected.iter().fold(1.0_f64, |size, x| size.max(x.abs()));
            for (found, expected) in found.iter().zip(expected) {
                let error = (found - expected).abs() / size;
                worst = if error.is_nan() { f64::INFINITY } else { worst.max(error) };
            }
        }
        worst
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
