//! Butcher tableaux of explicit Runge–Kutta methods, in rationals: exact, or decimals to 18 places.

use crate::real::rounded_ratio;

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
    /// Weights of a second, coarser estimate, by which the first is divided to make it go with a higher power of the
    /// step: see [`Adaptive`](crate::integrate::Adaptive). All zero when there is none.
    pub coarse_error: [Rational; S],
    /// The order of the result behind the coarser estimate; 0 when there is none.
    pub coarse_order: u32,
    /// Whether the last stage is the result, so that its derivative is the first one of the next step.
    pub first_same_as_last: bool,
}

/// A tableau that the compiler knows: the type is the method.
///
/// One of your own:
///
/// ```
/// use gauss_runtime::integrate::{Coefficients, Tableau};
///
/// /// Heun's method of order 3.
/// #[derive(Clone, Copy, Debug, Default)]
/// struct Heun;
///
/// impl Coefficients<3> for Heun {
///     const TABLEAU: Tableau<3> = Tableau {
///         a: [[(0, 1); 3], [(1, 3), (0, 1), (0, 1)], [(0, 1), (2, 3), (0, 1)]],
///         b: [(1, 4), (0, 1), (3, 4)],
///         c: [(0, 1), (1, 3), (2, 3)],
///         error: [(0, 1); 3],
///         order: 3,
///         embedded_order: 0,
///         coarse_error: [(0, 1); 3],
///         coarse_order: 0,
///         first_same_as_last: false,
///     };
/// }
/// assert_eq!(Heun::A[2], [0.0, 2.0 / 3.0, 0.0]);
/// ```
pub trait Coefficients<const S: usize>: Copy {
    /// The coefficients as fractions. All others follow from them.
    const TABLEAU: Tableau<S>;

    /// `a`, correctly rounded.
    const A: [[f64; S]; S] = {
        let mut rows = [[0.0; S]; S];
        let mut i = 0;
        while i < S {
            rows[i] = rounded(&Self::TABLEAU.a[i]);
            i += 1;
        }
        rows
    };

    /// `b`, correctly rounded.
    const WEIGHTS: [f64; S] = rounded(&Self::TABLEAU.b);

    /// `c`, correctly rounded.
    const TIMES: [f64; S] = rounded(&Self::TABLEAU.c);

    /// The weights of the error estimate, correctly rounded.
    const ERROR: [f64; S] = rounded(&Self::TABLEAU.error);

    /// The weights of the coarser estimate, correctly rounded.
    const COARSE_ERROR: [f64; S] = rounded(&Self::TABLEAU.coarse_error);
}

/// Each number of a row rounded once.
const fn rounded<const S: usize>(row: &[Rational; S]) -> [f64; S] {
    let mut values = [0.0; S];
    let mut j = 0;
    while j < S {
        values[j] = rounded_ratio(row[j].0, row[j].1, f64::MANTISSA_DIGITS);
        j += 1;
    }
    values
}

macro_rules! tableaux {
    ($($name:ident<$stages:literal> = $tableau:ident, $what:literal;)+) => {$(
        #[doc = $what]
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
        pub struct $name;

        impl Coefficients<$stages> for $name {
            const TABLEAU: Tableau<$stages> = Tableau::$tableau;
        }
    )+};
}

tableaux! {
    Classical4<4> = RK4, "[`Tableau::RK4`] as a type.";
    DormandPrince5<7> = DORMAND_PRINCE_5, "[`Tableau::DORMAND_PRINCE_5`] as a type.";
    DormandPrince8<12> = DORMAND_PRINCE_8, "[`Tableau::DORMAND_PRINCE_8`] as a type.";
    Verner9<16> = VERNER_9, "[`Tableau::VERNER_9`] as a type.";
}

/// The power of the step that the error estimate of a tableau goes with: that of the embedded method's local error, or
/// where there are two estimates, e of order p and ê of order r, that of `e²/ê`, 2p − r.
pub(in crate::integrate) fn estimate_order<const S: usize>(tableau: &Tableau<S>) -> f64 {
    let fine = tableau.embedded_order + 1;
    f64::from(match tableau.coarse_order {
        0 => fine,
        coarse => 2 * fine - (coarse + 1),
    })
}

const O: Rational = (0, 1);

/// `digits · 10^−places`: a coefficient that is published as a decimal.
pub(in crate::integrate) const fn decimal(digits: i64, places: u32) -> Rational {
    (digits, 10_i64.pow(places))
}

