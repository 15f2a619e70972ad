//! `RigidBodySystem`: the configuration as a pose, twist and momentum in body axes; of one body in a chart, and where its pose is the only coordinate.

use proc_macro2::TokenStream;
use quote::quote;

use crate::mechanics::Method;

use super::derived::Derived;
use super::pose::pose_bodies;

pub fn rigid_body_system(derived: &Derived<'_, '_>) -> Option<TokenStream> {
    derived.subject.system.rigid_body()?;
    let (pose, configuration_of_pose) = pose_bodies(derived, derived.subject.model.one_body())?;
    let private = derived.private();
    let six = quote!(#private::SVector<Self::Scalar, 6>);
    let twist = derived.function(Method::BodyTwist, quote!(__z: &Self::Speeds), six.clone());
    let speeds = derived.function(Method::Speeds, quote!(__twist: &#six), quote!(Self::Speeds));
    let momentum = derived.function(Method::BodyMomentum, quote!(__z: &Self::Speeds), six);
    let items = quote! {
        #[inline]
        fn pose(&self, __t: Self::Scalar, __q: &Self::Configuration) -> #private::Isometry3<Self::Scalar> {
            #pose
        }
        #[inline]
        fn configuration(
            &self,
            __pose: &#private::Isometry3<Self::Scalar>,
        ) -> ::core::result::Result<Self::Configuration, #private::ChartError> {
            #configuration_of_pose
        }
        #twist
        #speeds
        #momentum
    };
    Some(derived.implementation(quote!(RigidBodySystem), items))
}
