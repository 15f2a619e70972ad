//! A scene as the user wrote it, checked: coordinates and speeds, or the chart of a body; bodies, particles,
//! constraints and forces.

use super::charts::InChart;
use super::clauses::{
    BodyClause, Coefficients, ConstraintClause, Coordinate, FunctionClause, InputName, ParticleClause, PointClause,
    RoleClause, RoleValue, Speed, SpeedPart,
};
use super::described::Described;
use super::expression::Expression;
use super::forces::ForceClause;
use super::roles::{Role, Shape};
use proc_macro2::TokenStream;
use quote::quote;
use syn::ext::IdentExt;
use syn::{Generics, Ident, Path, Type, Visibility};

/// Any system that the Gauss condition covers.
#[derive(Clone)]
pub struct Model {
    /// Name of the struct.
    pub ident: Ident,
    /// Visibility of the struct; the kernel gets the same.
    pub visibility: Visibility,
    /// Generics of the struct: type parameters only.
    pub generics: Generics,
    /// The one scalar of every field with a role and of every field that an expression names; `f64` if there are none.
    pub scalar: Scalar,
    /// Where the generated code finds the runtime: `::gauss_runtime`, or the path of `crate = path`.
    pub runtime: Path,
    /// The methods and derivatives to generate besides the equations.
    pub wanted: Wanted,
    /// Every field of the struct, in order.
    pub fields: Vec<Field>,
    /// The chart and the motion of the body without a name, which is then among [`bodies`](Self::bodies) without a
    /// place: the first coordinates, speeds and components of ψ are those of its chart.
    pub in_chart: Option<InChart>,
    /// The coordinates q, in order; in a chart, those after the chart's.
    pub coordinates: Vec<Coordinate>,
    /// The speeds z, in order; `None` for the rates of the coordinates: ẋ of a scalar, ω (body axes) of a rotation, the
    /// twist (u, ω) (body axes, pole O) of a pose.
    pub speeds: Option<Vec<Speed>>,
    /// q̇ = ψ(t, q, z) of (3.2): one for each coordinate, in the order of the coordinates; empty without speeds. A
    /// scalar for a scalar, ω in body axes for a rotation, a call of [`Twist`](super::FunctionName::Twist) for a pose.
    pub kinematics: Vec<(Ident, Expression)>,
    /// The bodies and frames, in the order in which they are written: a parent may come after its child.
    pub bodies: Vec<BodyClause>,
    /// The particles of (3.3).
    pub particles: Vec<ParticleClause>,
    /// Named points of bodies and frames.
    pub points: Vec<PointClause>,
    /// What is further required of the motion.
    pub constraints: Vec<ConstraintClause>,
    /// The speeds that stay when the constraints are solved for the others at compile time; `None`: multipliers.
    pub independent: Option<Vec<SpeedPart>>,
    /// The most operations that the generated code may have; `None`: the limit of the derive.
    pub limit: Option<usize>,
    /// The potential energy besides that of gravity: a scalar of t and q.
    pub potential: Option<Expression>,
    /// Values that arrive at run time, in order.
    pub inputs: Vec<InputName>,
    /// Mass data of the only body without a name, and gravity, where they are no fields.
    pub role_clauses: Vec<RoleClause>,
    /// The velocity of the medium: a vector of t, fields and numbers, observer axes; `None`: at rest.
    pub medium: Option<Expression>,
    /// Central gravity: each acts on every body and every particle.
    pub attractions: Vec<ForceClause>,
    /// What acts besides gravity and the potential, in the order in which it is written.
    pub forces: Vec<ForceClause>,
    /// Inertia of the rates of scalar coordinates: a scalar of fields and numbers for each.
    pub armatures: Vec<(Ident, Expression)>,
    /// Functions of one number that the user gives.
    pub functions: Vec<FunctionClause>,
    /// Bodies whose principal moments need not obey the triangle inequality; `None`: all of them.
    pub formal: Vec<Option<Ident>>,
    /// The file that describes the robot, whose clauses come before those of the struct.
    pub described: Option<Described>,
}

/// Type parameters of the struct, as an `impl` writes them.
pub struct GenericsOfImpl {
    /// Behind `impl`.
    pub declared: TokenStream,
    /// Behind the name of the struct.
    pub used: TokenStream,
    /// Behind `where`, each with its comma.
    pub predicates: TokenStream,
}

