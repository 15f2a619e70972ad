//! Tests that fail instead of waiting for ever.

use std::sync::mpsc::{RecvTimeoutError, channel};
use std::thread;
use std::time::Duration;

/// What a function gives, on a thread of its own.
///
/// # Panics
/// When it has not come back after so many seconds, or panics itself.
pub fn within<T: Send + 'static>(seconds: u64, what: &str, function: impl FnOnce() -> T + Send + 'static) -> T {
    let (done, waiting) = channel();
    let thread = thread::spawn(move || {
        // Nobody waits any more when it is too late.
        let _ = done.send(function());
    });
    match waiting.recv_timeout(Duration::from_secs(seconds)) {
        Ok(value) => value,
        Err(RecvTimeoutError::Timeout) => panic!("{what} has not come to an end after {seconds} s"),
        Err(RecvTimeoutError::Disconnected) => match thread.join() {
            Err(panic) => std::panic::resume_unwind(panic),
            Ok(()) => unreachable!("it sends before it ends"),
        },
    }
}
