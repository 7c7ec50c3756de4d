//! The protocols and their settings, as a study states them.

use crate::contact;
use crate::model::Wall;
use crate::protocol::base_motion::BaseMotion;
use crate::protocol::direction::Direction;
use crate::protocol::events::EventShares;
use crate::protocol::retaining::Retaining;
use crate::protocol::shear::Shear;
use crate::protocol::stage::typical_size;

/// How the ends of the wall (x = 0 and x = length) are held.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Ends {
    /// Free.
    Free,
    /// Fixed end blocks against which the wall stands with ordinary joints (no tension, Coulomb friction).
    FixedEndBlocks,
    /// The end stones cannot move out of plane.
    OutOfPlane,
    /// Joint springs (kn, ks) to fixed end blocks, which neither open nor slip.
    JointSprings,
    /// Ropes across the downhill face near both ends.
    Ropes(Rope),
}

/// Two ropes down the downhill face, one near each end. Each stone that a rope crosses on the face is held there, at the
/// middle of its height, by a tie of its own; wedges are not.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rope {
    /// Stiffness (N/m) per course and end.
    pub stiffness: f64,
    /// Force (N) per course and end with which the rope presses on the wall as built.
    pub pretension: f64,
    /// Displacement (m) of a stone before the rope resists.
    pub slack: f64,
    /// Distance (m) of the ropes from the wall's ends.
    pub from_end: f64,
    /// Whether it pushes as well as pulls: a strut instead of a rope.
    pub two_sided: bool,
}

impl Default for Rope {
    /// Taut without force, 1e6 N/m, 50 mm from the ends.
    fn default() -> Self {
        Rope { stiffness: 1e6, pretension: 0.0, slack: 0.0, from_end: 0.05, two_sided: false }
    }
}

/// What the wall stands on: a fixed platform with an ordinary joint, and what stops the wall's foot on it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Base {
    /// tan of the friction angle between the wall and what is fixed under it (platform and strip); `None` = as in the
    /// wall's own joints.
    pub tan_phi: Option<f64>,
    /// Height (m) of a fixed strip along the wall's foot on its downhill side, which stops it from sliding and lifts its
    /// hinge; `None` = no strip. (A second one uphill, if it fits tightly, would clamp the foot.)
    pub strip_height: Option<f64>,
    /// What gives way under platform, strip and end blocks, which then settle and turn as one; `None` = nothing. Ropes hold on
    /// to the frame of the table.
    pub compliance: Option<Compliance>,
}

/// Springs under a platform, about its centre line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Compliance {
    /// Stiffness against settling (N/m).
    pub settlement: f64,
    /// Stiffness against turning out of plane (N m/rad).
    pub rotation: f64,
}

/// How joints are found and divided.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contacts {
    /// Sub-contacts of a joint along its longer and its shorter extent.
    pub sub_contacts: [u32; 2],
    /// Width (m) of the rounded arris along the stones' edges, where joints do not touch.
    pub inset: f64,
    /// Gap (m) up to which faces as built touch; `None` = as of walls that are generated, where all faces meet.
    pub closed: Option<f64>,
}

/// Contacts are looked for up to so many gaps that count as closed, so that what touches is well within.
const REACHES: f64 = 2.0;

impl Contacts {
    /// The settings by which the joints of a wall are found.
    pub fn of_wall(&self, wall: &Wall) -> contact::Settings {
        let standard = contact::Settings::for_size(typical_size(wall), self.sub_contacts);
        let sharp = match self.closed {
            Some(closed) => {
                contact::Settings { closed, reach: standard.reach.max(REACHES * closed), ..standard }
            }
            None => standard,
        };
        contact::Settings { inset: self.inset, ..sharp }
    }
}

impl From<[u32; 2]> for Contacts {
    /// Sharp arrises.
    fn from(sub_contacts: [u32; 2]) -> Contacts {
        Contacts { sub_contacts, inset: 0.0, closed: None }
    }
}

