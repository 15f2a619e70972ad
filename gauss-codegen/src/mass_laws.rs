//! Laws of mass data and gravity that `kernel()` checks, in their order.

use proc_macro2::Ident;

use crate::algebra::Expr;
use crate::mechanics::{KineticMatrix, QuantityValues, System, SystemScene};
use crate::terms::{Field, Role, Shape};
use crate::translate::{BodyData, ClauseValue, Provenance};
use crate::words::Unraw;

/// Laws that mass data must keep.
pub struct MassLaws<'g> {
    /// Laws of the data of fields and clauses, one by one.
    pub of_data: Vec<Group<'g>>,
    /// Laws of fluids, and of bodies in all motions that they can have.
    pub of_motions: Vec<Group<'g>>,
    /// Bodies without mass may move with others; then the mass matrix of all is checked.
    pub in_sum: bool,
    /// Gravity of one number, which is expected to point down, and what it is called.
    pub gravity: Option<(String, Datum)>,
    /// Diagonals of added masses, which are expected to be positive.
    pub added_masses: Vec<(String, Vec<Expr<'g>>)>,
}

/// Laws, and the values in clauses that they alone are about.
pub struct Group<'g> {
    pub values: Vec<QuantityValues<'g>>,
    pub laws: Vec<MassLaw<'g>>,
}

/// A rule for what is called `label`.
pub struct MassLaw<'g> {
    pub label: String,
    pub rule: MassRule<'g>,
}

pub enum MassRule<'g> {
    /// The mass of a body alone.
    Mass(Datum),
    /// The mass of one of several bodies.
    MassInSum(Datum),
    NonNegative(Datum),
    Finite(Datum, Shape),
    /// Six by six.
    Symmetric(Datum),
    Inertia(InertiaRules),
    /// The matrix of the kinetic energy on the axes of a motion is positive definite.
    KineticMatrix(Vec<Vec<Expr<'g>>>),
}

/// Place where numbers are read.
#[derive(Clone, Copy)]
pub enum Datum {
    Field(usize),
    /// A part of a field that is a body.
    Part(usize, Role),
    /// A clause of the body without a name.
    Clause(Role),
    /// Among the values of the group.
    Own(Role),
}

/// Rules that an inertia must keep.
pub struct InertiaRules {
    pub rules: Vec<InertiaRule>,
    pub tensor: Datum,
    pub shape: Shape,
    /// Zero where there is none, or where it does not enter.
    pub mass: Option<Datum>,
    pub center: Option<Datum>,
    /// The triangle inequality is waived.
    pub is_formal: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum InertiaRule {
    /// About O.
    Alone,
    /// About the centre of mass.
    Central,
    /// The moment about the third axis alone.
    Planar,
    /// The moment of a body about the one axis about which it turns: no other moment enters.
    AboutAxis(usize),
    /// No moment enters: the body does not turn.
    Still,
    /// Inertia of a body that moves with others.
    InSum,
}

impl<'g> MassLaws<'g> {
    pub fn new(provenance: &Provenance<'g>, system: &System<'g>) -> Self {
        let laws = Laws { provenance, scene: &system.scene };
        let bodies = &provenance.mass_data.bodies;
        let of_one = |laws: Vec<MassLaw<'g>>| Group { values: Vec::new(), laws };
        let fields = provenance.item.fields.iter().enumerate().filter(|(k, _)| provenance.is_read(*k));
        let mut of_data: Vec<Group<'g>> = fields.map(|(k, field)| of_one(laws.of_field(k, field))).collect();
        of_data.extend(provenance.mass_data.unnamed.iter().filter(|value| value.own.is_constant()).map(|value| {
            let role = value.own.quantity;
            let rule = laws.of_role(role, value.shape, Datum::Clause(role));
            of_one(vec![MassLaw { label: role.word().to_owned(), rule }])
        }));
        of_data.extend(bodies.iter().filter_map(|body| laws.of_clauses(body)));
        let of_fluid = bodies.iter().flat_map(|body| laws.of_fluid(body));
        let of_motions = of_fluid.chain(laws.of_motion(system)).collect();
        let gravity = laws.datum(Role::Gravity).filter(|_| provenance.shape(Role::Gravity) == Some(Shape::Scalar));
        let gravity = gravity.map(|gravity| (provenance.role_name(None, Role::Gravity), gravity));
        let added_masses = bodies.iter().filter_map(|body| laws.of_added_mass(body)).collect();
        Self { of_data, of_motions, in_sum: !laws.is_charted_body(), gravity, added_masses }
    }
}

/// The laws of a scene.
struct Laws<'a, 'g> {
    provenance: &'a Provenance<'g>,
    scene: &'a SystemScene<'g>,
}

impl<'g> Laws<'_, 'g> {
    /// Whether the configuration is the pose of one body in a chart: its mass data then stand by themselves, and are in
    /// no sum with those of others.
    fn is_charted_body(&self) -> bool {
        self.scene.chart().is_some()
    }

