//! Links that touch each other: which do, by what names, and what is refused and told.

use super::{Scratch, joint, link, mistakes, model, remarks, robot};
use crate::model::{ContactGeometry, Counterpart};

const SPHERE: &str = "<sphere radius=\"0.1\"/>";
const PILL: &str = "<capsule radius=\"0.1\" length=\"0.5\"/>";

/// A shape in a link that turns on another.
fn limb(name: &str, on: &str, geometry: &str) -> String {
    let shape = format!("<collision><origin xyz=\"0 0 1\"/><geometry>{geometry}</geometry></collision>");
    joint(&format!("{name}_joint"), "revolute", on, name, "")
        + &link(name).replace("</link>", &format!("{shape}</link>"))
}

/// A trunk with two arms, of which one has a hand.
fn arms(arm: &str, hand: &str) -> String {
    let parts = [limb("trunk", "base", SPHERE), limb("left", "trunk", arm), limb("right", "trunk", arm)];
    robot(&(parts.concat() + &limb("hand", "left", hand)))
}

fn names(text: &str, clauses: &str) -> Vec<String> {
    let contacts = model(text, clauses, "").contacts;
    contacts.iter().flat_map(|clause| &clause.names).map(ToString::to_string).collect()
}

#[test]
fn links_that_do_not_hang_on_one_another() {
    let text = arms(SPHERE, SPHERE);
    assert_eq!(names(&text, ", self_contact"), ["trunk_hand", "left_right", "right_hand"]);
    assert_eq!(names(&text, ", self_contact(links = [trunk, hand, left])"), ["trunk_hand"]);
    // Capsules do not touch one another; a sphere comes first.
    let read = model(&arms(PILL, SPHERE), ", self_contact(friction = mu, along = [1, 0, 0])", "mu: f64");
    let found: Vec<String> = read.contacts.iter().map(|clause| clause.names[0].to_string()).collect();
    assert_eq!(found, ["trunk_hand", "hand_right"]);
    let ContactGeometry::Point(contact) = &read.contacts[1].touching else { panic!("a point") };
    let Counterpart::Sphere { end: Some(_), radius: Some(_), along: Some(_), .. } = &contact.against else {
        panic!("a capsule")
    };
    let points: Vec<String> = read.points.iter().map(|point| point.name.to_string()).collect();
    let expected =
        ["trunk_hand_point", "trunk_hand_other", "hand_right_point", "hand_right_other", "hand_right_other_end"];
    assert_eq!(points, expected);
    assert!(read.contacts[1].links.each_ref().map(|own| own.as_ref().unwrap().to_string()) == ["hand", "right"]);
}

#[test]
fn mistakes_stand_at_their_words() {
    let text = arms(SPHERE, SPHERE);
    let nothing = "no links of the file touch each other here; those that do are spheres, or a sphere and a capsule, of \
                   two links that the file lets touch and of which one moves";
    let rub = "a shape of `trunk` and a shape of `hand` rub, and tangents turn with their line of centers: add `along = \
               [0, 0, 1]`, a direction that no such line has, or `friction = 0`";
    let cases = [
        ("self_contact(friction = 0.5)", rub),
        ("self_contact(links = [trunk, left])", nothing),
        (
            "self_contact(links = [trunk, lft])",
            "`self_contact` is touched by `lft`, which is no link; did you mean `left`?",
        ),
        ("self_contact(plane = [0, 0, 1])", "unknown argument of `self_contact`: `plane`; write `along`, `friction`"),
        (
            "self_contact = 0.5",
            "`self_contact` takes brackets, not `=`; write `self_contact(links = [left_hand, trunk])`, or `self_contact` \
             alone",
        ),
        ("self_contcat", "unknown clause `self_contcat`; did you mean `self_contact`?"),
    ];
    for (clause, expected) in cases {
        let found = mistakes(&text, &format!(", {clause}"), "").remove(0);
        let is_prefix = clause.contains("plane") && found.starts_with("unknown argument of `self_contact`: `plane`");
        assert!(found == expected || is_prefix, "{clause}: {found}");
    }
    assert_eq!(names(&text, ", self_contact(friction = 0)").len(), 3);
}

#[test]
fn what_is_told() {
    let box_shape = "<box size=\"1 1 1\"/>";
    let told = |text: &str, clauses: &str| -> Vec<(String, bool)> {
        let own = remarks(text, clauses).into_iter();
        own.map(|(text, ignored)| (text.split_once(": ").expect("a place").1.to_owned(), ignored)).collect()
    };
    let found = told(&arms(SPHERE, box_shape), ", self_contact");
    let count = "contacts of links with one another: 1; `links = […]` chooses some links";
    let unread = "pairs of shapes that do not touch: 2, first a shape of `trunk` and a shape of `hand`: spheres touch \
                  spheres and capsules alone";
    assert_eq!(found, [(count.to_owned(), false), (unread.to_owned(), true)]);
    let idle = "shapes that touch nothing: 4; `ground(…)` lets them touch a plane, `self_contact(…)` each other";
    assert!(told(&arms(SPHERE, SPHERE), "").contains(&(idle.to_owned(), false)));
}

