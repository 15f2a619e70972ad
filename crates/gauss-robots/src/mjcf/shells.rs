//! Geoms whose mass is in their surface.

use std::f64::consts::PI;

use crate::rotation::Triple;

/// The area of a shape, and its central moments by mass; `half` its length along the third axis, where its ends say it.
pub fn area_and_moments(kind: &str, size: &[f64], half: Option<f64>) -> Option<(f64, Triple)> {
    let r = *size.first()?;
    let long = || half.or(size.get(1).copied());
    let three = || match half {
        Some(half) => Some([r, r, half]),
        None => Some([r, *size.get(1)?, *size.get(2)?]),
    };
    // Of parts with areas, the mean squares of the distances along the axes.
    let parts: Vec<(f64, Triple)> = match kind {
        "sphere" => vec![(4.0 * PI * r * r, [r * r / 3.0; 3])],
        "capsule" => {
            let h = long()?;
            // The centre of a half sphere is r/2 from that of the ball.
            let cap = [r * r / 3.0, r * r / 3.0, r * r / 3.0 + h * r + h * h];
            vec![tube(r, h), (4.0 * PI * r * r, cap)]
        }
        "cylinder" => {
            let h = long()?;
            vec![tube(r, h), (2.0 * PI * r * r, [r * r / 4.0, r * r / 4.0, h * h])]
        }
        "ellipsoid" => {
            vec![ellipsoid(three()?)?]
        }
        "box" => {
            let halves = three()?;
            // Two faces across each axis.
            let faces = |k: usize| {
                let square = |i: usize| halves[i] * halves[i] / if i == k { 1.0 } else { 3.0 };
                (8.0 * halves[(k + 1) % 3] * halves[(k + 2) % 3], std::array::from_fn(square))
            };
            (0..3).map(faces).collect()
        }
        _ => return None,
    };
    let area: f64 = parts.iter().map(|(area, _)| area).sum();
    let mean = |i: usize| parts.iter().map(|(area, squares)| area * squares[i]).sum::<f64>() / area;
    Some((area, std::array::from_fn(|i| mean((i + 1) % 3) + mean((i + 2) % 3))))
}

/// Without its ends.
fn tube(r: f64, h: f64) -> (f64, Triple) {
    (4.0 * PI * r * h, [r * r / 2.0, r * r / 2.0, h * h / 3.0])
}

/// The area of an ellipsoid, and the mean squares of the distances along its semi-axes; `None` where one is zero.
///
/// With x = a n, |n| = 1, it is ∫ √Q dΩ, Q = Σ g n², g the squares of b c, c a, a b. The divergence of √Q nᵢ eᵢ on the
/// sphere gives 4 ∫ nᵢ² √Q = ∫ √Q + gᵢ ∫ nᵢ²/√Q, and that of nᵢ eᵢ/√Q the last integral as 2π (R_F − gᵢ R_D/3) of
/// Carlson's integrals.
fn ellipsoid(semi_axes: Triple) -> Option<(f64, Triple)> {
    let [a, b, c] = semi_axes;
    if !(a > 0.0 && b > 0.0 && c > 0.0) {
        return None;
    }
    let g = [b * c, c * a, a * b].map(|side| side * side);
    let parts: Triple = std::array::from_fn(|i| {
        let [first, second] = carlson([g[(i + 1) % 3], g[(i + 2) % 3], g[i]]);
        2.0 * PI * g[i] * (first - g[i] * second / 3.0)
    });
    let area: f64 = parts.iter().sum();
    Some((area, std::array::from_fn(|i| semi_axes[i] * semi_axes[i] / 4.0 * (1.0 + parts[i] / area))))
}

