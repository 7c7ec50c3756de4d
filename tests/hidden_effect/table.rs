//! What was said beside what was true: shares and means, by design and group.

use pirca::random::Streams;
use pirca::stats::{mean, quantile};

use crate::inference::{Gains, Said, Word};
use crate::truth::decoys::DECOYS;
use crate::truth::designs::Design;
use crate::truth::label::{Group, Label};
use crate::truth::roster::catalogue;
use crate::truth::strength::Strength;
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
/// tilt, or from specimen to specimen).
const LEARNT: [&str; 2] = ["drift", "knock"];

/// Bands of the shift that an effect makes, in standard deviations.
const SHIFTS: [[f64; 2]; 4] = [[0.0, 1.0], [1.0, 3.0], [3.0, 10.0], [10.0, f64::INFINITY]];

/// A shift that data mostly show. The lines say 3.
const CLEAR: f64 = 3.0;

/// A campaign that was judged by a design.
#[derive(Clone, Debug)]
pub struct Judged {
    pub label: Label,
    pub design: String,
    pub said: Said,
    /// What the extended model gains, where that was measured.
    pub gains: Option<Gains>,
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
        self.said.verdict == Word::Named
    }

    /// Whether a cause is hidden, by its own name or by one that means the same.
    fn is_hidden(&self, cause: &str) -> bool {
        self.label.hidden.iter().any(|hidden| {
            let unknown = UNKNOWN.iter().find(|unknown| unknown.name == hidden.name);
            hidden.name == cause || unknown.is_some_and(|unknown| unknown.aliases.contains(&cause))
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

    /// Whether the interval of the gain on specimens held out, in the logarithm of the probability, lies above 0.
    fn gains(&self) -> bool {
        let own = |gains: &Gains| gains.specimens.is_some_and(|[[_, low, _], ..]| low > 0.0);
        self.gains.as_ref().is_some_and(own)
    }

    /// The same on the largest tilts.
    fn gains_further(&self) -> bool {
        let own = |gains: &Gains| gains.tilts.is_some_and(|[[_, low, _], ..]| low > 0.0);
        self.gains.as_ref().is_some_and(own)
    }

    fn other_code(&self) -> bool {
        self.label.hidden.iter().any(|hidden| hidden.other_code)
    }

    /// Whether what is said is all that should be: nothing where nothing is hidden, the name of a mechanism.
    fn correct(&self) -> bool {
        match self.label.group {
            Group::Nothing | Group::PriorWrong => !self.found(),
            _ => self.right(),
        }
    }
}

/// The table of campaigns that were judged, and of those that were judged by a catalogue without their mechanism.
pub fn of(judged: &[Judged], removed: &[Judged]) -> Vec<Line> {
    Design::ALL.into_iter().flat_map(|design| of_design(design.name(), judged, removed)).collect()
}

fn of_design(design: &'static str, judged: &[Judged], removed: &[Judged]) -> Vec<Line> {
    let own: Vec<&Judged> = judged.iter().filter(|j| j.design == design).collect();
    let of = |group: Group| own.iter().copied().filter(move |j| j.label.group == group).collect::<Vec<_>>();
    let (nothing, far, mechanisms) = (of(Group::Nothing), of(Group::PriorWrong), of(Group::Mechanism));
    let ours: Vec<&Judged> = mechanisms.iter().copied().filter(|j| !j.other_code()).collect();
    let catalogued: Vec<&Judged> = [&nothing[..], &far[..], &mechanisms[..]].concat();
    let mut lines = Lines { design, lines: Vec::new() };
    lines.share("all groups", "a name given is right", &named(&own), Judged::right);
    lines.share("catalogue and nothing", "a name given is right", &named(&catalogued), Judged::right);
    lines.share("nothing hidden", "found", &nothing, Judged::found);
    lines.share("nothing hidden", "named", &nothing, Judged::named);
    lines.share("prior wrong", "found", &far, Judged::found);
    lines.share("prior wrong", "named", &far, Judged::named);
    for strength in Strength::ALL.into_iter().rev() {
        let some: Vec<&Judged> =
            mechanisms.iter().copied().filter(|j| j.label.hidden[0].strength == Some(strength)).collect();
        let group = format!("mechanism, {}", strength.name());
        lines.of_mechanisms(&group, &some);
        let moved: Vec<&Judged> = some.into_iter().filter(|j| j.shift.is_some()).collect();
        let is_clear = |j: &Judged| j.shift.is_some_and(|shift| shift >= CLEAR);
        lines.share(&group, "shift of 3 or more", &moved, is_clear);
        let clear: Vec<&Judged> = moved.into_iter().filter(|j| is_clear(j)).collect();
        lines.share(&group, "named where the shift is 3 or more", &clear, Judged::right);
    }
    lines.of_mechanisms("mechanism, our code", &ours);
    let other: Vec<&Judged> = mechanisms.iter().copied().filter(|j| j.other_code()).collect();
    lines.of_mechanisms("mechanism, other code", &other);
    lines.share("mechanism, other code", "a name given is right", &named(&other), Judged::right);
    for [low, high] in SHIFTS {
        let some = |j: &&Judged| j.shift.is_some_and(|shift| (low..high).contains(&shift));
        let some: Vec<&Judged> = ours.iter().copied().filter(some).collect();
        let to = if high.is_finite() { format!("{low} to {high}") } else { format!("above {low}") };
        lines.of_mechanisms(&format!("mechanism, shift {to}"), &some);
    }
    for mechanism in catalogue() {
        let some = |j: &&Judged| {
            j.label.hidden[0].name == mechanism.name && j.label.hidden[0].strength == Some(Strength::Strong)
        };
        let some: Vec<&Judged> = mechanisms.iter().copied().filter(some).collect();
        let group = format!("{}, strong", mechanism.name);
        lines.of_mechanisms(&group, &some);
        let shifts: Vec<f64> = some.iter().filter_map(|j| j.shift).collect();
        lines.value(&group, "median shift", &shifts, |shifts| quantile(shifts, 0.5));
    }
    let found: Vec<&Judged> = mechanisms.iter().copied().filter(|j| j.found()).collect();
    for (group, of) in [
        ("mechanism, found", &mechanisms),
        ("mechanism, our code, found", &ours),
        ("mechanism, other code, found", &other),
    ] {
        let found: Vec<&Judged> = of.iter().copied().filter(|j| j.found()).collect();
        lines.share(group, "the set holds it", &found, |j| j.said.set.contains(&j.label.hidden[0].name));
    }
    let sizes: Vec<f64> = found.iter().map(|j| j.said.set.len() as f64).collect();
    lines.value("mechanism, found", "mean size of the set", &sizes, mean);
    let few: Vec<&Judged> = found.iter().copied().filter(|j| j.said.verdict == Word::Ambiguous).collect();
    lines.share("mechanism, ambiguous", "the verdict holds it", &few, |j| {
        j.said.names.iter().any(|name| j.is_hidden(name))
    });
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
    for (group, of) in [("mechanism, named", named(&mechanisms)), ("nothing hidden", nothing.clone())] {
        let measured: Vec<&Judged> = of.into_iter().filter(|j| j.gains.is_some()).collect();
        lines.share(group, "a gain on specimens held out", &measured, Judged::gains);
        lines.share(group, "a gain on the largest tilts held out", &measured, Judged::gains_further);
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
    let without: Vec<&Judged> = removed.iter().filter(|j| j.design == design).collect();
    lines.share("out of the catalogue in turn", "found", &without, Judged::found);
    lines.share("out of the catalogue in turn", "wrongly named", &without, Judged::wrong);
    let decoys = of(Group::Decoy);
    lines.share("decoys", "found", &decoys, Judged::found);
    lines.share("decoys", "named", &decoys, Judged::named);
    lines.share("catalogue and nothing", "correct", &catalogued, Judged::correct);
    let still = |j: &Judged| matches!(j.label.group, Group::Nothing | Group::PriorWrong);
    lines.share("catalogue and nothing", "correct if nothing is ever found", &catalogued, still);
    let frequent = most_frequent(&catalogued);
    lines.share("catalogue and nothing", "correct if the most frequent is always named", &catalogued, |j| {
        frequent.as_ref().is_some_and(|name| j.is_hidden(name))
    });
    let named = named(&mechanisms);
    let shares = permuted(&named);
    lines.plain("mechanism, labels permuted", "a name given is right", mean(&shares));
    lines.between(&shares);
    lines.plain("mechanism, labels permuted", "share of names right to be expected", by_chance(&named));
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
        let hits = of.iter().filter(|j| hit(j)).count();
        let value = (!of.is_empty()).then(|| hits as f64 / of.len() as f64);
        let counts = Some([hits, of.len()]);
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

/// The mechanism that is hidden most often, the first of several.
fn most_frequent(of: &[&Judged]) -> Option<String> {
    let count = |name: &str| of.iter().filter(|j| j.is_hidden(name)).count();
    let names = catalogue().into_iter().map(|mechanism| mechanism.name).rev();
    names.max_by_key(|name| count(name)).map(str::to_owned)
}

/// Share of names that are right on average over all orders of the labels.
fn by_chance(of: &[&Judged]) -> Option<f64> {
    let right = |j: &Judged| {
        let hides = |other: &&&Judged| j.said.names.iter().all(|name| other.is_hidden(name));
        of.iter().filter(hides).count() as f64 / of.len() as f64
    };
    mean(&of.iter().map(|j| right(j)).collect::<Vec<_>>())
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
        let all = roster(0.2, 3, &BTreeMap::new()).into_iter();
        all.map(|label| {
            let name = label.hidden.first().map(|hidden| hidden.name.clone());
            let name = name.filter(|_| label.group == Group::Mechanism);
            let verdict = if name.is_some() { Word::Named } else { Word::NothingFound };
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
            let ours = label.group == Group::Mechanism && !label.hidden[0].other_code;
            let strong = ours && label.hidden[0].strength == Some(Strength::Strong);
            let shift = ours.then_some(if strong { 5.0 } else { 1.0 });
            Judged { label, design: Design::Rich.name().to_owned(), said, gains: None, shift }
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
        let wrong =
            |told: &[Judged]| counts(told, "mechanism, our code", "another one named").expect("a share")[0];
        let other = |j: &Judged| {
            let names = catalogue().into_iter().map(|mechanism| mechanism.name.to_owned());
            names.into_iter().find(|name| !j.is_hidden(name)).expect("there are more")
        };
        let one = told.iter().position(|j| !j.other_code()).expect("two in three");
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
        assert!(low < 1.0 / 17.0 && 1.0 / 17.0 < high && high < 0.1, "{low} to {high}");
        // A thousand orders of 612 names, of which one scatters by 0.01.
        assert!(permuted.value.is_some_and(|share| (share - 1.0 / 17.0).abs() < 0.001), "{permuted:?}");
        // As many of every mechanism.
        let expected = line(&lines, "mechanism, labels permuted", "share of names right to be expected");
        assert!((expected.value.expect("some are named") - 1.0 / 17.0).abs() < 1e-12);
        // One that moves little and is not named lowers what is named, but not of those that move much.
        let mut told = told;
        let strong = told.iter_mut().find(|j| j.shift == Some(5.0)).expect("a strong one");
        (strong.shift, strong.said.verdict) = (Some(1.0), Word::NothingFound);
        let some = of(&told, &[]);
        for (measure, value) in [("named", 0.99), ("shift of 3 or more", 0.99)] {
            assert!(
                line(&some, "mechanism, strong", measure)
                    .value
                    .is_some_and(|share| share > value && share < 1.0)
            );
        }
        assert_eq!(line(&some, "mechanism, strong", "named where the shift is 3 or more").value, Some(1.0));
        // Of nothing, nothing is told; and of a design without campaigns.
        assert_eq!(line(&lines, "out of the catalogue in turn", "wrongly named").value, None);
        assert!(
            markdown(&lines)
                .contains("| mechanism, strong | named | - | - | - | 204/204 100 % [98, 100] | - |")
        );
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
        assert_eq!(line(&lines, "backlash", "wrongly named").counts, Some([0, 20]));
        assert_eq!(line(&lines, "knock", "wrongly named").counts, Some([20, 20]));
        assert_eq!(line(&lines, "out of catalogue", "wrongly named").counts, Some([260, 280]));
    }
}
