//! Butcher tableaux of explicit Runge–Kutta methods, in rationals: exact, or decimals to 18 places.

/// A rational coefficient (p, q) = p/q.
pub type Rational = (i64, i64);

/// An explicit Runge–Kutta method of S stages: `a` is strictly lower triangular.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Tableau<const S: usize> {
    /// Weights of earlier stages in a stage.
    pub a: [[Rational; S]; S],
    /// Weights of the result.
    pub b: [Rational; S],
    /// Times of the stages.
    pub c: [Rational; S],
    /// Weights of the error estimate, `b − b̂`; all zero when the method has no embedded one.
    pub error: [Rational; S],
    /// The order of the result.
    pub order: u32,
    /// The order of the embedded result; 0 when there is none.
    pub embedded_order: u32,
    /// Whether the last stage is the result, so that its derivative is the first one of the next step.
    pub first_same_as_last: bool,
}

const O: Rational = (0, 1);

/// `digits · 10^−places`: a coefficient that is published as a decimal.
pub(super) const fn decimal(digits: i64, places: u32) -> Rational {
    (digits, 10_i64.pow(places))
}

/// A row of twelve: the coefficients given, by index, and zeros.
const fn row<const N: usize>(entries: [(usize, Rational); N]) -> [Rational; 12] {
    let mut row = [O; 12];
    let mut n = 0;
    while n < N {
        row[entries[n].0] = entries[n].1;
        n += 1;
    }
    row
}

impl Tableau<4> {
    /// The classical method of Runge and Kutta, order 4.
    pub const RK4: Self = Self {
        a: [[O; 4], [(1, 2), O, O, O], [O, (1, 2), O, O], [O, O, (1, 1), O]],
        b: [(1, 6), (1, 3), (1, 3), (1, 6)],
        c: [O, (1, 2), (1, 2), (1, 1)],
        error: [O; 4],
        order: 4,
        embedded_order: 0,
        first_same_as_last: false,
    };
}

impl Tableau<7> {
    /// Dormand and Prince, order 5 with an embedded order 4 (J. Comp. Appl. Math. 6, 1980).
    pub const DORMAND_PRINCE_5: Self = Self {
        a: [
            [O; 7],
            [(1, 5), O, O, O, O, O, O],
            [(3, 40), (9, 40), O, O, O, O, O],
            [(44, 45), (-56, 15), (32, 9), O, O, O, O],
            [(19_372, 6_561), (-25_360, 2_187), (64_448, 6_561), (-212, 729), O, O, O],
            [(9_017, 3_168), (-355, 33), (46_732, 5_247), (49, 176), (-5_103, 18_656), O, O],
            [(35, 384), O, (500, 1_113), (125, 192), (-2_187, 6_784), (11, 84), O],
        ],
        b: [(35, 384), O, (500, 1_113), (125, 192), (-2_187, 6_784), (11, 84), O],
        c: [O, (1, 5), (3, 10), (4, 5), (8, 9), (1, 1), (1, 1)],
        error: [(71, 57_600), O, (-71, 16_695), (71, 1_920), (-17_253, 339_200), (22, 525), (-1, 40)],
        order: 5,
        embedded_order: 4,
        first_same_as_last: true,
    };
}

