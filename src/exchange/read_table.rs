//! Reading an elevation as a mason's sketch gives it: a table with a row per stone, where it lies in the face of the wall and how large it is.

use crate::exchange::draft::{Draft, WallFile, assumed_density, build};
use crate::exchange::fault::{Fault, WallFaults};
use crate::exchange::{ReadOptions, Unit};
use crate::math::{Vec3, cos, edit_distance, radians, sin};
use crate::shape::Polyhedron;

/// Lines above the head that are looked at for it.
const MOST_TITLES: usize = 20;
/// Steepest dip (deg).
const STEEPEST: f64 = 60.0;

/// What a column holds, and what it may be called.
const COLUMNS: [(&str, &[&str]); 8] = [
    ("name", &["name", "stone", "id", "no", "nr", "number", "block"]),
    ("x", &["x", "left", "from"]),
    ("z", &["z", "bottom", "level"]),
    ("length", &["length", "width", "l", "w"]),
    ("height", &["height", "h"]),
    ("depth", &["depth", "thickness", "d", "t"]),
    ("dip", &["dip", "angle"]),
    ("density", &["density", "rho"]),
];
/// What a row cannot do without.
const NEEDED: [&str; 4] = ["x", "z", "length", "height"];
const ALLOWED: &str = "a table with a row per stone and the columns x, z, length and height, as \"x (cm)\"; also depth, dip (deg), density (kg/m3), name";

/// A column of the head.
struct Column {
    what: &'static str,
    /// Metres in one of its unit; `None` where the head says none.
    unit: Option<f64>,
}

/// The wall in such a table. Stones are boxes: x (left end) and z (underside) in the face, the depth behind it along y, turned in the face by their
/// dip about the middle, counter-clockwise seen from the front. The lowest stone stands on the platform, the plane z = 0.
pub(super) fn read_table(text: &str, options: &ReadOptions) -> Result<WallFile, WallFaults> {
    let separator = separator(text);
    let plain = |cell: String| if separator == ',' { cell } else { cell.replace(',', ".") };
    let rows = text.lines().map(|line| cells(line, separator).into_iter().map(plain).collect());
    read_rows(&numbered(rows), Vec::new(), options)
}

/// Rows with their numbers, from 1.
pub(super) fn numbered(rows: impl IntoIterator<Item = Vec<String>>) -> Vec<(usize, Vec<String>)> {
    (1..).zip(rows).collect()
}

/// The wall in the rows of a table, with decimal points.
pub(super) fn read_rows(
    lines: &[(usize, Vec<String>)],
    noted: Vec<String>,
    options: &ReadOptions,
) -> Result<WallFile, WallFaults> {
    let mut faults = WallFaults::new("elevation.csv");
    let head = lines.iter().take(MOST_TITLES).find_map(|(at, cells)| Some((*at, head(cells)?)));
    let Some((at, columns)) = head else {
        let fix = "name the columns in the first line, with their units";
        faults.push(Fault::of("", "no line names the columns", ALLOWED, fix));
        return Err(faults);
    };
    let unit = |column: &Column| column.unit.unwrap_or(1.0 / options.unit.unwrap_or(Unit::Metre).per_metre());
    let place = |what: &str| columns.iter().position(|own| own.as_ref().is_some_and(|own| own.what == what));
    let (mut drafts, mut remarks, mut unstated) = (Vec::<Draft>::new(), 0, 0);
    for (line, cells) in lines.iter().filter(|(line, _)| *line > at) {
        let cell = |what: &str| place(what).and_then(|at| cells.get(at)).map_or("", |cell| cell.trim());
        let number = |what: &str| written(cell(what));
        if number("x").or(number("z")).is_none() {
            // An empty line, a title of a course, a sum: nothing that lies somewhere.
            remarks += usize::from(cells.iter().any(|cell| !cell.trim().is_empty()));
            continue;
        }
        let name = match cell("name") {
            "" => format!("stone {}", drafts.len()),
            own => format!("stone {own}"),
        };
        let mut fault = |found: String, allowed: &str, fix: &str| {
            faults.push(Fault::of(&name, found, allowed, fix).at(*line, 0));
        };
        let before = drafts.len();
        let length = |what: &str| {
            let column = columns[place(what)?].as_ref()?;
            Some(number(what)? * unit(column))
        };
        let [x, z, along, high] = NEEDED.map(|what| {
            let read = length(what);
            if read.is_none() {
                fault(format!("{what} is \"{}\"", cell(what)), "a number", "complete the row, or remove it");
            }
            read.unwrap_or(0.0)
        });
        let depth = length("depth").or(options.thickness);
        if depth.is_none() {
            fault(
                "nothing says how deep it is".to_owned(),
                "a column depth, or one thickness for all stones",
                "ask --thickness 45cm",
            );
        }
        let deep = depth.unwrap_or(1.0);
        for (what, size) in [("length", along), ("height", high), ("depth", deep)] {
            if number(what).is_some() && size <= 0.0 {
                fault(format!("its {what} is {size} m"), "a length above 0", "correct it");
            }
        }
        let dip = if cell("dip").is_empty() {
            Some(0.0)
        } else {
            number("dip").filter(|dip| dip.abs() <= STEEPEST)
        };
        if dip.is_none() {
            fault(format!("its dip is \"{}\"", cell("dip")), "-60 to 60 degrees", "correct it");
        }
        let density = number("density").or(options.density);
        unstated += usize::from(density.is_none());
        let shape = turned_box([x, z, along, high, deep], radians(dip.unwrap_or(0.0)));
        let plain = Draft::plain(name, before as u64, false, shape);
        drafts.push(Draft { line: *line, density: density.or(plain.density), ..plain });
    }
    if !faults.is_empty() {
        return Err(faults);
    }
    if drafts.is_empty() {
        faults.push(Fault::of("", "the table has no stones", ALLOWED, "add a row per stone"));
        return Err(faults);
    }
    let lowest = drafts.iter().flat_map(|draft| &draft.vertices).map(|v| v.z).fold(f64::INFINITY, f64::min);
    drafts.iter_mut().flat_map(|draft| &mut draft.vertices).for_each(|v| v.z -= lowest);
    let mut warnings = noted;
    warnings.extend(assumed_density(unstated));
    if remarks > 0 {
        warnings.push(format!("{remarks} line(s) of the table are no stones and were passed over"));
    }
    let unsaid: Vec<&str> = columns
        .iter()
        .flatten()
        .filter(|own| own.is_length() && own.unit.is_none())
        .map(|own| own.what)
        .collect();
    if options.unit.is_none() && !unsaid.is_empty() {
        warnings.push(format!(
            "no unit is said of {}: metres are taken; write \"x (cm)\", or ask --unit",
            unsaid.join(", ")
        ));
    }
    let options = ReadOptions { on_platform: true, ..options.clone() };
    build(drafts, Unit::Metre, &options, faults, warnings)
}

