//! Bodies that deform by modes: against particles that move as the modes say, against beams whose modes are known in
//! closed form, and in steady and starting spin.

mod beam;
mod particles;
mod refused;
mod spin;
