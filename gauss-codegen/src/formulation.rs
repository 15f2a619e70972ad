//! From a scene to formulas: the system, checked against the definition, and all methods that are wanted.

use proc_macro2::Ident;

use crate::algebra::{Expr, Graph, Map, Notation, Substitution};
use crate::error::{Error, Result};
use crate::kernel::{DerivativeRequest, Differentiation};
use crate::mechanics::{
    Claims, Constraints, Coordinate, Elimination, Formula, Formulas, Hessian, InertialParameter, InertialParameters,
    InverseLinearization, Linearization, Method, Reactions, Readings, Regressor, System, SystemFault, check_reactions,
    check_system_against_definition, needless_constraints, rotation_of_quaternion,
};
use crate::methods::DerivativeKind;
use crate::mistakes::{
    eliminate, failed, not_linear, refuse_contacts, refuse_curved_kinematics, refuse_exhausted, refuse_idle_speeds,
    system_faults,
};
use crate::terms::{self, OptionalMethod};
use crate::translate::{FieldNumber, Provenance, Translated};

/// A system with its formulas.
pub struct Formulation<'g> {
    pub provenance: Provenance<'g>,
    pub system: System<'g>,
    /// Elimination by which its speeds were found, where constraints are solved for the others.
    pub elimination: Option<Elimination<'g>>,
    pub formulas: Formulas<'g>,
    /// The derivatives that are wanted.
    pub derivatives: Vec<DerivativeRequest<'g>>,
    /// λ of the second derivatives, where these are wanted.
    pub weights: Vec<Expr<'g>>,
    /// The parameters in which the forces of inertia are linear, where the regressor is wanted.
    pub inertial_parameters: Vec<InertialParameter<'g>>,
    /// The equations for people, as text and in LaTeX.
    pub printed: [PrintedEquations; 2],
    /// Components x, y, z, w of the unit quaternions behind rotations, one for each coordinate, and the entries of R in
    /// terms of them.
    pub quaternions: Vec<Option<[Expr<'g>; 4]>>,
    pub definitions: Map<u32, Expr<'g>>,
    /// Coordinates that are the components of one unit quaternion or of one unit vector.
    pub units: Vec<Vec<Expr<'g>>>,
}

impl<'g> Formulation<'g> {
    /// # Errors
    /// What only the derivation finds wrong with a system.
    pub fn of(translated: Translated<'g>) -> Result<Self> {
        let ReducedSystem { provenance, mut system, elimination, reactions } = ReducedSystem::of(translated)?;
        let (wanted_of, graph) = (&provenance.item.wanted, system.scene.graph);
        refuse_contacts(&provenance, &system)?;
        let printed = printed(&mut system, &provenance.readings, elimination.as_ref());
        refuse_exhausted(&provenance.item, graph)?;
        let mut formulas = system.formulas();
        refuse_exhausted(&provenance.item, graph)?;
        check_system_against_definition(&system, &Claims::of(&formulas))
            .map_err(|faults| system_faults(&provenance, &system, &faults))?;
        formulas.extend(system.configuration_rates());
        formulas.extend(system.formulas_by_coordinates().into_iter().flatten());
        if let Some(elimination) = &elimination {
            formulas.acceleration.extend(elimination.accelerations());
            formulas.extend(elimination.formulas());
        }
        let (quaternions, definitions) = system_rotations(system.scene.graph, &system);
        let (mut derivatives, weights) = derivatives(wanted_of, &system, &formulas, &provenance.parameters);
        let clause = wanted_of.regressor.as_ref();
        let regressor = clause.map(|clause| regressor(clause, &system, &provenance.parameters)).transpose()?;
        if wanted_of.taylor.is_some() {
            formulas.extend([system.component_rates(&quaternions, &formulas.acceleration)]);
        }
        formulas.extend(system.frame_formulas(&provenance.frames));
        for method in &wanted_of.methods {
            match method {
                OptionalMethod::Centroidal => formulas.extend(system.centroidal_formulas()),
                OptionalMethod::NonlinearEffects => {
                    formulas.extend([system.nonlinear_effects(&formulas.gauss_residual)])
                }
                OptionalMethod::GravityTorques => formulas.extend([system.gravity_torques()]),
                OptionalMethod::JacobianRates => formulas.extend(system.jacobian_rates(&provenance.frames)),
            }
        }
        if let Some(reactions) = reactions {
            formulas.extend(reactions_of(&reactions, (&provenance, &system), elimination.as_ref(), &formulas)?);
        }
        let mut inertial_parameters = Vec::new();
        if let Some(Regressor { differentiated, formulas: of_regressor, parameters }) = regressor {
            formulas.extend(of_regressor);
            derivatives.push(wanted(DerivativeKind::Regressor, Differentiation::Alone(differentiated)));
            inertial_parameters = parameters;
        }
        derivatives.sort_by_key(|derivative| derivative.kind);
        let units = units_of(&system, &quaternions);
        Ok(Self {
            provenance,
            system,
            elimination,
            formulas,
            derivatives,
            weights,
            inertial_parameters,
            printed,
            quaternions,
            definitions,
            units,
        })
    }

