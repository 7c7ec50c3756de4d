//! Records of every form, and records with faults, each with the line and the words of its message.

use super::*;
use crate::math::{STANDARD_GRAVITY, Vec3};

/// Headers of both forms of PEER, of seven values.
const AT2: &str = "PEER NGA STRONG MOTION DATABASE RECORD\nSomewhere, 1/1/1999, Station, 090\nACCELERATION TIME SERIES IN UNITS OF G\nNPTS=      7, DT=   .0050 SEC,\n";
const OLD_AT2: &str = "PACIFIC ENGINEERING AND ANALYSIS STRONG-MOTION DATA\n SOMEWHERE 01/01/79, STATION, 140\n ACCELERATION TIME HISTORY IN UNITS OF G\n   7    0.0050    NPTS, DT\n";
const VALUES: &str =
    "  .1000000E-01 -.2000000E-01  .3000000E+00 -.4000000E-01  .5000000E-01\n -.6000000E-01  .1000000E-01\n";
/// The same in g.
const IN_G: [f64; 7] = [0.01, -0.02, 0.3, -0.04, 0.05, -0.06, 0.01];
/// A header of ESM, as far as it matters, with its values in cm/s^2.
const ESM: &str = "EVENT_NAME: Somewhere\nEVENT_ID: X-1\nEVENT_DATE_YYYYMMDD: 20000823\nVS30_M/S:\nSAMPLING_INTERVAL_S: 0.005000\nNDATA: 4\nDURATION_S: 0.015\nSTREAM: HNE\nUNITS: cm/s^2\nPGA_CM/S^2: -98.1\nHEADER_FORMAT: DYNA 1.2\nDATA_TYPE: ACCELERATION\nUSER5:\n";
const ESM_VALUES: &str = "1.5\n-98.100000\n2.0e+1\n-7\n";

/// A header of K-NET with ten counts: 100.0 gal to both sides of a zero at 400,000 counts.
const KNET: &str = "Origin Time       2006/01/18 23:25:00\nLat.              37.798\nLong.             142.200\nDepth. (km)       36\nMag.              5.7\nStation Code      MYG002\nStation Lat.      38.7262\nStation Long.     141.5109\nStation Height(m) 79\nRecord Time       2006/01/18 23:25:46\nSampling Freq(Hz) 100Hz\nDuration Time(s)  1\nDir.              N-S\nScale Factor      3920(gal)/6182761\nMax Acc. (gal)    100.000\nLast Correction   2006/01/18 23:25:31\nMemo.\n   400000   400000   408003   391997   557723   242277   400000   400000\n   400000   400000\n";
/// A file of COSMOS V1.20 as far as it matters, and the block of CSMIP with the same values.
const COSMOS: &str = "Corrected acceleration   (Format v01.20 with 13 text lines) Src: somewhere\nEarthquake\n(text)\n 40 Real-header values follow on   8 lines, Format= (5F15.6)\n      39.923300    -123.761400     245.000000    -999.000000    -999.000000\n    -999.000000    -999.000000    -999.000000    -999.000000    -999.000000\n    -999.000000    -999.000000    -999.000000    -999.000000    -999.000000\n    -999.000000    -999.000000    -999.000000    -999.000000    -999.000000\n    -999.000000    -999.000000    -999.000000    -999.000000    -999.000000\n    -999.000000    -999.000000    -999.000000    -999.000000      55.850000\n       0.000000       0.000000    -999.000000       0.010000       0.050000\n    -999.000000    -999.000000    -999.000000    -999.000000    -999.000000\n   5 acceleration pts, approx   1 secs, units=cm/sec2 (04), Format= (3F10.5)\n   1.50000-100.00000  20.00000\n  -7.00000   0.00000\nEnd-of-data for Chan  1 acceleration\n";
const CSMIP: &str = "Corrected accelerogram   channel 1\nChan  1: 90 Deg\n    5 points of accel data equally spaced at  .010 sec, in cm/sec2. (3f10.5)\n   1.50000-100.00000  20.00000\n  -7.00000   0.00000\n    5 points of veloc data equally spaced at  .010 sec, in cm/sec.\n 0 0 0 0 0\n";

fn read(text: &str) -> Result<Motion, BadRecord> {
    Motion::from_text("record", text)
}

fn samples(motion: &Motion, axis: &Vec3) -> Vec<f64> {
    motion.accelerogram(axis).samples().to_vec()
}

