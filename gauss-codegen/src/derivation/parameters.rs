//! Laws of mass data and of constants, and tables, as plain data: what `emit::constructor` writes as Rust.

use std::ops::Range;

use proc_macro2::TokenStream;

use crate::algebra::{Expr, Set};
use crate::emit::{Derived, in_states};
use crate::kernel;
use crate::mass_laws::{Datum, Group, InertiaRule, InertiaRules, MassLaw, MassRule};
use crate::mechanics::{Coordinate, QuantityValues};
use crate::parameters::{Check, Given, Parameter, Parameters, Rule, TableClause, Warning, WarningRule};
use crate::program::{ArgumentKind, Results};
use crate::terms::{self, Field, FunctionKind, LawKind, Role, Shape, UserFunction};
use crate::translate::{DragMatrix, FieldPart, Law};
use crate::words::Unraw;

use super::signature::{Signature, SignatureError};

/// Components of the configuration, by their places in it, whose squares have the sum one.
pub fn unit_components(derived: &Derived<'_, '_>) -> Vec<Range<usize>> {
    let mut place = 0;
    let coordinates = derived.subject.system.scene.coordinates.iter();
    let unit = coordinates.filter_map(|coordinate| {
        let (unit, further) = match coordinate {
            Coordinate::Scalar(_) => return None,
            Coordinate::Rotation(_) => (4, 0),
            Coordinate::Pose(..) => (4, 3),
            Coordinate::Plane { .. } => (2, 2),
        };
        let first = place;
        place += unit + further;
        Some(first..first + unit)
    });
    unit.collect()
}

/// The fields and their laws.
///
/// # Errors
/// Mistakes of this crate.
pub fn parameters<'g>(derived: &Derived<'_, 'g>, signature: &Signature<'g>) -> Result<Parameters, SignatureError> {
    let provenance = derived.subject.provenance;
    let fields = &provenance.item.fields;
    let mut sources: Vec<_> = provenance.sources.iter().map(|source| (source.field, source.part)).collect();
    sources.sort_by_key(|(field, _)| *field);
    let known = provenance
        .sources
        .iter()
        .map(|source| source.symbol)
        .chain(provenance.literals.iter().map(|(_, literal)| *literal));
    let first = first_numbers(fields);
    let mut laws = CheckedLaws {
        derived,
        known: known.map(|symbol| symbol.key()).collect(),
        first,
        own: Vec::new(),
        computed: Vec::new(),
    };
    let read = sources.iter().map(|&(field, part)| laws.first[field] + place(part, fields[field].shape)).collect();
    let mut checks = laws.of_groups(&derived.mass_laws.of_data);
    checks.extend(laws.of_constants(|kind| kind == LawKind::MassInSum));
    checks.extend(laws.of_groups(&derived.mass_laws.of_motions));
    checks.extend(laws.of_constants(|kind| kind != LawKind::MassInSum));
    let warnings = laws.of_warnings();
    let code = kernel::Program::lower(&laws.computed);
    let results = vec![Results::new("values", code.outputs.len(), 1)];
    let computed = signature.program("checks", &[ArgumentKind::Parameters], &code, results)?;
    let label = provenance.sources.first().map(|s| fields[s.field].ident.unraw().to_string()).unwrap_or_default();
    let list = fields.iter().flat_map(of_field).collect();
    let tables = provenance.item.functions.iter().map(table).collect();
    Ok(Parameters { list, read, checks, warnings, computed, label, in_sum: derived.mass_laws.in_sum, tables })
}

/// The table that a function is.
fn table(function: &UserFunction) -> Option<TableClause> {
    let FunctionKind::Table(terms::Table { axes, values, joined }) = &function.kind else { return None };
    // Tokens are written with spaces between them: `aero :: LIFT`.
    let path = |tokens: &TokenStream| tokens.to_string().split_whitespace().collect::<String>();
    let axes = axes.iter().map(|axis| path(&axis.path)).collect();
    Some(TableClause { name: function.name.unraw().to_string(), axes, values: path(values), joined: *joined })
}

/// The parts that a field has, with the axes of each.
fn parts(shape: Shape) -> &'static [(&'static str, &'static [usize])] {
    match shape {
        Shape::Scalar => &[("", &[])],
        Shape::Vector3 => &[("", &[3])],
        Shape::Vector6 => &[("", &[6])],
        Shape::Matrix3 => &[("", &[3, 3])],
        Shape::Matrix6 => &[("", &[6, 6])],
        Shape::RigidBody | Shape::CentralBody => &[(".mass", &[]), (".center_of_mass", &[3]), (".inertia", &[3, 3])],
        Shape::Other => &[],
    }
}

/// Count of the numbers of a field.
fn numbers(shape: Shape) -> usize {
    parts(shape).iter().map(|(_, axes)| axes.iter().product::<usize>()).sum()
}

