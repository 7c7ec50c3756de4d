//! Tables beside a study as distributions: a column of one, and stones with length and height together.

use pirca::generate::{Arrangement, Sizes};
use pirca::random::Family;
use pirca::study::{Faults, Found, Study};

use crate::scratch::{STUDY, Scratch};

const SURVEY: &str = "studies/base/survey.csv";
const LENGTH: &str = "length_m = \"block/size:length\"";
const SIZES: &str =
    "length_m = \"block/size:length\"\nheight_m = { family = \"uniform\", low = 0.15, high = 0.25 }";
const COLUMN: &str = "length_m = { family = \"empirical\", values = \"survey.csv:length_m\" }";
const STONES: &str = "stone,length_m,height_m\na,0.32,0.15\nb,0.45,0.21\nc,0.28,0.12\nd,0.39,0.2\n";

/// A study with a survey beside it; in the arm `laid` a line or two are put in the place of others.
fn surveyed(name: &str, survey: &str, from: &str, to: &str) -> Scratch {
    let scratch = Scratch::new(name);
    scratch.write(SURVEY, survey.as_bytes());
    scratch.replace(STUDY, from, to);
    scratch
}

fn sound(scratch: &Scratch) -> Study {
    scratch.load(None).unwrap_or_else(|faults| panic!("{faults}")).study
}

fn faults(scratch: &Scratch) -> Faults {
    scratch.load(None).map(|loaded| loaded.study.hash).expect_err("it has a fault")
}

fn sizes(study: &Study) -> &Sizes {
    let Arrangement::Coursed { sizes, .. } = &study.arms[2].layout.arrangement else { panic!("courses") };
    sizes
}

#[test]
fn a_column_is_a_distribution_of_its_values() {
    let study = sound(&surveyed("survey-column", STONES, LENGTH, COLUMN));
    let Sizes::Apart { length, .. } = sizes(&study) else { panic!("lengths and heights apart") };
    assert_eq!(*length, Family::Empirical { values: vec![0.28, 0.32, 0.39, 0.45] });
    assert!(study.inputs.iter().any(|input| input.path.ends_with("survey.csv")), "{:?}", study.inputs);
    // As in the study itself, whatever the table is called and however it is written.
    let inline = "length_m = { family = \"empirical\", values = [0.45, 0.28, 0.32, 0.39] }";
    let inline = sound(&surveyed("survey-inline", STONES, LENGTH, inline));
    assert_eq!(sizes(&study), sizes(&inline));
    let spread = "\u{feff}Stone;Length (m)\r\n# a comment\r\na;0,32\r\nb;0,45\r\nc;0,28\r\nd;0,39\r\n";
    assert_eq!(sizes(&sound(&surveyed("survey-spreadsheet", spread, LENGTH, COLUMN))), sizes(&study));
}

#[test]
fn stones_keep_length_and_height_together() {
    let scratch = surveyed("survey-stones", STONES, SIZES, "stones = \"survey.csv\"");
    let study = sound(&scratch);
    let Sizes::Together { stones } = sizes(&study) else { panic!("stones") };
    assert_eq!(stones.rows(), [[0.28, 0.12], [0.32, 0.15], [0.39, 0.2], [0.45, 0.21]]);
    // The variant cuts walls of the same stones.
    let cut = scratch.load(Some("laid-cut")).unwrap_or_else(|faults| panic!("{faults}")).study;
    assert!(
        matches!(&cut.arms[2].layout.arrangement, Arrangement::Cut { sizes: own, .. } if own == sizes(&study))
    );
    let list = "stones = [[0.45, 0.21], [0.28, 0.12], [0.32, 0.15], [0.39, 0.2]]";
    let inline = sound(&surveyed("survey-list", STONES, SIZES, list));
    assert_eq!((sizes(&inline), &inline.hash), (sizes(&study), &study.hash));
}

