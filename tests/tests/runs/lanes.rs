//! Packs of numbers: every function gives every lane the bits that it would get alone, also where results are not
//! finite.

use gauss_runtime::prelude::*;
use gauss_runtime::simd::Packed;

/// Ordinary numbers, both zeros, the ends of the range, and what is no number.
const NUMBERS: [f64; 16] = [
    0.0,
    -0.0,
    1.0,
    -1.0,
    0.3,
    -0.7,
    2.5,
    -40.0,
    1e-3,
    7.0e5,
    1e300,
    -1e-310,
    f64::INFINITY,
    f64::NEG_INFINITY,
    f64::NAN,
    0.999_999,
];

/// Every function of [`Real`], of three numbers.
fn functions<T: Real>(a: T, b: T, c: T) -> Vec<T> {
    let ((sine, cosine), mut updated) = (a.sin_cos(), a);
    updated += b;
    updated -= c;
    updated *= b;
    updated /= c;
    vec![
        a + b,
        a - b,
        a * b,
        a / b,
        -a,
        updated,
        T::zero(),
        T::one(),
        T::from_f64(0.1),
        T::ratio(-22, 7),
        a.fma(b, c),
        a.sqrt(),
        sine,
        cosine,
        a.sin(),
        a.cos(),
        a.tan(),
        a.asin(),
        a.acos(),
        a.atan(),
        a.atan2(b),
        a.sinh(),
        a.cosh(),
        a.tanh(),
        a.exp(),
        a.ln(),
        a.powi(3),
        a.powi(-2),
        a.abs(),
        a.signum(),
        a.min(b),
        a.max(b),
        a.recip(),
        T::select_lt(a, b, c, a),
    ]
}

fn lanes_are_independent<T>()
where
    T: Real + Packed<Single: Real>,
{
    let single = |k: usize| <T::Single as Real>::from_f64(NUMBERS[k % 16]);
    // Each number meets each other one, in every lane.
    for (i, shift) in (0..16).flat_map(|i| (0..16).map(move |shift| (i, shift))) {
        let of_lane = |lane: usize, step: usize| single(i + lane * 5 + step * shift);
        let pack = |step: usize| {
            let mut pack = T::repeat(&of_lane(0, step));
            (1..T::WIDTH).for_each(|lane| pack.replace(lane, &of_lane(lane, step)));
            pack
        };
        let together = functions(pack(0), pack(1), pack(3));
        let finite = (0..T::WIDTH).all(|lane| of_lane(lane, 0).is_finite());
        assert_eq!(pack(0).is_finite(), finite);
        for lane in 0..T::WIDTH {
            let alone = functions(of_lane(lane, 0), of_lane(lane, 1), of_lane(lane, 3));
            for (number, (together, alone)) in together.iter().zip(alone).enumerate() {
                let (together, alone) = (together.lane(lane), alone.lane(0));
                // Which NaN is not said by IEEE 754.
                let same = together.to_bits() == alone.to_bits() || (together.is_nan() && alone.is_nan());
                assert!(same, "function {number}, lane {lane}: {together:e} for {alone:e}");
            }
        }
    }
}

#[test]
fn every_function_works_lane_by_lane() {
    lanes_are_independent::<Lanes<f64, 4>>();
    lanes_are_independent::<Lanes<f64, 8>>();
    lanes_are_independent::<Lanes<f32, 3>>();
    lanes_are_independent::<wide::f64x4>();
    lanes_are_independent::<wide::f64x8>();
    lanes_are_independent::<wide::f32x8>();
    lanes_are_independent::<wide::f32x16>();
}

/// Whatever a state is made of goes into a lane and comes out again; other lanes do not notice.
#[test]
fn containers_keep_what_is_put_into_a_lane() {
    type Four = Lanes<f64, 4>;
    fn check<V: Packed<Single: PartialEq + std::fmt::Debug>>(first: V::Single, second: V::Single) {
        let mut packed = V::repeat(&first);
        packed.replace(2, &second);
        for lane in 0..V::WIDTH {
            assert_eq!(packed.extract(lane), if lane == 2 { second } else { first });
        }
    }
    let turn = |angle: f64| UnitQuaternion::from_euler_angles(angle, 0.2, -0.1);
    let pose = |x: f64| Isometry3::from_parts(Translation3::new(x, 2.0, 3.0), turn(x));
    check::<Four>(1.0, 2.0);
    check::<wide::f64x4>(1.0, 2.0);
    check::<UnitQuaternion<Four>>(turn(0.1), turn(0.4));
    check::<Isometry3<wide::f64x8>>(pose(0.1), pose(0.4));
    check::<Isometry2<Four>>(
        Isometry2::new(SVector::from([1.0, 2.0]), 0.3),
        Isometry2::new(SVector::from([3.0, 4.0]), -1.0),
    );
    check::<SVector<Four, 2>>(SVector::from([1.0, 2.0]), SVector::from([3.0, 4.0]));
    check::<(UnitQuaternion<Four>, SVector<Four, 1>)>(
        (turn(0.1), SVector::from([1.0])),
        (turn(0.2), SVector::from([2.0])),
    );
}
