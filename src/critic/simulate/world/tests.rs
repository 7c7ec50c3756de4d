//! Campaigns of walls whose formula is known: what is seen of them.

use super::likely::{MayShow, NEIGHBOURS};
use crate::critic::fixture::{ALIKE, made};
use crate::critic::simulate::queries::Queries;
use crate::critic::simulate::{Campaign, Causes, Design, Scope, Seen, Truth};
use crate::math::radians;
use crate::random::Streams;
use crate::stats;
use crate::study::{MeasuredKind, MeasuredQuantity, Measurement};

#[test]
fn the_papers_campaign_is_nine_specimens_with_their_bounds() {
    let made = made();
    let (design, campaign) = Design::of(&made.study);
    assert_eq!(design.specimens.len(), 9);
    assert!(design.unused.is_empty() && design.apart.is_empty());
    let at = |name: &str| design.specimens.iter().position(|s| s.name == name).expect("it was tested");
    assert_eq!(campaign.specimens[at("CBL1")][1..], [Seen::Beyond; 3]);
    let Seen::Value(first) = campaign.specimens[at("SBL1")][1] else { panic!("it was read") };
    assert!((first - 0.019).abs() < 1e-12);
}

#[test]
fn a_campaign_has_the_errors_and_the_rounding_of_its_readings() {
    let made = made();
    let world = made.world();
    let (design, _) = Design::of(&made.study);
    let truth = world.drawn(None, &Streams::new(9, 0));
    let shown: Vec<Campaign> =
        (0..400).map(|k| world.campaign(&design, &truth, &Streams::new(9, k))).collect();
    assert_eq!(shown[0], world.campaign(&design, &truth, &Streams::new(9, 0)));
    let sbl = design.specimens.iter().position(|s| s.name == "SBL2").expect("it was tested");
    let angles = shown.iter().map(|c| match c.specimens[sbl][0] {
        Seen::Value(angle) => angle,
        other => panic!("{other:?}"),
    });
    for angle in angles {
        let steps = angle / radians(0.5);
        assert!((steps - steps.round()).abs() < 1e-9, "{angle}");
    }
    // The first reading of SBL2: 1.7 mm of error and the stones' own; in steps of 1 mm.
    let read: Vec<f64> =
        shown.iter().filter_map(|c| c.specimens[sbl][1].number(&design.specimens[sbl].readings[1])).collect();
    let sigma = crate::stats::sigma(&read).expect("many");
    assert!(sigma > 1.6e-3 && sigma < 2.1e-3, "{sigma}");
    // CBL stays below 5 mm at 5 deg in nearly every campaign: 2 mm and an error of 1.7.
    let cbl = design.specimens.iter().position(|s| s.name == "CBL1").expect("it was tested");
    let beyond = shown.iter().filter(|c| c.specimens[cbl][1] == Seen::Beyond).count();
    assert!(beyond > 300, "{beyond}");
}

#[test]
fn a_cause_that_changes_nothing_has_the_walls_of_the_base_model() {
    let made = made();
    let world = made.world();
    let (design, _) = Design::of(&made.study);
    let base = world.drawn(None, &Streams::new(9, 0));
    let with =
        |name: &str| Truth { causes: Some(made.cause(name)).into(), parameters: vec![0.3], ..base.clone() };
    let shown = |truth: &Truth| world.values(&design, truth, &Streams::new(9, 1));
    // To the rounding of a curve through nothing but zeros.
    let apart = |a: &[Vec<Option<f64>>], b: &[Vec<Option<f64>>]| {
        let pairs = a.iter().flatten().zip(b.iter().flatten());
        pairs.filter_map(|(a, b)| Some((a.as_ref()? - b.as_ref()?).abs())).fold(0.0, f64::max)
    };
    assert!(apart(&shown(&with("density")), &shown(&base)) < 1e-12);
    assert!(apart(&shown(&with("lean")), &shown(&base)) > 1e-2);
}

