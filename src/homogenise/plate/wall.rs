//! The plate: its size, its loads, what holds it, and whether they make sense.

use super::facet::Facet;
use super::mesh::Side;

/// How an edge of the plate is held.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Edge {
    /// Not at all.
    Free,
    /// Against going out of its plane, both ways; it may turn, and move in its plane.
    Propped,
    /// Against going out of its plane and against turning, as where the end stones are led; it may move in its plane.
    Guided,
    /// As on ground or at an end block: what is beyond the edge does not move, and the section at the edge obeys the same facets,
    /// so that it hinges, slides along the edge and opens at their price.
    Held,
}

/// How the four edges of the plate are held.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Edges {
    /// At z = 0.
    pub bottom: Edge,
    /// At x = 0.
    pub left: Edge,
    /// At x = length.
    pub right: Edge,
    /// At z = height.
    pub top: Edge,
}

impl Edges {
    /// A wall that rests on the ground and is free elsewhere.
    pub const RESTING: Self =
        Self { bottom: Edge::Held, left: Edge::Free, right: Edge::Free, top: Edge::Free };
    /// A wall that rests on the ground between two end blocks.
    pub const BETWEEN_END_BLOCKS: Self =
        Self { bottom: Edge::Held, left: Edge::Held, right: Edge::Held, top: Edge::Free };

    pub(super) fn at(&self, side: Side) -> Edge {
        match side {
            Side::Bottom => self.bottom,
            Side::Left => self.left,
            Side::Right => self.right,
            Side::Top => self.top,
        }
    }
}

/// A rectangular wall as a plate: x along it, y out of plane, z up.
#[derive(Clone, Debug, PartialEq)]
pub struct Plate {
    /// Length along x (m).
    pub length: f64,
    /// Height along z (m).
    pub height: f64,
    /// Cells of the mesh along x and along z, each of four triangles. Twice as many each way never raises the multiplier.
    pub mesh: [usize; 2],
    /// Dead load (N/m^2): weight per area of the wall's face, along -z.
    pub weight: f64,
    /// Live load at a multiplier of one (N/m^2): force per area of the wall's face along x, y and z. The wall's weight along y is
    /// a tilt out of plane, along x one in plane; the multiplier is then the tangent of the angle.
    pub live: [f64; 3],
    /// The live load at the bottom over that at the top: it changes linearly with height about the mean above; 1 where it does not.
    pub base_over_top: f64,
    /// How the edges are held.
    pub edges: Edges,
    /// Points (x, z) that ropes hold against going towards +y; going back they do not hinder.
    pub ropes: Vec<[f64; 2]>,
    /// Friction coefficient of the ground under the wall, for [`super::Collapse::sliding`]. A thin plate never fails by shear
    /// across its thickness, so the facets cannot say it.
    pub base_friction: Option<f64>,
}

/// Why there is no multiplier.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum PlateFault {
    /// Length or height is not a positive number.
    #[error("length and height of a plate must be above 0 m, not {0} and {1}")]
    Size(f64, f64),
    /// No cells one way.
    #[error("the mesh of a plate needs a cell each way, not {0} x {1}")]
    Mesh(usize, usize),
    /// The weight is not a number of at least zero, the live load is nothing or not finite, or its ratio over the height is no number of
    /// at least zero.
    #[error(
        "the weight of a plate must be 0 N/m^2 or more, its live load finite and not 0, and that at the base over that at the top 0 or more"
    )]
    Load,
    /// The friction coefficient of the ground is not a number of at least zero.
    #[error("the friction coefficient under a plate must be 0 or more, not {0}")]
    Friction(f64),
    /// The rope of this place in the list does not lie on the plate.
    #[error("rope {0} of the plate is not on it")]
    Rope(usize),
    /// The facet of this place in the list has no direction, or is not finite.
    #[error("facet {0} has no direction, or is not finite")]
    Facet(usize),
    /// A joint of the cell has cohesion or tensile strength.
    #[error(
        "what a plate bears is taken from its weight alone, but a joint of its cell has cohesion or tensile strength: set both to 0"
    )]
    Bond,
    /// No mechanism is both possible and driven by the live load: any multiplier is borne.
    #[error("the wall bears the live load whatever its size")]
    Unbounded,
    /// No state of stress within the facets bears the dead load alone.
    #[error("the wall falls at rest")]
    FallsAtRest,
    /// The linear program was not solved to its tolerance; the solver's own word for it.
    #[error("the linear program of the plate was not solved: {0}")]
    NotSolved(String),
}

impl Plate {
    /// Whether the plate and the facets make sense.
    pub(super) fn check(&self, facets: &[Facet]) -> Result<(), PlateFault> {
        let positive = |x: f64| x.is_finite() && x > 0.0;
        if !positive(self.length) || !positive(self.height) {
            return Err(PlateFault::Size(self.length, self.height));
        }
        if self.mesh.contains(&0) {
            return Err(PlateFault::Mesh(self.mesh[0], self.mesh[1]));
        }
        let live = self.live.iter().all(|q| q.is_finite()) && self.live.iter().any(|&q| q != 0.0);
        let linear = self.base_over_top.is_finite() && self.base_over_top >= 0.0;
        if !(self.weight.is_finite() && self.weight >= 0.0 && live && linear) {
            return Err(PlateFault::Load);
        }
        if let Some(friction) = self.base_friction.filter(|f| !(f.is_finite() && *f >= 0.0)) {
            return Err(PlateFault::Friction(friction));
        }
        let on = |&[x, z]: &[f64; 2]| (0.0..=self.length).contains(&x) && (0.0..=self.height).contains(&z);
        if let Some(rope) = self.ropes.iter().position(|at| !on(at)) {
            return Err(PlateFault::Rope(rope));
        }
        facets.iter().position(|f| !f.is_sound()).map_or(Ok(()), |k| Err(PlateFault::Facet(k)))
    }

    /// The multiplier at which the whole wall slides out on its base; `None` where the friction is not given, where more than the
    /// base hinders that, or where the live load does not press the wall out.
    pub(super) fn sliding(&self) -> Option<f64> {
        let Edges { bottom, left, right, top } = self.edges;
        let alone = bottom == Edge::Held && [left, right, top] == [Edge::Free; 3];
        let out = self.live[1].abs();
        // A rope holds towards +y only.
        let roped = !self.ropes.is_empty() && self.live[1] > 0.0;
        // What the live load lifts it takes off the friction.
        let friction = self.base_friction.filter(|_| alone && !roped && out > 0.0)?;
        let drive = out + friction * self.live[2];
        (drive > 0.0).then(|| friction * self.weight / drive)
    }
}
