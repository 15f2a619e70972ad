//! What is particular to one body in a chart: the names of charts, and the configuration as a pose.

use proc_macro2::TokenStream;
use quote::quote;

use crate::mechanics::Coordinate;
use crate::model::{Chart, InChart, Motion, RotationChart};

use super::derived::Derived;

pub fn chart_name(chart: Chart) -> String {
    match chart {
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

pub fn motion_name(motion: Motion) -> &'static str {
    match motion {
        Motion::Free => "free",
        Motion::FixedPoint => "fixed_point",
        Motion::Planar => "planar",
    }
}

fn rotation_chart_tokens(private: &TokenStream, chart: Chart) -> TokenStream {
    let path = quote!(#private::RotationChart);
    match chart {
        Chart::Jet(RotationChart::Euler([a, b, c])) => {
            quote!(#path::Euler(#private::EulerSequence { axes: [#a, #b, #c] }))
        }
        Chart::Jet(RotationChart::Rodrigues) => quote!(#path::Rodrigues),
        Chart::Jet(RotationChart::ModifiedRodrigues) => quote!(#path::ModifiedRodrigues),
        _ => quote!(#path::Angle),
    }
}

pub fn chart_tokens(private: &TokenStream, chart: Chart) -> TokenStream {
    let path = quote!(#private::Chart);
    match chart {
        Chart::LeftInvariant => quote!(#path::LeftInvariant),
        Chart::RightInvariant => quote!(#path::RightInvariant),
        Chart::Hybrid => quote!(#path::Hybrid),
        Chart::Jet(_) => {
            let rotation = rotation_chart_tokens(private, chart);
            quote!(#path::Jet(#rotation))
        }
    }
}

/// `pose` and `configuration`: the configuration as a pose and back.
pub fn pose_bodies(derived: &Derived<'_, '_>, own: Option<InChart>) -> Option<(TokenStream, TokenStream)> {
    let private = derived.private();
    let chart = own.map(|own| rotation_chart_tokens(&derived.private(), own.chart));
    let coordinate = &derived.subject.system.scene.coordinates[0];
    Some(match (coordinate, own.map(|own| own.motion)) {
        (Coordinate::Pose(..), _) => (quote!(*q), quote!(#private::free_pose(pose))),
        (Coordinate::Rotation(_), _) => {
            (quote!(#private::pose_of_rotation(q)), quote!(#private::rotation_of_pose(pose)))
        }
        (Coordinate::Plane { .. }, _) => (quote!(#private::pose_of_plane(q)), quote!(#private::plane_of_pose(pose))),
        (Coordinate::Scalar(_), Some(Motion::Planar)) => (
            quote!(#private::pose_of_plane_chart(#private::components(q))),
            quote!(#private::plane_chart_of_pose(pose).map(#private::vector)),
        ),
        (Coordinate::Scalar(_), Some(Motion::FixedPoint)) => (
            quote!(#private::pose_of_rotation_chart(#chart, #private::components(q))),
            quote!(#private::rotation_chart_of_pose(#chart, pose).map(#private::vector)),
        ),
        (Coordinate::Scalar(_), Some(Motion::Free)) => (
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
        (Coordinate::Scalar(_), None) => return None,
    })
}
