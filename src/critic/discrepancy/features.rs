//! What a campaign looks like beside the base model, in few signed numbers that a person can name.
//!
//! Every reading is first set against what the base model shows of it, in units of its standard deviation there (joints unknown,
//! stones random, errors of the reading): by its logarithm where it is far above its error, as stiffnesses and stones act as factors,
//! and as it stands where it is not (the inverse hyperbolic sine). Of the readings of a specimen only a few contrasts are kept; of
//! these, per family, the mean over its specimens and their scatter.

#[cfg(test)]
mod tests;

use std::collections::BTreeMap;

use crate::critic::compare::reading_variance;
use crate::critic::simulate::{Campaign, Design, Seen, Specimen};
use crate::math::{asinh, cosh, ln};
use crate::stats;
use crate::study::{MeasuredQuantity, Measurement};

/// The contrasts of a specimen.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Contrast {
    /// The collapse angle, or which motions of the base the wall outlives.
    Collapse,
    /// Displacements as a whole.
    Level,
    /// Their growth with the tilt; of what motions of the base do, that from the first to the last.
    Growth,
    /// Whether they grow ever faster: middle tilts against low and high ones.
    Curvature,
    /// The centre against the two ends.
    Bow,
    /// The left end against the right one.
    Twist,
    /// What is left of the displacements when the platform has gone back.
    Left,
    /// The centre against the two ends in that.
    LeftBow,
    /// The largest step from one tilt to the next beside the steps before and after it, in errors of the readings.
    Jump,
    /// How much less a point moves over some tilt than over as much before it, in errors of the readings (the inverse hyperbolic sine
    /// of the most): walls move ever faster, a gauge at its end stands still.
    Slowing,
    /// Share of the readings that the wall still stood for.
    Reached,
}

/// A number of a campaign.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Feature {
    /// Mean of a contrast over the specimens of a family (its arm's index).
    Mean(usize, Contrast),
    /// Logarithm of its scatter between them.
    Scatter(usize, Contrast),
    /// How a contrast goes with the order of the tests, over all specimens.
    Order(Contrast),
    /// Mean of a contrast over the families whose ends are held, less that over those whose ends are free.
    Restraint(Contrast),
    /// How a contrast goes with the logarithm of the mean weight of a family's stones.
    StoneSize(Contrast),
    /// Something measured apart from the tilting tests: the family and the quantity.
    Apart(usize, MeasuredQuantity),
}

/// What readings are set against, by specimen and reading, what is measured apart last.
#[derive(Clone, Debug)]
pub struct Scale {
    specimens: Vec<Vec<Usual>>,
    apart: Vec<Usual>,
}

/// What the base model shows of a reading.
#[derive(Clone, Copy, Debug)]
struct Usual {
    /// Its standard deviation (SI).
    sd: f64,
    /// Readings far above this (SI) count by their logarithm.
    bend: f64,
    /// Mean and standard deviation of what they count.
    counted: [f64; 2],
    /// Their error and rounding in that standard deviation, where they are as usual.
    error: f64,
}

/// Contrasts whose scatter is looked at.
const SCATTERING: [Contrast; 3] = [Contrast::Collapse, Contrast::Level, Contrast::Growth];
/// Contrasts that are followed over the order of the tests.
const ORDERED: [Contrast; 2] = [Contrast::Collapse, Contrast::Level];
/// A scatter below the readings' errors and rounding, and below this, counts as these: three readings rounded to the same step do
/// not agree to all digits.
const LEAST_SCATTER: f64 = 0.05;
/// Readings of a point that show whether it slows down.
const SLOWED: usize = 5;
/// Tilts whose distances differ by no more than this share are evenly spaced.
const UNEVEN: f64 = 0.01;
/// No outcome is surer than this, nor less sure.
const LEAST_CHANCE: f64 = 0.05;
/// What counts as one standard deviation of the logarithm of the scale at which a wall just falls.
const OF_SCALE: f64 = 0.3;
/// A standard deviation below this share of the largest value counts as this: readings at a bound do not vary at all.
const LEAST_SHARE: f64 = 1e-3;

