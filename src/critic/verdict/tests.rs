//! What is found of what is hidden in campaigns, and whether anything is where nothing is.

use crate::critic::causes::evidence;
use crate::critic::fixture::{EFFORT, judged, made};
use crate::critic::simulate::{Campaign, Causes, Design, Scope, Seen, Truth};
use crate::critic::verdict::{Judge, Limits, Verdict};
use crate::random::Streams;
use crate::stats;

#[test]
fn little_is_found_where_nothing_is_hidden_also_with_joints_far_out_in_their_priors() {
    let made = made();
    let (world, (design, _)) = (made.world(), Design::of(&made.study));
    let judge = Judge::trained(&world, &design, EFFORT, 77).expect("it can be told");
    let found = |far: f64, seed: u64| {
        let is_found = |k: u64| {
            let streams = Streams::new(seed, k);
            let mut truth = world.stated(&streams);
            truth.joints.iter_mut().filter(|_| far > 0.0).for_each(|joints| joints[0] = far);
            judge.compare(&world.campaign(&design, &truth, &streams)).p_value < 0.05
        };
        (0..300).filter(|&k| is_found(k)).count()
    };
    let (within, beyond) = (found(0.0, 78), found(2.0, 79));
    println!("{within} and {beyond} of 300");
    // 5 % of 300 are 15 +- 3.8; three sigma of it, and of the 1,000 that set the limit. With joints as they are stated, and
    // their priors widened further than that, it is less.
    assert!(within <= 28, "{within}");
    // kn lies two of its standard deviations from where it is thought to be: the joints take it up.
    assert!(beyond <= 40, "{beyond}");
}

#[test]
fn what_is_like_no_cause_is_seen_to_be_unmodelled() {
    let (made, judge) = judged();
    let (world, design) = (judge.world, &judge.design);
    let creep = Some(made.cause("creep"));
    // Mean probability over the campaigns, drawn with another seed than the judge's, in which something is found.
    let unmodelled = |campaign: &dyn Fn(&Streams) -> Campaign| {
        let findings = (0..100).map(|k| judge.compare(&campaign(&Streams::new(43, k))));
        let found: Vec<f64> = findings
            .filter(|finding| finding.p_value < 0.05)
            .map(|finding| {
                let sum = finding.ranked.causes.iter().fold(finding.ranked.unmodelled, |sum, (_, p)| sum + p);
                assert!((sum - 1.0).abs() < 1e-9, "{sum}");
                finding.ranked.unmodelled
            })
            .collect();
        stats::mean(&found).expect("some are found")
    };
    let own = unmodelled(&|streams| world.campaign(design, &world.drawn(creep, streams), streams));
    let others = unmodelled(&|streams| world.unmodelled(design, streams));
    println!("{own} of creep, {others} of others");
    // 0.06 and 0.30: the paper's few readings leave it mostly open what they show.
    assert!(own < 0.12 && others > 0.2, "{own} {others}");
}

#[test]
fn what_looks_like_no_cause_is_no_veto_where_a_cause_fits() {
    let (made, judge) = judged();
    let (world, design) = (judge.world, &judge.design);
    let (creep, limits) = (made.cause("creep"), Limits::default());
    let streams = Streams::new(31, 1);
    let mut truth = world.drawn(Some(creep), &streams);
    truth.parameters[0] = 1.5;
    let diagnosed = |campaign: &Campaign| {
        let mut examination = judge.rank(judge.compare(campaign), campaign, &limits, 1);
        examination.finding.ranked = examination.finding.ranked.beside(0.95);
        judge.check(examination, campaign, &limits, 1)
    };
    let fits = diagnosed(&world.campaign(design, &truth, &streams));
    println!("{:?} {} {:?}", fits.verdict, fits.finding.ranked.unmodelled, fits.outside);
    assert_eq!(fits.verdict.named(), [creep]);
    assert!(fits.finding.ranked.unmodelled < 0.2 && fits.outside.expect("found") < 0.0);
    // Where none fits, it is as likely as it looks.
    let base = world.drawn(None, &streams);
    let other = one_moves_alone(design, world.campaign(design, &base, &streams));
    let found = diagnosed(&other);
    println!("{:?} {} {:?}", found.verdict, found.finding.ranked.unmodelled, found.outside);
    assert_eq!(found.verdict, Verdict::Unexplained);
    assert!((found.finding.ranked.unmodelled - 0.95).abs() < 1e-9);
}

/// The same campaign, but one specimen of each family moves, and far.
fn one_moves_alone(design: &Design, mut campaign: Campaign) -> Campaign {
    for (specimen, seen) in design.specimens.iter().zip(&mut campaign.specimens) {
        for (m, seen) in specimen.readings.iter().zip(seen).filter(|(m, _)| m.tilt.is_some()) {
            if let (true, Seen::Value(value)) = (specimen.name.ends_with('1'), &*seen) {
                *seen = Seen::of(value + 0.15, m);
            }
        }
    }
    campaign
}

