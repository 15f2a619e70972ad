//! Methods of one kernel type, each as a loop over rows.

use std::ops::Range;

use gauss_runtime::prelude::*;
use gauss_runtime::simd::Packed;

use super::called;
use super::system::System;
use super::words::{COUNT, Id, Size, Slot};
use crate::lanes::SHORT;
use crate::memory::{Source, Target};

/// Numbers of components that the vectors of a system have.
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
    /// Driven coordinates.
    pub motions: usize,
    /// Numbers of parameters that there are derivatives by; 0 without the clause for them.
    pub parameters: usize,
}

impl Sizes {
    /// The sizes of a system.
    #[must_use]
    pub fn of<S: System>([multipliers, motions]: [usize; 2], parameters: usize) -> Self {
        Self {
            configuration: <<S::Configuration as Configuration>::Components as VectorSpace<S::Scalar>>::DIM,
            increment: <<S::Configuration as Configuration>::Tangent as VectorSpace<S::Scalar>>::DIM,
            speeds: S::DOF,
            input: <S::Input as VectorSpace<S::Scalar>>::DIM,
            multipliers,
            motions,
            parameters,
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
            Size::Motions => self.motions,
            Size::Parameters => self.parameters,
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
    /// Arguments, by [`Slot`].
    pub arguments: [Source; 4],
    /// Arrays that are written.
    pub results: [Target; MOST_RESULTS],
    /// The frame, by its number.
    pub frame: usize,
}

impl Work {
    /// Work on no arrays.
    pub const NONE: Self =
        Self { t: Source::NONE, arguments: [Source::NONE; 4], results: [Target::NONE; MOST_RESULTS], frame: 0 };

    /// The same arrays from a row on.
    ///
    /// # Safety
    /// All arrays have the row.
    #[allow(unsafe_code)]
    pub unsafe fn beginning(&self, row: usize) -> Self {
        // SAFETY: of this function.
        unsafe {
            Self {
                t: self.t.beginning(row),
                arguments: self.arguments.map(|source| source.beginning(row)),
                results: self.results.map(|target| target.beginning(row)),
                frame: self.frame,
            }
        }
    }
}

/// The arguments of as many states as the scalar has lanes: of one row of vectors.
pub struct At<'a, S> {
    work: &'a Work,
    row: usize,
    system: std::marker::PhantomData<S>,
}

impl<'a, S: System> At<'a, S> {
    /// The arguments in this row.
    #[inline(always)]
    pub(super) fn new(work: &'a Work, row: usize) -> Self {
        Self { work, row, system: std::marker::PhantomData }
    }

    #[inline(always)]
    fn vector<V: VectorSpace<S::Scalar>>(&self, slot: Slot) -> V {
        // The size is a constant here.
        let (mut vector, rows) = (V::zero(), self.work.arguments[slot as usize].at_distance(V::DIM));
        let width = S::Scalar::WIDTH;
        // SAFETY: arrays have the rows and the sizes of this system: `Table::run`.
        #[allow(unsafe_code)]
        if V::DIM > SHORT {
            (0..V::DIM).for_each(|i| vector.set_component(i, unsafe { rows.vector(self.row, i) }));
            return vector;
        }
        // All numbers of as many rows as there are lanes, then the lanes of them: compilers make shuffles of it.
        let mut flat = [S::Scalar::zero(); SHORT];
        for k in 0..V::DIM * width {
            // SAFETY: as above.
            #[allow(unsafe_code)]
            let number = unsafe { rows.get(self.row * width, k) };
            flat[k / width].replace(k % width, &number);
        }
        for i in 0..V::DIM {
            let mut lanes = S::Scalar::zero();
            for lane in 0..width {
                let k = lane * V::DIM + i;
                lanes.replace(lane, &flat[k / width].extract(k % width));
            }
            vector.set_component(i, lanes);
        }
        vector
    }

