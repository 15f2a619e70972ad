//! Random states, chart-free: a pose and a body twist.

use gauss_runtime::chart::ChartError;
use gauss_runtime::prelude::*;
use proptest::prelude::*;

use super::Bounded;
use super::body::{Body, Parts};

/// Which twists and poses a motion has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Motion {
    /// All.
    Free,
    /// b = 0, u = 0.
    FixedPoint,
    /// In the plane k₁k₂.
    Planar,
}

/// A pose (quaternion x, y, z, w and b), a twist (u, ω), and more random numbers for what a check wants to vary.
#[derive(Clone, Debug)]
pub struct State {
    /// Unit quaternion.
    pub rotation: [f64; 4],
    /// b.
    pub position: [f64; 3],
    /// (u, ω), body axes, pole O.
    pub twist: [f64; 6],
    /// A direction in the space of speeds.
    pub direction: [f64; 6],
}

prop_compose! {
    fn any_state()(
        rotation in prop::array::uniform4(-1.0..1.0_f64)
            .prop_filter("a direction", |q| q.iter().map(|c| c * c).sum::<f64>() > 0.05),
        position in prop::array::uniform3(-3.0..3.0_f64),
        twist in prop::array::uniform6(-2.0..2.0_f64),
        direction in prop::array::uniform6(-1.0..1.0_f64),
    ) -> State {
        State { rotation, position, twist, direction }
    }
}

/// States that the motion has.
pub fn state(motion: Motion) -> impl Strategy<Value = State> {
    any_state()
        .prop_map(move |mut state| {
            match motion {
                Motion::Free => {}
                Motion::FixedPoint => {
                    state.position = [0.0; 3];
                    state.twist[..3].fill(0.0);
                }
                Motion::Planar => {
                    state.rotation[..2].fill(0.0);
                    state.position[2] = 0.0;
                    state.twist[2..5].fill(0.0);
                }
            }
            state
        })
        .prop_filter("a direction", |state| state.rotation.iter().map(|c| c * c).sum::<f64>() > 0.05)
        .prop_map(|mut state| {
            let norm = state.rotation.iter().map(|c| c * c).sum::<f64>().sqrt();
            state.rotation = state.rotation.map(|c| c / norm);
            state
        })
}

impl State {
    /// The pose; the bounds say that the quaternion is of norm 1 up to rounding only.
    pub fn pose(&self) -> Isometry3<Bounded> {
        let rotation = self.rotation.map(|c| Bounded::measured(c, 2.0 * f64::EPSILON * c.abs()));
        let position = self.position.map(|c| Bounded::measured(c, 0.0));
        Isometry3::assemble(&[&rotation[..], &position[..]].concat())
    }

    /// The twist.
    pub fn twist(&self) -> SVector<Bounded, 6> {
        SVector::from(self.twist.map(|c| Bounded::measured(c, 0.0)))
    }

    /// The same state in the variables of a kernel.
    pub fn of<K: Body<Bounded>>(&self, kernel: &K) -> Result<(K::Configuration, K::Speeds), ChartError> {
        let q = kernel.configuration(&self.pose())?;
        let z = kernel.speeds(Bounded::zero(), &q, &self.twist());
        Ok((q, z))
    }
}
