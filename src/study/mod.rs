//! Studies: raw text to checked types, with every fault of a file reported at once.

mod angle;
mod arm;
mod averaged;
mod bearing;
mod build;
mod built_in;
mod catalogue;
mod cause;
mod checked;
mod closing;
mod csv;
mod demand;
mod demands;
mod distributions;
mod earthquakes;
mod elements;
mod extended;
mod fault;
mod files;
mod joints;
mod json_schema;
mod keys;
mod load;
pub mod measured;
mod meetings;
mod mending;
mod nuisance;
mod overturning;
mod published;
mod pulses;
mod quantity;
mod raw;
mod reader;
mod readings;
mod reference;
mod schema;
mod setting;
mod site;
mod stated;
mod stones;
mod strength;
mod survey;
mod sweep;
mod uncertain;
mod variant;
mod wall_file;
mod with_unit;

pub use crate::random::Design;
pub use angle::Angle;
pub use bearing::Bearing;
pub use built_in::{BuiltInStudy, built_in_studies};
pub use catalogue::{Distribution, DistributionFile, Used, load_distributions, read_distributions};
pub use cause::{
    Acts, CAUSES, Cause, Described, InLimitAnalysis, Mechanisms, Meeting, OnPlate, Parameter, Stronger,
    Unloading, WIDER, described, in_plain_words,
};
pub use checked::{
    Arm, Claim, ClaimTest, InputFile, Joint, StatedLaw, Study, SweptArm, SweptValue, TakenFrom, Until,
};
pub use demand::{Amount, Demand};
pub use distributions::{Distributions, Origin, distributions_among};
pub use earthquakes::{Earthquakes, Measure, Record, Sought};
pub use elements::{ElementArm, ElementStudy, Reported};
pub use extended::{Acting, Point};
pub(crate) use fault::listed;
pub use fault::{Fault, Faults, Found};
pub(crate) use files::sha256;
pub use joints::DrawnJoints;
pub use json_schema::Schema;
pub use load::{Loaded, VariantName};
pub use measured::{
    FILE as MEASURED, MeasuredKind, MeasuredQuantity, Measurement, Template, Under, Written, template,
};
pub use meetings::{Fit, TOUCH, Tolerance, bounds, look};
pub use mending::{mended, wider};
pub use nuisance::{NUISANCES, Nuisance, nuisances};
pub use readings::{Reading, reading_name, readings};
pub use reference::key_reference;
pub use site::Site;
pub use stated::{Settings, Stated, WrittenVariant};
pub use strength::Switched;
pub use uncertain::{AsDrawn, PARAMETERS, Parameter as WallParameter, Uncertain, parameters};

#[cfg(test)]
mod tests;
