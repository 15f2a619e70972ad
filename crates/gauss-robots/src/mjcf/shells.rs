//! Geoms whose mass is in their surface.

use std::f64::consts::PI;

use crate::rotation::Triple;

/// The area of a shape, and its central moments by mass; `half` its length along the third axis, where its ends say it.
/// `None` of an ellipsoid, whose area is no closed form.
pub fn area_and_moments(kind: &str, size: &[f64], half: Option<f64>) -> Option<(f64, Triple)> {
    let r = *size.first()?;
    let long = || half.or(size.get(1).copied());
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
        "box" => {
            let halves = match half {
                Some(half) => [r, r, half],
                None => [r, *size.get(1)?, *size.get(2)?],
            };
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

#[cfg(test)]
mod tests {
    use super::*;

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
