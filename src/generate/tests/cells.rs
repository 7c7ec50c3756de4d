//! Cells tile the plate: nothing overlaps and nothing is missing, within the cell and across the period.

use approx::assert_relative_eq;

use super::*;
use crate::generate::{CellFault, GeneratedCell, generate_cell};
use crate::math::Vec3;
use crate::model::{Block, Cell, Tag};
use crate::shape::overlap_depth;

/// Faces may be off their plane by the cut tolerance, 1e-9 m, at a few vertices.
const PLANE: f64 = 1e-8;

fn plate(mut layout: Layout) -> Layout {
    layout.outline.top_thickness = layout.outline.base_thickness;
    layout
}

fn stack() -> Layout {
    layout(Arrangement::Continuous { length: 0.4, height: 0.2 })
}

fn bond(overlap: f64) -> Layout {
    plate(layout(Arrangement::Discontinuous { length: 0.4, height: 0.2, overlap }))
}

fn closed(layout: Layout) -> Layout {
    Layout { head_joint_gap: 0.0, ..plate(layout) }
}

fn cell_of(layout: &Layout, stones: [u32; 2], number: u64) -> GeneratedCell {
    generate_cell(layout, stones, &Streams::new(7, number)).unwrap_or_else(|e| panic!("cell {number}: {e}"))
}

/// Every block as it is in the cells around.
fn tiles(cell: &Cell) -> impl Iterator<Item = (Vec3, &Block)> {
    let shifts = (-2..=2).flat_map(|p| (-2..=2).map(move |q| (p, q)));
    shifts.flat_map(move |(p, q)| cell.blocks.iter().map(move |block| (cell.shift(p, q), block)))
}

fn check_tiling(layout: &Layout, stones: [u32; 2], cells: u64) {
    for number in 0..cells {
        let made = cell_of(layout, stones, number);
        check_stones(layout, &made);
        check_fit(&made.cell);
        if layout.head_joint_gap == 0.0 {
            assert_relative_eq!(made.cell.solid_share(), 1.0, max_relative = 1e-9);
            check_points(&made.cell, number);
        }
    }
}

fn check_stones(layout: &Layout, made: &GeneratedCell) {
    let thickness = layout.outline.base_thickness;
    assert_eq!(made.cell.thickness, thickness);
    for (id, block) in made.cell.blocks.iter().enumerate() {
        block.shape.validate(PLANE).unwrap_or_else(|e| panic!("block {id}: {e}"));
        let (low, high) = block.shape.bounds();
        assert!(low.y >= -0.5 * thickness - PLANE && high.y <= 0.5 * thickness + PLANE);
        let middle = 0.5 * (low.x + high.x);
        assert!(
            (-PLANE..made.cell.lattice[0][0]).contains(&middle),
            "block {id} is in another cell: {middle}"
        );
        if block.tag != Tag::Wedge {
            assert!(block.shape.smallest_width() >= layout.limits.min_size, "block {id} is thin");
        }
    }
    // Every stone has half a slot at either end; round-off of some hundred cuts.
    let volume: f64 = made.cell.blocks.iter().map(|block| block.shape.volume()).sum();
    assert_relative_eq!(volume, made.realised.volume, max_relative = 1e-9);
}

/// No stone overlaps one of its own cell or of the cells around, by separating axes.
fn check_fit(cell: &Cell) {
    for (id, block) in cell.blocks.iter().enumerate() {
        let (low, high) = block.shape.bounds();
        for (shift, other) in tiles(cell) {
            let (other_low, other_high) = other.shape.bounds();
            let (other_low, other_high) = (other_low + shift, other_high + shift);
            let is_itself = std::ptr::eq(block, other) && shift == Vec3::zeros();
            let near = (0..3).all(|k| low[k] < other_high[k] && other_low[k] < high[k]);
            if near && !is_itself {
                let depth = overlap_depth(&block.shape, &other.shape.translated(&shift), PLANE);
                assert_eq!(depth, None, "block {id} overlaps one shifted by {shift}");
            }
        }
    }
}

