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
            let (stated, band) = (t.real("stated"), band(t));
            let (stated, [low, high]) = (stated?, band?);
            if stated < low || stated > high {
                t.fault(
                    "stated",
                    format!("within low to high, {low} to {high}"),
                    "the band must hold the value stated",
                );
            }
            Some(ClaimTest::RatioOfMeans { arm: arm?, over: over?, stated, low, high })
        }
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
