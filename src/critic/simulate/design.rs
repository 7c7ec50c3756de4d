//! What was read on which specimen: the design that a measured campaign shares with every simulated one.

use std::collections::BTreeMap;

use crate::critic::compare::is_rising;
use crate::critic::simulate::bank::Test;
use crate::math::ln;
use crate::random::Streams;
use crate::random::standard_normal::quantile;
use crate::study::{MeasuredKind, MeasuredQuantity, Measurement, Study, Under};

/// A test on a wall.
#[derive(Clone, Debug, PartialEq)]
pub struct Specimen {
    /// Its name.
    pub name: String,
    /// Index of its arm.
    pub family: usize,
    /// Place in the order of the tests, from 1, where that is known.
    pub order: Option<u32>,
    /// Whether it is turned round beforehand. Only planned specimens are: measured ones are of an arm that says so.
    pub turned: bool,
    /// Its readings, in the order of the file.
    pub readings: Vec<Measurement>,
}

impl Specimen {
    /// The tilts (rad) or drifts that it was read at, each once, ascending.
    pub fn tilts(&self) -> Vec<f64> {
        tilts(&self.readings)
    }

    /// Where its readings lie among each other: on the tilting table the tilt over the largest one; in shear, where the first readings
    /// are far closer to each other than the last, 0 at the smallest drift and 1 at the widest, by the logarithm. `None` of a
    /// quantity that has neither. Of motions of the base the place in their sequence, from 0 to 1.
    pub fn places(&self) -> impl Fn(&Measurement) -> Option<f64> + use<> {
        let tilted = self.readings.iter().filter_map(|m| m.tilt).fold(0.0, f64::max);
        let drifts = || self.readings.iter().filter_map(|m| m.drift).map(f64::abs);
        let (first, last) = (drifts().fold(f64::INFINITY, f64::min), drifts().fold(0.0, f64::max));
        let stages = || self.readings.iter().filter(|m| m.under.is_some()).map(|m| f64::from(m.stage));
        let (early, late) = (stages().fold(f64::INFINITY, f64::min), stages().fold(0.0, f64::max));
        move |m| match (m.tilt, m.drift) {
            _ if m.under.is_some() => (late > early).then(|| (f64::from(m.stage) - early) / (late - early)),
            (Some(tilt), _) => Some(tilt / tilted),
            (None, Some(_)) if first >= last => Some(1.0),
            (None, drift) => Some(ln(drift?.abs() / first) / ln(last / first)),
        }
    }
}

/// The tilts (rad) or drifts of readings, each once, ascending.
pub fn tilts<'m>(readings: impl IntoIterator<Item = &'m Measurement>) -> Vec<f64> {
    let mut tilts: Vec<f64> = readings.into_iter().filter_map(Measurement::at).collect();
    tilts.sort_by(f64::total_cmp);
    tilts.dedup();
    tilts
}

/// The motions that readings were taken under, each once, in their order.
pub fn motions<'m>(readings: impl IntoIterator<Item = &'m Measurement>) -> Vec<&'m Under> {
    let mut motions: Vec<&Under> = Vec::new();
    for under in readings.into_iter().filter_map(|m| m.under.as_ref()) {
        if !motions.contains(&under) {
            motions.push(under);
        }
    }
    motions
}

/// All tests, and what was measured apart from them.
#[derive(Clone, Debug, PartialEq)]
pub struct Design {
    /// The specimens that were tilted or sheared, in the order of the file.
    pub specimens: Vec<Specimen>,
    /// Two-stone tests, weights of specimens and readings of fixed targets: the index of their family's arm, and the reading.
    pub apart: Vec<(usize, Measurement)>,
    /// Lines of the file that a diagnosis does not use.
    pub unused: Vec<(Unused, usize)>,
}

/// Why a line of the file is not used.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Unused {
    /// The study does not evaluate the arm.
    NotEvaluated,
    /// The weight of a single block.
    BlockWeight,
    /// A displacement at 0 deg that no earlier stage makes a remainder of: it is 0, whatever the wall.
    AtLevel,
    /// Read at a tilt that the wall had come to before.
    Again,
    /// Read in another kind of test than the study's.
    OtherTest,
}

