//! The pieces of the Gauss condition belong together: residual, constraint function, mass matrix, momenta, both forms
//! of the equations. Every derivative is exact (dual numbers run through the generated kernels), every comparison is up
//! to the running bound of rounding.

// Matrices are indexed by row and column as in the formulas.
#![allow(clippy::needless_range_loop)]

use crate::common::Bounded;
use crate::common::agreement::{Tally, equal, explore, largest, zero};
use crate::common::body::{Body, Scene, duals, flow, list, rates, speeds};
use crate::common::dual::Dual;
use crate::common::parameters::Parameters;
use crate::common::states::{Motion, State};
use gauss_runtime::prelude::*;
use proptest::prelude::*;
use proptest::test_runner::TestCaseError;

fn dot(a: &[Bounded], b: &[Bounded]) -> Bounded {
    a.iter().zip(b).fold(Bounded::zero(), |sum, (&x, &y)| sum + x * y)
}

/// The rows of the mass matrix.
fn mass_matrix<K: Body<Bounded>>(kernel: &K, q: &K::Configuration) -> Vec<Vec<Bounded>> {
    let matrix = kernel.mass_matrix(Bounded::zero(), q);
    (0..K::DOF).map(|i| (0..K::DOF).map(|j| matrix[(i, j)]).collect()).collect()
}

fn check<S: Scene>(parameters: &Parameters, state: &State, tally: &Tally) -> Result<(), TestCaseError> {
    let kernel = S::kernel::<Bounded>(parameters);
    // Singular points of coordinates have no state to look at.
    let Ok((q, z)) = state.of(&kernel) else { return Ok(()) };
    let direction = &state.direction[..<S::Kernel<Bounded> as GaussSystem>::DOF];
    let direction: Vec<Bounded> = direction.iter().map(|&c| Bounded::from_f64(c)).collect();
    gauss_condition(&kernel, (&q, &z), &direction, tally)?;
    let dual = S::kernel::<Dual<Bounded>>(parameters);
    quadratic_form(&kernel, &dual, (&q, &z), &direction)?;
    momentum_form(&kernel, &dual, (&q, &z), tally)
}

/// Residual zero at ż, `C(ż + δ) − C(ż) = ½ δᵀAδ > 0`, and the residual is ∂C/∂ż: `A δ` at ż + δ.
fn gauss_condition<K: Body<Bounded>>(
    kernel: &K,
    (q, z): (&K::Configuration, &K::Speeds),
    direction: &[Bounded],
    tally: &Tally,
) -> Result<(), TestCaseError> {
    let t = Bounded::zero();
    let z_rate = kernel.acceleration(t, q, z, &());
    let matrix = mass_matrix(kernel, q);
    let residual = list(&kernel.gauss_residual(t, q, z, &z_rate, &()));
    zero("residual at the solution", &residual)?;
    // The terms that cancel in it: A ż, and what stands against it.
    let inertial: f64 = matrix.iter().map(|row| largest(row)).fold(0.0, f64::max) * largest(&list(&z_rate));
    let others = largest(&list(&kernel.gauss_residual(t, q, z, &K::Speeds::zero(), &())));
    tally.count(&residual, inertial.max(others));

    let moved = z_rate.add_scaled(Bounded::one(), &speeds::<_, K::Speeds>(direction));
    let image: Vec<Bounded> = matrix.iter().map(|row| dot(row, direction)).collect();
    equal("slope of C", &list(&kernel.gauss_residual(t, q, z, &moved, &())), &image)?;
    let excess = kernel.constraint_function(t, q, z, &moved, &()) - kernel.constraint_function(t, q, z, &z_rate, &());
    let expected = Bounded::ratio(1, 2) * dot(direction, &image);
    equal("excess of C", &[excess], &[expected])?;
    // Larger at any other ż: more than rounding can explain, unless the other ż is ż itself up to rounding.
    if largest(direction) > 1e-3 && expected.value > expected.bound {
        prop_assert!(excess.value + excess.bound > 0.0, "C is not least at ż: {excess:?}");
    }
    Ok(())
}

