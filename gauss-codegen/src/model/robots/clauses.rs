//! A description → the clauses that say the same, before those of the struct.

use proc_macro2::Ident;
use quote::format_ident;
use syn::ext::IdentExt;

use super::description::{Closure, Description, Fault, Inertial, Joint, JointKind, Note};
use super::joints::Writer;
use super::names::Names;
use super::source;
use super::structure::{Coupling, Structure};
use crate::model::language::context::Context;
use crate::model::language::declarations;
use crate::model::language::fields::{ReadField, Reader};
use crate::model::language::robots::{Base, File, Format, Friction, Inputs, Limits, RobotClauses};
use crate::model::language::statements::Statements;
use crate::model::scene::clauses::{
    BodyClause, Coefficients, ConstraintClause, ConstraintKind, Coordinate, CoordinateKind, Extent, ForceClause,
    ForceKind, InputKind, InputName, RoleClause, RoleValue, Speed, SpeedKind,
};
use crate::model::scene::described::{Described, Remark};
use crate::model::scene::expression::{BinaryOperator, Expression, FunctionName, Property};
use crate::model::scene::roles::{Role, Shape};

/// What the free root of a robot moves by.
const BASE: &str = "base";

/// Puts what the file of the clauses says before what the struct says; `None` without a file, or where it is wrong,
/// which is noted.
pub fn compose(
    clauses: &RobotClauses,
    reader: &Reader<'_>,
    statements: &mut Statements,
    context: &mut Context,
) -> Option<Described> {
    let file = clauses.file.as_ref()?;
    if file.format == Format::Mjcf && clauses.base.is_some() {
        context.error(file.span, "an MJCF file says by <freejoint/> what moves freely; remove `base`");
    }
    let path = source::path(file);
    let read = source::text(&path).map_err(|message| vec![message]).and_then(|text| {
        let faults =
            |faults: Vec<Fault>| faults.iter().map(|f| source::located(file, f.at, &f.message)).collect::<Vec<_>>();
        let description = source::read(file.format, &text).map_err(faults)?;
        let structure = Structure::new(&description).map_err(faults)?;
        let robot = Robot::new(file, clauses, reader, &description, &structure);
        let idle = robot.without_inertia();
        if idle.is_empty() { Ok(robot.written(statements, context)) } else { Err(faults(idle)) }
    });
    match read {
        Ok(notes) => {
            let remark =
                |note: &Note| Remark { text: source::located(file, note.at, &note.text), ignored: note.ignored };
            let remarks = notes.iter().map(remark).collect();
            Some(Described {
                path: path.to_string_lossy().into_owned(),
                file: file.path.clone(),
                span: file.span,
                remarks,
            })
        }
        Err(messages) => {
            // Whatever else seems to be missing is what the file was to say.
            statements.missed = true;
            messages.iter().for_each(|message| context.error(file.span, message));
            None
        }
    }
}

/// A description with the names that its parts have in expressions.
struct Robot<'a> {
    clauses: &'a RobotClauses,
    description: &'a Description,
    structure: &'a Structure,
    writer: Writer,
    /// The pose of the root, if it moves.
    base: Option<Ident>,
    /// Of each joint; none of those that are fixed or follow another.
    coordinates: Vec<Vec<Coordinate>>,
    inputs: Vec<Option<Ident>>,
    links: Vec<Ident>,
    /// The mass data of the link are those of a field.
    in_field: Vec<bool>,
    gravity_in_field: bool,
    notes: Vec<Note>,
}

