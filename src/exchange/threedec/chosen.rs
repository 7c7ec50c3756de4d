//! The blocks that the range of a 3DEC command chooses.

use crate::exchange::threedec::Stone;
use crate::exchange::threedec::lines::Word;
use crate::exchange::threedec::shape::name;

/// Share of a block's size by which it may reach over the end of a range: coordinates are rounded.
const ROUNDING: f64 = 1e-6;
/// What a block without a region may be in.
const UNSTATED: [i64; 2] = [0, 1];

/// What is known of the blocks that ranges go by.
#[derive(Clone, Copy, Debug)]
pub(super) struct Known {
    pub groups: bool,
    pub regions: bool,
}

/// For each block whether the words of a range choose it: all without any words, or those in a region, in a group and between coordinates, each if
/// it is asked for. `None` where that cannot be told exactly, as of ranges with names, of ids, and of a block that lies only in part between coordinates.
pub(super) fn chosen(words: &[Word<'_>], stones: &[Stone], known: Known) -> Option<Vec<bool>> {
    let mut all = vec![true; stones.len()];
    let mut rest = words.iter();
    while let Some(word) = rest.next() {
        let mut keep = |is_in: &dyn Fn(&Stone) -> Option<bool>| {
            for (own, stone) in all.iter_mut().zip(stones) {
                *own &= is_in(stone)?;
            }
            Some(())
        };
        if word.is("range", 3) {
            continue;
        }
        if word.is("region", 3) {
            let region: i64 = rest.next()?.text.parse().ok().filter(|_| known.regions)?;
            keep(&|stone| match stone.region {
                Some(own) => Some(own == region),
                None => (!UNSTATED.contains(&region)).then_some(false),
            })?;
        } else if word.is("group", 3) {
            let group = name(&mut rest).ok().filter(|_| known.groups)?;
            keep(&|stone| Some(stone.groups.contains(&group)))?;
        } else {
            let axis = axis(word)?;
            let (low, high) = (rest.next()?.number()?, rest.next()?.number()?);
            keep(&|stone| between(stone, axis, low, high))?;
        }
    }
    Some(all)
}

/// The axis of a range of coordinates.
fn axis(word: &Word<'_>) -> Option<usize> {
    let names = |letter: char| ["", "r", "range"].map(|end| format!("{letter}{end}"));
    let longer = |letter: char| ["pos-", "position-"].map(|first| format!("{first}{letter}"));
    let own =
        |letter: char| names(letter).into_iter().chain(longer(letter)).any(|name| word.is(&name, name.len()));
    ['x', 'y', 'z'].into_iter().position(own)
}

/// Whether a block lies between two coordinates; `None` of one that does in part.
fn between(stone: &Stone, axis: usize, low: f64, high: f64) -> Option<bool> {
    let along = || stone.mesh.vertices.iter().map(|corner| corner[axis]);
    let (first, last) = (along().fold(f64::INFINITY, f64::min), along().fold(f64::NEG_INFINITY, f64::max));
    let rounding = ROUNDING * (last - first);
    if first >= low - rounding && last <= high + rounding {
        return Some(true);
    }
    (last <= low + rounding || first >= high - rounding).then_some(false)
}
