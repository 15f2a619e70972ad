//! What is particular to one body in a chart: the configuration as a pose, the names of charts.

use proc_macro2::TokenStream;
use quote::quote;

use crate::mechanics::ConfigurationKind;
use crate::model::{Chart, Motion, RotationChart};

use super::arguments::Argument;
use super::derived::BodySubject;

impl<'g> BodySubject<'_, 'g> {
    pub fn chart_name(&self) -> String {
        match self.in_chart.chart {
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
        match self.in_chart.motion {
            Motion::Free => "free",
            Motion::FixedPoint => "fixed_point",
            Motion::Planar => "planar",
        }
    }

    /// The configuration taken apart.
    pub fn configuration_arguments(&self) -> Vec<Argument<'g>> {
        let private = self.derived.private();
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

    fn rotation_chart_tokens(&self) -> TokenStream {
        let runtime = &self.model.runtime;
        let chart = quote!(#runtime::chart::RotationChart);
        match self.in_chart.chart {
            Chart::Jet(RotationChart::Euler([a, b, c])) => {
                quote!(#chart::Euler(#runtime::chart::EulerSequence { axes: [#a, #b, #c] }))
            }
            Chart::Jet(RotationChart::Rodrigues) => quote!(#chart::Rodrigues),
            Chart::Jet(RotationChart::ModifiedRodrigues) => quote!(#chart::ModifiedRodrigues),
            _ => quote!(#chart::Angle),
        }
    }

    pub fn chart_tokens(&self) -> TokenStream {
        let runtime = &self.model.runtime;
        let chart = quote!(#runtime::chart::Chart);
        match self.in_chart.chart {
            Chart::LeftInvariant => quote!(#chart::LeftInvariant),
            Chart::RightInvariant => quote!(#chart::RightInvariant),
            Chart::Hybrid => quote!(#chart::Hybrid),
            Chart::Jet(_) => {
                let rotation = self.rotation_chart_tokens();
                quote!(#chart::Jet(#rotation))
            }
        }
    }

    pub fn configuration_type(&self) -> TokenStream {
        let (runtime, ty, n) = (&self.model.runtime, self.derived.scalar().ty(), self.derived.degrees_of_freedom());
        match self.scene.kinematics.kind {
            ConfigurationKind::Pose => quote!(#runtime::prelude::Isometry3<#ty>),
            ConfigurationKind::Rotation => quote!(#runtime::prelude::UnitQuaternion<#ty>),
            ConfigurationKind::PlanePose => quote!(#runtime::prelude::Isometry2<#ty>),
            ConfigurationKind::Coordinates => quote!(#runtime::prelude::SVector<#ty, #n>),
        }
    }

    /// `pose` and `configuration`: the configuration as a pose and back.
    pub fn pose_bodies(&self) -> (TokenStream, TokenStream) {
        let private = self.derived.private();
        let chart = self.rotation_chart_tokens();
        match (self.scene.kinematics.kind, self.in_chart.motion) {
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
