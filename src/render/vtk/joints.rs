//! The joints of a wall as polygons.

use crate::math::Vec3;
use crate::model::{BuiltJoint, JointReading, Replay, ReplayState};
use crate::render::vtk::xml::{array, field, grid, vector};

/// VTK's number for a polygon (vtkCellType.h, `VTK_POLYGON`).
const POLYGON: u8 = 7;
/// A joint that gapes by less (m) is closed.
const CLOSED: f64 = 1e-7;

/// The joints in a state of their wall's replay: one polygon each, where it was built, in the order of the replay; those of blocks that
/// are not the wall's on both sides are left out. `centroids` are those of the wall's blocks as built (m).
///
/// Point data: `displacement` (m), by which the polygon goes with the first of its blocks. Cell data: `first` and `second` (block ids; -1
/// is the ground or another block beside the wall), `area` (m^2), `opening` and `slip` (m), `normal_stress` (pressure) and
/// `shear_stress` (Pa), and `state`: 0 closed, 1 open in a part of it, 2 open (it carries nothing), 3 gone with one of its blocks.
pub(crate) fn in_state(replay: &Replay, centroids: &[Vec3], state: &ReplayState) -> String {
    let is_ours = |(joint, _): &(&BuiltJoint, &JointReading)| (joint.blocks[0] as usize) < centroids.len();
    let joints: Vec<(&BuiltJoint, &JointReading)> =
        replay.joints.iter().zip(&state.joints).filter(is_ours).collect();
    let corners = || joints.iter().flat_map(|(joint, _)| &joint.polygon);
    let points = corners().count();
    grid([points, joints.len()], &field(state), |text| {
        text.push_str("<Points>\n");
        array(text, "Float64", "Points", 3, corners().map(vector));
        text.push_str("</Points>\n<Cells>\n");
        array(text, "Int64", "connectivity", 1, 0..points);
        let ends = joints.iter().scan(0, |end, (joint, _)| {
            *end += joint.polygon.len();
            Some(*end)
        });
        array(text, "Int64", "offsets", 1, ends);
        array(text, "UInt8", "types", 1, joints.iter().map(|_| POLYGON));
        text.push_str("</Cells>\n<PointData Vectors=\"displacement\">\n");
        let moved = joints.iter().flat_map(|(joint, _)| {
            let block = joint.blocks[0] as usize;
            state.poses[block].displacing(centroids[block], &joint.polygon)
        });
        array(text, "Float64", "displacement", 3, moved.map(|v| vector(&v)));
        text.push_str("</PointData>\n<CellData>\n");
        let id = |block: u32| if (block as usize) < centroids.len() { i64::from(block) } else { -1 };
        array(text, "Int64", "first", 1, joints.iter().map(|(joint, _)| id(joint.blocks[0])));
        array(text, "Int64", "second", 1, joints.iter().map(|(joint, _)| id(joint.blocks[1])));
        array(text, "Float64", "area", 1, joints.iter().map(|(joint, _)| joint.area));
        let read = |of: fn(&JointReading) -> f64| joints.iter().map(move |(_, reading)| of(reading));
        array(text, "Float64", "opening", 1, read(|of| of.opening));
        array(text, "Float64", "slip", 1, read(|of| of.slip));
        array(text, "Float64", "normal_stress", 1, read(|of| of.normal_stress));
        array(text, "Float64", "shear_stress", 1, read(|of| of.shear_stress));
        array(text, "UInt8", "state", 1, joints.iter().map(|joint| state_number(*joint, &state.gone)));
        text.push_str("</CellData>\n");
    })
}

fn state_number((joint, reading): (&BuiltJoint, &JointReading), gone: &[u32]) -> u8 {
    match () {
        () if joint.blocks.iter().any(|id| gone.binary_search(id).is_ok()) => 3,
        () if reading.normal_stress == 0.0 && reading.shear_stress == 0.0 => 2,
        () if reading.opening > CLOSED => 1,
        () => 0,
    }
}