/// What a reading shows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Seen {
    /// A value (SI).
    Value(f64),
    /// That the value is on the bound's side, and no more.
    Beyond,
    /// Of an outcome, that the wall fell.
    Fell,
    /// Of an outcome, that it stood.
    Stood,
    /// Nothing: the wall had fallen.
    Nothing,
}

impl Design {
    /// The design of a study's measurements, and what was seen, by specimen and reading, what was measured apart last.
    pub fn of(study: &Study) -> (Design, Campaign) {
        let mut design = Design { specimens: Vec::new(), apart: Vec::new(), unused: Vec::new() };
        let test = Test::of(study);
        let is_of_test = |m: &Measurement| match test {
            Test::Tilting => !m.quantity.has_drift() && m.under.is_none(),
            Test::Shaking => m.under.is_some(),
            // Along x+ alone: the other way of a wall is that of the same wall turned round.
            Test::Shear { .. } => m.drift.is_some_and(|drift| drift > 0.0),
        };
        for m in &study.measured {
            let Some(family) = study.arms.iter().position(|arm| arm.name == m.family) else {
                design.unused.push((Unused::NotEvaluated, m.line));
                continue;
            };
            match m.quantity {
                MeasuredQuantity::BlockWeight => design.unused.push((Unused::BlockWeight, m.line)),
                own if !own.is_apart() && !is_of_test(m) => design.unused.push((Unused::OtherTest, m.line)),
                apart if apart.is_apart() => design.apart.push((family, m.clone())),
                _ if m.tilt == Some(0.0) => design.unused.push((Unused::AtLevel, m.line)),
                _ if !is_rising(m, &study.measured) => design.unused.push((Unused::Again, m.line)),
                _ => {
                    let of = |s: &&mut Specimen| s.name == m.specimen && s.family == family;
                    match design.specimens.iter_mut().find(of) {
                        Some(specimen) => specimen.readings.push(m.clone()),
                        None => design.specimens.push(Specimen {
                            name: m.specimen.clone(),
                            family,
                            order: m.order,
                            turned: false,
                            readings: vec![m.clone()],
                        }),
                    }
                }
            }
        }
        let seen = |m: &Measurement| match (m.quantity, m.kind) {
            (MeasuredQuantity::Outcome, MeasuredKind::Below) => Seen::Fell,
            (MeasuredQuantity::Outcome, _) => Seen::Stood,
            (_, kind) if kind.is_censored() => Seen::Beyond,
            _ => Seen::Value(m.value),
        };
        let specimens = design.specimens.iter().map(|s| s.readings.iter().map(seen).collect());
        let campaign = Campaign {
            specimens: specimens.collect(),
            apart: design.apart.iter().map(|(_, m)| seen(m)).collect(),
        };
        (design, campaign)
    }

    /// The families of the specimens (their arms), each once, in their order.
    pub fn families(&self) -> Vec<usize> {
        let mut families: Vec<usize> = self.specimens.iter().map(|specimen| specimen.family).collect();
        families.sort_unstable();
        families.dedup();
        families
    }

    /// All readings with their families, specimen by specimen, what was measured apart last.
    pub fn readings(&self) -> impl Iterator<Item = (usize, &Measurement)> {
        let specimens = self.specimens.iter();
        let of_walls = specimens.flat_map(|s| s.readings.iter().map(|reading| (s.family, reading)));
        of_walls.chain(self.apart.iter().map(|(family, reading)| (*family, reading)))
    }
}

/// What was seen in a campaign, measured or simulated, in the order of a [`Design`].
#[derive(Clone, Debug, PartialEq)]
pub struct Campaign {
    /// By specimen and reading.
    pub specimens: Vec<Vec<Seen>>,
    /// What was measured apart.
    pub apart: Vec<Seen>,
}

