//! Expansions kept from one build to the next.
//!
//! The compiler calls a macro again whenever the package of the struct is compiled, after an edit of any of its lines.
//! Where it keeps results of its own between builds (`-C incremental`, Cargo's default while one develops), the code of
//! a struct is kept beside them, and `cargo clean` removes both. Other builds neither read nor write anything.
//!
//! Code is taken from there only if all that it depends on is the same: every token of the struct, this macro (the
//! files of its library, by size and time), the flags that it reads, the package, and the content of every file that
//! the code names to the compiler, such as the file of a robot. Its tokens then have the places that they would have:
//! an error of the compiler points to the same token of the struct. Structs with mistakes are not kept.

mod store;
mod tokens;

use std::time::{Duration, SystemTime};

use proc_macro2::TokenStream;

use self::store::Store;
use self::tokens::{Places, read, text_of, written};

/// Time from which an expansion is worth keeping: reading a file is not free either.
const WORTH_KEEPING: Duration = Duration::from_millis(10);

/// The code of a struct: what was kept of an earlier build, else what `derive` makes of it.
///
/// # Errors
/// Those of `derive`.
pub fn or_derived<E>(
    input: &TokenStream,
    flags: &[u8],
    derive: impl FnOnce() -> Result<TokenStream, E>,
) -> Result<TokenStream, E> {
    let Some(store) = Store::of_this_build() else {
        return derive();
    };
    let (key, places) = ([flags, &text_of(input.clone())].concat(), Places::of(input.clone()));
    if let Some(code) = store.find(&key).and_then(|bytes| read(&bytes, &places)) {
        return Ok(code);
    }
    let begin = SystemTime::now();
    let code = derive()?;
    if begin.elapsed().is_ok_and(|elapsed| elapsed >= WORTH_KEEPING)
        && let Some(bytes) = written(code.clone(), &places)
    {
        // What cannot be written is derived again the next time.
        let _ = store.keep(&key, &bytes, &tokens::files(code.clone()), begin);
    }
    Ok(code)
}
