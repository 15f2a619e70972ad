//! The equations of a scene for people: momenta, the Gauss condition, forces, and the solved-for form where it is
//! short.

use crate::algebra::{Expr, Map, Notation, Parts, Substitution, print_parts, print_short};
use crate::mechanics::tidy::LIMIT;

use crate::mechanics::arrangements::free_link::FreeLink;
use crate::mechanics::loads::account::{Account, GRAVITY};
use crate::mechanics::name::Name;
use crate::mechanics::print::readings::{PrintSymbols, Readings};
use crate::mechanics::print::rows::{PrintedRow, Section};
use crate::mechanics::system::System;

/// All sections, with names for what long rows have in common.
pub struct Page<'g> {
    sections: Vec<Section<'g>>,
    parts: Parts<'g>,
}

impl Page<'_> {
    /// Headings, each with its lines.
    pub fn print(&self, notation: Notation) -> Vec<(String, Vec<String>)> {
        let lines = |section: &Section<'_>| section.rows.iter().map(|row| row.print(notation, &self.parts)).collect();
        let mut printed: Vec<(String, Vec<String>)> =
            self.sections.iter().map(|section| (section.title.print(notation).to_owned(), lines(section))).collect();
        let named = print_parts(notation, &self.parts).into_iter().map(|(name, value)| format!("{name} = {value}"));
        let named: Vec<String> = named.collect();
        if !named.is_empty() {
            printed.push(("where".to_owned(), named));
        }
        printed
    }
}

/// Generalised forces for a reader.
pub(in crate::mechanics) struct PrintedForces<'g> {
    /// One for each speed: where one is too long to read, all are sums over the elements, each under its name.
    pub rows: Vec<Expr<'g>>,
    /// Contribution of each element, if they are.
    pub sections: Vec<Section<'g>>,
}

impl<'g> PrintedForces<'g> {
    pub fn new(whole: Vec<Expr<'g>>, accounts: &[Account<'g>], names: &[Name], shown: &PrintSymbols<'g>) -> Self {
        if accounts.len() < 2 || whole.iter().all(|e| shown.readable(*e).is_some()) {
            return Self { rows: whole.into_iter().map(|e| shown.legible(e)).collect(), sections: Vec::new() };
        }
        let row = |(k, whole): (usize, Expr<'g>)| {
            let own = |account: &Account<'g>| match shown.legible(account.forces[k]) {
                force if force.is_zero() || account.name == GRAVITY => force,
                _ => {
                    let name = names[k].of(&element_name(account));
                    whole.graph().symbol(name.text, name.latex, false)
                }
            };
            accounts.iter().map(own).sum()
        };
        let elements = accounts.iter().filter(|account| account.name != GRAVITY);
        let sections = elements.filter_map(|account| element_section(account, names, shown)).collect();
        Self { rows: whole.into_iter().enumerate().map(row).collect(), sections }
    }
}

fn element_name(account: &Account<'_>) -> Name {
    Name::new(&account.name.replace(' ', "_"), &format!("\\text{{{}}}", account.name.replace('_', "\\_")))
}

/// Nothing of an element that does nothing.
fn element_section<'g>(account: &Account<'g>, names: &[Name], shown: &PrintSymbols<'g>) -> Option<Section<'g>> {
    let title = Name::new(&format!("of {}", account.name), &format!("of {}", account.name.replace('_', "\\_")));
    let forces = account.forces.iter().map(|force| shown.legible(*force));
    let there = forces.zip(names).filter(|(force, _)| !force.is_zero());
    let rows: Vec<PrintedRow<'g>> =
        there.map(|(force, name)| PrintedRow::Definition(name.of(&element_name(account)), force)).collect();
    (!rows.is_empty()).then_some(Section { title, rows })
}

