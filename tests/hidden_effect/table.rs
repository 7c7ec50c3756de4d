//! What was said beside what was true: shares and means, by design and group.

use pirca::random::Streams;
use pirca::stats::{mean, quantile};

use crate::inference::{Said, Word};
use crate::laws::Learnt;
use crate::truth::decoys::DECOYS;
use crate::truth::designs::Design;
use crate::truth::label::{Group, Label};
use crate::truth::laws::LAWS;
use crate::truth::roster::{SPREADS, recorded};
use crate::truth::strength::{Strength, Within, outside};
use crate::truth::unknown::UNKNOWN;

/// Bins of the probability given, for its calibration.
const BINS: usize = 10;
/// Draws of what chance makes of it.
const CALIBRATED: u64 = 1000;

/// How often labels change places.
const PERMUTED: u64 = 1000;

/// How often campaigns are drawn anew for the interval of a number that they have together.
const DRAWN_ANEW: u64 = 1000;

/// Effects in no catalogue that are of a form that the ranking learns to keep apart from all causes (a gauge that shifts at some
/// tilt, or from specimen to specimen, or comes to its end).
const LEARNT: [&str; 3] = ["drift", "knock", "saturation"];

/// A mechanism whose other code is the same as a cause of the catalogue: a soft bed that may open stands on less than its width.
const OTHER_WORDS: [(&str, &str); 1] = [("base_compliance", "contact_inset")];

/// Mechanisms that are the same in other words, confounded by the catalogue: under the weight of one wall both laws stiffen.
const SAME: [&str; 2] = ["joint_closure", "stress_stiffening"];

/// A test of prior against data flags a conflict below this.
const FLAGGED: f64 = 0.05;

/// Bands of the shift that an effect makes, in standard deviations.
const SHIFTS: [[f64; 2]; 4] = [[0.0, 1.0], [1.0, 3.0], [3.0, 10.0], [10.0, f64::INFINITY]];

/// A shift that data mostly show. The lines say 3.
const CLEAR: f64 = 3.0;

/// What laws that were learnt are called in the table.
const LEARNT_LAWS: &str = "learnt laws";

/// A campaign that was judged by a design.
#[derive(Clone, Debug)]
pub struct Judged {
    pub label: Label,
    pub design: String,
    pub said: Said,
    /// Share of what the physical prior of the hidden mechanism predicts that is as far out, where it is one of our code.
    pub conflict: Option<f64>,
    /// How far the mechanism that is hidden moves what the design sees, in standard deviations, where it is one of our code.
    pub shift: Option<f64>,
}

/// A number of the table.
#[derive(Clone, Debug, PartialEq)]
pub struct Line {
    pub design: &'static str,
    pub group: String,
    pub measure: &'static str,
    /// Hits and trials, where it is a share.
    pub counts: Option<[usize; 2]>,
    /// The value; none without trials.
    pub value: Option<f64>,
    /// Its 95 % interval, where it is no share: those of the campaigns drawn anew (percentiles).
    pub between: Option<[f64; 2]>,
}

impl Judged {
    fn found(&self) -> bool {
        self.said.verdict != Word::NothingFound
    }

    fn named(&self) -> bool {
        matches!(self.said.verdict, Word::Named | Word::NamedOutsidePrior)
    }

    /// Whether the hidden cause is named, and said to lie outside its prior.
    fn flagged(&self) -> bool {
        self.right() && self.said.verdict == Word::NamedOutsidePrior
    }

    /// Whether the verdict speaks of the hidden cause.
    fn held(&self) -> bool {
        self.said.names.iter().any(|name| self.is_hidden(name))
    }

    /// Whether a cause is hidden, by its own name or by one that means the same.
    fn is_hidden(&self, cause: &str) -> bool {
        self.label.hidden.iter().any(|hidden| {
            let unknown = UNKNOWN.iter().find(|unknown| unknown.name == hidden.name);
            let law = LAWS.iter().find(|law| law.name == hidden.name);
            let other = self.label.group == Group::OtherCode;
            hidden.name == cause
                || unknown.is_some_and(|unknown| unknown.aliases.contains(&cause))
                || law.is_some_and(|law| law.aliases.contains(&cause))
                || [&hidden.name[..], cause].iter().all(|name| SAME.contains(name))
                || (other && OTHER_WORDS.contains(&(&hidden.name, cause)))
        })
    }

