//! What a value is multiplied by where its number was meant in another unit.

use crate::math::ln;
use crate::study::measured::Dimension;

/// Ratios of the units that may be written, the nearest to 1 first, each with its inverse.
pub fn ratios(dimension: Dimension) -> Vec<f64> {
    let si: Vec<f64> = dimension.units().iter().map(|unit| dimension.si(1.0, unit)).collect();
    let pairs = si.iter().flat_map(|meant| si.iter().map(move |written| meant / written));
    let mut ratios: Vec<f64> = pairs.filter(|ratio| (ratio - 1.0).abs() > 1e-9).collect();
    ratios.sort_by(|a, b| ln(*a).abs().total_cmp(&ln(*b).abs()));
    ratios
}

/// Ratios above 1 by which one specimen is off from another, ascending: of units that may be written, and of those that people
/// have beside them. An inch called a centimetre is left out: a softer joint does as much; so is a tenth of a joint's stiffness.
pub fn factors(dimension: Dimension) -> Vec<f64> {
    let foreign: &[f64] = match dimension {
        // Inches called mm.
        Dimension::Length => &[25.4],
        // Kilograms called newtons.
        Dimension::Force => &[9.81],
        Dimension::Angle | Dimension::Stiffness | Dimension::Outcome => &[],
    };
    let least = if dimension == Dimension::Stiffness { 500.0 } else { 5.0 };
    let own = ratios(dimension).into_iter().filter(|ratio| *ratio > least);
    let mut factors: Vec<f64> = own.chain(foreign.iter().copied()).collect();
    factors.sort_by(f64::total_cmp);
    // Of two pairs of units with one ratio; the divisions leave a last bit.
    factors.dedup_by(|a, b| (*a / *b - 1.0).abs() < 1e-9);
    factors
}
