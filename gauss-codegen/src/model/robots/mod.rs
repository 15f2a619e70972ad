//! Robots from their files: `urdf = "…"` and `mjcf = "…"` become the clauses that a user would have written.
//!
//! | file | what it holds |
//! |---|---|
//! | `description` | links and joints as plain data, whatever the format, with the places in the file |
//! | `rotation` | constant rotations, inertias in other axes |
//! | `xml`, `urdf`, `mjcf` | a format → a description |
//! | `reference`, `urdf_reference` | of every attribute what becomes of it |
//! | `structure`, `mimic` | what must hold between links and joints; what moves with what |
//! | `names` | names of the file → identifiers |
//! | `joints` | a joint → position and rotation of its link |
//! | `clauses` | a description → clauses, before those of the struct |
//! | `drives`, `efforts`, `ranges` | inputs; what they do; how much of it at most |
//! | `laws`, `springs`, `relations` | other forces in joints; springs of all kinds; relations of links besides the tree |
//! | `inertias` | mass data that no body has |
//! | `states` | states with names, mass data for fields |
//! | `mesh`, `hull` | surfaces from STL and OBJ files, and their masses; convex hulls |
//! | `source`, `text` | the file: where it is, what is read; its text, with what it includes |

mod clauses;
#[cfg_attr(not(all(feature = "urdf", feature = "mjcf")), allow(dead_code, reason = "what readers alone use"))]
mod description;
mod drives;
mod efforts;
#[cfg_attr(not(feature = "mjcf"), allow(dead_code, reason = "what readers alone use"))]
mod hull;
mod inertias;
mod joints;
mod laws;
#[cfg_attr(not(feature = "mjcf"), allow(dead_code, reason = "what readers alone use"))]
mod mesh;
mod mimic;
#[cfg(feature = "mjcf")]
mod mjcf;
mod names;
mod ranges;
#[cfg(any(feature = "urdf", feature = "mjcf"))]
mod reference;
mod relations;
#[cfg_attr(not(all(feature = "urdf", feature = "mjcf")), allow(dead_code, reason = "what readers alone use"))]
mod rotation;
mod source;
mod springs;
mod states;
mod structure;
#[cfg_attr(not(all(feature = "urdf", feature = "mjcf")), allow(dead_code, reason = "what readers alone use"))]
mod text;
#[cfg(feature = "urdf")]
mod urdf;
#[cfg(feature = "urdf")]
mod urdf_reference;
#[cfg(any(feature = "urdf", feature = "mjcf"))]
mod xml;

pub use clauses::compose;
pub use joints::exact;
