//! Attributes of joints, tendons, actuators and contacts: parts of documents beside bodies.

/// Attributes of a joint beside its place.
#[derive(Clone, Debug, Default)]
pub struct JointAttributes {
    pub stiffness: f64,
    /// The force of springs where the joint is at 0.
    pub force: f64,
    pub damping: f64,
    pub armature: f64,
    pub friction_loss: f64,
    pub range: [Option<f64>; 2],
}

/// A sum of coordinates of joints, with a spring, a damper or both, or none where an actuator alone acts on it.
#[derive(Clone, Debug, Default)]
pub struct Tendon {
    pub name: String,
    /// Variables with their coefficients.
    pub coefficients: Vec<(usize, f64)>,
    pub stiffness: f64,
    pub length: f64,
    pub damping: f64,
}

/// The place where an actuator acts.
#[derive(Clone, Debug)]
pub enum Transmission {
    Joint {
        variable: usize,
        gear: Vec<f64>,
    },
    Tendon {
        name: String,
    },
    /// Force and torque at the O of a body, in its axes.
    Site {
        body: usize,
        gear: Vec<f64>,
    },
}

/// A force that is proportional to an input.
#[derive(Clone, Debug)]
pub struct Motor {
    pub name: String,
    pub on: Transmission,
}

/// A sphere of a body.
#[derive(Clone, Debug)]
pub struct BodySphere {
    pub body: usize,
    /// Its centre from O, in the axes of the body.
    pub center: [f64; 3],
    /// None of a point.
    pub radius: Option<f64>,
}

/// The shape that a sphere meets.
#[derive(Clone, Debug)]
pub enum Obstacle {
    /// A plane that stands still.
    Plane {
        normal: [f64; 3],
        height: f64,
    },
    Sphere(BodySphere),
}

/// A contact of a sphere.
#[derive(Clone, Debug)]
pub struct SphereContact {
    pub name: String,
    pub sphere: BodySphere,
    pub other: Obstacle,
    pub friction: f64,
    /// Friction of drilling or rolling.
    pub turns: bool,
}

impl SphereContact {
    /// Its spheres with their names.
    pub fn spheres(&self) -> impl Iterator<Item = (String, &BodySphere)> {
        let other = match &self.other {
            Obstacle::Plane { .. } => None,
            Obstacle::Sphere(sphere) => Some((format!("{}_other", self.name), sphere)),
        };
        std::iter::once((self.name.clone(), &self.sphere)).chain(other)
    }
}

/// A point that two bodies share, or one body and what stands still.
#[derive(Clone, Debug)]
pub struct Closure {
    pub bodies: [Option<usize>; 2],
    /// From O, in the axes of each body.
    pub points: [[f64; 3]; 2],
}

/// All of it.
#[derive(Clone, Debug, Default)]
pub struct Parts {
    /// Attributes of each joint of the tree.
    pub joints: Vec<JointAttributes>,
    pub tendons: Vec<Tendon>,
    pub motors: Vec<Motor>,
    pub contacts: Vec<SphereContact>,
    pub closures: Vec<Closure>,
    /// Elements of the loads that do more than damp single joints and take inputs.
    pub loads: Vec<String>,
    /// Contacts that are ranges or dry friction of single joints.
    pub stops: Vec<String>,
    /// Sentences about what is left out of the document, or is another thing in it.
    pub lost: Vec<String>,
    /// Sentences about motions and masses without a counterpart.
    pub mistakes: Vec<String>,
    /// Sentences about loads and contacts without a counterpart in MJCF.
    pub acting: Vec<String>,
}

impl Motor {
    /// The only joint along which it acts, a scalar, with the force by its input.
    pub fn joint(&self) -> Option<(usize, f64)> {
        match &self.on {
            Transmission::Joint { variable, gear } if gear.len() == 1 => Some((*variable, gear[0])),
            _ => None,
        }
    }
}
