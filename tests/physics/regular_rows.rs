//! Joints of equal balls in square rows, sheared along their rows: what roughness does, in closed form.
//!
//! Two beds of rigid balls of radius r, centres at the distance s in both directions, one bed upright on the other, load along
//! the normal of the joint. Sheared along x, a ball of the upper bed runs over the balls of the lower one. Its centre goes along
//! arcs of the radius R about the lower row: R = 2 r where rows of both beds run above one another, and
//! `R^2 = 4 r^2 - s^2 / 4` where an upper row runs between two lower ones. With the horizontal distance u to the crest ahead,
//!
//! ```text
//! sin(theta) = u / R       tan(phi') = tan(phi) 2 r / R       T / N = tan(phi' + theta)       dz / dx = tan(theta)
//! ```
//!
//! theta is the slope of the arc: `theta_max = asin(s / (2 R))` in the hollow, 0 on the crest, and as much below 0 on the way down.
//! phi' is phi where contacts lie on the arc's own plane; between two rows each contact is inclined to that plane, so that a
//! load N presses with `N 2 r / R` on the contacts together, and friction grows as much (a wedge, as in a V-groove).
//!
//! Own derivation. In a plane model of one row it is the saw-tooth of Patton (1966) with a tooth that is round; balls that touch
//! (s = 2 r) have theta_max = 30 degrees whatever their size, which sets only how far the joint rises.

use pirca::math::{asin, asinh, atan, cos, sin, tan};

/// A joint of two equal beds of balls in square rows, sheared along their rows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RegularRows {
    /// Radius r of the balls (m).
    pub radius: f64,
    /// Distance s of neighbouring centres (m), below 2 r sqrt(2) where rows run between rows, and below 4 r otherwise: farther
    /// apart, balls fall through.
    pub spacing: f64,
    /// Whether the rows of a bed run between those of the other one; else above them, as in a plane model of one row.
    pub between: bool,
    /// Friction angle phi of the balls (rad).
    pub phi: f64,
}

impl RegularRows {
    /// Radius R (m) of the arc along which a ball's centre goes over a crest.
    pub fn arc(&self) -> f64 {
        let square = 4.0 * self.radius * self.radius;
        if self.between { (square - 0.25 * self.spacing * self.spacing).sqrt() } else { 2.0 * self.radius }
    }

    /// Steepest slope theta_max (rad), at which a ball leaves a hollow: the largest dilatancy angle.
    pub fn steepest(&self) -> f64 {
        asin(0.5 * self.spacing / self.arc())
    }

    /// Slope theta (rad) at a way (m) behind a crest, the same after every spacing; upwards before a crest, and in the hollow
    /// itself, which the ball is about to leave.
    pub fn slope(&self, way: f64) -> f64 {
        let s = self.spacing;
        asin((s * (way / s + 0.5).floor() - way) / self.arc())
    }

    /// Friction angle phi' (rad) on a level path.
    pub fn level_friction(&self) -> f64 {
        atan(tan(self.phi) * 2.0 * self.radius / self.arc())
    }

    /// Shear over normal force while the joint slips, at a way (m) from a crest: `tan(phi' + theta)`. Infinite where the sum
    /// reaches a right angle: there the beds lock, and break or lift before they slip.
    pub fn ratio(&self, way: f64) -> f64 {
        at(self.level_friction() + self.slope(way))
    }

    /// The largest ratio, out of the hollow.
    pub fn peak(&self) -> f64 {
        at(self.level_friction() + self.steepest())
    }

    /// The mean ratio over a spacing, the work of shear over that of the same load on a plane:
    ///
    /// ```text
    /// sin(phi') / (2 sin(theta_max)) (asinh tan(phi' + theta_max) - asinh tan(phi' - theta_max))
    /// ```
    ///
    /// It is above tan(phi'), for a load that is pushed uphill presses harder than one that is let down.
    pub fn mean(&self) -> f64 {
        let (phi, theta) = (self.level_friction(), self.steepest());
        sin(phi) / (2.0 * sin(theta)) * (asinh(at(phi + theta)) - asinh(at(phi - theta)))
    }

    /// How far the joint opens from the hollow to the crest (m).
    pub fn rise(&self) -> f64 {
        self.arc() * (1.0 - cos(self.steepest()))
    }

    /// Height (m) of the upper bed's centres over the lower one's at a way (m) behind a crest.
    pub fn height(&self, way: f64) -> f64 {
        self.arc() * cos(self.slope(way))
    }

