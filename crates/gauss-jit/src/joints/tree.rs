//! The tree of joints that a scene moves by, found from the places of its bodies.
//!
//! A pose is that of such a tree where it is a product of motions, one for each coordinate or for each joint that
//! follows one: `T(q) = E₁(q₁) … E_k(q_k) M`, each a turn about a line, a shift along a direction, a turn about a
//! point, or a pose. Motions are seen where all other coordinates are 0; that their product is the pose is then tried
//! at states of general position.

use gauss_runtime::nalgebra::Isometry3;

use super::motions::{Joint, JointGroup, Observer, is_same};
use super::numbers::{SceneNumbers, Sequence, Value};

/// The joints of a scene: each coordinate moves what hangs on its joints, on what those above them have moved.
pub struct JointTree {
    /// The joint of each variable, then those that follow a variable.
    pub joints: Vec<Joint>,
    pub names: Vec<String>,
    pub parents: Vec<Option<usize>>,
    /// The last joint that moves each body.
    pub carriers: Vec<Option<usize>>,
    /// Places of the bodies at 0.
    pub places: Vec<Isometry3<f64>>,
}

impl JointTree {
    /// Finds the joints.
    ///
    /// # Errors
    /// Each body that no tree of joints moves, or each coordinate that is none of a joint, in a sentence.
    pub fn of(scene: &SceneNumbers) -> Result<Self, Vec<String>> {
        let observer = Observer::new(scene);
        let found = observer.moved().into_iter().enumerate().map(|(k, moved)| observer.joints(k, &moved));
        let found: Vec<Result<JointGroup, String>> = found.collect();
        let mistakes: Vec<String> = found.iter().filter_map(|own| own.clone().err()).collect();
        if !mistakes.is_empty() {
            return Err(mistakes);
        }
        let (mut list, mut followers) = (Vec::new(), Vec::new());
        for mut group in found.into_iter().flatten() {
            followers.extend(group.drain(1..));
            list.extend(group);
        }
        list.extend(followers);
        let (joints, moved): (Vec<Joint>, _) = list.into_iter().unzip();
        let names = names(scene, &joints);
        Finder { observer, joints, moved, names }.tree()
    }

    /// Joints that move as a variable does.
    pub fn followers(&self) -> impl Iterator<Item = (usize, &Joint)> {
        self.joints.iter().enumerate().filter(|(place, joint)| joint.follows(*place))
    }

    /// The joints on the way to one, it included, from the root.
    pub fn way(&self, joint: Option<usize>) -> Vec<usize> {
        let mut way: Vec<usize> = std::iter::successors(joint, |&k| self.parents[k]).collect();
        way.reverse();
        way
    }

    /// The displacement of what a joint carries.
    pub fn displacement(&self, joint: Option<usize>, values: &[Value]) -> Isometry3<f64> {
        let way = self.way(joint).into_iter();
        way.fold(Isometry3::identity(), |moved, k| moved * self.joints[k].displacement(values))
    }

    /// The place of a body.
    pub fn place(&self, body: usize, values: &[Value]) -> Isometry3<f64> {
        self.displacement(self.carriers[body], values) * self.places[body]
    }
}

/// Names of joints: those of coordinates, and of what follows one with a number.
fn names(scene: &SceneNumbers, joints: &[Joint]) -> Vec<String> {
    let mut names: Vec<String> = scene.variables.iter().map(|own| own.name.clone()).collect();
    for joint in &joints[names.len()..] {
        let numbered = (2..).map(|k| format!("{}_{k}", names[joint.variable]));
        let free = numbered.into_iter().find(|word| !names.contains(word));
        names.push(free.unwrap_or_default());
    }
    names
}

struct Finder<'a> {
    observer: Observer<'a>,
    joints: Vec<Joint>,
    /// Bodies that each joint moves.
    moved: Vec<Vec<usize>>,
    names: Vec<String>,
}

