//! A coefficient of variation that was stated as known, beside that of the values at hand.

use serde::Serialize;

use crate::render::number::{significant, with_interval};
use crate::stats::{CovTest, Scatter, Shape, Summary};

/// How a stated coefficient of variation agrees with values.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct StatedCov {
    /// What was stated.
    pub cov: f64,
    /// How many values there are.
    pub values: usize,
    /// Their own coefficient of variation; null of a single one.
    pub found: Option<f64>,
    /// Its 95 % interval; null where it has no upper end.
    pub found_ci: Option<[f64; 2]>,
    /// The chi-square test for normal and for lognormal values; none of a single value.
    pub tests: Vec<CovTest>,
    /// The side on which the values scatter, where one of the tests puts the stated variation in doubt.
    pub doubted: Option<Scatter>,
}

impl StatedCov {
    /// Of some values; `None` where there are none.
    pub fn of(cov: f64, values: &[f64]) -> Option<StatedCov> {
        if values.is_empty() {
            return None;
        }
        let tests = [Shape::Normal, Shape::Lognormal].map(|shape| CovTest::of(values, cov, shape));
        let tests: Vec<CovTest> = tests.into_iter().flatten().collect();
        let found = Summary::of(values).cov;
        let doubted = tests.iter().find_map(CovTest::doubt);
        Some(StatedCov {
            cov,
            values: values.len(),
            found: found.value,
            found_ci: found.interval,
            tests,
            doubted,
        })
    }

    /// Whether the values scatter more than was stated, so that what is derived from it is not on the safe side.
    pub fn is_too_small(&self) -> bool {
        self.doubted == Some(Scatter::Larger)
    }

    /// In a sentence; `whose` says whose values they are: `specimens`.
    pub fn sentence(&self, whose: &str) -> String {
        let stated = significant(100.0 * self.cov, 2);
        let Some(found) = self.found.filter(|_| !self.tests.is_empty()) else {
            return format!("One value cannot test the stated COV of {stated} %.");
        };
        // Beyond a third the interval is rough.
        let interval = self.found_ci.filter(|_| found < 1.0 / 3.0).map(|ends| ends.map(|x| 100.0 * x));
        let found = match interval {
            Some(_) => with_interval(Some(100.0 * found), interval, 2),
            None => significant(100.0 * found, 2),
        };
        let least = self.tests.iter().map(|test| test.p_value).fold(1.0, f64::min);
        let n = self.values;
        let p = format!(
            "chi-square test, p {}",
            if least > 0.0 { significant(least, 2) } else { "below 1e-300".to_owned() }
        );
        match self.doubted {
            None => format!(
                "The stated COV of {stated} % agrees with the {n} {whose}, whose COV is {found} % ({p})."
            ),
            Some(Scatter::Larger) => {
                format!(
                    "The stated COV of {stated} % is in doubt: the {n} {whose} scatter more, by {found} % ({p})."
                )
            }
            Some(Scatter::Smaller) => {
                format!(
                    "The stated COV of {stated} % is in doubt: the {n} {whose} scatter less, by {found} % ({p})."
                )
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_stated_variation_is_set_beside_that_of_the_values() {
        let angles = [9.0, 12.0, 18.0, 24.0, 30.0];
        let stated = |cov: f64, values: &[f64]| StatedCov::of(cov, values).unwrap();
        let low = stated(0.1, &angles);
        assert_eq!((low.doubted, low.is_too_small()), (Some(Scatter::Larger), true));
        assert!(low.sentence("specimens").contains("scatter more, by 46 % (chi-square test, p "), "{low:?}");
        let right = stated(0.46, &angles);
        assert!(
            right.doubted.is_none() && right.sentence("specimens").contains("agrees with the 5 specimens")
        );
        let calm = stated(0.5, &[20.0, 20.1, 19.9, 20.05, 20.0]);
        assert_eq!((calm.doubted, calm.is_too_small()), (Some(Scatter::Smaller), false));
        let one = stated(0.1, &angles[..1]);
        assert_eq!(one.sentence("specimens"), "One value cannot test the stated COV of 10 %.");
        assert!(StatedCov::of(0.1, &[]).is_none());
    }
}
