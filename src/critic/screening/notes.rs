//! What looks odd about measurements and is judged all the same: a slip of the pen does this, and so may a real effect.

use std::collections::BTreeMap;

use crate::critic::screening::contradictions::{contradicted, overturned};
use crate::critic::screening::note::DataNote;
use crate::critic::screening::outliers::unit_outliers;
use crate::critic::screening::units::ratios;
use crate::critic::simulate::{Campaign, Design, Seen, Unused, World};
use crate::protocol::Protocol;
use crate::random::Streams;
use crate::stats;
use crate::study::measured::Dimension;
use crate::study::{MeasuredKind, MeasuredQuantity, Measurement, Study};

/// Campaigns of the base model and of every cause that say what a reading may be.
const CAMPAIGNS: u64 = 150;
/// What is left out of a reading's range at either end.
const TAIL: f64 = 0.0005;
/// A range comes from so many campaigns in which the wall still stood.
const STANDING: usize = 100;

/// The notes that need no simulation.
pub fn data_notes(study: &Study, design: &Design) -> Vec<DataNote> {
    let mut found = Vec::new();
    if design.specimens.len() == 1 {
        found.push(DataNote::OneSpecimen);
    }
    let arm = |m: &Measurement| study.arms.iter().find(|arm| arm.name == m.family);
    let mut elsewhere: BTreeMap<&str, Vec<usize>> = BTreeMap::new();
    for m in study.measured.iter().filter(|m| arm(m).is_none()) {
        elsewhere.entry(&m.family).or_default().push(m.line);
    }
    found.extend(
        elsewhere
            .into_iter()
            .map(|(family, lines)| DataNote::NotEvaluated { family: family.to_owned(), lines }),
    );
    let readings = || design.specimens.iter().flat_map(|specimen| &specimen.readings);
    let level = design.unused.iter().filter(|(why, _)| *why == Unused::AtLevel);
    let level: Vec<usize> = level.map(|(_, line)| *line).collect();
    if !level.is_empty() {
        found.push(DataNote::Level { lines: level });
    }
    if let Protocol::Tilting(tilting) = &study.protocol {
        let beyond = readings().filter_map(|m| Some((m.line, m.tilt.filter(|tilt| *tilt > tilting.end)?)));
        let (lines, tilts): (Vec<usize>, Vec<f64>) = beyond.unzip();
        if !lines.is_empty() {
            let tilt = tilts.into_iter().fold(0.0, f64::max);
            found.push(DataNote::BeyondPlatform { lines, tilt, end: tilting.end });
        }
    }
    let thickness = |m: &Measurement| arm(m).map_or(f64::INFINITY, |arm| arm.layout.outline.base_thickness);
    let moved = readings().filter(|m| m.quantity.dimension() == Dimension::Length);
    // A bound from above says only that it is no more.
    let moved = moved.filter(|m| m.kind != MeasuredKind::Below);
    let further: Vec<&Measurement> = moved.filter(|m| m.value.abs() > thickness(m)).collect();
    found.extend(grouped(&further, |m| (m.quantity, m.family.clone())).into_iter().map(|(first, lines)| {
        DataNote::ThickerThanWall { lines, first: Box::new(first.clone()), thickness: thickness(first) }
    }));
    found.extend(overturned(study, design));
    found.extend(contradicted(design));
    found.extend(unit_outliers(design));
    found
}

/// The notes that come from campaigns of a world, those of every cause among them; a pure function of its arguments.
pub fn data_notes_by_simulation(
    world: &World<'_>,
    design: &Design,
    measured: &Campaign,
    seed: u64,
) -> Vec<DataNote> {
    let causes = std::iter::once(None).chain(world.causes().into_iter().map(Some));
    let simulated: Vec<Campaign> = causes
        .flat_map(|cause| (0..CAMPAIGNS).map(move |k| (cause, k)))
        .map(|(cause, k)| {
            let streams = Streams::new(seed, k);
            world.campaign(design, &world.drawn(cause, &streams), &streams)
        })
        .collect();
    let specimens = design.specimens.iter().enumerate().flat_map(|(index, specimen)| {
        let readings = specimen.readings.iter().enumerate();
        readings.map(move |(k, m)| (m, move |campaign: &Campaign| campaign.specimens[index][k]))
    });
    let read = |m: &Measurement, of: &dyn Fn(&Campaign) -> Seen| -> (Seen, Vec<f64>) {
        (of(measured), simulated.iter().filter_map(|campaign| of(campaign).number(m)).collect())
    };
    let specimens = specimens.map(|(m, of)| (m, read(m, &of)));
    let apart = design.apart.iter().enumerate();
    let apart = apart.map(|(k, (_, m))| (m, read(m, &|campaign| campaign.apart[k])));
    let mut fallen: Vec<&Measurement> = Vec::new();
    let mut out: Vec<(&Measurement, [f64; 2], Option<f64>)> = Vec::new();
    let is_number = |m: &Measurement| m.quantity != MeasuredQuantity::Outcome;
    for (m, (seen, shown)) in specimens.chain(apart).filter(|(m, _)| is_number(m)) {
        if shown.is_empty() {
            fallen.push(m);
        }
        let range = stats::quantile(&shown, TAIL).zip(stats::quantile(&shown, 1.0 - TAIL));
        let (Some((low, high)), Some(value)) = (range, seen.number(m)) else { continue };
        let slack = 0.5 * m.resolution + 1e-9 * value.abs();
        // A bound may lie anywhere on its other side.
        let inside = |x: f64| {
            (x >= low - slack || m.kind == MeasuredKind::Above)
                && (x <= high + slack || m.kind == MeasuredKind::Below)
        };
        if shown.len() >= STANDING && !inside(value) {
            let mut others = ratios(m.quantity.dimension()).into_iter().map(|ratio| value * ratio);
            out.push((m, [low, high], others.find(|x| inside(*x))));
        }
    }
    let mut found = Vec::new();
    let too_few = world.too_few().into_iter().map(|cause| world.mechanisms()[cause].name);
    let mechanisms: Vec<&'static str> = too_few.collect();
    if !mechanisms.is_empty() {
        found.push(DataNote::NotConsidered { mechanisms });
    }
    found.extend(
        grouped(&fallen, |m| (m.quantity, m.family.clone()))
            .into_iter()
            .map(|(first, lines)| DataNote::Fallen { lines, first: Box::new(first.clone()) }),
    );
    let readings: Vec<&Measurement> = out.iter().map(|(m, ..)| *m).collect();
    let of = |m: &Measurement| {
        out.iter().find(|(own, ..)| std::ptr::eq(*own, m)).map(|(_, range, fits)| (*range, *fits))
    };
    let kind =
        |m: &Measurement| (m.quantity, m.family.clone(), of(m).is_some_and(|(_, fits)| fits.is_some()));
    for (first, lines) in grouped(&readings, kind) {
        let Some((range, fits)) = of(first) else { continue };
        found.push(DataNote::OutOfRange { lines, first: Box::new(first.clone()), range, fits });
    }
    found
}

/// The first reading and all lines of each kind.
fn grouped<'m, K: Ord>(
    readings: &[&'m Measurement],
    kind: impl Fn(&Measurement) -> K,
) -> Vec<(&'m Measurement, Vec<usize>)> {
    let mut groups: BTreeMap<K, (&Measurement, Vec<usize>)> = BTreeMap::new();
    for m in readings {
        groups.entry(kind(m)).or_insert((m, Vec::new())).1.push(m.line);
    }
    groups.into_values().collect()
}
