//! Limit analysis of the same walls as a solver's: what it says of all walls of an arm, and whether the solver's answers go with it.

use crate::ensemble::LimitAnalysis;
use crate::render::number::significant;

/// The answers of limit analysis on the walls of one arm at one stiffness.
#[derive(Clone, Debug, Default, PartialEq, serde::Serialize)]
pub struct Bounded {
    /// Walls with a bound: of associative flow, the tilt of collapse (deg), or a factor on the load.
    pub walls: u64,
    /// Unit of the bounds, `deg` or `1`; null where no wall has one.
    pub unit: Option<&'static str>,
    /// The lowest bound.
    pub lowest: Option<f64>,
    /// The highest one.
    pub highest: Option<f64>,
    /// Walls that bore more than their bound by the solver: one of the two is wrong.
    pub above_bound: u64,
    /// Walls that stand under their weight by one of the two alone.
    pub one_stands: u64,
    /// Walls of which one of the two has no answer.
    pub no_answer: u64,
}

impl Bounded {
    /// Takes what limit analysis says of the next wall.
    pub fn take(&mut self, limit: &LimitAnalysis) {
        let bound = limit.angle_deg.map(|x| (x, "deg")).or(limit.multiplier.map(|x| (x, "1")));
        if let Some((bound, unit)) = bound {
            self.walls += 1;
            self.unit = Some(unit);
            self.lowest = Some(self.lowest.map_or(bound, |lowest| lowest.min(bound)));
            self.highest = Some(self.highest.map_or(bound, |highest| highest.max(bound)));
        }
        match limit.agreement.name() {
            "above_bound" => self.above_bound += 1,
            "one_stands" => self.one_stands += 1,
            "no_answer" => self.no_answer += 1,
            _ => {}
        }
    }

    /// In a sentence.
    pub fn words(&self) -> String {
        let of = |count: u64, what: &str| if count > 0 { format!(", {count} {what}") } else { String::new() };
        let (walls, unit) = (self.walls, if self.unit == Some("deg") { " deg" } else { " times the load" });
        let range = match (self.lowest, self.highest) {
            (Some(low), Some(high)) if low < high => {
                format!("{} to {}{unit} ({walls} walls)", significant(low, 4), significant(high, 4))
            }
            (Some(low), _) => format!("{}{unit} ({walls} of them)", significant(low, 4)),
            _ => "no bound".to_owned(),
        };
        format!(
            "limit analysis of the same walls: {range}; {} bore more than their bound{}{}",
            self.above_bound,
            of(self.one_stands, "stand by one of the two alone"),
            of(self.no_answer, "without an answer of one of the two")
        )
    }
}
