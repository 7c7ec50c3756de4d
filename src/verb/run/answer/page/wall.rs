//! The page of one wall from a file: what was asked of it, how it gives way, its blocks and joints.

use anyhow::Result;
use serde::Serialize;

use crate::model::Replay;
use crate::render::document::Drawing;
use crate::render::document::Table;
use crate::render::document::filled;
use crate::render::document::{Solid, SolidWall};
use crate::render::picture::{Picture, Views};
use crate::shape::Polyhedron;
use crate::verb::run::answer::page::cite::{Citation, citation};
use crate::verb::run::answer::page::limits;
use crate::verb::run::answer::page::origin::PageOrigin;

/// What the picture of what was read shows.
const READ: &str =
    "What was read: the stones in blue with their numbers, joints closed, over what was drawn.";

/// A table of the page: blocks, or joints.
pub struct WallTable {
    /// What it holds.
    pub name: &'static str,
    /// Heads of the columns.
    pub heads: &'static [&'static str],
    /// Its rows.
    pub rows: Vec<Vec<String>>,
}

/// What the page of a wall is made of.
pub struct WallPage<'a> {
    /// Name of the wall.
    pub wall: &'a str,
    /// What was asked.
    pub question: String,
    /// What came out, the sentence that answers first.
    pub answer: Vec<String>,
    /// What looks wrong.
    pub warnings: &'a [String],
    /// What was read of a drawing or a picture, as SVG.
    pub read: Option<String>,
    /// How the wall gives way.
    pub picture: &'a Picture,
    /// How surely, and what a code says of it, as figures.
    pub figures: &'a [Drawing],
    /// The wall along its axes, before the load.
    pub views: &'a Views,
    /// What mending moved, where it moved anything.
    pub moved: Option<&'a Views>,
    /// The states that it goes through.
    pub replay: &'a Replay,
    /// What the numbers of its tables are.
    pub about_tables: &'static str,
    /// Its blocks and joints.
    pub tables: Vec<WallTable>,
    /// What was given.
    pub inputs: Vec<(&'static str, String)>,
    /// Name of the solver.
    pub solver: &'a str,
    /// SHA-256 of the file.
    pub sha256: String,
    /// How the answer was made.
    pub origin: &'a PageOrigin,
}

/// What the template is filled with.
#[derive(Serialize)]
struct Filled<'a> {
    title: String,
    question: &'a str,
    answer: &'a [String],
    warnings: &'a [String],
    read: Option<Drawing>,
    picture: Drawing,
    figures: &'a [Drawing],
    solid: Option<Solid>,
    views: Drawing,
    moved: Option<Drawing>,
    about_tables: &'static str,
    tables: Vec<Table>,
    inputs: Table,
    limits: [&'static str; 2],
    provenance: Table,
    citation: Citation,
}

/// The page of a wall.
///
/// # Errors
/// A template that is faulty.
pub fn wall_page(of: &WallPage<'_>) -> Result<String> {
    let described = of.picture.remarks.join(" ");
    let own = [
        ("pirca", env!("CARGO_PKG_VERSION").to_owned()),
        ("wall", of.wall.to_owned()),
        ("SHA-256 of the file", of.sha256.clone()),
    ];
    let shapes: Vec<Polyhedron> = of.picture.stones.iter().map(|stone| stone.shape.clone()).collect();
    let solid =
        SolidWall { name: of.wall, shapes: &shapes, replay: of.replay, from_front: of.picture.from_front };
    let caption = match (of.replay.is_mechanism, of.replay.is_in_time()) {
        (true, _) => "The wall in three dimensions, and its mechanism, which has no size of its own.",
        (false, true) => {
            "The wall in three dimensions, from rest through the motion of the ground, in its true size."
        }
        (false, false) => {
            "The wall in three dimensions, from rest through the collapse. Movements at rest are magnified, those of the fall are not."
        }
    };
    let table = |own: &WallTable| Table::new(own.name, own.heads, own.rows.clone());
    filled(
        "wall.html",
        include_str!("wall.html"),
        &Filled {
            title: format!("Wall {}", of.wall),
            question: &of.question,
            answer: &of.answer,
            warnings: of.warnings,
            read: of.read.as_ref().map(|svg| Drawing::picture("figure-read", "What was read", READ, svg)),
            picture: Drawing::described(
                "figure-mechanism",
                &format!("The wall {}", of.wall),
                &described,
                &of.picture.svg(),
            ),
            figures: of.figures,
            solid: Solid::of("figure-solid", caption, &[solid]),
            views: along_axes("figure-views", "The wall from three sides, before the load", of.views),
            moved: of.moved.map(|views| along_axes("figure-mended", "Stones that mending changed", views)),
            about_tables: of.about_tables,
            tables: of.tables.iter().map(table).collect(),
            inputs: Table::of_pairs(of.inputs.iter().map(|(name, value)| (*name, value.clone()))),
            limits: [limits::RIGID, limits::of_solver(of.solver)],
            provenance: of.origin.table(own),
            citation: citation(None),
        },
    )
}

/// Views of the wall with its size in words.
fn along_axes(id: &str, title: &str, views: &Views) -> Drawing {
    let size = views.size();
    let described = format!(
        "Without fixed blocks the wall is {:.3} m long, {:.3} m high and {:.3} m thick; the section lies at x = {:.3} m. {}",
        size.x,
        size.z,
        size.y,
        views.section_at(),
        views.remarks.join(" ")
    );
    Drawing::described(id, title, &described, &views.svg())
}
