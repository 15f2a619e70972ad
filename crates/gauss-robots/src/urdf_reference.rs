//! Verdicts on every element and attribute of URDF, by its specification (<https://wiki.ros.org/urdf/XML>) and by what
//! urdfdom 5.1 reads besides.

use super::reference::Verdict::{self, Acts, Harmless, Warned};
use super::reference::{Element, element, whole};

const NAME: Verdict = Harmless("a name that nothing asks for");
const LOOKS: Verdict = Harmless("how it looks");
const SEVERAL: Verdict = Warned("gears that join several joints are not read: its joints have efforts", "");

pub const ELEMENTS: &[Element] = &[
    element("", "robot", &[&[("name", NAME), ("version", Acts), ("schemaLocation", Harmless("where its grammar is"))]]),
    element("robot", "link", &[&[("name", Acts), ("type", Harmless("a word for programs that show it"))]]),
    element("link", "inertial", &[]),
    element("joint inertial collision", "origin", &[&[("xyz rpy quat_xyzw", Acts)]]),
    element("inertial", "mass", &[&[("value", Acts)]]),
    element("inertial", "inertia", &[&[("ixx ixy ixz iyy iyz izz", Acts)]]),
    whole("link", "visual", LOOKS),
    element("link", "collision", &[&[("name", Acts), ("group", Harmless("a word for programs that load it"))]]),
    whole("collision", "verbose", Harmless("a word for programs that load it")),
    element("collision", "geometry", &[]),
    element("geometry", "sphere", &[&[("radius", Acts)]]),
    element("geometry", "capsule cylinder", &[&[("radius length", Acts)]]),
    element("geometry", "box", &[&[("size", Acts)]]),
    element(
        "geometry",
        "mesh",
        &[&[("filename scale", Harmless("where it is to touch, that it does not is a warning"))]],
    ),
    whole("robot", "material", LOOKS),
    whole("robot link", "sensor", Harmless("what is measured")),
    whole("robot", "version", Harmless("the version of the format")),
    whole("robot link joint", "gazebo", Warned("what Gazebo adds is not read", "")),
    whole("robot", "ros2_control", Warned("its interfaces are not read: inputs are efforts", "")),
    whole("robot", "mujoco", Warned("what MuJoCo adds is not read", "")),
    element("robot", "joint", &[&[("name type", Acts)]]),
    element("joint", "parent child", &[&[("link", Acts)]]),
    element("joint", "axis", &[&[("xyz", Acts)]]),
    element("joint", "dynamics", &[&[("damping friction", Acts)]]),
    element(
        "joint",
        "limit",
        &[&[
            ("lower upper effort", Acts),
            (
                "velocity",
                Harmless("no force keeps a rate within it: Pinocchio and MuJoCo only keep it, or leave it out"),
            ),
            ("acceleration deceleration jerk", Harmless("for those who plan a way: no force keeps a joint within it")),
        ]],
    ),
    element("joint", "mimic", &[&[("joint multiplier offset", Acts)]]),
    whole("joint", "calibration", Harmless("where the marks of encoders are")),
    whole(
        "joint",
        "safety_controller",
        Warned("it is a law of a controller; `drive(…)` of the struct can have one", ""),
    ),
    element("robot", "transmission", &[&[("name", NAME), ("type", Harmless("its joints say what it drives"))]]),
    whole("transmission", "type", Harmless("its joints say what it drives")),
    element("transmission", "joint", &[&[("name", Acts)]]),
    element("transmission", "actuator", &[&[("name", Acts)]]),
    element("transmission actuator joint", GEARS, &[&[("value", Acts)]]),
    element("transmission actuator", ROTORS, &[&[("value", Acts)]]),
    whole("actuator joint", "hardwareInterface", Harmless("the input is an effort, which is told where this is none")),
    whole("actuator joint", "role", Harmless("a word for programs that load it")),
    whole("joint", "offset", Warned("coordinates are those of joints", "0")),
    whole("actuator", "motorTorqueConstant", Harmless("the input is an effort, not a current")),
    whole("transmission", "leftActuator rightActuator flexJoint rollJoint gap_joint passive_joint", SEVERAL),
    whole("transmission", "compensator use_simulated_gripper_joint simulated_reduction", SEVERAL),
];

/// Elements whose text, or `value`, is how many times a motor turns while its joint turns once; its inertia.
const GEARS: &str = "mechanicalReduction mechanical_reduction gear_ratio";
const ROTORS: &str = "rotorInertia rotor_inertia motorInertia motor_inertia";

