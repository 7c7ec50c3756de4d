//! The text of a file that may be anything.

use std::fs::File;
use std::io::Read;
use std::path::Path;

use crate::motion::BadRecord;

/// Largest file that is read (bytes): some three million values.
const LARGEST_FILE: u64 = 64 << 20;
/// Bytes at the beginning in which it is seen that a file is no text.
const LOOKED_AT: usize = 8192;

/// The text of a file. Letters that are not UTF-8, as old headers have them, are replaced: numbers have none.
pub(super) fn text(path: &Path) -> Result<String, BadRecord> {
    let mut bytes = Vec::new();
    // One byte more than allowed tells a file that is too large, also where its length cannot be asked for.
    let read = File::open(path).and_then(|file| file.take(LARGEST_FILE + 1).read_to_end(&mut bytes));
    if let Err(error) = read {
        return Err(BadRecord::at(0, format!("cannot be read: {error}"), "a file", "check the path"));
    }
    if bytes.len() as u64 > LARGEST_FILE {
        let allowed = format!("at most {} MiB", LARGEST_FILE >> 20);
        return Err(BadRecord::at(0, "the file is too large", allowed, "cut the record to its shaking"));
    }
    of_bytes(bytes)
}

/// The text that bytes are.
pub(super) fn of_bytes(bytes: Vec<u8>) -> Result<String, BadRecord> {
    let refused = |found: &str, fix: &str| Err(BadRecord::at(0, found, "plain text", fix));
    let packed: [(&[u8], &str); 3] = [(b"PK\x03\x04", "zip"), (b"\x1f\x8b", "gzip"), (b"%PDF", "PDF")];
    if let Some((_, kind)) = packed.iter().find(|(mark, _)| bytes.starts_with(mark)) {
        return refused(&format!("this is a {kind} file"), "unpack it, and name the record in it");
    }
    if bytes.starts_with(b"\xff\xfe") || bytes.starts_with(b"\xfe\xff") {
        return refused("the text is UTF-16", "save it as UTF-8");
    }
    // 26 ended files under DOS, and 12 is a new page.
    let is_text = |byte: &u8| *byte >= 32 || [b'\t', b'\n', b'\r', 12, 26].contains(byte);
    if !bytes.iter().take(LOOKED_AT).all(is_text) || bytes.contains(&0) {
        return refused("this is a binary file", "export the record as text");
    }
    Ok(String::from_utf8(bytes)
        .unwrap_or_else(|error| String::from_utf8_lossy(error.as_bytes()).into_owned()))
}
