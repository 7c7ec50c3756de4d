//! The stiffness of a plate from the springs of a piece of it.
//!
//! The strain of the plate is given; the stones move as they like, rigidly, under one of three borders. With the same springs the
//! moduli of the periodic border lie between the two others (Hill 1952, Huet 1990; for masonry Cecchi and Sab 2004, Cluni and
//! Gusella 2004): the kinematic one admits fewer motions, the static one fewer stresses.
//!
//! A joint on the border is cut along its middle, so that either half has twice its stiffness. The motion of the cut is what the
//! borders prescribe.

use faer::prelude::Solve;
use faer::sparse::{SparseColMat, Triplet};
use faer::{Mat, Side};
use serde::{Deserialize, Serialize};

use crate::homogenise::springs::{Spring, Springs};
use crate::math::Vec3;
use crate::model::{Six, image_motion, plate_motion, plate_traction};

/// Share of the largest load that rounding may leave to a pin.
const BALANCED: f64 = 1e-6;

/// What rounding may take off the least of the values of a difference of moduli, relative to the moduli.
const ROUNDING: f64 = 1e-9;

/// What holds on the border of a piece of the plate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Border {
    /// It repeats itself: what is at one side is at the other.
    Periodic,
    /// It moves as a plate does that is strained uniformly: an upper bound.
    Kinematic,
    /// It is loaded as in a plate that is stressed uniformly: a lower bound.
    Static,
}

impl Border {
    /// All of them, from the stiffest to the softest.
    pub const ALL: [Border; 3] = [Border::Kinematic, Border::Periodic, Border::Static];

    /// Its name in files.
    pub fn name(self) -> &'static str {
        match self {
            Border::Periodic => "periodic",
            Border::Kinematic => "kinematic",
            Border::Static => "static",
        }
    }
}

/// Stiffness of a plate per area: forces and moments per length for each strain.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Moduli {
    /// Stresses `(N, M)` by unit strains `(E, K)`, see [`crate::model::Six`]: N/m for `N` by `E`, N for the coupling of both, N m for
    /// `M` by `K`. Symmetric.
    pub stiffness: [Six; 6],
    /// Transverse shear forces `(Q1, Q2)` per length by the shear strains, of stones that do not turn (N/m).
    pub shear: [[f64; 2]; 2],
}

/// Why there are no moduli.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, thiserror::Error)]
pub enum Loose {
    /// No joint at all.
    #[error("the stones do not touch one another: no joint carries anything")]
    NoJoints,
    /// The stresses cannot pass through the joints.
    #[error("the stones come apart: joints that are open by construction do not carry a uniform stress")]
    ComesApart,
}

/// Unknown motions of a stone, and strains.
trait Motion<const DOF: usize, const STRAINS: usize> {
    /// Motion of a point by each unit motion of a stone: rows x, y, z.
    fn stone(lever: Vec3) -> [[f64; DOF]; 3];
    fn image(shift: Vec3, at: Vec3) -> [[f64; STRAINS]; 3];
    fn border(at: Vec3) -> [[f64; STRAINS]; 3];
    fn traction(thickness: f64, at: Vec3, normal: Vec3) -> [[f64; STRAINS]; 3];
}

/// Membrane strains and curvatures; stones shift and turn.
struct Bent;

impl Motion<6, 6> for Bent {
    fn stone(r: Vec3) -> [Six; 3] {
        [[1.0, 0.0, 0.0, 0.0, r.z, -r.y], [0.0, 1.0, 0.0, -r.z, 0.0, r.x], [0.0, 0.0, 1.0, r.y, -r.x, 0.0]]
    }

    fn image(shift: Vec3, at: Vec3) -> [Six; 3] {
        image_motion(shift, at)
    }

    fn border(at: Vec3) -> [Six; 3] {
        plate_motion(at)
    }

    fn traction(thickness: f64, at: Vec3, normal: Vec3) -> [Six; 3] {
        plate_traction(thickness, at, normal)
    }
}

