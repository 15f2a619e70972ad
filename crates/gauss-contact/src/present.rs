//! The modes that contacts have at a state.

use alloc::rc::Rc;
use alloc::vec;
use alloc::vec::Vec;

use gauss_runtime::configuration::{Configuration, VectorSpace};
use gauss_runtime::contact::ContactSystem;
use gauss_runtime::integrate::drive::tolerance::Tolerance;

use crate::decide::{Instant, Scales};
use crate::dense::value;
use crate::error::{ContactError, ContactErrorKind};
use crate::impact::Impact;
use crate::mode::{InMode, Mode};
use crate::trajectory::{ContactTrajectory, InputOf};

impl<'k, K: ContactSystem> InMode<'k, K> {
    /// The system in the modes that its contacts have at a state under an input, as a run finds them that starts there:
    /// its [`acceleration`](gauss_runtime::system::GaussSystem::acceleration) is that with contact forces, where the
    /// kernel's own has all gaps open.
    ///
    /// # Errors
    /// Where a run could not start, and [`ContactErrorKind::Strikes`] where a closed gap is closing: an impact comes
    /// first, and accelerations are not finite.
    pub fn at(
        kernel: &'k K,
        t: K::Scalar,
        q: &K::Configuration,
        z: &K::Speeds,
        input: &K::Input,
    ) -> Result<Self, ContactError> {
        crate::start::check(kernel, t, q, z)?;
        let input = *input;
        let input: InputOf<'_, K> = Rc::new(move |_, _, _| input);
        let tolerance = Tolerance { relative: 1e-9, absolute: 1e-9 };
        let mut scales = Scales::new(tolerance, Impact::Newton, t);
        let mut made = ContactTrajectory::begun(input);
        let modes = vec![Mode::Open; kernel.contacts().len()];
        let (q, jams) = (q.renormalise(), false);
        let mut instant = Instant { kernel, t, q, z: *z, modes, fired: None, first: true, jams };
        let rates = kernel.contact_rates(t, &instant.q, z);
        instant.decide(&mut scales, &mut made)?;
        if let Some(impact) = made.solves.iter().find(|solve| solve.impact) {
            let struck: Vec<usize> = impact.residuals.iter().map(|(contact, _)| *contact).collect();
            let rate = |i: &usize| value(rates.component(kernel.contacts()[*i].normal));
            let fastest = struck.into_iter().filter(|i| kernel.contacts()[*i].has_gap());
            if let Some(i) = fastest.min_by(|a, b| rate(a).total_cmp(&rate(b))) {
                let kind = ContactErrorKind::Strikes { rate: rate(&i) };
                return Err(ContactError { contact: Some(kernel.contacts()[i].name), time: value(t), kind });
            }
        }
        Ok(Self::new(kernel, &instant.modes))
    }
}
