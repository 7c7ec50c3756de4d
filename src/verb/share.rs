//! `--shard I/N` of verbs whose work stands in a [ledger](crate::ensemble::Ledger): one part of it, for a machine of several.

use std::path::Path;

use serde::Serialize;

use crate::ensemble::shard::Share;
use crate::terminal::answer::Answer;
use crate::terminal::failure::Failure;
use crate::terminal::output;

/// A shard that was evaluated.
#[derive(Serialize)]
struct Evaluated {
    /// Its number, from 0.
    index: u32,
    /// The number of shards.
    of: u32,
}

/// `I/N`, with I from 0.
pub(crate) fn parsed(text: &str) -> Result<Share, String> {
    let numbers = text.split_once('/').and_then(|(index, of)| Some((index.parse().ok()?, of.parse().ok()?)));
    match numbers {
        Some((index, of)) if index < of => Ok(Share { index, of }),
        _ => Err("allowed is I/N with I from 0 to N - 1, such as 3/64".to_owned()),
    }
}

/// Tells at every tenth how much of a study is done.
pub(crate) fn progress(study: &str, what: &'static str) -> impl Fn(usize, usize) + Sync {
    let study = study.to_owned();
    move |done, all| {
        if 10 * done / all > 10 * (done - 1) / all {
            output::note(&format!("{study}: {done}/{all} {what} done"));
        }
    }
}

/// What is said of a shard that was evaluated.
pub(crate) fn answer(share: Share, out: &Path) -> Result<Answer, Failure> {
    let Share { index, of } = share;
    let text = format!(
        "shard {index} of {of} is evaluated, in {}\nwhen all are, the same command without --shard answers\n",
        out.display()
    );
    Ok(Answer::of(text, &Evaluated { index, of })?.in_place(out))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_shard_is_one_of_so_many() {
        assert_eq!(parsed("3/64"), Ok(Share { index: 3, of: 64 }));
        for text in ["3", "3/3", "-1/4", "1/0", "a/b", "1/2/3"] {
            assert!(parsed(text).is_err(), "{text}");
        }
    }
}
