//! Measurements as spreadsheets write them: separators, decimals, line ends, empty rows and columns, a row per tilt.

use pirca::math::radians;
use pirca::study::{MeasuredKind, MeasuredQuantity, Measurement};

use crate::measured::{GOOD, load};
use crate::scratch::Scratch;

const MEASURED: &str = "studies/base/measured.csv";
const HEADER: &str = "specimen,family,tilt_deg,quantity,value,unit,error,kind\n";

/// Rows of a long table with decimals and signs, to be written in every way.
const ROWS: &[&[&str]] = &[
    &["specimen", "family", "tilt_deg", "quantity", "value", "unit", "error", "kind", "resolution"],
    &["A1", "laid", "", "collapse_angle", "13.5", "deg", "0.1", "rounded", "0.5"],
    &["A1", "laid", "2.5", "displacement_mean", "1.25", "mm", "3e-1", "exact", ""],
    &["Wand \u{fc}ber, \"2\"; rechts", "hewn", "5", "displacement_left", "-0.75", "mm", ".5", "exact", ""],
];

fn written(separator: char, decimal: char, end: &str) -> String {
    let cell = |text: &&str| {
        let text = if text.parse::<f64>().is_ok() {
            text.replace('.', &decimal.to_string())
        } else {
            (*text).to_owned()
        };
        let is_plain = !text.contains([separator, '"']);
        if is_plain { text } else { format!("\"{}\"", text.replace('"', "\"\"")) }
    };
    let row = |row: &&[&str]| row.iter().map(cell).collect::<Vec<_>>().join(&separator.to_string()) + end;
    ROWS.iter().map(row).collect()
}

/// Without the lines, of which a file may have more.
fn read(name: &str, text: &str) -> Vec<Measurement> {
    let found = load(name, text).unwrap_or_else(|faults| panic!("{faults}\nin {text:?}"));
    found.into_iter().map(|m| Measurement { line: 0, ..m }).collect()
}

#[test]
fn every_way_of_writing_a_table_says_the_same() {
    let plain = read("dialect", &written(',', '.', "\n"));
    assert_eq!((plain.len(), plain[0].value, plain[2].value), (3, radians(13.5), -0.75e-3));
    assert_eq!(plain[2].specimen, "Wand \u{fc}ber, \"2\"; rechts");
    for (separator, decimal) in [(',', '.'), (';', '.'), (';', ','), ('\t', '.'), ('\t', ',')] {
        for end in ["\n", "\r\n", "\r"] {
            let text = written(separator, decimal, end);
            let empty = separator.to_string().repeat(8);
            let wider = text.replace(end, &format!("{separator}{separator}{end}"));
            let told = |line: &str| format!("{line}{end}{text}");
            for (how, text) in [
                ("as it is", text.clone()),
                ("with a byte order mark", format!("\u{feff}{text}")),
                ("with the separator told", told(&format!("sep={separator}"))),
                ("with it told behind a byte order mark", told(&format!("\u{feff}sep={separator}"))),
                ("with it told, saved as a row", told(&format!("\"sep={separator}\"{empty}"))),
                ("with it told wrongly", told("sep=|")),
                ("with rows of separators", text.replace(end, &format!("{end}{empty}{end} {empty} {end}"))),
                ("with quoted nothing", text.replace(end, &format!("{end}\"\"{separator}\"\"{end}"))),
                ("with a comment that was a cell", told(&format!("\"# of May, {separator}\"{empty}"))),
                ("with empty columns", wider),
                ("without the last line's end", text.trim_end().to_owned()),
                // A spreadsheet may leave out what is empty at the end of a row, or hold more than the header.
                ("with short rows", text.replace(&format!("exact{separator}{end}"), &format!("exact{end}"))),
                // But for commas, where it would hide that one stands for a decimal point.
                (
                    "with long rows",
                    match separator {
                        ',' => text.clone(),
                        _ => text.replace(&format!("exact{separator}"), &format!("exact{separator}{empty}")),
                    },
                ),
                (
                    "in capitals",
                    text.replacen("specimen", "Specimen", 1).replacen("tilt_deg", "Tilt (deg)", 1),
                ),
            ] {
                let found = read("dialect", &text);
                assert_eq!(found, plain, "{separator:?} {decimal:?} {end:?} {how}: {text:?}");
            }
        }
    }
}

