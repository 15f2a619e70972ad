//! Sines and cosines against sums of two numbers (106 binary digits) and against the library; both reductions, whatever the target.

use std::vec::Vec;

use super::{MULTIPLES, of_small_angle, sines_and_cosines};
use crate::real::Real;

/// Angles up to here are not left to the library.
const LIMIT: f64 = (MULTIPLES - 1) as f64 * core::f64::consts::FRAC_PI_2;

fn sin_cos(x: f64) -> (f64, f64) {
    super::sin_cos(x, Real::fma)
}

/// Numbers below 1 in magnitude.
fn random() -> impl FnMut() -> f64 {
    let mut seed = 1_u64;
    move || {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (seed >> 11) as f64 / (1_u64 << 53) as f64 * 2.0 - 1.0
    }
}

/// a + b as a sum of two numbers (Knuth), and such sums added and multiplied (Dekker): some 30 digits.
fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let rounded = sum - a;
    (sum, (a - (sum - rounded)) + (b - rounded))
}

fn add(a: (f64, f64), b: (f64, f64)) -> (f64, f64) {
    let (sum, rest) = two_sum(a.0, b.0);
    two_sum(sum, rest + (a.1 + b.1))
}

fn multiply(a: (f64, f64), b: (f64, f64)) -> (f64, f64) {
    let product = a.0 * b.0;
    two_sum(product, f64::mul_add(a.0, b.0, -product) + (a.0 * b.1 + a.1 * b.0))
}

/// Sine and cosine for |x| < 2¹⁷, by their power series on [−π/4, π/4].
fn exactly(x: f64) -> [(f64, f64); 2] {
    let n = (x * core::f64::consts::FRAC_2_PI).round();
    // π/2 to 159 binary digits.
    let quarter_turn = [core::f64::consts::FRAC_PI_2, 6.123_233_995_736_766e-17, -1.497_384_904_859_169_8e-33];
    let y = quarter_turn.iter().fold((x, 0.0), |y, &part| add(y, multiply((-n, 0.0), (part, 0.0))));
    let square = multiply(y, y);
    let (mut sine, mut cosine) = ((1.0, 0.0), (1.0, 0.0));
    let one_minus = |(high, low): (f64, f64)| add((1.0, 0.0), (-high, -low));
    for k in (1..=14).map(|k| 2.0 * f64::from(k)) {
        let k = 30.0 - k;
        let over = |divisor: f64| {
            let quotient = 1.0 / divisor;
            multiply(square, (quotient, f64::mul_add(-quotient, divisor, 1.0) / divisor))
        };
        sine = one_minus(multiply(over(k * (k + 1.0)), sine));
        cosine = one_minus(multiply(over(k * (k - 1.0)), cosine));
    }
    let sine = multiply(sine, y);
    let minus = |(high, low): (f64, f64)| (-high, -low);
    match (n as i64).rem_euclid(4) {
        0 => [sine, cosine],
        1 => [cosine, minus(sine)],
        2 => [minus(sine), minus(cosine)],
        _ => [minus(cosine), sine],
    }
}

/// The distance of what was found from the exact number, in steps from its leading part to the next number.
fn ulps(found: f64, (high, low): (f64, f64)) -> f64 {
    let magnitude = high.abs();
    ((found - high) - low).abs() / (f64::from_bits(magnitude.to_bits() + 1) - magnitude)
}

/// The errors that the module states, of both reductions where they hold.
fn check(x: f64) {
    let exact = exactly(x);
    let ways = [of_small_angle::<true, f64>(x, f64::mul_add), of_small_angle::<false, f64>(x, |a, b, c| a * b + c)];
    for (fused, (sine, cosine, holds)) in [true, false].into_iter().zip(ways) {
        assert!(holds || !fused || x.abs() > LIMIT, "{x:e} goes to the library");
        let errors = [ulps(sine, exact[0]), ulps(cosine, exact[1])];
        assert!(!holds || errors.iter().all(|&error| error < 0.96), "{x:e}, fused {fused}: {errors:?} ulp");
    }
}

