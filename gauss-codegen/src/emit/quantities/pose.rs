//! The configuration of one body as a pose, and back.

use proc_macro2::TokenStream;
use quote::quote;

use crate::mechanics::Coordinate;
use crate::terms::{BodyChart, Motion};

use crate::emit::chart::rotation_chart_tokens;
use crate::emit::derived::Derived;

/// `pose` and `configuration`: the configuration as a pose and back.
pub fn pose_bodies(derived: &Derived<'_, '_>, own: Option<BodyChart>) -> Option<(TokenStream, TokenStream)> {
    let private = derived.private();
    let chart = own.map(|own| rotation_chart_tokens(&derived.private(), own.chart));
    let coordinate = &derived.subject.system.scene.coordinates[0];
    Some(match (coordinate, own.map(|own| own.motion)) {
        (Coordinate::Pose(..), _) => (quote!(*__q), quote!(#private::free_pose(__pose))),
        (Coordinate::Rotation(_), _) => {
            (quote!(#private::pose_of_rotation(__q)), quote!(#private::rotation_of_pose(__pose)))
        }
        (Coordinate::Plane { .. }, _) => {
            (quote!(#private::pose_of_plane(__q)), quote!(#private::plane_of_pose(__pose)))
        }
        (Coordinate::Scalar(_), Some(Motion::Planar)) => (
            quote!(#private::pose_of_plane_chart(#private::components(__q))),
            quote!(#private::plane_chart_of_pose(__pose).map(#private::vector)),
        ),
        (Coordinate::Scalar(_), Some(Motion::FixedPoint)) => (
            quote!(#private::pose_of_rotation_chart(#chart, #private::components(__q))),
            quote!(#private::rotation_chart_of_pose(#chart, __pose).map(#private::vector)),
        ),
        (Coordinate::Scalar(_), Some(Motion::Free)) => (
            quote! {
                let [__b1, __b2, __b3, __a1, __a2, __a3] = #private::components(__q);
                #private::pose_of_chart(#chart, [__a1, __a2, __a3], [__b1, __b2, __b3])
            },
            quote! {
                #private::chart_of_pose(#chart, __pose)
                    .map(|([__a1, __a2, __a3], [__b1, __b2, __b3])| {
                        #private::vector([__b1, __b2, __b3, __a1, __a2, __a3])
                    })
            },
        ),
        (Coordinate::Scalar(_), None) => return None,
    })
}
