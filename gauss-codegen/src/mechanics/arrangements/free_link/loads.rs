//! Loads on a free link as wrenches about its O.

use crate::algebra::Expr;
use crate::mechanics::kinematics::coordinate::Coordinate;
use crate::mechanics::kinematics::vector::{Triple, cross, is_zero};
use crate::mechanics::loads::forces::{Action, Element, Force, Loads};
use crate::mechanics::loads::wrench::Wrench;
use crate::mechanics::scene::SystemScene;

use super::FreeLink;

impl<'g> FreeLink<'g> {
    /// The wrench of an element on this link, without what is a uniform field: by what is known of it, by the
    /// derivatives of a potential along the pose, else as the dual of its generalised forces.
    pub fn wrench_of(&self, scene: &SystemScene<'g>, element: &Element<'g>) -> Wrench<'g> {
        let nothing = Wrench::zero(scene.graph);
        if let Some((link, wrench)) = &element.on_link.filter(|_| !matches!(element.action, Action::Field(_))) {
            return if *link == self.link { *wrench } else { nothing };
        }
        match &element.action {
            Action::Potential(potential) => self.of_potential(scene, *potential),
            Action::Forces(forces) => self.of_forces(scene, forces),
            Action::Field(field) => {
                self.of_potential(scene, field.rest).plus(&self.of_forces(scene, &field.loads.forces))
            }
        }
    }

    fn of_potential(&self, scene: &SystemScene<'g>, potential: Expr<'g>) -> Wrench<'g> {
        self.along_pose(scene, potential).unwrap_or_else(|| {
            let power = potential.derivative(&scene.rates);
            self.dual(self.kinematics.speeds.iter().map(|&z| -power.partial(z)).collect())
        })
    }

    fn of_forces(&self, scene: &SystemScene<'g>, forces: &[Force<'g>]) -> Wrench<'g> {
        let nothing = Wrench::zero(scene.graph);
        let wrenches = forces.iter().map(|force| match force {
            Force::OnLink { link, .. } if *link == self.link => force.wrench(&self.kinematics.frame).unwrap_or(nothing),
            Force::OnLink { .. } => self.dual(self.of_block(&scene.tree.loads(&Loads::of_forces(&[*force])))),
            _ => match force.generalised(&scene.tree.links, &scene.speeds, &scene.rates) {
                Some(rows) => self.dual(self.of_block(&rows)),
                None => nothing,
            },
        });
        wrenches.fold(nothing, |sum, wrench| sum.plus(&wrench))
    }

    fn of_block(&self, rows: &[Expr<'g>]) -> Vec<Expr<'g>> {
        self.block.iter().map(|&z| rows[z]).collect()
    }

    /// The wrench with the given generalised forces.
    fn dual(&self, forces: Vec<Expr<'g>>) -> Wrench<'g> {
        if forces.iter().all(|e| e.is_zero()) {
            return Wrench::zero(self.kinematics.frame.graph);
        }
        let pair = self.momentum_pair(&forces);
        Wrench { force: self.vector(self.linear_in, pair.linear), torque: self.vector(self.angular_in, pair.angular) }
    }

    /// Whether the coordinate is its pose.
    pub fn is_placed_by(&self, coordinate: &Coordinate<'g>) -> bool {
        let (rotation, position) = (&self.kinematics.frame.rotation, &self.kinematics.position);
        match coordinate {
            Coordinate::Pose(own, b) => own == rotation && b == position,
            Coordinate::Rotation(own) => own == rotation && is_zero(position),
            _ => false,
        }
    }

    /// The wrench of a potential, where the pose of the link is a coordinate: `−∂U/∂b`, and −∂U along the turns about
    /// the body's axes.
    fn along_pose(&self, scene: &SystemScene<'g>, potential: Expr<'g>) -> Option<Wrench<'g>> {
        let frame = &self.kinematics.frame;
        scene.coordinates.iter().find(|coordinate| self.is_placed_by(coordinate))?;
        let zero = scene.graph.zero();
        let moved = self.kinematics.position.map(|b| if b.is_zero() { zero } else { -potential.partial(b) });
        let by_entries = frame.rotation.map(|row| row.map(|entry| potential.partial(entry)));
        let turned = std::array::from_fn(|axis| {
            let unit: Triple<'g> = std::array::from_fn(|i| if i == axis { scene.graph.one() } else { zero });
            let rates = frame.rotation.map(|row| cross(&row, &unit));
            let terms = by_entries.iter().flatten().zip(rates.iter().flatten()).map(|(d, rate)| *d * *rate);
            -terms.sum::<Expr<'g>>()
        });
        Some(Wrench { force: frame.space_vector(moved), torque: frame.body_vector(turned) })
    }
}
