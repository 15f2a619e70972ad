//! One suite of laws for every group, and the coefficients against numbers of 120 digits.

use core::f64::consts::PI;
use nalgebra::{Isometry2, Isometry3, SVector, UnitQuaternion};
use std::vec::Vec;

use super::coefficients::{
    cubic, cubic_derivative, dexp_inv, dexp_inv_derivative, sinc, sinc_cos, versine, versine_derivative,
};
use super::{se2, se3, so3};
use crate::configuration::{Configuration, Product, VectorSpace};
use crate::real::Real;
use crate::simd::Lanes;

/// θ, then sinc, versine, cubic, dexp⁻¹ and its derivative: computed with mpmath from the closed forms.
// Angles near 2π are angles near 2π, not attempts at it.
#[allow(clippy::approx_constant)]
#[rustfmt::skip]
const REFERENCE: [[f64; 6]; 30] = [
    [5e-324, 1.0, 0.5, 0.166_666_666_666_666_66, 0.083_333_333_333_333_33, 0.001_388_888_888_888_889],
    [1e-160, 1.0, 0.5, 0.166_666_666_666_666_66, 0.083_333_333_333_333_33, 0.001_388_888_888_888_889],
    [1e-09, 1.0, 0.5, 0.166_666_666_666_666_66, 0.083_333_333_333_333_33, 0.001_388_888_888_888_889],
    [0.0001, 0.999_999_998_333_333_3, 0.499_999_999_583_333_35, 0.166_666_666_583_333_34, 0.083_333_333_347_222_22, 0.001_388_888_889_550_264_6],
    [0.01, 0.999_983_333_416_666_5, 0.499_995_833_347_222_2, 0.166_665_833_335_317_45, 0.083_333_472_222_552_91, 0.001_388_895_502_670_304_3],
    [0.1, 0.998_334_166_468_281_5, 0.499_583_472_197_423_4, 0.166_583_353_171_847_7, 0.083_347_225_529_927_46, 0.001_389_550_512_649_671],
    [0.3, 0.985_067_355_537_798_6, 0.496_261_231_937_710_9, 0.165_918_271_802_237_95, 0.083_458_601_794_527_62, 0.001_394_861_420_177_430_7],
    [0.499, 0.959_013_459_871_396_9, 0.489_710_689_684_666_8, 0.164_603_917_769_820_58, 0.083_681_231_213_662_49, 0.001_405_512_282_003_215_5],
    [0.5, 0.958_851_077_208_406, 0.489_669_752_438_509_13, 0.164_595_691_166_375_98, 0.083_682_635_354_059_9, 0.001_405_579_605_540_907_7],
    [0.51, 0.957_210_288_005_701, 0.489_256_025_967_892_1, 0.164_512_541_308_339_23, 0.083_696_835_146_353_63, 0.001_406_260_539_166_833],
    [0.8, 0.896_695_113_624_403_5, 0.473_895_766_645_054, 0.161_413_884_961_869_62, 0.084_235_987_475_555_88, 0.001_432_255_147_156_902_7],
    [1.0, 0.841_470_984_807_896_5, 0.459_697_694_131_860_3, 0.158_529_015_192_103_5, 0.084_756_139_143_774_04, 0.001_457_592_845_618_332_5],
    [1.5, 0.664_996_657_736_036_3, 0.413_005_688_147_687_6, 0.148_890_374_339_539_42, 0.086_635_728_261_318_66, 0.001_551_278_087_027_641],
    [1.9, 0.498_052_677_730_218_16, 0.366_562_206_887_397_1, 0.139_043_579_576_116_85, 0.088_820_973_855_990_32, 0.001_664_399_655_707_999_8],
    [1.999, 0.455_084_101_522_859_16, 0.354_163_407_666_430_84, 0.136_365_305_833_792_53, 0.089_470_051_498_552_9, 0.001_698_872_749_204_222],
    [2.0, 0.454_648_713_412_840_85, 0.354_036_709_136_785_6, 0.136_337_821_646_789_8, 0.089_476_846_016_417_32, 0.001_699_235_730_366_331_8],
    [2.001, 0.454_213_306_051_882_54, 0.353_909_982_976_781_9, 0.136_310_329_080_366_75, 0.089_483_645_385_284_14, 0.001_699_599_014_634_767_6],
    [2.5, 0.239_388_857_641_582_6, 0.288_182_978_487_509_4, 0.121_697_782_777_346_79, 0.093_545_316_549_094_29, 0.001_924_487_152_352_498],
    [2.9, 0.082_499_768_694_476_7, 0.234_358_878_139_071_4, 0.109_096_341_415_638_93, 0.097_977_215_958_399_91, 0.002_187_897_751_945_594_6],
    [2.999, 0.047_385_771_867_779_48, 0.221_242_012_494_739_38, 0.105_916_624_662_619_06, 0.099_278_357_180_236_85, 0.002_268_819_572_174_574_3],
    [3.001, 0.046_694_416_917_116_79, 0.220_978_558_806_375_7, 0.105_852_262_628_316_75, 0.099_305_593_281_138_28, 0.002_270_530_912_421_464_5],
    [3.1, 0.013_413_116_913_964_674, 0.208_026_550_496_699_21, 0.102_662_526_855_987_02, 0.100_703_542_735_565_75, 0.002_359_330_781_250_743_5],
    [PI, 3.898_171_832_519_375_5e-17, 0.202_642_367_284_675_55, 0.101_321_183_642_337_78, 0.101_321_183_642_337_78, 0.002_399_165_700_607_886],
    [3.5, -0.100_223_779_339_891_39, 0.158_078_096_921_697_66, 0.089_814_186_068_562_56, 0.107_510_789_142_881_36, 0.002_818_780_098_056_667_3],
    [3.99, -0.188_027_149_932_310_5, 0.104_344_748_951_004_05, 0.074_624_352_229_716_54, 0.119_408_169_311_172_32, 0.003_730_165_871_999_634],
    [4.01, -0.190_349_372_261_115_56, 0.102_365_224_105_257_99, 0.074_026_241_892_843_68, 0.120_008_958_100_888_73, 0.003_779_862_634_736_941],
    [5.0, -0.191_784_854_932_627_7, 0.028_653_512_581_470_95, 0.047_671_394_197_305_11, 0.173_864_812_830_415_13, 0.009_682_597_800_452_736],
    [6.0, -0.046_569_249_699_820_98, 0.001_106_380_926_378_721_7, 0.029_071_368_047_217_248, 0.612_382_157_063_988_9, 0.165_462_252_156_394_68],
    [6.28, -0.000_507_213_661_327_705_4, 1.286_331_754_023_489_5e-07, 0.025_368_859_123_628_94, 50.015_992_748_765_35, 1_248.900_626_687_766_8],
    [6.283_185_3, -1.142_666_612_057_935_6e-09, 6.528_434_931_559_802_5e-19, 0.025_330_295_997_416_694, 22_167_704.674_416_788, 245_703_564_423_808.22],
];