/// Every point of the cell lies in exactly one stone of the tiling.
fn check_points(cell: &Cell, number: u64) {
    let mut stream = Streams::new(11, number).of("points");
    for _ in 0..2000 {
        let [a, b, c] = [0; 3].map(|_| stream.uniform());
        let point = cell.shift(1, 0) * a + cell.shift(0, 1) * b + Vec3::y() * ((c - 0.5) * cell.thickness);
        let holds = |(shift, block): &(Vec3, &Block)| {
            let at = point - shift;
            (0..block.shape.faces.len()).all(|face| block.shape.face_plane(face).distance(&at) <= 0.0)
        };
        assert_eq!(tiles(cell).filter(holds).count(), 1, "at {point}");
    }
}

#[test]
fn one_stone_is_a_cell_of_a_running_bond() {
    let made = cell_of(&closed(bond(0.3)), [1, 1], 0);
    assert_eq!(made.cell.lattice, [[0.4, 0.0], [0.3 * 0.4, 0.2]]);
    assert_eq!(made.cell.blocks.len(), 1);
    let (low, high) = made.cell.blocks[0].shape.bounds();
    assert_eq!((low, high), (Vec3::new(0.0, -0.225, 0.0), Vec3::new(0.4, 0.225, 0.2)));
    check_tiling(&closed(bond(0.3)), [1, 1], 1);
}

#[test]
fn odd_courses_are_shifted_by_the_lattice_and_even_ones_are_not() {
    let shift = |overlap, courses| cell_of(&bond(overlap), [3, courses], 0).cell.lattice[1][0];
    assert_eq!((shift(0.3, 2), shift(0.3, 4)), (0.0, 0.0));
    assert_relative_eq!(shift(0.5, 3), 0.5 * 0.4);
    // Raking: three shifts by 0.3 are one by 0.9.
    assert_relative_eq!(shift(0.3, 3), 0.9 * 0.4);
    let begins = |overlap, courses: u32| -> Vec<f64> {
        let cell = cell_of(&closed(bond(overlap)), [3, courses], 0).cell;
        (0..courses as usize).map(|course| cell.blocks[3 * course].shape.bounds().0.x).collect()
    };
    assert_relative_eq!(begins(0.3, 4)[..], [0.0, 0.12, 0.0, 0.12][..], max_relative = 1e-12);
    assert_relative_eq!(begins(0.3, 3)[..], [0.0, 0.12, 0.24][..], max_relative = 1e-12);
}

#[test]
fn bonds_tile_the_plate() {
    check_tiling(&closed(stack()), [3, 2], 1);
    for (overlap, courses) in [(0.5, 1), (0.3, 2), (0.3, 3), (0.25, 4)] {
        check_tiling(&closed(bond(overlap)), [3, courses], 1);
        check_tiling(&with_wedges(two_wythes(closed(bond(overlap)))), [3, courses], 4);
    }
}

#[test]
fn every_head_joint_of_a_cell_has_its_gap() {
    for (asked, stones) in [(plate(stack()), [1, 1]), (bond(0.5), [1, 1]), (bond(0.5), [3, 2])] {
        let made = cell_of(&asked, stones, 0);
        assert_relative_eq!(made.cell.solid_share(), 1.0 - 0.001 / 0.4, max_relative = 1e-12);
        check_tiling(&asked, stones, 1);
    }
    // As many slots as stones, each as high as its course.
    let mut asked = plate(coursed());
    let Arrangement::Coursed { dip, sizes: Sizes::Apart { height, .. }, .. } = &mut asked.arrangement else {
        unreachable!()
    };
    (*dip, *height) = (Family::Constant { value: 0.0 }, Family::Constant { value: 0.2 });
    let made = cell_of(&asked, [5, 4], 0);
    let slots = 0.001 * made.cell.blocks.len() as f64 * made.cell.lattice[1][1] / 4.0;
    assert_relative_eq!(made.cell.solid_share(), 1.0 - slots / made.cell.area(), max_relative = 1e-12);
}

