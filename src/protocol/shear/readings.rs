//! What is read off a sheared wall: its curve of force over drift, and how it gives way.

use crate::model::Level;
use crate::protocol::mechanism::JointState;
use crate::protocol::watch::LoadStep;

/// The wall counts as done when the push has fallen to this share of the largest one.
const DONE: f64 = 0.8;
/// A wall rocks when its stones turn by more than this share of the drift.
const ROCKS: f64 = 0.5;
/// The toe gives way where a joint is crushed over this share of the wall's section.
const TOE: f64 = 0.05;
/// Rounds in which plateau and stiffness are made to agree.
const ROUNDS: u32 = 60;

/// How a sheared wall gives way.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ShearMode {
    /// The stones that move turn by more than half of the drift: a part of the wall leans over its toe.
    Rocking,
    /// They turn by less: it slides along a bed or in steps.
    Sliding,
    /// It rocks over a toe that is crushed over a twentieth of the wall's section or more.
    Toe,
}

impl ShearMode {
    /// The name used in tables.
    pub fn name(&self) -> &'static str {
        match self {
            ShearMode::Rocking => "rocking",
            ShearMode::Sliding => "sliding",
            ShearMode::Toe => "toe",
        }
    }

    /// Of a wall of a section (m^2) whose stones have turned by this share of the drift, from its joints at the end.
    pub(super) fn of(turned: f64, joints: &[JointState], section: f64) -> ShearMode {
        let crushed = joints.iter().fold(0.0, |most: f64, joint| most.max(joint.crushed * joint.area));
        match turned > ROCKS {
            false => ShearMode::Sliding,
            true if crushed >= TOE * section => ShearMode::Toe,
            true => ShearMode::Rocking,
        }
    }
}

/// What is read off a curve of force over drift, on its envelope along x+: where the drift was new.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sheared {
    /// The largest push (N).
    pub capacity: f64,
    /// The drift at which it was reached.
    pub drift_at_capacity: f64,
    /// The push (N) at which a wall of the same stiffness that gives way at once does as much work, up to the end or to where the
    /// push has fallen to 0.8 of the largest one; `None` by limit analysis.
    pub plateau: Option<f64>,
    /// Push over displacement (N/m) at a third of the plateau; `None` by limit analysis.
    pub stiffness: Option<f64>,
    /// How the wall gives way; `None` where that was not seen.
    pub mode: Option<ShearMode>,
    /// Widest opening of a joint at the last state at rest (m); `None` by limit analysis.
    pub opening: Option<f64>,
}

impl Sheared {
    /// Of rigid blocks, which bear this (N).
    pub(super) fn rigid(capacity: f64) -> Sheared {
        Sheared {
            capacity,
            drift_at_capacity: 0.0,
            plateau: None,
            stiffness: None,
            mode: None,
            opening: None,
        }
    }

    /// Of the steps of a test with the jack at a height (m), and what was seen of its mechanism; `None` of a wall that was not
    /// pushed.
    pub(super) fn of(steps: &[LoadStep], height: f64, mode: ShearMode, opening: f64) -> Option<Sheared> {
        let mut curve = envelope(along(steps, 1.0));
        let (drift_at_capacity, capacity) =
            curve.iter().copied().reduce(|best, next| if next.1 > best.1 { next } else { best })?;
        let falls = |&(drift, push): &(f64, f64)| drift > drift_at_capacity && push < DONE * capacity;
        curve.truncate(curve.iter().position(falls).unwrap_or(curve.len()));
        let end = curve.last()?.0;
        let area: f64 = curve.windows(2).map(|w| 0.5 * (w[0].1 + w[1].1) * (w[1].0 - w[0].0)).sum();
        let mut plateau = capacity;
        let mut yields = 0.0;
        for _ in 0..ROUNDS {
            // The drift at which the stiff branch would reach the plateau.
            yields = 3.0 * drift_at(&curve, plateau / 3.0)?;
            plateau = (area / (end - 0.5 * yields)).min(capacity);
        }
        let known = yields > 0.0 && plateau > 0.0;
        Some(Sheared {
            capacity,
            drift_at_capacity,
            plateau: known.then_some(plateau),
            stiffness: known.then(|| plateau / (yields * height)),
            mode: Some(mode),
            opening: Some(opening),
        })
    }
}

/// The push (N) at a drift, when the wall first came as far that way; by straight lines between the steps. `None` where it never
/// did.
pub fn force_at(steps: &[LoadStep], drift: f64) -> Option<f64> {
    let way = if drift < 0.0 { -1.0 } else { 1.0 };
    first_at(along(steps, way), way * drift).map(|push| way * push)
}

