//! A hoop that rolls and wobbles: constraints, consistent initial values, integrals, and the force of the ground.
//!
//! `cargo run --release --example rolling_disk [-- FOLDER]` draws its path into `FOLDER`, by default `target/gauss`.

use gauss_examples::plots;
use gauss_examples::rolling::{Floor, Hoop, draw};
use gauss_playback::{Playback, Shape};
use gauss_runtime::monitor::monitor;
use gauss_runtime::prelude::*;

/// A thin hoop on the floor z = 0. Its axis leans by `lean` from the vertical: at a right angle the hoop stands
/// upright, at zero it lies flat.
///
/// The point that touches the floor rests. This says how fast the centre goes along the heading and across it, which
/// cannot be integrated, and how high it is, which can.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y, z, heading, lean, spin),
    body(hoop, position = [x, y, z], rotation = rotation_z(heading) * rotation_x(lean) * rotation_z(spin)),
    constraint(velocity = rate(x) * cos(heading) + rate(y) * sin(heading) + r * (rate(spin) + rate(heading) * cos(lean))),
    constraint(velocity = rate(y) * cos(heading) - rate(x) * sin(heading) + r * sin(lean) * rate(lean)),
    constraint(position = z - r * sin(lean)),
)]
struct RollingDisk {
    #[gauss(body)]
    hoop: RigidBody<f64>,
    r: f64,
    #[gauss(gravity)]
    g: f64,
}

/// m, and kg.
const RADIUS: f64 = 0.3;
const MASS: f64 = 1.5;
const GRAVITY: f64 = 9.81;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // Nearly all mass in the rim.
    let about_axis = 0.9 * MASS * RADIUS * RADIUS;
    let inertia = Matrix3::from_diagonal(&Vector3::new(0.5, 0.5, 1.0)) * about_axis;
    let hoop = RigidBody { mass: MASS, center_of_mass: Vector3::zeros(), inertia };
    let kernel = RollingDisk { hoop, r: RADIUS, g: GRAVITY }.kernel()?;
    println!("{}\n", RollingDiskKernel::EQUATIONS);

    // What one would type: the height and the velocities do not fit together to the last digit, nor need they.
    let typed = RollingDiskState {
        z: 0.28,
        lean: 1.2,
        x_dot: 1.2,
        heading_dot: -0.8,
        spin_dot: -3.7,
        ..RollingDiskState::default()
    };
    let (q, z) = kernel.project(0.0, &typed.q(), &typed.z())?;
    let RollingDiskState { z: height, x_dot: speed, spin_dot: spin, .. } = RollingDiskState::of(&q, &z);
    println!("the nearest state that rolls: height {height:.6} m, speed {speed:.6} m/s, spin {spin:.6} rad/s\n");

    let path = Simulation::new(&kernel).adaptive(1e-10, 1e-10).run(q, z, 0.0..12.0)?;
    let (mut off, mut friction, mut lightest) = (0.0_f64, 0.0_f64, f64::INFINITY);
    for sample in path.iter() {
        let [along, across, normal] = kernel.multipliers(sample.t, &sample.q, &sample.z, &()).into();
        friction = friction.max(f64::hypot(along, across) / normal);
        lightest = lightest.min(normal / (MASS * GRAVITY));
        off = off.max(kernel.position_residual(sample.t, &sample.q).amax());
        off = off.max(kernel.velocity_residual(sample.t, &sample.q, &sample.z).amax());
    }

    println!("   t/s      x/m      y/m   lean/°   along/N  across/N  normal/N   of the floor on the hoop");
    for n in 0..=12 {
        let s = path.at(f64::from(n)).expect("inside the run");
        let [along, across, normal] = kernel.multipliers(s.t, &s.q, &s.z, &()).into();
        let RollingDiskState { x, y, lean, .. } = RollingDiskState::of(&s.q, &s.z);
        let lean = lean.to_degrees();
        println!("{:6.1} {x:8.3} {y:8.3} {lean:8.2} {along:9.3} {across:9.3} {normal:9.3}", s.t);
    }
    println!(
        "\nit rolls while the coefficient of friction is above {friction:.3}; the floor carries {lightest:.3} of its weight at least"
    );
    println!("largest deviation from the constraints in {} steps: {off:.1e} m and m/s", path.len() - 1);
    println!("{}", monitor(&kernel, &path));

    let hoops = hoops(&path);
    let svg = draw(
        &hoops,
        Floor { grid: 0.25, shown: 8, among: 81 },
        "A hoop rolls for 12 s: where it touched the floor, and its last 0.8 s",
    )?;
    plots::write("rolling_disk", &svg)?;
    plots::write_page("rolling_disk", &page(&kernel, &path)?)
}

/// Where the hoop is, a hundred times a second.
fn hoops(path: &Trajectory<RollingDiskKernel>) -> Vec<Hoop> {
    let turn = |axis, angle| UnitQuaternion::from_axis_angle(&axis, angle);
    (0..=1200)
        .map(|n| {
            let s = path.at(0.01 * f64::from(n)).expect("inside the run");
            let RollingDiskState { x, y, z, heading, lean, .. } = RollingDiskState::of(&s.q, &s.z);
            let rotation = turn(Vector3::z_axis(), heading) * turn(Vector3::x_axis(), lean);
            Hoop { centre: Vector3::new(x, y, z), rotation, radius: RADIUS }
        })
        .collect()
}

/// The hoop and the force of the floor on it, where it touches.
fn page(
    kernel: &RollingDiskKernel,
    path: &Trajectory<RollingDiskKernel>,
) -> Result<Playback<RollingDiskKernel>, IntegrationError> {
    let turn = |axis, angle| UnitQuaternion::from_axis_angle(&axis, angle);
    let pose = move |s: &Sample<RollingDiskKernel>| {
        let RollingDiskState { x, y, z, heading, lean, spin, .. } = RollingDiskState::of(&s.q, &s.z);
        let rotation = turn(Vector3::z_axis(), heading) * turn(Vector3::x_axis(), lean) * turn(Vector3::z_axis(), spin);
        Isometry3::from_parts(Translation3::new(x, y, z), rotation)
    };
    let floor = move |s: &Sample<RollingDiskKernel>| {
        let place = pose(s);
        let axis = place.rotation * Vector3::z();
        let up = (Vector3::z() - axis * axis.z).normalize();
        // The multipliers are forces along the heading, across it, and upwards.
        let heading = turn(Vector3::z_axis(), RollingDiskState::of(&s.q, &s.z).heading);
        (place.translation.vector - up * RADIUS, heading * kernel.multipliers(s.t, &s.q, &s.z, &()))
    };
    Ok(Playback::with_pictures("A hoop that rolls", path, 1200)?
        .si()
        .body("hoop", pose, [Shape::cylinder(RADIUS, 0.02)])
        .trace("hoop", [0.0; 3])
        .arrow("force of the floor", 0.5 / (MASS * GRAVITY), floor)
        .curve("force of the floor / N", "normal", |s| kernel.multipliers(s.t, &s.q, &s.z, &())[2])
        .curve("force of the floor / N", "friction", |s| {
            kernel.multipliers(s.t, &s.q, &s.z, &()).fixed_rows::<2>(0).norm()
        })
        .energy(kernel))
}
