//! Why a run ended, in words of Python: remedies that are Rust's alone are replaced by those that a caller has here.

use gauss_contact::{ContactError, ContactErrorKind};
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
        IntegrationErrorKind::NotTurnedBack { event, before, after } => format!(
            "the jump of event {event} does not turn its function back, which goes on through zero at a rate of \
             {after:.3e} after {before:.3e}; turn the velocity along the function, or write (event, function, \
             \"through\") where it is to pass"
        ),
        other => other.to_string(),
    }
}

/// The message of a run with contacts.
pub fn of_contacts(ContactError { contact, time, kind, .. }: &ContactError) -> String {
    let why = contact_words(kind);
    match contact {
        Some(name) => format!("t = {time}: contact {name}: {why}"),
        None => format!("t = {time}: {why}"),
    }
}

/// The message of a step between events of contacts, for which there is one method.
fn between_events(kind: &IntegrationErrorKind) -> String {
    match kind {
        IntegrationErrorKind::Stiff { rate, step } => format!(
            "something decays at a rate of {rate:.1e} per unit of time, which steps of {step:.1e} of an explicit method \
             cannot pass over; a slow slip along two axes turns as fast as that: larger `rtol` and `atol` count it as \
             none sooner, and `contacts=\"steps\"` passes over it"
        ),
        other => words(other),
    }
}

fn contact_words(kind: &ContactErrorKind) -> String {
    match kind {
        ContactErrorKind::Penetration { gap } => format!(
            "the gap of an open contact is {gap:e} and was not seen to close; set `largest_step`, or take \
             `contacts=\"steps\"`"
        ),
        ContactErrorKind::States { states } => format!(
            "elements of the scene have {states} states, which steps of one length do not follow; leave out \
             `contacts=\"steps\"`"
        ),
        ContactErrorKind::StiffSprings { phase, step } => format!(
            "what moves swings by {phase:.2} rad in a step of {step:e}, and `scheme=\"moreau_jean\"` follows 1: make \
             steps shorter than {:.1e}, or take `scheme=\"midpoint\"`, which makes springs implicit",
            step / phase
        ),
        ContactErrorKind::EnergyGrows { law, before, after } => format!(
            "by the law {law:?} the impact would raise the kinetic energy from {before:e} to {after:e}; \
             `impact=\"moreau\"` and `\"poisson\"` keep it from growing"
        ),
        ContactErrorKind::TooManyEvents { limit } => format!(
            "{limit} events do not reach the end; begin another run at the last state of this one, or take \
             `contacts=\"steps\"`"
        ),
        ContactErrorKind::Integration(error) => between_events(&error.kind),
        other => other.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use gauss_runtime::constraint::ConstraintLevel;
    use gauss_runtime::integrate::RunPart;

    /// Errors with which a run from Python can end: none of their words is a name of Rust.
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
            Kind::NotTurnedBack { event: 0, before: -1.0, after: -1.0 },
            Kind::Zeno { event: 0, interval: 1e-9 },
            Kind::TooManyJumps { event: 0, jumps: 9, interval: 1e-9 },
        ];
        for told in all.iter().map(words).chain(all_of_contacts()) {
            for name in [
                "::",
                "&q",
                "#[gauss",
                "`every`",
                "Rosenbrock",
                "Splitting",
                "ContactRun",
                "without_contacts()",
                "then_through",
                "attempt",
                "changing_over",
                "max_events",
            ] {
                assert!(!told.contains(name), "{told}");
            }
        }
    }

    #[test]
    fn runs_with_contacts_have_one_method() {
        let told = between_events(&IntegrationErrorKind::Stiff { rate: 1e9, step: 1e-9 });
        assert!(!told.contains("method=") && told.contains("contacts=\"steps\""), "{told}");
    }

    /// Errors that stop runs with contacts: one of each kind that a run of a scene can meet.
    fn all_of_contacts() -> Vec<String> {
        use ContactErrorKind as Kind;
        let law = gauss_contact::Impact::Newton;
        let residual = gauss_contact::Residual::default();
        let kinds = [
            Kind::NegativeGap { gap: -1.0 },
            Kind::Penetration { gap: -1e-3 },
            Kind::InvalidRestitution { restitution: 2.0 },
            Kind::InvalidFriction { friction: -1.0 },
            Kind::InvalidInterval,
            Kind::States { states: 1 },
            Kind::Stiff { speed: 0, step: 1e-3 },
            Kind::StiffSprings { phase: 1.5, step: 1e-3 },
            Kind::TooManySteps { limit: 9 },
            Kind::NonFinite,
            Kind::Inconsistent,
            Kind::Indeterminate,
            Kind::Unsolved { residual },
            Kind::EnergyGrows { law, before: 1.0, after: 2.0 },
            Kind::Zeno { impacts: 9 },
            Kind::Chatter { changes: 9 },
            Kind::TooManyEvents { limit: 9 },
            Kind::Displacement { gap: 1e-3, moved: 1.0 },
            Kind::Strikes { rate: -1.0 },
        ];
        kinds.iter().map(contact_words).collect()
    }
}
