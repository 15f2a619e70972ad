//! Outcome of a run, in numbers.

use gauss_runtime::contact::Contact;
use gauss_runtime::integrate::Summary;
use gauss_runtime::prelude::*;

use super::request::Request;
use super::watching::Moving;
use super::{components, numbers_of};

/// A run with its states, column by column: time, the numbers of q and z, kinetic and potential energy, and of contacts
/// what [`column_names`] has.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// The columns, one after the other.
    pub columns: Vec<f64>,
    /// Number of states.
    pub rows: usize,
    /// The last state: time, and the numbers of q and z.
    pub last: Vec<f64>,
    /// Events in the order in which they happened, the end of the run not among them.
    pub events: Vec<Event>,
    /// The end that it came to before its time, by its number among the ends.
    pub stopped_by: Option<usize>,
    /// Its steps.
    pub summary: Summary,
    /// Account of the contacts; none of runs that leave them out.
    pub touched: Option<Touched>,
    /// Why it did not reach its end.
    pub error: Option<String>,
    /// It was told to stop.
    pub interrupted: bool,
}

/// A state in which something happened.
#[derive(Clone, Debug, PartialEq)]
pub struct Event {
    /// Which, of those that do not end the run.
    pub number: usize,
    /// Time, and the numbers of q and z.
    pub row: Vec<f64>,
}

/// Names of the events at a contact.
pub const KINDS: [&str; 7] = ["impact", "closes", "rests", "leaves", "sticks", "slides", "reverses"];

/// Account of the contacts in a run.
#[derive(Clone, Debug, Default)]
pub struct Touched {
    /// Changes of contacts, in order of time.
    pub happened: Vec<Happening>,
    /// Measures of how well the laws were kept, and in steps of what became of gaps.
    pub report: Vec<(String, f64)>,
    /// Spans in which open gaps were looked at by samples alone: the contact, from when to when.
    pub sampled: Vec<(usize, f64, f64)>,
}

/// A change of a contact.
#[derive(Clone, Debug, PartialEq)]
pub struct Happening {
    /// When.
    pub time: f64,
    /// Which contact.
    pub contact: usize,
    /// Kind, by its place in [`KINDS`].
    pub kind: usize,
    /// Numbers of an impact: rates before and after it and the impulse, row by row, then the energy that it takes away.
    pub impact: Vec<f64>,
}

/// The names of the columns of contacts, as tables of Rust have them.
pub fn column_names(contacts: &[Contact]) -> Vec<String> {
    let of = |contact: &Contact| {
        let tangents = (1..=contact.tangents).flat_map(|k| {
            let number = if contact.tangents > 1 { format!(" {k}") } else { String::new() };
            ["slip", "friction"].map(|what| format!("{what}{number}"))
        });
        let of_normal = ["gap", "force"].map(str::to_owned).into_iter().filter(|_| contact.has_gap());
        let of_drilling = ["spin", "drilling"].map(str::to_owned).into_iter().filter(|_| contact.drills);
        let all = of_normal.chain(tangents).chain(of_drilling);
        all.map(|what| format!("{} {what}", contact.name)).collect::<Vec<_>>()
    };
    contacts.iter().flat_map(of).collect()
}

/// Acceleration at a state, with modes and forces of the contacts.
#[derive(Clone, Debug)]
pub struct InContact {
    /// The rates of the speeds.
    pub acceleration: Vec<f64>,
    /// Mode of each contact.
    pub modes: Vec<&'static str>,
    /// All rows.
    pub forces: Vec<f64>,
}

/// Events that do not end the run.
pub(super) fn happened<'s, S: Moving + 's>(
    request: &Request<'_>,
    events: impl Iterator<Item = (usize, &'s Sample<S>)>,
) -> Vec<Event> {
    let goes_on = events.filter(|(number, _)| request.until.get(*number).is_some_and(|until| !until.ends()));
    goes_on.map(|(number, Sample { t, q, z, .. })| Event { number, row: row(*t, q, z) }).collect()
}

/// The number among the ends.
pub(super) fn number_of_end(request: &Request<'_>, number: usize) -> usize {
    request.until[..number].iter().filter(|until| until.ends()).count()
}

/// Time and the numbers of q and z.
pub(super) fn row<Q: Configuration<Scalar = f64>, Z: VectorSpace<f64>>(t: f64, q: &Q, z: &Z) -> Vec<f64> {
    [vec![t], numbers_of(q), components(z)].concat()
}

/// Kinetic and potential energy.
pub(super) fn energies<S: Moving>(system: &S, Sample { t, q, z, .. }: &Sample<S>) -> Vec<f64> {
    vec![system.kinetic_energy(*t, q, z), system.potential_energy(*t, q)]
}

/// Columns from rows of one length.
pub(super) fn columns(rows: impl ExactSizeIterator<Item = Vec<f64>>) -> Vec<f64> {
    let count = rows.len();
    let mut columns = Vec::new();
    for (n, row) in rows.enumerate() {
        columns.resize(row.len() * count, 0.0);
        row.into_iter().enumerate().for_each(|(column, number)| columns[column * count + n] = number);
    }
    columns
}
