//! Shapes of a file that touch the ground: which ones, by what names, and what is refused and told.

use super::{Scratch, joint, link, mistakes, model, remarks, robot};
use crate::model::{ContactClause, ContactGeometry, Copies, Counterpart};

/// A slider with shapes, and what hangs on it.
fn legs(shapes: &str, rest: &str) -> String {
    let body = link("trunk").replace("</link>", &format!("{shapes}</link>"));
    robot(&(joint("lift", "prismatic", "base", "trunk", "") + &body + rest))
}

fn shape(name: &str, origin: &str, geometry: &str) -> String {
    let name = if name.is_empty() { String::new() } else { format!(" name=\"{name}\"") };
    format!("<collision{name}><origin {origin}/><geometry>{geometry}</geometry></collision>\n")
}

const SPHERE: &str = "<sphere radius=\"0.1\"/>";
const BOX: &str = "<box size=\"0.2 0.4 0.6\"/>";
const ROD: &str = "<cylinder radius=\"0.1\" length=\"0.5\"/>";
const PILL: &str = "<capsule radius=\"0.1\" length=\"0.5\"/>";

fn contacts(text: &str, clauses: &str) -> Vec<ContactClause> {
    model(text, clauses, "").contacts
}

fn names(contacts: &[ContactClause]) -> Vec<String> {
    contacts.iter().flat_map(|clause| &clause.names).map(ToString::to_string).collect()
}

#[test]
fn every_shape_has_contacts_of_its_name() {
    let shapes = [
        shape("", "", SPHERE),
        shape("", "xyz=\"0 0 1\"", SPHERE),
        shape("hull", "", BOX),
        shape("hull", "rpy=\"0.1 0 0\"", BOX),
        shape("rod", "", ROD),
        shape("left pill", "", PILL),
        shape("sin", "", "<box size=\"1 0 0\"/>"),
    ]
    .concat();
    let found = contacts(&legs(&shapes, ""), ", ground");
    let numbered = |name: &str, count: usize| (0..count).map(|k| format!("{name}_{k}")).collect::<Vec<_>>();
    let expected = [
        vec!["trunk".to_owned(), "trunk_2".to_owned()],
        numbered("hull", 8),
        numbered("hull_2", 8),
        numbered("rod", 2),
        numbered("left_pill", 2),
        numbered("sin_contact", 2),
    ];
    assert_eq!(names(&found), expected.concat());
    // Of a box along the axes of its link one clause, of another one for each corner.
    let copies: Vec<usize> = found.iter().map(|clause| clause.names.len()).collect();
    assert_eq!(copies, [&[1, 1, 8][..], &[1; 8], &[2, 2, 2]].concat());
    assert!(found.iter().all(|clause| clause.friction.is_empty() && clause.restitution.is_none()));
}

/// Points are those of the shapes: at the origin of a link that itself, else one with a name.
#[test]
fn points_of_shapes() {
    let shapes = shape("", "", SPHERE) + &shape("toe", "xyz=\"0.5 0 -0.25\" rpy=\"0 1.5707963267948966 0\"", PILL);
    let read = model(&legs(&shapes, ""), ", ground", "");
    let places: Vec<(String, Vec<f64>)> = read
        .points
        .iter()
        .map(|point| (point.name.to_string(), point.at.literal_components().unwrap().to_vec()))
        .collect();
    // The axis of the capsule, turned about the second axis, lies along the first.
    let expected = [("toe_0_point", vec![0.25, 0.0, -0.25]), ("toe_1_point", vec![0.75, 0.0, -0.25])];
    assert_eq!(places, expected.map(|(name, at)| (name.to_owned(), at)));
    let points = model(&legs(&shape("", "", ROD), ""), ", ground(cylinders = 6)", "").points;
    assert_eq!(points.len(), 12);
    let radii = points.iter().map(|point| point.at.literal_components().unwrap());
    assert!(radii.map(|[x, y, z]| (x.hypot(y), z.abs())).all(|(r, z)| (r - 0.1).abs() < 1e-16 && z == 0.25));
}

