//! How long a thread has computed.

use std::time::{Duration, Instant};

/// How long this thread has computed, whatever else runs on the machine; where the system does not say, what has
/// passed.
pub fn computed(begun: Instant) -> Duration {
    let scheduled = std::fs::read_to_string("/proc/thread-self/schedstat").ok();
    let nanoseconds = scheduled.and_then(|text| text.split(' ').next()?.parse().ok());
    nanoseconds.map_or_else(|| begun.elapsed(), Duration::from_nanos)
}
