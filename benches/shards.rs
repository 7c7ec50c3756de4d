//! What many walls cost in shards: bytes on the disk, and time and memory of putting them together. Rows are those of a real wall with other
//! numbers in the place of what was observed, so that they cost nothing to evaluate.
//!
//! `cargo bench --bench shards -- 1e5 1e6`: so many rows each; see `benches/README.md`. Two load steps each, as limit analysis has them: a row takes
//! some 2 kB of the disk meanwhile, and a load step 0.3 kB more.

use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use pirca::ensemble::shard::{Share, Walls, Work, compute};
use pirca::ensemble::{Row, Settings, Silent, Task, evaluate, evaluations};
use pirca::study::Study;

/// Rows of a shard.
const EACH: u64 = 100_000;
/// How often the memory of the merge is looked at.
const LOOK: Duration = Duration::from_millis(20);

fn main() {
    let asked: Vec<f64> = std::env::args().filter_map(|word| word.parse().ok()).collect();
    let sizes = if asked.is_empty() { vec![1e5] } else { asked };
    println!("rows      shards  shards MB  members MB  steps MB  merge s  merge peak MB");
    for rows in sizes {
        one(rows as u64);
    }
}

/// Rows, shards and merge of so many walls of the irregular arm.
fn one(rows: u64) {
    let place = Path::new(env!("CARGO_MANIFEST_DIR")).join("studies/arrangements");
    let study = Study::load(&place, None).and_then(|loaded| loaded.study.with_solver("limit"));
    let study = study.unwrap_or_else(|faults| panic!("{faults}"));
    let kinds: u64 =
        study.arms.iter().filter(|arm| arm.members > 1).map(|arm| arm.kn_points.len() as u64).sum();
    let study = study.with_members((rows / kinds).max(2));
    let rows = evaluations(&study);
    let templates: Vec<Vec<Row>> = (0u32..)
        .zip(&study.arms)
        .map(|(arm, own)| {
            let row = |point| evaluate(&study, Task { arm, point, member: 0 });
            (0..own.kn_points.len() as u32).map(row).collect()
        })
        .collect();
    let made_up = |_: &Study, task: Task| {
        let template = &templates[task.arm as usize][task.point as usize];
        let other =
            |value: Option<f64>, salt: u64| value.map(|value| value * (0.9 + 0.2 * noise(task.member, salt)));
        let mut row = Row { member: task.member, ..template.clone() };
        let tilting = &mut row.reading.tilting;
        tilting.collapse_angle_deg = other(tilting.collapse_angle_deg, 1);
        tilting.fails_at_deg = tilting.collapse_angle_deg.map(|angle| angle + 0.05);
        let built = &mut row.built;
        built.dip_mean_deg = other(built.dip_mean_deg, 2);
        built.length_mean_m = other(built.length_mean_m, 3);
        built.height_mean_m = other(built.height_mean_m, 4);
        built.weight_n = other(built.weight_n, 5);
        for (number, step) in (10..).zip(&mut row.load_steps) {
            step.top.top_displacement_m = other(step.top.top_displacement_m, number);
            step.top.centre_m = step.top.top_displacement_m;
        }
        row
    };
    let out = std::env::temp_dir().join(format!("pirca-shards-{}", std::process::id()));
    let of = rows.div_ceil(EACH) as u32;
    let work = Work::of(&study, &place, Walls::Own, of);
    let settings = Settings { out: out.clone(), threads: None };
    for index in 0..of {
        let done = compute(&study, &work, Share { index, of }, &settings, &Silent, &made_up);
        done.unwrap_or_else(|error| panic!("{error}"));
    }
    let begun = Instant::now();
    let merge =
        Command::new(env!("CARGO_BIN_EXE_pirca")).arg("merge").arg(&out).stdout(Stdio::null()).spawn();
    let mut merge = merge.expect("the program is built");
    let mut peak = 0;
    let status = loop {
        peak = peak.max(memory(merge.id()));
        match merge.try_wait().expect("it was started here") {
            Some(status) => break status,
            None => std::thread::sleep(LOOK),
        }
    };
    let seconds = begun.elapsed().as_secs_f64();
    assert!(status.success(), "{status}");
    let size = |name: &str| fs::metadata(out.join(name)).map_or(0, |file| file.len()) / 1_000_000;
    let shards: u64 = fs::read_dir(out.join("shards"))
        .expect("it was written")
        .filter_map(|entry| Some(entry.ok()?.metadata().ok()?.len()))
        .sum();
    println!(
        "{rows:<9} {of:<7} {:<10} {:<11} {:<9} {seconds:<8.1} {}",
        shards / 1_000_000,
        size("members.parquet"),
        size("steps.parquet"),
        peak / 1000
    );
    fs::remove_dir_all(&out).expect("it is the bench's own");
}

/// A number from 0 to 1 that looks random (the end of SplitMix64).
fn noise(member: u64, salt: u64) -> f64 {
    let mut z = member.wrapping_mul(0x9e37_79b9_7f4a_7c15).wrapping_add(salt << 32);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    (z ^ (z >> 31)) as f64 / u64::MAX as f64
}

/// The largest memory that a process has had (kB); 0 where nobody knows.
fn memory(process: u32) -> u64 {
    let status = fs::read_to_string(format!("/proc/{process}/status")).unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
    line.and_then(|line| line.trim().trim_end_matches(" kB").parse().ok()).unwrap_or(0)
}
