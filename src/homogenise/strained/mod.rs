//! The strength of a cell whose joints do not dilate: strained step by step from its elastic state at rest.
//!
//! The stones are rigid and displacements small; joints have the law of the walls, integrated over their area, with its history. The
//! cell bears its vertical stress first, all others being zero. Then stresses grow in one direction: what is given is the strain
//! along it, the work of the direction per area; the other strains adjust, so that the stress stays on its ray.
//!
//! ```text
//! stress = dead + lambda direction,      strain = direction . (E, K)
//! ```
//!
//! In small displacements nothing tips over and no gap closes: what is built apart carries nothing, as in limit analysis. With linear
//! joints that have neither cohesion nor tensile strength, displacements are proportional to the pressure over the stiffness, and the
//! strength does not depend on either. How wide the zone is about which stones turn shows in the strain that it takes, not in what is
//! reached at last.

mod balance;
mod joint;
mod sparse;

use crate::contact;
use crate::homogenise::Direction;
use crate::homogenise::strained::balance::{Balance, Given};
use crate::homogenise::surface::units;
use crate::model::{Cell, JointLaws};

/// Relative change of the multiplier over a doubling of the strain below which it is on a plateau.
const LEVEL: f64 = 1e-4;
/// Share of the largest multiplier at which a path has softened.
const SOFTENED: f64 = 0.9;
/// An increment that does not converge is halved this often.
const MOST_HALVINGS: u32 = 10;

/// How a cell is strained.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Strained {
    /// First increment, in elastic strains: those of a unit of the direction if no joint opened or slipped. Default 0.05.
    pub first: f64,
    /// Increments as a share of the strain so far, once that is more than the first. Default 0.2.
    pub growth: f64,
    /// Where the path ends that still rises, in elastic strains. Default 30 000, at which little is left of elasticity: joints that are
    /// twisted and bent at once approach what rigid ones bear as slowly.
    pub largest: f64,
    /// Panels of Simpson's rule along either axis of a joint, each of three points. With the default, 4, the friction of a
    /// rectangle that turns under uniform pressure is 0.1 to 0.2 % too high (sides of 1:1 to 1:3); with 2, 0.5 to 1 %. What turns about
    /// an edge is borne exactly with any number, as there are points on the edges.
    pub panels: u32,
}

impl Default for Strained {
    fn default() -> Self {
        Strained { first: 0.05, growth: 0.2, largest: 3e4, panels: 4 }
    }
}

/// The way that a cell was strained.
#[derive(Clone, Debug, PartialEq)]
pub struct Path {
    /// Strain along the direction since rest, without dimensions (curvatures times thickness), and the multiplier of the direction.
    pub points: Vec<(f64, f64)>,
    /// Why it ended.
    pub ending: Ending,
}

/// Why a path ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Ending {
    /// The multiplier has changed by less than 1e-4 of itself while the strain doubled.
    Plateau,
    /// It has fallen by a tenth, or by less but since half of the largest strain.
    Softened,
    /// It still rises at the largest strain, as under stresses that only press.
    Rising,
    /// No balance was found at this strain, nor at one that is 1/1024 of an increment beyond the last point.
    NotConverged {
        /// Where it was looked for.
        strain: f64,
    },
    /// The vertical stress alone is not borne, or was not found to be.
    NotAtRest,
}

impl Path {
    /// The largest multiplier, where the path went on to a plateau or softened.
    pub fn strength(&self) -> Option<f64> {
        matches!(self.ending, Ending::Plateau | Ending::Softened).then(|| self.largest())
    }

    /// The largest multiplier in balance, however the path ended.
    pub fn largest(&self) -> f64 {
        self.points.iter().fold(0.0, |most, (_, multiplier)| most.max(*multiplier))
    }
}

/// Strains a cell in a direction beside the vertical stress `-pressure` (N/m, `pressure` positive). `laws` is asked with the stones'
/// numbers, for an image with that of its stone.
pub fn strained(
    cell: &Cell,
    laws: &dyn JointLaws,
    contact: &contact::Settings,
    pressure: f64,
    direction: &Direction,
    settings: Strained,
) -> Path {
    let units = units(pressure, cell.thickness);
    let live = std::array::from_fn(|k| direction[k] * units[k]);
    let dead = [0.0, -pressure, 0.0, 0.0, 0.0, 0.0];
    let mut path = Path { points: vec![(0.0, 0.0)], ending: Ending::NotAtRest };
    let Some(mut balance) = Balance::of(cell, laws, contact, [dead, live], pressure, settings.panels) else {
        return path;
    };
    let mut x = balance.start();
    if !balance.solve(&mut x, Given::Dead, true) {
        return path;
    }
    balance.settle(&x);
    let Some(elastic) = balance.compliance(&x) else { return path };
    let at_rest = balance.strain(&x);
    let (mut strain, mut halvings) = (0.0, 0);
    // The increment before, and what it did.
    let mut earlier: Option<(f64, Vec<f64>)> = None;
    path.ending = loop {
        let whole = settings.first * elastic + settings.growth * strain;
        let increment = whole / f64::from(1u32 << halvings);
        let given = Given::Strain(at_rest + strain + increment);
        let ahead = earlier.as_ref().map(|(before, change)| {
            let share = increment / before;
            x.iter().zip(change).map(|(x, change)| x + share * change).collect::<Vec<f64>>()
        });
        let guesses = ahead.into_iter().chain([x.clone()]);
        let found = guesses
            .into_iter()
            .find_map(|mut guess| balance.solve(&mut guess, given, false).then_some(guess));
        let Some(found) = found else {
            if halvings == MOST_HALVINGS {
                break Ending::NotConverged { strain: strain + increment };
            }
            halvings += 1;
            continue;
        };
        balance.settle(&found);
        earlier = Some((increment, found.iter().zip(&x).map(|(now, before)| now - before).collect()));
        x = found;
        strain += increment;
        halvings = halvings.saturating_sub(1);
        path.points.push((strain, balance.multiplier(&x)));
        if let Some(ending) = ended(&path, settings.largest * elastic) {
            break ending;
        }
    };
    path
}

/// Whether a path has come to its end.
fn ended(path: &Path, largest: f64) -> Option<Ending> {
    let &(strain, multiplier) = path.points.last()?;
    let most = path.largest();
    if multiplier < SOFTENED * most {
        return Some(Ending::Softened);
    }
    // From the last point up to half the strain on.
    let since = path.points.partition_point(|(s, _)| *s <= 0.5 * strain).saturating_sub(1);
    let level = path.points[since..].iter().all(|(_, m)| (m - multiplier).abs() < LEVEL * most);
    if level {
        return Some(Ending::Plateau);
    }
    let rises = path.points[since..].iter().any(|(_, m)| *m == most);
    (strain >= largest).then_some(if rises { Ending::Rising } else { Ending::Softened })
}
