//! A joint whose stiffness grows as a power of the stress on it, between a floor and a ceiling.
//!
//! ```text
//! d sigma / d u = k(sigma),     k(sigma) = min(kn, max(k_f, k1 (sigma / 1 MPa)^m))
//! ```
//!
//! Rough faces touch in more places the harder they are pressed together: `m = 1/3` for balls (Hertz 1882), `m = 1` for
//! asperities of exponentially distributed height (Greenwood and Williamson 1966), where stress grows exponentially with
//! closure. The floor stands for a joint that is only just laid, and for its tension branch; the ceiling `kn` for the stones
//! themselves. Integrating `du = d sigma / k(sigma)` from the stress `s` at which the power law leaves the floor gives, with
//! `x = k_f (u - s / k_f) / s`,
//!
//! ```text
//! sigma = s (1 + (1 - m) x)^(1 / (1 - m)),     sigma = s exp(x) where m = 1
//! ```

use crate::math::{exp, ln, ln_1p, pow};

/// The stress (Pa) at which the power law has the stiffness by which it is given.
const UNIT: f64 = 1e6;

/// The law; its knees are kept beside its parameters.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Stiffening {
    /// Ceiling of the stiffness (Pa/m).
    kn: f64,
    /// Stiffness (Pa/m) of the power law at 1 MPa.
    at_1_mpa: f64,
    /// Exponent `m`, above 0 and at most 1.
    exponent: f64,
    /// Floor of the stiffness (Pa/m), at most the ceiling.
    floor: f64,
    /// Stress (Pa) and closure (m) at which the stiffness leaves the floor.
    leaves: [f64; 2],
    /// Stress (Pa) and closure (m) at which it reaches the ceiling.
    arrives: [f64; 2],
}

impl Stiffening {
    /// The law with a ceiling `kn`, a stiffness at 1 MPa, an exponent in (0, 1] and a floor (Pa/m). A floor above the ceiling is
    /// the ceiling: the law is then linear.
    pub fn new(kn: f64, at_1_mpa: f64, exponent: f64, floor: f64) -> Stiffening {
        let floor = floor.min(kn);
        let reaches = |stiffness: f64| UNIT * pow(stiffness / at_1_mpa, 1.0 / exponent);
        let (low, high) = (reaches(floor), reaches(kn));
        let open = Stiffening {
            kn,
            at_1_mpa,
            exponent,
            floor,
            leaves: [low, low / floor],
            arrives: [f64::INFINITY; 2],
        };
        Stiffening { arrives: [high, open.closure(high)], ..open }
    }

    /// The law with so many times the stress at any closure.
    pub(super) fn scaled(&self, factor: f64) -> Stiffening {
        let at_1_mpa = self.at_1_mpa * pow(factor, 1.0 - self.exponent);
        Stiffening::new(self.kn * factor, at_1_mpa, self.exponent, self.floor * factor)
    }

    pub(super) fn stress(&self, u: f64) -> f64 {
        let ([s, from], [high, until]) = (self.leaves, self.arrives);
        if u <= from {
            return self.floor * u;
        }
        if u >= until {
            return high + self.kn * (u - until);
        }
        let (x, left) = (self.floor * (u - from) / s, 1.0 - self.exponent);
        s * if left == 0.0 { exp(x) } else { exp(ln_1p(left * x) / left) }
    }

    pub(super) fn stiffness(&self, u: f64) -> f64 {
        let ([s, from], [_, until]) = (self.leaves, self.arrives);
        if u <= from {
            self.floor
        } else if u >= until {
            self.kn
        } else {
            self.floor * pow(self.stress(u) / s, self.exponent)
        }
    }

    pub(super) fn first_stiffness(&self) -> f64 {
        self.floor
    }

    pub(super) fn largest_stiffness(&self) -> f64 {
        self.kn
    }

    /// The closure (m) at a stress (Pa): the integral of the compliance.
    pub(super) fn closure(&self, stress: f64) -> f64 {
        let ([s, from], [high, until]) = (self.leaves, self.arrives);
        if stress <= s {
            return stress / self.floor;
        }
        if stress > high {
            return until + (stress - high) / self.kn;
        }
        let (grown, left) = (ln(stress / s), 1.0 - self.exponent);
        from + s / self.floor * if left == 0.0 { grown } else { (exp(left * grown) - 1.0) / left }
    }

    pub(super) fn energy(&self, u: f64) -> f64 {
        let ([s, from], [high, until]) = (self.leaves, self.arrives);
        if u <= from {
            return 0.5 * self.floor * u * u;
        }
        // The integral of sigma / k(sigma) over sigma.
        let over = 2.0 - self.exponent;
        let grown = |stress: f64| 0.5 * s * from + s * from * (pow(stress / s, over) - 1.0) / over;
        if u <= until {
            return grown(self.stress(u));
        }
        let beyond = u - until;
        let before = if high > s { grown(high) } else { 0.5 * s * from };
        before + beyond * (high + 0.5 * self.kn * beyond)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    /// Laws of walls under some kPa, from balls to asperities; the last never reaches its ceiling there.
    fn laws() -> [Stiffening; 4] {
        [
            Stiffening::new(5e7, 3e8, 1.0 / 3.0, 1e6),
            Stiffening::new(5e7, 7e8, 0.5, 1e6),
            Stiffening::new(5e7, 1e10, 1.0, 1e6),
            Stiffening::new(1e9, 1e9, 0.7, 2e6),
        ]
    }

    #[test]
    fn closure_is_the_integral_of_the_compliance() {
        for law in laws() {
            for stress in [1.0, 50.0, 1e3, 5e3, 2e4, 1e5] {
                let stiffness =
                    |sigma: f64| (law.at_1_mpa * pow(sigma / 1e6, law.exponent)).clamp(law.floor, law.kn);
                let n = 200_000;
                let strip = |k: i32| 1.0 / stiffness(stress * (f64::from(k) + 0.5) / f64::from(n));
                let closure = (0..n).map(strip).sum::<f64>() * stress / f64::from(n);
                // The midpoint rule across the knees of the stiffness: strips of half a pascal, a knee at some tens.
                assert_relative_eq!(law.closure(stress), closure, max_relative = 1e-4);
                assert_relative_eq!(law.stress(law.closure(stress)), stress, max_relative = 1e-12);
            }
        }
    }

    #[test]
    fn it_is_linear_where_floor_and_ceiling_meet_and_in_tension() {
        for law in [Stiffening::new(5e7, 1e9, 0.5, 5e7), Stiffening::new(5e7, 1e9, 0.5, 1e8)] {
            for u in [-1e-4, 1e-9, 1e-5, 1e-3, 0.1] {
                assert_relative_eq!(law.stress(u), 5e7 * u, max_relative = 1e-12);
                assert_eq!(law.stiffness(u), 5e7);
                assert_relative_eq!(law.energy(u), 2.5e7 * u * u, max_relative = 1e-12);
            }
        }
        let [law, ..] = laws();
        assert_eq!((law.stress(-1e-3), law.stress(0.0), law.stiffness(-1.0)), (-1e3, 0.0, 1e6));
    }

    #[test]
    fn a_multiple_of_it_has_that_multiple_of_the_stress() {
        for law in laws() {
            for u in [1e-6, 1e-5, 1e-4, 1e-3] {
                assert_relative_eq!(law.scaled(1.7).stress(u), 1.7 * law.stress(u), max_relative = 1e-11);
            }
        }
    }
}
