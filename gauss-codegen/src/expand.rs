//! The pipeline on one screen: parse → derive → check → lower → emit.

use proc_macro2::TokenStream;
use syn::DeriveInput;

use crate::algebra::{Expr, Graph, Map, Rational};
use crate::emit::{Derived, Equations, Plain, Subject, SystemSubject, emit};
use crate::kernel::{Aim, Candidates, Derivatives, Kernel, Literals, Miscompiled};
use crate::mechanics::{
    Acting, ConfigurationKind, Coordinate, Elimination, Formula, InertialParameters, Linearization, Method, Regressor,
    Scene, System, check_against_definition, check_system_against_definition, rotation_of_quaternion,
};
use crate::mistakes::{
    bug, eliminate, refuse_curved_kinematics, refuse_idle_speeds, refuse_regressor, refuse_series, refuse_too_much,
    system_faults,
};
use crate::model::{self, InChart, Model, Wanted};
use crate::translate::{Parameter, Translator, body_shape, parameters_of_body, parameters_of_system};

/// Expands one struct.
///
/// # Errors
/// Every mistake of the struct, each at the token that is wrong.
pub fn expand(input: &DeriveInput) -> syn::Result<TokenStream> {
    derive(input, |derived| Ok(emit(derived, &Equations::of(derived))))
}

/// Derives one struct, and hands everything that is known of it to whoever writes it down.
pub fn derive<R>(input: &DeriveInput, write: impl FnOnce(&Derived<'_, '_>) -> syn::Result<R>) -> syn::Result<R> {
    let model = model::parse(input)?;
    match model.one_body() {
        Some(in_chart) => derive_body(&model, in_chart, write),
        None => derive_system(&model, write),
    }
}

fn derive_body<R>(
    model: &Model,
    in_chart: InChart,
    write: impl FnOnce(&Derived<'_, '_>) -> syn::Result<R>,
) -> syn::Result<R> {
    let graph = Graph::new();
    let shape = body_shape(|role| model.shape(role));
    let mut translator = model.has_expressions().then(|| Translator::new(&graph, model, true)).transpose()?;
    let assigned = translator.as_ref().map_or(Ok(Vec::new()), |translator| translator.assigned(&model.given))?;
    let mut scene = Scene::new(&graph, in_chart.motion, in_chart.chart, shape, &assigned);
    if let Some(translator) = translator.as_mut().filter(|_| model.is_acted_upon()) {
        let (observed, elements) = translator.on_one_body()?;
        let parameters = translator.parameters_of(&scene.body);
        let inputs = translator.inputs().to_vec();
        let acting = Acting::new(&observed, &scene.kinematics, &parameters, &elements, inputs);
        scene = scene.acted_upon(acting);
    }
    translator.as_ref().map_or(Ok(()), Translator::refuse_mistakes)?;
    let mut formulas = scene.formulas();
    check_against_definition(&scene, &formulas).map_err(|error| bug(&model.ident, &error))?;
    let (quaternion, rotation) = rotation_entries(&graph, &scene);
    let linearization = model.wanted.linearize.then(|| Linearization::of_body(&scene, &formulas));
    let parameters = parameters_of_body(model, &scene.body, translator.as_ref().map_or(&[], Translator::sources));
    let names = names_of(&parameters);
    let regressor = model.wanted.regressor.as_ref().map(|_| {
        let inertial = InertialParameters::of_body(&scene.body, &names);
        let residuals = scene.inertial_residuals(&inertial.by_first_moment(&scene.body));
        inertial.regressor(&residuals, &scene.load_forces(), scene.defined())
    });
    if model.wanted.taylor.is_some() {
        formulas.push(scene.component_rates(quaternion, &formulas));
    }
    formulas.extend(regressor.iter().flat_map(|regressor| regressor.formulas.clone()));
    let units = match scene.kinematics.kind {
        ConfigurationKind::PlanePose => vec![scene.kinematics.configuration[..2].to_vec()],
        _ => quaternion.map(|q| q.to_vec()).into_iter().collect(),
    };
    let beside = Beside { wanted: &model.wanted, linearization, regressor, parameters, units };
    let literals = translator.as_ref().map(Translator::literals).unwrap_or_default();
    let folded = foldable(&model.scalar, &literals);
    let kernel = beside.lower(&graph, &formulas, &rotation, folded).map_err(|error| bug(&model.ident, &error))?;
    if graph.is_undefined() {
        return Err(bug(&model.ident, &"the equations divide by zero"));
    }
    refuse_too_much(model, &kernel)?;
    refuse_regressor(model.wanted.regressor.as_ref(), beside.regressor.as_ref(), &kernel)?;
    refuse_series(model.wanted.taylor.as_ref(), !model.inputs.is_empty(), &formulas, &kernel)?;
    let plain = translator.as_ref().map(|translator| Plain {
        fields: &model.fields,
        sources: translator.sources(),
        literals: &literals,
        assigned: &assigned,
    });
    write(&Derived {
        subject: Subject::Body { model, in_chart, scene: &scene, quaternion, plain },
        drags: &translator.as_ref().map(Translator::drags).unwrap_or_default(),
        formulas: &formulas,
        kernel: &kernel,
        linearization: beside.linearization.as_ref(),
        parameters: &beside.parameters,
        regressor: beside.regressor.as_ref(),
    })
}

