//! A motion to be shown, by numbers: of a run of which only these are known.

#[cfg(feature = "urdf")]
use std::fs;
use std::path::Path;

use gauss_runtime::prelude::Isometry3;

use crate::error::PlaybackError;
use crate::page::{self, Body, Curve, Page, Panel, Rod, Trace};
use crate::shape::Shape;

/// Message for a number that cannot be shown.
const OUT_OF_RANGE: &str = "is not finite, or larger than a page can show (1.7e38)";

/// A motion by the numbers at its times: poses of bodies and values of curves, one for each time. Of a run in Rust
/// [`Playback`](crate::Playback) computes them.
///
/// ```
/// use gauss_playback::{Recording, Shape};
/// use gauss_runtime::prelude::Isometry3;
///
/// let times: Vec<f64> = (0..60).map(|n| 0.05 * f64::from(n)).collect();
/// let poses: Vec<_> = times.iter().map(|t| Isometry3::translation(t.cos(), t.sin(), 0.0)).collect();
/// let page = Recording::new("A ball on a circle", times.clone())
///     .body("ball", &poses, [Shape::ball(0.1)])
///     .curve("angle / rad", "angle", times)
///     .html()?;
/// assert!(page.starts_with("<!DOCTYPE html>"));
/// # Ok::<(), gauss_playback::PlaybackError>(())
/// ```
pub struct Recording {
    pub(crate) page: Page,
    pub(crate) mistakes: Vec<String>,
}

impl Recording {
    /// A recording at these times, in their order. The page plays evenly in time, whatever their distances.
    #[must_use]
    pub fn new(title: &str, times: Vec<f64>) -> Self {
        let mut mistakes = Vec::new();
        if times.is_empty() {
            mistakes.push("there are no samples to show".to_owned());
        }
        if let Some(t) = times.iter().find(|t| !t.is_finite()) {
            mistakes.push(format!("a sample is at the time {t}"));
        }
        Self { page: Page::new(title, times), mistakes }
    }

    /// A body: its pose at each time, by the observer, and its shapes.
    #[must_use]
    pub fn body(mut self, name: &str, poses: &[Isometry3<f64>], shapes: impl IntoIterator<Item = Shape>) -> Self {
        self.add_body(name, poses.iter().map(page::pose).collect());
        shapes.into_iter().fold(self, |recording, shape| recording.shape(name, shape))
    }

    pub(crate) fn add_body(&mut self, name: &str, poses: Vec<[f64; 7]>) {
        if self.page.bodies.iter().any(|body| body.name == name) {
            self.mistakes.push(format!("two bodies are called `{name}`"));
        }
        self.look_at(&format!("pose of `{name}`"), &poses);
        self.page.bodies.push(Body { name: name.to_owned(), poses, shapes: Vec::new() });
    }

    /// A shape more of a body.
    #[must_use]
    pub fn shape(mut self, body: &str, shape: Shape) -> Self {
        if !shape.can_be_shown() {
            self.mistakes.push(format!("a shape of `{body}` {OUT_OF_RANGE}"));
        }
        if let Some(body) = self.index_of(body) {
            self.page.bodies[body].shapes.push(shape);
        }
        self
    }

    /// Gives the bodies that are there, such as those of [`frames`](Self::frames), the boxes, cylinders and balls that
    /// the links of their names have in a URDF file: those that are shown, and where these are meshes those that touch.
    #[cfg(feature = "urdf")]
    #[must_use]
    pub fn shapes_of_urdf(mut self, file: impl AsRef<Path>) -> Self {
        let file = file.as_ref();
        let text = fs::read_to_string(file).map_err(|error| error.to_string());
        match text.and_then(|text| crate::urdf::shapes(&text)) {
            Ok(shapes) => {
                let mut any = false;
                for body in &mut self.page.bodies {
                    let own = shapes.iter().filter(|(link, _)| crate::urdf::is_called(&body.name, link));
                    let before = body.shapes.len();
                    body.shapes.extend(own.map(|(_, shape)| shape.clone()));
                    any |= body.shapes.len() > before;
                }
                if !any {
                    let text = "no body has the name of a link with a box, a cylinder or a ball";
                    self.mistakes.push(format!("{}: {text}", file.display()));
                }
            }
            Err(text) => self.mistakes.push(format!("{}: {text}", file.display())),
        }
        self
    }

    /// A rod from the origin of one body to that of another, as a skeleton has them.
    #[must_use]
    pub fn rod(mut self, from: &str, to: &str, radius: f64) -> Self {
        if !(radius >= 0.0 && page::can_be_shown(&[radius])) {
            self.mistakes.push(format!("the rod from `{from}` to `{to}` has the radius {radius}"));
        }
        if let (Some(from), Some(to)) = (self.index_of(from), self.index_of(to)) {
            self.page.rods.push(Rod { from, to, radius });
        }
        self
    }