/// What holds a wall.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Restraint {
    /// Under it.
    pub base: Base,
    /// At its ends.
    pub ends: Ends,
}

impl Restraint {
    /// On a platform with the wall's own friction and without strips.
    pub fn at_ends(ends: Ends) -> Restraint {
        Restraint { base: Base::default(), ends }
    }
}

/// Gravity, then a trapezoidal pressure on the back face (-y) towards +y, in equal steps.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Lateral {
    /// Mean horizontal pressure over the height (Pa of vertical projection).
    pub mean_pressure: f64,
    /// Pressure at the base over pressure at the top; 2 gives 4/3 and 2/3 of the mean.
    pub base_over_top: f64,
    /// Number of equal load steps after gravity, at least 1.
    pub steps: u32,
    /// The wall counts as collapsed when its top has moved out of plane by this share of its base thickness.
    pub collapse_share: f64,
}

/// A tilting table: gravity on the level platform, then the platform tilts about its edge towards one side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tilting {
    /// The side that goes down.
    pub towards: Direction,
    /// Tilt from step to step (rad); default 0.5 deg.
    pub step: f64,
    /// Largest tilt (rad), at most 89 deg; a wall that stands there stands to the end.
    pub end: f64,
    /// The collapse angle is bracketed to this (rad); default 0.01 deg.
    pub bracket: f64,
    /// The wall counts as running away when the centroid of any block has moved by this share of the wall's base thickness
    /// since the last state at rest; default 0.1. It must be large against what one step of tilt moves a wall that
    /// stands (some thousandths of its thickness near collapse), and small against the wall.
    pub collapse_share: f64,
    /// Whether the platform stops for the wall to come to rest.
    pub rate: Rate,
    /// What the test is about; default the collapse angle.
    pub observes: Observes,
    /// Whether the platform is let back to the level after every full step of tilt, and what is left of the displacements is read
    /// there. The test goes on from the tilt as if it had not; default no.
    pub remainders: bool,
    /// Which parts of the wall are seen to fall, and which of them is its capacity.
    pub events: EventShares,
}

/// What a test on a tilting table is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Observes {
    /// The tilt at which the wall falls.
    CollapseAngle,
    /// How far the wall's top has moved at the largest tilt asked for.
    Displacement,
}

/// Whether the platform stops for the wall to come to rest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Rate {
    /// It does, at every step.
    Static,
    /// It turns steadily while the wall moves in true time.
    Dynamic(Turning),
}

/// A platform that turns steadily. The wall then moves in true time, by the explicit solver with true inertia, whatever
/// the study's own solver is; that one brings it to rest on the level platform if it is explicit itself.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Turning {
    /// Tilt rate (rad/s).
    pub rate: f64,
    /// Local damping coefficient, in [0, 1); default 0.05: blocks that rattle come to rest, a wall that falls is slowed by
    /// as much.
    pub damping: f64,
    /// Share of the critical time step taken, in (0, 1]; default 0.5.
    pub step_safety: f64,
}

impl Default for Tilting {
    fn default() -> Self {
        use crate::math::radians;
        Tilting {
            towards: Direction::YPlus,
            step: radians(0.5),
            end: radians(89.0),
            bracket: radians(0.01),
            collapse_share: 0.1,
            rate: Rate::Static,
            observes: Observes::CollapseAngle,
            remainders: false,
            events: EventShares::default(),
        }
    }
}

/// What is done to each wall of a study.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Protocol {
    /// Service load on the back face: the source paper's section 4.1.
    Lateral(Lateral),
    /// Tilting table: the source paper's sections 2.2 and 3.4.
    Tilting(Tilting),
    /// Shear in the wall's plane under a constant vertical load.
    Shear(Shear),
    /// A base that shakes, see [`shake_wall`](crate::protocol::shake_wall).
    BaseMotion(BaseMotion),
    /// Fill or water that rises behind the wall.
    Retaining(Retaining),
}
