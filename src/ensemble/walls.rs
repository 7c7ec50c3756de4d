//! What decides the row of one wall, as a hash. A journal's rows are taken over by it and by nothing else, so that a study may grow
//! by members, stiffnesses and arms, and a wall that has changed is never taken for the one that was recorded.

use std::collections::{BTreeMap, BTreeSet};

use sha2::{Digest, Sha256};

use crate::ensemble::Manifest;

/// Of an arm, what names its points: each wall has the stiffness of its own.
const STIFFNESS: &str = "joint.kn_pa_per_m";
/// Of an arm, how many walls it has, and by which rule; of Latin hypercubes it decides where each of them lies.
const MEMBERS: &str = "members";
const DESIGN: &str = "study.design";
const HYPERCUBE: &str = "latin_hypercube";

/// The hashes of a study's walls.
pub(super) struct WallKeys {
    /// What decides the walls of an arm at any stiffness, by the arm's name.
    arms: BTreeMap<String, String>,
}

impl WallKeys {
    /// Those of a run.
    pub fn of(manifest: &Manifest) -> WallKeys {
        let arm = |name: &String| (name.clone(), sha256(&deciding(manifest, name)));
        WallKeys { arms: manifest.members.keys().map(arm).collect() }
    }

    /// The hash of a wall: of its arm, the stiffness of its joints (Pa/m) and its number in the arm. `None` of an arm that the run does
    /// not have.
    pub fn key(&self, arm: &str, kn: f64, member: u64) -> Option<String> {
        let decided = self.arms.get(arm)?;
        Some(sha256(&format!("{decided} kn {kn:?} member {member}")))
    }
}

/// What decides the walls of an arm: the version, the seed, the solver and all shared values, with the arm's own in the place of the
/// tables that it lays over them. Other arms, the numbers of walls and the list of stiffnesses decide none of its walls.
///
/// An arm without values of its own was made from a study's arms by other code; any value may decide it.
fn deciding(manifest: &Manifest, arm: &str) -> String {
    let own = format!("arm.{arm}.");
    let mut lines = format!("version {}\narm {arm}\n", manifest.version);
    if !manifest.values.keys().any(|key| key.starts_with(&own)) {
        lines.push_str(&format!("study {}\n", manifest.study_hash));
        return lines;
    }
    let of_arm: BTreeMap<&str, &String> =
        manifest.values.iter().filter_map(|(key, value)| Some((key.strip_prefix(&own)?, value))).collect();
    let laid: BTreeSet<&str> =
        of_arm.keys().filter_map(|key| key.split_once('.')).map(|(table, _)| table).collect();
    let shared = manifest.values.iter().map(|(key, value)| (key.as_str(), value)).filter(|(key, _)| {
        let table = key.split_once('.').map_or(*key, |(table, _)| table);
        table != "arm" && *key != "study.arms" && !laid.contains(table)
    });
    let values: BTreeMap<&str, &String> =
        shared.chain(of_arm.iter().map(|(key, value)| (*key, *value))).collect();
    for (key, value) in values {
        let counts = key == MEMBERS || key.strip_prefix(MEMBERS).is_some_and(|rest| rest.starts_with('.'));
        let decides = !counts || manifest.values.get(DESIGN).is_some_and(|design| design == HYPERCUBE);
        if key != STIFFNESS && decides {
            lines.push_str(&format!("{key} = {value}\n"));
        }
    }
    lines
}

fn sha256(text: &str) -> String {
    Sha256::digest(text.as_bytes()).iter().map(|byte| format!("{byte:02x}")).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn manifest(values: &[(&str, &str)]) -> Manifest {
        let values: BTreeMap<String, String> =
            values.iter().map(|(key, value)| (key.to_string(), value.to_string())).collect();
        Manifest {
            version: "1".into(),
            study: "any".into(),
            variant: None,
            seed: 7,
            members: BTreeMap::from([("a".into(), 3), ("b".into(), 3)]),
            solver: "implicit".into(),
            study_hash: format!("{values:?}"),
            inputs: BTreeMap::new(),
            values,
        }
    }

    const VALUES: [(&str, &str); 9] = [
        ("arm", "a, b"),
        ("arm.a.members", "3"),
        ("arm.b.members", "3"),
        ("arm.b.joint.kn_pa_per_m", "[5e7]"),
        ("arm.b.joint.phi_deg", "30"),
        ("joint.kn_pa_per_m", "[1e7]"),
        ("joint.phi_deg", "35"),
        ("solver.name", "implicit"),
        ("study.seed", "7"),
    ];

    fn with(key: &'static str, value: &'static str) -> Manifest {
        let mut values: Vec<(&str, &str)> = VALUES.to_vec();
        values.retain(|(own, _)| *own != key);
        values.push((key, value));
        manifest(&values)
    }

    #[test]
    fn a_wall_keeps_its_hash_when_the_study_grows_and_loses_it_when_anything_of_its_own_changes() {
        let key = |of: &Manifest, arm: &str| WallKeys::of(of).key(arm, 1e7, 2).expect("an arm of it");
        let base = manifest(&VALUES);
        let [a, b] = ["a", "b"].map(|arm| key(&base, arm));
        assert_ne!(a, b);
        for grown in [
            with("arm.a.members", "300"),
            with("arm.a.members.at_most", "300"),
            with("joint.kn_pa_per_m", "[1e7, 2e7]"),
            with("arm.b.joint.kn_pa_per_m", "[5e7, 6e7]"),
            with("arm.c.joint.phi_deg", "20"),
            with("study.arms", "a, b"),
            with("arm", "b, a"),
        ] {
            assert_eq!([key(&grown, "a"), key(&grown, "b")], [a.clone(), b.clone()]);
        }
        // The arm b has joints of its own: those of the study decide a alone.
        let wetter = with("joint.phi_deg", "34");
        assert!(key(&wetter, "a") != a && key(&wetter, "b") == b);
        let own = with("arm.b.joint.phi_deg", "29");
        assert!(key(&own, "a") == a && key(&own, "b") != b);
        for other in [with("study.seed", "8"), with("solver.name", "limit"), with("wall.height_m", "2")] {
            assert!(key(&other, "a") != a && key(&other, "b") != b);
        }
        let hypercube = |members: &'static str| {
            let mut of = with("arm.a.members", members);
            of.values.insert(DESIGN.into(), HYPERCUBE.into());
            key(&of, "a")
        };
        assert_ne!(hypercube("32"), hypercube("64"), "twice as many walls lie elsewhere");
        let newer = Manifest { version: "2".into(), ..manifest(&VALUES) };
        assert!(key(&newer, "a") != a && key(&newer, "b") != b);
        // Its place in the arm and its stiffness are part of it.
        let keys = WallKeys::of(&base);
        assert!(keys.key("a", 2e7, 2) != Some(a.clone()) && keys.key("a", 1e7, 3) != Some(a));
        assert_eq!(keys.key("c", 1e7, 2), None);
    }

    #[test]
    fn an_arm_that_was_made_from_others_is_decided_by_all() {
        let key = |of: &Manifest| WallKeys::of(of).key("a", 1e7, 0).expect("an arm of it");
        let made = manifest(&[("arm.b.members", "3"), ("bank.points", "60")]);
        let other = manifest(&[("arm.b.members", "4"), ("bank.points", "60")]);
        assert_ne!(key(&made), key(&other));
    }
}
