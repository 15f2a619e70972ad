//! Free bodies with awkward numbers: far away, far from their centre of mass, thin, light.

use std::error::Error;

use gauss_runtime::prelude::*;

use super::methods::{adaptive_8, end, order_8, splitting, tight};
use super::scenes::{
    Central, CentralHybrid, Drifting, DriftingFromSpace, DriftingHybrid, Falling, Immersed, Projectile, Scene, State,
};
use super::truth::{Body, MassData};
use super::{Effort, Measure, naive};

type Measures = Result<Vec<Measure>, Box<dyn Error>>;

/// Figures of a run that may have stopped.
fn judged(found: Result<(State, u64), Box<dyn Error>>, judge: impl Fn(&State) -> f64) -> (f64, String) {
    match found {
        Ok((state, steps)) => (judge(&state), format!("{steps} steps")),
        Err(error) => (f64::INFINITY, error.to_string().split("; ").next().unwrap_or_default().into()),
    }
}

pub fn far_away(effort: Effort) -> Measures {
    let scene = Scene::load("free_far_from_Omega")?;
    let (start, last, duration) = (scene.initial, scene.last, scene.duration);
    let Scene { mass, center, inertia, .. } = scene;
    let far = last.b.norm();
    // The place itself is known to ε|b|; the rest is asked to be as good.
    let error = |state: &State| {
        let rest = State { b: last.b, ..*state };
        (state.b - last.b).amax().max(rest.distance(&last))
    };
    let h = if effort == Effort::Quick { 0.02 } else { 0.002 };
    let typed = error(&naive::run_about_origin(&MassData::from(&scene), &start, duration, h));
    let words = format!("6×6 solve about Ω, RK4, h = {h}");

    let left = Drifting { mass, center, inertia }.kernel()?;
    let right = DriftingFromSpace { mass, center, inertia }.kernel()?;
    let hybrid = DriftingHybrid { mass, center, inertia }.kernel()?;
    let what = "10 s: worst of m, rad, m/s, rad/s";
    let target = 10.0 * f64::EPSILON * far;
    let near = |state: &State| State { b: Vector3::zeros(), ..*state };
    let back = |(state, steps): (State, u64)| (State { b: state.b + start.b, ..state }, steps);
    // What is rounded at |b| looks like truncation to a tight control: it asks for a looser one.
    let loose = || adaptive_8(1e-12);
    let momentum = end(&right, MomentumForm, loose(), &start, duration);
    let steps = |run: &Result<(State, u64), Box<dyn Error>>| run.as_ref().map_or(f64::INFINITY, |run| run.1 as f64);
    let here = end(&right, MomentumForm, loose(), &near(&start), duration);
    let ratio = steps(&momentum) / steps(&here);
    let mut measures: Vec<Measure> = [
        ("body axes, O", end(&left, VelocityForm, tight(), &start, duration)),
        ("body axes, O, momenta", end(&left, MomentumForm, tight(), &start, duration)),
        ("hybrid", end(&hybrid, VelocityForm, tight(), &start, duration)),
        ("observer's axes, Ω", end(&right, VelocityForm, tight(), &start, duration)),
        ("observer's axes, Ω, momenta, 1e-12", momentum),
        ("observer's axes, moved Ω", end(&right, VelocityForm, tight(), &near(&start), duration).map(back)),
    ]
    .into_iter()
    .map(|(method, found)| {
        let (reached, note) = judged(found, error);
        Measure::new(what, method, reached, target).because("10 ε |b|").naive(&*words, typed).note(note)
    })
    .collect();
    let ours = end(&left, VelocityForm, tight(), &start, duration);
    let at_home = end(&left, VelocityForm, tight(), &near(&start), duration);
    let grown = (steps(&ours) / steps(&at_home) - 1.0).abs();
    measures.push(
        Measure::new("more steps than at Ω, share", "body axes, O", grown, 0.1)
            .because("|b| should not matter")
            .naive("momenta about Ω", (ratio - 1.0).abs()),
    );
    Ok(measures)
}

/// The error of a body's motion, and what it is off when the inertia, or the added mass, is rounded otherwise.
struct Judge {
    last: State,
    floor: f64,
}

