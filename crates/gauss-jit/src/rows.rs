//! Methods of many states at once: in lanes where the back end has them, with the bits that each state gets alone.

use crate::backends::{CompiledLanes, MOST_ARGUMENTS};
use crate::error::CallError;
use crate::kernel::Method;

/// From so many rows on code in lanes is made: it takes as long as some thousand calls.
const FEWEST: usize = 4;
/// A vector that lies in one line of the cache is loaded at once.
const LINE: usize = 64;

impl Method<'_> {
    /// Number of rows that [`call_rows`](Self::call_rows) computes at once: 8 or 4 where the processor and the back end
    /// have vectors for them, 1 elsewhere.
    pub fn width(&self) -> usize {
        self.derived.lanes(self.place).map_or(1, CompiledLanes::width)
    }

    /// Calls it for many rows: each list has the numbers of its argument for all rows, one row behind the other, or
    /// those of one for all. Writes the results row after row, with the bits that [`call`](Self::call) gives each.
    ///
    /// # Errors
    /// Lists of other lengths.
    pub fn call_rows(&self, rows: usize, arguments: &[&[f64]], results: &mut [f64]) -> Result<(), CallError> {
        self.check(rows, arguments, results)?;
        let lanes = if rows < FEWEST { None } else { self.derived.lanes(self.place) };
        let mut batch = RowBatch { method: self, rows, arguments, results };
        match lanes {
            Some(lanes) if lanes.width() == 8 => batch.in_lanes::<8>(lanes),
            Some(lanes) if lanes.width() == 4 => batch.in_lanes::<4>(lanes),
            _ => (0..rows).for_each(|row| batch.alone(row)),
        }
        Ok(())
    }
}

/// Rows of numbers whose lengths were compared.
struct RowBatch<'a> {
    method: &'a Method<'a>,
    rows: usize,
    arguments: &'a [&'a [f64]],
    results: &'a mut [f64],
}

impl<'a> RowBatch<'a> {
    /// The numbers of an argument in a row.
    fn row(&self, argument: usize, row: usize) -> &'a [f64] {
        let (list, count) = (self.arguments[argument], self.method.arguments()[argument].components.len());
        if list.len() == count { list } else { &list[row * count..][..count] }
    }

    fn alone(&mut self, row: usize) {
        let mut lists: [&[f64]; MOST_ARGUMENTS] = [&[]; MOST_ARGUMENTS];
        for k in 0..self.arguments.len() {
            lists[k] = self.row(k, row);
        }
        let outputs = self.method.outputs();
        self.method.run(&lists[..self.arguments.len()], &mut self.results[row * outputs..][..outputs]);
    }

    /// All rows in lanes; what is left at the end is filled up with its last row, but for a row alone.
    fn in_lanes<const W: usize>(&mut self, lanes: &dyn CompiledLanes) {
        let counts = self.method.arguments().iter().map(|argument| argument.components.len());
        let (inputs, outputs) = (counts.sum::<usize>(), self.method.outputs());
        let (inputs, outputs_in_lanes) = (inputs * W, outputs * W);
        let mut memory = vec![0.0; inputs + outputs_in_lanes + lanes.room() + LINE / size_of::<f64>()];
        let first = memory.as_ptr().align_offset(LINE).min(LINE / size_of::<f64>());
        let (inputs, rest) = memory[first..].split_at_mut(inputs);
        let (found, room) = rest.split_at_mut(outputs_in_lanes);
        let (inputs, _) = inputs.as_chunks_mut::<W>();
        for start in (0..self.rows).step_by(W) {
            let count = W.min(self.rows - start);
            if count == 1 {
                return self.alone(start);
            }
            self.gather(start, inputs);
            let alone = lanes.run(self.method.constants, inputs.as_flattened(), found, &mut room[..lanes.room()]);
            let (vectors, _) = found.as_chunks::<W>();
            let rows = self.results[start * outputs..][..count * outputs].chunks_exact_mut(outputs.max(1));
            for (lane, row) in rows.enumerate() {
                row.iter_mut().zip(vectors).for_each(|(number, vector)| *number = vector[lane]);
            }
            for lane in (0..count).filter(|lane| alone >> lane & 1 == 1) {
                self.alone(start + lane);
            }
        }
    }

    /// Number `i` of the rows from one on becomes vector `i`. What all rows share stays where it is.
    fn gather<const W: usize>(&self, start: usize, mut inputs: &mut [[f64; W]]) {
        for argument in 0..self.arguments.len() {
            let rows: [&[f64]; W] = std::array::from_fn(|lane| self.row(argument, (start + lane).min(self.rows - 1)));
            let (own, rest) = std::mem::take(&mut inputs).split_at_mut(rows[0].len());
            inputs = rest;
            let is_shared = self.arguments[argument].len() == rows[0].len();
            if start > 0 && is_shared {
                continue;
            }
            for (i, vector) in own.iter_mut().enumerate() {
                for (number, row) in vector.iter_mut().zip(rows) {
                    *number = row[i];
                }
            }
        }
    }
}
