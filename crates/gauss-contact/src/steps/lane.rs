//! One lane of a step of several states, and numbers of all lanes in packs.

use gauss_runtime::configuration::VectorSpace;
use gauss_runtime::contact::{ContactSystem, ImpulseDynamics, ImpulseResponse};
use gauss_runtime::real::Real;
use gauss_runtime::simd::Packed;

use super::motion::Middle;
use super::outcome::Pushed;
use super::projection::Closed;
use super::step::{Step, StepDynamics};
use super::stepper::ContactStepper;

/// A system in packs, each lane of which is the system `K`: `Kernel<wide::f64x8>` of a struct that is generic in its
/// scalar, of which `K` is `Kernel<f64>`.
pub trait LanesOf<K: ContactSystem<Scalar = f64>>:
    ContactSystem<
        Scalar: Packed<Single = f64>,
        Configuration: Packed<Single = K::Configuration>,
        Input: Packed<Single = K::Input>,
        ImpulseFactors: Packed<Single = K::ImpulseFactors>,
        Delassus: Packed<Single = K::Delassus>,
    >
{
}

impl<W, K: ContactSystem<Scalar = f64>> LanesOf<K> for W where
    W: ContactSystem<
            Scalar: Packed<Single = f64>,
            Configuration: Packed<Single = K::Configuration>,
            Input: Packed<Single = K::Input>,
            ImpulseFactors: Packed<Single = K::ImpulseFactors>,
            Delassus: Packed<Single = K::Delassus>,
        >
{
}

/// The states of all lanes, which steppers have as well.
pub(super) struct PackedState<W: ContactSystem> {
    pub(super) t: W::Scalar,
    pub(super) q: W::Configuration,
    pub(super) z: W::Speeds,
    pub(super) gaps: W::Gaps,
    pub(super) rates: W::ContactRows,
    pub(super) impulses: W::ContactRows,
    /// Mean acceleration of the step before.
    pub(super) acceleration: W::Speeds,
}

/// Progress of a lane in a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Stage {
    /// It goes this step alone.
    Alone,
    /// No contact may act in it.
    Flies,
    /// Contacts may act in it.
    Touches,
    /// The step is made, or none is to be.
    Done,
}

/// A lane in a step.
pub(super) struct Lane<'k, K: ContactSystem<Scalar = f64>> {
    pub(super) stage: Stage,
    /// Whether contacts depended on one another before the step.
    pub(super) dependent: bool,
    /// Motion without contacts, of a lane that decides alone: it is large, and stays where it is.
    pub(super) dynamics: Option<LaneDynamics<'k, K>>,
    pub(super) pushed: Option<Pushed<K>>,
    pub(super) closed: Option<Closed<K>>,
}

/// The motion of a lane without contacts in a step.
pub(super) struct LaneDynamics<'k, K: ContactSystem<Scalar = f64>> {
    kernel: &'k K,
    h: f64,
    end: f64,
    z: K::Speeds,
    middle: Middle<K>,
    friction: K::ContactRows,
    free: K::Speeds,
    impulses: ImpulseDynamics<K>,
}

impl<'k, K: ContactSystem<Scalar = f64>> LaneDynamics<'k, K> {
    pub(super) fn new<W: LanesOf<K>>(
        &StepDynamics { step, friction, free, impulses }: &StepDynamics<W>,
        ContactStepper { kernel, t, z, .. }: &ContactStepper<'k, K>,
        lane: usize,
    ) -> Self {
        let ImpulseDynamics { acceleration, bias, response, .. } = impulses;
        let response = ImpulseResponse::new(response.factors.extract(lane), response.delassus.extract(lane));
        let (acceleration, bias) = (single::<W, _, _>(acceleration, lane), single::<W, _, _>(bias, lane));
        Self {
            kernel,
            h: step.h,
            end: t + step.h,
            z: *z,
            middle: middle_of::<W, K>(step.middle, lane),
            friction: single::<W, _, _>(friction, lane),
            free: single::<W, _, _>(free, lane),
            impulses: ImpulseDynamics::new(acceleration, bias, response),
        }
    }

    /// A decision on the step of the lane.
    pub(super) fn decide<T>(&self, decision: impl FnOnce(&StepDynamics<K>) -> T) -> T {
        let Self { kernel, h, end, z, middle, friction, free, impulses } = self;
        let step = Step { kernel: *kernel, h: *h, end: *end, z, middle };
        decision(&StepDynamics { step: &step, friction, free, impulses })
    }
}

/// The state at half of a step of a lane.
pub(super) fn middle_of<W: LanesOf<K>, K: ContactSystem<Scalar = f64>>(middle: &Middle<W>, lane: usize) -> Middle<K> {
    Middle {
        t: middle.t.lane(lane),
        q: middle.q.extract(lane),
        z: single::<W, _, K::Speeds>(&middle.z, lane),
        half: middle.half.extract(lane),
        way: single::<W, _, K::Speeds>(&middle.way, lane),
        is_mean: middle.is_mean,
    }
}

/// The numbers of all lanes.
pub(super) fn packed<W: ContactSystem<Scalar: Packed<Single = f64>>, V: VectorSpace<f64>, P: VectorSpace<W::Scalar>>(
    of: impl Fn(usize) -> V,
) -> P {
    let mut pack = P::zero();
    (0..W::Scalar::WIDTH).for_each(|lane| put::<W, _, _>(&mut pack, lane, &of(lane)));
    pack
}

/// The numbers of a lane.
pub(super) fn single<W: ContactSystem<Scalar: Packed<Single = f64>>, V: VectorSpace<W::Scalar>, U: VectorSpace<f64>>(
    pack: &V,
    lane: usize,
) -> U {
    let mut one = U::zero();
    (0..U::DIM).for_each(|i| one.set_component(i, pack.component(i).extract(lane)));
    one
}

/// The numbers of a lane, replaced.
pub(super) fn put<W: ContactSystem<Scalar: Packed<Single = f64>>, V: VectorSpace<W::Scalar>, U: VectorSpace<f64>>(
    pack: &mut V,
    lane: usize,
    one: &U,
) {
    for i in 0..V::DIM {
        let mut number = pack.component(i);
        number.replace(lane, &one.component(i));
        pack.set_component(i, number);
    }
}
