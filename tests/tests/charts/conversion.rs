//! States carried between charts: same pose, same twist, there and back; and what cannot be expressed is said in words.

use crate::common::Bounded;
use crate::common::agreement::{Tally, equal, explore, largest};
use crate::common::body::{Body, Parts, Scene, list};
use crate::common::parameters::Parameters;
use crate::common::states::{Motion, State};
use gauss_runtime::chart::{ChartError, MotionRule, convert};
use gauss_runtime::prelude::*;
use proptest::prelude::*;
use proptest::test_runner::TestCaseError;

/// Pose and twist as plain numbers; of q and −q, which are one rotation, the one with the larger sum of products.
fn physical<K: Body<Bounded>>(
    kernel: &K,
    q: &K::Configuration,
    z: &K::Speeds,
    like: &[Bounded],
) -> (Vec<Bounded>, Vec<Bounded>) {
    let mut pose = kernel.pose(Bounded::zero(), q).parts();
    let overlap: f64 = pose.iter().zip(like).take(4).map(|(a, b)| a.value * b.value).sum();
    if overlap < 0.0 {
        pose.iter_mut().take(4).for_each(|c| *c = -*c);
    }
    (pose, list(&kernel.body_twist(Bounded::zero(), q, z)))
}

/// `convert` from one chart to another and back: pose and twist stay, and so does the state itself.
fn round_trip<A: Scene, B: Scene>(p: &Parameters, state: &State, tally: &Tally) -> Result<(), TestCaseError> {
    fn check<A: Body<Bounded>, B: Body<Bounded>>(
        a: &A,
        b: &B,
        state: &State,
        tally: &Tally,
    ) -> Result<(), TestCaseError> {
        let Ok((q, z)) = state.of(a) else { return Ok(()) };
        let like = state.pose().parts();
        let there = match convert(a, &q, &z, b) {
            Ok(there) => there,
            Err(ChartError::Singular { .. }) => return Ok(()),
            Err(error) => return Err(TestCaseError::fail(format!("there: {error}"))),
        };
        let (pose, twist) = physical(b, &there.0, &there.1, &like);
        equal("pose", &pose, &like)?;
        equal("twist", &twist, &state.twist.map(Bounded::from_f64))?;
        tally.count(&twist, largest(&list(&there.1)).max(largest(&twist)));
        let back = convert(b, &there.0, &there.1, a).map_err(|error| TestCaseError::fail(format!("back: {error}")))?;
        equal("speeds", &list(&back.1), &list(&z))?;
        let (pose, _) = physical(a, &back.0, &back.1, &like);
        equal("pose after the way back", &pose, &like)
    }
    check(&A::kernel::<Bounded>(p), &B::kernel::<Bounded>(p), state, tally)
}

/// The share of twists that are proved to 1e-12 relative to the speeds.
const SHARE: f64 = 0.9;

/// Every ordered pair.
macro_rules! pairs {
    ($motion:ident: $($chart:ident)+) => {
        #[test]
        fn there_and_back() {
            use super::*;
            explore(Motion::$motion, SHARE, |parameters, state, tally| {
                pairs!(@each parameters state tally [$($chart)+] [$($chart)+]);
                Ok(())
            });
        }
    };
    (@each $p:ident $s:ident $t:ident [$($from:ident)+] $all:tt) => {
        $(pairs!(@to $p $s $t $from $all);)+
    };
    (@to $p:ident $s:ident $t:ident $from:ident [$($to:ident)+]) => {
        $(round_trip::<$from<()>, $to<()>>($p, $s, $t).map_err(|error| match error {
            TestCaseError::Fail(why) => {
                TestCaseError::fail(format!("{} to {}: {why}", stringify!($from), stringify!($to)))
            }
            reject => reject,
        })?;)+
    };
}

mod free {
    usual_charts!(principal, free);
    pairs!(Free: Left Right Hybrid Zyx Zxz Modified);
}

