//! The equations of a scene for people: momenta, the Gauss condition, forces, and the solved-for form where it is short.

use crate::algebra::{Expr, Map, Notation, Polynomial, print};
use crate::model::Chart;

use super::methods::Scene;
use super::names::Name;

/// Terms up to which a quantity is multiplied out to see how long it is.
const LIMIT: usize = 400;
/// Terms up to which a row is worth reading.
const READABLE: usize = 24;

/// One line.
pub enum Row<'g> {
    /// name = value.
    Definition(Name, Expr<'g>),
    /// d(momentum)/dt = bracket + force.
    Balance { momentum: Name, bracket: Expr<'g>, force: Name },
    /// left = right.
    Equation(Expr<'g>, Expr<'g>),
}

impl Row<'_> {
    pub fn print(&self, notation: Notation) -> String {
        let name = |name: &Name| if notation == Notation::Latex { name.latex.clone() } else { name.text.clone() };
        match self {
            Row::Definition(left, right) => format!("{} = {}", name(left), print(*right, notation)),
            Row::Balance { momentum, bracket, force } => {
                let (rate, force) = (name(&momentum.time_derivative()), name(force));
                if bracket.is_zero() {
                    format!("{rate} = {force}")
                } else {
                    format!("{rate} = {} + {force}", print(*bracket, notation))
                }
            }
            Row::Equation(left, right) => format!("{} = {}", print(*left, notation), print(*right, notation)),
        }
    }
}

/// A heading and its rows.
pub struct Section<'g> {
    pub title: Name,
    pub rows: Vec<Row<'g>>,
}

/// The normal form of an expression if it is short enough to read.
pub(super) fn readable<'g>(e: Expr<'g>) -> Option<Polynomial<'g>> {
    e.expand(LIMIT).filter(|p| p.len() <= READABLE)
}

/// An expression as a reader wants it.
pub(super) fn tidy(e: Expr<'_>) -> Expr<'_> {
    readable(e).map_or(e, |p| p.collect())
}

impl<'g> Scene<'g> {
    /// The equations, section by section; sections with nothing to say are left out.
    pub fn equations(&self) -> Vec<Section<'g>> {
        let mut sections = vec![Section {
            title: Name::new("velocity of O and angular velocity", "velocity of $O$ and angular velocity"),
            rows: self.velocity_rows(),
        }];
        sections.extend(self.momentum_sections());
        sections.extend([
            Section { title: Name::new("Gauss condition (3.4)", "Gauss condition (3.4)"), rows: self.balance_rows() },
            Section {
                title: Name::new("active forces (generalised)", "active forces (generalised)"),
                rows: self.force_rows(),
            },
            Section {
                title: Name::new("velocity form A dz/dt = r", "velocity form $A \\dot z = r$"),
                rows: self.velocity_form_rows().unwrap_or_default(),
            },
        ]);
        sections.retain(|s| !s.rows.is_empty());
        sections
    }

    /// Components of the velocities that are not quasi-velocities themselves.
    fn velocity_rows(&self) -> Vec<Row<'g>> {
        let kinematics = &self.kinematics;
        let (u, omega) = (Name::new("u", "u"), Name::new("ω", "\\omega"));
        let mut rows = Vec::new();
        for (name, vector) in [(u, &kinematics.velocity), (omega, &kinematics.angular_velocity)] {
            for (name, components) in [(name.clone(), vector.body), (name.hat(), vector.space)] {
                for (i, component) in components.into_iter().enumerate() {
                    if !component.is_zero() && !kinematics.speeds.contains(&component) {
                        rows.push(Row::Definition(name.index(i), tidy(component)));
                    }
                }
            }
        }
        rows
    }

    /// p in terms of z where that is short, else link by link: z → (u, ω) → (Q, Γ) → p.
    fn momentum_sections(&self) -> Vec<Section<'g>> {
        let title = Name::new("momenta p = ∂T/∂z", "momenta $p = \\partial T/\\partial z$");
        let names = self.kinematics.momentum_names.iter().cloned();
        let momenta: Option<Vec<_>> = self.momentum().into_iter().map(readable).collect();
        if let Some(momenta) = momenta {
            let rows = names.zip(momenta).map(|(name, p)| Row::Definition(name, p.collect())).collect();
            return vec![Section { title, rows }];
        }
        let chain = self.printed_momenta();
        // In a chart where a link is trivial it says x = x.
        let rows = |link: Vec<(Name, Expr<'g>)>| -> Vec<Row<'g>> {
            link.into_iter()
                .map(|(name, e)| (name, tidy(e)))
                .filter(|(name, e)| print(*e, Notation::Text) != name.text)
                .map(|(name, e)| Row::Definition(name, e))
                .collect()
        };
        let components = |linear: Name, angular: Name, six: Vec<Expr<'g>>| -> Vec<(Name, Expr<'g>)> {
            let named = six.into_iter().enumerate().filter(|(k, _)| self.kinematics.active.contains(k));
            named.map(|(k, e)| (if k < 3 { &linear } else { &angular }.index(k % 3), e)).collect()
        };
        let twist = components(Name::new("u", "u"), Name::new("ω", "\\omega"), chain.twist.to_vec());
        let momentum = chain.linear.into_iter().chain(chain.angular).collect();
        let momentum = components(Name::new("Q", "Q"), Name::new("Γ", "\\Gamma"), momentum);
        vec![
            Section { title: Name::new("twist of O in body axes", "twist of $O$ in body axes"), rows: rows(twist) },
            Section {
                title: Name::new("momentum about O in body axes", "momentum about $O$ in body axes"),
                rows: rows(momentum),
            },
            Section { title, rows: rows(names.zip(chain.conjugate).collect()) },
        ]
    }

    /// dp/dt = [Q·(ȧ + v_O × o) + Γ·ȯ] + force.
    fn balance_rows(&self) -> Vec<Row<'g>> {
        let names = self.kinematics.momentum_names.iter().cloned().zip(self.force_names());
        names
            .zip(self.printed_bracket())
            .map(|((momentum, force), bracket)| Row::Balance { momentum, bracket: tidy(bracket), force })
            .collect()
    }

    fn force_rows(&self) -> Vec<Row<'g>> {
        let forces = self.generalised_forces().into_iter().map(tidy);
        self.force_names().into_iter().zip(forces).map(|(name, f)| Row::Definition(name, f)).collect()
    }

    /// The rows with everything multiplied out; `None` when one would be too long to read.
    fn velocity_form_rows(&self) -> Option<Vec<Row<'g>>> {
        let zero = self.kinematics.frame.graph.zero();
        let at_rest: Map<u32, Expr<'g>> = self.kinematics.speed_rates.iter().map(|dz| (dz.key(), zero)).collect();
        self.collected_residual()
            .into_iter()
            .map(|row| {
                let whole = readable(row)?.collect();
                let still = whole.substitute(&at_rest);
                Some(Row::Equation((whole - still).collected(LIMIT), (-still).collected(LIMIT)))
            })
            .collect()
    }

    /// R̂ and M where the momenta are Q̂ and Γ; F_θ where they are p_θ.
    fn force_names(&self) -> Vec<Name> {
        let renamed = |name: &Name| match self.kinematics.chart {
            Chart::Jet(_) => Name::new(&name.text.replacen('p', "F", 1), &name.latex.replacen('p', "F", 1)),
            _ => Name::new(
                &name.text.replace('Γ', "M").replace('Q', "R"),
                &name.latex.replace("\\Gamma", "M").replace('Q', "R"),
            ),
        };
        self.kinematics.momentum_names.iter().map(renamed).collect()
    }
}
