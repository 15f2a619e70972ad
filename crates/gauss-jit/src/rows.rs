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

/// So many numbers in lanes stay in the nearest cache, with those of the code.
const NEAR: usize = 2048;
/// The most calls whose rows become vectors together.
const MOST_CALLS: usize = 16;

/// Calls a function for up to eight columns at a time: their number is a constant in it.
macro_rules! in_columns {
    ($function:ident($rows:ident, $count:ident, $vectors:ident)) => {
        for first in (0..$count).step_by(8) {
            let place = ($count, first);
            match $count - first {
                1 => $function::<W, 1>($rows, place, $vectors),
                2 => $function::<W, 2>($rows, place, $vectors),
                3 => $function::<W, 3>($rows, place, $vectors),
                4 => $function::<W, 4>($rows, place, $vectors),
                5 => $function::<W, 5>($rows, place, $vectors),
                6 => $function::<W, 6>($rows, place, $vectors),
                7 => $function::<W, 7>($rows, place, $vectors),
                _ => $function::<W, 8>($rows, place, $vectors),
            }
        }
    };
}

/// Rows of numbers whose lengths were compared.
struct RowBatch<'a> {
    method: &'a Method<'a>,
    rows: usize,
    arguments: &'a [&'a [f64]],
    results: &'a mut [f64],
}

impl<'a> RowBatch<'a> {
    /// Count of the numbers of an argument in a row.
    fn count(&self, argument: usize) -> usize {
        self.method.arguments()[argument].components.len()
    }

    /// The numbers of an argument in a row.
    fn row(&self, argument: usize, row: usize) -> &'a [f64] {
        let (list, count) = (self.arguments[argument], self.count(argument));
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

    /// All rows in lanes; the vectors at the end are filled up with the last row, unless that is alone.
    ///
    /// Rows of several calls become vectors before the first one: vectors that were written number by number just now
    /// are read late, and one call would wait for the other.
    fn in_lanes<const W: usize>(&mut self, lanes: &dyn CompiledLanes) {
        let inputs: usize = (0..self.arguments.len()).map(|k| self.count(k)).sum();
        let outputs = self.method.outputs();
        let calls = (NEAR / (W * (inputs + outputs)).max(1)).clamp(1, MOST_CALLS).min(self.rows.div_ceil(W));
        let sizes = [calls * inputs * W, calls * outputs * W];
        let mut memory = vec![0.0; sizes[0] + sizes[1] + lanes.room() + LINE / size_of::<f64>()];
        let first = memory.as_ptr().align_offset(LINE).min(LINE / size_of::<f64>());
        let (given, rest) = memory[first..].split_at_mut(sizes[0]);
        let (found, room) = rest.split_at_mut(sizes[1]);
        let (room, (given, _)) = (&mut room[..lanes.room()], given.as_chunks_mut::<W>());
        (0..calls).for_each(|call| self.repeat(&mut given[call * inputs..][..inputs]));
        for start in (0..self.rows).step_by(calls * W) {
            let rows = (calls * W).min(self.rows - start);
            // A row that is left over by itself has no others beside it.
            let calls = rows / W + usize::from(rows % W > 1);
            for call in 0..calls {
                self.gather(start + call * W, &mut given[call * inputs..][..inputs]);
            }
            let mut alone = [0; MOST_CALLS];
            for (call, alone) in alone[..calls].iter_mut().enumerate() {
                let (given, found) = (&given[call * inputs..][..inputs], &mut found[call * outputs * W..]);
                *alone = lanes.run(self.method.constants, given.as_flattened(), &mut found[..outputs * W], room);
            }
            for (call, alone) in alone[..calls].iter().enumerate() {
                let first = start + call * W;
                self.scatter(first, found[call * outputs * W..][..outputs * W].as_chunks::<W>().0);
                let lanes = 0..W.min(self.rows - first);
                lanes.filter(|lane| alone >> lane & 1 == 1).for_each(|lane| self.alone(first + lane));
            }
            (start + calls * W..start + rows).for_each(|row| self.alone(row));
        }
    }

    /// Fills vectors with the numbers that all rows share.
    fn repeat<const W: usize>(&self, inputs: &mut [[f64; W]]) {
        let numbers = (0..self.arguments.len()).flat_map(|argument| self.row(argument, 0));
        inputs.iter_mut().zip(numbers).for_each(|(vector, number)| *vector = [*number; W]);
    }

    /// Number `i` of the rows from one on becomes vector `i`, but for what all rows share.
    fn gather<const W: usize>(&self, start: usize, mut inputs: &mut [[f64; W]]) {
        for (argument, list) in self.arguments.iter().enumerate() {
            let count = self.count(argument);
            let (own, rest) = std::mem::take(&mut inputs).split_at_mut(count);
            inputs = rest;
            if list.len() == count {
                continue;
            }
            let (rows, filled) = (&list[start * count..], (self.rows - start).min(W));
            if filled == W {
                in_columns!(gather_columns(rows, count, own));
            } else {
                for lane in 0..W {
                    let row = &rows[lane.min(filled - 1) * count..][..count];
                    own.iter_mut().zip(row).for_each(|(vector, number)| vector[lane] = *number);
                }
            }
        }
    }

    /// The vectors become rows, as many as there are.
    fn scatter<const W: usize>(&mut self, start: usize, found: &[[f64; W]]) {
        let outputs = found.len();
        if outputs == 0 {
            return;
        }
        let (rows, filled) = (&mut self.results[start * outputs..], (self.rows - start).min(W));
        if filled == W {
            in_columns!(scatter_columns(rows, outputs, found));
        } else {
            for (lane, row) in rows.chunks_exact_mut(outputs).enumerate() {
                row.iter_mut().zip(found).for_each(|(number, vector)| *number = vector[lane]);
            }
        }
    }
}

/// Columns from one on, N of them, become vectors.
fn gather_columns<const W: usize, const N: usize>(
    rows: &[f64],
    (count, first): (usize, usize),
    vectors: &mut [[f64; W]],
) {
    let Some(vectors) = vectors[first..].first_chunk_mut::<N>() else { return };
    if let (1, Some(row)) = (count, rows.first_chunk::<W>()) {
        vectors[0] = *row;
        return;
    }
    for lane in 0..W {
        let Some(row) = rows[lane * count + first..].first_chunk::<N>() else { return };
        for i in 0..N {
            vectors[i][lane] = row[i];
        }
    }
}

/// Vectors from one on, N of them, become columns.
fn scatter_columns<const W: usize, const N: usize>(
    rows: &mut [f64],
    (count, first): (usize, usize),
    vectors: &[[f64; W]],
) {
    let Some(vectors) = vectors[first..].first_chunk::<N>() else { return };
    if let (1, Some(row)) = (count, rows.first_chunk_mut::<W>()) {
        *row = vectors[0];
        return;
    }
    for lane in 0..W {
        let Some(row) = rows[lane * count + first..].first_chunk_mut::<N>() else { return };
        for i in 0..N {
            row[i] = vectors[i][lane];
        }
    }
}
