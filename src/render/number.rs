//! Numbers and names as people read them: as many digits as an interval makes known, a dash where there is no number.

use crate::math::pow;

pub use crate::math::{compact, ends, significant, within};

/// A value, or a dash where it is not defined.
pub fn or_dash(x: Option<f64>, digits: usize) -> String {
    x.map_or_else(|| "-".to_string(), |x| significant(x, digits))
}

/// A value with its interval in brackets, with the digits that its width makes known ([`within`]): `1.23 [1.10, 1.36]`. Without an
/// interval it has `digits`: `1.23 [-]`, or `-` where there is no value. An interval whose ends read alike is none: `1.23`.
pub fn with_interval(value: Option<f64>, interval: Option<[f64; 2]>, digits: usize) -> String {
    match (value, interval) {
        (None, _) => "-".to_string(),
        (Some(x), None) => format!("{} [-]", significant(x, digits)),
        (Some(x), Some(interval)) => match ends(interval) {
            None => significant(x, digits),
            Some([low, high]) => format!("{} [{low}, {high}]", within(x, interval[1] - interval[0])),
        },
    }
}

/// An interval alone: `[1.10, 1.36]`, or the number that it is.
pub fn bracketed(interval: [f64; 2], digits: usize) -> String {
    ends(interval).map_or_else(|| significant(interval[0], digits), |[low, high]| format!("[{low}, {high}]"))
}

/// From the lowest to the highest in words: `1.10 to 1.36`, or the number that both are.
pub fn from_to(interval: [f64; 2], digits: usize) -> String {
    ends(interval).map_or_else(|| significant(interval[0], digits), |[low, high]| format!("{low} to {high}"))
}

/// A value with its interval as [`with_interval`], with as many more digits as show on which side of `against` each end lies: 0.99963
/// beside 1 is not written as 1.000.
pub fn with_interval_against(
    value: Option<f64>,
    interval: Option<[f64; 2]>,
    digits: usize,
    against: f64,
) -> String {
    let numbers: Vec<f64> = value.into_iter().chain(interval.into_iter().flatten()).collect();
    let hidden = |shown: &dyn Fn(f64) -> String| {
        // What is printed, read back.
        numbers.iter().any(|x| *x != against && shown(*x).parse::<f64>().is_ok_and(|back| back == against))
    };
    match (value, interval) {
        (Some(x), Some([low, high])) if high > low => {
            let narrower = |tenths: &i32| (high - low) * pow(0.1, f64::from(*tenths));
            let is_clear = |tenths: &i32| !hidden(&|x| within(x, narrower(tenths)));
            let width = narrower(&(0..MOST_MORE).find(is_clear).unwrap_or(0));
            let [x, low, high] = [x, low, high].map(|x| within(x, width));
            match low == high {
                true => with_interval(value, interval, digits),
                false => format!("{x} [{low}, {high}]"),
            }
        }
        _ => {
            let is_clear = |digits: &usize| !hidden(&|x| significant(x, *digits));
            with_interval(value, interval, (digits..MOST_DIGITS).find(is_clear).unwrap_or(MOST_DIGITS))
        }
    }
}

/// So many digits are printed at most of a number without an interval, and so many more are tried of one with an interval.
const MOST_DIGITS: usize = 7;
const MOST_MORE: i32 = 7;

/// A stiffness as engineers write it: `7.5e7 Pa/m`.
pub fn stiffness(kn: f64) -> String {
    format!("{} Pa/m", compact(kn))
}

/// How often something as far off is seen by chance, by a p-value from so many simulated campaigns: `about 1 in 200`,
/// `fewer than 1 in 2,000` where none of them was, `12 in 100`.
pub fn how_often(p_value: f64, campaigns: u64) -> String {
    // With n campaigns a p-value is (k + 1) / (n + 1).
    if p_value * (campaigns + 1) as f64 <= 1.5 {
        return format!("fewer than 1 in {}", grouped(campaigns));
    }
    match p_value {
        p if p < 0.095 => format!("about 1 in {}", grouped((1.0 / p).round() as u64)),
        p => format!("{:.0} in 100", 100.0 * p),
    }
}