/// What a spreadsheet calls Unicode text.
#[test]
fn text_in_utf_16_is_read() {
    let plain = read("utf-16", &written('\t', ',', "\r\n"));
    let text = format!("\u{feff}{}", written('\t', ',', "\r\n"));
    let bytes = |of: fn(u16) -> [u8; 2]| text.encode_utf16().flat_map(of).collect::<Vec<u8>>();
    for bytes in [bytes(u16::to_le_bytes), bytes(u16::to_be_bytes)] {
        let scratch = Scratch::new("utf-16");
        scratch.write(MEASURED, &bytes);
        let found = scratch.load(None).unwrap_or_else(|faults| panic!("{faults}")).study.measured;
        assert_eq!(found.into_iter().map(|m| Measurement { line: 0, ..m }).collect::<Vec<_>>(), plain);
        // Half a character is no text.
        scratch.write(MEASURED, &bytes[..bytes.len() - 1]);
        let refused = scratch.load(None).expect_err("cut").to_string();
        assert!(refused.contains("measured.csv:1: is not UTF-8"), "{refused}");
    }
}

/// The line and the column of a fault are those that an editor shows.
#[test]
fn places_are_those_of_the_users_file() {
    for (text, line, column) in [
        (
            "\u{feff}specimen;family;tilt_deg;quantity;value;unit;error;kind;sped\n".to_owned() + "A;laid\n",
            1,
            57,
        ),
        (written(';', ',', "\r").replace("1,25", "1,2x"), 3, 31),
        (written('\t', ',', "\r\n").replace("1,25", "1,2x"), 3, 31),
        (format!("\u{feff}sep=;\r{}", written(';', ',', "\r").replace("1,25", "1,2x")), 4, 31),
        (format!("\u{feff}sep=;\n\n;;;\n{}", written(';', ',', "\n").replace("-0,75", "-0,7x")), 7, 53),
    ] {
        let scratch = Scratch::new("places");
        scratch.write(MEASURED, text.as_bytes());
        let faults = scratch.load(None).expect_err("a fault").faults;
        let fault = faults.iter().find(|fault| fault.column > 1).unwrap_or_else(|| panic!("{faults:?}"));
        assert_eq!((fault.line, fault.column), (line, column), "{text:?}: {fault}");
        // The carets stand under the cell.
        let (shown, marks) = fault.excerpt.split_once('\n').expect("two lines");
        let at = marks.chars().position(|c| c == '^').expect("carets");
        let wrong: String = shown.chars().skip(at).take(marks.matches('^').count()).collect();
        assert!(["sped", "1,2x", "-0,7x"].contains(&wrong.as_str()), "{fault}");
    }
}

/// Commas that separate cells and decimals as well, in forty rows: one fault with their lines.
#[test]
fn an_ambiguous_file_has_one_clear_fault() {
    let row = |k: usize, value: &str| format!("A,laid,{k},displacement_left,{value},mm,1,exact\n");
    let forty = |value: &str| HEADER.to_owned() + &(1..=40).map(|k| row(k, value)).collect::<String>();
    for (text, parts) in [
        (
            forty("0,46"),
            [
                "measured.csv:2: has 9 cells: allowed is 8, as in the header; write decimals with a point, or separate the cells by semicolons",
                "(so in lines 3 to 41 as well)",
            ],
        ),
        (
            forty("\"0,46\""),
            [
                "measured.csv:2: value = 0,46: allowed is a number within -100 to 100 (m); write a point for the decimal comma, or separate",
                "(so in lines 3 to 41 as well)",
            ],
        ),
        (
            forty("0.46").replace(',', ";").replacen("0.46", "0,46", 1),
            [
                "measured.csv:2: has a decimal comma in 0,46, and a decimal point in 0.46 of line 3: allowed is decimals of one kind",
                "all with a comma",
            ],
        ),
        (
            forty("0.46").replace(',', "\t").replacen("0.46", "1,371.5", 1),
            ["measured.csv:2: value = 1,371.5", "write the number without separators of thousands"],
        ),
        (forty("46").replace("mm", "inch"), ["measured.csv:2: unit = inch", "(so in lines 3 to 41 as well)"]),
    ] {
        let listing = load("ambiguous", &text).expect_err("a fault");
        assert!(
            listing.starts_with("1 fault in the input:\n") && parts.iter().all(|part| listing.contains(part)),
            "{listing}"
        );
    }
}

