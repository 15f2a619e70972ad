//! Measurements of sensors at contacts: forces, wrenches of several, centres of pressure.

use alloc::borrow::ToOwned;
use alloc::string::String;
use alloc::vec::Vec;
use core::fmt;
use core::ops::Deref;

use gauss_runtime::configuration::VectorSpace;
use gauss_runtime::contact::{Contact, ContactFrame, ContactSystem};
use gauss_runtime::nalgebra::Vector3;
use gauss_runtime::real::Real;

use crate::dense::{epsilon, value};
use crate::rounding::Rounding;

/// A contact force as a vector: components along the observer's axes, the point is from Ω.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct ContactForce<T = f64> {
    /// The contact, by its place in [`ContactSystem::contacts`].
    pub contact: usize,
    /// Point at which it acts.
    pub point: Vector3<T>,
    /// The force on the first body.
    pub force: Vector3<T>,
}

/// Forces put together: components along the observer's axes.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct ContactWrench<T = f64> {
    /// Their sum.
    pub force: Vector3<T>,
    /// The sum of their moments about the pole.
    pub moment: Vector3<T>,
}

/// Why contacts give no vector.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum SensorError {
    /// No contact has this number.
    NoSuchContact {
        /// The number.
        contact: usize,
        /// Number of contacts.
        count: usize,
    },
    /// No contact is one of a body, a frame or a link with this name.
    NoSuchBody {
        /// The name.
        body: String,
    },
    /// The point at which it acts is not known: a gap that is written, a range, or dry friction.
    NoPlace {
        /// The name of the contact.
        contact: &'static str,
    },
    /// It has a torque, of drilling or rolling, which is no force at a point.
    Torque {
        /// The name of the contact.
        contact: &'static str,
    },
    /// Two contacts that bear are not on one plane.
    NoCommonPlane {
        /// The names of both.
        contacts: [&'static str; 2],
    },
}

impl fmt::Display for SensorError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoSuchContact { contact, count } => write!(f, "there is no contact {contact}: there are {count}"),
            Self::NoSuchBody { body } => write!(f, "no contact is one of a body `{body}`"),
            Self::NoPlace { contact } => write!(f, "where `{contact}` acts is not known; write it by `point = …`"),
            Self::Torque { contact } => {
                write!(f, "`{contact}` has a torque of drilling or rolling, which is no force at a point")
            }
            Self::NoCommonPlane { contacts: [first, second] } => {
                write!(f, "`{first}` and `{second}` bear on different planes, which have no common centre of pressure")
            }
        }
    }
}

impl core::error::Error for SensorError {}

/// The forces of all contacts at one time: `run.forces(t)` of a run from event to event or in steps
/// ([`ContactRecord::forces`](crate::ContactRecord::forces)), `stepper.forces()`. It can be used as its rows: normal,
/// then tangents, then the spin, contact by contact; of dry friction and rolling resistance tangents alone. A step has
/// the mean forces over its length, its impulses by its length.
pub struct ContactForces<'k, K: ContactSystem> {
    kernel: &'k K,
    t: K::Scalar,
    q: K::Configuration,
    rows: K::ContactRows,
}

impl<K: ContactSystem> Copy for ContactForces<'_, K> {}

impl<K: ContactSystem> Clone for ContactForces<'_, K> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<K: ContactSystem> fmt::Debug for ContactForces<'_, K> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { t, q, rows, .. } = self;
        f.debug_struct("ContactForces").field("t", t).field("q", q).field("rows", rows).finish()
    }
}

impl<K: ContactSystem> Deref for ContactForces<'_, K> {
    type Target = K::ContactRows;

    fn deref(&self) -> &K::ContactRows {
        &self.rows
    }
}

impl<'k, K: ContactSystem> ContactForces<'k, K> {
    /// Sensors of forces that are known row by row, at a configuration.
    pub fn new(kernel: &'k K, t: K::Scalar, q: K::Configuration, rows: K::ContactRows) -> Self {
        Self { kernel, t, q, rows }
    }

    /// Row by row: normal, tangents, spin, contact by contact.
    pub fn rows(&self) -> &K::ContactRows {
        &self.rows
    }

