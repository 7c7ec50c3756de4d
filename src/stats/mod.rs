//! Statistics on plain slices: moments, COV, intervals, bootstrap. Every statistic comes with its interval.

/// A statistic with its 95 % interval. `None` where it is not defined (a sigma of one wall), never zero and never NaN.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Estimate {
    /// The value.
    pub value: Option<f64>,
    /// The 95 % interval.
    pub interval: Option<[f64; 2]>,
}
