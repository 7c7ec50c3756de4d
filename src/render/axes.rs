//! Sizes that charts share, and the digits of their ticks.

/// Width, and height without the legend (pixels at scale 1).
pub(crate) const WIDTH: u32 = 960;
pub(crate) const PLOT_HEIGHT: u32 = 560;
/// Transparency of a band.
pub(crate) const BAND_ALPHA: f64 = 0.18;

/// Decimals that tell the ticks of an axis of this length apart.
pub(crate) fn decimals(length: f64) -> usize {
    (1 - exponent(length)).max(0) as usize
}

/// The power of ten of a positive number, read off its decimal form (exact, unlike a logarithm).
pub(crate) fn exponent(x: f64) -> i32 {
    format!("{x:e}").split_once('e').and_then(|(_, exponent)| exponent.parse().ok()).unwrap_or(0)
}
