//! How thick the parts of an assembly are that stand apart from one another.

use std::collections::BTreeMap;

use crate::model::{Support, Wall};
use crate::shape::Hull;

/// For each block the thickness (m) of its pile: of all blocks that it hangs together with through blocks that can move, the least horizontal
/// width over all directions. 0 of blocks that cannot move. So what stands elsewhere, and how the wall lies in its axes, plays no part.
/// `joints` are the pairs of blocks that touch.
pub fn pile_thicknesses(wall: &Wall, joints: impl Iterator<Item = (usize, usize)>) -> Vec<f64> {
    let free = |block: usize| !matches!(wall.blocks[block].support, Support::Fixed | Support::Absent);
    // Each block points to another one of its pile with a lower number, the first one to itself.
    let mut towards = wall.leads();
    fn first(towards: &mut [usize], mut block: usize) -> usize {
        while towards[block] != block {
            towards[block] = towards[towards[block]];
            block = towards[block];
        }
        block
    }
    for (a, b) in joints.filter(|(a, b)| free(*a) && free(*b)) {
        let (a, b) = (first(&mut towards, a), first(&mut towards, b));
        towards[a.max(b)] = a.min(b);
    }
    let mut plans: BTreeMap<usize, Vec<[f64; 2]>> = BTreeMap::new();
    let pile: Vec<usize> = (0..wall.blocks.len()).map(|block| first(&mut towards, block)).collect();
    for (block, own) in wall.blocks.iter().enumerate().filter(|(block, _)| free(*block)) {
        plans.entry(pile[block]).or_default().extend(own.shape.vertices.iter().map(|v| [v.x, v.y]));
    }
    let widths: BTreeMap<usize, f64> =
        plans.into_iter().map(|(pile, plan)| (pile, Hull::of(plan).width())).collect();
    let of = |block: usize| if free(block) { widths.get(&pile[block]).copied().unwrap_or(0.0) } else { 0.0 };
    (0..wall.blocks.len()).map(of).collect()
}
