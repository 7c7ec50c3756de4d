//! How results were made: by which command, when, on what. It is kept beside the results of a run, and none depends on it.

use std::fs;
use std::num::NonZero;
use std::path::{Path, PathBuf};
use std::time::{SystemTime, UNIX_EPOCH};

use serde::{Deserialize, Serialize};

use crate::ensemble::replace_file;
use crate::terminal::failure::Failure;
use crate::terminal::session;
use crate::verb::arguments::quoted;
use crate::verb::run::answer::page::PageOrigin;

/// Its file in the output folder of a run.
const FILE: &str = "command.json";
const DAY: u64 = 86_400;

/// How results were made.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct Origin {
    /// The command, as it was given.
    pub command: String,
    /// Folder of the study.
    pub study: PathBuf,
    /// When it ended, in UTC.
    pub date: String,
    /// System, processor and threads.
    pub platform: String,
}

impl Origin {
    /// Of the command that is served, as of now, for what lies at a path and with so many threads (default: one per processor).
    pub fn now(study: &Path, threads: Option<NonZero<usize>>) -> Origin {
        let threads = threads.or_else(|| std::thread::available_parallelism().ok()).map_or(1, NonZero::get);
        let since = SystemTime::now().duration_since(UNIX_EPOCH).unwrap_or_default();
        Origin {
            command: command(session::arguments().into_iter()),
            study: study.canonicalize().unwrap_or_else(|_| study.to_path_buf()),
            date: date(since.as_secs()),
            platform: format!("{} {}, threads: {threads}", std::env::consts::OS, std::env::consts::ARCH),
        }
    }

    /// That of the run in a folder, if it is kept there.
    pub fn read(folder: &Path) -> Option<Origin> {
        serde_json::from_str(&fs::read_to_string(folder.join(FILE)).ok()?).ok()
    }

    /// Keeps it in the folder of a run.
    pub fn write(&self, folder: &Path) -> Result<(), Failure> {
        let json = serde_json::to_string_pretty(self)
            .map_err(|e| Failure::Run(format!("{FILE} cannot be written as JSON: {e}")))?;
        Ok(replace_file(&folder.join(FILE), format!("{json}\n").as_bytes())?)
    }

    /// As a page shows it.
    pub fn of_page(&self) -> PageOrigin {
        let Origin { command, date, platform, .. } = self.clone();
        PageOrigin { command, date, platform }
    }
}

/// A command line that a shell takes as these arguments.
fn command(arguments: impl Iterator<Item = String>) -> String {
    std::iter::once("pirca".to_owned())
        .chain(arguments.map(|argument| quoted(&argument)))
        .collect::<Vec<_>>()
        .join(" ")
}

/// The date and the time of so many seconds after the beginning of 1970, by the Gregorian calendar.
fn date(seconds: u64) -> String {
    let (mut days, of_day) = (seconds / DAY, seconds % DAY);
    let is_leap =
        |year: u64| year.is_multiple_of(4) && (!year.is_multiple_of(100) || year.is_multiple_of(400));
    let mut year = 1970;
    while days >= 365 + u64::from(is_leap(year)) {
        days -= 365 + u64::from(is_leap(year));
        year += 1;
    }
    let mut month = 1;
    for length in [31, 28 + u64::from(is_leap(year)), 31, 30, 31, 30, 31, 31, 30, 31, 30, 31] {
        if days < length {
            break;
        }
        days -= length;
        month += 1;
    }
    let (hour, minute) = (of_day / 3600, of_day / 60 % 60);
    format!("{year}-{month:02}-{:02} {hour:02}:{minute:02} UTC", days + 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// By `date -u -d @SECONDS`.
    #[test]
    fn dates_are_those_of_the_calendar() {
        for (seconds, wanted) in [
            (0, "1970-01-01 00:00 UTC"),
            (951_782_400, "2000-02-29 00:00 UTC"),
            (1_704_067_200, "2024-01-01 00:00 UTC"),
            (1_709_251_199, "2024-02-29 23:59 UTC"),
            (1_709_251_200, "2024-03-01 00:00 UTC"),
            (4_107_542_399, "2100-02-28 23:59 UTC"),
            (4_107_542_400, "2100-03-01 00:00 UTC"),
        ] {
            assert_eq!(date(seconds), wanted);
        }
    }

    #[test]
    fn a_command_can_be_typed_again() {
        let said = command(["run", "my wall", "--out", "it's/<b>"].map(String::from).into_iter());
        assert_eq!(said, r"pirca run 'my wall' --out 'it'\''s/<b>'");
    }
}