/// Carlson's symmetric integrals R_F(x, y, z) and R_D(x, y, z) of positive numbers by duplication (B. C. Carlson,
/// Numer. Algorithms 10, 1995).
fn carlson(mut numbers: Triple) -> [f64; 2] {
    // Beyond the mean both are of second order in how far the numbers are apart.
    const NEAR: f64 = 1e-9;
    let (mut sum, mut part) = (0.0, 1.0);
    loop {
        let [x, y, z] = numbers;
        let mean = (x + y + z) / 3.0;
        if numbers.iter().all(|number| (number - mean).abs() <= NEAR * mean) {
            let weighted = (x + y + 3.0 * z) / 5.0;
            return [1.0 / mean.sqrt(), 3.0 * sum + part / (weighted * weighted.sqrt())];
        }
        let [p, q, r] = numbers.map(f64::sqrt);
        let shift = p * q + q * r + r * p;
        sum += part / (r * (z + shift));
        part /= 4.0;
        numbers = numbers.map(|number| (number + shift) / 4.0);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Beside the sum over the sphere, by midpoints in the azimuth and along the axis, which converges as the square of
    /// their distance: 1e-6 of a smooth integrand.
    #[test]
    fn ellipsoids_as_sums_over_the_sphere() {
        const N: usize = 1000;
        for semi_axes in [[0.3, 0.3, 0.3], [0.7, 0.5, 0.3], [0.3, 0.5, 0.7], [0.7, 0.3, 0.3], [0.2, 0.9, 0.9]] {
            let [a, b, c]: Triple = semi_axes;
            let (mut area, mut squares) = (0.0, [0.0; 3]);
            for (i, k) in (0..N).flat_map(|i| (0..N).map(move |k| (i, k))) {
                let height = (2 * i + 1) as f64 / N as f64 - 1.0;
                let (sin, cos) = (PI * (2 * k + 1) as f64 / N as f64).sin_cos();
                let across = (1.0 - height * height).sqrt();
                let n = [across * cos, across * sin, height];
                let [x, y, z] = [b * c * n[0], c * a * n[1], a * b * n[2]];
                let part = 4.0 * PI / (N * N) as f64 * (x * x + y * y + z * z).sqrt();
                area += part;
                squares = std::array::from_fn(|i| squares[i] + part * (semi_axes[i] * n[i]).powi(2));
            }
            let (found, means) = ellipsoid(semi_axes).unwrap();
            assert!((found / area - 1.0).abs() < 4e-6, "{semi_axes:?}: {found} {area}");
            for i in 0..3 {
                assert!((means[i] * area / squares[i] - 1.0).abs() < 4e-6, "{semi_axes:?} {i}: {means:?}");
            }
        }
    }

    /// Known in closed form are a sphere, a long and a flat one of revolution, 10⁻⁶ of their length and thickness;
    /// a flat one is a disk with two sides.
    #[test]
    fn ellipsoids_of_revolution() {
        // A dozen operations, and forty duplications whose terms fall by four.
        let near =
            |found: f64, known: f64| assert!((found / known - 1.0).abs() < 32.0 * f64::EPSILON, "{found} {known}");
        let (area, squares) = ellipsoid([0.3; 3]).unwrap();
        near(area, 4.0 * PI * 0.09);
        squares.into_iter().for_each(|square| near(square, 0.03));
        for (a, c) in [(0.3_f64, 0.7_f64), (0.3, 0.31), (1e-3, 0.7)] {
            let e = ((c - a) * (c + a)).sqrt() / c;
            near(ellipsoid([a, a, c]).unwrap().0, 2.0 * PI * a * (a + c / e * e.asin()));
        }
        let (area, [x, y, z]) = ellipsoid([0.5, 0.5, 1e-9]).unwrap();
        let disk = |found: f64, known: f64| assert!((found / known - 1.0).abs() < 1e-6, "{found} {known}");
        disk(area, 2.0 * PI * 0.25);
        [x, y].into_iter().for_each(|square| disk(square, 0.25 / 4.0));
        assert!(z <= 1e-18 && ellipsoid([0.5, 0.5, 0.0]).is_none());
    }

    /// A shell is the difference between a shape that is larger by a little and the shape, both full: the moments of
    /// volumes are other formulas.
    #[test]
    fn shells_as_differences_of_volumes() {
        let thin = 1e-5;
        let grown = |size: &[f64]| size.iter().map(|c| c + thin).collect::<Vec<_>>();
        for (kind, size) in [
            ("sphere", vec![0.3]),
            ("cylinder", vec![0.3, 0.7]),
            ("box", vec![0.3, 0.5, 0.7]),
            ("capsule", vec![0.3, 0.7]),
        ] {
            let (area, moments) = area_and_moments(kind, &size, None).unwrap();
            // The straight part of a capsule is as long as before.
            let outer = if kind == "capsule" { vec![0.3 + thin, 0.7] } else { grown(&size) };
            let of = |size: &[f64]| super::super::masses::volume_and_moments(kind, size, None).unwrap();
            let [(inner, within), (outer, whole)] = [of(&size), of(&outer)];
            // Terms of second order are as large as the thickness by the least length, 3e-5.
            assert!(((outer - inner) / thin / area - 1.0).abs() < 1e-4, "{kind}");
            for i in 0..3 {
                let moment = (outer * whole[i] - inner * within[i]) / (outer - inner);
                assert!((moment / moments[i] - 1.0).abs() < 2e-4, "{kind}: {moment} {moments:?}");
            }
        }
    }
}
