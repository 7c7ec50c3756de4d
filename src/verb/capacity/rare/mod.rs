//! Small probabilities for `pirca capacity`, where a study's walls are too few to tell: independent runs of the method that is expected
//! to take the fewest walls.

mod method;
mod repeats;

use std::path::{Path, PathBuf};

use crate::ensemble::rare::{Batches, limit_study, pilot};
use crate::ensemble::{Draws, RareWalls, Row, replace_file};
use crate::study::Study;
use crate::terminal::failure::Failure;
use crate::terminal::output;
use crate::terminal::progress::Spent;
use crate::verb::capacity::answer::{CapacityGroup, CapacitySummary};
pub(crate) use crate::verb::capacity::rare::method::Method;
use crate::verb::capacity::rare::method::expected;
use crate::verb::capacity::rare::repeats::{Way, repeated};
use crate::verb::question::Question;

/// Name of the table of all walls that were drawn for rare values.
const EVALUATIONS: &str = "evaluations.parquet";
/// So many walls on the worse side of a level tell its probability by themselves.
const TELLING: f64 = 10.0;
/// Fewer independent runs say nothing of the error.
const FEWEST: usize = 3;
/// Methods are compared by the walls that they take to this coefficient of variation, unless another one is asked for.
const COV: f64 = 0.2;

/// How much may be spent on each arm, and what for.
#[derive(Clone, Copy)]
pub(crate) struct Aim {
    /// Most walls that are taken to the study's solver.
    pub budget: u64,
    /// The coefficient of variation at which the probability is known well enough; without one all is spent on ten runs.
    pub cov: Option<f64>,
    /// The method that was asked for.
    pub method: Option<Method>,
}

/// Walls that are evaluated elsewhere before the answer is known.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Waiting {
    /// The folder of the batch.
    pub batch: PathBuf,
    /// Its walls.
    pub walls: usize,
}

/// Answers by further walls what those of a random arm do not tell; the rows are those of these walls. Where the study's folder is given,
/// the walls are evaluated elsewhere, batch by batch: then it gives what it waits for.
pub(crate) fn ask(
    study: &Study,
    rows: &[Row],
    summary: &mut CapacitySummary,
    aim: Aim,
    (out, batched): (&Path, Option<&Path>),
) -> Result<Option<Waiting>, Failure> {
    let (level, is_high) = match summary.question {
        Question::Below(level) => (level, false),
        Question::Above(level) => (level, true),
        Question::Quantile(_) => return Ok(None),
    };
    let places = study
        .arms
        .iter()
        .enumerate()
        .flat_map(|(arm, own)| (0..own.kn_points.len()).map(move |point| (arm as u32, point as u32)));
    let draws = Draws::open(out, study)?;
    let by_limit = limit_study(study);
    let limit_draws = by_limit.as_ref().map(|limit| Draws::of_limit_analysis(out, limit)).transpose()?;
    let batches = batched.map(|place| Batches::open(out, place, study, &draws)).transpose()?;
    for ((arm, point), group) in places.zip(&mut summary.groups) {
        if !group.random {
            continue;
        }
        if aim.method.is_some() || !tells(group, aim) {
            let spent = Spent::of(&group.name, aim.budget);
            let tell = |more: usize| spent.tell(more);
            let walls = RareWalls {
                study,
                arm,
                point,
                is_high,
                draws: &draws,
                tell: &tell,
                batches: batches.as_ref(),
            };
            let level = walls.signed(level);
            let quietly = |_: usize| {};
            let screen = by_limit.as_ref().zip(limit_draws.as_ref()).map(|(study, draws)| RareWalls {
                study,
                draws,
                tell: &quietly,
                batches: None,
                ..walls
            });
            let pilot = pilot(&walls, screen.as_ref(), rows, level);
            let all = expected(&pilot);
            let Some(own) = all.iter().find(|own| aim.method.is_none_or(|method| method == own.method))
            else {
                return Err(cannot(aim, group));
            };
            method::tell(&group.name, &all, own.method, aim.cov.unwrap_or(COV));
            let way = Way { walls: &walls, screen: screen.as_ref(), pilot: &pilot, expected: *own, level };
            let Some(repeats) = repeated(&way, aim, &group.name) else {
                let asked = batches.as_ref().map(Batches::write).transpose()?.flatten();
                return Ok(asked.map(|(batch, walls)| Waiting { batch, walls }));
            };
            if let Some(fault) = draws.fault().or_else(|| limit_draws.as_ref()?.fault()) {
                return Err(fault.into());
            }
            if repeats.probabilities.len() >= FEWEST {
                group.by_repeats(repeats, study.solver.name(), is_high);
            } else {
                output::note(&format!(
                    "{}: {} walls do not suffice for {FEWEST} runs; what they began is kept, give --walls more",
                    group.name, aim.budget
                ));
            }
        }
        if let Some(cov) = aim.cov {
            group.aim(cov);
        }
    }
    replace_file(&out.join(EVALUATIONS), &draws.table(is_high)?)?;
    Ok(None)
}

/// Whether enough walls are on the worse side.
fn tells(group: &CapacityGroup, aim: Aim) -> bool {
    let told = group.walls - group.failed.walls;
    let many = group.answer.value().is_some_and(|share| share * told as f64 >= TELLING);
    many && aim.cov.is_none_or(|cov| group.cov.is_some_and(|own| own <= cov))
}

/// Why a method that was asked for does not go.
fn cannot(aim: Aim, group: &CapacityGroup) -> Failure {
    let why = match aim.method {
        Some(Method::Importance) => {
            "needs parameters that are drawn once per wall and move the value (the study's [uncertain])"
        }
        _ => {
            "needs limit analysis of the same walls, on at least 20 of them and with a correlation of 0.3 or more"
        }
    };
    let method = aim.method.map_or("", Method::name);
    Failure::Usage(format!("--method {method}: {}: {why}; leave it out, and one is chosen", group.name))
}
