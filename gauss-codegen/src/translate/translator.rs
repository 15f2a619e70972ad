//! The scene, part by part, in the order in which one part can name another.

use std::collections::HashMap;

use proc_macro2::{Ident, Span};
use quote::format_ident;

use crate::algebra::{Expr, Graph, Map, OwnFunction};
use crate::error::{Error, Result};
use crate::mechanics::{
    ChartedBody, ChartedLink, Constraint, ConstraintKind, Coordinate, Element, Matter, MotionSymbols, Placement,
    SystemScene, Tree, Turn,
};
use crate::model::{self, ExpressionKind, Model, SpeedPart};
use crate::terms::{BodyChart, InputKind, LawKind, UserFunction};
use crate::words::Unraw;

use super::freedom::FreedJoint;
use super::laws::Law;
use super::limbs::twins;
use super::notes::Notes;
use super::parameters::parameters;
use super::state::quantities;
use super::symbols::{self, SceneSymbols};
use super::translated::{ConstraintPlace, ContactPlace, IndependentSpeeds, Provenance, SpannedName, Translated};
use super::value::{RotationFactor, Value};

/// Translates a checked system.
///
/// # Errors
/// Expressions without a value, each where it stands; what the model should have refused: a bug of this crate.
pub fn translate<'g>(graph: &'g Graph, model: &Model) -> Result<Translated<'g>> {
    let mut declared = SceneSymbols::new(graph, model);
    let function = |clause: &UserFunction| {
        let name = clause.name.unraw().to_string();
        let index = graph.declare_function(name.clone());
        (name, OwnFunction::new(index, clause.kind.variables().len() as u8, clause.kind.continuous()))
    };
    let alike = twins(model, &declared);
    alike.iter().for_each(|(symbol, twin)| graph.declare_alike(*symbol, twin.slot as u64));
    let functions: HashMap<String, OwnFunction> = model.item.functions.iter().map(function).collect();
    let pi = graph.symbol("π", "\\pi", true);
    let notes = Notes::new(vec![(symbols::pi(), pi)]);
    let mut assigned = Translator::new(graph, model, &declared, &functions, pi, &notes).of_matter().mass_data()?;
    (declared.gravity, declared.bodies) = (assigned.gravity, std::mem::take(&mut assigned.bodies));
    let mut translator = Translator::new(graph, model, &declared, &functions, pi, &notes);
    let scene = translator.scene()?;
    translator.refuse_mistakes()?;
    let let_go = translator.let_go()?;
    let readings = translator.readings(&scene.tree);
    let independent = model.independent.as_ref().map(|names| IndependentSpeeds {
        kept: translator.indices_of_speeds(names),
        span: names.first().map_or(model.item.ident.span(), |first| first.ident.span()),
    });
    let speeds = translator.speed_names();
    let frames = model.item.wanted.frames.iter();
    let frames = frames.filter_map(|name| translator.links.get(&name.unraw().to_string()).copied()).collect();
    let mass_data = assigned.of_bodies(model, &translator.links_of_clauses);
    let noted = notes.into_inner();
    let twins = alike.into_iter().chain(noted.twins).collect();
    Ok(Translated {
        scene,
        let_go,
        provenance: Provenance {
            parameters: parameters(&model.item.fields, &declared.sources),
            sources: declared.sources,
            literals: noted.literals,
            twins,
            readings,
            extreme: noted.extreme,
            drags: noted.drags,
            laws: noted.laws,
            mass_data,
            frames,
            speeds,
            state: quantities(model, independent.as_ref().map(|independent| &independent.kept[..])),
            rates: model.kinematics.iter().map(rate).collect(),
            constraints: model.constraints.iter().map(place).collect(),
            contacts: model.contacts.iter().map(contact_place).collect(),
            independent,
            item: model.item.clone(),
        },
    })
}

fn rate((coordinate, rate): &(Ident, model::Expression)) -> SpannedName {
    SpannedName { text: coordinate.to_string(), span: rate.span }
}

