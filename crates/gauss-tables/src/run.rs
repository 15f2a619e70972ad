//! Tables of runs: columns that follow from states.

use gauss_runtime::chart::rotation::coordinates_of_rotation;
use gauss_runtime::chart::{Chart, EulerSequence, RotationChart};
use gauss_runtime::configuration::{Configuration, VectorSpace};
use gauss_runtime::contact::ContactSystem;
use gauss_runtime::description::DescribedSystem;
use gauss_runtime::forces::ForcedSystem;
use gauss_runtime::integrate::{RunRecord, Sample};
use gauss_runtime::nalgebra::{Quaternion, UnitQuaternion};
use gauss_runtime::real::Real;
use gauss_runtime::system::GaussSystem;

use crate::table::{ColumnError, Table};

/// A table whose rows are states of a system S: what a run is tabulated as.
pub type RunTable<S> = Table<Sample<S>>;

/// Tables of the record of a run: of a [`Trajectory`](gauss_runtime::integrate::Trajectory), and of runs with contacts,
/// from event to event and in steps.
#[doc(alias = "csv")]
#[doc(alias = "plot")]
pub trait Tabulate<S: GaussSystem>: RunRecord<S> {
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
    fn table(&self) -> RunTable<S>;

    /// A table with a row for every given time, which is its first column.
    ///
    /// # Errors
    /// The error of [`state_at`](RunRecord::state_at) for the first time whose state cannot be found.
    fn table_at(&self, times: impl IntoIterator<Item = S::Scalar>) -> Result<RunTable<S>, Self::Error>;
}

impl<S: GaussSystem, R: RunRecord<S> + ?Sized> Tabulate<S> for R {
    fn table(&self) -> RunTable<S> {
        Table::new(self.states())
    }

    fn table_at(&self, times: impl IntoIterator<Item = S::Scalar>) -> Result<RunTable<S>, Self::Error> {
        times.into_iter().map(|t| self.state_at(t)).collect::<Result<_, _>>().map(Table::new)
    }
}

impl<S: GaussSystem> Table<Sample<S>> {
    /// A table of states, with their times.
    #[must_use]
    pub fn new(samples: Vec<Sample<S>>) -> Self {
        Self::of(samples).with([("t", "s")], |sample, put| put(sample.t.lane(0)))
    }

