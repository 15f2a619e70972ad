//! States of a scene that reach what makes digits cancel: numbers of many sizes, both sides of differences close to
//! each other, angles near quarter turns and far outside, bodies far from Ω, fast spins. All are physical, and the same
//! in every run.

use crate::algebra::{Evaluation, Expr, Function, Map, NodeView, Rational};
use crate::mechanics::{Action, Body, Coordinate, Force, Matter, System};
use crate::terms::Role;

use super::random::Random;
use super::trial::Point;

/// Symbols and formulas that the states of a scene are made from.
pub struct States<'a, 'g> {
    pub system: &'a System<'g>,
    /// p as a function of (t, q, z).
    pub momentum: &'a [Expr<'g>],
    /// The numbers of fields, and which of them are components of something, of either sign.
    pub parameters: Vec<(Expr<'g>, bool)>,
    /// Symbols that stand for numbers.
    pub literals: Vec<(Rational, Expr<'g>)>,
    /// Symbols that are scaled to have the norm 1, list by list.
    pub units: &'a [Vec<Expr<'g>>],
    /// Weights with which second derivatives are summed.
    pub weights: &'a [Expr<'g>],
    /// Symbols that stand for expressions of others.
    pub definitions: &'a Map<u32, Expr<'g>>,
    pub numbers: SymbolNumbers,
}

/// Settings for the choice of a state.
pub(super) struct Profile {
    /// Powers of ten up and down from one that a number can be apart from it.
    pub decades: f64,
    /// The share of differences whose sides are brought together, and the powers of ten that are left at least.
    near: f64,
    closest: f64,
    /// The share of angles that are near a multiple of a quarter turn.
    quarters: f64,
    /// Powers of ten by which bodies are farther from Ω than they are large.
    far: f64,
    /// Powers of ten by which everything is slower; lengths are as many smaller, twice: near where a scene is at rest,
    /// which is most often where it is written from.
    slow: f64,
}

/// From the ordinary to the extreme; few are enough, because each puts every number on its own.
pub(super) const PROFILES: [Profile; 6] = [
    Profile { decades: 0.5, near: 0.0, closest: 0.0, quarters: 0.0, far: 0.0, slow: 0.0 },
    Profile { decades: 1.5, near: 1.0, closest: 3.0, quarters: 0.3, far: 2.0, slow: 0.0 },
    Profile { decades: 3.0, near: 0.3, closest: 6.0, quarters: 0.3, far: 0.0, slow: 0.0 },
    Profile { decades: 0.5, near: 0.7, closest: 5.0, quarters: 0.7, far: 6.0, slow: 0.0 },
    Profile { decades: 0.3, near: 0.0, closest: 0.0, quarters: 0.0, far: 6.5, slow: 3.0 },
    Profile { decades: 2.0, near: 0.9, closest: 4.0, quarters: 0.5, far: 3.0, slow: 0.0 },
];

/// Sample states, with what the scene is written with.
pub struct Samples<'s, 'a, 'g> {
    pub(super) states: &'s States<'a, 'g>,
    pub(super) seen: SceneTerms<'g>,
    pub(super) values: Vec<Values<'s>>,
}

impl Samples<'_, '_, '_> {
    /// The states as programs are tried there.
    pub fn points(&self) -> Vec<Point> {
        self.values.iter().map(|values| self.states.point(values)).collect()
    }
}

/// Symbols and their values, in the order in which they are chosen, with their numbers.
#[derive(Clone)]
pub(super) struct Values<'n> {
    list: Vec<(u32, u64)>,
    pub map: Map<u32, f64>,
    numbers: &'n SymbolNumbers,
}

impl Values<'_> {
    pub fn put(&mut self, symbol: Expr<'_>, value: f64) {
        if self.map.insert(symbol.key(), value).is_none() {
            self.list.push((symbol.key(), self.numbers.of(symbol)));
        }
    }

    pub fn of(&self, e: Expr<'_>) -> f64 {
        Evaluation::new(&self.map).value(e)
    }

    /// Choices for a symbol that depend on its number alone, so that what else a scene has does not change them.
    pub fn random_of(&self, symbol: Expr<'_>, seed: u64) -> Random {
        Random::new(self.numbers.of(symbol).wrapping_add(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15)))
    }
}