#[test]
fn what_the_clause_says() {
    let foot = joint("knee", "revolute", "trunk", "foot", "")
        + &link("foot").replace("</link>", &format!("{}</link>", shape("", "", SPHERE)));
    let text = legs(&shape("", "", SPHERE), &foot);
    assert_eq!(names(&contacts(&text, ", ground")), ["trunk", "foot"]);
    let read = model(
        &text,
        ", ground(links = [foot], friction = [mu, 0.5], along = [1, 0, 0], restitution = 0.3, height = h, plane = [0, 1, 1]), \
         ground(friction = mu)",
        "mu: f64, h: f64",
    );
    let found = read.contacts;
    assert_eq!(names(&found), ["foot", "trunk", "foot_2"]);
    assert_eq!(found.iter().map(|clause| clause.friction.len()).collect::<Vec<_>>(), [2, 1, 1]);
    assert!(found[0].restitution.is_some() && found[1].restitution.is_none());
    let planes = found.iter().map(|clause| match &clause.touching {
        ContactGeometry::Point(contact) => match &contact.against {
            Counterpart::Plane { normal, height, along } => [normal, height, along].map(Option::is_some),
            _ => panic!("a plane"),
        },
        _ => panic!("a point"),
    });
    assert_eq!(planes.collect::<Vec<_>>(), [[true; 3], [false; 3], [false; 3]]);
    let rims = contacts(&legs(&shape("", "", ROD), ""), ", ground(cylinders = rims)");
    assert!(matches!(&rims[0].touching, ContactGeometry::Point(contact) if matches!(contact.copies, Copies::Rims(_))));
}

/// Contacts of joints come first, and keep their names.
#[test]
fn a_shape_with_the_name_of_a_joint() {
    let limits = "<dynamics friction=\"2\"/><limit lower=\"-1\" upper=\"1\"/>";
    let shapes = shape("lift", "", SPHERE) + &shape("lift_to", "", SPHERE);
    let body = link("trunk").replace("</link>", &format!("{shapes}</link>"));
    let text = robot(&(joint("lift", "prismatic", "base", "trunk", limits) + &body));
    let found = contacts(&text, ", limits = range, joint_friction = dry, ground");
    assert_eq!(names(&found), ["lift_from", "lift_to", "lift", "lift_2", "lift_to_2"]);
    assert_eq!(found[1].friction.first().and_then(|bound| bound.literal()), Some(2.0));
    assert!(matches!(found[1].touching, ContactGeometry::Slip { named: true, .. }));
}

#[test]
fn mistakes_stand_at_their_words() {
    let mesh = shape("", "", "<mesh filename=\"a.stl\"/>");
    let foot = joint("weld", "fixed", "trunk", "foot", "") + "<link name=\"foot\"/>\n";
    let text = legs(&shape("", "", SPHERE), &foot);
    let only = "a link that moves needs a sphere, box, capsule, cylinder or ellipsoid, or write `contact(…)` of your own \
                points";
    let why = "the collision of `trunk` does not touch: it is a mesh";
    assert_eq!(
        mistakes(&legs(&mesh, ""), ", ground(friction = 0.5)", ""),
        [format!("nothing of the file touches this ground ({why}); {only}")]
    );
    assert_eq!(mistakes(&legs("", ""), ", ground", ""), [format!("nothing of the file touches this ground; {only}")]);
    let cases = [
        ("ground(links = [trnk])", "`ground` is touched by `trnk`, which is no link; did you mean `trunk`?"),
        ("ground(links = [trunk, trunk])", "`trunk` is named twice; remove one of the two"),
        ("ground(links = [trunk, base])", "the link `base` does not move; remove it"),
        (
            "ground(links = [trunk, foot])",
            "the link `foot` has no shape that touches; remove it, or write `contact(…)` of a point of it",
        ),
        (
            "ground(links = trunk)",
            "`links` is names of links of the file in brackets; write `links = [left_foot, right_foot]`",
        ),
        ("ground = 0.5", "`ground` takes brackets, not `=`; write `ground(friction = mu)`, or `ground` alone"),
        (
            "ground(cylinders = 2)",
            "`cylinders` is `rims`, or how many points stand for each rim, 3 to 64; write `cylinders = 8`",
        ),
        ("ground(fiction = 0.5)", "unknown argument of `ground`: `fiction`; did you mean `friction`?"),
        ("ground(friction = 0.5, friction = 0.2)", "`friction` is given twice; keep one of the two"),
    ];
    for (clause, expected) in cases {
        assert_eq!(mistakes(&text, &format!(", {clause}"), "")[0], expected, "{clause}");
    }
    assert_eq!(
        mistakes(&text, ", ground, contact(trunk, point = trunk.position)", ""),
        ["two contacts are called `trunk`; rename one of the two"]
    );
}

