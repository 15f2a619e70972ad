//! `CentroidalSystem` and `GravityTorques`: quantities of the system as a whole.

use proc_macro2::TokenStream;
use quote::quote;

use crate::mechanics::Method;

use crate::emit::derived::Derived;

/// The implementations, where they are wanted.
pub fn of_the_whole(derived: &Derived<'_, '_>) -> TokenStream {
    let centroidal = centroidal(derived);
    let torques = derived.function(Method::GravityTorques, quote!(Self::Speeds));
    let torques = torques.map(|method| derived.implementation(quote!(GravityTorques), method));
    quote!(#centroidal #torques)
}

fn centroidal(derived: &Derived<'_, '_>) -> Option<TokenStream> {
    let mass = derived.method_body(Method::TotalMass)?;
    let (private, ty, n) = (derived.private(), derived.scalar().ty(), derived.degrees_of_freedom());
    let six = quote!(#private::SVector<#ty, 6>);
    let methods = [
        (Method::CenterOfMass, quote!(#private::SVector<#ty, 3>)),
        (Method::CentroidalMomentum, six.clone()),
        (Method::CentroidalMatrix, quote!(Self::CentroidalMatrix)),
        (Method::CentroidalBias, six),
    ];
    let methods = methods.into_iter().filter_map(|(method, result)| derived.function(method, result));
    let items = quote! {
        type CentroidalMatrix = #private::SMatrix<#ty, 6, #n>;
        type CenterJacobian = #private::SMatrix<#ty, 3, #n>;
        #[inline]
        fn total_mass(&self) -> Self::Scalar { #mass }
        #(#methods)*
        #[inline]
        fn center_jacobian(&self, __t: Self::Scalar, __q: &Self::Configuration) -> Self::CenterJacobian {
            #private::center_jacobian(&self.centroidal_matrix(__t, __q), self.total_mass())
        }
    };
    Some(derived.implementation(quote!(CentroidalSystem), items))
}
