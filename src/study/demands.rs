//! What a study demands of its solver, by the words in which it is stated.

use crate::protocol::{Observes, Protocol, Rate};
use crate::solve::explicit::Rayleigh;
use crate::solve::{Demand, Solver};
use crate::study::checked::{Arm, StatedLaw};

impl Arm {
    /// What of its causes and joints a solver refuses, in words.
    pub fn unfit_for(&self, solver: &Solver) -> Vec<String> {
        let by_table = matches!(self.joint.normal_law, StatedLaw::Table(_));
        let crushes = self.joint.compressive_strength.is_some();
        let of_causes = self.mechanisms.demands().map(|(demand, what)| (true, demand, what));
        let of_joints = [
            (by_table, Demand::ClosureTable, "joint.normal_law = \"table\""),
            (crushes, Demand::CompressiveStrength, "joint.compressive_strength_pa"),
        ];
        refused(solver, of_causes.chain(of_joints))
    }
}

/// What of some arms a solver refuses, in words, each once.
pub fn unfit_arms(solver: &Solver, arms: &[Arm]) -> Vec<String> {
    let mut unfit: Vec<String> = arms.iter().flat_map(|arm| arm.unfit_for(solver)).collect();
    unfit.sort();
    unfit.dedup();
    unfit
}

/// What a study asks for that a solver does not have, in words.
pub fn unfit_for(solver: &Solver, arms: &[Arm], protocol: &Protocol, agreement: bool) -> Vec<String> {
    let of_load = match protocol {
        Protocol::Tilting(tilting) => {
            let moves = tilting.observes == Observes::Displacement;
            vec![
                (matches!(tilting.rate, Rate::Dynamic(_)), Demand::Turning, "load.turning"),
                (moves, Demand::Displacements, "load.observes = \"displacement\""),
                (tilting.remainders, Demand::Remainders, "load.remainders"),
            ]
        }
        Protocol::Lateral(_) => {
            let what = "load.protocol = \"lateral\", which observes a displacement";
            vec![(true, Demand::ServiceDisplacement, what)]
        }
        Protocol::BaseMotion(base) => {
            let what = "load.protocol = \"base_motion\", which follows walls in time";
            let damped = base.rayleigh != Rayleigh::default();
            vec![(true, Demand::BaseMotion, what), (damped, Demand::RayleighDamping, "load.rayleigh_ratio")]
        }
        Protocol::Shear(_) | Protocol::Retaining(_) => Vec::new(),
    };
    let compared = (agreement, Demand::Agreement, "solver.agreement");
    let of_study = refused(solver, of_load.into_iter().chain([compared]));
    unfit_arms(solver, arms).into_iter().chain(of_study).collect()
}

/// Those demands that are made and refused: how each is stated, and why it is refused.
fn refused<'w>(solver: &Solver, demands: impl IntoIterator<Item = (bool, Demand, &'w str)>) -> Vec<String> {
    let made = demands.into_iter().filter(|(made, ..)| *made);
    made.filter_map(|(_, demand, what)| Some(format!("{what}: {}", solver.refuses(demand)?))).collect()
}
