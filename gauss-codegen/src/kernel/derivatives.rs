//! Derivatives of functions along what moves.

use crate::accuracy::Trial;
use crate::derivatives::DirectionalDerivatives;

use super::choice::{Aim, LoweredForm, Pool, programs_of};
use super::columns::LoweredColumns;
use super::expected_outputs::{ExpectedOutputs, OutputSelection};
use super::hoist::Hoister;
use super::tangent::{tangents_alone, with_tangents};
use super::write::Program;

/// The program of derivatives, with the way in which many right-hand sides are solved for together.
pub(super) type ColumnProgram<'g> = (Program<'g>, Option<LoweredColumns<'g>>);

impl<'g> DirectionalDerivatives<'g> {
    /// The cheapest arrangement with its derivatives. What is defined enters as it is, because its rates are simple
    /// where those of its definition are not: R σ̂ beside what a quaternion makes of it.
    pub(super) fn lower(
        &self,
        hoister: &mut Hoister<'_, 'g>,
        kept: OutputSelection,
        trial: &mut Trial,
    ) -> (ColumnProgram<'g>, ExpectedOutputs<'_, 'g>) {
        let definitions = hoister.program(&self.defined);
        let differentiate = if kept == OutputSelection::ValuesToo { with_tangents } else { tangents_alone };
        let Pool { lowered, tried, .. } =
            Pool::of(&self.arrangements, Aim::Values, hoister, Hoister::hoist_undefined, trial);
        // What loses digits at sample states loses them in its derivatives, too. At states that were sought derivatives
        // may keep what their functions lose, or lose what these keep: there they are tried themselves.
        let usable = if trial.decides_derivatives() { vec![true; lowered.len()] } else { tried.usable() };
        let tried = tried.only(&usable);
        let of_usable = lowered.into_iter().zip(usable).filter(|(_, usable)| *usable);
        let of_usable = of_usable.map(|(LoweredForm { outputs, program, .. }, _)| {
            (differentiate(&program, (&self.defined, &definitions), &self.directions), outputs)
        });
        let mut of_usable: Vec<_> = of_usable.collect();
        let costs: Vec<u32> = of_usable.iter().map(|(program, _)| program.cost().total()).collect();
        // Of the functions themselves there are programs of their own.
        let best = if trial.decides_derivatives() {
            let values = if kept == OutputSelection::ValuesToo { self.arrangements[0].len() } else { 0 };
            let alone = of_usable.iter().map(|(Program { instructions, outputs }, _)| Program {
                instructions: instructions.clone(),
                outputs: outputs[values..].to_vec(),
            });
            let alone: Vec<Program<'g>> = alone.collect();
            trial.tried(&alone.iter().collect::<Vec<_>>()).taken(&costs)
        } else {
            tried.taken(&costs)
        };
        let (program, outputs) = of_usable.swap_remove(best);
        let (program, columns) = self.cheaper(program, hoister, trial);
        ((program.carried_out(hoister.passes), columns), ExpectedOutputs::along(outputs, &self.directions, kept))
    }

    /// Forms that could be taken: programs whose constants are not computed before.
    pub(super) fn forms(&self, kept: OutputSelection) -> Vec<Program<'g>> {
        let definitions = Program::lower(&self.defined);
        let differentiate = if kept == OutputSelection::ValuesToo { with_tangents } else { tangents_alone };
        let programs = programs_of(&self.arrangements).into_iter();
        programs.map(|program| differentiate(&program, (&self.defined, &definitions), &self.directions)).collect()
    }

    /// A program of derivatives, or what has a form of its own and costs less. Of roots, whose slope may be infinite,
    /// only programs know what their derivatives are where nothing changes.
    fn cheaper(&self, program: Program<'g>, hoister: &mut Hoister<'_, 'g>, trial: &mut Trial) -> ColumnProgram<'g> {
        let most = program.cost().total();
        if program.counts().roots > 0 {
            return (program, None);
        }
        let derived = self.derived.iter().map(|derived| {
            let program = hoister.program(&derived.outputs).signed(hoister.passes);
            (program, derived.columns.as_ref())
        });
        let mut ways: Vec<_> = derived.filter(|(program, _)| program.cost().total() < most).collect();
        if ways.is_empty() {
            return (program, None);
        }
        ways.push((program, None));
        trial.define(hoister.constants());
        let tried = trial.tried(&ways.iter().map(|(program, _)| program).collect::<Vec<_>>());
        let costs: Vec<u32> = ways.iter().map(|(program, _)| program.cost().total()).collect();
        let (program, columns) = ways.swap_remove(tried.taken(&costs));
        (program, columns.and_then(|columns| columns.lower(hoister)))
    }
}
