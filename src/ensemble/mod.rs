//! From a study to a table of members: plan, evaluate in parallel, record, resume.

mod added_columns;
mod built;
mod cells;
mod columns;
mod demand;
mod design;
mod draws;
mod elements;
mod enough;
mod error;
mod evaluate;
mod field;
mod files;
mod finished;
mod given;
mod journal;
mod ledger;
mod limit_analysis;
mod lines;
mod machine;
mod manifest;
mod plates;
mod progress;
mod quantity;
pub mod rare;
mod reading;
mod record;
mod run;
mod schema;
mod selection;
mod sensitivity;
pub mod shard;
mod table;
mod undecided;
mod walls;

/// What [`build`] gives.
pub use crate::generate::Generated;
/// Into so many the members of a design are shared out.
pub use crate::random::RANDOMISATIONS;
/// What is known of a parameter of a wall that is given.
pub use crate::random::{Scale, Spread};
pub use added_columns::AddedColumns;
pub use built::{Built, weight};
pub use cells::{AskedOfCells, CellRow, CellTask, check_cell, evaluate_cell, run_cells};
pub use demand::{Failing, Met};
pub use design::{Task, evaluations, is_random, plan};
pub use draws::{Draws, Evaluated, drawn};
pub use elements::{ELEMENTS_CSV, ElementRow, Timed, evaluate_element, run_elements};
pub use enough::{Look, come_to};
pub use error::{MemberFault, RunError};
pub use evaluate::{build, evaluate, solve};
pub use files::{remove_file, replace_file};
pub use finished::{finished, identity};
pub use given::{Unsure, given_points, predicted};
pub use ledger::Ledger;
pub use limit_analysis::LimitAnalysis;
pub use manifest::Manifest;
pub use plates::{
    AskedOfWalls, Judged, NoPlate, OutOfRange, Subject, Validity, WallRow, WallTask, check_plate,
    evaluate_wall, run_walls,
};
pub use progress::{Grown, Progress, Silent};
pub use quantity::{Observed, Quantity};
pub use rare::{Draw, RareWalls};
pub use reading::base_motion::ShakenRow;
pub use reading::lateral::TopStep;
pub use reading::shear::{ShearRow, ShearStep};
pub use reading::tilting::TiltingRow;
pub use reading::{Reading, StepRow};
pub use record::{Mechanism, Row};
pub use run::{Evaluations, Settings, run, run_with};
pub use schema::column_reference;
pub use selection::{Compared, Contest, Hopeless};
pub use sensitivity::{
    Evaluation, LAYOUT, SensitivityValue, SensitivityWalls, Source, Wall as SensitivityWall, base_points,
    sensitivity_table, sources, without_value,
};
pub(crate) use table::parquet;
pub use table::{Tables, tables_as_csv};
pub use undecided::UndecidedRow;
