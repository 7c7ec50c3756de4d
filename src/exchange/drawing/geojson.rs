//! Reading outlines of a wall's face from GeoJSON, as geographic and photogrammetric programs write them: x to the right, then z.

use serde_json::{Map, Value};

use crate::exchange::drawing::Drawing;
use crate::exchange::drawing::gather::{Drawn, Gatherer, MOST_POINTS, Unread, cut, short, too_many};
use crate::exchange::drawing::layer::{Shown, shown};
use crate::exchange::fault::{Fault, WallFaults};
use crate::face::Part;

/// Most commas and most lists and objects of a file: more of them would not fit into memory.
const MOST_COMMAS: usize = 5 * MOST_POINTS;
const MOST_LISTS: usize = MOST_POINTS + 400_000;
/// How deep collections may be in collections.
const DEEPEST: usize = 32;
/// Properties that name an outline.
const NAMES: [&str; 2] = ["name", "id"];
/// Properties that say what it surrounds.
const LAYERS: [&str; 5] = ["part", "layer", "kind", "type", "class"];
/// Systems of coordinates in degrees.
const DEGREES: [&str; 5] = ["4326", "CRS84", "4979", "4258", "WGS84"];
const POLYGON: &str = "a Polygon of lists of [x, z]";

/// The polygons of a GeoJSON text, each an outline. Its unit is a member or a property `unit`: `mm`, `cm` or `m`.
pub(in crate::exchange) fn read_geojson(text: &str) -> Result<Drawing, WallFaults> {
    let mut gatherer = Gatherer::new("drawing.geojson");
    let count = |bytes: &[u8]| text.bytes().filter(|byte| bytes.contains(byte)).count();
    if count(b",") > MOST_COMMAS || count(b"[{") > MOST_LISTS {
        gatherer.fault(too_many(0));
        return Err(gatherer.into_faults());
    }
    let whole = match serde_json::from_str::<Value>(text.trim_start_matches('\u{feff}')) {
        Ok(Value::Object(whole)) => whole,
        Ok(_) => {
            let fix = "save the outlines as a FeatureCollection";
            gatherer.fault(Fault::of("", "the text is no JSON object", "a FeatureCollection", fix));
            return Err(gatherer.into_faults());
        }
        Err(error) => {
            gatherer.fault(syntax_fault(text, &error));
            return Err(gatherer.into_faults());
        }
    };
    let mut reader = Reader { gatherer, units: Vec::new(), unknown: 0, holes: 0, levels: 0 };
    if let Some(system) = whole.get("crs").map(Value::to_string)
        && DEGREES.iter().any(|name| system.contains(name))
    {
        reader
            .gatherer
            .warn("its crs says degrees: they were taken for lengths in the face of the wall".to_owned());
    }
    let stated = whole.get("unit");
    reader.unit(stated);
    reader.object(&whole, "", "", 0);
    reader.drawing(stated.is_some())
}

struct Reader {
    gatherer: Gatherer,
    /// Metres in each unit that the file names.
    units: Vec<f64>,
    /// Units that are none.
    unknown: usize,
    holes: usize,
    /// Points with a third number.
    levels: usize,
}

impl Reader {
    /// A collection, a feature or a geometry, of an outline of this name and layer; `false` when the rest is not worth reading.
    fn object(&mut self, object: &Map<String, Value>, own: &str, layer: &str, depth: usize) -> bool {
        let kind = object.get("type").and_then(Value::as_str).unwrap_or("");
        let members = |key: &str| object.get(key).and_then(Value::as_array).map_or(&[][..], Vec::as_slice);
        let all = |reader: &mut Reader, members: &[Value]| {
            members.iter().all(|member| reader.member(member, own, layer, depth))
        };
        match kind {
            "FeatureCollection" => all(self, members("features")),
            "GeometryCollection" => all(self, members("geometries")),
            "Feature" => self.feature(object, depth),
            _ if shown(layer) == Shown::Passed => {
                self.gatherer.pass_layer(layer);
                true
            }
            "Polygon" => self.polygon(object.get("coordinates"), own, layer),
            "MultiPolygon" => match object.get("coordinates") {
                Some(Value::Array(polygons)) => {
                    polygons.iter().all(|polygon| self.polygon(Some(polygon), own, layer))
                }
                other => self.polygon(other, own, layer),
            },
            "" => {
                self.gatherer.pass("object without a type");
                true
            }
            other => {
                self.gatherer.pass(short(other));
                true
            }
        }
    }

