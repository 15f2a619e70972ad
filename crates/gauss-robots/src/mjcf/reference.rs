//! Verdicts on every element and attribute of MJCF, by MuJoCo's reference
//! (<https://mujoco.readthedocs.io/en/stable/XMLreference.html>; the schema of version 4.0, and what earlier ones had).

use crate::reference::Verdict::{self, Acts, Harmless, Warned};
use crate::reference::{Attributes, Element, element, whole};

const NAME: Verdict = Harmless("a name that nothing asks for");
const LOOKS: Verdict = Harmless("how it looks");
const USER: Verdict = Harmless("data that MuJoCo only keeps");
const CONTACT: Verdict = Harmless("how MuJoCo finds contacts, and how softly it holds them: they hold exactly here");
const SOLVER: Verdict = Harmless("how MuJoCo solves, and how softly it holds constraints: they hold exactly here");
const SPEED: Verdict = Harmless("how fast and with how much memory MuJoCo runs");
const FITTED: Verdict = Harmless("how shapes are fitted to meshes: where a mass depends on that, it is a mistake");
const KIND: Attributes =
    ("content_type", Warned("the end of its name says what a file is", "model/stl model/obj text/xml"));
/// Attributes of meshes and of their defaults.
const MESH: &[Attributes] = &[("inertia scale maxhullvert", Acts)];
const STATES: Verdict = Harmless("of actuators with states, each of which is warned of");
const UNKNOWN_LAW: Verdict = Warned("it is not linear in its control, or has a state of its own", "");
const DELAY: Verdict = Warned("controls act without delay", "0");
const FILTERED: Attributes = ("timeconst", Warned("it is not linear in its control, or has a state of its own", "0"));
/// Reason against tendons through geoms.
pub const WRAPPED: &str = "it wraps around a geom; through sites alone tendons are read";
const CLASS: Attributes = ("class", Acts);
const PLACE: &[Attributes] = &[("pos quat axisangle euler xyaxes zaxis", Acts)];
const HELD: &[Attributes] = &[("name", NAME), ("class active", Acts), ("solref solimp", SOLVER)];
const TENDON: &[Attributes] = &[
    ("name class stiffness damping springlength range limited", Acts),
    ("frictionloss", Warned("dry friction of tendons is not modelled", "0")),
    (
        "armature",
        Warned("inertia of tendons is not modelled; `armature(…)` of the struct is that of a coordinate", "0"),
    ),
    ("actuatorfrcrange", Warned("the sum of forces along a tendon is not kept in a range", "0")),
    ("actuatorfrclimited", Harmless("whether `actuatorfrcrange` limits, of which there is a warning")),
    ("springyield", Warned("springs do not yield", "0")),
    ("margin solreflimit solimplimit solreffriction solimpfriction", SOLVER),
    ("group width material rgba", LOOKS),
    ("user", USER),
];
const ACTUATOR: &[Attributes] = &[
    ("name class group joint jointinparent tendon site", Acts),
    ("gear ctrlrange ctrllimited forcerange forcelimited", Acts),
    ("refsite", Warned("a `refsite` is not read; of sites alone the wrench at `site` is", "")),
    ("body cranksite slidersite cranklength", Warned("it acts on no joint, no site, and no tendon that is read", "")),
    ("delay nsample", DELAY),
    ("interp", Harmless("how a delayed control is read, of which there is a warning")),
    ("damping armature", Acts),
    ("lengthrange", Harmless("of muscles, which are warned of")),
    ("user", USER),
    ("actdim actearly actlimited actrange", STATES),
];

