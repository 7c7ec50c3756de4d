//! Where the scatter of walls comes from.

pub(crate) mod answer;
pub(crate) mod ask;
pub(crate) mod work;

pub use answer::{
    InfluenceSummary, ShareEntry, influence_page, influence_text, influence_warnings, running,
    write_influence,
};
