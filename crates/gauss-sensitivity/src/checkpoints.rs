//! Which states are kept on the way back through a run.
//!
//! With s states in memory, the first one among them, l steps are taken back by the fewest steps forward in binomial
//! order (A. Griewank & A. Walther, *Algorithm 799: revolve*, ACM Transactions on Mathematical Software 26, 2000):
//! with β(s, r) = (s + r)!/(s! r!) and β(s, r − 1) < l ≤ β(s, r) no step is made more than r times, and r l − β(s + 1,
//! r − 1) are made altogether.

/// β(s, r), or what is more than any number of steps.
fn binomial(s: usize, r: usize) -> usize {
    let (few, all) = (s.min(r), s + r);
    // Each partial product is a binomial coefficient itself.
    (1..=few).try_fold(1_usize, |product, k| product.checked_mul(all - few + k).map(|n| n / k)).unwrap_or(usize::MAX)
}

/// Number of steps from the last state kept to the next one, on the way back through `steps` ≥ 2 steps with room for
/// `states` ≥ 2 of them, the last one kept among them.
pub(crate) fn split(steps: usize, states: usize) -> usize {
    let mut r = 1;
    while binomial(states, r) < steps {
        r += 1;
    }
    let most = binomial(states, r - 1);
    most.min(steps.saturating_sub(binomial(states - 1, r - 1))).clamp(1, steps - 1)
}

/// Goes back through all steps of a run, with no more than `room` ≥ 1 states kept at a time: `forward` makes the steps
/// from one number to another, `back` takes the step after a state back. Returns how many steps were made forward, and
/// the most states that were kept.
pub(crate) fn reverse<S: Copy, E>(
    start: S,
    steps: usize,
    room: usize,
    mut forward: impl FnMut(S, usize, usize) -> Result<S, E>,
    mut back: impl FnMut(S, usize) -> Result<(), E>,
) -> Result<(usize, usize), E> {
    let (mut kept, mut last) = (vec![(0, start)], steps);
    let (mut made, mut most) = (0, 1);
    while last > 0 {
        let &(at, state) = kept.last().expect("the first one stays until the end");
        let (left, free) = (last - at, room.saturating_sub(kept.len()));
        if left == 1 {
            back(state, at)?;
            last = at;
            kept.pop();
        } else if free > 0 {
            let next = at + split(left, free + 1);
            kept.push((next, forward(state, at, next)?));
            made += next - at;
            most = most.max(kept.len());
        } else {
            let before = forward(state, at, last - 1)?;
            made += left - 1;
            back(before, last - 1)?;
            last -= 1;
        }
    }
    Ok((made, most))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The order is from the last step to the first one, states are those that belong there, and the number of steps
    /// made is the least possible.
    #[test]
    fn binomial_order_makes_the_fewest_steps() {
        for steps in 1..200_usize {
            for room in 1..12 {
                let mut next = steps;
                let forward = |state: usize, from: usize, to: usize| {
                    assert!(state == from && from < to && to < steps);
                    Ok::<_, ()>(to)
                };
                let back = |state: usize, at: usize| {
                    next -= 1;
                    assert!(state == at && at == next);
                    Ok(())
                };
                let (made, most) = reverse(0, steps, room, forward, back).expect("no errors");
                assert!(next == 0 && most <= room);
                let r = (0..).find(|&r| binomial(room, r) >= steps).expect("some r");
                let least = if r == 0 { 0 } else { r * steps - binomial(room + 1, r - 1) };
                assert_eq!(made, least, "{steps} steps, {room} states");
            }
        }
    }

    #[test]
    fn large_numbers_do_not_overflow() {
        assert_eq!(binomial(3, 2), 10);
        assert_eq!(binomial(1000, 1000), usize::MAX);
        assert!((1..usize::MAX / 2).contains(&split(usize::MAX / 2, 64)));
    }
}
