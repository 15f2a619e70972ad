//! Numbers of limbs that are alike.

/// What a number is within its limb, and which limb that is: of numbers with the same `slot` there is one for each limb
/// that is alike, and what is computed of them is alike.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Twin {
    /// Which of the numbers of a limb.
    pub slot: usize,
    /// Which limb, of all limbs of a scene.
    pub limb: usize,
}
