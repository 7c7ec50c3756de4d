//! Solvers: assembly into arrays, status, joints; `explicit` is the DEM.

pub mod explicit;

/// Which solver, with its settings.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Solver {
    /// Central differences with local damping: 3DEC- and YADE-like.
    Explicit(explicit::Settings),
}
