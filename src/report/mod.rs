//! What a reader gets: the summary, the comparison with published statements, the table on the terminal, the figure,
//! the wall for ParaView, the picture of a wall that falls. Reads rows and statistics; never computes physics.

mod advice;
mod beside;
mod bounded;
mod by_member;
mod capacity;
mod compare;
mod conclusion;
mod csv;
mod diagnosis;
mod draw;
mod drift;
mod elements;
mod extended;
mod figure;
mod files;
mod force_drift;
mod fragility;
mod gain;
mod gathered;
mod gltf;
mod homogenised;
mod influence;
mod joint_law;
mod marker;
mod markup;
mod measured;
mod number;
mod page;
mod pen;
mod picture;
mod plot;
mod population;
mod published;
mod quantity;
mod readings;
mod selection;
mod sensitivity;
mod shaken;
mod standing;
mod stated_cov;
mod summary;
mod table;
mod test_plan;
#[cfg(test)]
mod tests;
mod uncertainty;
mod undecided;
mod vtk;

pub use advice::Advice;
pub use beside::{Earlier, Mean};
pub use bounded::Bounded;
pub use capacity::{
    Answer, CapacityGroup, CapacitySummary, Failed, Question, Repeats, Rung, Screen, Supported,
    SupportedValue, Target, capacity_page, capacity_text, capacity_warnings, write_capacity,
};
pub use compare::{Basis, Comparison};
pub(crate) use csv::quoted;
pub use diagnosis::{
    DataEntry, DiagnosisPage, DiagnosisSummary, FamilyFigure, FitFigure, diagnosis_page, diagnosis_text,
    write_diagnosis,
};
pub use elements::{element_table, write_elements};
pub use extended::{EXTENDED, Origin, extended_name, remove_extended, write_extended};
pub use files::{FRAGILITY, SUMMARY_JSON, write_all, write_gathered};
pub use gain::GainSummary;
pub use gathered::Gathered;
pub use gltf::{Actor, Role, write_glb};
pub use homogenised::{
    HeldWalls, HomogenisedSummary, ModulusBounds, NestedCells, PlateArm, PlateCells, PlateUnits, PlateValue,
    SurfaceEntry, ValueBySize, WallSample, WallShare, WallsAsPlates, homogenised_summary, homogenised_text,
    write_homogenised,
};
pub use influence::{
    InfluenceSummary, ShareEntry, influence_page, influence_text, influence_warnings, running,
    write_influence,
};
pub use joint_law::{LawSummary, law_text, remove_law, write_law};
pub use measured::{CalibrationEntry, ComparisonEntry, MeasuredSummary};
pub(crate) use number::significant;
pub use page::{
    Citation, DrawnWall, PageOrigin, RunPage, WallPage, WallTable, chosen_walls, citation_of_run, run_page,
    wall_page,
};
pub use picture::{Hinge, Picture, Seam, Stage, Stone, Thrust};
pub use published::{Published, Verdict};
pub use readings::{Extent, ReadingEntry, ReadingsSummary, readings_text, write_readings};
pub use selection::{
    ArmDifference, ArmShown, SelectedArm, SelectionSummary, ShareLevels, selection_page, selection_running,
    selection_text, write_selection,
};
pub use sensitivity::{SensitivitySummary, sensitivity_text, write_sensitivity};
pub use shaken::{MeasureEntry, RatioEntry, RecordEntry, ShakenCurve, ShakenSummary, StripeEntry, TiltEntry};
pub use stated_cov::StatedCov;
pub use summary::{ArmSummary, EnoughEntry, QuantileEntry, Summary, summarise};
pub(crate) use table::aligned;
pub use table::terminal_table;
pub use test_plan::{
    Asked, Otherwise, PlannedArm, PlannedDifference, Reading, TestPlan, test_plan_text, test_plan_warnings,
    write_test_plan,
};
pub use uncertainty::{
    Answered, AskedOfWall, Ended, UncertaintySummary, uncertainty_text, write_uncertainty,
};
pub use undecided::{LeftOpen, LeftOpenAnswer};
pub use vtk::{SERIES, write_series, write_vtu};
