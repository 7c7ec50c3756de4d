//! A picture of a wall and how it moves: an axonometric view as SVG text, with the joints coloured by what they did.

mod colour;
mod order;
mod scene;
mod svg;
#[cfg(test)]
mod tests;
mod view;

pub use scene::{Hinge, Picture, Seam, Stage, Stone, Thrust};
