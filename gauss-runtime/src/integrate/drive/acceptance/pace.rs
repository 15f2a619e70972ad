//! Whether a run has any prospect of its end.

/// Steps after which the way that they made is looked at: a tenth of a second of a small system. Transients that begin
/// with short steps are over by then, since steps grow by factors.
const WINDOW: u64 = 100_000;

/// Follows how far a run comes with its steps.
#[derive(Clone, Copy, Debug)]
pub struct Pace {
    limit: u64,
    tries: u64,
    from: f64,
}

impl Pace {
    /// From this time on, with so many steps allowed.
    pub fn new(start: f64, limit: u64) -> Self {
        Self { limit, tries: 0, from: start }
    }

    /// Counts a step that is about to be tried at time t, with so much time left. Whether it is too many: `Some(true)`
    /// when at the present pace all steps that are allowed do not reach the end, `Some(false)` when they are used up.
    pub fn spent(&mut self, t: f64, left: f64) -> Option<bool> {
        if self.tries == self.limit {
            return Some(false);
        }
        self.tries += 1;
        if self.tries.is_multiple_of(WINDOW) && self.hopeless(t, left, WINDOW) { Some(true) } else { None }
    }

    /// Counts all steps up to a jump; whether there is no prospect of the end, as for single steps.
    pub fn jumped(&mut self, t: f64, left: f64, tries: u64) -> bool {
        let since = tries - self.tries;
        if since < WINDOW {
            return false;
        }
        self.tries = tries;
        self.hopeless(t, left, since)
    }

    fn hopeless(&mut self, t: f64, left: f64, since: u64) -> bool {
        let way = (t - self.from).abs();
        self.from = t;
        // Without any way at all this is infinite.
        left / way * since as f64 > self.limit.saturating_sub(self.tries) as f64
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_too_far_is_given_up_early_and_what_is_slow_is_not() {
        let spent = |step: f64, limit: u64| {
            let mut pace = Pace::new(0.0, limit);
            let end = 1.0;
            (0..limit + 1).find_map(|n| {
                let t = n as f64 * step;
                if t >= end { Some((n, None)) } else { pace.spent(t, end - t).map(|hopeless| (n, Some(hopeless))) }
            })
        };
        // A million steps are allowed: twice as many are not begun, a little less are made.
        assert_eq!(spent(0.5e-6, 1_000_000), Some((WINDOW - 1, Some(true))));
        assert_eq!(spent(0.0, 1_000_000), Some((WINDOW - 1, Some(true))));
        assert_eq!(spent(1.1e-6, 1_000_000), Some((909_091, None)));
        assert_eq!(spent(1e-3, 10), Some((10, Some(false))));
    }
}
