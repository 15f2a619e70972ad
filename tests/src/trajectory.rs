//! A system run over a reference solution: the final state against what the reference says.

use std::fs;
use std::path::Path;

use gauss_runtime::integrate::Form;
use gauss_runtime::prelude::*;
use serde_json::Value;

use crate::order8::Order8;

/// A file of `data/reference`.
///
/// # Panics
/// When there is none of this name, or it is not JSON.
#[must_use]
pub fn reference(name: &str) -> Value {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("data/reference").join(format!("{name}.json"));
    serde_json::from_str(&fs::read_to_string(path).expect("the scene is in the project")).expect("it is JSON")
}

/// The numbers in a value, nested lists in reading order; matrices row by row.
///
/// # Panics
/// When there is something else in it.
#[must_use]
pub fn numbers(value: &Value) -> Vec<f64> {
    match value {
        Value::Array(items) => items.iter().flat_map(numbers).collect(),
        Value::String(text) => vec![text.parse().expect("a decimal")],
        _ => panic!("not a number: {value}"),
    }
}

/// One number.
///
/// # Panics
/// When it is none.
#[must_use]
pub fn number(value: &Value) -> f64 {
    let [one] = numbers(value)[..] else { panic!("not one number: {value}") };
    one
}

/// Three numbers.
///
/// # Panics
/// When they are not three.
#[must_use]
pub fn triple(value: &Value) -> Vector3<f64> {
    let [x, y, z] = numbers(value)[..] else { panic!("not three numbers: {value}") };
    Vector3::new(x, y, z)
}

/// A rotation matrix as a quaternion.
///
/// # Panics
/// When there are not nine numbers.
#[must_use]
pub fn rotation(value: &Value) -> UnitQuaternion<f64> {
    let rows = numbers(value);
    assert_eq!(rows.len(), 9);
    crate::scene::quaternion_of(&Matrix3::from_row_slice(&rows))
}

/// The entries of a rotation, row by row, as references list them.
#[must_use]
pub fn rows(rotation: &UnitQuaternion<f64>) -> Vec<f64> {
    rotation.to_rotation_matrix().into_inner().transpose().iter().copied().collect()
}

/// What is seen of a state, under the keys of the references.
pub type Seen = Vec<(&'static str, Vec<f64>)>;

/// A run: what it goes by and from where.
#[derive(Clone, Copy, Debug)]
pub struct Run<'a, S: GaussSystem> {
    /// The name of the scene.
    pub name: &'a str,
    /// The kernel.
    pub system: &'a S,
    /// Where it starts.
    pub start: (S::Configuration, S::Speeds),
}

impl<S: GaussSystem<Scalar = f64, Input = ()>> Run<'_, S> {
    /// Runs the kernel in velocity form and in momentum form over the scene, and compares what `observe` makes of the
    /// initial and the final state with what the reference says under the same keys.
    ///
    /// Allowed: three times the published error of an established integrator (DOP853, relative tolerance 1e-13) on
    /// textbook equations, one sample of such errors; and rounding, for which each of N steps commits about 8 of random
    /// sign, so that 8√N of them change the final state by the scene's sensitivity to one. Parameters, and constants
    /// made of them, are rounded once, which makes everything move at a wrong rate, so 8Θ with Θ = max |q̇| T count
    /// too. `stretch` is how much the chosen variables magnify what is committed in them: 1 for those of the textbook
    /// equations. Chains of coordinates and back cost ten more.
    ///
    /// # Panics
    /// When a state is farther off than that.
    #[track_caller]
    pub fn agrees(&self, stretch: f64, observe: impl Fn(f64, &S::Configuration, &S::Speeds) -> Seen) {
        self.agrees_in(VelocityForm, stretch, &observe);
        self.agrees_in(MomentumForm, stretch, &observe);
    }

    #[track_caller]
    fn agrees_in(
        &self,
        form: impl Form<S>,
        stretch: f64,
        observe: &impl Fn(f64, &S::Configuration, &S::Speeds) -> Seen,
    ) {
        let Self { name, system, start: (q, z) } = self;
        let scene = reference(name);
        let duration = number(&scene["T"]);
        let (mut steps, mut fastest) = (0, 0.0_f64);
        let last = Simulation::new(*system)
            .form(form)
            .control(Order8::new(1e-12))
            .max_steps(200_000)
            .observe(|sample| {
                steps += 1;
                fastest = fastest.max(system.kinematics(sample.t, &sample.q, &sample.z).max_norm());
            })
            .run_to_end(*q, *z, 0.0..duration)
            .expect("the motion is regular");
        let guide = &scene["double_precision_guide"];
        let sensitivity = number(&guide["change_if_initial_state_perturbed_by_2em53_relative"]).max(f64::EPSILON);
        let published = guide["scipy_DOP853_rtol1e_13"].as_object().expect("published errors").values();
        let published = published.filter_map(|p| p["error_rel"].as_str()?.parse::<f64>().ok()).fold(0.0, f64::max);
        let roundings = 10.0 + 8.0 * (f64::from(steps).sqrt() + fastest * duration);
        let allowed = stretch * (3.0 * published + roundings * sensitivity);
        for (when, state, allowed) in [
            // The initial state only goes through coordinates and back.
            ("initial", observe(0.0, q, z), 32.0 * f64::EPSILON * stretch),
            ("final", observe(duration, &last.q, &last.z), allowed),
        ] {
            assert!(!state.is_empty());
            for (key, found) in state {
                let expected = numbers(&scene[when][key]);
                assert_eq!(found.len(), expected.len(), "{name} {key}");
                let size = expected.iter().fold(1.0_f64, |m, x| m.max(x.abs()));
                for (found, expected) in found.iter().zip(&expected) {
                    let error = (found - expected).abs() / size;
                    assert!(error <= allowed, "{name}, {when} {key}: off by {error:e}, allowed {allowed:e}");
                }
            }
        }
    }
}
