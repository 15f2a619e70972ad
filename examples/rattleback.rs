//! A rattleback: spun one way it goes on, spun the other way it rattles, stops and turns back: `cargo run --release --example
//! rattleback`.

use gauss_examples::plots::write_page;
use gauss_playback::{Playback, Shape};
use gauss_runtime::prelude::*;

/// An ellipsoid of half-axes `a` that rolls on the plane z = 0, O in its centre, e₃ up at rest.
///
/// With γ = Rᵀk₃, the vertical in body axes, its lowest point is at −(aᵢ² γᵢ)/h from O, where h = √Σ aᵢ² γᵢ² is the height of O.
/// That this point rests says what the velocity of O is: those speeds are solved for, and three are left.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y, attitude: Rotation),
    speeds(vx, vy, w1, w2, w3),
    kinematics(x = vx, y = vy, attitude = [w1, w2, w3]),
    body(
        stone,
        position = [x, y, sqrt(
            (a.x * (inverse(attitude) * [0, 0, 1]).x).powi(2)
                + (a.y * (inverse(attitude) * [0, 0, 1]).y).powi(2)
                + (a.z * (inverse(attitude) * [0, 0, 1]).z).powi(2)
        )],
        rotation = attitude,
    ),
    constraint(velocity = vx - (attitude * cross([w1, w2, w3], [
        a.x * a.x * (inverse(attitude) * [0, 0, 1]).x,
        a.y * a.y * (inverse(attitude) * [0, 0, 1]).y,
        a.z * a.z * (inverse(attitude) * [0, 0, 1]).z,
    ])).x / stone.position.z),
    constraint(velocity = vy - (attitude * cross([w1, w2, w3], [
        a.x * a.x * (inverse(attitude) * [0, 0, 1]).x,
        a.y * a.y * (inverse(attitude) * [0, 0, 1]).y,
        a.z * a.z * (inverse(attitude) * [0, 0, 1]).z,
    ])).y / stone.position.z),
    independent(w1, w2, w3),
)]
struct Rattleback {
    #[gauss(body)]
    stone: RigidBody<f64>,
    a: Vector3<f64>,
    #[gauss(gravity)]
    g: f64,
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // T. R. Kane, D. A. Levinson, Int. J. Non-Linear Mechanics 17 (1982) 175–186, for a mass of 1 kg: G is 1 cm below O, and a
    // product of inertia turns the principal axes against those of the ellipsoid.
    let inertia = Matrix3::new(3e-4, 2e-5, 0.0, 2e-5, 1.7e-3, 0.0, 0.0, 0.0, 1.7e-3);
    let stone = RigidBody { mass: 1.0, center_of_mass: Vector3::new(0.0, 0.0, -0.01), inertia };
    let a = Vector3::new(0.2, 0.03, 0.02);
    let rattleback = Rattleback { stone, a, g: 9.81 }.kernel()?;

    // A hand does not set it down perfectly flat.
    let tilted = UnitQuaternion::from_euler_angles(0.009, 0.009, 0.0);
    let start = (tilted, SVector::from([0.0, 0.0]));
    let run =
        |spin| Simulation::new(&rattleback).adaptive(1e-10, 1e-12).run(start, Vector3::new(0.0, 0.0, spin), 0.0..5.0);
    let (against, along) = (run(5.0)?, run(-5.0)?);

    println!("   t/s  spun against, rad/s (long axis)  spun along, rad/s");
    let vertical = |sample: &Sample<RattlebackKernel>| (sample.q.0 * sample.z).z;
    for n in 0..=20 {
        let t = 0.25 * f64::from(n);
        let [first, second] = [&against, &along].map(|path| path.at(t).expect("inside the run"));
        // How far the long axis is from level.
        let rattling = (first.q.0 * Vector3::x()).z.asin().to_degrees();
        println!("{t:6.2} {:14.3} ({rattling:+5.1}°) {:25.3}", vertical(&first), vertical(&second));
    }

    let friction = |path: &Trajectory<RattlebackKernel>| {
        path.iter().map(|s| rattleback.multipliers(s.t, &s.q, &s.z, &()).norm()).fold(0.0, f64::max)
    };
    println!(
        "\nnot to slip it needs up to {:.1} N of friction, spun along {:.1} N, and weighs 9.8 N",
        friction(&against),
        friction(&along)
    );
    println!("{}", monitor(&rattleback, &against));
    let pose = |s: &Sample<RattlebackKernel>| {
        let up = s.q.0.inverse() * Vector3::z();
        let height = a.component_mul(&up).norm();
        Isometry3::from_parts(Translation3::new(s.q.1[0], s.q.1[1], height), s.q.0)
    };
    let page = Playback::new("A rattleback, spun against its way", &against)?
        .body("stone", pose, [Shape::ellipsoid(a.into())])
        .trace("stone", [0.2, 0.0, 0.0])
        .curve("spin about the vertical / (rad/s)", "ω̂₃", vertical)
        .energy(&rattleback);
    write_page("rattleback", &page)
}
