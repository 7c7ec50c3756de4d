//! What the reader makes of measured.csv: values in SI units, and every fault with its line.

use std::path::Path;

use pirca::math::{degrees, radians};
use pirca::study::{MeasuredKind, MeasuredQuantity, Measurement, Study};

use crate::mutated_walls::{Draws, spoilt};
use crate::scratch::{STUDY, Scratch};

const MEASURED: &str = "studies/base/measured.csv";

/// A sound file with every column, every kind and every dimension, as a spreadsheet writes it and as people do.
pub const GOOD: &str = "\u{feff}# tests of May\r
specimen,family,tilt_deg,quantity,value,unit,error,kind,common_error,resolution,order,stage\r
\r
A1,laid,,collapse_angle,13.5,deg,0.1,rounded,,0.5,1,\r
A1,laid,5,displacement_mean,1.9,cm,0.3,exact,0.1,,1,\r
A1,laid,10,\"displacement_left\", 29 ,mm,3,exact,,,1,\r
  # a comment between rows\r
A2,LAID,,collapse_angle,45,deg,0,above,,,2,\r
A2,laid,5,displacement_mean,0.5,cm,0.3,below,,,2,0\r
A2,laid,5,displacement_mean,0.6,cm,0.3,exact,,,2,2\r
\"B, the 1st \"\"dry\"\" one\",hewn,,joint_kn,0.05,N/mm3,5e-3,exact,,,,\r
B2,hewn,,joint_phi,0.6,rad,0.01,exact,,,,\r
B2,hewn,,specimen_weight,1.371,kN,0.001,exact,,,,\r
";

pub fn load(name: &str, text: &str) -> Result<Vec<Measurement>, String> {
    let scratch = Scratch::new(name);
    scratch.write(MEASURED, text.as_bytes());
    scratch.load(None).map(|loaded| loaded.study.measured).map_err(|faults| faults.to_string())
}

#[test]
fn a_sound_file_is_read_in_si_units() {
    let found = load("measured", GOOD).unwrap_or_else(|faults| panic!("{faults}"));
    assert_eq!(found.len(), 9);
    let first = Measurement {
        specimen: "A1".into(),
        family: "laid".into(),
        tilt: None,
        drift: None,
        under: None,
        quantity: MeasuredQuantity::CollapseAngle,
        value: radians(13.5),
        kind: MeasuredKind::Rounded,
        error: radians(0.1),
        common_error: 0.0,
        unknown_share: false,
        resolution: radians(0.5),
        order: Some(1),
        stage: 0,
        line: 4,
    };
    assert_eq!(found[0], first);
    let values: Vec<(&str, f64, f64)> =
        found.iter().map(|m| (m.specimen.as_str(), m.value, m.error)).collect();
    assert_eq!(values[1], ("A1", 0.019, 0.003));
    assert_eq!((found[1].common_error, found[1].tilt), (0.001, Some(radians(5.0))));
    assert_eq!((values[2], found[2].quantity), (("A1", 0.029, 0.003), MeasuredQuantity::DisplacementLeft));
    assert_eq!((found[3].family.as_str(), found[3].kind, found[3].line), ("laid", MeasuredKind::Above, 8));
    assert_eq!((found[4].kind, found[5].stage), (MeasuredKind::Below, 2));
    // 0.05 N/mm3 is 5e7 Pa/m.
    assert_eq!(values[6], ("B, the 1st \"dry\" one", 0.05 * 1e9, 5e-3 * 1e9));
    assert_eq!((values[7], values[8]), (("B2", 0.6, 0.01), ("B2", 1371.0, 1.0)));
}

/// How much of an error is common may be unknown: half of the variance then stands in either part, whatever else is known.
#[test]
fn an_unknown_share_is_half_until_it_is_known() {
    let text = GOOD
        .replace("exact,0.1,", "exact,unknown,")
        .replace("B2,hewn,,specimen_weight,1.371,kN,0.001", "B2,hewn,,fixed_target,5,mm,0.3");
    let found = load("unknown-share", &text).unwrap_or_else(|faults| panic!("{faults}"));
    let m = &found[1];
    assert!(m.unknown_share && !found[0].unknown_share);
    assert!((m.error - 0.003 * 0.5_f64.sqrt()).abs() < 1e-15 && m.common_error == m.error);
    let [random, common] = m.errors(0.19);
    assert!(
        (random - 0.9 * 0.003).abs() < 1e-12
            && ((random * random + common * common).sqrt() - 0.003).abs() < 1e-12
    );
    assert_eq!(found[0].errors(0.7), [found[0].error, found[0].common_error]);
    assert_eq!(
        (found[8].quantity, found[8].tilt, found[8].value),
        (MeasuredQuantity::FixedTarget, None, 0.005)
    );
}

