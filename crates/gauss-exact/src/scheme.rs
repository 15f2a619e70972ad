//! Lengths of kicks and drifts: splitting methods as tables.

use gauss_runtime::integrate::Composition;

/// A symmetric splitting method: kick, drift, kick, …, kick, as fractions of the step.
///
/// A kick changes the momentum by the force at rest, a drift is free motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scheme {
    kicks: &'static [f64],
    drifts: &'static [f64],
    order: u32,
}

impl Scheme {
    /// Kick half, drift, kick half: order 2, one force a step.
    pub const STRANG: Self = Self::new(&[0.5, 0.5], &[1.0], 2);

    /// Order 4 with six forces a step and a small error constant, because it uses that the kinetic energy is quadratic
    /// in the momenta (Blanes & Moan, J. Comput. Appl. Math. 142, 2002, SRKN₆ᵇ). The first choice for bodies.
    pub const BLANES_MOAN_4: Self = Self::new(&BLANES_MOAN_KICKS, &BLANES_MOAN_DRIFTS, 4);

    /// Order 6 with eleven forces a step and a small error constant, for the same reason (Blanes & Moan 2002, SRKN₁₁ᵇ).
    pub const BLANES_MOAN_6: Self = Self::new(&BLANES_MOAN_6_KICKS, &BLANES_MOAN_6_DRIFTS, 6);

    /// Order 6, nine forces a step (Kahan & Li, Math. Comp. 66, 1997, s9odr6a).
    pub const KAHAN_LI_6: Self = Self::new(&halves::<9, 10>(&KAHAN_LI_6), &KAHAN_LI_6, 6);

    /// Order 8, seventeen forces a step (Kahan & Li 1997, s17odr8a).
    pub const KAHAN_LI_8: Self = Self::new(&halves::<17, 18>(&KAHAN_LI_8), &KAHAN_LI_8, 8);

    /// A scheme of your own. One kick more than drifts; both read the same backwards, and add up to 1.
    ///
    /// # Panics
    /// When the numbers do not match, so that a constant does not compile.
    #[must_use]
    pub const fn new(kicks: &'static [f64], drifts: &'static [f64], order: u32) -> Self {
        assert!(kicks.len() == drifts.len() + 1, "there is one kick more than drifts");
        assert!(is_symmetric(kicks) && is_symmetric(drifts), "the scheme reads the same backwards");
        Self { kicks, drifts, order }
    }

    /// The order of the global error, with exact drifts.
    #[must_use]
    pub const fn order(&self) -> u32 {
        self.order
    }

    /// The kicks, as fractions of the step.
    #[must_use]
    pub const fn kicks(&self) -> &'static [f64] {
        self.kicks
    }

    /// The drifts, as fractions of the step.
    #[must_use]
    pub const fn drifts(&self) -> &'static [f64] {
        self.drifts
    }
}

const fn is_symmetric(values: &[f64]) -> bool {
    let mut i = 0;
    while 2 * i < values.len() {
        if values[i] != values[values.len() - 1 - i] {
            return false;
        }
        i += 1;
    }
    true
}

const BLANES_MOAN_DRIFTS: [f64; 6] = {
    let (a1, a2) = (0.245_298_957_184_271, 0.604_872_665_711_08);
    let a3 = 0.5 - (a1 + a2);
    [a1, a2, a3, a3, a2, a1]
};

const BLANES_MOAN_KICKS: [f64; 7] = {
    let (b1, b2, b3) = (0.082_984_406_417_405_2, 0.396_309_801_498_368, -0.039_056_304_922_348_6);
    [b1, b2, b3, 1.0 - 2.0 * (b1 + b2 + b3), b3, b2, b1]
};

const BLANES_MOAN_6_DRIFTS: [f64; 11] = {
    let (a1, a2, a3) = (0.123_229_775_946_271, 0.290_553_797_799_558, -0.127_049_212_625_417);
    let (a4, a5) = (-0.246_331_761_062_075, 0.357_208_872_795_928);
    let a6 = 1.0 - 2.0 * (a1 + a2 + a3 + a4 + a5);
    [a1, a2, a3, a4, a5, a6, a5, a4, a3, a2, a1]
};

const BLANES_MOAN_6_KICKS: [f64; 12] = {
    let (b1, b2, b3) = (0.041_464_998_518_262_4, 0.198_128_671_918_067, -0.040_006_192_104_153_3);
    let (b4, b5) = (0.075_253_984_301_580_7, -0.011_511_387_420_687_9);
    let b6 = 0.5 - (b1 + b2 + b3 + b4 + b5);
    [b1, b2, b3, b4, b5, b6, b6, b5, b4, b3, b2, b1]
};

const KAHAN_LI_6: [f64; 9] = Composition::KAHAN_LI_6.doubles();
const KAHAN_LI_8: [f64; 17] = Composition::KAHAN_LI_8.doubles();

/// Kicks of a composition of Strang steps: neighbouring half kicks at one place are one.
const fn halves<const N: usize, const K: usize>(drifts: &[f64; N]) -> [f64; K] {
    assert!(K == N + 1);
    let mut kicks = [0.0; K];
    let mut i = 0;
    while i < N {
        kicks[i] += 0.5 * drifts[i];
        kicks[i + 1] += 0.5 * drifts[i];
        i += 1;
    }
    kicks
}

#[cfg(test)]
mod tests {
    use super::*;

    const ALL: [Scheme; 5] =
        [Scheme::STRANG, Scheme::BLANES_MOAN_4, Scheme::BLANES_MOAN_6, Scheme::KAHAN_LI_6, Scheme::KAHAN_LI_8];

    #[test]
    fn kicks_and_drifts_add_up_to_a_step() {
        for scheme in ALL {
            for part in [scheme.kicks(), scheme.drifts()] {
                // As many roundings as there are numbers.
                let sum: f64 = part.iter().sum();
                assert!((sum - 1.0).abs() <= part.len() as f64 * f64::EPSILON, "{scheme:?}: {sum}");
            }
        }
    }

    /// Steps of a harmonic oscillator are products of shears; their trace is 2 cos h + O(h^(order + 2)). All schemes,
    /// not only compositions, have to pass.
    #[test]
    fn an_oscillator_sees_the_order() {
        for scheme in ALL {
            let error = |h: f64| {
                let (mut q, mut p) = ([1.0, 0.0], [0.0, 1.0]);
                for (i, kick) in scheme.kicks().iter().enumerate() {
                    for k in 0..2 {
                        p[k] -= kick * h * q[k];
                        if let Some(drift) = scheme.drifts().get(i) {
                            q[k] += drift * h * p[k];
                        }
                    }
                }
                (0.5 * (q[0] + p[1]) - h.cos()).abs()
            };
            let slope = (error(0.8) / error(0.4)).log2();
            let expected = f64::from(scheme.order() + 2);
            assert!((slope - expected).abs() < 0.5, "{scheme:?}: {slope} {expected}");
        }
    }
}
