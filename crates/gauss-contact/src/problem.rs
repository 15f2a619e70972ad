//! The equations of a segment as a method sees them.

use alloc::rc::Rc;
use core::cell::RefCell;

use gauss_runtime::configuration::{Configuration, VectorSpace};
use gauss_runtime::contact::ContactSystem;
use gauss_runtime::integrate::Problem;
use gauss_runtime::integrate::problem::state::{Rates, State};
use gauss_runtime::real::{Real, largest_derivative};
use gauss_runtime::system::GaussSystem;

use crate::dense::value;
use crate::mode::{InMode, Loads};
use crate::trajectory::InputOf;

/// A system in its modes, under an input; in velocity form. It owns both, since trajectories do.
pub(crate) struct InModeProblem<'k, K: ContactSystem> {
    pub(crate) system: InMode<'k, K>,
    pub(crate) input: InputOf<'k, K>,
    /// The state at which contact forces were asked for last, and they: each witness needs those at the end of a step.
    last: Rc<RefCell<Option<Known<K>>>>,
}

struct Known<K: ContactSystem> {
    state: (K::Scalar, K::Configuration, K::Speeds),
    loads: Rc<Loads<K>>,
}

impl<K: ContactSystem> Known<K> {
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
        Self { system: self.system.clone(), input: Rc::clone(&self.input), last: Rc::clone(&self.last) }
    }
}

impl<'k, K: ContactSystem> InModeProblem<'k, K> {
    pub(crate) fn new(system: InMode<'k, K>, input: InputOf<'k, K>) -> Self {
        Self { system, input, last: Rc::new(RefCell::new(None)) }
    }

    /// Contact forces at a state under the input.
    pub(crate) fn loads(&self, t: K::Scalar, q: &K::Configuration, z: &K::Speeds) -> Rc<Loads<K>> {
        if let Some(known) = self.last.borrow().as_ref().filter(|known| known.is_at(t, q, z)) {
            return Rc::clone(&known.loads);
        }
        let loads = Rc::new(self.system.loads(t, q, z, &(self.input)(t, q, z)));
        *self.last.borrow_mut() = Some(Known { state: (t, *q, *z), loads: Rc::clone(&loads) });
        loads
    }
}

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
        let configuration = match K::STATES {
            0 => self.system.kinematics(*t, q, y),
            _ => self.system.configuration_rates(*t, q, y, &self.input(*t, q, y)),
        };
        Rates { configuration, variables }
    }

    fn both_rates(&self, state: &State<InMode<'k, K>>, known: &K::Speeds) -> (K::Speeds, K::Speeds) {
        let State { t, q, y } = state;
        let p = self.system.momentum(*t, q, y);
        (*known, self.system.momentum_rate(*t, q, &p, &self.input(*t, q, y)))
    }
}
