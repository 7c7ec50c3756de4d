//! Which spheres are near one another and near the planes: a grid of cells as large as the largest sphere.

use crate::math::Vec3;
use crate::shape::Plane;
use crate::solve::grains::heap::Spheres;

/// Half of the 26 cells around a cell, so that every pair of cells is looked at once.
const HALF: [[i64; 3]; 13] = [
    [1, 0, 0],
    [-1, 1, 0],
    [0, 1, 0],
    [1, 1, 0],
    [-1, -1, 1],
    [0, -1, 1],
    [1, -1, 1],
    [-1, 0, 1],
    [0, 0, 1],
    [1, 0, 1],
    [-1, 1, 1],
    [0, 1, 1],
    [1, 1, 1],
];

/// Pairs of near spheres of different bodies, and spheres near planes; both sorted.
#[derive(Clone, Debug, Default)]
pub struct Neighbours {
    /// The smaller number first.
    pub pairs: Vec<[u32; 2]>,
    /// Sphere, plane.
    pub seats: Vec<[u32; 2]>,
    /// Cell of each sphere.
    cell: Vec<u32>,
    /// Where each cell begins in `order`, and one beyond the last.
    begins: Vec<u32>,
    /// Spheres by cell, then by number.
    order: Vec<u32>,
}

/// A grid of cubes over a box.
struct Grid {
    low: Vec3,
    size: f64,
    counts: [i64; 3],
}

impl Grid {
    /// Cells of at least `size` (m) over all centres; larger ones where there would be far more of them than spheres.
    fn over(centres: &[Vec3], size: f64) -> Grid {
        let low = centres.iter().fold(Vec3::repeat(f64::INFINITY), |low, c| low.inf(c));
        let high = centres.iter().fold(Vec3::repeat(f64::NEG_INFINITY), |high, c| high.sup(c));
        let extent = high - low;
        let most = 64.0 + 8.0 * centres.len() as f64;
        let mut size = size;
        while extent.iter().map(|e| (e / size).floor() + 1.0).product::<f64>() > most {
            size *= 2.0;
        }
        let counts = [0, 1, 2].map(|k| (extent[k] / size).floor() as i64 + 1);
        Grid { low, size, counts }
    }

    /// The cell of a point within the box.
    fn cell(&self, at: &Vec3) -> u32 {
        let index =
            |k: usize| (((at[k] - self.low[k]) / self.size).floor() as i64).clamp(0, self.counts[k] - 1);
        ((index(2) * self.counts[1] + index(1)) * self.counts[0] + index(0)) as u32
    }

    fn len(&self) -> usize {
        self.counts.iter().product::<i64>() as usize
    }

    /// The cell beside a cell, if the box reaches so far.
    fn beside(&self, cell: usize, step: [i64; 3]) -> Option<usize> {
        let [nx, ny, nz] = self.counts;
        let cell = cell as i64;
        let at = [cell % nx + step[0], cell / nx % ny + step[1], cell / (nx * ny) + step[2]];
        let inside = at.iter().zip([nx, ny, nz]).all(|(&x, n)| (0..n).contains(&x));
        inside.then_some(((at[2] * ny + at[1]) * nx + at[0]) as usize)
    }
}

impl Neighbours {
    /// Finds all pairs of spheres of different bodies, and of spheres and planes, that are up to `skin` (m) beyond
    /// touching. All centres must be finite.
    pub fn look(&mut self, spheres: &Spheres, planes: &[Plane], skin: f64) {
        self.pairs.clear();
        self.seats.clear();
        let largest = spheres.radius.iter().fold(0.0f64, |a, &r| a.max(r));
        let grid = Grid::over(&spheres.centre, 2.0 * largest + skin);
        self.sort(&grid, &spheres.centre);
        for cell in 0..grid.len() {
            let range = |cell: usize| self.begins[cell] as usize..self.begins[cell + 1] as usize;
            let own = &self.order[range(cell)];
            for (k, &i) in own.iter().enumerate() {
                add_near(&mut self.pairs, spheres, skin, i, &own[k + 1..]);
            }
            if own.is_empty() {
                continue;
            }
            for step in HALF {
                if let Some(other) = grid.beside(cell, step) {
                    let others = &self.order[range(other)];
                    for &i in own {
                        add_near(&mut self.pairs, spheres, skin, i, others);
                    }
                }
            }
        }
        self.pairs.sort_unstable();
        for (i, (centre, radius)) in (0u32..).zip(spheres.centre.iter().zip(&spheres.radius)) {
            for (p, plane) in (0u32..).zip(planes) {
                if plane.distance(centre) < radius + skin {
                    self.seats.push([i, p]);
                }
            }
        }
    }

