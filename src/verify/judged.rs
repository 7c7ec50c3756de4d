//! What a mechanism can take against what the ground asks of it.

use std::f64::consts::PI;

use crate::verify::code::{Code, LimitState};
use crate::verify::curve::CapacityCurve;
use crate::verify::oscillator::Oscillator;
use crate::verify::place::Place;
use crate::verify::spectrum::Spectrum;

/// Damping (%) of a wall before its mechanism sets in (C8.7.1.2.1.5).
const ELASTIC: f64 = 5.0;
/// Parts into which periods are divided where the largest acceleration is looked for.
const FINE: u32 = 200;

/// What a mechanism is checked against.
#[derive(Clone, Debug, PartialEq)]
pub struct Demanded {
    /// The code.
    pub code: Code,
    /// Confidence factor.
    pub confidence: f64,
    /// Spectrum for the state in which life is safe.
    pub life: Spectrum,
    /// Spectrum for the state before collapse, where that is to be checked as well.
    pub collapse: Option<Spectrum>,
    /// Where the wall stands.
    pub place: Place,
    /// What it does before the mechanism sets in.
    pub before: BeforeIt,
}

/// What a wall does before its mechanism sets in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum BeforeIt {
    /// It is held by what it is built into: it goes with the place where it stands.
    Held,
    /// It stands free and shakes at a period (s).
    Shakes(f64),
    /// It stands free, and its period is no longer than this (s): the largest acceleration up to there is asked of it.
    UpTo(f64),
}

impl Demanded {
    /// The acceleration (m/s^2) asked of the wall before the mechanism sets in.
    fn sets_in_by(&self, spectrum: &Spectrum) -> f64 {
        let at = |period: f64| self.place.acceleration(spectrum, period, ELASTIC);
        match self.before {
            BeforeIt::Held => self.place.peak(spectrum),
            BeforeIt::Shakes(period) => at(period),
            BeforeIt::UpTo(longest) => {
                let periods = (0..=FINE).map(|k| longest * f64::from(k) / f64::from(FINE));
                periods.map(at).fold(0.0, f64::max)
            }
        }
    }

    /// The period (s) from which the wall begins to lean out.
    fn period(&self) -> f64 {
        match self.before {
            BeforeIt::Held => 0.0,
            BeforeIt::Shakes(period) | BeforeIt::UpTo(period) => period,
        }
    }
}

/// A check by acceleration, with a behaviour factor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ByAcceleration {
    /// Acceleration (m/s^2) at which the mechanism sets in.
    pub sets_in: f64,
    /// The same times the behaviour factor.
    pub capacity: f64,
    /// Acceleration (m/s^2) asked of it.
    pub demand: f64,
}

/// A check by displacement of one limit state.
#[derive(Clone, Debug, PartialEq)]
pub struct ByDisplacement {
    /// The limit state.
    pub state: String,
    /// Displacement (m) of the oscillator that it allows.
    pub capacity: f64,
    /// Secant period (s).
    pub period: f64,
    /// Displacement (m) asked of it.
    pub demand: f64,
    /// How many times the ground's motion brings the mechanism about.
    pub sets_in: f64,
}

/// A mechanism checked.
#[derive(Clone, Debug, PartialEq)]
pub struct Verified {
    /// By acceleration.
    pub linear: ByAcceleration,
    /// Displacement (m) of the oscillator at which it bears nothing any more, or how far it could be followed.
    pub d0: f64,
    /// Whether it was followed to there: else `d0` is a lower bound, on the safe side.
    pub is_whole: bool,
    /// By displacement: the state in which life is safe first.
    pub nonlinear: Vec<ByDisplacement>,
}

impl ByAcceleration {
    /// How many times the demand it bears.
    pub fn ratio(&self) -> f64 {
        self.capacity / self.demand
    }
}

impl ByDisplacement {
    /// How many times the ground's motion it takes: by displacement, or as long as the mechanism does not set in (C8.7.1.2.1.8).
    pub fn ratio(&self) -> f64 {
        (self.capacity / self.demand).max(self.sets_in)
    }
}

