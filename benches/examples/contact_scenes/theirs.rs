//! The same scenes in other programs, through Python: a line asks, a line answers.

use std::cell::RefCell;
use std::io::{BufRead, BufReader, Write};
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};
use std::rc::Rc;

use serde_json::{Value, json};

use crate::contest::{Contest, Outcome, Quality};

const PROGRAM: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/peers/contact_scenes.py");

/// A running Python.
pub struct Python {
    child: Child,
    questions: ChildStdin,
    answers: BufReader<ChildStdout>,
}

impl Python {
    /// Starts `python` with the scenes, and returns it with the names of the programs that it has for each of them.
    ///
    /// # Errors
    /// Where it does not start, or ends.
    pub fn start(python: &str, scenes: &[Value]) -> Outcome<(Self, Vec<Vec<String>>)> {
        let child = Command::new(python).arg(PROGRAM).stdin(Stdio::piped()).stdout(Stdio::piped()).spawn();
        let mut child = child.map_err(|error| format!("`{python}` does not start as a Python: {error}"))?;
        let (questions, answers) = (child.stdin.take().ok_or("no stdin")?, child.stdout.take().ok_or("no stdout")?);
        let mut python = Self { child, questions, answers: BufReader::new(answers) };
        let names = serde_json::from_value(python.ask(&json!(scenes))?)?;
        Ok((python, names))
    }

    fn ask(&mut self, question: &Value) -> Outcome<Value> {
        writeln!(self.questions, "{question}")?;
        self.questions.flush()?;
        let mut answer = String::new();
        if self.answers.read_line(&mut answer)? == 0 {
            return Err(format!("{PROGRAM} ended: {}", self.child.wait()?).into());
        }
        Ok(serde_json::from_str(&answer)?)
    }
}

/// One program in one scene.
pub struct Theirs {
    python: Rc<RefCell<Python>>,
    scene: usize,
    number: usize,
    name: String,
}

impl Theirs {
    /// By the numbers of scene and program.
    pub fn new(python: &Rc<RefCell<Python>>, scene: usize, number: usize, name: &str) -> Self {
        Self { python: Rc::clone(python), scene, number, name: name.into() }
    }

    fn ask(&self, what: &str, batch: usize) -> Outcome<Value> {
        self.python.borrow_mut().ask(&json!([self.scene, self.number, what, batch]))
    }
}

impl Contest for Theirs {
    fn name(&self) -> String {
        self.name.clone()
    }

    fn restart(&mut self) -> Outcome<()> {
        self.ask("restart", 0).map(|_| ())
    }

    fn batch(&mut self, number: usize) -> Outcome<f64> {
        Ok(self.ask("batch", number)?.as_f64().ok_or("no time")?)
    }

    fn quality(&mut self) -> Outcome<Quality> {
        let answer = self.ask("quality", 0)?;
        let number = |name: &str| answer[name].as_f64();
        Ok(Quality {
            lowest: number("lowest").ok_or("no gap")?,
            creep: number("creep").ok_or("no creep")?,
            unaccounted: number("unaccounted"),
            way: number("way").ok_or("no way")?,
            solves: None,
        })
    }
}
