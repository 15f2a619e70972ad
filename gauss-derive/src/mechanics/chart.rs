//! Charts: each one is a choice of ψ in q̇ = ψ(q, z) (3.2) and nothing else.

use std::collections::HashMap;

use crate::algebra::{Expr, Graph};
use crate::model::{Chart, Motion, RotationChart};

use super::rotation::{coordinate_names, rotation_of};
use super::vector::{Axes, Frame, Triple, Vector, cross_matrix};

/// Where the components of the configuration come from at run time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ConfigurationKind {
    /// `Isometry3`: R as a unit quaternion, b.
    Pose,
    /// `UnitQuaternion`.
    Rotation,
    /// `Isometry2`: cos θ and sin θ, b₁ b₂.
    PlanePose,
    /// `SVector` of coordinates.
    Coordinates,
}

/// The kinematics of one chart.
pub struct Kinematics<'g> {
    pub motion: Motion,
    pub chart: Chart,
    pub kind: ConfigurationKind,
    pub frame: Frame<'g>,
    /// b = O − Ω, observer's components.
    pub position: Triple<'g>,
    /// Symbols of the configuration: nine of R and three of b; cos, sin and two of b; or the coordinates.
    pub configuration: Vec<Expr<'g>>,
    /// The quasi-velocities z and, formally, their rates ż.
    pub speeds: Vec<Expr<'g>>,
    pub speed_rates: Vec<Expr<'g>>,
    /// Names of the momenta ∂T/∂z, text and LaTeX.
    pub momentum_names: Vec<(String, String)>,
    /// ψ: the rate of every symbol of the configuration.
    pub rates: HashMap<u32, Expr<'g>>,
    /// v_O, in the axes of the chart.
    pub velocity: Vector<'g>,
    /// ω, in the axes of the chart.
    pub angular_velocity: Vector<'g>,
    /// The components of the twist of O in body axes, (u, ω), that the motion can have.
    pub active: Vec<usize>,
}

/// Terms that an entry of the angular velocity of a rotation chart may have on the way to its normal form.
const LIMIT: usize = 2000;

impl<'g> Kinematics<'g> {
    pub fn new(graph: &'g Graph, motion: Motion, chart: Chart) -> Self {
        Builder { graph, motion, chart }.build()
    }

    /// ψ together with ż, for derivatives of what depends on z.
    pub fn rates_with_accelerations(&self) -> HashMap<u32, Expr<'g>> {
        let mut rates = self.rates.clone();
        rates.extend(self.speeds.iter().zip(&self.speed_rates).map(|(z, dz)| (z.key(), *dz)));
        rates
    }

    /// The observer's derivative of a vector along the flow with ż = 0.
    pub fn rate_of(&self, a: &Vector<'g>) -> Vector<'g> {
        self.frame.derivative(a, &self.rates, &self.angular_velocity)
    }

    /// The first index of the angular part in `active`.
    pub fn angular_axes(&self) -> Vec<usize> {
        self.active.iter().filter(|&&k| k >= 3).map(|k| k - 3).collect()
    }

    pub fn linear_axes(&self) -> Vec<usize> {
        self.active.iter().copied().filter(|&k| k < 3).collect()
    }
}

struct Builder<'g> {
    graph: &'g Graph,
    motion: Motion,
    chart: Chart,
}

