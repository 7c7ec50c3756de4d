//! Masonry as a plate as a document: stiffness, strength, and what they do as cells grow.

use crate::ensemble::{AskedOfCells, CellRow, WallRow};
use crate::homogenise::{Direction, Method};
use crate::render::document::{Document, Part, Table};
use crate::render::number::significant;
use crate::stats::{Settled, Summary};
use crate::study::Study;
use crate::verb::homogenise::answer::csv::{cells_csv, surface_csv, timing_csv, walls_csv};
use crate::verb::homogenise::answer::entry::{HomogenisedSummary, PlateArm, PlateValue, ValueBySize};
use crate::verb::homogenise::answer::plot::CellPlot;
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

/// The document of a summary, with the tables of its cells and walls.
pub fn homogenised_document<'s>(
    (study, asked, rows, walls): (&Study, &AskedOfCells, &[CellRow], &[WallRow]),
    summary: &'s HomogenisedSummary,
) -> Document<'s> {
    let variant = summary.variant.as_ref().map_or_else(String::new, |variant| format!(", variant {variant}"));
    let [along, courses] = summary.arms.first().map(|arm| arm.cell.stones).unwrap_or_default();
    let most = summary.arms.iter().map(|arm| arm.cell.cells).max().unwrap_or(0);
    let mut parts = vec![
        Part::Sentence(format!(
            "{}{variant}, masonry as a plate: {most} cells of {along} x {courses} stones of each arm in which anything is drawn, seed {}.",
            summary.study, summary.seed
        )),
        Part::Table(stiffness(summary)),
    ];
    parts.extend(summary.arms.iter().flat_map(notes).map(Part::Warning));
    parts.push(Part::Table(strength(summary)));
    parts.extend(sizes(summary));
    if summary.arms.iter().any(|arm| arm.walls.is_some()) {
        parts.extend(beside_walls(summary));
    }
    let mut files =
        vec![("cells.csv", cells_csv(study, asked, rows)), ("surface.csv", surface_csv(study, asked, rows))];
    if !walls.is_empty() {
        // How long each wall took differs from run to run, all else does not.
        files.extend([("walls.csv", walls_csv(study, walls)), ("timing.csv", timing_csv(study, walls))]);
    }
    parts.extend(CellPlot::all(summary).into_iter().map(Part::Figure));
    Document {
        title: format!("Masonry of study {} as a plate", summary.study),
        question: "How stiff and how strong is such masonry as a plate, and how much does that scatter?".to_owned(),
        parts,
        files,
        limits: vec![
            "A cell repeats itself without end: edges and openings of a wall are not in it. Moments and forces vary little from stone to \
             stone where a plate says what a wall does."
                .to_owned(),
        ],
        methods: "Moduli are those of periodic cells whose stones are rigid and whose joints are elastic; strengths are those of the cell \
                  beside its own weight's pressure. A mean has converged where it changes by less than its standard error as cells grow."
            .to_owned(),
    }
}

fn stiffness(summary: &HomogenisedSummary) -> Table {
    let title = "Stiffness at kn of the arm (A: N/m, D: N m; mean, in brackets the COV between cells in %)";
    Table::headed(
        title,
        table(summary, &["arm"], MODULI.map(String::from), |arm| {
            vec![(String::new(), MODULI.map(|name| arm.moduli.get(name)).to_vec())]
        }),
    )
}

/// The strength of all arms; without rows where none was asked for.
fn strength(summary: &HomogenisedSummary) -> Table {
    let title = "Strength beside the vertical stress N22 = -p (N over p, M over p times the thickness; mean, COV in %). Associative: an upper \
                 bound for joints that dilate less. Non-associative: a state without dilatancy, neither a bound nor unique. Elastic: \
                 strained from rest without dilatancy.";
    let names = STRESSES.map(|(name, _)| name.to_owned());
    Table::headed(title, table(summary, &["arm", "method"], names, by_method))
}

/// Walls beside their plates.
fn beside_walls<'a>(summary: &HomogenisedSummary) -> Vec<Part<'a>> {
    let title = "Walls beside their plates: the tangent of the tilt, or the factor on the lateral load, that they bear by associative \
                 limit analysis (mean, COV in %).";
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
    let mut rows = Vec::new();
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
    let mut parts = vec![Part::Table(Table::new(title, &heads, rows))];
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
            parts.push(Part::Sentence(line));
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
            parts.extend(said.iter().map(|one| Part::Warning(format!("{}: {one}", arm.arm))));
        }
    }
    parts
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
fn notes(arm: &PlateArm) -> Vec<String> {
    let mut notes = Vec::new();
    let (name, gap, nested) = (&arm.arm, arm.cell.head_joint_gap_m, arm.cell.nested);
    if gap > 0.0 {
        notes.push(format!(
            "{name}: head joints are open by {} mm (head_joint_gap_m) and carry nothing: strains are small, and no gap closes",
            significant(1e3 * gap, 3)
        ));
    }
    if nested.held < nested.of {
        let left = nested.of - nested.held;
        notes.push(format!("{name}: the moduli of {left} of {} cells leave their bounds", nested.of));
    }
    let failed = arm.cell.failed.iter();
    notes.extend(failed.map(|(reason, count)| format!("{name}: {count} cells could not be built: {reason}")));
    let lost: usize = arm.surface.iter().map(|own| own.not_converged).sum();
    if lost > 0 {
        notes.push(format!("{name}: {lost} points of the surface were not found; they are in no mean"));
    }
    notes
}

/// What the sizes of the cells show, quantity by quantity; nothing where there is one size.
fn sizes<'a>(summary: &HomogenisedSummary) -> Option<Part<'a>> {
    let mut items = Vec::new();
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
        for settled in [Settled::Converged, Settled::SizeEffect, Settled::NoScatter, Settled::Undecided] {
            let own: Vec<String> = all
                .iter()
                .filter(|(_, by_size)| by_size.shown.is_some_and(|shown| shown.settled == settled))
                .map(|(name, by_size)| said(name, by_size, settled))
                .collect();
            if !own.is_empty() {
                items.push((String::new(), format!("{}, {}: {}", arm.arm, words(settled), own.join(", "))));
            }
        }
    }
    (!items.is_empty()).then(|| Part::List { title: "Size of the cells".to_owned(), items })
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
