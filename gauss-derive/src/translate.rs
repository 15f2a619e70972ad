//! From a checked system to its symbols: expressions as the user wrote them become expressions of the algebra.

use std::collections::HashMap;

use proc_macro2::Span;
use syn::Ident;
use syn::ext::IdentExt;

use crate::algebra::{Expr, Graph, Rational};
use crate::mechanics::{
    AddedMassShape, Body, BodyShape, GravityShape, InertiaShape, Link, Name, Particle, Quantity, SystemScene, Turn,
    about_axis,
};
use crate::model::{
    BinaryOperator, BodyClause, CoordinateKind, Expression, ExpressionKind, FunctionName, Role, Shape, SpeedKind,
    SystemField, SystemModel,
};

/// Which number of a field a symbol stands for.
#[derive(Clone, Copy, Debug)]
pub enum Part {
    Scalar,
    Component(usize),
    Entry(usize, usize),
    /// Of a `RigidBody`.
    Body(Quantity, usize, usize),
}

/// A symbol and where its value is read.
#[derive(Clone, Copy)]
pub struct Source<'g> {
    pub symbol: Expr<'g>,
    /// Index of the field.
    pub field: usize,
    pub part: Part,
}

/// A system in symbols, and what they stand for.
pub struct Translation<'g> {
    pub scene: SystemScene<'g>,
    pub sources: Vec<Source<'g>>,
}

