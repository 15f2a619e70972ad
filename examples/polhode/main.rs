//! A body that nothing acts on turns over and back, spun about its middle axis: the polhode, beside Euler's solution.
//!
//! `cargo run --release --example polhode [-- FOLDER]` writes the page into `FOLDER`, by default `target/gauss`.

use std::error::Error;
use std::f64::consts::FRAC_PI_2;

use gauss_examples::plots::write_page;
use gauss_playback::{Playback, Shape};
use gauss_runtime::prelude::*;

/// kg: it says how large the box is that is drawn.
const MASS: f64 = 1.5;

/// A body about its centre of mass.
#[derive(GaussDynamics)]
#[gauss(chart = left_invariant, motion = fixed_point)]
struct Free {
    #[gauss(mass)]
    mass: f64,
    #[gauss(inertia)]
    moments: Vector3<f64>,
}

/// The complete elliptic integral K and the functions sn, cn, dn for the parameter m = k², by arithmetic-geometric
/// means: Abramowitz and Stegun, 16.4 and 17.6.
struct Elliptic {
    quarter: f64,
    m: f64,
    /// a and c of each mean.
    means: Vec<(f64, f64)>,
}

impl Elliptic {
    fn new(m: f64) -> Self {
        let (mut a, mut b) = (1.0_f64, (1.0 - m).sqrt());
        let mut means = vec![(a, m.sqrt())];
        while means[means.len() - 1].1 > 1e-16 {
            means.push((0.5 * (a + b), 0.5 * (a - b)));
            (a, b) = (0.5 * (a + b), (a * b).sqrt());
        }
        Self { quarter: FRAC_PI_2 / a, m, means }
    }

    /// sn, cn, dn.
    fn at(&self, u: f64) -> [f64; 3] {
        let last = self.means.len() - 1;
        let mut phi = f64::powi(2.0, last as i32) * self.means[last].0 * u;
        for (a, c) in self.means[1..].iter().rev() {
            phi = 0.5 * (phi + (c / a * phi.sin()).asin());
        }
        let (sn, cn) = phi.sin_cos();
        [sn, cn, (1.0 - self.m * sn * sn).sqrt()]
    }
}

/// ω(t) of a body with I₁ < I₂ < I₃ that begins with ω = (0, w₂, w₃), as Euler and Jacobi have it (Landau and Lifshitz,
/// Mechanics, § 37), and the time from one flip to the next.
fn euler(moments: Vector3<f64>, start: Vector3<f64>) -> (f64, impl Fn(f64) -> Vector3<f64>) {
    let [i1, i2, i3] = moments.into();
    let twice = moments.dot(&start.component_mul(&start));
    let square = moments.component_mul(&start).norm_squared();
    let rate = ((i3 - i2) * (square - twice * i1) / (i1 * i2 * i3)).sqrt();
    let (over, under) = (twice * i3 - square, square - twice * i1);
    let elliptic = Elliptic::new((i2 - i1) * over / ((i3 - i2) * under));
    let sizes = Vector3::new(
        (over / (i1 * (i3 - i1))).sqrt(),
        (over / (i2 * (i3 - i2))).sqrt(),
        (under / (i3 * (i3 - i1))).sqrt(),
    );
    let flip = 2.0 * elliptic.quarter / rate;
    let omega = move |t: f64| {
        let [sn, cn, dn] = elliptic.at(elliptic.quarter + rate * t);
        sizes.component_mul(&Vector3::new(cn, sn, dn))
    };
    (flip, omega)
}

fn main() -> Result<(), Box<dyn Error>> {
    let moments = Vector3::new(0.2, 0.3, 0.4);
    let start = Vector3::new(0.0, 4.0, 0.04);
    let kernel = Free { mass: MASS, moments }.kernel()?;
    println!("{}\n", FreeKernel::EQUATIONS);

    let (flip, exact) = euler(moments, start);
    let path =
        Simulation::new(&kernel).adaptive(1e-12, 1e-12).run(UnitQuaternion::identity(), start, 0.0..4.5 * flip)?;
    println!("   t/s     ω₁        ω₂        ω₃ in rad/s   from Euler's solution");
    let mut worst = 0.0_f64;
    for n in 0..=18 {
        let s = path.at(0.25 * flip * f64::from(n)).expect("inside the run");
        let apart = (s.z - exact(s.t)).norm() / start.norm();
        worst = worst.max(apart);
        println!("{:6.2} {:9.5} {:9.5} {:9.5}   {apart:.0e}", s.t, s.z[0], s.z[1], s.z[2]);
    }
    println!("\nit turns over every {flip:.4} s; at most {worst:.0e} from Euler's solution");
    // Errors of 1e-12 a step grow a hundred times from flip to flip along with the disturbance, and back again; what
    // is left is the error of the phase, which grows along the way.
    if worst > 1e-7 {
        return Err("this is not Euler's solution".into());
    }
    write_page("polhode", &page(&kernel, moments, &path)?)
}

/// The body, and beside it what it sees: the ellipsoid of constant energy in its axes, along which ω wanders.
fn page(
    kernel: &FreeKernel,
    moments: Vector3<f64>,
    path: &Trajectory<FreeKernel>,
) -> Result<Playback<FreeKernel>, IntegrationError> {
    // A box of this mass with these moments: edges² = 6 (Iᵢ + Iⱼ − Iₖ)/m.
    let edges = (Vector3::repeat(moments.sum()) - moments * 2.0).map(|sum| (6.0 * sum / MASS).sqrt());
    let s = path.first();
    let twice = 2.0 * kernel.kinetic_energy(s.t, &s.q, &s.z);
    let scale = 0.2;
    let beside = Vector3::new(0.0, 2.4, 0.0);
    let ellipsoid = moments.map(|moment| scale * (twice / moment).sqrt());
    let still = move |place: Vector3<f64>| Isometry3::translation(place.x, place.y, place.z);
    let mut page = Playback::with_pictures("Spun about its middle axis", path, 1200)?
        .si()
        .body("body", |s| Isometry3::from_parts(Translation3::identity(), s.q), [Shape::cuboid(edges.into())])
        .body("energy in the body's axes", move |_| still(beside), [Shape::ellipsoid(ellipsoid.into())])
        .body("ω in the body's axes", move |s| still(beside + s.z * scale * 1.03), [Shape::ball(0.035)])
        .trace("ω in the body's axes", [0.0; 3])
        .trace("body", [0.0, 0.5 * edges.y, 0.0])
        .arrow("angular momentum", 1.4, |s| (Vector3::zeros(), s.q * s.p));
    for (k, name) in ["ω₁", "ω₂", "ω₃"].into_iter().enumerate() {
        page = page.curve("angular velocity in the body's axes / (rad/s)", name, move |s| s.z[k]);
    }
    Ok(page.energy(kernel))
}
