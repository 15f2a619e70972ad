//! Closed loops, and loops of control.

use gauss_runtime::prelude::*;
use gauss_sensitivity::{At, Cost, Derivatives, Run, Start};

use super::number;

macro_rules! slider_crank {
    ($name:ident $(, $clause:tt ($($inside:tt)*))?) => {
        /// A crank, a rod, and a piston along k₁. Gravity along −k₂.
        #[derive(GaussDynamics)]
        #[gauss(
            coordinates(crank, rod, piston),
            speeds(w, s, v),
            kinematics(crank = w, rod = s, piston = v),
            body(wheel, rotation = rotation_z(crank), mass = 2, inertia = [0.01, 0.01, i]),
            body(arm, parent = wheel, position = [r, 0, 0], rotation = rotation_z(rod),
                 mass = 0.5, center_of_mass = [l / 2, 0, 0], inertia_about_center_of_mass = [0, 0.003, 0.003]),
            particle(mass = m, position = [piston, 0, 0]),
            point(pin, body = arm, at = [l, 0, 0]),
            constraint(position = pin - [piston, 0, 0]),
            gravity = [0, -9.81, 0],
            $($clause($($inside)*),)?
        )]
        struct $name<T> {
            r: T,
            l: T,
            i: T,
            m: T,
        }
    };
}
slider_crank!(Multipliers);
slider_crank!(Solved, independent(w));

/// By r, l, i, m and the first rate of the crank: with a loop that multipliers close.
struct Closed;
/// The same with one speed, of which the other two are made.
struct Open;

const INSTANTS: &[f64] = &[0.0, 0.3, 0.8];

impl Run<5> for Closed {
    type System<T: Real> = MultipliersKernel<T>;

    fn instants(&self) -> &[f64] {
        INSTANTS
    }

    fn system<T: Real>(&self, &[r, l, i, m, _]: &[T; 5]) -> Result<MultipliersKernel<T>, ParameterError> {
        Multipliers { r, l, i, m }.kernel()
    }

    fn start<T: Real>(&self, numbers: &[T; 5], _: &MultipliersKernel<T>) -> Start<MultipliersKernel<T>> {
        let (q, z) = closed(numbers);
        (SVector::from(q), SVector::from(z))
    }
}

impl Run<5> for Open {
    type System<T: Real> = SolvedKernel<T>;

    fn instants(&self) -> &[f64] {
        INSTANTS
    }

    fn system<T: Real>(&self, &[r, l, i, m, _]: &[T; 5]) -> Result<SolvedKernel<T>, ParameterError> {
        Solved { r, l, i, m }.kernel()
    }

    fn start<T: Real>(&self, numbers: &[T; 5], _: &SolvedKernel<T>) -> Start<SolvedKernel<T>> {
        let (q, z) = closed(numbers);
        (SVector::from(q), SVector::from([z[0]]))
    }
}

/// A state that closes the loop: the pin is on k₁, and stays there.
fn closed<T: Real>(&[r, l, _, _, w]: &[T; 5]) -> ([T; 3], [T; 3]) {
    let crank = number::<T>(0.7);
    let (sine, cosine) = crank.sin_cos();
    let slant = -(r * sine / l).asin();
    let s = -r * cosine * w / (l * slant.cos()) - w;
    let v = -r * sine * w - l * slant.sin() * (w + s);
    ([crank, slant - crank, r * cosine + l * slant.cos()], [w, s, v])
}

const NUMBERS: [f64; 5] = [0.1, 0.3, 0.015, 1.0, 20.0];