/// Rows of a template that nobody filled in: no reading; told, unless the wall had fallen.
#[test]
fn rows_without_a_value_are_read_over_and_told() {
    let with = |rows: &str| {
        let scratch = Scratch::new("unfilled");
        scratch.write(MEASURED, format!("{HEADER}{rows}").as_bytes());
        scratch.load(None)
    };
    let rows = "A,laid,,collapse_angle,13.5,deg,1,exact\nA,laid,10,displacement_left,,mm,,exact\n\
                A,laid,15,displacement_left,,mm,,exact\nB,laid,15,displacement_left,,mm,,exact\nA,laid,5,displacement_left,1,mm,1,exact\n";
    let loaded = with(rows).unwrap_or_else(|faults| panic!("{faults}"));
    assert_eq!(loaded.study.measured.len(), 2);
    let written = loaded.written.expect("it is there");
    assert_eq!(written.unfilled, [3, 4, 5]);
    let told: Vec<String> =
        loaded.warnings.iter().map(ToString::to_string).filter(|w| w.contains("measured")).collect();
    assert!(
        told.len() == 1
            && told[0].starts_with("measured.csv:3: has no value and is read over: ")
            && told[0].contains("(so in line 5 as well)"),
        "{told:?}"
    );
    let none = with("A,laid,10,displacement_left,,mm,,exact\n,,,,,,,\n").expect_err("nothing").to_string();
    assert!(none.starts_with("1 fault in the input:\nmeasured.csv: has no rows with a value"), "{none}");
}

/// A wide table, in units of its own and with errors of its own, beside the long one that says the same.
#[test]
fn a_row_per_tilt_says_what_a_row_per_value_says() {
    let long = read(
        "wide",
        "specimen,family,tilt_deg,quantity,value,unit,error,kind,common_error,resolution,order,stage\n\
         A,laid,5,displacement_left,1.5,mm,0.2,exact,0.1,,1,0\n\
         A,laid,5,displacement_centre,2.5,mm,0.2,below,0.1,,1,0\n\
         A,laid,5,displacement_mean,2,mm,0.1,exact,0.1,,1,0\n\
         A,laid,,collapse_angle,13.5,deg,0,rounded,,0.5,1,0\n\
         A,laid,10,displacement_left,3,mm,0.2,exact,0.1,,1,0\n\
         B,hewn,10,displacement_right,30,mm,0.2,above,0.1,,2,0\n\
         B,hewn,,collapse_angle,40,deg,0,above,,,2,0\n",
    );
    let header = "Specimen;Family;Tilt (deg);left;centre;Right;mean;unit;error;common_error;mean_error;collapse_angle_deg;collapse_angle_error;collapse_angle_resolution;order;stage\n";
    let rows = "A;laid;5;1,5;<2,5;;2;mm;0,2;0,1;0,1;13,5;0;0,5;1;0\n\
                A;laid;10;3;;;;mm;0,2;0,1;0,1;13,5;0;0,5;1;0\n\
                ;;;;;;;;;;;;;;;\n\
                A;laid;15;;;;;mm;0,2;0,1;;;;;1;0\n\
                B;hewn;10;;;> 30;;mm;0,2;0,1;;>40;0;0,5;2;0\n";
    let shared = read("wide", &format!("{header}{rows}"));
    let by_line = |mut rows: Vec<Measurement>| {
        rows.sort_by(|a, b| {
            (&a.specimen, a.quantity, a.tilt.map(f64::to_bits)).cmp(&(
                &b.specimen,
                b.quantity,
                b.tilt.map(f64::to_bits),
            ))
        });
        rows
    };
    assert_eq!(by_line(shared.clone()), by_line(long.clone()));
    // The units in the names of the columns, in cm; the unit's column is not needed then.
    let named = header
        .replace(
            "left;centre;Right;mean;unit;error;common_error",
            "displacement_left [cm];centre_cm;Right (cm);mean_cm;;error_cm;common_error (cm)",
        )
        .replace("mean_error", "mean_error_cm");
    let tenth = rows
        .replace("1,5;<2,5;;2;mm", "0,15;<0,25;;0,2;")
        .replace(";3;", ";0,3;")
        .replace("> 30", "> 3")
        .replace(";mm;", ";;");
    let tenth = tenth
        .replace("0,2;0,1;0,1", "0,02;0,01;0,01")
        .replace("0,2;0,1;;", "0,02;0,01;;")
        .replace(";2;;0,02", ";0,2;;0,02");
    let named = by_line(read("wide", &format!("{named}{tenth}")));
    for (a, b) in named.iter().zip(by_line(long)) {
        assert_eq!((a.quantity, a.kind, a.value, a.tilt), (b.quantity, b.kind, b.value, b.tilt));
        assert_eq!((a.error, a.common_error, a.resolution), (b.error, b.common_error, b.resolution));
    }
    assert_eq!(named.len(), 7);
}

