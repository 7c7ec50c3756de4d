//! What is told of a wall that holds something back.

use serde_json::{Value, json};

use crate::math::{degrees, significant};
use crate::model::{Level, Outcome};
use crate::protocol::{Retained, WATER};
use crate::verb::analyse::ask::Analyse;
use crate::verb::analyse::held::pressing::retained;
use crate::verb::analyse::solve::LARGEST_FACTOR;

/// What is known of the back of a wall and of what is behind it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Held {
    /// Height of the back (m).
    pub back: f64,
    /// Its lean (rad), above 0 away from the fill.
    pub lean: f64,
    /// Coefficient of the pressure of soil; `None` of water.
    pub coefficient: Option<f64>,
    /// How many times the pressure of the height of the back a wall bears that stands to its top, by limit analysis; `None` of other solvers, and infinite where
    /// no pressure of this kind brings it down.
    pub margin: Option<f64>,
}

impl Held {
    /// In the JSON object.
    pub fn object(&self, outcome: &Outcome) -> Value {
        let height = match outcome {
            Outcome::Collapsed { at: Level::Height(height) } => Some(*height),
            _ => None,
        };
        json!({
            "collapse_height_m": height,
            "back_height_m": self.back,
            "back_lean_deg": degrees(self.lean),
            "pressure_coefficient": self.coefficient,
            "margin": self.margin.filter(|margin| margin.is_finite()),
        })
    }

    /// That a wall stands with something behind it up to its top.
    pub fn stands(&self, asked: &Analyse) -> String {
        let margin = match self.margin {
            Some(margin) if margin.is_infinite() => "; no such pressure brings it down".to_owned(),
            Some(margin) if margin >= LARGEST_FACTOR => {
                format!("; it bears {LARGEST_FACTOR} times that pressure or more")
            }
            Some(margin) => format!("; it bears {margin:.2} times that pressure"),
            None => String::new(),
        };
        format!(
            "stands with {} up to the top of its back, {:.3} m, towards {}{margin}",
            asked.load.name(),
            self.back,
            asked.direction
        )
    }

    /// What presses, in a line.
    pub fn line(&self, asked: &Analyse) -> String {
        // What rounds to 0 has no sign.
        let lean = Some(degrees(self.lean)).filter(|lean| lean.abs() >= 0.05).unwrap_or(0.0);
        let back = format!("back {:.3} m high, leaning {lean:.1} deg", self.back);
        match retained(asked) {
            Some(Retained::Fill(fill)) => {
                let rubs = match fill.wall_friction {
                    0.0 => "no friction on the back".to_owned(),
                    _ => format!("friction {:.1} deg on the back", degrees(fill.delta())),
                };
                let water = if fill.drained { "drained" } else { "water up to its surface" };
                let slope = match fill.slope {
                    0.0 => "level".to_owned(),
                    slope => format!("at a slope of {} deg", significant(degrees(slope), 4)),
                };
                let surcharge = match fill.surcharge {
                    0.0 => String::new(),
                    weight => format!(", {weight} Pa on it"),
                };
                format!(
                    "fill: {} kg/m^3, {} deg, {rubs}, {slope}{surcharge}, {water}; pressure coefficient {:.4}; {back}",
                    fill.density,
                    significant(degrees(fill.phi), 4),
                    self.coefficient.unwrap_or(f64::NAN)
                )
            }
            _ => format!("water of {} kg/m^3; {back}", WATER),
        }
    }
}

/// The load that a factor counts, in words.
pub(crate) fn counted(asked: &Analyse) -> String {
    let behind = &asked.behind;
    let down = behind.crest_down_deg.filter(|down| *down != 0.0);
    let down = down.map_or_else(String::new, |down| format!(", {down} deg below the horizontal"));
    match (behind.pressure_pa, behind.crest_force, behind.crest_line) {
        (Some(mean), ..) => format!("a mean pressure of {mean} Pa"),
        (_, Some(force), _) => format!("{force} N on its crest{down}"),
        (_, _, Some(line)) => format!("{line} N/m along its crest{down}"),
        _ => String::new(),
    }
}
