//! Conditions that links and joints must meet, and what follows: which link hangs on which, what moves as one.

use std::collections::HashMap;

use super::description::{At, Description, Fault, Inertial, Joint, JointKind};
use super::mimic::{Coupling, couplings};
use super::names::unknown;
use super::rotation::{Matrix, Rotation, Triple, about_direction, multiply, turned, turned_tensor};

/// The tree of a description whose parts fit together. Indices are those of its links and joints.
pub struct Structure {
    /// The link that all others hang on.
    pub root: usize,
    /// The joint that a link hangs by; `None` of the root.
    pub joint_of: Vec<Option<usize>>,
    /// The link that a link hangs on; `None` of the root.
    pub parent_of: Vec<Option<usize>>,
    /// The link that each moves as one with: itself, if its joint moves.
    pub owner_of: Vec<usize>,
    /// The links that move as one with each, in their order.
    owned_by: Vec<Vec<usize>>,
    /// Position and rotation of each in the axes of its owner.
    place_in_owner: Vec<(Triple, Matrix)>,
    /// Coordinate of each joint: that of a joint, times a number, and another.
    pub coupling_of: Vec<Coupling>,
}

impl Structure {
    /// # Errors
    /// Everything that does not fit, each where it is written.
    pub fn new(description: &Description) -> Result<Structure, Vec<Fault>> {
        let mut faults = Vec::new();
        refuse_twice("link", description.links.iter().map(|link| (&link.name, link.at)), &mut faults);
        refuse_twice("joint", description.joints.iter().map(|joint| (&joint.name, joint.at)), &mut faults);
        let (joint_of, parent_of) = parents(description, &mut faults);
        let coupling_of = couplings(description, &mut faults);
        refuse_strange_joints(description, &mut faults);
        for closure in &description.closures {
            let strangers =
                closure.links.iter().filter(|name| !description.links.iter().any(|link| link.name == **name));
            for name in strangers {
                let which = unknown("link", name, description.links.iter().map(|link| link.name.as_str()));
                faults.push(Fault { at: closure.at, message: format!("one of the links that are joined is {which}") });
            }
        }
        let root = if faults.is_empty() { root(description, &parent_of, &mut faults) } else { None };
        let Some(root) = root else { return Err(faults) };
        let (owner_of, owned_by, place_in_owner) = (Vec::new(), Vec::new(), Vec::new());
        let mut structure = Structure { root, joint_of, parent_of, owner_of, owned_by, place_in_owner, coupling_of };
        structure.hold(description, &vec![None; description.joints.len()]);
        Ok(structure)
    }

    /// Holds joints as if they were fixed, each turned or moved by that much.
    pub fn hold(&mut self, description: &Description, held: &[Option<f64>]) {
        let count = description.links.len();
        self.owned_by = vec![Vec::new(); count];
        (self.owner_of, self.place_in_owner) = (0..count).map(|link| self.owner(description, held, link)).unzip();
        (0..count).for_each(|link| self.owned_by[self.owner_of[link]].push(link));
    }

    /// A link, the one that it hangs on, and so on to the root.
    pub fn way_to_root(&self, link: usize) -> impl Iterator<Item = usize> {
        std::iter::successors(Some(link), |&link| self.parent_of[link])
    }

    /// Which link this one moves as one with, and where it is in its axes. Circles have been refused.
    fn owner(&self, description: &Description, held: &[Option<f64>], link: usize) -> (usize, (Triple, Matrix)) {
        let (mut owner, mut place) = (link, ([0.0; 3], Rotation::none().matrix));
        while let (Some(joint), Some(parent)) = (self.joint_of[owner], self.parent_of[owner]) {
            let (joint, by) = (&description.joints[joint], held[joint]);
            if joint.kind != JointKind::Fixed && by.is_none() {
                break;
            }
            place = hung(joint, displaced(joint, by.unwrap_or(0.0), place));
            owner = parent;
        }
        (owner, place)
    }

    /// Position and rotation of a link in the axes of the root while no joint is turned or moved.
    pub fn at_rest(&self, description: &Description, link: usize) -> (Triple, Matrix) {
        self.moved(description, link, |_| 0.0)
    }

    /// The same while all joints are where their springs have no force.
    pub fn at_springs(&self, description: &Description, link: usize) -> (Triple, Matrix) {
        self.moved(description, link, |joint| joint.rest - joint.reference)
    }

