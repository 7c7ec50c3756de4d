//! How strong a mechanism is: how far its parameters lie from no effect in their physical priors or in their search priors, or how far
//! outside of what anybody expects.

use pirca::math::exp;
use pirca::random::{Family, Stream};
use pirca::study::{Described, Parameter, WIDER};

/// A tercile of severity.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Strength {
    Weak,
    Middle,
    Strong,
}

/// Which of its two priors a mechanism is drawn from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Within {
    /// The physical prior.
    Prior,
    /// The search prior.
    Search,
}

impl Within {
    fn of(self, parameter: &Parameter) -> &Family {
        match self {
            Within::Prior => &parameter.prior,
            Within::Search => &parameter.search,
        }
    }
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
    ("bearing_points", "points", Away::Down),
    ("bearing_points", "share", Away::Down),
    ("bedding", "stiffness_share", Away::Down),
    ("heading", "turn_deg", Away::From(0.0)),
    ("motion_scale", "factor", Away::From(1.0)),
];

impl Strength {
    pub const ALL: [Strength; 3] = [Strength::Weak, Strength::Middle, Strength::Strong];

    pub fn name(self) -> &'static str {
        ["weak", "middle", "strong"][self as usize]
    }
}

/// Mechanisms that are hidden outside their physical priors: the parameters that lie there, and the side (0 for either).
const OUTSIDE: [(&str, &[(&str, f64)]); 5] = [
    ("contact_inset", &[("radius_m", 1.0)]),
    ("joint_closure", &[("closure_m", 1.0)]),
    ("base_compliance", &[("rotation_n_m_per_rad", -1.0)]),
    ("lean", &[("angle_deg", 0.0)]),
    ("gauge_offset", &[("offset_m", 0.0)]),
];

/// Their names.
pub fn outside() -> [&'static str; OUTSIDE.len()] {
    OUTSIDE.map(|(name, _)| name)
}

/// The parameters of a mechanism, by key and in the key's unit: the severity of each is drawn on its own, in this tercile of a prior.
pub fn drawn(
    mechanism: &Described,
    (strength, within): (Strength, Within),
    stream: &mut Stream,
) -> Vec<(String, f64)> {
    let value = |p: &Parameter| {
        let severity = (strength as usize as f64 + stream.uniform()) / 3.0;
        let prior = within.of(p);
        let place = at(away(mechanism.name, p.key), prior, severity, stream.uniform());
        (p.key.to_owned(), prior.quantile(place))
    };
    mechanism.parameters.iter().map(value).collect()
}

/// The same with what lies outside so many standard deviations from the centre of its physical prior, and the rest drawn from its
/// own.
pub fn drawn_outside(mechanism: &Described, spreads: u32, stream: &mut Stream) -> Vec<(String, f64)> {
    let (_, moved) = OUTSIDE.iter().find(|(name, _)| *name == mechanism.name).expect("it is listed");
    let value = |p: &Parameter| {
        let [place, side] = [0; 2].map(|_| stream.uniform());
        let value = match moved.iter().find(|(key, _)| *key == p.key) {
            Some((_, way)) => {
                let way = if *way == 0.0 { 1_f64.copysign(side - 0.5) } else { *way };
                out(p, way * f64::from(spreads))
            }
            None => p.prior.quantile(place),
        };
        (p.key.to_owned(), value)
    };
    mechanism.parameters.iter().map(value).collect()
}

/// The value that lies so many standard deviations of a parameter's physical prior above its centre, see
/// [`Parameter::spreads_out`].
fn out(p: &Parameter, spreads: f64) -> f64 {
    match p.search {
        Family::TruncatedLognormal { median, log_sd, .. } => median * exp(spreads * log_sd / WIDER),
        _ => p.prior.mean() + spreads * p.prior.sd(),
    }
}

fn away(mechanism: &str, key: &str) -> Away {
    let own = AWAY.iter().find(|(name, own, _)| *name == mechanism && *own == key);
    own.map_or(Away::Up, |(.., away)| *away)
}

/// The quantile of a prior that has a severity; `side` is uniform.
fn at(away: Away, prior: &Family, severity: f64, side: f64) -> f64 {
    match away {
        Away::Up => severity,
        Away::Down => 1.0 - severity,
        Away::From(value) => {
            let none = prior.cdf(value);
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
            for within in [Within::Prior, Within::Search] {
                let prior = within.of(p);
                let mut of = |strength: Strength| -> Vec<f64> {
                    let mut one = || drawn(mechanism, (strength, within), &mut stream)[at].1;
                    (0..600).map(|_| prior.cdf(one())).collect()
                };
                let all: Vec<f64> = Strength::ALL.iter().flat_map(|strength| of(*strength)).collect();
                let mean = stats::mean(&all).expect("there are some");
                // Uniform, in three strata: a standard error of at most sqrt(1/12 / 1800).
                assert!((mean - 0.5).abs() < 0.03, "{}.{}: {mean}", mechanism.name, p.key);
                let none = match away(mechanism.name, p.key) {
                    Away::Up => 0.0,
                    Away::Down => 1.0,
                    Away::From(value) => prior.cdf(value),
                };
                let far = |values: Vec<f64>| values.iter().fold(0.0, |sum: f64, u| sum + (u - none).abs());
                assert!(far(of(Strength::Strong)) > 1.5 * far(of(Strength::Middle)), "{}", p.key);
                assert!(far(of(Strength::Middle)) > 2.0 * far(of(Strength::Weak)), "{}", p.key);
            }
        }
    }

    #[test]
    fn what_lies_outside_lies_so_many_standard_deviations_out_and_can_be_searched_for() {
        let mut stream = Streams::new(2, 0).of("outside");
        for mechanism in catalogue().iter().filter(|m| outside().contains(&m.name)) {
            let (_, moved) = OUTSIDE.iter().find(|(name, _)| *name == mechanism.name).expect("it is listed");
            for spreads in [2, 3, 4] {
                let values = drawn_outside(mechanism, spreads, &mut stream);
                for (p, (key, value)) in mechanism.parameters.iter().zip(&values) {
                    if moved.iter().any(|(own, _)| own == key) {
                        let own = p.spreads_out(*value).expect("it is no constant").abs();
                        assert!((own - f64::from(spreads)).abs() < 1e-9, "{}.{key}: {own}", mechanism.name);
                        assert!(
                            (0.001..0.999).contains(&p.search.cdf(*value)),
                            "{}.{key} {value}",
                            mechanism.name
                        );
                    }
                }
            }
        }
    }
}