/// θ, then the derivatives of versine and cubic by θ², from the same closed forms.
#[allow(clippy::approx_constant)]
#[rustfmt::skip]
const SLOPES: [[f64; 3]; 24] = [
    [0.0001, -0.041_666_666_638_888_89, -0.008_333_333_329_365_079],
    [0.01, -0.041_666_388_889_632_935, -0.008_333_293_650_876_322],
    [0.1, -0.041_638_896_328_262_89, -0.008_329_365_905_984_456],
    [0.3, -0.041_417_268_542_351_12, -0.008_297_685_938_905_468],
    [0.499, -0.040_979_593_451_304_724, -0.008_235_034_447_241_168],
    [0.5, -0.040_976_855_337_224_54, -0.008_234_642_121_237_716],
    [0.51, -0.040_949_180_949_794_78, -0.008_230_676_580_402_817],
    [0.8, -0.039_919_077_863_831_726, -0.008_082_725_187_933_428],
    [1.0, -0.038_962_201_727_912_03, -0.007_944_675_722_225_1],
    [1.5, -0.035_781_048_568_741_98, -0.007_481_207_749_095_708],
    [2.0, -0.031_678_088_107_591_29, -0.006_872_094_475_447_970_5],
    [2.499, -0.026_968_003_409_156_036, -0.006_154_351_839_167_986],
    [2.5, -0.026_958_167_946_674_896, -0.006_152_829_587_562_476],
    [2.501, -0.026_948_331_350_914_533, -0.006_151_307_055_285_932],
    [2.9, -0.022_961_830_415_200_127, -0.005_524_978_960_038_369],
    [3.1, -0.020_949_010_618_076_677, -0.005_200_886_059_899_159_5],
    [PI, -0.020_531_964_509_368_672, -0.005_132_991_127_342_168],
    [3.39, -0.018_066_694_647_564_99, -0.004_725_849_640_394_459_5],
    [3.4, -0.017_968_670_050_234_93, -0.004_709_441_526_627_249],
    [3.99, -0.012_459_615_449_473_263, -0.003_754_006_185_204_413_3],
    [4.01, -0.012_284_743_890_635_991, -0.003_722_411_601_086_842_3],
    [5.0, -0.004_981_837_601_911_392, -0.002_287_213_400_208_887_5],
    [6.0, -0.000_677_527_938_230_255_9, -0.001_195_940_600_212_125_4],
    [6.28, -6.433_715_968_174_547e-6, -0.000_964_877_489_169_330_1],
];

