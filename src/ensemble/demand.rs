//! Whether walls bear what is demanded of them.

use crate::ensemble::{Observed, Quantity};
use crate::math::{atan, degrees, tan};
use crate::solve::STANDARD_GRAVITY;
use crate::stats::clopper_pearson_at;
use crate::study::{Amount, Demand, Measure};

/// Probability of the interval of a share.
const LEVEL: f64 = 0.95;

impl Quantity {
    /// A demand in the unit of the quantity. A push of a share of the weight is a tilt by the angle of which that share is the tangent.
    ///
    /// # Errors
    /// What is allowed, where the demand is of something else.
    pub fn level(self, demand: &Demand) -> Result<f64, &'static str> {
        match (self, demand.amount) {
            (Quantity::CollapseAngle, Amount::Tilt(tilt)) => Ok(degrees(tilt)),
            (Quantity::CollapseAngle, Amount::Factor(share) | Amount::Gravity(share)) => {
                Ok(degrees(atan(share)))
            }
            (Quantity::CollapseAngle, Amount::Acceleration(own)) => Ok(degrees(atan(own / STANDARD_GRAVITY))),
            (Quantity::CollapseAngle, _) => Err("a tilt (8.5deg) or a share of the weight (0.15g)"),
            (Quantity::TopDisplacement, Amount::Length(own)) => Ok(own),
            (Quantity::TopDisplacement, _) => Err("a displacement (4mm)"),
            (Quantity::ShearCapacity, Amount::Force(own)) => Ok(own),
            (Quantity::ShearCapacity, _) => Err("a force (12kN)"),
            (Quantity::LoadFactor, Amount::Factor(own)) => Ok(own),
            (Quantity::LoadFactor, _) => Err("a multiple of the full load (1.2)"),
            (Quantity::RetainedHeight, Amount::Length(own)) => Ok(own),
            (Quantity::RetainedHeight, _) => Err("a height (2.1m)"),
            (Quantity::CollapseIntensity(Measure::Pga), Amount::Gravity(own)) => Ok(own * STANDARD_GRAVITY),
            (Quantity::CollapseIntensity(Measure::Pga), Amount::Acceleration(own)) => Ok(own),
            (Quantity::CollapseIntensity(Measure::Pga), _) => Err("an acceleration (0.15g, 1.5m/s2)"),
            (Quantity::CollapseIntensity(Measure::Pgv), Amount::Speed(own)) => Ok(own),
            (Quantity::CollapseIntensity(Measure::Pgv), _) => Err("a velocity (0.3m/s)"),
        }
    }
}

impl Demand {
    /// As a horizontal push, a multiple of the weight; that of a tilt is its tangent.
    ///
    /// # Errors
    /// What is allowed, where the demand is of something else.
    pub fn multiplier(&self) -> Result<f64, &'static str> {
        match self.amount {
            Amount::Factor(share) | Amount::Gravity(share) => Ok(share),
            Amount::Acceleration(own) => Ok(own / STANDARD_GRAVITY),
            Amount::Tilt(tilt) => Ok(tan(tilt)),
            Amount::Length(_) | Amount::Force(_) | Amount::Speed(_) => {
                Err("a share of the weight (0.15g) or a tilt (8.5deg)")
            }
        }
    }
}

/// What a wall says about a demand.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Met {
    /// It bears it.
    Bears,
    /// It does not. A wall that falls at the demand itself is one of these.
    Fails,
    /// It is not known.
    Unknown,
}

impl Met {
    /// Of what a wall shows of a quantity, against a level in its unit.
    pub fn of(quantity: Quantity, level: f64, observed: Observed) -> Met {
        let wanted = quantity.strength(level);
        match observed {
            Observed::Value(value) if quantity.strength(value) > wanted => Met::Bears,
            Observed::Value(_) => Met::Fails,
            Observed::Above(limit) if limit >= level && quantity != Quantity::TopDisplacement => Met::Bears,
            Observed::Above(_) | Observed::Nothing => Met::Unknown,
        }
    }
}

/// How many walls do not bear a demand.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize)]
pub struct Failing {
    /// Walls that do not bear it.
    pub fail: usize,
    /// Walls of which it is not known.
    pub unknown: usize,
    /// All of them.
    pub walls: usize,
}

impl Failing {
    /// Counts one more.
    pub fn take(&mut self, met: Met) {
        self.walls += 1;
        match met {
            Met::Bears => {}
            Met::Fails => self.fail += 1,
            Met::Unknown => self.unknown += 1,
        }
    }

    /// The share that fails, of those of which it is known.
    pub fn share(&self) -> Option<f64> {
        let known = self.walls - self.unknown;
        (known > 0).then(|| self.fail as f64 / known as f64)
    }

    /// Its 95 % interval (Clopper and Pearson): at its lower end all walls of which nothing is known bear the demand, at its upper end none
    /// does. Of a design that fills its space evenly it is wider than need be.
    pub fn interval(&self) -> Option<[f64; 2]> {
        self.at(LEVEL)
    }

