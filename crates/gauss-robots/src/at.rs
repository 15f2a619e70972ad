//! Places in files.

/// A place in the file, counted from one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct At {
    /// Number of the file among those that are read: 0 is that of the clause, those that it includes come after it.
    pub file: u32,
    /// From one; 0 where the whole file is meant.
    pub line: u32,
    /// In characters, from one.
    pub column: u32,
}

impl At {
    /// The line in the words of a message about another place.
    pub fn line_from(self, other: At) -> String {
        if self.file == other.file { self.line.to_string() } else { format!("{} of another file", self.line) }
    }
}