/// Looked through in this order: what stands in one kind of element before what stands in any.
pub const ELEMENTS: &[Element] = &[
    element("", "mujoco", &[&[("model", Harmless("a name by which other files attach it"))]]),
    element("mujoco", "compiler", &[COMPILER]),
    whole("compiler", "lengthrange", Harmless("of muscles, which are warned of")),
    element("mujoco", "option", &[OPTION]),
    element("option", "flag", &[FLAG]),
    whole("mujoco", "size", SPEED),
    whole("mujoco", "statistic visual", LOOKS),
    element("mujoco", "asset", &[]),
    element("asset", "mesh", &[MESH, MESH_ASSET]),
    element("asset", "model", &[&[("name file", Acts), KIND]]),
    whole("asset", "texture material hfield skin", LOOKS),
    whole("mujoco", "sensor", Harmless("what is measured")),
    whole("mujoco", "custom", USER),
    whole("mujoco", "extension", Harmless("which plugins there are: where one acts, it is warned of")),
    whole("mujoco", "deformable", Warned("what bends is not modelled", "")),
    // Classes of defaults; what they are of is as it is written there.
    element("mujoco default", "default", &[&[CLASS]]),
    element("default", "mesh", &[MESH]),
    whole("default", "texture material camera light", LOOKS),
    element("default", "pair", &[PAIR]),
    element("default", "equality", &[HELD]),
    element("default", "tendon", &[TENDON]),
    element(
        "default",
        "intvelocity orientation pid cylinder muscle adhesion dcmotor",
        &[&[("kp kv dampratio gain inheritrange", Acts)], ACTUATOR, OTHER_ACTUATORS],
    ),
    // Bodies.
    element("mujoco", "worldbody", &[]),
    element("worldbody body frame", "body", &[BODY, PLACE]),
    element("worldbody body frame", "frame", &[&[("name", NAME), ("childclass", Acts)], PLACE]),
    element("body frame", "inertial", &[&[("mass diaginertia fullinertia", Acts)], PLACE]),
    element("fixed", "joint", &[&[("joint coef", Acts)]]),
    element("equality", "joint", &[&[("joint1 joint2 polycoef", Acts)], HELD]),
    element("body frame default", "joint", &[JOINT]),
    element(
        "body frame",
        "freejoint",
        &[&[
            ("name", Acts),
            ("group", LOOKS),
            ("align", Warned("poses are those of the axes of the body", "false auto")),
        ]],
    ),
    element("worldbody body frame default", "geom", &[GEOM, PLACE]),
    element("worldbody body frame default", "site", &[SITE, PLACE]),
    whole("body worldbody frame", "camera light", LOOKS),
    element("worldbody body frame", "attach", &[&[("model body frame prefix", Acts)]]),
    // Copies are written out before the file is read.
    element("worldbody body frame", "replicate", &[&[("count offset euler sep childclass prefix", Acts)]]),
    whole("body worldbody frame", "composite flexcomp", Warned("it is not read", "")),
    whole("body worldbody frame geom mesh", "plugin", Warned("plugins are not read", "")),
    // What joins and drives joints.
    element("mujoco", "contact tendon equality actuator keyframe", &[]),
    element("contact", "exclude", &[&[("name", NAME), ("body1 body2", Acts)]]),
    element("contact", "pair", &[&[("name", NAME), ("geom1 geom2 class", Acts)], PAIR]),
    element("tendon", "fixed", &[TENDON]),
    element("tendon", "spatial", &[TENDON]),
    element("spatial", "site", &[&[("site", Acts)]]),
    element("spatial", "pulley", &[&[("divisor", Acts)]]),
    whole("spatial", "geom", Warned(WRAPPED, "")),
    element("equality", "connect", &[&[("body1 body2 anchor", Acts), SITES], HELD]),
    element("equality", "weld", &[&[("body1 body2 anchor relpose", Acts), SITES, ("torquescale", SOLVER)], HELD]),
    element("equality", "tendon", &[&[("tendon1 tendon2 polycoef", Acts)], HELD]),
    whole("equality", "flex flexvert flexstrain distance", Warned("it joins no two bodies or joints", "")),
    element("actuator default", "general", &[GENERAL, ACTUATOR]),
    element("actuator default", "motor", &[ACTUATOR]),
    element("actuator default", "position", &[&[("kp kv dampratio inheritrange", Acts), FILTERED], ACTUATOR]),
    element("actuator default", "velocity damper", &[&[("kv", Acts)], ACTUATOR]),
    whole("actuator", "intvelocity orientation pid cylinder muscle dcmotor plugin", UNKNOWN_LAW),
    whole("actuator", "adhesion", Warned("it acts on no joint, no site, and no tendon that is read", "")),
    element(
        "keyframe",
        "key",
        &[&[
            ("name qpos qvel ctrl", Acts),
            ("act", STATES),
            ("mpos mquat", Warned("a `mocap` body stays where it is", "")),
            ("time plastic", Harmless("no state of joints")),
        ]],
    ),
];

const MESH_ASSET: &[Attributes] = &[
    ("name class file vertex face refpos refquat", Acts),
    KIND,
    ("normal texcoord smoothnormal material", LOOKS),
    ("builtin params", Harmless("a mesh that MuJoCo makes: where a mass depends on it, it is a mistake")),
];

const SITES: Attributes = ("site1 site2", Warned("it joins no two bodies or joints", ""));

