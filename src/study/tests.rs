//! Tests of the key table and of the drawn joints; files and faults are tested from outside, in `tests/cli`.

use crate::law::{CohesionAfterSlip, Sampling};
use crate::model::JointLaws;
use crate::random::{Family, Streams};
use crate::study::keys;
use crate::study::schema::{Interval, Key, Kind, Section, nearest};
use crate::study::{DrawnJoints, Joint, NormalLawName};

fn keys_below(section: &'static Section, found: &mut Vec<&'static Key>) {
    for key in section.all() {
        found.push(key);
        if let Kind::Table(below) | Kind::Tables(below) = key.kind {
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
        ("1/deg", "_per_deg"),
        ("deg", "_deg"),
        ("N m/rad", "_n_m_per_rad"),
        ("m", "_m"),
        ("s", "_s"),
    ];
    for key in all {
        let unit = match key.kind {
            Kind::Real { unit, .. } | Kind::Quantity { unit, .. } | Kind::Reals { unit, .. } => unit,
            _ => "1",
        };
        let named =
            suffixes.iter().find(|(_, suffix)| key.name.ends_with(suffix)).map_or("1", |(unit, _)| unit);
        assert_eq!(unit, named, "{}", key.name);
    }
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
        cohesion_after_slip: CohesionAfterSlip::Lost,
        normal_law: NormalLawName::Linear,
        sampling: Sampling::Vertices,
    }
}

fn kn_of(law: crate::law::Coulomb) -> f64 {
    law.normal.largest_stiffness()
}

#[test]
fn a_joint_is_drawn_once_per_pair_whatever_the_order_and_the_stiffness() {
    let joint = joint();
    let streams = Streams::new(1, 4);
    let soft = DrawnJoints::new(&joint, 1e7, streams);
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
