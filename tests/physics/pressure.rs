//! The trapezoidal pressure against its resultant.

use approx::assert_relative_eq;
use pirca::generate::canonical;
use pirca::math::Vec3;
use pirca::protocol::{Lateral, back_loads};

#[test]
fn the_loads_add_up_to_the_trapezoid() {
    let wall = canonical::running_bond(4, 3);
    let (low, high) = wall.bounds();
    let lateral = Lateral { mean_pressure: 1000.0, base_over_top: 2.0, steps: 1, collapse_share: 0.5 };
    let loads = back_loads(&wall, &lateral);
    let force: f64 = loads.iter().map(|l| l.force.y).sum();
    let moment: f64 = loads.iter().map(|l| l.force.y * l.point.z).sum();
    // Open head joints of 1 mm carry no pressure: three in each of four courses, equal over the height.
    let length = high.x - low.x - 3.0 * canonical::HEAD_JOINT_GAP;
    let height = high.z;
    assert_relative_eq!(force, 1000.0 * length * height, max_relative = 1e-12);
    // Centroid of a trapezoid with 2:1 sides: 4/9 of the height.
    assert_relative_eq!(moment / force, 4.0 / 9.0 * height, max_relative = 1e-12);
    assert!(loads.iter().all(|l| l.point.y < 0.0));
}

#[test]
fn only_the_back_wythe_is_pressed() {
    let wall = canonical::running_bond(2, 2);
    let (low, high) = wall.bounds();
    let mut two = wall.clone();
    for block in &wall.blocks {
        let mut front = block.clone();
        front.shape = front.shape.translated(&Vec3::new(0.0, high.y - low.y, 0.0));
        two.blocks.push(front);
    }
    let lateral = Lateral { mean_pressure: 1000.0, base_over_top: 1.0, steps: 1, collapse_share: 0.5 };
    assert_eq!(back_loads(&two, &lateral), back_loads(&wall, &lateral));
}
