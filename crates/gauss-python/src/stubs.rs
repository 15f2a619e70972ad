//! The stubs of a module, `.pyi`: what editors show and type checkers read, with shapes and units.

use std::fmt::Write;
use std::sync::Arc;

use gauss_runtime::integrate::Method;

use crate::arrays::shown;
use crate::description::Shape;
use crate::documentation::documentation;
use crate::kernels::AnyScene;
use crate::methods::{Argument, Id, SPECS, Size, Spec};

/// The text before all classes.
fn head() -> String {
    let methods: Vec<String> = Method::ALL.iter().map(|method| format!("{:?}", method.name())).collect();
    include_str!("stubs.pyi.txt").replace("METHODS", &methods.join(", "))
}

/// The text of a module with these classes.
pub fn text(scenes: &[Arc<dyn AnyScene>]) -> String {
    let mut text = head() + &tuples();
    scenes.iter().for_each(|scene| text.push_str(&class(&**scene)));
    text
}

/// The text of a module whose classes come at run time: `Kernel`, the last in the head, has all methods.
#[cfg(feature = "loaded")]
pub fn text_of_loaded() -> String {
    let names = Names { frames: None, joints: None };
    let of = |spec: &Spec| method(spec, &names, |_| true, spec.documentation);
    let methods: String = SPECS.iter().map(of).collect();
    head() + &methods + &tuples()
}

/// Classes of results, of methods that give several.
fn tuples() -> String {
    let mut text = String::new();
    for spec in SPECS.iter().filter(|spec| spec.results.len() > 1) {
        let _ = write!(text, "\nclass {}(NamedTuple):\n", spec.class_name());
        for result in spec.results {
            let _ = writeln!(text, "    {}: Array", result.name);
        }
    }
    text
}

fn class(scene: &dyn AnyScene) -> String {
    let description = scene.description();
    let mut text = format!("\nclass {}(Kernel):\n", description.name);
    text.push_str(&docstring(&documentation(scene), 4));
    let keywords = description.fields.iter().map(|field| match field.shape {
        Shape::Array([]) => format!("{}: float", field.name),
        Shape::Array(_) | Shape::Rotation => format!("{}: ArrayLike", field.name),
        Shape::Body => format!("{}: Mapping[str, Any]", field.name),
    });
    let keywords: Vec<String> = keywords.collect();
    let star = if keywords.is_empty() { "" } else { ", *, " };
    let _ = writeln!(text, "    def __init__(self{star}{}) -> None: ...", keywords.join(", "));
    if !scene.contacts().is_empty() {
        let _ = writeln!(text, "    def without_contacts(self) -> {}: ...", description.name);
    }
    let all = SPECS.iter().enumerate();
    for (_, spec) in all.filter(|(number, _)| Id::ALL.iter().any(|id| *id as usize == *number && scene.has(*id))) {
        let names = Names { frames: Some(scene.frames()), joints: Some(scene.joints()) };
        let is_optional = |argument: &Argument| scene.sizes().get(argument.size) == 0;
        text.push_str(&method(spec, &names, is_optional, &shapes(scene, spec)));
    }
    text
}

/// The names of frames and joints, where they are known.
struct Names<'a> {
    frames: Option<&'a [&'static str]>,
    joints: Option<&'a [&'static str]>,
}

/// A method with its documentation; `is_optional`: of an input, whether it may be left out.
fn method(spec: &Spec, names: &Names<'_>, is_optional: impl Fn(&Argument) -> bool, words: &str) -> String {
    let frame = spec.frame.then(|| {
        // Of joints there is one method.
        let (word, names) = if spec.name == "reaction" { ("joint", names.joints) } else { ("frame", names.frames) };
        let literal = |names: &[&str]| {
            let names: Vec<String> = names.iter().map(|name| format!("{name:?}")).collect();
            format!("Literal[{}]", names.join(", "))
        };
        format!("{word}: {}", names.map_or_else(|| "str".to_owned(), literal))
    });
    let argument = |argument: &Argument| match argument.name == "input" && is_optional(argument) {
        true => format!("{}: ArrayLike | None = None", argument.name),
        false => format!("{}: ArrayLike", argument.name),
    };
    let arguments: Vec<String> = frame.into_iter().chain(spec.arguments.iter().map(argument)).collect();
    let (result, out) = match spec.results {
        [_] => ("Array".to_owned(), "Array | Single".to_owned()),
        _ => (spec.class_name(), "tuple[Array, ...] | tuple[Single, ...]".to_owned()),
    };
    let head = format!("    def {}(self, {}, *, t: ArrayLike = 0.0,", spec.name, arguments.join(", "));
    format!(
        "{head} out: {out} | None = None, **parameters: ArrayLike) -> {result}:\n{}        ...\n",
        docstring(words, 8)
    )
}

/// `q (..., 2), z (..., 2) -> (..., 2)`.
fn shapes(scene: &dyn AnyScene, spec: &Spec) -> String {
    let sizes = scene.sizes();
    let axes = |axes: &[Size]| {
        let own: Vec<String> = axes.iter().map(|axis| format!(", {}", sizes.get(*axis))).collect();
        format!("(...{})", own.concat())
    };
    let arguments = spec.arguments.iter().filter(|argument| sizes.get(argument.size) > 0);
    let arguments: Vec<String> =
        arguments.map(|argument| format!("{} {}", argument.name, axes(&[argument.size]))).collect();
    let results = spec.results.iter().map(|result| format!("{} {}", result.name, axes(result.axes)).trim().to_owned());
    let results: Vec<String> = results.collect();
    let inputs =
        scene.description().inputs.iter().map(|part| format!("{} {}, {}", part.name, shown(&[part.size]), part.label));
    let has_input = spec.arguments.iter().any(|argument| argument.name == "input" && sizes.input > 0);
    let inputs: Vec<String> = inputs.filter(|_| has_input).collect();
    let inputs = if inputs.is_empty() { String::new() } else { format!("\n\nInputs: {}.", inputs.join("; ")) };
    format!("{}\n\n{} -> {}{inputs}", spec.documentation, arguments.join(", "), results.join(", "))
}

fn docstring(text: &str, indent: usize) -> String {
    let space = " ".repeat(indent);
    let text = text.trim().replace('\\', "\\\\").replace("\"\"\"", "'''");
    let lines: Vec<String> =
        text.lines().map(|line| if line.is_empty() { String::new() } else { format!("{space}{line}") }).collect();
    format!("{space}\"\"\"{}\n{space}\"\"\"\n", lines.join("\n").trim_start())
}
