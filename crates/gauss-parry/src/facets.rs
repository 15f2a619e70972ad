//! Triangles of meshes and height fields, each with its neighbours.
//!
//! The library answers for every triangle alone, as if its edges were those of the surface. On a flat mesh a neighbour
//! of the triangle below is then an obstacle: its edge is near, and the normal leans from that edge to the body. A
//! normal may lean over an edge only as far as the surface bends away there, and over an edge without a neighbour as
//! far as it will.

use std::collections::HashMap;
use std::f64::consts::PI;

use parry3d_f64::bounding_volume::BoundingVolume;
use parry3d_f64::math::{Pose, Vector};
use parry3d_f64::query::details::NormalConstraints;
use parry3d_f64::query::{ContactManifold, DefaultQueryDispatcher, PersistentQueryDispatcher, Unsupported};
use parry3d_f64::shape::{Shape, Triangle};

/// Normals that differ by less than this are one: half of the digits, with room for the sums behind them.
const SAME: f64 = 1e-7;
/// A triangle whose height is less than this part of its longest edge has no normal beyond rounding.
const FLAT: f64 = 1e-12;

pub(crate) type Manifold = ContactManifold<(), ()>;

/// The triangles of a shape, by their numbers; `None` of one without area, whose edges are those of its neighbours.
pub(crate) struct Facets(Vec<Option<Facet>>);

/// A triangle among its neighbours.
#[derive(Clone, Copy)]
struct Facet {
    triangle: Triangle,
    normal: Vector,
    edges: [Edge; 3],
}

/// An edge of a triangle.
#[derive(Clone, Copy)]
struct Edge {
    /// In the plane of the triangle, normal to the edge.
    outward: Vector,
    /// Angles by which normals may lean over it, in radians: those in front of the triangle, and those behind it.
    leans: [f64; 2],
}

/// Both ends of an edge, bit by bit: meshes need not share their vertices by number.
type Ends = [[u64; 3]; 2];
/// Triangles at an edge, by number, with their corners that are not on it.
type Neighbours = HashMap<Ends, Vec<(usize, Vector)>>;

/// Corners of a triangle: those at its edges, each with the third.
const CORNERS: [[usize; 3]; 3] = [[0, 1, 2], [1, 2, 0], [2, 0, 1]];

impl Facets {
    /// The facets of a mesh or a height field.
    pub(crate) fn of(shape: &dyn Shape) -> Option<Self> {
        let triangles: Vec<Option<Triangle>> = match (shape.as_trimesh(), shape.as_heightfield()) {
            (Some(mesh), _) => mesh.triangles().map(Some).collect(),
            (None, Some(field)) => {
                let count = 2 * (field.heights().nrows() - 1) * (field.heights().ncols() - 1);
                (0..count as u32).map(|number| field.triangle_at_id(number)).collect()
            }
            (None, None) => return None,
        };
        let mut neighbours = Neighbours::new();
        for (number, triangle) in triangles.iter().enumerate().filter_map(|(i, triangle)| Some((i, (*triangle)?))) {
            let corners = [triangle.a, triangle.b, triangle.c];
            for [from, to, third] in CORNERS {
                neighbours.entry(ends(corners[from], corners[to])).or_default().push((number, corners[third]));
            }
        }
        let facet = |(number, triangle): (usize, &Option<Triangle>)| Facet::of(number, (*triangle)?, &neighbours);
        Some(Self(triangles.iter().enumerate().map(facet).collect()))
    }