fn near(found: f64, expected: f64, tolerance: f64, what: &str) {
    let error = (found - expected).abs();
    assert!(error <= tolerance, "{what}: {found:e} instead of {expected:e}, off by {error:e}");
}

#[test]
fn coefficients_at_every_angle() {
    for [theta, a, b, c, d, e] in REFERENCE {
        let s = theta * theta;
        // Rounding θ² to s moves the argument; what that does near the pole at 2π is not the function's error.
        let pole = 1.0 + theta * theta / (2.0 * PI - theta).abs() / 8.0;
        near(sinc(s), a, 4e-16, "sinc");
        near(versine(s), b, 6e-16 * b.max(0.2), "versine");
        near(cubic(s), c, 4e-16 * c, "cubic");
        near(dexp_inv(s), d, 5e-16 * d * pole, "dexp_inv");
        near(dexp_inv_derivative(s), e, 8e-16 * e * pole, "dexp_inv_derivative");
        let (sine, cosine) = sinc_cos(s);
        near(sine, a, 4e-16, "sinc");
        near(cosine, theta.cos(), 7e-16, "cosine");
    }
    for [theta, a, b] in SLOPES {
        near(versine_derivative(theta * theta), a, 8e-16 * a.abs().max(0.01), "versine_derivative");
        near(cubic_derivative(theta * theta), b, 1.5e-15 * b.abs(), "cubic_derivative");
    }
    assert_eq!((versine_derivative(0.0), cubic_derivative(0.0)), (-1.0 / 24.0, -1.0 / 120.0));
}

#[test]
fn packs_take_both_branches_lane_by_lane() {
    for pair in [[1e-3, 1.0], [0.1, 3.9], [2.5, 5.0], [0.0, 6.0], [4.5, 5.5]] {
        let s = Lanes(pair.map(|theta: f64| theta * theta));
        for (lane, s1) in s.0.into_iter().enumerate() {
            near(sinc(s).lane(lane), sinc(s1), 3e-16, "sinc");
            near(versine(s).lane(lane), versine(s1), 3e-16, "versine");
            near(cubic(s).lane(lane), cubic(s1), 1e-16, "cubic");
            near(dexp_inv(s).lane(lane), dexp_inv(s1), 5e-16, "dexp_inv");
            near(dexp_inv_derivative(s).lane(lane), dexp_inv_derivative(s1), 1e-15, "derivative");
            near(versine_derivative(s).lane(lane), versine_derivative(s1), 1e-16, "derivative of versine");
            near(cubic_derivative(s).lane(lane), cubic_derivative(s1), 1e-16, "derivative of cubic");
        }
    }
}

