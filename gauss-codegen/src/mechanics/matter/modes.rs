//! A body that deforms: modes about the pose of its axes, by integrals over the undeformed body.
//!
//! A point of the body is at `r = x + Σ φ_k η_k + ½ Σ ψ_kl η_k η_l` from O, body axes: φ are the modes, ψ their
//! foreshortening, which is of second order. Its velocity `u + ω × r + ṙ` is linear in `ν = (u, ω, η̇)`, so that the
//! kinetic energy is `½ νᵀGν` with `G_ij = ∫ ∂v_P/∂ν_i · ∂v_P/∂ν_j dm`: integrals over the body, multiplied by powers
//! of η up to the second. Those without η, u and ω alone, are mass, centre of mass and inertia of the rigid body.
//!
//! The Gauss condition (3.4) of this matter, with `π = Gν = ∂T/∂ν`: a rigid virtual motion pairs with the rate of the
//! impulse as that of a fluid does, a mode with Lagrange's derivative,
//! ```text
//! (dπ_u/dt + ω × π_u) · ∂u/∂z + (dπ_ω/dt + ω × π_ω + u × π_u) · ∂ω/∂z + Σ (dπ_k/dt − ½ νᵀ ∂G/∂η_k ν) ∂η̇_k/∂z.
//! ```
//! For points that move as above that is ∫a_P·w_α dm. With ∫φ dm, ∫x × φ dm and ∫φ·φ dm alone it is the model of hybrid
//! coordinates (P. W. Likins 1970): the modes move the centre of mass, and do not change the inertia. The integrals are
//! those of O. Wallrapp 1994, "Standardization of flexible body modeling in multibody system codes".

use crate::algebra::{Expr, Graph, Map};

use crate::mechanics::kinematics::vector::{Triple, add, cross, dot};

/// Integrals over the undeformed body, body axes, pole O; n modes.
#[derive(Clone)]
pub struct ModalIntegrals<'g> {
    /// δ₀: ∫φ_k dm.
    pub translation: Vec<Triple<'g>>,
    /// δ₁: ∫x × φ_k dm.
    pub rotation: Vec<Triple<'g>>,
    /// ∫φ_k·φ_l dm.
    pub mass: Vec<Vec<Expr<'g>>>,
    /// ∂I_O/∂η_k.
    pub inertia: Vec<[Triple<'g>; 3]>,
    /// ∫ψ_kl dm.
    pub shortening: Vec<Vec<Triple<'g>>>,
    /// ∂/∂η_l of ∫r × ∂r/∂η_k dm: ∫(φ_l × φ_k + x × ψ_kl) dm.
    pub gyroscopic: Vec<Vec<Triple<'g>>>,
    /// ∂²I_O/∂η_k∂η_l.
    pub second_inertia: Vec<Vec<[Triple<'g>; 3]>>,
}

/// Contribution of modes to the kinetic energy of a link: `½ νᵀGν` without the rigid body's part.
#[derive(Clone)]
pub struct Deformation<'g> {
    pub link: usize,
    /// η.
    pub coordinates: Vec<Expr<'g>>,
    /// ν: u and ω of the link in body axes, pole O, then η̇; affine in z.
    pub rates: Vec<Expr<'g>>,
    /// G, in terms of η.
    pub matrix: Vec<Vec<Expr<'g>>>,
    /// Acceleration of free fall, body axes.
    pub gravity: Option<Triple<'g>>,
}

