//! Symbols of everything that is declared, and where the value of each is read.

use std::ops::Range;

use proc_macro2::Ident;

use crate::algebra::{Expr, Graph, Rational};
use crate::mechanics::{Body, BodyShape, ChartedBody, Coordinate, Name, ParameterSymbol};
use crate::model::{self, BodyClause, CoordinateKind, Model, SpeedKind};
use crate::terms::{Field, InputKind, InputName, Motion, Role, Shape, number};
use crate::words::Unraw;

use super::value::Value;

/// Which number of a field a symbol stands for.
#[derive(Clone, Copy, Debug)]
pub enum FieldPart {
    Scalar,
    Component(usize),
    Entry(usize, usize),
    /// A number of a `RigidBody`.
    Body(Role, usize, usize),
}

/// A symbol and where its value is read.
#[derive(Clone, Copy)]
pub struct ParameterSource<'g> {
    pub symbol: Expr<'g>,
    /// Index of the field.
    pub field: usize,
    pub part: FieldPart,
}

/// Declarations of a scene, in symbols.
#[derive(Clone)]
pub struct SceneSymbols<'g> {
    graph: &'g Graph,
    pub time: Expr<'g>,
    /// The instant at which mass data are taken, where they vary.
    pub matter_time: Option<Expr<'g>>,
    /// Body of the chart, whose coordinates and speeds come before the declared ones.
    pub chart: Option<ChartedBody<'g>>,
    pub coordinates: Vec<Coordinate<'g>>,
    /// Number of coordinates of the chart.
    pub before: usize,
    pub coordinate_names: Vec<Name>,
    /// Which of the coordinates are states of elements.
    pub states: Range<usize>,
    pub speeds: Vec<Expr<'g>>,
    /// Names of the momenta and of the forces: after the coordinate, where its rate is the speed.
    pub momentum_names: Vec<Name>,
    pub force_names: Vec<Name>,
    pub speed_rates: Vec<Expr<'g>>,
    pub momenta: Vec<Expr<'g>>,
    /// Values that arrive at run time.
    pub inputs: Vec<Expr<'g>>,
    /// Acceleration of free fall, observer's axes.
    pub gravity: Option<[Expr<'g>; 3]>,
    /// Fields that are six by six, or the diagonal of that.
    matrices: Vec<(String, Vec<Vec<Expr<'g>>>)>,
    /// Fields that expressions can name.
    pub fields: Vec<(String, Value<'g>)>,
    /// One for each clause; none for a frame.
    pub bodies: Vec<Option<Body<'g>>>,
    pub sources: Vec<ParameterSource<'g>>,
}

/// Number of speeds under one name.
pub fn size_of_speed(kind: SpeedKind) -> usize {
    match kind {
        SpeedKind::Scalar => 1,
        SpeedKind::Vector => 3,
    }
}

fn symbol<'g>(graph: &'g Graph, name: &Name, constant: bool) -> Expr<'g> {
    graph.symbol(name.text.clone(), name.latex.clone(), constant)
}

fn coordinate<'g>(graph: &'g Graph, written: &model::CoordinateClause) -> Coordinate<'g> {
    let name = name_of(&written.ident);
    let of = |letter: &str, index: String| {
        let text = format!("{letter}{index}_{}", name.text);
        graph.symbol(text, format!("{letter}_{{{index},{}}}", name.latex), false)
    };
    let rotation = || std::array::from_fn(|i| std::array::from_fn(|j| of("R", format!("{}{}", i + 1, j + 1))));
    match written.kind {
        CoordinateKind::Scalar => Coordinate::Scalar(symbol(graph, &name, false)),
        CoordinateKind::Rotation => Coordinate::Rotation(rotation()),
        CoordinateKind::Pose => Coordinate::Pose(rotation(), std::array::from_fn(|i| of("b", (i + 1).to_string()))),
    }
}

fn components(name: &Name) -> Vec<Name> {
    (0..3).map(|i| name.index(i)).collect()
}

/// Names of scalars, and of the components of vectors.
fn named(all: &[(&Ident, SpeedKind)]) -> Vec<Name> {
    let names = all.iter().map(|(ident, kind)| match kind {
        SpeedKind::Scalar => vec![name_of(ident)],
        SpeedKind::Vector => components(&name_of(ident)),
    });
    names.flatten().collect()
}

fn input_names(input: &InputName) -> Vec<Name> {
    let name = name_of(&input.ident);
    match input.kind {
        InputKind::Scalar => vec![name],
        InputKind::Vector => components(&name),
        InputKind::Wrench => {
            [components(&Name::new("F", "F").of(&name)), components(&Name::new("M", "M").of(&name))].concat()
        }
    }
}

