//! The arguments of every function of a kernel, and where the symbols of a program come from: these taken apart, the
//! fields of the kernel.

use proc_macro2::{Ident, Span, TokenStream};
use quote::{format_ident, quote};

use crate::algebra::{Expr, Map};
use crate::kernel::Program;
use crate::mechanics::{FrameQuantity, Method};
use crate::program::ArgumentKind;

/// An array of scalars and the symbols that its elements are.
pub struct ArrayArgument<'g> {
    pub array: TokenStream,
    pub symbols: Vec<Expr<'g>>,
}

/// `let` statements that name the elements which the program reads, and how each symbol is then written.
pub fn declare(
    program: &Program<'_>,
    arguments: &[ArrayArgument<'_>],
    names: &mut Map<u32, TokenStream>,
) -> TokenStream {
    let read = program.symbols();
    let mut statements = TokenStream::new();
    for (a, argument) in arguments.iter().enumerate() {
        if !argument.symbols.iter().any(|s| read.contains(s)) {
            continue;
        }
        let elements = argument.symbols.iter().enumerate().map(|(k, symbol)| {
            if !read.contains(symbol) {
                return quote!(_);
            }
            let name = format_ident!("__a{}_{}", a, k, span = Span::mixed_site());
            names.insert(symbol.key(), quote!(#name));
            quote!(#name)
        });
        let array = &argument.array;
        statements.extend(quote!(let [#(#elements),*] = #array;));
    }
    statements
}

/// The arguments that a method has after time and configuration.
pub fn arguments_of(method: Method) -> &'static [ArgumentKind] {
    use ArgumentKind::{Factors, Impulses, Inputs, Momenta, Residuals, Speeds, Twist};
    match method {
        Method::Acceleration
        | Method::ConfigurationRates
        | Method::Multipliers
        | Method::Powers
        | Method::ElementForces
        | Method::SuppliedPower
        | Method::NonlinearEffects
        | Method::Friction
        | Method::ImpulseDynamics => OF_EQUATIONS,
        Method::Kinematics
        | Method::Momentum
        | Method::KineticEnergy
        | Method::BodyTwist
        | Method::BodyMomentum
        | Method::VelocityResidual
        | Method::ComponentRates
        | Method::OfFrame(FrameQuantity::Twist | FrameQuantity::Bias | FrameQuantity::JacobianRate, _)
        | Method::Frames
        | Method::CentroidalMomentum
        | Method::CentroidalBias
        | Method::ContactRates => &[Speeds],
        Method::Velocity => &[Momenta],
        Method::MomentumRate => &[Momenta, Inputs],
        Method::GaussResidual
        | Method::ConstraintFunction
        | Method::OtherForces
        | Method::Reactions
        | Method::DrivingForces => OF_RESIDUAL,
        Method::Speeds => &[Twist],
        Method::PositionCorrection => &[Residuals],
        Method::VelocityCorrection => &[Speeds, Residuals],
        Method::ImpulseVelocities => &[Factors, Impulses],
        Method::MassMatrix
        | Method::PotentialEnergy
        | Method::Pose
        | Method::PoseByConfiguration
        | Method::Regularity
        | Method::PositionResidual
        | Method::InertialParameters
        | Method::OfFrame(FrameQuantity::Pose | FrameQuantity::Jacobian, _)
        | Method::TotalMass
        | Method::CenterOfMass
        | Method::CentroidalMatrix
        | Method::GravityTorques
        | Method::Gaps
        | Method::ContactReactions
        | Method::ContactJacobian
        | Method::ContactFrames
        | Method::Restitution
        | Method::ImpulseResponse => &[],
    }
}

/// Arguments of the equations at a state: of `evaluate`, `linearize` and `by_parameters` as well.
pub const OF_EQUATIONS: &[ArgumentKind] = &[ArgumentKind::Speeds, ArgumentKind::Inputs];
/// Arguments of `gauss_residual` and its derivatives.
pub const OF_RESIDUAL: &[ArgumentKind] = &[ArgumentKind::Speeds, ArgumentKind::Accelerations, ArgumentKind::Inputs];
/// Arguments of `hessian`.
pub const OF_HESSIAN: &[ArgumentKind] = &[ArgumentKind::Speeds, ArgumentKind::Inputs, ArgumentKind::Weights];
/// Arguments of `regressor`.
pub const OF_REGRESSOR: &[ArgumentKind] = &[ArgumentKind::Speeds, ArgumentKind::Accelerations];

/// `__z: &Self::Speeds`, …: as methods declare them.
pub fn declared(private: &TokenStream, kinds: &[ArgumentKind]) -> Vec<TokenStream> {
    let one = |kind: &ArgumentKind| {
        let (name, ty) = (variable(*kind), argument_type(private, *kind));
        quote!(#name: #ty)
    };
    kinds.iter().map(one).collect()
}

/// Name of an argument in generated code.
pub fn variable(kind: ArgumentKind) -> Ident {
    let name = match kind {
        ArgumentKind::Parameters => "__parameters",
        ArgumentKind::Constants => "self",
        ArgumentKind::Time => "__t",
        ArgumentKind::Configuration => "__q",
        ArgumentKind::Speeds => "__z",
        ArgumentKind::Momenta => "__p",
        ArgumentKind::Accelerations => "__acceleration",
        ArgumentKind::Twist => "__twist",
        ArgumentKind::Residuals => "__residual",
        ArgumentKind::Factors => "__factors",
        ArgumentKind::Impulses => "__impulses",
        ArgumentKind::Inputs => "__input",
        ArgumentKind::Weights => "__weights",
    };
    Ident::new(name, Span::call_site())
}

fn argument_type(private: &TokenStream, kind: ArgumentKind) -> TokenStream {
    match kind {
        ArgumentKind::Parameters | ArgumentKind::Constants => quote!(&Self),
        ArgumentKind::Time => quote!(Self::Scalar),
        ArgumentKind::Configuration => quote!(&Self::Configuration),
        ArgumentKind::Speeds | ArgumentKind::Momenta | ArgumentKind::Accelerations => quote!(&Self::Speeds),
        ArgumentKind::Twist => quote!(&#private::SVector<Self::Scalar, 6>),
        ArgumentKind::Residuals => quote!(&Self::Multipliers),
        ArgumentKind::Factors => quote!(&Self::ImpulseFactors),
        ArgumentKind::Impulses => quote!(&Self::ContactRows),
        ArgumentKind::Inputs => quote!(&Self::Input),
        ArgumentKind::Weights => {
            quote!(&<Self::Linearization as #private::LinearModel<Self::Scalar>>::Vector)
        }
    }
}
