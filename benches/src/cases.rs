//! Every scene with every way to its accelerations.

use std::error::Error;

use gauss_runtime::prelude::*;

use crate::measure::Way;
use crate::states::{of_a_body, of_angles, of_the_top};
use crate::{Dynamics, Generated, by_hand, entries, matrices, scenes};

/// A scene and the ways to compute it: generated, by hand, with matrices, as far as there are such.
pub struct Case {
    /// S1, …
    pub name: &'static str,
    /// In a few words.
    pub what: &'static str,
    /// Accelerations: generated, by hand, with matrices; at the end ż, q̇ and T by one generated function.
    pub ways: Vec<Way>,
    /// Operations of the generated kernel.
    pub operations: OperationCount,
    /// The largest difference from the generated accelerations, relative to their length, over all states: by hand, then with matrices.
    pub differences: Vec<f64>,
}

/// The largest ‖ż − ż′‖/‖ż‖ over all states.
fn difference<A, B, const N: usize>(a: &A, b: &B, states: &[(A::Configuration, SVector<f64, N>)]) -> f64
where
    A: Dynamics<Speeds = SVector<f64, N>>,
    B: Dynamics<Speeds = SVector<f64, N>, Configuration = A::Configuration>,
{
    let of = |(q, z): &(A::Configuration, SVector<f64, N>)| {
        let (x, y) = (a.acceleration(q, z), b.acceleration(q, z));
        (x - y).norm() / x.norm()
    };
    states.iter().map(of).fold(0.0, f64::max)
}

macro_rules! case {
    ($name:literal, $what:literal, $kernel:expr, $states:expr, $generated:ident, $together:ident
        $(, $by_hand:expr, $hand_entry:ident, $matrices:expr, $matrix_entry:ident)?) => {{
        let (kernel, states) = (Generated($kernel), $states);
        let ways = vec![
            Way::new("generated", kernel, states.clone(), entries::$generated),
            $(
                Way::new("by hand", $by_hand, states.clone(), entries::$hand_entry),
                Way::new("with matrices", $matrices, states.clone(), entries::$matrix_entry),
            )?
            Way::new("all", kernel, states.clone(), entries::$together),
        ];
        Case {
            name: $name,
            what: $what,
            ways,
            operations: operations(&kernel),
            differences: vec![
                $(difference(&kernel, &$by_hand, &states), difference(&kernel, &$matrices, &states))?
            ],
        }
    }};
}

fn operations<S: GaussSystem>(_: &Generated<S>) -> OperationCount {
    S::OPERATIONS.acceleration
}

/// All scenes.
///
/// # Errors
/// Never, unless a scene lost a parameter.
pub fn all() -> Result<Vec<Case>, Box<dyn Error>> {
    Ok(vec![
        case!(
            "S1",
            "free body, principal axes",
            scenes::free_body()?,
            of_a_body(),
            s1_generated,
            s1_together,
            by_hand::FreeBody::new(),
            s1_by_hand,
            matrices::Body::free(),
            s1_matrices
        ),
        case!(
            "S2",
            "heavy body, O off its centre of mass",
            scenes::heavy_body()?,
            of_a_body(),
            s2_generated,
            s2_together,
            by_hand::HeavyBody::new(),
            s2_by_hand,
            matrices::Body::heavy(),
            s2_matrices
        ),
        case!(
            "S3",
            "body in fluid, full kinetic matrix",
            scenes::immersed()?,
            of_a_body(),
            s3_generated,
            s3_together,
            by_hand::Immersed::new(),
            s3_by_hand,
            matrices::Body::immersed(),
            s3_matrices
        ),
        case!(
            "S4",
            "heavy top, Euler angles",
            scenes::top()?,
            of_the_top(),
            s4_generated,
            s4_together,
            by_hand::Top::new(),
            s4_by_hand,
            matrices::Top::new(),
            s4_matrices
        ),
        case!(
            "S5",
            "double pendulum",
            scenes::double_pendulum()?,
            of_angles::<2>(),
            s5_generated,
            s5_together,
            by_hand::DoublePendulum::new(),
            s5_by_hand,
            matrices::DoublePendulum,
            s5_matrices
        ),
        case!(
            "S6",
            "cart and pole",
            scenes::cart_pole()?,
            of_angles::<2>(),
            s6_generated,
            s6_together,
            by_hand::CartPole::new(),
            s6_by_hand,
            matrices::CartPole,
            s6_matrices
        ),
        case!("S7", "arm of seven joints", scenes::arm()?, of_angles::<7>(), s7_generated, s7_together),
    ])
}
