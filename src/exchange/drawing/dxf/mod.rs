//! Reading drawings of a wall's face from ASCII DXF, which all drawing programs write.

mod entities;
mod joining;
mod place;
mod records;
mod scene;
mod shapes;

use std::collections::{BTreeMap, BTreeSet};

use crate::exchange::drawing::Drawing;
use crate::exchange::drawing::dxf::entities::Entities;
use crate::exchange::drawing::dxf::joining::{Piece, join};
use crate::exchange::drawing::dxf::place::Plane;
use crate::exchange::drawing::dxf::records::{Record, Records, text, truncated};
use crate::exchange::drawing::dxf::scene::{Block, Line, lines};
use crate::exchange::drawing::dxf::shapes::Path;
use crate::exchange::drawing::frame::Extent;
use crate::exchange::drawing::gather::{
    Drawn, Gatherer, MEETING, MOST_POINTS, Unread, cut, short, shown_number, too_many,
};
use crate::exchange::drawing::points::nearly_closed;
use crate::exchange::fault::{Fault, WallFaults};

const READ: &str = "an ASCII DXF drawing";
const SAVE: &str = "save it as ASCII DXF";

/// The closed lines of a drawing: polylines with or without arcs, circles, lines and arcs whose ends meet, and those of inserted blocks.
/// Layers say what they surround. The unit is that of `$INSUNITS`.
pub(in crate::exchange) fn read_dxf(bytes: &[u8]) -> Result<Drawing, WallFaults> {
    let mut gatherer = Gatherer::new("drawing.dxf");
    if let Some(fault) = other_format(bytes) {
        gatherer.fault(fault);
        return Err(gatherer.into_faults());
    }
    let text = text(bytes);
    match File::of(&text) {
        Ok(file) => file.drawing(gatherer),
        Err(fault) => {
            gatherer.fault(*fault);
            Err(gatherer.into_faults())
        }
    }
}

/// The fault of a file that is no ASCII DXF by its first bytes.
fn other_format(bytes: &[u8]) -> Option<Fault> {
    let found = if bytes.starts_with(b"AutoCAD Binary DXF") {
        "this is a binary DXF"
    } else if bytes.starts_with(b"AC10") {
        "this is a DWG"
    } else if bytes.iter().all(u8::is_ascii_whitespace) {
        "the file is empty"
    } else {
        return None;
    };
    Some(Fault::of("", found, READ, SAVE))
}

/// What a file says.
#[derive(Default)]
struct File<'a> {
    metres: Option<f64>,
    /// Layers that are switched off or frozen.
    off: BTreeSet<&'a str>,
    blocks: BTreeMap<&'a str, Block<'a>>,
    entities: Entities<'a>,
}

