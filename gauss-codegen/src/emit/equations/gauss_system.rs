//! `GaussSystem`: the equations of motion.

use proc_macro2::TokenStream;
use quote::quote;

use crate::kernel::Smoothness;
use crate::mechanics::Method;

use crate::emit::derived::Derived;
use crate::emit::dialect::arguments::OF_EQUATIONS;
use crate::emit::equations::constrained::projection;
use crate::emit::subject::Subject;

pub fn gauss_system(derived: &Derived<'_, '_>) -> TokenStream {
    let (types, smoothness) = (types(derived), smoothness(derived));
    let (methods, evaluate, projection) = (methods(derived), evaluate(derived), projection(derived));
    let (contacts, states) = (contacts(derived), states(&derived.subject));
    let items = quote! {
        #types
        #smoothness
        #contacts
        #states
        #methods
        #evaluate
        #projection
    };
    derived.implementation(quote!(GaussSystem), items)
}

/// Associated types, degrees of freedom, chart.
fn types(derived: &Derived<'_, '_>) -> TokenStream {
    let (private, ty, n) = (derived.private(), derived.scalar().ty(), derived.degrees_of_freedom());
    let (configuration, chart) =
        (derived.subject.configuration_type(&private, &ty), derived.subject.chart_tokens(&derived.private()));
    let input = match derived.formal().inputs.len() {
        0 => quote!(()),
        count => quote!(#private::SVector<#ty, #count>),
    };
    quote! {
        type Scalar = #ty;
        type Configuration = #configuration;
        type Speeds = #private::SVector<#ty, #n>;
        type MassMatrix = #private::SMatrix<#ty, #n, #n>;
        type Input = #input;
        const DOF: ::core::primitive::usize = #n;
        const CHART: #private::Chart = #chart;
    }
}

/// Number of the states of elements, as a constant.
fn states(subject: &Subject<'_, '_>) -> Option<TokenStream> {
    let states = subject.system.scene.states.len();
    (states > 0).then(|| {
        quote!(
            const STATES: ::core::primitive::usize = #states;
        )
    })
}

/// Whether gaps may close, and whether only they can raise the energy then.
fn contacts(derived: &Derived<'_, '_>) -> Option<TokenStream> {
    let keeps_energy = derived.keeps_energy();
    (!derived.subject.system.contacts.is_empty()).then(|| {
        quote!(
            const HAS_CONTACTS: ::core::primitive::bool = true;
            const KEEPS_ENERGY: ::core::primitive::bool = #keeps_energy;
        )
    })
}

/// Smoothness of the loads and the rates of states: kinematics are smooth where they are regular.
fn smoothness(derived: &Derived<'_, '_>) -> Option<TokenStream> {
    let word = match derived.smoothness() {
        Smoothness::Smooth => return None,
        Smoothness::Kinks => quote!(Kinks),
        Smoothness::Jumps => quote!(Jumps),
    };
    let private = derived.private();
    let smoothness = quote!(#private::Smoothness);
    Some(quote!(const SMOOTHNESS: #smoothness = #smoothness::#word;))
}

fn methods(derived: &Derived<'_, '_>) -> TokenStream {
    let private = derived.private();
    let [speeds, matrix, scalar] = [quote!(Self::Speeds), quote!(Self::MassMatrix), quote!(Self::Scalar)];
    let tangent = quote!(<Self::Configuration as #private::Configuration>::Tangent);
    let methods = [
        (Method::Acceleration, &speeds),
        (Method::Momentum, &speeds),
        (Method::Velocity, &speeds),
        (Method::MomentumRate, &speeds),
        (Method::MassMatrix, &matrix),
        (Method::KineticEnergy, &scalar),
        (Method::PotentialEnergy, &scalar),
        (Method::GaussResidual, &speeds),
        (Method::ConstraintFunction, &scalar),
        (Method::Kinematics, &tangent),
        (Method::ConfigurationRates, &tangent),
        (Method::Regularity, &scalar),
        (Method::NonlinearEffects, &speeds),
    ];
    methods.into_iter().filter_map(|(method, result)| derived.function(method, result.clone())).collect()
}

/// `evaluate`: q̇, ż and the energies at once.
fn evaluate(derived: &Derived<'_, '_>) -> TokenStream {
    let private = derived.private();
    let (mut body, outputs) = derived.computed(&derived.kernel.joined);
    let (configuration, rest) = outputs.split_at(derived.increments());
    let (speeds, energies) = rest.split_at(derived.degrees_of_freedom());
    let velocity = derived.subject.tangent(&derived.private(), configuration);
    body.extend(quote! {
        let [__kinetic, __potential] = [#(#energies),*];
        #private::Evaluated::new(#velocity, #private::vector([#(#speeds),*]), __kinetic, __potential)
    });
    let function = derived.function_of("evaluate", OF_EQUATIONS, quote!(#private::Evaluated<Self>), body);
    quote!(#[inline] #function)
}
