//! The stubs of a module, `.pyi`: what editors show and type checkers read, with shapes and units.

use std::fmt::Write;
use std::sync::Arc;

use crate::arrays::shown;
use crate::description::Shape;
use crate::documentation::documentation;
use crate::kernels::AnyScene;
use crate::methods::{Argument, Id, SPECS, Size, Spec};

const HEAD: &str = include_str!("stubs.pyi.txt");

/// The text.
pub fn text(scenes: &[Arc<dyn AnyScene>]) -> String {
    let mut text = HEAD.to_owned();
    for spec in SPECS.iter().filter(|spec| spec.results.len() > 1) {
        let _ = write!(text, "\nclass {}(NamedTuple):\n", spec.class_name());
        for result in spec.results {
            let _ = writeln!(text, "    {}: Array", result.name);
        }
    }
    scenes.iter().for_each(|scene| text.push_str(&class(&**scene)));
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
        text.push_str(&method(scene, spec));
    }
    text
}

fn method(scene: &dyn AnyScene, spec: &Spec) -> String {
    let frame = spec.frame.then(|| {
        // Of joints there is one method.
        let (word, names) = if spec.name == "reaction" { ("joint", scene.joints()) } else { ("frame", scene.frames()) };
        let names: Vec<String> = names.iter().map(|name| format!("{name:?}")).collect();
        format!("{word}: Literal[{}]", names.join(", "))
    });
    let argument = |argument: &Argument| match scene.sizes().get(argument.size) {
        0 => format!("{}: ArrayLike | None = None", argument.name),
        _ => format!("{}: ArrayLike", argument.name),
    };
    let arguments: Vec<String> = frame.into_iter().chain(spec.arguments.iter().map(argument)).collect();
    let (result, out) = match spec.results {
        [_] => ("Array".to_owned(), "Array | Single".to_owned()),
        _ => (spec.class_name(), "tuple[Array, ...] | tuple[Single, ...]".to_owned()),
    };
    let head = format!("    def {}(self, {}, *, t: ArrayLike = 0.0,", spec.name, arguments.join(", "));
    format!("{head} out: {out} | None = None) -> {result}:\n{}        ...\n", docstring(&shapes(scene, spec), 8))
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