#[test]
fn walls_of_a_family_share_the_emulators_error_and_their_mean_scatters_by_it() {
    let made = made();
    let world = made.world();
    // Far out the curve through 90 walls is known badly.
    let mut truth = world.truth(None, &vec![0.0; world.inputs(None)]);
    truth.joints = vec![[3.0, -3.0, 3.0]; world.joint_kinds()];
    truth.scatter = ALIKE;
    let emulated = world.base[&1].emulator.emulated(&[2.0, -2.0, 2.0], NEIGHBOURS);
    let variance = |values: &[f64]| {
        let mean = values.iter().sum::<f64>() / values.len() as f64;
        values.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>() / values.len() as f64
    };
    let left = variance(&emulated.left.iter().map(|left| left[0]).collect::<Vec<_>>());
    let common = emulated.common[0];
    assert!(common > 0.1 && common < 0.8, "{common}");
    let likely = world.likely(1, &truth);
    let drawn: Vec<[f64; 3]> =
        (0..4000).map(|k| [0, 1, 2].map(|specimen| likely.wall(specimen, &Streams::new(31, k))[0])).collect();
    let of = |what: &dyn Fn(&[f64; 3]) -> f64| variance(&drawn.iter().map(what).collect::<Vec<_>>());
    // 4000 draws tell a variance to 2 %, those of 20 discrete ones to a little less.
    let alone = of(&|walls| walls[0]) / left;
    assert!((alone - 1.0).abs() < 0.1, "{alone}");
    let mean = of(&|walls| (walls[0] + walls[1] + walls[2]) / 3.0) / left;
    let expected = common + (1.0 - common) / 3.0;
    assert!((mean / expected - 1.0).abs() < 0.1, "{mean} {expected}");
    // As independent walls they are shown wider, so that the mean of three scatters so much.
    let (design, _) = Design::of(&made.study);
    let falls: Vec<&Measurement> = design
        .specimens
        .iter()
        .filter(|specimen| specimen.family == 1)
        .flat_map(|specimen| &specimen.readings)
        .filter(|m| m.quantity == MeasuredQuantity::CollapseAngle)
        .collect();
    let queries = Queries::by(&falls, None);
    let shown = |walls: usize| {
        let MayShow { paths, random, .. } = world.may_show(1, &queries, &truth, walls);
        assert!(random);
        variance(&paths.iter().map(|path| path[0]).collect::<Vec<_>>()) / left
    };
    // What is shared and what is not are those of other walls of the bank: twenty pairs correlate by chance.
    let ratio = shown(3) / (3.0 * expected);
    assert!((ratio - 1.0).abs() < 0.4 && shown(3) > shown(1), "{ratio} {} {}", shown(3), shown(1));
}

#[test]
fn a_weight_tells_of_the_density_and_of_nothing_else() {
    let mut made = made();
    let sbl = made.study.arms.iter().position(|arm| arm.name == "sbl").expect("a family");
    let mut weighed = made.study.measured[0].clone();
    (weighed.family, weighed.quantity) = ("sbl".to_owned(), MeasuredQuantity::SpecimenWeight);
    (weighed.tilt, weighed.value, weighed.error) = (None, 1250.0, 7.0);
    (weighed.kind, weighed.common_error) = (MeasuredKind::Exact, 0.0);
    made.study.measured.push(weighed);
    let world = made.world();
    let (design, campaign) = Design::of(&made.study);
    assert_eq!((design.apart.len(), campaign.apart[0]), (1, Seen::Value(1250.0)));
    assert_eq!((design.specimens.len(), design.apart[0].0), (9, sbl));
    let base = world.drawn(None, &Streams::new(9, 0));
    let weight = |name: &str| {
        let cause = Some(made.cause(name));
        let parameters = vec![-1.0; made.mechanisms[made.cause(name)].parameters.len()];
        world.values_apart(&design, &Truth { causes: cause.into(), parameters, ..base.clone() })[0]
    };
    // Table 1 of the source paper: 1371 N.
    let stated = world.values_apart(&design, &base)[0];
    assert!((stated - 1371.0).abs() < 0.1, "{stated}");
    let factor = made.mechanisms[made.cause("density")].parameters[0].search.at_score(-1.0);
    assert!((weight("density") / stated - factor).abs() < 1e-12 && factor < 1.0);
    assert_eq!([weight("lean"), weight("contact_area")], [stated; 2]);
}

