//! Words of the field that the language does not have, and the clauses of the language with the same meaning.

use super::words::Table;
use crate::terms::Role;

/// Entry for `word`, if it is a word of this table; case and underscores count for nothing.
pub fn instead<T: Copy>(word: &str, table: &Table<T>) -> Option<T> {
    let plain = |name: &str| name.replace('_', "").to_lowercase();
    table.iter().find(|(name, _)| plain(name) == plain(word)).map(|&(_, entry)| entry)
}

/// The argument of a clause with these arguments that is written in the place of `word`, if that is a word of the field
/// and none of them, and what to know of it.
pub fn argument<T: Copy>(word: &str, table: &Table<T>) -> Option<(&'static str, &'static str)> {
    let is_one = |word: &&str| table.iter().any(|(name, _)| name == word);
    let name = *instead(word, FOR_ARGUMENTS).filter(|_| !is_one(&word))?.iter().find(|name| is_one(name))?;
    Some((name, NOTES.iter().find(|(noted, _)| *noted == name).map_or("", |(_, note)| note)))
}

const STATES: &str = "the configuration is declared by `coordinates(x, pose: Pose)`";
const STATE: &str = "the configuration is declared by `coordinates(x, pose: Pose)`, and what an element remembers, with its \
                     rate, by `states(x = …)`";
const RATES: &str = "speeds of one's own are `speeds(v), kinematics(x = v)`; without them the rates are taken";
const LINK: &str = "a rigid body is `body(arm, parent = other, position = […], rotation = …)`";
const HINGE: &str = "a hinge is a body that a coordinate turns: `coordinates(angle), \
                     body(arm, parent = other, rotation = rotation_z(angle))`";
const SLIDER: &str = "a slider is a body that a coordinate moves: `coordinates(x), body(cart, parent = other, \
                      position = [x, 0, 0])`";
const BALL: &str = "a ball joint is a coordinate that is a rotation: `coordinates(turn: Rotation), \
                    body(arm, parent = other, rotation = turn)`";
const FIXED: &str = "a place fixed in a body is `frame(name, parent = other, position = […])`, or `point(…)`";
const POINT_MASS: &str = "a point with mass is `particle(mass = m, position = […])`";
const MOMENT: &str = "a moment is `torque(body = other, value = [0, 0, m])`";
const THRUST: &str = "a value that arrives at run time is an input, and acts by a clause: `input(thrust), force(body = hull, at = […], \
                      value = [thrust, 0, 0])`; with the mass that it burns `mass_flow(…)`";
const FLOW: &str = "mass that varies is a function of time, `body(hull, mass = m - burn * t, …)`, and matter that leaves the \
                    body or enters it at a place is `mass_flow(body = hull, at = […], velocity = […])`";
const MOTOR: &str = "a motor is an input with a torque and its reaction: `input(motor), torque(body = wheel, \
                     value = [0, 0, motor], reaction = hull)`, or `drive(angle = motor)`";
const INPUT: &str = "a value that arrives at run time is declared by `input(name)`, and acts where `force(…)`, `torque(…)` or \
                     `drive(…)` names it";
const LOAD: &str = "a force is `force(body = hull, at = […], value = […])`";
const WEIGHT: &str = "weight is `gravity = 9.81` here, or a field with `#[gauss(gravity)]`; it acts on all mass";
const BUOYANCY: &str = "buoyancy is `displaced_mass` with `center_of_buoyancy`: roles of fields, or arguments of \
                        `body(…)`; it needs `gravity`";
const STREAM: &str = "a wind or a current is `medium(velocity = […])`: drags and added mass feel it";
const RESISTANCE: &str = "resistance is `drag(linear = [six numbers], quadratic = [six numbers])`, or `force(…)` with \
                          `body.relative_velocity` in its value";
const LIFT: &str = "lift is `force(body = hull, at = […], value = […])`, with `body.relative_velocity` and a `function(…)` or a \
                    `table(…)` in its value";
const DAMPER: &str = "a damper is `friction(along = x, viscous = c)`, or `damping = c` of a `spring(…)`";
const BUSHING: &str = "a bushing between two bodies is `bushing(body = arm, other = hull, stiffness = [six numbers], \
                       damping = [six numbers])`";
const TORSION: &str = "a torsional spring between two bodies is `torsional_spring(body = arm, other = hull, stiffness = k)`, \
                       about their third axes; along a coordinate `spring(along = angle, stiffness = k)`";
