//! The threads that compute.

use std::sync::{Mutex, PoisonError};

use rayon::{ThreadPool, ThreadPoolBuildError, ThreadPoolBuilder};

/// The pool, and the process whose threads it has.
static POOL: Mutex<Option<(u32, &'static ThreadPool)>> = Mutex::new(None);

/// Steps with contacts hand matrices of many rows on by value.
const STACK: usize = 16 << 20;

/// The threads of this process, as many as `RAYON_NUM_THREADS` says, or one for each core.
///
/// A process that was forked has no thread but the one that forked it: work for the pool of its parent would wait for
/// ever. So it gets a pool of its own. Pools stay as long as their process: no thread of the parent's is left to end.
///
/// # Errors
/// The system has no thread to give.
pub fn pool() -> Result<&'static ThreadPool, ThreadPoolBuildError> {
    let process = std::process::id();
    let known = || POOL.lock().unwrap_or_else(PoisonError::into_inner);
    match *known() {
        Some((owner, pool)) if owner == process => return Ok(pool),
        _ => {}
    }
    // Not while it is locked: a fork in the meantime would have the lock for ever.
    let made = ThreadPoolBuilder::new().stack_size(STACK).build()?;
    let mut known = known();
    match *known {
        // Another thread was faster.
        Some((owner, pool)) if owner == process => Ok(pool),
        _ => {
            let made: &'static ThreadPool = Box::leak(Box::new(made));
            *known = Some((process, made));
            Ok(made)
        }
    }
}
