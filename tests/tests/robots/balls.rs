//! Drives and limits of joints with several coordinates.

use gauss_runtime::prelude::*;

use super::EPSILON;

#[derive(GaussDynamics)]
#[gauss(mjcf = "robots/balls.xml", saturation = clamp, limits = range)]
struct Balls;

#[derive(GaussDynamics)]
#[gauss(mjcf = "robots/balls.xml", saturation = clamp, limits = stop(stiffness = 3, width = 1e-3))]
struct Stopped;

/// A state within the range of the ball.
fn state() -> BallsState {
    let turn = |c: [f64; 4]| UnitQuaternion::from_quaternion(Quaternion::new(c[0], c[1], c[2], c[3]));
    let rotation = turn([0.9, 0.2, -0.3, 0.1]);
    BallsState {
        hinge: 0.3,
        ball: turn([0.95, 0.1, -0.15, 0.2]),
        free: Isometry3::from_parts(Translation3::new(2.1, 0.2, -0.3), rotation),
        hinge_dot: 0.2,
        ball_omega: Vector3::new(0.5, -0.3, 0.7),
        free_u: rotation.inverse() * Vector3::new(0.1, 0.2, 0.3),
        free_omega: Vector3::new(-0.4, 0.5, 0.6),
    }
}

/// `qacc` of `mj_forward` of MuJoCo 4.0.0, the free body's along observer's axes: a ball is driven in the axes of its
/// child, with `jointinparent` in those of its parent, a free body by forces along the observer's and torques in its
/// own axes, or in the observer's; the length of a ball is that of its turn, its speed that of its ω along the gear.
#[test]
fn drives_of_balls_and_free_joints() {
    let kernel = Balls.kernel().unwrap();
    let state = state();
    let (q, z) = (state.q(), state.z());
    let cases = [
        (
            [0.0, 0.0, 0.0, 0.0, 0.0],
            [
                -2.5923486489478478,
                -79.93602498589533,
                -65.32525225367951,
                -235.3534723025175,
                -0.4884336048986733,
                -1.4656211783641933,
                -1.8063022311124068,
                -2.8626998337950145,
                0.035105595567868075,
                -0.1652777839335194,
            ],
        ),
        (
            [0.0, 0.3, 0.0, 0.0, 0.0],
            [
                -0.41870692502216866,
                -78.71232394568561,
                -74.446549721069,
                -223.8656839534619,
                -0.4884336048986733,
                -1.4656211783641933,
                -1.8063022311124068,
                -2.8626998337950145,
                0.035105595567868075,
                -0.1652777839335194,
            ],
        ),
        (
            [0.1, 0.2, 0.5, 0.6, -0.6],
            [
                -3.965772802778337e-05,
                -42.244201510888935,
                -41.25299690401996,
                -119.01949740065587,
                -0.13947294007872868,
                -0.6717809567575449,
                -0.6893555275112991,
                -2.0504893074792245,
                -0.14994703601107995,
                0.9117748476454288,
            ],
        ),
    ];
    let mass = kernel.mass_matrix(0.0, &q);
    let condition = mass.norm() * mass.try_inverse().unwrap().norm();
    for (u, expected) in cases {
        let found = kernel.acceleration(0.0, &q, &z, &SVector::from(u));
        let BallsState { free_u, .. } = BallsState::of(&q, &found);
        let moved = state.free.rotation * (free_u + state.free_omega.cross(&state.free_u));
        let own: Vec<f64> = found.iter().take(4).chain(moved.iter()).chain(found.iter().skip(7)).copied().collect();
        let (found, expected) = (SVector::<f64, 10>::from_iterator(own), SVector::from(expected));
        // Each sums some ten terms of a size of a hundred at most.
        assert!((found - expected).amax() <= 100.0 * EPSILON * condition * expected.amax(), "{found} {expected}");
    }
    // What turns the ball turns its seat the other way.
    let free = Stopped.kernel().unwrap();
    let momentum = |u: [f64; 5]| {
        let rates = free.acceleration(0.0, &q, &z, &SVector::from(u));
        (free.mass_matrix(0.0, &q) * rates)[0]
    };
    let [without, with] = [momentum([0.0; 5]), momentum([0.3, 0.2, 0.0, 0.0, 0.0])];
    assert!((without - with).abs() < 1000.0 * EPSILON * condition, "the hinge feels no couple within what it carries");
}

/// The angle φ of a turn in any direction is at most 60°: at that limit `mj_instantiateLimit` of MuJoCo 4.0.0 has the
/// distance 0 and the Jacobian −n. Here the gap is (cos φ − cos 60°)/sin 60°, which is smooth where nothing is turned.
#[test]
fn ranges_of_balls() {
    let kernel = Balls.kernel().unwrap();
    let most = 60.0_f64.to_radians();
    let gap = |ball: UnitQuaternion<f64>, ball_omega: Vector3<f64>| {
        let state = BallsState { ball, ball_omega, ..state() };
        (kernel.gaps(0.0, &state.q())[0], kernel.contact_rates(0.0, &state.q(), &state.z())[0])
    };
    for direction in [Vector3::new(1.0, 0.0, 0.0), Vector3::new(0.0, -1.0, 0.0), Vector3::new(0.3, -0.4, 0.7)] {
        let n = direction.normalize();
        let omega = Vector3::new(0.3, 0.5, -0.2);
        let (at_most, rate) = gap(UnitQuaternion::from_scaled_axis(n * most), omega);
        // Sums of some numbers of order one.
        assert!(at_most.abs() < 8.0 * EPSILON && (rate + omega.dot(&n)).abs() < 8.0 * EPSILON, "{at_most} {rate}");
        for angle in [0.0_f64, 0.1, 1.0, 1.1, 3.0] {
            let (found, _) = gap(UnitQuaternion::from_scaled_axis(n * angle), omega);
            assert!((found - (angle.cos() - most.cos()) / most.sin()).abs() < 8.0 * EPSILON, "{angle}: {found}");
        }
        assert_eq!(gap(UnitQuaternion::identity(), omega).1, 0.0);
        // The other quaternion of the same turn.
        let other = UnitQuaternion::new_unchecked(-UnitQuaternion::from_scaled_axis(n * most).into_inner());
        assert!(gap(other, omega).0.abs() < 8.0 * EPSILON);
    }
}

/// A stop that gives way is a torque about the direction of the turn, by its law ½ k s² of the same length.
#[test]
fn stops_of_balls() {
    let kernel = Stopped.kernel().unwrap();
    let n = Vector3::new(0.3, -0.4, 0.7).normalize();
    let most = 60.0_f64.to_radians();
    let power = |angle: f64, omega: Vector3<f64>| {
        let ball = UnitQuaternion::from_scaled_axis(n * angle);
        let state = BallsState { ball, ball_omega: omega, ..state() };
        kernel.power("ball_limits", 0.0, &state.q(), &state.z(), &SVector::zeros()).unwrap()
    };
    for angle in [most - 0.1, most, most + 0.1] {
        let x = (most.cos() - angle.cos()) / most.sin();
        let root = x.hypot(1e-3);
        let s = (x + root) / 2.0;
        let expected = -3.0 * s * s / root * angle.sin() / most.sin();
        // Sums of numbers of order one.
        assert!((power(angle, n) - expected).abs() < 32.0 * EPSILON, "{angle}");
        assert!(power(angle, n.cross(&Vector3::x())).abs() < 8.0 * EPSILON);
    }
}
