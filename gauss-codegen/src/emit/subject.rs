//! The system that is derived: its configuration as a product, its constraints, and where what its author wrote is
//! read.

use proc_macro2::TokenStream;
use quote::quote;

use crate::algebra::{Expr, Map};
use crate::description::ContactDescription;
use crate::mechanics::{Constraints, Coordinate, Method, System};
use crate::translate::Provenance;

use crate::emit::chart::chart_tokens;
use crate::emit::dialect::arguments::ArrayArgument;

/// The system that is derived.
pub struct Subject<'a, 'g> {
    /// Names, units and other data that are only written down.
    pub provenance: &'a Provenance<'g>,
    pub system: &'a System<'g>,
    /// The constraints, and whether a run can drift away from them.
    pub constraints: &'a Constraints<'g>,
    pub can_drift: bool,
    /// Components x, y, z, w of the unit quaternions behind rotations, one for each coordinate.
    pub quaternions: &'a [Option<[Expr<'g>; 4]>],
    /// Entries of their matrices in terms of these.
    pub definitions: &'a Map<u32, Expr<'g>>,
}

/// A factor of the configuration: elements of groups in the order in which they are declared, then all scalars
/// together.
enum Factor<'g> {
    Group { coordinate: usize },
    Scalars { symbols: Vec<Expr<'g>> },
}