#[derive(Clone)]
enum Value<'g> {
    Scalar(Expr<'g>),
    Vector([Expr<'g>; 3]),
    Rotation(Vec<Turn<'g>>),
}

struct Translator<'a, 'g> {
    graph: &'g Graph,
    model: &'a SystemModel,
    names: HashMap<String, Value<'g>>,
    sources: Vec<Source<'g>>,
}

/// Translates a whole system.
///
/// # Errors
/// Only what the model should have refused: a bug of this crate.
pub fn translate<'g>(graph: &'g Graph, model: &SystemModel) -> syn::Result<Translation<'g>> {
    let mut translator = Translator { graph, model, names: HashMap::new(), sources: Vec::new() };
    translator.translate()
}

fn name_of(ident: &Ident) -> Name {
    const GREEK: [&str; 22] = [
        "alpha", "beta", "gamma", "delta", "epsilon", "zeta", "eta", "theta", "iota", "kappa", "lambda", "mu", "nu",
        "xi", "pi", "rho", "sigma", "tau", "phi", "chi", "psi", "omega",
    ];
    let text = ident.unraw().to_string();
    let stem = text.trim_end_matches(|c: char| c.is_ascii_digit());
    let index = &text[stem.len()..];
    let letter = match stem {
        stem if GREEK.contains(&stem) => format!("\\{stem}"),
        stem if stem.chars().count() > 1 => format!("\\mathit{{{}}}", stem.replace('_', "\\_")),
        stem => stem.to_owned(),
    };
    let latex = if index.is_empty() { letter } else { format!("{letter}_{{{index}}}") };
    Name { text, latex }
}

/// A speed of the jet chart: a dot over a letter, a quotient for a word.
fn velocity_name(name: &Name) -> Name {
    if name.text.trim_end_matches(|c: char| c.is_ascii_digit()).chars().count() == 1 {
        name.dot()
    } else {
        Name { text: name.time_derivative().text, latex: name.dot().latex }
    }
}

impl<'g> Translator<'_, 'g> {
    fn symbol(&self, name: &Name, constant: bool) -> Expr<'g> {
        self.graph.symbol(name.text.clone(), name.latex.clone(), constant)
    }

    fn translate(&mut self) -> syn::Result<Translation<'g>> {
        let model = self.model;
        let graph = self.graph;
        refuse_what_is_new(model)?;
        let time = graph.symbol("t", "t", false);
        self.names.insert("t".to_owned(), Value::Scalar(time));
        let coordinate_names: Vec<Name> = model.coordinates.iter().map(|q| name_of(&q.ident)).collect();
        let coordinates: Vec<Expr<'g>> = coordinate_names.iter().map(|name| self.symbol(name, false)).collect();
        for (name, symbol) in coordinate_names.iter().zip(&coordinates) {
            self.names.insert(name.text.clone(), Value::Scalar(*symbol));
        }
        let speed_names: Vec<Name> = match &model.speeds {
            Some(speeds) => speeds.iter().map(|z| name_of(&z.ident)).collect(),
            None => coordinate_names.iter().map(velocity_name).collect(),
        };
        let speeds: Vec<Expr<'g>> = speed_names.iter().map(|name| self.symbol(name, false)).collect();
        if model.speeds.is_some() {
            for (name, symbol) in speed_names.iter().zip(&speeds) {
                self.names.insert(name.text.clone(), Value::Scalar(*symbol));
            }
        }
        let speed_rates = speed_names.iter().map(|name| self.symbol(&name.rate(), false)).collect();
        let momenta = speed_names.iter().map(|name| self.symbol(&Name::new("p", "p").of(name), false)).collect();
        let gravity = self.plain_fields();
        let bodies: Vec<Body<'g>> = model.bodies.iter().map(|clause| self.body(clause, gravity)).collect();
        let kinematics = if model.speeds.is_some() {
            model.kinematics.iter().map(|(_, e)| self.scalar(e)).collect::<syn::Result<_>>()?
        } else {
            speeds.clone()
        };
        let mut links = Vec::with_capacity(bodies.len());
        for (clause, body) in model.bodies.iter().zip(bodies) {
            let named = |name: &Ident| model.bodies.iter().position(|b| b.name.as_ref().is_some_and(|n| n == name));
            links.push(Link {
                body,
                parent: clause.parent.as_ref().and_then(named),
                position: clause.position.as_ref().map_or(Ok([graph.zero(); 3]), |e| self.vector(e))?,
                turns: clause.rotation.as_ref().map_or(Ok(Vec::new()), |e| self.rotation(e))?,
            });
        }
        let mut particles = Vec::with_capacity(model.particles.len());
        for clause in &model.particles {
            particles.push(Particle { mass: self.scalar(&clause.mass)?, position: self.vector(&clause.position)? });
        }
        let potential = model.potential.as_ref().map(|e| self.scalar(e)).transpose()?;
        let scene = SystemScene {
            graph,
            time,
            coordinates,
            coordinate_names,
            speeds,
            speed_names,
            speed_rates,
            momenta,
            kinematics,
            links,
            particles,
            potential,
            gravity,
        };
        Ok(Translation { scene, sources: std::mem::take(&mut self.sources) })
    }

    /// Symbols for gravity and for every field without a role that expressions can name; the acceleration of free fall.
    fn plain_fields(&mut self) -> Option<[Expr<'g>; 3]> {
        let model = self.model;
        let mut gravity = None;
        for (field, SystemField { ident, role, shape, .. }) in model.fields.iter().enumerate() {
            if !matches!(role, None | Some(Role::Gravity)) {
                continue;
            }
            let name = if role.is_some() { Name::new("g", "g") } else { name_of(ident) };
            let value = match shape {
                Shape::Scalar => {
                    let symbol = self.symbol(&name, true);
                    self.sources.push(Source { symbol, field, part: Part::Scalar });
                    Value::Scalar(symbol)
                }
                Shape::Vector3 => Value::Vector(std::array::from_fn(|i| {
                    let symbol = self.symbol(&name.index(i), true);
                    self.sources.push(Source { symbol, field, part: Part::Component(i) });
                    symbol
                })),
                _ => continue,
            };
            if role.is_some() {
                let zero = self.graph.zero();
                gravity = Some(match &value {
                    Value::Vector(vector) => *vector,
                    Value::Scalar(g) => [zero, zero, -*g],
                    Value::Rotation(_) => [zero; 3],
                });
            }
            self.names.insert(ident.unraw().to_string(), value);
        }
        gravity
    }

    /// The mass data of a body, under the names of the fields that have them.
    fn body(&mut self, clause: &BodyClause, gravity: Option<[Expr<'g>; 3]>) -> Body<'g> {
        let model = self.model;
        let mut body = match &clause.name {
            Some(name) => {
                let shape = BodyShape {
                    inertia: InertiaShape::Full,
                    center_of_mass: true,
                    added_mass: None,
                    gravity: None,
                    displaced_mass: false,
                    center_of_buoyancy: false,
                };
                let body = Body::named(self.graph, shape, 2, name_of(name));
                let field = model.fields.iter().position(|f| f.ident == *name).unwrap_or_default();
                self.sources.extend(body.parameters.iter().map(|p| Source {
                    symbol: p.symbol,
                    field,
                    part: Part::Body(p.quantity, p.row, p.column),
                }));
                body
            }
            None => self.unnamed_body(),
        };
        body.gravity = gravity;
        body
    }

    fn unnamed_body(&mut self) -> Body<'g> {
        let fields = &self.model.fields;
        let field = |role: Role| fields.iter().position(|f| f.role == Some(role));
        let shape_of = |role: Role| field(role).map(|k| fields[k].shape);
        let shape = BodyShape {
            inertia: match shape_of(Role::Inertia) {
                Some(Shape::Scalar) => InertiaShape::Spherical,
                Some(Shape::Vector3) => InertiaShape::Principal,
                _ => InertiaShape::Full,
            },
            center_of_mass: field(Role::CenterOfMass).is_some(),
            added_mass: shape_of(Role::AddedMass).map(|shape| match shape {
                Shape::Vector6 => AddedMassShape::Diagonal,
                _ => AddedMassShape::Full,
            }),
            gravity: None::<GravityShape>,
            displaced_mass: field(Role::DisplacedMass).is_some(),
            center_of_buoyancy: field(Role::CenterOfBuoyancy).is_some(),
        };
        let body = Body::new(self.graph, shape, 2);
        for role in [
            Role::Mass,
            Role::CenterOfMass,
            Role::Inertia,
            Role::AddedMass,
            Role::DisplacedMass,
            Role::CenterOfBuoyancy,
        ] {
            let Some(field) = field(role) else { continue };
            let quantity = quantity_of(role);
            let own: Vec<_> = body.parameters.iter().filter(|p| Some(p.quantity) == quantity).collect();
            let shape = fields[field].shape;
            self.sources.extend(own.iter().map(|p| Source {
                symbol: p.symbol,
                field,
                part: match shape {
                    Shape::Scalar => Part::Scalar,
                    Shape::Vector3 | Shape::Vector6 => Part::Component(p.row),
                    _ => Part::Entry(p.row, p.column),
                },
            }));
            let value = match (shape, own.as_slice()) {
                (Shape::Scalar, [p]) => Value::Scalar(p.symbol),
                (Shape::Vector3, [a, b, c]) => Value::Vector([a.symbol, b.symbol, c.symbol]),
                _ => continue,
            };
            self.names.insert(fields[field].ident.unraw().to_string(), value);
        }
        body
    }

    fn scalar(&self, e: &Expression) -> syn::Result<Expr<'g>> {
        match self.value(e)? {
            Value::Scalar(value) => Ok(value),
            _ => Err(bug(e.span)),
        }
    }

    fn vector(&self, e: &Expression) -> syn::Result<[Expr<'g>; 3]> {
        match self.value(e)? {
            Value::Vector(value) => Ok(value),
            _ => Err(bug(e.span)),
        }
    }

    fn rotation(&self, e: &Expression) -> syn::Result<Vec<Turn<'g>>> {
        match self.value(e)? {
            Value::Rotation(value) => Ok(value),
            _ => Err(bug(e.span)),
        }
    }

    fn value(&self, e: &Expression) -> syn::Result<Value<'g>> {
        Ok(match &e.kind {
            ExpressionKind::Number { numerator, denominator } => {
                Value::Scalar(self.graph.number(Rational::new(*numerator, *denominator)))
            }
            ExpressionKind::Name(name) => {
                self.names.get(&name.unraw().to_string()).cloned().ok_or_else(|| bug(e.span))?
            }
            ExpressionKind::Component(inner, k) => {
                Value::Scalar(*self.vector(inner)?.get(*k).ok_or_else(|| bug(e.span))?)
            }
            ExpressionKind::Negate(inner) => match self.value(inner)? {
                Value::Scalar(a) => Value::Scalar(-a),
                Value::Vector(a) => Value::Vector(a.map(|a| -a)),
                Value::Rotation(_) => return Err(bug(e.span)),
            },
            ExpressionKind::Property(..) => return Err(bug(e.span)),
            ExpressionKind::Power(inner, exponent) => Value::Scalar(self.scalar(inner)?.powi(*exponent)),
            ExpressionKind::Vector([a, b, c]) => Value::Vector([self.scalar(a)?, self.scalar(b)?, self.scalar(c)?]),
            ExpressionKind::Call(function, arguments) => self.call(*function, arguments, e.span)?,
            ExpressionKind::Binary(operator, left, right) => {
                self.binary(*operator, self.value(left)?, self.value(right)?).ok_or_else(|| bug(e.span))?
            }
        })
    }

    fn binary(&self, operator: BinaryOperator, left: Value<'g>, right: Value<'g>) -> Option<Value<'g>> {
        use BinaryOperator::{Add, Divide, Multiply, Subtract};
        use Value::{Rotation, Scalar, Vector};
        Some(match (operator, left, right) {
            (Add, Scalar(a), Scalar(b)) => Scalar(a + b),
            (Add, Vector(a), Vector(b)) => Vector(std::array::from_fn(|i| a[i] + b[i])),
            (Subtract, Scalar(a), Scalar(b)) => Scalar(a - b),
            (Subtract, Vector(a), Vector(b)) => Vector(std::array::from_fn(|i| a[i] - b[i])),
            (Multiply, Scalar(a), Scalar(b)) => Scalar(a * b),
            (Multiply, Scalar(a), Vector(b)) | (Multiply, Vector(b), Scalar(a)) => Vector(b.map(|b| a * b)),
            (Multiply, Rotation(a), Rotation(b)) => Rotation(a.into_iter().chain(b).collect()),
            (Multiply, Rotation(a), Vector(b)) => Vector(a.iter().rev().fold(b, |b, turn| {
                let matrix = about_axis(self.graph, turn.axis, turn.angle);
                std::array::from_fn(|i| (0..3).map(|j| matrix[i][j] * b[j]).sum())
            })),
            (Divide, Scalar(a), Scalar(b)) => Scalar(a * b.recip()),
            (Divide, Vector(a), Scalar(b)) => Vector(a.map(|a| a * b.recip())),
            _ => return None,
        })
    }

    fn call(&self, function: FunctionName, arguments: &[Expression], span: Span) -> syn::Result<Value<'g>> {
        let turn = |axis, angle| Value::Rotation(vec![Turn { axis, angle }]);
        Ok(match (function, arguments) {
            (FunctionName::Sin, [a]) => Value::Scalar(self.scalar(a)?.sin()),
            (FunctionName::Cos, [a]) => Value::Scalar(self.scalar(a)?.cos()),
            // The sine–cosine pair is shared with whatever else turns by the angle.
            (FunctionName::Tan, [a]) => Value::Scalar(self.scalar(a)?.sin() * self.scalar(a)?.cos().recip()),
            (FunctionName::Exp, [a]) => Value::Scalar(self.scalar(a)?.exp()),
            (FunctionName::Ln, [a]) => Value::Scalar(self.scalar(a)?.ln()),
            (FunctionName::Sqrt, [a]) => Value::Scalar(self.scalar(a)?.sqrt()),
            (FunctionName::RotationX, [a]) => turn(0, self.scalar(a)?),
            (FunctionName::RotationY, [a]) => turn(1, self.scalar(a)?),
            (FunctionName::RotationZ, [a]) => turn(2, self.scalar(a)?),
            (FunctionName::Dot, [a, b]) => {
                let (a, b) = (self.vector(a)?, self.vector(b)?);
                Value::Scalar((0..3).map(|i| a[i] * b[i]).sum())
            }
            (FunctionName::Cross, [a, b]) => {
                let (a, b) = (self.vector(a)?, self.vector(b)?);
                Value::Vector([a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]])
            }
            _ => return Err(bug(span)),
        })
    }
}

