//! The entities of a DXF drawing or of one of its blocks, in the order of the file.

use crate::exchange::drawing::dxf::place::Placing;
use crate::exchange::drawing::dxf::records::Record;
use crate::exchange::drawing::dxf::shapes::{Corner, Path, own_axes, path, rounded};
use crate::exchange::drawing::gather::{Unread, short};
use crate::math::radians;

/// An entity.
#[derive(Clone, Debug)]
pub(super) struct Entity<'a> {
    /// Line of the file, from 1.
    pub line: usize,
    pub layer: &'a str,
    /// What it is called in the file: `LINE`.
    pub kind: &'a str,
    pub what: What<'a>,
}

/// What an entity is.
#[derive(Clone, Debug)]
pub(super) enum What<'a> {
    Path(Result<Path, Unread>),
    /// A block that is inserted, and where it goes but for its base point.
    Block(&'a str, Result<Insertion, Unread>),
    /// Something else, or something that is not shown.
    Other,
}

/// How a block is inserted.
#[derive(Clone, Copy, Debug)]
pub(super) struct Insertion {
    axes: Placing,
    place: [f64; 3],
    scale: [f64; 3],
    /// Radians.
    turn: f64,
}

impl Insertion {
    /// The map of a block with this base point.
    pub fn placing(&self, base: [f64; 3]) -> Placing {
        self.axes.after(&Placing::inserted(base, self.place, self.scale, self.turn))
    }

    fn of(record: &Record<'_>) -> Result<Insertion, Unread> {
        let scale = [record.number(41, 1.0)?, record.number(42, 1.0)?, record.number(43, 1.0)?];
        let turn = radians(record.number(50, 0.0)?);
        Ok(Insertion { axes: own_axes(record)?, place: record.point(10)?, scale, turn })
    }
}

/// A polyline whose vertices are records of their own.
struct Open<'a> {
    entity: Entity<'a>,
    axes: Result<Placing, Unread>,
    corners: Result<Vec<Corner>, Unread>,
    closed: bool,
    /// Whether it is a line in space or flat; meshes are none.
    is_line: bool,
}

/// What is read of a list of entities.
#[derive(Default)]
pub(super) struct Entities<'a> {
    pub all: Vec<Entity<'a>>,
    /// How many points its lines have.
    pub points: usize,
    open: Option<Open<'a>>,
}

impl<'a> Entities<'a> {
    /// Adds the next record.
    pub fn add(&mut self, record: &Record<'a>) {
        match (record.kind, &mut self.open) {
            ("VERTEX", Some(open)) => {
                self.points += 1;
                return open.vertex(record);
            }
            // Texts of a block, and the end of them.
            ("ATTRIB", _) => return,
            _ => self.end(),
        }
        let mut entity = Entity {
            line: record.line,
            layer: short(record.text(8)),
            kind: short(record.kind),
            what: What::Other,
        };
        // Invisible, or on a sheet of paper.
        let is_shown = record.flags(60) == 0 && record.flags(67) == 0;
        match record.kind {
            "SEQEND" | "VIEWPORT" => {}
            "POLYLINE" if is_shown => {
                let flags = record.flags(70);
                let (axes, corners) = (own_axes(record), Ok(Vec::new()));
                let is_line = flags & (16 | 64) == 0;
                // The points of a line in space are those of the world.
                let axes = if flags & 8 == 0 { axes } else { Ok(Placing::facing([0.0, 0.0, 1.0])) };
                self.open = Some(Open { entity, axes, corners, closed: flags & 1 != 0, is_line });
            }
            "INSERT" if is_shown && record.flags(70).max(record.flags(71)) <= 1 => {
                entity.what = What::Block(record.text(2), Insertion::of(record));
                self.all.push(entity);
            }
            _ => {
                if let Some(path) = path(record).filter(|_| is_shown) {
                    entity.what = What::Path(path);
                }
                self.push(entity);
            }
        }
    }

    /// Ends the list, or a polyline in it.
    pub fn end(&mut self) {
        if let Some(Open { mut entity, axes, corners, closed, is_line }) = self.open.take() {
            if is_line {
                entity.what = What::Path(axes.and_then(|axes| {
                    let path = rounded(&corners?, closed);
                    Ok(Path { points: path.points.into_iter().map(|point| axes.of(point)).collect(), ..path })
                }));
            }
            self.push(entity);
        }
    }

    fn push(&mut self, entity: Entity<'a>) {
        if let What::Path(Ok(path)) = &entity.what {
            self.points += path.points.len();
        }
        self.all.push(entity);
    }
}

impl Open<'_> {
    fn vertex(&mut self, record: &Record<'_>) {
        // Corners of the frame of a spline lie beside the line.
        if record.flags(70) & 16 != 0 {
            return;
        }
        let corner = record.point(10).and_then(|point| Ok(Corner { point, bulge: record.number(42, 0.0)? }));
        match (&mut self.corners, corner) {
            (Ok(corners), Ok(corner)) => corners.push(corner),
            (Ok(_), Err(unread)) => self.corners = Err(unread),
            (Err(_), _) => {}
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exchange::drawing::dxf::records::Records;

    fn read(text: &str) -> Vec<Entity<'_>> {
        let mut entities = Entities::default();
        Records::of(text).for_each(|record| entities.add(&record.unwrap()));
        entities.end();
        entities.all
    }

    #[test]
    fn a_polyline_has_its_vertices_and_a_mesh_is_none() {
        let vertices = "0\nVERTEX\n10\n1\n20\n2\n0\nVERTEX\n10\n3\n20\n4\n0\nSEQEND\n";
        let text =
            format!("0\nPOLYLINE\n8\nA\n70\n1\n{vertices}0\nPOLYLINE\n70\n64\n{vertices}0\nTEXT\n8\nB\n");
        let all = read(&text);
        assert_eq!(all.iter().map(|own| own.kind).collect::<Vec<_>>(), ["POLYLINE", "POLYLINE", "TEXT"]);
        let What::Path(Ok(path)) = &all[0].what else { panic!("{:?}", all[0]) };
        assert_eq!(*path, Path { points: vec![[1.0, 2.0, 0.0], [3.0, 4.0, 0.0]], closed: true });
        assert!(all[1..].iter().all(|own| matches!(own.what, What::Other)));
    }

    #[test]
    fn what_is_on_paper_or_in_rows_is_something_else() {
        let all = read("0\nLINE\n67\n1\n11\n5\n0\nINSERT\n2\nS\n70\n3\n0\nINSERT\n2\nS\n41\n2\n");
        assert!(matches!(all[0].what, What::Other) && matches!(all[1].what, What::Other));
        let What::Block("S", Ok(insertion)) = all[2].what else { panic!("{:?}", all[2]) };
        assert_eq!(insertion.placing([1.0, 0.0, 0.0]).of([2.0, 1.0, 0.0]), [2.0, 1.0, 0.0]);
    }
}
