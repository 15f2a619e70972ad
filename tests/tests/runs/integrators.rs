//! Methods of one step on derived kernels: orders against reference solutions, and what they keep over long runs.

use gauss_runtime::integrate::{Composed, Composition, Fixed, OneStep, Properties, Rkmk, Variational};
use gauss_runtime::prelude::*;
use gauss_tests::integrals::Moment;
use gauss_tests::scene::{Scene, quaternion_of};
use gauss_tests::top::{Top, TopKernel};

/// A body in fluid.
#[derive(GaussDynamics)]
#[gauss(motion = free)]
struct Kirchhoff {
    #[gauss(mass)]
    mass: f64,
    #[gauss(inertia)]
    inertia: Vector3<f64>,
    #[gauss(added_mass)]
    added: Matrix6<f64>,
}

/// The largest error of an entry of R at the end of a scene, by steps of one length.
fn error_on_the_heavy_top(scene: &Scene, method: impl OneStep<TopKernel<f64>>, steps: u32) -> f64 {
    let p = &scene.parameters;
    let top = Top { mass: p.mass, center: p.center, inertia: p.principal, g: p.gravity };
    let kernel = top.kernel().expect("a top");
    let end = Simulation::new(&kernel)
        .control(Fixed::by(method, scene.duration / f64::from(steps)))
        .run_to_end(quaternion_of(&scene.initial.rotation), scene.initial.omega, 0.0..scene.duration)
        .expect("runs");
    (end.q.to_rotation_matrix().into_inner() - scene.last.rotation).amax()
}

/// The order between two numbers of steps whose errors are above rounding.
fn order<M: OneStep<TopKernel<f64>> + Copy>(scene: &Scene, method: M, steps: [u32; 2]) -> (u32, bool, f64) {
    let Properties { order, symmetric, .. } = method.properties();
    let [coarse, fine] = steps.map(|n| error_on_the_heavy_top(scene, method, n));
    // A thousand steps leave some √1000 roundings, which this motion multiplies by ten.
    assert!(coarse > fine && fine > 1e-12, "{coarse:e} {fine:e}");
    (order, symmetric, (coarse / fine).ln() / (f64::from(steps[1]) / f64::from(steps[0])).ln())
}

/// Errors of symmetric methods have even powers of the step only, so that the slope is near the order at long steps.
/// Those of others may begin with a larger power that is seen first.
#[test]
fn orders_on_a_heavy_top_against_its_reference() {
    let scene = Scene::load("hlw_heavy_top");
    let midpoint = Collocation::midpoint();
    for (stated, symmetric, found) in [
        order(&scene, CommutatorFree4, [600, 2400]),
        order(&scene, midpoint, [300, 1200]),
        order(&scene, Collocation::order_4(), [300, 1200]),
        order(&scene, Collocation::order_6(), [150, 600]),
        order(&scene, Composed::new(&Composition::KAHAN_LI_6, midpoint), [150, 600]),
        order(&scene, Composed::new(&Composition::KAHAN_LI_8, midpoint), [75, 300]),
        order(&scene, Variational, [600, 2400]),
        order(&scene, Composed::new(&Composition::KAHAN_LI_6, Variational), [300, 1200]),
        order(&scene, Rkmk::new(&Tableau::DORMAND_PRINCE_8), [75, 300]),
        order(&scene, Rkmk::new(&Tableau::VERNER_9), [75, 150]),
    ] {
        let stated = f64::from(stated);
        assert!(found > stated - 0.2 && (!symmetric || found < stated + 0.2), "{found} instead of {stated}");
    }
}

/// The largest relative change of the integrals of Clebsch's body over a run in momentum form: E, p², p·π and his own.
fn change_of_clebsch(method: impl OneStep<KirchhoffKernel>, step: f64, steps: u32) -> [f64; 4] {
    let scene = Scene::load("kirchhoff_clebsch");
    let p = &scene.parameters;
    let kernel = Kirchhoff { mass: p.mass, inertia: p.principal, added: p.added }.kernel().expect("a body");
    let values = |sample: &Sample<KirchhoffKernel>| {
        let moment = Moment::of(&kernel, sample.t, &sample.q, &sample.z);
        let (clebsch, size) = moment.integral("Clebsch", p);
        let (p, pi) = (moment.linear, moment.angular);
        [
            (moment.kinetic, moment.kinetic),
            (p.norm_squared(), p.norm_squared()),
            (p.dot(&pi), p.norm() * pi.norm()),
            (clebsch[0], size),
        ]
    };
    let mut first = None;
    let mut worst = [0.0_f64; 4];
    Simulation::new(&kernel)
        .momentum_form()
        .control(Fixed::by(method, step))
        .observe(|sample| {
            let now = values(sample);
            let start = *first.get_or_insert(now);
            for i in 0..4 {
                worst[i] = worst[i].max((now[i].0 - start[i].0).abs() / start[i].1);
            }
        })
        .run_to_end(scene.initial.pose(), scene.initial.twist(), 0.0..step * f64::from(steps))
        .expect("runs");
    worst
}

/// All four are quadratic in the momenta. Each step rounds the six momenta a few times, by less than 4ε of an integral;
/// such errors are of both signs, and add up like the root of the number of steps.
#[test]
fn integrals_of_clebsch_are_kept_to_rounding() {
    let (step, steps) = (0.1, 20_000);
    let walk = 4.0 * f64::EPSILON * f64::from(steps).sqrt();
    for changes in
        [change_of_clebsch(Collocation::order_4(), step, steps), change_of_clebsch(Collocation::order_6(), step, steps)]
    {
        assert!(changes.iter().all(|&change| change < walk), "{changes:?}");
    }
    // A method that does not keep them loses them in proportion to time.
    let changes = change_of_clebsch(CommutatorFree4, step, steps);
    assert!(changes.iter().all(|&change| change > 1e6 * walk), "{changes:?}");
}

/// A body in fluid with all 6×6 coupled: momenta in space, and p² and p·π, which follow from them.
#[test]
fn a_variational_method_keeps_the_momenta_of_a_body_in_fluid() {
    let scene = Scene::load("kirchhoff_clebsch");
    let p = &scene.parameters;
    let kernel = Kirchhoff { mass: p.mass, inertia: p.principal, added: p.added }.kernel().expect("a body");
    let (pose, z) = (scene.initial.pose(), scene.initial.twist());
    let (first, energy) = (kernel.space_momentum(0.0, &pose, &z), kernel.energy(0.0, &pose, &z));
    let (step, steps) = (0.05, 10_000);
    let (mut momentum, mut halves) = (0.0_f64, [0.0_f64; 2]);
    Simulation::new(&kernel)
        .momentum_form()
        .control(Fixed::by(Variational, step))
        .observe(|sample| {
            let now = kernel.space_momentum(sample.t, &sample.q, &sample.z);
            // About Ω, from which the body goes away: rounding is of b × p.
            let lever = 1.0 + sample.q.translation.vector.norm();
            momentum = momentum.max((now - first).amax() / (lever * first.norm()));
            let worst = &mut halves[usize::from(sample.t > 0.5 * step * f64::from(steps))];
            *worst = worst.max((kernel.energy(sample.t, &sample.q, &sample.z) / energy - 1.0).abs());
        })
        .run_to_end(pose, z, 0.0..step * f64::from(steps))
        .expect("runs");
    // Each step rounds momenta and attitude by some 4ε, of both signs.
    assert!(momentum < 4.0 * f64::EPSILON * f64::from(steps).sqrt(), "{momentum:e}");
    assert!(halves[1] < 1.2 * halves[0] && halves[0] < 4.0 * step * step, "{halves:?}");
}
