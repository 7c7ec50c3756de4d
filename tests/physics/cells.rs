//! Cells of equal courses, with head joints where a test wants them.

use pirca::law::Coulomb;
use pirca::math::Vec3;
use pirca::model::{Cell, JointLaws};
use pirca::random::Streams;
use pirca::shape::Polyhedron;

use crate::fixture::stone;

/// A cell of `columns` by `courses` stones in half bond.
#[derive(Clone, Copy, Debug)]
pub struct Bond {
    /// Length along x, height and thickness of a stone (m).
    pub stone: [f64; 3],
    pub columns: usize,
    pub courses: usize,
    /// Width of the open slot in head joints (m).
    pub slot: f64,
}

impl Bond {
    /// Stones of `length` by `height` by `thickness`, without slots.
    pub fn of(stone: [f64; 3], columns: usize, courses: usize) -> Bond {
        Bond { stone, columns, courses, slot: 0.0 }
    }

    /// The cell with every head joint shifted by `shift(column, course)` (m).
    pub fn cell(&self, shift: impl Fn(usize, usize) -> f64) -> Cell {
        let [length, height, thickness] = self.stone;
        let head = |column: usize, course: usize| {
            let begin = if course % 2 == 1 { 0.5 * length } else { 0.0 };
            begin + length * column as f64 + shift(column % self.columns, course)
        };
        let block = |(column, course): (usize, usize)| {
            let bed = height * course as f64;
            let low = Vec3::new(head(column, course) + 0.5 * self.slot, -0.5 * thickness, bed);
            let high = Vec3::new(head(column + 1, course) - 0.5 * self.slot, 0.5 * thickness, bed + height);
            stone(Polyhedron::cuboid(low, high), 2000.0)
        };
        let places =
            (0..self.courses).flat_map(|course| (0..self.columns).map(move |column| (column, course)));
        let slant = if self.courses % 2 == 1 { 0.5 * length } else { 0.0 };
        Cell {
            blocks: places.map(block).collect(),
            lattice: [[length * self.columns as f64, 0.0], [slant, height * self.courses as f64]],
            thickness,
        }
    }

    /// The cell with head joints shifted at random by up to `most` of the stones' length.
    pub fn shifted(&self, most: f64, member: u64) -> Cell {
        let streams = Streams::new(1, member);
        self.cell(|column, course| {
            let uniform = streams.of(&format!("head joint {course}/{column}")).uniform();
            most * self.stone[0] * (2.0 * uniform - 1.0)
        })
    }
}

/// One law for head joints, one for beds, told apart by the courses of the stones; for cells of two courses or more.
pub struct HeadAndBed {
    pub columns: usize,
    pub head: Coulomb,
    pub bed: Coulomb,
}

impl JointLaws for HeadAndBed {
    fn of(&self, a: u32, b: u32) -> Coulomb {
        let course = |block: u32| block as usize / self.columns;
        if course(a) == course(b) { self.head } else { self.bed }
    }
}