const COUPLING: &str = "a viscous coupling of two bodies is `coupling(body = wheel, other = hull, viscous = c)`";
const ROLLING: &str = "rolling without slip is `constraint(velocity = …)`; a loop is `constraint(position = …)`";
const CONTACT: &str = "a contact is `contact(name, gap = height, slip = v, friction = mu, restitution = e)`; one that gives \
                       way `stop(along = height, least = 0, stiffness = k, width = e)`";
const UNILATERAL: &str = "a distance that may open and not become negative is `contact(name, gap = height)`; a coordinate \
                          that stays between two values `range(x, from = a, to = b)`";
const IMPACT: &str = "impacts follow from what touches and need no clause: `contact(name, gap = height, restitution = e)`, or \
                      `range(x, from = a, to = b, restitution = e)`; their law is chosen at run time, `Impact::Newton` of \
                      `gauss-contact`";
const REACTION: &str = "what a joint bears is asked for by `reactions(arm)`, with the names of bodies; the other side of a moment is an \
                        argument, `torque(body = arm, value = [0, 0, m], reaction = hull)`";
const DRY_FRICTION: &str = "dry friction of a bound is `dry_friction(x, bound = f)` of a coordinate, or \
                            `dry_friction(name, slip = v, bound = f)`, v the velocity relative to what rubs";
const RANGE: &str = "limits of a coordinate are `range(x, from = a, to = b)`; limits that give way \
                     `stop(along = x, least = a, most = b, stiffness = k, width = e)`";
const GEAR: &str = "a gear is one coordinate for both: `rotation = rotation_z(n * angle)`; the inertia of a rotor behind \
                    it is `armature(angle = a)`";
const ROTOR: &str = "a wheel is a body that a coordinate turns: `coordinates(angle), body(wheel, parent = hull, \
                     rotation = rotation_z(angle), mass = m, inertia = [a, a, c])`";
const LOCK: &str = "a coordinate that never moves is left out by `lock(angle = a)`; with the force that holds it, it is \
                    `motion(angle = a)`";
const MOTION: &str =
    "a coordinate that is a function of time is `motion(angle = w * t)`, with the force that drives it";
const MODES: &str = "a body that bends has modes: `body(panel, parent = hull), modes(panel, coordinates = [a, b], \
                     file = \"panel.json\")`";
const ENERGY: &str = "the kinetic energy follows from bodies and particles; a potential is `potential = …`";
const INTEGRATOR: &str = "the integrator and its steps are chosen at run time: `Simulation::new(&kernel).adaptive(1e-9, 1e-12)`, or \
                          `.fixed_step(1e-3)`";
const RUN: &str = "where a run starts and how long it takes is told to it: `Simulation::new(&kernel).adaptive(1e-9, \
                   1e-12).run(q, z, 0.0..10.0)`, with q and z of `NameState { x: 0.1, ..Default::default() }`";
const LAW: &str = "a control law is given to the run: `input(u)` here, and `Simulation::new(&kernel).input(|t, q, z| …)`, or \
                   `.sampled(period, |t, q, z| …)` where it samples or remembers";
const DELAY: &str = "a delay is one of the run, behind a controller that samples: `Simulation::new(&kernel).sampled(period, \
                     law).delayed(time)`; a lag of first order is `states(late = (command - late) / lag)`";
const LAG: &str = "what lags or remembers has states with rates: `states(late = (command - late) / lag)`";
const EVENT: &str = "events are those of the run: `Simulation::new(&kernel).event(Crossing::Falling, |t, q, z| …)`, `.until(…)` \
                     where the run ends, `.then(|state| …)` behind either where the state jumps";
const NOISE: &str = "random numbers are drawn by the run: `input(noise)` here, and a `Stream` of `gauss-study` in the closure \
                     of `.sampled(period, |t, q, z| …)`";
const STUDY: &str =
    "the fields of the struct are its parameters, and a `Declaration` of `gauss-study` draws them for many runs";
const OUTPUT: &str = "what comes out is asked of the run: `.observe(|sample| …)`, or `run.table().column(\"x\", |s| …)` of \
                      `gauss-tables`; a place in a body is `frame(name, parent = other, position = […])`";
const FORM: &str = "the equations are in the speeds and in the momenta; the run chooses: `.momentum_form()`";
const NO_CONTACTS: &str = "contacts are left out by the run: `Simulation::new(&kernel).without_contacts()`";
const FURTHER: &str =
    "second derivatives and those of inverse dynamics are words of `linearize`: `linearize(hessian, inverse)`";