#[test]
fn an_error_of_which_nobody_knows_how_much_is_shared_is_drawn_and_fitted_as_such() {
    let made = made();
    let (world, (mut design, _)) = (made.world(), Design::of(&made.study));
    let joints = vec![0.0; world.inputs(None)];
    let truth = world.truth(None, &joints);
    // Readings whose error is all that differs: 6 mm, on walls that move by 2 % of as much.
    design.specimens.retain(|specimen| specimen.family == 1);
    for m in design.specimens.iter_mut().flat_map(|specimen| &mut specimen.readings) {
        (m.kind, m.resolution) = (MeasuredKind::Exact, 0.0);
        if m.tilt.is_some() {
            let half = 6e-3 * 0.5_f64.sqrt();
            (m.error, m.common_error, m.unknown_share) = (half, half, true);
        }
    }
    let off = |k: u64| -> Vec<f64> {
        let streams = Streams::new(15, k);
        let (values, shown) =
            (world.values(&design, &truth, &streams), world.campaign(&design, &truth, &streams));
        let rows = values.iter().zip(&shown.specimens).zip(&design.specimens);
        rows.flat_map(|((values, seen), specimen)| {
            values.iter().zip(seen).zip(&specimen.readings).filter_map(|((value, seen), m)| {
                match (value, seen) {
                    (Some(value), Seen::Value(seen)) if m.tilt.is_some() => Some(seen - value),
                    _ => None,
                }
            })
        })
        .collect()
    };
    let offs: Vec<Vec<f64>> = (0..600).map(off).collect();
    let whole: Vec<f64> = offs.concat();
    let sigma = stats::sigma(&whole).expect("many");
    assert!((sigma / 6e-3 - 1.0).abs() < 0.05, "{sigma}");
    // In the mean half of the variance is shared, in single campaigns nearly none or nearly all.
    let scatter: Vec<f64> =
        offs.iter().filter_map(|off| stats::sigma(off)).map(|s| s * s / (6e-3 * 6e-3)).collect();
    let mean = stats::mean(&scatter).expect("many");
    assert!((mean - 0.5).abs() < 0.05, "{mean}");
    // Of six readings a scatter below a fifth of the error has a chance of 0.8 % where half is shared, of 8 % with any share.
    let little = scatter.iter().filter(|s| **s < 0.05).count();
    assert!((25..80).contains(&little), "{little}");
    // A campaign that is off by 12 mm throughout is no finding then, and it is if nothing of the error is shared.
    let evidence_of = |design: &Design| {
        let values = world.values(design, &truth, &Streams::new(15, 3));
        let rows = values.iter().zip(&design.specimens).map(|(values, specimen)| {
            let one = |(value, m): (&Option<f64>, &Measurement)| match value {
                Some(value) if m.tilt.is_some() => Seen::Value(value + 12e-3),
                Some(value) => Seen::Value(*value),
                None => Seen::Nothing,
            };
            values.iter().zip(&specimen.readings).map(one).collect()
        });
        let shown = Campaign { specimens: rows.collect(), apart: Vec::new() };
        let creep = Some(made.cause("creep"));
        [None, creep].map(|cause| crate::critic::evidence(&world, design, &shown, cause, 3).log)
    };
    let [base, creep] = evidence_of(&design);
    let unknown = creep - base;
    design.specimens.iter_mut().flat_map(|s| &mut s.readings).filter(|m| m.tilt.is_some()).for_each(|m| {
        (m.error, m.common_error, m.unknown_share) = (6e-3, 0.0, false);
    });
    let [base, creep] = evidence_of(&design);
    println!("{unknown} {}", creep - base);
    assert!(unknown < creep - base - 1.0, "{unknown} {}", creep - base);
}

