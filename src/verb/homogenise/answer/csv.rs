//! The tables of masonry seen as a plate: a line per cell, a line per cell and point of its surface, and a line per wall.

use crate::ensemble::{AskedOfCells, CellRow, Judged, Subject, WallRow};
use crate::homogenise::{Border, Found, Loose, Moduli};
use crate::render::csv::quoted;
use crate::study::Study;
use crate::verb::homogenise::answer::entry::named;

/// The cell that a row is of.
fn head(study: &Study, asked: &AskedOfCells, row: &CellRow) -> String {
    let [along, courses] = asked.sizes[row.task.size];
    format!("{},{along},{courses},{}", quoted(&study.arms[row.task.arm as usize].name), row.task.cell)
}

/// A line per cell: how it ended, and its moduli by border.
pub(crate) fn cells_csv(study: &Study, asked: &AskedOfCells, rows: &[CellRow]) -> String {
    let named = named();
    let mut text = "arm,stones_along,courses,cell,outcome,reason,stones,joints,border".to_owned();
    named.iter().for_each(|modulus| text.push_str(&format!(",{}", modulus.name)));
    text.push('\n');
    for row in rows {
        let head = head(study, asked, row);
        let empty = ",".repeat(named.len());
        match &row.found {
            Err(fault) => {
                text.push_str(&format!("{head},invalid_geometry,{},,,{empty}\n", quoted(&fault.to_string())));
            }
            Ok(answer) => {
                for (border, moduli) in Border::ALL.iter().zip(&answer.moduli) {
                    let counts = format!("{},{},{}", answer.stones, answer.joints, border.name());
                    let own = |own: &Moduli| {
                        named.iter().map(|modulus| format!(",{}", (modulus.of)(own))).collect::<String>()
                    };
                    let line = match moduli {
                        Ok(moduli) => format!("{head},solved,,{counts}{}", own(moduli)),
                        Err(fault) => {
                            format!("{head},{},{},{counts}{empty}", name(*fault), quoted(&fault.to_string()))
                        }
                    };
                    text.push_str(&(line + "\n"));
                }
            }
        }
    }
    text
}

/// Why there are no moduli, as in files.
fn name(fault: Loose) -> &'static str {
    match fault {
        Loose::NotPeriodic => "not_periodic",
        Loose::NoJoints => "no_joints",
        Loose::ComesApart => "comes_apart",
    }
}

/// A line per cell, method and direction: what was found there, and the normal of the surface.
pub(crate) fn surface_csv(study: &Study, asked: &AskedOfCells, rows: &[CellRow]) -> String {
    let stresses = ["n11", "n22", "n12", "m11", "m22", "m12"];
    let columns = |of: &str| stresses.map(|stress| format!("{of}_{stress}")).join(",");
    let mut text = format!(
        "arm,stones_along,courses,cell,method,{},outcome,value,{}\n",
        columns("direction"),
        columns("normal")
    );
    let numbers = |six: &[f64; 6]| six.map(|x| x.to_string()).join(",");
    for row in rows {
        let Ok(answer) = &row.found else { continue };
        for (method, points) in asked.of.methods.iter().zip(&answer.surfaces) {
            for point in points {
                let (outcome, value) = match &point.found {
                    Found::Borne(value) => ("borne", value.to_string()),
                    Found::AtLeast(value) => ("at_least", value.to_string()),
                    Found::Unbounded => ("unbounded", String::new()),
                    Found::FallsAtRest => ("falls_at_rest", "0".to_owned()),
                    Found::NotConverged(_) => ("not_converged", String::new()),
                };
                text.push_str(&format!(
                    "{},{},{},{outcome},{value},{}\n",
                    head(study, asked, row),
                    method.name(),
                    numbers(&point.direction),
                    numbers(&point.normal)
                ));
            }
        }
    }
    text
}

/// How it ended, in files: outcome, load, reason.
fn ended(judged: &Judged) -> (&'static str, String, String) {
    match judged {
        Judged::Falls(load) => ("falls", load.to_string(), String::new()),
        Judged::BearsAny => ("bears_any", String::new(), String::new()),
        Judged::FallsAtRest => ("falls_at_rest", "0".to_owned(), String::new()),
        Judged::OutOfRange(why) => ("out_of_range", String::new(), quoted(&why.to_string())),
        Judged::NotSolved(why) => ("not_solved", String::new(), quoted(why)),
        Judged::Invalid(why) => ("invalid_geometry", String::new(), quoted(why)),
    }
}

/// What a row is of, in files: arm, plate or stones, number.
fn head_of_wall(study: &Study, row: &WallRow) -> String {
    let (subject, number) = match row.task.subject {
        Subject::Plate(cell) => ("plate", cell),
        Subject::Stones(member) => ("stones", member),
    };
    format!("{},{subject},{number}", quoted(&study.arms[row.task.arm as usize].name))
}

/// A line per plate, and one or two per wall.
pub(crate) fn walls_csv(study: &Study, rows: &[WallRow]) -> String {
    let mut text = "arm,subject,number,method,outcome,load,shear_ratio,reason\n".to_owned();
    for row in rows {
        let by_method =
            [("associative", Some(&row.found)), ("non-associative", row.non_associative.as_ref())];
        for (method, judged) in by_method.into_iter().filter_map(|(method, judged)| Some((method, judged?))) {
            let (outcome, load, reason) = ended(judged);
            let shear = row.validity.map_or_else(String::new, |own| own.shear_ratio.to_string());
            let head = head_of_wall(study, row);
            text.push_str(&format!("{head},{method},{outcome},{load},{shear},{reason}\n"));
        }
    }
    text
}

/// How long each took, which differs from run to run.
pub(crate) fn timing_csv(study: &Study, rows: &[WallRow]) -> String {
    let mut text = "arm,subject,number,seconds,seconds_non_associative\n".to_owned();
    for row in rows {
        let [first, second] = row.seconds;
        text.push_str(&format!("{},{first:.6},{second:.6}\n", head_of_wall(study, row)));
    }
    text
}
