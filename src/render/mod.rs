//! How an answer is written: documents, numbers and tables as text, CSV, charts, pictures of walls, VTU, glTF. It knows no verb and no study.

pub(crate) mod axes;
pub(crate) mod chart;
pub(crate) mod csv;
pub mod document;
pub(crate) mod draw;
pub(crate) mod gltf;
pub(crate) mod marker;
pub(crate) mod markup;
pub(crate) mod number;
pub(crate) mod pen;
pub(crate) mod picture;
pub(crate) mod text;
pub(crate) mod vtk;

pub use gltf::{Actor, Role, write_glb};
pub use picture::{Hinge, Picture, Seam, Shade, Stage, Stone, Thrust, Views};
pub use vtk::{SERIES, write_series, write_vtu};
