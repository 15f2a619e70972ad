//! Shapes of bodies, which of them may touch, and where they do.

use std::fmt;

use gauss_contact::Slot;
use gauss_runtime::frames::{FrameName, FramePose};
use gauss_runtime::nalgebra::Isometry3;
use parry3d_f64::bounding_volume::BoundingVolume;
use parry3d_f64::math::Pose;
use parry3d_f64::query::{DefaultQueryDispatcher, PersistentQueryDispatcher, TrackedContact, Unsupported};
use parry3d_f64::shape::{PackedFeatureId, SharedShape};

use crate::convert;
use crate::error::{ParryError, ParryErrorKind};
use crate::facets::{Facets, Manifold};
use crate::id::ShapeId;
use crate::reduce::{Place, Reduction};

/// Friction and restitution of a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Surface {
    /// μ of Coulomb's friction.
    pub friction: f64,
    /// e of Newton's law, from 0 to 1.
    pub restitution: f64,
}

/// The features of both shapes that touch, by which a contact of one step is known in the next.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Feature {
    /// The shapes, in the order in which they were added.
    pub shapes: (ShapeId, ShapeId),
    /// Their parts, as triangles of a mesh.
    pub parts: (u32, u32),
    /// Vertices, edges, faces, as the library numbers them.
    pub features: (u32, u32),
    /// Which of several points of the same features it is.
    pub repeated: u32,
}

/// A contact, or one that may come to be: data of a slot, and what it is of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Found<F> {
    /// The data of a slot.
    pub slot: Slot<F>,
    /// Features that it is between.
    pub feature: Feature,
}

/// A shape on a frame.
struct Body<F> {
    frame: Option<F>,
    shape: SharedShape,
    /// The facets of a mesh or a height field.
    facets: Option<Facets>,
    at: Pose,
    surface: Surface,
}

type Point = TrackedContact<()>;

/// Shapes of bodies; `F` names the frames of a kernel, `None` is what is at rest.
///
/// All shapes of different bodies may touch, but for pairs that [`without`](Self::without) leaves out.
pub struct Shapes<F> {
    bodies: Vec<Body<F>>,
    without: Vec<(ShapeId, ShapeId)>,
    between: Vec<((ShapeId, ShapeId), Surface)>,
    reach: f64,
    deepest: f64,
    most: usize,
    reduction: Option<Reduction>,
    found: Vec<Found<F>>,
    manifolds: Vec<Manifold>,
}

impl<F: FrameName> Default for Shapes<F> {
    fn default() -> Self {
        Self::new()
    }
}

impl<F: fmt::Debug> fmt::Debug for Shapes<F> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let shapes: Vec<_> = self.bodies.iter().map(|body| (&body.frame, body.shape.shape_type())).collect();
        f.debug_struct("Shapes").field("shapes", &shapes).field("found", &self.found).finish_non_exhaustive()
    }
}

impl<F: FrameName> Shapes<F> {
    /// None yet; a reach of 0.02 and up to 16 points of a pair.
    #[must_use]
    pub fn new() -> Self {
        let (bodies, without, between, found) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
        let (reach, deepest) = (0.02, 0.02);
        Self { bodies, without, between, reach, deepest, most: 16, reduction: None, found, manifolds: Vec::new() }
    }

    /// A shape on a frame, at a place in its axes; on none it is at rest, at a place in the observer's axes.
    pub fn add(&mut self, frame: Option<F>, shape: SharedShape, at: Isometry3<f64>, surface: Surface) -> ShapeId {
        let facets = Facets::of(&*shape);
        self.bodies.push(Body { frame, shape, facets, at: convert::isometry(&at), surface });
        ShapeId(self.bodies.len() - 1)
    }

    /// Leaves out a pair, as of bodies that a joint holds inside one another.
    #[must_use]
    pub fn without(mut self, first: ShapeId, second: ShapeId) -> Self {
        self.without.push(in_order(first, second));
        self
    }

    /// Sets friction and restitution of a pair. Without this its friction is √(μ₁ μ₂) and its restitution the larger of
    /// both.
    #[must_use]
    pub fn between(mut self, first: ShapeId, second: ShapeId, surface: Surface) -> Self {
        self.between.push((in_order(first, second), surface));
        self
    }

