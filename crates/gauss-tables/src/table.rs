//! Runs as tables: named columns of numbers over time, printed as CSV.

use std::fmt;

use gauss_runtime::chart::Chart;
use gauss_runtime::configuration::{Configuration, VectorSpace};
use gauss_runtime::contact::ContactSystem;
use gauss_runtime::description::DescribedSystem;
use gauss_runtime::forces::ForcedSystem;
use gauss_runtime::integrate::{IntegrationError, Sample, Trajectory};
use gauss_runtime::real::Real;
use gauss_runtime::system::GaussSystem;

/// Tables of a run.
#[doc(alias = "csv")]
#[doc(alias = "plot")]
pub trait Tabulate<S: GaussSystem>: crate::sealed::Sealed {
    /// A table with a row for every sample, and the time as its first column.
    ///
    /// ```
    /// use gauss_runtime::prelude::*;
    /// use gauss_tables::Tabulate;
    ///
    /// #[derive(GaussDynamics)]
    /// #[gauss(
    ///     coordinates(angle),
    ///     particle(mass = 1, position = [sin(angle), 0, -cos(angle)]),
    ///     spring(bearing, along = angle, stiffness = 0, damping = 0.1),
    /// )]
    /// struct Pendulum {
    ///     #[gauss(gravity)] g: f64,
    /// }
    ///
    /// # fn main() -> Result<(), Box<dyn std::error::Error>> {
    /// let kernel = Pendulum { g: 9.81 }.kernel()?;
    /// let run = Simulation::new(&kernel).adaptive(1e-9, 1e-9).run(SVector::from([1.0]), SVector::from([0.0]), 0.0..10.0)?;
    /// let table = run
    ///     .table_at((0..=100).map(|n| 0.1 * f64::from(n)))?
    ///     .columns(["angle", "rate"], |s| [s.q[0], s.z[0]])
    ///     .energies(&kernel)
    ///     .powers(&kernel, |_t, _q, _z| ());
    /// # let folder = std::env::temp_dir();
    /// # std::fs::write(folder.join("gauss_table_example.csv"), table.to_string())?;
    /// # std::fs::remove_file(folder.join("gauss_table_example.csv"))?;
    /// assert!(table.to_string().starts_with("t,angle,rate,kinetic energy,potential energy,energy,gravity power,"));
    /// assert!(table.get("bearing power").is_some());
    /// let energy = table.get("energy").expect("is there");
    /// assert!(energy.len() == 101 && energy.windows(2).all(|pair| pair[1] <= pair[0] + 1e-9));
    /// # Ok(())
    /// # }
    /// ```
    #[must_use]
    fn table(&self) -> Table<S>;

    /// A table with a row for every given time, which is its first column.
    ///
    /// # Errors
    /// The error of [`Trajectory::at`] for the first time whose state cannot be computed.
    fn table_at(&self, times: impl IntoIterator<Item = S::Scalar>) -> Result<Table<S>, IntegrationError>;
}

impl<S: GaussSystem> crate::sealed::Sealed for Trajectory<'_, S> {}

impl<S: GaussSystem> crate::sealed::Sealed for Table<S> {}

impl<S: GaussSystem> Tabulate<S> for Trajectory<'_, S> {
    fn table(&self) -> Table<S> {
        Table::new(self.samples().to_vec())
    }

    fn table_at(&self, times: impl IntoIterator<Item = S::Scalar>) -> Result<Table<S>, IntegrationError> {
        self.at_times(times).map(Table::new)
    }
}

/// Named columns of numbers, a row for each of some states; of packs of numbers the first lane. As text it is CSV
/// (RFC 4180, with the names in the first line, and every digit that tells a number from its neighbours).
///
/// Columns have units where these were [given](Self::units) or are those of the [SI](Self::si); the heading of CSV is
/// then `angle / rad`. [`Export`](crate::Export) has other formats and plots.
#[doc(alias = "csv")]
#[doc(alias = "dataframe")]
pub struct Table<S: GaussSystem> {
    samples: Vec<Sample<S>>,
    columns: Vec<Stored>,
}

// Written by hand: deriving would ask the same of the system S, which is only named here.
impl<S: GaussSystem> Clone for Table<S> {
    fn clone(&self) -> Self {
        Self { samples: self.samples.clone(), columns: self.columns.clone() }
    }
}

impl<S: GaussSystem> fmt::Debug for Table<S> {
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
}

