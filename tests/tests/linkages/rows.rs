//! Four-bar linkages in a row, which pass positions where their constraints depend on one another.

use gauss_batch::{Batch, RunOutcome, States};
use gauss_runtime::integrate::{Control, Fixed};
use gauss_runtime::prelude::*;

/// Two four-bar linkages in a row (IFToMM benchmark A02, with N = 2): every rod has a length of 1 m and a mass of 1 kg,
/// and when all lie on the line through the bearings the constraints depend on one another.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(a0, a1, a2, b0, b1),
    body(first, rotation = rotation_z(a0)),
    body(second, position = [1, 0, 0], rotation = rotation_z(a1)),
    body(third, position = [2, 0, 0], rotation = rotation_z(a2)),
    body(left, position = [cos(a0), sin(a0), 0], rotation = rotation_z(b0)),
    body(right, position = [1 + cos(a1), sin(a1), 0], rotation = rotation_z(b1)),
    point(top, body = second, at = [1, 0, 0]),
    point(last, body = third, at = [1, 0, 0]),
    point(end_of_left, body = left, at = [1, 0, 0]),
    point(end_of_right, body = right, at = [1, 0, 0]),
    constraint(position = end_of_left - top),
    constraint(position = end_of_right - last),
    taylor
)]
struct Row<T> {
    #[gauss(body)]
    first: RigidBody<T>,
    #[gauss(body)]
    second: RigidBody<T>,
    #[gauss(body)]
    third: RigidBody<T>,
    #[gauss(body)]
    left: RigidBody<T>,
    #[gauss(body)]
    right: RigidBody<T>,
    #[gauss(gravity)]
    g: Vector3<T>,
}

/// The same with N = 5.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(a0, a1, a2, a3, a4, a5, b0, b1, b2, b3, b4),
    body(post0, position = [0, 0, 0], rotation = rotation_z(a0)),
    body(post1, position = [1, 0, 0], rotation = rotation_z(a1)),
    body(post2, position = [2, 0, 0], rotation = rotation_z(a2)),
    body(post3, position = [3, 0, 0], rotation = rotation_z(a3)),
    body(post4, position = [4, 0, 0], rotation = rotation_z(a4)),
    body(post5, position = [5, 0, 0], rotation = rotation_z(a5)),
    body(beam0, position = [cos(a0), sin(a0), 0], rotation = rotation_z(b0)),
    body(beam1, position = [1 + cos(a1), sin(a1), 0], rotation = rotation_z(b1)),
    body(beam2, position = [2 + cos(a2), sin(a2), 0], rotation = rotation_z(b2)),
    body(beam3, position = [3 + cos(a3), sin(a3), 0], rotation = rotation_z(b3)),
    body(beam4, position = [4 + cos(a4), sin(a4), 0], rotation = rotation_z(b4)),
    point(top1, body = post1, at = [1, 0, 0]),
    point(end1, body = beam0, at = [1, 0, 0]),
    constraint(position = end1 - top1),
    point(top2, body = post2, at = [1, 0, 0]),
    point(end2, body = beam1, at = [1, 0, 0]),
    constraint(position = end2 - top2),
    point(top3, body = post3, at = [1, 0, 0]),
    point(end3, body = beam2, at = [1, 0, 0]),
    constraint(position = end3 - top3),
    point(top4, body = post4, at = [1, 0, 0]),
    point(end4, body = beam3, at = [1, 0, 0]),
    constraint(position = end4 - top4),
    point(top5, body = post5, at = [1, 0, 0]),
    point(end5, body = beam4, at = [1, 0, 0]),
    constraint(position = end5 - top5)
)]
struct Five {
    #[gauss(body)]
    post0: RigidBody<f64>,
    #[gauss(body)]
    post1: RigidBody<f64>,
    #[gauss(body)]
    post2: RigidBody<f64>,
    #[gauss(body)]
    post3: RigidBody<f64>,
    #[gauss(body)]
    post4: RigidBody<f64>,
    #[gauss(body)]
    post5: RigidBody<f64>,
    #[gauss(body)]
    beam0: RigidBody<f64>,
    #[gauss(body)]
    beam1: RigidBody<f64>,
    #[gauss(body)]
    beam2: RigidBody<f64>,
    #[gauss(body)]
    beam3: RigidBody<f64>,
    #[gauss(body)]
    beam4: RigidBody<f64>,
    #[gauss(gravity)]
    g: Vector3<f64>,
}

