//! Runs as tables: named columns of numbers over time, printed as CSV.

use core::fmt;

use alloc::string::String;
use alloc::vec::Vec;
use alloc::{format, vec};

use crate::configuration::{Configuration, VectorSpace};
use crate::description::Described;
use crate::forces::ForcedSystem;
use crate::integrate::drive::trajectory::Trajectory;
use crate::integrate::problem::error::IntegrationError;
use crate::integrate::problem::state::Sample;
use crate::real::Real;
use crate::system::GaussSystem;

impl<S: GaussSystem> Trajectory<'_, S> {
    /// A table with a row for every sample, and the time as its first column.
    ///
    #[cfg_attr(
        feature = "derive",
        doc = r##"
```
use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
#[gauss(
    coordinates(angle),
    particle(mass = 1, position = [sin(angle), 0, -cos(angle)]),
    spring(bearing, along = angle, stiffness = 0, damping = 0.1),
)]
struct Pendulum {
    #[gauss(gravity)] g: f64,
}

# fn main() -> Result<(), Box<dyn std::error::Error>> {
let kernel = Pendulum { g: 9.81 }.kernel()?;
let run = Simulation::new(&kernel).adaptive(1e-9, 1e-9).run(SVector::from([1.0]), SVector::from([0.0]), 0.0..10.0)?;
let table = run
    .table_at((0..=100).map(|n| 0.1 * f64::from(n)))?
    .columns(["angle", "rate"], |s| [s.q[0], s.z[0]])
    .energies(&kernel)
    .powers(&kernel, |_t, _q, _z| ());
# let folder = std::env::temp_dir();
# std::fs::write(folder.join("gauss_table_example.csv"), table.to_string())?;
# std::fs::remove_file(folder.join("gauss_table_example.csv"))?;
assert!(table.to_string().starts_with("t,angle,rate,kinetic energy,potential energy,energy,gravity power,"));
assert!(table.get("bearing power").is_some());
let energy = table.get("energy").expect("is there");
assert!(energy.len() == 101 && energy.windows(2).all(|pair| pair[1] <= pair[0] + 1e-9));
# Ok(())
# }
```
"##
    )]
    #[must_use]
    pub fn table(&self) -> Table<S> {
        Table::new(self.samples().to_vec())
    }

    /// A table with a row for every given time, which is its first column.
    ///
    /// # Errors
    /// What [`at`](Self::at) says of the first time that is not to be had.
    pub fn table_at(&self, times: impl IntoIterator<Item = S::Scalar>) -> Result<Table<S>, IntegrationError> {
        self.at_times(times).map(Table::new)
    }
}

/// Named columns of numbers, a row for each of some states; of packs of numbers the first lane. As text it is CSV
/// (RFC 4180, with the names in the first line, and every digit that tells a number from its neighbours).
#[derive(Clone, Debug)]
pub struct Table<S: GaussSystem> {
    samples: Vec<Sample<S>>,
    names: Vec<String>,
    columns: Vec<Vec<f64>>,
}

impl<S: GaussSystem> Table<S> {
    /// A table of states, with their times.
    #[must_use]
    pub fn new(samples: Vec<Sample<S>>) -> Self {
        Self { samples, names: Vec::new(), columns: Vec::new() }.column("t", |sample| sample.t)
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
        self.with(names.map(String::from).to_vec(), |sample, put| function(sample).into_iter().for_each(put))
    }