impl<'g> System<'g> {
    /// The equations, section by section; sections with nothing to say are left out.
    pub fn equations(&self, readings: &Readings<'g>, replacement: Option<&Substitution<'g>>) -> Page<'g> {
        let shown = &PrintSymbols::new(readings, replacement);
        // One body in a chart has the letters of textbooks, everything else those of its author.
        let mut sections = match self.one_body().and_then(|one| one.posed).filter(|_| self.scene.chart().is_some()) {
            Some(body) => Textbook { system: self, body, shown }.sections(),
            None => self.sections(shown),
        };
        sections.extend(self.contact_sections(shown));
        let rows = sections.iter().flat_map(|section| &section.rows);
        let printed: Vec<Expr<'g>> = rows.flat_map(PrintedRow::expressions).map(|(_, e)| e).collect();
        sections.insert(0, shown.definitions(&printed));
        sections.insert(1, shown.quarter_turns(self.scene.graph));
        sections.retain(|section| !section.rows.is_empty());
        let rows = sections.iter().flat_map(|section| &section.rows);
        let parts = Parts::of(&rows.flat_map(PrintedRow::expressions).collect::<Vec<_>>());
        Page { sections, parts }
    }
}

/// One body with the letters of textbooks.
struct Textbook<'a, 'g> {
    system: &'a System<'g>,
    body: &'a FreeLink<'g>,
    shown: &'a PrintSymbols<'g>,
}

