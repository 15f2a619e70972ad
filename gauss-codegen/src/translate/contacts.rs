//! What may touch, in symbols: gaps, slips, coefficients.

use crate::error::Result;
use crate::mechanics::{Contact, Tree};
use crate::model::{Expression, Touching};
use crate::terms::LawKind;
use crate::words::Unraw;

use super::shapes::Slips;
use super::translator::Translator;

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
            let dry = matches!(written.touching, Touching::Slip { .. });
            let word = if dry { "bound" } else { "friction" };
            let mut friction = Vec::new();
            for e in &written.friction {
                let value = self.scalar(e, tree)?;
                self.note(LawKind::Friction, (&name, word), e, vec![value]);
                friction.push(value);
            }
            let restitution = coefficient(&written.restitution, LawKind::Restitution, "restitution")?;
            let forms = match &written.touching {
                Touching::Gap { gap, slips } => vec![(Some(self.scalar(gap, tree)?), self.slips(slips, tree)?, None)],
                Touching::Slip { slips, .. } => vec![(None, self.slips(slips, tree)?, None)],
                Touching::Point(contact) => {
                    let forms = self.shape(&name, contact, !friction.is_empty(), tree)?;
                    forms.into_iter().map(|(gap, slips, frame)| (Some(gap), slips, Some(frame))).collect()
                }
                Touching::Range { along, from, to } => {
                    let x = self.scalar(along, tree)?;
                    let limit = |e: &Option<_>| e.as_ref().map(|e| self.scalar(e, tree)).transpose();
                    let (least, most) = (limit(from)?, limit(to)?);
                    if let (Some(e), Some(least), Some(most)) = (from, least, most) {
                        self.note(LawKind::Limits, (&name, ""), e, vec![least, most]);
                    }
                    let gaps = least.map(|least| x - least).into_iter().chain(most.map(|most| most - x));
                    gaps.map(|gap| (Some(gap), Vec::new(), None)).collect()
                }
            };
            if let (Touching::Point(_), Some(e), false) = (&written.touching, written.friction.first(), written.of_file)
                && forms.iter().all(|(_, slips, _)| slips.is_empty())
            {
                self.mistake(
                    e.span,
                    format!("nothing slips along `{name}`, so friction does nothing; remove `friction`"),
                );
            }
            contacts.extend(written.names.iter().zip(forms).map(|(name, (gap, slips, frame))| {
                // Of two coefficients the one of the same tangent.
                let friction = |k: usize| friction.get(k).or(friction.first()).copied();
                let (slips, friction) = slips.into_iter().filter_map(|(k, slip)| Some((slip, friction(k)?))).unzip();
                Contact { name: name.unraw().to_string(), gap, slips, friction, restitution, frame, clause }
            }));
        }
        Ok(contacts)
    }

    fn slips(&self, slips: &[Expression], tree: &Tree<'g>) -> Result<Slips<'g>> {
        slips.iter().enumerate().map(|(k, slip)| Ok((k, self.scalar(slip, tree)?))).collect()
    }
}