    /// Place of the data that play a role of the body without a name.
    fn datum(&self, role: Role) -> Option<Datum> {
        let field = self.provenance.item.fields.iter().position(|field| field.role == Some(role)).map(Datum::Field);
        field.or_else(|| self.provenance.mass_data.unnamed(role).map(|_| Datum::Clause(role)))
    }

    /// Whether mass data of the body without a name vary.
    fn varies(&self) -> bool {
        self.provenance.mass_data.unnamed.iter().any(|value| !value.own.is_constant())
    }

    fn of_added_mass(&self, body: &BodyData<'g>) -> Option<(String, Vec<Expr<'g>>)> {
        let matrix = self.scene.tree.links[body.link].body()?.added_mass.as_ref()?;
        let label = self.provenance.role_name(body.name.as_ref(), Role::AddedMass);
        Some((label, (0..6).map(|i| matrix[i][i]).collect()))
    }

    fn of_field(&self, k: usize, field: &Field) -> Vec<MassLaw<'g>> {
        let (label, datum) = (field.ident.unraw().to_string(), Datum::Field(k));
        let rule = match (field.role, field.shape) {
            (_, Shape::Other) => return Vec::new(),
            (_, shape @ (Shape::RigidBody | Shape::CentralBody)) => {
                let [mass, center, tensor] =
                    [Role::Mass, Role::CenterOfMass, Role::Inertia].map(|role| Datum::Part(k, role));
                let (word, is_central) = (Role::Inertia.word(), shape == Shape::CentralBody);
                return self.of_body(&field.ident, word, (mass, Some(center)), (tensor, Shape::Matrix3), is_central);
            }
            (Some(role), shape) => self.of_role(role, shape, datum),
            (None, Shape::Matrix6) if self.provenance.mass_data.added_masses.contains(&k) => MassRule::Symmetric(datum),
            (None, shape) => MassRule::Finite(datum, shape),
        };
        vec![MassLaw { label, rule }]
    }

    /// Rule for mass data of the body without a name, and for gravity.
    fn of_role(&self, role: Role, shape: Shape, datum: Datum) -> MassRule<'g> {
        match (role, shape) {
            (Role::Mass, _) if self.is_charted_body() => MassRule::Mass(datum),
            (Role::Mass, _) => MassRule::MassInSum(datum),
            (Role::DisplacedMass, _) => MassRule::NonNegative(datum),
            // What varies is not known before the run, and an inertia stands beside it.
            (Role::Inertia | Role::CentralInertia, _) if self.varies() => MassRule::Finite(datum, shape),
            (Role::Inertia | Role::CentralInertia, _) => MassRule::Inertia(self.of_inertia(role, shape, datum)),
            (Role::AddedMass, Shape::Matrix6) => MassRule::Symmetric(datum),
            _ => MassRule::Finite(datum, shape),
        }
    }

    /// Rules for the inertia of the body without a name.
    fn of_inertia(&self, role: Role, shape: Shape, tensor: Datum) -> InertiaRules {
        let body = self.provenance.body(None);
        // Where O is held at Ω only m·c and I_O enter, and m by itself says nothing.
        let is_held = body.is_some_and(|body| self.scene.is_held(body.link));
        let is_central = role == Role::CentralInertia;
        let mut mass = self.datum(Role::Mass).filter(|_| !is_held);
        let mut center = self.datum(Role::CenterOfMass).filter(|_| !is_held && !is_central);
        let twist = body.map(|body| self.scene.twist_of(body.link)).unwrap_or_default();
        let rules = match twist.as_slice() {
            _ if !self.is_charted_body() => vec![self.in_sum(body)],
            // In the plane only the moment about k₃ enters, whatever else is given.
            [0, 1, 5] if !self.provenance.mass_data.attracted => vec![InertiaRule::Planar, InertiaRule::AboutAxis(2)],
            [0, 1, 5] => vec![InertiaRule::Planar, InertiaRule::InSum],
            _ if is_central => {
                (mass, center) = (self.datum(Role::Mass), None);
                vec![InertiaRule::Central]
            }
            _ if !is_held && self.datum(Role::CenterOfMass).is_some() => vec![InertiaRule::Alone, InertiaRule::Central],
            _ => vec![InertiaRule::Alone],
        };
        InertiaRules { rules, tensor, shape, mass, center, is_formal: body.is_some_and(|body| body.is_formal) }
    }

    /// The rule of a body that moves with others: what enters of its moments depends on the axes about which it turns.
    /// A field of attraction sees all of them.
    fn in_sum(&self, body: Option<&BodyData<'g>>) -> InertiaRule {
        let Some(body) = body.filter(|_| !self.provenance.mass_data.attracted) else { return InertiaRule::InSum };
        match self.scene.tree.links[body.link].turns_about()[..] {
            [] => InertiaRule::Still,
            [axis] => InertiaRule::AboutAxis(axis),
            _ => InertiaRule::InSum,
        }
    }

    /// Laws of a body with a name: mass, centre of mass from O, inertia about O or about the centre of mass
    /// (`is_central`), which is called `word`.
    fn of_body(
        &self,
        name: &Ident,
        word: &str,
        (mass, center): (Datum, Option<Datum>),
        (tensor, shape): (Datum, Shape),
        is_central: bool,
    ) -> Vec<MassLaw<'g>> {
        let body = self.provenance.body(Some(name));
        let law = |part: &str, rule| MassLaw { label: format!("{}.{part}", name.unraw()), rule };
        let inertia = InertiaRules {
            rules: vec![self.in_sum(body)],
            tensor,
            shape,
            mass: Some(mass),
            // About the centre of mass there is no lever.
            center: center.filter(|_| !is_central),
            is_formal: body.is_some_and(|body| body.is_formal),
        };
        let mut laws = vec![law(Role::Mass.word(), MassRule::MassInSum(mass))];
        laws.extend(center.map(|c| law(Role::CenterOfMass.word(), MassRule::Finite(c, Shape::Vector3))));
        laws.push(law(word, MassRule::Inertia(inertia)));
        laws
    }

    /// Laws of a body with a name whose mass data stand in its clause.
    fn of_clauses(&self, body: &BodyData<'g>) -> Option<Group<'g>> {
        let name = body.name.as_ref()?;
        let value_of = |role: Role| body.values.iter().find(|value| value.own.quantity == role);
        let central = value_of(Role::CentralInertia);
        let (mass, inertia) = (value_of(Role::Mass)?, central.or_else(|| value_of(Role::Inertia))?);
        let center = value_of(Role::CenterOfMass);
        // What varies is not known before the run, and the rest stands beside it.
        let varies = |value: &ClauseValue<'g>| !value.own.is_constant();
        if varies(mass) || varies(inertia) || center.is_some_and(varies) {
            return None;
        }
        let role = inertia.own.quantity;
        let lever = (Datum::Own(Role::Mass), center.map(|_| Datum::Own(Role::CenterOfMass)));
        let laws = self.of_body(name, role.word(), lever, (Datum::Own(role), inertia.shape), central.is_some());
        let values = [Some(mass), center, Some(inertia)].into_iter().flatten().map(|value| value.own.clone());
        Some(Group { values: values.collect(), laws })
    }

    /// Laws of the clauses of a body with a name about the fluid around it: the body and its added mass together have a
    /// positive definite kinetic energy in every motion that the body can have.
    fn of_fluid(&self, body: &BodyData<'g>) -> Vec<Group<'g>> {
        let name = body.name.as_ref();
        let of_clause = |ClauseValue { own, shape, .. }: &ClauseValue<'g>| {
            let datum = Datum::Own(own.quantity);
            let rule = match (own.quantity, shape) {
                (Role::DisplacedMass, _) => MassRule::NonNegative(datum),
                (_, Shape::Matrix6) => return None,
                _ => MassRule::Finite(datum, *shape),
            };
            let law = MassLaw { label: self.provenance.role_name(name, own.quantity), rule };
            Some(Group { values: vec![own.clone()], laws: vec![law] })
        };
        let of_fluid = body.values.iter().filter(|value| name.is_some() && !value.own.quantity.is_of_matter());
        let mut groups: Vec<Group<'g>> = of_fluid.filter_map(of_clause).collect();
        let link = &self.scene.tree.links[body.link];
        let varies = body.values.iter().any(|value| !value.own.is_constant()) || (name.is_none() && self.varies());
        if let Some(matter) = link.body().filter(|matter| matter.added_mass.is_some() && !varies) {
            let matrix = KineticMatrix::new(link.frame.graph, matter, &[0, 1, 2], &[3, 4, 5]);
            let label = self.provenance.role_name(name, Role::AddedMass);
            groups.push(kinetic_matrix(label, &matrix, &self.scene.twist_of(body.link)));
        }
        groups
    }

    /// Law of the kinetic energy of the body without a name, on the axes of its motion: with a centre of mass off O its
    /// parts can be fine one by one, and not together.
    fn of_motion(&self, system: &System<'g>) -> Option<Group<'g>> {
        let body = self.provenance.body(None)?;
        let free = system.free.iter().find(|free| free.link == body.link)?;
        let active = &free.kinematics.active;
        let in_fluid = self.scene.tree.links[free.link].body()?.added_mass.is_some();
        // About the centre of mass no part speaks against another.
        let has = |role: Role| self.provenance.shape(role).is_some();
        let is_well = !has(Role::CenterOfMass) || has(Role::CentralInertia);
        if in_fluid || active.iter().all(|&k| k >= 3) || is_well || self.varies() {
            return None;
        }
        Some(kinetic_matrix(self.provenance.role_name(None, Role::Inertia), &free.matrix, active))
    }
}

fn kinetic_matrix<'g>(label: String, matrix: &KineticMatrix<'g>, active: &[usize]) -> Group<'g> {
    let row = |&i: &usize| active.iter().map(|&j| matrix.entries[i][j]).collect();
    let rule = MassRule::KineticMatrix(active.iter().map(row).collect());
    Group { values: Vec::new(), laws: vec![MassLaw { label, rule }] }
}

