//! The stresses that a plate bears, direction by direction, from a cell of rigid stones.
//!
//! The vertical stress of the wall's weight is there from the start; other stresses grow beside it until the cell becomes a mechanism.
//! Where joints have neither cohesion nor tensile strength, all that is borne is proportional to it: the stresses that a plate
//! bears are a cone, of which this is the section at one vertical stress.
//!
//! Rigid stones bear any pressure along the wall, so that directions that only press have no end.

use serde::{Deserialize, Serialize};

use crate::contact;
use crate::homogenise::{Ending, Flow, Path, Strained, strained};
use crate::model::{Cell, JointLaws, Outcome, Six};
use crate::solve::limit::{Analysis, Settings};

/// Stresses that grow together, over the vertical stress resultant `p` (N/m): `N11, N22, N12` over `p`, `M11, M22, M12` over `p` times the
/// thickness.
pub type Direction = Six;

/// In-plane stresses in eight directions of `(N11, N12)`: pull, push and shear, and shear with either.
pub const IN_PLANE: [Direction; 8] = [
    [1.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    [1.0, 0.0, 1.0, 0.0, 0.0, 0.0],
    [0.0, 0.0, 1.0, 0.0, 0.0, 0.0],
    [-1.0, 0.0, 1.0, 0.0, 0.0, 0.0],
    [-1.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    [-1.0, 0.0, -1.0, 0.0, 0.0, 0.0],
    [0.0, 0.0, -1.0, 0.0, 0.0, 0.0],
    [1.0, 0.0, -1.0, 0.0, 0.0, 0.0],
];

/// Moments in the 26 directions of `(M11, M22, M12)` from the middle of a cube to its faces, edges and corners.
pub fn out_of_plane() -> Vec<Direction> {
    let steps = [1.0, 0.0, -1.0];
    let all = steps.iter().flat_map(|a| steps.iter().flat_map(|b| steps.iter().map(|c| [*a, *b, *c])));
    all.filter(|moments| *moments != [0.0; 3]).map(|[a, b, c]| [0.0, 0.0, 0.0, a, b, c]).collect()
}

/// A point of the surface.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Point {
    /// Where it was looked for.
    pub direction: Direction,
    /// What was found there.
    pub found: Found,
    /// Outward normal of the surface: the plate's strain rate at collapse, in the units of the direction, scaled so that its product
    /// with the direction is 1. Zero where there is none, and of a cell that is strained.
    pub normal: Six,
}

/// What is found in a direction.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Found {
    /// So many times the direction are borne.
    Borne(f64),
    /// So many times the direction at least: no more were asked for.
    AtLeast(f64),
    /// Any number of times.
    Unbounded,
    /// The vertical stress alone is not borne.
    FallsAtRest,
    /// The solver found no answer that can be believed.
    NotConverged(String),
}

impl Found {
    /// The multiple, where there is one; 0 where even the vertical stress is not borne.
    pub fn value(&self) -> Option<f64> {
        match self {
            Found::Borne(value) => Some(*value),
            Found::FallsAtRest => Some(0.0),
            Found::AtLeast(_) | Found::Unbounded | Found::NotConverged(_) => None,
        }
    }
}

/// How strength is found.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Method {
    /// Limit analysis of rigid stones whose joints dilate as they slide: an upper bound for joints that dilate less.
    Associative,
    /// Limit analysis without dilatancy: a state that is neither a bound nor unique.
    NonAssociative,
    /// The cell strained from its elastic state, without dilatancy: what joints bear that are pressed as the weight presses them.
    Elastic,
}

impl Method {
    /// All of them, in the order in which they are reported.
    pub const ALL: [Method; 3] = [Method::Associative, Method::NonAssociative, Method::Elastic];

    /// Its name in files.
    pub fn name(self) -> &'static str {
        match self {
            Method::Associative => Flow::Associative.name(),
            Method::NonAssociative => Flow::NonAssociative.name(),
            Method::Elastic => "elastic",
        }
    }
}

/// Strength of a cell in some directions beside the vertical stress `-pressure` (N/m, `pressure` positive). `laws` is asked with the
/// stones' numbers, for an image with that of its stone.
pub fn surface(
    cell: &Cell,
    laws: &dyn JointLaws,
    contact: contact::Settings,
    method: Method,
    pressure: f64,
    directions: &[Direction],
) -> Vec<Point> {
    let flow = match method {
        Method::Associative => Flow::Associative,
        Method::NonAssociative => Flow::NonAssociative,
        Method::Elastic => {
            let follow = |direction: &Direction| {
                let path = strained(cell, laws, &contact, pressure, direction, Strained::default());
                Point { direction: *direction, found: followed(&path), normal: [0.0; 6] }
            };
            return directions.iter().map(follow).collect();
        }
    };
    let settings = Settings { flow, ..Settings::default() };
    let analysis = Analysis::of_cell(cell, laws, contact, settings, pressure);
    let units = units(pressure, cell.thickness);
    let live: Vec<Six> =
        directions.iter().map(|direction| std::array::from_fn(|k| direction[k] * units[k])).collect();
    let bearings = analysis.bears([0.0, -pressure, 0.0, 0.0, 0.0, 0.0], &live);
    let points = directions.iter().zip(bearings).map(|(direction, bearing)| Point {
        direction: *direction,
        found: match bearing.limit.outcome {
            Outcome::Collapsed { .. } => Found::Borne(bearing.limit.multiplier),
            Outcome::Unbounded => Found::Unbounded,
            Outcome::Equilibrium => Found::AtLeast(bearing.limit.multiplier),
            Outcome::UnstableAtRest => Found::FallsAtRest,
            Outcome::NotConverged { why, .. } => Found::NotConverged(why),
            other => Found::NotConverged(format!("{other:?}")),
        },
        normal: std::array::from_fn(|k| bearing.rate[k] * units[k]),
    });
    points.collect()
}

/// What a path says of the strength.
fn followed(path: &Path) -> Found {
    match path.ending {
        Ending::Plateau | Ending::Softened => Found::Borne(path.largest()),
        Ending::Rising => Found::AtLeast(path.largest()),
        Ending::NotAtRest => Found::FallsAtRest,
        Ending::NotConverged { strain } => Found::NotConverged(format!(
            "no balance at a strain of {strain:.3e}; {:.5} times the direction were borne",
            path.largest()
        )),
    }
}

/// What stresses are measured in (N/m and N).
pub(super) fn units(pressure: f64, thickness: f64) -> Six {
    let moment = pressure * thickness;
    [pressure, pressure, pressure, moment, moment, moment]
}