/// Shapes that do not touch are warned of, and those that touch are told.
#[test]
fn what_is_told() {
    let mesh = shape("", "", "<mesh filename=\"a.stl\"/>");
    let text = legs(&(shape("", "", SPHERE) + &mesh), "");
    let told = |text: &str, ignored: bool| (text.to_owned(), ignored);
    let meshes = "5:1: the collision of `trunk` does not touch: it is a mesh";
    let quiet = "5:38: not read, as it has no part in the motion, how many times: filename (1)";
    let count = "4:92: contacts with the ground: 1; `links = […]` chooses those of some links";
    assert_eq!(remarks(&text, ", ground"), [told(count, false), told(meshes, true), told(quiet, false)]);
    assert_eq!(
        remarks(&text, ", ground, ignore(collision)"),
        [told(count, false), told(meshes, false), told(quiet, false)]
    );
    let nothing =
        "4:92: shapes that touch nothing: 2; `ground(…)` lets them touch a plane, `self_contact(…)` each other";
    assert!(remarks(&text, "").contains(&told(nothing, false)));
}

/// On a column that turns about its own axis a ball stays where it is, and so does the end of a rod that its joint goes
/// through; the other end swings. What the file does not place keeps all.
#[test]
fn what_stays_clear_of_the_ground() {
    let column = |at: &str| link("column").replace("</link>", &format!("{}</link>", shape("ball", at, SPHERE)));
    let arm = link("arm").replace("</link>", &format!("{}</link>", shape("rod", "xyz=\"0 0 -0.25\"", PILL)));
    let hinge = "<joint name=\"swing\" type=\"revolute\"><parent link=\"column\"/><child link=\"arm\"/>\
                 <origin xyz=\"0 0 1\"/><axis xyz=\"1 0 0\"/></joint>";
    let text = |at: &str| robot(&(joint("turn", "revolute", "base", "column", "") + &column(at) + hinge + &arm));
    let high = text("xyz=\"0.3 0 1\"");
    assert_eq!(names(&contacts(&high, ", ground")), ["rod"]);
    assert_eq!(names(&contacts(&high, ", ground(plane = [0, 0, 2], height = 0.5)")), ["rod"]);
    let remark =
        "shapes of which points stay clear of the ground, whatever moves, and make no contacts: 2, first of `column`";
    assert!(remarks(&high, ", ground").iter().any(|(text, ignored)| text.contains(remark) && !ignored));
    // What is left has a gap that speeds change.
    let file = Scratch::new(&high);
    let input: syn::DeriveInput = syn::parse_str(&file.of(", ground", "")).expect("a struct");
    assert!(crate::expand(&input).is_ok());
    // It touches, or a field says where the plane is, or what holds the column moves.
    let all = ["ball", "rod_0", "rod_1"];
    assert_eq!(names(&contacts(&text("xyz=\"0.3 0 0.05\""), ", ground")), ["ball", "rod"]);
    assert_eq!(names(&model(&high, ", ground(height = h)", "h: f64").contacts), all);
    assert_eq!(names(&contacts(&high, ", ground, base = floating")), all);
    // Before a wall the ball comes and goes.
    assert_eq!(names(&contacts(&high, ", ground(plane = [0, 1, 0], height = -3)")), ["ball", "rod"]);
    let nothing = mistakes(&high, ", ground(links = [column])", "").remove(0);
    assert!(
        nothing.contains("nothing of the file touches this ground (shapes of which points stay clear"),
        "{nothing}"
    );
}

/// A cylinder that never leans has no lowest point of its rims.
#[test]
fn a_cylinder_that_stands_has_points_alone() {
    let file = Scratch::new(&legs(&shape("", "", ROD), ""));
    let of = |clause: &str| crate::Derivation::new(&syn::parse_str(&file.of(clause, "")).expect("a struct"));
    assert!(of(", ground(friction = 0.5, cylinders = 6)").is_ok());
    let why = of(", ground").err().map(|error| error.to_string());
    let flat = "`trunk_0` always lies flat, where no point of its rim is the lowest; write points of the rim, or \
                `cylinders = 8` in the `ground(…)` of a robot's file";
    assert_eq!(why.as_deref(), Some(flat));
    // Turned to lie it has one.
    let lying = Scratch::new(&legs(&shape("", "rpy=\"1 0 0\"", ROD), ""));
    assert!(crate::Derivation::new(&syn::parse_str(&lying.of(", ground", "")).expect("a struct")).is_ok());
}