    /// The share that the walls show with 95 % confidence not to be exceeded.
    pub fn at_most(&self) -> Option<f64> {
        self.at(1.0 - 2.0 * (1.0 - LEVEL)).map(|[_, high]| high)
    }

    fn at(&self, level: f64) -> Option<[f64; 2]> {
        let of = |fail: usize| clopper_pearson_at(fail, self.walls, level);
        (self.walls > 0).then(|| [of(self.fail)[0], of(self.fail + self.unknown)[1]])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn demand(text: &str) -> Demand {
        text.parse().unwrap()
    }

    #[test]
    fn a_demand_is_taken_in_the_unit_of_what_is_observed() {
        let angle = |text: &str| Quantity::CollapseAngle.level(&demand(text));
        assert_eq!(angle("45deg"), Ok(45.0));
        assert!((angle("1g").unwrap() - 45.0).abs() < 1e-12 && (angle("1").unwrap() - 45.0).abs() < 1e-12);
        assert!((angle("9.80665m/s2").unwrap() - 45.0).abs() < 1e-12);
        assert!(angle("4mm").unwrap_err().contains("8.5deg"));
        assert_eq!(Quantity::TopDisplacement.level(&demand("4mm")), Ok(4e-3));
        assert_eq!(Quantity::ShearCapacity.level(&demand("12kN")), Ok(12e3));
        assert_eq!(Quantity::LoadFactor.level(&demand("120%")), Ok(1.2));
        assert!(Quantity::LoadFactor.level(&demand("0.15g")).is_err(), "a load is no multiple of gravity");
        assert_eq!(Quantity::RetainedHeight.level(&demand("2.1m")), Ok(2.1));
        assert_eq!(Quantity::CollapseIntensity(Measure::Pga).level(&demand("0.1g")), Ok(0.980_665));
        assert_eq!(Quantity::CollapseIntensity(Measure::Pgv).level(&demand("0.3m/s")), Ok(0.3));
        assert!((demand("45deg").multiplier().unwrap() - 1.0).abs() < 1e-15);
        assert!(demand("4mm").multiplier().is_err());
    }

    #[test]
    fn walls_bear_a_demand_below_what_they_fall_at() {
        let met = |observed| Met::of(Quantity::CollapseAngle, 10.0, observed);
        assert_eq!(met(Observed::Value(10.1)), Met::Bears);
        assert_eq!(met(Observed::Value(10.0)), Met::Fails);
        assert_eq!(met(Observed::Above(10.0)), Met::Bears);
        assert_eq!(met(Observed::Above(9.0)), Met::Unknown);
        assert_eq!(met(Observed::Nothing), Met::Unknown);
        let moved = |observed| Met::of(Quantity::TopDisplacement, 4e-3, observed);
        assert_eq!(moved(Observed::Value(3e-3)), Met::Bears);
        assert_eq!(moved(Observed::Value(5e-3)), Met::Fails);
        assert_eq!(moved(Observed::Above(5e-3)), Met::Unknown);
    }

    #[test]
    fn the_share_that_fails_has_its_interval_and_what_is_not_known_widens_it() {
        // Five of 32: 15.6 % [5.3, 32.8].
        let five = Failing { fail: 5, unknown: 0, walls: 32 };
        let [low, high] = five.interval().unwrap();
        assert!((five.share().unwrap() - 0.156_25).abs() < 1e-12);
        assert!((low - 0.0528).abs() < 1e-3 && (high - 0.3279).abs() < 1e-3, "{low} {high}");
        let vague = Failing { fail: 5, unknown: 3, walls: 35 };
        let [wide, wider] = vague.interval().unwrap();
        assert!(wide < low && wider > high && vague.share() == five.share());
        // 59 walls of which none fails are the least that show 95 % with a confidence of 95 %.
        let none = |walls| Failing { fail: 0, unknown: 0, walls };
        assert!(none(59).at_most().unwrap() <= 0.05 && none(58).at_most().unwrap() > 0.05);
        assert_eq!(none(0).interval(), None);
    }

    /// Shares of 1,000 synthetic samples: the interval holds the true one at least as often as it says.
    #[test]
    fn the_interval_of_a_share_covers_it() {
        use crate::random::Streams;
        let held = (0..1000).filter(|sample| {
            let mut draws = Streams::new(7, *sample).of("demand");
            let truth = 0.02 + 0.5 * draws.uniform();
            let mut failing = Failing::default();
            (0..60).for_each(|_| failing.take(if draws.uniform() < truth { Met::Fails } else { Met::Bears }));
            let [low, high] = failing.interval().unwrap();
            (low..=high).contains(&truth)
        });
        let held = held.count();
        // 95 % and more: the interval is exact, hits are whole numbers.
        assert!((950..=985).contains(&held), "{held}");
    }
}
