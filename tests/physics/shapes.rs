//! Properties of cutting and clipping that hold for every plane and every polygon.

use pirca::math::{Vec3, cos, sin};
use pirca::shape::{Plane, Polygon, Polyhedron};
use proptest::prelude::*;

fn direction() -> impl Strategy<Value = Vec3> {
    (0.0..std::f64::consts::TAU, -1.0..1.0f64).prop_map(|(turn, z)| {
        let flat = (1.0 - z * z).sqrt();
        Vec3::new(flat * cos(turn), flat * sin(turn), z)
    })
}

fn triangle() -> impl Strategy<Value = Polygon> {
    prop::array::uniform3(prop::array::uniform2(-1.0..1.0f64)).prop_map(|mut v| {
        let area = (v[1][0] - v[0][0]) * (v[2][1] - v[0][1]) - (v[2][0] - v[0][0]) * (v[1][1] - v[0][1]);
        if area < 0.0 {
            v.swap(1, 2);
        }
        Polygon { vertices: v.to_vec() }
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, ..ProptestConfig::default() })]

    #[test]
    fn two_cuts_leave_valid_parts_that_fill_the_whole(
        first in direction(), second in direction(), at in prop::array::uniform3(0.05..0.95f64),
    ) {
        let size = Vec3::new(0.4, 0.3, 0.2);
        let solid = Polyhedron::cuboid(Vec3::zeros(), size);
        let point = Vec3::from(at).component_mul(&size);
        let mut parts = vec![solid.clone()];
        for normal in [first, second] {
            let plane = Plane::through(point, normal);
            parts = parts.iter().flat_map(|part| {
                let (below, above) = part.cut(&plane, 1e-9);
                [below, above].into_iter().flatten()
            }).collect();
        }
        let volume: f64 = parts.iter().map(Polyhedron::volume).sum();
        // A vertex within 1e-9 m of a plane counts as on it: at most that film of a face is lost or gained.
        prop_assert!((volume / solid.volume() - 1.0).abs() < 1e-7, "{volume}");
        for part in &parts {
            prop_assert!(part.validate(1e-8).is_ok(), "{:?}", part.validate(1e-8));
        }
    }

    #[test]
    fn an_intersection_is_the_same_from_both_sides_and_lies_in_both(a in triangle(), b in triangle()) {
        let (ab, ba) = (a.intersection(&b).area(), b.intersection(&a).area());
        prop_assert!((ab - ba).abs() < 1e-12, "{ab} {ba}");
        prop_assert!(ab >= 0.0 && ab <= a.area().min(b.area()) + 1e-12);
    }

    #[test]
    fn a_line_divides_a_polygon_without_loss(a in triangle(), g0 in -1.0..1.0f64, gs in -1.0..1.0f64, gt in -1.0..1.0f64) {
        let (below, above) = (a.clip(g0, gs, gt).moments(), a.clip(-g0, -gs, -gt).moments());
        let whole = a.moments();
        prop_assert!((below.area + above.area - whole.area).abs() < 1e-12);
        prop_assert!((below.st + above.st - whole.st).abs() < 1e-12);
        prop_assert!((below.tt + above.tt - whole.tt).abs() < 1e-12);
    }
}