const SENSITIVITY: &str = "derivatives by parameters are `linearize(parameters)`, those of a whole run are taken by \
                           `gauss-sensitivity`";
/// Friction that is not a function of the speed.
const BRISTLES: &str = "friction with a state, as LuGre's and Dahl's, is written as `states(bristle = …)` and \
                        `drive(x = …)`; LuGre's is the example of the guide's chapter `Elements with states`";
const STRIBECK: &str = "friction that falls with the speed is a law of your own, as `drive(x = -f * exp(-abs(v) / \
                        slow) * tanh(v / width))`; LuGre's, with a state, is the example of the guide's chapter \
                        `Elements with states`";
const PARAMETER: &str = "the fields of the struct are its parameters, by their names";
const DAMPED: &str = "a robot's joints are damped as in its file; others by `friction(along = angle, viscous = c)`";
const DERIVATIVES: &str = "derivatives of the equations are `linearize`; Jacobians of bodies and frames `frames(…)`";
const POSITION: &str = "where something is belongs into its clause: `body(arm, position = […], rotation = …)`";
const UNITS: &str = "units are those of fields and inputs: `#[gauss(unit = \"N\")]`, `input(thrust = \"N\")`";
const REFERENCE: &str = "the observer needs no clause; a frame with a known motion is `frame(name, position = …)`";