fn derive_system<R>(model: &Model, write: impl FnOnce(&Derived<'_, '_>) -> syn::Result<R>) -> syn::Result<R> {
    let graph = Graph::new();
    let mut translator = Translator::new(&graph, model, false)?;
    let all: Vec<usize> = (0..translator.speeds().len()).collect();
    let speeds = translator.speeds().to_vec();
    let scene = translator.scene(&speeds, &all)?;
    translator.refuse_mistakes()?;
    refuse_curved_kinematics(model, &scene)?;
    let whole = System::new(scene);
    refuse_idle_speeds(model, &translator, &whole)?;
    let (system, elimination) = match &model.independent {
        Some(independent) => {
            let elimination = eliminate(model, &translator, whole, independent)?;
            let kept = translator.indices_of_speeds(independent);
            let mut scene = translator.scene(&elimination.values, &kept)?;
            scene.constraints.clear();
            (System::new(scene), Some(elimination))
        }
        None => (whole, None),
    };
    let mut formulas = system.formulas();
    check_system_against_definition(&system, &formulas)
        .map_err(|faults| system_faults(model, &translator, &system, &faults))?;
    formulas.extend(elimination.iter().flat_map(Elimination::formulas));
    let (quaternions, definitions) = system_rotations(&graph, &system);
    let linearization = model.wanted.linearize.then(|| Linearization::of_system(&system, &formulas));
    let parameters = parameters_of_system(&model.fields, translator.sources());
    let names = names_of(&parameters);
    let speeds = match (&elimination, &model.independent) {
        (Some(elimination), Some(independent)) => {
            (elimination.values.clone(), translator.indices_of_speeds(independent))
        }
        _ => (speeds, all),
    };
    let regressor = match model.wanted.regressor {
        Some(_) => Some(regressor_of_system(&system, &mut translator, speeds, &names)?),
        None => None,
    };
    if model.wanted.taylor.is_some() {
        formulas.push(system.component_rates(&quaternions, &formulas));
    }
    formulas.extend(regressor.iter().flat_map(|regressor| regressor.formulas.clone()));
    let planes = system.scene.coordinates.iter().filter_map(|coordinate| match coordinate {
        Coordinate::Plane { turn, .. } => Some(turn.to_vec()),
        _ => None,
    });
    let units = quaternions.iter().flatten().map(|q| q.to_vec()).chain(planes).collect();
    let beside = Beside { wanted: &model.wanted, linearization, regressor, parameters, units };
    let literals = translator.literals();
    let folded = foldable(&model.scalar, &literals);
    let kernel = beside.lower(&graph, &formulas, &definitions, folded).map_err(|error| bug(&model.ident, &error))?;
    if graph.is_undefined() {
        return Err(bug(&model.ident, &"the equations divide by zero"));
    }
    refuse_too_much(model, &kernel)?;
    refuse_regressor(model.wanted.regressor.as_ref(), beside.regressor.as_ref(), &kernel)?;
    refuse_series(model.wanted.taylor.as_ref(), !model.inputs.is_empty(), &formulas, &kernel)?;
    let constrained = elimination.as_ref().map_or(&system, |elimination| &elimination.whole);
    let assigned_to_bodies =
        model.bodies.iter().map(|body| translator.assigned(&body.given)).collect::<syn::Result<Vec<_>>>()?;
    let subject = SystemSubject {
        model,
        system: &system,
        constraints: &constrained.constraints,
        can_drift: elimination.as_ref().map_or(!system.constraints.is_empty(), Elimination::can_drift),
        sources: translator.sources(),
        literals: &literals,
        assigned: &translator.assigned(&model.given)?,
        assigned_to_bodies: &assigned_to_bodies,
        links: &translator.links_of_clauses(),
        quaternions: &quaternions,
    };
    let drags = translator.drags();
    write(&Derived {
        subject: Subject::System(subject),
        drags: &drags,
        formulas: &formulas,
        kernel: &kernel,
        linearization: beside.linearization.as_ref(),
        parameters: &beside.parameters,
        regressor: beside.regressor.as_ref(),
    })
}

