//! Tables that are written row by row: whole, in order, in groups of one size, or not at all.

use std::fs::{self, File};
use std::path::Path;

use pirca::ensemble::{AddedColumns, Row, ShearRow, Tables, Task};
use polars::prelude::DataFrame;
use polars_io::prelude::{ParquetReader, SerReader};

use crate::machinery::{made_up, new_folder, study};

/// Members of the random arm at its first stiffness, with two load steps each.
fn rows(count: u64) -> Vec<Row> {
    let study = study();
    (0..count).map(|member| made_up(&study, Task { arm: 1, point: 0, member })).collect()
}

/// A table, and the lines of each of its row groups.
fn read(path: &Path) -> (DataFrame, Vec<usize>) {
    let mut reader = ParquetReader::new(File::open(path).unwrap());
    let groups = reader.get_metadata().unwrap().row_groups.iter().map(|group| group.num_rows()).collect();
    (reader.finish().unwrap(), groups)
}

#[test]
fn many_walls_are_written_in_groups_of_one_size_and_in_their_order() {
    let (folder, rows) = (new_folder(), rows(140_000));
    let mut tables = Tables::begin(&folder.path(""), AddedColumns::of(&rows)).unwrap();
    rows.iter().for_each(|row| tables.take(row).unwrap());
    tables.end().unwrap();

    let (members, groups) = read(&folder.path("members.parquet"));
    assert_eq!(groups, [65_536, 65_536, 8_928]);
    let column = |name: &str| members.column(name).unwrap().f64().unwrap().iter().collect::<Vec<_>>();
    assert_eq!(
        column("top_displacement_m"),
        rows.iter().map(|row| row.top_displacement_m()).collect::<Vec<_>>()
    );
    assert_eq!(column("dip_sd_deg"), rows.iter().map(|row| row.built.dip_sd_deg).collect::<Vec<_>>());

    let (steps, groups) = read(&folder.path("steps.parquet"));
    assert_eq!(groups, [262_144, 17_856]);
    let column = |name: &str| steps.column(name).unwrap().u64().unwrap().iter().flatten().collect::<Vec<_>>();
    assert_eq!(column("member"), (0..280_000).map(|line| line / 2).collect::<Vec<_>>());
    assert_eq!(column("load_step"), (0..280_000).map(|line| line % 2).collect::<Vec<_>>());
}

#[test]
fn tables_that_are_dropped_leave_what_was_there_before() {
    let (folder, rows) = (new_folder(), rows(3));
    let before = |name: &str| folder.path(name);
    fs::write(before("members.parquet"), "of an earlier run").unwrap();
    let mut tables = Tables::begin(&folder.path(""), AddedColumns::of(&rows)).unwrap();
    rows.iter().for_each(|row| tables.take(row).unwrap());
    drop(tables);
    assert_eq!(fs::read_to_string(before("members.parquet")).unwrap(), "of an earlier run");
    for name in ["members.parquet.partial", "steps.parquet.partial", "steps.parquet", "members.schema.json"] {
        assert!(!before(name).exists(), "{name} was left");
    }
}

#[test]
fn columns_that_some_walls_need_are_the_same_however_the_walls_are_shared_out() {
    let mut rows = rows(4);
    rows[1].drawn.insert("joint.phi_deg".to_owned(), 31.5);
    rows[2].drawn.insert("block.density_kg_per_m3".to_owned(), 2.6e3);
    rows[2].reading.shear = Some(ShearRow { capacity_n: Some(1e3), ..ShearRow::default() });
    rows[3].load_steps[1].jack.force_n = Some(7.0);
    let all = AddedColumns::of(&rows);
    assert!(all.drawn.len() == 2 && all.has("sheared") && all.has("pushed"));
    let mut joined = AddedColumns::of([&rows[3], &rows[0]]);
    assert!(joined.drawn.is_empty() && joined.has("pushed") && !joined.has("sheared"));
    joined.join(&AddedColumns::of(&rows[1..3]));
    assert_eq!(joined, all);
    assert!(rows.iter().all(|row| all.hold(row)));
    let lacking = AddedColumns::of(&rows[..1]);
    assert_eq!(rows.iter().map(|row| lacking.hold(row)).collect::<Vec<_>>(), [true, false, false, false]);
}

#[test]
#[should_panic(expected = "no column for all of member 1")]
fn a_row_that_its_tables_have_no_column_for_is_our_own_fault() {
    let (folder, mut rows) = (new_folder(), rows(2));
    let mut tables = Tables::begin(&folder.path(""), AddedColumns::of(&rows)).unwrap();
    rows[1].drawn.insert("joint.phi_deg".to_owned(), 31.5);
    rows.iter().for_each(|row| tables.take(row).unwrap());
}
