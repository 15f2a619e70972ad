//! Places of bodies, frames and points.

use proc_macro2::Ident;

use crate::algebra::Expr;
use crate::error::Result;
use crate::mechanics::{Body, Matter, Placement, Tree, Vector};
use crate::model::{BodyClause, ExpressionKind, Property};
use crate::words::Unraw;

use super::kinematics::name_of_property;
use super::translator::{Translator, bug};
use super::value::{Local, Value};

impl<'g> Translator<'_, 'g> {
    /// Bodies and frames, parents before children.
    pub(super) fn placements(&mut self) -> Result<Vec<Placement<'g>>> {
        let clauses = &self.model.bodies;
        let mut placements = Vec::with_capacity(clauses.len());
        let mut open: Vec<usize> = (0..clauses.len()).collect();
        while !open.is_empty() {
            let hung = |name: &Ident| self.links.contains_key(&name.unraw().to_string());
            let ready = open.iter().position(|&k| clauses[k].parent.as_ref().is_none_or(hung));
            let next = open.remove(ready.ok_or_else(|| bug(clauses[open[0]].span))?);
            let name = clauses[next].name.as_ref().map_or_else(|| "body".to_owned(), |name| name.unraw().to_string());
            let placement = self.placed_freely(&name, self.placement(next, &clauses[next])?);
            self.links_of_clauses[next] = placements.len();
            self.links.insert(name, placements.len());
            placements.push(placement);
        }
        Ok(placements)
    }

    fn placement(&self, index: usize, clause: &BodyClause) -> Result<Placement<'g>> {
        let nothing = self.no_links();
        let zero = self.graph.zero();
        let matter = match &self.declared.bodies[index] {
            Some(body) => Matter::Body(Box::new(Body::clone(body))),
            None => Matter::Nothing,
        };
        if let Some(chart) = self.chart().filter(|_| self.model.is_in_chart(clause)) {
            let hangs = |parent: &Option<Ident>| parent.as_ref().is_some_and(|name| name == "body");
            let bodies = self.model.bodies.iter().map(|body| &body.parent);
            let alone = !bodies.chain(self.model.particles.iter().map(|particle| &particle.parent)).any(hangs);
            return Ok(chart.placement(matter, alone));
        }
        let turns = match &clause.rotation {
            Some(e) => match self.value(e, &nothing)? {
                Value::Rotation(turns) => turns.iter().map(|piece| piece.turn(self.graph, &self.rates)).collect(),
                _ => return Err(bug(e.span)),
            },
            None => Vec::new(),
        };
        let [velocity, angular_velocity] = self.velocities_of_pose(clause);
        Ok(Placement {
            matter,
            parent: clause.parent.as_ref().and_then(|name| self.links.get(&name.unraw().to_string()).copied()),
            position: clause.position.as_ref().map_or(Ok([zero; 3]), |e| self.vector(e, &nothing))?,
            velocity,
            angular_velocity,
            turns,
        })
    }

    /// The velocity of O and the angular velocity, each in the axes in which the kinematics give it, of a body whose
    /// position and rotation are those of a pose, or whose rotation is a coordinate.
    fn velocities_of_pose(&self, clause: &BodyClause) -> [Option<Vector<'g>>; 2] {
        let none = [self.graph.zero(); 3];
        let in_body = |body| Vector { body, space: none };
        let in_space = |space| Vector { body: none, space };
        let turned_by = clause.rotation.as_ref().and_then(|e| match &e.kind {
            ExpressionKind::Name(name) => Some(name.unraw().to_string()),
            _ => name_of_property(e, Property::Rotation),
        });
        let coordinate = |name: &String| self.model.coordinates.iter().position(|q| q.ident.unraw() == *name);
        let Some(k) = turned_by.as_ref().and_then(coordinate).filter(|_| clause.parent.is_none()) else {
            return [None; 2];
        };
        let [linear, angular] = self.observed_rates[k];
        let placed_by = clause.position.as_ref().and_then(|e| name_of_property(e, Property::Position));
        let velocity = match self.declared.rate_of(self.declared.before + k, &self.kinematics) {
            &[u1, u2, u3, _, _, _] if placed_by == turned_by && linear.is_none() => Some(in_body([u1, u2, u3])),
            _ => None,
        };
        [velocity, angular.map(in_space)]
    }

    pub(super) fn name_points(&mut self, tree: &Tree<'g>) -> Result<()> {
        for clause in &self.model.points {
            let at = self.vector(&clause.at, tree)?;
            let index = *self.links.get(&clause.body.unraw().to_string()).ok_or_else(|| bug(clause.span))?;
            let link = &tree.links[index];
            let turned = link.axes().to_space(&at);
            let position: [Expr<'g>; 3] = std::array::from_fn(|i| link.position[i] + turned[i].group());
            self.names.insert(clause.name.unraw().to_string(), Value::Local(Local::point(index, at, position)));
        }
        Ok(())
    }
}
