//! Ranges of joints, dry friction of joints, and points and spheres that meet each other or planes that stand still.

use gauss_codegen::LinkKind;
use gauss_codegen::description::ContactDescription;
use gauss_runtime::nalgebra::{DMatrix, DVector, Vector3};

use super::masses::STATES;
use super::motions::ROUNDING;
use super::numbers::{SceneNumbers, Sequence, Value, are_small, shortest};
use super::parts::{BodySphere, Obstacle, Parts, SphereContact};
use super::tree::JointTree;

/// A state with all numbers of contacts.
struct ContactState {
    values: Vec<Value>,
    gaps: Vec<f64>,
    friction: Vec<f64>,
    rows: DMatrix<f64>,
    frames: Vec<f64>,
}

/// Reads contacts.
pub struct Contacts<'a> {
    scene: &'a SceneNumbers,
    tree: &'a JointTree,
    parts: &'a mut Parts,
    list: Vec<ContactDescription>,
    states: Vec<ContactState>,
}

impl<'a> Contacts<'a> {
    pub fn new(scene: &'a SceneNumbers, tree: &'a JointTree, parts: &'a mut Parts) -> Self {
        let list = scene.kernel.model().description().contacts.clone();
        let mut sequence = Sequence::new();
        let origin = std::iter::once(scene.origin());
        let states = if list.is_empty() {
            Vec::new()
        } else {
            let all = origin.chain((0..STATES).map(|_| scene.sample(&mut sequence)));
            let mut sequence = Sequence::new();
            all.enumerate().filter_map(|(k, values)| state(scene, 0.3 * k as f64, values, &mut sequence)).collect()
        };
        Self { scene, tree, parts, list, states }
    }

    pub fn add(mut self) {
        let (mut row, mut vector) = (0, 0);
        for (k, own) in self.list.clone().iter().enumerate() {
            let stops = self.range(k, row, own) || self.dry(row, own);
            if stops {
                self.parts.stops.push(own.name.clone());
            }
            let found = stops || self.sphere(k, (row, vector), own);
            // Of what rolls it is said where its contact is.
            let is_known = |on: usize| self.parts.contacts.iter().any(|known| known.name == self.list[on].name);
            if !found && !own.rolls_on.is_some_and(is_known) {
                self.parts.acting.push(format!(
                    "the contact `{}` is neither a range or dry friction of one joint nor that of a point or sphere \
                     of a body with another one or with a plane that stands still",
                    own.name
                ));
            }
            row += own.rows();
            vector += if own.axes > 0 { 1 + own.axes } else { 0 };
        }
    }

    /// A gap that is `±q + c` of one joint.
    fn range(&mut self, k: usize, row: usize, own: &ContactDescription) -> bool {
        if !own.has_gap || own.rows() != 1 {
            return false;
        }
        let Some(first) = self.states.first() else { return false };
        let Some((variable, sign)) = self.single(row) else { return false };
        let bound = first.gaps[k] - sign * first.values[variable].scalar();
        let fits = |state: &ContactState| {
            (state.gaps[k] - bound - sign * state.values[variable].scalar()).abs() <= ROUNDING * (1.0 + bound.abs())
        };
        if (sign.abs() - 1.0).abs() > ROUNDING || !self.states.iter().all(fits) {
            return false;
        }
        // q ≥ −c, or q ≤ c: the narrower one of several.
        let bound = -sign * bound;
        let range = &mut self.parts.joints[variable].range[usize::from(sign < 0.0)];
        *range = Some(range.map_or(bound, |known| if sign > 0.0 { known.max(bound) } else { known.min(bound) }));
        true
    }

    /// The joint, a scalar, that alone moves a row, and its constant coefficient.
    fn single(&self, row: usize) -> Option<(usize, f64)> {
        let first: DVector<f64> = self.states.first()?.rows.column(row).into_owned();
        let moved =
            |k: &usize| self.scene.variables[*k].rates().any(|place| first[place].abs() > ROUNDING * first.amax());
        let moved: Vec<usize> = (0..self.scene.variables.len()).filter(moved).collect();
        let [variable] = moved[..] else { return None };
        let same = self
            .states
            .iter()
            .all(|state| are_small((state.rows.column(row) - &first).iter(), ROUNDING * first.amax()));
        (self.scene.variables[variable].is_scalar() && same)
            .then(|| (variable, first[self.scene.variables[variable].rate]))
    }

    /// Dry friction of one joint.
    fn dry(&mut self, row: usize, own: &ContactDescription) -> bool {
        if own.has_gap || own.rolls_on.is_some() || own.rows() != 1 {
            return false;
        }
        let Some((variable, factor)) = self.single(row) else { return false };
        let bound = self.states[0].friction[row];
        let fits = self.states.iter().all(|state| (state.friction[row] - bound).abs() <= ROUNDING * bound.abs());
        if fits {
            self.parts.joints[variable].friction_loss += factor.abs() * bound;
        }
        fits
    }