impl Scale {
    /// From campaigns of the base model.
    pub fn of(design: &Design, campaigns: &[Campaign]) -> Scale {
        let over = |m: &Measurement, seen: &dyn Fn(&Campaign) -> Seen| {
            let shown: Vec<f64> = campaigns.iter().filter_map(|campaign| seen(campaign).number(m)).collect();
            Usual::of(m, &shown)
        };
        let specimens = design.specimens.iter().enumerate().map(|(index, specimen)| {
            let readings = specimen.readings.iter().enumerate();
            readings.map(|(k, m)| over(m, &|campaign| campaign.specimens[index][k])).collect()
        });
        let apart = design.apart.iter().enumerate();
        let apart = apart.map(|(k, (_, m))| over(m, &|campaign| campaign.apart[k]));
        Scale { specimens: specimens.collect(), apart: apart.collect() }
    }

    /// The base model's standard deviation of every reading (SI), by specimen and reading.
    pub fn units(&self) -> Vec<Vec<f64>> {
        self.specimens.iter().map(|readings| readings.iter().map(|usual| usual.sd).collect()).collect()
    }

    /// Every reading in its units, with its family, what is measured apart not among them; `None` where nothing was seen.
    pub fn readings(&self, design: &Design, campaign: &Campaign) -> Vec<(usize, Option<f64>)> {
        let specimens = design.specimens.iter().zip(&campaign.specimens).zip(&self.specimens);
        specimens
            .flat_map(|((specimen, seen), scale)| {
                let readings = specimen.readings.iter().zip(seen).zip(scale);
                readings.map(|((m, seen), usual)| (specimen.family, usual.scaled(*seen, m)))
            })
            .collect()
    }
}

impl Usual {
    /// From what campaigns of the base model show (SI).
    fn of(m: &Measurement, shown: &[f64]) -> Usual {
        if m.quantity == MeasuredQuantity::Outcome {
            // 1 where walls stood. None is so sure that one that does otherwise is off beyond all measure.
            let bend = 1.0;
            let share = stats::mean(shown).unwrap_or(0.5).clamp(LEAST_CHANCE, 1.0 - LEAST_CHANCE);
            let step = asinh(1.0 / bend);
            let sd = step * (share * (1.0 - share)).sqrt();
            return Usual { sd: OF_SCALE, bend, counted: [step * share, sd], error: 0.0 };
        }
        let largest = shown.iter().fold(m.value.abs(), |largest, x| largest.max(x.abs()));
        let error = reading_variance(m).sqrt();
        // What is rounded to nothing in all of them, without any other error, varies by its rounding.
        let floor = m.error.max(LEAST_SHARE * largest);
        let floor = if floor > 0.0 { floor } else { error.max(f64::MIN_POSITIVE) };
        let bend = error.max(LEAST_SHARE * largest).max(f64::MIN_POSITIVE);
        let counted: Vec<f64> = shown.iter().map(|x| asinh(x / bend)).collect();
        let mean = stats::mean(&counted).unwrap_or_else(|| asinh(m.value / bend));
        // What makes it count one more there.
        let step = bend * cosh(mean);
        let sd = stats::sigma(&counted).unwrap_or(0.0).max(floor / step);
        Usual {
            sd: stats::sigma(shown).unwrap_or(0.0).max(floor),
            bend,
            counted: [mean, sd],
            error: error / (step * sd),
        }
    }

    /// The least that an error counts (SI).
    fn least(&self) -> f64 {
        LEAST_SHARE * self.sd
    }

    /// A reading against its mean and in its standard deviation; `None` where nothing was seen.
    fn scaled(&self, seen: Seen, m: &Measurement) -> Option<f64> {
        let [mean, sd] = self.counted;
        seen.number(m).map(|number| (asinh(number / self.bend) - mean) / sd)
    }
}

