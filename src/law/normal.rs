//! Normal laws: compressive stress of a joint as a function of its closure.

use crate::law::{ClosureTable, Stiffening};
use crate::math::ln;

/// The normal law of a joint. Closure `u` (m) is positive where the faces overlap.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(tag = "law", rename_all = "snake_case")]
pub enum NormalLaw {
    /// `sigma = kn u` (source paper Eq. 2), the law of 3DEC's and YADE's joints.
    Linear {
        /// Normal stiffness per joint area (Pa/m).
        kn: f64,
    },
    /// A linear joint in series with the hyperbola of a rough joint that closes (Goodman 1976; Bandis, Lumsden and Barton
    /// 1983): `u = sigma / kn + Vm sigma / (kni Vm + sigma)`. Soft where little presses: the slope grows from that of `kn`
    /// and `kni` in series to `kn`. With `Vm` near 0 it is the linear law. In tension it goes on with its first slope.
    Hyperbolic {
        /// Stiffness `kn` of the closed joint (Pa/m).
        kn: f64,
        /// Initial stiffness `kni` of the hyperbola (Pa/m).
        initial: f64,
        /// Maximum closure `Vm` of the hyperbola (m).
        closure: f64,
    },
    /// Stiffness that grows as a power of the stress.
    Stiffening(Stiffening),
    /// A free law through knots.
    Table(ClosureTable),
}

impl NormalLaw {
    /// Compressive stress (Pa) at closure `u` (m); the extension of the law to negative `u` is its tension branch.
    pub fn stress(&self, u: f64) -> f64 {
        match *self {
            NormalLaw::Linear { kn } => kn * u,
            NormalLaw::Hyperbolic { .. } if u <= 0.0 => self.first_stiffness() * u,
            NormalLaw::Hyperbolic { kn, initial, closure } => {
                // sigma^2 - b sigma - c = 0; the root without cancellation.
                let knee = initial * closure;
                let (b, c) = (kn * (u - closure) - knee, kn * u * knee);
                let root = (b * b + 4.0 * c).sqrt();
                if b > 0.0 { 0.5 * (b + root) } else { 2.0 * c / (root - b) }
            }
            NormalLaw::Stiffening(law) => law.stress(u),
            NormalLaw::Table(law) => law.stress(u),
        }
    }

    /// Slope of the law (Pa/m) at closure `u` (m).
    pub fn stiffness(&self, u: f64) -> f64 {
        match *self {
            NormalLaw::Linear { kn } => kn,
            NormalLaw::Hyperbolic { .. } if u <= 0.0 => self.first_stiffness(),
            NormalLaw::Hyperbolic { kn, initial, closure } => {
                let knee = initial * closure;
                let above = knee + self.stress(u);
                1.0 / (1.0 / kn + closure * knee / (above * above))
            }
            NormalLaw::Stiffening(law) => law.stiffness(u),
            NormalLaw::Table(law) => law.stiffness(u),
        }
    }

    /// The slope (Pa/m) in tension and where nothing presses yet.
    pub fn first_stiffness(&self) -> f64 {
        match *self {
            NormalLaw::Linear { kn } => kn,
            NormalLaw::Hyperbolic { kn, initial, .. } => kn * initial / (kn + initial),
            NormalLaw::Stiffening(law) => law.first_stiffness(),
            NormalLaw::Table(law) => law.first_stiffness(),
        }
    }

    /// The largest slope that the law can show (Pa/m), for the critical time step.
    pub fn largest_stiffness(&self) -> f64 {
        match *self {
            NormalLaw::Linear { kn } | NormalLaw::Hyperbolic { kn, .. } => kn,
            NormalLaw::Stiffening(law) => law.largest_stiffness(),
            NormalLaw::Table(law) => law.largest_stiffness(),
        }
    }

    /// Stored energy per area (J/m^2) at closure `u` (m).
    pub fn energy(&self, u: f64) -> f64 {
        match *self {
            NormalLaw::Linear { kn } => 0.5 * kn * u * u,
            NormalLaw::Hyperbolic { .. } if u <= 0.0 => 0.5 * self.first_stiffness() * u * u,
            NormalLaw::Hyperbolic { kn, initial, closure } => {
                let (knee, sigma) = (initial * closure, self.stress(u));
                if knee == 0.0 {
                    return 0.5 * kn * u * u;
                }
                let ratio = (knee + sigma) / knee;
                0.5 * sigma * sigma / kn + closure * knee * (ln(ratio) + 1.0 / ratio - 1.0)
            }
            NormalLaw::Stiffening(law) => law.energy(u),
            NormalLaw::Table(law) => law.energy(u),
        }
    }