impl Judge {
    fn new(data: &MassData, start: &State, duration: f64) -> Self {
        let (pose, twist) = (start.pose(), start.twist());
        let last = Body::free(data).after(duration, &pose, &twist);
        // One rounding, of one sign on the diagonal and of the other beside it.
        let sign = |i: usize, j: usize| if i == j { 1.0 } else { -1.0 };
        let unit = 0.5 * f64::EPSILON;
        let inertia = Matrix3::from_fn(|i, j| data.inertia[(i, j)] * (1.0 + unit * sign(i, j)));
        let added = Matrix6::from_fn(|i, j| data.added[(i, j)] * (1.0 + unit * sign(i, j)));
        // A double cannot hold the half of its last place: whole places, and half of the difference.
        let off = MassData { inertia: next(&inertia, &data.inertia), added: next(&added, &data.added), ..*data };
        let floor = 0.5 * Body::free(&off).after(duration, &pose, &twist).distance(&last);
        Self { last, floor }
    }
}

/// Entries moved by one place where `towards` asks for less than that.
fn next<const N: usize>(towards: &SMatrix<f64, N, N>, from: &SMatrix<f64, N, N>) -> SMatrix<f64, N, N> {
    SMatrix::from_fn(|i, j| {
        let (a, b) = (from[(i, j)], towards[(i, j)]);
        if a == 0.0 { 0.0 } else { a + (b - a).signum() * a.abs() * f64::EPSILON }
    })
}

pub fn far_center(effort: Effort) -> Measures {
    // The same body to the last bit about both points: I_O is a sum of dyadic fractions.
    let central = Matrix3::from_diagonal(&Vector3::new(0.75, 1.125, 1.375));
    let (mass, center) = (1.0, Vector3::new(40.0, -24.0, 18.0));
    let inertia = central + (Matrix3::identity() * center.norm_squared() - center * center.transpose()) * mass;
    let data = MassData { mass, center, inertia, added: Matrix6::zeros(), gravity: 0.0 };
    let duration = if effort == Effort::Quick { 1.0 } else { 5.0 };
    let omega = Vector3::new(0.7, -1.1, 0.6);
    // The centre of mass moves slowly.
    let u = Vector3::new(0.3, 0.2, -0.1) - omega.cross(&center);
    let start = State { rotation: Matrix3::identity(), b: Vector3::zeros(), u, omega };
    let Judge { last, floor } = Judge::new(&data, &start, duration);

    let h = if effort == Effort::Quick { 2e-3 } else { 5e-4 };
    let typed = naive::run_body(&data, &start, duration, h).distance(&last);
    let left = Drifting { mass, center, inertia }.kernel()?;
    let hybrid = DriftingHybrid { mass, center, inertia }.kernel()?;
    let about_g = Central { mass, center, inertia: central }.kernel()?;
    let hybrid_about_g = CentralHybrid { mass, center, inertia: central }.kernel()?;
    let runs = [
        ("I about G, body axes, order 8", end(&about_g, VelocityForm, tight(), &start, duration)),
        ("the same, momenta", end(&about_g, MomentumForm, tight(), &start, duration)),
        ("I about G, hybrid, order 8", end(&hybrid_about_g, VelocityForm, tight(), &start, duration)),
        ("the same, momenta", end(&hybrid_about_g, MomentumForm, tight(), &start, duration)),
        ("body axes, order 8", end(&left, VelocityForm, tight(), &start, duration)),
        ("the same, momenta", end(&left, MomentumForm, tight(), &start, duration)),
        ("hybrid, order 8", end(&hybrid, VelocityForm, tight(), &start, duration)),
        ("hybrid, momenta", end(&hybrid, MomentumForm, tight(), &start, duration)),
    ];
    let steps = |k: usize| runs[k].1.as_ref().map_or(f64::INFINITY, |(_, steps)| *steps as f64);
    let more = [(4, "body axes"), (6, "hybrid")].map(|(k, method)| {
        Measure::new("steps by momenta, for one by velocities", method, steps(k + 1) / steps(k), 2.0)
            .because("the form should not matter")
    });
    let errors = runs.into_iter().map(|(method, found)| {
        let (reached, note) = judged(found, |state| state.distance(&last));
        Measure::new(format!("{duration} s: worst relative error"), method, reached, 1e-12)
            .naive(format!("6×6 solve about O, RK4, h = {h:e}"), typed)
            .note(format!("{note}; one rounding of I_O: {floor:.0e}"))
    });
    Ok(errors.chain(more).collect())
}

