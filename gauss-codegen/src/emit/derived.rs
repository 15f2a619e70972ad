//! Everything known about one derive when code is written, and what all implementations of traits are made with.

use proc_macro2::{Delimiter, Group, Ident, Span, TokenStream};
use quote::{ToTokens, format_ident, quote};

use crate::algebra::{Expr, Map, Rational, Set};
use crate::formulation::PrintedEquations;
use crate::kernel::{Counts, Kernel, LoweredFunction, Program, Smoothness};
use crate::lowering::Lowered;
use crate::mass_laws::MassLaws;
use crate::mechanics::{Account, InertialParameter, Method};
use crate::program::ArgumentKind;
use crate::terms::{Item, Scalar};
use crate::words::Unraw;

use crate::emit::dialect::arguments::{ArrayArgument, arguments_of, declare, declared, variable};
use crate::emit::dialect::limbs::LimbSymbols;
use crate::emit::dialect::packs::{PACKED, Packs, Sources};
use crate::emit::dialect::program::{ScalarTokens, statements};
use crate::emit::subject::Subject;

/// `__private_` and the version of this crate, which is that of the runtime.
pub const PRIVATE: &str = concat!(
    "__private_",
    env!("CARGO_PKG_VERSION_MAJOR"),
    "_",
    env!("CARGO_PKG_VERSION_MINOR"),
    "_",
    env!("CARGO_PKG_VERSION_PATCH")
);

/// Everything known about one derive when code is written.
pub struct Derived<'a, 'g> {
    pub subject: Subject<'a, 'g>,
    pub kernel: &'a Kernel<'g>,
    pub mass_laws: &'a MassLaws<'g>,
    /// λ of the second derivatives, where these are wanted.
    pub weights: &'a [Expr<'g>],
    /// The equations for people, as text and in LaTeX.
    pub printed: &'a [PrintedEquations; 2],
    /// The parameters in which the forces of inertia are linear, where the regressor is wanted.
    pub inertial_parameters: &'a [InertialParameter<'g>],
    /// Forms with vectors, where these are wanted and the scalar has some.
    vectors: Option<VectorForms<'g>>,
    /// Asked for by every method: see `private`, `arguments`.
    private: TokenStream,
    arguments: Vec<ArrayArgument<'g>>,
}

/// Methods that are written with vectors.
struct VectorForms<'g> {
    packs: Packs<'g>,
    /// Relation of symbols to limbs that are alike.
    limbs: LimbSymbols,
}

/// Type parameters of the kernel; nothing where the scalar is a type.
#[derive(Default)]
pub struct KernelGenerics {
    pub declared: TokenStream,
    pub bounded: TokenStream,
    pub used: TokenStream,
}

/// Symbols of the arguments of the methods.
pub struct ArgumentSymbols<'a, 'g> {
    pub speeds: &'a [Expr<'g>],
    pub speed_rates: &'a [Expr<'g>],
    pub momenta: &'a [Expr<'g>],
    pub twist: &'a [Expr<'g>],
    pub residuals: &'a [Expr<'g>],
    /// Only of long trees with contacts.
    pub factors: &'a [Expr<'g>],
    pub impulses: &'a [Expr<'g>],
    pub inputs: &'a [Expr<'g>],
    /// Only where second derivatives are wanted.
    pub weights: &'a [Expr<'g>],
}

impl<'a, 'g> Derived<'a, 'g> {
    pub fn new(Lowered { formulation, kernel, mass_laws }: &'a Lowered<'g>) -> Self {
        let provenance = &formulation.provenance;
        let subject = Subject {
            provenance,
            system: &formulation.system,
            constraints: formulation.constraints(),
            can_drift: formulation.can_drift(),
            quaternions: &formulation.quaternions,
            definitions: &formulation.definitions,
        };
        let (runtime, module) = (&provenance.item.runtime, Ident::new(PRIVATE, Span::call_site()));
        let mut derived = Self {
            subject,
            kernel,
            mass_laws,
            weights: &formulation.weights,
            printed: &formulation.printed,
            inertial_parameters: &formulation.inertial_parameters,
            vectors: None,
            private: quote!(#runtime::#module),
            arguments: Vec::new(),
        };
        derived.arguments = derived.all_arguments();
        derived
    }

    /// The same with vectors in the methods in which they win.
    pub fn with_vectors(mut self) -> Self {
        if matches!(self.item().scalar, Scalar::F64) {
            let limbs = LimbSymbols::of(&self.subject.provenance.twins, self.kernel);
            self.vectors = Some(VectorForms { packs: self.packed(), limbs });
        }
        self
    }

    pub fn item(&self) -> &'a Item {
        &self.subject.provenance.item
    }