    /// Whether something is named and all that is named is hidden.
    fn right(&self) -> bool {
        self.named() && self.said.names.iter().all(|name| self.is_hidden(name))
    }

    fn wrong(&self) -> bool {
        self.named() && !self.right()
    }

    /// Whether something is named of which nothing is hidden.
    fn plainly_wrong(&self) -> bool {
        self.named() && !self.said.names.iter().any(|name| self.is_hidden(name))
    }

    /// Whether what is said is all that should be: nothing where nothing is hidden, the name of a mechanism.
    fn correct(&self) -> bool {
        match self.label.group {
            Group::Nothing | Group::PriorWrong => !self.found(),
            _ => self.right(),
        }
    }
}

/// The table of campaigns that were judged, and of the laws that were learnt.
pub fn of(judged: &[Judged], laws: &[Option<Learnt>]) -> Vec<Line> {
    Design::ALL.into_iter().flat_map(|design| of_design(design, judged, laws)).collect()
}

fn of_design(design: Design, judged: &[Judged], laws: &[Option<Learnt>]) -> Vec<Line> {
    let own: Vec<&Judged> = judged.iter().filter(|j| j.design == design.name()).collect();
    let of = |group: Group| own.iter().copied().filter(move |j| j.label.group == group).collect::<Vec<_>>();
    let (nothing, far, mechanisms) = (of(Group::Nothing), of(Group::PriorWrong), of(Group::Mechanism));
    let catalogued: Vec<&Judged> = [&nothing[..], &far[..], &mechanisms[..]].concat();
    let mut lines = Lines { design: design.name(), lines: Vec::new() };
    lines.share("all groups", "a name given is right", &named(&own), Judged::right);
    lines.share("catalogue and nothing", "a name given is right", &named(&catalogued), Judged::right);
    lines.share("nothing hidden", "found", &nothing, Judged::found);
    lines.share("nothing hidden", "named", &nothing, Judged::named);
    lines.share("prior wrong", "found", &far, Judged::found);
    lines.share("prior wrong", "named", &far, Judged::named);
    for strength in Strength::ALL.into_iter().rev() {
        let is_own = |j: &&Judged| j.label.hidden[0].strength.is_some_and(|(own, _)| own == strength);
        let some: Vec<&Judged> = mechanisms.iter().copied().filter(is_own).collect();
        let group = format!("mechanism, {}", strength.name());
        lines.of_mechanisms(&group, &some);
        let is_clear = |j: &Judged| j.shift.is_some_and(|shift| shift >= CLEAR);
        lines.share(&group, "shift of 3 or more", &some, is_clear);
        let clear: Vec<&Judged> = some.into_iter().filter(|j| is_clear(j)).collect();
        lines.share(&group, "named where the shift is 3 or more", &clear, Judged::right);
    }
    lines.of_mechanisms("mechanism", &mechanisms);
    let inside = |j: &&Judged| j.label.hidden[0].strength.is_some_and(|(_, within)| within == Within::Prior);
    let inside: Vec<&Judged> = mechanisms.iter().copied().filter(inside).collect();
    lines.of_mechanisms("mechanism, within its physical prior", &inside);
    let is_flagged = |j: &Judged| j.conflict.is_some_and(|p| p < FLAGGED);
    lines.share("mechanism, within its physical prior", "conflict flagged", &inside, is_flagged);
    let other = of(Group::OtherCode);
    lines.of_mechanisms("mechanism, other code", &other);
    lines.share("mechanism, other code", "a name given is right", &named(&other), Judged::right);
    for [low, high] in SHIFTS {
        let some = |j: &&Judged| j.shift.is_some_and(|shift| (low..high).contains(&shift));
        let some: Vec<&Judged> = mechanisms.iter().copied().filter(some).collect();
        let to = if high.is_finite() { format!("{low} to {high}") } else { format!("above {low}") };
        lines.of_mechanisms(&format!("mechanism, shift {to}"), &some);
    }
    for mechanism in recorded() {
        let some = |j: &&Judged| j.label.hidden[0].name == mechanism.name;
        let some: Vec<&Judged> = mechanisms.iter().copied().filter(some).collect();
        lines.of_mechanisms(mechanism.name, &some);
        let shifts: Vec<f64> = some.iter().filter_map(|j| j.shift).collect();
        lines.value(mechanism.name, "median shift", &shifts, |shifts| quantile(shifts, 0.5));
    }
    let found: Vec<&Judged> = mechanisms.iter().copied().filter(|j| j.found()).collect();
    for (group, found) in [
        ("mechanism, found", found.clone()),
        ("mechanism, other code, found", other.iter().copied().filter(|j| j.found()).collect()),
    ] {
        lines.share(group, "the set holds it", &found, |j| j.said.set.contains(&j.label.hidden[0].name));
    }
    let sizes: Vec<f64> = found.iter().map(|j| j.said.set.len() as f64).collect();
    lines.value("mechanism, found", "mean size of the set", &sizes, mean);
    let few: Vec<&Judged> = found.iter().copied().filter(|j| j.said.verdict == Word::Ambiguous).collect();
    lines.share("mechanism, ambiguous", "the verdict holds it", &few, Judged::held);
    let sizes: Vec<f64> = few.iter().map(|j| j.said.names.len() as f64).collect();
    lines.value("mechanism, ambiguous", "mean number of causes", &sizes, mean);
    let unexplained: Vec<&Judged> =
        found.iter().copied().filter(|j| j.said.verdict == Word::Unexplained).collect();
    lines.share("mechanism, found", "unexplained", &found, |j| j.said.verdict == Word::Unexplained);
    lines.share("mechanism, unexplained", "it is left open", &unexplained, |j| {
        j.said.open.iter().any(|name| j.is_hidden(name))
    });
    let given: Vec<(f64, bool)> =
        found.iter().map(|j| (j.said.likeliest.1, j.is_hidden(&j.said.likeliest.0))).collect();
    lines.value("mechanism, found", "calibration error of the likeliest", &given, calibration_error);
    lines.plain("mechanism, found", "calibration error by chance alone", chance_error(&given));
    let beyond = of(Group::Outside);
    for spreads in SPREADS {
        let some: Vec<&Judged> =
            beyond.iter().copied().filter(|j| j.label.hidden[0].spreads == Some(spreads)).collect();
        lines.outside(&format!("outside its prior, {spreads} spreads"), &some);
    }
    for name in outside() {
        let some: Vec<&Judged> = beyond.iter().copied().filter(|j| j.label.hidden[0].name == name).collect();
        lines.outside(&format!("{name}, outside its prior"), &some);
    }
    lines.outside("outside its prior", &beyond);
    let curved = of(Group::Law);
    lines.of_mechanisms("laws of no catalogue", &curved);
    for law in &LAWS {
        let some: Vec<&Judged> =
            curved.iter().copied().filter(|j| j.label.hidden[0].name == law.name).collect();
        lines.of_mechanisms(law.name, &some);
    }
    if design == Design::Rich {
        lines.learnt(laws);
    }
    let pairs = of(Group::Pair);
    lines.share("pairs", "found", &pairs, Judged::found);
    lines.share("pairs", "one of the two named, or both", &pairs, Judged::right);
    lines.share("pairs", "others named", &pairs, Judged::plainly_wrong);
    let unknown = of(Group::Unknown);
    lines.share("out of catalogue", "found", &unknown, Judged::found);
    lines.share("out of catalogue", "named", &unknown, Judged::named);
    lines.share("out of catalogue", "wrongly named", &unknown, Judged::wrong);
    lines.share("out of catalogue", "unexplained", &unknown, |j| j.said.verdict == Word::Unexplained);
    let learnt = |j: &Judged| LEARNT.contains(&&j.label.hidden[0].name[..]);
    let strange: Vec<&Judged> = unknown.iter().copied().filter(|j| !learnt(j)).collect();
    lines.share("out of catalogue, of no form that was learnt", "wrongly named", &strange, Judged::wrong);
    for effect in &UNKNOWN {
        let some: Vec<&Judged> =
            unknown.iter().copied().filter(|j| j.label.hidden[0].name == effect.name).collect();
        lines.share(effect.name, "found", &some, Judged::found);
        lines.share(effect.name, "wrongly named", &some, Judged::wrong);
    }
    let decoys = of(Group::Decoy);
    lines.share("decoys", "found", &decoys, Judged::found);
    lines.share("decoys", "named", &decoys, Judged::named);
    lines.share("catalogue and nothing", "correct", &catalogued, Judged::correct);
    let still = |j: &Judged| matches!(j.label.group, Group::Nothing | Group::PriorWrong);
    lines.share("catalogue and nothing", "correct if nothing is ever found", &catalogued, still);
    let named = named(&mechanisms);
    let shares = permuted(&named);
    lines.plain("mechanism, labels permuted", "a name given is right", mean(&shares));
    lines.between(&shares);
    for name in DECOYS {
        let some: Vec<&Judged> = decoys.iter().copied().filter(|j| j.label.hidden[0].name == name).collect();
        lines.share(name, "found", &some, Judged::found);
        lines.share(name, "named", &some, Judged::named);
    }
    lines.lines
}

