//! A picture of a wall and how it moves: an axonometric view as SVG text, with the joints coloured by what they did. Drawings of a wall along
//! its axes, to scale, with its dimensions.

mod colour;
mod ink;
mod order;
mod scene;
mod svg;
#[cfg(test)]
mod tests;
mod view;
mod views;

pub use scene::{Hinge, Picture, Seam, Stage, Stone, Thrust};
pub use views::{Shade, Views};