impl<'g> Textbook<'_, 'g> {
    fn sections(&self) -> Vec<Section<'g>> {
        let Self { system, body, shown } = self;
        let names = &system.scene.force_names;
        let forces = PrintedForces::new(body.generalised_forces(), &system.accounts(), names, shown);
        let terms: Vec<_> = body.printed_bracket().into_iter().map(|e| shown.legible(e)).zip(forces.rows).collect();
        let mut sections = vec![Section {
            title: Name::new("velocity of O and angular velocity", "velocity of $O$ and angular velocity"),
            rows: self.velocity_rows(),
        }];
        sections.extend(self.momentum_sections());
        sections.extend([
            Section {
                title: Name::new("Gauss condition (3.4)", "Gauss condition (3.4)"),
                rows: self.balance_rows(&terms),
            },
            Section {
                title: Name::new("active forces (generalised)", "active forces (generalised)"),
                rows: self.force_rows(&terms),
            },
        ]);
        sections.extend(forces.sections);
        sections.extend([Section {
            title: Name::new("velocity form A dz/dt = r", "velocity form $A \\dot z = r$"),
            rows: self.velocity_form_rows(),
        }]);
        sections
    }

    /// Components of the velocities that are not quasi-velocities themselves.
    fn velocity_rows(&self) -> Vec<PrintedRow<'g>> {
        let kinematics = &self.body.kinematics;
        let (u, omega) = (Name::new("u", "u"), Name::new("ω", "\\omega"));
        let mut rows = Vec::new();
        for (name, vector) in [(u, &kinematics.velocity), (omega, &kinematics.angular_velocity)] {
            for (name, components) in [(name.clone(), vector.body), (name.hat(), vector.space)] {
                for (i, component) in components.into_iter().enumerate() {
                    if !component.is_zero() && !kinematics.speeds.contains(&component) {
                        rows.push(PrintedRow::Definition(name.index(i), self.shown.legible(component)));
                    }
                }
            }
        }
        rows
    }

    /// p in terms of z where that is short, else link by link: z → (u, ω) → (Q, Γ) → p.
    fn momentum_sections(&self) -> Vec<Section<'g>> {
        let title = Name::new("momenta p = ∂T/∂z", "momenta $p = \\partial T/\\partial z$");
        let names = self.system.scene.momentum_names.iter().cloned();
        let momenta: Option<Vec<_>> = self.body.momentum().into_iter().map(|e| self.shown.readable(e)).collect();
        let chain = self.body.printed_momenta();
        let coordinates = self.body.in_coordinates;
        if let Some(momenta) = momenta {
            let rows = names.zip(momenta).map(|(name, p)| PrintedRow::Definition(name, p)).collect();
            let mut sections = vec![Section { title, rows }];
            // The balance of a jet chart is written with Γ, which is none of its momenta.
            let axes = self.body.kinematics.angular_axes();
            if coordinates && axes.len() == 3 {
                let gamma = axes.into_iter().map(|i| (Name::new("Γ", "\\Gamma").index(i), chain.angular[i]));
                sections.push(Section {
                    title: Name::new(
                        "angular momentum about O in body axes",
                        "angular momentum about $O$ in body axes",
                    ),
                    rows: gamma.map(|(name, e)| PrintedRow::Definition(name, self.shown.legible(e))).collect(),
                });
            }
            return sections;
        }
        // In a chart where a link is trivial it says x = x.
        let rows = |link: Vec<(Name, Expr<'g>)>| -> Vec<PrintedRow<'g>> {
            link.into_iter()
                .map(|(name, e)| (name, self.shown.legible(e)))
                .filter(|(name, e)| print_short(*e, Notation::Text, 1).is_none_or(|text| text != name.text))
                .map(|(name, e)| PrintedRow::Definition(name, e))
                .collect()
        };
        let components = |linear: Name, angular: Name, six: Vec<Expr<'g>>| -> Vec<(Name, Expr<'g>)> {
            let named = six.into_iter().enumerate().filter(|(k, _)| self.body.kinematics.active.contains(k));
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

    /// dp/dt = [Q·(ȧ + v_O × o) + Γ·ȯ] + force; the terms are bracket and force of every row.
    fn balance_rows(&self, terms: &[(Expr<'g>, Expr<'g>)]) -> Vec<PrintedRow<'g>> {
        let scene = &self.system.scene;
        let names = scene.momentum_names.iter().cloned().zip(scene.force_names.iter().cloned());
        names
            .zip(terms)
            .map(|((momentum, force), &(bracket, value))| {
                let force = (bracket.is_zero() || !value.is_zero()).then_some(force);
                PrintedRow::Balance { momentum, bracket, force }
            })
            .collect()
    }

    /// The forces that the balance names.
    fn force_rows(&self, terms: &[(Expr<'g>, Expr<'g>)]) -> Vec<PrintedRow<'g>> {
        let named = self.system.scene.force_names.iter().cloned().zip(terms);
        let named = named.filter(|(_, (bracket, value))| bracket.is_zero() || !value.is_zero());
        named.map(|(name, (_, value))| PrintedRow::Definition(name, *value)).collect()
    }

    /// The rows, multiplied out where that is short.
    fn velocity_form_rows(&self) -> Vec<PrintedRow<'g>> {
        let rates = &self.body.kinematics.speed_rates;
        let row = |row: Expr<'g>| match self.shown.readable(row) {
            Some(whole) => velocity_form(whole, rates),
            None => {
                let inertia = rates.iter().map(|&dz| self.shown.legible(row.partial(dz)).group_as_is() * dz);
                PrintedRow::Equation(inertia.sum(), self.shown.legible(-row.substitute(&at_rest(rates))))
            }
        };
        self.body.collected_residual().into_iter().map(row).collect()
    }
}

fn at_rest<'g>(rates: &[Expr<'g>]) -> Map<u32, Expr<'g>> {
    rates.iter().map(|dz| (dz.key(), dz.graph().zero())).collect()
}

/// A row that vanishes, with its rates on the left.
pub(in crate::mechanics) fn velocity_form<'g>(row: Expr<'g>, rates: &[Expr<'g>]) -> PrintedRow<'g> {
    let still = row.substitute(&at_rest(rates));
    PrintedRow::Equation((row - still).collected(LIMIT), (-still).collected(LIMIT))
}

/// The same of a row that is long, if entry by entry and on the right it is short.
pub(in crate::mechanics) fn by_entries<'g>(
    row: Expr<'g>,
    rates: &[Expr<'g>],
    shown: &PrintSymbols<'g>,
) -> Option<PrintedRow<'g>> {
    let entries: Option<Vec<Expr<'g>>> =
        rates.iter().map(|&dz| Some(shown.readable(row.partial(dz))?.group_as_is() * dz)).collect();
    let right = shown.readable(-row.substitute(&at_rest(rates)))?;
    Some(PrintedRow::Equation(entries?.into_iter().sum(), right))
}