/// Operations that the laws need beside [`Configuration`].
trait Group: Configuration<Scalar = f64> {
    const NAME: &'static str;
    fn identity() -> Self;
    fn exp(v: &Self::Tangent) -> Self;
    fn log(&self) -> Self::Tangent;
    fn compose(&self, other: &Self) -> Self;
    fn adjoint(&self, w: &Self::Tangent) -> Self::Tangent;
    /// The angular part of a tangent has these indices.
    const ANGULAR: core::ops::Range<usize>;
}

impl Group for UnitQuaternion<f64> {
    const NAME: &'static str = "SO(3)";
    const ANGULAR: core::ops::Range<usize> = 0..3;
    fn identity() -> Self {
        Self::identity()
    }
    fn exp(v: &Self::Tangent) -> Self {
        so3::exp(v)
    }
    fn log(&self) -> Self::Tangent {
        so3::log(self)
    }
    fn compose(&self, other: &Self) -> Self {
        self * other
    }
    fn adjoint(&self, w: &Self::Tangent) -> Self::Tangent {
        so3::adjoint(self, w)
    }
}

impl Group for Isometry3<f64> {
    const NAME: &'static str = "SE(3)";
    const ANGULAR: core::ops::Range<usize> = 3..6;
    fn identity() -> Self {
        Self::identity()
    }
    fn exp(v: &Self::Tangent) -> Self {
        se3::exp(v)
    }
    fn log(&self) -> Self::Tangent {
        se3::log(self)
    }
    fn compose(&self, other: &Self) -> Self {
        self * other
    }
    fn adjoint(&self, w: &Self::Tangent) -> Self::Tangent {
        se3::adjoint(self, w)
    }
}

impl Group for Isometry2<f64> {
    const NAME: &'static str = "SE(2)";
    const ANGULAR: core::ops::Range<usize> = 2..3;
    fn identity() -> Self {
        Self::identity()
    }
    fn exp(v: &Self::Tangent) -> Self {
        se2::exp(v)
    }
    fn log(&self) -> Self::Tangent {
        se2::log(self)
    }
    fn compose(&self, other: &Self) -> Self {
        self * other
    }
    fn adjoint(&self, w: &Self::Tangent) -> Self::Tangent {
        se2::adjoint(self, w)
    }
}

impl Group for (UnitQuaternion<f64>, SVector<f64, 2>) {
    const NAME: &'static str = "SO(3) × R²";
    const ANGULAR: core::ops::Range<usize> = 0..3;
    fn identity() -> Self {
        (UnitQuaternion::identity(), SVector::zeros())
    }
    fn exp(v: &Self::Tangent) -> Self {
        (so3::exp(&v.first), v.second)
    }
    fn log(&self) -> Self::Tangent {
        Product { first: so3::log(&self.0), second: self.1 }
    }
    fn compose(&self, other: &Self) -> Self {
        (self.0 * other.0, self.1 + other.1)
    }
    fn adjoint(&self, w: &Self::Tangent) -> Self::Tangent {
        Product { first: so3::adjoint(&self.0, &w.first), second: w.second }
    }
}

/// A group coordinate beside others: every method goes to its factor.
impl Group for (Isometry3<f64>, (UnitQuaternion<f64>, SVector<f64, 2>)) {
    const NAME: &'static str = "SE(3) × (SO(3) × R²)";
    const ANGULAR: core::ops::Range<usize> = 3..9;
    fn identity() -> Self {
        (Group::identity(), Group::identity())
    }
    fn exp(v: &Self::Tangent) -> Self {
        (Group::exp(&v.first), Group::exp(&v.second))
    }
    fn log(&self) -> Self::Tangent {
        Product { first: Group::log(&self.0), second: Group::log(&self.1) }
    }
    fn compose(&self, other: &Self) -> Self {
        (Group::compose(&self.0, &other.0), Group::compose(&self.1, &other.1))
    }
    fn adjoint(&self, w: &Self::Tangent) -> Self::Tangent {
        Product { first: Group::adjoint(&self.0, &w.first), second: Group::adjoint(&self.1, &w.second) }
    }
}

type T<G> = <G as Configuration>::Tangent;

