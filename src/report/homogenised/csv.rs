//! The tables of masonry seen as a plate: a line per cell, and a line per cell and point of its surface.

use crate::ensemble::{AskedOfCells, CellRow};
use crate::homogenise::{Border, Found, Loose, Moduli};
use crate::report::csv::quoted;
use crate::report::homogenised::entry::named;
use crate::study::Study;

/// The cell that a row is of.
fn head(study: &Study, asked: &AskedOfCells, row: &CellRow) -> String {
    let [along, courses] = asked.sizes[row.task.size];
    format!("{},{along},{courses},{}", quoted(&study.arms[row.task.arm as usize].name), row.task.cell)
}

/// A line per cell: how it ended, and its moduli by border.
pub(super) fn cells_csv(study: &Study, asked: &AskedOfCells, rows: &[CellRow]) -> String {
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
pub(super) fn surface_csv(study: &Study, asked: &AskedOfCells, rows: &[CellRow]) -> String {
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
