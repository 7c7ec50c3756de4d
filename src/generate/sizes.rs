//! How long and how high stones are asked to be.

use crate::random::{Family, Pairs};

/// Lengths and heights of the stones of a random wall (m).
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
#[serde(untagged)]
pub enum Sizes {
    /// Drawn apart from each other.
    Apart {
        /// Stone length (m), drawn per stone or cut.
        #[serde(rename = "length_m")]
        length: Family,
        /// Stone height (m), drawn per course or cut.
        #[serde(rename = "height_m")]
        height: Family,
    },
    /// Stones of a survey, length and height (m) together. A cut takes both from one stone. A course is built from stones of like
    /// height: see [`Arrangement::Coursed`](crate::generate::Arrangement::Coursed).
    Together {
        /// The stones surveyed.
        #[serde(rename = "stones_m")]
        stones: Pairs,
    },
}

impl Sizes {
    /// Lengths and heights, each by itself.
    pub fn marginals(&self) -> [Family; 2] {
        match self {
            Sizes::Apart { length, height } => [length.clone(), height.clone()],
            Sizes::Together { stones } => stones.marginals(),
        }
    }

    /// Mean length and mean height of a stone (m).
    pub fn means(&self) -> [f64; 2] {
        self.marginals().map(|own| own.mean())
    }

    /// Smallest length and smallest height (m).
    pub fn least(&self) -> [f64; 2] {
        self.marginals().map(|own| own.support().0)
    }

    /// Whether stones differ.
    pub fn scatter(&self) -> bool {
        self.marginals().iter().any(|own| own.sd() > 0.0)
    }

    /// The same with sizes that deviate `factor` times as far from their means; `factor` is above 0.
    pub fn widened(self, factor: f64) -> Sizes {
        match self {
            Sizes::Apart { length, height } => {
                Sizes::Apart { length: length.widened(factor), height: height.widened(factor) }
            }
            Sizes::Together { stones } => Sizes::Together { stones: stones.widened(factor) },
        }
    }
}
