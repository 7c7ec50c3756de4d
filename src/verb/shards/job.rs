//! The walls that are shared out: those of a study, of the bank that its diagnoses rest on, or of a batch that a capacity waits for.

use std::path::{Path, PathBuf};

use crate::ensemble::rare::Batch;
use crate::ensemble::shard::{ShardError, Walls, Work};
use crate::ensemble::{Manifest, Row, RunError, Task, evaluate};
use crate::study::{ElementStudy, Study};
use crate::terminal::failure::Failure;
use crate::verb::arguments::Which;
use crate::verb::diagnose::bank;
use crate::verb::diagnose::bank::Prepared;
use crate::verb::locate;
use crate::verb::run::work as run;
use crate::verb::shards::ask;

/// Walls with the way that they are evaluated.
pub(crate) struct Job {
    /// Folder of the study.
    pub place: PathBuf,
    /// Which walls.
    pub kind: Walls,
    /// The study as it was asked for.
    pub study: Study,
    /// What its walls are made into.
    pub made: Made,
}

/// What the walls of a study are made into.
pub(crate) enum Made {
    /// Nothing else: they are its own.
    Own,
    /// A bank.
    Bank(Prepared),
    /// A batch, and its walls as a study.
    Batch(Batch, Study),
}

impl Job {
    /// What the arguments ask for.
    pub fn asked(arguments: &ask::Walls) -> Result<Job, Failure> {
        let given = [
            ("--variant", arguments.which.variant.is_some()),
            ("--members", arguments.ensemble.members.is_some()),
            ("--seed", arguments.ensemble.seed.is_some()),
            ("--solver", arguments.solver.is_some()),
            ("--bank", arguments.bank),
            ("--points", arguments.points.is_some()),
            ("--measured", arguments.measured.is_some()),
        ];
        let none_of =
            |options: &[&str], why: &str| match given.iter().find(|(name, is)| *is && options.contains(name))
            {
                Some((name, _)) => Err(Failure::Usage(format!("{name} {why}; leave it out"))),
                None => Ok(()),
            };
        let folder = &arguments.which.study;
        if Batch::is_in(folder) {
            none_of(&given.map(|(name, _)| name), "is for a study, and a batch is of one already")?;
            if arguments.out.is_some() {
                let text = "--out: the shards of a batch lie in its own folder; leave it out";
                return Err(Failure::Usage(text.to_owned()));
            }
            return Job::of_batch(folder, None);
        }
        let place = locate::folder(folder)?;
        if ElementStudy::is_in(&place) {
            let text = "it compares types of elements, whose times are of one machine: pirca run it there";
            return Err(Failure::Input(format!("{}: {text}", place.display())));
        }
        if !arguments.bank {
            none_of(&["--points", "--measured"], "is for the walls of a --bank")?;
            let loaded = locate::any_study(&arguments.which)?;
            let study = run::asked(loaded.study, arguments.solver, &arguments.ensemble)?;
            return Ok(Job { place, kind: Walls::Own, study, made: Made::Own });
        }
        none_of(&["--members", "--seed", "--solver"], "is for a study's own walls, and --bank is given")?;
        let whole = |file: &PathBuf| file.canonicalize().unwrap_or_else(|_| file.clone());
        let points = arguments.points.unwrap_or(bank::POINTS);
        Job::of_bank(place, &arguments.which, arguments.measured.as_ref().map(whole), points)
    }

    /// The walls of work that shards in a folder say they are of. The study lies where the first shard found it, unless its folder is
    /// named.
    pub fn of_work(out: &Path, work: &Work, study: Option<&Path>) -> Result<Job, Failure> {
        let job = match &work.walls {
            Walls::Batch => Job::of_batch(out, study)?,
            Walls::Own => {
                let place = locate::again(study, &work.study, &work.manifest, out)?;
                let (_, study) = locate::as_run(&place, &work.manifest)?;
                Job { place, kind: Walls::Own, study, made: Made::Own }
            }
            Walls::Bank { measured, points } => {
                let place = locate::again(study, &work.study, &work.manifest, out)?;
                let variant = work.manifest.variant.clone();
                let which = Which { study: place.clone(), variant, json: false };
                let mut job = Job::of_bank(place, &which, measured.clone(), *points)?;
                if let Made::Bank(bank) = &mut job.made {
                    locate::keep_name(&mut bank.plan.study, &work.manifest);
                }
                job
            }
        };
        as_begun((out, &job.place), &work.manifest, job.walls())?;
        Ok(job)
    }

    fn of_bank(
        place: PathBuf,
        which: &Which,
        measured: Option<PathBuf>,
        points: u64,
    ) -> Result<Job, Failure> {
        let study = bank::measured(which, measured.as_deref())?.study;
        let prepared = bank::prepared(&study, which, points)?;
        Ok(Job { place, kind: Walls::Bank { measured, points }, study, made: Made::Bank(prepared) })
    }

    fn of_batch(folder: &Path, study: Option<&Path>) -> Result<Job, Failure> {
        let batch = Batch::read(folder)?;
        let place = locate::again(study, &batch.study, &batch.manifest, folder)?;
        let (_, study) = locate::as_run(&place, &batch.manifest)?;
        as_begun((folder, &place), &batch.manifest, &study)?;
        let walls = batch.walls(&study);
        Ok(Job { place, kind: Walls::Batch, study, made: Made::Batch(batch, walls) })
    }

    /// The study whose arms have the walls.
    pub fn walls(&self) -> &Study {
        match &self.made {
            Made::Own => &self.study,
            Made::Bank(bank) => &bank.plan.study,
            Made::Batch(_, walls) => walls,
        }
    }

    /// Evaluates one of them.
    pub fn evaluate(&self, task: Task) -> Row {
        match &self.made {
            Made::Own => evaluate(&self.study, task),
            Made::Bank(bank) => bank.plan.evaluate(task),
            Made::Batch(batch, _) => batch.evaluate(&self.study, task),
        }
    }
}

/// That the study at a place is as it was when the work in a folder began.
fn as_begun((out, place): (&Path, &Path), begun: &Manifest, study: &Study) -> Result<(), Failure> {
    let differences = begun.differences(&Manifest::of(study));
    match differences.is_empty() {
        true => Ok(()),
        false => {
            let (folder, study) = (out.to_path_buf(), place.to_path_buf());
            let error = ShardError::OtherStudy { folder, study, differences };
            Err(RunError::from(error).into())
        }
    }
}
