//! `RigidBodySystem`: the configuration as a pose, twist and momentum in body axes; of every system whose only matter
//! is one body.

use proc_macro2::TokenStream;
use quote::quote;

use crate::mechanics::Method;
use crate::program::ArgumentKind;

use crate::emit::derived::Derived;
use crate::emit::quantities::pose::pose_bodies;

pub fn rigid_body_system(derived: &Derived<'_, '_>) -> Option<TokenStream> {
    let private = derived.private();
    let six = quote!(#private::SVector<Self::Scalar, 6>);
    let placed = placed_by_coordinates(derived).or_else(|| placed_by_chart(derived))?;
    let twist = derived.function(Method::BodyTwist, six.clone());
    let momentum = derived.function(Method::BodyMomentum, six);
    Some(derived.implementation(quote!(RigidBodySystem), quote!(#placed #twist #momentum)))
}

/// Methods of one body whose pose is the configuration: both ways are known.
fn placed_by_chart(derived: &Derived<'_, '_>) -> Option<TokenStream> {
    derived.program(Method::Speeds)?;
    let (pose, configuration) = pose_bodies(derived, derived.subject.system.scene.chart())?;
    let private = derived.private();
    let speeds = derived.function(Method::Speeds, quote!(Self::Speeds));
    let pose = pose_function(derived, pose);
    Some(quote! {
        #pose
        #[inline]
        fn configuration_at(
            &self,
            __t: Self::Scalar,
            __pose: &#private::Isometry3<Self::Scalar>,
        ) -> ::core::result::Result<Self::Configuration, #private::ChartError> {
            #configuration
        }
        #speeds
    })
}

/// Methods of one body whose pose is a function of the configuration: the inverse is found by its derivatives.
fn placed_by_coordinates(derived: &Derived<'_, '_>) -> Option<TokenStream> {
    let (private, speeds) = (derived.private(), derived.degrees_of_freedom());
    let start = derived.subject.unmoved(&derived.private());
    let (instructions, pose) = derived.computed(derived.program(Method::Pose)?);
    let (rotation, position) = pose.split_at(9);
    let rows = rotation.chunks(3).map(|row| quote!([#(#row),*]));
    let (by_configuration, columns) = derived.computed(derived.program(Method::PoseByConfiguration)?);
    // States of elements, which come last among the components, place no body: they stay zero.
    let placing = derived.increments() - derived.subject.system.scene.states.len();
    let columns: Vec<_> = columns.chunks(6).take(placing).map(|column| quote!([#(#column),*])).collect();
    let increments = columns.len();
    let pose = quote!(#instructions #private::pose_from_rows([#(#rows),*], [#(#position),*]));
    let pose = pose_function(derived, pose);
    let speeds_of = quote!(#private::speeds_of_twist::<Self, #speeds>(self, __t, __q, __twist));
    let speeds_of = derived.function_of("speeds", &[ArgumentKind::Twist], quote!(Self::Speeds), speeds_of);
    let determinacy = quote!(#private::determinacy_of_speeds::<Self, #speeds>(self, __t, __q));
    let determinacy = derived.function_of("determinacy", &[], quote!(Self::Scalar), determinacy);
    Some(quote! {
        #pose
        fn configuration_at(
            &self,
            __t: Self::Scalar,
            __pose: &#private::Isometry3<Self::Scalar>,
        ) -> ::core::result::Result<Self::Configuration, #private::ChartError> {
            #private::configuration_of_pose::<Self, #increments>(
                self,
                __t,
                __pose,
                #start,
                |__q: &Self::Configuration| {
                    #by_configuration
                    [#(#columns),*]
                },
            )
        }
        #speeds_of
        #determinacy
    })
}

fn pose_function(derived: &Derived<'_, '_>, body: TokenStream) -> TokenStream {
    let private = derived.private();
    let function = derived.function_of("pose", &[], quote!(#private::Isometry3<Self::Scalar>), body);
    quote!(#[inline] #function)
}
