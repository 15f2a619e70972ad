//! Joints: what their attributes say, and those of what drives them.

use std::path::PathBuf;

use super::read;
use super::tests::{described, near};
use crate::description::{Description, Joint};
use crate::text::{Text, Written};

/// `jnt_stiffness`, `jnt_stiffnesspoly`, `dof_damping` and the like of MuJoCo 4.0.0: what actuators add counts by the
/// square of their gears, also where they are switched off.
#[test]
fn springs_and_dampers_of_three_numbers() {
    let text = |joint: &str, more: &str| {
        described(&format!(
            r#"<default><default class="c"><joint stiffness="10 4 50" damping="1 -2"/></default></default><worldbody><body>
            <joint name="a" {joint}/><geom size="1"/></body></worldbody>{more}"#
        ))
    };
    let of = |joint: &Joint| (joint.stiffness, joint.damping, joint.nonlinear.stiffness, joint.nonlinear.damping);
    let ignored = |read: &Description| read.notes.iter().filter(|note| note.ignored.is_some()).count();
    assert_eq!(of(&text(r#"class="c""#, "").joints[0]), (10.0, 1.0, [4.0, 50.0], [-2.0, 0.0]));
    let ball = text(r#"class="c" type="ball" range="0 90""#, "");
    assert_eq!((of(&ball.joints[0]), ignored(&ball)), ((10.0, 1.0, [0.0; 2], [0.0; 2]), 1));
    let motors = r#"<tendon><fixed name="t" damping="3"><joint joint="a" coef="2"/></fixed></tendon><actuator>
        <motor joint="a" gear="3" damping="1 2 0.5" armature="0.25" group="1"/><motor joint="a" gear="-2" damping="0.5"/>
        <motor tendon="t" gear="0.5" damping="1 2"/></actuator>"#;
    for more in ["", r#"<option actuatorgroupdisable="1"><flag actuation="disable"/></option>"#] {
        let read = text("", &format!("{motors}{more}"));
        assert_eq!((of(&read.joints[0]), read.joints[0].armature), ((0.0, 11.0, [0.0; 2], [18.0, 4.5]), 2.25));
        assert_eq!((read.tendons[0].damping, read.tendons[0].nonlinear.damping), (3.25, [0.5, 0.0]));
        assert_eq!(ignored(&read), 0, "{:?}", read.notes);
    }
    let off = text(r#"class="c""#, &format!(r#"{motors}<option><flag damper="disable" spring="disable"/></option>"#));
    assert_eq!((of(&off.joints[0]), off.joints[0].armature), ((0.0, 0.0, [0.0; 2], [0.0; 2]), 2.25));
    let heavy = text("", &motors.replace("damping=\"1 2\"", "armature=\"1\""));
    assert_eq!(ignored(&heavy), 1, "{:?}", heavy.notes);
}

/// `jnt_pos`, `jnt_axis`, `dof_damping`, `body_ipos` and `body_mass` of MuJoCo 4.0; 3.3 leaves out the frame of
/// <inertial>.
#[test]
fn joints_and_masses_in_frames() {
    let read = described(
        r#"<default><default class="c"><joint damping="5"/></default></default><worldbody><body name="b" pos="1 0 0">
        <frame pos="0 1 0" euler="0 90 0" childclass="c"><joint name="a" pos="0 0 1"/><frame euler="90 0 0">
        <joint name="s" type="slide"/></frame><inertial mass="2" pos="1 0 0" diaginertia="1 2 3"/></frame>
        <joint name="z"/></body></worldbody>"#,
    );
    let joint = |name: &str| read.joints.iter().find(|joint| joint.name == name).unwrap();
    assert_eq!((joint("a").position, joint("a").axis, joint("a").damping), ([2.0, 1.0, 0.0], [1.0, 0.0, 0.0], 5.0));
    assert_eq!((joint("s").axis, joint("s").damping), ([0.0, -1.0, 0.0], 5.0));
    assert_eq!((joint("z").axis, joint("z").damping), ([0.0, 0.0, 1.0], 0.0));
    let own = read.links.iter().find_map(|link| link.inertial).unwrap();
    assert!((0..3).all(|i| (own.center[i] - [0.0, 1.0, -1.0][i]).abs() < 1e-15), "{:?}", own.center);
    assert_eq!((own.mass, own.inertia[0][0], own.inertia[2][2]), (2.0, 3.0, 1.0));
    let told: Vec<&str> = read.notes.iter().filter(|note| note.ignored.is_some()).map(|note| &*note.text).collect();
    assert_eq!(told, ["<inertial> is placed by the <frame> that it is in, as of MuJoCo 4, not of 3"]);
}

/// `tendon_lengthspring`, `jnt_stiffness`, `dof_damping` and `jnt_limited` of MuJoCo 3.3 and 4.0.
#[test]
fn rests_times_and_ranges() {
    let body =
        |joint: &str| format!(r#"<worldbody><body><joint name="a" {joint}/><geom size="1"/></body></worldbody>"#);
    let tendon = r#"<tendon><fixed stiffness="3"><joint joint="a" coef="2"/></fixed></tendon>"#;
    let rest = |joint: &str| described(&format!("{}{tendon}", body(joint))).tendons[0].rest[0];
    assert!(near(rest(r#"ref="90" springref="30""#), 1.0471975511965976));
    assert_eq!(rest(r#"ref="90""#), 0.0);
    let geom = r#"<geom size="0.1" mass="3" pos="0 1 0"/>"#;
    let tuned = |total: &str| {
        let joint = r#"<joint springdamper="0.5 0.7" stiffness="9" armature="2"/>"#;
        let read = described(&format!("{total}<worldbody><body>{joint}{geom}</body></worldbody>"));
        [read.joints[0].stiffness, read.joints[0].damping]
    };
    let expected = [("", [40.91428571, 20.048]), (r#"<compiler settotalmass="30"/>"#, [262.20408163, 128.48])];
    for (total, [stiffness, damping]) in expected {
        let found = tuned(total);
        assert!(near(found[0], stiffness) && near(found[1], damping), "{found:?}");
    }
    for range in ["0 0", "1 1"] {
        assert_eq!(described(&body(&format!(r#"range="{range}""#))).joints[0].limits, [None; 2]);
    }
}

/// `jnt_range` and the refusals of MuJoCo 4.0.0.
#[test]
fn ranges_of_balls() {
    let text = |joint: &str| {
        let body = format!(r#"<worldbody><body><joint name="a" {joint}/><geom size="1"/></body></worldbody>"#);
        let written = Written::new(String::new(), PathBuf::new(), format!("<mujoco>{body}</mujoco>"));
        let found = read(&Text::of(written));
        found.map(|read| (read.joints[0].limits, read.notes.len())).map_err(|faults| faults[0].message.clone())
    };
    let ball = |range: &str| text(&format!(r#"type="ball" {range}"#));
    assert_eq!(ball(r#"range="0 60""#), Ok(([None, Some(1.0471975511965976)], 0)));
    // Nothing turns farther.
    assert_eq!(ball(r#"range="0 180""#), Ok(([None; 2], 0)));
    assert_eq!(ball(r#"range="0 60" limited="false""#), Ok(([None; 2], 0)));
    let from = r#"<joint name="a">: the range of a ball is that of the angle of its turn, from 0"#;
    assert_eq!(ball(r#"range="20 60""#), Err(from.to_owned()));
    let none = r#"<joint name="a">: a range is from its least to its most, found 0 to 0"#;
    assert_eq!([ball(r#"limited="true""#), text(r#"limited="true""#)], [Err(none.to_owned()), Err(none.to_owned())]);
}

/// `qfrc_actuator` of MuJoCo 4.0.0 for a ball and for a free joint: as many numbers of the gear as these have speeds.
#[test]
fn drives_of_joints_with_several_coordinates() {
    let read = described(
        r#"<worldbody><body><joint name="b" type="ball"/><geom size="1"/></body><body><freejoint name="f"/>
        <geom size="1"/></body></worldbody><actuator><motor joint="b" gear="1 2 3 4"/><motor jointinparent="b"/>
        <motor name="m" joint="f" gear="1 2 3 4 5 6"/></actuator>"#,
    );
    assert_eq!(read.notes.len(), 0, "{:?}", read.notes);
    let found = read.drives.iter().map(|drive| {
        let at = drive.at_joint.as_ref().unwrap();
        (drive.name.as_str(), at.name.as_str(), at.wrench, at.in_parent)
    });
    let none = [0.0; 3];
    let expected = [
        ("b", "b", [none, [1.0, 2.0, 3.0]], false),
        ("b", "b", [none, [1.0, 0.0, 0.0]], true),
        ("m", "f", [[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]], false),
    ];
    assert_eq!(found.collect::<Vec<_>>(), expected);
}
