//! A wall from elsewhere with its joints mended, and what was done in words.

use crate::exchange::{Fault, WallFaults, WallFile};
use crate::mend::{Mended, Moved, mend};
use crate::study::meetings::{length, stone_size};

/// Largest length of mending, as a share of a stone's size: beyond it stones would get another shape.
const MOST: f64 = 0.1;
/// Stones and pairs that are named.
const NAMED: usize = 5;

/// The wall with its faces mended within a length (m), its words among the warnings, and what was done; messages call the file `path`.
///
/// # Errors
/// A length above a tenth of a stone, and a wall too entangled to be looked over.
pub fn mended(file: &WallFile, within: f64, path: &str) -> Result<(WallFile, Mended), WallFaults> {
    let refused = |found: String, allowed: String, fix: &str| {
        let mut faults = WallFaults::new(path);
        faults.push(Fault::of("", found, allowed, fix));
        faults
    };
    let most = MOST * stone_size(&file.wall);
    if within > most {
        return Err(refused(
            format!("--mend is {}", length(within)),
            format!("at most {}, a tenth of a stone", length(most)),
            "give a shorter one: about twice what corners are off",
        ));
    }
    let Some(done) = mend(&file.wall, within) else {
        return Err(refused(
            "the blocks are entangled: far too many of them overlap or nearly touch".to_owned(),
            "blocks that touch their neighbours only".to_owned(),
            "check the unit and whether blocks are there several times",
        ));
    };
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
