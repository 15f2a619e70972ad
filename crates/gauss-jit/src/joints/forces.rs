//! Loads, element by element: weight, springs and dampers that are linear in rates and coordinates of joints, and
//! forces that are proportional to inputs. Each is known by its generalised forces; whatever they are not is refused.

use std::ops::Range;

use gauss_codegen::LinkKind;
use gauss_runtime::nalgebra::{DMatrix, DVector, Matrix6};

use super::masses::{STATES, jacobian};
use super::motions::{Motion, ROUNDING};
use super::numbers::{MassData, SceneNumbers, Sequence, Value, Variable, VariableKind, are_small, shortest};
use super::parts::{Motor, Parts, Tendon, Transmission};
use super::tree::JointTree;

/// The name of weight among the elements.
const GRAVITY: &str = "gravity";

/// Sizes of coordinates, rates and inputs at which a law is tried: what is clamped, or wraps around, is so somewhere.
const SCALES: [f64; STATES] = [1.0, 30.0, 1e3, 1e6];

/// A force that is linear: `constant − stiffness q − damping q̇`, with those q that are scalars.
struct Linear {
    constant: DVector<f64>,
    stiffness: DMatrix<f64>,
    damping: DMatrix<f64>,
}

/// Reads elements of the loads.
pub struct Forces<'a> {
    scene: &'a SceneNumbers,
    tree: &'a JointTree,
    parts: &'a mut Parts,
    /// Elements that are no linear laws, by their columns.
    others: Vec<usize>,
}

impl<'a> Forces<'a> {
    pub fn new(scene: &'a SceneNumbers, tree: &'a JointTree, parts: &'a mut Parts) -> Self {
        Self { scene, tree, parts, others: Vec::new() }
    }

    pub fn add(mut self, masses: &[MassData]) {
        let elements = self.scene.bodies.elements.clone();
        for (column, name) in elements.iter().enumerate() {
            if name == GRAVITY {
                self.refuse_other_weight(column, masses);
            } else {
                self.element(column, name);
            }
        }
        if !self.others.is_empty() {
            self.parts.acting.push(format!(
                "{}: no sum of springs and dampers that are linear in coordinates of joints, and of forces that are \
                 proportional to inputs",
                self.others.iter().map(|&column| format!("`{}`", elements[column])).collect::<Vec<_>>().join(", ")
            ));
        }
        (0..self.scene.inputs.len()).for_each(|k| self.input(k));
    }

    /// Forces of an element.
    fn force(
        &self,
        column: usize,
        (t, values): (f64, &[Value]),
        rates: &[f64],
        inputs: &[f64],
    ) -> Option<DVector<f64>> {
        let all = self.scene.forces(t, values, rates, inputs)?;
        Some(all.column(column).into_owned())
    }

    fn still(&self) -> [Vec<f64>; 2] {
        [vec![0.0; self.scene.rates()], vec![0.0; self.scene.inputs.len()]]
    }

    /// Weight is that of the masses alone, without buoyancy.
    fn refuse_other_weight(&mut self, column: usize, masses: &[MassData]) {
        let mut sequence = Sequence::new();
        let g = self.scene.gravity();
        let [rates, inputs] = self.still();
        for _ in 0..STATES {
            let values = self.scene.sample(&mut sequence);
            let mut sum = DVector::zeros(self.scene.rates());
            let mut size = 0.0;
            for (body, own) in masses.iter().enumerate() {
                let place = self.tree.place(body, &values);
                let columns = jacobian(self.tree, body, &values, self.scene);
                let force = g * own.mass;
                let torque = (place.rotation * own.center).cross(&force);
                let wrench = DVector::from_iterator(6, force.iter().chain(torque.iter()).copied());
                let added: DVector<f64> = columns.transpose() * wrench;
                size += added.amax();
                sum += added;
            }
            let given = self.force(column, (0.0, &values), &rates, &inputs);
            if !given.is_some_and(|given| are_small((given - sum).iter(), ROUNDING * (1.0 + size))) {
                self.parts.acting.push("weight is not that of the masses alone (`displaced_mass`)".to_owned());
                return;
            }
        }
    }