    pub fn formal(&self) -> ArgumentSymbols<'a, 'g> {
        let Subject { system, constraints, .. } = &self.subject;
        let halves = system.halves();
        ArgumentSymbols {
            speeds: &system.scene.speeds,
            speed_rates: &system.scene.speed_rates,
            momenta: &system.scene.momenta,
            twist: system.twist(),
            residuals: &constraints.residuals,
            factors: halves.map_or(&[], |halves| &halves.symbols),
            impulses: halves.map_or(&[], |halves| &halves.impulses),
            inputs: &system.scene.inputs,
            weights: self.weights,
        }
    }

    pub fn speeds(&self) -> &'a [Expr<'g>] {
        self.formal().speeds
    }

    pub fn scalar(&self) -> ScalarTokens<'a> {
        let (private, scalar) = (self.private(), &self.item().scalar);
        let fma = match scalar {
            Scalar::F64 => quote!(#private::fma_f64),
            Scalar::F32 => quote!(#private::fma_f32),
            Scalar::Parameter(_) => quote!(#private::Real::fma),
        };
        ScalarTokens {
            scalar,
            real: quote!(#private::Real),
            fma,
            apart: quote!(#private::apart),
            functions: &self.item().functions,
        }
    }

    pub fn kernel_name(&self) -> Ident {
        format_ident!("{}Kernel", self.item().ident)
    }

    pub fn constant_fields(&self) -> Vec<Ident> {
        (0..self.kernel.constant_symbols.len()).map(|k| format_ident!("k{}", k)).collect()
    }

    /// `None` of a method that this kernel does not have.
    pub fn program(&self, method: Method) -> Option<&'a Program<'g>> {
        self.kernel.functions.get(method).map(|function| &function.program)
    }

    /// Name of a method: of a frame with its name, `pose_of_tool`.
    pub fn name_of(&self, method: Method) -> String {
        match method {
            Method::OfFrame(_, frame) => format!("{}_{}", method.name(), self.frames()[frame].unraw()),
            _ => method.name().to_owned(),
        }
    }

    /// The names of the frames that are wanted.
    pub fn frames(&self) -> &'a [Ident] {
        &self.item().wanted.frames
    }

    /// Number of components of an increment of the configuration.
    pub fn increments(&self) -> usize {
        self.kernel.functions.kinematics.program.outputs.len()
    }

    pub fn accounts(&self) -> Vec<Account<'g>> {
        self.subject.system.accounts()
    }

    /// Smoothness of the accelerations and the rates of states: kinematics are smooth where they are regular.
    pub fn smoothness(&self) -> Smoothness {
        let of_states = self.program(Method::ConfigurationRates).map(|program| program.smoothness());
        let of_loads = self.kernel.functions.acceleration.program.smoothness();
        of_states.map_or(of_loads, |own| own.max(of_loads))
    }

    /// Whether nothing but contacts can raise the energy.
    pub fn keeps_energy(&self) -> bool {
        self.formal().inputs.is_empty() && self.subject.system.keeps_energy()
    }

    /// The module of the runtime that generated code names, with the version that both were made for.
    pub fn private(&self) -> TokenStream {
        self.private.clone()
    }

    /// Tokens of the constants that a program reads, in methods.
    pub fn constant_names(&self, program: &Program<'g>) -> Map<u32, TokenStream> {
        let read: Set<u32> = program.symbols().iter().map(|symbol| symbol.key()).collect();
        let mut names = Map::default();
        for (k, symbol) in self.kernel.constant_symbols.iter().enumerate() {
            if read.contains(&symbol.key()) {
                let field = format_ident!("k{}", k);
                names.insert(symbol.key(), quote!(self.#field));
            }
        }
        let scalar = self.scalar();
        names.extend(self.kernel.known_constants.iter().map(|(symbol, value)| (symbol.key(), scalar.literal(*value))));
        names
    }

    /// Literal numbers that symbols stand for.
    pub fn literals(&self) -> &[(Rational, Expr<'g>)] {
        &self.subject.provenance.literals
    }

    /// The symbol of the time.
    pub fn time(&self) -> Expr<'g> {
        self.subject.system.scene.time
    }

    /// A vector taken apart.
    pub fn vector_argument(&self, name: TokenStream, symbols: &[Expr<'g>]) -> ArrayArgument<'g> {
        let private = self.private();
        ArrayArgument { array: quote!(#private::components(#name)), symbols: symbols.to_vec() }
    }

    /// The arguments of methods other than constants and time.
    pub fn arguments(&self) -> &[ArrayArgument<'g>] {
        &self.arguments
    }

    fn all_arguments(&self) -> Vec<ArrayArgument<'g>> {
        let ArgumentSymbols { speeds, speed_rates, momenta, twist, residuals, factors, impulses, inputs, weights } =
            self.formal();
        let mut arguments = self.subject.configuration_arguments(&self.private());
        for (kind, symbols) in [
            (ArgumentKind::Speeds, speeds),
            (ArgumentKind::Momenta, momenta),
            (ArgumentKind::Accelerations, speed_rates),
            (ArgumentKind::Twist, twist),
            (ArgumentKind::Residuals, residuals),
            (ArgumentKind::Factors, factors),
            (ArgumentKind::Impulses, impulses),
            (ArgumentKind::Inputs, inputs),
            (ArgumentKind::Weights, weights),
        ] {
            // Of a system that is no body in a chart there are no twists to be read.
            if kind != ArgumentKind::Twist || !symbols.is_empty() {
                arguments.push(self.vector_argument(variable(kind).into_token_stream(), symbols));
            }
        }
        arguments
    }

    /// Methods with packs.
    pub fn packs(&self) -> Option<&Packs<'g>> {
        self.vectors.as_ref().map(|vectors| &vectors.packs)
    }

    fn packed(&self) -> Packs<'g> {
        let (mut packs, arguments, scalar) = (Packs::default(), self.arguments(), self.scalar());
        let methods = self.kernel.functions.iter().filter(|(method, _)| PACKED.contains(method));
        for (method, LoweredFunction { program, .. }) in methods {
            let (_, names) = self.named(program, arguments);
            let sources = Sources { kernel: self.kernel, arguments, names: &names };
            packs.add(method, program, &sources, &scalar);
        }
        packs
    }

    /// The rows of constants that packs load, where the constants are `values`.
    pub fn rows(&self, values: &[TokenStream]) -> Option<TokenStream> {
        let scalar = self.scalar();
        let constants = self.kernel.constant_symbols.iter().map(|symbol| symbol.key());
        let mut names: Map<u32, TokenStream> = constants.zip(values.iter().cloned()).collect();
        names.extend(self.kernel.known_constants.iter().map(|(symbol, value)| (symbol.key(), scalar.literal(*value))));
        self.packs()?.rows(&self.private(), &scalar, &names)
    }

    /// Arguments taken apart and the instructions of a method; its outputs. With packs in both forms.
    fn computed_by(&self, method: Method) -> Option<(TokenStream, Vec<TokenStream>)> {
        let (program, arguments, scalar) = (self.program(method)?, self.arguments(), self.scalar());
        let (mut written, names) = self.named(program, arguments);
        if let Some((instructions, outputs)) = self.in_limbs(program, &names) {
            written.extend(instructions);
            return Some((written, outputs));
        }
        let single = statements(program, &names, &scalar);
        let sources = Sources { kernel: self.kernel, arguments, names: &names };
        let in_both_forms =
            |packs: &Packs<'g>| packs.in_both_forms(method, &single, &sources, (&self.private(), &scalar));
        let in_both_forms = self.packs().and_then(in_both_forms);
        let (instructions, outputs) = in_both_forms.unwrap_or(single);
        written.extend(instructions);
        Some((written, outputs))
    }

    /// Arguments taken apart and the instructions of a program; its outputs.
    pub fn computed(&self, program: &Program<'g>) -> (TokenStream, Vec<TokenStream>) {
        let (mut written, names) = self.named(program, self.arguments());
        let (instructions, outputs) =
            self.in_limbs(program, &names).unwrap_or_else(|| statements(program, &names, &self.scalar()));
        written.extend(instructions);
        (written, outputs)
    }

    /// The same with vectors, a lane for each of the limbs that are alike; nothing where there are none.
    fn in_limbs(
        &self,
        program: &Program<'g>,
        names: &Map<u32, TokenStream>,
    ) -> Option<(TokenStream, Vec<TokenStream>)> {
        self.vectors.as_ref()?.limbs.statements(program, names, (&self.private(), &self.scalar()))
    }

    /// Arguments taken apart as far as a program reads them, and how its symbols are then written.
    pub fn named(
        &self,
        program: &Program<'g>,
        arguments: &[ArrayArgument<'g>],
    ) -> (TokenStream, Map<u32, TokenStream>) {
        let mut names = self.constant_names(program);
        names.insert(self.subject.system.scene.time.key(), quote!(__t));
        let written = declare(program, arguments, &mut names);
        (written, names)
    }

    /// The body of a method: arguments taken apart, instructions, result. `None` where there is no such method.
    pub fn method_body(&self, method: Method) -> Option<TokenStream> {
        let (private, speeds) = (self.private(), self.speeds());
        let (mut body, outputs) = self.computed_by(method)?;
        let result = match method {
            Method::KineticEnergy
            | Method::PotentialEnergy
            | Method::ConstraintFunction
            | Method::SuppliedPower
            | Method::TotalMass => quote!(#(#outputs)*),
            Method::MassMatrix | Method::ElementForces | Method::ContactJacobian => {
                let rows = outputs.chunks(outputs.len() / speeds.len()).map(|row| quote!([#(#row),*]));
                quote!(#private::matrix([#(#rows),*]))
            }
            Method::CentroidalMatrix => {
                let rows = outputs.chunks(speeds.len()).map(|row| quote!([#(#row),*]));
                quote!(#private::matrix([#(#rows),*]))
            }
            // The numerator over the root of the square.
            Method::Regularity => {
                let (volume, squares, real) = (&outputs[0], &outputs[1], self.scalar().real);
                quote!(#volume / #real::sqrt(#squares))
            }
            Method::Kinematics | Method::ConfigurationRates | Method::PositionCorrection => {
                self.subject.tangent(&self.private(), &outputs)
            }
            _ => quote!(#private::vector([#(#outputs),*])),
        };
        body.extend(result);
        Some(body)
    }

    pub fn degrees_of_freedom(&self) -> usize {
        self.speeds().len()
    }

    /// A method of a trait, with its result; `None` where the kernel does not have it.
    pub fn function(&self, method: Method, result: TokenStream) -> Option<TokenStream> {
        let function = self.function_of(method.name(), arguments_of(method), result, self.method_body(method)?);
        Some(quote!(#[inline] #function))
    }

    /// A function of time, configuration and further arguments.
    pub fn function_of(
        &self,
        name: &str,
        arguments: &[ArgumentKind],
        result: TokenStream,
        body: TokenStream,
    ) -> TokenStream {
        let (name, arguments) = (Ident::new(name, Span::call_site()), declared(&self.private(), arguments));
        // A group is handed on as a whole, what is not in one token by token.
        let body = Group::new(Delimiter::Brace, body);
        quote!(fn #name(&self, __t: Self::Scalar, __q: &Self::Configuration, #(#arguments),*) -> #result #body)
    }

    /// Is the scalar a type parameter?
    pub fn is_generic(&self) -> bool {
        matches!(self.item().scalar, Scalar::Parameter(_))
    }

    /// Type parameters of the kernel: as the struct declares them, as `impl` does, as they are used.
    pub fn kernel_generics(&self) -> KernelGenerics {
        if !self.is_generic() {
            return KernelGenerics::default();
        }
        let (ty, real) = (self.scalar().ty(), self.scalar().real);
        KernelGenerics { declared: quote!(<#ty>), bounded: quote!(<#ty: #real>), used: quote!(<#ty>) }
    }

    /// `impl Trait for NameKernel`, of a trait of the runtime.
    pub fn implementation(&self, of: TokenStream, items: TokenStream) -> TokenStream {
        let (private, name, KernelGenerics { bounded, used, .. }) =
            (self.private(), self.kernel_name(), self.kernel_generics());
        let items = Group::new(Delimiter::Brace, items);
        quote! {
            #[automatically_derived]
            #[allow(unused_variables, clippy::all, clippy::pedantic)]
            impl #bounded #private::#of for #name #used #items
        }
    }

    /// Numbers of operations of a program, as a value of the runtime.
    pub fn count(&self, counts: Counts) -> TokenStream {
        let private = self.private();
        let Counts { additions, multiplications, divisions, roots, transcendentals } = counts;
        quote!(#private::OperationCount::new(#additions, #multiplications, #divisions, #roots, #transcendentals))
    }
}
