//! What a bound owes to the friction of upright joints.
//!
//! Statics lets a joint press as hard as it helps, and its friction bears in proportion. In a bed the weight above makes that pressure. In an
//! upright joint nothing need make it: of stones that were laid one beside the other without force, its friction bears what thrust brings
//! about, and statics does not say how much that is. So the load is asked once more of a wall whose upright joints are smooth: they press
//! and do not rub. What it bears too, no such friction is needed for.

use crate::math::Vec3;
use crate::solve::limit::analysis::Analysis;
use crate::solve::limit::strength::Strength;
use crate::solve::limit::{Flow, Loads, Settings};

/// A joint stands upright whose normal is nearer to the horizontal than to the weight: the cosine of 45 degrees.
const UPRIGHT: f64 = std::f64::consts::FRAC_1_SQRT_2;

impl Analysis {
    /// The same wall without friction and cohesion in upright joints, those whose normals are within 45 degrees of the horizontal; with
    /// associative flow. What is bonded stays so.
    pub fn with_smooth_sides(&self) -> Analysis {
        let of = |(upright, own): (bool, &Strength)| match upright && !own.bonded {
            true => Strength { friction: 0.0, cohesion: 0.0, ..*own },
            false => *own,
        };
        let strengths = self.upright_points().zip(&self.strengths).map(of).collect();
        let settings = Settings { flow: Flow::Associative, ..self.settings };
        Analysis { strengths, settings, ..self.clone() }
    }

    /// The sum of the normal forces (N) in upright joints, of a state under the dead loads with little pressure: of what the load
    /// needs there, not of all that statics would allow. `None` where there is no such state.
    pub fn side_thrust(&self, loads: &Loads) -> Option<f64> {
        let applied = self.applied(loads);
        let pressure = self.cost_of_pressure(&self.at_rest(&applied));
        let answer = self.least_pressure(&applied, &self.strengths, pressure);
        let thrust = || self.upright_points().zip(&answer.solved.forces).filter(|(upright, _)| *upright);
        answer.accuracy.accepts_state().then(|| thrust().map(|(_, force)| force[0].max(0.0)).sum())
    }

    fn upright_points(&self) -> impl Iterator<Item = bool> {
        self.blocks.points().map(|(joint, _)| is_upright(&joint.normal))
    }
}

/// Whether a joint with this normal stands upright.
pub(crate) fn is_upright(normal: &Vec3) -> bool {
    normal.z.abs() < UPRIGHT
}
