//! Charts: each one is a choice of ψ in q̇ = ψ(q, z) (3.2) and nothing else.

use crate::algebra::{Expr, Graph, Map};
use crate::model::{Chart, Motion, RotationChart};

use super::names::Name;
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
#[derive(Clone)]
pub struct Kinematics<'g> {
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
    /// Names of the speeds.
    pub speed_names: Vec<Name>,
    /// Names of the coordinates, where the configuration is coordinates.
    pub coordinate_names: Vec<Name>,
    /// Names of the momenta ∂T/∂z.
    pub momentum_names: Vec<Name>,
    /// ψ: the rate of every symbol of the configuration.
    pub rates: Map<u32, Expr<'g>>,
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
    pub fn rates_with_accelerations(&self) -> Map<u32, Expr<'g>> {
        let mut rates = self.rates.clone();
        rates.extend(self.speeds.iter().zip(&self.speed_rates).map(|(z, dz)| (z.key(), *dz)));
        rates
    }

    /// The motion of the body.
    pub fn motion(&self) -> super::vector::Motion<'_, 'g> {
        super::vector::Motion { frame: &self.frame, velocity: &self.velocity, angular_velocity: &self.angular_velocity }
    }

    /// Body axes about which the motion can turn.
    pub fn angular_axes(&self) -> Vec<usize> {
        self.active.iter().filter(|&&k| k >= 3).map(|k| k - 3).collect()
    }

    /// Body axes along which O can move.
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

    fn indexed(&self, name: &Name, indices: &[usize]) -> Triple<'g> {
        let mut triple = [self.graph.zero(); 3];
        for &i in indices {
            triple[i] = self.symbol(&name.index(i));
        }
        triple
    }

    fn symbol(&self, name: &Name) -> Expr<'g> {
        self.graph.symbol(name.text.clone(), name.latex.clone(), false)
    }

    fn build(&self) -> Kinematics<'g> {
        // What the motion leaves free: axes of translation and of rotation.
        let (translations, rotations): (&[usize], &[usize]) = match self.motion {
            Motion::Free => (&[0, 1, 2], &[0, 1, 2]),
            Motion::FixedPoint => (&[], &[0, 1, 2]),
            Motion::Planar => (&[0, 1], &[2]),
        };
        let active = translations.iter().copied().chain(rotations.iter().map(|k| k + 3)).collect();
        let position = self.indexed(&Name::new("b", "b"), translations);
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
            let cos = self.variable("cos(θ)", "\\cos\\vartheta");
            let sin = self.variable("sin(θ)", "\\sin\\vartheta");
            [[cos, -sin, zero], [sin, cos, zero], [zero, zero, one]]
        } else {
            std::array::from_fn(|i| {
                std::array::from_fn(|j| {
                    self.variable(&format!("R{}{}", i + 1, j + 1), &format!("R_{{{}{}}}", i + 1, j + 1))
                })
            })
        };
        let mut configuration: Vec<Expr<'g>> =
            if planar { vec![rotation[0][0], rotation[1][0]] } else { rotation.iter().flatten().copied().collect() };
        configuration.extend(translations.iter().map(|&i| position[i]));

        let (u, omega, q, gamma) =
            (Name::new("u", "u"), Name::new("ω", "\\omega"), Name::new("Q", "Q"), Name::new("Γ", "\\Gamma"));
        // About k₃ = e₃ an angular velocity needs no hat.
        let omega_hat = if planar { omega.clone() } else { omega.hat() };
        let (names, momenta, axes_linear, axes_angular) = match self.chart {
            Chart::LeftInvariant => ([u, omega], [q, gamma], Axes::Body, Axes::Body),
            Chart::RightInvariant => {
                ([Name::new("ξ", "\\xi").hat(), omega_hat], [q.hat(), gamma.hat()], Axes::Space, Axes::Space)
            }
            _ => ([Name::new("b", "b").dot(), omega], [q.hat(), gamma], Axes::Space, Axes::Body),
        };
        let named = |[linear, angular]: [&Name; 2]| -> Vec<Name> {
            let angular = rotations.iter().map(|&i| if planar { angular.clone() } else { angular.index(i) });
            translations.iter().map(|&i| linear.index(i)).chain(angular).collect()
        };
        let speed_names = named([&names[0], &names[1]]);
        let speeds: Vec<Expr<'g>> = speed_names.iter().map(|name| self.symbol(name)).collect();
        let (mut linear, mut angular) = ([zero; 3], [zero; 3]);
        translations.iter().zip(&speeds).for_each(|(&i, z)| linear[i] = *z);
        rotations.iter().zip(&speeds[translations.len()..]).for_each(|(&i, z)| angular[i] = *z);

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
        let mut rates = Map::default();
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
        let momentum_names = named([&momenta[0], &momenta[1]]);
        let kind = match self.motion {
            Motion::Free => ConfigurationKind::Pose,
            Motion::FixedPoint => ConfigurationKind::Rotation,
            Motion::Planar => ConfigurationKind::PlanePose,
        };
        let speed_rates = speed_names.iter().map(|name| self.symbol(&name.rate())).collect();
        Kinematics {
            chart: self.chart,
            kind,
            frame,
            position,
            configuration,
            speeds,
            speed_rates,
            speed_names,
            coordinate_names: Vec::new(),
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
        let mut names: Vec<Name> = translations.iter().map(|&i| Name::new("b", "b").index(i)).collect();
        for name in coordinate_names(chart) {
            coordinates.push(self.symbol(&name));
            names.push(name);
        }
        let speed_names: Vec<Name> = names.iter().map(Name::dot).collect();
        let speeds: Vec<Expr<'g>> = speed_names.iter().map(|name| self.symbol(name)).collect();
        let rates: Map<u32, Expr<'g>> = coordinates.iter().zip(&speeds).map(|(q, z)| (q.key(), *z)).collect();
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
        let momentum_names = names.iter().map(|name| Name::new("p", "p").of(name)).collect();
        let speed_rates = speed_names.iter().map(|name| self.symbol(&name.rate())).collect();
        Kinematics {
            chart: self.chart,
            kind: ConfigurationKind::Coordinates,
            frame,
            position,
            configuration: coordinates,
            speeds,
            speed_rates,
            speed_names,
            coordinate_names: names,
            momentum_names,
            rates,
            velocity,
            angular_velocity,
            active,
        }
    }
}