impl<'a> File<'a> {
    fn of(text: &'a str) -> Result<File<'a>, Box<Fault>> {
        let (mut file, mut section, mut last) = (File::default(), "", 0);
        let mut block: Option<(&str, Block)> = None;
        let mut points = 0;
        for record in Records::of(text) {
            let record = record?;
            last = record.line;
            match (section, record.kind) {
                (_, "EOF") => return Ok(file),
                (_, "SECTION") => section = record.text(2),
                (_, "ENDSEC") => {
                    file.entities.end();
                    section = "";
                }
                ("TABLES", "LAYER") if record.flags(70) & 1 != 0 || record.flags(62) < 0 => {
                    file.off.insert(short(record.text(2)));
                }
                ("BLOCKS", "BLOCK") => {
                    let base = record.point(10).map_err(|unread| Box::new(fault_of(&unread)))?;
                    block = Some((record.text(2), Block { base, ..Block::default() }));
                }
                ("BLOCKS", "ENDBLK") => {
                    if let Some((name, mut own)) = block.take() {
                        own.entities.end();
                        points += own.entities.points;
                        file.blocks.insert(name, own);
                    }
                }
                ("BLOCKS", _) => {
                    if let Some((_, own)) = &mut block {
                        own.entities.add(&record);
                    }
                }
                ("ENTITIES", _) => file.entities.add(&record),
                _ => {}
            }
            if section == "HEADER" {
                file.metres = file.metres.or(metres(&record));
            }
            let open = block.as_ref().map_or(0, |(_, own)| own.entities.points);
            if points + open + file.entities.points > MOST_POINTS {
                return Err(too_many(record.line).into());
            }
        }
        let empty = || Box::new(Fault::of("", "no record is in the file", READ, SAVE));
        Err(if last == 0 { empty() } else { truncated(last) })
    }

    fn drawing(self, mut gatherer: Gatherer) -> Result<Drawing, WallFaults> {
        let lines = match lines(&self.entities, &self.blocks, &self.off, &mut gatherer) {
            Ok(lines) => lines,
            Err(fault) => {
                gatherer.fault(*fault);
                return Err(gatherer.into_faults());
            }
        };
        let known = lines.iter().filter_map(|line| line.path.as_ref().ok()).flat_map(|path| &path.points);
        let plane = Plane::of(known);
        let [along, up, across] = plane.extents.map(shown_number);
        if plane.is_body() {
            let found = format!("the drawing reaches {along} by {up} by {across}");
            let fix = "turn it so that the wall's face lies in the plane of x and y, or of x and z";
            gatherer.fault(Fault::of("", found, "a flat drawing of a wall's face", fix));
            return Err(gatherer.into_faults());
        }
        if plane.is_rough() {
            let axis = ["x", "y", "z"][3 - plane.axes[0] - plane.axes[1]];
            gatherer.warn(format!(
                "the drawing reaches {across} along {axis}, across the face: it was taken as flat"
            ));
        }
        flat(lines, &plane, &mut gatherer);
        gatherer.finish(self.metres)
    }
}

/// Adds the lines in the plane of the face; open ones are put together where their ends meet.
fn flat(lines: Vec<Line<'_>>, plane: &Plane, gatherer: &mut Gatherer) {
    let (mut drawn, mut pieces): (Vec<Drawn>, BTreeMap<&str, Vec<Piece>>) = (Vec::new(), BTreeMap::new());
    let mut whole = Extent::of([]);
    for Line { line, layer, path } in lines {
        let flat = |path: Path| (path.points.iter().map(|p| plane.point(p)).collect::<Vec<_>>(), path.closed);
        match path.map(flat) {
            Ok((points, closed)) => {
                whole = whole.with(&Extent::of(&points));
                if closed || points.len() < 2 {
                    drawn.push(shape(line, layer, Ok(points), true));
                } else if nearly_closed(&points).is_some() {
                    drawn.push(shape(line, layer, Ok(points), false));
                } else {
                    pieces.entry(layer).or_default().push(Piece { line, points });
                }
            }
            Err(unread) => drawn.push(shape(line, layer, Err(unread), true)),
        }
    }
    for (layer, pieces) in pieces {
        let joined = join(pieces, MEETING * whole.size());
        if let Some((line, [x, z])) = joined.fork {
            let [x, z] = [x, z].map(shown_number);
            gatherer.warn(format!(
                "lines of layer \"{}\" fork, first at ({x}, {z}), line {line}: each of the {} cells between them was taken as an outline",
                cut(layer),
                joined.cells
            ));
        }
        if joined.repeated > 0 {
            gatherer.warn(format!("{} line(s) of layer \"{}\" are there twice", joined.repeated, cut(layer)));
        }
        drawn.extend(joined.lines.into_iter().map(|own| shape(own.line, layer, Ok(own.points), own.closed)));
        for (line, place) in joined.loose {
            let [x, z] = place.map(shown_number);
            let found =
                format!("a line of layer \"{}\" ends at ({x}, {z}) and meets nothing there", cut(layer));
            let fix = "draw it to the next line, or remove it";
            drawn.push(shape(
                line,
                layer,
                Err(Unread { line, found, allowed: "lines whose ends meet", fix }),
                true,
            ));
        }
    }
    drawn.sort_by_key(|own| own.line);
    for own in drawn {
        if !gatherer.push(own) {
            break;
        }
    }
}

fn shape(line: usize, layer: &str, points: Result<Vec<[f64; 2]>, Unread>, closed: bool) -> Drawn {
    Drawn { line, own: String::new(), layer: layer.to_owned(), points, closed }
}

fn fault_of(unread: &Unread) -> Fault {
    Fault::of("", unread.found.clone(), unread.allowed, unread.fix).at(unread.line, 0)
}

/// Metres in a unit of the drawing, by the head of the file.
fn metres(head: &Record<'_>) -> Option<f64> {
    let at = head.groups.iter().position(|group| group.code == 9 && group.value == "$INSUNITS")?;
    match head.groups.get(at + 1)?.value {
        "1" => Some(0.0254),
        "2" => Some(0.3048),
        "4" => Some(1e-3),
        "5" => Some(1e-2),
        "6" => Some(1.0),
        "10" => Some(0.9144),
        "14" => Some(0.1),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::face::Part;

    fn read(entities: &str) -> Result<Drawing, WallFaults> {
        let head = "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n5\n0\nENDSEC\n";
        read_dxf(format!("{head}0\nSECTION\n2\nENTITIES\n{entities}0\nENDSEC\n0\nEOF\n").as_bytes())
    }

    /// A chain of lines in the plane of x and z.
    fn chain(layer: &str, points: &[[f64; 2]]) -> String {
        let line = |pair: &[[f64; 2]]| {
            let [[x, z], [x_to, z_to]] = [pair[0], pair[1]];
            format!("0\nLINE\n8\n{layer}\n10\n{x}\n20\n4\n30\n{z}\n11\n{x_to}\n21\n4\n31\n{z_to}\n")
        };
        points.windows(2).map(line).collect()
    }

    #[test]
    fn lines_of_a_standing_face_are_put_together_layer_by_layer() {
        let square = [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0], [0.0, 0.0]];
        let low = square.map(|[x, z]| [x, z - 2.0]);
        let text =
            chain("base", &low) + &chain("wall", &square) + &chain("ground", &[[-9.0, 0.0], [9.0, 0.0]]);
        let drawing = read(&text).unwrap();
        assert_eq!(drawing.metres, Some(0.01));
        let parts: Vec<Part> = drawing.outlines.iter().map(|own| own.part).collect();
        assert_eq!(parts, [Part::Ground, Part::Stone], "{drawing:?}");
        assert_eq!(drawing.outlines[1].points, square[..4]);
        assert!(drawing.warnings[0].contains("the ground at line"), "{:?}", drawing.warnings);
    }

    #[test]
    fn open_lines_bodies_and_other_formats_are_told() {
        let said = |text: &str| read(text).unwrap_err().to_string();
        let open = said(&chain("wall", &[[0.0, 0.0], [2.0, 0.0], [2.0, 2.0]]));
        let found = "drawing.dxf:16: stone 0: a line of layer \"wall\" is open from (0, 0) to (2, 2)";
        assert!(open.contains(found), "{open}");
        let body = said("0\nLINE\n11\n5\n21\n5\n31\n5\n");
        assert!(body.contains("reaches 5 by 5 by 5"), "{body}");
        let nan = said("0\nCIRCLE\n10\nnan\n40\n1\n");
        assert!(nan.contains("drawing.dxf:18: stone 0: group 10 of CIRCLE is \"nan\""), "{nan}");
        for (bytes, found) in [
            (
                &b"AutoCAD Binary DXF\r\n\x1a\0\0"[..],
                "a binary DXF; allowed is an ASCII DXF drawing; save it as",
            ),
            (b"AC1032\0\0", "a DWG"),
            (b" \n", "empty"),
            (b"0\nSECTION\n", "truncated"),
            (b"hello\nyou\n", "\"hello\" stands where a group code"),
        ] {
            assert!(read_dxf(bytes).unwrap_err().to_string().contains(found), "{found}");
        }
    }
}
