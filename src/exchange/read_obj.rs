//! Reading Wavefront OBJ, one object per block.

use std::collections::BTreeMap;

use crate::exchange::closing::closes;
use crate::exchange::draft::{
    Draft, MOST_BLOCKS, MOST_SCANNED, MOST_VERTICES, USUAL_DENSITY, WallFile, assumed_density, build,
};
use crate::exchange::fault::{Fault, WallFaults};
use crate::exchange::solid::{FLATNESS, diagonal};
use crate::exchange::{ReadOptions, Unit};
use crate::math::Vec3;
use crate::model::Tag;

/// Words in an object's name that make it a support.
const FIXED_WORDS: [&str; 5] = ["base", "end", "fixed", "ground", "support"];
/// What the name of a part of a stone ends in, before its number.
const PART: &str = ".part";
/// What a file of polygons may hold besides them, and what does not matter here.
const IGNORED: [&str; 11] = ["vn", "vt", "vp", "s", "l", "p", "mtllib", "usemtl", "usemap", "maplib", "lod"];

/// A wall from the text of an OBJ file: one object (`o`, or `g` where there is no `o`) per block, z up unless
/// [`ReadOptions::up`] says otherwise. A name that comes again goes on with its block, unless each of the pieces is a closed solid.
///
/// Polygons of any number of corners; texture and normal numbers are read over, negative numbers count back from the
/// last vertex. A block is fixed when a word of its name is `base`, `end`, `fixed`, `ground` or `support`, in any
/// case (`base_72`, `Left_support.001`). A comment `# density 2400 kg/m^3`, as [`crate::exchange::write_obj`] writes
/// it, holds for the object after it. Objects `name.part1`, `name.part2` and so on are the convex parts of one rigid stone.
/// Corners are put together and coplanar faces merged as in [`crate::exchange::read_wall_json`]. Ids are the places of the
/// objects, from 0.
///
/// # Errors
/// Everything that is wrong with the text, with lines.
///
/// ```
/// use pirca::exchange::{ReadOptions, read_obj, write_obj};
/// let wall = pirca::generate::canonical::wall_72().with_base();
/// assert_eq!(read_obj(&write_obj(&wall), &ReadOptions::default()).unwrap().wall, wall);
/// ```
pub fn read_obj(text: &str, options: &ReadOptions) -> Result<WallFile, WallFaults> {
    let read = obj_drafts(text, options)?;
    build(read.drafts, options.unit.unwrap_or(Unit::Metre), options, read.faults, read.warnings)
}

/// The objects of a file, before anything about them is believed.
pub struct ObjDrafts {
    /// The objects.
    pub drafts: Vec<Draft>,
    /// What is wrong with their text.
    pub faults: WallFaults,
    /// What was assumed of them.
    pub warnings: Vec<String>,
}

/// The objects in the text of an OBJ file; see [`read_obj`].
///
/// # Errors
/// An empty text.
pub fn obj_drafts(text: &str, options: &ReadOptions) -> Result<ObjDrafts, WallFaults> {
    let mut reader = Reader {
        faults: WallFaults::new("wall.obj"),
        vertices: Vec::new(),
        objects: Vec::new(),
        by_groups: !text.lines().any(|line| line.split_whitespace().next() == Some("o")),
        place: 0,
        noted_density: None,
        most: if options.scan_bearing.is_some() || options.any_shape { MOST_SCANNED } else { MOST_VERTICES },
    };
    if text.trim().is_empty() {
        let fix = "see `pirca analyse --help`";
        reader.faults.push(Fault::of("", "the file is empty", "vertices, objects and faces", fix));
        return Err(reader.faults);
    }
    // A line that ends with a backslash goes on in the next.
    let mut begun = String::new();
    for (number, line) in (1..).zip(text.lines()) {
        let open = line.trim_end().strip_suffix('\\');
        if open.is_some() || !begun.is_empty() {
            begun.push_str(open.unwrap_or(line));
            begun.push(' ');
        }
        let goes_on = match (open, begun.is_empty()) {
            (Some(_), _) => continue,
            (None, true) => reader.line(number, line),
            (None, false) => reader.line(number, &std::mem::take(&mut begun)),
        };
        if !goes_on {
            break;
        }
    }
    Ok(reader.into_drafts(options))
}

