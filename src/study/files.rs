//! Reading text files: existence, encoding and hash.

use std::path::Path;
use std::sync::Arc;

use sha2::{Digest, Sha256};

use crate::study::fault::{Fault, Found, Place, Source};
use crate::study::schema::nearest;

/// A text file and the hash of its bytes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TextFile {
    /// The text, for parsing and pointing.
    pub source: Arc<Source>,
    /// SHA-256 of the bytes (hex).
    pub sha256: String,
}

/// SHA-256 in hex.
pub fn sha256(bytes: &[u8]) -> String {
    Sha256::digest(bytes).iter().map(|byte| format!("{byte:02x}")).collect()
}

/// Reads a file that is shown as `name` and is meant to be `wanted` ("a text file in TOML").
///
/// # Errors
/// A fault when it is missing, a folder, unreadable, neither UTF-8 nor marked as UTF-16, or empty.
pub fn read(path: &Path, name: &str, rank: usize, wanted: &str) -> Result<TextFile, Box<Fault>> {
    let whole = |found: &str, fix: &str| Box::new(Fault::of_file(name, rank, found, wanted, fix));
    if path.is_dir() {
        return Err(whole("is a folder", "put a file there"));
    }
    let bytes = match std::fs::read(path) {
        Ok(bytes) => bytes,
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => {
            return Err(whole("does not exist", &similar(path)));
        }
        Err(error) => return Err(whole(&format!("cannot be read: {error}"), "check its permissions")),
    };
    let sha256 = sha256(&bytes);
    let text = String::from_utf8(from_utf16(&bytes).unwrap_or(bytes)).map_err(|error| {
        let valid = error.utf8_error().valid_up_to();
        let text = String::from_utf8_lossy(&error.as_bytes()[..valid]).into_owned();
        let place =
            Place { source: Arc::new(Source { name: name.to_owned(), rank, text }), span: valid..valid };
        Box::new(Fault::at(
            &place,
            "",
            Found::Words("is not UTF-8".to_owned()),
            "UTF-8 text",
            "save it as UTF-8 (spreadsheets call it CSV UTF-8)",
        ))
    })?;
    if text.trim().is_empty() {
        return Err(whole("is empty", "fill it, or take it away if it is not needed"));
    }
    Ok(TextFile { source: Arc::new(Source { name: name.to_owned(), rank, text }), sha256 })
}

/// The UTF-8 of a text that says by its byte order mark that it is UTF-16, as spreadsheets write what they call Unicode text; `None`
/// of any other, and of what is none after all.
fn from_utf16(bytes: &[u8]) -> Option<Vec<u8>> {
    let unit: fn([u8; 2]) -> u16 = match bytes.get(..2)? {
        [0xff, 0xfe] => u16::from_le_bytes,
        [0xfe, 0xff] => u16::from_be_bytes,
        _ => return None,
    };
    let (pairs, odd) = bytes[2..].as_chunks::<2>();
    let text = char::decode_utf16(pairs.iter().map(|pair| unit(*pair))).collect::<Result<String, _>>();
    text.ok().filter(|_| odd.is_empty()).map(String::into_bytes)
}

/// How to mend a path that does not exist: its nearest neighbour in the same folder.
pub fn similar(path: &Path) -> String {
    let mut names: Vec<String> = path
        .parent()
        .and_then(|folder| {
            std::fs::read_dir(if folder.as_os_str().is_empty() { Path::new(".") } else { folder }).ok()
        })
        .map(|entries| entries.flatten().map(|e| e.file_name().to_string_lossy().into_owned()).collect())
        .unwrap_or_default();
    names.sort();
    let wanted = path.file_name().map(|n| n.to_string_lossy().into_owned()).unwrap_or_default();
    match nearest(&wanted, &names) {
        Some(near) => format!("did you mean \"{near}\"?"),
        None => "check the path".to_owned(),
    }
}
