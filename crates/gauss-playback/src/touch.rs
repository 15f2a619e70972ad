//! States of contacts.

use serde::Serialize;

/// State of a contact at a time: the colour of its dot and of its arrow.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Touch {
    /// It is open: a grey dot where it would touch.
    Open,
    /// It is closed, without friction.
    Closed,
    /// It is closed and does not slip.
    Sticks,
    /// It is closed and slips.
    Slides,
}