impl fmt::Display for Column<'_> {
    /// What stands at an axis and above a column: `angle / rad`, or the name alone.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.unit {
            Some(unit) if unit.contains(['/', ' ']) => write!(f, "{} / ({unit})", self.name),
            Some(unit) => write!(f, "{} / {unit}", self.name),
            None => f.write_str(self.name),
        }
    }
}

/// Units for names that no column has: all of these.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct UnknownColumns(pub Vec<String>);

impl fmt::Display for UnknownColumns {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "the table has no column `{}`", self.0.join("`, `"))
    }
}

impl std::error::Error for UnknownColumns {}

#[derive(Clone, Debug)]
struct Stored {
    name: String,
    unit: Option<String>,
    /// The unit in the SI, where the kind of column determines it; else empty.
    si: &'static str,
    values: Vec<f64>,
}

impl<S: GaussSystem> Table<S> {
    /// A table of states, with their times.
    #[must_use]
    pub fn new(samples: Vec<Sample<S>>) -> Self {
        Self { samples, columns: Vec::new() }.with([("t", "s")], |sample, put| put(sample.t))
    }

    /// One more column: a function of the state.
    #[must_use]
    pub fn column(self, name: &str, mut function: impl FnMut(&Sample<S>) -> S::Scalar) -> Self {
        self.columns([name], |sample| [function(sample)])
    }

    /// Several more columns.
    #[must_use]
    pub fn columns<const N: usize>(
        self,
        names: [&str; N],
        mut function: impl FnMut(&Sample<S>) -> [S::Scalar; N],
    ) -> Self {
        self.with(names.map(|name| (name, "")), |sample, put| function(sample).into_iter().for_each(put))
    }

