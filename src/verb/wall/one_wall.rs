//! The wall that a verb is about: a member of an arm at one stiffness of its joints, built.

use std::path::Path;

use crate::ensemble;
use crate::ensemble::{Evaluated, Generated, Task};
use crate::model::{Level, Replay};
use crate::protocol::{Recorder, Run, Witness};
use crate::study::{Arm, Study};
use crate::terminal::doing::doing;
use crate::terminal::failure::Failure;
use crate::terminal::output;
use crate::verb::arguments::Which;
use crate::verb::arms::{arm_index, kn, numbered};
use crate::verb::locate;
use crate::verb::question::CAPACITY;
use crate::verb::wall::ask::OneWall as Arguments;

/// Most states of a replay.
pub(crate) const MOST_STATES: usize = 100;

/// A wall of a study.
pub(crate) struct OneWall {
    pub study: Study,
    pub task: Task,
    /// Normal stiffness of its joints (Pa/m).
    pub kn: f64,
    pub generated: Generated,
}

impl OneWall {
    /// Builds the wall that the arguments name.
    pub fn of(which: &Which, arguments: &Arguments) -> Result<OneWall, Failure> {
        let mut study = locate::any_study(which)?.study;
        if let Some(seed) = arguments.seed {
            study = study.with_seed(seed);
        }
        if let Some(members) = arguments.members {
            study = locate::with_members(study, members)?;
        }
        if let Some(number) = arguments.draw {
            return OneWall::drawn(study, number, arguments.draws.as_deref());
        }
        let index = arm_index(&study, arguments.arm.as_deref())?;
        let (arm, member) = (&study.arms[index], arguments.member);
        let kn = kn(arm, arguments.point)?;
        check_member(arm, member)?;
        OneWall::at(study, Task { arm: index as u32, point: arguments.point, member }, kn)
    }

    /// Builds the wall of a task.
    pub fn at(study: Study, task: Task, kn: f64) -> Result<OneWall, Failure> {
        let Task { arm, member, .. } = task;
        let name = &study.arms[arm as usize].name;
        let generated = ensemble::build(&study, arm, member)
            .map_err(|e| Failure::Run(format!("arm {name}, member {member}: invalid geometry: {e}")))?;
        Ok(OneWall { study, task, kn, generated })
    }

    /// The wall of that number among those that were drawn and moved for rare values.
    fn drawn(study: Study, number: u64, folder: Option<&Path>) -> Result<OneWall, Failure> {
        let folder = folder.map_or_else(|| output::default_folder(&study, CAPACITY), Path::to_path_buf);
        let Some(Evaluated { arm, point, draw, .. }) = ensemble::drawn(&folder, &study, number)? else {
            return Err(Failure::Usage(format!(
                "--draw {number}: {} holds no such wall of {}; evaluations.parquet there lists them, and the seed must be its own",
                folder.display(),
                study.name
            )));
        };
        let study = draw.study(&study);
        let generated = ensemble::build(&study, arm, draw.member)
            .map_err(|e| Failure::Run(format!("draw {number}: invalid geometry: {e}")))?;
        let kn = study.arms[arm as usize].kn_points[point as usize];
        Ok(OneWall { study, task: Task { arm, point, member: draw.member }, kn, generated })
    }

    /// Takes it through the study's protocol.
    pub fn solved(&self) -> Run {
        let stones = self.generated.wall.stones().count();
        let what = format!("solving {stones} stones with the {} solver", self.study.solver.name());
        doing(&what, |doing| self.solved_telling(&|level| doing.at(level)))
    }

    /// The same, with the replay if it is asked for.
    pub fn replayed_if(&self, asked: bool) -> (Run, Option<Replay>) {
        if !asked {
            return (self.solved(), None);
        }
        let what = format!("solving {} stones and letting them fall", self.generated.wall.stones().count());
        let (run, replay) = doing(&what, |doing| self.replayed(&|level| doing.at(level)));
        (run, Some(replay))
    }

    /// The same as [`OneWall::solved`], where somebody else says what is being done and is told how far it is.
    pub fn solved_telling(&self, tell: &dyn Fn(Level)) -> Run {
        self.seen_by(Witness { tell, recorder: None })
    }

    /// The same, with the states that it goes through, at most [`MOST_STATES`], and those of its fall where it falls.
    pub fn replayed(&self, tell: &dyn Fn(Level)) -> (Run, Replay) {
        let recorder = Recorder::new(MOST_STATES);
        let run = self.seen_by(Witness { tell, recorder: Some(&recorder) });
        (run, recorder.replay(self.generated.wall.blocks.len()))
    }

    fn seen_by(&self, witness: Witness<'_>) -> Run {
        ensemble::solve(&self.study, self.task, &self.generated.wall, witness)
    }
}

/// That an arm has a member of that number.
fn check_member(arm: &Arm, member: u64) -> Result<(), Failure> {
    if member < arm.members {
        return Ok(());
    }
    let fix = match (ensemble::is_random(arm), arm.members) {
        (true, 1) => "leave --member out, or raise members in study.toml",
        (true, _) => "choose one of them, or ask for more with --members or by members in study.toml",
        (false, _) => {
            "nothing in it is random, so that every wall would be the same: leave --member out, or choose another --arm"
        }
    };
    let walls = numbered(arm.members, "wall");
    Err(Failure::Usage(format!("--member {member}: arm {} has {walls}; {fix}", arm.name)))
}
