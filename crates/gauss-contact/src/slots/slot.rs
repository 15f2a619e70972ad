//! The data of one slot, and what they must be.

use core::fmt;

use gauss_runtime::__crates_0_1_0::{Triple, cross, scaled, sub, triple};
use gauss_runtime::nalgebra::Vector3;
use gauss_runtime::real::Real;

/// A point, or a sphere about it, that may touch a plane, with friction and restitution. Lengths are in the unit of the
/// scene.
///
/// `F` names the frames of a kernel (`KernelFrame` of `frames(…)`); `None` is what is at rest: axes of the observer,
/// places from Ω. The contact force acts on the body of the point along the normal, and back on that of the plane. `T`
/// is the scalar of the kernel: lanes have data of their own, and derivatives may be those by a datum.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slot<F, T = f64> {
    /// The frame with the point.
    pub first: Option<F>,
    /// The point, from the origin of `first` in its axes.
    pub point: Vector3<T>,
    /// The radius of a sphere about the point; 0 where it is the point that touches.
    pub radius: T,
    /// The frame with the plane.
    pub second: Option<F>,
    /// A point of the plane, from the origin of `second` in its axes.
    pub origin: Vector3<T>,
    /// Out of the plane, towards the point where the gap is open, in the axes of `second`; of any length but 0.
    pub normal: Vector3<T>,
    /// μ of Coulomb's friction, the same along all tangents.
    pub friction: T,
    /// e of Newton's law, from 0 to 1.
    pub restitution: T,
}

/// A slot whose data are refused.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct SlotError {
    /// Its number.
    pub slot: usize,
    /// Which of its fields.
    pub field: SlotField,
    /// Value of the field: of a vector its length, of frames and numbers of slots how many.
    pub value: f64,
    /// Rule that the field breaks.
    pub rule: SlotRule,
}

/// A field of a slot.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum SlotField {
    /// The number of the slot itself.
    Number,
    /// [`Slot::first`] and [`Slot::second`].
    Frames,
    /// [`Slot::point`].
    Point,
    /// [`Slot::radius`].
    Radius,
    /// [`Slot::origin`].
    Origin,
    /// [`Slot::normal`].
    Normal,
    /// [`Slot::friction`].
    Friction,
    /// [`Slot::restitution`].
    Restitution,
}

/// Rules for a field.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum SlotRule {
    /// Less than so many slots as there are.
    Below {
        /// Number of slots.
        count: usize,
    },
    /// Two different ones, of which one may be at rest.
    Different,
    /// Finite.
    Finite,
    /// Finite, and longer than 0.
    Direction,
    /// Finite and not negative.
    NotNegative,
    /// From 0 to 1.
    UpToOne,
}

impl fmt::Display for SlotError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { slot, field, value, rule } = self;
        let name = match field {
            SlotField::Number => return write!(f, "slot {slot}: {rule}"),
            SlotField::Frames => return write!(f, "slot {slot}: its frames must be {rule}"),
            SlotField::Point => "point",
            SlotField::Radius => "radius",
            SlotField::Origin => "origin",
            SlotField::Normal => "normal",
            SlotField::Friction => "friction",
            SlotField::Restitution => "restitution",
        };
        let is_vector = matches!(field, SlotField::Point | SlotField::Origin | SlotField::Normal);
        let of = if is_vector { "has the length" } else { "is" };
        write!(f, "slot {slot}: `{name}` {of} {value}; it must be {rule}")
    }
}

impl fmt::Display for SlotRule {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Below { count } => write!(f, "there are {count}; give the system more, or ask for fewer points"),
            Self::Different => f.write_str("two, of which one may be at rest"),
            Self::Finite => f.write_str("finite"),
            Self::Direction => f.write_str("finite and longer than 0"),
            Self::NotNegative => f.write_str("finite and not negative"),
            Self::UpToOne => f.write_str("from 0 to 1"),
        }
    }
}

impl core::error::Error for SlotError {}

impl<F: Copy + PartialEq, T: Real> Slot<F, T> {
    /// The slot in another scalar.
    #[must_use]
    pub fn map<U: Real>(&self, mut number: impl FnMut(T) -> U) -> Slot<F, U> {
        let Self { first, point, radius, second, origin, normal, friction, restitution } = self;
        let mut vector = |vector: &Vector3<T>| Vector3::from(vector.data.0[0].map(&mut number));
        let (point, origin, normal) = (vector(point), vector(origin), vector(normal));
        let [radius, friction, restitution] = [*radius, *friction, *restitution].map(number);
        Slot { first: *first, point, radius, second: *second, origin, normal, friction, restitution }
    }

    /// The slot with a normal of length one, or the error in it.
    pub(super) fn checked(&self, slot: usize) -> Result<Self, SlotError> {
        for lane in 0..T::LANES {
            self.map(|number| number.lane(lane)).check(slot)?;
        }
        Ok(Self { normal: of_length_one(triple(&self.normal)).into(), ..*self })
    }

    /// The normal, then two tangents.
    ///
    /// The first tangent is what of the first axis is normal to the normal, and of the second axis where that is
    /// little: between neighbouring normals it jumps at |n₁| = 0.8 alone, where no face of a box that lies along the
    /// axes is, so that impulses along tangents of one step begin the next.
    pub(super) fn axes(&self) -> [Triple<T>; 3] {
        let (n, one) = (triple(&self.normal), T::one());
        let along = T::select_lt(n[0].abs(), T::from_f64(0.8), one, T::zero());
        let axis = [along, one - along, T::zero()];
        let first = of_length_one(sub(axis, scaled(dot(n, axis), n)));
        [n, first, cross(n, first)]
    }
}