/// A is symmetric, positive definite and ∂²T/∂z∂z; `p = ∂T/∂z = A z`; `T = ½ zᵀAz`; z(p(z)) = z.
fn quadratic_form<K: Body<Bounded>, D: Body<Dual<Bounded>>>(
    kernel: &K,
    dual: &D,
    (q, z): (&K::Configuration, &K::Speeds),
    direction: &[Bounded],
) -> Result<(), TestCaseError> {
    let t = Bounded::zero();
    let matrix = mass_matrix(kernel, q);
    for i in 0..K::DOF {
        for j in 0..i {
            // The program shares the entry, so not a bit differs.
            prop_assert_eq!(matrix[i][j].value.to_bits(), matrix[j][i].value.to_bits());
        }
    }
    prop_assert!(positive_definite(&matrix), "mass matrix {matrix:?}");

    let (momentum, z_list) = (list(&kernel.momentum(t, q, z)), list(z));
    let product: Vec<Bounded> = matrix.iter().map(|row| dot(row, &z_list)).collect();
    equal("p = A z", &momentum, &product)?;
    let kinetic = kernel.kinetic_energy(t, q, z);
    equal("T = ½ zᵀAz", &[kinetic], &[Bounded::ratio(1, 2) * dot(&z_list, &product)])?;

    let (q_dual, still) = flow_at_rest::<K, D>(q, z);
    for k in 0..K::DOF {
        let axis: Vec<Bounded> = (0..K::DOF).map(|i| Bounded::from_f64(f64::from(u8::from(i == k)))).collect();
        let varied: D::Speeds = speeds(&duals(&z_list, &axis));
        let slope = dual.kinetic_energy(Dual::zero(), &q_dual, &varied).rate;
        equal("p = ∂T/∂z", &[slope], &[momentum[k]])?;
        let row = rates(&list(&dual.momentum(Dual::zero(), &q_dual, &varied)));
        equal("A = ∂p/∂z", &row, &matrix[k])?;
    }
    let there = kernel.momentum(t, q, z);
    equal("velocity after momentum", &list(&kernel.velocity(t, q, &there)), &z_list)?;
    let p = speeds::<_, K::Speeds>(direction);
    let back = kernel.momentum(t, q, &kernel.velocity(t, q, &p));
    equal("momentum after velocity", &list(&back), direction)?;
    // Nothing moves in a state at rest.
    zero("rates at rest", &rates(&list(&dual.momentum(Dual::zero(), &q_dual, &still))))
}

/// A state without rates.
fn flow_at_rest<K: Body<Bounded>, D: Body<Dual<Bounded>>>(
    q: &K::Configuration,
    z: &K::Speeds,
) -> (D::Configuration, D::Speeds) {
    let none = vec![Bounded::zero(); K::DOF];
    crate::common::body::vary_speeds::<_, K, D>(q, z, &none)
}

/// Whether LDLᵀ has positive pivots only, by more than rounding explains.
fn positive_definite(matrix: &[Vec<Bounded>]) -> bool {
    let mut a = matrix.to_vec();
    for k in 0..a.len() {
        let pivot = a[k][k];
        // An indefinite matrix within rounding of a definite one is what random bodies can give near singular points.
        let positive = pivot.value + pivot.bound > 0.0;
        if !positive {
            return false;
        }
        for i in k + 1..a.len() {
            let factor = a[i][k] / pivot;
            for j in k + 1..a.len() {
                let update = factor * a[k][j];
                a[i][j] -= update;
            }
        }
    }
    true
}

/// Along the flow of the velocity form, p = A z changes by the momentum form's ṗ.
fn momentum_form<K: Body<Bounded>, D: Body<Dual<Bounded>>>(
    kernel: &K,
    dual: &D,
    (q, z): (&K::Configuration, &K::Speeds),
    tally: &Tally,
) -> Result<(), TestCaseError> {
    let t = Bounded::zero();
    let z_rate = kernel.acceleration(t, q, z, &());
    let (q_dual, z_dual) = flow::<_, K, D>(kernel, q, z, &z_rate);
    let moving = rates(&list(&dual.momentum(Dual::zero(), &q_dual, &z_dual)));
    let momentum = kernel.momentum(t, q, z);
    let rate = list(&kernel.momentum_rate(t, q, &momentum, &()));
    equal("ṗ in both forms", &moving, &rate)?;
    // Its terms are products of momenta and velocities, and forces.
    let velocities = largest(&list(z)).max(largest(&list(&kernel.body_twist(t, q, z))));
    tally.count(&rate, (largest(&list(&momentum)) * velocities).max(largest(&rate)));
    Ok(())
}

