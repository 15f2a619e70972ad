//! Derivations that Ctrl-C can leave.

use std::sync::mpsc::{RecvTimeoutError, channel};
use std::thread;
use std::time::Duration;

use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;

/// Time between two looks for Ctrl-C.
const PATIENCE: Duration = Duration::from_millis(50);

/// Stack of a derivation: that of the main thread of most systems, which is also the compiler's own.
const STACK: usize = 8 << 20;

/// Runs a derivation on a thread of its own while this one looks for signals.
///
/// # Errors
/// The exception that the handler of a signal raises, as Ctrl-C does. The derivation, which nothing waits for then,
/// goes on to its end, and what it writes to the cache is found by the next.
pub fn interruptible<T: Send + 'static>(
    py: Python<'_>,
    derivation: impl FnOnce() -> T + Send + 'static,
) -> PyResult<T> {
    let (sender, receiver) = channel();
    let work = move || {
        // Nobody listens where Ctrl-C has been raised.
        let _ = sender.send(derivation());
    };
    let thread = thread::Builder::new().name("gauss-derivation".to_owned()).stack_size(STACK).spawn(work)?;
    py.detach(move || {
        loop {
            match receiver.recv_timeout(PATIENCE) {
                Ok(result) => return Ok(result),
                Err(RecvTimeoutError::Timeout) => Python::attach(|py| py.check_signals())?,
                Err(RecvTimeoutError::Disconnected) => match thread.join() {
                    Err(panic) => std::panic::resume_unwind(panic),
                    Ok(()) => return Err(PyRuntimeError::new_err("a derivation ended without a result")),
                },
            }
        }
    })
}