impl<'a> Robot<'a> {
    fn new(
        file: &File,
        clauses: &'a RobotClauses,
        reader: &Reader<'_>,
        description: &'a Description,
        structure: &'a Structure,
    ) -> Self {
        let mut names = Names::new(file.span);
        let floating = clauses.base == Some(Base::Floating);
        let base = floating.then(|| names.chosen(BASE));
        let own = |index: usize| structure.coupling_of[index].joint == index;
        let all = || description.joints.iter().enumerate();
        let coordinates: Vec<Vec<Coordinate>> =
            all().map(|(k, joint)| if own(k) { coordinates(joint, &mut names) } else { Vec::new() }).collect();
        let inputs = all().map(|(k, joint)| {
            let driven = match clauses.inputs.unwrap_or(if description.only_driven {
                Inputs::Transmissions
            } else {
                Inputs::All
            }) {
                Inputs::All => true,
                Inputs::None => false,
                Inputs::Transmissions => description.driven.contains(&joint.name),
            };
            match (own(k) && driven, joint.kind, coordinates[k].as_slice()) {
                (true, JointKind::Turning | JointKind::Sliding, [q]) => {
                    Some(names.chosen(&format!("{}_effort", q.ident.unraw())))
                }
                _ => None,
            }
        });
        let inputs = inputs.collect();
        let links: Vec<Ident> =
            description.links.iter().map(|link| names.identifier(&link.name, "link", link.at)).collect();
        let plays = |field: &ReadField<'_>, role: Role| field.role.as_ref().is_some_and(|claim| claim.role == role);
        let bodies = || reader.fields.iter().filter(|field| plays(field, Role::Body));
        let in_field = links.iter().map(|name| bodies().any(|field| field.ident == name)).collect();
        let gravity_in_field = reader.fields.iter().any(|field| plays(field, Role::Gravity));
        let mut notes = description.notes.clone();
        notes.append(&mut names.notes);
        let writer = Writer { span: file.span };
        Robot {
            clauses,
            description,
            structure,
            writer,
            base,
            coordinates,
            inputs,
            links,
            in_field,
            gravity_in_field,
            notes,
        }
    }

    /// Whether a link moves at all.
    fn moves(&self, link: usize) -> bool {
        self.base.is_some() || self.structure.owner_of[link] != self.structure.root
    }

    /// Its mass data are not added to those of what it moves as one with: one of the two is a field.
    fn is_apart(&self, link: usize) -> bool {
        self.in_field[link] || self.in_field[self.structure.owner_of[link]]
    }

    /// The mass data of what moves as one with a link, unless fields have them.
    fn merged(&self, link: usize) -> Option<Inertial> {
        self.structure.merged(self.description, link, |link| self.is_apart(link))
    }

    /// Links that move where nothing beyond their joint has mass or inertia.
    fn without_inertia(&self) -> Vec<Fault> {
        let has = |link: usize| {
            let some = |own: &Inertial| own.mass > 0.0 || own.inertia.iter().flatten().any(|entry| *entry != 0.0);
            self.in_field[link] || self.description.links[link].inertial.as_ref().is_some_and(some)
        };
        let mut carries = vec![false; self.links.len()];
        for start in (0..self.links.len()).filter(|&link| has(link)) {
            let mut next = Some(start);
            while let Some(link) = next.filter(|&link| !carries[link]) {
                carries[link] = true;
                next = self.structure.parent_of[link];
            }
        }
        let idle = |&(link, carries): &(usize, bool)| {
            let moves_itself = self.structure.owner_of[link] == link && self.moves(link);
            !carries && moves_itself
        };
        let fault = |(link, _): (usize, bool)| {
            let link = &self.description.links[link];
            let message = format!(
                "the link `{}` moves, and neither it nor what hangs on it has an <inertial>; add one, or fix its joint",
                link.name
            );
            Fault { at: link.at, message }
        };
        carries.into_iter().enumerate().filter(idle).map(fault).collect()
    }

