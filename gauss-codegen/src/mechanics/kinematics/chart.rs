//! Charts: each one is a choice of ψ in q̇ = ψ(q, z) (3.2) and nothing else. A chart of one body is a system of one
//! link.

use crate::algebra::{Expr, Graph, Map};
use crate::terms::{Chart, Motion, RotationChart};

use crate::mechanics::kinematics::coordinate::Coordinate;
use crate::mechanics::kinematics::motion::Kinematics;
use crate::mechanics::kinematics::rotation::{coordinate_names, rotation_of};
use crate::mechanics::kinematics::turn::Turn;
use crate::mechanics::kinematics::vector::{Axes, Frame, Triple, cross_matrix};
use crate::mechanics::name::Name;

/// The coordinates, speeds and kinematics of one body in a chart.
#[derive(Clone)]
pub struct ChartedBody<'g> {
    chart: Chart,
    pub kinematics: Kinematics<'g>,
    pub coordinates: Vec<Coordinate<'g>>,
    pub coordinate_names: Vec<Name>,
    /// Names of the momenta ∂T/∂z, and of the forces that are dual to z.
    pub momentum_names: Vec<Name>,
    pub force_names: Vec<Name>,
}

/// Terms that an entry of the angular velocity of a rotation chart may have on the way to its normal form.
const LIMIT: usize = 2000;

impl<'g> ChartedBody<'g> {
    pub fn new(graph: &'g Graph, motion: Motion, chart: Chart) -> Self {
        Builder { graph, motion, chart }.build()
    }

    /// R as turns; where something hangs on the body, about single axes, if the chart has such.
    pub fn turns(&self, alone: bool) -> Vec<Turn<'g>> {
        let kinematics = &self.kinematics;
        let frame = &kinematics.frame;
        let linear = kinematics.linear_axes().len();
        let about = |axis: usize, k: usize| match self.coordinates[linear + k] {
            Coordinate::Scalar(angle) => Turn::about(frame.graph, axis, angle, &kinematics.rates),
            _ => unreachable!("coordinates of a jet chart are scalars"),
        };
        match self.chart {
            Chart::Jet(RotationChart::Euler(axes)) if !alone => {
                (0..3).map(|k| about(usize::from(axes[k]), k)).collect()
            }
            Chart::Jet(RotationChart::Angle) if !alone => vec![about(2, 0)],
            _ => {
                let omega = frame.resolve(&kinematics.angular_velocity, Axes::Body).map(Expr::group);
                vec![Turn::given(frame.rotation, omega)]
            }
        }
    }

    /// ψ: the twist (u, ω) of O in body axes for group-valued configurations, else q̇.
    pub fn coordinate_rates(&self) -> Vec<Expr<'g>> {
        let kinematics = &self.kinematics;
        if self.coordinates.iter().any(|q| matches!(q, Coordinate::Scalar(_))) {
            return kinematics.speeds.clone();
        }
        let twist = kinematics.body_twist();
        kinematics.active.iter().map(|&k| twist[k]).collect()
    }
}

/// Names of the speeds and the momenta of a chart; the axes of the linear and of the angular ones.
struct Letters {
    speeds: Vec<Name>,
    momenta: Vec<Name>,
    axes: [Axes; 2],
}

