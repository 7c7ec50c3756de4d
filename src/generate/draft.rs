//! One attempt at a wall: where its random numbers come from, what it counts, and how it can fail.

use std::fmt::Display;

use crate::generate::outline::StoneFault;
use crate::generate::{Layout, Realised};
use crate::math::Vec3;
use crate::model::Tag;
use crate::random::{Family, Stream, Streams};
use crate::shape::{Plane, Polyhedron};

/// Vertices this close to a cutting plane count as lying on it (m): far above round-off in metres, far below any
/// stone.
pub(crate) const CUT_TOLERANCE: f64 = 1e-9;

/// A piece that has become a stone, before its density is drawn.
#[derive(Clone, Debug)]
pub(crate) struct Stone {
    pub(crate) shape: Polyhedron,
    pub(crate) tag: Tag,
    /// Where it sits: the key of the streams that belong to it alone.
    pub(crate) place: Place,
    /// Whether it shows on the back and on the front face of the wall.
    pub(crate) shows: [bool; 2],
}

/// A stone's place: course and position in it (in a cut wall 0 and the number of the cut), and the wythe.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Place {
    pub(crate) course: u32,
    pub(crate) position: u64,
    pub(crate) wythe: u32,
}

impl Display for Place {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}/{}/{}", self.course, self.position, self.wythe)
    }
}

/// What is built: it decides what lies at the border.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Extent {
    /// A wall: it stands on the ground, and its ends are closed faces.
    Wall,
    /// A cell of a tiling: its ends are head joints like all others, and under its lowest course lies another cell.
    Cell,
}

/// What went wrong in one attempt.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub(crate) enum Fault {
    #[error("the outline has no volume")]
    NoOutline,
    #[error("no draw of the {quantity} could be used in {draws} draws")]
    NoDraw { quantity: &'static str, draws: u32 },
    #[error(
        "bed {bed} crosses its neighbour or comes closer than {limit} m to it at a face in {draws} draws"
    )]
    BedsCross { bed: usize, limit: f64, draws: u32 },
    #[error("course {course}: {fault}")]
    Course { course: u32, fault: CourseFault },
    #[error("joint plane {node} cannot be placed in {draws} draws: {fault}")]
    Cut { node: u64, draws: u32, fault: CutFault },
    #[error("more than {limit} stones")]
    TooMany { limit: usize },
}

impl Fault {
    /// Whether another attempt would end the same way.
    pub(crate) fn is_final(&self) -> bool {
        matches!(self, Fault::NoOutline | Fault::TooMany { .. })
    }
}

/// Why a course could not be filled.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub(crate) enum CourseFault {
    #[error(transparent)]
    Stone(#[from] StoneFault),
    #[error("a head joint lies closer than {clear:.4} m to one of the course below")]
    Overlap { clear: f64 },
    #[error("a head joint lies closer than {clear:.4} m to one of the first course of the next cell")]
    OverlapAcross { clear: f64 },
    #[error("a stone length is not positive")]
    NotPositive,
}

/// Why a joint plane could not be placed.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub(crate) enum CutFault {
    #[error(transparent)]
    Stone(#[from] StoneFault),
    #[error("it crosses another bed or comes closer than {limit} m to one")]
    Crosses { limit: f64 },
}

/// What is counted over all attempts.
#[derive(Clone, Debug, Default)]
pub(crate) struct Tally {
    pub(crate) redraws: u32,
    pub(crate) first_dips: Vec<f64>,
    pub(crate) first_lengths: Vec<f64>,
    pub(crate) first_heights: Vec<f64>,
}

/// One attempt.
pub(crate) struct Draft<'a> {
    pub(crate) layout: &'a Layout,
    pub(crate) extent: Extent,
    streams: &'a Streams,
    attempt: u32,
    pub(crate) tally: &'a mut Tally,
    pub(crate) realised: Realised,
    pub(crate) merges: u32,
    /// Volume of the open slots cut out so far (m^3).
    pub(crate) gaps: f64,
}

