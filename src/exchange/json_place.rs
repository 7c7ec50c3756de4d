//! Where in a `wall.json` the JSON itself goes wrong: line, column, and the block around it.

use crate::exchange::fault::Fault;

/// Words that other programs write for numbers that are none.
const NO_NUMBERS: [&str; 4] = ["nan", "inf", "infinity", "none"];

/// The fault that stopped the reader of JSON, with its place and the block in which it lies.
pub fn syntax_fault(text: &str, error: &serde_json::Error) -> Fault {
    let (line, column) = (error.line(), error.column());
    let offset = offset(text, line, column);
    let block = block_at(&text[..offset]);
    let word = word_at(text, offset);
    let said = error.to_string();
    let said = said.split(" at line ").next().unwrap_or(&said);
    let (found, allowed, fix) = if NO_NUMBERS
        .contains(&word.trim_start_matches(['-', '+']).to_lowercase().as_str())
    {
        (format!("{word} is no number"), "finite numbers", "find out why the program that wrote it had none")
    } else if said.contains("number out of range") {
        (format!("{word} is larger than any number"), "finite numbers", "correct the number")
    } else if error.is_eof() {
        (
            "the file ends too early: it is truncated".to_owned(),
            "a whole JSON object",
            "write or copy it again",
        )
    } else if said.starts_with("more than") {
        (said.to_owned(), "less than that", "divide or simplify the wall")
    } else {
        (format!("not what is expected: {said}"), "JSON as in `pirca analyse --help`", "correct it there")
    };
    Fault::of(&block, found, allowed, fix).at(line, column)
}

/// The byte of a line and a column in bytes, both from 1, moved down to a character's beginning.
fn offset(text: &str, line: usize, column: usize) -> usize {
    let start: usize = text.split_inclusive('\n').take(line.saturating_sub(1)).map(str::len).sum();
    let mut offset = (start + column).min(text.len());
    while !text.is_char_boundary(offset) {
        offset -= 1;
    }
    offset
}

/// The block whose braces are open at the end of a text that begins a wall: by its id if that has been seen, or else
/// by its place. Empty outside of blocks.
fn block_at(text: &str) -> String {
    let (mut depth, mut in_string, mut escaped) = (0usize, false, false);
    let (mut begun, mut start) = (0usize, 0usize);
    for (i, c) in text.bytes().enumerate() {
        match (in_string, c) {
            (true, _) if escaped => escaped = false,
            (true, b'\\') => escaped = true,
            (_, b'"') => in_string = !in_string,
            (false, b'{' | b'[') => {
                // The wall's object, the list of blocks, a block.
                if c == b'{' && depth == 2 {
                    (begun, start) = (begun + 1, i);
                }
                depth += 1;
            }
            (false, b'}' | b']') => depth = depth.saturating_sub(1),
            _ => {}
        }
    }
    if depth < 3 || begun == 0 {
        return String::new();
    }
    let id = text[start..].split_once("\"id\"").and_then(|(_, rest)| {
        let rest = rest.trim_start().strip_prefix(':')?.trim_start();
        rest.split(|c: char| !c.is_ascii_digit()).next().filter(|digits| !digits.is_empty())
    });
    id.map_or_else(|| format!("entry {} of \"blocks\"", begun - 1), |id| format!("block {id}"))
}

/// The number or word around a byte, cut after 40 letters.
fn word_at(text: &str, offset: usize) -> &str {
    let part = |c: char| c.is_ascii_alphanumeric() || "+-.".contains(c);
    let before = text[..offset].bytes().rev().take(40).take_while(|&b| part(b as char)).count();
    let after = text[offset..].bytes().take(40).take_while(|&b| part(b as char)).count();
    &text[offset - before..offset + after]
}