    /// The path of a point of a body, body axes from O.
    #[must_use]
    pub fn trace(mut self, body: &str, point: [f64; 3]) -> Self {
        if !page::can_be_shown(&point) {
            self.mistakes.push(format!("the point of a trace of `{body}` {OUT_OF_RANGE}"));
        }
        if let Some(body) = self.index_of(body) {
            self.page.traces.push(Trace { body, point });
        }
        self
    }

    /// The direction that is up on the screen, observer's axes; without this k₃. In a scene whose k₃ points down, as
    /// those of ships do, `[0.0, 0.0, -1.0]`; for motion in the plane of k₁ and k₂ with weight along −k₂,
    /// `[0.0, 1.0, 0.0]`.
    #[must_use]
    pub fn up(mut self, direction: [f64; 3]) -> Self {
        if !page::can_be_shown(&direction) || direction == [0.0; 3] {
            self.mistakes.push("the direction that is up is zero or cannot be shown".to_owned());
        }
        self.page.up = direction;
        self
    }

    /// Looks at the motion from above at first.
    #[must_use]
    pub fn from_above(mut self) -> Self {
        self.page.view = "top";
        self
    }

    /// Looks at the motion from the side at first, along k₂ where k₃ is up: for motion in the plane of k₁ and k₃.
    #[must_use]
    pub fn from_the_side(mut self) -> Self {
        self.page.view = "side";
        self
    }

    /// Lets the camera go with a body, and come near it; without this it sees everything from where it is.
    #[must_use]
    pub fn follow(mut self, body: &str) -> Self {
        self.page.follow = self.index_of(body);
        self
    }

    /// Says that the scene is in units of the SI: the page then shows those of time, length and energy.
    #[must_use]
    pub fn si(mut self) -> Self {
        self.page.si = true;
        self
    }

    /// A curve over time below the motion, a value for each time; curves of one `panel`, such as `"energy / J"`, share
    /// their axis.
    #[must_use]
    pub fn curve(mut self, panel: &str, name: &str, values: Vec<f64>) -> Self {
        self.add_curve((panel, ""), name, values);
        self
    }

    pub(crate) fn add_curve(&mut self, (panel, unit): (&str, &'static str), name: &str, values: Vec<f64>) {
        self.count(&format!("curve `{name}`"), values.len());
        if let Some(n) = values.iter().position(|value| !value.is_finite()) {
            self.mistakes.push(format!("the curve `{name}` is not finite at t = {}", self.time(n)));
        }
        let curve = Curve { name: name.to_owned(), values };
        match self.page.panels.iter_mut().find(|other| other.title == panel) {
            Some(panel) => panel.curves.push(curve),
            None => self.page.panels.push(Panel { title: panel.to_owned(), unit, curves: vec![curve] }),
        }
    }

    /// The page.
    ///
    /// # Errors
    /// [`PlaybackError::Mistakes`]: names that no body has or two have, numbers that are not finite.
    pub fn html(&self) -> Result<String, PlaybackError> {
        if self.mistakes.is_empty() {
            Ok(self.page.html())
        } else {
            Err(PlaybackError::Mistakes(self.mistakes.clone()))
        }
    }

    /// Writes the page to a file, and the folders above it where they are missing. A file that is there stays as it is
    /// until the new one is whole.
    ///
    /// # Errors
    /// As [`html`](Self::html), and [`PlaybackError::Io`].
    pub fn write(&self, file: impl AsRef<Path>) -> Result<(), PlaybackError> {
        Ok(gauss_files::write(file, self.html()?)?)
    }

    /// Notes numbers of which there is not one for each time.
    fn count(&mut self, what: &str, found: usize) {
        let expected = self.page.times.len();
        if found != expected {
            self.mistakes.push(format!("the {what} has {found} values at {expected} times"));
        }
    }

    /// A time by its number, which one too many does not have.
    fn time(&self, n: usize) -> f64 {
        self.page.times.get(n).copied().unwrap_or(f64::NAN)
    }

    /// Notes the first time at which what is shown has a number that the page cannot show.
    pub(crate) fn look_at<const N: usize>(&mut self, what: &str, rows: &[[f64; N]]) {
        self.count(what, rows.len());
        if let Some(n) = rows.iter().position(|row| !page::can_be_shown(row)) {
            self.mistakes.push(format!("the {what} {OUT_OF_RANGE} at t = {}", self.time(n)));
        }
    }

    fn index_of(&mut self, name: &str) -> Option<usize> {
        let found = self.page.bodies.iter().position(|body| body.name == name);
        if found.is_none() {
            let known: Vec<&str> = self.page.bodies.iter().map(|body| body.name.as_str()).collect();
            self.mistakes.push(format!("no body is called `{name}`; there are {}", known.join(", ")));
        }
        found
    }
}
