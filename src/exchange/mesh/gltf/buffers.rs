//! The bytes of a glTF file: what follows its description, what stands in it, and the files beside it.

use std::borrow::Cow;
use std::fs::File;
use std::io::Read;
use std::path::{Component, Path, PathBuf};

use base64::Engine;
use base64::alphabet::STANDARD;
use base64::engine::{DecodePaddingMode, GeneralPurpose, GeneralPurposeConfig};
use serde_json::Value;

use crate::exchange::fault::Fault;
use crate::exchange::mesh::gltf::document::{Buffer, Document};
use crate::exchange::mesh::{AGAIN, quoted, refusal};

/// What a file of bytes begins with, and how long that beginning is: a word, the version, the length of the file.
const MAGIC: &[u8] = b"glTF";
const HEAD: usize = 12;
/// What a chunk begins with: its length and its kind.
const CHUNK: usize = 8;
/// What the address of a buffer begins with that stands in the description.
const INLINE: &str = "data:";
const WHOLE: &str = "export it as one .glb file";

/// Writes and reads bytes as letters; some programs leave out what fills up the last four.
const LETTERS: GeneralPurpose = GeneralPurpose::new(
    &STANDARD,
    GeneralPurposeConfig::new().with_decode_padding_mode(DecodePaddingMode::Indifferent),
);

/// A description, and the bytes behind it.
type Chunks<'a> = (&'a [u8], Option<&'a [u8]>);

/// The bytes of a buffer, or why they are not there.
pub(super) type Bytes<'a> = Result<Cow<'a, [u8]>, Missing>;

/// Why a buffer cannot be read, and how to mend that, which matters where a mesh uses it.
pub(super) struct Missing {
    pub found: String,
    pub fix: &'static str,
}

/// A file, taken apart.
pub(super) struct Parts<'a> {
    /// Its description.
    pub text: &'a str,
    /// The bytes behind it, of a `.glb`.
    pub bytes: Option<&'a [u8]>,
}

impl<'a> Parts<'a> {
    /// The parts of a `.glb`, or of a `.gltf`, which is all description; told apart by how they begin.
    ///
    /// # Errors
    /// A file that is cut off, of an older version, or no text.
    pub fn of(file: &'a [u8]) -> Result<Parts<'a>, Box<Fault>> {
        let (text, bytes) = if file.starts_with(MAGIC) { chunks(file)? } else { (file, None) };
        let text = text.strip_prefix(b"\xef\xbb\xbf").unwrap_or(text);
        match str::from_utf8(text) {
            Ok(text) => Ok(Parts { text, bytes }),
            Err(_) => Err(refusal("", "its description is no text", "glTF 2.0 (.glb, .gltf)", AGAIN)),
        }
    }
}

/// The description and the bytes of a `.glb`; chunks of other kinds are passed over.
fn chunks(file: &[u8]) -> Result<Chunks<'_>, Box<Fault>> {
    let number = |at: usize| file.get(at..)?.first_chunk().map(|four| u32::from_le_bytes(*four));
    let cut = |found: String| refusal("", found, "a whole .glb file", AGAIN);
    let (Some(version), Some(length)) = (number(4), number(8)) else {
        return Err(cut(format!("{} bytes", file.len())));
    };
    if version != 2 {
        return Err(refusal("", format!("it is glTF {version}"), "glTF 2.0", "export it as glTF 2.0"));
    }
    let length = length as usize;
    let Some(file) = file.get(..length) else {
        return Err(cut(format!("it says that it has {length} bytes and has {}", file.len())));
    };
    let (mut rest, mut text, mut bytes) = (file.get(HEAD..).unwrap_or(&[]), None, None);
    while let Some((head, after)) = rest.split_at_checked(CHUNK) {
        let size = u32::from_le_bytes([head[0], head[1], head[2], head[3]]) as usize;
        let Some((own, next)) = after.split_at_checked(size) else {
            return Err(cut(format!("a chunk of {size} bytes, of which {} are there", after.len())));
        };
        rest = next;
        match &head[4..] {
            b"JSON" if text.is_none() => text = Some(own),
            b"BIN\0" if bytes.is_none() => bytes = Some(own),
            _ => {}
        }
    }
    Ok((text.ok_or_else(|| cut("it has no description (a JSON chunk)".to_owned()))?, bytes))
}

