//! The ball problem against its conditions.

use super::*;

#[test]
fn the_least_in_a_ball_holds_its_conditions() {
    // A spin beside tangents: entries of D differ by 10⁸, and so do those of w.
    let d = Matrix::from_fn(3, |i, j| [[3.0, 1.0, 2e-5], [1.0, 2.0, -1e-5], [2e-5, -1e-5, 1e-8]][i][j]);
    for (w, largest) in
        [([1.0, -2.0, 1e-4], 0.3), ([1e-3, 0.0, 1e-4], 2.0), ([0.0, 0.0, -1e-7], 1.0), ([0.5, 0.5, 0.0], 10.0)]
    {
        let f = least_in_ball(&d, &w, largest);
        let u: Vec<f64> = (0..3).map(|i| w[i] + dot(d.row(i), &f)).collect();
        let size: Vec<f64> =
            (0..3).map(|i| w[i].abs() + (0..3).map(|j| (d.at(i, j) * f[j]).abs()).sum::<f64>()).collect();
        assert!(norm(&f) <= largest * (1.0 + 1e-15));
        for i in 0..3 {
            // Nothing is left inside; on the sphere u is against f. Sums of four products, each with roundings of f.
            let wanted = if norm(&f) < largest * (1.0 - 1e-12) { 0.0 } else { -norm(&u) * f[i] / largest };
            assert!((u[i] - wanted).abs() <= 1e-12 * size[i].max(norm(&u)), "{w:?} {f:?} {u:?}");
        }
    }
    let zero = least_in_ball(&d, &[1.0, 2.0, 3.0], 0.0);
    assert_eq!(zero, [0.0; 3]);
}