/// The same with N = 10.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(a0, a1, a2, a3, a4, a5, a6, a7, a8, a9, a10, b0, b1, b2, b3, b4, b5, b6, b7, b8, b9),
    body(post0, position = [0, 0, 0], rotation = rotation_z(a0)),
    body(post1, position = [1, 0, 0], rotation = rotation_z(a1)),
    body(post2, position = [2, 0, 0], rotation = rotation_z(a2)),
    body(post3, position = [3, 0, 0], rotation = rotation_z(a3)),
    body(post4, position = [4, 0, 0], rotation = rotation_z(a4)),
    body(post5, position = [5, 0, 0], rotation = rotation_z(a5)),
    body(post6, position = [6, 0, 0], rotation = rotation_z(a6)),
    body(post7, position = [7, 0, 0], rotation = rotation_z(a7)),
    body(post8, position = [8, 0, 0], rotation = rotation_z(a8)),
    body(post9, position = [9, 0, 0], rotation = rotation_z(a9)),
    body(post10, position = [10, 0, 0], rotation = rotation_z(a10)),
    body(beam0, position = [cos(a0), sin(a0), 0], rotation = rotation_z(b0)),
    body(beam1, position = [1 + cos(a1), sin(a1), 0], rotation = rotation_z(b1)),
    body(beam2, position = [2 + cos(a2), sin(a2), 0], rotation = rotation_z(b2)),
    body(beam3, position = [3 + cos(a3), sin(a3), 0], rotation = rotation_z(b3)),
    body(beam4, position = [4 + cos(a4), sin(a4), 0], rotation = rotation_z(b4)),
    body(beam5, position = [5 + cos(a5), sin(a5), 0], rotation = rotation_z(b5)),
    body(beam6, position = [6 + cos(a6), sin(a6), 0], rotation = rotation_z(b6)),
    body(beam7, position = [7 + cos(a7), sin(a7), 0], rotation = rotation_z(b7)),
    body(beam8, position = [8 + cos(a8), sin(a8), 0], rotation = rotation_z(b8)),
    body(beam9, position = [9 + cos(a9), sin(a9), 0], rotation = rotation_z(b9)),
    point(top1, body = post1, at = [1, 0, 0]),
    point(end1, body = beam0, at = [1, 0, 0]),
    constraint(position = end1 - top1),
    point(top2, body = post2, at = [1, 0, 0]),
    point(end2, body = beam1, at = [1, 0, 0]),
    constraint(position = end2 - top2),
    point(top3, body = post3, at = [1, 0, 0]),
    point(end3, body = beam2, at = [1, 0, 0]),
    constraint(position = end3 - top3),
    point(top4, body = post4, at = [1, 0, 0]),
    point(end4, body = beam3, at = [1, 0, 0]),
    constraint(position = end4 - top4),
    point(top5, body = post5, at = [1, 0, 0]),
    point(end5, body = beam4, at = [1, 0, 0]),
    constraint(position = end5 - top5),
    point(top6, body = post6, at = [1, 0, 0]),
    point(end6, body = beam5, at = [1, 0, 0]),
    constraint(position = end6 - top6),
    point(top7, body = post7, at = [1, 0, 0]),
    point(end7, body = beam6, at = [1, 0, 0]),
    constraint(position = end7 - top7),
    point(top8, body = post8, at = [1, 0, 0]),
    point(end8, body = beam7, at = [1, 0, 0]),
    constraint(position = end8 - top8),
    point(top9, body = post9, at = [1, 0, 0]),
    point(end9, body = beam8, at = [1, 0, 0]),
    constraint(position = end9 - top9),
    point(top10, body = post10, at = [1, 0, 0]),
    point(end10, body = beam9, at = [1, 0, 0]),
    constraint(position = end10 - top10)
)]
struct Ten {
    #[gauss(body)]
    post0: RigidBody<f64>,
    #[gauss(body)]
    post1: RigidBody<f64>,
    #[gauss(body)]
    post2: RigidBody<f64>,
    #[gauss(body)]
    post3: RigidBody<f64>,
    #[gauss(body)]
    post4: RigidBody<f64>,
    #[gauss(body)]
    post5: RigidBody<f64>,
    #[gauss(body)]
    post6: RigidBody<f64>,
    #[gauss(body)]
    post7: RigidBody<f64>,
    #[gauss(body)]
    post8: RigidBody<f64>,
    #[gauss(body)]
    post9: RigidBody<f64>,
    #[gauss(body)]
    post10: RigidBody<f64>,
    #[gauss(body)]
    beam0: RigidBody<f64>,
    #[gauss(body)]
    beam1: RigidBody<f64>,
    #[gauss(body)]
    beam2: RigidBody<f64>,
    #[gauss(body)]
    beam3: RigidBody<f64>,
    #[gauss(body)]
    beam4: RigidBody<f64>,
    #[gauss(body)]
    beam5: RigidBody<f64>,
    #[gauss(body)]
    beam6: RigidBody<f64>,
    #[gauss(body)]
    beam7: RigidBody<f64>,
    #[gauss(body)]
    beam8: RigidBody<f64>,
    #[gauss(body)]
    beam9: RigidBody<f64>,
    #[gauss(gravity)]
    g: Vector3<f64>,
}