    /// Puts the clauses before those of the struct; gives back what is to be known of them.
    fn written(mut self, statements: &mut Statements, context: &mut Context) -> Vec<Note> {
        let span = self.writer.span;
        statements.first.get_or_insert_with(|| Ident::new("urdf", span));
        self.require_fields(context);
        let mut coordinates: Vec<Coordinate> = Vec::new();
        coordinates
            .extend(self.base.iter().map(|ident| Coordinate { ident: ident.clone(), kind: CoordinateKind::Pose }));
        coordinates.extend(self.coordinates.iter().flatten().cloned());
        if let (Some(speeds), Some(kinematics)) = (&mut statements.speeds, &mut statements.kinematics) {
            let (own, rates) = self.rates(&coordinates);
            speeds.names.splice(0..0, own);
            kinematics.rates.splice(0..0, rates);
        }
        declarations::before(&mut statements.coordinates, coordinates, "coordinates", span);
        let inputs = self.inputs.iter().zip(&self.description.joints).filter_map(|(input, joint)| {
            let unit = if joint.kind == JointKind::Turning { "N m" } else { "N" };
            Some(InputName { ident: input.clone()?, kind: InputKind::Scalar, unit: Some(unit.to_owned()) })
        });
        let inputs: Vec<InputName> = inputs.collect();
        if !inputs.is_empty() {
            declarations::before(&mut statements.inputs, inputs, "input", span);
        }
        let bodies: Vec<BodyClause> = (0..self.links.len()).map(|link| self.body(link)).collect();
        statements.bodies.splice(0..0, bodies.into_iter().chain(self.rotors()));
        statements.constraints.splice(0..0, self.closures());
        let has_gravity = statements.role_clauses.iter().any(|clause| clause.role == Role::Gravity);
        statements.role_clauses.extend(self.gravity().filter(|_| !has_gravity && !self.gravity_in_field));
        let forces = self.forces();
        statements.forces.splice(0..0, forces);
        self.notes.sort_by_key(|note| note.at);
        self.notes
    }

    /// `parameters = inertial` asks for a field of every link that moves.
    fn require_fields(&self, context: &mut Context) {
        let Some(word) = &self.clauses.inertial else { return };
        let needs = |&link: &usize| {
            let owner = self.structure.owner_of[link] == link && self.moves(link);
            owner && !self.in_field[link] && self.merged(link).is_some()
        };
        let missing: Vec<String> = (0..self.links.len())
            .filter(needs)
            .map(|link| format!("#[gauss(body)] {}: RigidBody<f64>", self.links[link]))
            .collect();
        if !missing.is_empty() {
            let message = format!(
                "with `parameters = inertial` the mass data of links are fields with their names; add `{}`",
                missing.join(", ")
            );
            context.error(word.span(), message);
        }
    }

    /// Speeds of the file's coordinates, and their kinematics, where the struct has speeds of its own.
    fn rates(&self, coordinates: &[Coordinate]) -> (Vec<Speed>, Vec<(Ident, Option<Expression>)>) {
        let (mut speeds, mut rates) = (Vec::new(), Vec::new());
        for coordinate in coordinates {
            let ident = &coordinate.ident;
            let mut speed = |end: &str, kind: SpeedKind| {
                let ident = format_ident!("{}_{}", ident.unraw(), end, span = ident.span());
                speeds.push(Speed { ident: ident.clone(), kind });
                self.writer.name(&ident)
            };
            let rate = match coordinate.kind {
                CoordinateKind::Scalar => speed("dot", SpeedKind::Scalar),
                CoordinateKind::Rotation => speed("omega", SpeedKind::Vector),
                CoordinateKind::Pose => {
                    let twist = vec![speed("u", SpeedKind::Vector), speed("omega", SpeedKind::Vector)];
                    self.writer.call(FunctionName::Twist, twist)
                }
            };
            rates.push((ident.clone(), Some(rate)));
        }
        (speeds, rates)
    }

    /// The coordinates that a joint moves by, those of the one that it follows, from a `start`.
    fn values(&self, joint: usize, start: f64) -> Vec<Expression> {
        let coupling = self.structure.coupling_of[joint];
        let coupling = Coupling { offset: coupling.offset - start, ..coupling };
        match self.coordinates[coupling.joint].as_slice() {
            [leader] => vec![self.writer.coupled(&leader.ident, &coupling)],
            all => all.iter().map(|q| self.writer.name(&q.ident)).collect(),
        }
    }

