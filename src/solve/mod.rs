//! Solvers: assembly into arrays, joints, status; `explicit` is the DEM.

pub mod bodies;
pub mod explicit;
pub mod joints;

/// Which solver, with its settings.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Solver {
    /// Central differences with local damping: 3DEC- and YADE-like.
    Explicit(explicit::Settings),
}
