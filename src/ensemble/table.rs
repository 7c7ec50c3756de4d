//! Rows as tables: `members.parquet`, `steps.parquet` and `timing.csv`. The bytes depend on the rows alone.

use std::collections::BTreeSet;

use polars::prelude::{Column, DataFrame, NamedFrom, Series};
use polars_io::prelude::ParquetWriter;

use crate::ensemble::journal::Entry;
use crate::ensemble::{Row, RunError, StepRow};

/// One row per member, in the order given; a value that a member does not have is null.
pub(crate) fn members(rows: &[Row]) -> Result<Vec<u8>, RunError> {
    let text = |name: &str, of: fn(&Row) -> Option<String>| {
        Column::from(Series::new(name.into(), rows.iter().map(of).collect::<Vec<_>>()))
    };
    let count = |name: &str, of: fn(&Row) -> u64| {
        Column::from(Series::new(name.into(), rows.iter().map(of).collect::<Vec<_>>()))
    };
    let real = |name: &str, of: fn(&Row) -> Option<f64>| {
        Column::from(Series::new(name.into(), rows.iter().map(of).collect::<Vec<_>>()))
    };
    let mut columns = vec![
        text("arm", |r| Some(r.arm.clone())),
        count("point", |r| r.point.into()),
        real("kn_pa_per_m", |r| Some(r.kn_pa_per_m)),
        count("member", |r| r.member),
        text("outcome", |r| Some(r.outcome.name().to_string())),
        text("reason", |r| Some(r.outcome.reason()).filter(|reason| !reason.is_empty())),
        real("top_displacement_m", |r| r.top_displacement_m),
        real("collapse_angle_deg", |r| r.collapse_angle_deg),
        real("fails_at_deg", |r| r.fails_at_deg),
        real("first_stone_deg", |r| r.first_stone_deg),
        real("part_deg", |r| r.part_deg),
        real("most_deg", |r| r.most_deg),
        real("largest_tilt_deg", |r| r.largest_tilt_deg),
        real("limit_angle_deg", |r| r.limit.and_then(|l| l.angle_deg)),
        real("limit_angle_non_associative_deg", |r| r.limit.and_then(|l| l.non_associative_angle_deg)),
        real("limit_multiplier", |r| r.limit.and_then(|l| l.multiplier)),
        real("limit_multiplier_non_associative", |r| r.limit.and_then(|l| l.non_associative_multiplier)),
        text("agreement", |r| r.limit.map(|l| l.agreement.name().to_string())),
        real("capacity_over_limit", |r| r.limit.and_then(|l| l.ratio)),
        text("failure_mode", |r| r.mechanism.map(|m| m.mode.name().to_string())),
        real("moving_stones", |r| r.mechanism.map(|m| m.moving.into())),
        real("moving_weight_share", |r| r.mechanism.map(|m| m.weight_share)),
        real("moving_length_share", |r| r.mechanism.map(|m| m.length_share)),
        real("moving_place", |r| r.mechanism.map(|m| m.place)),
        real("hinge_height_m", |r| r.mechanism.map(|m| m.hinge_height_m)),
        real("turning_share", |r| r.mechanism.map(|m| m.turning_share)),
        count("stones", |r| r.stones.into()),
        count("joints", |r| r.joints.into()),
        count("wedges", |r| r.wedges.into()),
        count("headers", |r| r.headers.into()),
        count("attempts", |r| r.attempts.into()),
        count("redraws", |r| r.redraws.into()),
        count("merges", |r| r.merges.into()),
        real("dip_mean_deg", |r| r.dip_mean_deg),
        real("dip_sd_deg", |r| r.dip_sd_deg),
        real("first_dip_sd_deg", |r| r.first_dip_sd_deg),
        real("length_mean_m", |r| r.length_mean_m),
        real("height_mean_m", |r| r.height_mean_m),
        real("weight_n", |r| r.weight_n),
        count("solver_steps", |r| r.solver_steps),
        real("unbalanced_ratio", |r| r.unbalanced_ratio),
    ];
    if rows.iter().any(|row| row.shear.is_some()) {
        columns.extend([
            real("capacity_n", |r| r.shear.and_then(|s| s.capacity_n)),
            real("drift_at_capacity_percent", |r| r.shear.and_then(|s| s.drift_at_capacity_percent)),
            real("plateau_n", |r| r.shear.and_then(|s| s.plateau_n)),
            real("stiffness_n_per_m", |r| r.shear.and_then(|s| s.stiffness_n_per_m)),
            text("shear_mode", |r| r.shear.and_then(|s| s.mode).map(|mode| mode.name().to_string())),
            real("opening_m", |r| r.shear.and_then(|s| s.opening_m)),
        ]);
    }
    let drawn: BTreeSet<&str> = rows.iter().flat_map(|row| row.drawn.keys().map(String::as_str)).collect();
    for key in drawn {
        let values: Vec<Option<f64>> = rows.iter().map(|row| row.drawn.get(key).copied()).collect();
        columns.push(Column::from(Series::new(format!("drawn {key}").into(), values)));
    }
    parquet("members.parquet", rows.len(), columns)
}