/// What remains and the stages of a wide table: as in a long one; a collapse angle in each row counts where it stands last.
#[test]
fn a_wide_table_has_stages_and_remainders() {
    let found = read(
        "wide-stages",
        "specimen,family,tilt_deg,mean_mm,error_mm,collapse_angle_deg,collapse_angle_error,stage\n\
         A,laid,8,3,0.1,14,0.1,0\nA,laid,0,0.3,0.1,14,0.1,1\nA,laid,12,6,0.1,14,0.1,2\n",
    );
    let read: Vec<(MeasuredQuantity, u32)> = found.iter().map(|m| (m.quantity, m.stage)).collect();
    use MeasuredQuantity as Q;
    assert_eq!(
        read,
        [(Q::DisplacementMean, 0), (Q::CollapseAngle, 2), (Q::RemainderMean, 1), (Q::DisplacementMean, 2)]
    );
    assert!(found.iter().all(|m| m.kind == MeasuredKind::Exact));
}

/// What is wrong with a wide table: the header, a row, and what the file must hold.
#[test]
fn faults_of_a_wide_table_are_named_by_its_own_columns() {
    const WIDE: &str = "specimen,family,tilt_deg,left_mm,right_mm,error_mm,collapse_angle_deg,collapse_angle_error\n\
                        A,laid,5,1.5,1.7,0.2,13.5,0.1\nA,laid,10,3,3.5,0.2,,\n";
    let cases: &[(&str, &str, &[&str])] = &[
        (
            "right_mm",
            "right_cm",
            &["csv:1: error_mm is not in the unit of right_cm: allowed is one unit for the values"],
        ),
        ("error_mm", "error", &["taken"]),
        (
            "left_mm,right_mm,error_mm",
            "left_mm,right_cm,error",
            &["csv:1: error is not in the unit of left_mm"],
        ),
        ("left_mm", "left", &["csv:1: unit is missing", "csv:1: error_mm is not in the unit of left"]),
        ("left_mm", "left_km", &["csv:1: left_km is not a known column"]),
        ("right_mm", "displacement_left_mm", &["csv:1: displacement_left_mm is a column twice"]),
        ("right_mm", "centre_error", &["csv:1: centre_error has no column displacement_centre beside it"]),
        (
            "collapse_angle_deg",
            "collapse_angle",
            &[
                "csv:1: collapse_angle does not say its unit: allowed is one of collapse_angle_deg, collapse_angle_rad; call it",
            ],
        ),
        ("tilt_deg,", "order,", &["csv:1: tilt_deg is missing"]),
        (",collapse_angle_error", ",order", &["csv:1: collapse_angle_error is missing: allowed is a column"]),
        (",error_mm", ",order", &["csv:1: error is missing"]),
        ("specimen,", "stage,", &["csv:1: specimen is missing"]),
        ("1.5", "1.5x", &["csv:2: left_mm = 1.5x: allowed is a number within -100 to 100 (m)"]),
        ("1.5", "~1", &["csv:2: left_mm = ~1"]),
        ("0.2,13.5,0.1", "0.2,13.5,", &["csv:2: collapse_angle_error is missing"]),
        ("0.2,13.5,0.1", ",13.5,0.1", &["csv:2: error_mm is missing"]),
        ("A,laid,5", "A,layed,5", &["1 fault", "csv:2: family = layed"]),
        ("A,laid,5", "A,laid,", &["1 fault", "csv:2: tilt_deg is missing"]),
        ("0.2,,\n", "0.2,14,0.1\n", &["csv:3: quantity collapse_angle of A was read in line 2 already"]),
        ("A,laid,10", "A,laid,5", &["csv:3: quantity displacement_left of A was read in line 2 already"]),
        ("A,laid,10", "A,laid,15", &["csv:3: tilt_deg 15 deg is above the collapse angle of A"]),
    ];
    let mut wrong = Vec::new();
    for (from, to, parts) in cases {
        assert!(WIDE.contains(from), "{from}");
        let listing =
            load("wide-faults", &WIDE.replacen(from, to, 1)).err().unwrap_or_else(|| "taken".to_owned());
        let missing: Vec<_> = parts.iter().filter(|part| !listing.contains(**part)).collect();
        if !missing.is_empty() {
            wrong.push(format!("{from} -> {to}: no {missing:?} in\n{listing}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert!(load("wide-faults", GOOD).is_ok() && load("wide-faults", WIDE).is_ok());
}
