//! What is timed.

use std::cell::Cell;
use std::error::Error;

use gauss_benches::measure::Way;
use gauss_benches::scenes::{self, G, about_pole};
use gauss_benches::states::Random;
use gauss_runtime::prelude::*;

/// States of a kind of configuration, and what waits for a number that does not change it.
trait Place: Copy + 'static {
    fn random(random: &mut Random) -> Self;
    /// Adds `nothing`, which is below every rounding, to every number.
    fn waiting_for(self, nothing: f64) -> Self;
}

fn vector<const N: usize>(random: &mut Random, size: f64) -> SVector<f64, N> {
    SVector::from_fn(|_, _| size * random.number())
}

impl Place for Isometry3<f64> {
    fn random(random: &mut Random) -> Self {
        Self::new(vector(random, 1.0), vector(random, 3.0))
    }
    fn waiting_for(mut self, nothing: f64) -> Self {
        self.rotation = self.rotation.waiting_for(nothing);
        self.translation.vector.add_scalar_mut(nothing);
        self
    }
}

impl Place for UnitQuaternion<f64> {
    fn random(random: &mut Random) -> Self {
        Self::from_scaled_axis(vector::<3>(random, 3.0))
    }
    fn waiting_for(mut self, nothing: f64) -> Self {
        self.as_mut_unchecked().coords.add_scalar_mut(nothing);
        self
    }
}

impl Place for Isometry2<f64> {
    fn random(random: &mut Random) -> Self {
        Self::new(vector(random, 1.0), 3.0 * random.number())
    }
    fn waiting_for(mut self, nothing: f64) -> Self {
        let turn = self.rotation.as_mut_unchecked();
        (turn.re, turn.im) = (turn.re + nothing, turn.im + nothing);
        self.translation.vector.add_scalar_mut(nothing);
        self
    }
}

impl<const N: usize> Place for SVector<f64, N> {
    /// Between 0.4 and 1.2, signs mixed by the speeds alone: away from all singularities of angles.
    fn random(random: &mut Random) -> Self {
        Self::from_fn(|_, _| 0.8 + 0.4 * random.number())
    }
    fn waiting_for(mut self, nothing: f64) -> Self {
        self.add_scalar_mut(nothing);
        self
    }
}

/// q and z of a kernel.
type State<S> = (<S as GaussSystem>::Configuration, <S as GaussSystem>::Speeds);

/// ż of a kernel.
type Acceleration<S> = fn(&S, &State<S>) -> <S as GaussSystem>::Speeds;

/// One call, never inlined, so that each pays what a call pays.
#[inline(never)]
fn acceleration<S: GaussSystem<Scalar = f64, Input = ()>>(kernel: &S, (q, z): &State<S>) -> S::Speeds {
    kernel.acceleration(0.0, q, z, &())
}

fn add<S, const N: usize>(ways: &mut Vec<Way>, name: &str, kernel: S)
where
    S: GaussSystem<Scalar = f64, Input = (), Speeds = SVector<f64, N>> + Copy + 'static,
    S::Configuration: Place,
{
    let random = &mut Random::new();
    let states: Vec<State<S>> =
        (0..gauss_benches::states::STATES).map(|_| (Place::random(random), vector(random, 2.0))).collect();
    let function: Acceleration<S> = acceleration::<S>;
    ways.push(Way::new(&format!("{name},free"), kernel, states.clone(), function));
    let last = Cell::new(S::Speeds::zeros());
    let chained = move |function: Acceleration<S>, (q, z): &State<S>| {
        let nothing = last.get() * 1e-300;
        last.set(function(&kernel, &(q.waiting_for(nothing[N - 1]), z + nothing)));
        last.get()
    };
    ways.push(Way::calling(&format!("{name},chained"), states, function, chained));
}

/// What a body may have, under the names that its fields have here.
struct Numbers;

impl Numbers {
    const MASS: f64 = 2.0;

    fn center() -> Vector3<f64> {
        Vector3::new(0.1, -0.05, 0.2)
    }
    fn spherical() -> f64 {
        1.5
    }
    fn principal() -> Vector3<f64> {
        Vector3::new(1.0, 2.0, 2.5)
    }
    fn full() -> Matrix3<f64> {
        let inertia = Matrix3::new(1.0, 0.1, -0.05, 0.1, 2.0, 0.2, -0.05, 0.2, 2.5);
        about_pole(Self::MASS, Self::center(), inertia)
    }
    fn diagonal_fluid() -> Vector6<f64> {
        Vector6::new(0.5, 1.5, 1.8, 0.1, 0.6, 0.7)
    }
    fn fluid() -> Matrix6<f64> {
        Matrix6::from_fn(|i, j| if i == j { Self::diagonal_fluid()[i] } else { 0.01 * (1.0 + (i + j) as f64) })
    }
    fn g() -> f64 {
        G
    }
    fn field() -> Vector3<f64> {
        Vector3::new(0.1, 0.2, -G)
    }
    fn displaced() -> f64 {
        2.1
    }
    fn buoyancy() -> Vector3<f64> {
        Vector3::new(0.02, 0.0, -0.03)
    }
}

