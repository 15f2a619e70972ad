//! The functions that the page calls. There is one leg; what they return are addresses in the memory of the module,
//! which the script reads.

use std::cell::RefCell;

#[path = "../leg.rs"]
mod leg;

use leg::{Leg, Push, WANTED, Wanted};

struct Shown {
    leg: Option<Leg>,
    wanted: Wanted,
    numbers: Vec<f64>,
    /// What went wrong last; empty: nothing.
    message: String,
}

thread_local! {
    static SHOWN: RefCell<Shown> =
        const { RefCell::new(Shown { leg: None, wanted: WANTED, numbers: Vec::new(), message: String::new() }) };
}

impl Shown {
    fn tell(&mut self, outcome: Result<(), String>) {
        self.message = outcome.err().unwrap_or_default();
        self.numbers = self.leg.as_ref().map_or(Vec::new(), Leg::numbers);
    }
}

/// Begins, or begins anew.
#[allow(unsafe_code)]
#[unsafe(no_mangle)]
pub extern "C" fn restart() {
    SHOWN.with_borrow_mut(|shown| {
        let outcome = Leg::new().map(|leg| shown.leg = Some(leg));
        shown.tell(outcome);
    });
}

/// What is wanted: m/s, m, and the coefficient of friction.
#[allow(unsafe_code)]
#[unsafe(no_mangle)]
pub extern "C" fn want(speed: f64, height: f64, friction: f64) {
    SHOWN.with_borrow_mut(|shown| shown.wanted = Wanted { speed, height, friction });
}

/// So many steps under a force, N, at a point of the hull, in its axes, m.
#[allow(unsafe_code)]
#[unsafe(no_mangle)]
pub extern "C" fn advance(steps: u32, force_x: f64, force_z: f64, at_x: f64, at_z: f64) {
    SHOWN.with_borrow_mut(|shown| {
        let push = Push { force: [force_x, force_z], at: [at_x, at_z] };
        let wanted = shown.wanted;
        let outcome = shown.leg.as_mut().map_or(Ok(()), |leg| leg.advance(steps, &wanted, &push));
        shown.tell(outcome);
    });
}

/// Where the numbers of the leg are.
#[allow(unsafe_code)]
#[unsafe(no_mangle)]
pub extern "C" fn numbers() -> *const f64 {
    SHOWN.with_borrow(|shown| shown.numbers.as_ptr())
}

/// How many there are.
#[allow(unsafe_code)]
#[unsafe(no_mangle)]
pub extern "C" fn count() -> usize {
    SHOWN.with_borrow(|shown| shown.numbers.len())
}

/// Where the bytes are that say what went wrong.
#[allow(unsafe_code)]
#[unsafe(no_mangle)]
pub extern "C" fn message() -> *const u8 {
    SHOWN.with_borrow(|shown| shown.message.as_ptr())
}

/// How many there are: none when nothing did.
#[allow(unsafe_code)]
#[unsafe(no_mangle)]
pub extern "C" fn message_length() -> usize {
    SHOWN.with_borrow(|shown| shown.message.len())
}
