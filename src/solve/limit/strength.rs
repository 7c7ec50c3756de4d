//! What a contact point can bear, and what it costs to move it.

use crate::law::Coulomb;
use crate::math::{cos, sin};
use crate::solve::limit::Cone;

/// The set `|t| <= cohesion + friction n`, `n >= least` of the forces that a contact point can bear (N); with `bonded` any
/// force.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Strength {
    pub friction: f64,
    pub cohesion: f64,
    /// Smallest normal force: minus the tensile strength.
    pub least: f64,
    pub bonded: bool,
}

/// What a mechanism does at a contact point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Cost {
    /// Power dissipated (W).
    pub power: f64,
    /// By how much the velocity breaks the flow rule (m/s): closing faster than the dilatancy of its sliding allows.
    pub incompatibility: f64,
}

impl Strength {
    /// The strength of a point with this share of the joint's area (m^2).
    pub fn of(law: &Coulomb, area: f64) -> Self {
        Strength {
            friction: law.tan_phi,
            cohesion: law.cohesion * area,
            least: -law.tension * area,
            bonded: law.bonded,
        }
    }

    /// Whether the set is a cone: a load that is proportional to gravity then has one multiplier for any gravity.
    pub fn is_cone(&self) -> bool {
        self.bonded || (self.cohesion == 0.0 && self.least == 0.0)
    }

    /// The cone that is left for forces without bound.
    pub fn recession(&self) -> Self {
        Strength { cohesion: 0.0, least: 0.0, ..*self }
    }

    /// Whether the point can bear any shear.
    pub fn shears(&self) -> bool {
        self.bonded || self.friction > 0.0 || self.cohesion > 0.0
    }

    /// Whether `n >= least` says more than the friction envelope does.
    pub fn needs_least(&self) -> bool {
        !self.bonded && (self.friction == 0.0 || self.least > -self.cohesion / self.friction)
    }

    /// The smallest normal force that the envelope leaves.
    fn lowest(&self) -> f64 {
        if self.needs_least() { self.least } else { -self.cohesion / self.friction }
    }

    /// By how much (N) a force lies outside the set; 0 inside.
    pub fn excess(&self, force: [f64; 3], cone: Cone) -> f64 {
        if self.bonded {
            return 0.0;
        }
        let [n, t1, t2] = force;
        let shear = gauge([t1, t2], cone) - (self.cohesion + self.friction * n);
        shear.max(self.least - n).max(0.0)
    }

    /// The cost of moving the incident block past the reference with velocity `[opening, along e1, along e2]` (m/s): the
    /// largest power `-f . u` over all forces of the set.
    pub fn cost(&self, u: [f64; 3], cone: Cone) -> Cost {
        let [un, u1, u2] = u;
        if self.bonded {
            return Cost { power: 0.0, incompatibility: (un * un + u1 * u1 + u2 * u2).sqrt() };
        }
        let slide = support([u1, u2], cone);
        let free = un - self.friction * slide;
        Cost {
            power: self.cohesion * slide - self.lowest() * free.max(0.0),
            incompatibility: (-free).max(0.0),
        }
    }
}

/// Directions of the pyramid's edges: `k` turns of `2 pi / sides` from the first in-plane axis.
fn edge(k: u32, sides: u32) -> [f64; 2] {
    let angle = 2.0 * std::f64::consts::PI * f64::from(k) / f64::from(sides);
    [cos(angle), sin(angle)]
}

/// The sides of the pyramid: unit normals, between two edges, in the joint's plane.
pub(crate) fn facets(sides: u32) -> impl Iterator<Item = [f64; 2]> {
    (0..sides).map(move |k| {
        let angle = std::f64::consts::PI * f64::from(2 * k + 1) / f64::from(sides);
        [cos(angle), sin(angle)]
    })
}

/// Distance of the sides from the axis, of a pyramid whose edges lie at 1.
pub(crate) fn apothem(sides: u32) -> f64 {
    cos(std::f64::consts::PI / f64::from(sides))
}

/// Size of a shear force measured by the section of the cone: 1 on the section's rim.
fn gauge(t: [f64; 2], cone: Cone) -> f64 {
    match cone {
        Cone::SecondOrder => (t[0] * t[0] + t[1] * t[1]).sqrt(),
        Cone::Linearised { sides } => {
            facets(sides).map(|a| a[0] * t[0] + a[1] * t[1]).fold(0.0, f64::max) / apothem(sides)
        }
    }
}

/// Largest product of a sliding velocity with a shear force of the cone's section.
fn support(u: [f64; 2], cone: Cone) -> f64 {
    match cone {
        Cone::SecondOrder => (u[0] * u[0] + u[1] * u[1]).sqrt(),
        Cone::Linearised { sides } => (0..sides)
            .map(|k| edge(k, sides))
            .map(|p| p[0] * u[0] + p[1] * u[1])
            .fold(f64::NEG_INFINITY, f64::max),
    }
}