/// In the place of a clause of the struct.
pub const FOR_CLAUSES: &Table<&'static str> = &[
    ("state", STATE),
    ("dof", STATES),
    ("degrees_of_freedom", STATES),
    ("generalized_coordinates", STATES),
    ("generalised_coordinates", STATES),
    ("configuration", STATES),
    ("velocity", RATES),
    ("velocities", RATES),
    ("quasi_velocities", RATES),
    ("rates", RATES),
    ("link", LINK),
    ("rigid_body", LINK),
    ("hinge", HINGE),
    ("joint", HINGE),
    ("revolute", HINGE),
    ("pin", HINGE),
    ("pivot", HINGE),
    ("axle", HINGE),
    ("slider", SLIDER),
    ("prismatic", SLIDER),
    ("rail", SLIDER),
    ("ball_joint", BALL),
    ("spherical", BALL),
    ("fixed", FIXED),
    ("weld", FIXED),
    ("site", FIXED),
    ("marker", FIXED),
    ("point_mass", POINT_MASS),
    ("moment", MOMENT),
    ("couple", MOMENT),
    ("thrust", THRUST),
    ("thruster", THRUST),
    ("propeller", THRUST),
    ("engine", THRUST),
    ("exhaust", FLOW),
    ("nozzle", FLOW),
    ("rocket", FLOW),
    ("fuel", FLOW),
    ("propellant", FLOW),
    ("mass_rate", FLOW),
    ("variable_mass", FLOW),
    ("motor", MOTOR),
    ("actuator", MOTOR),
    ("servo", MOTOR),
    ("control", INPUT),
    ("controls", INPUT),
    ("command", INPUT),
    ("inputs", INPUT),
    ("load", LOAD),
    ("push", LOAD),
    ("external_force", LOAD),
    ("weight", WEIGHT),
    ("gravitation", WEIGHT),
    ("g", WEIGHT),
    ("buoyancy", BUOYANCY),
    ("displacement", BUOYANCY),
    ("wind", STREAM),
    ("current", STREAM),
    ("stream", STREAM),
    ("flow", STREAM),
    ("water", STREAM),
    ("resistance", RESISTANCE),
    ("aerodynamics", RESISTANCE),
    ("hydrodynamics", RESISTANCE),
    ("lift", LIFT),
    ("wing", LIFT),
    ("rudder", LIFT),
    ("fin", LIFT),
    ("damper", DAMPER),
    ("dashpot", DAMPER),
    ("viscous", DAMPER),
    ("mount", BUSHING),
    ("rubber_mount", BUSHING),
    ("compliance", BUSHING),
    ("torsion", TORSION),
    ("torsion_spring", TORSION),
    ("rotational_spring", TORSION),
    ("rotary_spring", TORSION),
    ("viscous_coupling", COUPLING),
    ("rotational_damper", COUPLING),
    ("torsional_damper", COUPLING),
    ("joint_damping", DAMPED),
    ("rolling", ROLLING),
    ("no_slip", ROLLING),
    ("nonholonomic", ROLLING),
    ("holonomic", ROLLING),
    ("loop_closure", ROLLING),
    ("unilateral", UNILATERAL),
    ("unilateral_constraint", UNILATERAL),
    ("complementarity", UNILATERAL),
    ("impact", IMPACT),
    ("impulse", IMPACT),
    ("restitution", IMPACT),
    ("reaction", REACTION),
    ("joint_force", REACTION),
    ("bearing", REACTION),
    ("collision", CONTACT),
    ("ground", CONTACT),
    ("floor", CONTACT),
    ("brake", DRY_FRICTION),
    ("belt", DRY_FRICTION),
    ("clutch", DRY_FRICTION),
    ("coulomb", DRY_FRICTION),
    ("stiction", DRY_FRICTION),
    ("limits", RANGE),
    ("locked", LOCK),
    ("freeze", LOCK),
    ("prescribed", MOTION),
    ("prescribe", MOTION),
    ("prescribed_motion", MOTION),
    ("rheonomic", MOTION),
    ("joint_limits", RANGE),
    ("bumper", RANGE),
    ("gear", GEAR),
    ("transmission", GEAR),
    ("rotor", ROTOR),
    ("wheel", ROTOR),
    ("flywheel", ROTOR),
    ("flexible", MODES),
    ("flex", MODES),
    ("appendage", MODES),
    ("modal", MODES),
    ("beam", MODES),
    ("kinetic_energy", ENERGY),
    ("lagrangian", ENERGY),
    ("energy", ENERGY),
    ("integrator", INTEGRATOR),
    ("solver", INTEGRATOR),
    ("timestep", INTEGRATOR),
    ("adaptive", INTEGRATOR),
    ("fixed_step", INTEGRATOR),
    ("step", INTEGRATOR),
    ("steps", INTEGRATOR),
    ("step_size", INTEGRATOR),
    ("dt", INTEGRATOR),
    ("tolerance", INTEGRATOR),
    ("tolerances", INTEGRATOR),
    ("first_step", INTEGRATOR),
    ("largest_step", INTEGRATOR),
    ("input_changes_within", INTEGRATOR),
    ("max_steps", INTEGRATOR),
    ("runge_kutta", INTEGRATOR),
    ("run", RUN),
    ("run_to_end", RUN),
    ("attempt", RUN),
    ("simulate", RUN),
    ("simulation", RUN),
    ("start", RUN),
    ("initial", RUN),
    ("initial_state", RUN),
    ("initial_conditions", RUN),
    ("duration", RUN),
    ("end_time", RUN),
    ("controller", LAW),
    ("feedback", LAW),
    ("control_law", LAW),
    ("pid", LAW),
    ("regulator", LAW),
    ("sample", LAW),
    ("sampled", LAW),
    ("sampled_by", LAW),
    ("sampling", LAW),
    ("sample_time", LAW),
    ("input_from", LAW),
    ("initially", LAW),
    ("hold", LAW),
    ("delay", DELAY),
    ("delayed", DELAY),
    ("delayed_samples", DELAY),
    ("time_delay", DELAY),
    ("dead_time", DELAY),
    ("latency", DELAY),
    ("lag", LAG),
    ("filter", LAG),
    ("low_pass", LAG),
    ("integral", LAG),
    ("memory", LAG),
    ("event", EVENT),
    ("events", EVENT),
    ("event_each", EVENT),
    ("until", EVENT),
    ("until_each", EVENT),
    ("until_each_bounded", EVENT),
    ("then", EVENT),
    ("then_through", EVENT),
    ("jump", EVENT),
    ("switch", EVENT),
    ("trigger", EVENT),
    ("stop_when", EVENT),
    ("zero_crossing", EVENT),
    ("noise", NOISE),
    ("white_noise", NOISE),
    ("disturbance", NOISE),
    ("random", NOISE),
    ("distribution", STUDY),
    ("uncertainty", STUDY),
    ("monte_carlo", STUDY),
    ("sweep", STUDY),
    ("observe", OUTPUT),
    ("observe_by", OUTPUT),
    ("every", OUTPUT),
    ("output", OUTPUT),
    ("outputs", OUTPUT),
    ("sensor", OUTPUT),
    ("measurement", OUTPUT),
    ("log", OUTPUT),
    ("record", OUTPUT),
    ("plot", OUTPUT),
    ("csv", OUTPUT),
    ("momentum_form", FORM),
    ("form", FORM),
    ("without_contacts", NO_CONTACTS),
    ("hessian", FURTHER),
    ("inverse", FURTHER),
    ("inverse_dynamics", FURTHER),
    ("sensitivity", SENSITIVITY),
    ("sensitivities", SENSITIVITY),
    ("gradient", SENSITIVITY),
    ("parameter", PARAMETER),
    ("parameters", PARAMETER),
    ("constant", PARAMETER),
    ("jacobian", DERIVATIVES),
    ("derivatives", DERIVATIVES),
    ("position", POSITION),
    ("rotation", POSITION),
    ("units", UNITS),
    ("world", REFERENCE),
    ("observer", REFERENCE),
];

