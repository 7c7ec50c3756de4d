//! The numbers among the arguments, each within its range.

use std::ops::RangeInclusive;

use crate::protocol::Direction;
use crate::solve::explicit::Rayleigh;
use crate::study::Tolerance;

/// Friction angles (deg): at 90 degrees friction would be infinite.
pub(crate) const FRICTION_ANGLES: RangeInclusive<f64> = 0.0..=89.0;
/// Stiffnesses per joint area (Pa/m).
pub(crate) const STIFFNESSES: RangeInclusive<f64> = 1e3..=1e16;
/// Densities (kg/m^3).
pub(crate) const DENSITIES: RangeInclusive<f64> = 10.0..=23_000.0;

/// Friction angle (deg).
pub(crate) fn friction_angle(text: &str) -> Result<f64, String> {
    within(text, FRICTION_ANGLES, "degrees")
}

/// Stiffness per joint area (Pa/m).
pub(crate) fn stiffness(text: &str) -> Result<f64, String> {
    within(text, STIFFNESSES, "Pa/m")
}

/// Cohesion (Pa).
pub(crate) fn cohesion(text: &str) -> Result<f64, String> {
    within(text, 0.0..=1e9, "Pa")
}

/// Step of the tilt (deg).
pub(crate) fn step(text: &str) -> Result<f64, String> {
    within(text, 0.01..=45.0, "degrees")
}

/// A tilt (deg).
pub(crate) fn tilt(text: &str) -> Result<f64, String> {
    within(text, 0.0..=89.0, "degrees")
}

/// Vertical share of the load, over its horizontal one.
pub(crate) fn vertical(text: &str) -> Result<f64, String> {
    within(text, -2.0..=2.0, "of the horizontal load")
}

/// Factor on a record.
pub(crate) fn scale(text: &str) -> Result<f64, String> {
    within(text, 1e-3..=1e3, "times the record")
}

/// Restitution of joints.
pub(crate) fn restitution(text: &str) -> Result<f64, String> {
    within(text, 0.0..=1.0, "of the closing speed")
}

/// Lean of the ground (deg).
pub(crate) fn lean(text: &str) -> Result<f64, String> {
    within(text, 0.0..=45.0, "degrees")
}

/// Time step (s).
pub(crate) fn time_step(text: &str) -> Result<f64, String> {
    within(text, 1e-6..=0.02, "s")
}

/// Rayleigh damping, as `0.05,1,10`: share of critical and two frequencies (Hz).
pub(crate) fn rayleigh(text: &str) -> Result<Rayleigh, String> {
    let form = "allowed is RATIO,HZ,HZ, as 0.05,1,10";
    let parts: Vec<&str> = text.split(',').map(str::trim).collect();
    let [ratio, low, high] = parts[..] else { return Err(form.to_owned()) };
    let ratio = within(ratio, 0.0..=0.5, "of critical")?;
    let (low, high) = (within(low, 0.01..=1e4, "Hz")?, within(high, 0.01..=1e4, "Hz")?);
    if low >= high {
        return Err(format!("the first frequency, {low} Hz, is not below the second, {high} Hz; {form}"));
    }
    Ok(Rayleigh::of(ratio, [low, high]))
}

/// A weight (N) on a block, as `12=1500`.
pub(crate) fn dead_load(text: &str) -> Result<(u64, f64), String> {
    of_a_block(text, "ID=N, as 12=1500", 0.0..=1e9, "N downwards")
}

/// How far (m) a block goes down, as `3=0.01`.
pub(crate) fn settlement(text: &str) -> Result<(u64, f64), String> {
    of_a_block(text, "ID=M, as 3=0.01", 0.0..=0.5, "m downwards")
}

/// The id of a block and a number.
fn of_a_block(text: &str, form: &str, range: RangeInclusive<f64>, unit: &str) -> Result<(u64, f64), String> {
    let (id, number) = text.split_once('=').ok_or_else(|| format!("allowed is {form}"))?;
    let id = id.trim().parse().map_err(|_| format!("\"{id}\" is no id of a block; allowed is {form}"))?;
    Ok((id, within(number.trim(), range, unit)?))
}

/// Density of a fill (kg/m^3).
pub(crate) fn fill_density(text: &str) -> Result<f64, String> {
    within(text, 100.0..=5000.0, "kg/m^3")
}

/// Friction angle of a fill (deg).
pub(crate) fn fill_friction(text: &str) -> Result<f64, String> {
    within(text, 1.0..=60.0, "degrees")
}

/// Share of that angle on the back of a wall.
pub(crate) fn wall_friction(text: &str) -> Result<f64, String> {
    within(text, 0.0..=1.0, "of the friction angle of the fill")
}

/// Slope of the surface of a fill (deg).
pub(crate) fn fill_slope(text: &str) -> Result<f64, String> {
    within(text, -45.0..=60.0, "degrees")
}

/// Weight on the surface of a fill (Pa).
pub(crate) fn surcharge(text: &str) -> Result<f64, String> {
    within(text, 0.0..=1e6, "Pa")
}

