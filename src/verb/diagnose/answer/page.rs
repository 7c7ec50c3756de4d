//! A verdict as a page. It shows what is wrong before it argues: the readings on the base model and on the best cause, the cause with a
//! sketch of it, and only then what the verdict rests on.

use anyhow::Result;
use serde::Serialize;

use crate::render::document::{Drawing, Line, Table, filled};
use crate::render::number::{bracketed, capital, or_dash as number_or_dash, significant};
use crate::study::{Study, in_plain_words};
use crate::verb::diagnose::answer::conclusion::{below_headline, headline};
use crate::verb::diagnose::answer::fit::{FitFigure, Misfit};
use crate::verb::diagnose::answer::parameter::{ParameterEntry, amount, as_read};
use crate::verb::diagnose::answer::sketch::sketch;
use crate::verb::diagnose::answer::summary::{CauseEntry, DataEntry, DiagnosisSummary};
use crate::verb::diagnose::answer::text::{
    CAUSE, CAUSES, FORM, NO_FORM, OFF, beside_prior, by_chance, not_used, or_dash, others, pairs,
    reliability, worth_saying,
};
use crate::verb::diagnose::answer::words::{lines, reading};
use crate::verb::diagnose::gain::GainSummary;
use crate::verb::run::answer::page::{Citation, PageOrigin, citation, limits};

/// What the page of a verdict is made of.
pub struct DiagnosisPage<'a> {
    /// The study that was measured.
    pub study: &'a Study,
    /// The verdict.
    pub summary: &'a DiagnosisSummary,
    /// Both models on the readings.
    pub fit: &'a FitFigure,
    /// Their figure, if it has anything in it.
    pub fitted: Option<&'a Drawing>,
    /// The other figures.
    pub drawings: &'a [Drawing],
    /// How the verdict was made.
    pub origin: &'a PageOrigin,
}

/// What the template is filled with.
#[derive(Serialize)]
struct Filled<'a> {
    title: String,
    question: String,
    headline: String,
    about_fit: &'static str,
    answer: Vec<String>,
    fit: Option<&'a Drawing>,
    misfits: Table,
    causes: Vec<Cause>,
    notes: &'a [String],
    extended: String,
    about_beside: String,
    beside: Table,
    figures: &'a [Drawing],
    about_off: String,
    chance: Option<String>,
    off: Table,
    about_ranking: String,
    ranking: Table,
    pairs: Option<String>,
    form: Table,
    about_gain: &'static str,
    gain: Vec<Table>,
    advice: Vec<String>,
    next: Vec<Table>,
    reliability: Vec<String>,
    limits: Vec<String>,
    provenance: Table,
    methods: String,
    citation: Citation,
}

/// A cause of the verdict.
#[derive(Serialize)]
struct Cause {
    id: &'static str,
    title: String,
    means: String,
    sketch: Drawing,
    parameters: Table,
    beside_prior: Vec<String>,
}

/// The page of a verdict.
///
/// # Errors
/// A template that is faulty.
pub fn diagnosis_page(of: &DiagnosisPage<'_>) -> Result<String> {
    let (study, summary) = (of.study, of.summary);
    let variant = summary.variant.as_ref().map_or_else(String::new, |variant| format!(", variant {variant}"));
    let cells = lines(&summary.groups).into_iter();
    let beside = cells.map(|line| vec![line.what, line.measured, line.simulated, line.finding]).collect();
    let off = worth_saying(summary).into_iter();
    let off = off.map(|off| vec![off.what.clone(), format!("{:+.1}", off.in_sd)]).collect();
    filled(
        "diagnosis.html",
        include_str!("diagnosis.html"),
        &Filled {
            title: format!("Diagnosis of study {}{variant}", summary.study),
            question: "What does the simulation get wrong, and which cause explains it?".to_owned(),
            headline: headline(summary),
            about_fit: if summary.verdict == "nothing_found" { "What was found" } else { "What is wrong" },
            answer: below_headline(summary),
            fit: of.fitted,
            misfits: misfits(of.fit),
            causes: summary.causes.iter().filter(|cause| cause.in_verdict).map(shown).collect(),
            notes: &summary.notes,
            extended: summary.extended.join(", "),
            about_beside: reading(&summary.groups),
            beside: Table::new("", &["what", "measured", "simulated", "finding"], beside),
            figures: of.drawings,
            about_off: format!("{OFF}."),
            chance: by_chance(summary),
            off: Table::new("", &["what", "sd"], off),
            about_ranking: format!("{}.", capital(CAUSE)),
            ranking: ranking(summary),
            pairs: pairs(summary),
            form: form(summary),
            about_gain: match &summary.gain {
                Some(_) => {
                    "Extended less base model, on readings that neither had seen. Intervals are calibrated on campaigns \
                            without any effect."
                }
                None => {
                    "Not measured: nothing was found, too few specimens were read, or it was not asked for."
                }
            },
            gain: summary.gain.as_ref().map_or_else(Vec::new, GainSummary::tables),
            advice: summary.advice.sentences(),
            next: summary.advice.tables(),
            reliability: reliability(summary),
            limits: limited(study, summary),
            provenance: provenance(summary, of.origin),
            methods: methods(study, summary),
            citation: citation(Some(summary.seed)),
        },
    )
}

/// How far readings lie from both models.
fn misfits(fit: &FitFigure) -> Table {
    let row = |own: Misfit| {
        let cause = number_or_dash(own.cause, 2);
        vec![own.what, own.readings.to_string(), significant(own.base, 2), cause]
    };
    let caption = "How far the readings lie from the walls of each model: root of the mean square, in standard deviations of walls and \
                   errors together. About 1 is as it should be. Bounds are left out."
        .to_owned();
    let cause = if fit.in_verdict { "with the cause" } else { "with the cause that fits best" };
    let heads = ["what", "readings", "base model, joints fitted", cause];
    let heads = if fit.causes.is_empty() { &heads[..3] } else { &heads[..] };
    let mut rows: Vec<Vec<String>> = fit.misfits().into_iter().map(row).collect();
    rows.iter_mut().for_each(|cells| cells.truncate(heads.len()));
    Table { caption, ..Table::new("", heads, rows) }
}

