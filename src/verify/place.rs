//! Where a wall stands: on the ground, or up in a building that shakes in its own way.

use crate::math::pow;
use crate::verify::spectrum::{Spectrum, damping_factor, displaced};

/// Coefficients of C7.2.3: between these shares of a mode's period the floor spectrum is at its height.
const PLATEAU: [f64; 2] = [0.8, 1.1];

/// A mode of the building that carries the wall.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mode {
    /// Its period (s).
    pub period: f64,
    /// Its equivalent viscous damping (%).
    pub damping_percent: f64,
    /// Participation factor times the mode's shape at the height of the wall.
    pub share: f64,
}

/// Where a wall stands.
#[derive(Clone, Debug, PartialEq)]
pub enum Place {
    /// On the ground.
    Ground,
    /// At a height of a building, with the modes that move it there; the first of them comes first.
    Height(Vec<Mode>),
}

impl Place {
    /// The largest acceleration (m/s^2) of the place (C7.2.8).
    pub fn peak(&self, spectrum: &Spectrum) -> f64 {
        match self {
            Place::Ground => spectrum.ground(),
            Place::Height(modes) => {
                let square = |mode: &Mode| mode.peak(spectrum) * mode.peak(spectrum);
                modes.iter().map(square).fold(0.0, |a, x| a + x).sqrt()
            }
        }
    }

    /// Spectral acceleration (m/s^2) of the place at a period (s) and a damping (%) (C7.2.5).
    pub fn acceleration(&self, spectrum: &Spectrum, period: f64, damping_percent: f64) -> f64 {
        let ground = spectrum.acceleration(period, damping_percent);
        match self {
            Place::Ground => ground,
            Place::Height(modes) => {
                let square = |mode: &Mode| {
                    let own = mode.floor(spectrum, period, damping_percent);
                    own * own
                };
                let floor = modes.iter().map(square).fold(0.0, |a, x| a + x).sqrt();
                let is_long = modes.first().is_some_and(|first| period > first.period);
                if is_long { floor.max(ground) } else { floor }
            }
        }
    }

    /// Displacement (m) at a period that grows from `from` to `to` (s), at a damping (%): past the peak of the first mode at least what it
    /// makes at the end of the peak (C8.7.1.12).
    pub fn displacement(&self, spectrum: &Spectrum, [from, to]: [f64; 2], damping_percent: f64) -> f64 {
        match self {
            Place::Ground => spectrum.displacement([from, to], damping_percent),
            Place::Height(modes) => {
                let at =
                    |period: f64| displaced(self.acceleration(spectrum, period, damping_percent), period);
                let past = modes.first().map(|first| PLATEAU[1] * first.period).filter(|end| to > *end);
                past.map_or(0.0, at).max(at(to))
            }
        }
    }
}

impl Mode {
    /// What it adds to the largest acceleration of the place (m/s^2) (C7.2.7).
    fn peak(&self, spectrum: &Spectrum) -> f64 {
        let damping = self.damping_percent;
        spectrum.acceleration(self.period, damping)
            * self.share.abs()
            * (1.0 + 0.0004 * damping * damping).sqrt()
    }

    /// What it adds to the floor spectrum (m/s^2) (C7.2.6).
    fn floor(&self, spectrum: &Spectrum, period: f64, damping_percent: f64) -> f64 {
        // The clause states the damping of the mode in per cent. Here only the ratio makes sense: with 5 it would make a floor at resonance
        // shake half as much as one that is rigid, with 0.05 five times as much; the larger demand is on the safe side as well.
        let amplified = 1.1 * damping_factor(damping_percent) / (0.01 * self.damping_percent).sqrt();
        let peak = amplified * self.peak(spectrum);
        let [from, to] = PLATEAU.map(|share| share * self.period);
        if period < from {
            peak / (1.0 + (amplified - 1.0) * pow(1.0 - period / from, 1.6))
        } else if period < to {
            peak
        } else {
            peak / (1.0 + (amplified - 1.0) * pow(period / to - 1.0, 1.2))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verify::Corners;

    fn ground() -> Spectrum {
        Spectrum::Ntc { ag: 0.15, soil: 1.2, f0: 2.4, corners: Corners { b: 0.15, c: 0.45, d: 2.2 } }
    }

    fn storey() -> Place {
        Place::Height(vec![Mode { period: 0.3, damping_percent: 5.0, share: 1.2 }])
    }

    /// C7.2.7 by hand: the plateau, 0.432 g, times 1.2 times sqrt(1.01). The floor spectrum begins there, as the amplification cancels at T = 0,
    /// and rises to 1.1 / sqrt(0.05) of it.
    #[test]
    fn a_floor_spectrum_begins_with_the_acceleration_of_the_floor() {
        let floor = 0.432 * crate::math::STANDARD_GRAVITY * 1.2 * 1.01f64.sqrt();
        assert!((storey().peak(&ground()) - floor).abs() < 1e-12);
        assert!((storey().acceleration(&ground(), 0.0, 5.0) - floor).abs() < 1e-12);
        let top = storey().acceleration(&ground(), 0.3, 5.0);
        assert!((top - 1.1 / 0.05f64.sqrt() * floor).abs() < 1e-12);
    }

    #[test]
    fn a_long_period_feels_at_least_the_ground() {
        let spectrum = ground();
        let far = storey().acceleration(&spectrum, 3.0, 8.0);
        assert!(far >= spectrum.acceleration(3.0, 8.0));
        let past = storey().displacement(&spectrum, [0.0, 0.5], 8.0);
        assert!(past >= displaced(storey().acceleration(&spectrum, 0.33, 8.0), 0.33));
    }

    #[test]
    fn on_the_ground_the_spectrum_is_that_of_the_ground() {
        let spectrum = ground();
        assert_eq!(Place::Ground.peak(&spectrum), spectrum.ground());
        assert_eq!(Place::Ground.acceleration(&spectrum, 0.7, 8.0), spectrum.acceleration(0.7, 8.0));
    }
}
