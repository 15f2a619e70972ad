//! Everything known about one derive when code is written, and what all implementations of traits are made with.

use proc_macro2::{Ident, Span, TokenStream};
use quote::{format_ident, quote};

use crate::algebra::{Expr, Map, Rational};
use crate::kernel::{Counts, Kernel, Program, Smoothness};
use crate::mechanics::{Account, Assigned, Formula, Linearization, Method, Regressor, Scene};
use crate::model::{Field, InChart, Model, Scalar};
use crate::translate::{DragMatrix, Parameter, Source};
use syn::{Generics, Path, Visibility};

use super::arguments::{Argument, declare};
use super::documentation::method_name;
use super::program::{ScalarTokens, statements};
use super::system::SystemSubject;

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
    /// Matrices of drag.
    pub drags: &'a [DragMatrix<'g>],
    pub formulas: &'a [Formula<'g>],
    pub kernel: &'a Kernel<'g>,
    /// What is differentiated by the state, where that is asked for.
    pub linearization: Option<&'a Linearization<'g>>,
    /// The numbers of fields.
    pub parameters: &'a [Parameter<'g>],
    /// The forces of inertia as a linear function of inertial parameters, where that is asked for.
    pub regressor: Option<&'a Regressor<'g>>,
}

/// What is derived.
#[derive(Clone, Copy)]
pub enum Subject<'a, 'g> {
    /// One body in a chart.
    Body {
        model: &'a Model,
        in_chart: InChart,
        scene: &'a Scene<'g>,
        /// Components x, y, z, w of the unit quaternion behind R, where there is one.
        quaternion: Option<[Expr<'g>; 4]>,
        /// Parameters that only what acts depends on.
        plain: Option<Plain<'a, 'g>>,
    },
    /// A system in coordinates of its own.
    System(SystemSubject<'a, 'g>),
}

/// One body, where what is written needs to know that it is one.
#[derive(Clone, Copy)]
pub struct BodySubject<'a, 'g> {
    pub derived: &'a Derived<'a, 'g>,
    pub model: &'a Model,
    pub in_chart: InChart,
    pub scene: &'a Scene<'g>,
    pub quaternion: Option<[Expr<'g>; 4]>,
    pub plain: Option<Plain<'a, 'g>>,
}

/// Parameters without a role, and where the symbols of expressions are read.
#[derive(Clone, Copy)]
pub struct Plain<'a, 'g> {
    pub fields: &'a [Field],
    pub sources: &'a [Source<'g>],
    /// Literal numbers that symbols stand for.
    pub literals: &'a [(Rational, Expr<'g>)],
    /// Mass data of the body without a name that are written in clauses.
    pub assigned: &'a [Assigned<'g>],
}

/// What the struct says of itself, whatever it describes.
pub struct Item<'a> {
    pub ident: &'a Ident,
    pub visibility: &'a Visibility,
    pub generics: &'a Generics,
    pub scalar: &'a Scalar,
    pub runtime: &'a Path,
}

/// Type parameters of the kernel; nothing where the scalar is a type.
#[derive(Default)]
pub struct KernelGenerics {
    pub declared: TokenStream,
    pub bounded: TokenStream,
    pub used: TokenStream,
}

/// Symbols of the arguments of the methods.
pub struct Formal<'a, 'g> {
    pub speeds: &'a [Expr<'g>],
    pub speed_rates: &'a [Expr<'g>],
    pub momenta: &'a [Expr<'g>],
    pub twist: &'a [Expr<'g>],
    pub residuals: &'a [Expr<'g>],
    pub inputs: &'a [Expr<'g>],
}

