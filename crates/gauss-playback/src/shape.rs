//! Shapes of bodies, as the page shows them.

use gauss_runtime::prelude::{Isometry3, Matrix3, Translation3, UnitQuaternion, Vector3};
use serde::Serialize;

/// A solid fixed in a body. Two shades in eight parts of it show how it turns.
#[derive(Clone, Debug, Serialize)]
pub struct Shape {
    kind: Kind,
    /// Half lengths along the axes of the shape.
    size: [f64; 3],
    /// In body axes from O: position, then the quaternion i, j, k, w.
    pose: [f64; 7],
    #[serde(skip_serializing_if = "Option::is_none")]
    colour: Option<String>,
}

#[derive(Clone, Copy, Debug, Serialize)]
#[serde(rename_all = "lowercase")]
enum Kind {
    Ellipsoid,
    Cuboid,
    Cylinder,
}

impl Shape {
    fn new(kind: Kind, size: [f64; 3]) -> Self {
        Self { kind, size, pose: pose(&Isometry3::identity()), colour: None }
    }

    /// A box about O, by its edges along e₁, e₂, e₃.
    #[must_use]
    pub fn cuboid(edges: [f64; 3]) -> Self {
        Self::new(Kind::Cuboid, edges.map(|edge| edge / 2.0))
    }

    /// A ball about O.
    #[must_use]
    pub fn ball(radius: f64) -> Self {
        Self::ellipsoid([radius; 3])
    }

    /// An ellipsoid about O, by its semi-axes along e₁, e₂, e₃.
    #[must_use]
    pub fn ellipsoid(semi_axes: [f64; 3]) -> Self {
        Self::new(Kind::Ellipsoid, semi_axes)
    }

    /// A cylinder about O, along e₃.
    #[must_use]
    pub fn cylinder(radius: f64, length: f64) -> Self {
        Self::elliptic_cylinder([radius; 2], length)
    }

    /// A cylinder about O, along e₃, by the semi-axes of its cross-section along e₁ and e₂.
    #[must_use]
    pub fn elliptic_cylinder(semi_axes: [f64; 2], length: f64) -> Self {
        Self::new(Kind::Cylinder, [semi_axes[0], semi_axes[1], length / 2.0])
    }

    /// A cylinder between two points, body axes from O.
    #[must_use]
    pub fn rod(from: [f64; 3], to: [f64; 3], radius: f64) -> Self {
        let (from, to) = (Vector3::from(from), Vector3::from(to));
        let along = to - from;
        let turn = UnitQuaternion::rotation_between(&Vector3::z(), &along)
            .unwrap_or_else(|| UnitQuaternion::from_axis_angle(&Vector3::x_axis(), std::f64::consts::PI));
        Self::cylinder(radius, along.norm()).at(&Isometry3::from_parts(Translation3::from((from + to) / 2.0), turn))
    }

    /// The ellipsoid of uniform density with this mass, centre of mass c (body axes from O), and inertia about c (body
    /// axes): what can be drawn of a body of which only these are known. Its semi-axes obey `m (b² + c²)/5 = I₁` and so
    /// on.
    ///
    /// A moment that exceeds the sum of the two others belongs to no body; the semi-axis is drawn as if it did not. An
    /// inertia that is not finite, or a mass that is not positive, has a shape that a page refuses.
    #[must_use]
    pub fn of_inertia(mass: f64, center: [f64; 3], inertia: &Matrix3<f64>) -> Self {
        // With a number that is not finite, or whose square is not, the iteration would never end.
        if !inertia.iter().all(|moment| (moment * moment).is_finite()) {
            return Self::ball(f64::NAN);
        }
        let principal = inertia.symmetric_eigen();
        let sum = principal.eigenvalues.sum();
        let semi_axes = principal.eigenvalues.map(|moment| (2.5 / mass * (sum - 2.0 * moment)).max(0.0).sqrt());
        let mut axes = principal.eigenvectors;
        if axes.determinant() < 0.0 {
            axes.column_mut(2).neg_mut();
        }
        let turn = UnitQuaternion::from_matrix(&axes);
        let place = Isometry3::from_parts(Translation3::from(Vector3::from(center)), turn);
        Self::ellipsoid(semi_axes.into()).at(&place)
    }

    /// The shape with its O and its axes at this pose, in body axes from O of the body.
    #[must_use]
    pub fn at(mut self, place: &Isometry3<f64>) -> Self {
        self.pose = pose(place);
        self
    }

    /// In a colour of CSS, such as `"#0072b2"`, in place of the one that the body has by its order.
    #[must_use]
    pub fn colour(mut self, colour: &str) -> Self {
        self.colour = Some(colour.to_owned());
        self
    }

    /// Whether all numbers can be shown.
    pub(crate) fn can_be_shown(&self) -> bool {
        can_be_shown(&self.size) && can_be_shown(&self.pose)
    }
}

/// Whether numbers can be shown: finite as `f32`, as which the page has poses and arrows. Half of the largest `f32` is
/// the limit, so that rounding stays below it and differences of two are finite as well.
pub fn can_be_shown(numbers: &[f64]) -> bool {
    numbers.iter().all(|number| number.abs() <= f64::from(f32::MAX / 2.0))
}

/// Position and quaternion.
pub fn pose(pose: &Isometry3<f64>) -> [f64; 7] {
    let (b, turn) = (pose.translation.vector, pose.rotation.coords);
    [b.x, b.y, b.z, turn.x, turn.y, turn.z, turn.w]
}
