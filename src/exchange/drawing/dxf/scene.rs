//! The lines of a DXF drawing with those of its blocks, where they are inserted.

use std::collections::{BTreeMap, BTreeSet};

use crate::exchange::drawing::dxf::entities::{Entities, Entity, What};
use crate::exchange::drawing::dxf::place::Placing;
use crate::exchange::drawing::dxf::shapes::Path;
use crate::exchange::drawing::gather::{Gatherer, MOST_POINTS, Unread, too_many};
use crate::exchange::drawing::layer::{Shown, shown};
use crate::exchange::fault::Fault;

/// How deep blocks may be in blocks.
const DEEPEST: usize = 8;
/// Most entities of inserted blocks.
const MOST_INSERTED: usize = 1_000_000;

/// Entities that are inserted together.
#[derive(Default)]
pub(super) struct Block<'a> {
    pub base: [f64; 3],
    pub entities: Entities<'a>,
}

/// A line of the drawing in the world's axes.
pub(super) struct Line<'a> {
    pub line: usize,
    pub layer: &'a str,
    pub path: Result<Path, Unread>,
}

/// The lines of entities with those of blocks in them; what else is there, or on layers that are `off`, is counted.
pub(super) fn lines<'a>(
    entities: &Entities<'a>,
    blocks: &BTreeMap<&'a str, Block<'a>>,
    off: &BTreeSet<&'a str>,
    gatherer: &mut Gatherer,
) -> Result<Vec<Line<'a>>, Box<Fault>> {
    let mut scene = Scene { off, blocks, gatherer, lines: Vec::new(), inserted: 0, points: 0 };
    scene.add(&entities.all, "0", &Placing::facing([0.0, 0.0, 1.0]), 0)?;
    Ok(scene.lines)
}

/// The drawing as far as its blocks are inserted.
struct Scene<'a, 'g> {
    off: &'g BTreeSet<&'a str>,
    blocks: &'g BTreeMap<&'a str, Block<'a>>,
    gatherer: &'g mut Gatherer,
    lines: Vec<Line<'a>>,
    inserted: usize,
    points: usize,
}

impl<'a, 'g> Scene<'a, 'g> {
    /// Adds entities; those on layer 0 of a block are on the layer on which it is inserted.
    fn add(
        &mut self,
        all: &'g [Entity<'a>],
        layer: &'a str,
        placing: &Placing,
        depth: usize,
    ) -> Result<(), Box<Fault>> {
        for entity in all {
            let own = if depth > 0 && entity.layer == "0" { layer } else { entity.layer };
            let line = entity.line;
            if depth > 0 {
                self.inserted += 1;
            }
            if self.inserted > MOST_INSERTED || depth > DEEPEST {
                let found = "its blocks hold one another, or too many others";
                let allowed = format!("{DEEPEST} blocks in one another and {MOST_INSERTED} entities");
                return Err(Fault::of("", found, allowed, "explode the blocks").at(line, 0).into());
            }
            if self.off.contains(own) {
                self.gatherer.pass(&format!("{} on layers that are off", entity.kind));
                continue;
            }
            if shown(own) == Shown::Passed {
                self.gatherer.pass_layer(own);
                continue;
            }
            match &entity.what {
                What::Other => self.gatherer.pass(entity.kind),
                What::Path(path) => {
                    let placed = |own: &Path| Path {
                        points: own.points.iter().map(|point| placing.of(*point)).collect(),
                        closed: own.closed,
                    };
                    self.points += path.as_ref().map_or(1, |path| path.points.len());
                    self.lines.push(Line {
                        line,
                        layer: own,
                        path: path.as_ref().map(placed).map_err(Unread::clone),
                    });
                }
                What::Block(_, Err(unread)) => {
                    self.lines.push(Line { line, layer: own, path: Err(unread.clone()) });
                }
                What::Block(name, Ok(insertion)) => match self.blocks.get(name) {
                    Some(block) => {
                        let placing = placing.after(&insertion.placing(block.base));
                        let from = self.lines.len();
                        self.add(&block.entities.all, own, &placing, depth + 1)?;
                        // What is wrong in a block keeps its own line; the rest is where the block is inserted.
                        self.lines[from..].iter_mut().for_each(|inner| inner.line = line);
                    }
                    None => self.gatherer.pass("INSERT of no block"),
                },
            }
            if self.points > MOST_POINTS {
                return Err(too_many(line).into());
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exchange::drawing::dxf::records::Records;

    fn entities(text: &str) -> Entities<'_> {
        let mut entities = Entities::default();
        Records::of(text).for_each(|record| entities.add(&record.unwrap()));
        entities.end();
        entities
    }

    #[test]
    fn a_block_is_drawn_where_it_is_inserted_and_what_is_off_is_not() {
        let block = Block {
            base: [1.0, 0.0, 0.0],
            entities: entities("0\nLINE\n8\n0\n10\n1\n11\n2\n0\nLINE\n8\nOFF\n"),
        };
        let blocks = BTreeMap::from([("B", block)]);
        let all = entities("0\nINSERT\n8\nstones\n2\nB\n10\n5\n41\n3\n0\nLINE\n8\ntext\n0\nINSERT\n2\nC\n");
        let mut gatherer = Gatherer::new("wall.dxf");
        let lines = lines(&all, &blocks, &BTreeSet::from(["OFF"]), &mut gatherer).unwrap();
        assert_eq!(lines.len(), 1);
        assert_eq!((lines[0].layer, lines[0].line), ("stones", 2));
        assert_eq!(lines[0].path.as_ref().unwrap().points, [[5.0, 0.0, 0.0], [8.0, 0.0, 0.0]]);
        let said = gatherer.finish(None).unwrap_err().to_string();
        assert!(said.contains("1 of \"INSERT of no block\", 1 of \"LINE on layers that are off\""), "{said}");
        assert!(said.contains("1 of \"text\""), "{said}");
    }
}
