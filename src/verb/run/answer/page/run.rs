//! The page of a run: what was asked, what came out, what it rests on.

use anyhow::Result;
use serde::Serialize;

use crate::ensemble::{Observed, Quantity, Row, Task, is_random};
use crate::model::Replay;
use crate::render::document::Drawing;
use crate::render::document::filled;
use crate::render::document::{Line, Table};
use crate::render::document::{Solid, SolidWall};
use crate::render::number::{compact, or_dash, significant, stiffness, with_interval, with_interval_against};
use crate::render::picture::Picture;
use crate::shape::Polyhedron;
use crate::study::{Loaded, Study};
use crate::verb::run::answer::comparison::Comparison;
use crate::verb::run::answer::conclusion::sentences;
use crate::verb::run::answer::demand::DemandSummary;
use crate::verb::run::answer::figure::title;
use crate::verb::run::answer::figures::{figures, force_figure};
use crate::verb::run::answer::measured;
use crate::verb::run::answer::page::cite::{Citation, citation};
use crate::verb::run::answer::page::inputs::Given;
use crate::verb::run::answer::page::origin::PageOrigin;
use crate::verb::run::answer::page::strip::{Mark, strip};
use crate::verb::run::answer::page::{limits, strip};
use crate::verb::run::answer::summary::{ArmSummary, Summary, summarise};
use crate::verb::run::answer::table::{arm_notes, arm_rows, explanation};

/// Beyond so many walls only those that are drawn have a row on the page: it would be slow, and members.parquet has them all.
const MOST_ROWS: usize = 3000;

/// A wall that is drawn on the page.
#[derive(Clone, Debug, PartialEq)]
pub struct DrawnWall {
    /// Which of the walls it is: the weakest, median or strongest of its arm, or the weakest of all.
    pub which: &'static str,
    /// Its place in the ensemble.
    pub task: Task,
    /// Its picture.
    pub picture: Picture,
    /// The states that it goes through.
    pub replay: Replay,
    /// How it ended.
    pub ending: String,
}

/// What the page of a run is made of.
pub struct RunPage<'a> {
    /// The study that was run.
    pub study: &'a Study,
    /// The study as its files state it.
    pub loaded: &'a Loaded,
    /// All rows of the run.
    pub rows: &'a [Row],
    /// The walls that are drawn.
    pub drawn: &'a [DrawnWall],
    /// How the run was made.
    pub origin: &'a PageOrigin,
}

/// What the template is filled with.
#[derive(Serialize)]
struct Filled {
    title: String,
    about: String,
    answer: Vec<String>,
    explanation: String,
    arms: Table,
    notes: Vec<String>,
    tables: Vec<Table>,
    measured: String,
    charts: bool,
    figures: Vec<Drawing>,
    about_strip: String,
    strip: Option<Drawing>,
    about_drawn: String,
    drawn: Vec<Drawing>,
    solid: Option<Solid>,
    about_walls: String,
    walls: Vec<Table>,
    given: Given,
    limits: Vec<String>,
    provenance: Table,
    methods: String,
    citation: Citation,
}

/// What the weakest wall of another arm is called.
const WEAKEST_OF_ALL: &str = "weakest of all";

/// The weakest, the median and the strongest wall of the first arm that is random, at its first stiffness, and the weakest one of all arms
/// where that is of another; the one wall where no arm is random.
pub fn chosen_walls(study: &Study, rows: &[Row]) -> Vec<(&'static str, Task)> {
    let arm = study.arms.iter().position(is_random).unwrap_or(0);
    let found = by_strength(study, rows, arm);
    let task = |at: usize| Task { arm: arm as u32, point: 0, member: found[at].1 };
    let mut chosen = match found.len() {
        0 => Vec::new(),
        1 => vec![("only", task(0))],
        2 => vec![("weakest", task(0)), ("strongest", task(1))],
        n => vec![("weakest", task(0)), ("median", task((n - 1) / 2)), ("strongest", task(n - 1))],
    };
    let weakest = |arm: usize| {
        by_strength(study, rows, arm).first().map(|(strength, member)| (*strength, arm, *member))
    };
    let of_all = (0..study.arms.len()).filter_map(weakest).min_by(|a, b| a.0.total_cmp(&b.0));
    if let Some((_, other, member)) = of_all.filter(|(_, other, _)| *other != arm) {
        chosen.push((WEAKEST_OF_ALL, Task { arm: other as u32, point: 0, member }));
    }
    chosen
}

