//! The kernel struct and its implementations of the runtime's traits.

use proc_macro2::{Ident, Span, TokenStream};
use quote::{format_ident, quote};

use crate::algebra::{Expr, Map, Rational};
use crate::kernel::{Counts, Kernel, Program, Smoothness};
use crate::mechanics::{Account, Assigned, Formula, Linearization, Method, Regressor, Scene};
use crate::model::{Model, Scalar, SystemField};
use crate::translate::{DragMatrix, Parameter, Source};
use syn::{Generics, Path, Visibility};

use super::arguments::{Argument, declare};
use super::documentation::{equations, method_name, rustdoc};
use super::identification::{inertial_regressor, parametric_system};
use super::linearize::linearized_system;
use super::parameters::kernel_body;
use super::program::{ScalarTokens, statements};
use super::system::SystemSubject;
use super::system_parameters::{system_kernel_body, warnings};

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
    pub scene: &'a Scene<'g>,
    pub quaternion: Option<[Expr<'g>; 4]>,
    pub plain: Option<Plain<'a, 'g>>,
}

/// Parameters without a role, and where the symbols of expressions are read.
#[derive(Clone, Copy)]
pub struct Plain<'a, 'g> {
    pub fields: &'a [SystemField],
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
    pub fn item(&self) -> Item<'a> {
        match self.subject {
            Subject::Body { model: m, .. } => Item {
                ident: &m.ident,
                visibility: &m.visibility,
                generics: &m.generics,
                scalar: &m.scalar,
                runtime: &m.runtime,
            },
            Subject::System(SystemSubject { model: m, .. }) => Item {
                ident: &m.ident,
                visibility: &m.visibility,
                generics: &m.generics,
                scalar: &m.scalar,
                runtime: &m.runtime,
            },
        }
    }

    pub fn body(&'a self) -> Option<BodySubject<'a, 'g>> {
        match self.subject {
            Subject::Body { model, scene, quaternion, plain } => {
                Some(BodySubject { derived: self, model, scene, quaternion, plain })
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
        let Item { runtime, scalar, .. } = self.item();
        ScalarTokens { scalar, real: quote!(#runtime::real::Real) }
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

    fn smoothness(&self) -> Smoothness {
        self.program(Method::Acceleration).smoothness()
    }

    pub fn private(&self) -> TokenStream {
        let runtime = self.item().runtime;
        quote!(#runtime::__private)
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
    fn tangent(&self, components: &[TokenStream]) -> TokenStream {
        let private = self.private();
        match self.subject {
            Subject::System(subject) => subject.tangent(self, components),
            Subject::Body { .. } => quote!(#private::vector([#(#components),*])),
        }
    }

    /// `evaluate`: q̇, ż and the energies at once.
    fn evaluate(&'a self) -> TokenStream {
        let (runtime, private) = (self.item().runtime, self.private());
        let (instructions, outputs) = self.computed(&self.kernel.joined);
        let (configuration, rest) = outputs.split_at(self.program(Method::Kinematics).outputs.len());
        let (speeds, energies) = rest.split_at(self.speeds().len());
        let velocity = self.tangent(configuration);
        quote! {
            #[inline]
            fn evaluate(
                &self,
                t: Self::Scalar,
                q: &Self::Configuration,
                z: &Self::Speeds,
                input: &Self::Input,
            ) -> #runtime::system::Evaluated<Self> {
                #instructions
                let [__kinetic, __potential] = [#(#energies),*];
                #runtime::system::Evaluated {
                    velocity: #velocity,
                    acceleration: #private::vector([#(#speeds),*]),
                    kinetic_energy: __kinetic,
                    potential_energy: __potential,
                }
            }
        }
    }

    pub fn degrees_of_freedom(&self) -> usize {
        self.speeds().len()
    }
}

pub fn count_tokens(runtime: &syn::Path, counts: Counts) -> TokenStream {
    let Counts { additions, multiplications, divisions, roots, transcendentals } = counts;
    quote!(#runtime::system::OperationCount::new(#additions, #multiplications, #divisions, #roots, #transcendentals))
}

/// The whole output of the derive.
pub fn emit(derived: &Derived<'_, '_>) -> TokenStream {
    let Item { ident, visibility, generics, scalar: number, runtime } = derived.item();
    let scalar = derived.scalar();
    let (ty, real) = (scalar.ty(), &scalar.real);
    let name = derived.kernel_name();
    let fields = derived.constant_fields();
    let n = derived.degrees_of_freedom();
    let generic = matches!(number, Scalar::Parameter(_));
    let (declared, bounded, used) =
        if generic { (quote!(<#ty>), quote!(<#ty: #real>), quote!(<#ty>)) } else { Default::default() };
    let (impl_generics, type_generics, where_clause) = generics.split_for_impl();
    let predicates = where_clause.map(|w| {
        let predicates = w.predicates.iter();
        quote!(#(#predicates,)*)
    });
    let bound = generic.then(|| quote!(#ty: #real,));
    let (text, latex) = equations(derived);
    let documentation = rustdoc(derived, &text);
    let (kernel_body, chart, configuration) = match derived.subject {
        Subject::Body { model, scene, quaternion, plain } => {
            let body = BodySubject { derived, model, scene, quaternion, plain };
            (kernel_body(&body), body.chart_tokens(), body.configuration_type())
        }
        Subject::System(subject) => (
            system_kernel_body(derived, &subject),
            quote!(#runtime::chart::Chart::Own),
            subject.configuration_type(derived),
        ),
    };
    let kernel_doc = format!(
        "Checks the parameters and computes once whatever depends on them alone: the kernel of [`{ident}`].\n\n\
         # Errors\nEvery parameter that no body can have, with its field, value and the rule it breaks."
    );
    let plain = match derived.subject {
        Subject::Body { plain, .. } => plain,
        Subject::System(SystemSubject { model, sources, literals, assigned, .. }) => {
            Some(Plain { fields: &model.fields, sources, literals, assigned })
        }
    };
    let warnings = plain.map(|plain| warnings(derived, &plain, derived.drags));
    let operations = {
        let rows = derived.formulas.iter().zip(&derived.kernel.functions).filter(|(f, _)| f.method <= Method::Powers);
        let rows = rows.map(|(f, program)| {
            let (field, count) =
                (Ident::new(method_name(f.method), Span::call_site()), count_tokens(runtime, program.counts()));
            quote!(#field: #count)
        });
        let kernel = count_tokens(runtime, derived.kernel.constants.counts());
        let unconstrained = derived.formulas.iter().all(|f| f.method != Method::Multipliers);
        let none = unconstrained.then(|| {
            let count = count_tokens(runtime, Counts::default());
            quote!(multipliers: #count,)
        });
        let still = derived.formulas.iter().all(|f| f.method != Method::Powers);
        let powerless = still.then(|| {
            let count = count_tokens(runtime, Counts::default());
            quote!(powers: #count,)
        });
        let evaluate = count_tokens(runtime, derived.kernel.joined.counts());
        quote!(#runtime::system::Operations { kernel: #kernel, evaluate: #evaluate, #none #powerless #(#rows),* })
    };
    let mut methods = vec![
        (Method::Acceleration, quote!(z: &Self::Speeds, input: &Self::Input), quote!(Self::Speeds)),
        (Method::Momentum, quote!(z: &Self::Speeds), quote!(Self::Speeds)),
        (Method::Velocity, quote!(p: &Self::Speeds), quote!(Self::Speeds)),
        (Method::MomentumRate, quote!(p: &Self::Speeds, input: &Self::Input), quote!(Self::Speeds)),
        (Method::MassMatrix, quote!(), quote!(Self::MassMatrix)),
        (Method::KineticEnergy, quote!(z: &Self::Speeds), quote!(Self::Scalar)),
        (Method::PotentialEnergy, quote!(), quote!(Self::Scalar)),
        (
            Method::GaussResidual,
            quote!(z: &Self::Speeds, acceleration: &Self::Speeds, input: &Self::Input),
            quote!(Self::Speeds),
        ),
        (
            Method::ConstraintFunction,
            quote!(z: &Self::Speeds, acceleration: &Self::Speeds, input: &Self::Input),
            quote!(Self::Scalar),
        ),
        (
            Method::Kinematics,
            quote!(z: &Self::Speeds),
            quote!(<Self::Configuration as #runtime::configuration::Configuration>::Tangent),
        ),
    ];
    if derived.formulas.iter().any(|f| f.method == Method::Regularity) {
        methods.push((Method::Regularity, quote!(), quote!(Self::Scalar)));
    }
    let write = |(method, arguments, result): (Method, TokenStream, TokenStream)| {
        let (function, body) = (Ident::new(method_name(method), Span::call_site()), derived.method_body(method));
        quote! {
            #[inline]
            fn #function(&self, t: Self::Scalar, q: &Self::Configuration, #arguments) -> #result { #body }
        }
    };
    let methods = methods.into_iter().map(&write);
    let (projection, constrained) = match derived.subject {
        Subject::System(subject) if !subject.constraints.is_empty() => {
            let count = subject.constraints.count();
            let methods = subject.constraint_methods(runtime).into_iter().map(&write);
            let constrained = quote! {
                #[automatically_derived]
                #[allow(unused_variables, clippy::all, clippy::pedantic)]
                impl #bounded #runtime::constraint::ConstrainedSystem for #name #used {
                    type Multipliers = #runtime::prelude::SVector<#ty, #count>;
                    #(#methods)*
                }
            };
            (subject.projection(derived), Some(constrained))
        }
        _ => (TokenStream::new(), None),
    };
    let forced = derived.has(Method::Powers).then(|| {
        let accounts = derived.accounts();
        let count = accounts.len();
        let elements = accounts.iter().map(|account| {
            let (name, conservative) = (&account.name, account.conservative);
            quote!(#runtime::forces::Element::new(#name, #conservative))
        });
        let arguments = quote!(z: &Self::Speeds, input: &Self::Input);
        let methods = [
            (Method::Powers, arguments.clone(), quote!(Self::Powers)),
            (Method::ElementForces, arguments.clone(), quote!(Self::ElementForces)),
            (Method::SuppliedPower, arguments, quote!(Self::Scalar)),
        ];
        let methods = methods.into_iter().map(&write);
        quote! {
            #[automatically_derived]
            #[allow(unused_variables, clippy::all, clippy::pedantic)]
            impl #bounded #runtime::forces::ForcedSystem for #name #used {
                type Powers = #runtime::prelude::SVector<#ty, #count>;
                type ElementForces = #runtime::prelude::SMatrix<#ty, #n, #count>;
                const ELEMENTS: &'static [#runtime::forces::Element] = &[#(#elements),*];
                #(#methods)*
            }
        }
    });
    // Of what acts alone: kinematics are smooth where they are regular.
    let smoothness = match derived.smoothness() {
        Smoothness::Smooth => None,
        Smoothness::Kinks => Some(quote!(Kinks)),
        Smoothness::Jumps => Some(quote!(Jumps)),
    };
    let smoothness = smoothness.map(|word| {
        let smoothness = quote!(#runtime::system::Smoothness);
        quote!(const SMOOTHNESS: #smoothness = #smoothness::#word;)
    });
    let evaluate = derived.evaluate();
    let series = derived.series(&bounded, &used);
    let input = match derived.formal().inputs.len() {
        0 => quote!(()),
        count => quote!(#runtime::prelude::SVector<#ty, #count>),
    };
    let rigid_body = derived.body().map(|body| {
        let (pose, configuration_of_pose) = body.pose_bodies();
        let six = quote!(#runtime::prelude::SVector<Self::Scalar, 6>);
        let twist_methods = [
            (Method::BodyTwist, quote!(z: &Self::Speeds), six.clone()),
            (Method::Speeds, quote!(twist: &#six), quote!(Self::Speeds)),
            (Method::BodyMomentum, quote!(z: &Self::Speeds), six),
        ];
        let twist_methods = twist_methods.into_iter().map(&write);
        quote! {
            #[automatically_derived]
            #[allow(unused_variables, clippy::all, clippy::pedantic)]
            impl #bounded #runtime::system::RigidBodySystem for #name #used {
                #[inline]
                fn pose(&self, t: Self::Scalar, q: &Self::Configuration) -> #runtime::prelude::Isometry3<Self::Scalar> {
                    #pose
                }
                #[inline]
                fn configuration(
                    &self,
                    pose: &#runtime::prelude::Isometry3<Self::Scalar>,
                ) -> ::core::result::Result<Self::Configuration, #runtime::chart::ChartError> {
                    #configuration_of_pose
                }
                #(#twist_methods)*
            }
        }
    });
    let (head, used_name) = (quote!(impl #bounded), quote!(#name #used));
    let linearized = linearized_system(derived, &head, &used_name);
    let parametric = parametric_system(derived, &head, &used_name);
    let regressor = inertial_regressor(derived, &head, &used_name);
    quote! {
        #[doc = #documentation]
        #[derive(::core::clone::Clone, ::core::marker::Copy, ::core::fmt::Debug)]
        #[allow(non_camel_case_types)]
        #visibility struct #name #declared { #(#fields: #ty),* }

        const _: () = {
            #[automatically_derived]
            impl #impl_generics #ident #type_generics where #predicates #bound {
                #[doc = #kernel_doc]
                #visibility fn kernel(&self) -> ::core::result::Result<#name #used, #runtime::error::ParameterError> {
                    #kernel_body
                }

                #warnings
            }

            #[automatically_derived]
            #[allow(unused_variables, clippy::all, clippy::pedantic)]
            impl #bounded #runtime::system::GaussSystem for #name #used {
                type Scalar = #ty;
                type Configuration = #configuration;
                type Speeds = #runtime::prelude::SVector<#ty, #n>;
                type MassMatrix = #runtime::prelude::SMatrix<#ty, #n, #n>;
                type Input = #input;
                const DOF: ::core::primitive::usize = #n;
                const CHART: #runtime::chart::Chart = #chart;
                const EQUATIONS: #runtime::system::Equations = #runtime::system::Equations { text: #text, latex: #latex };
                const OPERATIONS: #runtime::system::Operations = #operations;
                #smoothness
                #(#methods)*
                #evaluate
                #projection
            }

            #rigid_body
            #constrained
            #forced
            #series
            #linearized
            #parametric
            #regressor
        };
    }
}
