//! Extensions of the base model by causes.

use crate::critic::extend::extension;
use crate::critic::fixture::made;
use crate::critic::simulate::{Causes, Scope, Truth};
use crate::random::Streams;

#[test]
fn an_extension_is_the_median_of_its_truths_and_draws_from_all_of_them() {
    let made = made();
    let world = made.world();
    let friction = made.mechanisms.iter().position(|m| m.name == "friction").expect("it is one");
    let truths: Vec<Truth> = (0..61).map(|k| world.drawn(Some(friction), &Streams::new(3, k))).collect();
    let found = extension(&world, &truths).expect("there are truths");
    let row = |truth: &Truth| (world.parameters(truth), [0, 1, 2].map(|family| world.factors(truth, family)));
    let middle = |of: &dyn Fn(&Truth) -> f64| {
        let mut values: Vec<f64> = truths.iter().map(of).collect();
        values.sort_by(f64::total_cmp);
        values[30]
    };
    let keys: Vec<&str> = found.median.acting[0].parameters.iter().map(|(key, _)| *key).collect();
    assert_eq!(
        (found.median.acting[0].mechanism, &keys[..]),
        ("friction", &["factor", "residual_share", "slip_distance_m"][..])
    );
    for (k, (_, value)) in found.median.acting[0].parameters.iter().enumerate() {
        assert_eq!(*value, middle(&|truth| row(truth).0[k]));
    }
    for (family, factors) in &found.median.joints {
        assert_eq!(*factors, [0, 1, 2].map(|k| middle(&|truth| row(truth).1[*family][k])));
    }
    // Draws keep together what belongs together: the first, the fourth, ... and one near the end.
    assert_eq!(found.draws.len(), 20);
    for (draw, at) in found.draws.iter().zip((0..20).map(|k| k * 61 / 20)) {
        let values: Vec<f64> = draw.acting[0].parameters.iter().map(|(_, value)| *value).collect();
        let factors: Vec<[f64; 3]> = draw.joints.iter().map(|(_, factors)| *factors).collect();
        assert_eq!((values, &factors[..]), (row(&truths[at]).0, &row(&truths[at]).1[..]));
    }
    // kn of the slightly irregular stones is 5e7 by its factor.
    let known = found.known.iter().find(|known| known.key == "arm.sbl.joint.kn_pa_per_m").expect("it varies");
    assert_eq!(known.median, 5e7 * found.median.joints[1].1[0]);
    assert!(known.interval[0] < known.median && known.median < known.interval[1]);
    assert_eq!(extension(&world, &truths[..3]).map(|few| few.draws.len()), Some(3));
    assert_eq!(extension(&world, &[]), None);
    let both = world.drawn(Causes::pair(friction, made.cause("density")), &Streams::new(3, 0));
    let both = extension(&world, &[both]).expect("there is one").median;
    let names: Vec<(&str, usize)> =
        both.acting.iter().map(|own| (own.mechanism, own.parameters.len())).collect();
    assert_eq!(names, [("friction", 3), ("density", 1)]);
    assert_eq!(extension(&world, &[world.drawn(None, &Streams::new(3, 0))]), None);
}

#[test]
fn a_cause_of_one_kind_of_joints_extends_the_arms_that_have_them() {
    let made = made();
    let (world, area) = (made.world(), made.cause("contact_area"));
    let extended = |scope: Scope| {
        let causes = Causes::one(area, scope);
        let truths: Vec<Truth> = (0..61).map(|k| world.drawn(causes, &Streams::new(3, k))).collect();
        let extension = extension(&world, &truths).expect("there are truths");
        let arms: Vec<Option<Vec<usize>>> =
            extension.median.acting.iter().map(|acting| acting.arms.clone()).collect();
        let keys = extension.known.iter().map(|known| known.key.clone());
        let keys: Vec<String> = keys.filter(|key| key.ends_with("mechanism.contact_area.share")).collect();
        (arms, keys.join(" "))
    };
    assert_eq!(extended(Scope::All), (vec![None], "mechanism.contact_area.share".to_owned()));
    let [cbl, sbl, sbr] = ["cbl", "sbl", "sbr"].map(|arm| format!("arm.{arm}.mechanism.contact_area.share"));
    assert_eq!(extended(Scope::Kind(1)), (vec![Some(vec![1, 2])], format!("{sbl} {sbr}")));
    assert_eq!(extended(Scope::Each), (vec![Some(vec![0]), Some(vec![1, 2])], format!("{cbl} {sbl} {sbr}")));
}