#[cfg(test)]
mod tests {
    use super::{Group, MassLaw, MassRule};
    use crate::expand::derive;

    /// Each law with what it is called.
    fn laws(source: &str) -> Vec<String> {
        let written = |MassLaw { label, rule }: &MassLaw<'_>| match rule {
            MassRule::Mass(_) => format!("{label}: positive"),
            MassRule::MassInSum(_) => format!("{label}: in sum"),
            MassRule::NonNegative(_) => format!("{label}: not negative"),
            MassRule::Finite(..) => format!("{label}: finite"),
            MassRule::Symmetric(_) => format!("{label}: symmetric"),
            MassRule::Inertia(inertia) => {
                let known = [inertia.mass, inertia.center].map(|datum| datum.is_some());
                format!("{label}: {:?} {known:?}", inertia.rules)
            }
            MassRule::KineticMatrix(rows) => format!("{label}: {} rows", rows.len()),
        };
        let all = |groups: &[Group<'_>]| -> Vec<String> { groups.iter().flat_map(|g| &g.laws).map(written).collect() };
        let input = syn::parse_str(source).expect("a struct");
        let found = derive(&input, |derived| {
            let laws = derived.mass_laws;
            Ok([all(&laws.of_data), all(&laws.of_motions)].concat())
        });
        found.unwrap_or_else(|error| panic!("{error}: {source}"))
    }

