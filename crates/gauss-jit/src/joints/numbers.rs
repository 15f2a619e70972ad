//! A scene by its numbers: poses of bodies, mass matrix and forces where joints have given values.
//!
//! Coordinates are those of joints: scalars, rotations and poses; rates are theirs as MuJoCo has them, of a rotation ω
//! in the axes that turn, of a pose ḃ in axes that stand still, then ω.

use std::ops::Range;

use gauss_codegen::description::QuantityKind;
use gauss_codegen::{Bodies, LinkKind};
use gauss_runtime::nalgebra::{DMatrix, DVector, Isometry3, Matrix3, Rotation3, Translation3, UnitQuaternion, Vector3};

use crate::backends::{Compiled, interpreted};
use crate::kernel::Kernel;

/// A coordinate that a joint has.
#[derive(Clone, Debug)]
pub struct Variable {
    pub name: String,
    pub kind: VariableKind,
    /// Its first component in a configuration, and its first rate among those of joints.
    component: usize,
    pub rate: usize,
}

/// The kind of a coordinate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum VariableKind {
    Scalar,
    /// An angle by its cosine and sine.
    Angle,
    Rotation,
    Pose,
}

impl Variable {
    /// Places of its rates.
    pub fn rates(&self) -> Range<usize> {
        let count = match self.kind {
            VariableKind::Scalar | VariableKind::Angle => 1,
            VariableKind::Rotation => 3,
            VariableKind::Pose => 6,
        };
        self.rate..self.rate + count
    }

    pub fn is_scalar(&self) -> bool {
        matches!(self.kind, VariableKind::Scalar | VariableKind::Angle)
    }
}

/// The value of a coordinate.
#[derive(Clone, Copy, Debug)]
pub enum Value {
    Scalar(f64),
    Rotation(UnitQuaternion<f64>),
    Pose(Isometry3<f64>),
}

impl Value {
    pub fn scalar(self) -> f64 {
        match self {
            Value::Scalar(value) => value,
            Value::Rotation(_) | Value::Pose(_) => 0.0,
        }
    }
}

/// Mass data: about the centre of mass, in the axes of the body.
#[derive(Clone, Copy, Debug)]
pub struct MassData {
    pub mass: f64,
    pub center: Vector3<f64>,
    pub inertia: Matrix3<f64>,
}

/// A kernel with the bodies of its scene.
pub struct SceneNumbers {
    pub kernel: Kernel,
    pub bodies: Bodies,
    parameters: Vec<f64>,
    pub variables: Vec<Variable>,
    components: usize,
    pub inputs: Vec<String>,
}

/// Whether all are at most so far from 0; what is no number is not.
pub fn are_small<'a>(entries: impl IntoIterator<Item = &'a f64>, bound: f64) -> bool {
    entries.into_iter().all(|x| x.abs() <= bound)
}

/// The decimal with the fewest digits within an error.
pub fn shortest(x: f64, error: f64) -> f64 {
    if x.abs() <= error {
        return 0.0;
    }
    let rounded = (1..17).filter_map(|digits| format!("{x:.digits$e}", digits = digits - 1).parse::<f64>().ok());
    rounded.into_iter().find(|near| (near - x).abs() <= error).unwrap_or(x)
}

/// Pseudo-random numbers, the same each time.
pub struct Sequence(u64);

impl Sequence {
    pub fn new() -> Self {
        Self(0x9e37_79b9_7f4a_7c15)
    }

    /// Between −1 and 1.
    pub fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64 * 2.0 - 1.0
    }

    pub fn list(&mut self, count: usize) -> Vec<f64> {
        (0..count).map(|_| self.next()).collect()
    }

    fn rotation(&mut self) -> UnitQuaternion<f64> {
        UnitQuaternion::from_scaled_axis(Vector3::from_fn(|_, _| 1.3 * self.next()))
    }

    pub fn value(&mut self, kind: VariableKind) -> Value {
        match kind {
            VariableKind::Scalar | VariableKind::Angle => Value::Scalar(1.3 * self.next()),
            VariableKind::Rotation => Value::Rotation(self.rotation()),
            VariableKind::Pose => {
                let position = Vector3::from_fn(|_, _| self.next());
                Value::Pose(Isometry3::from_parts(position.into(), self.rotation()))
            }
        }
    }
}

