//! The pages that people read: links lead somewhere, lines are as wide as a person reads, every chapter of the guide is
//! in its list and is compiled, and the README's table of times is that of docs/benchmarks.

mod kept_expansions;
mod mistakes;
mod programs;

use std::collections::HashSet;
use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};

use gauss_tests::pages::{keep, repository};

/// Folders whose Markdown pages are read.
const FOLDERS: &[&str] = &[
    "",
    "docs",
    "docs/benchmarks",
    "guide/src",
    "tests",
    "tests/references",
    "gauss-codegen",
    "gauss-runtime/src",
    "examples",
    "crates/gauss-adapters",
    "crates/gauss-batch",
    "crates/gauss-bounded",
    "crates/gauss-contact",
    "crates/gauss-exact",
    "crates/gauss-files",
    "crates/gauss-fmu",
    "crates/gauss-jit",
    "crates/gauss-playback",
    "crates/gauss-py",
    "crates/gauss-python",
    "crates/gauss-rerun",
    "crates/gauss-robots",
    "crates/gauss-sensitivity",
    "crates/gauss-study",
    "crates/gauss-tables",
    "tools/cargo-gauss",
];

/// Columns of a line outside tables.
const WIDTH: usize = 120;

struct PageOfRepository {
    name: String,
    path: PathBuf,
    text: String,
}

fn pages() -> Vec<PageOfRepository> {
    let mut pages = Vec::new();
    for folder in FOLDERS.iter().copied() {
        let entries = fs::read_dir(repository().join(folder)).unwrap_or_else(|error| panic!("{folder}: {error}"));
        for entry in entries {
            let path = entry.expect("an entry").path();
            if path.extension().is_some_and(|extension| extension == "md") {
                let name = format!("{folder}/{}", path.file_name().expect("a name").to_string_lossy());
                let text = fs::read_to_string(&path).unwrap_or_else(|error| panic!("{name}: {error}"));
                pages.push(PageOfRepository { name, path, text });
            }
        }
    }
    pages
}

/// Lines with their numbers, without those of blocks of code.
fn prose(text: &str) -> impl Iterator<Item = (usize, &str)> {
    let mut code = false;
    text.lines().enumerate().filter_map(move |(n, line)| {
        let fence = line.trim_start().starts_with("```");
        code ^= fence;
        (!code && !fence).then_some((n + 1, line))
    })
}

/// Targets of `[…](…)` and of pictures in tables, `src="…"`, without what stands between backquotes.
fn targets(line: &str) -> Vec<&str> {
    let mut out = Vec::new();
    for part in line.split('`').step_by(2) {
        // A link whose text ends in code begins its part with `](`.
        for (at, _) in part.match_indices("](") {
            let target = &part[at + 2..];
            out.push(&target[..target.find(')').unwrap_or(target.len())]);
        }
        out.extend(part.split("src=\"").skip(1).filter_map(|target| target.split('"').next()));
    }
    out
}

/// The anchors of a page as GitHub and mdBook make them: letters, digits and hyphens of its headings.
fn anchors(text: &str) -> HashSet<String> {
    let headings = prose(text).filter_map(|(_, line)| line.strip_prefix('#'));
    let slug = |heading: &str| {
        let heading = heading.trim_start_matches('#').trim().to_lowercase();
        let kept = heading.chars().filter(|c| c.is_alphanumeric() || matches!(c, ' ' | '-' | '_'));
        kept.map(|c| if c == ' ' { '-' } else { c }).collect()
    };
    headings.map(slug).collect()
}

/// What is wrong with a link of a page.
fn complaint(page: &PageOfRepository, target: &str) -> Option<String> {
    if target.contains("://") || target.starts_with("mailto:") {
        return None;
    }
    let (file, anchor) = target.split_once('#').map_or((target, None), |(file, anchor)| (file, Some(anchor)));
    let path = if file.is_empty() { page.path.clone() } else { page.path.with_file_name(file) };
    if !path.exists() {
        return Some(format!("there is no {file}"));
    }
    if page.name.starts_with("guide/") && file.contains("..") {
        return Some(format!("{file} is not part of the book"));
    }
    let anchor = anchor?;
    let text = fs::read_to_string(&path).ok()?;
    (!anchors(&text).contains(anchor)).then(|| format!("no heading of {file} has the anchor #{anchor}"))
}

