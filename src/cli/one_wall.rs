//! The wall that a verb is about: a member of an arm at one stiffness of its joints, built.

use crate::cli::arguments::{OneWall as Arguments, Which};
use crate::cli::failure::Failure;
use crate::cli::locate;
use crate::ensemble::{self, Generated, Task};
use crate::protocol::Run;
use crate::study::{Arm, Study};

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
        let mut study = locate::study(which)?.study;
        if let Some(seed) = arguments.seed {
            study = study.with_seed(seed);
        }
        let index = arm_index(&study, arguments.arm.as_deref())?;
        let (arm, member) = (&study.arms[index], arguments.member);
        let kn = kn(arm, arguments.point)?;
        let generated = ensemble::build(&study, index as u32, member)
            .map_err(|e| Failure::Run(format!("arm {}, member {member}: invalid geometry: {e}", arm.name)))?;
        let task = Task { arm: index as u32, point: arguments.point, member };
        Ok(OneWall { study, task, kn, generated })
    }

    /// Takes it through the study's protocol.
    pub fn solved(&self) -> Run {
        ensemble::solve(&self.study, self.task, &self.generated.wall)
    }
}

/// The arm of that name, or the first one that is random, or else the first one.
fn arm_index(study: &Study, name: Option<&str>) -> Result<usize, Failure> {
    let Some(name) = name else {
        let random = study.arms.iter().position(ensemble::is_random);
        return Ok(random.unwrap_or(0));
    };
    study.arms.iter().position(|arm| arm.name == name).ok_or_else(|| {
        let names: Vec<_> = study.arms.iter().map(|arm| arm.name.as_str()).collect();
        Failure::Usage(format!("--arm {name}: the study has no such arm; it has {}", names.join(", ")))
    })
}

/// The joint stiffness (Pa/m) of an arm's point.
fn kn(arm: &Arm, point: u32) -> Result<f64, Failure> {
    arm.kn_points.get(point as usize).copied().ok_or_else(|| {
        let last = arm.kn_points.len() - 1;
        Failure::Usage(format!("--point {point}: arm {} has points 0 to {last}", arm.name))
    })
}
