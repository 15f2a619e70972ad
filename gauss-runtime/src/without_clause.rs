//! Messages of the compiler about a method that a clause of the scene brings, where the clause is not written.
//!
//! Of a method that no type has the compiler says that some trait could be implemented, which is not what a user
//! should do. It shows a message of ours only where a trait has the method for types with a bound, and the bound alone
//! does not hold. So each family of methods is here once more, by names alone, with a bound that no type meets: these
//! methods are never called and stand in nobody's way. The prelude brings the traits along without their names. Of
//! receivers that are references the compiler tells the bound only, whose name is therefore that of the clause.

use crate::system::GaussSystem;

#[diagnostic::on_unimplemented(
    message = "`{Self}` has no derivatives, because its struct does not ask for them",
    label = "the clause `linearize` brings them",
    note = "add `linearize` to the `#[gauss(…)]` of the struct"
)]
pub trait HasClauseLinearize {}

#[diagnostic::on_unimplemented(
    message = "`{Self}` has no derivatives by its parameters, because its struct does not ask for them",
    label = "the clause `linearize(parameters)` brings them",
    note = "add `linearize(parameters)` to the `#[gauss(…)]` of the struct"
)]
pub trait HasClauseLinearizeParameters {}

#[diagnostic::on_unimplemented(
    message = "`{Self}` has no derivatives of inverse dynamics, because its struct does not ask for them",
    label = "the clause `linearize(inverse)` brings them",
    note = "add `linearize(inverse)` to the `#[gauss(…)]` of the struct"
)]
pub trait HasClauseLinearizeInverse {}

#[diagnostic::on_unimplemented(
    message = "`{Self}` has no second derivatives, because its struct does not ask for them",
    label = "the clause `linearize(hessian)` brings them",
    note = "add `linearize(hessian)` to the `#[gauss(…)]` of the struct"
)]
pub trait HasClauseLinearizeHessian {}

#[diagnostic::on_unimplemented(
    message = "`{Self}` has no regressor, because its struct does not ask for it",
    label = "the clause `regressor` brings it",
    note = "add `regressor` to the `#[gauss(…)]` of the struct"
)]
pub trait HasClauseRegressor {}

#[diagnostic::on_unimplemented(
    message = "`{Self}` has no frames, because its struct does not ask for them",
    label = "the clause `frames(…)` brings them",
    note = "add `frames(…)`, with names of bodies and frames, to the `#[gauss(…)]` of the struct"
)]
pub trait HasClauseFrames {}

#[diagnostic::on_unimplemented(
    message = "`{Self}` has no rates of Jacobians, because its struct does not ask for them",
    label = "the clause `methods(jacobian_rates)` brings them",
    note = "add `methods(jacobian_rates)` beside `frames(…)` to the `#[gauss(…)]` of the struct"
)]
pub trait HasClauseMethodsJacobianRates {}

#[diagnostic::on_unimplemented(
    message = "`{Self}` has no sums over all bodies, because its struct does not ask for them",
    label = "the clause `methods(centroidal)` brings them",
    note = "add `methods(centroidal)` to the `#[gauss(…)]` of the struct"
)]
pub trait HasClauseMethodsCentroidal {}

#[diagnostic::on_unimplemented(
    message = "`{Self}` has no torques of gravity, because its struct does not ask for them",
    label = "the clause `methods(gravity_torques)` brings them",
    note = "add `methods(gravity_torques)` to the `#[gauss(…)]` of the struct"
)]
pub trait HasClauseMethodsGravityTorques {}

#[diagnostic::on_unimplemented(
    message = "`{Self}` has no reactions of joints, because its struct does not ask for them",
    label = "the clause `reactions(…)` brings them",
    note = "add `reactions(…)`, with names of bodies that joints carry, to the `#[gauss(…)]` of the struct"
)]
pub trait HasClauseReactions {}

#[diagnostic::on_unimplemented(
    message = "`{Self}` has no driving forces, because nothing in its struct is driven",
    label = "the clause `motion(…)` brings them",
    note = "add `motion(crank = …)`, with a function of `t`, to the `#[gauss(…)]` of the struct"
)]
pub trait HasClauseMotion {}

#[diagnostic::on_unimplemented(
    message = "`{Self}` has no power series, because its struct does not ask for them",
    label = "the clause `taylor` brings them",
    note = "add `taylor` to the `#[gauss(…)]` of the struct"
)]
pub trait HasClauseTaylor {}

#[diagnostic::on_unimplemented(
    message = "`{Self}` has no reactions under contact forces",
    label = "the clause `reactions(…)` brings them, where there are contacts and no constraints",
    note = "without contacts the method is `reaction`; under constraints `reactions_at` takes the accelerations"
)]
pub trait HasClauseReactionsBesideContacts {}

#[diagnostic::on_unimplemented(
    message = "`{Self}` has no multipliers: its coordinates and speeds satisfy all constraints by themselves",
    label = "the clause `constraint(…)` brings them, without `independent(…)`",
    note = "what a joint bears is told by the clause `reactions(…)`"
)]
pub trait HasClauseConstraint {}

#[diagnostic::on_unimplemented(
    message = "`{Self}` has no contacts",
    label = "the clauses `contact(…)`, `range(…)` and `dry_friction(…)` bring them",
    note = "stops and friction that give way are forces, not contacts"
)]
pub trait HasClauseContact {}

