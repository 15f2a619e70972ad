//! `#[derive(GaussDynamics)]`: equations of motion of rigid bodies derived at compile time, as flat Rust kernels.
//!
//! Depend on `gauss-runtime`, which re-exports the macro.

#![deny(missing_docs)]

mod kept;

/// Derives the equations of motion of rigid bodies from the Gauss condition, and generates `Name::kernel()`, the
/// `NameKernel` that implements `GaussSystem`, `Name::warnings()`, `NameState`: coordinates and speeds by name, and
/// `NameIndex`: the places of their increments in flat vectors.
/// Where the only matter is one body, however its coordinates and speeds are written, the kernel implements
/// `RigidBodySystem`, and `convert` carries states to others.
///
/// # The struct: `#[gauss(…)]`
///
/// | clause | values | default |
/// |---|---|---|
/// | `chart` | `left_invariant`: u and ω in body axes, pole O (Kirchhoff) | this one |
/// | | `right_invariant`: ξ = v_O + ω × (Ω − O) and ω in observer's axes, pole Ω (Newton–Euler) | |
/// | | `hybrid`: ḃ in observer's axes, ω in body axes | |
/// | | `jet(euler_zyx)` and the other eleven sequences, `jet(rodrigues)`, `jet(modified_rodrigues)`; `jet` in the plane: rates of coordinates (Lagrange) | |
/// | `motion` | `free`, `fixed_point` (O stays at Ω), `planar` (in k₁k₂) | `free` |
/// | `taylor` | alone: power series of the motion in time as well, for the integrator `Taylor`; of smooth systems without inputs | none |
/// | `linearize` | alone, also of systems: the kernel implements `LinearizedSystem`, exact derivatives of the equations by state, time and input; `linearize(parameters)`: by the parameters, too (`ParametricSystem`); `linearize(inverse)`: those of inverse dynamics, too (`InverseLinearizedSystem`); `linearize(hessian)`: second derivatives along given weights, too (`HessianSystem`); together `linearize(parameters, inverse, hessian)`; of a scene with contacts, ranges or dry friction, whose forces are not in the equations, it is written `linearize(without_contacts)` | not written: several times the code of the accelerations |
/// | `regressor` | alone, also of systems: the kernel implements `InertialRegressor`, the forces of inertia as a linear function of inertial parameters | not written |
/// | `frames` | `frames(tool, left_foot)`: names of bodies and frames, also of systems: the kernel implements `FramedSystem`, pose, twist, Jacobian and acceleration of each, and there is an enum `NameFrame` of them | not written |
/// | `reactions` | `reactions(upper, lower)`: joints by the bodies and frames that they carry, also of systems, in robots of files also by their own names: the kernel implements `Reactions`, force and torque with which each joint holds what it carries, in the axes of that and about its origin (under contact forces: `ContactReactions`), and there is an enum `NameJoint` of them | not written |
/// | `methods` | words, also of systems: `centroidal`, centre of mass and momenta about it (`CentroidalSystem`); `nonlinear_effects`, inverse dynamics at ż = 0 as a program of its own; `gravity_torques`, what holds the weight (`GravityTorques`); `jacobian_rates`, J̇ of the `frames` (`JacobianRates`) | not written |
/// | `python` | alone: a class of Python, by the crate `gauss-python`; see the guide, "From Python" | not written |
/// | `crate` | where the runtime is, when it has another name | `::gauss_runtime` |
///
/// # The fields: `#[gauss(role)]`
///
/// | role | type | meaning |
/// |---|---|---|
/// | `mass` | scalar | required |
/// | `inertia` | scalar (spherical), `Vector3` (principal), `Matrix3` (full) | about O, body axes; required, or the next. Of a body that turns about one of its axes alone, in a plane or on a hinge, the moment about that axis is all that is needed and all that is checked |
/// | `inertia_about_center_of_mass` | the same | about G, body axes, in the place of `inertia`: never carried through that about O, whose m c² would hide its digits where G is far from O |
/// | `center_of_mass` | `Vector3` | from O, body axes; without it O is the centre of mass |
/// | `added_mass` | `Vector6` (diagonal), `Matrix6` (full) | order (u, ω), about O, body axes; without it no fluid |
/// | `gravity` | scalar (along −k₃, in the plane −k₂), `Vector3` (observer's axes) | acceleration of free fall; without it no weight |
/// | `displaced_mass` | scalar | mass of the displaced fluid: buoyancy; needs `gravity` |
/// | `center_of_buoyancy` | `Vector3` | from O, body axes; without it buoyancy acts at O |
///
/// The last segment of the written type decides the shape. Behind an alias the role gives it:
/// `inertia = spherical | principal | full` (of `inertia_about_center_of_mass` too), `added_mass = diagonal | full`,
/// `gravity = vertical | vector`. The scalar is `f32`, `f64`, or a type parameter of the struct
/// (`struct Body<T> { … }`; the kernel is then generic over `T: Real`). Fields without a role are left alone.
///
/// Instead of fields the same words can be clauses of the struct:
/// `mass = 2.0, inertia = [a, a, c], center_of_mass = [0, 0, l]`, expressions of numbers and fields without a role;
/// `added_mass` is a list of six, or a field that is a `Vector6` or a `Matrix6`. Numbers that they determine are
/// computed when the code is generated (unless the scalar is a type parameter), and zeros and equal moments leave it. A
/// list of six is a full inertia, `[xx, xy, xz, yy, yz, zz]`.
///
/// # Configurations and order of z
///
/// | motion | configuration | left, hybrid, right z | jet coordinates |
/// |---|---|---|---|
/// | `free` | `Isometry3` | three linear, three angular | b₁ b₂ b₃, then the angles in the order of the name |
/// | `fixed_point` | `UnitQuaternion` | three angular | the angles |
/// | `planar` | `Isometry2` | two linear, ω | x, y, θ |
///
/// Jet charts have `SVector`s as configurations. `euler_zyx` is R = R_z(ψ) R_y(θ) R_x(φ), with angles (ψ, θ, φ), and so
/// on.
///
/// # States by name
///
/// Of a system the configuration is made of its elements of groups in the order in which they are declared, then of one
/// `SVector` of all its scalars, states of elements at its end: `A`, `(A, B)`, `(A, (B, C))`. Nobody needs to count:
/// `NameState` has a field for every coordinate, every state of an element and every speed, vectors as `Vector3`.
///
/// ```text
/// let start = SpacecraftState { angle: 0.3, spin: 2.0, ..Default::default() }; // the rest at the origin, at rest
/// simulation.run(start.q(), start.z(), 0.0..10.0)?;
/// let motor = |_t: f64, q: &_, z: &_| SVector::from([-k * SpacecraftState::of(q, z).angle]);
/// ```
///
/// Without `speeds` the speeds are called after their coordinates: `angle_dot` of a scalar, `craft_u` and `craft_omega`
/// of a pose, `attitude_omega` of a rotation. Charts have `pose` (`rotation` about a fixed point) and `u`, `xi` or
/// `b_dot` with `omega`; jet charts `b1`, `psi` …, `b1_dot`, `psi_dot` …. Of a vector of which `independent` keeps a
/// component that is called `w_x`.
///
/// Where there are inputs `NameInput` has them by name, of a wrench `contact_force` and `contact_torque`:
/// `SpacecraftInput { motor: 0.1, ..Default::default() }.input()` is what kernels take, `SpacecraftInput::of(&input)`
/// the way back.
///
/// # Frames
///
/// `frames(tool, hull)` has methods written for bodies and frames of the scene; in a chart its body is `body`. Names
/// stay as they are:
///
/// ```text
/// let pose = kernel.pose_of(ArmFrame::tool, t, &q);            // b and R, as the observer sees them
/// let twist = kernel.twist_of(ArmFrame::tool, t, &q, &z);      // (u, ω): of the origin, in the axes of the frame
/// let jacobian = kernel.jacobian_of(ArmFrame::tool, t, &q);    // (u, ω) = J z
/// let bias = kernel.bias_of(ArmFrame::tool, t, &q, &z);        // (a, ω̇) = J ż + bias, a the acceleration of the origin
/// let rate = kernel.jacobian_rate_of(ArmFrame::tool, t, &q, &z); // J̇, with methods(jacobian_rates): (a, ω̇) = J ż + J̇ z
/// let all = kernel.frames(t, &q, &z);                          // of all frames at once: all[ArmFrame::tool].twist
/// ```
///
/// Components are in the axes of the frame, the pole is its origin; `gauss_runtime::frames` turns them into observer's
/// axes and moves the pole. Each method is a program of its own, with its cost in `OPERATIONS.of_frames`. Forces at a
/// frame that arrive at run time are a wrench on it, one element with its power:
/// `input(contact: Wrench), wrench(ground, body = left_foot, force = contact.force, torque = contact.torque)`, in the
/// axes of the frame at its origin.
///
/// # What kernels refuse, and warnings
///
/// `kernel()` refuses what no body, spring or stop has: numbers that are not finite; masses, moments of inertia,
/// displaced masses and stiffness below zero; inertias that are not symmetric, or break the triangle inequality; stops
/// without width or with exchanged limits. Bodies that others move with can be without mass or without some moment
/// (rotors, forks, rods, plates) as long as the sum is regular. Of a body that turns about one of its axes alone no
/// other moment is looked at. `waive(triangle_inequality)` waives that rule for all bodies,
/// `waive(triangle_inequality = arm)` for one.
///
/// `warnings()` lists likely mistakes: drag and damping that feed energy, a `gravity` below zero, a center that pushes
/// away, added mass with the sign of the derivatives X_u̇ … N_ṙ.
/// `for warning in body.warnings() { println!("{warning}") }`.
///
/// # Systems
///
/// Any of these clauses but `point` and `limit` makes a system, as does a field that is a body; its kernel implements
/// `GaussSystem`, with `taylor` also `TaylorSystem`. Without `chart` and `motion` the coordinates are those of the
/// clauses. With one of the two, the body without a name, which is called `body`, moves in its chart: its
/// configuration, its speeds and their kinematics come first, those of the clauses after them, and whatever else there
/// is can hang on it or constrain it:
///
/// ```text
/// #[gauss(
///     chart = hybrid, coordinates(elbow),
///     body(arm, parent = body, position = [l, 0, 0], rotation = rotation_z(elbow), mass = m, inertia = [a, b, b]),
///     constraint(position = dot(arm.position, [0, 0, 1]) - h),
/// )]
/// ```
///
/// | clause | meaning |
/// |---|---|
/// | `coordinates(x, theta, pose: Pose, attitude: Rotation)` | the configuration: scalars, elements of SE(3) and of SO(3) |
/// | `speeds(v, u: Vector3)` and `kinematics(x = v, pose = twist(u, w), attitude = w)` | quasi-velocities z with q̇ = ψ(t, q, z), affine in z; a `Vector3` is three of them, `u.x` or `u[0]` and so on. A pose changes by its twist in body axes, pole O, a rotation by ω in body axes. Without speeds these rates are the z |
/// | `body(name, pose = craft)` | short for `position = craft.position, rotation = craft.rotation` |
/// | `body(position = […], rotation = …)` | the only body, where there is no chart; its mass data from the roles above |
/// | `body(name, parent = other, position = […], rotation = …)` | one of several; mass data from a field `#[gauss(body)] name: RigidBody<f64>`, or from the clause: `mass = m, center_of_mass = [0, 0, l], inertia = [a, a, c]` (about O, or `inertia_about_center_of_mass`); a field made by `RigidBody::about_center_of_mass` is `RigidBody<f64, AboutCenterOfMass<f64>>`, behind an alias `#[gauss(body = about_center_of_mass)]`; from the clause what the fluid does: `added_mass = x, displaced_mass = m, center_of_buoyancy = […]`, as above; position and rotation relative to the parent, a body or a frame |
/// | `frame(name, parent = other, position = […], rotation = …)` | a body without mass |
/// | `particle(mass = m, position = […], parent = other)` | a point with mass; the position in observer's axes from Ω, or in the axes of the parent from its O. Masses, centres of mass and inertias in clauses may be functions of `t`: `mass = m - burn * t`; `kernel()` checks those that are not |
/// | `point(name, body = other, at = […])` | a point fixed in a body or a frame, at numbers and fields in its axes from O |
/// | `constraint(position = expr)`, `constraint(velocity = expr)` | what is zero: a scalar, or a vector for three constraints at once, less those that are the same combination of the others everywhere, as across the plane of a loop |
/// | `contact(name, gap = expr, slip = expr, friction = mu, restitution = e)` | what may touch: a gap that does not become negative, a scalar as in constraints of positions. With friction the slip, the velocity along a tangent in the unit of the gap's rate, or `[expr, expr]` along two tangents that are normal to each other; μ may depend on all that forces do, e is made of numbers and fields. The kernel implements `ContactSystem`: its equations are those of the motion without contact forces, of which a solver makes use |
/// | `contact(name, point = tip, radius = r, plane = [0, 0, 1], height = h, along = [1, 0, 0], friction = mu)` | the same by geometry: a point (its name, `ball.position`, `[x, y, z]`), or the sphere of that radius about it, above a plane with this normal (in observer's axes, of any length; by default k₃, in plane motion k₂), whose distance from Ω may depend on `t`. The slip is that of the material point that touches, along two tangents, the first one as near to `along` as can be, and left out where it is always zero |
/// | `contact(…, friction = mu, drilling = l, rolling = rho)` | friction of drilling: the angular velocity about the normal times the length l, of fields and numbers, is a row more, and the sphere `λ₁² + λ₂² + λ₃² ≤ (μ λ_N)²` bounds all three; l is 2/3 of the radius of a patch with uniform pressure, 3π/16 with Hertz'. Rolling resistance: a contact `name_rolling` without a gap, whose torque against the angular velocity about the tangents is at most ρ λ_N; ρ is a length and may depend on what μ may. Of a gap of one's own these rates are `spin = w` and `roll = w` or `[a, b]` |
/// | `contact(name, point = wheel.position, rim = r, axis = [0, 1, 0], plane = …)` | the rim of a disk about the point; the axis is in the axes of the body. Where the disk lies flat the point that touches is not determined |
/// | `contact(name, point = stone.position, semi_axes = [a, b, c], plane = …)` | an ellipsoid about the point, with these semi-axes, each greater than 0, along the axes of its body, above a plane |
/// | `contact(name, point = hull.position, edges = [a, b, c], plane = …)` | a box about the point, with these edges along the axes of its body: a contact for each corner, `name_0` to `name_7`; the bits of the number, from the lowest, say on which side it is along each edge. Along an edge written `0` there is one corner: four in all for plane motion |
/// | `contact(name, point = knee, end = ankle, radius = r, plane = …)` | a capsule between two points: contacts `name_0` and `name_1` of its ends |
/// | `contact(name, point = drum.position, rim = r, axis = [0, 1, 0], length = l, plane = …)` | a cylinder: contacts `name_0` and `name_1` of its rims, before and behind the point along the axis |
/// | `contact(name, point = tip, height = k * sin(x) * y, over = [x, y], friction = mu)` | a point, or those of `edges` or `end`, above a ground that has this height over the horizontal place, whose coordinates `over` names (one name: the first axis alone; the third axis is up, in plane motion the second). The gap is the vertical distance times the normal's vertical component: zero where the distance is, and equal to it up to its square times the curvature. Tangents follow the slope, the first one above the first axis; where the height depends on `t` points of the ground move upward |
/// | `contact(name, point = a.position, radius = r, other = b.position, other_radius = s)` | two spheres; with `other_end = c` a sphere and a capsule from `other` to there, points of one body. With friction tangents turn with the line of centers: the first is normal to `along = […]` and to that line, which must not have this direction |
/// | `range(x, from = a, to = b, restitution = e)` | stops of a coordinate, or of `along = expr`, without friction: contacts `x_from` and `x_to`; either limit may be left out, both may depend on `t` and coordinates |
/// | `armature(elbow = a, wrist = 2 * a)` | inertia of the rates of coordinates, ½ a q̇² in T: rotors behind gears, of which a coordinate feels the inertia times the square of the ratio; of a `Rotation` ½ a ω², of a `Pose` ½ a (v² + ω²). It has no weight, and counts in no centre of mass and no momentum of the whole; a coordinate that no body moves with needs nothing else, and one of zero is refused there |
/// | `lock(knee = 0.3, slide = s)` | coordinates that never move, each at a number or at what fields and numbers make: the scene without them. The name stands for the value wherever it is written, and `rate(knee)` is zero; so is its speed, where `kinematics` says that its rate is one speed. What drives, brakes or loads the rate alone is a mistake, and so is the lock of a pose or a rotation. Constants of the potential energy that only it changed stay; the force that holds it is asked for by `motion(knee = a)` in place of the lock, or by `reactions(…)` |
/// | `motion(crank = w * t, slide = f(t))` | coordinates that are functions of time, of `t`, fields and numbers: the scene with the function in the place of the name, and `rate(crank)` is its derivative; so is its speed, where `kinematics` says that its rate is one speed. The kernel implements `DrivenSystem`, the force that drives each and its power, and there is an enum `NameMotion` of them. What acts on the coordinate stays and is part of the balance: weight, springs, `drive`, `armature`, friction; of `dry_friction(crank, bound = f)` the drive overcomes f. A `range` of it is a mistake, and so is the motion of a pose or a rotation, a coordinate with a lock and a motion, a function that is not smooth, and one of what moves |
/// | `modes(panel, coordinates = [a, b], file = "panel.json")` | a body that bends: scalar coordinates η multiply modes that are clamped to its axes at O. The file (feature `modes`), or arguments in its place, gives integrals of the modes: `translation` ∫φ dm and `rotation` ∫x × φ dm, a row of three for each mode; `mass`, `stiffness`, `damping`, matrices or their diagonals, of which `mass` is by default the unit matrix; of higher order `inertia`, `shortening`, `gyroscopic`, `second_inertia`, which the guide has in a table. The file may have the mass data of the body: `mass`, `center_of_mass`, `inertia` about O |
/// | `independent(v, w.x)` | the speeds that stay, or components of them, when the constraints are solved for the others at compile time. Those of a chart are called `u`, `xi` or `b_dot`, each of all its components, and `omega`; of jet charts `b1_dot`, `psi_dot` and so on |
/// | `waive(triangle_inequality)` | see above |
/// | `limit = 50000` | the most operations that the generated code may have, also of one body |
///
/// # Robots from their files
///
/// With the features `urdf` and `mjcf` of gauss-runtime a file declares joints and links, and the struct needs no
/// fields:
///
/// ```text
/// #[derive(GaussDynamics)]
/// #[gauss(urdf = "robots/arm.urdf", gravity = 9.81)]
/// struct Arm;
///
/// let kernel = Arm.kernel()?;
/// let start = ArmState { elbow: 0.3, ..Default::default() };
/// ```
///
/// | clause | meaning |
/// |---|---|
/// | `urdf = "robots/arm.urdf"` | links and joints of this file, whose path is relative to the folder of the package. An edit of it compiles the struct anew; meshes are not looked for |
/// | `mjcf = "robots/arm.xml"` | the same of an MJCF file |
/// | `base = fixed`, `base = floating` | of a URDF: the root is at Ω, which is the default, or moves freely: then the first coordinate is `base: Pose`, with the twist of the root in its own axes for speeds, linear before angular |
/// | `base(position = [0, 0, h], rotation = rotation_x(pi))` | where the root is held: the origin and the axes of the file in those of the observer, expressions of fields, numbers and time; each argument may be left out. Gravity, planes and contacts stay the observer's. In MJCF not with bodies that move freely |
/// | `inputs = all`, `none`, `transmissions` | an effort of every joint that turns or slides, the default of a URDF, of none, or of those that a transmission or an actuator drives, the default of MJCF |
/// | `inputs = actuators` | the controls of transmissions and actuators, by their names and with their gears, gains and biases: of a motor its torque, of a servo where it is to go |
/// | `joint_friction = dry`, `smooth(w)`, `none` | dry friction f (`<dynamics friction>`, `frictionloss` of hinges and slides) exactly, as `dry_friction(elbow, bound = f)`; or as −f v/√(v² + w²), v the rate of the joint; or none, as without the clause, but without the warning |
/// | `limits = stop(stiffness = k, width = e, damping = c)`, `none` | the limits of joints as stops; or none, as without the clause, but without the warning |
/// | `lock(wrist = 0.5, finger = open)` | joints with one coordinate that are held, by the names of the file or of their coordinates: no coordinate, speed, input, limit, spring, damping, friction or armature of theirs is left, which a remark says, and a warning of actuators that drive nothing else; joints that follow one stand where it puts them; tendons and equalities keep the value. At a number the joint is as good as fixed, and masses are added; a number beyond its limits is a mistake, unless `limits = none`. At a field links are bodies of their own, placed by it |
/// | `motion(wrist = a * sin(w * t))` | joints with one coordinate that are functions of time, called as those of `lock`: springs, damping, friction and armature of the file are part of the driving force; the input and the limits are left out, which a remark says, as are actuators that drive nothing else and contacts of links that nothing else moves. Numbers in it may have any unit |
/// | `ground(links = [left_foot, right_foot], friction = mu, restitution = e, plane = [0, 0, 1], height = h, along = [1, 0, 0], cylinders = 8)`, `ground` | contacts of the file's shapes with a plane, as if they had been written by `contact(…)`; each argument may be left out. All links that move, or those that are named; the plane is as of `contact(…)`, or without `plane` and `height` those of the file; without `friction` that of the geoms. Spheres, boxes, capsules, and cylinders by their rims or by so many points for each. Several clauses are several planes |
/// | `self_contact(links = [left_hand, trunk], friction = mu, along = [0, 0, 1], restitution = e)`, `self_contact` | contacts of the file's links with one another: of spheres with spheres and capsules, as if they had been written by `contact(…)`; each argument may be left out. All links, or those that are named; friction, the file's where it is not given, needs `along` |
/// | `saturation = clamp`, `none` | controls, forces and efforts are kept in their ranges: what is beyond is cut off exactly, so that derivatives are zero there. `ctrlrange` and `forcerange` belong to actuators, and act with `inputs = actuators`; `actuatorfrcrange`, and `effort` of a URDF unless it is zero, to joints. Or they do not act, as without the clause, but without the warning |
/// | `parameters = inertial` | the mass data of every link that moves are fields `#[gauss(body)] upper_arm: RigidBody<f64>`; such fields can also be there for some links alone. `Arm::from_file(…)` has the values of the file; the other fields of the struct are its arguments, in their order |
/// | `ignore(gazebo, contact)` | elements and attributes of the file that are known not to act: no warnings of these |
///
/// The file becomes clauses, and those of the struct come after them: more bodies, coordinates, forces, constraints,
/// inputs, fields. Its names are kept: a joint that turns or slides is a scalar coordinate `elbow`; a planar one
/// `slide_x`, `slide_y`, `slide_theta` in the plane normal to its axis; a floating one a pose. One that mimics another
/// has no coordinate; what mimics a fixed one is fixed. A link is a body of its name, in the axes of the file; one
/// without a moving joint is a frame, and what it weighs is added to the link that it is fixed to. Coordinates and
/// efforts have the order of the file.
///
/// ```text
/// let start = ArmState { elbow: 0.3, ..Default::default() };                     // elbow_dot is its rate
/// let input = ArmInput { elbow: 2.0, ..Default::default() }.input();             // N m; input.elbow in expressions
/// let pose = kernel.pose_of(ArmFrame::named("tool0").unwrap(), 0.0, &start.q()); // with frames(tool0)
/// ```
///
/// In expressions `input.elbow` is this input, also where `elbow` is the coordinate:
/// `drive(wrist = 0.1 * input.elbow)`.
///
/// The force elements are called `efforts`, `joint_damping`, `joint_friction`, and `elbow_limits`. A URDF has no
/// `gravity`: without the clause or a field nothing weighs. Rotors of transmissions (`rotorInertia`) are armatures,
/// with the square of `mechanicalReduction`.
///
/// Contacts with a ground have the names of their shapes, or else of their links; where a shape has several, with
/// numbers from zero: `sole_0`. A name that is taken gets a number: `foot_2`, `sole_2_0`. The points that they are of
/// are `foot_point`, unless they are origins of links; an ellipsoid turned in its link has a frame, `foot_frame`. Of
/// MJCF `contype`, `conaffinity`, `priority`, `condim`, sliding `friction` and `<exclude>` act as MuJoCo has them;
/// planes of what is fixed are the ground. Of a ground that is the struct's own the bits are 1, it is excluded as
/// `world` is, and the friction is that of the geom. Links touch each other by `self_contact(…)`, in the same way, and
/// not what they hang on, but for the world; `filterparent` and `<pair>` act as MuJoCo has them, pairs with planes by
/// `ground(…)`. Points that stay clear of a plane whatever moves make no contacts with it. What is not read (meshes,
/// height fields, shapes of the world that are no planes, `margin`, friction of turning and rolling, capsules and boxes
/// that touch other shapes) is a warning where it would act.
///
/// Of MJCF there are read: bodies, frames, joints of all kinds, several in a body, about anchors, with references,
/// damping, dry friction, springs (`elbow_spring`), also of balls and free joints, `springdamper` of joints that move
/// alone, armature and ranges; stiffness and damping of up to three numbers, of x, x², x³ and of v, v |v|, v³, whose
/// part that is not linear is a force `joint_laws`; damping and armature of actuators; inertials, and the masses of
/// geoms, of shells as well, of meshes in STL and OBJ files (by `inertia="exact"`, `legacy`, `convex` or `shell`; faces
/// of four corners are cut along the shorter diagonal, of more by ears), of the groups in `inertiagrouprange`, within
/// bounds, scaled to `settotalmass`; classes of defaults; what a body's `gravcomp` holds of its weight; what flags
/// switch off; angles and Euler sequences of the compiler; sites as frames; gravity, where the struct has none;
/// equalities of joints, linear ones as coupled joints, others and those of fixed tendons as constraints; points in
/// common and welds as
/// constraints; springs and dampers of tendons, fixed ones and spatial ones through sites and pulleys, slack over a
/// range; actuators along joints and fixed tendons that are linear in their control, with gains that may depend on
/// length and rate, in balls and free joints, and at sites, without `refsite`: those are torques and wrenches, each
/// with its control for an input whatever `inputs` asks for. A ball is driven by a torque of the first three numbers of
/// its gear, in the axes of its child, with `jointinparent` in those that these have where nothing is turned, and its
/// parent by the opposite one. A ball is a `Rotation`, a free joint a `Pose`; armature, damping and springs act in
/// both. The range of a ball is that of the angle φ of its turn about whatever direction: what stays below its limit is
/// −cos φ/sin φ₀, which is smooth also where φ is 0, and beyond φ₀ by as much as φ while both are near. The spring of a
/// turn is a torque −k φ n, MuJoCo's: no potential energy counts it, and it jumps where φ is half a
/// revolution. Keyframes are functions `ArmState::home()`, by their names, and `ArmInput::home()` where inputs are
/// controls; `ArmState::start()` is where the file has everything at first, if that is not zero. `<include>` puts what
/// is in the root of another file in its place: its path is relative to the folder of the first, or else to that of the
/// file that includes it, and no file is included twice. `<replicate>` copies what is in it, and what refers to that;
/// `<attach>` hangs a body of another model, or another like one that stands before it, with what refers to it. An edit
/// of any of these files, and of meshes, compiles the struct anew; mistakes are shown where they are written.
///
/// Files may be anywhere, also behind links, as for `include_str!`. They are regular files, of 16 MiB at most with all
/// that they include, a mesh of 64 MiB; elements are nested 256 deep at most, includes 32; a file attaches 32 models,
/// and replicates 100 times, a thousand copies each. What is beyond is a mistake with its place.
///
/// Nothing is left out in silence: a table has every element and attribute of both formats, as one that acts, that is
/// warned of, or that is harmless. Whatever acts in the file and not in the equations (elements and attributes that are
/// not known, laws of joints with several speeds, actuators with states) is a warning of the compiler with its line,
/// one for all of a kind. The page of the kernel lists these, names that are no identifiers or taken and have been
/// changed, and elements without effect on the motion, such as looks. Numbers of the file are
/// literals. Mistakes in it are shown at its name, with line and column: `robots/arm.urdf:12:3: …`; so are inertias
/// that no body has, unless `waive(triangle_inequality = arm)` allows them.
///
/// # What acts
///
/// These clauses stand in systems, and beside `chart` and `motion`. There the body of the chart is called `body`, as is
/// the only body of a system that has no name of its own; in a chart `body = body` can be left out, and `at = …` is in
/// body axes.
///
/// | clause | meaning |
/// |---|---|
/// | `potential = expr` | a potential of coordinates and time; the role `gravity` acts on everything |
/// | `central_gravity(name, mu = gm, center = […])` | the acceleration −μ d/\|d\|³ of all mass, d from the center, of each body expanded to second order about its O, which is to be near its mass; `mu` of fields and numbers, `center` of these and `t` in observer's axes from Ω, by default Ω |
/// | `medium(velocity = […])` | the velocity of the medium, observer's axes, of `t`, fields and numbers: drags, added mass and `relative_velocity` feel it |
/// | `input(thrust = "N", wind: Vector3 = "m/s", gust: Wrench)` | values that arrive at run time, with their units if these are to be checked; of a wrench force then torque, `gust.force` and `gust.torque` |
/// | `states(thrust = (command - thrust) / lag, …)` | states of elements, each with its rate: a scalar of what forces may name, states among them, with kinks as in forces. They are scalars of the configuration behind all others, without speeds and without energy: kinetic and potential energy do not have them, constraints and impacts do not move them. In a chart the configuration is `(pose, states)` |
/// | `define(u = body.relative_velocity, q = u.x * u.x)` | names for expressions: scalars, vectors or rotations. A definition can name those before it and stands for what it is, wherever that may stand; printed equations keep the names |
/// | `force(name, at = …, value = […])` | without a chart: a force at a point, both in observer's axes, the point from Ω |
/// | `force(name, body = other, at = […], value = […], axes = body)` | a force at a point fixed in a body or a frame, at numbers and fields in its axes from O or at a `point` of that body by its name, by default at O; the value in `axes = body`, which is the default, or `axes = observer` |
/// | `torque(name, body = other, value = […], axes = body, reaction = another)` | a torque, and the opposite one on another body or frame; axes as above |
/// | `coupling(name, body = other, other = another, viscous = c)` | a viscous coupling: the torque −c (ω − ω′) on `body`, with the angular velocities of the two bodies or frames, and its reaction on `other` |
/// | `wrench(name, body = other, at = […], force = […], torque = […], axes = body)` | a force, a torque or both; place and axes as above |
/// | `drag(name, body = other, linear = d, quadratic = e)` | −D V − Q (\|V\| V), with V = (u, ω) relative to the medium, body axes, pole O, \|V\| V component by component: coefficients are a list of six scalars, which can depend on what forces depend on, or a field `Vector6` (diagonal) or `Matrix6`. One of the two or both |
/// | `drive(name, theta = expr, x = expr)` | generalised forces on scalar coordinates, each of the power `expr` · dθ/dt |
/// | `spring(name, from = …, to = …, stiffness = k, length = l, damping = c)` | a spring with a damper between two points, observer's axes from Ω; `length`, at which it is without force, and `damping` are 0 by default. It is one element: its power is that of both |
/// | `spring(name, along = theta, stiffness = k, length = l, damping = c)` | the same along any scalar of coordinates and time, such as the angle of a joint |
/// | `torsional_spring(name, body = other, other = another, stiffness = k, angle = a, damping = c)` | a torsional spring with a damper between two bodies or frames: the potential ½ k (θ − a)², and −c dθ/dt, with the twist θ of `body` relative to `other` about their third axes: the angle of the turn about e₃ that is nearest to the relative rotation. θ − a is between −π and π: the torque jumps where it is half a turn. `angle`, at which it is without torque, and `damping` are 0 by default. Frames choose other axes |
/// | `bushing(name, body = other, other = another, stiffness = k, damping = c)` | a bushing between two bodies or frames: the potential ½ xᵀKx and the dissipation function ½ ẋᵀCẋ, with the place x of `body` relative to `other`: the displacement from the one O to the other O in the axes of `other`, then the Cardan angles (α, β, γ) of the relative rotation `rotation_x(α) * rotation_y(β) * rotation_z(γ)`, with β between −π/2 and π/2. Coefficients are a list of six scalars, a field `Vector6` (diagonal) or a symmetric `Matrix6`. `kernel()` refuses a matrix that is not symmetric, and a stiffness with a negative eigenvalue; `warnings()` finds damping with one. One of the two or both |
/// | `stop(name, along = theta, least = a, most = b, stiffness = k, width = e, damping = c)`, `stop(name, from = …, to = …, …)` | pushes back what leaves the limits, of which one is enough, by k s²/√(x² + e²) with s = (x + √(x² + e²))/2 and x the distance beyond the limit: k x far beyond it. It sets in before: ¼ k e at the limit, 0.03 k e at −e, k e⁴/16\|x\|³ far before; all of it is smooth, so that power series and large steps go through |
/// | `friction(name, along = theta, viscous = d, dry = f, width = w)`, `friction(name, from = …, to = …, …)` | −d ẋ − f ẋ/√(ẋ² + w²) along a scalar of coordinates and time, or the distance of two points: viscous and dry friction, one of which is enough. The dry part is f far beyond the width, 0.7 f at it, and smooth: what it holds creeps, by the rate w F/√(f² − F²) under a force F |
/// | `mass_flow(name, body = other, at = […], velocity = […], thrust = […], axes = body)` | matter that a body whose `mass` is a function of `t` loses or takes up at a place fixed in it: the force ṁ u with the `velocity` u relative to the body that it has there, and what matter that flows toward the place, without swirl about it, does to a body that turns (2 ω × w, jet damping). `thrust` is a force at the same place: of the pressure, or all of it. One of the two or both; one place for each body. Without it matter leaves and enters everywhere with the velocity of the body |
/// | `damping = expr` | Rayleigh's dissipation function: its negative partial derivatives by z are generalised forces |
/// | `point(name, body = other, at = […])` | as above |
/// | `function(lift, derivative = lift_slope, second = …)`, `function(lift = aero::lift, derivative = …)` | a smooth function of one number, `lift(x)` in expressions, that is written in Rust: `fn(f64) -> f64`, of a generic scalar `fn<T: Real>(T) -> T`. The derivative is needed in potentials, constraints and `linearize`, where the second may be |
/// | `table(lift, points = LIFT, kind = linear)` | the same through the points of `const LIFT: [[f64; 2]; N] = [[x, y], …]`, x increasing: joined by straight lines, which is the default and stands where `abs` may; `kind = hermite`: by cubics with the slopes of parabolas through three neighbours, one continuous derivative; `kind = cubic`: by the natural spline, two of them. Beyond the ends all go on straight |
/// | `table(drag, axes = [ALPHA, MACH], values = DRAG, kind = linear)` | of one, two or three numbers, `drag(alpha, mach)`: `const ALPHA: [f64; N]` and `const MACH: [f64; M]` increase, `const DRAG: [[f64; M]; N]` has the value at `ALPHA[i]` and `MACH[j]` in `DRAG[i][j]`; of three `[[[f64; L]; M]; N]`. Joined by the same kinds along each axis, whatever their order; beyond the grid straight along each axis |
///
/// What acts can have a name, which no expression uses.
///
/// # Expressions
///
/// Rust arithmetic on coordinates, speeds, states, fields, definitions, `pi` and the time `t`, with
/// `sin cos tan asin acos atan atan2 tanh exp ln sqrt hypot powi powf dot cross`, functions that clauses declare, and
/// the rotations `rotation_x rotation_y rotation_z inverse`, which are joined by `*` and turn vectors by `*`. A
/// coordinate that is a `Rotation` is one of them; a `Pose` has `pose.position` and `pose.rotation`. Components are
/// `v.x` or `v[0]`. The exponent of `powi` is an integer literal, that of `powf` is made of numbers and fields, and its
/// base is not negative. A `rotation_z(pi / 2)` is exact.
///
/// | where | what else |
/// |---|---|
/// | particles without a parent, potentials, constraints, points of forces, springs, stops, gaps, points of contacts, ranges | points, which are position vectors; of bodies and frames `arm.position` (of O) and `arm.rotation`, all from Ω in observer's axes |
/// | constraints of velocities, slips; values of forces, torques, wrenches and drives; coefficients of drags; `friction` of contacts; `damping`; rates of `states` | the same; speeds; `arm.velocity` (of O) and `arm.angular_velocity` in observer's axes; `arm.body_velocity`, `arm.body_angular_velocity` and `arm.relative_velocity` (of O, relative to the medium) in body axes; of poses and rotations the same but the last, of points `tip.velocity`; the time derivative `rate(expr)` of what has no speeds in it |
/// | values of forces, torques, wrenches and drives; coefficients of drags; `friction` of contacts; `damping`; rates of `states` | inputs; states |
/// | the same without `damping` | `abs min max clamp(x, low, high) signum smooth_step(x, from, to)`, which are not smooth; the last is 0 below `from`, 1 above `to` and 3s² − 2s³ between |
///
/// # Units
///
/// Fields and inputs can have units: `#[gauss(unit = "N s^2/m^2")] k: f64`, `#[gauss(mass, unit = "kg")] m: f64`,
/// `input(rudder = "rad")`. One unit that is written has all of the scene checked: terms of sums, arguments of
/// functions, and what stands where N, N m, J, W, m or m/s are needed. Roles have the units of the SI, `t` is in s,
/// positions and velocities of bodies are in m, m/s and rad/s. What has no unit, such as coordinates, agrees with
/// everything; so does a number in a sum or alone, while as a factor it is a pure number: `2 * t` is in s.
///
/// Units are coherent ones of the SI, since values are used as they are: `kg m s N J W Pa Hz rad 1`. They are joined by
/// a space, `*` or `·`; what follows `/` divides, and several factors after one `/` stand in brackets, `kg/(m s)`;
/// powers are whole, `m^2`, `s^-1` or `m²`. A radian has no dimension. A wrench is in N and N m, and what has parts
/// with different units, such as added mass, a `RigidBody` or the coefficients of a drag as a field, takes none.
///
/// # Errors
///
/// Every mistake is a compile error at the token that is wrong, all of them at once. What is too long, too deep or too
/// large to be derived within 10 s and 1 GB is a mistake like others; powers have at most 100 factors. What uses the
/// kernel of such a struct gives no further errors.
#[proc_macro_derive(GaussDynamics, attributes(gauss))]
pub fn derive_gauss_dynamics(input: proc_macro::TokenStream) -> proc_macro::TokenStream {
    let (input, vectors) = (input.into(), may_have_vectors());
    kept::or_derived(&input, &[vectors.into()], || {
        let item = gauss_codegen::item(input.clone()).map_err(|mistake| mistake.into_compile_error())?;
        let expand = if vectors { gauss_codegen::expand } else { gauss_codegen::expand_without_vectors };
        expand(&item).map_err(|mistakes| gauss_codegen::fallback(&item, &mistakes))
    })
    .unwrap_or_else(|mistakes| mistakes)
    .into()
}

/// Whether the code may be compiled for processors with vectors of products that are rounded once.
///
/// Without `--target` Cargo compiles macros with the flags of all else, so this crate knows them by its own. With it
/// macros have other flags: then code is written with vectors as well, and the runtime, which has the flags of the
/// code, takes one form of it.
fn may_have_vectors() -> bool {
    cfg!(all(target_feature = "avx", target_feature = "fma"))
        || std::env::args_os().any(|argument| argument.as_encoded_bytes().starts_with(b"--target"))
}
