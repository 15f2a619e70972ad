//! What is told of a scene beside its data.

/// What kind of motion it is: the targets differ.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A body that turns about a point without or with weight.
    Top,
    /// A free body in an ideal fluid, without or with weight.
    Fluid,
    /// Everything else.
    Other,
}

impl Kind {
    /// How many times as fast as the best baseline the best method is to be.
    pub fn target(self) -> f64 {
        if self == Self::Other { 3.0 } else { 5.0 }
    }
}

/// What is told of a scene beside its data.
pub struct About {
    /// Short, as on the command line and in the data.
    pub name: &'static str,
    /// For people.
    pub title: &'static str,
    /// What kind of motion.
    pub kind: Kind,
    /// The fastest rate, rad/s: the longest step is about one radian of it.
    pub rate: f64,
    /// What of the final state is compared, where the data have it.
    pub seen: &'static [&'static str],
}

impl About {
    /// Whether the energy is constant.
    pub fn conservative(&self) -> bool {
        self.name != "drag_body"
    }
}