    fn member(&mut self, member: &Value, own: &str, layer: &str, depth: usize) -> bool {
        match member {
            Value::Object(object) if depth < DEEPEST => self.object(object, own, layer, depth + 1),
            Value::Object(_) => {
                let found = "collections hold one another";
                self.gatherer.fault(Fault::of("", found, format!("{DEEPEST} of them"), "simplify the file"));
                false
            }
            _ => {
                self.gatherer.pass("member that is no object");
                true
            }
        }
    }

    fn feature(&mut self, feature: &Map<String, Value>, depth: usize) -> bool {
        let empty = Map::new();
        let properties = feature.get("properties").and_then(Value::as_object).unwrap_or(&empty);
        let first = |keys: &[&str]| keys.iter().find_map(|key| word(properties.get(*key)?));
        let own = first(&NAMES).or_else(|| word(feature.get("id")?)).unwrap_or_default();
        // The first property that says more than that it is a stone.
        let layers = || LAYERS.iter().filter_map(|key| word(properties.get(*key)?));
        let says = layers().find(|layer| shown(layer) != Shown::Part(Part::Stone));
        let layer = says.or_else(|| layers().next()).unwrap_or_default();
        self.unit(properties.get("unit"));
        match feature.get("geometry") {
            Some(Value::Null) | None => {
                self.gatherer.pass("Feature without a geometry");
                true
            }
            Some(geometry) => self.member(geometry, &own, &layer, depth),
        }
    }

    fn unit(&mut self, stated: Option<&Value>) {
        let Some(stated) = stated else { return };
        let metres = match stated.as_str() {
            Some("mm") => 1e-3,
            Some("cm") => 1e-2,
            Some("m") => 1.0,
            _ => {
                self.unknown += 1;
                return;
            }
        };
        if !self.units.contains(&metres) {
            self.units.push(metres);
        }
    }

    fn polygon(&mut self, coordinates: Option<&Value>, own: &str, layer: &str) -> bool {
        let rings = coordinates.and_then(Value::as_array).map_or(&[][..], Vec::as_slice);
        self.holes += rings.len().saturating_sub(1);
        let unread =
            |found: String| Unread { line: 0, found, allowed: POLYGON, fix: "correct its coordinates" };
        let ring = rings.first().and_then(Value::as_array);
        let points = match ring {
            Some(ring) => ring.iter().map(|at| self.point(at).map_err(unread)).collect(),
            None => Err(unread("it has no ring of coordinates".to_owned())),
        };
        let (own, layer) = (own.to_owned(), layer.to_owned());
        self.gatherer.push(Drawn { line: 0, own, layer, points, closed: true })
    }

    fn point(&mut self, at: &Value) -> Result<[f64; 2], String> {
        let numbers = at.as_array().map_or(&[][..], Vec::as_slice);
        match [0, 1].map(|i| numbers.get(i).and_then(Value::as_f64)) {
            [Some(x), Some(z)] => {
                self.levels += usize::from(numbers.len() > 2);
                Ok([x, z])
            }
            _ => Err(format!("{} is no point", said(at))),
        }
    }

    fn drawing(mut self, is_stated: bool) -> Result<Drawing, WallFaults> {
        if self.units.len() > 1 {
            let found = "features have different units";
            let fix = "write all of them in one unit";
            self.gatherer.fault(Fault::of("", found, "one unit in a file", fix));
        }
        if self.unknown > 0 {
            let where_ = if is_stated { "its unit" } else { "the unit of a feature" };
            self.gatherer.warn(format!("{where_} is none of mm, cm and m, and says nothing"));
        }
        if self.holes > 0 {
            self.gatherer.warn(format!("{} hole(s) in polygons were passed over", self.holes));
        }
        if self.levels > 0 {
            let found =
                format!("{} point(s) have more than two numbers: x and z are the first two", self.levels);
            self.gatherer.warn(found);
        }
        self.gatherer.finish(self.units.first().copied())
    }
}

/// A name that is a text or a number.
fn word(value: &Value) -> Option<String> {
    match value {
        Value::String(text) => Some(short(text).to_owned()),
        Value::Number(number) => Some(number.to_string()),
        _ => None,
    }
}

/// A value for a message, without what is in it.
fn said(value: &Value) -> String {
    match value {
        Value::Array(inner) if inner.iter().any(|own| own.is_array() || own.is_object()) => {
            "a list of lists".to_owned()
        }
        Value::Array(inner) => {
            let shown: Vec<String> = inner.iter().take(4).map(said).collect();
            format!("[{}]", shown.join(", "))
        }
        Value::Object(_) => "an object".to_owned(),
        Value::String(text) => format!("\"{}\"", cut(text)),
        other => other.to_string(),
    }
}