#[test]
fn random_courses_tile_the_plate() {
    check_tiling(&closed(coursed()), [4, 3], 12);
    check_tiling(&closed(coursed()), [3, 2], 12);
    check_tiling(&plate(coursed()), [5, 4], 12);
    check_tiling(&with_wedges(two_wythes(closed(coursed()))), [4, 4], 12);
}

#[test]
fn cuts_tile_the_plate() {
    for about in [DipAbout::LongAxis, DipAbout::ThicknessAxis, DipAbout::Both] {
        check_tiling(&closed(cut(about)), [5, 5], 4);
        check_tiling(&with_wedges(two_wythes(plate(cut(about)))), [5, 5], 4);
    }
    let [[length, _], [shift, height]] = cell_of(&plate(cut(DipAbout::Both)), [5, 6], 0).cell.lattice;
    assert_eq!(shift, 0.5 * length);
    assert_relative_eq!(height / length, 6.0 * 0.2 / (5.0 * 0.4), max_relative = 1e-12);
}

#[test]
fn a_cell_has_the_size_of_its_stones_whatever_the_outline() {
    let mut asked = closed(coursed());
    let made = cell_of(&asked, [4, 6], 3);
    let factor = made.realised.size_factor;
    assert!((factor - 1.0).abs() > 0.01, "a factor of 1 would hide one left out");
    assert_relative_eq!(made.cell.lattice[0][0], factor * 4.0 * 0.4, max_relative = 1e-12);
    assert_relative_eq!(made.cell.lattice[1][1], factor * 6.0 * 0.2, max_relative = 1e-12);
    assert_eq!((made.realised.heights.len(), made.realised.dips.len()), (6, 6));
    (asked.outline.length, asked.outline.height) = (1.0, 9.0);
    assert_eq!(cell_of(&asked, [4, 6], 3), made);
}

#[test]
fn the_lowest_bed_is_the_highest_one_too() {
    let made = cell_of(&closed(coursed()), [4, 3], 1);
    let cell = &made.cell;
    let bed = |block: &Block, up: f64| {
        let faces = (0..block.shape.faces.len()).map(|face| block.shape.face_plane(face));
        faces.into_iter().find(|plane| plane.normal.z * up > 0.5).expect("a bed")
    };
    let (first, last) = (bed(&cell.blocks[0], -1.0), bed(&cell.blocks[cell.blocks.len() - 1], 1.0));
    assert!((first.normal.y / first.normal.z).abs() > 0.01, "a level bed would hide a dip left out");
    assert_relative_eq!(first.normal, -last.normal, epsilon = 1e-9);
    let point = Vec3::new(0.0, 0.1, -first.offset / first.normal.z);
    assert_relative_eq!(last.distance(&(point + cell.shift(0, 1))), -first.distance(&point), epsilon = 1e-9);
}

#[test]
fn stones_of_the_lowest_course_get_wedges_too() {
    let mut asked = with_wedges(closed(bond(0.5)));
    asked.wedges.as_mut().expect("wedges").share = 1.0;
    assert_eq!(cell_of(&asked, [3, 1], 0).realised.wedges, 3);
    let cell = cell_of(&asked, [3, 1], 0).cell;
    assert_eq!(cell.blocks.iter().filter(|block| block.tag == Tag::Wedge).count(), 3);
    check_tiling(&asked, [3, 1], 1);
}

/// Where the head joints of the courses are, in [0, length).
fn joints(cell: &Cell) -> Vec<Vec<f64>> {
    let length = cell.lattice[0][0];
    let (mut courses, mut filled) = (vec![Vec::new()], 0.0);
    for block in &cell.blocks {
        if filled > length - 1e-6 {
            courses.push(Vec::new());
            filled = 0.0;
        }
        let (low, high) = block.shape.bounds();
        filled += high.x - low.x;
        courses.last_mut().expect("one").push(low.x.rem_euclid(length));
    }
    courses
}

