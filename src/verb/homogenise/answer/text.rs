//! What `homogenise` prints: stiffness, strength, and what they do as cells grow. At most 100 columns wide.

use crate::homogenise::{Direction, Method};
use crate::render::number::significant;
use crate::render::text::{aligned, wrapped};
use crate::stats::{Settled, Summary};
use crate::verb::homogenise::answer::entry::{HomogenisedSummary, PlateArm, PlateValue, ValueBySize};
use crate::verb::homogenise::answer::walls::WallShare;

/// The moduli and the stresses that are printed and drawn; all are in the files.
pub(crate) const MODULI: [&str; 5] = ["A1111", "A2222", "A1212", "D1111", "D2222"];
pub(crate) const STRESSES: [(&str, Direction); 5] = [
    ("N11", [1.0, 0.0, 0.0, 0.0, 0.0, 0.0]),
    ("N12", [0.0, 0.0, 1.0, 0.0, 0.0, 0.0]),
    ("M11", [0.0, 0.0, 0.0, 1.0, 0.0, 0.0]),
    ("M22", [0.0, 0.0, 0.0, 0.0, 1.0, 0.0]),
    ("M12", [0.0, 0.0, 0.0, 0.0, 0.0, 1.0]),
];

/// Below this a COV is rounding.
pub(crate) const ALIKE: f64 = 1e-6;

/// Below this a strength is rounding.
const NONE: f64 = 1e-9;

/// Three digits, large numbers with an exponent.
fn number(value: Option<f64>) -> String {
    value.map_or_else(
        || "-".to_owned(),
        |x| match x.abs() {
            size if size < NONE => "0".to_owned(),
            size if size < 1e4 => significant(x, 3),
            _ => format!("{x:.2e}"),
        },
    )
}

/// The summary as text for a terminal.
pub fn homogenised_text(summary: &HomogenisedSummary) -> String {
    let variant = summary.variant.as_ref().map_or_else(String::new, |variant| format!(", variant {variant}"));
    let [along, courses] = summary.arms.first().map(|arm| arm.cell.stones).unwrap_or_default();
    let most = summary.arms.iter().map(|arm| arm.cell.cells).max().unwrap_or(0);
    let head = format!(
        "{}{variant}, masonry as a plate: {most} cells of {along} x {courses} stones of each arm in which anything is drawn, seed {}.",
        summary.study, summary.seed
    );
    let mut text = wrapped("", &head);
    text.push_str(
        "\nStiffness at kn of the arm (A: N/m, D: N m; mean, in brackets the COV between cells in %)\n",
    );
    text.push_str(&aligned(table(summary, &["arm"], MODULI.map(String::from), |arm| {
        vec![(String::new(), MODULI.map(|name| arm.moduli.get(name)).to_vec())]
    })));
    for arm in &summary.arms {
        text.push_str(&notes(arm));
    }
    if summary.arms.iter().any(|arm| !arm.surface.is_empty()) {
        text.push('\n');
        text.push_str(&wrapped(
            "",
            "Strength beside the vertical stress N22 = -p (N over p, M over p times the thickness; mean, COV in %). Associative: an upper \
             bound for joints that dilate less. Non-associative: a state without dilatancy, neither a bound nor unique. Elastic: \
             strained from rest without dilatancy.",
        ));
        text.push_str(&aligned(table(
            summary,
            &["arm", "method"],
            STRESSES.map(|(name, _)| name.to_owned()),
            by_method,
        )));
    }
    text.push_str(&sizes(summary));
    if summary.arms.iter().any(|arm| arm.walls.is_some()) {
        text.push_str(&walls(summary));
    }
    text
}

