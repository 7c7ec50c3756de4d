//! The readings of a study: its variants, alone and together.

use crate::study::VariantName;
use crate::study::variant::{TOGETHER, shared_key};

/// Keys below this say how a wall is solved: no other reading of what was built and loaded.
const HOW_SOLVED: &str = "solver.";

/// One reading: the variants that are read together, by name, in the order of the file; none of the base.
pub type Reading = Vec<String>;

/// The base and all sets of up to `most` variants that change different keys, those with fewer variants first. Variants that
/// change the solver are left out.
pub fn readings(variants: &[VariantName], most: usize) -> Vec<Reading> {
    let solves = |variant: &&VariantName| variant.keys.iter().any(|key| key.starts_with(HOW_SOLVED));
    let variants: Vec<&VariantName> = variants.iter().filter(|variant| !solves(variant)).collect();
    let goes_with = |set: &[usize], next: usize| {
        set.iter().all(|&one| shared_key(&variants[one].keys, &variants[next].keys).is_none())
    };
    let mut all: Vec<Vec<usize>> = vec![Vec::new()];
    let mut last = all.clone();
    for _ in 0..most {
        last = last
            .iter()
            .flat_map(|set| {
                let next = set.last().map_or(0, |last| last + 1)..variants.len();
                let fits = next.filter(|&next| goes_with(set, next));
                fits.map(|next| [&set[..], &[next]].concat()).collect::<Vec<_>>()
            })
            .collect();
        all.extend(last.iter().cloned());
    }
    all.into_iter().map(|set| set.into_iter().map(|k| variants[k].name.clone()).collect()).collect()
}

/// The name under which a study is loaded in a reading; `None` of the base.
pub fn reading_name(reading: &[String]) -> Option<String> {
    (!reading.is_empty()).then(|| reading.join(&TOGETHER.to_string()))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn variant(name: &str, keys: &[&str]) -> VariantName {
        let keys = keys.iter().map(ToString::to_string).collect();
        VariantName { name: name.to_owned(), why: String::new(), keys }
    }

    #[test]
    fn variants_that_change_one_key_are_not_read_together() {
        let variants = [
            variant("a", &["wall.wythes"]),
            variant("b", &["restraint.ends"]),
            variant("c", &["restraint"]),
            variant("d", &["solver.name"]),
            variant("e", &["arm.x.dip_deg", "wall.wythes"]),
        ];
        let names = |most| -> Vec<String> {
            readings(&variants, most).iter().map(|r| reading_name(r).unwrap_or_default()).collect()
        };
        assert_eq!(names(0), [""]);
        assert_eq!(names(1), ["", "a", "b", "c", "e"]);
        assert_eq!(names(3), ["", "a", "b", "c", "e", "a+b", "a+c", "b+e", "c+e"]);
    }
}
