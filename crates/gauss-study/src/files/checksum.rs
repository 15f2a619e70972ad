//! A checksum of a whole file, in its end: Parquet has sums of pages, which few programs write, and none of the end.
//!
//! The sum is taken with zeros in its own place, as in the headers of networks, so that it may stand among what it
//! covers.

use std::fs;
use std::path::Path;

use bytes::Bytes;

use crate::error::StudyError;

/// Under which word a file holds its checksum.
pub const KEY: &str = "gauss_checksum";

/// Placeholder that stands there before the sum is known: `crc32:` and eight zeros.
pub const OPEN: &str = "crc32:00000000";

/// Number of digits of the sum among these.
const DIGITS: usize = 8;

/// Writes the sum of a file into its place.
pub fn close(bytes: &mut [u8]) {
    let Some(place) = place(bytes) else { return };
    let digits = format!("{:08x}", crc32fast::hash(bytes));
    bytes[place..place + DIGITS].copy_from_slice(digits.as_bytes());
}

/// The bytes of a file, if they are those that were written.
pub fn read(file: &Path) -> Result<Bytes, StudyError> {
    let bytes = fs::read(file).map_err(StudyError::io(file))?;
    if holds(&bytes) {
        return Ok(Bytes::from(bytes));
    }
    let reason = "its checksum is of other bytes: `run` makes it anew".to_owned();
    Err(StudyError::Damaged { file: file.to_owned(), reason })
}

/// Whether a file is as it was written.
fn holds(bytes: &[u8]) -> bool {
    let Some(place) = place(bytes) else { return false };
    let (before, rest) = bytes.split_at(place);
    let (digits, behind) = rest.split_at(DIGITS);
    let mut sum = crc32fast::Hasher::new();
    [before, &[b'0'; DIGITS], behind].into_iter().for_each(|piece| sum.update(piece));
    digits == format!("{:08x}", sum.finalize()).as_bytes()
}

/// Place of the digits: behind the last of the words that they follow. What stands behind them in a file, the schema
/// and the sizes of columns, is of some kilobytes.
fn place(bytes: &[u8]) -> Option<usize> {
    let word = &OPEN.as_bytes()[..OPEN.len() - DIGITS];
    let at = bytes.windows(OPEN.len()).rposition(|window| window.starts_with(word))?;
    Some(at + word.len())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_flipped_bit_is_seen() {
        let mut file = [b"PAR1 numbers ".as_slice(), OPEN.as_bytes(), b" the end PAR1"].concat();
        close(&mut file);
        assert!(holds(&file));
        for bit in 0..8 * file.len() {
            file[bit / 8] ^= 1 << (bit % 8);
            assert!(!holds(&file), "bit {bit}");
            file[bit / 8] ^= 1 << (bit % 8);
        }
        assert!(holds(&file) && !holds(b"no sum") && !holds(&file[..file.len() - 1]));
    }
}
