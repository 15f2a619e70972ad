//! Data of the page, and the page itself.

use serde::{Serialize, Serializer};

use crate::shape::Shape;
pub use crate::shape::{can_be_shown, pose};
use crate::touch::Touch;

const TEMPLATE: &str = include_str!("page.html");
const STYLE: &str = include_str!("page.css");
const SOLIDS: &str = include_str!("solids.js");
const STAGE: &str = include_str!("stage.js");
const CAMERA: &str = include_str!("camera.js");
const CURVES: &str = include_str!("curves.js");
const PLAYER: &str = include_str!("player.js");

/// Everything that the scripts of the page read.
#[derive(Serialize)]
pub struct Page {
    pub title: String,
    pub times: Vec<f64>,
    /// Whether the scene is in units of the SI, and axes show them.
    pub si: bool,
    /// Which way is up on the screen, observer's axes.
    pub up: [f64; 3],
    /// View of the camera at first.
    pub view: &'static str,
    /// The body that the camera goes with at first.
    pub follow: Option<usize>,
    pub bodies: Vec<Body>,
    pub rods: Vec<Rod>,
    pub traces: Vec<Trace>,
    pub arrows: Vec<Arrow>,
    pub contacts: Vec<Contact>,
    /// The planes that contacts touch; a page without any has a floor below everything.
    pub planes: Vec<Plane>,
    pub panels: Vec<Panel>,
}

#[derive(Serialize)]
pub struct Body {
    pub name: String,
    /// Position and quaternion i, j, k, w for each time.
    #[serde(serialize_with = "short")]
    pub poses: Vec<[f64; 7]>,
    pub shapes: Vec<Shape>,
}

#[derive(Serialize)]
pub struct Rod {
    pub from: usize,
    pub to: usize,
    pub radius: f64,
}

#[derive(Serialize)]
pub struct Trace {
    pub body: usize,
    pub point: [f64; 3],
}

#[derive(Serialize)]
pub struct Arrow {
    pub name: String,
    /// Point and vector for each time.
    #[serde(serialize_with = "short")]
    pub values: Vec<[f64; 6]>,
}

#[derive(Serialize)]
pub struct Contact {
    pub name: String,
    /// State of the contact at each time.
    pub touches: Vec<Touch>,
    /// Point and force for each time.
    #[serde(serialize_with = "short")]
    pub values: Vec<[f64; 6]>,
}

/// A plane that stands still, by its normal and its height along it, as a screen shows them.
#[derive(Clone, Copy, PartialEq, Serialize)]
pub struct Plane {
    pub normal: [f32; 3],
    pub height: f32,
}

#[derive(Serialize)]
pub struct Panel {
    pub title: String,
    /// The unit of its axis in a scene in those of the SI, where the title has none.
    pub unit: &'static str,
    pub curves: Vec<Curve>,
}

#[derive(Serialize)]
pub struct Curve {
    pub name: String,
    pub values: Vec<f64>,
}

/// Numbers as a screen shows them: `f32` has more digits than it has pixels, and half the length.
fn short<const N: usize, S: Serializer>(rows: &[[f64; N]], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_seq(rows.iter().map(|row| row.map(|number| number as f32).to_vec()))
}

impl Page {
    pub fn new(title: &str, times: Vec<f64>) -> Self {
        Self {
            title: title.to_owned(),
            times,
            si: false,
            up: [0.0, 0.0, 1.0],
            view: "slant",
            follow: None,
            bodies: Vec::new(),
            rods: Vec::new(),
            traces: Vec::new(),
            arrows: Vec::new(),
            contacts: Vec::new(),
            planes: Vec::new(),
            panels: Vec::new(),
        }
    }

    /// One file with everything in it.
    pub fn html(&self) -> String {
        // No `<` in a script: `</script` would end it, and after `<!--<script` its end would not be found. JSON has `<`
        // in strings alone, where it may be escaped.
        let data = serde_json::to_string(self).expect("numbers and strings").replace('<', "\\u003c");
        let title = self.title.replace('&', "&amp;").replace('<', "&lt;");
        let scripts = [SOLIDS, STAGE, CURVES, CAMERA, PLAYER].concat();
        filled(TEMPLATE, |place| match place {
            "title" => &title,
            "style" => STYLE,
            "scripts" => &scripts,
            "data" => &data,
            _ => unreachable!("a place of the template without contents: {place}"),
        })
    }
}

/// A template with contents in the place of each `{{name}}`. Contents are copied as they are: a title may be
/// `{{data}}`.
fn filled<'a>(template: &str, contents: impl Fn(&str) -> &'a str) -> String {
    let mut parts = template.split("{{");
    let mut page = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let (place, rest) = part.split_once("}}").expect("every place of the template is closed");
        page += contents(place);
        page += rest;
    }
    page
}
