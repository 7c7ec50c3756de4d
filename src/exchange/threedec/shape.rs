//! The block that a command of 3DEC makes.

use crate::exchange::closing::{weld, without_repeats};
use crate::exchange::solid::diagonal;
use crate::exchange::threedec::lines::Word;
use crate::math::Vec3;

/// Most corners of a block as its faces give them, each as often as it is there.
const MOST_CORNERS: usize = 10_000;
/// Share of a block's size within which corners are one: files have six digits or so.
const WELD: f64 = 1e-6;

/// A block, before anything about it is believed.
#[derive(Debug, Default)]
pub(super) struct Block {
    pub vertices: Vec<Vec3>,
    pub faces: Vec<Vec<u32>>,
    pub region: Option<i64>,
    /// Its group, and the slot of it, which is "Default" unless another is named.
    pub group: Option<(String, String)>,
}

/// What is wrong with a command: what was found, what is allowed, how to mend it.
#[derive(Debug)]
pub(super) struct Wrong {
    pub found: String,
    pub allowed: &'static str,
    pub fix: &'static str,
}

fn wrong(found: impl Into<String>, allowed: &'static str, fix: &'static str) -> Wrong {
    Wrong { found: found.into(), allowed, fix }
}

const SHAPES: &str = "brick, prism, tetrahedron, and polyhedron with its faces";
const AS_FACES: &str = "write the block by its faces: polyhedron face x,y,z ... face ...";
const NUMBERS: &str = "numbers, as 0.5";
const WRITE_OUT: &str = "write the numbers out, as the function computes them";

/// What is said of a block with a whole number, and is passed over.
const PASSED: [(&str, usize); 4] = [("material", 1), ("constitutive", 4), ("joint-set", 6), ("jset", 4)];

/// A shape under construction.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Shape {
    Brick,
    Prism,
    Tetrahedron,
    Polyhedron,
}

/// The block that the words after a creating command make.
///
/// # Errors
/// Words that are not understood, and numbers that are too few or too many.
pub(super) fn block(words: &[Word<'_>]) -> Result<Block, Wrong> {
    let mut block = Block::default();
    let mut shape: Option<Shape> = None;
    let mut lists: Vec<Vec<f64>> = Vec::new();
    let mut rest = words.iter();
    let begin = |shape: &mut Option<Shape>, own: Shape| match shape.replace(own) {
        Some(other) if other != own => {
            Err(wrong("two shapes in one command", SHAPES, "write a command for each block"))
        }
        _ => Ok(()),
    };
    while let Some(word) = rest.next() {
        let is_prism = shape == Some(Shape::Prism);
        if let (Some(number), Some(list)) = (word.number(), lists.last_mut()) {
            list.push(number);
        } else if word.is("brick", 3) {
            begin(&mut shape, Shape::Brick)?;
            lists.push(Vec::new());
        } else if word.is("prism", 3) {
            begin(&mut shape, Shape::Prism)?;
        } else if word.is("tetrahedron", 3) {
            begin(&mut shape, Shape::Tetrahedron)?;
            lists.push(Vec::new());
        } else if word.is("polyhedron", 4) {
            begin(&mut shape, Shape::Polyhedron)?;
        } else if is_prism && ["a", "b", "face-1", "face-2"].iter().any(|own| word.is(own, own.len())) {
            lists.push(Vec::new());
        } else if !is_prism && word.is("face", 4) {
            begin(&mut shape, Shape::Polyhedron)?;
            lists.push(Vec::new());
        } else if word.is("region", 1) {
            block.region = Some(whole(rest.next(), "a number after region")?);
        } else if PASSED.iter().any(|(own, least)| word.is(own, *least)) {
            whole(rest.next(), "a number after material, constitutive or joint-set")?;
        } else if word.is("group", 2) || word.is("face-group", 6) {
            let group = name(&mut rest)?;
            if word.is("group", 2) {
                block.group = Some(group);
            }
        } else if word.text.starts_with(['@', '[']) {
            return Err(wrong(format!("{} is a value of FISH", shown(word)), NUMBERS, WRITE_OUT));
        } else {
            let found = format!("\"{}\" in a command that makes a block", shown(word));
            return Err(wrong(found, SHAPES, AS_FACES));
        }
    }
    let Some(shape) = shape else {
        return Err(wrong("a block without a shape", SHAPES, AS_FACES));
    };
    let corners: usize = lists.iter().map(|list| list.len() / 3).sum();
    if corners > MOST_CORNERS {
        let found = format!("a block whose faces have {corners} corners together");
        return Err(wrong(found, "at most 10000", "simplify the block"));
    }
    let (vertices, faces) = match shape {
        Shape::Brick => brick(&lists),
        Shape::Prism => prism(&lists),
        Shape::Tetrahedron => tetrahedron(&lists),
        Shape::Polyhedron => polyhedron(&lists),
    }?;
    (block.vertices, block.faces) = welded(vertices, &faces);
    Ok(block)
}

fn shown(word: &Word<'_>) -> String {
    word.text.chars().filter(|c| !c.is_control() && *c != '"').take(30).collect()
}

fn whole(word: Option<&Word<'_>>, allowed: &'static str) -> Result<i64, Wrong> {
    let number = word.and_then(|word| word.text.parse().ok());
    number.ok_or_else(|| {
        let found = word.map_or("the command ends".to_owned(), |word| format!("\"{}\"", shown(word)));
        wrong(found, allowed, "write a whole number")
    })
}

/// The name of a group, and its slot.
pub(super) fn name<'w, 'a: 'w>(
    rest: &mut (impl Iterator<Item = &'w Word<'a>> + Clone),
) -> Result<(String, String), Wrong> {
    let mut next = |what: &'static str| {
        let word =
            rest.next().ok_or_else(|| wrong("the command ends", what, "write its name, as 'stones'"))?;
        Ok(word.text.to_lowercase())
    };
    let own = next("the name of a group")?;
    let mut ahead = rest.clone();
    if ahead.next().is_some_and(|word| word.is("slot", 4)) {
        rest.next();
        let slot = rest.next().map_or(String::new(), |word| word.text.to_lowercase());
        return Ok((own, slot));
    }
    Ok((own, "default".to_owned()))
}

