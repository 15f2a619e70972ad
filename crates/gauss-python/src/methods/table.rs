//! Methods of one kernel type, each as a loop over rows.

use std::ops::Range;

use gauss_runtime::prelude::*;
use gauss_runtime::simd::Packed;

use super::words::{COUNT, Id, Size, Slot};
use crate::memory::{Source, Target};

/// A kernel in any number of lanes.
pub trait System:
    GaussSystem<Scalar: Packed<Single = f64>, Input: VectorSpace<<Self as GaussSystem>::Scalar>>
    + DescribedSystem
    + Send
    + Sync
    + 'static
{
}

impl<S> System for S where
    S: GaussSystem<Scalar: Packed<Single = f64>, Input: VectorSpace<<S as GaussSystem>::Scalar>>
        + DescribedSystem
        + Send
        + Sync
        + 'static
{
}

/// How many numbers the vectors of a system have.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sizes {
    /// Components of the configuration.
    pub configuration: usize,
    /// Components of its increments.
    pub increment: usize,
    /// Speeds.
    pub speeds: usize,
    /// Inputs.
    pub input: usize,
    /// Multipliers; 0 without constraints.
    pub multipliers: usize,
}

impl Sizes {
    /// Those of a system.
    #[must_use]
    pub fn of<S: System>(multipliers: usize) -> Self {
        Self {
            configuration: <<S::Configuration as Configuration>::Components as VectorSpace<S::Scalar>>::DIM,
            increment: <<S::Configuration as Configuration>::Tangent as VectorSpace<S::Scalar>>::DIM,
            speeds: S::DOF,
            input: <S::Input as VectorSpace<S::Scalar>>::DIM,
            multipliers,
        }
    }

    /// In numbers.
    #[must_use]
    pub fn get(&self, size: Size) -> usize {
        match size {
            Size::Configuration => self.configuration,
            Size::Speeds => self.speeds,
            Size::Increment => self.increment,
            Size::Input => self.input,
            Size::State => self.increment + self.speeds,
            Size::Flat => self.configuration + self.speeds,
            Size::Multipliers => self.multipliers,
            Size::Exactly(count) => count,
        }
    }
}

/// The most arrays that a method gives.
pub const MOST_RESULTS: usize = 6;

/// The arrays of a call.
#[derive(Clone, Copy, Debug)]
pub struct Work {
    /// Times.
    pub t: Source,
    /// By [`Slot`].
    pub arguments: [Source; 4],
    /// What is written.
    pub results: [Target; MOST_RESULTS],
    /// The frame, by its number.
    pub frame: usize,
}

/// The arguments of as many rows as there are lanes.
pub struct At<'a, S> {
    work: &'a Work,
    row: usize,
    system: std::marker::PhantomData<S>,
}

impl<S: System> At<'_, S> {
    /// One number of every lane.
    #[inline(always)]
    fn number(source: &Source, row: usize, i: usize) -> S::Scalar {
        // SAFETY: a `Work` has rows for all lanes, and the sizes of its arrays are those of this system: `Table::run`.
        #![allow(unsafe_code)]
        unsafe {
            let mut value = S::Scalar::repeat(&source.get(row, i));
            for lane in 1..S::Scalar::WIDTH {
                value.replace(lane, &source.get(row + lane, i));
            }
            value
        }
    }

    #[inline(always)]
    fn vector<V: VectorSpace<S::Scalar>>(&self, slot: Slot) -> V {
        let (mut vector, source) = (V::zero(), &self.work.arguments[slot as usize]);
        for i in 0..V::DIM {
            vector.set_component(i, Self::number(source, self.row, i));
        }
        vector
    }

    /// Time.
    #[inline(always)]
    pub fn t(&self) -> S::Scalar {
        Self::number(&self.work.t, self.row, 0)
    }

    /// The configuration.
    #[inline(always)]
    pub fn q(&self) -> S::Configuration {
        S::Configuration::from_components(&self.vector(Slot::Q))
    }

    /// The configuration that is not the first.
    #[inline(always)]
    pub fn other(&self) -> S::Configuration {
        S::Configuration::from_components(&self.vector(Slot::X))
    }

    /// Speeds, or momenta.
    #[inline(always)]
    pub fn z(&self) -> S::Speeds {
        self.vector(Slot::Z)
    }

    /// The argument that only some methods have.
    #[inline(always)]
    pub fn x<V: VectorSpace<S::Scalar>>(&self) -> V {
        self.vector(Slot::X)
    }

    /// The input.
    #[inline(always)]
    pub fn input(&self) -> S::Input {
        self.vector(Slot::U)
    }

    /// The frame, of those of the struct.
    #[inline(always)]
    pub fn frame<F: FrameName>(&self) -> F {
        F::ALL[self.work.frame]
    }
}

/// Where results of as many rows as there are lanes go.
pub struct Writer<'a> {
    targets: &'a [Target; MOST_RESULTS],
    result: usize,
    place: usize,
    row: usize,
}

impl Writer<'_> {
    /// The next number of every lane.
    #[inline(always)]
    pub fn number<T: Real + Packed<Single = f64>>(&mut self, value: T) {
        for lane in 0..T::WIDTH {
            // SAFETY: results have rows for all lanes, and methods write as many numbers as their `Spec` says, which
            // tests compare with what is left.
            #[allow(unsafe_code)]
            unsafe {
                self.targets[self.result].set(self.row + lane, self.place, value.extract(lane));
            }
        }
        self.place += 1;
    }

    /// The next numbers.
    #[inline(always)]
    pub fn vector<T: Real + Packed<Single = f64>, V: VectorSpace<T>>(&mut self, vector: &V) {
        for i in 0..V::DIM {
            self.number(vector.component(i));
        }
    }

    /// The next rows.
    #[inline(always)]
    pub fn matrix<T: Real + Packed<Single = f64>>(
        &mut self,
        [rows, columns]: [usize; 2],
        entry: impl Fn(usize, usize) -> T,
    ) {
        for i in 0..rows {
            for j in 0..columns {
                self.number(entry(i, j));
            }
        }
    }

    /// What follows belongs to the next array.
    #[inline(always)]
    pub fn next(&mut self) {
        self.result += 1;
        self.place = 0;
    }
}

