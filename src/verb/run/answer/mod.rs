//! What a run says: summary, statements that were published, tables, figures, and the page that verbs share.

pub(crate) mod beside;
pub(crate) mod bounded;
pub(crate) mod by_member;
pub(crate) mod comparison;
pub(crate) mod conclusion;
pub(crate) mod csv;
pub(crate) mod demand;
pub(crate) mod drift;
pub(crate) mod element_table;
pub(crate) mod figure;
pub(crate) mod figures;
pub(crate) mod files;
pub(crate) mod force_drift;
pub(crate) mod fragility;
pub(crate) mod gathered;
pub(crate) mod measured;
pub(crate) mod page;
pub(crate) mod plot;
pub(crate) mod population;
pub(crate) mod published;
pub(crate) mod quantity;
pub(crate) mod shaken;
pub(crate) mod standing;
pub(crate) mod stated_cov;
pub(crate) mod summary;
pub(crate) mod sweep;
pub(crate) mod table;
pub(crate) mod undecided;

pub use beside::{Earlier, Mean};
pub use bounded::Bounded;
pub use comparison::{Basis, Comparison};
pub use element_table::{element_document, write_elements};
pub use files::{FRAGILITY, SUMMARY_JSON, write_all, write_gathered};
pub use gathered::Gathered;
pub use measured::{CalibrationEntry, ComparisonEntry, MeasuredSummary};
pub use page::{
    Citation, DrawnWall, PageOrigin, RunPage, WallPage, WallTable, chosen_walls, citation_of_run, run_page,
    wall_page,
};
pub use published::{Published, Verdict};
pub use shaken::{MeasureEntry, RatioEntry, RecordEntry, ShakenCurve, ShakenSummary, StripeEntry, TiltEntry};
pub use stated_cov::StatedCov;
pub use summary::{ArmSummary, EnoughEntry, QuantileEntry, Summary, summarise};
pub use table::terminal_table;
pub use undecided::{LeftOpen, LeftOpenAnswer};