#[cfg(feature = "mjcf")]
fn mistakes_of(text: &str, clauses: &str) -> String {
    let file = Scratch::called(text, "xml");
    super::read(&file.of(clauses, "")).err().map(|error| error.to_string()).unwrap_or_default()
}

#[cfg(feature = "mjcf")]
#[test]
fn pairs_of_a_file() {
    let text = |flag: &str| {
        format!(
            "<mujoco><option><flag {flag}/></option><worldbody><body name=\"a\"><joint axis=\"0 1 0\"/>\
             <geom name=\"f\" size=\"1\"/><body name=\"b\"><joint axis=\"1 0 0\"/>\
             <geom name=\"g\" size=\"1\" pos=\"0 0 3\"/></body></body></worldbody>\
             <contact><pair geom1=\"f\" geom2=\"g\" condim=\"1\" gap=\"0.1\"/></contact></mujoco>"
        )
    };
    let told = |clauses: &str| -> Vec<String> {
        let file = Scratch::called(&text(""), "xml");
        let read = super::read(&file.of(clauses, "")).expect("a struct");
        let described = read.item.described.expect("a file").remarks.into_iter();
        described.filter(|remark| remark.ignored).map(|remark| remark.text).collect()
    };
    // A pair touches although one hangs on the other.
    let file = Scratch::called(&text(""), "xml");
    let read = super::read(&file.of(", self_contact", "")).expect("a struct");
    assert_eq!(read.contacts[0].names[0], "f_g");
    assert!(read.contacts[0].friction.is_empty());
    assert!(told(", self_contact").iter().any(|text| text.contains("`gap` of pairs does not act")));
    assert!(told("").iter().any(|text| text.contains("pairs of shapes do not act; `self_contact(…)`")));
    // A pair that is not read does not touch by other rules either; surfaces that move are told of without any contact.
    let rough = text("filterparent=\"disable\"").replace("condim=\"1\"", "friction=\"1 0.5\"");
    let found = mistakes_of(&rough, ", self_contact");
    let why = "no links of the file touch each other here (the pair of `f` of `a` and `g` of `b` does not touch: its \
               friction differs along both tangents, whose directions are MuJoCo's own); those that do";
    assert!(found.contains(why), "{found}");
    let belt = text("").replace("size=\"1\"/>", "size=\"1\" surfacevel=\"0 0 0 1\" adhesion=\"2\"/>");
    let file = Scratch::called(&belt, "xml");
    let remarks = super::read(&file.of("", "")).expect("a struct").item.described.expect("a file").remarks;
    for word in ["surfacevel", "adhesion"] {
        let text = format!("`{word}` of geoms does not act");
        assert!(remarks.iter().any(|remark| remark.ignored && remark.text.contains(&text)), "{word}");
    }
    // Without the filter all parents touch, here by the pair still, and once.
    let file = Scratch::called(&text("filterparent=\"disable\""), "xml");
    let read = super::read(&file.of(", self_contact", "")).expect("a struct");
    assert_eq!(read.contacts.len(), 1);
}

/// Bodies whose joints have places of their own, several joints, or none: the pairs are `d.contact` of MuJoCo 4.0.0
/// after `mj_forward`, where all spheres meet.
#[cfg(feature = "mjcf")]
#[test]
fn joints_with_places_do_not_change_what_hangs_on_what() {
    let sphere = |name: &str| format!("<geom name=\"{name}\" size=\"0.1\"/>");
    let body = |name: &str, joints: &str, inside: &str| {
        format!("<body name=\"body_{name}\">{joints}{}{inside}</body>", sphere(name))
    };
    let pill = body("f", "<joint name=\"jf\" type=\"ball\" pos=\"0 0 0.2\"/>", "");
    let foot = "<joint name=\"je\" axis=\"0 1 0\"/><joint name=\"js\" type=\"slide\" pos=\"0 0 1\"/>";
    let cuff = body("d", "", &body("e", foot, &pill));
    let shin = "<joint name=\"jc\" axis=\"1 0 0\"/><joint name=\"jd\" axis=\"0 1 0\" pos=\"0.1 0 0\"/>";
    let thigh = body("b", "<joint name=\"jb\" axis=\"1 0 0\" pos=\"0 0 0.1\"/>", &body("c", shin, &cuff));
    let arm = body("h", "<joint name=\"jh\" axis=\"1 0 0\" pos=\"0 0.1 0\"/>", "");
    let trunk = body("a", "<joint name=\"ja\" axis=\"0 1 0\" pos=\"0 0 0.1\"/>", &(thigh + &arm));
    let text = format!("<mujoco><worldbody>{}{trunk}</worldbody></mujoco>", sphere("w"));
    let file = Scratch::called(&text, "xml");
    let read = super::read(&file.of(", self_contact(friction = 0)", "")).expect("a struct");
    let found: Vec<String> = read.contacts.iter().map(|clause| clause.names[0].to_string()).collect();
    let expected = "w_a w_b w_c w_d w_e w_f w_h a_c a_d a_e a_f b_e b_f b_h c_f c_h d_f d_h e_h f_h";
    assert_eq!(found.join(" "), expected);
}
