//! Two ways to measure one and the same campaign.

use pirca::math::degrees;
use pirca::random::Streams;
use pirca::study::MeasuredQuantity as Quantity;

use super::effect::{Effect, normal};
use super::readings::{Entry, Series};

/// The families, in the order of the study's arms.
pub const FAMILIES: [&str; 3] = ["cbl", "sbl", "sbr"];
/// Specimens of each.
pub const PER_FAMILY: usize = 3;

/// Error of a reading with good instruments (m), one standard deviation.
const RICH_ERROR: f64 = 0.3e-3;
/// What the paper's instrument does not see (cm).
const UNSEEN_CM: f64 = 0.5;
/// Error of a good protractor (deg).
const ANGLE_ERROR_DEG: f64 = 0.05;
/// What stands in a plan for a collapse angle (deg).
const PLANNED_DEG: f64 = 20.0;

/// The paper's 5 mm as a bound on every error: the error of one reading (m), one standard deviation.
const PAPER_ERROR: f64 = 2.9e-3;
/// What is stated of the mean of three, and of the centre less the mean of the ends (cm).
const STATED_CM: [f64; 2] = [0.17, 0.35];

/// A way to measure.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Design {
    /// The paper's: angles to half a degree, displacements at 5, 10 and 15 deg to a millimetre.
    Paper,
    /// Exact angles, three points at twenty tilts.
    Rich,
}

impl Design {
    pub const ALL: [Design; 2] = [Design::Paper, Design::Rich];

    /// Its name in files.
    pub fn name(self) -> &'static str {
        ["paper", "rich"][self as usize]
    }

    /// What is written down of specimens, family by family. Of a plan, which has none, every row that there may be.
    pub fn rows(
        self,
        specimens: Option<&[Series]>,
        effects: &[Box<dyn Effect>],
        streams: &Streams,
    ) -> Vec<Entry> {
        let mut stream = streams.of(match self {
            Design::Paper => "hidden paper errors",
            Design::Rich => "hidden rich errors",
        });
        let mut rows = Vec::new();
        for index in 0..FAMILIES.len() * PER_FAMILY {
            let mut error = || {
                let own = effects.iter().find_map(|effect| effect.error(&mut stream));
                own.unwrap_or_else(|| normal(&mut stream))
            };
            let series = specimens.map(|all| &all[index]);
            rows.extend(match self {
                Design::Paper => paper(index, series, &mut error),
                Design::Rich => rich(index, series, &mut error),
            });
        }
        effects.iter().for_each(|effect| effect.rows(&mut rows, &mut stream));
        rows
    }
}

/// Place of a specimen in the order of the tests, from 1: families take turns.
pub fn order(index: usize) -> u32 {
    (index % PER_FAMILY * FAMILIES.len() + index / PER_FAMILY + 1) as u32
}

/// A row of a specimen, without its value.
fn row(index: usize, tilt_deg: Option<f64>, quantity: Quantity) -> Entry {
    let family = FAMILIES[index / PER_FAMILY];
    Entry {
        specimen: format!("{}{}", family.to_uppercase(), index % PER_FAMILY + 1),
        family: family.to_owned(),
        tilt_deg,
        quantity,
        value: 0.0,
        unit: if tilt_deg.is_some() { "cm" } else { "deg" },
        error: 0.0,
        kind: "exact",
        resolution: None,
        order: None,
    }
}

/// To steps of which ten, or two, make one.
fn rounded(value: f64, per_unit: f64) -> f64 {
    (value * per_unit).round() / per_unit
}

fn paper(index: usize, series: Option<&Series>, error: &mut dyn FnMut() -> f64) -> Vec<Entry> {
    let collapse = series.map_or(PLANNED_DEG, |series| rounded(degrees(series.collapse), 2.0));
    let mut rows = vec![Entry {
        value: collapse,
        kind: "rounded",
        resolution: Some(0.5),
        ..row(index, None, Quantity::CollapseAngle)
    }];
    for tilt in [5.0, 10.0, 15.0] {
        let shown = series.map_or(Some([0.0; 3]), |series| series.at(tilt));
        let Some([left, centre, right]) = shown.map(|points| points.map(|x| x + PAPER_ERROR * error()))
        else {
            continue;
        };
        let [of_mean, of_difference] = STATED_CM;
        let (quantity, value, error) = match FAMILIES[index / PER_FAMILY] {
            "sbr" => (Quantity::DisplacementCentreMinusEnds, centre - 0.5 * (left + right), of_difference),
            _ => (Quantity::DisplacementMean, (left + centre + right) / 3.0, of_mean),
        };
        let base = Entry { error, ..row(index, Some(tilt), quantity) };
        let unseen = FAMILIES[index / PER_FAMILY] == "cbl" && (series.is_none() || 100.0 * value < UNSEEN_CM);
        rows.push(match unseen {
            true => Entry { value: UNSEEN_CM, kind: "below", ..base },
            false => {
                Entry { value: rounded(100.0 * value, 10.0), kind: "rounded", resolution: Some(0.1), ..base }
            }
        });
    }
    rows
}

fn rich(index: usize, series: Option<&Series>, error: &mut dyn FnMut() -> f64) -> Vec<Entry> {
    let collapse = series.map_or(PLANNED_DEG, |series| degrees(series.collapse) + ANGLE_ERROR_DEG * error());
    let mut rows =
        vec![Entry { value: collapse, error: ANGLE_ERROR_DEG, ..row(index, None, Quantity::CollapseAngle) }];
    let points = [Quantity::DisplacementLeft, Quantity::DisplacementCentre, Quantity::DisplacementRight];
    for tilt in (1..=20).map(|k| 0.75 * f64::from(k)) {
        let Some(shown) = series.map_or(Some([0.0; 3]), |series| series.at(tilt)) else { continue };
        rows.extend(points.into_iter().zip(shown).map(|(quantity, x)| Entry {
            value: 100.0 * (x + RICH_ERROR * error()),
            error: 100.0 * RICH_ERROR,
            ..row(index, Some(tilt), quantity)
        }));
    }
    rows.iter_mut().for_each(|row| row.order = Some(order(index)));
    rows
}
