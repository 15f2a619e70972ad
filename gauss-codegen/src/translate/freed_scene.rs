//! The scene once more, with joints let go for their reactions: each has six coordinates more, by which what it carries
//! moves along and about its own axes as if nothing held it. Coordinates that are driven are let go for their driving
//! forces: each has one more, by which it is away from its motion. These and their rates are zero wherever anything is
//! computed; what is of use is how everything would change by them.

use proc_macro2::{Ident, Span};

use crate::algebra::{Expr, Map, Substitution};
use crate::error::Result;
use crate::mechanics::{Action, Element, FreedScene, Placement, Turn};
use crate::words::Unraw;

use super::freedom::{FreedJoint, FreedPart};
use super::notes::Notes;
use super::translator::Translator;

impl<'g> Translator<'_, 'g> {
    /// The scene with the joints let go whose reactions are wanted, then driven coordinates; `None` without any.
    pub(super) fn let_go(&self) -> Result<Option<FreedScene<'g>>> {
        let graph = self.graph;
        let joints = self.model.item.wanted.reactions.iter();
        let joints = joints.map(|joint| FreedPart::Joint(joint.link.unraw().to_string()));
        let motions = self.model.motions.iter().map(|(name, _)| FreedPart::Motion(name.unraw().to_string()));
        let let_go: Vec<_> = joints.chain(motions).map(|part| FreedJoint::new(graph, part)).collect();
        if let_go.is_empty() {
            return Ok(None);
        }
        let mut declared = self.declared.clone();
        let_go.iter().for_each(|by| by.declare(&mut declared));
        // What is noted has been noted before.
        let notes = Notes::with_literals_of(self.notes);
        let fresh = Translator::new(graph, self.model, &declared, self.functions, self.pi, &notes);
        let mut translator = Translator { let_go, ..fresh };
        let scene = translator.scene()?;
        translator.refuse_mistakes()?;
        let home = translator.home();
        let noted = notes.into_inner();
        let mut own = self.notes.add();
        (own.literals, own.twins) = (noted.literals, noted.twins);
        drop(own);
        let driven = self.model.motions.iter().map(|(name, _)| self.rate_of_coordinate(name)).collect::<Result<_>>()?;
        Ok(Some(FreedScene { scene, home, driven }))
    }

    /// Distance of a driven coordinate from its motion: zero, unless it is let go.
    pub(super) fn away(&self, motion: &Ident) -> Expr<'g> {
        let name = motion.unraw().to_string();
        let is_it = |by: &&FreedJoint<'g>| matches!(&by.part, FreedPart::Motion(own) if *own == name);
        let by = self.let_go.iter().find(is_it).and_then(|by| by.coordinates.first());
        by.copied().unwrap_or_else(|| self.graph.zero())
    }

    /// Zero for everything that joints that are let go move by.
    pub(super) fn home(&self) -> Map<u32, Expr<'g>> {
        let zero = self.graph.zero();
        let all = self.let_go.iter().flat_map(|by| [&by.coordinates, &by.speeds, &by.rates]).flatten();
        all.map(|symbol| (symbol.key(), zero)).collect()
    }

    /// An element, of which note is taken where it has no value with joints where they are: its two ends are one place
    /// there, and no direction leads from one to the other.
    pub(super) fn known_at_home(&self, span: Span, element: Element<'g>) -> Element<'g> {
        if self.let_go.is_empty() {
            return element;
        }
        let home = Substitution::new(self.home());
        let by_energy = |energy: Expr<'g>| {
            let moved = self.let_go.iter().flat_map(|by| &by.coordinates);
            moved.for_each(|coordinate| {
                home.of(energy.partial(*coordinate));
            });
        };
        let work = || match &element.action {
            Action::Potential(energy) => by_energy(*energy),
            Action::Field(field) => by_energy(field.potential),
            Action::Forces(_) => {
                element.map(|e| home.of(e));
            }
        };
        if self.graph.defined(work).is_none() {
            let message = format!(
                "`{}` has no direction at {}: a distance in it is zero wherever the system is; remove it, since it does \
                 nothing there, or fasten its ends in different places",
                element.name,
                match self.model.motions.is_empty() {
                    true => "the joint that `reactions` asks about",
                    false => "a joint that `reactions` asks about, or along a coordinate that `motion` drives",
                }
            );
            self.mistake(span, message);
        }
        element
    }

    /// Whether a component of a constraint or a slip vanishes with joints where they are, seen by so many terms.
    pub(super) fn says_nothing(&self, component: Expr<'g>, limit: usize) -> bool {
        let home = if self.let_go.is_empty() { component } else { component.substitute(&self.home()) };
        home.collected(limit).is_zero()
    }

    /// The placement of a body or frame whose joint may be let go.
    pub(super) fn placed_freely(&self, name: &str, placement: Placement<'g>) -> Placement<'g> {
        let is_it = |by: &&FreedJoint<'g>| matches!(&by.part, FreedPart::Joint(link) if link == name);
        let Some(by) = self.let_go.iter().find(is_it) else { return placement };
        let [x, y, z, angles @ ..] = by.coordinates.as_slice() else { return placement };
        let way = placement.turns.iter().rev().fold([*x, *y, *z], |way, turn| turn.vector(&way));
        let position = std::array::from_fn(|i| placement.position[i] + way[i]);
        let further = angles.iter().enumerate().map(|(axis, angle)| Turn::about(self.graph, axis, *angle, &self.rates));
        let turns = placement.turns.iter().copied().chain(further).collect();
        Placement { position, turns, velocity: None, angular_velocity: None, ..placement }
    }
}