macro_rules! body {
    ($module:ident, [$($clause:tt)*], { $($role:ident $field:ident: $type:ty),* }) => {
        pub mod $module {
            use super::*;

            #[derive(GaussDynamics)]
            #[gauss($($clause)*)]
            pub struct Body { #[gauss(mass)] mass: f64, $(#[gauss($role)] $field: $type),* }

            impl Body {
                pub fn kernel_of_numbers() -> Result<BodyKernel, ParameterError> {
                    Body { mass: Numbers::MASS, $($field: Numbers::$field()),* }.kernel()
                }
            }
        }
    };
}

/// A struct for each chart, and a function that adds them all.
macro_rules! charts {
    ($fields:tt, $($module:ident $name:literal [$($clause:tt)*])+) => {
        $(body!($module, [$($clause)*], $fields);)+

        pub fn add_all(ways: &mut Vec<Way>, shape: &str) -> Result<(), ParameterError> {
            $(add(ways, &format!("{} {shape}", $name), $module::Body::kernel_of_numbers()?);)+
            Ok(())
        }
    };
}

/// A shape free, about a fixed point, and in the plane.
macro_rules! shapes {
    ($($module:ident $name:literal: $fields:tt)+) => {
        $(mod $module {
            use super::*;
            charts! {
                $fields,
                free_left "free left_invariant" [chart = left_invariant]
                free_right "free right_invariant" [chart = right_invariant]
                free_hybrid "free hybrid" [chart = hybrid]
                free_zyx "free jet(euler_zyx)" [chart = jet(euler_zyx)]
                free_modified "free jet(modified_rodrigues)" [chart = jet(modified_rodrigues)]
                fixed_left "fixed_point left_invariant" [motion = fixed_point, chart = left_invariant]
                fixed_right "fixed_point right_invariant" [motion = fixed_point, chart = right_invariant]
                fixed_zxz "fixed_point jet(euler_zxz)" [motion = fixed_point, chart = jet(euler_zxz)]
                planar_left "planar left_invariant" [motion = planar, chart = left_invariant]
                planar_right "planar right_invariant" [motion = planar, chart = right_invariant]
                planar_hybrid "planar hybrid" [motion = planar, chart = hybrid]
                planar_jet "planar jet" [motion = planar, chart = jet]
            }
        })+

        fn bodies(ways: &mut Vec<Way>) -> Result<(), ParameterError> {
            $($module::add_all(ways, $name)?;)+
            Ok(())
        }
    };
}

shapes! {
    spherical "spherical": { inertia spherical: f64 }
    principal "principal": { inertia principal: Vector3<f64> }
    heavy "full off centre; g": { center_of_mass center: Vector3<f64>, inertia full: Matrix3<f64>, gravity g: f64 }
    torpedo "principal off centre in fluid (6); g": {
        center_of_mass center: Vector3<f64>, inertia principal: Vector3<f64>, added_mass diagonal_fluid: Vector6<f64>,
        gravity g: f64
    }
    everything "everything": {
        center_of_mass center: Vector3<f64>, inertia full: Matrix3<f64>, added_mass fluid: Matrix6<f64>,
        gravity field: Vector3<f64>, displaced_mass displaced: f64, center_of_buoyancy buoyancy: Vector3<f64>
    }
}

/// Charts written as systems of one link.
mod one_link {
    use super::*;

    body!(twist, [coordinates(pose: Pose), body(position = pose.position, rotation = pose.rotation)], {
        center_of_mass center: Vector3<f64>, inertia full: Matrix3<f64>, gravity g: f64
    });
    body!(hybrid, [
        coordinates(pose: Pose),
        speeds(v: Vector3, w: Vector3),
        kinematics(pose = twist(inverse(pose.rotation) * v, w)),
        body(position = pose.position, rotation = pose.rotation)
    ], {
        center_of_mass center: Vector3<f64>, inertia full: Matrix3<f64>, gravity g: f64
    });
    body!(zyx, [
        coordinates(x, y, z, psi, theta, phi),
        body(position = [x, y, z], rotation = rotation_z(psi) * rotation_y(theta) * rotation_x(phi))
    ], {
        center_of_mass center: Vector3<f64>, inertia full: Matrix3<f64>, gravity g: f64
    });
}

/// A knife edge at O, which slides along e₁ only.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y, theta),
    speeds(v, w),
    kinematics(x = v * cos(theta), y = v * sin(theta), theta = w),
    body(position = [x, y, 0], rotation = rotation_z(theta), mass = m, center_of_mass = [c, 0, 0], inertia = i),
)]
struct Sleigh {
    m: f64,
    c: f64,
    i: f64,
}