fn assert_is_in_g(motion: &Motion) {
    let found = samples(motion, &Vec3::x());
    assert_eq!(found.len(), 7);
    for (a, g) in found.iter().zip(IN_G) {
        assert!((a - g * STANDARD_GRAVITY).abs() < 1e-14, "{found:?}");
    }
    assert_eq!(motion.step(), Some(0.005));
}

#[test]
fn both_headers_of_peer_are_read_however_their_values_are_written() {
    let spread = "  .01\n -.02 .3 -.04 .05 -.06 .01\n";
    let together = " .1000D-01-.2000D-01 .3000D+00-.4000D-01 .5000D-01\n-.6000D-01 .1000D-01\n";
    for head in [AT2, OLD_AT2] {
        for values in [VALUES, spread, together] {
            let text = format!("{head}{values}");
            assert_is_in_g(&read(&text).expect("a good record"));
            // Line ends of DOS and of old machines; the mark of the end of DOS.
            assert_is_in_g(&read(&text.replace('\n', "\r\n")).expect("a good record"));
            assert_is_in_g(&read(&text.replace('\n', "\r")).expect("a good record"));
            assert_is_in_g(&read(&format!("\u{feff}{text}\u{1a}")).expect("a good record"));
        }
    }
}

#[test]
fn further_lines_of_header_and_other_spellings_are_read() {
    let further = format!("{AT2}FILTER POINTS: HP=0.2 Hz LP=25 Hz\n\n{VALUES}\n\n");
    let spelled = format!("{AT2}{VALUES}")
        .replace("NPTS=      7, DT=   .0050 SEC,", "npts = 7 , dt = 5.0E-3sec, 0 POLE @ 30. HZ");
    let noted = format!("{AT2}{VALUES}").replace("OF G", "of g. Filter points: hp=0.2");
    for text in [further, spelled, noted] {
        assert_is_in_g(&read(&text).expect("a good record"));
    }
}

#[test]
fn a_last_line_that_lost_its_end_is_noted() {
    let motion =
        read(&format!("{AT2}{VALUES}").replace("NPTS=      7", "NPTS=     10")).expect("it is taken");
    assert!(motion.notes.iter().any(|note| note == "the last line is short: 7 of 10 values are there"));
    assert_eq!(samples(&motion, &Vec3::x()).len(), 7);
}

#[test]
fn esm_is_read_along_x_or_z() {
    let text = format!("{ESM}{ESM_VALUES}");
    let motion = read(&text).expect("a good record");
    assert_eq!(samples(&motion, &Vec3::x()), [0.015, -0.981, 0.2, -0.07]);
    assert_eq!(motion.step(), Some(0.005));
    let up = read(&text.replace("HNE", "HNZ")).expect("a good record");
    assert_eq!((samples(&up, &Vec3::z())[1], samples(&up, &Vec3::x())[1]), (-0.981, 0.0));
    let odd = read(&text.replace("-98.1\n", "-95.0\n")).expect("it is taken");
    let said = "the header states a peak of -95 cm/s^2, and that of the values is 98.1";
    assert!(odd.notes.iter().any(|note| note == said), "{:?}", odd.notes);
    assert!(!motion.notes.iter().any(|note| note.contains("peak")), "{:?}", motion.notes);
    // Weak, but not by a slip of the unit.
    let weak = format!("{ESM}0.1\n0.2\n-0.3\n0.1\n").replace("-98.1", "-0.3000");
    assert_eq!(samples(&read(&weak).expect("a good record"), &Vec3::x())[2], -0.003);
    for (unit, size) in [("m/s^2", 1.0), ("g", STANDARD_GRAVITY)] {
        let head = ESM.replace("UNITS: cm/s^2", &format!("UNITS: {unit}"));
        let motion = read(&format!("{head}1.5\n-3.0\n2.0\n-0.5\n")).expect("a good record");
        assert_eq!(samples(&motion, &Vec3::x()), [1.5, -3.0, 2.0, -0.5].map(|a| a * size));
    }
}

