//! A specimen that is odd against its fellows: its readings are theirs times the ratio of two units.

use std::collections::BTreeMap;

use crate::critic::diagnose::design::Design;
use crate::critic::diagnose::doubt::Doubt;
use crate::critic::diagnose::units::factors;
use crate::math::ln;
use crate::stats;
use crate::study::{MeasuredQuantity, Measurement};

/// How far the ratio to the fellows may be from that of the units, as a factor: walls of one family move by half more or less, and
/// the nearest two ratios of lengths, 10 and 25.4, are further apart than twice this.
const NEAR: f64 = 1.5;
/// How far the ratios of single readings may be from their median, and fellows from each other, as a factor: what is read near the
/// error or with one digit is that far off.
const ALIKE: f64 = 2.0;
/// Fellows show something where they show so many standard deviations of their error.
const SHOWN: f64 = 3.0;
/// A reading by itself is odd only where they show more: its own error must not make it a tenth.
const SHOWN_ALONE: f64 = 10.0;

/// A reading beside what the specimens of its family show there.
struct Beside<'m> {
    reading: &'m Measurement,
    /// In the middle of all specimens, or on the other of two.
    usual: f64,
    /// How many standard deviations that is.
    shown: f64,
}

impl Beside<'_> {
    /// Logarithm of the ratio; `None` where the signs differ or nothing was read.
    fn log(&self) -> Option<f64> {
        let ratio = self.reading.value / self.usual;
        (ratio > 0.0 && ratio.is_finite()).then(|| ln(ratio))
    }
}

/// Doubts about specimens, then about single readings of others, in the order of the design.
pub fn odd_ones(design: &Design) -> Vec<Doubt> {
    let mut groups: BTreeMap<(usize, Option<MeasuredQuantity>), BTreeMap<&str, Vec<&Measurement>>> =
        BTreeMap::new();
    for (family, m) in design.readings().filter(|(_, m)| !m.kind.is_censored()) {
        // Displacements of one specimen are read by one gauge; what a fixed target shows is no matter of the wall.
        let alone = (!m.quantity.has_tilt()).then_some(m.quantity);
        if m.quantity != MeasuredQuantity::FixedTarget {
            groups.entry((family, alone)).or_default().entry(&m.specimen).or_default().push(m);
        }
    }
    groups.values().flat_map(among).collect()
}

/// Doubts about readings of one kind in one family, by specimen.
fn among(specimens: &BTreeMap<&str, Vec<&Measurement>>) -> Vec<Doubt> {
    let beside: Vec<Vec<Beside<'_>>> = specimens
        .iter()
        .map(|(name, own)| own.iter().filter_map(|m| beside(name, m, specimens)).collect())
        .collect();
    let middle = |own: &Vec<Beside<'_>>| median(&logs(own));
    let middles: Vec<f64> = beside.iter().filter_map(middle).collect();
    let usual = middles.iter().filter(|log| log.abs() < ln(ALIKE)).count();
    let of_two = specimens.len() == 2;
    // Where most specimens differ there is none that is odd.
    if !of_two && 2 * usual <= middles.len() {
        return Vec::new();
    }
    let mut found: Vec<Doubt> = Vec::new();
    for own in &beside {
        let whole: Vec<&Beside<'_>> = own.iter().collect();
        let least = own.first().map_or(1, |b| if b.reading.quantity.has_tilt() { 3 } else { 1 });
        match factor(&whole) {
            Some(factor) if whole.len() >= least => found.push(doubt(&whole, factor, true, !of_two)),
            _ => found.extend(parts(own)),
        }
        // Of two, each is odd beside the other.
        if of_two && !found.is_empty() {
            break;
        }
    }
    found
}

/// What the specimens show where one was read: in the middle of all, itself among them, so that one that is odd moves nothing; of
/// two it is what the other shows. `None` where that is lost in its error.
fn beside<'m>(
    name: &str,
    m: &'m Measurement,
    specimens: &BTreeMap<&str, Vec<&Measurement>>,
) -> Option<Beside<'m>> {
    let others = specimens.iter().filter(|(other, _)| specimens.len() > 2 || **other != name);
    let shown: Vec<(f64, f64)> = others.filter_map(|(_, own)| at(own, m)).collect();
    if shown.len() < if specimens.len() > 2 { 3 } else { 1 } {
        return None;
    }
    let middle = |of: fn(&(f64, f64)) -> f64| stats::quantile(&shown.iter().map(of).collect::<Vec<_>>(), 0.5);
    let (usual, error) = (middle(|(value, _)| *value)?, middle(|(_, error)| *error)?);
    let shown = usual.abs() / error.max(f64::MIN_POSITIVE);
    (m.value != 0.0 && shown >= SHOWN).then_some(Beside { reading: m, usual, shown })
}

