//! Reference solutions: one JSON file a scene, numbers as strings.

use std::collections::BTreeMap;
use std::path::Path;

use gauss_runtime::prelude::*;
use serde::Deserialize;

/// A number written as an exact decimal or a fraction `p/q`, rounded once.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq)]
#[serde(try_from = "String")]
pub struct Number(pub f64);

impl TryFrom<String> for Number {
    type Error = String;

    fn try_from(text: String) -> Result<Self, String> {
        let wrong = || format!("`{text}` is neither a decimal nor a fraction p/q");
        let value = match text.split_once('/') {
            // `ratio` rounds once.
            Some((p, q)) => {
                let (p, q) = (p.parse::<i64>().map_err(|_| wrong())?, q.parse::<i64>().map_err(|_| wrong())?);
                if q == 0 {
                    return Err(wrong());
                }
                Real::ratio(p, q)
            }
            // So does the standard library, however many digits there are.
            None => text.parse::<f64>().map_err(|_| wrong())?,
        };
        if value.is_finite() { Ok(Self(value)) } else { Err(wrong()) }
    }
}

type Triple = [Number; 3];

fn vector(v: &Triple) -> Vector3<f64> {
    Vector3::from(v.map(|n| n.0))
}

fn matrix3(rows: &[Triple; 3]) -> Matrix3<f64> {
    Matrix3::from_fn(|i, j| rows[i][j].0)
}

#[derive(Deserialize)]
struct File {
    name: String,
    parameters: FileParameters,
    #[serde(rename = "T")]
    duration: Number,
    initial: FileState,
    #[serde(rename = "final")]
    last: FileState,
    conserved: BTreeMap<String, FileConserved>,
    double_precision_guide: FileGuide,
}

#[derive(Deserialize)]
struct FileParameters {
    mass: Option<Number>,
    #[serde(rename = "centre_of_mass_body_from_O")]
    center: Option<Triple>,
    #[serde(rename = "inertia_about_O")]
    inertia: Option<[Triple; 3]>,
    gravity: Option<Number>,
    added_mass_6x6: Option<[[Number; 6]; 6]>,
    kinetic_matrix_6x6: Option<[[Number; 6]; 6]>,
    displaced_mass: Option<Number>,
    buoyancy_point: Option<Triple>,
}

#[derive(Deserialize)]
struct FileState {
    #[serde(rename = "R")]
    rotation: [Triple; 3],
    b: Triple,
    body_u: Triple,
    body_omega: Triple,
}

#[derive(Deserialize)]
struct FileConserved {
    value_t0: Value,
}

#[derive(Deserialize)]
#[serde(untagged)]
enum Value {
    One(Number),
    Three(Triple),
}

#[derive(Deserialize)]
struct FileGuide {
    change_if_initial_state_perturbed_by_2em53_relative: Number,
    #[serde(rename = "scipy_DOP853_rtol1e_13")]
    published: BTreeMap<String, FilePublished>,
}

#[derive(Deserialize)]
struct FilePublished {
    /// A number, or a sentence where the integration gave up.
    error_rel: String,
}

/// Physical parameters under the names that the fields of the test bodies have.
#[derive(Clone, Copy, Debug)]
pub struct Parameters {
    /// m.
    pub mass: f64,
    /// G − O, body axes.
    pub center: Vector3<f64>,
    /// About O, body axes.
    pub inertia: Matrix3<f64>,
    /// The diagonal of `inertia`: all of it where the axes are principal.
    pub principal: Vector3<f64>,
    /// Along −k₃; zero without gravity.
    pub gravity: f64,
    /// About O, order (u, ω); zero without a fluid.
    pub added: Matrix6<f64>,
    /// Mass of the displaced fluid; zero without a fluid.
    pub displaced: f64,
    /// Where buoyancy acts, body axes from O.
    pub buoyancy: Vector3<f64>,
}

/// A pose (R, b) and a body twist (u, ω) about O.
#[derive(Clone, Copy, Debug)]
pub struct State {
    /// R as listed, each entry rounded once.
    pub rotation: Matrix3<f64>,
    /// b = O − Ω, observer axes.
    pub b: Vector3<f64>,
    /// Rᵀḃ.
    pub u: Vector3<f64>,
    /// Angular velocity, body axes.
    pub omega: Vector3<f64>,
}

impl State {
    /// (R, b), with R as a unit quaternion.
    #[must_use]
    pub fn pose(&self) -> Isometry3<f64> {
        Isometry3 { rotation: quaternion_of(&self.rotation), translation: Translation3::from(self.b) }
    }

    /// (u, ω).
    #[must_use]
    pub fn twist(&self) -> Vector6<f64> {
        Vector6::from_fn(|i, _| if i < 3 { self.u[i] } else { self.omega[i - 3] })
    }
}

/// The unit quaternion of a rotation matrix, from the largest of its four components (Shepperd 1978): every component
/// to a few roundings.
#[must_use]
pub fn quaternion_of(r: &Matrix3<f64>) -> UnitQuaternion<f64> {
    let trace = r.trace();
    // Four times the squares of x, y, z, w.
    let squares = [0, 1, 2, 3].map(|i| if i < 3 { 1.0 - trace + 2.0 * r[(i, i)] } else { 1.0 + trace });
    let largest = (0..4).fold(3, |best, i| if squares[i] > squares[best] { i } else { best });
    let mut q = UnitQuaternion::<f64>::identity().into_inner();
    let antisymmetric = |i: usize| r[((i + 2) % 3, (i + 1) % 3)] - r[((i + 1) % 3, (i + 2) % 3)];
    let coordinates: [f64; 4] = core::array::from_fn(|i| match (i, largest) {
        _ if i == largest => squares[i],
        (3, axis) | (axis, 3) => antisymmetric(axis),
        (a, b) => r[(a, b)] + r[(b, a)],
    });
    q.coords.copy_from_slice(&coordinates);
    UnitQuaternion::new_normalize(q)
}

