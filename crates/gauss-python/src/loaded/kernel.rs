//! A model and its kernels as Python's classes see them.

use std::ops::Range;
use std::sync::Arc;
use std::time::Duration;

use gauss_jit::{Kernel, Notation};
use gauss_runtime::accuracy::Loss;
use gauss_runtime::contact::Contact;

use super::runs;
use super::scene::LoadedScene;
use crate::description::Description;
use crate::kernels::{AnyKernel, AnyScene, OffGroup, Violation, off_group};
use crate::methods::{Id, SPECS, Sizes, Slot, Work};
use crate::runs::{Many, ManyEnds, TOUCHED, one_by_one, request};
use crate::steps::{self, AnyStepper, Control, InContact, Outcome, Request};

impl AnyScene for LoadedScene {
    fn description(&self) -> &Description {
        &self.description
    }

    fn equations(&self) -> [&str; 2] {
        [Notation::Text, Notation::Latex].map(|notation| self.model.equations(notation))
    }

    fn operations(&self) -> String {
        self.model.operations().map(|(name, counts)| format!("{name:<20}{counts}")).collect::<Vec<_>>().join("\n")
    }

    fn accuracy(&self) -> String {
        let line = |(name, lost): &(String, [f64; 2])| format!("{name:<20}{}", Loss::new(lost[0], lost[1]));
        self.model.accuracy().iter().map(line).collect::<Vec<_>>().join("\n")
    }

    fn names(&self) -> [&[&'static str]; 2] {
        [&self.names[0], &self.names[1]]
    }

    fn sizes(&self) -> Sizes {
        self.sizes
    }

    fn frames(&self) -> &[&'static str] {
        &self.frames
    }

    fn joints(&self) -> &[&'static str] {
        &self.joints
    }

    fn motions(&self) -> &[&'static str] {
        &self.motions
    }

    fn parameters(&self) -> &[&'static str] {
        &self.parameters
    }

    fn contacts(&self) -> &[Contact] {
        self.model.contacts()
    }

    fn has(&self, id: Id) -> bool {
        self.plans.has(id)
    }

    fn at_rest(&self) -> [Vec<f64>; 2] {
        let mut q = vec![0.0; self.sizes.configuration];
        for (place, count) in self.description.unit_blocks() {
            // The real part: last of a quaternion, first of a rotation in the plane.
            q[if count == 4 { place + 3 } else { place }] = 1.0;
        }
        [q, vec![0.0; self.sizes.speeds]]
    }

    fn kernel(self: Arc<Self>, numbers: Vec<f64>) -> Result<Box<dyn AnyKernel>, Vec<Violation>> {
        let kernel = self.of_numbers(&numbers)?;
        Ok(Box::new(LoadedKernel { scene: self, kernel, numbers }))
    }
}

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

    fn with(&self, numbers: Vec<f64>) -> Result<Box<dyn AnyKernel>, Vec<Violation>> {
        Arc::clone(&self.scene).kernel(numbers)
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
        runs::project(&self.kernel, &self.scene.sizes, t, (q, z))
    }

    fn in_contact(&self, t: f64, (q, z): (&[f64], &[f64]), input: &[f64]) -> Result<InContact, String> {
        self.check(q, z)?;
        runs::in_contact(&self.kernel, &self.scene.sizes, t, (q, z), input)
    }

    fn simulate(&self, request: &Request<'_>) -> Result<Outcome, String> {
        self.check(request.q, request.z)?;
        runs::simulate(&self.kernel, &self.scene.sizes(), request)
    }

    fn stepper(&self, request: &Request<'_>) -> Result<Box<dyn AnyStepper>, String> {
        self.check(request.q, request.z)?;
        runs::stepper(&self.kernel, &self.scene.sizes(), request)
    }

    fn ensemble(&self, many: &Many<'_>) -> Result<ManyEnds, String> {
        let touches = matches!(many.control, Control::ContactEvents(..) | Control::ContactSteps(..));
        one_by_one(many, if touches { &TOUCHED } else { &[] }, |i| {
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
