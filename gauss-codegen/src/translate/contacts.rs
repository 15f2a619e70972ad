//! What may touch, in symbols: gaps, slips, coefficients.

use crate::algebra::Expr;
use crate::error::Result;
use crate::mechanics::{Contact, Tree, add, cross, dot, subtract};
use crate::model::{Against, Expression, PointContact, Property, Touching};
use crate::terms::{LawKind, Motion};
use crate::words::Unraw;

use super::translator::{Translator, bug};
use super::value::{Local, Value};

type Triple<'g> = [Expr<'g>; 3];

/// Terms that a slip may have while it is seen whether it vanishes.
const LIMIT: usize = 400;

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
                Touching::Point(contact) => {
                    vec![self.point_contact(&name, contact, friction.is_some(), tree)?]
                }
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

    /// Gap and slips of a point, a sphere or a rim.
    fn point_contact(
        &self,
        name: &str,
        contact: &PointContact,
        slides: bool,
        tree: &Tree<'g>,
    ) -> Result<(Expr<'g>, Vec<Expr<'g>>)> {
        let radius = |e: &Option<Expression>, word: &str| match e {
            Some(e) => self.radius((name, word), e, tree),
            None => Ok(self.graph.zero()),
        };
        let position = self.vector(&contact.point, tree)?;
        let own = radius(&contact.radius, "radius")?;
        let (normal, height, along) = match &contact.against {
            Against::Sphere { center, radius: other } => {
                let apart = subtract(&position, &self.vector(center, tree)?);
                let other = radius(other, "other_radius")?;
                return Ok((dot(&apart, &apart).group().sqrt() - own - other, Vec::new()));
            }
            Against::Plane { normal, height, along } => (normal, height, along),
        };
        let n = match normal {
            Some(e) => self.direction((name, "plane"), e, self.vector(e, tree)?),
            None => self.axis(self.upward()),
        };
        let height = height.as_ref().map_or(Ok(self.graph.zero()), |e| self.scalar(e, tree))?;
        // From the point to where it touches: against the normal, of a rim as far as its plane allows.
        let (depth, arm) = match &contact.rim {
            None => (own, n.map(|e| -own * e)),
            Some([rim, axis]) => {
                let local = self.local_point(&contact.point, tree)?;
                let axis = self.direction((name, "axis"), axis, self.vector(axis, tree)?);
                let axis = tree.links[local.link].axes().to_space(&axis).map(Expr::group);
                let rim = self.radius((name, "rim"), rim, tree)?;
                let across = cross(&axis, &n);
                let sine = dot(&across, &across).group().sqrt();
                // n − a (n·a) = (a × n) × a.
                let scale = (-rim * sine.recip()).group();
                (rim * sine, cross(&across.map(Expr::group), &axis).map(|e| scale * e))
            }
        };
        let gap = dot(&n, &position) - height - depth;
        if !slides {
            return Ok((gap, Vec::new()));
        }
        let velocity = match arm.iter().all(|e| e.is_zero()) {
            true => position.map(|e| e.derivative(&self.rates)),
            false => {
                let link = self.local_point(&contact.point, tree)?.link;
                let spin = self.velocity_of(link, Property::AngularVelocity, tree);
                add(&position.map(|e| e.derivative(&self.rates)), &cross(&spin, &arm))
            }
        };
        let first = match along {
            Some(e) => self.tangent((name, "along"), e, self.vector(e, tree)?, &n),
            None => self.usual_tangent(name, normal.as_ref(), &n),
        };
        let slips = [first, cross(&n, &first)].map(|tangent| dot(&tangent, &velocity));
        // Across the plane of a motion nothing slips.
        Ok((gap, slips.into_iter().filter(|slip| !slip.collected(LIMIT).is_zero()).collect()))
    }

    /// The point as a body knows it.
    fn local_point(&self, e: &Expression, tree: &Tree<'g>) -> Result<Local<'g>> {
        match self.value(e, tree)? {
            Value::Local(point) if point.is_point => Ok(point),
            _ => Err(bug(e.span)),
        }
    }

    fn radius(&self, argument: (&str, &str), e: &Expression, tree: &Tree<'g>) -> Result<Expr<'g>> {
        let value = self.scalar(e, tree)?;
        self.note(LawKind::NonNegative, argument, e, vec![value]);
        Ok(value)
    }

    fn axis(&self, k: usize) -> Triple<'g> {
        std::array::from_fn(|i| if i == k { self.graph.one() } else { self.graph.zero() })
    }

    /// The axis against which a scalar gravity points: the third, in plane motion of a chart the second.
    fn upward(&self) -> usize {
        if self.model.in_chart.is_some_and(|chart| chart.motion == Motion::Planar) { 1 } else { 2 }
    }

    /// A vector over its length, which `kernel()` checks to be one.
    fn direction(&self, argument: (&str, &str), e: &Expression, vector: Triple<'g>) -> Triple<'g> {
        let square = dot(&vector, &vector);
        if square == self.graph.one() {
            return vector;
        }
        self.note(LawKind::Direction, argument, e, vec![square]);
        let length = self.divisor(square.group().sqrt(), e.span);
        vector.map(|component| component * length.recip())
    }

    /// What of a vector is normal to n, over its length.
    fn tangent(&self, argument: (&str, &str), e: &Expression, vector: Triple<'g>, n: &Triple<'g>) -> Triple<'g> {
        let along = dot(&vector, n);
        let normal = n.map(|component| along * component);
        self.direction(argument, e, subtract(&vector, &normal))
    }

    /// The axis of the observer after that which is nearest to the normal, made normal to it.
    fn usual_tangent(&self, name: &str, written: Option<&Expression>, n: &Triple<'g>) -> Triple<'g> {
        let nearest = match written.and_then(Expression::literal_components) {
            Some(literal) => (0..3).max_by(|&a: &usize, &b| literal[a].abs().total_cmp(&literal[b].abs())).unwrap_or(2),
            None => self.upward(),
        };
        let axis = self.axis((nearest + 1) % 3);
        match written {
            Some(e) => self.tangent((name, "plane"), e, axis, n),
            None => axis,
        }
    }
}