/// A whole number with commas between thousands.
fn grouped(n: u64) -> String {
    let digits = n.to_string();
    let comma = |(place, digit): (usize, char)| {
        let before = (place > 0 && (digits.len() - place).is_multiple_of(3)).then_some(',');
        before.into_iter().chain([digit])
    };
    digits.chars().enumerate().flat_map(comma).collect()
}

/// Words with a capital letter before them, as a sentence or a title begins.
pub fn capital(words: &str) -> String {
    let mut letters = words.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}

/// Lowest and highest of some numbers; `None` when there are none.
pub fn range(values: impl IntoIterator<Item = f64>) -> Option<[f64; 2]> {
    values.into_iter().fold(None, |range, x| match range {
        None => Some([x, x]),
        Some([low, high]) => Some([f64::min(low, x), f64::max(high, x)]),
    })
}

/// A name of at most `longest` characters; a longer one is cut in its middle, as names that are alike differ at their ends.
pub fn shortened(name: &str, longest: usize) -> String {
    let all: Vec<char> = name.chars().collect();
    if all.len() <= longest {
        return name.to_owned();
    }
    let tail = (longest - 1) / 2;
    let (head, tail) = (&all[..longest - 1 - tail], &all[all.len() - tail..]);
    head.iter().chain(&['\u{2026}']).chain(tail).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_names_that_differ_at_their_ends_stay_apart() {
        assert_eq!(shortened("irregular-phi_deg-25", 18), "irregular\u{2026}i_deg-25");
        assert_eq!(shortened("irregular-phi_deg-35", 18), "irregular\u{2026}i_deg-35");
        assert_eq!(shortened("irregular", 9), "irregular");
    }

    #[test]
    fn an_end_beside_one_keeps_the_digit_that_tells_its_side() {
        let ratio = |low, high| with_interval_against(Some(0.99), Some([low, high]), 3, 1.0);
        assert_eq!(ratio(0.983, 0.9963), "0.990 [0.983, 0.996]");
        assert_eq!(ratio(0.983, 0.99963), "0.9900 [0.9830, 0.9996]");
        assert_eq!(ratio(0.98, 1.0), "0.990 [0.980, 1.000]");
        assert_eq!(with_interval_against(Some(1.0004), None, 3, 1.0), "1.0004 [-]");
    }

    #[test]
    fn the_digits_of_a_value_are_those_of_its_interval() {
        let shown = |x, low, high| with_interval(Some(x), Some([low, high]), 3);
        assert_eq!(shown(20.712_3, 20.680_1, 20.743_2), "20.712 [20.680, 20.743]");
        assert_eq!(shown(104.2, 68.9, 139.4), "104 [69, 139]");
        assert_eq!(shown(2.2e-7, 1.1e-8, 4.7e-6), "2.2e-7 [1.1e-8, 4.7e-6]");
        assert_eq!(shown(20.712_3, 20.712_3, 20.712_3), "20.7");
        assert_eq!(with_interval(Some(20.712_3), None, 3), "20.7 [-]");
        assert_eq!([bracketed([1.5, 3.26], 3), bracketed([1.5; 2], 3)], ["[1.5, 3.3]", "1.50"]);
        assert_eq!([from_to([1.5, 3.26], 3), from_to([1.5; 2], 3)], ["1.5 to 3.3", "1.50"]);
    }

    #[test]
    fn chance_is_said_as_one_in_so_many() {
        let said = |p: f64| how_often(p, 2000);
        assert_eq!(said(1.0 / 2001.0), "fewer than 1 in 2,000");
        assert_eq!(said(2.0 / 2001.0), "about 1 in 1,001");
        assert_eq!(said(0.021), "about 1 in 48");
        assert_eq!(
            [0.094, 0.095, 0.12, 1.0].map(said),
            ["about 1 in 11", "10 in 100", "12 in 100", "100 in 100"]
        );
        assert_eq!(how_often(1.0 / 1_234_568.0, 1_234_567), "fewer than 1 in 1,234,567");
    }

    #[test]
    fn a_stiffness_shows_no_rounding_of_its_computation() {
        let shown = [7.5e7, 95000000.00000001, 1e12, 2.8166e7].map(stiffness);
        assert_eq!(shown, ["7.5e7 Pa/m", "9.5e7 Pa/m", "1e12 Pa/m", "2.817e7 Pa/m"]);
    }
}