impl<'g> ModalIntegrals<'g> {
    /// ∫r dm beyond that of the undeformed body.
    fn first_moment(&self, eta: &[Expr<'g>]) -> Triple<'g> {
        std::array::from_fn(|i| expanded(eta, |k| self.translation[k][i], |k, l| self.shortening[k][l][i]))
    }

    /// I_O beyond that of the undeformed body.
    fn inertia(&self, eta: &[Expr<'g>], i: usize, j: usize) -> Expr<'g> {
        expanded(eta, |k| self.inertia[k][i][j], |k, l| self.second_inertia[k][l][i][j])
    }

    /// G of the velocity field, block by block.
    pub fn matrix(&self, graph: &'g Graph, eta: &[Expr<'g>]) -> Vec<Vec<Expr<'g>>> {
        let (n, zero) = (eta.len(), graph.zero());
        let mut matrix = vec![vec![zero; 6 + n]; 6 + n];
        let first = self.first_moment(eta);
        for j in 0..3 {
            // ∂v_P/∂ω_j = e_j × r.
            let unit: Triple<'g> = std::array::from_fn(|i| if i == j { graph.one() } else { zero });
            let turned = cross(&unit, &first);
            (0..3).for_each(|i| matrix[i][3 + j] = turned[i]);
            (0..3).for_each(|i| matrix[3 + i][3 + j] = self.inertia(eta, i, j));
        }
        for k in 0..n {
            // ∂v_P/∂η̇_k = ∂r/∂η_k.
            for i in 0..3 {
                let sum = |first: Expr<'g>, second: &dyn Fn(usize) -> Expr<'g>| {
                    (0..n).fold(first, |sum, l| sum + second(l) * eta[l])
                };
                matrix[i][6 + k] = sum(self.translation[k][i], &|l| self.shortening[k][l][i]);
                matrix[3 + i][6 + k] = sum(self.rotation[k][i], &|l| self.gyroscopic[k][l][i]);
            }
            (0..n).for_each(|l| matrix[6 + k][6 + l] = self.mass[k][l]);
        }
        for i in 0..6 + n {
            (0..i).for_each(|j| matrix[i][j] = matrix[j][i]);
        }
        matrix
    }
}

/// `Σ a_k η_k + ½ Σ b_kl η_k η_l`, b symmetric.
fn expanded<'g>(
    eta: &[Expr<'g>],
    linear: impl Fn(usize) -> Expr<'g>,
    quadratic: impl Fn(usize, usize) -> Expr<'g>,
) -> Expr<'g> {
    let n = eta.len();
    let mut sum = (0..n).map(|k| linear(k) * eta[k]).sum::<Expr<'g>>();
    for k in 0..n {
        sum = sum + (quadratic(k, k) * eta[k].powi(2)).half();
        sum = (k + 1..n).fold(sum, |sum, l| sum + quadratic(k, l) * eta[k] * eta[l]);
    }
    sum
}

impl<'g> Deformation<'g> {
    fn graph(&self) -> &'g Graph {
        self.rates[0].graph()
    }

