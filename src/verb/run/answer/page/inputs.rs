//! What a study's numbers are and where each comes from.

use std::collections::BTreeMap;

use serde::Serialize;

use crate::render::document::{Line, Table};
use crate::study::{ElementStudy, Loaded, Study, Used};
use crate::verb::run::answer::page::limits::built;

/// Keys that name things and set nothing.
const NAMES: [&str; 3] = ["arm", "revision of laws and solvers", "study.arms"];

/// Heads of the tables of inputs.
const HEADS: [&str; 3] = ["key, with its unit", "value", "source"];
/// Status of a distribution that nobody measured.
const ASSUMED: &str = "assumed";
const STATED: &str = "stated in the study";

const ALL: &str =
    "Below is every value that decides a result, with its source. Units stand at the end of the keys.";
const SOME_ASSUMED: &str = "Below is every value that decides a result, with its source. Units stand at the end of the keys. Only assumed:";

/// Wall and inputs, as a page shows them.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Given {
    /// What was built and loaded.
    about_wall: String,
    /// What the tables are, before those inputs are named that are only assumed.
    about: &'static str,
    /// The inputs that are only assumed.
    assumed: Vec<String>,
    /// All of them.
    tables: Vec<Table>,
}

impl Given {
    /// Of a study; `loaded` is the study as its files state it.
    pub fn of(study: &Study, loaded: &Loaded) -> Given {
        Given::new(built(study), assumed(&loaded.used), inputs(study, loaded))
    }

    /// Of a study of element types.
    pub fn of_elements(study: &ElementStudy) -> Given {
        let line = |(key, value): (&String, &String)| {
            let used = study.used.iter().find(|used| used.key == *key);
            input(key, value, used, used.map_or_else(|| STATED.to_owned(), of_distribution))
        };
        let rows = entries(&study.effective).map(line).collect();
        let table = Table { rows, ..Table::new("All types", &HEADS, Vec::new()) };
        let filled = format!("Elements fill a cube of {} m.", study.side);
        Given::new(filled, assumed(&study.used), vec![table])
    }

    fn new(about_wall: String, assumed: Vec<String>, tables: Vec<Table>) -> Given {
        let about = if assumed.is_empty() { ALL } else { SOME_ASSUMED };
        Given { about_wall, about, assumed, tables }
    }
}

/// The inputs of a study: those that all arms share, and those of each arm. `loaded` is the study as its files state it, before
/// anything was asked for in the place of its values.
fn inputs(study: &Study, loaded: &Loaded) -> Vec<Table> {
    let of = |name: &str, belongs: &dyn Fn(&str) -> bool| {
        let own = entries(&study.effective).filter(|(key, _)| belongs(key));
        let rows = own.map(|(key, value)| {
            let used = loaded.used.iter().find(|used| used.key == *key);
            let changed = loaded.study.effective.get(key) != Some(value) || study.is_asked_for(key);
            input(key, value, used, source(used, changed, loaded.stated.states(key)))
        });
        let rows = rows.collect();
        Table { rows, ..Table::new(name, &HEADS, Vec::new()) }
    };
    let mut all = vec![of("All arms", &|key| !key.starts_with("arm."))];
    for arm in &study.arms {
        let path = format!("arm.{}.", arm.name);
        let mut own = of(&format!("Arm {}", arm.name), &|key| key.starts_with(&path));
        for line in &mut own.rows {
            line.cells[0] = line.cells[0].trim_start_matches(&path).to_owned();
        }
        all.push(own);
    }
    all
}

/// An input with its source; one that is only assumed stands out.
fn input(key: &str, value: &str, used: Option<&Used>, source: String) -> Line {
    let marked = used.is_some_and(|used| used.status == ASSUMED);
    Line { cells: vec![key.to_owned(), shown(value), source], marked, ..Line::default() }
}

/// Those distributions that are only assumed, in words.
pub fn assumed(used: &[Used]) -> Vec<String> {
    let own = used.iter().filter(|used| used.status == ASSUMED);
    own.map(|used| format!("{}: {} ({})", used.key, used.reference, used.source)).collect()
}

/// The values that are inputs: a distribution as one, not by its parts.
fn entries(values: &BTreeMap<String, String>) -> impl Iterator<Item = (&String, &String)> {
    let is_part = |key: &str| {
        let above = key.match_indices('.').filter_map(|(dot, _)| values.get(&key[..dot]));
        above.into_iter().any(|whole| whole.starts_with('{'))
    };
    let is_name = |key: &str| NAMES.contains(&key) || (key.starts_with("arm.") && key.ends_with(".name"));
    values.iter().filter(move |(key, _)| !is_name(key) && !is_part(key))
}

/// A value as people read it: a distribution by its family and its parameters, a constant by its number.
fn shown(value: &str) -> String {
    let Some(family) = value.strip_prefix("{\"family\":").and_then(|rest| rest.strip_suffix('}')) else {
        return value.to_owned();
    };
    let words = family.replace('"', "").replace(':', " ").replace(',', ", ");
    words.strip_prefix("constant, value ").unwrap_or(&words).to_owned()
}

fn source(used: Option<&Used>, changed: bool, stated: bool) -> String {
    match used {
        _ if changed => "asked for with the command".to_owned(),
        Some(used) => of_distribution(used),
        None if stated => STATED.to_owned(),
        None => "default".to_owned(),
    }
}

fn of_distribution(used: &Used) -> String {
    format!("{}: {} ({})", used.status, used.source, used.reference)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_distribution_is_one_input_and_reads_as_words() {
        let values = [
            ("arm", "a"),
            ("arm.a.dip_deg", r#"{"family":"uniform","low":-3.0,"high":3.0}"#),
            ("arm.a.dip_deg.low", "-3.0"),
            ("arm.a.name", "a"),
            ("joint.phi_deg", r#"{"family":"constant","value":35.0}"#),
        ];
        let values = values.map(|(key, value)| (key.to_owned(), value.to_owned())).into();
        let said: Vec<_> = entries(&values).map(|(key, value)| format!("{key} = {}", shown(value))).collect();
        assert_eq!(said, ["arm.a.dip_deg = uniform, low -3.0, high 3.0", "joint.phi_deg = 35.0"]);
    }

    #[test]
    fn every_number_says_where_it_comes_from() {
        let used = Used {
            key: "joint.phi_deg".into(),
            reference: "joint/friction:shale".into(),
            status: "assumed".into(),
            source: "nobody".into(),
            from: String::new(),
        };
        assert_eq!(source(Some(&used), false, true), "assumed: nobody (joint/friction:shale)");
        assert_eq!(source(None, false, true), "stated in the study");
        assert_eq!(source(None, false, false), "default");
        assert_eq!(source(None, true, true), "asked for with the command");
    }
}