type Solid = Result<(Vec<Vec3>, Vec<Vec<u32>>), Wrong>;

/// Corners out of numbers.
fn corners(list: &[f64]) -> Result<Vec<Vec3>, Wrong> {
    if !list.len().is_multiple_of(3) {
        let found = format!("{} numbers for corners", list.len());
        return Err(wrong(found, "three of each corner, x y z", "look for a number that is missing"));
    }
    Ok(list.chunks_exact(3).map(|own| Vec3::new(own[0], own[1], own[2])).collect())
}

/// A box between x, y and z, each by its two ends; those of y and z are those of x where they are not stated.
fn brick(lists: &[Vec<f64>]) -> Solid {
    let numbers = lists.concat();
    let ends = match numbers[..] {
        [a, b] => [a, b, a, b, a, b],
        [a, b, c, d] => [a, b, c, d, a, b],
        [a, b, c, d, e, f] => [a, b, c, d, e, f],
        _ => {
            let found = format!("a brick of {} numbers", numbers.len());
            return Err(wrong(found, "six: x1 x2 y1 y2 z1 z2", "state both ends along each axis"));
        }
    };
    let [a, b, c, d, e, f] = ends;
    let level = |z: f64| [[a, c], [b, c], [b, d], [a, d]].map(|[x, y]| Vec3::new(x, y, z));
    extruded(&level(e), &level(f))
}

/// What lies between two faces with as many corners, of which the first ones are joined, the second ones, and so on.
fn prism(lists: &[Vec<f64>]) -> Solid {
    let [first, second] = lists else {
        let found = format!("a prism with {} faces", lists.len());
        return Err(wrong(found, "two: a and b, or face-1 and face-2", AS_FACES));
    };
    extruded(&corners(first)?, &corners(second)?)
}

fn extruded(first: &[Vec3], second: &[Vec3]) -> Solid {
    if first.len() != second.len() || first.len() < 3 {
        let found = format!("faces with {} and {} corners", first.len(), second.len());
        return Err(wrong(found, "as many corners of both, three or more", AS_FACES));
    }
    let n = first.len() as u32;
    let sides = (0..n).map(|k| vec![k, (k + 1) % n, n + (k + 1) % n, n + k]);
    let faces = [(0..n).rev().collect(), (n..2 * n).collect()].into_iter().chain(sides).collect();
    Ok(([first, second].concat(), faces))
}

fn tetrahedron(lists: &[Vec<f64>]) -> Solid {
    let corners = corners(&lists.concat())?;
    if corners.len() != 4 {
        let found = format!("a tetrahedron with {} corners", corners.len());
        return Err(wrong(found, "four", AS_FACES));
    }
    Ok((corners, vec![vec![0, 2, 1], vec![0, 1, 3], vec![1, 2, 3], vec![2, 0, 3]]))
}

/// A block by its faces.
fn polyhedron(lists: &[Vec<f64>]) -> Solid {
    let (mut all, mut faces) = (Vec::new(), Vec::new());
    for list in lists {
        let own = corners(list)?;
        let first = all.len() as u32;
        if own.len() < 3 {
            let found = format!("a face with {} corners", own.len());
            return Err(wrong(found, "three or more", "remove the face, or add its corners"));
        }
        faces.push((first..first + own.len() as u32).collect());
        all.extend(own);
    }
    if faces.len() < 4 {
        let found = format!("a polyhedron with {} faces", faces.len());
        return Err(wrong(found, "four or more, which close it", "add the faces that are missing"));
    }
    Ok((all, faces))
}

/// The block with each corner once, and without faces that have shrunk to an edge.
fn welded(vertices: Vec<Vec3>, faces: &[Vec<u32>]) -> (Vec<Vec3>, Vec<Vec<u32>>) {
    let stands = weld(&vertices, WELD * diagonal(&vertices));
    let once = faces.iter().map(|face| without_repeats(face, &stands));
    let faces = once.filter(|face| face.len() >= 3).collect();
    (vertices, faces)
}