/// A row: the coefficients given, by index, and zeros.
const fn row<const S: usize, const N: usize>(entries: [(usize, Rational); N]) -> [Rational; S] {
    let mut row = [O; S];
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
        coarse_error: [O; 4],
        coarse_order: 0,
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
        coarse_error: [O; 7],
        coarse_order: 0,
        first_same_as_last: true,
    };
}

impl Tableau<12> {
    /// Dormand and Prince, order 8: the twelve stages of DOP853, coefficients from Hairer, Nørsett & Wanner, *Solving
    /// Ordinary Differential Equations I*, 2nd ed. 1993, II.5 and its appendix, to 18 decimals. Four of the times
    /// contain √6.
    ///
    /// The embedded results are of orders 5 and 3. [`Adaptive`](crate::integrate::Adaptive) makes one estimate of them
    /// that goes like h⁸, as DOP853 does; the one of order 5 by itself is cautious: below a tolerance δ the result is
    /// good to about δ^(3/2).
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
        coarse_error: row([
            (0, decimal(-189_800_754_072_407_616, 18)),
            (5, decimal(4_450_312_892_752_408_881, 18)),
            (6, decimal(1_891_517_899_314_500_383, 18)),
            (7, decimal(-5_801_203_960_010_584_781, 18)),
            (8, decimal(-422_682_321_323_791_963, 18)),
            (9, decimal(-152_160_949_662_516_079, 18)),
            (10, decimal(201_365_400_804_030_348, 18)),
            (11, decimal(22_651_792_198_360_826, 18)),
        ]),
        coarse_order: 3,
        first_same_as_last: false,
    };
}