/// Lines of a design.
struct Lines {
    design: &'static str,
    lines: Vec<Line>,
}

impl Lines {
    fn share(&mut self, group: &str, measure: &'static str, of: &[&Judged], hit: impl Fn(&Judged) -> bool) {
        self.counted(group, measure, [of.iter().filter(|j| hit(j)).count(), of.len()]);
    }

    /// Hits and trials.
    fn counted(&mut self, group: &str, measure: &'static str, [hits, trials]: [usize; 2]) {
        let value = (trials > 0).then(|| hits as f64 / trials as f64);
        let counts = Some([hits, trials]);
        let group = group.to_owned();
        self.lines.push(Line { design: self.design, group, measure, counts, value, between: None });
    }

    /// A number that campaigns have together, with its interval.
    fn value<T: Clone>(
        &mut self,
        group: &str,
        measure: &'static str,
        of: &[T],
        told: impl Fn(&[T]) -> Option<f64>,
    ) {
        self.plain(group, measure, told(of));
        let mut stream = Streams::new(3, 0).of("campaigns drawn anew");
        let mut drawn = || -> Vec<T> { of.iter().map(|_| of[stream.below(of.len())].clone()).collect() };
        let all: Vec<f64> = (0..DRAWN_ANEW).filter_map(|_| told(&drawn())).collect();
        self.between(&all);
    }

