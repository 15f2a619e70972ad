//! Moves from one state to another at which digits cancel: sizes, angles, sums near zero, moments of inertia.

use crate::algebra::{Expr, Map, NodeView, Notation, Rational, print, print_short};
use crate::mechanics::{Coordinate, Matter};
use crate::terms::Role;

use super::random::Random;
use super::states::{SceneTerms, States, Values};

/// Powers of ten that numbers of fields, speeds and forces are apart from one, and those of coordinates.
const SIZES: [f64; 2] = [-4.5, 4.5];
const PLACES: [f64; 2] = [-9.0, 7.0];
const ANGLES: [f64; 2] = [-9.0, 3.0];
/// Least size to which a sum is brought near zero, as a power of ten of its terms.
const CLOSEST: f64 = -9.0;
/// Sums that are brought near zero together: the components of a vector.
const TOGETHER: usize = 3;
/// Characters up to which a sum is printed as it is.
const SHORT: usize = 40;
/// Sums in momenta that are brought near zero, and symbols by which a sum is.
const RATES: usize = 32;
const SYMBOLS: usize = 8;
/// Distance of the angle of a spin from quarter turns, as powers of ten, and how many of them it is: others give the
/// same sums, but for signs. Sums are near zero by the square of that, of which double precision still has four digits.
const LEANING: [f64; 2] = [-6.0, -3.0];
const QUARTERS: [f64; 2] = [0.0, 1.0];
/// Power of ten by which places are smaller than those that they are added to.
const APART: f64 = -9.0;
/// Powers of ten by which all coordinates are smaller together.
const SMALLER: [f64; 4] = [-8.0, -6.0, -4.0, -2.0];
/// Powers of ten by which each mass and each length between joints is larger than the one before, and how far they are
/// apart from one at most: along chains in both directions, alone and together.
const GRADED: [[f64; 2]; 12] = [
    [2.0, 0.0],
    [-2.0, 0.0],
    [6.0, 0.0],
    [-6.0, 0.0],
    [0.0, 2.0],
    [0.0, -2.0],
    [0.0, 6.0],
    [0.0, -6.0],
    [3.0, -1.5],
    [-3.0, 1.5],
    [2.0, 2.0],
    [-2.0, -2.0],
];
const MOST_GRADED: f64 = 9.0;
/// Steps of the secant method: one is enough for what is linear.
const SECANTS: usize = 6;

/// One state, with the seeds and the spread of the moments of inertia of its bodies.
#[derive(Clone)]
pub struct Draft<'n> {
    pub values: Values<'n>,
    pub masses: Vec<(u64, f64)>,
    /// Moves that made it from a sample state, and the number of that.
    pub moves: Vec<Move>,
    pub sample: usize,
}

/// A change of a state. Closeness is a power of ten.
#[derive(Clone, Copy)]
pub enum Move {
    /// A number is so many powers of ten larger.
    Scale(usize, f64),
    /// An angle is near that many quarter turns.
    Quarter(usize, f64, f64),
    /// A sum is near zero, by one of its symbols.
    Near(usize, usize, f64),
    /// Three sums in a row are near zero, each by any of its symbols.
    AllNear(usize, usize, f64),
    /// The moments of inertia of a body are drawn anew.
    Body(usize, u64),
    /// All speeds are so many powers of ten larger.
    Faster(f64),
    /// All coordinates are so many powers of ten smaller.
    Smaller(f64),
    /// The first or the last of two places or more that are added is small, in all such sums: bodies near each other
    /// and far away.
    Apart(usize),
    /// The masses of links in a row, and the lengths between them, grow by so many powers of ten from one to the next.
    Graded([f64; 2]),
    /// An angle is near that many quarter turns, and a sum of fast rates that depends on it near zero: a wheel that
    /// spins nearly flat has an energy that is small beside the terms of which it is the sum.
    Spin(usize, f64, f64),
}

