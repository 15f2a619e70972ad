//! Numbers of limbs that are alike.

/// Slot of a number within its limb, and the limb: of numbers with the same `slot` there is one for each limb that is
/// alike, and what is computed of them is alike.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Twin {
    /// Which of the numbers of a limb.
    pub slot: usize,
    /// Which limb, of all limbs of a scene.
    pub limb: usize,
}