    /// The interval of the last number, by what it was each time that it was drawn anew.
    fn between(&mut self, all: &[f64]) {
        let ends = [0.025, 0.975].map(|p| quantile(all, p));
        if let (Some(line), [Some(low), Some(high)]) = (self.lines.last_mut(), ends) {
            line.between = Some([low, high]);
        }
    }

    /// A number without an interval.
    fn plain(&mut self, group: &str, measure: &'static str, value: Option<f64>) {
        let group = group.to_owned();
        self.lines.push(Line { design: self.design, group, measure, counts: None, value, between: None });
    }

    /// What is said of mechanisms that lie outside their priors.
    fn outside(&mut self, group: &str, of: &[&Judged]) {
        self.of_mechanisms(group, of);
        self.share(group, "named, and said to lie outside", of, Judged::flagged);
        self.share(group, "the verdict holds it", of, Judged::held);
        self.share(group, "conflict flagged", of, |j| j.conflict.is_some_and(|p| p < FLAGGED));
    }

    /// What was learnt of laws.
    fn learnt(&mut self, laws: &[Option<Learnt>]) {
        let own: Vec<&Learnt> = laws.iter().flatten().collect();
        self.counted(LEARNT_LAWS, "a law was learnt", [own.len(), laws.len()]);
        let sum = |k: usize| own.iter().map(|law| law.within[k]).sum();
        self.counted(LEARNT_LAWS, "its band holds the truth", [sum(0), sum(1)]);
        let collapses: Vec<bool> = own.iter().filter_map(|law| law.collapse).collect();
        let hits = |of: &[bool]| [of.iter().filter(|hit| **hit).count(), of.len()];
        self.counted(LEARNT_LAWS, "the collapse of one more wall lies within", hits(&collapses));
        let signs: Vec<bool> = own.iter().filter_map(|law| law.sign).collect();
        self.counted(LEARNT_LAWS, "a sign given is right", hits(&signs));
        let goes: Vec<bool> = own.iter().filter(|law| law.goes).map(|law| law.sign == Some(true)).collect();
        self.counted(LEARNT_LAWS, "the sign is given and right", hits(&goes));
        let accepted = own.iter().filter(|law| law.accepted).count();
        self.counted(LEARNT_LAWS, "accepted", [accepted, own.len()]);
    }

