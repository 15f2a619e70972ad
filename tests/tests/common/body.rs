//! One rigid body as the checks see it: any chart, any motion, any scalar.

use gauss_runtime::lie::{se2, so3};
use gauss_runtime::prelude::*;

use super::dual::Dual;
use super::parameters::Parameters;

/// A configuration as plain numbers, and their rates of change under a velocity seen from the body.
pub trait Parts<T: Real>: Configuration<Scalar = T> {
    /// Quaternion x, y, z, w then b; cos θ, sin θ then b; or the coordinates.
    fn parts(&self) -> Vec<T>;
    /// The configuration with the given parts.
    fn assemble(parts: &[T]) -> Self;
    /// d/dt of the parts: typed here from Ṙ = R [ω]× and ḃ = R u, independently of `retract`.
    fn rates(&self, velocity: &Self::Tangent) -> Vec<T>;
}

/// Half of `q ∘ (ω, 0)`, Hamilton's product.
fn quaternion_rate<T: Real>(q: &[T], w: [T; 3]) -> [T; 4] {
    let half = T::ratio(1, 2);
    [
        half * (q[3] * w[0] + q[1] * w[2] - q[2] * w[1]),
        half * (q[3] * w[1] + q[2] * w[0] - q[0] * w[2]),
        half * (q[3] * w[2] + q[0] * w[1] - q[1] * w[0]),
        -half * (q[0] * w[0] + q[1] * w[1] + q[2] * w[2]),
    ]
}

/// The rotation matrix of a unit quaternion x, y, z, w.
pub fn rotation_matrix<T: Real>(q: &[T]) -> [[T; 3]; 3] {
    let two = T::from_f64(2.0);
    let entry = |i: usize, j: usize| {
        let k = 3 - i - j;
        let sign = if (i + 1) % 3 == j { -T::one() } else { T::one() };
        two * (q[i] * q[j] + sign * q[3] * q[k])
    };
    let diagonal = |i: usize, j: usize| T::one() - two * (q[i] * q[i] + q[j] * q[j]);
    [
        [diagonal(1, 2), entry(0, 1), entry(0, 2)],
        [entry(1, 0), diagonal(0, 2), entry(1, 2)],
        [entry(2, 0), entry(2, 1), diagonal(0, 1)],
    ]
}

/// A matrix times a vector.
pub fn apply<T: Real>(m: &[[T; 3]; 3], v: [T; 3]) -> [T; 3] {
    m.map(|row| row[0] * v[0] + row[1] * v[1] + row[2] * v[2])
}

