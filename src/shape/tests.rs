//! Polygon clipping and overlap of solids against closed forms.

use approx::assert_relative_eq;

use crate::math::{Vec3, cos, sin};
use crate::shape::{Plane, Polygon, Polyhedron, overlap_depth};

/// Numbers in [0, 1) without a dependence on the generators under test: a 64-bit congruential sequence.
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.next()
    }
}

fn rectangle(s: [f64; 2], t: [f64; 2]) -> Polygon {
    Polygon { vertices: vec![[s[0], t[0]], [s[1], t[0]], [s[1], t[1]], [s[0], t[1]]] }
}

fn regular(corners: usize, radius: f64, turn: f64) -> Polygon {
    let angle = |i: usize| turn + 2.0 * std::f64::consts::PI * i as f64 / corners as f64;
    Polygon { vertices: (0..corners).map(|i| [radius * cos(angle(i)), radius * sin(angle(i))]).collect() }
}

#[test]
fn twenty_thousand_rectangle_pairs_share_the_product_of_their_overlaps() {
    let mut numbers = Numbers(1);
    let mut shared = 0;
    for _ in 0..20_000 {
        let mut interval = || {
            let from = numbers.between(-1.0, 1.0);
            [from, from + numbers.between(0.01, 1.0)]
        };
        let (s, t, u, v) = (interval(), interval(), interval(), interval());
        let overlap = |a: [f64; 2], b: [f64; 2]| (a[1].min(b[1]) - a[0].max(b[0])).max(0.0);
        let expected = overlap(s, u) * overlap(t, v);
        let found = rectangle(s, t).intersection(&rectangle(u, v)).area();
        // Round-off of products of numbers near 1.
        assert!((found - expected).abs() < 1e-14, "{s:?} {t:?} {u:?} {v:?}: {found} not {expected}");
        shared += u32::from(expected > 0.0);
    }
    assert!((2_000..18_000).contains(&shared), "both outcomes must occur, {shared} pairs overlap");
}

#[test]
fn two_equal_squares_turned_by_an_eighth_share_a_regular_octagon() {
    // Inradius 1: the octagon has area 8 tan(pi/8) = 8 (sqrt 2 - 1).
    let square = regular(4, 2f64.sqrt(), 0.0);
    let turned = regular(4, 2f64.sqrt(), std::f64::consts::FRAC_PI_4);
    let octagon = square.intersection(&turned);
    assert_eq!(octagon.vertices.len(), 8);
    assert_relative_eq!(octagon.area(), 8.0 * (2f64.sqrt() - 1.0), max_relative = 1e-14);
}

#[test]
fn a_polygon_inside_another_is_what_they_share_and_one_beside_it_shares_nothing() {
    let (small, large) = (regular(5, 0.3, 0.2), regular(7, 2.0, 0.1));
    assert_relative_eq!(small.intersection(&large).area(), small.area(), max_relative = 1e-14);
    assert_relative_eq!(large.intersection(&small).area(), small.area(), max_relative = 1e-14);
    let aside = Polygon { vertices: small.vertices.iter().map(|v| [v[0] + 5.0, v[1]]).collect() };
    assert_eq!(aside.intersection(&large).area(), 0.0);
}

#[test]
fn a_line_divides_area_and_moments_without_loss() {
    let mut numbers = Numbers(2);
    let polygon = regular(9, 0.2, 0.3);
    let whole = polygon.moments();
    for _ in 0..1000 {
        let (g0, angle) = (numbers.between(-0.15, 0.15), numbers.between(0.0, 6.3));
        let (gs, gt) = (cos(angle), sin(angle));
        let (a, b) = (polygon.clip(g0, gs, gt).moments(), polygon.clip(-g0, -gs, -gt).moments());
        assert_relative_eq!(a.area + b.area, whole.area, max_relative = 1e-13);
        assert!((a.s + b.s - whole.s).abs() < 1e-15 && (a.t + b.t - whole.t).abs() < 1e-15);
        assert_relative_eq!(a.ss + b.ss, whole.ss, max_relative = 1e-12);
        assert_relative_eq!(a.tt + b.tt, whole.tt, max_relative = 1e-12);
    }
}

#[test]
fn moments_of_a_rectangle_off_the_origin() {
    let m = rectangle([1.0, 1.4], [2.0, 2.1]).moments();
    assert_relative_eq!(m.area, 0.04, max_relative = 1e-12);
    assert_relative_eq!(m.s, 0.04 * 1.2, max_relative = 1e-12);
    assert_relative_eq!(m.ss, 0.04 * (1.2 * 1.2 + 0.4 * 0.4 / 12.0), max_relative = 1e-12);
    assert_relative_eq!(m.st, 0.04 * 1.2 * 2.05, max_relative = 1e-12);
    assert_relative_eq!(m.tt, 0.04 * (2.05 * 2.05 + 0.1 * 0.1 / 12.0), max_relative = 1e-12);
}

#[test]
fn boxes_overlap_as_deep_as_their_least_common_side() {
    let mut numbers = Numbers(3);
    let mut overlaps = 0;
    for _ in 0..2000 {
        let mut solid = || {
            let low = Vec3::from_fn(|_, _| numbers.between(0.0, 1.0));
            (low, low + Vec3::from_fn(|_, _| numbers.between(0.2, 1.0)))
        };
        let ((a, b), (c, d)) = (solid(), solid());
        let depth = (0..3).map(|k| (b[k] - c[k]).min(d[k] - a[k])).fold(f64::INFINITY, f64::min);
        let found = overlap_depth(&Polyhedron::cuboid(a, b), &Polyhedron::cuboid(c, d), 1e-9);
        match found {
            Some(found) => assert_relative_eq!(found, depth, epsilon = 1e-12),
            None => assert!(depth <= 1e-9, "an overlap of {depth} was missed"),
        }
        overlaps += u32::from(found.is_some());
    }
    assert!((500..1900).contains(&overlaps), "both outcomes must occur, {overlaps} pairs overlap");
}