    /// Finds where these triangles of a shape touch another one or come nearer than the reach, with the other at a pose
    /// in the axes of the shape. In the manifolds the shape is the second of both where `second` says so.
    pub(crate) fn touch(
        &self,
        shape: &dyn Shape,
        (other, at): (&dyn Shape, &Pose),
        (reach, second): (f64, bool),
        found: &mut Vec<Manifold>,
    ) -> Result<(), Unsupported> {
        let near = other.compute_aabb(at).loosened(reach);
        let mut numbers = Vec::new();
        if let Some(mesh) = shape.as_trimesh() {
            numbers.extend(mesh.bvh().intersect_aabb(&near));
        } else if let Some(field) = shape.as_heightfield() {
            field.map_elements_in_local_aabb(&near, &mut |number, _| numbers.push(number));
        }
        for number in numbers {
            let Some(Some(facet)) = self.0.get(number as usize) else { continue };
            let empty = || if second { Manifold::with_data(0, number, ()) } else { Manifold::with_data(number, 0, ()) };
            let mut manifold = empty();
            facet.ask((other, at), (reach, second), None, &mut manifold)?;
            if manifold.points.is_empty() {
                continue;
            }
            let asked = if second { manifold.local_n2 } else { manifold.local_n1 };
            let normal = facet.leaning(asked);
            if (normal - asked).length() > SAME {
                // The nearest point of a ball is then one of a neighbour.
                if other.as_ball().is_some() {
                    continue;
                }
                manifold = empty();
                facet.ask((other, at), (reach, second), Some(facet), &mut manifold)?;
            } else {
                let of_other = at.rotation.inverse() * -normal;
                (manifold.local_n1, manifold.local_n2) = if second { (of_other, normal) } else { (normal, of_other) };
            }
            found.push(manifold);
        }
        Ok(())
    }
}

impl Facet {
    fn of(number: usize, triangle: Triangle, neighbours: &Neighbours) -> Option<Self> {
        let corners = [triangle.a, triangle.b, triangle.c];
        let longest = CORNERS.iter().map(|[from, to, _]| (corners[*to] - corners[*from]).length()).fold(0.0, f64::max);
        let area = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
        let has_area = area.length() > FLAT * longest * longest;
        if !has_area {
            return None;
        }
        let normal = area.normalize();
        let edge = |[from, to, _]: [usize; 3]| {
            let along = (corners[to] - corners[from]).normalize();
            let outward = along.cross(normal).normalize();
            let mut leans = [PI; 2];
            for (other, third) in &neighbours[&ends(corners[from], corners[to])] {
                let across = *third - corners[from];
                let across = across - along * across.dot(along);
                // How far the neighbour bends away from the front. What lies on the triangle is no neighbour.
                let bends = (-across.dot(normal)).atan2(across.dot(outward));
                if *other != number && across.length() > FLAT * longest && bends.abs() < PI - SAME {
                    leans = [leans[0].min(bends.max(0.0)), leans[1].min((-bends).max(0.0))];
                }
            }
            Edge { outward, leans }
        };
        Some(Self { triangle, normal, edges: CORNERS.map(edge) })
    }

    /// Asks the library about this triangle, with its normals as they are or as they may be.
    fn ask(
        &self,
        (other, at): (&dyn Shape, &Pose),
        (reach, second): (f64, bool),
        normals: Option<&dyn NormalConstraints>,
        manifold: &mut Manifold,
    ) -> Result<(), Unsupported> {
        let (library, own) = (DefaultQueryDispatcher, &self.triangle);
        if second {
            library.contact_manifold_convex_convex(&at.inverse(), other, own, None, normals, reach, manifold)
        } else {
            library.contact_manifold_convex_convex(at, own, other, normals, None, reach, manifold)
        }
    }

    /// The normal nearest to one that leans no farther than it may.
    fn leaning(&self, normal: Vector) -> Vector {
        let up = normal.dot(self.normal);
        let (upright, side) = if up < 0.0 { (-self.normal, 1) } else { (self.normal, 0) };
        let across = normal - self.normal * up;
        let Some(towards) = across.try_normalize() else { return upright };
        let over = |edge: &&Edge| edge.outward.dot(towards);
        let edge = self.edges.iter().max_by(|a, b| over(a).total_cmp(&over(b))).unwrap_or(&self.edges[0]);
        let most = edge.leans[side];
        if across.length().atan2(up.abs()) <= most {
            return normal;
        }
        upright * most.cos() + towards * most.sin()
    }
}

impl NormalConstraints for Facet {
    fn project_local_normal_mut(&self, normal: &mut Vector) -> bool {
        *normal = self.leaning(*normal);
        true
    }
}

fn ends(a: Vector, b: Vector) -> Ends {
    // A zero has one sign.
    let bits = |v: Vector| [v.x, v.y, v.z].map(|x| (x + 0.0).to_bits());
    let mut ends = [bits(a), bits(b)];
    ends.sort_unstable();
    ends
}
