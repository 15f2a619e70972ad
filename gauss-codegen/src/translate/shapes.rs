//! Points, spheres, ellipsoids, rims, boxes, capsules and cylinders against planes, grounds, spheres and capsules:
//! their gaps and slips.

use crate::algebra::{Expr, Substitution};
use crate::error::Result;
use crate::mechanics::{ContactFrame, Tree, add, cross, dot, subtract};
use crate::model::{BodyClause, Copies, Counterpart, Expression, ExpressionKind, PointContact, Property};
use crate::terms::{LawKind, Motion};
use crate::words::Unraw;
use proc_macro2::Span;

use super::translator::{Translator, bug};
use super::value::Value;
use super::values::clamped;

type Triple<'g> = [Expr<'g>; 3];

/// Terms that a slip may have while it is seen whether it vanishes.
const LIMIT: usize = 400;

/// Slips with the number of their tangent.
pub(super) type Slips<'g> = Vec<(usize, Expr<'g>)>;

/// Gap, slips and place of a contact.
pub(super) struct ContactForm<'g> {
    pub(super) gap: Option<Expr<'g>>,
    pub(super) slips: Slips<'g>,
    /// The angular velocity about the normal, times the radius of drilling.
    pub(super) spin: Option<Expr<'g>>,
    /// Angular velocities about the tangents.
    pub(super) rolls: Slips<'g>,
    /// Point and axes, if these are known.
    pub(super) frame: Option<ContactFrame<'g>>,
    /// Names of the bodies that touch, where they are known.
    pub(super) bodies: [Option<String>; 2],
}

impl<'g> ContactForm<'g> {
    /// A contact without drilling and rolling, of which no more is known.
    pub(super) fn new(gap: Option<Expr<'g>>, slips: Slips<'g>) -> Self {
        Self { gap, slips, spin: None, rolls: Vec::new(), frame: None, bodies: [None, None] }
    }
}

/// Friction that a contact is to have.
pub(super) struct FrictionSpec<'g> {
    pub(super) rubs: bool,
    /// The radius of drilling.
    pub(super) drilling: Option<Expr<'g>>,
    pub(super) rolls: bool,
}

/// A place of a shape.
struct ShapePoint<'g> {
    position: Triple<'g>,
    /// The body that has it, where that is known.
    link: Option<usize>,
    /// The name of that body or frame.
    body: Option<String>,
}

/// Surface about each place of a shape.
enum Surface<'g> {
    /// A sphere of this radius.
    Sphere(Expr<'g>),
    /// A circle of this radius about an axis of length one, in the axes of the body.
    Rim(Expr<'g>, Triple<'g>),
    /// An ellipsoid of these semi-axes along the axes of the body; where it is written.
    Ellipsoid(Triple<'g>, Span),
}

/// Counterpart of a place.
struct GapFrame<'g> {
    /// Distance of the counterpart.
    gap: Expr<'g>,
    /// Out of it, of length one.
    normal: Triple<'g>,
    /// None without friction.
    tangents: Vec<Triple<'g>>,
    /// Velocity of the point of it that is touched.
    velocity: Triple<'g>,
    /// The body that is touched, where it turns.
    link: Option<usize>,
}