    #[test]
    fn the_motion_of_a_body_decides_what_must_hold_of_its_inertia() {
        let fields =
            "#[gauss(mass)] m: f64, #[gauss(center_of_mass)] c: Vector3<f64>, #[gauss(inertia)] i: Matrix3<f64>";
        let of_one = |motion: &str| laws(&format!("#[gauss(motion = {motion})] struct Body {{ {fields} }}"));
        let free = ["m: positive", "c: finite", "i: [Alone, Central] [true, true]", "i: 6 rows"];
        assert_eq!(of_one("free"), free);
        // Where O is held the mass enters by m c and I_O alone.
        assert_eq!(of_one("fixed_point"), ["m: positive", "c: finite", "i: [Alone] [false, false]"]);
        let planar = ["m: positive", "c: finite", "i: [Planar, AboutAxis(2)] [true, true]", "i: 3 rows"];
        assert_eq!(of_one("planar"), planar);
    }

    /// The axis is one of the body's, however the turn comes about; a field of attraction sees all moments.
    #[test]
    fn of_a_moment_that_does_not_enter_nothing_is_said() {
        let of_one = |clauses: &str, placed: &str| {
            laws(&format!(
                "#[gauss(coordinates(x, s), {clauses} body(rod, position = [x, 0, 0], {placed} mass = m, \
                 inertia = j))] struct Rod {{ m: f64, j: f64 }}"
            ))
            .pop()
            .expect("a law of the inertia")
        };
        assert_eq!(of_one("", "rotation = rotation_z(s),"), "rod.inertia: [AboutAxis(2)] [true, false]");
        let turned = "rotation = rotation_z(s) * rotation_x(pi / 2),";
        assert_eq!(of_one("", turned), "rod.inertia: [AboutAxis(1)] [true, false]");
        assert_eq!(
            of_one("", "rotation = rotation_x(0.3) * rotation_z(s),"),
            "rod.inertia: [AboutAxis(2)] [true, false]"
        );
        assert_eq!(of_one("", "rotation = rotation_z(s) * rotation_x(0.3),"), "rod.inertia: [InSum] [true, false]");
        assert_eq!(of_one("particle(mass = m, position = [s, 0, 0]),", ""), "rod.inertia: [Still] [true, false]");
        let attracted = of_one("central_gravity(mu = m, center = [0, 9, 0]),", "rotation = rotation_z(s),");
        assert_eq!(attracted, "rod.inertia: [InSum] [true, false]");
    }