    /// Time.
    #[inline(always)]
    pub fn t(&self) -> S::Scalar {
        let mut t = S::Scalar::zero();
        for lane in 0..S::Scalar::WIDTH {
            // SAFETY: there is a time for each row, or one for all.
            #[allow(unsafe_code)]
            t.replace(lane, &unsafe { self.work.t.get(self.row * S::Scalar::WIDTH + lane, 0) });
        }
        t
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

/// Writer of the results of as many rows as there are lanes.
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
                self.targets[self.result].set(self.row * T::WIDTH + lane, self.place, value.extract(lane));
            }
        }
        self.place += 1;
    }

    /// The next numbers.
    #[inline(always)]
    pub fn vector<T: Real + Packed<Single = f64>, V: VectorSpace<T>>(&mut self, vector: &V) {
        let target = self.targets[self.result];
        if V::DIM <= SHORT && target.stride() == V::DIM {
            // One number behind the other, which compilers make shuffles of.
            let target = target.at_distance(V::DIM);
            for k in 0..V::DIM * T::WIDTH {
                let number = vector.component(k % V::DIM).extract(k / V::DIM);
                // SAFETY: as of `number`.
                #[allow(unsafe_code)]
                unsafe {
                    target.set(self.row * T::WIDTH, k, number);
                }
            }
            self.place += V::DIM;
            return;
        }
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

    /// Goes on to the next array.
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
    /// Number of multipliers.
    pub multipliers: usize,
    /// The names of the numbers of parameters that there are derivatives by.
    pub parameters: &'static [&'static str],
    /// The names of the frames.
    pub frames: Vec<&'static str>,
    /// The names of the joints whose reactions are methods.
    pub joints: Vec<&'static str>,
    /// The names of the driven coordinates.
    pub motions: Vec<&'static str>,
}

impl<S: System> Table<S> {
    /// The table of the methods that every kernel has.
    #[must_use]
    pub fn new() -> Self {
        let (loops, frames, joints, motions) = (std::array::from_fn(|_| None), Vec::new(), Vec::new(), Vec::new());
        let mut table = Self { loops, multipliers: 0, parameters: &[], frames, joints, motions };
        table.motion();
        table.energies();
        table
    }

    /// A method by what it does for a row of vectors.
    pub(super) fn add(&mut self, id: Id, one: impl Fn(&S, &At<'_, S>, &mut Writer<'_>) + Copy + Send + Sync + 'static) {
        let run = move |system: &S, work: &Work, rows: Range<usize>| {
            for row in rows {
                one(system, &At::new(work, row), &mut Writer { targets: &work.results, result: 0, place: 0, row });
            }
        };
        self.loops[id as usize] = Some(Box::new(run));
    }

    /// Whether there is such a method.
    #[must_use]
    pub fn has(&self, id: Id) -> bool {
        self.loops[id as usize].is_some()
    }

    /// Computes rows of vectors, which are numbers where a scalar is one.
    ///
    /// # Safety
    /// All arguments that the [`Spec`](super::Spec) of the method names have these rows, as
    /// [`Lanes`](crate::lanes::Lanes) has them, each with as many vectors as the sizes of the system say, one row
    /// behind the other; one time may be there for all. Results have a row of numbers for each lane of them.
    #[allow(unsafe_code)]
    pub unsafe fn run(&self, system: &S, id: Id, work: &Work, rows: Range<usize>) {
        if let Some(run) = &self.loops[id as usize] {
            run(system, work, rows);
        }
    }

    fn motion(&mut self) {
        self.add(Id::Acceleration, |s, at, out| out.vector(&s.acceleration(at.t(), &at.q(), &at.z(), &at.input())));
        self.add(Id::InverseDynamics, |s, at, out| {
            out.vector(&s.inverse_dynamics(at.t(), &at.q(), &at.z(), &at.x(), &at.input()));
        });
        self.add(Id::NonlinearEffects, |s, at, out| {
            out.vector(&s.nonlinear_effects(at.t(), &at.q(), &at.z(), &at.input()))
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
            out.vector(&called::acceleration(s, t, &q, &z, &input));
        });
        self.add(Id::Momentum, |s, at, out| out.vector(&s.momentum(at.t(), &at.q(), &at.z())));
        self.add(Id::Velocity, |s, at, out| out.vector(&s.velocity(at.t(), &at.q(), &at.z())));
        self.add(Id::MomentumRate, |s, at, out| out.vector(&s.momentum_rate(at.t(), &at.q(), &at.z(), &at.input())));
        self.add(Id::Retract, |_, at, out| out.vector(&at.q().advance(&at.x()).components()));
        self.add(Id::Difference, |_, at, out| out.vector(&at.q().difference(&at.other())));
        self.add(Id::Tangent, |_, at, out| out.vector(&at.q().tangent(&at.x())));
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
        assert_eq!(SPECS[Id::ByParameters as usize].name, "by_parameters");
        assert_eq!(Id::ByParameters as usize + 1, COUNT);
        assert!(SPECS.iter().all(|spec| spec.results.len() <= MOST_RESULTS));
    }
}
