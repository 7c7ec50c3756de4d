//! The wall in a drawing: its outlines with their joints closed, as deep as is asked for.

use crate::exchange::draft::{Draft, Drawn, MOST_BLOCKS, WallFile, assumed_density, build};
use crate::exchange::drawing::Drawing;
use crate::exchange::fault::{Fault, WallFaults};
use crate::exchange::{ReadOptions, Unit};
use crate::face::{Closing, Face, Outline, Part, Trouble};
use crate::math::{Vec3, significant};
use crate::model::Tag;
use crate::shape::{Polygon, bounds, moments};

/// Joints of a picture are closed up to so many pixels where nothing else is asked for.
const PIXELS: f64 = 3.0;
/// Length (m) of a slice of a section where none is asked for.
const SLICE: f64 = 1.0;
/// Widest joint that is closed, as a share of the edge of a square of the median stone's area.
const WIDEST: f64 = 0.25;
/// Stones that are named.
const NAMED: usize = 3;
/// A stone that is changed by less than this share of its area is not named.
const CHANGED: f64 = 0.02;

/// How a drawing tells its size.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::exchange) enum Size {
    /// Its unit is a pixel.
    OfPixels,
    /// Its unit is a length, which may be stated.
    OfUnits,
}

/// The wall in a drawing. The face is the plane y = 0, with x to the right; the lowest point lies on the plane z = 0, the leftmost one at x = 0. A
/// section has y to the right, and its slice begins at x = 0.
///
/// # Errors
/// A drawing of no known size or depth, and all outlines that cannot be stones.
pub(in crate::exchange) fn built(
    drawing: Drawing,
    size: Size,
    options: &ReadOptions,
) -> Result<WallFile, WallFaults> {
    let mut faults = WallFaults::new("drawing");
    let Drawing { mut outlines, metres, mut warnings, picture } = drawing;
    let openings = outlines.iter().filter(|own| own.part == Part::Opening).count();
    outlines.retain(|own| own.part != Part::Opening);
    if openings > 0 {
        warnings.push(format!("{openings} opening(s) stay open: nothing is put into them"));
    }
    if !(1..=MOST_BLOCKS).contains(&outlines.len()) {
        let found = format!("{} stones are drawn", outlines.len());
        let allowed = format!("1 to {MOST_BLOCKS} closed outlines");
        faults.push(Fault::of("", found, allowed, "draw an outline around each stone"));
        return Err(faults);
    }
    let [left, low, right, high] = bounds(outlines.iter().flat_map(|own| &own.points));
    let unit = unit(size, options, metres, right - left, &mut warnings).unwrap_or_else(|fault| {
        faults.push(*fault);
        1.0
    });
    let slice = options.section.then_some(SLICE);
    let deep = options.thickness.or(slice).unwrap_or_else(|| {
        let found = "nothing says how deep the stones are";
        faults.push(Fault::of("", found, "one thickness for all stones", "ask --thickness 45cm"));
        1.0
    });
    if !faults.is_empty() {
        return Err(faults);
    }
    let placed = |point: &mut [f64; 2]| *point = [unit * (point[0] - left), unit * (point[1] - low)];
    outlines.iter_mut().flat_map(|own| &mut own.points).for_each(placed);
    warnings.insert(0, read(&outlines, unit * (right - left), unit * (high - low)));
    let grain = if size == Size::OfPixels { unit } else { 0.0 };
    let usual = (size == Size::OfPixels).then_some(PIXELS * unit);
    let face = match options.closing.or(usual) {
        Some(widest) => Some(closed(&outlines, &Closing { widest, grain }, &mut warnings)?),
        None => None,
    };
    let (polygons, joints, gained) = match face {
        Some(face) => {
            let polygons = face.polygons.into_iter().map(|own| own.vertices);
            (polygons.collect(), face.joints, face.gained)
        }
        None => (outlines.iter().map(counter_clockwise).collect::<Vec<_>>(), Vec::new(), Vec::new()),
    };
    let unstated = if options.density.is_none() { outlines.len() } else { 0 };
    warnings.extend(assumed_density(unstated));
    let drafts = outlines.iter().zip(polygons).enumerate();
    let drafts = drafts.map(|(at, (own, polygon))| draft(at, own, &polygon, deep, options)).collect();
    // The faces of closed joints are plane; to make them so again would part them.
    let flatness = options.flatness.filter(|_| options.closing.is_none());
    let options = ReadOptions { on_platform: true, flatness, ..options.clone() };
    let frame = picture
        .map(|[width, height]| [0.0 - left, 0.0 - low, width - left, height - low].map(|own| unit * own));
    let drawn = Drawn {
        section: options.section,
        outlines: outlines.into_iter().map(|own| own.points).collect(),
        joints,
        gained,
        frame,
    };
    Ok(WallFile { drawn: Some(drawn), ..build(drafts, Unit::Metre, &options, faults, warnings)? })
}