/// Transverse shear; stones shift and do not turn, as what is sheared is then their joints alone.
struct Sheared;

impl Motion<3, 2> for Sheared {
    fn stone(_: Vec3) -> [[f64; 3]; 3] {
        [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
    }

    fn image(shift: Vec3, _: Vec3) -> [[f64; 2]; 3] {
        [[0.0; 2], [shift.x, shift.z], [0.0; 2]]
    }

    fn border(at: Vec3) -> [[f64; 2]; 3] {
        [[0.0; 2], [at.x, at.z], [0.0; 2]]
    }

    fn traction(thickness: f64, _: Vec3, normal: Vec3) -> [[f64; 2]; 3] {
        [[0.0; 2], [normal.x / thickness, normal.z / thickness], [0.0; 2]]
    }
}

impl Moduli {
    /// The moduli under a border.
    ///
    /// # Errors
    /// [`Loose`]: joints that are open by construction may not carry a static one.
    pub fn of(springs: &Springs, border: Border) -> Result<Moduli, Loose> {
        Ok(Moduli {
            stiffness: stiffness::<Bent, 6, 6>(springs, border)?,
            shear: stiffness::<Sheared, 3, 2>(springs, border)?,
        })
    }

    /// Whether no strain takes less work than with other moduli, but for rounding.
    pub fn is_above(&self, other: &Moduli) -> bool {
        is_above(self.stiffness, other.stiffness) && is_above(self.shear, other.shear)
    }
}

/// The stiffness by the strains of one kind of motion.
fn stiffness<M: Motion<DOF, S>, const DOF: usize, const S: usize>(
    springs: &Springs,
    border: Border,
) -> Result<[[f64; S]; S], Loose> {
    if springs.joints.is_empty() {
        return Err(Loose::NoJoints);
    }
    let mut system = System::<DOF, S>::new(springs.stones.len());
    for joint in &springs.joints {
        match border {
            _ if !joint.border => system.join::<M>(springs, joint),
            Border::Periodic => system.join::<M>(springs, joint),
            Border::Kinematic => system.follow::<M>(springs, joint),
            Border::Static => system.load::<M>(springs, joint),
        }
    }
    let condensed = system.condensed(springs, border)?;
    let mean = condensed.map(|row| row.map(|x| x / springs.area));
    if border == Border::Static { inverse(mean).ok_or(Loose::ComesApart) } else { Ok(mean) }
}

/// Stiffness of the stones' motions, what the strains (or stresses) do to them, and what these do to themselves.
struct System<const DOF: usize, const S: usize> {
    own: Vec<Triplet<usize, usize, f64>>,
    loads: Vec<[f64; S]>,
    strained: [[f64; S]; S],
    /// Which stones hang together by springs: the lowest stone of each group.
    group: Vec<usize>,
}

/// The stiffness of a point of a joint (Pa/m).
fn spring(joint: &Spring, factor: f64) -> [[f64; 3]; 3] {
    let (n, kn, ks) = (joint.normal, factor * joint.kn, factor * joint.ks);
    let entry = |i: usize, j: usize| (kn - ks) * n[i] * n[j] + if i == j { ks } else { 0.0 };
    std::array::from_fn(|i| std::array::from_fn(|j| entry(i, j)))
}

/// The sum over the space of `a` times `b`.
fn work<const A: usize, const B: usize>(a: &[[f64; A]; 3], b: &[[f64; B]; 3]) -> [[f64; B]; A] {
    std::array::from_fn(|i| std::array::from_fn(|j| (0..3).map(|k| a[k][i] * b[k][j]).sum()))
}

/// The stiffness times motions, by area.
fn times<const N: usize>(stiffness: &[[f64; 3]; 3], motions: &[[f64; N]; 3], area: f64) -> [[f64; N]; 3] {
    stiffness.map(|row| {
        std::array::from_fn(|k| row.iter().zip(motions).map(|(s, motion)| s * motion[k]).sum::<f64>() * area)
    })
}

/// Adds `factor` times some rows.
fn gather<const N: usize>(to: &mut [[f64; N]], rows: impl IntoIterator<Item = [f64; N]>, factor: f64) {
    for (sums, row) in to.iter_mut().zip(rows) {
        sums.iter_mut().zip(row).for_each(|(sum, x)| *sum += factor * x);
    }
}

fn negative<const N: usize>(a: [[f64; N]; 3]) -> [[f64; N]; 3] {
    a.map(|row| row.map(|x| -x))
}

impl<const DOF: usize, const S: usize> System<DOF, S> {
    fn new(stones: usize) -> Self {
        System {
            own: Vec::new(),
            loads: vec![[0.0; S]; DOF * stones],
            strained: [[0.0; S]; S],
            group: (0..stones).collect(),
        }
    }

