//! The drawings against a wall whose every outline is known.

use super::pane::round_length;
use super::seen::{along, busiest, section, shown};
use super::*;
use crate::shape::bounds;

fn cuboid(low: [f64; 3], high: [f64; 3]) -> Polyhedron {
    Polyhedron::cuboid(Vec3::from(low), Vec3::from(high))
}

/// Two leaves of two courses on a base, 1.2 m long, 0.5 m thick and 0.4 m high; the upper course is of two stones in the face, joined at 0.6 m.
fn shapes() -> Vec<Polyhedron> {
    vec![
        cuboid([-5.0, -5.0, -1.0], [5.0, 5.0, 0.0]),
        cuboid([0.0, 0.0, 0.0], [1.2, 0.25, 0.2]),
        cuboid([0.0, 0.25, 0.0], [1.2, 0.5, 0.2]),
        cuboid([0.0, 0.0, 0.2], [0.6, 0.25, 0.4]),
        cuboid([0.6, 0.0, 0.2], [1.2, 0.25, 0.4]),
        cuboid([0.0, 0.25, 0.2], [1.2, 0.5, 0.4]),
    ]
}

fn views() -> Views {
    let shapes = shapes();
    Views {
        title: "a < b & \"c\"".to_owned(),
        fixed: (0..shapes.len()).map(|at| at == 0).collect(),
        shapes,
        load: Some((Vec3::y(), "load y+".to_owned())),
        shade: None,
        remarks: vec!["It rests.".to_owned()],
    }
}

fn blocks(seen: &[Seen]) -> Vec<usize> {
    let mut blocks: Vec<usize> = seen.iter().map(|own| own.block).collect();
    blocks.sort_unstable();
    blocks
}

#[test]
fn a_view_shows_what_is_not_hidden() {
    let frame = rectangle([-1.0, -1.0, 2.0, 2.0]);
    let face = shown(along(&shapes(), &View::FACE, 1e-3), &frame);
    assert_eq!(blocks(&face), [0, 1, 3, 4]);
    // The base ends where the frame does.
    let base = face.iter().find(|own| own.block == 0).unwrap();
    assert_eq!(bounds(&base.outline.vertices), [-1.0, -1.0, 2.0, 0.0]);
    assert_eq!(blocks(&shown(along(&shapes(), &View::PLAN, 1e-3), &frame)), [0, 3, 4, 5]);
}

/// Two stones hide a third one together, and leave it seen where they are a little apart.
#[test]
fn what_several_hide_together_is_hidden() {
    let frame = rectangle([-1.0, -1.0, 2.0, 2.0]);
    let behind = cuboid([0.0, 0.5, 0.0], [1.0, 1.0, 1.0]);
    let before = |gap: f64| {
        let shapes = [
            behind.clone(),
            cuboid([0.0, 0.0, 0.0], [0.4, 0.5, 1.0]),
            cuboid([0.4 + gap, 0.0, 0.0], [1.0, 0.5, 1.0]),
        ];
        blocks(&shown(along(&shapes, &View::FACE, 1e-3), &frame))
    };
    assert_eq!(before(0.0), [1, 2]);
    assert_eq!(before(0.05), [0, 1, 2]);
}

#[test]
fn a_section_shows_what_it_cuts_and_what_lies_beyond() {
    let cut = |x: f64| {
        let seen = section(&shapes(), x, 1e-3);
        let cut: Vec<usize> = seen.iter().filter(|own| own.is_cut).map(|own| own.block).collect();
        (cut, blocks(&seen))
    };
    assert_eq!(cut(0.9), (vec![0, 1, 2, 4, 5], vec![0, 1, 2, 3, 4, 5]));
    // On the joint it cuts neither of both stones; the nearer one lies before it.
    assert_eq!(cut(0.6), (vec![0, 1, 2, 5], vec![0, 1, 2, 3, 5]));
    let seen = section(&shapes(), 0.9, 1e-3);
    let upper = seen.iter().find(|own| own.block == 4).unwrap();
    assert_eq!(bounds(&upper.outline.vertices), [0.0, 0.2, 0.25, 0.4]);
    // A wedge is cut where its edges pass: half as high in the middle.
    let wedge = Polyhedron {
        vertices: [[0., 0., 0.], [1., 0., 0.], [1., 1., 0.], [0., 1., 0.], [1., 0., 1.], [1., 1., 1.]]
            .map(Vec3::from)
            .to_vec(),
        faces: vec![vec![3, 2, 1, 0], vec![1, 2, 5, 4], vec![0, 1, 4], vec![2, 3, 5], vec![3, 0, 4, 5]],
    };
    let cut = &section(&[wedge], 0.5, 1e-3)[0];
    assert_eq!((bounds(&cut.outline.vertices), cut.outline.area()), ([0.0, 0.0, 1.0, 0.5], 0.5));
}

/// In the middle of the wall is a joint, which no section shows well: it lies beside it.
#[test]
fn a_section_lies_where_it_cuts_most_stones_near_the_middle() {
    let all = shapes();
    let free: Vec<&Polyhedron> = all[1..].iter().collect();
    let x = busiest(&free, [0.0, 1.2]);
    assert!(x != 0.6 && (x - 0.6).abs() < 0.05, "{x}");
    let lower: Vec<&Polyhedron> = all[1..3].iter().collect();
    assert_eq!(busiest(&lower, [0.0, 1.2]), 0.6);
}

