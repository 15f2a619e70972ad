//! Methods of a model over rows of numbers: which programs each one calls, and where their numbers go.

use std::ops::Range;

use gauss_jit::{CallError, Kernel, Model};

use crate::methods::{Id, SPECS, Sizes, Slot, Work};

/// Way in which a method is computed.
#[derive(Clone, Debug)]
enum Plan {
    /// A program with these arguments, one for each frame where it is one of a frame.
    Program(Vec<String>, Vec<Input>),
    /// A program for each frame that gives the origin, then the rotation row by row.
    Pose(Vec<String>),
    /// Inverse dynamics without acceleration, where no program of its own has it.
    Nonlinear,
    /// All joints by one program at the acceleration: the joint is six numbers of them.
    Reaction,
    /// All motions by one program at the acceleration.
    DrivingForces,
    /// Both energies.
    Energy,
    /// The first rows of the centroidal matrix over the mass.
    CenterJacobian,
    /// Rates of components, by a program for the velocity, then accelerations.
    Rates(String),
    /// 1 everywhere: a model without a singular place.
    Regular,
    Retract,
    Difference,
    Tangent,
}

/// An argument of a program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Input {
    Time,
    In(Slot),
}

/// Plans of all methods of a model; none of those that it does not have.
pub struct Plans([Option<Plan>; SPECS.len()]);

impl Plans {
    /// The plans of a model.
    pub fn of(model: &Model, frames: &[&'static str], joints: &[&'static str]) -> Self {
        Self(Id::ALL.map(|id| plan(model, id, frames, joints)))
    }

    /// Whether the model has the method.
    pub fn has(&self, id: Id) -> bool {
        self.0[id as usize].is_some()
    }
}

fn plan(model: &Model, id: Id, frames: &[&'static str], joints: &[&'static str]) -> Option<Plan> {
    let has = |name: &str| model.methods().any(|own| own == name);
    let spec = &SPECS[id as usize];
    // States of elements move with it.
    let velocity = || if has("configuration_rates") { "configuration_rates" } else { "kinematics" }.to_owned();
    match id {
        Id::Retract => return Some(Plan::Retract),
        Id::Difference => return Some(Plan::Difference),
        Id::Tangent => return Some(Plan::Tangent),
        Id::Energy => return Some(Plan::Energy),
        Id::CenterJacobian => return has("centroidal_matrix").then_some(Plan::CenterJacobian),
        Id::Rates => return Some(Plan::Rates(velocity())),
        Id::Regularity if !has("regularity") => return Some(Plan::Regular),
        Id::NonlinearEffects if !has("nonlinear_effects") => return Some(Plan::Nonlinear),
        Id::Reaction => return (!joints.is_empty() && has("reactions_at")).then_some(Plan::Reaction),
        Id::DrivingForces => return has("driving_forces_at").then_some(Plan::DrivingForces),
        _ => {}
    }
    let programs: Vec<String> = match (id, spec.frame) {
        (Id::InverseDynamics, _) => vec!["gauss_residual".to_owned()],
        (_, true) => frames.iter().map(|frame| format!("{}_of_{frame}", spec.name)).collect(),
        (_, false) => vec![spec.name.to_owned()],
    };
    if programs.is_empty() || !programs.iter().all(|name| has(name)) {
        return None;
    }
    if id == Id::Pose {
        return Some(Plan::Pose(programs));
    }
    let slot = |name: &str| spec.arguments.iter().find(|argument| argument.name == name).map(|own| Input::In(own.slot));
    let arguments = model.arguments(&programs[0]).ok()?;
    let inputs = arguments.iter().map(|own| if own.name == "t" { Some(Input::Time) } else { slot(&own.name) });
    Some(Plan::Program(programs, inputs.collect::<Option<Vec<_>>>()?))
}

/// The arguments of some rows: times, and a list for each slot, one row behind the other or one for all.
struct Arguments<'a> {
    rows: usize,
    t: &'a [f64],
    lists: [&'a [f64]; 4],
    /// Count of the numbers of a row of each slot.
    counts: [usize; 4],
}

impl<'a> Arguments<'a> {
    fn list(&self, slot: Slot) -> &'a [f64] {
        self.lists[slot as usize]
    }

    /// The numbers of a slot in a row.
    fn row(&self, slot: Slot, row: usize) -> &'a [f64] {
        let (list, count) = (self.list(slot), self.counts[slot as usize]);
        if list.len() == count { list } else { &list[row * count..][..count] }
    }

    /// The lists of a program's arguments, and empty ones behind them.
    fn of_program(&self, inputs: &[Input]) -> [&'a [f64]; MOST_INPUTS] {
        let mut lists: [&[f64]; MOST_INPUTS] = [&[]; MOST_INPUTS];
        for (list, input) in lists.iter_mut().zip(inputs) {
            *list = match input {
                Input::Time => self.t,
                Input::In(slot) => self.list(*slot),
            };
        }
        lists
    }
}