#[test]
fn errors_are_below_what_the_module_states() {
    let mut random = random();
    for scale in [1e-8, 1e-3, 0.5, 0.8, 2.0, 10.0, 1e3, LIMIT] {
        (0..20_000).for_each(|_| check(random() * scale));
    }
}

/// Next to multiples of π/2 nearly all digits cancel: all multiples that there are up to the limit.
#[test]
fn hard_arguments() {
    let mut n = 1.0;
    while n * core::f64::consts::FRAC_PI_2 < LIMIT {
        let x: f64 = n * core::f64::consts::FRAC_PI_2;
        for k in -1..=1 {
            let x = f64::from_bits((x.to_bits() as i64 + k) as u64);
            check(x);
            check(-x);
        }
        n += 1.0;
    }
}

/// Where the library's result is right: both are within 1 ulp of the true value.
#[test]
fn agree_with_the_library_within_an_ulp() {
    let place = |x: f64| {
        let bits = x.to_bits() as i64;
        if bits < 0 { i64::MIN - bits } else { bits }
    };
    let mut random = random();
    for scale in [1e-8, 0.5, 10.0, 1e5, 1e8] {
        for _ in 0..5_000 {
            let x = random() * scale;
            let (found, expected) = (sin_cos(x), x.sin_cos());
            let apart = [(found.0, expected.0), (found.1, expected.1)].map(|(a, b)| place(a).abs_diff(place(b)));
            assert!(apart.iter().all(|&apart| apart <= 1), "{x:e}: {found:?} {expected:?}");
        }
    }
}

/// Angles of any size, the nearest of all doubles to a multiple of π/2 among them: alone, among others, the functions one by one, in
/// single precision, and within the bounds of [`Bounded`].
#[test]
fn angles_of_any_size_are_as_exact_as_small_ones() {
    use crate::bounded::Bounded;
    use crate::simd::Lanes;

    for (x, sine, cosine) in HUGE {
        let found = sin_cos(x);
        let errors = [ulps(found.0, sine), ulps(found.1, cosine)];
        assert!(errors.iter().all(|&error| error < 0.96), "{x:e}: {errors:?} ulp");
        assert_eq!((Real::sin(x), Real::cos(x)), found);
        let (sines, cosines) = Real::sin_cos(Lanes([x, 0.0, -x, x]));
        assert_eq!((sines.0, cosines.0), ([found.0, 0.0, -found.0, found.0], [found.1, 1.0, found.1, found.1]));
        let quotient = sine.0 / cosine.0;
        let rest = f64::mul_add(-quotient, cosine.0, sine.0) + sine.1 - quotient * cosine.1;
        let tangent = (quotient, rest / cosine.0);
        // Those of the sine and the cosine, and half a one.
        let off = ulps(Real::tan(x), tangent);
        assert!(off <= 2.0 * (0.96 + 0.96 + 0.5), "{x:e}: {off} ulp of {tangent:?}, {:e}", Real::tan(x));
        let bounded = Bounded::<f64>::exact(x);
        let encloses =
            |number: Bounded<f64>, (high, low): (f64, f64)| ((number.value - high) - low).abs() <= number.bound;
        assert!(encloses(Real::sin(bounded), sine) && encloses(Real::cos(bounded), cosine), "{x:e}");
        assert!(encloses(Real::tan(bounded), tangent), "{x:e}");

        let single = x as f32;
        if single.is_finite() && f64::from(single) == x {
            assert_eq!(Real::sin_cos(single), (sine.0 as f32, cosine.0 as f32));
        }
    }
}

/// An angle; its sine and its cosine, each as a double and the rest.
type Angle = (f64, (f64, f64), (f64, f64));

