//! The eye on a wall while it is loaded: what is read at rest, and when it has moved past the criterion.

use crate::math::Vec3;
use crate::model::Level;
use crate::protocol::observe::{Point, displacements, furthest, movable, three_points, top_points};
use crate::protocol::{Direction, Task};
use crate::solve::bodies::Bodies;

/// When a wall counts as running away.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Criterion {
    /// Its top has moved by so much (m) along the load since gravity alone.
    Top(f64),
    /// The centroid of some block has moved by so much (m) since the last state at rest; of thicker [piles](crate::protocol::Task::piles) by as
    /// much more. Whatever it has moved by, a block that has come to rest where it has toppled or left its bearing has fallen.
    AnyBlock(f64),
}

/// What was observed at the end of one load step.
#[derive(Clone, Debug, PartialEq)]
pub struct LoadStep {
    /// How far along the load path; 0 under gravity alone.
    pub level: Level,
    /// Largest displacement at the wall's top in the direction of the load, since the wall came to rest under gravity (m).
    pub top_displacement: f64,
    /// Displacement of the left, centre and right point of the top along +y, since the wall came to rest under gravity (m);
    /// `None` where the wall has no stones.
    pub points: Option<[f64; 3]>,
    /// What is left of these (m) when the platform goes back to the level from here; `None` where that was not asked for, or the
    /// wall does not come to rest on the way.
    pub remainders: Option<[f64; 3]>,
    /// Force (N) with which a jack pushes along the wall; `None` where there is none.
    pub push: Option<f64>,
    /// Unbalanced force ratio reached.
    pub unbalanced_ratio: f64,
    /// Time steps or iterations that it took, failed attempts on the way included.
    pub solver_steps: u64,
}

/// The eye on one wall.
pub struct Watch {
    top: Vec<Point>,
    three: Option<[Point; 3]>,
    towards: Direction,
    criterion: Criterion,
    /// Blocks that can move, and the thickness of the thinnest pile over that of theirs.
    movable: Vec<(usize, f64)>,
    /// Displacements of the top points and the three points at rest under gravity alone.
    top_at_rest: Vec<Vec3>,
    three_at_rest: [f64; 3],
    /// Centroids at the last state at rest.
    last: Vec<Vec3>,
}

impl Watch {
    /// On a wall whose blocks have not moved yet.
    pub fn new(task: &Task<'_>, bodies: &Bodies) -> Watch {
        let (wall, towards, criterion) = (task.wall, task.path.direction(), task.criterion);
        let thinnest =
            task.piles.iter().copied().filter(|thickness| *thickness > 0.0).fold(f64::INFINITY, f64::min);
        let scale =
            |id: usize| task.piles.get(id).filter(|own| **own > 0.0).map_or(1.0, |own| thinnest / own);
        let top = top_points(wall, bodies);
        Watch {
            three: three_points(wall, &top, bodies),
            top_at_rest: displacements(&top, bodies),
            top,
            towards,
            criterion,
            movable: movable(wall).map(|(id, _)| (id, scale(id))).collect(),
            three_at_rest: [0.0; 3],
            last: bodies.all.iter().map(|b| b.position).collect(),
        }
    }

    /// From now on displacements count from here: the wall stands under gravity alone.
    pub fn begins(&mut self, bodies: &Bodies) {
        self.top_at_rest = displacements(&self.top, bodies);
        self.three_at_rest = self.three_now(bodies).unwrap_or_default();
    }

    /// The wall has come to rest.
    pub fn rests(&mut self, bodies: &Bodies) {
        self.last = bodies.all.iter().map(|b| b.position).collect();
    }

    /// Whether the wall has moved past the criterion.
    pub fn runs_away(&self, bodies: &Bodies) -> bool {
        match self.criterion {
            Criterion::Top(limit) => {
                furthest(&displacements(&self.top, bodies), &self.top_at_rest, self.towards).1 > limit
            }
            Criterion::AnyBlock(limit) => self.strayed(bodies) > limit,
        }
    }

    /// Largest movement of a block's centroid since the last state at rest (m).
    pub fn moved(&self, bodies: &Bodies) -> f64 {
        self.largest(|id, _| (bodies.all[id].position - self.last[id]).norm_squared())
    }

    /// The same where blocks of thicker piles count as they would in the thinnest one: what the criterion is compared with.
    pub fn strayed(&self, bodies: &Bodies) -> f64 {
        self.largest(|id, scale| scale * scale * (bodies.all[id].position - self.last[id]).norm_squared())
    }

    /// As [`Watch::strayed`], between two states.
    pub fn strayed_between(&self, from: &Bodies, to: &Bodies) -> f64 {
        let of = |id: usize| (to.all[id].position - from.all[id].position).norm_squared();
        self.largest(|id, scale| scale * scale * of(id))
    }

    fn largest(&self, square: impl Fn(usize, f64) -> f64) -> f64 {
        self.movable.iter().map(|(id, scale)| square(*id, *scale)).fold(0.0, f64::max).sqrt()
    }

    /// What is read off the wall now.
    pub fn read(&self, bodies: &Bodies, level: Level, unbalanced_ratio: f64, solver_steps: u64) -> LoadStep {
        let points = self.points(bodies);
        let (top_displacement, _) =
            furthest(&displacements(&self.top, bodies), &self.top_at_rest, self.towards);
        LoadStep {
            level,
            top_displacement,
            points,
            remainders: None,
            push: None,
            unbalanced_ratio,
            solver_steps,
        }
    }

    /// See [`LoadStep::points`].
    pub fn points(&self, bodies: &Bodies) -> Option<[f64; 3]> {
        let [l, c, r] = self.three_at_rest;
        self.three_now(bodies).map(|now| [now[0] - l, now[1] - c, now[2] - r])
    }

    fn three_now(&self, bodies: &Bodies) -> Option<[f64; 3]> {
        self.three.map(|points| points.map(|p| p.displacement(bodies).y))
    }
}
