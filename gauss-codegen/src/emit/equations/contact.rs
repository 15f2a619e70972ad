//! `ContactSystem`: gaps, rates, W, Delassus' matrix and the motion without contact forces.

use proc_macro2::TokenStream;
use quote::quote;

use crate::mechanics::Method;

use crate::emit::derived::{Derived, KernelGenerics};
use crate::emit::dialect::arguments::{arguments_of, declared};
use crate::program::ArgumentKind;

pub fn contact_system(derived: &Derived<'_, '_>) -> Option<TokenStream> {
    let (private, ty, n) = (derived.private(), derived.scalar().ty(), derived.degrees_of_freedom());
    let (count, rows) = (derived.subject.system.scene.contacts.len(), derived.subject.system.contacts.rates.len());
    let listed = listed(derived);
    let restitution = derived.method_body(Method::Restitution)?;
    let methods = [
        (Method::Gaps, quote!(Self::Gaps)),
        (Method::ContactRates, quote!(Self::ContactRows)),
        (Method::ContactJacobian, quote!(Self::ContactColumns)),
        (Method::Friction, quote!(Self::ContactRows)),
    ];
    let methods = methods.into_iter().filter_map(|(method, result)| derived.function(method, result));
    let (of_impulses, of_motion) = (of_impulses(derived)?, of_motion(derived)?);
    let (factors, velocities) = velocities(derived)?;
    let frames = frames(derived);
    let items = quote! {
        type Gaps = #private::SVector<#ty, #count>;
        type ContactRows = #private::SVector<#ty, #rows>;
        type ContactColumns = #private::SMatrix<#ty, #n, #rows>;
        type ImpulseFactors = #factors;
        type Delassus = #private::SMatrix<#ty, #rows, #rows>;
        type EachContact<__T: ::core::marker::Copy + ::core::fmt::Debug> = [__T; #count];
        type EachRow<__T: ::core::marker::Copy + ::core::fmt::Debug> = [__T; #rows];
        #[inline]
        fn contacts(&self) -> &'static [#private::Contact] {
            Self::CONTACTS
        }
        #(#methods)*
        #frames
        #[inline]
        fn restitution(&self) -> Self::Gaps { #restitution }
        #[inline]
        #of_impulses
        #[inline]
        #of_motion
        #velocities
    };
    let (kernel, KernelGenerics { bounded, used, .. }) = (derived.kernel_name(), derived.kernel_generics());
    let system = derived.implementation(quote!(ContactSystem), items);
    Some(quote! {
        #system
        #[automatically_derived]
        impl #bounded #kernel #used {
            /// The contacts, in the order in which they are written.
            pub const CONTACTS: &'static [#private::Contact] = &[#(#listed),*];
        }
    })
}

/// `impulse_response`.
fn of_impulses(derived: &Derived<'_, '_>) -> Option<TokenStream> {
    let private = derived.private();
    let (mut body, outputs) = derived.computed(derived.program(Method::ImpulseResponse)?);
    let (effect, delassus) = effect(derived, &outputs);
    body.extend(quote!(#private::ImpulseResponse::new(#effect, #delassus)));
    let arguments = arguments_of(Method::ImpulseResponse);
    Some(derived.function_of("impulse_response", arguments, quote!(#private::ImpulseResponse<Self>), body))
}

/// `impulse_dynamics`.
fn of_motion(derived: &Derived<'_, '_>) -> Option<TokenStream> {
    let (private, n, rows) =
        (derived.private(), derived.degrees_of_freedom(), derived.subject.system.contacts.rates.len());
    let (mut body, outputs) = derived.computed(derived.program(Method::ImpulseDynamics)?);
    let (acceleration, rest) = outputs.split_at(n);
    let (bias, rest) = rest.split_at(rows);
    let (effect, delassus) = effect(derived, rest);
    body.extend(quote! {
        #private::ImpulseDynamics::new(
            #private::vector([#(#acceleration),*]),
            #private::vector([#(#bias),*]),
            #private::ImpulseResponse::new(#effect, #delassus)
        )
    });
    let arguments = arguments_of(Method::ImpulseDynamics);
    Some(derived.function_of("impulse_dynamics", arguments, quote!(#private::ImpulseDynamics<Self>), body))
}

/// The frame of one contact: all of them are computed, since only one of them is rarely wanted.
fn frames(derived: &Derived<'_, '_>) -> Option<TokenStream> {
    let private = derived.private();
    let (body, outputs) = derived.computed(derived.program(Method::ContactFrames)?);
    let vector = |of: &[TokenStream]| quote!(#private::vector([#(#of),*]));
    let mut vectors = outputs.chunks(3).map(vector);
    let each = derived.subject.contacts().into_iter().map(|contact| match contact.axes {
        0 => quote!(::core::option::Option::None),
        count => {
            let point = vectors.next();
            let axes: Vec<TokenStream> = vectors.by_ref().take(count).collect();
            let (normal, tangents) = axes.split_first().map_or((None, &[][..]), |(normal, rest)| (Some(normal), rest));
            quote!(::core::option::Option::Some(#private::ContactFrame::new(#point, #normal, &[#(#tangents),*])))
        }
    });
    let each: Vec<TokenStream> = each.collect();
    Some(quote! {
        fn contact_frame(
            &self,
            __contact: ::core::primitive::usize,
            __t: Self::Scalar,
            __q: &Self::Configuration,
        ) -> ::core::option::Option<#private::ContactFrame<Self::Scalar>> {
            #body
            [#(#each),*].get(__contact).copied().flatten()
        }
    })
}

/// The contacts with the numbers of their rows.
fn listed(derived: &Derived<'_, '_>) -> Vec<TokenStream> {
    let private = derived.private();
    let mut next = 0;
    let contacts = derived.subject.contacts().into_iter().map(|contact| {
        let (name, first, tangents) = (&contact.name, next, contact.tangents);
        next += contact.rows();
        let drilling = if contact.drills { quote!(.with_drilling()) } else { quote!() };
        let moving = if contact.moves { quote!(.moving()) } else { quote!() };
        let between = between(&contact.bodies);
        match contact.rolls_on {
            _ if contact.has_gap => quote!(#private::Contact::new(#name, #first, #tangents)#drilling #moving #between),
            Some(on) => quote!(#private::Contact::rolling(#name, #first, #tangents, #on)#between),
            None => quote!(#private::Contact::dry_friction(#name, #first, #tangents)),
        }
    });
    contacts.collect()
}

/// The names of bodies that touch, where one is known.
fn between(bodies: &[Option<String>; 2]) -> TokenStream {
    let name = |body: &Option<String>| match body {
        Some(name) => quote!(::core::option::Option::Some(#name)),
        None => quote!(::core::option::Option::None),
    };
    let names = bodies.iter().map(name);
    if bodies.iter().any(Option::is_some) { quote!(.between([#(#names),*])) } else { quote!() }
}

/// A⁻¹Wᵀ or the numbers of its halves, and D.
fn effect(derived: &Derived<'_, '_>, outputs: &[TokenStream]) -> (TokenStream, TokenStream) {
    let (private, rows) = (derived.private(), derived.subject.system.contacts.rates.len());
    let (effect, delassus) = outputs.split_at(outputs.len() - rows * rows);
    let matrix = |entries: &[TokenStream]| {
        let rows = entries.chunks(rows).map(|row| quote!([#(#row),*]));
        quote!(#private::matrix([#(#rows),*]))
    };
    let effect =
        if derived.formal().factors.is_empty() { matrix(effect) } else { quote!(#private::vector([#(#effect),*])) };
    (effect, matrix(delassus))
}

/// The type of what makes velocities of impulses, and the methods that do.
fn velocities(derived: &Derived<'_, '_>) -> Option<(TokenStream, TokenStream)> {
    let (private, ty) = (derived.private(), derived.scalar().ty());
    let declared = declared(&private, &[ArgumentKind::Factors, ArgumentKind::Impulses]);
    let (factors, velocities, terms, columns) = match derived.formal().factors.len() {
        0 => {
            let velocities = quote!(#private::impulse_velocities::<Self>(__factors, __impulses));
            let terms = quote!(#private::impulse_terms::<Self>(__factors, __impulses));
            (quote!(Self::ContactColumns), velocities, terms, quote!(*__factors))
        }
        count => {
            let velocities = derived.method_body(Method::ImpulseVelocities)?;
            let pivots = derived.degrees_of_freedom();
            let rows = derived.subject.system.halves()?.first_of_rows();
            let terms = quote!(#private::impulse_terms_of_halves(self, (__factors, __impulses), #pivots..#rows));
            (
                quote!(#private::SVector<#ty, #count>),
                velocities,
                terms,
                quote!(#private::contact_columns(self, __factors)),
            )
        }
    };
    let methods = quote! {
        #[inline]
        fn impulse_velocities(&self, #(#declared),*) -> Self::Speeds { #velocities }
        #[inline]
        fn impulse_terms(&self, #(#declared),*) -> Self::Speeds { #terms }
        #[inline]
        fn contact_columns(&self, __factors: &Self::ImpulseFactors) -> Self::ContactColumns { #columns }
    };
    Some((factors, methods))
}