impl Tableau<16> {
    /// Verner, order 9 with an embedded order 8: the pair that he calls most efficient (J. H. Verner, *Numerically
    /// optimal Runge–Kutta pairs with interpolants*, Numer. Algorithms 53, 2010), from his published decimals, to 18 of
    /// them. Some of the times contain √6.
    ///
    /// For tolerances of 1e-10 and less, where it takes fewer evaluations than [`Tableau::DORMAND_PRINCE_8`] for the
    /// same error.
    pub const VERNER_9: Self = Self {
        a: [
            [O; 16],
            row([(0, (1_731, 50_000))]),
            row([(0, decimal(-38_933_543_885_728_733, 18)), (1, decimal(135_957_894_524_509_179, 18))]),
            row([(0, decimal(36_384_131_489_542_667, 18)), (2, decimal(109_152_394_468_628_002, 18))]),
            row([
                (0, decimal(2_025_763_914_393_969_637, 18)),
                (2, decimal(-763_802_383_649_629_202, 17)),
                (3, decimal(6_173_259_922_102_322_384, 18)),
            ]),
            row([
                (0, decimal(51_122_755_894_060_609, 18)),
                (3, decimal(177_082_379_455_502_154, 18)),
                (4, decimal(80_277_624_092_225, 17)),
            ]),
            row([
                (0, decimal(131_600_635_797_521_628, 18)),
                (3, decimal(-295_727_625_266_963_642, 18)),
                (4, decimal(87_813_780_356_429_524, 18)),
                (5, decimal(621_305_297_522_527_477, 18)),
            ]),
            row([(0, (43, 600)), (5, decimal(330_553_357_891_531_941, 18)), (6, decimal(242_779_975_441_801_392, 18))]),
            row([
                (0, decimal(71_806_640_625, 12)),
                (5, decimal(329_438_028_322_817_716, 18)),
                (6, decimal(116_519_002_927_182_284, 18)),
                (7, decimal(-34_013_671_875, 12)),
            ]),
            row([
                (0, decimal(4_836_757_646_340_647, 17)),
                (5, decimal(3_928_989_925_676_164, 17)),
                (6, decimal(105_474_094_589_034_461, 18)),
                (7, decimal(-21_438_652_846_483_127, 18)),
                (8, decimal(-104_122_917_462_719_444, 18)),
            ]),
            row([
                (0, decimal(-26_645_614_872_014_786, 18)),
                (5, (1, 30)),
                (6, decimal(-163_107_224_487_246_724, 18)),
                (7, decimal(33_960_816_841_277_612, 18)),
                (8, decimal(15_723_194_138_146_261, 17)),
                (9, decimal(215_226_747_803_187_955, 18)),
            ]),
            row([
                (0, decimal(36_890_092_487_086_223, 18)),
                (5, decimal(-146_518_157_672_554_293, 18)),
                (6, decimal(224_257_776_817_202_435, 18)),
                (7, decimal(22_944_057_170_660_726, 18)),
                (8, decimal(-3_585_005_290_572_876, 18)),
                (9, decimal(86_692_233_164_443_855, 18)),
                (10, decimal(438_384_065_196_833_785, 18)),
            ]),
            row([
                (0, decimal(-486_601_221_511_334_085, 18)),
                (5, decimal(-6_304_602_650_282_852_991, 18)),
                (6, decimal(-281_245_618_289_472_565, 18)),
                (7, decimal(-2_679_019_236_219_849_058, 18)),
                (8, decimal(518_815_663_924_157_512, 18)),
                (9, decimal(1_365_353_187_603_341_711, 18)),
                (10, decimal(5_885_091_088_503_946_586, 18)),
                (11, decimal(280_280_878_627_206_289, 17)),
            ]),
            row([
                (0, decimal(418_536_745_775_347_144, 18)),
                (5, decimal(6_724_547_581_906_459_363, 18)),
                (6, decimal(-425_444_280_164_611_791, 18)),
                (7, decimal(3_343_279_153_001_265_578, 18)),
                (8, decimal(61_708_166_311_753_776, 17)),
                (9, decimal(-929_966_123_939_932_834, 18)),
                (10, decimal(-6_099_948_804_751_010_722, 18)),
                (11, decimal(-3_002_206_187_889_399_045, 18)),
                (12, decimal(255_320_252_944_344_547, 18)),
            ]),
            row([
                (0, decimal(-779_374_086_122_884_665, 18)),
                (5, decimal(-1_393_734_253_810_777_679, 17)),
                (6, decimal(1_252_048_853_379_357_321, 18)),
                (7, decimal(-1_469_150_040_801_686_878, 17)),
                (8, decimal(-494_705_058_533_141_686, 18)),
                (9, decimal(2_242_974_909_146_236_658, 18)),
                (10, decimal(1_336_789_380_382_864_376, 17)),
                (11, decimal(1_439_665_048_665_068_645, 17)),
                (12, decimal(-797_581_333_177_680_038, 18)),
                (13, decimal(440_935_370_953_427_776, 18)),
            ]),
            row([
                (0, decimal(2_058_051_337_466_886_442, 18)),
                (5, decimal(2_235_793_772_796_803_296, 17)),
                (6, decimal(909_498_109_975_563_327, 18)),
                (7, decimal(3_589_110_098_240_264_105, 17)),
                (8, decimal(-3_442_515_027_624_453_438, 18)),
                (9, decimal(-4_865_481_358_036_368_827, 18)),
                (10, decimal(-1_890_980_381_354_342_626, 17)),
                (11, decimal(-3_426_354_448_030_451_783, 17)),
                (12, decimal(1_264_756_521_695_642_579, 18)),
            ]),
        ],
        b: row([
            (0, decimal(14_611_976_858_423_153, 18)),
            (7, decimal(-391_521_186_233_133_909, 18)),
            (8, decimal(231_093_250_028_950_642, 18)),
            (9, decimal(127_476_676_999_285_238, 18)),
            (10, decimal(224_643_417_620_415_773, 18)),
            (11, decimal(568_435_268_974_851_293, 18)),
            (12, decimal(58_258_715_572_158_272, 18)),
            (13, decimal(136_431_740_348_221_564, 18)),
            (14, decimal(30_570_139_830_827_974, 18)),
        ]),
        c: row([
            (1, (1_731, 50_000)),
            (2, decimal(97_024_350_638_780_446, 18)),
            (3, decimal(145_536_525_958_170_669, 18)),
            (4, (561, 1_000)),
            (5, decimal(229_007_911_590_485_013, 18)),
            (6, decimal(544_992_088_409_514_987, 18)),
            (7, (129, 200)),
            (8, (387, 800)),
            (9, (6_757, 100_000)),
            (10, (1, 4)),
            (11, decimal(659_065_061_873_099_855, 18)),
            (12, (4_103, 5_000)),
            (13, (2_253, 2_500)),
            (14, (1, 1)),
            (15, (1, 1)),
        ]),
        error: row([
            (0, decimal(-5_357_988_290_444_578, 18)),
            (7, decimal(-2_583_020_491_182_463_963, 18)),
            (8, decimal(142_522_531_546_866_261, 18)),
            (9, decimal(13_420_653_512_688_676, 18)),
            (10, decimal(-28_672_962_914_094_933, 18)),
            (11, decimal(2_624_999_655_215_792_304, 18)),
            (12, decimal(-282_550_964_329_153_722, 18)),
            (13, decimal(136_431_740_348_221_564, 18)),
            (14, decimal(30_570_139_830_827_974, 18)),
            (15, decimal(-48_342_313_738_239_583, 18)),
        ]),
        order: 9,
        embedded_order: 8,
        coarse_error: [O; 16],
        coarse_order: 0,
        first_same_as_last: false,
    };
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::vec::Vec;

