//! Numbers and names as people read them: a stated number of significant digits, a dash where there is none.

/// `x` with `digits` significant digits, without exponent while it stays short (0.001 to 9,999,999).
pub fn significant(x: f64, digits: usize) -> String {
    let scientific = format!("{:.*e}", digits.saturating_sub(1), x);
    // The exponent after rounding, so that 9.996 with three digits becomes 10.0.
    let Some(exponent) = scientific.split_once('e').and_then(|(_, e)| e.parse::<i32>().ok()) else {
        return scientific;
    };
    if !(-3..7).contains(&exponent) {
        return scientific;
    }
    let decimals = (digits as i32 - 1 - exponent).max(0) as usize;
    format!("{x:.decimals$}")
}

/// A value, or a dash where it is not defined.
pub fn or_dash(x: Option<f64>, digits: usize) -> String {
    x.map_or_else(|| "-".to_string(), |x| significant(x, digits))
}

/// A value with its interval in brackets: `1.23 [1.10, 1.36]`, `1.23 [-]`, or `-`.
pub fn with_interval(value: Option<f64>, interval: Option<[f64; 2]>, digits: usize) -> String {
    match (value, interval) {
        (None, _) => "-".to_string(),
        (Some(x), None) => format!("{} [-]", significant(x, digits)),
        (Some(x), Some([low, high])) => {
            format!(
                "{} [{}, {}]",
                significant(x, digits),
                significant(low, digits),
                significant(high, digits)
            )
        }
    }
}

/// A stiffness as engineers write it: `7.5e7 Pa/m`.
pub fn stiffness(kn: f64) -> String {
    format!("{kn:e} Pa/m")
}

/// Lowest and highest of some numbers; `None` when there are none.
pub fn range(values: impl IntoIterator<Item = f64>) -> Option<[f64; 2]> {
    values.into_iter().fold(None, |range, x| match range {
        None => Some([x, x]),
        Some([low, high]) => Some([f64::min(low, x), f64::max(high, x)]),
    })
}

/// A name of at most `longest` characters; a longer one is cut and ends in an ellipsis.
pub fn shortened(name: &str, longest: usize) -> String {
    match name.chars().count() > longest {
        true => name.chars().take(longest - 1).chain(['\u{2026}']).collect(),
        false => name.to_string(),
    }
}