fn speed_names(model: &Model) -> Vec<Name> {
    match &model.speeds {
        Some(speeds) => named(&speeds.iter().map(|z| (&z.ident, z.kind)).collect::<Vec<_>>()),
        None => model
            .coordinates
            .iter()
            .flat_map(|q| {
                let name = name_of(&q.ident);
                let (u, omega) = (Name::new("u", "u").of(&name), Name::new("ω", "\\omega").of(&name));
                match q.kind {
                    CoordinateKind::Scalar => vec![velocity_name(&name)],
                    CoordinateKind::Rotation => components(&omega),
                    CoordinateKind::Pose => [components(&u), components(&omega)].concat(),
                }
            })
            .collect(),
    }
}

/// θ of the speed dθ/dt; else the name of the speed.
fn momentum_names(model: &Model, coordinates: &[Coordinate<'_>], speed_names: &[Name]) -> Vec<Name> {
    let renamed = |(k, speed): (usize, &Name)| match &model.speeds {
        Some(_) => speed.clone(),
        None => match &model.coordinates[Coordinate::of_component(coordinates, k)] {
            q if q.kind == CoordinateKind::Scalar => name_of(&q.ident),
            _ => speed.clone(),
        },
    };
    speed_names.iter().enumerate().map(renamed).collect()
}

impl<'g> SceneSymbols<'g> {
    pub fn new(graph: &'g Graph, model: &Model) -> Self {
        let mut declared = Self::of_parameters(graph, model);
        let time = graph.symbol("t", "t", false);
        let chart = model.in_chart.map(|own| ChartedBody::new(graph, own.motion, own.chart));
        let own: Vec<Coordinate<'g>> = model.coordinates.iter().map(|q| coordinate(graph, q)).collect();
        let own_speeds = speed_names(model);
        let own_momenta = momentum_names(model, &own, &own_speeds);
        let symbols = |name: &dyn Fn(&Name) -> Name| -> Vec<Expr<'g>> {
            own_speeds.iter().map(|z| symbol(graph, &name(z), false)).collect()
        };
        let named =
            |letter: &str| -> Vec<Name> { own_momenta.iter().map(|name| Name::new(letter, letter).of(name)).collect() };
        declared.time = time;
        if let Some(chart) = &chart {
            declared.before = chart.coordinates.len();
            declared.coordinates.clone_from(&chart.coordinates);
            declared.coordinate_names.clone_from(&chart.coordinate_names);
            declared.speeds.clone_from(&chart.kinematics.speeds);
            declared.speed_rates.clone_from(&chart.kinematics.speed_rates);
            declared.momentum_names.clone_from(&chart.momentum_names);
            declared.force_names.clone_from(&chart.force_names);
        }
        declared.coordinates.extend(own);
        declared.coordinate_names.extend(model.coordinates.iter().map(|q| name_of(&q.ident)));
        let before_states = declared.coordinates.len();
        for name in model.states.iter().map(|state| name_of(&state.ident)) {
            declared.coordinates.push(Coordinate::Scalar(symbol(graph, &name, false)));
            declared.coordinate_names.push(name);
        }
        declared.states = before_states..declared.coordinates.len();
        declared.speeds.extend(symbols(&Name::clone));
        declared.speed_rates.extend(symbols(&Name::rate));
        declared.momentum_names.extend(named("p"));
        declared.force_names.extend(named("F"));
        declared.momenta = declared.momentum_names.iter().map(|name| symbol(graph, name, false)).collect();
        declared.inputs =
            model.item.inputs.iter().flat_map(input_names).map(|name| symbol(graph, &name, false)).collect();
        declared.chart = chart;
        declared
    }

    /// Declares the symbols of parameters, and nothing else yet.
    fn of_parameters(graph: &'g Graph, model: &Model) -> Self {
        let mut declared = Self {
            graph,
            time: graph.zero(),
            matter_time: model.mass_varies().then(|| graph.symbol("t", "t", false)),
            chart: None,
            coordinates: Vec::new(),
            before: 0,
            coordinate_names: Vec::new(),
            states: 0..0,
            speeds: Vec::new(),
            momentum_names: Vec::new(),
            force_names: Vec::new(),
            speed_rates: Vec::new(),
            momenta: Vec::new(),
            inputs: Vec::new(),
            gravity: None,
            matrices: Vec::new(),
            fields: Vec::new(),
            bodies: Vec::new(),
            sources: Vec::new(),
        };
        declared.bodies = model.bodies.iter().map(|clause| declared.body(model, clause)).collect();
        declared.plain_fields(model);
        let gravity = declared.gravity;
        declared.bodies.iter_mut().flatten().for_each(|body| body.gravity = gravity);
        declared
    }

    /// Number of components of ψ.
    pub fn size(&self) -> usize {
        self.coordinates.iter().map(Coordinate::size).sum()
    }

    /// Components of ψ that are those of one coordinate, the chart's among them.
    pub fn rate_of<'a>(&self, coordinate: usize, kinematics: &'a [Expr<'g>]) -> &'a [Expr<'g>] {
        let first: usize = self.coordinates[..coordinate].iter().map(Coordinate::size).sum();
        &kinematics[first..first + self.coordinates[coordinate].size()]
    }

    /// Symbols for gravity and for every field without a role that expressions can name; the acceleration of free fall.
    fn plain_fields(&mut self, model: &Model) {
        for (field, Field { ident, role, shape, .. }) in model.item.fields.iter().enumerate() {
            // Of a body without a name gravity is among its symbols.
            let known = role.is_some() && self.gravity.is_some();
            let unread = role.is_none() && model.chart_of_all().is_some() && !model.has_expressions();
            if known || unread || !matches!(role, None | Some(Role::Gravity)) {
                continue;
            }
            let name = if role.is_some() { Name::new("g", "g") } else { name_of(ident) };
            let value = match shape {
                Shape::Scalar => {
                    let symbol = symbol(self.graph, &name, true);
                    self.sources.push(ParameterSource { symbol, field, part: FieldPart::Scalar });
                    Value::Scalar(symbol)
                }
                Shape::Vector3 => Value::Vector(std::array::from_fn(|i| {
                    let symbol = symbol(self.graph, &name.index(i), true);
                    self.sources.push(ParameterSource { symbol, field, part: FieldPart::Component(i) });
                    symbol
                })),
                Shape::Vector6 | Shape::Matrix6 => {
                    let matrix = self.matrix_field(field, &name, *shape);
                    self.matrices.push((ident.unraw().to_string(), matrix));
                    continue;
                }
                _ => continue,
            };
            if role.is_some() {
                let zero = self.graph.zero();
                self.gravity = Some(match &value {
                    Value::Vector(vector) => *vector,
                    Value::Scalar(g) => free_fall(model, zero, *g),
                    _ => [zero; 3],
                });
            }
            self.fields.push((ident.unraw().to_string(), value));
        }
    }

    fn matrix_field(&mut self, field: usize, name: &Name, shape: Shape) -> Vec<Vec<Expr<'g>>> {
        let zero = self.graph.zero();
        let mut entry = |i: usize, j: usize| {
            let (name, part) = match shape {
                Shape::Vector6 if i != j => return zero,
                Shape::Vector6 => (name.index(i), FieldPart::Component(i)),
                _ => (name.index(i).index(j), FieldPart::Entry(i, j)),
            };
            let symbol = symbol(self.graph, &name, true);
            self.sources.push(ParameterSource { symbol, field, part });
            symbol
        };
        (0..6).map(|i| (0..6).map(|j| entry(i, j)).collect()).collect()
    }

    /// A field that is six by six, or the diagonal of that.
    pub fn matrix(&self, name: &Ident) -> Option<&Vec<Vec<Expr<'g>>>> {
        self.matrices.iter().find(|(known, _)| name.unraw() == known).map(|(_, matrix)| matrix)
    }

    /// The mass data of a body, under the names of the fields that have them.
    fn body(&mut self, model: &Model, clause: &BodyClause) -> Option<Body<'g>> {
        if clause.massless {
            return None;
        }
        let given =
            |role: Role| clause.role_clauses.iter().find(|clause| clause.role == role).map(|clause| clause.shape);
        let mut body = match &clause.name {
            Some(name) if clause.has_matter() => Body::named(self.graph, body_shape(given), 2, name_of(name)),
            Some(name) => {
                let field = model.item.fields.iter().position(|f| f.ident == *name).unwrap_or_default();
                let inertia = match model.item.fields[field].shape {
                    Shape::CentralBody => Role::CentralInertia,
                    _ => Role::Inertia,
                };
                let of_field = |role: Role| [Role::Mass, Role::CenterOfMass, inertia].contains(&role);
                let has = |role: Role| if of_field(role) { Some(Shape::RigidBody) } else { given(role) };
                let body = Body::named(self.graph, body_shape(has), 2, name_of(name));
                // What the clause says of the fluid takes the place of the other symbols.
                let of_field = |p: &&ParameterSymbol<'g>| of_field(p.quantity);
                self.sources.extend(body.parameters.iter().filter(of_field).map(|p| ParameterSource {
                    symbol: p.symbol,
                    field,
                    part: FieldPart::Body(p.quantity, p.row, p.column),
                }));
                body
            }
            None => self.unnamed_body(model),
        };
        body.gravity = self.gravity;
        Some(body)
    }

    fn unnamed_body(&mut self, model: &Model) -> Body<'g> {
        let fields = &model.item.fields;
        let field = |role: Role| fields.iter().position(|f| f.role == Some(role));
        let given =
            |role: Role| model.role_clauses.iter().find(|clause| clause.role == role).map(|clause| clause.shape);
        let shape_of = |role: Role| field(role).map(|k| fields[k].shape).or_else(|| given(role));
        let body = Body::new(self.graph, body_shape(shape_of), up(model));
        self.gravity = body.gravity;
        for role in [
            Role::Gravity,
            Role::Mass,
            Role::CenterOfMass,
            Role::Inertia,
            Role::CentralInertia,
            Role::AddedMass,
            Role::DisplacedMass,
            Role::CenterOfBuoyancy,
        ] {
            let Some(field) = field(role) else { continue };
            let own: Vec<_> = body.parameters.iter().filter(|p| p.quantity == role).collect();
            let shape = fields[field].shape;
            self.sources.extend(own.iter().map(|p| ParameterSource {
                symbol: p.symbol,
                field,
                part: match shape {
                    Shape::Scalar => FieldPart::Scalar,
                    Shape::Vector3 | Shape::Vector6 => FieldPart::Component(p.row),
                    _ => FieldPart::Entry(p.row, p.column),
                },
            }));
            if let (Role::AddedMass, Some(matrix)) = (role, &body.added_mass) {
                self.matrices.push((fields[field].ident.unraw().to_string(), matrix.clone()));
            }
            let value = match (shape, own.as_slice()) {
                (Shape::Scalar, [p]) => Value::Scalar(p.symbol),
                (Shape::Vector3, [a, b, c]) => Value::Vector([a.symbol, b.symbol, c.symbol]),
                _ => continue,
            };
            self.fields.push((fields[field].ident.unraw().to_string(), value));
        }
        body
    }
}

