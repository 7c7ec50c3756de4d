//! Tests of the key table and of the drawn joints; files and faults are tested from outside, in `tests/cli`.

use crate::generate::canonical::running_bond;
use crate::law::{CohesionAfterSlip, Coulomb, NormalLaw, Sampling, Weakening};
use crate::model::JointLaws;
use crate::random::{Family, Streams};
use crate::study::keys;
use crate::study::schema::{Interval, Key, Kind, Section, nearest};
use crate::study::{DrawnJoints, Joint, Mechanisms, PARAMETERS, StatedLaw, WallParameter};

fn keys_below(section: &'static Section, found: &mut Vec<&'static Key>) {
    for key in section.all() {
        found.push(key);
        if let Some(below) = key.kind.below() {
            keys_below(below, found);
        }
    }
}

/// A dimensional value carries its unit at the end of its key, and no other key ends like one that does.
#[test]
fn every_key_carries_its_unit() {
    let mut all = Vec::new();
    keys_below(&keys::STUDY, &mut all);
    assert!(all.len() > 50);
    let suffixes = [
        ("Pa/m", "_pa_per_m"),
        ("N/m", "_n_per_m"),
        ("N", "_n"),
        ("kg/m3", "_kg_per_m3"),
        ("Pa", "_pa"),
        ("m3", "_m3"),
        ("deg/s", "_deg_per_s"),
        ("m/s2", "_m_per_s2"),
        ("m/s", "_m_per_s"),
        ("Hz/s", "hz_per_s"),
        ("1/s", "_per_s"),
        ("Hz", "_hz"),
        ("1/deg", "_per_deg"),
        ("deg", "_deg"),
        ("N m/rad", "_n_m_per_rad"),
        ("m", "_m"),
        ("s", "_s"),
        ("%", "_percent"),
    ];
    for key in all {
        let unit = match key.kind {
            Kind::Real { unit, .. }
            | Kind::Quantity { unit, .. }
            | Kind::Distribution { unit, .. }
            | Kind::Reals { unit, .. } => unit,
            _ => "1",
        };
        let named =
            suffixes.iter().find(|(_, suffix)| key.name.ends_with(suffix)).map_or("1", |(unit, _)| unit);
        assert_eq!(unit, named, "{}", key.name);
    }
}

/// What may be drawn once per wall is a number of the study, in the same unit, and may reach down to where that number may.
#[test]
fn what_is_drawn_once_per_wall_is_stated_in_the_same_unit() {
    let mut put = Vec::new();
    for own in keys::UNCERTAIN.all() {
        let Kind::Distribution { unit, within } = own.kind else { panic!("{}", own.name) };
        let mut section = &keys::STUDY;
        let mut stated = None;
        for part in own.name.split('.') {
            let key = section.key(part, None).unwrap_or_else(|| panic!("{}: no key {part}", own.name));
            if let Kind::Table(below) = key.kind {
                section = below;
            }
            stated = Some(key.kind);
        }
        let (of, range) = match stated {
            Some(
                Kind::Real { unit, within }
                | Kind::Quantity { unit, within }
                | Kind::Reals { unit, within, .. },
            ) => (unit, within),
            other => panic!("{}: {other:?}", own.name),
        };
        assert_eq!((of, range.low, range.open_low), (unit, within.low, within.open_low), "{}", own.name);
        assert!(WallParameter::of(own.name).is_some(), "{}", own.name);
        put.push(own.name);
    }
    // All others are drawn by the generator.
    let rest = PARAMETERS.iter().map(|own| own.key).filter(|key| !put.contains(key));
    assert_eq!(rest.collect::<Vec<_>>(), ["wall_size_factor"]);
}

#[test]
fn the_nearest_name_is_a_slip_of_the_pen_away() {
    let names = ["height_m", "length_m", "seed"];
    assert_eq!(nearest("heigth_m", &names), Some("height_m"));
    assert_eq!(nearest("sed", &names), Some("seed"));
    assert_eq!(nearest("temperature", &names), None);
    assert_eq!(nearest::<&str>("x", &[]), None);
}