/// All features of a campaign that its design allows; a specimen that shows nothing of a contrast is not in it.
pub fn features(design: &Design, scale: &Scale, campaign: &Campaign) -> BTreeMap<Feature, f64> {
    let mut by_family: BTreeMap<(usize, Contrast), Vec<[f64; 2]>> = BTreeMap::new();
    let mut ordered: BTreeMap<Contrast, Vec<(f64, f64)>> = BTreeMap::new();
    for ((specimen, seen), scale) in design.specimens.iter().zip(&campaign.specimens).zip(&scale.specimens) {
        for (contrast, [value, error]) in contrasts(specimen, seen, scale) {
            by_family.entry((specimen.family, contrast)).or_default().push([value, error]);
            if let Some(order) = specimen.order.filter(|_| ORDERED.contains(&contrast)) {
                ordered.entry(contrast).or_default().push((f64::from(order), value));
            }
        }
    }
    let mut found = BTreeMap::new();
    for ((family, contrast), shown) in by_family {
        let [values, errors] = [0, 1].map(|k| shown.iter().map(|of| of[k]).collect::<Vec<_>>());
        found.extend(stats::mean(&values).map(|mean| (Feature::Mean(family, contrast), mean)));
        if SCATTERING.contains(&contrast) && values.len() > 1 {
            let error = stats::mean(&errors).unwrap_or(0.0).max(LEAST_SCATTER);
            let scatter = stats::sigma(&values).unwrap_or(0.0).max(error);
            found.insert(Feature::Scatter(family, contrast), ln(scatter));
        }
    }
    for (contrast, values) in ordered.into_iter().filter(|(_, values)| values.len() > 2) {
        found.extend(slope(&values).map(|slope| (Feature::Order(contrast), slope)));
    }
    let mut apart: BTreeMap<Feature, Vec<f64>> = BTreeMap::new();
    for (((family, m), seen), usual) in design.apart.iter().zip(&campaign.apart).zip(&scale.apart) {
        apart.entry(Feature::Apart(*family, m.quantity)).or_default().extend(usual.scaled(*seen, m));
    }
    found.extend(apart.into_iter().filter_map(|(feature, values)| Some((feature, stats::mean(&values)?))));
    found
}

/// The contrasts of a specimen, each in units that make independent readings one standard deviation, with the part that errors and
/// rounding have in it (one standard deviation).
fn contrasts(specimen: &Specimen, seen: &[Seen], scale: &[Usual]) -> Vec<(Contrast, [f64; 2])> {
    use MeasuredQuantity as Q;
    let mut weighted: BTreeMap<Contrast, Vec<[f64; 3]>> = BTreeMap::new();
    // The way up point by point: tilt or drift, value and error; and of displacements the reading in its own errors.
    let mut ways: BTreeMap<MeasuredQuantity, Vec<[f64; 3]>> = BTreeMap::new();
    let mut moved: BTreeMap<MeasuredQuantity, Vec<[f64; 2]>> = BTreeMap::new();
    let place = specimen.places();
    let (mut read, mut reached) = (0.0, 0.0);
    for ((m, seen), usual) in specimen.readings.iter().zip(seen).zip(scale) {
        let (z, error) = (usual.scaled(*seen, m), usual.error);
        let Some(at) = m.at() else {
            let contrast = match m.quantity {
                Q::PeakDisplacement => Contrast::Level,
                Q::ResidualDisplacement => Contrast::Left,
                _ => Contrast::Collapse,
            };
            weighted.entry(contrast).or_default().extend(z.map(|z| [1.0, z, error]));
            // From the first motion of the base to the last.
            let growth = z.zip(place(m)).map(|(z, s)| [s - 0.5, z, error]);
            weighted.entry(Contrast::Growth).or_default().extend(growth);
            continue;
        };
        read += 1.0;
        let Some(z) = z else { continue };
        reached += 1.0;
        if !m.quantity.is_remainder() {
            ways.entry(m.quantity).or_default().push([at, z, error.max(LEAST_SCATTER)]);
            // What a wall bears grows ever slower, whatever shows it.
            let own = seen.number(m).filter(|_| !m.quantity.has_drift());
            let own = own.map(|x| [at, x / reading_variance(m).sqrt().max(usual.least())]);
            moved.entry(m.quantity).or_default().extend(own);
        }
        let s = place(m).unwrap_or(1.0);
        let mut add = |contrast, weight| weighted.entry(contrast).or_default().push([weight, z, error]);
        match m.quantity {
            Q::DisplacementCentreMinusEnds | Q::RemainderCentreMinusEnds => {}
            other if other.is_remainder() => add(Contrast::Left, 1.0),
            _ => {
                add(Contrast::Level, 1.0);
                add(Contrast::Growth, s - 0.5);
                add(Contrast::Curvature, 12.0 * (s - 0.5) * (s - 0.5) - 1.0);
            }
        }
        match m.quantity {
            Q::DisplacementLeft => {
                add(Contrast::Bow, -0.5);
                add(Contrast::Twist, 1.0);
            }
            Q::DisplacementRight => {
                add(Contrast::Bow, -0.5);
                add(Contrast::Twist, -1.0);
            }
            Q::DisplacementCentre => add(Contrast::Bow, 1.0),
            Q::DisplacementCentreMinusEnds => {
                add(Contrast::Bow, 1.0);
                add(Contrast::Growth, s - 0.5);
            }
            Q::RemainderLeft | Q::RemainderRight => add(Contrast::LeftBow, -0.5),
            Q::RemainderCentre | Q::RemainderCentreMinusEnds => add(Contrast::LeftBow, 1.0),
            _ => {}
        }
    }
    let mut found: Vec<(Contrast, [f64; 2])> = weighted
        .into_iter()
        .filter_map(|(contrast, terms)| {
            let sum = |of: fn(&[f64; 3]) -> f64| terms.iter().fold(0.0, |sum, term| sum + of(term));
            let square = sum(|[weight, ..]| weight * weight);
            let value = sum(|[weight, z, _]| weight * z);
            let error = sum(|[weight, _, error]| weight * weight * error * error);
            (square > 0.0).then(|| (contrast, [value / square.sqrt(), (error / square).sqrt()]))
        })
        .collect();
    found.extend(jump(ways).map(|jump| (Contrast::Jump, [jump, 0.0])));
    found.extend(slowing(moved).map(|slowing| (Contrast::Slowing, [asinh(slowing), 0.0])));
    if read > 0.0 {
        found.push((Contrast::Reached, [reached / read, 0.0]));
    }
    found
}

