//! Walls beside their plates: how near a plate comes to the stones, and how often an interval holds what they bear.

use std::collections::BTreeMap;

use crate::ensemble::{Judged, Subject, Validity, WallRow};
use crate::stats;
use crate::stats::{Estimate, Summary};

/// A plate is near where it is so little off what the stones bear.
const NEAR: f64 = 0.05;
/// By so many walls of stones an interval is fitted, which is then looked at with the others: the least and the greatest ratio leave out
/// one wall in forty at either end.
const FITTED: usize = 39;
/// Walls that have to be left for that.
const LEFT: usize = 20;
/// What an interval leaves out at either end.
const TAIL: f64 = 0.025;

/// Walls of an arm by their stones, beside its plates.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct WallsAsPlates {
    /// What plates with the strength of random cells bear: the tangent of the tilt, or a factor on the lateral load.
    pub plates: WallSample,
    /// What walls bear by limit analysis of all stones, with associative flow.
    pub stones: WallSample,
    /// Load borne by a wall over the mean of the plates.
    pub stones_over_plate: Option<Summary>,
    /// How many walls the mean of the plates is within 5 % of.
    pub within_5_percent: Option<WallShare>,
    /// How the plates stand for walls of stones.
    pub validity: Option<PlatesValid>,
    /// The interval in which one more wall lies: that of one more plate (Student's), widened by what stones over plate were measured to
    /// be on walls of other shapes.
    pub by_cells: Option<HeldWalls>,
    /// The interval from the ratios of the first 39 walls, and what it holds of the others.
    pub by_walls: Option<HeldWalls>,
    /// Load borne without dilatancy over that with it, wall by wall; null where it was not asked.
    pub non_associative_over_associative: Option<Summary>,
    /// How many walls that fall with dilatancy have no answer without it.
    pub non_associative_failed: usize,
}

/// How plates stand for walls of stones.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct PlatesValid {
    /// Largest multiplier over that at which friction across the thickness alone holds the wall.
    pub shear_ratio: f64,
    /// Least and greatest ratio of stones to plate at a probability of 95 %, measured on walls of other shapes.
    pub stones_over_plate: [f64; 2],
}

/// A sample of loads.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct WallSample {
    /// Mean, sigma and COV of the finite loads.
    #[serde(flatten)]
    pub load: Summary,
    /// Those that bear any load.
    pub bear_any: usize,
    /// Those that do not bear their own weight; they count with 0.
    pub fall_at_rest: usize,
    /// Plates that do not stand for walls of stones; they have no load.
    pub out_of_range: usize,
    /// Why the first of them does not.
    pub out_of_range_why: Option<String>,
    /// Those without an answer or without a wall, by reason.
    pub failed: BTreeMap<String, usize>,
}

/// A share with its interval.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct WallShare {
    /// How many.
    pub count: usize,
    /// Of how many.
    pub of: usize,
    /// Their share.
    pub value: f64,
    /// 95 % interval (Clopper and Pearson).
    pub interval: [f64; 2],
}

/// An interval of the load of one more wall, and how many walls it holds.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct HeldWalls {
    /// Least and greatest load.
    pub interval: [f64; 2],
    /// Walls that it holds.
    pub held: WallShare,
}

impl WallShare {
    fn of(count: usize, of: usize) -> Option<WallShare> {
        (of > 0).then(|| WallShare {
            count,
            of,
            value: count as f64 / of as f64,
            interval: stats::clopper_pearson(count, of),
        })
    }

    fn among(values: &[f64], is: impl Fn(f64) -> bool) -> Option<WallShare> {
        WallShare::of(values.iter().filter(|x| is(**x)).count(), values.len())
    }
}

impl HeldWalls {
    fn of(interval: [f64; 2], walls: &[f64]) -> Option<HeldWalls> {
        let [low, high] = interval;
        Some(HeldWalls { interval, held: WallShare::among(walls, |x| (low..=high).contains(&x))? })
    }
}

