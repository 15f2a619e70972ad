//! Named columns of numbers with their units, printed as CSV.

use std::fmt;

use gauss_runtime::real::Real;

/// Named columns of numbers, a row for each of some things: states of a run ([`RunTable`](crate::RunTable)), records of
/// yours ([`of`](Self::of)), or nothing but the numbers ([`from_columns`](Table::from_columns)). As text it is CSV (RFC
/// 4180, with the names in the first line, and every digit that tells a number from its neighbours).
///
/// Columns have units where these were [given](Self::units) or are those of the [SI](Self::si); the heading of CSV is
/// then `angle / rad`. Other formats, and what a plot has in which panel, are methods as well.
///
/// ```
/// use gauss_tables::Table;
///
/// struct Shot { speed: f64, range: f64 }
/// let shots: Vec<Shot> = [10.0, 20.0].map(|speed| Shot { speed, range: speed * speed / 9.81 }).into();
/// let table = Table::of(shots).columns(["speed", "range"], |shot| [shot.speed, shot.range]);
/// let table = table.units([("speed", "m/s"), ("range", "m")])?;
/// assert!(table.to_string().starts_with("speed / (m/s),range / m\n10.0,"));
///
/// let same = Table::from_columns([("speed", vec![10.0, 20.0]), ("range", vec![10.2, 40.8])])?;
/// assert_eq!(same.select(["range"])?.get("range"), Some(&[10.2, 40.8][..]));
/// # Ok::<(), gauss_tables::ColumnError>(())
/// ```
#[derive(Clone)]
#[doc(alias = "csv")]
#[doc(alias = "dataframe")]
pub struct Table<Row = ()> {
    rows: Vec<Row>,
    length: usize,
    columns: Vec<Stored>,
    /// Names of columns for each panel of a plot; none: a panel for each unit.
    panels: Vec<Vec<String>>,
}

impl<Row> fmt::Debug for Table<Row> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_list().entries(self.iter()).finish()
    }
}

/// A column of a [`Table`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Column<'a> {
    /// Its name.
    pub name: &'a str,
    /// Its unit, `"1"` of pure numbers; nothing where none was given.
    pub unit: Option<&'a str>,
    /// A number for each row.
    pub values: &'a [f64],
    /// Whether a plot shows it as [points](Table::points) without lines.
    pub points: bool,
}

impl fmt::Display for Column<'_> {
    /// Label of an axis or a column: `angle / rad`, or the name alone.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.unit {
            Some(unit) if unit.contains(['/', ' ']) => write!(f, "{} / ({unit})", self.name),
            Some(unit) => write!(f, "{} / {unit}", self.name),
            None => f.write_str(self.name),
        }
    }
}

/// Mistakes in names or lengths of columns: all of one kind.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum ColumnError {
    /// Names that no column has.
    Unknown(Vec<String>),
    /// Columns, and how many numbers they have, of a table whose first column has another number of them.
    Unequal {
        /// Number of rows in the first column.
        rows: usize,
        /// The others, by name.
        columns: Vec<(String, usize)>,
    },
    /// Names that two columns have.
    Twice(Vec<String>),
    /// Axes that no sequence of Euler angles has: others than 0, 1, 2, or neighbours that are equal.
    Sequence([u8; 3]),
    /// Euler angles of a configuration among whose names there is no rotation.
    NoRotation,
}

impl fmt::Display for ColumnError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unknown(names) => write!(f, "the table has no column `{}`", names.join("`, `")),
            Self::Unequal { rows, columns } => {
                let told: Vec<_> = columns.iter().map(|(name, length)| format!("`{name}` {length}")).collect();
                write!(f, "columns are as long as the first one, which has {rows} numbers: {}", told.join(", "))
            }
            Self::Twice(names) => write!(f, "two columns are called `{}`", names.join("`, `")),
            Self::Sequence([a, b, c]) => write!(
                f,
                "Euler angles are about axes 0, 1 or 2, neighbours about different ones, and not about {a}, {b}, {c}"
            ),
            Self::NoRotation => f.write_str(
                "the configuration has no rotation or pose by name; `euler_angles_of` takes any rotation of a state",
            ),
        }
    }
}

impl std::error::Error for ColumnError {}

#[derive(Clone, Debug)]
struct Stored {
    name: String,
    unit: Option<String>,
    /// The unit in the SI, where the kind of column determines it; else empty.
    si: &'static str,
    values: Vec<f64>,
    /// A plot does not join its numbers.
    points: bool,
}

impl Stored {
    fn new(name: String, si: &'static str, values: Vec<f64>) -> Self {
        Self { name, unit: None, si, values, points: false }
    }
}

