//! Four-bar linkages in a row, which pass positions where their constraints depend on one another.

use gauss_batch::{Batch, RunOutcome, States};
use gauss_runtime::integrate::{Control, Fixed};
use gauss_runtime::prelude::*;

/// Four-bar linkages in a row (IFToMM benchmark A02): every rod has a length of 1 m and a mass of 1 kg, and when all
/// lie on the line through the bearings the constraints depend on one another. In brackets each post with its place and
/// its angle, the beam from its top, and the angle of the next post.
macro_rules! row {
    ($(#[$note:meta])* $name:ident, $last:ident $place:literal $angle:ident $(, $clause:ident)?:
     $(($post:ident $x:literal $a:ident $beam:ident $b:ident $next:ident))+) => {
        $(#[$note])*
        #[derive(GaussDynamics)]
        #[gauss(
            coordinates($($a,)+ $angle, $($b),+),
            $(body($post, position = [$x, 0, 0], rotation = rotation_z($a), mass = 1, center_of_mass = [0.5, 0, 0],
                   inertia_about_center_of_mass = [0, 1 / 12, 1 / 12]),)+
            body($last, position = [$place, 0, 0], rotation = rotation_z($angle), mass = 1,
                 center_of_mass = [0.5, 0, 0], inertia_about_center_of_mass = [0, 1 / 12, 1 / 12]),
            $(body($beam, position = [$x + cos($a), sin($a), 0], rotation = rotation_z($b), mass = 1,
                   center_of_mass = [0.5, 0, 0], inertia_about_center_of_mass = [0, 1 / 12, 1 / 12]),)+
            $(constraint(position = [cos($a) + cos($b) - 1 - cos($next), sin($a) + sin($b) - sin($next), 0]),)+
            $($clause)?
        )]
        struct $name<T> {
            #[gauss(gravity)]
            g: Vector3<T>,
        }
    };
}

row!(One, p1 1 a1: (p0 0 a0 c0 b0 a1));
row!(OneRedundant, p1 1 a1, redundant: (p0 0 a0 c0 b0 a1));
row!(Two, p2 2 a2, taylor: (p0 0 a0 c0 b0 a1) (p1 1 a1 c1 b1 a2));
row!(
    Five, p5 5 a5: (p0 0 a0 c0 b0 a1) (p1 1 a1 c1 b1 a2) (p2 2 a2 c2 b2 a3) (p3 3 a3 c3 b3 a4) (p4 4 a4 c4 b4 a5)
);
row!(
    Ten, p10 10 a10:
    (p0 0 a0 c0 b0 a1) (p1 1 a1 c1 b1 a2) (p2 2 a2 c2 b2 a3) (p3 3 a3 c3 b3 a4) (p4 4 a4 c4 b4 a5)
    (p5 5 a5 c5 b5 a6) (p6 6 a6 c6 b6 a7) (p7 7 a7 c7 b7 a8) (p8 8 a8 c8 b8 a9) (p9 9 a9 c9 b9 a10)
);

/// Weight of each rod, over its mass.
const G: f64 = 9.81;

/// A kernel of a row.
macro_rules! kernel {
    ($name:ident<$scalar:ty>) => {
        $name { g: Vector3::new(0.0, -G, 0.0).map(<$scalar>::from_f64) }.kernel().unwrap()
    };
}

/// On the branch by which it comes a row of n four-bars is a pendulum upside down: all posts are parallel, and beams
/// keep their direction, so that `((n + 1)/3 + n) θ'' = g ((n + 1)/2 + n) sin θ` with rods of unit mass and length.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(angle),
    particle(mass = 1, position = [length * cos(angle), length * sin(angle), 0])
)]
struct Swing {
    length: f64,
    #[gauss(gravity)]
    g: Vector3<f64>,
}

/// The angle and the rate of posts after some time.
fn swung(four_bars: f64, end: f64) -> (f64, f64) {
    let length = ((four_bars + 1.0) / 3.0 + four_bars) / ((four_bars + 1.0) / 2.0 + four_bars);
    let swing = Swing { length, g: Vector3::new(0.0, -G, 0.0) }.kernel().unwrap();
    let (angle, rate) = (SVector::from([std::f64::consts::FRAC_PI_2]), SVector::from([-1.0]));
    let end = Simulation::new(&swing).adaptive(1e-13, 1e-13).run_to_end(angle, rate, 0.0..end).unwrap();
    (end.q[0], end.z[0])
}

