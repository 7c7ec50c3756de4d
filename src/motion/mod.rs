//! Ground motions: the acceleration of a rigid base, as a record that is read, a pulse in closed form, or one of a stochastic process;
//! and what is measured of it.
//!
//! SI units throughout: m, s, m/s^2. A component is linear between its samples; nothing is resampled and no zero line is corrected.

mod accelerogram;
mod base;
mod fault;
mod fourier;
mod generate;
mod measures;
mod peak;
mod pulse;
mod read;
mod response;
#[cfg(test)]
mod tests;

pub use accelerogram::Accelerogram;
pub use base::Motion;
pub use fault::{BadParameter, BadRecord};
pub use generate::{
    Envelope, KanaiTajimi, KanaiTajimiProcess, RezaeianDerKiureghian, RezaeianDerKiureghianProcess,
};
pub use measures::Measures;
pub use pulse::Pulse;
