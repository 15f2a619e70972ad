//! A description → the clauses that say the same, before those of the struct.

use std::collections::HashSet;

use proc_macro2::Ident;
use quote::format_ident;
use syn::ext::IdentExt;

use super::drives::{self, RobotInput};
use super::joints::ExpressionWriter;
use gauss_robots::description::{Description, Drive, Fault, Inertial, Joint, JointKind, Note};

use super::locks::{self, LockedJoint};
use super::names::RobotNames;
use super::source;

use crate::model::language::context::Context;
use crate::model::language::declarations;
use crate::model::language::fields::{ReadField, Reader};
use crate::model::language::robots::{Base, File, Format, RobotClauses};
use crate::model::language::statements::Statements;
use crate::model::scene::clauses::{
    BodyClause, Coefficients, CoordinateClause, CoordinateKind, RoleClause, RoleValue, Speed, SpeedKind,
};
use crate::model::scene::expression::{Expression, FunctionName, Property};
use crate::terms::{FileRemark, RobotFile};
use crate::terms::{ReactionJoint, Role, Shape};
use gauss_robots::{Coupling, Structure, Text, all_located, located};

/// Name of the coordinate of the free root of a robot.
const BASE: &str = "base";

/// Puts the clauses made from the file before those of the struct. `None` where the file has a mistake, which is noted.
pub fn compose(
    file: &File,
    clauses: &RobotClauses,
    reader: &Reader<'_>,
    (statements, reactions): (&mut Statements, &mut [ReactionJoint]),
    context: &mut Context,
) -> Option<RobotFile> {
    if file.format == Format::Mjcf && clauses.base.is_some() {
        context.error(file.span, "in an MJCF file <freejoint/> marks bodies that move freely; remove `base`");
    }
    if let (Some(mount), Some(Base::Floating)) = (&clauses.mount, clauses.base) {
        context.error(mount.span, "a floating root is placed by its pose `base`; remove `base(…)`");
    }
    let path = source::path(file);
    let read = source::text(file, &path).and_then(|text| {
        let faults = |faults: Vec<Fault>| all_located(&text.names(), &faults);
        let description = source::read(file.format, &text).map_err(faults)?;
        let structure = Structure::new(&description).map_err(faults)?;
        let mut robot = Robot::new(file, (clauses, reader), (&description, structure), statements, context);
        robot.cut(reactions, context);
        statements.joints_of_file = robot.names_of_joints();
        statements.links_of_file = robot.renamed_links();
        robot.refuse_mount(file, context);
        let idle = robot.without_inertia(&statements.armatures);
        let moves = statements.coordinates.is_some() || statements.in_chart;
        let idle = if idle.is_empty() && !moves { robot.without_motion(file) } else { idle };
        let idle = if idle.is_empty() { robot.impossible(&statements.formal) } else { idle };
        if idle.is_empty() { Ok(robot.written(file, &text, statements, context)) } else { Err(faults(idle)) }
    });
    match read {
        Ok(described) => Some(described),
        Err(messages) => {
            // Whatever else seems to be missing is what the file was to say.
            statements.missed = true;
            messages.iter().for_each(|message| context.error(file.span, message));
            None
        }
    }
}

/// A description with the names that its parts have in expressions.
pub struct Robot<'a> {
    pub clauses: &'a RobotClauses,
    pub description: &'a Description,
    pub structure: Structure,
    pub writer: ExpressionWriter,
    /// The pose of the root, if it moves.
    base: Option<Ident>,
    /// Coordinates of each joint; none of those that are fixed or follow another.
    pub coordinates: Vec<Vec<CoordinateClause>>,
    pub locked: Vec<LockedJoint>,
    /// Joints that are driven, by their indices.
    pub driven: Vec<usize>,
    pub inputs: Vec<RobotInput>,
    pub links: Vec<Ident>,
    /// The mass data of the link are those of a field.
    pub in_field: Vec<bool>,
    /// A joint within the link and what is fixed to it has a reaction that is wanted, by the link that they move with.
    cut: Vec<bool>,
    pub gravity_in_field: bool,
    pub notes: Vec<Note>,
    pub names: RobotNames,
}