mod fixed_point {
    usual_charts!(principal, fixed_point);
    pairs!(FixedPoint: Left Right Hybrid Zyx Zxz Modified);
}

mod planar {
    planar_charts!(principal);
    pairs!(Planar: Left Right Hybrid Jet);
}

/// Between motions: what the narrower one cannot have is refused with the rule, and what it can have converts.
mod between_motions {
    use super::*;

    proptest! {
        #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]
        #[test]
        fn only_what_exists_converts(
            parameters in crate::common::parameters::parameters(),
            state in crate::common::states::state(Motion::Planar),
            excess in 1e-6..1.0_f64,
        ) {
            let wide = free::Hybrid::<()>::kernel::<f64>(&parameters);
            let narrow = planar::Jet::<()>::kernel::<f64>(&parameters);
            let fixed = fixed_point::Zxz::<()>::kernel::<f64>(&parameters);
            let pose = Isometry3::assemble(&[&state.rotation[..], &state.position[..]].concat());
            let twist = SVector::from(state.twist);
            let z = wide.speeds(0.0, &pose, &twist);
            prop_assert!(convert(&wide, &pose, &z, &narrow).is_ok());

            let mut above = pose;
            above.translation.vector[2] = excess;
            let error = convert(&wide, &above, &z, &narrow).expect_err("out of the plane");
            let refused = matches!(error, ChartError::Inexpressible { rule: MotionRule::InPlane, value } if value == excess);
            prop_assert!(refused, "{error:?}");

            let mut rising = twist;
            rising[2] = excess;
            let error = convert(&wide, &pose, &wide.speeds(0.0, &pose, &rising), &narrow).expect_err("rising");
            let refused = matches!(error, ChartError::Inexpressible { rule: MotionRule::Twist { index: 2 }, .. });
            prop_assert!(refused, "{error:?}");

            let mut apart = pose;
            apart.translation.vector[0] = excess;
            let error = convert(&wide, &apart, &z, &fixed).expect_err("away from the point");
            let refused = matches!(error, ChartError::Inexpressible { rule: MotionRule::FixedPoint { axis: 0 }, .. });
            prop_assert!(refused, "{error:?}");

            let mut broken = z;
            broken[4] = f64::NAN;
            prop_assert_eq!(convert(&wide, &pose, &broken, &narrow).expect_err("NaN"), ChartError::NonFinite);
        }
    }

    /// Gimbal lock and half a turn are said, not computed with.
    #[test]
    fn singular_points_are_named() {
        principal!(Rodrigues RodriguesKernel, free, [jet(rodrigues)]);
        let mut runner = proptest::test_runner::TestRunner::deterministic();
        let tree = crate::common::parameters::parameters().new_tree(&mut runner).expect("parameters");
        let parameters = proptest::strategy::ValueTree::current(&tree);
        let left = free::Left::<()>::kernel::<f64>(&parameters);
        let z = SVector::<f64, 6>::from([0.1, 0.2, 0.3, 0.4, 0.5, 0.6]);
        let turned = |axis: Vector3<f64>, angle: f64| Isometry3::rotation(axis * angle);
        let quarter = turned(Vector3::y(), std::f64::consts::FRAC_PI_2);
        let error = convert(&left, &quarter, &z, &free::Zyx::<()>::kernel(&parameters)).expect_err("gimbal lock");
        assert!(matches!(error, ChartError::Singular { .. }), "{error}");
        let none = Isometry3::identity();
        let error = convert(&left, &none, &z, &free::Zxz::<()>::kernel(&parameters)).expect_err("no nutation");
        assert!(matches!(error, ChartError::Singular { .. }), "{error}");
        let half = turned(Vector3::x(), std::f64::consts::PI);
        let error = convert(&left, &half, &z, &Rodrigues::<()>::kernel(&parameters)).expect_err("half a turn");
        assert!(matches!(error, ChartError::Singular { .. }), "{error}");
        assert!(convert(&left, &half, &z, &free::Modified::<()>::kernel(&parameters)).is_ok());
    }
}