#[test]
fn crossed_edges_need_the_axis_between_them() {
    // Two square bars with an edge up and an edge down, one along x, one along y: their edges meet at z = 0 when
    // the centres are 2 half-diagonals apart. No face normal separates them before they are further apart.
    let half = 0.5 * 2f64.sqrt();
    let bar = |along_x: bool, z: f64| {
        let across = |d: f64, e: f64| {
            let at = Vec3::new(0.0, d, z + e);
            move |l: f64| if along_x { at + Vec3::x() * l } else { Vec3::new(-at.y, l, at.z) }
        };
        let ends = |l: f64| {
            [across(0.0, -half)(l), across(half, 0.0)(l), across(0.0, half)(l), across(-half, 0.0)(l)]
        };
        let (p, q) = (ends(1.0), ends(-1.0));
        let solid = Polyhedron::hexahedron([p[0], p[1], p[2], p[3], q[0], q[1], q[2], q[3]]);
        let mut turned = solid.clone();
        turned.faces.iter_mut().for_each(|f| f.reverse());
        if solid.volume() > 0.0 { solid } else { turned }
    };
    let below = bar(true, 0.0);
    below.validate(1e-12).unwrap();
    for (apart, expected) in [(2.0 * half + 0.01, None), (2.0 * half - 0.01, Some(0.01))] {
        let above = bar(false, apart);
        above.validate(1e-12).unwrap();
        let normals = [&below, &above].into_iter().flat_map(|s| (0..6).map(|f| s.face_plane(f).normal));
        let seen = |n: Vec3| {
            let shadow = |s: &Polyhedron| (-s.width(&n) / 2.0, s.width(&n) / 2.0);
            apart * n.z.abs() - shadow(&below).1 - shadow(&above).1
        };
        assert!(normals.map(seen).all(|gap| gap < 0.0), "a face normal separates them already");
        match (overlap_depth(&below, &above, 1e-9), expected) {
            (Some(found), Some(depth)) => assert_relative_eq!(found, depth, epsilon = 1e-12),
            (found, expected) => assert_eq!(found, expected),
        }
    }
}

#[test]
fn the_parts_of_random_cuts_touch_and_do_not_overlap() {
    let mut numbers = Numbers(4);
    let solid = Polyhedron::cuboid(Vec3::zeros(), Vec3::new(0.4, 0.3, 0.2));
    for _ in 0..300 {
        let mut parts = vec![solid.clone()];
        for _ in 0..4 {
            let point = Vec3::new(numbers.between(0.1, 0.3), numbers.between(0.1, 0.2), 0.1);
            let normal = Vec3::from_fn(|_, _| numbers.between(-1.0, 1.0));
            let plane = Plane::through(point, normal);
            parts = parts.iter().flat_map(|part| <[_; 2]>::from(part.cut(&plane, 1e-9))).flatten().collect();
        }
        let volume: f64 = parts.iter().map(Polyhedron::volume).sum();
        // A vertex within the cut's tolerance may count as on the plane: 1e-9 m over areas of about 0.1 m^2.
        assert!((volume - solid.volume()).abs() < 1e-9, "{volume}");
        for (i, part) in parts.iter().enumerate() {
            part.validate(1e-8).unwrap();
            for other in &parts[i + 1..] {
                assert_eq!(overlap_depth(part, other, 1e-8), None);
            }
            let inside = part.translated(&Vec3::new(1e-6, 0.0, 0.0));
            assert!(overlap_depth(part, &inside, 1e-8).is_some(), "a solid overlaps its own shifted copy");
        }
    }
}

#[test]
fn the_polygon_around_points_has_their_outer_corners_only() {
    let square = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 1.0]];
    let inside = [[1.0, 0.5], [0.5, 0.0], [2.0, 0.25], [0.0, 0.0], [1.5, 1.0]];
    let around = Polygon::around(square.into_iter().chain(inside).collect());
    assert_eq!(around.vertices, square);
    assert_eq!(around.area(), 2.0);
    assert!(Polygon::around(vec![[1.0, 1.0]; 3]).vertices.len() < 3);
    assert!(Polygon::around(Vec::new()).vertices.is_empty());
}

/// What lies outside another polygon: nothing of what is within it, all of what does not meet it, and parts that fill the rest without overlap.
#[test]
fn what_is_left_of_a_polygon_outside_another_fills_the_rest() {
    let square = |[s, t]: [f64; 2], size: f64| Polygon {
        vertices: vec![[s, t], [s + size, t], [s + size, t + size], [s, t + size]],
    };
    let area = |own: &Polygon, other: &Polygon| own.without(other).iter().map(Polygon::area).sum::<f64>();
    let (large, small) = (square([0.0, 0.0], 4.0), square([1.0, 1.0], 2.0));
    assert_eq!(area(&large, &small), 12.0);
    assert_eq!(area(&small, &large), 0.0);
    assert_eq!(area(&small, &square([8.0, 0.0], 1.0)), 4.0);
    let parts = large.without(&small);
    for (k, part) in parts.iter().enumerate() {
        assert!(parts[k + 1..].iter().all(|other| part.intersection(other).area() == 0.0));
        assert_eq!(part.intersection(&small).area(), 0.0);
    }
}