    /// Adds forms of the accelerations that are long and keep the digits of light links beside heavy ones; false where
    /// there are none, or where masses are fields: whoever has ordinary ones does not pay for others.
    ///
    /// # Errors
    /// Mistakes of this crate.
    pub fn with_squares(&mut self) -> Result<bool> {
        let literals = &self.provenance.literals;
        let is_known =
            |mass: &Expr<'g>| mass.as_number().is_some() || literals.iter().any(|(_, literal)| literal == mass);
        if self.elimination.is_some() || !self.system.scene.tree.masses().all(|mass| is_known(&mass)) {
            return Ok(false);
        }
        let arrangements = self.system.accelerations_by_squares();
        if arrangements.is_empty() {
            return Ok(false);
        }
        let claims = Claims { accelerations: &arrangements, ..Claims::default() };
        check_system_against_definition(&self.system, &claims)
            .map_err(|faults| system_faults(&self.provenance, &self.system, &faults))?;
        self.formulas.acceleration.extend(arrangements);
        Ok(true)
    }

    /// The constraints, those among them that were solved too.
    pub fn constraints(&self) -> &Constraints<'g> {
        &self.elimination.as_ref().map_or(&self.system, |elimination| &elimination.whole).constraints
    }

    /// Whether a run can drift away from the constraints.
    pub fn can_drift(&self) -> bool {
        self.elimination.as_ref().map_or(!self.system.constraints.is_empty(), Elimination::can_drift)
    }
}

/// Reactions of joints and driving forces, held to the definition.
fn reactions_of<'g>(
    reactions: &Reactions<'g>,
    (provenance, system): (&Provenance<'g>, &System<'g>),
    elimination: Option<&Elimination<'g>>,
    formulas: &Formulas<'g>,
) -> Result<Vec<Formula<'g>>> {
    check_reactions(reactions)
        .map_err(|found| system_faults(provenance, system, &[SystemFault::Disagreement(found)]))?;
    let none = Vec::new();
    let multipliers = formulas.get(Method::Multipliers).unwrap_or(&none);
    let constraints = multipliers.first().map_or(0, Vec::len);
    if !reactions.has([constraints, system.contacts.rates.len()]) {
        return Err(failed(provenance, system, &"joints that are let go have other constraints or contacts"));
    }
    let formulas = reactions.formulas(multipliers, elimination.map(|elimination| (elimination, system)));
    Ok(formulas.into_iter().chain(reactions.of_contacts()).collect())
}

/// Whatever is derived from the system as it is, and λ.
fn derivatives<'g>(
    wanted_of: &terms::KernelOptions,
    system: &System<'g>,
    formulas: &Formulas<'g>,
    parameters: &[FieldNumber<'g>],
) -> (Vec<DerivativeRequest<'g>>, Vec<Expr<'g>>) {
    let linearization = wanted_of.linearize.is_some().then(|| Linearization::new(system, formulas));
    let inverse = wanted_of.inverse.then(|| InverseLinearization::new(system, formulas));
    let hessian = wanted_of.hessian.then(|| Hessian::new(system, formulas));
    let mut derivatives = Vec::new();
    if let Some(linearization) = linearization {
        let symbols = || parameters.iter().map(|parameter| parameter.symbol).collect();
        let by_parameters = wanted_of.by_parameters.then(|| linearization.by_parameters(system, symbols()));
        let by_state = Differentiation::WithValues(linearization.differentiated);
        derivatives.push(wanted(DerivativeKind::ByState, by_state));
        derivatives.extend(
            by_parameters.map(|by_parameters| {
                wanted(DerivativeKind::ByParameters, Differentiation::ByParameters(by_parameters))
            }),
        );
    }
    derivatives.extend(
        inverse.map(|inverse| wanted(DerivativeKind::OfInverse, Differentiation::WithValues(inverse.differentiated))),
    );
    let mut weights = Vec::new();
    if let Some(Hessian { curved, weights: of_hessian }) = hessian {
        derivatives.push(wanted(DerivativeKind::Hessian, Differentiation::Twice(curved)));
        weights = of_hessian;
    }
    (derivatives, weights)
}

fn wanted<'g>(kind: DerivativeKind, differentiation: Differentiation<'g>) -> DerivativeRequest<'g> {
    DerivativeRequest { kind, differentiation }
}

