//! Central gravity: one potential; over links that hang on one another the field at a common pole, which is an
//! acceleration of the observer, and the tide about it.

use crate::algebra::{Expr, Map};

use crate::mechanics::kinematics::vector::{Axes, Triple, add, cross, dot, is_zero, scale, subtract};
use crate::mechanics::links::link::{Link, Matter};
use crate::mechanics::links::tree::Tree;
use crate::mechanics::loads::forces::{Action, Force, ForceField, Loads};
use crate::mechanics::matter::modes::Deformation;
use crate::mechanics::matter::moments::Moments;

/// The field of a centre: φ = −μ/|ρ|, ρ from the centre.
#[derive(Clone, Copy)]
pub struct CentralField<'g> {
    pub mu: Expr<'g>,
    /// Observer's axes, from Ω.
    pub center: Triple<'g>,
}

/// Matter about O in the field, φ expanded to second order in x under the moments: `m φ + ∇φ·∫x dm + ½ ∇∇φ : J`. For a
/// body small beside its distance that is all of gravity: its first order moves the body, its second turns it (the
/// gravity-gradient torque) and corrects the first. In terms of formal components of ρ, body axes, and of 1/|ρ|, whose
/// rate is −ρ·dρ/dt/|ρ|³.
struct Expansion<'g> {
    arm: Triple<'g>,
    inverse: Expr<'g>,
    /// Energies of order 0, 1 and 2.
    energies: [Expr<'g>; 3],
}

impl<'g> Expansion<'g> {
    fn new(mu: Expr<'g>, moments: &Moments<'g>) -> Self {
        let graph = mu.graph();
        let arm: Triple<'g> =
            std::array::from_fn(|i| graph.symbol(format!("ρ{}", i + 1), format!("\\rho_{{{}}}", i + 1), false));
        let inverse = graph.symbol("1/|ρ|", "|\\rho|^{-1}", false);
        let mut expansion = Self { arm, inverse, energies: [-mu * inverse; 3] };
        let field = expansion.energies[0];
        let gradient: Triple<'g> = std::array::from_fn(|i| field.derivative(&expansion.moving(i)));
        let second = |i: usize| {
            let rates = expansion.moving(i);
            (0..3).map(move |j| gradient[j].derivative(&rates) * moments.second[i][j])
        };
        let second: Expr<'g> = (0..3).flat_map(second).sum();
        expansion.energies = [moments.mass * field, dot(&gradient, &moments.first), second.half()];
        expansion
    }

    /// Rates while O moves along an axis.
    fn moving(&self, axis: usize) -> Map<u32, Expr<'g>> {
        let along = self.arm[axis];
        Map::from_iter([(along.key(), along.graph().one()), (self.inverse.key(), -along * self.inverse.powi(3))])
    }

    /// Rates while the body turns about an axis: those of ρ, fixed for the observer, in body axes; the distance stays.
    fn turning(&self, axis: usize) -> Map<u32, Expr<'g>> {
        let graph = self.inverse.graph();
        let unit: Triple<'g> = std::array::from_fn(|i| if i == axis { graph.one() } else { graph.zero() });
        self.arm.iter().zip(cross(&self.arm, &unit)).map(|(r, rate)| (r.key(), rate)).collect()
    }

    fn at(&self, arm: &Triple<'g>, inverse: Expr<'g>) -> Map<u32, Expr<'g>> {
        let own = self.arm.iter().zip(arm).map(|(r, value)| (r.key(), value.group()));
        own.chain([(self.inverse.key(), inverse)]).collect()
    }

    /// The force on a link and the torque about O that first and second moments add, with what the formal components
    /// stand for; the torque of the first is that of a uniform field.
    fn force_on(&self, link: usize, at: &Map<u32, Expr<'g>>) -> Force<'g> {
        let [_, first, second] = self.energies;
        let negative = |e: Expr<'g>, rates: &Map<u32, Expr<'g>>| (-e.derivative(rates)).substitute(at).group();
        let force = std::array::from_fn(|i| negative(first + second, &self.moving(i)));
        let torque = std::array::from_fn(|i| negative(second, &self.turning(i)));
        Force::OnLink { link, at: [self.inverse.graph().zero(); 3], force, torque, axes: Axes::Body }
    }
}