/// One object of the file.
struct Object {
    name: String,
    line: usize,
    density: Option<f64>,
    /// Faces by the file's vertices, from 0.
    faces: Vec<Vec<usize>>,
    readable: bool,
}

impl Object {
    /// An object without faces is a heading.
    fn is_block(&self) -> bool {
        !self.faces.is_empty() || !self.readable
    }

    /// The vertices in use, in the order of the file, and the faces by them.
    fn own(&self, vertices: &[Vec3]) -> (Vec<Vec3>, Vec<Vec<u32>>) {
        let mut used: Vec<usize> = self.faces.iter().flatten().copied().collect();
        used.sort_unstable();
        used.dedup();
        let number: BTreeMap<usize, u32> = used.iter().enumerate().map(|(i, &v)| (v, i as u32)).collect();
        let faces = self.faces.iter().map(|face| face.iter().map(|v| number[v]).collect()).collect();
        (used.iter().map(|&v| vertices[v]).collect(), faces)
    }

    /// Whether its faces close by themselves; `allowed` as in [`closes`], in the file's unit.
    fn is_solid(&self, vertices: &[Vec3], allowed: f64) -> bool {
        let (own, faces) = self.own(vertices);
        let size = diagonal(&own);
        self.faces.len() >= 4 && closes(&own, &faces, size, allowed.max(FLATNESS * size))
    }
}

/// The blocks: objects of one name are pieces of one, in the place of the first, unless each is a solid of its own.
fn put_together(objects: Vec<Object>, vertices: &[Vec3], allowed: f64) -> Vec<Object> {
    let mut named: BTreeMap<&str, Vec<usize>> = BTreeMap::new();
    for (i, object) in objects.iter().enumerate().filter(|(_, object)| !object.name.is_empty()) {
        named.entry(&object.name).or_default().push(i);
    }
    let mut first: Vec<usize> = (0..objects.len()).collect();
    for pieces in named.values().filter(|pieces| pieces.len() > 1) {
        if !pieces.iter().all(|&i| objects[i].is_solid(vertices, allowed)) {
            pieces.iter().for_each(|&i| first[i] = pieces[0]);
        }
    }
    let mut blocks: BTreeMap<usize, Object> = BTreeMap::new();
    for (object, first) in objects.into_iter().zip(first) {
        match blocks.get_mut(&first) {
            Some(block) => {
                block.faces.extend(object.faces);
                block.density = block.density.or(object.density);
                block.readable &= object.readable;
            }
            None => {
                blocks.insert(first, object);
            }
        }
    }
    blocks.into_values().collect()
}

struct Reader {
    faults: WallFaults,
    vertices: Vec<Vec3>,
    objects: Vec<Object>,
    /// Whether groups are blocks, because the file names no objects.
    by_groups: bool,
    /// How many of the objects before the last one are blocks; the others are headings without faces.
    place: usize,
    /// The density that a comment has given to the next object (kg/m^3).
    noted_density: Option<f64>,
    /// Most faces of an object.
    most: usize,
}

