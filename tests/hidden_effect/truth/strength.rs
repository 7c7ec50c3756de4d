//! How strong a mechanism is: how far its parameters lie from no effect in their priors.

use pirca::random::Stream;
use pirca::study::{Described, Parameter};

/// A tercile of severity.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Strength {
    Weak,
    Middle,
    Strong,
}

/// On which side of its prior a parameter has no effect.
#[derive(Clone, Copy)]
enum Away {
    /// Near its lower end: severity is the quantile.
    Up,
    /// Near its upper end: severity is one less the quantile.
    Down,
    /// At this value: severity counts from there to either end, and each way is as likely as the prior has it.
    From(f64),
}

/// All parameters that a mechanism does not grow with.
const AWAY: &[(&str, &str, Away)] = &[
    ("joint_closure", "initial_pa_per_m", Away::Down),
    ("contact_area", "share", Away::Down),
    ("friction", "factor", Away::From(1.0)),
    ("friction", "residual_share", Away::Down),
    ("friction", "slip_distance_m", Away::Down),
    ("lean", "angle_deg", Away::From(0.0)),
    ("base_compliance", "settlement_n_per_m", Away::Down),
    ("base_compliance", "rotation_n_m_per_rad", Away::Down),
    ("wedge_loss", "beyond_deg", Away::Down),
    ("size_scatter", "factor", Away::From(1.0)),
    ("density", "factor", Away::From(1.0)),
    ("gauge_offset", "offset_m", Away::From(0.0)),
    ("gauge_scale", "factor", Away::From(1.0)),
    ("end_release", "friction_share", Away::Down),
    ("end_release", "stiffness_share", Away::Down),
    ("platform_friction", "phi_deg", Away::Down),
];

impl Strength {
    pub const ALL: [Strength; 3] = [Strength::Weak, Strength::Middle, Strength::Strong];

    pub fn name(self) -> &'static str {
        ["weak", "middle", "strong"][self as usize]
    }
}

/// The parameters of a mechanism, by key and in the key's unit: the severity of each is drawn on its own, in this tercile.
pub fn drawn(mechanism: &Described, strength: Strength, stream: &mut Stream) -> Vec<(String, f64)> {
    let value = |p: &Parameter| {
        let severity = (strength as usize as f64 + stream.uniform()) / 3.0;
        let place = at(away(mechanism.name, p.key), p, severity, stream.uniform());
        (p.key.to_owned(), p.prior.quantile(place))
    };
    mechanism.parameters.iter().map(value).collect()
}

fn away(mechanism: &str, key: &str) -> Away {
    let own = AWAY.iter().find(|(name, own, _)| *name == mechanism && *own == key);
    own.map_or(Away::Up, |(.., away)| *away)
}

/// The quantile of a prior that has a severity; `side` is uniform.
fn at(away: Away, parameter: &Parameter, severity: f64, side: f64) -> f64 {
    match away {
        Away::Up => severity,
        Away::Down => 1.0 - severity,
        Away::From(value) => {
            let none = parameter.prior.cdf(value);
            if side < none { none * (1.0 - severity) } else { none + severity * (1.0 - none) }
        }
    }
}

#[cfg(test)]
mod tests {
    use pirca::random::Streams;
    use pirca::stats;

    use super::*;
    use crate::truth::roster::catalogue;

    #[test]
    fn every_parameter_that_is_listed_is_one_and_terciles_make_up_the_prior() {
        let mechanisms = catalogue();
        for (mechanism, key, _) in AWAY {
            assert!(
                mechanisms.iter().any(|m| m.name == *mechanism && m.parameters.iter().any(|p| p.key == *key)),
                "{mechanism}.{key}"
            );
        }
        let mut stream = Streams::new(1, 0).of("terciles");
        for parameter in mechanisms.iter().flat_map(|m| m.parameters.iter().map(move |p| (m, p))) {
            let (mechanism, p) = parameter;
            if p.prior.sd() == 0.0 {
                continue;
            }
            let at = mechanism.parameters.iter().position(|own| own.key == p.key).expect("its own");
            let mut of = |strength: Strength| -> Vec<f64> {
                (0..600).map(|_| p.prior.cdf(drawn(mechanism, strength, &mut stream)[at].1)).collect()
            };
            let all: Vec<f64> = Strength::ALL.iter().flat_map(|strength| of(*strength)).collect();
            let mean = stats::mean(&all).expect("there are some");
            // Uniform, in three strata: a standard error of at most sqrt(1/12 / 1800).
            assert!((mean - 0.5).abs() < 0.03, "{}.{}: {mean}", mechanism.name, p.key);
            let none = match away(mechanism.name, p.key) {
                Away::Up => 0.0,
                Away::Down => 1.0,
                Away::From(value) => p.prior.cdf(value),
            };
            let far = |values: Vec<f64>| values.iter().fold(0.0, |sum: f64, u| sum + (u - none).abs());
            assert!(far(of(Strength::Strong)) > 1.5 * far(of(Strength::Middle)), "{}", p.key);
            assert!(far(of(Strength::Middle)) > 2.0 * far(of(Strength::Weak)), "{}", p.key);
        }
    }
}
