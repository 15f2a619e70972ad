//! The equations of a system for people.

use super::equations::{Row, Section, tidy};
use super::names::Name;
use super::system::System;

impl<'g> System<'g> {
    /// The equations, section by section; sections with nothing to say are left out.
    pub fn equations(&self) -> Vec<Section<'g>> {
        let scene = &self.scene;
        let p = |name: &Name| Name::new("p", "p").of(name);
        let force = |name: &Name| Name::new("F", "F").of(name);
        let coordinates = scene.coordinate_names.iter().zip(&scene.coordinates).zip(&scene.kinematics);
        let kinematics = coordinates
            .filter(|(_, rate)| !scene.speeds.contains(rate))
            .map(|((name, _), rate)| Row::Definition(name.time_derivative(), tidy(*rate)))
            .collect();
        let momenta = scene.speed_names.iter().zip(self.momentum());
        let momenta = momenta.map(|(name, e)| Row::Definition(p(name), tidy(e))).collect();
        let balance = scene.speed_names.iter().zip(self.bracket());
        let balance = balance
            .map(|(name, bracket)| Row::Balance { momentum: p(name), bracket: tidy(bracket), force: Some(force(name)) })
            .collect();
        let forces = scene.speed_names.iter().zip(self.generalised_forces());
        let forces = forces.map(|(name, e)| Row::Definition(force(name), tidy(e))).collect();
        let titled = |text: &str, latex: &str, rows: Vec<Row<'g>>| Section { title: Name::new(text, latex), rows };
        let mut sections = vec![
            titled("kinematics dq/dt = ψ(t, q, z) (3.2)", "kinematics $\\dot q = \\psi(t, q, z)$ (3.2)", kinematics),
            titled("momenta p = ∂T/∂z", "momenta $p = \\partial T/\\partial z$", momenta),
            titled("Gauss condition (3.4)", "Gauss condition (3.4)", balance),
            titled("active forces (generalised)", "active forces (generalised)", forces),
        ];
        sections.retain(|section| !section.rows.is_empty());
        sections
    }
}
