//! Losses of derivatives, beside the same programs in 256 binary digits, and the figures for them.

use crate::accuracy::random::Random;
use crate::algebra::{Evaluation, Map, Notation, Number, print};
use crate::emit::Derived;
use crate::expand::derive;
use crate::kernel::{Derivative, Kernel};

use super::scenes;
use super::{MOST, WITHIN, above, loss_beside, number_from, state, values_of, values_of_scene};

/// Two of each kind: some seconds.
const SCENES: u64 = 16;
/// Largest loss of derivatives at a state where accelerations keep their digits: two decimal places.
const FEW: f64 = 100.0;

/// The loss of a derivative at a state, and what its kernel says.
struct DerivativeLoss {
    loss: f64,
    said: f64,
    text: String,
}

/// Runs a derivative with constants from the parameters of a state.
fn computed<'g, N: Number>(kernel: &Kernel<'g>, derivative: &Derivative<'g>, mut state: Map<u32, N>) -> Vec<N> {
    let mut evaluation = Evaluation::new(&state);
    let folded: Vec<(u32, N)> = kernel.folded.iter().map(|(symbol, e)| (symbol.key(), evaluation.value(*e))).collect();
    state.extend(folded);
    let constants = kernel.constants.run(&state);
    state.extend(kernel.constant_symbols.iter().zip(constants).map(|(symbol, value)| (symbol.key(), value)));
    derivative.program.run(&state)
}

/// Losses of all derivatives of a kernel that have a value.
fn losses_at(derived: &Derived<'_, '_>, mut values: Vec<(u32, f64)>, seed: u64) -> Vec<DerivativeLoss> {
    let mut random = Random::new(seed ^ 0x0123);
    let rates = &derived.subject.system.scene.speed_rates;
    values.extend(rates.iter().chain(derived.weights).map(|symbol| (symbol.key(), random.signed(0.5))));
    let lost = |derivative: &Derivative<'_>| {
        let found = computed(derived.kernel, derivative, state::<f64>(derived, &values, None));
        let exact = |state| computed(derived.kernel, derivative, state);
        let (loss, row) = loss_beside(derived, &values, exact, &found, seed)?;
        let said = derivative.figure.as_ref()?.rounded()[0];
        Some(DerivativeLoss { loss, said, text: format!("{}, row {row}", derivative.kind.name()) })
    };
    derived.kernel.derivatives.iter().filter_map(lost).collect()
}

/// Losses in scenes whose kernels have all derivatives.
fn losses_of(source: &str, values: impl Fn(&Derived<'_, '_>) -> Vec<(u32, f64)>, seed: u64) -> Vec<DerivativeLoss> {
    let source = source.replace(")] struct", ", linearize(inverse, hessian))] struct");
    let input: syn::DeriveInput = syn::parse_str(&source).expect("the source is a struct");
    let losses = derive(&input, |derived| Ok(losses_at(derived, values(derived), seed)));
    losses.unwrap_or_else(|error| panic!("{error}: {source}"))
}

#[test]
fn derivatives_of_random_scenes_lose_what_is_said() {
    let first = number_from("FIRST", 0);
    let of = |seed: u64| {
        let scene = scenes::scene(seed);
        let source = scene.source();
        let losses = losses_of(&source, |derived| values_of_scene(derived, &scene, seed), seed);
        losses
            .into_iter()
            .map(move |lost| DerivativeLoss { text: format!("{} (scene {seed}): {source}", lost.text), ..lost })
    };
    let mut losses: Vec<DerivativeLoss> = (first..first + number_from("SCENES", SCENES)).flat_map(of).collect();
    losses.sort_by(|a, b| b.loss.total_cmp(&a.loss));
    let all: Vec<f64> = losses.iter().map(|lost| lost.loss).collect();
    let (median, worst) = (all[all.len() / 2], all[0]);
    println!("{} derivatives, median {median:.2}, worst {worst:.3e}, above 1e3: {}", all.len(), above(&all, MOST));
    let said: Vec<f64> = losses.iter().map(|lost| lost.said).collect();
    println!("said above 1e3: {}, above 1e6: {}, 1e10: {}", above(&said, MOST), above(&said, 1e6), above(&said, 1e10));
    losses.iter().take(12).for_each(|lost| println!("{:9.3e} said {:e}  {}", lost.loss, lost.said, lost.text));
    for DerivativeLoss { loss, said, text } in losses.iter().filter(|lost| lost.loss > MOST) {
        assert!(*loss <= WITHIN * said, "{text} loses {loss:e}, and its kernel says {said:e}");
    }
}

