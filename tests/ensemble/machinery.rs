//! The machinery of a run, with an evaluation that needs no solver.

use std::fs;
use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};

use pirca::ensemble::{
    Built, MemberFault, Reading, Row, RunError, Settings, Silent, StepRow, Task, TopStep, is_random, plan,
    run_with,
};
use pirca::model::{Level, Outcome};
use pirca::random::{Family, Streams};
use pirca::study::Study;
use polars::prelude::DataFrame;
use polars_io::prelude::{ParquetReader, SerReader};

use crate::fixture::{Folder, STUDY};

const FILES: [&str; 3] = ["members.parquet", "steps.parquet", "manifest.json"];
const JOURNAL: &str = "journal.jsonl";
/// One wall and eight, at two points.
const EVALUATIONS: usize = 2 + 2 * 8;

/// A folder to write into.
pub fn new_folder() -> Folder {
    Folder::with_study(STUDY)
}

/// The study of the fixture; its walls are never built here.
pub fn study() -> Study {
    let folder = new_folder();
    Study::load(&folder.path("studies/tiny"), None).unwrap().study
}

/// Numbers that are a pure function of the task, with awkward bits; every fourth member of the random arm collapses.
pub fn made_up(study: &Study, task: Task) -> Row {
    let Task { arm, point, member } = task;
    let kn = study.arms[arm as usize].kn_points[point as usize];
    let mut stream = Streams::new(study.seed, member).of("made up");
    let top = stream.uniform() / 3.0 / kn;
    let collapsed = arm == 1 && member % 4 == 3;
    let step = |load_factor, share| StepRow {
        load_factor: Some(load_factor),
        top: TopStep {
            top_displacement_m: Some(top * share),
            left_m: Some(0.0),
            right_m: Some(top),
            ..TopStep::default()
        },
        unbalanced_ratio: (!collapsed).then_some(1e-5 / (3.0 + member as f64)),
        solver_steps: 100 + member,
        ..StepRow::default()
    };
    Row {
        arm_index: arm,
        arm: study.arms[arm as usize].name.clone(),
        point,
        kn_pa_per_m: kn,
        member,
        outcome: if collapsed {
            Outcome::Collapsed { at: Level::Factor(1.0 / 3.0) }
        } else {
            Outcome::Equilibrium
        },
        reading: Reading { top_displacement_m: (!collapsed).then_some(top), ..Reading::default() },
        built: Built {
            stones: 25,
            joints: 60,
            attempts: 1,
            redraws: member as u32,
            dip_sd_deg: Some(stream.uniform()),
            length_mean_m: Some(0.1 + 0.2),
            height_mean_m: Some(0.2),
            weight_n: Some(-0.0),
            ..Built::default()
        },
        solver_steps: 200 + 2 * member,
        unbalanced_ratio: Some(1e-5),
        load_steps: vec![step(0.0, 0.0), step(1.0, 1.0)],
        ..Row::default()
    }
}

fn settings(out: &Path, threads: usize) -> Settings {
    Settings { out: out.to_path_buf(), threads: threads.try_into().ok() }
}

fn run_in(out: &Path) -> Result<Vec<Row>, RunError> {
    run_with(&study(), &settings(out, 2), &Silent, &made_up)
}

fn bytes(folder: &Path) -> Vec<Vec<u8>> {
    FILES.iter().map(|name| fs::read(folder.join(name)).unwrap()).collect()
}

#[test]
fn the_plan_is_ordered_by_arm_point_and_member() {
    let tasks = plan(&study());
    assert_eq!(tasks.len(), EVALUATIONS);
    assert!(tasks.is_sorted());
    assert_eq!(tasks[1], Task { arm: 0, point: 1, member: 0 });
    assert_eq!(tasks[17], Task { arm: 1, point: 1, member: 7 });
}

#[test]
fn files_have_the_same_bytes_for_any_number_of_threads() {
    let folder = new_folder();
    let of = |threads: usize| {
        let out = folder.path(format!("{threads}"));
        let rows = run_with(&study(), &settings(&out, threads), &Silent, &made_up).unwrap();
        assert_eq!(rows, plan(&study()).into_iter().map(|task| made_up(&study(), task)).collect::<Vec<_>>());
        bytes(&out)
    };
    let one = of(1);
    assert!(one[0].starts_with(b"PAR1") && one[1].starts_with(b"PAR1"), "both tables are Parquet");
    assert_eq!(one, of(2));
    assert_eq!(one, of(7));
}