fn quantity_of(role: Role) -> Option<Quantity> {
    Some(match role {
        Role::Mass => Quantity::Mass,
        Role::CenterOfMass => Quantity::CenterOfMass,
        Role::Inertia => Quantity::Inertia,
        Role::AddedMass => Quantity::AddedMass,
        Role::Gravity => Quantity::Gravity,
        Role::DisplacedMass => Quantity::DisplacedMass,
        Role::CenterOfBuoyancy => Quantity::CenterOfBuoyancy,
        Role::Body => return None,
    })
}

/// What the model accepts and this stage does not translate yet.
fn refuse_what_is_new(model: &SystemModel) -> syn::Result<()> {
    let coordinate = model.coordinates.iter().find(|q| q.kind != CoordinateKind::Scalar).map(|q| q.ident.span());
    let speed = model.speeds.iter().flatten().find(|z| z.kind != SpeedKind::Scalar).map(|z| z.ident.span());
    let frame = model.bodies.iter().find(|body| body.massless).map(|body| body.span);
    let particle = model.particles.iter().find_map(|particle| particle.parent.as_ref()).map(Ident::span);
    let point = model.points.first().map(|point| point.span);
    let constraint = model.constraints.first().map(|constraint| constraint.span);
    match coordinate.or(speed).or(frame).or(particle).or(point).or(constraint) {
        Some(span) => Err(bug(span)),
        None => Ok(()),
    }
}

fn bug(span: Span) -> syn::Error {
    syn::Error::new(
        span,
        "bug in gauss-derive: an expression of the wrong kind; please report it together with this struct",
    )
}