/// What is read at 0 deg after an earlier stage is what is left of the largest tilt before, and may be written as that as well.
#[test]
fn a_displacement_read_after_going_back_is_a_remainder() {
    let text = "specimen,family,tilt_deg,quantity,value,unit,error,kind,stage\n\
                A,laid,0,displacement_mean,0,mm,0.1,exact,0\n\
                A,laid,8,displacement_mean,3,mm,0.1,exact,0\n\
                A,laid,5,displacement_left,2,mm,0.1,exact,0\n\
                A,laid,0,displacement_left,0.2,mm,0.1,exact,1\n\
                A,laid,12,displacement_left,9,mm,0.1,exact,2\n\
                A,laid,4,displacement_left,2.5,mm,0.1,exact,3\n\
                A,laid,0,displacement_centre_minus_ends,0.4,mm,0.1,exact,3\n\
                B,laid,0,displacement_mean,0.1,mm,0.1,exact,1\n\
                C,laid,8,remainder_mean,0.3,mm,0.1,exact,0\n";
    let found = load("remainder", text).unwrap_or_else(|faults| panic!("{faults}"));
    let read: Vec<(MeasuredQuantity, f64)> =
        found.iter().map(|m| (m.quantity, degrees(m.tilt.expect("read at a tilt")).round())).collect();
    use MeasuredQuantity as Q;
    assert_eq!(
        read,
        [
            (Q::DisplacementMean, 0.0),
            (Q::DisplacementMean, 8.0),
            (Q::DisplacementLeft, 5.0),
            (Q::RemainderLeft, 8.0),
            (Q::DisplacementLeft, 12.0),
            (Q::DisplacementLeft, 4.0),
            (Q::RemainderCentreMinusEnds, 12.0),
            // Nothing came before it.
            (Q::DisplacementMean, 0.0),
            (Q::RemainderMean, 8.0),
        ]
    );
    assert!(
        found.iter().all(|m| m.quantity.remainder().is_none_or(|left| left.remains_of() == Some(m.quantity)))
    );
}

/// It is an input of the study, and decides no simulated result.
#[test]
fn the_file_is_an_input_and_not_in_the_hash() {
    let scratch = Scratch::new("measured-hash");
    let without = scratch.load(None).expect("sound").study;
    scratch.write(MEASURED, GOOD.as_bytes());
    let with = scratch.load(None).unwrap_or_else(|faults| panic!("{faults}")).study;
    assert_eq!((&with.hash, &with.effective), (&without.hash, &without.effective));
    let added: Vec<_> = with.inputs.iter().filter(|file| !without.inputs.contains(file)).collect();
    assert_eq!(added.len(), 1);
    assert_eq!(added[0].path, Path::new("measured.csv"));
    assert!(without.measured.is_empty() && with.inputs.len() == without.inputs.len() + 1);
}

/// A text of the sound file, what stands in its place, and what the listing must hold: `@` is the place of the replaced
/// text's line, `#` heads the number of faults (1 when there is none).
type Case = (&'static str, &'static str, &'static [&'static str]);

