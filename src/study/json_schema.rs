//! JSON Schemas of the input files, from the table of keys that the parser checks with: an editor that knows them tells what a key
//! means and what is allowed while a study is written.

use serde_json::{Map, Value, json};

use crate::study::keys;
use crate::study::schema::{Interval, Key, Kind, Presence, Section};
use crate::study::setting::LAID_OVER;
use crate::study::with_unit;

/// The draft that editors for TOML read.
const DRAFT: &str = "http://json-schema.org/draft-07/schema#";

/// An input file that has a schema.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Schema {
    /// study.toml of walls.
    Study,
    /// study.toml of types of elements.
    ElementStudy,
    /// published.toml beside a study of walls.
    Published,
}

impl Schema {
    /// The usual name of its file.
    pub fn file(self) -> &'static str {
        match self {
            Schema::Study => "study.schema.json",
            Schema::ElementStudy => "element-study.schema.json",
            Schema::Published => "published.schema.json",
        }
    }

    /// The schema.
    pub fn json(self) -> Value {
        let section = match self {
            Schema::Study => &keys::STUDY,
            Schema::ElementStudy => &keys::ELEMENT_STUDY,
            Schema::Published => &keys::PUBLISHED,
        };
        let mut definitions = Definitions::default();
        let mut root = table(section, Stated::Whole, &mut definitions);
        root.insert("$schema".to_owned(), DRAFT.into());
        root.insert("definitions".to_owned(), Value::Object(definitions.done));
        Value::Object(root)
    }

    /// The schema as it is written to a file.
    pub fn text(self) -> String {
        format!("{:#}\n", self.json())
    }
}

/// How much of a table stands in one place.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Stated {
    /// All that must be there.
    Whole,
    /// What an arm says otherwise than the table that all arms share: nothing must be there.
    LaidOver,
}

/// The tables that are referred to, each once.
#[derive(Default)]
struct Definitions {
    done: Map<String, Value>,
}

impl Definitions {
    /// A reference to the schema of a table, which is written at the first of them.
    fn reference(&mut self, section: &'static Section, stated: Stated) -> Value {
        let own = match stated {
            Stated::Whole => section.title.to_owned(),
            Stated::LaidOver => format!("{} of an arm", section.title),
        };
        // Nothing in a name that a JSON pointer would have to escape.
        let words = own.split(|c: char| !c.is_ascii_alphanumeric()).filter(|word| !word.is_empty());
        let name = words.collect::<Vec<_>>().join("-");
        if !self.done.contains_key(&name) {
            self.done.insert(name.clone(), Value::Null);
            let schema = table(section, stated, self);
            self.done.insert(name.clone(), Value::Object(schema));
        }
        json!({ "$ref": format!("#/definitions/{name}") })
    }
}

/// The schema of a table: its keys, those that must be there, and what its chooser decides.
fn table(section: &'static Section, stated: Stated, definitions: &mut Definitions) -> Map<String, Value> {
    let mut properties = Map::new();
    for key in section.all() {
        let laid_over = section.title == keys::ARM.title && LAID_OVER.contains(&key.name);
        let below = if laid_over { Stated::LaidOver } else { Stated::Whole };
        let own = property(key, below, definitions);
        let both = match properties.remove(key.name) {
            None => own,
            // Which of them holds the chooser says: see `choices`.
            Some(other) => json!({ "anyOf": [other, own] }),
        };
        properties.insert(key.name.to_owned(), both);
    }
    let mut schema = Map::new();
    schema.insert("type".to_owned(), "object".into());
    schema.insert("title".to_owned(), section.title.into());
    schema.insert("description".to_owned(), section.doc.into());
    schema.insert("properties".to_owned(), Value::Object(properties));
    schema.insert("additionalProperties".to_owned(), false.into());
    let mut rules = choices(section, stated, definitions);
    if stated == Stated::Whole {
        let always = section.all().filter(|key| key.only.is_empty());
        require(always, &mut rules, &mut schema);
    }
    if !rules.is_empty() {
        schema.insert("allOf".to_owned(), Value::Array(rules));
    }
    schema
}