    /// The force along the normal of a contact and along its tangents, on the first body; zero along those that it has
    /// not.
    ///
    /// # Errors
    /// `NoSuchContact`.
    pub fn in_frame(&self, contact: usize) -> Result<[K::Scalar; 3], SensorError> {
        let own = known(self.kernel, contact)?;
        let mut force = [K::Scalar::zero(); 3];
        if own.has_gap() {
            force[0] = self.rows.component(own.normal);
        }
        own.tangent_rows().zip(&mut force[1..]).for_each(|(row, part)| *part = self.rows.component(row));
        Ok(force)
    }

    /// All forces as vectors, each with where it acts: of contacts that have one, and whose place is known
    /// ([`contact_frame`](ContactSystem::contact_frame)).
    pub fn vectors(&self) -> Vec<ContactForce<K::Scalar>> {
        let acts = |contact: &usize| !self.rests(*contact).unwrap_or(true);
        (0..self.kernel.contacts().len()).filter(acts).filter_map(|contact| self.in_world(contact).ok()).collect()
    }

    /// The force of a contact on its first body, and where it acts.
    ///
    /// # Errors
    /// `NoSuchContact`, `NoPlace`.
    pub fn in_world(&self, contact: usize) -> Result<ContactForce<K::Scalar>, SensorError> {
        let (_, frame) = self.placed(contact)?;
        Ok(ContactForce { contact, point: frame.point, force: frame.force(&self.in_frame(contact)?) })
    }

    /// The numbers of all contacts whose first body has this name, also a frame's or that of a link of a robot's file.
    ///
    /// # Errors
    /// `NoSuchBody` where there are none.
    pub fn of_body(&self, body: &str) -> Result<impl Iterator<Item = usize> + Clone + use<K>, SensorError> {
        let contacts = self.kernel.contacts();
        let (mut first, mut count) = (contacts.len(), 0);
        for (i, contact) in contacts.iter().enumerate() {
            if contact.bodies[0] == Some(body) {
                (first, count) = (first.min(i), count + 1);
            }
        }
        if count == 0 {
            return Err(SensorError::NoSuchBody { body: body.to_owned() });
        }
        let name = contacts[first].bodies[0];
        Ok((first..contacts.len()).filter(move |i| contacts[*i].bodies[0] == name))
    }

    /// Wrench of some contacts together on their first bodies: the sum of their forces, and that of their moments about
    /// a pole, from Ω in the observer's axes. One that is named twice counts twice.
    ///
    /// # Errors
    /// `NoSuchContact`, `NoPlace`, `Torque` of contacts with a force.
    pub fn wrench(
        &self,
        contacts: impl IntoIterator<Item = usize>,
        pole: &Vector3<K::Scalar>,
    ) -> Result<ContactWrench<K::Scalar>, SensorError> {
        let mut sum = nothing();
        for contact in contacts {
            self.add(&mut sum, contact, pole, false)?;
        }
        Ok(sum)
    }

    /// Wrench of all contacts of a body on it: those that have it first, and the opposite of those that touch it.
    ///
    /// # Errors
    /// `NoSuchBody` where there are none, `NoPlace`, `Torque`.
    pub fn wrench_on(&self, body: &str, pole: &Vector3<K::Scalar>) -> Result<ContactWrench<K::Scalar>, SensorError> {
        let (mut sum, mut found) = (nothing(), false);
        for (i, contact) in self.kernel.contacts().iter().enumerate() {
            for (side, _) in contact.bodies.iter().enumerate().filter(|(_, own)| **own == Some(body)) {
                found = true;
                self.add(&mut sum, i, pole, side == 1)?;
            }
        }
        if found { Ok(sum) } else { Err(SensorError::NoSuchBody { body: body.to_owned() }) }
    }