/// A quantity that the motion keeps, with its value.
#[derive(Clone, Debug)]
pub struct Conserved {
    /// Its name in the file.
    pub name: String,
    /// One component or three.
    pub value: Vec<f64>,
}

/// A reference solution.
#[derive(Clone, Debug)]
pub struct Scene {
    /// The name of the file without `.json`.
    pub name: String,
    /// Of the body.
    pub parameters: Parameters,
    /// The motion is given at the times 0 and `duration`.
    pub duration: f64,
    /// At the time 0.
    pub initial: State,
    /// At the time `duration`.
    pub last: State,
    /// What the motion keeps.
    pub conserved: Vec<Conserved>,
    /// Relative change of the final state when the initial state is off by one rounding, 2⁻⁵³.
    pub sensitivity: f64,
    /// Relative errors of DOP853 with the relative tolerance 1e-13 on two textbook formulations: body velocities first,
    /// then space momenta with a quaternion (or another independent set). `None` where the integration gave up.
    pub published: Vec<Option<f64>>,
}

impl Scene {
    /// Reads `data/reference/<name>.json`.
    ///
    /// # Panics
    /// When the file is missing or not a scene: the tests cannot go on.
    #[must_use]
    pub fn load(name: &str) -> Self {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("data/reference").join(name).with_extension("json");
        let text = std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
        let file: File = serde_json::from_str(&text).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
        assert_eq!(file.name, name, "the scene has the name of its file");
        file.scene()
    }
}

impl File {
    fn scene(self) -> Scene {
        let state = |s: &FileState| State {
            rotation: matrix3(&s.rotation),
            b: vector(&s.b),
            u: vector(&s.body_u),
            omega: vector(&s.body_omega),
        };
        let conserved = |(name, c): (String, FileConserved)| Conserved {
            name,
            value: match c.value_t0 {
                Value::One(n) => vec![n.0],
                Value::Three(v) => v.map(|n| n.0).to_vec(),
            },
        };
        Scene {
            parameters: self.parameters.read(),
            duration: self.duration.0,
            initial: state(&self.initial),
            last: state(&self.last),
            conserved: self.conserved.into_iter().map(conserved).collect(),
            sensitivity: self.double_precision_guide.change_if_initial_state_perturbed_by_2em53_relative.0,
            published: self.double_precision_guide.published.values().map(|p| p.error_rel.parse().ok()).collect(),
            name: self.name,
        }
    }
}

impl FileParameters {
    fn read(&self) -> Parameters {
        let zero = Vector3::zeros();
        let matrix6 = |rows: &[[Number; 6]; 6]| Matrix6::from_fn(|i, j| rows[i][j].0);
        let mut parameters = Parameters {
            mass: self.mass.map_or(0.0, |m| m.0),
            center: self.center.as_ref().map_or(zero, vector),
            inertia: self.inertia.as_ref().map_or(Matrix3::zeros(), matrix3),
            principal: zero,
            gravity: self.gravity.map_or(0.0, |g| g.0),
            added: self.added_mass_6x6.as_ref().map_or(Matrix6::zeros(), matrix6),
            displaced: self.displaced_mass.map_or(0.0, |m| m.0),
            buoyancy: self.buoyancy_point.as_ref().map_or(zero, vector),
        };
        if let Some(total) = &self.kinetic_matrix_6x6 {
            // Only the sum of body and fluid is given, and only the sum matters without gravity: a ball of dyadic mass
            // and inertia, so that the subtraction is exact to a rounding of the total, less than every entry of the
            // total.
            (parameters.mass, parameters.inertia) = (0.375, Matrix3::from_diagonal_element(0.25));
            parameters.added = matrix6(total)
                - Matrix6::from_fn(|i, j| {
                    if i != j {
                        0.0
                    } else if i < 3 {
                        0.375
                    } else {
                        0.25
                    }
                });
        }
        parameters.principal = parameters.inertia.diagonal();
        parameters
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_rounded_once() {
        let read = |text: &str| Number::try_from(String::from(text)).map(|n| n.0);
        assert_eq!(read("4/3"), Ok(4.0 / 3.0));
        assert_eq!(read("-0.1"), Ok(-0.1));
        // Just above the middle of 1 and its successor: a parser that cuts digits rounds to 1.
        assert_eq!(read("1.000000000000000111022302462515654042364"), Ok(1.0 + f64::EPSILON));
        for wrong in ["", "1/0", "x", "1e999", "1/2/3"] {
            assert!(read(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn a_quaternion_has_its_matrix() {
        // Each of the four branches: the largest component is w, x, y, z in turn.
        for coordinates in [[0.1, -0.2, 0.3, 0.9], [0.9, 0.1, -0.2, 0.3], [0.3, 0.9, 0.1, -0.2], [-0.2, 0.3, 0.9, 0.1]]
        {
            let mut q = UnitQuaternion::<f64>::identity().into_inner();
            q.coords.copy_from_slice(&coordinates);
            let q = UnitQuaternion::new_normalize(q);
            let matrix = q.to_rotation_matrix().into_inner();
            let back = quaternion_of(&matrix).to_rotation_matrix().into_inner();
            assert!((back - matrix).amax() < 8.0 * f64::EPSILON, "{coordinates:?}");
        }
    }
}
