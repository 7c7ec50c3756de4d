//! What the extended model gains on readings that it has not seen, in the units and words of files.

use crate::critic::{Between, Design, Gain, Gained, HeldOut, Interval, Scores, Test, World, stand_in};
use crate::render::document::Table;
use crate::render::number::{capital, significant, with_interval};
use crate::render::text::wrapped;
use crate::verb::diagnose::answer::{ScopeEntry, enumerated};

/// The gain.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct GainSummary {
    /// Every specimen left out in turn; null for fewer than two.
    pub specimens_left_out: Option<GainedEntry>,
    /// The largest tilts and the collapse angles, or the largest drifts, of all specimens left out; null where nothing is left then.
    pub largest_tilts_left_out: Option<GainedEntry>,
    /// Each fifth of the motions of the base left out in turn; only where it moves.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub motions_left_out: Option<GainedEntry>,
    /// All families left out but one, and those that are alike.
    pub one_family_known: Vec<FamilyEntry>,
    /// What the cause of the verdict that has most of the evidence gains where one family is predicted from another.
    pub between_families: Vec<BetweenEntry>,
    /// What was chosen in each fold, from what was known there.
    pub choices: Vec<ChoiceEntry>,
    /// Campaigns without any effect that the intervals are widened by.
    pub nulls: u64,
    /// What was done to the walls.
    #[serde(skip)]
    test: Test,
}

/// A gain on readings that were held out. Scores and errors in standard deviations of the base model's readings.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct GainedEntry {
    /// Readings scored.
    pub readings: usize,
    /// Of these so many with a value: bounds have neither a CRPS nor an error.
    pub valued: usize,
    /// Specimens that they were read on.
    pub specimens: usize,
    /// The base model.
    pub base: ScoresEntry,
    /// The extended model.
    pub extended: ScoresEntry,
    /// The base model with a discrepancy that is free to be anything smooth: what there is to be gained ("free discrepancy").
    pub ceiling: ScoresEntry,
    /// Gain in the logarithm of the probability, per reading.
    pub log_score: GainEntry,
    /// Gain in the continuous ranked probability score; null where all are bounds.
    pub crps: Option<GainEntry>,
    /// Gain in the root of the mean square error; null where all are bounds.
    pub rmse: Option<GainEntry>,
    /// What the free discrepancy gains, each as above; no cause is chosen for it, and its intervals are plain ones.
    pub ceiling_log_score: GainEntry,
    /// The same in the continuous ranked probability score.
    pub ceiling_crps: Option<GainEntry>,
    /// The same in the root of the mean square error.
    pub ceiling_rmse: Option<GainEntry>,
}

/// Scores of a model.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct ScoresEntry {
    /// Mean logarithm of the probability (or its density) given to a reading; large is good.
    pub log_score: f64,
    /// Mean continuous ranked probability score; small is good. Null where all are bounds.
    pub crps: Option<f64>,
    /// Root of the mean square error of the predicted means; small is good. Null where all are bounds.
    pub rmse: Option<f64>,
}

/// A gain; above 0 is better.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct GainEntry {
    /// The gain.
    pub value: f64,
    /// 95 % interval; campaigns without any effect lie wholly above 0 in no more than one case in twenty. Nulls where all
    /// specimens gain the same, as those of one path do: they do not tell how sure it is.
    pub interval: [f64; 2],
}

/// What is gained on all other families.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct FamilyEntry {
    /// The family that is known, with those whose arms say the same.
    pub family: String,
    /// The gain.
    pub gained: GainedEntry,
}

/// What is gained on one family from another, by the chain rule: log p(B given A) = log Z(A, B) - log Z(A).
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct BetweenEntry {
    /// The family that is known, with those whose arms say the same.
    pub known: String,
    /// The family that is predicted.
    pub predicted: String,
    /// Specimens that are predicted.
    pub specimens: usize,
    /// Readings on them.
    pub readings: usize,
    /// Gain in the logarithm of the probability of all these readings together (nat), with a 95 % interval.
    pub log_score: GainEntry,
}

/// What was chosen in a fold.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct ChoiceEntry {
    /// The specimen that was left out, "largest tilts" or "largest drifts", or "all but" a family.
    pub left_out: String,
    /// The mechanisms with their shares of the extended model; none where nothing was found.
    pub causes: Vec<ShareEntry>,
}