    fn of_mechanisms(&mut self, group: &str, of: &[&Judged]) {
        self.share(group, "found", of, Judged::found);
        self.share(group, "named", of, Judged::right);
        self.share(group, "another one named", of, Judged::wrong);
    }
}

fn named<'j>(of: &[&'j Judged]) -> Vec<&'j Judged> {
    of.iter().copied().filter(|j| j.named()).collect()
}

/// Mean distance of how often the likeliest cause is the hidden one from the probability that it was given, over bins of this
/// probability, each weighted by its campaigns.
fn calibration_error(of: &[(f64, bool)]) -> Option<f64> {
    let mut bins = [0.0; BINS];
    for (given, right) in of {
        bins[((given * BINS as f64) as usize).min(BINS - 1)] += given - f64::from(u8::from(*right));
    }
    (!of.is_empty()).then(|| bins.iter().fold(0.0, |sum, off| sum + off.abs()) / of.len() as f64)
}

/// The same, in the mean over many draws, of one whose probabilities are those that they are given: with few campaigns chance alone
/// makes an error.
fn chance_error(of: &[(f64, bool)]) -> Option<f64> {
    let mut stream = Streams::new(2, 0).of("calibrated");
    let mut drawn = || of.iter().map(|(given, _)| (*given, stream.uniform() < *given)).collect::<Vec<_>>();
    let errors: Vec<f64> = (0..CALIBRATED).filter_map(|_| calibration_error(&drawn())).collect();
    mean(&errors)
}

/// Shares of names that are right where labels have changed places, each time otherwise.
pub fn permuted(of: &[&Judged]) -> Vec<f64> {
    let shuffled = |k: u64| {
        let mut stream = Streams::new(1, k).of("permuted labels");
        let mut order: Vec<usize> = (0..of.len()).collect();
        (0..order.len()).for_each(|k| order.swap(k, k + stream.below(of.len() - k)));
        let told = of.iter().zip(order);
        let told = told.map(|(j, other)| Judged { label: of[other].label.clone(), ..(*j).clone() });
        told.filter(Judged::right).count() as f64 / of.len() as f64
    };
    if of.is_empty() { Vec::new() } else { (0..PERMUTED).map(shuffled).collect() }
}

#[cfg(test)]
pub mod tests {
    use std::collections::BTreeMap;

    use super::*;
    use crate::printed::markdown;
    use crate::truth::roster::roster;

    /// What somebody says who knows all labels, and gives no name where there is none. Strong effects of our code shift what is seen
    /// by 5, others by 1.
    pub fn told() -> Vec<Judged> {
        let all = roster(&|_| 1.0, 3, &BTreeMap::new()).into_iter();
        all.map(|label| {
            let name = label.hidden.first().map(|hidden| hidden.name.clone());
            let name =
                name.filter(|_| matches!(label.group, Group::Mechanism | Group::OtherCode | Group::Outside));
            let verdict = match (&name, label.group) {
                (None, _) => Word::NothingFound,
                (_, Group::Outside) => Word::NamedOutsidePrior,
                _ => Word::Named,
            };
            let names: Vec<String> = name.clone().into_iter().collect();
            let likeliest = (name.unwrap_or_else(|| "lean".to_owned()), 0.95);
            let said = Said {
                p_value: 0.5,
                verdict,
                set: names.clone(),
                open: Vec::new(),
                names,
                likeliest,
                check: Vec::new(),
                evidence: Vec::new(),
                pair: None,
            };
            let ours = label.group == Group::Mechanism;
            let strong = ours && label.hidden[0].strength.is_some_and(|(own, _)| own == Strength::Strong);
            let shift = ours.then_some(if strong { 5.0 } else { 1.0 });
            Judged { label, design: Design::Rich.name().to_owned(), said, conflict: None, shift }
        })
        .collect()
    }