impl Campaign {
    /// What is read where walls (by specimen and reading, `None` once they have fallen) and what is measured apart have these
    /// values: a pure function of these and the streams.
    pub(in crate::critic) fn read(
        design: &Design,
        walls: &[Vec<Option<f64>>],
        apart: &[f64],
        streams: &Streams,
    ) -> Campaign {
        let score = |name: &str| quantile(streams.of(name).uniform());
        let mut shared = BTreeMap::new();
        let mut read = |value: f64, m: &Measurement, name: &str| {
            let (common, share) = *shared.entry(m.quantity.instrument()).or_insert_with(|| {
                let name = m.quantity.instrument().name();
                let share = streams.of(&format!("share of the common error {name}")).uniform();
                (score(&format!("common error {name}")), share)
            });
            let [random, whole] = m.errors(share);
            Seen::of(value + whole * common + random * score(name), m)
        };
        let specimens = walls.iter().zip(&design.specimens).enumerate().map(|(index, (values, specimen))| {
            let readings = values.iter().zip(&specimen.readings).enumerate();
            readings
                .map(|(k, (value, m))| match value {
                    Some(value) => read(*value, m, &format!("error {index} {k}")),
                    None => Seen::Nothing,
                })
                .collect()
        });
        let specimens: Vec<Vec<Seen>> = specimens.collect();
        let apart = apart.iter().zip(&design.apart).enumerate();
        let apart = apart.map(|(k, (value, (_, m)))| read(*value, m, &format!("error apart {k}")));
        Campaign { specimens, apart: apart.collect() }
    }

    /// What was seen, in the order of [`Design::readings`].
    pub fn seen(&self) -> impl Iterator<Item = Seen> {
        self.specimens.iter().flatten().chain(&self.apart).copied()
    }
}

impl Seen {
    /// What a value, its errors added, shows where a reading of this kind was taken.
    pub(in crate::critic) fn of(value: f64, m: &Measurement) -> Seen {
        if m.quantity == MeasuredQuantity::Outcome {
            return if value < m.value { Seen::Fell } else { Seen::Stood };
        }
        match m.kind {
            MeasuredKind::Exact => Seen::Value(value),
            MeasuredKind::Rounded => Seen::Value((value / m.resolution).round() * m.resolution),
            MeasuredKind::Below if value < m.value => Seen::Beyond,
            MeasuredKind::Above if value > m.value => Seen::Beyond,
            MeasuredKind::Below | MeasuredKind::Above => Seen::Value(value),
        }
    }

    /// As a number: what lies beyond a bound counts as lying on it, and of outcomes 0 as fallen and 1 as standing. `None` where nothing was
    /// seen.
    pub(in crate::critic) fn number(self, m: &Measurement) -> Option<f64> {
        match self {
            Seen::Value(value) => Some(value),
            Seen::Beyond => Some(m.value),
            Seen::Fell => Some(0.0),
            Seen::Stood => Some(1.0),
            Seen::Nothing => None,
        }
    }

    /// Whether a value was seen, and no side of one alone.
    pub(in crate::critic) fn is_value(self) -> bool {
        matches!(self, Seen::Value(_))
    }

    /// Whether the truth is seen to lie on the side that a censored reading says.
    pub(in crate::critic) fn is_as_said(self, m: &Measurement) -> bool {
        self.side(m).is_some_and(|side| (side == Side::Below) == (m.kind == MeasuredKind::Below))
    }

    /// On which side of the reading's value the truth lies, where that is all that was seen.
    pub(in crate::critic) fn side(self, m: &Measurement) -> Option<Side> {
        match (self, m.kind) {
            (Seen::Fell, _) | (Seen::Beyond, MeasuredKind::Below) => Some(Side::Below),
            (Seen::Stood, _) | (Seen::Beyond, _) => Some(Side::Above),
            (Seen::Value(_) | Seen::Nothing, _) => None,
        }
    }
}

/// A side of a value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::critic) enum Side {
    /// Below it.
    Below,
    /// Above it.
    Above,
}
