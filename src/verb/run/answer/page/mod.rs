//! A report as a page: one HTML file that needs no network and no other file, for any browser, for the keyboard and for print.

mod answer;
mod chart;
mod cite;
mod drawing;
mod figures;
mod inputs;
pub(crate) mod limits;
mod origin;
mod run;
mod solid;
mod strip;
mod table;
mod template;
mod wall;

pub use answer::{Asked, answer_page};
pub use chart::{Axis, Chart, Line as ChartLine};
pub use cite::{Citation, citation, citation_of_run};
pub use drawing::Drawing;
pub use origin::PageOrigin;
pub use run::{DrawnWall, RunPage, chosen_walls, run_page};
pub use table::{Line, Table};
pub use template::filled;
pub use wall::{WallPage, WallTable, wall_page};

/// The style sheet of all pages.
const STYLE: &str = include_str!("style.css");
