//! The tilt at which an arm's wall overturns as one rigid body: no wall of loose stones with free ends stands beyond.

use crate::generate::BatteredFace;
use crate::math::atan2;
use crate::protocol::{Direction, Ends};
use crate::study::checked::Arm;

impl Arm {
    /// The tilt (rad) at which the weight of the whole wall, as it is drawn, passes over its foot on the side that goes down, or over
    /// the edge of a strip there: rigid, and with enough friction. Stones that move against each other fall earlier; ends that are
    /// held may make them stand longer.
    pub fn overturning_angle(&self, towards: Direction) -> f64 {
        let outline = &self.layout.outline;
        let (base, top, height) = (outline.base_thickness, outline.top_thickness, outline.height);
        // Of the trapezoid: the middle of its top, beside that of its base; its centroid.
        let front = match outline.battered_face {
            BatteredFace::Front => 0.5 * (top - base),
            BatteredFace::Back => 0.5 * (base - top),
            BatteredFace::Both => 0.0,
        };
        let up = height / 3.0 * (base + 2.0 * top) / (base + top);
        let strip = self.restraint.base.strip_height.unwrap_or(0.0).min(height);
        let unit = towards.unit();
        // How far the weight is from the edge that it turns over along the wall, and out of plane.
        let lengthwise = 0.5 * outline.length;
        let shift = if (unit.y > 0.0) == self.turned { -front } else { front };
        let along = shift * (base + 2.0 * top) / (3.0 * (base + top));
        // The face that goes down, at the height of the strip.
        let across = 0.5 * base + (shift + 0.5 * (top - base)) * strip / height - along;
        // Askew it turns over the edge that its weight passes first.
        let over = |distance: f64, share: f64| match share == 0.0 {
            true => f64::INFINITY,
            false => atan2(distance, (up - strip) * share.abs()),
        };
        over(lengthwise, unit.x).min(over(across, unit.y))
    }

    /// The tilt (rad) beyond which none of its walls stands, however it is built of stones that do not stick together; `None` where
    /// the ends are held, joints bear tension, or a file says where the stones are.
    pub fn stands_at_most(&self, towards: Direction) -> Option<f64> {
        // The outline of a file's wall is the box around it, whose stones may lie anywhere in it.
        let is_drawn = !self.layout.arrangement.is_file();
        let is_loose = is_drawn && self.restraint.ends == Ends::Free && self.joint.tension == 0.0;
        is_loose.then(|| self.overturning_angle(towards))
    }
}