impl Reader {
    /// Reads a line; `false` when the rest of the file is not worth reading.
    fn line(&mut self, number: usize, line: &str) -> bool {
        if let Some(density) = noted_density(line) {
            self.noted_density = Some(density);
        }
        let line = line.split('#').next().unwrap_or("");
        let mut words = line.split_whitespace();
        match words.next() {
            None => {}
            Some("v") => self.vertex(number, &words.collect::<Vec<_>>()),
            Some("f") => self.face(number, &words.collect::<Vec<_>>()),
            Some("o") => self.begin(number, words.collect::<Vec<_>>().join(" ")),
            Some("g") if self.by_groups => self.begin(number, words.collect::<Vec<_>>().join(" ")),
            Some(word) if word == "g" || IGNORED.contains(&word) => {}
            Some(word) => {
                let word: String = word.chars().take(40).collect();
                let allowed = "v, f, o, g and what goes with them (vn, vt, s, l, usemtl, ...)";
                self.fault(
                    number,
                    format!("\"{word}\" is no line of a polygon mesh"),
                    allowed,
                    "export the solids as polygons",
                );
            }
        }
        if self.objects.len() > MOST_BLOCKS {
            self.fault(
                number,
                "too many objects".to_owned(),
                &format!("at most {MOST_BLOCKS}"),
                "divide the wall",
            );
            return false;
        }
        true
    }

    fn fault(&mut self, line: usize, found: String, allowed: &str, fix: &str) {
        let name = self.objects.last().map(|o| title(self.place, &o.name)).unwrap_or_default();
        if let Some(object) = self.objects.last_mut() {
            object.readable = false;
        }
        self.faults.push(Fault::of(&name, found, allowed, fix).at(line, 0));
    }

    fn begin(&mut self, line: usize, name: String) {
        let density = self.noted_density.take();
        self.place += usize::from(self.objects.last().is_some_and(Object::is_block));
        self.objects.push(Object { name, line, density, faces: Vec::new(), readable: true });
    }

    fn vertex(&mut self, line: usize, words: &[&str]) {
        let numbers: Vec<Option<f64>> = words.iter().take(3).map(|w| w.parse().ok()).collect();
        match numbers[..] {
            [Some(x), Some(y), Some(z)] if x.is_finite() && y.is_finite() && z.is_finite() => {
                self.vertices.push(Vec3::new(x, y, z));
            }
            _ => {
                let found = format!("\"v {}\" is no vertex", cut(words));
                let commas =
                    words.iter().any(|w| w.contains(',') && w.replace(',', ".").parse::<f64>().is_ok());
                let fix = if commas { "decimal commas? Write 0.5 for 0,5" } else { "correct the line" };
                self.fault(line, found, "three finite numbers after v", fix);
                // Numbers of later faces still mean what they meant.
                self.vertices.push(Vec3::zeros());
            }
        }
    }

    fn face(&mut self, line: usize, words: &[&str]) {
        if self.objects.is_empty() {
            self.begin(line, String::new());
        }
        if words.len() > MOST_VERTICES {
            let found = format!("a face with {} vertices", words.len());
            return self.fault(line, found, &format!("at most {MOST_VERTICES}"), "simplify the face");
        }
        let count = self.vertices.len() as i64;
        let mut face = Vec::with_capacity(words.len());
        for word in words {
            let number = word.split('/').next().and_then(|first| first.parse::<i64>().ok());
            let index = number.map(|n| if n < 0 { n.saturating_add(count) } else { n.saturating_sub(1) });
            match index {
                Some(i) if (0..count).contains(&i) => face.push(i as usize),
                Some(_) => {
                    let found = format!("\"f {}\" names vertex {word}, which is out of range", cut(words));
                    let allowed = format!("1 to {count} or -{count} to -1, the vertices before this line");
                    return self.fault(line, found, &allowed, "correct the number");
                }
                None => {
                    let found = format!("\"f {}\" is no face", cut(words));
                    return self.fault(
                        line,
                        found,
                        "numbers of vertices: 1 2 3, 1/1 2/2 3/3 or 1//1 2//2 3//3",
                        "correct the line",
                    );
                }
            }
        }
        let Some(object) = self.objects.last_mut() else { return };
        object.faces.push(face);
        let most = self.most;
        if object.faces.len() == most + 1 {
            self.fault(
                line,
                "too many faces".to_owned(),
                &format!("at most {most} in a block"),
                "one object per block; simplify its surface, or say that it is a scan (--scan-bearing)",
            );
        } else if object.faces.len() > most {
            object.faces.pop();
        }
    }

