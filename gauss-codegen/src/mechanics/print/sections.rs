//! The equations of a system for people.

use crate::algebra::{Expr, LONG, Map};

use crate::mechanics::kinematics::coordinate::Coordinate;
use crate::mechanics::name::Name;
use crate::mechanics::print::equations::{PrintedForces, by_entries, velocity_form};
use crate::mechanics::print::readings::PrintSymbols;
use crate::mechanics::print::rows::{PrintedRow, Section};
use crate::mechanics::scene::contact::Contact;
use crate::mechanics::system::System;
use crate::mechanics::tidy::READABLE;

impl<'g> System<'g> {
    /// The equations with p and F of what the author named.
    pub(in crate::mechanics) fn sections(&self, shown: &PrintSymbols<'g>) -> Vec<Section<'g>> {
        let scene = &self.scene;
        let titled =
            |text: &str, latex: &str, rows: Vec<PrintedRow<'g>>| Section { title: Name::new(text, latex), rows };
        let kinematics = titled(
            "kinematics dq/dt = ψ(t, q, z) (3.2)",
            "kinematics $\\dot q = \\psi(t, q, z)$ (3.2)",
            self.rows_of_rates(false, shown),
        );
        let states = titled(
            "states of elements dx/dt = f(t, q, z, input)",
            "states of elements $\\dot x = f(t, q, z, \\text{input})$",
            self.rows_of_rates(true, shown),
        );
        let mut sections = vec![kinematics, states];
        let momenta = scene.momentum_names.iter().zip(self.momentum());
        let momenta = momenta.map(|(name, e)| PrintedRow::Definition(name.clone(), shown.legible(e))).collect();
        let names = scene.momentum_names.iter().zip(&scene.force_names);
        let row = |((momentum, force), bracket): ((&Name, &Name), Expr<'g>)| PrintedRow::Balance {
            momentum: momentum.clone(),
            bracket: shown.legible(bracket),
            force: Some(force.clone()),
        };
        let balance = names.zip(self.bracket()).map(row).collect();
        let printed = PrintedForces::new(self.generalised_forces(), &self.accounts(), &scene.force_names, shown);
        let forces = scene.force_names.iter().zip(printed.rows);
        let forces = forces.map(|(name, e)| PrintedRow::Definition(name.clone(), e)).collect();
        sections.extend([
            titled("momenta p = ∂T/∂z", "momenta $p = \\partial T/\\partial z$", momenta),
            titled("Gauss condition (3.4)", "Gauss condition (3.4)", balance),
            titled("active forces (generalised)", "active forces (generalised)", forces),
        ]);
        sections.extend(printed.sections);
        let constraints = self.constraints.on_velocities.iter();
        let constraints = constraints.map(|e| PrintedRow::Equation(shown.legible(*e), scene.graph.zero())).collect();
        sections.push(self.velocity_form_section(shown));
        sections.push(titled(
            "constraints on velocities (each adds its multiplier times its row of partial derivatives to the forces)",
            "constraints on velocities (each adds its multiplier times its row of partial derivatives to the forces)",
            constraints,
        ));
        sections
    }

    /// A dz/dt = r, if every row is short enough to read; else how long it would be.
    fn velocity_form_section(&self, shown: &PrintSymbols<'g>) -> Section<'g> {
        let without = if self.constraints.is_empty() { "" } else { ", less the forces of constraints" };
        let title = Name::new(
            &format!("velocity form A dz/dt = r{without}"),
            &format!("velocity form $A \\dot z = r${without}"),
        );
        let inertia = self.tree().inertias(self.is_long())[0];
        let residual = self.residual(&self.along, inertia);
        let rates = shown.rates(&self.scene.speed_rates);
        let named: Map<u32, Expr<'g>> =
            self.scene.speed_rates.iter().zip(&rates).map(|(dz, name)| (dz.key(), *name)).collect();
        let row = |row: Expr<'g>| {
            let row = row.substitute(&named);
            let row = match shown.readable(row) {
                Some(whole) => velocity_form(whole, &rates),
                None => by_entries(row, &rates, shown)?,
            };
            // What is longer would be printed in numbered parts.
            row.expressions().iter().all(|(_, side)| side.leaves() <= LONG).then_some(row)
        };
        // To multiply out what is long takes long, and shows that it is.
        let short: Option<Vec<PrintedRow<'g>>> =
            if self.is_long() { None } else { residual.iter().map(|e| row(*e)).collect() };
        let rows = match short {
            Some(rows) => rows,
            None => {
                let terms: f64 = residual.iter().map(|row| row.terms_multiplied_out()).sum();
                let terms = if terms < 1e6 { terms.to_string() } else { format!("{terms:.0e}") };
                let long = format!("left out: a row has more than {LONG} letters, or a part of it {READABLE} terms");
                vec![PrintedRow::Words(format!("{long}; multiplied out all have {terms}, before any cancel"))]
            }
        };
        Section { title, rows }
    }

    /// Gaps, slips and coefficients of friction; then rolling resistance, and dry friction.
    pub(in crate::mechanics) fn contact_sections(&self, shown: &PrintSymbols<'g>) -> [Section<'g>; 3] {
        let gaps = "gaps: none becomes negative; each adds a force that is not negative, and zero where it is open";
        let dry = "dry friction: a force against each slip, of the size f; at rest any force that is not larger";
        let rolling = "rolling resistance: a torque against each slip, of the size ρ times the force of the gap; at rest any \
                       torque that is not larger";
        [(gaps, "μ", "\\mu"), (rolling, "ρ", "\\rho"), (dry, "f", "f")].map(|(title, letter, latex)| {
            let is_of = |contact: &&Contact<'g>| match (contact.gap, contact.rolls_on) {
                (Some(_), _) => letter == "μ",
                (None, Some(_)) => letter == "ρ",
                (None, None) => letter == "f",
            };
            let contacts: Vec<&Contact<'g>> = self.scene.contacts.iter().filter(is_of).collect();
            Self::contact_section(title, (letter, latex), &contacts, shown)
        })
    }

