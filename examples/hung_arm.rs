//! An arm from its file hangs from a ceiling and swings a load: the forces and torques that its bearings take, with and
//! without the load. The force of the first is what moves the centre of mass of all.
//!
//! `cargo run --release --example hung_arm [-- FOLDER]` draws into `FOLDER`, by default `target/gauss`.

use std::error::Error;

use gauss_charts::drawing::COLOURS;
use gauss_examples::plots::{Line, Plot, sheet, write, write_page};
use gauss_examples::stage;
use gauss_playback::{Playback, Shape};
use gauss_runtime::frames::in_observers_axes;
use gauss_runtime::prelude::*;

/// Upside down below a ceiling at `height`, with a load in its hand that may weigh nothing.
#[derive(GaussDynamics)]
#[gauss(
    urdf = "../tests/robots/panda.urdf",
    base(position = [0, 0, height], rotation = rotation_x(pi)),
    gravity = 9.81,
    body(load, parent = panda_joint7_link, position = [0, 0, 0.15]),
    frames(base_link, panda_joint1_link, panda_joint2_link, panda_joint3_link, panda_joint4_link, panda_joint5_link,
           panda_joint6_link, panda_joint7_link, load),
    reactions(panda_joint1, panda_joint2, panda_joint4, panda_joint6, load),
    methods(centroidal),
)]
struct HungArm {
    #[gauss(unit = "m")]
    height: f64,
    #[gauss(body)]
    load: RigidBody<f64>,
}

type Joints = SVector<f64, 9>;

const G: f64 = 9.81;
/// s, and the step at which reactions are looked at.
const END: f64 = 4.0;
const H: f64 = 0.005;

/// Places, rates and accelerations of the joints: sines about a bent arm.
fn wanted(t: f64) -> [Joints; 3] {
    let middle = Joints::from([0.0, 0.3, 0.0, -1.4, 0.0, 1.6, 0.8, 0.02, 0.02]);
    let size = |k: usize| if k < 7 { 0.5 } else { 0.0 };
    let rate = |k: usize| 2.0 + 0.3 * k as f64;
    [
        middle + Joints::from_fn(|k, _| size(k) * (rate(k) * t).sin()),
        Joints::from_fn(|k, _| size(k) * rate(k) * (rate(k) * t).cos()),
        Joints::from_fn(|k, _| -size(k) * rate(k) * rate(k) * (rate(k) * t).sin()),
    ]
}

/// A ball of lead.
fn ball(mass: f64) -> RigidBody<f64> {
    let radius = (mass / 11_340.0 * 0.75 / std::f64::consts::PI).cbrt();
    let moment = 0.4 * mass * radius * radius;
    RigidBody { mass, center_of_mass: Vector3::zeros(), inertia: Matrix3::from_diagonal_element(moment) }
}

/// What the joints bear along the way, and by how much the first misses what the motion of the whole asks for.
struct Borne {
    /// N and N m across the axis of each joint, by their names.
    loads: Vec<[(f64, f64); 5]>,
    missed: f64,
}

fn borne(arm: &HungArmKernel) -> Borne {
    let mut borne = Borne { loads: Vec::new(), missed: 0.0 };
    for n in 0..=(END / H).round() as usize {
        let t = n as f64 * H;
        let [q, z, rates] = wanted(t);
        let efforts = arm.inverse_dynamics(t, &q, &z, &rates, &Joints::zeros());
        let all = arm.reactions_at(t, &q, &z, &rates, &efforts);
        borne.loads.push([0, 1, 2, 3, 4].map(|k| {
            let r = all[HungArmJoint::ALL[k]];
            // Joints turn about their z; the grip of the load turns about nothing.
            let along = if k < 4 { 0.0 } else { r[5] };
            (r.fixed_rows::<3>(0).norm(), Vector3::new(r[3], r[4], along).norm())
        }));
        // Newton for all of the arm: d(m v_G)/dt is the weight and what the ceiling gives.
        let motion = arm.centroidal_matrix(t, &q) * rates + arm.centroidal_bias(t, &q, &z);
        let asked = motion.fixed_rows::<3>(0) + Vector3::z() * (G * arm.total_mass());
        let pose = arm.pose_of(HungArmFrame::panda_joint1_link, t, &q);
        let given = in_observers_axes(&pose, &all[HungArmJoint::panda_joint1]);
        borne.missed = borne.missed.max((given.fixed_rows::<3>(0) - asked).amax() / asked.amax());
    }
    borne
}

