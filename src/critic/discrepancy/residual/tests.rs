//! Residuals of campaigns of walls whose formula is known.

use crate::critic::discrepancy::residual::nested::Nested;
use crate::critic::discrepancy::{Baseline, Group, Residuals, Side};
use crate::critic::extend::{base_curves, over_the_tilt};
use crate::critic::fixture::{Made, made};
use crate::critic::simulate::{Campaign, Design, Seen, Truth, World};
use crate::math::{degrees, radians};
use crate::random::Streams;
use crate::stats;
use crate::study::{MeasuredKind, MeasuredQuantity, Measurement};

/// A standard deviation of stones is that of the fifty-odd walls of the bank that lie within the priors as they are stated: off by
/// a tenth, two of which are allowed.
const SAMPLED: f64 = 0.2;

/// Families of the paper's nine walls, in the order of their arms: nothing is random in the first.
const CBL: usize = 0;
const SBL: usize = 1;

fn campaign(world: &World<'_>, design: &Design, seed: u64, k: u64) -> Campaign {
    let streams = Streams::new(seed, k);
    world.campaign(design, &world.stated(&streams), &streams)
}

fn readings(design: &mut Design) -> impl Iterator<Item = &mut Measurement> {
    design.specimens.iter_mut().flat_map(|specimen| &mut specimen.readings)
}

/// Standard deviation of the logarithm of an angle that goes with 0.05 of the score of kn, where specimens differ in the stiffness of their
/// joints: the mean square of its coefficient of variation is 0.2 squared.
fn by_stiffness(made: &Made) -> f64 {
    let kn = |score: f64| crate::math::ln(made.nuisances[0].prior.at_score(score));
    0.05 / ((kn(0.2) - kn(-0.2)) / 0.4) * 0.2
}

fn group(residuals: &Residuals, family: usize, quantity: MeasuredQuantity, tilt_deg: Option<f64>) -> &Group {
    let same = |tilt: Option<f64>| tilt.map(|tilt| degrees(tilt).round()) == tilt_deg;
    let of = |group: &&Group| group.family == family && group.quantity == quantity && same(group.tilt);
    residuals.groups.iter().find(of).expect("it was measured")
}

#[test]
fn the_parts_of_a_residual_are_those_that_made_it() {
    let made = made();
    let (world, (design, measured)) = (made.world(), Design::of(&made.study));
    let found = Baseline::new(&world, &design, 1).residuals(&measured);
    assert_eq!((found.readings.len(), found.groups.len()), (27 + 6, 3 + 3 + 2 + 3));
    let within =
        |x: f64, wanted: f64, off: f64| assert!((x / wanted - 1.0).abs() < off, "{x} and not {wanted}");
    let near = |x: f64, wanted: f64| within(x, wanted, 0.1);
    // The angle is 14.5 deg times exp(0.05 kn + 0.01 phi + 0.02 stones), read in steps of 0.5 deg.
    let stones = (0.02_f64 * 0.02 + by_stiffness(&made) * by_stiffness(&made)).sqrt();
    let angle = group(&found, SBL, MeasuredQuantity::CollapseAngle, None);
    let parts = angle.expected.expect("walls stand").parts;
    near(degrees(parts.measurement), 0.5 / 36.0_f64.sqrt());
    within(degrees(parts.scatter), 14.5 * stones / 3.0_f64.sqrt(), SAMPLED);
    near(degrees(parts.parameters), 14.5 * 0.0026_f64.sqrt());
    let single = found.readings.iter().find(|r| r.family == SBL && r.reading.tilt.is_none()).expect("read");
    let parts = single.expected.expect("walls stand").parts;
    near(degrees(parts.measurement), 0.5 / 12.0_f64.sqrt());
    within(degrees(parts.scatter), 14.5 * stones, SAMPLED);
    near(degrees(parts.parameters), 14.5 * 0.0026_f64.sqrt());
    near(parts.sd(), radians((0.25 / 12.0 + 14.5 * 14.5 * (0.0026 + stones * stones)).sqrt()));
    let Seen::Value(value) = single.seen else { panic!("it was read") };
    let expected = single.expected.expect("walls stand");
    near(single.in_sd.expect("a value"), (value - expected.mean) / parts.sd());
    // Walls of which nothing is drawn scatter by their joints alone: the error of the emulator is a want of knowledge.
    let same = group(&found, CBL, MeasuredQuantity::CollapseAngle, None).expected.expect("walls stand").parts;
    within(degrees(same.scatter), 19.0 * by_stiffness(&made) / 3.0_f64.sqrt(), SAMPLED);
    near(degrees(same.parameters), 19.0 * 0.0026_f64.sqrt());
}

