//! The text of a file, with those that it includes in their places, and where each part of it is written.

use std::ops::Range;
use std::path::{Path, PathBuf};

use super::description::At;

/// A file as it is read.
pub struct Written {
    /// As messages name it.
    pub shown: String,
    pub path: PathBuf,
    pub text: String,
}

/// A part of the whole that stands in one file.
struct Piece {
    /// In the whole.
    start: usize,
    file: usize,
    /// In that file.
    offset: usize,
}

/// One text of several files; the first is that of the clause.
pub struct Text {
    pub whole: String,
    pub files: Vec<Written>,
    pieces: Vec<Piece>,
}

impl Text {
    /// Of one file, nothing of which is in the whole yet.
    pub fn empty(main: Written) -> Text {
        Text { whole: String::new(), files: vec![main], pieces: Vec::new() }
    }

    /// Of one file, all of it.
    pub fn of(main: Written) -> Text {
        let range = 0..main.text.len();
        let mut text = Text::empty(main);
        text.put(0, range);
        text
    }

    /// Puts a part of a file to the end of the whole.
    pub fn put(&mut self, file: usize, range: Range<usize>) {
        self.pieces.push(Piece { start: self.whole.len(), file, offset: range.start });
        let Text { whole, files, .. } = self;
        whole.push_str(&files[file].text[range]);
    }

    /// Where the whole is written at an offset.
    pub fn at(&self, offset: usize) -> At {
        let after = self.pieces.partition_point(|piece| piece.start <= offset);
        match after.checked_sub(1).and_then(|index| self.pieces.get(index)) {
            Some(piece) => place(piece.file, &self.files[piece.file].text, piece.offset + offset - piece.start),
            None => At::default(),
        }
    }

    pub fn names(&self) -> Vec<String> {
        self.files.iter().map(|file| file.shown.clone()).collect()
    }

    pub fn paths(&self) -> Vec<String> {
        self.files.iter().map(|file| file.path.to_string_lossy().into_owned()).collect()
    }
}

/// Line and column of an offset, counted from one, in characters.
pub fn place(file: usize, text: &str, offset: usize) -> At {
    let before = text.get(..offset).unwrap_or(text);
    let line_start = before.rfind('\n').map_or(0, |end| end + 1);
    let count = |n: usize| u32::try_from(n + 1).unwrap_or(u32::MAX);
    At {
        file: u32::try_from(file).unwrap_or(u32::MAX),
        line: count(before.bytes().filter(|byte| *byte == b'\n').count()),
        column: count(before[line_start..].chars().count()),
    }
}

/// # Errors
/// Why there is no such text.
pub fn read(path: &Path) -> Result<String, String> {
    let bytes = std::fs::read(path).map_err(|error| format!("cannot read `{}`: {error}", path.display()))?;
    let text = String::from_utf8(bytes).map_err(|_| format!("`{}` is no text in UTF-8", path.display()))?;
    Ok(without_late_declaration(text))
}

/// Blanks in the place of a declaration that does not stand at the very beginning, as XML has it and other readers do not:
/// it says nothing that matters, and what follows keeps its lines and columns.
fn without_late_declaration(mut text: String) -> String {
    const ORDER: char = '\u{feff}';
    let start = text.len() - text.trim_start_matches(|c: char| c.is_whitespace() || c == ORDER).len();
    let late = start > 0 && text[start..].starts_with("<?xml ");
    let end = text[start..].find("?>").filter(|_| late).map(|end| start + end + 2);
    if let Some(end) = end {
        let blanks: String =
            text[..end].chars().map(|c| if matches!(c, '\r' | '\n' | ORDER) { c } else { ' ' }).collect();
        text.replace_range(..end, &blanks);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::without_late_declaration;

    #[test]
    fn declarations_after_blanks() {
        let kept = ["<?xml version=\"1.0\"?>\n<robot/>", "\n<robot/>", "\n<?xml version", "", "\u{feff}<robot/>"];
        for text in kept {
            assert_eq!(without_late_declaration(text.to_owned()), text);
        }
        for (text, expected) in [
            ("\n <?xml a=\"é\"\n?><robot/>", "\n            \n  <robot/>"),
            ("\u{feff}\r\n<?xml a?><robot/>", "\u{feff}\r\n         <robot/>"),
        ] {
            let found = without_late_declaration(text.to_owned());
            assert_eq!(found, expected);
            assert_eq!(roxmltree_reads(&found), cfg!(any(feature = "urdf", feature = "mjcf")));
        }
    }

    #[cfg(any(feature = "urdf", feature = "mjcf"))]
    fn roxmltree_reads(text: &str) -> bool {
        roxmltree::Document::parse(text).is_ok()
    }

    #[cfg(not(any(feature = "urdf", feature = "mjcf")))]
    fn roxmltree_reads(_: &str) -> bool {
        false
    }
}
