//! What is done to a wall and what is observed: load path, stop rule, restraint.

mod amplified;
mod back;
mod base_motion;
mod bounds;
mod changes;
mod closing;
mod confirm;
mod crest;
mod direction;
mod drive;
mod events;
mod faces;
mod fallen;
mod kept;
mod mechanism;
mod observe;
mod pace;
mod path;
mod piles;
mod pressure;
mod pushover;
mod recorder;
mod restraint;
mod retaining;
mod rigid;
mod ropes;
mod route;
mod run;
mod settings;
mod settlement;
mod shear;
mod shove;
mod stage;
mod task;
mod tilt_heap;
mod tilting;
mod undecided;
mod watch;
mod witness;

pub use amplified::amplified;
pub use base_motion::{
    BaseMotion, Energy, Extreme, InTime, Lean, Rested, Settled, Shaken, Shaking, Verdict, shake, shake_twice,
    shake_wall,
};
pub use bounds::{Agreement, Bounds, limit_of};
pub use changes::{Changes, Creep, Loss};
pub use closing::Closing;
pub use confirm::Confirmation;
pub use crest::{OnCrest, crest_loads};
pub use direction::Direction;
pub use drive::{climb, drive, drive_seen_by};
pub use events::{Event, EventShares, Events};
pub use mechanism::{Failure, FailureMode, JointState};
pub use path::{Growing, LoadPath};
pub use piles::pile_thicknesses;
pub use pressure::{Load, back_loads, trapezoid};
pub use pushover::Pushover;
pub use recorder::Recorder;
pub use retaining::{
    Behind, Fill, Highest, Lifts, NoBack, NoFill, Retained, Retaining, WATER, Wedge, highest, left_open_at,
    raise,
};
pub use rigid::borne;
pub use ropes::ropes;
pub use run::{Way, run, run_changing, run_seen_by};
pub use settings::{
    Base, Compliance, Contacts, Ends, Lateral, Observes, Protocol, Rate, Restraint, Rope, Tilting, Turning,
};
pub use settlement::Settlement;
pub use shear::{Head, History, Shear, ShearMode, Sheared, first_at, force_at};
pub use shove::{Phase, Shove, Shoved, Stand, shove_heap, shove_wall};
pub use stage::{Stage, typical_size};
pub use task::{Platform, Run, Task};
pub use tilt_heap::{HeapStep, TiltedHeap, tilt_heap};
pub use undecided::{Lower, Undecided, undecided};
pub use watch::{Criterion, LoadStep};
pub use witness::Witness;
