//! What a wall holds back, and what that presses with at a depth below its surface.

use crate::math::STANDARD_GRAVITY;
use crate::protocol::retaining::wedge::Wedge;

/// Density of water (kg/m^3).
pub const WATER: f64 = 1000.0;

/// What a wall holds back.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Retained {
    /// Soil.
    Fill(Fill),
    /// Water alone, of a density (kg/m^3).
    Water(f64),
}

/// A fill of soil without cohesion behind a wall.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fill {
    /// Density (kg/m^3) with the water that is in its pores: where it is not drained that of the soil full of water, above that of water.
    pub density: f64,
    /// Friction angle (rad), above 0.
    pub phi: f64,
    /// The share of its friction angle that the fill mobilises on the back of the wall, in [0, 1].
    pub wall_friction: f64,
    /// Slope of its surface (rad): above 0 where it rises away from the wall, at most `phi`.
    pub slope: f64,
    /// Weight on its surface (Pa, per horizontal area).
    pub surcharge: f64,
    /// Whether water runs off. Else it stands in the fill up to the surface: it presses by itself, and the soil weighs so much less.
    pub drained: bool,
}

/// How a pressure acts on the faces of a back.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Acts {
    /// Per vertical projection of a face, in a direction so far (rad) below the horizontal.
    Inclined(f64),
    /// Across each face, on its area.
    Across,
}

/// A pressure that grows with the depth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Pressure {
    /// At the surface (Pa).
    pub surface: f64,
    /// Per depth (Pa/m).
    pub deeper: f64,
    /// How it acts.
    pub acts: Acts,
}

impl Retained {
    /// The pressures on a back of some lean (rad, see [`Wedge::lean`]), and the coefficient of those of soil; `None` where the soil has no
    /// [wedge](Wedge::coefficient).
    pub(super) fn pressures(&self, lean: f64) -> Option<(Vec<Pressure>, Option<f64>)> {
        let hydrostatic =
            |density: f64| Pressure { surface: 0.0, deeper: density * STANDARD_GRAVITY, acts: Acts::Across };
        match self {
            Retained::Water(density) => Some((vec![hydrostatic(*density)], None)),
            Retained::Fill(fill) => {
                let wedge = fill.behind(lean);
                let coefficient = wedge.coefficient()?;
                let borne = if fill.drained { 0.0 } else { WATER };
                let soil = Pressure {
                    surface: coefficient * wedge.surcharge(fill.surcharge),
                    deeper: coefficient * (fill.density - borne) * STANDARD_GRAVITY,
                    acts: Acts::Inclined(wedge.inclination()),
                };
                let water = (!fill.drained).then(|| hydrostatic(WATER));
                Some(([Some(soil), water].into_iter().flatten().collect(), Some(coefficient)))
            }
        }
    }
}

/// Why there is no such fill.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NoFill {
    /// Its surface is steeper than its friction angle: no soil without cohesion lies so.
    TooSteep,
    /// It is full of water, and no heavier than water.
    TooLight,
}

impl Fill {
    /// Why there is no such fill, where there is none.
    pub fn wrong(&self) -> Option<NoFill> {
        if self.slope > self.phi {
            return Some(NoFill::TooSteep);
        }
        (!self.drained && self.density <= WATER).then_some(NoFill::TooLight)
    }

    /// Angle of friction (rad) on the back of the wall.
    pub fn delta(&self) -> f64 {
        self.wall_friction * self.phi
    }

    fn behind(&self, lean: f64) -> Wedge {
        Wedge { phi: self.phi, delta: self.delta(), lean, slope: self.slope }
    }
}