type Loop<S> = Box<dyn Fn(&S, &Work, Range<usize>) + Send + Sync>;

/// The methods that a kernel has.
pub struct Table<S> {
    loops: [Option<Loop<S>>; COUNT],
    /// How many multipliers there are.
    pub multipliers: usize,
    /// The names of the frames.
    pub frames: Vec<&'static str>,
}

impl<S: System> Table<S> {
    /// Those that every kernel has.
    #[must_use]
    pub fn new() -> Self {
        let mut table = Self { loops: std::array::from_fn(|_| None), multipliers: 0, frames: Vec::new() };
        table.motion();
        table.energies();
        table
    }

    /// A method by what it does for as many rows as there are lanes.
    pub(super) fn add(&mut self, id: Id, one: impl Fn(&S, &At<'_, S>, &mut Writer<'_>) + Copy + Send + Sync + 'static) {
        self.loops[id as usize] = Some(Box::new(move |system, work, rows| {
            for row in rows.step_by(S::Scalar::WIDTH) {
                let at = At { work, row, system: std::marker::PhantomData };
                one(system, &at, &mut Writer { targets: &work.results, result: 0, place: 0, row });
            }
        }));
    }

    /// Whether there is such a method.
    #[must_use]
    pub fn has(&self, id: Id) -> bool {
        self.loops[id as usize].is_some()
    }

    /// Computes rows, as many as fill whole lanes; gives the number of the first row that is left.
    ///
    /// # Safety
    /// All arrays that the [`Spec`](super::Spec) of the method names have these rows, each with as many numbers as the
    /// sizes of the system say.
    #[allow(unsafe_code)]
    pub unsafe fn run(&self, system: &S, id: Id, work: &Work, rows: Range<usize>) -> usize {
        let whole = rows.len() / S::Scalar::WIDTH * S::Scalar::WIDTH;
        let end = rows.start + whole;
        if let Some(run) = &self.loops[id as usize]
            && whole > 0
        {
            run(system, work, rows.start..end);
        }
        end
    }

    fn motion(&mut self) {
        self.add(Id::Acceleration, |s, at, out| out.vector(&s.acceleration(at.t(), &at.q(), &at.z(), &at.input())));
        self.add(Id::InverseDynamics, |s, at, out| {
            out.vector(&s.inverse_dynamics(at.t(), &at.q(), &at.z(), &at.x(), &at.input()));
        });
        self.add(Id::NonlinearEffects, |s, at, out| {
            out.vector(&s.nonlinear_effects(at.t(), &at.q(), &at.z(), &at.input()));
        });
        self.add(Id::MassMatrix, |s, at, out| {
            let matrix = s.mass_matrix(at.t(), &at.q());
            out.matrix([S::DOF; 2], |i, j| matrix[(i, j)]);
        });
        self.add(Id::Kinematics, |s, at, out| out.vector(&s.kinematics(at.t(), &at.q(), &at.z())));
        self.add(Id::Rates, |s, at, out| {
            let (t, q, z) = (at.t(), at.q(), at.z());
            let input = at.input();
            out.vector(&q.component_rates(&s.configuration_rates(t, &q, &z, &input)));
            out.vector(&s.acceleration(t, &q, &z, &input));
        });
        self.add(Id::Momentum, |s, at, out| out.vector(&s.momentum(at.t(), &at.q(), &at.z())));
        self.add(Id::Velocity, |s, at, out| out.vector(&s.velocity(at.t(), &at.q(), &at.z())));
        self.add(Id::MomentumRate, |s, at, out| out.vector(&s.momentum_rate(at.t(), &at.q(), &at.z(), &at.input())));
        self.add(Id::Retract, |_, at, out| out.vector(&at.q().advance(&at.x()).components()));
        self.add(Id::Difference, |_, at, out| out.vector(&at.q().difference(&at.other())));
    }

    fn energies(&mut self) {
        self.add(Id::KineticEnergy, |s, at, out| out.number(s.kinetic_energy(at.t(), &at.q(), &at.z())));
        self.add(Id::PotentialEnergy, |s, at, out| out.number(s.potential_energy(at.t(), &at.q())));
        self.add(Id::Energy, |s, at, out| out.number(s.energy(at.t(), &at.q(), &at.z())));
        self.add(Id::Regularity, |s, at, out| out.number(s.regularity(at.t(), &at.q())));
    }
}

impl<S: System> Default for Table<S> {
    fn default() -> Self {
        Self::new()
    }
}

#[cfg(test)]
mod tests {
    use super::super::words::SPECS;
    use super::*;

    #[test]
    fn numbers_of_methods_are_places_in_the_list() {
        assert_eq!(SPECS[Id::Hessian as usize].name, "hessian");
        assert_eq!(SPECS[Id::CenterJacobian as usize].name, "center_jacobian");
        assert_eq!(Id::CenterJacobian as usize + 1, COUNT);
        assert!(SPECS.iter().all(|spec| spec.results.len() <= MOST_RESULTS));
    }
}