/// Walls beside their plates.
fn walls(summary: &HomogenisedSummary) -> String {
    let mut text = "\n".to_owned();
    text.push_str(&wrapped(
        "",
        "Walls beside their plates: the tangent of the tilt, or the factor on the lateral load, that they bear by associative limit \
         analysis (mean, COV in %).",
    ));
    let heads = [
        "arm",
        "walls",
        "stones",
        "plates",
        "stones/plate",
        "within 5 %",
        "held by cells",
        "held by walls",
        "no dilatancy",
    ];
    let mut rows = vec![heads.map(str::to_owned).to_vec()];
    let scatter = |sample: &Summary| match sample.cov.value {
        Some(cov) if cov > ALIKE => {
            format!("{} [{}]", number(sample.mean.value), significant(100.0 * cov, 2))
        }
        _ => number(sample.mean.value),
    };
    let share = |share: Option<WallShare>| {
        share.map_or_else(|| "-".to_owned(), |share| format!("{}/{}", share.count, share.of))
    };
    for (arm, walls) in summary.arms.iter().filter_map(|arm| Some((arm, arm.walls.as_ref()?))) {
        let ratio = |sample: &Option<Summary>| sample.as_ref().map_or_else(|| "-".to_owned(), scatter);
        rows.push(vec![
            arm.arm.clone(),
            walls.stones.load.n.to_string(),
            scatter(&walls.stones.load),
            scatter(&walls.plates.load),
            ratio(&walls.stones_over_plate),
            share(walls.within_5_percent),
            share(walls.by_cells.map(|own| own.held)),
            share(walls.by_walls.map(|own| own.held)),
            ratio(&walls.non_associative_over_associative),
        ]);
    }
    text.push_str(&aligned(rows));
    for (arm, walls) in summary.arms.iter().filter_map(|arm| Some((arm, arm.walls.as_ref()?))) {
        if let Some((own, held)) = walls.validity.zip(walls.by_cells) {
            let [least, most] = own.stones_over_plate.map(|ratio| significant(ratio, 3));
            let [low, high] = held.interval.map(|load| significant(load, 3));
            let line = format!(
                "{}: a wall bears {least} to {most} times its plate, by walls of other shapes: {low} to {high} at 95 % (shear \
                 across the thickness {} of friction)",
                arm.arm,
                significant(own.shear_ratio, 2)
            );
            text.push_str(&wrapped("", &line));
        }
        for (what, sample) in [("plates", &walls.plates), ("walls", &walls.stones)] {
            let mut said = Vec::new();
            if sample.bear_any > 0 {
                said.push(format!("{} {what} bear any load", sample.bear_any));
            }
            if let Some(why) = &sample.out_of_range_why {
                said.push(format!("{} {what} are out of the range of plates: {why}", sample.out_of_range));
            }
            if sample.fall_at_rest > 0 {
                said.push(format!("{} {what} fall at rest and count with 0", sample.fall_at_rest));
            }
            said.extend(
                sample.failed.iter().map(|(why, count)| format!("{count} {what} have no answer: {why}")),
            );
            said.iter().for_each(|one| text.push_str(&wrapped("! ", &format!("{}: {one}", arm.arm))));
        }
    }
    text
}

/// The values of an arm, a row per method.
fn by_method(arm: &PlateArm) -> Vec<(String, Vec<Option<&PlateValue>>)> {
    let row = |method: Method| {
        let of = |(_, direction): &(&str, Direction)| {
            let own = arm.surface.iter().find(|own| own.method == method && own.direction == *direction);
            own.map(|own| &own.value)
        };
        (method.name().to_owned(), STRESSES.iter().map(of).collect::<Vec<_>>())
    };
    let rows = Method::ALL.map(row);
    rows.into_iter().filter(|(_, values)| values.iter().any(Option::is_some)).collect()
}

