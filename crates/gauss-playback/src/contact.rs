//! Points that touch: a dot and an arrow, in the colour of what the contact does.

use gauss_runtime::prelude::{GaussSystem, Sample, Vector3};

use crate::page::Contact;
use crate::playback::Playback;
use crate::touch::Touch;

impl<S: GaussSystem<Scalar = f64>> Playback<S> {
    /// A contact: what it does, the point where it touches or would touch, and the force there, both by the observer.
    /// The point is drawn as a dot and the force as an arrow, before all bodies, in a colour for each [`Touch`].
    /// `scale` is as that of [`arrow`](Self::arrow).
    ///
    /// Of a run of `gauss-contact` the method `contacts`, with the feature `contact`, shows all of them.
    #[must_use]
    pub fn contact(
        mut self,
        name: &str,
        scale: f64,
        contact: impl Fn(&Sample<S>) -> (Touch, Vector3<f64>, Vector3<f64>),
    ) -> Self {
        let shown = self.samples.iter().map(contact).collect();
        self.add_contact(name, scale, shown);
        self
    }

    fn add_contact(&mut self, name: &str, scale: f64, shown: Vec<(Touch, Vector3<f64>, Vector3<f64>)>) {
        let row = |(touch, at, force): (Touch, Vector3<f64>, Vector3<f64>)| {
            (touch, [at.x, at.y, at.z, force.x * scale, force.y * scale, force.z * scale])
        };
        let (touches, values): (Vec<Touch>, Vec<[f64; 6]>) = shown.into_iter().map(row).unzip();
        self.look_at(&format!("contact `{name}`"), &values);
        self.page.contacts.push(Contact { name: name.to_owned(), touches, values });
    }
}

#[cfg(feature = "contact")]
mod of_runs {
    use gauss_contact::{ContactError, ContactTrajectory, Mode};
    use gauss_runtime::configuration::VectorSpace;
    use gauss_runtime::contact::{ContactFrame, ContactSystem};
    use gauss_runtime::prelude::Sample;

    use crate::playback::{PICTURES, Playback};
    use crate::touch::Touch;

    impl<S: ContactSystem<Scalar = f64>> Playback<S> {
        /// The playback of a run with contacts, at 600 times equally far apart, and before and after each event: what
        /// jumps there is not smoothed.
        ///
        /// # Errors
        /// [`ContactErrorKind::OutsideRun`](gauss_contact::ContactErrorKind::OutsideRun) of a run that ended before its
        /// first step.
        pub fn of_contacts(title: &str, run: &ContactTrajectory<'_, S>) -> Result<Self, ContactError> {
            let (mut times, span) = match (run.segments().first(), run.last()) {
                (Some(first), Some(last)) => {
                    let (first, gaps) = (first.trajectory().first().t, f64::from(PICTURES - 1));
                    let time = |n: u32| first + (last.t - first) * f64::from(n) / gaps;
                    ((0..PICTURES).map(|n| time(n).min(last.t)).collect(), last.t - first)
                }
                _ => (vec![0.0], 0.0),
            };
            // Of events that pile up no more than a screen shows.
            let least = span / f64::from(10 * PICTURES);
            let mut shown = f64::NEG_INFINITY;
            for event in run.events() {
                if event.time - shown > least && event.time > times[0] {
                    shown = event.time;
                    times.extend([event.time.next_down(), event.time]);
                }
            }
            times.sort_by(f64::total_cmp);
            times.dedup();
            Ok(Self::of_samples(title, run.at_times(times)?))
        }

        /// All contacts of a run whose place the kernel knows, each with its force, as [`contact`](Self::contact) draws
        /// them. Contacts whose gaps are written as expressions have no place that the kernel would know:
        /// [`contacts_at`](Self::contacts_at).
        #[must_use]
        pub fn contacts(self, kernel: &S, scale: f64, run: &ContactTrajectory<'_, S>) -> Self {
            self.contacts_at(kernel, scale, run, |_, _| None)
        }

        /// The same, with the point, the normal and the tangents of contacts of which the kernel does not know them:
        /// those of a contact, by its place in [`CONTACTS`](ContactSystem::CONTACTS), at a state. A contact of which
        /// they are not always known is not drawn.
        #[must_use]
        pub fn contacts_at(
            mut self,
            kernel: &S,
            scale: f64,
            run: &ContactTrajectory<'_, S>,
            place: impl Fn(usize, &Sample<S>) -> Option<ContactFrame<f64>>,
        ) -> Self {
            for (n, contact) in S::CONTACTS.iter().enumerate() {
                let frame = |s: &Sample<S>| kernel.contact_frame(n, s.t, &s.q).or_else(|| place(n, s));
                let Some(frames) = self.samples.iter().map(frame).collect::<Option<Vec<_>>>() else { continue };
                let shown = self.samples.iter().zip(frames).map(|(s, frame)| {
                    let forces = run.forces(s.t)?;
                    let rows: Vec<f64> = contact.rows().map(|row| forces.component(row)).collect();
                    Ok((touch(&run.modes(s.t)?[n]), frame.point, frame.force(&rows)))
                });
                match shown.collect::<Result<Vec<_>, ContactError>>() {
                    Ok(shown) => self.add_contact(contact.name, scale, shown),
                    Err(error) => self.mistakes.push(format!("contact `{}`: {error}", contact.name)),
                }
            }
            self
        }
    }

    fn touch(mode: &Mode<f64>) -> Touch {
        match mode {
            Mode::Open => Touch::Open,
            Mode::Closed => Touch::Closed,
            Mode::Sticks => Touch::Sticks,
            Mode::Slides(_) => Touch::Slides,
        }
    }
}