/// A tangent with angular part of the given size, from a fixed irregular sequence.
fn tangent<G: Group>(seed: usize, size: f64) -> T<G> {
    let mut v = T::<G>::zero();
    for i in 0..T::<G>::DIM {
        v.set_component(i, ((seed * 7 + i * 3) as f64 * 1.7 + 0.3).sin());
    }
    let angle: f64 = G::ANGULAR.map(|i| v.component(i).powi(2)).sum::<f64>().sqrt();
    v.scale(size / angle)
}

fn distance<G: Group>(v: &T<G>, w: &T<G>) -> f64 {
    v.add_scaled(-1.0, w).max_norm()
}

/// Sizes of the angular part, from nothing to nearly a turn.
const SIZES: [f64; 14] = [0.0, 1e-300, 1e-12, 1e-8, 1e-4, 0.01, 0.3, 0.5, 1.0, 2.0, 3.0, 3.1, PI - 5e-8, PI - 3e-15];

fn laws<G: Group>() {
    for (seed, size) in SIZES.into_iter().enumerate() {
        let v = tangent::<G>(seed, size);
        let scale = size.max(1e-300);

        // log ∘ exp; near π the linear part is read off V⁻¹, which is of order 1.
        let back = G::exp(&v).log();
        let error = distance::<G>(&v, &back);
        assert!(error <= 4e-15 * v.max_norm().max(1e-300), "{}: log exp at {size:e}: {error:e}", G::NAME);

        // exp ∘ log, as a vanishing difference.
        let q = G::exp(&tangent::<G>(seed + 5, 2.0)).compose(&G::exp(&v));
        let error = G::exp(&q.log()).difference(&q).max_norm();
        // In the plane the irregular sequence makes translations of up to 30.
        let size_of_q = 1.0 + q.log().max_norm();
        assert!(error < 2e-15 * size_of_q, "{}: exp log at {size:e}: {error:e}", G::NAME);

        // One-parameter group: exp(v) exp(v) = exp(2v), and exp(v) exp(−v) = 1.
        let error = G::exp(&v).compose(&G::exp(&v)).difference(&G::exp(&v.scale(2.0))).max_norm();
        assert!(error < 3e-15 * (1.0 + scale), "{}: doubling at {size:e}: {error:e}", G::NAME);
        let error = G::exp(&v).compose(&G::exp(&v.scale(-1.0))).difference(&G::identity()).max_norm();
        assert!(error < 2e-15 * (1.0 + scale), "{}: inverse at {size:e}: {error:e}", G::NAME);

        // retract and difference are what they say.
        let p = G::exp(&tangent::<G>(seed + 9, 1.3));
        let error = p.retract(&v).difference(&p.compose(&G::exp(&v))).max_norm();
        assert!(error < 2e-15 * (1.0 + scale), "{}: retract at {size:e}: {error:e}", G::NAME);
        let step = p.difference(&q);
        let error = p.retract(&step).difference(&q).max_norm();
        assert!(error < 4e-15 * (1.0 + step.max_norm()), "{}: difference at {size:e}: {error:e}", G::NAME);

        // Ad_q w is the tangent of q exp(w) q⁻¹: q ∘ exp(w) = exp(Ad_q w) ∘ q.
        let w = tangent::<G>(seed + 2, 0.7);
        let error = p.compose(&G::exp(&w)).difference(&G::exp(&p.adjoint(&w)).compose(&p)).max_norm();
        assert!(error < 4e-15, "{}: adjoint at {size:e}: {error:e}", G::NAME);
        // Ad is an automorphism of the bracket.
        let u = tangent::<G>(seed + 3, 1.1);
        let error = distance::<G>(&p.adjoint(&G::bracket(&u, &w)), &G::bracket(&p.adjoint(&u), &p.adjoint(&w)));
        assert!(error < 1e-14, "{}: bracket at {size:e}: {error:e}", G::NAME);
        // Ad_exp(v) = exp(ad_v), summed as a series.
        let mut term = w;
        let mut sum = w;
        for n in 1..60 {
            term = G::bracket(&v, &term).scale(1.0 / f64::from(n));
            sum = sum.add_scaled(1.0, &term);
        }
        let error = distance::<G>(&sum, &G::exp(&v).adjoint(&w));
        assert!(error < 1e-13, "{}: exp ad at {size:e}: {error:e}", G::NAME);
    }
}

