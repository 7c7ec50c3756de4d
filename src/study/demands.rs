//! What a study demands of its solver, by the words in which it is stated.

use crate::protocol::{Observes, Protocol, Rate};
use crate::solve::explicit::Rayleigh;
use crate::solve::{Demand, Solver};
use crate::study::checked::{Arm, StatedLaw};

impl Arm {
    /// What of its mechanisms and joints a solver refuses, in words.
    pub fn unfit_for(&self, solver: &Solver) -> Vec<String> {
        let (its, joint) = (&self.mechanisms, &self.joint);
        let softens = its.friction.is_some_and(|change| change.residual < 1.0);
        let by_table = matches!(joint.normal_law, StatedLaw::Table(_));
        let crushes = joint.compressive_strength.is_some();
        let demands = [
            (its.joint_closure.is_some(), Demand::Closure, "joint_closure"),
            (its.stress_stiffening.is_some(), Demand::StressStiffening, "stress_stiffening"),
            (its.base_compliance.is_some(), Demand::BaseCompliance, "base_compliance"),
            (its.wedge_loss.is_some(), Demand::WedgeLoss, "wedge_loss"),
            (its.creep.is_some(), Demand::Creep, "creep"),
            (its.contact_area.is_some(), Demand::ContactArea, "contact_area"),
            (softens, Demand::Weakening, "mechanism.friction.residual_share"),
            (by_table, Demand::ClosureTable, "joint.normal_law = \"table\""),
            (crushes, Demand::CompressiveStrength, "joint.compressive_strength_pa"),
        ];
        refused(solver, demands)
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
        Protocol::Shear(_) => Vec::new(),
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