/// (R, M) where the momenta are (Q, Γ), with the same hats.
fn force_name(momentum: &Name) -> Name {
    Name::new(
        &momentum.text.replace('Γ', "M").replace('Q', "R"),
        &momentum.latex.replace("\\Gamma", "M").replace('Q', "R"),
    )
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

    fn build(&self) -> ChartedBody<'g> {
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
    ) -> ChartedBody<'g> {
        let (graph, zero) = (self.graph, self.graph.zero());
        let frame = Frame { graph, rotation: self.rotation() };
        let Letters { speeds: speed_names, momenta: momentum_names, axes: [axes_linear, axes_angular] } =
            self.letters(translations, rotations);
        let speeds: Vec<Expr<'g>> = speed_names.iter().map(|name| self.symbol(name)).collect();
        let (mut linear, mut angular) = ([zero; 3], [zero; 3]);
        translations.iter().zip(&speeds).for_each(|(&i, z)| linear[i] = *z);
        rotations.iter().zip(&speeds[translations.len()..]).for_each(|(&i, z)| angular[i] = *z);

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
        // ψ: Ṙ = R [ω]×, ḃ = v_O.
        let mut rates = self.rates_of_rotation(&frame.rotation, axes_angular, &angular);
        let in_space = frame.resolve(&velocity, Axes::Space);
        for &i in translations {
            rates.insert(position[i].key(), in_space[i]);
        }
        let force_names = momentum_names.iter().map(force_name).collect();
        let rotation = &frame.rotation;
        let coordinate = match self.motion {
            Motion::Free => Coordinate::Pose(*rotation, position),
            Motion::FixedPoint => Coordinate::Rotation(*rotation),
            Motion::Planar => {
                Coordinate::Plane { turn: [rotation[0][0], rotation[1][0]], position: [position[0], position[1]] }
            }
        };
        let speed_rates = speed_names.iter().map(|name| self.symbol(&name.rate())).collect();
        let kinematics = Kinematics { frame, position, speeds, speed_rates, rates, velocity, angular_velocity, active };
        ChartedBody {
            chart: self.chart,
            kinematics,
            coordinates: vec![coordinate],
            coordinate_names: vec![Name::new("O", "O")],
            momentum_names,
            force_names,
        }
    }

    /// R, by its entries; in the plane by cos θ and sin θ.
    fn rotation(&self) -> [Triple<'g>; 3] {
        let (zero, one) = (self.graph.zero(), self.graph.one());
        if self.motion == Motion::Planar {
            let cos = self.variable("cos(θ)", "\\cos\\vartheta");
            let sin = self.variable("sin(θ)", "\\sin\\vartheta");
            return [[cos, -sin, zero], [sin, cos, zero], [zero, zero, one]];
        }
        std::array::from_fn(|i| {
            std::array::from_fn(|j| {
                self.variable(&format!("R{}{}", i + 1, j + 1), &format!("R_{{{}{}}}", i + 1, j + 1))
            })
        })
    }

    /// Names of speeds and momenta, and their axes.
    fn letters(&self, translations: &[usize], rotations: &[usize]) -> Letters {
        let planar = self.motion == Motion::Planar;
        let (u, omega, q, gamma) =
            (Name::new("u", "u"), Name::new("ω", "\\omega"), Name::new("Q", "Q"), Name::new("Γ", "\\Gamma"));
        // About k₃ = e₃ an angular velocity needs no hat.
        let omega_hat = if planar { omega.clone() } else { omega.hat() };
        let (names, momenta, axes) = match self.chart {
            Chart::LeftInvariant => ([u, omega], [q, gamma], [Axes::Body, Axes::Body]),
            Chart::RightInvariant => {
                ([Name::new("ξ", "\\xi").hat(), omega_hat], [q.hat(), gamma.hat()], [Axes::Space, Axes::Space])
            }
            _ => ([Name::new("b", "b").dot(), omega], [q.hat(), gamma], [Axes::Space, Axes::Body]),
        };
        let named = |[linear, angular]: [&Name; 2]| -> Vec<Name> {
            let angular = rotations.iter().map(|&i| if planar { angular.clone() } else { angular.index(i) });
            translations.iter().map(|&i| linear.index(i)).chain(angular).collect()
        };
        Letters { speeds: named(names.each_ref()), momenta: named(momenta.each_ref()), axes }
    }

    /// Ṙ = R [ω]× = [ω̂]× R (Poisson), of the entries that are symbols.
    fn rates_of_rotation(&self, rotation: &[Triple<'g>; 3], axes: Axes, angular: &Triple<'g>) -> Map<u32, Expr<'g>> {
        let moving: Vec<Expr<'g>> = match self.motion {
            Motion::Planar => vec![rotation[0][0], rotation[1][0]],
            _ => rotation.iter().flatten().copied().collect(),
        };
        let mut rates = Map::default();
        let turn = cross_matrix(angular);
        for (i, row) in rotation.iter().enumerate() {
            for (j, entry) in row.iter().enumerate() {
                let terms = (0..3).map(|k| match axes {
                    Axes::Body => rotation[i][k] * turn[k][j],
                    Axes::Space => turn[i][k] * rotation[k][j],
                });
                let rate: Expr<'g> = terms.sum();
                if moving.contains(entry) {
                    rates.insert(entry.key(), rate);
                }
            }
        }
        rates
    }

    /// z = q̇ for coordinates q of the configuration space: ω is read off Ṙ = R [ω]×.
    fn jet(
        &self,
        chart: RotationChart,
        translations: &[usize],
        position: Triple<'g>,
        active: Vec<usize>,
    ) -> ChartedBody<'g> {
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
        let momentum_names: Vec<Name> = names.iter().map(|name| Name::new("p", "p").of(name)).collect();
        let speed_rates = speed_names.iter().map(|name| self.symbol(&name.rate())).collect();
        let kinematics = Kinematics { frame, position, speeds, speed_rates, rates, velocity, angular_velocity, active };
        ChartedBody {
            chart: self.chart,
            kinematics,
            coordinates: coordinates.into_iter().map(Coordinate::Scalar).collect(),
            force_names: names.iter().map(|name| Name::new("F", "F").of(name)).collect(),
            coordinate_names: names,
            momentum_names,
        }
    }
}
