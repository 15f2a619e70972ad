//! Times of several ways to the same result, taken in turn.
//!
//! Clocks of processors change and other programs run, so one way is timed next to the other, many times, in changing
//! order, and ratios are taken of neighbours in time. What is quoted is the median; the spread is that of the middle
//! half.

use std::hint::black_box;
use std::time::Instant;

/// One way to compute something at every state of a list.
pub struct Way {
    /// What it is called in the table.
    pub name: String,
    /// Computes it `passes` times at all states.
    run: Box<dyn Fn(usize)>,
    states: usize,
}

impl Way {
    /// Calls `function`, which must not be inlined, at every state.
    pub fn new<D: 'static, S: 'static, R: 'static>(
        name: &str,
        what: D,
        states: Vec<S>,
        function: fn(&D, &S) -> R,
    ) -> Self {
        Self::calling(name, states, function, move |function, state| function(black_box(&what), state))
    }

    /// Lets `call` call `function`, of whatever kind, at every state.
    pub fn calling<F: Copy + 'static, S: 'static, R: 'static>(
        name: &str,
        states: Vec<S>,
        function: F,
        call: impl Fn(F, &S) -> R + 'static,
    ) -> Self {
        let length = states.len();
        let run = move |passes| {
            let function = black_box(function);
            for _ in 0..passes {
                for state in &states {
                    // Where it is: copied, it would be read in wider pieces than it was written in, for which
                    // processors wait.
                    black_box(&call(function, state));
                }
            }
        };
        Self { name: name.to_owned(), run: Box::new(run), states: length }
    }

    /// ns per evaluation.
    fn time(&self, passes: usize) -> f64 {
        let start = Instant::now();
        (self.run)(passes);
        start.elapsed().as_secs_f64() * 1e9 / (passes * self.states) as f64
    }
}

/// The middle of many figures, and the bounds of their middle half.
#[derive(Clone, Copy, Debug)]
pub struct Spread {
    /// A quarter is below.
    pub lower: f64,
    /// Half is below.
    pub median: f64,
    /// Three quarters are below.
    pub upper: f64,
    /// None is below.
    pub least: f64,
}

impl Spread {
    /// Of one figure at least.
    pub fn of(mut figures: Vec<f64>) -> Self {
        figures.sort_by(f64::total_cmp);
        let at = |part: f64| figures[((figures.len() - 1) as f64 * part) as usize];
        Self { lower: at(0.25), median: at(0.5), upper: at(0.75), least: at(0.0) }
    }
}

/// Times of the ways of a scene.
pub struct Times {
    /// ns per evaluation, way by way.
    pub absolute: Vec<Spread>,
    /// The first way's time over each way's.
    pub ratios: Vec<Spread>,
}

/// Times every way `rounds` times, each time for about `duration` seconds.
pub fn times(ways: &[Way], rounds: usize, duration: f64) -> Times {
    let passes: Vec<usize> = ways
        .iter()
        .map(|way| {
            way.time(200);
            let once = way.time(200) * 1e-9 * way.states as f64;
            ((duration / once) as usize).max(1)
        })
        .collect();
    let mut figures = vec![Vec::with_capacity(rounds); ways.len()];
    for round in 0..rounds {
        for k in 0..ways.len() {
            // A different one begins every time.
            let k = (k + round) % ways.len();
            figures[k].push(ways[k].time(passes[k]));
        }
    }
    let ratio = |times: &Vec<f64>| Spread::of(figures[0].iter().zip(times).map(|(a, b)| a / b).collect());
    let ratios = figures.iter().map(ratio).collect();
    Times { absolute: figures.into_iter().map(Spread::of).collect(), ratios }
}
