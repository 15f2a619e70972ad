//! Random bodies that exist: drawn so that every rule of `kernel()` holds by construction.

use gauss_runtime::prelude::*;
use proptest::prelude::*;

/// Everything that a scene may name; a method for each field of the derived structs.
#[derive(Clone, Debug)]
pub struct Parameters {
    /// m.
    pub m: f64,
    /// c = G − O, body axes.
    pub c: [f64; 3],
    /// A diagonal inertia tensor about O that fits m and c.
    pub principal: [f64; 3],
    /// A full inertia tensor about O that fits m and c.
    pub full: [[f64; 3]; 3],
    /// Diagonal added mass.
    pub diagonal_fluid: [f64; 6],
    /// Full added mass.
    pub fluid: [[f64; 6]; 6],
    /// Gravity along −k₃.
    pub g: f64,
    /// Gravity in any direction.
    pub field: [f64; 3],
    /// Mass of the displaced fluid.
    pub displaced: f64,
    /// Centre of buoyancy, body axes.
    pub buoyancy: [f64; 3],
}

fn vector<T: Real>(v: [f64; 3]) -> Vector3<T> {
    Vector3::from(v.map(T::from_f64))
}

impl Parameters {
    /// m.
    pub fn mass<T: Real>(&self) -> T {
        T::from_f64(self.m)
    }
    /// c.
    pub fn center<T: Real>(&self) -> Vector3<T> {
        vector(self.c)
    }
    /// One moment for all axes, with O at G.
    pub fn spherical<T: Real>(&self) -> T {
        T::from_f64(self.principal[0])
    }
    /// Diagonal tensor.
    pub fn principal<T: Real>(&self) -> Vector3<T> {
        vector(self.principal)
    }
    /// Full tensor.
    pub fn inertia<T: Real>(&self) -> Matrix3<T> {
        Matrix3::from_fn(|i, j| T::from_f64(self.full[i][j]))
    }
    /// Diagonal added mass.
    pub fn diagonal_fluid<T: Real>(&self) -> Vector6<T> {
        Vector6::from(self.diagonal_fluid.map(T::from_f64))
    }
    /// Full added mass.
    pub fn fluid<T: Real>(&self) -> Matrix6<T> {
        Matrix6::from_fn(|i, j| T::from_f64(self.fluid[i][j]))
    }
    /// Vertical gravity.
    pub fn g<T: Real>(&self) -> T {
        T::from_f64(self.g)
    }
    /// Gravity as a vector.
    pub fn field<T: Real>(&self) -> Vector3<T> {
        vector(self.field)
    }
    /// Displaced mass.
    pub fn displaced<T: Real>(&self) -> T {
        T::from_f64(self.displaced)
    }
    /// Centre of buoyancy.
    pub fn buoyancy<T: Real>(&self) -> Vector3<T> {
        vector(self.buoyancy)
    }
}

/// L Lᵀ of a square matrix, mirrored so that it is symmetric to the last bit.
fn gram<const N: usize>(l: &[[f64; N]; N]) -> [[f64; N]; N] {
    std::array::from_fn(|i| {
        std::array::from_fn(|j| {
            let (a, b) = (i.min(j), i.max(j));
            (0..N).map(|k| l[a][k] * l[b][k]).sum()
        })
    })
}

/// The inertia tensor `tr(J) 1 − J` of second moments J.
fn tensor(j: &[[f64; 3]; 3]) -> [[f64; 3]; 3] {
    let trace = j[0][0] + j[1][1] + j[2][2];
    std::array::from_fn(|a| std::array::from_fn(|b| if a == b { trace - j[a][a] } else { -j[a][b] }))
}

prop_compose! {
    /// Random parameters of order 1.
    pub fn parameters()(
        m in 0.2..4.0_f64,
        c in prop::array::uniform3(-0.7..0.7_f64),
        spread in prop::array::uniform3(0.1..1.5_f64),
        shape in prop::array::uniform3(prop::array::uniform3(-0.7..0.7_f64)),
        diagonal_fluid in prop::array::uniform6(0.0..3.0_f64),
        flow in prop::array::uniform6(prop::array::uniform6(-1.0..1.0_f64)),
        g in 1.0..10.0_f64,
        field in prop::array::uniform3(-9.0..9.0_f64),
        displaced in 0.0..5.0_f64,
        buoyancy in prop::array::uniform3(-0.7..0.7_f64),
    ) -> Parameters {
        // About O, J = J_G + m c cᵀ. J_G = S Sᵀ + diag(spread) is positive definite, so the tensor obeys every rule.
        let mut full = gram(&shape);
        for a in 0..3 {
            for b in 0..3 {
                full[a][b] += m * (c[a] * c[b]);
            }
            full[a][a] += spread[a];
        }
        // A diagonal J needs J − m c cᵀ ≥ 0: (Σ c_i x_i)² ≤ 3 Σ c_i² x_i².
        let mut diagonal = [[0.0; 3]; 3];
        for a in 0..3 {
            diagonal[a][a] = spread[a] + 3.0 * m * c[a] * c[a];
        }
        let principal = tensor(&diagonal);
        Parameters {
            m,
            c,
            principal: std::array::from_fn(|a| principal[a][a]),
            full: tensor(&full),
            diagonal_fluid,
            fluid: gram(&flow),
            g,
            field,
            displaced,
            buoyancy,
        }
    }
}