    /// The objects as drafts, each with its own vertices in the order of the file.
    fn into_drafts(self, options: &ReadOptions) -> ObjDrafts {
        let Reader { faults, vertices, mut objects, .. } = self;
        objects.retain(Object::is_block);
        let allowed = options.flatness.map_or(0.0, |m| m * options.unit.unwrap_or_default().per_metre());
        let objects = put_together(objects, &vertices, allowed);
        let up = options.up.unwrap_or_default();
        let (mut assumed, mut fixed) = (0, Vec::new());
        let mut drafts = Vec::with_capacity(objects.len());
        for (place, object) in objects.into_iter().enumerate() {
            let (own, faces) = object.own(&vertices);
            let fixed_by_name = is_support(&object.name);
            let draft = Draft {
                name: title(place, &object.name),
                id: Some(place as u64),
                line: object.line,
                vertices: own.iter().map(|v| up.of_wall(v)).collect(),
                faces: faces.iter().map(|face| face.iter().map(|&v| i64::from(v)).collect()).collect(),
                density: object.density.or(options.density).or(Some(USUAL_DENSITY)),
                fixed: fixed_by_name,
                tag: tag(&object.name).unwrap_or(if fixed_by_name { Tag::Base } else { Tag::Stone }),
                group: whole(&object.name).map(str::to_owned),
                scan: None,
                readable: object.readable,
            };
            if draft.fixed {
                fixed.push(draft.name.clone());
            } else if object.density.is_none() && options.density.is_none() {
                assumed += 1;
            }
            drafts.push(draft);
        }
        let mut warnings: Vec<String> = assumed_density(assumed).into_iter().collect();
        if !fixed.is_empty() {
            let shown = fixed.iter().take(5).cloned().collect::<Vec<_>>().join(", ");
            let rest = if fixed.len() > 5 { format!(" and {} more", fixed.len() - 5) } else { String::new() };
            warnings.push(format!("fixed by their names: {shown}{rest}"));
        }
        ObjDrafts { drafts, faults, warnings }
    }
}

fn cut(words: &[&str]) -> String {
    words[..words.len().min(30)].join(" ").chars().take(60).collect()
}

fn title(place: usize, name: &str) -> String {
    if name.is_empty() {
        format!("block {place}")
    } else {
        format!("block {place} ({})", name.chars().take(60).collect::<String>())
    }
}

/// The words of an object's name, in small letters.
fn words(name: &str) -> impl Iterator<Item = String> + '_ {
    name.split(|c: char| !c.is_alphabetic()).filter(|word| !word.is_empty()).map(str::to_lowercase)
}

/// Whether a word of an object's name makes it a support.
pub fn is_support(name: &str) -> bool {
    words(name).any(|word| FIXED_WORDS.contains(&word.as_str()))
}

/// The name of the stone that an object is a part of, by the end `.part` and a number of its own.
fn whole(name: &str) -> Option<&str> {
    let stem = name.trim_end_matches(|c: char| c.is_ascii_digit());
    let whole =
        stem.len().checked_sub(PART.len()).filter(|&at| stem.is_char_boundary(at) && stem.len() < name.len());
    let (whole, end) = stem.split_at(whole?);
    (!whole.is_empty() && end.eq_ignore_ascii_case(PART)).then_some(whole)
}

/// What an object is, by the first word of its name.
fn tag(name: &str) -> Option<Tag> {
    Some(Tag::named(&words(name).next()?)).filter(|tag| !matches!(tag, Tag::Other(_)))
}

/// The density (kg/m^3) in a comment `# density 2400 kg/m^3`.
fn noted_density(line: &str) -> Option<f64> {
    match line.strip_prefix('#')?.split_whitespace().collect::<Vec<_>>()[..] {
        ["density", number, "kg/m^3"] => number.parse().ok(),
        _ => None,
    }
}