/// A kill leaves some beginning of the journal: whichever it is, the run ends with the same files.
#[test]
fn a_journal_cut_at_any_byte_is_resumed_to_the_same_bytes() {
    let folder = new_folder();
    let whole = folder.path("whole");
    run_in(&whole).unwrap();
    let wanted = bytes(&whole);
    let journal = fs::read(whole.join(JOURNAL)).unwrap();
    let ends: Vec<usize> = (0..journal.len()).filter(|&i| journal[i] == b'\n').map(|i| i + 1).collect();
    assert_eq!(ends.len(), 1 + EVALUATIONS, "a head and a line per member");
    let (head, first, last) = (ends[0], ends[1], ends[ends.len() - 1]);
    let cuts =
        [0, 1, 9, 20, head - 1, head, head + 1, head + 30, first - 1, first, first + 500, last - 1, last];
    let study = study();
    for cut in cuts {
        let out = folder.path(format!("cut-{cut}"));
        fs::create_dir(&out).unwrap();
        fs::write(out.join(JOURNAL), &journal[..cut]).unwrap();
        let evaluated = AtomicUsize::new(0);
        let counted = |study: &Study, task: Task| {
            evaluated.fetch_add(1, Ordering::Relaxed);
            made_up(study, task)
        };
        run_with(&study, &settings(&out, 2), &Silent, &counted).unwrap();
        assert_eq!(bytes(&out), wanted, "journal cut at byte {cut}");
        let kept = ends.iter().filter(|&&end| end <= cut).count().saturating_sub(1);
        assert_eq!(
            evaluated.into_inner(),
            EVALUATIONS - kept,
            "members in whole lines are not evaluated again (cut {cut})"
        );
        let nothing = |_: &Study, task: Task| -> Row { panic!("{task:?} was recorded (cut {cut})") };
        run_with(&study, &settings(&out, 1), &Silent, &nothing).unwrap();
        assert_eq!(bytes(&out), wanted, "resumed once more after the cut at byte {cut}");
    }
}

/// What a reader of the tables gets is the rows, bit by bit; what a member does not have is null.
#[test]
fn the_tables_hold_the_rows() {
    let folder = new_folder();
    let rows = run_in(&folder.path("out")).unwrap();
    let read = |name: &str| {
        ParquetReader::new(fs::File::open(folder.path("out").join(name)).unwrap()).finish().unwrap()
    };
    let real = |table: &DataFrame, name: &str| -> Vec<Option<u64>> {
        table.column(name).unwrap().f64().unwrap().iter().map(|x| x.map(f64::to_bits)).collect()
    };
    let bits = |x: Option<f64>| x.map(f64::to_bits);
    let members = read("members.parquet");
    assert_eq!(
        real(&members, "top_displacement_m"),
        rows.iter().map(|r| bits(r.top_displacement_m())).collect::<Vec<_>>()
    );
    assert_eq!(real(&members, "weight_n"), rows.iter().map(|r| bits(r.built.weight_n)).collect::<Vec<_>>());
    let outcome = members.column("outcome").unwrap().str().unwrap();
    assert!(outcome.iter().eq(rows.iter().map(|r| Some(r.outcome.name()))));
    assert_eq!(
        outcome.iter().filter(|name| *name == Some("collapsed")).count(),
        2 * 2,
        "members 3 and 7 at two points"
    );
    let steps = read("steps.parquet");
    let flat: Vec<&StepRow> = rows.iter().flat_map(|r| &r.load_steps).collect();
    assert_eq!(steps.height(), 2 * rows.len());
    assert_eq!(
        real(&steps, "top_displacement_m"),
        flat.iter().map(|s| bits(s.top.top_displacement_m)).collect::<Vec<_>>()
    );
    assert_eq!(
        real(&steps, "unbalanced_ratio"),
        flat.iter().map(|s| bits(s.unbalanced_ratio)).collect::<Vec<_>>()
    );
}