/// Metres in one of the drawing's unit; `across` is how long the stones are in it.
fn unit(
    size: Size,
    options: &ReadOptions,
    stated: Option<f64>,
    across: f64,
    warnings: &mut Vec<String>,
) -> Result<f64, Box<Fault>> {
    if let Some(width) = options.width {
        return Ok(width / across);
    }
    let asked = options.unit.map(|unit| 1.0 / unit.per_metre());
    match (size, options.pixel) {
        (Size::OfPixels, Some(pixel)) => return Ok(pixel),
        (Size::OfPixels, None) => {
            return Err(Box::new(Fault::of(
                "",
                "nothing says how large a pixel is",
                "the size of a pixel, or the length of all stones together",
                "ask --pixel 2mm, or --width 3.2m",
            )));
        }
        (Size::OfUnits, _) => {}
    }
    if let (Some(stated), Some(asked)) = (stated, asked)
        && stated != asked
    {
        let found = format!(
            "the file says that its unit is {} m, and {asked} m is asked for",
            significant(stated, 6)
        );
        return Err(Box::new(Fault::of("", found, "one unit", "leave out --unit, or correct the file")));
    }
    if stated.or(asked).is_none() {
        warnings.push("no unit is said: metres are taken; ask --unit, or --width".to_owned());
    }
    Ok(stated.or(asked).unwrap_or(1.0))
}

/// What was read, in a sentence.
fn read(outlines: &[Outline], length: f64, height: f64) -> String {
    let grounds = outlines.iter().filter(|own| own.part == Part::Ground).count();
    let ground = if grounds > 0 { format!(" on {grounds} outline(s) of ground") } else { String::new() };
    let stones = outlines.len() - grounds;
    let headers = outlines.iter().filter(|own| own.part == Part::Header).count();
    let headers = if headers > 0 { format!(", {headers} of them headers") } else { String::new() };
    format!("read {stones} stones{headers}{ground}, {length:.3} m long and {height:.3} m high together")
}

/// The outlines with their joints closed.
fn closed(outlines: &[Outline], closing: &Closing, warnings: &mut Vec<String>) -> Result<Face, WallFaults> {
    let mut faults = WallFaults::new("drawing");
    let mut areas: Vec<f64> = outlines.iter().map(Outline::area).collect();
    areas.sort_by(f64::total_cmp);
    let most = WIDEST * areas[areas.len() / 2].sqrt();
    if closing.widest > most && most > 0.0 {
        let found = format!("joints are to be closed up to {}", length(closing.widest));
        let allowed = format!("at most {}, a quarter of a stone", length(most));
        faults.push(Fault::of("", found, allowed, "ask --mend for the width of the joints"));
        return Err(faults);
    }
    let face = Face::of(outlines, closing).map_err(|found| {
        found.iter().for_each(|trouble| faults.push(as_fault(outlines, trouble)));
        faults.clone()
    })?;
    for (stone, gap) in &face.alone {
        let found = match gap {
            Some(gap) => format!("it meets nothing: its nearest neighbour is {} away", length(*gap)),
            None => "it meets nothing".to_owned(),
        };
        let fix = "ask --mend for a length somewhat above the width of the joints, or remove it";
        let allowed =
            format!("a joint of at most {} with another stone or the ground", length(closing.widest));
        faults.push(Fault::of(&outlines[*stone].name, found, allowed, fix).at(outlines[*stone].line, 0));
    }
    if !faults.is_empty() {
        return Err(faults);
    }
    warnings.push(told(outlines, &face));
    Ok(face)
}