// One case per line: a table.
#[rustfmt::skip]
const CASES: &[Case] = &[
    // the header
    ("tilt_deg,", "tilt,", &["#2", "@ tilt is not a known column", "did you mean \"tilt_deg\"?", "@ tilt_deg is missing: allowed is a column: tilt of the platform"]),
    ("common_error,", "error,", &["@ error is a column twice", "remove one of them"]),
    (",common_error,", ",,", &["@ a column without a name: allowed is each of the columns specimen, family,", "name it or remove it"]),
    ("kind,common_error", "kind,temperature", &["@ temperature is not a known column", "choose from \"specimen\", \"family\""]),
    ("specimen,family,tilt_deg,quantity,value,unit,error,kind,common_error,resolution,order,stage", "specimen;family;tilt_deg", &["#6", "@ quantity is missing", "@ kind is missing", "measured.csv:11: goes on behind a closing quote"]),
    ("specimen,family,", "specimen,\"family,tilt\",", &["#2", "@ family,tilt is not a known column", "separate all cells of the file alike"]),
    // cells
    ("B2,hewn,,joint_phi,0.6,rad", "B2,hewn,,joint_phi,0,6,rad", &["@ has 13 cells: allowed is 12, as in the header; write decimals with a point"]),
    ("0.01,exact,,,,\r", "0.01\r", &["@ has 7 cells: allowed is 12, as in the header; add the missing ones"]),
    ("\"displacement_left\"", "\"displacement_left", &["@ has a quote that is not closed on its line", "mend the quotes"]),
    ("\"displacement_left\"", "\"displacement\"_left", &["@ goes on behind a closing quote"]),
    // names
    ("B2,hewn,,joint_phi", ",hewn,,joint_phi", &["@ specimen is missing: allowed is a name of at most 64 characters"]),
    ("A2,LAID", "A2,layed", &["@ family = layed: allowed is an arm of study.toml: stack, running, laid, hewn; did you mean \"laid\"?"]),
    ("A2,LAID", "A2,", &["@ family is missing: allowed is an arm of study.toml"]),
    ("collapse_angle,13.5", "colapse_angle,13.5", &["@ quantity = colapse_angle: allowed is one of \"collapse_angle\", \"displacement_left\"", "did you mean \"collapse_angle\"?"]),
    ("collapse_angle,13.5", ",13.5", &["@ quantity is missing"]),
    ("deg,0.1,rounded", "deg,0.1,round", &["@ kind = round: allowed is one of \"exact\", \"below\", \"above\", \"rounded\"; did you mean \"rounded\"?"]),
    ("0.01,exact", "0.01,<", &["@ kind = <: allowed is one of \"exact\"", "choose from"]),
    // units
    ("29 ,mm", "29 ,inch", &["@ unit = inch: allowed is one of \"m\", \"cm\", \"mm\""]),
    ("29 ,mm", "29 ,MM", &["@ unit = MM", "did you mean \"mm\"?"]),
    ("29 ,mm", "29 ,deg", &["@ unit = deg: allowed is one of \"m\", \"cm\", \"mm\""]),
    ("29 ,mm", "29 ,", &["@ unit is missing"]),
    ("1.371,kN", "140,kg", &["@ unit = kg: allowed is one of \"N\", \"kN\"; that is a mass: multiply by 9.81"]),
    ("0.05,N/mm3", "0.05,Pa", &["@ unit = Pa: allowed is one of \"Pa/m\", \"kPa/m\"", "convert the value"]),
    // numbers
    (", 29 ,", ",\"2,9\",", &["@ value = 2,9: allowed is a number within -100 to 100 (m); write a point for the decimal comma"]),
    (", 29 ,", ",29 mm,", &["@ value = 29 mm", "write the number alone"]),
    (", 29 ,", ",1.2.26,", &["@ value = 1.2.26", "write the number: a spreadsheet has made a date of it"]),
    (", 29 ,", ",1'029.5,", &["@ value = 1'029.5", "without separators of thousands"]),
    (", 29 ,", ",<29,", &["@ value = <29", "write the bound alone, and below or above in the column kind"]),
    (", 29 ,", ",NaN,", &["@ value = NaN", "a finite number is needed"]),
    (", 29 ,", ",1e999,", &["@ value = 1e999", "a finite number is needed"]),
    (", 29 ,", ",2.9e6,", &["@ value = 2.9e6, which is 2900 m: allowed is a number within -100 to 100 (m); mend the value or its unit"]),
    ("angle,13.5", "angle,0", &["@ value = 0: allowed is a number above 0 and at most 90 (deg)"]),
    ("angle,45", "angle,91", &["@ value = 91: allowed", "mend the value or its unit"]),
    ("joint_phi,0.6", "joint_phi,30", &["@ value = 30, which is 1718.", "allowed is a number within 0 to 85 (deg)"]),
    ("joint_kn,0.05", "joint_kn,-1", &["@ value = -1, which is -1e9 Pa/m: allowed is a number above 0 and at most 1e15 (Pa/m)"]),
    ("kN,0.001", "kN,-0.001", &["@ error = -0.001: allowed is a number above 0 (kN); raise it"]),
    ("kN,0.001", "kN,", &["@ error is missing: allowed is a number above 0 (kN)", "random error\n"]),
    ("kN,0.001", "kN,0", &["@ error = 0: allowed is a number above 0 (kN)", "raise it"]),
    ("cm,0.3,exact,0.1", "cm,,exact,0.1", &["@ error is missing: allowed is a number at least 0 (cm)", "0 for none"]),
    ("kN,0.001", "kN,1 N", &["@ error = 1 N"]),
    ("exact,0.1,", "exact,-0.1,", &["@ common_error = -0.1"]),
    ("exact,0.1,", "exact,?,", &["@ common_error = ?: allowed is a number at least 0 (cm), or unknown"]),
    ("rounded,,0.5", "rounded,,", &["@ resolution is missing: allowed is a number above 0 (deg)"]),
    ("rounded,,0.5", "rounded,,0", &["@ resolution = 0", "raise it"]),
    ("rounded,,0.5", "rounded,,1", &["@ resolution = 1: allowed is a step of which the value 13.5 is a multiple"]),
    ("rounded,,0.5", "exact,,0.5", &["@ resolution = 0.5: allowed is nothing unless kind = rounded"]),
    // tilts
    ("laid,10,", "laid,,", &["@ tilt_deg is missing: allowed is a number within 0 to 90 (deg); state the tilt at which the displacement_left was read"]),
    ("laid,10,", "laid,-10,", &["@ tilt_deg = -10", "raise it"]),
    ("laid,10,", "laid,100,", &["@ tilt_deg = 100", "reduce it"]),
    ("LAID,,collapse_angle,45", "laid,45,collapse_angle,45", &["@ tilt_deg = 45: allowed is nothing where quantity = collapse_angle"]),
    // orders and stages
    (",0.5,1,\r", ",0.5,0,\r", &["@ order = 0: allowed is a whole number, at least 1, or nothing"]),
    (",,,2,0\r", ",,,2,-1\r", &["@ stage = -1: allowed is a whole number, at least 0, or nothing"]),
    (",,,2,0\r", ",,,2,1.5\r", &["@ stage = 1.5"]),
    // rows against one another
    ("A2,laid,5,displacement_mean,0.6", "A2,hewn,5,displacement_mean,0.6", &["@ family of A2 is hewn, and was laid in line 8: allowed is one family per specimen"]),
    (",,,2,2\r", ",,,3,2\r", &["@ order of A2 is 3, and was 2 in line 8"]),
    ("deg,0,above,,,2,", "deg,0,rounded,,0.5,2,1", &["#1", "measured.csv:10: stage 2 comes after the collapse of A2: allowed is at most 1, by line 8; mend the stage"]),
    (",,,2,2\r", ",,,,2\r", &["@ order of A2 is empty, and was 2 in line 8"]),
    (",,,2,2\r", ",,,2,\r", &["@ quantity displacement_mean of A2 was read in line 9 already", "number the readings in the column stage"]),
    ("laid,10,", "laid,15,", &["@ tilt_deg 15 deg is above the collapse angle of A1: allowed is at most 14.3 deg, by line 4"]),
];