impl<'a> Robot<'a> {
    fn new(
        file: &File,
        (clauses, reader): (&'a RobotClauses, &Reader<'_>),
        (description, mut structure): (&'a Description, Structure),
        statements: &mut Statements,
        context: &mut Context,
    ) -> Self {
        let words = description.joints.iter().map(|joint| &joint.name);
        let mut names = RobotNames::new(file.span, words.chain(description.links.iter().map(|link| &link.name)));
        let floating = clauses.base == Some(Base::Floating);
        let base = floating.then(|| names.chosen(BASE));
        let own = |index: usize| structure.coupling_of[index].joint == index;
        let all = || description.joints.iter().enumerate();
        let mut coordinates: Vec<Vec<CoordinateClause>> =
            all().map(|(k, joint)| if own(k) { coordinates(joint, &mut names) } else { Vec::new() }).collect();
        let held = locks::found((description, &mut structure), clauses, &mut coordinates, statements, context);
        let is_held = |drive: &Drive| locks::is_held((description, &structure), &held, drive);
        let mut free = coordinates.clone();
        held.driven.iter().for_each(|&joint| free[joint].clear());
        let inputs = drives::inputs((description, &is_held), &free, clauses.inputs, &mut names);
        let links: Vec<Ident> =
            description.links.iter().map(|link| names.identifier(&link.name, "link", link.at)).collect();
        let plays = |field: &ReadField<'_>, role: Role| field.role.as_ref().is_some_and(|claim| claim.role == role);
        let bodies = || reader.fields.iter().filter(|field| plays(field, Role::Body));
        let in_field = links.iter().map(|name| bodies().any(|field| field.ident == name)).collect();
        let gravity_in_field = reader.fields.iter().any(|field| plays(field, Role::Gravity));
        let mut notes = description.notes.clone();
        notes.append(&mut names.notes);
        notes.extend(drives::notes(description, &inputs));
        notes.extend(drives::lost((description, &is_held), &inputs, clauses.inputs));
        notes.extend(locks::notes((description, &structure), &held));
        let writer = ExpressionWriter { span: file.span };
        Robot {
            clauses,
            description,
            structure,
            writer,
            base,
            coordinates,
            locked: held.locked,
            driven: held.driven,
            inputs,
            links,
            in_field,
            cut: vec![false; description.links.len()],
            gravity_in_field,
            notes,
            names,
        }
    }

    /// Finds the links that joints carry whose reactions are wanted, by the names of either. Links that are fixed to
    /// one another keep the mass data of their own if one of the joints between them is among these.
    fn cut(&mut self, reactions: &mut [ReactionJoint], context: &mut Context) {
        let mut carried_links: Vec<usize> = Vec::new();
        for ReactionJoint { name, link } in reactions {
            let word = name.unraw().to_string();
            let is_called = |&joint: &usize| {
                let coordinates = self.coordinates[joint].iter().any(|q| q.ident.unraw() == word);
                coordinates || self.description.joints[joint].name == word
            };
            let carried = |k: &usize| self.structure.joint_of[*k].is_some_and(|joint| is_called(&joint));
            let by_joint = (0..self.links.len()).find(carried);
            let by_link = self.links.iter().position(|ident| ident.unraw() == word);
            let found = match (by_link, by_joint) {
                (Some(own), Some(other)) if own != other => {
                    let message = format!(
                        "`{name}` is a link of the file and the joint that carries `{}`; name that link",
                        self.links[other]
                    );
                    context.error(name.span(), message);
                    continue;
                }
                (own, other) => own.or(other),
            };
            let Some(found) = found else { continue };
            if carried_links.contains(&found) {
                let message = format!("`{name}` is a joint that is named before by another name; remove it");
                context.error(name.span(), message);
            }
            carried_links.push(found);
            *link = Ident::new(&self.links[found].to_string(), name.span());
            let owner = self.structure.owner_of[found];
            self.cut[owner] |= owner != found || !self.moves(found);
        }
    }

    /// Names of joints that carry links in `reactions(…)`: as in the file, where that is an identifier, else as their
    /// coordinates.
    fn names_of_joints(&self) -> Vec<String> {
        let carrying = self.structure.joint_of.iter().flatten();
        let called = |&joint: &usize| {
            let own = self.description.joints[joint].name.clone();
            let coordinates = self.coordinates[joint].iter().map(|q| q.ident.unraw().to_string());
            if syn::parse_str::<Ident>(&own).is_ok() { vec![own] } else { coordinates.collect() }
        };
        carrying.flat_map(called).collect()
    }

    /// Links that are not called as in the file, by both names.
    pub fn renamed_links(&self) -> Vec<(String, String)> {
        let links = self.links.iter().zip(&self.description.links);
        let renamed = links.filter(|(ident, link)| *ident != &link.name);
        renamed.map(|(ident, link)| (link.name.clone(), ident.to_string())).collect()
    }

    /// Whether the root moves freely.
    pub fn is_floating(&self) -> bool {
        self.base.is_some()
    }

    /// Whether a link moves at all.
    pub fn moves(&self, link: usize) -> bool {
        self.base.is_some() || self.structure.owner_of[link] != self.structure.root
    }

    /// Whether the mass data of a link are not added to those of the link that it is fixed to: one of the two is a
    /// field, the reaction between them is wanted, or a joint between them is held at a parameter.
    fn is_apart(&self, link: usize) -> bool {
        let owner = self.structure.owner_of[link];
        self.in_field[link] || self.in_field[owner] || self.cut[owner] || self.is_placed_by_parameter(link)
    }

    /// The mass data of a link and of all links fixed to it, but for those in fields.
    pub fn merged(&self, link: usize) -> Option<Inertial> {
        self.structure.merged(self.description, link, |link| self.is_apart(link))
    }

    /// Refuses `base(…)` where parts of the file are placed in the world by themselves, which would not move with the
    /// root.
    fn refuse_mount(&self, file: &File, context: &mut Context) {
        let Some(mount) = self.clauses.mount.as_ref().filter(|_| file.format == Format::Mjcf) else { return };
        let is_free = |joint: &Joint| joint.kind == JointKind::Floating;
        if let Some(joint) = self.description.joints.iter().find(|joint| is_free(joint)) {
            let message = format!(
                "`base(…)` moves what the file holds, and `{}` moves freely: it is placed by its pose; remove `base(…)`",
                joint.name
            );
            context.error(mount.span, message);
        }
        if self.clauses.grounds.iter().any(|ground| ground.normal.is_none() && ground.height.is_none()) {
            let message = "beside `base(…)` planes of the file are not used; write `ground(height = h, …)`";
            context.error(mount.span, message);
        }
    }

    /// Links that move where nothing beyond their joint has mass or inertia, nor the joint an armature, of the file or
    /// among these of the struct.
    fn without_inertia(&self, of_struct: &[(Ident, Expression)]) -> Vec<Fault> {
        let has = |link: usize| {
            let some = |own: &Inertial| own.mass > 0.0 || own.inertia.iter().flatten().any(|entry| *entry != 0.0);
            self.in_field[link] || self.description.links[link].inertial.as_ref().is_some_and(some)
        };
        let mut carries = vec![false; self.links.len()];
        for start in (0..self.links.len()).filter(|&link| has(link)) {
            self.structure.way_to_root(start).for_each(|link| carries[link] = true);
        }
        let of_file = self.armatures();
        let geared: HashSet<&Ident> = of_file
            .iter()
            .filter(|(_, own)| *own > 0.0)
            .map(|(q, _)| q)
            .chain(of_struct.iter().map(|(q, _)| q))
            .collect();
        let is_geared = |link: usize| match self.structure.joint_of[link] {
            Some(joint) if self.is_driven(joint) => true,
            Some(joint) => {
                self.coordinates[self.structure.coupling_of[joint].joint].iter().all(|q| geared.contains(&q.ident))
            }
            None => self.base.iter().all(|base| geared.contains(base)),
        };
        let idle = |&(link, carries): &(usize, bool)| {
            let moves_itself = self.structure.owner_of[link] == link && self.moves(link);
            !carries && moves_itself && !is_geared(link)
        };
        let fault = |(link, _): (usize, bool)| {
            let hangs = |&other: &usize| self.structure.way_to_root(other).any(|on| on == link);
            let notes = (0..self.links.len()).filter(hangs).flat_map(|own| &self.description.links[own].mass_notes);
            let unread: String =
                notes.filter(|note| note.ignored.is_some()).map(|note| format!(" ({})", note.text)).collect();
            let link = &self.description.links[link];
            let message = format!(
                "the link `{}` moves, and neither it nor what hangs on it has an <inertial>; add one, give its joint an \
                 `armature`, or fix it{unread}",
                link.name
            );
            Fault { at: link.at, message }
        };
        carries.into_iter().enumerate().filter(idle).map(fault).collect()
    }

    /// The place of the file, where nothing of it moves and the struct has no bodies of its own.
    fn without_motion(&self, file: &File) -> Vec<Fault> {
        if self.base.is_some() || self.coordinates.iter().any(|own| !own.is_empty()) {
            return Vec::new();
        }
        let root = &self.description.links[self.structure.root];
        let remedy = if file.format == Format::Urdf { "write `base = floating`, or " } else { "" };
        let still = if self.locked.is_empty() { "no joint does" } else { "all joints are locked or fixed" };
        let unread = self.notes.iter().find(|note| note.ignored.is_some() && self.locked.is_empty());
        let unread = unread.map(|note| format!(" ({})", note.text)).unwrap_or_default();
        let message =
            format!("nothing moves: {still}, and the root `{}` is held{unread}; {remedy}add a joint", root.name);
        vec![Fault { at: root.at, message }]
    }

    /// Puts the clauses before those of the struct; gives back what is to be known of the file.
    fn written(mut self, file: &File, text: &Text, statements: &mut Statements, context: &mut Context) -> RobotFile {
        let span = self.writer.span;
        statements.first.get_or_insert_with(|| Ident::new("urdf", span));
        self.require_fields(context);
        let mut coordinates: Vec<CoordinateClause> = Vec::new();
        coordinates.extend(
            self.base.iter().map(|ident| CoordinateClause { ident: ident.clone(), kind: CoordinateKind::Pose }),
        );
        coordinates.extend(self.coordinates.iter().flatten().cloned());
        if let (Some(speeds), Some(kinematics)) = (&mut statements.speeds, &mut statements.kinematics) {
            let (own, rates) = self.rates(&coordinates);
            speeds.names.splice(0..0, own);
            kinematics.rates.splice(0..0, rates);
        }
        declarations::before(&mut statements.coordinates, coordinates, "coordinates", span);
        let inputs: Vec<_> = self.inputs.iter().map(|input| input.name.clone()).collect();
        if !inputs.is_empty() {
            declarations::before(&mut statements.inputs, inputs, "input", span);
        }
        let bodies: Vec<BodyClause> = (0..self.links.len()).map(|link| self.body(link)).collect();
        statements.bodies.splice(0..0, bodies);
        self.add_armatures(statements);
        let constraints = self.constraints(&text.names());
        self.notes.extend(self.broken_relations());
        statements.constraints_of_file = constraints.len();
        statements.constraints.splice(0..0, constraints);
        let made = self.touching(context);
        let links = self.links.len();
        statements.bodies.splice(links..links, made.frames);
        statements.points.splice(0..0, made.points);
        let of_joints = self.ranges().into_iter().chain(self.dry_friction());
        statements.contacts.splice(0..0, of_joints.chain(made.contacts));
        let gravity = statements.role_clauses.iter().find(|clause| clause.role == Role::Gravity);
        let forces = self.forces(gravity);
        let own = self.gravity().filter(|_| gravity.is_none() && !self.gravity_in_field);
        statements.role_clauses.extend(own);
        statements.forces_of_file = forces.len();
        statements.forces.splice(0..0, forces);
        self.described(file, text)
    }

    /// Adds the armatures of joints to those of the struct.
    fn add_armatures(&self, statements: &mut Statements) {
        let writer = self.writer;
        for (q, inertia) in self.armatures().into_iter().rev() {
            let inertia = writer.number(inertia);
            match statements.armatures.iter_mut().find(|(name, _)| *name == q) {
                Some((_, sum)) => *sum = writer.plus(inertia, sum.clone()),
                None => statements.armatures.insert(0, (q, inertia)),
            }
        }
    }

    /// Notes on masses of links that move by those of the file.
    fn mass_notes(&self) -> Vec<Note> {
        let links = (0..self.links.len()).filter(|&link| self.moves(link) && !self.in_field[link]);
        links.flat_map(|link| self.description.links[link].mass_notes.clone()).collect()
    }

    fn described(&mut self, file: &File, text: &Text) -> RobotFile {
        self.notes.extend(self.mass_notes());
        self.notes = Note::gathered(std::mem::take(&mut self.notes));
        let known = |what: &String| self.clauses.ignored.iter().any(|word| word == what.as_str());
        let names = text.names();
        let remark = |note: &Note| FileRemark {
            text: located(&names, note.at, &note.text),
            ignored: note.ignored.as_ref().is_some_and(|what| !known(what)),
        };
        let links = self.links.iter().zip(&self.description.links);
        let called =
            links.filter(|(ident, link)| *ident != &link.name).map(|(ident, link)| (ident.clone(), link.name.clone()));
        let files = self.description.files.iter().map(|file| file.to_string_lossy().into_owned());
        RobotFile {
            paths: text.paths().into_iter().chain(files).collect(),
            file: file.path.clone(),
            span: file.span,
            remarks: self.notes.iter().map(remark).collect(),
            called: called.collect(),
            bodies: self.bodies_of_file(),
            states: self.states(),
        }
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
    fn rates(&self, coordinates: &[CoordinateClause]) -> (Vec<Speed>, Vec<(Ident, Option<Expression>)>) {
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

    /// The coordinates that a joint moves by, those of the one that it follows, or what they are held at, from a
    /// `start`.
    pub fn values(&self, joint: usize, start: f64) -> Vec<Expression> {
        let coupling = self.structure.coupling_of[joint];
        let coupling = Coupling { offset: coupling.offset - start, ..coupling };
        if let Some(lock) = self.lock_of(joint) {
            return vec![match lock.number {
                Some(_) if (coupling.multiplier, coupling.offset) == (1.0, 0.0) => lock.value.clone(),
                Some(number) => self.writer.number(coupling.multiplier * number + coupling.offset),
                None => self.writer.coupled(&lock.ident, &coupling),
            }];
        }
        match self.coordinates[coupling.joint].as_slice() {
            [leader] => vec![self.writer.coupled(&leader.ident, &coupling)],
            all => all.iter().map(|q| self.writer.name(&q.ident)).collect(),
        }
    }

    /// Position and rotation of a link relative to the one that it hangs on; of the root, as the observer sees it.
    pub fn placement(&self, link: usize) -> [Option<Expression>; 2] {
        let writer = self.writer;
        match (self.structure.joint_of[link], &self.base) {
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
            (None, None) => {
                let mount = self.clauses.mount.as_ref();
                mount.map_or([None, None], |mount| [mount.position.clone(), mount.rotation.clone()])
            }
        }
    }

    fn body(&self, link: usize) -> BodyClause {
        let writer = self.writer;
        let [position, rotation] = self.placement(link);
        let own = &self.description.links[link].inertial;
        let weighs = self.moves(link) || self.cut[self.structure.owner_of[link]];
        let own = match (weighs, self.is_apart(link)) {
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

    /// The acceleration of free fall, where neither a field nor a clause of the struct gives it.
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
}

/// Coordinates of a joint that follows no other.
fn coordinates(joint: &Joint, names: &mut RobotNames) -> Vec<CoordinateClause> {
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
        CoordinateClause { ident, kind }
    };
    ends.iter().map(coordinate).collect()
}
