//! What the simulation gets wrong and what explains it; the bank of walls that this rests on.

pub(crate) mod advice;
pub(crate) mod answer;
pub(crate) mod ask;
pub(crate) mod bank;
pub(crate) mod extended;
pub(crate) mod gain;
pub(crate) mod joint_law;
pub(crate) mod judge;
pub(crate) mod work;

pub use advice::Advice;
pub use answer::{
    DataEntry, DiagnosisPage, DiagnosisSummary, FamilyFigure, FitFigure, diagnosis_page, diagnosis_text,
    write_diagnosis,
};
pub use extended::{EXTENDED, Origin, extended_name, remove_extended, write_extended};
pub use gain::GainSummary;
pub use joint_law::{LawSummary, law_text, remove_law, write_law};