/// The observer's axis that gravity opposes: k₃, in a plane k₂.
fn up(model: &Model) -> usize {
    if model.in_chart.is_some_and(|own| own.motion == Motion::Planar) { 1 } else { 2 }
}

/// Down, with the magnitude g.
pub fn free_fall<'g>(model: &Model, zero: Expr<'g>, g: Expr<'g>) -> [Expr<'g>; 3] {
    std::array::from_fn(|i| if i == up(model) { -g } else { zero })
}

/// Quantities that a body has, from the shapes of the values that play the roles.
pub fn body_shape(shape_of: impl Fn(Role) -> Option<Shape>) -> BodyShape {
    let central = shape_of(Role::CentralInertia);
    BodyShape {
        inertia: central.or(shape_of(Role::Inertia)).filter(|shape| !shape.is_body()).unwrap_or(Shape::Matrix3),
        central: central.is_some(),
        center_of_mass: shape_of(Role::CenterOfMass).is_some(),
        added_mass: shape_of(Role::AddedMass),
        gravity: shape_of(Role::Gravity),
        displaced_mass: shape_of(Role::DisplacedMass).is_some(),
        center_of_buoyancy: shape_of(Role::CenterOfBuoyancy).is_some(),
    }
}

/// π to far more digits than any scalar has.
pub fn pi() -> Rational {
    const DIGITS: &str =
        "3.14159265358979323846264338327950288419716939937510582097494459230781640628620899862803482534211707";
    number::exact(DIGITS).unwrap_or_else(Rational::zero)
}