#[test]
fn a_damaged_line_is_evaluated_again() {
    let folder = new_folder();
    run_in(&folder.path("out")).unwrap();
    let wanted = bytes(&folder.path("out"));
    let path = folder.path("out").join(JOURNAL);
    let text = fs::read_to_string(&path).unwrap();
    // Still JSON, still a number of stones; only the check can tell.
    let damaged = text.replacen("\"stones\":25", "\"stones\":26", 3);
    assert_ne!(text, damaged);
    fs::write(&path, damaged).unwrap();
    let evaluated = AtomicUsize::new(0);
    let counted = |study: &Study, task: Task| {
        evaluated.fetch_add(1, Ordering::Relaxed);
        made_up(study, task)
    };
    run_with(&study(), &settings(&folder.path("out"), 1), &Silent, &counted).unwrap();
    assert_eq!(evaluated.into_inner(), 3);
    assert_eq!(bytes(&folder.path("out")), wanted);
}

#[test]
fn another_study_in_the_same_folder_is_refused_and_changes_nothing() {
    let folder = new_folder();
    run_in(&folder.path("out")).unwrap();
    let before = (bytes(&folder.path("out")), fs::read(folder.path("out").join(JOURNAL)).unwrap());
    let other = study().with_seed(8);
    let refused =
        run_with(&other, &settings(&folder.path("out"), 1), &Silent, &made_up).unwrap_err().to_string();
    assert!(refused.contains("study.seed: 7 recorded, 8 asked for"), "{refused}");
    assert!(refused.contains("--out") && refused.contains("remove"), "{refused}");
    let mut revised = study();
    revised.effective.insert("revision of laws and solvers".to_string(), "another".to_string());
    let refused = run_with(&revised, &settings(&folder.path("out"), 1), &Silent, &made_up).unwrap_err();
    assert!(matches!(refused, RunError::OtherRun { .. }), "{refused}");
    assert_eq!((bytes(&folder.path("out")), fs::read(folder.path("out").join(JOURNAL)).unwrap()), before);
}

#[test]
fn files_that_are_not_ours_are_not_overwritten() {
    let folder = new_folder();
    for (name, text) in
        [("members.parquet", "somebody's table"), (JOURNAL, "somebody's diary\n"), (JOURNAL, "no end")]
    {
        let out = folder.path(text);
        fs::create_dir(&out).unwrap();
        fs::write(out.join(name), text).unwrap();
        let refused = run_in(&out).unwrap_err();
        assert!(matches!(refused, RunError::NotOurs { .. }), "{refused}");
        assert_eq!(fs::read_to_string(out.join(name)).unwrap(), text);
    }
}

#[test]
fn a_member_that_panics_is_named_and_the_others_are_recorded() {
    let folder = new_folder();
    let broken = |study: &Study, task: Task| {
        assert!(task != (Task { arm: 1, point: 1, member: 4 }), "five stones are missing");
        made_up(study, task)
    };
    let error = run_with(&study(), &settings(&folder.path("out"), 2), &Silent, &broken).unwrap_err();
    let RunError::Broken { faults } = &error else { panic!("{error}") };
    let task = Task { arm: 1, point: 1, member: 4 };
    let message = "five stones are missing".to_string();
    assert_eq!(faults, &[MemberFault { task, arm: "random".to_string(), kn_pa_per_m: 1.75e8, message }]);
    let lines = fs::read_to_string(folder.path("out").join(JOURNAL)).unwrap().lines().count();
    assert_eq!(lines, EVALUATIONS, "all other members are in the journal");
    run_in(&folder.path("out")).unwrap();
    let whole = new_folder();
    run_in(&whole.path("out")).unwrap();
    assert_eq!(bytes(&folder.path("out")), bytes(&whole.path("out")));
}

