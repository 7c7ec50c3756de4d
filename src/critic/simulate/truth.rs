//! What is true of a simulated campaign.

use crate::critic::simulate::causes::Causes;
use crate::random::standard_normal::{cdf, quantile};

/// What is true of a simulated campaign. Scores are standard normal: where a quantity lies in its prior.
#[derive(Clone, Debug, PartialEq)]
pub struct Truth {
    /// What acts.
    pub causes: Causes,
    /// The parameters of the causes, each in its order.
    pub parameters: Vec<f64>,
    /// The factors on the joints in the order of [`NUISANCES`](crate::study::NUISANCES), for each kind of joint.
    pub joints: Vec<[f64; 3]>,
    /// How far specimens of a family differ in the stiffness of their joints, see [`Self::stiffness_scatter`].
    pub scatter: f64,
}

/// Standard deviation of the half-normal prior of the coefficient of variation of the joints' stiffness between specimens: masons do
/// not build the same joint twice, nor do specimens dry and settle alike (assumed).
const SCATTER: f64 = 0.2;

impl Truth {
    /// Coefficient of variation of the joints' stiffness between specimens.
    pub fn stiffness_scatter(&self) -> f64 {
        SCATTER * quantile(0.5 + 0.5 * cdf(self.scatter))
    }

    /// The same joints without any cause.
    pub(in crate::critic) fn still(&self) -> Truth {
        Truth {
            causes: None.into(),
            parameters: Vec::new(),
            joints: self.joints.clone(),
            scatter: self.scatter,
        }
    }
}