/// How far the largest step of any point from one tilt to the next stands out from the mean of its two neighbours, in standard
/// deviations of the readings' errors: what grows smoothly has none. `None` where no point was read at four tilts.
fn jump(ways: BTreeMap<MeasuredQuantity, Vec<[f64; 3]>>) -> Option<f64> {
    let weights = [0.5, -1.5, 1.5, -0.5];
    let steps = ways.into_values().flat_map(|mut way| {
        way.sort_by(|a, b| a[0].total_cmp(&b[0]));
        let one = |four: &[[f64; 3]]| {
            let terms = weights.iter().zip(four).map(|(weight, [_, z, error])| [weight * z, weight * error]);
            let (step, square) = terms.fold((0.0, 0.0), |(step, square), [z, e]| (step + z, square + e * e));
            step.abs() / square.sqrt()
        };
        way.windows(weights.len()).map(one).collect::<Vec<f64>>()
    });
    steps.reduce(f64::max)
}

/// The most by which any point moves less over some tilt than over as much before it, in standard deviations of the readings' errors:
/// what grows ever faster has none. `None` where no point was read at [`SLOWED`] tilts.
fn slowing(ways: BTreeMap<MeasuredQuantity, Vec<[f64; 2]>>) -> Option<f64> {
    let slowed = ways.into_values().filter(|way| way.len() >= SLOWED).flat_map(|mut way| {
        way.sort_by(|a, b| a[0].total_cmp(&b[0]));
        let count = way.len();
        let middles = (1..count - 1).flat_map(move |at| (1..=at.min(count - 1 - at)).map(move |by| (at, by)));
        let one = move |(at, by): (usize, usize)| {
            let [[t0, x0], [t1, x1], [t2, x2]] = [way[at - by], way[at], way[at + by]];
            let is_even = ((t2 - t1) / (t1 - t0) - 1.0).abs() < UNEVEN;
            // Errors with the weights -1, 2 and -1.
            is_even.then(|| (2.0 * x1 - x0 - x2) / 6.0_f64.sqrt())
        };
        middles.filter_map(one).collect::<Vec<f64>>()
    });
    slowed.reduce(f64::max)
}

/// Slope of a straight line through points; `None` where all have the same place.
fn slope(points: &[(f64, f64)]) -> Option<f64> {
    let of = |k: fn(&(f64, f64)) -> f64| points.iter().map(k).collect::<Vec<_>>();
    let (x, y) = (stats::mean(&of(|p| p.0))?, stats::mean(&of(|p| p.1))?);
    let (above, below) = points
        .iter()
        .fold((0.0, 0.0), |(above, below), (a, b)| (above + (a - x) * (b - y), below + (a - x) * (a - x)));
    (below > 0.0).then(|| above / below)
}
