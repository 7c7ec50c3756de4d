//! Numbers as people read them: the digits that are known, and none beyond.

/// Digits of a number at most: beyond them lies the accuracy of the solvers.
const MOST_DIGITS: i32 = 7;
/// Digits of a number that is small beside the width that it is known within.
const FEWEST_DIGITS: i32 = 2;
/// Digits of a number that is known within no width: the other end of its interval is infinite.
const WITHOUT_WIDTH: i32 = 3;
/// Powers of ten from which digits that are not known are left to an exponent.
const LARGE: i32 = 5;

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

/// A number in at most four digits, with an exponent and without zeros behind the point: `7.5e7`, `9.875e8`, `1e12`.
pub fn compact(x: f64) -> String {
    with_exponent(x, 4)
}

/// A number with the digits that are known of it within `width`, so that the width itself has two: 20.7123 within 0.05 is `20.712`. A
/// number far below the width keeps two digits, no number has more than seven, and 0 is `0`.
///
/// ```
/// use pirca::math::within;
/// assert_eq!([0.05, 2.8, 28.0].map(|width| within(20.7123, width)), ["20.712", "20.7", "21"]);
/// assert_eq!([within(6.5e-5, 2.6e-3), within(5.556e6, 3.05e6)], ["6.5e-5", "5.6e6"]);
/// ```
pub fn within(x: f64, width: f64) -> String {
    if x == 0.0 || !x.is_finite() {
        return if x == 0.0 { "0".to_owned() } else { x.to_string() };
    }
    let exponent = power_of_ten(x);
    let digits = match width.is_finite() {
        true => (exponent - power_of_ten(width) + 2).clamp(FEWEST_DIGITS, MOST_DIGITS),
        false => WITHOUT_WIDTH,
    };
    if exponent >= LARGE && digits <= exponent {
        return with_exponent(x, digits as usize);
    }
    if !(-3..7).contains(&exponent) {
        return significant(x, digits as usize);
    }
    let decimals = (digits - 1 - exponent).max(0) as usize;
    format!("{x:.decimals$}")
}

/// The ends of an interval, each as [`within`] its width; `None` where they are the same to all digits that are shown of a number:
/// such an interval is a number.
///
/// ```
/// use pirca::math::ends;
/// assert_eq!(ends([20.6801, 20.7432]), Some(["20.680", "20.743"].map(String::from)));
/// assert_eq!(ends([0.293_830_000, 0.293_830_001]), None);
/// ```
pub fn ends(interval: [f64; 2]) -> Option<[String; 2]> {
    let [low, high] = interval.map(|end| within(end, interval[1] - interval[0]));
    (low != high).then_some([low, high])
}

/// With an exponent, and without zeros behind the point.
fn with_exponent(x: f64, digits: usize) -> String {
    let text = format!("{:.*e}", digits.saturating_sub(1), x);
    match text.split_once('e') {
        Some((digits, exponent)) if digits.contains('.') => {
            format!("{}e{exponent}", digits.trim_end_matches('0').trim_end_matches('.'))
        }
        _ => text,
    }
}

/// The power of ten of a number's first digit, after rounding to three: a difference of 0.0999... is 0.1. Far below all others for 0 and what
/// is no number.
fn power_of_ten(x: f64) -> i32 {
    let text = format!("{x:.2e}");
    match text.split_once('e').and_then(|(_, exponent)| exponent.parse().ok()) {
        Some(exponent) if x != 0.0 => exponent,
        _ => -999,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digits_follow_the_width() {
        let shown = |x: f64, width: f64| within(x, width);
        assert_eq!(shown(20.712_34, 0.000_57), "20.71234");
        assert_eq!(shown(20.712_34, 57.0), "21");
        assert_eq!(shown(0.0428, 0.0487), "0.043");
        assert_eq!(shown(-0.013, 8.1), "-0.013");
        assert_eq!(shown(9.996, 0.31), "10.00");
        assert_eq!(shown(0.25, 0.3 - 0.2), "0.25");
        // What lies far below the width keeps what tells it from 0.
        assert_eq!(shown(1.1e-8, 4.7e-6), "1.1e-8");
        assert_eq!(shown(0.0, 4.7e-6), "0");
        // A stiffness has no digits that nobody knows.
        assert_eq!([5.556e6, 7.48e6, 8.0e6].map(|kn| shown(kn, 3.05e6)), ["5.6e6", "7.5e6", "8e6"]);
        assert_eq!(shown(123_456.0, 12.0), "123456");
        // Without a width there are as many digits as any number has.
        assert_eq!(shown(1.0 / 3.0, 0.0), "0.3333333");
    }

    #[test]
    fn an_interval_whose_ends_read_alike_is_a_number() {
        assert_eq!(ends([0.293_83, 0.293_83]), None);
        assert_eq!(ends([20.7, 20.700_000_1]), None);
        let some = |low: &str, high: &str| Some([low.to_owned(), high.to_owned()]);
        assert_eq!(ends([0.293_81, 0.293_86]), some("0.293810", "0.293860"));
        assert_eq!(ends([0.0, 0.0037]), some("0", "0.0037"));
        assert_eq!(ends([-0.2, 1.0]), some("-0.20", "1.0"));
        assert_eq!(ends([1.2, f64::INFINITY]), some("1.20", "inf"));
    }

    #[test]
    fn few_digits_stay_without_an_exponent_while_they_are_short() {
        assert_eq!([9.996, 0.001, 0.000_99].map(|x| significant(x, 3)), ["10.0", "0.00100", "9.90e-4"]);
        assert_eq!(
            [7.5e7, 95000000.00000001, 6.324_555_320_332_767e7].map(compact),
            ["7.5e7", "9.5e7", "6.325e7"]
        );
    }
}
