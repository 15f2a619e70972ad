//! Why a run ended, in words of Python: remedies that are Rust's alone are replaced by those that a caller has here.

use gauss_runtime::integrate::IntegrationErrorKind;

/// The message.
pub fn words(kind: &IntegrationErrorKind) -> String {
    match kind {
        IntegrationErrorKind::TooManySteps { limit } => format!(
            "{limit} steps do not reach the end; allow more with `max_steps`, use a larger tolerance or step, or shorten \
             the run"
        ),
        IntegrationErrorKind::Stiff { rate, step } => format!(
            "the scene is stiff: something decays at a rate of {rate:.1e} per unit of time, which steps of {step:.1e} of \
             an explicit method cannot pass over; use `simulate` with `method=\"rosenbrock\"` (its struct needs the clause \
             `linearize`), or leave out what decays"
        ),
        IntegrationErrorKind::TooFast { rate, step } => format!(
            "the motion has rates of {rate:.1e} per unit of time, for which steps of {step:.1e} are too long or too many; \
             check units and parameters, or shorten the run"
        ),
        IntegrationErrorKind::InconsistentStart { level, distance } => format!(
            "the initial {level} violates the constraints, the nearest one that satisfies them is {distance:e} away; start \
             from `q, z = kernel.project(q, z)`"
        ),
        IntegrationErrorKind::Contacts => {
            "the scene has contacts, whose forces runs from Python do not have; take them \
             out of its struct, or run it from Rust"
                .to_owned()
        }
        other => other.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use gauss_runtime::constraint::ConstraintLevel;
    use gauss_runtime::integrate::RunPart;

    /// What a run from Python can end with: none of the words is a name of Rust.
    #[test]
    fn remedies_are_those_of_python() {
        use IntegrationErrorKind as Kind;
        let level = ConstraintLevel::Velocity;
        let all = [
            Kind::NonFinite { part: RunPart::InitialState },
            Kind::NonFinite { part: RunPart::Derivative },
            Kind::NonFinite { part: RunPart::Step },
            Kind::NonFinite { part: RunPart::Event },
            Kind::StepTooSmall { step: 1e-9 },
            Kind::TimeTooCoarse { step: 1e-9, time: 1e9 },
            Kind::TooManySteps { limit: 100 },
            Kind::Stiff { rate: 1e9, step: 1e-9 },
            Kind::TooFast { rate: 1e9, step: 1e-9 },
            Kind::IncrementTooLarge { angle: 4.0 },
            Kind::SingularChart { regularity: 1e-9 },
            Kind::NotConverged { iterations: 50, residual: 1e-3 },
            Kind::ProjectionTooFar { level, distance: 1.0, allowed: 1e-9 },
            Kind::InconsistentStart { level, distance: 1.0 },
            Kind::InvalidStep { step: 0.0 },
            Kind::Contacts,
        ];
        for kind in all {
            let told = words(&kind);
            for name in
                ["::", "&q", "#[gauss", "`every`", "Rosenbrock", "Splitting", "ContactRun", "without_contacts()"]
            {
                assert!(!told.contains(name), "{told}");
            }
        }
    }
}
