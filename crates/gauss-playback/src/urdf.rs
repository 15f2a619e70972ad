//! Shapes of the links of a URDF file.

use gauss_runtime::prelude::{Isometry3, Translation3, UnitQuaternion};
use roxmltree::{Document, Node};

use crate::shape::Shape;

/// The boxes, cylinders and balls of every link, by its name: those that are shown, and of links that are shown as
/// meshes alone those that touch.
///
/// # Errors
/// What is no URDF, or no number, and in which line.
pub fn shapes(text: &str) -> Result<Vec<(String, Shape)>, String> {
    // XML must not have blanks before its declaration, and files often do: lines without it are the same lines.
    let lines = match text.split_once("?>") {
        Some((declaration, rest)) if text.trim_start().starts_with("<?xml") => {
            "\n".repeat(declaration.matches('\n').count()) + rest
        }
        _ => text.to_owned(),
    };
    let lines = with_prefixes(lines);
    let document = Document::parse(&lines).map_err(|error| format!("this is no XML: {error}"))?;
    let mut roots = document.root_element().children().filter(Node::is_element);
    let (Some(robot), None) = (roots.next(), roots.next()) else {
        return Err("this is no XML: it has one root element".to_owned());
    };
    let mut all = Vec::new();
    for link in children(robot, "link") {
        let name = link.attribute("name").unwrap_or_default();
        let of = |kind: &'static str| -> Result<Vec<Shape>, String> {
            children(link, kind).filter_map(|node| shape(node).transpose()).collect()
        };
        let shown = of("visual")?;
        let shown = if shown.is_empty() { of("collision")? } else { shown };
        all.extend(shown.into_iter().map(|shape| (name.to_owned(), shape)));
    }
    Ok(all)
}

/// The lines within an element that declares the prefixes that nothing in them does, such as that of `<drake:joint>`:
/// XML asks for it, readers of robots do not.
fn with_prefixes(lines: String) -> String {
    /// More than any file has; each is found by parsing once more.
    const MOST: usize = 16;
    let mut lines = format!("<file>{lines}</file>");
    for _ in 0..MOST {
        let Err(roxmltree::Error::UnknownNamespace(prefix, _)) = Document::parse(&lines) else { break };
        lines.insert_str("<file".len(), &format!(" xmlns:{prefix}=\"{prefix}\""));
    }
    lines
}

/// Whether a body is that link: names that are no identifiers have been changed by the derive.
pub fn is_called(body: &str, link: &str) -> bool {
    let changed: String = link.chars().map(|c| if c.is_alphanumeric() { c } else { '_' }).collect();
    body == link
        || body == changed
        || [("link_", ""), ("", "_link")].iter().any(|(a, b)| body == format!("{a}{changed}{b}"))
}

/// Elements of URDF with a name: one with another prefix than its parent is something else, whatever its name.
fn children<'a>(node: Node<'a, 'a>, name: &'static str) -> impl Iterator<Item = Node<'a, 'a>> {
    elements(node).filter(move |child| child.tag_name().name() == name)
}

fn elements<'a>(node: Node<'a, 'a>) -> impl Iterator<Item = Node<'a, 'a>> {
    node.children().filter(move |child| child.tag_name().namespace() == node.tag_name().namespace())
}

/// None of a mesh.
fn shape(node: Node<'_, '_>) -> Result<Option<Shape>, String> {
    let Some(geometry) = children(node, "geometry").next() else { return Ok(None) };
    let shape = elements(geometry).find_map(|solid| match solid.tag_name().name() {
        "box" => Some(numbers(solid, "size").map(Shape::cuboid)),
        "sphere" => Some(numbers(solid, "radius").map(|[radius]| Shape::ball(radius))),
        "cylinder" => Some(numbers(solid, "radius").and_then(|[radius]| {
            let [length] = numbers(solid, "length")?;
            Ok(Shape::cylinder(radius, length))
        })),
        _ => None,
    });
    let Some(shape) = shape.transpose()? else { return Ok(None) };
    let (mut position, mut turn) = ([0.0; 3], [0.0; 3]);
    if let Some(origin) = children(node, "origin").next() {
        for (name, value) in [("xyz", &mut position), ("rpy", &mut turn)] {
            if origin.attribute(name).is_some() {
                *value = numbers(origin, name)?;
            }
        }
    }
    let [roll, pitch, yaw] = turn;
    let turn = UnitQuaternion::from_euler_angles(roll, pitch, yaw);
    let shape = shape.at(&Isometry3::from_parts(Translation3::from(position), turn));
    let colour = children(node, "material").flat_map(|material| children(material, "color")).next();
    Ok(Some(match colour {
        Some(colour) => {
            let [r, g, b, _] = numbers::<4>(colour, "rgba")?.map(|part| (255.0 * part.clamp(0.0, 1.0)).round());
            shape.colour(&format!("rgb({r},{g},{b})"))
        }
        None => shape,
    }))
}