#[test]
fn the_sheet_holds_every_outline_and_the_dimensions() {
    let text = views().svg();
    let polygons = |fill: &str, width: f64| {
        text.matches(&format!("fill=\"{fill}\" stroke=\"{EDGE}\" stroke-width=\"{width}\"")).count()
    };
    // Three stones in the face and three in the plan, and a swatch of the legend; four stones are cut.
    assert_eq!((polygons(SEEN, 0.8), polygons(CUT, 1.4)), (3 + 3 + 1, 4), "{text}");
    assert_eq!((polygons(FIXED, 0.8), polygons(FIXED, 1.4)), (2 + 1, 1), "{text}");
    for (dimension, times) in [("1.200 m", 1), ("0.400 m", 1), ("0.500 m", 2)] {
        assert_eq!(text.matches(&format!(">{dimension}<")).count(), times, "{dimension}: {text}");
    }
    assert_eq!(views().size(), Vec3::new(1.2, 0.5, 0.4));
    assert!(text.contains("a &lt; b &amp; &quot;c&quot;") && text.contains("It rests."), "{text}");
    assert_eq!(text, views().svg(), "the same wall, the same bytes");
}

/// Towards y+ the load lies in the section and in the plan, along x in the face and in the plan, askew in the plan alone.
#[test]
fn the_load_is_an_arrow_where_it_lies_in_the_view() {
    let arrows = |towards: Vec3| {
        let load = Some((towards, "load".to_owned()));
        Views { load, ..views() }.svg().matches(">load<").count()
    };
    assert_eq!([Vec3::y(), -Vec3::x(), Vec3::new(0.8, 0.6, 0.0)].map(arrows), [2, 2, 1]);
    // Towards y+ it points to the right of the section and up in the plan.
    let text = views().svg();
    let shafts: Vec<Vec<f64>> = text
        .split("<polyline points=\"")
        .filter(|rest| rest.contains("stroke-width=\"3\"/>\n<polygon"))
        .map(|rest| {
            rest.split('"').next().unwrap_or_default().split([' ', ',']).map(|x| x.parse().unwrap()).collect()
        })
        .collect();
    assert_eq!(shafts.len(), 2, "{text}");
    assert!(shafts[0][0] < shafts[0][2] && shafts[0][1] == shafts[0][3], "{shafts:?}");
    assert!(shafts[1][0] == shafts[1][2] && shafts[1][1] > shafts[1][3], "{shafts:?}");
}

/// All views have one scale: the face is as high as the section, and as long as the plan.
#[test]
fn all_views_have_one_scale_and_lie_on_the_sheet() {
    for stretched in [Vec3::new(1.0, 1.0, 1.0), Vec3::new(20.0, 1.0, 1.0), Vec3::new(1.0, 1.0, 20.0)] {
        let mut views = views();
        views
            .shapes
            .iter_mut()
            .flat_map(|own| &mut own.vertices)
            .for_each(|v| *v = v.component_mul(&stretched));
        let Paper { face, end, plan } = views.paper();
        let plan = plan.unwrap();
        assert!(face.scale == end.scale && face.scale == plan.scale);
        assert_eq!((face.corner[1], face.end()[1]), (end.corner[1], end.end()[1]));
        assert_eq!((face.corner[0], face.end()[0]), (plan.corner[0], plan.end()[0]));
        // Room for the dimension on the left, and for a name above the section.
        assert!(face.corner[0] >= MARGIN + ASIDE - 1e-9 && end.corner[0] + NAME <= WIDTH - MARGIN + 1e-9);
        assert!(end.corner[0] - face.end()[0] >= BETWEEN - 1e-9 && end.end()[0] <= WIDTH - MARGIN + 1e-9);
    }
}

#[test]
fn stones_are_coloured_by_their_values_and_labelled() {
    let shade = Shade {
        values: vec![0.0, 1e-3, 0.0, 4e-3, 0.0, 0.0],
        measure: "moved".to_owned(),
        unit: ("mm", 1e3),
        labels: vec![(3, "<3>".to_owned())],
    };
    let text = Views { shade: Some(shade), load: None, ..views() }.svg();
    let fills = |share: f64| text.matches(&format!("fill=\"{}\" stroke", colour::of_share(share))).count();
    // The lower stone in the face and cut; the upper one in the face, and beyond or in the section.
    assert!(fills(0.25) == 2 && fills(1.0) >= 1, "{text}");
    assert!(text.contains(">&lt;3&gt;<") && !text.contains("From above"), "{text}");
    assert!(text.contains(">mm: moved<") && text.contains(">4.0<") && text.contains(">2.0<"), "{text}");
}

#[test]
fn of_a_large_wall_only_the_section_has_all_stones() {
    let thin = |k: usize| cuboid([f64::from(k as u32), 0.0, 0.0], [f64::from(k as u32) + 1.0, 1.0, 1.0]);
    let shapes: Vec<Polyhedron> = (0..=MOST_BLOCKS).map(thin).collect();
    let large = Views { fixed: vec![false; shapes.len()], shapes, ..views() };
    let text = large.svg();
    assert!(text.len() < 20_000 && text.contains("more than 3000 blocks"), "{}", text.len());
    assert_eq!(text.matches(&format!("fill=\"{CUT}\" stroke=\"{EDGE}\" stroke-width=\"1.4\"")).count(), 1);
    assert!(!views().svg().contains("blocks:"));
}

#[test]
fn a_bar_of_the_scale_has_a_round_length() {
    let lengths = [0.0005, 0.7, 1.0, 1.9, 4.99, 5.0, 730.0].map(round_length);
    assert_eq!(lengths, [0.001, 0.5, 1.0, 1.0, 2.0, 5.0, 500.0]);
}
