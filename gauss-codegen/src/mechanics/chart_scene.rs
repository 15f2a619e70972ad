//! The body of a chart as a link among others: the configuration as coordinates of a system, ψ in their order, and where the
//! body hangs.

use crate::algebra::{Expr, Map};
use crate::model::{Chart, RotationChart};

use super::chart::{ConfigurationKind, Kinematics};
use super::link::{Matter, Placement};
use super::names::Name;
use super::system::Coordinate;
use super::turn::Turn;
use super::vector::{Axes, is_zero};

impl<'g> Kinematics<'g> {
    /// The same motion where its speeds have these values, as where constraints are solved for some of them.
    pub fn with_speeds(&self, values: &[Expr<'g>]) -> Self {
        if values == self.speeds {
            return self.clone();
        }
        let put: Map<u32, Expr<'g>> = self.speeds.iter().map(|z| z.key()).zip(values.iter().copied()).collect();
        Self {
            speeds: values.to_vec(),
            rates: self.rates.iter().map(|(&key, rate)| (key, rate.substitute(&put))).collect(),
            velocity: self.velocity.map(|e| e.substitute(&put)),
            angular_velocity: self.angular_velocity.map(|e| e.substitute(&put)),
            ..self.clone()
        }
    }

    /// The configuration as coordinates, each with its name.
    pub fn coordinates(&self) -> Vec<(Coordinate<'g>, Name)> {
        let (frame, b) = (&self.frame, self.position);
        let one = |coordinate| vec![(coordinate, Name::new("O", "O"))];
        match self.kind {
            ConfigurationKind::Pose => one(Coordinate::Pose(frame.rotation, b)),
            ConfigurationKind::Rotation => one(Coordinate::Rotation(frame.rotation)),
            ConfigurationKind::PlanePose => {
                one(Coordinate::Plane { turn: [frame.rotation[0][0], frame.rotation[1][0]], position: [b[0], b[1]] })
            }
            ConfigurationKind::Coordinates => {
                let symbols = self.configuration.iter().map(|&q| Coordinate::Scalar(q));
                symbols.zip(self.coordinate_names.iter().cloned()).collect()
            }
        }
    }

    /// ψ as a system has it: rates of scalars, the twist (u, ω) in body axes with pole O of what is an element of a group.
    pub fn coordinate_rates(&self) -> Vec<Expr<'g>> {
        if self.kind == ConfigurationKind::Coordinates {
            return self.speeds.clone();
        }
        let [linear, angular] =
            [&self.velocity, &self.angular_velocity].map(|velocity| self.frame.resolve(velocity, Axes::Body));
        let twist: Vec<Expr<'g>> = linear.into_iter().chain(angular).collect();
        self.active.iter().map(|&k| twist[k]).collect()
    }

    /// The body as a root, with the given matter.
    pub fn placement(&self, matter: Matter<'g>) -> Placement<'g> {
        let in_own_axes = is_zero(&self.velocity.space).then_some(self.velocity.body);
        let of_pose = self.kind != ConfigurationKind::Coordinates;
        Placement {
            matter,
            parent: None,
            position: self.position,
            velocity_in_own_axes: in_own_axes.filter(|_| of_pose),
            turns: self.turns(),
        }
    }

    /// R, as turns about single axes where the chart has such.
    fn turns(&self) -> Vec<Turn<'g>> {
        let graph = self.frame.graph;
        let linear = self.linear_axes().len();
        let about = |axis: usize, k: usize| Turn::about(graph, axis, self.configuration[linear + k], &self.rates);
        match self.chart {
            Chart::Jet(RotationChart::Euler(axes)) => (0..3).map(|k| about(usize::from(axes[k]), k)).collect(),
            Chart::Jet(RotationChart::Angle) => vec![about(2, 0)],
            _ => {
                let omega = self.frame.resolve(&self.angular_velocity, Axes::Body);
                vec![Turn::given(self.frame.rotation, omega)]
            }
        }
    }
}
