//! Motions of bodies by one coordinate, seen where all others are 0.
//!
//! A coordinate has a joint that moves by 1 for 1; further ones may follow it by a ratio, each on a body of its own or
//! behind those before it.

use std::f64::consts::{FRAC_PI_2, PI};

use gauss_codegen::LinkKind;
use gauss_runtime::nalgebra::{Isometry3, Matrix3, Rotation3, Translation3, UnitQuaternion, Vector3};

use super::numbers::{SceneNumbers, Sequence, Value, VariableKind, are_small, shortest};

/// Differences that rounding makes, of numbers of the size 1: some thousand roundings. What is no tree differs by much
/// more at a state of general position.
pub const ROUNDING: f64 = 1e-11;

/// Values at which a motion is tried.
const TRIALS: [f64; 3] = [0.3, -0.8, 1.1];

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

/// A joint: its motion by the coordinate that it has, or follows.
#[derive(Clone, Copy, Debug)]
pub struct Joint {
    pub motion: Motion,
    pub variable: usize,
    /// Its value by that of the coordinate.
    pub ratio: f64,
}

/// Joints of one coordinate, each with the bodies that it moves; the one that has the coordinate is the first.
pub type JointGroup = Vec<(Joint, Vec<usize>)>;

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

impl Motion {
    pub fn is_scalar(&self) -> bool {
        matches!(self, Motion::Hinge { .. } | Motion::Slide { .. })
    }
}

impl Joint {
    /// The displacement of what it carries.
    pub fn displacement(&self, values: &[Value]) -> Isometry3<f64> {
        self.motion.displacement(match values[self.variable] {
            Value::Scalar(x) => Value::Scalar(self.ratio * x),
            other => other,
        })
    }

    /// Whether it follows a coordinate that another joint has, by its place among the joints.
    pub fn follows(&self, place: usize) -> bool {
        self.variable != place
    }
}

/// Whether two places are one to rounding: of particles their positions alone.
pub fn is_same(kind: LinkKind, a: &Isometry3<f64>, b: &Isometry3<f64>) -> bool {
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

/// Sees motions.
pub struct Observer<'a> {
    pub scene: &'a SceneNumbers,
    pub origin: Vec<Value>,
    pub places: Vec<Isometry3<f64>>,
}

impl<'a> Observer<'a> {
    pub fn new(scene: &'a SceneNumbers) -> Self {
        let origin = scene.origin();
        let places = scene.poses(0.0, &origin);
        Self { scene, origin, places }
    }

    fn kind(&self, body: usize) -> LinkKind {
        self.scene.bodies.list[body].kind
    }

    /// Bodies that each variable moves.
    pub fn moved(&self) -> Vec<Vec<usize>> {
        let mut sequence = Sequence::new();
        let base = self.scene.sample(&mut sequence);
        let before = self.scene.poses(0.0, &base);
        let moved_by = |k: usize| {
            let mut values = base.clone();
            values[k] = sequence.value(self.scene.variables[k].kind);
            let after = self.scene.poses(0.0, &values);
            let list = before.iter().zip(&after).enumerate();
            list.filter(|(body, (a, b))| !is_same(self.kind(*body), a, b)).map(|(body, _)| body).collect()
        };
        (0..self.scene.variables.len()).map(moved_by).collect()
    }

    /// Displacement of a body by one coordinate, with all others at 0.
    fn displaced(&self, k: usize, body: usize, value: Value) -> Isometry3<f64> {
        let mut values = self.origin.clone();
        values[k] = value;
        self.scene.poses(0.0, &values)[body] * self.places[body].inverse()
    }

    /// The joints of a coordinate that moves some bodies.
    ///
    /// # Errors
    /// A sentence with its name, where there are none.
    pub fn joints(&self, k: usize, moved: &[usize]) -> Result<JointGroup, String> {
        let own = &self.scene.variables[k];
        let refused = |why: &str| format!("`{}` is no coordinate of a joint: {why}", own.name);
        let rigid = moved.iter().copied().find(|&body| self.kind(body) != LinkKind::Particle);
        let whole = |motion: Motion| vec![(Joint { motion, variable: k, ratio: 1.0 }, moved.to_vec())];
        let found = match (own.kind, rigid) {
            (_, _) if moved.is_empty() => return Err(refused("it moves nothing")),
            (VariableKind::Scalar | VariableKind::Angle, _) => self.scalar(k, moved),
            (_, None) => None,
            (VariableKind::Rotation, Some(body)) => self.axes(k, body, Value::Rotation).map(Motion::Ball).map(whole),
            (VariableKind::Pose, Some(body)) => {
                let turned =
                    |turn: UnitQuaternion<f64>| Value::Pose(Isometry3::from_parts(Translation3::identity(), turn));
                self.axes(k, body, turned).map(Motion::Free).map(whole)
            }
        };
        found.ok_or_else(|| {
            refused("what it moves neither turns about a line nor shifts, by one unit for each of its own")
        })
    }