const TURN: &str = "a rotation by a quaternion, or by a vector, is one coordinate: `coordinates(turn: Rotation)` with \
                    `rotation = turn`; turns by angles are `rotation_x(a)`, `rotation_y(b)` and `rotation_z(c)`";

/// In the place of a function.
pub const FOR_FUNCTIONS: &Table<&'static str> = &[
    ("quaternion", TURN),
    ("quat", TURN),
    ("unit_quaternion", TURN),
    ("rotation", TURN),
    ("rotation_quaternion", TURN),
    ("rotation_from_quaternion", TURN),
    ("from_quaternion", TURN),
    ("rotation_vector", TURN),
    ("axis_angle", TURN),
];

/// Laws of friction that neither a clause nor an argument of one has: in the place of both.
pub const LAWS: &Table<&'static str> = &[
    ("lugre", BRISTLES),
    ("dahl", BRISTLES),
    ("bristle", BRISTLES),
    ("bristles", BRISTLES),
    ("presliding", BRISTLES),
    ("maxwell_slip", BRISTLES),
    ("bouc_wen", BRISTLES),
    ("stribeck", STRIBECK),
];

/// In the place of the role of a field: what is meant, if it is a role.
pub const FOR_ROLES: &Table<(Option<Role>, &'static str)> = &[
    ("m", (Some(Role::Mass), "write `mass`")),
    ("weight", (Some(Role::Gravity), "weight follows from `mass` and `gravity`")),
    ("g", (Some(Role::Gravity), "write `gravity`")),
    ("gravitation", (Some(Role::Gravity), "write `gravity`")),
    ("com", (Some(Role::CenterOfMass), "write `center_of_mass`, from O in body axes")),
    ("cog", (Some(Role::CenterOfMass), "write `center_of_mass`, from O in body axes")),
    ("cg", (Some(Role::CenterOfMass), "write `center_of_mass`, from O in body axes")),
    ("center_of_gravity", (Some(Role::CenterOfMass), "write `center_of_mass`, from O in body axes")),
    ("centre_of_gravity", (Some(Role::CenterOfMass), "write `center_of_mass`, from O in body axes")),
    ("centroid", (Some(Role::CenterOfMass), "write `center_of_mass`, from O in body axes")),
    ("moment_of_inertia", (Some(Role::Inertia), "write `inertia`, about O in body axes")),
    ("moments_of_inertia", (Some(Role::Inertia), "write `inertia`, about O in body axes")),
    ("inertia_tensor", (Some(Role::Inertia), "write `inertia`, about O in body axes")),
    ("principal_moments", (Some(Role::Inertia), "write `inertia`, about O in body axes")),
    ("cob", (Some(Role::CenterOfBuoyancy), "write `center_of_buoyancy`, from O in body axes")),
    ("cb", (Some(Role::CenterOfBuoyancy), "write `center_of_buoyancy`, from O in body axes")),
    ("buoyancy", (Some(Role::DisplacedMass), "write `displaced_mass`, in kg")),
    ("volume", (Some(Role::DisplacedMass), "write `displaced_mass`: the density of the fluid times the volume, in kg")),
    ("displacement", (Some(Role::DisplacedMass), "write `displaced_mass`, in kg")),
    ("added_inertia", (Some(Role::AddedMass), "write `added_mass`, six numbers or a matrix")),
    ("hydrodynamic_mass", (Some(Role::AddedMass), "write `added_mass`, six numbers or a matrix")),
    ("rigid_body", (Some(Role::Body), "write `body`")),
    ("parameter", (None, "a field that clauses name needs no attribute")),
    ("constant", (None, "a field that clauses name needs no attribute")),
    (
        "stiffness",
        (None, "a field that clauses name needs no attribute; a spring is the clause `spring(…)` of the struct"),
    ),
    ("length", (None, "a field that clauses name needs no attribute")),
    ("position", (None, "where a body is at the start is an argument of the run, not of the struct")),
    ("velocity", (None, "how fast a body is at the start is an argument of the run, not of the struct")),
];