/// The share of residuals and momentum rates that are proved to 1e-12 relative to the terms that enter: the bound of ż
/// is multiplied by A once more, so fewer than of the accelerations themselves.
const SHARE: f64 = 0.5;

macro_rules! forms {
    ($motion:ident: $($chart:ident)+) => {
        #[test]
        fn belong_together() {
            use super::*;
            explore(Motion::$motion, SHARE, |parameters, state, tally| {
                $(
                    check::<$chart<()>>(parameters, state, tally).map_err(|error| match error {
                        TestCaseError::Fail(why) => TestCaseError::fail(format!("{}: {why}", stringify!($chart))),
                        reject => reject,
                    })?;
                )+
                Ok(())
            });
        }
    };
}

mod everything_free {
    usual_charts!(everything, free);
    forms!(Free: Left Right Hybrid Zyx Zxz Modified);
}

mod everything_fixed_point {
    usual_charts!(everything, fixed_point);
    forms!(FixedPoint: Left Right Hybrid Zyx Zxz Modified);
}

mod everything_planar {
    planar_charts!(everything);
    forms!(Planar: Left Right Hybrid Jet);
}

mod principal_free {
    usual_charts!(principal, free);
    forms!(Free: Left Right Hybrid Zyx Zxz Modified);
}

mod heavy_free {
    usual_charts!(heavy, free);
    forms!(Free: Left Right Hybrid Zyx Zxz Modified);
}

mod heavy_fixed_point {
    usual_charts!(heavy, fixed_point);
    forms!(FixedPoint: Left Right Hybrid Zyx Zxz Modified);
}

mod torpedo_free {
    usual_charts!(torpedo, free);
    forms!(Free: Left Right Hybrid Zyx Zxz Modified);
}

mod afloat_planar {
    planar_charts!(afloat);
    forms!(Planar: Left Right Hybrid Jet);
}

/// Without forces the right-invariant momentum (Q̂, Γ̂_Ω) is constant, and the code knows: not an operation, not a bit.
mod right_invariant_without_forces {
    use super::*;

    mod principal_free {
        principal!(Right RightKernel, free, [right_invariant]);
    }
    mod adrift_free {
        adrift!(Right RightKernel, free, [right_invariant]);
    }
    mod adrift_fixed_point {
        adrift!(Right RightKernel, fixed_point, [right_invariant]);
    }
    mod adrift_planar {
        adrift!(Right RightKernel, planar, [right_invariant]);
    }

    fn constant<S: Scene>(parameters: &Parameters, state: &State) -> Result<(), TestCaseError> {
        prop_assert_eq!(<S::Kernel<f64> as DescribedSystem>::OPERATIONS.momentum_rate.total(), 0);
        let kernel = S::kernel::<Bounded>(parameters);
        let (q, z) = state.of(&kernel).expect("regular everywhere");
        let p = kernel.momentum(Bounded::zero(), &q, &z);
        for rate in list(&kernel.momentum_rate(Bounded::zero(), &q, &p, &())) {
            prop_assert_eq!((rate.value, rate.bound), (0.0, 0.0));
        }
        Ok(())
    }

    #[test]
    fn momentum_is_constant_to_the_last_bit() {
        // Nothing is rounded, so there is nothing for the tally to count but one exact number.
        let exact = [Bounded::zero()];
        explore(Motion::Free, 1.0, |parameters, state, tally| {
            tally.count(&exact, 1.0);
            constant::<principal_free::Right<()>>(parameters, state)?;
            constant::<adrift_free::Right<()>>(parameters, state)
        });
        explore(Motion::FixedPoint, 1.0, |parameters, state, tally| {
            tally.count(&exact, 1.0);
            constant::<adrift_fixed_point::Right<()>>(parameters, state)
        });
        explore(Motion::Planar, 1.0, |parameters, state, tally| {
            tally.count(&exact, 1.0);
            constant::<adrift_planar::Right<()>>(parameters, state)
        });
    }
}
