//! Robots from their files: forward dynamics, inverse dynamics, and derivatives of both.
//!
//! Their numbers are those of `tests/robots`, which say where they are from; efforts of the joints are inputs. Under
//! the feature `robot-derivatives` they are linearised as well, which takes the compiler a minute more.

use std::error::Error;

use gauss_runtime::description::{OperationCount, Operations};
#[cfg(feature = "robot-derivatives")]
use gauss_runtime::inverse::InverseLinearization;
#[cfg(feature = "robot-derivatives")]
use gauss_runtime::linearize::Linearization;
use gauss_runtime::prelude::*;

use crate::cases::Case;
use crate::measure::Way;
use crate::peers::Peers;
use crate::states::{Random, STATES};

/// S7′. The arm of S7 with its hand and two fingers: nine joints.
#[derive(Clone, Copy, GaussDynamics)]
#[gauss(urdf = "../tests/robots/panda.urdf", gravity = 9.81)]
#[cfg_attr(feature = "robot-derivatives", gauss(linearize(inverse)))]
pub struct Fingers;

/// S8. A quadruped whose base floats: eighteen degrees of freedom.
#[derive(Clone, Copy, GaussDynamics)]
#[gauss(urdf = "../tests/robots/anymal.urdf", base = floating, gravity = 9.81)]
#[cfg_attr(feature = "robot-derivatives", gauss(linearize(inverse)))]
pub struct Anymal;

/// S9. A biped with arms whose base floats: 38 degrees of freedom.
#[derive(Clone, Copy, GaussDynamics)]
#[gauss(urdf = "../tests/robots/talos.urdf", base = floating, gravity = 9.81)]
#[cfg_attr(feature = "robot-derivatives", gauss(linearize(inverse), limit = 400000))]
pub struct Talos;

/// A state, efforts of joints, and accelerations for which forces are asked.
pub struct Moment<S: GaussSystem> {
    q: S::Configuration,
    z: S::Speeds,
    input: S::Input,
    acceleration: S::Speeds,
}

/// ż.
#[inline(never)]
pub fn forward<S: GaussSystem<Scalar = f64>>(kernel: &S, at: &Moment<S>) -> S::Speeds {
    kernel.acceleration(0.0, &at.q, &at.z, &at.input)
}

/// What must act for the given ż, the efforts being zero.
#[inline(never)]
pub fn inverse<S, const U: usize>(kernel: &S, at: &Moment<S>) -> S::Speeds
where
    S: GaussSystem<Scalar = f64, Input = SVector<f64, U>>,
{
    kernel.inverse_dynamics(0.0, &at.q, &at.z, &at.acceleration, &SVector::zeros())
}

/// ż and all its derivatives.
#[cfg(feature = "robot-derivatives")]
#[inline(never)]
pub fn linearize<S: LinearizedSystem<Scalar = f64>>(kernel: &S, at: &Moment<S>) -> S::Linearization {
    kernel.linearize(0.0, &at.q, &at.z, &at.input)
}

/// The forces that the given ż asks for, the efforts being zero, and all their derivatives.
#[cfg(feature = "robot-derivatives")]
#[inline(never)]
pub fn linearize_inverse<S, const U: usize>(kernel: &S, at: &Moment<S>) -> S::InverseLinearization
where
    S: InverseLinearizedSystem<Scalar = f64, Input = SVector<f64, U>>,
{
    kernel.linearize_inverse(0.0, &at.q, &at.z, &at.acceleration, &SVector::zeros())
}

/// The numbers of a configuration, in the order in which peers read them.
trait Flat {
    fn numbers(&self) -> Vec<f64>;
}

impl<const N: usize> Flat for SVector<f64, N> {
    fn numbers(&self) -> Vec<f64> {
        self.iter().copied().collect()
    }
}

impl<const N: usize> Flat for (Isometry3<f64>, SVector<f64, N>) {
    fn numbers(&self) -> Vec<f64> {
        let (pose, joints) = self;
        pose.translation.vector.iter().chain(pose.rotation.coords.iter()).chain(joints).copied().collect()
    }
}

/// Angles up to π, 2 rad/s, efforts of 20 N m, and accelerations of 10 rad/s²: 64 of them.
fn moments<S, const D: usize, const U: usize>(
    mut configuration: impl FnMut(&mut Random) -> S::Configuration,
) -> Vec<Moment<S>>
where
    S: GaussSystem<Scalar = f64, Speeds = SVector<f64, D>, Input = SVector<f64, U>>,
{
    let random = &mut Random::new();
    let moment = |_| Moment {
        q: configuration(random),
        z: random.vector(2.0),
        input: random.vector(20.0),
        acceleration: random.vector(10.0),
    };
    (0..STATES).map(moment).collect()
}

fn angles<const N: usize>(random: &mut Random) -> SVector<f64, N> {
    random.vector(core::f64::consts::PI)
}

fn floating<const N: usize>(random: &mut Random) -> (Isometry3<f64>, SVector<f64, N>) {
    (Isometry3::new(random.vector(1.0), random.vector(3.0)), angles(random))
}

/// What peers read: the configuration, the speeds, then efforts of all speeds, of which a base that floats has none, or
/// accelerations.
fn flat<S, const D: usize, const U: usize>(
    moments: &[Moment<S>],
    third: impl Fn(&Moment<S>) -> Vec<f64>,
) -> Vec<Vec<f64>>
where
    S: GaussSystem<Scalar = f64, Speeds = SVector<f64, D>, Input = SVector<f64, U>, Configuration: Flat>,
{
    moments.iter().map(|at| [at.q.numbers(), at.z.numbers(), third(at)].concat()).collect()
}