    /// A sphere, or a point, that meets a plane which stands still, or another one.
    fn sphere(&mut self, k: usize, (row, vector): (usize, usize), own: &ContactDescription) -> bool {
        let known = |name: &Option<String>| {
            let body = self.scene.bodies.list.iter().position(|body| Some(&body.name) == name.as_ref())?;
            (self.scene.bodies.list[body].kind != LinkKind::Particle).then_some(body)
        };
        let Some(body) = known(&own.bodies[0]).filter(|_| own.has_gap && own.axes > 0) else { return false };
        let at = |state: &ContactState, k: usize| Vector3::from_column_slice(&state.frames[3 * (vector + k)..][..3]);
        let place = |state: &ContactState| (at(state, 0), at(state, 1), state.gaps[k]);
        // The contact is at c − r n, and at c + r n + g n of another sphere.
        let sphere = self.sphere_of(body, |state| (at(state, 0), -at(state, 1)));
        let other = match &own.bodies[1] {
            None => self.plane(place),
            name => known(name)
                .and_then(|body| {
                    self.sphere_of(body, |state| (at(state, 0) - at(state, 1) * state.gaps[k], at(state, 1)))
                })
                .map(Obstacle::Sphere),
        };
        let (Some(sphere), Some(other)) = (sphere, other) else { return false };
        let all = self.states.iter().flat_map(|state| &state.friction[row + 1..row + 1 + own.tangents]);
        let (low, high) = all.fold((f64::INFINITY, 0.0_f64), |(low, high), x| (low.min(*x), high.max(*x)));
        if own.tangents > 0 && high - low > ROUNDING * high {
            return false;
        }
        let turns = own.drills || self.list.iter().any(|other| other.rolls_on == Some(k));
        self.parts.contacts.push(SphereContact { name: own.name.clone(), sphere, other, friction: high, turns });
        true
    }

    /// States in which contacts have places: spheres with one centre have none.
    fn placed(&self) -> Vec<&ContactState> {
        let is_known = |state: &&ContactState| state.frames.iter().chain(&state.gaps).all(|x| x.is_finite());
        self.states.iter().filter(is_known).collect()
    }

    /// A plane that stands still, from points of contact, normals and gaps.
    fn plane(&self, place: impl Fn(&ContactState) -> (Vector3<f64>, Vector3<f64>, f64)) -> Option<Obstacle> {
        let states = self.placed();
        let (point, normal, gap) = place(states.first()?);
        let height = normal.dot(&point) - gap;
        let size = states.iter().map(|state| 1.0 + place(state).0.norm()).fold(0.0, f64::max);
        let fits = |state: &&ContactState| {
            let (point, own, gap) = place(state);
            are_small(&[(own - normal).norm(), own.dot(&point) - gap - height], ROUNDING * (1.0 + point.norm()))
        };
        let height = shortest(height, 1e-14 * size);
        states.iter().all(fits).then_some(Obstacle::Plane { normal: normal.into(), height })
    }

    /// The sphere of a body with points of its surface in given directions.
    fn sphere_of(
        &self,
        body: usize,
        surface: impl Fn(&ContactState) -> (Vector3<f64>, Vector3<f64>),
    ) -> Option<BodySphere> {
        let states = self.placed();
        let (mut rows, mut given) = (DMatrix::zeros(3 * states.len(), 4), DVector::zeros(3 * states.len()));
        for (place, state) in states.iter().enumerate() {
            let (point, direction) = surface(state);
            let pose = self.tree.place(body, &state.values);
            let seen = pose.rotation.inverse() * (point - pose.translation.vector);
            rows.view_mut((3 * place, 0), (3, 3)).fill_with_identity();
            rows.view_mut((3 * place, 3), (3, 1)).copy_from(&(pose.rotation.inverse() * direction));
            given.rows_mut(3 * place, 3).copy_from(&seen);
        }
        // Four numbers want more than two states.
        let found = rows.clone().svd(true, true).solve(&given, ROUNDING).ok().filter(|_| states.len() > 2)?;
        if !are_small((&rows * &found - &given).iter(), 100.0 * ROUNDING * (1.0 + given.amax())) {
            return None;
        }
        let error = 1e-14 * (1.0 + given.amax());
        let center = [found[0], found[1], found[2]].map(|x| shortest(x, error));
        Some(BodySphere { body, center, radius: Some(shortest(found[3], error)).filter(|r| *r > error) })
    }
}

fn state(scene: &SceneNumbers, t: f64, values: Vec<Value>, sequence: &mut Sequence) -> Option<ContactState> {
    let q = scene.configuration(&values);
    let (z, u) = (sequence.list(scene.rates_by_speeds(&values).ncols()), sequence.list(scene.inputs.len()));
    let call = |method: &str| {
        let count = scene.kernel.model().arguments(method).ok()?.len();
        scene.kernel.call(method, &[&[t][..], &q, &z, &u][..count]).ok()
    };
    let rows = scene.contact_forces(&values)?;
    let (gaps, friction) = (call("gaps").unwrap_or_default(), call("friction").unwrap_or_default());
    let (count, contacts) = (rows.ncols(), scene.kernel.model().description().contacts.len());
    let padded = |mut list: Vec<f64>, count: usize| {
        list.resize(count, 0.0);
        list
    };
    Some(ContactState {
        gaps: padded(gaps, contacts),
        friction: padded(friction, count),
        frames: call("contact_frames").unwrap_or_default(),
        rows,
        values,
    })
}
