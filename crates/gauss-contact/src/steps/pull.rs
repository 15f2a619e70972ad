//! The pull of impulses towards those before, where contacts depend on one another, from one correction to the next.
//!
//! What cannot stick all at once, as two corners that an impact parts, or cannot all stay closed, drifts to the bound
//! of its friction or to zero by the inverse of the pull. Along a bound that is round a drift errs by its square. A
//! pull that only follows the residual then creeps; where rates contradict one another by 10⁻¹⁰ m/s, as of a die that
//! comes to rest, it does not arrive. So in other rounds each drift is ten times as long as the one before, and
//! corrections that all but stand still come after it.

/// Part of the diagonal by which impulses are pulled at first.
const FIRST: f64 = 1e-5;
const LEAST: f64 = 1e-9;
const MOST: f64 = 1e-3;

/// Rule by which a pull follows the residuals.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Drift {
    /// Corrections that gain nothing pull less, those that go too far more.
    Short,
    /// Corrections that gain nothing pull less each time, and those that go too far as much as any.
    Long,
}

/// Pull, as a part of the diagonal.
pub(super) struct Pull {
    part: f64,
    drift: Drift,
    /// The pull of the next long drift.
    next: f64,
}

impl Pull {
    pub(super) fn new(drift: Drift) -> Self {
        Self { part: FIRST, drift, next: FIRST }
    }

    pub(super) fn part(&self) -> f64 {
        self.part
    }

    /// Follows a correction after which the residual has grown, or has not become less; whether that changes it.
    pub(super) fn follow(&mut self, grows: bool, stalls: bool) -> bool {
        let before = self.part;
        match self.drift {
            _ if !(grows || stalls) => {}
            Drift::Short if grows => self.part = (10.0 * before).min(MOST),
            Drift::Short => self.part = (0.1 * before).max(LEAST),
            Drift::Long if grows => self.part = MOST,
            Drift::Long => {
                self.part = self.next;
                self.next = if self.next > LEAST { (0.1 * self.next).max(LEAST) } else { FIRST };
            }
        }
        self.part != before
    }
}
