//! What is printed of a plan of tests.

use crate::render::number::{or_dash, shortened, significant};
use crate::render::text::{LONGEST_NAME, aligned, wrapped};
use crate::verb::plan_tests::answer::{Otherwise, PlannedDifference, TestPlan};

/// So many readings are shown of each pair of arms.
const SHOWN: usize = 3;

/// What the specimens would tell, a line per pair of arms, then the readings and the characteristic values.
pub fn test_plan_text(plan: &TestPlan) -> String {
    let mut text = String::new();
    for own in best(plan) {
        text.push_str(&wrapped("", &conclusion(plan, own)));
    }
    for other in &plan.otherwise {
        text.push_str(&wrapped("! ", &format!("{} The plan by their COV follows below.", other.why)));
    }
    text.push_str(&differences(plan));
    text.push_str(&arms(plan));
    for other in &plan.otherwise {
        text.push_str(&format!("\n{}\n{}", heading(other), test_plan_text(&other.plan)));
    }
    text
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

fn differences(plan: &TestPlan) -> String {
    let specimens = plan.asked.specimens;
    let mut rows = vec![
        ["arm", "over", "reading", "difference", "sigma", "r", "needed", "pairs", "power", "seen from"]
            .map(str::to_owned)
            .to_vec(),
    ];
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
    if rows.len() == 1 {
        return String::new();
    }
    let aim = plan.asked.aim;
    format!(
        "\nSpecimens of each arm that show a difference with power {} at a confidence of {}; power and smallest difference of {specimens}\n{}",
        aim.power,
        aim.confidence,
        aligned(rows)
    )
}

fn arms(plan: &TestPlan) -> String {
    if plan.arms.is_empty() {
        return String::new();
    }
    let per_cent = |share: Option<f64>| or_dash(share.map(|share| 100.0 * share), 2);
    let mut rows = vec![["arm", "COV %", "loss %", "needed"].map(str::to_owned).to_vec()];
    rows.extend(plan.arms.iter().map(|arm| {
        vec![
            arm.name.clone(),
            per_cent(arm.cov),
            per_cent(arm.loss),
            arm.specimens.map_or_else(|| "-".to_owned(), |n| n.to_string()),
        ]
    }));
    format!(
        "\nCharacteristic value of {} specimens (EN 1990 D7.2): what it loses of the true 5 % fractile in the mean,\nand specimens that lose no more than {} %\n{}",
        plan.asked.specimens,
        significant(100.0 * plan.asked.loss, 2),
        aligned(rows)
    )
}