/// However a wall ended, its row goes into the journal and comes back from it: the first run evaluates it, the second one reads it.
#[test]
fn every_way_to_end_is_recorded_and_read_again() {
    let at = Level::Tilt(0.1 + 0.2);
    let ways = [
        Outcome::Equilibrium,
        Outcome::Collapsed { at },
        Outcome::UnstableAtRest,
        Outcome::Unbounded,
        Outcome::NotConverged { at, unbalanced_ratio: 1.0 / 3.0, why: "lost".to_owned() },
        Outcome::NonFinite { at },
        Outcome::InvalidGeometry { reason: "a sliver".to_owned() },
    ];
    let ended = |study: &Study, task: Task| {
        let outcome = ways[(task.arm as usize + task.member as usize) % ways.len()].clone();
        Row { outcome, ..made_up(study, task) }
    };
    let folder = new_folder();
    let once = settings(&folder.path("out"), 1);
    let rows = run_with(&study(), &once, &Silent, &ended).unwrap();
    assert!(ways.iter().all(|way| rows.iter().any(|row| row.outcome == *way)));
    let never = |_: &Study, task: Task| -> Row { panic!("evaluated again: {task:?}") };
    assert_eq!(run_with(&study(), &once, &Silent, &never).unwrap(), rows);
}

#[test]
fn a_row_that_json_cannot_hold_is_a_fault_of_its_member() {
    let folder = new_folder();
    let not_a_number = |study: &Study, task: Task| {
        let row = made_up(study, task);
        Row { built: Built { weight_n: Some(f64::NAN), ..row.built }, ..row }
    };
    let error = run_with(&study(), &settings(&folder.path("out"), 1), &Silent, &not_a_number).unwrap_err();
    assert!(matches!(&error, RunError::Broken { faults } if faults.len() == EVALUATIONS), "{error}");
}

#[test]
fn a_full_disk_is_told_and_stops_the_run() {
    let folder = new_folder();
    fs::create_dir(folder.path("out")).unwrap();
    std::os::unix::fs::symlink("/dev/full", folder.path("out").join(JOURNAL)).unwrap();
    let error = run_in(&folder.path("out")).unwrap_err();
    let RunError::File { action: "write", path, source } = &error else { panic!("{error}") };
    assert!(path.ends_with(JOURNAL));
    assert_eq!(source.kind(), std::io::ErrorKind::StorageFull);
    assert!(!folder.path("out/members.parquet").exists());
}

#[test]
fn a_folder_that_cannot_be_made_is_told() {
    let folder = new_folder();
    let file = folder.path("file");
    fs::write(&file, "a file").unwrap();
    let error = run_in(&file.join("below")).unwrap_err();
    assert!(matches!(&error, RunError::File { action: "create the folder", .. }), "{error}");
}

#[test]
fn a_second_run_in_the_same_folder_is_refused_while_the_first_goes_on() {
    let folder = new_folder();
    let second = |study: &Study, task: Task| {
        let refused = run_in(&folder.path("out")).unwrap_err();
        assert!(matches!(refused, RunError::Busy { .. }), "{refused}");
        made_up(study, task)
    };
    run_with(&study(), &settings(&folder.path("out"), 1), &Silent, &second).unwrap();
}

#[test]
fn timing_stands_beside_the_results_with_a_line_per_member() {
    let folder = new_folder();
    run_with(&study(), &settings(&folder.path("out"), 2), &Silent, &made_up).unwrap();
    let text = fs::read_to_string(folder.path("out/timing.csv")).unwrap();
    let lines: Vec<_> = text.lines().collect();
    assert_eq!(lines[0], "arm,point,member,seconds,threads,host,processor");
    assert_eq!(lines.len(), 1 + EVALUATIONS);
    assert!(lines[18].starts_with("random,1,7,"), "{}", lines[18]);
    assert_eq!(lines[18].split(',').nth(4), Some("2"));
}

#[test]
fn an_arm_is_random_when_stones_or_joints_are_drawn_or_a_mechanism_draws() {
    let study = study();
    let random = |arm| is_random(&study.arms[arm]);
    assert!(!random(0) && random(1));
    let mut arm = study.arms[0].clone();
    arm.joint.phi_deg = Family::Uniform { low: 25.0, high: 35.0 };
    assert!(is_random(&arm));
    // A mechanism that draws makes regular stones differ from wall to wall; one that does not leaves them alike.
    let mut arm = study.arms[0].clone();
    arm.mechanisms = arm.mechanisms.with("density", &[1.1]);
    assert!(!is_random(&arm));
    arm.mechanisms = arm.mechanisms.with("specimen_scatter", &[0.2, 0.0]);
    assert!(is_random(&arm));
}