#[test]
fn links_lead_somewhere() {
    let (mut wrong, mut links) = (String::new(), 0);
    for page in pages() {
        for (n, line) in prose(&page.text) {
            for target in targets(line) {
                links += 1;
                if let Some(complaint) = complaint(&page, target) {
                    writeln!(wrong, "{}:{n}: {complaint}", page.name).expect("a string");
                }
            }
        }
    }
    assert!(links > 50, "only {links} links were found");
    assert!(wrong.is_empty(), "\n{wrong}");
}

#[test]
fn lines_are_no_wider_than_a_person_reads() {
    let mut wrong = String::new();
    for page in pages() {
        for (n, line) in page.text.lines().enumerate() {
            let columns = line.chars().count();
            if columns > WIDTH && !line.trim_start().starts_with('|') {
                writeln!(wrong, "{}:{}: {columns} columns", page.name, n + 1).expect("a string");
            }
        }
    }
    assert!(wrong.is_empty(), "\n{wrong}");
}

#[test]
fn every_chapter_is_listed_and_compiled() {
    let guide = repository().join("guide");
    let read = |path: &Path| fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    let (list, library) = (read(&guide.join("src/SUMMARY.md")), read(&guide.join("lib.rs")));
    for page in pages().iter().filter(|page| page.name.starts_with("guide/src/")) {
        let file = page.path.file_name().expect("a name").to_string_lossy();
        if file != "SUMMARY.md" {
            assert!(list.contains(&format!("({file})")), "guide/src/SUMMARY.md does not list {file}");
            // What is included from an example is compiled there.
            let compiled = library.contains(&format!("src/{file}\"")) || !page.text.contains("```rust\n");
            assert!(compiled, "guide/lib.rs does not compile {file}");
        }
    }
}

/// Parts of examples that the guide shows are there, by their names.
#[test]
fn what_the_guide_includes_is_there() {
    let mut included = 0;
    for page in pages().iter().filter(|page| page.name.starts_with("guide/src/")) {
        for (_, rest) in page.text.match_indices("{{#include ").map(|(at, start)| page.text.split_at(at + start.len()))
        {
            let (file, name) =
                rest.split_once("}}").and_then(|(link, _)| link.split_once(':')).expect("a file and a name");
            let text =
                fs::read_to_string(page.path.with_file_name(file)).unwrap_or_else(|error| panic!("{file}: {error}"));
            let marks = [format!("// ANCHOR: {name}\n"), format!("// ANCHOR_END: {name}\n")];
            let places = marks.each_ref().map(|mark| text.find(mark).unwrap_or_else(|| panic!("{file} has no {mark}")));
            assert!(places[0] < places[1], "{file}: {name}");
            included += 1;
        }
    }
    assert!(included >= 10, "only {included} parts are included");
}

/// Words that people look for in the documentation lead to what has another name there.
#[test]
fn words_of_the_field_are_found() {
    fn sources(folder: &Path, all: &mut String) {
        for entry in fs::read_dir(folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display())) {
            let path = entry.expect("an entry").path();
            if path.is_dir() {
                sources(&path, all);
            } else if path.extension().is_some_and(|extension| extension == "rs") {
                all.push_str(&fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display())));
            }
        }
    }
    let mut all = String::new();
    sources(&repository().join("gauss-runtime/src"), &mut all);
    for word in ["hold", "contact", "csv", "bearing", "impact", "riccati", "euler angles", "jacobian"] {
        assert!(all.contains(&format!("#[doc(alias = \"{word}\")]")), "nothing in gauss-runtime is found by `{word}`");
    }
}

/// The README's first command runs the README's first program, but for what that does with its table.
#[test]
fn the_first_command_is_the_first_program() {
    let read =
        |file: &str| fs::read_to_string(repository().join(file)).unwrap_or_else(|error| panic!("{file}: {error}"));
    let program = |text: &str| {
        let from = text.find("/// A torpedo").expect("the struct");
        let length = text[from..].find("println!(\"after 10 s").expect("the run");
        // rustfmt breaks lines, and ends lists of several lines with a comma.
        let words: String = text[from..from + length].split_whitespace().collect();
        words.replace(",}", "}").replace(",)", ")").replace(",]", "]")
    };
    let readme = read("README.md");
    assert!(readme.contains("cargo run --release -p gauss-first"));
    assert_eq!(program(&readme), program(&read("examples/first/main.rs")));
}

