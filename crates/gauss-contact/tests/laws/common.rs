//! Mechanisms with a diagonal, constant inertia and gaps by hand: the tests' witnesses, independent of what is derived.

use std::marker::PhantomData;

use gauss_runtime::chart::Chart;
use gauss_runtime::contact::{
    Contact, ContactSystem, ImpulseDynamics, ImpulseResponse, impulse_terms, impulse_velocities,
};
use gauss_runtime::nalgebra::{SMatrix, SVector};
use gauss_runtime::system::GaussSystem;

/// The contacts of a scene.
pub trait Layout {
    const CONTACTS: &'static [Contact];
}

pub type V<const N: usize> = SVector<f64, N>;
type RowsOf<const N: usize, const R: usize> = Box<dyn Fn(&V<N>) -> SMatrix<f64, R, N>>;
type CurvatureOf<const N: usize, const R: usize> = Box<dyn Fn(&V<N>, &V<N>) -> V<R>>;
type ForceOf<const N: usize> = Box<dyn Fn(f64, &V<N>, &V<N>) -> V<N>>;

/// N coordinates with speeds of their own, C contacts, R rows.
pub struct Scene<L, const N: usize, const C: usize, const R: usize> {
    pub mass: V<N>,
    pub force: ForceOf<N>,
    pub potential: Box<dyn Fn(&V<N>) -> f64>,
    pub gaps: Box<dyn Fn(&V<N>) -> V<C>>,
    /// W, row by row.
    pub rows: RowsOf<N, R>,
    /// γ: the rates of W along the motion, times z.
    pub gamma: CurvatureOf<N, R>,
    pub friction: V<C>,
    pub restitution: V<C>,
    pub layout: PhantomData<L>,
}

impl<L, const N: usize, const C: usize, const R: usize> Scene<L, N, C, R> {
    /// Under weights alone, with constant rows: gaps are `offset + G q`.
    pub fn linear(mass: V<N>, weight: V<N>, offset: V<C>, rows: SMatrix<f64, R, N>) -> Self
    where
        L: Layout,
    {
        let gaps = move |q: &V<N>| V::<C>::from_fn(|i, _| offset[i] + (rows.row(L::CONTACTS[i].normal) * q)[0]);
        Self {
            mass,
            force: Box::new(move |_, _, _| weight),
            potential: Box::new(move |q| -weight.dot(q)),
            gaps: Box::new(gaps),
            rows: Box::new(move |_| rows),
            gamma: Box::new(|_, _| V::zeros()),
            friction: V::zeros(),
            restitution: V::zeros(),
            layout: PhantomData,
        }
    }

    pub fn friction(self, mu: [f64; C]) -> Self {
        Self { friction: mu.into(), ..self }
    }

    pub fn restitution(self, e: [f64; C]) -> Self {
        Self { restitution: e.into(), ..self }
    }

    pub fn force(self, force: impl Fn(f64, &V<N>, &V<N>) -> V<N> + 'static) -> Self {
        Self { force: Box::new(force), ..self }
    }
}

impl<L: Layout, const N: usize, const C: usize, const R: usize> GaussSystem for Scene<L, N, C, R> {
    type Scalar = f64;
    type Configuration = V<N>;
    type Speeds = V<N>;
    type MassMatrix = SMatrix<f64, N, N>;
    type Input = ();
    const DOF: usize = N;
    const CHART: Chart = Chart::Own;