/// A head, and the rows of every arm.
fn table<'s, const N: usize>(
    summary: &'s HomogenisedSummary,
    heads: &[&str],
    names: [String; N],
    of: impl Fn(&'s PlateArm) -> Vec<(String, Vec<Option<&'s PlateValue>>)>,
) -> Vec<Vec<String>> {
    let shown = |value: &Option<&PlateValue>| {
        value.map_or_else(
            || "-".to_owned(),
            |value| match value.cov {
                Some(cov) if cov > ALIKE => {
                    format!("{} [{}]", number(value.mean), significant(100.0 * cov, 2))
                }
                _ => number(value.mean),
            },
        )
    };
    let mut rows = vec![heads.iter().map(|head| (*head).to_owned()).chain(names).collect::<Vec<_>>()];
    for arm in &summary.arms {
        for (what, values) in of(arm) {
            let head = [arm.arm.clone()].into_iter().chain((!what.is_empty()).then_some(what));
            rows.push(head.chain(values.iter().map(shown)).collect());
        }
    }
    rows
}

/// What is to be said of the cells of an arm.
fn notes(arm: &PlateArm) -> String {
    let mut text = String::new();
    let gap = arm.cell.head_joint_gap_m;
    if gap > 0.0 {
        text.push_str(&wrapped(
            "! ",
            &format!(
                "{}: head joints are open by {} mm (head_joint_gap_m) and carry nothing: strains are small, and no gap closes",
                arm.arm,
                significant(1e3 * gap, 3)
            ),
        ));
    }
    let nested = arm.cell.nested;
    if nested.held < nested.of {
        text.push_str(&wrapped(
            "! ",
            &format!(
                "{}: the moduli of {} of {} cells leave their bounds",
                arm.arm,
                nested.of - nested.held,
                nested.of
            ),
        ));
    }
    for (reason, count) in &arm.cell.failed {
        text.push_str(&wrapped("! ", &format!("{}: {count} cells could not be built: {reason}", arm.arm)));
    }
    let lost: usize = arm.surface.iter().map(|own| own.not_converged).sum();
    if lost > 0 {
        text.push_str(&wrapped(
            "! ",
            &format!("{}: {lost} points of the surface were not found; they are in no mean", arm.arm),
        ));
    }
    text
}

/// What the sizes of the cells show, quantity by quantity.
fn sizes(summary: &HomogenisedSummary) -> String {
    let mut text = String::new();
    for arm in &summary.arms {
        let moduli = MODULI.iter().filter_map(|name| Some(((*name).to_owned(), arm.moduli.get(*name)?)));
        let strengths = arm.surface.iter().filter_map(|own| {
            let (name, _) = STRESSES.iter().find(|(_, direction)| *direction == own.direction)?;
            Some((format!("{name} {}", own.method.name()), &own.value))
        });
        let all: Vec<(String, &ValueBySize)> = moduli
            .chain(strengths)
            .filter_map(|(name, value)| Some((name, value.by_size.as_ref()?)))
            .collect();
        if all.is_empty() {
            continue;
        }
        if text.is_empty() {
            text.push_str("\nSize of the cells\n");
        }
        for settled in [Settled::Converged, Settled::SizeEffect, Settled::NoScatter, Settled::Undecided] {
            let own: Vec<String> = all
                .iter()
                .filter(|(_, by_size)| by_size.shown.is_some_and(|shown| shown.settled == settled))
                .map(|(name, by_size)| said(name, by_size, settled))
                .collect();
            if !own.is_empty() {
                text.push_str(&wrapped("", &format!("{}, {}: {}", arm.arm, words(settled), own.join(", "))));
            }
        }
    }
    text
}

/// A quantity, with its change per doubling where the size has an effect.
fn said(name: &str, by_size: &ValueBySize, settled: Settled) -> String {
    let change = by_size.shown.and_then(|shown| shown.per_doubling.value);
    match (settled, change) {
        (Settled::SizeEffect, Some(change)) => format!("{name} ({:+.1} %)", 100.0 * change),
        _ => name.to_owned(),
    }
}

fn words(settled: Settled) -> &'static str {
    match settled {
        Settled::NoScatter => "the same in every cell of every size",
        Settled::Converged => "converged (mean within its standard error, sigma falls as 1/n)",
        Settled::SizeEffect => "the mean changes with the cell (per doubling)",
        Settled::Undecided => "undecided; larger or more cells are needed",
    }
}
