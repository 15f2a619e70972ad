//! Loops: points that two bodies share, found from the residuals of constraints.

use gauss_runtime::nalgebra::{DMatrix, DVector, Matrix3, Vector3};

use super::masses::STATES;
use super::motions::ROUNDING;
use super::numbers::{SceneNumbers, Sequence, Value, are_small, shortest};
use super::parts::Closure;
use super::tree::JointTree;

/// A state with the residuals of all constraints and the places of bodies, of which the first is what stands still.
struct LoopState {
    residual: Vec<f64>,
    places: Vec<(Vector3<f64>, Matrix3<f64>)>,
}

/// The axes in which a constraint is written.
#[derive(Clone, Copy)]
enum Axes {
    Observer,
    First,
    Second,
}

/// Points that two bodies share, which are all constraints of the scene.
///
/// # Errors
/// A sentence about constraints that are none of that.
pub fn closures(scene: &SceneNumbers, tree: &JointTree) -> Result<Vec<Closure>, String> {
    let refused = |why: &str| Err(format!("constraints (`constraint`, a loop): {why}"));
    let states = states(scene, tree);
    let Some(count) = states.first().map(|state| state.residual.len()) else {
        return refused("one depends on the time");
    };
    // Constraints of velocities leave a zero among the residuals of places.
    let is_of_places = |row: usize| states.iter().any(|state| state.residual[row].abs() > ROUNDING);
    if let Some(row) = (0..count).find(|row| !is_of_places(*row)) {
        return refused(&format!("equation {} of {count} is one of velocities", row + 1));
    }
    let (mut row, mut list) = (0, Vec::new());
    while row < count {
        let found = (1..=3).rev().filter(|rows| row + rows <= count).find_map(|rows| {
            let closure = shared_point(&states, row, rows)?;
            Some((rows, closure))
        });
        let Some((rows, closure)) = found else {
            return refused(&format!("equation {} of {count} is none of a point that two bodies share", row + 1));
        };
        list.push(closure);
        row += rows;
    }
    Ok(list)
}

/// States of general position; none where the time moves what is constrained.
fn states(scene: &SceneNumbers, tree: &JointTree) -> Vec<LoopState> {
    let mut sequence = Sequence::new();
    let call = |method: &str, t: f64, values: &[Value]| {
        let (q, z) = (scene.configuration(values), vec![0.0; scene.rates_by_speeds(values).ncols()]);
        let count = scene.kernel.model().arguments(method).ok()?.len();
        scene.kernel.call(method, &[&[t][..], &q, &z][..count]).ok()
    };
    let state = |values: Vec<Value>| {
        let residual = call("position_residual", 0.0, &values)?;
        let later = call("position_residual", 0.7, &values)?;
        let place = |body: usize| {
            let place = tree.place(body, &values);
            (place.translation.vector, *place.rotation.to_rotation_matrix().matrix())
        };
        let still = std::iter::once((Vector3::zeros(), Matrix3::identity()));
        let places = still.chain((0..tree.places.len()).map(place)).collect();
        (residual == later).then_some(LoopState { residual, places })
    };
    let all: Option<Vec<LoopState>> = (0..2 * STATES).map(|_| state(scene.sample(&mut sequence))).collect();
    all.unwrap_or_default()
}

/// The point that two bodies share if some rows from one on are 0.
fn shared_point(states: &[LoopState], row: usize, rows: usize) -> Option<Closure> {
    // Of two rows the third, of one row the two others are 0 at all states, as in a plane.
    let places: &[&[usize]] = match rows {
        3 => &[&[0, 1, 2]],
        2 => &[&[0, 1], &[0, 2], &[1, 2]],
        _ => &[&[0], &[1], &[2]],
    };
    let bodies = states.first()?.places.len();
    let pairs = (0..bodies).flat_map(|one| (0..bodies).map(move |other| (one, other))).filter(|(a, b)| a != b);
    pairs.into_iter().find_map(|pair| {
        let axes = [Axes::Observer, Axes::First, Axes::Second];
        axes.into_iter().find_map(|axes| places.iter().find_map(|places| fitted(states, row, places, (pair, axes))))
    })
}

/// Points r₁, r₂ of two bodies with `b₁ + R₁ r₁ − b₂ − R₂ r₂` as the residual, in some axes.
fn fitted(
    states: &[LoopState],
    row: usize,
    places: &[usize],
    ((one, other), axes): ((usize, usize), Axes),
) -> Option<Closure> {
    let (mut rows, mut given) = (DMatrix::zeros(3 * states.len(), 6), DVector::zeros(3 * states.len()));
    for (k, state) in states.iter().enumerate() {
        let ((b1, r1), (b2, r2)) = (state.places[one], state.places[other]);
        let turn = match axes {
            Axes::Observer => Matrix3::identity(),
            Axes::First => r1.transpose(),
            Axes::Second => r2.transpose(),
        };
        let mut residual = Vector3::zeros();
        places.iter().enumerate().for_each(|(i, &place)| residual[place] = state.residual[row + i]);
        rows.view_mut((3 * k, 0), (3, 3)).copy_from(&(turn * r1));
        rows.view_mut((3 * k, 3), (3, 3)).copy_from(&-(turn * r2));
        given.rows_mut(3 * k, 3).copy_from(&(residual - turn * (b1 - b2)));
    }
    let found = rows.clone().svd(true, true).solve(&given, ROUNDING).ok()?;
    let size = 1.0 + given.amax();
    let point = |first: usize| [0, 1, 2].map(|i| shortest(found[first + i], 1e-14 * size));
    let body = |place: usize| place.checked_sub(1);
    are_small((&rows * &found - &given).iter(), 100.0 * ROUNDING * size)
        .then(|| Closure { bodies: [body(one), body(other)], points: [point(0), point(3)] })
}
