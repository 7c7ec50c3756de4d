//! The balance of a cell under a stress that keeps its direction, and Newton's method for it.
//!
//! Unknown are the motions `x` of the stones, the strain `e` of the plate and the multiplier `l` of the direction `g`:
//!
//! ```text
//! f(x, e) = (0, dead + l g),   g . e = given
//! ```
//!
//! where `f` are the forces by which the joints resist. Their tangent is unsymmetric where joints slip, as they do not dilate. Where all
//! that holds a stone has slipped or opened it is singular; so the matrix, and it alone, has a small share of the joints' elastic
//! stiffness besides. What is found has none of it: it balances without.

use faer::sparse::Pair;

use crate::contact::{self, periodic_joints};
use crate::homogenise::strained::joint::{Joint, Lengths, UNKNOWNS};
use crate::homogenise::strained::sparse::Sparse;
use crate::math::Vec3;
use crate::model::{Cell, JointLaws, Six};

/// Share of the elastic stiffness that is added to the matrix. Far along a path the slope of what slips is smaller than a share of
/// 1e-6 (in twist and after a thousand elastic strains): with that much Newton's method halves an error where it should square it.
const LEAST: f64 = 1e-9;
/// Largest force out of balance, as a share of what presses on a stone.
const BALANCED: f64 = 1e-9;
/// Matrices in one solve.
const MOST: usize = 30;
/// Shares of a step that are tried, and by how much the forces out of balance must fall.
const SHARES: [f64; 5] = [1.0, 0.5, 0.25, 0.125, 0.0625];
const FALL: f64 = 1e-2;

/// What is given beside the dead stress.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Given {
    /// There is no other stress.
    Dead,
    /// The strain along the direction, see [`Balance::strain`].
    Strain(f64),
}

/// A cell in balance, or on the way there.
pub(super) struct Balance {
    joints: Vec<Joint>,
    stones: usize,
    /// Loads on the strain (N): the dead ones, and those of the direction.
    dead: Six,
    live: Six,
    /// What the load of the unit of the multiplier's unknown is over the direction's.
    scale: f64,
    /// What the product of loads and unknowns is divided by for a strain without dimensions (N m).
    work: f64,
    /// Largest stiffness of a joint, and largest force that may be out of balance (N/m, N).
    stiff: f64,
    small: f64,
    matrix: Sparse,
}

impl Balance {
    /// A cell under dead stresses beside live ones, both in N/m and N, at a pressure (N/m) that sizes what is small. `None` where no
    /// stones touch.
    pub fn of(
        cell: &Cell,
        laws: &dyn JointLaws,
        contact: &contact::Settings,
        [dead, live]: [Six; 2],
        pressure: f64,
        panels: u32,
    ) -> Option<Balance> {
        let stones = cell.blocks.len();
        let area = cell.area();
        let lengths = Lengths { stone: (area / stones as f64).sqrt(), cell: area.sqrt() };
        let centroids: Vec<Vec3> =
            cell.blocks.iter().map(|block| block.shape.mass_properties().centroid).collect();
        let joints: Vec<Joint> = periodic_joints(cell, contact)
            .iter()
            .filter_map(|joint| {
                let (a, b) = (joint.first, joint.second);
                let law = laws.of(a as u32, b as u32);
                Joint::of(joint, contact.closed, law, [centroids[a], centroids[b]], lengths, panels)
            })
            .collect();
        let unit = lengths.strain();
        let load = |stress: Six| std::array::from_fn(|k| area * stress[k] * unit[k]);
        let (dead, live): (Six, Six) = (load(dead), load(live));
        let size = live.iter().map(|x| x * x).sum::<f64>().sqrt();
        let stiff = joints.iter().map(Joint::stiffness).fold(0.0, f64::max);
        let matrix = matrix(&joints, stones)?;
        Some(Balance {
            joints,
            stones,
            dead,
            live,
            scale: stiff / size,
            work: pressure * area,
            stiff,
            small: BALANCED * pressure * lengths.stone,
            matrix,
        })
    }

    /// The unknowns before anything moves.
    pub fn start(&self) -> Vec<f64> {
        vec![0.0; 6 * self.stones + 7]
    }

    /// The multiplier of the live stress.
    pub fn multiplier(&self, x: &[f64]) -> f64 {
        x[6 * self.stones + 6] * self.scale
    }

    /// The strain along the direction: the work of the live stress over area and pressure, per multiplier.
    pub fn strain(&self, x: &[f64]) -> f64 {
        self.live.iter().zip(&x[6 * self.stones..]).map(|(g, e)| g * e).sum::<f64>() / self.work
    }