/// A part of a mixture.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct ShareEntry {
    /// The mechanism.
    pub cause: &'static str,
    /// Its share of the extended model.
    pub share: f64,
    /// The families on whose joints it acts; null where it acts on all alike.
    pub acts_on: Option<Vec<String>>,
}

impl GainSummary {
    /// From a gain measured on a design.
    pub fn of(gain: &Gain, between: &[Between], world: &World<'_>, design: &Design) -> GainSummary {
        let study = world.study();
        let name = |family: usize| {
            let alike = design.families().into_iter().filter(|own| stand_in(study, *own) == family);
            alike.map(|own| study.arms[own].name.clone()).collect::<Vec<_>>().join(" and ")
        };
        let choices = gain.choices.iter().map(|choice| ChoiceEntry {
            left_out: match choice.held_out {
                HeldOut::Specimen(index) => design.specimens[index].name.clone(),
                HeldOut::LargestTilts if matches!(world.test(), Test::Shear { .. }) => {
                    "largest drifts".to_string()
                }
                HeldOut::LargestTilts => "largest tilts".to_string(),
                HeldOut::Motions(part) => format!("fifth {} of the motions", part + 1),
                HeldOut::OtherFamilies(family) => format!("all but {}", name(family)),
            },
            causes: choice
                .causes
                .iter()
                .flat_map(|(causes, share)| causes.each().map(move |cause| (cause, *causes, *share)))
                .map(|(cause, causes, share)| ShareEntry {
                    cause: world.mechanisms()[cause].name,
                    share,
                    acts_on: ScopeEntry::of(world, cause, causes, share).map(|scope| scope.acts_on),
                })
                .collect(),
        });
        let families = gain.families.iter();
        let families = families
            .map(|(family, gained)| FamilyEntry { family: name(*family), gained: GainedEntry::of(gained) });
        let within = gain.tilts.as_ref().map(GainedEntry::of);
        let (tilts, motions) = if world.test() == Test::Shaking { (None, within) } else { (within, None) };
        GainSummary {
            specimens_left_out: gain.specimens.as_ref().map(GainedEntry::of),
            largest_tilts_left_out: tilts,
            motions_left_out: motions,
            one_family_known: families.collect(),
            between_families: between
                .iter()
                .map(|own| BetweenEntry {
                    known: name(own.known),
                    predicted: name(own.predicted),
                    specimens: own.specimens,
                    readings: own.readings,
                    log_score: GainEntry { value: own.gain.value, interval: own.gain.ends },
                })
                .collect(),
            choices: choices.collect(),
            nulls: gain.nulls,
            test: world.test(),
        }
    }

    /// A gain on specimens left out, and nothing else.
    #[cfg(test)]
    pub fn of_specimens(entry: GainedEntry) -> GainSummary {
        GainSummary {
            specimens_left_out: Some(entry),
            largest_tilts_left_out: None,
            motions_left_out: None,
            one_family_known: Vec::new(),
            between_families: Vec::new(),
            choices: Vec::new(),
            nulls: 0,
            test: Test::Tilting,
        }
    }

    /// What was left out, what it takes, and what came of it.
    fn parts(&self) -> [(&'static str, &'static str, &Option<GainedEntry>); 2] {
        [
            ("each specimen left out in turn", "it takes two specimens", &self.specimens_left_out),
            match self.test {
                Test::Shaking => (
                    "each fifth of the motions left out in turn",
                    "it takes five motions",
                    &self.motions_left_out,
                ),
                Test::Shear { .. } => (
                    "the largest drifts left out",
                    "it takes two specimens that were read at two drifts",
                    &self.largest_tilts_left_out,
                ),
                Test::Tilting => (
                    "the largest tilts and the collapse angles left out",
                    "it takes two specimens that were read at two tilts",
                    &self.largest_tilts_left_out,
                ),
            },
        ]
    }

