//! How rounding errors grow over long runs of a heavy top: energy, and the momentum about the vertical, which weight
//! cannot change, after 10³ to 10ⁿ steps.
//!
//! `cargo run --release --example long_runs` goes to 10⁵ steps, `… -- 8` to 10⁸ (hours). Errors are root mean squares
//! over four starts, relative, in units of 10⁻¹⁶; `growth` is the exponent e of nᵉ from the second figure to the last:
//! about ½ where roundings are independent of each other, 1 where each step errs the same way or the method itself
//! does. The energy of a body in a fluid is quadratic without weight, and kept to rounding; with weight it is kept to
//! the error of the method.

use gauss_exact::{MoserVeselov, Scheme, Splitting};
use gauss_runtime::integrate::{Collocation, Compensated, Control, Fixed, Variational};
use gauss_runtime::prelude::*;

/// A top on a fixed tip.
#[derive(GaussDynamics)]
#[gauss(chart = left_invariant, motion = fixed_point)]
struct Top {
    #[gauss(mass)]
    mass: f64,
    #[gauss(center_of_mass)]
    center: Vector3<f64>,
    #[gauss(inertia)]
    inertia: Vector3<f64>,
    #[gauss(gravity)]
    g: f64,
}

/// A body in a fluid, whose weight acts below its buoyancy.
#[derive(GaussDynamics)]
#[gauss(chart = left_invariant, mass = 2, inertia = [0.5, 0.7, 0.8], displaced_mass = 2)]
struct Submerged {
    #[gauss(added_mass)]
    added: Vector6<f64>,
    #[gauss(center_of_buoyancy)]
    buoyancy: Vector3<f64>,
    #[gauss(gravity)]
    g: f64,
}

/// Not a power of two: products with it are rounded.
const STEP: f64 = 0.01;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let most: i32 = std::env::args().nth(1).map_or(Ok(5), |n| n.parse())?.clamp(4, 12);
    let center = Vector3::new(0.0, 0.0, 0.3);
    let top = Top { mass: 1.0, center, inertia: Vector3::new(0.85, 0.85, 0.5), g: 1.0 }.kernel()?;
    println!("errors in 1e-16 after n steps of {STEP} s; n = 10^3 … 10^{most}\n");
    println!("{:34} {:^w$}   {:^w$}", "", "energy", "momentum about the vertical", w = 9 * (most as usize - 2) + 9);
    let runs = Runs { top: &top, most };
    runs.print("Gauss 6, compensated", Compensated::by(Collocation::order_6(), STEP))?;
    runs.print("Gauss 6", Fixed::by(Collocation::order_6(), STEP))?;
    runs.print("Dormand-Prince 8, compensated", Compensated::with(&Tableau::DORMAND_PRINCE_8, STEP))?;
    runs.print("Dormand-Prince 8 (Munthe-Kaas)", Fixed::with(&Tableau::DORMAND_PRINCE_8, STEP))?;
    runs.print("splitting 8 over the exact motion", Fixed::by(Splitting::exact(&top, Scheme::KAHAN_LI_8)?, STEP))?;
    runs.print("splitting 8 over Moser-Veselov", Fixed::by(Splitting::discrete(&top, Scheme::KAHAN_LI_8)?, STEP))?;
    let second = Splitting::with(&top, Scheme::STRANG, |moments| MoserVeselov::of_order(moments, 2))?;
    runs.print("splitting 2 (symplectic)", Fixed::by(second, STEP))?;
    runs.print("variational 2", Fixed::by(Variational, STEP))?;
    println!("\nEnergies that swing do so with the square of the step, without drift.");
    println!("\nrelative error of the energy of a body in a fluid, after 10^3 … 10^{most} steps");
    for (name, g) in [("without weight", 0.0), ("with weight", 9.81)] {
        for step in [0.02, 0.01] {
            in_fluid(&format!("Gauss 4, compensated, {name}"), g, (step, most), |h| {
                Compensated::by(Collocation::order_4(), h)
            })?;
            in_fluid(&format!("Gauss 6, compensated, {name}"), g, (step, most), |h| {
                Compensated::by(Collocation::order_6(), h)
            })?;
        }
    }
    Ok(())
}

/// A line of errors of the energy of a body in a fluid.
fn in_fluid<C: Control<SubmergedKernel>>(
    name: &str,
    g: f64,
    (step, most): (f64, i32),
    control: impl Fn(f64) -> C,
) -> Result<(), Box<dyn std::error::Error>> {
    let (added, buoyancy) = (Vector6::new(0.3, 1.2, 1.1, 0.05, 0.2, 0.1), Vector3::new(0.0, 0.02, 0.1));
    let body = Submerged { added, buoyancy, g }.kernel()?;
    let q = Isometry3::from_parts(Translation3::identity(), UnitQuaternion::from_euler_angles(0.3, 0.2, 0.1));
    let z = SVector::from([0.3, -0.5, 0.2, 1.1, -0.8, 0.6]);
    print!("{:44} {step} s", name);
    for n in (3..=most).map(|k| 10_f64.powi(k)) {
        let end = Simulation::new(&body).momentum_form().control(control(step)).run_to_end(q, z, 0.0..n * step)?;
        print!("{:9.0e}", body.energy(end.t, &end.q, &end.z) / body.energy(0.0, &q, &z) - 1.0);
    }
    println!();
    Ok(())
}

struct Runs<'a> {
    top: &'a TopKernel,
    most: i32,
}

impl Runs<'_> {
    fn print<C: Control<TopKernel> + Copy>(&self, name: &str, control: C) -> Result<(), Box<dyn std::error::Error>> {
        let numbers = (3..=self.most).map(|k| 10_f64.powi(k));
        let errors = numbers.map(|n| self.errors(control, n)).collect::<Result<Vec<[f64; 2]>, _>>()?;
        print!("{name:34}");
        for quantity in 0..2 {
            if errors[0][quantity] > 1e-9 {
                print!("{:>w$}", "swings", w = 9 * errors.len() + 11);
                continue;
            }
            errors.iter().for_each(|error| print!("{:9.1}", error[quantity] / 1e-16));
            let decades = errors.len() as f64 - 2.0;
            let growth = (errors[errors.len() - 1][quantity] / errors[1][quantity]).log10() / decades.max(1.0);
            print!("   n^{growth:4.2}   ");
        }
        println!();
        Ok(())
    }

    /// Of the energy and of the momentum about the vertical, after n steps.
    fn errors<C: Control<TopKernel> + Copy>(&self, control: C, n: f64) -> Result<[f64; 2], IntegrationError> {
        let mut squares = [0.0; 2];
        for start in 0..4 {
            let q = UnitQuaternion::from_euler_angles(0.5 + 0.1 * f64::from(start), 0.2, 0.1);
            let z = Vector3::new(0.3, 0.2, 2.0);
            let vertical = |q: &UnitQuaternion<f64>, z: &Vector3<f64>| (q * self.top.momentum(0.0, q, z)).z;
            let run = Simulation::new(self.top).momentum_form().control(control);
            let end = run.run_to_end(q, z, 0.0..n * STEP)?;
            let energy = self.top.energy(0.0, &end.q, &end.z) / self.top.energy(0.0, &q, &z) - 1.0;
            squares[0] += energy.powi(2);
            squares[1] += (vertical(&end.q, &end.z) / vertical(&q, &z) - 1.0).powi(2);
        }
        Ok(squares.map(|square| (square / 4.0).sqrt()))
    }
}