#[test]
fn a_doubled_error_doubles_the_part_of_the_measurement_alone_and_a_common_one_stays_whole() {
    let made = made();
    let (world, (mut design, measured)) = (made.world(), Design::of(&made.study));
    readings(&mut design).for_each(|m| (m.kind, m.resolution) = (MeasuredKind::Exact, 0.0));
    let of = |error: f64, common: f64| {
        let mut design = design.clone();
        readings(&mut design).filter(|m| m.tilt.is_some()).for_each(|m| {
            (m.error, m.common_error) = (error, common);
        });
        let found = Baseline::new(&world, &design, 1).residuals(&measured);
        let place = found.readings.iter().position(|r| r.family == SBL && r.reading.tilt.is_some());
        let single = found.readings[place.expect("read")].expected.expect("walls stand").parts;
        let many = group(&found, SBL, MeasuredQuantity::DisplacementMean, Some(5.0));
        (single, many.expected.expect("walls stand").parts)
    };
    let (once, twice, shared) = (of(1e-3, 0.0), of(2e-3, 0.0), of(0.0, 1e-3));
    for ((once, twice), shared) in [once.0, once.1].iter().zip([twice.0, twice.1]).zip([shared.0, shared.1]) {
        assert_eq!(twice.measurement, 2.0 * once.measurement);
        assert_eq!((twice.scatter, twice.parameters), (once.scatter, once.parameters));
        assert_eq!(shared.measurement, 1e-3);
    }
    assert_eq!(once.0.measurement, 1e-3);
    assert!((once.1.measurement - 1e-3 / 3.0_f64.sqrt()).abs() < 1e-12);
}

#[test]
fn a_bound_gives_a_share_and_no_number() {
    let made = made();
    let (world, (design, measured)) = (made.world(), Design::of(&made.study));
    let found = Baseline::new(&world, &design, 2).residuals(&measured);
    let bound = found.readings.iter().find(|r| r.family == CBL && r.reading.tilt.is_some()).expect("read");
    assert_eq!((bound.seen, bound.in_sd), (Seen::Beyond, None));
    // 1.7 mm at 5 deg and an error of 1.7 mm against a bound of 5 mm: nearly all lie below.
    let share = bound.agreeing.expect("a bound");
    assert!(share > 0.9 && share <= 1.0, "{share}");
    let bounds = group(&found, CBL, MeasuredQuantity::DisplacementMean, Some(5.0));
    assert_eq!((bounds.seen, bounds.below, bounds.above, bounds.in_sd), (3, 3, 0, None));
    assert_eq!((bounds.side, bounds.p_value), (Side::Within, Some(1.0)));
    assert!((bounds.agreeing.expect("bounds") - share).abs() < 0.02);
    // Had the bound been so low that hardly any wall keeps it, it would speak against the base model.
    let mut low = design.clone();
    readings(&mut low).filter(|m| m.kind == MeasuredKind::Below).for_each(|m| m.value = 1e-4);
    let found = Baseline::new(&world, &low, 2).residuals(&measured);
    let bounds = group(&found, CBL, MeasuredQuantity::DisplacementMean, Some(15.0));
    assert_eq!(bounds.side, Side::Below, "{bounds:?}");
    assert!(bounds.p_value.expect("simulated") < 0.01);
    // Values have no share.
    let value = group(&found, SBL, MeasuredQuantity::DisplacementMean, Some(5.0));
    assert!(value.in_sd.is_some() && value.agreeing.is_none());
}

#[test]
fn the_p_value_of_a_group_is_uniform_where_nothing_is_hidden_and_rounding_and_bounds_make_it_no_smaller() {
    let made = made();
    let (world, (design, _)) = (made.world(), Design::of(&made.study));
    let mut exact = design.clone();
    readings(&mut exact).for_each(|m| (m.kind, m.resolution) = (MeasuredKind::Exact, 0.0));
    for (design, uniform) in [(&exact, true), (&design, false)] {
        let baseline = Baseline::new(&world, design, 3);
        let found: Vec<Residuals> =
            (0..300).map(|k| baseline.residuals(&campaign(&world, design, 4, k))).collect();
        for (place, first) in found[0].groups.iter().enumerate() {
            let mut p: Vec<f64> = found.iter().filter_map(|r| r.groups[place].p_value).collect();
            p.sort_by(f64::total_cmp);
            let low = p.partition_point(|p| *p < 0.1);
            let distance = stats::ks_statistic(&p, |x| x);
            println!("{} {:?}: {low} of {}, {distance}", first.family, first.quantity, p.len());
            // A tenth of 300 is 30 +- 5.2.
            assert!(p.len() > 290 && low <= 46, "{low}: {first:?}");
            if uniform {
                assert!(
                    low >= 14 && stats::ks_p_value(distance, p.len()) > 1e-3,
                    "{low} {distance}: {first:?}"
                );
            }
        }
    }
}

