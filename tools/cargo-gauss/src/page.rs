//! Equations as a page: MathML, which browsers set without any script.

use gauss_codegen::Notation;
use gauss_codegen::mathml::{self, escaped};

use crate::shown::{Shown, loss};

const STYLE: &str = include_str!("page.css");

/// All structs of a file, charts of one struct side by side.
pub fn html(file: &str, all: &[Shown]) -> String {
    let titles: Vec<&str> = all.iter().map(|shown| shown.title.as_str()).collect();
    let title = escaped(&titles.join(" · "));
    let sections: String = all.iter().map(section).collect();
    format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>{title}</title>\n\
         <style>\n{STYLE}</style>\n</head>\n<body>\n<main>\n{sections}</main>\n\
         <footer>derived from <code>{}</code> by <code>cargo gauss show</code></footer>\n</body>\n</html>\n",
        escaped(file)
    )
}

fn section(shown: &Shown) -> String {
    let derivation = &shown.derivation;
    let sections = derivation.sections(Notation::Latex).iter();
    let lines: String = sections.map(|(title, equations)| heading(title) + &set(equations)).collect();
    let rows: String = derivation
        .functions()
        .programs()
        .map(|program| {
            let cost = program.code.cost();
            let loss = loss(derivation, &program.name);
            let [most, middle] = loss.map_or_else(Default::default, |loss| loss.map(|loss| format!("{loss} ×")));
            format!(
                "<tr><td><code>{}</code></td><td>{}</td><td>{}</td><td>{}</td><td>{most}</td><td>{middle}</td></tr>\n",
                escaped(&program.name),
                escaped(&program.code.counts().to_string()),
                cost.total(),
                cost.chain
            )
        })
        .collect();
    format!(
        "<section>\n<h1>{}</h1>\n<div class=\"equations\">\n{lines}</div>\n<table>\n<thead><tr><th>method</th><th>operations</th>\
         <th>cost</th><th>chain</th><th>rounding, at most</th><th>mostly</th></tr></thead>\n<tbody>\n{rows}</tbody>\n</table>\n\
         <p class=\"note\">Cost counts instructions, the chain those that wait for one another. Rounding: how much more than a \
         change of the arguments in their last place it does, at the worst state found.</p>\n{}</section>\n",
        escaped(&shown.title),
        remarks(derivation.remarks())
    )
}

/// The remarks on a robot's file, as a list.
fn remarks(remarks: &[String]) -> String {
    let items: String = remarks.iter().map(|remark| format!("<li>{}</li>\n", escaped(remark))).collect();
    if items.is_empty() { items } else { format!("<h2>The file</h2>\n<ul class=\"note\">\n{items}</ul>\n") }
}

fn heading(title: &str) -> String {
    format!("<h2>{}</h2>\n", mathml::words(title))
}

/// Equations, each in as many lines as the window takes.
fn set(equations: &[String]) -> String {
    let line = |equation: &String| format!("<p>{}</p>\n", mathml::line(&equation.replacen(" = ", " &= ", 1)));
    equations.iter().map(line).collect()
}
