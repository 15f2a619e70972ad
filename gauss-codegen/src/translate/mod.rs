//! From a checked system to its symbols: expressions as the user wrote them become expressions of the algebra.
//!
//! - `symbols`: what every field, coordinate and speed is called, and where the value of each symbol is read.
//! - `values`: expressions.
//! - `domains`: expressions without a value.
//! - `forces`: what acts.
//! - `laws`: constants of what acts, for checks.
//! - `parameters`: what the numbers of fields are called.
//! - `placements`: where bodies, frames and points are.
//! - here: the scene, part by part, in the order in which one part can name another.

mod domains;
mod drag;
mod forces;
mod laws;
mod parameters;
mod placements;
mod symbols;
mod value;
mod values;

use std::cell::RefCell;
use std::collections::HashMap;

use proc_macro2::Span;
use quote::format_ident;
use syn::Ident;
use syn::ext::IdentExt;

use crate::algebra::{Expr, Graph, Map, OwnFunction, Rational};
use crate::mechanics::{
    Body, ChartedBody, Constraint, ConstraintKind, Coordinate, Element, Lettering, Matter, Observed, Placement,
    QuantityValues, SystemScene, Tree, Turn, poisson,
};
use crate::model::{
    self, BinaryOperator, ExpressionKind, FunctionClause, FunctionName, InChart, Model, Property, Role, RoleClause,
    RoleValue, Shape, SpeedPart,
};

pub use drag::DragMatrix;
pub use laws::{Law, LawKind};
pub use parameters::{Parameter, parameters};
use symbols::Declared;
pub use symbols::{Part, Source};
use value::{Piece, Value};

/// Translates a system; kept between two translations of one system with different speeds.
pub struct Translator<'a, 'g> {
    graph: &'g Graph,
    model: &'a Model,
    declared: Declared<'g>,
    names: HashMap<String, Value<'g>>,
    /// Indices of bodies and frames among the links, by name.
    links: HashMap<String, usize>,
    /// Which link each clause of a body or frame became.
    links_of_clauses: Vec<usize>,
    /// Functions that clauses declare, by name.
    functions: HashMap<String, OwnFunction>,
    pi: Expr<'g>,
    /// Literal numbers that are constants of their own.
    literals: RefCell<Vec<(Rational, Expr<'g>)>>,
    /// Numbers with which checks may not be sure, where they are written.
    extreme: RefCell<Vec<(Span, Rational)>>,
    /// Expressions without a value.
    mistakes: RefCell<Vec<(Span, String)>>,
    /// Matrices of drag, for warnings.
    drags: RefCell<Vec<DragMatrix<'g>>>,
    /// Constants of elements, for checks and warnings.
    laws: RefCell<Vec<Law<'g>>>,
    /// ḃ and ω̂ of each coordinate that is a pose or a rotation, where the kinematics give them rather than u and ω.
    observed_rates: Vec<[Option<[Expr<'g>; 3]>; 2]>,
    /// The chart's motion, with the speeds as they are now.
    chart: Option<ChartedBody<'g>>,
    /// The motion of the only body, where it is known by symbols of its own.
    observed: Option<Observed<'g>>,
    /// ψ, and the rates of t and of the symbols of q.
    kinematics: Vec<Expr<'g>>,
    rates: Map<u32, Expr<'g>>,
}

impl<'a, 'g> Translator<'a, 'g> {
    /// # Errors
    /// Only what the model should have refused: a bug of this crate.
    pub fn new(graph: &'g Graph, model: &'a Model) -> syn::Result<Self> {
        let declared = Declared::new(graph, model);
        let (names, links) = (HashMap::new(), HashMap::new());
        let function = |clause: &FunctionClause| {
            let name = clause.name.unraw().to_string();
            let index = graph.declare_function(name.clone());
            (name, OwnFunction::new(index, clause.kind.continuous()))
        };
        let pi = graph.symbol("π", "\\pi", true);
        let mut translator = Self {
            graph,
            model,
            declared,
            names,
            links,
            links_of_clauses: vec![0; model.bodies.len()],
            functions: model.functions.iter().map(function).collect(),
            pi,
            literals: RefCell::new(vec![(symbols::pi(), pi)]),
            extreme: RefCell::default(),
            mistakes: RefCell::default(),
            drags: RefCell::default(),
            laws: RefCell::default(),
            observed_rates: vec![[None; 2]; model.coordinates.len()],
            chart: None,
            observed: None,
            kinematics: Vec::new(),
            rates: Map::default(),
        };
        translator.assign_mass_data()?;
        Ok(translator)
    }

    /// Puts what clauses say of bodies and of gravity in the place of their symbols.
    fn assign_mass_data(&mut self) -> syn::Result<()> {
        let model = self.model;
        self.names.extend(self.declared.fields.iter().cloned());
        self.names.insert("pi".to_owned(), Value::Scalar(self.pi));
        let values = self.quantity_values(&model.role_clauses)?;
        if let Some(gravity) = values.iter().find(|values| values.quantity == Role::Gravity) {
            let zero = self.graph.zero();
            self.declared.gravity = match gravity.values.as_slice() {
                &[x, y, z] => Some([x, y, z]),
                values => values.first().map(|&g| symbols::free_fall(model, zero, g)),
            };
        }
        for (k, clause) in model.bodies.iter().enumerate() {
            let own = if clause.name.is_some() { self.quantity_values(&clause.role_clauses)? } else { values.clone() };
            if let Some(body) = &mut self.declared.bodies[k] {
                own.iter().for_each(|own| body.assign(own));
                body.gravity = self.declared.gravity;
            }
        }
        Ok(())
    }

    /// The values of mass data in clauses.
    ///
    /// # Errors
    /// Only what the model should have refused: a bug of this crate.
    pub fn quantity_values(&self, clauses: &[RoleClause]) -> syn::Result<Vec<QuantityValues<'g>>> {
        let nothing = self.no_links();
        let value = |clause: &RoleClause| {
            let values = match &clause.value {
                RoleValue::Expression(e) => match self.value(e, &nothing)?.observed() {
                    Value::Scalar(value) => vec![value],
                    Value::Vector(values) => values.to_vec(),
                    _ => return Err(bug(clause.span)),
                },
                RoleValue::Coefficients(coefficients) => {
                    let matrix = self.coefficients(coefficients, &nothing)?;
                    // Of a matrix the entries on and below the diagonal, column by column, as a body has them.
                    let below = |i: usize| (i..6).map(move |j| (j, i));
                    match clause.shape {
                        Shape::Matrix6 => (0..6).flat_map(below).map(|(i, j)| matrix[i][j]).collect(),
                        _ => (0..6).map(|i| matrix[i][i]).collect(),
                    }
                }
            };
            let quantity = clause.role;
            Ok(QuantityValues { quantity, values })
        };
        clauses.iter().map(value).collect()
    }

    /// Where the symbols of parameters are read.
    pub fn sources(&self) -> &[Source<'g>] {
        &self.declared.sources
    }

    /// Literal numbers that symbols stand for.
    pub fn literals(&self) -> Vec<(Rational, Expr<'g>)> {
        self.literals.borrow().clone()
    }

    /// Matrices of drag.
    pub fn drags(&self) -> Vec<DragMatrix<'g>> {
        self.drags.borrow().clone()
    }

    /// Constants of elements.
    pub fn laws(&self) -> Vec<Law<'g>> {
        self.laws.borrow().clone()
    }