/// The walls of an arm at its first stiffness that bring a value, the weakest first, each with its strength.
fn by_strength(study: &Study, rows: &[Row], arm: usize) -> Vec<(f64, u64)> {
    let quantity = Quantity::of(study);
    let own = rows.iter().filter(|row| row.arm_index as usize == arm && row.point == 0);
    let mut found: Vec<(f64, u64)> = own
        .filter_map(|row| match quantity.observed(row) {
            Observed::Value(value) => Some((quantity.strength(value), row.member)),
            // Stronger than all that fell.
            Observed::Above(_) => Some((f64::INFINITY, row.member)),
            Observed::Nothing => None,
        })
        .collect();
    found.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    found
}

/// The page of a run.
///
/// # Errors
/// A figure that cannot be drawn, or a template that is faulty.
pub fn run_page(of: &RunPage<'_>) -> Result<String> {
    let (study, summary) = (of.study, summarise(of.study, of.rows));
    let quantity = Quantity::of(study);
    let has_rows = of.rows.len() <= MOST_ROWS;
    let caption = "A mark for every wall that brings a value, stacked where walls are alike. Black: drawn below. Hollow: stood to the \
                   end of the load path, its value lies above.";
    let leads = if has_rows {
        "Each mark leads to the row of its wall."
    } else {
        "The marks of walls that are drawn lead to them."
    };
    let figures = figures(&summary, None).into_iter().chain(force_figure(study, of.rows, &summary));
    let figures = figures.map(|figure| figure.drawing()).collect::<Result<Vec<_>>>()?;
    let marks = marks(of, has_rows);
    let name = format!("Study {}", title(&summary));
    let mut answer = sentences(&summary);
    if answer.len() > 1 {
        // The means are the answer; how many walls they rest on comes behind.
        answer.swap(0, 1);
    }
    let demand = summary.demand.as_ref();
    answer.splice(0..0, demand.and_then(DemandSummary::sentence));
    let against = demand.map(|own| Table::headed(&own.heading(), own.rows()));
    let filled_with = Filled {
        title: if summary.question.is_empty() { name.clone() } else { summary.question.clone() },
        about: if summary.question.is_empty() { String::new() } else { name },
        answer,
        explanation: explanation(quantity),
        arms: Table::headed("", arm_rows(&summary.arms)),
        notes: summary.arms.iter().flat_map(arm_notes).flatten().collect(),
        tables: against
            .into_iter()
            .chain([endings(&summary), quantiles(&summary), ratios(&summary), published(&summary)])
            .filter(|table| !table.rows.is_empty())
            .collect(),
        measured: measured::text(summary.measured.as_ref()).trim().to_owned(),
        charts: figures.iter().any(|drawing| drawing.chart.is_some()),
        figures,
        about_strip: match marks.is_empty() {
            true => "No wall brings a value.".to_owned(),
            false => format!("How the walls scatter. {leads}"),
        },
        strip: (!marks.is_empty()).then(|| {
            Drawing::with_links("figure-walls", "The walls of each arm", caption, &strip(&marks, quantity))
        }),
        about_drawn: about_drawn(study, of.drawn),
        drawn: of.drawn.iter().map(|own| drawing(of, own)).collect(),
        solid: solid(of.drawn),
        about_walls: match has_rows {
            true => "Every wall that was evaluated. members.parquet has more columns.".to_owned(),
            false => format!(
                "{} walls are too many for a page: members.parquet holds a row for each.",
                of.rows.len()
            ),
        },
        walls: if has_rows { walls(of) } else { Vec::new() },
        given: Given::of(study, of.loaded),
        limits: limits::of_run(study, of.loaded, &summary),
        provenance: of.origin.of_study(study),
        methods: limits::methods(study),
        citation: citation(Some(study.seed)),
    };
    filled("run.html", include_str!("run.html"), &filled_with)
}

/// What links lead to a wall by.
fn id(task: Task) -> String {
    format!("wall-{}-{}-{}", task.arm, task.point, task.member)
}

fn task(row: &Row) -> Task {
    Task { arm: row.arm_index, point: row.point, member: row.member }
}

