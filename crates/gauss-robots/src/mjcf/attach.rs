//! `<attach model="…" body="…" prefix="…"/>`: a body of another model, or its world, hangs here.
//!
//! Without `model` the body is one of the same model that stands before: another like it hangs here.
//!
//! The other model is read by its own settings and classes; what comes of it has the prefix before its names
//! (<https://mujoco.readthedocs.io/en/stable/XMLreference.html#body-attach>). Of its tendons, equalities and actuators
//! those come along that refer to nothing but what does; its gravity and its keyframes do not.

use std::collections::BTreeSet;
use std::ops::Range;

use roxmltree::Node;

use super::labels::{Affix, NamedElement, SECTIONS, name_of, references};
use super::{File, Model, Place, WORLD, model};
use crate::collision::{Collision, Pair};
use crate::description::{Fault, Joint, JointKind};
use crate::names::unknown;
use crate::rotation::{Rotation, Triple, multiply, turned};
use crate::text::Text;
use crate::xml::{own_descendants, own_elements, parse};

impl<'a> File<'a> {
    /// Hangs a part of another model on a body of this one, at a place in it.
    pub fn attach(&mut self, node: Node<'a, 'a>, parent: &str, place: &Place) {
        self.reading.see(node);
        if let Err(message) = self.attached(node, parent, place) {
            self.reading.fault(node, message);
        }
    }

    fn attached(&mut self, node: Node<'a, 'a>, parent: &str, place: &Place) -> Result<(), String> {
        let [name, body, prefix] = ["model", "body", "prefix"].map(|word| self.reading.text(node, word));
        if self.reading.text(node, "frame").is_some() {
            return Err("frames are not attached; make a <body> of it".to_owned());
        }
        let prefix = prefix.ok_or("the attribute `prefix` is missing")?;
        let (text, before) = match (name, body) {
            (Some(name), _) => (self.reading.model(name).map_err(|which| format!("it attaches {which}"))?, usize::MAX),
            (None, Some(_)) => (self.reading.whole(), node.range().start),
            (None, None) => return Err("without a `model` it is to name a `body` of its own".to_owned()),
        };
        let read = part(text, (body, before), prefix)?;
        let read = read.and_then(|(part, keys)| Ok((model(&part, Some((prefix, &*self)))?, keys)));
        let (other, has_keys) = match read {
            Ok(read) => read,
            Err(faults) => {
                // Those of a model that is attached twice, once.
                let new: Vec<Fault> = faults.into_iter().filter(|fault| !self.reading.faults.contains(fault)).collect();
                self.reading.faults.extend(new);
                return Ok(());
            }
        };
        if has_keys {
            let whose = name.map_or_else(|| "the model itself".to_owned(), |name| format!("the model `{name}`"));
            self.reading.note(node, format!("keyframes of {whose} are not attached"));
        }
        self.hung(other, parent, place)
    }

    /// The contents of another model, put at a place in a body of this one.
    fn hung(&mut self, other: Model, parent: &str, place: &Place) -> Result<(), String> {
        let is_free = |joint: &Joint| joint.kind == JointKind::Floating;
        if parent != WORLD && other.description.joints.iter().any(is_free) {
            return Err("a body that moves freely hangs in the world, not on another body".to_owned());
        }
        let own = &mut self.description;
        own.links.extend(other.description.links.into_iter().filter(|link| link.name != WORLD));
        own.joints.extend(other.description.joints.into_iter().map(|mut joint| {
            if is_free(&joint) {
                // Its pose is that in the world.
                joint.start = put(place, joint.start);
            } else if joint.parent == WORLD {
                joint.parent = parent.to_owned();
                (joint.position, joint.rotation) = put(place, (joint.position, joint.rotation));
            }
            joint
        }));
        let placed = |mut collision: Collision| {
            if collision.link == WORLD {
                collision.link = parent.to_owned();
                let own = put(place, (collision.position, Rotation::from_matrix(&collision.rotation)));
                (collision.position, collision.rotation) = (own.0, own.1.matrix);
            }
            collision
        };
        own.collisions.extend(other.description.collisions.into_iter().map(placed));
        own.hidden.extend(other.description.hidden.into_iter().map(placed));
        let pairs = other.description.pairs.into_iter();
        own.pairs.extend(pairs.map(|pair| Pair { shapes: pair.shapes.map(placed), ..pair }));
        let hung = |name: String| if name == WORLD { parent.to_owned() } else { name };
        own.excluded.extend(other.description.excluded.into_iter().map(|pair| pair.map(hung)));
        own.closures.extend(other.description.closures);
        own.polynomials.extend(other.description.polynomials);
        own.tendons.extend(other.description.tendons);
        own.cables.extend(other.description.cables);
        own.files.extend(other.description.files);
        self.attached.push((other.description.drives, other.controls));
        self.sites.extend(other.sites);
        self.reading.notes.extend(other.description.notes);
        Ok(())
    }

