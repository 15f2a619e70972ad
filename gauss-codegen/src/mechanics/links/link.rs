//! Links: bodies, frames and particles where they hang. Each is placed and moves relative to its parent, and its
//! partial velocities are taken relative to the parent's too, so that every quantity is formed once, from the one
//! before.

use crate::algebra::{Expr, Graph, Map};

use crate::mechanics::kinematics::chart::ChartedBody;
use crate::mechanics::kinematics::rotation::product;
use crate::mechanics::kinematics::turn::{Turn, angular_velocity, inward};
use crate::mechanics::kinematics::vector::{Axes, Frame, Triple, Vector, add, cross, is_zero, subtract};
use crate::mechanics::matter::added_mass::impulse;
use crate::mechanics::matter::body::Body;
use crate::mechanics::matter::moments::Moments;
use crate::mechanics::tidy::compact;

/// Matter of a link.
#[derive(Clone)]
pub enum Matter<'g> {
    /// A frame.
    Nothing,
    /// A particle (3.3), by its mass.
    Particle(Expr<'g>),
    Body(Box<Body<'g>>),
}

impl<'g> Matter<'g> {
    /// About O, body axes.
    pub fn moments(&self, graph: &'g Graph) -> Moments<'g> {
        match self {
            Self::Nothing => Moments::zero(graph),
            Self::Particle(mass) => Moments::particle(*mass),
            Self::Body(body) => Moments::of_body(body),
        }
    }
}

/// A link as it is given: relative to its parent's O and axes, or to Ω and k.
#[derive(Clone)]
pub struct Placement<'g> {
    pub matter: Matter<'g>,
    /// Index of an earlier link.
    pub parent: Option<usize>,
    pub position: Triple<'g>,
    /// Velocities of O and of the axes of a root, each part in the axes where it is simplest, where they are known so;
    /// else they follow from the position and the turns.
    pub velocity: Option<Vector<'g>>,
    pub angular_velocity: Option<Vector<'g>>,
    pub turns: Vec<Turn<'g>>,
}

impl<'g> ChartedBody<'g> {
    /// The body as a root, on which nothing hangs if it is alone.
    pub fn placement(&self, matter: Matter<'g>, alone: bool) -> Placement<'g> {
        Placement {
            matter,
            parent: None,
            position: self.kinematics.position,
            velocity: Some(self.kinematics.velocity),
            angular_velocity: Some(self.kinematics.angular_velocity),
            turns: self.turns(alone),
        }
    }
}

impl<'g> Placement<'g> {
    /// The placement with other expressions in place of those that depend on speeds.
    pub fn map_velocities(&self, f: impl Fn(Expr<'g>) -> Expr<'g>) -> Self {
        Self {
            velocity: self.velocity.map(|v| v.map(&f)),
            angular_velocity: self.angular_velocity.map(|v| v.map(&f)),
            turns: self.turns.iter().map(|turn| turn.with_spin(turn.spin.map(&f))).collect(),
            ..self.clone()
        }
    }
}

/// Position and turns of a link relative to its parent.
#[derive(Clone)]
pub struct Joint<'g> {
    /// From the link's axes to the parent's (to k for a root).
    pub turns: Vec<Turn<'g>>,
    /// O − O_parent and its rate, in the parent's axes.
    pub offset: Triple<'g>,
    pub offset_rate: Triple<'g>,
}

/// A link with its motion. Its *working axes*, in which components are taken, are the body's own, k throughout where
/// everything moves in the plane, or those of the parent in a [`WorkingFrame`].
#[derive(Clone)]
pub struct Link<'g> {
    pub matter: Matter<'g>,
    pub parent: Option<usize>,
    pub has_children: bool,
    /// From the working axes to k.
    pub frame: Frame<'g>,
    /// Between body axes, and between working axes.
    pub own_joint: Joint<'g>,
    pub joint: Joint<'g>,
    /// Velocity of O beyond what the parent's motion gives, and angular velocity relative to the parent: body axes.
    pub velocity_beyond: Triple<'g>,
    pub spin: Triple<'g>,
    /// O − Ω, observer's components.
    pub position: Triple<'g>,
    /// From body axes to k.
    pub rotation: [Triple<'g>; 3],
    /// From body to working axes where these are others.
    pub turned: Option<Turn<'g>>,
    /// From O to the pole that is worked with, body axes.
    pub shift: Triple<'g>,
    /// Velocity of O. Below a root, in working axes alone.
    pub velocity: Vector<'g>,
    /// Working axes.
    pub angular_velocity: Triple<'g>,
    /// The same with each part in the axes where it is simplest.
    pub angular_velocity_in_parts: Vector<'g>,
    /// Angular velocity of the body beyond that of its working axes, which a rotor leaves behind.
    pub spin_beyond_axes: Triple<'g>,
    /// ∂v_O/∂z^α and ∂ω/∂z^α beyond what the parent's motion gives.
    pub linear_rows: Vec<Vector<'g>>,
    pub angular_rows: Vec<Triple<'g>>,
    /// Pole O; body axes until [`settle`](Self::settle) takes them to the working axes.
    pub moments: Moments<'g>,
    /// The same in body axes, once parents have what moves with them as well.
    pub moments_in_body: Moments<'g>,
}

/// The working pole and the working axes of a link, in which its sums are formed. The scene gives the link about its O
/// and in body axes.
pub struct WorkingFrame<'g> {
    /// From O to the pole, body axes.
    pub shift: Triple<'g>,
    /// From the parent's pole, the parent's body axes.
    pub own_offset: Triple<'g>,
    /// Between working axes and poles.
    pub joint: Joint<'g>,
    /// From body to working axes where these are others.
    pub turned: Option<Turn<'g>>,
}

/// A link where it hangs.
struct HangingLink<'g> {
    own_joint: Joint<'g>,
    joint: Joint<'g>,
    frame: Frame<'g>,
    rotation: [Triple<'g>; 3],
    turned: Option<Turn<'g>>,
    velocity_beyond: Triple<'g>,
    spin: Triple<'g>,
}

impl<'g> Joint<'g> {
    /// Between working axes: those of the bodies, or k throughout where everything moves in the plane.
    fn in_working_axes(&self, graph: &'g Graph, parent: Option<&Link<'g>>, planar: bool) -> Self {
        match parent {
            _ if !planar => self.clone(),
            None => Self { turns: Vec::new(), ..self.clone() },
            Some(p) => {
                let turned = |a: &Triple<'g>| grouped(Frame { graph, rotation: p.rotation }.to_space(a));
                let (offset, offset_rate) = (turned(&self.offset), turned(&self.offset_rate));
                Self { turns: Vec::new(), offset, offset_rate }
            }
        }
    }
}

/// Position and velocities of a link; its own velocity is the part that its parent does not give it.
struct LinkMotion<'g> {
    position: Triple<'g>,
    velocity: Vector<'g>,
    angular_velocity: Triple<'g>,
    own_velocity: Vector<'g>,
}