/// [`GapFrame`] as a function of the place.
type GapFunction<'a, 'g> = Box<dyn Fn(&ShapePoint<'g>) -> GapFrame<'g> + 'a>;

impl<'g> Translator<'_, 'g> {
    /// Gap and slips of each part of a shape; no slips unless it `rubs`.
    pub(super) fn shape(
        &self,
        name: &str,
        contact: &PointContact,
        asked: &FrictionSpec<'g>,
        tree: &Tree<'g>,
    ) -> Result<Vec<ContactForm<'g>>> {
        let rubs = asked.rubs;
        let about = self.about(name, contact, tree)?;
        let parts = self.parts_of(name, contact, &about, tree)?;
        let opposite = match &contact.against {
            Counterpart::Plane { normal, height, along } => {
                self.plane(name, [normal.as_ref(), height.as_ref(), along.as_ref()], rubs, tree)?
            }
            Counterpart::Ground(height) => self.ground(height, rubs, tree)?,
            Counterpart::Sphere { center, end, radius, along } => {
                let radius = self.length_or_zero((name, "other_radius"), radius.as_ref(), tree)?;
                let axis = end.as_ref().map(|end| self.axis_of_capsule([center, end], tree)).transpose()?;
                self.sphere(name, (center, axis, radius), along.as_ref().filter(|_| rubs), tree)?
            }
        };
        let touched = match &contact.against {
            Counterpart::Sphere { center, .. } => self.owner(center),
            Counterpart::Plane { .. } | Counterpart::Ground(_) => None,
        };
        let facing: Vec<(&ShapePoint<'g>, GapFrame<'g>)> = parts.iter().map(|part| (part, opposite(part))).collect();
        if let Some([rim, _]) = &contact.rim {
            self.refuse_flat((name, rim), &about, &facing, tree);
        }
        let form = |(part, facing): &(&ShapePoint<'g>, GapFrame<'g>)| {
            let form = self.touch((part, &about), facing, asked, tree)?;
            Ok(ContactForm { bodies: [part.body.clone(), touched.clone()], ..form })
        };
        facing.iter().map(form).collect()
    }

    /// The name of the body or frame that a point is fixed in, if it is one of such.
    fn owner(&self, point: &Expression) -> Option<String> {
        let owner = match &point.kind {
            ExpressionKind::Name(name) => &self.model.points.iter().find(|own| own.name == *name)?.body,
            ExpressionKind::Property(owner, Property::Position) => match &owner.kind {
                ExpressionKind::Name(name) => name,
                _ => return None,
            },
            _ => return None,
        };
        let word = owner.unraw().to_string();
        let is_body = |body: &BodyClause| body.name.as_ref().is_some_and(|name| name.unraw() == word);
        self.model.bodies.iter().any(is_body).then_some(word)
    }

    /// Surface about each place of a shape.
    fn about(&self, name: &str, contact: &PointContact, tree: &Tree<'g>) -> Result<Surface<'g>> {
        if let Some(semi_axes) = &contact.semi_axes {
            let mut lengths = [self.graph.zero(); 3];
            for (length, e) in lengths.iter_mut().zip(semi_axes) {
                *length = self.scalar(e, tree)?;
                self.note(LawKind::Length, (name, "semi_axes"), e, vec![*length]);
            }
            return Ok(Surface::Ellipsoid(lengths, semi_axes[0].span));
        }
        Ok(match &contact.rim {
            None => Surface::Sphere(self.length_or_zero((name, "radius"), contact.radius.as_ref(), tree)?),
            Some([rim, axis]) => {
                let axis = self.direction((name, "axis"), axis, self.vector(axis, tree)?);
                Surface::Rim(self.length((name, "rim"), rim, tree)?, axis)
            }
        })
    }

    /// The places of a shape.
    fn parts_of(
        &self,
        name: &str,
        contact: &PointContact,
        about: &Surface<'g>,
        tree: &Tree<'g>,
    ) -> Result<Vec<ShapePoint<'g>>> {
        let first = self.part_at(&contact.point, tree)?;
        // Half of a length along a direction in the axes of the body, in those of the observer.
        let half = |direction: Triple<'g>, (word, length): (&str, &Expression)| {
            let half = self.length((name, word), length, tree)? * self.graph.integer(2).recip();
            let link = first.link.ok_or_else(|| bug(contact.point.span))?;
            Ok(tree.links[link].axes().to_space(&direction.map(|e| half * e)).map(Expr::group))
        };
        let steps: Vec<Triple<'g>> = match (&contact.copies, about) {
            (Copies::Ends(end), _) => return Ok(vec![first, self.part_at(end, tree)?]),
            (Copies::Corners(edges), _) => {
                let edges = edges.iter().enumerate().filter(|(_, edge)| !Copies::is_flat(edge));
                edges.map(|(k, edge)| half(self.axis(k), ("edges", edge))).collect::<Result<_>>()?
            }
            (Copies::Rims(length), Surface::Rim(_, axis)) => vec![half(*axis, ("length", length))?],
            _ => Vec::new(),
        };
        let corner = |number: usize| {
            let sides = steps.iter().enumerate().fold(first.position, |sum, (bit, step)| match number >> bit & 1 {
                0 => subtract(&sum, step),
                _ => add(&sum, step),
            });
            ShapePoint { position: sides, link: first.link, body: first.body.clone() }
        };
        Ok((0..1 << steps.len()).map(corner).collect())
    }

    fn part_at(&self, point: &Expression, tree: &Tree<'g>) -> Result<ShapePoint<'g>> {
        let link = match self.value(point, tree)? {
            Value::Local(local) if local.is_point => Some(local.link),
            _ => None,
        };
        Ok(ShapePoint { position: self.vector(point, tree)?, link, body: self.owner(point) })
    }

    /// A rim whose axis is always normal to the plane.
    fn refuse_flat(
        &self,
        (name, rim): (&str, &Expression),
        about: &Surface<'g>,
        facing: &[(&ShapePoint<'g>, GapFrame<'g>)],
        tree: &Tree<'g>,
    ) {
        let Surface::Rim(_, axis) = about else { return };
        let is_flat = |(part, facing): &(&ShapePoint<'g>, GapFrame<'g>)| {
            part.link.is_some_and(|link| {
                let across = cross(&tree.links[link].axes().to_space(axis), &facing.normal);
                self.vanishes(dot(&across, &across))
            })
        };
        if facing.iter().any(is_flat) {
            self.mistake(
                rim.span,
                format!(
                    "`{name}` always lies flat, where no point of its rim is the lowest; write points of the rim, or \
                     `cylinders = 8` in the `ground(…)` of a robot's file"
                ),
            );
        }
    }

    /// Gap and slips of one part.
    fn touch(
        &self,
        (part, about): (&ShapePoint<'g>, &Surface<'g>),
        facing: &GapFrame<'g>,
        asked: &FrictionSpec<'g>,
        tree: &Tree<'g>,
    ) -> Result<ContactForm<'g>> {
        let n = &facing.normal;
        // From the point to where it touches: against the normal, of a rim as far as its plane allows, of an ellipsoid
        // to where the normal is its own.
        let (depth, arm) = match about {
            Surface::Sphere(radius) => (*radius, n.map(|e| -*radius * e)),
            Surface::Rim(rim, axis) => {
                let link = part.link.ok_or_else(|| bug(self.model.item.ident.span()))?;
                let axis = tree.links[link].axes().to_space(axis).map(Expr::group);
                let across = cross(&axis, n);
                let sine = dot(&across, &across).group().sqrt();
                // n − a (n·a) = (a × n) × a.
                let scale = (-*rim * sine.recip()).group();
                (*rim * sine, cross(&across.map(Expr::group), &axis).map(|e| scale * e))
            }
            Surface::Ellipsoid(semi_axes, span) => {
                let link = part.link.ok_or_else(|| bug(*span))?;
                let axes = tree.links[link].axes();
                // A unit sphere, stretched: its point −S n/|S n|, S n the normal times the semi-axes, is stretched too.
                let n = axes.to_body(n);
                let stretched: Triple<'g> = std::array::from_fn(|k| (semi_axes[k] * n[k]).group());
                let depth = self.divisor(dot(&stretched, &stretched).group().sqrt(), *span);
                let scale = (-depth.recip()).group();
                (depth, axes.to_space(&std::array::from_fn(|k| scale * semi_axes[k] * stretched[k])).map(Expr::group))
            }
        };
        let gap = Some(facing.gap - depth);
        let mut frame = ContactFrame { point: add(&part.position, &arm), axes: vec![*n] };
        if facing.tangents.is_empty() {
            return Ok(ContactForm { frame: Some(frame), ..ContactForm::new(gap, Vec::new()) });
        }
        let velocity = subtract(&self.velocity_at(part, &arm, tree), &facing.velocity);
        let slips = facing.tangents.iter().map(|tangent| dot(tangent, &velocity));
        // Across the plane of a motion nothing slips.
        let slips: Slips<'g> = slips.enumerate().filter(|(_, slip)| !self.says_nothing(*slip, LIMIT)).collect();
        frame.axes.extend(slips.iter().map(|(k, _)| facing.tangents[*k]));
        let (spin, rolls) = self.turns([part.link, facing.link], facing, asked, tree);
        Ok(ContactForm { gap, slips, spin, rolls, frame: Some(frame), bodies: [None, None] })
    }

    /// The rates of drilling and rolling of a body on another one, as far as they are asked for and do not vanish.
    fn turns(
        &self,
        links: [Option<usize>; 2],
        facing: &GapFrame<'g>,
        asked: &FrictionSpec<'g>,
        tree: &Tree<'g>,
    ) -> (Option<Expr<'g>>, Slips<'g>) {
        if asked.drilling.is_none() && !asked.rolls {
            return (None, Vec::new());
        }
        let still = [self.graph.zero(); 3];
        let [own, other] =
            links.map(|link| link.map_or(still, |link| self.velocity_of(link, Property::AngularVelocity, tree)));
        let relative = subtract(&own, &other);
        let turns = |rate: &Expr<'g>| !self.says_nothing(*rate, LIMIT);
        let spin = asked.drilling.map(|radius| radius * dot(&facing.normal, &relative)).filter(turns);
        let tangents = facing.tangents.iter().filter(|_| asked.rolls);
        let rolls = tangents.map(|tangent| dot(tangent, &relative)).enumerate().filter(|(_, rate)| turns(rate));
        (spin, rolls.collect())
    }

    /// The velocity of the point of a body that is an arm away from a part; what is in no body does not turn.
    fn velocity_at(&self, part: &ShapePoint<'g>, arm: &Triple<'g>, tree: &Tree<'g>) -> Triple<'g> {
        let velocity = part.position.map(|e| e.derivative(&self.rates));
        match part.link {
            Some(link) if !arm.iter().all(|e| e.is_zero()) => {
                add(&velocity, &cross(&self.velocity_of(link, Property::AngularVelocity, tree), arm))
            }
            _ => velocity,
        }
    }

    /// A plane by its normal, its height and its first tangent.
    fn plane<'a>(
        &'a self,
        name: &str,
        [normal, height, along]: [Option<&Expression>; 3],
        rubs: bool,
        tree: &Tree<'g>,
    ) -> Result<GapFunction<'a, 'g>> {
        let n = match normal {
            Some(e) => self.direction((name, "plane"), e, self.vector(e, tree)?),
            None => self.axis(self.upward()),
        };
        let height = height.map_or(Ok(self.graph.zero()), |e| self.scalar(e, tree))?;
        let first = match along {
            _ if !rubs => None,
            Some(e) => Some(self.tangent((name, "along"), e, self.vector(e, tree)?, &n)),
            None => Some(self.usual_tangent(name, normal, &n)),
        };
        let tangents = first.map_or(Vec::new(), |first| vec![first, cross(&n, &first)]);
        Ok(Box::new(move |part| {
            let gap = dot(&n, &part.position) - height;
            GapFrame { gap, normal: n, tangents: tangents.clone(), velocity: [self.graph.zero(); 3], link: None }
        }))
    }

    /// The ground below a height h over the horizontal place; its points move upward where h depends on time. Of
    /// a point at z, `(z − h)/√(1 + |∂h|²)` vanishes where the distance does, and has its slope there.
    fn ground<'a>(&'a self, height: &Expression, rubs: bool, tree: &Tree<'g>) -> Result<GapFunction<'a, 'g>> {
        let (zero, one, up) = (self.graph.zero(), self.graph.one(), self.upward());
        let [i, j] = if up == 2 { [0, 1] } else { [0, 2] };
        let place = ["x", "y"].map(|word| self.graph.symbol(word, word, false));
        let over = Self { place: Some(place), ..self.clone() };
        let height = over.scalar(height, tree)?;
        let slopes = place.map(|symbol| height.partial(symbol));
        let rises = height.partial(self.declared.time);
        Ok(Box::new(move |part| {
            let there = place.iter().map(|symbol| symbol.key()).zip([part.position[i], part.position[j]]);
            let there = Substitution::new(there.collect());
            let [a, b] = slopes.map(|slope| there.of(slope).group());
            let steep = (one + a * a + b * b).group().sqrt().recip();
            let mut normal = [zero; 3];
            (normal[i], normal[j], normal[up]) = (-(a * steep), -(b * steep), steep);
            let mut first = [zero; 3];
            let along = (one + a * a).group().sqrt().recip();
            (first[i], first[up]) = (along, a * along);
            let mut velocity = [zero; 3];
            velocity[up] = there.of(rises);
            GapFrame {
                gap: (part.position[up] - there.of(height)) * steep,
                normal,
                tangents: if rubs { vec![first, cross(&normal, &first)] } else { Vec::new() },
                velocity,
                link: None,
            }
        }))
    }

    /// From one end of a capsule to the other, with the square of the length, which is a constant.
    fn axis_of_capsule(&self, ends: [&Expression; 2], tree: &Tree<'g>) -> Result<(Triple<'g>, Expr<'g>)> {
        let axis = match [self.value(ends[0], tree)?, self.value(ends[1], tree)?] {
            [Value::Local(first), Value::Local(last)] if first.link == last.link => {
                let own = subtract(&last.components, &first.components);
                (tree.links[first.link].axes().to_space(&own), dot(&own, &own))
            }
            _ => {
                let [first, last] = [self.vector(ends[0], tree)?, self.vector(ends[1], tree)?];
                let own = subtract(&last, &first);
                (own, dot(&own, &own))
            }
        };
        Ok((axis.0.map(Expr::group), self.divisor(axis.1, ends[1].span)))
    }

    /// A sphere about another point, or about the nearest point of the axis of a capsule from there, which turns with
    /// its body; `along` has a tangent normal to it, with friction.
    ///
    /// The distance from a point to an axis has continuous first derivatives; where the nearest point comes to an end,
    /// the second ones jump, as the curvature of a capsule does.
    fn sphere<'a>(
        &'a self,
        name: &str,
        (center, axis, radius): (&Expression, Option<(Triple<'g>, Expr<'g>)>, Expr<'g>),
        along: Option<&Expression>,
        tree: &'a Tree<'g>,
    ) -> Result<GapFunction<'a, 'g>> {
        let (other, place) = (self.part_at(center, tree)?, center.span);
        let along = match along {
            Some(e) => Some((self.direction((name, "along"), e, self.vector(e, tree)?), e.span)),
            None => None,
        };
        Ok(Box::new(move |part| {
            let apart = subtract(&part.position, &other.position);
            // As far along the axis as the point is, between its ends.
            let foot = axis.map(|(axis, square)| {
                let [zero, one] = [self.graph.zero(), self.graph.one()];
                let way = clamped((dot(&apart, &axis) * square.recip()).group(), [zero, one]).group();
                axis.map(|e| way * e)
            });
            let apart = foot.map_or(apart, |foot| subtract(&apart, &foot).map(Expr::group));
            let distance = self.divisor(dot(&apart, &apart).group().sqrt(), place);
            let normal = apart.map(|e| e * distance.recip());
            let tangents = along.map(|(along, span)| {
                let across = cross(&along, &normal).map(Expr::group);
                let sine = self.divisor(dot(&across, &across).group().sqrt(), span);
                let first = across.map(|e| e * sine.recip());
                vec![first, cross(&normal, &first)]
            });
            let arm = normal.map(|e| radius * e);
            let arm = foot.map_or(arm, |foot| add(&foot, &arm));
            let velocity = self.velocity_at(&other, &arm, tree);
            let (gap, link) = (distance - radius, other.link);
            GapFrame { gap, normal, tangents: tangents.unwrap_or_default(), velocity, link }
        }))
    }

    /// A radius or a length, which `kernel()` checks.
    pub(super) fn length(&self, argument: (&str, &str), e: &Expression, tree: &Tree<'g>) -> Result<Expr<'g>> {
        let value = self.scalar(e, tree)?;
        self.note(LawKind::NonNegative, argument, e, vec![value]);
        Ok(value)
    }

    /// The same of what may be left out.
    fn length_or_zero(&self, argument: (&str, &str), e: Option<&Expression>, tree: &Tree<'g>) -> Result<Expr<'g>> {
        e.map_or(Ok(self.graph.zero()), |e| self.length(argument, e, tree))
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

    /// Part of a vector that is normal to n, over its length.
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
