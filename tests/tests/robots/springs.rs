//! Springs of joints with one coordinate and with several, along sums of coordinates and along cables, joints in
//! frames, and keyframes that leave out what is where it was.

use gauss_runtime::prelude::*;

use super::EPSILON;

#[derive(GaussDynamics)]
#[gauss(mjcf = "robots/springs.xml")]
struct Springs;

/// At every keyframe what MuJoCo 4.0.0 finds (`qacc` of `mj_forward` after `mj_resetDataKeyframe`; 3.3.7 has the same
/// to rounding): those of the free body along observer's axes, in place of its own, and its ω̇ in own axes.
#[test]
fn springs_at_keyframes() {
    let kernel = Springs.kernel().unwrap();
    let states: [(SpringsState, [f64; 13]); 4] = [
        (
            SpringsState::still(),
            [
                0.043681476446293416,
                0.12685407742918461,
                -9.665020832855959,
                2.4665919485083823,
                -0.7231766556928072,
                -1.0931648519744437,
                -3.8636816821485027,
                3.5821035737488973,
                2.871537053910636,
                -227.1052367018787,
                2.3534418864822677,
                1558.7648522575482,
                19.366583411477492,
            ],
        ),
        (
            SpringsState::moving(),
            [
                -0.06896899413447202,
                0.42826719991742834,
                -9.535700912071992,
                -5.095544296914898,
                4.381908178997901,
                -2.383172567164145,
                9.791995906744024,
                -8.587491450178904,
                -6.384673136161503,
                -227.56994313877502,
                2.3317903227977204,
                1555.2068227235509,
                18.16658341147749,
            ],
        ),
        (
            SpringsState::turned(),
            [
                23.800103074836127,
                -20.283060290709212,
                38.59857198789699,
                -238.78687331004264,
                690.1943109748386,
                -258.86749353827054,
                -969.8141551361604,
                -654.1692604341988,
                -200.70583443301268,
                120.16102618995997,
                -38.617025640726915,
                -1628.0068686773143,
                17.898395132121344,
            ],
        ),
        (
            SpringsState::unturned(),
            [
                24.26295355190419,
                -19.430975877724848,
                -2.7467636664977073,
                79.5953070812225,
                161.6252216676866,
                331.5763467740625,
                -114.10693715048406,
                -329.2219958217052,
                -0.6223705917653461,
                -48.24582972098085,
                7.147916074312301,
                772.5319793129103,
                18.47485820606127,
            ],
        ),
    ];
    for (state, expected) in states {
        let (q, z) = (state.q(), state.z());
        let found = kernel.acceleration(0.0, &q, &z, &());
        let SpringsState { hover_u, .. } = SpringsState::of(&q, &found);
        // The derivative of R u.
        let moved = state.hover.rotation * (hover_u + state.hover_omega.cross(&state.hover_u));
        let own: Vec<f64> = moved.iter().chain(found.iter().skip(3)).copied().collect();
        let (found, expected) = (SVector::<f64, 13>::from_iterator(own), SVector::from(expected));
        let mass = kernel.mass_matrix(0.0, &q);
        let condition = mass.norm() * mass.try_inverse().unwrap().norm();
        // Each sums some hundred terms of a size of a thousand at most.
        assert!((found - expected).amax() <= 500.0 * EPSILON * condition * expected.amax(), "{found} {expected}");
    }
}

/// Without qpos everything is where the file has it, with a velocity in own axes of what is turned there; a quaternion
/// of no length is none.
#[test]
fn keyframes_say_what_they_say() {
    let [start, still, moving, unturned] =
        [SpringsState::start(), SpringsState::still(), SpringsState::moving(), SpringsState::unturned()];
    assert_eq!(start.q(), still.q());
    assert_eq!(start.q(), moving.q());
    assert_eq!(still.z().amax(), 0.0);
    assert_eq!([still.shoulder, still.wrist], [10.0_f64.to_radians(), -15.0_f64.to_radians()]);
    let turn = UnitQuaternion::from_quaternion(Quaternion::new(1.0, 0.2, 0.3, 0.4));
    assert!((still.hover.rotation.coords - turn.coords).amax() <= 2.0 * EPSILON);
    assert!((turn * moving.hover_u - Vector3::new(0.1, 0.2, -0.3)).amax() <= 4.0 * EPSILON);
    assert_eq!([unturned.hover.rotation, unturned.swing], [UnitQuaternion::identity(); 2]);
}

/// The torque of a turn keeps its digits where the turn is small: the terms of R cancel, so that it is off by the
/// rounding of these products of the quaternion alone.
#[test]
fn small_turns() {
    let kernel = Springs.kernel().unwrap();
    for size in [0.0, 1e-100, 1e-18, 1e-9, 1e-4] {
        let turn = Vector3::<f64>::new(size, -2.0 * size, 0.5 * size);
        let swing = UnitQuaternion::new_normalize(Quaternion::from_parts(1.0, turn / 2.0));
        let half = turn.norm() / 2.0;
        let turn = if half > 0.0 { turn * (half.atan() / half) } else { turn };
        let state = SpringsState { swing, ..SpringsState::still() };
        let (q, none) = (state.q(), SVector::zeros());
        let sums: [SVector<f64, 13>; 2] = [&q, &SpringsState::still().q()]
            .map(|q| kernel.generalised_force("swing_spring", 0.0, q, &none, &()).unwrap());
        let [found, still] = sums.map(|force| SpringsState::of(&q, &force).swing_omega);
        assert_eq!(still, Vector3::zeros());
        assert!((found + 3.0 * turn).amax() <= 8.0 * EPSILON * 6.0 * size, "{size:e}: {found}");
    }
}

/// Springs and dampers of joints, tendons and cords that are not linear, and what motors add to them.
#[derive(GaussDynamics)]
#[gauss(mjcf = "robots/laws.xml")]
struct Laws;

/// `qacc` of MuJoCo 4.0.0 at both keyframes, as above.
#[test]
fn laws_that_are_not_linear() {
    let kernel = Laws.kernel().unwrap();
    let states = [
        (LawsState::near(), [13.428235294117648, -7.775005072404319, -19.81236565871548]),
        (LawsState::far(), [110.45858823529414, 29.261918061929524, -185.40970317656883]),
    ];
    for (state, expected) in states {
        let (found, expected) =
            (kernel.acceleration(0.0, &state.q(), &state.z(), &SVector::zeros()), SVector::from(expected));
        // Sums of ten terms of products of five numbers, of a size of a few hundred.
        assert!((found - expected).amax() <= 100.0 * EPSILON * expected.amax(), "{found} {expected}");
    }
}