impl Column {
    fn is_length(&self) -> bool {
        !["name", "dip", "density"].contains(&self.what)
    }
}

/// The character between cells: the one that the first lines have most of.
fn separator(text: &str) -> char {
    let count =
        |own: char| text.lines().take(MOST_TITLES).map(|line| line.matches(own).count()).sum::<usize>();
    [';', '\t', ','].into_iter().max_by_key(|own| (count(*own), *own != ',')).unwrap_or(',')
}

/// The cells of a line; a quoted one may hold separators.
fn cells(line: &str, separator: char) -> Vec<String> {
    let (mut all, mut quoted) = (vec![String::new()], false);
    for c in line.trim_end_matches('\r').chars() {
        match c {
            '"' => quoted = !quoted,
            c if c == separator && !quoted => all.push(String::new()),
            c => all.last_mut().expect("there is one").push(c),
        }
    }
    all
}

/// The columns, where a line names all that a row cannot do without.
fn head(cells: &[String]) -> Option<Vec<Option<Column>>> {
    let columns: Vec<Option<Column>> = cells.iter().map(|cell| column(cell)).collect();
    let has = |what: &str| columns.iter().flatten().filter(|own| own.what == what).count() == 1;
    NEEDED.iter().all(|what| has(what)).then_some(columns)
}

/// A column by its head: `Length (cm)`, `length_cm`, `Height [mm]`, `x`.
fn column(cell: &str) -> Option<Column> {
    let lower = cell.trim().to_lowercase();
    let mut words = lower.split(|c: char| !c.is_alphanumeric()).filter(|word| !word.is_empty());
    let first = words.next()?;
    let exact = COLUMNS.iter().find(|(_, names)| names.contains(&first));
    // A slip of the pen in a long name.
    let near = || {
        COLUMNS
            .iter()
            .find(|(_, names)| names.iter().any(|name| name.len() > 4 && edit_distance(name, first) == 1))
    };
    let (what, _) = exact.or_else(near)?;
    let unit = words.find_map(|word| match word {
        "m" => Some(1.0),
        "cm" => Some(1e-2),
        "mm" => Some(1e-3),
        _ => None,
    });
    Some(Column { what, unit })
}

fn written(cell: &str) -> Option<f64> {
    cell.parse().ok().filter(|number: &f64| number.is_finite())
}

/// The corners and faces of a stone that lies in the face at x and z (m), turned about its middle.
fn turned_box([x, z, along, high, deep]: [f64; 5], dip: f64) -> (Vec<Vec3>, Vec<Vec<i64>>) {
    let shape = Polyhedron::cuboid(Vec3::new(x, 0.0, z), Vec3::new(x + along, deep, z + high));
    let (middle, s, c) = ([x + 0.5 * along, z + 0.5 * high], sin(dip), cos(dip));
    let turned = |v: &Vec3| {
        let [dx, dz] = [v.x - middle[0], v.z - middle[1]];
        Vec3::new(middle[0] + c * dx - s * dz, v.y, middle[1] + s * dx + c * dz)
    };
    let vertices =
        if dip == 0.0 { shape.vertices.clone() } else { shape.vertices.iter().map(turned).collect() };
    let faces = shape.faces.iter().map(|face| face.iter().map(|v| i64::from(*v)).collect()).collect();
    (vertices, faces)
}