#[test]
fn another_survey_is_another_study() {
    let hash = |name: &str, survey: &str, to: &str| {
        let from = if to == COLUMN { LENGTH } else { SIZES };
        sound(&surveyed(name, survey, from, to)).hash
    };
    for (name, to) in [("hash-column", COLUMN), ("hash-stones", "stones = \"survey.csv\"")] {
        let own = hash(name, STONES, to);
        assert_ne!(own, hash(name, &STONES.replace("0.39", "0.38"), to), "one length");
        assert_ne!(own, hash(name, &STONES.replace("d,0.39,0.2\n", ""), to), "one stone less");
        assert_ne!(own, hash(name, &format!("{STONES}e,0.39,0.2\n"), to), "one stone twice");
        let order = "length_m,height_m\n0.39,0.2\n0.28,0.12\n0.45,0.21\n0.32,0.15\n";
        assert_eq!(own, hash(name, order, to), "the same stones in another order");
    }
    // Long lists are recorded by their hash, and so is what may go unseen in means.
    let many = |last: &str| {
        let rows: String = (0..40).map(|k| format!("0.{}\n", 30 + k % 7)).collect();
        format!("length_m\n{rows}{last}\n")
    };
    let [a, b, c] = ["0.4\n0.2", "0.3\n0.3", "0.3\n0.3"].map(|last| hash("hash-long", &many(last), COLUMN));
    assert!(a != b && b == c);
    // Heights that change partners leave both columns as they are.
    let swapped = STONES.replace("0.32,0.15", "0.32,0.21").replace("0.45,0.21", "0.45,0.15");
    let stones = "stones = \"survey.csv\"";
    assert_ne!(hash("hash-pairs", STONES, stones), hash("hash-pairs", &swapped, stones));
}

/// Each table or reference with a fault, the file and line that it is said of, and what is said.
#[test]
fn a_fault_of_a_survey_names_its_place_and_its_cure() {
    let stones = "stones = \"survey.csv\"";
    let reference = |to: &str| format!("length_m = {{ family = \"empirical\", values = \"{to}\" }}");
    let (from_study, from_table) = ("studies", "survey.csv");
    let cases: [(&str, &str, &str, &str, usize, &str, &str); 17] = [
        (
            "missing",
            STONES,
            &reference("surveys.csv:length_m"),
            from_study,
            0,
            "has no surveys.csv",
            "did you mean \"survey.csv\"?",
        ),
        (
            "column",
            STONES,
            &reference("survey.csv:width_m"),
            from_study,
            0,
            "which has stone, length_m, height_m",
            "add a column width_m",
        ),
        (
            "slip",
            STONES,
            &reference("survey.csv:lenght_m"),
            from_study,
            0,
            "it has no lenght_m",
            "did you mean \"length_m\"?",
        ),
        (
            "unit",
            "length_mm\n320\n",
            &reference("survey.csv:length_m"),
            from_study,
            0,
            "which has length_mm",
            "give length_mm in m, and call it length_m",
        ),
        (
            "asked",
            "length_cm\n32\n",
            &reference("survey.csv:length_cm"),
            from_study,
            0,
            "in m, whose name ends in \"_m\"",
            "call it length_m",
        ),
        (
            "form",
            STONES,
            &reference("survey.csv"),
            from_study,
            0,
            "a column of a table beside the study",
            "a colon",
        ),
        (
            "outside",
            STONES,
            &reference("../survey.csv:length_m"),
            from_study,
            0,
            "a table in the folder of the study",
            "put the table beside study.toml",
        ),
        ("pairs", "length_m\n0.3\n", stones, from_study, 0, "it has no height_m", "add a column height_m"),
        (
            "empty",
            "length_m,height_m\n0.3,0.1\n0.4,\n",
            stones,
            from_table,
            3,
            "height_m is empty",
            "take the row away",
        ),
        (
            "short",
            "length_m,height_m\n0.3,0.1\n0.4\n",
            stones,
            from_table,
            3,
            "height_m is empty",
            "take the row away",
        ),
        (
            "text",
            "length_m,height_m\n0.3,flat\n",
            stones,
            from_table,
            2,
            "height_m = flat",
            "write the number alone",
        ),
        (
            "zero",
            "length_m,height_m\n0.3,0\n",
            stones,
            from_table,
            2,
            "height_m = 0: allowed is a number above 0",
            "mend it",
        ),
        (
            "negative",
            "length_m\n0.3\n-0.4\n-0.5\n",
            COLUMN,
            from_table,
            3,
            "length_m = -0.4",
            "(so in line 4 as well)",
        ),
        ("large", "length_m\n320000\n", COLUMN, from_table, 2, "at most 1000 (m)", "check the unit"),
        ("bound", "length_m\n<0.3\n", COLUMN, from_table, 2, "length_m = <0.3", "a survey knows no bounds"),
        (
            "comma",
            "length_m,height_m\n0,3,0,1\n",
            stones,
            from_table,
            2,
            "has 4 cells",
            "write decimals with a point",
        ),
        ("rows", "length_m,height_m\n", stones, from_table, 0, "has no rows", "add the values"),
    ];
    for (name, survey, to, file, line, found, fix) in cases {
        let from = if to == stones { SIZES } else { LENGTH };
        let said = faults(&surveyed(&format!("survey-bad-{name}"), survey, from, to));
        let own = &said.faults[0];
        let text = own.to_string();
        assert!(text.contains(found) && text.contains(fix), "{name}: {text}");
        match file {
            "survey.csv" => assert_eq!((own.file.as_str(), own.line), (file, line), "{name}: {text}"),
            _ => assert!(own.file == "study.toml" && own.line == 72 && !own.key.is_empty(), "{name}: {text}"),
        }
    }
}

