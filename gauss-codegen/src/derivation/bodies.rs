//! The bodies of a scene as plain data, with one program of their places and mass data.

use crate::algebra::Expr;
use crate::emit::Derived;
use crate::error::Result;
use crate::kernel;
use crate::mechanics::Matter;
use crate::mistakes::bug;
use crate::program::{ArgumentKind, Program, Results};
use crate::words::Unraw;

use super::signature::{Signature, SignatureError};

/// Bodies, particles and frames of a scene for tools that write it in another language: names beside a program of
/// numbers. It refers to no scene.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Bodies {
    /// Parents before children.
    pub list: Vec<LinkData>,
    /// Names of what acts, in the order of the columns of `element_forces`.
    pub elements: Vec<String>,
    /// From parameters, time and configuration: the acceleration of free fall, then for each of the list
    /// [`NUMBERS`](Self::NUMBERS) numbers: O from Ω, R row by row, the mass, the centre of mass from O, the inertia.
    pub program: Program,
}

/// A body, a particle or a frame.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct LinkData {
    /// Its name; of a particle `particle` with its number.
    pub name: String,
    /// The kind of its matter.
    pub kind: LinkKind,
    /// Whether a fluid moves with it or carries it.
    pub in_fluid: bool,
    /// Whether its axes deform with modes.
    pub deforms: bool,
    /// Whether its mass data are functions of time.
    pub varies: bool,
}

/// The matter of a body, a particle or a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LinkKind {
    /// None.
    Frame,
    /// A mass at O; its axes have no meaning.
    Particle,
    /// Mass, centre of mass and inertia, which is about the centre of mass where that is said, else about O.
    Rigid {
        /// About the centre of mass.
        central: bool,
    },
}

impl Bodies {
    /// Numbers of each body.
    pub const NUMBERS: usize = 25;

    /// # Errors
    /// Mistakes of this crate.
    pub(super) fn of(derived: &Derived<'_, '_>) -> Result<Self> {
        let signature = Signature::new(derived);
        let program = program(derived, &signature).map_err(|malformed| bug(&derived.item().ident, &malformed))?;
        let elements = derived.accounts().into_iter().map(|account| account.name).collect();
        Ok(Self { list: list(derived), elements, program })
    }
}

fn list(derived: &Derived<'_, '_>) -> Vec<LinkData> {
    let (tree, data) = (&derived.subject.system.scene.tree, &derived.subject.provenance.mass_data);
    let mut particles = 0;
    let body = |(k, link): (usize, &crate::mechanics::Link<'_>)| {
        let own = data.bodies.iter().find(|body| body.link == k);
        let named =
            own.map(|body| body.name.as_ref().map_or_else(|| "body".to_owned(), |name| name.unraw().to_string()));
        let name = named.unwrap_or_else(|| {
            particles += 1;
            format!("particle_{particles}")
        });
        let kind = match &link.matter {
            Matter::Nothing => LinkKind::Frame,
            Matter::Particle(_) => LinkKind::Particle,
            Matter::Body(body) => LinkKind::Rigid { central: body.central.is_some() },
        };
        let in_fluid = link.body().is_some_and(|body| body.added_mass.is_some() || body.displaced.is_some());
        let deforms = tree.deformations.iter().any(|deformation| deformation.link == k);
        let instant = derived.subject.system.scene.matter_time;
        let moments = link.matter.moments(tree.graph);
        let varies = instant.is_some_and(|instant| !moments.map(|e| e.partial(instant)).is_zero());
        LinkData { name, kind, in_fluid, deforms, varies }
    };
    tree.links.iter().enumerate().map(body).collect()
}

fn program<'g>(derived: &Derived<'_, 'g>, signature: &Signature<'g>) -> std::result::Result<Program, SignatureError> {
    let tree = &derived.subject.system.scene.tree;
    let zero = tree.graph.zero();
    let own = tree.links.iter().find_map(|link| link.body()?.gravity);
    let mut outputs: Vec<Expr<'g>> = tree.gravity.or(own).unwrap_or([zero; 3]).to_vec();
    for (k, link) in tree.links.iter().enumerate() {
        outputs.extend(tree.pose_of(k));
        match &link.matter {
            Matter::Nothing => outputs.extend([zero; 13]),
            Matter::Particle(mass) => outputs.extend([*mass].into_iter().chain([zero; 12])),
            Matter::Body(body) => {
                let inertia = body.central.unwrap_or(body.inertia);
                outputs.extend([body.mass].into_iter().chain(body.center_of_mass));
                outputs.extend(inertia.into_iter().flatten());
            }
        }
    }
    let outputs: Vec<Expr<'g>> = outputs.into_iter().map(|e| e.substitute(derived.subject.definitions)).collect();
    let code = kernel::Program::lower(&outputs);
    let results = vec![Results::new("bodies", outputs.len(), 1)];
    let arguments = [ArgumentKind::Parameters, ArgumentKind::Time, ArgumentKind::Configuration];
    signature.program("bodies", &arguments, &code, results)
}
