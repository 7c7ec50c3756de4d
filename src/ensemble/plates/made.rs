//! The plate that stands for a wall of an arm: what spans, what holds it, what loads it.

use crate::homogenise::plate::{Edge, Edges, Plate};
use crate::math::{STANDARD_GRAVITY, Vec3, radians, tan};
use crate::model::Cell;
use crate::protocol::{Ends, Protocol};
use crate::solve::{Solver, limit};
use crate::study::{Arm, OnPlate};

/// Cells of the mesh over the height of a plate, and as many along it as make them square, up to so many.
const ROWS: usize = 5;
const MOST: usize = 40;
/// How many stones a fold at a led end is away from it, in the mean of courses that begin with a whole stone and with half of one: a stone that
/// is led does not turn, so that the plate folds at the first head joints only.
const LED: f64 = 0.75;

/// Why an arm's walls are no plates. Says what is in the way and how to mend it.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum NoPlate {
    /// Another load.
    #[error(
        "walls are judged as plates under a tilt or a lateral load; load.protocol is neither \"tilting\" nor \"lateral\""
    )]
    Load,
    /// Cohesion or tensile strength.
    #[error(
        "joints have cohesion or tensile strength, but what a plate bears is taken from its weight alone: set joint.cohesion_pa and \
         joint.tension_pa to 0"
    )]
    Bond,
    /// Ends on springs.
    #[error(
        "restraint.ends is joint_springs, which no plate has: take free, out_of_plane, fixed_end_blocks or ropes"
    )]
    Springs,
    /// A strip along the foot.
    #[error("restraint.strip_height_m holds the foot in a way that no plate has: leave it out")]
    Strip,
    /// A wall that leans or is turned round.
    #[error("walls that lean or are turned round are no plates: leave out mechanism.lean_deg and turned")]
    Placed,
    /// Mechanisms or joints that limit analysis does not have.
    #[error("limit analysis, by which walls are judged, refuses {0}; leave it out")]
    Unfit(String),
    /// Ropes on the other side.
    #[error("ropes hold a plate on its front: with restraint.ends = \"ropes\" take load.towards = \"y+\"")]
    RopesBehind,
    /// Ropes that push.
    #[error("ropes hold a plate one way only: take restraint.rope.sides = \"downhill\"")]
    Struts,
    /// Led ends that meet.
    #[error("the wall is {length} m long and its led end stones take up {led} m: make it longer")]
    TooShort {
        /// Length of the wall (m).
        length: f64,
        /// Length of the led stones at both ends together (m).
        led: f64,
    },
}

/// Whether walls of an arm can be plates at all, before any cell is built.
///
/// # Errors
/// [`NoPlate`] names what is in the way.
pub fn check_plate(arm: &Arm, protocol: &Protocol) -> Result<(), NoPlate> {
    let joint = &arm.joint;
    let bond = joint.tension != 0.0 || joint.cohesion.support() != (0.0, 0.0);
    if bond || arm.mechanisms.on_plate(OnPlate::Bonded) {
        return Err(NoPlate::Bond);
    }
    if let Some(unfit) = arm.unfit_for(&Solver::Limit(limit::Settings::default())).into_iter().next() {
        return Err(NoPlate::Unfit(unfit));
    }
    if arm.turned || arm.mechanisms.on_plate(OnPlate::Placed) {
        return Err(NoPlate::Placed);
    }
    if arm.restraint.base.strip_height.is_some() {
        return Err(NoPlate::Strip);
    }
    let backwards = match protocol {
        Protocol::Tilting(tilting) => tilting.towards.is_backwards(),
        Protocol::Lateral(_) => false,
        Protocol::Shear(_) | Protocol::BaseMotion(_) | Protocol::Retaining(_) => return Err(NoPlate::Load),
    };
    match arm.restraint.ends {
        Ends::JointSprings => Err(NoPlate::Springs),
        Ends::Ropes(rope) if rope.two_sided => Err(NoPlate::Struts),
        Ends::Ropes(_) if backwards => Err(NoPlate::RopesBehind),
        Ends::Ropes(_) | Ends::Free | Ends::FixedEndBlocks | Ends::OutOfPlane => Ok(()),
    }
}

/// The plate of an arm as drawn, with the weight of a cell of so many stones along the wall and courses.
///
/// Ropes hold at the middle of every course of mean height. A plate between led ends spans from one of their first head joints to the other.
///
/// # Errors
/// As [`check_plate`].
pub(super) fn plate_of(
    arm: &Arm,
    protocol: &Protocol,
    cell: &Cell,
    [along, courses]: [u32; 2],
) -> Result<Plate, NoPlate> {
    check_plate(arm, protocol)?;
    let outline = &arm.layout.outline;
    let mass: f64 = cell.blocks.iter().map(|block| block.mass()).sum();
    let weight = mass * STANDARD_GRAVITY / cell.area();
    let (live, base_over_top) = match protocol {
        Protocol::Lateral(lateral) => (Vec3::y() * lateral.mean_pressure, lateral.base_over_top),
        Protocol::Tilting(tilting) => (tilting.towards.unit() * weight, 1.0),
        Protocol::Shear(_) | Protocol::BaseMotion(_) | Protocol::Retaining(_) => return Err(NoPlate::Load),
    };
    let end = match arm.restraint.ends {
        Ends::FixedEndBlocks => Edge::Held,
        Ends::OutOfPlane => Edge::Guided,
        Ends::Free | Ends::Ropes(_) | Ends::JointSprings => Edge::Free,
    };
    let led = match end {
        Edge::Guided => 2.0 * LED * cell.lattice[0][0] / f64::from(along),
        _ => 0.0,
    };
    let length = outline.length - led;
    if length <= 0.0 {
        return Err(NoPlate::TooShort { length: outline.length, led });
    }
    let ropes = match arm.restraint.ends {
        Ends::Ropes(rope) => {
            let course = cell.lattice[1][1] / f64::from(courses);
            let rows = (outline.height / course).round().max(1.0) as usize;
            let height = |row: usize| outline.height * (row as f64 + 0.5) / rows as f64;
            let ends = [rope.from_end, length - rope.from_end];
            (0..rows).flat_map(|row| ends.map(|x| [x, height(row)])).collect()
        }
        _ => Vec::new(),
    };
    let columns = (ROWS as f64 * length / outline.height).round() as usize;
    let friction = arm.restraint.base.tan_phi.unwrap_or_else(|| tan(radians(arm.joint.phi_deg.mean())));
    Ok(Plate {
        length,
        height: outline.height,
        mesh: [columns.clamp(ROWS, MOST), ROWS],
        weight,
        live: [live.x, live.y, live.z],
        base_over_top,
        edges: Edges { left: end, right: end, ..Edges::RESTING },
        ropes,
        base_friction: Some(friction),
    })
}
