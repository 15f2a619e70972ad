//! What must be conserved is, instant by instant: rates of energy and momentum along the flow, by dual numbers; and two
//! charts against equations of motion typed by hand from textbooks.

use crate::common::Bounded;
use crate::common::agreement::{Tally, equal, explore, largest, zero};
use crate::common::body::{Body, Scene, apply, cross, flow, list, rates, rotation_matrix};
use crate::common::dual::Dual;
use crate::common::parameters::Parameters;
use crate::common::states::{Motion, State};
use gauss_runtime::prelude::*;
use proptest::test_runner::TestCaseError;

/// Which components of the momentum in space (Q̂, Γ̂_Ω) the forces leave alone.
#[derive(Clone, Copy)]
enum Conserved {
    /// No forces: all that the motion does not constrain.
    All,
    /// Gravity and buoyancy along k₃: Q̂₁, Q̂₂ and Γ̂₃.
    AboutVertical,
    /// A general field, or reactions that carry momentum away.
    Nothing,
}

fn check<S: Scene>(
    parameters: &Parameters,
    state: &State,
    conserved: Conserved,
    tally: &Tally,
) -> Result<(), TestCaseError> {
    let kernel = S::kernel::<Bounded>(parameters);
    let Ok((q, z)) = state.of(&kernel) else { return Ok(()) };
    along_the_flow(&kernel, &S::kernel::<Dual<Bounded>>(parameters), (&q, &z), conserved, tally)
}

fn along_the_flow<K: Body<Bounded>, D: Body<Dual<Bounded>>>(
    kernel: &K,
    dual: &D,
    (q, z): (&K::Configuration, &K::Speeds),
    conserved: Conserved,
    tally: &Tally,
) -> Result<(), TestCaseError> {
    let z_rate = kernel.acceleration(Bounded::zero(), q, z, &());
    // The terms that cancel in the power balance are products p·ż.
    let scale = largest(&list(&kernel.momentum(Bounded::zero(), q, z))) * largest(&list(&z_rate));
    let (q, z) = flow::<_, K, D>(kernel, q, z, &z_rate);
    let t = Dual::zero();
    // All forces have a potential, so the power balance is dE/dt = 0.
    let (kinetic, potential) = (dual.kinetic_energy(t, &q, &z), dual.potential_energy(t, &q));
    zero("dE/dt", &[kinetic.rate + potential.rate])?;
    equal("E = T + V", &[dual.energy(t, &q, &z).rate], &[kinetic.rate + potential.rate])?;
    tally.count(&[kinetic.rate + potential.rate], scale.max(potential.rate.value.abs()));

    let rates = rates(&list(&dual.space_momentum(t, &q, &z)));
    match conserved {
        Conserved::All => zero("momentum in space", &rates),
        Conserved::AboutVertical => zero("momentum in space", &[rates[0], rates[1], rates[5]]),
        Conserved::Nothing => Ok(()),
    }
}

/// The share of power balances that are proved to 1e-12 relative to the terms that enter. With a full added mass they
/// sum several hundred products, whose worst cases add up to more for most bodies; those are zero up to their bounds.
const SHARE: f64 = 0.3;

