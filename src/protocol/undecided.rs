//! Does the weight bring about the thrust that a bound by rigid statics lives on?
//!
//! Statics lets joints press as hard as it helps. Where friction in upright joints holds a wall, rigid blocks leave open whether anything
//! presses there. Joints that are merely stiff leave nothing open: laid without force they carry what weight and load bring about, and what
//! they bear no longer depends on how stiff they are. So a load that needs friction in upright joints is asked of stiff joints, too; where
//! they bear clearly less, both numbers are the answer.
//!
//! Most walls are told apart cheaply: one more state of limit analysis, without friction in upright joints, bears as much.

use crate::law::{Coulomb, NormalLaw};
use crate::math::{Vec3, cbrt};
use crate::model::{JointLaws, Outcome, Support, Wall};
use crate::protocol::drive::drive;
use crate::protocol::path::{Growing, LoadPath};
use crate::protocol::retaining::{Behind, Lifts, raise};
use crate::protocol::rigid::{borne, level};
use crate::protocol::{Changes, Load, Run, Task, Witness};
use crate::solve::implicit::{self, Equilibrium};
use crate::solve::limit::{Analysis, Flow, Loads, Settings, When, is_upright};
use crate::solve::{Assembly, Equilibrate, STANDARD_GRAVITY, Solver, Status, Tie};

/// A wall whose stiff joints bear this share of what rigid statics finds is decided.
const SAME: f64 = 0.95;
/// Stiff joints close by this share of a typical stone under the weight of the height of the wall. What they bear then lies some 2 % below the
/// limit of stiffer and stiffer joints where a block turns over an edge (it goes with the cube root). A tenth of that takes ten times as long.
const CLOSES: f64 = 1e-6;
/// Joints close by so many times what blocks miss one another by, or the misfit alone would decide which of them press; and at most by this share of
/// a stone, where they are no longer stiff.
const SMOOTHS: f64 = 30.0;
const SOFT: f64 = 1e-3;
/// Steps of the load to what is looked for, and the bracket as a share of it.
const STEPS: f64 = 24.0;
const BRACKET: f64 = 2e-3;

/// What rigid statics leaves open.
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Undecided {
    /// What stiff elastic joints bear that were laid without force (rad of tilt, a multiplier or a factor); 0 where they do not even bear the
    /// weight.
    pub lower: f64,
    /// What was found for rigid blocks, in the same unit; `None` where they bear all that was asked.
    pub upper: Option<f64>,
    /// The thrust in upright joints (N, the sum of their normal forces) that the upper load needs at least; `None` where it was not found.
    pub needed: Option<f64>,
    /// The thrust in upright joints under the weight alone (N), of stiff joints; `None` where these do not come to rest.
    pub at_rest: Option<f64>,
    /// What rigid blocks bear whose joints slide without opening, in the same unit, where it lies clearly below an upper end with dilatancy: then
    /// dilatancy is part of the reason. `None` where it is not, or where that was not found.
    pub without_dilatancy: Option<f64>,
    /// How the lower end was found.
    pub by: Lower,
}

/// How the lower end of an answer was found.
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Lower {
    /// Stiff joints fall there.
    StiffJoints,
    /// Stiff joints bear it at least: their solver was lost above, in words.
    StiffJointsAtLeast(String),
    /// Blocks miss one another by so many metres, too much for stiff joints to be asked: it is what rigid blocks with smooth upright joints bear,
    /// and stiff ones may bear less.
    SmoothSides(f64),
}

impl Undecided {
    /// Why there are two numbers, in words.
    pub fn reason(&self) -> String {
        let dilates = match self.without_dilatancy {
            Some(_) => " and joints that open as they slide (dilatancy)",
            None => "",
        };
        let thrust = match (self.needed, self.at_rest) {
            // Statics can do with less than is there: it is not the thrust alone that is open.
            (Some(needed), at_rest) if needed <= at_rest.unwrap_or(0.0) => {
                "one of many distributions of joint forces, which the weight need not bring about".to_owned()
            }
            (Some(needed), Some(at_rest)) => format!(
                "a thrust of {} in upright joints, of which the weight brings about {:.0} %",
                newtons(needed),
                100.0 * at_rest / needed
            ),
            (Some(needed), None) => format!("a thrust of {} in upright joints", newtons(needed)),
            (None, _) => "thrust in upright joints".to_owned(),
        };
        let lower = match &self.by {
            Lower::StiffJoints if self.lower == 0.0 => {
                "stiff joints laid without force do not bear the weight".to_owned()
            }
            Lower::StiffJoints => "stiff joints laid without force bear the lower".to_owned(),
            Lower::StiffJointsAtLeast(why) => {
                format!("stiff joints laid without force bear the lower at least ({why})")
            }
            Lower::SmoothSides(misfit) => format!(
                "without friction there the wall bears the lower at most (its blocks miss one another by up to {misfit:.0e} m, too much to ask stiff joints)"
            ),
        };
        format!("rigid blocks leave open which: the upper load needs {thrust}{dilates}; {lower}")
    }
}