/// Found with 3,000 binary digits of π by Machin's formula in whole numbers, and the power series: the largest numbers,
/// such as are near multiples of π/2, some of which are small, and others at random.
#[rustfmt::skip]
const HUGE: [Angle; 48] = [
    (5.3e+255, (0.6255006192293491, 3.201304316266839e-17), (-0.7802236700739736, 3.14996087179348e-17)),
    (5.319372648326541e+255, (1.0, -1.098476220074687e-37), (-4.687165924254628e-19, 4.3720557429382733e-36)),
    (1.7976931348623157e+308, (0.004961954789184062, -2.5049377676494104e-19), (-0.9999876894265599, -2.6032890267216748e-17)),
    (8.98846567431158e+307, (0.563127779850884, -1.1428508797646435e-17), (-0.826369834614148, 4.103345667279406e-17)),
    (102943.70807283034, (-4.012922631446047e-12, 9.813262789523261e-29), (1.0, -8.051774022985933e-24)),
    (1e+22, (-0.8522008497671888, -6.7806825896773284e-18), (0.523214785395139, -4.7143201076575164e-17)),
    (3.299999965482712e+38, (0.9446873291266207, -4.8010489692454146e-17), (-0.3279723314360709, -5.2493704725520075e-18)),
    (-7.700000189499128e+21, (0.5598155028768648, -4.2358055044381276e-17), (0.8286172836350465, -2.054856105801821e-17)),
    (-1.8672952222793276e+231, (-0.8511431845649254, -5.504428110734699e-17), (0.5249335951991234, 1.3940517325202093e-17)),
    (9.196076144853033e+186, (-0.9908347500296688, -7.776425170341388e-18), (0.13507959925038165, 7.705793120210946e-18)),
    (2.1198463601524293e+236, (0.9122987313966209, 1.3828003830602428e-17), (-0.40952536513885945, -7.90185260542379e-18)),
    (2.245398024614475e+157, (0.119331101566454, 2.8181272224804878e-18), (0.9928545151224003, 1.1055706618431234e-17)),
    (7.730720527912827e+303, (-0.02368887281027077, 5.922365139794928e-19), (-0.9997193792784947, 8.310579641630732e-18)),
    (-3.3658088644510637e+243, (0.5709310445886315, -5.2909205413764695e-17), (0.8209980160298405, -4.803978514528502e-17)),
    (-1.1911518932903596e+289, (-0.2698652860225983, 2.0864828183702543e-17), (0.9628980877538086, -1.7109016494742e-17)),
    (2.00025679648882e+186, (-0.5434045775836134, 4.696190956249294e-17), (-0.8394709435478841, 2.9242429383160016e-17)),
    (-3.6007315533957684e+115, (-0.7117373884297787, -1.562528444688547e-17), (-0.7024456490798119, -1.1529953080489239e-17)),
    (2.706940168874683e+298, (-0.031293148701892884, 3.165543110754347e-18), (-0.9995102494943817, -1.3768093232591153e-17)),
    (-5.819534196565486e+42, (0.28977300581454973, -2.99290517898892e-18), (0.957095400208987, -1.3187917296027466e-17)),
    (6.792575973808307e+186, (-0.4288206812536388, 7.866243924164794e-18), (-0.9033896298547848, -4.0651326439652867e-17)),
    (8.964568160771142e+262, (-0.8819949884467801, -3.478379130690468e-17), (-0.4712587827879329, 5.23106564653743e-18)),
    (-7.923231490502255e+65, (-0.991056208684703, -2.6675812396726637e-17), (-0.13344508693654608, -9.730898649427408e-18)),
    (5.396207570439565e+289, (-0.8479775350087975, -2.7290825143929988e-18), (0.5300321689486438, -2.2685022615163438e-17)),
    (-9.527951069926188e+161, (-0.7288456423781596, 5.0174930856909357e-17), (-0.6846780481265394, -5.035664975501361e-17)),
    (-2.0700542947583113e+170, (-0.9709520291750062, -4.299501971109279e-17), (0.23927422978862092, 1.3745791449203835e-17)),
    (2.374043091025289e+128, (-0.5731770123696791, -3.985093287635823e-17), (-0.8194315788953759, -3.4409333152650854e-17)),
    (9.572963572983839e+304, (-0.7341289896444206, 2.4813442421570598e-17), (-0.6790100342142685, -3.714900770767861e-17)),
    (4.741994783643749e+36, (0.9783382188315616, 7.637325833341801e-18), (0.20701287296563833, -2.302808087979066e-18)),
    (-1.1165738191585525e+219, (-0.9323976738107665, -3.397186525276598e-17), (-0.36143405743270973, -7.62653437723073e-18)),
    (-1.2873523679313444e+34, (-0.9973200400738055, -1.2713226874260578e-17), (-0.07316240610575218, -4.460527961613505e-18)),
    (5.592851532899976e+45, (0.8338768338886532, -5.330899183406336e-17), (-0.5519505647282513, -2.4551509725753183e-17)),
    (7.990696551461226e+279, (-0.8014268513698526, 5.547333944069072e-17), (-0.5980928037549058, -1.892075961076129e-17)),
    (4.9312924432106865e+281, (0.02031052451283122, -1.4204577632193725e-18), (-0.9997937200212921, 4.2834904228744026e-17)),
    (-2.2218000775672857e+147, (-0.9922791064952796, -2.2987878417145122e-17), (0.12402489594000668, 6.821212019075047e-18)),
    (3.614624857043072e+18, (-0.6910354120503845, 1.8135805924370616e-17), (-0.7228209040228121, 2.0727251617537724e-17)),
    (5.426549916791296e+299, (0.943315756774787, -4.932868544498549e-17), (-0.33189664508761013, -2.4555840189721684e-17)),
    (3.236595822636737e+149, (-0.7656020353416846, 1.8884502695461084e-17), (-0.6433144825671734, 3.877072643381551e-17)),
    (2294921533775192.0, (-0.8358640375282216, 1.468809174220281e-17), (0.5489365270839788, 3.978555527476586e-17)),
    (-2.9788965167643784e+93, (0.9140707024997743, 2.862501662909197e-17), (0.40555486784351275, -2.130798505687094e-17)),
    (1.0773554541293187e+56, (-0.6513804597984308, -3.4686285217732845e-17), (-0.7587512745246526, 3.852616496632031e-18)),
    (core::f64::consts::FRAC_PI_2, (1.0, -1.874699728327322e-33), (6.123233995736766e-17, -1.4973849048591698e-33)),
    (core::f64::consts::PI, (1.2246467991473532e-16, -2.99476980971834e-33), (-1.0, 7.498798913309288e-33)),
    (4.71238898038469, (-1.0, 1.6872297554945898e-32), (-1.8369701987210297e-16, -7.833796929500799e-33)),
    (10.995574287564276, (-1.0, 9.186028668803878e-32), (-4.286263797015736e-16, -1.844257310064108e-33)),
    (161702.48626924705, (-1.0, 1.856691652934697e-23), (6.093753609943049e-12, 4.418544193002337e-29)),
    (308832.6950148178, (1.0, -1.0661083810098585e-22), (1.460211204593266e-11, 8.037807940552327e-28)),
    (1570796326794898.2, (0.9982021974676981, 3.7036662205572887e-17), (-0.05993640772233971, 7.042606274469506e-19)),
    (1.5707963267948966e+30, (0.8629645613304694, -5.511873301820497e-17), (0.5052644514387595, 3.506889135852921e-17)),
];

