//! Angles in degrees that look as if they were not: radians, or a coefficient of friction.

use std::f64::consts::PI;

use crate::math::{atan, degrees, significant};

/// What an angle is of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Angle {
    /// The friction of joints.
    Friction,
    /// The dip of bed joints.
    Dip,
    /// A tilt at which something ends or falls.
    Tilt,
    /// A horizontal direction.
    Direction,
}

/// A friction angle (deg) below it is hardly any: no dry stone has it, and every such angle in radians and every coefficient of friction
/// of stones lies below.
const LEAST_FRICTION_DEG: f64 = 2.0;
/// Dips (deg) below it are level beds; 45 deg, the most that is taken, are 0.785 rad.
const LEAST_DIP_DEG: f64 = 0.8;
/// No wall of stones falls at a tilt (deg) so small; 90 deg are 1.571 rad.
const LEAST_TILT_DEG: f64 = 1.6;
/// A direction this near to a multiple of 45 deg in radians is one (rad).
const SAME_DIRECTION: f64 = 0.006;

impl Angle {
    /// What looks wrong with an angle (deg), as a question; `None` where nothing does. An angle of 0 is meant so.
    ///
    /// ```
    /// use pirca::study::Angle;
    /// let words = Angle::Friction.doubt(0.6).unwrap();
    /// assert_eq!(words, "0.6 deg is hardly any friction: is it in radians (34.4 deg), or a coefficient of friction (31.0 deg)?");
    /// assert_eq!(Angle::Friction.doubt(30.0), None);
    /// ```
    pub fn doubt(self, x: f64) -> Option<String> {
        // Without the rounding of a conversion to radians and back.
        let x = (1e9 * x).round() / 1e9;
        let in_degrees = significant(degrees(x), 3);
        let below = |least: f64| x != 0.0 && x.abs() < least;
        match self {
            Angle::Friction => below(LEAST_FRICTION_DEG).then(|| {
                // Radians end at a right angle.
                let radians = match x < 0.5 * PI {
                    true => format!("is it in radians ({in_degrees} deg), or a coefficient"),
                    false => "is it a coefficient".to_owned(),
                };
                let friction = significant(degrees(atan(x)), 3);
                format!("{x} deg is hardly any friction: {radians} of friction ({friction} deg)?")
            }),
            Angle::Dip => below(LEAST_DIP_DEG)
                .then(|| format!("{x} deg is level: is it in radians ({in_degrees} deg)?")),
            Angle::Tilt => below(LEAST_TILT_DEG)
                .then(|| format!("{x} deg is hardly a tilt: is it in radians ({in_degrees} deg)?")),
            Angle::Direction => {
                let eighths = (x.abs() / (0.25 * PI)).round();
                let is_one =
                    (1.0..=8.0).contains(&eighths) && (x.abs() - 0.25 * PI * eighths).abs() < SAME_DIRECTION;
                // Whole numbers of degrees are meant so.
                (is_one && x.fract() != 0.0).then(|| format!("{x} deg: is it in radians ({in_degrees} deg)?"))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{FRAC_PI_2, PI};

    use super::*;

    #[test]
    fn angles_that_look_like_radians_are_asked_about_and_others_are_not() {
        let asked = |angle: Angle, x: f64| angle.doubt(x).is_some();
        for x in [0.6, 0.35, 1.2, 1.9] {
            assert!(asked(Angle::Friction, x), "{x}");
        }
        assert!(!Angle::Friction.doubt(1.9).unwrap().contains("radians"));
        for x in [0.0, 2.0, 20.0, 60.0] {
            assert!(!asked(Angle::Friction, x), "{x}");
        }
        assert!(asked(Angle::Dip, 0.35) && asked(Angle::Dip, -0.35) && !asked(Angle::Dip, 3.0));
        assert!(asked(Angle::Tilt, 0.52) && !asked(Angle::Tilt, 5.0));
        for x in [FRAC_PI_2, 1.57, PI, 0.785, -1.571, 4.712] {
            assert!(asked(Angle::Direction, x), "{x}");
        }
        for x in [0.0, 1.0, 1.5, 30.0, 90.0, 2.0, 45.0] {
            assert!(!asked(Angle::Direction, x), "{x}");
        }
    }
}
