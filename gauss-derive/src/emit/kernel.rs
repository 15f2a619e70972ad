//! The kernel struct and its implementations of the runtime's traits.

use proc_macro2::{Ident, Span, TokenStream};
use quote::{format_ident, quote};

use crate::algebra::{Expr, Map};
use crate::kernel::{Counts, Kernel, Program};
use crate::mechanics::{ConfigurationKind, Formula, InertiaShape, Method, Scene};
use crate::model::{Chart, Model, Motion, RotationChart, Scalar};

use super::arguments::{Argument, declare};
use super::documentation::{latex, method_name, rustdoc, text};
use super::parameters::kernel_body;
use super::program::{ScalarTokens, statements};

/// Everything known about one derive when code is written.
pub struct Derived<'a, 'g> {
    pub model: &'a Model,
    pub scene: &'a Scene<'g>,
    pub formulas: &'a [Formula<'g>],
    pub kernel: &'a Kernel<'g>,
    pub inertia: InertiaShape,
    /// Components x, y, z, w of the unit quaternion behind R, where there is one.
    pub quaternion: Option<[Expr<'g>; 4]>,
}

impl<'g> Derived<'_, 'g> {
    pub fn scalar(&self) -> ScalarTokens<'_> {
        let runtime = &self.model.runtime;
        ScalarTokens { scalar: &self.model.scalar, real: quote!(#runtime::real::Real) }
    }

    pub fn kernel_name(&self) -> Ident {
        format_ident!("{}Kernel", self.model.ident)
    }

    pub fn constant_fields(&self) -> Vec<Ident> {
        (0..self.kernel.constant_symbols.len()).map(|k| format_ident!("k{}", k)).collect()
    }

    pub fn chart_name(&self) -> String {
        match self.model.chart {
            Chart::LeftInvariant => "left_invariant".to_owned(),
            Chart::RightInvariant => "right_invariant".to_owned(),
            Chart::Hybrid => "hybrid".to_owned(),
            Chart::Jet(RotationChart::Euler(axes)) => {
                let letters: String = axes.iter().map(|&a| char::from(b'x' + a)).collect();
                format!("jet(euler_{letters})")
            }
            Chart::Jet(RotationChart::Rodrigues) => "jet(rodrigues)".to_owned(),
            Chart::Jet(RotationChart::ModifiedRodrigues) => "jet(modified_rodrigues)".to_owned(),
            Chart::Jet(RotationChart::Angle) => "jet".to_owned(),
        }
    }

    pub fn motion_name(&self) -> &'static str {
        match self.model.motion {
            Motion::Free => "free",
            Motion::FixedPoint => "fixed_point",
            Motion::Planar => "planar",
        }
    }

    fn program(&self, method: Method) -> &Program<'g> {
        let position = self.formulas.iter().position(|f| f.method == method);
        &self.kernel.functions[position.expect("a method that is written was derived")]
    }

    /// The configuration taken apart.
    fn configuration_arguments(&self) -> Vec<Argument<'g>> {
        let private = self.private();
        let symbols = &self.scene.kinematics.configuration;
        let quaternion =
            |array: TokenStream| Argument { array, symbols: self.quaternion.map(|q| q.to_vec()).unwrap_or_default() };
        match self.scene.kinematics.kind {
            ConfigurationKind::Pose => vec![
                quaternion(quote!(#private::isometry3(q).0)),
                Argument { array: quote!(#private::isometry3(q).1), symbols: symbols[9..].to_vec() },
            ],
            ConfigurationKind::Rotation => vec![quaternion(quote!(#private::quaternion(q)))],
            ConfigurationKind::PlanePose => vec![
                Argument { array: quote!(#private::isometry2(q).0), symbols: symbols[..2].to_vec() },
                Argument { array: quote!(#private::isometry2(q).1), symbols: symbols[2..].to_vec() },
            ],
            ConfigurationKind::Coordinates => {
                vec![Argument { array: quote!(#private::components(q)), symbols: symbols.clone() }]
            }
        }
    }

    fn private(&self) -> TokenStream {
        let runtime = &self.model.runtime;
        quote!(#runtime::__private)
    }

    /// The body of a method: arguments taken apart, instructions, result.
    fn method_body(&self, method: Method) -> TokenStream {
        let private = self.private();
        let program = self.program(method);
        let kinematics = &self.scene.kinematics;
        let mut arguments = self.configuration_arguments();
        let vector = |name: TokenStream, symbols: &[Expr<'g>]| Argument {
            array: quote!(#private::components(#name)),
            symbols: symbols.to_vec(),
        };
        arguments.push(vector(quote!(z), &kinematics.speeds));
        arguments.push(vector(quote!(p), &self.scene.momenta));
        arguments.push(vector(quote!(acceleration), &kinematics.speed_rates));
        arguments.push(vector(quote!(twist), &self.scene.twist));
        let mut names: Map<u32, TokenStream> = Map::default();
        for (symbol, field) in self.kernel.constant_symbols.iter().zip(self.constant_fields()) {
            names.insert(symbol.key(), quote!(self.#field));
        }
        let declarations = declare(program, &arguments, &mut names);
        let (instructions, outputs) = statements(program, &names, &self.scalar());
        let result = match method {
            Method::KineticEnergy | Method::PotentialEnergy | Method::ConstraintFunction => quote!(#(#outputs)*),
            Method::MassMatrix => {
                let rows = outputs.chunks(kinematics.speeds.len()).map(|row| quote!([#(#row),*]));
                quote!(#private::matrix([#(#rows),*]))
            }
            // The volume over the product of the lengths.
            Method::Regularity => {
                let (volume, squares, real) = (&outputs[0], &outputs[1], self.scalar().real);
                quote!(#volume / #real::sqrt(#squares))
            }
            _ => quote!(#private::vector([#(#outputs),*])),
        };
        quote!(#declarations #instructions #result)
    }

    fn rotation_chart_tokens(&self) -> TokenStream {
        let runtime = &self.model.runtime;
        let chart = quote!(#runtime::chart::RotationChart);
        match self.model.chart {
            Chart::Jet(RotationChart::Euler([a, b, c])) => {
                quote!(#chart::Euler(#runtime::chart::EulerSequence { axes: [#a, #b, #c] }))
            }
            Chart::Jet(RotationChart::Rodrigues) => quote!(#chart::Rodrigues),
            Chart::Jet(RotationChart::ModifiedRodrigues) => quote!(#chart::ModifiedRodrigues),
            _ => quote!(#chart::Angle),
        }
    }

    fn chart_tokens(&self) -> TokenStream {
        let runtime = &self.model.runtime;
        let chart = quote!(#runtime::chart::Chart);
        match self.model.chart {
            Chart::LeftInvariant => quote!(#chart::LeftInvariant),
            Chart::RightInvariant => quote!(#chart::RightInvariant),
            Chart::Hybrid => quote!(#chart::Hybrid),
            Chart::Jet(_) => {
                let rotation = self.rotation_chart_tokens();
                quote!(#chart::Jet(#rotation))
            }
        }
    }

    fn configuration_type(&self) -> TokenStream {
        let (runtime, ty, n) = (&self.model.runtime, self.scalar().ty(), self.degrees_of_freedom());
        match self.scene.kinematics.kind {
            ConfigurationKind::Pose => quote!(#runtime::prelude::Isometry3<#ty>),
            ConfigurationKind::Rotation => quote!(#runtime::prelude::UnitQuaternion<#ty>),
            ConfigurationKind::PlanePose => quote!(#runtime::prelude::Isometry2<#ty>),
            ConfigurationKind::Coordinates => quote!(#runtime::prelude::SVector<#ty, #n>),
        }
    }

    fn degrees_of_freedom(&self) -> usize {
        self.scene.kinematics.speeds.len()
    }

    /// `pose` and `configuration`: the configuration as a pose and back.
    fn pose_bodies(&self) -> (TokenStream, TokenStream) {
        let private = self.private();
        let chart = self.rotation_chart_tokens();
        match (self.scene.kinematics.kind, self.model.motion) {
            (ConfigurationKind::Pose, _) => (quote!(*q), quote!(#private::free_pose(pose))),
            (ConfigurationKind::Rotation, _) => {
                (quote!(#private::pose_of_rotation(q)), quote!(#private::rotation_of_pose(pose)))
            }
            (ConfigurationKind::PlanePose, _) => {
                (quote!(#private::pose_of_plane(q)), quote!(#private::plane_of_pose(pose)))
            }
            (ConfigurationKind::Coordinates, Motion::Planar) => (
                quote!(#private::pose_of_plane_chart(#private::components(q))),
                quote!(#private::plane_chart_of_pose(pose).map(#private::vector)),
            ),
            (ConfigurationKind::Coordinates, Motion::FixedPoint) => (
                quote!(#private::pose_of_rotation_chart(#chart, #private::components(q))),
                quote!(#private::rotation_chart_of_pose(#chart, pose).map(#private::vector)),
            ),
            (ConfigurationKind::Coordinates, Motion::Free) => (
                quote! {
                    let [__b1, __b2, __b3, __a1, __a2, __a3] = #private::components(q);
                    #private::pose_of_chart(#chart, [__a1, __a2, __a3], [__b1, __b2, __b3])
                },
                quote! {
                    #private::chart_of_pose(#chart, pose)
                        .map(|([__a1, __a2, __a3], [__b1, __b2, __b3])| {
                            #private::vector([__b1, __b2, __b3, __a1, __a2, __a3])
                        })
                },
            ),
        }
    }
}

fn count_tokens(runtime: &syn::Path, counts: Counts) -> TokenStream {
    let Counts { additions, multiplications, divisions, roots, transcendentals } = counts;
    quote!(#runtime::system::OperationCount::new(#additions, #multiplications, #divisions, #roots, #transcendentals))
}

/// The whole output of the derive.
pub fn emit(derived: &Derived<'_, '_>) -> TokenStream {
    let model = derived.model;
    let (runtime, visibility, ident) = (&model.runtime, &model.visibility, &model.ident);
    let scalar = derived.scalar();
    let (ty, real) = (scalar.ty(), &scalar.real);
    let name = derived.kernel_name();
    let fields = derived.constant_fields();
    let n = derived.degrees_of_freedom();
    let generic = matches!(model.scalar, Scalar::Parameter(_));
    let (declared, bounded, used) =
        if generic { (quote!(<#ty>), quote!(<#ty: #real>), quote!(<#ty>)) } else { Default::default() };
    let (impl_generics, type_generics, where_clause) = model.generics.split_for_impl();
    let predicates = where_clause.map(|w| {
        let predicates = w.predicates.iter();
        quote!(#(#predicates,)*)
    });
    let bound = generic.then(|| quote!(#ty: #real,));
    let sections = derived.scene.equations();
    let (text, latex) = (text(derived, &sections), latex(&sections));
    let documentation = rustdoc(derived, &text);
    let kernel_body = kernel_body(derived);
    let chart = derived.chart_tokens();
    let configuration = derived.configuration_type();
    let (pose, configuration_of_pose) = derived.pose_bodies();
    let kernel_doc = format!(
        "Checks the parameters and computes once whatever depends on them alone: the kernel of [`{ident}`].\n\n\
         # Errors\nEvery parameter that no body can have, with its field, value and the rule it breaks."
    );
    let operations = {
        let rows = derived.formulas.iter().zip(&derived.kernel.functions).filter(|(f, _)| f.method < Method::BodyTwist);
        let rows = rows.map(|(f, program)| {
            let (field, count) =
                (Ident::new(method_name(f.method), Span::call_site()), count_tokens(runtime, program.counts()));
            quote!(#field: #count)
        });
        let kernel = count_tokens(runtime, derived.kernel.constants.counts());
        quote!(#runtime::system::Operations { kernel: #kernel, #(#rows),* })
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
    let methods = methods.into_iter().map(write);
    let six = quote!(#runtime::prelude::SVector<Self::Scalar, 6>);
    let twist_methods = [
        (Method::BodyTwist, quote!(z: &Self::Speeds), six.clone()),
        (Method::Speeds, quote!(twist: &#six), quote!(Self::Speeds)),
        (Method::BodyMomentum, quote!(z: &Self::Speeds), six),
    ];
    let twist_methods = twist_methods.into_iter().map(write);
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
            }

            #[automatically_derived]
            #[allow(unused_variables, clippy::all, clippy::pedantic)]
            impl #bounded #runtime::system::GaussSystem for #name #used {
                type Scalar = #ty;
                type Configuration = #configuration;
                type Speeds = #runtime::prelude::SVector<#ty, #n>;
                type MassMatrix = #runtime::prelude::SMatrix<#ty, #n, #n>;
                type Input = ();
                const DOF: ::core::primitive::usize = #n;
                const CHART: #runtime::chart::Chart = #chart;
                const EQUATIONS: #runtime::system::Equations = #runtime::system::Equations { text: #text, latex: #latex };
                const OPERATIONS: #runtime::system::Operations = #operations;
                #(#methods)*
            }

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
        };
    }
}