impl<'a, 'g> Derived<'a, 'g> {
    pub fn model(&self) -> &'a Model {
        match self.subject {
            Subject::Body { model, .. } | Subject::System(SystemSubject { model, .. }) => model,
        }
    }

    pub fn item(&self) -> Item<'a> {
        let Model { ident, visibility, generics, scalar, runtime, .. } = self.model();
        Item { ident, visibility, generics, scalar, runtime }
    }

    pub fn body(&'a self) -> Option<BodySubject<'a, 'g>> {
        match self.subject {
            Subject::Body { model, in_chart, scene, quaternion, plain } => {
                Some(BodySubject { derived: self, model, in_chart, scene, quaternion, plain })
            }
            Subject::System(_) => None,
        }
    }

    pub fn formal(&self) -> Formal<'a, 'g> {
        match self.subject {
            Subject::Body { scene, .. } => Formal {
                speeds: &scene.kinematics.speeds,
                speed_rates: &scene.kinematics.speed_rates,
                momenta: &scene.momenta,
                twist: &scene.twist,
                residuals: &[],
                inputs: scene.acting.as_ref().map_or(&[], |acting| &acting.inputs),
            },
            Subject::System(SystemSubject { system, constraints, .. }) => Formal {
                speeds: &system.scene.speeds,
                speed_rates: &system.scene.speed_rates,
                momenta: &system.scene.momenta,
                twist: &[],
                residuals: &constraints.residuals,
                inputs: &system.scene.inputs,
            },
        }
    }

    pub fn speeds(&self) -> &'a [Expr<'g>] {
        self.formal().speeds
    }

    pub fn scalar(&self) -> ScalarTokens<'a> {
        let private = self.private();
        ScalarTokens { scalar: self.item().scalar, real: quote!(#private::Real) }
    }

    pub fn kernel_name(&self) -> Ident {
        format_ident!("{}Kernel", self.item().ident)
    }

    pub fn constant_fields(&self) -> Vec<Ident> {
        (0..self.kernel.constant_symbols.len()).map(|k| format_ident!("k{}", k)).collect()
    }

    pub fn program(&self, method: Method) -> &Program<'g> {
        let position = self.formulas.iter().position(|f| f.method == method);
        &self.kernel.functions[position.expect("a method that is written was derived")]
    }

    pub fn has(&self, method: Method) -> bool {
        self.formulas.iter().any(|f| f.method == method)
    }

    pub fn accounts(&self) -> Vec<Account<'g>> {
        match self.subject {
            Subject::Body { scene, .. } => scene.accounts(),
            Subject::System(SystemSubject { system, .. }) => system.accounts(),
        }
    }

    pub fn smoothness(&self) -> Smoothness {
        self.program(Method::Acceleration).smoothness()
    }

    /// The module of the runtime that generated code names, with the version that both were made for.
    pub fn private(&self) -> TokenStream {
        let (runtime, module) = (self.item().runtime, Ident::new(PRIVATE, Span::call_site()));
        quote!(#runtime::#module)
    }

    /// How constants are written in methods.
    pub fn constant_names(&self) -> Map<u32, TokenStream> {
        let symbols = self.kernel.constant_symbols.iter().zip(self.constant_fields());
        let mut names: Map<u32, TokenStream> =
            symbols.map(|(symbol, field)| (symbol.key(), quote!(self.#field))).collect();
        let scalar = self.scalar();
        names.extend(self.kernel.known_constants.iter().map(|(symbol, value)| (symbol.key(), scalar.literal(*value))));
        names
    }

    /// Literal numbers that symbols stand for.
    pub fn literals(&self) -> &'a [(Rational, Expr<'g>)] {
        match self.subject {
            Subject::Body { plain, .. } => plain.map_or(&[], |plain| plain.literals),
            Subject::System(subject) => subject.literals,
        }
    }

    /// The symbol of the time, where something can depend on it.
    pub fn time(&self) -> Option<Expr<'g>> {
        match self.subject {
            Subject::Body { scene, .. } => scene.acting.as_ref().map(|acting| acting.time),
            Subject::System(subject) => Some(subject.system.scene.time),
        }
    }

    /// The configuration `q` taken apart.
    pub fn configuration_arguments(&'a self) -> Vec<Argument<'g>> {
        match self.subject {
            Subject::Body { .. } => self.body().map(|body| body.configuration_arguments()).unwrap_or_default(),
            Subject::System(subject) => subject.configuration_arguments(self),
        }
    }

    /// A vector taken apart.
    pub fn vector_argument(&self, name: TokenStream, symbols: &[Expr<'g>]) -> Argument<'g> {
        let private = self.private();
        Argument { array: quote!(#private::components(#name)), symbols: symbols.to_vec() }
    }

    /// Arguments taken apart and the instructions of a program; its outputs.
    pub fn computed(&'a self, program: &Program<'g>) -> (TokenStream, Vec<TokenStream>) {
        let Formal { speeds, speed_rates, momenta, twist, residuals, inputs } = self.formal();
        let mut names = self.constant_names();
        names.extend(self.time().map(|time| (time.key(), quote!(t))));
        let mut arguments = self.configuration_arguments();
        let vector = |name: TokenStream, symbols: &[Expr<'g>]| self.vector_argument(name, symbols);
        arguments.push(vector(quote!(z), speeds));
        arguments.push(vector(quote!(p), momenta));
        arguments.push(vector(quote!(acceleration), speed_rates));
        if !twist.is_empty() {
            arguments.push(vector(quote!(twist), twist));
        }
        arguments.push(vector(quote!(residual), residuals));
        arguments.push(vector(quote!(input), inputs));
        let declarations = declare(program, &arguments, &mut names);
        let (instructions, outputs) = statements(program, &names, &self.scalar());
        (quote!(#declarations #instructions), outputs)
    }

    /// The body of a method: arguments taken apart, instructions, result.
    pub fn method_body(&self, method: Method) -> TokenStream {
        let (private, speeds) = (self.private(), self.speeds());
        let (instructions, outputs) = self.computed(self.program(method));
        let result = match method {
            Method::KineticEnergy | Method::PotentialEnergy | Method::ConstraintFunction | Method::SuppliedPower => {
                quote!(#(#outputs)*)
            }
            Method::MassMatrix | Method::ElementForces => {
                let rows = outputs.chunks(outputs.len() / speeds.len()).map(|row| quote!([#(#row),*]));
                quote!(#private::matrix([#(#rows),*]))
            }
            // The volume over the product of the lengths.
            Method::Regularity => {
                let (volume, squares, real) = (&outputs[0], &outputs[1], self.scalar().real);
                quote!(#volume / #real::sqrt(#squares))
            }
            Method::Kinematics | Method::PositionCorrection => self.tangent(&outputs),
            _ => quote!(#private::vector([#(#outputs),*])),
        };
        quote!(#instructions #result)
    }

    /// A velocity of the configuration.
    pub fn tangent(&self, components: &[TokenStream]) -> TokenStream {
        let private = self.private();
        match self.subject {
            Subject::System(subject) => subject.tangent(self, components),
            Subject::Body { .. } => quote!(#private::vector([#(#components),*])),
        }
    }

    pub fn degrees_of_freedom(&self) -> usize {
        self.speeds().len()
    }

    /// A method of a trait: its arguments after `t` and `q`, its result.
    pub fn function(&self, method: Method, arguments: TokenStream, result: TokenStream) -> TokenStream {
        let (function, body) = (Ident::new(method_name(method), Span::call_site()), self.method_body(method));
        quote! {
            #[inline]
            fn #function(&self, t: Self::Scalar, q: &Self::Configuration, #arguments) -> #result { #body }
        }
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
        quote! {
            #[automatically_derived]
            #[allow(unused_variables, clippy::all, clippy::pedantic)]
            impl #bounded #private::#of for #name #used { #items }
        }
    }

    /// How many operations a program has, as a value of the runtime.
    pub fn count(&self, counts: Counts) -> TokenStream {
        let private = self.private();
        let Counts { additions, multiplications, divisions, roots, transcendentals } = counts;
        quote!(#private::OperationCount::new(#additions, #multiplications, #divisions, #roots, #transcendentals))
    }
}