#[test]
fn odd_and_even_and_exact_where_they_can_be() {
    assert_eq!((sin_cos(0.0).0.to_bits(), sin_cos(0.0).1), (0, 1.0));
    assert_eq!(sin_cos(-0.0).0.to_bits(), (-0.0_f64).to_bits());
    for zero in [0.0, -0.0] {
        let ways =
            [of_small_angle::<true, f64>(zero, f64::mul_add), of_small_angle::<false, f64>(zero, |a, b, c| a * b + c)];
        assert!(ways.iter().all(|(sine, cosine, holds)| sine.to_bits() == zero.to_bits() && *cosine == 1.0 && *holds));
    }
    for x in [1e-300, 5e-324, 1e-9] {
        assert_eq!(sin_cos(x), (x, 1.0));
    }
    for x in [0.3, 1.7, 4.0, 1e4, 7e5] {
        let ((s, c), (t, d)) = (sin_cos(x), sin_cos(-x));
        assert_eq!((s, c), (-t, d));
    }
    for x in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        assert!(sin_cos(x).0.is_nan() && sin_cos(x).1.is_nan());
    }
}

/// Whatever their number, and also where one of them goes to the library.
#[test]
fn among_others_an_angle_gets_the_bits_that_it_gets_alone() {
    fn check<const N: usize>(numbers: &[f64]) {
        for first in 0..numbers.len() {
            let angles: [f64; N] = core::array::from_fn(|i| numbers[(first + 5 * i) % numbers.len()]);
            let (sines, cosines) = sines_and_cosines(angles, Real::fma);
            for i in 0..N {
                let (sine, cosine) = sin_cos(angles[i]);
                let same = |a: f64, b: f64| a.to_bits() == b.to_bits() || (a.is_nan() && b.is_nan());
                assert!(same(sines[i], sine) && same(cosines[i], cosine), "{} of {angles:?}", angles[i]);
            }
        }
    }
    let mut random = random();
    let mut numbers: Vec<f64> = (0..200).map(|_| random() * 20.0).collect();
    check::<4>(&numbers);
    numbers.extend([0.0, -0.0, 1e-310, core::f64::consts::PI, 1e6, -1e300, f64::NAN, f64::INFINITY]);
    check::<1>(&numbers);
    check::<2>(&numbers);
    check::<3>(&numbers);
    check::<4>(&numbers);
    check::<7>(&numbers);
    check::<8>(&numbers);
    check::<23>(&numbers);
}