/// A row of four-bars upright, with Ḃ₀ₓ = 1 m/s: as many angles of posts as there are, and one fewer of beams.
fn upright<const N: usize>() -> (SVector<f64, N>, SVector<f64, N>) {
    let of_posts = |post: f64| SVector::from_fn(|i, _| if 2 * i <= N { post } else { 0.0 });
    (of_posts(std::f64::consts::FRAC_PI_2), of_posts(-1.0))
}

/// The errors of a run at its end.
struct Passage {
    /// Its energy.
    energy: f64,
    /// The angles of posts and beams, and their rates, from those of the pendulum.
    motion: f64,
    steps: usize,
    ended: Option<IntegrationErrorKind>,
}

/// A run, of which 10 s hold nine passages of the singular position for one that gets through.
fn passages<const N: usize, K, C>(kernel: &K, control: C, end: f64) -> Passage
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
    let (angle, rate) = swung((N - 1) as f64 / 2.0, last.t);
    let (at, with) = upright::<N>();
    let off = |i: usize| (last.q[i] - angle * at[i] / at[0]).abs().max((last.z[i] + rate * with[i]).abs());
    Passage {
        energy: kernel.energy(last.t, &last.q, &last.z) - before,
        motion: (0..N).map(off).fold(0.0, f64::max),
        steps: trajectory.len(),
        ended: error.map(|error| error.kind),
    }
}

/// Whether a run has kept its energy within its tolerance and ended as it may; whether it got through, on the branch by
/// which it came.
///
/// In each step a component of the state is off by √N tolerances at most, the mean over N being one, and the projection
/// moves it by no more than ten times that. The energy changes with the components by what its gradient is: momenta,
/// whose sum is 0.7 m of each rod at 5 m/s at most, and weights with levers, 9.81 N at 1 m and less for each.
fn keeps<const N: usize>(name: &str, tolerance: f64, passage: Passage) -> bool {
    let (rods, Passage { energy, motion, steps, ended }) = (N as f64, passage);
    let off = 11.0 * (2.0 * rods).sqrt() * tolerance * steps as f64;
    let told = matches!(ended, None | Some(IntegrationErrorKind::ProjectionTooFar { .. }));
    assert!(told, "{name}, {tolerance:e}: {ended:?}");
    let bound = off * rods * (0.7 * 5.0 + 9.81);
    assert!(energy.abs() <= bound, "{name}, {tolerance:e}: {energy:e} J in {steps} steps, {ended:?}");
    // A rate that is off adds up over 10 s; next to the place where a run ends rates are not known as well.
    assert!(ended.is_some() || motion <= 11.0 * off, "{name}, {tolerance:e}: {motion:e} in {steps} steps");
    ended.is_none()
}

/// Where constraints become dependent the projection once took all of the energy away, and the run was `Ok`; then it
/// was refused.
#[test]
fn singular_positions_are_passed_on_the_branch_by_which_a_motion_comes() {
    let (one, two, five, ten) = (kernel!(One<f64>), kernel!(Two<f64>), kernel!(Five<f64>), kernel!(Ten<f64>));
    let redundant = kernel!(OneRedundant<f64>);
    for power in 6..=9 {
        for tolerance in [1.0, 2.0, 5.0].map(|factor| factor * 10_f64.powi(-power)) {
            let control = Adaptive::new(tolerance, tolerance);
            assert!(keeps::<3>("one", tolerance, passages(&one, control, 10.0)), "one, {tolerance:e}");
            assert!(keeps::<5>("two", tolerance, passages(&two, control, 10.0)), "two, {tolerance:e}");
            // Whose steps are those of a motion that may jump, as rows that come and go make it look.
            let through = keeps::<3>("one, redundant", tolerance, passages(&redundant, control, 10.0));
            assert!(through || power == 9, "one, redundant, {tolerance:e}");
            assert!(keeps::<11>("five", tolerance, passages(&five, control, 10.0)), "five, {tolerance:e}");
            assert!(keeps::<21>("ten", tolerance, passages(&ten, control, 10.0)), "ten, {tolerance:e}");
        }
    }
}