/// A mechanism that sets in at a multiplier, checked; its capacity curve holds the confidence factor already.
pub fn judge(
    oscillator: &Oscillator,
    multiplier: f64,
    curve: &CapacityCurve,
    demanded: &Demanded,
) -> Verified {
    let sets_in = oscillator.acceleration(multiplier, demanded.confidence);
    let whole = curve.ends_at();
    let d0 = whole.unwrap_or_else(|| curve.known_to());
    let checked = |state: &LimitState, spectrum: &Spectrum| {
        let capacity = state.capacity_share * d0;
        let secant = state.secant_share * capacity;
        // Before the mechanism sets in the wall is stiffer than on its way down: where the curve has no such point, the peak stands for it.
        let bears = curve.at(secant).unwrap_or_else(|| curve.peak());
        let period = state.period_factor * PI * (secant / bears).sqrt();
        let from = demanded.period().min(period);
        let demand = demanded.place.displacement(spectrum, [from, period], state.damping_percent);
        ByDisplacement {
            state: state.name.clone(),
            capacity,
            period,
            demand,
            sets_in: sets_in / demanded.sets_in_by(spectrum),
        }
    };
    let mut nonlinear = vec![checked(&demanded.code.life, &demanded.life)];
    if let (Some(state), Some(spectrum)) = (&demanded.code.collapse, &demanded.collapse) {
        nonlinear.push(checked(state, spectrum));
    }
    let linear = ByAcceleration {
        sets_in,
        capacity: demanded.code.behaviour_factor * sets_in,
        demand: demanded.sets_in_by(&demanded.life),
    };
    Verified { linear, d0, is_whole: whole.is_some(), nonlinear }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::STANDARD_GRAVITY;
    use crate::verify::{Corners, Moving};

    fn demanded(code: Code) -> Demanded {
        let corners = Corners { b: 0.15, c: 0.45, d: 2.2 };
        Demanded {
            code,
            confidence: 1.0,
            life: Spectrum::Ntc { ag: 0.15, soil: 1.2, f0: 2.4, corners },
            collapse: None,
            place: Place::Ground,
            before: BeforeIt::Held,
        }
    }

    /// A rigid block of width `b` and height `h`: it sets in at `b / h` of its weight and is spent when its centroid is above its edge.
    fn block([b, h]: [f64; 2], code: Code) -> Verified {
        let oscillator = Oscillator::of(&[Moving { weight: 1.0, delta: 1.0 }], 1.0).expect("it moves");
        let a0 = oscillator.acceleration(b / h, 1.0);
        let curve = CapacityCurve::of([[0.0, a0], [b, -a0]]);
        judge(&oscillator, b / h, &curve, &demanded(code))
    }

    /// Secant periods of Circolare 617/2009 for two blocks; with the gravity of 9.81 m/s^2 of the reference numbers they are 0.6782 and 1.0723 s.
    #[test]
    fn a_block_has_the_period_of_its_secant() {
        let gravity = (9.81 / STANDARD_GRAVITY).sqrt();
        for (size, d0, period) in [([0.4, 1.2], 0.2, 0.6782), ([0.45, 3.0], 0.225, 1.0723)] {
            let found = block(size, Code::circolare_2009());
            assert!((found.d0 - d0).abs() < 1e-12, "{found:?}");
            assert!((found.nonlinear[0].period - period * gravity).abs() < 1e-4, "{found:?}");
            assert!((found.linear.sets_in - size[0] / size[1] * STANDARD_GRAVITY).abs() < 1e-12, "{found:?}");
        }
    }

    /// `T_SLV = 1.68 pi sqrt(0.4 d0 / (0.6 a0))`, and the demand is the spectrum's displacement there with 8 % of damping.
    #[test]
    fn the_circolare_of_2019_takes_four_tenths_of_the_way() {
        let found = block([0.4, 1.2], Code::ntc_2018());
        let period = 1.68 * PI * (0.08 / (0.6 * found.linear.sets_in)).sqrt();
        let state = &found.nonlinear[0];
        assert!((state.period - period).abs() < 1e-12, "{state:?}");
        assert!((state.capacity - 0.08).abs() < 1e-12, "{state:?}");
        let wanted = demanded(Code::ntc_2018()).life.displacement([0.0, period], 8.0);
        assert!((state.demand - wanted).abs() < 1e-15, "{state:?}");
        // 0.18 g on the ground do not move a block that sets in at a third of its weight.
        assert!((state.sets_in - 1.0 / 3.0 / 0.18).abs() < 1e-12, "{state:?}");
        assert!((found.linear.ratio() - 2.0 / 3.0 / 0.18).abs() < 1e-12, "{found:?}");
    }

    /// Of a wall that stands free with a period up to the plateau the plateau is asked, of one with a long period what the spectrum has there.
    #[test]
    fn a_wall_that_stands_free_is_asked_for_the_spectrum() {
        let at = |before| Demanded { before, ..demanded(Code::ntc_2018()) };
        let asked = |before| {
            let own = at(before);
            own.sets_in_by(&own.life) / STANDARD_GRAVITY
        };
        assert!((asked(BeforeIt::Held) - 0.18).abs() < 1e-12);
        assert!((asked(BeforeIt::UpTo(0.3)) - 0.432).abs() < 1e-12);
        assert!((asked(BeforeIt::UpTo(0.075)) - 0.306).abs() < 1e-12);
        assert!((asked(BeforeIt::Shakes(0.9)) - 0.216).abs() < 1e-12);
    }

    #[test]
    fn a_curve_that_was_lost_counts_as_far_as_it_is_known() {
        let oscillator = Oscillator::of(&[Moving { weight: 1.0, delta: 1.0 }], 1.0).expect("it moves");
        let curve = CapacityCurve::of([[0.0, 3.0], [0.1, 1.5]]);
        let found = judge(&oscillator, 0.3, &curve, &demanded(Code::ntc_2018()));
        assert_eq!((found.d0, found.is_whole), (0.1, false));
    }
}
