//! What mending did, as it is told: in the JSON object, in a table of the page, in a file.

use serde_json::{Value, json};

use crate::exchange::WallFile;
use crate::mend::{Mended, Moved};
use crate::render::csv::Csv;
use crate::render::number::significant;

/// Columns of `mended.csv`.
const COLUMNS: &str = "block,name,moved_m,volume_share";
/// Heads of the table on the page.
pub(crate) const HEADS: &[&str] = &["block", "name", "corners moved by at most mm", "volume %"];

/// In the JSON object: blocks by their ids, lengths in m.
pub(crate) fn object(file: &WallFile, done: &Mended, within: Option<f64>) -> Value {
    let id = |block: usize| file.ids[block];
    let stone = |own: &Moved| json!({ "id": id(own.block), "moved_m": own.moved_m, "volume_share": own.volume_share });
    let parted: Vec<[u64; 2]> = done.parted.iter().map(|(a, b)| [id(*a), id(*b)]).collect();
    let overlap =
        |((a, b), depth): &((usize, usize), f64)| json!({ "blocks": [id(*a), id(*b)], "depth_m": depth });
    json!({
        "within_m": within, "faces": done.faces, "faces_moved": done.moved.0, "moved_m": done.moved.1,
        "volume_share": done.volume_share, "stones": done.stones.iter().map(stone).collect::<Vec<_>>(),
        "parted": parted, "overlaps": done.overlaps.iter().map(overlap).collect::<Vec<_>>(),
    })
}

/// The rows of the table on the page, the stone that moved most first.
pub(crate) fn rows(file: &WallFile, done: &Mended) -> Vec<Vec<String>> {
    let mut stones = done.stones.clone();
    stones.sort_by(|a, b| b.moved_m.total_cmp(&a.moved_m).then(a.block.cmp(&b.block)));
    let row = |own: &Moved| {
        let (moved, volume) =
            (significant(1e3 * own.moved_m, 3), format!("{:+.2}", 100.0 * own.volume_share));
        vec![file.ids[own.block].to_string(), file.names[own.block].clone(), moved, volume]
    };
    stones.iter().map(row).collect()
}

/// The file, with all digits.
pub(crate) fn csv(file: &WallFile, done: &Mended) -> String {
    let mut csv = Csv::new(COLUMNS);
    for own in &done.stones {
        csv.line(&[&file.ids[own.block], &file.names[own.block], &own.moved_m, &own.volume_share]);
    }
    csv.text()
}
