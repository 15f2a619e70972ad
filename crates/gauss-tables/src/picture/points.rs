//! Points of a curve: without what is not finite, and not more than can be seen.

use std::collections::HashSet;
use std::ops::Range;

/// Places along the axis at which a curve has its own points.
const PLACES: usize = 2000;

/// The pieces of a curve between numbers that cannot be drawn.
pub fn lines(x: &[f64], y: &[f64], (over, of): (Range<f64>, Range<f64>)) -> Vec<Vec<(f64, f64)>> {
    let points: Vec<(f64, f64)> = x.iter().copied().zip(y.iter().copied()).collect();
    // Ranges hold everything that can be drawn, their ends too.
    let within = |range: &Range<f64>, value: f64| range.start <= value && value <= range.end;
    let pieces = points.split(|&(x, y)| !within(&over, x) || !within(&of, y));
    pieces.filter(|piece| !piece.is_empty()).map(|piece| thinned(piece, &over)).collect()
}

/// The points that can be told apart: one of those in each cell of a grid with so many columns and rows.
pub fn cloud(x: &[f64], y: &[f64], (over, of): (Range<f64>, Range<f64>), cells: (u32, u32)) -> Vec<(f64, f64)> {
    let place = |value: f64, range: &Range<f64>, cells: u32| {
        let part = (value - range.start) / (range.end - range.start);
        // NaN is in no range.
        (0.0..=1.0).contains(&part).then(|| (part * f64::from(cells)) as u32)
    };
    let mut taken = HashSet::new();
    let mut is_new = |&(x, y): &(f64, f64)| match (place(x, &over, cells.0), place(y, &of, cells.1)) {
        (Some(column), Some(row)) => taken.insert((column, row)),
        _ => false,
    };
    x.iter().copied().zip(y.iter().copied()).filter(|point| is_new(point)).collect()
}

/// Thins points out to the first, the last, the lowest and the highest in each of many narrow strips: the same picture.
fn thinned(points: &[(f64, f64)], over: &Range<f64>) -> Vec<(f64, f64)> {
    if points.len() <= 4 * PLACES {
        return points.to_vec();
    }
    let strip = |(x, _): (f64, f64)| ((x - over.start) / (over.end - over.start) * PLACES as f64) as usize;
    let mut kept = Vec::new();
    for together in points.chunk_by(|&a, &b| strip(a) == strip(b)) {
        let by_height = |a: &usize, b: &usize| together[*a].1.total_cmp(&together[*b].1);
        let all = || 0..together.len();
        let mut chosen = vec![0, together.len() - 1];
        chosen.extend(all().min_by(by_height));
        chosen.extend(all().max_by(by_height));
        chosen.sort_unstable();
        chosen.dedup();
        kept.extend(chosen.into_iter().map(|i| together[i]));
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gaps_and_extremes() {
        let x: Vec<f64> = (0..6).map(f64::from).collect();
        let y = [1.0, 2.0, f64::NAN, 3.0, f64::INFINITY, 4.0];
        let drawn = lines(&x, &y, (0.0..5.0, 0.0..4.0));
        assert_eq!(drawn, [vec![(0.0, 1.0), (1.0, 2.0)], vec![(3.0, 3.0)], vec![(5.0, 4.0)]]);

        let x: Vec<f64> = (0..100_000).map(f64::from).collect();
        let y: Vec<f64> = (0..100_000).map(|n| if n == 54_321 { 7.0 } else { f64::from(n % 2) }).collect();
        let drawn = lines(&x, &y, (-1.0..1e5, -1.0..8.0));
        let [line] = &drawn[..] else { panic!("one piece") };
        assert!(line.len() <= 4 * PLACES + 4, "{}", line.len());
        assert!(line.contains(&(54_321.0, 7.0)) && line.is_sorted_by(|a, b| a.0 < b.0));
        assert_eq!((line[0], line[line.len() - 1]), ((0.0, 0.0), (99_999.0, 1.0)));
    }

    #[test]
    fn points_that_fall_together() {
        let (x, y) = ([0.0, 0.004, 0.5, 1.0, 1.2, 0.3], [0.0, 0.003, 0.5, 1.0, 0.5, f64::NAN]);
        let drawn = cloud(&x, &y, (0.0..1.0, 0.0..1.0), (100, 100));
        assert_eq!(drawn, [(0.0, 0.0), (0.5, 0.5), (1.0, 1.0)]);
        // However many there are.
        let x: Vec<f64> = (0..100_000).map(|n| f64::from(n) / 1e5).collect();
        let y: Vec<f64> = x.iter().map(|x| (1e4 * x).sin()).collect();
        let drawn = cloud(&x, &y, (0.0..1.0, -1.0..1.0), (40, 30));
        assert!((900..=40 * 31).contains(&drawn.len()), "{}", drawn.len());
    }
}