/// Two systems of equations with the same motion: projections and multipliers are differentiated as they should.
#[test]
fn a_loop_has_the_derivatives_of_the_motion_without_it() {
    let derivatives = Derivatives::adaptive(1e-12, 1e-12);
    let points = derivatives.run(&Closed, &NUMBERS).expect("turns");
    let others = derivatives.run(&Open, &NUMBERS).expect("turns");
    for (point, other) in points.iter().zip(&others) {
        for k in 0..5 {
            for i in 0..3 {
                // Numbers up to 20, in some hundred steps of 1e-12 each; by numbers as small as 0.02.
                let (found, expected) = (point.q_slopes[i][k], other.q_slopes[i][k]);
                assert!((found - expected).abs() < 1e-8 * (1.0 + expected.abs()), "{i} {k}: {found} {expected}");
            }
            let (found, expected) = (point.z_slopes[0][k], other.z_slopes[0][k]);
            assert!((found - expected).abs() < 1e-8 * (1.0 + expected.abs()), "{k}: {found} {expected}");
        }
    }
    // The loop stays closed whatever the lengths are: ∂φ/∂r + ∂φ/∂q ∂q/∂r = 0, and by all others.
    for point in &points[1..] {
        let slanted = point.q[0] + point.q[1];
        for k in 0..5 {
            let [crank, rod, piston] = [0, 1, 2].map(|i| point.q_slopes[i][k]);
            let along = f64::from(u8::from(k == 0)) * point.q[0].cos() - NUMBERS[0] * point.q[0].sin() * crank
                + f64::from(u8::from(k == 1)) * slanted.cos()
                - NUMBERS[1] * slanted.sin() * (crank + rod)
                - piston;
            // Rounding of the slopes, which are up to some hundreds.
            assert!(along.abs() < 1e-12 * (1.0 + crank.abs() + rod.abs() + piston.abs()), "{k}: {along:e}");
        }
    }
}

/// Energy and the place of the piston at each instant.
impl Cost<5> for Closed {
    fn cost<T: Real>(&self, _: &[T; 5], at: &At<'_, MultipliersKernel<T>>) -> T {
        at.system.kinetic_energy(at.t, at.q, at.z) * at.q[2]
    }
}

impl Cost<5> for Open {
    fn cost<T: Real>(&self, _: &[T; 5], at: &At<'_, SolvedKernel<T>>) -> T {
        at.system.kinetic_energy(at.t, at.q, at.z) * at.q[2]
    }
}

#[test]
fn gradients_pass_through_projections() {
    let derivatives = Derivatives::adaptive(1e-12, 1e-12);
    let closed = derivatives.gradient(&Closed, &NUMBERS).expect("turns");
    let open = derivatives.gradient(&Open, &NUMBERS).expect("turns");
    assert!((closed.value - open.value).abs() < 1e-10);
    for (found, expected) in closed.by_numbers.into_iter().zip(open.by_numbers) {
        // As above; energies are of order 1 to 10.
        assert!((found - expected).abs() < 1e-8 * (1.0 + expected.abs()), "{found} {expected}");
    }
}

/// A guess that nothing closes but the projection of the system: its derivatives are those of the implicit function.
struct Guessed;

impl Run<5> for Guessed {
    type System<T: Real> = MultipliersKernel<T>;

    fn instants(&self) -> &[f64] {
        INSTANTS
    }

    fn system<T: Real>(&self, numbers: &[T; 5]) -> Result<MultipliersKernel<T>, ParameterError> {
        Closed.system(numbers)
    }

    fn start<T: Real>(&self, numbers: &[T; 5], system: &MultipliersKernel<T>) -> Start<MultipliersKernel<T>> {
        let guess = (SVector::from([0.7, -0.9, 0.35].map(number)), SVector::from([numbers[4], T::zero(), T::zero()]));
        system.project(T::zero(), &guess.0, &guess.1).unwrap_or(guess)
    }
}

#[test]
fn a_start_may_be_projected() {
    let derivatives = Derivatives::fixed_step(0.01);
    let points = derivatives.run(&Guessed, &NUMBERS).expect("turns");
    let found = [points[0].q_slopes[1], points[0].z_slopes[2], points[2].q_slopes[0], points[2].z_slopes[0]];
    // Eighty steps of some thousand roundings, projections among them, of numbers up to 20.
    super::hold(found, &NUMBERS, 1e-3, 8e4 * 20.0 * f64::EPSILON, |numbers| {
        let points = derivatives.run(&Guessed, numbers).expect("turns");
        [points[0].q[1], points[0].z[2], points[2].q[0], points[2].z[0]]
    });
}
