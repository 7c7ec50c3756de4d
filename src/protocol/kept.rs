//! What a wall must keep on its way from one state at rest to the next: a solver may find an equilibrium that the wall never
//! comes to.

use crate::solve::Assembly;
use crate::solve::joints::Joint;

/// Whether every block still touches one of those that it touched at rest before, or has moved by no more than the reach of
/// the contact search, as a block does that rattles in its place.
///
/// A block that has flown off and come down elsewhere is balanced there; the wall has fallen all the same. Blocks that are
/// taken out on the way hold nobody.
pub(super) fn keeps_contacts(before: &Assembly<'_>, after: &Assembly<'_>) -> bool {
    let (then, now) = (&before.bodies.all, &after.bodies.all);
    let gone = |block: u32| then[block as usize].moves() && !now[block as usize].moves();
    let touching = |assembly: &Assembly<'_>| -> Vec<(u32, u32)> {
        let joints = assembly.joints.all.iter().filter(|joint| joint.touches(&assembly.bodies.all));
        joints.map(Joint::pair).filter(|(a, b)| !gone(*a) && !gone(*b)).collect()
    };
    let former = touching(before);
    let mut bereft = vec![false; now.len()];
    let mut mark = |(a, b): (u32, u32), what| [a, b].map(|block| bereft[block as usize] = what);
    former.iter().for_each(|pair| {
        mark(*pair, true);
    });
    // Joints are in the order of their pairs.
    for pair in touching(after).into_iter().filter(|pair| former.binary_search(pair).is_ok()) {
        mark(pair, false);
    }
    let strayed = |block: usize| (now[block].position - then[block].position).norm() > after.contact.reach;
    (0..now.len()).all(|block| !(bereft[block] && now[block].moves() && strayed(block)))
}
