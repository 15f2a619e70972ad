//! How many digits of an acceleration are right? `cargo run --release --example how_many_digits`.
//!
//! Kernels are evaluated in `Bounded<f64>`: the numbers of `f64`, each with a guaranteed bound on all rounding so far.
//! Last comes what that costs beside `f64`, in the same run.

use std::error::Error;
use std::hint::black_box;
use std::time::Instant;

use gauss_bounded::{Bounded, exact, rounded};
use gauss_runtime::prelude::*;

/// An arm of two equal links with a mass at the elbow and one in the hand, by the place of the hand.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y),
    particle(mass = hand, position = [x, y, 0]),
    particle(mass = elbow, position = [
        x / 2 - y * sqrt(l * l / (x * x + y * y) - 0.25),
        y / 2 + x * sqrt(l * l / (x * x + y * y) - 0.25),
        0,
    ]),
)]
struct ArmByHand<T> {
    hand: T,
    elbow: T,
    l: T,
}

/// The same arm by its joints.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(a, b),
    particle(mass = elbow, position = [l * cos(a), l * sin(a), 0]),
    particle(mass = hand, position = [l * cos(a) + l * cos(a + b), l * sin(a) + l * sin(a + b), 0]),
)]
struct ArmByJoints<T> {
    hand: T,
    elbow: T,
    l: T,
}

/// A body in space, by the velocity of O and the angular velocity in its own axes.
#[derive(GaussDynamics)]
#[gauss(chart = hybrid)]
struct Needle<T> {
    #[gauss(mass)]
    mass: T,
    #[gauss(inertia)]
    inertia: Matrix3<T>,
    #[gauss(gravity)]
    g: T,
}

/// A body in an ideal fluid.
#[derive(GaussDynamics)]
#[gauss(chart = left_invariant)]
struct Plate<T> {
    #[gauss(mass)]
    mass: T,
    #[gauss(inertia)]
    inertia: Matrix3<T>,
    #[gauss(added_mass)]
    fluid: Matrix6<T>,
    #[gauss(gravity)]
    g: T,
}

/// A body by the velocity of its point at Ω, the origin of the observer.
#[derive(GaussDynamics)]
#[gauss(chart = right_invariant)]
struct Right<T> {
    #[gauss(mass)]
    mass: T,
    #[gauss(center_of_mass)]
    center: Vector3<T>,
    #[gauss(inertia)]
    inertia: Matrix3<T>,
    #[gauss(gravity)]
    g: T,
}

/// The same body by the velocity of its point O.
#[derive(GaussDynamics)]
#[gauss(chart = hybrid)]
struct Hybrid<T> {
    #[gauss(mass)]
    mass: T,
    #[gauss(center_of_mass)]
    center: Vector3<T>,
    #[gauss(inertia)]
    inertia: Matrix3<T>,
    #[gauss(gravity)]
    g: T,
}

/// Three characters wide; dots above letters take no room.
fn padded(name: &str) -> String {
    let width = name.chars().filter(|c| !('\u{300}'..'\u{370}').contains(c)).count();
    format!("{}{name}", " ".repeat(3_usize.saturating_sub(width)))
}

/// Prints the acceleration of a kernel, digits by output.
fn show<S, V>(title: &str, meaning: &str, names: &[&str], kernel: &S, q: &S::Configuration, z: &V)
where
    V: VectorSpace<Bounded<f64>>,
    S: GaussSystem<Scalar = Bounded<f64>, Speeds = V, Input = ()>,
{
    println!("{title}\n");
    // The one line that this is about.
    let acceleration = kernel.acceleration(Bounded::exact(0.0), q, z, &());
    for (i, name) in names.iter().enumerate() {
        let a = acceleration.component(i);
        println!("  {} = {:>24.16e} ± {:.1e}   {:4.1} digits", padded(name), a.value, a.bound, a.digits());
    }
    println!("\n  {meaning}\n");
}

/// Nanoseconds of an acceleration, the least of many rounds.
fn nanoseconds<S: GaussSystem<Input = ()>>(kernel: &S, q: &S::Configuration, z: &S::Speeds) -> f64 {
    const CALLS: u32 = 200;
    let t = S::Scalar::zero();
    let round = || {
        let start = Instant::now();
        for _ in 0..CALLS {
            black_box(black_box(kernel).acceleration(t, black_box(q), black_box(z), &()));
        }
        start.elapsed().as_secs_f64() * 1e9 / f64::from(CALLS)
    };
    (0..300).map(|_| round()).fold(f64::INFINITY, f64::min)
}

