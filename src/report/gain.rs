//! What the extended model gains on readings that it has not seen, in the units and words of files.

use crate::critic::{Design, Gain, Gained, HeldOut, Interval, Scores};
use crate::report::number::significant;
use crate::study::{Described, Study};

/// The gain.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct GainSummary {
    /// Every specimen left out in turn; null for fewer than two.
    pub specimens_left_out: Option<GainedEntry>,
    /// The largest tilts and the collapse angles of all specimens left out; null where nothing is left then.
    pub largest_tilts_left_out: Option<GainedEntry>,
    /// All families left out but one.
    pub one_family_known: Vec<FamilyEntry>,
    /// What was chosen in each fold, from what was known there.
    pub choices: Vec<ChoiceEntry>,
    /// Campaigns without any effect that the intervals are widened by.
    pub nulls: u64,
}

/// A gain on readings that were held out. Scores and errors in standard deviations of the base model's readings.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct GainedEntry {
    /// Readings scored.
    pub readings: usize,
    /// Specimens that they were read on.
    pub specimens: usize,
    /// The base model.
    pub base: ScoresEntry,
    /// The extended model.
    pub extended: ScoresEntry,
    /// The base model with a discrepancy that is free to be anything smooth: what there is to be gained.
    pub ceiling: ScoresEntry,
    /// Gain in the logarithm of the probability, per reading.
    pub log_score: GainEntry,
    /// Gain in the continuous ranked probability score.
    pub crps: GainEntry,
    /// Gain in the root of the mean square error.
    pub rmse: GainEntry,
}

/// Scores of a model.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct ScoresEntry {
    /// Mean logarithm of the probability (or its density) given to a reading; large is good.
    pub log_score: f64,
    /// Mean continuous ranked probability score; small is good.
    pub crps: f64,
    /// Root of the mean square error of the predicted means; small is good.
    pub rmse: f64,
}

/// A gain; above 0 is better.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct GainEntry {
    /// The gain.
    pub value: f64,
    /// 95 % interval; campaigns without any effect lie wholly above 0 in no more than one case in twenty.
    pub interval: [f64; 2],
}

/// What is gained on all other families.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct FamilyEntry {
    /// The family that is known.
    pub family: String,
    /// The gain.
    pub gained: GainedEntry,
}

/// What was chosen in a fold.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct ChoiceEntry {
    /// The specimen that was left out, "largest tilts", or "all but" a family.
    pub left_out: String,
    /// The mechanisms with their shares of the extended model; none where nothing was found.
    pub causes: Vec<ShareEntry>,
}

/// A part of a mixture.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct ShareEntry {
    /// The mechanism.
    pub cause: &'static str,
    /// Its share of the extended model.
    pub share: f64,
}

impl GainSummary {
    /// From a gain measured on a design.
    pub fn of(gain: &Gain, study: &Study, design: &Design, mechanisms: &[Described]) -> GainSummary {
        let name = |family: usize| study.arms[family].name.clone();
        let choices = gain.choices.iter().map(|choice| ChoiceEntry {
            left_out: match choice.held_out {
                HeldOut::Specimen(index) => design.specimens[index].name.clone(),
                HeldOut::LargestTilts => "largest tilts".to_string(),
                HeldOut::OtherFamilies(family) => format!("all but {}", name(family)),
            },
            causes: choice
                .causes
                .iter()
                .map(|(cause, share)| ShareEntry { cause: mechanisms[*cause].name, share: *share })
                .collect(),
        });
        let families = gain.families.iter();
        let families = families
            .map(|(family, gained)| FamilyEntry { family: name(*family), gained: GainedEntry::of(gained) });
        GainSummary {
            specimens_left_out: gain.specimens.as_ref().map(GainedEntry::of),
            largest_tilts_left_out: gain.tilts.as_ref().map(GainedEntry::of),
            one_family_known: families.collect(),
            choices: choices.collect(),
            nulls: gain.nulls,
        }
    }

    /// The gain as people read it.
    pub fn text(&self) -> String {
        let mut text = "\nGain on readings that were not known (extended less base model; 95 % intervals, calibrated on campaigns without effect)\n".to_string();
        let parts = [
            ("each specimen left out in turn", "it takes two specimens", &self.specimens_left_out),
            (
                "the largest tilts and the collapse angles left out",
                "it takes two specimens that were read at two tilts",
                &self.largest_tilts_left_out,
            ),
        ];
        for (what, needed, entry) in parts {
            match entry {
                Some(entry) => text.push_str(&entry.text(what)),
                None => text.push_str(&format!("  {what}: {needed}\n")),
            }
        }
        for own in &self.one_family_known {
            text.push_str(&own.gained.text(&format!("fitted to {} alone, all others left out", own.family)));
        }
        let chosen: Vec<String> =
            self.choices.iter().map(|choice| format!("{} {}", choice.left_out, choice.text())).collect();
        text.push_str(&format!("  chosen without them: {}\n", chosen.join(", ")));
        text
    }
}

impl ChoiceEntry {
    /// One cause by its name, several with their shares.
    fn text(&self) -> String {
        match &self.causes[..] {
            [] => "none".to_string(),
            [one] => one.cause.to_string(),
            several => {
                let part = |own: &ShareEntry| format!("{:.2} {}", own.share, own.cause);
                several.iter().map(part).collect::<Vec<_>>().join(" + ")
            }
        }
    }
}

impl GainEntry {
    /// What its interval shows.
    fn claim(&self) -> &'static str {
        match self.interval {
            [low, _] if low > 0.0 => "better",
            [_, high] if high < 0.0 => "worse",
            _ => "no gain shown",
        }
    }
}

impl GainedEntry {
    fn of(gained: &Gained) -> GainedEntry {
        let scores = |s: &Scores| ScoresEntry { log_score: s.log, crps: s.crps, rmse: s.rms };
        let gain = |i: &Interval| GainEntry { value: i.value, interval: i.ends };
        GainedEntry {
            readings: gained.readings,
            specimens: gained.specimens,
            base: scores(&gained.base),
            extended: scores(&gained.extended),
            ceiling: scores(&gained.ceiling),
            log_score: gain(&gained.gain[0]),
            crps: gain(&gained.gain[1]),
            rmse: gain(&gained.gain[2]),
        }
    }

    fn text(&self, what: &str) -> String {
        let number = |x: f64| significant(x, 3);
        let gain = |gain: &GainEntry| {
            let [low, high] = gain.interval.map(number);
            format!("{} [{low}, {high}], {}", number(gain.value), gain.claim())
        };
        let line = |name: &str, of: fn(&ScoresEntry) -> f64, own: &GainEntry| {
            let [base, extended, ceiling] =
                [&self.base, &self.extended, &self.ceiling].map(|s| number(of(s)));
            format!("    {name:<22} base {base}, extended {extended}, ceiling {ceiling}: {}\n", gain(own))
        };
        format!("  {what}: {} readings of {} specimens\n", self.readings, self.specimens)
            + &line("log score per reading", |s| s.log_score, &self.log_score)
            + &line("CRPS (sd)", |s| s.crps, &self.crps)
            + &line("RMSE (sd)", |s| s.rmse, &self.rmse)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_gain_a_loss_and_neither_are_told_apart() {
        let claims = [[0.1, 0.3], [-0.1, 0.3], [-0.3, -0.1]]
            .map(|interval| GainEntry { value: 0.5 * (interval[0] + interval[1]), interval }.claim());
        assert_eq!(claims, ["better", "no gain shown", "worse"]);
    }
}
