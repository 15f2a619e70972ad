//! Row of values that a run hands back.

use std::fmt::Display;
use std::marker::PhantomData;

use serde::Serialize;

/// A column of results, by which a run says what a value is: made by [`Declaration`](crate::Declaration).
#[derive(Debug)]
pub struct Column<T> {
    pub(crate) place: usize,
    of: PhantomData<fn(T)>,
}

impl<T> Clone for Column<T> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<T> Copy for Column<T> {}

impl<T> Column<T> {
    pub(crate) fn new(place: usize) -> Self {
        Self { place, of: PhantomData }
    }
}

/// Type of the values in a column.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Kind {
    /// Floating-point numbers.
    Number,
    /// Whole numbers.
    Integer,
    /// True or false.
    Flag,
    /// Words, best few different ones.
    Text,
}

/// A value of a result.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// A floating-point number.
    Number(f64),
    /// A whole number.
    Integer(i64),
    /// True or false.
    Flag(bool),
    /// Words.
    Text(String),
}

/// Types of values that columns can hold: `f64`, `i64`, `bool`, `String`.
pub trait ColumnType: sealed::Sealed + Into<Value> {
    #[doc(hidden)]
    const KIND: Kind;
}

mod sealed {
    pub trait Sealed {}
}

macro_rules! column_types {
    ($($of:ty => $kind:ident),*) => {$(
        impl sealed::Sealed for $of {}
        impl ColumnType for $of {
            const KIND: Kind = Kind::$kind;
        }
        impl From<$of> for Value {
            fn from(value: $of) -> Self {
                Self::$kind(value)
            }
        }
    )*};
}

column_types!(f64 => Number, i64 => Integer, bool => Flag, String => Text);

/// The results of one run: a value for each column or none, and why the run failed, if it did.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    pub(crate) values: Vec<Option<Value>>,
    pub(crate) cause: Option<String>,
}

impl Row {
    pub(crate) fn new(columns: usize) -> Self {
        Self { values: vec![None; columns], cause: None }
    }

    /// Writes a value; what is never written, as the time of an event that did not come, is a null in the file.
    ///
    /// # Panics
    /// When the column is another study's and this one has fewer.
    pub fn set<T: ColumnType>(&mut self, column: Column<T>, value: impl Into<T>) {
        self.values[column.place] = Some(value.into().into());
    }

    /// Says why the run failed; the first cause stays.
    pub fn fail(&mut self, cause: impl Display) {
        self.cause.get_or_insert_with(|| cause.to_string());
    }

    /// Why the run failed.
    #[must_use]
    pub fn cause(&self) -> Option<&str> {
        self.cause.as_deref()
    }

    /// A value, if it was written.
    #[must_use]
    pub fn get<T>(&self, column: Column<T>) -> Option<&Value> {
        self.values.get(column.place)?.as_ref()
    }

    /// The row as it is kept: numbers that are not finite are nulls, and a failure of the run.
    pub(crate) fn checked<'a>(&mut self, names: impl Iterator<Item = &'a str>) {
        for (value, name) in self.values.iter_mut().zip(names) {
            if let Some(Value::Number(number)) = value
                && !number.is_finite()
            {
                self.cause.get_or_insert_with(|| format!("`{name}` is {number}"));
                *value = None;
            }
        }
    }
}