#[test]
fn a_header_of_peer_may_state_its_unit_in_words_or_brackets() {
    let stated = "ACCELERATION TIME SERIES IN UNITS OF G";
    for words in
        ["  Acceleration in g", "ACCELERATION (G)", "The units are (g)", "ACCEL. TIME HISTORY, UNITS: G"]
    {
        assert_is_in_g(&read(&with(&format!("{AT2}{VALUES}"), stated, words)).expect("a good record"));
    }
    let gal = with(&format!("{AT2}{VALUES}"), stated, "Acceleration in gal").replace(".3000000E+00", "30.0");
    assert_eq!(samples(&read(&gal).expect("a good record"), &Vec3::x())[2], 0.3);
}

#[test]
fn both_headers_of_itaca_are_read() {
    let text = format!("{ESM}{ESM_VALUES}").replace("DYNA 1.2", "DYNA 1.0");
    for kind in ["PROCESSED ACCELERATION", "UNPROCESSED ACCELERATION"] {
        let motion = read(&with(&text, "DATA_TYPE: ACCELERATION", &format!("DATA_TYPE: {kind}")));
        assert_eq!(samples(&motion.expect("a good record"), &Vec3::x()), [0.015, -0.981, 0.2, -0.07]);
    }
}

/// The counts of KNET are 3920/6182761 gal each, about their mean of 400,000.
#[test]
fn counts_of_k_net_are_read_about_their_mean() {
    let motion = read(KNET).expect("a good record");
    let found = samples(&motion, &Vec3::x());
    assert_eq!((found.len(), motion.step()), (10, Some(0.01)));
    let factor = 3920.0 / 6_182_761.0 / 100.0;
    for (a, counts) in found.iter().zip([0.0, 0.0, 8003.0, -8003.0, 157_723.0, -157_723.0]) {
        assert!((a - counts * factor).abs() < 1e-12, "{a} {counts}");
    }
    assert!(motion.notes[0].starts_with("the mean of the values, 253.608 cm/s^2"), "{:?}", motion.notes);
    assert_eq!(motion.notes.len(), 1, "{:?}", motion.notes);
    for up in ["U-D", "6"] {
        let up = read(&with(KNET, "N-S", up)).expect("a good record");
        assert_eq!((samples(&up, &Vec3::z())[4], samples(&up, &Vec3::x())[4]), (found[4], 0.0));
    }
    let odd = read(&with(KNET, "100.000", "48.060")).expect("it is taken");
    let said = "the header states a peak of 48.06 cm/s^2, and that of the values is 100.000";
    assert!(odd.notes.iter().any(|note| note == said), "{:?}", odd.notes);
}

#[test]
fn v2_files_of_cosmos_and_csmip_are_read() {
    for text in [COSMOS, CSMIP] {
        let motion = read(text).expect("a good record");
        assert_eq!(samples(&motion, &Vec3::x()), [0.015, -1.0, 0.2, -0.07, 0.0]);
        assert_eq!(motion.step(), Some(0.01));
    }
    let up = read(&with(CSMIP, "90 Deg", "Up")).expect("a good record");
    assert_eq!(samples(&up, &Vec3::z())[1], -1.0);
    let azimuth = |way: &str| {
        let integers =
            format!(" 60 Integer-header values follow on 1 lines\n{}{way} 0 0 0 0 0 0\n", "0 ".repeat(53));
        let text = with(COSMOS, " 40 Real", &format!("{integers} 40 Real"));
        samples(&read(&text).expect("a good record"), &Vec3::z())[1]
    };
    assert_eq!(["400", "401", "90"].map(azimuth), [-1.0, 1.0, 0.0]);
}

#[test]
fn quotes_and_decimal_commas_of_spreadsheets_are_read() {
    let wanted = read("t_s,a_g\n0.00,0.1\n0.01,-0.2\n0.02,0.1\n").expect("a good record");
    for text in [
        "\"t_s\",\"a_g\"\n\"0,00\",\"0,1\"\n\"0,01\",\"-0,2\"\n\"0,02\",\"0,1\"\n",
        "t_s;a_g\n0,00;0,1\n0,01;-0,2\n0,02;0,1\n;\n",
        "sep=;\nt_s;a_g\n0,00;0,1\n0,01;\u{2212}0,2\n0,02;0,1\n",
        "t_s\ta_g\n0,00\t0,1\n0,01\t-0,2\n0,02\t0,1\n\t\n",
    ] {
        assert_eq!(read(text).expect("a good record"), wanted, "{text}");
    }
}

