//! Holes: contours of a path within others of the same path.

use crate::exchange::drawing::frame::Extent;
use crate::shape::encloses;

/// Contours around one another that are counted.
const DEEPEST: usize = 64;

/// Which contours are holes: those within an odd number of others.
pub(super) fn holes(contours: &[Vec<[f64; 2]>]) -> Vec<bool> {
    let extents: Vec<Extent> = contours.iter().map(Extent::of).collect();
    let mut order: Vec<usize> = (0..contours.len()).collect();
    order.sort_by(|a, b| extents[*a].low[0].total_cmp(&extents[*b].low[0]).then(a.cmp(b)));
    let mut is_hole = vec![false; contours.len()];
    // Those that reach as far as the one in hand; what is around it begins farther left.
    let mut open: Vec<usize> = Vec::new();
    for i in order {
        let inner = &extents[i];
        open.retain(|j| extents[*j].high[0] >= inner.low[0]);
        let around = |j: &&usize| {
            let outer = &extents[**j];
            let reaches = (0..2).all(|k| outer.low[k] <= inner.low[k] && inner.high[k] <= outer.high[k]);
            reaches && outer != inner && contours[i].first().is_some_and(|p| encloses(&contours[**j], *p))
        };
        is_hole[i] = open.iter().filter(around).take(DEEPEST).count() % 2 == 1;
        open.push(i);
    }
    is_hole
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_second_square_within_another_is_a_hole() {
        let square = |x: f64, r: f64| vec![[x - r, -r], [x + r, -r], [x + r, r], [x - r, r]];
        let all = [square(0.0, 1.0), square(0.0, 3.0), square(5.0, 1.0), square(0.0, 2.0), square(0.0, 3.0)];
        assert_eq!(holes(&all[..4]), [false, false, false, true]);
        // The same square twice is no hole.
        assert_eq!(holes(&all[4..]), [false]);
        assert_eq!(holes(&[square(0.0, 3.0), square(0.0, 3.0)]), [false, false]);
    }
}
