//! A kernel of a model as Python's classes see it.

use std::ops::Range;
use std::sync::Arc;
use std::time::Duration;

use gauss_jit::Kernel;

use super::runs;
use super::scene::LoadedScene;
use crate::kernels::{AnyKernel, AnyScene, OffGroup, off_group};
use crate::methods::{Id, SPECS, Slot, Work};
use crate::runs::{Many, ManyEnds, one_by_one, request};
use crate::steps::{self, Control, InContact, NO_CONTACTS, Outcome, Request};

/// A kernel with the numbers that it was made from.
pub struct LoadedKernel {
    pub(super) scene: Arc<LoadedScene>,
    pub(super) kernel: Kernel,
    pub(super) numbers: Vec<f64>,
}

impl AnyKernel for LoadedKernel {
    fn scene(&self) -> &dyn AnyScene {
        &*self.scene
    }

    fn numbers(&self) -> &[f64] {
        &self.numbers
    }

    fn warnings(&self) -> Vec<String> {
        let remarks = self.scene.description().remarks.iter();
        let of_file = remarks.filter(|remark| remark.ignored).map(|remark| remark.text.to_owned());
        of_file.chain(self.kernel.warnings().iter().map(ToString::to_string)).collect()
    }

    #[allow(unsafe_code)]
    unsafe fn run(&self, id: Id, work: &Work, rows: Range<usize>) -> Result<(), OffGroup> {
        let blocks: Vec<_> = self.scene.description().unit_blocks().collect();
        for argument in SPECS[id as usize].arguments {
            if argument.slot == Slot::Q || argument.name == "other" {
                let source = &work.arguments[argument.slot as usize];
                // SAFETY: of this function.
                unsafe { off_group(&blocks, argument.slot, source, rows.clone()) }?;
            }
        }
        // SAFETY: of this function.
        unsafe { self.scene.plans.run((&self.kernel, &self.scene.sizes()), id, work, rows) };
        Ok(())
    }

    fn check(&self, q: &[f64], z: &[f64]) -> Result<(), String> {
        let mistakes = steps::mistakes(self.scene.description(), self.scene.names(), q, z);
        if mistakes.is_empty() { Ok(()) } else { Err(mistakes.join("; ")) }
    }

    fn project(&self, t: f64, q: &[f64], z: &[f64]) -> Result<[Vec<f64>; 2], String> {
        self.check(q, z)?;
        runs::project(&self.kernel, t, q, z)
    }

    fn in_contact(&self, _: f64, _: (&[f64], &[f64]), _: &[f64]) -> Result<InContact, String> {
        Err(NO_CONTACTS.to_owned())
    }

    fn simulate(&self, request: &Request<'_>) -> Result<Outcome, String> {
        self.check(request.q, request.z)?;
        runs::simulate(&self.kernel, &self.scene.sizes(), request)
    }

    fn ensemble(&self, many: &Many<'_>) -> Result<ManyEnds, String> {
        if matches!(many.control, Control::ContactEvents(..) | Control::ContactSteps(..)) {
            return Err(NO_CONTACTS.to_owned());
        }
        one_by_one(many, &[], |i| {
            let [q, z] = many.first(i);
            let of_state = steps::mistakes(self.scene.description(), self.scene.names(), q, z);
            let own = (!many.parameters.is_empty()).then(|| self.scene.of_numbers(&many.own(&self.numbers, i)));
            let own = own.transpose();
            let of_parameters = own.as_ref().err().into_iter().flatten().map(|violation| violation.message.clone());
            let mistakes: Vec<String> = of_state.into_iter().chain(of_parameters).collect();
            match own {
                Ok(own) if mistakes.is_empty() => {
                    let kernel = own.as_ref().unwrap_or(&self.kernel);
                    runs::simulate(kernel, &self.scene.sizes(), &request(many, i))
                }
                _ => Err(mistakes.join("; ")),
            }
        })
    }

    fn batch_time(&self, _: &Many<'_>) -> Result<Duration, String> {
        Err("batches in Rust alone are those of compiled kernels".to_owned())
    }
}