/// The fault that stopped the reader of JSON, with the geometry around its place.
fn syntax_fault(text: &str, error: &serde_json::Error) -> Fault {
    let (line, column) = (error.line(), error.column());
    let before: usize = text.split_inclusive('\n').take(line.saturating_sub(1)).map(str::len).sum();
    let read = &text.as_bytes()[..(before + column).min(text.len())];
    let begun = read.windows(13).filter(|window| window == b"\"coordinates\"").count();
    let block = if begun > 0 { format!("geometry {}", begun - 1) } else { String::new() };
    let said = error.to_string();
    let said = said.split(" at line ").next().unwrap_or(&said);
    let (found, allowed, fix) = if error.is_eof() {
        (
            "the file ends too early: it is truncated".to_owned(),
            "a whole JSON object",
            "write or copy it again",
        )
    } else if said.contains("number out of range") {
        ("a number is larger than any number".to_owned(), "finite numbers", "correct it")
    } else {
        (format!("not what is expected: {said}"), "GeoJSON with finite numbers", "correct it there")
    };
    Fault::of(&block, found, allowed, fix).at(line, column)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn feature(properties: &str, kind: &str, coordinates: &str) -> String {
        let geometry = format!("{{\"type\": \"{kind}\", \"coordinates\": {coordinates}}}");
        format!("{{\"type\": \"Feature\", \"properties\": {{{properties}}}, \"geometry\": {geometry}}}")
    }

    fn collection(members: &str, features: &[String]) -> String {
        format!("{{\"type\": \"FeatureCollection\", {members} \"features\": [{}]}}", features.join(",\n"))
    }

    const RING: &str = "[[0, 0], [1, 0], [1, 1], [0, 0]]";

    #[test]
    fn polygons_are_outlines_with_their_names_parts_and_unit() {
        let features = [
            feature("\"name\": \"K3\"", "Polygon", &format!("[{RING}, {RING}]")),
            feature("\"id\": 4, \"layer\": \"Ground\"", "Polygon", &format!("[{RING}]")),
            feature(
                "\"layer\": \"wall\", \"kind\": \"void\"",
                "MultiPolygon",
                &format!("[[{RING}], [{RING}]]"),
            ),
            feature("", "Point", "[0, 0]"),
            feature("\"layer\": \"text\"", "Polygon", &format!("[{RING}]")),
        ];
        let crs = "\"crs\": {\"properties\": {\"name\": \"EPSG:4326\"}}, \"unit\": \"cm\",";
        let drawing = read_geojson(&collection(crs, &features)).unwrap();
        let names: Vec<&str> = drawing.outlines.iter().map(|own| own.name.as_str()).collect();
        assert_eq!(names, ["stone 0 (K3)", "ground 0 (4)", "opening 0", "opening 1"]);
        assert_eq!(drawing.outlines[0].points, [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]]);
        assert_eq!((drawing.metres, drawing.warnings.len()), (Some(0.01), 4), "{:?}", drawing.warnings);
        assert!(read_geojson(&format!("{{\"type\": \"Polygon\", \"coordinates\": [{RING}]}}")).is_ok());
    }

    #[test]
    fn what_is_wrong_is_told_with_its_name_or_place() {
        let said = |text: &str| read_geojson(text).unwrap_err().to_string();
        let odd = feature("", "Polygon", "[[[0, 0], [1, \"a\"], [1, 1]]]");
        assert!(
            said(&odd).contains("stone 0: [1, \"a\"] is no point; allowed is a Polygon"),
            "{}",
            said(&odd)
        );
        let nan = said("{\"type\": \"Polygon\",\n\"coordinates\": [[[0, NaN]]]}");
        assert!(nan.contains("drawing.geojson:2:22: geometry 0: not what is expected"), "{nan}");
        let large = said("{\"coordinates\": [[[0, 1e400]]]}");
        assert!(large.contains("larger than any number"), "{large}");
        assert!(said("{\"type\": \"Feat").contains("truncated"));
        assert!(said("[]").contains("no JSON object"));
        let two = ["\"unit\": \"m\"", "\"unit\": \"mm\""]
            .map(|unit| feature(unit, "Polygon", &format!("[{RING}]")));
        assert!(said(&collection("", &two)).contains("different units"));
    }
}