    fn line<'l>(lines: &'l [Line], group: &str, measure: &str) -> &'l Line {
        let own = |line: &&Line| line.design == "rich" && line.group == group && line.measure == measure;
        lines.iter().find(own).unwrap_or_else(|| panic!("{group}: {measure}"))
    }

    #[test]
    fn a_pair_is_right_if_both_are_hidden_whatever_their_order() {
        let mut told = told();
        told.retain(|j| matches!(j.label.group, Group::Mechanism | Group::Pair));
        told.sort_by_key(|j| j.label.group);
        let counts =
            |told: &[Judged], group: &str, measure: &str| line(&of(told, &[]), group, measure).counts;
        let wrong = |told: &[Judged]| counts(told, "mechanism", "another one named").expect("a share")[0];
        let other = |j: &Judged| {
            let names = recorded().into_iter().map(|mechanism| mechanism.name.to_owned());
            names.into_iter().find(|name| !j.is_hidden(name)).expect("there are more")
        };
        let one = told.iter().position(|j| j.label.group == Group::Mechanism).expect("most");
        for order in [0, 1] {
            told[one].said.names = vec![told[one].label.hidden[0].name.clone(); 1];
            let own = other(&told[one]);
            told[one].said.names.insert(order, own);
            assert_eq!(wrong(&told), 1);
        }
        let pair = told.iter().position(|j| j.label.group == Group::Pair).expect("there are pairs");
        let [first, second] = [0, 1].map(|k| told[pair].label.hidden[k].name.clone());
        let strange = other(&told[pair]);
        for (names, right, plainly) in [
            (vec![second.clone(), first.clone()], 1, 0),
            (vec![second.clone()], 1, 0),
            (vec![strange.clone(), first], 0, 0),
            (vec![strange], 0, 1),
        ] {
            (told[pair].said.verdict, told[pair].said.names) = (Word::Named, names);
            let hits = |measure| counts(&told, "pairs", measure).expect("a share")[0];
            assert_eq!((hits("one of the two named, or both"), hits("others named")), (right, plainly));
        }
    }

    #[test]
    fn numbers_that_are_no_shares_have_their_intervals() {
        let lines = of(&told(), &[]);
        let size = line(&lines, "mechanism, found", "mean size of the set");
        assert_eq!((size.value, size.between), (Some(1.0), Some([1.0, 1.0])));
        let mut own = Lines { design: "rich", lines: Vec::new() };
        let values: Vec<f64> = (0..100).map(f64::from).collect();
        own.value("any", "mean", &values, mean);
        let [low, high] = own.lines[0].between.expect("drawn anew");
        // Standard error 2.89, root of n / (n - 1) less; a thousand draws know the ends to a tenth.
        let half = 1.96 * 28.87 / 10.0;
        assert!((low - (49.5 - half)).abs() < 0.6 && (high - (49.5 + half)).abs() < 0.6, "{low} {high}");
    }

    #[test]
    fn who_knows_all_is_always_right_and_with_permuted_labels_by_chance() {
        let told = told();
        let lines = of(&told, &[]);
        for (group, measure, value) in [
            ("all groups", "a name given is right", 1.0),
            ("mechanism, strong", "named", 1.0),
            ("mechanism, other code", "another one named", 0.0),
            ("catalogue and nothing", "correct", 1.0),
            ("mechanism, found", "the set holds it", 1.0),
            ("mechanism, other code, found", "the set holds it", 1.0),
            ("outside its prior, 3 spreads", "named, and said to lie outside", 1.0),
            ("outside its prior", "the verdict holds it", 1.0),
            ("mechanism, strong", "shift of 3 or more", 1.0),
            ("mechanism, weak", "shift of 3 or more", 0.0),
            ("mechanism, strong", "named where the shift is 3 or more", 1.0),
            ("out of catalogue", "wrongly named", 0.0),
        ] {
            assert_eq!(line(&lines, group, measure).value, Some(value), "{group}: {measure}");
        }
        // The strong ones of our code are all that lie in that band.
        let moved = line(&lines, "mechanism, strong", "shift of 3 or more").counts;
        assert_eq!(moved, line(&lines, "mechanism, shift 3 to 10", "named").counts);
        let error = line(&lines, "mechanism, found", "calibration error of the likeliest").value;
        assert!((error.expect("some are found") - 0.05).abs() < 1e-12);
        let permuted = line(&lines, "mechanism, labels permuted", "a name given is right");
        let [low, high] = permuted.between.expect("there are some");
        // 216 names of 18 mechanisms, of which two are one in other words: (16 x 12^2 + 24^2) / 216^2, of which one order scatters by
        // 0.016.
        let by_chance = 2880.0 / 46_656.0;
        assert!(low < by_chance && by_chance < high && high < 0.12, "{low} to {high}");
        assert!(permuted.value.is_some_and(|share| (share - by_chance).abs() < 0.002), "{permuted:?}");
        // One that moves little and is not named lowers what is named, but not of those that move much.
        let mut told = told;
        let strong = told.iter_mut().find(|j| j.shift == Some(5.0)).expect("a strong one");
        (strong.shift, strong.said.verdict) = (Some(1.0), Word::NothingFound);
        let some = of(&told, &[]);
        for (measure, value) in [("named", 0.98), ("shift of 3 or more", 0.98)] {
            assert!(
                line(&some, "mechanism, strong", measure)
                    .value
                    .is_some_and(|share| share > value && share < 1.0)
            );
        }
        assert_eq!(line(&some, "mechanism, strong", "named where the shift is 3 or more").value, Some(1.0));
        // Of nothing, nothing is told; and of a design without campaigns.
        assert_eq!(line(&lines, "learnt laws", "accepted").value, None);
        assert!(markdown(&lines).contains("| mechanism, strong | named | - | 72/72 100 % [94, 100] |"));
    }

    #[test]
    fn what_was_learnt_of_laws_is_counted() {
        let law =
            Learnt { within: [4, 5], collapse: Some(true), sign: Some(true), goes: true, accepted: true };
        let all = [
            Some(law.clone()),
            Some(Learnt { within: [5, 5], collapse: Some(false), sign: Some(false), ..law.clone() }),
            Some(Learnt { collapse: None, sign: None, goes: false, accepted: false, ..law }),
            None,
        ];
        let lines = of(&[], &all);
        let counts = |measure| line(&lines, "learnt laws", measure).counts;
        assert_eq!(counts("a law was learnt"), Some([3, 4]));
        assert_eq!(counts("its band holds the truth"), Some([13, 15]));
        assert_eq!(counts("the collapse of one more wall lies within"), Some([1, 2]));
        assert_eq!(
            (counts("a sign given is right"), counts("the sign is given and right")),
            (Some([1, 2]), Some([1, 2]))
        );
        assert_eq!(counts("accepted"), Some([2, 3]));
    }

    #[test]
    fn who_is_calibrated_errs_by_chance_alone() {
        let mut stream = Streams::new(3, 0).of("given");
        let mut given = |count: usize, shift: f64| -> Vec<(f64, bool)> {
            let mut one = || (stream.uniform(), stream.uniform());
            (0..count).map(|_| one()).map(|(p, u)| (p, u < (p - shift).max(0.0))).collect()
        };
        // Ten bins of four: 0.8 of a standard deviation of 0.2 each.
        let few = chance_error(&given(40, 0.0)).expect("some");
        assert!((0.1..0.2).contains(&few), "{few}");
        let many = given(40_000, 0.0);
        assert!(chance_error(&many).expect("some") < 0.01);
        assert!(calibration_error(&many).expect("some") < 0.01);
        // Who gives 0.2 too much is seen to, whatever chance makes.
        let sure = given(40_000, 0.2);
        assert!((calibration_error(&sure).expect("some") - 0.18).abs() < 0.01);
        assert_eq!(chance_error(&[]), None);
    }

    #[test]
    fn another_word_for_the_same_thing_is_not_wrong() {
        let mut judged = told();
        judged.retain(|j| j.label.group == Group::Unknown);
        for j in &mut judged {
            (j.said.verdict, j.said.names) = (Word::Named, vec!["lean".to_owned()]);
        }
        let lines = of(&judged, &[]);
        assert_eq!(line(&lines, "backlash", "wrongly named").counts, Some([0, 5]));
        assert_eq!(line(&lines, "knock", "wrongly named").counts, Some([5, 5]));
        assert_eq!(line(&lines, "out of catalogue", "wrongly named").counts, Some([65, 70]));
    }
}