/// dexp⁻¹ = Σ (−1)ᵏ B_k/k! ad_vᵏ, which converges for angles below 2π.
fn inverse_differential_by_adjoint_powers<G: Group>() {
    // B_2k/(2k)! = (−1)^{k+1} 2 ζ(2k)/(2π)^{2k}
    let bernoulli = |k: i32| {
        let zeta: f64 = (1..2000).rev().map(|n| f64::from(n).powi(-2 * k)).sum::<f64>()
            + 2000_f64.powi(1 - 2 * k) / f64::from(2 * k - 1)
            + 0.5 * 2000_f64.powi(-2 * k)
            + f64::from(k) / 6.0 * 2000_f64.powi(-2 * k - 1);
        let sign = if k % 2 == 1 { 2.0 } else { -2.0 };
        sign * zeta / (2.0 * PI).powi(2 * k)
    };
    for (seed, size) in [0.0, 1e-12, 1e-5, 0.1, 0.49, 0.51, 1.0, 2.0, 2.9, 3.1].into_iter().enumerate() {
        let (v, w) = (tangent::<G>(seed, size), tangent::<G>(seed + 4, 1.0));
        let mut sum = w.add_scaled(0.5, &G::bracket(&v, &w));
        let mut power = w;
        for k in 1..60 {
            power = G::bracket(&v, &G::bracket(&v, &power));
            sum = sum.add_scaled(bernoulli(k), &power);
        }
        let error = distance::<G>(&sum, &G::dexp_inv(&v, &w));
        assert!(error < 2e-14, "{}: dexp_inv at {size:e}: {error:e}", G::NAME);
    }
}

/// If σ moves by dexp_inv(σ, w) then exp(σ) moves with body velocity w: the definition, by central differences.
fn inverse_differential_by_finite_differences<G: Group>() {
    let step = 1e-5;
    for (seed, size) in [0.0, 1e-7, 0.2, 0.6, 1.5, 3.0, PI, 4.5, 6.0].into_iter().enumerate() {
        let (v, w) = (tangent::<G>(seed, size), tangent::<G>(seed + 4, 1.0));
        let rate = G::dexp_inv(&v, &w);
        let (before, after) = (G::exp(&v.add_scaled(-step, &rate)), G::exp(&v.add_scaled(step, &rate)));
        let found = G::exp(&v).difference(&after).add_scaled(-1.0, &G::exp(&v).difference(&before));
        let error = distance::<G>(&found.scale(0.5 / step), &w);
        // The third derivative grows with the rate, which grows towards the pole at 2π.
        let allowed = 3e-10 * (1.0 + rate.max_norm()).powi(3);
        assert!(error < allowed, "{}: dexp_inv at {size:e}: {error:e}", G::NAME);
    }
}

/// dexp = Σ (−1)ᵏ/(k+1)! ad_vᵏ at every angle, what dexp⁻¹ undoes, and 1 − dexp·ad = exp(−ad) = Ad of exp(−v).
fn differential<G: Group>() {
    for (seed, size) in [0.0, 1e-300, 1e-12, 1e-5, 0.1, 0.49, 0.51, 1.0, 2.0, 2.49, 2.51, 3.1].into_iter().enumerate() {
        let (v, w) = (tangent::<G>(seed, size), tangent::<G>(seed + 4, 1.0));
        // What ad and its powers make of w is at most e^π (1 + |v|): translations count as often as they are long.
        let allowed = 23.0 * f64::EPSILON * (1.0 + v.max_norm());
        let dexp = G::dexp(&v);
        let found = dexp(&w);
        let (mut term, mut sum) = (w, w);
        for k in 1..60 {
            term = G::bracket(&v, &term).scale(-1.0 / f64::from(k + 1));
            sum = sum.add_scaled(1.0, &term);
        }
        let error = distance::<G>(&found, &sum);
        assert!(error <= allowed, "{}: dexp at {size:e}: {error:e}", G::NAME);
        let error = distance::<G>(&G::dexp_inv(&v, &found), &w);
        assert!(error <= allowed, "{}: dexp_inv dexp at {size:e}: {error:e}", G::NAME);
        let bracket = G::bracket(&v, &w);
        let carried = w.add_scaled(-1.0, &dexp(&bracket));
        let error = distance::<G>(&carried, &G::exp(&v.scale(-1.0)).adjoint(&w));
        assert!(error <= allowed, "{}: exp(−ad) at {size:e}: {error:e}", G::NAME);
    }
}

