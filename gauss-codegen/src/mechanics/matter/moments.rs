//! Moments of a mass distribution: all that ∫·dm of products of affine fields can see of it.

use crate::algebra::{Expr, Graph};

use crate::mechanics::kinematics::turn::Turn;
use crate::mechanics::kinematics::vector::{Triple, add, cross, scale};
use crate::mechanics::matter::body::Body;

/// `1 → m`, `x → ∫x dm`, `x xᵀ → J = ∫x xᵀ dm`, about the pole and in the axes of whoever holds them.
#[derive(Clone, Copy)]
pub struct Moments<'g> {
    pub mass: Expr<'g>,
    pub first: Triple<'g>,
    pub second: [Triple<'g>; 3],
}

impl<'g> Moments<'g> {
    pub fn zero(graph: &'g Graph) -> Self {
        let zero = graph.zero();
        Self { mass: zero, first: [zero; 3], second: [[zero; 3]; 3] }
    }

    /// A particle at the pole.
    pub fn particle(mass: Expr<'g>) -> Self {
        Self { mass, ..Self::zero(mass.graph()) }
    }

    pub fn of_body(body: &Body<'g>) -> Self {
        Self { mass: body.mass, first: body.first_moment(), second: body.second_moment() }
    }

    pub fn is_zero(&self) -> bool {
        self.mass.is_zero() && self.first.iter().chain(self.second.iter().flatten()).all(|e| e.is_zero())
    }

    pub fn map(&self, f: impl Fn(Expr<'g>) -> Expr<'g>) -> Self {
        Self { mass: f(self.mass), first: self.first.map(&f), second: self.second.map(|row| row.map(&f)) }
    }

    pub fn plus(&self, other: &Self) -> Self {
        Self {
            mass: self.mass + other.mass,
            first: add(&self.first, &other.first),
            second: std::array::from_fn(|i| add(&self.second[i], &other.second[i])),
        }
    }

    /// Seen in the axes before the turns, the pole the same.
    pub fn turned(&self, turns: &[Turn<'g>]) -> Self {
        turns.iter().rev().fold(*self, |moments, turn| {
            let second = turn.tensor(&moments.second);
            Self { mass: moments.mass, first: turn.vector(&moments.first).map(Expr::group), second }
        })
    }

    /// About a pole from which the old one is at r: `∫(r + x)(r + x)ᵀ dm`.
    pub fn shifted(&self, r: &Triple<'g>) -> Self {
        let second = std::array::from_fn(|i| {
            std::array::from_fn(|j| {
                let mixed = r[i] * self.first[j] + self.first[i] * r[j];
                self.second[i][j] + mixed + self.mass * r[i] * r[j]
            })
        });
        Self { mass: self.mass, first: add(&self.first, &scale(self.mass, r)), second }
    }

    /// `I = tr(J) 1 − J`.
    pub fn inertia(&self) -> [Triple<'g>; 3] {
        let j = &self.second;
        std::array::from_fn(|i| {
            std::array::from_fn(|k| {
                if i == k { j[(i + 1) % 3][(i + 1) % 3] + j[(i + 2) % 3][(i + 2) % 3] } else { -j[i][k] }
            })
        })
    }

    /// `∫(v + ω × x) dm` without `m v`, and `∫x × (v + ω × x) dm`.
    pub fn momentum(&self, v: &Triple<'g>, omega: &Triple<'g>) -> (Triple<'g>, Triple<'g>) {
        let inertia = self.inertia();
        let spin: Triple<'g> = std::array::from_fn(|i| crate::mechanics::kinematics::vector::dot(&inertia[i], omega));
        (cross(omega, &self.first), add(&cross(&self.first, v), &spin))
    }
}