    fn element(&mut self, column: usize, name: &str) {
        match self.linear(column) {
            Some(Linear { constant, stiffness, damping }) => {
                let is_spring = [constant.amax(), stiffness.amax()] != [0.0; 2];
                let (joints, tendons) = (self.parts.joints.clone(), self.parts.tendons.len());
                let found = self.springs(name, constant, stiffness) && self.dampers(name, damping.clone());
                let groups = self.scene.variables.iter().filter(|own| !own.is_scalar());
                let on_others = groups.flat_map(Variable::rates).any(|k| damping[(k, k)] != 0.0);
                if !found || is_spring || on_others || self.parts.tendons.len() > tendons {
                    self.parts.loads.push(name.to_owned());
                }
                if !found {
                    // All of it or nothing.
                    self.parts.joints = joints;
                    self.parts.tendons.truncate(tendons);
                    self.parts.acting.push(format!(
                        "`{name}`: a constant force, a law that gives energy, or one that differs among the axes of \
                         a ball or of a pose, is none of joints and tendons"
                    ));
                }
            }
            None => {
                self.parts.loads.push(name.to_owned());
                self.others.push(column);
            }
        }
    }

    /// The linear law of an element without its inputs, if it is one.
    fn linear(&self, column: usize) -> Option<Linear> {
        let (count, origin) = (self.scene.rates(), self.scene.origin());
        let [rates, inputs] = self.still();
        let constant = self.force(column, (0.0, &origin), &rates, &inputs)?;
        let (mut stiffness, mut damping) = (DMatrix::zeros(count, count), DMatrix::zeros(count, count));
        for (k, own) in self.scene.variables.iter().enumerate().filter(|(_, own)| own.is_scalar()) {
            let mut values = origin.clone();
            values[k] = Value::Scalar(1.0);
            stiffness.set_column(own.rate, &(&constant - self.force(column, (0.0, &values), &rates, &inputs)?));
        }
        for k in 0..count {
            let mut rates = rates.clone();
            rates[k] = 1.0;
            damping.set_column(k, &(&constant - self.force(column, (0.0, &origin), &rates, &inputs)?));
        }
        let mut linear = Linear { constant, stiffness, damping };
        let size = linear.constant.amax() + linear.stiffness.amax() + linear.damping.amax();
        let mut sequence = Sequence::new();
        for (k, scale) in SCALES.into_iter().enumerate() {
            let mut values = self.scene.sample(&mut sequence);
            let scaled = |list: Vec<f64>| list.into_iter().map(|x| scale * x).collect::<Vec<f64>>();
            let (rates, inputs) = (scaled(sequence.list(count)), scaled(sequence.list(inputs.len())));
            let mut q = DVector::zeros(count);
            for (own, value) in self.scene.variables.iter().zip(&mut values) {
                if let Value::Scalar(x) = value {
                    *x *= scale;
                    q[own.rate] = *x;
                }
            }
            let law = &linear.constant - &linear.stiffness * q - &linear.damping * DVector::from_column_slice(&rates);
            let gains = self.gains(column, &values)?;
            let law = law + gains * DVector::from_column_slice(&inputs);
            let given = self.force(column, (0.4 * k as f64, &values), &rates, &inputs)?;
            if !are_small((&given - law).iter(), 100.0 * ROUNDING * (scale * size + given.amax())) {
                return None;
            }
        }
        // What rounding leaves of differences.
        let clean = |x: &mut f64| *x = if x.abs() <= ROUNDING * size { 0.0 } else { *x };
        linear.stiffness.iter_mut().chain(linear.damping.iter_mut()).chain(linear.constant.iter_mut()).for_each(clean);
        Some(linear)
    }

    /// Forces by inputs, at rest.
    fn gains(&self, column: usize, values: &[Value]) -> Option<DMatrix<f64>> {
        let [rates, inputs] = self.still();
        let rest = self.force(column, (0.0, values), &rates, &inputs)?;
        let mut gains = DMatrix::zeros(rates.len(), inputs.len());
        for k in 0..inputs.len() {
            let mut inputs = inputs.clone();
            inputs[k] = 1.0;
            gains.set_column(k, &(self.force(column, (0.0, values), &rates, &inputs)? - &rest));
        }
        Some(gains)
    }

