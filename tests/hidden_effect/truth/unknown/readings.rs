//! Effects outside the catalogue that act on what platform and gauges show.

use pirca::math::radians;

use crate::truth::effect::{Effect, Specimen};
use crate::truth::readings::Series;

pub struct StickSlip {
    pub threshold: f64,
}

impl Effect for StickSlip {
    fn read(&self, series: &mut Series, _: &Specimen) {
        let mut stays = [0.0_f64; 3];
        for points in &mut series.points {
            for (point, stays) in points.iter_mut().zip(&mut stays) {
                if (*point - *stays).abs() > self.threshold {
                    *stays = *point;
                }
                *point = *stays;
            }
        }
    }
}

pub struct Drift {
    pub per_test: f64,
}

impl Effect for Drift {
    fn read(&self, series: &mut Series, specimen: &Specimen) {
        let shift = self.per_test * f64::from(specimen.order - 1);
        series.points.iter_mut().skip(1).flatten().for_each(|point| *point += shift);
    }
}

pub struct Saturation {
    pub largest: f64,
}

impl Effect for Saturation {
    fn read(&self, series: &mut Series, _: &Specimen) {
        series.points.iter_mut().flatten().for_each(|point| *point = point.min(self.largest));
    }
}

pub struct TiltScale {
    pub factor: f64,
}

impl Effect for TiltScale {
    fn tilt(&self, shown: f64) -> f64 {
        shown / self.factor
    }

    fn shown(&self, tilt: f64) -> f64 {
        tilt * self.factor
    }
}

pub struct Backlash {
    pub lag_deg: f64,
}

impl Effect for Backlash {
    fn tilt(&self, shown: f64) -> f64 {
        (shown - radians(self.lag_deg)).max(0.0)
    }

    fn shown(&self, tilt: f64) -> f64 {
        tilt + radians(self.lag_deg)
    }
}

pub struct Knock {
    pub at_deg: f64,
    pub jump: f64,
}

impl Effect for Knock {
    fn read(&self, series: &mut Series, _: &Specimen) {
        let after = series.points.iter_mut().enumerate().filter(|(k, _)| Series::tilt_deg(*k) > self.at_deg);
        after.flat_map(|(_, points)| points).for_each(|point| *point += self.jump);
    }
}

pub struct Crosstalk {
    pub share: f64,
}

impl Effect for Crosstalk {
    fn read(&self, series: &mut Series, _: &Specimen) {
        for [left, centre, right] in &mut series.points {
            let (l, r) = (*left, *right);
            *left = l + self.share * (*centre + r);
            *right = r + self.share * (*centre + l);
        }
    }
}
