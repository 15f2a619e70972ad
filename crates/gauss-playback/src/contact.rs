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
        self.shown.look_at(&format!("contact `{name}`"), &values);
        self.shown.page.contacts.push(Contact { name: name.to_owned(), touches, values });
    }
}

#[cfg(feature = "contact")]
mod of_runs {
    use gauss_contact::{ContactError, ContactRecord, Mode};
    use gauss_runtime::configuration::VectorSpace;
    use gauss_runtime::contact::{ContactFrame, ContactSystem};
    use gauss_runtime::prelude::Sample;

    use crate::page::Plane;
    use crate::playback::Playback;
    use crate::touch::Touch;

    impl<S: ContactSystem<Scalar = f64>> Playback<S> {
        /// All contacts of a run, from event to event or in steps, whose place the kernel knows, each with its force,
        /// as [`contact`](Self::contact) draws them, and the planes that stand still which they touch. Contacts whose
        /// gaps are written as expressions have no place that the kernel would know:
        /// [`contacts_at`](Self::contacts_at).
        #[must_use]
        pub fn contacts<'k>(self, kernel: &S, scale: f64, run: &impl ContactRecord<'k, S>) -> Self
        where
            S: 'k,
        {
            self.contacts_at(kernel, scale, run, |_, _| None)
        }

        /// The same, with the point, the normal and the tangents of contacts of which the kernel does not know them:
        /// those of a contact, by its place in [`contacts`](ContactSystem::contacts), at a state. A contact of which
        /// they are not always known is not drawn.
        #[must_use]
        pub fn contacts_at<'k>(
            mut self,
            kernel: &S,
            scale: f64,
            run: &impl ContactRecord<'k, S>,
            place: impl Fn(usize, &Sample<S>) -> Option<ContactFrame<f64>>,
        ) -> Self
        where
            S: 'k,
        {
            for (n, contact) in kernel.contacts().iter().enumerate() {
                let frame = |s: &Sample<S>| kernel.contact_frame(n, s.t, &s.q).or_else(|| place(n, s));
                let Some(frames) = self.samples.iter().map(frame).collect::<Option<Vec<_>>>() else { continue };
                if let Some(plane) = plane(kernel, n, &self.samples, &frames)
                    && !self.shown.page.planes.contains(&plane)
                {
                    self.shown.page.planes.push(plane);
                }
                let shown = self.samples.iter().zip(frames).map(|(s, frame)| {
                    let forces = *run.forces(s.t)?;
                    let rows: Vec<f64> = contact.rows().map(|row| forces.component(row)).collect();
                    Ok((touch(&run.modes(s.t)?[n]), frame.point, frame.force(&rows)))
                });
                match shown.collect::<Result<Vec<_>, ContactError>>() {
                    Ok(shown) => self.add_contact(contact.name, scale, shown),
                    Err(error) => self.shown.mistakes.push(format!("contact `{}`: {error}", contact.name)),
                }
            }
            self
        }
    }

    /// Number of roundings by which a plane may seem to move: points, normals and gaps are short sums.
    const ROUNDINGS: f64 = 64.0;

    /// The plane that a contact touches, as its normal and height, where it stands still.
    fn plane<S: ContactSystem<Scalar = f64>>(
        kernel: &S,
        contact: usize,
        samples: &[Sample<S>],
        frames: &[ContactFrame<f64>],
    ) -> Option<Plane> {
        if kernel.contacts()[contact].bodies[1].is_some() || !kernel.contacts()[contact].has_gap() {
            return None;
        }
        let seen = samples.iter().zip(frames).map(|(s, frame)| {
            let (gap, along) = (kernel.gaps(s.t, &s.q).component(contact), frame.normal.dot(&frame.point));
            (frame.normal, along - gap, along.abs().max(gap.abs()).max(frame.point.amax()))
        });
        let (normal, height, mut size) = seen.clone().next()?;
        for (other, its_height, its_size) in seen {
            size = size.max(its_size);
            let rounding = ROUNDINGS * f64::EPSILON;
            let is_still = (other - normal).amax() <= rounding && (its_height - height).abs() <= rounding * size;
            if !is_still {
                return None;
            }
        }
        Some(Plane { normal: normal.map(|x| x as f32).into(), height: height as f32 })
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
