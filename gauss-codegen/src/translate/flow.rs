//! Matter that leaves or enters bodies.

use crate::error::Result;
use crate::mechanics::{Axes, Force, MatterFlow, Tree};
use crate::model::argument::{AT, THRUST, VELOCITY};
use crate::model::{ElementKind, ForceClause, Property};

use super::translator::{Translator, bug};

impl<'g> Translator<'_, 'g> {
    /// The force ṁ u at the place where matter passes, with a thrust that is known, and the reaction of matter that
    /// flows inside the body.
    pub(super) fn mass_flow(&self, clause: &ForceClause, tree: &Tree<'g>) -> Result<Vec<Force<'g>>> {
        let body = clause.body().ok_or_else(|| bug(clause.span))?;
        let link = self.link(body)?;
        let moments = tree.links[link].matter.moments(self.graph);
        let now = self.declared.time;
        let times = [self.declared.matter_time.unwrap_or(now), now];
        let flow = MatterFlow::through(self.vector_or_zero(clause, AT, tree)?, &moments, times);
        if flow.is_still() {
            let message = format!(
                "the mass of `{body}` does not vary, so nothing flows; write it as a function of time, such as `mass = m - \
                 burn * t`, or the force alone as `force(…)`"
            );
            self.mistake(clause.span, message);
        }
        let of_body = |other: &&ForceClause| other.row.kind == ElementKind::MassFlow && other.body() == Some(body);
        if self.model.forces.iter().filter(of_body).count() > 1 {
            let message = format!(
                "two places take the mass of `{body}`, and how much of it each of them takes is not known; give each a body \
                 of its own that varies, `body(tank, parent = {body}, …)`"
            );
            self.mistake(clause.span, message);
        }
        let written = [VELOCITY, THRUST].map(|word| clause.expression(word));
        let (axes, [velocity, thrust]) = self.parts(link, written, clause.axes(), tree)?;
        let force = std::array::from_fn(|i| flow.rate * velocity[i] + thrust[i]);
        let none = [self.graph.zero(); 3];
        let omega = self.velocity_of(link, Property::BodyAngularVelocity, tree);
        let [inner, torque] = flow.reaction(&omega);
        let passing = Force::OnLink { link, at: flow.exit, force, torque: none, axes };
        let inside = Force::OnLink { link, at: none, force: inner, torque, axes: Axes::Body };
        Ok(vec![passing, inside])
    }
}

#[cfg(test)]
mod tests {
    use crate::expand::derive;

    /// The message about a rocket with these clauses, if there is one.
    fn mistake(mass: &str, clauses: &str) -> Option<String> {
        let source = format!(
            "#[gauss(coordinates(x), body(hull, position = [x, 0, 0], mass = {mass}, inertia = 1), \
             mass_flow(body = hull, velocity = [-c, 0, 0]), {clauses})] struct Rocket {{ m: f64, c: f64 }}"
        );
        let input = syn::parse_str(&source).expect("a struct");
        derive(&input, |_| Ok(())).err().map(|error| error.to_string())
    }

    #[test]
    fn what_flows_is_the_rate_of_a_mass_and_has_one_exit() {
        assert_eq!(mistake("m - t", ""), None);
        let still = "the mass of `hull` does not vary, so nothing flows; write it as a function of time, such as `mass = m - \
                     burn * t`, or the force alone as `force(…)`";
        assert_eq!(mistake("m", "").as_deref(), Some(still));
        let twice = "two places take the mass of `hull`, and how much of it each of them takes is not known; give each a body \
                     of its own that varies, `body(tank, parent = hull, …)`";
        assert_eq!(mistake("m - t", "mass_flow(body = hull, velocity = [c, 0, 0])").as_deref(), Some(twice));
        let unknown = "masses that vary are no parameters, and what matter that leaves does depends on them, too; remove \
                       `regressor`, or the time from mass data";
        assert_eq!(mistake("m - t", "regressor").as_deref(), Some(unknown));
    }

    #[test]
    fn a_flow_says_how_matter_passes() {
        let source = "#[gauss(coordinates(x), body(hull, position = [x, 0, 0], mass = 3 - t, inertia = 1), \
                      mass_flow(body = hull, at = [1, 0, 0]))] struct Rocket { m: f64 }";
        let input = syn::parse_str(source).expect("a struct");
        let error = derive(&input, |_| Ok(())).err().map(|error| error.to_string()).unwrap_or_default();
        assert!(error.contains("the velocity relative to the body with which matter leaves or enters it"), "{error}");
    }
}