fn of_field(field: &Field) -> impl Iterator<Item = Parameter> {
    parts(field.shape).iter().map(|(part, axes)| Parameter {
        name: format!("{}{part}", field.ident.unraw()),
        count: axes.iter().product(),
        axes: axes.to_vec(),
        unit: field.unit.clone(),
        documentation: field.documentation.clone(),
    })
}

/// The place of the first number of each field.
fn first_numbers(fields: &[Field]) -> Vec<usize> {
    let mut next = 0;
    let size = |field: &Field| numbers(field.shape);
    let first = |field: &Field| {
        let own = next;
        next += size(field);
        own
    };
    fields.iter().map(first).collect()
}

/// Place of one number within its field.
fn place(part: FieldPart, shape: Shape) -> usize {
    match part {
        FieldPart::Scalar => 0,
        FieldPart::Component(i) => i,
        FieldPart::Entry(i, j) if shape == Shape::Matrix3 => 3 * i + j,
        FieldPart::Entry(i, j) => 6 * i + j,
        FieldPart::Body(Role::Mass, ..) => 0,
        FieldPart::Body(Role::CenterOfMass, i, _) => 1 + i,
        FieldPart::Body(_, i, j) => 4 + 3 * i + j,
    }
}

struct CheckedLaws<'a, 'b, 'g> {
    derived: &'a Derived<'b, 'g>,
    /// Keys of symbols that are known when a kernel is made.
    known: Set<u32>,
    /// The place of the first number of each field.
    first: Vec<usize>,
    /// The values of the group whose laws are written.
    own: Vec<(Role, Vec<Given>)>,
    computed: Vec<Expr<'g>>,
}

impl<'g> CheckedLaws<'_, '_, 'g> {
    fn computed(&mut self, values: &[Expr<'g>]) -> Vec<Given> {
        let first = self.computed.len();
        self.computed.extend(values);
        (first..self.computed.len()).map(Given::Computed).collect()
    }

    /// Values of a clause: of half a matrix all of it.
    fn clause(&mut self, own: &QuantityValues<'g>) -> Vec<Given> {
        let values = self.computed(&own.values);
        let whole = |n: usize, place: &dyn Fn(usize, usize) -> usize| {
            let entries = (0..n).flat_map(|i| (0..n).map(move |j| (i.min(j), i.max(j))));
            entries.map(|(i, j)| values[place(i, j)]).collect()
        };
        match (values.len(), own.quantity) {
            (21, _) => whole(6, &|i, j| 6 * i + j - i * (i + 1) / 2),
            (6, quantity) if quantity != Role::AddedMass => whole(3, &|i, j| 3 * i + j - i * (i + 1) / 2),
            _ => values,
        }
    }

    /// The numbers of what a law is about.
    fn datum(&mut self, datum: Datum) -> Vec<Given> {
        let provenance = self.derived.subject.provenance;
        match datum {
            Datum::Field(k) => {
                let count = numbers(provenance.item.fields[k].shape);
                (self.first[k]..self.first[k] + count).map(Given::Number).collect()
            }
            Datum::Part(k, role) => {
                let first = self.first[k];
                let places = match role {
                    Role::Mass => 0..1,
                    Role::CenterOfMass => 1..4,
                    _ => 4..13,
                };
                places.map(|place| Given::Number(first + place)).collect()
            }
            Datum::Clause(role) => {
                provenance.mass_data.unnamed(role).map(|value| self.clause(&value.own)).unwrap_or_default()
            }
            Datum::Own(role) => {
                let own = self.own.iter().find(|(quantity, _)| *quantity == role);
                own.map(|(_, values)| values.clone()).unwrap_or_default()
            }
        }
    }

    fn of_groups(&mut self, groups: &[Group<'g>]) -> Vec<Check> {
        let mut checks = Vec::new();
        for Group { values, laws } in groups {
            self.own = values.iter().map(|own| (own.quantity, self.clause(own))).collect();
            for law in laws {
                self.of_mass_law(law, &mut checks);
            }
        }
        checks
    }

    fn of_mass_law(&mut self, MassLaw { label, rule }: &MassLaw<'g>, checks: &mut Vec<Check>) {
        let (rule, values) = match rule {
            MassRule::Inertia(rules) => return self.of_inertia(label, rules, checks),
            MassRule::Mass(datum) => (Rule::Mass, self.datum(*datum)),
            MassRule::MassInSum(datum) => (Rule::MassInSum, self.datum(*datum)),
            MassRule::NonNegative(datum) => (Rule::NonNegative, self.datum(*datum)),
            MassRule::Finite(datum, _) => (Rule::Finite, self.datum(*datum)),
            MassRule::Symmetric(datum) => (Rule::Symmetric, self.datum(*datum)),
            MassRule::KineticMatrix(rows) => (Rule::KineticMatrix, self.computed(&rows.concat())),
        };
        checks.push(Check { label: label.clone(), rule, values, is_formal: false });
    }

    fn of_inertia(&mut self, label: &str, rules: &InertiaRules, checks: &mut Vec<Check>) {
        let mass = rules.mass.map_or_else(|| vec![Given::Zero], |datum| self.datum(datum));
        let center = rules.center.map_or_else(|| vec![Given::Zero; 3], |datum| self.datum(datum));
        let given = self.datum(rules.tensor);
        let diagonal = |of: &dyn Fn(usize) -> Given| -> Vec<Given> {
            (0..9).map(|k| if k % 4 == 0 { of(k / 4) } else { Given::Zero }).collect()
        };
        let tensor = match (rules.shape, given.len()) {
            (_, 9) => given,
            (Shape::Scalar, _) => diagonal(&|_| given[0]),
            _ => diagonal(&|i| given[i]),
        };
        let whole = || [mass.clone(), center.clone(), tensor.clone()].concat();
        for rule in &rules.rules {
            let (rule, values) = match rule {
                InertiaRule::Alone => (Rule::Inertia, tensor.clone()),
                InertiaRule::Planar => (Rule::Inertia, diagonal(&|_| tensor[8])),
                InertiaRule::Still => (Rule::Finite, tensor.clone()),
                InertiaRule::Central => (Rule::CentralInertia, whole()),
                InertiaRule::AboutAxis(axis) => (Rule::InertiaAboutAxis(*axis), whole()),
                InertiaRule::InSum => (Rule::InertiaInSum, whole()),
            };
            checks.push(Check { label: label.to_owned(), rule, values, is_formal: rules.is_formal });
        }
    }

    /// Rules whose breach is likely not meant, in the order of the derive: of drag, of elements, of gravity, of added
    /// masses.
    fn of_warnings(&mut self) -> Vec<Warning> {
        let (provenance, mass_laws) = (self.derived.subject.provenance, self.derived.mass_laws);
        let is_known = |key| self.known.contains(&key);
        let drag = |drag: &DragMatrix<'g>| {
            (drag.label.clone(), WarningRule::Drag { quadratic: drag.quadratic }, drag.entries.concat())
        };
        let law = |law: &Law<'g>| {
            let (rule, values) = match law.kind {
                LawKind::Damping => (WarningRule::Damping, law.values.clone()),
                LawKind::Attraction => (WarningRule::Center, law.values.clone()),
                LawKind::DampingMatrix => (WarningRule::DampingMatrix, law.values.clone()),
                LawKind::Dissipation => (WarningRule::Dissipation, in_states(law.values[0], &is_known)),
                _ => return None,
            };
            Some((law.label.clone(), rule, values))
        };
        let of_elements: Vec<_> =
            provenance.drags.iter().map(drag).chain(provenance.laws.iter().filter_map(law)).collect();
        let added = mass_laws.added_masses.iter();
        let added = added.map(|(label, diagonal)| (label.clone(), WarningRule::AddedMass, diagonal.clone()));
        let mut warnings = self.of_known(of_elements);
        if let Some((label, gravity)) = &mass_laws.gravity {
            let values = self.datum(*gravity);
            warnings.push(Warning { label: label.clone(), rule: WarningRule::Gravity, values });
        }
        warnings.extend(self.of_known(added.collect()));
        warnings
    }

