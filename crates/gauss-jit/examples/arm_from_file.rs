//! An arm whose file is named on the command line: what it weighs in a pose, and how it falls when its motors let go.
//!
//! `cargo run --release -p gauss-jit --example arm_from_file -- arm.urdf gravity=9.81`

use std::error::Error;

use gauss_jit::Model;

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let file = arguments
        .next()
        .unwrap_or_else(|| concat!(env!("CARGO_MANIFEST_DIR"), "/../../tests/robots/panda.urdf").to_owned());
    let mut clauses: Vec<String> = arguments.collect();
    if clauses.is_empty() {
        clauses.push("gravity = 9.81".to_owned());
    }
    let clauses: Vec<&str> = clauses.iter().map(String::as_str).collect();
    // Mistakes come all at once, each with its line and column.
    let model = Model::from_urdf(file, &clauses)?;
    model.remarks().iter().for_each(|remark| println!("note: {remark}"));
    let arm = model.kernel(&[])?;
    let method = arm.method("acceleration")?;
    let [_, q, z, u] = method.arguments() else { return Err("no arm".into()) };
    if q.components.len() != z.components.len() {
        return Err("the base of an arm stands still".into());
    }
    println!("{} coordinates: {}", q.components.len(), q.components.join(", "));
    let (posture, rest, free) =
        (vec![0.5; q.components.len()], vec![0.0; z.components.len()], vec![0.0; u.components.len()]);
    // What holds it, in N m and N: inverse dynamics with no acceleration.
    let efforts = arm.inverse_dynamics(0.0, &posture, &rest, &rest, &free)?;
    println!("held by {efforts:.3?}");
    // The motors let go: half a second in steps of a millisecond, by the midpoint rule.
    let (mut place, mut speed, h) = (posture.clone(), rest.clone(), 1e-3);
    let energy = |q: &[f64], z: &[f64]| {
        Ok::<f64, Box<dyn Error>>(arm.kinetic_energy(0.0, q, z)? + arm.potential_energy(0.0, q)?)
    };
    let before = energy(&place, &speed)?;
    let moved =
        |from: &[f64], rate: &[f64], by: f64| from.iter().zip(rate).map(|(x, v)| x + by * v).collect::<Vec<f64>>();
    let mut rate = vec![0.0; method.outputs()];
    for _ in 0..500 {
        method.call(&[&[0.0], &place, &speed, &free], &mut rate)?;
        let (half_place, half_speed) = (moved(&place, &speed, h / 2.0), moved(&speed, &rate, h / 2.0));
        method.call(&[&[0.0], &half_place, &half_speed, &free], &mut rate)?;
        (place, speed) = (moved(&place, &half_speed, h), moved(&speed, &rate, h));
    }
    println!("after 0.5 s at {place:.3?}");
    println!("energy {before:.6} J, afterwards {:.6} J", energy(&place, &speed)?);
    Ok(())
}