    /// Sorts the spheres by cell, by counting.
    fn sort(&mut self, grid: &Grid, centres: &[Vec3]) {
        self.cell.clear();
        self.cell.extend(centres.iter().map(|c| grid.cell(c)));
        self.begins.clear();
        self.begins.resize(grid.len() + 1, 0);
        for &cell in &self.cell {
            self.begins[cell as usize + 1] += 1;
        }
        for k in 1..self.begins.len() {
            self.begins[k] += self.begins[k - 1];
        }
        self.order.clear();
        self.order.resize(centres.len(), 0);
        // Filled from behind, so that the beginnings come out again as they were.
        for (i, &cell) in self.cell.iter().enumerate().rev() {
            let end = &mut self.begins[cell as usize + 1];
            *end -= 1;
            self.order[*end as usize] = i as u32;
        }
        self.begins.remove(0);
        self.begins.push(centres.len() as u32);
    }
}

/// Adds the pairs of one sphere with others.
fn add_near(pairs: &mut Vec<[u32; 2]>, spheres: &Spheres, skin: f64, i: u32, others: &[u32]) {
    let (centre, radius, body) =
        (spheres.centre[i as usize], spheres.radius[i as usize], spheres.body[i as usize]);
    for &j in others {
        let reach = radius + spheres.radius[j as usize] + skin;
        let near = (spheres.centre[j as usize] - centre).norm_squared() < reach * reach;
        if near && spheres.body[j as usize] != body {
            pairs.push([i.min(j), i.max(j)]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A reproducible scatter without a generator: fractional parts of multiples of irrational numbers.
    fn scattered(count: u32, extent: [f64; 3]) -> Spheres {
        let part = |k: u32, root: f64| (f64::from(k) * root.sqrt()).fract();
        let at =
            |k: u32| Vec3::new(part(k, 2.0) * extent[0], part(k, 3.0) * extent[1], part(k, 5.0) * extent[2]);
        Spheres {
            centre: (0..count).map(at).collect(),
            local: Vec::new(),
            radius: (0..count).map(|k| 0.02 + 0.02 * part(k, 7.0)).collect(),
            body: (0..count).map(|k| k / 2).collect(),
        }
    }

    fn by_hand(spheres: &Spheres, skin: f64) -> Vec<[u32; 2]> {
        let n = spheres.radius.len();
        let near = |&(i, j): &(usize, usize)| {
            let reach = spheres.radius[i] + spheres.radius[j] + skin;
            spheres.body[i] != spheres.body[j]
                && (spheres.centre[i] - spheres.centre[j]).norm_squared() < reach * reach
        };
        let all = (0..n).flat_map(|i| (i + 1..n).map(move |j| (i, j)));
        all.filter(near).map(|(i, j)| [i as u32, j as u32]).collect()
    }

    #[test]
    fn the_grid_finds_every_pair_once_and_in_order() {
        let floor = [Plane::through(Vec3::zeros(), Vec3::z())];
        // A cube, a flat and a long box, and one so wide that its cells must grow.
        for extent in [[0.4, 0.4, 0.4], [1.0, 1.0, 0.0], [5.0, 0.05, 0.05], [900.0, 900.0, 900.0]] {
            let spheres = scattered(300, extent);
            let mut neighbours = Neighbours::default();
            // Twice, so that what is left from the first time would show.
            for skin in [0.03, 0.005] {
                neighbours.look(&spheres, &floor, skin);
                let expected = by_hand(&spheres, skin);
                println!("{extent:?}: {} pairs", expected.len());
                assert_eq!(neighbours.pairs, expected);
                let near = |k: &u32| spheres.centre[*k as usize].z < spheres.radius[*k as usize] + skin;
                let seats: Vec<[u32; 2]> = (0..300).filter(near).map(|k| [k, 0]).collect();
                assert_eq!(neighbours.seats, seats);
            }
        }
    }
}