    /// After the drives of the file, as MuJoCo orders them.
    pub fn add_drives_of_attached(&mut self) {
        for (drives, controls) in std::mem::take(&mut self.attached) {
            let before = self.description.drives.len();
            self.controls.extend(controls.into_iter().map(|drive| drive.map(|index| before + index)));
            self.description.drives.extend(drives);
        }
    }
}

/// A pose that is given relative to another one, composed with that.
fn put((at, matrix): &Place, (position, rotation): (Triple, Rotation)) -> (Triple, Rotation) {
    let moved = turned(matrix, &position);
    let turn = Rotation::from_matrix(&multiply(matrix, &rotation.matrix));
    (std::array::from_fn(|i| at[i] + moved[i]), turn)
}

/// Replacement of a range of the text.
enum Becomes<'a> {
    Nothing,
    Renamed(Node<'a, 'a>),
    /// The only one in the world; with the class around it.
    World(Node<'a, 'a>, Option<&'a str>),
}

/// The text with the body alone, which ends before a place in it, or all of its world, and what refers to nothing else,
/// with a prefix before names, and whether keyframes were taken out of it; the faults of what is no XML.
///
/// # Errors
/// Why there is no such body.
fn part(
    text: &Text,
    (body, before): (Option<&str>, usize),
    prefix: &str,
) -> Result<Result<(Text, bool), Vec<Fault>>, String> {
    let document = match parse(&text.whole) {
        Ok(document) => document,
        Err(fault) => return Ok(Err(vec![fault])),
    };
    let root = document.root_element();
    let sections = |name: &'static str| own_elements(root).filter(move |section| section.has_tag_name(name));
    let worlds: Vec<Node<'_, '_>> = sections("worldbody").collect();
    let mut edits: Vec<(Range<usize>, Becomes<'_>)> = Vec::new();
    let tops = match body {
        None => {
            edits.extend(worlds.iter().map(|world| (world.range(), Becomes::Renamed(*world))));
            worlds
        }
        Some(body) => {
            let node = found(&worlds, body)?;
            if node.range().end > before {
                return Err(format!("`{body}` does not end before it; what is attached stands before"));
            }
            if before < usize::MAX && own_descendants(node).any(|inner| inner.has_tag_name("attach")) {
                return Err(format!("`{body}` attaches others itself; name another `model`"));
            }
            let class = node.ancestors().skip(1).find_map(|around| around.attribute("childclass"));
            for (index, world) in worlds.iter().enumerate() {
                edits.push((world.range(), if index == 0 { Becomes::World(node, class) } else { Becomes::Nothing }));
            }
            vec![node]
        }
    };
    let inside = || tops.iter().flat_map(|top| own_descendants(*top));
    let mut named: BTreeSet<NamedElement<'_>> = inside().filter_map(name_of).collect();
    let own_prefixes: Vec<&str> =
        inside().filter(|node| node.has_tag_name("attach")).filter_map(|node| node.attribute("prefix")).collect();
    for section in SECTIONS {
        for element in sections(section).flat_map(own_elements) {
            let refers: Vec<NamedElement<'_>> =
                own_descendants(element).flat_map(references).map(|(_, own)| own).collect();
            // Of models that this one attaches.
            let nested = |own: &NamedElement<'_>| own_prefixes.iter().any(|prefix| own.1.starts_with(prefix));
            if refers.iter().all(|own| named.contains(own) || *own == ("body", WORLD) || nested(own)) {
                named.extend(refers.into_iter().filter(nested).chain(name_of(element)));
                edits.push((element.range(), Becomes::Renamed(element)));
            } else {
                edits.push((element.range(), Becomes::Nothing));
            }
        }
    }
    edits.extend(sections("keyframe").map(|keys| (keys.range(), Becomes::Nothing)));
    let has_keys = sections("keyframe").flat_map(own_elements).next().is_some();
    edits.sort_by_key(|(range, _)| range.start);
    let affix = Affix { named: &named, before: prefix.to_owned(), after: String::new() };
    Ok(Ok((edited(text, edits, &affix).of_files(text.clone()), has_keys)))
}

/// The body of that name.
fn found<'a>(worlds: &[Node<'a, 'a>], body: &str) -> Result<Node<'a, 'a>, String> {
    let bodies = || worlds.iter().flat_map(|world| own_descendants(*world)).filter(|node| node.has_tag_name("body"));
    let is_it = |node: &Node<'_, '_>| node.attribute("name").map(str::trim) == Some(body);
    let node = bodies().find(is_it);
    let node = node.ok_or_else(|| {
        let which = unknown("body", body, bodies().filter_map(|node| node.attribute("name")));
        format!("it attaches {which}")
    })?;
    match node.ancestors().any(|around| around.has_tag_name("frame")) {
        true => Err(format!("`{body}` stands in a <frame> of its model, and is not attached without it")),
        false => Ok(node),
    }
}