    fn contact_section(
        title: &str,
        (letter, latex): (&str, &str),
        contacts: &[&Contact<'g>],
        shown: &PrintSymbols<'g>,
    ) -> Section<'g> {
        let named = |letter: &str, latex: &str, name: &str| {
            Name::new(letter, latex).of(&Name::new(name, &format!("\\text{{{}}}", name.replace('_', "\\_"))))
        };
        let mut rows = Vec::new();
        for contact in contacts {
            rows.extend(
                contact.gap.map(|gap| PrintedRow::Definition(named("g", "g", &contact.name), shown.legible(gap))),
            );
            let slip = named("s", "s", &contact.name);
            let several = contact.slips.len() > 1;
            rows.extend(contact.slips.iter().enumerate().map(|(k, e)| {
                let name = if several { slip.index(k) } else { slip.clone() };
                PrintedRow::Definition(name, shown.legible(*e))
            }));
            let bound = named(letter, latex, &contact.name);
            let isotropic = contact.friction.iter().all(|e| *e == contact.friction[0]);
            let bounds = &contact.friction[..contact.friction.len().min(if isotropic { 1 } else { 2 })];
            rows.extend(bounds.iter().enumerate().map(|(k, e)| {
                let name = if isotropic { bound.clone() } else { bound.index(k) };
                PrintedRow::Definition(name, shown.legible(*e))
            }));
        }
        Section { title: Name::new(title, title), rows }
    }

    /// Rates that are not speeds themselves: of the states of elements, or of the other coordinates.
    fn rows_of_rates(&self, of_states: bool, shown: &PrintSymbols<'g>) -> Vec<PrintedRow<'g>> {
        let scene = &self.scene;
        let mut rates = scene.kinematics.iter().copied();
        let mut rows = Vec::new();
        for (k, (name, coordinate)) in scene.coordinate_names.iter().zip(&scene.coordinates).enumerate() {
            let is_state = scene.states.contains(&k);
            let (u, omega) = (Name::new("u", "u").of(name), Name::new("ω", "\\omega").of(name));
            let names: Vec<Name> = match coordinate {
                Coordinate::Scalar(_) => vec![name.time_derivative()],
                Coordinate::Rotation(_) => (0..3).map(|i| omega.index(i)).collect(),
                Coordinate::Pose(..) => (0..3).map(|i| u.index(i)).chain((0..3).map(|i| omega.index(i))).collect(),
                Coordinate::Plane { .. } => vec![u.index(0), u.index(1), omega],
            };
            for (name, rate) in names.into_iter().zip(&mut rates) {
                if is_state == of_states && (is_state || !scene.speeds.contains(&rate)) {
                    rows.push(PrintedRow::Definition(name, shown.legible(rate)));
                }
            }
        }
        rows
    }
}