fn shown(cause: &CauseEntry) -> Cause {
    let row = |own: &ParameterEntry| {
        vec![
            format!("{}: {}", own.place(), own.meaning),
            amount(own.median, own.interval, own.unit),
            bracketed(own.prior_interval.map(|end| as_read(own.unit).0 * end), 3),
        ]
    };
    let heads = ["parameter", "found: median and 90 % interval", "expected beforehand, 90 %"];
    let scope = cause.scope.as_ref();
    let acts_on = scope.map_or_else(String::new, |scope| format!(" It acts on {}.", scope.with_share()));
    Cause {
        id: cause.id,
        title: capital(&in_plain_words(cause.id)),
        means: format!("It would mean: {}.{acts_on}", cause.means),
        sketch: sketch(cause.id, cause.title),
        parameters: Table::new("", &heads, cause.parameters.iter().map(row).collect()),
        beside_prior: beside_prior(cause),
    }
}

/// The causes as they are ranked, and how the verdict takes each.
fn ranking(summary: &DiagnosisSummary) -> Table {
    let row = |cause: &CauseEntry| {
        let [evidence, check] = [cause.evidence, cause.guard_p_value].map(or_dash);
        let cells = vec![
            in_plain_words(cause.id),
            format!("{:.3}", cause.probability),
            evidence,
            check,
            stands(summary, cause).to_owned(),
        ];
        Line { marked: cause.in_verdict, cells, ..Line::default() }
    };
    let mut rows: Vec<Line> = summary.causes.iter().take(CAUSES).map(row).collect();
    for (what, probability) in others(summary) {
        let cells = [what, &format!("{probability:.3}"), "-", "-", ""].map(String::from).to_vec();
        rows.push(Line { cells, ..Line::default() });
    }
    let heads = ["cause", "probability", "evidence", "predictive p", "how the verdict takes it"];
    Table { rows, ..Table::new("", &heads, Vec::new()) }
}

/// How the verdict takes a cause: so that no large probability stands there unexplained.
fn stands(summary: &DiagnosisSummary, cause: &CauseEntry) -> &'static str {
    match (cause.in_verdict, cause.excluded_by, summary.verdict) {
        (true, _, "ambiguous") => "may be it",
        (true, ..) => "named",
        (_, Some("readings"), _) => {
            "excluded: it fits the readings worse than nearly all campaigns that it predicts"
        }
        (_, Some("looks"), _) => "excluded: nine in ten of its own campaigns look more like it",
        (_, Some("evidence"), _) => "excluded: the evidence is 20 to 1 or more against it",
        (_, _, "nothing_found") => "not needed: nothing is off beyond chance",
        (_, _, "unexplained") => "not excluded, and not sure enough to be named",
        _ => "not excluded, and less likely",
    }
}

fn form(summary: &DiagnosisSummary) -> Table {
    let mut rows: Vec<Vec<String>> = Vec::new();
    if summary.verdict == "unexplained" {
        rows = summary.form.iter().map(|own| vec![own.sentence()]).collect();
        if rows.is_empty() {
            rows.push(vec![NO_FORM.to_owned()]);
        }
    }
    Table::new("", &[FORM], rows)
}

fn limited(study: &Study, summary: &DiagnosisSummary) -> Vec<String> {
    let mut said = vec![
        "A cause can be named only if it is in the catalogue (pirca reference causes). What looks the same on these readings is told apart by \
         another measurement alone."
            .to_owned(),
        "Probabilities are relative: they say which cause of the catalogue is likelier, given that all were equally likely before."
            .to_owned(),
        limits::RIGID.to_owned(),
        limits::of_solver(study.solver.name()).to_owned(),
    ];
    said.extend(not_used(summary).map(|words| format!("{words}.")));
    said
}

fn provenance(summary: &DiagnosisSummary, origin: &PageOrigin) -> Table {
    let mut own = vec![
        ("pirca", env!("CARGO_PKG_VERSION").to_owned()),
        ("study", summary.study.clone()),
        ("variant", summary.variant.clone().unwrap_or_else(|| "none".to_owned())),
        ("seed", summary.seed.to_string()),
        ("SHA-256 of the simulated walls' design", summary.bank.clone()),
    ];
    if let Some(DataEntry { file, sha256 }) = &summary.measured {
        own.push(("measured", file.clone()));
        own.push(("SHA-256 of it", sha256.clone()));
    }
    origin.table(own)
}

fn methods(study: &Study, summary: &DiagnosisSummary) -> String {
    let measured = summary
        .measured
        .as_ref()
        .map_or_else(String::new, |data| format!(" ({}, SHA-256 {})", data.file, data.sha256));
    format!(
        "The measurements{measured} were compared with campaigns simulated by pirca {} ({} solver, seed {}), with joint stiffness and \
         friction drawn from their priors and the instruments' errors added. A discrepancy is a p-value below 0.05 among {} campaigns \
         without any effect. Causes were ranked by campaigns of each mechanism of the catalogue, weighed by their evidence \
         (tempered sequential Monte Carlo; Del Moral, Doucet and Jasra 2006), and checked by posterior prediction. The gain was \
         measured on readings that were left out.",
        env!("CARGO_PKG_VERSION"),
        study.solver.name(),
        summary.seed,
        summary.p_value_campaigns,
    )
}