/// Time and the four slots.
const MOST_INPUTS: usize = 5;

/// The program of a frame; of a method without frames the only one.
fn program_of(programs: &[String], frame: usize) -> &str {
    &programs[frame.min(programs.len() - 1)]
}

/// The results of some rows by a program, one after another.
fn called(kernel: &Kernel, program: &str, rows: usize, arguments: &[&[f64]]) -> Result<Vec<f64>, CallError> {
    let method = kernel.method(program)?;
    let mut results = vec![0.0; rows * method.outputs()];
    method.call_rows(rows, arguments, &mut results)?;
    Ok(results)
}

/// The results of some rows, at least one, one row behind the other.
fn compute(
    kernel: &Kernel,
    (plan, sizes): (&Plan, &Sizes),
    (own, frame): (&Arguments<'_>, usize),
    results: &mut [f64],
) -> Result<(), CallError> {
    let (rows, t, q, z) = (own.rows, own.t, own.list(Slot::Q), own.list(Slot::Z));
    let u = own.list(Slot::U);
    let count = results.len() / rows;
    match plan {
        Plan::Program(programs, inputs) => {
            let method = kernel.method(program_of(programs, frame))?;
            method.call_rows(rows, &own.of_program(inputs)[..inputs.len()], results)?;
        }
        Plan::Pose(programs) => poses(kernel, program_of(programs, frame), own, results)?,
        Plan::Nonlinear => {
            let at_rest = vec![0.0; sizes.speeds];
            kernel.method("gauss_residual")?.call_rows(rows, &[t, q, z, &at_rest, u], results)?;
        }
        Plan::Reaction => {
            let acceleration = called(kernel, "acceleration", rows, &[t, q, z, u])?;
            let all = called(kernel, "reactions_at", rows, &[t, q, z, &acceleration, u])?;
            for (six, all) in results.chunks_exact_mut(6).zip(all.chunks_exact(all.len() / rows)) {
                six.copy_from_slice(&all[6 * frame..6 * frame + 6]);
            }
        }
        Plan::DrivingForces => {
            let acceleration = called(kernel, "acceleration", rows, &[t, q, z, u])?;
            kernel.method("driving_forces_at")?.call_rows(rows, &[t, q, z, &acceleration, u], results)?;
        }
        Plan::Energy => {
            kernel.method("kinetic_energy")?.call_rows(rows, &[t, q, z], results)?;
            let potential = called(kernel, "potential_energy", rows, &[t, q])?;
            results.iter_mut().zip(potential).for_each(|(energy, potential)| *energy += potential);
        }
        Plan::CenterJacobian => center_jacobians(kernel, own, results)?,
        Plan::Rates(velocity) => rates(kernel, (velocity, sizes), own, results)?,
        Plan::Regular => results.fill(1.0),
        Plan::Retract | Plan::Difference | Plan::Tangent => {
            for (row, results) in results.chunks_exact_mut(count.max(1)).enumerate() {
                let (q, x) = (own.row(Slot::Q, row), own.row(Slot::X, row));
                match plan {
                    Plan::Retract => kernel.retract(q, x, results)?,
                    Plan::Difference => kernel.difference(q, x, results)?,
                    _ => kernel.tangent(q, x, results)?,
                }
            }
        }
    }
    Ok(())
}

/// Homogeneous matrices, of programs that give the origin and the rotation.
fn poses(kernel: &Kernel, program: &str, own: &Arguments<'_>, results: &mut [f64]) -> Result<(), CallError> {
    let found = called(kernel, program, own.rows, &[own.t, own.list(Slot::Q)])?;
    for (pose, own) in results.chunks_exact_mut(16).zip(found.chunks_exact(12)) {
        for (i, four) in pose.chunks_exact_mut(4).enumerate() {
            four.copy_from_slice(&match i {
                3 => [0.0, 0.0, 0.0, 1.0],
                i => [own[3 + 3 * i], own[4 + 3 * i], own[5 + 3 * i], own[i]],
            });
        }
    }
    Ok(())
}

fn center_jacobians(kernel: &Kernel, own: &Arguments<'_>, results: &mut [f64]) -> Result<(), CallError> {
    let arguments = [own.t, own.list(Slot::Q)];
    let masses = called(kernel, "total_mass", own.rows, &arguments)?;
    let matrices = called(kernel, "centroidal_matrix", own.rows, &arguments)?;
    let (count, of_matrix) = (results.len() / own.rows, matrices.len() / own.rows);
    for (row, mass) in masses.iter().enumerate() {
        let matrix = &matrices[row * of_matrix..];
        let jacobian = results[row * count..][..count].iter_mut();
        jacobian.zip(matrix).for_each(|(number, momentum)| *number = momentum / mass);
    }
    Ok(())
}

/// Rates of components from velocities that a program gives, then accelerations.
fn rates(
    kernel: &Kernel,
    (velocity, sizes): (&str, &Sizes),
    own: &Arguments<'_>,
    results: &mut [f64],
) -> Result<(), CallError> {
    let arguments = [own.t, own.list(Slot::Q), own.list(Slot::Z), own.list(Slot::U)];
    let taken = if velocity == "kinematics" { 3 } else { 4 };
    let velocities = called(kernel, velocity, own.rows, &arguments[..taken])?;
    let accelerations = called(kernel, "acceleration", own.rows, &arguments)?;
    let count = results.len() / own.rows;
    for row in 0..own.rows {
        let (rates, acceleration) = results[row * count..][..count].split_at_mut(sizes.configuration);
        let velocity = &velocities[row * sizes.increment..][..sizes.increment];
        kernel.component_rates(own.row(Slot::Q, row), velocity, rates)?;
        acceleration.copy_from_slice(&accelerations[row * sizes.speeds..][..sizes.speeds]);
    }
    Ok(())
}

/// So many numbers of rows stay in the nearest caches, and no more rows than these are gathered at a time: both are
/// multiples of what vectors take.
const NEAR: usize = 8192;
const MOST_ROWS: usize = 64;
const LEAST_ROWS: usize = 8;

impl Plans {
    /// Computes rows of a method, many at a time. What a program refuses, which sizes that were compared before
    /// exclude, gives NaN.
    ///
    /// # Safety
    /// All arrays that the method names have these rows, each of the sizes of the scene.
    #[allow(unsafe_code)]
    pub unsafe fn run(&self, (kernel, sizes): (&Kernel, &Sizes), id: Id, work: &Work, rows: Range<usize>) {
        let (Some(plan), spec) = (&self.0[id as usize], &SPECS[id as usize]) else { return };
        let of_results = spec.results.iter().map(|result| result.axes.iter().map(|axis| sizes.get(*axis)).product());
        let of_results: Vec<usize> = of_results.collect();
        let outputs: usize = of_results.iter().sum();
        let mut counts = [0; 4];
        spec.arguments.iter().for_each(|own| counts[own.slot as usize] = sizes.get(own.size));
        let numbers = outputs + counts.iter().sum::<usize>();
        let block = (NEAR / numbers.max(1)).next_multiple_of(LEAST_ROWS).clamp(LEAST_ROWS, MOST_ROWS).min(rows.len());
        let mut results = vec![0.0; outputs * block];
        // An argument without numbers may be no array at all, and what is one for all is there once.
        let rows_of = |count: usize, stride: usize| {
            if count == 0 {
                0
            } else if stride == 0 {
                1
            } else {
                block
            }
        };
        let mut own: [Vec<f64>; 4] =
            std::array::from_fn(|slot| vec![0.0; counts[slot] * rows_of(counts[slot], work.arguments[slot].stride())]);
        let mut times = vec![0.0; rows_of(1, work.t.stride())];
        for start in rows.clone().step_by(block.max(1)) {
            let count = block.min(rows.end - start);
            for (slot, numbers) in own.iter_mut().enumerate().filter(|(_, numbers)| !numbers.is_empty()) {
                let copied = if work.arguments[slot].stride() == 0 { 1 } else { count };
                // SAFETY: of this function.
                unsafe { work.arguments[slot].copy(start..start + copied, counts[slot], numbers) };
            }
            let timed = times.len().min(count);
            // SAFETY: there is a time for each row, or one for all.
            unsafe { work.t.copy(start..start + timed, 1, &mut times) };
            let filled = |slot: usize| {
                let own = &own[slot];
                &own[..own.len().min(counts[slot] * count)]
            };
            let lists = std::array::from_fn(filled);
            let arguments = Arguments { rows: count, t: &times[..timed], lists, counts };
            let results = &mut results[..count * outputs];
            if let Err(error) = compute(kernel, (plan, sizes), (&arguments, work.frame), results) {
                debug_assert!(false, "{}: {error}", spec.name);
                results.fill(f64::NAN);
            }
            let mut next = results.iter();
            for row in start..start + count {
                for (target, count) in work.results.iter().zip(&of_results) {
                    for (i, number) in next.by_ref().take(*count).enumerate() {
                        // SAFETY: of this function.
                        unsafe { target.set(row, i, *number) };
                    }
                }
            }
        }
    }
}
