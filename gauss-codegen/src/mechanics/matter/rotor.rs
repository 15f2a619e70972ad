//! Rotors: inertia of a rate. What turns with a coordinate by a gear, and is so small and symmetric that nothing else
//! is seen of it (the armature of a motor), has `T = ½ a q̇²`: formal matter that moves on a line of its own, at q. Of
//! a rotation there are three, one for each component of ω, of which a ω² needs no more since ω × a ω = 0; of a pose
//! six, with the velocity in observer's axes.

use crate::algebra::{Expr, Map};

/// `½ a q̇²`.
#[derive(Clone, Copy)]
pub struct Rotor<'g> {
    /// q̇, affine in z.
    pub rate: Expr<'g>,
    /// a.
    pub inertia: Expr<'g>,
}

impl<'g> Rotor<'g> {
    /// ∂q̇/∂z^α.
    pub fn row(&self, speed: Expr<'g>) -> Expr<'g> {
        self.rate.partial(speed)
    }

    /// ∂T/∂q̇.
    pub fn momentum(&self) -> Expr<'g> {
        self.inertia * self.rate
    }

    /// a q̈, with ż by its rates in `along`.
    pub fn force(&self, along: &Map<u32, Expr<'g>>) -> Expr<'g> {
        self.inertia * self.rate.derivative(along).group()
    }
}

/// Adds `Σ of(rotor) ∂q̇/∂z^α` to the rows.
pub fn add_projected<'g>(
    rotors: &[Rotor<'g>],
    speeds: &[Expr<'g>],
    mut rows: Vec<Expr<'g>>,
    of: impl Fn(&Rotor<'g>) -> Expr<'g>,
) -> Vec<Expr<'g>> {
    for rotor in rotors {
        let value = of(rotor);
        for (row, &speed) in rows.iter_mut().zip(speeds) {
            let own = rotor.row(speed);
            if !own.is_zero() {
                *row = *row + value * own;
            }
        }
    }
    rows
}
