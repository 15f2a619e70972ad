//! Hash maps and sets for small keys. Macros run unoptimised, where the standard hasher is the slowest part of a look-up; keys
//! here are indices and short sequences of them, and nobody chooses them to collide.

/// A map with a small hash function.
pub type Map<K, V> = rustc_hash::FxHashMap<K, V>;
/// A set with the same.
pub type Set<K> = rustc_hash::FxHashSet<K>;
