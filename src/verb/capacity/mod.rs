//! What walls can be relied on to bear.

pub(crate) mod answer;
pub(crate) mod ask;
pub(crate) mod rare;
pub(crate) mod work;

pub use crate::verb::question::{Answer, Question};
pub use answer::{
    CapacityGroup, CapacitySummary, Failed, Repeats, Rung, Screen, Supported, SupportedValue, Target,
    capacity_document, capacity_warnings,
};