/// A force with three digits.
fn newtons(force: f64) -> String {
    if force >= 1e3 { format!("{:.1} kN", 1e-3 * force) } else { format!("{force:.0} N") }
}

/// Asks stiff joints where rigid blocks need friction in upright joints. `analysis` is that of the task's wall, `bound` what it bears and `found` what
/// the answer is, the same or what another method of rigid blocks found; `None` to the end of the path. `None` where there is nothing to say.
pub fn undecided(
    task: &Task<'_>,
    analysis: &Analysis,
    bound: Option<f64>,
    found: Option<f64>,
) -> Option<Undecided> {
    // What another method found has no dilatancy to lose.
    let is_bound = bound == found;
    let [bound, goal] = [bound, found].map(|level| SAME * level.unwrap_or(task.path.end));
    let smooth = analysis.with_smooth_sides();
    if goal <= 0.0 || smooth.stands(&loads(task, bound)).stands != Some(false) {
        return None;
    }
    let needed = analysis.side_thrust(&loads(task, found.unwrap_or(goal)));
    let misfit = misfit(task);
    let Some(laws) = Stiff::of(task.wall, task.laws, misfit)? else {
        let limit = borne(&smooth, task.path.growing, &task.loads);
        let lower = level(&limit).or_else(|| (limit.outcome == Outcome::UnstableAtRest).then_some(0.0))?;
        return (lower < goal).then(|| Undecided {
            lower,
            upper: found,
            needed,
            at_rest: None,
            without_dilatancy: is_bound.then(|| without_dilatancy(task, analysis, found)).flatten(),
            by: Lower::SmoothSides(misfit),
        });
    };
    let path = LoadPath { end: goal, steps: STEPS, bracket: BRACKET * goal, goes_back: false, ..task.path };
    let stiff = Task { path, ..laws.task(task) };
    let run = drive(&stiff, &Solver::Implicit(implicit::Settings::default()));
    let (lower, by) = match &run.outcome {
        Outcome::Equilibrium => return None,
        Outcome::Collapsed { at } => (at.value(), Lower::StiffJoints),
        Outcome::UnstableAtRest => (0.0, Lower::StiffJoints),
        other => {
            let last = run.steps.iter().rev().nth(1).map_or(0.0, |step| step.level.value());
            (last, Lower::StiffJointsAtLeast(other.reason()))
        }
    };
    let without_dilatancy = is_bound.then(|| without_dilatancy(task, analysis, found)).flatten();
    Some(Undecided { lower, upper: found, needed, at_rest: thrust_at_rest(&stiff), without_dilatancy, by })
}

/// The height of what is behind a wall that stiff joints bear; `None` where the wall cannot have such joints, or their solver is lost.
pub(super) fn height_of_stiff_joints(task: &Task<'_>, behind: &Behind) -> Option<f64> {
    let laws = Stiff::of(task.wall, task.laws, misfit(task))??;
    let solver = Solver::Implicit(implicit::Settings::default());
    let run = raise(&laws.task(task), behind, Lifts::COARSE, &solver, Witness::NOBODY);
    match run.outcome {
        Outcome::Collapsed { at } => Some(at.value()),
        Outcome::Equilibrium => Some(behind.height),
        Outcome::UnstableAtRest => Some(0.0),
        _ => None,
    }
}

/// What a wall bears without dilatancy, where what it bears with dilatancy was `found` and is clearly more.
fn without_dilatancy(task: &Task<'_>, analysis: &Analysis, found: Option<f64>) -> Option<f64> {
    if analysis.settings.flow != Flow::Associative {
        return None;
    }
    let settings = Settings { flow: Flow::NonAssociative, ..analysis.settings };
    let limit = borne(&Analysis { settings, ..analysis.clone() }, task.path.growing, &task.loads);
    level(&limit).filter(|level| *level < SAME * found.unwrap_or(task.path.end))
}

/// By how much (m) blocks that touch to within the gap that counts as closed miss one another, or overlap.
fn misfit(task: &Task<'_>) -> f64 {
    let built = Assembly::new(task.wall, task.laws, task.contact);
    let bodies = &built.bodies.all;
    let gaps = built.joints.all.iter().flat_map(|joint| joint.corners(bodies)).map(|(_, gap)| gap);
    gaps.filter(|gap| *gap <= task.contact.closed).fold(0.0, |most: f64, gap| most.max(gap.abs()))
}

