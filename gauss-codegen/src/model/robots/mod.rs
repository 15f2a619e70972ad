//! Robots from their files: `urdf = "…"` and `mjcf = "…"` become the clauses that a user would have written. What is in
//! the files is read by `gauss-robots`.
//!
//! | file | what it holds |
//! |---|---|
//! | `source` | where the file is, what is read |
//! | `names` | names of the file → identifiers |
//! | `joints` | a joint → position and rotation of its link |
//! | `clauses` | a description → clauses, before those of the struct |
//! | `drives`, `efforts`, `turning`, `ranges` | inputs; what they do; in balls and free joints; how much of it at most |
//! | `locks`, `held` | joints that are held; what follows for the rest of the file |
//! | `limits` | those of joints and tendons; dry friction of joints |
//! | `ground`, `pairs`, `touching` | planes and what touches them; links that touch each other; contacts of shapes |
//! | `constant_heights` | what stays clear of a plane, whatever moves |
//! | `laws`, `springs`, `relations` | other forces in joints; springs of all kinds; relations of links besides the tree |
//! | `inertias` | mass data that no body has |
//! | `states` | states with names, mass data for fields |

mod clauses;
mod constant_heights;
mod drives;
mod efforts;
mod ground;
mod held;
mod inertias;
mod joints;
mod laws;
mod limits;
mod locks;
mod names;
mod pairs;
mod ranges;
mod relations;
mod source;
mod springs;
mod states;
mod touching;
mod turning;

pub use clauses::compose;
