//! What the arguments do to single blocks of the file: weights that rest on them, supports that go down.

use serde_json::{Value, json};

use crate::exchange::WallFile;
use crate::model::{Support, Wall};
use crate::protocol::Settlement;
use crate::solve::STANDARD_GRAVITY;
use crate::terminal::failure::Failure;

/// Ids listed in a message.
const LISTED: usize = 8;

/// The wall with the mean density (kg/m^3) of the blocks that move, where one is given: those of the file keep their ratios. And with
/// weights (N) on blocks: each makes its block as much heavier, at the block's centroid. What turns gravity turns them
/// and what pushes with a share of the weight pushes with theirs, as of a roof that goes with the wall.
pub(crate) fn loaded(file: &WallFile, density: Option<f64>, weights: &[(u64, f64)]) -> Result<Wall, Failure> {
    let mut wall = file.wall.clone();
    if let Some(density) = density {
        let free = || wall.blocks.iter().filter(|block| block.support != Support::Fixed);
        let mass: f64 = free().map(|block| block.mass()).sum();
        let volume: f64 = free().map(|block| block.volume()).sum();
        let factor = density * volume / mass;
        let moving = wall.blocks.iter_mut().filter(|block| block.support != Support::Fixed);
        moving.for_each(|block| block.density *= factor);
    }
    for (block, weight) in on_blocks(file, "--dead-load", "is fixed: it carries any load", false, weights)? {
        let block = &mut wall.blocks[block];
        block.density += weight / (STANDARD_GRAVITY * block.volume());
    }
    Ok(wall)
}

/// The supports that go down.
pub(crate) fn settlements(file: &WallFile, asked: &[(u64, f64)]) -> Result<Vec<Settlement>, Failure> {
    let found = on_blocks(file, "--settle", "is not fixed: it goes where its support goes", true, asked)?;
    let leads = file.wall.leads();
    for (later, (block, _)) in found.iter().enumerate() {
        if let Some((other, _)) = found[..later].iter().find(|(other, _)| leads[*other] == leads[*block]) {
            let [id, other] = [*block, *other].map(|at| file.ids[at]);
            return Err(Failure::Usage(format!(
                "--settle {id}: blocks {other} and {id} are parts of one body, which goes down as a whole: name one of them"
            )));
        }
    }
    Ok(found.into_iter().map(|(block, down)| Settlement { block, down }).collect())
}

/// Blocks by their ids in the file, each with its number: once each, all of them fixed or none.
fn on_blocks(
    file: &WallFile,
    option: &str,
    unfit: &str,
    fixed: bool,
    asked: &[(u64, f64)],
) -> Result<Vec<(usize, f64)>, Failure> {
    let is_fit = |at: usize| (file.wall.blocks[at].support == Support::Fixed) == fixed;
    let refused = |id: u64, what: String| {
        let fit: Vec<String> =
            (0..file.ids.len()).filter(|&at| is_fit(at)).map(|at| file.ids[at].to_string()).collect();
        let dots = if fit.len() > LISTED { ", ..." } else { "" };
        let kind = if fixed { "are fixed" } else { "move" };
        let listed = fit[..fit.len().min(LISTED)].join(", ");
        Failure::Usage(format!("{option} {id}: {what}; blocks that {kind}: {listed}{dots}"))
    };
    let mut found: Vec<(usize, f64)> = Vec::new();
    for &(id, number) in asked {
        let at = file.ids.iter().position(|own| *own == id);
        let at = at.ok_or_else(|| refused(id, format!("there is no block {id}")))?;
        if !is_fit(at) {
            return Err(refused(id, format!("block {id} {unfit}")));
        }
        if found.iter().any(|(other, _)| *other == at) {
            return Err(Failure::Usage(format!("{option} {id} is there twice: give each block one number")));
        }
        found.push((at, number));
    }
    Ok(found)
}

/// Numbers of blocks for the JSON object.
pub(crate) fn listed(asked: &[(u64, f64)], unit: &str) -> Value {
    asked.iter().map(|(id, number)| json!({ "block": id, unit: number })).collect()
}