    /// Warnings of parameters alone: where the state enters nothing is known.
    fn of_known(&mut self, all: Vec<(String, WarningRule, Vec<Expr<'g>>)>) -> Vec<Warning> {
        let mut warnings = Vec::new();
        for (label, rule, values) in all {
            let symbols = kernel::Program::lower(&values).symbols();
            if symbols.iter().all(|symbol| self.known.contains(&symbol.key())) {
                warnings.push(Warning { label, rule, values: self.computed(&values) });
            }
        }
        warnings
    }

    /// Checks of constants of elements. Of what depends on the state nothing is known when the kernel is made.
    fn of_constants(&mut self, of_kind: impl Fn(LawKind) -> bool) -> Vec<Check> {
        let mut checks = Vec::new();
        for Law { label, kind, values } in self.derived.subject.provenance.laws.iter().filter(|law| of_kind(law.kind)) {
            let symbols = kernel::Program::lower(values).symbols();
            if !symbols.iter().all(|symbol| self.known.contains(&symbol.key())) {
                continue;
            }
            let rule = match kind {
                LawKind::Stiffness => Rule::Stiffness,
                LawKind::Width => Rule::Width,
                LawKind::Limits => Rule::Limits,
                LawKind::NonNegative | LawKind::Friction => Rule::NonNegative,
                LawKind::Armature => Rule::Armature,
                LawKind::Length => Rule::Length,
                LawKind::Restitution => Rule::Restitution,
                LawKind::Direction => Rule::Direction,
                LawKind::MassInSum => Rule::MassInSum,
                LawKind::StiffnessMatrix => Rule::StiffnessMatrix,
                LawKind::DampingMatrix => Rule::DampingMatrix,
                LawKind::Modes => Rule::Modes,
                LawKind::Damping | LawKind::Attraction => Rule::Finite,
                LawKind::Dissipation => continue,
            };
            let values = self.computed(values);
            checks.push(Check { label: label.clone(), rule, values, is_formal: false });
        }
        checks
    }
}
