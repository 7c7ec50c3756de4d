//! What comes of cells: masonry as a plate, its stiffness, its surface, and what both do as cells grow.

mod csv;
mod entry;
mod plot;
mod text;
mod walls;

use std::path::Path;

use anyhow::{Context, Result};

use crate::ensemble::{AskedOfCells, CellRow, WallRow, replace_file};
use crate::render::draw::IMAGE_SCALE;
use crate::render::pen::Pen;
use crate::study::Study;
use crate::verb::homogenise::answer::csv::{cells_csv, surface_csv, timing_csv, walls_csv};
pub use crate::verb::homogenise::answer::entry::{
    HomogenisedSummary, ModulusBounds, NestedCells, PlateArm, PlateCells, PlateUnits, PlateValue,
    SurfaceEntry, ValueBySize, homogenised_summary,
};
use crate::verb::homogenise::answer::plot::{CellPlot, What};
pub use crate::verb::homogenise::answer::text::homogenised_text;
pub use crate::verb::homogenise::answer::walls::{HeldWalls, WallSample, WallShare, WallsAsPlates};
use crate::verb::run::answer::files::write_figure;

/// File names of the summary, of the cells and of their surfaces, and of the two figures without ending.
const HOMOGENISED_JSON: &str = "homogenised.json";
const CELLS_CSV: &str = "cells.csv";
const SURFACE: &str = "surface";
const SCATTER: &str = "scatter";
/// Walls beside their plates, and how long each took.
const WALLS_CSV: &str = "walls.csv";
const TIMING_CSV: &str = "timing.csv";

/// Writes the summary, the tables and the figures into an existing folder. The same study and rows give the same bytes but for
/// how long walls took.
///
/// # Errors
/// The file that could not be written, and why.
pub fn write_homogenised(
    (study, asked, rows, walls): (&Study, &AskedOfCells, &[CellRow], &[WallRow]),
    summary: &HomogenisedSummary,
    dir: &Path,
) -> Result<()> {
    let json = serde_json::to_string_pretty(summary).context("cannot write the summary")? + "\n";
    replace_file(&dir.join(HOMOGENISED_JSON), json.as_bytes())?;
    replace_file(&dir.join(CELLS_CSV), cells_csv(study, asked, rows).as_bytes())?;
    replace_file(&dir.join(format!("{SURFACE}.csv")), surface_csv(study, asked, rows).as_bytes())?;
    if !walls.is_empty() {
        replace_file(&dir.join(WALLS_CSV), walls_csv(study, walls).as_bytes())?;
        replace_file(&dir.join(TIMING_CSV), timing_csv(study, walls).as_bytes())?;
    }
    for (what, name) in [(What::Surface, SURFACE), (What::Scatter, SCATTER)] {
        let figure = |scale| CellPlot { summary, what, pen: Pen { scale } };
        if !figure(1).is_empty() {
            write_figure(dir, name, &figure(1), &figure(IMAGE_SCALE))?;
        }
    }
    Ok(())
}