#[test]
fn tables_are_read_by_their_headers() {
    let one = read("t_s,a_g\n0.00,0.1\n0.01,-0.2\n0.02,0.1\n").expect("a good record");
    assert!((one.acceleration(0.01).x + 0.2 * STANDARD_GRAVITY).abs() < 1e-15);
    assert!((one.step().expect("a record") - 0.01).abs() < 1e-17);
    // The mark of UTF-8 before it, and a comment that speaks of other formats.
    let marked = "\u{feff}t_s,a_g\n# from NPTS= 4000, DT= .0050 SEC\n0.00,0.1\n0.01,-0.2\n0.02,0.1\n";
    assert_eq!(read(marked).expect("a good record"), one);
    // Three axes, in units and an order of their own, with semicolons, quotes, comments and blanks.
    let text = "# from a table\n#dt_s: 0.01\n\n\"az_cm_per_s2\"; ay_m_per_s2 ;AX_G\n 98 ;1.0; 0.1\n# between\n0;-1.0;0.2\n0;0;0\n";
    let three = read(text).expect("a good record");
    assert!((three.acceleration(0.0) - Vec3::new(0.1 * STANDARD_GRAVITY, 1.0, 0.98)).norm() < 1e-15);
    assert_eq!((three.components(), three.step()), (3, Some(0.01)));
    // Tabs, a time column at the end that does not begin at 0, and a component of 0 beside another one.
    let tabs = read("ax_g\tay_g\tt_s\n0.1\t0\t7.5\n0.2\t0\t7.502\n-0.3\t0\t7.504\n").expect("a good record");
    assert!((tabs.step().expect("a record") - 0.002).abs() < 1e-12 && tabs.duration() < 0.0041);
}

#[test]
fn rounded_times_are_taken_for_what_they_are() {
    // 1/128 s in three digits; 0.0025 s in three digits with the step stated; zeros left out at the end; exponents.
    let table = |times: &dyn Fn(f64) -> String, step: f64, head: &str| -> String {
        let rows =
            (0..400).map(|i| format!("{},{}\n", times(step * f64::from(i)), 0.1 * f64::from(i % 7 - 3)));
        format!("{head}t_s,a_g\n{}", rows.collect::<String>())
    };
    let good: [(String, f64); 4] = [
        (table(&|t| format!("{t:.3}"), 1.0 / 128.0, ""), 1.0 / 128.0),
        (table(&|t| format!("{t:.3}"), 0.0025, "# dt_s = 0.0025\n"), 0.0025),
        (table(&|t| format!("{}", (t * 1e5).round() / 1e5), 0.005, ""), 0.005),
        (table(&|t| format!("{t:.5e}"), 0.005, ""), 0.005),
    ];
    for (text, step) in good {
        // The mean step of rounded times errs by a digit over the length.
        let found = read(&text).map(|motion| motion.step().expect("a record"));
        assert!((found.clone().expect("a good record") - step).abs() < 2.6e-6, "{found:?} {step}");
    }
    let fault = read(&table(&|t| format!("{t:.2}"), 0.005, "")).unwrap_err().to_string();
    assert!(fault.contains("or print times with more digits"), "{fault}");
}

