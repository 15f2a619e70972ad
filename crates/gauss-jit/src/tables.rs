//! Tables at run time: the arrays that hold the numbers of a model's tables, by the names of their constants.

use std::sync::Arc;

use gauss_codegen::parameters::{Interpolation, TableClause};
use gauss_codegen::program::{MOST_VARIABLES, OwnFunction};
use gauss_runtime::table::{Joined, Table, TableFault};

use crate::error::TableMistake;

/// An array by the name of its constant: its axes, and its numbers row after row.
pub type Array<'a> = (&'a str, &'a [usize], &'a [f64]);

/// The tables of a model, by the index that programs call each by.
#[derive(Clone, Debug, Default)]
pub struct Tables {
    list: Vec<Option<Arc<Table>>>,
}

impl Tables {
    /// The tables of a model made of these arrays.
    ///
    /// # Errors
    /// Every array that is not as the model has it.
    pub(crate) fn of(declared: &[Option<TableClause>], arrays: &[Array<'_>]) -> Result<Self, Vec<TableMistake>> {
        let mut mistakes = named(declared, arrays);
        let list = declared.iter().map(|table| {
            let table = table.as_ref()?;
            match made(table, arrays) {
                Ok(table) => table.map(Arc::new),
                Err(found) => {
                    // Tables may share an axis.
                    for mistake in found {
                        if !mistakes.contains(&mistake) {
                            mistakes.push(mistake);
                        }
                    }
                    None
                }
            }
        });
        let list = list.collect();
        if mistakes.is_empty() { Ok(Self { list }) } else { Err(mistakes) }
    }

    /// The value of a table that a program calls, or the derivative of it, as the program says; none where its numbers
    /// were not given. Arguments behind its variables are left out.
    pub fn value(&self, function: OwnFunction, arguments: [f64; MOST_VARIABLES]) -> Option<f64> {
        self.get(function).map(|table| table.at(function.orders, arguments))
    }

    /// The table that a program calls; none where its numbers were not given.
    pub(crate) fn get(&self, function: OwnFunction) -> Option<&Arc<Table>> {
        self.list.get(usize::from(function.index))?.as_ref()
    }

    /// Whether all that are declared are there.
    pub(crate) fn has_all(&self, declared: &[Option<TableClause>]) -> bool {
        declared.iter().enumerate().all(|(k, table)| table.is_none() || self.list.get(k).is_some_and(Option::is_some))
    }
}

/// The constants that a table has its numbers in.
pub fn constants(table: &TableClause) -> impl Iterator<Item = &String> {
    table.axes.iter().chain([&table.values])
}

/// Names that are missing, given twice, or of no table.
fn named(declared: &[Option<TableClause>], arrays: &[Array<'_>]) -> Vec<TableMistake> {
    let mut known: Vec<String> = Vec::new();
    for name in declared.iter().flatten().flat_map(constants) {
        if !known.contains(name) {
            known.push(name.clone());
        }
    }
    let is_unknown = |name: &str| known.iter().all(|own| own != name);
    let unknown = arrays.iter().map(|(name, ..)| *name).filter(|name| is_unknown(name));
    let unknown = unknown.map(|name| TableMistake::Unknown { name: name.to_owned(), known: known.clone() });
    let mut mistakes: Vec<TableMistake> = unknown.collect();
    for name in &known {
        match arrays.iter().filter(|(own, ..)| own == name).count() {
            0 => mistakes.push(TableMistake::Missing(name.clone())),
            1 => {}
            _ => mistakes.push(TableMistake::Repeated(name.clone())),
        }
    }
    mistakes
}

/// The table of the arrays that have the names of its constants; none where one is missing.
fn made(table: &TableClause, arrays: &[Array<'_>]) -> Result<Option<Table>, Vec<TableMistake>> {
    let given: Option<Vec<Array<'_>>> =
        constants(table).map(|name| arrays.iter().find(|(own, ..)| own == name).copied()).collect();
    let Some(given) = given else { return Ok(None) };
    let Some(((_, shape, numbers), axes)) = given.split_last() else { return Ok(None) };
    let mut mistakes = Vec::new();
    let mut compare = |(name, found, numbers): Array<'_>, expected: &[Option<usize>]| {
        let fits =
            found.len() == expected.len() && found.iter().zip(expected).all(|(n, own)| own.is_none_or(|m| m == *n));
        if !fits || found.iter().product::<usize>() != numbers.len() {
            let (name, expected, found) = (name.to_owned(), expected.to_vec(), found.to_vec());
            mistakes.push(TableMistake::Shape { name, expected, found });
        }
    };
    axes.iter().for_each(|axis| compare(*axis, &[None]));
    let lengths: Vec<Option<usize>> = axes.iter().map(|(_, _, numbers)| Some(numbers.len())).collect();
    let expected = if axes.is_empty() { vec![None, Some(2)] } else { lengths };
    compare((&table.values, shape, numbers), &expected);
    if !mistakes.is_empty() {
        return Err(mistakes);
    }
    let joined = match table.joined {
        Interpolation::Linear => Joined::Linear,
        Interpolation::Hermite => Joined::Hermite,
        Interpolation::Cubic => Joined::Cubic,
    };
    let made = if axes.is_empty() {
        Table::through(numbers.as_chunks::<2>().0, joined)
    } else {
        Table::on_grid(&axes.iter().map(|(_, _, numbers)| *numbers).collect::<Vec<_>>(), numbers, joined)
    };
    let of_fault = |fault: TableFault| {
        let own = match fault {
            TableFault::Short { axis, .. } | TableFault::Order { axis, .. } => table.axes.get(axis),
            TableFault::NotFinite { axis: Some(axis), .. } => table.axes.get(axis),
            _ => None,
        };
        TableMistake::Fault { name: own.unwrap_or(&table.values).clone(), fault }
    };
    made.map(Some).map_err(|faults| faults.into_iter().map(of_fault).collect())
}
