//! A verification in words and in the JSON object.

use std::path::Path;
use std::rc::Rc;

use serde_json::{Value, json};

use crate::ensemble::replace_file;
use crate::render::csv::Csv;
use crate::render::document::Drawing;
use crate::render::draw::svg;
use crate::render::number::{significant, with_interval};
use crate::solve::STANDARD_GRAVITY;
use crate::study::Site;
use crate::terminal::failure::Failure;
use crate::verb::analyse::verify::figure::figure;
use crate::verb::analyse::verify::over::Over;
use crate::verb::analyse::verify::work::Checked;
use crate::verb::demand::{and_unknown, of_walls};
use crate::verify::ByDisplacement;

/// Digits of a ratio and of a length.
const DIGITS: usize = 3;

/// A wall verified, or why it is not.
pub(crate) struct Verification {
    /// What it was checked against.
    pub site: Site,
    /// What came of it.
    pub(super) checked: Result<Checked, String>,
    /// Over the ranges.
    pub(super) over: Option<Over>,
}

impl Verification {
    /// In a sentence.
    pub fn headline(&self) -> String {
        let code = &self.site.code.name;
        let checked = match &self.checked {
            Ok(checked) => checked,
            Err(why) => return format!("The wall is not verified by {code}: {why}."),
        };
        let first = &checked.verified.nonlinear[0];
        let is = if first.ratio() >= 1.0 { "is" } else { "is not" };
        let ratio = match self.over.as_ref().and_then(|over| over.interval[0].zip(over.interval[1])) {
            Some((low, high)) => with_interval(Some(first.ratio()), Some([low, high]), DIGITS),
            None => significant(first.ratio(), DIGITS),
        };
        let over = self.over.as_ref().map_or_else(String::new, |over| {
            let unknown = and_unknown(&over.failing);
            format!(
                "; over the ranges it is not in {} of {} walls{unknown}",
                over.failing.fail, over.failing.walls
            )
        });
        format!(
            "The wall {is} verified for {} by {code}: it takes {ratio} times the motion of the ground{over}.",
            first.state
        )
    }

    /// The sentence, the checks and what they rest on.
    pub fn text(&self) -> String {
        let headline = self.headline();
        let Ok(checked) = &self.checked else { return format!("{headline}\n") };
        let (mechanism, verified) = (&checked.mechanism, &checked.verified);
        let in_g = |a: f64| format!("{} g", significant(a / STANDARD_GRAVITY, DIGITS));
        let in_mm = |d: f64| format!("{} mm", significant(1e3 * d, DIGITS));
        let linear = &verified.linear;
        let line = |check: String, [bears, asked]: [String; 2], ratio: f64| {
            format!("  {check}: bears {bears} of {asked} asked, ratio {}\n", significant(ratio, DIGITS))
        };
        let q = self.site.code.behaviour_factor;
        let by_acceleration = [linear.capacity, linear.demand].map(in_g);
        let mut checks = line(format!("acceleration, q = {q}"), by_acceleration, linear.ratio());
        for own in &verified.nonlinear {
            let check = format!("displacement, {} at T = {} s", own.state, significant(own.period, DIGITS));
            checks += &line(check, [own.capacity, own.demand].map(in_mm), own.ratio());
        }
        let oscillator = &mechanism.oscillator;
        let mut text = format!(
            "{headline}\n{checks}  mechanism: {}, {:.1} % of the weight; alpha0 = {:.4}, e* = {:.3}, M* = {} kg, a0* = {} m/s^2 with a confidence factor of {}\n",
            mechanism.name,
            100.0 * mechanism.share,
            mechanism.multiplier,
            oscillator.share,
            significant(oscillator.mass, DIGITS),
            significant(linear.sets_in, 4),
            self.site.confidence
        );
        text += &match (verified.is_whole, checked.rigid) {
            (false, _) => format!("  followed to d* = {} only: d0* is at least that\n", in_mm(verified.d0)),
            (true, None) => format!("  it bears nothing any more at d0* = {}\n", in_mm(verified.d0)),
            (true, Some(rigid)) => format!(
                "  it bears nothing any more at d0* = {}; as rigid blocks, by limit analysis of the wall as it leans, at {}\n",
                in_mm(verified.d0),
                in_mm(rigid)
            ),
        };
        if let Some([back, on]) = checked.turns {
            let (back, on) = (in_mm(back), in_mm(on));
            text += &format!(
                "  let go at d* = {back} rigid blocks return, and at {on} they fall, by contact dynamics\n"
            );
        }
        text += &match (self.site.held, self.site.period) {
            (true, _) => "  held until the mechanism sets in\n".to_owned(),
            (false, Some(period)) => {
                format!("  stands free, with a period of {period} s before the mechanism sets in\n")
            }
            (false, None) => format!(
                "  stands free, with a period of at most {} s before the mechanism sets in, that of the softest joints\n",
                significant(checked.shakes, 2)
            ),
        };
        text
    }