    /// The gain as tables of a page: one for each part that was left out, and what was chosen without it.
    pub fn tables(&self) -> Vec<Table> {
        let mut tables = Vec::new();
        for (what, needed, entry) in self.parts() {
            match entry {
                Some(entry) => tables.push(entry.table(what)),
                None => {
                    let caption = format!("Not measured: {needed}.");
                    tables.push(Table { caption, ..Table::new(&capital(what), &[], Vec::new()) });
                }
            }
        }
        for own in &self.one_family_known {
            tables.push(own.gained.table(&format!("fitted to {} alone, all others left out", own.family)));
        }
        if !self.between_families.is_empty() {
            let rows = self.between_families.iter().map(|own| {
                let specimens = format!("{} readings of {} specimens", own.readings, own.specimens);
                vec![own.known.clone(), own.predicted.clone(), specimens, own.log_score.text()]
            });
            let caption = "Logarithm of the probability of all readings of one family, given those of another: the likeliest cause of the \
                           verdict less the base model (nat). Nothing is fitted or chosen anew.";
            let heads = ["known", "predicted", "of", "gain, 95 % interval"];
            let table = Table::new("One family predicted from another", &heads, rows.collect());
            tables.push(Table { caption: caption.to_owned(), ..table });
        }
        let chosen = self.choices.iter().map(|choice| vec![choice.left_out.clone(), choice.text()]);
        tables.push(Table::new(
            "Causes chosen without what was left out",
            &["left out", "chosen"],
            chosen.collect(),
        ));
        tables
    }

    /// The gain as people read it.
    pub fn text(&self) -> String {
        let mut text = "\nGain on held-out readings (extended less base model; 95 % intervals, calibrated on campaigns without effect)\n".to_string();
        for (what, needed, entry) in self.parts() {
            match entry {
                Some(entry) => text.push_str(&entry.text(what)),
                None => text.push_str(&format!("  {what}: {needed}\n")),
            }
        }
        for own in &self.one_family_known {
            text.push_str(&own.gained.text(&format!("fitted to {} alone, all others left out", own.family)));
        }
        if !self.between_families.is_empty() {
            text.push_str(
                "  one family predicted from another, by the likeliest cause (nat over all readings)\n",
            );
        }
        for own in &self.between_families {
            let pair = format!("{} from {}", own.predicted, own.known);
            text.push_str(&format!("    {pair:<22} {}\n", own.log_score.text()));
        }
        let chosen: Vec<String> =
            self.choices.iter().map(|choice| format!("{} {}", choice.left_out, choice.text())).collect();
        text.push_str(&wrapped("  ", &format!("chosen without them: {}", chosen.join(", "))));
        text
    }
}

impl ChoiceEntry {
    /// One cause by its name, several with their shares.
    fn text(&self) -> String {
        match &self.causes[..] {
            [] => "none".to_string(),
            [one] => one.text(),
            several => {
                let part = |own: &ShareEntry| format!("{:.2} {}", own.share, own.text());
                several.iter().map(part).collect::<Vec<_>>().join(" + ")
            }
        }
    }
}

impl ShareEntry {
    /// The mechanism, with the families on whose joints it acts.
    fn text(&self) -> String {
        let joints =
            self.acts_on.as_ref().map_or_else(String::new, |arms| format!(" ({})", enumerated(arms)));
        format!("{}{joints}", self.cause)
    }
}

impl GainEntry {
    /// The gain with its interval, and what that shows.
    pub(crate) fn text(&self) -> String {
        match self.finite() {
            Some(_) => format!("{}, {}", self.number(), self.claim()),
            None => format!(
                "{}, how sure cannot be told: all specimens gain the same",
                significant(self.value, 3)
            ),
        }
    }

    /// The gain with its interval.
    fn number(&self) -> String {
        with_interval(Some(self.value), self.finite(), 3)
    }

    /// The interval, where there is one.
    fn finite(&self) -> Option<[f64; 2]> {
        Some(self.interval).filter(|ends| ends.iter().all(|end| end.is_finite()))
    }

    /// What its interval shows.
    pub(crate) fn claim(&self) -> &'static str {
        match self.interval {
            [low, _] if low > 0.0 => "better",
            [_, high] if high < 0.0 => "worse",
            _ => "no gain shown",
        }
    }
}

impl GainedEntry {
    fn of(gained: &Gained) -> GainedEntry {
        let is_valued = gained.valued > 0;
        let scores = |s: &Scores| ScoresEntry {
            log_score: s.log,
            crps: is_valued.then_some(s.crps),
            rmse: is_valued.then_some(s.rms),
        };
        let gain = |i: &Interval| GainEntry { value: i.value, interval: i.ends };
        GainedEntry {
            readings: gained.readings,
            valued: gained.valued,
            specimens: gained.specimens,
            base: scores(&gained.base),
            extended: scores(&gained.extended),
            ceiling: scores(&gained.ceiling),
            log_score: gain(&gained.gain[0]),
            crps: is_valued.then(|| gain(&gained.gain[1])),
            rmse: is_valued.then(|| gain(&gained.gain[2])),
            ceiling_log_score: gain(&gained.ceiling_gain[0]),
            ceiling_crps: is_valued.then(|| gain(&gained.ceiling_gain[1])),
            ceiling_rmse: is_valued.then(|| gain(&gained.ceiling_gain[2])),
        }
    }