    /// Closure (m) at a compressive stress (Pa), the inverse of [`NormalLaw::stress`]; below 0 that of its tension branch.
    pub fn closure(&self, stress: f64) -> f64 {
        match *self {
            _ if stress <= 0.0 => stress / self.first_stiffness(),
            NormalLaw::Linear { kn } => stress / kn,
            NormalLaw::Hyperbolic { kn, initial, closure } => {
                stress / kn + closure * stress / (initial * closure + stress)
            }
            NormalLaw::Stiffening(law) => law.closure(stress),
            NormalLaw::Table(law) => law.closure(stress),
        }
    }

    /// A law that is soft until it has closed, with a share of its stiffness once it has; `None` where it is another law.
    pub fn softened(&self, share: f64) -> Option<NormalLaw> {
        match *self {
            NormalLaw::Hyperbolic { kn, initial, closure } => {
                Some(NormalLaw::Hyperbolic { kn: share * kn, initial, closure })
            }
            NormalLaw::Linear { .. } | NormalLaw::Stiffening(_) | NormalLaw::Table(_) => None,
        }
    }

    /// The law with so many times the stress at any closure.
    pub fn scaled(&self, factor: f64) -> NormalLaw {
        match *self {
            NormalLaw::Linear { kn } => NormalLaw::Linear { kn: kn * factor },
            NormalLaw::Hyperbolic { kn, initial, closure } => {
                NormalLaw::Hyperbolic { kn: kn * factor, initial: initial * factor, closure }
            }
            NormalLaw::Stiffening(law) => NormalLaw::Stiffening(law.scaled(factor)),
            NormalLaw::Table(law) => NormalLaw::Table(law.scaled(factor)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    const SOFT: NormalLaw = NormalLaw::Hyperbolic { kn: 5e7, initial: 1e7, closure: 2e-4 };

    #[test]
    fn the_hyperbola_is_the_inverse_of_its_closure() {
        for sigma in [1e-3, 10.0, 1e3, 2e3, 1e4, 1e6] {
            let u = sigma / 5e7 + 2e-4 * sigma / (2e3 + sigma);
            // Rounding of a square root.
            assert_relative_eq!(SOFT.stress(u), sigma, max_relative = 1e-12);
            assert_relative_eq!(SOFT.closure(sigma), u, max_relative = 1e-14);
        }
        assert_relative_eq!(SOFT.stress(-1e-5), -1e-5 * 5e7 / 6.0, max_relative = 1e-14);
        assert_eq!(SOFT.stress(0.0), 0.0);
    }

    /// Powers of a third, a half and one.
    fn powers() -> [NormalLaw; 3] {
        [(3e8, 1.0 / 3.0), (7e8, 0.5), (1e10, 1.0)]
            .map(|(at_1_mpa, exponent)| NormalLaw::Stiffening(Stiffening::new(5e7, at_1_mpa, exponent, 1e6)))
    }

    #[test]
    fn slope_and_energy_are_the_derivative_and_the_integral_of_the_stress() {
        let table = ClosureTable::through(&[2e-5, 1e-4, 3e-4], &[5e2, 4e3, 3e4]).expect("it rises");
        let all = [SOFT, NormalLaw::Table(table)].into_iter().chain(powers());
        for (law, u) in all.flat_map(|law| [-1e-4, 1e-6, 5e-5, 2e-4, 1e-3].map(|u| (law, u))) {
            let h = 1e-9;
            let slope = (law.stress(u + h) - law.stress(u - h)) / (2.0 * h);
            // Third differences and the rounding of 1e4 Pa over 1e-9 m.
            assert_relative_eq!(law.stiffness(u), slope, max_relative = 2e-6);
            let n = 100_000;
            let middle = |k: i32| law.stress(u * (f64::from(k) + 0.5) / f64::from(n));
            let work = (0..n).map(middle).sum::<f64>() * u / f64::from(n);
            // The midpoint rule with 1e5 strips, across knees of the slope.
            assert_relative_eq!(law.energy(u), work, max_relative = 1e-7);
        }
        assert_relative_eq!(SOFT.stiffness(0.0), 5e7 / 6.0, max_relative = 1e-14);
        assert!(SOFT.stiffness(1.0) < SOFT.largest_stiffness() && SOFT.stiffness(1.0) > 4.999e7);
    }

    #[test]
    fn without_closure_it_is_the_linear_law() {
        let (linear, u) = (NormalLaw::Linear { kn: 5e7 }, 3e-5);
        for (closure, tolerance) in [(1e-8, 1e-3), (1e-11, 1e-6), (0.0, 1e-15)] {
            let law = NormalLaw::Hyperbolic { kn: 5e7, initial: 1e7, closure };
            // The joint closes by Vm more.
            assert_relative_eq!(law.stress(u), linear.stress(u), max_relative = tolerance);
            assert_relative_eq!(law.energy(u), linear.energy(u), max_relative = tolerance);
        }
    }
}
