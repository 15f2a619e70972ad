//! Scenes in any scalar: for batches and ensembles.

use gauss_runtime::prelude::*;

use crate::scenes::{G, numbers};

/// Trajectory A: a free body that turns over.
#[derive(Clone, Copy, GaussDynamics)]
#[gauss(motion = fixed_point, taylor)]
pub struct FreeTop<T> {
    #[gauss(mass)]
    mass: T,
    #[gauss(inertia)]
    inertia: Vector3<T>,
}

/// Trajectory B: a heavy symmetric top.
#[derive(Clone, Copy, GaussDynamics)]
#[gauss(motion = fixed_point, center_of_mass = [0, 0, height], inertia = [across, across, along], taylor)]
pub struct SymmetricTop<T> {
    #[gauss(mass)]
    mass: T,
    across: T,
    along: T,
    height: T,
    #[gauss(gravity)]
    g: T,
}

/// S3; trajectory C.
#[derive(Clone, Copy, GaussDynamics)]
#[gauss(chart = left_invariant, taylor)]
pub struct Immersed<T> {
    #[gauss(mass)]
    mass: T,
    #[gauss(center_of_mass)]
    center: Vector3<T>,
    #[gauss(inertia)]
    inertia: Vector3<T>,
    #[gauss(added_mass)]
    added: Matrix6<T>,
    #[gauss(gravity)]
    g: T,
    #[gauss(displaced_mass)]
    displaced: T,
    #[gauss(center_of_buoyancy)]
    buoyancy: Vector3<T>,
}

/// S4.
#[derive(Clone, Copy, GaussDynamics)]
#[gauss(chart = jet(euler_zxz), motion = fixed_point, center_of_mass = [0, 0, distance])]
pub struct Top<T> {
    #[gauss(mass)]
    mass: T,
    #[gauss(inertia)]
    inertia: Vector3<T>,
    distance: T,
    #[gauss(gravity)]
    g: T,
}

/// S5.
#[derive(Clone, Copy, GaussDynamics)]
#[gauss(
    coordinates(a, b),
    body(
        upper, rotation = rotation_y(-a),
        mass = m1, center_of_mass = [0, 0, -c1], inertia_about_center_of_mass = i1
    ),
    body(
        lower, position = [length * sin(a), 0, -length * cos(a)], rotation = rotation_y(-b),
        mass = m2, center_of_mass = [0, 0, -c2], inertia_about_center_of_mass = i2
    ),
)]
pub struct DoublePendulum<T> {
    m1: T,
    c1: T,
    i1: T,
    m2: T,
    c2: T,
    i2: T,
    length: T,
    #[gauss(gravity)]
    g: T,
}

/// S6.
#[derive(Clone, Copy, GaussDynamics)]
#[gauss(
    coordinates(x, theta),
    particle(mass = cart, position = [x, 0, 0]),
    body(
        pole, position = [x, 0, 0], rotation = rotation_y(theta),
        mass = m, center_of_mass = [0, 0, distance], inertia_about_center_of_mass = moment
    ),
)]
pub struct CartPole<T> {
    cart: T,
    m: T,
    moment: T,
    distance: T,
    #[gauss(gravity)]
    g: T,
}

/// S7′: the arm of S7 with its hand and two fingers, from its file.
#[cfg(feature = "robots")]
#[derive(Clone, Copy, GaussDynamics)]
#[gauss(urdf = "../tests/robots/panda.urdf", inputs = none)]
pub struct Fingers<T> {
    #[gauss(gravity)]
    g: T,
}

/// S8: a quadruped whose base floats.
#[cfg(feature = "robots")]
#[derive(Clone, Copy, GaussDynamics)]
#[gauss(urdf = "../tests/robots/anymal.urdf", base = floating, inputs = none)]
pub struct Anymal<T> {
    #[gauss(gravity)]
    g: T,
}

/// A.
///
/// # Panics
/// Never, for the parameters of the scenes.
#[must_use]
pub fn free_top<T: Real>() -> FreeTopKernel<T> {
    FreeTop { mass: T::one(), inertia: Vector3::new(1.0, 2.0, 3.0).map(T::from_f64) }.kernel().expect("a body")
}

/// B.
///
/// # Panics
/// Never, for the parameters of the scenes.
#[must_use]
pub fn symmetric_top<T: Real>() -> SymmetricTopKernel<T> {
    let [mass, across, along, height, g] = [1.0, 1.0, 0.3, 0.5, G].map(T::from_f64);
    SymmetricTop { mass, across, along, height, g }.kernel().expect("a body")
}

/// S3, C.
///
/// # Panics
/// Never, for the parameters of the scenes.
#[must_use]
pub fn immersed<T: Real>() -> ImmersedKernel<T> {
    let n = T::from_f64;
    let ((weight, center), (buoyancy, point)) = (numbers::WEIGHT, numbers::BUOYANCY);
    let (mass, center, inertia) = (weight / G, Vector3::from(center), Vector3::new(1.0, 3.0, 3.0));
    let added = numbers::added_mass(mass, center, inertia).map(n);
    let (center, inertia, buoyancy_at) = (center.map(n), inertia.map(n), Vector3::from(point).map(n));
    let (mass, displaced) = (n(mass), n(buoyancy / G));
    Immersed { mass, center, inertia, added, g: n(G), displaced, buoyancy: buoyancy_at }.kernel().expect("a body")
}

/// S4.
///
/// # Panics
/// Never, for the parameters of the scenes.
#[must_use]
pub fn top<T: Real>() -> TopKernel<T> {
    let n = T::from_f64;
    let (mass, distance, inertia) = numbers::top();
    Top { mass: n(mass), inertia: inertia.map(n), distance: n(distance), g: n(G) }.kernel().expect("a body")
}

/// S5.
///
/// # Panics
/// Never, for the parameters of the scenes.
#[must_use]
pub fn double_pendulum<T: Real>() -> DoublePendulumKernel<T> {
    let [(m1, c1, i1), (m2, c2, i2)] = [numbers::UPPER, numbers::LOWER].map(in_scalar);
    let (length, g) = (T::from_f64(numbers::LENGTH), T::from_f64(G));
    DoublePendulum { m1, c1, i1, m2, c2, i2, length, g }.kernel().expect("a pendulum")
}

/// S6.
///
/// # Panics
/// Never, for the parameters of the scenes.
#[must_use]
pub fn cart_pole<T: Real>() -> CartPoleKernel<T> {
    let (m, distance, moment) = in_scalar(numbers::POLE);
    CartPole { cart: T::from_f64(numbers::CART), m, moment, distance, g: T::from_f64(G) }.kernel().expect("a cart")
}

/// S7′.
///
/// # Panics
/// Never: the numbers are those of the file.
#[cfg(feature = "robots")]
#[must_use]
pub fn fingers<T: Real>() -> FingersKernel<T> {
    Fingers { g: T::from_f64(G) }.kernel().expect("an arm")
}

/// S8.
///
/// # Panics
/// Never: the numbers are those of the file.
#[cfg(feature = "robots")]
#[must_use]
pub fn anymal<T: Real>() -> AnymalKernel<T> {
    Anymal { g: T::from_f64(G) }.kernel().expect("a quadruped")
}

fn in_scalar<T: Real>((m, c, i): numbers::Link) -> (T, T, T) {
    (T::from_f64(m), T::from_f64(c), T::from_f64(i))
}
