//! A report as a page: one HTML file that needs no network and no other file, for any browser, for the keyboard and for print.

mod cite;
mod drawing;
mod figures;
mod inputs;
mod limits;
mod origin;
mod run;
mod solid;
mod strip;
mod table;
mod template;
mod wall;

pub use drawing::Drawing;
pub use origin::PageOrigin;
pub use run::{DrawnWall, RunPage, chosen_walls, run_page};
pub use wall::{WallPage, WallTable, wall_page};

/// The style sheet of all pages.
pub(super) const STYLE: &str = include_str!("style.css");
