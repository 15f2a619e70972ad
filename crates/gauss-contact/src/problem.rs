//! The equations of a segment as a method sees them.

use alloc::rc::Rc;
use alloc::vec;
use alloc::vec::Vec;
use core::cell::RefCell;

use gauss_runtime::configuration::{Configuration, VectorSpace};
use gauss_runtime::contact::{Contact, ContactSystem};
use gauss_runtime::forces::Columns;
use gauss_runtime::integrate::Problem;
use gauss_runtime::integrate::problem::state::{Rates, State};
use gauss_runtime::real::{Real, largest_derivative};
use gauss_runtime::system::GaussSystem;

use crate::dense::value;
use crate::mode::{InMode, Loads};
use crate::moving::MovingGaps;
use crate::trajectory::InputOf;

/// A system in its modes, under an input; in velocity form. It owns both, since trajectories do.
pub(crate) struct InModeProblem<'k, K: ContactSystem> {
    pub(crate) system: InMode<'k, K>,
    pub(crate) input: InputOf<'k, K>,
    /// The state at which contact forces were asked for last, and they: each witness needs those at the end of a step.
    last: Rc<RefCell<Memo<K, Loads<K>>>>,
    /// Bounds of the rates of the gaps at the last two states that were asked for: the ends of a step.
    fast: Rc<RefCell<[Memo<K, Fastest>; 2]>>,
    /// The largest entry of D of each normal so far.
    light: Rc<RefCell<Vec<f64>>>,
    /// The largest rate at which each gap changes with the time alone.
    pub(crate) moving: MovingGaps,
}

/// Bounds of the rate of each gap, and of how fast that can change.
type Fastest = Vec<[f64; 2]>;

/// A quantity at the last state at which it was asked for.
type Memo<K, T> = Option<Known<K, T>>;

struct Known<K: ContactSystem, T> {
    state: (K::Scalar, K::Configuration, K::Speeds),
    what: Rc<T>,
}

impl<K: ContactSystem, T> Known<K, T> {
    fn is_at(&self, t: K::Scalar, q: &K::Configuration, z: &K::Speeds) -> bool {
        // With their derivatives.
        fn same<T: Real>(a: T, b: T) -> bool {
            value(a) == value(b) && largest_derivative(a - b) == 0.0
        }
        fn all_same<T: Real, V: VectorSpace<T>>(a: &V, b: &V) -> bool {
            (0..V::DIM).all(|i| same(a.component(i), b.component(i)))
        }
        let (t0, q0, z0) = &self.state;
        same(*t0, t) && all_same(z0, z) && all_same(&q0.components(), &q.components())
    }
}

impl<K: ContactSystem> Clone for InModeProblem<'_, K> {
    fn clone(&self) -> Self {
        let Self { system, input, last, fast, light, moving } = self;
        let (last, fast, light) = (Rc::clone(last), Rc::clone(fast), Rc::clone(light));
        let (system, input, moving) = (system.clone(), Rc::clone(input), moving.clone());
        Self { system, input, last, fast, light, moving }
    }
}

impl<'k, K: ContactSystem> InModeProblem<'k, K> {
    /// The problem of a system in its modes under an input.
    pub(crate) fn new(system: InMode<'k, K>, input: InputOf<'k, K>, moving: MovingGaps) -> Self {
        let (last, light) =
            (Rc::new(RefCell::new(None)), Rc::new(RefCell::new(vec![0.0; system.kernel.contacts().len()])));
        Self { system, input, last, fast: Rc::new(RefCell::new([None, None])), light, moving }
    }

    /// Contact forces at a state under the input.
    pub(crate) fn loads(&self, t: K::Scalar, q: &K::Configuration, z: &K::Speeds) -> Rc<Loads<K>> {
        if let Some(known) = self.last.borrow().as_ref().filter(|known| known.is_at(t, q, z)) {
            return Rc::clone(&known.what);
        }
        let loads = Rc::new(self.system.loads(t, q, z, &(self.input)(t, q, z)));
        *self.last.borrow_mut() = Some(Known { state: (t, *q, *z), what: Rc::clone(&loads) });
        loads
    }

    /// Bounds of the rate of each open gap at the speeds of a state, whatever way its normal turns, and of how fast
    /// that can grow.
    ///
    /// `ġ = G z + g_t`, and `|G z|² ≤ D·zᵀA z` with `D = G A⁻¹Gᵀ`: no motion of that kinetic energy changes the gap
    /// faster, so that a gap between two bodies is bounded by the speeds of both, along the normal or across it. Of the
    /// energy that part counts whose speeds have a part in the gap, where masses do not couple it with the rest.
    pub(crate) fn bounds(&self, state: &State<InMode<'k, K>>, rates: &Rates<InMode<'k, K>>) -> Rc<Vec<[f64; 2]>> {
        let State { t, q, y } = state;
        let mut fast = self.fast.borrow_mut();
        if let Some(known) = fast.iter().flatten().find(|known| known.is_at(*t, q, y)) {
            return Rc::clone(&known.what);
        }
        let what = Rc::new(self.bounds_at(state, rates));
        fast.swap(0, 1);
        fast[1] = Some(Known { state: (*t, *q, *y), what: Rc::clone(&what) });
        what
    }

