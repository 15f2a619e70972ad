//! Springs: of joints, along sums of coordinates, and along cables through points.

use proc_macro2::Ident;
use quote::format_ident;
use syn::ext::IdentExt;

use super::clauses::Robot;
use crate::model::scene::elements::argument::{
    ALONG, AXES, BODY, DAMPING, FROM, LENGTH, REACTION, STIFFNESS, TO, VALUE,
};
use crate::model::scene::elements::{FORCE, SPRING, TORQUE};
use crate::model::scene::expression::{BinaryOperator, Expression, FunctionName, Property};
use crate::model::scene::forces::{ForceAxes, ForceClause};
use gauss_robots::description::{At, Cable, Joint, JointKind, Nonlinear, Note, Tendon};
use gauss_robots::rotation::{Rotation, Triple};

/// The square of the sine of an angle below which the angle is its sine, in double precision.
const SMALL: f64 = 1e-32;

/// A turn by an angle φ about a direction n: both are smooth where φ is zero, and φ is not.
pub struct SpringTurn {
    /// sin φ n.
    sines: [Expression; 3],
    pub cosine: Expression,
}

impl Robot<'_> {
    /// Springs of joints with one coordinate.
    pub fn springs(&self) -> Vec<ForceClause> {
        let writer = self.writer;
        let springs = self.scalar_joints().filter(|(_, joint, ..)| joint.stiffness > 0.0);
        let spring = |(index, joint, q, _): (usize, &Joint, &Ident, f64)| {
            let along = self.values(index, 0.0).into_iter().next()?;
            let stiffness = writer.number(joint.stiffness);
            let length = (joint.rest != 0.0).then(|| writer.number(joint.rest));
            let own = self.structure.coupling_of[index].joint == index;
            let name = own.then(|| format_ident!("{}_spring", q.unraw(), span = writer.span));
            let spring = ForceClause::new(&SPRING, name, writer.span).with(ALONG, Some(along));
            Some(spring.with(STIFFNESS, Some(stiffness)).with(LENGTH, length))
        };
        springs.filter_map(spring).collect()
    }

    /// Springs of joints whose coordinate is a rotation or a pose, as `mj_passive` of MuJoCo's
    /// `src/engine/engine_passive.c` has them: the force −k (r − r₀) at O, and the torque −k φ n, with the turn R₀ᵀR by
    /// the angle φ ≤ π about n.
    pub fn springs_of_turns(&self) -> (Vec<ForceClause>, Vec<Note>) {
        let writer = self.writer;
        let (mut forces, mut notes) = (Vec::new(), Vec::new());
        let name = |q: &Ident, end: &str| Some(format_ident!("{}_{}", q.unraw(), end, span = writer.span));
        for (joint, q) in self.groups().filter(|(joint, _)| joint.stiffness > 0.0) {
            let [body, reaction] = self.ends(joint);
            let is_free = joint.kind == JointKind::Floating;
            let (place, turn) = joint.start;
            if is_free {
                let start = writer.vector(place.map(|c| writer.number(c)));
                let way = ForceClause::new(&SPRING, name(q, "way_spring"), writer.span)
                    .with(FROM, Some(start))
                    .with(TO, Some(writer.property(q, Property::Position)));
                forces.push(way.with(STIFFNESS, Some(writer.number(joint.stiffness))));
            }
            let rotation = if is_free { writer.property(q, Property::Rotation) } else { writer.name(q) };
            let value = writer.times(writer.number(-joint.stiffness), self.rotation_vector(&rotation, &turn));
            let torque = ForceClause::new(&TORQUE, name(q, "spring"), writer.span)
                .with(BODY, body)
                .with(VALUE, Some(value))
                .with(REACTION, reaction);
            forces.push(torque);
            let text = format!(
                "the spring of `{}` turns as a torque: its energy is not in the potential energy; where the turn is half \
                 a revolution the torque jumps",
                joint.name
            );
            notes.push(Note::told(joint.at, text).about("turn"));
        }
        (forces, notes)
    }

    /// The link of a joint, and that which it hangs on, if this moves.
    pub fn ends(&self, joint: &Joint) -> [Option<Ident>; 2] {
        let index = |name: &String| self.description.links.iter().position(|link| link.name == *name);
        let parent = index(&joint.parent).filter(|&parent| self.moves(parent));
        [index(&joint.child), parent].map(|link| link.map(|link| self.links[link].clone()))
    }

    /// φ n of the turn R₀ᵀR, in the axes that it turns: φ from atan2 of its sine and cosine, so that it keeps its
    /// digits where it is small.
    pub fn rotation_vector(&self, rotation: &Expression, from: &Rotation) -> Expression {
        let writer = self.writer;
        let SpringTurn { sines, cosine } = self.turn(rotation, from);
        let [x, y, z] = sines.clone().map(|e| writer.times(e.clone(), e));
        let square = writer.plus(writer.plus(x, y), z);
        let square = writer.call(FunctionName::Max, vec![square, writer.number(SMALL)]);
        let sine = writer.call(FunctionName::Sqrt, vec![square]);
        let angle = writer.call(FunctionName::Atan2, vec![sine.clone(), cosine]);
        writer.times(writer.binary(BinaryOperator::Divide, angle, sine), writer.vector(sines))
    }

    /// Sines and cosine of the turn R₀ᵀR by the angle φ ≤ π about n.
    pub fn turn(&self, rotation: &Expression, from: &Rotation) -> SpringTurn {
        let writer = self.writer;
        let unit: [Triple; 3] = Rotation::none().matrix;
        let vector = |v: Triple| writer.vector(v.map(|c| writer.number(c)));
        let entry = |i: usize, j: usize| {
            let row = vector(std::array::from_fn(|k| from.matrix[k][i]));
            writer.call(FunctionName::Dot, vec![row, writer.times(rotation.clone(), vector(unit[j]))])
        };
        let half = |e: Expression| writer.times(writer.number(0.5), e);
        let minus = |a: Expression, b: Expression| writer.binary(BinaryOperator::Subtract, a, b);
        let sines = [0, 1, 2].map(|k| {
            let (i, j) = ((k + 1) % 3, (k + 2) % 3);
            half(minus(entry(j, i), entry(i, j)))
        });
        let trace = writer.plus(writer.plus(entry(0, 0), entry(1, 1)), entry(2, 2));
        let cosine = half(minus(trace, writer.number(1.0)));
        SpringTurn { sines, cosine }
    }

    pub fn tendons(&self) -> (Vec<ForceClause>, Vec<Note>) {
        let writer = self.writer;
        let (mut forces, mut notes) = (Vec::new(), Vec::new());
        let springs = |tendon: &&Tendon| tendon.stiffness > 0.0 || tendon.damping > 0.0;
        let acts = |tendon: &&Tendon| springs(tendon) || tendon.limits.is_some();
        let moves = |tendon: &&Tendon| !self.is_still(&tendon.along);
        for tendon in self.description.tendons.iter().filter(acts).filter(moves) {
            let Some(along) = self.length(&tendon.along) else {
                notes.push(Note::ignored(
                    tendon.at,
                    "tendon",
                    "a tendon along no joint with one coordinate does not act",
                ));
                continue;
            };
            if !springs(&tendon) {
                continue;
            }
            let number = |value: f64| (value != 0.0).then(|| writer.number(value));
            forces.push(if tendon.rest[0] == tendon.rest[1] {
                ForceClause::new(&SPRING, None, writer.span)
                    .with(ALONG, Some(along))
                    .with(STIFFNESS, Some(writer.number(tendon.stiffness)))
                    .with(LENGTH, number(tendon.rest[0]))
                    .with(DAMPING, number(tendon.damping))
            } else {
                ForceClause::drive(None, self.over_a_range(tendon, along), writer.span)
            });
        }
        (forces, notes)
    }

    /// The nonlinear forces of springs and dampers of joints and tendons.
    pub fn nonlinear_springs(&self) -> (Vec<ForceClause>, Vec<Note>) {
        let (mut rates, mut forces, mut notes) = (Vec::new(), Vec::new(), Vec::new());
        for (index, joint, q, multiplier) in self.scalar_joints() {
            let along = self.values(index, 0.0).into_iter().next();
            let Some(force) = along.and_then(|along| self.bent(joint.nonlinear, [joint.rest; 2], &along)) else {
                continue;
            };
            self.add_along(&mut rates, q, multiplier, &force);
            notes.extend(told_of_energy(joint.at, joint.nonlinear));
        }
        for tendon in &self.description.tendons {
            let along = self.length(&tendon.along).filter(|_| !self.is_still(&tendon.along));
            let Some(force) = along.and_then(|along| self.bent(tendon.nonlinear, tendon.rest, &along)) else {
                continue;
            };
            for (_, q, multiplier, factor) in self.ends_of(&tendon.along) {
                self.add_along(&mut rates, q, factor * multiplier, &force);
            }
            notes.extend(told_of_energy(tendon.at, tendon.nonlinear));
        }
        for cable in &self.description.cables {
            let Some(parts) = self.moving_parts(cable) else { continue };
            let rest = cable.rest.unwrap_or_else(|| [self.length_at_springs(&parts); 2]);
            let Some(tension) = self.bent(cable.nonlinear, rest, &self.length_of(&parts)) else { continue };
            forces.extend(self.pulls(&parts, &tension));
            notes.extend(told_of_energy(cable.at, cable.nonlinear));
        }
        if !rates.is_empty() {
            let name = Ident::new("joint_laws", self.writer.span);
            forces.push(ForceClause::drive(Some(name), rates, self.writer.span));
        }
        (forces, notes)
    }

    fn add_along(&self, rates: &mut Vec<(Ident, Expression)>, q: &Ident, factor: f64, force: &Expression) {
        let writer = self.writer;
        let part = if factor == 1.0 { force.clone() } else { writer.times(writer.number(factor), force.clone()) };
        match rates.iter_mut().find(|(name, _)| name == q) {
            Some((_, sum)) => *sum = writer.plus(sum.clone(), part),
            None => rates.push((q.clone(), part)),
        }
    }

    /// −(b x² + c x³) − (e v |v| + f v³) along a length, of its x beyond the nearest length without force and its rate
    /// v; `None` of nothing.
    fn bent(&self, law: Nonlinear, rest: [f64; 2], along: &Expression) -> Option<Expression> {
        let writer = self.writer;
        let x = self.beyond(rest, along);
        let v = writer.call(FunctionName::Rate, vec![along.clone()]);
        let product = |factors: Vec<Expression>| factors.into_iter().reduce(|a, b| writer.times(a, b));
        let size = writer.call(FunctionName::Abs, vec![v.clone()]);
        let terms = [
            (law.stiffness[0], vec![x.clone(), x.clone()]),
            (law.stiffness[1], vec![x.clone(), x.clone(), x]),
            (law.damping[0], vec![size, v.clone()]),
            (law.damping[1], vec![v.clone(), v.clone(), v]),
        ];
        let acting = terms.into_iter().filter(|(factor, _)| *factor != 0.0);
        let term = |(factor, powers): (f64, Vec<Expression>)| {
            product(powers).map(|power| writer.times(writer.number(-factor), power))
        };
        acting.filter_map(term).reduce(|a, b| writer.plus(a, b))
    }

    /// A length beyond the nearest of those without force.
    fn beyond(&self, rest: [f64; 2], along: &Expression) -> Expression {
        let writer = self.writer;
        let nearest = match rest {
            [0.0, 0.0] => return along.clone(),
            [least, most] if least == most => writer.number(least),
            _ => {
                let ends = [along.clone()].into_iter().chain(rest.map(|end| writer.number(end)));
                writer.call(FunctionName::Clamp, ends.collect())
            }
        };
        writer.binary(BinaryOperator::Subtract, along.clone(), nearest)
    }

    /// −k (l − l₀) − d l̇, with the l₀ of a range that is the nearest to l.
    fn beyond_a_range(&self, [stiffness, damping]: [f64; 2], rest: [f64; 2], along: Expression) -> Expression {
        let writer = self.writer;
        let force = writer.times(writer.number(-stiffness), self.beyond(rest, &along));
        if damping == 0.0 {
            return force;
        }
        let rate = writer.call(FunctionName::Rate, vec![along]);
        writer.plus(force, writer.times(writer.number(-damping), rate))
    }

    fn over_a_range(&self, tendon: &Tendon, along: Expression) -> Vec<(Ident, Expression)> {
        let force = self.beyond_a_range([tendon.stiffness, tendon.damping], tendon.rest, along);
        let mut rates: Vec<(Ident, Expression)> = Vec::new();
        for (_, q, multiplier, factor) in self.ends_of(&tendon.along) {
            self.add_along(&mut rates, q, factor * multiplier, &force);
        }
        rates
    }

    /// Along lengths between points: a potential where one length has no force, else forces on the points.
    pub fn cables(&self) -> Vec<ForceClause> {
        let writer = self.writer;
        let mut forces = Vec::new();
        for cable in self.description.cables.iter().filter(|cable| cable.stiffness > 0.0 || cable.damping > 0.0) {
            let Some(parts) = self.moving_parts(cable) else { continue };
            let rest = cable.rest.unwrap_or_else(|| [self.length_at_springs(&parts); 2]);
            if rest[0] != rest[1] {
                let laws = [cable.stiffness, cable.damping];
                forces.extend(self.pulls(&parts, &self.beyond_a_range(laws, rest, self.length_of(&parts))));
                continue;
            }
            let spring = ForceClause::new(&SPRING, None, writer.span);
            let spring = match parts.as_slice() {
                [([a, b], 1.0)] => spring.with(FROM, Some(self.point(*a))).with(TO, Some(self.point(*b))),
                parts => spring.with(ALONG, Some(self.length_of(parts))),
            };
            let number = |value: f64| (value != 0.0).then(|| writer.number(value));
            let spring = spring.with(STIFFNESS, Some(writer.number(cable.stiffness)));
            forces.push(spring.with(LENGTH, number(rest[0])).with(DAMPING, number(cable.damping)));
        }
        forces
    }

    /// The links between which a cable runs, with their factors; `None` where its length stays.
    pub fn moving_parts(&self, cable: &Cable) -> Option<Vec<([usize; 2], f64)>> {
        let index = |name: &String| self.description.links.iter().position(|link| link.name == *name);
        let part = |(ends, factor): &([String; 2], f64)| Some(([index(&ends[0])?, index(&ends[1])?], *factor));
        let parts: Vec<_> = cable.parts.iter().map(part).collect::<Option<_>>()?;
        let owner = |link: usize| self.structure.owner_of[link];
        parts.iter().any(|([a, b], _): &([usize; 2], f64)| owner(*a) != owner(*b)).then_some(parts)
    }

    fn point(&self, link: usize) -> Expression {
        self.writer.property(&self.links[link], Property::Position)
    }

    /// From the first end to the second, and its length.
    fn arm(&self, [a, b]: [usize; 2]) -> [Expression; 2] {
        let arm = self.writer.binary(BinaryOperator::Subtract, self.point(b), self.point(a));
        let square = self.writer.call(FunctionName::Dot, vec![arm.clone(), arm.clone()]);
        [arm, self.writer.call(FunctionName::Sqrt, vec![square])]
    }

    pub fn length_of(&self, parts: &[([usize; 2], f64)]) -> Expression {
        let writer = self.writer;
        let terms = parts.iter().map(|(ends, factor)| {
            let [_, length] = self.arm(*ends);
            if *factor == 1.0 { length } else { writer.times(writer.number(*factor), length) }
        });
        terms.reduce(|a, b| writer.plus(a, b)).unwrap_or_else(|| writer.number(0.0))
    }

    /// A force along a length, along each part on its ends.
    fn pulls(&self, parts: &[([usize; 2], f64)], tension: &Expression) -> Vec<ForceClause> {
        let writer = self.writer;
        let mut forces = Vec::new();
        for (ends, factor) in parts {
            let [arm, length] = self.arm(*ends);
            let direction = writer.times(writer.binary(BinaryOperator::Divide, writer.number(*factor), length), arm);
            for (link, sign) in ends.iter().zip([-1.0, 1.0]).filter(|(link, _)| self.moves(**link)) {
                let value = writer.times(writer.times(writer.number(sign), tension.clone()), direction.clone());
                let body = self.links[*link].clone();
                let force = ForceClause::new(&FORCE, None, writer.span).with(VALUE, Some(value));
                forces.push(force.with(BODY, Some(body)).with(AXES, Some(ForceAxes::Observer)));
            }
        }
        forces
    }

    /// The length while all joints are where their springs have no force.
    fn length_at_springs(&self, parts: &[([usize; 2], f64)]) -> f64 {
        let place = |link: usize| self.structure.at_springs(self.description, link).0;
        let distance = |[a, b]: [usize; 2]| {
            let (a, b) = (place(a), place(b));
            (0..3).map(|i| (b[i] - a[i]).powi(2)).sum::<f64>().sqrt()
        };
        parts.iter().map(|(ends, factor)| factor * distance(*ends)).sum()
    }
}

/// A note that the work of a spring is left out of the energy.
fn told_of_energy(at: At, law: Nonlinear) -> Option<Note> {
    let text = "a spring that is not linear acts as a force: its energy is not in the potential energy";
    (law.stiffness != [0.0; 2]).then(|| Note::told(at, text).about("springs"))
}
