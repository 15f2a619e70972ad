//! The tree of joints that a scene moves by, found from the places of its bodies.
//!
//! A pose is that of such a tree where it is a product of motions, one for each coordinate:
//! `T(q) = E₁(q₁) … E_k(q_k) M`, each a turn about a line, a shift along a direction, a turn about a point, or a pose.
//! Motions are seen where all other coordinates are 0; that their product is the pose is then tried at states of
//! general position.

use gauss_codegen::LinkKind;
use gauss_runtime::nalgebra::{Isometry3, Matrix3, Rotation3, Translation3, UnitQuaternion, Vector3};

use super::numbers::{SceneNumbers, Sequence, Value, VariableKind, are_small};

/// Differences that rounding makes, of numbers of the size 1: some thousand roundings. What is no tree differs by much
/// more at a state of general position.
pub const ROUNDING: f64 = 1e-11;

/// Motion of what hangs on a joint, seen from Ω where all joints are at 0.
#[derive(Clone, Copy, Debug)]
pub enum Motion {
    Hinge {
        axis: Vector3<f64>,
        anchor: Vector3<f64>,
    },
    Slide {
        axis: Vector3<f64>,
    },
    /// A ball joint about the origin of these axes, in them.
    Ball(Isometry3<f64>),
    /// A free joint with these axes.
    Free(Isometry3<f64>),
}

/// The joints of a scene: each coordinate moves what hangs on it, on what those above it have moved.
pub struct JointTree {
    /// The motion by each variable.
    pub motions: Vec<Motion>,
    pub parents: Vec<Option<usize>>,
    /// The last variable that moves each body.
    pub carriers: Vec<Option<usize>>,
    /// Places of the bodies at 0.
    pub places: Vec<Isometry3<f64>>,
}

impl Motion {
    /// The displacement of what it carries.
    pub fn displacement(&self, value: Value) -> Isometry3<f64> {
        match (self, value) {
            (Motion::Hinge { axis, anchor }, Value::Scalar(angle)) => {
                let turn = UnitQuaternion::from_scaled_axis(axis * angle);
                Isometry3::from_parts((anchor - turn * anchor).into(), turn)
            }
            (Motion::Slide { axis }, Value::Scalar(x)) => Translation3::from(axis * x).into(),
            (Motion::Ball(axes), Value::Rotation(turn)) => axes * turn * axes.inverse(),
            (Motion::Free(axes), Value::Pose(pose)) => axes * pose * axes.inverse(),
            // No motion has a value of another kind.
            _ => Isometry3::identity(),
        }
    }
}

impl JointTree {
    /// Finds the joints.
    ///
    /// # Errors
    /// Each body that no tree of joints moves, or each coordinate that is none of a joint, in a sentence.
    pub fn of(scene: &SceneNumbers) -> Result<Self, Vec<String>> {
        Finder::new(scene).tree()
    }

    /// The variables on the way to one, it included, from the root.
    pub fn way(&self, variable: Option<usize>) -> Vec<usize> {
        let mut way: Vec<usize> = std::iter::successors(variable, |&k| self.parents[k]).collect();
        way.reverse();
        way
    }

    /// The displacement of what a variable carries.
    pub fn displacement(&self, variable: Option<usize>, values: &[Value]) -> Isometry3<f64> {
        let way = self.way(variable).into_iter();
        way.fold(Isometry3::identity(), |moved, k| moved * self.motions[k].displacement(values[k]))
    }
}

struct Finder<'a> {
    scene: &'a SceneNumbers,
    origin: Vec<Value>,
    places: Vec<Isometry3<f64>>,
    /// Bodies that each variable moves.
    moved: Vec<Vec<usize>>,
}

/// Whether two places are one to rounding: of particles their positions alone.
fn is_same(kind: LinkKind, a: &Isometry3<f64>, b: &Isometry3<f64>) -> bool {
    let size = 1.0 + a.translation.vector.norm() + b.translation.vector.norm();
    let positions = (a.translation.vector - b.translation.vector).norm() <= ROUNDING * size;
    let turned = (a.rotation.to_rotation_matrix().matrix() - b.rotation.to_rotation_matrix().matrix()).norm();
    positions && (kind == LinkKind::Particle || turned <= ROUNDING)
}

/// A number without what rounding added to 0 and to ±1.
fn snapped(x: f64) -> f64 {
    let near = x.round();
    if near.abs() <= 1.0 && (x - near).abs() < 4e-16 { near + 0.0 } else { x }
}

impl<'a> Finder<'a> {
    fn new(scene: &'a SceneNumbers) -> Self {
        let origin = scene.origin();
        let places = scene.poses(0.0, &origin);
        let mut sequence = Sequence::new();
        let base = scene.sample(&mut sequence);
        let before = scene.poses(0.0, &base);
        let moved_by = |k: usize| {
            let mut values = base.clone();
            values[k] = sequence.value(scene.variables[k].kind);
            let after = scene.poses(0.0, &values);
            let list = scene.bodies.list.iter().zip(before.iter().zip(&after)).enumerate();
            list.filter(|(_, (own, (a, b)))| !is_same(own.kind, a, b)).map(|(body, _)| body).collect()
        };
        let moved = (0..scene.variables.len()).map(moved_by).collect();
        Self { scene, origin, places, moved }
    }

