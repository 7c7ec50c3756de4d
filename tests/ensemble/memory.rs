//! How much memory the results of very many walls take while their rows come one by one.

use std::process::Command;
use std::{env, fs};

use pirca::ensemble::{AddedColumns, Reading, Row, Tables, Task, TiltingRow};
use pirca::model::{Level, Outcome};
use pirca::study::Study;
use pirca::verb::run::{Gathered, write_gathered};

use crate::fixture::{Folder, changed};
use crate::machinery::made_up;

/// Tells a process of this test how many walls to stream.
const WALLS: &str = "PIRCA_TEST_WALLS";
const NAME: &str = "memory::walls_that_come_one_by_one_take_eight_bytes_each";

/// The peak of memory is that of a process: each number of walls has one of its own.
#[test]
#[ignore = "slow: tables and statistics of six million walls, half a minute"]
fn walls_that_come_one_by_one_take_eight_bytes_each() {
    if let Ok(walls) = env::var(WALLS) {
        return stream(walls.parse().expect("a number"));
    }
    let [few, many] = [1_000_000, 5_000_000].map(|walls: u64| {
        let mut own = Command::new(env::current_exe().unwrap());
        let output = own.args(["--exact", NAME, "--ignored", "--nocapture"]).env(WALLS, walls.to_string());
        let output = output.output().unwrap();
        let said = String::from_utf8_lossy(&output.stdout).into_owned();
        let peak = said.split_once("peak ").and_then(|(_, rest)| rest.split_once(" kB")).expect("a peak").0;
        1e3 * peak.trim().parse::<f64>().expect("a number")
    });
    let each = (many - few) / 4e6;
    println!("{few:.2e} bytes for a million walls, {each:.1} more for each of four millions");
    // The value, what the ends of the tables say of each row group, and what the allocator leaves unused.
    assert!(each < 14.0, "{each} bytes per wall");
    assert!(few < 150e6, "{few} bytes");
}

/// Tables, summary and figures of walls that all fall at an angle of their own.
fn stream(walls: u64) {
    let tilting = "protocol = \"tilting\"\ntowards = \"y+\"\nstep_deg = 4\nbracket_deg = 0.5";
    let lateral = "protocol = \"lateral\"\nmean_pressure_pa = 200\nbase_over_top = 2";
    let study = changed(lateral, tilting)
        .replace("joint_springs", "free")
        .replace("unbalanced_ratio = 1e-4", "name = \"limit\"\nflow = \"non-associative\"");
    let folder = Folder::with_study(&study);
    let mut study =
        Study::load(&folder.path("studies/tiny"), None).unwrap_or_else(|faults| panic!("{faults}")).study;
    study.arms.retain(|arm| arm.members > 1);
    study.arms[0].kn_points.truncate(1);
    study.arms[0].members = walls;
    let out = folder.path("out");
    fs::create_dir_all(&out).unwrap();
    let mut tables = Tables::begin(&out, AddedColumns::default()).unwrap();
    let mut gathered = Gathered::new(&study);
    for member in 0..walls {
        let row = made_up(&study, Task { arm: 0, point: 0, member });
        let angle = 10.0 + 5.0 * row.built.dip_sd_deg.expect("a random number");
        let outcome = Outcome::Collapsed { at: Level::Tilt(angle) };
        let tilting = TiltingRow { collapse_angle_deg: Some(angle), ..row.reading.tilting };
        let row = Row { reading: Reading { tilting, ..row.reading }, outcome, ..row };
        tables.take(&row).unwrap();
        gathered.take(&row);
    }
    tables.end().unwrap();
    let summary = write_gathered(&study, gathered, &out, None).unwrap();
    assert_eq!((summary.arms[0].in_mean, summary.arms[0].fragility.len()), (walls, 10_000));
    println!("peak {} kB", peak());
}

/// The most memory that this process has had (kB).
fn peak() -> String {
    let status = fs::read_to_string("/proc/self/status").unwrap();
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:")).expect("Linux says it");
    line.trim_end_matches("kB").trim().to_owned()
}