/// Efforts along all of the D speeds.
fn efforts<S, const D: usize, const U: usize>(at: &Moment<S>) -> Vec<f64>
where
    S: GaussSystem<Scalar = f64, Speeds = SVector<f64, D>, Input = SVector<f64, U>>,
{
    [vec![0.0; D - U], at.input.numbers()].concat()
}

fn case(
    name: &'static str,
    what: &'static str,
    generated: Way,
    operations: OperationCount,
    peers: Vec<(Way, f64)>,
) -> Case {
    Case { name, what, ways: vec![generated], operations, differences: Vec::new(), peers }
}

macro_rules! robot {
    ($cases:ident, $peers:ident, $kernel:expr, $configuration:ident, $speeds:literal, $numbers:literal, $entries:literal:
        $name:literal, $scene:literal, $what:literal) => {{
        let (kernel, at) = ($kernel, || moments::<_, $speeds, _>($configuration));
        let states = flat(&at(), efforts);
        let expected: Vec<_> = at().iter().map(|at| forward(&kernel, at)).collect();
        $cases.push(case(
            concat!($name, " forward"),
            concat!($what, ", forward dynamics"),
            Way::new("generated", kernel, at(), forward),
            count(&kernel, |operations| operations.acceleration),
            $peers.of_length::<$numbers, $speeds>(concat!($scene, "_forward"), &states, &expected),
        ));
        let asked = flat(&at(), |at| at.acceleration.numbers());
        let needed: Vec<_> = at().iter().map(|at| inverse(&kernel, at)).collect();
        $cases.push(case(
            concat!($name, " inverse"),
            concat!($what, ", inverse dynamics"),
            Way::new("generated", kernel, at(), inverse),
            count(&kernel, |operations| operations.gauss_residual),
            $peers.of_length::<$numbers, $speeds>(concat!($scene, "_inverse"), &asked, &needed),
        ));
        #[cfg(feature = "robot-derivatives")]
        {
            let derivatives: Vec<_> = at().iter().map(|at| by_state(&linearize(&kernel, at))).collect();
            agree(
                concat!($scene, "_derivatives"),
                &$peers.of_length::<$numbers, $entries>(concat!($scene, "_derivatives"), &states, &derivatives),
            );
            $cases.push(case(
                concat!($name, " linearize"),
                concat!($what, ", derivatives"),
                Way::new("generated", kernel, at(), linearize),
                count(&kernel, |operations| operations.linearize),
                $peers.of_length::<$numbers, $speeds>(concat!($scene, "_linearize"), &states, &expected),
            ));
            let derivatives: Vec<_> = at().iter().map(|at| of_forces(&linearize_inverse(&kernel, at))).collect();
            agree(
                concat!($scene, "_inverse_derivatives"),
                &$peers.of_length::<$numbers, $entries>(concat!($scene, "_inverse_derivatives"), &asked, &derivatives),
            );
            $cases.push(case(
                concat!($name, " inverse linearize"),
                concat!($what, ", derivatives of inverse dynamics"),
                Way::new("generated", kernel, at(), linearize_inverse),
                count(&kernel, |operations| operations.linearize_inverse),
                $peers.of_length::<$numbers, $speeds>(concat!($scene, "_inverse_linearize"), &asked, &needed),
            ));
        }
    }};
}

fn count<S: DescribedSystem>(_: &S, of: impl Fn(&Operations) -> OperationCount) -> OperationCount {
    of(&S::OPERATIONS)
}

/// ∂ż/∂σ, then ∂ż/∂z, each row by row.
#[cfg(feature = "robot-derivatives")]
fn by_state<const N: usize, const U: usize, const M: usize>(linear: &Linearization<f64, N, U>) -> SVector<f64, M> {
    let n = N / 2;
    let blocks = (0..2).flat_map(|block| (0..n).flat_map(move |i| (0..n).map(move |j| (n + i, block * n + j))));
    SVector::from_iterator(blocks.map(|at| linear.by_state[at]))
}

/// ∂f/∂σ, then ∂f/∂z.
#[cfg(feature = "robot-derivatives")]
fn of_forces<const N: usize, const U: usize, const M: usize>(
    inverse: &InverseLinearization<f64, N, N, U>,
) -> SVector<f64, M> {
    let row_by_row = |block: SMatrix<f64, N, N>| block.transpose();
    let blocks = [row_by_row(inverse.by_configuration), row_by_row(inverse.by_speeds)];
    SVector::from_iterator(blocks.iter().flat_map(|block| block.iter().copied()))
}

/// What peers compute is what we compute.
#[cfg(feature = "robot-derivatives")]
fn agree(what: &str, ways: &[(Way, f64)]) {
    for (way, difference) in ways {
        assert!(*difference <= 1e-10, "{what}: {} differs by {difference:e}", way.name);
    }
}

/// All robots with all functions.
///
/// # Errors
/// When a robot lost a parameter, or a peer is there and cannot be loaded.
pub fn all() -> Result<Vec<Case>, Box<dyn Error>> {
    let peers = Peers::load()?;
    let mut cases = Vec::new();
    robot!(cases, peers, Fingers.kernel()?, angles, 9, 27, 162: "S7′", "s7_fingers", "arm of seven joints with two fingers");
    robot!(cases, peers, Anymal.kernel()?, floating, 18, 55, 648: "S8", "s8", "quadruped");
    robot!(cases, peers, Talos.kernel()?, floating, 38, 115, 2888: "S9", "s9", "biped with arms");
    Ok(cases)
}