fn rod<T: Real>() -> RigidBody<T> {
    let number = T::from_f64;
    RigidBody {
        mass: number(1.0),
        center_of_mass: Vector3::new(0.5, 0.0, 0.0).map(number),
        inertia: Matrix3::from_diagonal(&Vector3::new(1e-6, 1.0 / 3.0, 1.0 / 3.0)).map(number),
    }
}

fn row<T: Real>() -> RowKernel<T> {
    let g = Vector3::new(0.0, -9.81, 0.0).map(T::from_f64);
    Row { first: rod(), second: rod(), third: rod(), left: rod(), right: rod(), g }.kernel().unwrap()
}

/// A row of rods, by the names of the fields.
macro_rules! rods {
    ($name:ident: $($field:ident)+) => {
        $name { $($field: rod(),)+ g: Vector3::new(0.0, -9.81, 0.0) }.kernel().unwrap()
    };
}

fn five() -> FiveKernel {
    rods!(Five: post0 post1 post2 post3 post4 post5 beam0 beam1 beam2 beam3 beam4)
}

fn ten() -> TenKernel {
    rods!(Ten: post0 post1 post2 post3 post4 post5 post6 post7 post8 post9 post10
               beam0 beam1 beam2 beam3 beam4 beam5 beam6 beam7 beam8 beam9)
}

/// A row of four-bars upright, with Ḃ₀ₓ = 1 m/s: as many angles of posts as there are, and one fewer of beams.
fn upright<const N: usize>() -> (SVector<f64, N>, SVector<f64, N>) {
    let of_posts = |post: f64| SVector::from_fn(|i, _| if 2 * i <= N { post } else { 0.0 });
    (of_posts(std::f64::consts::FRAC_PI_2), of_posts(-1.0))
}

/// What a run kept of its energy, and how it ended; 10 s hold nine passages of the singular position for one that gets
/// through.
fn passages<const N: usize, K, C>(kernel: &K, control: C, end: f64) -> (f64, usize, Option<IntegrationErrorKind>)
where
    K: GaussSystem<Scalar = f64, Configuration = SVector<f64, N>, Speeds = SVector<f64, N>, Input = ()>,
    C: Control<K>,
{
    let (q, z) = upright::<N>();
    let (trajectory, error) = Simulation::new(kernel).control(control).max_steps(20_000).attempt(q, z, 0.0..end);
    let last = trajectory.last();
    let before = kernel.energy(0.0, &q, &z);
    // T = n/6 J of n posts and (n − 1)/2 J of beams, U = n/2 and n − 1 times the weight of a rod at 1 m.
    let (posts, beams) = ((N + 1) as f64 / 2.0, (N - 1) as f64 / 2.0);
    let expected = posts / 6.0 + 0.5 * beams + 9.81 * (0.5 * posts + beams);
    assert!((before - expected).abs() < 1e-9, "{before}");
    (kernel.energy(last.t, &last.q, &last.z) - before, trajectory.len(), error.map(|error| error.kind))
}

/// Whether a run has kept its energy within its tolerance and ended as it may; whether it got through.
///
/// In each step a component of the state is off by √N tolerances at most, the mean over N being one, and the projection
/// moves it by no more than ten times that. The energy changes with the components by what its gradient is: momenta,
/// whose sum is 0.7 m of each rod at 5 m/s at most, and weights with levers, 9.81 N at 1 m and less for each.
fn keeps<const N: usize>(
    name: &str,
    tolerance: f64,
    (change, steps, ended): (f64, usize, Option<IntegrationErrorKind>),
) -> bool {
    let rods = N as f64;
    let bound = 11.0 * (2.0 * rods).sqrt() * tolerance * steps as f64 * rods * (0.7 * 5.0 + 9.81);
    assert!(change.abs() <= bound, "{name}, {tolerance:e}: {change:e} J in {steps} steps, {ended:?}");
    let told = matches!(ended, None | Some(IntegrationErrorKind::ProjectionTooFar { .. }));
    assert!(told, "{name}, {tolerance:e}: {ended:?}");
    ended.is_none()
}