#[test]
fn pages_for_those_in_a_hurry_are_short() {
    for (name, most) in [("README.md", 140), ("BENCHMARKS.md", 150), ("CHANGELOG.md", 150)] {
        let lines = fs::read_to_string(repository().join(name)).expect("the page is there").lines().count();
        assert!(lines <= most, "{name} has {lines} lines; what is over {most} belongs into the guide or docs/");
    }
}

/// The table whose heading begins so, as cells; the heading is the first row.
fn table<'p>(page: &'p str, heading: &str) -> Vec<Vec<&'p str>> {
    let cells = |line| str::trim_matches(line, '|').split('|').map(str::trim).collect();
    let lines = page.lines().skip_while(|line| !line.starts_with(heading));
    lines.take_while(|line| line.starts_with('|')).map(cells).collect()
}

/// The numbers of a cell: `7.4 (1.086) gcc` has two.
fn numbers(cell: &str) -> Vec<f64> {
    cell.split([' ', '(', ')', '–']).filter_map(|word| word.parse().ok()).collect()
}

/// The times of the README: what the pages of benchmarks have, of three scenes and a robot.
#[test]
fn readme_shows_the_times_of_benchmarks() {
    const SCENES: [(&str, &str); 4] =
        [("S3", "body in fluid"), ("S5", "double pendulum"), ("S7", "7-joint arm"), ("S8 forward", "quadruped, 18")];
    // In the README, in the table of peers, in the table of robots.
    const PEERS: [(&str, &str, &str); 3] = [
        ("CasADi, accelerations derived by hand", "casadi by hand", ""),
        ("Pinocchio, ABA", "pinocchio", "Pinocchio, ABA and RNEA"),
        ("MuJoCo, forward", "mujoco", "MuJoCo, `mj_forward`"),
    ];
    let [accelerations, robots] = ["accelerations", "robots"].map(|name| {
        let page = repository().join("docs/benchmarks").join(name).with_extension("md");
        fs::read_to_string(&page).unwrap_or_else(|error| panic!("{}: {error}", page.display()))
    });
    let mut by_hand = table(&accelerations, "| scene | operations | generated, ns |");
    // `S1 free body, …`.
    by_hand.iter_mut().for_each(|row| row[0] = row[0].split(' ').next().unwrap_or_default());
    let peers = table(&accelerations, "| ns (generated / peer)");
    let robots = table(&robots, "| ns | S7′ forward |");
    let of = |table: &[Vec<&str>], row: &str, column: &str| {
        let column = table[0].iter().position(|cell| *cell == column);
        let row = table.iter().find(|cells| cells[0] == row);
        row.zip(column).map_or(String::new(), |(row, column)| row[column].to_owned())
    };
    let shown = |ns: f64| if ns < 100.0 { format!("{ns:.1}") } else { format!("{ns:.0}") };
    // Ratios are those of neighbours in time, not of the medians.
    let cell = |ns: &str, ratio: &str| match (numbers(ns).first(), numbers(ratio).first()) {
        (Some(ns), Some(ratio)) => format!("{} ({ratio:.2})", shown(*ns)),
        _ => "–".to_owned(),
    };

    let mut out = format!("| | {} |\n|{}", SCENES.map(|(_, name)| name).join(" | "), "---|".repeat(SCENES.len() + 1));
    let mut row = |name: &str, cell: &dyn Fn(&str) -> String| {
        write!(out, "\n| {name} | {} |", SCENES.map(|(scene, _)| cell(scene)).join(" | ")).expect("a string");
    };
    row("Gauss", &|scene| {
        let ns = of(&peers, "generated", scene) + &of(&robots, "generated", scene);
        shown(numbers(&ns)[0])
    });
    row("by hand, in Rust", &|scene| {
        cell(&of(&by_hand, scene, "by hand, ns"), &of(&by_hand, scene, "generated / by hand"))
    });
    for (name, peer, robot) in PEERS {
        row(name, &|scene| {
            let both = of(&peers, peer, scene) + &of(&robots, robot, scene);
            let (ns, ratio) = both.split_once('(').unwrap_or_default();
            cell(ns, ratio)
        });
    }
    out += "\n";
    keep("README.md", "peers", &out);
}
