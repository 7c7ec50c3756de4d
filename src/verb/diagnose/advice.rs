//! What the data cannot tell, and what would: causes that look alike, the next measurement, and how large an effect must be to be
//! detected.

use crate::critic::{DETECTION_POWER, Offer, Offered, SelfTest};
use crate::render::document::Table;
use crate::render::number::{bracketed, or_dash, significant, with_interval};
use crate::render::text::wrapped;
use crate::study::{Described, in_plain_words};

/// A cause that is found in fewer of its campaigns than this is not seen at all.
const SEEN: f64 = 0.2;

/// What the data cannot tell, and what would.
#[derive(Clone, Debug, Default, PartialEq, serde::Serialize)]
pub struct Advice {
    /// Causes that data like these cannot tell apart, in classes.
    pub look_alike: Vec<Vec<&'static str>>,
    /// Causes that data like these see in less than a fifth of cases.
    pub not_seen: Vec<&'static str>,
    /// The smallest effects that data like these detect four times in five; a cause that goes both ways may have two.
    pub caught: Vec<DetectionLimitEntry>,
    /// Causes that they see, but at no strength of one parameter so often.
    pub seen_in_part: Vec<PartEntry>,
    /// Measurements that would tell the possible causes apart, the most information per hour first; empty where nothing was found.
    pub next: Vec<NextEntry>,
    /// Whether these tell apart the causes that nothing speaks against; or, where fewer than two are left, all that were examined.
    pub next_of_those_left: bool,
}

/// The detection limit of a cause.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct DetectionLimitEntry {
    /// The mechanism.
    pub cause: &'static str,
    /// Its parameter and the unit.
    pub parameter: &'static str,
    /// Unit of the parameter.
    pub unit: &'static str,
    /// From this value on; null where it is detected anywhere in its search prior.
    pub value: Option<f64>,
    /// The 95 % interval of this value, of the self-test's campaigns; null at an end that these do not bound.
    pub interval: [Option<f64>; 2],
    /// Whether smaller values are detected, not larger ones.
    pub below: bool,
}

/// How often a cause is found whose strength no one parameter tells.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct PartEntry {
    /// The mechanism.
    pub cause: &'static str,
    /// Campaigns in which it is found, and all.
    pub found: [u64; 2],
    /// The same of the third in which it moves most of what is read.
    pub strong_found: [u64; 2],
}

/// A measurement that could be made next.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct NextEntry {
    /// What to measure.
    pub what: String,
    /// Hours of two people, our estimate.
    pub hours: f64,
    /// Expected information about the cause (bit).
    pub bits: f64,
    /// Its 95 % interval, of the campaigns that it was counted on.
    pub interval: [f64; 2],
    /// What is not known of the cause before (bit).
    pub of_bits: f64,
}

impl NextEntry {
    /// In how many cases it would settle the cause: the share that it tells of what is not known.
    pub(crate) fn cases(&self) -> String {
        match (10.0 * self.bits / self.of_bits).round() {
            tenths if tenths >= 1.0 => format!("about {tenths:.0} of 10 cases"),
            _ => "fewer than 1 of 10 cases".to_owned(),
        }
    }
}

impl DetectionLimitEntry {
    /// Where it is found.
    fn from(&self) -> String {
        let side = if self.below { "at most" } else { "at least" };
        self.value.map_or("anywhere in its search prior".to_string(), |value| {
            format!("{side} {}", significant(value, 2))
        })
    }

    /// Between which values; a dash where it is not bounded.
    fn interval(&self) -> String {
        if let [Some(low), Some(high)] = self.interval {
            return bracketed([low, high], 2);
        }
        let [low, high] = self.interval.map(|end| or_dash(end, 2));
        format!("[{low}, {high}]")
    }
}