/// Coordinates in the order of a configuration: groups, then scalars.
fn variables(kernel: &Kernel) -> (Vec<Variable>, usize) {
    let (mut list, mut component, mut rate) = (Vec::new(), 0, 0);
    let mut add = |name: String, kind: VariableKind, component: usize| {
        list.push(Variable { name, kind, component, rate });
        rate = list.last().map_or(0, |own| own.rates().end);
    };
    let coordinates = &kernel.model().description().coordinates;
    for own in coordinates {
        match own.kind {
            QuantityKind::Rotation => add(own.name.clone(), VariableKind::Rotation, component),
            QuantityKind::Pose => add(own.name.clone(), VariableKind::Pose, component),
            QuantityKind::Plane => {
                add(format!("{}_x", own.name), VariableKind::Scalar, component + 2);
                add(format!("{}_y", own.name), VariableKind::Scalar, component + 3);
                add(format!("{}_angle", own.name), VariableKind::Angle, component);
            }
            QuantityKind::Scalar | QuantityKind::Vector(_) => continue,
        }
        component += match own.kind {
            QuantityKind::Pose => 7,
            _ => 4,
        };
    }
    let is_plain = |kind| matches!(kind, QuantityKind::Scalar | QuantityKind::Vector(_));
    for name in coordinates.iter().filter(|own| is_plain(own.kind)).flat_map(|own| &own.numbers) {
        add(name.clone(), VariableKind::Scalar, component);
        component += 1;
    }
    (list, component)
}

impl SceneNumbers {
    pub fn new(kernel: Kernel, bodies: Bodies, parameters: Vec<f64>) -> Self {
        let (variables, components) = variables(&kernel);
        let inputs = kernel.model().description().inputs.iter().flat_map(|own| own.numbers.clone()).collect();
        let mut scene = Self { kernel, bodies, parameters, variables, components, inputs };
        // Bodies of files that stand between joints have no mass.
        let masses = scene.masses();
        for (own, data) in scene.bodies.list.iter_mut().zip(masses) {
            if data.mass == 0.0 && data.inertia.iter().all(|x| *x == 0.0) {
                own.kind = LinkKind::Frame;
            }
        }
        scene
    }

    /// Count of the rates of joints.
    pub fn rates(&self) -> usize {
        self.variables.last().map_or(0, |own| own.rates().end)
    }

    /// Values where all joints are at 0.
    pub fn origin(&self) -> Vec<Value> {
        let zero = |own: &Variable| match own.kind {
            VariableKind::Scalar | VariableKind::Angle => Value::Scalar(0.0),
            VariableKind::Rotation => Value::Rotation(UnitQuaternion::identity()),
            VariableKind::Pose => Value::Pose(Isometry3::identity()),
        };
        self.variables.iter().map(zero).collect()
    }

    pub fn sample(&self, sequence: &mut Sequence) -> Vec<Value> {
        self.variables.iter().map(|own| sequence.value(own.kind)).collect()
    }

    /// The configuration of the kernel.
    pub fn configuration(&self, values: &[Value]) -> Vec<f64> {
        let mut q = vec![0.0; self.components];
        for (own, value) in self.variables.iter().zip(values) {
            let to = &mut q[own.component..];
            match value {
                Value::Scalar(angle) if own.kind == VariableKind::Angle => (to[0], to[1]) = (angle.cos(), angle.sin()),
                Value::Scalar(x) => to[0] = *x,
                Value::Rotation(turn) => to[..4].copy_from_slice(turn.coords.as_slice()),
                Value::Pose(pose) => {
                    to[..4].copy_from_slice(pose.rotation.coords.as_slice());
                    to[4..7].copy_from_slice(pose.translation.vector.as_slice());
                }
            }
        }
        q
    }

    /// Numbers of the program of the bodies.
    fn evaluated(&self, t: f64, values: &[Value]) -> Vec<f64> {
        let program = &self.bodies.program;
        let mut numbers = vec![0.0; program.code.outputs.len()];
        let q = self.configuration(values);
        interpreted(program, &self.kernel.model().derived.tables).run(&[&self.parameters, &[t], &q], &mut numbers);
        numbers
    }

    /// The acceleration of free fall.
    pub fn gravity(&self) -> Vector3<f64> {
        Vector3::from_column_slice(&self.evaluated(0.0, &self.origin())[..3])
    }

    /// Places of all bodies.
    pub fn poses(&self, t: f64, values: &[Value]) -> Vec<Isometry3<f64>> {
        let numbers = self.evaluated(t, values);
        let pose = |own: &[f64]| {
            let rotation = Rotation3::from_matrix_unchecked(Matrix3::from_row_slice(&own[3..12]));
            let translation = Translation3::new(own[0], own[1], own[2]);
            Isometry3::from_parts(translation, UnitQuaternion::from_rotation_matrix(&rotation))
        };
        numbers[3..].chunks(Bodies::NUMBERS).map(pose).collect()
    }

