//! All scenes, in the order of the report. A scene is an entry here, its data in `data/speed_vs_error.json`, a struct
//! for the derive in `bodies` or `systems`, and its equations by hand.

use std::error::Error;
use std::rc::Rc;

use super::about::{About, Kind};
use super::entry::Entry;
use super::scene::{Scene, Target, read};
use super::{bodies, systems};

/// Adds the methods of a scene.
type Fill = fn(&mut Vec<Entry>, &Scene, &Rc<Target>) -> Result<(), Box<dyn Error>>;

/// All scenes, in the order of the report.
///
/// # Errors
/// When the data are not what they should be.
pub fn scenes() -> Result<Vec<Scene>, Box<dyn Error>> {
    read(SCENES.iter().map(|(about, _)| about))
}

/// All methods on a scene.
///
/// # Errors
/// When its data are not what they should be.
pub fn entries(scene: &Scene) -> Result<Vec<Entry>, Box<dyn Error>> {
    let mut entries = Vec::new();
    let named = SCENES.iter().filter(|(about, _)| about.name == scene.about.name);
    for (about, fill) in named {
        fill(&mut entries, scene, &Rc::new(Target::of(scene, about.seen)))?;
    }
    Ok(entries)
}

const fn top(name: &'static str, title: &'static str, rate: f64, fill: Fill) -> (About, Fill) {
    (About { name, title, kind: Kind::Top, rate, seen: &["R"] }, fill)
}

const fn fluid(name: &'static str, title: &'static str, rate: f64, fill: Fill) -> (About, Fill) {
    (About { name, title, kind: Kind::Fluid, rate, seen: &["R", "b"] }, fill)
}

const fn other(
    name: &'static str,
    title: &'static str,
    rate: f64,
    seen: &'static [&'static str],
    fill: Fill,
) -> (About, Fill) {
    (About { name, title, kind: Kind::Other, rate, seen }, fill)
}

/// The scenes.
static SCENES: [(About, Fill); 20] = [
    top("hlw_free_body", "Free body", 1.3, bodies::free_top),
    top("free_asym_top", "Free asymmetric top", 2.0, bodies::free_top),
    top("free_near_separatrix", "Free body near its separatrix", 1.0, bodies::free_top),
    top("trajectory_a", "Free body that turns over (trajectory A)", 1.0, bodies::free_top),
    top("hlw_heavy_top", "Heavy asymmetric top", 2.0, bodies::heavy_top),
    top("bruls_heavy_top", "Heavy top at 150 rad/s", 150.0, bodies::heavy_top),
    top("simo_wong_top", "Heavy top at 50 rad/s", 50.0, bodies::symmetric_top),
    top("lagrange_top", "Lagrange's top", 40.0, bodies::symmetric_top),
    top("kovalevskaya", "Kovalevskaya's top", 1.5, bodies::heavy_top),
    top("trajectory_b", "Heavy symmetric top (trajectory B)", 15.0, bodies::symmetric_top),
    fluid("kirchhoff_clebsch", "Body in fluid, Clebsch's case", 1.5, bodies::ideal),
    fluid("kirchhoff_nonintegrable", "Body in fluid, not integrable", 2.0, bodies::ideal),
    fluid("kirchhoff_buoyant", "Body in fluid with weight and buoyancy", 3.0, bodies::submerged),
    fluid("full_added_mass", "Body in fluid, all added masses coupled", 3.0, bodies::submerged),
    fluid("trajectory_c", "Vehicle in fluid (trajectory C)", 1.5, bodies::submerged),
    other("drag_body", "Body with drag and a constant force", 5.0, &["R", "b"], bodies::dragged),
    other("spherical_pendulum", "Spherical pendulum", 4.0, &["x"], systems::spherical_pendulum),
    other("double_pendulum", "Double pendulum", 8.0, &["x1", "x2"], systems::double_pendulum),
    other("rolling_disk_falling", "Rolling disk", 6.0, &["R", "b"], systems::rolling_disk),
    other("chaplygin_sleigh", "Chaplygin's sleigh", 1.5, &["R", "b"], systems::sleigh),
];