    fn kinematics(&self, _: f64, _: &V<N>, z: &V<N>) -> V<N> {
        *z
    }
    fn acceleration(&self, t: f64, q: &V<N>, z: &V<N>, _: &()) -> V<N> {
        (self.force)(t, q, z).component_div(&self.mass)
    }
    fn momentum(&self, _: f64, _: &V<N>, z: &V<N>) -> V<N> {
        self.mass.component_mul(z)
    }
    fn velocity(&self, _: f64, _: &V<N>, p: &V<N>) -> V<N> {
        p.component_div(&self.mass)
    }
    fn momentum_rate(&self, t: f64, q: &V<N>, p: &V<N>, (): &()) -> V<N> {
        (self.force)(t, q, &self.velocity(t, q, p))
    }
    fn mass_matrix(&self, _: f64, _: &V<N>) -> SMatrix<f64, N, N> {
        SMatrix::from_diagonal(&self.mass)
    }
    fn kinetic_energy(&self, t: f64, q: &V<N>, z: &V<N>) -> f64 {
        0.5 * z.dot(&self.momentum(t, q, z))
    }
    fn potential_energy(&self, _: f64, q: &V<N>) -> f64 {
        (self.potential)(q)
    }
    fn gauss_residual(&self, t: f64, q: &V<N>, z: &V<N>, acceleration: &V<N>, (): &()) -> V<N> {
        self.momentum(t, q, acceleration) - (self.force)(t, q, z)
    }
    fn constraint_function(&self, t: f64, q: &V<N>, z: &V<N>, acceleration: &V<N>, (): &()) -> f64 {
        self.kinetic_energy(t, q, acceleration) - (self.force)(t, q, z).dot(acceleration)
    }
}

impl<L: Layout, const N: usize, const C: usize, const R: usize> ContactSystem for Scene<L, N, C, R> {
    type Gaps = V<C>;
    type ContactRows = V<R>;
    type ContactColumns = SMatrix<f64, N, R>;
    type ImpulseFactors = Self::ContactColumns;
    type Delassus = SMatrix<f64, R, R>;
    type EachContact<T: Copy + core::fmt::Debug> = [T; C];
    type EachRow<T: Copy + core::fmt::Debug> = [T; R];
    fn contacts(&self) -> &'static [Contact] {
        L::CONTACTS
    }

    fn gaps(&self, _: f64, q: &V<N>) -> V<C> {
        (self.gaps)(q)
    }
    fn contact_rates(&self, _: f64, q: &V<N>, z: &V<N>) -> V<R> {
        (self.rows)(q) * z
    }
    fn contact_jacobian(&self, _: f64, q: &V<N>) -> SMatrix<f64, N, R> {
        (self.rows)(q).transpose()
    }
    fn friction(&self, _: f64, _: &V<N>, _: &V<N>, (): &()) -> V<R> {
        let mut rows = V::zeros();
        for (contact, mu) in L::CONTACTS.iter().zip(self.friction.iter()) {
            contact.tangent_rows().for_each(|row| rows[row] = *mu);
        }
        rows
    }
    fn restitution(&self) -> V<C> {
        self.restitution
    }
    fn impulse_response(&self, _: f64, q: &V<N>) -> ImpulseResponse<Self> {
        let rows = (self.rows)(q);
        let columns = SMatrix::<f64, N, R>::from_fn(|i, j| rows[(j, i)] / self.mass[i]);
        ImpulseResponse::new(columns, rows * columns)
    }
    fn impulse_dynamics(&self, t: f64, q: &V<N>, z: &V<N>, input: &()) -> ImpulseDynamics<Self> {
        let free = self.acceleration(t, q, z, input);
        let bias = (self.rows)(q) * free + (self.gamma)(q, z);
        ImpulseDynamics::new(free, bias, self.impulse_response(t, q))
    }
    fn impulse_velocities(&self, columns: &Self::ImpulseFactors, impulses: &V<R>) -> V<N> {
        impulse_velocities::<Self>(columns, impulses)
    }
    fn impulse_terms(&self, columns: &Self::ImpulseFactors, impulses: &V<R>) -> V<N> {
        impulse_terms::<Self>(columns, impulses)
    }
    fn contact_columns(&self, columns: &Self::ImpulseFactors) -> Self::ContactColumns {
        *columns
    }
}

/// Numbers in (−1, 1): a linear congruence with the constants of Knuth's MMIX.
pub fn numbers(mut seed: u64) -> impl FnMut() -> f64 {
    move || {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (seed >> 11) as f64 / 4_503_599_627_370_496.0 - 1.0
    }
}
