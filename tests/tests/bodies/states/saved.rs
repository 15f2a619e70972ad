//! Parameters, states and runs written as data and read again: the same bits, by names; what is no state is refused.

use gauss_runtime::prelude::*;
use gauss_runtime::saved::{Coordinates, Record, Speeds, checked};
use serde::de::value::{Error, MapDeserializer};
use serde::{Deserialize, Serialize};
use serde_json::{Value, from_str, from_value, json, to_string, to_value};

use super::{FixedKernel, FreeKernel, JetKernel, Mixed, MixedKernel, MixedState, PlanarKernel, pose};

/// Numbers whose decimals are long.
fn number(i: usize) -> f64 {
    (1.0 + i as f64).sqrt() - 2.0 / 3.0
}

fn speeds<S: GaussSystem<Scalar = f64>>() -> S::Speeds {
    let mut z = S::Speeds::zero();
    (0..S::DOF).for_each(|i| z.set_component(i, number(i)));
    z
}

/// There and back, also without names.
fn returns<S: GaussSystem<Scalar = f64, Configuration: PartialEq, Speeds: PartialEq> + DescribedSystem>(
    q: S::Configuration,
) {
    let z = speeds::<S>();
    let (written, fast) = (to_value(Coordinates::<S>(q)).expect("data"), to_value(Speeds::<S>(z)).expect("data"));
    for (data, names) in [(&written, S::COORDINATE_NAMES), (&fast, S::SPEED_NAMES)] {
        let mut keys: Vec<&str> = data.as_object().expect("names").keys().map(String::as_str).collect();
        let mut names = names.to_vec();
        keys.sort_unstable();
        names.sort_unstable();
        assert_eq!(keys, names);
    }
    let by_order = Value::from_iter(S::COORDINATE_NAMES.iter().map(|&name| written[name].clone()));
    for data in [written, by_order] {
        assert!(from_str::<Coordinates<S>>(&data.to_string()).expect("a configuration").0 == q);
    }
    assert!(from_value::<Speeds<S>>(fast).expect("speeds").0 == z);
}

#[test]
fn every_kind_of_state() {
    let turn = UnitQuaternion::from_euler_angles(0.3, 0.2, 0.1);
    returns::<FreeKernel>(pose());
    returns::<FixedKernel>(turn);
    returns::<PlanarKernel>(Isometry2::new(Vector2::new(1.0, 2.0), 0.7));
    returns::<JetKernel>(SVector::from(std::array::from_fn(number)));
    returns::<MixedKernel<f64>>((pose(), (turn, SVector::from([0.1, 0.2, 1.0 / 3.0]))));
}

