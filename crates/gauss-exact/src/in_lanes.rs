//! The exact free motion of several bodies, one in each lane.

use gauss_runtime::integrate::IntegrationErrorKind;
use gauss_runtime::real::Real;
use gauss_runtime::simd::Packed;
use nalgebra::Vector3;

use crate::free_flow::FreeFlow;
use crate::inertia::{FreeMotion, Turn};

impl FreeFlow {
    /// The motions of N bodies with the principal moments in the lanes of packs, for
    /// [`Splitting::with`](crate::Splitting::with). What is computed is that of each lane by itself.
    #[must_use]
    pub fn in_lanes<T: Packed<Single = f64>, const N: usize>(moments: [T; 3]) -> [Self; N] {
        core::array::from_fn(|lane| Self::new(moments.map(|moment| moment.extract(lane))))
    }
}

impl<T: Real + Packed<Single = f64>, const N: usize> FreeMotion<T> for [FreeFlow; N] {
    fn order(&self) -> Option<u32> {
        None
    }

    fn symplectic(&self) -> bool {
        true
    }

    fn turn(&self, y: &Vector3<T>, h: T) -> Result<Turn<T>, IntegrationErrorKind> {
        const { assert!(N == T::WIDTH, "one motion for each lane") };
        let of_lane = |lane: usize| self[lane].turn(&y.extract(lane), h.extract(lane));
        let first: Turn<f64> = of_lane(0)?;
        let mut turn = Turn { rotation: Packed::repeat(&first.rotation), change: Packed::repeat(&first.change) };
        for lane in 1..N {
            let next = of_lane(lane)?;
            turn.rotation.replace(lane, &next.rotation);
            turn.change.replace(lane, &next.change);
        }
        Ok(turn)
    }
}
