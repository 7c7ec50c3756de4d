//! What a solver answers, the same for all of them, and how it is told.

use serde_json::{Value, json};

use crate::exchange::WallFile;
use crate::math::{atan, degrees, ends, tan, within};
use crate::model::{Block, Level, Outcome, Support, Wall};
use crate::protocol::{JointState, Undecided};
use crate::study::Fit;
use crate::verb::analyse::ask::{Analyse, Growing};
use crate::verb::analyse::held::{Held, counted};
use crate::verb::analyse::loads::listed;
use crate::verb::analyse::solve::{LARGEST_FACTOR, LARGEST_MULTIPLIER, LARGEST_TILT_DEG};
use crate::verb::analyse::worst::Tried;
use crate::verb::analyse::{joints, open};
use crate::verb::wall::condition::resting;

/// What came of a wall.
#[derive(Clone)]
pub(crate) struct Answer {
    /// How it ended.
    pub outcome: Outcome,
    /// What the number is: a bound, or the result of a solver.
    pub meaning: String,
    /// The blocks of the collapse mechanism.
    pub moving: Vec<usize>,
    /// Blocks that carry nothing and were held; `None` where the solver does not ask.
    pub loose: Option<Vec<usize>>,
    /// Blocks that stand at rest only by forces that no weight causes.
    pub clamped: Vec<usize>,
    /// What rigid blocks leave open of the load.
    pub undecided: Option<Undecided>,
    /// Between which multipliers the answer is where the solver did not find it.
    pub between: Option<[f64; 2]>,
    /// The last load borne and the lowest at which it falls (rad or multipliers), of a solver that goes by steps.
    pub bracket: Option<[f64; 2]>,
    /// What is known of what is behind the wall; `None` under another load.
    pub held: Option<Held>,
    /// The joints at rest on the supports that went down, before the load grew; empty where none went, or the wall fell meanwhile.
    pub settled: Vec<JointState>,
}