    fn body(&self, link: usize) -> BodyClause {
        let writer = self.writer;
        let [position, rotation] = match (self.structure.joint_of[link], &self.base) {
            (Some(joint), _) => {
                let written = &self.description.joints[joint];
                match (written.kind, self.coordinates[joint].as_slice()) {
                    (JointKind::Floating, [pose]) => writer.floating(written, &pose.ident),
                    (JointKind::Ball, [rotation]) => writer.ball(written, &rotation.ident),
                    _ => writer.placed(written, &self.values(joint, written.reference)),
                }
            }
            (None, Some(base)) => {
                [Property::Position, Property::Rotation].map(|part| Some(writer.property(base, part)))
            }
            (None, None) => [None, None],
        };
        let own = &self.description.links[link].inertial;
        let own = match (self.moves(link), self.is_apart(link)) {
            (false, _) => None,
            (true, true) if self.in_field[link] => Some(Vec::new()),
            (true, true) => own.as_ref().map(|own| self.mass_data(own)),
            (true, false) if self.structure.owner_of[link] == link => {
                let nothing = Inertial { mass: 0.0, center: [0.0; 3], inertia: [[0.0; 3]; 3] };
                Some(self.mass_data(&self.merged(link).unwrap_or(nothing)))
            }
            (true, false) => None,
        };
        BodyClause {
            name: Some(self.links[link].clone()),
            massless: own.is_none(),
            parent: self.structure.parent_of[link].map(|parent| self.links[parent].clone()),
            position,
            rotation,
            role_clauses: own.unwrap_or_default(),
            span: writer.span,
        }
    }

    /// Mass, centre of mass and inertia; what is zero, and moments that are equal, as few numbers.
    fn mass_data(&self, own: &Inertial) -> Vec<RoleClause> {
        let writer = self.writer;
        let clause = |role: Role, value: RoleValue| RoleClause { role, shape: Shape::Other, value, span: writer.span };
        let mut all = vec![clause(Role::Mass, RoleValue::Expression(writer.number(own.mass)))];
        let center = writer.triple(&own.center).map(|center| clause(Role::CenterOfMass, RoleValue::Expression(center)));
        all.extend(center.filter(|_| own.mass != 0.0));
        let [[xx, xy, xz], [_, yy, yz], [_, _, zz]] = own.inertia;
        let inertia = match [xy, xz, yz] == [0.0; 3] {
            true if xx == yy && yy == zz => RoleValue::Expression(writer.number(xx)),
            true => RoleValue::Expression(writer.vector([xx, yy, zz].map(|moment| writer.number(moment)))),
            false => {
                let entries = [xx, xy, xz, yy, yz, zz].map(|entry| Box::new(writer.number(entry)));
                RoleValue::Coefficients(Coefficients::Diagonal(entries))
            }
        };
        all.push(clause(Role::CentralInertia, inertia));
        all
    }

    /// What acts in the joints.
    fn forces(&mut self) -> Vec<ForceClause> {
        let named = |name: &str, kind: ForceKind| ForceClause {
            name: Some(Ident::new(name, self.writer.span)),
            kind,
            span: self.writer.span,
        };
        let mut forces = Vec::new();
        let efforts: Vec<(Ident, Expression)> = self
            .coordinates
            .iter()
            .zip(&self.inputs)
            .filter_map(|(q, input)| Some((q.first()?.ident.clone(), self.writer.name(input.as_ref()?))))
            .collect();
        if !efforts.is_empty() {
            forces.push(named("efforts", ForceKind::Drive { rates: efforts }));
        }
        let damping = self.damping().map(|function| named("joint_damping", ForceKind::Dissipation(function)));
        forces.extend(damping);
        forces.extend(self.springs());
        let (friction, mut notes) = self.friction();
        if !friction.is_empty() {
            forces.push(named("joint_friction", ForceKind::Drive { rates: friction }));
        }
        let (stops, limits) = self.stops();
        forces.extend(stops);
        notes.extend(limits);
        self.notes.extend(notes);
        forces
    }

    /// Joints with one coordinate, each with that of the joint that it follows, and how many times its rate is that
    /// one's.
    fn scalar_joints(&self) -> impl Iterator<Item = (usize, &Joint, &Ident, f64)> {
        self.description.joints.iter().enumerate().filter_map(|(index, joint)| {
            let coupling = self.structure.coupling_of[index];
            match (joint.kind, self.coordinates[coupling.joint].as_slice()) {
                (JointKind::Turning | JointKind::Sliding, [q]) => Some((index, joint, &q.ident, coupling.multiplier)),
                _ => None,
            }
        })
    }