#[cfg(feature = "mjcf")]
mod mjcf {
    use super::names;
    use crate::model::tests::robots::{Scratch, read};
    use crate::model::{ContactGeometry, Counterpart, Model};

    /// A world with a body that falls.
    fn file(world: &str, body: &str, rest: &str) -> Scratch {
        let text = format!(
            "<mujoco>\n<worldbody>{world}\n<body name=\"leg\"><freejoint/><inertial pos=\"0 0 0\" mass=\"1\" \
             diaginertia=\"1 1 1\"/>\n{body}\n</body></worldbody>{rest}</mujoco>"
        );
        Scratch::called(&text, "xml")
    }

    fn model(world: &str, body: &str, rest: &str, clause: &str) -> Model {
        let file = file(world, body, rest);
        read(&file.of(&format!(", {clause}"), "")).unwrap_or_else(|error| panic!("{world} {body}: {error}"))
    }

    fn touching(world: &str, body: &str, rest: &str, clause: &str) -> Vec<(String, Option<f64>)> {
        let contacts = model(world, body, rest, clause).contacts;
        let friction = contacts.iter().map(|clause| clause.friction.first().and_then(|mu| mu.literal()));
        names(&contacts).into_iter().zip(friction).collect()
    }

    const FLOOR: &str = "<geom type=\"plane\" name=\"floor\" size=\"1 1 1\" friction=\"0.7\"/>";

    /// Without a plane in the file the ground says nothing of its own.
    #[test]
    fn surfaces_of_both() {
        let foot = |more: &str| format!("<geom name=\"foot\" size=\"0.1\" friction=\"0.4\" {more}/>");
        let of =
            |world: &str, more: &str, clause: &str| touching(world, &foot(more), "", clause).pop().map(|(_, mu)| mu);
        assert_eq!(of("", "", "ground"), Some(Some(0.4)));
        assert_eq!(of("", "condim=\"1\"", "ground"), Some(None));
        assert_eq!(of("", "condim=\"1\"", "ground(friction = 0.2)"), Some(Some(0.2)));
        assert_eq!(of(FLOOR, "", "ground"), Some(Some(0.7)));
        assert_eq!(of(FLOOR, "condim=\"1\"", "ground"), Some(Some(0.7)));
        assert_eq!(of(FLOOR, "priority=\"1\"", "ground"), Some(Some(0.4)));
        assert_eq!(of(FLOOR, "condim=\"1\" priority=\"1\"", "ground"), Some(None));
        // A plane of the struct stands for those of the file.
        assert_eq!(of(FLOOR, "", "ground(height = 0)"), Some(Some(0.4)));
    }

    /// Along the axes of the link with its point, turned with a frame of the name of the contact.
    #[test]
    fn ellipsoids() {
        let egg = "<geom name=\"egg\" type=\"ellipsoid\" size=\"1 2 3\" pos=\"0 0 4\"/>";
        let bean = "<geom name=\"bean\" type=\"ellipsoid\" size=\"1 2 3\" euler=\"0 0 30\"/>";
        let pea = "<geom name=\"pea\" type=\"ellipsoid\" size=\"1 1 1\"/>";
        let read = model("", &[egg, bean, pea].concat(), "", "ground");
        assert_eq!(names(&read.contacts), ["egg", "bean", "pea"]);
        let semi_axes = |n: usize| {
            let ContactGeometry::Point(contact) = &read.contacts[n].touching else { panic!("a point") };
            contact.semi_axes.as_ref().map(|axes| axes.each_ref().map(|length| length.literal().unwrap()))
        };
        assert_eq!([0, 1, 2].map(semi_axes), [Some([1.0, 2.0, 3.0]), Some([1.0, 2.0, 3.0]), None]);
        assert_eq!(read.points.iter().map(|point| point.name.to_string()).collect::<Vec<_>>(), ["egg_point"]);
        let own = |body: &crate::model::BodyClause| body.name.as_ref().map(ToString::to_string);
        let frame = read.bodies.iter().find(|body| own(body).as_deref() == Some("bean_frame")).expect("a frame");
        assert!(frame.massless && frame.position.is_none() && frame.rotation.is_some());
        assert_eq!(frame.parent.as_ref().map(ToString::to_string).as_deref(), Some("leg"));
    }