    /// Point at which the normal forces of some contacts on one plane would act together: about this point of the plane
    /// they have no moment. `None` where there is no normal force. Contacts without a force may be anywhere.
    ///
    /// # Errors
    /// `NoSuchContact`; `NoPlace`, `Torque`, and `NoCommonPlane` of contacts with a force. Planes are one where normals
    /// and heights agree in half of their digits.
    pub fn center_of_pressure(
        &self,
        contacts: impl IntoIterator<Item = usize>,
    ) -> Result<Option<Vector3<K::Scalar>>, SensorError> {
        let gaps = self.kernel.gaps(self.t, &self.q);
        let mut first: Option<(usize, [f64; 4])> = None;
        let mut moments = zero();
        let mut pressure = K::Scalar::zero();
        for contact in contacts {
            if self.rests(contact)? {
                continue;
            }
            let (own, frame) = self.placed(contact)?;
            if own.drills && value(self.rows.component(own.tangent_rows().end)) != 0.0 {
                return Err(SensorError::Torque { contact: own.name });
            }
            // Where the foot of the contact on the plane is: after an impact it is above.
            let gap = gaps.component(contact);
            let foot = frame.point - frame.normal.map(|n| n * gap);
            let plane = plane(&frame.normal, &foot);
            match first {
                Some((other, known)) if !self.agree(known, plane) => {
                    return Err(SensorError::NoCommonPlane {
                        contacts: [self.kernel.contacts()[other].name, own.name],
                    });
                }
                Some(_) => {}
                None => first = Some((contact, plane)),
            }
            let normal = self.rows.component(own.normal);
            pressure += normal;
            moments += foot.map(|x| x * normal);
        }
        Ok((value(pressure) > 0.0).then(|| moments.map(|moment| moment / pressure)))
    }

    /// Whether all rows of a contact are zero.
    fn rests(&self, contact: usize) -> Result<bool, SensorError> {
        Ok(known(self.kernel, contact)?.rows().all(|row| value(self.rows.component(row)) == 0.0))
    }

    /// A contact with its frame.
    fn placed(&self, contact: usize) -> Result<(&'static Contact, ContactFrame<K::Scalar>), SensorError> {
        let own = known(self.kernel, contact)?;
        if own.rolls_on().is_some() {
            return Err(SensorError::Torque { contact: own.name });
        }
        let frame = self.kernel.contact_frame(contact, self.t, &self.q);
        Ok((own, frame.ok_or(SensorError::NoPlace { contact: own.name })?))
    }

    /// Adds a force, or its opposite.
    fn add(
        &self,
        sum: &mut ContactWrench<K::Scalar>,
        contact: usize,
        pole: &Vector3<K::Scalar>,
        opposite: bool,
    ) -> Result<(), SensorError> {
        if self.rests(contact)? {
            return Ok(());
        }
        let ContactForce { point, force, .. } = self.in_world(contact)?;
        let own = &self.kernel.contacts()[contact];
        if own.drills && value(self.rows.component(own.tangent_rows().end)) != 0.0 {
            return Err(SensorError::Torque { contact: own.name });
        }
        let force = if opposite { force.map(|part| -part) } else { force };
        sum.force += force;
        sum.moment += (point - pole).cross(&force);
        Ok(())
    }

    /// Whether two planes agree in half of the digits.
    fn agree(&self, a: [f64; 4], b: [f64; 4]) -> bool {
        let of_normal = Real::sqrt(epsilon::<K::Scalar>());
        let of_height = Rounding::of::<K>(&self.q).half_of_the_digits();
        (0..3).all(|i| (a[i] - b[i]).abs() <= of_normal) && (a[3] - b[3]).abs() <= of_height
    }
}

/// Normal and height.
fn plane<T: Real>(normal: &Vector3<T>, point: &Vector3<T>) -> [f64; 4] {
    let ([a, b, c], [x, y, z]) = ([0, 1, 2].map(|i| value(normal[i])), [0, 1, 2].map(|i| value(point[i])));
    [a, b, c, a * x + b * y + c * z]
}

fn known<K: ContactSystem>(kernel: &K, contact: usize) -> Result<&'static Contact, SensorError> {
    let count = kernel.contacts().len();
    kernel.contacts().get(contact).ok_or(SensorError::NoSuchContact { contact, count })
}

fn zero<T: Real>() -> Vector3<T> {
    Vector3::repeat(T::zero())
}

fn nothing<T: Real>() -> ContactWrench<T> {
    ContactWrench { force: zero(), moment: zero() }
}