fn place(clause: &model::ConstraintClause) -> ConstraintPlace {
    ConstraintPlace {
        word: clause.span,
        expression: clause.expression.span,
        in_file: clause.place.clone(),
        is_vector: clause.vector,
    }
}

fn contact_place(clause: &model::ContactClause) -> ContactPlace {
    match &clause.touching {
        model::ContactGeometry::Gap { gap, slips, spin, rolls } => ContactPlace {
            gap: Some(gap.span),
            slips: slips.iter().chain(spin).map(|slip| slip.span).collect(),
            rolls: rolls.iter().map(|roll| roll.span).collect(),
        },
        model::ContactGeometry::Point(contact) => {
            let point = contact.point.span;
            ContactPlace { gap: Some(point), slips: vec![point; 3], rolls: vec![point; 2] }
        }
        model::ContactGeometry::Slip { slips, .. } => {
            ContactPlace { gap: None, slips: slips.iter().map(|slip| slip.span).collect(), rolls: Vec::new() }
        }
        model::ContactGeometry::Range { along, .. } => {
            ContactPlace { gap: Some(along.span), slips: Vec::new(), rolls: Vec::new() }
        }
    }
}

/// ḃ and ω̂, where they are known.
pub(super) type ObservedRates<'g> = [Option<[Expr<'g>; 3]>; 2];

/// Translator of expressions, with all that they name.
#[derive(Clone)]
pub(super) struct Translator<'a, 'g> {
    pub(super) graph: &'g Graph,
    pub(super) model: &'a Model,
    pub(super) declared: &'a SceneSymbols<'g>,
    /// Functions that clauses declare, by name.
    pub(super) functions: &'a HashMap<String, OwnFunction>,
    pub(super) notes: &'a Notes<'g>,
    pub(super) pi: Expr<'g>,
    /// Values of names, those of bodies and frames excepted.
    pub(super) names: HashMap<String, Value<'g>>,
    /// Indices of bodies and frames among the links, by name.
    pub(super) links: HashMap<String, usize>,
    /// Which link each clause of a body or frame became.
    pub(super) links_of_clauses: Vec<usize>,
    /// ψ, and the rates of t and of the symbols of q.
    pub(super) kinematics: Vec<Expr<'g>>,
    pub(super) rates: Map<u32, Expr<'g>>,
    /// ḃ and ω̂ of each coordinate that is a pose or a rotation, where the kinematics give them rather than u and ω.
    pub(super) observed_rates: Vec<ObservedRates<'g>>,
    /// The motion of the only body, where it stands by symbols of its own.
    pub(super) observed: Option<MotionSymbols<'g>>,
    /// The horizontal coordinates over which a height is given, while it is translated.
    pub(super) place: Option<[Expr<'g>; 2]>,
    /// Coordinates of joints and motions that are let go, while the scene is translated for their forces.
    pub(super) let_go: Vec<FreedJoint<'g>>,
}

impl<'a, 'g> Translator<'a, 'g> {
    /// Knows fields, and nothing yet of what moves.
    pub(super) fn new(
        graph: &'g Graph,
        model: &'a Model,
        declared: &'a SceneSymbols<'g>,
        functions: &'a HashMap<String, OwnFunction>,
        pi: Expr<'g>,
        notes: &'a Notes<'g>,
    ) -> Self {
        let mut names: HashMap<String, Value<'g>> = declared.fields.iter().cloned().collect();
        names.insert("pi".to_owned(), Value::Scalar(pi));
        Self {
            graph,
            model,
            declared,
            functions,
            notes,
            pi,
            names,
            links: HashMap::new(),
            links_of_clauses: vec![0; model.bodies.len()],
            kinematics: Vec::new(),
            rates: Map::default(),
            observed_rates: vec![[None; 2]; model.coordinates.len()],
            observed: None,
            place: None,
            let_go: Vec::new(),
        }
    }