/// The vector product.
pub fn cross<T: Real>(a: [T; 3], b: [T; 3]) -> [T; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

impl<T: Real> Parts<T> for UnitQuaternion<T> {
    fn parts(&self) -> Vec<T> {
        self.as_ref().coords.data.0[0].to_vec()
    }
    fn assemble(parts: &[T]) -> Self {
        let mut rotation = so3::exp(&SVector::from([T::zero(); 3]));
        rotation.as_mut_unchecked().coords = SVector::from([parts[0], parts[1], parts[2], parts[3]]);
        rotation
    }
    fn rates(&self, velocity: &Self::Tangent) -> Vec<T> {
        quaternion_rate(&self.parts(), velocity.data.0[0]).to_vec()
    }
}

impl<T: Real> Parts<T> for Isometry3<T> {
    fn parts(&self) -> Vec<T> {
        [self.rotation.parts(), self.translation.vector.data.0[0].to_vec()].concat()
    }
    fn assemble(parts: &[T]) -> Self {
        let translation = Translation3 { vector: SVector::from([parts[4], parts[5], parts[6]]) };
        Self { rotation: UnitQuaternion::assemble(&parts[..4]), translation }
    }
    fn rates(&self, velocity: &Self::Tangent) -> Vec<T> {
        let [u1, u2, u3, w1, w2, w3] = velocity.data.0[0];
        let q = self.rotation.parts();
        [&quaternion_rate(&q, [w1, w2, w3])[..], &apply(&rotation_matrix(&q), [u1, u2, u3])[..]].concat()
    }
}

impl<T: Real> Parts<T> for Isometry2<T> {
    fn parts(&self) -> Vec<T> {
        let (rotation, b) = (self.rotation.as_ref(), self.translation.vector.data.0[0]);
        vec![rotation.re, rotation.im, b[0], b[1]]
    }
    fn assemble(parts: &[T]) -> Self {
        let mut pose = se2::exp(&SVector::from([T::zero(); 3]));
        let rotation = pose.rotation.as_mut_unchecked();
        (rotation.re, rotation.im) = (parts[0], parts[1]);
        pose.translation.vector = SVector::from([parts[2], parts[3]]);
        pose
    }
    fn rates(&self, velocity: &Self::Tangent) -> Vec<T> {
        let [u1, u2, w] = velocity.data.0[0];
        let rotation = self.rotation.as_ref();
        let (cosine, sine) = (rotation.re, rotation.im);
        vec![-sine * w, cosine * w, cosine * u1 - sine * u2, sine * u1 + cosine * u2]
    }
}

impl<T: Real, const N: usize> Parts<T> for SVector<T, N> {
    fn parts(&self) -> Vec<T> {
        self.data.0[0].to_vec()
    }
    fn assemble(parts: &[T]) -> Self {
        Self::from(std::array::from_fn(|i| parts[i]))
    }
    fn rates(&self, velocity: &Self) -> Vec<T> {
        velocity.data.0[0].to_vec()
    }
}

/// What a derived kernel without inputs is.
pub trait Body<T: Real>:
    RigidBodySystem<Scalar = T, Input = (), Configuration: Parts<T>, Speeds: VectorSpace<T>> + DescribedSystem
{
}

impl<T: Real, K> Body<T> for K where
    K: RigidBodySystem<Scalar = T, Input = (), Configuration: Parts<T>, Speeds: VectorSpace<T>> + DescribedSystem
{
}

/// A derived struct, generic over the scalar.
pub trait Scene {
    /// Its kernel.
    type Kernel<T: Real>: Body<T>;
    /// The kernel for given parameters.
    fn kernel<T: Real>(parameters: &Parameters) -> Self::Kernel<T>;
}

/// Components of speeds, momenta, forces, twists.
pub fn list<T: Real, V: VectorSpace<T>>(v: &V) -> Vec<T> {
    (0..V::DIM).map(|i| v.component(i)).collect()
}

/// Speeds from components.
pub fn speeds<T: Real, V: VectorSpace<T>>(components: &[T]) -> V {
    let mut v = V::zero();
    for (i, &c) in components.iter().enumerate() {
        v.set_component(i, c);
    }
    v
}

/// Numbers with their rates.
pub fn duals<T: Real>(values: &[T], rates: &[T]) -> Vec<Dual<T>> {
    values.iter().zip(rates).map(|(&value, &rate)| Dual::new(value, rate)).collect()
}

/// The rates of dual numbers.
pub fn rates<T: Real>(values: &[Dual<T>]) -> Vec<T> {
    values.iter().map(|v| v.rate).collect()
}

/// A state with its velocity (q̇, ż) in the dual parts: ż as given, q̇ by the kernel's own kinematics.
pub fn flow<T: Real, K: Body<T>, D: Body<Dual<T>>>(
    kernel: &K,
    q: &K::Configuration,
    z: &K::Speeds,
    z_rate: &K::Speeds,
) -> (D::Configuration, D::Speeds) {
    let velocity = kernel.kinematics(T::zero(), q, z);
    let q_dual = D::Configuration::assemble(&duals(&q.parts(), &q.rates(&velocity)));
    (q_dual, speeds(&duals(&list(z), &list(z_rate))))
}

/// A number without a rate.
pub fn constant<T: Real>(value: T) -> Dual<T> {
    Dual::new(value, T::zero())
}

/// A configuration at rest and speeds that vary in the direction `direction`.
pub fn vary_speeds<T: Real, K: Body<T>, D: Body<Dual<T>>>(
    q: &K::Configuration,
    z: &K::Speeds,
    direction: &[T],
) -> (D::Configuration, D::Speeds) {
    let q_dual = D::Configuration::assemble(&q.parts().into_iter().map(constant).collect::<Vec<_>>());
    (q_dual, speeds(&duals(&list(z), direction)))
}
