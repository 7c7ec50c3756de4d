//! `pirca shards status`: how far shards are.

use std::fmt::Write;

use crate::ensemble::shard;
use crate::terminal::answer::Answer;
use crate::terminal::doing::doing;
use crate::terminal::failure::Failure;
use crate::verb::shards::ask::Status as Arguments;

/// So many shards that are begun are named.
const NAMED: usize = 10;

/// Says which shards are complete, begun, missing and not to be used.
pub(crate) fn status(arguments: &Arguments) -> Result<Answer, Failure> {
    let (work, status) = doing("reading the shards", |_| shard::Status::of(&arguments.folder))?;
    let mut text = format!(
        "{}: {} of {} shards complete, {} of {} evaluations\n",
        work.manifest.study, status.complete, status.shards, status.evaluated, status.evaluations
    );
    for begun in status.begun.iter().take(NAMED) {
        let state = if begun.writing { "being computed" } else { "stopped" };
        let _ = writeln!(text, "begun: {}, {} of {} walls, {state}", begun.index, begun.walls, begun.of);
    }
    if status.begun.len() > NAMED {
        let _ = writeln!(text, "and {} more are begun", status.begun.len() - NAMED);
    }
    for (index, found) in &status.damaged {
        let _ = writeln!(text, "damaged: {index}, {found}; it is computed again");
    }
    for (index, found) in &status.foreign {
        let _ = writeln!(text, "of other work: {index}, {found}; remove it");
    }
    text += &match status.missing.is_empty() {
        true if status.foreign.is_empty() => {
            format!("nothing is missing: pirca shards merge {}\n", arguments.folder.display())
        }
        true => String::new(),
        false => format!("missing: {}\n", status.missing),
    };
    Answer::of(text, &status)
}