#[cfg(test)]
mod tests {
    use super::ELEMENTS;
    use crate::reference::checks::ReferenceFormat;
    use crate::urdf::read;

    #[test]
    fn verdicts_are_true() {
        let untrue = ReferenceFormat { elements: ELEMENTS, read, file: FILE, samples: SAMPLES }.untrue();
        assert!(untrue.is_empty(), "{}", untrue.join("\n"));
    }

    const FILE: &str = r#"<robot @/robot{ version="1.1"}>
        <link @robot/link{ name="a"}/>
        <link name="b">
            <inertial><origin @inertial/origin{}/><mass @inertial/mass{ value="1"}/>
                <inertia @inertial/inertia{ ixx="1" iyy="2" izz="3"}/></inertial>@in/link{}
            <collision @link/collision{}><origin @collision/origin{}/><geometry>
                <sphere @geometry/sphere{ radius="1"}/></geometry>@in/collision{}</collision>
            <collision><geometry><cylinder @geometry/cylinder{ radius="1" length="2"}/></geometry></collision>
            <collision><geometry><box @geometry/box{ size="1 2 3"}/></geometry></collision>
        </link>
        <joint @robot/joint{ name="j" type="revolute"}>
            <parent @joint/parent{ link="a"}/><child @joint/child{ link="b"}/><origin @joint/origin{}/>
            <axis @joint/axis{ xyz="0 0 1"}/><dynamics @joint/dynamics{}/><limit @joint/limit{}/>@in/joint{}
        </joint>
        <joint name="k" type="revolute"><parent link="a"/><child link="c"/><mimic @joint/mimic{ joint="j"}/></joint>
        <transmission @robot/transmission{ name="t"}>
            <joint @transmission/joint{ name="j"}/>
            <actuator @transmission/actuator{ name="m"}>
                <mechanicalReduction @actuator/mechanicalReduction{ value="2"}/>
                <rotorInertia @actuator/rotorInertia{ value="3"}/>@in/actuator{}
            </actuator>@in/transmission{}
        </transmission>@in/robot{}
    </robot>"#;

    const SAMPLES: &[(&str, &str, &str)] = &[
        ("robot/link", "", r#"!name="a""#),
        ("inertial/origin", "", r#"xyz="1 2 3""#),
        ("inertial/origin", "", r#"rpy="1 2 3""#),
        ("inertial/origin", "", r#"quat_xyzw="1 2 3 4""#),
        ("/robot", "", r#"!version="2.0""#),
        ("inertial/mass", "", r#"!value="1""#),
        ("inertial/inertia", r#"iyy="2" izz="3""#, r#"!ixx="1""#),
        ("inertial/inertia", r#"ixx="2" izz="3""#, r#"!iyy="1""#),
        ("inertial/inertia", r#"ixx="2" iyy="3""#, r#"!izz="1""#),
        ("inertial/inertia", r#"ixx="1" iyy="2" izz="3""#, r#"ixy="1""#),
        ("inertial/inertia", r#"ixx="1" iyy="2" izz="3""#, r#"ixz="1""#),
        ("inertial/inertia", r#"ixx="1" iyy="2" izz="3""#, r#"iyz="1""#),
        ("link/collision", "", r#"name="z""#),
        ("geometry/sphere", "", r#"!radius="1""#),
        ("geometry/cylinder", r#"length="1""#, r#"!radius="1""#),
        ("geometry/cylinder", r#"radius="1""#, r#"!length="1""#),
        ("geometry/box", "", r#"!size="1 1 1""#),
        ("robot/joint", r#"type="revolute""#, r#"!name="j""#),
        ("robot/joint", r#"name="j""#, r#"!type="revolute""#),
        ("joint/parent", "", r#"!link="a""#),
        ("joint/axis", "", r#"!xyz="0 1 0""#),
        ("joint/dynamics", "", r#"damping="1""#),
        ("joint/dynamics", "", r#"friction="1""#),
        ("joint/limit", "", r#"lower="-1""#),
        ("joint/limit", "", r#"upper="1""#),
        ("joint/limit", "", r#"effort="7""#),
        ("joint/mimic", "", r#"!joint="j""#),
        ("joint/mimic", r#"joint="j""#, r#"multiplier="7""#),
        ("joint/mimic", r#"joint="j""#, r#"offset="7""#),
        ("transmission/joint", "", r#"!name="j""#),
        ("transmission/actuator", "", r#"name="z""#),
        ("actuator/mechanicalReduction", "", r#"!value="7""#),
        ("actuator/rotorInertia", "", r#"!value="7""#),
    ];
}