impl Model {
    pub fn generics_of_impl(&self) -> GenericsOfImpl {
        let (declared, used, clause) = self.generics.split_for_impl();
        let predicates = clause.iter().flat_map(|clause| &clause.predicates);
        let predicates = quote!(#(#predicates,)*);
        GenericsOfImpl { declared: quote!(#declared), used: quote!(#used), predicates }
    }

    /// The field that plays a role.
    pub fn field(&self, role: Role) -> Option<&Field> {
        self.fields.iter().find(|field| field.role == Some(role))
    }

    /// The shape of the field or the clause that plays a role; `None` where neither does.
    pub fn shape(&self, role: Role) -> Option<Shape> {
        let clause = || self.role_clauses.iter().find(|clause| clause.role == role);
        self.field(role).map(|field| field.shape).or_else(|| clause().map(|clause| clause.shape))
    }

    /// One body in a chart, which nothing is attached to and nothing constrains.
    pub fn chart_of_all(&self) -> Option<InChart> {
        let alone = self.bodies.len() == 1
            && self.coordinates.is_empty()
            && self.particles.is_empty()
            && self.constraints.is_empty();
        self.in_chart.filter(|_| alone)
    }

    /// Something acts besides weight and buoyancy.
    pub fn is_acted_upon(&self) -> bool {
        let by_elements = !self.forces.is_empty() || !self.attractions.is_empty();
        by_elements || self.potential.is_some() || self.medium.is_some() || !self.inputs.is_empty()
    }

    /// Whether there is any expression, of forces or of mass data.
    pub fn has_expressions(&self) -> bool {
        self.is_acted_upon() || !self.role_clauses.is_empty() || !self.points.is_empty()
    }

    /// Whether the field is the added mass that some clause names.
    pub fn is_added_mass(&self, field: &Ident) -> bool {
        let all = self.role_clauses.iter().chain(self.bodies.iter().flat_map(|body| &body.role_clauses));
        let named = |clause: &RoleClause| matches!(&clause.value, RoleValue::Coefficients(Coefficients::Field(name)) if name == field);
        all.into_iter().any(named)
    }

    /// Whether the principal moments of the body of that name (the unnamed one) need not obey the triangle inequality.
    pub fn waives_triangle_inequality(&self, body: Option<&Ident>) -> bool {
        let same = |formal: &Ident| body.map_or_else(|| formal == "body", |body| body.unraw() == formal.unraw());
        self.formal.iter().any(|formal| formal.as_ref().is_none_or(same))
    }

    /// Whether the body is the one that moves in the chart of the model.
    pub fn is_in_chart(&self, body: &BodyClause) -> bool {
        self.in_chart.is_some() && body.name.is_none()
    }
}

/// One field of the struct.
#[derive(Clone)]
pub struct Field {
    /// Name of the field.
    pub ident: Ident,
    /// Its type.
    pub ty: Type,
    /// What the field means to the body without a name, or that it is one with a name; `None` for a plain parameter.
    pub role: Option<Role>,
    /// Shape of the value. A plain parameter whose scalar is not the scalar of the model is [`Shape::Other`].
    pub shape: Shape,
    /// The unit, if one is written.
    pub unit: Option<String>,
    /// Its doc comment, trimmed; empty when it has none.
    pub documentation: String,
}

/// The methods and derivatives that a kernel has on request.
#[derive(Clone, Default)]
pub struct Wanted {
    /// `taylor`, where it is written: power series of the motion.
    pub taylor: Option<Ident>,
    /// `linearize`: the derivatives of the equations by the state.
    pub linearize: bool,
    /// `linearize(parameters)`: by the parameters, too.
    pub by_parameters: bool,
    /// `linearize(inverse)`: those of inverse dynamics, too.
    pub inverse: bool,
    /// `linearize(hessian)`: second derivatives along given weights, too.
    pub hessian: bool,
    /// `regressor`, where it is written: the coefficients of the inertial parameters.
    pub regressor: Option<Ident>,
    /// `frames(…)`: bodies and frames whose poses and velocities are methods, by their names, each once.
    pub frames: Vec<Ident>,
    /// `methods(…)`: quantities of the system as a whole, each once.
    pub methods: Vec<WantedMethod>,
}

/// A method, or several that belong together, that a kernel has on request.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WantedMethod {
    /// Momenta about the centre of mass.
    Centroidal,
    /// Inverse dynamics at ż = 0.
    NonlinearEffects,
    /// The generalised forces that balance weight and buoyancy.
    GravityTorques,
    /// d/dt of the Jacobians of the frames in `frames(…)`.
    JacobianRates,
}

/// The number type that kernels compute with.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Scalar {
    /// `f32`.
    F32,
    /// `f64`.
    F64,
    /// A type parameter of the struct.
    Parameter(Ident),
}

impl std::fmt::Display for Scalar {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Scalar::F32 => formatter.write_str("f32"),
            Scalar::F64 => formatter.write_str("f64"),
            Scalar::Parameter(ident) => ident.fmt(formatter),
        }
    }
}
