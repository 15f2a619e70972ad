//! The text of a file, with those that it includes in their places, and where each part of it is written.

use std::io::Read;
use std::ops::Range;
use std::path::{Path, PathBuf};

use super::description::At;

/// Bytes of a file, and of all that it includes.
pub const MOST_OF_TEXT: u64 = 16 << 20;

/// Nothing is defined in a file that its text is made of, and there are not more elements, texts and comments than
/// these.
pub fn options<'a>() -> roxmltree::ParsingOptions<'a> {
    roxmltree::ParsingOptions { allow_dtd: false, nodes_limit: 1_000_000, entity_resolver: None }
}

/// The mark of the order of bytes.
const ORDER: char = '\u{feff}';

/// A file as it is read.
#[derive(Clone)]
pub struct Written {
    /// As messages name it.
    pub shown: String,
    /// Path of the file.
    pub path: PathBuf,
    /// Text of the file.
    pub text: String,
    /// Range of the text that was added and does not stand in the file.
    added: Range<usize>,
    /// Places from which others are counted.
    marks: Vec<Mark>,
}

/// A place whose line and column are known.
#[derive(Clone, Copy)]
struct Mark {
    offset: usize,
    /// Counted from zero.
    line: usize,
    column: usize,
}

impl Written {
    /// # Errors
    /// Why there is no such text.
    pub fn read(shown: String, path: PathBuf) -> Result<Written, String> {
        let bytes = bytes(&path, MOST_OF_TEXT)?;
        let text = String::from_utf8(bytes).map_err(|_| format!("`{}` is no text in UTF-8", path.display()))?;
        Ok(Written::new(shown, path, without_late_declaration(text)))
    }

    /// A text that was read elsewhere.
    pub fn new(shown: String, path: PathBuf, mut text: String) -> Written {
        let added = declare_prefixes(&mut text);
        let marks = marks_of(&text);
        Written { shown, path, text, added, marks }
    }

    /// Place in the file of an offset in its text; `index` is that of the file. Lines and columns are counted from one,
    /// in characters.
    pub fn place(&self, index: usize, offset: usize) -> At {
        let (line, mut column) = self.counted(offset);
        if offset >= self.added.end && line == self.counted(self.added.end).0 {
            column = column.saturating_sub(self.added.len());
        }
        let [file, line, column] = [index, line + 1, column + 1].map(|n| u32::try_from(n).unwrap_or(u32::MAX));
        At { file, line, column }
    }

    /// Line and column of an offset, counted from zero.
    fn counted(&self, offset: usize) -> (usize, usize) {
        let before = self.marks.partition_point(|mark| mark.offset <= offset);
        let mark = self.marks[before.saturating_sub(1)];
        let rest = self.text.get(mark.offset..offset).unwrap_or(&self.text[mark.offset..]);
        (mark.line, mark.column + rest.chars().count())
    }
}

/// The beginning, those of lines, and some in between.
fn marks_of(text: &str) -> Vec<Mark> {
    /// Characters between marks of a long line.
    const APART: usize = 256;
    let mut mark = Mark { offset: 0, line: 0, column: 0 };
    let mut marks = vec![mark];
    for (offset, character) in text.char_indices() {
        mark.column += 1;
        if character == '\n' {
            (mark.line, mark.column) = (mark.line + 1, 0);
        }
        if mark.column.is_multiple_of(APART) {
            marks.push(Mark { offset: offset + character.len_utf8(), ..mark });
        }
    }
    marks
}

/// A part of the whole that stands in one file.
#[derive(Clone, Copy)]
struct Piece {
    /// In the whole.
    start: usize,
    file: usize,
    /// In that file.
    offset: usize,
    /// It is in the file as it stands; otherwise all of it has the place of that offset.
    written: bool,
}