    /// Normal stiffness of the joint in the hollow or on the crest, over that of as many balls that stand ball on ball:
    /// `m (c^2 + (ks / kn) (1 - c^2))`, with m contacts of a ball and the cosine c of their angle to the normal.
    ///
    /// As long as the contacts stick: `(ks / kn) tan(angle) <= tan(phi)`.
    pub fn stiffening(&self, in_hollow: bool, ks_over_kn: f64) -> f64 {
        let contacts = (if self.between { 2.0 } else { 1.0 }) * (if in_hollow { 2.0 } else { 1.0 });
        let way = if in_hollow { 0.5 * self.spacing } else { 0.0 };
        let c = self.height(way) / (2.0 * self.radius);
        contacts * (c * c + ks_over_kn * (1.0 - c * c))
    }
}

/// The tangent of an angle below a right one; infinite from there on.
fn at(angle: f64) -> f64 {
    if angle < std::f64::consts::FRAC_PI_2 { tan(angle) } else { f64::INFINITY }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;
    use pirca::math::{degrees, radians};

    fn touching(between: bool, phi_deg: f64) -> RegularRows {
        RegularRows { radius: 0.01, spacing: 0.02, between, phi: radians(phi_deg) }
    }

    #[test]
    fn touching_balls_climb_at_thirty_degrees_row_on_row() {
        let rows = touching(false, 25.0);
        assert_relative_eq!(degrees(rows.steepest()), 30.0, max_relative = 1e-14);
        assert_relative_eq!(degrees(atan(rows.peak())), 55.0, max_relative = 1e-14);
        assert_relative_eq!(rows.rise(), 0.02 * (1.0 - 0.75_f64.sqrt()), max_relative = 1e-13);
        // Just past the hollow, before the crest, on it, and as far behind it.
        assert_relative_eq!(degrees(atan(rows.ratio(-0.01))), 55.0, max_relative = 1e-13);
        assert_relative_eq!(degrees(atan(rows.ratio(0.0))), 25.0, max_relative = 1e-13);
        assert_relative_eq!(degrees(rows.slope(0.005)), -degrees(asin(0.25)), max_relative = 1e-13);
        assert_relative_eq!(rows.ratio(0.024), rows.ratio(0.004), max_relative = 1e-12);
    }

    #[test]
    fn balls_in_pockets_climb_over_the_saddle_of_two() {
        // Three balls and a fourth in their tetrahedron have the slope asin(1 / sqrt 3); R = sqrt(3) r.
        let rows = touching(true, 30.0);
        assert_relative_eq!(rows.arc(), 0.01 * 3.0_f64.sqrt(), max_relative = 1e-14);
        assert_relative_eq!(sin(rows.steepest()), 1.0 / 3.0_f64.sqrt(), max_relative = 1e-14);
        assert_relative_eq!(tan(rows.level_friction()), 2.0 / 3.0, max_relative = 1e-14);
        assert_relative_eq!(rows.height(0.01), 0.01 * 2.0_f64.sqrt(), max_relative = 1e-14);
        // Four contacts at 45 degrees: 4 (1/2 + 1/2 ks/kn).
        assert_relative_eq!(rows.stiffening(true, 0.5), 3.0, max_relative = 1e-14);
        assert_relative_eq!(touching(false, 30.0).stiffening(false, 0.5), 1.0, max_relative = 1e-14);
        assert_relative_eq!(touching(false, 30.0).stiffening(true, 0.5), 1.75, max_relative = 1e-14);
    }

    #[test]
    fn the_mean_is_that_of_the_ratio() {
        for (spacing, between, phi) in
            [(0.02, false, 30.0), (0.012, false, 40.0), (0.02, true, 20.0), (0.015, true, 35.0)]
        {
            let rows = RegularRows { spacing, ..touching(between, phi) };
            let steps = 200_000;
            let way = |k: u32| spacing * ((f64::from(k) + 0.5) / f64::from(steps) - 0.5);
            let sum = (0..steps).map(|k| rows.ratio(way(k))).sum::<f64>() / f64::from(steps);
            // The midpoint rule on a smooth piece.
            assert_relative_eq!(rows.mean(), sum, max_relative = 1e-8);
            assert!(rows.mean() > tan(rows.level_friction()));
        }
    }

    #[test]
    fn beds_lock_at_a_right_angle() {
        assert_eq!(touching(false, 60.0).peak(), f64::INFINITY);
        assert!(touching(false, 59.9).peak().is_finite());
    }
}