/// The bytes of each buffer.
pub(super) fn buffers<'a>(document: &Document, parts: &Parts<'a>) -> Vec<Bytes<'a>> {
    let one = |(number, buffer): (usize, &Buffer)| {
        let missing = |found: String, fix| Missing { found: format!("buffer {number} {found}"), fix };
        let bytes = match (&buffer.uri, parts.bytes) {
            (Some(uri), _) => inline(uri)
                .unwrap_or_else(|| Err(format!("lies in another file, {}", quoted(uri.as_bytes()))))
                .map(Cow::Owned)
                .map_err(|found| missing(found, WHOLE))?,
            (None, Some(bytes)) if number == 0 => Cow::Borrowed(bytes),
            (None, _) => return Err(missing("is nowhere".to_owned(), WHOLE)),
        };
        if (bytes.len() as u64) < buffer.byte_length {
            let found = format!("has {} of its {} bytes", bytes.len(), buffer.byte_length);
            return Err(missing(found, AGAIN));
        }
        Ok(bytes)
    };
    document.buffers.iter().enumerate().map(one).collect()
}

/// The bytes in an address that holds them itself, or why they cannot be read; `None` of the address of a file.
fn inline(uri: &str) -> Option<Result<Vec<u8>, String>> {
    let (head, letters) = uri.strip_prefix(INLINE)?.split_once(',').unwrap_or(("", ""));
    if !head.ends_with(";base64") {
        return Some(Err("is not written as base64".to_owned()));
    }
    Some(LETTERS.decode(letters).map_err(|error| format!("is no base64: {error}")))
}

/// The same file with the bytes of the files beside it in its description: whoever copies it, or asks whether it has changed, has all of it.
/// What cannot be read as a description stays as it is, and the reader tells why.
///
/// # Errors
/// A file beside it that cannot be read, or is not beside it; more than `most` bytes in all.
pub(in crate::exchange) fn with_buffers(
    path: &Path,
    file: Vec<u8>,
    most: u64,
) -> Result<Vec<u8>, Box<Fault>> {
    if file.starts_with(MAGIC) {
        return Ok(file);
    }
    let Ok(parts) = Parts::of(&file) else { return Ok(file) };
    let Ok(document) = Document::of(parts.text) else { return Ok(file) };
    let beside = |buffer: &Buffer| buffer.uri.as_ref().is_some_and(|uri| !uri.starts_with(INLINE));
    if !document.buffers.iter().any(beside) {
        return Ok(file);
    }
    let Ok(mut whole) = serde_json::from_str::<Value>(parts.text) else { return Ok(file) };
    let mut left = most.saturating_sub(file.len() as u64);
    for (number, buffer) in document.buffers.iter().enumerate().filter(|(_, buffer)| beside(buffer)) {
        let uri = buffer.uri.as_deref().unwrap_or_default();
        let name = quoted(uri.as_bytes());
        let fault =
            |found: String, allowed: String| refusal(&format!("buffer {number}"), found, allowed, WHOLE);
        let Some(own) = file_beside(path, uri) else {
            let found = format!("its bytes are at \"{name}\"");
            return Err(fault(found, "a file in the folder of the .gltf file".to_owned()));
        };
        let mut bytes = Vec::new();
        // As letters, three bytes are four.
        let read = File::open(&own).and_then(|own| own.take(left / 4 * 3 + 1).read_to_end(&mut bytes));
        if let Err(error) = read {
            let found = format!("its bytes are in the file \"{name}\", which cannot be read: {error}");
            return Err(fault(found, "a file beside the .gltf file".to_owned()));
        }
        let letters = format!("{INLINE}application/octet-stream;base64,{}", LETTERS.encode(&bytes));
        let Some(rest) = left.checked_sub(letters.len() as u64) else {
            let found = format!("with the file \"{name}\" it is too large");
            return Err(fault(found, format!("at most {} MiB in all", most >> 20)));
        };
        left = rest;
        whole["buffers"][number]["uri"] = Value::String(letters);
    }
    Ok(whole.to_string().into_bytes())
}

/// The file at an address relative to the one at `path`; `None` where it does not lie in its folder or below.
fn file_beside(path: &Path, uri: &str) -> Option<PathBuf> {
    let own = PathBuf::from(decoded(uri)?);
    let below = own.components().all(|part| matches!(part, Component::Normal(_) | Component::CurDir));
    // A colon parts the name of a protocol, or a drive, from the rest.
    (below && !uri.contains(':')).then(|| path.parent().unwrap_or(Path::new("")).join(own))
}

/// An address with its letters in place of their numbers, as a blank for `%20`.
fn decoded(uri: &str) -> Option<String> {
    let mut bytes = Vec::with_capacity(uri.len());
    let mut parts = uri.split('%');
    bytes.extend(parts.next()?.bytes());
    for part in parts {
        bytes.push(u8::from_str_radix(part.get(..2)?, 16).ok()?);
        bytes.extend(&part.as_bytes()[2..]);
    }
    String::from_utf8(bytes).ok()
}
