//! What is true of a simulated campaign.

use crate::critic::simulate::causes::Causes;

/// What is true of a simulated campaign. Scores are standard normal: where a quantity lies in its prior.
#[derive(Clone, Debug, PartialEq)]
pub struct Truth {
    /// What acts.
    pub causes: Causes,
    /// The parameters of the causes, each in its order.
    pub parameters: Vec<f64>,
    /// The factors on the joints in the order of [`NUISANCES`](crate::study::NUISANCES), for each kind of joint.
    pub joints: Vec<[f64; 3]>,
}

impl Truth {
    /// The same joints without any cause.
    pub(in crate::critic) fn still(&self) -> Truth {
        Truth { causes: None.into(), parameters: Vec::new(), joints: self.joints.clone() }
    }
}