    /// The numbers that the state consists of, under the names of coordinates and speeds. Of a rotation they are those of its
    /// quaternion (`turn_i`, `turn_j`, `turn_k`, `turn_w`), of a pose also the place (`craft_x`, `craft_y`, `craft_z`), in the
    /// plane `pose_cos`, `pose_sin`, `pose_x`, `pose_y`. A system that has [no names](Described::COORDINATE_NAMES), as one written
    /// by hand, has `q1`, `q2`, … and `z1`, `z2`, ….
    #[must_use]
    pub fn state(self) -> Self
    where
        S: Described,
    {
        let of_q = <<S::Configuration as Configuration>::Components as VectorSpace<S::Scalar>>::DIM;
        let named = |known: &'static [&'static str], letter: &'static str, count: usize| {
            let name = move |i: usize| known.get(i).map_or_else(|| format!("{letter}{}", i + 1), |&name| name.into());
            (0..count).map(name)
        };
        let names = named(S::COORDINATE_NAMES, "q", of_q).chain(named(S::SPEED_NAMES, "z", S::Speeds::DIM));
        self.with(names.collect(), |sample, put| {
            let components = sample.q.components();
            (0..of_q).for_each(|i| put(components.component(i)));
            (0..S::Speeds::DIM).for_each(|i| put(sample.z.component(i)));
        })
    }

    /// The kinetic energy, the potential energy, and the two together.
    #[must_use]
    pub fn energies(self, system: &S) -> Self {
        self.columns(["kinetic energy", "potential energy", "energy"], |sample| {
            let kinetic = system.kinetic_energy(sample.t, &sample.q, &sample.z);
            let potential = system.potential_energy(sample.t, &sample.q);
            [kinetic, potential, kinetic + potential]
        })
    }

    /// The power of every element, `NAME power`, under the input that the run had.
    #[must_use]
    pub fn powers(self, system: &S, input: impl Fn(S::Scalar, &S::Configuration, &S::Speeds) -> S::Input) -> Self
    where
        S: ForcedSystem,
    {
        let names = S::ELEMENTS.iter().map(|element| format!("{} power", element.name)).collect();
        self.with(names, |Sample { t, q, z, .. }, put| {
            let powers = system.powers(*t, q, z, &input(*t, q, z));
            (0..S::ELEMENTS.len()).for_each(|i| put(powers.component(i)));
        })
    }

    /// Columns of names, to whose end each sample puts its numbers.
    fn with(mut self, names: Vec<String>, mut row: impl FnMut(&Sample<S>, &mut dyn FnMut(S::Scalar))) -> Self {
        let mut columns = vec![Vec::with_capacity(self.samples.len()); names.len()];
        for sample in &self.samples {
            let mut places = columns.iter_mut();
            row(sample, &mut |number| {
                if let Some(column) = places.next() {
                    column.push(number.lane(0));
                }
            });
        }
        self.names.extend(names);
        self.columns.extend(columns);
        self
    }

    /// The states of its rows.
    #[must_use]
    pub fn samples(&self) -> &[Sample<S>] {
        &self.samples
    }

    /// The names of the columns.
    pub fn names(&self) -> impl ExactSizeIterator<Item = &str> {
        self.names.iter().map(String::as_str)
    }

    /// The column of a name.
    #[must_use]
    pub fn get(&self, name: &str) -> Option<&[f64]> {
        let column = self.names.iter().position(|known| known == name)?;
        Some(&self.columns[column])
    }
}

impl<S: GaussSystem> fmt::Display for Table<S> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (n, name) in self.names.iter().enumerate() {
            let comma = if n == 0 { "" } else { "," };
            if name.contains([',', '"', '\n', '\r']) {
                write!(f, "{comma}\"{}\"", name.replace('"', "\"\""))?;
            } else {
                write!(f, "{comma}{name}")?;
            }
        }
        f.write_str("\n")?;
        for row in 0..self.samples.len() {
            for (n, column) in self.columns.iter().enumerate() {
                let comma = if n == 0 { "" } else { "," };
                write!(f, "{comma}{:?}", column[row])?;
            }
            f.write_str("\n")?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::SVector;
    use std::string::ToString;

    use crate::integrate::Simulation;
    use crate::testing::oscillator::{Oscillator, Viscous};

    type One = SVector<f64, 1>;

    impl Described for Oscillator<Viscous> {}

    #[test]
    fn columns_have_names_and_csv_reads_back() {
        let system = Oscillator::<Viscous>::new(0.0);
        let (q, z) = (One::from([1.0]), One::from([0.0]));
        let push = |t: f64, _: &One, _: &One| t.sin();
        let run = Simulation::new(&system).input(push).adaptive(1e-10, 1e-10).run(q, z, 0.0..3.0).expect("runs");
        let table = run.table_at([0.0, 0.125, 1e-17, 3.0]).expect("inside");
        let table = table.state().energies(&system).powers(&system, push).column("a, \"b\"", |s| s.q[0] / 0.0);
        let text = table.to_string();
        let mut lines = text.lines();
        let heading =
            "t,q1,z1,kinetic energy,potential energy,energy,spring power,law power,drive power,\"a, \"\"b\"\"\"";
        assert_eq!(lines.next(), Some(heading));
        let times = table.get("t").expect("is there");
        assert_eq!((times, table.names().len(), table.get("nothing")), (&[0.0, 0.125, 1e-17, 3.0][..], 10, None));
        for (row, line) in lines.enumerate() {
            let numbers: Vec<f64> = line.split(',').map(|word| word.parse().expect("a number")).collect();
            let sample = &table.samples()[row];
            assert_eq!(numbers[..3], [sample.t, sample.q[0], sample.z[0]]);
            assert_eq!(numbers[8], sample.t.sin() * sample.z[0]);
            assert_eq!(numbers[9], f64::INFINITY);
        }
        assert_eq!(run.table().samples().len(), run.len());
        assert!(run.table_at([0.5, 3.5]).is_err());
    }
}
