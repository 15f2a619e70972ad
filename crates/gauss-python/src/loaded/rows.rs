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

/// The arguments of one row: time, and a list for each slot.
struct Row<'a> {
    t: f64,
    lists: [&'a [f64]; 4],
}

impl<'a> Row<'a> {
    fn list(&self, slot: Slot) -> &'a [f64] {
        self.lists[slot as usize]
    }

    /// The lists of a program's arguments, and empty ones behind them.
    fn arguments<'b>(&'b self, inputs: &[Input]) -> [&'b [f64]; MOST_INPUTS] {
        let mut lists: [&[f64]; MOST_INPUTS] = [&[]; MOST_INPUTS];
        for (list, input) in lists.iter_mut().zip(inputs) {
            *list = match input {
                Input::Time => std::slice::from_ref(&self.t),
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

/// The results of a row, one after another.
fn compute(
    kernel: &Kernel,
    (plan, sizes): (&Plan, &Sizes),
    (row, frame): (&Row<'_>, usize),
    results: &mut [f64],
) -> Result<(), CallError> {
    let (t, q, z) = (&[row.t][..], row.list(Slot::Q), row.list(Slot::Z));
    let (x, u) = (row.list(Slot::X), row.list(Slot::U));
    match plan {
        Plan::Program(programs, inputs) => {
            kernel.method(program_of(programs, frame))?.call(&row.arguments(inputs)[..inputs.len()], results)
        }
        Plan::Pose(programs) => {
            let mut own = [0.0; 12];
            kernel.method(&programs[frame])?.call(&[t, q], &mut own)?;
            for (i, four) in results.chunks_exact_mut(4).enumerate() {
                four.copy_from_slice(&match i {
                    3 => [0.0, 0.0, 0.0, 1.0],
                    i => [own[3 + 3 * i], own[4 + 3 * i], own[5 + 3 * i], own[i]],
                });
            }
            Ok(())
        }
        Plan::Nonlinear => kernel.method("gauss_residual")?.call(&[t, q, z, &vec![0.0; sizes.speeds], u], results),
        Plan::Reaction => {
            let mut acceleration = vec![0.0; sizes.speeds];
            kernel.method("acceleration")?.call(&[t, q, z, u], &mut acceleration)?;
            let all = kernel.call("reactions_at", &[t, q, z, &acceleration, u])?;
            results.copy_from_slice(&all[6 * frame..6 * frame + 6]);
            Ok(())
        }
        Plan::Energy => {
            let mut potential = [0.0];
            kernel.method("kinetic_energy")?.call(&[t, q, z], results)?;
            kernel.method("potential_energy")?.call(&[t, q], &mut potential)?;
            results[0] += potential[0];
            Ok(())
        }
        Plan::CenterJacobian => center_jacobian(kernel, &[t, q], results),
        Plan::Rates(velocity) => {
            let mut own = vec![0.0; sizes.increment];
            let arguments = [t, q, z, u];
            let count = if velocity == "kinematics" { 3 } else { 4 };
            kernel.method(velocity)?.call(&arguments[..count], &mut own)?;
            let (rates, acceleration) = results.split_at_mut(sizes.configuration);
            kernel.component_rates(q, &own, rates)?;
            kernel.method("acceleration")?.call(&arguments, acceleration)
        }
        Plan::Regular => {
            results[0] = 1.0;
            Ok(())
        }
        Plan::Retract => kernel.retract(q, x, results),
        Plan::Difference => kernel.difference(q, x, results),
        Plan::Tangent => kernel.tangent(q, x, results),
    }
}

fn center_jacobian(kernel: &Kernel, arguments: &[&[f64]; 2], results: &mut [f64]) -> Result<(), CallError> {
    let mut mass = [0.0];
    kernel.method("total_mass")?.call(arguments, &mut mass)?;
    let matrix = kernel.call("centroidal_matrix", arguments)?;
    results.iter_mut().zip(matrix).for_each(|(number, momentum)| *number = momentum / mass[0]);
    Ok(())
}

impl Plans {
    /// Computes rows of a method. What a program refuses, which sizes that were compared before exclude, gives NaN.
    ///
    /// # Safety
    /// All arrays that the method names have these rows, each of the sizes of the scene.
    #[allow(unsafe_code)]
    pub unsafe fn run(&self, (kernel, sizes): (&Kernel, &Sizes), id: Id, work: &Work, rows: Range<usize>) {
        let (Some(plan), spec) = (&self.0[id as usize], &SPECS[id as usize]) else { return };
        let counts = spec.results.iter().map(|result| result.axes.iter().map(|axis| sizes.get(*axis)).product());
        let counts: Vec<usize> = counts.collect();
        let mut results = vec![0.0; counts.iter().sum()];
        let own = spec.arguments.iter().map(|own| (own.slot as usize, sizes.get(own.size)));
        let mut own: Vec<_> = own.map(|(slot, size)| (slot, vec![0.0; size])).collect();
        // It is found once for all rows.
        let program = match plan {
            Plan::Program(programs, inputs) => kernel.method(program_of(programs, work.frame)).ok().zip(Some(inputs)),
            _ => None,
        };
        for row in rows {
            let mut lists: [&[f64]; 4] = [&[]; 4];
            for (slot, numbers) in &mut own {
                // An argument without numbers may be no array at all.
                if !numbers.is_empty() {
                    let size = numbers.len();
                    // SAFETY: of this function.
                    unsafe { work.arguments[*slot].copy(row..row + 1, size, numbers) };
                }
                lists[*slot] = numbers;
            }
            // SAFETY: there is a time for each row, or one for all.
            let t = unsafe { work.t.get(row, 0) };
            let one = Row { t, lists };
            let computed = match &program {
                Some((program, inputs)) => program.call(&one.arguments(inputs)[..inputs.len()], &mut results),
                None => compute(kernel, (plan, sizes), (&one, work.frame), &mut results),
            };
            if computed.is_err() {
                debug_assert!(false, "{}: {computed:?}", spec.name);
                results.fill(f64::NAN);
            }
            let mut next = results.iter();
            for (target, count) in work.results.iter().zip(&counts) {
                for (i, number) in next.by_ref().take(*count).enumerate() {
                    // SAFETY: of this function.
                    unsafe { target.set(row, i, *number) };
                }
            }
        }
    }
}
