//! Readings that cannot belong to one wall: beyond where it overturns, or points of its top that contradict their mean.

use std::collections::BTreeMap;

use crate::critic::screening::note::DataNote;
use crate::critic::simulate::Design;
use crate::protocol::Protocol;
use crate::study::{MeasuredKind, MeasuredQuantity, Measurement, Study};

/// How many standard deviations of its error a reading may be off.
const BEYOND: f64 = 3.0;
/// What is computed from several readings may be off by more of theirs: a campaign has many of them.
const APART: f64 = 5.0;
/// Below this share of the largest reading a contradiction is one of rounding.
const ROUNDING: f64 = 0.1;

/// Walls said to stand at a tilt where the arm's wall overturns as one rigid body; by family.
pub fn overturned(study: &Study, design: &Design) -> Vec<DataNote> {
    let Protocol::Tilting(tilting) = &study.protocol else { return Vec::new() };
    let mut found: BTreeMap<usize, (Vec<usize>, &Measurement, f64)> = BTreeMap::new();
    for (family, m) in design.readings() {
        let Some(most) = study.arms[family].stands_at_most(tilting.towards) else { continue };
        let stood = match (m.quantity, m.tilt) {
            (MeasuredQuantity::CollapseAngle, _) if m.kind != MeasuredKind::Below => {
                m.value - 0.5 * m.resolution - BEYOND * (m.error + m.common_error)
            }
            (_, Some(tilt)) => tilt,
            _ => continue,
        };
        if stood > most {
            found.entry(family).or_insert((Vec::new(), m, most)).0.push(m.line);
        }
    }
    found
        .into_values()
        .map(|(lines, first, most)| DataNote::Overturned { lines, first: Box::new(first.clone()), most })
        .collect()
}

/// Readings of the left, the centre and the right of a specimen with which its mean, or its difference of centre and ends, does not
/// agree at the same tilt.
pub fn contradicted(design: &Design) -> Vec<DataNote> {
    use MeasuredQuantity as Q;
    let mut found = Vec::new();
    for specimen in &design.specimens {
        for m in specimen.readings.iter().filter(|m| !m.kind.is_censored()) {
            let (points, weights) = match m.quantity {
                Q::DisplacementMean => {
                    ([Q::DisplacementLeft, Q::DisplacementCentre, Q::DisplacementRight], [1.0 / 3.0; 3])
                }
                Q::RemainderMean => {
                    ([Q::RemainderLeft, Q::RemainderCentre, Q::RemainderRight], [1.0 / 3.0; 3])
                }
                Q::DisplacementCentreMinusEnds => {
                    ([Q::DisplacementLeft, Q::DisplacementCentre, Q::DisplacementRight], [-0.5, 1.0, -0.5])
                }
                Q::RemainderCentreMinusEnds => {
                    ([Q::RemainderLeft, Q::RemainderCentre, Q::RemainderRight], [-0.5, 1.0, -0.5])
                }
                _ => continue,
            };
            let at = |point: Q| {
                let is =
                    |own: &&Measurement| own.quantity == point && own.tilt == m.tilt && own.stage == m.stage;
                specimen.readings.iter().find(is).filter(|own| !own.kind.is_censored())
            };
            let [Some(left), Some(centre), Some(right)] = points.map(at) else { continue };
            let read = [left, centre, right];
            let computed: f64 = read.iter().zip(weights).map(|(own, weight)| weight * own.value).sum();
            let parts: f64 =
                read.iter().zip(weights).map(|(own, weight)| weight * weight * variance(own)).sum();
            let largest = read.iter().map(|own| own.value.abs()).fold(m.value.abs(), f64::max);
            let off = (m.value - computed).abs();
            if off > APART * (variance(m) + parts).sqrt() && off > ROUNDING * largest {
                let mut lines: Vec<usize> = read.iter().map(|own| own.line).chain([m.line]).collect();
                lines.sort_unstable();
                lines.dedup();
                found.push(DataNote::Contradicted { lines, first: Box::new(m.clone()), computed });
            }
        }
    }
    found
}

/// Of a reading: its errors, and the rounding.
fn variance(m: &Measurement) -> f64 {
    m.error * m.error + m.common_error * m.common_error + m.resolution * m.resolution / 12.0
}
