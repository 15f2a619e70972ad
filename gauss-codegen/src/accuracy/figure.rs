//! Figures and words for the loss of a program.

/// A loss of which no digit is left.
pub const NO_DIGIT: f64 = 1e16;
/// Round bounds of losses up to that.
const ROUND: [f64; 52] = {
    let mut bounds = [0.0; 52];
    let (mut k, mut power) = (0, 0.1);
    while k < bounds.len() {
        bounds[k] = power
            * if k % 3 == 0 {
                1.0
            } else if k % 3 == 1 {
                2.0
            } else {
                5.0
            };
        k += 1;
        if k % 3 == 0 {
            power *= 10.0;
        }
    }
    bounds
};

/// Loss of a program to rounding, in units of the effect of a change of every input in its last place.
#[derive(Clone, Debug, PartialEq)]
pub struct Figure {
    /// At the worst state that was found.
    pub worst: f64,
    /// In the middle of the sample states.
    pub median: f64,
    /// Words for the differences between the worst state and a sample state.
    pub at: Vec<String>,
}

impl Figure {
    /// Worst and median, up to the next of 1, 2 and 5 times a power of ten.
    pub fn rounded(&self) -> [f64; 2] {
        let round = |loss: f64| ROUND.iter().copied().find(|round| loss <= *round).unwrap_or(NO_DIGIT);
        [round(self.worst), round(self.median)]
    }
}