/// Prints what bounds cost a kernel.
fn cost<P, B>(
    title: &str,
    (plain, q, z): (&P, &P::Configuration, &P::Speeds),
    (bounded, bq, bz): (&B, &B::Configuration, &B::Speeds),
) where
    P: GaussSystem<Scalar = f64, Input = ()>,
    B: GaussSystem<Scalar = Bounded<f64>, Input = ()>,
{
    let (without, with) = (nanoseconds(plain, q, z), nanoseconds(bounded, bq, bz));
    println!("  {title:<24} {without:8.1} ns {with:8.1} ns   {:5.1}", with / without);
}

fn arm() -> Result<(), Box<dyn Error>> {
    let [hand, elbow, l] = exact(&[2.0, 1.0, 0.5]);
    let arm = ArmByHand { hand, elbow, l }.kernel()?;
    let (q, z) = (SVector::from([1.0 - 1e-8, 0.0]), SVector::from([0.0, 0.1]));
    show(
        "An arm, ten nanometres from its stretched pose, by the place of its hand",
        "Near the singular pose the elbow depends on the last digits of the hand's place: half of the digits are \
         gone, and of the \
         small ÿ nearly all.",
        &["ẍ", "ÿ"],
        &arm,
        &exact(&q),
        &exact(&z),
    );

    let arm = ArmByJoints { hand, elbow, l }.kernel()?;
    let q = SVector::from([0.0, 2e-4]);
    show(
        "The same arm, as nearly stretched, by its joints",
        "Joints have no such pose: what was singular is the choice of coordinates, not the arm.",
        &["ä", "b̈"],
        &arm,
        &exact(&q),
        &exact(&SVector::from([0.1, 0.0])),
    );

    let weighed = ArmByJoints { hand: Bounded::measured(2.0, 1e-3), elbow, l }.kernel()?;
    show(
        "The same, with a load in the hand that was weighed to a gram",
        "Bounds carry what was measured as well: rounding no longer matters, a better balance would.",
        &["ä", "b̈"],
        &weighed,
        &exact(&SVector::from([0.0, 1.2])),
        &exact(&SVector::from([0.1, 2.0])),
    );
    Ok(())
}

fn turned() -> UnitQuaternion<f64> {
    UnitQuaternion::from_euler_angles(0.4, -0.7, 1.1)
}

/// The moment about its third axis, and the other two, of a body whose axes are turned.
fn tensor(across: f64, along: f64) -> Matrix3<f64> {
    let turn = turned().to_rotation_matrix().into_inner();
    let tensor = turn * Matrix3::from_diagonal(&Vector3::new(across, across, along)) * turn.transpose();
    // Symmetric to the last bit.
    Matrix3::from_fn(|i, j| tensor[(i.min(j), i.max(j))])
}

fn needle() -> Result<(), Box<dyn Error>> {
    let needle = Needle { mass: Bounded::exact(1.0), inertia: rounded(&tensor(1.0, 1e-6)), g: Bounded::rounded(9.81) };
    let z = SVector::from([1.0, 0.0, 2.0, 0.3, -0.5, 0.8]);
    show(
        "A needle, moments 1 : 1 : 10⁻⁶, as a full matrix of inertia",
        "The entries of the matrix are rounded, and the moment along the needle is what their difference leaves: \
         most digits of the \
         turning are lost. Give principal axes where you have them.",
        &["b̈₁", "b̈₂", "b̈₃", "ω̇₁", "ω̇₂", "ω̇₃"],
        &needle.kernel()?,
        &exact(&Isometry3::identity()),
        &exact(&z),
    );
    Ok(())
}

/// What a plate across its third axis, turned, drags along of the fluid.
fn dragged_along() -> Matrix6<f64> {
    let normal = turned() * Vector3::z();
    let linear = 1000.0 * normal * normal.transpose();
    Matrix6::from_fn(|i, j| if i < 3 && j < 3 { linear[(i.min(j), i.max(j))] } else { 0.0 })
}

