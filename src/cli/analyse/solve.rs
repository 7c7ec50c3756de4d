//! From the arguments to a solver and its answer.

use crate::cli::analyse::answer::Answer;
use crate::cli::analyse::meetings::Fit;
use crate::cli::arguments::{Analyse, DirectionName, FlowName, LoadName, MethodName};
use crate::law::{CohesionAfterSlip, Coulomb, NormalLaw, Sampling};
use crate::math::{Vec3, radians, tan};
use crate::model::Wall;
use crate::solve::limit;

/// Limit analysis needs no stiffness, but a law has one.
const ANY_STIFFNESS: f64 = 1e9;
/// A block is part of a mechanism when it moves at this share of the fastest corner.
const MOVES: f64 = 0.01;

/// The law of all joints: no tension, cohesion kept after slip, ks = kn / 2 unless it is given.
pub(crate) fn law(arguments: &Analyse) -> Coulomb {
    let kn = arguments.kn.unwrap_or(ANY_STIFFNESS);
    Coulomb {
        normal: NormalLaw::Linear { kn },
        ks: arguments.ks.unwrap_or(0.5 * kn),
        tan_phi: tan(radians(arguments.phi_deg)),
        cohesion: arguments.cohesion,
        tension: 0.0,
        cohesion_after_slip: CohesionAfterSlip::Kept,
        sampling: Sampling::Area,
        bonded: false,
    }
}

/// Solves the wall as asked.
pub(crate) fn solve(arguments: &Analyse, wall: &Wall, law: &Coulomb, fit: &Fit) -> Answer {
    match arguments.solver {
        MethodName::Limit => by_limit_analysis(arguments, wall, law, fit),
    }
}

fn by_limit_analysis(arguments: &Analyse, wall: &Wall, law: &Coulomb, fit: &Fit) -> Answer {
    let flow = match arguments.flow.unwrap_or(FlowName::Associative) {
        FlowName::Associative => limit::Flow::Associative,
        FlowName::NonAssociative => limit::Flow::NonAssociative,
    };
    let settings = limit::Settings { flow, closed_gap: fit.contact.touch, ..limit::Settings::default() };
    let analysis = limit::Analysis::new(wall, law, fit.contact, settings);
    let direction = unit(arguments.direction);
    let found = match arguments.load {
        LoadName::Tilt => analysis.tilt(direction, &[]),
        LoadName::Lateral => analysis.multiplier(&limit::Loads::lateral(direction)),
    };
    let speed = |i: usize| {
        let (motion, block) = (&found.mechanism[i], &wall.blocks[i]);
        motion.velocity.norm() + motion.spin.norm() * 0.5 * block.shape.diameter()
    };
    let fastest = (0..found.mechanism.len()).map(speed).fold(0.0, f64::max);
    Answer {
        moving: (0..found.mechanism.len()).filter(|&i| speed(i) > MOVES * fastest).collect(),
        loose: Vec::new(),
        meaning: format!("{}: {}", arguments.flow.unwrap_or(FlowName::Associative).name(), flow.meaning()),
        warnings: Vec::new(),
        outcome: found.outcome,
    }
}

fn unit(direction: DirectionName) -> Vec3 {
    match direction {
        DirectionName::XPlus => Vec3::x(),
        DirectionName::XMinus => -Vec3::x(),
        DirectionName::YPlus => Vec3::y(),
        DirectionName::YMinus => -Vec3::y(),
    }
}
