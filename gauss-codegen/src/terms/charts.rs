//! Charts of one body, and what their speeds are called where clauses name them.

/// The choice of quasi-velocities, row by row as in equations (2.2)–(2.6).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Chart {
    /// u and ω in body axes, pole O.
    LeftInvariant,
    /// The velocity of the body point at Ω, and ω, in observer axes, pole Ω.
    RightInvariant,
    /// ḃ in observer axes, ω in body axes, pole O.
    Hybrid,
    /// Time derivatives of coordinates.
    Jet(RotationChart),
}

/// Coordinates of the rotation in a jet chart.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RotationChart {
    /// R = R_a(α₀) R_b(α₁) R_c(α₂), axes counted from 0, no two neighbours equal.
    Euler([u8; 3]),
    /// tan(θ/2) n.
    Rodrigues,
    /// tan(θ/4) n.
    ModifiedRodrigues,
    /// θ, the one angle of planar motion.
    Angle,
}

/// Freedom of motion of the body.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Motion {
    /// Six degrees of freedom.
    Free,
    /// O stays at Ω: rotation only.
    FixedPoint,
    /// O stays in the plane k₁k₂ and the body turns about k₃.
    Planar,
}

/// A chart of one body.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BodyChart {
    /// The quasi-velocities that the equations are written in.
    pub chart: Chart,
    /// Freedom of motion of the body.
    pub motion: Motion,
}

impl BodyChart {
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
            Chart::Jet(_) => {
                let words = self.coordinate_words().into_iter().flatten();
                words.map(|word| format!("{word}_dot")).collect()
            }
        }
    }

    /// One word for each coordinate where they are scalars.
    pub fn coordinate_words(self) -> Option<Vec<String>> {
        let Chart::Jet(rotation) = self.chart else { return None };
        let linear = match self.motion {
            Motion::Free => 3,
            Motion::FixedPoint => 0,
            Motion::Planar => 2,
        };
        Some((1..=linear).map(|k| format!("b{k}")).chain(coordinate_words(rotation)).collect())
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
