//! Studies: raw text to checked types, with every fault of a file reported at once.

mod arm;
mod build;
mod catalogue;
mod checked;
mod elements;
mod fault;
mod files;
mod joints;
mod keys;
mod load;
mod published;
mod quantity;
mod raw;
mod reader;
mod reference;
mod schema;
mod setting;
mod variant;

pub use catalogue::{Distribution, DistributionFile, Used, load_distributions};
pub use checked::{Arm, Claim, ClaimTest, InputFile, Joint, NormalLawName, Study};
pub use elements::{ElementArm, ElementStudy, Reported};
pub use fault::{Fault, Faults, Found};
pub use joints::DrawnJoints;
pub use load::{Loaded, VariantName};
pub use reference::key_reference;

#[cfg(test)]
mod tests;