impl Finder<'_> {
    fn tree(self) -> Result<JointTree, Vec<String>> {
        let order = self.order()?;
        let mut parents = vec![None; self.joints.len()];
        for (place, &k) in order.iter().enumerate() {
            let above = order[..place].iter().rev();
            parents[k] = above.copied().find(|&j| self.moved[k].iter().all(|body| self.moved[j].contains(body)));
        }
        let bodies = 0..self.observer.places.len();
        let carriers =
            bodies.map(|body| order.iter().rev().copied().find(|&k| self.moved[k].contains(&body))).collect();
        let Self { observer, joints, names, .. } = self;
        let tree = JointTree { joints, names, parents, carriers, places: observer.places.clone() };
        refuse_other_poses(observer.scene, &tree)?;
        Ok(tree)
    }

    /// Joints with those above first.
    fn order(&self) -> Result<Vec<usize>, Vec<String>> {
        let count = self.joints.len();
        let holds = |k: usize, j: usize| self.moved[j].iter().all(|body| self.moved[k].contains(body));
        let mut mistakes = Vec::new();
        for (k, j) in (0..count).flat_map(|k| (0..k).map(move |j| (k, j))) {
            if self.moved[k].iter().any(|body| self.moved[j].contains(body)) && !holds(k, j) && !holds(j, k) {
                let [a, b] = [k, j].map(|k| &self.names[k]);
                mistakes
                    .push(format!("`{b}` and `{a}` move one body together and others apart: no tree of joints does"));
            }
        }
        // Whether k must come before j.
        let before = |k: usize, j: usize| match (holds(k, j), holds(j, k)) {
            (true, false) => true,
            (true, true) => !self.is_product(j, k) && self.is_product(k, j),
            _ => false,
        };
        let (mut order, mut rest) = (Vec::new(), (0..count).collect::<Vec<usize>>());
        while !rest.is_empty() {
            let free = rest.iter().position(|&j| rest.iter().all(|&k| k == j || !before(k, j))).unwrap_or(0);
            order.push(rest.remove(free));
        }
        if mistakes.is_empty() { Ok(order) } else { Err(mistakes) }
    }

    /// Whether the place of a body that both move is E_k E_j M.
    fn is_product(&self, k: usize, j: usize) -> bool {
        let Observer { scene, origin, places } = &self.observer;
        let Some(&body) = self.moved[j].iter().find(|body| self.moved[k].contains(body)) else { return true };
        let mut values = origin.clone();
        let mut sequence = Sequence::new();
        let variables = [k, j].map(|joint| self.joints[joint].variable);
        variables.into_iter().for_each(|own| values[own] = sequence.value(scene.variables[own].kind));
        let moved = self.joints[k].displacement(&values) * self.joints[j].displacement(&values) * places[body];
        is_same(scene.bodies.list[body].kind, &scene.poses(0.0, &values)[body], &moved)
    }
}

/// Each body whose pose is no product of motions, and each that the time moves.
fn refuse_other_poses(scene: &SceneNumbers, tree: &JointTree) -> Result<(), Vec<String>> {
    let mut sequence = Sequence::new();
    let list = &scene.bodies.list;
    let (mut others, mut driven) = (vec![false; list.len()], vec![false; list.len()]);
    for _ in 0..4 {
        let values = scene.sample(&mut sequence);
        let (now, later) = (scene.poses(0.0, &values), scene.poses(1.3, &values));
        for (body, own) in list.iter().enumerate() {
            let place = tree.place(body, &values);
            others[body] |= !is_same(own.kind, &now[body], &place);
            driven[body] |= !is_same(own.kind, &now[body], &later[body]);
        }
    }
    let mistake = |(body, own): (usize, &gauss_codegen::LinkData)| {
        let name = &own.name;
        if driven[body] {
            Some(format!("`{name}` moves as a function of time, as no joint does"))
        } else if others[body] {
            let way = tree.way(tree.carriers[body]).into_iter();
            let way: Vec<String> = way.map(|k| format!("`{}`", tree.names[k])).collect();
            Some(format!(
                "the place of `{name}` is no product of joints, one for each of {}: a coordinate enters by a function",
                way.join(", ")
            ))
        } else {
            None
        }
    };
    let mistakes: Vec<String> = list.iter().enumerate().filter_map(mistake).collect();
    if mistakes.is_empty() { Ok(()) } else { Err(mistakes) }
}
