//! Vectors of the observer's space, each part held in the frame where it is natural.

use crate::algebra::{Expr, Graph, Map};

/// Three components.
pub type Triple<'g> = [Expr<'g>; 3];

/// The body frame e seen from the observer frame k: `R_ij = k_i · e_j`, and the angular velocity, so that vectors can
/// be turned and differentiated (Poisson: ė_k = ω × e_k, k̇_k = 0).
#[derive(Clone)]
pub struct Frame<'g> {
    pub graph: &'g Graph,
    pub rotation: [Triple<'g>; 3],
}

/// `Σ bodyᵢ eᵢ + Σ spaceᵢ kᵢ`. Adding, scaling and differentiating never turn a part from one frame to the other, so a
/// weight stays `−m g k₃` until somebody asks for its components in the body, and R Rᵀ is never formed.
#[derive(Clone, Copy, Debug)]
pub struct Vector<'g> {
    pub body: Triple<'g>,
    pub space: Triple<'g>,
}

/// Motion of a body: its frame, the velocity of O and the angular velocity.
#[cfg(test)]
pub struct BodyMotion<'a, 'g> {
    pub frame: &'a Frame<'g>,
    pub velocity: &'a Vector<'g>,
    pub angular_velocity: &'a Vector<'g>,
}

/// A frame in which components are resolved.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Axes {
    Body,
    Space,
}

pub fn dot<'g>(a: &Triple<'g>, b: &Triple<'g>) -> Expr<'g> {
    (0..3).map(|i| a[i] * b[i]).sum()
}

pub fn cross<'g>(a: &Triple<'g>, b: &Triple<'g>) -> Triple<'g> {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// `[a]×`, the matrix with `[a]× b = a × b`.
pub fn cross_matrix<'g>(a: &Triple<'g>) -> [Triple<'g>; 3] {
    let zero = a[0].graph().zero();
    [[zero, -a[2], a[1]], [a[2], zero, -a[0]], [-a[1], a[0], zero]]
}

pub fn is_zero(a: &Triple<'_>) -> bool {
    a.iter().all(|e| e.is_zero())
}

pub fn add<'g>(a: &Triple<'g>, b: &Triple<'g>) -> Triple<'g> {
    std::array::from_fn(|i| a[i] + b[i])
}

pub fn subtract<'g>(a: &Triple<'g>, b: &Triple<'g>) -> Triple<'g> {
    std::array::from_fn(|i| a[i] - b[i])
}

pub fn scale<'g>(factor: Expr<'g>, a: &Triple<'g>) -> Triple<'g> {
    a.map(|e| factor * e)
}

/// `matrix · a` for the 3×3 block of a larger matrix that starts at (row, column).
pub fn apply_block<'g>(matrix: &[Vec<Expr<'g>>], row: usize, column: usize, a: &Triple<'g>) -> Triple<'g> {
    std::array::from_fn(|i| (0..3).map(|j| matrix[row + i][column + j] * a[j]).sum())
}

impl<'g> Frame<'g> {
    /// Rᵀ a: from observer's components to the body's.
    pub fn to_body(&self, a: &Triple<'g>) -> Triple<'g> {
        std::array::from_fn(|j| (0..3).map(|i| self.rotation[i][j] * a[i]).sum())
    }

    /// R a: from the body's components to the observer's.
    pub fn to_space(&self, a: &Triple<'g>) -> Triple<'g> {
        std::array::from_fn(|i| (0..3).map(|j| self.rotation[i][j] * a[j]).sum())
    }

    pub fn zero(&self) -> Vector<'g> {
        let zero = [self.graph.zero(); 3];
        Vector { body: zero, space: zero }
    }

    pub fn body_vector(&self, body: Triple<'g>) -> Vector<'g> {
        Vector { body, ..self.zero() }
    }

    pub fn space_vector(&self, space: Triple<'g>) -> Vector<'g> {
        Vector { space, ..self.zero() }
    }

    /// All components in one frame; what had to be turned becomes a quantity computed once.
    pub fn resolve(&self, a: &Vector<'g>, axes: Axes) -> Triple<'g> {
        let (own, other) = match axes {
            Axes::Body => (&a.body, &a.space),
            Axes::Space => (&a.space, &a.body),
        };
        if is_zero(other) {
            return *own;
        }
        // Dividing a common factor out first (a mass, say) keeps it visible through the rotation.
        let grouped = other.map(Expr::group);
        let turned = match axes {
            Axes::Body => self.to_body(&grouped),
            Axes::Space => self.to_space(&grouped),
        };
        // A component along the axis of rotation is not turned: it stays the sum that it was.
        let turned = std::array::from_fn(|i| if turned[i] == grouped[i] { other[i] } else { turned[i].group() });
        add(own, &turned)
    }

    /// Turns whichever of two vectors costs less, so that both have parts in one frame only.
    fn common(&self, a: &Vector<'g>, b: &Vector<'g>) -> (Axes, Triple<'g>, Triple<'g>) {
        let weight = |v: &Triple<'g>| v.iter().filter(|e| !e.is_zero()).count();
        let axes = if weight(&a.body) + weight(&b.body) >= weight(&a.space) + weight(&b.space) {
            Axes::Body
        } else {
            Axes::Space
        };
        (axes, self.resolve(a, axes), self.resolve(b, axes))
    }

    pub fn cross(&self, a: &Vector<'g>, b: &Vector<'g>) -> Vector<'g> {
        match self.common(a, b) {
            (Axes::Body, a, b) => self.body_vector(cross(&a, &b)),
            (Axes::Space, a, b) => self.space_vector(cross(&a, &b)),
        }
    }

    pub fn dot(&self, a: &Vector<'g>, b: &Vector<'g>) -> Expr<'g> {
        let (_, a, b) = self.common(a, b);
        dot(&a, &b)
    }

    /// The observer's derivative: components along the flow, and ω × for the part that turns with the body.
    pub fn derivative(&self, a: &Vector<'g>, rates: &Map<u32, Expr<'g>>, angular_velocity: &Vector<'g>) -> Vector<'g> {
        let components =
            Vector { body: a.body.map(|e| e.derivative(rates)), space: a.space.map(|e| e.derivative(rates)) };
        if is_zero(&a.body) {
            return components;
        }
        components.plus(&self.cross(angular_velocity, &self.body_vector(a.body)))
    }
}

impl<'g> Vector<'g> {
    pub fn plus(&self, other: &Self) -> Self {
        Self { body: add(&self.body, &other.body), space: add(&self.space, &other.space) }
    }

    pub fn minus(&self, other: &Self) -> Self {
        Self { body: subtract(&self.body, &other.body), space: subtract(&self.space, &other.space) }
    }

    pub fn times(&self, factor: Expr<'g>) -> Self {
        Self { body: scale(factor, &self.body), space: scale(factor, &self.space) }
    }

    pub fn map(&self, f: impl Fn(Expr<'g>) -> Expr<'g>) -> Self {
        Self { body: self.body.map(&f), space: self.space.map(&f) }
    }

    /// Derivative of the components with respect to a quasi-velocity, the frame held fixed.
    pub fn partial(&self, symbol: Expr<'g>) -> Self {
        self.map(|e| e.partial(symbol))
    }
}
