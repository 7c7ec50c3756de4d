//! A plan of tests as a document.

use crate::render::csv::Csv;
use crate::render::document::{Document, Part, Table};
use crate::render::number::{or_dash, shortened, significant};
use crate::render::text::LONGEST_NAME;
use crate::verb::plan_tests::answer::{Otherwise, PlannedArm, PlannedDifference, TestPlan};

/// So many readings are shown of each pair of arms.
const SHOWN: usize = 3;

/// The document of a plan.
pub fn test_plan_document(plan: &TestPlan) -> Document<'_> {
    Document {
        title: format!("Tests of walls of study {} planned", plan.study),
        question: format!(
            "What do {} specimens of each arm tell, and how many would tell more?",
            plan.asked.specimens
        ),
        parts: parts(plan),
        files: vec![("plan-tests.csv", csv(plan))],
        limits: vec![
            "Real specimens are taken to differ as simulated walls do, but for the coefficient of variation that is stated.".to_owned(),
        ],
        methods: format!(
            "Numbers of specimens are those with which Student's test of two groups sees a difference with a power of {} at a \
             confidence of {}; characteristic values follow EN 1990, annex D7.",
            plan.asked.aim.power, plan.asked.aim.confidence
        ),
    }
}

/// What the specimens would tell, a line per pair of arms, then the readings and the characteristic values.
fn parts<'a>(plan: &TestPlan) -> Vec<Part<'a>> {
    let conclusions = best(plan).into_iter().map(|own| conclusion(plan, own));
    let mut parts: Vec<Part<'_>> = Part::sentences(conclusions).collect();
    let doubted =
        |other: &Otherwise| Part::Warning(format!("{} The plan by their COV follows below.", other.why));
    parts.extend(plan.otherwise.iter().map(doubted));
    parts.extend([differences(plan), arms(plan)].map(Part::Table));
    for other in &plan.otherwise {
        parts.push(Part::Heading(heading(other)));
        parts.extend(self::parts(&other.plan));
    }
    parts
}

/// One line per pair of arms and reading.
fn csv(plan: &TestPlan) -> Vec<u8> {
    let mut csv = Csv::new(
        "arm,over,reading,unit,difference,sigma,correlation,specimens_to_see,pairs_to_see,specimens,power,smallest_seen",
    );
    for own in &plan.differences {
        csv.line(&[
            &own.arm,
            &own.over,
            &own.reading,
            &own.unit,
            &own.difference,
            &own.sigma,
            &own.correlation,
            &own.specimens,
            &own.pairs,
            &plan.asked.specimens,
            &own.power,
            &own.smallest_seen,
        ]);
    }
    csv.bytes()
}

/// What looks wrong: a stated coefficient of variation that walls or specimens contradict.
pub fn test_plan_warnings(plan: &TestPlan) -> Vec<String> {
    plan.otherwise.iter().map(|other| format!("--cov: {}", other.why)).collect()
}

fn heading(other: &Otherwise) -> String {
    match other.plan.asked.known_cov {
        Some(cov) => format!("With the COV of the {}, {} %:", other.by, significant(100.0 * cov, 2)),
        None => format!("With the COV of the {}:", other.by),
    }
}

/// Of each pair the reading that needs the fewest specimens.
fn best(plan: &TestPlan) -> Vec<&PlannedDifference> {
    let mut best: Vec<&PlannedDifference> = Vec::new();
    for own in &plan.differences {
        if !best.iter().any(|other| other.arm == own.arm && other.over == own.over) {
            best.push(own);
        }
    }
    best
}

fn conclusion(plan: &TestPlan, own: &PlannedDifference) -> String {
    let pair = format!("{} and {}", shortened(&own.arm, LONGEST_NAME), shortened(&own.over, LONGEST_NAME));
    let specimens = plan.asked.specimens;
    match own.specimens {
        None => format!("{pair}: no number of specimens shows a difference."),
        Some(needed) if needed <= specimens => format!(
            "{pair}: {specimens} specimens of each show the difference by the {} (power {}); {needed} suffice.",
            own.reading,
            significant(own.power, 2)
        ),
        Some(needed) => format!(
            "{pair}: {specimens} specimens of each do not show the difference (power {} at best); {needed} would, by the {}.",
            significant(own.power, 2),
            own.reading
        ),
    }
}

fn differences(plan: &TestPlan) -> Table {
    let mut rows = Vec::new();
    let mut shown: Vec<(&str, &str, usize)> = Vec::new();
    for own in &plan.differences {
        let place = shown.iter().position(|(a, b, _)| *a == own.arm && *b == own.over);
        let place = place.unwrap_or_else(|| {
            shown.push((&own.arm, &own.over, 0));
            shown.len() - 1
        });
        shown[place].2 += 1;
        if shown[place].2 > SHOWN {
            continue;
        }
        rows.push(vec![
            own.arm.clone(),
            shortened(&own.over, LONGEST_NAME),
            own.reading.clone(),
            format!("{} {}", significant(own.difference, 3), own.unit),
            significant(own.sigma, 2),
            or_dash(own.correlation, 2),
            own.specimens.map_or_else(|| "-".to_owned(), |n| n.to_string()),
            own.pairs.map_or_else(|| "-".to_owned(), |pairs| format!("{:.0}", pairs.max(1.0).ceil())),
            significant(own.power, 2),
            or_dash(own.smallest_seen, 2),
        ]);
    }
    let (aim, specimens) = (plan.asked.aim, plan.asked.specimens);
    let summary = format!(
        "Specimens of each arm that show a difference with power {} at a confidence of {}; power and smallest difference of {specimens}",
        aim.power, aim.confidence
    );
    let heads =
        ["arm", "over", "reading", "difference", "sigma", "r", "needed", "pairs", "power", "seen from"];
    Table::new(&summary, &heads, rows)
}

fn arms(plan: &TestPlan) -> Table {
    let per_cent = |share: Option<f64>| or_dash(share.map(|share| 100.0 * share), 2);
    let row = |arm: &PlannedArm| {
        let needed = arm.specimens.map_or_else(|| "-".to_owned(), |n| n.to_string());
        vec![arm.name.clone(), per_cent(arm.cov), per_cent(arm.loss), needed]
    };
    let summary = format!(
        "Characteristic value of {} specimens (EN 1990 D7.2): what it loses of the true 5 % fractile in the mean, and specimens that \
         lose no more than {} %",
        plan.asked.specimens,
        significant(100.0 * plan.asked.loss, 2)
    );
    Table::new(&summary, &["arm", "COV %", "loss %", "needed"], plan.arms.iter().map(row).collect())
}
