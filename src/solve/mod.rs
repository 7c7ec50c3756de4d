//! Solvers: assembly into arrays, status, joints; `explicit` is the DEM.

pub mod explicit;
