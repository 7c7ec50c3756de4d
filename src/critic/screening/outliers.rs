//! A specimen that is an outlier among those of its family: its readings are theirs times the ratio of two units.

use std::collections::BTreeMap;

use crate::critic::screening::note::{DataNote, Extent};
use crate::critic::screening::units::factors;
use crate::critic::simulate::Design;
use crate::math::ln;
use crate::stats;
use crate::study::{MeasuredQuantity, Measurement};

/// How far the ratio to the fellows may be from that of the units, as a factor: walls of one family move by half more or less, and
/// the nearest two ratios of lengths, 10 and 25.4, are further apart than twice this.
const NEAR: f64 = 1.5;
/// How far the ratios of single readings may be from their median, as a factor: what is read near the error or with one digit is
/// that far off.
const CONSISTENT: f64 = 2.0;
/// How far fellows may be from what is usual, as a factor: of three walls of the source paper one moves 2.1 times as far as another.
const FELLOWS: f64 = 3.0;
/// Fellows show something where they show so many standard deviations of their error.
const SHOWN: f64 = 3.0;
/// A reading alone is odd only where they show more: its own error must not make it a tenth.
const SHOWN_ALONE: f64 = 10.0;
/// Share of the fellows that must show what is usual: one of three others, or two of five, may be odd themselves. Where more differ,
/// as at the end of a wall between ropes that moves hardly at all, a small reading is nothing odd.
const AGREE: f64 = 0.6;

/// Readings of one kind by specimen.
type Specimens<'m> = BTreeMap<&'m str, Vec<&'m Measurement>>;

/// A part of a specimen's readings is odd only where it stands off so many times as far as any of its fellows, of which there are
/// [`OTHERS`] or more: the end of a wall between ropes may move by a tenth of what others do there, and others do by half.
const OFF: f64 = 4.0;
/// Of two fellows, both may be near the middle by chance.
const OTHERS: usize = 3;

/// A reading beside what the specimens of its family show there.
struct Beside<'m> {
    reading: &'m Measurement,
    /// In the middle of all specimens, or on the other of two.
    usual: f64,
    /// Share of the fellows that show it, within [`FELLOWS`].
    agree: f64,
    /// Whether all of them do within [`CONSISTENT`], and far beyond their error.
    is_plain: bool,
    /// Whether it stands off by [`OFF`] times what any of them does.
    is_off: bool,
}

impl Beside<'_> {
    /// Logarithm of the ratio; `None` where the signs differ or nothing was read.
    fn log(&self) -> Option<f64> {
        let ratio = self.reading.value / self.usual;
        (ratio > 0.0 && ratio.is_finite()).then(|| ln(ratio))
    }
}

/// Notes on specimens, then on single readings of others, in the order of the design.
pub fn unit_outliers(design: &Design) -> Vec<DataNote> {
    let mut groups: BTreeMap<(usize, Option<MeasuredQuantity>), Specimens<'_>> = BTreeMap::new();
    // What different motions do is not alike.
    let alike = |m: &Measurement| !m.kind.is_censored() && m.under.is_none();
    for (family, m) in design.readings().filter(|(_, m)| alike(m)) {
        // Displacements of one specimen are read by one gauge; what a fixed target shows is no matter of the wall.
        let alone = (!m.quantity.has_tilt()).then_some(m.quantity);
        if m.quantity != MeasuredQuantity::FixedTarget {
            groups.entry((family, alone)).or_default().entry(&m.specimen).or_default().push(m);
        }
    }
    groups.values().flat_map(among).collect()
}

/// Notes on readings of one kind in one family, by specimen.
fn among(specimens: &Specimens<'_>) -> Vec<DataNote> {
    let beside: Vec<Vec<Beside<'_>>> = specimens
        .iter()
        .map(|(name, own)| own.iter().filter_map(|m| beside(name, m, specimens)).collect())
        .collect();
    let of_two = specimens.len() == 2;
    let mut found: Vec<DataNote> = Vec::new();
    for (own, all) in beside.iter().zip(specimens.values()) {
        let whole: Vec<&Beside<'_>> = own.iter().collect();
        match factor(&whole) {
            Some(factor) => {
                let of = if of_two { Extent::OfTwo(all.len()) } else { Extent::Whole(all.len()) };
                found.push(note(&whole, factor, of));
            }
            None => found.extend(parts(own)),
        }
        // Of two, each is odd beside the other.
        if of_two && !found.is_empty() {
            break;
        }
    }
    found
}

/// What the specimens show where one was read: in the middle of all, itself among them, so that one that is odd moves nothing; of
/// two it is what the other shows. `None` where that is lost in its error, or the others do not agree.
fn beside<'m>(name: &str, m: &'m Measurement, specimens: &Specimens<'_>) -> Option<Beside<'m>> {
    let others = specimens.iter().filter(|(other, _)| **other != name);
    let others: Vec<(f64, f64)> = others.filter_map(|(_, own)| at(own, m)).collect();
    if others.len() < if specimens.len() > 2 { 2 } else { 1 } {
        return None;
    }
    let mut all = others.clone();
    if specimens.len() > 2 {
        all.push((m.value, error(m)));
    }
    let middle = |of: fn(&(f64, f64)) -> f64| median(&all.iter().map(of).collect::<Vec<_>>());
    let (usual, error) = (middle(|(value, _)| *value)?, middle(|(_, error)| *error)?);
    let within = |factor: f64| {
        others.iter().filter(|(value, _)| value / usual > 1.0 / factor && value / usual < factor).count()
    };
    let (shown, agree) = (usual.abs() / error, within(FELLOWS) as f64 / others.len() as f64);
    let furthest = others.iter().map(|(value, _)| (value - usual).abs()).fold(0.0, f64::max);
    let is_off = others.len() >= OTHERS && (m.value - usual).abs() > OFF * furthest;
    let is_plain = within(CONSISTENT) == others.len() && shown >= SHOWN_ALONE;
    (m.value != 0.0 && shown >= SHOWN && agree >= AGREE).then_some(Beside {
        reading: m,
        usual,
        agree,
        is_plain,
        is_off,
    })
}