#[test]
fn sizes_are_said_once() {
    let both = surveyed("survey-both", STONES, LENGTH, &format!("{LENGTH}\nstones = \"survey.csv\""));
    let said = faults(&both);
    assert_eq!(said.faults.len(), 2, "{said}");
    assert!(said.faults.iter().all(|fault| fault.allowed.contains("no stones")), "{said}");
    let none = faults(&surveyed("survey-none", STONES, SIZES, ""));
    assert!(none.faults.iter().all(|fault| fault.found == Found::Missing), "{none}");
    assert_eq!(
        none.faults.iter().map(|fault| fault.key.as_str()).collect::<Vec<_>>(),
        ["arm.laid.length_m", "arm.laid.height_m"]
    );
    let big =
        faults(&surveyed("survey-big", "length_m,height_m\n0.3,1.4\n", SIZES, "stones = \"survey.csv\""));
    assert!(big.to_string().contains("survey.csv:2: height_m = 1.4: allowed is"), "{big}");
    assert!(big.to_string().contains("larger than the wall: check its decimal point"), "{big}");
}

/// One stone of ten with a slip of the decimal point, and all of them in mm: the wall is shorter than such stones.
#[test]
fn stones_that_are_larger_than_their_wall_are_named_by_their_lines() {
    let slip = "length_m,height_m\n0.42,0.18\n0.31,0.15\n45.5,0.22\n0.28,0.12\n";
    let slip = slip.replace("45.5", "5.5");
    let said = faults(&surveyed("survey-slip", &slip, SIZES, "stones = \"survey.csv\"")).to_string();
    assert!(said.contains("survey.csv:4: length_m = 5.5: allowed is"), "{said}");
    assert!(said.contains("larger than the wall: check its decimal point"), "{said}");
    let mm = "length_m,height_m\n420,180\n310,150\n550,220\n";
    let said = faults(&surveyed("survey-mm", mm, SIZES, "stones = \"survey.csv\"")).to_string();
    assert!(said.contains("survey.csv:2: length_m = 420") && said.contains("in mm by mistake?"), "{said}");
}

#[test]
fn other_quantities_come_from_a_table_too() {
    let phi = "phi_deg = { family = \"empirical\", values = \"tests/joints.csv:phi_deg\" }";
    let scratch = surveyed("survey-phi", STONES, "phi_deg = 30", phi);
    scratch.write("studies/base/tests/joints.csv", b"joint,phi_deg\n1,31\n2,34.5\n3,29\n");
    assert_eq!(sound(&scratch).arms[0].joint.phi_deg, Family::Empirical { values: vec![29.0, 31.0, 34.5] });
    scratch.write("studies/base/tests/joints.csv", b"joint,phi_deg\n1,31\n2,95\n");
    let said = faults(&scratch);
    assert!(
        said.to_string()
            .contains("tests/joints.csv:3: phi_deg = 95: allowed is a number within 0 to 85 (deg)"),
        "{said}"
    );
}