/// What closing did, in a sentence.
fn told(outlines: &[Outline], face: &Face) -> String {
    let before: f64 = outlines.iter().map(Outline::area).sum();
    let now: f64 = face.polygons.iter().map(Polygon::area).sum();
    let mut changed: Vec<(usize, f64)> =
        face.gained.iter().copied().enumerate().filter(|(_, share)| share.abs() > CHANGED).collect();
    changed.sort_by(|a, b| b.1.abs().total_cmp(&a.1.abs()).then(a.0.cmp(&b.0)));
    let named: Vec<String> = changed
        .iter()
        .take(NAMED)
        .map(|(stone, share)| format!("{} by {:+.1} %", outlines[*stone].name, 100.0 * share))
        .collect();
    let most = if named.is_empty() { String::new() } else { format!("; most changed: {}", named.join(", ")) };
    let [usual, widest] = face.widths.map(length);
    format!(
        "closed {} joints, {usual} wide in the median and {widest} at most; the stones changed by {:+.2} % in all{most}",
        face.joints.len(),
        100.0 * (now / before - 1.0)
    )
}

/// What is wrong with an outline.
fn as_fault(outlines: &[Outline], trouble: &Trouble) -> Fault {
    let of = |outline: usize, found: String, allowed: &str, fix: &str| {
        Fault::of(&outlines[outline].name, found, allowed, fix).at(outlines[outline].line, 0)
    };
    match *trouble {
        Trouble::Crosses { outline, at: [x, z] } => of(
            outline,
            format!("its outline crosses or touches itself at x = {x:.4} m, z = {z:.4} m"),
            "an outline that goes around the stone once",
            "draw it anew there",
        ),
        Trouble::Empty { outline } => of(
            outline,
            "its outline surrounds no area".to_owned(),
            "an area",
            "draw it around the stone, or remove it",
        ),
        Trouble::Covered { outline, by, share } => of(
            outline,
            format!("{:.0} % of it lie within {}", 100.0 * share, outlines[by].name),
            "stones beside each other",
            "remove the one that is there twice, or name an opening or the ground as such",
        ),
        Trouble::Vanishes { outline } => of(
            outline,
            "nothing is left of it between its neighbours".to_owned(),
            "stones beside each other",
            "look whether outlines overlap there",
        ),
    }
}

/// The corners of an outline as it is drawn.
fn counter_clockwise(outline: &Outline) -> Vec<[f64; 2]> {
    let mut points = outline.points.clone();
    if moments(&points).area < 0.0 {
        points.reverse();
    }
    points
}

/// A block with this polygon, counter-clockwise, as its face.
fn draft(at: usize, outline: &Outline, polygon: &[[f64; 2]], deep: f64, options: &ReadOptions) -> Draft {
    let n = polygon.len() as i64;
    // A section is the face of a wall that is turned by a quarter about the vertical.
    let place = |[across, z]: &[f64; 2], behind: f64| match options.section {
        true => Vec3::new(deep - behind, *across, *z),
        false => Vec3::new(*across, behind, *z),
    };
    let plane = |behind: f64| polygon.iter().map(move |point| place(point, behind));
    let sides = (0..n).map(|k| vec![k, k + n, (k + 1) % n + n, (k + 1) % n]);
    let faces = [(0..n).collect(), (n..2 * n).rev().collect()].into_iter().chain(sides).collect();
    let shape = (plane(0.0).chain(plane(deep)).collect(), faces);
    let plain = Draft::plain(outline.name.clone(), at as u64, outline.part == Part::Ground, shape);
    let tag = if outline.part == Part::Header { Tag::Header } else { plain.tag };
    Draft { line: outline.line, density: options.density.or(plain.density), tag, ..plain }
}

/// A length (m) for a person.
fn length(metres: f64) -> String {
    format!("{} mm", significant(1e3 * metres, 3))
}
