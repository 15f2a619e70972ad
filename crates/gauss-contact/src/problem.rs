//! The equations of a segment as a method sees them.

use alloc::rc::Rc;

use gauss_runtime::contact::ContactSystem;
use gauss_runtime::integrate::Problem;
use gauss_runtime::integrate::problem::state::{Rates, State};
use gauss_runtime::system::GaussSystem;

use crate::mode::InMode;
use crate::trajectory::InputOf;

/// A system in its modes, under an input; in velocity form. It owns both, since trajectories do.
pub(crate) struct InModeProblem<'k, K: ContactSystem> {
    pub(crate) system: InMode<'k, K>,
    pub(crate) input: InputOf<'k, K>,
}

impl<K: ContactSystem> Clone for InModeProblem<'_, K> {
    fn clone(&self) -> Self {
        Self { system: self.system.clone(), input: Rc::clone(&self.input) }
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
        let variables = self.system.acceleration(*t, q, y, &self.input(*t, q, y));
        Rates { configuration: self.system.kinematics(*t, q, y), variables }
    }

    fn both_rates(&self, state: &State<InMode<'k, K>>, known: &K::Speeds) -> (K::Speeds, K::Speeds) {
        let State { t, q, y } = state;
        let p = self.system.momentum(*t, q, y);
        (*known, self.system.momentum_rate(*t, q, &p, &self.input(*t, q, y)))
    }
}
