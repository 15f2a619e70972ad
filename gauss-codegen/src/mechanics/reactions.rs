//! Reactions of joints: the multipliers of partial velocities that joints do not allow. With a joint let go there are
//! six speeds more, by which what it carries moves along and about its axes; that they stay zero is a constraint, and
//! its multipliers are what the Gauss condition (3.4) for the six lacks at the motion: the force and the torque that
//! hold what the joint carries.
//!
//! What acts on the rate of the joint itself, as a motor or friction does, goes through the joint, and is part of it.
//!
//! Driving forces are the same of one speed, that of a coordinate away from its motion: what the condition lacks there
//! beyond all that acts on the coordinate is the force that drives it, and power is that force times the rate.

use crate::algebra::{Expr, Map, Substitution};

use crate::mechanics::formula::{Arrangements, Formula, Method};
use crate::mechanics::scene::SystemScene;
use crate::mechanics::system::System;
use crate::mechanics::system::elimination::Elimination;

/// A scene with joints and driven coordinates let go: six coordinates and speeds more for each joint, then one for each
/// of these, after all others.
pub struct FreedScene<'g> {
    pub scene: SystemScene<'g>,
    /// Zero for these coordinates and speeds, and for the rates of the speeds.
    pub home: Map<u32, Expr<'g>>,
    /// Rates of the driven coordinates, as the motions have them.
    pub driven: Vec<Expr<'g>>,
}

impl FreedScene<'_> {
    /// Leaves out constraints, by their numbers, that follow from the others.
    pub fn leave_out(&mut self, needless: &[usize]) {
        let mut number = 0..;
        self.scene.constraints.retain(|_| number.next().is_some_and(|k| !needless.contains(&k)));
    }
}

/// The condition for these speeds where they and their coordinates are zero.
pub struct Reactions<'g> {
    /// The system that has them.
    pub system: System<'g>,
    pub home: Map<u32, Expr<'g>>,
    /// ∂C/∂ż for these speeds at any ż of the others, in several ways.
    pub rows: Arrangements<'g>,
    /// The derivatives by these speeds of each constraint, on the level of velocities.
    jacobian: Vec<Vec<Expr<'g>>>,
    /// The same of gaps and slips.
    of_contacts: Vec<Vec<Expr<'g>>>,
    /// Rates of the driven coordinates, whose rows are the last.
    driven: Vec<Expr<'g>>,
}

impl<'g> Reactions<'g> {
    pub fn new(FreedScene { scene, home, driven }: FreedScene<'g>) -> Self {
        let system = System::unsolved(scene);
        let at_home = Substitution::new(home.clone());
        let first = system.scene.speeds.len() - home.len() / 3;
        let of_these = |all: &[Expr<'g>]| all[first..].iter().map(|e| at_home.of(*e)).collect::<Vec<_>>();
        let inertias = system.scene.tree.inertias(false).iter();
        let rows = inertias.map(|&inertia| of_these(&system.residual(&system.along, inertia))).collect();
        let of_all = |rows: &[Vec<Expr<'g>>]| rows.iter().map(|row| of_these(row)).collect();
        let (jacobian, of_contacts) = (of_all(&system.constraints.jacobian), of_all(&system.contacts.jacobian));
        Self { system, home, rows, jacobian, of_contacts, driven }
    }

    /// Whether it has so many constraints and rows of contacts, as with its joints where they are.
    pub fn has(&self, [constraints, rows]: [usize; 2]) -> bool {
        self.jacobian.len() == constraints && self.of_contacts.len() == rows
    }

    /// Change of the forces and torques by unit contact forces, row by row. Multipliers of constraints change with
    /// contact forces, so there must be none.
    pub fn of_contacts(&self) -> Option<Formula<'g>> {
        let rows = 0..self.of_joints();
        let by_rows = rows.flat_map(|k| self.of_contacts.iter().map(move |column| -column[k])).collect::<Vec<_>>();
        let there_are = self.jacobian.is_empty() && !by_rows.is_empty();
        there_are.then(|| Formula { method: Method::ContactReactions, arrangements: vec![by_rows] })
    }

    /// Number of the rows that are forces and torques of joints.
    fn of_joints(&self) -> usize {
        self.rows[0].len() - self.driven.len()
    }

    /// Force and torque of each joint, and the driving force of each motion with its power, with the multipliers of the
    /// constraints in the ways in which they are formed.
    pub fn formulas(
        &self,
        multipliers: &Arrangements<'g>,
        elimination: Option<(&Elimination<'g>, &System<'g>)>,
    ) -> Vec<Formula<'g>> {
        let given = elimination.map(|(elimination, reduced)| Substitution::new(elimination.motion(reduced)));
        let value = |e: Expr<'g>| given.as_ref().map_or(e, |given| given.of(e));
        let held = |rows: &Vec<Expr<'g>>, multipliers: &[Expr<'g>]| -> Vec<Expr<'g>> {
            let force = |k: usize| {
                let terms = self.jacobian.iter().zip(multipliers).map(|(row, l)| value(row[k]) * l.group());
                terms.fold(rows[k].graph().zero(), |sum, e| sum + e)
            };
            (0..rows.len()).map(|k| value(rows[k]) - force(k)).collect()
        };
        let none = [Vec::new()];
        let multipliers = if self.jacobian.is_empty() { &none } else { multipliers.as_slice() };
        let all = self.rows.iter().flat_map(|rows| multipliers.iter().map(|own| held(rows, own)));
        let all: Arrangements<'g> = all.collect();
        let with_power = |forces: &[Expr<'g>]| {
            let of_each = forces.iter().zip(&self.driven).flat_map(|(force, rate)| [*force, force.group() * *rate]);
            of_each.collect::<Vec<_>>()
        };
        let (joints, mut formulas) = (self.of_joints(), Vec::new());
        if joints > 0 {
            let arrangements = all.iter().map(|rows| rows[..joints].to_vec()).collect();
            formulas.push(Formula { method: Method::Reactions, arrangements });
        }
        if !self.driven.is_empty() {
            let arrangements = all.iter().map(|rows| with_power(&rows[joints..])).collect();
            formulas.push(Formula { method: Method::DrivingForces, arrangements });
        }
        formulas
    }
}