    /// Σ ½ d (m q̇)².
    fn damping(&self) -> Option<Expression> {
        let writer = self.writer;
        let terms =
            self.scalar_joints().filter(|(_, joint, ..)| joint.damping > 0.0).map(|(_, joint, q, multiplier)| {
                let rate = writer.call(FunctionName::Rate, vec![writer.name(q)]);
                let factor = writer.number(joint.damping * multiplier * multiplier / 2.0);
                writer.times(factor, writer.times(rate.clone(), rate))
            });
        terms.reduce(|a, b| writer.plus(a, b))
    }

    fn springs(&self) -> Vec<ForceClause> {
        let writer = self.writer;
        let springs = self.scalar_joints().filter(|(_, joint, ..)| joint.stiffness > 0.0);
        let spring = |(index, joint, q, _): (usize, &Joint, &Ident, f64)| {
            let along = self.values(index, 0.0).into_iter().next()?;
            let stiffness = writer.number(joint.stiffness);
            let length = (joint.rest != 0.0).then(|| writer.number(joint.rest));
            let kind = ForceKind::Spring { extent: Extent::Along(along), stiffness, length, damping: None };
            let own = self.structure.coupling_of[index].joint == index;
            let name = own.then(|| format_ident!("{}_spring", q.unraw(), span = writer.span));
            Some(ForceClause { name, kind, span: writer.span })
        };
        springs.filter_map(spring).collect()
    }

    /// The inertia of a joint alone: two rotors without mass that turn as far, one each way, so that what they add to
    /// the momentum of the robot is nothing.
    fn rotors(&self) -> Vec<BodyClause> {
        let writer = self.writer;
        let rotor = |(index, joint, q, _): (usize, &Joint, &Ident, f64)| {
            let value = self.values(index, 0.0).into_iter().next()?;
            let zero = || writer.number(0.0);
            let moments = writer.vector([zero(), zero(), writer.number(joint.armature / 2.0)]);
            let clause = |role: Role, e: Expression| RoleClause {
                role,
                shape: Shape::Other,
                value: RoleValue::Expression(e),
                span: writer.span,
            };
            let rotor = |end: &str, angle: Expression| BodyClause {
                name: Some(format_ident!("{}_rotor{}", q.unraw(), end, span = writer.span)),
                massless: false,
                parent: None,
                position: None,
                rotation: Some(writer.call(FunctionName::RotationZ, vec![angle])),
                role_clauses: vec![clause(Role::Mass, zero()), clause(Role::Inertia, moments.clone())],
                span: writer.span,
            };
            Some([rotor("", value.clone()), rotor("_back", writer.negative(value))])
        };
        let armed = self.scalar_joints().filter(|(_, joint, ..)| joint.armature > 0.0);
        armed.filter_map(rotor).flatten().collect()
    }

    /// Links that have a point in common.
    fn closures(&self) -> Vec<ConstraintClause> {
        let writer = self.writer;
        let index = |name: &String| self.description.links.iter().position(|link| link.name == *name);
        let closure = |closure: &Closure| {
            let [first, second] = [index(&closure.links[0])?, index(&closure.links[1])?];
            let other = self.structure.opposite(self.description, [first, second], &closure.anchor);
            let [a, b] = [(first, &closure.anchor), (second, &other)].map(|(link, point)| {
                let origin = writer.property(&self.links[link], Property::Position);
                match writer.triple(point) {
                    Some(point) => {
                        let rotation = writer.property(&self.links[link], Property::Rotation);
                        writer.plus(origin, writer.times(rotation, point))
                    }
                    None => origin,
                }
            });
            let expression = writer.binary(BinaryOperator::Subtract, a, b);
            Some(ConstraintClause { kind: ConstraintKind::Position, expression, vector: false, span: writer.span })
        };
        self.description.closures.iter().filter_map(closure).collect()
    }

    /// The acceleration of free fall, where neither a field nor a clause of the struct says it.
    fn gravity(&self) -> Option<RoleClause> {
        let writer = self.writer;
        let value = match self.description.gravity? {
            [0.0, 0.0, 0.0] => return None,
            [0.0, 0.0, g] => writer.number(-g),
            g => writer.triple(&g)?,
        };
        Some(RoleClause {
            role: Role::Gravity,
            shape: Shape::Other,
            value: RoleValue::Expression(value),
            span: writer.span,
        })
    }