/// Of a reading: its errors, and the rounding.
fn error(m: &Measurement) -> f64 {
    (m.error * m.error + m.common_error * m.common_error + m.resolution * m.resolution / 12.0).sqrt()
}

/// What a specimen shows of the quantity of a reading at its tilt or drift, and the error there: between its own in proportion, from
/// nothing at 0 on.
fn at(own: &[&Measurement], m: &Measurement) -> Option<(f64, f64)> {
    let mut same: Vec<&&Measurement> = own.iter().filter(|other| other.quantity == m.quantity).collect();
    same.sort_by(|a, b| a.at().unwrap_or(0.0).total_cmp(&b.at().unwrap_or(0.0)));
    let Some(tilt) = m.at() else { return same.first().map(|own| (own.value, error(own))) };
    let above = same.iter().position(|other| other.at().is_some_and(|own| own >= tilt - 1e-9))?;
    let (from, below) = match above.checked_sub(1).and_then(|below| same.get(below)) {
        Some(below) => (below.at()?, below.value),
        None => (0.0, 0.0),
    };
    let to = same[above].at()?;
    let share = if to > from { ((tilt - from) / (to - from)).min(1.0) } else { 1.0 };
    Some((below + share * (same[above].value - below), error(same[above])))
}

/// Readings of a specimen that are odd among its own: all of a quantity, all at a tilt, or one.
fn parts(own: &[Beside<'_>]) -> Vec<DataNote> {
    let quantity = |b: &Beside<'_>| (Some(b.reading.quantity), None, 0_usize);
    let tilt = |b: &Beside<'_>| (None, b.reading.at().map(f64::to_bits), 0_usize);
    let single =
        |b: &Beside<'_>| (Some(b.reading.quantity), b.reading.at().map(f64::to_bits), b.reading.line);
    let mut found: Vec<DataNote> = Vec::new();
    let mut noted: Vec<*const Measurement> = Vec::new();
    for key in
        [&quantity as &dyn Fn(&Beside<'_>) -> (Option<MeasuredQuantity>, Option<u64>, usize), &tilt, &single]
    {
        let mut groups: BTreeMap<_, Vec<&Beside<'_>>> = BTreeMap::new();
        own.iter().for_each(|b| groups.entry(key(b)).or_default().push(b));
        for (own_key, group) in groups {
            let rest: Vec<&Beside<'_>> = own.iter().filter(|b| key(b) != own_key).collect();
            let logs: Vec<f64> = rest.iter().filter_map(|b| b.log()).collect();
            // What differs from its fellows must differ from the specimen's other readings, too.
            let is_usual = rest.len() >= 2 && median(&logs).is_some_and(|log| log.abs() < ln(CONSISTENT));
            let is_new = group.iter().all(|b| !noted.contains(&std::ptr::from_ref(b.reading)));
            let is_off = group.iter().all(|b| b.is_off);
            if let Some(factor) = factor(&group)
                && is_usual
                && is_off
                && is_new
            {
                noted.extend(group.iter().map(|b| std::ptr::from_ref(b.reading)));
                found.push(note(&group, factor, Extent::Part));
            }
        }
    }
    found
}

/// The ratio of two units by which all of these readings are off, below 1 where they are too small; `None` where they are not, do
/// not agree, or are too few to tell.
fn factor(group: &[&Beside<'_>]) -> Option<f64> {
    let logs: Vec<f64> = group.iter().filter_map(|b| b.log()).collect();
    let middle = median(&logs).filter(|_| logs.len() == group.len())?;
    let agree = logs.iter().all(|log| (log - middle).abs() <= ln(CONSISTENT));
    let dimension = group.first()?.reading.quantity.dimension();
    let near =
        factors(dimension).into_iter().find(|factor| (middle.abs() - ln(*factor)).abs() <= ln(NEAR))?;
    // The fewer readings there are, the plainer the fellows must be.
    let is_plain = match group {
        [alone] => alone.is_plain,
        [_, _] => group.iter().all(|b| b.agree == 1.0),
        _ => true,
    };
    (agree && is_plain).then(|| if middle < 0.0 { 1.0 / near } else { near })
}

fn median(values: &[f64]) -> Option<f64> {
    stats::quantile(values, 0.5)
}

fn note(group: &[&Beside<'_>], factor: f64, extent: Extent) -> DataNote {
    let mut lines: Vec<usize> = group.iter().map(|b| b.reading.line).collect();
    lines.sort_unstable();
    lines.dedup();
    let (first, usual) = (Box::new(group[0].reading.clone()), group[0].usual);
    DataNote::OtherUnit { lines, first, usual, factor, readings: group.len(), extent }
}
