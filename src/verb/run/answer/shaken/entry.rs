//! The numbers of walls that are shaken, every statistic with its interval.

use crate::ensemble::{Row, is_random};
use crate::stats;
use crate::stats::Estimate;
use crate::stats::fragility::{
    Agreement, Campaign, Counts, Fragility, Measures, Shares, Step, Walls, agreement, isotonic, lognormal,
    measures, ratios, shares,
};
use crate::study::{Earthquakes, Measure, Study};
use crate::verb::run::answer::shaken::campaigns::{Runs, share};

/// Resamples of the band about the isotonic curve, and campaigns that a lognormal curve is tested with. Their cost goes with the
/// square of the number of pairs; 200 tell a p-value of 0.05 from one of 0.10.
const REPLICATES: usize = 200;
/// Pairs of record and wall above which the shares of the variance, and the test that needs them, take minutes.
const MOST_PAIRS: usize = 400;

/// What comes of walls that are shaken.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct ShakenSummary {
    /// What intensities are: `pga_m_per_s2` or `pgv_m_per_s`.
    pub measure: &'static str,
    /// The intensities, ascending.
    pub intensities: Vec<f64>,
    /// Whose fall counts as a collapse.
    pub collapse: &'static str,
    /// Whether each run was repeated from a start that differs by next to nothing.
    pub twice: bool,
    /// The records.
    pub records: Vec<RecordEntry>,
    /// A curve per arm and kn.
    pub curves: Vec<ShakenCurve>,
    /// Ratios of arms at the same kn, under the same records.
    pub ratios: Vec<RatioEntry>,
    /// What a slow tilt tells of collapse under records; null unless the study asks for limit analysis (solver.agreement).
    pub tilt: Option<TiltEntry>,
    /// How intensities are shown.
    #[serde(skip)]
    pub shown: Measure,
    /// When a wall has collapsed, in words.
    #[serde(skip)]
    pub collapse_words: &'static str,
}

/// A record.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct RecordEntry {
    /// Its file, or its generator with seed and number.
    pub name: String,
    /// PGV over PGA (s): the longer the period, the larger.
    pub pgv_over_pga_s: f64,
    /// The share of the runs of all arms under it that collapsed.
    pub collapsed: Option<f64>,
}

/// An arm at one kn.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct ShakenCurve {
    /// Name of the arm.
    pub arm: String,
    /// Normal stiffness of the joints (Pa/m).
    pub kn_pa_per_m: f64,
    /// Its walls.
    pub walls: usize,
    /// How runs ended; see [`Counts`].
    pub counts: Counts,
    /// Runs of which some step was not solved to the tolerance.
    pub runs_with_unsolved_steps: usize,
    /// The lognormal curve.
    pub lognormal: Fragility,
    /// Whether it agrees with the isotonic curve; null where that was not tested.
    pub agreement: Option<Agreement>,
    /// Shares of the variance; null of too many pairs of record and wall.
    pub shares: Option<Shares>,
    /// The isotonic curve, with what was seen at each intensity.
    pub stripes: Vec<StripeEntry>,
    /// The other measure of intensity on the same runs.
    pub other: Option<MeasureEntry>,
    /// Mean tilt of collapse by limit analysis without dilatancy (deg), with associative flow where that finds none; where the study
    /// asks for it (solver.agreement).
    pub tilt_capacity_deg: Estimate,
}

/// What a slow tilt tells of collapse under records.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct TiltEntry {
    /// Walls of all arms that have both.
    pub walls: usize,
    /// Correlation of a wall's tilt of collapse with the share of its runs that collapsed: below 0 what tilts further stands more
    /// records.
    pub correlation: Estimate,
}

/// What was seen at an intensity.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct StripeEntry {
    /// The isotonic curve there.
    #[serde(flatten)]
    pub step: Step,
    /// Median over the runs that did not collapse of the largest rotation of a stone (rad).
    pub rotation_rad: Option<f64>,
    /// The same of the largest displacement left at the end (m).
    pub residual_m: Option<f64>,
}

/// Another measure of intensity.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct MeasureEntry {
    /// Its name.
    pub measure: &'static str,
    /// The lognormal curve in it.
    pub lognormal: Fragility,
    /// The study's own measure less this one: below 0 its own predicts better.
    pub own_less_this: Measures,
}

/// One arm over another.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct RatioEntry {
    /// The arm above the line.
    pub arm: String,
    /// The arm below the line.
    pub over: String,
    /// Normal stiffness of the joints (Pa/m).
    pub kn_pa_per_m: f64,
    /// Ratio of the medians; above 1 the first is the stronger.
    pub theta: Estimate,
    /// Ratio of the dispersions.
    pub beta: Estimate,
}

