//! The terminal: progress, messages, exit codes. It knows no verb.

pub(crate) mod answer;
pub(crate) mod doing;
pub(crate) mod failure;
pub(crate) mod output;
pub(crate) mod progress;
pub(crate) mod session;
pub(crate) mod threads;

pub use answer::Answer;
pub use failure::Failure;
pub use session::Hear;