const COMPILER: &[Attributes] = &[
    ("autolimits angle coordinate eulerseq settotalmass boundmass boundinertia balanceinertia", Acts),
    ("inertiafromgeom inertiagrouprange assetdir meshdir strippath exactmeshinertia", Acts),
    ("alignfree", Warned("poses are those of the axes of the body", "false")),
    ("texturedir", LOOKS),
    ("fitaabb", FITTED),
    ("convexhull", CONTACT),
    ("fusestatic", Harmless("what is fixed moves with what it is fixed to, fused or not")),
    ("discardvisual", Harmless("masses of what is discarded stay")),
    ("conflict", Warned("the options of this file act on what it attaches", "warning error")),
    ("usethread passthrough", SPEED),
    ("saveinertial savecanonical savecompiled", Harmless("what is written, not what is read")),
];

const OPTION: &[Attributes] = &[
    ("gravity actuatorgroupdisable", Acts),
    ("density viscosity", Warned("the medium is not modelled; `drag(…)` of the struct can act on bodies", "0")),
    ("wind", Harmless("acts by `density` and `viscosity`, of which there is a warning")),
    ("magnetic", Harmless("of sensors")),
    ("timestep integrator", Harmless("a simulation has its own")),
    ("impratio cone noslip_iterations noslip_tolerance", CONTACT),
    ("o_margin o_solref o_solimp o_friction", Harmless("act by `override`, of which there is a warning")),
    ("collision", Warned("geoms touch by their bits", "all dynamic")),
    ("mpr_iterations mpr_tolerance ccd_iterations ccd_tolerance sdf_iterations sdf_initpoints", CONTACT),
    ("tolerance ls_tolerance jacobian solver iterations ls_iterations", SOLVER),
    ("sleep_tolerance apirate", SPEED),
];

const FLAG: &[Attributes] = &[
    ("gravity actuation clampctrl spring damper passive equality constraint frictionloss limit contact", Acts),
    ("filterparent", Acts),
    ("override", Warned("geoms have the friction that they say", "disable")),
    ("multiccd nativeccd midphase", CONTACT),
    ("warmstart refsafe diagexact island eulerdamp", SOLVER),
    ("energy fwdinv invdiscrete sensor sensornoise", Harmless("what is computed beside the motion")),
    ("sleep", Harmless("what has come to rest is not computed; of what is to sleep from the start there is a warning")),
    ("autoreset speculative ipc", SPEED),
];

const BODY: &[Attributes] = &[
    ("name childclass gravcomp", Acts),
    ("mocap", Warned("a body without joints stays where it is", "false")),
    (
        "sleep",
        Warned(
            "with the flag `sleep` MuJoCo holds it until something wakes it; here it moves at once",
            "auto never allowed",
        ),
    ),
    ("simple fuse", SPEED),
    ("user", USER),
];

const JOINT: &[Attributes] = &[
    ("name class type pos axis range limited ref springref", Acts),
    ("stiffness damping frictionloss armature actuatorfrcrange actuatorfrclimited", Acts),
    ("springdamper", Acts),
    ("springyield", Warned("springs do not yield", "0")),
    ("actuatorgravcomp", Warned("`gravcomp` acts beside the efforts, not within their range", "false")),
    ("margin solreflimit solimplimit solreffriction solimpfriction", SOLVER),
    ("group", LOOKS),
    ("user", USER),
];

const GEOM: &[Attributes] = &[
    ("name class type size fromto mass density shellinertia group mesh", Acts),
    ("contype conaffinity condim priority friction margin gap adhesion surfacevel", Acts),
    ("hfield", Harmless("ground, which has no mass: where it is to touch, that it does not is a warning")),
    ("fitscale", FITTED),
    ("solmix solref solimp", CONTACT),
    ("fluidshape fluidcoef", Harmless("act by `density` and `viscosity` of <option>, of which there is a warning")),
    ("rgba material castshadow", LOOKS),
    ("user", USER),
];

const PAIR: &[Attributes] = &[("condim friction margin gap adhesion", Acts), ("solref solimp solreffriction", CONTACT)];

const SITE: &[Attributes] = &[
    ("name class", Acts),
    ("fromto", Warned("`pos` is read", "")),
    ("type size mesh material rgba group", LOOKS),
    ("user", USER),
];

const GENERAL: &[Attributes] = &[
    ("gaintype biastype gainprm biasprm inheritrange", Acts),
    ("dyntype", Warned("it is not linear in its control, or has a state of its own", "none")),
    ("dynprm", STATES),
    ("input velrange ffrange", Warned("one control is read", "")),
];

const OTHER_ACTUATORS: &[Attributes] = &[
    (
        "timeconst input velrange ffrange posrange ki imax slewmax area diameter bias force scale range lmin lmax vmax",
        STATES,
    ),
    ("fpmax fvmax tausmooth motorconst resistance nominal saturation inductance cogging controller", STATES),
    ("thermal lugre", STATES),
];