    fn tree(self) -> Result<JointTree, Vec<String>> {
        let found: Vec<_> = (0..self.scene.variables.len()).map(|k| self.motion(k)).collect();
        let mistakes: Vec<String> = found.iter().filter_map(|own| own.clone().err()).collect();
        if !mistakes.is_empty() {
            return Err(mistakes);
        }
        let motions: Vec<Motion> = found.into_iter().flatten().collect();
        let order = self.order(&motions)?;
        let mut parents = vec![None; motions.len()];
        for (place, &k) in order.iter().enumerate() {
            let above = order[..place].iter().rev();
            parents[k] = above.copied().find(|&j| self.moved[k].iter().all(|body| self.moved[j].contains(body)));
        }
        let bodies = 0..self.places.len();
        let carriers =
            bodies.map(|body| order.iter().rev().copied().find(|&k| self.moved[k].contains(&body))).collect();
        let tree = JointTree { motions, parents, carriers, places: self.places.clone() };
        self.refuse_other_poses(&tree)?;
        Ok(tree)
    }

    /// Variables with those above first.
    fn order(&self, motions: &[Motion]) -> Result<Vec<usize>, Vec<String>> {
        let count = motions.len();
        let holds = |k: usize, j: usize| self.moved[j].iter().all(|body| self.moved[k].contains(body));
        let mut mistakes = Vec::new();
        for (k, j) in (0..count).flat_map(|k| (0..k).map(move |j| (k, j))) {
            if self.moved[k].iter().any(|body| self.moved[j].contains(body)) && !holds(k, j) && !holds(j, k) {
                let [a, b] = [k, j].map(|k| &self.scene.variables[k].name);
                mistakes
                    .push(format!("`{b}` and `{a}` move one body together and others apart: no tree of joints does"));
            }
        }
        // Whether k must come before j.
        let before = |k: usize, j: usize| match (holds(k, j), holds(j, k)) {
            (true, false) => true,
            (true, true) => !self.is_product(motions, j, k) && self.is_product(motions, k, j),
            _ => false,
        };
        let (mut order, mut rest) = (Vec::new(), (0..count).collect::<Vec<usize>>());
        while !rest.is_empty() {
            let free = rest.iter().position(|&j| rest.iter().all(|&k| k == j || !before(k, j))).unwrap_or(0);
            order.push(rest.remove(free));
        }
        if mistakes.is_empty() { Ok(order) } else { Err(mistakes) }
    }

    /// Whether the place of a body that both move is E_k E_j M.
    fn is_product(&self, motions: &[Motion], k: usize, j: usize) -> bool {
        let Some(&body) = self.moved[j].iter().find(|body| self.moved[k].contains(body)) else { return true };
        let mut values = self.origin.clone();
        let mut sequence = Sequence::new();
        [k, j].into_iter().for_each(|own| values[own] = sequence.value(self.scene.variables[own].kind));
        let moved = motions[k].displacement(values[k]) * motions[j].displacement(values[j]) * self.places[body];
        is_same(self.scene.bodies.list[body].kind, &self.scene.poses(0.0, &values)[body], &moved)
    }

    /// Each body whose pose is no product of motions, and each that the time moves.
    fn refuse_other_poses(&self, tree: &JointTree) -> Result<(), Vec<String>> {
        let mut sequence = Sequence::new();
        let list = &self.scene.bodies.list;
        let (mut others, mut driven) = (vec![false; list.len()], vec![false; list.len()]);
        for _ in 0..4 {
            let values = self.scene.sample(&mut sequence);
            let (now, later) = (self.scene.poses(0.0, &values), self.scene.poses(1.3, &values));
            for (body, own) in list.iter().enumerate() {
                let place = tree.displacement(tree.carriers[body], &values) * self.places[body];
                others[body] |= !is_same(own.kind, &now[body], &place);
                driven[body] |= !is_same(own.kind, &now[body], &later[body]);
            }
        }
        let mistake = |(body, own): (usize, &gauss_codegen::LinkData)| {
            let name = &own.name;
            if driven[body] {
                Some(format!("`{name}` moves as a function of time, as no joint of MJCF does"))
            } else if others[body] {
                let way =
                    tree.way(tree.carriers[body]).into_iter().map(|k| format!("`{}`", self.scene.variables[k].name));
                let way: Vec<String> = way.collect();
                Some(format!(
                    "the place of `{name}` is no product of joints, one for each of {}: a coordinate enters twice, \
                     or by a function",
                    way.join(", ")
                ))
            } else {
                None
            }
        };
        let mistakes: Vec<String> = list.iter().enumerate().filter_map(mistake).collect();
        if mistakes.is_empty() { Ok(()) } else { Err(mistakes) }
    }

    /// Displacement of a body by one coordinate, with all others at 0.
    fn displaced(&self, k: usize, body: usize, value: Value) -> Isometry3<f64> {
        let mut values = self.origin.clone();
        values[k] = value;
        self.scene.poses(0.0, &values)[body] * self.places[body].inverse()
    }

