//! A statistic with its interval.

/// A statistic with its 95 % interval. `None` where it is not defined (a sigma of one wall), never zero and never NaN.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Estimate {
    /// The value.
    pub value: Option<f64>,
    /// The 95 % interval; `None` too where it has no finite end.
    pub interval: Option<[f64; 2]>,
}

impl Estimate {
    /// Neither value nor interval.
    pub const UNDEFINED: Estimate = Estimate { value: None, interval: None };
}