#[test]
fn every_fault_is_named_with_its_line() {
    let mut wrong = Vec::new();
    for (index, (from, to, expected)) in CASES.iter().enumerate() {
        let at = GOOD.find(from).unwrap_or_else(|| panic!("`{from}` is not in the sound file"));
        let place = format!("measured.csv:{}:", GOOD[..at].matches('\n').count() + 1);
        let listing = match load(&format!("measured-{index}"), &GOOD.replacen(from, to, 1)) {
            Ok(_) => "taken for good".to_owned(),
            Err(listing) => listing,
        };
        let count = expected.iter().find_map(|e| e.strip_prefix('#')).unwrap_or("1");
        let mut parts: Vec<String> =
            expected.iter().filter(|e| !e.starts_with('#')).map(|e| e.replace('@', &place)).collect();
        parts.push(format!("{count} fault"));
        let missing: Vec<String> = parts.into_iter().filter(|part| !listing.contains(part)).collect();
        if !missing.is_empty() {
            wrong.push(format!("`{to}`: no {missing:?} in\n{listing}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// Two specimens cannot both be the first of their family; those of different families can.
#[test]
fn a_push_is_read_at_a_drift_and_nothing_else_is() {
    let header = "specimen,family,tilt_deg,drift_percent,quantity,value,unit,error,kind\n";
    let with = |rows: &str| load("drift", &format!("{header}{rows}"));
    let found = with("W,laid,,0.25,force_at_drift,27,kN,1,exact\nW,laid,,0.5,force_at_drift,31,kN,1,exact\n");
    let found = found.unwrap_or_else(|faults| panic!("{faults}"));
    assert_eq!((found[0].drift, found[0].tilt, found[0].value), (Some(0.0025), None, 27e3));
    for (row, said) in [
        ("W,laid,,,force_at_drift,27,kN,1,exact", "drift_percent"),
        ("W,laid,5,0.25,force_at_drift,27,kN,1,exact", "tilt_deg"),
        ("W,laid,5,0.25,displacement_mean,1,mm,1,exact", "drift_percent"),
        ("W,laid,,0.25,force_at_drift,27,mm,1,exact", "unit"),
        (
            "W,laid,,0.5,force_at_drift,1,N,1,exact\nW,laid,,0.5,force_at_drift,2,N,1,exact",
            "was read in line 2",
        ),
    ] {
        let faults = with(row).expect_err(said);
        assert!(faults.contains(said), "{faults}");
    }
}

#[test]
fn places_in_the_order_of_tests_are_taken_once() {
    let taken = GOOD.replace(",2,", ",1,").replace(",,2,\r", ",,1,\r");
    let listing = load("measured-order", &taken).expect_err("both are the first");
    assert!(
        listing.contains("measured.csv:8: order = 1 is that of A1 in line 4: allowed is every place once"),
        "{listing}"
    );
    let counted = GOOD.replace("5e-3,exact,,,,", "5e-3,exact,,,1,");
    assert_eq!(load("measured-counted", &counted).map(|found| found.len()), Ok(9));
}

#[test]
fn all_faults_of_a_file_come_at_once_and_in_order() {
    let text = GOOD.replace("13.5,deg", "x,deg").replace("29 ,mm", "29 ,km").replace("hewn", "hwen");
    let listing = load("measured-many", &text).expect_err("three faults");
    let lines: Vec<&str> = listing.lines().filter(|line| line.starts_with("measured.csv")).collect();
    assert_eq!(lines.len(), 3, "{listing}");
    // One name written wrongly in three rows is one fault.
    assert!(
        lines[2].contains("family = hwen") && lines[2].ends_with("(so in lines 12, 13 as well)"),
        "{listing}"
    );
    for (line, start) in lines.iter().zip([4, 6, 11]) {
        assert!(line.starts_with(&format!("measured.csv:{start}: ")), "{listing}");
    }
    assert!(listing.contains("\n   6 | A1,laid,10,\"displacement_left\", 29 ,km,3,exact,,,1,\n     |                                     ^^\n"), "{listing}");
}

#[test]
fn a_file_without_rows_or_header_is_said_so() {
    let header = GOOD.lines().nth(1).expect("a header");
    for (text, part) in [
        ("", "measured.csv: is empty: allowed is a text file of values separated by commas"),
        (
            "# nothing\n",
            "measured.csv: has no header: allowed is a line with the names of the columns; begin with specimen,family,tilt_deg,quantity,value,unit,error,kind",
        ),
        (header, "measured.csv: has no rows"),
    ] {
        let listing = load("measured-empty", text).expect_err(part);
        assert!(listing.starts_with(&format!("1 fault in the input:\n{part}")), "{listing}");
    }
    let scratch = Scratch::new("measured-latin");
    scratch.write(MEASURED, b"specimen\nM\xfcller\n");
    let listing = scratch.load(None).expect_err("Latin-1").to_string();
    assert!(listing.contains("measured.csv:2: is not UTF-8"), "{listing}");
}

/// Faults of the study and of its measurements come together; a faulty list of arms is not blamed on the families.
#[test]
fn faults_of_the_study_stand_beside() {
    let scratch = Scratch::new("measured-beside");
    scratch.write(MEASURED, GOOD.replace("13.5,deg", "x,deg").as_bytes());
    scratch.replace(STUDY, "height_m = 1.0", "height_m = -1.0");
    let listing = scratch.load(None).expect_err("two faults").to_string();
    assert!(
        listing.starts_with("2 faults in the input:\nstudy.toml:8: ")
            && listing.contains("\nmeasured.csv:4: value = x"),
        "{listing}"
    );
}

/// The paper's Tables 2 and 3 as the study states them: 9 collapse angles, 9 bounds for CBL, 6 + 9 displacements.
#[test]
fn the_papers_tables_are_what_the_paper_prints() {
    let text = include_str!("../../studies/tilting-table/measured.csv");
    let scratch = Scratch::new("measured-paper");
    for (arm, family) in [("stack", "cbl"), ("running", "sbl"), ("laid", "sbr")] {
        let study =
            scratch.read(STUDY).replace(&format!("name = \"{arm}\""), &format!("name = \"{family}\""));
        scratch.write(STUDY, study.replace(&format!("arm.{arm}."), &format!("arm.{family}.")).as_bytes());
    }
    std::fs::remove_file(scratch.path(crate::scratch::PUBLISHED)).expect("it was there");
    let study = scratch.read(STUDY);
    let (sound, _) = study.split_once("[[variant]]").expect("the fixture has variants");
    scratch.write(STUDY, sound.as_bytes());
    scratch.write(MEASURED, text.as_bytes());
    let study: Study = scratch.load(None).unwrap_or_else(|faults| panic!("{faults}")).study;
    let mean = |family: &str, quantity: MeasuredQuantity, tilt: Option<f64>| {
        let of =
            |m: &&Measurement| m.family == family && m.quantity == quantity && m.tilt == tilt.map(radians);
        let found: Vec<f64> = study.measured.iter().filter(of).map(|m| m.value).collect();
        assert_eq!(found.len(), 3, "{family} {quantity:?} {tilt:?}");
        found.iter().sum::<f64>() / 3.0
    };
    use MeasuredQuantity::{CollapseAngle, DisplacementCentreMinusEnds, DisplacementMean};
    // The means that the paper prints beside, to half of their last digit.
    for (family, printed) in [("cbl", 18.8), ("sbl", 14.3), ("sbr", 19.5)] {
        assert!((mean(family, CollapseAngle, None) - radians(printed)).abs() < radians(0.05), "{family}");
    }
    for (family, quantity, tilt, printed) in [
        ("sbl", DisplacementMean, 5.0, 1.3),
        ("sbl", DisplacementMean, 10.0, 2.2),
        ("sbr", DisplacementCentreMinusEnds, 5.0, 0.2),
        ("sbr", DisplacementCentreMinusEnds, 10.0, 1.6),
        ("sbr", DisplacementCentreMinusEnds, 15.0, 3.1),
    ] {
        assert!((mean(family, quantity, Some(tilt)) - printed / 100.0).abs() < 0.0005, "{family} at {tilt}");
    }
    let bounds = study.measured.iter().filter(|m| m.kind == MeasuredKind::Below);
    assert_eq!(bounds.map(|m| (m.family.as_str(), m.value)).collect::<Vec<_>>(), [("cbl", 0.005); 9]);
    assert_eq!(study.measured.len(), 33);
}

/// Chance spoils the sound file: the reader never panics, and what it takes for good is finite and of known arms.
#[test]
fn spoilt_files_are_refused_or_good() {
    let scratch = Scratch::new("measured-spoilt");
    let mut draws = Draws(4);
    let (mut refused, mut taken) = (0, 0);
    for _ in 0..400 {
        let text = spoilt(GOOD, &mut draws);
        scratch.write(MEASURED, text.as_bytes());
        match scratch.load(None) {
            Err(faults) => {
                refused += 1;
                assert!(faults.faults.iter().all(|fault| fault.file == "measured.csv"), "{text}\n{faults}");
                assert!(
                    faults.faults.iter().all(|fault| !fault.allowed.is_empty() && !fault.fix.is_empty()),
                    "{faults}"
                );
            }
            Ok(loaded) => {
                taken += 1;
                for m in &loaded.study.measured {
                    let numbers = [m.value, m.error, m.common_error, m.resolution, m.tilt.unwrap_or(0.0)];
                    assert!(numbers.iter().all(|x| x.is_finite() && x.abs() < 1e25), "{text}\n{m:?}");
                    assert!(m.error >= 0.0 && m.common_error >= 0.0 && m.resolution >= 0.0, "{text}\n{m:?}");
                    assert!(
                        ["stack", "running", "laid", "hewn"].contains(&m.family.as_str()),
                        "{text}\n{m:?}"
                    );
                }
            }
        }
    }
    // Neither branch may go untested.
    assert!(refused > 100 && taken > 10, "{refused} refused, {taken} taken");
}
