//! Elastic response spectra of the ground, as codes write them down or as a table.

use std::f64::consts::PI;
use std::iter::once;

use crate::math::STANDARD_GRAVITY;
use crate::motion::Accelerogram;

/// Periods of a record's spectrum, and the longest of them (s).
const PERIODS: u32 = 200;
const LONGEST: f64 = 4.0;

/// The periods (s) at which the branches of a spectrum meet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Corners {
    /// Where the plateau begins.
    pub b: f64,
    /// Where it ends.
    pub c: f64,
    /// Where the displacement stops growing.
    pub d: f64,
}

/// An elastic spectrum of the horizontal acceleration of the ground, at 5 % of critical damping.
#[derive(Clone, Debug, PartialEq)]
pub enum Spectrum {
    /// NTC 2018, 3.2.3.2.1.
    Ntc {
        /// Peak acceleration of rigid ground, in g.
        ag: f64,
        /// Factor of soil and topography `S`.
        soil: f64,
        /// Amplification `F0` of the plateau on rigid ground.
        f0: f64,
        /// Where its branches meet.
        corners: Corners,
    },
    /// EN 1998-1:2004, 3.2.2.2, whose plateau is 2.5 times the ground's acceleration.
    En {
        /// Peak acceleration of rigid ground, in g.
        ag: f64,
        /// Soil factor `S`.
        soil: f64,
        /// Where its branches meet.
        corners: Corners,
    },
    /// Periods (s), rising, with spectral accelerations in g; straight in between.
    Table(Vec<[f64; 2]>),
}

/// The factor on a spectrum of 5 % damping for another one (%): `sqrt(10 / (5 + xi))`, at least 0.55 (NTC 2018, 3.2.4; EN 1998-1, 3.6).
pub fn damping_factor(damping_percent: f64) -> f64 {
    (10.0 / (5.0 + damping_percent)).sqrt().max(0.55)
}

impl Spectrum {
    /// The spectrum of a record (m/s^2).
    pub fn of_record(record: &Accelerogram) -> Spectrum {
        let peak = record.samples().iter().fold(0.0, |most: f64, a| most.max(a.abs()));
        let periods = (1..=PERIODS).map(|k| LONGEST * f64::from(k) / f64::from(PERIODS));
        let point = |period: f64| {
            let w = 2.0 * PI / period;
            [period, w * w * record.response(period, 0.05) / STANDARD_GRAVITY]
        };
        Spectrum::Table(once([0.0, peak / STANDARD_GRAVITY]).chain(periods.map(point)).collect())
    }

    /// Peak acceleration of the ground (m/s^2), soil included.
    pub fn ground(&self) -> f64 {
        STANDARD_GRAVITY
            * match self {
                Spectrum::Ntc { ag, soil, .. } | Spectrum::En { ag, soil, .. } => ag * soil,
                Spectrum::Table(points) => points.first().map_or(0.0, |first| first[1]),
            }
    }

    /// Acceleration (m/s^2) at a period (s) and a damping (%).
    pub fn acceleration(&self, period: f64, damping_percent: f64) -> f64 {
        let eta = damping_factor(damping_percent);
        match self {
            Spectrum::Ntc { f0, corners, .. } => self.ground() * of_code(*f0, *corners, period, eta),
            Spectrum::En { corners, .. } => self.ground() * of_code(2.5, *corners, period, eta),
            Spectrum::Table(points) => {
                // At no period at all damping does not matter.
                let eta = if period > 0.0 { eta } else { 1.0 };
                STANDARD_GRAVITY * eta * between(points, period)
            }
        }
    }

    /// The largest displacement (m) at periods from `from` to `to` (s): a spectrum that dips, as those of single records do, does not spare
    /// an oscillator whose period grows to there (C8.7.1.2.1.8).
    pub fn displacement(&self, [from, to]: [f64; 2], damping_percent: f64) -> f64 {
        let at = |period: f64| displaced(self.acceleration(period, damping_percent), period);
        let between = match self {
            Spectrum::Ntc { .. } | Spectrum::En { .. } => 0.0,
            Spectrum::Table(points) => {
                let within =
                    points.iter().map(|point| point[0]).filter(|period| (from..=to).contains(period));
                within.map(at).fold(0.0, f64::max)
            }
        };
        at(to).max(between)
    }

    /// The longest period (s) that it speaks of; none for those of codes.
    pub fn longest(&self) -> Option<f64> {
        match self {
            Spectrum::Ntc { .. } | Spectrum::En { .. } => None,
            Spectrum::Table(points) => points.last().map(|last| last[0]),
        }
    }
}

/// The displacement (m) of an acceleration (m/s^2) at a period (s).
pub(super) fn displaced(acceleration: f64, period: f64) -> f64 {
    acceleration * period * period / (4.0 * PI * PI)
}

