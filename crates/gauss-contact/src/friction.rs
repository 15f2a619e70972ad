//! Bounds of the friction of a contact: a circle, an ellipse or an ellipsoid of forces.
//!
//! Friction along two axes is `(λ₁/μ₁)² + (λ₂/μ₂)² ≤ λ_N²`, and takes the most of the power of slip; with friction of
//! drilling `(λ₃/μ₃)²` is a term more. With the largest μ and weights `κ_k = μ_k/μ` the ellipse of λ and s is the
//! circle of `λ_k/κ_k` and `κ_k s_k`, whose products are the same; of three rows it is a sphere.

use gauss_runtime::configuration::VectorSpace;
use gauss_runtime::contact::Contact;
use gauss_runtime::real::{Real, largest_derivative};

use crate::dense::{norm, value};

/// The friction of a contact at a state.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Bounds<T = f64> {
    /// μ, or the bound f of dry friction: the largest.
    pub(crate) largest: T,
    /// κ: 1 where friction is the same along all tangents.
    pub(crate) weights: [T; 3],
}

/// The number that is no bound of friction: negative, not finite, or zero along some of the axes alone, where nothing
/// would hold what sticks along them. Of several lanes that of the first that has one.
pub(crate) fn invalid<T: Real, V: VectorSpace<T>>(contact: &Contact, friction: &V) -> Option<f64> {
    let of_lane = |lane: usize| {
        let each = || contact.friction_rows().map(|row| friction.component(row).lane(lane));
        let is_bound = |x: f64| x >= 0.0 && x.is_finite();
        let alone = each().any(|x| x == 0.0) && each().any(|x| x != 0.0);
        each().find(|x| !is_bound(*x)).or(alone.then_some(0.0))
    };
    (0..T::LANES).find_map(of_lane)
}

impl<T: Real> Bounds<T> {
    /// From the bounds of all rows.
    pub(crate) fn of<V: VectorSpace<T>>(contact: &Contact, friction: &V) -> Self {
        let mut each = contact.friction_rows().map(|row| friction.component(row));
        let first = each.next().unwrap_or(T::zero());
        let (second, third) = (each.next().unwrap_or(first), each.next().unwrap_or(first));
        let larger = |a: T, b: T| if value(b) > value(a) { b } else { a };
        let largest = larger(larger(first, second), third);
        let weight = |bound: T| {
            let same = value(bound) == value(largest) && largest_derivative(bound - largest) == 0.0;
            if same { T::one() } else { bound / largest }
        };
        Self { largest, weights: [weight(first), weight(second), weight(third)] }
    }

    /// The same bounds in other numbers.
    pub(crate) fn in_numbers<U>(self, number: impl Fn(T) -> U) -> Bounds<U> {
        Bounds { largest: number(self.largest), weights: self.weights.map(number) }
    }

    /// The same bounds without derivatives.
    pub(crate) fn values(self) -> Bounds {
        self.in_numbers(value)
    }

    fn is_circle(self) -> bool {
        self.weights.iter().all(|weight| value(*weight) == 1.0 && largest_derivative(*weight) == 0.0)
    }

    /// The direction of a slip on the circle.
    pub(crate) fn on_circle(self, along: [T; 3]) -> [T; 3] {
        if self.is_circle() { along } else { unit(core::array::from_fn(|k| along[k] * self.weights[k])) }
    }

    /// The slip of a direction on the circle.
    pub(crate) fn slip_of(self, direction: [T; 3]) -> [T; 3] {
        if self.is_circle() {
            return direction;
        }
        unit(core::array::from_fn(|k| direction[k] / self.weights[k]))
    }

    /// The force against a slip in this direction, of a unit normal force; or of dry friction.
    pub(crate) fn against(self, along: [T; 3]) -> [T; 3] {
        let on_circle = self.on_circle(along);
        core::array::from_fn(|k| -self.largest * (self.weights[k] * on_circle[k]))
    }

    /// The radius of the circle that a force is on.
    pub(crate) fn size(self, force: &[T]) -> T {
        norm(&self.force_on_circle(force))
    }

    /// The direction in which friction of this force gives way.
    pub(crate) fn gives_way(self, force: &[T]) -> Option<[T; 3]> {
        let on_circle = self.force_on_circle(force);
        let size = norm(&on_circle);
        (value(size) > 0.0).then(|| self.slip_of(on_circle.map(|f| -(f / size))))
    }

    fn force_on_circle(self, force: &[T]) -> [T; 3] {
        let at = |k: usize| force.get(k).map_or(T::zero(), |f| *f / self.weights[k]);
        [at(0), at(1), at(2)]
    }
}

fn unit<T: Real>(x: [T; 3]) -> [T; 3] {
    let size = norm(&x);
    x.map(|x| x / size)
}