/// Vectors that hold sines in one half and cosines in the other: the same operations, also where those that should be fused are not.
#[cfg(feature = "wide")]
#[test]
fn both_in_one_vector_get_the_bits_of_one_by_one() {
    use super::vectors::{halves_of_eight, halves_of_four, halves_of_two};

    let mut random = random();
    for scale in [1e-8, 1.0, 10.0, 1e5, 1e12] {
        for _ in 0..1000 {
            let angles: [f64; 4] = core::array::from_fn(|_| random() * scale);
            let (one, two) = (halves_of_two([angles[0]]), halves_of_four([angles[1], angles[2]]));
            let (sines, cosines, hold) = halves_of_eight(angles);
            let singles = angles.map(|x| of_small_angle::<true, f64>(x, Real::fma));
            assert_eq!(hold, singles.iter().all(|single| single.2));
            if hold {
                let found = [one.0[0], two.0[0], two.0[1], one.1[0], two.1[0], two.1[1]];
                assert_eq!(found, [sines[0], sines[1], sines[2], cosines[0], cosines[1], cosines[2]]);
                let expected = singles.map(|(sine, cosine, _)| [sine, cosine].map(f64::to_bits));
                assert_eq!(core::array::from_fn(|i| [sines[i], cosines[i]].map(f64::to_bits)), expected);
            }
        }
    }
}

/// In single precision they are rounded from double, within half an ulp and what the first rounding can add, 2⁻²⁹ of an ulp: every
/// 2003rd number of both signs, or all of them by
/// `LONG_RUNS=1 cargo test --release -p gauss-runtime --lib single_precision_is_rounded_once_more`.
#[test]
fn single_precision_is_rounded_once_more() {
    let stride = if std::env::var_os("LONG_RUNS").is_some() { 1 } else { 2003 };
    let mut worst = (0.0, 0.0_f32);
    for bits in (0..f32::INFINITY.to_bits()).step_by(stride) {
        let x = f32::from_bits(bits);
        let (found, exact) = (Real::sin_cos(x), f64::from(x).sin_cos());
        // Odd and even to the last bit.
        assert!(Real::sin_cos(-x) == (-found.0, found.1), "{x:e}");
        for (exact, found) in [(exact.0, found.0), (exact.1, found.1)] {
            let unit = f64::from(f32::from_bits((exact as f32).abs().to_bits() + 1)) - f64::from((exact as f32).abs());
            let error = (f64::from(found) - exact).abs() / unit;
            assert!(error <= 0.5 + 1e-8, "{x:e}: {found:e} for {exact:e}");
            worst = if error > worst.0 { (error, x) } else { worst };
        }
    }
    std::println!("worst: {} ulp, at {:e}", worst.0, worst.1);
}
