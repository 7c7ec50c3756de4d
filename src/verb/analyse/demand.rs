//! A wall against what is demanded of it: whether it bears it, by how much, and over ranges how surely.

use serde_json::{Value, json};

use crate::ensemble::{Failing, Met, Observed, Quantity};
use crate::math::degrees;
use crate::model::{Level, Outcome};
use crate::render::number::{or_dash, significant, with_interval};
use crate::study::Demand;
use crate::terminal::failure::Failure;
use crate::verb::analyse::answer::Answer;
use crate::verb::analyse::ask::{Analyse, FlowName, Growing};
use crate::verb::analyse::fall::Fall;
use crate::verb::analyse::open;
use crate::verb::analyse::uncertainty::UncertaintySummary;
use crate::verb::arguments::SolverName;
use crate::verb::demand::{and_unknown, of_walls};

/// Digits of a load.
const DIGITS: usize = 4;

/// What came of a demand.
pub(crate) struct Demanded {
    /// As it was stated.
    stated: String,
    /// The same in the unit of the load: degrees, a multiple of the weight, m, a factor.
    level: f64,
    /// That unit in words, and in the JSON object.
    units: [&'static str; 2],
    /// What the wall bears at least; `None` where that is not known.
    bears: Option<f64>,
    met: Met,
    /// Whether joints slip in limit analysis with dilatancy, whose number is an upper bound then: no proof that the wall bears it.
    is_upper_bound: bool,
    over: Option<Over>,
}

/// What came of it over ranges.
struct Over {
    interval: [Option<f64>; 2],
    failing: Failing,
}

/// A demand in the unit of the load.
pub(crate) fn level(asked: &Analyse, demand: &Demand) -> Result<f64, Failure> {
    let level = match asked.growing() {
        Growing::Tilt => Quantity::CollapseAngle.level(demand),
        Growing::Lateral => demand.multiplier(),
        Growing::Height => Quantity::RetainedHeight.level(demand),
        Growing::Factor => Quantity::LoadFactor.level(demand),
    };
    level.map_err(|allowed| {
        let found = format!("--demand {} does not fit --load {}", demand.stated, asked.load.name());
        Failure::Usage(format!("{found}; allowed is {allowed}"))
    })
}

impl Demanded {
    /// Of a demand at a [`level`], the answer with how the wall falls, and all walls over the ranges.
    pub fn of(
        asked: &Analyse,
        level: f64,
        (answer, fall): (&Answer, Option<Fall>),
        sure: Option<&UncertaintySummary>,
    ) -> Demanded {
        let [least, most] = borne(asked, answer);
        let met = match (least, most) {
            (Some(least), _) if least > level => Met::Bears,
            (_, Some(most)) if most <= level => Met::Fails,
            _ => Met::Unknown,
        };
        let over = sure.map(|sure| {
            let mut failing = Failing::default();
            // Loads of both kinds are the larger, the stronger.
            let met = |observed: Observed| Met::of(Quantity::CollapseAngle, level, observed);
            sure.points.iter().for_each(|(_, ended)| failing.take(met(ended.observed)));
            Over { interval: sure.answer.interval, failing }
        });
        let dilates = asked.solver() == SolverName::Limit && asked.flow != Some(FlowName::NonAssociative);
        Demanded {
            stated: asked.demanded.stated(),
            level,
            units: [open::unit_in_words(asked), open::unit(asked)],
            bears: least.filter(|own| own.is_finite()),
            met,
            is_upper_bound: dilates && fall.is_none(),
            over,
        }
    }

    /// The share of walls that is shown with 95 % confidence not to be exceeded: of a single wall none, or all.
    pub fn at_most(&self) -> f64 {
        match (&self.over, self.met) {
            (Some(over), _) => over.failing.at_most().unwrap_or(1.0),
            (None, Met::Bears) => 0.0,
            (None, Met::Fails | Met::Unknown) => 1.0,
        }
    }

    /// What the wall bears over the demand.
    fn ratio(&self) -> Option<f64> {
        self.bears.map(|bears| bears / self.level)
    }