impl<F: Copy + PartialEq> Slot<F> {
    fn check(&self, slot: usize) -> Result<(), SlotError> {
        let refuse = |field, value, rule| Err(SlotError { slot, field, value, rule });
        if self.first == self.second {
            return refuse(SlotField::Frames, 1.0, SlotRule::Different);
        }
        for (field, vector) in [(SlotField::Point, &self.point), (SlotField::Origin, &self.origin)] {
            if !vector.iter().all(|x| x.is_finite()) {
                return refuse(field, length(vector), SlotRule::Finite);
            }
        }
        let size = length(&self.normal);
        if !(size > 0.0 && size.is_finite()) {
            return refuse(SlotField::Normal, size, SlotRule::Direction);
        }
        for (field, value) in [(SlotField::Radius, self.radius), (SlotField::Friction, self.friction)] {
            if !(value >= 0.0 && value.is_finite()) {
                return refuse(field, value, SlotRule::NotNegative);
            }
        }
        if !(0.0..=1.0).contains(&self.restitution) {
            return refuse(SlotField::Restitution, self.restitution, SlotRule::UpToOne);
        }
        Ok(())
    }
}

/// a · b, each product rounded: what is symmetric stays so.
pub(super) fn dot<T: Real>(a: Triple<T>, b: Triple<T>) -> T {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// A vector over its length; its squares neither overflow nor vanish.
fn of_length_one<T: Real>(x: Triple<T>) -> Triple<T> {
    let largest = x.into_iter().fold(T::zero(), |largest, x| largest.max(x.abs()));
    let part = x.map(|x| x / largest);
    let length = largest * dot(part, part).sqrt();
    x.map(|x| x / length)
}

/// The length of a vector whose squares neither overflow nor vanish.
fn length(vector: &Vector3<f64>) -> f64 {
    let largest = vector.iter().fold(0.0, |largest: f64, x| if x.is_nan() { f64::NAN } else { largest.max(x.abs()) });
    if !(largest > 0.0 && largest.is_finite()) {
        return largest;
    }
    let squares: f64 = vector.iter().map(|x| (x / largest) * (x / largest)).sum();
    largest * Real::sqrt(squares)
}

#[cfg(test)]
mod tests {
    use super::*;
    use gauss_runtime::simd::Lanes;

    fn slot() -> Slot<u8> {
        Slot {
            first: Some(1),
            point: Vector3::zeros(),
            radius: 0.0,
            second: None,
            origin: Vector3::zeros(),
            normal: Vector3::new(0.0, 0.0, 1.0),
            friction: 0.5,
            restitution: 0.0,
        }
    }

    #[test]
    fn mistakes_are_told_with_field_and_value() {
        let nan = f64::NAN;
        let cases = [
            (Slot { first: None, ..slot() }, SlotField::Frames, 1.0, SlotRule::Different),
            (Slot { second: Some(1), ..slot() }, SlotField::Frames, 1.0, SlotRule::Different),
            (
                Slot { point: Vector3::repeat(f64::INFINITY), ..slot() },
                SlotField::Point,
                f64::INFINITY,
                SlotRule::Finite,
            ),
            (Slot { origin: Vector3::new(0.0, nan, 1.0), ..slot() }, SlotField::Origin, nan, SlotRule::Finite),
            (Slot { normal: Vector3::zeros(), ..slot() }, SlotField::Normal, 0.0, SlotRule::Direction),
            (Slot { radius: -2.0, ..slot() }, SlotField::Radius, -2.0, SlotRule::NotNegative),
            (Slot { friction: -1.0, ..slot() }, SlotField::Friction, -1.0, SlotRule::NotNegative),
            (Slot { friction: nan, ..slot() }, SlotField::Friction, nan, SlotRule::NotNegative),
            (Slot { restitution: 1.5, ..slot() }, SlotField::Restitution, 1.5, SlotRule::UpToOne),
        ];
        for (slot, field, value, rule) in cases {
            let error = slot.checked(3).unwrap_err();
            assert_eq!((error.slot, error.field, error.rule), (3, field, rule));
            assert!(error.value == value || error.value.is_nan() && value.is_nan(), "{error}");
            // One lane that is wrong is as well.
            let mut lanes = slot.map(Lanes::<f64, 4>::splat);
            let good = self::slot();
            lanes.friction.0[..2].copy_from_slice(&[good.friction; 2]);
            let error = lanes.checked(3).unwrap_err();
            assert_eq!((error.field, error.rule), (field, rule));
        }
    }

    #[test]
    fn axes_are_orthonormal_for_normals_of_any_length() {
        for normal in [[0.0, 0.0, 1e-200], [1e200, 3.0, 2.0], [1.0, 1.0, 1.0], [-0.79, 0.1, -0.6], [0.0, -1.0, 1e-17]] {
            let axes = Slot { normal: Vector3::from(normal), ..slot() }.checked(0).unwrap().axes();
            let [n, a, b] = axes.map(Vector3::from);
            // Each product has three terms of at most 1, of numbers that were rounded some times.
            let products = [n.dot(&n) - 1.0, a.dot(&a) - 1.0, b.dot(&b) - 1.0, n.dot(&a), n.dot(&b), a.dot(&b)];
            assert!(products.iter().all(|x| x.abs() <= 32.0 * f64::EPSILON), "{normal:?} {products:?}");
            assert!((n.cross(&a) - b).amax() <= 32.0 * f64::EPSILON);
        }
    }
}
