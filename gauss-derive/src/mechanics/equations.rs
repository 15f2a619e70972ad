//! The equations of a scene for people: momenta, the Gauss condition, forces, and the solved-for form where it is short.

use std::collections::HashMap;

use crate::algebra::{Expr, Notation, Polynomial, print};
use crate::model::Chart;

use super::methods::Scene;

/// Terms up to which a quantity is printed multiplied out.
const LIMIT: usize = 2000;
/// Terms up to which a row is worth reading.
const READABLE: usize = 40;

/// A heading and its lines, in one notation.
pub struct Section {
    pub title: String,
    pub lines: Vec<String>,
}

impl<'g> Scene<'g> {
    /// The equations in one notation, section by section.
    pub fn equations(&self, notation: Notation) -> Vec<Section> {
        let writer = Writer { scene: self, notation };
        let mut sections = vec![
            writer.section("velocity of O and angular velocity", writer.velocities()),
            writer.section("momenta p = dT/dz", writer.momenta()),
            writer.section("Gauss condition (3.4): dp/dt - [Q.(da/dt + v_O x o) + G.do/dt] = R.a + M.o", writer.balance()),
            writer.section("active forces", writer.forces()),
        ];
        if let Some(rows) = writer.velocity_form() {
            sections.push(writer.section("velocity form A dz/dt = r", rows));
        }
        sections
    }
}

struct Writer<'a, 'g> {
    scene: &'a Scene<'g>,
    notation: Notation,
}

impl<'g> Writer<'_, 'g> {
    fn section(&self, title: &str, lines: Vec<String>) -> Section {
        Section { title: title.to_owned(), lines }
    }

    fn show(&self, e: Expr<'g>) -> String {
        let tidy = match e.expand(LIMIT) {
            Some(p) if p.len() <= READABLE => p.collect(),
            _ => e,
        };
        print(tidy, self.notation)
    }

    fn equation(&self, left: &str, right: &str) -> String {
        format!("{left} = {right}")
    }

    fn latex(&self) -> bool {
        self.notation == Notation::Latex
    }

    /// A component of a vector as a name: `Q^1` or `\hat{Q}_{1}`; hatted in observer's axes.
    fn velocities(&self) -> Vec<String> {
        let kinematics = &self.scene.kinematics;
        let mut lines = Vec::new();
        let names = if self.latex() {
            [("u", "\\hat u"), ("\\omega", "\\hat\\omega")]
        } else {
            [("u", "u^"), ("w", "w^")]
        };
        for ((body, space), vector) in names.into_iter().zip([&kinematics.velocity, &kinematics.angular_velocity]) {
            for (name, components) in [(body, vector.body), (space, vector.space)] {
                for (i, component) in components.into_iter().enumerate().filter(|(_, e)| !e.is_zero()) {
                    let name = if self.latex() { format!("{name}_{{{}}}", i + 1) } else { format!("{name}{}", i + 1) };
                    let value = self.show(component);
                    // In its own chart a component is a quasi-velocity: nothing to say.
                    if name.replace(' ', "") != value.replace(' ', "") {
                        lines.push(self.equation(&name, &value));
                    }
                }
            }
        }
        lines
    }

    fn momenta(&self) -> Vec<String> {
        let names = self.momentum_names();
        let momenta = self.scene.momentum();
        names.iter().zip(momenta).map(|(name, p)| self.equation(name, &self.show(p))).collect()
    }

    fn momentum_names(&self) -> Vec<String> {
        let names = &self.scene.kinematics.momentum_names;
        names.iter().map(|(text, latex)| if self.latex() { latex.clone() } else { text.clone() }).collect()
    }

    /// R̂₁ … M₃, or one generalised force a coordinate.
    fn force_names(&self) -> Vec<String> {
        self.momentum_names()
            .iter()
            .map(|name| match self.scene.kinematics.chart {
                Chart::Jet(_) => name.replacen('p', "F", 1),
                _ => name.replace("\\Gamma", "M").replace('G', "M").replace('Q', "R"),
            })
            .collect()
    }

    fn balance(&self) -> Vec<String> {
        let bracket = self.scene.printed_bracket();
        let rows = self.momentum_names().into_iter().zip(self.force_names()).zip(bracket);
        rows.map(|((p, force), bracket)| {
            let rate = if self.latex() { format!("\\frac{{d}}{{dt}} {p}") } else { format!("d{p}/dt") };
            let right = if bracket.expand(LIMIT).is_some_and(|p| p.is_zero()) {
                force
            } else {
                format!("{} + {force}", self.show(bracket))
            };
            self.equation(&rate, &right)
        })
        .collect()
    }

    fn forces(&self) -> Vec<String> {
        let forces = self.scene.generalised_forces();
        self.force_names().iter().zip(forces).map(|(name, f)| self.equation(name, &self.show(f))).collect()
    }

    /// The rows with everything multiplied out; `None` when one would be too long to read.
    fn velocity_form(&self) -> Option<Vec<String>> {
        let kinematics = &self.scene.kinematics;
        let graph = kinematics.frame.graph;
        let residual = self.scene.collected_residual();
        let at_rest: HashMap<u32, Expr<'g>> =
            kinematics.speed_rates.iter().map(|dz| (dz.key(), graph.zero())).collect();
        residual
            .into_iter()
            .map(|row| {
                let still = row.substitute(&at_rest).expand(LIMIT)?;
                let whole = row.expand(LIMIT)?;
                if whole.len() > READABLE {
                    return None;
                }
                let moving = (whole.collect() - still.collect()).expand(LIMIT)?;
                let show = |p: Polynomial<'g>| print(p.collect(), self.notation);
                Some(self.equation(&show(moving), &show((-still.collect()).expand(LIMIT)?)))
            })
            .collect()
    }
}