impl<'g> LinkMotion<'g> {
    /// Motion of a link that its parent carries. In the plane its own angular velocity is added.
    fn with(parent: &Link<'g>, frame: &Frame<'g>, joint: &Joint<'g>, planar: Option<&Triple<'g>>) -> Self {
        let angular_velocity = match planar {
            Some(spin) => add(&parent.angular_velocity, spin),
            None => angular_velocity(&joint.turns, &parent.angular_velocity),
        };
        let u = parent.frame.resolve(&parent.velocity, Axes::Body);
        let carried = grouped(add(&u, &add(&cross(&parent.angular_velocity, &joint.offset), &joint.offset_rate)));
        let position = add(&parent.position, &grouped(parent.frame.to_space(&joint.offset)));
        let velocity = frame.body_vector(inward(&joint.turns, &carried));
        let own_velocity = frame.body_vector(inward(&joint.turns, &joint.offset_rate));
        Self { position, velocity, angular_velocity, own_velocity }
    }
}

fn grouped(a: Triple<'_>) -> Triple<'_> {
    a.map(Expr::group)
}

impl<'g> Link<'g> {
    pub fn new(
        graph: &'g Graph,
        placement: Placement<'g>,
        parent: Option<&Self>,
        planar: Option<usize>,
        speeds: &[Expr<'g>],
        rates: &Map<u32, Expr<'g>>,
    ) -> Self {
        let Placement { matter, parent: index, position: offset, velocity: known, angular_velocity: known_spin, turns } =
            placement;
        let turns = Turn::merged(turns, rates);
        // In the plane angles add up; else rotations are multiplied.
        let whole = planar.map(|axis| {
            let before = parent.and_then(|p| p.turned.as_ref()).into_iter();
            let angles = before.chain(&turns).filter_map(Turn::axis_and_angle).map(|(_, angle)| angle);
            Turn::about(graph, axis, angles.fold(graph.zero(), |sum, angle| sum + angle), rates)
        });
        let turned = |r, turn: &Turn<'g>| product(&r, &turn.matrix).map(grouped);
        let rotation = match &whole {
            Some(turn) => turn.matrix,
            None => turns.iter().fold(parent.map_or_else(|| identity(graph), |p| p.rotation), turned),
        };
        let own_joint = Joint { turns, offset, offset_rate: offset.map(|e| e.derivative(rates)) };
        let spin = angular_velocity(&own_joint.turns, &[graph.zero(); 3]);
        let velocity_beyond = match known {
            Some(velocity) if is_zero(&velocity.space) => velocity.body,
            _ => inward(&own_joint.turns, &own_joint.offset_rate),
        };
        let joint = own_joint.in_working_axes(graph, parent, planar.is_some());
        let frame = Frame { graph, rotation: if planar.is_some() { identity(graph) } else { rotation } };
        let hung = HangingLink { own_joint, joint, frame, rotation, turned: whole, velocity_beyond, spin };
        Self::hung(hung, (matter, index), parent, (known, known_spin), (planar.is_some(), speeds))
    }

    /// Computes position and motion of a link that hangs.
    fn hung(
        hung: HangingLink<'g>,
        (matter, index): (Matter<'g>, Option<usize>),
        parent: Option<&Self>,
        (known, known_spin): (Option<Vector<'g>>, Option<Vector<'g>>),
        (planar, speeds): (bool, &[Expr<'g>]),
    ) -> Self {
        let HangingLink { own_joint, joint, frame, rotation, turned, velocity_beyond, spin } = hung;
        let LinkMotion { position, velocity, angular_velocity: omega, own_velocity } = match parent {
            None => {
                let velocity = known.unwrap_or_else(|| frame.space_vector(joint.offset_rate));
                LinkMotion { position: own_joint.offset, velocity, angular_velocity: spin, own_velocity: velocity }
            }
            Some(parent) => LinkMotion::with(parent, &frame, &joint, planar.then_some(&spin)),
        };
        // Working axes that stay behind turn with those of the parent alone.
        let spin_beyond_axes = match (&turned, joint.turns.last()) {
            (Some(_), Some(last)) => {
                let above = parent.map_or([frame.graph.zero(); 3], |parent| parent.spin_beyond_axes);
                add(&inward(&joint.turns, &above), &last.spin)
            }
            _ => [frame.graph.zero(); 3],
        };
        let named = |e: Expr<'g>| compact(e).group();
        let linear_rows = speeds.iter().map(|&z| own_velocity.partial(z).map(named)).collect();
        let turning = if planar { spin } else { angular_velocity(&joint.turns, &[frame.graph.zero(); 3]) };
        let angular_rows = speeds.iter().map(|&z| turning.map(|e| named(e.partial(z)))).collect();
        let moments = matter.moments(frame.graph);
        Self {
            matter,
            parent: index,
            has_children: false,
            own_joint,
            joint,
            velocity_beyond,
            spin,
            position,
            rotation,
            turned,
            shift: [frame.graph.zero(); 3],
            velocity,
            angular_velocity: omega,
            spin_beyond_axes,
            angular_velocity_in_parts: known_spin.unwrap_or_else(|| frame.body_vector(omega)),
            frame,
            linear_rows,
            angular_rows,
            moments,
            moments_in_body: moments,
        }
    }

    /// The same link by another pole and other working axes. Its moments are those that were given, in body axes.
    pub fn described(&self, parent: Option<&Self>, by: WorkingFrame<'g>, speeds: &[Expr<'g>]) -> Self {
        let WorkingFrame { shift, own_offset, joint, turned } = by;
        let own_joint = Joint { offset: own_offset, ..self.own_joint.clone() };
        let through = |r, turn: &Turn<'g>| product(&r, &turn.matrix).map(grouped);
        let graph = self.frame.graph;
        let start = parent.map_or_else(|| identity(graph), |p| p.frame.rotation);
        let frame = Frame { graph, rotation: joint.turns.iter().fold(start, through) };
        let hung = HangingLink {
            own_joint,
            joint,
            frame,
            rotation: self.rotation,
            turned,
            velocity_beyond: self.velocity_beyond,
            spin: self.spin,
        };
        let root = self.parent.is_none();
        let known = (root.then_some(self.velocity), root.then_some(self.angular_velocity_in_parts));
        let mut link = Self::hung(hung, (self.matter.clone(), self.parent), parent, known, (false, speeds));
        link.has_children = self.has_children;
        link.shift = shift;
        if !is_zero(&shift) {
            link.moments = link.moments.shifted(&shift.map(|e| -e)).map(Expr::group);
        }
        link
    }

    /// Takes the moments from body to working axes.
    pub fn settle(&mut self) {
        self.moments_in_body = self.moments;
        self.moments = self.turned_moments(&self.moments);
    }

    /// Moments in working axes, of those in body axes.
    pub fn turned_moments(&self, moments: &Moments<'g>) -> Moments<'g> {
        self.turned.map_or(*moments, |turn| moments.turned(&[turn]))
    }

    pub fn body(&self) -> Option<&Body<'g>> {
        match &self.matter {
            Matter::Body(body) => Some(body),
            _ => None,
        }
    }

    /// Mass of the displaced fluid and its centre from O, working axes.
    pub fn displaced(&self) -> Option<(Expr<'g>, Triple<'g>)> {
        let (mass, center) = self.body()?.displaced?;
        Some((mass, self.turned.map_or(center, |turn| turn.vector(&center).map(Expr::group))))
    }

    /// The body axes along which ω has a component.
    pub fn turns_about(&self) -> Vec<usize> {
        let (_, omega) = self.twist();
        (0..3).filter(|&axis| !omega[axis].is_zero()).collect()
    }

    /// Angular velocity of the working axes, in these.
    pub fn axes_velocity(&self) -> Triple<'g> {
        match is_zero(&self.spin_beyond_axes) {
            true => self.angular_velocity,
            false => subtract(&self.angular_velocity, &self.spin_beyond_axes).map(Expr::group),
        }
    }

    /// The only working axis that it turns about.
    pub fn only_axis(&self) -> Option<usize> {
        let still = |axis: usize| self.angular_velocity[axis].is_zero();
        (0..3).find(|&axis| !still(axis) && still((axis + 1) % 3) && still((axis + 2) % 3))
    }

    /// Components in working axes, of a vector given in body axes or in observer's.
    pub fn in_working_axes(&self, a: &Triple<'g>, axes: Axes) -> Triple<'g> {
        match (axes, &self.turned) {
            (Axes::Body, Some(turn)) => turn.vector(a),
            (Axes::Body, None) => *a,
            (Axes::Space, _) => self.frame.to_body(a),
        }
    }

    /// The body axes e seen from k, whatever the working axes are.
    pub fn axes(&self) -> Frame<'g> {
        Frame { graph: self.frame.graph, rotation: self.rotation }
    }

    /// Components in body axes.
    pub fn in_body_axes(&self, a: &Vector<'g>) -> Triple<'g> {
        match &self.turned {
            Some(turn) => turn.back(&self.frame.resolve(a, Axes::Body)).map(Expr::group),
            None => self.frame.resolve(a, Axes::Body).map(Expr::group),
        }
    }

    /// u = Rᵀ v_O and ω, body axes.
    pub fn twist(&self) -> (Triple<'g>, Triple<'g>) {
        (self.in_body_axes(&self.velocity), self.in_body_axes(&self.frame.body_vector(self.angular_velocity)))
    }

    /// Whether its working axes are the body's own.
    pub fn works_in_body_axes(&self) -> bool {
        self.turned.is_none()
    }

    /// Whether nothing is joined to it: its velocities may then keep parts in both frames.
    pub fn is_alone(&self) -> bool {
        self.parent.is_none() && !self.has_children
    }

    /// Whether the speed moves it in another way than its parent.
    pub fn is_moved_by(&self, speed: usize) -> bool {
        let row = &self.linear_rows[speed];
        !is_zero(&row.body) || !is_zero(&row.space) || !is_zero(&self.angular_rows[speed])
    }

    /// `linear·a_α + angular·o_α` with the partial velocities relative to the parent's.
    pub fn project(&self, speed: usize, linear: &Vector<'g>, angular: &Triple<'g>) -> Expr<'g> {
        self.frame.dot(linear, &self.linear_rows[speed])
            + crate::mechanics::kinematics::vector::dot(angular, &self.angular_rows[speed])
    }

    /// (Q, Γ_O) of moments that move with v_O and ω; body and fluid.
    pub fn momentum(
        &self,
        moments: &Moments<'g>,
        velocity: &Vector<'g>,
        omega: &Triple<'g>,
    ) -> (Vector<'g>, Triple<'g>) {
        let zero = [self.frame.graph.zero(); 3];
        let added = self.body().and_then(|body| body.added_mass.as_ref());
        // What vanishes with O = G need not be turned.
        let coupled = added.is_some() || !is_zero(&moments.first);
        let u = if coupled { self.frame.resolve(velocity, Axes::Body) } else { zero };
        let (beside, mut gamma) = moments.momentum(&u, omega);
        let mut q = velocity.times(moments.mass).plus(&self.frame.body_vector(beside));
        if let Some(added) = added {
            let (impulse, moment) = impulse(added, &u, omega);
            q = q.plus(&self.frame.body_vector(impulse));
            gamma = add(&gamma, &moment);
        }
        (q.map(Expr::group), gamma.map(Expr::group))
    }
}

pub fn identity(graph: &Graph) -> [Triple<'_>; 3] {
    std::array::from_fn(|i| std::array::from_fn(|j| if i == j { graph.one() } else { graph.zero() }))
}