#[test]
fn intervals_say_what_they_hold() {
    for (interval, inside, outside, words) in [
        (Interval::closed(-45.0, 45.0), 45.0, 45.1, "within -45 to 45"),
        (Interval::above(0.0, 1000.0), 1000.0, 0.0, "above 0 and at most 1000"),
        (Interval::below(0.0, 1.0), 0.0, 1.0, "at least 0 and below 1"),
        (Interval::open(0.0, f64::INFINITY), 1e300, 0.0, "above 0"),
        (Interval::below(0.0, f64::INFINITY), 0.0, -1e-9, "at least 0"),
        (Interval::any(), -1.0, f64::NAN, "finite"),
        (Interval::closed(1e6, 1e12), 1e6, 9.9e5, "within 1e6 to 1e12"),
    ] {
        assert!(interval.contains(inside) && !interval.contains(outside), "{interval}");
        assert_eq!(interval.to_string(), words);
    }
}

fn joint() -> Joint {
    Joint {
        kn_factor: Family::Uniform { low: 0.5, high: 1.5 },
        kn_over_ks: 2.0,
        phi_deg: Family::Constant { value: 45.0 },
        cohesion: Family::Uniform { low: 0.0, high: 1e4 },
        tension: 10.0,
        compressive_strength: None,
        cohesion_after_slip: CohesionAfterSlip::Lost,
        normal_law: StatedLaw::Linear,
        sampling: Sampling::Vertices,
        bearing: None,
    }
}

fn kn_of(law: crate::law::Coulomb) -> f64 {
    law.normal.largest_stiffness()
}

#[test]
fn a_joint_is_drawn_once_per_pair_whatever_the_order_and_the_stiffness() {
    let joint = joint();
    let streams = Streams::new(1, 4);
    let soft = DrawnJoints::new(&joint, 1e7, streams.clone());
    let stiff = DrawnJoints::new(&joint, 2e7, streams);
    assert_eq!(soft.of(3, 8), soft.of(8, 3));
    assert_ne!(kn_of(soft.of(3, 8)), kn_of(soft.of(3, 9)));
    assert_ne!(kn_of(soft.of(1, 23)), kn_of(soft.of(12, 3)));
    assert_eq!(2.0 * kn_of(soft.of(3, 8)), kn_of(stiff.of(3, 8)));
    assert_eq!(soft.of(3, 8).cohesion, stiff.of(3, 8).cohesion);
    assert_ne!(kn_of(soft.of(3, 8)), kn_of(DrawnJoints::new(&joint, 1e7, Streams::new(1, 5)).of(3, 8)));
    let law = soft.of(0, 1);
    assert_eq!(law.ks, kn_of(law) / 2.0);
    // tan 45 deg is 1; pi is rounded, so half an ulp of the angle is allowed for.
    assert!((law.tan_phi - 1.0).abs() < 1e-15);
    assert_eq!((law.tension, law.bonded, law.sampling), (10.0, false, Sampling::Vertices));
}

/// Switching one property from constant to random must leave the draws of the others alone.
#[test]
fn another_random_property_changes_no_other_draw() {
    let mut other = joint();
    other.phi_deg = Family::Uniform { low: 20.0, high: 40.0 };
    let streams = Streams::new(9, 0);
    let (one, two) = (joint().law(1e8, &streams, 5, 2), other.law(1e8, &streams, 5, 2));
    assert_eq!((kn_of(one), one.cohesion), (kn_of(two), two.cohesion));
    assert_ne!(one.tan_phi, two.tan_phi);
}

#[test]
fn joints_near_the_ends_are_released_and_no_others() {
    let (joint, wall, streams) = (joint(), running_bond(2, 7), Streams::new(2, 0));
    let mechanisms = Mechanisms::default().with("end_release", &[0.2, 0.5, 0.25]);
    let plain = DrawnJoints::new(&joint, 1e8, streams);
    let released = plain.clone().altered(&mechanisms, &wall);
    // Two courses, 1.5 m long, stones 0 to 7 below and 8 to 15 above. Middles of what is shared: 0.05, 0.15, 0.25, 1.25, 1.35,
    // 0.1 and 0.7 m; the ground is as long as the wall.
    for (a, b, is_near) in [
        (0, 8, true),
        (1, 8, true),
        (1, 9, false),
        (6, 14, false),
        (7, 14, true),
        (0, 1, true),
        (3, 4, false),
        (3, 16, false),
        (0, 16, true),
    ] {
        let (before, after) = (plain.of(a, b), released.of(a, b));
        let expected = Coulomb { tan_phi: 0.5 * before.tan_phi, ks: 0.25 * before.ks, ..before };
        assert_eq!(after, if is_near { expected } else { before }, "{a}-{b}");
        assert_eq!(after, released.of(b, a));
    }
}