impl<'a> Draft<'a> {
    pub(crate) fn new(
        layout: &'a Layout,
        extent: Extent,
        streams: &'a Streams,
        attempt: u32,
        tally: &'a mut Tally,
    ) -> Self {
        Draft { layout, extent, streams, attempt, tally, realised: Realised::default(), merges: 0, gaps: 0.0 }
    }

    /// The stream of a quantity at a place. A redraw continues it; a fresh start of the whole wall has its own.
    pub(crate) fn stream(&self, quantity: &str, place: impl Display) -> Stream {
        match self.attempt {
            1 => self.streams.of(&format!("{quantity} {place}")),
            attempt => self.streams.of(&format!("{quantity} {place} attempt {attempt}")),
        }
    }

    /// The stream of a quantity that belongs to the member as a whole: the same in every attempt.
    pub(crate) fn member_stream(&self, quantity: &str) -> Stream {
        self.streams.of(quantity)
    }

    /// One draw that must be finite and at least `least`; others are redrawn and counted.
    pub(crate) fn draw(
        &mut self,
        quantity: &'static str,
        family: &Family,
        factor: f64,
        least: f64,
        stream: &mut Stream,
    ) -> Result<f64, Fault> {
        self.draw_several(quantity, least, || [factor * family.sample(stream)]).map(|[value]| value)
    }

    /// Values that are drawn together, each finite and at least `least`; others are redrawn and counted.
    pub(crate) fn draw_several<const N: usize>(
        &mut self,
        quantity: &'static str,
        least: f64,
        mut sample: impl FnMut() -> [f64; N],
    ) -> Result<[f64; N], Fault> {
        let draws = self.layout.limits.max_redraws + 1;
        for _ in 0..draws {
            let values = sample();
            if values.iter().all(|value| value.is_finite() && *value >= least && *value > 0.0) {
                return Ok(values);
            }
            self.tally.redraws += 1;
        }
        Err(Fault::NoDraw { quantity, draws })
    }

    /// Makes stones of a piece: cuts it into wythes unless it is a header, and checks every part.
    ///
    /// The longitudinal joints are vertical planes that divide the wall's thickness at the height of the piece's
    /// centroid evenly; in a battered wall they step from course to course.
    pub(crate) fn dress(
        &self,
        piece: Polyhedron,
        header: bool,
        course: u32,
        position: u64,
    ) -> Result<Vec<Stone>, StoneFault> {
        let count = self.layout.wythes.count.max(1);
        let place = |wythe| Place { course, position, wythe };
        if header || count == 1 {
            self.layout.limits.check(&piece)?;
            let tag = if header { Tag::Header } else { Tag::Stone };
            return Ok(vec![Stone { shape: piece, tag, place: place(0), shows: [true, true] }]);
        }
        let [back, front] = self.layout.outline.faces_at(piece.mass_properties().centroid.z);
        let mut stones = Vec::with_capacity(count as usize);
        let mut rest = Some(piece);
        for wythe in 0..count {
            let y = back + (front - back) * f64::from(wythe + 1) / f64::from(count);
            let part = match rest.take() {
                Some(solid) if wythe + 1 < count => {
                    let (part, further) = solid.cut(&Plane { normal: Vec3::y(), offset: y }, CUT_TOLERANCE);
                    rest = further;
                    part
                }
                last => last,
            };
            let shape = part.ok_or(StoneFault::Vanished)?;
            self.layout.limits.check(&shape)?;
            let shows = [wythe == 0, wythe + 1 == count];
            stones.push(Stone { shape, tag: Tag::Stone, place: place(wythe), shows });
        }
        Ok(stones)
    }

    /// Whether the stone at the stream's next position is a header; a draw is made in one-wythe walls as well.
    pub(crate) fn is_header(&self, stream: &mut Stream) -> bool {
        stream.uniform() < self.layout.wythes.header_share && self.layout.wythes.count > 1
    }
}