/// Where constraints become dependent the projection once took all of the energy away, and the run was `Ok`.
#[test]
fn energy_is_kept_at_singular_positions_or_the_run_ends_with_the_reason() {
    let (two, five, ten) = (row::<f64>(), five(), ten());
    let mut through = 0;
    for power in 6..=12 {
        for tolerance in [1.0, 2.0, 5.0].map(|factor| factor * 10_f64.powi(-power)) {
            let run = passages(&two, Adaptive::new(tolerance, tolerance), 10.0);
            through += usize::from(keeps::<5>("two", tolerance, run));
        }
        let tolerance = 10_f64.powi(-power);
        keeps::<5>("two, Taylor", tolerance, passages(&two, Taylor::new(tolerance, tolerance), 10.0));
        keeps::<11>("five", tolerance, passages(&five, Adaptive::new(tolerance, tolerance), 4.0));
        keeps::<21>("ten", tolerance, passages(&ten, Adaptive::new(tolerance, tolerance), 1.0));
    }
    assert!(through >= 10, "{through} of 21 runs pass");
}

/// At a singular position lanes keep their energy or end with the reason, each by itself, and nearly always as they do
/// alone: a pack is projected until all of its lanes are on the constraints, so their last digits differ, and there
/// these count.
#[test]
fn lanes_pass_singular_positions_as_alone() {
    let (single, packs) = (row::<f64>(), row::<Lanes<f64, 4>>());
    let start = |n: usize| {
        let (q, z) = upright::<5>();
        (q, z * (1.0 + 0.01 * n as f64))
    };
    let (mut alike, mut ended) = (0, 0);
    for tolerance in [1e-6, 1e-8, 1e-10] {
        let mut states = States::from_fn(6, start);
        let mut check = |name: &str,
                         ends: Vec<RunOutcome<RowKernel<Lanes<f64, 4>>>>,
                         states: &States<_>,
                         alone: &dyn Fn(usize) -> bool| {
            for (n, end) in ends.into_iter().enumerate() {
                let ((q, z), (before, rate)) = (states.get(n), start(n));
                let change = single.energy(2.0, &q, &z) - single.energy(0.0, &before, &rate);
                let (steps, kind) = match end {
                    Ok(end) => (end.summary.steps as usize, None),
                    Err(error) => (1000, Some(error.kind)),
                };
                let through = keeps::<5>(&format!("{name}, {n}"), tolerance, (change, steps, kind));
                ended += usize::from(!through);
                alike += usize::from(through == alone(n));
            }
        };
        let run = Simulation::new(&single);
        let ends = Batch::new(&packs).adaptive(tolerance, tolerance).run(0.0..2.0, &mut states);
        let alone = |n: usize| run.adaptive(tolerance, tolerance).run_to_end(start(n).0, start(n).1, 0.0..2.0).is_ok();
        check("adaptive", ends, &states, &alone);
        let mut states = States::from_fn(6, start);
        let ends = Batch::new(&packs).taylor(tolerance, tolerance).run(0.0..2.0, &mut states);
        let alone = |n: usize| run.taylor(tolerance, tolerance).run_to_end(start(n).0, start(n).1, 0.0..2.0).is_ok();
        check("Taylor", ends, &states, &alone);
    }
    println!("{alike} of 36 end as alone, {ended} before the end");
    assert!(alike >= 24, "{alike} of 36");
}

/// Steps of one length know no rejection: they pass, or end. A hundredth of the energy is what coarse steps of order 4
/// lose.
#[test]
fn steps_that_cannot_be_shortened_end_at_singular_positions() {
    let two = row::<f64>();
    let check = |name: &str, (change, _, ended): (f64, usize, Option<IntegrationErrorKind>)| {
        assert!(change.abs() <= 0.358, "{name}: {change:e} J, {ended:?}");
        let told = matches!(
            ended,
            None | Some(IntegrationErrorKind::ProjectionTooFar { .. } | IntegrationErrorKind::NotConverged { .. })
        );
        assert!(told, "{name}: {ended:?}");
    };
    for step in [0.02, 0.013, 0.01, 0.007, 0.004] {
        check("order 8", passages(&two, Fixed::new(step), 4.0));
        check("order 4", passages(&two, Fixed::with(&Tableau::RK4, step), 4.0));
        check("collocation", passages(&two, Fixed::by(Collocation::order_4(), step), 4.0));
    }
}
