//! Contacts in symbols: gaps, slips, coefficients.

use proc_macro2::Ident;

use crate::algebra::Expr;
use crate::error::Result;
use crate::mechanics::{Contact, Tree};
use crate::model::{ContactClause, ContactGeometry, Expression};
use crate::terms::LawKind;
use crate::words::Unraw;

use super::shapes::{ContactForm, FrictionSpec, Slips};
use super::translator::Translator;

/// Coefficients of the friction and the impacts of all contacts of a clause.
struct FrictionCoefficients<'g> {
    friction: Vec<Expr<'g>>,
    restitution: Option<Expr<'g>>,
    rolling: Option<Expr<'g>>,
}

impl<'g> FrictionCoefficients<'g> {
    /// A contact, which is to have a number, and the resistance to rolling on it.
    fn contacts(
        &self,
        clause: usize,
        names: &[Ident],
        form: ContactForm<'g>,
        number: usize,
    ) -> impl Iterator<Item = Contact<'g>> {
        // Of two coefficients the one of the same tangent.
        let of = |k: usize| self.friction.get(k).or(self.friction.first()).copied();
        let drills = form.spin.is_some();
        let slips = form.slips.into_iter().chain(form.spin.map(|spin| (0, spin)));
        let (slips, friction) = slips.filter_map(|(k, slip)| Some((slip, of(k)?))).unzip();
        let mut names = names.iter().map(|name| name.unraw().to_string());
        let (gap, restitution, frame, bodies) = (form.gap, self.restitution, form.frame, form.bodies.clone());
        let name = names.next().unwrap_or_default();
        let contact =
            Contact { name, gap, slips, drills, friction, rolls_on: None, restitution, frame, bodies, clause };
        let rolling = names.next().zip(self.rolling).map(|(name, rho)| {
            let slips: Vec<_> = form.rolls.iter().map(|(_, roll)| *roll).collect();
            let (friction, rolls_on) = (vec![rho; slips.len()], Some(number));
            let (gap, drills, restitution, frame, bodies) = (None, false, None, None, form.bodies);
            Contact { name, gap, slips, drills, friction, rolls_on, restitution, frame, bodies, clause }
        });
        std::iter::once(contact).chain(rolling)
    }
}

impl<'g> Translator<'_, 'g> {
    /// All contacts in the order in which they are written; of a range the lower limit first.
    pub(super) fn contacts(&self, tree: &Tree<'g>) -> Result<Vec<Contact<'g>>> {
        let mut contacts = Vec::new();
        for (clause, written) in self.model.contacts.iter().enumerate() {
            let name = written.names.first().map(|name| name.unraw().to_string()).unwrap_or_default();
            let coefficient = |e: &Option<_>, kind: LawKind, word: &str| {
                let Some(e) = e else { return Ok(None) };
                let value = self.scalar(e, tree)?;
                self.note(kind, (&name, word), e, vec![value]);
                Ok(Some(value))
            };
            let dry = matches!(written.touching, ContactGeometry::Slip { .. });
            let word = if dry { "bound" } else { "friction" };
            let mut friction = Vec::new();
            for e in &written.friction {
                let value = self.scalar(e, tree)?;
                self.note(LawKind::Friction, (&name, word), e, vec![value]);
                friction.push(value);
            }
            let restitution = coefficient(&written.restitution, LawKind::Restitution, "restitution")?;
            let asked = FrictionSpec {
                rubs: !friction.is_empty(),
                drilling: written.drilling.as_ref().map(|e| self.length((&name, "drilling"), e, tree)).transpose()?,
                rolls: written.rolling.is_some(),
            };
            let rolling = coefficient(&written.rolling, LawKind::Friction, "rolling")?;
            let forms = match &written.touching {
                ContactGeometry::Gap { gap, slips, spin, rolls } => {
                    let spin = spin.as_ref().map(|spin| self.scalar(spin, tree)).transpose()?;
                    let spin = asked.drilling.zip(spin).map(|(radius, spin)| radius * spin);
                    let (gap, slips) = (Some(self.scalar(gap, tree)?), self.slips(slips, tree)?);
                    vec![ContactForm { spin, rolls: self.slips(rolls, tree)?, ..ContactForm::new(gap, slips) }]
                }
                ContactGeometry::Slip { slips, .. } => vec![ContactForm::new(None, self.slips(slips, tree)?)],
                ContactGeometry::Point(contact) => self.shape(&name, contact, &asked, tree)?,
                ContactGeometry::Range { along, from, to } => {
                    let x = self.scalar(along, tree)?;
                    let limit = |e: &Option<_>| e.as_ref().map(|e| self.scalar(e, tree)).transpose();
                    let (least, most) = (limit(from)?, limit(to)?);
                    if let (Some(e), Some(least), Some(most)) = (from, least, most) {
                        self.note(LawKind::Limits, (&name, ""), e, vec![least, most]);
                    }
                    let gaps = least.map(|least| x - least).into_iter().chain(most.map(|most| most - x));
                    gaps.map(|gap| ContactForm::new(Some(gap), Vec::new())).collect()
                }
            };
            let forms = forms.into_iter().map(|form| self.named(form, written)).collect::<Vec<_>>();
            self.refuse_idle(&name, written, &forms);
            let coefficients = FrictionCoefficients { friction, restitution, rolling };
            let each = 1 + usize::from(written.rolling.is_some());
            for (names, form) in written.names.chunks(each).zip(forms) {
                contacts.extend(coefficients.contacts(clause, names, form, contacts.len()));
            }
        }
        Ok(contacts)
    }

    /// Adds the names of links of a file.
    fn named(&self, form: ContactForm<'g>, written: &ContactClause) -> ContactForm<'g> {
        let [first, other] = written.links.each_ref().map(|link| link.as_ref().map(|link| link.unraw().to_string()));
        let [own, touched] = form.bodies;
        ContactForm { bodies: [first.or(own), other.or(touched)], ..form }
    }

    /// Notes friction, drilling and rolling of a shape along which nothing moves.
    fn refuse_idle(&self, name: &str, written: &ContactClause, forms: &[ContactForm<'g>]) {
        if written.of_file || !matches!(written.touching, ContactGeometry::Point(_)) {
            return;
        }
        let idle = |of: fn(&ContactForm<'g>) -> bool| forms.iter().all(of);
        let cases = [
            (written.friction.first(), idle(|form| form.slips.is_empty()), "slips along", "friction"),
            (written.drilling.as_ref(), idle(|form| form.spin.is_none()), "spins about the normal of", "drilling"),
            (written.rolling.as_ref(), idle(|form| form.rolls.is_empty()), "rolls along", "rolling"),
        ];
        for (e, idle, what, word) in cases {
            if let Some(e) = e.filter(|_| idle) {
                self.mistake(e.span, format!("nothing {what} `{name}`, so {word} does nothing; remove `{word}`"));
            }
        }
    }

    fn slips(&self, slips: &[Expression], tree: &Tree<'g>) -> Result<Slips<'g>> {
        slips.iter().enumerate().map(|(k, slip)| Ok((k, self.scalar(slip, tree)?))).collect()
    }
}
