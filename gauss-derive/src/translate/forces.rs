//! What acts, as the user wrote it, in symbols: springs become potentials and dissipation functions, torques with a reaction
//! two loads.

use syn::Ident;
use syn::ext::IdentExt;

use crate::algebra::Expr;
use crate::mechanics::{Axes, Force, Tree};
use crate::model::{self, Expression, Extent, ForceAxes};

use super::{Translator, bug};

type Triple<'g> = [Expr<'g>; 3];

impl<'g> Translator<'_, 'g> {
    /// Everything that acts, and the potentials of springs.
    pub(super) fn forces(&self, tree: &Tree<'g>) -> syn::Result<(Vec<Force<'g>>, Vec<Expr<'g>>)> {
        let (mut forces, mut potentials) = (Vec::new(), Vec::new());
        let unread = self.model.attractions.iter().map(|a| a.span).chain(self.model.medium.iter().map(|e| e.span));
        if let Some(span) = unread.into_iter().next() {
            return Err(bug(span));
        }
        for clause in &self.model.forces {
            let mut act = |force| forces.push(force);
            match &clause.kind {
                model::ForceKind::AtPoint { at, value } => {
                    act(Force::AtPoint { at: self.vector(at, tree)?, force: self.vector(value, tree)? });
                }
                model::ForceKind::OnBody { body, at, value, axes } => {
                    let none = [self.graph.zero(); 3];
                    let at = at.as_ref().map_or(Ok(none), |at| self.vector(at, tree))?;
                    let force = self.vector(value, tree)?;
                    act(Force::OnLink { link: self.link(body)?, at, force, torque: none, axes: axes_of(*axes) });
                }
                model::ForceKind::Torque { body, value, axes, reaction } => {
                    let none = [self.graph.zero(); 3];
                    let (link, torque) = (self.link(body)?, self.vector(value, tree)?);
                    act(Force::OnLink { link, at: none, force: none, torque, axes: axes_of(*axes) });
                    if let Some(other) = reaction {
                        // The same components in the observer's axes, which both share.
                        let turned = match axes {
                            ForceAxes::Observer => torque,
                            ForceAxes::Body => rotated(&tree.links[link].rotation, &torque),
                        };
                        let torque = turned.map(|e| -e);
                        act(Force::OnLink {
                            link: self.link(other)?,
                            at: none,
                            force: none,
                            torque,
                            axes: Axes::Space,
                        });
                    }
                }
                model::ForceKind::Wrench { body, at, force, torque, axes } => {
                    let none = [self.graph.zero(); 3];
                    let optional = |e: &Option<Expression>| e.as_ref().map_or(Ok(none), |e| self.vector(e, tree));
                    let (at, force, torque) = (optional(at)?, optional(force)?, optional(torque)?);
                    act(Force::OnLink { link: self.link(body)?, at, force, torque, axes: axes_of(*axes) });
                }
                model::ForceKind::Drive { rates } => {
                    for (coordinate, force) in rates {
                        let rate = self.rate_of_coordinate(coordinate)?;
                        act(Force::OnRate { rate, force: self.scalar(force, tree)? });
                    }
                }
                model::ForceKind::Spring { extent: Extent::Between { from, to }, stiffness, length, damping } => {
                    let (from, to) = (self.vector(from, tree)?, self.vector(to, tree)?);
                    let square = (0..3).map(|i| (to[i] - from[i]).powi(2)).sum::<Expr<'g>>().group();
                    let optional = |e: &Option<Expression>| e.as_ref().map(|e| self.scalar(e, tree)).transpose();
                    let stretched = match optional(length)? {
                        // Without a rest length no root is needed.
                        None => square,
                        Some(rest) => (square.sqrt() - rest).powi(2),
                    };
                    potentials.push((self.scalar(stiffness, tree)? * stretched).half());
                    if let Some(damping) = optional(damping)? {
                        let rate = square.sqrt().derivative(&self.rates).group();
                        act(Force::Dissipation((damping * rate.powi(2)).half()));
                    }
                }
                model::ForceKind::Spring { extent: Extent::Along(_), .. }
                | model::ForceKind::Stop { .. }
                | model::ForceKind::Drag { .. } => return Err(bug(clause.span)),
                model::ForceKind::Dissipation(function) => act(Force::Dissipation(self.scalar(function, tree)?)),
            }
        }
        Ok((forces, potentials))
    }

    fn link(&self, name: &Ident) -> syn::Result<usize> {
        self.links.get(&name.unraw().to_string()).copied().ok_or_else(|| bug(name.span()))
    }

    /// ψ of a scalar coordinate.
    fn rate_of_coordinate(&self, name: &Ident) -> syn::Result<Expr<'g>> {
        let index = self.model.coordinates.iter().position(|q| q.ident == *name).ok_or_else(|| bug(name.span()))?;
        Ok(self.declared.rate_of(index, &self.kinematics)[0])
    }
}

fn axes_of(axes: ForceAxes) -> Axes {
    match axes {
        ForceAxes::Body => Axes::Body,
        ForceAxes::Observer => Axes::Space,
    }
}

fn rotated<'g>(rotation: &[Triple<'g>; 3], a: &Triple<'g>) -> Triple<'g> {
    std::array::from_fn(|i| (0..3).map(|j| rotation[i][j] * a[j]).sum::<Expr<'g>>().group())
}
