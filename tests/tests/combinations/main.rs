//! The table of what a scene may hold, and what is done with it: `docs/combinations.md` is written from here
//! (`UPDATE_COMBINATIONS=1`) and compared. Each test that the table names is where it says.

mod cells;
mod equations;
mod happenings;

use std::fmt::Write;
use std::fs;

use gauss_tests::pages::repository;

use cells::{COLUMNS, Cell, Kind, Row, Test, UNSHOWN};
use equations::{CONSTRAINTS, INPUTS, MASS, MODES, RECORDED, REDUNDANT, SMOOTH, STATES, TABLE_OF_ONE, TABLES};
use happenings::{CONTACTS, EVENTS, JUMPS, RANGES, SAMPLED, SLOTS};

const ROWS: [Row; 16] = [
    SMOOTH,
    MASS,
    CONSTRAINTS,
    REDUNDANT,
    STATES,
    MODES,
    TABLE_OF_ONE,
    TABLES,
    INPUTS,
    RECORDED,
    SAMPLED,
    EVENTS,
    JUMPS,
    RANGES,
    CONTACTS,
    SLOTS,
];

fn cell(row: &Row, column: &str) -> Cell {
    row.cells.iter().find(|(name, _)| *name == column).map_or(UNSHOWN, |(_, cell)| *cell)
}

fn every_cell() -> impl Iterator<Item = Cell> {
    ROWS.iter().flat_map(|row| COLUMNS.iter().map(move |(column, ..)| cell(row, column)))
}

const HEAD: &str = "\
# Combinations

Rows are what a scene may hold, columns what is done with it, cells how it is today: run by a test, refused and why,
shown by no test, not built. `tests/tests/combinations` has the table, sees that every test it names
is there, and writes this page: `UPDATE_COMBINATIONS=1 cargo test -p gauss-tests --test combinations`.

";

/// The number of cells of each kind.
fn counts() -> String {
    let mut out = String::from("| | cells | |\n|---|---|---|\n");
    for kind in Kind::ALL {
        let count = every_cell().filter(|cell| cell.kind == kind).count();
        writeln!(out, "| {} | {count} | {} |", kind.symbol(), kind.words()).expect("a string");
    }
    out
}

fn matrix() -> String {
    let columns = COLUMNS.map(|(letters, ..)| letters).join(" | ");
    let mut out = format!("\n| | {columns} |\n|---|{}\n", "---|".repeat(COLUMNS.len()));
    for row in &ROWS {
        let symbols = COLUMNS.map(|(column, ..)| cell(row, column).kind.symbol()).join(" | ");
        writeln!(out, "| [{}](#{}) | {symbols} |", row.name, row.name.to_lowercase().replace(' ', "-"))
            .expect("a string");
    }
    out.push_str("\n| | what is done | |\n|---|---|---|\n");
    for (letters, name, words) in COLUMNS {
        writeln!(out, "| {letters} | {name} | {words} |").expect("a string");
    }
    out
}

/// The test that shows a cell, with a link.
fn evidence(cell: &Cell) -> String {
    match cell.test {
        Some(Test { file, name: "main" }) => format!("[{file}](../{file})"),
        Some(Test { file, name }) => format!("[`{name}`](../{file})"),
        None if cell.kind == Kind::Refused => "no test".to_owned(),
        None => String::new(),
    }
}

/// The reasons and tests of a row, alike ones together.
fn section(row: &Row) -> String {
    let mut told: Vec<(Cell, Vec<&str>)> = Vec::new();
    for (column, name, _) in COLUMNS {
        let cell = cell(row, column);
        match told.iter_mut().find(|(other, _)| *other == cell) {
            Some((_, names)) => names.push(name),
            None => told.push((cell, vec![name])),
        }
    }
    let mut out = format!("\n## {}\n\n{}\n\n| | | shown by | |\n|---|---|---|---|\n", row.name, row.clause);
    told.sort_by_key(|(cell, _)| *cell == UNSHOWN);
    for (cell, names) in told {
        writeln!(out, "| {} | {} | {} | {} |", cell.kind.symbol(), names.join(", "), evidence(&cell), cell.why)
            .expect("a string");
    }
    out
}

#[test]
fn the_table_is_as_it_is_told() {
    let page = [HEAD.to_owned(), counts(), matrix()].concat() + &ROWS.iter().map(section).collect::<String>();
    let path = repository().join("docs/combinations.md");
    if std::env::var_os("UPDATE_COMBINATIONS").is_some() {
        fs::write(&path, &page).expect("docs can be written");
    }
    assert_eq!(fs::read_to_string(path).unwrap_or_default(), page, "UPDATE_COMBINATIONS=1 writes it anew");
}

/// The columns that a scene of `goes_together` is run through.
fn columns_of<'a>(text: &'a str, scene: &str) -> impl Iterator<Item = &'a str> {
    let list =
        text.split_once(&format!("    {scene} ")).and_then(|(_, rest)| rest.split_once(';')).map(|(list, _)| list);
    list.unwrap_or_default().split(|letter: char| !(letter.is_alphanumeric() || letter == '_'))
}

#[test]
fn tests_are_where_the_table_says() {
    let mut wrong = String::new();
    for Test { file, name } in every_cell().filter_map(|cell| cell.test) {
        let text = fs::read_to_string(repository().join(file)).unwrap_or_default();
        let is_there = match name.split_once("::") {
            Some((scene, column)) => columns_of(&text, scene).any(|name| name == column),
            None => ["fn", "def"].iter().any(|word| text.contains(&format!("{word} {name}("))),
        };
        if !is_there {
            writeln!(wrong, "{file} has no `{name}`").expect("a string");
        }
    }
    assert!(wrong.is_empty(), "\n{wrong}");
}

#[test]
fn every_cell_is_one_cell_of_the_table() {
    for row in &ROWS {
        let places: Vec<_> =
            row.cells.iter().map(|(name, _)| COLUMNS.iter().position(|(column, ..)| column == name)).collect();
        assert!(places.iter().all(Option::is_some) && places.is_sorted_by(|a, b| a < b), "{}: {places:?}", row.name);
    }
    assert!(every_cell().all(|cell| cell.kind != Kind::Shown || cell.test.is_some()));
}