/// The same of a load that rigid blocks bore in time: by contact dynamics, which finds one of the states that statics leaves open.
pub(super) fn left_open(task: &Task<'_>, run: &Run) -> Option<Undecided> {
    let Changes { loss, settlements, .. } = &task.changes;
    let pushes = match task.path.growing {
        Growing::Factor => !task.loads.is_empty(),
        Growing::Tilt(_) | Growing::Multiplier { .. } => true,
        Growing::Drift => false,
    };
    if !pushes || loss.is_some() || !settlements.is_empty() {
        return None;
    }
    let found = match run.outcome {
        Outcome::Collapsed { at } => Some(at.value()),
        Outcome::Equilibrium => None,
        _ => return None,
    };
    let Task { wall, laws, contact, .. } = *task;
    let analysis = Analysis::new(wall, laws, contact, Settings::default()).with_ties(&task.ties);
    let bound = level(&borne(&analysis, task.path.growing, &task.loads));
    undecided(task, &analysis, bound, found)
}

/// The thrust in upright joints of a wall at rest under its weight (N).
fn thrust_at_rest(task: &Task<'_>) -> Option<f64> {
    let mut built = task.assembled();
    let (gravity, factor) = task.path.loads(0.0);
    (built.gravity, built.load_factor) = (gravity, factor);
    let mut at_rest = Equilibrium::of(built, implicit::Settings::default());
    let settled = at_rest.settle(&mut |_| false);
    (settled.status == Status::Equilibrium).then(|| side_thrust(at_rest.assembly()))
}

/// The sum of the normal forces in upright joints (N).
fn side_thrust(assembly: &Assembly<'_>) -> f64 {
    let bodies = &assembly.bodies.all;
    let thrust = assembly.joints.all.iter().map(|joint| {
        let (_, normal) = joint.place(bodies);
        if is_upright(&normal) { joint.carried(bodies).dot(&normal).abs() } else { 0.0 }
    });
    thrust.sum()
}

/// The loads of a level for limit analysis.
pub(super) fn loads(task: &Task<'_>, level: f64) -> Loads {
    let (gravity, factor) = task.path.loads(level);
    let points = task.loads.iter().map(|load| Load { force: load.force * factor, ..*load }.when(When::Dead));
    Loads { dead: gravity, live: Vec3::zeros(), points: points.collect() }
}

/// The laws of a wall's joints with a stiffness of their own: linear, and half as stiff in shear.
struct Stiff<'l> {
    laws: &'l dyn JointLaws,
    /// Normal stiffness (Pa/m).
    kn: f64,
    /// Edge of the cube with the mean volume of the blocks that move (m).
    size: f64,
}

impl<'l> Stiff<'l> {
    /// Of a wall whose blocks miss one another by so much (m); `None` where nothing moves, and `Some(None)` where joints that smooth the misfit would
    /// not be stiff.
    fn of(wall: &Wall, laws: &'l dyn JointLaws, misfit: f64) -> Option<Option<Self>> {
        let moving = || wall.blocks.iter().filter(|b| !matches!(b.support, Support::Fixed | Support::Absent));
        let corners = || moving().flat_map(|block| &block.shape.vertices).map(|v| v.z);
        let height = corners().fold(f64::NEG_INFINITY, f64::max) - corners().fold(f64::INFINITY, f64::min);
        let heaviest = moving().map(|block| block.density).fold(0.0, f64::max);
        let volume = moving().map(|block| block.volume()).fold(0.0, |sum, volume| sum + volume);
        let size = cbrt(volume / moving().count() as f64);
        let closes = (CLOSES * size).max(SMOOTHS * misfit);
        let kn = heaviest * STANDARD_GRAVITY * height / closes;
        (kn.is_finite() && kn > 0.0).then(|| (closes <= SOFT * size).then_some(Stiff { laws, kn, size }))
    }

    /// A task with these joints; nothing changes on its way.
    fn task<'s>(&'s self, task: &Task<'s>) -> Task<'s> {
        Task {
            laws: self,
            ties: task.ties.iter().map(|tie| self.tie(tie)).collect(),
            platform: None,
            changes: Changes::default(),
            ..task.under(task.loads.clone(), task.path)
        }
    }

    /// A rope that stretches as little as joints close, and is taut.
    fn tie(&self, tie: &Tie) -> Tie {
        Tie { stiffness: self.kn * self.size * self.size, slack: 0.0, pretension: 0.0, ..*tie }
    }
}

impl JointLaws for Stiff<'_> {
    fn of(&self, a: u32, b: u32) -> Coulomb {
        Coulomb { normal: NormalLaw::Linear { kn: self.kn }, ks: 0.5 * self.kn, ..self.laws.of(a, b) }
    }
}
