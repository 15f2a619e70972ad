//! The functions that the browser calls. There is one motion at a time; what they return are addresses in the memory
//! of the module, which the scripts read.

use std::cell::RefCell;

use crate::live::Motion;
use crate::scenes;

#[derive(Default)]
struct Shown {
    motion: Option<Box<dyn Motion>>,
    numbers: Vec<f64>,
    /// What went wrong last; empty: nothing.
    message: String,
}

thread_local! {
    static SHOWN: RefCell<Shown> = RefCell::default();
}

fn with<T>(action: impl FnOnce(&mut Shown) -> T) -> T {
    SHOWN.with_borrow_mut(action)
}

impl Shown {
    fn act(&mut self, action: impl FnOnce(&mut dyn Motion) -> Result<(), String>) {
        let outcome = match &mut self.motion {
            Some(motion) => action(motion.as_mut()),
            None => Err("there is no scene".to_owned()),
        };
        self.message = outcome.err().unwrap_or_default();
        self.numbers = self.motion.as_ref().map_or(Vec::new(), |motion| motion.numbers());
    }
}

/// Shows a scene, by its place among all.
#[cfg_attr(target_arch = "wasm32", allow(unsafe_code), unsafe(no_mangle))]
pub extern "C" fn open(scene: usize) {
    with(|shown| match scenes::ALL.get(scene).map(|scene| (scene.open)()) {
        Some(Ok(motion)) => {
            shown.motion = Some(motion);
            shown.act(|_| Ok(()));
        }
        Some(Err(message)) => shown.message = message,
        None => shown.message = format!("there is no scene {scene}"),
    });
}

/// Begins anew.
#[cfg_attr(target_arch = "wasm32", allow(unsafe_code), unsafe(no_mangle))]
pub extern "C" fn restart() {
    with(|shown| shown.act(|motion| motion.restart()));
}

/// Moves a slider.
#[cfg_attr(target_arch = "wasm32", allow(unsafe_code), unsafe(no_mangle))]
pub extern "C" fn set(slider: usize, value: f64) {
    with(|shown| shown.act(|motion| motion.set(slider, value)));
}

/// Goes on for so many seconds.
#[cfg_attr(target_arch = "wasm32", allow(unsafe_code), unsafe(no_mangle))]
pub extern "C" fn advance(seconds: f64, tolerance: f64) {
    with(|shown| shown.act(|motion| motion.advance(seconds, tolerance)));
}

/// Where the numbers of [`Motion::numbers`] are.
#[cfg_attr(target_arch = "wasm32", allow(unsafe_code), unsafe(no_mangle))]
pub extern "C" fn numbers() -> *const f64 {
    with(|shown| shown.numbers.as_ptr())
}

/// How many there are.
#[cfg_attr(target_arch = "wasm32", allow(unsafe_code), unsafe(no_mangle))]
pub extern "C" fn count() -> usize {
    with(|shown| shown.numbers.len())
}

/// Where the bytes are that say what went wrong.
#[cfg_attr(target_arch = "wasm32", allow(unsafe_code), unsafe(no_mangle))]
pub extern "C" fn message() -> *const u8 {
    with(|shown| shown.message.as_ptr())
}

/// How many there are: none when nothing did.
#[cfg_attr(target_arch = "wasm32", allow(unsafe_code), unsafe(no_mangle))]
pub extern "C" fn message_length() -> usize {
    with(|shown| shown.message.len())
}