impl Move {
    /// The same again, or closer.
    pub fn further(self) -> Self {
        match self {
            Self::Quarter(k, turns, closeness) => Self::Quarter(k, turns, (closeness - 3.0).max(CLOSEST)),
            Self::Near(k, symbol, closeness) => Self::Near(k, symbol, (closeness - 3.0).max(CLOSEST)),
            Self::AllNear(k, seed, closeness) => Self::AllNear(k, seed, (closeness - 3.0).max(CLOSEST)),
            Self::Body(k, seed) => Self::Body(k, seed + 1),
            other => other,
        }
    }
}

/// A number that may be moved.
struct Free<'g> {
    symbol: Expr<'g>,
    parameter: bool,
    angle: bool,
    positive: bool,
    /// The body whose moments of inertia depend on it.
    body: Option<usize>,
    /// Powers of ten.
    range: [f64; 2],
}

/// A sum that may be brought near zero, by these of the free numbers.
struct FreeSum<'g> {
    terms: Vec<(Rational, Expr<'g>)>,
    by: Vec<usize>,
}

impl FreeSum<'_> {
    fn printed(&self) -> String {
        let term = |(c, e): &(Rational, Expr<'_>)| print_short(e.scale(*c), Notation::Text, SHORT as u64);
        let terms: Option<Vec<String>> = self.terms.iter().map(term).collect();
        let printed = terms.map(|terms| terms.join(" + ").replace("+ -", "- "));
        printed.filter(|printed| printed.chars().count() <= SHORT).unwrap_or_else(|| "a sum".to_owned())
    }
}

/// An angle, and a sum of rates that depends on it and is brought near zero by one of them.
struct Spin {
    angle: usize,
    sum: usize,
    by: usize,
}

/// Everything that can be moved in a scene.
pub struct Moves<'s, 'a, 'g> {
    states: &'s States<'a, 'g>,
    free: Vec<Free<'g>>,
    angles: Vec<usize>,
    scalars: Vec<usize>,
    speeds: Vec<usize>,
    /// The first and the last of places that are added.
    apart: [Vec<usize>; 2],
    /// Fields that are masses, and those that are lengths between links, from the roots on.
    graded: [Vec<usize>; 2],
    sums: Vec<FreeSum<'g>>,
    spins: Vec<Spin>,
    bodies: usize,
}

impl<'s, 'a, 'g> Moves<'s, 'a, 'g> {
    /// The moves of a scene, with those of its fields that are read: others change nothing.
    pub fn new(states: &'s States<'a, 'g>, seen: &SceneTerms<'g>, is_read: impl Fn(Expr<'g>) -> bool) -> Self {
        let mut free = free(states, seen);
        free.retain(|free| !free.parameter || is_read(free.symbol));
        let places: Map<u32, usize> = free.iter().enumerate().map(|(k, free)| (free.symbol.key(), k)).collect();
        // Momenta cancel where rates do.
        let rates = SceneTerms::sums_in(states.momentum, RATES);
        let sums = seen.sums.iter().chain(&rates).map(|terms| {
            let mut by = Vec::new();
            let mut done = Map::default();
            terms.iter().for_each(|(_, e)| symbols_of(*e, &places, &mut done, &mut by));
            by.sort_unstable();
            FreeSum { terms: terms.clone(), by }
        });
        let sums: Vec<FreeSum<'g>> = sums.filter(|sum| !sum.by.is_empty()).collect();
        let angles: Vec<usize> = (0..free.len()).filter(|&k| free[k].angle).collect();
        let scene = &states.system.scene;
        let speeds: Vec<usize> = scene.speeds.iter().map(|z| places[&z.key()]).collect();
        let scalar = |coordinate: &Coordinate<'g>| match coordinate {
            Coordinate::Scalar(q) => Some(places[&q.key()]),
            _ => None,
        };
        let scalars = scene.coordinates.iter().filter_map(scalar).collect();
        let spins = spins(&sums, &angles, &speeds);
        let apart = apart(&seen.sums, &places, &free);
        let graded = graded(states, &places, &free);
        Self { states, free, angles, scalars, speeds, apart, graded, sums, spins, bodies: states.bodies().count() }
    }