/// Literals that are numbers when the code is generated: of a generic scalar it is not known how it rounds them.
fn foldable<'a, 'g>(scalar: &model::Scalar, literals: &'a [(Rational, Expr<'g>)]) -> Literals<'a, 'g> {
    (!matches!(scalar, model::Scalar::Parameter(_))).then_some(literals)
}

/// What `evaluate` computes together.
fn joined(formulas: &[Formula<'_>]) -> Vec<usize> {
    let of = |method: &Method| formulas.iter().position(|formula| formula.method == *method);
    Method::EVALUATED.iter().filter_map(of).collect()
}

/// What is derived beside the methods.
struct Beside<'a, 'g> {
    wanted: &'a Wanted,
    linearization: Option<Linearization<'g>>,
    regressor: Option<Regressor<'g>>,
    parameters: Vec<Parameter<'g>>,
    /// Coordinates that are the components of one unit quaternion or of one unit vector.
    units: Vec<Vec<Expr<'g>>>,
}

impl<'g> Beside<'_, 'g> {
    fn lower(
        &self,
        graph: &'g Graph,
        formulas: &[Formula<'g>],
        definitions: &Map<u32, Expr<'g>>,
        literals: Literals<'_, 'g>,
    ) -> Result<Kernel<'g>, Miscompiled> {
        let functions: Vec<_> = formulas.iter().map(candidates).collect();
        let parameters: Vec<Expr<'g>> = self.parameters.iter().map(|parameter| parameter.symbol).collect();
        let by_state = self.linearization.as_ref();
        let by_parameters = by_state.filter(|_| self.wanted.by_parameters);
        let wanted = Derivatives {
            by_state: by_state.map(|l| &l.differentiated),
            units: if by_parameters.is_some() { &self.units } else { &[] },
            by_parameters: by_parameters.map(|linearization| linearization.by_parameters(formulas, &parameters)),
            regressor: self.regressor.as_ref().map(|r| &r.differentiated),
        };
        Kernel::lower(graph, &functions, &joined(formulas), definitions, &wanted, literals)
    }
}

/// From the system once more, of bodies by their first moments.
fn regressor_of_system<'g>(
    system: &System<'g>,
    translator: &mut Translator<'_, 'g>,
    (values, kept): (Vec<Expr<'g>>, Vec<usize>),
    names: &Map<u32, String>,
) -> syn::Result<Regressor<'g>> {
    let inertial = InertialParameters::of_system(system, names);
    let by_first_moments = translator.scene_of(|body| inertial.by_first_moment(body), &values, &kept)?;
    let residuals = System::new(by_first_moments).inertial_residuals();
    Ok(inertial.regressor(&residuals, &system.element_forces(), system.defined()))
}

/// What the numbers of fields are called, by their symbols.
fn names_of(parameters: &[Parameter<'_>]) -> Map<u32, String> {
    parameters.iter().map(|parameter| (parameter.symbol.key(), parameter.name.clone())).collect()
}

/// What a formula is lowered from.
fn candidates<'g>(formula: &Formula<'g>) -> Candidates<'g> {
    let aim = if formula.method == Method::ComponentRates { Aim::Series } else { Aim::Values };
    Candidates { arrangements: formula.arrangements.clone(), aim }
}

/// Quaternions behind the rotations among the coordinates, and the entries of R in terms of them.
fn system_rotations<'g>(graph: &'g Graph, system: &System<'g>) -> (Vec<Option<[Expr<'g>; 4]>>, Map<u32, Expr<'g>>) {
    let mut definitions = Map::default();
    let coordinates = system.scene.coordinates.iter().map(|coordinate| {
        let matrix = coordinate.rotation()?;
        let quaternion = ["x", "y", "z", "w"].map(|name| graph.symbol(name, name, false));
        let entries = rotation_of_quaternion(graph, quaternion);
        let symbols = matrix.iter().flatten().map(|symbol| symbol.key());
        definitions.extend(symbols.zip(entries.into_iter().flatten().map(Expr::group)));
        Some(quaternion)
    });
    (coordinates.collect(), definitions)
}

/// Entries of R that are coordinates are stored as a unit quaternion: its components, and the entries in terms of them.
fn rotation_entries<'g>(graph: &'g Graph, scene: &Scene<'g>) -> (Option<[Expr<'g>; 4]>, Map<u32, Expr<'g>>) {
    let kinematics = &scene.kinematics;
    if !matches!(kinematics.kind, ConfigurationKind::Pose | ConfigurationKind::Rotation) {
        return (None, Map::default());
    }
    let quaternion = ["x", "y", "z", "w"].map(|name| graph.symbol(name, name, false));
    let entries = rotation_of_quaternion(graph, quaternion);
    let symbols = kinematics.configuration.iter().map(|symbol| symbol.key());
    (Some(quaternion), symbols.zip(entries.into_iter().flatten().map(Expr::group)).collect())
}