/// Losses of derivatives at one state of a scene of scalars, with the values of the fields of its struct.
fn losses_there(scene: &str, fields: &[(&str, f64)], configuration: &[f64], speeds: &[f64]) -> Vec<DerivativeLoss> {
    let configuration: Vec<Vec<f64>> = configuration.iter().map(|number| vec![*number]).collect();
    let values = |derived: &Derived<'_, '_>| {
        let of_field = |name: &str| fields.iter().find(|(field, _)| *field == name).map(|(_, value)| *value);
        let sources = derived.subject.provenance.sources.iter();
        let of_fields = sources.map(|source| (source.symbol.key(), of_field(&print(source.symbol, Notation::Text))));
        let mut values = values_of(derived, &configuration, speeds.iter().copied());
        values.extend(of_fields.map(|(key, value)| (key, value.expect("a value of every field"))));
        values
    };
    let fields: Vec<String> = fields.iter().map(|(name, _)| format!("{name}: f64")).collect();
    let losses = losses_of(&format!("#[gauss({scene})] struct Scene {{ {} }}", fields.join(", ")), values, 7);
    losses
        .iter()
        .for_each(|DerivativeLoss { loss, said, text }| println!("{text}: {loss:.1e}, said {said:e}: {scene}"));
    losses
}

/// The tide at the end of a tether of one centimetre, 7000 km from the centre: accelerations keep their digits in a
/// form that a state decides for which was sought.
#[test]
fn derivatives_keep_the_digits_that_accelerations_keep() {
    let scene = "coordinates(x, y, z, u, v, w), central_gravity(mu = 3.986004418e14), \
                 particle(mass = 1000.1, position = [x, y, z]), \
                 particle(mass = 1.234, position = [x + u, y + v, z + w])";
    let speeds = [0.1, 0.2, 0.3, 0.01, 0.02, 0.03];
    for DerivativeLoss { loss, text, .. } in losses_there(scene, &[], &[5e6, 4e6, 3e6, 0.006, 0.008, 0.0001], &speeds) {
        assert!(loss <= FEW, "{text} loses {loss:.1e}: {scene}");
    }
}

/// A bead between preloaded springs: at small coordinates its second derivatives cancel, where accelerations and their
/// derivatives keep their digits.
#[test]
fn what_derivatives_alone_lose_is_said() {
    let scene = "coordinates(x, y), particle(mass = 1.1234, position = [x, y, 0]), \
                 spring(from = [-1.2345, 0, 0], to = [x, y, 0], stiffness = 12.345, length = 0.54321), \
                 spring(from = [1.2345, 0, 0], to = [x, y, 0], stiffness = 12.345, length = 0.54321)";
    for DerivativeLoss { loss, said, text } in losses_there(scene, &[], &[1e-8, 1e-8], &[0.1, 0.2]) {
        assert!(loss <= WITHIN * said.max(1.0), "{text} loses {loss:.1e}, and its kernel says {said:e}");
    }
}

/// The same with masses or μ that are fields: where functions lose most, their fields have unlike values, and
/// derivatives have states of their own.
#[test]
fn derivatives_keep_their_digits_whatever_the_fields_are() {
    let numbers = [("mu", 3.986004418e14), ("M", 1000.1), ("m", 1.234)];
    for names in [&["m"][..], &["M", "m"], &["mu"], &["mu", "M", "m"]] {
        let (fields, literals): (Vec<_>, Vec<_>) = numbers.iter().copied().partition(|(name, _)| names.contains(name));
        let written = |name: &str| {
            let literal = literals.iter().find(|(other, _)| *other == name);
            literal.map_or_else(|| name.to_owned(), |(_, number)| number.to_string())
        };
        let [mu, heavy, light] = numbers.map(|(name, _)| written(name));
        let scene = format!(
            "coordinates(x, y, z, u, v, w), central_gravity(mu = {mu}), particle(mass = {heavy}, position = [x, y, z]), \
             particle(mass = {light}, position = [x + u, y + v, z + w])"
        );
        let speeds = [0.1, 0.2, 0.3, 0.01, 0.02, 0.03];
        for DerivativeLoss { loss, text, .. } in
            losses_there(&scene, &fields, &[5e6, 4e6, 3e6, 0.006, 0.008, 0.0001], &speeds)
        {
            assert!(loss <= FEW, "{text} loses {loss:.1e}: {scene}");
        }
    }
}
