//! Principal axes of a body, and what a free motion does in them.

use gauss_runtime::__crates_0_1_0::{compose, quaternion, rotate, rotate_back, triple, unit_quaternion};
use gauss_runtime::integrate::IntegrationErrorKind;
use gauss_runtime::lie::so3;
use gauss_runtime::real::Real;
use nalgebra::{Matrix3, SVector, UnitQuaternion, Vector3};

/// Effect of a span of free motion on a body, in its principal axes.
#[derive(Clone, Copy, Debug)]
pub struct Turn<T> {
    /// δ: the attitude goes from R to R∘δ.
    pub rotation: UnitQuaternion<T>,
    /// The change of the angular momentum about the fixed point, components in the body's axes. A change and not the
    /// new value, so that adding it commits roundings of the size of the change's.
    pub change: Vector3<T>,
}

/// A way to move a free rigid body that turns about a fixed point: exactly, or by a discretisation.
///
/// A type of your own that implements it becomes a splitting method by
/// [`Splitting::with`](crate::splitting::Splitting::with).
pub trait FreeMotion<T: Real> {
    /// The order of the global error; `None` when there is none but rounding.
    fn order(&self) -> Option<u32>;

    /// Whether attitude and momentum together are moved by a symplectic map.
    fn symplectic(&self) -> bool;

    /// The motion during h from the angular momentum y; principal axes of the body.
    ///
    /// # Errors
    /// When a discretisation cannot make a step of this length, or a number is not finite.
    fn turn(&self, y: &Vector3<T>, h: T) -> Result<Turn<T>, IntegrationErrorKind>;
}

/// The principal moments of an inertia tensor and the rotation to its axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PrincipalAxes<T> {
    moments: [T; 3],
    /// Principal to body axes.
    rotation: [T; 4],
    aligned: bool,
}

impl<T: Real> PrincipalAxes<T> {
    /// The axes of a symmetric tensor, by Jacobi's rotations; those of a diagonal tensor are left as they are. `None`
    /// when a moment is not greater than zero, or a number is not finite.
    #[must_use]
    pub fn of(inertia: &Matrix3<T>) -> Option<Self> {
        let mut a: [[T; 3]; 3] = core::array::from_fn(|i| core::array::from_fn(|j| inertia.data.0[j][i]));
        let mut turned = [T::zero(), T::zero(), T::zero(), T::one()];
        // Convergence is quadratic: six sweeps suffice for double precision, eight also in more.
        for _ in 0..8 {
            for (p, q) in [(0, 1), (0, 2), (1, 2)] {
                annihilate(&mut a, &mut turned, p, q);
            }
        }
        let moments = [a[0][0], a[1][1], a[2][2]];
        let positive = |m: &T| (0..T::LANES).all(|lane| m.lane(lane) > 0.0) && m.is_finite();
        if !moments.iter().all(positive) {
            return None;
        }
        let aligned = turned[..3].iter().all(|&c| c == T::zero());
        Some(Self { moments, rotation: quaternion(&so3::renormalise(&unit_quaternion(turned))), aligned })
    }

    /// The principal moments.
    #[must_use]
    pub fn moments(&self) -> [T; 3] {
        self.moments
    }

    /// The rotation that takes components in principal axes to those in body axes.
    #[must_use]
    pub fn rotation(&self) -> UnitQuaternion<T> {
        unit_quaternion(self.rotation)
    }

    /// A free motion during h in body axes.
    ///
    /// # Errors
    /// Those of the motion.
    #[inline]
    pub fn turn<M: FreeMotion<T>>(&self, motion: &M, y: &Vector3<T>, h: T) -> Result<Turn<T>, IntegrationErrorKind> {
        if self.aligned {
            return motion.turn(y, h);
        }
        let axes = self.rotation;
        let Turn { rotation, change } = motion.turn(&SVector::from(rotate_back(axes, triple(y))), h)?;
        let [x, y, z, w] = quaternion(&rotation);
        let [x, y, z] = rotate(axes, [x, y, z]);
        let change = SVector::from(rotate(axes, triple(&change)));
        Ok(Turn { rotation: unit_quaternion([x, y, z, w]), change })
    }
}