impl WallSample {
    fn of<'r>(found: impl Iterator<Item = &'r Judged>) -> (WallSample, Vec<f64>) {
        let (mut loads, mut bear_any, mut fall_at_rest, mut failed) = (Vec::new(), 0, 0, BTreeMap::new());
        let mut out_of_range = Vec::new();
        for judged in found {
            match judged {
                Judged::Falls(load) => loads.push(*load),
                Judged::FallsAtRest => {
                    fall_at_rest += 1;
                    loads.push(0.0);
                }
                Judged::BearsAny => bear_any += 1,
                Judged::OutOfRange(why) => out_of_range.push(why),
                Judged::NotSolved(why) | Judged::Invalid(why) => *failed.entry(why.clone()).or_insert(0) += 1,
            }
        }
        let sample = WallSample {
            load: Summary::of(&loads),
            bear_any,
            fall_at_rest,
            out_of_range: out_of_range.len(),
            out_of_range_why: out_of_range.first().map(ToString::to_string),
            failed,
        };
        (sample, loads)
    }
}

impl WallsAsPlates {
    /// Sums up the rows of an arm.
    pub(crate) fn of(arm: u32, rows: &[WallRow]) -> WallsAsPlates {
        let own = || rows.iter().filter(move |row| row.task.arm == arm);
        let of =
            |plates: bool| own().filter(move |row| matches!(row.task.subject, Subject::Plate(_)) == plates);
        let (plates, by_plates) = WallSample::of(of(true).map(|row| &row.found));
        let (stones, walls) = WallSample::of(of(false).map(|row| &row.found));
        let plate = plates.load.mean.value.filter(|mean| *mean > 0.0);
        let ratios: Vec<f64> =
            plate.iter().flat_map(|plate| walls.iter().map(move |wall| wall / plate)).collect();
        let near =
            plate.and_then(|plate| WallShare::among(&walls, |wall| (plate - wall).abs() <= NEAR * wall));
        let validity = PlatesValid::of(own().filter_map(|row| row.validity));
        let by_cells = predicted(&plates.load, by_plates.len()).zip(validity).and_then(|(between, valid)| {
            HeldWalls::of([0, 1].map(|end| between[end] * valid.stones_over_plate[end]), &walls)
        });
        let by_walls = plate.filter(|_| ratios.len() >= FITTED + LEFT).and_then(|plate| {
            let (fitted, others) = (&ratios[..FITTED], &walls[FITTED..]);
            let end = |p| stats::predictive_quantile(fitted, p).map(|ratio| ratio * plate);
            HeldWalls::of([end(TAIL)?, end(1.0 - TAIL)?], others)
        });
        let both = || of(false).filter_map(|row| Some((&row.found, row.non_associative.as_ref()?)));
        let flow: Vec<f64> = both()
            .filter_map(|pair| match pair {
                (Judged::Falls(with), Judged::Falls(without)) => Some(without / with),
                _ => None,
            })
            .collect();
        WallsAsPlates {
            stones_over_plate: plate.map(|_| Summary::of(&ratios)),
            within_5_percent: near,
            validity,
            by_cells,
            by_walls,
            non_associative_failed: both().count() - flow.len(),
            non_associative_over_associative: (!flow.is_empty()).then(|| Summary::of(&flow)),
            plates,
            stones,
        }
    }
}

impl PlatesValid {
    fn of(plates: impl Iterator<Item = Validity>) -> Option<PlatesValid> {
        let of = |own: Validity| PlatesValid {
            shear_ratio: own.shear_ratio,
            stones_over_plate: own.stones_over_plate,
        };
        plates.map(of).reduce(|a, b| PlatesValid {
            shear_ratio: a.shear_ratio.max(b.shear_ratio),
            stones_over_plate: [
                a.stones_over_plate[0].min(b.stones_over_plate[0]),
                a.stones_over_plate[1].max(b.stones_over_plate[1]),
            ],
        })
    }
}