    /// The states of its rows.
    #[must_use]
    pub fn samples(&self) -> &[Sample<S>] {
        self.rows()
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
            (0..of_q).for_each(|i| put(components.component(i).lane(0)));
            (0..S::Speeds::DIM).for_each(|i| put(sample.z.component(i).lane(0)));
        })
    }

    /// The kinetic energy, the potential energy, and the two together.
    #[must_use]
    pub fn energies(self, system: &S) -> Self {
        self.with(["kinetic energy", "potential energy", "energy"].map(|name| (name, "J")), |sample, put| {
            let kinetic = system.kinetic_energy(sample.t, &sample.q, &sample.z);
            let potential = system.potential_energy(sample.t, &sample.q);
            [kinetic, potential, kinetic + potential].into_iter().for_each(|energy| put(energy.lane(0)));
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
            (0..S::ELEMENTS.len()).for_each(|i| put(powers.component(i).lane(0)));
        })
    }

    /// Gap, normal force, and of each tangent the slip and the friction of every contact: `NAME gap`, `NAME force`,
    /// `NAME slip`, `NAME friction`, of two tangents `NAME slip 1`, and so on, with friction of drilling `NAME spin`,
    /// `NAME drilling`; of dry friction and rolling resistance slips and friction alone. `forces` are all rows of
    /// contact forces at a state, such as those that a run with contacts has at its time, `|s|
    /// Some(*run.forces(s.t).ok()?)`; where they are unknown their columns are NaN.
    #[must_use]
    pub fn contacts(self, system: &S, forces: impl Fn(&Sample<S>) -> Option<S::ContactRows>) -> Self
    where
        S: ContactSystem,
    {
        let names = system.contacts().iter().flat_map(|contact| {
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
            let force = |row: usize| forces.as_ref().map_or(f64::NAN, |rows| rows.component(row).lane(0));
            for (i, contact) in system.contacts().iter().enumerate() {
                if contact.has_gap() {
                    put(gaps.component(i).lane(0));
                    put(force(contact.normal));
                }
                for row in contact.friction_rows() {
                    put(rates.component(row).lane(0));
                    put(force(row));
                }
            }
        })
    }

    /// The Euler angles of every rotation of the configuration, in radians: of a rotation or pose `craft` in the order
    /// of the sequence `craft_yaw`, `craft_pitch`, `craft_roll` ([`EulerSequence::ZYX`]), `craft_precession`,
    /// `craft_nutation`, `craft_spin` ([`EulerSequence::ZXZ`]), of others `craft_angle_1`, …; of a pose in the plane
    /// `craft_angle`. They jump by a turn at ±π; where the sequence is singular they are NaN, a gap in a plot.
    ///
    /// Rotations are found by the [names](DescribedSystem::COORDINATE_NAMES) of a scene; others, such as those of
    /// frames, are tabulated by [`euler_angles_of`](Self::euler_angles_of).
    ///
    /// # Errors
    /// [`ColumnError::Sequence`], [`ColumnError::NoRotation`].
    #[doc(alias = "roll pitch yaw")]
    pub fn euler_angles(mut self, sequence: EulerSequence) -> Result<Self, ColumnError>
    where
        S: DescribedSystem,
    {
        let (names, before) = (S::COORDINATE_NAMES, self.iter().count());
        for first in 0..names.len() {
            let number = move |sample: &Sample<S>, i: usize| sample.q.components().component(first + i).lane(0);
            if let Some(name) = stem(&names[first..], &["_i", "_j", "_k", "_w"]) {
                self = self.euler_angles_of(name, sequence, move |sample| {
                    let [i, j, k, w] = std::array::from_fn(|n| number(sample, n));
                    UnitQuaternion::new_unchecked(Quaternion::new(w, i, j, k))
                })?;
            } else if let Some(name) = stem(&names[first..], &["_cos", "_sin"]) {
                let angle = move |sample: &_, put: &mut dyn FnMut(f64)| put(number(sample, 1).atan2(number(sample, 0)));
                self = self.with([(format!("{name}_angle"), "rad")], angle);
            }
        }
        if self.iter().count() > before { Ok(self) } else { Err(ColumnError::NoRotation) }
    }

    /// The Euler angles of a rotation that follows from the state, body to observer, called as those of
    /// [`euler_angles`](Self::euler_angles).
    ///
    /// # Errors
    /// [`ColumnError::Sequence`].
    pub fn euler_angles_of(
        self,
        name: &str,
        sequence: EulerSequence,
        rotation: impl Fn(&Sample<S>) -> UnitQuaternion<f64>,
    ) -> Result<Self, ColumnError> {
        if !sequence.is_valid() {
            return Err(ColumnError::Sequence(sequence.axes));
        }
        let ends = match sequence {
            EulerSequence::ZYX => ["yaw", "pitch", "roll"],
            EulerSequence::ZXZ => ["precession", "nutation", "spin"],
            _ => ["angle_1", "angle_2", "angle_3"],
        };
        Ok(self.with(ends.map(|end| (format!("{name}_{end}"), "rad")), |sample, put| {
            let angles = coordinates_of_rotation(RotationChart::Euler(sequence), &rotation(sample));
            angles.unwrap_or([f64::NAN; 3]).into_iter().for_each(put);
        }))
    }
}

/// Common stem of all of these names, if they end so.
fn stem<'n>(names: &[&'n str], ends: &[&str]) -> Option<&'n str> {
    let stem = names.first()?.strip_suffix(ends[0])?;
    let is_next = |(name, end): (&&str, &&str)| name.strip_suffix(*end) == Some(stem);
    (names.len() >= ends.len() && names.iter().zip(ends).all(is_next)).then_some(stem)
}