fn plate() -> Result<(), Box<dyn Error>> {
    let plate = Plate {
        mass: Bounded::exact(1e-3),
        inertia: exact(&Matrix3::from_diagonal(&Vector3::new(1e-3, 1e-3, 1.5e-3))),
        fluid: rounded(&dragged_along()),
        g: Bounded::rounded(9.81),
    };
    show(
        "A gram of foil that drags a ton of water along, across itself only",
        "Along the foil one part in 10⁶ of the matrix of masses resists, and is known to as many digits less; \
         every component of u̇ has a share of that.",
        &["u̇₁", "u̇₂", "u̇₃", "ω̇₁", "ω̇₂", "ω̇₃"],
        &plate.kernel()?,
        &rounded(&Isometry3::from_parts(Translation3::identity(), turned())),
        &exact(&SVector::from([0.01, 0.02, -0.01, 0.3, -0.5, 0.8])),
    );
    Ok(())
}

fn far() -> Result<(), Box<dyn Error>> {
    let (mass, center, inertia, g) = (2.0, Vector3::new(0.125, 0.0, 0.25), tensor(1.0, 0.5), 9.81);
    let pose = Isometry3::from_parts(Translation3::new(1e6, -2e5, 3e5), turned());
    let (q, z) = (exact(&pose), exact(&SVector::from([1.0, 0.5, -2.0, 0.3, -0.5, 0.8])));
    let [mass, g] = [Bounded::exact(mass), Bounded::rounded(g)];
    let (center, inertia) = (exact(&center), rounded(&inertia));
    let right = Right { mass, center, inertia, g }.kernel()?;
    show(
        "A body a thousand kilometres from Ω, by the velocity of its point at Ω",
        "All digits of ξ̇ are right, but it is some 10⁵ times larger than the acceleration of the body, of which ± \
         10⁻⁹ leaves nine or \
         so: the bound tells what the digits hide.",
        &["ξ̇₁", "ξ̇₂", "ξ̇₃", "ω̇₁", "ω̇₂", "ω̇₃"],
        &right,
        &q,
        &z,
    );
    let hybrid = Hybrid { mass, center, inertia, g }.kernel()?;
    show(
        "The same body by the velocity of its point O",
        "The place is not in these equations, so distance costs nothing: the chart decides, before any arithmetic \
         does.",
        &["b̈₁", "b̈₂", "b̈₃", "ω̇₁", "ω̇₂", "ω̇₃"],
        &hybrid,
        &q,
        &z,
    );
    Ok(())
}

fn costs() -> Result<(), Box<dyn Error>> {
    println!("What an acceleration costs        f64       Bounded<f64>   ratio");
    let numbers = [2.0, 1.0, 0.5];
    let [hand, elbow, l] = numbers;
    let plain = ArmByJoints { hand, elbow, l }.kernel()?;
    let [hand, elbow, l] = exact(&numbers);
    let bounded = ArmByJoints { hand, elbow, l }.kernel()?;
    let (q, z) = (SVector::from([0.3, 1.2]), SVector::from([0.1, 2.0]));
    cost("arm by its joints", (&plain, &q, &z), (&bounded, &exact(&q), &exact(&z)));

    let pose = Isometry3::from_parts(Translation3::new(1.0, 2.0, 3.0), turned());
    let z = SVector::from([1.0, 0.5, -2.0, 0.3, -0.5, 0.8]);
    let (center, inertia) = (Vector3::new(0.125, 0.0, 0.25), tensor(1.0, 0.5));
    let plain = Hybrid { mass: 2.0, center, inertia, g: 9.81 }.kernel()?;
    let (mass, g) = (Bounded::exact(2.0), Bounded::rounded(9.81));
    let bounded = Hybrid { mass, center: exact(&center), inertia: rounded(&inertia), g }.kernel()?;
    cost("heavy body, hybrid chart", (&plain, &pose, &z), (&bounded, &exact(&pose), &exact(&z)));

    let (inertia, fluid) = (Matrix3::identity(), dragged_along());
    let plain = Plate { mass: 1.0, inertia, fluid, g: 9.81 }.kernel()?;
    let mass = Bounded::exact(1.0);
    let bounded = Plate { mass, inertia: exact(&inertia), fluid: rounded(&fluid), g }.kernel()?;
    cost("body in a fluid", (&plain, &pose, &z), (&bounded, &exact(&pose), &exact(&z)));
    Ok(())
}

fn main() -> Result<(), Box<dyn Error>> {
    arm()?;
    needle()?;
    plate()?;
    far()?;
    costs()
}
