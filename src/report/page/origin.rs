//! Where the results of a page come from.

use crate::report::page::table::Table;

/// How and where results were made; no result depends on it.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct PageOrigin {
    /// The command, as it was given.
    pub command: String,
    /// When it ended, in UTC.
    pub date: String,
    /// System, processor and threads.
    pub platform: String,
}

impl PageOrigin {
    /// A table of it, after what else tells the origin.
    pub fn table<'p>(&self, before: impl IntoIterator<Item = (&'p str, String)>) -> Table {
        let or_not = |text: &str| if text.is_empty() { "not recorded".to_owned() } else { text.to_owned() };
        let own = [
            ("command", or_not(&self.command)),
            ("date", or_not(&self.date)),
            ("platform", or_not(&self.platform)),
        ];
        Table::of_pairs(before.into_iter().chain(own))
    }
}
