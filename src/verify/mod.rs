//! Local mechanisms checked as codes ask for it: by acceleration, and by displacement.
//!
//! # The mechanism as an oscillator
//!
//! A mechanism whose stones `k` of weight `P_k` begin to move by `delta_k` along the load, when its control point moves by `delta_C`, is an
//! oscillator of one degree of freedom (Circolare 7/2019, C8.7.1.3 to C8.7.1.5):
//!
//! ```text
//! e* = (sum P delta)^2 / (sum P . sum P delta^2)       M* = e* sum P / g
//! a  = alpha g / (e* FC)                               d  = d_C sum P delta^2 / (delta_C sum P delta)
//! ```
//!
//! `alpha` is the multiplier of the weight that it bears when its control point has gone `d_C`, and `FC` the confidence factor. From `a_0`, where the
//! mechanism sets in, the capacity curve `a(d)` comes down to nothing at `d_0`.
//!
//! # The checks
//!
//! By acceleration, `q a_0` against the acceleration of the place where the wall stands. By displacement, a share of `d_0` against the
//! displacement spectrum at the secant period `T = c pi sqrt(d / a(d))`. Shares, `c` and damping are those of a [`Code`].
//!
//! # Sources
//!
//! Norme tecniche per le costruzioni (D.M. 17 January 2018), 3.2.3.2.1; Circolare 21 January 2019 n. 7, C7.2.3 and C8.7.1.2.1; Circolare
//! 2 February 2009 n. 617, C8A.4; EN 1998-1:2004, 3.2.2.2.

mod code;
mod curve;
mod judged;
mod oscillator;
mod place;
mod spectrum;

pub use code::{Code, LOWEST_KNOWLEDGE, LimitState};
pub use curve::CapacityCurve;
pub use judged::{BeforeIt, ByAcceleration, ByDisplacement, Demanded, Verified, judge};
pub use oscillator::{Moving, Oscillator};
pub use place::{Mode, Place};
pub use spectrum::{Corners, Spectrum, damping_factor};
