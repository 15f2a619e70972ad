//! Verdicts on every attribute of MJCF are true, and no attribute of MuJoCo's is missing from the table.

use std::path::{Path, PathBuf};

use super::reference::ELEMENTS;
use super::{grammar, included, read};
use crate::description::{Description, Fault, Joint};
use crate::reference::checks::ReferenceFormat;
use crate::reference::{Element, Verdict};
use crate::text::{Text, Written};

/// Elements with all their attributes, as MuJoCo has them.
const REFERENCE: &str = include_str!("tests/reference.txt");

#[test]
fn every_attribute_has_a_verdict() {
    let joined = REFERENCE.replace("\n    ", " ");
    let lines = joined.lines().filter(|line| line.contains('/'));
    let mut count = 0;
    for (place, attributes) in lines.filter_map(|line| line.split_once(':')) {
        let Some((parent, name)) = place.split_once('/') else { continue };
        let element = Element::find(ELEMENTS, parent, name);
        let element = element.unwrap_or_else(|| panic!("{place} has no verdict"));
        for attribute in attributes.split_whitespace().filter(|_| element.verdict == Verdict::Acts) {
            assert!(element.of(attribute).is_some(), "`{attribute}` of {place} has no verdict");
            count += 1;
        }
    }
    assert!(count > 600, "{count} attributes are in the list");
}