    #[cfg(test)]
    pub fn symbols(&self) -> impl Iterator<Item = Expr<'g>> {
        self.free.iter().map(|free| free.symbol)
    }

    /// Whether there is nothing to move.
    pub fn are_none(&self) -> bool {
        self.free.is_empty()
    }

    pub fn any(&self, random: &mut Random) -> Move {
        let closeness = -1.0 - 7.0 * random.fraction();
        match random.below(8) {
            0 | 1 if !self.angles.is_empty() => {
                Move::Quarter(self.angles[random.below(self.angles.len())], random.below(4) as f64 - 1.0, closeness)
            }
            2 | 3 if !self.sums.is_empty() => {
                let sum = random.below(self.sums.len());
                let by = &self.sums[sum].by;
                Move::Near(sum, by[random.below(by.len())], closeness)
            }
            4 if !self.sums.is_empty() => {
                Move::AllNear(random.below(self.sums.len()), random.below(1 << 20), closeness)
            }
            5 if self.bodies > 0 => Move::Body(random.below(self.bodies), random.below(1 << 30) as u64),
            6 => Move::Faster(random.sign() * 3.0),
            _ => {
                let decades = [1.0, 2.0, 4.0, 8.0][random.below(4)];
                Move::Scale(random.below(self.free.len()), random.sign() * decades)
            }
        }
    }

    /// Changes of several numbers at once, each of which alone makes nothing cancel; the closest first.
    pub fn of_many(&self) -> impl Iterator<Item = Move> {
        let smaller = SMALLER.into_iter().filter(|_| !self.scalars.is_empty()).map(Move::Smaller);
        let leaning = LEANING.into_iter().flat_map(|closeness| QUARTERS.map(|turns| (turns, closeness)));
        let spin = |(turns, closeness)| (0..self.spins.len()).map(move |k| Move::Spin(k, turns, closeness));
        let apart = [1, 0].into_iter().filter(|&k| !self.apart[k].is_empty()).map(Move::Apart);
        let there = |decades: &[f64; 2]| (0..2).all(|k| decades[k] == 0.0 || self.graded[k].len() > 1);
        let unlike = GRADED.into_iter().filter(there).map(Move::Graded);
        unlike.chain(smaller).chain(apart).chain(leaning.flat_map(spin))
    }

    /// Whether it is a change of what moves alone: a run may come by such a state whatever its parameters are.
    pub fn is_of_motion(&self, change: &Move) -> bool {
        let moving = |k: usize| !self.free[k].parameter;
        match *change {
            Move::Scale(k, _) | Move::Quarter(k, ..) | Move::Near(_, k, _) => moving(k),
            Move::AllNear(sum, seed, _) => self.together(sum, seed).all(|(_, by)| moving(by)),
            Move::Body(..) | Move::Graded(..) => false,
            Move::Faster(_) | Move::Smaller(_) | Move::Apart(_) | Move::Spin(..) => true,
        }
    }

    /// The sums of [`Move::AllNear`], each with the number that is moved.
    fn together(&self, sum: usize, seed: usize) -> impl Iterator<Item = (&FreeSum<'g>, usize)> {
        self.sums.iter().skip(sum).take(TOGETHER).map(move |sum| (sum, sum.by[seed % sum.by.len()]))
    }

    /// Description of a sample state after moves, in words.
    pub fn described(&self, moves: &[Move]) -> Vec<String> {
        let name = |k: usize| print(self.free[k].symbol, Notation::Text);
        let mut words: Vec<String> = Vec::new();
        for change in moves {
            let word = match *change {
                Move::Scale(k, decades) if decades > 0.0 => format!("large {}", name(k)),
                Move::Scale(k, _) => format!("small {}", name(k)),
                Move::Quarter(k, 0.0, _) => format!("small {}", name(k)),
                Move::Quarter(k, ..) => format!("{} near quarter turns", name(k)),
                Move::Near(sum, ..) => format!("{} near 0", self.sums[sum].printed()),
                Move::AllNear(sum, ..) => {
                    let sums: Vec<String> = self.sums.iter().skip(sum).take(TOGETHER).map(FreeSum::printed).collect();
                    format!("{} near 0", sums.join(" and "))
                }
                Move::Body(..) => "unlike moments of inertia".to_owned(),
                Move::Faster(decades) if decades > 0.0 => "high speeds".to_owned(),
                Move::Faster(_) => "low speeds".to_owned(),
                Move::Smaller(_) => "small coordinates".to_owned(),
                Move::Apart(k) => {
                    let names: Vec<String> = self.apart[k].iter().take(TOGETHER).map(|&k| name(k)).collect();
                    format!("small {}", names.join(" and "))
                }
                Move::Graded([_, 0.0]) => "unlike masses".to_owned(),
                Move::Graded([0.0, _]) => "unlike lengths".to_owned(),
                Move::Graded(_) => "unlike masses and lengths".to_owned(),
                Move::Spin(k, turns, _) => {
                    let Spin { angle, sum, .. } = self.spins[k];
                    let near = if turns == 0.0 { "0" } else { "quarter turns" };
                    format!("{} near {near} with high rates in {} near 0", name(angle), self.sums[sum].printed())
                }
            };
            if !words.contains(&word) {
                words.push(word);
            }
        }
        words
    }

    pub fn apply(&self, change: Move, draft: &mut Draft<'_>) {
        draft.moves.push(change);
        match change {
            Move::Scale(k, decades) => self.scale(k, decades, draft),
            Move::Quarter(k, turns, closeness) => self.turn(k, turns, closeness, draft),
            Move::Near(sum, by, closeness) => self.bring_near(&self.sums[sum], by, closeness, draft),
            Move::AllNear(sum, seed, closeness) => {
                for (sum, by) in self.together(sum, seed) {
                    self.bring_near(sum, by, closeness, draft);
                }
            }
            Move::Body(k, seed) => {
                draft.masses[k] = (seed, if seed % 2 == 0 { 3.0 } else { 0.5 });
                self.give_mass(k, draft);
            }
            Move::Faster(decades) => {
                for speed in &self.states.system.scene.speeds {
                    let faster = draft.values.map[&speed.key()] * 10.0_f64.powf(decades);
                    let [least, most] = SIZES.map(|size| 10.0_f64.powf(size));
                    draft.values.put(*speed, faster.signum() * faster.abs().clamp(least, most));
                }
            }
            Move::Smaller(decades) => self.scalars.iter().for_each(|&k| self.scale(k, decades, draft)),
            Move::Apart(k) => self.apart[k].iter().for_each(|&k| self.scale(k, APART, draft)),
            Move::Graded(decades) => {
                for (list, decades) in self.graded.iter().zip(decades).filter(|(_, decades)| *decades != 0.0) {
                    let middle = 0.5 * (list.len() - 1) as f64;
                    for (place, &k) in list.iter().enumerate() {
                        let size = (decades * (place as f64 - middle)).clamp(-MOST_GRADED, MOST_GRADED);
                        let before = draft.values.map[&self.free[k].symbol.key()];
                        self.put(k, before * 10.0_f64.powf(size), draft);
                    }
                }
            }
            Move::Spin(k, turns, closeness) => {
                let Spin { angle, sum, by } = self.spins[k];
                let sum = &self.sums[sum];
                self.turn(angle, turns, closeness, draft);
                // What is left of the rates of the sum is as large as the other rates.
                for &speed in &self.speeds {
                    let apart = if sum.by.contains(&speed) { -0.5 } else { 0.5 };
                    self.scale(speed, apart * closeness, draft);
                }
                self.bring_near(sum, by, 2.0 * closeness, draft);
            }
        }
    }

    /// Makes a number so many powers of ten larger.
    fn scale(&self, k: usize, decades: f64, draft: &mut Draft<'_>) {
        let before = draft.values.map[&self.free[k].symbol.key()];
        let sign = if before < 0.0 { -1.0 } else { 1.0 };
        let [least, most] = self.free[k].range;
        let size = (before.abs().max(1e-30).log10() + decades).clamp(least, most);
        self.put(k, sign * 10.0_f64.powf(size), draft);
    }

    /// Brings an angle near so many quarter turns.
    fn turn(&self, k: usize, turns: f64, closeness: f64, draft: &mut Draft<'_>) {
        self.put(k, turns * std::f64::consts::FRAC_PI_2 + 10.0_f64.powf(closeness), draft);
    }

    fn put(&self, k: usize, value: f64, draft: &mut Draft<'_>) {
        draft.values.put(self.free[k].symbol, value);
        if let Some(body) = self.free[k].body {
            self.give_mass(body, draft);
        }
    }

    fn give_mass(&self, k: usize, draft: &mut Draft<'_>) {
        let (seed, decades) = draft.masses[k];
        if let Some(body) = self.states.bodies().nth(k) {
            self.states.give_mass(body, &mut draft.values, seed, decades);
        }
    }

    /// Brings a sum near zero by the secant method; a number that it does not find stays as it was.
    fn bring_near(&self, sum: &FreeSum<'g>, by: usize, closeness: f64, draft: &mut Draft<'_>) {
        if !self.states.definitions.is_empty() {
            self.states.define(&mut draft.values);
        }
        let Free { symbol, positive, range, .. } = self.free[by];
        let begun = draft.values.map[&symbol.key()];
        let mut at = |x: f64| {
            draft.values.put(symbol, x);
            let terms = sum.terms.iter().map(|(c, e)| c.to_f64() * draft.values.of(*e));
            terms.fold((0.0, 0.0), |(sum, size): (f64, f64), term| (sum + term, size + term.abs()))
        };
        let (first, size) = at(begun);
        let goal = first.signum() * size * 10.0_f64.powf(closeness);
        let mut before = (begun, first);
        let mut x = begun * 1.001 + f64::MIN_POSITIVE;
        for _ in 0..SECANTS {
            let value = at(x).0;
            let step = (value - goal) * (x - before.0) / (value - before.1);
            if !step.is_finite() || step == 0.0 {
                break;
            }
            before = (x, value);
            x -= step;
        }
        let [least, most] = range.map(|size| 10.0_f64.powf(size));
        let nearer = at(x).0.abs() < first.abs();
        let allowed = (least..=most).contains(&x.abs()) && (x > 0.0 || !positive);
        self.put(by, if nearer && allowed { x } else { begun }, draft);
    }
}

