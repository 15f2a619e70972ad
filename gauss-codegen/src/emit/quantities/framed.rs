//! `FramedSystem`: poses, twists, Jacobians and accelerations of the frames that are wanted, and their names;
//! `JacobianRates`.

use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};

use crate::mechanics::{FrameQuantity, Method};
use crate::terms::Item;
use crate::words::Unraw;

use crate::emit::derived::Derived;
use crate::emit::dialect::arguments::{arguments_of, declared};

/// Operations of the methods, frame by frame.
pub fn frame_operations(derived: &Derived<'_, '_>) -> Option<TokenStream> {
    let private = derived.private();
    let of = |(number, frame): (usize, &Ident)| {
        let name = frame.unraw().to_string();
        let counts = FrameQuantity::ALL.map(|quantity| {
            derived.program(Method::OfFrame(quantity, number)).map(|program| derived.count(program.counts()))
        });
        let counts = counts.into_iter().flatten();
        let rate = Method::OfFrame(FrameQuantity::JacobianRate, number);
        let rate = derived.program(rate).map(|program| derived.count(program.counts()));
        let rate = rate.map(|count| quote!(.with_jacobian_rate(#count)));
        quote!(#private::FrameOperations::new(#name, [#(#counts),*]) #rate)
    };
    let all: Vec<TokenStream> = derived.frames().iter().enumerate().map(of).collect();
    (!all.is_empty()).then(|| quote!(of_frames = &[#(#all),*]))
}

/// The name of the enum.
pub fn name_of_frames(item: &Item) -> Ident {
    format_ident!("{}Frame", item.ident)
}

/// The enum of names; the implementations.
pub fn framed_system(derived: &Derived<'_, '_>) -> [Option<TokenStream>; 2] {
    let Some(system) = system(derived) else { return [None, None] };
    let ([names, named], rates) = (names(derived), jacobian_rates(derived));
    [Some(names), Some(quote!(#named #system #rates))]
}

fn jacobian_rates(derived: &Derived<'_, '_>) -> Option<TokenStream> {
    derived.program(Method::OfFrame(FrameQuantity::JacobianRate, 0))?;
    let method = method(derived, FrameQuantity::JacobianRate, &quote!(Self::Jacobian));
    Some(derived.implementation(quote!(JacobianRates), method))
}

fn names(derived: &Derived<'_, '_>) -> [TokenStream; 2] {
    let frames = derived.frames();
    let words: Vec<String> = frames.iter().map(|frame| word(derived.item(), frame)).collect();
    let documentation = format!("Frames of [`{}`] whose motion its kernel computes.", derived.item().ident);
    let labels = words.iter().map(|word| format!("The body or frame `{word}`.")).collect();
    enumerated(derived, (&name_of_frames(derived.item()), documentation), (frames, &words, labels))
}

/// An enum of names; its implementation of `FrameName`.
pub fn enumerated(
    derived: &Derived<'_, '_>,
    (name, documentation): (&Ident, String),
    (frames, words, label): (&[Ident], &[String], Vec<String>),
) -> [TokenStream; 2] {
    let (private, visibility) = (derived.private(), &derived.item().visibility);
    let places = 0..frames.len();
    let names = quote! {
        #[doc = #documentation]
        #[derive(::core::clone::Clone, ::core::marker::Copy, ::core::fmt::Debug, ::core::cmp::PartialEq, ::core::cmp::Eq, ::core::hash::Hash)]
        #[allow(non_camel_case_types)]
        #visibility enum #name { #(#[doc = #label] #frames),* }
    };
    let named = quote! {
        #[automatically_derived]
        impl #private::FrameName for #name {
            const ALL: &'static [Self] = &[#(Self::#frames),*];
            #[inline]
            fn name(self) -> &'static ::core::primitive::str {
                match self { #(Self::#frames => #words),* }
            }
            #[inline]
            fn index(self) -> ::core::primitive::usize {
                match self { #(Self::#frames => #places),* }
            }
        }
    };
    [names, named]
}

/// Name of a frame in the file that it comes from, or in the scene.
fn word(item: &Item, frame: &Ident) -> String {
    let mut called = item.described.iter().flat_map(|file| &file.called);
    let own = called.find(|(ident, _)| ident.unraw() == frame.unraw());
    own.map_or_else(|| frame.unraw().to_string(), |(_, word)| word.clone())
}

fn system(derived: &Derived<'_, '_>) -> Option<TokenStream> {
    let of_all = derived.program(Method::Frames)?;
    let (private, ty, n) = (derived.private(), derived.scalar().ty(), derived.degrees_of_freedom());
    let (name, count) = (name_of_frames(derived.item()), derived.frames().len());
    let jacobian = quote!(#private::SMatrix<#ty, 6, #n>);
    let six = quote!(#private::SVector<#ty, 6>);
    let methods = [
        (FrameQuantity::Pose, quote!(#private::IsometryMatrix3<#ty>)),
        (FrameQuantity::Twist, six.clone()),
        (FrameQuantity::Jacobian, jacobian.clone()),
        (FrameQuantity::Bias, six),
    ];
    let methods = methods.map(|(quantity, result)| method(derived, quantity, &result));
    let (instructions, outputs) = derived.computed(of_all);
    let size = outputs.len() / count;
    let all = outputs.chunks(size).map(|of_frame| {
        let mut rest = of_frame;
        let parts = FrameQuantity::ALL.map(|quantity| {
            let (own, after) = rest.split_at(size_of(quantity, n));
            rest = after;
            made(&derived.private(), quantity, own)
        });
        quote!(#private::FrameMotion::new(#(#parts),*))
    });
    let body = quote!(#instructions #private::ByFrame::new([#(#all),*]));
    let frames = derived.function_of("frames", arguments_of(Method::Frames), quote!(Self::Frames), body);
    let items = quote! {
        type Frame = #name;
        type Jacobian = #jacobian;
        type Frames = #private::ByFrame<#name, #private::FrameMotion<#ty, #jacobian>, #count>;
        #(#methods)*
        #[inline]
        #frames
    };
    Some(derived.implementation(quote!(FramedSystem), items))
}

/// One quantity of any frame.
fn method(derived: &Derived<'_, '_>, quantity: FrameQuantity, result: &TokenStream) -> TokenStream {
    let enumeration = name_of_frames(derived.item());
    let arms = derived.frames().iter().enumerate().filter_map(|(number, frame)| {
        let (instructions, outputs) = derived.computed(derived.program(Method::OfFrame(quantity, number))?);
        let value = made(&derived.private(), quantity, &outputs);
        Some(quote!(#enumeration::#frame => { #instructions #value }))
    });
    let of_first = Method::OfFrame(quantity, 0);
    let (name, arguments) =
        (format_ident!("{}", of_first.name()), declared(&derived.private(), arguments_of(of_first)));
    quote! {
        #[inline]
        fn #name(
            &self,
            __frame: Self::Frame,
            __t: Self::Scalar,
            __q: &Self::Configuration,
            #(#arguments),*
        ) -> #result {
            match __frame { #(#arms),* }
        }
    }
}

/// Number of entries of a quantity in a system of n speeds.
fn size_of(quantity: FrameQuantity, n: usize) -> usize {
    match quantity {
        FrameQuantity::Pose => 12,
        FrameQuantity::Twist | FrameQuantity::Bias => 6,
        FrameQuantity::Jacobian | FrameQuantity::JacobianRate => 6 * n,
    }
}

/// Outputs as a value of the runtime.
fn made(private: &TokenStream, quantity: FrameQuantity, outputs: &[TokenStream]) -> TokenStream {
    match quantity {
        FrameQuantity::Pose => {
            let (position, rows) = (&outputs[..3], outputs[3..].chunks(3));
            let rows = rows.map(|row| quote!([#(#row),*]));
            quote!(#private::frame_pose([#(#position),*], [#(#rows),*]))
        }
        FrameQuantity::Twist | FrameQuantity::Bias => quote!(#private::vector([#(#outputs),*])),
        FrameQuantity::Jacobian | FrameQuantity::JacobianRate => {
            let rows = outputs.chunks(outputs.len() / 6).map(|row| quote!([#(#row),*]));
            quote!(#private::matrix([#(#rows),*]))
        }
    }
}
