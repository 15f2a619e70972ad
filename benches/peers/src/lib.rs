//! Calls what other generators and simulators make of the scenes: shared libraries that `benches/peers/install.sh`
//! compiles.
//!
//! A library is one peer compiled by one compiler, `target/peers/lib/PEER.COMPILER.so`. Each of its functions is one
//! scene, `void s1(const double *state, double *out)`; a scene that the peer cannot compute is missing.

use std::ffi::OsStr;
use std::io;
use std::mem::MaybeUninit;
use std::path::{Path, PathBuf};

use libloading::Library;

/// A scene's accelerations in C.
type Entry = unsafe extern "C" fn(*const f64, *mut f64);

/// What the functions read and write, scene by scene: what `SIZES` of `scenes.py` says.
const SIZES: [(&str, usize, usize); 26] = [
    ("s1", 13, 6),
    ("s2", 13, 6),
    ("s3", 13, 6),
    ("s4", 6, 3),
    ("s5", 4, 2),
    ("s5_jointed", 4, 2),
    ("s6", 4, 2),
    ("s7", 14, 7),
    ("s7_fingers_forward", 27, 9),
    ("s7_fingers_inverse", 27, 9),
    ("s7_fingers_linearize", 27, 9),
    ("s7_fingers_derivatives", 27, 162),
    ("s7_fingers_inverse_linearize", 27, 9),
    ("s7_fingers_inverse_derivatives", 27, 162),
    ("s8_forward", 55, 18),
    ("s8_inverse", 55, 18),
    ("s8_linearize", 55, 18),
    ("s8_derivatives", 55, 648),
    ("s8_inverse_linearize", 55, 18),
    ("s8_inverse_derivatives", 55, 648),
    ("s9_forward", 115, 38),
    ("s9_inverse", 115, 38),
    ("s9_linearize", 115, 38),
    ("s9_derivatives", 115, 2888),
    ("s9_inverse_linearize", 115, 38),
    ("s9_inverse_derivatives", 115, 2888),
];

/// One peer by one compiler.
pub struct Peer {
    /// Who made the code.
    pub name: String,
    /// Who compiled it.
    pub compiler: String,
    library: &'static Library,
}

/// Accelerations of one scene, from a state of `N` numbers to `M`.
#[derive(Clone, Copy, Debug)]
pub struct Function<const N: usize, const M: usize>(Entry);

/// Where the libraries are.
pub fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../target/peers/lib")
}

/// Every library of the folder, by name; none where there is no folder.
///
/// # Errors
/// When a library is there and cannot be loaded, say for want of one that it needs itself.
pub fn all() -> Result<Vec<Peer>, Box<dyn std::error::Error>> {
    let files = match folder().read_dir() {
        Ok(files) => files.map(|file| file.map(|file| file.path())).collect::<Result<Vec<_>, _>>()?,
        Err(error) if error.kind() == io::ErrorKind::NotFound => Vec::new(),
        Err(error) => return Err(error.into()),
    };
    let mut files: Vec<PathBuf> = files.into_iter().filter(|file| file.extension() == Some(OsStr::new("so"))).collect();
    files.sort();
    let load = |file: PathBuf| -> Result<Peer, Box<dyn std::error::Error>> {
        let stem = file.file_stem().and_then(OsStr::to_str).unwrap_or_default();
        let (name, compiler) = stem.split_once('.').ok_or_else(|| format!("{stem}: not named PEER.COMPILER"))?;
        // SAFETY: what is run on loading is what our own script compiled: constructors that fill models of the scenes.
        let library = unsafe { Library::new(&file)? };
        // Functions are called as long as the program runs.
        Ok(Peer { name: name.replace('_', " "), compiler: compiler.to_owned(), library: Box::leak(Box::new(library)) })
    };
    files.into_iter().map(load).collect()
}

impl Peer {
    /// The scene's function, if the peer has it.
    ///
    /// # Panics
    /// When `N` and `M` are not what a scene of this name reads and writes.
    pub fn function<const N: usize, const M: usize>(&self, scene: &str) -> Option<Function<N, M>> {
        assert!(SIZES.contains(&(scene, N, M)), "{scene} does not read {N} numbers and write {M}");
        // SAFETY: every function of these libraries has this signature.
        let entry = unsafe { self.library.get::<Entry>(scene) }.ok()?;
        Some(Function(*entry))
    }
}

impl<const N: usize, const M: usize> Function<N, M> {
    /// One call through a pointer, no more.
    #[inline(always)]
    pub fn call(self, state: &[f64; N]) -> [f64; M] {
        let mut out = MaybeUninit::<[f64; M]>::uninit();
        // SAFETY: the function reads `N` numbers and writes all `M`.
        unsafe {
            (self.0)(state.as_ptr(), out.as_mut_ptr().cast());
            out.assume_init()
        }
    }
}