/// In the place of an argument of a clause: the first of these that the clause has.
pub const FOR_ARGUMENTS: &Table<&[&str]> = &[
    ("m", &["mass"]),
    ("com", &["center_of_mass"]),
    ("cog", &["center_of_mass"]),
    ("cg", &["center_of_mass"]),
    ("center_of_gravity", &["center_of_mass"]),
    ("centre_of_gravity", &["center_of_mass"]),
    ("centroid", &["center_of_mass"]),
    ("i", &["inertia"]),
    ("moment_of_inertia", &["inertia"]),
    ("moments_of_inertia", &["inertia"]),
    ("inertia_tensor", &["inertia"]),
    ("principal_moments", &["inertia"]),
    ("inertia_about_com", &["inertia_about_center_of_mass"]),
    ("central_inertia", &["inertia_about_center_of_mass"]),
    ("cob", &["center_of_buoyancy"]),
    ("cb", &["center_of_buoyancy"]),
    ("buoyancy", &["displaced_mass"]),
    ("displacement", &["displaced_mass"]),
    ("added_inertia", &["added_mass"]),
    ("hydrodynamic_mass", &["added_mass"]),
    ("offset", &["position", "at"]),
    ("origin", &["position", "at"]),
    ("translation", &["position"]),
    ("location", &["position", "at"]),
    ("place", &["position", "at"]),
    ("xyz", &["position"]),
    ("pos", &["position", "at"]),
    ("position", &["at"]),
    ("point", &["at"]),
    ("application_point", &["at"]),
    ("orientation", &["rotation"]),
    ("attitude", &["rotation"]),
    ("quaternion", &["rotation"]),
    ("rpy", &["rotation"]),
    ("angle", &["rotation", "along"]),
    ("rest_angle", &["angle", "length"]),
    ("free_angle", &["angle", "length"]),
    ("axis", &["along", "rotation"]),
    ("joint", &["along"]),
    ("coordinate", &["along"]),
    ("attached_to", &["parent", "body"]),
    ("relative_to", &["parent"]),
    ("reference", &["parent"]),
    ("link", &["body", "parent"]),
    ("on", &["body"]),
    ("acts_on", &["body"]),
    ("child", &["body"]),
    ("against", &["reaction", "other"]),
    ("reaction", &["other"]),
    ("other", &["reaction"]),
    ("second", &["other", "reaction"]),
    ("vector", &["value"]),
    ("magnitude", &["value"]),
    ("moment", &["torque"]),
    ("expressed_in", &["axes"]),
    ("frame", &["axes", "parent"]),
    ("k", &["stiffness"]),
    ("spring_constant", &["stiffness"]),
    ("rate", &["stiffness"]),
    ("rest_length", &["length"]),
    ("natural_length", &["length"]),
    ("free_length", &["length"]),
    ("unstretched", &["length"]),
    ("damper", &["damping", "viscous"]),
    ("c", &["damping", "viscous"]),
    ("d", &["damping", "viscous"]),
    ("viscosity", &["viscous"]),
    ("damping", &["viscous"]),
    ("viscous", &["damping"]),
    ("coulomb", &["dry", "friction", "bound"]),
    ("mu", &["friction"]),
    ("torsional", &["drilling"]),
    ("pivoting", &["drilling"]),
    ("rolling_resistance", &["rolling"]),
    ("rolling_friction", &["rolling"]),
    ("level", &["dry", "bound"]),
    ("dry", &["bound"]),
    ("friction", &["bound"]),
    ("distance", &["gap"]),
    ("tangent", &["slip"]),
    ("bounce", &["restitution"]),
    ("elasticity", &["restitution"]),
    ("min", &["least"]),
    ("lower", &["least"]),
    ("max", &["most"]),
    ("upper", &["most"]),
    ("smoothing", &["width"]),
    ("start", &["from"]),
    ("begin", &["from"]),
    ("end", &["to"]),
    ("speed", &["velocity"]),
    ("exhaust", &["velocity"]),
    ("relative_velocity", &["velocity"]),
    ("exit", &["at"]),
    ("nozzle", &["at"]),
    ("wind", &["velocity"]),
    ("current", &["velocity"]),
];

/// Notes on an argument that had another name.
const NOTES: &Table<&str> = &[
    ("center_of_mass", ", from O in body axes"),
    ("center_of_buoyancy", ", from O in body axes"),
    ("inertia", ", about O in body axes, or `inertia_about_center_of_mass`"),
    ("displaced_mass", ", in kg"),
    ("added_mass", ", six numbers or a matrix"),
];