    fn motion(&self, k: usize) -> Result<Motion, String> {
        let own = &self.scene.variables[k];
        let rigid = |body: &&usize| self.scene.bodies.list[**body].kind != LinkKind::Particle;
        let refused = |why: &str| format!("`{}` is no coordinate of a joint: {why}", own.name);
        let found = match (own.kind, self.moved[k].iter().find(rigid)) {
            (_, _) if self.moved[k].is_empty() => return Err(refused("it moves nothing")),
            (VariableKind::Scalar | VariableKind::Angle, Some(&body)) => self.of_body(k, body),
            (VariableKind::Scalar | VariableKind::Angle, None) => self.of_particles(k),
            (_, None) => None,
            (VariableKind::Rotation, Some(&body)) => self.axes(k, body, Value::Rotation).map(Motion::Ball),
            (VariableKind::Pose, Some(&body)) => {
                let turned =
                    |turn: UnitQuaternion<f64>| Value::Pose(Isometry3::from_parts(Translation3::identity(), turn));
                self.axes(k, body, turned).map(Motion::Free)
            }
        };
        found.ok_or_else(|| {
            refused("what it moves neither turns about a line nor shifts, by one unit for each of its own")
        })
    }

    /// Motion of a body that one number moves.
    fn of_body(&self, k: usize, body: usize) -> Option<Motion> {
        let turn = |angle: f64| self.displaced(k, body, Value::Scalar(angle));
        let quarter = turn(std::f64::consts::FRAC_PI_2);
        if (quarter.rotation.to_rotation_matrix().matrix() - Matrix3::identity()).norm() < ROUNDING {
            return direction(turn(1.0).translation.vector).map(|axis| Motion::Slide { axis });
        }
        let (axis, anchor) = line(&quarter)?;
        Some(Motion::Hinge { axis, anchor })
    }

    /// Motion of particles that one number moves: along a line or about one, which three of their places show. Where
    /// others are on that line while all else is at 0, they are seen elsewhere, which tells of what is moved by nothing
    /// else alone.
    fn of_particles(&self, k: usize) -> Option<Motion> {
        let mut sequence = Sequence::new();
        [self.origin.clone(), self.scene.sample(&mut sequence)]
            .into_iter()
            .find_map(|base| self.moved[k].iter().find_map(|&body| self.of_particle(k, body, &base)))
    }

    fn of_particle(&self, k: usize, body: usize, base: &[Value]) -> Option<Motion> {
        let place = |x: f64| {
            let mut values = base.to_vec();
            values[k] = Value::Scalar(x);
            self.scene.poses(0.0, &values)[body].translation.vector
        };
        let (start, one, two) = (place(0.0), place(1.0), place(2.0));
        if are_small((two - one - (one - start)).iter(), ROUNDING * (1.0 + two.norm())) {
            return direction(one - start).map(|axis| Motion::Slide { axis });
        }
        let (quarter, half) = (place(std::f64::consts::FRAC_PI_2), place(std::f64::consts::PI));
        let anchor = ((start + half) / 2.0).map(snapped);
        let arm = start - anchor;
        let axis = direction(arm.cross(&(quarter - anchor)) / arm.norm_squared())?;
        Some(Motion::Hinge { axis, anchor })
    }

    /// Axes in which a body turns by a rotation, about their origin.
    fn axes(&self, k: usize, body: usize, value: impl Fn(UnitQuaternion<f64>) -> Value) -> Option<Isometry3<f64>> {
        let quarter = |axis: Vector3<f64>| {
            let turn = UnitQuaternion::from_scaled_axis(axis * std::f64::consts::FRAC_PI_2);
            line(&self.displaced(k, body, value(turn)))
        };
        let [x, y, z] = [Vector3::x(), Vector3::y(), Vector3::z()].map(quarter);
        let ((x, on_x), (y, on_y), (z, _)) = (x?, y?, z?);
        // The point that the first two lines have in common.
        let center = on_x + x * x.dot(&(on_y - on_x));
        let rotation =
            UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(Matrix3::from_columns(&[x, y, z])));
        Some(Isometry3::from_parts(center.map(snapped).into(), rotation))
    }
}

/// A vector of length 1.
fn direction(vector: Vector3<f64>) -> Option<Vector3<f64>> {
    ((vector.norm() - 1.0).abs() <= ROUNDING).then(|| vector.map(snapped))
}

/// The line about which a displacement is a quarter turn, by its direction and a point.
fn line(quarter: &Isometry3<f64>) -> Option<(Vector3<f64>, Vector3<f64>)> {
    let r = quarter.rotation.to_rotation_matrix();
    let r = r.matrix();
    let axis = Vector3::new(r[(2, 1)] - r[(1, 2)], r[(0, 2)] - r[(2, 0)], r[(1, 0)] - r[(0, 1)]) / 2.0;
    let (axis, shift) = (direction(axis)?, quarter.translation.vector);
    let is_turn = axis.dot(&shift).abs() <= ROUNDING * (1.0 + shift.norm());
    is_turn.then(|| (axis, ((shift + axis.cross(&shift)) / 2.0).map(snapped)))
}