/// Where one more value of a normal sample lies. A sample that does not scatter, or is one value, is taken as it is.
fn predicted(sample: &Summary, n: usize) -> Option<[f64; 2]> {
    let (Estimate { value: mean, .. }, Estimate { value: sigma, .. }) = (sample.mean, sample.sigma);
    let mean = mean?;
    let Some(sigma) = sigma.filter(|sigma| *sigma > 0.0) else { return Some([mean; 2]) };
    let half = stats::student_quantile(1.0 - TAIL, (n - 1) as f64) * sigma * (1.0 + 1.0 / n as f64).sqrt();
    Some([mean - half, mean + half])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ensemble::{OutOfRange, WallTask};

    fn rows(plates: &[f64], walls: impl Iterator<Item = f64>) -> Vec<WallRow> {
        let row = |subject, found| {
            let task = WallTask { arm: 0, subject };
            let valid = Validity { shear_ratio: 0.5, stones_over_plate: [0.8, 1.25] };
            let validity = matches!(subject, Subject::Plate(_)).then_some(valid);
            WallRow { task, found, validity, non_associative: None, seconds: [0.0; 2] }
        };
        let of_cells = plates.iter().zip(0..).map(|(x, k)| row(Subject::Plate(k), Judged::Falls(*x)));
        let of_stones = walls.zip(0..).map(|(x, k)| row(Subject::Stones(k), Judged::Falls(x)));
        of_cells.chain(of_stones).collect()
    }

    #[test]
    fn walls_are_counted_by_how_near_the_mean_of_the_plates_is() {
        // A plate of 1.0 is within 5 % of 0.96 and 1.05, and not of 0.95 and 1.06.
        let summary = WallsAsPlates::of(0, &rows(&[0.9, 1.1], [0.95, 0.96, 1.05, 1.06].into_iter()));
        let near = summary.within_5_percent.unwrap();
        assert_eq!((near.count, near.of, near.value), (2, 4, 0.5));
        // Student's t of one degree of freedom, 12.7062: 1 +- 12.7062 x 0.141421 x sqrt(1.5), times 1.25.
        let by_cells = summary.by_cells.unwrap();
        assert!((by_cells.interval[1] - 1.25 * 3.200_75).abs() < 1e-4, "{by_cells:?}");
        assert_eq!((by_cells.held.count, summary.by_walls), (4, None));
    }

    #[test]
    fn an_interval_is_fitted_to_the_first_walls_and_looked_at_with_the_others() {
        // Ratios 1.001 to 1.039, then twenty walls of which five lie outside.
        let first = (1..=39).map(|k| 2.0 * (1.0 + 0.001 * f64::from(k)));
        let others = (0..20).map(|k| if k < 5 { 2.0 } else { 2.04 });
        let summary = WallsAsPlates::of(0, &rows(&[2.0], first.chain(others)));
        let fitted = summary.by_walls.unwrap();
        let [low, high] = fitted.interval;
        assert!((low - 2.002).abs() < 1e-12 && (high - 2.078).abs() < 1e-12, "{fitted:?}");
        assert_eq!((fitted.held.count, fitted.held.of), (15, 20));
        // One plate does not scatter: what is left is how far stones and plates are apart.
        assert_eq!(summary.by_cells.unwrap().interval, [1.6, 2.5]);
    }

    #[test]
    fn what_has_no_finite_load_is_counted_by_its_reason() {
        let mut all = rows(&[0.5], [0.4, 0.6].into_iter());
        let row = all[1].clone();
        for found in [Judged::BearsAny, Judged::FallsAtRest, Judged::NotSolved("stuck".to_owned())] {
            all.push(WallRow { found, ..row.clone() });
        }
        let refused = Judged::OutOfRange(OutOfRange::EndBlocks);
        all[0] = WallRow { found: refused, validity: None, ..all[0].clone() };
        let summary = WallsAsPlates::of(0, &all);
        assert_eq!((summary.plates.load.n, summary.plates.out_of_range), (0, 1));
        assert!(summary.plates.out_of_range_why.unwrap().contains("end blocks"));
        assert_eq!((summary.stones_over_plate, summary.by_cells), (None, None));
        let stones = summary.stones;
        assert_eq!((stones.load.n, stones.bear_any, stones.fall_at_rest), (3, 1, 1));
        assert_eq!(stones.failed, BTreeMap::from([("stuck".to_owned(), 1)]));
        // The one that falls at rest bears nothing.
        assert!((stones.load.mean.value.unwrap() - 1.0 / 3.0).abs() < 1e-12);
    }
}