/// Where a drawn wall's figure is.
fn figure_id(which: &str) -> String {
    format!("figure-{}", which.replace(' ', "-"))
}

/// The marks of the distribution, a line for each arm and stiffness that has any.
fn marks(of: &RunPage<'_>, has_rows: bool) -> Vec<strip::Row> {
    let quantity = Quantity::of(of.study);
    let mut lines: Vec<strip::Row> = Vec::new();
    for same in of.rows.chunk_by(|a, b| (a.arm_index, a.point) == (b.arm_index, b.point)) {
        let mark = |row: &Row| {
            let (value, stood) = match quantity.observed(row) {
                Observed::Value(value) => (value, false),
                Observed::Above(limit) => (limit, true),
                Observed::Nothing => return None,
            };
            let drawn = of.drawn.iter().find(|own| own.task == task(row));
            let to = drawn.map(|own| figure_id(own.which)).or_else(|| has_rows.then(|| id(task(row))));
            Some(Mark {
                member: row.member,
                value: quantity.shown(value),
                stood,
                to,
                is_drawn: drawn.is_some(),
            })
        };
        let marks: Vec<Mark> = same.iter().filter_map(mark).collect();
        if !marks.is_empty() {
            let (first, place) = (&same[0], same[0].arm_index as usize);
            lines.push(strip::Row { arm: first.arm.clone(), place, kn: first.kn_pa_per_m, marks });
        }
    }
    lines
}

/// The walls that are drawn, in three dimensions.
fn solid(drawn: &[DrawnWall]) -> Option<Solid> {
    let shapes: Vec<Vec<Polyhedron>> = drawn
        .iter()
        .map(|own| own.picture.stones.iter().map(|stone| stone.shape.clone()).collect())
        .collect();
    let walls: Vec<SolidWall<'_>> = drawn
        .iter()
        .zip(&shapes)
        .map(|(own, shapes)| SolidWall {
            name: own.which,
            shapes,
            replay: &own.replay,
            from_front: own.picture.from_front,
        })
        .collect();
    let names = listed(drawn);
    let caption = format!(
        "The {names} in three dimensions, from rest through the collapse. Movements at rest are magnified, those of the fall are not."
    );
    Solid::of("figure-solid", &caption, &walls)
}

/// What one of the walls that are drawn is called.
pub fn called(which: &str) -> String {
    if which == WEAKEST_OF_ALL { "weakest wall of all".to_owned() } else { format!("{which} wall") }
}

/// All of some walls in a row.
fn listed(drawn: &[DrawnWall]) -> String {
    let all: Vec<String> = drawn.iter().map(|own| called(own.which)).collect();
    all.join(", the ")
}

fn about_drawn(study: &Study, drawn: &[DrawnWall]) -> String {
    let of = |same: &[DrawnWall]| {
        let arm = &study.arms[same[0].task.arm as usize];
        format!("Of arm {} at kn {}: the {}.", arm.name, stiffness(arm.kn_points[0]), listed(same))
    };
    let arms: Vec<String> = drawn.chunk_by(|a, b| a.task.arm == b.task.arm).map(of).collect();
    if arms.is_empty() { String::new() } else { format!("{} pirca wall draws any other.", arms.join(" ")) }
}

fn drawing(of: &RunPage<'_>, own: &DrawnWall) -> Drawing {
    let quantity = Quantity::of(of.study);
    let row = of.rows.iter().find(|row| task(row) == own.task);
    let value = row.map_or(Observed::Nothing, |row| quantity.observed(row));
    let shown = |x: f64| format!("{} {}", significant(quantity.shown(x), 4), quantity.shown_unit());
    let value = match value {
        Observed::Value(x) => format!(", {}", shown(x)),
        Observed::Above(x) => format!(", above {}", shown(x)),
        Observed::Nothing => String::new(),
    };
    let title = format!("The {}: number {}{value}", called(own.which), own.task.member);
    Drawing::described(&figure_id(own.which), &title, &own.ending, &own.picture.svg())
}