fn suite<G: Group>() {
    differential::<G>();
    laws::<G>();
    inverse_differential_by_adjoint_powers::<G>();
    inverse_differential_by_finite_differences::<G>();
}

#[test]
fn rotations() {
    suite::<UnitQuaternion<f64>>();
}

#[test]
fn motions() {
    suite::<Isometry3<f64>>();
}

#[test]
fn plane_motions() {
    suite::<Isometry2<f64>>();
}

#[test]
fn products() {
    suite::<(UnitQuaternion<f64>, SVector<f64, 2>)>();
    suite::<(Isometry3<f64>, (UnitQuaternion<f64>, SVector<f64, 2>))>();
}

#[test]
fn logarithm_of_both_quaternions_of_a_rotation() {
    for size in [1e-200, 1e-9, 0.2, 2.0, 3.1, PI - 6e-7] {
        let v: SVector<f64, 3> = tangent::<UnitQuaternion<f64>>(3, size);
        let q = so3::exp(&v);
        let opposite = UnitQuaternion::new_unchecked(-q.into_inner());
        assert!((so3::log(&q) - v).amax() <= 1e-15 * size.max(1e-300), "{size}");
        assert!((so3::log(&opposite) - v).amax() <= 1e-15 * size.max(1e-300), "{size}");
    }
    // Half a turn: either sign.
    let half = UnitQuaternion::new_unchecked(nalgebra::Quaternion::new(0.0, 0.6, 0.0, 0.8));
    let expected = SVector::from([0.6, 0.0, 0.8]) * PI;
    assert!((so3::log(&half) - expected).amax() < 5e-16);
}

#[test]
fn norms_are_brought_back_without_bias() {
    // Products of a million rotations, renormalised each time: the norm stays within a few ulp, on both sides.
    let step = so3::exp(&SVector::from([1e-2, -2e-2, 1.5e-2]));
    let mut q = UnitQuaternion::identity();
    let (mut sum, mut worst) = (0.0, 0.0_f64);
    let count = 200_000;
    for _ in 0..count {
        q = so3::renormalise(&UnitQuaternion::new_unchecked(q.into_inner() * step.into_inner()));
        let excess: f64 = q.as_ref().coords.norm_squared() - 1.0;
        sum += excess;
        worst = worst.max(excess.abs());
    }
    assert!(worst <= 2e-15, "{worst:e}");
    assert!((sum / f64::from(count)).abs() < 5e-17, "{:e}", sum / f64::from(count));
    // From far away.
    let far = UnitQuaternion::new_unchecked(nalgebra::Quaternion::new(3.0, 0.0, -4.0, 0.0));
    let near = so3::renormalise(&far);
    assert!((near.as_ref().coords - SVector::from([0.0, -0.8, 0.0, 0.6])).amax() < 1e-15);
}

#[test]
fn single_precision() {
    let v = SVector::from([0.3_f32, -0.2, 0.5, 1.0, 0.7, -0.4]);
    let back = se3::log(&se3::exp(&v));
    assert!((back - v).amax() < 1e-6);
    let wide = se3::exp(&v.cast::<f64>());
    assert!((se3::exp(&v).translation.vector.cast::<f64>() - wide.translation.vector).amax() < 2e-7);
}

#[test]
fn what_is_not_finite_stays_so() {
    let v = SVector::from([0.0, f64::NAN, 1.0, 0.0, 0.0, 1.0]);
    assert!(!Configuration::is_finite(&se3::exp(&v)));
    assert!(!Configuration::is_finite(&so3::exp(&SVector::from([f64::INFINITY, 0.0, 0.0]))));
    let parts: Vec<f64> = se3::dexp_inv(&v, &v).iter().copied().collect();
    assert!(parts.iter().any(|part| part.is_nan()));
}
