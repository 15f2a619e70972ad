//! Runs as pages that play in any browser.

use gauss_playback::{PlaybackError, Recording};
use gauss_runtime::nalgebra::{IsometryMatrix3, Matrix3, Rotation3, Translation3, convert};
use gauss_runtime::prelude::Isometry3;
use pyo3::exceptions::{PyOSError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PySlice;

use crate::arrays;
use crate::call::{Given, call};
use crate::class::Kernel;
use crate::methods::Id;
use crate::run::{Run, names};

/// The radius of a rod that is given none.
const RADIUS: f64 = 0.02;

/// A rod: both frames, and its radius, which may be left out.
#[derive(FromPyObject)]
enum Rod {
    WithRadius(String, String, f64),
    Between(String, String),
}

/// A trace: a frame, and a point in its axes, which may be left out.
#[derive(FromPyObject)]
enum Trace {
    OfPoint(String, [f64; 3]),
    OfOrigin(String),
}

/// The first state of which all columns are numbers: forces of steps are not known before the first one.
fn first_known(columns: &[(&'static str, String, Vec<f64>)]) -> usize {
    let first = |values: &[f64]| values.iter().position(|value| value.is_finite()).unwrap_or(0);
    columns.iter().map(|(.., values)| first(values)).max().unwrap_or(0)
}

/// Poses of a frame at times, with the configuration at each.
fn poses<'py>(
    py: Python<'py>,
    kernel: &Kernel,
    frame: usize,
    (t, q): (&Bound<'py, PyAny>, &Bound<'py, PyAny>),
) -> PyResult<Vec<Isometry3<f64>>> {
    let given = Given { arguments: [Some(q), None, None, None], t: Some(t), frame, out: None, parameters: None };
    let (numbers, _) = arrays::numbers("pose", &call(py, kernel.kernel(), Id::Pose, &given)?)?;
    let pose = |rows: &[f64; 16]| {
        let entry = |i: usize, j: usize| rows[4 * i + j];
        let turn = Rotation3::from_matrix_unchecked(Matrix3::from_fn(entry));
        let origin = Translation3::new(entry(0, 3), entry(1, 3), entry(2, 3));
        // R of a matrix as the nearest quaternion.
        convert(IsometryMatrix3::from_parts(origin, turn))
    };
    Ok(numbers.as_chunks::<16>().0.iter().map(pose).collect())
}

#[pymethods]
impl Run {
    /// The run as a page that any browser plays, in one file without network: curves of its columns, and with a
    /// `kernel` all frames that this has (`frames(...)`). Writes it to `path`, or gives its text without one.
    ///
    /// `rods` joins frames, (from, to) or (from, to, radius), as a skeleton; `traces` are paths of frames, or of points
    /// (frame, [x, y, z]) in their axes; `urdf` is a file whose boxes, cylinders and balls its links show. `up` is the
    /// direction that is up on the screen, k3 without it; `follow` the frame that the camera goes with. Axes show units
    /// of the SI, unless `si` is False. Pictures are the states of the run, from the first of which all columns are
    /// known: for more of them, and evenly, give `times` to `simulate`. Raises ValueError with all that cannot be
    /// shown, OSError where nothing can be written.
    #[pyo3(signature = (path=None, kernel=None, *, title=None, rods=None, traces=None, urdf=None, up=None, follow=None,
        si=true))]
    #[expect(clippy::too_many_arguments, reason = "keywords")]
    fn page(
        slf: &Bound<'_, Self>,
        path: Option<std::path::PathBuf>,
        kernel: Option<&Bound<'_, Kernel>>,
        title: Option<&str>,
        rods: Option<Vec<Rod>>,
        traces: Option<Vec<Trace>>,
        urdf: Option<std::path::PathBuf>,
        up: Option<[f64; 3]>,
        follow: Option<&str>,
        si: bool,
    ) -> PyResult<Option<String>> {
        let (py, run) = (slf.py(), slf.get());
        let mut columns = Vec::new();
        for (panel, names) in run.panels() {
            for name in names {
                let (values, _) = arrays::numbers(&name, slf.get_item(&name)?.as_any())?;
                columns.push((panel, name, values));
            }
        }
        let first = first_known(&columns);
        let since = PySlice::new(py, first as isize, isize::MAX, 1);
        let [t, q] = [slf.getattr("t")?.get_item(&since)?, slf.getattr("q")?.get_item(&since)?];
        let (times, _) = arrays::numbers("t", &t)?;
        let name = kernel.map(|kernel| kernel.get().scene().description().name);
        let mut page = Recording::new(title.or(name).unwrap_or("A run"), times);
        if let Some(kernel) = kernel {
            let scene = kernel.get().scene();
            let own = names(scene, &[]);
            if run.column_names().get(..own.len()) != Some(&own[..]) {
                let name = scene.description().name;
                return Err(PyValueError::new_err(format!("the run is not one of {name}: it has other columns")));
            }
            for (number, frame) in scene.frames().iter().enumerate() {
                page = page.body(frame, &poses(py, kernel.get(), number, (&t, &q))?, []);
            }
        }
        page = urdf.into_iter().fold(page, Recording::shapes_of_urdf);
        page = rods.into_iter().flatten().fold(page, |page, rod| match rod {
            Rod::WithRadius(from, to, radius) => page.rod(&from, &to, radius),
            Rod::Between(from, to) => page.rod(&from, &to, RADIUS),
        });
        page = traces.into_iter().flatten().fold(page, |page, trace| match trace {
            Trace::OfPoint(frame, point) => page.trace(&frame, point),
            Trace::OfOrigin(frame) => page.trace(&frame, [0.0; 3]),
        });
        page = up.into_iter().fold(page, Recording::up);
        page = follow.into_iter().fold(page, Recording::follow);
        page = if si { page.si() } else { page };
        page = columns
            .into_iter()
            .fold(page, |page, (panel, name, values)| page.curve(panel, &name, values[first..].to_vec()));
        let done = match path {
            Some(path) => page.write(path).map(|()| None),
            None => page.html().map(Some),
        };
        done.map_err(|error| match error {
            PlaybackError::Io(_) => PyOSError::new_err(error.to_string()),
            _ => PyValueError::new_err(error.to_string()),
        })
    }
}