    #[test]
    fn planes_bits_and_exclusions() {
        let ramp = "<frame pos=\"0 0 1\"><geom type=\"plane\" name=\"ramp\" size=\"1 1 1\" zaxis=\"3 0 4\"/></frame>";
        let foot = "<geom name=\"foot\" size=\"0.1\"/>";
        let worlds = format!("{FLOOR}{ramp}");
        let both = model(&worlds, foot, "", "ground").contacts;
        assert_eq!(names(&both), ["foot", "foot_2"]);
        let ContactGeometry::Point(contact) = &both[1].touching else { panic!("a point") };
        let Counterpart::Plane { normal: Some(normal), height: Some(height), .. } = &contact.against else {
            panic!("a plane")
        };
        let [x, y, z] = normal.literal_components().unwrap();
        assert!((x - 0.6).abs() < 1e-15 && y == 0.0 && (z - 0.8).abs() < 1e-15);
        assert!((height.literal().unwrap() - 0.8).abs() < 1e-15);
        let count = |body: &str, rest: &str| {
            let file = file(&worlds, body, rest);
            read(&file.of(", ground", "")).map_or(0, |model| model.contacts.len())
        };
        assert_eq!(count("<geom size=\"0.1\" contype=\"2\" conaffinity=\"2\"/>", ""), 0);
        assert_eq!(count("<geom size=\"0.1\" contype=\"2\" conaffinity=\"3\"/>", ""), 2);
        assert_eq!(count(foot, "<contact><exclude body1=\"world\" body2=\"leg\"/></contact>"), 0);
        assert_eq!(count(foot, "<option><flag contact=\"disable\"/></option>"), 0);
        // A law that is not read says so.
        let rough = "<contact><pair geom1=\"foot\" geom2=\"floor\" friction=\"1 0.5\"/></contact>";
        let found = read(&file(FLOOR, foot, rough).of(", ground", "")).err().map(|error| error.to_string());
        let why = "nothing of the file touches this ground (the pair of `foot` of `leg` and `floor` of `world` does not \
                   touch: its friction differs along both tangents, whose directions are MuJoCo's own); a link";
        assert!(found.as_ref().is_some_and(|found| found.starts_with(why)), "{found:?}");
    }

    /// Parts of contacts in a file that are not modelled are warned of where they would act.
    #[test]
    fn what_does_not_act() {
        let warned = |world: &str, body: &str, clause: &str| -> Vec<String> {
            let described = model(world, body, "", clause).item.described.expect("a file");
            let ignored = described.remarks.into_iter().filter(|remark| remark.ignored);
            ignored.map(|remark| remark.text.split_once("xml:").expect("a place").1.to_owned()).collect()
        };
        let foot = "<geom name=\"foot\" size=\"0.1\"/>";
        assert!(warned("", foot, "ground").is_empty());
        let rolling = "<geom name=\"foot\" size=\"0.1\" condim=\"6\" margin=\"0.01\"/>";
        assert_eq!(
            warned("", rolling, "ground"),
            [
                "4:1: there is no friction of turning and rolling (`condim` 4 and 6)",
                "4:1: `margin` of geoms does not act: they touch where they meet",
            ]
        );
        assert!(warned("", rolling, "ignore(nothing)").is_empty());
        let step = "<geom name=\"step\" type=\"box\" size=\"1 1 1\"/>";
        let text = "2:12: the geom `step` of `world` does not touch: it is a shape of the world that is no plane";
        assert_eq!(warned(step, foot, "ground"), [text]);
        let mesh = format!("{foot}<geom type=\"mesh\" mesh=\"m\" mass=\"0\"/>");
        assert_eq!(
            warned("", &mesh, "ground"),
            ["4:31: the geom of `leg` does not touch: it is a geom of type `mesh`"]
        );
    }

    /// Links that only rise have nothing to rub; that is no mistake of the struct.
    #[test]
    fn friction_that_does_nothing_is_no_mistake() {
        let text = "<mujoco><worldbody><body name=\"leg\"><joint type=\"slide\"/><geom size=\"0.1\"/></body></worldbody></mujoco>";
        let file = Scratch::called(text, "xml");
        let derived = crate::Derivation::new(&syn::parse_str(&file.of(", ground", "")).expect("a struct"));
        assert!(derived.is_ok());
    }
}
