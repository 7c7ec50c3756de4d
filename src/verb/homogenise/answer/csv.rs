//! The tables of masonry seen as a plate: a line per cell, a line per cell and point of its surface, and a line per wall.

use crate::ensemble::{AskedOfCells, CellRow, Judged, Subject, WallRow};
use crate::homogenise::{Border, Found, Loose};
use crate::render::csv::Csv;
use crate::study::Study;
use crate::verb::homogenise::answer::entry::named;

/// The cell that a row is of: its arm, its stones along and its courses, its number.
fn head<'s>(study: &'s Study, asked: &AskedOfCells, row: &CellRow) -> (&'s str, [u32; 2], u64) {
    (&study.arms[row.task.arm as usize].name, asked.sizes[row.task.size], row.task.cell)
}

/// A line per cell: how it ended, and its moduli by border.
pub(crate) fn cells_csv(study: &Study, asked: &AskedOfCells, rows: &[CellRow]) -> Vec<u8> {
    let named = named();
    let names: String = named.iter().map(|modulus| format!(",{}", modulus.name)).collect();
    let mut csv =
        Csv::new(format!("arm,stones_along,courses,cell,outcome,reason,stones,joints,border{names}"));
    let none = || vec![None::<f64>; named.len()];
    for row in rows {
        let (arm, size, cell) = head(study, asked, row);
        let answer = match &row.found {
            Err(fault) => {
                let why = fault.to_string();
                csv.line(&[&arm, &size, &cell, &"invalid_geometry", &why, &[""; 3], &none()]);
                continue;
            }
            Ok(answer) => answer,
        };
        for (border, moduli) in Border::ALL.iter().zip(&answer.moduli) {
            let (outcome, why, values) = match moduli {
                Ok(moduli) => (
                    "solved",
                    String::new(),
                    named.iter().map(|modulus| Some((modulus.of)(moduli))).collect(),
                ),
                Err(fault) => (name(*fault), fault.to_string(), none()),
            };
            let counts = [answer.stones, answer.joints];
            csv.line(&[&arm, &size, &cell, &outcome, &why, &counts, &border.name(), &values]);
        }
    }
    csv.bytes()
}

/// Why there are no moduli, as in files.
fn name(fault: Loose) -> &'static str {
    match fault {
        Loose::NoJoints => "no_joints",
        Loose::ComesApart => "comes_apart",
    }
}

/// A line per cell, method and direction: what was found there, and the normal of the surface.
pub(crate) fn surface_csv(study: &Study, asked: &AskedOfCells, rows: &[CellRow]) -> Vec<u8> {
    let stresses = ["n11", "n22", "n12", "m11", "m22", "m12"];
    let columns = |of: &str| stresses.map(|stress| format!("{of}_{stress}")).join(",");
    let mut csv = Csv::new(format!(
        "arm,stones_along,courses,cell,method,{},outcome,value,{}",
        columns("direction"),
        columns("normal")
    ));
    for row in rows {
        let Ok(answer) = &row.found else { continue };
        let (arm, size, cell) = head(study, asked, row);
        for (method, points) in asked.of.methods.iter().zip(&answer.surfaces) {
            for point in points {
                let (outcome, value) = match &point.found {
                    Found::Borne(value) => ("borne", Some(*value)),
                    Found::AtLeast(value) => ("at_least", Some(*value)),
                    Found::Unbounded => ("unbounded", None),
                    Found::FallsAtRest => ("falls_at_rest", Some(0.0)),
                    Found::NotConverged(_) => ("not_converged", None),
                };
                let (direction, normal) = (&point.direction, &point.normal);
                csv.line(&[&arm, &size, &cell, &method.name(), direction, &outcome, &value, normal]);
            }
        }
    }
    csv.bytes()
}

/// How it ended, in files: outcome, load, reason.
fn ended(judged: &Judged) -> (&'static str, Option<f64>, String) {
    match judged {
        Judged::Falls(load) => ("falls", Some(*load), String::new()),
        Judged::BearsAny => ("bears_any", None, String::new()),
        Judged::FallsAtRest => ("falls_at_rest", Some(0.0), String::new()),
        Judged::OutOfRange(why) => ("out_of_range", None, why.to_string()),
        Judged::NotSolved(why) => ("not_solved", None, why.clone()),
        Judged::Invalid(why) => ("invalid_geometry", None, why.clone()),
    }
}

/// What a row is of, in files: arm, plate or stones, number.
fn head_of_wall<'s>(study: &'s Study, row: &WallRow) -> (&'s str, &'static str, u64) {
    let (subject, number) = match row.task.subject {
        Subject::Plate(cell) => ("plate", cell),
        Subject::Stones(member) => ("stones", member),
    };
    (&study.arms[row.task.arm as usize].name, subject, number)
}

/// A line per plate, and one or two per wall.
pub(crate) fn walls_csv(study: &Study, rows: &[WallRow]) -> Vec<u8> {
    let mut csv = Csv::new("arm,subject,number,method,outcome,load,shear_ratio,reason");
    for row in rows {
        let (arm, subject, number) = head_of_wall(study, row);
        let by_method =
            [("associative", Some(&row.found)), ("non-associative", row.non_associative.as_ref())];
        for (method, judged) in by_method.into_iter().filter_map(|(method, judged)| Some((method, judged?))) {
            let (outcome, load, reason) = ended(judged);
            let shear = row.validity.map(|own| own.shear_ratio);
            csv.line(&[&arm, &subject, &number, &method, &outcome, &load, &shear, &reason]);
        }
    }
    csv.bytes()
}

/// How long each took, which differs from run to run.
pub(crate) fn timing_csv(study: &Study, rows: &[WallRow]) -> Vec<u8> {
    let mut csv = Csv::new("arm,subject,number,seconds,seconds_non_associative");
    for row in rows {
        let (arm, subject, number) = head_of_wall(study, row);
        csv.line(&[&arm, &subject, &number, &row.seconds.map(|seconds| format!("{seconds:.6}"))]);
    }
    csv.bytes()
}