    /// The numbers that the state consists of, under the names of coordinates and speeds. Of a rotation they are those
    /// of its quaternion (`turn_i`, `turn_j`, `turn_k`, `turn_w`), of a pose also the place (`craft_x`, `craft_y`,
    /// `craft_z`), in the plane `pose_cos`, `pose_sin`, `pose_x`, `pose_y`. A system that has [no
    /// names](DescribedSystem::COORDINATE_NAMES), as one written by hand, has `q1`, `q2`, … and `z1`, `z2`, ….
    #[must_use]
    pub fn state(self) -> Self
    where
        S: DescribedSystem,
    {
        let of_q = <<S::Configuration as Configuration>::Components as VectorSpace<S::Scalar>>::DIM;
        let named = |known: &'static [&'static str], letter: &'static str, count: usize| {
            let name = move |i: usize| known.get(i).map_or_else(|| format!("{letter}{}", i + 1), |&name| name.into());
            (0..count).map(name)
        };
        // Of quasi-velocities of bodies; what other speeds are is the scene's affair.
        let of_body = matches!(S::CHART, Chart::LeftInvariant | Chart::RightInvariant | Chart::Hybrid);
        let rate_unit = |i| if of_body { S::Configuration::rate_unit(i) } else { "" };
        let coordinates = named(S::COORDINATE_NAMES, "q", of_q).zip((0..of_q).map(S::Configuration::component_unit));
        let speeds = named(S::SPEED_NAMES, "z", S::Speeds::DIM).zip((0..S::Speeds::DIM).map(rate_unit));
        self.with(coordinates.chain(speeds), |sample, put| {
            let components = sample.q.components();
            (0..of_q).for_each(|i| put(components.component(i)));
            (0..S::Speeds::DIM).for_each(|i| put(sample.z.component(i)));
        })
    }

    /// The kinetic energy, the potential energy, and the two together.
    #[must_use]
    pub fn energies(self, system: &S) -> Self {
        self.with(["kinetic energy", "potential energy", "energy"].map(|name| (name, "J")), |sample, put| {
            let kinetic = system.kinetic_energy(sample.t, &sample.q, &sample.z);
            let potential = system.potential_energy(sample.t, &sample.q);
            [kinetic, potential, kinetic + potential].into_iter().for_each(put);
        })
    }

    /// The power of every element, `NAME power`, under the input that the run had.
    #[must_use]
    pub fn powers(self, system: &S, input: impl Fn(S::Scalar, &S::Configuration, &S::Speeds) -> S::Input) -> Self
    where
        S: ForcedSystem,
    {
        let names = S::ELEMENTS.iter().map(|element| (format!("{} power", element.name), "W"));
        self.with(names, |Sample { t, q, z, .. }, put| {
            let powers = system.powers(*t, q, z, &input(*t, q, z));
            (0..S::ELEMENTS.len()).for_each(|i| put(powers.component(i)));
        })
    }

    /// Gap, normal force, and of each tangent the slip and the friction of every contact: `NAME gap`, `NAME force`,
    /// `NAME slip`, `NAME friction`, of two tangents `NAME slip 1`, and so on, with friction of drilling `NAME spin`,
    /// `NAME drilling`; of dry friction and rolling resistance slips and friction alone. `forces` are all rows of
    /// contact forces at a state, such as those that a run with contacts has at its time; where they are unknown their
    /// columns are NaN.
    #[must_use]
    pub fn contacts(self, system: &S, forces: impl Fn(&Sample<S>) -> Option<S::ContactRows>) -> Self
    where
        S: ContactSystem,
    {
        let names = S::CONTACTS.iter().flat_map(|contact| {
            let drills = contact.drills;
            let drilling = ["spin", "drilling"].map(|what| format!("{} {what}", contact.name));
            let of_tangent = move |k: usize| if contact.tangents > 1 { format!(" {}", k + 1) } else { String::new() };
            let tangential = (0..contact.tangents).flat_map(move |k| {
                ["slip", "friction"].map(|what| format!("{} {what}{}", contact.name, of_tangent(k)))
            });
            let normal = ["gap", "force"].map(|what| format!("{} {what}", contact.name));
            let drilling = drilling.into_iter().filter(move |_| drills);
            normal.into_iter().filter(|_| contact.has_gap()).chain(tangential).chain(drilling)
        });
        self.with(names.map(|name| (name, "")), |sample, put| {
            let (gaps, rates) =
                (system.gaps(sample.t, &sample.q), system.contact_rates(sample.t, &sample.q, &sample.z));
            let forces = forces(sample);
            let force = |row: usize| forces.as_ref().map_or(S::Scalar::from_f64(f64::NAN), |rows| rows.component(row));
            for (i, contact) in S::CONTACTS.iter().enumerate() {
                if contact.has_gap() {
                    put(gaps.component(i));
                    put(force(contact.normal));
                }
                for row in contact.friction_rows() {
                    put(rates.component(row));
                    put(force(row));
                }
            }
        })
    }

    /// Columns of names with their units in the SI, to whose end each sample puts its numbers.
    fn with<N: Into<String>>(
        mut self,
        names: impl IntoIterator<Item = (N, &'static str)>,
        mut row: impl FnMut(&Sample<S>, &mut dyn FnMut(S::Scalar)),
    ) -> Self {
        let column = |(name, si): (N, _)| Stored { name: name.into(), unit: None, si, values: Vec::new() };
        let mut columns: Vec<Stored> = names.into_iter().map(column).collect();
        for sample in &self.samples {
            let mut places = columns.iter_mut();
            row(sample, &mut |number| {
                if let Some(column) = places.next() {
                    column.values.push(number.lane(0));
                }
            });
        }
        self.columns.extend(columns);
        self
    }

    /// Says in which units columns are, by their names: what headings and axes show. Nothing is converted.
    ///
    /// # Errors
    /// [`UnknownColumns`]: the names that no column has.
    pub fn units<'a>(mut self, units: impl IntoIterator<Item = (&'a str, &'a str)>) -> Result<Self, UnknownColumns> {
        let mut unknown = Vec::new();
        for (name, unit) in units {
            match self.columns.iter_mut().find(|column| column.name == name) {
                Some(column) => column.unit = Some(unit.into()),
                None => unknown.push(name.into()),
            }
        }
        if unknown.is_empty() { Ok(self) } else { Err(UnknownColumns(unknown)) }
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

    /// The states of its rows.
    #[must_use]
    pub fn samples(&self) -> &[Sample<S>] {
        &self.samples
    }

    /// The columns in order.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = Column<'_>> + Clone {
        self.columns.iter().map(|Stored { name, unit, values, .. }| Column { name, unit: unit.as_deref(), values })
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

impl<S: GaussSystem> fmt::Display for Table<S> {
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
        for row in 0..self.samples.len() {
            for (n, column) in self.iter().enumerate() {
                let comma = if n == 0 { "" } else { "," };
                write!(f, "{comma}{:?}", column.values[row])?;
            }
            f.write_str("\n")?;
        }
        Ok(())
    }
}