/// A table of walls for each arm.
fn walls(of: &RunPage<'_>) -> Vec<Table> {
    let quantity = Quantity::of(of.study);
    let value = format!("value {}", quantity.shown_unit());
    let heads = [
        "kn Pa/m",
        "wall",
        &value,
        "outcome",
        "mechanism",
        "stones",
        "joints",
        "mean dip deg",
        "sd of dips deg",
    ];
    let line = |row: &Row| {
        let mut outcome = row.outcome.name().replace('_', " ");
        let value = match quantity.observed(row) {
            Observed::Value(value) => significant(quantity.shown(value), 4),
            Observed::Above(limit) => format!("above {}", significant(quantity.shown(limit), 4)),
            Observed::Nothing => {
                outcome = format!("{outcome}: {}", row.outcome.reason());
                "-".to_owned()
            }
        };
        let cells = vec![
            compact(row.kn_pa_per_m),
            row.member.to_string(),
            value,
            outcome,
            row.mechanism.map_or("-", |mechanism| mechanism.mode.name()).replace('_', " "),
            row.built.stones.to_string(),
            row.built.joints.to_string(),
            or_dash(row.built.dip_mean_deg, 3),
            or_dash(row.built.dip_sd_deg, 3),
        ];
        Line { id: id(task(row)), cells, ..Line::default() }
    };
    let table = |own: &[Row]| {
        let name = format!("Arm {}", own[0].arm);
        Table { rows: own.iter().map(line).collect(), ..Table::new(&name, &heads, Vec::new()) }
    };
    of.rows.chunk_by(|a, b| a.arm_index == b.arm_index).map(table).collect()
}

/// Name of an arm at one stiffness.
fn place(arm: &ArmSummary) -> [String; 2] {
    [arm.arm.clone(), compact(arm.kn_pa_per_m)]
}

/// How the walls of each arm ended, and by which mechanism they fell.
fn endings(summary: &Summary) -> Table {
    let counted = |counts: &std::collections::BTreeMap<String, u64>| {
        let said: Vec<String> =
            counts.iter().map(|(name, n)| format!("{n} {}", name.replace('_', " "))).collect();
        if said.is_empty() { "-".to_owned() } else { said.join(", ") }
    };
    let rows = summary.arms.iter().map(|arm| {
        let [name, kn] = place(arm);
        vec![name, kn, counted(&arm.outcomes), counted(&arm.failure_modes)]
    });
    Table::new("How the walls ended", &["arm", "kn Pa/m", "outcomes", "mechanisms"], rows.collect())
}

fn quantiles(summary: &Summary) -> Table {
    let mut rows = Vec::new();
    for arm in summary.arms.iter().filter(|arm| arm.random) {
        let shown = |x: f64| arm.shown.shown(x);
        for own in &arm.quantiles {
            let [name, kn] = place(arm);
            let value = with_interval(own.value.map(shown), own.ci.map(|ci| ci.map(shown)), 3);
            rows.push(vec![name, kn, format!("{:.0} %", 100.0 * own.probability), value]);
        }
    }
    let unit = summary.arms.first().map_or("", |arm| arm.shown.shown_unit());
    Table::new("Quantiles", &["arm", "kn Pa/m", "share of walls below", unit], rows)
}

fn ratios(summary: &Summary) -> Table {
    let is_exact = |one: &Comparison| one.ratio_ci.is_some_and(|[low, high]| low == high);
    let rows = summary.comparisons.iter().map(|one| {
        let ratio = match is_exact(one) {
            true => or_dash(one.ratio, 3),
            false => with_interval_against(one.ratio, one.ratio_ci, 3, 1.0),
        };
        vec![one.arm.clone(), one.over.clone(), compact(one.kn_pa_per_m), ratio]
    });
    let has_exact = summary.comparisons.iter().any(is_exact);
    let caption = if has_exact { "Without brackets: neither arm is random." } else { "" }.to_owned();
    Table { caption, ..Table::new("Ratios of means", &["arm", "over", "kn Pa/m", "ratio"], rows.collect()) }
}

fn published(summary: &Summary) -> Table {
    let rows = summary.published.iter().map(|own| {
        vec![
            own.claim.clone(),
            own.verdict.words().to_owned(),
            own.theirs.clone(),
            own.ours.clone(),
            own.why.clone(),
            own.source.clone(),
        ]
    });
    let heads = ["statement", "verdict", "theirs", "ours", "why", "source"];
    Table::new("Published statements beside these numbers", &heads, rows.collect())
}
