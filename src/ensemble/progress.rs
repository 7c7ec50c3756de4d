//! How a run tells what it is doing.

use std::fmt;

use crate::ensemble::{Row, Task};
use crate::study::Study;

/// Is told how a run goes; called from the worker threads, in the order in which members finish. Nothing that it does
/// can change a result.
pub trait Progress: Sync {
    /// The folder holds another run, of which walls are taken over.
    fn grown(&self, grown: &Grown);
    /// Before the first member: how many evaluations the run has in all, and which of them were recorded before.
    fn begin(&self, total: usize, recorded: &[&Row]);
    /// A member is evaluated and recorded.
    fn finished(&self, row: &Row);
    /// A member broke an invariant and is not recorded.
    fn broken(&self, task: Task);
    /// No member is being evaluated any more.
    fn end(&self);
    /// The tables of so many evaluations are being written.
    fn writes(&self, _evaluations: usize) {}
}

/// What a run takes over from another one in its folder.
#[derive(Clone, Debug, PartialEq)]
pub struct Grown {
    /// What makes it another run, one sentence each.
    pub differences: Vec<String>,
    /// By arm: its name, how many walls are taken over, and of how many.
    pub arms: Vec<(String, usize, usize)>,
    /// Recorded walls that are none of this run.
    pub aside: usize,
}

impl Grown {
    /// Of a study, for which these tasks are taken over.
    pub(super) fn of<'t>(
        study: &Study,
        differences: Vec<String>,
        taken: impl Iterator<Item = &'t Task>,
        aside: usize,
    ) -> Grown {
        let all = |arm: &crate::study::Arm| arm.members as usize * arm.kn_points.len();
        let mut arms: Vec<(String, usize, usize)> =
            study.arms.iter().map(|arm| (arm.name.clone(), 0, all(arm))).collect();
        taken.for_each(|task| arms[task.arm as usize].1 += 1);
        Grown { differences, arms, aside }
    }
}

impl fmt::Display for Grown {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "goes on from another run in this folder:")?;
        self.differences.iter().try_for_each(|difference| writeln!(f, "  {difference}"))?;
        let arm = |(name, taken, all): &(String, usize, usize)| format!("{name} {taken} of {all}");
        let arms: Vec<String> = self.arms.iter().map(arm).collect();
        write!(f, "taken over: {}", arms.join(", "))?;
        match self.aside {
            0 => Ok(()),
            1 => write!(f, "; 1 recorded wall is not part of this run and stays aside"),
            aside => write!(f, "; {aside} recorded walls are not part of this run and stay aside"),
        }
    }
}

/// Tells nobody.
pub struct Silent;

impl Progress for Silent {
    fn grown(&self, _grown: &Grown) {}
    fn begin(&self, _total: usize, _recorded: &[&Row]) {}
    fn finished(&self, _row: &Row) {}
    fn broken(&self, _task: Task) {}
    fn end(&self) {}
}
