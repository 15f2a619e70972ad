//! Rounding errors beyond what the scene excuses: programs in double precision against the same in 256 digits.

use crate::algebra::{Number, Precise, Scalar};
use crate::derivation::Derivation;
use crate::program::ArgumentKind;

/// A state of a scene: the numbers of the fields, the configuration, and speeds or momenta.
pub struct SceneState {
    pub parameters: Vec<f64>,
    pub configuration: Vec<f64>,
    pub speeds: Vec<f64>,
}

/// The errors of the outputs of a method in double precision, and what it would change them if every number of the
/// scene were rounded once: the sum of the changes that one unit in the last place of each makes, which is what the
/// scene itself excuses.
pub struct OutputErrors {
    /// In double precision.
    pub rounded: Vec<f64>,
    pub errors: Vec<f64>,
    pub excused: Vec<f64>,
}

impl OutputErrors {
    pub fn of(derivation: &Derivation, method: &str, state: &SceneState) -> Self {
        let rounded = outputs(derivation, method, state, |x| x);
        let exact = outputs(derivation, method, state, Precise::number);
        let mut excused: Vec<f64> = exact.iter().map(|e| e.to_f64().abs() * f64::EPSILON).collect();
        for k in 0..state.numbers().count() {
            let mut place = 0;
            let moved = outputs(derivation, method, state, |x| {
                place += 1;
                let own = Precise::number(x);
                if place == k + 1 { own * (Precise::number(1.0) + Precise::number(f64::EPSILON)) } else { own }
            });
            for (sum, (a, b)) in excused.iter_mut().zip(moved.iter().zip(&exact)) {
                *sum += (*a - *b).to_f64().abs();
            }
        }
        let errors = rounded.iter().zip(&exact).map(|(a, b)| (Precise::number(*a) - *b).to_f64().abs()).collect();
        Self { rounded, errors, excused }
    }

    /// The largest ratio of an error to the error that is excused.
    pub fn worst(&self) -> f64 {
        self.errors.iter().zip(&self.excused).map(|(e, x)| if *e == 0.0 { 0.0 } else { e / x }).fold(0.0, f64::max)
    }
}

impl SceneState {
    fn numbers(&self) -> impl Iterator<Item = f64> {
        self.parameters.iter().chain(&self.configuration).chain(&self.speeds).copied()
    }
}

/// The outputs of a method at a state, in any arithmetic.
pub fn outputs<T: Scalar>(
    derivation: &Derivation,
    method: &str,
    state: &SceneState,
    mut number: impl FnMut(f64) -> T,
) -> Vec<T> {
    let mut all = state.numbers().map(&mut number);
    let mut take = |n: usize| -> Vec<T> { all.by_ref().take(n).collect() };
    let [parameters, configuration, speeds] =
        [state.parameters.len(), state.configuration.len(), state.speeds.len()].map(&mut take);
    let constants = derivation.constants().run(&[&parameters]).expect("the parameters");
    let program = derivation.program(method).expect("a method");
    let arguments = program.arguments.iter().map(|argument| match argument.kind {
        ArgumentKind::Constants => constants.clone(),
        ArgumentKind::Configuration => configuration.clone(),
        ArgumentKind::Speeds | ArgumentKind::Momenta => speeds.clone(),
        _ => argument.components.iter().map(|_| T::number(0.0)).collect(),
    });
    let arguments: Vec<Vec<T>> = arguments.collect();
    let arguments: Vec<&[T]> = arguments.iter().map(Vec::as_slice).collect();
    program.run(&arguments).expect("the arguments")
}