impl<'g> CentralField<'g> {
    /// O of a link from the centre, observer's axes.
    fn arm(&self, link: &Link<'g>) -> Triple<'g> {
        std::array::from_fn(|i| (link.position[i] - self.center[i]).group())
    }

    /// The same in body axes. The field looks the same from all sides: of a particle no axes are needed.
    fn arm_in_body(&self, link: &Link<'g>) -> Triple<'g> {
        match link.matter {
            Matter::Body(_) => link.axes().to_body(&self.arm(link)).map(Expr::group),
            _ => self.arm(link),
        }
    }

    /// Action of the field on all matter of a tree.
    pub fn action(&self, tree: &Tree<'g>) -> Action<'g> {
        let graph = tree.graph;
        let sum = |links: &mut dyn Iterator<Item = &Link<'g>>| {
            links.map(|link| self.energy(link)).fold(graph.zero(), |sum, energy| sum + energy)
        };
        let heavy = |link: &&Link<'g>| !matches!(link.matter, Matter::Nothing);
        let potential = sum(&mut tree.links.iter().filter(heavy));
        let (mut loads, mut gathered) = (Loads::default(), Vec::new());
        for root in (0..tree.links.len()).filter(|&k| tree.links[k].parent.is_none()) {
            let Some(pole) = pole_of(tree, root).filter(|&pole| !is_zero(&self.arm(&tree.links[pole]))) else {
                continue;
            };
            gathered.push(root);
            loads.uniform.push((root, self.at(&self.arm(&tree.links[pole]))));
            let own = (0..tree.links.len()).filter(|&k| tree.root_of(k) == root && heavy(&&tree.links[k]));
            loads.forces.extend(own.flat_map(|k| self.tide(tree, pole, k)));
            let own = tree.deformations.iter().filter(|modes| tree.root_of(modes.link) == root);
            loads.forces.extend(own.flat_map(|modes| self.tide_on_modes(tree, pole, modes)));
        }
        let potential = potential + self.energy_of_modes(tree, |_| true);
        if gathered.is_empty() {
            return Action::Potential(potential);
        }
        let apart = tree.links.iter().enumerate().filter(|(k, _)| !gathered.contains(&tree.root_of(*k)));
        let of_modes = self.energy_of_modes(tree, |root| !gathered.contains(&root));
        let rest = sum(&mut apart.map(|(_, link)| link).filter(heavy)) + of_modes;
        Action::Field(ForceField { potential, rest, loads })
    }

    /// The energy of what modes add to the moments of links, on some of the roots.
    fn energy_of_modes(&self, tree: &Tree<'g>, on: impl Fn(usize) -> bool) -> Expr<'g> {
        let of = |modes: &Deformation<'g>| {
            let link = &tree.links[modes.link];
            self.energy_at(link, &moments_of(modes), &link.axes().to_body(&self.arm(link)).map(Expr::group))
        };
        let own = tree.deformations.iter().filter(|modes| on(tree.root_of(modes.link)));
        own.map(of).fold(tree.graph.zero(), |sum, energy| sum + energy)
    }

    fn energy(&self, link: &Link<'g>) -> Expr<'g> {
        self.energy_at(link, &link.moments, &self.arm_in_body(link))
    }

    /// Energy of moments about O of a link; `arm` in the axes of the moments.
    fn energy_at(&self, link: &Link<'g>, moments: &Moments<'g>, arm: &Triple<'g>) -> Expr<'g> {
        let expansion = Expansion::new(self.mu, moments);
        let energy: Expr<'g> = expansion.energies.into_iter().sum();
        // The distance does not change while the body turns.
        energy.substitute(&expansion.at(arm, inverse_length(&self.arm(link))))
    }

    /// γ = −∇φ.
    fn at(&self, arm: &Triple<'g>) -> Triple<'g> {
        scale((-self.mu * inverse_length(arm).powi(3)).group(), arm)
    }

    /// Forces of the field on a link beside that on the pole: the difference of the accelerations, and the parts of the
    /// first and the second moments. With d = O − pole the difference is that of Encke, in which nothing cancels: `|ρ +
    /// d|² = |ρ|² w`, `w = 1 + q`, `q = d·(2ρ + d)/|ρ|²`, and
    ///
    /// `γ(ρ + d) − γ(ρ) = −μ/|ρ|³ (d − f (ρ + d))`, `f = 1 − 1/h = q (3 + 3q + q²)/(h (1 + h))`, `h = w√w`.
    fn tide(&self, tree: &Tree<'g>, pole: usize, k: usize) -> Vec<Force<'g>> {
        let (link, none) = (&tree.links[k], [tree.graph.zero(); 3]);
        let (tide, inverse) = self.difference(tree, pole, k);
        let mut forces = Vec::new();
        let moments = &link.moments;
        if k != pole {
            let center = link.body().map_or(none, |body| body.center_of_mass);
            let force = scale(moments.mass, &tide).map(Expr::group);
            forces.push(Force::OnLink { link: k, at: center, force, torque: none, axes: Axes::Space });
        }
        if matches!(link.matter, Matter::Body(_)) {
            let expansion = Expansion::new(self.mu, moments);
            forces.push(expansion.force_on(k, &expansion.at(&self.arm_in_body(link), inverse)));
        }
        forces
    }

    /// The same of what modes add to the moments of their link.
    fn tide_on_modes(&self, tree: &Tree<'g>, pole: usize, modes: &Deformation<'g>) -> Vec<Force<'g>> {
        let (k, none) = (modes.link, [tree.graph.zero(); 3]);
        let axes = tree.links[k].axes();
        let (tide, inverse) = self.difference(tree, pole, k);
        let tide = if k == pole { none } else { axes.to_body(&tide).map(Expr::group) };
        let expansion = Expansion::new(self.mu, &moments_of(modes));
        let at = expansion.at(&axes.to_body(&self.arm(&tree.links[k])), inverse);
        let first = modes.first_moment();
        let torque = cross(&first.map(Expr::group), &tide);
        let pull = Force::OnLink { link: k, at: none, force: none, torque, axes: Axes::Body };
        let of_mode = |(eta, rate): (&Expr<'g>, &Expr<'g>)| {
            let second = expansion.energies[2].partial(*eta).substitute(&at);
            let force = (dot(&first.map(|e| e.partial(*eta)), &tide) - second).group();
            Force::OnRate { rate: *rate, force }
        };
        let on_modes = modes.coordinates.iter().zip(modes.mode_rates()).map(of_mode);
        [expansion.force_on(k, &at), pull].into_iter().chain(on_modes).collect()
    }

    /// The difference of the accelerations of O of a link and of the pole, observer's axes, and 1/|ρ| of the link.
    fn difference(&self, tree: &Tree<'g>, pole: usize, k: usize) -> (Triple<'g>, Expr<'g>) {
        let (graph, link) = (tree.graph, &tree.links[k]);
        let (one, three) = (graph.one(), graph.integer(3));
        let near = self.arm(&tree.links[pole]);
        let inverse = inverse_length(&near);
        let d = from_pole(tree, pole, k);
        let q = (dot(&d, &add(&scale(graph.integer(2), &near), &d).map(Expr::group)) * inverse.powi(2)).group();
        let w = (one + q).group();
        let h = (w * w.sqrt()).group();
        // One division: 1/√w = w (1 + h)/(h (1 + h)).
        let divided = (h * (one + h).group()).group().recip().group();
        let f = (q * (three + q * (three + q)).group() * divided).group();
        let tide =
            scale((-self.mu * inverse.powi(3)).group(), &subtract(&d, &scale(f, &self.arm(link)))).map(Expr::group);
        (tide, (inverse * w * (one + h).group() * divided).group())
    }
}

/// The moments about O that modes add to those of their link, body axes.
fn moments_of<'g>(modes: &Deformation<'g>) -> Moments<'g> {
    let (inertia, first) = (modes.inertia(), modes.first_moment());
    let half_trace = (inertia[0][0] + inertia[1][1] + inertia[2][2]).half();
    let second = |i: usize, j: usize| if i == j { half_trace - inertia[i][j] } else { -inertia[i][j] };
    let second = std::array::from_fn(|i| std::array::from_fn(|j| second(i, j)));
    Moments { mass: first[0].graph().zero(), first, second }
}

/// 1/|a|.
fn inverse_length<'g>(a: &Triple<'g>) -> Expr<'g> {
    dot(a, a).group().sqrt().recip().group()
}

/// The link that all matter on a root hangs on, or is.
fn pole_of(tree: &Tree<'_>, root: usize) -> Option<usize> {
    let heavy = |k: &usize| !matches!(tree.links[*k].matter, Matter::Nothing);
    let own: Vec<usize> = (0..tree.links.len()).filter(|&k| tree.root_of(k) == root).filter(heavy).collect();
    let path = |k: usize| -> Vec<usize> { std::iter::successors(Some(k), |&k| tree.links[k].parent).collect() };
    let (first, others) = own.split_first()?;
    let shared = |k: &usize| others.iter().all(|&other| path(other).contains(k));
    path(*first).into_iter().find(shared)
}

/// O of a link from that of one it hangs on, observer's axes.
fn from_pole<'g>(tree: &Tree<'g>, pole: usize, k: usize) -> Triple<'g> {
    match tree.links[k].parent.filter(|_| k != pole) {
        None => [tree.graph.zero(); 3],
        Some(parent) => {
            let offset = tree.links[parent].frame.to_space(&tree.links[k].joint.offset).map(Expr::group);
            add(&from_pole(tree, pole, parent), &offset).map(Expr::group)
        }
    }
}