/// The push when a drift was first reached, of a history of drifts (in any unit) and pushes that begins with the unmoved wall.
pub fn first_at(history: impl Iterator<Item = (f64, f64)>, drift: f64) -> Option<f64> {
    let curve = envelope(history);
    let after = curve.iter().position(|point| point.0 >= drift)?;
    let (to, push) = curve[after];
    let Some(&(from, before)) = after.checked_sub(1).and_then(|k| curve.get(k)) else { return Some(push) };
    Some(before + (push - before) * (drift - from) / (to - from))
}

/// Drifts and pushes, both counted along one way (1 or -1).
fn along(steps: &[LoadStep], way: f64) -> impl Iterator<Item = (f64, f64)> {
    steps.iter().filter_map(move |step| match (step.level, step.push) {
        (Level::Drift(drift), Some(push)) => Some((way * drift, way * push)),
        _ => None,
    })
}

/// The points of a history at which the drift was new.
fn envelope(history: impl Iterator<Item = (f64, f64)>) -> Vec<(f64, f64)> {
    let mut points: Vec<(f64, f64)> = Vec::new();
    for (drift, push) in history {
        if points.last().is_none_or(|last| drift > last.0) {
            points.push((drift, push));
        }
    }
    points
}

/// The drift at which a curve first reaches a push.
fn drift_at(curve: &[(f64, f64)], push: f64) -> Option<f64> {
    let after = curve.iter().position(|point| point.1 >= push)?;
    let (to, there) = curve[after];
    let (from, here) = *curve.get(after.checked_sub(1)?)?;
    Some(from + (to - from) * (push - here) / (there - here))
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    fn step(drift: f64, push: f64) -> LoadStep {
        LoadStep {
            level: Level::Drift(drift),
            top_displacement: drift,
            points: None,
            remainders: None,
            push: Some(push),
            unbalanced_ratio: 0.0,
            solver_steps: 0,
        }
    }

    #[test]
    fn a_wall_that_gives_way_at_once_is_read_exactly() {
        // 50 kN at 1 m and 0.2 %, constant up to 2 %.
        let steps = [step(0.0, 0.0), step(0.002, 5e4), step(0.01, 5e4), step(0.02, 5e4)];
        let read = Sheared::of(&steps, 1.0, ShearMode::Rocking, 0.0).unwrap();
        assert_eq!((read.capacity, read.drift_at_capacity), (5e4, 0.002));
        assert_relative_eq!(read.plateau.unwrap(), 5e4, max_relative = 1e-9);
        assert_relative_eq!(read.stiffness.unwrap(), 2.5e7, max_relative = 1e-9);
    }

    #[test]
    fn plateau_and_stiffness_of_a_curve_with_a_corner_are_those_of_its_work() {
        // Area 20 + 405 + 450 N; with the branch of 20 kN per unit of drift up to the corner the plateau F solves
        // F (0.02 - F / 4e4 / 1) = A.
        let steps = [step(0.0, 0.0), step(0.002, 40.0), step(0.01, 60.0), step(0.02, 50.0)];
        let read = Sheared::of(&steps, 2.0, ShearMode::Rocking, 0.0).unwrap();
        let (area, slope) = (0.04 + 0.4 + 0.55, 2e4);
        let plateau = slope * (0.02 - (0.02f64 * 0.02 - 2.0 * area / slope).sqrt());
        assert_relative_eq!(read.plateau.unwrap(), plateau, max_relative = 1e-9);
        assert_relative_eq!(read.stiffness.unwrap(), slope / 2.0, max_relative = 1e-9);
        assert_eq!((read.capacity, read.drift_at_capacity), (60.0, 0.01));
    }

    #[test]
    fn the_force_of_cycles_is_that_of_new_drift_on_either_side() {
        let steps = [
            step(0.0, 0.0),
            step(0.01, 10.0),
            step(0.0, -4.0),
            step(-0.01, -12.0),
            step(0.0, 4.0),
            step(0.02, 14.0),
        ];
        assert_relative_eq!(force_at(&steps, 0.005).unwrap(), 5.0, max_relative = 1e-12);
        assert_relative_eq!(force_at(&steps, 0.015).unwrap(), 12.0, max_relative = 1e-12);
        // The way back from the first half cycle is behind it.
        assert_relative_eq!(force_at(&steps, -0.005).unwrap(), -6.0, max_relative = 1e-12);
        assert_eq!((force_at(&steps, 0.03), force_at(&steps, -0.02)), (None, None));
    }
}
