//! The machinery of a run, with an evaluation that needs no solver.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};

use polars::prelude::DataFrame;
use polars_io::prelude::{ParquetReader, SerReader};

use crate::ensemble::journal::JOURNAL;
use crate::ensemble::{MemberFault, Row, RunError, Settings, Silent, StepRow, Task, plan, run_with};
use crate::generate::{Arrangement, BatteredFace, Layout, Limits, Outline, Wythes};
use crate::law::{CohesionAfterSlip, Sampling};
use crate::model::Outcome;
use crate::protocol::{Ends, Lateral, Protocol};
use crate::random::{Family, Streams};
use crate::solve::{Solver, explicit};
use crate::study::{Arm, Joint, NormalLawName, Study};

const FILES: [&str; 3] = ["members.parquet", "steps.parquet", "manifest.json"];

/// A folder of its own that is removed at the end of the test.
struct Folder(PathBuf);

impl Folder {
    fn new() -> Self {
        static COUNT: AtomicUsize = AtomicUsize::new(0);
        let number = COUNT.fetch_add(1, Ordering::Relaxed);
        let path = std::env::temp_dir().join(format!("pirca-ensemble-{}-{number}", std::process::id()));
        fs::create_dir_all(&path).unwrap();
        Folder(path)
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

/// Two arms, two points; the wall itself is never built here.
fn study() -> Study {
    let arm = |name: &str, members, arrangement| Arm {
        name: name.to_string(),
        members,
        layout: Layout {
            outline: Outline {
                length: 2.0,
                height: 1.0,
                base_thickness: 0.4,
                top_thickness: 0.3,
                battered_face: BatteredFace::Both,
            },
            arrangement,
            density: Family::Constant { value: 2400.0 },
            wythes: Wythes { count: 1, header_share: 0.0 },
            head_joint_gap: 0.0,
            wedges: None,
            limits: Limits {
                min_size: 0.02,
                max_aspect: 40.0,
                min_volume: 1e-6,
                max_redraws: 10,
                max_attempts: 2,
            },
        },
    };
    let sure = |value| Family::Constant { value };
    let coursed = Arrangement::Coursed {
        length: Family::Uniform { low: 0.2, high: 0.4 },
        height: sure(0.2),
        wall_size_factor: sure(1.0),
        dip: sure(0.0),
        least_overlap: 0.2,
    };
    let stack = Arrangement::Continuous { length: 0.4, height: 0.2 };
    Study {
        name: "tiny".to_string(),
        question: "Does the machinery hold?".to_string(),
        seed: 7,
        variant: None,
        arms: vec![arm("stack", 1, stack), arm("random", 9, coursed)],
        joint: Joint {
            kn_factor: sure(1.0),
            kn_over_ks: 2.0,
            phi_deg: sure(30.0),
            cohesion: sure(0.0),
            tension: 0.0,
            cohesion_after_slip: CohesionAfterSlip::Kept,
            normal_law: NormalLawName::Linear,
            sampling: Sampling::Area,
        },
        kn_points: vec![2.5e7, 1.75e8],
        protocol: Protocol::Lateral(Lateral {
            mean_pressure: 1e3,
            base_over_top: 2.0,
            steps: 2,
            collapse_share: 0.5,
        }),
        ends: Ends::Free,
        sub_contacts: [2, 2],
        solver: Solver::Explicit(explicit::Settings::default()),
        published: Vec::new(),
        inputs: Vec::new(),
        effective: BTreeMap::from([("study.seed".to_string(), "7".to_string())]),
        hash: "a".repeat(64),
    }
}

/// Numbers that are a pure function of the task, with awkward bits; every fourth member of the random arm collapses.
fn made_up(study: &Study, task: Task) -> Row {
    let Task { arm, point, member } = task;
    let kn = study.kn_points[point as usize];
    let mut stream = Streams::new(study.seed, member).of("made up");
    let top = stream.uniform() / 3.0 / kn;
    let collapsed = arm == 1 && member % 4 == 3;
    let step = |load_factor, share| StepRow {
        load_factor,
        top_displacement_m: Some(top * share),
        unbalanced_ratio: (!collapsed).then_some(1e-5 * stream_free(member)),
        solver_steps: 100 + member,
    };
    Row {
        arm_index: arm,
        arm: study.arms[arm as usize].name.clone(),
        point,
        kn_pa_per_m: kn,
        member,
        outcome: if collapsed { Outcome::Collapsed { load_factor: 1.0 / 3.0 } } else { Outcome::Equilibrium },
        top_displacement_m: (!collapsed).then_some(top),
        stones: 25,
        joints: 60,
        wedges: 0,
        headers: 0,
        attempts: 1,
        redraws: member as u32,
        merges: 0,
        dip_mean_deg: None,
        dip_sd_deg: Some(stream.uniform()),
        first_dip_sd_deg: None,
        length_mean_m: Some(0.1 + 0.2),
        height_mean_m: Some(0.2),
        weight_n: Some(-0.0),
        solver_steps: 200 + 2 * member,
        unbalanced_ratio: Some(1e-5),
        load_steps: vec![step(0.0, 0.0), step(1.0, 1.0)],
    }
}

fn stream_free(member: u64) -> f64 {
    1.0 / (3.0 + member as f64)
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
    assert_eq!(tasks.len(), 2 + 2 * 9, "one wall and nine walls, at two points");
    assert!(tasks.is_sorted());
    assert_eq!(tasks[1], Task { arm: 0, point: 1, member: 0 });
    assert_eq!(tasks[19], Task { arm: 1, point: 1, member: 8 });
}

#[test]
fn files_have_the_same_bytes_for_any_number_of_threads() {
    let folder = Folder::new();
    let of = |threads: usize| {
        let out = folder.0.join(format!("{threads}"));
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
    let folder = Folder::new();
    let whole = folder.0.join("whole");
    run_in(&whole).unwrap();
    let wanted = bytes(&whole);
    let journal = fs::read(whole.join(JOURNAL)).unwrap();
    let ends: Vec<usize> = (0..journal.len()).filter(|&i| journal[i] == b'\n').map(|i| i + 1).collect();
    assert_eq!(ends.len(), 1 + plan(&study()).len(), "a head and a line per member");
    let (head, first, last) = (ends[0], ends[1], ends[ends.len() - 1]);
    let cuts =
        [0, 1, 9, 20, head - 1, head, head + 1, head + 30, first - 1, first, first + 500, last - 1, last];
    for cut in cuts {
        let out = folder.0.join(format!("cut-{cut}"));
        fs::create_dir(&out).unwrap();
        fs::write(out.join(JOURNAL), &journal[..cut]).unwrap();
        let evaluated = AtomicUsize::new(0);
        let counted = |study: &Study, task: Task| {
            evaluated.fetch_add(1, Ordering::Relaxed);
            made_up(study, task)
        };
        run_with(&study(), &settings(&out, 2), &Silent, &counted).unwrap();
        assert_eq!(bytes(&out), wanted, "journal cut at byte {cut}");
        let kept = ends.iter().filter(|&&end| end <= cut).count().saturating_sub(1);
        assert_eq!(
            evaluated.into_inner(),
            20 - kept,
            "members in whole lines are not evaluated again (cut {cut})"
        );
    }
}

/// What a reader of the tables gets is the rows, bit by bit; what a member does not have is null.
#[test]
fn the_tables_hold_the_rows() {
    let folder = Folder::new();
    let rows = run_in(&folder.0).unwrap();
    let read =
        |name: &str| ParquetReader::new(fs::File::open(folder.0.join(name)).unwrap()).finish().unwrap();
    let real = |table: &DataFrame, name: &str| -> Vec<Option<u64>> {
        table.column(name).unwrap().f64().unwrap().iter().map(|x| x.map(f64::to_bits)).collect()
    };
    let bits = |x: Option<f64>| x.map(f64::to_bits);
    let members = read("members.parquet");
    assert_eq!(
        real(&members, "top_displacement_m"),
        rows.iter().map(|r| bits(r.top_displacement_m)).collect::<Vec<_>>()
    );
    assert_eq!(real(&members, "weight_n"), rows.iter().map(|r| bits(r.weight_n)).collect::<Vec<_>>());
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
        flat.iter().map(|s| bits(s.top_displacement_m)).collect::<Vec<_>>()
    );
    assert_eq!(
        real(&steps, "unbalanced_ratio"),
        flat.iter().map(|s| bits(s.unbalanced_ratio)).collect::<Vec<_>>()
    );
}

#[test]
fn a_damaged_line_is_evaluated_again() {
    let folder = Folder::new();
    run_in(&folder.0).unwrap();
    let wanted = bytes(&folder.0);
    let path = folder.0.join(JOURNAL);
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
    run_with(&study(), &settings(&folder.0, 1), &Silent, &counted).unwrap();
    assert_eq!(evaluated.into_inner(), 3);
    assert_eq!(bytes(&folder.0), wanted);
}

#[test]
fn another_study_in_the_same_folder_is_refused_and_changes_nothing() {
    let folder = Folder::new();
    run_in(&folder.0).unwrap();
    let before = (bytes(&folder.0), fs::read(folder.0.join(JOURNAL)).unwrap());
    let mut other = study();
    other.effective.insert("study.seed".to_string(), "8".to_string());
    other.seed = 8;
    other.hash = "b".repeat(64);
    let refused = run_with(&other, &settings(&folder.0, 1), &Silent, &made_up).unwrap_err().to_string();
    assert!(refused.contains("study.seed: 7 recorded, 8 asked for"), "{refused}");
    assert!(refused.contains("--out") && refused.contains("remove"), "{refused}");
    let mut hash_only = study();
    hash_only.hash = "b".repeat(64);
    let refused = run_with(&hash_only, &settings(&folder.0, 1), &Silent, &made_up).unwrap_err();
    assert!(matches!(refused, RunError::OtherRun { .. }), "{refused}");
    assert_eq!((bytes(&folder.0), fs::read(folder.0.join(JOURNAL)).unwrap()), before);
}

#[test]
fn files_that_are_not_ours_are_not_overwritten() {
    let folder = Folder::new();
    for (name, text) in
        [("members.parquet", "somebody's table"), (JOURNAL, "somebody's diary\n"), (JOURNAL, "no end")]
    {
        let out = folder.0.join(text);
        fs::create_dir(&out).unwrap();
        fs::write(out.join(name), text).unwrap();
        let refused = run_in(&out).unwrap_err();
        assert!(matches!(refused, RunError::NotOurs { .. }), "{refused}");
        assert_eq!(fs::read_to_string(out.join(name)).unwrap(), text);
    }
}

#[test]
fn a_member_that_panics_is_named_and_the_others_are_recorded() {
    let folder = Folder::new();
    let broken = |study: &Study, task: Task| {
        assert!(task != (Task { arm: 1, point: 1, member: 4 }), "five stones are missing");
        made_up(study, task)
    };
    let error = run_with(&study(), &settings(&folder.0, 2), &Silent, &broken).unwrap_err();
    let RunError::Broken { faults } = &error else { panic!("{error}") };
    let task = Task { arm: 1, point: 1, member: 4 };
    let message = "five stones are missing".to_string();
    assert_eq!(faults, &[MemberFault { task, arm: "random".to_string(), kn_pa_per_m: 1.75e8, message }]);
    let lines = fs::read_to_string(folder.0.join(JOURNAL)).unwrap().lines().count();
    assert_eq!(lines, 1 + 19, "all other members are in the journal");
    run_in(&folder.0).unwrap();
    let whole = Folder::new();
    run_in(&whole.0).unwrap();
    assert_eq!(bytes(&folder.0), bytes(&whole.0));
}

#[test]
fn a_row_that_json_cannot_hold_is_a_fault_of_its_member() {
    let folder = Folder::new();
    let not_a_number = |study: &Study, task: Task| Row { weight_n: Some(f64::NAN), ..made_up(study, task) };
    let error = run_with(&study(), &settings(&folder.0, 1), &Silent, &not_a_number).unwrap_err();
    assert!(matches!(&error, RunError::Broken { faults } if faults.len() == 20), "{error}");
}

#[cfg(unix)]
#[test]
fn a_full_disk_is_told_and_stops_the_run() {
    let folder = Folder::new();
    std::os::unix::fs::symlink("/dev/full", folder.0.join(JOURNAL)).unwrap();
    let error = run_in(&folder.0).unwrap_err();
    let RunError::File { action: "write", path, source } = &error else { panic!("{error}") };
    assert!(path.ends_with(JOURNAL));
    assert_eq!(source.kind(), std::io::ErrorKind::StorageFull);
    assert!(!folder.0.join("members.parquet").exists());
}

#[test]
fn a_folder_that_cannot_be_made_is_told() {
    let folder = Folder::new();
    let file = folder.0.join("file");
    fs::write(&file, "a file").unwrap();
    let error = run_in(&file.join("below")).unwrap_err();
    assert!(matches!(&error, RunError::File { action: "create the folder", .. }), "{error}");
}

#[test]
fn a_second_run_in_the_same_folder_is_refused_while_the_first_goes_on() {
    let folder = Folder::new();
    let second = |study: &Study, task: Task| {
        let refused = run_in(&folder.0).unwrap_err();
        assert!(matches!(refused, RunError::Busy { .. }), "{refused}");
        made_up(study, task)
    };
    run_with(&study(), &settings(&folder.0, 1), &Silent, &second).unwrap();
}

#[test]
fn timing_stands_beside_the_results_with_a_line_per_member() {
    let folder = Folder::new();
    run_with(&study(), &settings(&folder.0, 2), &Silent, &made_up).unwrap();
    let text = fs::read_to_string(folder.0.join("timing.csv")).unwrap();
    let lines: Vec<_> = text.lines().collect();
    assert_eq!(lines[0], "arm,point,member,seconds,threads,host");
    assert_eq!(lines.len(), 1 + 20);
    assert!(lines[20].starts_with("random,1,8,"), "{}", lines[20]);
    assert_eq!(lines[20].split(',').nth(4), Some("2"));
}

#[test]
fn an_arm_is_random_when_stones_or_joints_are_drawn() {
    let study = study();
    let random = |arm| super::is_random(&study.arms[arm], &study.joint);
    assert!(!random(0) && random(1));
    let joint = Joint { phi_deg: Family::Uniform { low: 25.0, high: 35.0 }, ..study.joint.clone() };
    assert!(super::is_random(&study.arms[0], &joint));
}