/// One text of several files; the first is that of the clause.
#[derive(Clone, Default)]
pub struct Text {
    /// All of it.
    pub whole: String,
    /// Files that it was put together from.
    pub files: Vec<Written>,
    pieces: Vec<Piece>,
    /// The index of the first file among those of all texts that are read together.
    pub first: usize,
    /// Models that can be attached, by their names, with files of their own.
    pub models: Vec<(String, Text)>,
}

impl Text {
    /// Text of one file, nothing of which is in the whole yet.
    pub fn empty(main: Written) -> Text {
        Text { files: vec![main], ..Text::default() }
    }

    /// Text of one file, all of it.
    pub fn of(main: Written) -> Text {
        let range = 0..main.text.len();
        let mut text = Text::empty(main);
        text.put(0, range);
        text
    }

    /// Puts a part of a file to the end of the whole.
    pub fn put(&mut self, file: usize, range: Range<usize>) {
        self.pieces.push(Piece { start: self.whole.len(), file, offset: range.start, written: true });
        let Text { whole, files, .. } = self;
        whole.push_str(&files[file].text[range]);
    }

    /// The same of files that another has.
    pub fn of_files(self, other: Text) -> Text {
        Text { whole: self.whole, pieces: self.pieces, ..other }
    }

    /// Puts a part of another text of the same files to the end.
    pub fn copy(&mut self, other: &Text, range: Range<usize>) {
        let first = other.pieces.partition_point(|piece| piece.start <= range.start).saturating_sub(1);
        for (index, piece) in other.pieces.iter().enumerate().skip(first) {
            let end = other.pieces.get(index + 1).map_or(other.whole.len(), |next| next.start).min(range.end);
            let start = piece.start.max(range.start);
            if start < end {
                let offset = if piece.written { piece.offset + start - piece.start } else { piece.offset };
                self.pieces.push(Piece { start: self.whole.len(), offset, ..*piece });
                self.whole.push_str(&other.whole[start..end]);
            }
        }
    }

    /// Puts what no file has to the end; its place is that of something in another text of the same files.
    pub fn add(&mut self, text: &str, other: &Text, offset: usize) {
        let (file, offset) = other.origin(offset).unwrap_or_default();
        if !text.is_empty() {
            self.pieces.push(Piece { start: self.whole.len(), file, offset, written: false });
            self.whole.push_str(text);
        }
    }

    /// The file, and the offset in it, of an offset in the whole.
    fn origin(&self, offset: usize) -> Option<(usize, usize)> {
        let after = self.pieces.partition_point(|piece| piece.start <= offset);
        let piece = self.pieces.get(after.checked_sub(1)?)?;
        Some((piece.file, if piece.written { piece.offset + offset - piece.start } else { piece.offset }))
    }

    /// Place in a file of an offset in the whole.
    pub fn at(&self, offset: usize) -> At {
        self.origin(offset).map_or_else(At::default, |(file, offset)| self.files[file].place(self.first + file, offset))
    }

    /// Names of all files, those of models after the others.
    pub fn names(&self) -> Vec<String> {
        self.all().map(|file| file.shown.clone()).collect()
    }

    /// The paths of all files, in the same order.
    pub fn paths(&self) -> Vec<String> {
        self.all().map(|file| file.path.to_string_lossy().into_owned()).collect()
    }

    fn all(&self) -> Box<dyn Iterator<Item = &Written> + '_> {
        Box::new(self.files.iter().chain(self.models.iter().flat_map(|(_, model)| model.all())))
    }
}

/// The bytes of a regular file, to which links may lead. A device or a pipe may never end.
///
/// # Errors
/// Why they cannot be read; that there are more than `most`.
pub fn bytes(path: &Path, most: u64) -> Result<Vec<u8>, String> {
    let cannot = |why: String| format!("cannot read `{}`: {why}", path.display());
    let about = std::fs::metadata(path).map_err(|error| cannot(error.to_string()))?;
    if !about.is_file() {
        return Err(cannot("it is no regular file".to_owned()));
    }
    let file = std::fs::File::open(path).map_err(|error| cannot(error.to_string()))?;
    let mut bytes = Vec::new();
    // Some files of the system hold more bytes than their length in the metadata.
    file.take(most + 1).read_to_end(&mut bytes).map_err(|error| cannot(error.to_string()))?;
    if bytes.len() as u64 > most {
        return Err(cannot(format!("it is larger than {} MiB", most >> 20)));
    }
    Ok(bytes)
}