#[test]
fn runs() {
    let kernel = Mixed { m: 1.0 }.kernel().expect("two bodies and a particle");
    let state = MixedState { craft: pose(), third: 1.0, ..MixedState::default() };
    let run = Simulation::new(&kernel)
        .until(Crossing::Rising, |_, q, _| q.1.1[2] - 0.5)
        .fixed_step(0.125)
        .run(state.q(), state.z(), 0.0..2.0)
        .expect("a run");
    let text = to_string(&run).expect("data");
    let read: Record<MixedKernel<f64>> = from_str(&text).expect("a run");
    // Numbers alone, in their order: 8 bytes each and few besides.
    let bytes = postcard::to_allocvec(&run).expect("bytes");
    let sample = 1 + MixedKernel::<f64>::COORDINATE_NAMES.len() + 2 * MixedKernel::<f64>::DOF;
    assert!(bytes.len() < 9 * sample * (run.len() + 1), "{} bytes", bytes.len());
    let again: Record<MixedKernel<f64>> = postcard::from_bytes(&bytes).expect("a run");
    for read in [&read, &again] {
        assert_eq!((read.samples.len(), read.events.len(), read.stopped_by), (run.len(), 1, Some(0)));
        for (read, made) in read.samples.iter().chain([&read.events[0].sample]).zip(run.iter().chain([run.last()])) {
            assert_eq!((read.t, read.q, read.z, read.p), (made.t, made.q, made.z, made.p));
        }
    }
    assert!(postcard::from_bytes::<Record<MixedKernel<f64>>>(&bytes[..bytes.len() - 9]).is_err());
    assert_eq!(to_string(&read).expect("data"), text);
    let first = &to_value(&run).expect("data")["samples"][0];
    assert_eq!((&first["q"]["craft_z"], &first["z"]["third"], &first["t"]), (&json!(3.0), &json!(1.0), &json!(0.0)));
    assert!(text.starts_with(r#"{"samples":[{"t":0.0,"q":{"craft_i":"#), "{text}");
}

fn refusal<T: for<'de> Deserialize<'de>>(data: Value) -> String {
    from_value::<T>(data).err().expect("refused").to_string()
}

#[test]
fn what_is_no_state_is_refused() {
    type Turn = Coordinates<FixedKernel>;
    let turn = |w: f64| json!({"rotation_i": 0.6, "rotation_j": 0.0, "rotation_k": 0.0, "rotation_w": w});
    let without = |name: &str| {
        let mut data = turn(0.8);
        data.as_object_mut().expect("names").remove(name);
        data
    };
    assert_eq!(
        refusal::<Turn>(turn(1.0)),
        "the components of a rotation belong to none: their squares should add up to 1 and are 3.6e-1 away"
    );
    assert_eq!(refusal::<Turn>(without("rotation_w")), "missing field `rotation_w`");
    assert!(
        refusal::<Turn>(json!({"pitch": 0.0})).starts_with("unknown field `pitch`, expected one of `rotation_i`, ")
    );
    assert!(
        refusal::<Turn>(json!([0.6, 0.0])).contains("invalid length 2, expected 4 numbers: rotation_i, rotation_j")
    );
    assert!(refusal::<Turn>(json!("upright")).contains("expected 4 numbers"));
    let twice = r#"{"rotation_i": 0.6, "rotation_i": 0.6}"#;
    let twice = from_str::<Turn>(twice).expect_err("refused").to_string();
    assert!(twice.starts_with("duplicate field `rotation_i`"), "{twice}");

    // JSON has no NaN; other formats have.
    let numbers =
        |last: f64| ["rotation_i", "rotation_j", "rotation_k", "rotation_w"].into_iter().zip([0.6, 0., 0., last]);
    let read = |last| Turn::deserialize(MapDeserializer::<_, Error>::new(numbers(last))).map(|turn| turn.0);
    assert!(read(0.8).is_ok());
    for bad in [f64::NAN, f64::INFINITY] {
        assert_eq!(read(bad).expect_err("refused").to_string(), "`rotation_w` is infinite or undefined");
    }
    let fast = FixedKernel::SPEED_NAMES.iter().copied().zip([1.0, f64::NAN, 1.0]);
    let fast = Speeds::<FixedKernel>::deserialize(MapDeserializer::<_, Error>::new(fast));
    assert_eq!(fast.expect_err("refused").to_string(), "`omega_y` is infinite or undefined");
}

/// Every type that parameters have.
#[derive(GaussDynamics, Serialize, Deserialize, Clone, Debug, PartialEq)]
#[gauss(coordinates(angle), body(arm, rotation = rotation_y(angle)), body(hand, parent = arm, position = grip))]
struct Parameters {
    #[gauss(body)]
    arm: RigidBody<f64, AboutCenterOfMass<f64>>,
    #[gauss(body)]
    hand: RigidBody<f64>,
    grip: Vector3<f64>,
    #[gauss(gravity)]
    g: f64,
}

#[test]
fn parameters() {
    let inertia = Matrix3::from_diagonal(&Vector3::new(0.2, 0.2, number(0)));
    let center = Vector3::new(number(1), 0.0, -0.5);
    let made = Parameters {
        arm: RigidBody::about_center_of_mass(number(2), center, inertia),
        hand: RigidBody { mass: 0.3, center_of_mass: Vector3::zeros(), inertia },
        grip: Vector3::new(0.0, 0.0, number(3)),
        g: 9.81,
    };
    let data = to_value(&made).expect("data");
    assert_eq!(data["arm"]["center_of_mass"], json!([number(1), 0.0, -0.5]));
    let read: Parameters = from_str(&data.to_string()).expect("parameters");
    assert_eq!(read, made);
    let q = SVector::from([0.3]);
    let [mass, again] = [made, read].map(|arm| arm.kernel().expect("bodies").mass_matrix(0.0, &q));
    assert_eq!(mass, again);
    // What numbers mean is for `kernel()` to check.
    let mut massless = data;
    massless["hand"]["mass"] = json!(-1.0);
    let read: Parameters = from_value(massless).expect("numbers");
    assert!(read.kernel().is_err());
}

/// A pose in a struct of one's own.
#[derive(Serialize, Deserialize)]
struct Mounted {
    #[serde(with = "checked")]
    pose: Isometry3<f64>,
}

#[test]
fn poses_of_own_structs_are_checked() {
    let text = to_string(&Mounted { pose: pose() }).expect("data");
    assert!(from_str::<Mounted>(&text).expect("a pose").pose == pose());
    let zero = json!({"pose": {"rotation": [0.0, 0.0, 0.0, 0.0], "translation": [1.0, 2.0, 3.0]}});
    assert!(refusal::<Mounted>(zero).contains("belong to none"));
}
