//! Power series of motions: every recurrence against steps of another method, and Taylor's method against references.

mod recurrences;
mod runs;