    /// A spring between two stones, the second one as an image.
    fn join<M: Motion<DOF, S>>(&mut self, springs: &Springs, joint: &Spring) {
        let second = joint.second;
        let (from, to) = (springs.stones[joint.first], springs.stones[second] + joint.shift);
        let motions =
            |at: Vec3| ([negative(M::stone(at - from)), M::stone(at - to)], M::image(joint.shift, at));
        self.add([joint.first, second], &spring(joint, 1.0), &joint.points, motions);
        self.unite(joint.first, second);
    }

    /// The two halves of a spring whose middle moves as a uniformly strained plate.
    fn follow<M: Motion<DOF, S>>(&mut self, springs: &Springs, joint: &Spring) {
        for (stone, shift) in sides(joint) {
            let from = springs.stones[stone] + shift;
            let motions = |at: Vec3| ([negative(M::stone(at - from))], M::border(at - shift));
            self.add([stone], &spring(joint, 2.0), &joint.points, motions);
        }
    }

    /// The two halves of a spring whose middle is loaded by uniform stresses: they load the stones and deform the halves.
    fn load<M: Motion<DOF, S>>(&mut self, springs: &Springs, joint: &Spring) {
        let (n, kn, ks) = (joint.normal, 2.0 * joint.kn, 2.0 * joint.ks);
        for (side, (stone, shift)) in sides(joint).enumerate() {
            let outward = if side == 0 { n } else { -n };
            for &(at, weight) in &joint.points {
                let at = at - shift;
                let traction = M::traction(springs.thickness, at, outward);
                let motion = work(&M::stone(at - springs.stones[stone]), &traction);
                gather(&mut self.loads[DOF * stone..][..DOF], motion, weight);
                let normal: [f64; S] =
                    std::array::from_fn(|k| (0..3).map(|row| n[row] * traction[row][k]).sum());
                let both = work(&traction, &traction);
                let give = |i: usize, j: usize| {
                    let pressed = normal[i] * normal[j];
                    pressed / kn + (both[i][j] - pressed) / ks
                };
                let given = (0..S).map(|i| std::array::from_fn(|j| give(i, j)));
                gather(&mut self.strained, given, weight);
            }
        }
    }

    /// Adds a spring between stones: the motions of its ends at a point, and those by the strains, are what they add to its opening.
    fn add<const N: usize>(
        &mut self,
        ends: [usize; N],
        stiffness: &[[f64; 3]; 3],
        points: &[(Vec3, f64)],
        motions: impl Fn(Vec3) -> ([[[f64; DOF]; 3]; N], [[f64; S]; 3]),
    ) {
        let mut own = [[[[0.0; DOF]; DOF]; N]; N];
        for &(at, weight) in points {
            let (stones, strain) = motions(at);
            let pull = times(stiffness, &strain, weight);
            gather(&mut self.strained, work(&strain, &pull), 1.0);
            for (a, motion) in stones.iter().enumerate() {
                // What is on the other side of the equation.
                gather(&mut self.loads[DOF * ends[a]..][..DOF], work(motion, &pull), -1.0);
                for (b, other) in stones.iter().enumerate() {
                    gather(&mut own[a][b], work(motion, &times(stiffness, other, weight)), 1.0);
                }
            }
        }
        for (a, row) in own.iter().enumerate() {
            for (b, entries) in row.iter().enumerate() {
                for (i, j) in (0..DOF).flat_map(|i| (0..DOF).map(move |j| (i, j))) {
                    let (row, column) = (DOF * ends[a] + i, DOF * ends[b] + j);
                    if row >= column {
                        self.own.push(Triplet::new(row, column, entries[i][j]));
                    }
                }
            }
        }
    }