impl Table {
    /// Columns of numbers that are there already, all of one length: results of a study, of a filter, of a batch.
    ///
    /// # Errors
    /// [`ColumnError::Unequal`], [`ColumnError::Twice`].
    pub fn from_columns<N: Into<String>>(
        columns: impl IntoIterator<Item = (N, Vec<f64>)>,
    ) -> Result<Self, ColumnError> {
        let stored = |(name, values): (N, _)| Stored::new(name.into(), "", values);
        let columns: Vec<Stored> = columns.into_iter().map(stored).collect();
        let rows = columns.first().map_or(0, |column| column.values.len());
        let others = columns.iter().filter(|column| column.values.len() != rows);
        let unequal: Vec<_> = others.map(|column| (column.name.clone(), column.values.len())).collect();
        if !unequal.is_empty() {
            return Err(ColumnError::Unequal { rows, columns: unequal });
        }
        let is_second = |n: &usize| columns[..*n].iter().any(|earlier| earlier.name == columns[*n].name);
        let twice: Vec<_> = (0..columns.len()).filter(is_second).map(|n| columns[n].name.clone()).collect();
        if !twice.is_empty() {
            return Err(ColumnError::Twice(twice));
        }
        Ok(Self { rows: vec![(); rows], length: rows, columns, panels: Vec::new() })
    }
}

impl<Row> Table<Row> {
    /// A table with a row for each of these, and no columns yet.
    #[must_use]
    pub fn of(rows: Vec<Row>) -> Self {
        Self { length: rows.len(), rows, columns: Vec::new(), panels: Vec::new() }
    }

    /// One more column: a function of what its row is about. Of packs of numbers the first lane is taken.
    #[must_use]
    pub fn column<T: Real>(self, name: &str, mut function: impl FnMut(&Row) -> T) -> Self {
        self.columns([name], |row| [function(row)])
    }

    /// Several more columns.
    #[must_use]
    pub fn columns<T: Real, const N: usize>(self, names: [&str; N], mut function: impl FnMut(&Row) -> [T; N]) -> Self {
        self.with(names.map(|name| (name, "")), |row, put| {
            function(row).into_iter().for_each(|number| put(number.lane(0)));
        })
    }

    /// Columns of names with their units in the SI, to whose end each row puts its numbers.
    pub(crate) fn with<N: Into<String>>(
        mut self,
        names: impl IntoIterator<Item = (N, &'static str)>,
        mut numbers: impl FnMut(&Row, &mut dyn FnMut(f64)),
    ) -> Self {
        let column = |(name, si): (N, _)| Stored::new(name.into(), si, Vec::new());
        let mut columns: Vec<Stored> = names.into_iter().map(column).collect();
        for row in &self.rows {
            let mut places = columns.iter_mut();
            numbers(row, &mut |number| {
                if let Some(column) = places.next() {
                    column.values.push(number);
                }
            });
        }
        self.columns.extend(columns);
        self
    }

    /// Says in which units columns are, by their names: what headings and axes show. Nothing is converted.
    ///
    /// # Errors
    /// [`ColumnError::Unknown`]: the names that no column has.
    pub fn units<'a>(mut self, units: impl IntoIterator<Item = (&'a str, &'a str)>) -> Result<Self, ColumnError> {
        let mut unknown = Vec::new();
        for (name, unit) in units {
            match self.columns.iter_mut().find(|column| column.name == name) {
                Some(column) => column.unit = Some(unit.into()),
                None => unknown.push(name.into()),
            }
        }
        if unknown.is_empty() { Ok(self) } else { Err(ColumnError::Unknown(unknown)) }
    }

    /// Says that the scene is in units of the SI: those of time, energies and powers, of poses and rotations, and of
    /// the velocities of a body in a chart without coordinates are then known. The other columns, such as coordinates
    /// of your own, are left as they are.
    #[must_use]
    pub fn si(mut self) -> Self {
        for column in &mut self.columns {
            if !column.si.is_empty() {
                column.unit = Some(column.si.into());
            }
        }
        self
    }