/// Sums up the rows of a study.
pub(crate) fn summarised(study: &Study, earthquakes: &Earthquakes, rows: &[Row]) -> ShakenSummary {
    let base = study.base_motion().expect("records come with a base that shakes");
    let each = || {
        study.arms.iter().enumerate().flat_map(|(arm, own)| (0..own.kn_points.len()).map(move |p| (arm, p)))
    };
    // An arm without a wall has neither curve nor ratio.
    let all: Vec<(usize, usize, Runs<'_>, Campaign)> = each()
        .filter_map(|(arm, point)| {
            let runs = Runs::of(rows, earthquakes, arm, point);
            let campaign = runs.campaign()?;
            Some((arm, point, runs, campaign))
        })
        .collect();
    let curves =
        all.iter().map(|(arm, point, runs, campaign)| curve(study, (*arm, *point), runs, campaign)).collect();
    let mut compared = Vec::new();
    for (at, (first, point, _, a)) in all.iter().enumerate() {
        for (second, other_point, _, b) in &all[at + 1..] {
            let kn = study.arms[*first].kn_points[*point];
            if first == second || kn != study.arms[*second].kn_points[*other_point] {
                continue;
            }
            // Wall k of every arm has the same random numbers.
            let is_paired =
                a.walls() == b.walls() && is_random(&study.arms[*first]) && is_random(&study.arms[*second]);
            let found = ratios(a, b, if is_paired { Walls::Paired } else { Walls::Apart });
            let name = |arm: usize| study.arms[arm].name.clone();
            let (theta, beta) = (found.theta, found.beta);
            compared.push(RatioEntry {
                arm: name(*first),
                over: name(*second),
                kn_pa_per_m: kn,
                theta,
                beta,
            });
        }
    }
    let record = |(number, record): (usize, &crate::study::Record)| {
        let [pga, pgv] = [Measure::Pga, Measure::Pgv].map(|measure| record.peak(measure, 1.0));
        let under = rows.iter().flat_map(Row::runs).filter(|run| run.record as usize == number);
        RecordEntry { name: record.name().to_owned(), pgv_over_pga_s: pgv / pga, collapsed: share(under) }
    };
    ShakenSummary {
        measure: earthquakes.measure.key(),
        intensities: earthquakes.intensities.clone(),
        collapse: base.shares.capacity.name(),
        twice: base.twice,
        records: earthquakes.records.iter().enumerate().map(record).collect(),
        curves,
        ratios: compared,
        tilt: study.agreement.then(|| against_tilt(rows)),
        shown: earthquakes.measure,
        collapse_words: base.shares.capacity.words(),
    }
}

fn curve(study: &Study, (arm, point): (usize, usize), own: &Runs<'_>, campaign: &Campaign) -> ShakenCurve {
    let arm = &study.arms[arm];
    let stream = |what: &str| stats::stream_of(study.seed, &format!("{what} of {} {point}", arm.name));
    let is_small = campaign.records() * campaign.walls() <= MOST_PAIRS;
    let other = own.other(campaign);
    let tilts: Vec<f64> = own.rows().iter().filter_map(|row| tilt(row)).collect();
    let steps = isotonic(campaign, REPLICATES, &mut stream("isotonic"));
    let stripe = |step: Step| {
        let at = |run: &&crate::ensemble::ShakenRow| own.intensity(run) == step.intensity;
        let stood =
            || own.rows().iter().flat_map(|row| row.runs()).filter(at).filter(|run| run.residual_m.is_some());
        StripeEntry {
            step,
            rotation_rad: stats::quantile(&stood().map(|run| run.rotation_rad).collect::<Vec<f64>>(), 0.5),
            residual_m: stats::quantile(&stood().filter_map(|run| run.residual_m).collect::<Vec<f64>>(), 0.5),
        }
    };
    ShakenCurve {
        arm: arm.name.clone(),
        kn_pa_per_m: arm.kn_points[point],
        walls: own.walls(),
        counts: campaign.counts(),
        runs_with_unsolved_steps: own
            .rows()
            .iter()
            .flat_map(|row| row.runs())
            .filter(|run| run.unsolved_steps > 0)
            .count(),
        lognormal: lognormal(campaign),
        agreement: is_small.then(|| agreement(campaign, REPLICATES, &mut stream("agreement"))).flatten(),
        shares: is_small.then(|| shares(campaign)),
        stripes: steps.into_iter().map(stripe).collect(),
        other,
        tilt_capacity_deg: stats::Summary::of(&tilts).mean,
    }
}

impl Runs<'_> {
    /// The other measure of intensity on the same runs.
    fn other(&self, campaign: &Campaign) -> Option<MeasureEntry> {
        let measure = self.measure().other();
        let intensities = self.intensities(measure);
        Some(MeasureEntry {
            measure: measure.key(),
            lognormal: lognormal(&campaign.measured(intensities.clone())),
            own_less_this: measures(campaign, &intensities),
        })
    }
}

/// The tilt of collapse of a wall by limit analysis (deg).
fn tilt(row: &Row) -> Option<f64> {
    row.limit.and_then(|limit| limit.non_associative_angle_deg.or(limit.angle_deg))
}

fn against_tilt(rows: &[Row]) -> TiltEntry {
    let both = rows.iter().filter_map(|row| tilt(row).zip(share(row.runs())));
    let (tilts, shares): (Vec<f64>, Vec<f64>) = both.unzip();
    TiltEntry { walls: tilts.len(), correlation: stats::correlation_estimate(&tilts, &shares) }
}
