//! Coulomb's wedge: what dry soil that gives way presses with on the back of a wall.
//!
//! A wedge of soil slides down a plane through the foot of the back and takes friction along with it on both sides: the full one of the soil on the
//! plane, that of the wall on its back. Of all planes the one counts that makes it press most. For a plane surface that plane is known in closed
//! form (Coulomb 1776; Müller-Breslau 1906):
//!
//! ```text
//!                          cos^2(phi - lean)
//! Ka = ---------------------------------------------------------------
//!      cos^2(lean) cos(lean + delta) (1 + sqrt(S))^2
//!
//! S = sin(phi + delta) sin(phi - slope) / (cos(lean + delta) cos(lean - slope))
//! ```
//!
//! The thrust on a back of height `h` is `Ka gamma h^2 / 2`, and it grows with the depth in proportion, so that it acts at a third of the height.

use crate::math::{cos, sin};

/// Soil behind the back of a wall; angles in rad.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wedge {
    /// Friction angle of the soil.
    pub phi: f64,
    /// Angle of friction that the soil mobilises on the back of the wall, going down past it.
    pub delta: f64,
    /// Lean of the back against the vertical: above 0 where it goes away from the soil as it rises, so that soil lies on it.
    pub lean: f64,
    /// Slope of the surface of the soil: above 0 where it rises away from the wall.
    pub slope: f64,
}

impl Wedge {
    /// `Ka`, the thrust over `gamma h^2 / 2`; `None` where there is no such wedge: the surface is steeper than the soil's friction holds, or the
    /// back leans so far that the thrust would point upwards or along it.
    pub fn coefficient(&self) -> Option<f64> {
        let Wedge { phi, delta, lean, slope } = *self;
        let (inclined, surface) = (cos(lean + delta), cos(lean - slope));
        let is_wedge = slope <= phi && cos(lean) > 0.0 && inclined > 0.0 && surface > 0.0;
        if !is_wedge {
            return None;
        }
        let root = 1.0 + (sin(phi + delta) * sin(phi - slope) / (inclined * surface)).max(0.0).sqrt();
        let above = cos(phi - lean);
        Some(above * above / (cos(lean) * cos(lean) * inclined * root * root))
    }

    /// The angle (rad) by which the thrust points below the horizontal: its friction takes the wall down.
    pub fn inclination(&self) -> f64 {
        self.lean + self.delta
    }

    /// The weight of a surcharge (Pa, per horizontal area) as it presses like soil: on a height `h` the thrust grows by `Ka h` times this. It is the weight
    /// that the wedge carries, over twice the wedge's own per depth and unit weight.
    pub fn surcharge(&self, pressure: f64) -> f64 {
        pressure * cos(self.lean) * cos(self.slope) / cos(self.lean - self.slope)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::{atan, radians, tan};

    fn wedge([phi, delta, lean, slope]: [f64; 4]) -> Wedge {
        Wedge { phi: radians(phi), delta: radians(delta), lean: radians(lean), slope: radians(slope) }
    }

    /// Thrust of a wedge of unit weight behind a back of height 1, with `q` on its surface, over a plane at `angle` (rad) from the horizontal: weight and the forces on
    /// both sides, each at its friction angle, in balance.
    fn thrust(of: &Wedge, angle: f64, q: f64) -> f64 {
        let Wedge { phi, delta, lean, slope } = *of;
        // The back's top lies at -tan(lean); the plane meets the surface that rises behind it.
        let (x0, t) = (-tan(lean), tan(slope));
        let x = (1.0 - x0 * t) / (tan(angle) - t);
        // Twice the area of the triangle foot, top of the back, where the plane meets the surface.
        let area = 0.5 * (x - x0 * x * tan(angle));
        let weight = area + q * (x - x0);
        weight * sin(angle - phi) / cos(angle - phi - delta - lean)
    }

    #[test]
    fn the_coefficients_are_those_of_tables() {
        let back = 180.0 / std::f64::consts::PI * atan(0.1);
        let table = [
            ([30.0, 0.0, 0.0, 0.0], 0.33333),
            ([30.0, 20.0, 0.0, 0.0], 0.29731),
            ([35.0, 70.0 / 3.0, 0.0, 0.0], 0.24441),
            ([40.0, 80.0 / 3.0, 0.0, 0.0], 0.19985),
            ([35.0, 70.0 / 3.0, back, 0.0], 0.28724),
            ([35.0, 70.0 / 3.0, 0.0, 15.0], 0.29538),
        ];
        for (of, known) in table {
            let found = wedge(of).coefficient().unwrap();
            // Five digits are known.
            assert!((found - known).abs() < 6e-6, "{of:?}: {found} instead of {known}");
        }
    }

    /// The closed form is the largest thrust over all planes, with a surcharge as well.
    #[test]
    fn no_plane_presses_more_and_one_presses_as_much() {
        for of in
            [[30.0, 0.0, 0.0, 0.0], [35.0, 20.0, 8.0, 0.0], [35.0, 20.0, -6.0, 12.0], [40.0, 40.0, 3.0, 20.0]]
        {
            let own = wedge(of);
            for q in [0.0, 0.3] {
                let planes = (1..9000)
                    .map(|k| radians(0.01 * f64::from(k)))
                    .filter(|angle| *angle > own.phi.max(own.slope));
                // What would slide into the wall's back does not slide.
                let planes = planes.filter(|angle| angle + own.lean < std::f64::consts::FRAC_PI_2);
                let most = planes.map(|angle| thrust(&own, angle, q)).fold(0.0, f64::max);
                let known = own.coefficient().unwrap() * (0.5 + own.surcharge(q));
                // Planes are tried every hundredth of a degree, and a maximum is flat.
                assert!((most - known).abs() < 1e-6, "{of:?}, {q}: {most} instead of {known}");
            }
        }
    }

    #[test]
    fn a_surface_steeper_than_its_friction_has_no_wedge() {
        assert_eq!(wedge([30.0, 0.0, 0.0, 30.5]).coefficient(), None);
        assert_eq!(wedge([30.0, 30.0, 61.0, 0.0]).coefficient(), None);
        assert!(wedge([30.0, 0.0, 0.0, 30.0]).coefficient().is_some_and(|own| (own - 0.75).abs() < 1e-12));
    }
}