    /// The same with `t` for the instant at which mass data are taken: it stands still where velocities and momenta are
    /// differentiated, as masses do that are followed on their way.
    pub(super) fn of_matter(&self) -> Self {
        let mut of_matter = self.clone();
        let time = self.declared.matter_time.unwrap_or(self.declared.time);
        of_matter.names.insert("t".to_owned(), Value::Scalar(time));
        of_matter
    }

    /// Indices of the speeds with the given names: three for a vector, one for a component.
    fn indices_of_speeds(&self, names: &[SpeedPart]) -> Vec<usize> {
        let idents = self.speed_idents();
        let component = |k: usize| idents[..k].iter().rev().take_while(|earlier| **earlier == idents[k]).count();
        let named = |k: usize, name: &SpeedPart| {
            name.ident == idents[k] && name.component.is_none_or(|named| named == component(k))
        };
        (0..idents.len()).filter(|&k| names.iter().any(|name| named(k, name))).collect()
    }

    /// The name of each speed, and where it is written: without `speeds` at its coordinate.
    fn speed_names(&self) -> Vec<SpannedName> {
        let idents = self.speed_idents();
        let name = |k: usize| match idents.get(k) {
            Some(ident) => SpannedName { text: ident.to_string(), span: ident.span() },
            None => {
                let coordinate = Coordinate::of_component(&self.declared.coordinates, k);
                let own = coordinate.checked_sub(self.declared.before).and_then(|k| self.model.coordinates.get(k));
                let ident = own.map_or(&self.model.item.ident, |own| &own.ident);
                SpannedName { text: format!("d{ident}/dt"), span: ident.span() }
            }
        };
        (0..self.declared.speeds.len()).map(name).collect()
    }

    /// Names of the speeds as the user writes them: three for a vector.
    fn speed_idents(&self) -> Vec<Ident> {
        let of_chart = self.model.in_chart.map(BodyChart::speed_words).unwrap_or_default();
        let of_chart = of_chart.into_iter().map(|word| format_ident!("{word}"));
        let own = self.model.speeds.iter().flatten();
        let own = own.flat_map(|z| std::iter::repeat_n(z.ident.clone(), symbols::size_of_speed(z.kind)));
        of_chart.chain(own).collect()
    }

    /// The chart, where the only body has one.
    pub(super) fn chart(&self) -> Option<&'a ChartedBody<'g>> {
        self.declared.chart.as_ref()
    }

    pub(super) fn scene(&mut self) -> Result<SystemScene<'g>> {
        let (graph, model) = (self.graph, self.model);
        self.name_everything();
        (self.kinematics, self.observed_rates) = self.kinematics()?;
        self.rates = self.rates();
        self.name_rotations(&self.kinematics.clone());
        let speeds = self.declared.speeds.clone();
        let placements = self.placements()?;
        let mut tree = Tree::new(graph, placements, speeds.clone(), self.rates.clone(), self.declared.gravity);
        self.name_points(&tree)?;
        for clause in &model.particles {
            let mass = self.of_matter().scalar(&clause.mass, &tree)?;
            let label = match &clause.mass.kind {
                ExpressionKind::Name(name) => name.unraw().to_string(),
                _ => "particle(mass = …)".to_owned(),
            };
            if mass.is_constant() {
                self.notes.add().laws.push(Law { label, kind: LawKind::MassInSum, values: vec![mass] });
            }
            let parent = clause.parent.as_ref().and_then(|name| self.links.get(&name.unraw().to_string()).copied());
            tree.hang(Placement {
                matter: Matter::Particle(mass),
                parent,
                position: self.vector(&clause.position, &tree)?,
                velocity: None,
                angular_velocity: None,
                turns: Vec::new(),
            });
        }
        tree.rotors = self.rotors(&tree)?;
        tree.deformations = self.deformations(&tree)?;
        let elements = match (model.chart_of_all(), self.chart()) {
            (Some(_), Some(chart)) if self.let_go.is_empty() => self.elements_on(chart)?,
            _ => self.elements(&tree)?.into_iter().map(|(span, element)| self.known_at_home(span, element)).collect(),
        };
        let constraints = self.constraints(&tree)?;
        let contacts = self.contacts(&tree)?;
        self.move_states(&tree)?;
        tree.settle();
        Ok(SystemScene {
            graph,
            time: self.declared.time,
            matter_time: self.declared.matter_time,
            coordinates: self.declared.coordinates.clone(),
            coordinate_names: self.declared.coordinate_names.clone(),
            states: self.declared.states.clone(),
            charted: self.charted(),
            momentum_names: self.declared.momentum_names.clone(),
            force_names: self.declared.force_names.clone(),
            speed_rates: self.declared.speed_rates.clone(),
            momenta: self.declared.momenta.clone(),
            speeds,
            kinematics: self.kinematics.clone(),
            rates: self.rates.clone(),
            tree,
            constraints,
            redundant: model.redundant,
            contacts,
            inputs: self.declared.inputs.clone(),
            elements,
        })
    }