    /// −f v/√(v² + w²) of every joint with dry friction, where a width is said.
    fn friction(&self) -> (Vec<(Ident, Expression)>, Vec<Note>) {
        let writer = self.writer;
        let (mut rates, mut notes): (Vec<(Ident, Expression)>, _) = (Vec::new(), Vec::new());
        for (_, joint, q, multiplier) in self.scalar_joints().filter(|(_, joint, ..)| joint.friction > 0.0) {
            let width = match &self.clauses.friction {
                Some(Friction::Smooth(width)) => width,
                Some(Friction::None) => continue,
                None => {
                    let text = format!(
                        "the dry friction of the joint `{}` does not act; write `joint_friction = smooth(width)` for a \
                         law that is \
                         smooth over this width of its rate, or `joint_friction = none`",
                        joint.name
                    );
                    notes.push(Note { at: joint.at, text, ignored: true });
                    continue;
                }
            };
            let rate = writer.call(FunctionName::Rate, vec![writer.name(q)]);
            let rate = if multiplier == 1.0 { rate } else { writer.times(writer.number(multiplier), rate) };
            let squares = [&rate, width].map(|e| writer.times(e.clone(), e.clone()));
            let [rate_squared, width_squared] = squares;
            let root = writer.call(FunctionName::Sqrt, vec![writer.plus(rate_squared, width_squared)]);
            let ratio = writer.binary(BinaryOperator::Divide, rate, root);
            let value = writer.times(writer.number(-joint.friction * multiplier), ratio);
            match rates.iter_mut().find(|(name, _)| name == q) {
                Some((_, sum)) => *sum = writer.plus(sum.clone(), value),
                None => rates.push((q.clone(), value)),
            }
        }
        (rates, notes)
    }

    /// Stops at the limits of joints, where their laws are said.
    fn stops(&self) -> (Vec<ForceClause>, Option<Note>) {
        let writer = self.writer;
        let limited: Vec<_> = self.scalar_joints().filter(|(_, joint, ..)| joint.limits != [None; 2]).collect();
        let Some((_, first, ..)) = limited.first() else { return (Vec::new(), None) };
        let Some(Limits::Stop { stiffness, width, damping }) = &self.clauses.limits else {
            let text = "the limits of joints do not act; `limits = stop(stiffness = …, width = …)` makes stops of them";
            let note = Note { at: first.at, text: text.to_owned(), ignored: false };
            return (Vec::new(), self.clauses.limits.is_none().then_some(note));
        };
        let stop = |(index, joint, ..): &(usize, &Joint, &Ident, f64)| {
            let along = self.values(*index, 0.0).into_iter().next()?;
            let [least, most] = joint.limits.map(|limit| limit.map(|limit| writer.number(limit)));
            let (stiffness, width, damping) = (stiffness.clone(), width.clone(), damping.clone());
            let kind = ForceKind::Stop { extent: Extent::Along(along), least, most, stiffness, width, damping };
            let name =
                format_ident!("{}_limits", self.coordinates[self.structure.coupling_of[*index].joint][0].ident.unraw());
            let name = (self.structure.coupling_of[*index].joint == *index).then_some(name);
            Some(ForceClause { name, kind, span: writer.span })
        };
        (limited.iter().filter_map(stop).collect(), None)
    }
}

/// Coordinates of a joint that follows no other.
fn coordinates(joint: &Joint, names: &mut Names) -> Vec<Coordinate> {
    let ends: &[&str] = match joint.kind {
        JointKind::Fixed => &[],
        JointKind::Planar => &["_x", "_y", "_theta"],
        _ => &[""],
    };
    let kind = match joint.kind {
        JointKind::Floating => CoordinateKind::Pose,
        JointKind::Ball => CoordinateKind::Rotation,
        _ => CoordinateKind::Scalar,
    };
    let coordinate = |end: &&str| {
        let ident = match *end {
            "" => names.identifier(&joint.name, "joint", joint.at),
            end => names.chosen(&format!("{}{end}", joint.name)),
        };
        Coordinate { ident, kind }
    };
    ends.iter().map(coordinate).collect()
}