/// The first and the last of two coordinates or more that are lengths and added.
fn apart(sums: &[Vec<(Rational, Expr<'_>)>], places: &Map<u32, usize>, free: &[Free<'_>]) -> [Vec<usize>; 2] {
    let is_place = |k: &usize| !free[*k].parameter && !free[*k].angle;
    let added = sums.iter().map(|sum| {
        let mut added: Vec<usize> =
            sum.iter().filter_map(|(_, e)| places.get(&e.key())).copied().filter(is_place).collect();
        added.sort_unstable();
        added
    });
    let added: Vec<Vec<usize>> = added.filter(|added| added.len() > 1).collect();
    let mut apart =
        [0, 1].map(|last| -> Vec<usize> { added.iter().map(|added| added[last * (added.len() - 1)]).collect() });
    for own in &mut apart {
        own.sort_unstable();
        own.dedup();
    }
    apart
}

/// Fields in the masses of links, and in the places of joints, in the order of the links.
fn graded(states: &States<'_, '_>, places: &Map<u32, usize>, free: &[Free<'_>]) -> [Vec<usize>; 2] {
    let links = &states.system.scene.tree.links;
    let masses = links.iter().flat_map(|link| match &link.matter {
        Matter::Nothing => None,
        Matter::Particle(mass) => Some(*mass),
        Matter::Body(body) => Some(body.mass),
    });
    let lengths = links.iter().flat_map(|link| link.own_joint.offset);
    let of = |expressions: Vec<Expr<'_>>| {
        let (mut done, mut found) = (Map::default(), Vec::new());
        expressions.into_iter().for_each(|e| symbols_of(e, places, &mut done, &mut found));
        found.retain(|&k| free[k].parameter);
        found
    };
    [of(masses.collect()), of(lengths.collect())]
}

/// Sums of two rates or more with the angles they depend on, the innermost first. The last rate is most likely the one
/// whose axis does not depend on the angle.
fn spins(sums: &[FreeSum<'_>], angles: &[usize], speeds: &[usize]) -> Vec<Spin> {
    let mut spins = Vec::new();
    for (k, sum) in sums.iter().enumerate() {
        let mut rates = speeds.iter().filter(|speed| sum.by.contains(speed));
        let (Some(_), Some(&by)) = (rates.next(), rates.next_back()) else { continue };
        let own = angles.iter().filter(|angle| sum.by.contains(angle));
        spins.extend(own.map(|&angle| Spin { angle, sum: k, by }));
    }
    spins
}

/// The numbers of a state that are given, but for time and for what follows from others.
fn free<'g>(states: &States<'_, 'g>, seen: &SceneTerms<'g>) -> Vec<Free<'g>> {
    let mut free = Vec::new();
    let of_bodies: Map<u32, (usize, Role)> = states
        .bodies()
        .enumerate()
        .flat_map(|(k, body)| body.parameters.iter().map(move |own| (own.symbol.key(), (k, own.quantity))))
        .collect();
    for (symbol, component) in &states.parameters {
        let (body, role) = of_bodies.get(&symbol.key()).copied().unzip();
        if !matches!(role, Some(Role::Inertia | Role::CentralInertia | Role::AddedMass)) {
            free.push(Free {
                symbol: *symbol,
                parameter: true,
                angle: false,
                positive: !component,
                body,
                range: SIZES,
            });
        }
    }
    let of = |symbol: &Expr<'g>, range: [f64; 2]| Free {
        symbol: *symbol,
        parameter: false,
        angle: false,
        positive: false,
        body: None,
        range,
    };
    let scene = &states.system.scene;
    for coordinate in &scene.coordinates {
        match coordinate {
            Coordinate::Scalar(q) if seen.angles.contains(&q.key()) => {
                free.push(Free { angle: true, ..of(q, ANGLES) });
            }
            Coordinate::Scalar(q) => free.push(of(q, PLACES)),
            Coordinate::Rotation(_) => {}
            Coordinate::Pose(_, position) => free.extend(position.iter().map(|b| of(b, PLACES))),
            Coordinate::Plane { position, .. } => free.extend(position.iter().map(|b| of(b, PLACES))),
        }
    }
    free.extend(states.units.iter().flatten().map(|x| of(x, [ANGLES[0], 0.0])));
    let twist = states.system.twist();
    let lists = [&scene.speeds[..], twist, &scene.speed_rates, &scene.inputs, states.weights];
    free.extend(lists.into_iter().flatten().map(|z| of(z, SIZES)));
    free
}

/// Which of some symbols an expression has, by their places.
fn symbols_of(e: Expr<'_>, places: &Map<u32, usize>, done: &mut Map<u32, ()>, found: &mut Vec<usize>) {
    if found.len() >= SYMBOLS || done.insert(e.key(), ()).is_some() {
        return;
    }
    let mut visit = |e: Expr<'_>| symbols_of(e, places, done, found);
    match e.view() {
        NodeView::Number(_) => {}
        NodeView::Symbol(_) => found.extend(places.get(&e.key())),
        NodeView::Sum(terms) => terms.iter().for_each(|(_, term)| visit(*term)),
        NodeView::Product(factors) => factors.iter().for_each(|(factor, _)| visit(*factor)),
        NodeView::Call(_, inner) | NodeView::Group(inner) | NodeView::Opaque(inner) => visit(inner),
        NodeView::Binary(_, a, b) => [a, b].into_iter().for_each(visit),
        NodeView::Own(_, arguments) => arguments.into_iter().for_each(visit),
    }
}
