//! Two kernels of one system.

use gauss_runtime::prelude::*;

use super::Bounded;
use super::agreement::equal;
use super::body::{Parts, list, speeds};
use super::groups::{Random, random_configuration};

/// Two kernels of one configuration agree in every method.
pub fn same<C, A, B>(origin: &C, a: &A, b: &B)
where
    C: Configuration<Scalar = f64> + Parts<f64>,
    A: GaussSystem<Scalar = Bounded, Configuration: Parts<Bounded>, Input = ()>,
    B: GaussSystem<
            Scalar = Bounded,
            Configuration = A::Configuration,
            Speeds = A::Speeds,
            MassMatrix = A::MassMatrix,
            Input = (),
        >,
{
    let mut random = Random(3);
    for _ in 0..8 {
        let q: A::Configuration = random_configuration(origin, &mut random);
        let mut draw = |n: usize| -> Vec<Bounded> { (0..n).map(|_| Bounded::from_f64(random.number())).collect() };
        let (z, rates, p, t): (A::Speeds, A::Speeds, A::Speeds, _) =
            (speeds(&draw(A::DOF)), speeds(&draw(A::DOF)), speeds(&draw(A::DOF)), draw(1)[0]);
        let pairs = [
            ("acceleration", a.acceleration(t, &q, &z, &()), b.acceleration(t, &q, &z, &())),
            ("momentum", a.momentum(t, &q, &z), b.momentum(t, &q, &z)),
            ("velocity", a.velocity(t, &q, &p), b.velocity(t, &q, &p)),
            ("momentum rate", a.momentum_rate(t, &q, &p, &()), b.momentum_rate(t, &q, &p, &())),
            ("residual", a.gauss_residual(t, &q, &z, &rates, &()), b.gauss_residual(t, &q, &z, &rates, &())),
        ];
        for (what, ours, theirs) in pairs {
            equal(what, &list(&ours), &list(&theirs)).unwrap();
            let size = list(&ours).iter().fold(1.0_f64, |m, x| m.max(x.value.abs()));
            assert!(list(&ours).iter().all(|x| x.bound < 1e-8 * size), "{what}: {ours:?}");
        }
        equal("energy", &[a.kinetic_energy(t, &q, &z)], &[b.kinetic_energy(t, &q, &z)]).unwrap();
        let (ours, theirs) = (a.mass_matrix(t, &q), b.mass_matrix(t, &q));
        for (i, k) in (0..A::DOF).flat_map(|i| (0..A::DOF).map(move |k| (i, k))) {
            equal("mass matrix", &[ours[(i, k)]], &[theirs[(i, k)]]).unwrap();
        }
    }
}
