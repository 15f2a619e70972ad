//! A pole balanced on a cart by a linear–quadratic regulator: `cargo run --release --example cart_pole`.
//!
//! `#[gauss(linearize)]` has the derive write the exact derivatives of the equations; upright they are the A and B that
//! the regulator is designed for. It is then tried on the equations themselves. The page that plays goes to
//! `target/gauss`.

use std::error::Error;

use gauss_examples::plots::write_page;
use gauss_examples::stage;
use gauss_playback::Playback;
use gauss_runtime::prelude::*;

/// A cart on a rail, and a pole on its hinge; the angle is from upright.
#[derive(GaussDynamics)]
#[gauss(
    linearize,
    coordinates(x, theta),
    particle(mass = cart, position = [x, 0, 0]),
    particle(mass = bob, position = [x + length * sin(theta), 0, length * cos(theta)]),
    input(push = "N"),
    drive(x = push),
)]
struct CartPole {
    #[gauss(unit = "kg")]
    cart: f64,
    #[gauss(unit = "kg")]
    bob: f64,
    #[gauss(unit = "m")]
    length: f64,
    #[gauss(gravity, unit = "m/s^2")]
    g: f64,
}

type State = SVector<f64, 4>;
type Square = SMatrix<f64, 4, 4>;
type Hamiltonian = SMatrix<f64, 8, 8>;

/// P of `AᵀP + PA − PBBᵀP/r + Q = 0` that makes `A − BBᵀP/r` stable: from the sign of the Hamiltonian matrix by
/// Newton's iteration (Roberts, *Linear model reduction and solution of the algebraic Riccati equation*, Int. J.
/// Control 32, 1980).
fn riccati(a: &Square, b: &State, q: &Square, r: f64) -> Option<Square> {
    let mut z = Hamiltonian::zeros();
    z.fixed_view_mut::<4, 4>(0, 0).copy_from(a);
    z.fixed_view_mut::<4, 4>(0, 4).copy_from(&(b * b.transpose() / -r));
    z.fixed_view_mut::<4, 4>(4, 0).copy_from(&-q);
    z.fixed_view_mut::<4, 4>(4, 4).copy_from(&-a.transpose());
    for _ in 0..100 {
        let next = (z + z.try_inverse()?) * 0.5;
        let change = (next - z).amax();
        z = next;
        if change <= 1e-13 * z.amax() {
            break;
        }
    }
    // (sign + 1) (1; P) = 0: the stable subspace.
    let mut left = SMatrix::<f64, 8, 4>::zeros();
    let mut right = left;
    left.copy_from(&z.fixed_columns::<4>(4));
    right.copy_from(&-z.fixed_columns::<4>(0));
    for i in 0..4 {
        left[(i + 4, i)] += 1.0;
        right[(i, i)] -= 1.0;
    }
    let p = (left.transpose() * left).try_inverse()? * left.transpose() * right;
    Some((p + p.transpose()) * 0.5)
}

fn main() -> Result<(), Box<dyn Error>> {
    let kernel = CartPole { cart: 1.0, bob: 0.2, length: 0.6, g: 9.81 }.kernel()?;
    let (upright, still) = (SVector::from([0.0, 0.0]), SVector::from([0.0, 0.0]));
    // ANCHOR: regulator
    let linear = kernel.linearize(0.0, &upright, &still, &SVector::from([0.0]));
    let (a, b) = (linear.by_state, linear.by_input);
    // ANCHOR_END: regulator
    println!("d/dt (δx, δθ, δẋ, δθ̇) = A (δx, δθ, δẋ, δθ̇) + B push\nA ={a:.4}B ={b:.4}");

    // The pole matters more than where the cart is, and pushes cost little.
    let (q, r) = (Square::from_diagonal(&State::new(1.0, 10.0, 1.0, 1.0)), 0.1);
    let p = riccati(&a, &b, &q, r).ok_or("the pole cannot be balanced")?;
    let gains = b.transpose() * p / r;
    println!("push = −K (x, θ, ẋ, θ̇), K ={gains:.3}");
    let residual = (a.transpose() * p + p * a - p * b * b.transpose() * p / r + q).amax();

    // ANCHOR: law
    let law = |_: f64, q: &_, z: &_| {
        let CartPoleState { x, theta, x_dot, theta_dot } = CartPoleState::of(q, z);
        -gains * State::new(x, theta, x_dot, theta_dot)
    };
    let simulation = Simulation::new(&kernel).input(law);
    // ANCHOR_END: law
    println!("    t/s     x/m  θ/rad   push/N");
    let tilted = CartPoleState { theta: 0.6, ..CartPoleState::default() };
    let fall = simulation.adaptive(1e-9, 1e-9).run(tilted.q(), tilted.z(), 0.0..8.0)?;
    for n in 0..=8 {
        let s = fall.at(f64::from(n)).expect("inside the run");
        let CartPoleState { x, theta, .. } = CartPoleState::of(&s.q, &s.z);
        println!("  {:5.1} {x:7.3} {theta:6.3} {:8.3}", s.t, law(s.t, &s.q, &s.z)[0]);
    }

    // Near upright a disturbance x costs xᵀPx in the end: a check of derivatives, regulator and run together. What the
    // linear equations neglect is of second order in the angle.
    let start = State::new(0.0, 1e-3, 0.0, 0.0);
    let (step, mut cost, mut before) = (1e-3, 0.0, None);
    let run = simulation.fixed_step(step).run(upright + SVector::from([0.0, 1e-3]), still, 0.0..15.0)?;
    for s in run.iter() {
        let x = State::new(s.q[0], s.q[1], s.z[0], s.z[1]);
        let rate = x.dot(&(q * x)) + r * law(s.t, &s.q, &s.z)[0].powi(2);
        cost += before.map_or(0.0, |before: f64| 0.5 * step * (before + rate));
        before = Some(rate);
    }
    let expected = start.dot(&(p * start));
    println!("\ncost of a small disturbance: {cost:.6e}, xᵀPx = {expected:.6e}");
    let last = fall.last();
    if residual > 1e-9 || (cost / expected - 1.0).abs() > 1e-4 || last.q.amax() > 1e-2 {
        return Err("the regulator does not do what it was designed for".into());
    }
    let page = Playback::new("A pole balanced by its cart", &fall)?.si();
    let page = stage::cart_and_pole(page, 0.6, 0.05, |s| law(s.t, &s.q, &s.z)[0]);
    write_page("cart_pole", &page.energy(&kernel))
}