/// One rotation about the third axis that annihilates entry (p, q), by the smaller angle. Where the entry is zero
/// already nothing changes.
fn annihilate<T: Real>(a: &mut [[T; 3]; 3], turned: &mut [T; 4], p: usize, q: usize) {
    let (one, half) = (T::one(), T::ratio(1, 2));
    let (k, off) = (3 - p - q, a[p][q]);
    let difference = half * (a[q][q] - a[p][p]);
    // tan of the angle, `off/(d ± √(d² + off²))` with the sign that adds; 0 and not 0/0 where the entry is zero.
    let root = (difference * difference + off * off).sqrt();
    let denominator = T::select_lt(difference, T::zero(), difference - root, difference + root);
    let vanishes = T::select_lt(off.abs(), T::from_f64(f64::MIN_POSITIVE), one, T::zero());
    let tangent = T::select_lt(T::zero(), vanishes, T::zero(), off / (denominator + vanishes));
    let cosine = (one + tangent * tangent).sqrt().recip();
    let sine = tangent * cosine;
    a[p][p] -= tangent * off;
    a[q][q] += tangent * off;
    (a[p][q], a[q][p]) = (T::zero(), T::zero());
    let (u, v) = (a[k][p], a[k][q]);
    let (u, v) = (cosine * u - sine * v, sine * u + cosine * v);
    (a[k][p], a[p][k]) = (u, u);
    (a[k][q], a[q][k]) = (v, v);
    // New axis p is c·p − s·q: for (p, q, k) cyclic a turn by −angle about k.
    let half_cosine = (half * (one + cosine)).sqrt();
    let half_sine = half * sine / half_cosine;
    let mut turn = [T::zero(), T::zero(), T::zero(), half_cosine];
    turn[k] = if (p + 1) % 3 == q { -half_sine } else { half_sine };
    *turned = compose(*turned, turn);
}

#[cfg(test)]
mod tests {
    use super::*;
    use gauss_runtime::simd::Lanes;

    /// Products of a rotation and its moments, put together again.
    #[test]
    fn a_tensor_is_its_moments_in_its_axes() {
        let tensors = [
            Matrix3::new(2.0, 0.3, -0.1, 0.3, 1.5, 0.2, -0.1, 0.2, 1.0),
            Matrix3::new(1.0, 1e-3, 0.0, 1e-3, 1.0, 0.0, 0.0, 0.0, 1e-6),
            Matrix3::new(1.0, 0.0, 0.0, 0.0, 1.0, 0.5, 0.0, 0.5, 1.0),
        ];
        for tensor in tensors {
            let axes = PrincipalAxes::of(&tensor).expect("positive definite");
            let matrix = axes.rotation().to_rotation_matrix().into_inner();
            let again = matrix * Matrix3::from_diagonal(&Vector3::from(axes.moments())) * matrix.transpose();
            // Three to six rotations that do something, each a few roundings of the largest entry.
            assert!((again - tensor).amax() <= 32.0 * f64::EPSILON * tensor.amax(), "{again} {tensor}");
        }
    }

    #[test]
    fn a_diagonal_tensor_keeps_its_axes() {
        let axes = PrincipalAxes::of(&Matrix3::from_diagonal(&Vector3::new(3.0, 1.0, 2.0))).expect("positive");
        assert_eq!((axes.moments(), axes.rotation()), ([3.0, 1.0, 2.0], UnitQuaternion::identity()));
        assert!(axes.aligned);
    }

    #[test]
    fn what_no_body_has_is_refused() {
        assert_eq!(PrincipalAxes::of(&Matrix3::from_diagonal(&Vector3::new(1.0, 0.0, 1.0))), None);
        assert_eq!(PrincipalAxes::of(&Matrix3::new(1.0, 2.0, 0.0, 2.0, 1.0, 0.0, 0.0, 0.0, 1.0)), None);
        assert_eq!(PrincipalAxes::of(&Matrix3::from_diagonal(&Vector3::new(1.0, f64::NAN, 1.0))), None);
    }

    #[test]
    fn lanes_have_axes_of_their_own() {
        let at = |i: usize, tensors: [Matrix3<f64>; 2]| PrincipalAxes::of(&tensors[i]).expect("positive definite");
        let tensors = [
            Matrix3::new(2.0, 0.3, 0.0, 0.3, 1.5, 0.2, 0.0, 0.2, 1.0),
            Matrix3::from_diagonal(&Vector3::new(1.0, 2.0, 3.0)),
        ];
        let both = Matrix3::from_fn(|i, j| Lanes([tensors[0][(i, j)], tensors[1][(i, j)]]));
        let both = PrincipalAxes::of(&both).expect("positive definite");
        for lane in 0..2 {
            assert_eq!(both.moments().map(|m| m.0[lane]), at(lane, tensors).moments());
        }
    }
}
