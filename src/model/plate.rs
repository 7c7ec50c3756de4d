//! A wall seen from afar: a plate, with its stresses, its strains and what they are at a point of it.
//!
//! The plate lies in the plane y = 0; 1 is along x (along the wall), 2 along z (up). Its stresses are the membrane stresses `N` per
//! length (N/m, tension positive) and the moments `M` per length (N), the integrals over the thickness of the stress and of `-y` times
//! the stress. Its strains are `E` and the curvature `K = grad grad w` of the displacement `w` along y. Both are kept in the
//! order `(11, 22, 12)`, membrane first, with `2 E12` and `2 K12`: so the sum of products is the work per area.

use crate::math::Vec3;

/// Stresses `(N11, N22, N12, M11, M22, M12)` or strains `(E11, E22, 2 E12, K11, K22, 2 K12)` of a plate.
pub type Six = [f64; 6];

/// Motion of a point of the image at the translation `shift`, past that of the stone itself, by each unit strain: rows x, y, z.
///
/// `at` (m) is the point of the image. In the plane it is `E s - y K s`, out of it `(x - s/2) . K s`, which is the motion of a
/// rigid body: a periodic arrangement of rigid stones can follow any strain (Sab 2003).
pub fn image_motion(shift: Vec3, at: Vec3) -> [Six; 3] {
    let (s, y, middle) = (shift, at.y, at - shift * 0.5);
    [
        [s.x, 0.0, 0.5 * s.z, -y * s.x, 0.0, -0.5 * y * s.z],
        [0.0, 0.0, 0.0, middle.x * s.x, middle.z * s.z, 0.5 * (middle.x * s.z + middle.z * s.x)],
        [0.0, s.z, 0.5 * s.x, 0.0, -y * s.z, -0.5 * y * s.x],
    ]
}

/// Turn of the image at the translation `shift`, past that of the stone itself, by each unit strain: rows x, y, z. It is that of
/// [`image_motion`], and nothing about the y axis.
pub fn image_turn(shift: Vec3) -> [Six; 3] {
    let s = shift;
    [[0.0, 0.0, 0.0, 0.0, -s.z, -0.5 * s.x], [0.0; 6], [0.0, 0.0, 0.0, s.x, 0.0, 0.5 * s.z]]
}

/// Motion of a point of a plate that is strained uniformly, by each unit strain: `E x - y K x` in the plane, `x . K x / 2` out of
/// it. That of an image is the difference between two points.
pub fn plate_motion(at: Vec3) -> [Six; 3] {
    let (x, y, z) = (at.x, at.y, at.z);
    [
        [x, 0.0, 0.5 * z, -y * x, 0.0, -0.5 * y * z],
        [0.0, 0.0, 0.0, 0.5 * x * x, 0.5 * z * z, 0.5 * x * z],
        [0.0, z, 0.5 * x, 0.0, -y * z, -0.5 * y * x],
    ]
}

/// Traction (Pa) on a face with the outward `normal` by each unit stress of a plate of this `thickness` (m): constant and linear over
/// it. Without body forces it is in equilibrium on every closed body.
pub fn plate_traction(thickness: f64, at: Vec3, normal: Vec3) -> [Six; 3] {
    let membrane = 1.0 / thickness;
    let bending = -12.0 * at.y / (thickness * thickness * thickness);
    let along = |a: f64, b: f64, c: f64| {
        [a * membrane, b * membrane, c * membrane, a * bending, b * bending, c * bending]
    };
    [along(normal.x, 0.0, normal.z), [0.0; 6], along(0.0, normal.z, normal.x)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_image_moves_as_a_plate_that_is_strained_does() {
        let (shift, at) = (Vec3::new(0.7, 0.0, -0.3), Vec3::new(0.2, 0.05, 0.9));
        let (here, there) = (plate_motion(at - shift), plate_motion(at));
        for (row, image) in image_motion(shift, at).iter().enumerate() {
            for (k, motion) in image.iter().enumerate() {
                // Differences of numbers near 1.
                assert!((there[row][k] - here[row][k] - motion).abs() < 1e-15, "{row} {k}");
            }
        }
    }

    #[test]
    fn an_image_moves_as_a_rigid_body() {
        let (shift, at, way) =
            (Vec3::new(0.7, 0.0, -0.3), Vec3::new(0.2, 0.05, 0.9), Vec3::new(0.3, -0.2, 0.4));
        let (here, there, turn) = (image_motion(shift, at), image_motion(shift, at + way), image_turn(shift));
        for k in 0..6 {
            let turned = Vec3::new(turn[0][k], turn[1][k], turn[2][k]).cross(&way);
            for row in 0..3 {
                // Differences of numbers near 1.
                assert!((there[row][k] - here[row][k] - turned[row]).abs() < 1e-15, "{row} {k}");
            }
        }
    }

    #[test]
    fn the_work_of_the_tractions_on_a_plate_is_that_of_its_stresses() {
        // A box of 2 x 0.3 x 1 m, its faces in 3 x 3 Gauss points: exact for the cubics that appear.
        let (size, root) = (Vec3::new(2.0, 0.3, 1.0), 0.6_f64.sqrt());
        let gauss = [(-root, 5.0 / 9.0), (0.0, 8.0 / 9.0), (root, 5.0 / 9.0)];
        let mut work = [[0.0; 6]; 6];
        for (axis, side) in [(0, 1.0), (0, -1.0), (2, 1.0), (2, -1.0)] {
            for (u, wu) in gauss {
                for (v, wv) in gauss {
                    let mut at = size * 0.5;
                    let other = 2 - axis;
                    at[axis] *= side;
                    at[other] *= u;
                    at.y *= v;
                    let mut normal = Vec3::zeros();
                    normal[axis] = side;
                    let area = 0.25 * size[other] * size.y * wu * wv;
                    let (traction, motion) = (plate_traction(size.y, at, normal), plate_motion(at));
                    for (i, row) in work.iter_mut().enumerate() {
                        for (j, sum) in row.iter_mut().enumerate() {
                            *sum += (0..3).map(|k| traction[k][i] * motion[k][j]).sum::<f64>() * area;
                        }
                    }
                }
            }
        }
        for (i, row) in work.iter().enumerate() {
            for (j, work) in row.iter().enumerate() {
                let area = if i == j { size.x * size.z } else { 0.0 };
                assert!((work - area).abs() < 1e-13, "stress {i} on strain {j}: {work}");
            }
        }
    }
}
