//! Whether a sample agrees with a coefficient of variation that was stated beforehand.

use super::characteristic::Shape;
use super::moments::{mean, sigma};
use super::reference::chi_square_tails;
use crate::math::{ln, ln_1p};

/// A stated coefficient of variation is in doubt where a sample would scatter so differently in fewer cases than this share.
const DOUBTED: f64 = 0.05;

/// A chi-square test of a stated coefficient of variation V against `n` values.
///
/// Of lognormal values the logarithms have the variance ln(1 + V^2): (n - 1) s^2 over it is chi-square with n - 1 degrees of freedom. Of
/// normal values V is the ratio of two unknown numbers, and McKay's statistic (1932) is nearly so distributed for V up to 1/3:
/// `(1 + 1 / V^2) (n - 1) c^2 / (1 + (n - 1) c^2 / n)` with the sample's coefficient of variation c (Forkman and Verrill 2008).
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct CovTest {
    /// What the values are taken to be distributed as.
    pub shape: Shape,
    /// The statistic.
    pub chi_square: f64,
    /// Its degrees of freedom.
    pub degrees_of_freedom: usize,
    /// How often a sample of the stated variation scatters at least as differently, to either side.
    pub p_value: f64,
    /// On which side the sample's scatter lies.
    pub scatter: Scatter,
}

/// On which side of a stated scatter another one lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Scatter {
    /// Above it.
    Larger,
    /// Below it.
    Smaller,
}

impl CovTest {
    /// `None` for fewer than two values, a mean of 0, and logarithms of values that are not above 0.
    ///
    /// ```
    /// use pirca::stats::{CovTest, Shape};
    /// let angles = [9.0, 12.0, 18.0, 24.0, 30.0];
    /// assert!(CovTest::of(&angles, 0.1, Shape::Lognormal).unwrap().p_value < 1e-9);
    /// assert!(CovTest::of(&angles, 0.45, Shape::Normal).unwrap().p_value > 0.5);
    /// ```
    pub fn of(values: &[f64], stated: f64, shape: Shape) -> Option<CovTest> {
        crate::check!(stated > 0.0, "a coefficient of variation of {stated}");
        let (n, freedom) = (values.len() as f64, values.len().checked_sub(1).filter(|own| *own > 0)?);
        let chi_square = match shape {
            Shape::Normal => {
                let mean = mean(values).filter(|mean| *mean != 0.0)?;
                let ratio = sigma(values)? / mean;
                let squares = freedom as f64 * ratio * ratio;
                (1.0 + 1.0 / (stated * stated)) * squares / (1.0 + squares / n)
            }
            Shape::Lognormal => {
                let logs = values.iter().map(|x| (*x > 0.0).then(|| ln(*x))).collect::<Option<Vec<f64>>>()?;
                let sigma = sigma(&logs)?;
                freedom as f64 * sigma * sigma / ln_1p(stated * stated)
            }
        };
        let [below, above] = chi_square_tails(chi_square, freedom as f64);
        Some(CovTest {
            shape,
            chi_square,
            degrees_of_freedom: freedom,
            p_value: (2.0 * below.min(above)).min(1.0),
            scatter: if above < below { Scatter::Larger } else { Scatter::Smaller },
        })
    }

    /// The side on which the sample scatters, where it puts the stated variation in doubt.
    pub fn doubt(&self) -> Option<Scatter> {
        (self.p_value < DOUBTED).then_some(self.scatter)
    }
}