fn edited(text: &Text, edits: Vec<(Range<usize>, Becomes<'_>)>, affix: &Affix<'_>) -> Text {
    let mut out = Text::default();
    let mut start = 0;
    for (range, becomes) in edits {
        out.copy(text, start..range.start);
        match becomes {
            Becomes::Nothing => {}
            Becomes::Renamed(node) => affix.renamed(text, node, node.range(), &mut out),
            Becomes::World(node, class) => {
                let place = node.range().start;
                let class = class.map(|class| format!(" childclass=\"{class}\"")).unwrap_or_default();
                out.add(&format!("<worldbody><frame{class}>"), text, place);
                affix.renamed(text, node, node.range(), &mut out);
                out.add("</frame></worldbody>", text, place);
            }
        }
        start = range.end;
    }
    out.copy(text, start..text.whole.len());
    out
}

#[cfg(test)]
mod tests {
    use std::path::PathBuf;

    use crate::description::{Description, Fault};
    use crate::mjcf::{included, read};
    use crate::rotation::{Rotation, of_quaternion};
    use crate::text::{Text, Written};

    /// In radians, with classes, and relations of which some are of another body.
    const LEG: &str = "<mujoco model=\"leg\"><compiler angle=\"radian\" autolimits=\"true\"/><option gravity=\"0 0 -1\"/>\n\
        <default><joint damping=\"3\"/><default class=\"k\"><joint damping=\"5\" range=\"-1 1\"/></default></default>\n\
        <worldbody><body name=\"hip\" pos=\"0 0 1\" euler=\"0 0 1.5707963267948966\"><joint name=\"h\" axis=\"0 1 0\"/>\n\
        <geom size=\"0.1\"/><site name=\"s\" pos=\"1 0 0\"/><body name=\"shin\" pos=\"0 0 -1\"><joint name=\"k\" class=\"k\"/>\n\
        <geom size=\"0.1\"/></body></body><body name=\"other\"><joint name=\"o\"/><geom size=\"0.3\"/></body></worldbody>\n\
        <tendon><fixed name=\"t\"><joint joint=\"h\" coef=\"1\"/><joint joint=\"o\" coef=\"2\"/></fixed>\n\
        <fixed name=\"u\"><joint joint=\"h\" coef=\"1\"/><joint joint=\"k\" coef=\"2\"/></fixed></tendon>\n\
        <equality><joint name=\"e\" joint1=\"h\" joint2=\"k\" polycoef=\"0 1 2 0 0\"/>\n\
        <connect name=\"c\" body1=\"shin\" body2=\"world\" anchor=\"0 0 0\"/></equality>\n\
        <actuator><motor name=\"mh\" joint=\"h\"/><motor name=\"mo\" joint=\"o\"/>\n\
        <position name=\"pu\" tendon=\"u\" kp=\"3\"/></actuator></mujoco>";

    const ASSET: &str = "<asset><model name=\"leg\" file=\"leg.xml\"/></asset>";

    struct Folder(PathBuf);

    impl Folder {
        fn new(name: &str, leg: &str) -> Self {
            let folder = std::env::temp_dir().join(format!("gauss-attach-{name}-{}", std::process::id()));
            std::fs::create_dir_all(&folder).expect("a folder for files that do not stay");
            std::fs::write(folder.join("leg.xml"), leg).expect("a folder that can be written");
            Self(folder)
        }

        fn text(&self, inside: &str) -> Result<Text, Vec<Fault>> {
            let text = format!("<mujoco>{inside}</mujoco>");
            let (text, faults) = included(Written::new("main.xml".to_owned(), self.0.join("main.xml"), text));
            if faults.is_empty() { Ok(text) } else { Err(faults) }
        }

        fn read(&self, inside: &str) -> Result<Description, Vec<Fault>> {
            self.text(inside).and_then(|text| read(&text))
        }
    }

    impl Drop for Folder {
        fn drop(&mut self) {
            // What is left behind harms nobody.
            let _ = std::fs::remove_dir_all(&self.0);
        }
    }

    fn names<'a>(all: impl Iterator<Item = &'a String>) -> String {
        all.cloned().collect::<Vec<_>>().join(" ")
    }

    /// Bodies, joints, dampers, relations and controls, in the order of MuJoCo 4.0.0 for the same two files.
    #[test]
    fn a_body_of_another_model() {
        let folder = Folder::new("body", LEG);
        let main = "<default><joint damping=\"7\"/></default><worldbody><body name=\"p\" pos=\"1 0 0\"><joint name=\"q\"/>\
                    <geom size=\"0.1\"/><attach model=\"leg\" body=\"hip\" prefix=\"a-\"/></body></worldbody><actuator>\
                    <motor name=\"m\" joint=\"q\"/><motor name=\"m2\" joint=\"a-h\"/><motor name=\"m3\" site=\"a-s\"/></actuator>\
                    <keyframe><key name=\"x\" qpos=\"1 2 3\" ctrl=\"4 5 6 7 8\"/></keyframe>";
        let found = folder.read(&format!("{ASSET}{main}")).expect("both");
        assert_eq!(names(found.links.iter().map(|link| &link.name)), "world p a-hip a-s a-shin");
        assert_eq!(names(found.joints.iter().map(|joint| &joint.parent)), "world p a-hip a-hip");
        let damping: Vec<f64> = found.joints.iter().map(|joint| joint.damping).collect();
        assert_eq!(damping, [7.0, 3.0, 0.0, 5.0]);
        assert_eq!((found.joints[1].position, found.joints[3].limits), ([0.0, 0.0, 1.0], [Some(-1.0), Some(1.0)]));
        assert_eq!(names(found.drives.iter().map(|drive| &drive.name)), "m m2 m3 a-mh a-pu");
        assert_eq!(found.postures[0].controls, [(0, 4.0), (1, 5.0), (2, 6.0), (3, 7.0), (4, 8.0)]);
        assert_eq!((found.tendons.len(), found.polynomials.len(), found.gravity), (1, 1, Some([0.0, 0.0, -9.81])));
        assert_eq!(found.closures[0].links, ["a-shin", "world"]);
        assert_eq!(found.joints[1].at.file, 1);
    }

    /// `opt.gravity` and `opt.disableflags` of MuJoCo 3.3 and 4.0 are those of the first file.
    #[test]
    fn options_are_those_of_the_first_file() {
        let told = |own: &str, other: &str| {
            let folder = Folder::new("options", &LEG.replace("<option gravity=\"0 0 -1\"/>", other));
            let world = "<worldbody><attach model=\"leg\" prefix=\"a\"/></worldbody>";
            let found = folder.read(&format!("{own}{ASSET}{world}")).expect("both");
            let told: Vec<String> =
                found.notes.into_iter().filter(|note| note.ignored.is_some()).map(|note| note.text).collect();
            let limits = found.joints.iter().any(|joint| joint.limits != [None; 2]);
            (told.join("; "), found.gravity, limits, found.drives.len())
        };
        let earth = Some([0.0, 0.0, -9.81]);
        let text = "<option> does not act: those of the file that attaches this one act: gravity and what is switched off \
                    are others here";
        assert_eq!(told("", "<option timestep=\"0.01\"/>"), (String::new(), earth, true, 3));
        assert_eq!(told("", "<option gravity=\"0 0 -1\"/>"), (text.to_owned(), earth, true, 3));
        let off = "<option><flag limit=\"disable\" actuation=\"disable\"/></option>";
        assert_eq!(told("", off), (text.to_owned(), earth, true, 3));
        let moon = "<option gravity=\"0 0 -1.6\"/>";
        assert_eq!(told(moon, "<option timestep=\"0.01\"/>"), (String::new(), Some([0.0, 0.0, -1.6]), true, 3));
        assert_eq!(told(off, ""), (String::new(), earth, false, 0));
        assert_eq!(told(off, off), (String::new(), earth, false, 0));
    }

    /// `body_pos` and `body_quat` of MuJoCo 4.0.0.
    #[test]
    fn places() {
        let folder = Folder::new("places", LEG);
        let world = "<worldbody><frame pos=\"0 1 0\" euler=\"0 90 0\"><attach model=\"leg\" body=\"hip\" prefix=\"a\"/></frame>\
                     <attach model=\"leg\" body=\"shin\" prefix=\"b\"/><attach model=\"leg\" prefix=\"c\"/></worldbody>";
        let found = folder.read(&format!("{ASSET}{world}")).expect("both");
        assert_eq!(names(found.links.iter().map(|link| &link.name)), "world ahip as ashin bshin chip cs cshin cother");
        assert_eq!(names(found.drives.iter().map(|drive| &drive.name)), "amh apu cmh cmo cpu");
        let expected = of_quaternion([0.5; 4]).expect("a rotation");
        let hip = &found.joints[0];
        for i in 0..3 {
            // A few products of numbers of size one.
            assert!((hip.position[i] - [1.0, 1.0, 0.0][i]).abs() < 8.0 * f64::EPSILON, "{hip:?}");
            assert!((0..3).all(|j| (hip.rotation.matrix[i][j] - expected[i][j]).abs() < 8.0 * f64::EPSILON), "{hip:?}");
        }
    }

    /// Elements of other languages have no names of this one, and what a comment holds is not there.
    #[test]
    fn prefixed_elements_and_comments() {
        let other = "<x:site name=\"h\"/><x:attach prefix=\"n\"/><site name=\"s\"";
        let leg =
            LEG.replace("<site name=\"s\"", other).replace("</mujoco>", "<x:keyframe/><!-- <keyframe> --></mujoco>");
        let told = |leg: &str| {
            let world = "<worldbody><attach model=\"leg\" body=\"hip\" prefix=\"a-\"/></worldbody>";
            let found = Folder::new("prefixed", leg).read(&format!("{ASSET}{world}")).expect("both");
            assert_eq!(names(found.links.iter().map(|link| &link.name)), "world a-hip a-s a-shin");
            assert_eq!(names(found.drives.iter().map(|drive| &drive.name)), "a-mh a-pu");
            found.notes.iter().filter(|note| note.text.starts_with("keyframes")).count()
        };
        assert_eq!(told(&leg), 0);
        assert_eq!(told(&leg.replace("<!--", "<keyframe><key/></keyframe><!--")), 1);
    }

    /// `qpos0` of MuJoCo 4.0.0: the pose of a free body is that in the world.
    #[test]
    fn what_moves_freely() {
        let leg = "<mujoco model=\"leg\"><worldbody><body name=\"hip\" pos=\"0 0 1\"><freejoint/><geom size=\"1\"/></body>\
                   <body name=\"toe\"><joint/><geom size=\"1\"/></body></worldbody></mujoco>";
        let folder = Folder::new("free", leg);
        let attach = "<attach model=\"leg\" prefix=\"a\"/>";
        let found = folder
            .read(&format!("{ASSET}<worldbody><frame pos=\"1 0 0\" euler=\"0 0 90\">{attach}</frame></worldbody>"))
            .expect("both");
        let [hip, toe] = found.joints.as_slice() else { panic!("{:?}", found.joints) };
        assert_eq!((hip.position, hip.start.0, toe.position), ([0.0; 3], [1.0, 0.0, 1.0], [1.0, 0.0, 0.0]));
        assert_eq!((hip.rotation, hip.start.1.angles[2]), (Rotation::none(), std::f64::consts::FRAC_PI_2));
        assert_eq!(toe.start, ([0.0; 3], Rotation::none()));
        let on_body = format!("{ASSET}<worldbody><body><joint/><geom size=\"1\"/>{attach}</body></worldbody>");
        let faults = folder.read(&on_body).map(|_| ()).expect_err("a body that moves");
        assert_eq!(faults[0].message, "<attach>: a body that moves freely hangs in the world, not on another body");
    }

    /// A model that attaches one itself: both prefixes, the outer one first.
    #[test]
    fn models_of_models() {
        let folder = Folder::new("nested", LEG);
        let half = "<mujoco model=\"half\"><asset><model name=\"leg\" file=\"leg.xml\"/></asset><worldbody><body name=\"hull\">\
                    <joint name=\"j\"/><geom size=\"1\"/><attach model=\"leg\" body=\"shin\" prefix=\"l-\"/></body></worldbody>\
                    <actuator><motor name=\"n\" joint=\"l-k\"/></actuator></mujoco>";
        std::fs::write(folder.0.join("half.xml"), half).expect("a folder that can be written");
        let main =
            "<asset><model file=\"half.xml\"/></asset><worldbody><attach model=\"half\" prefix=\"x/\"/></worldbody>";
        let found = folder.read(main).expect("all three");
        assert_eq!(names(found.joints.iter().map(|joint| &joint.name)), "x/j x/l-k");
        assert_eq!(found.drives[0].along, [("x/l-k".to_owned(), 1.0)]);
        let text = folder.text(main).expect("all three");
        assert_eq!(names(text.names().iter()), "main.xml half.xml leg.xml");
        assert_eq!(found.joints[1].at.file, 2);
    }

    /// Bodies, joints, places, actuators of MuJoCo 4.0.0, and what it refuses.
    #[test]
    fn a_body_of_the_model_itself() {
        let arm = "<frame childclass=\"c\"><body name=\"arm\" pos=\"0 0 1\"><geom size=\"1\"/><joint name=\"j\"/></body></frame>";
        let text = |before: &str, attach: &str, after: &str| {
            format!(
                "<default><default class=\"c\"><joint damping=\"3\"/></default></default><worldbody>{before}\
                 <body name=\"h\" pos=\"1 0 0\"><geom size=\"1\"/><joint name=\"k\"/><frame pos=\"1 2 3\">\
                 <attach {attach} prefix=\"l-\"/></frame></body>{after}</worldbody><actuator>\
                 <motor name=\"m\" joint=\"j\"/><motor name=\"n\" joint=\"k\"/></actuator>"
            )
        };
        let bare = arm.replace("<frame childclass=\"c\">", "").replace("</frame>", "");
        let bare = bare.replace("pos=", "childclass=\"c\" pos=");
        let found = described(&text(&bare, "body=\"arm\"", "")).expect("one model");
        assert_eq!(names(found.links.iter().map(|link| &link.name)), "world arm h l-arm");
        assert_eq!(names(found.joints.iter().map(|joint| &joint.name)), "j k l-j");
        assert_eq!(names(found.drives.iter().map(|drive| &drive.name)), "m n l-m");
        let [own, _, other] = found.joints.as_slice() else { panic!("{:?}", found.joints) };
        assert_eq!((other.position, other.damping, own.damping), ([1.0, 2.0, 4.0], 3.0, 3.0));
        assert_eq!((other.parent.as_str(), found.notes.len()), ("h", 0));
        let refused = |text: String| described(&text).map(|_| ()).expect_err("a fault")[0].message.clone();
        let later = "<attach>: `arm` does not end before it; what is attached stands before";
        assert_eq!(refused(text("", "body=\"arm\"", &bare)), later);
        assert_eq!(refused(text("", "body=\"h\"", "")), later.replace("arm", "h"));
        let nested = text(&bare, "body=\"arm\"", "<body><attach body=\"h\" prefix=\"x\"/></body>");
        assert_eq!(refused(nested), "<attach>: `h` attaches others itself; name another `model`");
        let framed = "<attach>: `arm` stands in a <frame> of its model, and is not attached without it";
        assert_eq!(refused(text(arm, "body=\"arm\"", "")), framed);
    }

    fn described(inside: &str) -> Result<Description, Vec<Fault>> {
        let text = format!("<mujoco>{inside}</mujoco>");
        read(&Text::of(Written::new(String::new(), PathBuf::new(), text)))
    }

    #[test]
    fn what_is_refused() {
        let folder = Folder::new("refused", LEG);
        let message = |inside: &str| {
            let faults = folder.read(inside).map(|_| ()).expect_err(inside);
            faults.iter().map(|fault| fault.message.clone()).collect::<Vec<_>>().join("\n")
        };
        let world = |attach: &str| message(&format!("{ASSET}<worldbody><attach {attach}/></worldbody>"));
        for (attach, expected) in [
            (
                "model=\"leg\" body=\"hipp\" prefix=\"a\"",
                "<attach>: it attaches `hipp`, which is no body; did you mean `hip`?",
            ),
            ("model=\"log\" prefix=\"a\"", "<attach>: it attaches `log`, which is no model; did you mean `leg`?"),
            ("model=\"leg\"", "<attach>: the attribute `prefix` is missing"),
            ("prefix=\"a\"", "<attach>: without a `model` it is to name a `body` of its own"),
            ("body=\"hip\" prefix=\"a\"", "<attach>: it attaches `hip`, which is no body of this file"),
            ("model=\"leg\" frame=\"f\" prefix=\"a\"", "<attach>: frames are not attached; make a <body> of it"),
        ] {
            assert_eq!(world(attach), expected);
        }
        let asset = |file: &str| message(&format!("<asset><model name=\"a\" {file}/></asset>"));
        assert_eq!(asset(""), "<model name=\"a\">: the attribute `file` is missing");
        assert!(asset("file=\"nowhere.xml\"").starts_with("<model name=\"a\">: cannot read `"));
        std::fs::write(folder.0.join("b.xml"), "<mujoco><asset><model file=\"./b.xml\"/></asset></mujoco>")
            .expect("written");
        assert_eq!(asset("file=\"b.xml\""), "<model>: `./b.xml` attaches itself, or what attaches it");
        // A mistake of a model that is attached twice is told once, where it is written.
        std::fs::write(folder.0.join("leg.xml"), LEG.replace("pos=\"1 0 0\"", "pos=\"1 0\"")).expect("written");
        let both = "<attach model=\"leg\" prefix=\"a\"/><attach model=\"leg\" prefix=\"a\"/>";
        let faults = folder.read(&format!("{ASSET}<worldbody>{both}</worldbody>")).map(|_| ()).expect_err("a place");
        assert_eq!((faults.len(), faults[0].at.file, faults[0].at.line), (1, 1, 4));
    }
}