    /// Adds `constant − stiffness q` to joints, or as tendons; false where no springs are that.
    fn springs(&mut self, name: &str, mut constant: DVector<f64>, stiffness: DMatrix<f64>) -> bool {
        let Some(squares) = squares(&stiffness) else { return false };
        let size = constant.amax();
        for (row, value) in squares {
            let Some(coefficients) = self.places_of(&row) else { return false };
            let length = constant[row.iamax()] / (value * row.amax());
            constant -= &row * (value * length);
            if let [(joint, _)] = coefficients[..] {
                self.parts.joints[joint].stiffness += value;
                self.parts.joints[joint].force += value * length;
                continue;
            }
            // A length of −1 is MuJoCo's word for that at 0.
            let sign = if length < 0.0 { -1.0 } else { 1.0 };
            let coefficients = coefficients.into_iter().map(|(k, x)| (k, sign * x)).collect();
            let name = self.name_of_tendon(name);
            self.parts.tendons.push(Tendon {
                name,
                coefficients,
                stiffness: value,
                length: sign * length,
                damping: 0.0,
            });
        }
        are_small(constant.iter(), ROUNDING * size)
    }

    /// Adds `−damping q̇`; false where no dampers are that.
    fn dampers(&mut self, name: &str, damping: DMatrix<f64>) -> bool {
        let Some(squares) = squares(&damping) else { return false };
        let mut diagonal = DVector::zeros(damping.nrows());
        for (row, value) in squares {
            if row.iter().filter(|x| **x != 0.0).count() == 1 {
                diagonal[row.iamax()] = value;
                continue;
            }
            let (Some(coefficients), name) = (self.places_of(&row), self.name_of_tendon(name)) else { return false };
            self.parts.tendons.push(Tendon { name, coefficients, damping: value, ..Tendon::default() });
        }
        for (joint, own) in self.scene.variables.iter().enumerate() {
            let values: Vec<f64> = own.rates().map(|k| diagonal[k]).collect();
            if values.iter().any(|value| (value - values[0]).abs() > ROUNDING * damping.amax()) {
                return false;
            }
            self.parts.joints[joint].damping += values[0];
        }
        true
    }

    /// The name of a tendon of an element: numbered from the second on.
    fn name_of_tendon(&self, name: &str) -> String {
        let taken = |word: &str| self.parts.tendons.iter().any(|own| own.name == word);
        let numbered = (2..).map(|k| format!("{name}_{k}"));
        std::iter::once(name.to_owned()).chain(numbered).find(|word| !taken(word)).unwrap_or_default()
    }

    /// The variables of a row that are scalars, with its entries; `None` where others are among them.
    fn places_of(&self, row: &DVector<f64>) -> Option<Vec<(usize, f64)>> {
        let mut list = Vec::new();
        for (k, own) in self.scene.variables.iter().enumerate() {
            if own.is_scalar() {
                list.extend(Some((k, row[own.rate])).filter(|(_, x)| *x != 0.0));
            } else if own.rates().any(|place| row[place] != 0.0) {
                return None;
            }
        }
        Some(list)
    }

    /// An input as the control of a motor.
    fn input(&mut self, k: usize) {
        let name = self.scene.inputs[k].clone();
        let elements = (0..self.scene.bodies.elements.len()).collect::<Vec<_>>();
        let gain = |values: &[Value]| {
            let all = elements.iter().map(|column| Some(self.gains(*column, values)?.column(k).into_owned()));
            all.collect::<Option<Vec<_>>>()?.into_iter().reduce(|sum, own| sum + own)
        };
        let mut sequence = Sequence::new();
        let states: Vec<Vec<Value>> =
            std::iter::once(self.scene.origin()).chain((0..STATES).map(|_| self.scene.sample(&mut sequence))).collect();
        let Some(gains) = states.iter().map(|values| gain(values)).collect::<Option<Vec<_>>>() else { return };
        let size = gains.iter().map(|own| own.amax()).fold(0.0, f64::max);
        // An element that is no linear law may be none in this input.
        let own = |column: &usize| self.gains(*column, &states[1]).is_none_or(|gains| gains.column(k).amax() > 0.0);
        if self.others.iter().any(own) {
            return;
        }
        if size == 0.0 {
            self.parts.lost.push(format!("the input `{name}` moves nothing"));
            return;
        }
        let mut first = gains[0].clone();
        first.iter_mut().filter(|x| x.abs() <= ROUNDING * size).for_each(|x| *x = 0.0);
        let is_constant = gains.iter().all(|own| are_small((own - &first).iter(), 10.0 * ROUNDING * size));
        let on = if is_constant { self.along_joints(&name, &first) } else { self.at_body(&states, &gains, size) };
        match on {
            Some(on) => self.parts.motors.push(Motor { name, on }),
            None => self.parts.acting.push(format!(
                "the input `{name}` is neither a force along joints nor a wrench at one body in its axes"
            )),
        }
    }