#[test]
fn an_error_of_a_gauge_is_shared_by_all_its_points_and_by_a_target_that_does_not_move() {
    let made = made();
    let (world, (mut design, _)) = (made.world(), Design::of(&made.study));
    let truth = Truth { scatter: ALIKE, ..world.truth(None, &vec![0.0; world.inputs(None)]) };
    use MeasuredQuantity as Q;
    let common = 5e-3;
    let read = |m: &Measurement, quantity| Measurement {
        quantity,
        kind: MeasuredKind::Exact,
        resolution: 0.0,
        error: 1e-5,
        common_error: common,
        ..m.clone()
    };
    design.specimens.truncate(1);
    let own = &mut design.specimens[0].readings;
    let first = own.iter().find(|m| m.tilt.is_some()).expect("it is read").clone();
    let quantities = [Q::DisplacementLeft, Q::DisplacementCentre, Q::DisplacementRight, Q::RemainderMean];
    *own = quantities.map(|quantity| read(&first, quantity)).to_vec();
    own.push(Measurement { common_error: 0.0, ..read(&first, Q::DisplacementCentreMinusEnds) });
    own.push(Measurement { tilt: None, ..read(&first, Q::CollapseAngle) });
    design.apart = vec![(0, Measurement { tilt: None, ..read(&first, Q::FixedTarget) })];
    let campaigns: Vec<[f64; 7]> = (0..200)
        .map(|k| {
            let streams = Streams::new(16, k);
            let (values, seen) =
                (world.values(&design, &truth, &streams), world.campaign(&design, &truth, &streams));
            let values = values.concat().into_iter().chain([Some(0.0)]);
            let off: Vec<f64> = values
                .zip(seen.seen())
                .map(|(value, seen)| match (value, seen) {
                    (Some(value), Seen::Value(seen)) => seen - value,
                    other => panic!("{other:?}"),
                })
                .collect();
            off.try_into().expect("seven")
        })
        .collect();
    for off in &campaigns {
        for k in [1, 2, 3, 6] {
            // Each reading is off by 0.01 mm alone: seven standard deviations of a difference.
            assert!((off[k] - off[0]).abs() < 1e-4, "{off:?}");
        }
        // A difference of points is free of it, and a collapse angle has its own.
        assert!(off[4].abs() < 1e-4 && (off[5] - off[0]).abs() > 1e-6, "{off:?}");
    }
    let sigma = stats::sigma(&campaigns.iter().map(|off| off[0]).collect::<Vec<_>>()).expect("many");
    assert!((sigma / common - 1.0).abs() < 0.15, "{sigma}");
    // Points that are off together are no surprise; against each other they are.
    let truths = [truth];
    let likely = |off: [f64; 4]| {
        let values = world.values(&design, &truths[0], &Streams::new(16, 0));
        let own = values[0].iter().zip(off.into_iter().chain([0.0, 0.0]));
        let seen = own.map(|(value, off)| Seen::Value(value.expect("it stands") + off)).collect();
        let shown = Campaign { specimens: vec![seen], apart: vec![Seen::Value(off[3])] };
        crate::critic::evidence(&world, &design, &shown, None, 3).log
    };
    let (together, apart) = (likely([4e-3; 4]), likely([4e-3, -4e-3, 4e-3, -4e-3]));
    assert!(together > apart + 10.0, "{together} {apart}");
}