    /// The same while joints with one coordinate are turned or moved by that much.
    pub fn moved(&self, description: &Description, mut link: usize, by: impl Fn(&Joint) -> f64) -> (Triple, Matrix) {
        let mut place = ([0.0; 3], Rotation::none().matrix);
        while let (Some(joint), Some(parent)) = (self.joint_of[link], self.parent_of[link]) {
            let joint = &description.joints[joint];
            let (position, rotation) = joint.start;
            let start = Joint { position, rotation, ..joint.clone() };
            let own = displaced(joint, by(joint), place);
            place = hung(if joint.kind == JointKind::Floating { &start } else { joint }, own);
            link = parent;
        }
        place
    }

    /// The point of the second link that coincides with a point of the first while no joint is turned or moved.
    pub fn opposite(&self, description: &Description, [first, second]: [usize; 2], point: &Triple) -> Triple {
        let [(a, r), (b, s)] = [first, second].map(|link| self.at_rest(description, link));
        let turned = turned(&r, point);
        let apart: Triple = std::array::from_fn(|i| a[i] + turned[i] - b[i]);
        std::array::from_fn(|i| (0..3).map(|k| s[k][i] * apart[k]).sum())
    }

    /// The rotation of the second link relative to the first while no joint is turned or moved.
    pub fn turn_at_rest(&self, description: &Description, links: [usize; 2]) -> Matrix {
        let [(_, r), (_, s)] = links.map(|link| self.at_rest(description, link));
        std::array::from_fn(|i| std::array::from_fn(|j| (0..3).map(|k| r[k][i] * s[k][j]).sum()))
    }

    /// The mass data of a link and of all links fixed to it, but for the links that are `apart`; `None` without any.
    pub fn merged(&self, description: &Description, owner: usize, apart: impl Fn(usize) -> bool) -> Option<Inertial> {
        let own = self.owned_by[owner].iter().filter(|link| !apart(**link));
        let all: Vec<Inertial> = own
            .filter_map(|&link| Some(placed(description.links[link].inertial?, &self.place_in_owner[link])))
            .collect();
        match all.as_slice() {
            [] => None,
            [one] => Some(*one),
            all => Some(sum(all)),
        }
    }
}

/// A place in the axes of the child of a joint with one coordinate, once that is turned or moved by that much.
fn displaced(joint: &Joint, by: f64, (position, matrix): (Triple, Matrix)) -> (Triple, Matrix) {
    match joint.kind {
        JointKind::Turning if by != 0.0 => {
            let turn = about_direction(&joint.axis, by);
            (turned(&turn, &position), multiply(&turn, &matrix))
        }
        JointKind::Sliding => (std::array::from_fn(|i| position[i] + by * joint.axis[i]), matrix),
        _ => (position, matrix),
    }
}

/// A place in the axes of the parent of a joint that is neither turned nor moved.
fn hung(joint: &Joint, (position, matrix): (Triple, Matrix)) -> (Triple, Matrix) {
    let moved = turned(&joint.rotation.matrix, &position);
    (std::array::from_fn(|i| joint.position[i] + moved[i]), multiply(&joint.rotation.matrix, &matrix))
}

/// Mass data in the axes of another link.
pub fn placed(own: Inertial, (position, matrix): &(Triple, Matrix)) -> Inertial {
    if *matrix == Rotation::none().matrix && *position == [0.0; 3] {
        return own;
    }
    let center = turned(matrix, &own.center);
    Inertial {
        mass: own.mass,
        center: std::array::from_fn(|i| position[i] + center[i]),
        inertia: turned_tensor(matrix, &own.inertia),
    }
}

/// Sum of several mass data, all in the same axes.
pub fn sum(all: &[Inertial]) -> Inertial {
    let mass: f64 = all.iter().map(|part| part.mass).sum();
    let weighted = |i: usize| all.iter().map(|part| part.mass * part.center[i]).sum::<f64>();
    let center: Triple = if mass > 0.0 { std::array::from_fn(|i| weighted(i) / mass) } else { [0.0; 3] };
    let mut inertia = [[0.0; 3]; 3];
    for part in all {
        let arm: Triple = std::array::from_fn(|i| part.center[i] - center[i]);
        let square: f64 = arm.iter().map(|c| c * c).sum();
        for i in 0..3 {
            for j in 0..3 {
                let diagonal = if i == j { square } else { 0.0 };
                inertia[i][j] += part.inertia[i][j] + part.mass * (diagonal - arm[i] * arm[j]);
            }
        }
    }
    Inertial { mass, center, inertia }
}

