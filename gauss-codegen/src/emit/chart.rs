//! Charts and motions by name, and as values of the runtime.

use proc_macro2::TokenStream;
use quote::quote;

use crate::terms::{Chart, Motion, RotationChart};

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

pub fn rotation_chart_tokens(private: &TokenStream, chart: Chart) -> TokenStream {
    let path = quote!(#private::RotationChart);
    match chart {
        Chart::Jet(RotationChart::Euler([a, b, c])) => {
            quote!(#path::Euler(#private::EulerSequence { axes: [#a, #b, #c] }))
        }
        Chart::Jet(RotationChart::Rodrigues) => quote!(#path::Rodrigues),
        Chart::Jet(RotationChart::ModifiedRodrigues) => quote!(#path::ModifiedRodrigues),
        // The last three have no coordinates of the rotation, and nobody reads the value.
        Chart::Jet(RotationChart::Angle) | Chart::LeftInvariant | Chart::RightInvariant | Chart::Hybrid => {
            quote!(#path::Angle)
        }
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
