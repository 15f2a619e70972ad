//! The scene of a model.

use gauss_jit::{KernelError, Model, Quantity, kept, kept_axes};

use super::rows::Plans;
use crate::description::{Description, Field, Part, Remark, Shape};
use crate::kernels::Violation;
use crate::methods::Sizes;

/// A model with its names.
pub struct LoadedScene {
    pub(super) model: Model,
    pub(super) description: Description,
    pub(super) sizes: Sizes,
    pub(super) names: [Vec<&'static str>; 2],
    pub(super) frames: Vec<&'static str>,
    pub(super) joints: Vec<&'static str>,
    pub(super) motions: Vec<&'static str>,
    pub(super) parameters: Vec<&'static str>,
    pub(super) plans: Plans,
}

/// The parts of a body among the names of parameters.
const BODY: [&str; 3] = [".mass", ".center_of_mass", ".inertia"];

/// The fields of the struct: a body is three parameters.
fn fields(model: &Model) -> Vec<Field> {
    let mut fields = Vec::new();
    for own in model.parameters() {
        let (name, shape) = match BODY.iter().find_map(|part| own.name.strip_suffix(part).map(|name| (name, *part))) {
            Some((name, ".mass")) => (name, Shape::Body),
            Some(_) => continue,
            None => (own.name.as_str(), Shape::Array(kept_axes(&own.axes))),
        };
        let unit = own.unit.as_deref().unwrap_or_default();
        let (name, unit, documentation) = (kept(name), kept(unit), kept(&own.documentation));
        fields.push(Field { name, unit, documentation, shape });
    }
    fields
}

fn part(own: &Quantity) -> Part {
    let (name, label) = (kept(&own.name), kept(&own.label));
    Part { name, size: own.numbers.len(), unit: own.kind.unit_components(), label }
}

impl LoadedScene {
    /// The scene of a model, with all its methods.
    pub fn new(model: Model) -> Self {
        let own = model.description();
        let parts = |list: &[Quantity]| list.iter().map(part).collect::<Vec<_>>();
        let all = |list: &[String]| list.iter().map(|name| kept(name)).collect::<Vec<_>>();
        let remark = |remark: &gauss_jit::Remark| Remark { text: kept(&remark.text), ignored: remark.ignored };
        let description = Description {
            name: kept(model.name()),
            documentation: kept(&own.documentation),
            fields: fields(&model),
            coordinates: parts(&own.coordinates),
            speeds: parts(&own.speeds),
            inputs: parts(&own.inputs),
            remarks: own.remarks.iter().map(remark).collect(),
        };
        let numbers = |list: &[Quantity]| list.iter().flat_map(|own| all(&own.numbers)).collect::<Vec<_>>();
        // Scalars are behind all others.
        let (scalars, groups): (Vec<Quantity>, Vec<Quantity>) =
            own.coordinates.iter().cloned().partition(|own| own.numbers.len() == 1);
        let names = [numbers(&[groups, scalars].concat()), numbers(&own.speeds)];
        let (frames, joints, motions) = (all(&own.frames), all(&own.joints), all(&own.motions));
        let has_parameters = model.methods().any(|name| name == "by_parameters");
        let parameters = if has_parameters { all(model.parameter_names()) } else { Vec::new() };
        let count = |method: &str| {
            let results = model.results(method).unwrap_or_default();
            results.iter().map(|result| result.rows * result.columns).sum()
        };
        let sizes = Sizes {
            configuration: names[0].len(),
            increment: count("kinematics"),
            speeds: names[1].len(),
            input: description.input_size(),
            multipliers: count("multipliers"),
            motions: motions.len(),
            parameters: parameters.len(),
        };
        let plans = Plans::of(&model, &frames, &joints);
        Self { model, description, sizes, names, frames, joints, motions, parameters, plans }
    }

    /// The kernel with these numbers of all fields.
    pub(super) fn of_numbers(&self, numbers: &[f64]) -> Result<gauss_jit::Kernel, Vec<Violation>> {
        let mut rest = numbers;
        let list = self.model.parameters().iter().map(|parameter| {
            let (own, others) = rest.split_at(parameter.count.min(rest.len()));
            rest = others;
            (parameter.name.as_str(), own)
        });
        self.model.kernel(&list.collect::<Vec<_>>()).map_err(|error| match &error {
            KernelError::Parameters(error) => Violation::all(error),
            other => vec![Violation {
                field: self.description.name.to_owned(),
                value: f64::NAN,
                rule: "Given".to_owned(),
                message: other.to_string(),
            }],
        })
    }
}
