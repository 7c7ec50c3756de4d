//! A wall from elsewhere with its joints mended, and what was done in words.

use crate::exchange::{Fault, WallFaults, WallFile};
use crate::mend::{Mended, Moved, mend};
use crate::study::meetings::{above_a_tenth, entangled, length, stone_size};

/// Stones and pairs that are named.
const NAMED: usize = 5;

/// The wall with its faces mended within a length (m), its words among the warnings, and what was done; messages call the file `path`.
///
/// # Errors
/// A length above a tenth of a stone, and a wall too entangled to be looked over.
pub fn mended(file: &WallFile, within: f64, path: &str) -> Result<(WallFile, Mended), WallFaults> {
    let refused = |fault: Fault| {
        let mut faults = WallFaults::new(path);
        faults.push(fault);
        faults
    };
    let size = stone_size(&file.wall);
    if let Some(fault) = above_a_tenth("--mend", within, size, "about twice what corners are off") {
        return Err(refused(fault));
    }
    let done = mend(&file.wall, within).ok_or_else(|| refused(entangled()))?;
    let mut file = WallFile { wall: done.wall.clone(), ..file.clone() };
    file.warnings.extend(words(&file, &done, within));
    Ok((file, done))
}

/// How far corners may lie off their faces in a file whose joints are mended: what is to be mended warps faces as well.
pub fn wider(flatness: Option<f64>, mend: Option<f64>) -> Option<f64> {
    flatness.into_iter().chain(mend).reduce(f64::max)
}

/// What was done, and what was left.
fn words(file: &WallFile, done: &Mended, within: f64) -> Vec<String> {
    let names = |(a, b): &(usize, usize)| format!("{} and {}", file.names[*a], file.names[*b]);
    let several = |pairs: Vec<String>| {
        let more = pairs.len().saturating_sub(NAMED);
        let named = pairs[..pairs.len() - more].join("; ");
        if more > 0 { format!("{named}; and {more} more") } else { named }
    };
    let mut said = vec![did(file, done, within)];
    if !done.parted.is_empty() {
        said.push(format!(
            "faces within {} of each other that are no joint: one plane for all that meets there would move a corner further ({})",
            length(within),
            several(done.parted.iter().map(names).collect())
        ));
    }
    if !done.overlaps.is_empty() {
        let deep = |(pair, depth): &((usize, usize), f64)| format!("{} by {}", names(pair), length(*depth));
        let pairs = done.overlaps.iter().map(deep).collect();
        said.push(format!("blocks that overlap still: {}", several(pairs)));
    }
    said
}

fn did(file: &WallFile, done: &Mended, within: f64) -> String {
    let (faces, farthest) = done.moved;
    if done.stones.is_empty() {
        return format!(
            "nothing to mend within {}: faces that belong together are one plane already",
            length(within)
        );
    }
    let mut most: Vec<&Moved> = done.stones.iter().collect();
    most.sort_by(|a, b| b.moved_m.total_cmp(&a.moved_m).then(a.block.cmp(&b.block)));
    let named = most.iter().take(NAMED).map(|own| {
        let volume = percent(own.volume_share);
        format!("{} by {} (volume {volume})", file.names[own.block], length(own.moved_m))
    });
    let named: Vec<String> = named.collect();
    format!(
        "mended within {}: {faces} of {} faces moved by at most {}, the volume by {}; corners moved most: {}",
        length(within),
        done.faces,
        length(farthest),
        percent(done.volume_share),
        named.join(", ")
    )
}

/// A share in percent, with its sign.
fn percent(share: f64) -> String {
    format!("{:+.2} %", 100.0 * share)
}
