//! What a wall is asked to be: the outline, the arrangement of its joints, and the distributions of its sizes.

use std::sync::Arc;

use crate::generate::{Sizes, Unseen};
use crate::model::Wall;
use crate::random::Family;

/// Everything the generator needs to know; a member's wall is a pure function of this, the seed and the member.
#[derive(Clone, Debug, PartialEq)]
pub struct Layout {
    /// The wall's outer shape.
    pub outline: Outline,
    /// How stones are arranged.
    pub arrangement: Arrangement,
    /// Density of a stone (kg/m^3), drawn per stone.
    pub density: Family,
    /// Stones spanning the thickness side by side (1 or more), and the headers that tie them.
    pub wythes: Wythes,
    /// Width of the open slot in every head joint (m), cut out of both stones alike; 0 for closed head joints. The
    /// ends of the wall have none, nor have the longitudinal joints between wythes.
    pub head_joint_gap: f64,
    /// Wedge stones, if any.
    pub wedges: Option<Wedges>,
    /// What a stone must at least be.
    pub limits: Limits,
}

impl Layout {
    /// The same with stone lengths and heights that deviate `factor` times as far from their means.
    pub fn widened(mut self, factor: f64) -> Layout {
        if let Arrangement::Coursed { sizes, .. } | Arrangement::Cut { sizes, .. } = &mut self.arrangement {
            *sizes = sizes.clone().widened(factor);
        }
        self
    }

    /// Whether stone sizes are drawn.
    pub fn draws_sizes(&self) -> bool {
        matches!(self.arrangement, Arrangement::Coursed { .. } | Arrangement::Cut { .. })
    }

    /// True when nothing is drawn, so that every wall of this layout is the same.
    pub fn is_fixed(&self) -> bool {
        let bond = !self.draws_sizes();
        let headers_drawn =
            self.wythes.count > 1 && self.wythes.header_share > 0.0 && self.wythes.header_share < 1.0;
        let unseen_drawn =
            matches!(&self.arrangement, Arrangement::File { unseen: Some(unseen), .. } if !unseen.is_fixed());
        let wedges_drawn = self.wedges.as_ref().is_some_and(|wedges| wedges.share > 0.0);
        bond && !headers_drawn && !wedges_drawn && !unseen_drawn && self.density.sd() == 0.0
    }
}

/// A wall with trapezoidal section, straight along x, its base in the plane z = 0, centred on y = 0 at the base.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outline {
    /// Length along x (m); the wall spans x = 0 to length.
    pub length: f64,
    /// Height (m).
    pub height: f64,
    /// Thickness at the base (m), from y = -base/2 to y = base/2.
    pub base_thickness: f64,
    /// Thickness at the top (m).
    pub top_thickness: f64,
    /// Which face leans.
    pub battered_face: BatteredFace,
}

/// Which face of the trapezoidal section leans. Front is +y (downhill), back is -y (where the load presses).
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum BatteredFace {
    /// The front leans, the back is vertical.
    Front,
    /// The back leans, the front is vertical.
    Back,
    /// Both lean by half: a symmetric section.
    Both,
}