    /// Joints of a number: each body moves by a chain of them.
    fn scalar(&self, k: usize, moved: &[usize]) -> Option<JointGroup> {
        let (mut joints, mut chains): (Vec<Joint>, Vec<Vec<usize>>) = Default::default();
        let mut chain_of = Vec::new();
        let is_particle = |body: &usize| self.kind(*body) == LinkKind::Particle;
        let bodies =
            moved.iter().filter(|body| !is_particle(body)).chain(moved.iter().filter(|body| is_particle(body)));
        for &body in bodies {
            let of = |chain: &[usize]| chain.iter().map(|&joint| joints[joint]).collect::<Vec<_>>();
            let mut known = chains.iter().position(|chain| self.fits(k, body, &of(chain)));
            if known.is_none() {
                let prefixes = std::iter::once(Vec::new()).chain(chains.iter().cloned());
                let found = prefixes.into_iter().find_map(|chain| Some((self.behind(k, body, &of(&chain))?, chain)));
                if let Some((joint, mut chain)) = found {
                    chain.push(joints.len());
                    joints.push(joint);
                    chains.push(chain);
                    known = Some(chains.len() - 1);
                }
            }
            // That such a body is none of the tree is found when the tree is tried.
            chain_of.push((body, known));
        }
        // The joint that has the coordinate, before those that follow it.
        let first = joints.iter().position(|joint| joint.ratio == 1.0)?;
        let mut order: Vec<usize> = (0..joints.len()).collect();
        order[..=first].rotate_right(1);
        let moves = |joint: usize| {
            let on = |own: &&(usize, Option<usize>)| own.1.is_none_or(|chain| chains[chain].contains(&joint));
            let mut bodies: Vec<usize> = chain_of.iter().filter(on).map(|own| own.0).collect();
            bodies.sort_unstable();
            bodies
        };
        Some(order.into_iter().map(|joint| (joints[joint], moves(joint))).collect())
    }

    /// Whether a chain of joints moves a body as the coordinate does.
    fn fits(&self, k: usize, body: usize, chain: &[Joint]) -> bool {
        TRIALS.into_iter().all(|x| {
            let mut values = self.origin.clone();
            values[k] = Value::Scalar(x);
            let moved = chain.iter().fold(Isometry3::identity(), |moved, joint| moved * joint.displacement(&values));
            is_same(self.kind(body), &self.scene.poses(0.0, &values)[body], &(moved * self.places[body]))
        })
    }

    /// The joint that moves a body behind a chain of others.
    fn behind(&self, k: usize, body: usize, chain: &[Joint]) -> Option<Joint> {
        let found = if self.kind(body) != LinkKind::Particle {
            one_parameter(|x| {
                let mut values = self.origin.clone();
                values[k] = Value::Scalar(x);
                let before =
                    chain.iter().fold(Isometry3::identity(), |moved, joint| moved * joint.displacement(&values));
                before.inverse() * self.displaced(k, body, Value::Scalar(x))
            })
        } else if chain.is_empty() {
            // Where it is on the line while all else is at 0, it is seen elsewhere, which tells of what is moved by
            // nothing else alone.
            let mut sequence = Sequence::new();
            let bases = [self.origin.clone(), self.scene.sample(&mut sequence)];
            bases.into_iter().find_map(|base| self.of_particle(k, body, &base))
        } else {
            None
        };
        let (motion, ratio) = found?;
        let joint = Joint { motion, variable: k, ratio };
        self.fits(k, body, &[chain, &[joint]].concat()).then_some(joint)
    }

    /// Motion of a particle that one number moves: along a line or about one, which three of its places show.
    fn of_particle(&self, k: usize, body: usize, base: &[Value]) -> Option<(Motion, f64)> {
        let place = |x: f64| {
            let mut values = base.to_vec();
            values[k] = Value::Scalar(x);
            self.scene.poses(0.0, &values)[body].translation.vector
        };
        let (start, one, two) = (place(0.0), place(1.0), place(2.0));
        if are_small((two - one - (one - start)).iter(), ROUNDING * (1.0 + two.norm())) {
            return slide(one - start);
        }
        let (quarter, half) = (place(FRAC_PI_2), place(PI));
        let anchor = ((start + half) / 2.0).map(snapped);
        let arm = start - anchor;
        let axis = direction(arm.cross(&(quarter - anchor)) / arm.norm_squared())?;
        Some((Motion::Hinge { axis, anchor }, 1.0))
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

/// The turn about a line or the shift that a number makes, with its ratio.
fn one_parameter(at: impl Fn(f64) -> Isometry3<f64>) -> Option<(Motion, f64)> {
    const SMALL: f64 = 1e-3;
    let coarse = at(SMALL).rotation.angle() / SMALL;
    if coarse < ROUNDING / SMALL {
        return slide(at(1.0).translation.vector);
    }
    // By an angle near 1, which has all digits.
    let ratio = unit(at(1.0 / coarse).rotation.angle() * coarse);
    let (axis, anchor) = line(&at(FRAC_PI_2 / ratio))?;
    Some((Motion::Hinge { axis, anchor }, ratio))
}

/// A shift by a vector for each unit.
fn slide(shift: Vector3<f64>) -> Option<(Motion, f64)> {
    let ratio = unit(shift.norm());
    (ratio > ROUNDING).then(|| direction(shift / ratio)).flatten().map(|axis| (Motion::Slide { axis }, ratio))
}

/// A ratio without rounding.
fn unit(ratio: f64) -> f64 {
    if (ratio - 1.0).abs() <= ROUNDING { 1.0 } else { shortest(ratio, 1e-14 * ratio) }
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