impl Answer {
    /// The name of the outcome; a wall that bears all that was asked is stable.
    pub fn name(&self) -> &'static str {
        if self.outcome == Outcome::Equilibrium { "stable" } else { self.outcome.name() }
    }

    /// The load at collapse, as the JSON object names it: the angle in degrees or the multiplier.
    fn collapse(&self) -> (Option<f64>, Option<f64>) {
        match self.outcome {
            Outcome::Collapsed { at: Level::Tilt(angle) } => (Some(degrees(angle)), None),
            Outcome::Collapsed { at: Level::Multiplier(multiplier) | Level::Factor(multiplier) } => {
                (None, Some(multiplier))
            }
            _ => (None, None),
        }
    }

    /// The collapse multiplier alpha0, the horizontal load over the weight: of a tilt its tangent. Of what is behind the wall its height (m), of another
    /// load the factor on it.
    pub fn collapse_multiplier(&self) -> Option<f64> {
        match self.outcome {
            Outcome::Collapsed { at: Level::Tilt(angle) } => Some(tan(angle)),
            Outcome::Collapsed {
                at: Level::Multiplier(load) | Level::Factor(load) | Level::Height(load),
            } => Some(load),
            _ => None,
        }
    }

    /// The share of the settlement that the wall bears; `None` where no support goes down, or it did not come so far.
    fn settled_share(&self, asked: &Analyse) -> Option<f64> {
        match self.outcome {
            _ if asked.settlements.is_empty() => None,
            Outcome::Collapsed { at: Level::Settlement(share) } => Some(share),
            _ => (!self.settled.is_empty()).then_some(1.0),
        }
    }

    /// The largest load that it is asked for, in the unit of the answer.
    pub fn largest(&self, asked: &Analyse) -> f64 {
        match asked.growing() {
            Growing::Tilt => LARGEST_TILT_DEG,
            Growing::Lateral => LARGEST_MULTIPLIER,
            Growing::Height => self.held.map_or(0.0, |held| held.back),
            Growing::Factor => LARGEST_FACTOR,
        }
    }

    /// The last load that it bears (rad or a multiplier): 0 where it does not stand at rest, and the largest asked for where it stands.
    pub fn borne(&self, largest: f64) -> f64 {
        match &self.outcome {
            Outcome::Collapsed { at: Level::Settlement(_) } | Outcome::UnstableAtRest => 0.0,
            Outcome::Equilibrium | Outcome::Unbounded => largest,
            Outcome::Collapsed { at } | Outcome::NotConverged { at, .. } => at.value(),
            _ => 0.0,
        }
    }

    /// The bracket in the unit of the load: degrees, or multipliers.
    fn shown_bracket(&self, asked: &Analyse) -> Option<[f64; 2]> {
        self.bracket.map(|ends| match asked.growing() {
            Growing::Tilt => ends.map(degrees),
            Growing::Lateral | Growing::Height | Growing::Factor => ends,
        })
    }

    /// The share of the weight that moves at collapse.
    pub fn moving_share(&self, wall: &Wall) -> f64 {
        let weight = |block: &Block| match block.support {
            Support::Fixed => 0.0,
            _ => block.mass(),
        };
        let blocks = &wall.blocks;
        let all = blocks.iter().map(weight).fold(0.0, |sum, w| sum + w);
        self.moving.iter().map(|&i| weight(&blocks[i])).fold(0.0, |sum, w| sum + w) / all
    }

    /// Multipliers as the load is stated: tilts (deg), or multipliers.
    pub fn in_unit(&self, asked: &Analyse, ends: [f64; 2]) -> [f64; 2] {
        match asked.growing() {
            Growing::Tilt => ends.map(|x| degrees(atan(x))),
            Growing::Lateral | Growing::Height | Growing::Factor => ends,
        }
    }

    /// The warning of a wall that stands by forces that no weight causes.
    pub fn warning(&self, file: &WallFile) -> Option<String> {
        let names: Vec<&str> = self.clamped.iter().take(10).map(|&i| file.names[i].as_str()).collect();
        let dots = if self.clamped.len() > 10 { ", ..." } else { "" };
        (!names.is_empty()).then(|| {
            format!(
                "stands at rest only by forces that no weight causes, as in a bar clamped between two walls: {}{dots}; \
                 without such forces it falls: ask --solver implicit as well",
                names.join(", ")
            )
        })
    }

    /// The one JSON object.
    pub fn object(
        &self,
        asked: &Analyse,
        file: &WallFile,
        fit: &Fit,
        (warnings, directions): (&[String], &[Tried]),
        seconds: f64,
    ) -> Value {
        let (angle, multiplier) = self.collapse();
        let ids = |blocks: &[usize]| blocks.iter().map(|&i| file.ids[i]).collect::<Vec<_>>();
        json!({
            "outcome": self.name(),
            "reason": self.outcome.reason(),
            "collapse_angle_deg": angle,
            "multiplier": multiplier,
            "collapse_multiplier": self.collapse_multiplier(),
            "undecided": self.undecided.as_ref().map(|own| open::object(asked, own)),
            "between": self.between.map(|ends| self.in_unit(asked, ends)),
            "bracket": self.shown_bracket(asked),
            "bracket_unit": self.bracket.map(|_| open::unit(asked)),
            "meaning": self.meaning,
            "solver": asked.solver().name(),
            "load": asked.load.name(),
            "vertical": (asked.growing() == Growing::Lateral).then(|| asked.vertical.unwrap_or(0.0)),
            "dead_loads": listed(&asked.dead_loads, "weight_n"),
            "settlements": listed(&asked.settlements, "down_m"),
            "settled_share": self.settled_share(asked),
            "settled_joints": joints::objects(file, &self.settled, &resting(&self.settled)),
            "direction": asked.direction.to_string(),
            "direction_deg": asked.direction.angle_deg(),
            "directions": (!directions.is_empty()).then(|| {
                directions.iter().map(|of| json!({ "direction_deg": of.direction_deg, "bears": of.bears })).collect::<Vec<_>>()
            }),
            "blocks": file.wall.blocks.len(),
            "joints": fit.joints,
            "mechanism": ids(&self.moving),
            "moving_weight_share": (!self.moving.is_empty()).then(|| self.moving_share(&file.wall)),
            "fclib": asked.fclib,
            "loose": self.loose.as_deref().map(ids),
            "seconds": seconds,
            "warnings": warnings,
        })
    }

    /// What came out, in a sentence.
    pub fn headline(&self, asked: &Analyse) -> String {
        let to = asked.direction;
        let said = match (&self.outcome, asked.growing(), self.collapse()) {
            _ if self.undecided.is_some() => {
                self.undecided.as_ref().map(|own| open::headline(asked, own)).unwrap_or_default()
            }
            (Outcome::Collapsed { at: Level::Height(height) }, ..) => {
                format!("collapses at {height:.3} m of {}, which pushes it towards {to}", asked.load.name())
            }
            (_, Growing::Factor, (_, Some(factor))) => {
                format!("collapses at {factor:.4} times {} towards {to}", counted(asked))
            }
            (_, _, (Some(angle), _)) => {
                let multiplier = self.collapse_multiplier().unwrap_or_default();
                format!(
                    "collapses at a tilt of {angle:.3} deg towards {to} (collapse multiplier {multiplier:.4})"
                )
            }
            (_, _, (_, Some(multiplier))) => {
                let upwards = match asked.vertical {
                    Some(share) if share < 0.0 => format!(" and {:.5} downwards", -share * multiplier),
                    Some(share) if share > 0.0 => format!(" and {:.5} upwards", share * multiplier),
                    _ => String::new(),
                };
                format!(
                    "collapses at {multiplier:.5} of its weight towards {to}{upwards} (collapse multiplier)"
                )
            }
            (Outcome::Collapsed { at }, ..) => format!("collapses at {at}, before the load grows"),
            (Outcome::Equilibrium, Growing::Tilt, _) => format!("stands to the largest tilt towards {to}"),
            (Outcome::Equilibrium, Growing::Lateral, _) => {
                format!("stands to the largest horizontal load towards {to}")
            }
            (Outcome::Equilibrium, Growing::Height, _) => {
                self.held.map_or_else(String::new, |held| held.stands(asked))
            }
            (Outcome::Equilibrium, Growing::Factor, _) => {
                format!(
                    "stands under the most that is asked for, {LARGEST_FACTOR} times {} towards {to}",
                    counted(asked)
                )
            }
            (other, ..) => format!("is {}: {}", self.name().replace('_', " "), other.reason()),
        };
        format!("The wall {said}.")
    }

    /// The same for people: what came out, what that number is, what moves, and then the rest.
    pub fn text(&self, asked: &Analyse, file: &WallFile, fit: &Fit, seconds: f64) -> String {
        let mut text =
            format!("{}\n  {} solver: {}\n", self.headline(asked), asked.solver().name(), self.meaning);
        if let Some(held) = &self.held {
            text.push_str(&format!("  {}\n", held.line(asked)));
        }
        if let Some(own) = &self.undecided {
            text.push_str(&format!("  {}\n", own.reason()));
        }
        // A bracket whose ends read alike says no more than the load itself.
        if let Some([low, high]) = self.shown_bracket(asked).and_then(ends) {
            let unit = open::unit_in_words(asked);
            text.push_str(&format!("  bracket: {low} to {high} {unit}\n"));
        }
        if let Some(between) = self.between.map(|between| self.in_unit(asked, between)) {
            let unit = open::unit_in_words(asked);
            text.push_str(&match ends(between) {
                Some([low, high]) => format!("  between {low} and {high} {unit}\n"),
                None => format!("  near {} {unit}\n", within(between[0], 0.0)),
            });
        }
        let moves =
            format!("moves at collapse ({:.1} % of the weight)", 100.0 * self.moving_share(&file.wall));
        let loose = self.loose.as_deref().unwrap_or_default();
        for (blocks, what) in [(&self.moving[..], moves.as_str()), (loose, "loose, held lightly")] {
            if !blocks.is_empty() {
                let names: Vec<&str> = blocks.iter().take(30).map(|&i| file.names[i].as_str()).collect();
                let dots = if blocks.len() > 30 { ", ..." } else { "" };
                text.push_str(&format!("  {what}: {}{dots}\n", names.join(", ")));
            }
        }
        if !self.settled.is_empty() {
            let opened = joints::open(file, &self.settled);
            text.push_str(&format!("  open on the settled supports: {opened}\n"));
        }
        let loads = &asked.dead_loads;
        if !loads.is_empty() {
            let all = loads.iter().fold(0.0, |sum, (_, weight)| sum + weight);
            text.push_str(&format!(
                "  dead loads: {all} N on {} blocks, counted in the weight\n",
                loads.len()
            ));
        }
        let blocks = file.wall.blocks.len();
        text.push_str(&format!("  {blocks} blocks, {} joints; {seconds:.3} s\n", fit.joints));
        text
    }
}
