//! Free bodies about a fixed point, moved as a whole: no forces are looked at, and a call of the motion counts as one
//! evaluation.

use std::hint::black_box;
use std::rc::Rc;

use gauss_exact::FreeMotion;
use gauss_exact::{FreeFlow, MoserVeselov};
use gauss_runtime::prelude::*;

use super::entry::{Ask, Entry, Setting, Side};
use super::scene::{Target, rows};

/// A body with principal axes e, and how it starts: attitude and angular momentum in body axes.
pub struct FreeBody {
    /// Principal moments.
    pub moments: Vector3<f64>,
    /// Of the start.
    pub attitude: UnitQuaternion<f64>,
    /// Of the start.
    pub momentum: Vector3<f64>,
    /// Where the motion ends.
    pub target: Rc<Target>,
}

/// The exact flow, and the discrete Moser–Veselov method of every order.
pub fn free_motions(entries: &mut Vec<Entry>, body: &FreeBody) {
    use Setting::{Once, Step};
    let moments: [f64; 3] = body.moments.into();
    let discrete = |order| MoserVeselov::of_order(moments, order);
    entries.extend([
        entry(body, "exact free flow", Once, FreeFlow::new(moments)),
        entry(body, "Moser–Veselov 2", Step(2), discrete(2)),
        entry(body, "Moser–Veselov 4", Step(4), discrete(4)),
        entry(body, "Moser–Veselov 6", Step(6), discrete(6)),
        entry(body, "Moser–Veselov 8", Step(8), discrete(8)),
        entry(body, "Moser–Veselov 10", Step(10), discrete(10)),
    ]);
}

fn entry<M: FreeMotion<f64> + 'static>(body: &FreeBody, method: &'static str, setting: Setting, motion: M) -> Entry {
    let &FreeBody { moments, attitude, momentum, .. } = body;
    let target = Rc::clone(&body.target);
    Entry::new((method, "body axes", "momentum"), Side::Gauss, setting, move |value, duration, mut ask| {
        // The exact flow needs steps only where its energy is to be seen on the way.
        let step = match (setting, &ask) {
            (Setting::Once, Ask::Energy(_)) => duration / 200.0,
            (Setting::Once, _) => duration,
            _ => value,
        };
        let count = (duration / step).ceil().max(1.0);
        let h = duration / count;
        let (mut q, mut y) = black_box((attitude, momentum));
        for n in 1..=count as u64 {
            let turn = motion.turn(&y, h).map_err(|kind| kind.to_string())?;
            q = (q * turn.rotation).renormalise();
            y += turn.change;
            if let Ask::Energy(see) = &mut ask {
                see(n as f64 * h, 0.5 * y.dot(&y.component_div(&moments)));
            }
        }
        if let Ask::Error(error) = ask {
            *error = target.error(&[rows(&q)]);
        }
        black_box((q, y));
        Ok(count as u64)
    })
}