#[test]
fn a_bound_on_a_test_of_two_stones_says_its_side_and_no_more() {
    let made = made();
    let (world, (mut design, mut shown)) = (made.world(), Design::of(&made.study));
    let mut kn = design.specimens[0].readings[0].clone();
    (kn.quantity, kn.tilt, kn.resolution) = (MeasuredQuantity::JointKn, None, 0.0);
    (kn.kind, kn.error, kn.value) = (MeasuredKind::Above, 1e6, 1e4);
    design.apart = vec![(0, kn)];
    shown.apart = vec![Seen::Beyond];
    let found = |design: &Design, shown: &Campaign| {
        let found = crate::critic::evidence(&world, design, shown, None, 3);
        let kn: Vec<f64> = found.draws.iter().map(|draw| world.values_apart(design, draw)[0]).collect();
        (found.log, [0.1, 0.5, 0.9].map(|p| stats::quantile(&kn, p).expect("many")))
    };
    let none = Campaign { apart: vec![Seen::Nothing], ..shown.clone() };
    // That it is above next to nothing changes nothing.
    assert_eq!(found(&design, &shown), found(&design, &none));
    let (_, [low, middle, high]) = found(&design, &none);
    assert!(low < 0.95 * middle, "{low} {middle} {high}");
    // That it is above what the other readings say leaves the upper half, as far as it reaches.
    design.apart[0].1.value = middle;
    let (_, [above, _, furthest]) = found(&design, &shown);
    assert!(above > 0.98 * middle && furthest > 0.98 * high, "{above} {furthest} {high}");
}

#[test]
fn a_fixed_target_tells_of_the_gauge_and_of_nothing_else() {
    let mut made = made();
    let mut still = made.study.measured[0].clone();
    (still.quantity, still.tilt, still.value) = (MeasuredQuantity::FixedTarget, None, 5.2e-3);
    (still.kind, still.error, still.common_error) = (MeasuredKind::Exact, 3e-4, 0.0);
    made.study.measured.push(still);
    let world = made.world();
    let (design, campaign) = Design::of(&made.study);
    assert_eq!((design.specimens.len(), &campaign.apart[..]), (9, &[Seen::Value(5.2e-3)][..]));
    let shown = |name: &str| {
        let cause = made.cause(name);
        let parameters = vec![1.0; made.mechanisms[cause].parameters.len()];
        let truth =
            Truth { causes: Some(cause).into(), parameters, ..world.drawn(None, &Streams::new(9, 0)) };
        world.values_apart(&design, &truth)[0]
    };
    let offset = made.mechanisms[made.cause("gauge_offset")].parameters[0].search.at_score(1.0);
    assert_eq!((shown("gauge_offset"), shown("gauge_scale"), shown("creep")), (offset, 0.0, 0.0));
}

#[test]
fn what_had_fallen_shows_nothing() {
    let made = made();
    let world = made.world();
    let (design, _) = Design::of(&made.study);
    let sbl = design.specimens.iter().position(|s| s.name == "SBL2").expect("it was tested");
    let mut late = design.clone();
    late.specimens[sbl].readings[1].tilt = Some(radians(40.0));
    let campaign = world.campaign(&late, &world.drawn(None, &Streams::new(1, 1)), &Streams::new(1, 1));
    assert_eq!(campaign.specimens[sbl][1], Seen::Nothing);
}

#[test]
fn a_gauge_that_has_moved_shows_in_every_reading_and_in_no_angle() {
    let made = made();
    let world = made.world();
    let (mut design, _) = Design::of(&made.study);
    for m in design.specimens.iter_mut().flat_map(|s| &mut s.readings) {
        (m.error, m.kind) = (0.0, MeasuredKind::Exact);
    }
    let base = world.drawn(None, &Streams::new(2, 0));
    let offset = made.cause("gauge_offset");
    let mut moved = base.clone();
    // 20 mm is one standard deviation of the search prior.
    (moved.causes, moved.parameters) = (Some(offset).into(), vec![1.0]);
    let (before, after) = (
        world.campaign(&design, &base, &Streams::new(2, 0)),
        world.campaign(&design, &moved, &Streams::new(2, 0)),
    );
    for (specimen, (before, after)) in
        design.specimens.iter().zip(before.specimens.iter().zip(&after.specimens))
    {
        for (m, pair) in specimen.readings.iter().zip(before.iter().zip(after)) {
            let (Seen::Value(a), Seen::Value(b)) = pair else { panic!("all stand: {pair:?}") };
            let expected = match m.quantity {
                MeasuredQuantity::DisplacementMean => 20e-3,
                _ => 0.0,
            };
            assert!((b - a - expected).abs() < 1e-9, "{:?}: {a} {b}", m.quantity);
        }
    }
}