    /// Mass data of all bodies.
    pub fn masses(&self) -> Vec<MassData> {
        let numbers = self.evaluated(0.0, &self.origin());
        let all = numbers[3..].chunks(Bodies::NUMBERS).zip(&self.bodies.list);
        let data = |(own, link): (&[f64], &gauss_codegen::LinkData)| {
            let (mass, center) = (own[12], Vector3::from_column_slice(&own[13..16]));
            let given = Matrix3::from_row_slice(&own[16..25]);
            let is_about_o = link.kind == LinkKind::Rigid { central: false };
            let lever = mass * (Matrix3::identity() * center.norm_squared() - center * center.transpose());
            MassData { mass, center, inertia: if is_about_o { given - lever } else { given } }
        };
        all.map(data).collect()
    }

    /// Rates of joints by the speeds of the scene.
    pub fn rates_by_speeds(&self, values: &[Value]) -> DMatrix<f64> {
        let speeds = self.kernel.model().description().speeds.iter().map(|own| own.numbers.len()).sum();
        let q = self.configuration(values);
        let increments = |z: &[f64]| self.kernel.call("kinematics", &[&[0.0], &q, z]).unwrap_or_default();
        let mut matrix = DMatrix::zeros(self.rates(), speeds);
        let rest = increments(&vec![0.0; speeds]);
        for k in 0..speeds {
            let mut z = vec![0.0; speeds];
            z[k] = 1.0;
            let column: Vec<f64> = increments(&z).iter().zip(&rest).map(|(moved, rest)| moved - rest).collect();
            matrix.set_column(k, &self.rates_of_increment(values, &column));
        }
        matrix
    }

    /// Whether something moves while all speeds are 0.
    pub fn drifts(&self, values: &[Value]) -> bool {
        let speeds: usize = self.kernel.model().description().speeds.iter().map(|own| own.numbers.len()).sum();
        let lists: [&[f64]; 3] = [&[0.3], &self.configuration(values), &vec![0.0; speeds]];
        !self.kernel.call("kinematics", &lists).is_ok_and(|rest| rest.iter().all(|x| *x == 0.0))
    }

    /// The inverse of that; `None` where the speeds are not as many as the rates, or do not determine them.
    fn speeds_by_rates(&self, values: &[Value]) -> Option<DMatrix<f64>> {
        Some(self.rates_by_speeds(values)).filter(DMatrix::is_square)?.try_inverse()
    }

    /// Rates of joints by an increment that is seen from the body.
    fn rates_of_increment(&self, values: &[Value], increment: &[f64]) -> DVector<f64> {
        let mut rates = DVector::from_column_slice(increment);
        for (own, value) in self.variables.iter().zip(values) {
            let places = own.rates();
            match value {
                Value::Pose(pose) => {
                    let turned = pose.rotation * Vector3::from_column_slice(&increment[places.start..places.start + 3]);
                    rates.rows_mut(places.start, 3).copy_from(&turned);
                }
                // The velocity of a pose in the plane, whose two places stand before.
                Value::Scalar(angle) if own.kind == VariableKind::Angle => {
                    let (x, y) = (increment[own.rate - 2], increment[own.rate - 1]);
                    rates[own.rate - 2] = angle.cos() * x - angle.sin() * y;
                    rates[own.rate - 1] = angle.sin() * x + angle.cos() * y;
                }
                _ => {}
            }
        }
        rates
    }

    /// The mass matrix in rates of joints.
    pub fn mass_matrix(&self, values: &[Value]) -> Option<DMatrix<f64>> {
        let inverse = self.speeds_by_rates(values)?;
        let q = self.configuration(values);
        let own = self.kernel.mass_matrix(0.0, &q).ok()?;
        let own = DMatrix::from_row_slice(inverse.nrows(), inverse.nrows(), &own);
        Some(inverse.transpose() * own * inverse)
    }

    /// Generalised forces on the joints, a column for each element of the loads, at rates of the joints.
    pub fn forces(&self, t: f64, values: &[Value], rates: &[f64], inputs: &[f64]) -> Option<DMatrix<f64>> {
        let inverse = self.speeds_by_rates(values)?;
        let z = &inverse * DVector::from_column_slice(rates);
        let q = self.configuration(values);
        let arguments = self.kernel.model().arguments("element_forces").ok()?;
        let (time, all) = ([t], [&q[..], z.as_slice(), inputs]);
        let lists: Vec<&[f64]> = [&time[..]].into_iter().chain(all).take(arguments.len()).collect();
        let own = self.kernel.call("element_forces", &lists).ok()?;
        Some(inverse.transpose() * DMatrix::from_row_slice(inverse.nrows(), own.len() / inverse.nrows(), &own))
    }

    /// Generalised forces of unit contact forces, a column for each row of the contacts.
    pub fn contact_forces(&self, values: &[Value]) -> Option<DMatrix<f64>> {
        let inverse = self.speeds_by_rates(values)?;
        let own = self.kernel.call("contact_jacobian", &[&[0.0], &self.configuration(values)]).ok()?;
        Some(inverse.transpose() * DMatrix::from_row_slice(inverse.nrows(), own.len() / inverse.nrows(), &own))
    }
}