/// What a specimen shows of the quantity of a reading at its tilt, and the error there: between its own tilts in proportion, from
/// nothing at 0 deg on.
fn at(own: &[&Measurement], m: &Measurement) -> Option<(f64, f64)> {
    let mut same: Vec<&&Measurement> = own.iter().filter(|other| other.quantity == m.quantity).collect();
    same.sort_by(|a, b| a.tilt.unwrap_or(0.0).total_cmp(&b.tilt.unwrap_or(0.0)));
    let error = |m: &Measurement| {
        (m.error * m.error + m.common_error * m.common_error + m.resolution * m.resolution / 12.0).sqrt()
    };
    let Some(tilt) = m.tilt else { return same.first().map(|own| (own.value, error(own))) };
    let above = same.iter().position(|other| other.tilt.is_some_and(|own| own >= tilt - 1e-9))?;
    let (from, below) = match above.checked_sub(1).and_then(|below| same.get(below)) {
        Some(below) => (below.tilt?, below.value),
        None => (0.0, 0.0),
    };
    let to = same[above].tilt?;
    let share = if to > from { ((tilt - from) / (to - from)).min(1.0) } else { 1.0 };
    Some((below + share * (same[above].value - below), error(same[above])))
}

/// Readings of a specimen that are odd among its own: all of a quantity, all at a tilt, or one.
fn parts(own: &[Beside<'_>]) -> Vec<Doubt> {
    let quantity = |b: &Beside<'_>| (Some(b.reading.quantity), None, 0_usize);
    let tilt = |b: &Beside<'_>| (None, b.reading.tilt.map(f64::to_bits), 0_usize);
    let single =
        |b: &Beside<'_>| (Some(b.reading.quantity), b.reading.tilt.map(f64::to_bits), b.reading.line);
    let mut found: Vec<Doubt> = Vec::new();
    let mut told: Vec<*const Measurement> = Vec::new();
    for key in
        [&quantity as &dyn Fn(&Beside<'_>) -> (Option<MeasuredQuantity>, Option<u64>, usize), &tilt, &single]
    {
        let mut groups: BTreeMap<_, Vec<&Beside<'_>>> = BTreeMap::new();
        own.iter().for_each(|b| groups.entry(key(b)).or_default().push(b));
        for (own_key, group) in groups {
            let rest: Vec<&Beside<'_>> = own.iter().filter(|b| key(b) != own_key).collect();
            let logs: Vec<f64> = rest.iter().filter_map(|b| b.log()).collect();
            // What differs from its fellows must differ from the specimen's other readings, too.
            let is_usual = rest.len() >= 2 && median(&logs).is_some_and(|log| log.abs() < ln(ALIKE));
            let is_new = group.iter().all(|b| !told.contains(&std::ptr::from_ref(b.reading)));
            let is_plain = group.len() > 1 || group.iter().all(|b| b.shown >= SHOWN_ALONE);
            if let Some(factor) = factor(&group)
                && is_usual
                && is_new
                && is_plain
            {
                told.extend(group.iter().map(|b| std::ptr::from_ref(b.reading)));
                found.push(doubt(&group, factor, false, true));
            }
        }
    }
    found
}

/// The ratio of two units by which all of these readings are off, below 1 where they are too small; `None` where they are not, or do
/// not agree.
fn factor(group: &[&Beside<'_>]) -> Option<f64> {
    let logs: Vec<f64> = group.iter().filter_map(|b| b.log()).collect();
    let middle = median(&logs).filter(|_| logs.len() == group.len())?;
    let agree = logs.iter().all(|log| (log - middle).abs() <= ln(ALIKE));
    let dimension = group.first()?.reading.quantity.dimension();
    let near =
        factors(dimension).into_iter().find(|factor| (middle.abs() - ln(*factor)).abs() <= ln(NEAR))?;
    agree.then(|| if middle < 0.0 { 1.0 / near } else { near })
}

fn logs(own: &[Beside<'_>]) -> Vec<f64> {
    own.iter().filter_map(Beside::log).collect()
}

fn median(values: &[f64]) -> Option<f64> {
    stats::quantile(values, 0.5)
}

fn doubt(group: &[&Beside<'_>], factor: f64, whole: bool, alone: bool) -> Doubt {
    let mut lines: Vec<usize> = group.iter().map(|b| b.reading.line).collect();
    lines.sort_unstable();
    lines.dedup();
    let first = group[0];
    let (readings, usual) = (group.len(), first.usual);
    Doubt::OtherUnit { lines, first: Box::new(first.reading.clone()), usual, factor, readings, whole, alone }
}
