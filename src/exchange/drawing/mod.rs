//! Drawings and pictures of a wall's face, as outlines, and the wall in them.

mod built;
mod curve;
mod dxf;
mod frame;
mod gather;
mod geojson;
mod layer;
#[cfg(test)]
mod mutations;
mod picture;
mod points;
mod svg;

pub(super) use built::{Size, built};
pub(super) use dxf::read_dxf;
pub(super) use geojson::read_geojson;
pub(super) use picture::read_picture;
pub(super) use svg::read_svg;

use crate::face::Outline;

/// What a drawing says.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Drawing {
    /// The outlines, in the order of the file.
    pub outlines: Vec<Outline>,
    /// Width and height of a picture, in pixels.
    pub picture: Option<[f64; 2]>,
    /// Metres in one of its unit, where the file says so.
    pub metres: Option<f64>,
    /// What was passed over, and what a careful reader would like to know.
    pub warnings: Vec<String>,
}
