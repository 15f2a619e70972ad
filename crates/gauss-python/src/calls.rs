//! Functions of Python in a run, Ctrl-C and progress.

use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::time::{Duration, Instant};

use numpy::PyArray1;
use pyo3::exceptions::{PyImportError, PyTypeError};
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict};

/// Time for which a run goes on before somebody looks for Ctrl-C, and is told how far it is.
const PATIENCE: Duration = Duration::from_millis(50);

/// Functions of Python in a run: the first error of any ends it.
pub struct Calls {
    /// Set, the run ends with what there is.
    pub stop: AtomicBool,
    error: Mutex<Option<PyErr>>,
    begin: Instant,
    looked: AtomicU64,
    progress: Option<Progress>,
}

impl Calls {
    /// Before the run.
    pub fn new(progress: Option<Progress>) -> Self {
        let (stop, error) = (AtomicBool::new(false), Mutex::new(None));
        Self { stop, error, begin: Instant::now(), looked: AtomicU64::new(0), progress }
    }

    fn fail(&self, error: PyErr) {
        self.stop.store(true, Ordering::Relaxed);
        if let Ok(mut first) = self.error.lock() {
            first.get_or_insert(error);
        }
    }

    /// Looks for Ctrl-C now and then, and says how far the run is.
    pub fn look(&self, at: f64) {
        let now = self.begin.elapsed().as_millis() as u64;
        if now >= self.looked.load(Ordering::Relaxed) + PATIENCE.as_millis() as u64 {
            self.looked.store(now, Ordering::Relaxed);
            let looked = Python::attach(|py| {
                py.check_signals()?;
                self.progress.iter().try_for_each(|progress| progress.tell(py, at))
            });
            if let Err(error) = looked {
                self.fail(error);
            }
        }
    }

    /// Says how far the run came, and closes a bar.
    pub fn end(&self, py: Python<'_>, at: f64) {
        if let Some(progress) = &self.progress
            && let Err(error) = progress.tell(py, at).and(progress.close(py))
        {
            self.fail(error);
        }
    }

    /// The first error: that of a function, or what the handler of a signal raised, as Ctrl-C does.
    pub fn error(self) -> Option<PyErr> {
        self.error.into_inner().ok().flatten()
    }

    /// Calls a function of Python with a time and a state.
    pub fn call<R>(
        &self,
        function: &Py<PyAny>,
        (t, q, z): (f64, &[f64], &[f64]),
        read: impl Fn(&Bound<'_, PyAny>) -> PyResult<R>,
    ) -> Option<R> {
        if self.stop.load(Ordering::Relaxed) {
            return None;
        }
        Python::attach(|py| {
            let state = (t, PyArray1::from_slice(py, q), PyArray1::from_slice(py, z));
            let value = function.bind(py).call1(state).and_then(|value| read(&value));
            value.map_err(|error| self.fail(error)).ok()
        })
    }
}

/// Who is told how far a run is: a time, or a number of runs.
pub enum Progress {
    /// A function.
    Function(Py<PyAny>),
    /// A bar of tqdm, and where it stands.
    Bar(Py<PyAny>, Mutex<f64>),
}

impl Progress {
    /// A function, or True for a bar; nothing for False and None.
    pub fn of(given: Option<&Bound<'_, PyAny>>, (from, to): (f64, f64), unit: &str) -> PyResult<Option<Self>> {
        let Some(given) = given else { return Ok(None) };
        if let Ok(wanted) = given.cast::<PyBool>() {
            return if wanted.is_true() { Self::bar(given.py(), (from, to), unit).map(Some) } else { Ok(None) };
        }
        match given.is_callable() {
            true => Ok(Some(Self::Function(given.clone().unbind()))),
            false => Err(PyTypeError::new_err("progress is a function of one number, True or False")),
        }
    }

    fn bar(py: Python<'_>, (from, to): (f64, f64), unit: &str) -> PyResult<Self> {
        let tqdm = py.import("tqdm").map_err(|_| {
            PyImportError::new_err("progress=True needs the package tqdm (pip install tqdm); a function needs none")
        })?;
        let how = PyDict::new(py);
        how.set_item("total", (to - from).abs())?;
        how.set_item("unit", unit)?;
        how.set_item("unit_scale", true)?;
        let bar = tqdm.getattr("tqdm")?.call((), Some(&how))?;
        Ok(Self::Bar(bar.unbind(), Mutex::new(from)))
    }

    fn tell(&self, py: Python<'_>, at: f64) -> PyResult<()> {
        match self {
            Self::Function(function) => function.bind(py).call1((at,)).map(|_| ()),
            Self::Bar(bar, stands) => {
                let before = stands.lock().map_or(at, |mut stands| std::mem::replace(&mut *stands, at));
                bar.bind(py).call_method1("update", ((at - before).abs(),)).map(|_| ())
            }
        }
    }

    fn close(&self, py: Python<'_>) -> PyResult<()> {
        match self {
            Self::Function(_) => Ok(()),
            Self::Bar(bar, _) => bar.bind(py).call_method0("close").map(|_| ()),
        }
    }
}

/// Runs on another thread while this one looks for Ctrl-C, which only the first thread of Python is told of.
///
/// # Errors
/// The system has no thread to give.
pub fn watched_run<R: Send>(
    run: impl FnOnce() -> R + Send,
    calls: &Calls,
    ended: &(dyn Fn() -> f64 + Sync),
) -> std::io::Result<R> {
    std::thread::scope(|scope| {
        let (done, wait) = std::sync::mpsc::channel::<()>();
        let running = std::thread::Builder::new().spawn_scoped(scope, move || {
            let result = run();
            drop(done);
            result
        })?;
        while let Err(std::sync::mpsc::RecvTimeoutError::Timeout) = wait.recv_timeout(PATIENCE) {
            calls.look(ended());
        }
        Ok(running.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic)))
    })
}
