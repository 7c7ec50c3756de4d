//! Walls from and to other programs.