pub fn needle(effort: Effort) -> Measures {
    let scene = Scene::load("needle_free")?;
    let Scene { mass, center, inertia, gravity, .. } = scene;
    let (start, last, duration) = (scene.initial, scene.last, scene.duration);
    let h = if effort == Effort::Quick { 1e-3 } else { 2e-4 };
    let typed = naive::run_body(&MassData::from(&scene), &start, duration, h).distance(&last);
    let principal = Falling { mass, inertia: inertia.diagonal(), gravity }.kernel()?;
    let full = Projectile { mass, center, inertia, gravity }.kernel()?;
    Ok([
        ("principal axes, velocities", end(&principal, VelocityForm, tight(), &start, duration)),
        ("principal axes, momenta", end(&principal, MomentumForm, tight(), &start, duration)),
        ("full inertia, velocities", end(&full, VelocityForm, tight(), &start, duration)),
        (
            "splitting, exact flow, h = 0.1",
            end(&principal, MomentumForm, splitting!(&principal, 0.1), &start, duration),
        ),
        ("full inertia, momenta", end(&full, MomentumForm, tight(), &start, duration)),
    ]
    .into_iter()
    .map(|(method, found)| {
        let (reached, note) = judged(found, |state| state.distance(&last));
        Measure::new("2 s at 50 rad/s: worst error", method, reached, 1e-12)
            .naive(format!("6×6 solve about O, RK4, h = {h:e}"), typed)
            .note(note)
    })
    .collect())
}

pub fn light_body(effort: Effort) -> Measures {
    // Sway and yaw, surge and roll coupled so strongly that one combination hardly has inertia: eigenvalues of the
    // matrix scaled to a unit diagonal are 1 ± (1 − δ), its condition 2/δ.
    let delta = 4e-6;
    let (mass, inertia) = (1e-3, Vector3::new(1e-4, 1e-4, 1e-4));
    let added = |delta: f64| {
        let diagonal = Vector6::new(1.2, 2.0, 1.6, 0.5, 0.7, 0.6);
        let mut added = Matrix6::from_diagonal(&diagonal);
        let total = |i: usize| diagonal[i] + if i < 3 { mass } else { inertia[i - 3] };
        for (i, j) in [(1, 5), (0, 3)] {
            added[(i, j)] = (1.0 - delta) * (total(i) * total(j)).sqrt();
            added[(j, i)] = added[(i, j)];
        }
        added
    };
    let data = MassData {
        mass,
        center: Vector3::zeros(),
        inertia: Matrix3::from_diagonal(&inertia),
        added: added(delta),
        gravity: 0.0,
    };
    // Velocities that the matrix gives momentum to.
    let (u, omega) = (Vector3::new(0.3, -0.6, 0.2), Vector3::new(0.5, -0.4, -0.8));
    let start = State { rotation: Matrix3::identity(), b: Vector3::zeros(), u, omega };
    // The motion is fast in the direction that hardly has inertia.
    let duration = if effort == Effort::Quick { 1e-3 } else { 0.01 };
    let Judge { last, floor } = Judge::new(&data, &start, duration);
    let h = 1e-6;
    let typed = naive::run_body(&data, &start, duration, h).distance(&last);
    let kernel = Immersed { mass, inertia, added: data.added }.kernel()?;
    let mut measures: Vec<Measure> = [
        ("order 8, velocities, h = 1e-6", end(&kernel, VelocityForm, order_8(h), &start, duration)),
        ("order 8, momenta, h = 1e-6", end(&kernel, MomentumForm, order_8(h), &start, duration)),
        ("order 8, momenta, adaptive", end(&kernel, MomentumForm, tight(), &start, duration)),
    ]
    .into_iter()
    .map(|(method, found)| {
        let (reached, note) = judged(found, |state| state.distance(&last));
        let what = format!("condition {:.0e}: worst error in {duration} s", 2.0 / delta);
        Measure::new(what, method, reached, 10.0 * floor)
            .because("ten times what one rounding of the added mass does")
            .naive("6×6 solve at every stage, RK4, h = 1e-6", typed)
            .note(note)
    })
    .collect();
    // What is not positive definite, or cannot be told from it.
    let impossible = [0.0, -1e-9, -1e-3];
    let accepted = impossible.iter().filter(|&&delta| Immersed { mass, inertia, added: added(delta) }.kernel().is_ok());
    measures.push(
        Measure::new("singular and indefinite matrices accepted", "refused by kernel()", accepted.count() as f64, 0.0)
            .naive("an LU factorisation takes them all", impossible.len() as f64),
    );
    Ok(measures)
}