    /// These columns in this order, and no others. A plot is over the first one.
    ///
    /// # Errors
    /// [`ColumnError::Unknown`]: the names that no column has.
    pub fn select<'a>(mut self, names: impl IntoIterator<Item = &'a str>) -> Result<Self, ColumnError> {
        let names: Vec<&str> = names.into_iter().collect();
        self.known(&names)?;
        let find = |name: &&str| self.columns.iter().find(|column| column.name == *name).cloned();
        self.columns = names.iter().filter_map(find).collect();
        self.panels.iter_mut().for_each(|panel| panel.retain(|name| names.contains(&name.as_str())));
        self.panels.retain(|panel| !panel.is_empty());
        Ok(self)
    }

    /// These columns in one panel of a plot, below those of the panels before; a plot then has no other panels than
    /// such ones. Columns of one panel have one unit.
    ///
    /// # Errors
    /// [`ColumnError::Unknown`]: the names that no column has.
    pub fn panel<'a>(mut self, names: impl IntoIterator<Item = &'a str>) -> Result<Self, ColumnError> {
        let names: Vec<&str> = names.into_iter().collect();
        self.known(&names)?;
        self.panels.push(names.into_iter().map(str::to_owned).collect());
        Ok(self)
    }

    /// These columns as points without lines in a plot, where the order of rows means nothing: results of a
    /// [study](https://docs.rs/gauss-study) over a random parameter, measurements, crossings of a section. The other
    /// columns stay lines, also those in the same panel. Files of other kinds are as they were.
    ///
    /// Of points in one pixel one is drawn, and of more than 5000 each is smaller.
    ///
    /// ```
    /// # fn main() -> Result<(), Box<dyn std::error::Error>> {
    /// use gauss_tables::Table;
    ///
    /// let angles: Vec<f64> = (0..500).map(|n| 0.3 + 0.9 * f64::from(n * 367 % 500) / 500.0).collect();
    /// let ranges = angles.iter().map(|angle| (2.0 * angle).sin() * 40.8).collect();
    /// let table = Table::from_columns([("angle", angles), ("range", ranges)])?.units([("angle", "rad"), ("range", "m")])?;
    /// let cloud = table.points(["range"])?;
    /// # #[cfg(feature = "plot")]
    /// assert_eq!(cloud.svg()?.matches("<circle").count(), 500);
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// # Errors
    /// [`ColumnError::Unknown`]: the names that no column has.
    #[doc(alias = "scatter")]
    pub fn points<'a>(mut self, names: impl IntoIterator<Item = &'a str>) -> Result<Self, ColumnError> {
        let names: Vec<&str> = names.into_iter().collect();
        self.known(&names)?;
        let named = self.columns.iter_mut().filter(|column| names.contains(&column.name.as_str()));
        named.for_each(|column| column.points = true);
        Ok(self)
    }

    fn known(&self, names: &[&str]) -> Result<(), ColumnError> {
        let is_unknown = |name: &&&str| !self.columns.iter().any(|column| column.name == **name);
        let unknown: Vec<String> = names.iter().filter(is_unknown).map(|name| (*name).to_owned()).collect();
        if unknown.is_empty() { Ok(()) } else { Err(ColumnError::Unknown(unknown)) }
    }

    /// The panels of a plot, by names of columns; none: a panel for each unit.
    #[cfg(feature = "plot")]
    pub(crate) fn panels(&self) -> &[Vec<String>] {
        &self.panels
    }

    /// Returns the states or instants that its rows are about.
    #[must_use]
    pub fn rows(&self) -> &[Row] {
        &self.rows
    }

    /// Number of its rows.
    #[must_use]
    pub fn len(&self) -> usize {
        self.length
    }

    /// Whether it has no rows.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.length == 0
    }

    /// The columns alone, for functions over every table.
    #[must_use]
    pub fn without_rows(self) -> Table {
        Table { rows: vec![(); self.length], length: self.length, columns: self.columns, panels: self.panels }
    }

    /// The columns in order.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = Column<'_>> + Clone {
        self.columns.iter().map(|Stored { name, unit, values, points, .. }| Column {
            name,
            unit: unit.as_deref(),
            values,
            points: *points,
        })
    }

    /// The names of the columns.
    pub fn names(&self) -> impl ExactSizeIterator<Item = &str> {
        self.iter().map(|column| column.name)
    }

    /// The column of a name.
    #[must_use]
    pub fn get(&self, name: &str) -> Option<&[f64]> {
        self.iter().find(|column| column.name == name).map(|column| column.values)
    }
}

impl<Row> fmt::Display for Table<Row> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (n, column) in self.iter().enumerate() {
            let (comma, heading) = (if n == 0 { "" } else { "," }, column.to_string());
            if heading.contains([',', '"', '\n', '\r']) {
                write!(f, "{comma}\"{}\"", heading.replace('"', "\"\""))?;
            } else {
                write!(f, "{comma}{heading}")?;
            }
        }
        f.write_str("\n")?;
        for row in 0..self.length {
            for (n, column) in self.iter().enumerate() {
                let comma = if n == 0 { "" } else { "," };
                write!(f, "{comma}{:?}", column.values[row])?;
            }
            f.write_str("\n")?;
        }
        Ok(())
    }
}
