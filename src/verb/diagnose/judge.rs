//! Who judges what was measured, and how well: the same for a diagnosis, and for `--prepare`, which keeps the self-test beside the walls.

use std::fs;
use std::path::Path;

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use crate::critic::{Bank, Design, Diagnosis, Effort, Judge, Limits, Plan, SEEDS, SelfTest, World};
use crate::ensemble::replace_file;
use crate::study::{Described, Nuisance, Study, sha256};
use crate::terminal::doing::doing;
use crate::terminal::failure::Failure;

/// What a judge does before he judges.
pub(crate) const LEARNING: &str = "learning to tell the causes apart";
/// Name of the file of a self-test.
const KEPT: &str = "self-test.json";
/// Campaigns of each cause in it.
const CAMPAIGNS: u64 = 100;

/// A self-test with what it is of.
#[derive(Serialize, Deserialize)]
struct Kept {
    of: String,
    test: SelfTest,
}

/// What campaigns are simulated from.
pub(crate) fn world<'s>(
    study: &'s Study,
    mechanisms: &'s [Described],
    nuisances: &'s [Nuisance; 3],
    plan: &Plan,
    bank: &Bank,
) -> Result<World<'s>, Failure> {
    World::new(study, mechanisms, nuisances, plan, bank).ok_or_else(|| {
        let text = match study.drifts().is_empty() {
            true => "the bank holds too few walls that fell: ask for more --points, or for a load path that ends later",
            false => "the bank holds too few walls that came to rest while they were pushed: ask for more --points",
        };
        Failure::Run(text.to_owned())
    })
}

/// Who judges campaigns of a design.
pub(crate) fn judge<'w>(world: &'w World<'w>, design: &Design, seed: u64) -> Result<Judge<'w>, Failure> {
    let trained = doing(LEARNING, |_| Judge::trained(world, design, Effort::default(), seed));
    trained.ok_or_else(nothing_to_compare)
}

/// No reading can be set against a simulation.
pub(crate) fn nothing_to_compare() -> Failure {
    Failure::Input(
        "none of the measurements can be set against a simulation: at their tilts or drifts simulated walls have fallen".to_owned(),
    )
}

/// The self-test of a judge: the one that is kept in the bank's folder, if it is of the same.
pub(crate) fn self_test(judge: &Judge<'_>, plan: &Plan, seed: u64, folder: &Path) -> SelfTest {
    // Who the judge is takes as long as some diagnoses: it is asked only where something is kept.
    let own = kept(folder).filter(|kept| kept.of == identity(judge, plan, seed));
    own.map_or_else(|| computed(judge, seed, 0), |kept| kept.test)
}

/// Keeps the self-test of a judge in the bank's folder, with so many campaigns of each cause judged by all that a diagnosis does.
pub(crate) fn keep_self_test(
    judge: &Judge<'_>,
    plan: &Plan,
    seed: u64,
    folder: &Path,
    judged: u64,
) -> Result<(), Failure> {
    let of = identity(judge, plan, seed);
    let enough = |kept: &Kept| kept.test.rows.iter().all(|row| row.judged.campaigns >= judged);
    let own = kept(folder).filter(|kept| kept.of == of && enough(kept));
    let own = own.unwrap_or_else(|| Kept { of, test: computed(judge, seed, judged) });
    let mut json = serde_json::to_vec_pretty(&own).map_err(|error| Failure::Run(error.to_string()))?;
    json.push(b'\n');
    Ok(replace_file(&folder.join(KEPT), &json)?)
}

/// What is kept in a folder, of whatever it is, if it can be a self-test.
fn kept(folder: &Path) -> Option<Kept> {
    let kept: Kept = serde_json::from_slice(&fs::read(folder.join(KEPT)).ok()?).ok()?;
    Some(kept).filter(|kept| kept.test.is_sound())
}

/// A self-test with so many campaigns of each cause judged by all that a diagnosis does.
fn computed(judge: &Judge<'_>, seed: u64, judged: u64) -> SelfTest {
    doing("testing how often such a diagnosis is right", |_| {
        judge.self_test(&Limits::default(), CAMPAIGNS, judged, tested(seed))
    })
}

/// Seed of its campaigns.
fn tested(seed: u64) -> u64 {
    seed.wrapping_add(2 * SEEDS)
}

/// All that a self-test hangs on; all that is said of one campaign of every cause stands for how the judge judges, so that another
/// way of judging tests itself anew.
fn identity(judge: &Judge<'_>, plan: &Plan, seed: u64) -> String {
    let (hash, measured) = (&plan.study.hash, &judge.world.study().measured);
    let limits = Limits::default();
    let said: Vec<Diagnosis> = judge
        .ranking
        .causes()
        .par_iter()
        .map(|cause| judge.said_of(*cause, &limits, tested(seed), CAMPAIGNS))
        .collect();
    sha256(format!("{hash} {CAMPAIGNS} {seed} {limits:?} {measured:?} {said:?}").as_bytes())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::critic::made;

    #[test]
    #[ignore = "slow: 60 s of processor time"]
    fn a_judge_who_has_learnt_otherwise_is_not_taken_for_the_same() {
        let made = made();
        let (world, (design, _)) = (made.world(), Design::of(&made.study));
        let plan =
            Plan::new(&made.study, &made.mechanisms, &made.nuisances, 2).expect("the priors are allowed");
        let learnt = |training: u64| {
            let effort = Effort { reference: 200, training };
            identity(&Judge::trained(&world, &design, effort, 5).expect("it can be told"), &plan, 7)
        };
        assert_eq!(learnt(20), learnt(20));
        assert_ne!(learnt(20), learnt(25));
    }
}