/// A disk that rolls, its angular velocity in the axes of the first two turns.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y, phi, theta, psi),
    speeds(w1, w2, w3),
    kinematics(
        x = r * (w1 * sin(theta) * sin(phi) - w3 * cos(phi)),
        y = -r * (w1 * sin(theta) * cos(phi) + w3 * sin(phi)),
        phi = w2 / sin(theta),
        theta = w1,
        psi = w3 - w2 / tan(theta),
    ),
    body(position = [x, y, r * sin(theta)], rotation = rotation_z(phi) * rotation_x(theta) * rotation_z(psi)),
    inertia = [a, a, c],
)]
struct Disk {
    #[gauss(mass)]
    m: f64,
    a: f64,
    c: f64,
    r: f64,
    #[gauss(gravity)]
    g: f64,
}

#[derive(GaussDynamics)]
#[gauss(
    coordinates(theta, phi),
    particle(mass = 1, position = [l * sin(theta) * cos(phi), l * sin(theta) * sin(phi), -l * cos(theta)]),
)]
struct SphericalPendulum {
    l: f64,
    #[gauss(gravity)]
    g: f64,
}

/// Six bars one on the other, in the plane.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(q0, q1, q2, q3, q4, q5),
    body(b0, rotation = rotation_y(q0)),
    body(b1, parent = b0, position = [0, 0, -1], rotation = rotation_y(q1)),
    body(b2, parent = b1, position = [0, 0, -1], rotation = rotation_y(q2)),
    body(b3, parent = b2, position = [0, 0, -1], rotation = rotation_y(q3)),
    body(b4, parent = b3, position = [0, 0, -1], rotation = rotation_y(q4)),
    body(b5, parent = b4, position = [0, 0, -1], rotation = rotation_y(q5)),
)]
struct Chain {
    #[gauss(body)]
    b0: RigidBody<f64>,
    #[gauss(body)]
    b1: RigidBody<f64>,
    #[gauss(body)]
    b2: RigidBody<f64>,
    #[gauss(body)]
    b3: RigidBody<f64>,
    #[gauss(body)]
    b4: RigidBody<f64>,
    #[gauss(body)]
    b5: RigidBody<f64>,
    #[gauss(gravity)]
    g: f64,
}

fn systems(ways: &mut Vec<Way>) -> Result<(), Box<dyn Error>> {
    add(ways, "one link twist full off centre; g", one_link::twist::Body::kernel_of_numbers()?);
    add(ways, "one link hybrid full off centre; g", one_link::hybrid::Body::kernel_of_numbers()?);
    add(ways, "one link zyx full off centre; g", one_link::zyx::Body::kernel_of_numbers()?);
    add(ways, "S1 free body", scenes::free_body()?);
    add(ways, "S2 heavy body", scenes::heavy_body()?);
    add(ways, "S3 immersed", scenes::immersed()?);
    add(ways, "S4 top", scenes::top()?);
    add(ways, "S5 double pendulum", scenes::double_pendulum()?);
    add(ways, "S5′ jointed pendulum", scenes::jointed_pendulum()?);
    add(ways, "S6 cart and pole", scenes::cart_pole()?);
    add(ways, "S7 arm", scenes::arm()?);
    add(ways, "sleigh", Sleigh { m: 2.0, c: 0.3, i: 0.5 }.kernel()?);
    add(ways, "disk", Disk { m: 1.0, a: 0.25, c: 0.5, r: 1.0, g: G }.kernel()?);
    add(ways, "spherical pendulum", SphericalPendulum { l: 1.2, g: G }.kernel()?);
    let bar = RigidBody {
        mass: 1.0,
        center_of_mass: Vector3::new(0.0, 0.0, -0.5),
        inertia: Matrix3::from_diagonal(&Vector3::new(0.34, 0.35, 0.02)),
    };
    let [b0, b1, b2, b3, b4, b5] = [bar; 6];
    add(ways, "chain of 6 in the plane", Chain { b0, b1, b2, b3, b4, b5, g: G }.kernel()?);
    Ok(())
}

/// Everything, free and chained.
///
/// # Errors
/// When the parameters are not those of a body.
pub fn all() -> Result<Vec<Way>, Box<dyn Error>> {
    let mut ways = Vec::new();
    bodies(&mut ways)?;
    systems(&mut ways)?;
    Ok(ways)
}