#[test]
fn what_is_left_after_going_back_tells_of_creep_and_of_the_gauge() {
    let mut made = made();
    let left = Measurement {
        quantity: MeasuredQuantity::RemainderMean,
        tilt: Some(radians(8.0)),
        kind: MeasuredKind::Exact,
        value: 1e-3,
        error: 0.3e-3,
        common_error: 0.0,
        resolution: 0.0,
        ..made.study.measured.iter().find(|m| m.specimen == "SBL1").expect("it was tested").clone()
    };
    made.study.measured.push(left.clone());
    let world = made.world();
    let (design, campaign) = Design::of(&made.study);
    let sbl = design.specimens.iter().position(|s| s.name == "SBL1").expect("it was tested");
    let last = design.specimens[sbl].readings.len() - 1;
    assert!(design.unused.is_empty());
    assert_eq!(
        (&design.specimens[sbl].readings[last], campaign.specimens[sbl][last]),
        (&left, Seen::Value(1e-3))
    );
    let base = world.drawn(None, &Streams::new(9, 0));
    let shown = |name: &str| {
        let cause = Some(made.cause(name));
        let parameters = vec![1.0; made.mechanisms[made.cause(name)].parameters.len()];
        let truth = Truth { causes: cause.into(), parameters, ..base.clone() };
        let values = world.values(&design, &truth, &Streams::new(9, 1));
        // What the likelihood takes for possible lies around it.
        let queries = Queries::by(&[&left], None);
        let paths = world.may_show(1, &queries, &truth, 1).paths;
        let possible: Vec<f64> = paths.iter().map(|path| path[0]).collect();
        let value = values[sbl][last].expect("it stands");
        let (mean, sigma) = (stats::mean(&possible).expect("many"), stats::sigma(&possible).expect("many"));
        assert!((value - mean).abs() < 4.0 * sigma + 1e-12, "{name}: {value:e} of {mean:e} +- {sigma:e}");
        value
    };
    let offset = made.mechanisms[made.cause("gauge_offset")].parameters[0].search.at_score(1.0);
    assert_eq!(shown("cohesion"), 0.0);
    assert!((shown("gauge_offset") - offset).abs() < 1e-15);
    // Of a wall of which so large a share of all movement creeps.
    assert!(shown("creep") > 1e-3, "{:e}", shown("creep"));
}

#[test]
fn a_specimen_that_is_turned_round_leans_the_other_way() {
    let made = made();
    let world = made.world();
    let (mut design, _) = Design::of(&made.study);
    assert!((0..3).all(|family| world.can_turn(family)));
    let truth = |score: f64| {
        let mut truth = world.drawn(Some(made.cause("lean")), &Streams::new(9, 0));
        truth.parameters = vec![score];
        world.values(&design, &truth, &Streams::new(9, 1))
    };
    let [downhill, uphill] = [truth(1.0), truth(-1.0)];
    assert_ne!(downhill, uphill);
    let mut turned = world.drawn(Some(made.cause("lean")), &Streams::new(9, 0));
    turned.parameters = vec![1.0];
    design.specimens.iter_mut().for_each(|specimen| specimen.turned = true);
    assert_eq!(world.values(&design, &turned, &Streams::new(9, 1)), uphill);
    // What has no side shows the same.
    let creeps = world.drawn(Some(made.cause("creep")), &Streams::new(9, 0));
    let round = world.values(&design, &creeps, &Streams::new(9, 1));
    design.specimens.iter_mut().for_each(|specimen| specimen.turned = false);
    assert_eq!(world.values(&design, &creeps, &Streams::new(9, 1)), round);
}