/// A malformed file: how it is made, the line to blame, and a piece of the message.
type Case = (String, usize, &'static str);

/// A file with some text replaced by another.
fn with(text: &str, from: &str, to: &str) -> String {
    assert!(text.contains(from), "{from:?} is not in the text");
    text.replacen(from, to, 1)
}

// One case per line: a table.
#[rustfmt::skip]
fn cases() -> Vec<Case> {
    let at2 = &format!("{AT2}{VALUES}");
    let old = &format!("{OLD_AT2}{VALUES}");
    let esm = &format!("{ESM}{ESM_VALUES}");
    let csv = "t_s,a_g\n0.00,0.1\n0.01,-0.2\n0.02,0.1\n0.03,0.0\n0.04,0.1\n";
    let three = "# dt_s = 0.01\nax_g,ay_g,az_g\n0.1,0.1,0.1\n0.2,0.2,0.2\n0.1,0.1,0.1\n";
    vec![
        // nothing, or no record
        (String::new(), 0, "the file is empty; allowed is a record"),
        (" \r\n\t\r\n".to_owned(), 0, "the file is empty"),
        ("# only\n# comments\n".to_owned(), 0, "there are only comments"),
        ("0.1 0.2 0.3\n0.4 0.5 0.6\n".to_owned(), 1, "the values begin without a header, so that neither unit nor step is known; allowed is PEER AT2, ESM or ITACA ASCII, K-NET ASCII, COSMOS or CSMIP V2, or CSV with a header"),
        ("0.1,0.2\n".to_owned(), 1, "the values begin without a header"),
        ("<html><body>Not found</body></html>\n".to_owned(), 1, "the column \"<html><body>Not found</body></html>\" is not known"),
        // PEER: header
        (with(at2, "NPTS=      7, DT=   .0050 SEC,\n", ""), 0, "NPTS and DT are missing; allowed is a line \"NPTS= 4000, DT= .0050 SEC\" or \"4000 0.0050 NPTS, DT\""),
        (with(at2, ", DT=   .0050 SEC,", ""), 4, "DT is missing"),
        (with(old, "7    0.0050", "7"), 4, "DT is missing"),
        (with(old, "7    0.0050", ""), 4, "NPTS is missing"),
        (with(at2, "      7,", "  seven,"), 4, "NPTS is \"SEVEN\""),
        (with(at2, "      7,", "    7.5,"), 4, "NPTS is \"7.5\""),
        (with(at2, "      7,", "     -7,"), 4, "NPTS is \"-7\""),
        (with(at2, ".0050", "fast"), 4, "DT is \"FAST\""),
        (with(at2, ".0050", "0.0"), 4, "the step is 0 s; allowed is 0.00001 to 0.1 s"),
        (with(at2, ".0050", "-.005"), 4, "the step is -0.005 s"),
        (with(at2, ".0050", "5.0"), 4, "the step is 5 s; allowed is 0.00001 to 0.1 s; state the time between samples in seconds"),
        (with(at2, "ACCELERATION TIME SERIES IN UNITS OF G\n", ""), 0, "the header states no unit"),
        (with(at2, "ACCELERATION TIME SERIES IN UNITS OF G", "VELOCITY TIME SERIES IN UNITS OF CM/S"), 3, "give the file of accelerations"),
        (with(at2, "ACCELERATION TIME SERIES IN UNITS OF G", "DISPLACEMENT TIME SERIES IN UNITS OF CM"), 3, "the header says \"DISPLACEMENT TIME SERIES IN UNITS OF CM\""),
        (with(at2, "ACCELERATION TIME SERIES", "VELOCITY TIME SERIES"), 3, "give the file of accelerations"),
        (with(at2, "UNITS OF G", "UNITS OF FT/SEC/SEC"), 3, "convert it to CSV"),
        (with(at2, "UNITS OF G", "UNITS OF CM/SEC/SEC"), 5, "the peak is 0.3 cm/s^2, which is 3.06e-4 g"),
        (with(at2, "NPTS=", "The units are (cm/s^2)\nNPTS="), 4, "the header states cm/s^2, and line 3 states g; allowed is one unit"),
        (with(at2, "ACCELERATION TIME SERIES IN UNITS OF G", "Velocity in cm/s"), 3, "give the file of accelerations"),
        // PEER: values
        (with(at2, "NPTS=      7", "NPTS=      6"), 4, "the header states 6 values, and there are 7; allowed is as many as stated"),
        (with(at2, "NPTS=      7", "NPTS=     11"), 4, "the header states 11 values, and there are 7"),
        (with(at2, "NPTS=      7", "NPTS=   7999"), 4, "get the whole file"),
        (AT2.to_owned(), 4, "the header states 7 values, and there are 0"),
        (with(at2, " -.6000000E-01", " NaN"), 6, "\"NaN\" stands among the values; allowed is values alone"),
        (with(at2, " -.6000000E-01", " -Inf"), 6, "\"-Inf\" stands among the values"),
        (with(at2, " -.6000000E-01", " *************"), 6, "stars, where a value was too long for its field"),
        (with(at2, " -.6000000E-01", " -.6000000E"), 6, "\"-.6000000E\" is no number"),
        (with(at2, " -.6000000E-01", " -.600.000"), 6, "\"-.600.000\" is no number"),
        (with(at2, " -.6000000E-01", " -,6000000"), 6, "has a comma"),
        (with(at2, " -.6000000E-01", " 1E999"), 6, "is beyond all numbers"),
        (format!("{AT2}{}END OF DATA\n", VALUES), 7, "\"END\" is no number; allowed is values alone, once they have begun"),
        (with(at2, ".3000000E+00", ".6000000E+01"), 5, "the peak is 6 g, which is 6.000 g; allowed is at most 5 g; state the unit"),
        (format!("{AT2} .0 .0 .0 .0 .0\n .0 .0\n"), 0, "all values are 0"),
        (format!("{AT2} 1E-6 0 0 0 0\n 0 0\n"), 5, "the peak is 0.000001 g, which is 1.00e-6 g; allowed is at least 0.0005 g"),
        (with(&format!("{AT2}.1 .2\n"), "      7,", "      2,"), 0, "the record has 2 values; allowed is at least 3"),
        // ESM
        (with(esm, "SAMPLING_INTERVAL_S: 0.005000\n", ""), 0, "SAMPLING_INTERVAL_S is missing"),
        (with(esm, "0.005000", ""), 0, "SAMPLING_INTERVAL_S is missing"),
        (with(esm, "0.005000", "200 Hz"), 5, "SAMPLING_INTERVAL_S: \"200 Hz\" is no number"),
        (with(esm, "0.005000", "200"), 5, "the step is 200 s"),
        (with(esm, "NDATA: 4", "NDATA: 5"), 6, "NDATA states 5 values, and there are 4"),
        (with(esm, "UNITS: cm/s^2", "UNITS: cm/s"), 9, "UNITS is \"cm/s\"; allowed is cm/s^2, m/s^2 or g"),
        (with(esm, "UNITS: cm/s^2", "UNITS:"), 0, "UNITS is missing"),
        (with(esm, "DATA_TYPE: ACCELERATION", "DATA_TYPE: VELOCITY"), 12, "DATA_TYPE is \"VELOCITY\"; allowed is ACCELERATION, PROCESSED ACCELERATION or UNPROCESSED ACCELERATION"),
        (with(esm, "DATA_TYPE: ACCELERATION", "DATA_TYPE: ACCELERATION RESPONSE SPECTRUM"), 12, "give the file of accelerations"),
        (with(esm, "2.0e+1\n", "nan\n"), 16, "\"nan\" stands among the values"),
        (with(esm, "2.0e+1\n", "2.0 3.0\n"), 16, "allowed is one value a line"),
        (with(esm, "-98.100000\n", "-9810.0\n"), 15, "the peak is 9810 cm/s^2, which is 10.003 g"),
        (with(esm, "1.5\n-98.100000\n2.0e+1\n-7\n", "0.1\n0.2\n-0.3\n0.1\n"), 16, "the peak is 0.3 cm/s^2, which is 3.06e-4 g"),
        // tables: header
        (with(csv, "a_g", "a"), 1, "the column \"a\" is not known; allowed is t_s for times, and a (or ax, ay, az) with its unit"),
        (with(csv, "a_g", "acc_g"), 1, "the column \"acc_g\" is not known"),
        (with(csv, "a_g", "a_gal"), 1, "the column \"a_gal\" is not known"),
        (with(csv, "t_s", "time"), 1, "the column \"time\" is not known"),
        (with(csv, "t_s,a_g", "t_s,t_s"), 1, "the column \"t_s\" comes twice"),
        (with(three, "ax_g,ay_g", "ax_g,ax_m_per_s2"), 2, "the column \"ax_m_per_s2\" comes twice, or in two units"),
        (with(three, "ax_g", "a_g"), 2, "a component without an axis stands beside others; allowed is ax, ay and az"),
        ("t_s\n0.0\n0.1\n".to_owned(), 1, "there is no acceleration"),
        ("a_g\n0.1\n0.2\n0.1\n".to_owned(), 1, "no step is stated; allowed is a column t_s or a stated step; add a column t_s, or a line \"# dt_s = 0.005\""),
        (with(three, "0.01\n", "ten ms\n"), 1, "dt_s: \"ten ms\" is no number"),
        (with(three, "0.01\n", "10\n"), 1, "the step is 10 s"),
        (with(three, "ax_g", "# dt_s = 0.02\nax_g"), 2, "dt_s is stated twice"),
        // tables: rows
        (with(csv, "0.02,0.1", "0.02"), 4, "the row has 1 values; allowed is 2, as the header has columns"),
        (with(csv, "0.02,0.1", "0.02,0.1,"), 4, "the row has 3 values"),
        (with(csv, "0.02,0.1", "0.02,"), 4, "a cell is empty"),
        (with(csv, "0.02,0.1", "0.02,x"), 4, "\"x\" is no number; allowed is a number in every cell"),
        (with(csv, "0.02,0.1", "0.02,NaN"), 4, "\"NaN\" stands among the values"),
        (with(csv, "0.02,0.1", "0.02,inf"), 4, "\"inf\" stands among the values"),
        ("t_s;a_g\n0,00;0,1\n0,01;0.2\n0,02;0,1\n".to_owned(), 2, "a comma is among the digits, and line 3 has a decimal point"),
        ("# dt_s = 0.01\n\"a_cm_per_s2\"\n\"1,371\"\n\"3,371\"\n\"-2,100\"\n".to_owned(), 3, "the commas may be decimal ones, or group thousands"),
        ("t_s,a_g\n0,00,0,1\n0,01,0,2\n".to_owned(), 2, "write a point for the decimal comma, or separate the cells by semicolons"),
        (with(csv, "0.02,0.1", "\"0.02\",\"0.1"), 4, "a quote is not closed on its line"),
        (with(csv, "0.02,0.1", "0.02,\"0,1,2\""), 4, "\"0.1,2\" has a comma"),
        // K-NET
        (with(KNET, "Sampling Freq(Hz) 100Hz\n", ""), 0, "Sampling Freq is missing; allowed is the 17 lines of a K-NET header"),
        (with(KNET, "100Hz", "fast"), 11, "Sampling Freq is \"fast\""),
        (with(KNET, "3920(gal)/6182761", "3920(gal)"), 14, "Scale Factor is \"3920(gal)\""),
        (with(KNET, "3920(gal)", "3920(m)"), 14, "Scale Factor is"),
        (with(KNET, "Memo.\n", ""), 0, "this is K-NET ASCII, and the line \"Memo.\" that ends its header is missing"),
        (with(KNET, " 408003 ", " 40800x "), 18, "counts alone, after the header"),
        (with(KNET, " 408003 ", " 90408003 "), 18, "which is 52"),
        // V2
        (with(COSMOS, " 40 Real-header values follow on   8 lines, Format= (5F15.6)\n", ""), 12, "this is a COSMOS V2 file, and its header of real numbers is missing, so that the step is not known"),
        (with(COSMOS, "0.010000", "-999.000000"), 4, "its header of real numbers does not state the step"),
        (with(COSMOS, "units=cm/sec2", "units=counts"), 13, "the unit is not to be read in"),
        (with(COSMOS, "   5 acceleration", "   6 acceleration"), 16, "after 5 of 6 values"),
        (with(COSMOS, "acceleration pts", "velocity pts"), 13, "give the V2 file of accelerations"),
        (format!("{COSMOS}{COSMOS}"), 29, "a second channel begins in the same file; allowed is one channel a file"),
        (with(CSMIP, "accel data", "other data"), 6, "give the V2 file of accelerations"),
        // known, and not read
        ("2 CORRECTED ACCELEROGRAM\n".to_owned(), 1, "this is SMC (USGS), which is not read; allowed is PEER AT2"),
        ("Corrected accelerogram 20160214 GNS Science\n".to_owned(), 1, "this is GeoNet V1A or V2A"),
        (with(csv, "0.02,0.1", "0.01,0.1"), 4, "the time 0.01 s follows 0.01 s; allowed is times that rise"),
        (with(csv, "0.02,0.1", "0.005,0.1"), 4, "the time 0.005 s follows 0.01 s"),
        (with(csv, "0.03,0.0\n", ""), 5, "the times step by 0.020000 s from 0.02 s to 0.04 s"),
        (with(csv, "0.02,0.1", "0.022,0.1"), 4, "allowed is equal steps"),
        (with(csv, "t_s,a_g", "# dt_s = 0.005\nt_s,a_g"), 4, "the times step by 0.010000 s from 0 s to 0.01 s, and by 0.005000 s on the whole"),
        ("t_s,a_g\n0.0,0.1\n".to_owned(), 0, "there are fewer than two times"),
        ("t_s,a_g\n0.00,0.1\n0.01,0.2\n".to_owned(), 0, "the record has 2 values"),
        ("t_s,a_g\n0,0.1\n1,0.2\n2,0.1\n".to_owned(), 3, "the step is 1 s"),
        (with(three, "0.2,0.2,0.2", "0.2,0.2,60"), 4, "the peak is 60 g"),
        ("# dt_s = 0.01\nax_g,ay_g\n0,0\n0,0\n0,0\n".to_owned(), 0, "all values are 0"),
    ]
}

#[test]
fn every_malformed_file_is_refused_with_its_line_and_reason() {
    let cases = cases();
    assert!(cases.len() >= 70, "{}", cases.len());
    let mut wrong = Vec::new();
    for (text, line, piece) in cases {
        match read(&text) {
            Ok(_) => wrong.push(format!("taken, not refused for {piece:?}:\n{text}")),
            Err(fault) => {
                let said = fault.to_string();
                let place = if line == 0 { "record: ".to_owned() } else { format!("record:{line}: ") };
                if !said.starts_with(&place) || !said.contains(piece) {
                    wrong.push(format!("line {line} and {piece:?} expected, and said was\n  {said}"));
                }
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn files_that_are_no_text_fail_at_once_and_say_what_they_are() {
    let utf16: Vec<u8> = [0xff, 0xfe].into_iter().chain(AT2.bytes().flat_map(|byte| [byte, 0])).collect();
    let late = [vec![b' '; 100_000], vec![0]].concat();
    let cases: [(Vec<u8>, &str); 6] = [
        (b"PK\x03\x04rest".to_vec(), "this is a zip file; allowed is plain text; unpack it"),
        (b"\x1f\x8brest".to_vec(), "this is a gzip file"),
        (b"%PDF-1.4".to_vec(), "this is a PDF file"),
        (utf16, "the text is UTF-16; allowed is plain text; save it as UTF-8"),
        (b"\x7fELF\x02\x01\x01".to_vec(), "this is a binary file"),
        (late, "this is a binary file"),
    ];
    for (bytes, said) in cases {
        let found = open::of_bytes(bytes).unwrap_err().to_string();
        assert!(found.contains(said), "{found}");
    }
    // A name in the letters of an old machine harms no number.
    let latin = AT2.replace("Somewhere", "M?nchen").replace('?', "\u{1}").into_bytes();
    let latin: Vec<u8> = latin.into_iter().map(|byte| if byte == 1 { 0xfc } else { byte }).collect();
    let text = open::of_bytes([latin, VALUES.as_bytes().to_vec()].concat()).expect("text");
    assert_is_in_g(&read(&text).expect("a good record"));
}

#[test]
fn files_are_opened_named_and_limited() {
    let path = std::env::temp_dir().join(format!("pirca-record-{}", std::process::id()));
    std::fs::write(&path, format!("{AT2}{VALUES}")).expect("the folder can be written to");
    let motion = Motion::read(&path).expect("a good record");
    assert_is_in_g(&motion);
    assert_eq!(motion.name, path.display().to_string());
    // Sparse: it takes no room.
    let file = std::fs::File::create(&path).expect("the file can be written to");
    file.set_len((64 << 20) + 1).expect("it can be as long");
    let said = Motion::read(&path).unwrap_err().to_string();
    assert!(
        said.ends_with("the file is too large; allowed is at most 64 MiB; cut the record to its shaking"),
        "{said}"
    );
    std::fs::remove_file(&path).expect("the file can be removed");
    let fault = Motion::read(&path).unwrap_err();
    assert!(fault.found.starts_with("cannot be read") && fault.file == motion.name, "{fault}");
    let many = format!("# dt_s = 0.01\na_g\n{}", "1\n".repeat(2_000_001));
    let fault = read(&many).unwrap_err();
    assert_eq!((fault.line, fault.allowed.as_str()), (2_000_003, "at most 2000000"));
}

#[test]
fn a_zero_line_that_is_off_is_noted() {
    let rows: String = (0..100).map(|i| format!("{}\n", 0.01 + 0.1 * f64::from(i % 2))).collect();
    let motion = read(&format!("# dt_s = 0.01\na_g\n{rows}")).expect("it is taken");
    assert!(
        motion.notes[0].starts_with("the zero line is off or the record is cut: the base ends at 0.58"),
        "{:?}",
        motion.notes
    );
    let (count, said) = (motion.notes.len(), serde_json::to_string(&read("x").unwrap_err()).expect("texts"));
    assert!(count == 1 && said.contains("\"line\":1"), "{said}");
}