    fn value((p, q): Rational) -> f64 {
        p as f64 / q as f64
    }

    /// A rooted tree: its number of vertices, γ, and the stages' elementary weights Φ, by the coefficients and by their
    /// magnitudes.
    struct Tree<const S: usize> {
        vertices: u32,
        density: f64,
        weights: [f64; S],
        sizes: [f64; S],
    }

    /// `AΦ`.
    fn through<const S: usize>(a: &[[f64; S]; S], phi: &[f64; S]) -> [f64; S] {
        a.each_ref().map(|row| row.iter().zip(phi).map(|(a, phi)| a * phi).sum())
    }

    /// All trees with so many vertices: a root, and a multiset of the branches given, from number `from` on.
    fn grow<const S: usize>(
        branches: &[Tree<S>],
        from: usize,
        left: u32,
        (density, weights, sizes): (f64, [f64; S], [f64; S]),
        found: &mut impl FnMut(f64, [f64; S], [f64; S]),
    ) {
        if left == 0 {
            return found(density, weights, sizes);
        }
        for (n, branch) in branches.iter().enumerate().skip(from).filter(|(_, branch)| branch.vertices <= left) {
            let times = |x: &[f64; S], y: &[f64; S]| core::array::from_fn(|i| x[i] * y[i]);
            let joined = (density * branch.density, times(&weights, &branch.weights), times(&sizes, &branch.sizes));
            grow(branches, n, left - branch.vertices, joined, found);
        }
    }

    /// All conditions of order `Σ b Φ(τ) = 1/γ(τ)`, τ a rooted tree with as many vertices as the order at most (Hairer,
    /// Nørsett & Wanner II.2), for the result and the embedded ones, and row sums: to the rounding of each coefficient
    /// on the way and of the sums. Returns the number of conditions for the result.
    fn check<const S: usize>(tableau: &Tableau<S>) -> usize {
        let a = tableau.a.map(|row| row.map(value));
        let magnitudes = a.map(|row| row.map(f64::abs));
        let b = tableau.b.map(value);
        let size_of = |weights: &[f64; S], sizes: &[f64; S]| -> f64 {
            weights.iter().zip(sizes).map(|(b, phi)| b.abs() * phi).sum()
        };
        for (row, &c) in a.iter().zip(&tableau.c) {
            let size: f64 = row.iter().map(|a| a.abs()).sum();
            assert!(
                (row.iter().sum::<f64>() - value(c)).abs() <= f64::EPSILON * (S as f64 * size + 1.0),
                "{row:?} {c:?}"
            );
        }
        let mut branches: Vec<Tree<S>> = Vec::new();
        let mut count = 0;
        for vertices in 1..=tableau.order {
            let mut trees = Vec::new();
            grow(&branches, 0, vertices - 1, (1.0, [1.0; S], [1.0; S]), &mut |density, weights, sizes| {
                count += 1;
                let density = density * f64::from(vertices);
                let rounding = f64::EPSILON * f64::from(vertices) * (S as f64 + 2.0);
                let sum = |b: &[f64; S]| b.iter().zip(&weights).map(|(b, phi)| b * phi).sum::<f64>();
                let defect = (sum(&b) - 1.0 / density).abs();
                assert!(defect <= rounding * size_of(&b, &sizes), "{vertices} vertices: {defect:e}");
                for (error, order) in
                    [(&tableau.error, tableau.embedded_order), (&tableau.coarse_error, tableau.coarse_order)]
                {
                    let error = error.map(value);
                    if vertices <= order {
                        assert!(sum(&error).abs() <= rounding * size_of(&error, &sizes), "{order}, {vertices}");
                    }
                }
                let (weights, sizes) = (through(&a, &weights), through(&magnitudes, &sizes));
                trees.push(Tree { vertices, density, weights, sizes });
            });
            branches.extend(trees);
        }
        count
    }

    #[test]
    fn all_conditions_of_order_hold() {
        // The numbers of rooted trees: 1, 1, 2, 4, 9, 20, 48, 115, 286.
        assert_eq!(check(&Tableau::RK4), 8);
        assert_eq!(check(&Tableau::DORMAND_PRINCE_5), 17);
        assert_eq!(check(&Tableau::DORMAND_PRINCE_8), 200);
        assert_eq!(check(&Tableau::VERNER_9), 486);
        assert_eq!(Tableau::DORMAND_PRINCE_5.a[6], Tableau::DORMAND_PRINCE_5.b);
    }
}