fn numbers<const N: usize>(node: Node<'_, '_>, name: &str) -> Result<[f64; N], String> {
    let text = node.attribute(name).unwrap_or_default();
    let number = |word: &str| word.parse().ok().filter(|number: &f64| number.is_finite());
    let all: Option<Vec<f64>> = text.split_whitespace().map(number).collect();
    all.and_then(|all| all.try_into().ok()).ok_or_else(|| {
        let line = node.document().text_pos_at(node.range().start).row;
        format!("line {line}: `{name}` of <{}> is {N} numbers, found `{text}`", node.tag_name().name())
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const ARM: &str = r#"
<?xml version="1.0"?>
<robot name="arm">
  <link name="base">
    <visual><geometry><mesh filename="base.stl"/></geometry></visual>
    <collision>
      <origin xyz="0 0 1" rpy="0 1.5707963267948966 0"/><geometry><cylinder radius="0.1" length="2"/></geometry>
    </collision>
  </link>
  <link name="upper-arm">
    <visual>
      <geometry><box size="1 2 3"/></geometry><material name="red"><color rgba="1 0 0 1"/></material>
    </visual>
    <visual><geometry><sphere radius="0.5"/></geometry></visual>
    <collision><geometry><sphere radius="9"/></geometry></collision>
  </link>
</robot>"#;

    #[test]
    fn what_is_shown_is_read_and_else_what_touches() {
        let shapes = shapes(ARM).expect("it is right");
        let found: Vec<_> =
            shapes.iter().map(|(name, shape)| (name.as_str(), serde_json::to_value(shape).expect("JSON"))).collect();
        let (names, found): (Vec<_>, Vec<_>) = found.into_iter().unzip();
        assert_eq!(names, ["base", "upper-arm", "upper-arm"]);
        assert_eq!(found[0]["kind"], "cylinder");
        assert_eq!(found[0]["size"], serde_json::json!([0.1, 0.1, 1.0]));
        assert_eq!(found[0]["pose"][2], 1.0);
        assert!((found[0]["pose"][4].as_f64().expect("j") - 0.5_f64.sqrt()).abs() < 1e-15);
        assert_eq!((&found[1]["kind"], &found[1]["colour"]), (&"cuboid".into(), &"rgb(255,0,0)".into()));
        assert_eq!(found[2]["size"], serde_json::json!([0.5, 0.5, 0.5]));
        assert!(is_called("upper_arm", "upper-arm") && is_called("base", "base") && !is_called("base", "upper-arm"));
    }

    #[test]
    fn mistakes_have_their_line() {
        let wrong = ARM.replace("size=\"1 2 3\"", "size=\"1 2\"");
        let error = shapes(&wrong).expect_err("two numbers");
        assert_eq!(error, "line 12: `size` of <box> is 3 numbers, found `1 2`");
        for text in ["<robot>", "", "<robot/><robot/>", "<robot/></file><file>"] {
            assert!(shapes(text).expect_err("no element").starts_with("this is no XML"), "{text}");
        }
    }

    #[test]
    fn prefixes_need_no_declaration() {
        let drake = "<drake:link name=\"other\"><visual/></drake:link><link name=\"ball\"><visual><geometry>\
                     <drake:box size=\"soft\"/><sphere radius=\"2\"/></geometry></visual></link></robot>";
        let shapes = shapes(&ARM.replace("</robot>", drake)).expect("as the reader of robots has it");
        let names: Vec<&str> = shapes.iter().map(|(name, _)| name.as_str()).collect();
        assert_eq!(names, ["base", "upper-arm", "upper-arm", "ball"]);
    }
}