    fn bounds_at(&self, state: &State<InMode<'k, K>>, rates: &Rates<InMode<'k, K>>) -> Vec<[f64; 2]> {
        let State { t, q, y } = state;
        let (kernel, still) = (self.system.kernel, K::Speeds::zero());
        let loads = self.loads(*t, q, y);
        let response = &loads.dynamics.response;
        let (without, moving) = (kernel.momentum(*t, q, &still), kernel.contact_rates(*t, q, &still));
        let momentum = |z: &K::Speeds| kernel.momentum(*t, q, z).add_scaled(-K::Scalar::one(), &without);
        let [energy, power] = [y, &rates.variables].map(|z| Twice::new(*z, momentum(z)));
        let mut light = self.light.borrow_mut();
        let bound = |(i, contact): (usize, &Contact)| {
            let row = contact.normal;
            let is_open = contact.has_gap() && !self.system.modes().get(i).is_some_and(|mode| mode.is_closed());
            let Some(column) = response.columns.nth(row).filter(|_| is_open) else { return [0.0; 2] };
            light[i] = light[i].max(value(response.delassus[(row, row)]));
            let fastest = |twice: &Twice<K>| Real::sqrt(light[i] * twice.of(&column, &momentum).max(0.0));
            let grows = value(loads.row_acceleration(row)).abs();
            let moving = value(moving.component(row)).abs().max(self.moving.rates[i]);
            [fastest(&energy) + moving, fastest(&power) + grows]
        };
        self.system.kernel.contacts().iter().enumerate().map(bound).collect()
    }
}

/// Speeds, or their rates, with their momenta: `zᵀA z` of all, or of some.
struct Twice<K: ContactSystem> {
    z: K::Speeds,
    p: K::Speeds,
}

impl<K: ContactSystem> Twice<K> {
    fn new(z: K::Speeds, p: K::Speeds) -> Self {
        Self { z, p }
    }

    /// `zᵀA z` of the speeds with a part in a gap, given by its column of A⁻¹Gᵀ.
    fn of(&self, column: &K::Speeds, momentum: &impl Fn(&K::Speeds) -> K::Speeds) -> f64 {
        let takes_part = |j: &usize| value(column.component(*j)) != 0.0;
        let sum = |of: &mut dyn Iterator<Item = usize>| -> f64 {
            of.map(|j| value(self.z.component(j) * self.p.component(j))).sum()
        };
        let all = 0..K::Speeds::DIM;
        if all.clone().all(|j| takes_part(&j)) {
            return sum(&mut all.clone());
        }
        let mut alone = self.z;
        all.clone().filter(|j| !takes_part(j)).for_each(|j| alone.set_component(j, K::Scalar::zero()));
        let (of_alone, rounding) = (momentum(&alone), COUPLED * self.p.max_norm());
        let apart = |j: usize| value(of_alone.component(j) - self.p.component(j)).abs() <= rounding;
        if all.clone().filter(takes_part).all(apart) { sum(&mut all.filter(takes_part)) } else { sum(&mut all.clone()) }
    }
}

/// Masses couple speeds where one changes momenta of others by more than this part.
const COUPLED: f64 = 1e-12;

impl<'k, K: ContactSystem> Problem for InModeProblem<'k, K> {
    type System = InMode<'k, K>;

    fn system(&self) -> &InMode<'k, K> {
        &self.system
    }

    fn input(&self, t: K::Scalar, q: &K::Configuration, z: &K::Speeds) -> K::Input {
        (self.input)(t, q, z)
    }

    fn variables(&self, _: K::Scalar, _: &K::Configuration, z: &K::Speeds) -> K::Speeds {
        *z
    }

    fn of_momentum(&self, t: K::Scalar, q: &K::Configuration, p: &K::Speeds) -> K::Speeds {
        self.system.velocity(t, q, p)
    }

    fn speeds(&self, _: K::Scalar, _: &K::Configuration, y: &K::Speeds) -> K::Speeds {
        *y
    }

    fn momentum(&self, t: K::Scalar, q: &K::Configuration, y: &K::Speeds) -> K::Speeds {
        self.system.momentum(t, q, y)
    }

    fn rates(&self, state: &State<InMode<'k, K>>) -> Rates<InMode<'k, K>> {
        let State { t, q, y } = state;
        let variables = if self.system.is_open() {
            self.system.acceleration(*t, q, y, &self.input(*t, q, y))
        } else {
            self.loads(*t, q, y).acceleration()
        };
        let configuration = match self.system.states() {
            0 => self.system.kinematics(*t, q, y),
            _ => self.system.configuration_rates(*t, q, y, &self.input(*t, q, y)),
        };
        Rates { configuration, variables }
    }

    fn hides_action(&self) -> bool {
        !self.system.is_open()
    }

    fn action(&self, state: &State<InMode<'k, K>>, rates: Option<&Rates<InMode<'k, K>>>) -> K::Speeds {
        let State { t, q, y } = state;
        match rates {
            Some(rates) if self.system.is_open() => rates.variables,
            _ => self.system.action(*t, q, y, &self.input(*t, q, y)),
        }
    }

    fn both_rates(&self, state: &State<InMode<'k, K>>, known: &K::Speeds) -> (K::Speeds, K::Speeds) {
        let State { t, q, y } = state;
        let p = self.system.momentum(*t, q, y);
        (*known, self.system.momentum_rate(*t, q, &p, &self.input(*t, q, y)))
    }
}