/// The comments and instructions before the root element, and where that starts, if there is one.
fn prolog(text: &str) -> (Vec<Range<usize>>, Option<usize>) {
    const PASSED: [(&str, &str); 2] = [("<!--", "-->"), ("<?", "?>")];
    let (mut passed, mut start) = (Vec::new(), 0);
    while let Some(blanks) = text[start..].find(|c: char| !c.is_whitespace() && c != ORDER) {
        start += blanks;
        let Some((_, close)) = PASSED.iter().find(|(open, _)| text[start..].starts_with(open)) else {
            return (passed, Some(start));
        };
        let Some(length) = text[start..].find(close) else { break };
        let end = start + length + close.len();
        passed.push(start..end);
        start = end;
    }
    (passed, None)
}

/// Blanks in the place of a declaration that does not stand at the very beginning, as XML has it and other readers do
/// not: the declaration has no effect here, and the text after it keeps its lines and columns.
fn without_late_declaration(mut text: String) -> String {
    let is_declaration = |range: &Range<usize>| text[range.clone()].starts_with("<?xml ");
    let late = prolog(&text).0.into_iter().find(is_declaration).filter(|range| range.start > 0);
    if let Some(range) = late {
        let blank = |c: char| if matches!(c, '\r' | '\n') { c } else { ' ' };
        let blanks: String = text[range.clone()].chars().map(blank).collect();
        text.replace_range(range, &blanks);
    }
    text
}

/// Declares, in the root element, the prefixes that nothing declares, such as that of `<drake:joint>`: XML asks for it,
/// readers of robots do not. What was added.
fn declare_prefixes(text: &mut String) -> Range<usize> {
    /// More than any file has; each is found by parsing once more.
    const MOST: usize = 16;
    let name_end = |text: &str| {
        let start = prolog(text).1?;
        text[start..].find(|c: char| c.is_whitespace() || matches!(c, '/' | '>')).map(|length| start + length)
    };
    let Some(start) = name_end(text) else { return 0..0 };
    let mut end = start;
    for _ in 0..MOST {
        let parsed = roxmltree::Document::parse_with_options(text, options());
        let Err(roxmltree::Error::UnknownNamespace(prefix, _)) = parsed else { break };
        let declaration = format!(" xmlns:{prefix}=\"{prefix}\"");
        text.insert_str(start, &declaration);
        end += declaration.len();
    }
    start..end
}

#[cfg(test)]
mod tests {
    use super::without_late_declaration;

    #[test]
    fn declarations_after_blanks() {
        let kept = [
            "<?xml version=\"1.0\"?>\n<robot/>",
            "\n<robot/>",
            "\n<?xml version",
            "",
            "\u{feff}<robot/>",
            "<?xml version=\"1.0\"?><!-- <?xml a?> --><robot/>",
            "<!-- never",
        ];
        for text in kept {
            assert_eq!(without_late_declaration(text.to_owned()), text);
        }
        for (text, expected) in [
            ("\n <?xml a=\"é\"\n?><robot/>", "\n            \n  <robot/>"),
            ("\u{feff}\r\n<?xml a?><robot/>", "\u{feff}\r\n         <robot/>"),
            ("<!-- é --><?xml a?><robot/>", "<!-- é -->         <robot/>"),
            ("<!-- <?xml a?> -->\n<!----> <?xml a?><robot/>", "<!-- <?xml a?> -->\n<!---->          <robot/>"),
        ] {
            let found = without_late_declaration(text.to_owned());
            assert_eq!(found, expected);
            assert!(roxmltree::Document::parse(&found).is_ok(), "{found}");
        }
    }
}
