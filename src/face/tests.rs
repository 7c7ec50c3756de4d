//! Faces whose stones are known.

use super::*;
use crate::shape::bounds;

fn outline(name: &str, points: &[[f64; 2]]) -> Outline {
    Outline { name: name.to_owned(), line: 0, part: Part::Stone, points: points.to_vec() }
}

fn rectangle(name: &str, [x, z, length, height]: [f64; 4]) -> Outline {
    outline(name, &[[x, z], [x + length, z], [x + length, z + height], [x, z + height]])
}

#[test]
fn a_gap_is_given_to_both_of_its_stones() {
    // Two stones with a joint of 20 mm between them, and one on both with a bed of 10 mm.
    let drawn = [
        rectangle("a", [0.0, 0.0, 0.49, 0.2]),
        rectangle("b", [0.51, 0.0, 0.49, 0.2]),
        rectangle("c", [0.1, 0.21, 0.8, 0.19]),
    ];
    let face = Face::of(&drawn, &Closing { widest: 0.025, grain: 0.0 }).unwrap();
    let bounds: Vec<[f64; 4]> = face.polygons.iter().map(|own| bounds(&own.vertices)).collect();
    let wanted = [[0.0, 0.0, 0.5, 0.205], [0.5, 0.0, 1.0, 0.205], [0.1, 0.205, 0.9, 0.4]];
    for (found, wanted) in bounds.iter().zip(wanted) {
        for (a, b) in found.iter().zip(wanted) {
            assert!((a - b).abs() < 1e-9, "{found:?} {wanted:?}");
        }
    }
    let joints: Vec<(usize, usize)> = face.joints.iter().map(|own| own.stones).collect();
    assert_eq!(joints, [(0, 1), (0, 2), (1, 2)]);
    // Points stand in the middle of steps of 2.5 mm.
    for (joint, (gap, length)) in face.joints.iter().zip([(0.02, 0.2), (0.01, 0.39), (0.01, 0.39)]) {
        let [mean, largest] = joint.widths;
        // At its ends the nearest point of the other outline lies aslant.
        assert!((mean - gap).abs() < 1e-3 && largest >= gap - 1e-9 && largest < 2.0 * gap, "{joint:?}");
        assert!((joint.length - length).abs() < 0.02, "{joint:?}");
    }
    assert_eq!(face.standing, vec![0, 1]);
}

#[test]
fn what_cannot_be_a_stone_is_told() {
    let closing = Closing { widest: 0.01, grain: 0.0 };
    let stone = rectangle("stone", [0.0, 0.0, 0.5, 0.2]);
    let twice = [stone.clone(), rectangle("again", [0.01, 0.01, 0.48, 0.18])];
    assert!(
        matches!(Face::of(&twice, &closing), Err(found) if matches!(found[..], [Trouble::Covered { outline: 1, by: 0, .. }]))
    );
    let crossed = [outline("crossed", &[[0.0, 0.0], [0.5, 0.2], [0.5, 0.0], [0.0, 0.2]])];
    assert!(
        matches!(Face::of(&crossed, &closing), Err(found) if matches!(found[..], [Trouble::Crosses { outline: 0, .. }]))
    );
    let flat = [outline("flat", &[[0.0, 0.0], [0.5, 0.0], [1.0, 0.0]])];
    assert!(
        matches!(Face::of(&flat, &closing), Err(found) if matches!(found[..], [Trouble::Empty { outline: 0 }]))
    );
    // A stone in the notch of a concave one is none that is there twice.
    let notch = outline(
        "notch",
        &[[0.0, 0.0], [1.0, 0.0], [1.0, 0.4], [0.8, 0.4], [0.8, 0.2], [0.2, 0.2], [0.2, 0.4], [0.0, 0.4]],
    );
    assert!(Face::of(&[notch, rectangle("in it", [0.2, 0.2, 0.6, 0.2])], &closing).is_ok());
}

#[test]
fn a_stone_that_meets_nothing_is_told_with_its_gap() {
    let drawn = [rectangle("low", [0.0, 0.0, 0.5, 0.2]), rectangle("high", [0.0, 0.23, 0.5, 0.2])];
    let face = Face::of(&drawn, &Closing { widest: 0.02, grain: 0.0 }).unwrap();
    assert_eq!(face.alone.len(), 1);
    let (stone, gap) = face.alone[0];
    assert!(stone == 1 && (gap.unwrap() - 0.03).abs() < 1e-9, "{gap:?}");
}
