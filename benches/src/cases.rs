//! Every scene with every way to its accelerations.

use std::error::Error;

use gauss_runtime::description::OperationCount;
use gauss_runtime::prelude::*;

use crate::measure::Way;
use crate::states::{of_a_body, of_angles, of_the_top};
use crate::{Generated, by_hand, entries, matrices, peers, scenes};

/// A scene and the ways to compute it: generated, by hand, with matrices, as far as there are such.
pub struct Case {
    /// S1, …
    pub name: &'static str,
    /// In a few words.
    pub what: &'static str,
    /// Accelerations: generated first, then those that there are of by hand, with matrices, and peers.
    pub ways: Vec<Way>,
    /// Operations of the generated kernel.
    pub operations: OperationCount,
    /// The largest difference of each further way from the generated accelerations, relative to their length, over all
    /// states.
    pub differences: Vec<f64>,
    /// Ways of peers, each by every compiler, with their differences: the faster ones are moved to `ways`.
    pub peers: Vec<(Way, f64)>,
}

/// A function that is timed, and what it computes with.
type Timed<'d, D, S, R> = (fn(&D, &S) -> R, &'d D);

/// The largest ‖ż − ż′‖/‖ż‖ over all states. By the functions that are timed: a method with one caller is inlined into
/// it.
fn difference<A, B, S, const N: usize>(
    (f, a): Timed<'_, A, S, SVector<f64, N>>,
    (g, b): Timed<'_, B, S, SVector<f64, N>>,
    states: &[S],
) -> f64 {
    let of = |state: &S| {
        let (x, y) = (f(a, state), g(b, state));
        (x - y).norm() / x.norm()
    };
    states.iter().map(of).fold(0.0, f64::max)
}

macro_rules! case {
    ($peers:expr, $scene:literal, $name:literal, $what:literal, $kernel:expr, $states:expr, $generated:ident
        $(, $by_hand:expr, $hand_entry:ident, $matrices:expr, $matrix_entry:ident)?) => {{
        let (kernel, states) = (Generated($kernel), $states);
        let expected: Vec<_> = states.iter().map(|state| entries::$generated(&kernel, state)).collect();
        let ways = vec![
            Way::new("generated", kernel, states.clone(), entries::$generated),
            $(
                Way::new("by hand", $by_hand, states.clone(), entries::$hand_entry),
                Way::new("with matrices", $matrices, states.clone(), entries::$matrix_entry),
            )?
        ];
        Case {
            name: $name,
            what: $what,
            ways,
            operations: operations(&kernel),
            differences: vec![
                $(
                    difference((entries::$generated, &kernel), (entries::$hand_entry, &$by_hand), &states),
                    difference((entries::$generated, &kernel), (entries::$matrix_entry, &$matrices), &states),
                )?
            ],
            peers: $peers.ways($scene, &states, &expected),
        }
    }};
}

fn operations<S: DescribedSystem>(_: &Generated<S>) -> OperationCount {
    S::OPERATIONS.acceleration
}

/// All scenes.
///
/// # Errors
/// When a scene lost a parameter, or a peer is there and cannot be loaded.
pub fn all() -> Result<Vec<Case>, Box<dyn Error>> {
    let peers = peers::Peers::load()?;
    Ok(vec![
        case! {
            peers, "s1", "S1", "free body, principal axes", scenes::free_body()?, of_a_body(), s1_generated,
            by_hand::FreeBody::new(), s1_by_hand, matrices::Body::free(), s1_matrices
        },
        case! {
            peers, "s2", "S2", "heavy body, O off its centre of mass", scenes::heavy_body()?, of_a_body(),
            s2_generated, by_hand::HeavyBody::new(), s2_by_hand, matrices::Body::heavy(), s2_matrices
        },
        case! {
            peers, "s3", "S3", "body in fluid, full kinetic matrix", scenes::immersed()?, of_a_body(),
            s3_generated, by_hand::Immersed::new(), s3_by_hand, matrices::Body::immersed(), s3_matrices
        },
        case! {
            peers, "s4", "S4", "heavy top, Euler angles", scenes::top()?, of_the_top(), s4_generated,
            by_hand::Top::new(), s4_by_hand, matrices::Top::new(), s4_matrices
        },
        case! {
            peers, "s5", "S5", "double pendulum, angles from the vertical", scenes::double_pendulum()?,
            of_angles::<2>(), s5_generated, by_hand::DoublePendulum::new(), s5_by_hand, matrices::DoublePendulum,
            s5_matrices
        },
        case! {
            peers, "s5_jointed", "S5′", "the same, angle of the joint", scenes::jointed_pendulum()?,
            of_angles::<2>(), s5_jointed_generated, by_hand::JointedPendulum::default(), s5_jointed_by_hand,
            matrices::JointedPendulum, s5_jointed_matrices
        },
        case! {
            peers, "s6", "S6", "cart and pole", scenes::cart_pole()?, of_angles::<2>(), s6_generated,
            by_hand::CartPole::new(), s6_by_hand, matrices::CartPole, s6_matrices
        },
        case!(peers, "s7", "S7", "arm of seven joints", scenes::arm()?, of_angles::<7>(), s7_generated),
    ])
}