    /// In a sentence.
    pub fn headline(&self) -> String {
        let level = significant(self.level, DIGITS);
        let asked = match self.stated == level {
            true => format!("{level} {}", self.units[0]),
            false => format!("{level} {} ({})", self.units[0], self.stated),
        };
        let bears = self.over.as_ref().and_then(|over| over.interval[0].zip(over.interval[1]));
        let bears = match bears {
            Some((low, high)) => with_interval(self.bears, Some([low, high]), DIGITS),
            None => or_dash(self.bears, DIGITS),
        };
        let ratio = self
            .ratio()
            .map_or_else(String::new, |own| format!(", {} times as much", significant(own, DIGITS)));
        let said = match (self.met, &self.over) {
            (Met::Bears, None) if self.bears.is_none() => {
                format!("stands: no load of this kind brings it down, and {asked} is asked for")
            }
            (Met::Bears, Some(over)) if over.failing.fail + over.failing.unknown > 0 => {
                format!("stands at the middle of the ranges: it bears {bears} against {asked}{ratio}")
            }
            (Met::Bears, _) => format!("stands: it bears {bears} against {asked}{ratio}"),
            (Met::Fails, _) => format!("fails: it bears {bears} against {asked}"),
            (Met::Unknown, _) => format!("is not decided: it is shown to bear {bears} against {asked}"),
        };
        let share = self.over.as_ref().map_or_else(String::new, |over| format!("; {}", fails(&over.failing)));
        format!("The wall {said}{share}.")
    }

    /// The sentence, and what it leaves out.
    pub fn text(&self) -> String {
        let caution = match self.met == Met::Bears && self.is_upper_bound {
            true => {
                "  with joints that dilate the multiplier is an upper bound: --flow non-associative asks for less\n"
            }
            false => "",
        };
        format!("{}\n{caution}", self.headline())
    }

    /// The same in the JSON object.
    pub fn object(&self) -> Value {
        let met = match self.met {
            Met::Bears => "bears",
            Met::Fails => "fails",
            Met::Unknown => "not_known",
        };
        let over = self.over.as_ref().map(|over| of_walls(&over.failing));
        json!({
            "stated": self.stated,
            "level": self.level,
            "unit": self.units[1],
            "met": met,
            "bears": self.bears,
            "ratio": self.ratio(),
            "over_ranges": over,
        })
    }
}

/// How many walls fail, of how many.
fn fails(failing: &Failing) -> String {
    let percent = |x: f64| 100.0 * x;
    let share = with_interval(failing.share().map(percent), failing.interval().map(|ci| ci.map(percent)), 2);
    let unknown = and_unknown(failing);
    format!("over the ranges it fails in {share} % of {} walls{unknown}", failing.walls)
}

/// What the wall bears at least and at most in the unit of the load, as far as it is known.
fn borne(asked: &Analyse, answer: &Answer) -> [Option<f64>; 2] {
    let largest = answer.largest(asked);
    let in_unit = |level: f64| if asked.growing() == Growing::Tilt { degrees(level) } else { level };
    if let Some(own) = &answer.undecided {
        return open::levels(asked, own);
    }
    if let Some(between) = answer.between {
        return answer.in_unit(asked, between).map(Some);
    }
    match &answer.outcome {
        Outcome::Equilibrium => [Some(largest), None],
        Outcome::Unbounded => [Some(f64::INFINITY), None],
        Outcome::UnstableAtRest => [Some(0.0), Some(0.0)],
        Outcome::Collapsed { .. } => {
            let falls = in_unit(answer.borne(largest));
            let [low, high] = answer.bracket.map_or([falls, falls], |ends| ends.map(in_unit));
            [Some(low.min(falls)), Some(high.max(falls))]
        }
        // What it bore before it was given up.
        Outcome::NotConverged {
            at: at @ (Level::Tilt(_) | Level::Multiplier(_) | Level::Height(_) | Level::Factor(_)),
            ..
        } => [Some(in_unit(at.value())), None],
        Outcome::NotConverged { .. } => [Some(0.0), None],
        Outcome::NonFinite { .. } | Outcome::InvalidGeometry { .. } => [None, None],
    }
}