    /// Up to what distance points are asked for. What comes closer than that within a step is seen before it touches:
    /// it should be longer than the way of a step.
    #[must_use]
    pub fn reach(mut self, reach: f64) -> Self {
        self.reach = reach;
        self
    }

    /// Sets how far a gap may be below zero before a step. Steps leave gaps at zero to rounding; where shapes are
    /// round, or new features meet, it is the order of what they move in a step.
    #[must_use]
    pub fn deepest(mut self, deepest: f64) -> Self {
        self.deepest = deepest;
        self
    }

    /// Sets how many points a pair may have, after [`reduce`](Self::reduce); more are an error.
    #[must_use]
    pub fn most(mut self, most: usize) -> Self {
        self.most = most;
        self
    }

    /// Leaves out points of pairs by a rule.
    #[must_use]
    pub fn reduce(mut self, reduction: Reduction) -> Self {
        self.reduction = Some(reduction);
        self
    }

    /// Returns the contacts that were found last.
    pub fn found(&self) -> &[Found<F>] {
        &self.found
    }

    pub(crate) fn depth_allowed(&self) -> f64 {
        self.deepest
    }

    /// Asks the library where shapes touch, or come nearer than the reach, with their frames at these poses. Pairs are
    /// in the order in which their shapes were added, points of a pair in the library's.
    ///
    /// # Errors
    /// `Number` of the reach or the depth, `Unknown`, `Unsupported`, `PairPoints`.
    pub fn update(&mut self, pose_of: impl Fn(F) -> FramePose<f64>) -> Result<&[Found<F>], ParryError> {
        self.check()?;
        let own = |body: &Body<F>| body.frame.map_or(Pose::IDENTITY, |frame| convert::pose(&pose_of(frame)));
        let poses: Vec<Pose> = self.bodies.iter().map(|body| own(body) * body.at).collect();
        let near = |(body, pose): (&Body<F>, &Pose)| body.shape.compute_aabb(pose).loosened(0.5 * self.reach);
        let boxes: Vec<_> = self.bodies.iter().zip(&poses).map(near).collect();
        self.found.clear();
        for i in 0..poses.len() {
            for j in i + 1..poses.len() {
                let may =
                    self.bodies[i].frame != self.bodies[j].frame && !self.without.contains(&(ShapeId(i), ShapeId(j)));
                if may && boxes[i].intersects(&boxes[j]) {
                    self.pair([i, j], poses[i].inv_mul(&poses[j]))?;
                }
            }
        }
        Ok(&self.found)
    }

    fn check(&self) -> Result<(), ParryError> {
        for (field, value) in [("reach", self.reach), ("deepest", self.deepest)] {
            if !(value >= 0.0 && value.is_finite()) {
                let rule = "finite and not negative";
                return Err(ParryError::of(ParryErrorKind::Number { field, value, rule }));
            }
        }
        let named = self.without.iter().chain(self.between.iter().map(|(pair, _)| pair));
        match named.copied().find(|(_, last)| last.0 >= self.bodies.len()) {
            Some(pair) => Err(ParryError { shapes: Some(pair), kind: ParryErrorKind::Unknown }),
            None => Ok(()),
        }
    }

    /// The points of one pair, the second shape at a pose relative to the first.
    fn pair(&mut self, [i, j]: [usize; 2], relative: Pose) -> Result<(), ParryError> {
        let shapes = (ShapeId(i), ShapeId(j));
        let refuse = |kind| Err(ParryError { shapes: Some(shapes), kind });
        let mut manifolds = core::mem::take(&mut self.manifolds);
        manifolds.clear();
        let (first, second) = (&self.bodies[i], &self.bodies[j]);
        if ask([first, second], &relative, self.reach, &mut manifolds).is_err() {
            return refuse(ParryErrorKind::Unsupported);
        }
        let mut points = Vec::new();
        for manifold in &manifolds {
            let place = |point: &Point| self.placed(manifold, point, [first, second]);
            points.extend(manifold.points.iter().filter(|point| point.dist <= self.reach).map(place));
        }
        self.manifolds = manifolds;
        if let Some(reduction) = self.reduction {
            let places: Vec<Place> = points.iter().map(|point| point.place).collect();
            let kept = reduction.kept(&places);
            points = kept.into_iter().map(|k| points[k]).collect();
        }
        if points.len() > self.most {
            return refuse(ParryErrorKind::PairPoints { points: points.len(), most: self.most });
        }
        let surface = self.surface(shapes);
        for ManifoldPoint { slot, parts, features, .. } in points {
            let slot = Slot { friction: surface.friction, restitution: surface.restitution, ..slot };
            let mut feature = Feature { shapes, parts, features, repeated: 0 };
            let earlier = self.found.iter().filter(|found| Feature { repeated: 0, ..found.feature } == feature);
            feature.repeated = earlier.count() as u32;
            self.found.push(Found { slot, feature });
        }
        Ok(())
    }