#[test]
fn a_campaign_that_is_shifted_gets_a_small_p_and_the_right_sign() {
    let made = made();
    let (world, (mut design, _)) = (made.world(), Design::of(&made.study));
    readings(&mut design).for_each(|m| (m.kind, m.resolution, m.error) = (MeasuredKind::Exact, 0.0, 1e-4));
    let baseline = Baseline::new(&world, &design, 5);
    let before = campaign(&world, &design, 6, 0);
    for (factor, side) in [(4.0, Side::Above), (0.1, Side::Below)] {
        let mut after = before.clone();
        for (specimen, seen) in design.specimens.iter().zip(&mut after.specimens) {
            for (m, seen) in specimen.readings.iter().zip(seen) {
                if let (SBL, Some(_), Seen::Value(value)) = (specimen.family, m.tilt, &*seen) {
                    *seen = Seen::of(factor * value, m);
                }
            }
        }
        let (was, is) = (baseline.residuals(&before), baseline.residuals(&after));
        for (was, is) in was.groups.iter().zip(&is.groups) {
            if is.family != SBL || is.tilt.is_none() {
                assert_eq!(was, is);
                continue;
            }
            assert_eq!(is.side, side, "{is:?}");
            assert!(is.p_value.expect("walls stand") < 0.02, "{is:?}");
            assert_eq!(is.in_sd.expect("values") > 0.0, side == Side::Above);
            assert!(was.side == Side::Within, "{was:?}");
        }
    }
}

#[test]
fn where_nearly_all_have_fallen_nothing_is_said() {
    let made = made();
    let (world, (mut design, measured)) = (made.world(), Design::of(&made.study));
    let late = radians(40.0);
    readings(&mut design).filter(|m| m.tilt.is_some()).for_each(|m| m.tilt = Some(late));
    let found = Baseline::new(&world, &design, 7).residuals(&measured);
    let reading = found.readings.iter().find(|r| r.family == SBL && r.reading.tilt.is_some()).expect("read");
    assert_eq!((reading.fallen, reading.expected, reading.in_sd), (1.0, None, None));
    let group = group(&found, SBL, MeasuredQuantity::DisplacementMean, Some(40.0));
    assert_eq!((group.fallen, group.p_value, group.side), (1.0, None, Side::Within));
    assert_eq!(group.measured.is_some(), reading.seen != Seen::Nothing);
}

#[test]
fn campaigns_of_one_truth_share_its_joints_and_not_their_stones() {
    let made = made();
    let (world, (design, _)) = (made.world(), Design::of(&made.study));
    let nested = Nested::new(&world, &design, 8);
    let angle = design.readings().position(|(family, m)| family == SBL && m.tilt.is_none()).expect("read");
    let by_truth = nested.each(|shown| shown.values[angle]);
    // Stones are one of the twenty nearest walls of the bank, and joints are as stiff as those of no other specimen.
    assert!(by_truth.iter().all(|sets| sets.len() == 2 && sets[0] != sets[1]));
    // Stones of 2 % and joints make the two differ by theirs times the root of two.
    let apart: Vec<f64> = by_truth.iter().map(|sets| sets[0] - sets[1]).collect();
    let sigma = degrees(stats::sigma(&apart).expect("many"));
    let wanted = 14.5 * (2.0 * (0.02_f64 * 0.02 + by_stiffness(&made) * by_stiffness(&made))).sqrt();
    assert!((sigma / wanted - 1.0).abs() < SAMPLED, "{sigma} {wanted}");
}

#[test]
fn bands_over_the_tilt_go_to_where_half_have_fallen_and_show_a_cause() {
    let made = made();
    let (world, (design, _)) = (made.world(), Design::of(&made.study));
    let truths: Vec<Truth> = (0..500).map(|k| world.stated(&Streams::new(9, k))).collect();
    let base = base_curves(&world, &design, 9);
    assert_eq!(base.iter().map(|family| family.family).collect::<Vec<_>>(), [0, 1, 2]);
    for family in &base {
        let [curve] = &family.curves[..] else { panic!("one quantity was read") };
        let (last, _) = curve.bands.last().expect("bands");
        assert_eq!((curve.bands.len(), *last), (61, family.collapse.expect("they fall").median));
        for (_, band) in &curve.bands {
            let order = [band.most[0], band.half[0], band.median, band.half[1], band.most[1]];
            assert!(order.is_sorted(), "{band:?}");
        }
    }
    let offset = made.mechanisms.iter().position(|m| m.name == "gauge_offset").expect("in the catalogue");
    let mut moved = truths.clone();
    // 20 mm is one standard deviation of the search prior.
    moved.iter_mut().for_each(|truth| (truth.causes, truth.parameters) = (Some(offset).into(), vec![1.0]));
    let with = over_the_tilt(&world, &design, &moved, 9);
    assert_eq!(with[SBL].collapse, base[SBL].collapse);
    for ((tilt, with), (_, base)) in with[SBL].curves[0].bands.iter().zip(&base[SBL].curves[0].bands) {
        assert!((with.median - base.median - 20e-3).abs() < 1e-9, "{tilt}: {with:?} {base:?}");
    }
}