impl Tableau<12> {
    /// Dormand and Prince, order 8: the twelve stages of DOP853, coefficients from Hairer, Nørsett & Wanner, *Solving
    /// Ordinary Differential Equations I*, 2nd ed. 1993, II.5 and its appendix, to 18 decimals. Four of the times contain √6.
    ///
    /// The embedded result is the one of order 5. DOP853 divides its estimate by that of another result, of order 3, to make
    /// it behave like order 8; one linear estimate alone is cautious: at a tolerance δ the result is good to about δ^(3/2).
    pub const DORMAND_PRINCE_8: Self = Self {
        a: [
            [O; 12],
            row([(0, decimal(52_600_151_958_767_732, 18))]),
            row([(0, decimal(19_725_056_984_537_899, 18)), (1, decimal(59_175_170_953_613_698, 18))]),
            row([(0, decimal(29_587_585_476_806_849, 18)), (2, decimal(88_762_756_430_420_548, 18))]),
            row([
                (0, decimal(241_365_134_159_266_686, 18)),
                (2, decimal(-884_549_479_328_286_085, 18)),
                (3, decimal(924_834_003_261_792_003, 18)),
            ]),
            row([(0, (1, 27)), (3, decimal(170_828_608_729_473_871, 18)), (4, decimal(125_467_687_566_822_425, 18))]),
            row([
                (0, (19, 512)),
                (3, decimal(170_252_211_019_544_039, 18)),
                (4, decimal(60_216_538_980_455_961, 18)),
                (5, (-9, 512)),
            ]),
            row([
                (0, decimal(37_092_000_118_504_793, 18)),
                (3, decimal(170_383_925_712_239_994, 18)),
                (4, decimal(107_262_030_446_373_285, 18)),
                (5, decimal(-15_319_437_748_624_402, 18)),
                (6, decimal(8_273_789_163_814_023, 18)),
            ]),
            row([
                (0, decimal(624_110_958_716_075_717, 18)),
                (3, decimal(-3_360_892_629_446_941_294, 18)),
                (4, decimal(-868_219_346_841_726_007, 18)),
                (5, decimal(2_759_209_969_944_670_830, 17)),
                (6, decimal(2_015_406_755_047_789_341, 17)),
                (7, decimal(-4_348_988_418_106_995_885, 17)),
            ]),
            row([
                (0, decimal(477_662_536_438_264_366, 18)),
                (3, decimal(-2_488_114_619_971_667_642, 18)),
                (4, decimal(-590_290_826_836_842_996, 18)),
                (5, decimal(2_123_005_144_818_119_423, 17)),
                (6, decimal(1_527_923_363_288_242_358, 17)),
                (7, decimal(-3_328_821_096_898_486_292, 17)),
                (8, decimal(-20_331_201_708_508_626, 18)),
            ]),
            row([
                (0, decimal(-937_142_430_085_987_326, 18)),
                (3, decimal(5_186_372_428_844_063_708, 18)),
                (4, decimal(1_091_437_348_996_729_578, 18)),
                (5, decimal(-8_149_787_010_746_926_125, 18)),
                (6, decimal(-1_852_006_565_999_695_986, 17)),
                (7, decimal(2_273_948_709_935_050_428, 17)),
                (8, decimal(2_493_605_552_679_652_390, 18)),
                (9, decimal(-3_046_764_471_898_219_500, 18)),
            ]),
            row([
                (0, decimal(2_273_310_147_516_538_208, 18)),
                (3, decimal(-1_053_449_546_673_725_020, 17)),
                (4, decimal(-2_000_872_058_224_862_499, 18)),
                (5, decimal(-1_795_893_186_311_879_892, 17)),
                (6, decimal(2_794_888_452_941_996_005, 17)),
                (7, decimal(-2_858_998_277_135_023_695, 18)),
                (8, decimal(-8_872_856_933_530_629_544, 18)),
                (9, decimal(1_236_056_717_579_430_306, 17)),
                (10, decimal(643_392_746_015_763_530, 18)),
            ]),
        ],
        b: row([
            (0, decimal(54_293_734_116_568_762, 18)),
            (5, decimal(4_450_312_892_752_408_881, 18)),
            (6, decimal(1_891_517_899_314_500_383, 18)),
            (7, decimal(-5_801_203_960_010_584_781, 18)),
            (8, decimal(311_164_366_957_819_894, 18)),
            (9, decimal(-152_160_949_662_516_079, 18)),
            (10, decimal(201_365_400_804_030_348, 18)),
            (11, decimal(44_710_615_727_772_591, 18)),
        ]),
        c: row([
            (1, decimal(52_600_151_958_767_732, 18)),
            (2, decimal(78_900_227_938_151_598, 18)),
            (3, decimal(118_350_341_907_227_397, 18)),
            (4, decimal(281_649_658_092_772_603, 18)),
            (5, (1, 3)),
            (6, (1, 4)),
            (7, (4, 13)),
            (8, (127, 195)),
            (9, (3, 5)),
            (10, (6, 7)),
            (11, (1, 1)),
        ]),
        error: row([
            (0, decimal(13_120_044_994_194_881, 18)),
            (5, decimal(-1_225_156_446_376_204_441, 18)),
            (6, decimal(-495_758_949_657_250_192, 18)),
            (7, decimal(1_664_377_182_454_986_537, 18)),
            (8, decimal(-350_328_848_749_973_682, 18)),
            (9, decimal(334_179_118_713_017_479, 18)),
            (10, decimal(81_923_206_485_115_712, 18)),
            (11, decimal(-22_355_307_863_886_295, 18)),
        ]),
        order: 8,
        embedded_order: 5,
        first_same_as_last: false,
    };
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Row sums are the times, and the quadrature conditions Σ b c^k = 1/(k+1) hold up to the order: to a few roundings of
    /// the terms, which are the larger the more the coefficients cancel (43 in the sum that makes 0.65).
    fn check<const S: usize>(tableau: &Tableau<S>) {
        let value = |(p, q): Rational| p as f64 / q as f64;
        for (row, &c) in tableau.a.iter().zip(&tableau.c) {
            let sum: f64 = row.iter().map(|&a| value(a)).sum();
            let size: f64 = row.iter().map(|&a| value(a).abs()).sum();
            assert!((sum - value(c)).abs() <= 1e-15 * (1.0 + size), "{sum} {c:?}");
        }
        for k in 0..tableau.order {
            let moment = |b: &[Rational; S]| -> f64 {
                b.iter().zip(&tableau.c).map(|(&b, &c)| value(b) * value(c).powi(k as i32)).sum()
            };
            let size: f64 = tableau.b.iter().map(|&b| value(b).abs()).sum();
            assert!((moment(&tableau.b) - 1.0 / f64::from(k + 1)).abs() < 1e-15 * size.max(1.0));
            if k < tableau.embedded_order {
                assert!(moment(&tableau.error).abs() < 1e-15 * size.max(1.0));
            }
        }
    }

    #[test]
    fn tableaux_are_consistent() {
        check(&Tableau::RK4);
        check(&Tableau::DORMAND_PRINCE_5);
        check(&Tableau::DORMAND_PRINCE_8);
        assert_eq!(Tableau::DORMAND_PRINCE_5.a[6], Tableau::DORMAND_PRINCE_5.b);
    }
}