pub(super) fn name_of(ident: &Ident) -> Name {
    const GREEK: [&str; 22] = [
        "alpha", "beta", "gamma", "delta", "epsilon", "zeta", "eta", "theta", "iota", "kappa", "lambda", "mu", "nu",
        "xi", "pi", "rho", "sigma", "tau", "phi", "chi", "psi", "omega",
    ];
    let text = ident.unraw().to_string();
    let stem = text.trim_end_matches(|c: char| c.is_ascii_digit());
    let index = &text[stem.len()..];
    // Letters that are neither Latin nor Greek stay as they are: newer TeX sets them.
    let letters = || "αβγδεζηθικλμνξπρστφχψω".chars().zip(GREEK);
    let set =
        |c: char| letters().find(|(letter, _)| *letter == c).map_or(c.to_string(), |(_, name)| format!("\\{name} "));
    let word: String = stem.chars().map(set).collect();
    let letter = match stem {
        stem if GREEK.contains(&stem) => format!("\\{stem}"),
        stem if stem.chars().count() == 1 => word.trim_end().to_owned(),
        _ => format!("\\mathit{{{}}}", word.replace('_', "\\_")),
    };
    let latex = if index.is_empty() { letter } else { format!("{letter}_{{{index}}}") };
    Name { text, latex }
}

/// A speed of the jet chart: a dot over a letter, `_dot` after a word.
fn velocity_name(name: &Name) -> Name {
    if name.text.trim_end_matches(|c: char| c.is_ascii_digit()).chars().count() == 1 {
        name.dot()
    } else {
        Name { text: format!("{}_dot", name.text), latex: name.dot().latex }
    }
}