/// Writes down which of the keys must be there: into a schema those that must in any case, as rules those that another takes the
/// place of.
fn require<'k>(keys: impl Iterator<Item = &'k Key>, rules: &mut Vec<Value>, schema: &mut Map<String, Value>) {
    let mut required: Vec<Value> = Vec::new();
    for key in keys {
        match key.presence {
            Presence::Required => required.push(key.name.into()),
            Presence::Unless(other) => {
                rules.push(json!({ "anyOf": [{ "required": [key.name] }, { "required": [other] }] }));
                rules.push(json!({ "not": { "required": [key.name, other] } }));
            }
            Presence::Optional | Presence::Default(_) => {}
        }
    }
    if !required.is_empty() {
        schema.insert("required".to_owned(), Value::Array(required));
    }
}

/// For each value of the chooser: keys that must be there, keys that mean nothing, and those that mean something else than for others.
fn choices(section: &'static Section, stated: Stated, definitions: &mut Definitions) -> Vec<Value> {
    let Some(chooser) = section.chooser.and_then(|name| section.key(name, None)) else { return Vec::new() };
    let Kind::Choice(names) = chooser.kind else { return Vec::new() };
    let mut all = Vec::new();
    for name in names {
        let mut then = Map::new();
        let mut rules = Vec::new();
        if stated == Stated::Whole {
            let own = section.all().filter(|key| key.only.contains(name));
            require(own, &mut rules, &mut then);
        }
        let meaningless = section.all().filter(|key| section.key(key.name, Some(name)).is_none());
        let mut own: Map<String, Value> =
            meaningless.map(|key| (key.name.to_owned(), false.into())).collect();
        for key in section.all().filter(|key| key.only.contains(name)) {
            if section.all().filter(|other| other.name == key.name).count() > 1 {
                own.insert(key.name.to_owned(), property(key, Stated::Whole, definitions));
            }
        }
        if !own.is_empty() {
            then.insert("properties".to_owned(), Value::Object(own));
        }
        if !rules.is_empty() {
            then.insert("allOf".to_owned(), Value::Array(rules));
        }
        if then.is_empty() {
            continue;
        }
        let mut when = json!({ "properties": { chooser.name: { "const": name } } });
        let is_default =
            matches!(chooser.presence, Presence::Default(text) if text.trim_matches('"') == *name);
        // What is left out of a whole table has its default; what an arm leaves out is as in the table that it is laid over.
        if !is_default || stated == Stated::LaidOver {
            when["required"] = json!([chooser.name]);
        }
        all.push(json!({ "if": when, "then": then }));
    }
    all
}

/// The schema of a key's value, with its meaning.
fn property(key: &Key, below: Stated, definitions: &mut Definitions) -> Value {
    let mut schema = values(&key.kind, below, definitions);
    let refers = schema.get("$ref").is_some();
    if refers {
        // Beside a reference nothing else counts.
        schema = json!({ "allOf": [schema] });
    }
    let usual = key.usual.map(|usual| format!("; usual is {usual}")).unwrap_or_default();
    schema["description"] = format!("{} Allowed is {}{usual}.", key.doc, key.kind.allowed()).into();
    if let Presence::Default(text) = key.presence
        && let Some(default) = default(text)
    {
        schema["default"] = default;
    }
    schema
}

/// A default, which is written in TOML.
fn default(text: &str) -> Option<Value> {
    let parsed: toml::Table = toml::from_str(&format!("default = {text}")).ok()?;
    serde_json::to_value(parsed.get("default")?).ok()
}