/// Between samples as well, at the singular positions themselves: without weight posts turn evenly.
#[test]
fn states_between_samples_are_on_the_branch() {
    let one = One { g: Vector3::zeros() }.kernel().unwrap();
    let start = SVector::from([1.0, 1.0, 0.0]);
    for power in 6..=8 {
        let tolerance = 10_f64.powi(-power);
        for w in [0.7, 1.0, 5.0] {
            let rates = SVector::from([w, w, 0.0]);
            let run = Simulation::new(&one).adaptive(tolerance, tolerance).run(start, rates, 0.0..10.0 / w).unwrap();
            let singular = (1..=3).flat_map(|n| [-1e-2, -1e-4, -1e-6, 0.0, 1e-6, 1e-3].map(|off| (n, off)));
            let near = singular.map(|(n, off)| (f64::from(n) * std::f64::consts::PI - 1.0 + off) / w);
            for t in near.chain((0..100).map(|n| 0.1 * f64::from(n) / w)) {
                let state = run.at(t).unwrap();
                let (turned, bound) = (1.0 + w * t, 11.0 * 6.0_f64.sqrt() * tolerance * run.len() as f64);
                let off = [state.q[0] - turned, state.q[1] - turned, state.q[2]];
                let slow = [state.z[0] - w, state.z[1] - w, state.z[2]];
                let worst = |of: [f64; 3]| of.iter().fold(0.0_f64, |worst, x| worst.max(x.abs()));
                assert!(worst(off) <= 11.0 * bound, "{tolerance:e}, {w}, {t}: {off:?}");
                assert!(worst(slow) <= w.max(1.0) * bound, "{tolerance:e}, {w}, {t}: {slow:?}");
            }
        }
    }
}

/// Roundings grow by (h/δ)ᵖ in a step of length h from a distance δ, of ε/δ² in speeds to begin with: where that is
/// more than the tolerance a run ends with the reason.
#[test]
fn energy_is_kept_where_digits_are_lost_or_the_run_ends_with_the_reason() {
    let (one, two, five) = (kernel!(One<f64>), kernel!(Two<f64>), kernel!(Five<f64>));
    for power in 6..=13 {
        let tolerance = 10_f64.powi(-power);
        keeps::<5>("two, Taylor", tolerance, passages(&two, Taylor::new(tolerance, tolerance), 10.0));
        if power > 9 {
            let control = Adaptive::new(tolerance, tolerance);
            keeps::<3>("one", tolerance, passages(&one, control, 10.0));
            keeps::<5>("two", tolerance, passages(&two, control, 10.0));
            keeps::<11>("five", tolerance, passages(&five, control, 4.0));
        }
    }
}

/// At a singular position lanes keep their energy or end with the reason, each by itself, and nearly always as they do
/// alone: a pack is projected until all of its lanes are on the constraints, so their last digits differ, and there
/// these count.
#[test]
fn lanes_pass_singular_positions_as_alone() {
    let (single, packs) = (kernel!(Two<f64>), kernel!(Two<Lanes<f64, 4>>));
    let start = |n: usize| {
        let (q, z) = upright::<5>();
        (q, z * (1.0 + 0.01 * n as f64))
    };
    let (mut alike, mut ended) = (0, 0);
    for tolerance in [1e-6, 1e-8, 1e-10] {
        let mut states = States::from_fn(6, start);
        let mut check = |name: &str,
                         ends: Vec<RunOutcome<TwoKernel<Lanes<f64, 4>>>>,
                         states: &States<_>,
                         alone: &dyn Fn(usize) -> bool| {
            for (n, end) in ends.into_iter().enumerate() {
                let ((q, z), (before, rate)) = (states.get(n), start(n));
                let change = single.energy(2.0, &q, &z) - single.energy(0.0, &before, &rate);
                let (steps, kind) = match end {
                    Ok(end) => (end.summary.steps as usize, None),
                    Err(error) => (1000, Some(error.kind)),
                };
                let passage = Passage { energy: change, motion: 0.0, steps, ended: kind };
                let through = keeps::<5>(&format!("{name}, {n}"), tolerance, passage);
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
    let two = kernel!(Two<f64>);
    let check = |name: &str, Passage { energy: change, ended, .. }: Passage| {
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