    /// The body in the chart.
    fn charted(&self) -> Option<ChartedLink> {
        let clause = self.model.bodies.iter().position(|body| self.model.is_in_chart(body))?;
        if !self.let_go.is_empty() {
            return None;
        }
        let alone = self.model.chart_of_all().is_some();
        Some(ChartedLink { link: self.links_of_clauses[clause], own: self.model.in_chart?, alone })
    }

    /// Loads on the only body, whose motion a chart describes: translated in terms of symbols for it, so that each
    /// part of a wrench stays in the axes where it arises.
    fn elements_on(&self, chart: &ChartedBody<'g>) -> Result<Vec<Element<'g>>> {
        if !self.model.is_acted_upon() {
            return Ok(Vec::new());
        }
        let observed = MotionSymbols::new(self.graph, self.declared.time);
        let body = self.declared.bodies.first().cloned().flatten().ok_or_else(|| bug(self.model.item.ident.span()))?;
        let placement = Placement {
            matter: Matter::Body(Box::new(body)),
            parent: None,
            position: observed.position,
            velocity: None,
            angular_velocity: None,
            turns: vec![Turn::given(observed.rotation, observed.body_angular_velocity)],
        };
        let rates = observed.rates.clone();
        let tree = Tree::new(self.graph, vec![placement], Vec::new(), rates.clone(), None);
        let mut observer = Self { rates, observed: Some(observed.clone()), ..self.clone() };
        observer.name_points(&tree)?;
        let mut in_motion = Vec::new();
        for (span, element) in observer.elements(&tree)? {
            match self.graph.defined(|| observed.in_motion(&chart.kinematics, &element)) {
                Some(element) => in_motion.push(element),
                None => self.divides_by_zero(span, &element.name),
            }
        }
        Ok(in_motion)
    }

    fn name_everything(&mut self) {
        self.names.insert("t".to_owned(), Value::Scalar(self.declared.time));
        for (written, coordinate) in
            self.model.coordinates.iter().zip(&self.declared.coordinates[self.declared.before..])
        {
            if let Coordinate::Scalar(symbol) = coordinate {
                self.names.insert(written.ident.unraw().to_string(), Value::Scalar(*symbol));
            }
        }
        for (state, coordinate) in
            self.model.states.iter().zip(&self.declared.coordinates[self.declared.states.clone()])
        {
            if let Coordinate::Scalar(symbol) = coordinate {
                self.names.insert(state.ident.unraw().to_string(), Value::Scalar(*symbol));
            }
        }
        // Angular velocities are known once the kinematics are.
        self.name_rotations(&vec![self.graph.zero(); self.declared.size()]);
        for (motion, _) in &self.model.motions {
            self.names.insert(motion.unraw().to_string(), Value::Scalar(self.away(motion)));
        }
        let mut inputs = self.declared.inputs.iter().copied();
        for input in &self.model.item.inputs {
            let value = self.input(input.kind, &mut inputs);
            self.names.insert(input.ident.unraw().to_string(), value);
        }
        let mut speeds = self.declared.speeds[self.speeds_of_chart()..].iter().copied();
        for speed in self.model.speeds.iter().flatten() {
            let value = self.components(speed.kind, &mut speeds);
            self.names.insert(speed.ident.unraw().to_string(), value);
        }
    }

    /// Number of the speeds of the chart.
    pub(super) fn speeds_of_chart(&self) -> usize {
        self.declared.chart.as_ref().map_or(0, |chart| chart.kinematics.speeds.len())
    }

    /// The value of one name, or of three under one.
    fn components(&self, kind: model::SpeedKind, symbols: &mut dyn Iterator<Item = Expr<'g>>) -> Value<'g> {
        let mut next = || symbols.next().unwrap_or_else(|| self.graph.zero());
        match kind {
            model::SpeedKind::Scalar => Value::Scalar(next()),
            model::SpeedKind::Vector => Value::Vector([next(), next(), next()]),
        }
    }

    fn input(&self, kind: InputKind, symbols: &mut dyn Iterator<Item = Expr<'g>>) -> Value<'g> {
        let mut next = || symbols.next().unwrap_or_else(|| self.graph.zero());
        match kind {
            InputKind::Scalar => self.components(model::SpeedKind::Scalar, symbols),
            InputKind::Vector => self.components(model::SpeedKind::Vector, symbols),
            InputKind::Wrench => Value::Twist([next(), next(), next()], [next(), next(), next()]),
        }
    }

    /// Rotations, with their angular velocities from the kinematics.
    fn name_rotations(&mut self, kinematics: &[Expr<'g>]) {
        for (k, written) in (self.declared.before..).zip(&self.model.coordinates) {
            let rate = self.declared.rate_of(k, kinematics);
            let word = written.ident.unraw().to_string();
            let value = match (&self.declared.coordinates[k], rate) {
                (Coordinate::Rotation(matrix), &[w1, w2, w3]) => {
                    Value::Rotation(vec![RotationFactor::Given(Turn::given(*matrix, [w1, w2, w3]))])
                }
                (Coordinate::Pose(matrix, position), &[_, _, _, w1, w2, w3]) => {
                    Value::Pose(RotationFactor::Given(Turn::given(*matrix, [w1, w2, w3])), *position)
                }
                _ => continue,
            };
            self.names.insert(word, value);
        }
    }

    pub(super) fn no_links(&self) -> Tree<'g> {
        Tree::new(self.graph, Vec::new(), Vec::new(), Map::default(), None)
    }

    fn constraints(&self, tree: &Tree<'g>) -> Result<Vec<Constraint<'g>>> {
        let mut constraints = Vec::new();
        for (clause, written) in self.model.constraints.iter().enumerate() {
            let kind = match written.kind {
                model::ConstraintLevel::Position => ConstraintKind::Position,
                model::ConstraintLevel::Velocity => ConstraintKind::Velocity,
            };
            match self.value(&written.expression, tree)?.observed() {
                // So do some of those that a file makes of one relation.
                Value::Scalar(value) if written.place.is_some() && self.says_nothing(value, LIMIT) => {}
                Value::Scalar(value) => constraints.push(Constraint { kind, value, clause }),
                Value::Vector(values) => {
                    // What is identically zero, as across a plane, says nothing.
                    let values = values.into_iter().filter(|e| !self.says_nothing(*e, LIMIT));
                    constraints.extend(values.map(|value| Constraint { kind, value, clause }));
                }
                _ => return Err(bug(written.expression.span)),
            }
        }
        Ok(constraints)
    }
}

/// Terms that a component of a constraint may have while it is seen whether it vanishes.
const LIMIT: usize = 400;

pub(super) fn bug(span: Span) -> Error {
    Error::new(
        span,
        "bug in gauss-derive: an expression passed its checks but cannot be translated; please report it together with \
         this struct",
    )
}
