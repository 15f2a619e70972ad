//! What a motion conserves, from pose, twist, momentum and energy alone: the same code for every chart.

use gauss_runtime::prelude::*;

use crate::scene::Parameters;

/// All that the first integrals are made of, at one time.
#[derive(Clone, Copy, Debug)]
pub struct Moment {
    /// (R, b).
    pub pose: Isometry3<f64>,
    /// Angular velocity, body axes.
    pub omega: Vector3<f64>,
    /// Q of body and fluid, body axes.
    pub linear: Vector3<f64>,
    /// Γ_O of body and fluid, body axes.
    pub angular: Vector3<f64>,
    /// T.
    pub kinetic: f64,
    /// V.
    pub potential: f64,
}

impl Moment {
    /// At a state of a kernel.
    pub fn of<B: RigidBodySystem<Scalar = f64>>(kernel: &B, t: f64, q: &B::Configuration, z: &B::Speeds) -> Self {
        let (twist, momentum) = (kernel.body_twist(t, q, z), kernel.body_momentum(t, q, z));
        Self {
            pose: kernel.pose(t, q),
            omega: Vector3::new(twist[3], twist[4], twist[5]),
            linear: Vector3::new(momentum[0], momentum[1], momentum[2]),
            angular: Vector3::new(momentum[3], momentum[4], momentum[5]),
            kinetic: kernel.kinetic_energy(t, q, z),
            potential: kernel.potential_energy(t, q),
        }
    }

    /// The integral of a name, and the size of the terms that it is the sum of: rounding is relative to that.
    ///
    /// # Panics
    /// When the name is not known: a scene would go unchecked.
    #[must_use]
    pub fn integral(&self, name: &str, parameters: &Parameters) -> (Vec<f64>, f64) {
        let rotation = &self.pose.rotation;
        let b = self.pose.translation.vector;
        let linear = rotation * self.linear;
        let about_o = rotation * self.angular;
        let (q, gamma) = (self.linear.norm(), self.angular.norm());
        let lever = gamma + b.norm() * q;
        let three = |v: Vector3<f64>| v.iter().copied().collect::<Vec<_>>();
        match name {
            "energy" => (vec![self.kinetic + self.potential], self.kinetic + self.potential.abs()),
            "P_space" => (three(linear), q),
            "P_x" => (vec![linear.x], q),
            "P_y" => (vec![linear.y], q),
            "L_space_about_Omega" => (three(about_o + b.cross(&linear)), lever),
            "L_space_about_O" => (three(about_o), gamma),
            // About the vertical through Ω, which is O where O is fixed.
            "L_z" => (vec![(about_o + b.cross(&linear)).z], lever),
            "L_norm2" => (vec![self.angular.norm_squared()], gamma * gamma),
            "L2_body" => (vec![self.angular.y], gamma),
            "L3_body" | "pi3_body" => (vec![self.angular.z], gamma),
            // |π|² − θ J₁J₂J₃ Σ p_i²/J_i with θ = 1/4, J = (1, 2, 3) of the one scene that has it.
            "Clebsch" => {
                let p = self.linear;
                let sum = p.x * p.x + p.y * p.y / 2.0 + p.z * p.z / 3.0;
                let (first, second) = (self.angular.norm_squared(), 1.5 * sum);
                (vec![first - second], first + second)
            }
            // (ω₁² − ω₂² − νγ₁)² + (2ω₁ω₂ − νγ₂)², ν = mgℓ/I₃, γ = Rᵀk₃.
            "Kovalevskaya" => {
                let nu = parameters.mass * parameters.gravity * parameters.center.x / parameters.principal.z;
                let up = rotation.inverse() * Vector3::z();
                let w = self.omega;
                let (first, second) = (w.x * w.x - w.y * w.y - nu * up.x, 2.0 * w.x * w.y - nu * up.y);
                let size = w.x * w.x + w.y * w.y + nu;
                (vec![first * first + second * second], size * size)
            }
            _ => panic!("no formula for the integral `{name}`"),
        }
    }
}
