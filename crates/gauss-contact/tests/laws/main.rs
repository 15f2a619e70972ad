//! The laws of contact, friction and impact in runs, scene by scene, against closed forms.

mod accounts;
mod border;
mod bounces;
mod common;
mod dry;
mod edges;
mod friction;
mod hostile;
mod impacts;
mod marks;
mod passing;
mod pushes;
mod rod;
mod spatial;
mod steps;
mod tossed;
mod turning;