    /// The same in the JSON object.
    pub fn object(&self) -> Value {
        let over = self.over.as_ref().map(|over| {
            let mut walls = of_walls(&over.failing);
            walls["ratio_interval"] = json!(over.interval);
            walls
        });
        let (verified, why) = match &self.checked {
            Ok(checked) => (Some(self.numbers(checked)), None),
            Err(why) => (None, Some(why)),
        };
        json!({
            "code": self.site.code.name,
            "sha256": self.site.sha256,
            "confidence_factor": self.site.confidence,
            "verified": verified,
            "why_not": why,
            "over_ranges": over,
        })
    }

    fn numbers(&self, checked: &Checked) -> Value {
        let (mechanism, verified) = (&checked.mechanism, &checked.verified);
        let state = |own: &ByDisplacement| {
            json!({
                "state": own.state,
                "is_met": own.ratio() >= 1.0,
                "capacity_m": own.capacity,
                "demand_m": own.demand,
                "period_s": own.period,
                "ratio": own.ratio(),
            })
        };
        json!({
            "mechanism": mechanism.name,
            "moving_weight_share": mechanism.share,
            "alpha0": mechanism.multiplier,
            "e_star": mechanism.oscillator.share,
            "m_star_kg": mechanism.oscillator.mass,
            "a0_m_per_s2": verified.linear.sets_in,
            "d0_m": verified.d0,
            "d0_is_lower_bound": !verified.is_whole,
            "d0_rigid_m": checked.rigid,
            "let_go_m": checked.turns,
            "longest_period_at_rest_s": checked.shakes,
            "acceleration": {
                "behaviour_factor": self.site.code.behaviour_factor,
                "is_met": verified.linear.ratio() >= 1.0,
                "capacity_m_per_s2": verified.linear.capacity,
                "demand_m_per_s2": verified.linear.demand,
                "ratio": verified.linear.ratio(),
            },
            "displacement": verified.nonlinear.iter().map(state).collect::<Vec<_>>(),
            "capacity_curve": checked.curve.points(),
        })
    }

    /// The figure for a page; `None` where nothing was checked.
    pub fn drawing(&self) -> Option<Drawing> {
        let caption = "What the mechanism bears as it leans out, and what the ground asks of an oscillator that moves so far. Markers: the \
                       displacements that the code allows.";
        Some(Drawing::picture(
            "figure-verification",
            "What the mechanism bears and what is asked",
            caption,
            &self.svg()?,
        ))
    }

    /// Writes `verification.svg` and the capacity curve, `verification.csv`, into a folder.
    pub fn write(&self, folder: &Path) -> Result<(), Failure> {
        let Ok(checked) = &self.checked else { return Ok(()) };
        let mut csv = Csv::new("displacement_m,acceleration_m_per_s2");
        checked.curve.points().iter().for_each(|[d, a]| csv.line(&[d, a]));
        let files = [Some(("csv", csv.text())), self.svg().map(|svg| ("svg", svg))];
        for (ending, text) in files.into_iter().flatten() {
            replace_file(&folder.join(format!("verification.{ending}")), text.as_bytes())?;
        }
        Ok(())
    }

    fn svg(&self) -> Option<String> {
        let checked = self.checked.as_ref().ok()?;
        let code = &self.site.code;
        let mut spectra = vec![(code.life.name.as_str(), &self.site.life, code.life.damping_percent)];
        if let (Some(state), Some(spectrum)) = (&code.collapse, &self.site.collapse) {
            spectra.push((state.name.as_str(), spectrum, state.damping_percent));
        }
        svg(&Rc::new(figure(checked, (&code.name, &self.site.place), &spectra)).at(1)).ok()
    }
}