/// The forces of inertia as a linear function of inertial parameters.
fn regressor<'g>(clause: &Ident, system: &System<'g>, parameters: &[FieldNumber<'g>]) -> Result<Regressor<'g>> {
    if system.scene.matter_time.is_some() {
        let message = "masses that vary are no parameters, and what matter that leaves does depends on them, too; remove \
                       `regressor`, or the time from mass data";
        return Err(Error::new(clause.span(), message));
    }
    let names = names_of(parameters);
    let inertial = InertialParameters::new(system, &names);
    // The system once more, of bodies by their first moments.
    let other = system.scene.of_bodies(|body| inertial.by_first_moment(body));
    let residuals = System::new(other).inertial_residuals();
    let regressor = inertial.regressor(&residuals, &system.element_forces(), system.defined());
    regressor.map_err(|mass| not_linear(clause, &mass))
}

/// Headings, each with its lines.
pub type PrintedEquations = Vec<(String, Vec<String>)>;

/// The equations as text and in LaTeX, before anything else is made of the system, and nothing is left of it: in which
/// order the terms of a sum come depends on what was made before, and what is multiplied out on how much. So what is
/// printed depends on the scene alone, and what is derived not on printing.
fn printed<'g>(
    system: &mut System<'g>,
    readings: &Readings<'g>,
    elimination: Option<&Elimination<'g>>,
) -> [PrintedEquations; 2] {
    system.forget();
    let printed = system.scene.graph.aside(|| {
        let replacement = elimination.map(|elimination| Substitution::new(elimination.replacement()));
        let page = system.equations(readings, replacement.as_ref());
        [Notation::Text, Notation::Latex].map(|notation| page.print(notation))
    });
    system.forget();
    printed
}

/// A system with the speeds that are left.
struct ReducedSystem<'g> {
    provenance: Provenance<'g>,
    system: System<'g>,
    elimination: Option<Elimination<'g>>,
    reactions: Option<Reactions<'g>>,
}

impl<'g> ReducedSystem<'g> {
    fn of(Translated { scene, let_go, mut provenance }: Translated<'g>) -> Result<Self> {
        refuse_exhausted(&provenance.item, scene.graph)?;
        refuse_curved_kinematics(&provenance, &scene)?;
        let mut whole = System::new(scene);
        refuse_exhausted(&provenance.item, whole.scene.graph)?;
        let needless = leave_out_needless(&provenance, &mut whole);
        let reactions = let_go.map(|mut let_go| {
            let_go.leave_out(&needless);
            Reactions::new(let_go)
        });
        refuse_idle_speeds(&provenance, &whole)?;
        let Some(independent) = &provenance.independent else {
            return Ok(Self { provenance, system: whole, elimination: None, reactions });
        };
        let elimination = eliminate(&provenance.constraints, whole, independent)?;
        let system = System::new(elimination.reduced());
        provenance.substitute(&Substitution::new(elimination.replacement()));
        Ok(Self { provenance, system, elimination: Some(elimination), reactions })
    }
}

/// Components of vectors that follow from others, and what a file says twice: nobody has written those one by one.
/// Gives back their numbers.
fn leave_out_needless<'g>(provenance: &Provenance<'g>, system: &mut System<'g>) -> Vec<usize> {
    let together =
        |clause: usize| provenance.constraints[clause].is_vector || provenance.constraints[clause].in_file.is_some();
    if system.scene.constraints.iter().any(|constraint| together(constraint.clause)) {
        let mut needless = system.scene.graph.aside(|| needless_constraints(system, &provenance.literals));
        // Constraints that share forces stay, but for those that no motion changes.
        let shares = |k: usize| system.scene.redundant && system.constraints.jacobian[k].iter().any(|e| !e.is_zero());
        needless.retain(|&k| together(system.scene.constraints[k].clause) && !shares(k));
        if !needless.is_empty() {
            system.leave_out(&needless);
        }
        return needless;
    }
    Vec::new()
}

/// Names of the numbers of fields, by their symbols.
fn names_of(parameters: &[FieldNumber<'_>]) -> Map<u32, String> {
    parameters.iter().map(|parameter| (parameter.symbol.key(), parameter.name.clone())).collect()
}

/// Quaternions behind the rotations among the coordinates, and the entries of R in terms of them; the time for the
/// instant of mass data.
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
    let coordinates = coordinates.collect();
    definitions.extend(system.scene.matter_time.map(|instant| (instant.key(), system.scene.time)));
    (coordinates, definitions)
}

/// Coordinates that are the components of one unit quaternion, or of one unit vector of the plane.
fn units_of<'g>(system: &System<'g>, quaternions: &[Option<[Expr<'g>; 4]>]) -> Vec<Vec<Expr<'g>>> {
    let angle = |coordinate: &Coordinate<'g>| match coordinate {
        Coordinate::Plane { turn, .. } => Some(turn.to_vec()),
        _ => None,
    };
    let angles = system.scene.coordinates.iter().filter_map(angle);
    quaternions.iter().flatten().map(|q| q.to_vec()).chain(angles).collect()
}