#[test]
fn the_joints_under_the_lowest_course_are_bedded_softly_and_no_others() {
    let (joint, wall) = (joint(), running_bond(2, 7));
    let plain = DrawnJoints::new(&joint, 1e8, Streams::new(2, 0));
    let bedding = Mechanisms::default().with("bedding", &[0.25]);
    // The platform is block 16, the first behind the stones; a strip and end blocks come behind it.
    for wall in [wall.clone(), wall.with_base()] {
        let softer = plain.clone().altered(&bedding, &wall);
        for (a, b, is_bed) in [(0, 16, true), (7, 16, true), (0, 8, false), (3, 4, false), (0, 17, false)] {
            let before = plain.of(a, b);
            let expected = Coulomb { normal: before.normal.scaled(0.25), ks: 0.25 * before.ks, ..before };
            assert_eq!(softer.of(b, a), if is_bed { expected } else { before }, "{a}-{b}");
        }
    }
}

#[test]
fn a_specimen_has_factors_of_its_own_on_all_its_joints() {
    let (joint, wall) = (joint(), running_bond(2, 7));
    let of = |covs: [f64; 2], member| {
        let mechanisms = Mechanisms::default().with("specimen_scatter", &covs);
        let plain = DrawnJoints::new(&joint, 1e8, Streams::new(2, member));
        let law = plain.clone().altered(&mechanisms, &wall);
        [(0, 8), (1, 9)].map(|(a, b)| {
            let (before, after) = (plain.of(a, b), law.of(a, b));
            let stiffness = kn_of(after) / kn_of(before);
            assert!((after.ks / before.ks / stiffness - 1.0).abs() < 1e-14);
            [stiffness, after.tan_phi / before.tan_phi]
        })
    };
    let both = [0.3, 0.1];
    let [first, second] = of(both, 0);
    // Rounding of two products.
    assert!((first[0] / second[0] - 1.0).abs() < 1e-14 && (first[1] / second[1] - 1.0).abs() < 1e-14);
    assert_ne!(first, of(both, 1)[0]);
    // Each from a stream of its own.
    let stiff = of([0.3, 0.0], 0)[0];
    assert_eq!((stiff[0], stiff[1]), (first[0], 1.0));
    // Mean 1 and the COV asked for: 2000 walls know them to 0.3 / sqrt(2000) and 1.6 % of it, five times over.
    let factors: Vec<f64> = (0..2000).map(|member| of(both, member)[0][0]).collect();
    let mean = factors.iter().sum::<f64>() / 2000.0;
    let variance = factors.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>() / 1999.0;
    assert!((mean - 1.0).abs() < 0.034 && (variance.sqrt() / 0.3 - 1.0).abs() < 0.1, "{mean} {variance}");
}

#[test]
fn mechanisms_of_the_joints_are_in_their_laws() {
    let (wall, streams) = (running_bond(2, 7), Streams::new(2, 0));
    let joint = Joint { sampling: Sampling::Area, ..joint() };
    let plain = DrawnJoints::new(&joint, 1e8, streams);
    let before = plain.of(0, 8);
    let of = |mechanisms: Mechanisms| plain.clone().altered(&mechanisms, &wall).of(0, 8);
    let with = |name: &str, values: &[f64]| of(Mechanisms::default().with(name, values));
    assert_eq!(of(Mechanisms::default()), before);
    let weakening = Some(Weakening { residual: 0.7, distance: 1e-3 });
    let expected = Coulomb { tan_phi: 0.8 * before.tan_phi, weakening, ..before };
    assert_eq!(with("friction", &[0.8, 0.7, 1e-3]), expected);
    let expected = Coulomb { cohesion: before.cohesion + 50.0, ..before };
    assert_eq!(with("cohesion", &[50.0]), expected);
    let normal = NormalLaw::Hyperbolic { kn: kn_of(before), initial: 1e7, closure: 1e-4 };
    assert_eq!(with("joint_closure", &[1e7, 1e-4]), Coulomb { normal, ..before });
    let Sampling::Patches(mask) = with("contact_area", &[0.3]).sampling else {
        panic!("it touches in patches")
    };
    assert_eq!(mask.count_ones(), 19);
}