    fn unite(&mut self, a: usize, b: usize) {
        let (a, b) = (self.group[a], self.group[b]);
        let (to, from) = (a.min(b), a.max(b));
        self.group.iter_mut().filter(|group| **group == from).for_each(|group| *group = to);
    }

    /// The strains' own stiffness less what the stones' motions take off it; of loads the compliance.
    fn condensed(mut self, springs: &Springs, border: Border) -> Result<[[f64; S]; S], Loose> {
        let size = self.loads.len();
        let pins = match border {
            Border::Kinematic => 0,
            // Stones that are repeated can shift together, but not turn.
            Border::Periodic => 3,
            Border::Static => DOF,
        };
        let stiff = springs.joints.iter().map(|joint| joint.kn * springs.area).fold(0.0, f64::max);
        let first = (0..springs.stones.len()).filter(|&stone| self.group[stone] == stone);
        let pinned: Vec<usize> = first.flat_map(|stone| DOF * stone..DOF * stone + pins).collect();
        self.own.extend(pinned.iter().map(|&k| Triplet::new(k, k, stiff)));
        let matrix =
            SparseColMat::try_new_from_triplets(size, size, &self.own).map_err(|_| Loose::ComesApart)?;
        let factor = matrix.sp_cholesky(Side::Lower).map_err(|_| Loose::ComesApart)?;
        let motions = factor.solve(Mat::from_fn(size, S, |i, k| self.loads[i][k]));
        for k in 0..S {
            let most = self.loads.iter().fold(0.0, |most: f64, row| most.max(row[k].abs()));
            // Loads in equilibrium leave nothing to the pins.
            if pinned.iter().any(|&i| stiff * motions[(i, k)].abs() > BALANCED * most) {
                return Err(Loose::ComesApart);
            }
        }
        let sign = if border == Border::Static { 1.0 } else { -1.0 };
        let taken = |i: usize, j: usize| (0..size).map(|k| self.loads[k][i] * motions[(k, j)]).sum();
        let taken: Vec<[f64; S]> = (0..S).map(|i| std::array::from_fn(|j| taken(i, j))).collect();
        gather(&mut self.strained, taken, sign);
        Ok(self.strained)
    }
}

/// The stones at a joint of the border, each with the way from it to where it is met.
fn sides(joint: &Spring) -> impl Iterator<Item = (usize, Vec3)> {
    [(joint.first, Vec3::zeros()), (joint.second, joint.shift)].into_iter()
}

/// Whether the difference of two symmetric matrices has no negative value but for rounding: with each strain in the unit in which
/// its own work is 1.
fn is_above<const N: usize>(upper: [[f64; N]; N], lower: [[f64; N]; N]) -> bool {
    let size: Vec<f64> = (0..N).map(|k| upper[k][k].sqrt()).collect();
    let entry = |i: usize, j: usize| (upper[i][j] - lower[i][j]) / (size[i] * size[j]);
    let slack = |i: usize, j: usize| if i == j { ROUNDING } else { 0.0 };
    Mat::from_fn(N, N, |i, j| entry(i, j) + slack(i, j)).llt(Side::Lower).is_ok()
}

/// The inverse of a symmetric matrix; `None` where it has none.
fn inverse<const N: usize>(matrix: [[f64; N]; N]) -> Option<[[f64; N]; N]> {
    let matrix = Mat::from_fn(N, N, |i, j| matrix[i][j]);
    let factor = matrix.llt(Side::Lower).ok()?;
    let found = factor.solve(Mat::<f64>::identity(N, N));
    Some(std::array::from_fn(|i| std::array::from_fn(|j| found[(i, j)])))
}
