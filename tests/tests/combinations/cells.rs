//! Cells of the table: shown, refused, not built, or nothing that a test tells.

/// The knowledge of a combination.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// A test runs it.
    Shown,
    /// An error, or a message of the compiler, says why not.
    Refused,
    /// It works by its types, or seems to; no test runs it.
    Unshown,
    /// There is no such thing.
    Missing,
    /// Nothing is asked: what is done has no part of what the scene holds.
    Moot,
}

impl Kind {
    pub const ALL: [Self; 5] = [Self::Shown, Self::Refused, Self::Unshown, Self::Missing, Self::Moot];

    pub const fn symbol(self) -> &'static str {
        match self {
            Self::Shown => "✔",
            Self::Refused => "✗",
            Self::Unshown => "·",
            Self::Missing => "–",
            Self::Moot => "○",
        }
    }

    pub const fn words(self) -> &'static str {
        match self {
            Self::Shown => "a test runs it",
            Self::Refused => "refused, by an error or by the compiler",
            Self::Unshown => "not shown: types allow it, or seem to, and no test runs it",
            Self::Missing => "not built",
            Self::Moot => "nothing is asked",
        }
    }
}

/// A test, or an example of the guide that is compiled and run as one.
#[derive(Clone, Copy, PartialEq, Eq)]
pub struct Test {
    /// From the folder of the repository.
    pub file: &'static str,
    pub name: &'static str,
}

#[derive(Clone, Copy, PartialEq, Eq)]
pub struct Cell {
    pub kind: Kind,
    /// Why it is so, what is met instead; empty where the test says all.
    pub why: &'static str,
    /// The test that shows it, or its refusal.
    pub test: Option<Test>,
}

pub const UNSHOWN: Cell = Cell { kind: Kind::Unshown, why: "", test: None };

pub const fn shown(file: &'static str, name: &'static str) -> Cell {
    Cell { kind: Kind::Shown, test: Some(Test { file, name }), ..UNSHOWN }
}

/// A scene of `goes_together` with one of its columns.
pub const fn together(name: &'static str) -> Cell {
    shown("tests/tests/goes_together/main.rs", name)
}

pub const fn refused(why: &'static str) -> Cell {
    Cell { kind: Kind::Refused, why, ..UNSHOWN }
}

pub const fn missing(why: &'static str) -> Cell {
    Cell { kind: Kind::Missing, why, ..UNSHOWN }
}

pub const fn moot(why: &'static str) -> Cell {
    Cell { kind: Kind::Moot, why, ..UNSHOWN }
}

impl Cell {
    /// The test that shows a refusal.
    pub const fn by(self, file: &'static str, name: &'static str) -> Self {
        Self { test: Some(Test { file, name }), ..self }
    }

    pub const fn but(self, why: &'static str) -> Self {
        Self { why, ..self }
    }
}

/// A thing that a scene holds, with the columns of which something is known; of all others no test tells.
pub struct Row {
    pub name: &'static str,
    pub clause: &'static str,
    pub cells: &'static [(&'static str, Cell)],
}

/// The things done with a scene: letters at the head of the table, a name, and what it stands for.
pub const COLUMNS: [(&str, &str, &str); 22] = [
    ("fix", "steps of one length", "explicit methods: `Simulation::fixed_step`, `Fixed`, `Adams`"),
    ("ada", "adaptive steps", "`Simulation::adaptive`"),
    ("tay", "power series", "`Simulation::taylor`"),
    ("ros", "Rosenbrock", "stiff runs, with fixed and adaptive steps"),
    ("imp", "collocation", "`Collocation` and other methods that preserve structure"),
    ("evt", "contact by events", "`contact_events()` of a `Simulation`; the scene has contacts as well"),
    (
        "stp",
        "contact in steps",
        "`contact_steps(h)` of a `Simulation`, `ContactStepper`; the scene has contacts as well",
    ),
    (
        "one",
        "one step at a time",
        "`stepper` of a `Simulation`, in Python of a kernel; `OneStep::step` of a method, without a run",
    ),
    ("lan", "lanes", "several at once in packs: `Batch` of `gauss-batch`, `ContactLanes`"),
    ("thr", "threads", "many on all threads: `run_on_all_threads`, `ContactEnsemble`"),
    ("at", "between samples", "states at any time of a run: `at`"),
    ("tab", "table", "tables of `gauss-tables`"),
    ("plt", "plot", "pictures of such tables"),
    ("pag", "page", "pages of `gauss-playback`"),
    ("mon", "energy", "its balance: `power_balance`, `energy_balance`, `monitor`"),
    ("fwd", "derivatives forward", "of runs: in dual numbers, or by `gauss-sensitivity`"),
    ("adj", "derivatives backward", "of runs, by `gauss-sensitivity`"),
    ("lin", "derivatives at a state", "`linearize` of a kernel"),
    ("dst", "derivatives of a step", "`step_linearized`, `step_with_derivatives`"),
    ("run", "derivatives along a run", "those of steps, one after another"),
    ("stu", "study", "runs within a study of `gauss-study`"),
    ("py", "Python", "classes of `gauss-python`"),
];