impl Advice {
    /// From the self-test and what was offered, for causes that are left or for others.
    pub fn of(test: &SelfTest, offered: &[Offered], are_left: bool, mechanisms: &[Described]) -> Advice {
        let names = |causes: Vec<usize>| causes.into_iter().map(|cause| mechanisms[cause].name).collect();
        let rows = || test.rows.iter().filter_map(|row| Some((row.cause?, row)));
        let unseen = rows().filter(|(_, row)| (row.all.found as f64) < SEEN * row.all.campaigns as f64);
        let limits = rows().flat_map(|(cause, row)| row.detection_limits.iter().map(move |own| (cause, own)));
        let limits = limits.map(|(cause, limit)| {
            let mechanism = &mechanisms[cause];
            let parameter = &mechanism.parameters[limit.parameter];
            let value = |score: Option<f64>| score.map(|score| parameter.search.at_score(score));
            DetectionLimitEntry {
                cause: mechanism.name,
                parameter: parameter.key,
                unit: parameter.unit,
                value: value(limit.score),
                interval: limit.interval.map(value),
                below: limit.below,
            }
        });
        let in_part = rows().filter(|(_, row)| {
            row.detection_limits.is_empty() && row.all.found as f64 >= SEEN * row.all.campaigns as f64
        });
        let in_part = in_part.map(|(cause, row)| PartEntry {
            cause: mechanisms[cause].name,
            found: [row.all.found, row.all.campaigns],
            strong_found: [row.strong.found, row.strong.campaigns],
        });
        let next = offered.iter().map(|own| NextEntry {
            what: words(own.offer, own.fine),
            hours: own.hours,
            bits: own.bits,
            interval: own.interval,
            of_bits: own.of,
        });
        Advice {
            look_alike: test.classes(SEEN).into_iter().map(names).collect(),
            not_seen: unseen.map(|(cause, _)| mechanisms[cause].name).collect(),
            caught: limits.collect(),
            seen_in_part: in_part.collect(),
            next: next.collect(),
            next_of_those_left: are_left,
        }
    }

    /// Sentences of a page: what data like these cannot tell apart, and what they hardly see.
    pub fn sentences(&self) -> Vec<String> {
        let classes: Vec<String> = self.look_alike.iter().map(|class| listed(class)).collect();
        let alike = (!classes.is_empty())
            .then(|| format!("Data like these cannot tell apart: {}.", classes.join(". Nor: ")));
        let unseen = (!self.not_seen.is_empty())
            .then(|| format!("Data like these hardly see: {}.", listed(&self.not_seen)));
        alike.into_iter().chain(unseen).collect()
    }

    /// Tables of a page: the next measurements, and the smallest effects that are found.
    pub fn tables(&self) -> Vec<Table> {
        let next = self.next.iter().map(|own| {
            let bits = with_interval(Some(own.bits), Some(own.interval), 2);
            vec![own.what.clone(), own.cases(), bits, significant(own.hours, 2)]
        });
        let open = if self.next_of_those_left { "open" } else { "open if the exclusions are chance" };
        let caption = self.next.first().map_or_else(String::new, |first| {
            let bits = significant(first.of_bits, 2);
            format!("Expected information about the cause, of {bits} bit {open}; hours of two people are our estimate.")
        });
        let heads = ["measurement", "would settle the cause in", "information (bit), 95 % interval", "hours"];
        let next = Table { caption, ..Table::new("Next measurement", &heads, next.collect()) };
        let caught = self.caught.iter().map(|own| {
            let from = own.from();
            let unit = if own.unit == "1" { "" } else { own.unit };
            vec![in_plain_words(own.cause), own.parameter.to_owned(), from, own.interval(), unit.to_owned()]
        });
        let name =
            format!("Smallest effects found in {:.0} % of simulated campaigns", 100.0 * DETECTION_POWER);
        let heads = ["cause", "parameter", "found where it is", "95 % interval; a dash: not bounded", "unit"];
        let caught = Table::new(&name, &heads, caught.collect());
        let part = self.seen_in_part.iter().map(|own| {
            let of = |[found, all]: [u64; 2]| format!("{found} of {all}");
            vec![in_plain_words(own.cause), of(own.found), of(own.strong_found)]
        });
        let heads = ["cause", "found in", "of the third that moves the readings most"];
        let part = Table::new("Found less often at any strength", &heads, part.collect());
        [next, caught, part].into_iter().filter(|table| !table.rows.is_empty()).collect()
    }

