//! The modes that contacts have at a state.

use alloc::rc::Rc;
use alloc::vec;
use alloc::vec::Vec;
use core::ops::Range;

use gauss_runtime::configuration::{Configuration, VectorSpace};
use gauss_runtime::contact::{Contact, ContactSystem};
use gauss_runtime::integrate::drive::tolerance::Tolerance;
use gauss_runtime::real::Real;
use gauss_runtime::system::GaussSystem;

use crate::decide::{Instant, Scales};
use crate::dense::value;
use crate::error::{ContactError, ContactErrorKind};
use crate::impact::Impact;
use crate::mode::{InMode, Mode};
use crate::rounding::Rounding;
use crate::sensors::ContactForces;
use crate::trajectory::{ContactTrajectory, InputOf};

impl<'k, K: ContactSystem> InMode<'k, K> {
    /// The system in the modes that its contacts have at a state under an input, as a run finds them that starts there:
    /// its [`acceleration`](gauss_runtime::system::GaussSystem::acceleration) is that with contact forces, where the
    /// kernel's own has all gaps open.
    ///
    /// A contact whose gap and rates are rounding counts as closed, and as still: what it would do by these rates is
    /// less than places are known to.
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
        let jams = false;
        let (q, z) = at_rest(kernel, t, (&q.renormalise(), z), &(made.input)(t, q, z));
        let rates = kernel.contact_rates(t, &q, &z);
        let mut instant = Instant { kernel, t, q, z, modes, fired: None, first: true, jumped: false, jams };
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

    /// Forces of the contacts in these modes at a state under an input; see
    /// [`ContactTrajectory::forces`] for those of contacts that depend on one another.
    pub fn contact_forces(
        &self,
        t: K::Scalar,
        q: &K::Configuration,
        z: &K::Speeds,
        input: &K::Input,
    ) -> ContactForces<'k, K> {
        let least = self.loads(t, q, z, input);
        let keeps = self.keeps_laws(&least, &self.kernel.friction(t, q, z, input));
        let shared = if keeps { None } else { self.reserve((t, q, z), input) };
        let mut forces = K::ContactRows::zero();
        let found = shared.map_or(least.forces, |shared| shared.forces);
        found.iter().enumerate().for_each(|(row, force)| forces.set_component(row, *force));
        ContactForces::new(self.kernel, t, *q, forces)
    }
}

/// The state with gaps and rates at zero where they are no more than rounding: a rate v is none where what it leads
/// away, v²/2a at the acceleration a without contact forces, is less than places are known to. States that steps have
/// made have such rates.
fn at_rest<K: ContactSystem>(
    kernel: &K,
    t: K::Scalar,
    (q, z): (&K::Configuration, &K::Speeds),
    input: &K::Input,
) -> (K::Configuration, K::Speeds) {
    let (gaps, rates) = (kernel.gaps(t, q), kernel.contact_rates(t, q, z));
    let bias = kernel.impulse_dynamics(t, q, z, input).bias;
    let rounding = Rounding::of::<K>(q).some_digits();
    let still = |contact: &Contact, rows: Range<usize>| {
        let fastest = contact.rows().map(|row| value(bias.component(row)).abs()).fold(0.0, f64::max);
        rows.into_iter().all(|row| value(rates.component(row)).abs() <= Real::sqrt(2.0 * fastest * rounding))
    };
    let mode = |(i, contact): (usize, &Contact)| {
        let normal = contact.normal..contact.normal + usize::from(contact.has_gap());
        let lies = contact.has_gap() && value(gaps.component(i)).abs() <= rounding && still(contact, normal);
        match (lies, still(contact, contact.friction_rows())) {
            (true, true) => Mode::Sticks,
            (true, false) => Mode::Closed,
            _ => Mode::Open,
        }
    };
    let modes: Vec<Mode<K::Scalar>> = kernel.contacts().iter().enumerate().map(mode).collect();
    let lying = InMode::new(kernel, &modes);
    if lying.is_open() { (*q, *z) } else { lying.project(t, q, z).unwrap_or((*q, *z)) }
}