#[test]
fn truths_under_which_walls_do_not_stand_are_neither_drawn_nor_found() {
    let made = made();
    let lean = made.cause("lean");
    let made = made.falling(lean, 0.8);
    let world = made.world();
    // Lean has one parameter; at the quantile 0.8 its score is 0.84, and the nearest wall decides within its distance of that.
    let at = |own: f64| Truth { parameters: vec![own], ..world.drawn(Some(lean), &Streams::new(9, 0)) };
    assert!(world.stands(&at(0.2)) && !world.stands(&at(2.0)));
    assert!(world.stands(&world.drawn(None, &Streams::new(9, 0))));
    let drawn: Vec<Truth> = (0..500).map(|k| world.drawn(Some(lean), &Streams::new(17, k))).collect();
    assert!(drawn.iter().all(|truth| world.stands(truth)));
    let beyond = drawn.iter().filter(|truth| truth.parameters[0] > 1.3).count();
    // Of a standard normal score one in ten lies there.
    assert!(beyond < 10, "{beyond} of 500");
    let (design, campaign) = Design::of(&made.study);
    let found = crate::critic::evidence(&world, &design, &campaign, Some(lean), 3);
    assert!(found.log.is_finite() && found.draws.iter().all(|draw| world.stands(draw)));
}

#[test]
fn a_cause_that_acts_on_joints_may_act_on_those_of_one_kind() {
    let made = made();
    let area = made.cause("contact_area");
    let mut made = made.moving(area);
    let (design, _) = Design::of(&made.study);
    {
        let world = made.world();
        let (blocks, stones) = (Scope::Kind(world.kind(0)), Scope::Kind(world.kind(1)));
        let sixth = 0.5 / 3.0;
        assert_eq!(
            world.scopes(area),
            [(Scope::All, 0.5), (blocks, sixth), (stones, sixth), (Scope::Each, sixth)]
        );
        // What holds or loads a wall acts on every one.
        for name in ["creep", "base_compliance", "gauge_offset"] {
            assert_eq!(world.scopes(made.cause(name)), [(Scope::All, 1.0)], "{name}");
        }
        let shown = |causes: Causes, parameters: &[f64]| {
            let parameters = parameters.to_vec();
            let truth = Truth { causes, parameters, ..world.drawn(None, &Streams::new(9, 0)) };
            world.values(&design, &truth, &Streams::new(9, 1))
        };
        let one = |scope: Scope| Causes::one(area, scope);
        let [base, all, weak] =
            [(Causes::default(), &[][..]), (one(Scope::All), &[1.0]), (one(Scope::All), &[-1.0])]
                .map(|(causes, parameters)| shown(causes, parameters));
        // Three specimens of the blocks, then six of the stones.
        let both =
            |blocks: &[Vec<Option<f64>>], stones: &[Vec<Option<f64>>]| [&blocks[..3], &stones[3..]].concat();
        assert!(design.specimens.iter().map(|own| own.family).eq([0, 0, 0, 1, 1, 1, 2, 2, 2]));
        assert_eq!(shown(one(stones), &[1.0]), both(&base, &all));
        assert_eq!(shown(one(blocks), &[1.0]), both(&all, &base));
        assert_eq!(shown(one(Scope::Each), &[-1.0, 1.0]), both(&weak, &all));
        // Scopes are drawn as often as they are likely.
        let drawn = |scope: Scope| {
            (0..3000).filter(|&k| world.scoped(Some(area), &Streams::new(3, k)) == one(scope)).count()
        };
        let counts = [Scope::All, blocks, stones, Scope::Each].map(drawn);
        // 1500 +- 27, and 500 +- 20 of each of the others.
        assert!(
            counts[0].abs_diff(1500) < 90 && counts[1..].iter().all(|n| n.abs_diff(500) < 65),
            "{counts:?}"
        );
    }
    // Joints of one kind: a cause acts on them or does not.
    let arms = &mut made.study.arms;
    (arms[0].joint, arms[0].kn_points) = (arms[1].joint.clone(), arms[1].kn_points.clone());
    let world = made.world();
    for cause in world.causes() {
        assert_eq!(world.scopes(cause), [(Scope::All, 1.0)]);
        assert_eq!(world.scoped(Some(cause), &Streams::new(3, 1)), Some(cause).into());
    }
}