    /// As a table of a page.
    fn table(&self, what: &str) -> Table {
        let number = |x: f64| significant(x, 3);
        let line = |name: &str, of: fn(&ScoresEntry) -> Option<f64>, gains: [Option<GainEntry>; 2]| {
            let models = [&self.base, &self.extended, &self.ceiling].map(of);
            let ([Some(base), Some(extended), Some(ceiling)], [Some(own), Some(most)]) = (models, gains)
            else {
                return None;
            };
            let cells =
                [name.to_owned(), number(base), number(extended), own.text(), number(ceiling), most.number()];
            Some(cells.to_vec())
        };
        let rows = [
            line(
                "log score per reading",
                |s| Some(s.log_score),
                [self.log_score, self.ceiling_log_score].map(Some),
            ),
            line("CRPS (sd)", |s| s.crps, [self.crps, self.ceiling_crps]),
            line("RMSE (sd)", |s| s.rmse, [self.rmse, self.ceiling_rmse]),
        ];
        let heads =
            ["score", "base model", "extended model", "gain, 95 % interval", "free discrepancy", "its gain"];
        let caption = format!("{} of {} specimens.", self.counted(), self.specimens);
        Table { caption, ..Table::new(&capital(what), &heads, rows.into_iter().flatten().collect()) }
    }

    /// The readings that were scored.
    fn counted(&self) -> String {
        let bounds = self.readings - self.valued;
        let bounds = if bounds > 0 { format!(" ({bounds} of them bounds)") } else { String::new() };
        format!("{} readings{bounds}", self.readings)
    }

    fn text(&self, what: &str) -> String {
        let number = |x: f64| significant(x, 3);
        let line = |name: &str, of: fn(&ScoresEntry) -> Option<f64>, gains: [Option<GainEntry>; 2]| {
            let models = [&self.base, &self.extended, &self.ceiling].map(of);
            let ([Some(base), Some(extended), Some(ceiling)], [Some(own), Some(most)]) = (models, gains)
            else {
                return String::new();
            };
            let [base, extended, ceiling] = [base, extended, ceiling].map(number);
            let (own, most) = (own.text(), most.number());
            format!("    {name:<22} base {base}; extended {extended}: {own}\n")
                + &format!("    {:<22} free discrepancy {ceiling}: {most}\n", "")
        };
        format!("  {what}: {} of {} specimens\n", self.counted(), self.specimens)
            + &line(
                "log score per reading",
                |s| Some(s.log_score),
                [self.log_score, self.ceiling_log_score].map(Some),
            )
            + &line("CRPS (sd)", |s| s.crps, [self.crps, self.ceiling_crps])
            + &line("RMSE (sd)", |s| s.rmse, [self.rmse, self.ceiling_rmse])
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

    #[test]
    fn what_was_not_scored_and_what_cannot_be_told_is_not_shown_as_a_number() {
        let scores = Scores { log: -1.5, crps: 0.0, rms: 0.0 };
        let sure = Interval { value: 0.5, ends: [0.25, 0.75] };
        let gained = |valued, log| {
            let gain = [log, Interval { value: 0.0, ends: [0.0; 2] }, sure];
            let (readings, specimens, base) = (4, 2, scores);
            let (extended, ceiling, ceiling_gain) = (base, Scores { log: -1.0, ..base }, gain);
            let all = Gained { readings, valued, specimens, base, extended, ceiling, gain, ceiling_gain };
            GainedEntry::of(&all).text("one")
        };
        assert_eq!(
            gained(0, sure),
            "  one: 4 readings (4 of them bounds) of 2 specimens\n    log score per reading  base -1.50; extended -1.50: 0.50 [0.25, \
             0.75], better\n                           free discrepancy -1.00: 0.50 [0.25, 0.75]\n"
        );
        let unsure = Interval { value: 0.5, ends: [f64::NEG_INFINITY, f64::INFINITY] };
        let text = gained(4, unsure);
        assert!(text.contains("one: 4 readings of 2") && text.contains("RMSE"), "{text}");
        assert!(
            text.contains("extended -1.50: 0.500, how sure cannot be told: all specimens gain the same\n"),
            "{text}"
        );
    }
}
