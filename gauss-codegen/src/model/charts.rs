//! What the speeds of charts are called where clauses name them.

use super::{Chart, InChart, Motion, RotationChart};

impl InChart {
    /// One word for each speed; those of a vector share theirs.
    pub fn speed_words(self) -> Vec<String> {
        let (linear, angular) = match self.motion {
            Motion::Free => (3, 3),
            Motion::FixedPoint => (0, 3),
            Motion::Planar => (2, 1),
        };
        let named = |word: &str, angular_word: &str| {
            let linear = std::iter::repeat_n(word.to_owned(), linear);
            linear.chain(std::iter::repeat_n(angular_word.to_owned(), angular)).collect()
        };
        match self.chart {
            Chart::LeftInvariant => named("u", "omega"),
            Chart::RightInvariant => named("xi", "omega"),
            Chart::Hybrid => named("b_dot", "omega"),
            Chart::Jet(rotation) => {
                let linear = (1..=linear).map(|k| format!("b{k}"));
                linear.chain(coordinate_words(rotation)).map(|word| format!("{word}_dot")).collect()
            }
        }
    }
}

/// The coordinates of a rotation chart.
fn coordinate_words(chart: RotationChart) -> Vec<String> {
    let numbered = |letter: &str| (1..=3).map(|k| format!("{letter}{k}")).collect();
    let words = |words: [&str; 3]| words.map(str::to_owned).to_vec();
    match chart {
        RotationChart::Euler([first, _, last]) if first == last => words(["phi", "theta", "psi"]),
        RotationChart::Euler(axes) => words(axes.map(|axis| ["phi", "theta", "psi"][usize::from(axis.min(2))])),
        RotationChart::Rodrigues => numbered("g"),
        RotationChart::ModifiedRodrigues => numbered("sigma"),
        RotationChart::Angle => vec!["theta".to_owned()],
    }
}
