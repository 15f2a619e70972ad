//! The front page of the site, with a card for each example of `examples/README.md`.

use std::fmt::Write as _;
use std::path::Path;
use std::{fs, io};

const TEMPLATE: &str = include_str!("site.html");

/// A program of the repository that shows something.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Example {
    /// The name that Cargo knows it by.
    pub name: String,
    /// A sentence in Markdown.
    pub text: String,
    /// The file of its picture, beside the README.
    pub picture: Option<String>,
}

/// Examples about one thing.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Section {
    /// Its heading.
    pub title: String,
    /// Its examples, in the order of the README.
    pub examples: Vec<Example>,
}

/// The examples of a README that has a table of pictures and sentences below each heading.
#[must_use]
pub fn examples(readme: &str) -> Vec<Section> {
    let mut sections: Vec<Section> = Vec::new();
    for line in readme.lines() {
        if let Some(title) = line.strip_prefix("## ") {
            sections.push(Section { title: title.to_owned(), examples: Vec::new() });
        } else if let (Some(section), Some(example)) = (sections.last_mut(), example(line)) {
            section.examples.push(example);
        }
    }
    sections
}

/// `| <img src="…"> | `name`: what it shows |`.
fn example(line: &str) -> Option<Example> {
    let (picture, rest) = line.strip_prefix('|')?.split_once('|')?;
    let (command, text) = rest.trim().trim_end_matches('|').strip_prefix('`')?.split_once("`:")?;
    let picture = picture.split_once("src=\"").and_then(|(_, rest)| rest.split_once('"'));
    Some(Example {
        name: command.split_whitespace().last()?.to_owned(),
        text: text.trim().to_owned(),
        picture: picture.map(|(file, _)| file.to_owned()),
    })
}

/// The front page of a folder that has `guide`, `reference`, `live.html` and, for each example that has been run, its
/// files in `examples/NAME` and its picture, `pictures/NAME`.
///
/// # Errors
/// Folders that cannot be read.
pub fn html(sections: &[Section], folder: &Path) -> io::Result<String> {
    let mut gallery = String::new();
    for section in sections {
        let _ = write!(gallery, "<h2>{}</h2>\n<div class=\"cards\">\n", text(&section.title));
        for example in &section.examples {
            gallery.push_str(&card(example, folder)?);
        }
        gallery.push_str("</div>\n");
    }
    Ok(TEMPLATE.replace("GALLERY", gallery.trim_end()))
}

/// An example with links to the pages and plots that it has written.
fn card(example: &Example, folder: &Path) -> io::Result<String> {
    let own = format!("examples/{}", example.name);
    let mut files: Vec<String> = match fs::read_dir(folder.join(&own)) {
        Ok(all) => all.map(|file| Ok(file?.file_name().to_string_lossy().into_owned())).collect::<io::Result<_>>()?,
        Err(error) if error.kind() == io::ErrorKind::NotFound => Vec::new(),
        Err(error) => return Err(error),
    };
    files.retain(|file| file.ends_with(".html") || file.ends_with(".svg"));
    // Pages first.
    files.sort_by_key(|file| (file.ends_with(".svg"), file.clone()));
    let links = files.iter().map(|file| {
        let (stem, kind) = file.rsplit_once('.').unwrap_or((file, ""));
        let shown = if kind == "html" { "▶ " } else { "plot: " };
        format!("<a href=\"{own}/{}\">{shown}{}</a>", text(file), text(&stem.replace('_', " ")))
    });
    let links: Vec<String> = links.collect();
    let picture = example.picture.as_ref().and_then(|file| file.rsplit('/').next()).map_or(String::new(), |file| {
        let picture = format!("<img src=\"pictures/{}\" alt=\"\" loading=\"lazy\">", text(file));
        match files.first() {
            Some(first) => format!("<a href=\"{own}/{}\">{picture}</a>", text(first)),
            None => picture,
        }
    });
    let (name, sentence) = (text(&example.name), sentence(&example.text));
    Ok(format!(
        "<article>{picture}<h3>{name}</h3><p>{sentence}</p><p class=\"links\">{}</p></article>\n",
        links.join(" ")
    ))
}

/// Text between tags.
fn text(plain: &str) -> String {
    plain.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

/// A sentence of Markdown: code as such, of links their text, since they are of the repository.
fn sentence(markdown: &str) -> String {
    let mut left = markdown.to_owned();
    while let Some((start, middle)) = left.find("](").and_then(|middle| Some((left[..middle].rfind('[')?, middle))) {
        let Some(end) = left[middle..].find(')') else { break };
        left = format!("{}{}{}", &left[..start], &left[start + 1..middle], &left[middle + end + 1..]);
    }
    let parts = left.split('`').enumerate();
    parts.map(|(n, part)| if n % 2 == 1 { format!("<code>{}</code>", text(part)) } else { text(part) }).collect()
}