/// Over the ground's acceleration.
fn of_code(plateau: f64, corners: Corners, period: f64, eta: f64) -> f64 {
    let Corners { b, c, d } = corners;
    let top = eta * plateau;
    if period < b {
        period / b * top + (1.0 - period / b)
    } else if period < c {
        top
    } else if period < d {
        top * c / period
    } else {
        top * c * d / (period * period)
    }
}

/// Straight between the points of a table; beyond its end the displacement stays, before its beginning the acceleration.
fn between(points: &[[f64; 2]], period: f64) -> f64 {
    let (Some(first), Some(last)) = (points.first(), points.last()) else { return 0.0 };
    if period <= first[0] {
        return first[1];
    }
    if period >= last[0] {
        return last[1] * last[0] * last[0] / (period * period);
    }
    let pair = points.windows(2).find(|pair| period <= pair[1][0]);
    pair.map_or(last[1], |pair| {
        let share = (period - pair[0][0]) / (pair[1][0] - pair[0][0]);
        pair[0][1] + share * (pair[1][1] - pair[0][1])
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const CORNERS: Corners = Corners { b: 0.15, c: 0.45, d: 2.2 };

    fn ntc() -> Spectrum {
        Spectrum::Ntc { ag: 0.15, soil: 1.2, f0: 2.4, corners: CORNERS }
    }

    /// The branches by hand: 0.18 g on the ground, 2.4 times that on the plateau, then with 1/T and 1/T^2.
    #[test]
    fn the_branches_of_the_code_meet_at_its_corners() {
        let at = |period: f64| ntc().acceleration(period, 5.0) / STANDARD_GRAVITY;
        for (period, wanted) in
            [(0.0, 0.18), (0.15, 0.432), (0.3, 0.432), (0.9, 0.216), (4.4, 0.432 * 0.45 * 2.2 / 19.36)]
        {
            assert!((at(period) - wanted).abs() < 1e-12, "{period}: {} {wanted}", at(period));
        }
        assert!((ntc().ground() - 0.18 * STANDARD_GRAVITY).abs() < 1e-12);
    }

    /// In EN 1998-1 the rise begins with `1 + T/TB (2.5 eta - 1)`.
    #[test]
    fn eurocode_rises_to_two_and_a_half_times_the_ground() {
        let spectrum = Spectrum::En { ag: 0.2, soil: 1.0, corners: CORNERS };
        let at = |period: f64| spectrum.acceleration(period, 10.0) / STANDARD_GRAVITY;
        let eta = (10.0f64 / 15.0).sqrt();
        assert!((at(0.075) - 0.2 * (1.0 + 0.5 * (2.5 * eta - 1.0))).abs() < 1e-12);
        assert!((at(0.2) - 0.2 * 2.5 * eta).abs() < 1e-12);
    }

    #[test]
    fn damping_lowers_a_spectrum_to_half_at_most() {
        assert!((damping_factor(5.0) - 1.0).abs() < 1e-15);
        assert!((damping_factor(8.0) - (10.0f64 / 13.0).sqrt()).abs() < 1e-15);
        assert!((damping_factor(80.0) - 0.55).abs() < 1e-15);
    }

    /// One sine of 0.5 s: the largest response lies near its own period, and the ground's own acceleration comes first.
    #[test]
    fn a_record_has_its_spectrum() {
        let record: Vec<f64> = (0..=100).map(|k| crate::math::sin(2.0 * PI * f64::from(k) / 100.0)).collect();
        let spectrum = Spectrum::of_record(&Accelerogram::new(0.005, record).expect("a record"));
        assert!((spectrum.ground() - 1.0).abs() < 1e-6);
        let at = |period: f64| spectrum.acceleration(period, 5.0);
        assert!(
            at(0.5) > 2.0 && at(0.5) > at(0.1) && at(0.5) > at(2.0),
            "{} {} {}",
            at(0.1),
            at(0.5),
            at(2.0)
        );
    }

    /// A dip of a table is passed over; beyond its end the displacement stays.
    #[test]
    fn a_table_that_dips_spares_no_oscillator() {
        let table = Spectrum::Table(vec![[0.0, 0.2], [0.5, 0.6], [1.0, 0.05]]);
        let at_peak = 0.6 * STANDARD_GRAVITY * 0.25 / (4.0 * PI * PI);
        assert!((table.displacement([0.1, 1.0], 5.0) - at_peak).abs() < 1e-15);
        let end = table.displacement([1.0, 1.0], 5.0);
        assert!((table.displacement([2.0, 2.0], 5.0) - end).abs() < 1e-15);
        assert!((table.acceleration(0.25, 5.0) - 0.4 * STANDARD_GRAVITY).abs() < 1e-12);
    }
}