#[test]
fn head_joints_keep_their_overlap_across_the_period() {
    let (mut least, mut begins) = (f64::INFINITY, Vec::new());
    for (number, stones) in (0..40).flat_map(|number| [(number, [4, 2]), (number, [5, 3]), (number, [4, 4])])
    {
        let made = cell_of(&closed(coursed()), stones, number);
        let (courses, length) = (joints(&made.cell), made.cell.lattice[0][0]);
        assert_eq!(courses.len(), stones[1] as usize);
        for (index, course) in courses.iter().enumerate() {
            begins.push(course[0] / length);
            for (a, b) in
                course.iter().flat_map(|a| courses[(index + 1) % courses.len()].iter().map(move |b| (a, b)))
            {
                let apart = (a - b).rem_euclid(length);
                least = least.min(apart.min(length - apart) / (0.4 * made.realised.size_factor));
            }
        }
    }
    // The mean length is 0.4 m; joints are faces of stones, which round-off moves by 1e-16 m.
    assert!((0.15 - 1e-12..0.16).contains(&least), "{least} mean lengths apart");
    // The first two tenths hold a fifth of the beginnings, 360 in number, within four standard errors.
    let early = begins.iter().filter(|begin| **begin < 0.2).count() as f64 / begins.len() as f64;
    assert!((early - 0.2).abs() < 4.0 * (0.16 / begins.len() as f64).sqrt(), "{early} begin early");
}

#[test]
fn a_cell_is_a_function_of_seed_and_member() {
    for asked in [closed(coursed()), plate(with_wedges(two_wythes(cut(DipAbout::Both))))] {
        let made = |seed, number| {
            generate_cell(&asked, [4, 4], &Streams::new(seed, number)).expect("a cell").cell.blocks
        };
        assert_eq!(made(7, 5), made(7, 5));
        assert_ne!(made(7, 5), made(7, 6));
        assert_ne!(made(7, 5), made(8, 5));
    }
}

#[test]
fn what_can_be_no_cell_is_refused_in_words() {
    let fault = |layout: &Layout, stones| {
        generate_cell(layout, stones, &Streams::new(1, 0)).expect_err("no cell").to_string()
    };
    assert_eq!(
        fault(&bond(0.5), [0, 2]),
        "a cell of 0 stones along the wall in 2 courses has none: give at least 1 stone and 1 course"
    );
    assert_eq!(
        fault(&coursed(), [4, 4]),
        "the wall is 0.45 m thick at its base and 0.25 m at its top, but cells tile a plate of one thickness: give both the \
         same"
    );
    assert_eq!(
        fault(&bond(1.0), [1, 1]),
        "a running bond that shifts its courses by 1 stone lengths is none: give an overlap above 0 and below 1, such as \
         0.5, or take a stack bond"
    );
    let mut apart = plate(coursed());
    let Arrangement::Coursed { least_overlap, .. } = &mut apart.arrangement else { unreachable!() };
    *least_overlap = 0.4;
    assert_eq!(
        fault(&apart, [4, 3]),
        "head joints of neighbouring courses are to keep 0.4 stone lengths apart, but in a cell of 3 courses, the last of \
         which lies under the first one of the next cell, they can keep 0.333 at most: take an even number of courses, more \
         of them, or a lower least overlap"
    );
    assert!(matches!(
        generate_cell(&plate(coursed()), [4, 1], &Streams::new(1, 0)),
        Err(CellFault::NoRoom { courses: 1, .. })
    ));
    assert_eq!(fault(&bond(0.5), [300, 100]), "more than 20000 stones (1 attempts, 0 redraws)");
    let mut flat = bond(0.5);
    (flat.outline.base_thickness, flat.outline.top_thickness) = (0.0, 0.0);
    assert_eq!(fault(&flat, [2, 2]), "the outline has no volume (1 attempts, 0 redraws)");
    let mut open = plate(cut(DipAbout::Both));
    open.head_joint_gap = 9.0;
    assert!(fault(&open, [2, 2]).contains("nothing is left of a stone between its head joints"));
}
