//! What may touch, in symbols: gaps, slips, coefficients.

use crate::error::Result;
use crate::mechanics::{Contact, Tree};
use crate::model::Touching;
use crate::terms::LawKind;
use crate::words::Unraw;

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
            let friction = coefficient(&written.friction, LawKind::Friction, "friction")?;
            let restitution = coefficient(&written.restitution, LawKind::Restitution, "restitution")?;
            let forms = match &written.touching {
                Touching::Gap { gap, slips } => {
                    let slips = slips.iter().map(|slip| self.scalar(slip, tree)).collect::<Result<Vec<_>>>()?;
                    vec![(self.scalar(gap, tree)?, slips)]
                }
                Touching::Point(contact) => self.shape(&name, contact, friction.is_some(), tree)?,
                Touching::Range { along, from, to } => {
                    let x = self.scalar(along, tree)?;
                    let limit = |e: &Option<_>| e.as_ref().map(|e| self.scalar(e, tree)).transpose();
                    let (least, most) = (limit(from)?, limit(to)?);
                    if let (Some(e), Some(least), Some(most)) = (from, least, most) {
                        self.note(LawKind::Limits, (&name, ""), e, vec![least, most]);
                    }
                    let gaps = least.map(|least| x - least).into_iter().chain(most.map(|most| most - x));
                    gaps.map(|gap| (gap, Vec::new())).collect()
                }
            };
            if let (Touching::Point(_), Some(e)) = (&written.touching, &written.friction)
                && forms.iter().all(|(_, slips)| slips.is_empty())
            {
                self.mistake(
                    e.span,
                    format!("nothing slips along `{name}`, so friction does nothing; remove `friction`"),
                );
            }
            contacts.extend(written.names.iter().zip(forms).map(|(name, (gap, slips))| Contact {
                name: name.unraw().to_string(),
                gap,
                slips,
                friction,
                restitution,
                clause,
            }));
        }
        Ok(contacts)
    }
}