/// Mean pressure on a back (Pa).
pub(crate) fn pressure(text: &str) -> Result<f64, String> {
    within(text, 1e-3..=1e7, "Pa")
}

/// Pressure at the base over that at the top.
pub(crate) fn base_over_top(text: &str) -> Result<f64, String> {
    within(text, 0.01..=100.0, "of the pressure at the top")
}

/// Force on a crest (N, or N/m).
pub(crate) fn force(text: &str) -> Result<f64, String> {
    within(text, 1e-3..=1e9, "N, or N/m along the crest")
}

/// By how much a force points below the horizontal (deg).
pub(crate) fn below_horizontal(text: &str) -> Result<f64, String> {
    within(text, -90.0..=90.0, "degrees")
}

/// Density (kg/m^3).
pub(crate) fn density(text: &str) -> Result<f64, String> {
    within(text, DENSITIES, "kg/m^3")
}

/// A length with its unit, or a share of the wall's size.
pub(crate) fn tolerance(text: &str) -> Result<Tolerance, String> {
    if text.trim_end().ends_with('m') {
        return length(text).map(Tolerance::Length);
    }
    within(text, 1e-12..=1e-3, "of the wall's size")
        .map(Tolerance::Share)
        .map_err(|error| format!("{error}, or a length with its unit, as 2mm"))
}

/// Longest wall (m) whose size is asked for.
const LARGEST_WALL: f64 = 1000.0;

/// A length (m) of a detail from a number with its unit.
pub(crate) fn length(text: &str) -> Result<f64, String> {
    up_to(text, 1.0)
        .ok_or_else(|| "allowed is a length with its unit above 0, up to 1 m: 2mm, 0.5cm, 0.002 m".to_owned())
}

/// The thickness or the length (m) of a wall from a number with its unit.
pub(crate) fn size(text: &str) -> Result<f64, String> {
    let most = LARGEST_WALL;
    up_to(text, most)
        .ok_or_else(|| format!("allowed is a length with its unit above 0, up to {most} m: 45cm, 3.2m"))
}

/// A length (m) above 0, up to `most`.
fn up_to(text: &str, most: f64) -> Option<f64> {
    let units = [("mm", 1000.0), ("cm", 100.0), ("m", 1.0)];
    let (number, per_metre) =
        units.into_iter().find_map(|(unit, per_metre)| Some((text.trim().strip_suffix(unit)?, per_metre)))?;
    let metres = number.trim().parse::<f64>().ok()? / per_metre;
    (metres > 0.0 && metres <= most).then_some(metres)
}

/// Horizontal direction: the name of an axis, or an angle (deg).
pub(crate) fn direction(text: &str) -> Result<Direction, String> {
    let named = Direction::named(text).map(Ok);
    named
        .unwrap_or_else(|| within(text, -360.0..=360.0, "degrees").map(Direction::at))
        .map_err(|why| format!("{why}, counter-clockwise from x+ seen from above; or x+, x-, y+, y-"))
}

fn within(text: &str, range: RangeInclusive<f64>, unit: &str) -> Result<f64, String> {
    let told =
        |x: f64| if x == 0.0 || (1e-3..1e6).contains(&x.abs()) { x.to_string() } else { format!("{x:e}") };
    let allowed = format!("{} to {} {unit}", told(*range.start()), told(*range.end()));
    match text.parse::<f64>() {
        Ok(x) if range.contains(&x) => Ok(x),
        Ok(_) => Err(format!("allowed is a number from {allowed}")),
        Err(_) => Err(format!("no number; allowed is a number from {allowed}")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_outside_their_range_and_no_numbers_are_refused_with_what_is_allowed() {
        assert_eq!(friction_angle("30"), Ok(30.0));
        for text in ["-5", "90", "nan", "inf", "1e999", "", "thirty"] {
            assert!(friction_angle(text).unwrap_err().contains("0 to 89 degrees"), "{text}");
        }
        assert_eq!(stiffness("1e9"), Ok(1e9));
        assert!(stiffness("0").unwrap_err().contains("1000 to 1e16 Pa/m"));
        assert_eq!(direction("y-"), Ok(Direction::YMinus));
        assert_eq!(direction("90"), Ok(Direction::YPlus));
        for text in ["z+", "361", "nan", ""] {
            assert!(direction(text).unwrap_err().contains("-360 to 360 degrees"), "{text}");
        }
        assert!(tolerance("0.1").unwrap_err().contains("1e-12 to 0.001"));
    }

    #[test]
    fn a_tolerance_is_a_length_with_its_unit_or_a_share() {
        for text in ["2mm", "0.2cm", "0.002 m", "2e-3m", " 2 mm "] {
            assert_eq!(tolerance(text), Ok(Tolerance::Length(0.002)), "{text}");
        }
        assert_eq!(tolerance("1e-6"), Ok(Tolerance::Share(1e-6)));
        for text in ["0mm", "-2mm", "2 km", "mm", "nanm", "infm", "1e9mm", "2in", "2"] {
            assert!(tolerance(text).unwrap_err().contains("2mm"), "{text}");
        }
        assert!(length("2").unwrap_err().contains("with its unit"));
    }
}
