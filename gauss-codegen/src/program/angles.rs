//! Sines and cosines of several angles one after another, so that a target can compute them together.

use super::code::Code;
use super::instruction::{Instruction, Operand};

impl<S: Copy> Code<S> {
    /// The same instructions with those of sines and cosines, and whatever these wait for, at the beginning: those of
    /// angles that wait for no other sine or cosine in a row, then those that wait for them. In a row inputs come
    /// first, by their places: neighbours in memory are read as vectors. Where only one angle could be in each row, the
    /// same code.
    pub(crate) fn with_angles_together<K: Ord>(self, place: impl Fn(S) -> K) -> Self {
        let stages = self.angle_stages();
        let rows = stages.iter().flatten().max().map_or(0, |last| last + 1);
        let row = |stage: usize| (0..stages.len()).filter(|&k| stages[k] == Some(stage)).collect::<Vec<_>>();
        let rows: Vec<Vec<usize>> = (0..rows).map(row).filter(|row| row.len() > 1).collect();
        if rows.is_empty() {
            return self;
        }
        let mut order = Vec::with_capacity(stages.len());
        let mut placed = vec![false; stages.len()];
        for mut row in rows {
            row.sort_by_cached_key(|&k| match self.instructions[k] {
                Instruction::SineCosine(Operand::Input(input)) => (false, Some(place(input))),
                _ => (true, None),
            });
            let mut awaited = self.awaited(&row);
            row.iter().for_each(|&k| awaited[k] = false);
            order.extend((0..stages.len()).filter(|&k| awaited[k] && !std::mem::replace(&mut placed[k], true)));
            order.extend(row.into_iter().filter(|&k| !std::mem::replace(&mut placed[k], true)));
        }
        order.extend((0..stages.len()).filter(|&k| !placed[k]));
        self.in_order(&order).verified()
    }

    /// Number of sines and cosines that each of them waits for one after another; `None` of other instructions.
    fn angle_stages(&self) -> Vec<Option<usize>> {
        let mut waits: Vec<usize> = Vec::with_capacity(self.instructions.len());
        for instruction in &self.instructions {
            let operand = |operand: Operand<S>| match operand {
                Operand::Sine(k) | Operand::Cosine(k) => waits[k] + 1,
                Operand::Value(k) => waits[k],
                Operand::Input(_) | Operand::Number(_) => 0,
            };
            let longest = instruction.operands().map(operand).max().unwrap_or(0);
            waits.push(longest);
        }
        let pair = |instruction: &Instruction<S>| matches!(instruction, Instruction::SineCosine(_));
        self.instructions.iter().zip(waits).map(|(instruction, wait)| pair(instruction).then_some(wait)).collect()
    }

    /// Whether some of these instructions wait for each instruction; they do for themselves.
    fn awaited(&self, some: &[usize]) -> Vec<bool> {
        let mut awaited = vec![false; self.instructions.len()];
        some.iter().for_each(|&k| awaited[k] = true);
        for (k, instruction) in self.instructions.iter().enumerate().rev() {
            if awaited[k] {
                instruction.operands().filter_map(Operand::instruction).for_each(|k| awaited[k] = true);
            }
        }
        awaited
    }

    /// The same instructions in another order, given by their places in this one.
    pub(super) fn in_order(&self, order: &[usize]) -> Self {
        let mut places = vec![0; order.len()];
        order.iter().enumerate().for_each(|(place, &k)| places[k] = place);
        let moved = |operand: Operand<S>| operand.moved(|k| places[k]);
        Self {
            instructions: order.iter().map(|&k| self.instructions[k].map(moved)).collect(),
            outputs: self.outputs.iter().map(|&operand| moved(operand)).collect(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::input::Input;
    use super::*;

    fn angle(component: usize) -> Operand {
        Operand::Input(Input::Component { argument: 0, component })
    }

    fn place(input: Input) -> usize {
        match input {
            Input::Component { component, .. } | Input::Number(component) => component,
        }
    }

    /// sin(a) · cos(b + sin(c)) + sin(2 sin(a)).
    fn example() -> Code {
        use Instruction::{Add, Multiply, SineCosine};
        use Operand::{Cosine, Sine, Value};
        let instructions = vec![
            SineCosine(angle(0)),
            SineCosine(angle(2)),
            Add(angle(1), Sine(1)),
            SineCosine(Value(2)),
            Multiply(Sine(0), Cosine(3)),
            Add(Sine(0), Sine(0)),
            SineCosine(Value(5)),
            Add(Value(4), Sine(6)),
        ];
        Code { instructions, outputs: vec![Value(7)] }
    }

    #[test]
    fn angles_are_in_rows_that_wait_for_one_another() {
        let together = example().with_angles_together(place);
        let pairs: Vec<usize> = (0..together.instructions.len())
            .filter(|&k| matches!(together.instructions[k], Instruction::SineCosine(_)))
            .collect();
        // What the second row waits for stands between the two.
        assert_eq!(pairs, [0, 1, 4, 5]);
        assert_eq!(together.verify(), Ok(()));
        let value = |code: &Code| {
            code.evaluate(|input| match input {
                Input::Component { component, .. } => [0.3, 0.7, -1.1][component],
                Input::Number(_) => f64::NAN,
            })
        };
        assert_eq!(value(&together), value(&example()));
        assert_eq!(together.clone().with_angles_together(place), together);
    }

    #[test]
    fn one_angle_stays_where_it_is() {
        let instructions = vec![
            Instruction::Multiply(angle(1), angle(1)),
            Instruction::SineCosine(angle(0)),
            Instruction::Multiply(Operand::Sine(1), Operand::Value(0)),
            Instruction::SineCosine(Operand::Value(2)),
        ];
        let code = Code { instructions, outputs: vec![Operand::Cosine(3)] };
        assert_eq!(code.clone().with_angles_together(place), code);
    }
}