impl<'g> States<'_, 'g> {
    /// States with a number for each symbol.
    #[must_use]
    pub fn numbered(mut self) -> Self {
        let scene = &self.system.scene;
        let position = |coordinate: &Coordinate<'g>| match coordinate {
            Coordinate::Scalar(q) => vec![*q],
            Coordinate::Rotation(_) => Vec::new(),
            Coordinate::Pose(_, position) => position.to_vec(),
            Coordinate::Plane { position, .. } => position.to_vec(),
        };
        let halves = self.system.halves();
        let lists: [Vec<Expr<'g>>; 13] = [
            vec![scene.time],
            self.parameters.iter().map(|(symbol, _)| *symbol).collect(),
            self.literals.iter().map(|(_, symbol)| *symbol).collect(),
            scene.coordinates.iter().flat_map(position).collect(),
            self.units.concat(),
            scene.speeds.clone(),
            self.system.twist().to_vec(),
            scene.speed_rates.clone(),
            scene.inputs.clone(),
            self.system.constraints.residuals.clone(),
            self.weights.to_vec(),
            halves.into_iter().flat_map(|halves| halves.symbols.iter().chain(&halves.impulses)).copied().collect(),
            scene.momenta.clone(),
        ];
        (1..).zip(lists).for_each(|(role, list)| self.numbers.give(role, list));
        self
    }

    /// As many as are worth their time.
    pub fn samples(&self) -> Samples<'_, '_, 'g> {
        let seen = SceneTerms::of(self.system);
        let values = PROFILES.iter().enumerate().map(|(k, profile)| self.values(&seen, profile, k as u64)).collect();
        Samples { states: self, seen, values }
    }

    fn values(&self, seen: &SceneTerms<'g>, profile: &Profile, seed: u64) -> Values<'_> {
        let mut values = Values { list: Vec::new(), map: Map::default(), numbers: &self.numbers };
        self.give_parameters(&mut values, profile, seed);
        self.give_motion(&mut values, seen, profile, seed);
        self.define(&mut values);
        self.give_masses(&mut values, profile, seed);
        for (k, difference) in seen.differences.iter().enumerate() {
            let mut random = Random::new(seed ^ ((k as u64 + 1) << 32));
            if random.fraction() < profile.near {
                self.bring_together(difference, &mut values, &mut random, profile);
            }
        }
        // What was chosen for a difference must not undo the masses.
        self.give_masses(&mut values, profile, seed);
        self.finish(&mut values);
        values
    }

    /// Computes the values that follow from numbers that are given: those of definitions, and p.
    pub(super) fn finish(&self, values: &mut Values<'_>) {
        self.define(values);
        let momenta: Vec<f64> = self.momentum.iter().map(|e| values.of(*e)).collect();
        self.system.scene.momenta.iter().zip(momenta).for_each(|(p, value)| values.put(*p, value));
    }

    /// A state as programs are tried there.
    pub(super) fn point(&self, values: &Values<'_>) -> Point {
        let list: Vec<_> = values.list.iter().map(|&(key, name)| (key, name, values.map[&key])).collect();
        Point::new(&list, self.units, self.definitions)
    }

    fn give_parameters(&self, values: &mut Values<'_>, profile: &Profile, seed: u64) {
        for &(symbol, component) in &self.parameters {
            let mut random = values.random_of(symbol, seed);
            let size = random.size(profile.decades);
            values.put(symbol, if component { random.sign() * size } else { size });
        }
        for (value, symbol) in &self.literals {
            values.put(*symbol, value.to_f64());
        }
    }

    /// Time, configuration, speeds and what else is handed over.
    fn give_motion(&self, values: &mut Values<'_>, seen: &SceneTerms<'g>, profile: &Profile, seed: u64) {
        let scene = &self.system.scene;
        values.put(scene.time, values.random_of(scene.time, seed).size(profile.decades));
        for symbol in self.units.iter().flatten() {
            let mut random = values.random_of(*symbol, seed);
            values.put(*symbol, random.sign() * (0.1 + random.fraction()));
        }
        for coordinate in &scene.coordinates {
            let position: &[Expr<'g>] = match coordinate {
                Coordinate::Scalar(q) if seen.angles.contains(&q.key()) => {
                    values.put(*q, angle(&mut values.random_of(*q, seed), profile));
                    &[]
                }
                Coordinate::Scalar(q) => {
                    let near = 10.0_f64.powf(-2.0 * profile.slow);
                    values.put(*q, values.random_of(*q, seed).signed(profile.decades) * near);
                    &[]
                }
                Coordinate::Rotation(_) => &[],
                Coordinate::Pose(_, position) => position,
                Coordinate::Plane { position, .. } => position,
            };
            for b in position {
                let mut random = values.random_of(*b, seed);
                values.put(*b, random.signed(profile.decades) * 10.0_f64.powf(profile.far));
            }
        }
        let twist = self.system.twist();
        let residuals = &self.system.constraints.residuals;
        let of_contacts = self.system.halves().map(|halves| [&halves.symbols[..], &halves.impulses]);
        let given = [&scene.speed_rates[..], &scene.inputs, residuals, self.weights];
        for symbol in given.into_iter().chain(of_contacts.into_iter().flatten()).flatten() {
            values.put(*symbol, values.random_of(*symbol, seed).signed(profile.decades));
        }
        for symbol in scene.speeds.iter().chain(twist) {
            let mut random = values.random_of(*symbol, seed);
            values.put(*symbol, random.signed(profile.decades) * 10.0_f64.powf(-profile.slow));
        }
    }

    fn give_masses(&self, values: &mut Values<'_>, profile: &Profile, seed: u64) {
        self.bodies().for_each(|body| self.give_mass(body, values, seed ^ 1 << 50, profile.decades));
    }

    /// Bodies with fields of their own.
    pub(super) fn bodies(&self) -> impl Iterator<Item = &Body<'g>> {
        let bodies = self.system.scene.tree.links.iter().filter_map(|link| link.body());
        bodies.filter(|body| !body.parameters.is_empty())
    }

    /// Scales units, and computes what stands for expressions of the others.
    pub(super) fn define(&self, values: &mut Values) {
        for unit in self.units {
            let norm = unit.iter().map(|symbol| values.map[&symbol.key()].powi(2)).sum::<f64>().sqrt();
            unit.iter().for_each(|symbol| values.put(*symbol, values.map[&symbol.key()] / norm));
        }
        let defined: Vec<(u32, f64)> = {
            let mut evaluation = Evaluation::new(&values.map);
            self.definitions.iter().map(|(&key, e)| (key, evaluation.value(*e))).collect()
        };
        values.map.extend(defined);
    }

    /// Moments of inertia that a body can have, about O; added mass that is positive definite.
    pub(super) fn give_mass(&self, body: &Body<'g>, values: &mut Values<'_>, seed: u64, decades: f64) {
        let Some(first) = body.parameters.first() else { return };
        let random = &mut values.random_of(first.symbol, seed);
        let of = |role: Role| -> Vec<Expr<'g>> {
            body.parameters.iter().filter(|p| p.quantity == role).map(|p| p.symbol).collect()
        };
        let second: [f64; 3] = std::array::from_fn(|_| random.size(decades));
        let principal: [f64; 3] = std::array::from_fn(|i| second[(i + 1) % 3] + second[(i + 2) % 3]);
        let central = of(Role::CentralInertia);
        if central.is_empty() {
            let (mass, c) = (values.of(body.mass), body.center_of_mass.map(|e| values.of(e)));
            put_inertia(values, &of(Role::Inertia), principal, mass, c);
        } else {
            put_inertia(values, &central, principal, 0.0, [0.0; 3]);
        }
        let added = of(Role::AddedMass);
        let sizes: [f64; 6] = std::array::from_fn(|_| random.size(decades));
        match added.len() {
            0 => {}
            6 => (0..6).for_each(|i| values.put(added[i], sizes[i])),
            _ => {
                let pairs = (0..6).flat_map(|i| (i..6).map(move |j| (i, j)));
                for ((i, j), symbol) in pairs.zip(&added) {
                    let coupled = 0.15 * random.sign() * random.fraction() * (sizes[i] * sizes[j]).sqrt();
                    values.put(*symbol, if i == j { sizes[i] } else { coupled });
                }
            }
        }
    }
}