/// Refuses drives, couplings and ties of joints that there are not.
fn refuse_strange_joints(description: &Description, faults: &mut Vec<Fault>) {
    let drives = description
        .drives
        .iter()
        .flat_map(|drive| drive.along.iter().map(|(joint, _)| (drive.at, format!("`{}` drives", drive.name), joint)));
    let tendons = description
        .tendons
        .iter()
        .flat_map(|tendon| tendon.along.iter().map(|(joint, _)| (tendon.at, "a tendon is along".to_owned(), joint)));
    let polynomials = description.polynomials.iter().flat_map(|polynomial| {
        let joints = polynomial.along.iter().chain(polynomial.of.iter().flatten());
        joints.map(|(joint, _)| (polynomial.at, "an equality is of".to_owned(), joint))
    });
    for (at, what, joint) in drives.chain(tendons).chain(polynomials) {
        if !description.joints.iter().any(|other| other.name == *joint) {
            let message = unknown("joint", joint, description.joints.iter().map(|joint| joint.name.as_str()));
            faults.push(Fault { at, message: format!("{what} {message}") });
        }
    }
}

fn refuse_twice<'a>(noun: &str, names: impl Iterator<Item = (&'a String, At)>, faults: &mut Vec<Fault>) {
    let mut known: HashMap<&String, At> = HashMap::new();
    for (name, at) in names {
        match known.get(name) {
            Some(first) => faults.push(Fault {
                at,
                message: format!(
                    "a second {noun} is called `{name}`, the first is in line {}; rename one",
                    first.line_from(at)
                ),
            }),
            None => _ = known.insert(name, at),
        }
    }
}

/// Finds the joint that each link hangs by, and its parent.
fn parents(description: &Description, faults: &mut Vec<Fault>) -> (Vec<Option<usize>>, Vec<Option<usize>>) {
    let count = description.links.len();
    let (mut joint_of, mut parent_of): (Vec<Option<usize>>, Vec<Option<usize>>) =
        (vec![None; count], vec![None; count]);
    let places: HashMap<&String, usize> =
        description.links.iter().enumerate().rev().map(|(place, link)| (&link.name, place)).collect();
    for (index, joint) in description.joints.iter().enumerate() {
        let ends = [&joint.parent, &joint.child].map(|name| {
            let link = places.get(name).copied();
            if link.is_none() {
                let which = unknown("link", name, description.links.iter().map(|link| link.name.as_str()));
                faults.push(Fault { at: joint.at, message: format!("the joint `{}` joins {which}", joint.name) });
            }
            link
        });
        let [Some(parent), Some(child)] = ends else { continue };
        if let Some(earlier) = joint_of[child] {
            let earlier: &Joint = &description.joints[earlier];
            let message = format!(
                "the link `{}` hangs by the joint `{}` and by `{}` in line {}; in a file each has one parent: \
                 remove one, and \
                 write the other as a `constraint(…)` of the struct",
                joint.child,
                joint.name,
                earlier.name,
                earlier.at.line_from(joint.at)
            );
            faults.push(Fault { at: joint.at, message });
            continue;
        }
        (joint_of[child], parent_of[child]) = (Some(index), Some(parent));
    }
    (joint_of, parent_of)
}

/// The link that all others hang on.
fn root(description: &Description, parent_of: &[Option<usize>], faults: &mut Vec<Fault>) -> Option<usize> {
    let links = &description.links;
    // Links that lead to the root.
    let mut settled = vec![false; links.len()];
    for start in 0..links.len() {
        let (mut link, mut chain) = (start, Vec::new());
        // As many steps as there are links lead to the root, or around.
        while let Some(parent) = parent_of[link].filter(|_| !settled[link] && chain.len() < links.len()) {
            chain.push(link);
            link = parent;
        }
        if settled[link] || parent_of[link].is_none() {
            chain.into_iter().for_each(|link| settled[link] = true);
            continue;
        }
        let mut circle = vec![link];
        while let Some(next) = parent_of[circle[circle.len() - 1]].filter(|next| *next != link) {
            circle.push(next);
        }
        let first = circle.iter().copied().min_by_key(|&member| links[member].at).unwrap_or(link);
        let names: Vec<String> = circle.iter().map(|&member| format!("`{}`", links[member].name)).collect();
        let message = format!("links hang on each other in a circle: {}", names.join(" on "));
        faults.push(Fault { at: links[first].at, message });
        return None;
    }
    let roots: Vec<usize> = (0..links.len()).filter(|&link| parent_of[link].is_none()).collect();
    match roots.as_slice() {
        [] => {
            faults.push(Fault { at: At { line: 1, column: 1, ..At::default() }, message: "there are no links".into() })
        }
        [_] => {}
        [first, others @ ..] => faults.extend(others.iter().map(|&other| Fault {
            at: links[other].at,
            message: format!(
                "the link `{}` hangs on nothing, and so does `{}` in line {}; join the two",
                links[other].name,
                links[*first].name,
                links[*first].at.line_from(links[other].at)
            ),
        })),
    }
    roots.first().copied().filter(|_| faults.is_empty())
}
