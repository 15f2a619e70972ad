//! Rows by scene and method, and what changed between two tables.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::{self, Write as _};

use crate::counts::{KERNEL, Row, TOKENS};

const HEAD: &str = "scene,method,add,mul,div,sqrt,transcendental,chain";

/// Costs by scene, then method.
#[derive(Debug, Default)]
pub struct Table(BTreeMap<(String, String), Row>);

impl Table {
    pub fn add(&mut self, scene: &str, rows: Vec<(String, Row)>) {
        for (method, row) in rows {
            let before = self.0.insert((scene.into(), method), row);
            assert!(before.is_none(), "two scenes are called `{scene}`");
        }
    }

    pub fn to_csv(&self) -> String {
        let mut out = format!("{HEAD}\n");
        for ((scene, method), Row { operations: [add, mul, div, sqrt, calls], chain }) in &self.0 {
            writeln!(out, "{scene},{method},{add},{mul},{div},{sqrt},{calls},{chain}").expect("a string");
        }
        out
    }

    /// What [`Table::to_csv`] wrote; nothing if it did not.
    pub fn from_csv(text: &str) -> Option<Self> {
        let rows = text.lines().skip(1).map(|line| {
            let mut cells = line.split(',');
            let (scene, method) = (cells.next()?, cells.next()?);
            let numbers: Vec<u32> = cells.map(|cell| cell.parse().ok()).collect::<Option<_>>()?;
            let [add, mul, div, sqrt, calls, chain] = numbers.try_into().ok()?;
            Some(((scene.to_owned(), method.to_owned()), Row { operations: [add, mul, div, sqrt, calls], chain }))
        });
        Some(Self(rows.collect::<Option<_>>()?))
    }

    pub fn changes_to(&self, after: &Self) -> Changes {
        let mut changes = Changes::default();
        let scenes = |table: &Self| -> Vec<String> { table.0.keys().map(|(scene, _)| scene.clone()).collect() };
        let (known, found) = (scenes(self), scenes(after));
        let mut keys: Vec<_> = self.0.keys().chain(after.0.keys()).collect();
        keys.sort();
        keys.dedup();
        for key in keys {
            // A method that costs nothing has no row.
            let of = |table: &Self| table.0.get(key).copied().unwrap_or_default();
            let (before, now) = (of(self), of(after));
            let (scene, method) = (&key.0, &key.1);
            let line = format!("{scene}: {method} {}", Change { method, before, now });
            if found.binary_search(scene).is_err() {
                changes.scenes.insert(format!("{scene}: in the table alone"));
            } else if known.binary_search(scene).is_err() {
                changes.scenes.insert(format!("{scene}: not in the table"));
            } else if is_worse(method, before, now) {
                changes.worse.push(line);
            } else if before != now && !nearly(method) {
                changes.better.push(line);
            }
        }
        changes
    }
}

/// Figures of `kernel()` and of the text may change by a tenth: they cost a moment, once.
fn nearly(method: &str) -> bool {
    [KERNEL, TOKENS].contains(&method)
}

fn is_worse(method: &str, before: Row, now: Row) -> bool {
    let total = |row: Row| row.operations.iter().sum::<u32>();
    let dear = |row: Row| row.operations[2..].iter().sum::<u32>();
    if nearly(method) {
        // Small ones by ten operations.
        return total(now) > total(before) + (total(before) / 10).max(10);
    }
    total(now) > total(before) || dear(now) > dear(before) || now.chain > before.chain
}

/// What differs between two tables, a line a row.
#[derive(Debug, Default)]
pub struct Changes {
    worse: Vec<String>,
    better: Vec<String>,
    scenes: BTreeSet<String>,
}

impl Changes {
    pub fn is_empty(&self) -> bool {
        self.worse.is_empty() && self.better.is_empty() && self.scenes.is_empty()
    }
}

impl fmt::Display for Changes {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let scenes = self.scenes.iter().cloned().collect();
        for (title, lines) in [("better", &self.better), ("other scenes", &scenes), ("worse", &self.worse)] {
            if !lines.is_empty() {
                writeln!(f, "{title}: {}", lines.len())?;
                lines.iter().try_for_each(|line| writeln!(f, "  {line}"))?;
            }
        }
        Ok(())
    }
}

struct Change<'a> {
    method: &'a str,
    before: Row,
    now: Row,
}

impl fmt::Display for Change<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.method == TOKENS {
            return write!(f, "{} → {}", self.before.operations[0], self.now.operations[0]);
        }
        let written = |Row { operations: [add, mul, div, sqrt, calls], chain }: Row| {
            let mut text = format!("{add} + {mul}");
            for (count, sign) in [(div, "÷"), (sqrt, "√"), (calls, "f")] {
                if count > 0 {
                    text += &format!(" {count}{sign}");
                }
            }
            format!("{text} ({chain} cycles)")
        };
        write!(f, "{} → {}", written(self.before), written(self.now))
    }
}