/// Attributes of the grammar that MuJoCo has since 3.12, with their types: each has a verdict, and of those that act as
/// few and as many numbers are read as it lets them be.
#[test]
fn numbers_of_the_grammar_are_read() {
    let format = ReferenceFormat { elements: ELEMENTS, read: beside_others, file: FILE, samples: SAMPLES };
    let joined = grammar::joined();
    let (mut known, mut tried, mut wrong) = (0, 0, Vec::new());
    for (place, attributes) in grammar::rows(&joined) {
        let (parent, name) = place.split_once('/').expect("an element in another");
        let element = Element::find(ELEMENTS, parent, name).unwrap_or_else(|| panic!("{place} has no verdict"));
        for (attribute, kind) in attributes {
            if element.verdict != Verdict::Acts {
                continue;
            }
            known += 1;
            let verdict = element.of(attribute);
            wrong.extend(verdict.is_none().then(|| format!("`{attribute}` of {place} has no verdict")));
            let counts = kind.split_once('(').and_then(|(_, counts)| counts.strip_suffix(')'));
            let Some(counts) = counts.filter(|_| verdict == Some(Verdict::Acts) && format.has(place)) else { continue };
            let ends = counts.split_once("..").unwrap_or((counts, counts));
            for count in [ends.0, ends.1].into_iter().filter_map(|end| end.parse().ok()) {
                tried += 1;
                let refuses =
                    |message: &String| message.contains(&format!("`{attribute}` is ")) && message.contains("number");
                let found = format.faults(place, attribute, &vec!["1"; count].join(" "));
                wrong.extend(
                    found.into_iter().filter(refuses).map(|message| format!("{place}, {count} numbers: {message}")),
                );
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert!(known > 700 && tried > 100, "{known} attributes are known, {tried} counts tried");
}

/// A value of another type than the grammar says is a mistake that names the attribute: a word where numbers are, more
/// or fewer numbers, a fraction where one counts, a word that is none of those.
#[test]
fn values_of_other_types_are_mistakes() {
    let format = ReferenceFormat { elements: ELEMENTS, read: beside_others, file: FILE, samples: SAMPLES };
    let joined = grammar::joined();
    let (mut tried, mut wrong) = (0, Vec::new());
    for (place, attributes) in grammar::rows(&joined).filter(|(place, _)| format.has(place)) {
        let (parent, name) = place.split_once('/').expect("an element in another");
        let element = Element::find(ELEMENTS, parent, name).unwrap_or_else(|| panic!("{place} has no verdict"));
        for (attribute, kind) in attributes {
            // Of gains and biases other words are warned of.
            let is_warned = matches!(attribute, "gaintype" | "biastype");
            if element.verdict != Verdict::Acts || element.of(attribute) != Some(Verdict::Acts) || is_warned {
                continue;
            }
            for value in of_another_type(kind) {
                tried += 1;
                let found = format.faults(place, attribute, &value);
                let is_named = |message: &String| {
                    message.contains(&format!("`{attribute}")) || message.contains(&format!("found `{value}`"))
                };
                let named = found.iter().any(is_named);
                wrong.extend((!named).then(|| format!("{place} {attribute}=\"{value}\" ({kind}): {found:?}")));
            }
        }
    }
    assert!(wrong.is_empty(), "{} of {tried}:\n{}", wrong.len(), wrong.join("\n"));
}

/// Values that are not of a type of the grammar, `real(1..3)`.
fn of_another_type(kind: &str) -> Vec<String> {
    let (word, counts) = kind.split_once('(').unwrap_or((kind, ""));
    let counts = counts.trim_end_matches(')');
    let (least, most) = counts.split_once("..").unwrap_or((counts, counts));
    let many = |count: usize| vec!["1"; count].join(" ");
    let mut all = Vec::new();
    if matches!(word, "real" | "int") {
        all.push(vec!["x"; least.parse().unwrap_or(1)].join(" "));
        all.extend(most.parse().ok().map(|most: usize| many(most + 1)));
        all.extend(least.parse().ok().filter(|least| *least > 1).map(|least: usize| many(least - 1)));
    }
    if word == "int" && most == "1" {
        all.push("1.5".to_owned());
    }
    if matches!(word, "enum" | "bool") {
        all.push("perhaps".to_owned());
    }
    all
}

#[test]
fn verdicts_are_true() {
    let untrue = ReferenceFormat { elements: ELEMENTS, read: beside_others, file: FILE, samples: SAMPLES }.untrue();
    assert!(untrue.is_empty(), "{}", untrue.join("\n"));
}

/// Reads a text with its copies written out, in a folder with another model and a mesh.
fn beside_others(text: &Text) -> Result<Description, Vec<Fault>> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/mjcf/tests/main.xml");
    let (text, faults) = included(Written::new(String::new(), path, text.whole.clone()));
    if faults.is_empty() { read(&text) } else { Err(faults) }
}

pub fn described(inside: &str) -> Description {
    let text = format!("<mujoco>{inside}</mujoco>");
    let written = Written::new(String::new(), PathBuf::new(), text);
    read(&Text::of(written)).unwrap_or_else(|faults| panic!("{inside}: {faults:?}"))
}

pub fn near(a: f64, b: f64) -> bool {
    // MuJoCo's numbers are printed with nine digits and more.
    (a - b).abs() <= 1e-8 * b.abs()
}

/// Numbers of MuJoCo 4.0: `dof_armature`, `jnt_stiffness`, `dof_damping`, `body_mass`.
#[test]
fn roots_of_defaults_are_one_class() {
    let read = described(
        r#"<default><joint armature="0.1"/><default class="a"><joint damping="3"/></default></default>
        <default><joint armature="0.5" stiffness="2"/><geom density="5"/>
            <default class="b"><joint damping="4"/></default></default>
        <worldbody><body><geom size="1"/><joint name="x"/><body><geom size="1"/><joint class="a"/>
            <body><geom size="1"/><joint class="b"/></body></body></body></worldbody>"#,
    );
    let laws = |joint: &Joint| [joint.armature, joint.stiffness, joint.damping];
    let found: Vec<_> = read.joints.iter().map(laws).collect();
    // A class begins with what its root is where it stands.
    assert_eq!(found, [[0.5, 2.0, 0.0], [0.1, 0.0, 3.0], [0.5, 2.0, 4.0]]);
    assert!(read.links.iter().filter_map(|link| link.inertial).all(|own| near(own.mass, 20.94395102)));
    let rotated = described(
        r#"<default><geom euler="90 0 0" type="box" size="1 2 3"/></default><worldbody><body><joint/><geom/></body>
        </worldbody>"#,
    );
    let [[_, _, _], [_, yy, _], [_, _, zz]] = rotated.links[1].inertial.unwrap().inertia;
    assert!(yy < zz, "the third axis of the box, its longest, lies along the second");
}

#[test]
fn classes_have_names_of_their_own() {
    let text =
        r#"<mujoco><default><default class="a"/><default/></default><default><default class="a"/></default></mujoco>"#;
    let written = Written::new(String::new(), PathBuf::new(), text.to_owned());
    let found: Vec<String> = read(&Text::of(written)).unwrap_err().into_iter().map(|fault| fault.message).collect();
    assert_eq!(
        found,
        [r#"<default>: a class in another has a name; write `class="…"`"#, "<default>: a second class is called `a`"]
    );
}

#[test]
fn elements_of_other_languages_are_no_bodies() {
    let inside = r#"<body><joint/><x:joint type="slide"/><geom size="1"/><x:geom size="2"/></body>"#;
    let read = described(&format!("<worldbody>{inside}<x:body><joint/></x:body></worldbody>"));
    assert_eq!((read.links.len(), read.joints.len()), (2, 1));
    assert!(near(read.links[1].inertial.unwrap().mass, 4_188.790_204_786_39));
    let told: Vec<&str> = read.notes.iter().filter(|note| note.ignored.is_some()).map(|note| &*note.text).collect();
    assert_eq!(told, ["<x:joint> is not read; likewise in lines 1, 1"]);
}

const LINKED: &str = r#"<worldbody><body><geom size="0.1"/><geom type="box" size="1 1 1" group="3"/>
    <joint name="x" axis="0 1 0" pos="0.5 0 0" range="-60 90"/>
    <body pos="1 0 0"><geom size="0.2"/><joint name="y" type="slide"/></body></body></worldbody>"#;

/// Numbers of MuJoCo 4.0, `body_mass`.
#[test]
fn groups_of_geoms_that_have_masses() {
    let mass = |clause: &str, bodies: &str| {
        let read = described(&format!("<compiler {clause}/>{bodies}"));
        read.links.iter().find_map(|link| link.inertial).map_or(0.0, |own| own.mass)
    };
    assert!(near(mass(r#"inertiagrouprange="0 0""#, LINKED), 4.1887902047863905));
    assert!(near(mass("", LINKED), 8_004.188_790_204_786_5));
    // Of the first body nothing is left.
    assert!(near(mass(r#"inertiagrouprange="1 3""#, &LINKED.replace("group=\"3\"", "group=\"4\"")), 0.0));
    let framed = LINKED.replace("<geom size=\"0.1\"/>", "<frame pos=\"1 2 3\"><geom size=\"0.1\"/></frame>");
    assert!(near(mass(r#"inertiagrouprange="0 0""#, &framed), 4.1887902047863905));
    let center = described(&framed).links[1].inertial.unwrap().center;
    assert!(near(center[2], 3.0 * 4.1887902047863905 / 8_004.188_790_204_786_5));
}

/// Shells by `body_mass` and `body_inertia` of MuJoCo 4.0; bounds by its source (`mjCBody::Compile`).
#[test]
fn masses_of_shells_and_bounds() {
    let own = |inside: &str| described(inside).links.iter().find_map(|link| link.inertial).unwrap();
    for (kind, size, mass, moments) in [
        ("sphere", "0.3", 11.309733552923255, [0.67858401, 0.67858401, 0.67858401]),
        ("capsule", "0.3 0.7", 37.69911184307752, [14.09318464, 14.09318464, 3.05362806]),
        ("cylinder", "0.3 0.7", 32.044245066615886, [8.39590637, 8.39590637, 2.62951305]),
        ("box", "0.3 0.5 0.7", 56.8, [20.73066667, 16.58133333, 10.91733333]),
    ] {
        let geom = format!(r#"<geom type="{kind}" size="{size}" density="10" shellinertia="true"/>"#);
        let found = own(&format!("<worldbody><body><joint/>{geom}</body></worldbody>"));
        assert!(near(found.mass, mass), "{kind}: {}", found.mass);
        for (i, moment) in moments.into_iter().enumerate() {
            assert!((found.inertia[i][i] - moment).abs() < 1e-8, "{kind}: {:?}", found.inertia);
        }
    }
    // MuJoCo's area of an ellipsoid is Thomsen's, within 1.061 %, and its moments are those of a shell that is thicker
    // at some places: nothing but a sphere is the same.
    let geom = |size: &str| {
        let geom = format!(r#"<geom type="ellipsoid" size="{size}" density="10" shellinertia="true"/>"#);
        described(&format!("<worldbody><body><joint/>{geom}</body></worldbody>"))
    };
    let ball = geom("0.3 0.3 0.3");
    let found = ball.links.iter().find_map(|link| link.inertial).unwrap();
    assert!(near(found.mass, 11.309733552923258) && (found.inertia[0][0] - 0.67858401).abs() < 1e-8, "{found:?}");
    let egg = geom("0.7 0.5 0.3");
    let found = egg.links.iter().find_map(|link| link.inertial).unwrap();
    assert!((found.mass / 30.846140151966374 - 1.0).abs() < 0.01061, "{}", found.mass);
    let notes = egg.links.iter().flat_map(|link| &link.mass_notes);
    let told: Vec<_> = notes.map(|note| (note.ignored.as_deref(), note.text.as_str())).collect();
    assert_eq!(told, [(None, "the mass of <geom> is that of its surface; MuJoCo approximates it, and its moments")]);
    let body = r#"<worldbody><body><inertial mass="1" diaginertia="1 1 3"/><joint/></body></worldbody>"#;
    let moments = |clause: &str| {
        let own = own(&format!("<compiler {clause}/>{body}"));
        (own.mass, [own.inertia[0][0], own.inertia[1][1], own.inertia[2][2]])
    };
    assert_eq!(moments(r#"boundmass="2" boundinertia="1.5""#), (2.0, [1.5, 1.5, 3.0]));
    assert_eq!(moments(r#"balanceinertia="true" boundinertia="1.2""#), (1.0, [1.8; 3]));
}

/// Numbers of MuJoCo: `actuator_gainprm`, `actuator_biasprm` and `actuator_ctrlrange`, the same in 3.3 and 4.0.
#[test]
fn gains_of_actuators() {
    let drive = |defaults: &str, actuator: &str| {
        let read = described(&format!("<default>{defaults}</default>{LINKED}<actuator>{actuator}</actuator>"));
        assert!(read.notes.iter().all(|note| note.ignored.is_none()), "{:?}", read.notes);
        read.drives[0].clone()
    };
    let laws: [(&str, &str, [f64; 3], [f64; 3]); 8] = [
        ("", r#"<motor joint="x"/>"#, [1.0, 0.0, 0.0], [0.0; 3]),
        (r#"<position kp="50"/><velocity kv="7"/>"#, r#"<velocity joint="x"/>"#, [7.0, 0.0, 0.0], [0.0, 0.0, -7.0]),
        (
            r#"<position kp="50" inheritrange="1"/><velocity kv="7"/>"#,
            r#"<motor joint="x"/>"#,
            [1.0, 0.0, 0.0],
            [0.0; 3],
        ),
        (r#"<position kp="50" kv="2"/>"#, r#"<general joint="x"/>"#, [50.0, 0.0, 0.0], [0.0, -50.0, -2.0]),
        (r#"<position kp="2" kv="3"/>"#, r#"<position joint="x" kp="9"/>"#, [9.0, 0.0, 0.0], [0.0, -9.0, -3.0]),
        (r#"<general gainprm="3"/>"#, r#"<position joint="x"/>"#, [3.0, 0.0, 0.0], [0.0, -3.0, 0.0]),
        (
            r#"<position kp="50" kv="2"/><default class="c"><position kv="3"/></default>"#,
            r#"<position class="c" joint="x"/>"#,
            [50.0, 0.0, 0.0],
            [0.0, -50.0, -3.0],
        ),
        ("", r#"<damper joint="x" kv="9" ctrlrange="0 2"/>"#, [0.0, 0.0, -9.0], [0.0; 3]),
    ];
    for (defaults, actuator, gain, bias) in laws {
        let found = drive(defaults, actuator);
        assert_eq!(found.gain, gain, "{defaults} {actuator}");
        assert_eq!(found.bias, bias, "{defaults} {actuator}");
    }
    let inherited = drive("", r#"<position joint="x" kp="9" inheritrange="0.5"/>"#).controls.unwrap();
    assert!(
        near(inherited[0], -std::f64::consts::FRAC_PI_8) && near(inherited[1], 0.9162978572970231),
        "{inherited:?}"
    );
    let limited = drive(r#"<motor ctrlrange="-1 1" forcerange="-2 3" forcelimited="false"/>"#, r#"<motor joint="x"/>"#);
    assert_eq!((limited.controls, limited.forces), (Some([-1.0, 1.0]), None));
}

/// Numbers of MuJoCo 3.3, `actuator_biasprm`; of a joint alone 4.0 has the same.
#[test]
fn ratios_of_damping() {
    let damping = |bodies: &str, actuator: &str| {
        let read = described(&format!("{bodies}<actuator>{actuator}</actuator>"));
        let told = read.notes.into_iter().find(|note| note.ignored.is_some()).map(|note| note.text);
        (read.drives[0].bias[2], told)
    };
    let (turning, told) = damping(LINKED, r#"<position joint="x" kp="9" dampratio="1" gear="2"/>"#);
    assert!(near(turning, -257.07936379), "{turning}");
    assert_eq!(
        told.unwrap(),
        "`dampratio` of <position> is `kv` = 257.0793637856026 with the inertia of its joint by itself, as of MuJoCo 3, \
         not of 4: write `kv`"
    );
    let (sliding, _) = damping(LINKED, r#"<position joint="y" kp="9" dampratio="0.5"/>"#);
    assert!(near(sliding, -17.36643011), "{sliding}");
    let alone = LINKED.replace(r#"<joint name="y" type="slide"/>"#, "");
    let (alone, told) = damping(&alone, r#"<position joint="x" kp="9" dampratio="1" gear="2"/>"#);
    assert_eq!(told, None);
    assert!(near(alone, -257.07936379), "{alone}");
}

/// Versions of MuJoCo differ where defaults of several kinds stand in a class: kp is 7 in 3.3 and 1 in 4.0.
#[test]
fn defaults_of_other_actuators_are_told() {
    let read = described(&format!(
        r#"<default><position kp="50"/><velocity kv="7"/></default>{LINKED}
        <actuator><position joint="x"/><position joint="x" kp="3" kv="2"/></actuator>"#
    ));
    assert_eq!(read.drives[0].gain, [7.0, 0.0, 0.0]);
    assert_eq!((read.drives[1].gain, read.drives[1].bias), ([3.0, 0.0, 0.0], [0.0, -3.0, -2.0]));
    let told: Vec<&str> = read.notes.iter().filter(|note| note.ignored.is_some()).map(|note| &*note.text).collect();
    assert_eq!(
        told,
        [
            "<position> has defaults of <velocity>, of which versions of MuJoCo make different things; write its gains in \
          itself"
        ]
    );
}

const FILE: &str = r#"<mujoco @/mujoco{}>
<compiler @mujoco/compiler{}>@in/compiler{}</compiler><option @mujoco/option{}><flag @option/flag{}/></option>
<default>
  <default class="other"><joint armature="7"/><geom density="7"/><site pos="7 7 7"/><general gear="7"/>
    <tendon stiffness="7"/><equality active="false"/><mesh scale="7 7 7"/></default>
  <default class="m"><mesh @default/mesh{}/></default>
  <default class="e"><equality @default/equality{}/></default><default class="t"><tendon @default/tendon{}/></default>
  <default class="i"><intvelocity @default/intvelocity{}/></default>
  <default class="j"><joint @default/joint{}/></default>
  <default class="h"><adhesion @default/adhesion{}/></default>
  <default class="o"><pair @default/pair{}/></default><default class="p"><pair condim="4"/></default>@in/default{}
</default>@in/mujoco{}
<asset @mujoco/asset{}><mesh @asset/mesh{ class="m" name="m" file="meshes/prism.obj"}/>
  <model @asset/model{ name="leg" file="leg.xml"}/>@in/asset{}</asset>
<worldbody @mujoco/worldbody{}>
  <frame @worldbody/frame{}><site name="g"/><body><joint class="j" name="alone" range="-1 1"/><geom size="1"/></body></frame>
  <body @worldbody/body{}>
    <joint name="a" range="-1 1" stiffness="1" damping="1" frictionloss="1"/><geom name="f" size="1"/>@in/body{}
    <attach @body/attach{ model="leg" prefix="l-"}/>
    <replicate @body/replicate{ count="2"}><body name="r" pos="1 0 0"><joint/><geom size="1"/></body></replicate>
    <body name="b"><joint @body/joint{ name="b"}/><inertial @body/inertial{ mass="1" diaginertia="1 1 3"}/></body>
    <body name="c"><geom @body/geom{ size="1"}/><site @body/site{ name="s"}/><joint name="c"/><site name="q"/><geom size="1"/>
      <geom type="mesh" mesh="m"/></body>
  </body>
  <body name="d"><freejoint @body/freejoint{}/><geom name="h" size="1"/></body>
</worldbody>
<contact><exclude @contact/exclude{ body1="b" body2="c"}/><pair @contact/pair{ geom1="f" geom2="h"}/>
  <pair class="o" geom1="f" geom2="h"/>@in/contact{}</contact>
<tendon><fixed @tendon/fixed{ name="t"}><joint @fixed/joint{ joint="a" coef="1"}/></fixed>
  <fixed name="u" class="t" stiffness="1" damping="1"><joint joint="a" coef="1"/></fixed>
  <spatial @tendon/spatial{ name="v" stiffness="1"}><site site="g"/><pulley @spatial/pulley{ divisor="2"}/>
    <site @spatial/site{ site="g"}/><site site="q"/>@in/spatial{}</spatial>@in/tendon{}</tendon>
<equality>
  <connect @equality/connect{ body1="b" anchor="0 0 1"}/><weld @equality/weld{ body1="b"}/>
  <joint @equality/joint{ joint1="a"}/><joint class="e" joint1="c"/>
  <tendon @equality/tendon{ tendon1="t"}/>@in/equality{}
</equality>
<actuator>
  <motor @actuator/motor{ joint="a"}/><general @actuator/general{ joint="a"}/><position @actuator/position{ joint="a"}/>
  <velocity @actuator/velocity{ joint="a"}/><damper @actuator/damper{ joint="a" ctrlrange="0 1"}/>
  <general class="i" dyntype="none" joint="alone"/><general class="h" joint="a"/>@in/actuator{}
</actuator>
<keyframe><key @keyframe/key{}/></keyframe>
</mujoco>"#;

/// Values with which attributes act.
const SAMPLES: &[(&str, &str, &str)] = &[
    ("mujoco/compiler", "", r#"autolimits="false""#),
    ("mujoco/compiler", "", r#"angle="radian""#),
    ("mujoco/compiler", "", r#"!coordinate="global""#),
    ("mujoco/compiler", "", r#"!eulerseq="xy""#),
    ("mujoco/compiler", "", r#"settotalmass="7""#),
    ("mujoco/compiler", "", r#"boundmass="700000""#),
    ("mujoco/compiler", "", r#"boundinertia="700000""#),
    ("mujoco/compiler", "", r#"balanceinertia="true""#),
    ("mujoco/compiler", "", r#"inertiafromgeom="true""#),
    ("mujoco/compiler", "", r#"inertiagrouprange="1 2""#),
    ("mujoco/compiler", "", r#"!meshdir="no""#),
    ("mujoco/compiler", "", r#"!assetdir="no""#),
    ("mujoco/compiler", "", r#"!strippath="true""#),
    ("mujoco/compiler", "", r#"exactmeshinertia="true""#),
    ("asset/mesh", r#"file="meshes/prism.obj""#, r#"!name="m""#),
    ("asset/mesh", r#"name="m" file="meshes/prism.obj""#, r#"class="other""#),
    ("asset/mesh", r#"name="m""#, r#"!file="meshes/prism.obj""#),
    ("asset/mesh", r#"name="m""#, r#"!vertex="0 0 0 1 0 0 0 1 0 0 0 1""#),
    ("asset/mesh", r#"name="m" vertex="0 0 0 1 0 0 0 1 0 0 0 1""#, r#"!face="0 1 7""#),
    ("asset/mesh", r#"name="m" file="meshes/prism.obj""#, r#"inertia="shell""#),
    ("asset/mesh", r#"name="m" file="meshes/prism.obj""#, r#"scale="1 2 3""#),
    ("asset/mesh", r#"name="m" file="meshes/prism.obj" inertia="convex""#, r#"!maxhullvert="8""#),
    ("asset/mesh", r#"name="m" file="meshes/prism.obj""#, r#"refpos="1 2 3""#),
    ("asset/mesh", r#"name="m" file="meshes/prism.obj""#, r#"refquat="1 2 3 4""#),
    ("asset/model", r#"file="leg.xml""#, r#"!name="leg""#),
    ("asset/model", r#"name="leg""#, r#"!file="leg.xml""#),
    ("default/mesh", "", r#"inertia="exact""#),
    ("default/mesh", "", r#"scale="1 2 3""#),
    ("default/mesh", r#"inertia="convex""#, r#"!maxhullvert="8""#),
    ("body/attach", r#"prefix="l-""#, r#"!model="leg""#),
    ("body/attach", r#"model="leg" prefix="l-""#, r#"body="shin""#),
    ("body/attach", r#"model="leg" prefix="l-""#, r#"!frame="f""#),
    ("body/attach", r#"model="leg""#, r#"!prefix="l-""#),
    ("body/replicate", "", r#"!count="2""#),
    ("body/replicate", r#"count="2""#, r#"offset="1 2 3""#),
    ("body/replicate", r#"count="2""#, r#"euler="1 2 3""#),
    ("body/replicate", r#"count="2""#, r#"sep="-""#),
    ("body/replicate", r#"count="2""#, r#"childclass="other""#),
    ("body/replicate", r#"count="2""#, r#"!prefix="a""#),
    ("mujoco/option", "", r#"gravity="0 0 1""#),
    ("mujoco/option", "", r#"actuatorgroupdisable="0 3""#),
    ("option/flag", "", r#"gravity="disable""#),
    ("option/flag", "", r#"actuation="disable""#),
    ("option/flag", "", r#"clampctrl="disable""#),
    ("option/flag", "", r#"spring="disable""#),
    ("option/flag", "", r#"damper="disable""#),
    ("option/flag", "", r#"passive="disable""#),
    ("option/flag", "", r#"equality="disable""#),
    ("option/flag", "", r#"constraint="disable""#),
    ("option/flag", "", r#"frictionloss="disable""#),
    ("option/flag", "", r#"limit="disable""#),
    ("option/flag", "", r#"contact="disable""#),
    ("option/flag", "", r#"filterparent="disable""#),
    ("default/equality", "", r#"active="false""#),
    ("worldbody/frame", "", r#"childclass="other""#),
    ("worldbody/frame", "", r#"pos="1 2 3""#),
    ("worldbody/frame", "", r#"quat="1 2 3 4""#),
    ("worldbody/frame", "", r#"axisangle="1 2 3 4""#),
    ("worldbody/frame", "", r#"euler="1 2 3""#),
    ("worldbody/frame", "", r#"xyaxes="1 2 3 4 5 7""#),
    ("worldbody/frame", "", r#"zaxis="1 2 3""#),
    ("worldbody/body", "", r#"name="z""#),
    ("worldbody/body", "", r#"childclass="other""#),
    ("worldbody/body", "", r#"gravcomp="1""#),
    ("worldbody/body", "", r#"pos="1 2 3""#),
    ("worldbody/body", "", r#"quat="1 2 3 4""#),
    ("worldbody/body", "", r#"axisangle="1 2 3 4""#),
    ("worldbody/body", "", r#"euler="1 2 3""#),
    ("worldbody/body", "", r#"xyaxes="1 2 3 4 5 7""#),
    ("worldbody/body", "", r#"zaxis="1 2 3""#),
    ("body/inertial", r#"diaginertia="1 2 3""#, r#"!mass="1""#),
    ("body/inertial", r#"mass="1""#, r#"!diaginertia="1 2 3""#),
    ("body/inertial", r#"mass="1" diaginertia="1 2 3""#, r#"fullinertia="2 2 2 0 0 1""#),
    ("body/inertial", r#"mass="1" diaginertia="1 2 3""#, r#"pos="1 2 3""#),
    ("body/inertial", r#"mass="1" diaginertia="1 2 3""#, r#"quat="1 2 3 4""#),
    ("body/inertial", r#"mass="1" diaginertia="1 2 3""#, r#"axisangle="1 2 3 4""#),
    ("body/inertial", r#"mass="1" diaginertia="1 2 3""#, r#"euler="1 2 3""#),
    ("body/inertial", r#"mass="1" diaginertia="1 2 3""#, r#"xyaxes="1 2 3 4 5 7""#),
    ("body/inertial", r#"mass="1" diaginertia="1 2 3""#, r#"zaxis="1 2 3""#),
    ("body/joint", "", r#"name="z""#),
    ("body/joint", "", r#"class="other""#),
    ("body/joint", "", r#"type="slide""#),
    ("body/joint", "", r#"pos="1 2 3""#),
    ("body/joint", "", r#"axis="1 2 3""#),
    ("body/joint", "", r#"range="-1 1""#),
    ("body/joint", r#"range="-1 1""#, r#"limited="false""#),
    ("body/joint", "", r#"ref="7""#),
    ("body/joint", "", r#"springref="7""#),
    ("body/joint", "", r#"stiffness="7""#),
    ("body/joint", "", r#"damping="7""#),
    ("body/joint", "", r#"frictionloss="7""#),
    ("body/joint", "", r#"armature="7""#),
    ("body/joint", "", r#"actuatorfrcrange="-7 7""#),
    ("body/joint", r#"actuatorfrcrange="-7 7""#, r#"actuatorfrclimited="false""#),
    ("default/joint", "", r#"springdamper="1 2""#),
    ("body/freejoint", "", r#"name="z""#),
    ("body/geom", r#"size="1""#, r#"class="other""#),
    ("body/geom", r#"size="1 2 3""#, r#"type="box""#),
    ("body/geom", r#"mass="7""#, r#"size="2""#),
    ("body/geom", r#"type="capsule" size="1 2""#, r#"fromto="0 0 0 1 2 3""#),
    ("body/geom", r#"size="1""#, r#"mass="7""#),
    ("body/geom", r#"size="1""#, r#"density="7""#),
    ("body/geom", r#"size="1""#, r#"shellinertia="true""#),
    ("body/geom", r#"size="1""#, r#"group="7""#),
    ("body/geom", r#"type="mesh" density="7""#, r#"mesh="m""#),
    ("body/geom", r#"size="1""#, r#"pos="1 2 3""#),
    ("body/geom", r#"type="box" size="1 2 3""#, r#"quat="1 2 3 4""#),
    ("body/geom", r#"type="box" size="1 2 3""#, r#"axisangle="1 2 3 4""#),
    ("body/geom", r#"type="box" size="1 2 3""#, r#"euler="1 2 3""#),
    ("body/geom", r#"type="box" size="1 2 3""#, r#"xyaxes="1 2 3 4 5 7""#),
    ("body/geom", r#"type="box" size="1 2 3""#, r#"zaxis="1 2 3""#),
    ("body/geom", r#"size="1""#, r#"name="z""#),
    ("body/geom", r#"size="1""#, r#"contype="2""#),
    ("body/geom", r#"size="1""#, r#"conaffinity="2""#),
    ("body/geom", r#"size="1""#, r#"condim="1""#),
    ("body/geom", r#"size="1""#, r#"priority="2""#),
    ("body/geom", r#"size="1""#, r#"friction="0.5 0.1""#),
    ("body/geom", r#"size="1""#, r#"margin="0.5""#),
    ("body/geom", r#"size="1""#, r#"gap="0.5""#),
    ("body/geom", r#"size="1""#, r#"adhesion="0.5""#),
    ("body/geom", r#"size="1""#, r#"surfacevel="0 0 1 0 0 0""#),
    ("contact/exclude", r#"body2="c""#, r#"!body1="b""#),
    ("contact/exclude", r#"body1="b""#, r#"!body2="c""#),
    ("contact/pair", r#"geom2="h""#, r#"!geom1="f""#),
    ("contact/pair", r#"geom1="f""#, r#"!geom2="h""#),
    ("contact/pair", r#"geom1="f" geom2="h""#, r#"class="p""#),
    ("contact/pair", r#"geom1="f" geom2="h""#, r#"condim="1""#),
    ("contact/pair", r#"geom1="f" geom2="h""#, r#"friction="7""#),
    ("contact/pair", r#"geom1="f" geom2="h""#, r#"margin="7""#),
    ("contact/pair", r#"geom1="f" geom2="h""#, r#"gap="7""#),
    ("contact/pair", r#"geom1="f" geom2="h""#, r#"adhesion="7""#),
    ("default/pair", "", r#"condim="1""#),
    ("default/pair", "", r#"friction="7""#),
    ("default/pair", "", r#"margin="7""#),
    ("default/pair", "", r#"gap="7""#),
    ("default/pair", "", r#"adhesion="7""#),
    ("body/site", "", r#"name="z""#),
    ("body/site", r#"name="z""#, r#"class="other""#),
    ("body/site", r#"name="z""#, r#"pos="1 2 3""#),
    ("body/site", r#"name="z""#, r#"quat="1 2 3 4""#),
    ("body/site", r#"name="z""#, r#"axisangle="1 2 3 4""#),
    ("body/site", r#"name="z""#, r#"euler="1 2 3""#),
    ("body/site", r#"name="z""#, r#"xyaxes="1 2 3 4 5 7""#),
    ("body/site", r#"name="z""#, r#"zaxis="1 2 3""#),
    ("tendon/fixed", r#"stiffness="1""#, r#"name="t""#),
    ("tendon/fixed", r#"name="t""#, r#"class="other""#),
    ("tendon/fixed", r#"name="t""#, r#"stiffness="7""#),
    ("tendon/fixed", r#"name="t""#, r#"damping="7""#),
    ("tendon/fixed", r#"name="t""#, r#"springlength="7""#),
    ("tendon/fixed", r#"name="t""#, r#"range="-7 7""#),
    ("tendon/fixed", r#"name="t" range="-7 7""#, r#"limited="false""#),
    ("spatial/site", "", r#"!site="s""#),
    ("spatial/pulley", "", r#"!divisor="3""#),
    ("fixed/joint", r#"coef="1""#, r#"!joint="a""#),
    ("fixed/joint", r#"joint="a""#, r#"!coef="1""#),
    ("equality/connect", r#"body1="b" anchor="0 0 1""#, r#"class="other""#),
    ("equality/connect", r#"body1="b" anchor="0 0 1""#, r#"active="false""#),
    ("equality/connect", r#"anchor="0 0 1""#, r#"body1="b""#),
    ("equality/connect", r#"body1="b" anchor="0 0 1""#, r#"body2="c""#),
    ("equality/connect", r#"body1="b""#, r#"!anchor="0 0 1""#),
    ("equality/weld", "", r#"body1="b""#),
    ("equality/weld", r#"body1="b""#, r#"body2="c""#),
    ("equality/weld", r#"body1="b""#, r#"anchor="1 2 3""#),
    ("equality/weld", r#"body1="b""#, r#"relpose="1 2 3 1 2 3 4""#),
    ("equality/joint", "", r#"!joint1="a""#),
    ("equality/joint", r#"joint1="a""#, r#"joint2="c""#),
    ("equality/joint", r#"joint1="a""#, r#"polycoef="7 0 0 0 0""#),
    ("equality/tendon", "", r#"!tendon1="t""#),
    ("equality/tendon", r#"tendon1="t""#, r#"tendon2="u""#),
    ("equality/tendon", r#"tendon1="t""#, r#"polycoef="7 0 0 0 0""#),
    ("actuator/motor", r#"joint="a""#, r#"name="z""#),
    ("actuator/motor", r#"joint="a""#, r#"class="other""#),
    ("actuator/motor", "", r#"joint="a""#),
    ("actuator/motor", "", r#"jointinparent="a""#),
    ("actuator/motor", r#"joint="a""#, r#"site="g""#),
    ("actuator/motor", "", r#"tendon="t""#),
    ("actuator/motor", r#"joint="a""#, r#"!group="x""#),
    ("actuator/motor", r#"joint="a""#, r#"gear="7""#),
    ("actuator/motor", r#"joint="a""#, r#"damping="7""#),
    ("actuator/motor", r#"joint="a""#, r#"armature="7""#),
    ("actuator/motor", r#"joint="a""#, r#"ctrlrange="-7 7""#),
    ("actuator/motor", r#"joint="a" ctrlrange="-7 7""#, r#"ctrllimited="false""#),
    ("actuator/motor", r#"joint="a""#, r#"forcerange="-7 7""#),
    ("actuator/motor", r#"joint="a" forcerange="-7 7""#, r#"forcelimited="false""#),
    ("actuator/general", r#"joint="a""#, r#"gainprm="7""#),
    ("actuator/general", r#"joint="a" biasprm="7""#, r#"biastype="affine""#),
    ("actuator/general", r#"joint="a" biastype="affine""#, r#"biasprm="7""#),
    ("actuator/general", r#"joint="a" gainprm="7 8 9""#, r#"gaintype="affine""#),
    ("actuator/general", r#"joint="a" biastype="affine" biasprm="0 -1""#, r#"inheritrange="1""#),
    ("actuator/position", r#"joint="a""#, r#"kp="7""#),
    ("actuator/position", r#"joint="a""#, r#"kv="7""#),
    ("actuator/position", r#"joint="alone""#, r#"dampratio="7""#),
    ("actuator/position", r#"joint="a""#, r#"inheritrange="0.5""#),
    ("actuator/velocity", r#"joint="a""#, r#"kv="7""#),
    ("default/intvelocity", "", r#"kp="7""#),
    ("default/intvelocity", "", r#"kv="7""#),
    ("default/intvelocity", "", r#"dampratio="7""#),
    ("default/intvelocity", "", r#"inheritrange="0.5""#),
    ("default/adhesion", "", r#"gain="7""#),
    ("keyframe/key", "", r#"name="z""#),
    ("keyframe/key", "", r#"!qpos="1""#),
    ("keyframe/key", "", r#"!qvel="1""#),
    ("keyframe/key", "", r#"!ctrl="1""#),
];
