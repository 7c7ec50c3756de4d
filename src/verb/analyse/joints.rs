//! How a joint of a wall is told: what it does, in the JSON objects, and in words where its blocks part.

use serde_json::{Value, json};

use crate::exchange::WallFile;
use crate::protocol::JointState;
use crate::verb::wall::condition::Condition;

/// A joint that gapes by less (m) is not named among those that open.
const TOLD_FROM: f64 = 1e-6;
/// Joints that are named.
const NAMED: usize = 10;

/// The joints in the JSON object, each with its condition.
pub(crate) fn objects(file: &WallFile, joints: &[JointState], conditions: &[Condition]) -> Value {
    joints.iter().zip(conditions).map(|(joint, condition)| object(file, joint, *condition)).collect()
}

/// A joint in the JSON object.
fn object(file: &WallFile, joint: &JointState, condition: Condition) -> Value {
    json!({
        "blocks": joint.blocks.map(|at| file.ids[at as usize]),
        "state": condition.name(),
        "place_m": [joint.place.x, joint.place.y, joint.place.z],
        "area_m2": joint.area, "opening": joint.opening, "slip": joint.slip, "slipped_share": joint.slipped,
        "force_on_second_n": [joint.force.x, joint.force.y, joint.force.z], "pressure_pa": joint.pressure,
    })
}

/// The joints that gape, the widest first: their blocks and by how much.
pub(crate) fn open(file: &WallFile, joints: &[JointState]) -> String {
    let mut open: Vec<&JointState> = joints.iter().filter(|joint| joint.opening > TOLD_FROM).collect();
    open.sort_by(|a, b| b.opening.total_cmp(&a.opening));
    let said = |joint: &&JointState| {
        let [a, b] = joint.blocks.map(|at| file.names[at as usize].as_str());
        format!("{a} - {b} by {:.3} mm", 1e3 * joint.opening)
    };
    let named: Vec<String> = open.iter().take(NAMED).map(said).collect();
    match open.len() {
        0 => "none".to_owned(),
        more if more > NAMED => format!("{}, and {} more", named.join(", "), more - NAMED),
        _ => named.join(", "),
    }
}