#[test]
fn specimens_in_which_nothing_else_is_drawn_differ_by_their_stiffness() {
    let made = made();
    let world = made.world();
    let (design, _) = Design::of(&made.study);
    let blocks: Vec<usize> = (0..9).filter(|k| design.specimens[*k].family == 0).take(2).collect();
    let readings = &design.specimens[blocks[0]].readings;
    let fall = readings.iter().position(|m| m.quantity == MeasuredQuantity::CollapseAngle).expect("it fell");
    let at = |scatter: f64| Truth { scatter, ..world.truth(None, &vec![0.0; world.inputs(None)]) };
    let falls = |scatter: f64, k: u64| {
        let values = world.values(&design, &at(scatter), &Streams::new(43, k));
        [blocks[0], blocks[1]].map(|specimen| values[specimen][fall].expect("it falls"))
    };
    assert!((0..20).map(|k| falls(ALIKE, k)).all(|[one, other]| one == other));
    // The logarithm of the angle goes with 0.05 of the score of kn.
    let kn = |score: f64| crate::math::ln(made.nuisances[0].prior.at_score(score));
    let expected = radians(19.0) * 0.05 / ((kn(0.2) - kn(-0.2)) / 0.4) * at(0.0).stiffness_scatter();
    let off: Vec<f64> = (0..2000)
        .map(|k| {
            let [one, other] = falls(0.0, k);
            (one - other) / 2.0_f64.sqrt()
        })
        .collect();
    let seen = stats::sigma(&off).expect("many") / expected;
    assert!((seen - 1.0).abs() < 0.1, "{seen}");
    // The likelihood knows it, and that all else is one path.
    let queries = Queries::by(&[&readings[fall]], None);
    let MayShow { random, by_stiffness, .. } = world.may_show(0, &queries, &at(0.0), 3);
    assert!(!random && (by_stiffness[0] / expected - 1.0).abs() < 0.1, "{by_stiffness:?} {expected}");
    assert!((at(0.0).stiffness_scatter() - 0.2 * 0.67449).abs() < 1e-5);
}

#[test]
fn a_stiffer_specimen_is_stiffer_in_every_part_of_its_law() {
    let made = made();
    let closure = made.cause("joint_closure");
    // The stiffer the joints are at first, the further walls move: no wall does, and so it is seen.
    let made = made.moving(closure);
    let world = made.world();
    let (design, _) = Design::of(&made.study);
    let mut left = design.specimens.iter().find(|s| s.family == 1).expect("stones").readings[0].clone();
    (left.quantity, left.tilt) = (MeasuredQuantity::DisplacementLeft, Some(0.1));
    let queries = Queries::by(&[&left], None);
    let relative = |cause: Option<usize>| {
        let truth = world.truth(cause, &vec![0.0; world.inputs(cause)]);
        let MayShow { paths, by_stiffness, .. } = world.may_show(1, &queries, &truth, 1);
        let shown: Vec<f64> = paths.iter().map(|path| path[0]).collect();
        by_stiffness[0] / stats::mean(&shown).expect("many") / truth.stiffness_scatter()
    };
    let slope = |of: &dyn Fn(f64) -> f64| (crate::math::ln(of(0.2)) - crate::math::ln(of(-0.2))) / 0.4;
    let kn = slope(&|score| made.nuisances[0].prior.at_score(score));
    let initial = slope(&|score| made.mechanisms[closure].parameters[0].search.at_score(score));
    // By kn displacements go down, by the initial stiffness up: four times the normal density, whose top is 0.4.
    let (plain, both) = (-0.4 / kn, -0.4 / kn + 4.0 * 0.399 / initial);
    let (seen, with_closure) = (relative(None), relative(Some(closure)));
    assert!((seen / plain - 1.0).abs() < 0.15, "{seen} {plain}");
    assert!((with_closure / both - 1.0).abs() < 0.25, "{with_closure} {both}");
}
