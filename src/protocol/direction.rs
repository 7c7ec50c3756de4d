//! Horizontal directions of the wall's axes: where a platform goes down, where a load pushes.

use std::fmt;

use crate::math::{Vec3, cos, degrees, radians, sin};

/// A horizontal direction of the platform.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Direction {
    /// Along the wall.
    XPlus,
    /// Along the wall, backwards.
    XMinus,
    /// Out of plane, towards the wall's front.
    YPlus,
    /// Out of plane, towards the wall's back.
    YMinus,
    /// At an angle (rad) from x+, counter-clockwise seen from above; see [`Direction::at`].
    At(f64),
}

/// The axes with their names and angles (deg).
const AXES: [(Direction, &str, f64); 4] = [
    (Direction::XPlus, "x+", 0.0),
    (Direction::YPlus, "y+", 90.0),
    (Direction::XMinus, "x-", 180.0),
    (Direction::YMinus, "y-", 270.0),
];

impl Direction {
    /// The direction at an angle (deg) from x+, counter-clockwise seen from above: 90 is y+, -90 or 270 y-. Where the angle is
    /// that of an axis it is the axis itself, without rounding.
    pub fn at(angle_deg: f64) -> Direction {
        // Both are exact, and a tiny angle below 0 may round to the full turn.
        let turn = angle_deg % 360.0;
        let turn = if turn < 0.0 { turn + 360.0 } else { turn };
        let turn = if turn == 360.0 { 0.0 } else { turn };
        let axis = AXES.iter().find(|(.., angle)| *angle == turn);
        axis.map_or(Direction::At(radians(turn)), |(axis, ..)| *axis)
    }

    /// The axis of that name: x+, x-, y+ or y-.
    pub fn named(name: &str) -> Option<Direction> {
        AXES.iter().find(|(_, own, _)| *own == name).map(|(axis, ..)| *axis)
    }

    /// The angle from x+ (deg), counter-clockwise seen from above, from 0 to below 360.
    pub fn angle_deg(&self) -> f64 {
        match self {
            Direction::At(angle) => degrees(*angle),
            axis => AXES.iter().find(|(own, ..)| own == axis).map_or(0.0, |(.., angle)| *angle),
        }
    }

    /// The unit vector.
    pub fn unit(&self) -> Vec3 {
        match self {
            Direction::XPlus => Vec3::x(),
            Direction::XMinus => -Vec3::x(),
            Direction::YPlus => Vec3::y(),
            Direction::YMinus => -Vec3::y(),
            Direction::At(angle) => Vec3::new(cos(*angle), sin(*angle), 0.0),
        }
    }

    /// The axis that it comes nearest to.
    pub fn nearest_axis(&self) -> Direction {
        let unit = self.unit();
        let along = |axis: &Direction| axis.unit().dot(&unit);
        let nearer = |best: Direction, (axis, ..): &(Direction, &str, f64)| {
            if along(axis) > along(&best) { *axis } else { best }
        };
        AXES.iter().fold(Direction::XPlus, nearer)
    }

    /// Whether it has a part towards the wall's back (-y).
    pub fn is_backwards(&self) -> bool {
        self.unit().y < 0.0
    }
}

impl fmt::Display for Direction {
    /// The name of an axis, or the angle: `y+`, `30 deg`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match AXES.iter().find(|(own, ..)| own == self) {
            Some((_, name, _)) => write!(f, "{name}"),
            // To a billionth of a degree: what was typed, without the rounding of radians.
            None => write!(f, "{} deg", (self.angle_deg() * 1e9).round() / 1e9),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_angle_of_an_axis_is_the_axis() {
        for (angle, axis) in [
            (0.0, Direction::XPlus),
            (360.0, Direction::XPlus),
            (-1e-20, Direction::XPlus),
            (90.0, Direction::YPlus),
            (-270.0, Direction::YPlus),
            (180.0, Direction::XMinus),
            (-180.0, Direction::XMinus),
            (270.0, Direction::YMinus),
            (-90.0, Direction::YMinus),
        ] {
            assert_eq!(Direction::at(angle), axis, "{angle}");
            assert_eq!(Direction::named(&axis.to_string()), Some(axis));
            assert_eq!(Direction::at(axis.angle_deg()), axis);
            assert_eq!(axis.nearest_axis(), axis);
            assert_eq!(Direction::at(angle + 30.0).nearest_axis(), axis);
        }
        assert_eq!(Direction::named("z+"), None);
    }

    #[test]
    fn other_angles_turn_counter_clockwise_from_x() {
        let direction = Direction::at(-330.0);
        assert_eq!(direction.to_string(), "30 deg");
        // Rounding of a sine or cosine is a few units in the last place.
        assert!((direction.unit() - Vec3::new(0.75_f64.sqrt(), 0.5, 0.0)).norm() < 1e-15);
        assert!(!direction.is_backwards() && Direction::at(330.0).is_backwards());
        assert!(!Direction::XMinus.is_backwards() && Direction::YMinus.is_backwards());
    }
}
