//! The joints of a drawing or a picture that were closed, as they are told: in a table of the page, in a file.

use crate::exchange::WallFile;
use crate::render::csv::Csv;
use crate::render::number::significant;

/// Columns of `closed-joints.csv`.
const COLUMNS: &str = "block_a,block_b,gap_mean_m,gap_largest_m,length_m,area_share_a,area_share_b";
/// Heads of the table on the page.
pub(crate) const HEADS: &[&str] = &[
    "between",
    "and",
    "gap mean mm",
    "gap at most mm",
    "length mm",
    "area of the first %",
    "of the second %",
];
/// Digits of the lengths in the table.
const DIGITS: usize = 3;

/// The rows of the table on the page, the widest gap first; none where no joint was closed.
pub(crate) fn rows(file: &WallFile) -> Vec<Vec<String>> {
    let Some(drawn) = &file.drawn else { return Vec::new() };
    let mut joints = drawn.joints.clone();
    joints.sort_by(|a, b| b.widths[1].total_cmp(&a.widths[1]).then(a.stones.cmp(&b.stones)));
    let rows = joints.iter().map(|joint| {
        let (a, b) = joint.stones;
        let names = [a, b].map(|at| file.names[at].clone());
        let [mean, largest] = joint.widths;
        let lengths = [mean, largest, joint.length].map(|x| significant(1e3 * x, DIGITS));
        let areas = [a, b].map(|at| format!("{:+.2}", 100.0 * drawn.gained[at]));
        names.into_iter().chain(lengths).chain(areas).collect()
    });
    rows.collect()
}

/// The file, with all digits; `None` where no joint was closed.
pub(crate) fn csv(file: &WallFile) -> Option<String> {
    let drawn = file.drawn.as_ref().filter(|drawn| !drawn.joints.is_empty())?;
    let mut csv = Csv::new(COLUMNS);
    for joint in &drawn.joints {
        let (a, b) = joint.stones;
        let [mean, largest] = joint.widths;
        csv.line(&[
            &file.ids[a],
            &file.ids[b],
            &mean,
            &largest,
            &joint.length,
            &drawn.gained[a],
            &drawn.gained[b],
        ]);
    }
    Some(csv.text())
}