    /// The advice as people read it.
    pub fn text(&self) -> String {
        let mut text = String::new();
        if !self.look_alike.is_empty() {
            let classes: Vec<String> = self.look_alike.iter().map(|class| class.join(", ")).collect();
            text.push('\n');
            text.push_str(&wrapped(
                "",
                &format!("Data like these cannot tell apart: {}", classes.join("; ")),
            ));
        }
        if !self.not_seen.is_empty() {
            text.push('\n');
            text.push_str(&wrapped("", &format!("Data like these hardly see: {}", self.not_seen.join(", "))));
        }
        if !self.caught.is_empty() {
            text.push_str(&format!(
                "\nSmallest effects found in {:.0} % of simulated campaigns (95 % intervals; a dash: not bounded)\n",
                100.0 * DETECTION_POWER
            ));
            for own in &self.caught {
                let unit = if own.unit == "1" { String::new() } else { format!(" {}", own.unit) };
                let from = own.from();
                let interval = own.interval();
                text.push_str(&format!("  {:<18} {} {from} {interval}{unit}\n", own.cause, own.parameter));
            }
        }
        if !self.seen_in_part.is_empty() {
            text.push_str(
                "\nFound less often at any strength (in all, and in the third that moves the readings most)\n",
            );
            for PartEntry { cause, found: [found, all], strong_found: [strong, third] } in &self.seen_in_part
            {
                text.push_str(&format!("  {cause:<18} in {found} of {all}, and in {strong} of {third}\n"));
            }
        }
        if let Some(first) = self.next.first() {
            let open = match self.next_of_those_left {
                true => "open",
                false => "open if the exclusions are chance",
            };
            text.push_str(&format!(
                "\nNext measurement (expected information about the cause, of {} bit {open}; hours of two people, our estimate)\n",
                significant(first.of_bits, 2)
            ));
            for own in &self.next {
                let bits = with_interval(Some(own.bits), Some(own.interval), 2);
                text.push_str(&format!(
                    "  {bits:<19} bit in {:>4} h  {} (settles {})\n",
                    significant(own.hours, 2),
                    own.what,
                    own.cases()
                ));
            }
        }
        text
    }
}

/// Causes in plain words.
fn listed(causes: &[&'static str]) -> String {
    causes.iter().map(|cause| in_plain_words(cause)).collect::<Vec<_>>().join("; ")
}

/// What an offer is, with displacements that are read finely to `fine` (m).
fn words(offer: Offer, fine: f64) -> String {
    let fine = significant(fine * 1e3, 2);
    let fine = fine.trim_end_matches('0');
    match offer {
        Offer::Weights => "weigh a specimen of every family, to 0.5 %".into(),
        Offer::FixedTarget => format!("read a target that does not move, to {fine} mm"),
        Offer::TwoStones => "test two stones: kn to 10 %, friction angle to 1 deg, of every family".into(),
        Offer::Remainders => format!(
            "go back to 0 deg from the largest tilt read and read what is left at three points to {fine} mm"
        ),
        Offer::TurnedWalls => "turn as many walls round and read them at the same tilts".into(),
        Offer::LowTilts => {
            format!("six readings up to 3 deg at three points to {fine} mm, on new specimens")
        }
        Offer::FinerReadings => format!("the same tilts at three points to {fine} mm, on new specimens"),
        Offer::MoreTilts => "what was read at every degree, on new specimens".into(),
        Offer::MoreSpecimens => "as many specimens again, read as these were".into(),
    }
}
