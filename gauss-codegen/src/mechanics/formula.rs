//! The expressions that each method of a kernel is made from.

use crate::algebra::Expr;

use crate::methods::Methods;
pub use crate::methods::{FrameQuantity, Method};

/// Equal outputs of one method, formed in different ways: the kernel takes the one that costs least of those that keep
/// the digits.
pub type Arrangements<'g> = Vec<Vec<Expr<'g>>>;

/// The arrangements of every method.
pub type Formulas<'g> = Methods<Arrangements<'g>>;

/// The arrangements of one method that not every kernel has.
#[derive(Clone)]
pub struct Formula<'g> {
    pub method: Method,
    pub arrangements: Arrangements<'g>,
}

impl<'g> Formulas<'g> {
    /// No arrangement of any method.
    pub fn none() -> Self {
        Self {
            kinematics: Vec::new(),
            acceleration: Vec::new(),
            momentum: Vec::new(),
            velocity: Vec::new(),
            momentum_rate: Vec::new(),
            mass_matrix: Vec::new(),
            kinetic_energy: Vec::new(),
            potential_energy: Vec::new(),
            gauss_residual: Vec::new(),
            constraint_function: Vec::new(),
            others: Vec::new(),
        }
    }

    /// Adds arrangements of each method behind those that are there.
    pub fn add(&mut self, further: Self) {
        self.kinematics.extend(further.kinematics);
        self.acceleration.extend(further.acceleration);
        self.momentum.extend(further.momentum);
        self.velocity.extend(further.velocity);
        self.momentum_rate.extend(further.momentum_rate);
        self.mass_matrix.extend(further.mass_matrix);
        self.kinetic_energy.extend(further.kinetic_energy);
        self.potential_energy.extend(further.potential_energy);
        self.gauss_residual.extend(further.gauss_residual);
        self.constraint_function.extend(further.constraint_function);
        self.others.extend(further.others);
    }

    /// Adds methods behind those that are there.
    pub fn extend(&mut self, formulas: impl IntoIterator<Item = Formula<'g>>) {
        self.others.extend(formulas.into_iter().map(|Formula { method, arrangements }| (method, arrangements)));
    }
}