macro_rules! conserved {
    ($motion:ident, $conserved:ident: $($chart:ident)+) => {
        #[test]
        fn is_conserved() {
            use super::*;
            explore(Motion::$motion, SHARE, |parameters, state, tally| {
                $(
                    check::<$chart<()>>(parameters, state, Conserved::$conserved, tally).map_err(|error| match error {
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
    conserved!(Free, Nothing: Left Right Hybrid Zyx Zxz Modified);
}

mod everything_fixed_point {
    usual_charts!(everything, fixed_point);
    conserved!(FixedPoint, Nothing: Left Right Hybrid Zyx Zxz Modified);
}

mod everything_planar {
    planar_charts!(everything);
    conserved!(Planar, Nothing: Left Right Hybrid Jet);
}

mod adrift_free {
    usual_charts!(adrift, free);
    conserved!(Free, All: Left Right Hybrid Zyx Zxz Modified);
}

mod principal_free {
    usual_charts!(principal, free);
    conserved!(Free, All: Left Right Hybrid Zyx Zxz Modified);
}

mod heavy_free {
    usual_charts!(heavy, free);
    conserved!(Free, AboutVertical: Left Right Hybrid Zyx Zxz Modified);
}

mod afloat_free {
    usual_charts!(afloat, free);
    conserved!(Free, AboutVertical: Left Right Hybrid Zyx Zxz Modified);
}

/// About the fixed point the reaction has no torque, but it does carry linear momentum: only Γ̂₃ is conserved.
mod top {
    use super::*;
    usual_charts!(heavy, fixed_point);

    fn vertical<S: Scene>(parameters: &Parameters, state: &State) -> Result<(), TestCaseError> {
        fn rate<K: Body<Bounded>, D: Body<Dual<Bounded>>>(
            kernel: &K,
            dual: &D,
            (q, z): (&K::Configuration, &K::Speeds),
        ) -> Result<(), TestCaseError> {
            let z_rate = kernel.acceleration(Bounded::zero(), q, z, &());
            let (q, z) = flow::<_, K, D>(kernel, q, z, &z_rate);
            zero("Γ̂₃", &[rates(&list(&dual.space_momentum(Dual::zero(), &q, &z)))[5]])
        }
        let kernel = S::kernel::<Bounded>(parameters);
        let Ok((q, z)) = state.of(&kernel) else { return Ok(()) };
        rate(&kernel, &S::kernel::<Dual<Bounded>>(parameters), (&q, &z))
    }

    #[test]
    fn keeps_its_vertical_momentum() {
        explore(Motion::FixedPoint, SHARE, |parameters, state, tally| {
            vertical::<Left<()>>(parameters, state)?;
            vertical::<Right<()>>(parameters, state)?;
            vertical::<Hybrid<()>>(parameters, state)?;
            vertical::<Zyx<()>>(parameters, state)?;
            vertical::<Zxz<()>>(parameters, state)?;
            vertical::<Modified<()>>(parameters, state)?;
            check::<Left<()>>(parameters, state, Conserved::Nothing, tally)
        });
    }
}

/// The weight and the buoyancy as a wrench (F, M_O) in body axes.
fn wrench<T: Real>(p: &Parameters, r: &[[T; 3]; 3]) -> ([T; 3], [T; 3]) {
    // Rᵀ g.
    let g: [T; 3] = std::array::from_fn(|i| (0..3).fold(T::zero(), |s, k| s + r[k][i] * T::from_f64(p.field[k])));
    let weight = g.map(|g| T::from_f64(p.m) * g);
    let buoyancy = g.map(|g| -T::from_f64(p.displaced) * g);
    let torque = add(cross(p.c.map(T::from_f64), weight), cross(p.buoyancy.map(T::from_f64), buoyancy));
    (add(weight, buoyancy), torque)
}

fn add<T: Real>(a: [T; 3], b: [T; 3]) -> [T; 3] {
    std::array::from_fn(|i| a[i] + b[i])
}

/// Kirchhoff's equations with Fossen's matrix of inertia (*Handbook of Marine Craft Hydrodynamics and Motion Control*,
/// chapters 3 and 6): M ν̇ = products of momenta and velocities + wrench, solved by Cholesky's method.
mod kirchhoff {
    use super::*;
    everything!(Left LeftKernel, free, [left_invariant]);

    /// M about O: m 1, −m [c]×; m [c]×, I_O; plus the added mass.
    fn inertia(p: &Parameters) -> Matrix6<f64> {
        let [c1, c2, c3] = p.c.map(|c| p.m * c);
        let skew = [[0.0, -c3, c2], [c3, 0.0, -c1], [-c2, c1, 0.0]];
        Matrix6::from_fn(|i, j| {
            let body = match (i < 3, j < 3) {
                (true, true) => {
                    if i == j {
                        p.m
                    } else {
                        0.0
                    }
                }
                (true, false) => -skew[i][j - 3],
                (false, true) => skew[i - 3][j],
                (false, false) => p.full[i - 3][j - 3],
            };
            body + p.fluid[i][j]
        })
    }

    #[test]
    fn equations_typed_by_hand_agree() {
        explore(Motion::Free, SHARE, |parameters, state, tally| {
            let matrix = inertia(parameters);
            let r = rotation_matrix(&state.rotation);
            let nu = SVector::<f64, 6>::from(state.twist);
            let momentum = (matrix * nu).data.0[0];
            let (linear, angular) = ([momentum[0], momentum[1], momentum[2]], [momentum[3], momentum[4], momentum[5]]);
            let (u, w) = ([nu[0], nu[1], nu[2]], [nu[3], nu[4], nu[5]]);
            let (force, torque) = wrench(parameters, &r);
            // Q̇ = Q × ω + F, Γ̇ = Γ × ω + Q × u + M_O.
            let linear_rate = add(cross(linear, w), force);
            let angular_rate = add(add(cross(angular, w), cross(linear, u)), torque);
            let right =
                SVector::<f64, 6>::from(std::array::from_fn(
                    |i| {
                        if i < 3 { linear_rate[i] } else { angular_rate[i - 3] }
                    },
                ));
            let expected = matrix.cholesky().expect("positive definite").solve(&right);

            let kernel = Left::<()>::kernel::<Bounded>(parameters);
            let (q, z) = state.of(&kernel).expect("regular everywhere");
            let found = list(&kernel.acceleration(Bounded::zero(), &q, &z, &()));
            // Backward stable: the error of a Cholesky solution is below 3 n² u cond(M) |x| (Higham, theorem 10.4), and
            // the right-hand side carries some twenty roundings of terms of its size.
            let eigenvalues = matrix.symmetric_eigenvalues();
            let condition = eigenvalues.max() / eigenvalues.min();
            let terms = (matrix.norm() * nu.norm_squared() + force.iter().chain(&torque).map(|f| f.abs()).sum::<f64>())
                / eigenvalues.max();
            let slack = f64::EPSILON * condition * (3.0 * 36.0 * expected.norm() + 40.0 * terms);
            let expected: Vec<Bounded> = expected.iter().map(|&x| Bounded::measured(x, slack)).collect();
            equal("ν̇", &found, &expected)?;
            tally.count(&found, largest(&found).max(nu.norm_squared()));
            Ok(())
        });
    }
}

/// Newton's and Euler's equations, v̇_G = F/m and I_G ω̇ = I_G ω × ω + M_G, mapped to O: b̈ = v̇_G − d²(Rc)/dt².
mod newton_euler {
    use super::*;

    macro_rules! body {
        ($($head:tt)+) => {
            scene!($($head)+, {
                mass mass: T, center_of_mass center: Vector3<T>, inertia inertia: Matrix3<T>,
                gravity field: Vector3<T>, displaced_mass displaced: T, center_of_buoyancy buoyancy: Vector3<T>
            });
        };
    }
    body!(Hybrid HybridKernel, free, [hybrid]);

    #[test]
    fn equations_typed_by_hand_agree() {
        explore(Motion::Free, SHARE, |parameters, state, tally| {
            let bounded = |v: [f64; 3]| v.map(Bounded::from_f64);
            let pose = state.pose();
            let r = rotation_matrix(&crate::common::body::Parts::parts(&pose.rotation));
            let (c, m) = (bounded(parameters.c), Bounded::from_f64(parameters.m));
            let w = bounded([state.twist[3], state.twist[4], state.twist[5]]);
            let kernel = Hybrid::<()>::kernel::<Bounded>(parameters);
            let (q, z) = state.of(&kernel).expect("regular everywhere");
            let z_rate = list(&kernel.acceleration(Bounded::zero(), &q, &z, &()));
            let w_rate = [z_rate[3], z_rate[4], z_rate[5]];

            let (force, torque) = wrench(parameters, &r);
            // b̈ + R (ω̇ × c + ω × (ω × c)) = R F/m.
            let lever = apply(&r, add(cross(w_rate, c), cross(w, cross(w, c))));
            let found = add([z_rate[0], z_rate[1], z_rate[2]], lever);
            let expected = apply(&r, force).map(|f| f / m);
            equal("acceleration of G", &found, &expected)?;

            // I_G = I_O − m(|c|² 1 − c cᵀ), M_G = M_O − c × F.
            let square = c[0] * c[0] + c[1] * c[1] + c[2] * c[2];
            let central: [[Bounded; 3]; 3] = std::array::from_fn(|i| {
                std::array::from_fn(|j| {
                    let steiner = if i == j { square - c[i] * c[j] } else { -(c[i] * c[j]) };
                    Bounded::from_f64(parameters.full[i][j]) - m * steiner
                })
            });
            let spin = add(apply(&central, w_rate), cross(w, apply(&central, w)));
            let about_center = add(torque, cross(c, force).map(|x| -x));
            equal("rate of the spin about G", &spin, &about_center)?;
            tally.count(&found, largest(&z_rate).max(largest(&w).powi(2)));
            Ok(())
        });
    }
}

/// A scalar gravity pulls along −k₃, and along −k₂ where the motion is in the plane k₁k₂: a body at rest falls that
/// way, in every chart, wherever its centre of mass is and however it is turned.
mod falling {
    use super::*;

    mod space {
        heavy!(Left LeftKernel, free, [left_invariant]);
        heavy!(Right RightKernel, free, [right_invariant]);
        heavy!(Hybrid HybridKernel, free, [hybrid]);
        heavy!(Zxy ZxyKernel, free, [jet(euler_zxy)]);
    }
    mod plane {
        planar_charts!(heavy);
    }

    fn check<S: Scene>(parameters: &Parameters, state: &State, up: usize) -> Result<(), TestCaseError> {
        fn fall<K: Body<Bounded>>(kernel: &K, state: &State, g: f64, up: usize) -> Result<(), TestCaseError> {
            let mut state = state.clone();
            state.twist = [0.0; 6];
            let Ok((q, rest)) = state.of(kernel) else { return Ok(()) };
            let rate = kernel.acceleration(Bounded::zero(), &q, &rest, &());
            // At rest the twist changes by what ż is the speeds of.
            let twist = list(&kernel.body_twist(Bounded::zero(), &q, &rate));
            let r = rotation_matrix(&crate::common::body::Parts::parts(&state.pose().rotation));
            let mut expected = [Bounded::zero(); 3];
            expected[up] = Bounded::from_f64(-g);
            equal("fall", &apply(&r, [twist[0], twist[1], twist[2]]), &expected)?;
            zero("spin", &twist[3..])
        }
        fall(&S::kernel::<Bounded>(parameters), state, parameters.g, up)
    }

    #[test]
    fn is_downwards() {
        let exact = [Bounded::zero()];
        explore(Motion::Free, 1.0, |p, state, tally| {
            tally.count(&exact, 1.0);
            check::<space::Left<()>>(p, state, 2)?;
            check::<space::Right<()>>(p, state, 2)?;
            check::<space::Hybrid<()>>(p, state, 2)?;
            check::<space::Zxy<()>>(p, state, 2)
        });
        explore(Motion::Planar, 1.0, |p, state, tally| {
            tally.count(&exact, 1.0);
            check::<plane::Left<()>>(p, state, 1)?;
            check::<plane::Right<()>>(p, state, 1)?;
            check::<plane::Hybrid<()>>(p, state, 1)?;
            check::<plane::Jet<()>>(p, state, 1)
        });
    }
}