    /// A point of the library as a slot: a ball is a sphere; else the plane is on the shape whose face touches, or on
    /// the first.
    fn placed(&self, manifold: &Manifold, point: &Point, [first, second]: [&Body<F>; 2]) -> ManifoldPoint<F> {
        let part = |pose: Option<&Pose>| pose.copied().unwrap_or(Pose::IDENTITY);
        let places = [first.at * part(manifold.subshape_pos1()), second.at * part(manifold.subshape_pos2())];
        let points = [places[0] * point.local_p1, places[1] * point.local_p2].map(convert::vector);
        let normals =
            [places[0].rotation * manifold.local_n1, places[1].rotation * manifold.local_n2].map(convert::vector);
        let frames = [first.frame, second.frame];
        let balls = [first, second].map(|body| body.shape.as_ball());
        let of_second = match balls {
            [Some(_), _] => true,
            [None, Some(_)] => false,
            _ => point.fid2.is_face() && !point.fid1.is_face(),
        };
        let (point_of, plane_of) = if of_second { (0, 1) } else { (1, 0) };
        let centre = convert::vector(places[point_of].translation);
        let slot = Slot {
            first: frames[point_of],
            point: balls[point_of].map_or(points[point_of], |_| centre),
            radius: balls[point_of].map_or(0.0, |ball| ball.radius),
            second: frames[plane_of],
            origin: points[plane_of],
            normal: normals[plane_of],
            friction: 0.0,
            restitution: 0.0,
        };
        let features = [point.fid1, point.fid2].map(|PackedFeatureId(code)| code);
        let place = (points[0], normals[0], point.dist);
        ManifoldPoint {
            slot,
            place,
            parts: (manifold.subshape1, manifold.subshape2),
            features: (features[0], features[1]),
        }
    }

    fn surface(&self, pair: (ShapeId, ShapeId)) -> Surface {
        if let Some((_, surface)) = self.between.iter().rev().find(|(known, _)| *known == pair) {
            return *surface;
        }
        let [a, b] = [pair.0, pair.1].map(|shape| self.bodies[shape.0].surface);
        let friction = if a.friction == b.friction { a.friction } else { (a.friction * b.friction).sqrt() };
        Surface { friction, restitution: a.restitution.max(b.restitution) }
    }
}

/// Asks the library about two shapes, of which one may be triangles with neighbours.
fn ask<F>(
    [first, second]: [&Body<F>; 2],
    relative: &Pose,
    reach: f64,
    found: &mut Vec<Manifold>,
) -> Result<(), Unsupported> {
    let (a, b) = (&*first.shape, &*second.shape);
    match (&first.facets, &second.facets) {
        (Some(facets), None) if b.as_composite_shape().is_none() => {
            facets.touch(a, (b, relative), (reach, false), found)
        }
        (None, Some(facets)) if a.as_composite_shape().is_none() => {
            facets.touch(b, (a, &relative.inverse()), (reach, true), found)
        }
        _ => DefaultQueryDispatcher.contact_manifolds(relative, a, b, reach, found, &mut None),
    }
}

/// A point of a manifold.
#[derive(Clone, Copy)]
struct ManifoldPoint<F> {
    slot: Slot<F>,
    place: Place,
    parts: (u32, u32),
    features: (u32, u32),
}

fn in_order(first: ShapeId, second: ShapeId) -> (ShapeId, ShapeId) {
    (first.min(second), first.max(second))
}
