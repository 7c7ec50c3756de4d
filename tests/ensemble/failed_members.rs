//! A member that fails is a row with a reason, counted and never dropped.

use polars_io::prelude::{ParquetReader, SerReader};

use crate::fixture::{Folder, changed, stderr};

/// No stone may be longer than 1.5 times its width, corner to corner (a cube has 1.73): every wall of the random arm is
/// an invalid geometry.
fn impossible() -> String {
    let dip = "dip_deg = { family = \"uniform\", low = -3, high = 3 }";
    changed(dip, &format!("{dip}\nlimits = {{ max_aspect = 1.5, max_attempts = 3, max_redraws = 5 }}"))
}

#[test]
fn walls_that_cannot_be_built_are_rows_and_are_counted() {
    let folder = Folder::with_study(&impossible());
    let output = folder.pirca(&["run", "studies/tiny", "--out", "out", "--json"]);
    assert!(output.status.success(), "a failed wall is a result: {}", stderr(&output));

    let table = std::fs::File::open(folder.path("out/members.parquet")).unwrap();
    let table = ParquetReader::new(table).finish().unwrap();
    let text = |name: &str| -> Vec<String> {
        // A wall that stands has no reason.
        table.column(name).unwrap().str().unwrap().iter().map(|x| x.unwrap_or_default().to_string()).collect()
    };
    let (arms, outcomes, reasons) = (text("arm"), text("outcome"), text("reason"));
    assert_eq!(arms.iter().filter(|arm| *arm == "random").count(), 2 * 8, "no wall is missing");
    for i in (0..arms.len()).filter(|&i| arms[i] == "random") {
        assert_eq!(outcomes[i], "invalid_geometry");
        assert!(reasons[i].contains("3 attempts"), "{}", reasons[i]);
    }
    let attempts: Vec<u64> = table.column("attempts").unwrap().u64().unwrap().iter().flatten().collect();
    assert_eq!(attempts.iter().filter(|&&n| n == 3).count(), 2 * 8);
    let top = table.column("top_displacement_m").unwrap();
    assert_eq!(top.null_count(), 2 * 8, "what was not observed is null, not zero");

    let summary: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let random: Vec<_> =
        summary["arms"].as_array().unwrap().iter().filter(|arm| arm["arm"] == "random").collect();
    assert_eq!(random.len(), 2, "one entry per kn");
    for arm in random {
        assert_eq!(arm["outcomes"]["invalid_geometry"], 8);
        assert!(arm["mean"].is_null() && arm["sigma"].is_null());
    }
}
