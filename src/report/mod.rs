//! report

mod vtu;

pub use vtu::write_vtu;
