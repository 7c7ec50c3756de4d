//! All walls of a study: tables, statistics, figures. Its summary is shared by the other verbs.

pub(crate) mod answer;
pub(crate) mod ask;
pub(crate) mod elements;
pub(crate) mod origin;
pub(crate) mod page;
pub(crate) mod work;

pub use answer::*;