#[diagnostic::on_unimplemented(
    message = "`{Self}` has no forces, because nothing acts in its scene",
    label = "clauses such as `force(…)`, `spring(…)` and `gravity = …` bring them"
)]
pub trait HasClauseForce {}

#[diagnostic::on_unimplemented(
    message = "the kernel `{Self}` is not of one rigid body alone",
    label = "kernels of one body have this",
    note = "of systems: `monitor` in place of `monitor_body`, `frames(…)` for poses and twists, `methods(centroidal)` for momenta"
)]
pub trait HasOneBody {}

macro_rules! methods {
    ($($bound:ident: $offer:ident { $($method:ident)+ })+) => {$(
        #[doc(hidden)]
        pub trait $offer {
            $(fn $method(&self) {})+
        }

        impl<S: GaussSystem + $bound> $offer for S {}
    )+};
}

methods! {
    HasClauseLinearize: OfClauseLinearize { linearize }
    HasClauseLinearizeParameters: OfClauseLinearizeParameters { by_parameters }
    HasClauseLinearizeInverse: OfClauseLinearizeInverse { linearize_inverse }
    HasClauseLinearizeHessian: OfClauseLinearizeHessian { hessian }
    HasClauseRegressor: OfClauseRegressor { regressor inertial_parameters other_forces }
    HasClauseFrames: OfClauseFrames { pose_of twist_of jacobian_of bias_of frames }
    HasClauseMethodsJacobianRates: OfClauseMethodsJacobianRates { jacobian_rate_of }
    HasClauseMethodsCentroidal: OfClauseMethodsCentroidal {
        total_mass center_of_mass centroidal_momentum centroidal_matrix centroidal_bias center_jacobian center_velocity
        momentum_about
    }
    HasClauseMethodsGravityTorques: OfClauseMethodsGravityTorques { gravity_torques }
    HasClauseReactions: OfClauseReactions { reactions reactions_at reaction }
    HasClauseMotion: OfClauseMotion { driving_forces driving_forces_at }
    HasClauseTaylor: OfClauseTaylor { expand }
    HasClauseReactionsBesideContacts: OfClauseReactionsBesideContacts { contact_reactions reaction_under }
    HasClauseConstraint: OfClauseConstraint { multipliers position_residual velocity_residual }
    HasClauseContact: OfClauseContact { gaps contact_rates contact_jacobian contact_frame restitution }
    HasClauseForce: OfClauseForce { powers element_forces supplied_power generalised_force }
    HasOneBody: OfOneBody { pose body_twist body_momentum }
}

#[cfg(test)]
mod tests {
    use std::vec::Vec;

    const HERE: &str = include_str!("without_clause.rs");
    /// Each bound, the trait that has its methods, and the file of that.
    const THERE: [(&str, &str, &str); 17] = [
        ("Linearize", "LinearizedSystem", include_str!("linearize.rs")),
        ("LinearizeParameters", "ParametricSystem", include_str!("identification.rs")),
        ("LinearizeInverse", "InverseLinearizedSystem", include_str!("inverse.rs")),
        ("LinearizeHessian", "HessianSystem", include_str!("hessian.rs")),
        ("Regressor", "InertialRegressor", include_str!("identification.rs")),
        ("Frames", "FramedSystem", include_str!("frames.rs")),
        ("MethodsJacobianRates", "JacobianRates", include_str!("frames.rs")),
        ("MethodsCentroidal", "CentroidalSystem", include_str!("centroidal.rs")),
        ("MethodsGravityTorques", "GravityTorques", include_str!("centroidal.rs")),
        ("Reactions", "Reactions", include_str!("reactions.rs")),
        ("Motion", "DrivenSystem", include_str!("driven.rs")),
        ("Taylor", "TaylorSystem", include_str!("series.rs")),
        ("ReactionsBesideContacts", "ContactReactions", include_str!("reactions.rs")),
        ("Constraint", "ConstrainedSystem", include_str!("constraint/mod.rs")),
        ("Contact", "ContactSystem", include_str!("contact.rs")),
        ("Force", "ForcedSystem", include_str!("forces.rs")),
        ("OneBody", "RigidBodySystem", include_str!("system.rs")),
    ];

    /// The text between the last start before a place and the place.
    fn before<'a>(text: &'a str, start: &str, place: &str) -> &'a str {
        let (head, _) = text.split_once(place).expect(place);
        head.rsplit_once(start).expect(start).1.trim_end()
    }

    /// A call and a bound that do not hold say the same, and the methods are those of the trait.
    #[test]
    fn each_family_stands_twice() {
        for (bound, name, file) in THERE {
            let bound = if bound == "OneBody" { "HasOneBody" } else { &std::format!("HasClause{bound}") };
            let start = "#[diagnostic::on_unimplemented(";
            let said = before(HERE, start, &std::format!("pub trait {bound} {{"));
            assert_eq!(said, before(file, start, &std::format!("pub trait {name}: ")), "{name}");

            let (_, rest) = HERE.split_once(&std::format!("\n    {bound}: ")).expect(bound);
            let list = rest.split(['{', '}']).nth(1).expect("names");
            let (_, rest) = file.split_once(&std::format!("pub trait {name}: ")).expect(name);
            let (items, _) = rest.split_once("\n}").expect("its end");
            let methods: Vec<&str> = items.lines().filter_map(|line| line.strip_prefix("    fn ")).collect();
            for method in list.split_whitespace() {
                assert!(methods.iter().any(|line| line.split(['(', '<']).next() == Some(method)), "{name}: {method}");
            }
        }
    }
}
