//! What bounds the friction of a contact: a circle or an ellipse of forces.
//!
//! Friction along two axes is `(λ₁/μ₁)² + (λ₂/μ₂)² ≤ λ_N²`, and takes the most of the power of slip. With the larger
//! μ and weights `κ_k = μ_k/μ` the ellipse of λ and s is the circle of `λ_k/κ_k` and `κ_k s_k`, whose products are
//! the same.

use gauss_runtime::configuration::VectorSpace;
use gauss_runtime::contact::Contact;
use gauss_runtime::real::{Real, largest_derivative};

use crate::dense::{norm, value};

/// The friction of a contact at a state.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Bounds<T = f64> {
    /// μ, or the bound f of dry friction: the larger of two.
    pub(crate) largest: T,
    /// κ: 1 where friction is the same along all tangents.
    pub(crate) weights: [T; 2],
}

impl<T: Real> Bounds<T> {
    /// From the bounds of all rows.
    pub(crate) fn of<V: VectorSpace<T>>(contact: &Contact, friction: &V) -> Self {
        let mut each = contact.tangent_rows().map(|row| friction.component(row));
        let first = each.next().unwrap_or(T::zero());
        let second = each.next().unwrap_or(first);
        let largest = if value(second) > value(first) { second } else { first };
        let weight = |bound: T| {
            let same = value(bound) == value(largest) && largest_derivative(bound - largest) == 0.0;
            if same { T::one() } else { bound / largest }
        };
        Self { largest, weights: [weight(first), weight(second)] }
    }

    /// The number that is no bound: negative, not finite, or zero along one of two axes alone, where nothing would hold
    /// what sticks along it.
    pub(crate) fn invalid(self) -> Option<f64> {
        let [a, b] = self.weights.map(|weight| value(weight * self.largest));
        let is_bound = |x: f64| x >= 0.0 && x.is_finite();
        let alone = (a == 0.0) != (b == 0.0);
        [a, b].into_iter().find(|x| !is_bound(*x)).or(alone.then_some(0.0))
    }

    /// What is known in values.
    pub(crate) fn values(self) -> Bounds {
        Bounds { largest: value(self.largest), weights: self.weights.map(value) }
    }

    fn is_circle(self) -> bool {
        self.weights.iter().all(|weight| value(*weight) == 1.0 && largest_derivative(*weight) == 0.0)
    }

    /// The direction of a slip on the circle.
    pub(crate) fn on_circle(self, along: [T; 2]) -> [T; 2] {
        if self.is_circle() { along } else { unit([along[0] * self.weights[0], along[1] * self.weights[1]]) }
    }

    /// The slip of a direction on the circle.
    pub(crate) fn slip_of(self, direction: [T; 2]) -> [T; 2] {
        if self.is_circle() {
            return direction;
        }
        unit([direction[0] / self.weights[0], direction[1] / self.weights[1]])
    }

    /// The force against a slip in this direction, of a unit normal force; or of dry friction.
    pub(crate) fn against(self, along: [T; 2]) -> [T; 2] {
        let [x, y] = self.on_circle(along);
        [-self.largest * (self.weights[0] * x), -self.largest * (self.weights[1] * y)]
    }

    /// The radius of the circle that a force is on.
    pub(crate) fn size(self, force: &[T]) -> T {
        norm(&self.force_on_circle(force))
    }

    /// The direction in which friction of this force gives way.
    pub(crate) fn gives_way(self, force: &[T]) -> Option<[T; 2]> {
        let on_circle = self.force_on_circle(force);
        let size = norm(&on_circle);
        (value(size) > 0.0).then(|| self.slip_of(on_circle.map(|f| -(f / size))))
    }

    fn force_on_circle(self, force: &[T]) -> [T; 2] {
        let at = |k: usize| force.get(k).map_or(T::zero(), |f| *f / self.weights[k]);
        [at(0), at(1)]
    }
}

fn unit<T: Real>(x: [T; 2]) -> [T; 2] {
    let size = norm(&x);
    x.map(|x| x / size)
}
