//! Tables whose points come while a program runs: they are joined, and read, by the code of those that are constants.

use alloc::vec::Vec;
use core::fmt;

use super::grid::{Joined, Weights, add_slopes, sum};
use super::spline::Node;

/// The most points of an axis that count for a number: those of a cell, and of the one before it at their common point.
const NEAR: usize = 3;

/// A function of up to three numbers by its values at the points of a grid, whose size is known at run time.
///
/// It gives what a [`Grid`](super::Grid) of the same points gives, bit by bit: beyond the grid it goes on straight
/// along each axis.
///
/// ```
/// use gauss_runtime::table::{Joined, Table};
/// let (alpha, mach) = (vec![-0.1, 0.0, 0.2], vec![0.5, 0.9]);
/// // Row by row: the last axis changes first.
/// let lift = Table::on_grid(&[&alpha, &mach], &[-0.5, -0.6, 0.0, 0.0, 1.0, 1.2], Joined::Linear)?;
/// assert_eq!(lift.at([0, 0, 0], [0.1, 0.9, 0.0]), 0.6);
/// assert_eq!(lift.at([1, 0, 0], [0.1, 0.5, 0.0]), 5.0); // by alpha
/// # Ok::<(), Vec<gauss_runtime::table::TableFault>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    /// Numbers along each axis; of fewer than three variables the last ones have one.
    axes: [Vec<f64>; 3],
    /// Values and slopes of each point, as of a `Grid`.
    points: Vec<f64>,
    kept: usize,
}

/// A fault in the numbers of a table. Axes are counted from zero.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum TableFault {
    /// There are so many axes: one, two or three are needed.
    Axes(usize),
    /// An axis has fewer than two numbers.
    Short {
        /// The axis.
        axis: usize,
        /// Count of its numbers.
        count: usize,
    },
    /// A number of an axis is not above the one before it.
    Order {
        /// The axis.
        axis: usize,
        /// The place of the number.
        place: usize,
    },
    /// A number is not finite.
    NotFinite {
        /// The axis that it is on; none: it is a value.
        axis: Option<usize>,
        /// The place of the number.
        place: usize,
        /// The number.
        value: f64,
    },
    /// There are more or fewer values than points of the grid.
    Values {
        /// Count of the points.
        expected: usize,
        /// Count of the values.
        found: usize,
    },
}

impl fmt::Display for TableFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Axes(count) => write!(f, "a table has one, two or three axes, found {count}"),
            Self::Short { axis, count } => {
                write!(f, "an axis of a table has two numbers or more, found {count} on axis {axis}")
            }
            Self::Order { axis, place } => {
                write!(f, "the numbers of an axis of a table increase, and number {place} of axis {axis} does not")
            }
            Self::NotFinite { axis: Some(axis), place, value } => {
                write!(f, "the numbers of a table are finite, and number {place} of axis {axis} is {value}")
            }
            Self::NotFinite { axis: None, place, value } => {
                write!(f, "the numbers of a table are finite, and value {place} is {value}")
            }
            Self::Values { expected, found } => {
                write!(f, "a grid of {expected} points needs as many values, found {found}")
            }
        }
    }
}

impl core::error::Error for TableFault {}

impl Table {
    /// The table through points [x, y] with increasing x.
    ///
    /// # Errors
    /// As [`on_grid`](Self::on_grid).
    pub fn through(points: &[[f64; 2]], joined: Joined) -> Result<Self, Vec<TableFault>> {
        let [x, y] = [0, 1].map(|k| points.iter().map(|point| point[k]).collect::<Vec<_>>());
        Self::on_grid(&[&x], &y, joined)
    }

    /// The table of one, two or three axes, whose values are given row by row: those along the last axis follow one
    /// another.
    ///
    /// # Errors
    /// Every fault: axes of fewer than two numbers, or of numbers that do not increase, numbers that are not finite,
    /// more or fewer values than points.
    pub fn on_grid(axes: &[&[f64]], values: &[f64], joined: Joined) -> Result<Self, Vec<TableFault>> {
        let faults = faults(axes, values);
        if !faults.is_empty() {
            return Err(faults);
        }
        let variables = axes.len();
        let kept = if joined == Joined::Linear { 1 } else { 1 << variables };
        let mut points = alloc::vec![0.0; kept * values.len()];
        points.chunks_exact_mut(kept).zip(values).for_each(|(point, value)| point[0] = *value);
        if joined != Joined::Linear {
            for (k, axis) in axes.iter().enumerate() {
                let behind = axes[k + 1..].iter().map(|axis| axis.len()).product();
                let mut nodes: Vec<Node> = axis.iter().map(|&x| Node::new([x, 0.0])).collect();
                add_slopes(&mut points, k, [behind, kept], &mut nodes, joined == Joined::Cubic);
            }
        }
        let own = |k: usize| axes.get(k).map_or_else(|| alloc::vec![0.0], |axis| axis.to_vec());
        Ok(Self { axes: core::array::from_fn(own), points, kept })
    }

    /// Number of its variables.
    pub fn variables(&self) -> usize {
        self.axes.iter().filter(|axis| axis.len() > 1).count()
    }

    /// The derivative of these orders, by each variable, at x, as [`Grid::at`](super::Grid::at) gives it; orders of
    /// zero are the value. Numbers of variables that the table does not have are left out. What is not a number gives
    /// none.
    pub fn at(&self, orders: [u8; 3], x: [f64; 3]) -> f64 {
        let own = self.variables();
        if x[..own].iter().any(|x| x.is_nan()) {
            return f64::NAN;
        }
        let weights = |k: usize| Weights::<f64, NEAR>::new(&self.axes[k], self.kept > 1, (orders[k], x[k]));
        let sizes = [self.axes[1].len(), self.axes[2].len(), self.kept];
        sum(&self.points, sizes, &weights(0), &weights(1), &weights(2))
    }
}

fn faults(axes: &[&[f64]], values: &[f64]) -> Vec<TableFault> {
    let mut faults = Vec::new();
    if !(1..=3).contains(&axes.len()) {
        faults.push(TableFault::Axes(axes.len()));
    }
    for (axis, numbers) in axes.iter().enumerate() {
        if numbers.len() < 2 {
            faults.push(TableFault::Short { axis, count: numbers.len() });
        }
        for (place, &value) in numbers.iter().enumerate() {
            if !value.is_finite() {
                faults.push(TableFault::NotFinite { axis: Some(axis), place, value });
            } else if place > 0 && value <= numbers[place - 1] {
                faults.push(TableFault::Order { axis, place });
            }
        }
    }
    let unknown = values.iter().enumerate().filter(|(_, value)| !value.is_finite());
    faults.extend(unknown.map(|(place, &value)| TableFault::NotFinite { axis: None, place, value }));
    // A product that leaves the range of numbers is no count of values either.
    let expected = axes.iter().fold(1_usize, |product, axis| product.saturating_mul(axis.len()));
    if expected != values.len() {
        faults.push(TableFault::Values { expected, found: values.len() });
    }
    faults
}

#[cfg(test)]
#[path = "at_run_time_tests.rs"]
mod tests;