fn main() -> Result<(), Box<dyn Error>> {
    println!("reactions of five joints: {}", HungArmKernel::OPERATIONS.reactions_at);
    println!("accelerations:            {}\n", HungArmKernel::OPERATIONS.acceleration);
    let of = |mass: f64| HungArm { height: 2.2, load: ball(mass) }.kernel();
    let (empty, loaded) = (of(0.0)?, of(3.0)?);
    let both = [borne(&empty), borne(&loaded)];
    println!("LARGEST LOADS of bearings: force, torque across the axis\n");
    println!("joint            empty             with 3 kg");
    for (k, joint) in HungArmJoint::ALL.iter().enumerate() {
        let largest = both
            .each_ref()
            .map(|borne| borne.loads.iter().fold((0.0_f64, 0.0_f64), |(f, m), own| (f.max(own[k].0), m.max(own[k].1))));
        let [a, b] = largest.map(|(f, m)| format!("{f:6.1} N {m:5.1} N m"));
        println!("{:<14} {a}  {b}", joint.name());
    }
    let missed = both.iter().map(|borne| borne.missed).fold(0.0, f64::max);
    println!("\nthe first bearing misses the motion of the centre of mass by {missed:.1e} of its force");
    write("hung_arm", &sheet("An arm below a ceiling: what its bearings take", (1100, 900), &pictures(&both))?)?;
    write_page("hung_arm", &page(&loaded)?)?;
    // Some hundred products in each force.
    if missed < 500.0 * f64::EPSILON { Ok(()) } else { Err("forces do not add up".into()) }
}

fn pictures([empty, loaded]: &[Borne; 2]) -> Vec<Vec<Plot<'static>>> {
    let line = |borne: &Borne, k: usize, colour: usize, name: &str, of: fn(&(f64, f64)) -> f64| {
        let points = borne.loads.iter().enumerate().map(|(n, own)| (n as f64 * H, of(&own[k])));
        Line::new(name, COLOURS[colour], points.collect::<Vec<_>>())
    };
    let plot = |title, unit, of: fn(&(f64, f64)) -> f64| {
        let most = loaded.loads.iter().flatten().map(of).fold(0.0, f64::max);
        let lines = vec![
            line(loaded, 0, 0, "joint 1", of),
            line(empty, 0, 0, "joint 1, no load", of).dashed(),
            line(loaded, 2, 1, "joint 4", of),
            line(loaded, 3, 2, "joint 6", of),
        ];
        vec![Plot::new(title, ("time, s", 0.0..END), (unit, 0.0..1.1 * most), lines)]
    };
    vec![plot("force", "N", |own| own.0), plot("torque across the axis", "N m", |own| own.1)]
}

/// The arm on its way under the efforts that this asks for, with its load.
fn page(arm: &HungArmKernel) -> Result<Playback<HungArmKernel>, Box<dyn Error>> {
    let [place, rate, _] = wanted(0.0);
    let gain = 20.0;
    let law = |t: f64, q: &Joints, z: &Joints| {
        let [place, rate, acceleration] = wanted(t);
        let asked = acceleration + (rate - z) * (2.0 * gain) + (place - q) * (gain * gain);
        arm.inverse_dynamics(t, q, z, &asked, &Joints::zeros())
    };
    let path = Simulation::new(arm).input(law).fixed_step(H / 5.0).run(place, rate, 0.0..END)?;
    let link = |k: usize| if k == 0 { "base_link".to_owned() } else { format!("panda_joint{k}_link") };
    let links: Vec<String> = (0..=7).map(link).collect();
    let page = Playback::new("An arm below a ceiling swings a load", &path)?.si().frames(arm);
    let page = stage::chain(page, &links.iter().map(String::as_str).collect::<Vec<_>>(), 0.04)
        .rod("panda_joint7_link", "load", 0.015)
        .shape("load", Shape::ball(0.04));
    Ok([HungArmJoint::panda_joint1, HungArmJoint::panda_joint4, HungArmJoint::load].into_iter().fold(
        page,
        |page, joint| {
            page.curve("force of the bearing / N", joint.name(), move |s| {
                let [q, z, rates] = wanted(s.t);
                let efforts = arm.inverse_dynamics(s.t, &q, &z, &rates, &Joints::zeros());
                arm.reactions_at(s.t, &q, &z, &rates, &efforts)[joint].fixed_rows::<3>(0).norm()
            })
        },
    ))
}