#[test]
#[ignore = "slow: 80 s of processor time"]
fn a_cause_outside_the_catalogue_is_not_given_the_name_of_one_inside() {
    let (made, judge) = judged();
    let (world, design) = (judge.world, &judge.design);
    let limits = Limits::default();
    let creep = made.cause("creep");
    let (mut right, mut wrongly, mut unexplained) = (0, 0, 0);
    for k in 0..10 {
        let streams = Streams::new(31, k);
        let mut truth = world.drawn(Some(creep), &streams);
        truth.parameters[0] = 1.5;
        let shown = world.campaign(design, &truth, &streams);
        right += usize::from(judge.diagnosed(&shown, &limits, 1).verdict.named() == [creep]);
        // One specimen of each family moves, and far; creep would move all of them.
        let base = world.drawn(None, &streams);
        let other = one_moves_alone(design, world.campaign(design, &base, &streams));
        match judge.diagnosed(&other, &limits, 1).verdict {
            Verdict::Unexplained => unexplained += 1,
            verdict if !verdict.named().is_empty() => wrongly += 1,
            _ => {}
        }
    }
    println!("{right} of 10 named; of the others {wrongly} named, {unexplained} unexplained");
    // 37 of 40 are named, and none of 40 others.
    assert!(right > 6, "{right}");
    assert!(wrongly < 2 && unexplained > 6, "{wrongly} {unexplained}");
}

#[test]
#[ignore = "slow: 80 s of processor time"]
fn two_causes_that_act_together_are_named_together_and_one_alone_is_not() {
    let (made, judge) = judged();
    let (world, design) = (judge.world, &judge.design);
    let (creep, lean) = (made.cause("creep"), made.cause("lean"));
    let pair = Causes::pair(creep, lean);
    assert_eq!((pair, pair.each().collect::<Vec<_>>()), (Causes::pair(lean, creep), vec![lean, creep]));
    let (mut together, mut named, mut alone) = (0, 0, 0);
    for k in 0..8 {
        let streams = Streams::new(37, k);
        let mut truth = world.drawn(pair, &streams);
        // The wall leans downhill, and creeps: it moves far and falls early.
        truth.parameters[..2].copy_from_slice(&[1.5, 1.5]);
        let shown = world.campaign(design, &truth, &streams);
        let found = judge.diagnosed(&shown, &Limits::default(), 1);
        println!("{:?} {:?}", found.verdict, found.pairs.first().map(|pair| (pair.evidence, pair.check)));
        // Where one of the two explains all that is seen, it is named alone.
        let best = found.pairs.first().map(|best| best.cause);
        together += usize::from(best.map_or(found.verdict.named() == [creep], |best| best == [lean, creep]));
        named += usize::from(found.verdict == Verdict::NamedPair([lean, creep]));
        if let Verdict::NamedPair(_) = found.verdict {
            let [(causes, draws)] = &found.explained_by()[..] else { panic!("the pair") };
            assert_eq!(
                (&causes[..], draws[0].parameters.len()),
                (&[lean, creep][..], truth.parameters.len())
            );
        }
        let one = world.campaign(
            design,
            &Truth { causes: Some(creep).into(), parameters: truth.parameters[1..].to_vec(), ..truth },
            &streams,
        );
        alone += usize::from(matches!(
            judge.diagnosed(&one, &Limits::default(), 1).verdict,
            Verdict::NamedPair(_)
        ));
    }
    println!(
        "{together} of 8 best together or one of them named, {named} named together, {alone} of 8 alone"
    );
    assert!(together == 8 && named > 0 && alone == 0, "{together} {named} {alone}");
}

#[test]
fn a_cause_that_acts_on_the_joints_of_the_stones_alone_is_seen_to_act_there() {
    let made = made();
    let area = made.cause("contact_area");
    let made = made.moving(area);
    let (world, (design, _)) = (made.world(), Design::of(&made.study));
    let judge = Judge::trained(&world, &design, EFFORT, 78).expect("it can be told");
    // Blocks, then both families of stones.
    assert_eq!([0, 1, 2].map(|family| world.kind(family)), [0, 1, 1]);
    let streams = Streams::new(51, 2);
    let on_stones = Causes::one(area, Scope::Kind(1));
    let mut truth = world.drawn(on_stones, &streams);
    truth.parameters[0] = 1.0;
    let shown = world.campaign(&design, &truth, &streams);
    let log = |scope: Scope| evidence(&world, &design, &shown, Causes::one(area, scope), 3).log;
    let [stones, blocks, all] = [Scope::Kind(1), Scope::Kind(0), Scope::All].map(log);
    assert!(stones > all + 5.0 && stones > blocks + 5.0, "{stones} {blocks} {all}");
    let diagnosis = judge.diagnosed(&shown, &Limits::default(), 1);
    let examined = diagnosis.examined(area).expect("it has the evidence");
    println!("{:?} {:?} {:?} {:?}", diagnosis.verdict, examined.acting, examined.scope_share, examined.check);
    let stones = Causes::one(area, Scope::Kind(1));
    assert!(examined.acting == stones && examined.scope_share > 0.5, "{:?}", examined.acting);
    assert!(examined.draws.iter().all(|draw| draw.causes == on_stones));
    assert!(examined.check.is_some_and(|p| p > 0.05), "{:?}", examined.check);
}