/// What values a kind of key takes.
fn values(kind: &Kind, below: Stated, definitions: &mut Definitions) -> Value {
    let whole = |low: u64, high: u64| json!({ "type": "integer", "minimum": low, "maximum": high });
    let reference = || json!({ "type": "string", "pattern": "^[a-z0-9_/-]+:[a-z0-9_-]+$" });
    match *kind {
        Kind::Text => json!({ "type": "string", "pattern": "\\S" }),
        Kind::Name => name(),
        Kind::Flag => json!({ "type": "boolean" }),
        Kind::Choice(names) => json!({ "enum": names }),
        Kind::Whole { low, high } => whole(low, high),
        Kind::WholeOr { low, high, rule } => {
            json!({ "anyOf": [whole(low, high), definitions.reference(rule, Stated::Whole)] })
        }
        Kind::Statistic => json!({ "type": "string", "pattern": "^(mean|sigma|quantile-[0-9.eE-]+)$" }),
        Kind::Real { unit, within } => written(unit, within),
        Kind::Quantity { unit, within } => json!({
            "anyOf": [written(unit, within), reference(), definitions.reference(&keys::FAMILY, Stated::Whole)]
        }),
        Kind::Distribution { .. } => {
            json!({ "anyOf": [reference(), definitions.reference(&keys::FAMILY, Stated::Whole)] })
        }
        Kind::Reals { unit, within, at_most, .. } => list(written(unit, within), 1, at_most),
        Kind::Values { at_most } => json!({
            "anyOf": [list(number(Interval::any()), 1, at_most), { "type": "string", "pattern": "^[^:]+:[^:]+$" }]
        }),
        Kind::Stones { within, at_most } => json!({
            "anyOf": [{ "type": "string", "pattern": "\\S" }, list(list(number(within), 2, 2), 1, at_most)]
        }),
        Kind::Pair { low, high } => list(whole(low, high), 2, 2),
        Kind::NamePair => {
            let mut pair = list(name(), 2, 2);
            pair["uniqueItems"] = true.into();
            pair
        }
        Kind::Names => json!({ "type": "array", "items": name(), "minItems": 1, "uniqueItems": true }),
        Kind::Table(section) => definitions.reference(section, below),
        Kind::Tables(section) => {
            json!({ "type": "array", "items": definitions.reference(section, Stated::Whole), "minItems": 1 })
        }
        Kind::Settings => json!({ "type": "object", "minProperties": 1 }),
        Kind::Files { at_most } => json!({
            "type": "array", "items": { "type": "string", "minLength": 1 }, "minItems": 1, "maxItems": at_most, "uniqueItems": true,
        }),
        Kind::WallFile => {
            json!({ "type": "string", "pattern": "\\.([jJ][sS][oO][nN]|[oO][bB][jJ]|[cC][sS][vV])$" })
        }
        Kind::Paths => json!({ "type": "array", "items": { "type": "string" } }),
    }
}

fn name() -> Value {
    json!({ "type": "string", "pattern": "^[a-z0-9_-]{1,64}$" })
}

/// A number, or one with its unit; bounds hold for plain numbers, the program checks the others.
fn written(unit: &str, within: Interval) -> Value {
    let mut schema = number(within);
    if let Some(pattern) = with_unit::pattern(unit) {
        schema["type"] = json!(["number", "string"]);
        schema["pattern"] = pattern.into();
    }
    schema
}

fn number(within: Interval) -> Value {
    let mut schema = json!({ "type": "number" });
    let mut bound = |value: f64, is_open: bool, open: &str, closed: &str| {
        if value.is_finite() {
            schema[if is_open { open } else { closed }] = value.into();
        }
    };
    bound(within.low, within.open_low, "exclusiveMinimum", "minimum");
    bound(within.high, within.open_high, "exclusiveMaximum", "maximum");
    schema
}

fn list(items: Value, at_least: usize, at_most: usize) -> Value {
    json!({ "type": "array", "items": items, "minItems": at_least, "maxItems": at_most })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_key_says_what_it_means_what_is_allowed_and_its_default() {
        let schema = Schema::Study.json();
        let height = &schema["definitions"]["wall"]["properties"]["height_m"];
        assert_eq!(
            (&height["type"], &height["exclusiveMinimum"]),
            (&json!(["number", "string"]), &json!(0.0))
        );
        assert_eq!(height["description"], "Height. Allowed is a number above 0 and at most 1000 (m).");
        let wythes = &schema["definitions"]["wall"]["properties"]["wythes"];
        assert_eq!((&wythes["default"], &wythes["maximum"]), (&json!(1), &json!(10)));
        assert_eq!(schema["definitions"]["wall"]["additionalProperties"], false);
        let required = |name: &str| schema["definitions"][name].get("required").cloned();
        assert!(required("wall").expect("keys").as_array().expect("a list").contains(&"height_m".into()));
        assert!(schema["definitions"]["wall-of-an-arm"]["properties"].is_object());
        assert_eq!(required("wall-of-an-arm"), None, "an arm states what it says otherwise");
    }

    #[test]
    fn every_reference_leads_to_a_table() {
        for file in [Schema::Study, Schema::ElementStudy, Schema::Published] {
            let schema = file.json();
            let text = schema.to_string();
            let names = text.split("\"#/definitions/").skip(1).filter_map(|rest| rest.split('"').next());
            let names: Vec<&str> = names.collect();
            assert!(file == Schema::Published || names.len() > 5);
            for name in names {
                assert!(schema["definitions"][name].is_object(), "{name}");
            }
        }
    }
}
