//! What pages are made of that know of studies: what an answer rests on, the page of a run, the page of a wall.

mod cite;
mod closing;
mod inputs;
pub(crate) mod limits;
mod origin;
mod run;
mod strip;
mod wall;

pub use cite::{Citation, citation, citation_of_run};
pub use closing::{document_page, element_page};
pub use origin::PageOrigin;
pub use run::{DrawnWall, RunPage, called, chosen_walls, run_page};
pub use wall::{WallPage, WallTable, wall_page};