    /// Numbers beside them are checked, and what is about both of them is not.
    #[test]
    fn masses_that_vary_are_known_in_the_run_alone() {
        let of_one = |mass: &str| {
            laws(&format!(
                "#[gauss(coordinates(x), particle(mass = m, position = [x, 0, 0]), body(rod, position = [x, 0, 0], \
                 mass = {mass}, inertia = j))] struct Rod {{ m: f64, j: f64 }}"
            ))
        };
        let known = ["m: finite", "j: finite", "rod.mass: in sum", "rod.inertia: [Still] [true, false]"];
        assert_eq!(of_one("m"), known);
        assert_eq!(of_one("m - t"), ["m: finite", "j: finite"]);
        let free = "#[gauss(chart = hybrid, mass = 3 - t)] struct Body { #[gauss(center_of_mass)] c: Vector3<f64>, \
                    #[gauss(inertia)] i: Matrix3<f64> }";
        assert_eq!(laws(free), ["c: finite", "i: finite"]);
    }

    #[test]
    fn bodies_that_move_together_are_checked_together() {
        let found = laws(
            "#[gauss(coordinates(a, b), body(one, rotation = rotation_z(a)), body(two, parent = one, \
                 position = [1, 0, 0], rotation = rotation_x(b), mass = m, inertia = [m, m, m]))] \
             struct Arms { #[gauss(body)] one: RigidBody<f64>, m: f64 }",
        );
        let one = ["one.mass: in sum", "one.center_of_mass: finite", "one.inertia: [AboutAxis(2)] [true, true]"];
        let two = ["m: finite", "two.mass: in sum", "two.inertia: [InSum] [true, false]"];
        assert_eq!(found, [one, two].concat());
    }
}