/// How the joints are arranged. Serialised for reports only, with units in the keys.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum Arrangement {
    /// Stack bond: head joints run through all courses.
    Continuous {
        /// Stone length (m); the last stone of a course takes what is left, and is merged into its neighbour when that
        /// is too short to be a stone.
        #[serde(rename = "length_m")]
        length: f64,
        /// Course height (m); the number of courses is rounded so that they fill the height.
        #[serde(rename = "height_m")]
        height: f64,
    },
    /// Running bond: every other course, from the second one, begins with a stone of `overlap` times the length.
    Discontinuous {
        /// Stone length (m).
        #[serde(rename = "length_m")]
        length: f64,
        /// Course height (m).
        #[serde(rename = "height_m")]
        height: f64,
        /// Shift of every other course as a share of the stone length, in (0, 1); 0.5 is a half bond.
        overlap: f64,
    },
    /// Courses with random heights, stone lengths and one bed dip per bed about the wall's long axis.
    ///
    /// Heights are drawn until they pass the wall's height, the last one left out when the sum is nearer without it,
    /// and scaled by one factor to fill it. Lengths are drawn until a course is full; the last stone takes what is
    /// left, and is merged into its neighbour when that is too short to be a stone. A bed is redrawn when it crosses
    /// the one below (or the top of the wall) inside the section, or comes closer to it than `min_size` at a face.
    ///
    /// Where lengths and heights come together from a survey, its stones are sorted by height into groups of like height, as many
    /// as the square root of their number. The height of a course is that of one stone, which is as likely as it is long; the
    /// lengths of the course are drawn from that stone's group. So each stone comes as often as any other, and long stones lie in
    /// the courses that stones of their height make; a stone's own height gives way to that of its course.
    Coursed {
        /// Stone lengths (m), drawn per stone, and course heights (m), drawn per course.
        #[serde(flatten)]
        sizes: Sizes,
        /// Factor on all lengths and heights of one wall, drawn once per wall (mean size varies between walls) and kept
        /// over its attempts.
        wall_size_factor: Family,
        /// Dip of a bed (rad), drawn once per bed.
        #[serde(rename = "dip_rad")]
        dip: Family,
        /// Head joints of neighbouring courses closer than this share of the mean stone length are redrawn; in [0, 0.5). Where
        /// courses differ by it, it is that of the course with the shorter stones.
        least_overlap: f64,
    },
    /// Recursive random joint planes, the analogue of 3DEC's random joint sets.
    ///
    /// A piece is cut across the size that exceeds its target more, n / 2 (rounded down) targets from its lower end
    /// when it holds n of them (rounded), until both sizes hold one. Bed planes dip, head planes are vertical and
    /// across the wall. A cut is redrawn when a bed crosses another one of the piece or comes closer to one than
    /// `min_size`, or when a part is no stone; after half the redraws it is tried across the other size, if that may
    /// be cut as well.
    Cut {
        /// Target stone lengths and heights (m), drawn per cut.
        #[serde(flatten)]
        sizes: Sizes,
        /// Factor on all lengths and heights of one wall, drawn once per wall.
        wall_size_factor: Family,
        /// Dip of a joint plane (rad), drawn once per cut and axis.
        #[serde(rename = "dip_rad")]
        dip: Family,
        /// About which axes bed planes dip.
        dip_about: DipAbout,
    },
    /// The stones of a file, each where the file says it is. Their densities keep their ratios: that of the layout is their mean.
    File {
        /// The file, as the study names it.
        file: String,
        /// SHA-256 of its bytes (hex).
        sha256: String,
        /// Its number of joints.
        joints: usize,
        /// Gap (m) up to which faces touch.
        #[serde(rename = "touch_tolerance_m")]
        touch: f64,
        /// Its stones, and behind them the fixed blocks that it stands on; without them it stands on a platform, the plane z = 0.
        #[serde(skip)]
        wall: Arc<Wall>,
        /// What is drawn behind the face that the file shows; without it every stone is as deep as the file says.
        #[serde(skip_serializing_if = "Option::is_none")]
        unseen: Option<Unseen>,
    },
}

impl Arrangement {
    /// Whether a file says where the stones are.
    pub fn is_file(&self) -> bool {
        matches!(self, Arrangement::File { .. })
    }
}

/// About which axis the bed planes of a `cut` wall dip.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum DipAbout {
    /// The wall's long axis (x): beds lean towards a face.
    LongAxis,
    /// The thickness axis (y): beds rise along the wall.
    ThicknessAxis,
    /// Both, independently.
    Both,
}

/// Stones through the thickness: vertical longitudinal joints divide it evenly at the height of each stone's centroid,
/// so that in a battered wall they step from course to course. Head joints run through all wythes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wythes {
    /// Number of wythes, at least 1.
    pub count: u32,
    /// Share of stones (per course position) that span all wythes, in [0, 1]; drawn per position.
    pub header_share: f64,
}

/// Wedge stones cut into bed joints from a face of the wall: each is cut off the underside of a stone and is as long
/// as that stone, a triangular prism with its thin edge inside the wall.
#[derive(Clone, Debug, PartialEq)]
pub struct Wedges {
    /// Share of stones above the ground that get a wedge, in [0, 1]; drawn per stone, as is the face (front or back
    /// alike where it shows on both).
    pub share: f64,
    /// Height of the wedge at the face, measured upwards (m), drawn per wedge.
    pub height: Family,
    /// Depth of the wedge into the wall, measured along y (m), drawn per wedge.
    pub depth: Family,
}

/// What a stone must at least be, and how often a member may try.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// Smallest width of a stone over its face normals (m); also the least distance of beds at a face, and what a wedge
    /// must leave of its stone's bed and face. Wedge stones themselves, with their sharp edge, are exempt.
    pub min_size: f64,
    /// Largest ratio of a stone's diameter to its smallest width; wedge stones are exempt.
    pub max_aspect: f64,
    /// Smallest volume of a wedge stone (m^3).
    pub min_volume: f64,
    /// Redraws of a bed, of the lengths of a course, or of a cut before the whole wall starts again; redraws of a wedge
    /// before its stone goes without.
    pub max_redraws: u32,
    /// Fresh starts of the whole wall before it is an invalid geometry.
    pub max_attempts: u32,
}