    /// Which link each clause of a body or frame became.
    pub fn links_of_clauses(&self) -> Vec<usize> {
        self.links_of_clauses.clone()
    }

    /// The links of the frames that are asked for, in their order.
    pub fn links_of_frames(&self) -> Vec<usize> {
        let link = |name: &Ident| self.links.get(&name.unraw().to_string()).copied();
        self.model.wanted.frames.iter().filter_map(link).collect()
    }

    /// All speeds, as they are declared.
    pub fn speeds(&self) -> &[Expr<'g>] {
        &self.declared.speeds
    }

    /// Indices of the speeds with the given names: three for a vector, one for a component.
    pub fn indices_of_speeds(&self, names: &[SpeedPart]) -> Vec<usize> {
        let idents = self.speed_idents();
        let component = |k: usize| idents[..k].iter().rev().take_while(|earlier| **earlier == idents[k]).count();
        let named = |k: usize, name: &SpeedPart| {
            name.ident == idents[k] && name.component.is_none_or(|named| named == component(k))
        };
        (0..idents.len()).filter(|&k| names.iter().any(|name| named(k, name))).collect()
    }

    /// The declared coordinate whose rate a speed is, where no speeds are declared.
    pub fn coordinate_of_speed(&self, speed: usize) -> Option<&'a model::Coordinate> {
        let coordinate = Coordinate::of_component(&self.declared.coordinates, speed);
        self.model.coordinates.get(coordinate.checked_sub(self.declared.before)?)
    }

    /// Names of the speeds as the user writes them: three for a vector.
    pub fn speed_idents(&self) -> Vec<Ident> {
        let of_chart = self.model.in_chart.map(InChart::speed_words).unwrap_or_default();
        let of_chart = of_chart.into_iter().map(|word| format_ident!("{word}"));
        let own = self.model.speeds.iter().flatten();
        let own = own.flat_map(|z| std::iter::repeat_n(z.ident.clone(), symbols::size_of_speed(z.kind)));
        of_chart.chain(own).collect()
    }

    /// The scene with the given values of the declared speeds, of which those of `kept` are its speeds.
    ///
    /// # Errors
    /// Only what the model should have refused: a bug of this crate.
    pub fn scene(&mut self, values: &[Expr<'g>], kept: &[usize]) -> syn::Result<SystemScene<'g>> {
        let (graph, model) = (self.graph, self.model);
        let time = self.declared.time;
        let of_chart = self.declared.chart.as_ref();
        self.chart = of_chart.map(|chart| chart.with_speeds(&values[..chart.kinematics.speeds.len()]));
        self.name_everything(values);
        self.kinematics = self.kinematics(values)?;
        self.rates = self.rates();
        self.name_rotations(&self.kinematics.clone());
        let pick = |all: &[Expr<'g>]| -> Vec<Expr<'g>> { kept.iter().map(|&k| all[k]).collect() };
        let speeds = pick(&self.declared.speeds);
        let placements = self.placements()?;
        let mut tree = Tree::new(graph, placements, speeds.clone(), self.rates.clone(), self.declared.gravity);
        self.name_points(&tree)?;
        for clause in &model.particles {
            let parent = clause.parent.as_ref().and_then(|name| self.links.get(&name.unraw().to_string()).copied());
            tree.hang(Placement {
                matter: Matter::Particle(self.scalar(&clause.mass, &tree)?),
                parent,
                position: self.vector(&clause.position, &tree)?,
                velocity: None,
                angular_velocity: None,
                turns: Vec::new(),
            });
        }
        tree.rotors = self.rotors(&tree)?;
        let elements = match (model.one_body(), self.chart.clone()) {
            (Some(_), Some(chart)) => self.elements_on(&chart)?,
            _ => self.elements(&tree)?.into_iter().map(|(_, element)| element).collect(),
        };
        let constraints = self.constraints(&tree)?;
        tree.settle();
        Ok(SystemScene {
            graph,
            time,
            coordinates: self.declared.coordinates.clone(),
            coordinate_names: self.declared.coordinate_names.clone(),
            lettering: if model.one_body().is_some() { Lettering::Textbook } else { Lettering::Declared },
            momentum_names: kept.iter().map(|&k| self.declared.momentum_names[k].clone()).collect(),
            force_names: kept.iter().map(|&k| self.declared.force_names[k].clone()).collect(),
            speed_rates: pick(&self.declared.speed_rates),
            momenta: pick(&self.declared.momenta),
            speeds,
            kinematics: self.kinematics.clone(),
            rates: self.rates.clone(),
            tree,
            constraints,
            inputs: self.declared.inputs.clone(),
            elements,
        })
    }

    /// The same scene of other bodies, each in place of one.
    ///
    /// # Errors
    /// As [`scene`](Self::scene).
    pub fn scene_of(
        &mut self,
        other: impl Fn(&Body<'g>) -> Body<'g>,
        values: &[Expr<'g>],
        kept: &[usize],
    ) -> syn::Result<SystemScene<'g>> {
        let others = self.declared.bodies.iter().map(|body| body.as_ref().map(&other)).collect();
        let bodies = std::mem::replace(&mut self.declared.bodies, others);
        let scene = self.scene(values, kept);
        self.declared.bodies = bodies;
        scene
    }

    /// What acts on the only body, whose motion a chart describes: translated in terms of symbols for it, so that each part of a
    /// wrench stays in the axes where it arises.
    fn elements_on(&mut self, chart: &ChartedBody<'g>) -> syn::Result<Vec<Element<'g>>> {
        if !self.model.is_acted_upon() {
            return Ok(Vec::new());
        }
        let observed = Observed::new(self.graph, self.declared.time);
        let rates = std::mem::replace(&mut self.rates, observed.rates.clone());
        let body = self.declared.bodies.first().cloned().flatten().ok_or_else(|| bug(self.model.ident.span()))?;
        let placement = Placement {
            matter: Matter::Body(Box::new(body)),
            parent: None,
            position: observed.position,
            velocity: None,
            angular_velocity: None,
            turns: vec![Turn::given(observed.rotation, observed.body_angular_velocity)],
        };
        let tree = Tree::new(self.graph, vec![placement], Vec::new(), self.rates.clone(), None);
        self.observed = Some(observed);
        let elements = self.name_points(&tree).and_then(|()| self.elements(&tree));
        self.rates = rates;
        let observed = self.observed.take().ok_or_else(|| bug(self.model.ident.span()))?;
        let mut in_motion = Vec::new();
        for (span, element) in elements? {
            match self.graph.defined(|| observed.in_motion(&chart.kinematics, &element)) {
                Some(element) => in_motion.push(element),
                None => self.divides_by_zero(span, &element.name),
            }
        }
        Ok(in_motion)
    }

    fn name_everything(&mut self, values: &[Expr<'g>]) {
        self.drags.borrow_mut().clear();
        self.laws.borrow_mut().clear();
        self.names.clear();
        self.links.clear();
        self.names.insert("t".to_owned(), Value::Scalar(self.declared.time));
        self.names.insert("pi".to_owned(), Value::Scalar(self.pi));
        self.names.extend(self.declared.fields.iter().cloned());
        for (written, coordinate) in
            self.model.coordinates.iter().zip(&self.declared.coordinates[self.declared.before..])
        {
            if let Coordinate::Scalar(symbol) = coordinate {
                self.names.insert(written.ident.unraw().to_string(), Value::Scalar(*symbol));
            }
        }
        // Angular velocities are known once the kinematics are.
        self.name_rotations(&vec![self.graph.zero(); self.declared.size()]);
        let mut inputs = self.declared.inputs.iter().copied();
        for input in &self.model.inputs {
            let value = self.input(input.kind, &mut inputs);
            self.names.insert(input.ident.unraw().to_string(), value);
        }
        let mut values = values[self.speeds_of_chart()..].iter().copied();
        for speed in self.model.speeds.iter().flatten() {
            let value = self.components(speed.kind, &mut values);
            self.names.insert(speed.ident.unraw().to_string(), value);
        }
    }

    /// How many of the speeds are the chart's.
    fn speeds_of_chart(&self) -> usize {
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

    fn input(&self, kind: model::InputKind, symbols: &mut dyn Iterator<Item = Expr<'g>>) -> Value<'g> {
        let mut next = || symbols.next().unwrap_or_else(|| self.graph.zero());
        match kind {
            model::InputKind::Scalar => self.components(model::SpeedKind::Scalar, symbols),
            model::InputKind::Vector => self.components(model::SpeedKind::Vector, symbols),
            model::InputKind::Wrench => Value::Twist([next(), next(), next()], [next(), next(), next()]),
        }
    }

    /// Rotations, with their angular velocities from the kinematics.
    fn name_rotations(&mut self, kinematics: &[Expr<'g>]) {
        for (k, written) in (self.declared.before..).zip(&self.model.coordinates) {
            let rate = self.declared.rate_of(k, kinematics);
            let word = written.ident.unraw().to_string();
            let value = match (&self.declared.coordinates[k], rate) {
                (Coordinate::Rotation(matrix), &[w1, w2, w3]) => {
                    Value::Rotation(vec![Piece::Given(Turn::given(*matrix, [w1, w2, w3]))])
                }
                (Coordinate::Pose(matrix, position), &[_, _, _, w1, w2, w3]) => {
                    Value::Pose(Piece::Given(Turn::given(*matrix, [w1, w2, w3])), *position)
                }
                _ => continue,
            };
            self.names.insert(word, value);
        }
    }

    /// ψ, in the order of the coordinates.
    fn kinematics(&mut self, values: &[Expr<'g>]) -> syn::Result<Vec<Expr<'g>>> {
        let mut rates = self.chart.as_ref().map(ChartedBody::coordinate_rates).unwrap_or_default();
        if self.model.speeds.is_none() {
            rates.extend(&values[self.speeds_of_chart()..]);
            return Ok(rates);
        }
        let nothing = self.no_links();
        for (k, (_, e)) in self.model.kinematics.iter().enumerate() {
            self.observed_rates[k] = self.observed_rates_of(k, e, &nothing)?;
            match self.value(e, &nothing)?.observed() {
                Value::Scalar(rate) => rates.push(rate),
                Value::Vector(omega) => rates.extend(omega),
                Value::Twist(linear, angular) => rates.extend(linear.into_iter().chain(angular)),
                _ => return Err(bug(e.span)),
            }
        }
        Ok(rates)
    }

    /// v and w of `twist(inverse(pose.rotation) * v, inverse(pose.rotation) * w)`, and w of `inverse(rotation) * w`: turned back into
    /// observer's axes they are what they were.
    fn observed_rates_of(
        &self,
        coordinate: usize,
        rate: &model::Expression,
        nothing: &Tree<'g>,
    ) -> syn::Result<[Option<[Expr<'g>; 3]>; 2]> {
        let own = &self.model.coordinates[coordinate].ident;
        let turned_back = |e: &model::Expression| -> syn::Result<Option<[Expr<'g>; 3]>> {
            let ExpressionKind::Binary(BinaryOperator::Multiply, turned, v) = &e.kind else { return Ok(None) };
            let ExpressionKind::Call(FunctionName::Inverse, rotation) = &turned.kind else { return Ok(None) };
            let Some(rotation) = rotation.first() else { return Ok(None) };
            let of_pose = name_of_property(rotation, Property::Rotation);
            let itself = matches!(&rotation.kind, ExpressionKind::Name(name) if name.unraw() == own.unraw());
            if itself || of_pose.is_some_and(|pose| own.unraw() == pose) {
                self.vector(v, nothing).map(Some)
            } else {
                Ok(None)
            }
        };
        match &rate.kind {
            ExpressionKind::Call(FunctionName::Twist, parts) => match parts.as_slice() {
                [linear, angular] => Ok([turned_back(linear)?, turned_back(angular)?]),
                _ => Ok([None; 2]),
            },
            _ => Ok([None, turned_back(rate)?]),
        }
    }

    fn no_links(&self) -> Tree<'g> {
        Tree::new(self.graph, Vec::new(), Vec::new(), Map::default(), None)
    }

    /// Rates of t and of the symbols of q: Ṙ = R [ω]× (Poisson), ḃ = R u.
    fn rates(&self) -> Map<u32, Expr<'g>> {
        let mut rates: Map<u32, Expr<'g>> = Map::from_iter([(self.declared.time.key(), self.graph.one())]);
        rates
            .extend(self.chart.iter().flat_map(|chart| chart.kinematics.rates.iter()).map(|(&key, &rate)| (key, rate)));
        let own = || self.declared.coordinates.iter().enumerate().skip(self.declared.before);
        for (k, coordinate) in own() {
            let rate = self.declared.rate_of(k, &self.kinematics);
            if let (Some(matrix), &[.., w1, w2, w3]) = (coordinate.rotation(), rate) {
                rates.extend(poisson(matrix, &[w1, w2, w3]));
            }
        }
        for (k, coordinate) in own() {
            let rate = self.declared.rate_of(k, &self.kinematics);
            match coordinate {
                Coordinate::Scalar(q) => {
                    rates.insert(q.key(), rate[0]);
                }
                // Of planes the chart's own rates are known.
                Coordinate::Rotation(_) | Coordinate::Plane { .. } => {}
                Coordinate::Pose(matrix, position) => {
                    for (i, (row, b)) in matrix.iter().zip(position).enumerate() {
                        let turned = || (0..3).map(|k| row[k] * rate[k]).sum();
                        let [observed, _] = self.observed_rates[k - self.declared.before];
                        rates.insert(b.key(), observed.map_or_else(turned, |v| v[i]));
                    }
                }
            }
        }
        rates
    }

    fn constraints(&self, tree: &Tree<'g>) -> syn::Result<Vec<Constraint<'g>>> {
        let mut constraints = Vec::new();
        for (clause, written) in self.model.constraints.iter().enumerate() {
            let kind = match written.kind {
                model::ConstraintKind::Position => ConstraintKind::Position,
                model::ConstraintKind::Velocity => ConstraintKind::Velocity,
            };
            match self.value(&written.expression, tree)?.observed() {
                // So do some of those that a file makes of one relation.
                Value::Scalar(value) if written.place.is_some() && value.collected(LIMIT).is_zero() => {}
                Value::Scalar(value) => constraints.push(Constraint { kind, value, clause }),
                Value::Vector(values) => {
                    // What is identically zero, as across a plane, says nothing.
                    let values = values.into_iter().filter(|e| !e.collected(LIMIT).is_zero());
                    constraints.extend(values.map(|value| Constraint { kind, value, clause }));
                }
                _ => return Err(bug(written.expression.span)),
            }
        }
        Ok(constraints)
    }
}

/// The name of `name.property`.
fn name_of_property(e: &model::Expression, wanted: Property) -> Option<String> {
    match &e.kind {
        ExpressionKind::Property(inner, property) if *property == wanted => match &inner.kind {
            ExpressionKind::Name(name) => Some(name.unraw().to_string()),
            _ => None,
        },
        _ => None,
    }
}

/// Terms that a component of a constraint may have while it is seen whether it vanishes.
const LIMIT: usize = 400;

fn bug(span: Span) -> syn::Error {
    syn::Error::new(
        span,
        "bug in gauss-derive: an expression passed its checks but cannot be translated; please report it together with \
         this struct",
    )
}