impl<'g> Subject<'_, 'g> {
    fn coordinates(&self) -> &[Coordinate<'g>] {
        &self.system.scene.coordinates
    }

    fn factors(&self) -> Vec<Factor<'g>> {
        let mut scalars = Vec::new();
        let mut factors = Vec::new();
        for (coordinate, written) in self.coordinates().iter().enumerate() {
            match written {
                Coordinate::Scalar(symbol) => scalars.push(*symbol),
                _ => factors.push(Factor::Group { coordinate }),
            }
        }
        if !scalars.is_empty() || factors.is_empty() {
            factors.push(Factor::Scalars { symbols: scalars });
        }
        factors
    }

    /// `A`, `(A, B)`, `(A, (B, C))`…
    pub fn configuration_type(&self, private: &TokenStream, ty: &TokenStream) -> TokenStream {
        let types = self.factors().into_iter().map(|factor| match factor {
            Factor::Scalars { symbols } => {
                let n = symbols.len();
                quote!(#private::SVector<#ty, #n>)
            }
            Factor::Group { coordinate } => match self.coordinates()[coordinate] {
                Coordinate::Pose(..) => quote!(#private::Isometry3<#ty>),
                Coordinate::Plane { .. } => quote!(#private::Isometry2<#ty>),
                _ => quote!(#private::UnitQuaternion<#ty>),
            },
        });
        nested(types, |a, b| quote!((#a, #b)))
    }

    /// The configuration taken apart.
    pub fn configuration_arguments(&self, private: &TokenStream) -> Vec<ArrayArgument<'g>> {
        let factors = self.factors();
        let last = factors.len() - 1;
        let mut arguments = Vec::new();
        for (k, factor) in factors.into_iter().enumerate() {
            let place = place(k, last);
            match factor {
                Factor::Scalars { symbols } => {
                    arguments.push(ArrayArgument { array: quote!(#private::components(#place)), symbols });
                }
                Factor::Group { coordinate } => {
                    let quaternion = self.quaternions[coordinate].map(|q| q.to_vec()).unwrap_or_default();
                    match &self.coordinates()[coordinate] {
                        Coordinate::Pose(_, position) => {
                            let array = quote!(#private::isometry3(#place));
                            arguments.push(ArrayArgument { array: quote!(#array.0), symbols: quaternion });
                            arguments.push(ArrayArgument { array: quote!(#array.1), symbols: position.to_vec() });
                        }
                        Coordinate::Plane { turn, position } => {
                            let array = quote!(#private::isometry2(#place));
                            arguments.push(ArrayArgument { array: quote!(#array.0), symbols: turn.to_vec() });
                            arguments.push(ArrayArgument { array: quote!(#array.1), symbols: position.to_vec() });
                        }
                        _ => arguments
                            .push(ArrayArgument { array: quote!(#private::quaternion(#place)), symbols: quaternion }),
                    }
                }
            }
        }
        arguments
    }

    /// The coordinates in their order, each as its value in `__q`.
    pub fn places_of_coordinates(&self, private: &TokenStream) -> Vec<TokenStream> {
        let factors = self.factors();
        let last = factors.len() - 1;
        let mut places = vec![TokenStream::new(); self.coordinates().len()];
        let scalars: Vec<usize> =
            (0..places.len()).filter(|&k| matches!(self.coordinates()[k], Coordinate::Scalar(_))).collect();
        for (k, factor) in factors.iter().enumerate() {
            let place = place(k, last);
            match factor {
                Factor::Group { coordinate } => places[*coordinate] = quote!(*#place),
                Factor::Scalars { .. } => {
                    for (component, &coordinate) in scalars.iter().enumerate() {
                        places[coordinate] = quote!(#private::components(#place)[#component]);
                    }
                }
            }
        }
        places
    }

    /// The configuration that has these coordinates.
    pub fn configuration_of(&self, private: &TokenStream, values: &[TokenStream]) -> TokenStream {
        let (mut groups, mut scalars) = (Vec::new(), Vec::new());
        for (coordinate, value) in self.coordinates().iter().zip(values) {
            match coordinate {
                Coordinate::Scalar(_) => scalars.push(value.clone()),
                _ => groups.push(value.clone()),
            }
        }
        if !scalars.is_empty() || groups.is_empty() {
            groups.push(quote!(#private::vector([#(#scalars),*])));
        }
        nested(groups, |a, b| quote!((#a, #b)))
    }

    /// The configuration with all groups at the identity and all scalars zero.
    pub fn unmoved(&self, private: &TokenStream) -> TokenStream {
        let values = self.coordinates().iter().map(|coordinate| match coordinate {
            Coordinate::Scalar(_) => quote!(<Self::Scalar as #private::Real>::zero()),
            Coordinate::Rotation(_) => quote!(#private::unturned()),
            Coordinate::Pose(..) => quote!(#private::unmoved()),
            Coordinate::Plane { .. } => quote!(#private::unmoved_in_plane()),
        });
        self.configuration_of(private, &values.collect::<Vec<_>>())
    }

    /// The contacts in words.
    pub fn contacts(&self) -> Vec<ContactDescription> {
        let contacts = self.system.scene.contacts.iter().map(|contact| ContactDescription {
            name: contact.name.clone(),
            has_gap: contact.gap.is_some(),
            tangents: contact.slips.len() - usize::from(contact.drills),
            drills: contact.drills,
            rolls_on: contact.rolls_on,
            bodies: contact.bodies.clone(),
            moves: contact.gap.is_some_and(|gap| !gap.partial(self.system.scene.time).is_zero()),
            axes: contact.frame.as_ref().map_or(0, |frame| frame.axes.len()),
        });
        contacts.collect()
    }

    /// Places of the components of an increment of the configuration among those in the order of the coordinates:
    /// groups come first, then all scalars.
    pub fn increment_places(&self) -> Vec<usize> {
        let mut next = 0;
        let (mut groups, mut scalars) = (Vec::new(), Vec::new());
        for coordinate in self.coordinates() {
            let own = next..next + coordinate.size();
            next = own.end;
            if matches!(coordinate, Coordinate::Scalar(_)) { &mut scalars } else { &mut groups }.extend(own);
        }
        [groups, scalars].concat()
    }

    /// The components of an increment of the configuration, in the order of the coordinates, as its type.
    pub fn tangent(&self, private: &TokenStream, outputs: &[TokenStream]) -> TokenStream {
        let mut groups = Vec::new();
        let mut scalars = Vec::new();
        let mut rest = outputs;
        for coordinate in self.coordinates() {
            let (own, after) = rest.split_at(coordinate.size());
            rest = after;
            match coordinate {
                Coordinate::Scalar(_) => scalars.extend(own),
                _ => groups.push(quote!(#private::vector([#(#own),*]))),
            }
        }
        if !scalars.is_empty() || groups.is_empty() {
            groups.push(quote!(#private::vector([#(#scalars),*])));
        }
        nested(groups, |a, b| quote!(#private::product(#a, #b)))
    }

    /// The chart that the speeds belong to.
    pub fn chart_tokens(&self, private: &TokenStream) -> TokenStream {
        match self.system.scene.chart() {
            Some(own) => chart_tokens(private, own.chart),
            None => quote!(#private::Chart::Own),
        }
    }

    /// `project` of the kernel's [`GaussSystem`], where there is something to project to.
    pub fn projection(&self, private: &TokenStream) -> TokenStream {
        if !self.can_drift {
            return TokenStream::new();
        }
        quote! {
            const CONSTRAINED: ::core::primitive::bool = true;
            #[inline]
            fn project(
                &self,
                __t: Self::Scalar,
                __q: &Self::Configuration,
                __z: &Self::Speeds,
            ) -> ::core::result::Result<(Self::Configuration, Self::Speeds), #private::ProjectionError> {
                #private::project(self, __t, __q, __z)
            }
            #[inline]
            fn dependence(&self, __t: Self::Scalar, __q: &Self::Configuration, __z: &Self::Speeds) -> Self::Speeds {
                #private::dependence(self, __t, __q, __z)
            }
        }
    }

    /// The methods of constrained systems with their results.
    pub fn constraint_methods(&self, private: &TokenStream) -> [(Method, TokenStream); 5] {
        let multipliers = quote!(Self::Multipliers);
        [
            (Method::Multipliers, multipliers.clone()),
            (Method::PositionResidual, multipliers.clone()),
            (Method::VelocityResidual, multipliers),
            (Method::PositionCorrection, quote!(<Self::Configuration as #private::Configuration>::Tangent)),
            (Method::VelocityCorrection, quote!(Self::Speeds)),
        ]
    }
}

/// Factor k of `__q`, of which the last is `last`.
fn place(k: usize, last: usize) -> TokenStream {
    if last == 0 {
        return quote!(__q);
    }
    let deeper = (0..k).map(|_| quote!(.1));
    let own = if k < last { quote!(.0) } else { quote!() };
    quote!((&__q #(#deeper)* #own))
}

fn nested(
    parts: impl IntoIterator<Item = TokenStream>,
    pair: impl Fn(TokenStream, TokenStream) -> TokenStream,
) -> TokenStream {
    let parts: Vec<TokenStream> = parts.into_iter().collect();
    parts.into_iter().rev().reduce(|inner, outer| pair(outer, inner)).unwrap_or_default()
}
