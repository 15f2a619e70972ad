//! Loads, as the user wrote them, in symbols: springs become potentials and dissipation functions, torques with a
//! reaction two loads, drag a wrench of the velocity relative to the medium.

use std::collections::HashSet;

use proc_macro2::{Ident, Span};

use crate::algebra::{BinaryFunction, Expr};
use crate::error::Result;
use crate::mechanics::{
    Action, Axes, CentralField, Element, Force, Matter, Rotor, Tree, common, entrained, identity,
    relative_angular_velocity, subtract, turned,
};
use crate::model::argument::{
    ALONG, ANGLE, AT, CENTER, DAMPING, DRY, FORCE, FROM, LEAST, LENGTH, LINEAR, MOST, MU, QUADRATIC, STIFFNESS, TO,
    TORQUE, VALUE, VISCOUS, WIDTH,
};
use crate::model::{
    ArgumentType, BinaryOperator, Coefficients, CoordinateKind, ElementKind, Expression, ExpressionKind, ForceAxes,
    ForceClause, Property,
};
use crate::terms::LawKind;
use crate::words::Unraw;

use super::drag::DragMatrix;
use super::laws::Law;
use super::translator::{Translator, bug};
use super::value::{Local, Value};

type Triple<'g> = [Expr<'g>; 3];

/// Names of elements: given ones as they are, others by what they are, numbered from the second on.
struct ElementNames(HashSet<String>);

impl ElementNames {
    fn of_clause(&mut self, clause: &ForceClause) -> String {
        self.of(clause.name.as_ref(), &clause.row.word.replace('_', " "))
    }

    fn of(&mut self, given: Option<&Ident>, noun: &str) -> String {
        if let Some(name) = given {
            return name.unraw().to_string();
        }
        let numbered = (2..).map(|n| format!("{noun} {n}"));
        let free = std::iter::once(noun.to_owned()).chain(numbered).find(|name| !self.0.contains(name));
        let name = free.unwrap_or_default();
        self.0.insert(name.clone());
        name
    }
}