    /// A constant generalised force by a joint, or by a tendon.
    fn along_joints(&mut self, name: &str, gain: &DVector<f64>) -> Option<Transmission> {
        if let Some(coefficients) = self.places_of(gain) {
            if let [(variable, gear)] = coefficients[..] {
                return Some(Transmission::Joint { variable, gear: vec![gear] });
            }
            let name = self.name_of_tendon(name);
            self.parts.tendons.push(Tendon { name: name.clone(), coefficients, ..Tendon::default() });
            return Some(Transmission::Tendon { name });
        }
        let range = |k: usize| -> Range<usize> { self.scene.variables[k].rates() };
        let moved = |k: &usize| range(*k).any(|place| gain[place] != 0.0);
        let moved: Vec<usize> = (0..self.scene.variables.len()).filter(moved).collect();
        let [variable] = moved[..] else { return None };
        let mut gear: Vec<f64> = range(variable).map(|place| gain[place]).collect();
        if let (VariableKind::Pose, Motion::Free(axes)) =
            (self.scene.variables[variable].kind, &self.tree.joints[variable].motion)
        {
            let turned = axes.rotation * gauss_runtime::nalgebra::Vector3::from_column_slice(&gear[..3]);
            gear[..3].copy_from_slice(turned.as_slice());
        }
        Some(Transmission::Joint { variable, gear })
    }

    /// A wrench at the O of one body that is constant in its axes.
    fn at_body(&self, states: &[Vec<Value>], gains: &[DVector<f64>], size: f64) -> Option<Transmission> {
        let count = self.scene.rates();
        let fits = |body: usize| {
            let (mut rows, mut given) = (DMatrix::zeros(count * states.len(), 6), DVector::zeros(count * states.len()));
            for (k, (values, gain)) in states.iter().zip(gains).enumerate() {
                let place = self.tree.place(body, values);
                let turn = place.rotation.to_rotation_matrix();
                let mut turns = Matrix6::zeros();
                turns.fixed_view_mut::<3, 3>(0, 0).copy_from(turn.matrix());
                turns.fixed_view_mut::<3, 3>(3, 3).copy_from(turn.matrix());
                let own = jacobian(self.tree, body, values, self.scene).transpose() * turns;
                rows.view_mut((k * count, 0), (count, 6)).copy_from(&own);
                given.rows_mut(k * count, count).copy_from(gain);
            }
            let wrench = rows.clone().svd(true, true).solve(&given, ROUNDING).ok()?;
            let rest = &rows * &wrench - &given;
            let clean = |x: &f64| shortest(*x, 1e-14 * size.max(wrench.amax()));
            are_small(rest.iter(), 100.0 * ROUNDING * size).then(|| wrench.iter().map(clean).collect::<Vec<f64>>())
        };
        let rigid = (0..self.tree.places.len()).filter(|&body| self.scene.bodies.list[body].kind != LinkKind::Particle);
        let found = rigid.filter(|&body| self.tree.carriers[body].is_some()).find_map(|body| Some((body, fits(body)?)));
        found.map(|(body, gear)| Transmission::Site { body, gear })
    }
}

/// A symmetric matrix without a negative eigenvalue as a sum of squares of rows, each with its factor, the first entry
/// of each row 1; `None` of another one.
fn squares(matrix: &DMatrix<f64>) -> Option<Vec<(DVector<f64>, f64)>> {
    let (mut rest, size) = (matrix.clone(), matrix.amax());
    let mut list = Vec::new();
    if !are_small((matrix - matrix.transpose()).iter(), ROUNDING * size) {
        return None;
    }
    for k in 0..rest.nrows() {
        let (pivot, column) = (rest[(k, k)], rest.column(k).into_owned());
        if pivot > 10.0 * ROUNDING * size {
            let mut row = column / pivot;
            row.iter_mut().filter(|x| x.abs() <= ROUNDING).for_each(|x| *x = 0.0);
            rest -= &row * row.transpose() * pivot;
            list.push((row, pivot));
        } else if column.amax() > 100.0 * ROUNDING * size {
            return None;
        }
    }
    Some(list)
}
