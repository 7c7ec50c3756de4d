//! published.toml: statements of others, checked against the arms of the study.

use crate::study::checked::{Claim, ClaimTest};
use crate::study::keys;
use crate::study::raw::Node;
use crate::study::reader::{Notes, Reader};
use crate::study::schema::{Short, suggestion};

/// Reads all statements; `arms` is `None` when the study's arms are faulty themselves.
pub fn read(root: &Node, arms: Option<&[String]>, notes: &mut Notes) -> Vec<Claim> {
    let Some(mut top) = Reader::open(root, "", &keys::PUBLISHED, notes) else { return Vec::new() };
    let mut claims = Vec::new();
    for (node, path) in top.tables("claim") {
        let claim = Reader::open(&node, &path, &keys::CLAIM, top.notes).and_then(|mut t| claim(&mut t, arms));
        claims.extend(claim);
    }
    claims
}

fn claim(t: &mut Reader<'_>, arms: Option<&[String]>) -> Option<Claim> {
    let (claim, source, why) = (t.text("claim"), t.text("source"), t.text("why"));
    let test = test(t, arms);
    Some(Claim { claim: claim?, source: source?, test: test?, why: why? })
}

fn test(t: &mut Reader<'_>, arms: Option<&[String]>) -> Option<ClaimTest> {
    let chosen = t.chosen()?;
    match chosen {
        "falls_with_kn" => return Some(ClaimTest::FallsWithKn),
        "rises_with_kn" => return Some(ClaimTest::RisesWithKn),
        _ => {}
    }
    let arm = arm_name(t, "arm", arms);
    match chosen {
        "ratio_of_means" => {
            let over = arm_name(t, "over", arms);
            if arm.is_some() && arm == over {
                t.fault("over", "another arm than above the line", "name the arm to compare with");
            }
            let (stated, [low, high]) = number(t)?;
            Some(ClaimTest::RatioOfMeans { arm: arm?, over: over?, stated, low, high })
        }
        "ratio_of_sines" => {
            let over = arm_name(t, "over", arms);
            let (at_kn, number) = (at_kn(t), number(t));
            let (stated, [low, high]) = number?;
            Some(ClaimTest::RatioOfSines { arm: arm?, over: over?, at_kn: at_kn?, stated, low, high })
        }
        "mean" => {
            let (at_kn, number) = (at_kn(t), number(t));
            let (stated, [low, high]) = number?;
            Some(ClaimTest::Mean { arm: arm?, at_kn: at_kn?, stated, low, high })
        }
        "mechanism" => mechanism(t, arm),
        "cov" => {
            let (stated, band) = (t.text("stated"), band(t));
            let [low, high] = band?;
            Some(ClaimTest::Cov { arm: arm?, stated: stated?, low, high })
        }
        "between" => {
            let of = t.name_pair("of")?;
            for name in &of {
                check_arm(t, "of", name, arms);
            }
            Some(ClaimTest::Between { arm: arm?, of })
        }
        other => {
            crate::check!(false, "the test `{other}` of the key table is not read");
            None
        }
    }
}

/// A value stated and the band that counts as reproduced, which must hold it.
fn number(t: &mut Reader<'_>) -> Option<(f64, [f64; 2])> {
    let (stated, band) = (t.real("stated"), band(t));
    let (stated, [low, high]) = (stated?, band?);
    if stated < low || stated > high {
        t.fault(
            "stated",
            format!("within low to high, {low} to {high}"),
            "the band must hold the value stated",
        );
    }
    Some((stated, [low, high]))
}

/// The kn that is meant, if it is one; `None` where it is faulty.
fn at_kn(t: &mut Reader<'_>) -> Option<Option<f64>> {
    if t.has("at_kn_pa_per_m") { t.real("at_kn_pa_per_m").map(Some) } else { Some(None) }
}

fn mechanism(t: &mut Reader<'_>, arm: Option<String>) -> Option<ClaimTest> {
    let (stated, least_share) = (t.text("stated"), t.real("least_share"));
    let mode = if t.has("mode") { t.choice("mode").map(Some) } else { Some(None) };
    let mut range = |name: &str| {
        let list = t.list(name)?;
        match list[..] {
            [low, high] => Some([low, high]),
            _ => {
                t.fault(name, "two shares, the smaller first", "give exactly two");
                None
            }
        }
    };
    let (weight_share, length_share, place) = (range("weight_share"), range("length_share"), range("place"));
    Some(ClaimTest::Mechanism {
        arm: arm?,
        stated: stated?,
        mode: mode?,
        weight_share: weight_share?,
        length_share: length_share?,
        place: place?,
        least_share: least_share?,
    })
}

fn arm_name(t: &mut Reader<'_>, key: &str, arms: Option<&[String]>) -> Option<String> {
    let name = t.name(key)?;
    check_arm(t, key, &name, arms);
    Some(name)
}

fn check_arm(t: &mut Reader<'_>, key: &str, name: &str, arms: Option<&[String]>) {
    if let Some(arms) = arms
        && !arms.iter().any(|a| a == name)
    {
        t.fault(key, format!("an arm of study.toml: {}", arms.join(", ")), suggestion(name, arms));
    }
}

fn band(t: &mut Reader<'_>) -> Option<[f64; 2]> {
    let [low, high] = t.reals(["low", "high"])?;
    if low > high {
        t.fault(
            "low",
            format!("at most high = {}", Short(high)),
            "the interval is reversed: swap low and high",
        );
        return None;
    }
    Some([low, high])
}