    /// The strain along the direction by a unit of its stress where no joint opens or slips on.
    pub fn compliance(&self, x: &[f64]) -> Option<f64> {
        let mut loads = self.start();
        loads[6 * self.stones + 6] = -self.stiff / self.scale;
        let step = self.step(x, Given::Dead, true, &loads)?;
        Some(self.strain(&step))
    }

    /// Newton's method from where the unknowns are. `glued`, its first matrix is that of a cell whose joints are all closed. Says
    /// whether what is given is reached in balance.
    pub fn solve(&self, x: &mut Vec<f64>, given: Given, mut glued: bool) -> bool {
        let mut residual = self.residual(x, given);
        for _ in 0..MOST {
            if residual.iter().all(|force| force.abs() <= self.small) {
                return true;
            }
            let Some(step) = self.step(x, given, glued, &residual) else { return false };
            glued = false;
            let before = norm(&residual);
            let mut best = f64::INFINITY;
            let start = x.clone();
            for share in SHARES {
                let trial: Vec<f64> = start.iter().zip(&step).map(|(x, step)| x + share * step).collect();
                let found = self.residual(&trial, given);
                let size = norm(&found);
                if size < best {
                    (best, *x, residual) = (size, trial, found);
                }
                if best < (1.0 - FALL * share) * before {
                    break;
                }
            }
            if !best.is_finite() {
                return false;
            }
        }
        false
    }

    /// Ends an increment at these unknowns.
    pub fn settle(&mut self, x: &[f64]) {
        let stones = self.stones;
        self.joints.iter_mut().for_each(|joint| {
            let own = places(joint, stones).map(|place| x[place]);
            joint.settle(&own);
        });
    }

    /// The forces out of balance (N), and what is not as given.
    fn residual(&self, x: &[f64], given: Given) -> Vec<f64> {
        let mut sum = self.start();
        for joint in &self.joints {
            let places = places(joint, self.stones);
            let forces = joint.forces(&places.map(|place| x[place]));
            places.iter().zip(forces).for_each(|(&place, force)| sum[place] += force);
        }
        let (strain, last) = (6 * self.stones, 6 * self.stones + 6);
        for k in 0..6 {
            sum[strain + k] -= self.dead[k] + self.live[k] * self.scale * x[last];
        }
        sum[last] = match given {
            Given::Dead => self.stiff * x[last],
            Given::Strain(strain) => self.scale * self.work * (strain - self.strain(x)),
        };
        sum
    }

    /// The step that takes away a residual.
    fn step(&self, x: &[f64], given: Given, glued: bool, residual: &[f64]) -> Option<Vec<f64>> {
        let mut values = Vec::new();
        for joint in &self.joints {
            let own = places(joint, self.stones).map(|place| x[place]);
            joint.tangent(&own, glued, LEAST).iter().for_each(|row| values.extend(row));
        }
        let by_strain = if given == Given::Dead { 0.0 } else { -self.scale };
        for live in self.live {
            values.extend([-self.scale * live, by_strain * live]);
        }
        values.push(if given == Given::Dead { self.stiff } else { 0.0 });
        // Stones that are repeated can shift together: nothing presses on what holds the first one.
        values.extend([self.stiff; 3]);
        self.matrix.solve(&values, residual.iter().map(|force| -force).collect())
    }
}

/// Where the unknowns of a joint stand among all: those of its stones, then the strain.
fn places(joint: &Joint, stones: usize) -> [usize; UNKNOWNS] {
    let first = [joint.first, joint.second, stones];
    std::array::from_fn(|k| 6 * first[k / 6] + k % 6)
}

/// The matrix for the values of [`Balance::step`].
fn matrix(joints: &[Joint], stones: usize) -> Option<Sparse> {
    let mut entries = Vec::new();
    let mut joints_of = vec![0; stones];
    for joint in joints {
        let places = places(joint, stones);
        entries.extend(places.iter().flat_map(|&row| places.map(|col| Pair::new(row, col))));
        [joint.first, joint.second].into_iter().for_each(|stone| joints_of[stone] += 1);
    }
    let (strain, last) = (6 * stones, 6 * stones + 6);
    entries.extend((strain..last).flat_map(|k| [Pair::new(k, last), Pair::new(last, k)]));
    entries.push(Pair::new(last, last));
    entries.extend((0..3).map(|k| Pair::new(k, k)));
    // A stone's equations have its own unknowns, those of the stones that it touches and of the strain.
    let most = 6 * (joints_of.into_iter().max()? + 2);
    Sparse::of(last + 1, &entries, most)
}

fn norm(residual: &[f64]) -> f64 {
    residual.iter().fold(0.0, |sum, x| sum + x * x).sqrt()
}