impl<'g> Translator<'_, 'g> {
    /// All loads other than weight and buoyancy, each with the place where it is written.
    pub(super) fn elements(&self, tree: &Tree<'g>) -> Result<Vec<(Span, Element<'g>)>> {
        let model = self.model;
        let given = model.forces.iter().filter_map(|clause| clause.name.as_ref());
        let given = given.chain(model.attractions.iter().filter_map(|clause| clause.name.as_ref()));
        let mut names = ElementNames(given.map(|name| name.unraw().to_string()).collect());
        let mut elements = Vec::new();
        if let Some(potential) = &model.potential {
            let name = names.of(None, "potential");
            elements.push((potential.span, Element::new(name, Action::Potential(self.scalar(potential, tree)?))));
        }
        for clause in &model.attractions {
            let span = needed(clause, MU)?.span;
            let name = names.of_clause(clause);
            let field = CentralField {
                mu: self.constant(&name, clause, MU, tree)?,
                center: self.vector_or_zero(clause, CENTER, tree)?,
            };
            if !self.is_infinite(&field, span, tree) {
                elements.push((span, Element::new(name, field.action(tree))));
            }
        }
        elements.extend(self.elements_of_modes(tree)?);
        let entrained = self.medium(tree)?;
        if !entrained.is_empty() {
            let span = model.medium.as_ref().map_or(model.item.ident.span(), |velocity| velocity.span);
            elements.push((span, Element::new(names.of(None, "medium"), Action::Forces(entrained))));
        }
        for clause in &model.forces {
            let name = names.of_clause(clause);
            let Some(actions) = self.graph.defined(|| self.actions(clause, &name, tree)) else {
                self.divides_by_zero(clause.span, &name);
                continue;
            };
            elements.extend(actions?.into_iter().map(|action| (clause.span, Element::new(name.clone(), action))));
        }
        Ok(elements)
    }

    /// Actions of a clause: a spring with a damper is one element that acts in two ways.
    fn actions(&self, clause: &ForceClause, name: &str, tree: &Tree<'g>) -> Result<Vec<Action<'g>>> {
        let forces = match clause.row.kind {
            ElementKind::Force => match clause.body() {
                Some(body) => vec![self.on_body(clause, body, [Some(VALUE), None], tree)?],
                None => vec![self.force_at(needed(clause, AT)?, needed(clause, VALUE)?, tree)?],
            },
            ElementKind::Wrench => vec![self.on_body(clause, on(clause)?, [Some(FORCE), Some(TORQUE)], tree)?],
            ElementKind::Torque => self.torque(clause, tree)?,
            ElementKind::Drive => {
                let drive = |(coordinate, force): (&Ident, &Expression)| -> Result<Force<'g>> {
                    let rate = self.rate_of_coordinate(coordinate)?;
                    Ok(Force::OnRate { rate, force: self.scalar(force, tree)? })
                };
                clause.rates().map(drive).collect::<Result<_>>()?
            }
            ElementKind::Drag => vec![self.drag(name, clause, tree)?],
            ElementKind::Dissipation => {
                let function = needed(clause, VALUE)?;
                let value = self.scalar(function, tree)?;
                self.note(LawKind::Dissipation, (name, ""), function, vec![value]);
                vec![Force::Dissipation(value)]
            }
            ElementKind::Coupling => self.coupling(name, clause, tree)?,
            ElementKind::Friction => vec![self.friction(name, clause, tree)?],
            ElementKind::Spring => return self.spring(name, clause, tree),
            ElementKind::TorsionalSpring => return self.torsional_spring(name, clause, tree),
            ElementKind::Bushing => return self.bushing(name, clause, tree),
            ElementKind::Stop => return self.stop(name, clause, tree),
            ElementKind::MassFlow => self.mass_flow(clause, tree)?,
            ElementKind::Attraction => return Err(bug(clause.span)),
        };
        Ok(vec![Action::Forces(forces)])
    }

    /// A force at a point of a body and a torque on it, by the words of their arguments.
    fn on_body(
        &self,
        clause: &ForceClause,
        body: &Ident,
        words: [Option<&str>; 2],
        tree: &Tree<'g>,
    ) -> Result<Force<'g>> {
        let link = self.link(body)?;
        let written = words.map(|word| word.and_then(|word| clause.expression(word)));
        let (axes, [force, torque]) = self.parts(link, written, clause.axes(), tree)?;
        Ok(Force::OnLink { link, at: self.vector_or_zero(clause, AT, tree)?, force, torque, axes })
    }

    fn coupling(&self, name: &str, clause: &ForceClause, tree: &Tree<'g>) -> Result<Vec<Force<'g>>> {
        let links = self.both(clause)?;
        let viscous = self.constant(name, clause, VISCOUS, tree)?;
        let (axes, omega) = match relative_angular_velocity(&tree.links, links) {
            Some(omega) => (Axes::Body, omega),
            None => {
                let [own, other] = links.map(|link| self.velocity_of(link, Property::AngularVelocity, tree));
                (Axes::Space, subtract(&own, &other))
            }
        };
        if omega.iter().all(|e| e.is_zero()) {
            let message = "the two bodies never turn relative to each other, so the coupling does nothing; remove it";
            self.mistake(clause.span, message.to_owned());
        }
        Ok(self.with_reaction(links, omega.map(|e| -(viscous * e.group())), axes, tree))
    }

    /// The links that it acts on.
    fn both(&self, clause: &ForceClause) -> Result<[usize; 2]> {
        let (other, _) = clause.other().ok_or_else(|| bug(clause.span))?;
        Ok([self.link(on(clause)?)?, self.link(other)?])
    }

    fn torque(&self, clause: &ForceClause, tree: &Tree<'g>) -> Result<Vec<Force<'g>>> {
        let link = self.link(on(clause)?)?;
        let value = needed(clause, VALUE)?;
        let (axes, [force, torque]) = self.parts(link, [None, Some(value)], clause.axes(), tree)?;
        Ok(match clause.other() {
            Some((other, _)) => self.with_reaction([link, self.link(other)?], torque, axes, tree),
            None => vec![Force::OnLink { link, at: [self.graph.zero(); 3], force, torque, axes }],
        })
    }

    /// A force and a torque on a link with their axes: its own where links of its tree know them, whatever the axes in
    /// which the user gives them.
    pub(super) fn parts(
        &self,
        link: usize,
        written: [Option<&Expression>; 2],
        axes: ForceAxes,
        tree: &Tree<'g>,
    ) -> Result<(Axes, [Triple<'g>; 2])> {
        let none = [self.graph.zero(); 3];
        let (mut own, mut given) = ([Some(none); 2], [none; 2]);
        for (k, e) in written.into_iter().enumerate() {
            let Some(e) = e else { continue };
            own[k] = self.seen_by(link, e, tree)?;
            given[k] = self.vector(e, tree)?;
        }
        Ok(match (axes, own) {
            (ForceAxes::Observer, [Some(force), Some(torque)]) => (Axes::Body, [force, torque]),
            (ForceAxes::Observer, _) => (Axes::Space, given),
            (ForceAxes::Body, _) => (Axes::Body, given),
        })
    }

    /// A vector in the axes of a link, where a link of its tree knows it.
    fn seen_by(&self, link: usize, e: &Expression, tree: &Tree<'g>) -> Result<Option<Triple<'g>>> {
        Ok(match self.value(e, tree)? {
            Value::Local(local) => local.seen_by(link, tree),
            _ => None,
        })
    }

    fn force_at(&self, at: &Expression, value: &Expression, tree: &Tree<'g>) -> Result<Force<'g>> {
        let none = [self.graph.zero(); 3];
        if let Value::Local(point) = self.value(at, tree)?
            && let Some(force) = self.seen_by(point.link, value, tree)?.filter(|_| point.is_point)
        {
            let (link, at) = (point.link, point.components);
            return Ok(Force::OnLink { link, at, force, torque: none, axes: Axes::Body });
        }
        Ok(Force::AtPoint { at: self.vector(at, tree)?, force: self.vector(value, tree)? })
    }

    /// A torque on a link with its reaction on another: in one tree on the joints between them, else on each by itself.
    fn with_reaction(&self, links: [usize; 2], torque: Triple<'g>, axes: Axes, tree: &Tree<'g>) -> Vec<Force<'g>> {
        let link = tree.links[links[0]].axes();
        if common(&tree.links, links).is_some() {
            let torque = match axes {
                Axes::Body => torque,
                Axes::Space => link.to_body(&torque).map(Expr::group),
            };
            return vec![Force::Between { links, torque }];
        }
        let none = [self.graph.zero(); 3];
        let on = |link, torque, axes| Force::OnLink { link, at: none, force: none, torque, axes };
        // The same components in the observer's axes, which both share.
        let turned = match axes {
            Axes::Space => torque,
            Axes::Body => link.to_space(&torque).map(Expr::group),
        };
        vec![on(links[0], torque, axes), on(links[1], turned.map(|e| -e), Axes::Space)]
    }

    /// Takes note of what the argument `word` of the element `name` is.
    pub(super) fn note(&self, kind: LawKind, (name, word): (&str, &str), e: &Expression, values: Vec<Expr<'g>>) {
        let field = |ident: &Ident| self.model.item.fields.iter().any(|field| field.ident.unraw() == ident.unraw());
        let label = match &e.kind {
            ExpressionKind::Name(ident) if field(ident) => ident.unraw().to_string(),
            _ if word.is_empty() => name.to_owned(),
            _ => format!("{name}.{word}"),
        };
        self.notes.add().laws.push(Law { label, kind, values });
    }

    /// The constant `word` of the element `name`, of which note is taken as its row says.
    fn constant(&self, name: &str, clause: &ForceClause, word: &str, tree: &Tree<'g>) -> Result<Expr<'g>> {
        let e = needed(clause, word)?;
        let value = self.scalar(e, tree)?;
        if let Some(ArgumentType::Constant { law: Some(law), .. }) = clause.find(word).map(|given| given.argument.takes)
        {
            self.note(law, (name, word), e, vec![value]);
        }
        Ok(value)
    }

    /// The same of what may be left out.
    fn optional(&self, name: &str, clause: &ForceClause, word: &str, tree: &Tree<'g>) -> Result<Option<Expr<'g>>> {
        clause.find(word).map(|_| self.constant(name, clause, word, tree)).transpose()
    }

    pub(super) fn vector_or_zero(&self, clause: &ForceClause, word: &str, tree: &Tree<'g>) -> Result<Triple<'g>> {
        clause.expression(word).map_or(Ok([self.graph.zero(); 3]), |e| self.vector(e, tree))
    }

    /// The length between the ends of an element, or along an expression; its square, without a root where possible.
    fn extent(&self, clause: &ForceClause, tree: &Tree<'g>) -> Result<[Expr<'g>; 2]> {
        if let Some(along) = clause.expression(ALONG) {
            let length = self.scalar(along, tree)?;
            return Ok([length, length.powi(2)]);
        }
        let (from, to) = (needed(clause, FROM)?, needed(clause, TO)?);
        let (start, end) = (self.value(from, tree)?, self.value(to, tree)?);
        let arm = match self.binary(BinaryOperator::Subtract, end, start, tree) {
            Some(Value::Local(arm)) => arm.components,
            Some(Value::Vector(arm)) => arm,
            _ => return Err(bug(from.span)),
        };
        let square = arm.iter().map(|e| e.powi(2)).sum::<Expr<'g>>().group();
        Ok([square.sqrt(), square])
    }

    fn spring(&self, name: &str, clause: &ForceClause, tree: &Tree<'g>) -> Result<Vec<Action<'g>>> {
        let [length, square] = self.extent(clause, tree)?;
        let rest = self.optional(name, clause, LENGTH, tree)?;
        self.sprung(name, clause, [length, rest.map_or(square, |rest| (length - rest).powi(2))], tree)
    }

    /// Spring and damper: `stiffness` by the square of what is stretched, and `damping` by its rate.
    fn sprung(
        &self,
        name: &str,
        clause: &ForceClause,
        [stretched, square]: [Expr<'g>; 2],
        tree: &Tree<'g>,
    ) -> Result<Vec<Action<'g>>> {
        let stiffness = self.constant(name, clause, STIFFNESS, tree)?;
        let mut actions = vec![Action::Potential((stiffness * square).half())];
        if let Some(damping) = self.optional(name, clause, DAMPING, tree)? {
            let rate = stretched.derivative(&self.rates).group();
            let function = (damping * rate.powi(2)).half();
            actions.push(Action::Forces(vec![Force::Dissipation(function)]));
        }
        Ok(actions)
    }

    /// Torsional spring by the twist θ about e₃ of the relative rotation R, at which the turn Q about e₃ is nearest to
    /// R: tr(QᵀR) = (R₁₁ + R₂₂) cos θ + (R₂₁ − R₁₂) sin θ + R₃₃ is largest. Less the angle without torque it is between
    /// −π and π.
    fn torsional_spring(&self, name: &str, clause: &ForceClause, tree: &Tree<'g>) -> Result<Vec<Action<'g>>> {
        let r = self.rotation_between(self.both(clause)?, tree);
        let (sine, cosine) = ((r[1][0] - r[0][1]).group(), (r[0][0] + r[1][1]).group());
        let [sine, cosine] = match self.optional(name, clause, ANGLE, tree)? {
            Some(free) => {
                let (s, c) = (free.sin(), free.cos());
                [(sine * c - cosine * s).group(), (cosine * c + sine * s).group()]
            }
            None => [sine, cosine],
        };
        let twist = sine.binary(BinaryFunction::Atan2, cosine);
        let stands = || twist.derivative(&self.rates).is_zero();
        if [sine, cosine].iter().all(|e| self.vanishes(*e)) || stands() {
            let message = "the two bodies never turn relative to each other about their third axes, so the torsional \
                           spring does nothing; name frames whose third axes lie along the axis of the twist";
            self.mistake(clause.span, message.to_owned());
        }
        self.sprung(name, clause, [twist, twist.powi(2)], tree)
    }

    /// Bushing by the place of one body relative to the other.
    fn bushing(&self, name: &str, clause: &ForceClause, tree: &Tree<'g>) -> Result<Vec<Action<'g>>> {
        let links = self.both(clause)?;
        let r = self.rotation_between(links, tree);
        let angle = |sine: Expr<'g>, cosine: Expr<'g>| sine.group().binary(BinaryFunction::Atan2, cosine.group());
        let [x, y, z] = self.place_between(links, tree);
        let turn = [angle(-r[1][2], r[2][2]), angle(r[0][2], r[0][2].leg()), angle(-r[0][1], r[0][0])];
        let place = [x, y, z, turn[0], turn[1], turn[2]];
        let mut actions = Vec::new();
        if let Some(stiffness) = self.symmetric(name, clause, STIFFNESS, tree)? {
            actions.push(Action::Potential(self.half_form(&stiffness, &place)));
        }
        if let Some(damping) = self.symmetric(name, clause, DAMPING, tree)? {
            let rates = place.map(|e| e.derivative(&self.rates).group());
            actions.push(Action::Forces(vec![Force::Dissipation(self.half_form(&damping, &rates))]));
        }
        Ok(actions)
    }

    /// ½ xᵀKx of a symmetric K.
    fn half_form(&self, matrix: &[Vec<Expr<'g>>], x: &[Expr<'g>; 6]) -> Expr<'g> {
        let mut form = self.graph.zero();
        for (i, row) in matrix.iter().enumerate() {
            form = form + (row[i] * x[i].powi(2)).half();
            form = (i + 1..6).fold(form, |form, j| form + row[j] * x[i] * x[j]);
        }
        form
    }

    /// The symmetric matrix `word` of the element `name`; notes the check that its row names.
    fn symmetric(
        &self,
        name: &str,
        clause: &ForceClause,
        word: &str,
        tree: &Tree<'g>,
    ) -> Result<Option<Vec<Vec<Expr<'g>>>>> {
        let Some(coefficients) = clause.coefficients(word) else { return Ok(None) };
        let rows = self.coefficients(coefficients, tree)?;
        let label = match coefficients {
            Coefficients::Field(field) => field.unraw().to_string(),
            Coefficients::Diagonal(_) => format!("{name}.{word}"),
        };
        if let Some(ArgumentType::Matrix { law, .. }) = clause.find(word).map(|given| given.argument.takes) {
            self.notes.add().laws.push(Law { label, kind: law, values: rows.concat() });
        }
        Ok(Some(rows))
    }

    /// From O of the second link to O of the first, in the axes of the second.
    fn place_between(&self, [own, other]: [usize; 2], tree: &Tree<'g>) -> Triple<'g> {
        let point = |k: usize| Local::point(k, [self.graph.zero(); 3], tree.links[k].position);
        let across = || {
            let arm = subtract(&tree.links[own].position, &tree.links[other].position).map(Expr::group);
            tree.links[other].axes().to_body(&arm)
        };
        let arm = point(own).minus(&point(other), tree).and_then(|arm| arm.seen_by(other, tree));
        arm.unwrap_or_else(across).map(Expr::group)
    }

    /// The rotation of the first link relative to the second: from the axes of the first to those of the second.
    fn rotation_between(&self, [own, other]: [usize; 2], tree: &Tree<'g>) -> [Triple<'g>; 3] {
        let columns = identity(self.graph).map(|axis| {
            let observed = || tree.links[own].axes().to_space(&axis);
            let across = || tree.links[other].axes().to_body(&observed()).map(Expr::group);
            turned(&tree.links, [own, other], &axis).unwrap_or_else(across)
        });
        std::array::from_fn(|i| columns.map(|column| column[i]))
    }

    /// Beyond a limit a spring sets in over the given width: `½ k s²` with `s = (x + √(x² + w²))/2`, which is x far
    /// beyond the limit and 0 far before it. What it damps is the rate of s.
    ///
    /// The force is k s² /√(x² + w²): ¼ k w at the limit, 0.03 k w a width before it, and k w⁴/16|x|³ far before. A
    /// force of no extent before the limit would have a kink or a power series that ends there.
    fn stop(&self, name: &str, clause: &ForceClause, tree: &Tree<'g>) -> Result<Vec<Action<'g>>> {
        let [length, _] = self.extent(clause, tree)?;
        let stiffness = self.constant(name, clause, STIFFNESS, tree)?;
        let width = self.constant(name, clause, WIDTH, tree)?;
        let least = self.optional(name, clause, LEAST, tree)?;
        let most = self.optional(name, clause, MOST, tree)?;
        if let (Some(lower), Some(least), Some(most)) = (clause.expression(LEAST), least, most) {
            self.note(LawKind::Limits, (name, LEAST), lower, vec![least, most]);
        }
        let beyond = [least.map(|least| least - length), most.map(|most| length - most)];
        let pressed = beyond.into_iter().flatten().map(|x| {
            let x = x.group();
            (x + (x.powi(2) + width.powi(2)).group().sqrt()).half().group()
        });
        let pressed: Vec<Expr<'g>> = pressed.collect();
        let zero = self.graph.zero();
        let half_squares = |factor: Expr<'g>, terms: &[Expr<'g>]| {
            let squares = terms.iter().fold(zero, |sum, e| sum + e.powi(2));
            (factor * squares).half()
        };
        let mut actions = vec![Action::Potential(half_squares(stiffness, &pressed))];
        if let Some(damping) = self.optional(name, clause, DAMPING, tree)? {
            let rates: Vec<Expr<'g>> = pressed.iter().map(|s| s.derivative(&self.rates).group()).collect();
            actions.push(Action::Forces(vec![Force::Dissipation(half_squares(damping, &rates))]));
        }
        Ok(actions)
    }

    /// `−D (u − c, ω)` and `−D |(u − c, ω)| (u − c, ω)`, component by component.
    fn drag(&self, name: &str, clause: &ForceClause, tree: &Tree<'g>) -> Result<Force<'g>> {
        let link = self.link(on(clause)?)?;
        let [linear, quadratic] = [LINEAR, QUADRATIC].map(|word| clause.coefficients(word));
        let twist = self.velocity_of(link, Property::RelativeVelocity, tree).into_iter();
        let twist: Vec<Expr<'g>> =
            twist.chain(self.velocity_of(link, Property::BodyAngularVelocity, tree)).map(Expr::group).collect();
        let mut wrench = [self.graph.zero(); 6];
        let squares = twist.iter().map(|v| *v * v.abs()).collect();
        for (coefficients, velocities, quadratic) in [(linear, twist, false), (quadratic, squares, true)] {
            let Some(coefficients) = coefficients else { continue };
            let rows: Vec<Vec<Expr<'g>>> = self.coefficients(coefficients, tree)?;
            let label = match coefficients {
                Coefficients::Field(field) => field.unraw().to_string(),
                Coefficients::Diagonal(_) => name.to_owned(),
            };
            self.notes.add().drags.push(DragMatrix { label, quadratic, entries: rows.clone() });
            for (component, row) in wrench.iter_mut().zip(rows) {
                *component = row.iter().zip(&velocities).fold(*component, |sum, (d, v)| sum - *d * *v);
            }
        }
        let [f1, f2, f3, m1, m2, m3] = wrench;
        let at = [self.graph.zero(); 3];
        Ok(Force::OnLink { link, at, force: [f1, f2, f3], torque: [m1, m2, m3], axes: Axes::Body })
    }

    /// Six by six.
    pub(super) fn coefficients(&self, coefficients: &Coefficients, tree: &Tree<'g>) -> Result<Vec<Vec<Expr<'g>>>> {
        match coefficients {
            Coefficients::Diagonal(entries) => {
                let entries = entries.iter().map(|e| self.scalar(e, tree)).collect::<Result<Vec<_>>>()?;
                let zero = self.graph.zero();
                Ok((0..6).map(|i| (0..6).map(|j| if i == j { entries[i] } else { zero }).collect()).collect())
            }
            Coefficients::Field(name) => self.declared.matrix(name).cloned().ok_or_else(|| bug(name.span())),
        }
    }

    /// Whether something with mass stays at the center of a field, which is noted.
    fn is_infinite(&self, field: &CentralField<'g>, span: Span, tree: &Tree<'g>) -> bool {
        let mut massive = tree.links.iter().filter(|link| !matches!(link.matter, Matter::Nothing));
        massive.any(|link| {
            // What a chart says of it, where the motion stands by symbols of its own.
            let charted = self.chart().filter(|_| self.observed.is_some());
            let position = charted.map_or(link.position, |chart| chart.kinematics.position);
            let arm = std::array::from_fn(|i| position[i] - field.center[i]);
            self.stays_at(&arm, span)
        })
    }

    /// Forces of the velocity of the medium beside drag.
    fn medium(&self, tree: &Tree<'g>) -> Result<Vec<Force<'g>>> {
        let Some(stream) = self.stream(tree)? else { return Ok(Vec::new()) };
        let rate = stream.map(|e| e.derivative(&self.rates));
        let mut forces = Vec::new();
        for (index, link) in tree.links.iter().enumerate() {
            let Some(body) = link.body() else { continue };
            if body.added_mass.is_none() && body.displaced.is_none() {
                continue;
            }
            let [u, omega] =
                [Property::BodyVelocity, Property::BodyAngularVelocity].map(|p| self.velocity_of(index, p, tree));
            let in_body = |a: &Triple<'g>| link.axes().to_body(a).map(Expr::group);
            let (force, torque) = entrained(self.graph, body, [&u, &omega], &in_body(&stream), &in_body(&rate));
            if force.iter().chain(&torque).any(|e| !e.is_zero()) {
                let at = [self.graph.zero(); 3];
                forces.push(Force::OnLink { link: index, at, force, torque, axes: Axes::Body });
            }
        }
        Ok(forces)
    }

    /// The velocity of the medium, observer's components.
    pub(super) fn stream(&self, tree: &Tree<'g>) -> Result<Option<Triple<'g>>> {
        self.model.medium.as_ref().map(|e| self.vector(e, tree)).transpose()
    }

    pub(super) fn link(&self, name: &Ident) -> Result<usize> {
        self.links.get(&name.unraw().to_string()).copied().ok_or_else(|| bug(name.span()))
    }

    /// Inertia of rates, of which note is taken.
    pub(super) fn rotors(&self, tree: &Tree<'g>) -> Result<Vec<Rotor<'g>>> {
        let mut rotors = Vec::new();
        for (coordinate, inertia) in &self.model.armatures {
            let label = coordinate.unraw().to_string();
            let value = self.scalar(inertia, tree)?;
            self.note(LawKind::Armature, ("armature", &label), inertia, vec![value]);
            let kind = self
                .motion(coordinate)
                .map_or_else(|| self.coordinate(coordinate).map(|(_, kind)| kind), |_| Ok(CoordinateKind::Scalar))?;
            let rates = match kind {
                CoordinateKind::Scalar => vec![self.rate_of_coordinate(coordinate)?],
                CoordinateKind::Rotation => self.turning(&label, coordinate)?.to_vec(),
                CoordinateKind::Pose => {
                    let moving = self.velocity_of_coordinate(&label, Property::Velocity);
                    let moving = moving.ok_or_else(|| bug(coordinate.span()))?;
                    moving.into_iter().chain(self.turning(&label, coordinate)?).collect()
                }
            };
            rotors.extend(rates.into_iter().map(|rate| Rotor { rate, inertia: value }));
        }
        Ok(rotors)
    }

    /// The angular velocity of a coordinate, in its own axes.
    fn turning(&self, label: &str, name: &Ident) -> Result<Triple<'g>> {
        self.velocity_of_coordinate(label, Property::BodyAngularVelocity).ok_or_else(|| bug(name.span()))
    }

    /// `−(d ẋ + f ẋ/√(ẋ² + w²))` along ẋ, of which the part with f is dry friction.
    fn friction(&self, name: &str, clause: &ForceClause, tree: &Tree<'g>) -> Result<Force<'g>> {
        let rate = self.extent(clause, tree)?[0].derivative(&self.rates).group();
        let mut force = self.graph.zero();
        if let Some(viscous) = self.optional(name, clause, VISCOUS, tree)? {
            force = force - viscous * rate;
        }
        if clause.find(DRY).is_some() {
            let dry = self.constant(name, clause, DRY, tree)?;
            let width = self.constant(name, clause, WIDTH, tree)?;
            let length = (rate.powi(2) + width.powi(2)).group().sqrt();
            force = force - dry * rate * length.recip();
        }
        Ok(Force::OnRate { rate, force })
    }

    /// The function of time that a coordinate is, if it is driven.
    fn motion(&self, name: &Ident) -> Option<&Expression> {
        self.model.motions.iter().find(|(own, _)| own == name).map(|(_, motion)| motion)
    }

    pub(super) fn coordinate(&self, name: &Ident) -> Result<(usize, CoordinateKind)> {
        let index = self.model.coordinates.iter().position(|q| q.ident == *name).ok_or_else(|| bug(name.span()))?;
        Ok((index, self.model.coordinates[index].kind))
    }

    /// ψ of a scalar coordinate, or the rate of a motion.
    pub(super) fn rate_of_coordinate(&self, name: &Ident) -> Result<Expr<'g>> {
        if let Some(motion) = self.motion(name) {
            return Ok(self.scalar(motion, &self.no_links())?.derivative(&self.rates));
        }
        let (index, _) = self.coordinate(name)?;
        Ok(self.declared.rate_of(self.declared.before + index, &self.kinematics)[0])
    }
}

/// An argument that no clause of this kind lacks.
fn needed<'c>(clause: &'c ForceClause, word: &str) -> Result<&'c Expression> {
    clause.expression(word).ok_or_else(|| bug(clause.span))
}

/// The body that it acts on, which no clause of this kind lacks.
fn on(clause: &ForceClause) -> Result<&Ident> {
    clause.body().ok_or_else(|| bug(clause.span))
}