    /// `Σ_j G_ij x_j`: π of other rates.
    pub fn momenta_of(&self, x: &[Expr<'g>]) -> Vec<Expr<'g>> {
        let row = |row: &Vec<Expr<'g>>| row.iter().zip(x).map(|(g, x)| *g * *x).sum::<Expr<'g>>().group();
        self.matrix.iter().map(row).collect()
    }

    /// π.
    pub fn momenta(&self) -> Vec<Expr<'g>> {
        self.momenta_of(&self.rates)
    }

    /// Terms of dπ/dt because axes turn, O moves and G depends on η.
    fn drift(&self, rates: &[Expr<'g>], momenta: &[Expr<'g>]) -> Vec<Expr<'g>> {
        let (u, w) = (triple(rates, 0), triple(rates, 3));
        let (q, gamma) = (triple(momenta, 0), triple(momenta, 3));
        let angular = add(&cross(&w, &gamma), &cross(&u, &q));
        let of_mode = |&eta: &Expr<'g>| {
            let mut square = self.graph().zero();
            for i in 0..rates.len() {
                for j in i..rates.len() {
                    let change = self.matrix[i][j].partial(eta);
                    if !change.is_zero() {
                        let term = change * rates[i] * rates[j];
                        square = square + if i == j { term.half() } else { term };
                    }
                }
            }
            -square
        };
        let modes = self.coordinates.iter().map(of_mode);
        cross(&w, &q).into_iter().chain(angular).chain(modes).map(Expr::group).collect()
    }

    /// ∫a_P·∂v_P/∂ν_i dm, with the acceleration of O, body axes, as an observer sees it who moves as well, and ω̇ and
    /// η̈ by the rates in `along`. Nothing depends on O's velocity (Galilei): it is left out before anything is formed.
    pub fn inertia_forces(&self, acceleration: &Triple<'g>, along: &Map<u32, Expr<'g>>) -> Vec<Expr<'g>> {
        let mut rates = self.rates.clone();
        rates[..3].fill(self.graph().zero());
        let momenta = self.momenta_of(&rates);
        let (drift, moved) = (self.drift(&rates, &momenta), self.uniform(acceleration));
        let rows = momenta.iter().zip(drift).zip(moved);
        rows.map(|((p, drift), moved)| (p.derivative(along) + drift + moved).group()).collect()
    }

    /// ∫a·∂v_P/∂ν_i dm of an acceleration that all points have, body axes: of O, or of a uniform field.
    pub fn uniform(&self, acceleration: &Triple<'g>) -> Vec<Expr<'g>> {
        let mut all = vec![self.graph().zero(); self.rates.len()];
        all[..3].copy_from_slice(acceleration);
        self.momenta_of(&all)
    }

    /// η̇.
    pub fn mode_rates(&self) -> &[Expr<'g>] {
        &self.rates[6..]
    }

    /// ∫r dm beyond that of the undeformed body, body axes: `u·(ω × S)` has it.
    pub fn first_moment(&self) -> Triple<'g> {
        [self.matrix[1][5], self.matrix[2][3], self.matrix[0][4]]
    }

    /// I_O beyond that of the undeformed body.
    pub fn inertia(&self) -> [Triple<'g>; 3] {
        std::array::from_fn(|i| triple(&self.matrix[3 + i], 3))
    }

    /// `−g·S`.
    pub fn potential_energy(&self) -> Expr<'g> {
        self.gravity.map_or(self.graph().zero(), |g| -dot(&g, &self.first_moment().map(Expr::group)))
    }

    /// `νᵀGν`.
    pub fn twice_kinetic_energy(&self) -> Expr<'g> {
        let terms = self.momenta().into_iter().zip(&self.rates).map(|(p, rate)| p * *rate);
        terms.fold(self.graph().zero(), |sum, e| sum + e)
    }

    /// ∂ν/∂z of a speed.
    pub fn row(&self, speed: Expr<'g>) -> Vec<Expr<'g>> {
        self.rates.iter().map(|rate| rate.partial(speed)).collect()
    }

    /// `Σ_i values_i ∂ν_i/∂z^α`.
    pub fn projected(&self, values: &[Expr<'g>], speed: Expr<'g>) -> Expr<'g> {
        let own = values.iter().zip(self.row(speed)).filter(|(_, partial)| !partial.is_zero());
        own.fold(self.graph().zero(), |sum, (value, partial)| sum + *value * partial)
    }

    /// Adds `(∂ν/∂z^α)ᵀG ∂ν/∂z^β` to the upper half of A.
    pub fn add_to(&self, matrix: &mut [Vec<Expr<'g>>], speeds: &[Expr<'g>]) {
        let rows: Vec<Vec<Expr<'g>>> = speeds.iter().map(|&z| self.row(z)).collect();
        for column in 0..speeds.len() {
            if rows[column].iter().all(|e| e.is_zero()) {
                continue;
            }
            let momenta = self.momenta_of(&rows[column]);
            for row in 0..=column {
                let entry = rows[row].iter().zip(&momenta).map(|(partial, p)| *partial * *p);
                matrix[row][column] = matrix[row][column] + entry.sum::<Expr<'g>>();
            }
        }
    }

    /// `Σ π·d(∂ν/∂z^α)/dt` less what `drift` has: the bracket of the momentum form.
    pub fn bracket(&self, speed: Expr<'g>, rates: &Map<u32, Expr<'g>>) -> Expr<'g> {
        let momenta = self.momenta();
        let turning = self.row(speed).into_iter().zip(&momenta).map(|(partial, p)| *p * partial.derivative(rates));
        turning.sum::<Expr<'g>>() - self.projected(&self.drift(&self.rates, &momenta), speed)
    }

    /// Replaces the rates by other expressions.
    pub fn map_rates(&mut self, f: impl Fn(Expr<'g>) -> Expr<'g>) {
        self.rates.iter_mut().for_each(|rate| *rate = f(*rate));
    }
}

fn triple<'g>(all: &[Expr<'g>], at: usize) -> Triple<'g> {
    [all[at], all[at + 1], all[at + 2]]
}
