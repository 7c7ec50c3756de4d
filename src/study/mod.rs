//! Studies: raw text to checked types, with every fault of a file reported at once.

mod checked;

pub use checked::{Arm, Claim, ClaimTest, InputFile, Joint, Study};