impl<'g> States<'_, 'g> {
    /// Makes the terms of a sum cancel but for a small part, by one of its symbols: as they are, or with what else is
    /// in it far away.
    fn bring_together(
        &self,
        difference: &[(Rational, Expr<'g>)],
        values: &mut Values<'_>,
        random: &mut Random,
        profile: &Profile,
    ) {
        let free = |values: &Values<'_>, e: Expr<'g>| {
            let literal = self.literals.iter().any(|(_, symbol)| *symbol == e);
            let unit = self.units.iter().flatten().any(|symbol| *symbol == e);
            let given = values.map.contains_key(&e.key()) && !self.definitions.contains_key(&e.key());
            matches!(e.view(), NodeView::Symbol(_)) && given && !literal && !unit
        };
        let parameter = |e: Expr<'g>| self.parameters.iter().find(|(own, _)| *own == e);
        let mut symbols: Vec<(Rational, Expr<'g>)> =
            difference.iter().copied().filter(|(_, e)| free(values, *e)).collect();
        let far = random.below(2) == 0;
        if far && symbols.iter().any(|(_, e)| parameter(*e).is_none()) {
            for (_, e) in symbols.iter().filter(|(_, e)| parameter(*e).is_some()) {
                values.put(*e, values.map[&e.key()] * random.size(1.0) * 1e3);
            }
            symbols.retain(|(_, e)| parameter(*e).is_none());
        }
        if symbols.is_empty() {
            return;
        }
        let (coefficient, symbol) = symbols[random.below(symbols.len())];
        let others = difference.iter().filter(|(_, e)| *e != symbol);
        let rest: f64 = others.map(|(c, e)| c.to_f64() * values.of(*e)).sum();
        let left = if far {
            random.signed(0.5)
        } else {
            -rest * random.sign() * 10.0_f64.powf(-1.0 - random.fraction() * (profile.closest - 1.0).max(0.0))
        };
        let value = (left - rest) / coefficient.to_f64();
        let allowed = parameter(symbol).is_none_or(|(_, component)| *component || value > 0.0);
        if value.is_finite() && value != 0.0 && allowed {
            values.put(symbol, value);
        }
    }
}

/// The inertia of a body about O, from its principal moments about G.
fn put_inertia(values: &mut Values<'_>, symbols: &[Expr<'_>], principal: [f64; 3], mass: f64, c: [f64; 3]) {
    let square: f64 = c.iter().map(|c| c * c).sum();
    match symbols {
        [] => {}
        [only] => values.put(*only, principal[0] + 2.0 * mass * square),
        diagonal @ [_, _, _] => {
            // Without products of inertia the mass centre is off O only as far as the rest makes up for it.
            (0..3).for_each(|i| values.put(diagonal[i], principal[i] + 2.0 * mass * square));
        }
        whole => {
            let pairs = (0..3).flat_map(|i| (i..3).map(move |j| (i, j)));
            for ((i, j), symbol) in pairs.zip(whole) {
                let own = if i == j { principal[i] + mass * square } else { 0.0 };
                values.put(*symbol, own - mass * c[i] * c[j]);
            }
        }
    }
}

/// Angles and sums of a scene as it is written.
#[derive(Default)]
pub(super) struct SceneTerms<'g> {
    done: Map<u32, ()>,
    /// Symbols that are part of an angle.
    pub angles: Vec<u32>,
    /// Sums, and those of them that have a symbol.
    pub sums: Vec<Vec<(Rational, Expr<'g>)>>,
    differences: Vec<Vec<(Rational, Expr<'g>)>>,
    /// Number of them that is enough.
    room: usize,
}

impl<'g> SceneTerms<'g> {
    fn of(system: &System<'g>) -> Self {
        let scene = &system.scene;
        let mut seen = Self { room: usize::MAX, ..Self::default() };
        for link in &scene.tree.links {
            seen.look(
                link.own_joint
                    .offset
                    .iter()
                    .chain(link.own_joint.turns.iter().flat_map(|turn| turn.matrix.iter().flatten())),
            );
            match &link.matter {
                Matter::Body(body) => {
                    seen.look(body.inertia.iter().flatten().chain(&body.center_of_mass).chain([&body.mass]))
                }
                Matter::Particle(mass) => seen.look([mass]),
                Matter::Nothing => {}
            }
        }
        seen.look(scene.constraints.iter().map(|constraint| &constraint.value));
        seen.look(&scene.kinematics);
        for element in &scene.elements {
            match &element.action {
                Action::Potential(potential) => seen.look([potential]),
                Action::Field(field) => seen.look([&field.potential]),
                Action::Forces(forces) => forces.iter().for_each(|force| match force {
                    Force::AtPoint { at, force } => seen.look(at.iter().chain(force)),
                    Force::OnLink { at, force, torque, .. } => seen.look(at.iter().chain(force).chain(torque)),
                    Force::Between { torque, .. } => seen.look(torque),
                    Force::OnRate { rate, force } => seen.look([rate, force]),
                    Force::Dissipation(function) => seen.look([function]),
                }),
            }
        }
        seen
    }

    pub fn look<'a>(&mut self, expressions: impl IntoIterator<Item = &'a Expr<'g>>)
    where
        'g: 'a,
    {
        expressions.into_iter().for_each(|e| self.visit(*e));
    }

    /// The sums in some expressions, up to so many.
    pub fn sums_in(expressions: &[Expr<'g>], most: usize) -> Vec<Vec<(Rational, Expr<'g>)>> {
        let mut seen = Self { room: most, ..Self::default() };
        seen.look(expressions);
        seen.sums
    }

    fn visit(&mut self, e: Expr<'g>) {
        if self.sums.len() == self.room || self.done.insert(e.key(), ()).is_some() {
            return;
        }
        match e.view() {
            NodeView::Number(_) | NodeView::Symbol(_) => {}
            NodeView::Sum(terms) => {
                terms.iter().for_each(|(_, term)| self.visit(*term));
                let cancels =
                    terms.len() > 1 && terms.iter().any(|(_, term)| matches!(term.view(), NodeView::Symbol(_)));
                if cancels {
                    self.differences.push(terms.clone());
                }
                self.sums.push(terms);
            }
            NodeView::Product(factors) => factors.iter().for_each(|(factor, _)| self.visit(*factor)),
            NodeView::Call(function, inner) => {
                if matches!(function, Function::Sin | Function::Cos) {
                    self.angle(inner);
                }
                self.visit(inner);
            }
            NodeView::Binary(_, a, b) => [a, b].into_iter().for_each(|e| self.visit(e)),
            NodeView::Own(_, arguments) => arguments.into_iter().for_each(|e| self.visit(e)),
            NodeView::Group(inner) | NodeView::Opaque(inner) => self.visit(inner),
        }
    }

    fn angle(&mut self, e: Expr<'g>) {
        match e.view() {
            NodeView::Symbol(_) => self.angles.push(e.key()),
            NodeView::Sum(terms) => {
                terms
                    .iter()
                    .filter(|(_, e)| matches!(e.view(), NodeView::Symbol(_)))
                    .for_each(|(_, e)| self.angles.push(e.key()));
            }
            NodeView::Group(inner) => self.angle(inner),
            _ => {}
        }
    }
}

/// A number for each symbol that is given: what it is for, and its place among those that are for the same. All choices
/// depend on it, never on a name, which says nothing of the motion.
#[derive(Default)]
pub struct SymbolNumbers(Map<u32, u64>);

impl SymbolNumbers {
    fn give<'g>(&mut self, role: u64, symbols: impl IntoIterator<Item = Expr<'g>>) {
        for (place, symbol) in (0..).zip(symbols) {
            // What is for several things keeps its first number.
            self.0.or_insert_with(symbol.key(), || role << 32 | place);
        }
    }

    fn of(&self, symbol: Expr<'_>) -> u64 {
        self.0.get(&symbol.key()).copied().unwrap_or_default()
    }
}

/// An angle: ordinary, near a multiple of a quarter turn, or far outside.
fn angle(random: &mut Random, profile: &Profile) -> f64 {
    let turns = random.below(4) as f64 - 1.0;
    let near = turns * std::f64::consts::FRAC_PI_2 + random.sign() * 10.0_f64.powf(-1.0 - 5.0 * random.fraction());
    match random.fraction() {
        share if share < profile.quarters => near,
        share if share > 0.9 => random.signed(3.0),
        _ => random.sign() * 3.0 * random.fraction(),
    }
}
