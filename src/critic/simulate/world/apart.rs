//! What is measured apart from the tests: joints of two stones, weights, and gauges.

use crate::critic::simulate::design::Design;
use crate::critic::simulate::truth::Truth;
use crate::critic::simulate::world::World;
use crate::math::{atan, radians, tan};
use crate::study::{MeasuredQuantity, Measurement, Mechanisms};

impl World<'_> {
    /// What is measured apart before its errors.
    pub fn values_apart(&self, design: &Design, truth: &Truth) -> Vec<f64> {
        design.apart.iter().map(|(family, m)| self.apart(*family, m, truth)).collect()
    }

    /// Weight of a stone of a family as it is stated, in the mean over a wall (N).
    pub fn stone_weight(&self, family: usize) -> f64 {
        self.weights[&self.stands_for[family]][1]
    }

    /// A parameter of a mechanism (in its key's unit), if it is among the causes that act on walls with joints of a kind.
    fn parameter(&self, truth: &Truth, kind: usize, mechanism: &str, key: &str) -> Option<f64> {
        let (cause, scores) =
            self.acting(truth, kind).find(|(cause, _)| self.mechanisms[*cause].name == mechanism)?;
        let parameters = &self.mechanisms[cause].parameters;
        let at = parameters.iter().position(|p| p.key == key)?;
        Some(parameters[at].search.at_score(scores[at]))
    }

    /// What gauges make of the displacements.
    pub(super) fn gauge(&self, truth: &Truth) -> Mechanisms {
        // They are the same at every wall, whatever its joints.
        let gauges = [("gauge_scale", "factor"), ("gauge_offset", "offset_m")];
        gauges.into_iter().fold(Mechanisms::default(), |on, (gauge, key)| {
            match self.parameter(truth, 0, gauge, key) {
                Some(value) => on.with(gauge, &[value]),
                None => on,
            }
        })
    }

    /// What is measured of a family apart from tilting: in a test on two stones the stiffness over the whole joint, and the
    /// friction angle before it weakens; the weight of a specimen; what the gauge shows of a target that does not move.
    pub(in crate::critic) fn apart(&self, family: usize, m: &Measurement, truth: &Truth) -> f64 {
        let arm = &self.study.arms[family];
        let factors = self.factors(truth, family);
        let by = |mechanism: &str, key: &str| {
            self.parameter(truth, self.kinds[family], mechanism, key).unwrap_or(1.0)
        };
        match m.quantity {
            MeasuredQuantity::JointKn => {
                let part = by("contact_area", "share") * by("bearing_points", "share");
                arm.kn_points[arm.middle_point()] * factors[0] * part
            }
            MeasuredQuantity::SpecimenWeight => {
                self.weights[&self.stands_for[family]][0] * by("density", "factor")
            }
            MeasuredQuantity::FixedTarget => self.gauge(truth).reading(0.0),
            _ => atan(tan(radians(arm.joint.phi_deg.mean() * factors[1])) * by("friction", "factor")),
        }
    }
}