impl<'g> Builder<'g> {
    fn variable(&self, text: &str, latex: &str) -> Expr<'g> {
        self.graph.symbol(text, latex, false)
    }

    fn indexed(&self, name: (&str, &str), indices: &[usize]) -> Triple<'g> {
        let mut triple = [self.graph.zero(); 3];
        for &i in indices {
            triple[i] = self.variable(&format!("{}{}", name.0, i + 1), &format!("{}_{{{}}}", name.1, i + 1));
        }
        triple
    }

    fn build(&self) -> Kinematics<'g> {
        // What the motion leaves free: axes of translation and of rotation.
        let (translations, rotations): (&[usize], &[usize]) = match self.motion {
            Motion::Free => (&[0, 1, 2], &[0, 1, 2]),
            Motion::FixedPoint => (&[], &[0, 1, 2]),
            Motion::Planar => (&[0, 1], &[2]),
        };
        let active = translations.iter().copied().chain(rotations.iter().map(|k| k + 3)).collect();
        let position = self.indexed(("b", "b"), translations);
        match self.chart {
            Chart::Jet(rotation) => self.jet(rotation, translations, position, active),
            _ => self.group(translations, rotations, position, active),
        }
    }

    /// R and b themselves are the configuration; the chart says in which axes, and about which pole, velocities are
    /// taken.
    fn group(
        &self,
        translations: &[usize],
        rotations: &[usize],
        position: Triple<'g>,
        active: Vec<usize>,
    ) -> Kinematics<'g> {
        let (graph, zero, one) = (self.graph, self.graph.zero(), self.graph.one());
        let planar = self.motion == Motion::Planar;
        let rotation: [Triple<'g>; 3] = if planar {
            let cos = self.variable("cos(theta)", "\\cos\\vartheta");
            let sin = self.variable("sin(theta)", "\\sin\\vartheta");
            [[cos, -sin, zero], [sin, cos, zero], [zero, zero, one]]
        } else {
            std::array::from_fn(|i| {
                std::array::from_fn(|j| {
                    self.variable(&format!("R{}{}", i + 1, j + 1), &format!("R_{{{}{}}}", i + 1, j + 1))
                })
            })
        };
        let mut configuration: Vec<Expr<'g>> = if planar {
            vec![rotation[0][0], rotation[1][0]]
        } else {
            rotation.iter().flatten().copied().collect()
        };
        configuration.extend(translations.iter().map(|&i| position[i]));

        let hat = |text: &str, latex: &str| (format!("{text}^"), format!("\\hat{{{latex}}}"));
        let (linear_name, angular_name, linear_momentum, angular_momentum, axes_linear, axes_angular) = match self.chart
        {
            Chart::LeftInvariant => {
                (pair("u", "u"), pair("w", "\\omega"), pair("Q", "Q"), pair("G", "\\Gamma"), Axes::Body, Axes::Body)
            }
            Chart::RightInvariant => {
                let angular = if planar { pair("w", "\\omega") } else { hat("w", "\\omega") };
                (hat("xi", "\\xi"), angular, hat("Q", "Q"), hat("G", "\\Gamma"), Axes::Space, Axes::Space)
            }
            _ => {
                let linear = pair("db", "\\dot b");
                (linear, pair("w", "\\omega"), hat("Q", "Q"), pair("G", "\\Gamma"), Axes::Space, Axes::Body)
            }
        };
        let linear = self.indexed((&linear_name.0, &linear_name.1), translations);
        let angular = if planar {
            [zero, zero, self.variable(&angular_name.0, &angular_name.1)]
        } else {
            self.indexed((&angular_name.0, &angular_name.1), rotations)
        };
        let speeds: Vec<Expr<'g>> =
            translations.iter().map(|&i| linear[i]).chain(rotations.iter().map(|&i| angular[i])).collect();

        let frame = Frame { graph, rotation };
        let vector = |axes: Axes, a: Triple<'g>| match axes {
            Axes::Body => frame.body_vector(a),
            Axes::Space => frame.space_vector(a),
        };
        let angular_velocity = vector(axes_angular, angular);
        let velocity = match self.chart {
            // ξ is the velocity of the body's point at Ω: v_O = ξ + ω × (O − Ω).
            Chart::RightInvariant => {
                let turned = frame.cross(&angular_velocity, &frame.space_vector(position));
                vector(axes_linear, linear).plus(&turned).map(Expr::group)
            }
            _ => vector(axes_linear, linear),
        };
        // ψ: Ṙ = R [ω]× = [ω̂]× R (Poisson), ḃ = v_O.
        let mut rates = HashMap::new();
        let turn = cross_matrix(&angular);
        for (i, row) in rotation.iter().enumerate() {
            for (j, entry) in row.iter().enumerate() {
                let terms = (0..3).map(|k| match axes_angular {
                    Axes::Body => rotation[i][k] * turn[k][j],
                    Axes::Space => turn[i][k] * rotation[k][j],
                });
                let rate: Expr<'g> = terms.sum();
                if configuration.contains(entry) {
                    rates.insert(entry.key(), rate);
                }
            }
        }
        let in_space = frame.resolve(&velocity, Axes::Space);
        for &i in translations {
            rates.insert(position[i].key(), in_space[i]);
        }
        let index = |name: &(String, String), i: usize| (format!("{}{}", name.0, i + 1), format!("{}_{{{}}}", name.1, i + 1));
        let momentum_names = translations
            .iter()
            .map(|&i| index(&linear_momentum, i))
            .chain(rotations.iter().map(|&i| index(&angular_momentum, i)))
            .collect();
        let kind = match self.motion {
            Motion::Free => ConfigurationKind::Pose,
            Motion::FixedPoint => ConfigurationKind::Rotation,
            Motion::Planar => ConfigurationKind::PlanePose,
        };
        let speed_rates = self.speed_rates(&speeds);
        Kinematics {
            motion: self.motion,
            chart: self.chart,
            kind,
            frame,
            position,
            configuration,
            speeds,
            speed_rates,
            momentum_names,
            rates,
            velocity,
            angular_velocity,
            active,
        }
    }

    /// z = q̇ for coordinates q of the configuration space: ω is read off Ṙ = R [ω]×.
    fn jet(
        &self,
        chart: RotationChart,
        translations: &[usize],
        position: Triple<'g>,
        active: Vec<usize>,
    ) -> Kinematics<'g> {
        let graph = self.graph;
        let mut coordinates: Vec<Expr<'g>> = translations.iter().map(|&i| position[i]).collect();
        let mut names: Vec<(String, String)> =
            translations.iter().map(|&i| pair(&format!("b{}", i + 1), &format!("b_{{{}}}", i + 1))).collect();
        for (text, latex) in coordinate_names(chart) {
            coordinates.push(self.variable(text, latex));
            names.push(pair(text, latex));
        }
        let speeds: Vec<Expr<'g>> = names
            .iter()
            .map(|(text, latex)| self.variable(&format!("d{text}"), &format!("\\dot {{{latex}}}")))
            .collect();
        let rates: HashMap<u32, Expr<'g>> = coordinates.iter().zip(&speeds).map(|(q, z)| (q.key(), *z)).collect();
        let rotation = rotation_of(graph, chart, &coordinates[translations.len()..]);
        let spin: [Triple<'g>; 3] = std::array::from_fn(|i| {
            std::array::from_fn(|j| {
                let terms = (0..3).map(|k| rotation[k][i] * rotation[k][j].derivative(&rates));
                terms.sum()
            })
        });
        // RᵀṘ is skew, so its normal form has each component of ω once.
        let omega = [spin[2][1], spin[0][2], spin[1][0]].map(|e| e.collected(LIMIT));
        let frame = Frame { graph, rotation };
        let velocity = frame.space_vector(position.map(|e| e.derivative(&rates)));
        let angular_velocity = frame.body_vector(omega);
        let momentum_names =
            names.iter().map(|(text, latex)| (format!("p_{text}"), format!("p_{{{latex}}}"))).collect();
        let speed_rates = self.speed_rates(&speeds);
        Kinematics {
            motion: self.motion,
            chart: self.chart,
            kind: ConfigurationKind::Coordinates,
            frame,
            position,
            configuration: coordinates,
            speeds,
            speed_rates,
            momentum_names,
            rates,
            velocity,
            angular_velocity,
            active,
        }
    }

    fn speed_rates(&self, speeds: &[Expr<'g>]) -> Vec<Expr<'g>> {
        use crate::algebra::{Notation, print};
        speeds
            .iter()
            .map(|&z| {
                let (text, latex) = (print(z, Notation::Text), print(z, Notation::Latex));
                let text = if text.starts_with('d') { format!("d{text}") } else { format!("d{text}/dt") };
                let latex = latex.strip_prefix("\\dot ").map_or_else(
                    || format!("\\dot {{{latex}}}"),
                    |base| format!("\\ddot {base}"),
                );
                self.variable(&text, &latex)
            })
            .collect()
    }
}

fn pair(text: &str, latex: &str) -> (String, String) {
    (text.to_owned(), latex.to_owned())
}