/// One row per load step of every member, in the order given.
pub(crate) fn steps(rows: &[Row]) -> Result<Vec<u8>, RunError> {
    let flat: Vec<(&Row, u64, &StepRow)> = rows
        .iter()
        .flat_map(|row| row.load_steps.iter().zip(0u64..).map(move |(step, index)| (row, index, step)))
        .collect();
    let arms: Vec<&str> = flat.iter().map(|(row, ..)| row.arm.as_str()).collect();
    let count = |name: &str, of: fn(&(&Row, u64, &StepRow)) -> u64| {
        Column::from(Series::new(name.into(), flat.iter().map(of).collect::<Vec<_>>()))
    };
    let real = |name: &str, of: fn(&(&Row, u64, &StepRow)) -> Option<f64>| {
        Column::from(Series::new(name.into(), flat.iter().map(of).collect::<Vec<_>>()))
    };
    let mut columns = vec![
        Column::from(Series::new("arm".into(), arms)),
        count("point", |(row, ..)| row.point.into()),
        real("kn_pa_per_m", |(row, ..)| Some(row.kn_pa_per_m)),
        count("member", |(row, ..)| row.member),
        count("load_step", |(_, index, _)| *index),
        real("load_factor", |(.., step)| step.load_factor),
        real("tilt_deg", |(.., step)| step.tilt_deg),
        real("top_displacement_m", |(.., step)| step.top_displacement_m),
        real("left_m", |(.., step)| step.left_m),
        real("centre_m", |(.., step)| step.centre_m),
        real("right_m", |(.., step)| step.right_m),
        real("left_remainder_m", |(.., step)| step.left_remainder_m),
        real("centre_remainder_m", |(.., step)| step.centre_remainder_m),
        real("right_remainder_m", |(.., step)| step.right_remainder_m),
        real("unbalanced_ratio", |(.., step)| step.unbalanced_ratio),
        count("solver_steps", |(.., step)| step.solver_steps),
    ];
    if flat.iter().any(|(.., step)| step.force_n.is_some()) {
        columns.extend([
            real("drift_percent", |(.., step)| step.drift_percent),
            real("force_n", |(.., step)| step.force_n),
        ]);
    }
    parquet("steps.parquet", flat.len(), columns)
}

/// Encodes sequentially, so that no thread count enters.
pub(crate) fn parquet(table: &'static str, height: usize, columns: Vec<Column>) -> Result<Vec<u8>, RunError> {
    let mut bytes = Vec::new();
    DataFrame::new(height, columns)
        .and_then(|mut frame| ParquetWriter::new(&mut bytes).set_parallel(false).finish(&mut frame))
        .map_err(|error| RunError::Table { table, reason: error.to_string() })?;
    Ok(bytes)
}

/// What each member took, on which machine: kept apart from the results, which must not depend on it.
pub(crate) fn timing(entries: &[Entry]) -> String {
    let mut text = String::from("arm,point,member,seconds,threads,host\n");
    for Entry { seconds, threads, host, row, .. } in entries {
        let line =
            format!("{},{},{},{seconds:.6},{threads},{host}\n", quoted(&row.arm), row.point, row.member);
        text.push_str(&line);
    }
    text
}

/// A CSV field: quoted when it holds what would end it.
fn quoted(field: &str) -> String {
    match field.contains([',', '"', '\n']) {
        true => format!("\"{}\"", field.replace('"', "\"\"")),
        false => field.to_string(),
    }
}
